#!/usr/bin/env python3
"""Writes results/soak.json: random scenes traced in every way, in parts. Continues after the last part
in the file. The cause and the fix of a finding are entered by hand.

usage: results/soak.py build/release/packtrace MINUTES [SEED [THREADS]]
"""
import pathlib
import re
import subprocess
import sys
import time

from provenance import FOLDER, commit, kept, machine, write

MINUTES_OF_A_PART = 10
CASES = FOLDER.parent / "build/soak_cases"
COUNTS = re.compile(r"^(\d+) scenes, (\d+) of them refused by the scene language, \d+ findings?$", re.M)
FINDING = re.compile(r"^scene (\d+): (.*)$", re.M)


def part_of(output, first, seconds, built):
    """The counts of a run of `packtrace soak`, and its findings."""
    scenes, refused = map(int, COUNTS.search(output).groups())
    part = {"commit": built, "first": first, "scenes": scenes, "refused": refused,
            "seconds": round(seconds)}
    found = [{"scene": int(number), "what": what, "cause": "", "mended": ""}
             for number, what in FINDING.findall(output)]
    return part, found


def run_part(program, seed, first, minutes, threads):
    started = time.monotonic()
    done = subprocess.run([program, "soak", "--seed", str(seed), "--first", str(first), "--minutes",
                           str(minutes), "--findings", "1000", "--cases", CASES, *threads],
                          stdout=subprocess.PIPE, text=True)
    if not COUNTS.search(done.stdout):
        sys.exit(f"soak.py: packtrace soak ended with exit code {done.returncode}, without its counts")
    return part_of(done.stdout, first, time.monotonic() - started, commit())


def report_of(seed):
    report = kept("soak.json")
    if report.get("seed") != seed:
        report = {"seed": seed, "parts": [], "findings": []}
    return report


def add(report, part, found):
    report |= {"commit": part["commit"], "machine": machine()}
    report["parts"].append(part)
    report["findings"] += found
    write(report, "soak.json")


def main():
    if len(sys.argv) not in (3, 4, 5):
        sys.exit(__doc__)
    program, left = pathlib.Path(sys.argv[1]).resolve(), float(sys.argv[2])
    report = report_of(int(sys.argv[3]) if len(sys.argv) > 3 else 4242)
    threads = ["--threads", sys.argv[4]] if len(sys.argv) > 4 else []
    commit()
    CASES.mkdir(parents=True, exist_ok=True)
    while left > 0:
        first = max((part["first"] + part["scenes"] for part in report["parts"]), default=0)
        part, found = run_part(program, report["seed"], first, min(left, MINUTES_OF_A_PART),
                               threads)
        add(report, part, found)
        print(f"{part['scenes']} scenes from {first}, {len(found)} findings", flush=True)
        left -= MINUTES_OF_A_PART


if __name__ == "__main__":
    main()
