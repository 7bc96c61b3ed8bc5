"""Breaks each rule of tidy.py in a small house that is tidy, and expects to be told of it."""

import os
import tempfile
import unittest

import format
import sources
import tidy

HOUSE = {
    "ARCHITECTURE.md": """# Architecture

## Code map

| folder | what | includes |
|---|---|---|
| `common` | ground | – |
| `common/low` | low | – |
| `common/high` | high | `common/low` |
| `node`, `frontal` | brains | `common/high` |

## Next

See [the map](#code-map), [the readme](README.md#first-steps) and `low/low.hpp`.
""",
    "README.md": "# House\n\n## First *steps*!\n",
    "common/check.hpp": "",
    "common/low/low.hpp": '#include "check.hpp"\n#include <atomic>\n#include <vector>\n',
    "common/high/high.cpp": '#include "low/low.hpp"\n',
    "common/high/high.hpp": "",
    "node/CMakeLists.txt": "add_library(graycube_node_brain STATIC\n  node.cpp)\n",
    "node/node.cpp": '#include "node/node.hpp"\n',
    "node/node.hpp": '#include "high/high.hpp"\n',
    "node/main.cpp": "#include <thread>\n",
    "frontal/CMakeLists.txt": "add_library(graycube_frontal_brain STATIC frontal.cpp)\n",
    "frontal/frontal.cpp": '#include "high/high.hpp"\n#include "version.hpp"\n',
    "tests/low/low_test.cpp": '#include <zmq.hpp>\n#include <thread>\n#include "nowhere.hpp"\n',
}


class TidyTest(unittest.TestCase):
    def breaches(self, changes, exceptions=()):
        """What is found in the house with files changed, and worldly files excepted."""
        usual, tidy.WORLDLY_FILES = tidy.WORLDLY_FILES, exceptions
        try:
            with tempfile.TemporaryDirectory() as root:
                for path, text in {**HOUSE, **changes}.items():
                    os.makedirs(os.path.join(root, os.path.dirname(path)), exist_ok=True)
                    with open(os.path.join(root, path), "w", encoding="utf-8") as file:
                        file.write(text)
                return tidy.breaches_of(root)
        finally:
            tidy.WORLDLY_FILES = usual

    def expect(self, breach, changes):
        self.assertEqual(self.breaches(changes), [breach])

    def map_with(self, old, new):
        self.assertIn(old, HOUSE["ARCHITECTURE.md"])
        return {"ARCHITECTURE.md": HOUSE["ARCHITECTURE.md"].replace(old, new)}

    def test_a_tidy_house_has_no_breach(self):
        self.assertEqual(self.breaches({}), [])

    def test_nothing_is_included_from_below(self):
        self.expect("common/low/low.hpp:2: common/low doesn't include common/high: high/high.hpp",
                    {"common/low/low.hpp": '\n#include "high/high.hpp"\n'})

    def test_brains_do_not_include_each_other(self):
        self.expect("frontal/frontal.cpp:2: frontal doesn't include node: node/node.hpp",
                    {"frontal/frontal.cpp": '#include "high/high.hpp"\n#include "node/node.hpp"\n'})

    def test_the_ground_floor_includes_nothing(self):
        self.expect("common/check.hpp:1: common doesn't include common/low: low/low.hpp",
                    {"common/check.hpp": '#include "low/low.hpp"\n'})

    def test_what_is_included_exists_and_is_no_test(self):
        self.expect("common/high/high.hpp:1: there is no low/dice.hpp that it may include",
                    {"common/high/high.hpp": '#include "low/dice.hpp"\n', "tests/low/dice.hpp": ""})

    def test_a_row_names_nothing_that_is_not_included(self):
        self.expect("ARCHITECTURE.md:9: common/high includes nothing of common/low",
                    {"common/high/high.cpp": ""})

    def test_a_row_names_rows_above_it_only(self):
        found = self.breaches(self.map_with("| low | – |", "| low | `common/high` |"))
        self.assertIn("ARCHITECTURE.md:8: common/high is no row above that of common/low", found)

    def test_a_row_may_call_folders_of_common_by_their_last_name(self):
        short = self.map_with("| high | `common/low` |", "| high | `low` |")
        self.assertEqual(self.breaches(short), [])
        self.expect("ARCHITECTURE.md:9: common/high includes nothing of common/low",
                    {**short, "common/high/high.cpp": ""})

    def test_a_row_may_name_many_folders_together(self):
        wide = self.map_with("| brains | `common/high` |", "| brains | `low high` |")
        both = {"node/node.hpp": '#include "high/high.hpp"\n#include "low/low.hpp"\n'}
        self.expect("ARCHITECTURE.md:10: frontal includes nothing of common/low", {**wide, **both})

    def test_a_row_may_name_all_rows_above_that_are_below_a_folder(self):
        group = self.map_with("| brains | `common/high` |", "| brains | `common/` |")
        self.assertEqual(self.breaches(group), [])
        below = self.map_with("| high | `common/low` |", "| high | `node/` |")
        self.assertIn("ARCHITECTURE.md:9: node/ is no row above that of common/high", self.breaches(below))

    def test_a_row_is_of_a_folder(self):
        self.expect("ARCHITECTURE.md:9: there is no folder common/mid",
                    self.map_with("| `common/high` | high",
                                  "| `common/mid` | mid | – |\n| `common/high` | high"))

    def test_every_folder_has_a_row(self):
        self.expect("attic/old.cpp:1: the code map has no row for its folder",
                    {"attic/old.cpp": ""})

    def test_a_map_has_rows(self):
        found = self.breaches(self.map_with("## Code map", "## Map"))
        self.assertIn("ARCHITECTURE.md:1: there is no code map", found)

    def test_vendors_stay_at_home(self):
        self.expect("common/high/high.hpp:1: nlohmann/json.hpp is at home in "
                    "formats/json/parser.cpp, formats/json/cbor_parser.cpp, proto/",
                    {"common/high/high.hpp": "#include <nlohmann/json.hpp>\n"})

    def test_tests_know_catch_by_one_header(self):
        self.assertEqual(self.breaches({"tests/catch.hpp": "#include <catch2/catch.hpp>\n"}), [])
        self.expect('tests/low/low_test.cpp:1: catch2/catch.hpp: include "catch.hpp"',
                    {"tests/low/low_test.cpp": "#include <catch2/catch.hpp>\n"})

    def test_what_decides_knows_no_clock_thread_or_socket(self):
        for header in ("chrono", "thread", "sys/socket.h", "mutex", "unistd.h"):
            self.expect(f"common/high/high.hpp:1: {header}: no clocks, threads and sockets here",
                        {"common/high/high.hpp": f"#include <{header}>\n"})

    def test_what_reads_a_clock_for_others_is_a_clock_too(self):
        clocks = {"common/process/clocks.hpp": "",
                  **self.map_with("| `common/high`", "| `common/process` | clocks | – |\n"
                                  "| `common/high`"),
                  "node/node.cpp": '#include "process/clocks.hpp"\n'}
        self.assertIn("node/node.cpp:1: process/clocks.hpp: no clocks, threads and sockets here",
                      self.breaches(clocks))

    def test_a_header_of_a_brain_knows_no_clock_either(self):
        self.expect("node/node.hpp:2: chrono: no clocks, threads and sockets here",
                    {"node/node.hpp": '#include "high/high.hpp"\n#include <chrono>\n'})

    def test_a_brain_has_a_target(self):
        self.expect("node/CMakeLists.txt:1: there is no target graycube_node_brain",
                    {"node/CMakeLists.txt": "add_library(brain STATIC node.cpp)\n"})

    def test_an_exception_is_one_as_long_as_it_is_needed(self):
        clock = {"common/high/high.hpp": "#include <chrono>\n"}
        self.assertEqual(self.breaches(clock, ["common/high/high.hpp"]), [])
        self.assertEqual(
            self.breaches({}, ["common/high/high.hpp"]),
            ["common/high/high.hpp:1: is no exception any more: take it out of tidy.py"])

    def test_no_folder_is_crowded(self):
        many = {f"common/low/low_{i}.hpp": "" for i in range(tidy.MAX_FILES - 1)}
        self.assertEqual(self.breaches(many), [])
        self.expect(f"common/low:1: holds {tidy.MAX_FILES + 1} files, {tidy.MAX_FILES} at most",
                    {**many, "common/low/one_more.hpp": ""})

    def test_messages_and_cases_are_no_crowd(self):
        many = {f"proto/schema/{i}.json": "" for i in range(tidy.MAX_FILES + 1)}
        self.assertEqual(self.breaches(many), [])

    def test_a_link_leads_somewhere(self):
        self.expect("README.md:1: the link docs/attic.md leads nowhere",
                    {"README.md": "# [It](docs/attic.md), [us](https://a.b/c)\n## First steps\n"})

    def test_a_link_leads_to_a_heading(self):
        self.expect("ARCHITECTURE.md:14: the link README.md#first-steps leads to no heading",
                    {"README.md": "# House\n## Second steps\n"})

    def test_a_document_names_files_that_are_there(self):
        self.expect("README.md:3: there is no low/lower.hpp",
                    {"README.md": "# House\n## First steps\n`low/low.hpp`, `low/lower.hpp`\n"})

    def test_first_pages_stay_short(self):
        for page, most in tidy.MAX_BYTES.items():
            room = most - len(HOUSE[page].encode())
            self.assertEqual(self.breaches({page: HOUSE[page] + "…" * (room // 3)}), [])
            longer = HOUSE[page] + "." * (room + 1)
            self.expect(f"{page}:1: has {most + 1} bytes, {most} at most", {page: longer})

    def test_every_page_of_docs_is_linked(self):
        page = {"docs/lab/trial.md": "# A trial\n\n[Here](trial.md).\n"}
        self.expect("docs/lab/trial.md:1: no document links it", page)
        lab = {"docs/lab.md": "[Trial](lab/trial.md#a-trial)\n",
               "README.md": HOUSE["README.md"] + "[Lab](docs/lab.md), ![plot](docs/plot.svg)\n",
               "docs/plot.svg": ""}
        self.assertEqual(self.breaches({**page, **lab}), [])

    def test_every_control_message_is_described_and_has_an_example(self):
        house = {
            "proto/schema/all_whole.schema.json": "{}",
            "proto/schema/failed.schema.json": "{}",
            "proto/FORMAT.md": "| `all_whole` | job |\n\nIt may be answered by `failed` {job}.\n",
            "tests/proto/control_examples.hpp": "control::AllWhole{7};\ncontrol::Failed f;\n",
        }
        self.assertEqual(self.breaches(house), [])
        self.expect("proto/schema/all_whole.schema.json:1: proto/FORMAT.md has no row of "
                    "`all_whole`", {**house, "proto/FORMAT.md": "`failed`: `all_whole`\n"})
        self.expect("proto/schema/failed.schema.json:1: tests/proto/control_examples.hpp has no "
                    "example of a Failed",
                    {**house, "tests/proto/control_examples.hpp": "AllWhole{7}; FailedToo f;\n"})

    def test_files_stay_short(self):
        line = "// ?\n"
        self.assertEqual(
            self.breaches({"common/high/long.hpp": line * sources.MAX_LINES}), [])
        self.expect("common/high/long.hpp:401: is longer than 400 lines",
                    {"common/high/long.hpp": line * (sources.MAX_LINES + 1)})

    def test_lines_stay_narrow(self):
        wide = "// " + "é" * (sources.MAX_COLUMNS - 3)
        self.assertEqual(self.breaches({"common/high/wide.hpp": wide + "\n"}), [])
        self.expect("common/high/wide.hpp:2: is wider than 100 columns",
                    {"common/high/wide.hpp": "\n" + wide + "e\n"})

    @unittest.skipUnless(format.program(), "there is no clang-format of that version")
    def test_sources_are_formatted(self):
        with tempfile.TemporaryDirectory() as root:
            for name, text in ((".clang-format", "BasedOnStyle: Google\n"),
                               ("good.hpp", "int a = 1;\n"), ("bad.hpp", "int  a=1;\n")):
                with open(os.path.join(root, name), "w", encoding="utf-8") as file:
                    file.write(text)
            found = format.unformatted(root)
        self.assertTrue(found)
        self.assertTrue(all("bad.hpp" in line for line in found), found)

    def test_experiments_are_no_crowd(self):
        many = {f"docs/lab/{i}.md": "" for i in range(tidy.MAX_FILES + 1)}
        index = "".join(f"[{i}](docs/lab/{i}.md)\n" for i in range(tidy.MAX_FILES + 1))
        self.assertEqual(self.breaches({**many, "README.md": HOUSE["README.md"] + index}), [])


if __name__ == "__main__":
    unittest.main()
