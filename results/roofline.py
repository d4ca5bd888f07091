#!/usr/bin/env python3
"""Cycles of a frame's kernels beside their instructions: results/roofline.json.

Samples frames (perf, by the processor's clock) and compares each function with the counts of
results/instructions.json, which must be of the same commit: one thread, avx2, for every 16 pixels.
Cycles are the samples' time multiplied by the clock rate; a chain of additions, one per cycle, gives
that rate. Mispredicted branches and misses of the first-level cache (32 KiB, 8 ways) are simulated by
valgrind for all kernels together; its predictor is simpler than a processor's.

Usage: results/roofline.py BUILD [FRAMES]
BUILD is a build folder with `packtrace`. Afterwards docs/write_figures.py updates the tables.
"""
import collections
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

from instructions import KERNEL, PIXELS, ROOT, SCENES, SIZE, short
from provenance import commit_of_build, kept, machine, write

FREQUENCY = 4000
ADDITIONS = 2_000_000_000
CHAIN = """
#include <stdio.h>
#include <time.h>
int main(void)
{
    struct timespec begin, end;
    clock_gettime(CLOCK_MONOTONIC, &begin);
    unsigned long sum = 0;
    for (long i = 0; i < %d / 20; ++i) {
%s    }
    clock_gettime(CLOCK_MONOTONIC, &end);
    printf("%%g\\n", (end.tv_sec - begin.tv_sec) + 1e-9 * (end.tv_nsec - begin.tv_nsec));
    return sum == 7;
}
""" % (ADDITIONS, 20 * '        __asm__ volatile("add $1, %0" : "+r"(sum));\n')
POSITION = re.compile(r"^[+*-]?\d\S* ")
SAMPLE = re.compile(r"^\s*[0-9a-f]+ (.*?)(?:\+0x[0-9a-f]+)? \(")


def gigahertz(folder):
    source = pathlib.Path(folder) / "chain.c"
    source.write_text(CHAIN)
    program = source.with_suffix("")
    subprocess.run(["cc", "-O2", source, "-o", program], check=True)
    seconds = [float(subprocess.run([program], capture_output=True, text=True).stdout)
               for _ in range(5)]
    return ADDITIONS / statistics.median(seconds) * 1e-9


def frame(build, scene, folder):
    return [f"{build}/packtrace", "render", str(ROOT / f"scenes/{scene}.scene"), "--size",
            f"{SIZE}x{SIZE}", "--isa", "avx2", "--threads", "1", "-q", "-o", f"{folder}/a.pfm"]


def cycles(build, scene, frames, clock, folder):
    """Cycles by function, for PIXELS pixels."""
    data = f"{folder}/perf.data"
    # One recording of all frames; the loop below skips samples outside kernels.
    words = " ".join(f"'{word}'" for word in frame(build, scene, folder))
    subprocess.run(["perf", "record", "-e", "cpu-clock", "-F", str(FREQUENCY), "-o", data, "--",
                    "sh", "-c", f"for i in $(seq {frames}); do {words}; done"],
                   capture_output=True, check=True)
    samples = subprocess.run(["perf", "script", "-i", data, "-F", "ip,sym,dso"],
                             capture_output=True, text=True, check=True).stdout
    functions = collections.Counter()
    for line in samples.splitlines():
        at = SAMPLE.match(line)
        if at and KERNEL in at[1]:
            functions[short(at[1])] += 1
    per_sample = 1e9 / FREQUENCY * clock / frames / SIZE ** 2 * PIXELS
    return {name: (count * per_sample, count) for name, count in functions.most_common()}


def simulated(build, scene, folder):
    """Mispredicted branches and cache misses of the kernels, for PIXELS pixels."""
    raw = pathlib.Path(folder) / "callgrind"
    subprocess.run(["valgrind", "--tool=callgrind", "--branch-sim=yes", "--cache-sim=yes",
                    "--D1=32768,8,64", "--compress-strings=no", f"--callgrind-out-file={raw}",
                    *frame(build, scene, folder)], capture_output=True, check=True)
    counts = collections.Counter()
    events = []
    function = ""
    of_callee = False
    for line in raw.read_text().splitlines():
        if line.startswith("events: "):
            events = line.split()[1:]
        elif line.startswith("fn="):
            function = line
        elif line.startswith("calls="):
            of_callee = True
        elif POSITION.match(line):
            if not of_callee and KERNEL in function:
                counts.update(dict(zip(events, map(int, line.split()[1:]))))
            of_callee = False
    share = PIXELS / SIZE ** 2
    return {"mispredicted": round((counts["Bcm"] + counts["Bim"]) * share, 1),
            "missed_lines": round((counts["D1mr"] + counts["D1mw"]) * share, 1)}


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    frames = int(sys.argv[2]) if len(sys.argv) > 2 else 60
    counted = kept("instructions.json")
    report = {"commit": commit_of_build(sys.argv[1]), "machine": machine(), "isa": "avx2", "pixels": PIXELS,
              "size": SIZE, "frames": frames, "rows": []}
    if counted.get("commit") != report["commit"]:
        sys.exit("roofline.py: results/instructions.json is of another commit; "
                 "run results/instructions.py first")
    instructions = {row["scene"]: row["now"]["functions"] for row in counted["rows"]}
    with tempfile.TemporaryDirectory() as folder:
        clock = report["gigahertz"] = round(gigahertz(folder), 3)
        for scene in SCENES:
            found = cycles(sys.argv[1], scene, frames, clock, folder)
            functions = {name: {"cycles": round(took, 1), "samples": count,
                                **instructions[scene][name]}
                         for name, (took, count) in found.items() if name in instructions[scene]}
            total = round(sum(took for took, _ in found.values()), 1)
            report["rows"].append({"scene": scene, "cycles": total, "functions": functions})
        for row in report["rows"]:
            row.update(simulated(sys.argv[1], row["scene"], folder))
    report["machine_after"] = machine()
    write(report, "roofline.json")


if __name__ == "__main__":
    main()
