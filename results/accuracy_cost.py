#!/usr/bin/env python3
"""What the accuracy modes and the rules for self-hits cost a frame: results/accuracy_cost.json.

Usage: results/accuracy_cost.py PACKTRACE [REPETITIONS]
"""
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

from provenance import commit, machine, write

ROOT = pathlib.Path(__file__).resolve().parents[1]
MODES = ("fast", "exact")


def milliseconds(program, scene, size, rule, mode, folder):
    command = [program, "render", scene, "--size", size, "--threads", "1", "--self-hits", rule,
               "--accuracy", mode, "-o", f"{folder}/frame.pfm"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return float(re.search(r"([\d.]+) ms", done.stdout + done.stderr).group(1))


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    built_of = commit()
    program = sys.argv[1]
    repetitions = int(sys.argv[2]) if len(sys.argv) > 2 else 11
    with tempfile.TemporaryDirectory() as folder:
        flake = f"{folder}/flake4.scene"
        subprocess.run([program, "generate", "sphereflake", "--depth", "4", "--ground", "-o", flake],
                       check=True)
        scenes = {"four_spheres": (ROOT / "scenes/four_spheres.scene", "640x640"),
                  "quadrics": (ROOT / "scenes/quadrics.scene", "640x640"),
                  "flake4": (flake, "512x512")}
        runs = [(name, rule, mode) for name in scenes for rule in ("exact", "note")
                for mode in MODES]
        times = {run: [] for run in runs}
        for _ in range(repetitions):
            for name, rule, mode in runs:
                scene, size = scenes[name]
                times[name, rule, mode].append(
                    milliseconds(program, scene, size, rule, mode, folder))
    rows = []
    for name, rule, mode in runs:
        ratios = [t / fast for t, fast in zip(times[name, rule, mode], times[name, rule, "fast"])]
        rows.append({"scene": name, "size": scenes[name][1], "self_hits": rule, "mode": mode,
                     "milliseconds": statistics.median(times[name, rule, mode]),
                     "over_fast": statistics.median(ratios),
                     "over_fast_lowest": min(ratios), "over_fast_highest": max(ratios)})
        print(f"{name:13} {rule:6} {mode:7} {rows[-1]['milliseconds']:7.1f} "
              f"{rows[-1]['over_fast']:6.3f}")
    write({"command": "results/accuracy_cost.py build/release/packtrace", "commit": built_of,
           "machine": machine(), "repetitions": repetitions, "rows": rows}, "accuracy_cost.json")


if __name__ == "__main__":
    main()
