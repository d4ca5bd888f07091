"""Arguments of functions, as the compiled part takes them. What is wrong raises ValueError, in one line
that says what it is and what to use."""

from __future__ import annotations

import operator
import os
from typing import Any, Union

import numpy as np

Path = Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"]


def shown(value: Any) -> str:
    """What a value is, on one line that is not long."""
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
        if isinstance(value, (str, bytes)):  # which Python would read
            raise TypeError
        return float(value)
    except (TypeError, ValueError):
        raise ValueError(f"{name} is {shown(value)}; use a number") from None
    except OverflowError:
        raise ValueError(f"{name} is beyond double precision; use a smaller number") from None


def precision(dtype: Any) -> np.dtype[Any]:
    """What the argument `dtype` names."""
    try:
        result: np.dtype[Any] = np.dtype(dtype)
    except (TypeError, ValueError):
        raise ValueError(f"dtype is {shown(dtype)}; use np.float32 or np.float64") from None
    if result not in (np.float32, np.float64):
        raise ValueError(f"dtype is {result}; use np.float32 or np.float64")
    return result


def text(name: str, value: Any) -> bytes:
    """A text as UTF-8; what a scene in another encoding had for bytes, as those."""
    if not isinstance(value, (str, bytes)):
        raise ValueError(f"{name} is {shown(value)}; use a text")
    return value if isinstance(value, bytes) else value.encode(errors="surrogateescape")


def file_name(file: Path) -> bytes:
    """A file's name as the system has it, which need not be UTF-8. A zero byte would end it there."""
    name = os.fsencode(file)
    if b"\0" in name:
        raise ValueError(f"the file name {os.fsdecode(name)!r} has a zero byte; use a name without")
    return name
