"""Control messages: each that has a schema is described in proto/FORMAT.md, and has an example in
the tests, which hold it against the schema. That each has a schema they see to as well.
"""

import os
import re

FORMAT = "proto/FORMAT.md"
EXAMPLES = "tests/proto/control_examples.hpp"


def described(tree):
    """The types that a row of a table or the answer in one begins with."""
    found = set()
    for line in tree.lines(FORMAT):
        if line.startswith("|"):
            for cell in line.split("|"):
                found.update(re.findall(r"`(\w+)`", cell))
        else:
            found.update(re.findall(r"(?:^|[.)] )`(\w+)`: ", line))
            found.update(re.findall(r"answered by `(\w+)`", line))
    return found


def check_messages(tree):
    folder = "proto/schema/"
    types = [os.path.basename(path).removesuffix(".schema.json") for path in tree.paths
             if path.startswith(folder) and path.endswith(".schema.json")]
    if not types:
        return
    rows = described(tree)
    examples = "\n".join(tree.lines(EXAMPLES))
    for name in types:
        schema = f"{folder}{name}.schema.json"
        if name not in rows:
            tree.breach(schema, 1, f"{FORMAT} has no row of `{name}`")
        struct = "".join(word.capitalize() for word in name.split("_"))
        if not re.search(rf"\b{struct}\b", examples):
            tree.breach(schema, 1, f"{EXAMPLES} has no example of a {struct}")
