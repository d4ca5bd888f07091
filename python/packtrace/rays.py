"""Queries of a scene with the caller's own rays.

Rays are NumPy arrays of float32 or float64; the dtype is also the precision of the answers.
`origins` and `directions` have the shape (..., 3), `t_min` and `t_max` are numbers or arrays of
shape (...). Answers have the shape (...), too.

Arrays are read in place, with any strides. Arrays with contiguous components, such as
`np.empty((3, n)).T`, are the fastest; others are sorted into components some thousand rays at a
time. Sequences other than arrays are copied, as float64; texts are not read as numbers. All work
runs without the GIL.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Dict, List, Literal, Optional, Tuple, Union

import numpy as np

from . import _packtrace
from .arguments import precision, shown, whole
from .scene import Array, Scene

NO_START = -(2**31)

Detail = Literal["t", "normal", "point", "start"]


@dataclass(eq=False)
class Starts:
    """Origins of rays on the surfaces of earlier hits, made by `Hits.leave`. Rays that start there
    hit their surface again only at a true second hit."""

    origin: Array  #: (..., 3), scene units; NaN for a miss
    point: Array  #: (..., 3), the hit points
    surface: Array  #: (...), int32, surface numbers for RayScene


@dataclass(eq=False)
class Hits:
    """Closest hits. Arrays of vectors have contiguous components."""

    t: Array  #: (...), in lengths of the ray's direction; t_max for a miss
    object: Array  #: (...), int32, index in Scene.objects; -1 for a miss
    normal: Optional[Array] = None  #: (..., 3), unit, outwards; 0 for a miss
    point: Optional[Array] = None  #: (..., 3), scene units; NaN for a miss
    #: (..., 3), origins for rays that leave the surface on its outer side
    outer_start: Optional[Array] = None
    inner_start: Optional[Array] = None  #: (..., 3), origins for the inner side
    surface: Optional[Array] = None  #: (...), int32, number for `leave`; NO_START for a miss

    @property
    def hit(self) -> Array:
        """Shape (...), bool: whether the ray hits anything."""
        return self.object >= 0

    def leave(self, directions: Array) -> Starts:
        """Starts for rays from these hits in `directions` (..., 3), such as mirrored or refracted
        rays. Needs hits with detail="start"."""
        if (self.surface is None or self.normal is None or self.point is None or
                self.outer_start is None or self.inner_start is None):
            raise ValueError('these hits have no starts; ask for them: closest(..., detail="start")')
        directions = _vectors(directions, self.t.dtype, "directions",
                              f"; use an array of shape {self.normal.shape}")
        if directions.shape not in (self.normal.shape, (3,)):
            raise ValueError(f"directions have shape {directions.shape}; these hits need "
                             f"{self.normal.shape}")
        inward = np.einsum("...i,...i", directions, self.normal) < 0
        origin = np.where(inward[..., None], self.inner_start, self.outer_start)
        surface = np.where(inward, ~self.surface, self.surface)
        return Starts(origin, self.point, np.where(self.hit, surface, np.int32(NO_START)))


@dataclass(eq=False)
class AllHits:
    """All hits of each ray, sorted by t. The hits of ray i are [offsets[i]:offsets[i + 1]] of the
    other arrays. Rays of several dimensions are numbered in C order."""

    offsets: Array  #: (rays + 1,), int64
    t: Array  #: (hits,)
    object: Array  #: (hits,), int32, index in Scene.objects
    normal: Array  #: (hits, 3), unit, outwards

    @property
    def ray(self) -> Array:
        """Shape (hits,), int64: the index of each hit's ray."""
        return np.repeat(np.arange(len(self.offsets) - 1), np.diff(self.offsets))


@dataclass
class SceneUpdate:
    """What `RayScene.update` or `RayScene.transform` did."""

    rebuilt: bool  #: True: everything was rebuilt; False: the bvh was refitted
    #: expected number of boxes that a random line enters, relative to the bvh when it was built
    cost: float


class RayScene:
    """A scene prepared for rays. It copies what it needs, so later changes of `scene` have no
    effect before a call of `update`.

    kernel: "packet", or "scalar" for the reference, which rejects isa, lanes, traversal and "fast".
    isa: instruction set of the packet kernel, see `packtrace.isas()`; "auto" takes the widest.
    lanes: 1, 4, 8 or 16 float rays per packet; 0 is any.
    accuracy: "exact", or "fast" for single precision only with float32 rays.
    self_hits: "exact", or "note" for rays that start 0.001 along their direction.
    traversal: "auto", "list" or "tree".
    threads: threads for a call, up to 1024; 0 is one per processor. Answers do not depend on it.
    dtype: prepares the scene for rays of this dtype at once; None prepares it with the first rays.

    All members may be called from several threads at once. Ctrl-C stops queries. Raises SceneError for
    a scene that cannot be used, and ValueError for an impossible option.
    """

    def __init__(self, scene: Scene, *, kernel: Literal["packet", "scalar"] = "packet",
                 isa: str = "auto", lanes: int = 0,
                 accuracy: Literal["fast", "exact"] = "exact",
                 self_hits: Literal["note", "exact"] = "exact",
                 traversal: Literal["auto", "list", "tree"] = "auto", threads: int = 0,
                 dtype: Any = None) -> None:
        self._native = _packtrace.RayScene(scene, kernel=kernel, isa=isa, lanes=lanes,
                                           accuracy=accuracy, self_hits=self_hits,
                                           traversal=traversal, threads=threads)
        self._scalar = kernel == "scalar"
        if dtype is not None:
            self._native.prepare(precision(dtype))

    def update(self, scene: Scene) -> SceneUpdate:
        """Moves objects: reads the surfaces and transforms from `scene`, which must have the same
        objects in the same order. Afterwards all answers equal those of RayScene(scene), which
        takes several times as long, except that lights and `casts_shadow` do not change. Raises
        SceneError, and ValueError for a different number of objects; the answers are then the same
        as before. Waits for the rays of other threads."""
        return SceneUpdate(*self._native.update(scene))

    def transform(self, objects: Any, transforms: Any) -> SceneUpdate:
        """Sets Object.transform of some objects, and is otherwise like `update`. It is the fast way
        to move many objects.

        objects: (n,), indices in Scene.objects.
        transforms: (n, 4, 4), float64, rows first.
        """
        numbers, matrices = np.asarray(objects), np.asarray(transforms)
        if numbers.size == 0:
            numbers = numbers.astype(np.int32)
        if numbers.ndim != 1 or numbers.dtype.kind not in "iu":
            raise ValueError(f"objects are {numbers.dtype} of shape {numbers.shape}; use whole numbers "
                             "of shape (n,)")
        if matrices.shape != (*numbers.shape, 4, 4) or matrices.dtype != np.float64:
            raise ValueError(f"transforms are {matrices.dtype} of shape {matrices.shape}; use float64 "
                             f"of shape {(*numbers.shape, 4, 4)}")
        wrong = np.any(matrices[:, 3] != (0, 0, 0, 1), axis=1)
        if wrong.any():
            raise ValueError(f"transforms[{wrong.argmax()}]: the last row is not (0, 0, 0, 1); the rows "
                             "are those of Object.transform")
        return SceneUpdate(*self._native.transform(_as_int32(numbers, "objects"),
                                                   np.ascontiguousarray(matrices)))

    def closest(self, origins: Any, directions: Any, t_min: Any = 0.0, t_max: Any = np.inf, *,
                detail: Detail = "point", out: Optional[Hits] = None) -> Hits:
        """The closest hit of each ray with t_min < t < t_max; at equal t, of the object with the
        lower index.

        origins: (..., 3) or (3,), scene units; or the result of `Hits.leave`.
        directions: (..., 3) or (3,), of any length; t is in units of their length.
        t_min, t_max: numbers or (...); t_min below 0 raises ValueError. A ray with a NaN hits nothing.
        detail: "t" gives t and object; "normal" also normals; "point" also points; "start" also the
            arrays for `Hits.leave`. Less detail is faster.
        out: hits of an earlier call with the same shape, dtype and detail, to be overwritten.
        """
        starts = origins if isinstance(origins, Starts) else None
        rays = _Rays(origins if starts is None else starts.origin, directions, t_min, t_max)
        if detail not in _DETAILS:
            raise ValueError(f"detail is {shown(detail)}; use one of {', '.join(map(repr, _DETAILS))}")
        if detail == "start" and self._scalar:
            raise ValueError('the scalar kernel gives no starts; use detail="point" or '
                             'kernel="packet"')
        hits = _new_hits(rays, detail) if out is None else _checked_hits(out, rays, detail)
        self._native.closest(*rays.columns, *_flat_starts(starts, rays), *_flat_hits(hits))
        return hits

    def occluded(self, origins: Any, directions: Any, t_min: Any = 0.0,
                 t_max: Any = np.inf) -> Array:
        """Whether each ray hits any object with t_min < t < t_max: bool, of shape (...)."""
        rays = _Rays(origins, directions, t_min, t_max)
        mask = np.empty(rays.shape, np.bool_)
        self._native.occluded(*rays.columns, mask.reshape(-1))
        return mask

    def lit(self, points: Any, light: int) -> Array:
        """Whether the light with index `light` in Scene.lights reaches each point: bool, of shape
        (...). Every object between them that casts a shadow is an occluder, even a transparent one.

        points: `Hits` with detail="start", whose misses are not lit; or points in space, (..., 3).
            The surfaces of hits are known, so rounding errors cause no self-shadowing. -1 in
            `Hits.surface` is a point on no surface.
        light: a point light or a directional light; others raise ValueError.
        """
        hits = points if isinstance(points, Hits) else None
        if hits is not None and (hits.point is None or hits.surface is None):
            raise ValueError('these hits have no surfaces; ask for them: '
                             'closest(..., detail="start")')
        places = _array("points", points if hits is None else hits.point)
        _checked_dtype(places.dtype, "points")
        if places.ndim == 0 or places.shape[-1] != 3:
            raise ValueError(f"points has shape {places.shape}; use (..., 3), such as (n, 3)")
        mask = np.empty(places.shape[:-1], np.bool_)
        surface = None if hits is None else _checked_surface(hits.surface, mask.shape)
        if isinstance(light, (int, np.integer)) and light < 0:
            raise ValueError(f"lights[{light}]; lights count from 0, and none from the end")
        self._native.lit(places.reshape(-1, 3), surface, whole("light", light), mask.reshape(-1))
        return mask

    def all_hits(self, origins: Any, directions: Any, t_min: Any = 0.0,
                 t_max: Any = np.inf) -> AllHits:
        """All hits of each ray with t_min < t < t_max. A ray that touches a surface without
        crossing it may hit it twice at the same t."""
        return AllHits(*self._native.all_hits(*_Rays(origins, directions, t_min, t_max).columns))

    def bounds(self, origins: Any, directions: Any, object: Any, t_min: Any = 0.0,
               t_max: Any = np.inf) -> Array:
        """Proven bounds of the t of each ray's first hit with an object: float64, (..., 2), low and
        high. `object` is the array from `closest`, or one index for all rays. The bounds are (inf,
        -inf) if the index is -1 or the ray certainly misses the object. Takes some 10 µs per
        ray."""
        rays = _Rays(origins, directions, t_min, t_max)
        numbers = np.asarray(object)
        if numbers.shape not in ((), rays.shape) or numbers.dtype.kind not in "iu":
            raise ValueError(f"object is {numbers.dtype} of shape {numbers.shape}; use a whole number, or "
                             f"some of the rays' shape {rays.shape}")
        numbers = np.broadcast_to(numbers, rays.shape)
        result = np.empty((*rays.shape, 2), np.float64)
        self._native.bounds(*rays.columns, _as_int32(numbers.reshape(-1), "object"),
                            result.reshape(-1, 2))
        return result


_DETAILS = ("t", "normal", "point", "start")


class _Rays:
    """Checked arrays of rays, with one dtype and shape, as columns (n, 3), (n, 3), (n,), (n,)."""

    def __init__(self, origins: Any, directions: Any, t_min: Any, t_max: Any) -> None:
        # A value that is not an array gets the precision of the other one.
        vectors = {"origins": _array("origins", origins, directions),
                   "directions": _array("directions", directions, origins)}
        for name, array in vectors.items():
            _checked_dtype(array.dtype, name)
            if array.ndim == 0 or array.shape[-1] != 3:
                raise ValueError(f"{name} has shape {array.shape}; use (..., 3), such as (n, 3)")
        self.dtype = vectors["origins"].dtype
        if vectors["directions"].dtype != self.dtype:
            raise ValueError(f"origins are {self.dtype} and directions {vectors['directions'].dtype}; "
                             "give both the same dtype, which the answer then has")
        self.shape = _common_shape(vectors)
        wide = (*self.shape, 3)
        self.columns: Tuple[Array, Array, Array, Array] = (
            _spread(vectors["origins"], wide).reshape(-1, 3),
            _spread(vectors["directions"], wide).reshape(-1, 3),
            _spread(_not_negative(self._end(t_min, "t_min")), self.shape).reshape(-1),
            _spread(self._end(t_max, "t_max"), self.shape).reshape(-1))

    def _end(self, t: Any, name: str) -> Array:
        if isinstance(t, np.ndarray) and t.ndim > 0:
            if t.dtype != self.dtype:
                raise ValueError(f"{name} is {t.dtype} and origins {self.dtype}; give both the same "
                                 "dtype")
            array = t
        else:
            array = _numbers(t, self.dtype, name, "; use a number or an array of numbers")
        if array.ndim > 0 and array.shape != self.shape:
            raise ValueError(f"{name} has shape {array.shape}; use a number or the rays' shape "
                             f"{self.shape}")
        return array


def _array(name: str, value: Any, beside: Any = None) -> Array:
    if isinstance(value, np.ndarray):
        return value
    if isinstance(value, Starts):
        raise ValueError(f"{name} are Starts, which are for the origins of closest alone; use their "
                         "array, such as starts.origin")
    if isinstance(value, Hits):
        raise ValueError(f"{name} are Hits; use one of their arrays, such as hits.point, or for the "
                         "origins of closest hits.leave(directions)")
    is_single = isinstance(beside, np.ndarray) and beside.dtype == np.float32
    return _vectors(value, np.float32 if is_single else np.float64, name,
                    ", which is no array of vectors; use a NumPy array of shape (..., 3)")


def _vectors(value: Any, dtype: Any, name: str, use: str) -> Array:
    """As _numbers(). Rejects a finite number that would become infinite."""
    array = _numbers(value, dtype, name, use)
    infinite = np.isinf(array)
    if infinite.any() and np.isfinite(_numbers(value, np.float64, name, use)[infinite]).any():
        raise ValueError(f"{name} is {shown(value)}, beyond float32; use smaller numbers, or float64 "
                         "for all rays")
    return array


def _numbers(value: Any, dtype: Any, name: str, use: str) -> Array:
    """A value as an array of numbers; those beyond `dtype` become infinite. For other values `use`
    is the end of the message."""
    try:
        # NumPy would convert None to NaN, and some texts to numbers.
        if value is None or _holds_texts(np.asarray(value)):
            raise TypeError
        with np.errstate(over="ignore"):
            return np.asarray(value, dtype)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f"{name} is {shown(value)}{use}") from None


def _holds_texts(array: Array) -> bool:
    """Whether an array contains texts."""
    if array.dtype.kind == "O":
        return any(isinstance(item, (str, bytes)) for item in array.flat)
    return array.dtype.kind in "SUT"


def _checked_dtype(dtype: np.dtype[Any], name: str) -> np.dtype[Any]:
    if dtype not in (np.float32, np.float64):
        raise ValueError(f"{name} is {dtype}; use float32 or float64, by astype(np.float64)")
    return dtype


def _not_negative(t_min: Array) -> Array:
    """Checks t_min. NaN is valid: the ray hits nothing."""
    least = np.fmin.reduce(t_min, axis=None, initial=0)
    if least < 0:
        raise ValueError(f"t_min {'is' if t_min.ndim == 0 else 'has'} {least}; use 0 or more")
    return t_min


def _common_shape(vectors: Dict[str, Array]) -> Tuple[int, ...]:
    shapes: List[Tuple[int, ...]] = [array.shape[:-1] for array in vectors.values()]
    if shapes[0] == shapes[1] or not shapes[1]:
        return shapes[0]
    if not shapes[0]:
        return shapes[1]
    raise ValueError(f"origins have shape {(*shapes[0], 3)} and directions {(*shapes[1], 3)}; give both "
                     "the same shape, or one of them (3,)")


def _as_int32(numbers: Array, name: str) -> Array:
    limits = np.iinfo(np.int32)
    if numbers.size > 0 and not limits.min <= int(numbers.min()) <= int(numbers.max()) <= limits.max:
        raise ValueError(f"{name} has numbers from {numbers.min()} to {numbers.max()}; use those of "
                         "Scene.objects")
    return np.ascontiguousarray(numbers, np.int32)


def _spread(array: Array, shape: Tuple[int, ...]) -> Array:
    return array if array.shape == shape else np.broadcast_to(array, shape)


def _by_component(shape: Tuple[int, ...], dtype: Any) -> Array:
    """An array (..., 3) with contiguous components."""
    return np.moveaxis(np.empty((3, *shape), dtype), 0, -1)


def _new_hits(rays: _Rays, detail: Detail) -> Hits:
    hits = Hits(np.empty(rays.shape, rays.dtype), np.empty(rays.shape, np.int32))
    level = _DETAILS.index(detail)
    if level >= 1:
        hits.normal = _by_component(rays.shape, rays.dtype)
    if level >= 2:
        hits.point = _by_component(rays.shape, rays.dtype)
    if level >= 3:
        hits.outer_start = _by_component(rays.shape, rays.dtype)
        hits.inner_start = _by_component(rays.shape, rays.dtype)
        hits.surface = np.empty(rays.shape, np.int32)
    return hits


def _checked_hits(hits: Hits, rays: _Rays, detail: Detail) -> Hits:
    if not isinstance(hits, Hits):
        raise ValueError(f"out is a {type(hits).__name__}; use hits of an earlier call")
    wanted = _new_hits(rays, detail)
    for name, array in vars(wanted).items():
        given = getattr(hits, name)
        if array is None and given is None:
            continue
        if array is None or given is None:
            raise ValueError(f"out.{name} is {'' if given is None else 'not '}None; use hits of an "
                             f"earlier call with detail={detail!r}")
        if not isinstance(given, np.ndarray):
            raise ValueError(f"out.{name} is a {type(given).__name__}; use hits of an earlier call")
        if (given.shape, given.dtype) != (array.shape, array.dtype):
            raise ValueError(f"out.{name} is {given.dtype} of shape {given.shape}; these rays need "
                             f"{array.dtype} of shape {array.shape}, as an earlier call gave it")
        if not given.flags.writeable:
            raise ValueError(f"out.{name} is read-only; use hits that may be overwritten")
        if given.strides != array.strides:
            raise ValueError(f"out.{name} has strides {given.strides}; hits are written with strides "
                             f"{array.strides}, as an earlier call gave them")
    return hits


def _columns(array: Optional[Array]) -> Optional[Array]:
    """The components of an array (..., 3) from _by_component: (3, n), in the same memory."""
    return None if array is None else np.moveaxis(array, -1, 0).reshape(3, -1)


def _flat_hits(hits: Hits) -> Tuple[Array, Array, Optional[Array], Optional[Array],
                                      Optional[Array], Optional[Array], Optional[Array]]:
    surface = None if hits.surface is None else hits.surface.reshape(-1)
    return (hits.t.reshape(-1), hits.object.reshape(-1), _columns(hits.normal), _columns(hits.point),
            _columns(hits.outer_start), _columns(hits.inner_start), surface)


def _flat_starts(starts: Optional[Starts], rays: _Rays
                 ) -> Tuple[Optional[Array], Optional[Array]]:
    if starts is None:
        return None, None
    point = _checked_part(starts.point, "starts.point", (*rays.shape, 3), rays.dtype)
    surface = _checked_part(starts.surface, "starts.surface", rays.shape, np.dtype(np.int32))
    return point.reshape(-1, 3), surface.reshape(-1)


def _checked_part(value: Any, name: str, shape: Tuple[int, ...], dtype: np.dtype[Any]) -> Array:
    """Checks an array of hits or starts, because the user may have replaced it."""
    if not isinstance(value, (np.ndarray, np.generic)):
        raise ValueError(f"{name} is {shown(value)}; use the array that packtrace gave")
    array = np.asarray(value)
    if array.shape != shape or array.dtype != dtype:
        raise ValueError(f"{name} is {array.dtype} of shape {array.shape}; use {dtype} of shape "
                         f"{shape}, as packtrace gave it")
    return array


def _checked_surface(value: Any, shape: Tuple[int, ...]) -> Array:
    """Hits.surface for `lit`: a surface, -1 for a point on no surface, or NO_START for a miss."""
    surface = _checked_part(value, "hits.surface", shape, np.dtype(np.int32)).reshape(-1)
    wrong = (surface < -1) & (surface != NO_START)
    if wrong.any():
        raise ValueError(f"hits.surface has {surface[wrong.argmax()]}; use the numbers that closest "
                         "gave, or -1 for a point on no surface")
    return surface
