"""Converts arguments for the compiled part. Wrong ones raise ValueError, in one line that shows the
value and says what to use."""

from __future__ import annotations

import operator
import os
from typing import Any, Callable, Optional, Union

import numpy as np

Path = Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"]


def shown(value: Any) -> str:
    """A short text of a value, on one line."""
    line = " ".join(part.strip() for part in repr(value).splitlines())
    return line if len(line) <= 60 else line[:60] + "..."


def whole(name: str, value: Any, most: int = 2**31 - 1) -> int:
    try:
        result = operator.index(value)
    except TypeError:
        raise ValueError(f"{name} is {shown(value)}; use a whole number") from None
    if not 0 <= result <= most:
        raise ValueError(f"{name} is {result}; use a whole number from 0 to {most}")
    return result


def number(name: str, value: Any) -> float:
    try:
        if isinstance(value, (str, bytes)):  # float() would read it
            raise TypeError
        return float(value)
    except (TypeError, ValueError):
        raise ValueError(f"{name} is {shown(value)}; use a number") from None
    except OverflowError:
        raise ValueError(f"{name} is beyond double precision; use a smaller number") from None


def function(name: str, value: Optional[Callable[..., Any]]) -> Optional[Callable[..., Any]]:
    """A function, or None. Checked before the work that calls it begins."""
    if value is not None and not callable(value):
        raise TypeError(f"{name} is {shown(value)}; use a function or None")
    return value


def precision(dtype: Any) -> np.dtype[Any]:
    """The dtype of the argument `dtype`, float32 or float64."""
    try:
        result: np.dtype[Any] = np.dtype(dtype)
    except (TypeError, ValueError):
        raise ValueError(f"dtype is {shown(dtype)}; use np.float32 or np.float64") from None
    if result not in (np.float32, np.float64):
        raise ValueError(f"dtype is {result}; use np.float32 or np.float64")
    return result


def text(name: str, value: Any) -> bytes:
    """A text as UTF-8. Surrogate escapes become the bytes of a scene in another encoding."""
    if not isinstance(value, (str, bytes)):
        raise ValueError(f"{name} is {shown(value)}; use a text")
    return value if isinstance(value, bytes) else value.encode(errors="surrogateescape")


def file_name(file: Path) -> bytes:
    """A file's name in the system's encoding, which need not be UTF-8. Rejects a zero byte, which
    would end the name."""
    name = os.fsencode(file)
    if b"\0" in name:
        raise ValueError(f"the file name {os.fsdecode(name)!r} has a zero byte; use a name without")
    return name
