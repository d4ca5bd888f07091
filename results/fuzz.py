#!/usr/bin/env python3
"""Writes results/fuzz.json: how many inputs each fuzzer of tests/fuzz tried. Adds to the counts in
the file, which may be of earlier commits. The causes of findings are entered by hand.

usage: results/fuzz.py MINUTES [AT_ONCE]

Build the fuzzers first (`./run fuzz 1`). AT_ONCE of them (default 2) run side by side.
"""
import concurrent.futures
import pathlib
import re
import subprocess
import sys
import threading
import time

from provenance import FOLDER, commit, kept, machine, write

ROOT = FOLDER.parent
SECONDS_OF_A_PART = 150
COUNT = re.compile(r"^(\w+): (\d+) inputs, no finding$", re.M)
EXECUTED = re.compile(r"^stat::number_of_executed_units: *(\d+)", re.M)


def names():
    return sorted(path.stem.removeprefix("fuzz_") for path in (ROOT / "tests/fuzz").glob("fuzz_*.cpp"))


def run_part(name):
    """The number of inputs a fuzzer tries in one part, the seconds, and its message if it fails."""
    started = time.monotonic()
    done = subprocess.run([ROOT / "tests/fuzz/run_fuzzers.sh", "--only", name,
                           ROOT / "build/fuzz/tests/fuzz", str(SECONDS_OF_A_PART)],
                          capture_output=True, text=True)
    seconds = round(time.monotonic() - started)
    tried = COUNT.search(done.stdout)
    if tried:
        return int(tried.group(2)), seconds, None
    log = (ROOT / f"build/fuzzed/{name}.log").read_text(errors="replace")
    return sum(map(int, EXECUTED.findall(log))), seconds, done.stderr.strip()


def add(report, built, name, tried, seconds, finding):
    key = {"fuzzer": name, "commit": built}
    part = next((p for p in report["parts"] if key.items() <= p.items()), None)
    if part is None:
        part = key | {"inputs": 0, "seconds": 0}
        report["parts"].append(part)
    part["inputs"] += tried
    part["seconds"] += seconds
    if finding:
        report["findings"].append(key | {"what": finding, "cause": "", "mended": ""})
    report |= {"commit": built, "machine": machine()}
    write(report, "fuzz.json")


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    report = kept("fuzz.json") or {"parts": [], "findings": []}
    at_once = int(sys.argv[2]) if len(sys.argv) == 3 else 2
    rounds = float(sys.argv[1]) * 60 * at_once / SECONDS_OF_A_PART / len(names())
    built, lock = commit(), threading.Lock()

    def one(name):
        tried, seconds, finding = run_part(name)
        with lock:
            add(report, built, name, tried, seconds, finding)
            print(f"{name}: {tried} inputs{', ' + finding if finding else ''}", flush=True)

    with concurrent.futures.ThreadPoolExecutor(at_once) as pool:
        list(pool.map(one, names() * max(1, round(rounds))))


if __name__ == "__main__":
    main()
