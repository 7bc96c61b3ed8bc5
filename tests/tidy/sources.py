"""Sizes of source files: how long the product's are, and how wide all lines."""

import re

MAX_LINES = 400
MAX_COLUMNS = 100
# Lines that hold a text of others, which can't be broken.
UNBREAKABLE = re.compile(r'R"|https?://')


def check_sources(tree, suffixes):
    for path in tree.paths:
        if not path.endswith(suffixes) or path.startswith("tests/"):
            continue
        lines = tree.lines(path)
        # What follows the last line's end is no line.
        if len(lines) - 1 > MAX_LINES:
            tree.breach(path, len(lines) - 1, f"is longer than {MAX_LINES} lines")
        for number, line in enumerate(lines, 1):
            if len(line) > MAX_COLUMNS and not UNBREAKABLE.search(line):
                tree.breach(path, number, f"is wider than {MAX_COLUMNS} columns")
