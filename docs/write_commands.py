#!/usr/bin/env python3
"""Writes docs/commands.md, the reference of all commands, from the --help of both programs.

Usage: docs/write_commands.py [--check] [PROGRAM [PAGE [MPI_PROGRAM]]]

--check writes nothing, and exits 1 if the page differs from the output of the programs. The default
of PROGRAM is the packtrace of ./run build, that of MPI_PROGRAM the packtrace-mpi beside PROGRAM, which
runs without mpirun. A build without MPI has no packtrace-mpi: then the page's part on packtrace-mpi
stays unchanged, and --check ignores it.
"""
import difflib
import os
import pathlib
import re
import subprocess
import sys

DOCS = pathlib.Path(__file__).resolve().parent
HEAD = """# Commands

All commands of `packtrace` and of [`packtrace-mpi`](#packtrace-mpi) with their options, as `--help` of each prints them. `docs/write_commands.py` writes this page.
`packtrace completion bash` (or `zsh`, `fish`), which `--help` does not list, prints the completions of that shell.
"""
# The start of the page's part on packtrace-mpi.
MPI_HEADING = "\n## packtrace-mpi\n"
MPI_HEAD = MPI_HEADING + """
The work of `packtrace` on many ranks ([cluster](cluster.md)), in builds with MPI: `mpirun -n 8 packtrace-mpi render SCENE -o IMAGE`.
SCENE is a file, - for standard input, or `'generate NAME OPTION...'`, which each rank generates by itself.
"""
# Descriptions begin at column COLUMN; the names of options, left of column CONTINUED.
COLUMN = 30
CONTINUED = 20


def help_of(program, command):
    # For its help, a process of Open MPI without mpirun needs no second process.
    environment = os.environ | {"OMPI_MCA_ess_singleton_isolated": "1"}
    done = subprocess.run([program, *command, "--help"], capture_output=True, text=True, check=True,
                          env=environment)
    return done.stdout


def is_continued(line):
    return len(line) - len(line.lstrip()) >= CONTINUED


def entries(lines):
    """[name, description] of each option or command below a heading."""
    found = []
    lines = [line for line in lines if line.strip()]
    for line, following in zip(lines, [*lines[1:], ""]):
        if is_continued(line):
            found[-1][1] = f"{found[-1][1]} {line.strip()}".strip()
            continue
        # At least two spaces precede a description, or one if the name just fits.
        fits = (len(line) > COLUMN and line[COLUMN - 1] == " " and line[COLUMN] != " "
                and not is_continued(following))
        name, description = ((line[:COLUMN], line[COLUMN:]) if fits
                             else re.split(r"(?<=\S\S)  |$", line.rstrip(), maxsplit=1)[:2])
        found.append([re.sub(r"^(-\w), *--", r"\1, --", name.strip()), description.strip()])
    return found


def parts(text):
    """The command's purpose, and the entries below each heading. CLI11 2.5 changed the headings' case."""
    sections = re.split(r"^(Positionals|Options|Subcommands):\n", text,
                        flags=re.MULTILINE | re.IGNORECASE)
    headings = {name.capitalize(): entries(body.splitlines())
                for name, body in zip(sections[1::2], sections[2::2])}
    return sections[0].splitlines()[0].strip(), headings


def row(name, meaning):
    """A line of the table. Beside an option's name CLI11 lists the options that it excludes."""
    name, _, excluded = name.partition(" Excludes: ")
    required = " (required)" if " REQUIRED" in name else ""
    if excluded:
        meaning += f"; not with {excluded}"
    return f"| `{cell(name).replace(' REQUIRED', '')}`{required} | {cell(meaning)} |\n"


def cell(text):
    return re.sub(r"\s+", " ", text).replace("|", r"\|")


def section(program, name, command, level):
    """The part of the page on this command of the program called `name`, and on its subcommands."""
    what, headings = parts(help_of(program, command))
    options = [(name, text) for name, text in headings.get("Options", []) if "--help" not in name]
    rows = headings.get("Positionals", []) + options
    text = ""
    if command:
        text = f"\n{'#' * level} {name} {' '.join(command)}\n\n{what}.\n"
    if rows:
        text += "\n| argument | meaning |\n| --- | --- |\n" + "".join(row(*each) for each in rows)
    for subcommand, _ in headings.get("Subcommands", []):
        text += section(program, name, [*command, subcommand], level + 1)
    return text


def mpi_part(page):
    """The page's part on packtrace-mpi; empty if it has no such part."""
    _, heading, text = page.partition(MPI_HEADING)
    return heading + text


def program_beside(program):
    """The packtrace-mpi of the same build, if it has one."""
    beside = pathlib.Path(program).with_name("packtrace-mpi")
    return beside.resolve() if beside.exists() else None


def main():
    arguments = [argument for argument in sys.argv[1:] if argument != "--check"]
    program = arguments[0] if arguments else DOCS.parent / "build/release/packtrace"
    page = pathlib.Path(arguments[1]) if len(arguments) > 1 else DOCS / "commands.md"
    mpi_program = arguments[2] if len(arguments) > 2 else program_beside(program)

    before = page.read_text() if page.exists() else ""
    text = HEAD + section(program, "packtrace", [], 1)
    if mpi_program:
        text += MPI_HEAD + section(mpi_program, "packtrace-mpi", [], 2)
    else:
        text += mpi_part(before)
    if "--check" not in sys.argv:
        page.write_text(text)
        return 0
    if before == text:
        return 0
    sys.stdout.writelines(difflib.unified_diff(before.splitlines(True), text.splitlines(True),
                                               str(page), "what --help says"))
    print(f"{page} is out of date: run docs/write_commands.py")
    return 1


if __name__ == "__main__":
    sys.exit(main())
