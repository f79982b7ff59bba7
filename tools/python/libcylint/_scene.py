"""Many lines or points, and many shapes, by a hierarchy of boxes."""

from __future__ import annotations

import os
from collections.abc import Iterable
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arguments import (
    Balls, Doubles, Lines, Points, Progress, broadcast, counted, first_of, integers,
    positive, takes, whole, workers,
)
from ._closest import ClosestPoints, ShapesWithin
from ._files import read_begun
from ._hits import DescribedHits
from ._shapes import Shapes, all_shapes, checked, encoded, joined_labels, shapes_at


def _shapes_of(answers: Any) -> tuple[Shapes, NDArray[np.int64]]:
    return shapes_at(*answers._scene)


class NearestHits(DescribedHits):
    """What `Scene.nearest` returns: the first hit of each line.

    index: (...) int64, the number of the shape; -1 for none.
    t: (...); nan for none.
    part: (...) int8, a value of `Part`; -1 for none.

    The others are computed when they are first used, from a copy of the lines and
    of index.  z, phi and side are (...); point, normal, outside and inside are
    (..., 3).
    """

    index: NDArray[np.int64]
    part: NDArray[np.int8]

    def __init__(self, scene: _core.Scene, lines: Lines, columns: Any) -> None:
        self.index, self.t, self.part = columns
        self._scene = scene, self.index.copy(), False
        super().__init__(lines, self.t.shape)

    _shapes = cached_property(_shapes_of)

    def __repr__(self) -> str:
        hits = counted(np.count_nonzero(self.index >= 0), "hit")
        return f"<libcylint.NearestHits {self.index.shape}: {hits}>"


class ClosestShapes(ClosestPoints):
    """What `Scene.closest` returns: the shape that is closest to each point.

    index: (...) int64, the number of the shape; -1 for none within the radius.
    distance: (...), from the point to its surface, negative inside; nan for
    none.  If signed distances were compared, the surface is that of the closed
    solid.

    part, feature, point and normal are as in `ClosestPoints`.
    """

    index: NDArray[np.int64]

    def __init__(self, scene: _core.Scene, around: Balls, columns: Any) -> None:
        self.index, distance = columns
        self._scene = scene, self.index.copy(), around.signed
        super().__init__(around, distance)

    _shapes = cached_property(_shapes_of)


class AllHits(NamedTuple):
    """What `Scene.all` returns: an element for each line and shape that it hits.

    line: (k,) int64, the number of the line, ascending; of lines in several
    axes the number in C order.
    index: (k,) int64, the number of the shape, ascending for each line.
    t: (k, 2), ascending; nan if there is no second hit.
    """

    line: NDArray[np.int64]
    index: NDArray[np.int64]  # type: ignore[assignment]
    t: Doubles


class Pieces(NamedTuple):
    """What `Scene.pieces` returns: an element for each piece.

    line: (k,) int64, the number of the line, ascending; of lines in several axes the
    number in C order.
    shape: (k,) int64, the number of the owner, a shape or the first of its solid.
    depth: (k,) int64, the greatest number of solids at one place of it.
    t0, t1: (k,), where it begins and ends; infinite where a solid has no end.
    """

    line: NDArray[np.int64]
    shape: NDArray[np.int64]
    depth: NDArray[np.int64]
    t0: Doubles
    t1: Doubles


class Depths(NamedTuple):
    """What `Scene.depth` returns.

    depth: (...) int64, how many solids contain the point.
    index: (...) int64, the number of the owner, a shape or the first of its solid;
    -1: none.
    """

    depth: NDArray[np.int64]
    index: NDArray[np.int64]  # type: ignore[assignment]


class Boundaries(NamedTuple):
    """What `Scene.first_boundary` returns.

    index: (...) int64, the number of the shape whose surface it is on; -1: none.
    t: (...); point, normal: (..., 3); nan for none.  The normal points out of the
    solid.
    side, part: (...) int8, values of `Side` and `Part`; -1 for none.
    """

    index: NDArray[np.int64]  # type: ignore[assignment]
    t: Doubles
    point: Doubles
    normal: Doubles
    side: NDArray[np.int8]
    part: NDArray[np.int8]


# index, number, byte, bool, vector
_TYPES = dict(zip("itb?v", map(np.dtype, ("i8", "f8", "i1", "?", "3f8")), strict=True))

# The rows of AllHits, Pieces and ShapesWithin.
_HITS, _PIECES, _NEAR = map(np.dtype, ("i8, i8, 2f8", "i8, i8, i8, f8, f8", "i8, i8, f8"))

_MODES = ("union", "owner", "cells", "chords")


def _mode(word: str) -> int:
    if word not in _MODES:
        raise ValueError(f"mode: expected {', '.join(_MODES)}, found {word!r}")
    return _MODES.index(word)


class Scene:
    """Shapes in a hierarchy of boxes, for many lines and points.

    shapes: one axis, or several arrays of shapes, also from a generator, which are
    joined as by `concatenate`.  The scene copies what it needs, about 100 bytes a
    shape, and keeps none of the arrays.  The shapes have the numbers 0 to
    len(scene) - 1, and there are at most 2**28.
    threads: for building the scene, and for queries without their own number;
    None: one per processor.
    progress: called with (done, total) while the scene is built, several times a
    second and at the end; total is the number of shapes.  A signal such as
    Ctrl-C ends the building.

    The answers are those of `intersect` and `Shapes.distance` with every shape,
    bit for bit.

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
    >>> scene.closest([[7, -9, 1], [7.125, 0, 1]]).distance
    array([ 8.75 , -0.125])
    """

    def __init__(
        self, shapes: Shapes | Iterable[Shapes], *, threads: int | None = None,
        progress: Progress | None = None,
    ) -> None:
        parts = [shapes] if isinstance(shapes, Shapes) else shapes
        begun = _core.Scene(shapes.size if isinstance(shapes, Shapes) else 0)
        labels: list[Any] = []
        for part in checked(parts):
            row = part._in_a_row()
            labels.append((len(row), row._labels))
            begun.add(row.kind)
        names = encoded(joined_labels(labels))
        if names is not None:
            begun.set_labels(names)
        self._start(begun, threads, progress)

    def _start(
        self, begun: _core.Scene, threads: int | None, progress: Progress | None
    ) -> None:
        self._threads = threads
        begun.finish(workers(threads), progress)
        self._scene = begun  # last: progress may call methods of a subclass

    @classmethod
    def read(
        cls, path: str | os.PathLike[str], *, ends: Any = None, swc: str | None = None,
        threads: int | None = None, progress: Progress | None = None,
    ) -> Scene:
        """`Scene(read_scene(path, ends=ends, swc=swc))` in about a quarter of the memory.

        With the solids that the file states by in=NAME and out=NAME.
        """
        scene = cls.__new__(cls)
        scene._start(read_begun(path, ends=ends, swc=swc), threads, progress)
        return scene

    @property
    def shapes(self) -> Shapes:
        """The shapes, in their order: a copy, of 400 bytes a shape."""
        return all_shapes(self._scene)

    @property
    def nbytes(self) -> int:
        """The bytes of memory of the scene, its shapes included."""
        return self._scene.bytes()

    def __len__(self) -> int:
        return self._scene.size()

    def __repr__(self) -> str:
        return f"<libcylint.Scene: {counted(len(self), 'shape')}>"

    def save(self, path: str | os.PathLike[str]) -> None:
        """Saves the scene with its labels in a file, for `open`.

        `cylint -s` opens it, too, and cylint_scene_open() of C.  A file of about
        100 bytes a shape is written beside `path` and renamed, so a process that
        has opened an older file keeps it; a pipe or a device is written to.  Raises
        OSError if that fails.

        >>> import os, tempfile
        >>> folder = tempfile.TemporaryDirectory()
        >>> name = os.path.join(folder.name, "rods")
        >>> rods = cylint.cylinder([0, 0, 0], [[0, 0, 1], [0, 0, 2]], 1)
        >>> cylint.Scene(rods.with_labels(["short", "long"])).save(name)
        >>> scene = cylint.Scene.open(name)
        >>> scene, scene.shapes.labels
        (<libcylint.Scene: 2 shapes>, array(['short', 'long'], dtype='<U5'))
        """
        self._scene.save(*_file_name(path))

    @classmethod
    def open(
        cls, path: str | os.PathLike[str], *, trusted: bool = False, read: bool = False,
        threads: int | None = None,
    ) -> Scene:
        """Opens a scene that `save` or `cylint --save` wrote.

        The file is mapped into memory, so nothing is built, and all processes that
        open it share its memory.  It must not be shortened or rewritten in place
        as long as the scene is used; `save` does not do that.
        read: read the file into memory of this process instead.
        trusted: check only that the file is complete.  The full check takes 0.05 s
        for 100 MB; without it a damaged file can make queries crash.
        threads: for queries without their own number; None: one per processor.

        Raises OSError if the file cannot be read, ValueError if it is no saved
        scene, damaged, or of another version or machine.
        """
        workers(threads)  # checks the number
        scene = cls.__new__(cls)
        scene._scene = _core.Scene.open(*_file_name(path), bool(read), bool(trusted))
        scene._threads = threads
        return scene

    def __getstate__(self) -> dict[str, Any]:
        return self.__dict__ | {"_scene": self._scene.to_bytes()}

    def __setstate__(self, state: dict[str, Any]) -> None:
        made = _core.Scene.open_bytes(state["_scene"])
        self.__dict__.update(state | {"_scene": made})

    def _answer(self, query: Any, given: Any, columns: Any, rule: Any = None) -> Any:
        """Calls a function of _core for lines or points.  It writes columns, arrays or
        types of _TYPES, or returns rows of one type."""
        if given.threads is None:
            given.threads = self._threads
        if isinstance(columns, str):
            columns = [np.empty(given.shape, _TYPES[kind]) for kind in columns]
        rows = columns if isinstance(columns, np.dtype) else None
        found = query(
            self._scene, given.core(len(self)), rule, columns if rows is None else [],
            workers(given.threads), given.progress,
        )
        if found is None:
            raise given.refuse()
        if rows is None:
            return columns
        table = found.view(rows)
        return [np.ascontiguousarray(table[name]) for name in table.dtype.names]

    @takes(Lines)
    def nearest(self, lines: Lines) -> NearestHits:
        """The first shape that each line hits, that of least t.

        Arguments as for `intersect`.  At equal t the lower number is first.
        exclude: (...) integers, for each line the number of a shape that it does
        not hit, -1 for none; for rays that leave this shape.  Raises IndexError for
        another number.

        >>> posts = cylint.cylinder([[0, 0, 0], [4, 0, 0]], [[0, 0, 1], [4, 0, 1]], 1)
        >>> scene = cylint.Scene(posts)
        >>> first = scene.nearest([-5, 0, 0.5], [1, 0, 0])
        >>> second = scene.nearest([-5, 0, 0.5], [1, 0, 0], exclude=first.index)
        >>> int(first.index), int(second.index), float(second.t)
        (0, 1, 8.0)
        """
        columns = self._answer(_core.Scene.nearest, lines, "itb")
        lines.keep()
        return NearestHits(self._scene, lines, columns)

    @takes(Lines)
    def any(self, lines: Lines) -> NDArray[np.bool_]:
        """Whether each line hits a shape: (...) bool.

        Arguments as for `nearest`.
        """
        return self._answer(_core.Scene.any, lines, "?")[0]

    @takes(Lines)
    def count(self, lines: Lines) -> NDArray[np.int64]:
        """How many shapes each line hits: (...) int64.

        Arguments as for `nearest`.
        """
        return self._answer(_core.Scene.count, lines, "i")[0]

    @takes(Lines)
    def all(self, lines: Lines) -> AllHits:
        """All shapes that each line hits, as flat arrays.

        Arguments as for `nearest`.

        >>> scene = cylint.Scene(cylint.cylinder([[0, 0, 0], [4, 0, 0]], [[0, 0, 1], [4, 0, 1]], 1))
        >>> scene.all([[-5, 0, 0.5], [0, -5, 0.5]], [[1, 0, 0], [0, 1, 0]])
        AllHits(line=array([0, 0, 1]), index=array([0, 1, 0]), t=array([[ 4.,  6.],
               [ 8., 10.],
               [ 4.,  6.]]))
        """
        return AllHits(*self._answer(_core.Scene.all, lines, _HITS))

    def _integers(
        self, name: str, values: ArrayLike | None
    ) -> NDArray[np.int32] | None:
        """One 32-bit integer for each shape."""
        if values is None:
            return None
        array = integers(name, values)
        if array.shape != (len(self),):
            raise ValueError(
                f"{name}: expected an integer for each of the {len(self)} shapes, "
                f"found an array of the shape {array.shape}"
            )
        small = array.astype(np.int32)
        wrong = small != array
        if wrong.any():
            raise ValueError(f"{first_of(name, array, wrong)}, beyond 32 bits")
        return small

    def set_solids(self, shape: ArrayLike, solid: ArrayLike, clause: ArrayLike) -> None:
        """Sets solids made of shapes, in place of those before.

        shape, solid, clause: integers that broadcast to one axis.  Shape number
        `shape` is a member of a clause of solid number `solid`; if the clause is
        negative, the complement of the shape is the member.  A point is in a solid
        if each clause has a member that contains the point.  A shape in no solid is
        itself a solid.
        `solid` only distinguishes solids: 0 to the number of rows - 1.  The number
        of a solid in answers is the least of its shapes that are not complements;
        if there is none, the least of its shapes.

        `pieces`, `sums`, `depth` and `first_boundary` are about solids, all others
        about shapes.  Raises ValueError during a query of another thread.

        >>> pipe = cylint.cylinder([0, 0, 0], [0, 0, 9], [2, 1])
        >>> scene = cylint.Scene(pipe)
        >>> scene.set_solids([0, 1], 0, [1, -2])
        >>> scene.pieces([-5, 0, 3], [1, 0, 0])[3:]
        (array([3., 6.]), array([4., 7.]))
        """
        names = ("shape", "solid", "clause")
        given = [*map(integers, names, (shape, solid, clause))]
        size = broadcast("shape solid clause", *given)
        if len(size) > 1:
            raise ValueError(f"shape, solid, clause: expected one axis, found the shape {size}")
        rows = np.column_stack([np.broadcast_to(x, size).reshape(-1) for x in given])
        least, most = [0, 0, 1 - 2**31], [len(self) - 1, len(rows) - 1, 2**31 - 1]
        bad = (rows < least) | (rows > most)
        bad[:, 2] |= rows[:, 2] == 0
        for column, name in enumerate(names):
            if bad[:, column].any():
                row = int(np.argmax(bad[:, column]))
                wanted = f"{least[column]} to {most[column]}" + ", not 0" * (column == 2)
                raise ValueError(
                    f"{name}[{row}]: expected {wanted}, found {rows[row, column]}"
                )
        self._scene.set_solids(rows)

    @property
    def solids(self) -> NDArray[np.int64]:
        """The members of solids: (k, 3), each a shape, a solid and a clause."""
        return np.array(self._scene.solids(), np.int64).reshape(-1, 3)

    def pieces(
        self, origins: ArrayLike, directions: ArrayLike | None = None,
        tmin: ArrayLike = 0.0, tmax: ArrayLike = np.inf, *, to: ArrayLike | None = None,
        mode: str = "owner", rank: ArrayLike | None = None, first: int | None = None,
        errors: str = "raise", threads: int | None = None,
        progress: Progress | None = None,
    ) -> Pieces:
        """The pieces of each line that are inside solids, in order.

        Lines as for `intersect`.
        mode: "owner": each place belongs to the solid of least rank, of equal ranks
        to the lowest number; "union": maximal intervals inside any solid; "cells":
        divided wherever a solid begins or ends; "chords": of each solid, not merged.
        rank: (len(scene),) integers.  first: at most this many pieces of each line,
        the first ones.

        >>> balls = cylint.sphere([[0, 0, 0], [1, 0, 0], [9, 0, 0]], 1)
        >>> cylint.Scene(balls).pieces([-5, 0, 0], [1, 0, 0], mode="union")
        Pieces(line=array([0, 0]), shape=array([0, 2]), depth=array([2, 1]), t0=array([ 4., 13.]), t1=array([ 7., 15.]))
        """
        most = 0 if first is None else positive("first", first)
        lines = Lines(
            origins, directions, tmin, tmax,
            to=to, errors=errors, threads=threads, progress=progress,
        )
        rule = _core.Scene.Rule(
            _mode(mode), self._integers("rank", rank), None, most, False
        )
        return Pieces(*self._answer(_core.Scene.pieces, lines, _PIECES, rule))

    def sums(
        self, origins: ArrayLike, directions: ArrayLike | None = None,
        tmin: ArrayLike = 0.0, tmax: ArrayLike = np.inf, *, to: ArrayLike | None = None,
        labels: ArrayLike | None = None, columns: int | None = None,
        mode: str = "owner", rank: ArrayLike | None = None, units: str = "length",
        errors: str = "raise", threads: int | None = None,
        progress: Progress | None = None,
    ) -> NDArray[np.float64]:
        """The lengths of each line inside solids, added by label.

        Arguments as for `pieces`.
        labels: (len(scene),) integers; None: 0 for all shapes.  Shapes with a label
        below 0, or of `columns` or more, are not counted.
        np.unique(names, return_inverse=True)[1] makes labels of names.
        columns: the number of labels; None: 1 more than the greatest label.
        units: "length": in the unit of the scene; "t": in multiples of directions.
        The answer is (..., columns), 8 bytes for each line and label; without
        labels and columns (...).

        Each sum is rounded once, and once more for "length"; inf if a piece is
        infinite.

        >>> balls = cylint.sphere([[0, 0, 0], [1, 0, 0], [9, 0, 0]], 1)
        >>> scene = cylint.Scene(balls)
        >>> scene.sums([-5, 0, 0], [2, 0, 0])
        array(5.)
        >>> scene.sums([-5, 0, 0], [2, 0, 0], labels=[0, 0, 1], units="t")
        array([1.5, 1. ])
        """
        if units not in ("length", "t"):
            raise ValueError(f"units: expected length or t, found {units!r}")
        lines = Lines(
            origins, directions, tmin, tmax,
            to=to, errors=errors, threads=threads, progress=progress,
        )
        label = self._integers("labels", labels)
        width = 1
        if label is not None:
            width = int(label.max(initial=-1)) + 1
        if columns is not None:
            width = whole("columns", columns, 0)
        sums = np.empty((*lines.shape, width))
        rule = _core.Scene.Rule(
            _mode(mode), self._integers("rank", rank), label, width, units == "length"
        )
        self._answer(_core.Scene.sums, lines, [sums], rule)
        return sums[..., 0] if labels is None and columns is None else sums

    def depth(
        self, points: ArrayLike, *, rank: ArrayLike | None = None,
        threads: int | None = None, progress: Progress | None = None,
    ) -> Depths:
        """How many solids contain each point, and which one owns it.

        points: (..., 3).  Boundaries belong to solids; complements are without
        theirs.  The owner has the least rank, of equal ranks the lowest number; -1:
        there is none.

        >>> balls = cylint.sphere([[0, 0, 0], [1, 0, 0]], 1)
        >>> cylint.Scene(balls).depth([[0.5, 0, 0], [1.5, 0, 0], [3, 0, 0]])
        Depths(depth=array([2, 1, 0]), index=array([ 0,  1, -1]))
        """
        given = Points(points, threads=threads, progress=progress)
        rule = _core.Scene.Rule(0, self._integers("rank", rank), None, 0, False)
        return Depths(*self._answer(_core.Scene.depth, given, "ii", rule))

    def first_boundary(
        self, origins: ArrayLike, directions: ArrayLike | None = None,
        tmin: ArrayLike = 0.0, tmax: ArrayLike = np.inf, *, to: ArrayLike | None = None,
        errors: str = "raise", threads: int | None = None,
        progress: Progress | None = None,
    ) -> Boundaries:
        """Where each line first enters or leaves the union of all solids.

        Arguments as for `intersect`.  Places at tmin and tmax do not count.

        >>> pipe = cylint.Scene(cylint.cylinder([0, 0, 0], [0, 0, 9], [2, 1]))
        >>> pipe.set_solids([0, 1], 0, [1, -2])
        >>> wall = pipe.first_boundary([[-5, 0, 3], [0, 0, 3]], [1, 0, 0])
        >>> wall.index, wall.t, wall.normal[1]
        (array([0, 1]), array([3., 1.]), array([-1.,  0.,  0.]))
        """
        lines = Lines(
            origins, directions, tmin, tmax,
            to=to, errors=errors, threads=threads, progress=progress,
        )
        return Boundaries(*self._answer(_core.Scene.first_boundary, lines, "itvvbb"))

    @takes(Balls)
    def closest(self, around: Balls) -> ClosestShapes:
        """The shape whose surface is closest to each point.

        points: (..., 3); r: (...), the greatest distance.  They broadcast.
        The absolute values of `Shapes.distance` are compared, so a point inside
        a shape is as far from it as from its surface.  Where shapes overlap, the
        closest surface can lie inside their union.  Of equal distances the lower
        number is first.  There is no shape within a radius that is
        negative or nan, and none for a point with a coordinate that is infinite
        or nan.

        signed: the least signed distance from the closed solids (both caps are
        there, whatever the ends).  Inside one it is minus the depth in the deepest
        solid, a lower bound of the depth in their union; outside it is the
        distance from the union.  A negative radius is a depth.

        >>> posts = cylint.cylinder([[0, 0, 0], [4, 0, 0]], [[0, 0, 1], [4, 0, 1]], 1)
        >>> near = cylint.Scene(posts).closest([[2.5, 0, 0.5], [3.5, 0, 0.5], [9, 0, 0.5]], r=3)
        >>> near.index, near.distance
        (array([ 1,  1, -1]), array([ 0.5, -0.5,  nan]))
        >>> near.point[0], near.normal[0]
        (array([3. , 0. , 0.5]), array([-1.,  0.,  0.]))
        >>> chain = cylint.Scene(cylint.capsule([[0, 0, 0], [2, 0, 0]], [[2, 0, 0], [4, 0, 0]], 1))
        >>> chain.closest([2.25, 0, 0.75]).distance
        array(-0.20943058)
        >>> chain.closest([2.25, 0, 0.75], signed=True).distance
        array(-0.25)
        """
        columns = self._answer(_core.Scene.closest, around, "it")
        around.keep()
        return ClosestShapes(self._scene, around, columns)

    @takes(Balls)
    def within(self, around: Balls) -> ShapesWithin:
        """All shapes near each point, as flat arrays.

        Near are those whose surface is at most r from the point.
        points: (..., 3); r: (...), the radius, inf for all shapes that have a
        surface.  They broadcast.  Distances are compared as by `closest`; signed:
        those whose signed distance is at most r.

        >>> posts = cylint.cylinder([[0, 0, 0], [4, 0, 0]], [[0, 0, 1], [4, 0, 1]], 1)
        >>> cylint.Scene(posts).within([[2.5, 0, 0.5], [3.5, 0, 0.5]], 1.5)
        ShapesWithin(point=array([0, 0, 1]), index=array([0, 1, 1]), distance=array([ 1.5,  0.5, -0.5]))
        """
        return ShapesWithin(*self._answer(_core.Scene.within, around, _NEAR))

    @takes(Balls)
    def within_count(self, around: Balls) -> NDArray[np.int64]:
        """How many surfaces are within a radius of each point: (...) int64.

        Arguments as for `within`.
        """
        return self._answer(_core.Scene.within_count, around, "i")[0]

    @takes(Points)
    def contains(self, points: Points) -> NDArray[np.int64]:
        """How many closed solids hold each point: (...) int64.

        points: (..., 3).  The boundary belongs to the solid, and both caps are
        there, whatever the ends.  Exact.

        >>> posts = cylint.cylinder([[0, 0, 0], [4, 0, 0]], [[0, 0, 1], [4, 0, 1]], 2)
        >>> cylint.Scene(posts).contains([[2, 0, 0.5], [5, 0, 1], [9, 0, 0]])
        array([2, 1, 0])
        """
        return self._answer(_core.Scene.contains, points, "i")[0]


def _file_name(path: str | os.PathLike[str]) -> tuple[bytes, str]:
    """For the system, and for messages."""
    name = os.fsencode(path)
    if b"\0" in name:
        raise ValueError("embedded null byte")
    return name, os.fspath(path)
