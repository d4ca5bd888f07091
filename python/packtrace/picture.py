"""Pictures are arrays that notebooks display. `render` and `read_image` make them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable, List, Literal, Optional, Tuple, Union

import numpy as np

from . import _packtrace
from .arguments import Path, file_name, function, number, precision, whole
from .scene import Array, Scene


@dataclass
class CutRays:
    """The number of rays that were not traced because of `Scene.min_weight`, and the bound of the
    resulting error of any channel."""

    rays: int
    bound: float


class Picture(np.ndarray[Any, Any]):
    """An array (height, width, 3) of linear r, g, b values, with rows from the top. 1.0 is full
    intensity; values are not clamped. It is a NumPy array that notebooks display as a picture."""

    #: The rays that `Scene.min_weight` cut from a rendered picture; None for other pictures.
    cut: Optional[CutRays] = None

    def save(self, file: Path, *, gamma: float = 1.0) -> None:
        """Writes the picture; see `write_image`."""
        write_image(file, self, gamma=gamma)

    def __array_wrap__(self, array: Any, *context: Any) -> Any:
        # Results such as a mean become numbers, not pictures without pixels.
        wrapped = super().__array_wrap__(array, *context)
        return wrapped[()] if wrapped.ndim == 0 else wrapped

    def _repr_png_(self) -> Optional[bytes]:
        shown = self.ndim == 3 and self.shape[2] == 3 and self.size > 0
        return to_png(self) if shown and self.dtype in (np.float32, np.float64) else None


@dataclass
class PixelError:
    """The pixel at column `x`, row `y`; `error` is the largest difference of a channel."""

    x: int
    y: int
    error: float


@dataclass
class Comparison:
    """The difference between two pictures, in linear values."""

    max_abs: float
    rmse: float  #: over all channels of all pixels
    psnr: float  #: decibels for a peak of 1; infinite for equal pictures
    pixels: int
    pixels_off: int  #: pixels with an error above the threshold
    worst: List[PixelError]  #: largest error first


def render(scene: Scene, *, width: Optional[int] = None, height: Optional[int] = None,
           dtype: Any = np.float32, frame: Optional[int] = None,
           kernel: Literal["packet", "scalar"] = "packet", isa: str = "auto", lanes: int = 0,
           accuracy: Literal["fast", "exact"] = "exact",
           self_hits: Literal["note", "exact"] = "exact",
           traversal: Literal["auto", "list", "tree"] = "auto", force_general: bool = False,
           threads: int = 0, samples: int = 1, adaptive: Optional[float] = None,
           region: Optional[Tuple[int, int, int, int]] = None,
           progress: Optional[Callable[[float], Any]] = None) -> Picture:
    """Renders a scene. Returns an array (height, width, 3) of float32, or of float64 with
    dtype=np.float64.

    width, height: pixels, instead of the scene's; one of them alone keeps the aspect ratio.
    dtype: np.float32 or np.float64; None is the default, np.float32.
    frame: the frame of the scene's animation, from 0.
    kernel, isa, lanes, accuracy, self_hits, traversal: as for RayScene.
    force_general: uses the packet kernel with all features; the picture is the same.
    threads: up to 1024; 0 is one per processor. The picture does not depend on it.
    samples: samples per pixel, 1 to 1024; the colour is their mean.
    adaptive: the contrast, 0 or more, above which a pixel gets all samples; other pixels get one.
    region: (x, y, width, height) of a part of the picture, in pixels from its upper left corner;
        the array then has only this part.
    progress: receives the share that is done, 0 to 1, from time to time, on any thread. An
        exception in it ends the rendering, as Ctrl-C does.

    The array is the renderer's own memory, not a copy. Raises SceneError for a scene that cannot be
    used, ValueError for an impossible option, and MemoryError if there is no memory for the picture.
    """
    if dtype is None:  # NumPy would take it for float64
        dtype = np.float32
    array, cut = _packtrace.render(
        scene, width=width, height=height, dtype=precision(dtype), frame=frame, kernel=kernel,
        isa=isa, lanes=lanes, accuracy=accuracy, self_hits=self_hits, traversal=traversal,
        force_general=force_general, threads=threads, samples=samples, adaptive=adaptive,
        region=region, progress=function("progress", progress))
    picture: Picture = array.view(Picture)
    if scene.min_weight > 0:
        picture.cut = CutRays(*cut)
    return picture


def compare(a: Array, b: Array, *, threshold: float = 1 / 255, worst: int = 5) -> Comparison:
    """Compares two pictures (height, width, 3) with equal size and dtype, float32 or float64. They
    are copied. A pixel with an error above `threshold` counts as off. Lists the `worst` pixels with
    the largest errors."""
    numbers, pixels = _packtrace.compare(*_two_pictures(a, b), number("threshold", threshold),
                                         whole("worst", worst))
    return Comparison(*numbers, [PixelError(*pixel) for pixel in pixels])


def heatmap(a: Array, b: Array) -> Picture:
    """The error of each pixel as a colour, from black for no error through blue, green, yellow and
    red to white for the largest error. The scale is logarithmic, over six decades."""
    return _packtrace.heatmap(*_two_pictures(a, b)).view(Picture)


def read_image(file: Path) -> Picture:
    """Reads a .png, .pfm or .hdr file as float32. 8-bit values v become v / 255. Raises ImageError
    if the file cannot be read."""
    return _packtrace.read_image(file_name(file)).view(Picture)


def write_image(file: Path, picture: Array, *, gamma: float = 1.0) -> None:
    """Writes a picture (height, width, 3) in the format of the file's extension: .png (8 bits,
    raised to 1 / gamma), .pfm (float32) or .hdr; the last two are linear and accept no gamma. The
    file appears complete or not at all. Raises ImageError if it cannot be written, and ValueError
    for an impossible gamma."""
    _packtrace.write_image(file_name(file), _picture(picture, "picture"),
                           number("gamma", gamma))


def to_png(picture: Array, *, gamma: float = 1.0) -> bytes:
    """The bytes of an 8-bit PNG file with a picture (height, width, 3)."""
    return _packtrace.to_png(_picture(picture, "picture"), number("gamma", gamma))


def _picture(value: Any, name: str) -> Array:
    array = np.asarray(value)
    if array.ndim != 3 or array.shape[2] != 3 or array.size == 0:
        raise ValueError(f"{name} has shape {array.shape}; use (height, width, 3)")
    if array.dtype not in (np.float32, np.float64):
        raise ValueError(f"{name} is {array.dtype}; use float32 or float64, with 1.0 for full")
    return np.ascontiguousarray(array)


def _two_pictures(a: Any, b: Any) -> Tuple[Array, Array]:
    first, second = _picture(a, "a"), _picture(b, "b")
    if first.dtype != second.dtype:
        raise ValueError(f"a is {first.dtype} and b {second.dtype}; give both the same dtype")
    return first, second
