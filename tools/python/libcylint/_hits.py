"""Lines and shapes, element by element, and the members of hits."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arguments import Doubles, Lines, Progress, broadcast, counted, workers
from ._described import Described, member
from ._shapes import Shapes, checked


class DescribedHits(Described):
    """Hits with their shapes and lines.  A member has the axes of t; points and
    vectors have one axis more, of length 3."""

    t: Doubles

    _columns = ("point", "normal", "outside", "inside", "z", "phi", "side")

    def _write(self, columns: list[NDArray[Any] | None]) -> None:
        """With numbers of shapes: the nearest hit of each line.  Without: both hits."""
        shapes, index = self._shapes
        lines, threads = self._given.core(), workers(self._given.threads)
        _core.intersect(shapes.kind, index, lines, [None] * 4 + columns, threads, None)

    point: Doubles = member("(..., 3): the points o + t d; nan for none.", 3)
    normal: Doubles = member("(..., 3): the outward unit normals; nan for none.", 3)
    z: Doubles = member("(...): axial coordinates, 0 at the base, 1 at the top.")
    phi: Doubles = member("(...): angles about the axis divided by 2 pi, in [0, 1).")
    side: NDArray[np.int8] = member("(...) int8, a value of `Side`; -1 for none.", kind=np.int8)
    outside: Doubles = member(
        """(..., 3): points next to `point` that are outside the shape.

        `point` is rounded, so it is as often inside the shape as outside.  A ray
        that starts at `outside` and points away from a convex shape misses it.
        nan for none, and between the nappes of a double cone where they are nearer
        to each other than the steps of float64.

        >>> ball = cylint.sphere([0, 0, 0], 1)
        >>> d = np.random.default_rng(1).normal(size=(1000, 3))
        >>> hit = cylint.intersect(ball, [0, 0, 0], d)
        >>> int((ball.contains(hit.point[:, 0]) == 1).sum()) > 100
        True
        >>> int((ball.contains(hit.outside[:, 0]) == 1).sum())
        0
        >>> int(cylint.intersect(ball, hit.outside[:, 0], d).n.sum())
        0
        """,
        3,
    )
    inside: Doubles = member(
        """(..., 3): points next to `point` that are inside the shape.

        A ray that starts there hits a capped shape once.
        nan for none, and where the shape is thinner than the steps of float64.
        """,
        3,
    )


class Hits(DescribedHits):
    """What `intersect` returns: at most two hits for each line and shape.

    relation: (...) int8, a value of `Relation`, of the whole line; -1 for a line
    that was refused.
    n: (...) int8, the number of hits: 0, 1 or 2.
    t: (..., 2), ascending; nan for none.
    part: (..., 2) int8, a value of `Part`; -1 for none.

    The others are computed when they are first used, from a copy of the lines.
    z, phi and side are (..., 2); point, normal, outside and inside are
    (..., 2, 3).
    """

    relation: NDArray[np.int8]
    n: NDArray[np.int8]
    part: NDArray[np.int8]

    def __init__(
        self, shapes: Shapes, lines: Lines, shape: tuple[int, ...]
    ) -> None:
        self.relation = np.empty(shape, np.int8)
        self.n = np.empty(shape, np.int8)
        self.t = np.empty((*shape, 2))
        self.part = np.empty((*shape, 2), np.int8)
        self._shapes = shapes, None
        super().__init__(lines, self.t.shape)

    def __repr__(self) -> str:
        hits = counted(int(self.n.sum()), "hit")
        return f"<libcylint.Hits {self.n.shape}: {hits}>"


def intersect(
    shapes: Shapes, origins: ArrayLike, directions: ArrayLike | None = None,
    tmin: ArrayLike = 0.0, tmax: ArrayLike = np.inf, *, to: ArrayLike | None = None,
    errors: str = "raise", threads: int | None = None,
    progress: Progress | None = None,
) -> Hits:
    """Intersects lines o + t d, tmin <= t <= tmax, with shapes.

    origins, directions: (..., 3); tmin, tmax: (...).  They and the shapes
    broadcast as arrays of NumPy do: n lines and n shapes give n answers, and
    shapes[:, None] gives a row for each shape.  tmin=-np.inf gives whole lines.

    to: (..., 3), in place of directions: the lines are segments from origins to
    these points, 0 <= t <= 1, without the rounding of their difference.

    Hits are on surfaces: a ray that begins inside a solid has no hit there.
    `Scene.pieces` and `Scene.sums` compute how long lines are inside.

    threads: at most this many, and at most 64; None: one per processor.  The answer
    does not depend on it.  progress: called with (done, total) several times a second
    and at the end.  A signal such as Ctrl-C ends the call.

    Raises ValueError for the first line that is refused: a number that is not
    finite, a direction of length 0, tmin > tmax.  With errors="mask" such a line
    hits nothing: its relation is -1, and t is nan.

    The answer keeps a copy of the lines, 48 bytes each, for the members that are
    computed later.  Arrays that are read-only are not copied.

    >>> rod = cylint.cylinder([0, 0, 0], [0, 0, 1], 0.5)
    >>> hit = cylint.intersect(rod, [[0, 0, -5], [9, 0, 0]], [0, 0, 1])
    >>> hit.relation, hit.n
    (array([3, 0], dtype=int8), array([2, 0], dtype=int8))
    >>> hit.t
    array([[ 5.,  6.],
           [nan, nan]])
    >>> hit.part
    array([[ 1,  2],
           [-1, -1]], dtype=int8)
    >>> hit.normal[0]
    array([[ 0.,  0., -1.],
           [ 0.,  0.,  1.]])
    >>> cylint.intersect(rod, [0, 0, -5], to=[0, 0, 5]).t
    array([0.5, 0.6])
    >>> rays = [[0, 0, -5], [np.nan, 0, 0]]
    >>> cylint.intersect(rod, rays, [0, 0, 1], errors="mask").relation
    array([ 3, -1], dtype=int8)
    """
    lines = Lines(
        origins, directions, tmin, tmax,
        to=to, errors=errors, threads=threads, progress=progress,
    )
    (shapes,) = checked([shapes])
    kinds, shape = shapes.kind, lines.shape
    if kinds.ndim > 0 and kinds.shape != shape:
        shape = broadcast("shapes lines", kinds, np.broadcast_to(0, shape))
    hits = Hits(shapes, lines, shape)
    if not _core.intersect(
        kinds, None, lines.core(), [hits.relation, hits.n, hits.t, hits.part],
        workers(lines.threads), lines.progress,
    ):
        raise lines.refuse()
    lines.keep()
    return hits
