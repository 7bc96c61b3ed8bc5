"""Leaves options out of each place that options.py compares, and expects to be told of it."""

import unittest

import options

HELP = """Usage: graycube render [OPTIONS] SCENE

Options:
  -h,--help                   Print this help
  -o,--output OUT.exr         The picture, and not --that
  --wait                      Wait
"""
MAN = """.SS render
.TP
\\fISCENE\\fR
A scene
.TP
\\fB\\-o\\fR, \\fB\\-\\-output\\fR \\fIOUT.exr\\fR
The picture
.TP
\\fB\\-\\-wait\\fR
Wait
.PP
Every command also takes
.SH EXIT STATUS
"""
BASH = "_graycube() { COMPREPLY=(-h --help -o --output --wait); }"
ZSH = """    render)
      _arguments \\
        '(-o --output)-o[The picture]:OUT.exr:_files' \\
        '(-o --output)--output[The picture]:OUT.exr:_files' \\
        '*--wait[Wait]' \\
        '(-h --help)'{-h,--help}'[Print the help]'
      ;;
"""
FISH = """complete -c graycube -s h -l help -d 'Print the help'
complete -c graycube -n '__fish_seen_subcommand_from render' -s o -l output -r -F -d 'The picture'
complete -c graycube -n '__fish_seen_subcommand_from render' -l wait -d 'Wait'
"""
MANUAL = """## render

| option | what |
|---|---|
| `-o OUT.exr` | The picture |
| `--wait` | As `--nothing` |

| other | what |
|---|---|
| `--unrelated` | |

## up

| option |
|---|
| `--listen` |
"""


class OptionsTest(unittest.TestCase):
    def breaches(self, manual=MANUAL, **changes):
        texts = {"help": {"render": HELP}, "man": MAN, "bash": BASH, "zsh": ZSH, "fish": FISH}
        return options.breaches_of({**texts, **changes}, manual)

    def test_where_all_agree_there_is_no_breach(self):
        self.assertEqual(self.breaches(), [])
        self.assertEqual(self.breaches(manual=""), [])

    def test_what_one_place_lacks_is_found(self):
        self.assertEqual(self.breaches(man=MAN.replace("\\fB\\-\\-wait\\fR", "wait")),
                         ["render: the man page lacks --wait"])
        self.assertEqual(self.breaches(bash=BASH.replace(" -o ", " ")),
                         ["render: completion of bash lacks -o"])
        self.assertEqual(self.breaches(zsh=ZSH.replace("'*--wait[Wait]'", "")),
                         ["render: completion of zsh lacks --wait"])
        self.assertEqual(self.breaches(fish=FISH.replace("-l wait", "")),
                         ["render: completion of fish lacks --wait"])
        self.assertEqual(self.breaches(manual=MANUAL.replace("-o OUT", "OUT")),
                         ["render: docs/manual.md lacks -o, --output"])

    def test_what_help_does_not_know_is_found(self):
        self.assertEqual(self.breaches(fish=FISH.replace("-l wait", "-l wait -l old")),
                         ["render: completion of fish has --old, which --help has not"])
        self.assertEqual(self.breaches(manual=MANUAL.replace("--wait", "--wait`, `--old")),
                         ["render: docs/manual.md has --old, which --help has not"])

    def test_a_command_has_a_section_in_the_manual(self):
        self.assertEqual(self.breaches(manual=MANUAL.replace("## render", "## rendering")),
                         ["render: docs/manual.md has no section of it"])

    def test_help_lists_commands(self):
        self.assertEqual(options.command_names("Options:\n  -h  x\n\nSubcommands:\n"
                                               "  render                      Render\n"
                                               "  man-page                    Print\n"),
                         ["render", "man-page"])
        self.assertEqual(self.breaches(help={}, manual=""), ["--help lists no commands"])


if __name__ == "__main__":
    unittest.main()
