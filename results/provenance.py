"""Where a file of results comes from, and how it is put in its place."""
import json
import os
import pathlib
import re
import subprocess
import sys

FOLDER = pathlib.Path(__file__).resolve().parent


def commit(folder=FOLDER):
    """The commit that is checked out; ends the script where files differ from it."""
    described = subprocess.run(["git", "describe", "--always", "--dirty"], cwd=folder,
                               capture_output=True, text=True, check=True).stdout.strip()
    if described.endswith("-dirty"):
        sys.exit(f"{pathlib.Path(sys.argv[0]).name}: the tree has changes that are not committed; "
                 "commit them first")
    return described


def commit_of_build(build):
    """The same of the sources that a build folder was made of."""
    cache = (pathlib.Path(build) / "CMakeCache.txt").read_text()
    return commit(re.search(r"^CMAKE_HOME_DIRECTORY:INTERNAL=(.*)$", cache, re.MULTILINE).group(1))


def machine():
    lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
    name = next((line.split(":")[1].strip() for line in lines if line.startswith("model name")), "")
    return f"{name}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}"


def write(report, name):
    """Writes FOLDER/name whole or not at all."""
    target = FOLDER / name
    part = target.with_suffix(".json.part")
    part.write_text(json.dumps(report, indent=1) + "\n")
    part.replace(target)
