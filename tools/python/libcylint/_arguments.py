"""Arguments: lines, points and numbers, as arrays that NumPy broadcasts."""

from __future__ import annotations

import atexit
import operator
import os
from collections.abc import Callable
from functools import wraps
from inspect import signature
from typing import Any, Concatenate, ParamSpec, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core

Progress = Callable[[int, int], object]
Doubles = NDArray[np.float64]
_P = ParamSpec("_P")
_Self = TypeVar("_Self")
_Made = TypeVar("_Made")
_Answer = TypeVar("_Answer")
_FLOAT64 = np.dtype(np.float64)
# Types that astype(float) converts in arrays of objects, though they are no real
# numbers or lose digits
_NO_NUMBERS = type(None), str, bytes, np.longdouble, np.complexfloating, np.ma.MaskedArray
_NONE = np.array(-1)  # leaves out no shape

atexit.register(_core.end_calls)
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_core.forget_calls)


def takes(make: Callable[_P, _Made]) -> Callable[
    [Callable[[_Self, _Made], _Answer]], Callable[Concatenate[_Self, _P], _Answer]
]:
    """Gives the method function(self, made) the arguments that `make` makes `made` of."""

    def decorate(
        function: Callable[[_Self, _Made], _Answer],
    ) -> Callable[Concatenate[_Self, _P], _Answer]:
        @wraps(function)
        def call(self: _Self, /, *args: _P.args, **named: _P.kwargs) -> _Answer:
            try:
                made = make(*args, **named)
            except TypeError as error:  # of the arguments' names, too
                text = str(error).replace(f"{make.__name__}.__init__", function.__name__)
                raise TypeError(text) from None
            return function(self, made)

        own = signature(function)
        shown = [own.parameters["self"], *signature(make).parameters.values()]
        call.__signature__ = own.replace(parameters=shown)  # type: ignore[attr-defined]
        return call

    return decorate


# ---------------------------------------------------------------- arrays --


def array_of(name: str, value: ArrayLike, kind: Any = None) -> NDArray[Any]:
    """An array without masked elements: NumPy would take their numbers for data."""
    if _core.is_masked(value, np.ma.MaskedArray):
        raise ValueError(f"{name}: an element is masked")
    try:
        return np.asarray(value, kind)
    except ValueError as error:  # of rows that differ in length
        raise ValueError(f"{name}: {error}") from None


def _copied(array: NDArray[Any]) -> Doubles:
    """A read-only copy, which repeats what the array repeats by strides of 0."""
    once = array
    if array.size > 999 and 0 in array.strides:  # a few are copied in less time
        once = array[tuple(slice(None if step else 1) for step in array.strides)]
    copy = once.astype(np.float64)
    copy.setflags(write=False)
    return copy if once is array else np.broadcast_to(copy, array.shape)


def doubles(name: str, value: ArrayLike, width: int = 1) -> Doubles:
    """An array of float64 (..., width), or (...) if width is 1.

    An aligned array of float64 is returned as it is, whatever its strides.  A
    new array is read-only, so that `owned` does not copy it.
    """
    given = array = value if type(value) is np.ndarray else array_of(name, value)
    if given.dtype != _FLOAT64 or not given.flags.aligned:
        if given.dtype.kind not in "fiubO":
            raise TypeError(f"{name}: expected real numbers, found {given.dtype}")
        for kind in set(map(type, given.flat)) if given.dtype.kind == "O" else ():
            if issubclass(kind, _NO_NUMBERS):
                raise TypeError(f"{name}: expected real numbers (float64), found {kind.__name__}")
        if given.dtype.itemsize > 8:
            raise TypeError(
                f"{name}: {given.dtype} (longdouble) has digits that float64 has "
                "not; round it by astype(float)"
            )
        try:
            array = _copied(given)
        except TypeError as error:  # of Python's objects
            raise TypeError(f"{name}: {error}") from None
        except (OverflowError, ValueError) as error:
            raise ValueError(f"{name}: {error}") from None
    if array is given and isinstance(value, (list, tuple, float, int)):
        array.flags.writeable = False
    if width > 1 and (array.ndim == 0 or array.shape[-1] != width):
        raise ValueError(
            f"{name}: expected the shape (..., {width}), found {array.shape}"
        )
    return array


def integers(name: str, value: ArrayLike) -> NDArray[np.int64]:
    """An array of int64 (...)."""
    array = array_of(name, value)
    if array.dtype.kind not in "iu" and array.size > 0:  # [] has the type float64
        advice = "; of texts, np.unique(texts, return_inverse=True)[1]"
        raise TypeError(
            f"{name}: expected integers of 64 bits, found {array.dtype}"
            f"{advice if array.dtype.kind == 'U' else ''}"
        )
    if array.dtype == np.uint64 and (large := array > np.iinfo(np.int64).max).any():
        raise ValueError(f"{first_of(name, array, large)}, beyond 64 bits with a sign")
    return np.require(array, np.int64, "A")


def broadcast(names: str, *arrays: Any) -> tuple[int, ...]:
    """The shape that arrays broadcast to; `names` are theirs, for messages."""
    try:
        return np.broadcast(*arrays).shape
    except ValueError:
        text = ", ".join(
            f"{name} {array.shape}"
            for name, array in zip(names.split(), arrays, strict=True)
        )
        raise ValueError(f"shapes that do not broadcast: {text}") from None


def _is_fixed(array: NDArray[Any]) -> bool:
    """Whether an array, and the arrays that it is a view of, are read-only."""
    base: Any = array
    while isinstance(base, np.ndarray) and not base.flags.writeable:
        base = base.base
    return base is None


def owned(array: Doubles) -> Doubles:
    """These numbers, in memory that nobody else writes to: the array itself if it
    is read-only, else a copy."""
    return array if _is_fixed(array) else _copied(array)


# --------------------------------------------------------------- calls --


def whole(name: str, value: int, least: int) -> int:
    """An integer from `least` on."""
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name}: expected an integer, found {value!r}") from None
    if number < least:
        raise ValueError(f"{name}: expected at least {least}, found {number}")
    return number


def positive(name: str, value: int) -> int:
    """An integer from 1 on; numbers beyond 31 bits count as the largest."""
    return min(whole(name, value, 1), 2**31 - 1)


def workers(threads: int | None) -> int:
    """The number of threads; 0, for None, stands for one per processor."""
    return 0 if threads is None else positive("threads", threads)


def counted(count: int | np.integer[Any], noun: str) -> str:
    """How a repr shows a number of things."""
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def place(index: int, shape: tuple[int, ...]) -> str:
    """How messages name element `index` of an array."""
    if len(shape) == 0:
        return ""
    where = tuple(int(i) for i in np.unravel_index(index, shape))
    return f" {where[0]}" if len(where) == 1 else f" {where}"


def first_of(name: str, array: NDArray[Any], wrong: NDArray[np.bool_]) -> str:
    """How messages name the first wrong element of an array."""
    at = int(np.argmax(wrong))
    return f"{name}{place(at, array.shape)}: found {array.flat[at]}"


# ------------------------------------------------------ lines and points --


class Lines:
    """Lines of any shape, broadcast.

    to: the other ends of segments, in place of directions.
    exclude: the number of the shape of a scene that a line leaves out, -1 for none.
    errors: "mask" if lines that are refused hit nothing; else they are raised.
    """

    def __init__(
        self, origins: ArrayLike, directions: ArrayLike | None = None,
        tmin: ArrayLike = 0.0, tmax: ArrayLike = np.inf, *, to: ArrayLike | None = None,
        exclude: ArrayLike = -1, errors: str = "raise", threads: int | None = None,
        progress: Progress | None = None,
    ) -> None:
        if errors not in ("raise", "mask"):
            raise ValueError(f"errors: expected raise or mask, found {errors!r}")
        ends = to if directions is None else directions
        if ends is None or not (directions is None or to is None):
            raise TypeError("expected either directions or to")
        second = "directions" if to is None else "to"
        self.masked = errors == "mask"
        self.segments = to is not None
        self.threads = threads
        self.progress = progress
        o = doubles("origins", origins, 3)
        d = doubles(second, ends, 3)
        start, end = doubles("tmin", tmin), doubles("tmax", tmax)
        if self.segments and ((start != 0).any() or (end != np.inf).any()):
            raise TypeError("tmin and tmax need directions; t of to is 0 to 1")
        self.arrays = o, d, start, end
        self.shape = broadcast(
            f"origins {second} tmin tmax", o[..., 0], d[..., 0], start, end
        )
        self.left_out = _NONE
        if not (isinstance(exclude, int) and exclude == -1):
            self.left_out = integers("exclude", exclude)
            lines = np.broadcast_to(_NONE, self.shape)
            self.shape = broadcast("lines exclude", lines, self.left_out)

    def keep(self) -> None:
        """Lets these lines own their arrays, for members computed later."""
        self.arrays = tuple(map(owned, self.arrays))  # type: ignore[assignment]
        self.progress = None

    def core(self, shapes: int | None = None) -> _core.Lines:
        """shapes: how many the scene has, which bounds `exclude`."""
        numbers = self.left_out
        if shapes is not None and numbers is not _NONE:
            wrong = (numbers < -1) | (numbers >= shapes)
            if wrong.any():
                raise IndexError(
                    f"{first_of('exclude', numbers, wrong)}, the scene has {shapes} shapes"
                )
        return _core.Lines(*self.arrays, numbers, self.segments, self.masked)

    def refuse(self) -> ValueError:
        """The error that names the first refused line and the reason."""
        index, status = _core.first_bad_line(self.core())
        return ValueError(f"line{place(index, self.shape)}: {_core.strerror(status)}")


class Points:
    """Points of any shape."""

    radii: Doubles = np.array(0.0)  # without effect
    signed = False

    def __init__(
        self, points: ArrayLike, *, threads: int | None = None,
        progress: Progress | None = None,
    ) -> None:
        self.array = doubles("points", points, 3)
        self.shape = self.array.shape[:-1]
        self.threads = threads
        self.progress = progress

    def core(self, shapes: int) -> _core.Balls:
        return _core.Balls(self.array, self.radii, self.signed)

    def keep(self) -> None:
        """Lets these points own their array, for members computed later."""
        self.array = owned(self.array)
        self.progress = None


class Balls(Points):
    """Points with radii, broadcast.  signed: compare signed distances."""

    def __init__(
        self, points: ArrayLike, r: ArrayLike = np.inf, *, signed: bool = False,
        threads: int | None = None, progress: Progress | None = None,
    ) -> None:
        super().__init__(points, threads=threads, progress=progress)
        self.radii = doubles("r", r)
        self.signed = bool(signed)
        self.shape = broadcast("points r", self.array[..., 0], self.radii)
