"""Five lines to first hits: where rays of a NumPy array hit a ball, and proven bounds of t."""

import numpy as np
import packtrace as pt

rays = pt.RayScene(pt.Scene(objects=[pt.Object(pt.Sphere((0, 0, 5), 1))]))
directions = np.array([(0.1, 0, 1), (1, 0, 0)])    # float64, or float32
hits = rays.closest((0, 0, 0), directions)
print(hits.t, hits.object, hits.normal)             # a miss is object -1
print(rays.bounds((0, 0, 0), directions, hits.object))
