"""Converts arguments to arrays of float64, and broadcasts them."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core

Progress = Callable[[int, int], object]


def doubles(name: str, value: ArrayLike, width: int = 1) -> NDArray[np.float64]:
    """An array of float64 (..., width), or (...) if width is 1.

    An aligned array of float64 is returned as it is, whatever its strides.
    """
    array = np.asarray(value)
    if array.dtype.kind not in "fiubO" or array.dtype.itemsize > 8:
        raise TypeError(f"{name}: expected real numbers, found {array.dtype}")
    array = np.require(array, np.float64, "A")
    if width > 1 and (array.ndim == 0 or array.shape[-1] != width):
        raise ValueError(
            f"{name}: expected the shape (..., {width}), found {array.shape}"
        )
    return array


def broadcast(*parts: tuple[str, tuple[int, ...]]) -> tuple[int, ...]:
    """The shape that named shapes broadcast to."""
    try:
        return np.broadcast_shapes(*(shape for _, shape in parts))
    except ValueError:
        text = ", ".join(f"{name} {shape}" for name, shape in parts)
        raise ValueError(f"shapes that do not broadcast: {text}") from None


def workers(threads: int | None) -> int:
    """The number of threads: None stands for one per processor."""
    if threads is None:
        if hasattr(os, "sched_getaffinity"):
            return len(os.sched_getaffinity(0))
        return os.cpu_count() or 1
    if threads < 1:
        raise ValueError(f"threads: expected at least 1, found {threads}")
    return int(threads)


def place(index: int, shape: tuple[int, ...]) -> str:
    """How messages name element `index` of an array."""
    if len(shape) == 0:
        return ""
    where = tuple(int(i) for i in np.unravel_index(index, shape))
    return f" {where[0]}" if len(where) == 1 else f" {where}"


class Lines:
    """Lines of any shape, broadcast; raises ValueError for a refused one.

    to: the other ends of segments, in place of directions.
    """

    def __init__(
        self,
        origins: ArrayLike,
        directions: ArrayLike | None,
        tmin: ArrayLike,
        tmax: ArrayLike,
        to: ArrayLike | None,
    ) -> None:
        if (directions is None) == (to is None):
            raise TypeError("expected either directions or to")
        self.segments = to is not None
        if self.segments and not (
            np.array_equal(tmin, 0) and np.array_equal(tmax, np.inf)
        ):
            raise TypeError("tmin and tmax need directions; t of to is 0 to 1")
        second = "to" if self.segments else "directions"
        self.arrays = (
            doubles("origins", origins, 3),
            doubles(second, to if directions is None else directions, 3),
            doubles("tmin", tmin),
            doubles("tmax", tmax),
        )
        o, d, start, end = self.arrays
        self.shape = broadcast(
            ("origins", o.shape[:-1]),
            (second, d.shape[:-1]),
            ("tmin", start.shape),
            ("tmax", end.shape),
        )

    def broadcast_to(self, shape: tuple[int, ...]) -> _core.Lines:
        """The arrays of these lines, as views of this shape."""
        o, d, start, end = self.arrays
        return _core.Lines(
            np.broadcast_to(o, (*shape, 3)),
            np.broadcast_to(d, (*shape, 3)),
            np.broadcast_to(start, shape),
            np.broadcast_to(end, shape),
            self.segments,
        )

    def flat(self) -> _core.Lines:
        """The arrays of these lines with one axis."""
        o, d, start, end = self.arrays
        return _core.Lines(
            np.broadcast_to(o, (*self.shape, 3)).reshape(-1, 3),
            np.broadcast_to(d, (*self.shape, 3)).reshape(-1, 3),
            np.broadcast_to(start, self.shape).reshape(-1),
            np.broadcast_to(end, self.shape).reshape(-1),
            self.segments,
        )

    def refuse(self) -> ValueError:
        """The error that names the first refused line and the reason."""
        index, status = _core.first_bad_line(self.broadcast_to(self.shape))
        return ValueError(
            f"line{place(index, self.shape)}: {_core.strerror(status)}"
        )


def empty(shape: tuple[int, ...], kind: Any) -> NDArray[Any]:
    return np.empty(shape, kind)
