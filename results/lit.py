#!/usr/bin/env python3
"""The gain of RayScene::lit(): results/lit.json.

Rates of queried points on one thread, by lit() and by occluded() with rays between the same points and the
light. One run of packtrace_bench alternates between all of them in random order.

usage: results/lit.py BUILD [REPETITIONS]
BUILD is a build folder with `bench/packtrace_bench`.
"""
import json
import statistics
import subprocess
import sys

from provenance import commit_of_build, machine, write
from ratios import share


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    repetitions = sys.argv[2] if len(sys.argv) == 3 else "9"
    report = {"command": "results/lit.py build/release", "commit": commit_of_build(sys.argv[1]),
              "machine": machine(), "repetitions": int(repetitions), "rows": []}
    done = subprocess.run([f"{sys.argv[1]}/bench/packtrace_bench", "--benchmark_filter=^lit/",
                           f"--benchmark_repetitions={repetitions}", "--benchmark_min_time=0.05",
                           "--benchmark_enable_random_interleaving=true", "--benchmark_format=json"],
                          capture_output=True, text=True, check=True)
    found = {}
    points = {}
    for run in json.loads(done.stdout)["benchmarks"]:
        if run["run_type"] != "iteration":
            continue
        _, scene, light, rays, way = run["run_name"].split("/")[:5]
        key = (scene, light, rays)
        found.setdefault(key, {}).setdefault(way, []).append(run["items_per_second"] * 1e-6)
        points[key] = (int(run["points"]), points.get(key, (0, {}))[1] | {way: int(run["lit"])})
    for (scene, light, rays), rates in found.items():
        count, reached = points[scene, light, rays]
        row = {"scene": scene, "light": light, "points_of": rays, "points": count, "reached": reached,
               "lit": statistics.median(rates["lit"]), "occluded": statistics.median(rates["occluded"]),
               "unit": "million points a second", "lit_over_occluded": share(rates["lit"], rates["occluded"])}
        print(json.dumps(row))
        report["rows"].append(row)
    write(report | {"machine_after": machine()}, "lit.json")


if __name__ == "__main__":
    main()
