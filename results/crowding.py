#!/usr/bin/env python3
"""Which small scenes are traced in registers, and how fast: results/crowding.json.

Times of frames of random spheres in a cube whose squared radii add up to `cover`: one thread, lists,
default mode. Runs alternate with the streams of the general kernel and with an earlier build that
traces all these scenes in registers.

usage: results/crowding.py BUILD BEFORE [REPETITIONS]
BUILD and BEFORE are build folders with `packtrace`.
"""
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


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    by_list = ["--traversal", "list"]
    ways = {"now": (sys.argv[1], by_list), "streams": (sys.argv[1], [*by_list, "--force-general"]),
            "registers": (sys.argv[2], by_list)}
    repetitions = int(sys.argv[3]) if len(sys.argv) == 4 else 9
    report = {"command": "results/crowding.py build/release BEFORE", "commit": commit_of_build(sys.argv[1]),
              "before": commit_of_build(sys.argv[2]), "machine": machine(), "repetitions": repetitions, "rows": []}
    with tempfile.TemporaryDirectory() as folder:
        scene = f"{folder}/scene.scene"
        for mirror in (0, 0.4):
            for cover in COVERS:
                for count in COUNTS:
                    make(sys.argv[1], scene, count, cover, mirror)
                    for isa in ("avx512", "avx2"):
                        times = by_turns(ways, repetitions,
                                         lambda way: frame_milliseconds(way[0], scene, 512, isa, folder, way[1]))
                        row = {"spheres": count, "cover": cover, "mirror": mirror, "isa": isa,
                               "in_registers": is_in_registers(sys.argv[1], scene),
                               **{way: statistics.median(times[way]) for way in ways},
                               "streams_over_registers": share(times["streams"], times["registers"]),
                               "registers_over_now": share(times["registers"], times["now"])}
                        print(json.dumps(row))
                        report["rows"].append(row)
    report["machine_after"] = machine()
    write(report, "crowding.json")


if __name__ == "__main__":
    main()
