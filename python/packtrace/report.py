"""Error against run time: a scene rendered in many ways, each timed and held against the truth."""

from __future__ import annotations

from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Tuple, Union

from . import _packtrace
from .scene import Scene

Row = Dict[str, Union[str, int, float, None]]


def report(scenes: Union[Scene, Mapping[str, Scene]], *, threads: Sequence[int] = (1, 2),
           isas: Sequence[str] = (), min_weights: Optional[Sequence[float]] = None,
           samples: Optional[Sequence[int]] = None,
           adaptive: Optional[Sequence[Tuple[int, float]]] = None, repetitions: int = 9,
           truth_samples: int = 256, threshold: float = 1 / 255,
           progress: Optional[Callable[[str, float], Any]] = None) -> List[Row]:
    """Renders scenes in many ways and says what each takes and how far off it is: one row a run,
    which `pandas.DataFrame` takes as they are.

    scenes: a scene, or scenes by name.
    threads, isas: numbers of threads, and instruction sets (none: all of this machine), to vary.
    min_weights, samples, adaptive: Scene.min_weight, samples a pixel, and pairs of samples and
        contrast, to vary; None leaves them as `packtrace report` has them.
    repetitions: of each run, in turns. truth_samples: a pixel, of what sampling is held against.
    progress: called with what is being done and the share of it done. What it raises, and Ctrl-C,
        end the report, a frame later.

    Columns are those of `packtrace report`'s report.csv (docs/report.md): scene, width, height
    (pixels), study, run, kernel, precision, isa, accuracy, lanes, threads, depth, min_weight, samples,
    adaptive, median_s (seconds), spread, rays, cut_rays, cut_bound, rmse, max_abs, psnr (decibels),
    pixels, pixels_off, pareto, errors. None stands where a run has no such thing.
    """
    if not hasattr(_packtrace, "report"):
        raise RuntimeError("this build of packtrace has no reports; build it with "
                           "-DPACKTRACE_BUILD_STUDY=ON")
    named = scenes if isinstance(scenes, Mapping) else {"scene": scenes}
    rows: List[Row] = []
    for name, scene in named.items():
        rows += _packtrace.report(scene, name, threads, isas, min_weights, samples, adaptive,
                                  repetitions, truth_samples, threshold, progress)
    return rows
