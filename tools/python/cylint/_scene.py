"""Many lines at many shapes, by a hierarchy of boxes."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import Lines, Progress, workers
from ._hits import DescribedHits
from ._shapes import Shapes


class NearestHits(DescribedHits):
    """What `Scene.nearest` returns: the first hit of each line.

    index: (...) int64, the number of the shape; -1 for none.
    t: (...); nan for none.
    part: (...) int8, a value of `Part`; -1 for none.

    The others are computed when they are first used, from the arrays that were
    given to `Scene.nearest`.  Do not change these arrays before.  z, phi and side
    are (...); point, normal, outside and inside are (..., 3).
    """

    index: NDArray[np.int64]
    t: NDArray[np.float64]
    part: NDArray[np.int8]

    def __init__(
        self, records: NDArray[np.void], lines: Lines, threads: int | None
    ) -> None:
        self.index = np.empty(lines.shape, np.int64)
        self.t = np.empty(lines.shape)
        self.part = np.empty(lines.shape, np.int8)
        super().__init__(records, self.index, lines, lines.shape, threads)

    def __repr__(self) -> str:
        found = np.count_nonzero(self.index >= 0)
        return f"<cylint.NearestHits {self.index.shape}: {found} hits>"


class AllHits(NamedTuple):
    """What `Scene.all` returns: an element for each line and shape that it hits.

    line: (k,) int64, the number of the line, ascending; of lines in several
    axes the number in C order.
    index: (k,) int64, the number of the shape, ascending for each line.
    t: (k, 2), ascending; nan if there is no second hit.
    """

    line: NDArray[np.int64]
    index: NDArray[np.int64]  # type: ignore[assignment]
    t: NDArray[np.float64]


class Scene:
    """Shapes in a hierarchy of boxes, for many lines.

    shapes: one axis.  Their numbers are 0 to len(shapes) - 1.
    threads: of building the scene, and of all queries that do not say;
    None: one per processor.

    The answers are those of `intersect` with every shape, bit for bit.

    >>> x = np.arange(1000.0)
    >>> posts = cylint.cylinder(np.c_[x, 0 * x, 0 * x], np.c_[x, 0 * x, 2 + 0 * x], 0.25)
    >>> scene = cylint.Scene(posts)
    >>> near = scene.nearest([[7, -9, 1], [7.5, -9, 1]], [0, 1, 0])
    >>> near.index, near.t
    (array([ 7, -1]), array([8.75,  nan]))
    >>> near.point[0]
    array([ 7.  , -0.25,  1.  ])
    >>> scene.count([-1, 0, 1], [1, 0, 0], tmax=[10, 100])
    array([ 10, 100])
    """

    def __init__(self, shapes: Shapes, *, threads: int | None = None) -> None:
        if shapes.ndim > 1:
            raise ValueError(
                f"shapes: expected one axis, found the shape {shapes.shape}"
            )
        self._threads = threads
        self._records = np.ascontiguousarray(np.atleast_1d(shapes._records))
        self._scene = _core.Scene(self._records, workers(threads))

    @property
    def shapes(self) -> Shapes:
        """The shapes, in their order."""
        return Shapes(self._records)

    @property
    def nbytes(self) -> int:
        """The bytes of memory of the hierarchy, without the shapes."""
        return self._scene.bytes()

    def __len__(self) -> int:
        return len(self._records)

    def __repr__(self) -> str:
        return f"<cylint.Scene: {len(self)} shapes>"

    def __reduce__(self) -> tuple[Any, ...]:
        return _restore, (self.shapes, self._threads)

    def _choose(self, threads: int | None) -> int | None:
        return self._threads if threads is None else threads

    def nearest(
        self,
        origins: ArrayLike,
        directions: ArrayLike | None = None,
        tmin: ArrayLike = 0.0,
        tmax: ArrayLike = np.inf,
        *,
        to: ArrayLike | None = None,
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> NearestHits:
        """The first shape that each line hits, that of least t.

        Arguments as of `intersect`.  At equal t the lower number is first.
        """
        chosen = self._choose(threads)
        lines = Lines(origins, directions, tmin, tmax, to)
        hits = NearestHits(self._records, lines, chosen)
        columns = (hits.index, hits.t, hits.part)
        if not self._scene.nearest(
            lines.broadcast_to(lines.shape), columns, workers(chosen), progress
        ):
            raise lines.refuse()
        return hits

    def _count(
        self,
        kind: Any,
        enough: int,
        lines: Lines,
        threads: int | None,
        progress: Progress | None,
    ) -> NDArray[Any]:
        counts = np.empty(lines.shape, kind)
        if not self._scene.count(
            lines.broadcast_to(lines.shape),
            counts,
            enough,
            workers(self._choose(threads)),
            progress,
        ):
            raise lines.refuse()
        return counts

    def any(
        self,
        origins: ArrayLike,
        directions: ArrayLike | None = None,
        tmin: ArrayLike = 0.0,
        tmax: ArrayLike = np.inf,
        *,
        to: ArrayLike | None = None,
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> NDArray[np.bool_]:
        """Whether each line hits a shape: (...) bool."""
        lines = Lines(origins, directions, tmin, tmax, to)
        return self._count(np.bool_, 1, lines, threads, progress)

    def count(
        self,
        origins: ArrayLike,
        directions: ArrayLike | None = None,
        tmin: ArrayLike = 0.0,
        tmax: ArrayLike = np.inf,
        *,
        to: ArrayLike | None = None,
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> NDArray[np.int64]:
        """How many shapes each line hits: (...) int64."""
        lines = Lines(origins, directions, tmin, tmax, to)
        return self._count(np.int64, 0, lines, threads, progress)

    def all(
        self,
        origins: ArrayLike,
        directions: ArrayLike | None = None,
        tmin: ArrayLike = 0.0,
        tmax: ArrayLike = np.inf,
        *,
        to: ArrayLike | None = None,
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> AllHits:
        """All shapes that each line hits, as flat arrays.

        >>> scene = cylint.Scene(cylint.cylinder([[0, 0, 0], [4, 0, 0]], [[0, 0, 1], [4, 0, 1]], 1))
        >>> scene.all([[-5, 0, 0.5], [0, -5, 0.5]], [[1, 0, 0], [0, 1, 0]])
        AllHits(line=array([0, 0, 1]), index=array([0, 1, 0]), t=array([[ 4.,  6.],
               [ 8., 10.],
               [ 4.,  6.]]))
        """
        lines = Lines(origins, directions, tmin, tmax, to)
        found = self._scene.all(
            lines.flat(), workers(self._choose(threads)), progress
        )
        if found is None:
            raise lines.refuse()
        size = found.size()
        hits = AllHits(
            np.empty(size, np.int64),
            np.empty(size, np.int64),
            np.empty((size, 2)),
        )
        found.write(tuple(hits))
        return hits


def _restore(shapes: Shapes, threads: int | None) -> Scene:
    return Scene(shapes, threads=threads)
