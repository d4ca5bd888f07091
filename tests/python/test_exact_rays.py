"""Rays of the default mode against rational arithmetic (rational.py): no wrong object, no wrong
shadow, no false hit of the surface that a ray leaves, t as exact as its precision permits, and bounds
that contain the truth."""

import collections
import math
import random
import unittest
from fractions import Fraction

import numpy as np

import packtrace as pt
from rational import Plane, Polygon, Quadric, Sphere, hits_along, in_order, overlap, rational

SCENES_OF_A_FAMILY = 12
RAYS_OF_A_SCENE = 40
ISAS = [isa["name"] for isa in pt.isas() if isa["supported"]]


def power(rng, low, high):
    """A random number between 10^low and 10^high, with a uniform logarithm."""
    return 10 ** rng.uniform(low, high)


def point(rng, size=1.0):
    return [size * rng.uniform(-1, 1) for _ in range(3)]


def unit(rng):
    vector = [rng.gauss(0, 1) for _ in range(3)]
    length = math.hypot(*vector)
    return [x / length for x in vector]


def shells(rng):
    """Nested spheres whose radii differ by as little as single precision cannot resolve."""
    return [Sphere((0.1, 0.2, 0.3), 1 + number * 2.0 ** -rng.randint(10, 30))
            for number in range(6)]


def all_sizes(rng):
    return [Sphere(point(rng, power(rng, -2, 5)), power(rng, -3, 4)) for _ in range(6)]


def on_a_ground(rng):
    """Balls that touch a ground of any size, or nearly touch it."""
    radius = power(rng, 2, 7)
    balls = []
    for _ in range(5):
        size = power(rng, -2, 1)
        lift = 1 + rng.choice([0, 1e-7, -1e-7, 1e-3])
        balls.append(Sphere((rng.uniform(-3, 3), size * lift, rng.uniform(-3, 3)), size))
    return [Sphere((0, -radius, 0), radius), *balls]


def far_away(rng):
    center = point(rng, power(rng, 3, 7))
    return [Sphere([x + y for x, y in zip(center, point(rng, 2))], power(rng, -2, 0.5))
            for _ in range(5)]


def tiny(rng):
    return [Sphere(point(rng, 1e-3), power(rng, -7, -4)) for _ in range(5)]


def creases(rng):
    """Spheres of nearly one size in nearly one place."""
    return [Sphere(point(rng, 0.01), 1 + rng.uniform(-1, 1) * 1e-3) for _ in range(8)]


def planes(rng):
    """Planes that intersect at any angle, one of them along the axes, and a sphere."""
    level = [0, 0, 0]
    level[rng.randrange(3)] = rng.choice([-1, 1])
    tilted = [[x + y for x, y in zip(level, point(rng, power(rng, -6, 0)))] for _ in range(2)]
    return [*(Plane(point(rng), way) for way in (level, *tilted)),
            Sphere(point(rng), power(rng, -2, 0))]


def polygons(rng):
    """A star with arms of any width, a square with a hole close to it, and a sphere."""
    height = rng.uniform(-1, 1)
    inner = power(rng, -4, 0)
    corners = [[(1 if i % 2 == 0 else inner) * f(math.pi * i / 7) for f in (math.cos, math.sin)]
               for i in range(14)]
    square = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)]
    hole = [(0.5 * u, power(rng, -5, 0) * v) for u, v in square]
    axis = rng.randrange(3)
    return [Polygon(axis, height, [corners]),
            Polygon(axis, height + power(rng, -7, 0), [square, hole]),
            Sphere(point(rng), power(rng, -2, 0))]


def quadrics(rng):
    """Quadrics of any kind, whole, clipped or capped, including thin slabs, and a sphere."""
    found = []
    for _ in range(rng.randint(1, 3)):
        kind = rng.choice(list(Quadric.KINDS))
        low = rng.uniform(-2, 2)
        high = low + power(rng, -6, 0.5)
        ends = rng.choice([None, (low, high), (low, high)])
        found.append(Quadric(kind, ends, ends is not None and kind != "saddle"
                             and rng.random() < 0.6))
    return [*found, Sphere(point(rng, 2), power(rng, -2, 0))]


SPHERES = [shells, all_sizes, on_a_ground, far_away, tiny, creases]
FAMILIES = [*SPHERES, planes, polygons, quadrics]


def target(rng, org, center, size):
    """The target of a ray: anywhere at a ball, or just beside its silhouette."""
    w = [c - x for c, x in zip(center, org)]
    distance2 = sum(x * x for x in w)
    radius = size * (1 + rng.choice([-1, 1]) * power(rng, -9, -2))
    if rng.random() < 0.5 or distance2 <= radius**2:
        return [c + 1.1 * x for c, x in zip(center, point(rng, size))]
    share = 1 - radius**2 / distance2
    side = unit(rng)
    back = sum(s * x for s, x in zip(side, w)) / distance2
    across = [s - back * x for s, x in zip(side, w)]
    reach = radius * math.sqrt(share) / math.hypot(*across)
    return [o + share * x + reach * a for o, x, a in zip(org, w, across)]


def aimed_ray(rng, surface, dtype):
    """Org, dir, and t_min with t_max of a ray at a surface from any distance, with a direction of any
    length; some ray intervals begin or end close to a hit."""
    center, size = [0, 0, 0], 1.0
    if isinstance(surface, Sphere):
        center, size = [float(x) for x in surface.center], float(surface.radius)
    away = size * rng.choice([1, 1, 1, 0.3]) * (1 + power(rng, -4, 5))
    org = [dtype(c + away * x) for c, x in zip(center, unit(rng))]
    length = rng.choice([1, 1, power(rng, -6, 6)])
    way = [dtype(length * (to - float(x)))
           for to, x in zip(target(rng, [float(x) for x in org], center, size), org)]
    if rng.random() < 0.1:
        way[rng.randrange(3)] = dtype(0)
    if not any(way):
        way[0] = dtype(1)
    ends = [dtype(0), dtype(math.inf)]
    found = surface.meets(rational(org), rational(way))
    if found and found[0][0] > 0 and rng.random() < 0.3:
        near = float(found[0][0]) * (1 + rng.choice([-1, 1]) * power(rng, -9, -3))
        ends[rng.randrange(2)] = dtype(near)
    return org, way, ends


def rays_of(surfaces, isa):
    objects = [pt.Object(surface.surface, pt.ScratchMaterial()) for surface in surfaces]
    return pt.RayScene(pt.Scene(objects=objects), isa=isa)


def aimed_rays(rng, surfaces, dtype):
    """Arrays of org, dir, and t_min with t_max."""
    aimed = [aimed_ray(rng, rng.choice(surfaces), dtype) for _ in range(RAYS_OF_A_SCENE)]
    return (np.array(part, dtype) for part in zip(*aimed))


def leaving(rng, normal, dtype):
    """A direction away from a surface on either side, often nearly along it."""
    way = np.array(unit(rng))
    if rng.random() < 0.4:
        way += normal * (power(rng, -6, -1) * rng.choice([-1, 1]) - way @ normal)
    return way.astype(dtype)


# The library's answers for one ray.
Answer = collections.namedtuple("Answer", "object t occluded bounds objects ts")


def answers_of(rays, org, way, t_min, t_max):
    hits = rays.closest(org, way, t_min, t_max)
    every = rays.all_hits(org, way, t_min, t_max)
    runs = [slice(*run) for run in zip(every.offsets, every.offsets[1:])]
    return [Answer(*of_ray, every.object[run], every.t[run]) for run, *of_ray in zip(
        runs, hits.object, hits.t, rays.occluded(org, way, t_min, t_max),
        rays.bounds(org, way, hits.object, t_min, t_max))]


def is_first_clear(true_hits):
    return not any(overlap(true_hits[0], other) for other in true_hits[1:])


def crossed_by_start(surfaces, own, origin, point, way):
    """The results of each surface's meets() for a ray that leaves surface number `own`."""
    rounding = rational(np.spacing(abs(point)))
    return [surface.meets_again(rational(point), rational(way), rounding) if number == own
            else surface.meets(rational(origin), rational(way))
            for number, surface in enumerate(surfaces)]


class TestExactRays(unittest.TestCase):
    def check_t(self, t, at, error):
        """t is rounded once, apart from the earlier errors of double precision."""
        ulp = Fraction(float(np.spacing(type(t)(float(at)))))
        share = Fraction(51, 100) if t.dtype == np.float32 else 4
        self.assertLessEqual(abs(Fraction(float(t)) - at), error + ulp * share)

    def check_first(self, true_hits, number, t):
        if not true_hits:
            self.assertEqual(-1, number)
        elif is_first_clear(true_hits):
            self.assertEqual(true_hits[0][2], number)
            self.check_t(t, *true_hits[0][:2])

    def check_bounds(self, surfaces, true_hits, bounds):
        if not true_hits or not is_first_clear(true_hits):
            return
        at, _, number = true_hits[0]
        if surfaces[number].is_held:
            low, high = (Fraction(float(x)) for x in bounds)
            self.assertLessEqual(low, at)
            self.assertLessEqual(at, high)

    def check_all(self, true_hits, answer):
        if any(overlap(*pair) for pair in zip(true_hits, true_hits[1:])):
            return
        self.assertEqual([hit[2] for hit in true_hits], list(answer.objects))
        for (t, error, _), found in zip(true_hits, answer.ts):
            self.check_t(found, t, error)

    def check_scene(self, rng, surfaces, dtype):
        """Compares the rays whose hits doubles can decide; returns their number."""
        org, way, ends = aimed_rays(rng, surfaces, dtype)
        answers = answers_of(rays_of(surfaces, rng.choice(ISAS)), org, way, *ends.T)
        checked = 0
        for i, answer in enumerate(answers):
            true_hits = hits_along(surfaces, rational(org[i]), rational(way[i]), *ends[i])
            if true_hits is None:
                continue
            checked += 1
            with self.subTest(org=org[i], way=way[i], ends=ends[i]):
                self.assertEqual(bool(true_hits), answer.occluded)
                self.check_first(true_hits, answer.object, answer.t)
                self.check_bounds(surfaces, true_hits, answer.bounds)
                self.check_all(true_hits, answer)
        return checked

    def check_leaving(self, rng, surfaces, dtype):
        """As check_scene(), for rays that leave first hits."""
        rays = rays_of(surfaces, rng.choice(ISAS))
        org, way, _ = aimed_rays(rng, surfaces, dtype)
        hits = rays.closest(org, way, detail="start")
        way = np.array([leaving(rng, normal, dtype) for normal in hits.normal])
        starts = hits.leave(way)
        again = rays.closest(starts, way)
        checked = 0
        for i in np.flatnonzero(hits.hit):
            true_hits = in_order(crossed_by_start(surfaces, hits.object[i], starts.origin[i],
                                                  starts.point[i], way[i]), 0, math.inf)
            if true_hits is None:
                continue
            checked += 1
            with self.subTest(point=starts.point[i], way=way[i], own=hits.object[i]):
                self.check_first(true_hits, again.object[i], again.t[i])
        return checked

    def check_families(self, families, check, least):
        """`least` is the smallest accepted share of rays whose answers double can decide."""
        for seed, family in enumerate(families):
            for dtype in (np.float32, np.float64):
                with self.subTest(family=family.__name__, dtype=dtype.__name__):
                    rng = random.Random(seed)
                    checked = sum(check(rng, family(rng), dtype)
                                  for _ in range(SCENES_OF_A_FAMILY))
                    self.assertGreater(checked, least * SCENES_OF_A_FAMILY * RAYS_OF_A_SCENE)

    def test_no_answer_is_wrong(self):
        self.check_families(FAMILIES, self.check_scene, 0.5)

    def test_no_ray_meets_the_surface_it_leaves_unless_it_does(self):
        self.check_families(SPHERES, self.check_leaving, 0.2)


if __name__ == "__main__":
    unittest.main()
