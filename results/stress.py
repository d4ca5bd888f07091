#!/usr/bin/env python3
"""Writes results/stress.json: ten million extreme rays, family by family, without their times.

usage: results/stress.py build/release/packtrace [RAYS_OF_EACH_FAMILY]
"""
import json
import pathlib
import subprocess
import sys

COMMAND = ["--precision", "single", "--kernel", "packet", "--kernel", "textbook", "--isa", "avx512"]
LEFT_OUT = ("ns_per_ray", "pareto")  # of use only from a machine at rest


def families(program):
    lines = subprocess.run([program, "stress", "--list"], capture_output=True, text=True, check=True)
    return [line.split()[0] for line in lines.stdout.splitlines()[1:]]


def rows_of(program, family, rays):
    arguments = ["stress", "--family", family, "--rays", str(rays), *COMMAND, "--json"]
    done = subprocess.run([program, *arguments], capture_output=True, text=True)
    sys.stderr.write(done.stderr)
    rows = json.loads(done.stdout)["rows"]
    return [{key: value for key, value in row.items() if key not in LEFT_OUT} for row in rows]


def main():
    program = sys.argv[1]
    rays = int(sys.argv[2]) if len(sys.argv) > 2 else 300000
    report = {"command": f"packtrace stress --rays {rays} " + " ".join(COMMAND), "rows": []}
    target = pathlib.Path(__file__).with_name("stress.json")
    for family in families(program):
        print(family, file=sys.stderr)
        report["rows"] += rows_of(program, family, rays)
        part = target.with_suffix(".json.part")
        part.write_text(json.dumps(report, indent=1) + "\n")
    part.replace(target)


main()
