"""Members of hits that are computed when they are first used."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._arguments import Lines
from ._arrays import workers

_MEMBERS = ("point", "normal", "z", "phi", "side", "outside", "inside")
_POINTS = ("point", "normal", "outside", "inside")


class DescribedHits:
    """Hits with their shapes and lines.  A member has the axes of t; points and
    vectors have one axis more, of length 3."""

    t: NDArray[np.float64]

    def __init__(
        self,
        records: NDArray[np.void] | None,
        index: NDArray[np.int64] | None,
        lines: Lines,
        shape: tuple[int, ...],
        threads: int | None,
    ) -> None:
        """index: the shapes' numbers, of the nearest hits; None: two hits of
        each of the records, which have the axes `shape`, as the lines.  The
        arrays must not change."""
        self._source = (records, index, lines, shape, threads)

    @property
    def _shapes(self) -> tuple[NDArray[np.void], NDArray[np.int64] | None]:
        return self._source[:2]

    def _describe(self, member: str) -> NDArray[Any]:
        _, _, lines, shape, threads = self._source
        records, index = self._shapes
        axes = (*self.t.shape, 3) if member in _POINTS else self.t.shape
        column = np.empty(axes, np.int8 if member == "side" else np.float64)
        _core.describe(
            records,
            index,
            lines.broadcast_to(shape),
            index is not None,
            tuple(column if name == member else None for name in _MEMBERS),
            workers(threads),
            None,
        )
        return column

    @cached_property
    def point(self) -> NDArray[np.float64]:
        """(..., 3): the points o + t d; nan for none."""
        return self._describe("point")

    @cached_property
    def normal(self) -> NDArray[np.float64]:
        """(..., 3): the outward unit normals; nan for none."""
        return self._describe("normal")

    @cached_property
    def z(self) -> NDArray[np.float64]:
        """(...): axial coordinates, 0 at the base, 1 at the top."""
        return self._describe("z")

    @cached_property
    def phi(self) -> NDArray[np.float64]:
        """(...): angles about the axis divided by 2 pi, in [0, 1)."""
        return self._describe("phi")

    @cached_property
    def side(self) -> NDArray[np.int8]:
        """(...) int8, a value of `Side`; -1 for none."""
        return self._describe("side")

    @cached_property
    def outside(self) -> NDArray[np.float64]:
        """(..., 3): points next to `point` that are outside the shape.

        `point` is rounded, so it is as often inside the shape as outside.  A ray
        that starts at `outside` and points away from a convex shape misses it.
        nan for none.

        >>> ball = cylint.sphere([0, 0, 0], 1)
        >>> d = np.random.default_rng(1).normal(size=(1000, 3))
        >>> hit = cylint.intersect(ball, [0, 0, 0], d)
        >>> int((ball.contains(hit.point[:, 0]) == 1).sum()) > 100
        True
        >>> int((ball.contains(hit.outside[:, 0]) == 1).sum())
        0
        >>> int(cylint.intersect(ball, hit.outside[:, 0], d).n.sum())
        0
        """
        return self._describe("outside")

    @cached_property
    def inside(self) -> NDArray[np.float64]:
        """(..., 3): points next to `point` that are inside the shape.

        A ray that starts there hits the surface of a bounded convex shape once.
        nan for none, and where the shape is thinner than the steps of float64.
        """
        return self._describe("inside")
