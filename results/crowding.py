#!/usr/bin/env python3
"""Which small scenes are traced in registers, and how fast: results/crowding.json, crowding_fast.json.

Times of frames of random spheres in a cube whose squared radii add up to `cover`: one thread, lists.
Runs alternate with the streams of the general kernel. With BEFORE they are in the default mode and
alternate also with an earlier build that traces all these scenes in registers; without it they are
in `fast` mode.

usage: results/crowding.py BUILD [BEFORE [REPETITIONS]]
BUILD and BEFORE are build folders with `packtrace`.
"""
import itertools
import json
import statistics
import subprocess
import sys
import tempfile

from provenance import commit_of_build, machine, write
from ratios import by_turns, frame_milliseconds, share

COUNTS = (4, 8, 16, 32)
COVERS = (1, 2, 4, 8)
IN_REGISTERS = "in registers, from the eye"


def make(build, scene, count, cover, mirror):
    subprocess.run([f"{build}/packtrace", "generate", "random", "--count", str(count), "--radius",
                    f"{(cover / count) ** 0.5:.6f}", "--reflective", str(mirror), "-o", scene], check=True,
                   capture_output=True)


def is_in_registers(build, scene):
    done = subprocess.run([f"{build}/packtrace", "info", scene], check=True, capture_output=True, text=True)
    return IN_REGISTERS in done.stdout


def ways_of(build, before):
    """The builds and options to compare, by name."""
    by_list = ["--traversal", "list"] if before else ["--traversal", "list", "--accuracy", "fast"]
    ways = {"now": (build, by_list), "streams": (build, [*by_list, "--force-general"])}
    if before:
        ways["registers"] = (before, by_list)
    return ways


def row_of(times):
    row = {way: statistics.median(found) for way, found in times.items()}
    row["streams_over_now"] = share(times["streams"], times["now"])
    if "registers" in times:
        row["streams_over_registers"] = share(times["streams"], times["registers"])
        row["registers_over_now"] = share(times["registers"], times["now"])
    return row


def main():
    if len(sys.argv) not in (2, 3, 4):
        sys.exit(__doc__)
    build, before, repetitions = [*sys.argv[1:], None, None][:3]
    ways = ways_of(build, before)
    repetitions = int(repetitions or 9)
    report = {"command": f"results/crowding.py build/release{' BEFORE' if before else ''}",
              "commit": commit_of_build(build), "before": commit_of_build(before) if before else None,
              "machine": machine(), "repetitions": repetitions, "rows": []}
    with tempfile.TemporaryDirectory() as folder:
        scene = f"{folder}/scene.scene"
        for mirror, cover, count in itertools.product((0, 0.4), COVERS, COUNTS):
            make(build, scene, count, cover, mirror)
            for isa in ("avx512", "avx2"):
                times = by_turns(ways, repetitions,
                                 lambda way: frame_milliseconds(way[0], scene, 512, isa, folder, way[1]))
                row = {"spheres": count, "cover": cover, "mirror": mirror, "isa": isa, **row_of(times)}
                if before:
                    row["in_registers"] = is_in_registers(build, scene)
                print(json.dumps(row))
                report["rows"].append(row)
    report["machine_after"] = machine()
    write(report, "crowding.json" if before else "crowding_fast.json")


if __name__ == "__main__":
    main()
