"""Helpers for the tests of the Python package."""

import os
import signal
import subprocess
import tempfile
import threading
import time
from pathlib import Path

import numpy as np

import packtrace as pt

SOURCE = Path(__file__).resolve().parents[2]
SCENES = SOURCE / "scenes"

HAND_SCENE = """
sphere { name = "ball"  center = (0, 0, 5)  radius = 1  color = (255, 0, 0) }
plane { name = "floor"  point = (0, -2, 0)  normal = (0, 1, 0)  color = (255, 0, 0) }
cylinder { name = "can"  z_range = (-1, 1)  capped = true  translate = (10, 0, 0) }
"""


def hand_scene():
    return pt.Scene.from_text(HAND_SCENE)


def random_rays(count, dtype=np.float64, seed=1):
    """Random rays from around the origin in all directions, in arrays of their own."""
    random = np.random.default_rng(seed)
    origins = random.uniform(-1, 1, (3, count)).astype(dtype).T
    directions = random.normal(size=(3, count)).astype(dtype).T
    return origins, directions


def program(*words):
    """The output of the program packtrace."""
    done = subprocess.run([os.environ["PACKTRACE_PROGRAM"], *map(str, words)], capture_output=True,
                          text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(f"packtrace {words}: {done.stderr}")
    return done.stdout


def rows_of_program(scene_text, columns, *options):
    """The rows that `packtrace intersect` prints for rays of eight columns, as lists of fields."""
    with tempfile.TemporaryDirectory() as folder:
        scene, rays = Path(folder) / "a.scene", Path(folder) / "rays.csv"
        scene.write_text(scene_text)
        lines = (",".join(repr(float(number)) for number in ray) for ray in zip(*columns))
        rays.write_text("\n".join(lines) + "\n")
        return [line.split(",") for line in
                program("intersect", scene, rays, *options).splitlines()[1:]]


def resident_bytes():
    """The memory of this process now in use, and its peak."""
    numbers = {}
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith(("VmRSS", "VmHWM")):
            name, kib, _ = line.split()
            numbers[name.rstrip(":")] = 1024 * int(kib)
    return numbers["VmRSS"], numbers["VmHWM"]


def reset_peak():
    """Resets the peak of the memory to the memory now in use."""
    Path("/proc/self/clear_refs").write_text("5")


def interrupt(test, call):
    """Ctrl-C soon after the call begins must end it within a few seconds."""
    timer = threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGINT))
    began = time.monotonic()
    timer.start()
    with test.assertRaises(KeyboardInterrupt):
        call()
    test.assertLess(time.monotonic() - began, 5)
    timer.join()
