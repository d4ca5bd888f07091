#!/usr/bin/env python3
"""How packtrace's time and memory grow with objects, picture size and threads."""
import argparse
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "results"))
from provenance import check_commit

ROOT = pathlib.Path(__file__).resolve().parents[2]


def points(options):
    """Objects by threads at one size, then sizes by threads at one number of objects."""
    for objects in options.objects:
        for threads in options.threads:
            yield {"study": "objects", "objects": objects, "size": options.size,
                   "threads": threads}
    for size in options.sizes:
        for threads in options.threads:
            yield {"study": "size", "objects": options.objects_at_sizes, "size": size,
                   "threads": threads}


def run_point(program, point, frames):
    command = [program] + [word for key in ("objects", "size", "threads")
                           for word in (f"--{key}", str(point[key]))]
    done = subprocess.run(command + ["--frames", str(frames)], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"scaling.py: {' '.join(map(str, command))} failed: {done.stderr.strip()}")
    return json.loads(done.stdout)


def add_run(point, measured):
    """Adds one process's measurements to a point."""
    for key in ("build_seconds", "peak_bytes", "build_bytes_an_object", "scene_bytes_an_object"):
        point.setdefault(key + "_of_all", []).append(measured[key])
    # The first frame also allocates memory.
    point.setdefault("first_frame_seconds_of_all", []).append(measured["frame_seconds"][0])
    point.setdefault("frame_seconds_of_all", []).extend(measured["frame_seconds"][1:])
    point["rays"] = measured["rays"]


def finish(point):
    for key in [key for key in point if key.endswith("_of_all")]:
        point[key.removesuffix("_of_all")] = statistics.median(point[key])
    rays = point["rays"]["total"]
    point["mrays_a_second"] = 1e-6 * rays / point["frame_seconds"]
    point["nanoseconds_a_ray"] = 1e9 * point["frame_seconds"] / rays


def growth(measured):
    """Cost of a ray over its cost with a tenth of the objects, and the ratio of the logarithms."""
    steps = []
    chosen = [p for p in measured if p["study"] == "objects"]
    for less in chosen:
        for more in chosen:
            if more["objects"] == 10 * less["objects"] and more["threads"] == less["threads"]:
                steps.append({"threads": less["threads"], "from": less["objects"],
                              "to": more["objects"],
                              "cost_ratio": more["nanoseconds_a_ray"] / less["nanoseconds_a_ray"],
                              "log_ratio": math.log(more["objects"]) / math.log(less["objects"])})
    return steps


def show(point):
    print(f"{point['study']:8} {point['objects']:9} {point['size']:6} {point['threads']:7} "
          f"{point['build_seconds']:10.4f} {point['build_bytes_an_object']:9.0f} "
          f"{point['peak_bytes'] / 2**20:9.0f} {point['frame_seconds']:10.5f} "
          f"{point['mrays_a_second']:9.2f}")


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release",
                        help="build folder (default build/release)")
    parser.add_argument("--objects", type=int, nargs="*", default=[10**e for e in range(1, 8)])
    parser.add_argument("--size", type=int, default=1024, help="edge for the study of objects")
    parser.add_argument("--sizes", type=int, nargs="*", default=[2**e for e in range(6, 15)],
                        help="edges for the study of sizes (default 64 … 16384)")
    parser.add_argument("--objects-at-sizes", type=int, default=10_000)
    parser.add_argument("--threads", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--repetitions", type=int, default=3, help="processes a point, in turns")
    parser.add_argument("--frames", type=int, default=4, help="frames a process, two or more")
    parser.add_argument("--json", type=pathlib.Path, help="write all figures into this file")
    options = parser.parse_args()
    if options.repetitions < 1 or options.frames < 2:
        parser.error("--repetitions starts at 1, --frames at 2")
    return options


def main():
    options = parse_options()
    program = options.build.resolve() / "bench/scaling/packtrace_scaling"
    measured = list(points(options))
    if not measured:
        sys.exit("scaling.py: nothing to measure; give --objects or --sizes")
    context = None
    for _ in range(options.repetitions):
        for point in measured:
            result = run_point(program, point, options.frames)
            context = context or result["context"]
            del result["context"]
            if options.json:
                check_commit(context["commit"])
            add_run(point, result)
    print(f"{'study':8} {'objects':>9} {'size':>6} {'threads':>7} {'build s':>10} "
          f"{'B/object':>9} {'peak MiB':>9} {'frame s':>10} {'Mrays/s':>9}")
    for point in measured:
        finish(point)
        show(point)
    if options.json:
        context["command"] = "bench/scaling/scaling.py " + " ".join(sys.argv[1:])
        context["load_after"] = f"{os.getloadavg()[0]:.2f}"
        report = {"context": context, "points": measured, "growth": growth(measured)}
        part = options.json.with_name(options.json.name + ".part")
        part.write_text(json.dumps(report, indent=2) + "\n")
        os.replace(part, options.json)


if __name__ == "__main__":
    main()
