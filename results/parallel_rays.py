#!/usr/bin/env python3
"""The cost of parallel rays with distant origins: results/parallel_rays.json.

Times of frames of 512 x 512 pixels with directional lights, and of closest hits of a caller's 200 000 parallel
rays with any origins: one thread, avx512, default mode. Runs alternate with an earlier build.

usage: results/parallel_rays.py BUILD BEFORE [REPETITIONS]
BUILD and BEFORE are build folders with `packtrace`.
"""
import json
import pathlib
import random
import statistics
import subprocess
import sys
import tempfile
import time

from light_buffers import make
from provenance import commit_of_build, machine, write
from ratios import by_turns, frame_milliseconds, share

SCENES = ["flake5", "mirrored flake4", "mirrored flake5", "random100k"]
RAYS = 200_000


def frame(build, scene, folder):
    return 1e-3 * frame_milliseconds(build, scene, 512, "avx512", folder)


def rays(build, scene, folder):
    """Seconds, including reading and writing."""
    begin = time.perf_counter()
    subprocess.run([f"{build}/packtrace", "intersect", scene, f"{folder}/rays.csv", "--precision", "single",
                    "--threads", "1", "--isa", "avx512", "-o", f"{folder}/hits.csv"], capture_output=True, check=True)
    return time.perf_counter() - begin


def write_rays(folder):
    draw = random.Random(1)
    lines = [f"{draw.random():.6f},{draw.random():.6f},2,0.1,0.2,-1" for _ in range(RAYS)]
    pathlib.Path(f"{folder}/rays.csv").write_text("ox,oy,oz,dx,dy,dz\n" + "\n".join(lines) + "\n")


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    builds = {"now": sys.argv[1], "before": sys.argv[2]}
    repetitions = int(sys.argv[3]) if len(sys.argv) == 4 else 9
    report = {"command": "results/parallel_rays.py build/release BEFORE", "commit": commit_of_build(sys.argv[1]),
              "before": commit_of_build(sys.argv[2]), "machine": machine(), "repetitions": repetitions, "rows": []}
    with tempfile.TemporaryDirectory() as folder:
        write_rays(folder)
        scene = f"{folder}/scene.scene"
        for name in SCENES:
            make(sys.argv[1], scene, f"{name}, parallel")
            for what, measured in (("frame, parallel light", frame), ("parallel rays", rays)):
                if measured is rays and name != "random100k":
                    continue
                times = by_turns(builds, repetitions, lambda build: measured(build, scene, folder))
                row = {"scene": name, "what": what, "seconds": statistics.median(times["now"]),
                       "before": statistics.median(times["before"]), "share": share(times["now"], times["before"])}
                print(json.dumps(row))
                report["rows"].append(row)
    write(report | {"machine_after": machine()}, "parallel_rays.json")


if __name__ == "__main__":
    main()
