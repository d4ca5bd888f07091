#!/usr/bin/env python3
"""Writes the blocks of README.md and docs/ that come from files, and checks them.

Usage: docs/write_figures.py [--check] [ROOT]

A block is between <!-- from FILE --> and <!-- end -->. FILE is a source of examples/, or a file
of results/ with the name of one of its tables (result_tables.py): <!-- from results/peers.json: rates -->.

--check writes nothing. It exits 1 and names every fault:
  - a block differs from the contents of its file;
  - a page cites a file of results/ that is missing;
  - a page states a measured figure in a section that names no file of results/;
  - a result does not name a clean commit, and results/unsigned.json does not list it with a reason;
  - results/unsigned.json lists a file that is signed, or that is missing.
A paragraph or table below <!-- not measured: REASON --> may state figures without a file.
"""
import json
import pathlib
import re
import sys

from result_tables import TABLES

BLOCK = re.compile(r"(<!-- from (?P<source>[^>]+?) -->\n).*?(<!-- end -->\n)", re.DOTALL)
CITED = re.compile(r"results/[\w./-]*\w\.(?:json|md|csv|txt|py|sh)")
# A number with a unit of time or rate, or a ratio of speeds.
FIGURE = re.compile(r"\d\s?(?:ms|µs|ns)\b|\d\s?(?:×|times) (?:as (?:fast|long)|faster|slower)"
                    r"|\d (?:M|million )rays(?:/s| a second)|\d million a second")
EXCEPTIONS = "results/unsigned.json"


def pages(root):
    return [root / "README.md", root / "CONTRIBUTING.md", *sorted((root / "docs").glob("*.md"))]


def content_of(root, source):
    """The contents of a block from this source. Raises ValueError if the source is missing or unknown."""
    path = root / source.split(":")[0]
    if not path.is_file():
        raise ValueError(f"{source.split(':')[0]} is missing")
    if source in TABLES:
        return "\n" + TABLES[source](json.loads(path.read_text())) + "\n\n"
    if source.startswith("examples/"):
        lines = path.read_text().splitlines()
        while lines and lines[0].startswith("//"):
            del lines[0]
        language = {".cpp": "cpp", ".py": "python", ".sh": "sh"}[path.suffix]
        return f"```{language}\n" + "\n".join(lines) + "\n```\n"
    raise ValueError(f"no table is called '{source}'; docs/result_tables.py has "
                     + ", ".join(sorted(TABLES)))


def renewed(root, text):
    return BLOCK.sub(lambda block: block[1] + content_of(root, block["source"]) + block[3], text)


def stale_blocks(root, page, text):
    for block in BLOCK.finditer(text):
        try:
            expected = block[1] + content_of(root, block["source"]) + block[3]
        except ValueError as error:
            yield f"{page}: {error}"
            continue
        if block[0] != expected:
            differing = next((line for line, wanted in zip(block[0].splitlines(),
                                                           expected.splitlines())
                              if line != wanted), "its number of lines")
            yield (f"{page}: the block from {block['source']} is not what the file gives: "
                   f"{differing}; run docs/write_figures.py")
    if text.count("<!-- from ") != len(BLOCK.findall(text)):
        yield f"{page}: a block '<!-- from … -->' has no '<!-- end -->'"


def missing_files(root, page, text):
    for cited in sorted(set(CITED.findall(text))):
        if not (root / cited).is_file():
            yield f"{page}: cites {cited}, which is missing"


def figures_without_file(page, text):
    sections = re.split(r"^(?=#+ )", BLOCK.sub("", re.sub(r"```.*?```", "", text, flags=re.DOTALL)),
                        flags=re.MULTILINE)
    for section in sections:
        if CITED.search(section):
            continue
        excused = False
        for paragraph in section.split("\n\n"):
            excused = excused or "<!-- not measured: " in paragraph
            figure = FIGURE.search(paragraph)
            if figure and not excused:
                line = paragraph[:figure.end()].splitlines()[-1].strip()
                yield f"{page}: no file of results/ stands beside the figure '…{line[-60:]}'"
            excused = paragraph.rstrip().endswith("-->") and excused


def results(root):
    return sorted([*(root / "results").glob("*.json"), *(root / "results").glob("*/*.json")])


def commit_of(report):
    for part in (report, report.get("context", {}), report.get("conditions", {})):
        if isinstance(part, dict) and "commit" in part:
            return part["commit"]
    return None


def wrong_signatures(root):
    exceptions = json.loads((root / EXCEPTIONS).read_text())
    for path in results(root):
        name = str(path.relative_to(root))
        if name == EXCEPTIONS:
            continue
        commit = commit_of(json.loads(path.read_text()))
        signed = commit is not None and re.fullmatch(r"[0-9a-f]{7,40}", commit)
        if not signed and name not in exceptions:
            fault = f"is signed '{commit}'" if commit else "names no commit"
            yield f"{name}: {fault}; measure it from a clean tree, or list it in {EXCEPTIONS}"
        if signed and name in exceptions:
            yield f"{EXCEPTIONS}: {name} is signed by a clean commit; take it off the list"
    for name in exceptions:
        if not (root / name).is_file():
            yield f"{EXCEPTIONS}: {name} is missing; take it off the list"


def faults(root):
    for path in pages(root):
        text, page = path.read_text(), path.relative_to(root)
        yield from stale_blocks(root, page, text)
        yield from missing_files(root, page, text)
        yield from figures_without_file(page, text)
    yield from wrong_signatures(root)


def main():
    arguments = [argument for argument in sys.argv[1:] if argument != "--check"]
    root = pathlib.Path(arguments[0] if arguments else pathlib.Path(__file__).parents[1]).resolve()
    if "--check" in sys.argv:
        found = list(faults(root))
        print("\n".join(found) if found else "every figure is its file's")
        return 1 if found else 0
    for path in pages(root):
        try:
            path.write_text(renewed(root, path.read_text()))
        except ValueError as error:
            sys.exit(f"{path.relative_to(root)}: {error}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
