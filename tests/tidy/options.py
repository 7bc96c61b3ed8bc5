"""options.py GRAYCUBE ROOT: holds every place that tells of options against `--help`.

GRAYCUBE is the command. Of each of its commands the man page, what bash, zsh and fish complete, and the
first columns of the tables in its section of ROOT/docs/manual.md must name the options that the command's
help names, and no others. Prints a line for each breach, and fails if there is one.
"""

import os
import re
import subprocess
import sys

# An option's names at the beginning of a line; CLI11 puts a space behind the comma or not, by its version.
HEAD = re.compile(r"^ +(-\S+(?:, +-\S+)*)", re.MULTILINE)
OPTION = re.compile(r"(?<![\w-])--?[a-zA-Z][\w-]*")


def command_names(help_text):
    """The subcommands that `graycube --help` lists."""
    listed = re.split("subcommands:", help_text, maxsplit=1, flags=re.IGNORECASE)[-1]
    return re.findall(r"^  ([a-z][\w-]*)  ", listed, re.MULTILINE)


def help_options(help_text):
    """The options at the beginnings of a help's lines."""
    return {name for head in HEAD.findall(help_text) for name in OPTION.findall(head)}


def man_options(page, command):
    """Options of a command's section; what every command takes is told once, below them."""
    section = re.search(rf"^\.SS {re.escape(command)}\n(.*?)(?=^\.S[SH] |^\.PP\nEvery)", page,
                        re.MULTILINE | re.DOTALL)
    heads = re.findall(r"^\.TP\n(.*)$", section[1] if section else "", re.MULTILINE)
    plain = re.sub(r"\\f[BIR]", "", "\n".join(heads)).replace("\\-", "-")
    return set(OPTION.findall(plain)) | {"-h", "--help"}


def bash_options(script, command):
    """What bash offers behind a dash."""
    offer = ('COMP_WORDS=(graycube "$1" -); COMP_CWORD=2; _graycube graycube - "$1"; '
             'printf "%s\\n" "${COMPREPLY[@]}"')
    done = subprocess.run(["bash", "-c", script + "\n" + offer, "bash", command], check=True,
                          capture_output=True, text=True)
    return set(done.stdout.split())


def zsh_options(script, command):
    section = re.search(rf"^    {re.escape(command)}\)\n(.*?)^      ;;", script,
                        re.MULTILINE | re.DOTALL)
    specs = re.findall(r"^ +'(?:\*|\([^)]*\))(-[\w-]+)\[", section[1] if section else "",
                       re.MULTILINE)
    helps = "'(-h --help)'{-h,--help}'[" in (section[1] if section else "")
    return set(specs) | ({"-h", "--help"} if helps else set())


def fish_options(script, command):
    lines = [line for line in script.splitlines()
             if f"'__fish_seen_subcommand_from {command}'" in line]
    options = {"--" + name for line in lines for name in re.findall(r" -l (\S+)", line)}
    options |= {"-" + name for line in lines for name in re.findall(r" -s (\S+)", line)}
    return options | ({"-h", "--help"} if "-s h -l help" in script else set())


def manual_options(text):
    """Options in the first columns of tables that begin with a column of options."""
    options, is_table_of_options = set(), False
    for line in text.splitlines():
        if not line.startswith("|"):
            is_table_of_options = False
            continue
        first = line.strip("|").split("|")[0].strip()
        if re.fullmatch(r"options?", first, re.IGNORECASE):
            is_table_of_options = True
        elif is_table_of_options:
            for code in re.findall(r"`([^`]*)`", first):
                options |= set(OPTION.findall(code))
    return options


def compared(place, told, options):
    breaches = [f"{place} lacks {name}" for name in sorted(options - told)]
    return breaches + [f"{place} has {name}, which --help has not" for name in sorted(told - options)]


def breaches_of_command(texts, manual, command):
    options = help_options(texts["help"][command])
    breaches = compared(f"{command}: the man page", man_options(texts["man"], command), options)
    for shell, options_of in (("bash", bash_options), ("zsh", zsh_options), ("fish", fish_options)):
        told = options_of(texts[shell], command)
        breaches += compared(f"{command}: completion of {shell}", told, options)
    if manual:
        breaches += breaches_of_manual(manual, command, texts["help"][command])
    return breaches


def breaches_of_manual(manual, command, help_text):
    """The manual's section of a command tells of each option by one of its names at least."""
    section = re.search(rf"^## {re.escape(command)}\n(.*?)(?=^## |\Z)", manual,
                        re.MULTILINE | re.DOTALL)
    if not section:
        return [f"{command}: docs/manual.md has no section of it"]
    told, known = manual_options(section[1]), help_options(help_text)
    breaches = []
    for head in HEAD.findall(help_text):
        names = OPTION.findall(head)
        if "--help" not in names and not set(names) & told:
            breaches.append(f"{command}: docs/manual.md lacks {', '.join(names)}")
    return breaches + [f"{command}: docs/manual.md has {name}, which --help has not"
                       for name in sorted(told - known)]


def texts_of(graycube):
    def printed(*arguments):
        return subprocess.run([graycube, *arguments], check=True, capture_output=True,
                              text=True).stdout
    commands = command_names(printed("--help"))
    texts = {shell: printed("completion", shell) for shell in ("bash", "zsh", "fish")}
    texts["help"] = {command: printed(command, "--help") for command in commands}
    texts["man"] = printed("man-page")
    return texts


def breaches_of(texts, manual):
    breaches = [] if texts["help"] else ["--help lists no commands"]
    for command in texts["help"]:
        breaches += breaches_of_command(texts, manual, command)
    return breaches


def main(graycube, root):
    path = os.path.join(root, "docs", "manual.md")
    manual = ""
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            manual = file.read()
    found = breaches_of(texts_of(graycube), manual)
    print("\n".join(found) if found else "all tell of the same options")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2]))
