"""Two lenses of two quadrics each, traced in double precision: spot diagrams, drawn by gnuplot.

The first lens is biconvex, of two spheres; it has spherical aberration. The second one has an
ellipsoid in front, whose eccentricity is 1 / n, and behind it a sphere about the ellipsoid's far
focus. Light along the axis meets at that focus in one point (Descartes, La Geometrie, 1637), which
shows how exact the tracing is. Light from one degree off the axis has coma.

packtrace finds where rays hit, and the normals there; refraction is the few lines of `refracted`.
Lengths are in millimetres; the axis is z. Writes lens.png.
"""

import subprocess

import numpy as np

import packtrace as pt

INDEX = 1.5168  # of the glass N-BK7 at 587.6 nm
THICKNESS = 10.0
APERTURE = 12.0  # half the width of the beam
RIM = 14.0  # half the width of the lens


def cap(center, semi_axes, side):
    """The part of an ellipsoid about `center` on the axis that is within the lens's rim, on the
    `side` of lower (-1) or higher (+1) z."""
    edge = np.sqrt(1 - (RIM / semi_axes[0]) ** 2)
    shape = pt.Quadric("ellipsoid", z_range=(edge, 2) if side > 0 else (-2, -edge))
    return pt.Object(shape).scale(semi_axes).translate((0, 0, center))


def biconvex(radius=50.0):
    return [cap(radius, (radius,) * 3, -1), cap(THICKNESS - radius, (radius,) * 3, +1)]


def stigmatic(focus=100.0):
    major = focus / (1 + 1 / INDEX)
    minor = major * np.sqrt(1 - 1 / INDEX**2)
    return [cap(major, (minor, minor, major), -1), cap(focus, (focus - THICKNESS,) * 3, -1)]


def refracted(directions, normals, ratio):
    """Snell's law for unit vectors; `ratio` is the index before the surface over that behind it."""
    cosine = -np.sum(directions * normals, axis=1, keepdims=True)
    normals = np.where(cosine < 0, -normals, normals)
    cosine = np.abs(cosine)
    return ratio * directions + (
        ratio * cosine - np.sqrt(1 - ratio**2 * (1 - cosine**2))) * normals


def beam(degrees, rings=60):
    """Parallel rays that fill the aperture, at an angle to the axis."""
    radii = np.repeat(np.arange(rings + 1) / rings, np.maximum(1, 6 * np.arange(rings + 1)))
    turns = np.concatenate([np.arange(max(1, 6 * ring)) / max(1, 6 * ring)
                            for ring in range(rings + 1)])
    pupil = APERTURE * radii[:, None] * np.column_stack(
        [np.cos(2 * np.pi * turns), np.sin(2 * np.pi * turns), 0 * turns])
    direction = np.array((0.0, np.sin(np.radians(degrees)), np.cos(np.radians(degrees))))
    return pupil - 20 * direction, np.tile(direction, (len(pupil), 1))


def traced(lens, origins, directions):
    """Rays behind the lens: points on its last surface, and unit directions."""
    rays = pt.RayScene(pt.Scene(objects=lens))
    for surface, ratio in enumerate((1 / INDEX, INDEX)):
        hits = rays.closest(origins, directions, detail="start")
        assert (hits.object == surface).all(), "a ray misses the lens"
        directions = refracted(directions, hits.normal, ratio)
        origins = hits.leave(directions)
    return hits.point, directions


def best_focus(points, directions):
    """Where the spot is smallest: its z, and the rays' x and y there about their mean."""
    slopes = directions[:, :2] / directions[:, 2:]
    at_zero = points[:, :2] - points[:, 2:] * slopes
    slopes_about = slopes - slopes.mean(axis=0)
    z = -np.sum(at_zero * slopes_about) / np.sum(slopes_about**2)
    spot = at_zero + z * slopes
    return z, spot - spot.mean(axis=0)


def paraxial_focus(radius=50.0):
    """Of the biconvex lens, by the lensmaker's equation: the z of its focus near the axis."""
    power = (INDEX - 1) * (2 / radius - (INDEX - 1) * THICKNESS / (INDEX * radius**2))
    return THICKNESS + (1 - (INDEX - 1) * THICKNESS / (INDEX * radius)) / power


def plot(spots):
    """One diagram a spot, side by side."""
    commands = ["set terminal pngcairo size 1200,420", "set output 'lens.png'",
                f"set multiplot layout 1,{len(spots)}", "set size ratio -1", "unset key",
                "set format '%.2g'", "set xtics rotate by -40", "set xlabel 'x, mm'"]
    for title, spot in spots:
        half = 1.1 * np.abs(spot).max()
        rows = "\n".join(f"{x:.17g} {y:.17g}" for x, y in spot)
        commands += [f"set title '{title}'", f"set xrange [{-half}:{half}]",
                     f"set yrange [{-half}:{half}]", f"$spot << END\n{rows}\nEND",
                     "plot $spot with dots lc rgb '#2050c0'"]
    subprocess.run(["gnuplot"], input="\n".join(commands) + "\n", text=True, check=True)


def main():
    near = traced(biconvex(), np.array([(0.001, 0, -20.0)]), np.array([(0, 0, 1.0)]))
    crossing = near[0][0, 2] - near[0][0, 0] * near[1][0, 2] / near[1][0, 0]
    print(f"paraxial focus: {paraxial_focus():.6f} by the lensmaker, {crossing:.6f} traced")
    spots = []
    for name, lens, degrees in (("biconvex, on axis", biconvex(), 0),
                                ("stigmatic, on axis", stigmatic(), 0),
                                ("stigmatic, 1 degree off", stigmatic(), 1)):
        z, spot = best_focus(*traced(lens, *beam(degrees)))
        rms = np.sqrt(np.mean(np.sum(spot**2, axis=1)))
        print(f"{name}: best focus at z = {z:.6f}, RMS radius {rms:.3g} mm")
        spots.append((f"{name}: RMS {rms:.2g} mm", spot))
    plot(spots)


if __name__ == "__main__":
    main()
