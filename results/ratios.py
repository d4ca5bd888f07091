"""Measures alternating runs, and compares them."""
import re
import statistics
import subprocess


def share(of, over):
    """Median and range of the ratios of adjacent runs."""
    ratios = [a / b for a, b in zip(of, over)]
    return {"median": statistics.median(ratios), "lowest": min(ratios), "highest": max(ratios)}


def by_turns(ways, repetitions, measure):
    """For each name in `ways`, the results of `measure` for its value, one per turn."""
    found = {name: [] for name in ways}
    for _ in range(repetitions):
        for name, way in ways.items():
            found[name].append(measure(way))
    return found


def frame_milliseconds(build, scene, size, isa, folder, options=()):
    """The time of a square frame on one thread, as reported by `render` of a build folder."""
    command = [f"{build}/packtrace", "render", scene, "--size", f"{size}x{size}", "--threads", "1", "--isa",
               isa, "-o", f"{folder}/frame.pfm", *options]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return float(re.search(r"([\d.]+) ms", done.stdout + done.stderr).group(1))
