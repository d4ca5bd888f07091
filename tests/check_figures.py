"""check_figures.py ROOT: every figure in the documents agrees with its file, and the check detects
figures that do not. The test plants faults one by one in a copy of the documents and results."""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(sys.argv[1]).resolve()


def check(root):
    """The exit code and the output of the check."""
    done = subprocess.run([sys.executable, "-B", ROOT / "docs/write_figures.py", "--check", root],
                          capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def rewrite(path, change):
    text = path.read_text()
    changed = change(text)
    assert changed != text, f"nothing to change in {path}"
    path.write_text(changed)


def change_digit(copy):
    """Changes the first digit in the last row of a table of docs/peers.md."""
    def change(text):
        end = text.index("<!-- end -->")
        row = text.rindex("\n|", 0, end)
        place = re.compile(r"\d\.\d").search(text, row).start()
        return text[:place] + str((int(text[place]) + 1) % 10) + text[place + 1:]
    rewrite(copy / "docs/peers.md", change)


def change_result(copy):
    rewrite(copy / "results/exact_cost.json", lambda text: text.replace('"commit": "', '"commit": "0'))


def sign(name, commit):
    def plant(copy):
        path = copy / name
        report = json.loads(path.read_text())
        report.get("context", report)["commit"] = commit
        path.write_text(json.dumps(report))
        if commit is None:
            rewrite(path, lambda text: text.replace('"commit": null', '"unsigned": null', 1))
    return plant


def add_to(name, text):
    return lambda copy: rewrite(copy / name, lambda before: before + text)


PLANTED = {
    "a changed digit in a table": (change_digit, "docs/peers.md: the block from results/peers.json"),
    "a changed result": (change_result, "the block from results/exact_cost.json"),
    "a deleted result": (lambda copy: (copy / "results/scaling.json").unlink(),
                         "results/scaling.json is missing"),
    "a deleted result that text alone cites": (
        lambda copy: (copy / "results/crossover.json").unlink(),
        "cites results/crossover.json, which is missing"),
    "a dirty signature": (sign("results/crossover.json", "8d95940-dirty"),
                          "results/crossover.json: is signed '8d95940-dirty'"),
    "no signature": (sign("results/crossover.json", None), "results/crossover.json: names no commit"),
    "an exception that is signed by now": (
        sign("results/feature_sets.json", "8d95940"),
        "results/feature_sets.json is signed by a clean commit; take it off the list"),
    "a figure without a file": (add_to("docs/faults.md", "\n## Speed\n\nIt takes 12 ms a frame.\n"),
                                "no file of results/ stands beside the figure"),
    "a changed sample": (
        lambda copy: rewrite(copy / "README.md", lambda text: text.replace("closest_hit(", "hit(")),
        "README.md: the block from examples/first_hit.cpp"),
    "a block of no file": (add_to("docs/faults.md", "\n<!-- from results/none.json: a -->\n<!-- end -->\n"),
                           "results/none.json is missing"),
    "a block without an end": (add_to("docs/faults.md", "\n<!-- from results/peers.json: rates -->\n"),
                               "has no '<!-- end -->'"),
}


def copied_to(folder):
    for name in ("docs", "results", "examples"):
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("*.png"))
    for name in ("README.md", "CONTRIBUTING.md"):
        shutil.copy(ROOT / name, folder)


def main():
    code, output = check(ROOT)
    if code != 0:
        sys.exit(output)
    for what, (plant, expected) in PLANTED.items():
        with tempfile.TemporaryDirectory() as name:
            copy = pathlib.Path(name)
            copied_to(copy)
            plant(copy)
            code, output = check(copy)
            if code != 1 or expected not in output:
                sys.exit(f"{what} is not found; the check exits {code} and says:\n{output}")


main()
