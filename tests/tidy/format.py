"""format.py ROOT: clang-format would change nothing.

Versions of clang-format differ in what they make of one .clang-format, so only version 14, which is
Debian 12's, counts; where that isn't installed this ends with 77, which ctest takes for skipped.
"""

import os
import shutil
import subprocess
import sys

import tidy

VERSION = "14"
SKIPPED = 77
# Files a call, so that a command line has room for them.
BATCH = 50


def program():
    """The path of clang-format 14; None where there is none."""
    for name in ("clang-format-" + VERSION, "clang-format"):
        path = shutil.which(name)
        if path:
            said = subprocess.run([path, "--version"], capture_output=True, text=True, check=True)
            if f"version {VERSION}." in said.stdout:
                return path
    return None


def unformatted(root):
    """What clang-format says of the sources, a line each."""
    paths = [os.path.join(root, p) for p in tidy.Tree(root).paths if p.endswith(tidy.SOURCES)]
    said = []
    for first in range(0, len(paths), BATCH):
        call = [program(), "--dry-run", "--Werror", *paths[first:first + BATCH]]
        result = subprocess.run(call, capture_output=True, text=True, check=False)
        said += [line for line in result.stderr.splitlines() if "error:" in line]
    return said


if __name__ == "__main__":
    if program() is None:
        print(f"skipped: clang-format {VERSION} is not installed")
        sys.exit(SKIPPED)
    found = unformatted(sys.argv[1])
    print("\n".join(found) if found else "formatted")
    sys.exit(1 if found else 0)
