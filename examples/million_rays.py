"""A million rays at a thousand spheres, in double precision: what they hit, and proven bounds of
where. million_rays.cpp does the same in C++, and prints the same."""

import numpy as np

import packtrace as pt

EDGE = 1000

# From one point through a square window. Components of directions are contiguous, as the library
# likes them best.
origin = np.array((0.5, 0.5, -2.0))
directions = np.empty((3, EDGE * EDGE)).T
directions[:, 0] = np.tile(np.arange(EDGE) / 500.0 - 1.0, EDGE)
directions[:, 1] = np.repeat(np.arange(EDGE) / 500.0 - 1.0, EDGE)
directions[:, 2] = 4.0

scene = pt.RayScene(pt.generate_lattice(10))
hits = scene.closest(origin, directions, detail="t")
first = int(np.argmin(hits.t))
low, high = scene.bounds(origin, directions[first], hits.object[first])
print(f"{np.count_nonzero(hits.hit)} of {len(directions)} rays hit")
print(f"ray {first} hits object {hits.object[first]} at t = {hits.t[first]:.17g}, "
      f"between {low:.17g} and {high:.17g}")
