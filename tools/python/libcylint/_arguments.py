"""Arguments that several functions share: lines, points, balls."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
from inspect import Parameter, signature
from typing import Concatenate, ParamSpec, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import (
    Progress,
    broadcast,
    doubles,
    integers,
    new_copy,
    owned,
    place,
)

_P = ParamSpec("_P")
_Self = TypeVar("_Self")
_Made = TypeVar("_Made")
_Answer = TypeVar("_Answer")


def takes(
    make: Callable[_P, _Made],
) -> Callable[
    [Callable[[_Self, _Made], _Answer]],
    Callable[Concatenate[_Self, _P], _Answer],
]:
    """Gives function(self, made) the arguments from which `make` makes `made`."""

    def decorate(
        function: Callable[[_Self, _Made], _Answer],
    ) -> Callable[Concatenate[_Self, _P], _Answer]:
        @wraps(function)
        def call(self: _Self, /, *args: _P.args, **named: _P.kwargs) -> _Answer:
            return function(self, make(*args, **named))

        own = signature(function)
        first = next(iter(own.parameters.values()))
        shown = [
            first.replace(kind=Parameter.POSITIONAL_ONLY),
            *signature(make).parameters.values(),
        ]
        call.__signature__ = own.replace(parameters=shown)  # type: ignore[attr-defined]
        return call

    return decorate


class Lines:
    """Lines of any shape, broadcast.

    to: the other ends of segments, in place of directions.
    errors: "mask" if lines that are refused hit nothing; else they are raised.
    """

    def __init__(
        self,
        origins: ArrayLike,
        directions: ArrayLike | None = None,
        tmin: ArrayLike = 0.0,
        tmax: ArrayLike = np.inf,
        *,
        to: ArrayLike | None = None,
        errors: str = "raise",
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> None:
        if errors not in ("raise", "mask"):
            raise ValueError(
                f"errors: expected raise or mask, found {errors!r}"
            )
        self.masked = errors == "mask"
        self.threads = threads
        self.progress = progress
        ends = to if directions is None else directions
        if ends is None or not (directions is None or to is None):
            raise TypeError("expected either directions or to")
        self.segments = to is not None
        if self.segments and not (
            np.array_equal(tmin, 0) and np.array_equal(tmax, np.inf)
        ):
            raise TypeError("tmin and tmax need directions; t of to is 0 to 1")
        second = "to" if self.segments else "directions"
        self.arrays: tuple[NDArray[np.float64], ...] = (
            doubles("origins", origins, 3),
            doubles(second, ends, 3),
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

    def keep(self) -> None:
        """Lets these lines own their arrays, for members computed later."""
        self.arrays = tuple(owned(array) for array in self.arrays)

    @contextmanager
    def kept(
        self, shape: tuple[int, ...]
    ) -> Iterator[list[NDArray[np.float64] | None]]:
        """The same, at the end of the block, which copies the larger arrays.

        Yields arrays for the origins and for the directions, None for those
        that the block does not copy.
        """
        copies = [new_copy(array, shape) for array in self.arrays[:2]]
        yield copies
        self.arrays = tuple(
            owned(array) if copy is None else copy
            for array, copy in zip(
                self.arrays, [*copies, None, None], strict=True
            )
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
            self.masked,
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
            self.masked,
        )

    def refuse(self) -> ValueError:
        """The error that names the first refused line and the reason."""
        index, status = _core.first_bad_line(self.broadcast_to(self.shape))
        return ValueError(
            f"line{place(index, self.shape)}: {_core.strerror(status)}"
        )


class SceneLines(Lines):
    """Lines of any shape, each of which can leave out a shape of a scene.

    exclude: the number of the shape, -1 for none.
    """

    def __init__(
        self,
        origins: ArrayLike,
        directions: ArrayLike | None = None,
        tmin: ArrayLike = 0.0,
        tmax: ArrayLike = np.inf,
        *,
        to: ArrayLike | None = None,
        exclude: ArrayLike = -1,
        errors: str = "raise",
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> None:
        super().__init__(
            origins,
            directions,
            tmin,
            tmax,
            to=to,
            errors=errors,
            threads=threads,
            progress=progress,
        )
        self.numbers = integers("exclude", exclude)
        self.shape = broadcast(
            ("lines", self.shape), ("exclude", self.numbers.shape)
        )

    def excluded(self, shapes: int) -> NDArray[np.int64]:
        """The numbers that are left out, of so many shapes, as a view."""
        most = int(self.numbers.max(initial=-1))
        if most >= shapes:
            raise IndexError(
                f"exclude: found {most}, the scene has {shapes} shapes"
            )
        return np.broadcast_to(self.numbers, self.shape)


class Points:
    """Points of any shape."""

    def __init__(
        self,
        points: ArrayLike,
        *,
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> None:
        self.array = doubles("points", points, 3)
        self.shape = self.array.shape[:-1]
        self.threads = threads
        self.progress = progress

    def keep(self) -> None:
        """Lets these points own their array, for members computed later."""
        self.array = owned(self.array)

    def broadcast_to(self, shape: tuple[int, ...]) -> NDArray[np.float64]:
        """The points, as a view of this shape."""
        return np.broadcast_to(self.array, (*shape, 3))


class Balls:
    """Points with radii, broadcast.  name: of the radii, for messages.  signed:
    compare signed distances."""

    def __init__(
        self, points: Points, name: str, radii: ArrayLike, signed: bool = False
    ) -> None:
        numbers = doubles(name, radii)
        self.shape = broadcast(("points", points.shape), (name, numbers.shape))
        self.points = points.broadcast_to(self.shape)
        self.radii = np.broadcast_to(numbers, self.shape)
        self.signed = signed
        self.threads = points.threads
        self.progress = points.progress


def balls(
    points: ArrayLike,
    r: ArrayLike,
    *,
    signed: bool = False,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Balls:
    asked = Points(points, threads=threads, progress=progress)
    return Balls(asked, "r", r, signed)
