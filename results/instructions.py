#!/usr/bin/env python3
"""Writes results/instructions.json: the instructions of a frame's kernels for every 16 pixels and all
their rays, by the file that they come from: inlined functions count where they are written. Counts are
valgrind's (callgrind), of avx2, which it knows, and do not depend on the machine's load.

usage: results/instructions.py PROGRAM [BEFORE]

Both are packtrace, built with -g1 added to CMAKE_CXX_FLAGS_RELEASE; BEFORE is of an earlier commit
and is told by COMMIT_BEFORE in the environment.
"""
import collections
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from provenance import FOLDER, commit, machine, write

SCENES = ["four_spheres", "whitted", "quadrics", "mirror_room"]
SIZE = 256
# A packet of avx512; of avx2 it is two.
PIXELS = 16
KERNELS = re.compile(r"packtrace::avx2::")
# A position, its own cost; lines after `calls=` are of what is called.
COST = re.compile(r"^[+\-*\d]\S* (\d+)$")
NAMED = re.compile(r"^(fl|fi|fe|fn)=\((\d+)\)(?: (.*))?$")


def own_costs(lines):
    """Instructions by source file, of functions of the kernels."""
    names = {"file": {}, "function": {}}
    costs = collections.Counter()
    file = function = ""
    skip = False
    for line in lines:
        named = NAMED.match(line)
        if named:
            kind, number, name = named.groups()
            table = names["function" if kind == "fn" else "file"]
            if name is not None:
                table[number] = name
            if kind == "fn":
                function = table[number]
            else:
                file = table[number]
        elif line.startswith("calls="):
            skip = True
        elif (cost := COST.match(line)):
            if not skip and KERNELS.search(function):
                costs[file] += int(cost.group(1))
            skip = False
    return costs


def concept(path):
    """A file of the kernels by its folder and name, and what is not theirs by what it is."""
    for part in ("/src/kernels/", "/src/"):
        if part in path:
            return path.split(part)[1]
    return "xsimd and the compiler's intrinsics" if "xsimd" in path or "intrin" in path else "other"


def count(program, scene):
    with tempfile.TemporaryDirectory() as folder:
        raw = pathlib.Path(folder) / "callgrind"
        subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={raw}", program,
                        "render", FOLDER.parent / f"scenes/{scene}.scene", "--size", f"{SIZE}x{SIZE}",
                        "--isa", "avx2", "--threads", "1", "-o", f"{folder}/a.pfm"],
                       capture_output=True, check=True)
        return own_costs(raw.read_text().splitlines())


def study(program, built):
    rows = []
    for scene in SCENES:
        costs = count(program, scene)
        if not costs:
            sys.exit(f"instructions.py: no counts of {program} on {scene}")
        files = collections.Counter()
        for path, cost in costs.items():
            files[concept(path)] += cost
        per_packet = PIXELS / SIZE ** 2
        rows.append({"commit": built, "scene": scene, "instructions": round(sum(files.values()) * per_packet, 1),
                     "files": {name: round(cost * per_packet, 2)
                               for name, cost in files.most_common() if cost * per_packet >= 0.5}})
        print(built, scene, rows[-1]["instructions"], flush=True)
    return rows


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    built = commit()
    rows = study(sys.argv[1], built)
    if len(sys.argv) == 3:
        rows += study(sys.argv[2], os.environ["COMMIT_BEFORE"])
    write({"commit": built, "machine": machine(), "isa": "avx2", "size": SIZE, "pixels": PIXELS,
           "scenes": rows}, "instructions.json")


if __name__ == "__main__":
    main()
