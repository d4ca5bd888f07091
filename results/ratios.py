"""How runs are measured by turns, and compared."""
import re
import statistics
import subprocess


def share(of, over):
    """Median and range of the ratios of runs that stood next to each other."""
    ratios = [a / b for a, b in zip(of, over)]
    return {"median": statistics.median(ratios), "lowest": min(ratios), "highest": max(ratios)}


def by_turns(ways, repetitions, measure):
    """For each name in `ways` what `measure` gave of its value, once a turn."""
    found = {name: [] for name in ways}
    for _ in range(repetitions):
        for name, way in ways.items():
            found[name].append(measure(way))
    return found


def frame_milliseconds(build, scene, size, isa, folder, options=()):
    """How long `render` of a build folder says a square frame took on one thread."""
    command = [f"{build}/packtrace", "render", scene, "--size", f"{size}x{size}", "--threads", "1", "--isa",
               isa, "-o", f"{folder}/frame.pfm", *options]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return float(re.search(r"([\d.]+) ms", done.stdout + done.stderr).group(1))
