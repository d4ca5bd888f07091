"""Scenes built object by object. The words, units and defaults are those of the scene language
(docs/scene.md); colours are linear, 1.0 is full.

Classes here hold values and check their fields' names alone: `Scene.validate`, `render` and
`RayScene` check all of a scene and raise `SceneError`, or its base `ValueError` for a field of the
wrong type or form. The message names the object as in `objects[0]`.
"""

from __future__ import annotations

import difflib
import threading
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar, Dict, List, Literal, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _packtrace
from .arguments import text as utf8

Array = NDArray[Any]
#: Three numbers, of any sequence or array.
Vector = Union[Sequence[float], Array]
#: Rows of numbers, of sequences or an array.
Matrix = Union[Sequence[Sequence[float]], Array]
#: One number for all channels, or red, green and blue.
Colour = Union[float, Sequence[float], Array]

Illumination = Literal["scratch", "sketch", "whitted", "shader", "general"]
QuadricKind = Literal["ellipsoid", "cylinder", "cone", "paraboloid", "hyperboloid", "hyperboloid2",
                      "saddle", "general"]

IDENTITY = ((1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0), (0.0, 0.0, 0.0, 1.0))

#: Held while objects of a file become Python's own.
_TAKING = threading.RLock()


def _same(a: Any, b: Any) -> bool:
    """Whether two values of a field are equal. Arrays, lists and tuples are by their elements."""
    if a is b:
        return True
    if isinstance(a, (list, tuple)) and isinstance(b, (list, tuple)):
        return len(a) == len(b) and all(map(_same, a, b))
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        return bool(np.array_equal(a, b))
    return bool(a == b)


class _Part:
    """A scene or a part of one. Its fields are those of its class; no other can be set."""

    # Of the dataclass that each part is.
    __dataclass_fields__: ClassVar[Dict[str, Any]]

    def __setattr__(self, name: str, value: Any) -> None:
        # What a user's own class adds to one of these is its own.
        if name not in self.__dataclass_fields__ and not name.startswith("_") and not hasattr(
                type(self), name):
            known = list(self.__dataclass_fields__)
            near = difflib.get_close_matches(name, known, 1)
            raise AttributeError(f"{type(self).__name__} has no field '{name}'; " +
                                 (f"did you mean '{near[0]}'?" if near else
                                  f"use one of: {', '.join(known)}"))
        object.__setattr__(self, name, value)

    def __eq__(self, other: object) -> bool:
        if other.__class__ is not self.__class__:
            return NotImplemented
        return all(_same(getattr(self, name), getattr(other, name))
                   for name in self.__dataclass_fields__)


@dataclass(eq=False)
class Sphere(_Part):
    """All points at `radius` from `center`, in scene units; the radius is above 0."""

    center: Vector = (0.0, 0.0, 0.0)
    radius: float = 1.0


@dataclass(eq=False)
class Plane(_Part):
    """An infinite plane through `point`. `normal` points to its outer side, at any length but 0."""

    point: Vector = (0.0, 0.0, 0.0)
    normal: Vector = (0.0, 1.0, 0.0)


@dataclass(eq=False)
class Quadric(_Part):
    """A surface of second order in its own space, to be placed by the object's transform.

    `kind` names an equation: "ellipsoid" x² + y² + z² = 1, "cylinder" x² + y² = 1, "cone" x² + y² =
    z², "paraboloid" x² + y² = z, "hyperboloid" x² + y² - z² = 1, "hyperboloid2" x² + y² - z² = -1,
    "saddle" x² - y² = z. "general" takes ten `coefficients` A … J of Ax² + By² + Cz² + Dxy + Exz +
    Fyz + Gx + Hy + Iz + J = 0; the other kinds have their own.

    `z_range` = (low, high) keeps the part between two heights, and `capped` closes it there.
    """

    kind: QuadricKind = "general"
    coefficients: Optional[Sequence[float]] = None
    z_range: Optional[Tuple[float, float]] = None
    capped: bool = False


@dataclass(eq=False)
class Polygon(_Part):
    """A flat sheet. `contours` holds one contour or more, each of three corners (x, y, z) or more in
    one plane. The first one's corners run clockwise seen from the outer side; a contour within
    another is a hole.
    """

    contours: Sequence[Union[Sequence[Vector], Array]] = ()


Surface = Union[Sphere, Plane, Quadric, Polygon]


@dataclass(eq=False)
class Checker(_Part):
    """Squares on a plane: `other` is the colour of every second one, `size` its edge in scene units."""

    other: Colour = 0.0
    size: float = 1.0


@dataclass(eq=False, kw_only=True)
class Material(_Part):
    """What all materials have. Use the class that fits `Scene.illumination`."""

    color: Colour = 1.0
    checker: Optional[Checker] = None
    name: str = ""


@dataclass(eq=False, kw_only=True)
class ScratchMaterial(Material):
    """`specular` is the highlight's exponent, -1 for none; `reflective` the mirrored share, 0 to 1."""

    specular: float = -1.0
    reflective: float = 0.0


@dataclass(eq=False, kw_only=True)
class SketchMaterial(Material):
    """`ambient` and `diffuse` multiply the colour; `specular` (mirror and highlight) and `refractive`
    (the share that goes through) are white. `ior` is the index of refraction."""

    ambient: Colour = 0.0
    diffuse: Colour = 0.0
    specular: Colour = 0.0
    refractive: Colour = 0.0
    shininess: float = 1.0
    ior: float = 1.0


@dataclass(eq=False, kw_only=True)
class WhittedMaterial(Material):
    """As SketchMaterial, with `transmissive` for the share that goes through."""

    ambient: Colour = 0.0
    diffuse: Colour = 0.0
    specular: Colour = 0.0
    transmissive: Colour = 0.0
    shininess: float = 1.0
    ior: float = 1.0


@dataclass(eq=False, kw_only=True)
class ShaderMaterial(Material):
    """`reflectance` = (r0, r1, r2, r3) of f = r0 + r1 Id + r2 Is^r3, times the colour."""

    reflectance: Sequence[float] = (0.0, 0.0, 0.0, 1.0)


@dataclass(eq=False, kw_only=True)
class GeneralMaterial(Material):
    """Absolute factors; the colour counts for nothing."""

    ambient: Colour = 0.0
    diffuse: Colour = 0.0
    highlight: Colour = 0.0
    reflect: Colour = 0.0
    transmit: Colour = 0.0
    shininess: float = 1.0
    ior: float = 1.0


@dataclass(eq=False)
class Object(_Part):
    """A surface with a material. `transform` is a 4 × 4 matrix M (rows first) that takes a point p of
    the surface to M p; its last row is (0, 0, 0, 1). Without a material it has the one that the
    scene's illumination starts from."""

    surface: Surface
    material: Optional[Material] = None
    name: str = ""
    transform: Matrix = IDENTITY
    casts_shadow: bool = True

    def translate(self, by: Vector) -> Object:
        """A copy moved by `by` (scene units), after what its transform does so far."""
        return replace(self, transform=_packtrace.translated(self.transform, by))

    def rotate(self, axis: Vector, degrees: float) -> Object:
        """A copy turned about an axis through the origin; 90 degrees about z take x to y."""
        return replace(self, transform=_packtrace.rotated(self.transform, axis, degrees))

    def scale(self, factors: Colour) -> Object:
        """A copy scaled about the origin, by one number or three; below 0 mirrors."""
        return replace(self, transform=_packtrace.scaled(self.transform, factors))


@dataclass(eq=False)
class Light(_Part):
    """`type` is "ambient", "point" (`vector` is its position) or "directional" (`vector` points from
    the scene towards it). `intensity` 1 is full and does not fall off with the distance."""

    type: Literal["ambient", "point", "directional"] = "ambient"
    intensity: Colour = 1.0
    vector: Vector = (0.0, 0.0, 0.0)
    casts_shadow: bool = True


@dataclass(eq=False)
class Camera(_Part):
    """A pinhole camera. The columns of `rotation` (3 × 3, rows first) are its axes to the right, up
    and forward. `viewport` (width, height) lies at `distance`, in scene units; with `fov`, the full
    vertical angle of view in degrees, it follows the picture's shape. `pixel_sample` says where in a
    pixel its sample lies, from the left and top edge; None is the place that the illumination has.
    """

    position: Vector = (0.0, 0.0, 0.0)
    rotation: Matrix = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    viewport: Tuple[float, float] = (1.0, 1.0)
    distance: float = 1.0
    fov: Optional[float] = None
    pixel_sample: Optional[Tuple[float, float]] = None

    @staticmethod
    def look_at(position: Vector, target: Vector, up: Vector = (0.0, 1.0, 0.0),
                **fields: Any) -> Camera:
        """A camera at `position` that looks at `target`; `fields` are further ones, such as fov."""
        return Camera(position=position, rotation=_packtrace.look_at(position, target, up), **fields)


@dataclass(eq=False)
class Orbit(_Part):
    """A circle of the camera about an axis through `center`, which it looks at."""

    center: Vector = (0.0, 0.0, 0.0)
    axis: Vector = (0.0, 1.0, 0.0)
    degrees: float = 360.0


@dataclass(eq=False)
class CameraKey(_Part):
    """The camera's pose at one frame."""

    frame: int = 0
    position: Vector = (0.0, 0.0, 0.0)
    look_at: Vector = (0.0, 0.0, 1.0)
    up: Vector = (0.0, 1.0, 0.0)


@dataclass(eq=False)
class Animation(_Part):
    """`frames` pictures of a camera on an `orbit`, or through two `keys` or more."""

    frames: int = 1
    orbit: Optional[Orbit] = None
    keys: List[CameraKey] = field(default_factory=list)


@dataclass(eq=False)
class Scene(_Part):
    """A scene in double precision. Object numbers of hits are indices in `objects`; where two
    surfaces are hit at the same t, the lower number wins.

    `width` and `height` are pixels. `max_depth` counts reflections and refractions after the camera
    ray; None is what the illumination starts from (4 for "sketch", else 3). `min_weight` (0 to 1)
    leaves out mirrored and refracted rays that count for less.
    """

    width: int = 512
    height: int = 512
    background: Colour = 0.0
    illumination: Illumination = "scratch"
    max_depth: Optional[int] = None
    min_weight: float = 0.0
    depth_limit: Literal["background", "local"] = "local"
    shadows: Literal["none", "opaque", "transparent"] = "opaque"
    camera: Camera = field(default_factory=Camera)
    objects: List[Object] = field(default_factory=list)
    lights: List[Light] = field(default_factory=list)
    animation: Optional[Animation] = None

    @staticmethod
    def from_text(text: str, name: str = "scene") -> Scene:
        """The scene that a text in the scene language describes; `name` stands for the file in
        messages. Raises SceneError: "scene:1:10: what, why, what to do"."""
        return _packtrace.parse_scene(utf8("text", text), utf8("name", name))

    def to_text(self) -> str:
        """The scene in the scene language. Reading it gives the same scene, number for number."""
        return _packtrace.scene_text(self)

    def validate(self) -> None:
        """Raises SceneError for the first fault of the scene, in one line that names the object. A
        field of the wrong type or form raises ValueError, the base of SceneError."""
        _packtrace.validate(self)

    def camera_at(self, frame: int) -> Camera:
        """The camera of one frame of the animation, 0 being the first."""
        return _packtrace.camera_at(self, frame)

    # Objects of a file become Python's own only when they are asked for: there may be millions.
    def __getattr__(self, name: str) -> Any:
        if name == "objects":
            with _TAKING:
                # Another thread may have had them in the meantime.
                if "_native_objects" in self.__dict__:
                    self.objects = self.__dict__["_native_objects"].take()
                    del self.__dict__["_native_objects"]
            if "objects" in self.__dict__:
                return self.__dict__["objects"]
        raise AttributeError(f"a Scene has no '{name}'")

    def __getstate__(self) -> Dict[str, Any]:
        self.objects  # noqa: B018 - which makes them Python's own
        return self.__dict__.copy()
