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
"""
# Descriptions begin at column 30; what names an option, further left.
CONTINUED = 20


def help_of(program, command):
    done = subprocess.run([program, *command, "--help"], capture_output=True, text=True, check=True)
    return done.stdout


def entries(lines):
    """[name, description] of each option or command under a heading."""
    found = []
    for line in lines:
        if not line.strip():
            continue
        if len(line) - len(line.lstrip()) >= CONTINUED:
            found[-1][1] = f"{found[-1][1]} {line.strip()}".strip()
            continue
        name, _, description = re.sub(r"^(-\w), *--", r"\1, --", line.strip()).partition("  ")
        found.append([name, description.strip()])
    return found


def parts(text):
    """What the command does, and the entries below each heading, whose case CLI11 2.5 changed."""
    sections = re.split(r"^(Positionals|Options|Subcommands):\n", text,
                        flags=re.MULTILINE | re.IGNORECASE)
    headings = {name.capitalize(): entries(body.splitlines())
                for name, body in zip(sections[1::2], sections[2::2])}
    return sections[0].splitlines()[0].strip(), headings


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
        text += "\n| argument | meaning |\n| --- | --- |\n" + "".join(
            f"| `{cell(name).replace(' REQUIRED', '')}`{' (required)' if 'REQUIRED' in name else ''} "
            f"| {cell(meaning)} |\n" for name, meaning in rows)
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
