#!/usr/bin/env python3
"""Writes results/lone_rays.json: rates of a caller's rays through bvhs of few overlapping spheres,
and through the bvh of a flake, where rays are traced one by one. Runs in `exact`, in double precision
and by an earlier build alternate, on one thread.

usage: results/lone_rays.py BUILD BEFORE [REPETITIONS]
BUILD and BEFORE are build folders with `bench/scaling/packtrace_rays`.
"""
import sys

from exact_cost import DEFAULT, rows_of_rays
from provenance import commit_of_build, machine, write

SCENES = [("spheres32", "avx512"), ("spheres64", "avx512"), ("spheres128", "avx512"),
          ("spheres64", "avx2"), ("flake4", "avx512")]
DOUBLE = {"rays": ["--double"]}
SIZE = 256


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    ways = {"exact": (sys.argv[1], DEFAULT), "double": (sys.argv[1], DOUBLE),
            "before": (sys.argv[2], DEFAULT)}
    repetitions = int(sys.argv[3]) if len(sys.argv) == 4 else 9
    report = {"command": "results/lone_rays.py build/release BEFORE", "commit": commit_of_build(sys.argv[1]),
              "before": commit_of_build(sys.argv[2]), "machine": machine(),
              "repetitions": repetitions, "rows": []}
    for scene, isa in SCENES:
        report["rows"] += [row for row in rows_of_rays(ways, scene, SIZE, isa, repetitions)
                           if "double" in row]
    write(report | {"machine_after": machine()}, "lone_rays.json")


if __name__ == "__main__":
    main()
