#!/usr/bin/env python3
"""Whole frames by packtrace, Tachyon and POV-Ray: the same scenes, one thread, interleaved.

Writes the scenes for all three, compares their pictures, runs each tracer in turn and takes the
time of tracing alone that it states. docs/peers.md says what is fair about it.
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "results"))
from provenance import check_commit

from pictures import difference, read_pfm, read_ppm

ROOT = pathlib.Path(__file__).resolve().parents[2]
FLAKE = ["sphereflake", "--ground", "--reflective", "0.5", "--depth"]
SCENES = {
    "four_spheres": None,  # the file of note 001
    "flake4": FLAKE + ["4"],
    "flake5": FLAKE + ["5"],
    "flake6": FLAKE + ["6"],
    "random100k": ["random", "--count", "100000", "--radius", "0.005", "--reflective", "0.5"],
}
# The place of each tracer's sample in a pixel, from the left and top edge: POV-Ray's is the middle,
# Tachyon's is at the right and top, as a comparison of pictures shows.
SAMPLES = {"povray": "(0.5, 0.5)", "tachyon": "(1, 0)"}


def run(command):
    """The output of a command on both streams; ends the program if the command fails."""
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          errors="replace")
    if done.returncode != 0:
        sys.exit(f"frames.py: {' '.join(map(str, command))} failed:\n{done.stdout[-2000:]}")
    return done.stdout


def stated(pattern, output, name):
    """The number after `pattern` in a tracer's output."""
    found = re.search(pattern, output)
    if not found:
        sys.exit(f"frames.py: {name} states no time of tracing; is it another version?")
    return float(found.group(1))


class Frames:
    """The tracers' commands for one folder of scenes."""

    def __init__(self, build, folder, size):
        self.packtrace = build / "packtrace"
        self.frames = build / "bench/peers/frames/packtrace_frames"
        self.folder = folder
        self.size = size

    def write_scene(self, name):
        file = self.folder / f"{name}.scene"
        if SCENES[name] is None:
            text = (ROOT / "scenes/four_spheres.scene").read_text()
            file.write_text(text + f"\nimage_size = {self.size} x {self.size}\n"
                            "pixel_sample = (0.5, 0.5)\n")
        else:
            run([self.packtrace, "generate", *SCENES[name], "--size",
                 f"{self.size}x{self.size}", "-o", file])
        for ending in ("pov", "dat"):
            run([self.frames, "export", file, "-o", file.with_suffix("." + ending)])

    def objects(self, name):
        output = run([self.packtrace, "info", self.folder / f"{name}.scene", "--json"])
        return sum(json.loads(output)["scene"]["objects"].values())

    def time_packtrace(self, name, extra=()):
        return json.loads(run([self.frames, "render", self.folder / f"{name}.scene", *extra]))

    def time_povray(self, name, extra=("-F",)):
        output = run(["povray", f"+I{self.folder / name}.pov", f"+W{self.size}", f"+H{self.size}",
                      "-A", "-D", "+WT1", "+BM2", *extra])
        times = {key: stated(rf"{word} Time:.*\(([0-9.]+) seconds\)", output, "POV-Ray")
                 for key, word in (("parse_seconds", "Parse"), ("trace_seconds", "Trace"))}
        bounding = re.search(r"Bounding Time:.*\(([0-9.]+) seconds\)", output)
        times["prepare_seconds"] = float(bounding.group(1)) if bounding else 0.0
        return times

    def time_tachyon(self, name, extra=("-nosave",)):
        output = run(["tachyon", self.folder / f"{name}.dat", "-res", str(self.size),
                      str(self.size), "-numthreads", "1", "-shade_phong", "+V", *extra])
        # It also exits with 0 after an error in a scene.
        if "Ray Tracing Time" not in output:
            sys.exit(f"frames.py: tachyon refused {name}.dat:\n{output[-2000:]}")
        return {"parse_seconds": stated(r"Scene Parsing Time:\s+([0-9.]+)", output, "Tachyon"),
                "prepare_seconds": stated(r"Preprocessing Time:\s+([0-9.]+)", output, "Tachyon"),
                "trace_seconds": stated(r"Ray Tracing Time:\s+([0-9.]+)", output, "Tachyon")}

    def compare_pictures(self, name):
        """The differences of the other tracers' pictures from packtrace's."""
        differences = {}
        scene = self.folder / f"{name}.scene"
        kept = scene.read_text()
        for tracer, sample in SAMPLES.items():
            scene.write_text(re.sub(r"pixel_sample = \(.*\)", f"pixel_sample = {sample}", kept))
            ours = self.folder / "ours.pfm"
            theirs = self.folder / "theirs.ppm"
            self.time_packtrace(name, ["--frames", "1", "-o", ours])
            if tracer == "povray":
                self.time_povray(name, ["+FP16", "File_Gamma=1", f"+O{theirs}"])
            else:
                self.time_tachyon(name, ["-format", "PPM48", "-o", theirs])
            differences[tracer] = difference(read_pfm(ours), read_ppm(theirs))
        scene.write_text(kept)
        return differences


def summary(seconds):
    return {"median": statistics.median(seconds), "lowest": min(seconds),
            "highest": max(seconds), "all": seconds}


def measure(frames, name, options):
    """All measurements of one scene."""
    frames.write_scene(name)
    objects = frames.objects(name)
    with_packtrace = objects <= options.max_packtrace_objects
    result = {"scene": name, "objects": objects}
    if with_packtrace:
        result["pictures"] = frames.compare_pictures(name)
    seconds = {}
    for _ in range(options.repetitions):
        passes = {"tachyon": frames.time_tachyon(name), "povray": frames.time_povray(name)}
        for tracer, times in passes.items():
            for key, value in times.items():
                seconds.setdefault(tracer, {}).setdefault(key, []).append(value)
        if with_packtrace:
            times = frames.time_packtrace(name)
            ours = seconds.setdefault("packtrace", {})
            ours.setdefault("parse_seconds", []).append(times["read_seconds"])
            ours.setdefault("prepare_seconds", []).append(times["prepare_seconds"])
            ours.setdefault("trace_seconds", []).append(times["frame_seconds"][0])
            ours.setdefault("trace_again_seconds", []).append(min(times["frame_seconds"][1:]))
            result["packtrace_rays"] = times["rays"]
    result["tracers"] = {tracer: {key: summary(values) for key, values in times.items()}
                         for tracer, times in seconds.items()}
    if with_packtrace:
        ours = seconds["packtrace"]["trace_seconds"]
        result["times_as_fast"] = {
            tracer: statistics.median(t / o for t, o in
                                      zip(seconds[tracer]["trace_seconds"], ours))
            for tracer in ("tachyon", "povray")}
    return result


def show(result):
    print(f"\n{result['scene']}, {result['objects']} objects: seconds, medians")
    print(f"  {'':10} {'parse':>9} {'prepare':>9} {'trace':>9} {'again':>9} {'times':>8}")
    for tracer, times in result["tracers"].items():
        cells = [f"{times[key]['median']:9.4f}" if key in times else " " * 9 for key in
                 ("parse_seconds", "prepare_seconds", "trace_seconds", "trace_again_seconds")]
        ratio = result.get("times_as_fast", {}).get(tracer)
        cells.append(f"{ratio:8.1f}" if ratio else " " * 8)
        print(f"  {tracer:10} {' '.join(cells)}")
    for tracer, apart in result.get("pictures", {}).items():
        print(f"  picture against {tracer}: RMSE {apart['rmse']:.5f}, "
              f"{100 * apart['share_off']:.2f} % of values off by over 2/255")
    sys.stdout.flush()


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release",
                        help="build folder (default build/release)")
    parser.add_argument("--scenes", nargs="+", choices=SCENES, default=list(SCENES))
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--size", type=int, default=1024, help="pixels of each edge")
    parser.add_argument("--max-packtrace-objects", type=int, default=10**7,
                        help="leave packtrace out of larger scenes")
    parser.add_argument("--json", type=pathlib.Path, help="write all figures into this file")
    options = parser.parse_args()
    if options.repetitions < 1 or options.size < 1:
        parser.error("--repetitions and --size start at 1")
    for program in ("tachyon", "povray"):
        if shutil.which(program) is None:
            sys.exit(f"frames.py: {program} is missing; apt-get install {program}")
    return options


def main():
    options = parse_options()
    with tempfile.TemporaryDirectory() as folder:
        frames = Frames(options.build.resolve(), pathlib.Path(folder), options.size)
        context = json.loads(run([frames.frames, "context"]))
        if options.json:
            check_commit(context["commit"])
        context["command"] = "bench/peers/frames.py " + " ".join(sys.argv[1:])
        report = {"context": context, "size": options.size, "scenes": []}
        for name in options.scenes:
            report["scenes"].append(measure(frames, name, options))
            show(report["scenes"][-1])
    if options.json:
        context["load_after"] = f"{os.getloadavg()[0]:.2f}"
        part = options.json.with_name(options.json.name + ".part")
        part.write_text(json.dumps(report, indent=2) + "\n")
        os.replace(part, options.json)


if __name__ == "__main__":
    main()
