#!/usr/bin/env python3
"""The gain of light buffers of a bvh: results/light_buffers.json.

Times of frames of 1024 x 1024 pixels: one thread, avx512, default mode. Runs alternate with an earlier build
that traces all shadow rays through the bvh. The times of `render` include building bvh and buffers.

Usage: results/light_buffers.py BUILD BEFORE [REPETITIONS]
BUILD and BEFORE are build folders with `packtrace`.
"""
import json
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

from provenance import commit_of_build, machine, write
from ratios import by_turns, frame_milliseconds, share

SCENES = {
    "flake4": ["sphereflake", "--depth", "4"],
    "flake5": ["sphereflake", "--depth", "5"],
    "mirrored flake4": ["sphereflake", "--depth", "4", "--reflective", "0.3", "--ground"],
    "mirrored flake5": ["sphereflake", "--depth", "5", "--reflective", "0.3", "--ground"],
    "mirrored flake6": ["sphereflake", "--depth", "6", "--reflective", "0.3", "--ground"],
    "random100k": ["random", "--count", "100000"],
}
# These scenes again, with directional lights in place of the lamps.
PARALLEL = ["mirrored flake4", "mirrored flake5", "mirrored flake6", "random100k"]


def make(build, scene, name):
    """Writes the scene of a row; makes its lights directional if the name ends in "parallel"."""
    subprocess.run([f"{build}/packtrace", "generate", *SCENES[name.removesuffix(", parallel")], "-o", scene],
                   check=True)
    if not name.endswith(", parallel"):
        return
    path = pathlib.Path(scene)
    path.write_text(re.sub(r"light { type=point (.*)position=", r"light { type=directional \1direction=",
                           path.read_text()))


def row_of(name, times):
    row = {"scene": name, "ms": statistics.median(times["now"]), "before_ms": statistics.median(times["before"]),
           "share": share(times["now"], times["before"])}
    print(json.dumps(row))
    return row


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    built_of = commit_of_build(sys.argv[1])
    builds = {"now": sys.argv[1], "before": sys.argv[2]}
    repetitions = int(sys.argv[3]) if len(sys.argv) > 3 else 9
    load = machine()
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for name in [*SCENES, *(f"{name}, parallel" for name in PARALLEL)]:
            scene = f"{folder}/scene.scene"
            make(sys.argv[1], scene, name)
            rows.append(row_of(name, by_turns(builds, repetitions, lambda build: frame_milliseconds(
                build, scene, 1024, "avx512", folder))))
    write({"command": "results/light_buffers.py build/release BEFORE", "commit": built_of,
           "before": commit_of_build(sys.argv[2]), "machine": load, "machine_after": machine(),
           "repetitions": repetitions, "frames": rows}, "light_buffers.json")


if __name__ == "__main__":
    main()
