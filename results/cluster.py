#!/usr/bin/env python3
"""How packtrace-mpi scales: results/cluster.json.

Measures the time of messages between two ranks, through TCP on this machine, and the time to render (on one
thread) and to write bands of large pictures and frames. With these times `packtrace_cluster model` simulates jobs
on 2 to 4096 ranks of one thread; it hands out work with the program's own code. Also races two ranks of one thread
against one process of two threads, alternating between them, and counts the bytes that ranks send.

Usage: results/cluster.py BUILD [REPETITIONS] [--trial]
BUILD is a build folder with `packtrace`, `packtrace-mpi` and `bench/cluster`. The default of
REPETITIONS, of the race, is 9. --trial uses small pictures and writes no file. Afterwards docs/write_figures.py
updates the tables.
"""
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time

from provenance import FOLDER, commit_of_build, machine, write
from ratios import share

RANKS = [1 << i for i in range(13)]
# If a part of rank 0 is busier than this share of the time, it is the bottleneck.
BUSY = 0.9
# Twice the ranks must be this much faster to count as scaling.
GAIN = 1.5


def json_of(command, **more):
    done = subprocess.run(command, capture_output=True, text=True, **more)
    if done.returncode != 0:
        sys.exit(f"cluster.py: {' '.join(map(str, command))} failed: {done.stderr.strip()}")
    return json.loads(done.stdout)


def mpirun(ranks, *options):
    root = ["--allow-run-as-root"] if os.geteuid() == 0 else []
    return ["mpirun", *root, "--oversubscribe", "--bind-to", "none", *options, "-n", str(ranks)]


def scene_file(name):
    return str(FOLDER.parent / "scenes" / f"{name}.scene")


def measured_messages(build, band_bytes):
    # As between machines: through TCP, not through shared memory.
    tcp = mpirun(2, "--mca", "pml", "ob1", "--mca", "btl", "tcp,self", "--mca", "osc", "pt2pt")
    return json_of([*tcp, f"{build}/bench/cluster/packtrace_cluster_messages", str(band_bytes)])


def message_costs(measured):
    """The parameters of the model."""
    latency = measured["latency"]
    served = max(measured["counter_round_trip"] - 2 * latency, 0.0)
    return {"latency": latency, "bytes_per_second": measured["bytes_per_second"], "counter_seconds": served,
            "ask_seconds": max(measured["job_round_trip"] - 2 * latency - served, 0.0)}


def measured_bands(build, scene, ending, size, bands, folder):
    return json_of([f"{build}/bench/cluster/packtrace_cluster", "bands", scene_file(scene), "--size", str(size),
                    "--bands", str(bands), "-o", f"{folder}/bands.{ending}"])


def measured_frames(build, scene, size, folder):
    """Times of frames, each with the time to write it: each rank writes its own frames."""
    seconds = []
    for _ in range(3):
        done = subprocess.run([f"{build}/packtrace", "render", scene_file(scene), "--size", size, "--threads", "1",
                               "-o", f"{folder}/frame.png"], capture_output=True, text=True, check=True)
        times = re.search(r"([\d.]+) ms.*written in ([\d.]+) ms", done.stdout + done.stderr)
        seconds.append(1e-3 * (float(times.group(1)) + float(times.group(2))))
    return {"pieces": 1000, "band_bytes": 0, "write_seconds": 0.0, "work_seconds": [statistics.median(seconds)]}


def simulated(build, measured, costs, ranks):
    asked = json.dumps({**measured, **costs, "ranks": ranks})
    return json_of([f"{build}/bench/cluster/packtrace_cluster", "model"], input=asked)


def why_it_stops(run, pieces):
    parts = {"rank 0 writes all the time": run["writer"], "rank 0 receives all the time": run["link"],
             "the counter is asked all the time": run["counter"]}
    reason, share = max(parts.items(), key=lambda part: part[1])
    if share >= BUSY:
        return reason
    return f"{pieces} pieces do not divide evenly among so many ranks"


def study(build, name, measured, costs):
    runs = simulated(build, measured, costs, RANKS)
    one = runs[0]["seconds"]
    for run in runs:
        run["speedup"] = one / run["seconds"]
    stops = next((i for i in range(1, len(runs)) if runs[i]["speedup"] < GAIN * runs[i - 1]["speedup"]), None)
    result = {"name": name, "pieces": measured["pieces"], "piece_bytes": measured["band_bytes"],
              "piece_seconds": statistics.mean(measured["work_seconds"]),
              "longest_piece_seconds": max(measured["work_seconds"]), "write_seconds": measured["write_seconds"]}
    if stops is not None:
        result.update(scales_to=runs[stops - 1]["ranks"], why=why_it_stops(runs[stops], measured["pieces"]))
    result["runs"] = runs
    print(json.dumps({key: value for key, value in result.items() if key != "runs"}), flush=True)
    return result


def seconds_of(command):
    start = time.monotonic()
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return time.monotonic() - start, done.stdout + done.stderr


def race(build, scene, size, repetitions, folder):
    """Two ranks of one thread against one process of two threads, alternating. Seconds as the programs report
    them, without the start of MPI, and wall-clock seconds with it."""
    picture = ["render", scene_file(scene), "--size", f"{size}x{size}"]
    rows = {"process": [], "process_writes": [], "ranks": [], "process_wall": [], "ranks_wall": []}
    for _ in range(repetitions):
        wall, text = seconds_of([f"{build}/packtrace", *picture, "--threads", "2", "-o", f"{folder}/one.png"])
        times = re.search(r"([\d.]+) ms.*written in ([\d.]+) ms", text)
        rows["process"].append(1e-3 * (float(times.group(1)) + float(times.group(2))))
        rows["process_writes"].append(1e-3 * float(times.group(2)))
        rows["process_wall"].append(wall)
        start = time.monotonic()
        report = json_of([*mpirun(2), f"{build}/packtrace-mpi", *picture, "--threads", "1", "--json", "-o",
                          f"{folder}/two.png"])
        rows["ranks_wall"].append(time.monotonic() - start)
        rows["ranks"].append(report["seconds"])
    sent = sum(rank["bytes_sent"] for rank in report["ranks"])
    pieces = sum(rank["pieces"] for rank in report["ranks"])
    pixels_sent = size * size * sum(rank["pieces"] for rank in report["ranks"] if rank["bytes_sent"]) / pieces
    result = {"scene": scene, "size": size, "repetitions": repetitions,
              "ranks_over_process": share(rows["ranks"], rows["process"]),
              "bytes_sent": sent, "bytes_a_sent_pixel": sent / max(pixels_sent, 1), "bytes_a_pixel": sent / size ** 2,
              "seconds": rows}
    print(json.dumps(result), flush=True)
    return result


def main():
    arguments = [word for word in sys.argv[1:] if word != "--trial"]
    trial = "--trial" in sys.argv
    if len(arguments) not in (1, 2):
        sys.exit(__doc__)
    build = arguments[0]
    built_of = None if trial else commit_of_build(build)
    load = machine()
    size, race_size, bands = (2048, 2048, 8) if trial else (16384, 4096, 48)
    repetitions = int(arguments[1]) if len(arguments) > 1 else 2 if trial else 9
    with tempfile.TemporaryDirectory() as folder:
        raced = race(build, "whitted", race_size, repetitions, folder)
        messages = measured_messages(build, 3 << 18)
        costs = message_costs(messages)
        print(json.dumps(costs), flush=True)
        studies = []
        for scene, ending in (("four_spheres", "png"), ("four_spheres", "pfm"), ("whitted", "png"),
                              ("whitted", "pfm")):
            measured = measured_bands(build, scene, ending, size, bands, folder)
            studies.append(study(build, f"{scene}, {size} x {size}, {ending.upper()}", measured, costs))
        frames = measured_frames(build, "whitted", "1920x1080", folder)
        studies.append(study(build, "whitted, 1000 frames of 1920 x 1080", frames, costs))
        # Compares the model with the race, where rank 0 writes the whole picture at the end.
        measured = measured_bands(build, "whitted", "png", race_size, bands, folder)
        check = (simulated(build, dict(measured, write_seconds=0.0), costs, [2])[0]["seconds"]
                 + statistics.median(raced["seconds"]["process_writes"]))
    if trial:
        return
    write({"command": "results/cluster.py build/release", "commit": built_of, "machine": load,
           "machine_after": machine(), "messages": messages, "costs": costs, "efficiency": raced,
           "model_of_race_seconds": check, "studies": studies}, "cluster.json")


if __name__ == "__main__":
    main()
