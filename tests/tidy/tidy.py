"""tidy.py ROOT: holds the rules of the house against the source tree.

Prints a line for each breach, "FILE:LINE: what is wrong", and fails if there is one. The rules:
each folder includes only what the code map of ARCHITECTURE.md says, which names every folder, and
only folders above its own row; a vendor is included only at home, Catch2 only by catch.hpp; what
decides without a clock includes none, nor threads or sockets; folders stay small; links of Markdown
files, and the files that they name, are there; first pages stay short, and every page of docs is
linked from somewhere; control messages are described and have examples (messages.py); files
stay short, and lines narrow (sources.py).
"""

import os
import re
import sys

import messages
import sources

SOURCES = (".cpp", ".hpp")
MAX_FILES = 30

# One file a message, a case or an experiment: these don't count as crowded.
DATA_FOLDERS = ("proto/schema", "scenes", "tests/fuzz/corpus", "docs/lab", "findings")
# The most bytes of what everybody reads first.
MAX_BYTES = {"README.md": 7 * 1024, "ARCHITECTURE.md": 12 * 1024}
# Where the compiler looks for what quotes name, after the root itself.
INCLUDE_ROOTS = ("common/", "tests/")
GENERATED = {"version.hpp"}

# Where a vendor's header, by its beginning, may be included. Tests may include all.
VENDORS = {
    "CLI/": ("cli/command_line.cpp", "cli/options/declaring.cpp", "cli/options/usage.cpp", "frontal/main.cpp", "node/main.cpp"),
    "Imf": ("common/film/exr_file.cpp",),
    "OpenEXR/": ("common/film/exr_file.cpp",),
    "assimp/": ("formats/mesh/assimp/",),
    "benchmark/": ("bench/",),
    "boost/": ("frontal/http_server.cpp", "frontal/http_session"),
    "embree": ("bench/",),
    "hwy/": ("common/geometry/", "common/mesh/", "common/crossings/", "common/regions/",
             "common/visibility/"),
    "libqhull": ("formats/openscad/hulls/convex_hull.cpp",),
    "nlohmann/": ("formats/json/parser.cpp", "formats/json/cbor_parser.cpp", "proto/"),
    "prometheus/": ("frontal/telling/metrics_text.cpp",),
    "png.h": ("common/film/png_file.cpp",),
    "polyclipping/": ("common/flat/polygon.cpp",),
    "sodium.h": ("common/transport/curve_keys.cpp",),
    "sqlite3.h": ("frontal/store/database.cpp",),
    "simdjson": ("formats/json/fast_parser.cpp",),
    "zlib.h": ("formats/brlcad/database/binary.cpp",),
    "zmq": ("common/transport/doorkeeper.cpp", "common/transport/zmq_context.hpp"),
}

# Headers of clocks, threads, processes and sockets. Plain atomics are none of them.
WORLDLY = re.compile(
    r"(chrono|condition_variable|ctime|future|mutex|poll\.h|pthread\.h|semaphore|shared_mutex|"
    r"signal\.h|spawn\.h|stop_token|sys/.*|thread|time\.h|unistd\.h)$")
# Those of our own that lead to such.
WORLDLY_ROOMS = ("process/clocks", "process/log_thread", "process/spawn_plan", "transport/zmq")
# Folders that hold nothing worldly, and those of which only a brain's sources don't.
UNWORLDLY = ("common/", "formats/", "proto/")
BRAINS = {"node": "graycube_node_brain", "frontal": "graycube_frontal_brain"}
WORLDLY_FILES = {
    "common/film/whole_file.cpp": "writes files so that they are whole or not there",
    "common/memory/kept_heap.cpp": "asks the system for memory",
    "common/memory/large_pages.cpp": "asks the system for memory",
    "common/process/descriptors.cpp": "asks the system for its limits",
    "common/process/accept.cpp": "stands in for a call of the system's",
    "common/process/clocks.hpp": "reads the system's clocks",
    "common/process/log_file.cpp": "appends to a file that only its owner can read",
    "common/process/log_line.cpp": "knows the clock on the wall",
    "common/process/log_thread.cpp": "is a thread",
    "common/process/log_thread.hpp": "is a thread",
    "common/process/command_output.cpp": "starts processes",
    "common/process/program_path.cpp": "looks for programs",
    "common/process/spawn_plan.cpp": "starts processes",
    "common/process/spawn_plan.hpp": "starts processes",
    "common/trace/render_serial.cpp": "is a program's whole render, with threads and their clock",
    "common/transport/connection_watch.hpp": "tells for how long a peer has been silent",
    "common/transport/doorkeeper.cpp": "answers ZeroMQ from a thread of its own",
    "common/transport/endpoint.cpp": "knows sockets",
    "common/transport/farm_key.cpp": "makes a file that only its owner can read",
    "common/transport/own_address.cpp": "knows sockets",
    "common/transport/secret.cpp": "asks the system for random bytes",
    "common/transport/socket_monitor.hpp": "knows sockets",
    "common/transport/tcp_options.cpp": "knows sockets",
    "common/transport/tcp_options.hpp": "knows sockets",
    "common/transport/zmq_context.hpp": "knows sockets",
    "common/transport/zmq_sockets.cpp": "knows sockets",
    "common/transport/zmq_sockets.hpp": "knows sockets",
}


class Tree:
    """The files below a root: their paths in it, and their lines."""

    def __init__(self, root):
        self.root = root
        self.paths = sorted(self._walk())
        self.files = set(self.paths)
        self.breaches = []

    def _walk(self):
        for folder, inner, names in os.walk(self.root):
            inner[:] = [n for n in inner if n[0] != "." and not re.match(r"(build|out)(-|$)", n)
                        and n != "__pycache__"]
            for name in names:
                yield os.path.relpath(os.path.join(folder, name), self.root).replace(os.sep, "/")

    def lines(self, path):
        with open(os.path.join(self.root, path), encoding="utf-8") as file:
            return file.read().split("\n")

    def exists(self, path):
        return os.path.exists(os.path.join(self.root, path))

    def breach(self, path, line, what):
        self.breaches.append(f"{path}:{line}: {what}")

    def includes(self, path):
        """Triples of line, what is included, and whether in quotes."""
        pattern = re.compile(r'\s*#\s*include\s+(["<])([^">]+)[">]')
        for number, line in enumerate(self.lines(path), 1):
            if found := pattern.match(line):
                yield number, found[2], found[1] == '"'


def full_name(tree, name):
    """What a row calls a folder that it includes: those of common go by their last name."""
    return name if tree.exists(name) or "/" in name else "common/" + name


class Grouped(str):
    """A folder that a row names together with others, as "formats/" names all rows above below it."""


def spread(name, rows):
    """The folders that a name in a row stands for, given the rows above."""
    if not name.endswith("/"):
        return [name]
    group = [Grouped(folder) for folder in rows if (folder + "/").startswith(name)]
    return group if group else [name]


def code_map(tree):
    """The rows of ARCHITECTURE.md's code map, in order: folder to what it may include."""
    rows = {}
    lines = tree.lines("ARCHITECTURE.md")
    start = lines.index("## Code map") if "## Code map" in lines else len(lines)
    for number, line in enumerate(lines[start:], start + 1):
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        folders = re.findall(r"`([^`]+)`", cells[0]) if line.startswith("| `") else []
        if len(cells) == 3:
            named = [full_name(tree, name) for spans in re.findall(r"`([^`]+)`", cells[2])
                     for word in spans.split() for name in spread(word, rows)]
            for folder in folders:
                rows[folder] = (number, named)
        if line.startswith("## ") and number > start + 1:
            break
    if not rows:
        tree.breach("ARCHITECTURE.md", 1, "there is no code map")
    return rows


def room_of(path, rows):
    """The longest row that the file is in; the ground floor is common's own files only."""
    folder = os.path.dirname(path)
    while folder and (folder not in rows or (folder == "common" != os.path.dirname(path))):
        folder = os.path.dirname(folder)
    return folder


def resolved(tree, path, name):
    """The path of what a file includes in quotes; None where it is nowhere."""
    beside = os.path.normpath(os.path.join(os.path.dirname(path), name))
    for candidate in [name] + [root + name for root in INCLUDE_ROOTS] + [beside]:
        if candidate in tree.files:
            return candidate
    return None


def check_map(tree, rows):
    """Folders that are named exist, and come after those that they include."""
    above = set()
    for folder, (number, named) in rows.items():
        if not tree.exists(folder):
            tree.breach("ARCHITECTURE.md", number, f"there is no folder {folder}")
        for other in named:
            if other not in above:
                tree.breach("ARCHITECTURE.md", number, f"{other} is no row above that of {folder}")
        above.add(folder)


def check_includes(tree, rows):
    """Includes in quotes are those of the code map, and all of those are made."""
    made = {folder: set() for folder in rows}
    for path in tree.paths:
        if not path.endswith(SOURCES) or path.startswith("tests/"):
            continue
        room = room_of(path, rows)
        if not room:
            tree.breach(path, 1, "the code map has no row for its folder")
            continue
        allowed = {room, "common", *rows[room][1]}
        for number, name, is_quoted in tree.includes(path):
            if not is_quoted or name in GENERATED:
                continue
            target = resolved(tree, path, name)
            other = room_of(target, rows) if target else None
            if target is None or target.startswith("tests/"):
                tree.breach(path, number, f"there is no {name} that it may include")
            elif other not in allowed:
                tree.breach(path, number, f"{room} doesn't include {other}: {name}")
            else:
                made[room].add(other)
    for folder, (number, named) in rows.items():
        for other in named:
            if other not in made[folder] and not isinstance(other, Grouped):
                tree.breach("ARCHITECTURE.md", number, f"{folder} includes nothing of {other}")


def check_vendors(tree):
    for path in tree.paths:
        if not path.endswith(SOURCES) or path.startswith("tests/"):
            continue
        for number, name, is_quoted in tree.includes(path):
            for vendor, homes in VENDORS.items():
                if not is_quoted and name.startswith(vendor) and not path.startswith(homes):
                    tree.breach(path, number, f"{name} is at home in {', '.join(homes)}")


def check_catch(tree):
    """Tests know Catch2 by the one header that knows its versions."""
    for path in tree.paths:
        if not path.endswith(SOURCES) or not path.startswith("tests/") or path == "tests/catch.hpp":
            continue
        for number, name, _ in tree.includes(path):
            if name.startswith("catch2/"):
                tree.breach(path, number, f'{name}: include "catch.hpp"')


def brain_sources(tree):
    """The .cpp files of the brains' targets, and all that these include of their folders."""
    found = []
    for folder, target in BRAINS.items():
        text = "\n".join(tree.lines(folder + "/CMakeLists.txt"))
        listed = re.search(r"add_library\(" + target + r" STATIC([^)]*)\)", text)
        if not listed:
            tree.breach(folder + "/CMakeLists.txt", 1, f"there is no target {target}")
        waiting = [folder + "/" + name for name in (listed[1].split() if listed else [])]
        seen = set()
        while waiting:
            path = waiting.pop()
            if path in seen or path not in tree.files:
                continue
            seen.add(path)
            waiting += [name for _, name, is_quoted in tree.includes(path)
                        if is_quoted and name.startswith(folder + "/")]
        found += sorted(seen)
    return found


def check_worldly(tree):
    """What must behave alike everywhere knows no clock, thread or socket."""
    checked = [p for p in tree.paths if p.startswith(UNWORLDLY) and p.endswith(SOURCES)]
    checked += brain_sources(tree)
    worldly = set()
    for path in checked:
        for number, name, is_quoted in tree.includes(path):
            if (not is_quoted and WORLDLY.match(name)) or name.startswith(WORLDLY_ROOMS):
                worldly.add(path)
                if path not in WORLDLY_FILES:
                    tree.breach(path, number, f"{name}: no clocks, threads and sockets here")
    for path in sorted(set(WORLDLY_FILES) - worldly):
        tree.breach(path, 1, "is no exception any more: take it out of tidy.py")


def check_sizes(tree):
    counts = {}
    for path in tree.paths:
        folder = os.path.dirname(path)
        if not (folder + "/").startswith(tuple(d + "/" for d in DATA_FOLDERS)):
            counts[folder] = counts.get(folder, 0) + 1
    for folder, count in sorted(counts.items()):
        if count > MAX_FILES:
            tree.breach(folder, 1, f"holds {count} files, {MAX_FILES} at most")


def anchors_of(tree, path):
    """The anchors of a Markdown file's headings, as GitHub makes them."""
    anchors = set()
    for line in tree.lines(path):
        if heading := re.match(r"#+\s+(.*)", line):
            plain = re.sub(r"[^\w\- ]", "", heading[1].strip().lower())
            anchors.add(plain.replace(" ", "-"))
    return anchors


def check_link(tree, path, number, link):
    if re.match(r"[a-z]+:", link):
        return
    file, _, anchor = link.partition("#")
    target = os.path.normpath(os.path.join(os.path.dirname(path), file)) if file else path
    if not tree.exists(target):
        tree.breach(path, number, f"the link {link} leads nowhere")
    elif anchor and target.endswith(".md") and anchor not in anchors_of(tree, target):
        tree.breach(path, number, f"the link {link} leads to no heading")


def check_documents(tree):
    """Links lead somewhere, and what looks like a source file of ours is one."""
    named = re.compile(r"`([\w.-]+(?:/[\w.-]+)+\.(?:cpp|hpp|py|sh|md|cmake))`")
    for path in tree.paths:
        if not path.endswith(".md"):
            continue
        for number, line in enumerate(tree.lines(path), 1):
            for link in re.findall(r"\]\(([^)\s]+)\)", line):
                check_link(tree, path, number, link)
            for name in named.findall(line) if os.path.basename(path) != "CHANGELOG.md" else []:
                if not any(tree.exists(root + name) for root in ("", "common/", "formats/")):
                    tree.breach(path, number, f"there is no {name}")


def check_short(tree):
    for path, most in MAX_BYTES.items():
        size = os.path.getsize(os.path.join(tree.root, path)) if tree.exists(path) else 0
        if size > most:
            tree.breach(path, 1, f"has {size} bytes, {most} at most")


def check_linked(tree):
    """Every page of docs can be reached: another document links it."""
    linked = set()
    for path in tree.paths:
        if not path.endswith(".md"):
            continue
        for line in tree.lines(path):
            for link in re.findall(r"\]\(([^)\s#]+)", line):
                target = os.path.normpath(os.path.join(os.path.dirname(path), link))
                if target != path:
                    linked.add(target)
    for path in tree.paths:
        if path.startswith("docs/") and path not in linked:
            tree.breach(path, 1, "no document links it")


def breaches_of(root):
    tree = Tree(root)
    rows = code_map(tree)
    check_map(tree, rows)
    check_includes(tree, rows)
    check_vendors(tree)
    check_catch(tree)
    check_worldly(tree)
    check_sizes(tree)
    check_documents(tree)
    check_short(tree)
    check_linked(tree)
    messages.check_messages(tree)
    sources.check_sources(tree, SOURCES)
    return tree.breaches


if __name__ == "__main__":
    found = breaches_of(sys.argv[1])
    print("\n".join(found) if found else "tidy")
    sys.exit(1 if found else 0)
