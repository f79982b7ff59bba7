"""The points of surfaces that are closest to given points."""

from __future__ import annotations

from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._arguments import Doubles, Points, Progress, counted, workers


class ClosestPoints:
    """What `Shapes.closest` returns, for each shape and point.

    distance: (...), from the point to the surface, as `Shapes.distance`.

    The others are computed when they are first used, from a copy of the points,
    24 bytes each; points that are read-only are not copied.  part and feature
    are (...); point and normal are (..., 3).

    If several points of the surface are closest, the answer is the first of
    these: on the lateral surface, on cap 0, on cap 1; on the nappe of a double
    cone that holds the base; on a circle about the axis where phi is 0; on a
    sphere about the point, where the first coordinate is largest.
    """

    distance: Doubles

    def __init__(
        self, kinds: NDArray[np.int32] | None, index: NDArray[np.int64] | None,
        points: Points, distance: Doubles, threads: int | None,
    ) -> None:
        """kinds: of shapes.  index: the shapes' numbers, -1 for none; None: the
        shapes broadcast with the points.  They and points must not change."""
        self._source = (kinds, index, points.array, threads)
        self.distance = distance

    @property
    def _shapes(self) -> tuple[NDArray[np.int32], NDArray[np.int64] | None]:
        return self._source[:2]  # type: ignore[return-value]

    def _write(self, progress: Progress | None = None, **wanted: NDArray[Any]) -> None:
        """Computes the arrays that are given."""
        _, _, points, threads = self._source
        kinds, index = self._shapes
        names = ("distance", "part", "feature", "point", "normal")
        columns = [wanted.get(name) for name in names]
        _core.closest(kinds, index, points, None, columns, workers(threads), progress)

    @cached_property
    def _where(self) -> tuple[NDArray[np.int8], NDArray[np.int8]]:
        shape = self.distance.shape
        part, feature = np.empty(shape, np.int8), np.empty(shape, np.int8)
        self._write(part=part, feature=feature)
        feature[part < 0] = -1
        return part, feature

    @property
    def part(self) -> NDArray[np.int8]:
        """(...) int8, a value of `Part`; -1 for none."""
        return self._where[0]

    @property
    def feature(self) -> NDArray[np.int8]:
        """(...) int8, a value of `Feature`; -1 for none."""
        return self._where[1]

    @cached_property
    def point(self) -> Doubles:
        """(..., 3): the closest points of the surfaces; nan for none."""
        point = np.empty((*self.distance.shape, 3))
        self._write(point=point)
        return point

    @cached_property
    def normal(self) -> Doubles:
        """(..., 3): the outward unit normals there; nan for none."""
        normal = np.empty((*self.distance.shape, 3))
        self._write(normal=normal)
        return normal

    def __repr__(self) -> str:
        found = np.count_nonzero(np.isfinite(self.distance))
        name, shape = type(self).__name__, self.distance.shape
        return f"<libcylint.{name} {shape}: {counted(found, 'distance')}>"


class ShapesWithin(NamedTuple):
    """What `Scene.within` returns: an element for each point and shape near it.

    point: (k,) int64, the number of the point, ascending; of points in several
    axes the number in C order.
    index: (k,) int64, the number of the shape, ascending for each point.
    distance: (k,), from the point to its surface, negative inside.
    """

    point: NDArray[np.int64]
    index: NDArray[np.int64]  # type: ignore[assignment]
    distance: Doubles
