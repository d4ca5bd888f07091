#!/usr/bin/env python3
"""The cost of `exact`: results/exact_cost.json.

Rates of a caller's rays and times of frames on one thread: in `exact`, in `fast`, in double
precision, with the notes' rule for self-hits and, with BEFORE, in the default mode of an earlier
build. The runs alternate.

Usage: results/exact_cost.py BUILD [BEFORE [REPETITIONS [ISA]]]
BUILD and BEFORE are build folders with `packtrace` and `bench/scaling/packtrace_rays`. Afterwards
docs/write_figures.py updates the tables. With ISA, the script measures only this instruction set, for a
machine that lacks others, and writes results/exact_cost_ISA.json.
"""
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

from provenance import commit_of_build, machine, write
from ratios import by_turns, frame_milliseconds, share

ROOT = pathlib.Path(__file__).resolve().parents[1]
RAYS = [("four_spheres", 512, ("avx512", "avx2")), ("spheres32", 512, ("avx512", "avx2")),
        ("spheres64", 512, ("avx512", "avx2")), ("spheres128", 512, ("avx512", "avx2")),
        ("flake4", 512, ("avx512", "avx2")), ("flake6", 512, ("avx512",)),
        ("random1m", 512, ("avx512",))]
DEFAULT = {"rays": [], "frame": []}
FAST = {"rays": ["--fast"], "frame": ["--accuracy", "fast"]}
DOUBLE = {"rays": ["--double"], "frame": ["--precision", "double"]}
# The rule does not apply to a caller's rays: the caller chooses their starts.
NOTE = {"rays": None, "frame": ["--self-hits", "note"]}
FRAMES = ["four_spheres", "whitted", "flight", "general", "mirror_room", "quadrics", "sketch"]


def rates(build, scene, size, isa, options):
    command = [f"{build}/bench/scaling/packtrace_rays", scene, "--size", str(size), "--isa", isa]
    done = subprocess.run(command + options["rays"], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def rows_of_rays(ways, scene, size, isa, repetitions):
    """A row for each kind of rays in `exact`, compared with the other `ways`, each (build, options)."""
    found = by_turns(ways, repetitions, lambda way: rates(way[0], scene, size, isa, way[1]))
    return [row_of({"scene": scene, "isa": isa, "rays": kind, "unit": "million rays a second"},
                   {name: [run[kind] for run in runs] for name, runs in found.items() if kind in runs[0]},
                   lambda rate: rate)
            for kind in found["exact"][0]]


def row_of(of, times, speed):
    """`speed` turns a measured value into one that is higher for faster runs."""
    row = dict(of, **{mode: statistics.median(values) for mode, values in times.items()})
    speeds = {mode: [speed(x) for x in values] for mode, values in times.items()}
    for mode in times:
        if mode != "exact":
            row[f"exact_over_{mode}"] = share(speeds["exact"], speeds[mode])
    print(json.dumps(row))
    return row


def chosen(isas, only):
    return [isa for isa in isas if only in (None, isa)] or ([only] if "avx2" in isas else [])


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    built_of = commit_of_build(sys.argv[1])
    before = None
    builds = {"exact": (sys.argv[1], DEFAULT), "fast": (sys.argv[1], FAST),
              "double": (sys.argv[1], DOUBLE), "note": (sys.argv[1], NOTE)}
    if len(sys.argv) > 2:
        builds["before"] = (sys.argv[2], DEFAULT)
        before = f"{commit_of_build(sys.argv[2])} in its default mode"
    with_rays = {mode: way for mode, way in builds.items() if way[1]["rays"] is not None}
    repetitions = int(sys.argv[3]) if len(sys.argv) > 3 else 9
    only = sys.argv[4] if len(sys.argv) > 4 else None
    rows = []
    load = machine()
    for scene, size, isas in RAYS:
        for isa in chosen(isas, only):
            rows += rows_of_rays(with_rays, scene, size, isa, repetitions)
    with tempfile.TemporaryDirectory() as folder:
        for scene in FRAMES:
            for isa in chosen(("avx512", "avx2"), only):
                times = by_turns(builds, repetitions, lambda way: frame_milliseconds(
                    way[0], ROOT / f"scenes/{scene}.scene", 512, isa, folder, way[1]["frame"]))
                rows.append(row_of({"scene": scene, "isa": isa, "rays": "frame 512x512",
                                    "unit": "milliseconds"}, times, lambda x: 1 / x))
    write({"command": " ".join(["results/exact_cost.py build/release BEFORE", *sys.argv[3:]]),
           "commit": built_of, "before": before,
           "machine": load, "machine_after": machine(), "repetitions": repetitions, "rows": rows},
          f"exact_cost_{only}.json" if only else "exact_cost.json")
    subprocess.run([ROOT / "docs/write_figures.py"], check=True)


if __name__ == "__main__":
    main()
