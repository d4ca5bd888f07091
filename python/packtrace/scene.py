"""Scenes built object by object. The words, units and defaults are those of the scene language
(docs/scene.md). Colours are linear; 1.0 is full intensity.

These classes hold values and check only the names of their fields. `Scene.validate`, `render` and
`RayScene` check the whole scene. They raise `SceneError`, or its base `ValueError` for a field of
the wrong type or form. The message names the object as in `objects[0]`.
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
#: Three numbers, as any sequence or array.
Vector = Union[Sequence[float], Array]
#: Rows of numbers, as sequences or an array.
Matrix = Union[Sequence[Sequence[float]], Array]
#: One number for all channels, or red, green and blue.
Colour = Union[float, Sequence[float], Array]

Illumination = Literal["scratch", "sketch", "whitted", "shader", "general"]
QuadricKind = Literal["ellipsoid", "cylinder", "cone", "paraboloid", "hyperboloid", "hyperboloid2",
                      "saddle", "general"]

IDENTITY = ((1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0), (0.0, 0.0, 0.0, 1.0))

#: Held while objects of a file are converted to Python objects.
_TAKING = threading.RLock()


def _same(a: Any, b: Any) -> bool:
    """Whether two values of a field are equal. Arrays, lists and tuples are compared by
    elements."""
    if a is b:
        return True
    if isinstance(a, (list, tuple)) and isinstance(b, (list, tuple)):
        return len(a) == len(b) and all(map(_same, a, b))
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        return bool(np.array_equal(a, b))
    return bool(a == b)


class _Part:
    """A scene or a part of one. Only the fields of its class can be set."""

    # Each part is a dataclass.
    __dataclass_fields__: ClassVar[Dict[str, Any]]

    def __setattr__(self, name: str, value: Any) -> None:
        # Attributes of a user's subclass can be set, too.
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
    """A sphere, in scene units; the radius is above 0."""

    center: Vector = (0.0, 0.0, 0.0)
    radius: float = 1.0


@dataclass(eq=False)
class Plane(_Part):
    """An infinite plane through `point`. `normal` points to its outer side; it may have any length
    except 0."""

    point: Vector = (0.0, 0.0, 0.0)
    normal: Vector = (0.0, 1.0, 0.0)


@dataclass(eq=False)
class Quadric(_Part):
    """A surface of second order in its own space. The object's transform places it in the world.

    `kind` names an equation: "ellipsoid" x² + y² + z² = 1, "cylinder" x² + y² = 1, "cone" x² + y² =
    z², "paraboloid" x² + y² = z, "hyperboloid" x² + y² - z² = 1, "hyperboloid2" x² + y² - z² = -1,
    "saddle" x² - y² = z. "general" takes ten `coefficients` A … J of Ax² + By² + Cz² + Dxy + Exz +
    Fyz + Gx + Hy + Iz + J = 0; the other kinds need none.

    `z_range` = (low, high) clips the surface to these heights, and `capped` closes its ends.
    """

    kind: QuadricKind = "general"
    coefficients: Optional[Sequence[float]] = None
    z_range: Optional[Tuple[float, float]] = None
    capped: bool = False


@dataclass(eq=False)
class Polygon(_Part):
    """A flat piece of a plane. `contours` has one or more contours, each with three or more corners
    (x, y, z); all corners are in one plane. Seen from the outer side, the corners of the first
    contour run clockwise. A contour inside another one is a hole.
    """

    contours: Sequence[Union[Sequence[Vector], Array]] = ()


Surface = Union[Sphere, Plane, Quadric, Polygon]


@dataclass(eq=False)
class Checker(_Part):
    """Squares of two colours on a plane: `other` is the second colour, `size` the edge of a square
    in scene units."""

    other: Colour = 0.0
    size: float = 1.0


@dataclass(eq=False, kw_only=True)
class Material(_Part):
    """The fields of all materials. Use the subclass for `Scene.illumination`."""

    color: Colour = 1.0
    checker: Optional[Checker] = None
    name: str = ""


@dataclass(eq=False, kw_only=True)
class ScratchMaterial(Material):
    """`specular` is the exponent of the highlight, -1 for none; `reflective` is the mirrored share,
    0 to 1."""

    specular: float = -1.0
    reflective: float = 0.0


@dataclass(eq=False, kw_only=True)
class SketchMaterial(Material):
    """`ambient` and `diffuse` multiply the colour; `specular` (mirror and highlight) and `refractive`
    (the transmitted share) do not. `ior` is the index of refraction."""

    ambient: Colour = 0.0
    diffuse: Colour = 0.0
    specular: Colour = 0.0
    refractive: Colour = 0.0
    shininess: float = 1.0
    ior: float = 1.0


@dataclass(eq=False, kw_only=True)
class WhittedMaterial(Material):
    """As SketchMaterial, with `transmissive` for the transmitted share."""

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
    """Factors that do not multiply the colour, which is not used."""

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
    the surface to M p; its last row is (0, 0, 0, 1). Without a material the object has the default
    one of the scene's illumination."""

    surface: Surface
    material: Optional[Material] = None
    name: str = ""
    transform: Matrix = IDENTITY
    casts_shadow: bool = True

    def translate(self, by: Vector) -> Object:
        """A copy moved by `by` (scene units), applied after its present transform."""
        return replace(self, transform=_packtrace.translated(self.transform, by))

    def rotate(self, axis: Vector, degrees: float) -> Object:
        """A copy rotated about an axis through the origin; 90 degrees about z take x to y."""
        return replace(self, transform=_packtrace.rotated(self.transform, axis, degrees))

    def scale(self, factors: Colour) -> Object:
        """A copy scaled about the origin, by one number or three; negative factors mirror."""
        return replace(self, transform=_packtrace.scaled(self.transform, factors))


@dataclass(eq=False)
class Light(_Part):
    """`type` is "ambient", "point" (`vector` is its position) or "directional" (`vector` points from
    the scene towards it). `intensity` 1 is full intensity; it is not attenuated by distance."""

    type: Literal["ambient", "point", "directional"] = "ambient"
    intensity: Colour = 1.0
    vector: Vector = (0.0, 0.0, 0.0)
    casts_shadow: bool = True


@dataclass(eq=False)
class Camera(_Part):
    """A pinhole camera. The columns of `rotation` (3 × 3, rows first) are its right, up and forward
    axes. `viewport` (width, height) is at `distance`, in scene units. With `fov`, the full vertical
    angle of view in degrees, the viewport has the picture's aspect ratio. `pixel_sample` is the
    position of a pixel's sample, from its left and top edges; None is the default of the
    illumination.
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
        """A camera at `position` that looks at `target`; `fields` are further fields, such as
        fov."""
        return Camera(position=position, rotation=_packtrace.look_at(position, target, up), **fields)


@dataclass(eq=False)
class Orbit(_Part):
    """The camera circles around an axis through `center` and looks at `center`."""

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
    """`frames` pictures, with the camera on an `orbit` or on a curve through two or more `keys`."""

    frames: int = 1
    orbit: Optional[Orbit] = None
    keys: List[CameraKey] = field(default_factory=list)


@dataclass(eq=False)
class Scene(_Part):
    """A scene in double precision. Hits identify objects by their index in `objects`. If a ray hits
    two objects at the same t, the lower index wins.

    `width` and `height` are pixels. `max_depth` is the number of reflections and refractions after
    the camera ray; None is the default of the illumination (4 for "sketch", else 3). Mirrored and
    refracted rays with a weight below `min_weight` (0 to 1) are not traced.
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
        """Reads a scene from a text in the scene language. Messages use `name` as the name of the
        file. Raises SceneError: "scene:1:10: what, why, what to do"."""
        return _packtrace.parse_scene(utf8("text", text), utf8("name", name))

    def to_text(self) -> str:
        """The scene in the scene language. The text reads back as the same scene, number for
        number."""
        return _packtrace.scene_text(self)

    def validate(self) -> None:
        """Raises SceneError for the first fault of the scene, with one line that names the object.
        A field of the wrong type or form raises ValueError, the base of SceneError."""
        _packtrace.validate(self)

    def camera_at(self, frame: int) -> Camera:
        """The camera of one frame of the animation; frames count from 0."""
        return _packtrace.camera_at(self, frame)

    # Objects of a file are converted to Python objects at their first use, as there may be
    # millions.
    def __getattr__(self, name: str) -> Any:
        if name == "objects":
            with _TAKING:
                # Another thread may have converted them meanwhile.
                if "_native_objects" in self.__dict__:
                    self.objects = self.__dict__["_native_objects"].take()
                    del self.__dict__["_native_objects"]
            if "objects" in self.__dict__:
                return self.__dict__["objects"]
        raise AttributeError(f"a Scene has no '{name}'")

    def __getstate__(self) -> Dict[str, Any]:
        self.objects  # noqa: B018 - converts them to Python objects
        return self.__dict__.copy()
