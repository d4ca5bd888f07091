#!/usr/bin/env python3
"""Writes results/stress.json: twenty million extreme rays in each mode, by family, without their times.
With --exact, writes results/stress_exact.json: half as many rays in the default mode only, with its verdict.

usage: results/stress.py [--exact] [--isa=NAME] build/release/packtrace [RAYS_OF_EACH_FAMILY]
The default instruction set is avx512 (the committed files are of avx2). Instruction sets with FMA differ
only in their times.
"""
import json
import subprocess
import sys

from provenance import commit, write

ISA = next((argument[6:] for argument in sys.argv if argument.startswith("--isa=")), "avx512")
COMMAND = ["--precision", "single", "--kernel", "packet", "--kernel", "textbook", "--isa", ISA]
LEFT_OUT = ("ns_per_ray", "pareto")  # useful only from an idle machine


def families(program):
    lines = subprocess.run([program, "stress", "--list"], capture_output=True, text=True, check=True)
    return [line.split()[0] for line in lines.stdout.splitlines()[1:]]


def without_times(rows):
    return [{key: value for key, value in row.items() if key not in LEFT_OUT} for row in rows]


def rows_of(program, family, rays):
    arguments = ["stress", "--family", family, "--rays", str(rays), *COMMAND, "--json"]
    done = subprocess.run([program, *arguments], capture_output=True, text=True)
    sys.stderr.write(done.stderr)
    rows = json.loads(done.stdout)["rows"]
    return without_times(rows)


def write_exact(program, rays):
    arguments = ["stress", "--kernel", "packet", "--mode", "exact", "--precision", "single", "--isa", ISA,
                 "--seed", "7", "--rays", str(rays)]
    report = {"command": "packtrace " + " ".join(arguments), "commit": commit()}
    done = subprocess.run([program, *arguments, "--json"], capture_output=True, text=True)
    report |= json.loads(done.stdout)
    report["rows"] = without_times(report["rows"])
    write(report, "stress_exact.json")
    print(report["verdict"])


def main():
    exact = "--exact" in sys.argv
    positional = [argument for argument in sys.argv[1:] if not argument.startswith("--")]
    if not positional:
        sys.exit(__doc__)
    program = positional[0]
    if exact:
        return write_exact(program, int(positional[1]) if len(positional) > 1 else 160000)
    rays = int(positional[1]) if len(positional) > 1 else 300000
    report = {"command": f"packtrace stress --rays {rays} " + " ".join(COMMAND),
              "commit": commit(), "rows": []}
    for family in families(program):
        print(family, file=sys.stderr)
        report["rows"] += rows_of(program, family, rays)
    write(report, "stress.json")


if __name__ == "__main__":
    main()
