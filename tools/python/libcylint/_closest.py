"""The points of surfaces that are closest to given points."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._arguments import Doubles, Points, counted, workers
from ._described import Described, member


class ClosestPoints(Described):
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

    _columns = ("distance", "part", "feature", "point", "normal")

    def __init__(self, given: Points, distance: Doubles) -> None:
        super().__init__(given, distance.shape)
        self.distance = distance

    def _write(self, columns: list[NDArray[Any] | None]) -> None:
        shapes, index = self._shapes
        points, threads = self._given.array, workers(self._given.threads)
        _core.closest(shapes.kind, index, points, 0.0, columns, threads, None)

    part: NDArray[np.int8] = member(
        "(...) int8, a value of `Part`; -1 for none.", kind=np.int8
    )
    feature: NDArray[np.int8] = member(
        "(...) int8, a value of `Feature`; -1 for none.", kind=np.int8
    )
    point: Doubles = member("(..., 3): the closest points of the surfaces; nan for none.", 3)
    normal: Doubles = member("(..., 3): the outward unit normals there; nan for none.", 3)

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
