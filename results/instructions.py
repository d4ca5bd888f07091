#!/usr/bin/env python3
"""Instructions of a frame's kernels by function and kind: results/instructions.json.

The counts are those of valgrind (callgrind) for every 16 pixels and all their rays, with avx2, the
widest set that valgrind knows. They do not depend on the machine or its load. Inlined code counts
for the function that contains it.

Usage: results/instructions.py BUILD [BEFORE]
BUILD and BEFORE are build folders with `packtrace`. Afterwards docs/write_figures.py updates the tables.
"""
import collections
import pathlib
import re
import subprocess
import sys
import tempfile

from provenance import commit_of_build, machine, write

ROOT = pathlib.Path(__file__).resolve().parents[1]
SCENES = ["four_spheres", "whitted", "quadrics", "mirror_room"]
SIZE = 512
# One packet of avx512, or two of avx2.
PIXELS = 16
KERNEL = "packtrace::avx2::"
# An address, an unknown line, and the cost.
COST = re.compile(r"^(0x[0-9a-f]+) \d+ (\d+)$")
INSTRUCTION = re.compile(r"^ *([0-9a-f]+):\t(\S+)(.*)$")
STACK = re.compile(r"\(%r[sb]p[,)]")
# The first pattern that a mnemonic matches gives its kind.
KINDS = {
    "division, root": r"v(div|sqrt)",
    "conversion": r"vcvt",
    "single": r"v(add|sub|mul|fn?m(add|sub)\w*|min|max|rcp|rsqrt)\w*[ps]s$",
    "double": r"v(add|sub|mul|fn?m(add|sub)\w*|min|max)\w*[ps]d$",
    "compare, select": r"v(u?comi|cmp|and|or|xor|blend|movmsk|ptest|pand|por|pxor|test|pcmp|pblend|pmovmsk)",
    "move, spilled": r"v(mov|lddqu|pmaskmov|maskmov)",
    "shuffle": r"v",
    "branch": r"(j|call|ret)",
}


def kind_of(mnemonic, operands):
    kind = next((kind for kind, names in KINDS.items() if re.match(names, mnemonic)), "scalar")
    if kind == "move, spilled" and not STACK.search(operands):
        return "move"
    return kind


def kinds_by_address(program):
    listing = subprocess.run(["objdump", "-d", "--no-show-raw-insn", program], capture_output=True,
                             text=True, check=True).stdout
    found = (INSTRUCTION.match(line) for line in listing.splitlines())
    return {int(at[1], 16): kind_of(at[2], at[3]) for at in found if at}


def own_costs(lines):
    """Instructions by function and address, without those of called functions."""
    costs = collections.defaultdict(collections.Counter)
    function = ""
    of_callee = False
    for line in lines:
        if line.startswith("fn="):
            function = line[3:]
        elif line.startswith("calls="):
            of_callee = True
        elif cost := COST.match(line):
            if not of_callee and KERNEL in function:
                costs[function][int(cost[1], 16)] += int(cost[2])
            of_callee = False
    return costs


def without_brackets(text, opening, closing):
    kept = []
    depth = 0
    for letter in text:
        depth += letter == opening
        if depth == 0:
            kept.append(letter)
        depth -= letter == closing
    return "".join(kept)


def short(function):
    """The name of a kernel's function, without the additions of compiler and valgrind."""
    name = function.replace("(anonymous namespace)::", "").replace("operator()", "call")
    name = without_brackets(without_brackets(name, "<", ">"), "(", ")")
    return re.split(r"['\[ ]", name.split("::")[-1].strip())[0]


def by_function(build, scene, kinds):
    """Instructions of each function by kind, for PIXELS pixels."""
    program = f"{build}/packtrace"
    with tempfile.TemporaryDirectory() as folder:
        raw = pathlib.Path(folder) / "callgrind"
        subprocess.run(["valgrind", "--tool=callgrind", "--dump-instr=yes", "--compress-pos=no",
                        "--compress-strings=no", f"--callgrind-out-file={raw}", program, "render",
                        ROOT / f"scenes/{scene}.scene", "--size", f"{SIZE}x{SIZE}", "--isa", "avx2",
                        "--threads", "1", "-o", f"{folder}/a.pfm"], capture_output=True, check=True)
        costs = own_costs(raw.read_text().splitlines())
    functions = collections.defaultdict(collections.Counter)
    for function, by_address in costs.items():
        for address, cost in by_address.items():
            functions[short(function)][kinds[address]] += cost * PIXELS / SIZE ** 2
    if not functions:
        sys.exit(f"instructions.py: no counts of {program} on {scene}")
    return functions


def summary(functions):
    counts = collections.Counter({name: sum(kinds.values()) for name, kinds in functions.items()})
    return {"instructions": round(sum(counts.values()), 1),
            "functions": {name: {"instructions": round(count, 1),
                                 "kinds": {kind: round(n, 1) for kind, n
                                           in functions[name].most_common() if n >= 0.1}}
                          for name, count in counts.most_common() if count >= 1}}


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    builds = dict(zip(("now", "before"), sys.argv[1:]))
    report = {"commit": commit_of_build(sys.argv[1]), "machine": machine(), "isa": "avx2", "pixels": PIXELS,
              "size": SIZE, "rows": []}
    if "before" in builds:
        report["before"] = commit_of_build(builds["before"])
    kinds = {when: kinds_by_address(f"{build}/packtrace") for when, build in builds.items()}
    for scene in SCENES:
        row = {"scene": scene}
        for when, build in builds.items():
            row[when] = summary(by_function(build, scene, kinds[when]))
        report["rows"].append(row)
        print(scene, {when: row[when]["instructions"] for when in builds}, flush=True)
    write(report, "instructions.json")


if __name__ == "__main__":
    main()
