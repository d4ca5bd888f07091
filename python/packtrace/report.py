"""Error against run time: a scene is rendered in many ways, and each is timed and compared with the
truth."""

from __future__ import annotations

from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Tuple, Union

from . import _packtrace
from .arguments import function
from .scene import Scene

Row = Dict[str, Union[str, int, float, None]]


def report(scenes: Union[Scene, Mapping[str, Scene]], *, threads: Sequence[int] = (1, 2),
           isas: Sequence[str] = (), min_weights: Optional[Sequence[float]] = None,
           samples: Optional[Sequence[int]] = None,
           adaptive: Optional[Sequence[Tuple[int, float]]] = None, repetitions: int = 9,
           truth_samples: int = 256, threshold: float = 1 / 255,
           progress: Optional[Callable[[str, float], Any]] = None) -> List[Row]:
    """Renders scenes in many ways and measures the time and the error of each. Returns one row per
    run; `pandas.DataFrame` accepts the rows.

    scenes: a scene, or a mapping from names to scenes.
    threads, isas: the numbers of threads and the instruction sets to vary; empty isas are all that
        this machine supports.
    min_weights, samples, adaptive: the values of Scene.min_weight, the samples per pixel, and the
        pairs of samples and contrast to vary; None takes the defaults of `packtrace report`.
    repetitions: of each run; the runs take turns.
    truth_samples: samples per pixel of the truth for sampling.
    threshold: a pixel with a larger error counts as off.
    progress: receives the present activity and the share of it that is done. An exception in it, or
        Ctrl-C, ends the report, one frame later.

    Columns are those of `packtrace report`'s report.csv (docs/report.md): scene, width, height
    (pixels), study, run, kernel, precision, isa, accuracy, lanes, threads, depth, min_weight, samples,
    adaptive, median_s (seconds), spread, rays, cut_rays, cut_bound, rmse, max_abs, psnr (decibels),
    pixels, pixels_off, pareto, errors. A value that a run does not have is None.
    """
    if not hasattr(_packtrace, "report"):
        raise RuntimeError("this build of packtrace has no reports; build it with "
                           "-DPACKTRACE_BUILD_STUDY=ON")
    function("progress", progress)
    named = scenes if isinstance(scenes, Mapping) else {"scene": scenes}
    rows: List[Row] = []
    for name, scene in named.items():
        rows += _packtrace.report(scene, name, threads, isas, min_weights, samples, adaptive,
                                  repetitions, truth_samples, threshold, progress)
    return rows
