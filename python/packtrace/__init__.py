"""packtrace: a SIMD ray tracer of spheres, planes, quadrics and polygons.

    import packtrace as pt
    scene = pt.read_scene("scenes/four_spheres.scene")
    pt.render(scene, width=640).save("a.png")
    hits = pt.RayScene(scene).closest(origins, directions)

docs/python.md is the guide. Space is left-handed: x to the right, y up, z forward. Lengths are in
scene units, angles in degrees. Colours are linear; 1.0 is full intensity.
"""

from __future__ import annotations

from typing import Dict, List, Union

from ._packtrace import ImageError, SceneError, __version__
from . import _packtrace
from .arguments import Path, file_name, number as _number, whole as _whole
from .picture import (Comparison, Picture, PixelError, compare, heatmap, read_image, render, to_png,
                      write_image)
from .rays import AllHits, Hits, RayScene, SceneUpdate, Starts
from .report import report
from .scene import (Animation, Camera, CameraKey, Checker, GeneralMaterial, Light, Material, Object,
                    Orbit, Plane, Polygon, Quadric, Scene, ScratchMaterial, ShaderMaterial,
                    SketchMaterial, Sphere, WhittedMaterial)

__all__ = [
    "AllHits", "Animation", "Camera", "CameraKey", "Checker", "Comparison", "GeneralMaterial", "Hits",
    "ImageError", "Light", "Material", "Object", "Orbit", "Picture", "PixelError", "Plane", "Polygon",
    "Quadric", "RayScene", "Scene", "SceneError", "SceneUpdate", "ScratchMaterial", "ShaderMaterial",
    "SketchMaterial", "Sphere", "Starts", "WhittedMaterial", "__version__", "compare",
    "generate_lattice", "generate_random_spheres", "generate_sphereflake", "heatmap", "isas",
    "read_image", "read_scene", "render", "report", "to_png", "write_image",
]


def __dir__() -> List[str]:
    """The public names, without the package's own imports."""
    return __all__


def read_scene(file: Path) -> Scene:
    """Reads a scene file (docs/scene.md). Raises SceneError: "file:line:column: what, why, what to
    do". Warnings of the reader become Python warnings."""
    return _packtrace.read_scene(file_name(file))


def isas() -> List[Dict[str, Union[str, int, bool]]]:
    """The instruction sets that the kernels are compiled for, narrowest first: name, lanes_single,
    lanes_double, and whether this machine supports the set."""
    return _packtrace.isas()


def generate_sphereflake(depth: int = 4, *, reflective: float = 0.0, ground: bool = False) -> Scene:
    """Spheres on spheres (Haines, 1987): 7381 spheres at depth 4, 597871 at depth 6."""
    return _packtrace.generate_sphereflake(_whole("depth", depth), _number("reflective", reflective),
                                           bool(ground))


def generate_random_spheres(count: int, radius: float, *, seed: int = 1,
                            reflective: float = 0.0) -> Scene:
    """Spheres of one radius, with centers distributed uniformly in the unit cube. `seed` is 0 to
    2**64 - 1; the program accepts only seeds up to 2**31 - 1."""
    return _packtrace.generate_random_spheres(_whole("count", count), _number("radius", radius),
                                              _whole("seed", seed, 2**64 - 1),
                                              _number("reflective", reflective))


def generate_lattice(edge: int = 10, *, radius: float = 0.3, reflective: float = 0.0) -> Scene:
    """edge × edge × edge spheres at the centers of the unit cube's cells; the radius is in cell
    edges."""
    return _packtrace.generate_lattice(_whole("edge", edge), _number("radius", radius),
                                       _number("reflective", reflective))
