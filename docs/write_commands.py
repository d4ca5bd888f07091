#!/usr/bin/env python3
"""Writes docs/commands.md, the reference of all commands, from the program's --help.

Usage: docs/write_commands.py [--check] [PROGRAM [PAGE]]

--check writes nothing, and exits 1 where the page differs from what the program says. PROGRAM is by
default that of ./run build.
"""
import difflib
import pathlib
import re
import subprocess
import sys

DOCS = pathlib.Path(__file__).resolve().parent
HEAD = """# Commands

All commands of `packtrace` with their options, as `--help` of each prints them. `docs/write_commands.py` writes this page.
`packtrace completion bash` (or `zsh`, `fish`), which `--help` does not list, prints the completions of that shell.
"""
# Descriptions begin at this column; what names an option, left of the other.
COLUMN = 30
CONTINUED = 20


def help_of(program, command):
    done = subprocess.run([program, *command, "--help"], capture_output=True, text=True, check=True)
    return done.stdout


def is_continued(line):
    return len(line) - len(line.lstrip()) >= CONTINUED


def entries(lines):
    """[name, description] of each option or command under a heading."""
    found = []
    lines = [line for line in lines if line.strip()]
    for line, following in zip(lines, [*lines[1:], ""]):
        if is_continued(line):
            found[-1][1] = f"{found[-1][1]} {line.strip()}".strip()
            continue
        # At least two spaces stand before a description, or one where its name just fits.
        fits = (len(line) > COLUMN and line[COLUMN - 1] == " " and line[COLUMN] != " "
                and not is_continued(following))
        name, description = ((line[:COLUMN], line[COLUMN:]) if fits
                             else re.split(r"(?<=\S\S)  |$", line.rstrip(), maxsplit=1)[:2])
        found.append([re.sub(r"^(-\w), *--", r"\1, --", name.strip()), description.strip()])
    return found


def parts(text):
    """What the command does, and the entries below each heading, whose case CLI11 2.5 changed."""
    sections = re.split(r"^(Positionals|Options|Subcommands):\n", text,
                        flags=re.MULTILINE | re.IGNORECASE)
    headings = {name.capitalize(): entries(body.splitlines())
                for name, body in zip(sections[1::2], sections[2::2])}
    return sections[0].splitlines()[0].strip(), headings


def row(name, meaning):
    """A line of the table. CLI11 names what an option excludes beside its name."""
    name, _, excluded = name.partition(" Excludes: ")
    required = " (required)" if " REQUIRED" in name else ""
    if excluded:
        meaning += f"; not with {excluded}"
    return f"| `{cell(name).replace(' REQUIRED', '')}`{required} | {cell(meaning)} |\n"


def cell(text):
    return re.sub(r"\s+", " ", text).replace("|", r"\|")


def section(program, command):
    """This command's part of the page, and those of its subcommands."""
    what, headings = parts(help_of(program, command))
    options = [(name, text) for name, text in headings.get("Options", []) if "--help" not in name]
    rows = headings.get("Positionals", []) + options
    text = ""
    if command:
        text = f"\n{'#' * (1 + len(command))} packtrace {' '.join(command)}\n\n{what}.\n"
    if rows:
        text += "\n| argument | meaning |\n| --- | --- |\n" + "".join(row(*each) for each in rows)
    for name, _ in headings.get("Subcommands", []):
        text += section(program, [*command, name])
    return text


def main():
    arguments = [argument for argument in sys.argv[1:] if argument != "--check"]
    program = arguments[0] if arguments else DOCS.parent / "build/release/packtrace"
    page = pathlib.Path(arguments[1]) if len(arguments) > 1 else DOCS / "commands.md"
    text = HEAD + section(program, [])
    if "--check" not in sys.argv:
        page.write_text(text)
        return 0
    before = page.read_text()
    if before == text:
        return 0
    sys.stdout.writelines(difflib.unified_diff(before.splitlines(True), text.splitlines(True),
                                               str(page), "what --help says"))
    print(f"{page} is out of date: run docs/write_commands.py")
    return 1


if __name__ == "__main__":
    sys.exit(main())
