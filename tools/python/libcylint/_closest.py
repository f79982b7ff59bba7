"""The points of surfaces that are closest to given points."""

from __future__ import annotations

from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._arguments import Points
from ._arrays import Progress, broadcast, counted, shapes_of, workers


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

    distance: NDArray[np.float64]

    def __init__(
        self,
        records: NDArray[np.void] | None,
        index: NDArray[np.int64] | None,
        points: NDArray[np.float64],
        distance: NDArray[np.float64],
        threads: int | None,
    ) -> None:
        """index: the shapes' numbers, -1 for none; None: a record for each
        point.  points: (..., 3), broadcast.  They and records must not
        change."""
        self._source = (records, index, points, threads)
        self.distance = distance

    @property
    def _shapes(self) -> tuple[NDArray[np.void], NDArray[np.int64] | None]:
        return self._source[:2]

    def _write(
        self,
        *,
        distance: NDArray[Any] | None = None,
        part: NDArray[Any] | None = None,
        feature: NDArray[Any] | None = None,
        point: NDArray[Any] | None = None,
        normal: NDArray[Any] | None = None,
        progress: Progress | None = None,
    ) -> None:
        """Computes the arrays that are given."""
        _, _, points, threads = self._source
        records, index = self._shapes
        columns = (distance, part, feature, point, normal)
        _core.closest(
            records, index, points, columns, workers(threads), progress
        )

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
    def point(self) -> NDArray[np.float64]:
        """(..., 3): the closest points of the surfaces; nan for none."""
        point = np.empty((*self.distance.shape, 3))
        self._write(point=point)
        return point

    @cached_property
    def normal(self) -> NDArray[np.float64]:
        """(..., 3): the outward unit normals there; nan for none."""
        normal = np.empty((*self.distance.shape, 3))
        self._write(normal=normal)
        return normal

    def __repr__(self) -> str:
        found = np.count_nonzero(np.isfinite(self.distance))
        name = type(self).__name__
        shape = self.distance.shape
        return f"<libcylint.{name} {shape}: {counted(found, 'distance')}>"


def closest_points(records: NDArray[np.void], points: Points) -> ClosestPoints:
    """The answer for shapes and points, broadcast."""
    shape = broadcast(("shapes", records.shape), ("points", points.shape))
    answer = ClosestPoints(
        np.broadcast_to(records, shape),
        None,
        points.broadcast_to(shape),
        np.empty(shape),
        points.threads,
    )
    answer._write(distance=answer.distance, progress=points.progress)
    return answer


class ClosestShapes(ClosestPoints):
    """What `Scene.closest` returns: the shape that is closest to each point.

    index: (...) int64, the number of the shape; -1 for none within the radius.
    distance: (...), from the point to its surface, negative inside; nan for
    none.  If signed distances were compared, the surface is that of the closed
    solid.

    part, feature, point and normal are as of `ClosestPoints`.
    """

    index: NDArray[np.int64]

    def __init__(
        self,
        scene: _core.Scene,
        index: NDArray[np.int64],
        points: NDArray[np.float64],
        distance: NDArray[np.float64],
        threads: int | None,
        signed: bool,
    ) -> None:
        super().__init__(None, index.copy(), points, distance, threads)
        self.index = index
        self._scene = scene
        self._signed = signed

    @cached_property
    def _shapes(self) -> tuple[NDArray[np.void], NDArray[np.int64]]:  # type: ignore[override]
        return shapes_of(self._scene, self._source[1], self._signed)


class ShapesWithin(NamedTuple):
    """What `Scene.within` returns: an element for each point and shape near it.

    point: (k,) int64, the number of the point, ascending; of points in several
    axes the number in C order.
    index: (k,) int64, the number of the shape, ascending for each point.
    distance: (k,), from the point to its surface, negative inside.
    """

    point: NDArray[np.int64]
    index: NDArray[np.int64]  # type: ignore[assignment]
    distance: NDArray[np.float64]
