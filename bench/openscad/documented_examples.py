#!/usr/bin/env python3
"""Writes the examples in BOSL2's comments as models: bench/openscad/documented_examples.py BOSL2 FOLDER

An example begins with a line "// Example" that ends in a colon or has one, and goes on for as long as lines
are indented below it. Each becomes FOLDER/FILE-NUMBER.scad, which includes BOSL2/std.scad and, if that
doesn't hold it, the file itself: OPENSCADPATH must name the folder around BOSL2. --every N writes one in N.
Examples that are marked not to be rendered, or to be animated, are passed over.
"""

import argparse
import re
from pathlib import Path

BEGINNING = re.compile(r"^// Examples?(\(([^)]*)\))?:")
CODE = re.compile(r"^//   (.*)$")
NOT_RENDERED = ("NORENDER", "Anim", "NoScript")


def examples_of(text):
    """The code of each example, in the order of the text."""
    code, flags = None, ""
    for line in text.splitlines() + [""]:
        inner = CODE.match(line)
        if code is not None and inner:
            code.append(inner.group(1))
            continue
        if code and not any(flag in flags for flag in NOT_RENDERED):
            yield "\n".join(code)
        beginning = BEGINNING.match(line)
        code, flags = ([], beginning.group(2) or "") if beginning else (None, "")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("library", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--every", type=int, default=1)
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    standard = (arguments.library / "std.scad").read_text()
    found = []
    for file in sorted(arguments.library.glob("*.scad")):
        includes = "include <BOSL2/std.scad>\n"
        if file.name not in standard and file.name != "std.scad":
            includes += f"include <BOSL2/{file.name}>\n"
        for number, code in enumerate(examples_of(file.read_text()), 1):
            own = "" if "include <BOSL2" in code else includes
            found.append((f"{file.stem}-{number:03}.scad", own + code + "\n"))
    for name, text in found[:: arguments.every]:
        (arguments.folder / name).write_text(text)
    print(f"{len(found[:: arguments.every])} of {len(found)} examples")


if __name__ == "__main__":
    main()
