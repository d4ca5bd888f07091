#!/usr/bin/env python3
"""Closest hits from Python against closest hits from C++, of the same arrays, on one thread.

    cmake --build --preset release --target packtrace_python_rays
    bench/python/rays.py

Both fill the same arrays of hits, in turns; the order changes from one turn to the next. Prints the
medians, and their ratio with the range of its middle half over the turns. The rows say what rays are
made of: `columns` are arrays whose components are contiguous each, with t_min and t_max as arrays;
`numbers` are the same with numbers for t_min and t_max; `vectors` are arrays (n, 3) in C order, which
the Python package sorts into columns, and C++ by a loop in its program.
"""

import argparse
import ctypes
import json
import statistics
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def pointers(arrays):
    return (ctypes.c_void_p * len(arrays))(*(None if array is None else array.ctypes.data
                                             for array in arrays))


class FromCpp:
    """The library's answers, without Python in between."""

    def __init__(self, library, text, dtype):
        name = "float" if dtype.itemsize == 4 else "double"
        make = getattr(library, f"scene_{name}")
        make.restype = ctypes.c_void_p
        self.closest = getattr(library, f"closest_{name}")
        self.closest.restype = ctypes.c_double
        self.closest_of_vectors = getattr(library, f"vectors_{name}")
        self.closest_of_vectors.restype = ctypes.c_double
        self.scene = ctypes.c_void_p(make(text.encode()))

    @staticmethod
    def to(hits):
        normals = [None] * 3 if hits.normal is None else hits.normal.T
        return (ctypes.c_size_t(len(hits.t)), pointers([hits.t, *normals]),
                ctypes.c_void_p(hits.object.ctypes.data))

    def seconds(self, columns, hits):
        return self.closest(self.scene, pointers(columns), *self.to(hits))

    def seconds_of_vectors(self, origins, directions, hits):
        return self.closest_of_vectors(self.scene, ctypes.c_void_p(origins.ctypes.data),
                                       ctypes.c_void_p(directions.ctypes.data), *self.to(hits))


def seconds_of(call):
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def race(turns, first, second):
    """Seconds of both, by turns."""
    times = ([], [])
    for turn in range(turns):
        for side in ((0, 1), (1, 0))[turn % 2]:
            times[side].append((first, second)[side]())
    return times


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=Path, default=ROOT / "build/release")
    parser.add_argument("--rays", type=int, default=10_000_000)
    parser.add_argument("--turns", type=int, default=9)
    parser.add_argument("--scene", type=Path, default=ROOT / "scenes/four_spheres.scene")
    parser.add_argument("--json", type=Path)
    arguments = parser.parse_args()
    sys.path.insert(0, str(arguments.build / "python"))
    import numpy as np
    import packtrace as pt
    library = ctypes.CDLL(arguments.build / "bench/python/rays_from_cpp.so")

    count = arguments.rays
    random = np.random.default_rng(1)
    text = pt.read_scene(arguments.scene).to_text()
    rows = []
    for dtype in (np.dtype(np.float32), np.dtype(np.float64)):
        ours = pt.RayScene(pt.Scene.from_text(text), dtype=dtype, threads=1)
        cpp = FromCpp(library, text, dtype)
        # Towards +z, where the example scenes have their objects.
        columns = np.zeros((8, count), dtype)
        columns[0:3] = random.uniform(-0.1, 0.1, (3, count))
        columns[3:5] = random.uniform(-0.5, 0.5, (2, count))
        columns[5], columns[7] = 1, np.inf
        origins, directions = columns[0:3].T, columns[3:6].T
        for detail in ("t", "normal"):
            for layout in ("columns", "numbers", "vectors"):
                given = (origins, directions)
                if layout == "vectors":
                    given = tuple(map(np.ascontiguousarray, given))
                if layout == "columns":
                    given += (columns[6], columns[7])
                hits = ours.closest(*given, detail=detail)
                expected = ours.closest(origins, directions, detail=detail)
                plain = (lambda: cpp.seconds_of_vectors(*given, hits)) if layout == "vectors" else (
                    lambda: cpp.seconds(columns, hits))
                plain()
                assert np.array_equal(hits.t, expected.t), "answers differ"
                seconds = race(arguments.turns, plain, lambda: seconds_of(
                    lambda: ours.closest(*given, detail=detail, out=hits)))
                ratios = [python / direct for direct, python in zip(*seconds)]
                low, _, high = statistics.quantiles(ratios, n=4)
                rows.append({"dtype": str(dtype), "detail": detail, "layout": layout, "rays": count,
                             "cpp_s": statistics.median(seconds[0]),
                             "python_s": statistics.median(seconds[1]),
                             "ratio": statistics.median(ratios), "ratio_quartiles": [low, high]})
                print("{dtype} {detail:6} {layout:7}  C++ {cpp_s:.3f} s  Python {python_s:.3f} s  "
                      "ratio {ratio:.3f}".format(**rows[-1]), f"({low:.3f} to {high:.3f})", flush=True)
    if arguments.json:
        arguments.json.write_text(json.dumps({"scene": arguments.scene.name,
                                              "turns": arguments.turns, "rows": rows}, indent=1))


if __name__ == "__main__":
    main()
