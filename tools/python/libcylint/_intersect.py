"""Lines and shapes, element by element."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._arguments import Lines, takes
from ._arrays import broadcast, counted, workers
from ._hits import DescribedHits
from ._shapes import Shapes


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
    t: NDArray[np.float64]
    part: NDArray[np.int8]

    def __init__(
        self,
        records: NDArray[np.void],
        lines: Lines,
        shape: tuple[int, ...],
    ) -> None:
        self.relation = np.empty(shape, np.int8)
        self.n = np.empty(shape, np.int8)
        self.t = np.empty((*shape, 2))
        self.part = np.empty((*shape, 2), np.int8)
        super().__init__(records, None, lines, shape, lines.threads)

    def __repr__(self) -> str:
        hits = counted(int(self.n.sum()), "hit")
        return f"<libcylint.Hits {self.n.shape}: {hits}>"


@takes(Lines)
def intersect(shapes: Shapes, lines: Lines) -> Hits:
    """Intersects lines o + t d, tmin <= t <= tmax, with shapes.

    origins, directions: (..., 3); tmin, tmax: (...).  They and the shapes
    broadcast as arrays of NumPy do: n lines and n shapes give n answers, and
    shapes[:, None] gives a row for each shape.  tmin=-np.inf gives whole lines.

    to: (..., 3), in place of directions: the lines are segments from origins to
    these points, 0 <= t <= 1, without the rounding of their difference.

    threads: at most so many; None: one per processor.  The answer does not
    depend on it.  progress: called with (done, total) several times a second
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
    shape = broadcast(("shapes", shapes.shape), ("lines", lines.shape))
    records = np.broadcast_to(shapes._records, shape)
    hits = Hits(records, lines, shape)
    with lines.kept(shape) as copies:
        if not _core.intersect(
            records,
            lines.broadcast_to(shape),
            (hits.relation, hits.n, hits.t, hits.part, *copies),
            workers(lines.threads),
            lines.progress,
        ):
            raise lines.refuse()
    return hits
