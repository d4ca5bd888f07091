"""Hits of rays in rational numbers. Binary floating-point numbers are rational, so only the final root
is rounded, to 60 digits. This module shares no code with the library.

Each surface has meets(org, dir): the t of its hits, each with the error that doubles may make; None
if double precision cannot decide the number of hits. `is_held` says whether the library stores the
surface without rounding."""

import math
from fractions import Fraction

import packtrace as pt

# The error that doubles may make in a sum, relative to its largest term: thousands of roundoffs.
BAND = Fraction(1, 10**12)


def rational(vector):
    return [Fraction(float(x)) for x in vector]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def along(org, t, direction):
    return [x + t * d for x, d in zip(org, direction)]


def root(x):
    """The square root of a rational number >= 0, to at least 60 digits."""
    bits = max(0, 400 - x.numerator.bit_length() + x.denominator.bit_length())
    bits += bits % 2
    return Fraction(math.isqrt((x.numerator << bits) // x.denominator), 1 << bits // 2)


def crossings(a, b, c, size):
    """The roots of a t² + 2 b t + c; `size` is the largest term of the discriminant."""
    if a == 0:
        return [] if b == 0 else [(-c / (2 * b), abs(c / (2 * b)) * BAND)]
    discriminant = b * b - a * c
    if abs(discriminant) <= BAND * size:
        return None
    if discriminant < 0:
        return []
    way = root(discriminant)
    error = BAND * size / way / abs(a)
    return [(t, error + abs(t) * BAND) for t in sorted(((-b - way) / a, (-b + way) / a))]


class Sphere:
    is_held = True

    def __init__(self, center, radius):
        self.center, self.radius = rational(center), Fraction(radius)
        self.surface = pt.Sphere(tuple(center), radius=radius)

    def meets(self, org, direction):
        w = [x - c for x, c in zip(org, self.center)]
        a, w2, radius2 = dot(direction, direction), dot(w, w), self.radius**2
        return crossings(a, dot(w, direction), w2 - radius2, a * (w2 + radius2))

    def meets_again(self, point, direction, rounding):
        """The hits of a ray from a point of the sphere. Each coordinate of the point was rounded by up to
        `rounding`; None if that decides the side on which the ray leaves."""
        w = [x - c for x, c in zip(point, self.center)]
        way = dot(w, direction)
        if abs(way) <= 2 * dot(rounding, [abs(d) for d in direction]):
            return None
        t = -2 * way / dot(direction, direction)
        return [(t, t * Fraction(1, 10**6))] if t > 0 else []


class Plane:
    def __init__(self, point, normal):
        self.point, self.normal = rational(point), rational(normal)
        self.surface = pt.Plane(tuple(point), normal=tuple(normal))
        # The library normalizes normals, which rounds most of them.
        self.is_held = sorted(abs(x) for x in self.normal) == [0, 0, 1]

    def meets(self, org, direction):
        climb = dot(self.normal, direction)
        most_climb = sum(abs(n * d) for n, d in zip(self.normal, direction))
        height = dot(self.normal, [p - x for p, x in zip(self.point, org)])
        most_height = sum(abs(n) * (abs(p) + abs(x))
                          for n, p, x in zip(self.normal, self.point, org))
        if abs(climb) <= BAND * most_climb or abs(height) <= BAND * most_height:
            return None
        t = height / climb
        return [(t, abs(t) * BAND * (most_climb / abs(climb) + most_height / abs(height)))]


class Polygon:
    """Contours of corners (u, v) in the plane with coordinate `axis` equal to `height`."""

    is_held = True

    def __init__(self, axis, height, contours):
        self.axis, self.height = axis, Fraction(height)
        self.contours = [[rational(corner) for corner in contour] for contour in contours]
        corners = [[self._place(corner, height) for corner in contour] for contour in contours]
        self.surface = pt.Polygon(corners)

    def _place(self, corner, height):
        place = list(corner)
        place.insert(self.axis, height)
        return tuple(float(x) for x in place)

    def meets(self, org, direction):
        climb = direction[self.axis]
        if climb == 0 or org[self.axis] == self.height:
            return None
        t = (self.height - org[self.axis]) / climb
        error = BAND * (abs(self.height) + abs(org[self.axis])) / abs(climb)
        point = along(org, t, direction)
        size = max(abs(x) + abs(y) for x, y in zip(org, point)) + error * max(map(abs, direction))
        del point[self.axis]
        inside = self._holds(point, 10 * BAND * size)
        return None if inside is None else [(t, error)] if inside else []

    def _holds(self, point, margin):
        """Whether a line from a point along u crosses an odd number of edges; None if the point is within
        `margin` of an edge."""
        odd = False
        for contour in self.contours:
            for (u0, v0), (u1, v1) in zip(contour, contour[1:] + contour[:1]):
                if not min(v0, v1) - margin <= point[1] <= max(v0, v1) + margin:
                    continue
                length = abs(u1 - u0) + abs(v1 - v0)
                turn = (u1 - u0) * (point[1] - v0) - (v1 - v0) * (point[0] - u0)
                if abs(turn) <= margin * length:
                    return None
                if (v0 <= point[1]) != (v1 <= point[1]):
                    odd ^= (turn > 0) == (v1 > v0)
        return odd


class Quadric:
    """x·(q x) + l z + k = 0, optionally clipped to a range of z and capped there."""

    KINDS = {"ellipsoid": ((1, 1, 1), 0, -1), "cylinder": ((1, 1, 0), 0, -1),
             "cone": ((1, 1, -1), 0, 0), "paraboloid": ((1, 1, 0), -1, 0),
             "hyperboloid": ((1, 1, -1), 0, -1), "hyperboloid2": ((1, 1, -1), 0, 1),
             "saddle": ((1, -1, 0), -1, 0)}
    is_held = True

    def __init__(self, kind, z_range=None, capped=False):
        self.squares, self.linear, self.constant = self.KINDS[kind]
        self.z_range = None if z_range is None else rational(z_range)
        self.capped = capped
        self.surface = pt.Quadric(kind, z_range=z_range, capped=capped)

    def meets(self, org, direction):
        side = self._meets_side(org, direction)
        if side is None or self.z_range is None:
            return side
        between = []
        for t, error in side:
            height = org[2] + t * direction[2]
            margin = error * abs(direction[2]) + BAND * (abs(org[2]) + abs(height))
            if min(abs(height - z) for z in self.z_range) <= margin:
                return None
            if self.z_range[0] < height < self.z_range[1]:
                between.append((t, error))
        if not self.capped or direction[2] == 0:
            return between
        caps = [self._meets_cap(org, direction, z) for z in self.z_range]
        return None if None in caps else sorted(sum(caps, between))

    def _meets_side(self, org, direction):
        scaled = [q * d for q, d in zip(self.squares, direction)]
        a = dot(scaled, direction)
        sizes = [abs(s) for s in self.squares]
        most_a = dot(sizes, [d * d for d in direction])
        if a != 0 and abs(a) <= BAND * most_a:
            return None
        b = dot(scaled, org) + Fraction(self.linear) * direction[2] / 2
        most_b = (sum(abs(s * x) for s, x in zip(scaled, org))
                  + abs(self.linear * direction[2]))
        most_c = (dot(sizes, [x * x for x in org]) + abs(self.linear * org[2])
                  + abs(self.constant))
        return crossings(a, b, self._value(org), most_b**2 + most_a * most_c)

    def _value(self, point):
        return (dot(self.squares, [x * x for x in point]) + self.linear * point[2]
                + self.constant)

    def _meets_cap(self, org, direction, z):
        t = (z - org[2]) / direction[2]
        error = BAND * (abs(t) + (abs(z) + abs(org[2])) / abs(direction[2]))
        point = along(org, t, direction)
        reach = [abs(p) + abs(x) + error * abs(d) for p, x, d in zip(point, org, direction)]
        most = (sum(abs(q) * x * x for q, x in zip(self.squares, reach))
                + abs(self.linear * z) + abs(self.constant))
        value = self._value(point)
        if abs(value) <= 10 * BAND * most:
            return None
        return [(t, error)] if value < 0 else []


def hits_along(surfaces, org, direction, t_min, t_max):
    """(t, its error, number of the surface) of all hits with t_min < t < t_max, in order; None if
    doubles may find another number of hits."""
    crossed = [surface.meets(org, direction) for surface in surfaces]
    return in_order(crossed, t_min, t_max)


def in_order(crossed, t_min, t_max):
    """As hits_along(), from the results of each surface's meets()."""
    ends = [Fraction(float(t)) for t in (t_min, t_max) if not math.isinf(t)]
    hits = []
    for number, found in enumerate(crossed):
        if found is None or any(abs(t - end) <= error for t, error in found for end in ends):
            return None
        hits += [(t, error, number) for t, error in found if t_min < t < t_max]
    return sorted(hits)


def overlap(one, other):
    """Whether doubles may find two hits on different surfaces in another order."""
    return one[2] != other[2] and abs(other[0] - one[0]) <= one[1] + other[1]
