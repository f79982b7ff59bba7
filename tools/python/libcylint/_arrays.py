"""Converts arguments to arrays, and broadcasts them."""

from __future__ import annotations

import operator
import os
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core

Progress = Callable[[int, int], object]


def doubles(name: str, value: ArrayLike, width: int = 1) -> NDArray[np.float64]:
    """An array of float64 (..., width), or (...) if width is 1.

    An aligned array of float64 is returned as it is, whatever its strides.  A
    new array is read-only, so that `owned` does not copy it.
    """
    given = np.asarray(value)
    if given.dtype.kind not in "fiubO":
        raise TypeError(f"{name}: expected real numbers, found {given.dtype}")
    if given.dtype.itemsize > 8:
        raise TypeError(
            f"{name}: {given.dtype} (longdouble) has digits that float64 has "
            "not; round it by astype(float)"
        )
    array = np.require(given, np.float64, "A")
    if array is not given or isinstance(value, (list, tuple)):
        array.flags.writeable = False
    if width > 1 and (array.ndim == 0 or array.shape[-1] != width):
        raise ValueError(
            f"{name}: expected the shape (..., {width}), found {array.shape}"
        )
    return array


def integers(name: str, value: ArrayLike) -> NDArray[np.int64]:
    """An array of int64 (...)."""
    array = np.asarray(value)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name}: expected integers, found {array.dtype}")
    return np.require(array, np.int64, "A")


def _is_fixed(array: NDArray[Any]) -> bool:
    """Whether an array, and the arrays that it is a view of, are read-only."""
    base: Any = array
    while isinstance(base, np.ndarray) and not base.flags.writeable:
        base = base.base
    return base is None


def owned(array: NDArray[np.float64]) -> NDArray[np.float64]:
    """These numbers, in memory that nobody else writes to: the array itself if it
    is read-only, else a copy.  Axes along which it does not change are not copied.
    """
    if _is_fixed(array):
        return array
    once = array[tuple(slice(None if step else 1) for step in array.strides)]
    return np.broadcast_to(once.copy(), array.shape)


def new_copy(
    array: NDArray[np.float64], shape: tuple[int, ...]
) -> NDArray[np.float64] | None:
    """Memory for a copy of vectors (..., 3) that _core makes beside its answers of
    this shape; None if `owned` does with less."""
    whole = array.shape[:-1] == shape and 0 not in array.strides
    return np.empty(array.shape) if whole and not _is_fixed(array) else None


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
    try:
        count = operator.index(threads)
    except TypeError:
        raise TypeError(
            f"threads: expected an integer, found {threads!r}"
        ) from None
    if count < 1:
        raise ValueError(f"threads: expected at least 1, found {count}")
    return count


def counted(count: int | np.integer[Any], noun: str) -> str:
    """How a repr shows a number of things."""
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def place(index: int, shape: tuple[int, ...]) -> str:
    """How messages name element `index` of an array."""
    if len(shape) == 0:
        return ""
    where = tuple(int(i) for i in np.unravel_index(index, shape))
    return f" {where[0]}" if len(where) == 1 else f" {where}"


def shapes_of(
    scene: _core.Scene, index: NDArray[np.int64] | None, closed: bool = False
) -> tuple[NDArray[np.void], NDArray[np.int64]]:
    """Records of the shapes of a scene with these numbers, each once, and an index
    into the records for each number; -1 stays.  None: all shapes, in order.
    closed: as closed solids."""
    record = np.dtype((np.void, _core.shape_members()["size"]))
    if index is None:
        records = np.empty(scene.size(), record)
        scene.take(None, records, closed)
        return records, np.arange(len(records))
    numbers, places = np.unique(index, return_inverse=True)
    records = np.empty(len(numbers), record)
    scene.take(numbers, records, closed)
    return records, np.where(index < 0, -1, places.reshape(index.shape))
