#!/usr/bin/env python3
"""The origin of a results file, and its writing.

Run as a program, it exits 1 if files of the program differ from the commit that is checked out. With
`load_after FILE` it adds the machine's load to the context of a JSON file.

Results belong to a clean commit. PACKTRACE_ALLOW_DIRTY=1 in the environment permits another state, for
example to try a script; the file then names its commit with "-dirty" at the end."""
import json
import os
import pathlib
import re
import subprocess
import sys

FOLDER = pathlib.Path(__file__).resolve().parent


def check_commit(described):
    """Ends the script if a commit's name says that files differed from it, unless allowed."""
    if described.endswith("-dirty") and os.environ.get("PACKTRACE_ALLOW_DIRTY") != "1":
        sys.exit(f"{pathlib.Path(sys.argv[0]).name}: files differ from the commit, so no result can "
                 "name what it is of; commit them and build again, or set PACKTRACE_ALLOW_DIRTY=1")
    return described


def commit(folder=FOLDER):
    """The commit that is checked out, as in the stamp of builds (cmake/write_build_stamp.cmake). Ends
    the script if files of the program differ from it."""
    git = ["git", "-C", folder]
    head = subprocess.run([*git, "rev-parse", "--short", "HEAD"], capture_output=True, text=True,
                          check=True).stdout.strip()
    differs = subprocess.run([*git, "diff", "--quiet", "HEAD", "--", ":/", ":(top,exclude)results",
                              ":(top,exclude)docs", ":(top,exclude)*.md"])
    return check_commit(head + ("-dirty" if differs.returncode else ""))


def commit_of_build(build):
    """As commit(), for the sources of a build folder."""
    cache = (pathlib.Path(build) / "CMakeCache.txt").read_text()
    return commit(re.search(r"^CMAKE_HOME_DIRECTORY:INTERNAL=(.*)$", cache, re.MULTILINE).group(1))


def machine():
    lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
    name = next((line.split(":")[1].strip() for line in lines if line.startswith("model name")), "")
    return f"{name}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}"


def kept(name):
    """The contents of FOLDER/name; {} if there is no such file."""
    path = FOLDER / name
    return json.loads(path.read_text()) if path.is_file() else {}


def write(report, name):
    """Writes FOLDER/name completely or not at all."""
    target = FOLDER / name
    part = target.with_suffix(".json.part")
    part.write_text(json.dumps(report, indent=1) + "\n")
    part.replace(target)


def add_load_after(file):
    path = pathlib.Path(file)
    report = json.loads(path.read_text())
    report["context"]["load_after"] = f"{os.getloadavg()[0]:.2f}"
    path.write_text(json.dumps(report, indent=1) + "\n")


if __name__ == "__main__":
    if sys.argv[1:2] == ["load_after"]:
        add_load_after(sys.argv[2])
    else:
        commit()
