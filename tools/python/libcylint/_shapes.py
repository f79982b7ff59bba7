"""Arrays of shapes and their constructors."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arguments import Points, takes
from ._arrays import Progress, broadcast, counted, doubles, place, workers
from ._closest import ClosestPoints, closest_points
from ._enums import Ends, Kind

_members = _core.shape_members()
_record = np.dtype((np.void, _members["size"]))
_readable = np.dtype(
    {
        "names": ["kind", "ends"],
        "formats": [np.intc, np.intc],
        "offsets": [_members["kind"], _members["ends"]],
        "itemsize": _members["size"],
    }
)


def _widths(arguments: str) -> dict[str, int]:
    """The arguments of a constructor and their widths, from "p0:3 p1:3 r:1"."""
    pairs = (item.split(":") for item in arguments.split())
    return {name: int(width) for name, width in pairs}


def _places(widths: dict[str, int]) -> dict[str, tuple[int, int]]:
    """Where the members of shapes are in a row of numbers: from, to."""
    ends = np.cumsum(list(widths.values())).tolist()
    places = {
        name: (end - width, end)
        for (name, width), end in zip(widths.items(), ends, strict=True)
    }
    if "p0" in places and "r" in places:
        places |= {"r0": places["r"], "r1": places["r"]}
    return places


_constructors = {name: _widths(text) for name, text in _core.constructors()}
_places_of = {name: _places(each) for name, each in _constructors.items()}
_TUBE_MEMBERS = 4
_MOST_NUMBERS = max(sum(each.values()) for each in _constructors.values())


class _Argument:
    """A member of shapes that is an argument of their constructors."""

    def __init__(self, text: str) -> None:
        self.__doc__ = text

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    @overload
    def __get__(self, shapes: None, owner: type) -> _Argument: ...
    @overload
    def __get__(self, shapes: Shapes, owner: type) -> NDArray[np.float64]: ...
    def __get__(self, shapes: Shapes | None, owner: type) -> Any:
        if shapes is None:
            return self
        return shapes._member(self._name, *shapes._read())

    def __set__(self, shapes: Shapes, value: object) -> None:
        raise AttributeError("shapes cannot be changed")


class Shapes:
    """An array of shapes, made by a constructor such as `cylinder`.

    It has a shape, a number of axes and a length, and is indexed, like an array
    of NumPy.  Its elements cannot be changed.  It can be pickled.

    The arguments of the constructors are members: p0, p1, r, r0, r1, c, a, b, h,
    k, v, u, tangent.  They have the shapes of the arguments, (..., 3) or (...),
    and are nan where a shape has no such argument.  A round cone that is a ball
    has p0, r0, p1 and r1, too.

    `==` compares shapes one by one, as arrays of NumPy: two are equal if they
    were made by the same constructor with equal numbers and ends.  Labels do not
    count.

    >>> rods = cylint.cylinder([0, 0, 0], [[0, 0, 1], [0, 0, 2], [0, 0, 3]], 0.5)
    >>> rods
    <libcylint.Shapes (3,): 3 cylinders>
    >>> len(rods[1:]), rods[:, None].shape
    (2, (3, 1))
    >>> rods.p1[:, 2], rods.c[0]
    (array([1., 2., 3.]), array([nan, nan, nan]))
    >>> rods == cylint.cylinder(rods.p0, rods.p1, rods.r)
    array([ True,  True,  True])
    """

    __slots__ = ("__weakref__", "_labels", "_records")
    _records: NDArray[np.void]
    _labels: NDArray[np.object_] | None  # of str, with the axes of records

    __array_ufunc__ = None  # NumPy leaves operators such as == to this class
    __hash__ = None  # type: ignore[assignment]

    def __init__(
        self,
        records: NDArray[np.void],
        labels: NDArray[np.object_] | None = None,
    ) -> None:
        if records.dtype != _record:
            raise TypeError("shapes are made by their constructors")
        self._records = records.view()
        self._records.flags.writeable = False
        self._labels = labels

    @property
    def shape(self) -> tuple[int, ...]:
        return self._records.shape

    @property
    def ndim(self) -> int:
        return self._records.ndim

    @property
    def size(self) -> int:
        return self._records.size

    def __len__(self) -> int:
        return len(self._records)

    def __getitem__(self, index: Any) -> Shapes:
        return Shapes(
            np.asarray(self._records[index], _record),
            None
            if self._labels is None
            else np.asarray(self._labels[index], np.object_),
        )

    def __iter__(self) -> Iterator[Shapes]:
        return (self[i] for i in range(len(self)))

    def reshape(self, *shape: Any) -> Shapes:
        """The same shapes in another array shape."""
        records = self._records.reshape(*shape)
        labels = self._labels
        return Shapes(
            records, None if labels is None else labels.reshape(records.shape)
        )

    def _in_a_row(self) -> Shapes:
        """Shapes with one axis, contiguous; a single shape counts as one."""
        if self.ndim > 1:
            raise ValueError(
                f"shapes: expected one axis, found the shape {self.shape}"
            )
        row = self.reshape(self.size)
        return Shapes(np.ascontiguousarray(row._records), row._labels)

    def __array__(self, *args: object, **named: object) -> NDArray[Any]:
        raise TypeError(
            "shapes are no array of numbers: libcylint.concatenate() joins "
            "shapes, and p0, r0, ... or to_dict() have their numbers"
        )

    def __eq__(self, other: object) -> Any:
        if not isinstance(other, Shapes):
            return NotImplemented
        broadcast(("shapes", self.shape), ("other", other.shape))
        (kinds, numbers), (others, their_numbers) = self._read(), other._read()
        return (
            (kinds == others)
            & (self.ends == other.ends)
            & (numbers == their_numbers).all(axis=-1)
        )

    def __ne__(self, other: object) -> Any:
        equal = self.__eq__(other)
        return equal if equal is NotImplemented else ~equal

    def _read(self) -> tuple[NDArray[np.int8], NDArray[np.float64]]:
        """For each shape the number of its constructor, and its arguments."""
        kinds = np.empty(self.size, np.int8)
        numbers = np.zeros((self.size, _MOST_NUMBERS))
        _core.read_shapes(self._records.reshape(-1), kinds, numbers)
        return kinds.reshape(self.shape), numbers.reshape(
            *self.shape, _MOST_NUMBERS
        )

    def _member(
        self, name: str, kinds: NDArray[np.int8], numbers: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """A member, from the answer of `_read`."""
        width = next(a[name] for a in _constructors.values() if name in a)
        values = np.full((*self.shape, width), np.nan)
        for row, places in enumerate(_places_of.values()):
            if name in places:
                begin, end = places[name]
                found = kinds == row
                values[found] = numbers[found, begin:end]
        return values if width > 1 else values[..., 0]

    p0 = _Argument(
        """(..., 3): where the axis begins, of cylinders, cones, capsules and
        round cones."""
    )
    p1 = _Argument("(..., 3): where the axis ends, of the same.")
    r0 = _Argument("(...): the radius at p0; r of a cylinder or capsule.")
    r1 = _Argument("(...): the radius at p1; r of a cylinder or capsule.")
    r = _Argument("(...): the radius, of cylinders, capsules and spheres.")
    c = _Argument(
        "(..., 3): the centre, of spheres; that of the base, of elliptic kinds."
    )
    a = _Argument("(..., 3): a semi-axis of the base, of elliptic kinds.")
    b = _Argument("(..., 3): the other semi-axis, of elliptic kinds.")
    h = _Argument("(..., 3): from the base to the top, of elliptic kinds.")
    k = _Argument("(...): what the top is scaled by, of elliptic cones.")
    p = _Argument("(..., 3): a point of the plane, of half-spaces.")
    n = _Argument("(..., 3): the outward normal as given, of half-spaces.")
    v = _Argument("(..., 3): the apex, of cones with an angle.")
    u = _Argument("(..., 3): the axis, of cones with an angle.")
    tangent = _Argument(
        "(...): the tangent of the half angle, of cones with an angle."
    )

    def to_dict(self) -> dict[str, NDArray[Any]]:
        """Arrays with the members that some of the shapes have, by name.

        kind: (...) str, the constructor; that of a cone with an angle is
        tangent_cone.  ends: (...) str.  Then p0 and the others, as the members
        of these names.  labels: (...) str, if some shape has a label.

        >>> pair = [cylint.sphere([0, 0, 0], 2), cylint.capsule([0, 0, 1], [0, 0, 3], 1)]
        >>> table = cylint.concatenate(pair).to_dict()
        >>> list(table)
        ['kind', 'ends', 'c', 'r', 'p0', 'p1', 'r0', 'r1']
        >>> table["kind"], table["r"], table["r1"]
        (array(['sphere', 'capsule'], dtype='<U17'), array([2., 1.]), array([nan,  1.]))
        """
        kinds, numbers = self._read()
        names = list(_constructors)
        words = [e.name.lower() for e in Ends]
        table: dict[str, NDArray[Any]] = {
            "kind": np.asarray(np.array(names)[kinds]),
            "ends": np.asarray(np.array(words)[self.ends]),
        }
        for kind in np.unique(kinds):
            for name in _places_of[names[kind]]:
                if name not in table:
                    table[name] = self._member(name, kinds, numbers)
        if self._labels is not None:
            table["labels"] = self.labels
        return table

    @property
    def labels(self) -> NDArray[np.str_]:
        """(...) str, the names that `read_scene` found; "" for none."""
        if self._labels is None:
            return np.full(self.shape, "")
        return self._labels.astype(np.str_)

    def with_labels(self, labels: ArrayLike) -> Shapes:
        """The same shapes with other labels.

        labels: (...) str, broadcast to the shapes.

        >>> rods = cylint.cylinder([0, 0, 0], [0, 0, 1], [1, 2])
        >>> rods.with_labels(["thin", "thick"])[1:].labels
        array(['thick'], dtype='<U5')
        """
        names = np.asarray(labels, np.object_)
        for name in names.flat:
            if not isinstance(name, str):
                raise TypeError(f"labels: expected str, found {name!r}")
        return Shapes(self._records, np.broadcast_to(names, self.shape))

    @property
    def kind(self) -> NDArray[np.int32]:
        """The kind of each shape, a value of `Kind`."""
        return self._records.view(_readable)["kind"]

    @property
    def ends(self) -> NDArray[np.int32]:
        """The ends of each shape, a value of `Ends`."""
        return self._records.view(_readable)["ends"]

    def bounds(self) -> NDArray[np.float64]:
        """The least boxes that hold the solids, (..., 2, 3): low, high corner.

        Each side is rounded outward.  Unbounded sides are infinite.

        >>> cylint.cylinder([0, 0, 0], [0, 0, 2], 1).bounds()
        array([[-1., -1.,  0.],
               [ 1.,  1.,  2.]])
        """
        boxes = np.empty((self.size, 2, 3))
        _core.bounds(self._records.reshape(-1), boxes)
        return boxes.reshape(*self.shape, 2, 3)

    def _ask(self, points: Points, query: Any, answer: Any) -> NDArray[Any]:
        """Calls a function of _core for shapes and points, broadcast."""
        shape = broadcast(("shapes", self.shape), ("points", points.shape))
        answers = np.empty(shape, answer)
        query(
            np.broadcast_to(self._records, shape),
            points.broadcast_to(shape),
            answers,
            workers(points.threads),
            points.progress,
        )
        return answers

    @takes(Points)
    def contains(self, points: Points) -> NDArray[np.int8]:
        """Where points lie: 1 inside, 0 on the boundary, -1 outside.  Exact.

        points: (..., 3), broadcast against the shapes.

        >>> cylint.cylinder([0, 0, 0], [0, 0, 2], 1).contains(
        ...     [[0, 0, 1], [1, 0, 1], [0, 0, 3]])
        array([ 1,  0, -1], dtype=int8)
        """
        return self._ask(points, _core.contains, np.int8)

    @takes(Points)
    def distance(self, points: Points) -> NDArray[np.float64]:
        """How far points are from the surfaces: (...), in the unit of lengths.

        points: (..., 3), broadcast against the shapes: n points and n shapes
        give n distances, and shapes[:, None] gives a row for each shape.

        The surface has the parts that `ends` leaves.  Of capped, infinite and
        nappe it is the whole boundary, and the distance is negative inside: its
        sign is that of -contains(points).  Of open, cap0 and cap1 it is never
        negative.  It is 0 exactly on the surface, and else the float64 nearest
        to the real distance; of elliptic kinds nearly always, else within 1 unit
        in the last place: cylint_distance(3) states the limits.

        inf if a coordinate of the point is infinite or nan, or if there is no
        surface: that of a round cone that is the ball about one end, if `ends`
        leaves out this end.

        >>> tube = cylint.cylinder([0, 0, 0], [0, 0, 2], 1)
        >>> tube.distance([[4, 0, -4], [0.5, 0, 1], [1, 0, 1], [np.nan, 0, 0]])
        array([ 5. , -0.5,  0. ,  inf])
        """
        return closest_points(self._records, points).distance

    @takes(Points)
    def closest(self, points: Points) -> ClosestPoints:
        """The points of the surfaces that are closest to given points.

        Arguments and `distance` are those of `distance`.

        >>> near = cylint.cylinder([0, 0, 0], [0, 0, 2], 1).closest([4, 0, -4])
        >>> near.distance, near.point, near.normal
        (array(5.), array([1., 0., 0.]), array([1., 0., 0.]))
        >>> cylint.Feature(near.feature), cylint.Part(near.part)
        (<Feature.RIM0: 3>, <Part.LATERAL: 0>)
        """
        points.keep()
        return closest_points(self._records, points)

    @takes(Points)
    def safety(self, points: Points) -> NDArray[np.float64]:
        """How far points may move without crossing the surfaces: (...).

        A number from 0 to abs(distance(points)), never above it, that takes
        less time to compute.  inf where `distance` is.

        >>> ball = cylint.sphere([0, 0, 0], 1)
        >>> step = ball.safety([0, 3, 4])
        >>> bool(3.999 < step <= 4)
        True
        """
        return self._ask(points, _core.safety, np.float64)

    def on_surface(
        self,
        points: ArrayLike,
        ulps: ArrayLike = 0.0,
        *,
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> NDArray[np.bool_]:
        """Whether points are on the surfaces: (...) bool.

        points: (..., 3); ulps: (...).  They and the shapes broadcast.  True if
        abs(distance(points)) is at most `ulps` units in the last place of the
        largest coordinate of the point.  ulps = 0: exactly on the surface.

        >>> ball = cylint.sphere([0, 0, 0], 1)
        >>> points = [[1, 0, 0], [0.6, 0.8, 0]]
        >>> ball.on_surface(points), ball.on_surface(points, 1)
        (array([ True, False]), array([ True,  True]))
        """
        asked = Points(points, threads=threads, progress=progress)
        most = doubles("ulps", ulps)
        shape = broadcast(
            ("shapes", self.shape),
            ("points", asked.shape),
            ("ulps", most.shape),
        )
        answers = np.empty(shape, np.bool_)
        _core.on_surface(
            np.broadcast_to(self._records, shape),
            asked.broadcast_to(shape),
            np.broadcast_to(most, shape),
            answers,
            workers(threads),
            progress,
        )
        return answers

    def __reduce__(self) -> tuple[Any, ...]:
        kinds, numbers = self.reshape(self.size)._read()
        names = list(_constructors)
        used = {names[k]: kinds == k for k in np.unique(kinds)}
        parts = {
            name: numbers[rows, : sum(_constructors[name].values())]
            for name, rows in used.items()
        }
        ends = self.ends.astype(np.int8)
        return _restore, (self.shape, used, parts, ends, self._labels)

    def __repr__(self) -> str:
        counts = ", ".join(
            counted(count, kind.name.lower())
            for kind in Kind
            if (count := np.count_nonzero(self.kind == kind)) > 0
        )
        return f"<libcylint.Shapes {self.shape}: {counts or 'none'}>"


def _restore(
    shape: tuple[int, ...],
    used: dict[str, NDArray[np.bool_]],
    parts: dict[str, NDArray[np.float64]],
    ends: NDArray[np.int8],
    labels: NDArray[np.object_] | None,
) -> Shapes:
    """The shapes of a pickle."""
    records = np.zeros(ends.size, _record)
    for name, rows in used.items():
        records[rows] = _build(name, parts[name], ends.reshape(-1)[rows])
    return Shapes(records.reshape(shape), labels)


def _codes(ends: str | int | ArrayLike) -> NDArray[np.int8]:
    """The ends as numbers, from words or numbers."""
    words = np.asarray(ends)
    if words.dtype.kind not in "US":
        return words.astype(np.int8)
    codes = np.empty(words.shape, np.int8)
    for word in np.unique(words):
        if str(word).upper() not in Ends.__members__:
            known = ", ".join(e.name.lower() for e in Ends)
            raise ValueError(f"ends: expected one of {known}; found '{word}'")
        codes[words == word] = Ends[str(word).upper()]
    return codes


def _build(
    name: str, numbers: NDArray[np.float64], ends: NDArray[np.int8]
) -> NDArray[np.void]:
    """Shapes of one constructor, from numbers (n, k) and ends (n)."""
    records = np.empty(len(numbers), _record)
    statuses = np.empty(len(numbers), np.int8)
    if _core.make_shapes(name, numbers, ends, records, statuses) > 0:
        raise _Refused(int(np.flatnonzero(statuses)[0]), statuses)
    return records


class _Refused(Exception):
    def __init__(self, row: int, statuses: NDArray[np.int8]) -> None:
        self.row = row
        self.reason = _core.strerror(int(statuses[row]))


def _make(name: str, ends: Any, **arguments: ArrayLike) -> Shapes:
    """Broadcasts the arguments of a constructor and calls it."""
    widths = list(_constructors[name].values())
    codes = _codes(ends)
    arrays = [
        doubles(key, value, width)
        for (key, value), width in zip(arguments.items(), widths, strict=True)
    ]
    cut = [
        a.shape[:-1] if w > 1 else a.shape
        for a, w in zip(arrays, widths, strict=True)
    ]
    shape = broadcast(*zip(arguments, cut, strict=True), ("ends", codes.shape))
    numbers = np.empty((*shape, sum(widths)))
    at = 0
    for array, width in zip(arrays, widths, strict=True):
        numbers[..., at : at + width] = array if width > 1 else array[..., None]
        at += width
    size = int(np.prod(shape, dtype=np.intp))
    rows = np.ascontiguousarray(np.broadcast_to(codes, shape)).reshape(size)
    try:
        records = _build(name, numbers.reshape(size, sum(widths)), rows)
    except _Refused as refused:
        raise ValueError(
            f"{name}{place(refused.row, shape)}: {refused.reason}"
        ) from None
    return Shapes(records.reshape(shape))


def cylinder(
    p0: ArrayLike, p1: ArrayLike, r: ArrayLike, *, ends: Any = "capped"
) -> Shapes:
    """Circular cylinders: the points at most r from the axis p0 p1.

    p0, p1: (..., 3), the axis; r: (...), the radius.  They broadcast.
    ends: a word or an array of words: "capped" (both caps), "open" (none),
    "cap0" (at p0 only), "cap1", "infinite", "nappe".

    >>> cylint.cylinder([0, 0, 0], [0, 0, 1], [0.5, 1, 2], ends="open")
    <libcylint.Shapes (3,): 3 cylinders>
    """
    return _make("cylinder", ends, p0=p0, p1=p1, r=r)


def cone(
    p0: ArrayLike,
    r0: ArrayLike,
    p1: ArrayLike,
    r1: ArrayLike,
    *,
    ends: Any = "capped",
) -> Shapes:
    """Frusta: radius r0 (...) at p0 (..., 3) and r1 at p1.

    If a radius is 0, the cone has its apex there.  With ends="infinite" it is a
    double cone, with "nappe" the nappe that holds the base.

    >>> cylint.cone([0, 0, 0], 1, [0, 0, 3], 0).bounds()
    array([[-1., -1.,  0.],
           [ 1.,  1.,  3.]])
    """
    return _make("cone", ends, p0=p0, r0=r0, p1=p1, r1=r1)


def elliptic_cylinder(
    c: ArrayLike,
    a: ArrayLike,
    b: ArrayLike,
    h: ArrayLike,
    *,
    ends: Any = "capped",
) -> Shapes:
    """Elliptic cylinders: c + x a + y b + z h with x^2 + y^2 <= 1.

    c, a, b, h: (..., 3).  a, b, h must be linearly independent; they need not
    be perpendicular.

    >>> flat = cylint.elliptic_cylinder([0, 0, 0], [2, 0, 0], [0, 1, 0], [0, 0, 1])
    >>> cylint.intersect(flat, [-5, 0, 0.5], [1, 0, 0]).t
    array([3., 7.])
    """
    return _make("elliptic_cylinder", ends, c=c, a=a, b=b, h=h)


def elliptic_cone(
    c: ArrayLike,
    a: ArrayLike,
    b: ArrayLike,
    h: ArrayLike,
    k: ArrayLike,
    *,
    ends: Any = "capped",
) -> Shapes:
    """Elliptic cones: c + x a + y b + z h with x^2 + y^2 <= (1 + (k-1) z)^2.

    c, a, b, h: (..., 3); k: (...) scales the top, 0 gives an apex at c + h.

    >>> cylint.elliptic_cone([0, 0, 0], [2, 0, 0], [0, 1, 0], [0, 0, 1], 0.5)
    <libcylint.Shapes (): 1 econe>
    """
    return _make("elliptic_cone", ends, c=c, a=a, b=b, h=h, k=k)


def sphere(c: ArrayLike, r: ArrayLike, *, ends: Any = "capped") -> Shapes:
    """Balls: the points at most r (...) from c (..., 3).

    >>> cylint.intersect(cylint.sphere([0, 0, 0], 1), [-3, 0, 0], [1, 0, 0]).t
    array([2., 4.])
    """
    return _make("sphere", ends, c=c, r=r)


def halfspace(p: ArrayLike, n: ArrayLike) -> Shapes:
    """Half-spaces: the points x with (x - p).n <= 0.

    p, n: (..., 3); n points out and need not have length 1.  They are unbounded; a
    line hits the plane at most once.  With other shapes they make sectors and cuts,
    see `Scene.set_solids`.

    >>> cylint.intersect(cylint.halfspace([5, 0, 0], [-2, 0, 0]), [0, 0, 0], [1, 0, 0]).t
    array([ 5., nan])
    """
    return _make("halfspace", "capped", p=p, n=n)


def tube(
    p0: ArrayLike,
    p1: ArrayLike,
    outer: ArrayLike,
    inner: ArrayLike = 0,
    *,
    sector: ArrayLike | None = None,
) -> tuple[Shapes, NDArray[np.intc]]:
    """The shapes and clauses of a hollow cylinder or cone, or of a sector of one.

    p0, p1: (3,), the axis.  outer, inner: the radii at p0 and p1, (2,), or one for
    both; inner radii of 0: no bore.
    sector: (2, 3), two directions from the axis: the solid is the part from the first
    to the second, right-handed about the axis from p0 to p1.  None: a full turn.

    The shapes are 1 to 4: the outer one, the bore and the half-spaces of the sector.
    The clauses are those of `Scene.set_solids`.  The planes are exact if the axis lies
    along a coordinate; others are rounded once, as cylint_pieces(3) says.

    >>> shapes, clauses = cylint.tube([0, 0, 0], [0, 0, 9], 2, 1, sector=[[1, 0, 0], [0, 1, 0]])
    >>> shapes, clauses
    (<libcylint.Shapes (4,): 2 cylinders, 2 halfspaces>, array([ 1, -2,  3,  4], dtype=int32))
    >>> scene = cylint.Scene(shapes)
    >>> scene.set_solids(range(4), 0, clauses)
    >>> scene.pieces([-5, 0, 3], [1, 0, 0])[3:]
    (array([6.]), array([7.]))
    """
    radii = [
        np.broadcast_to(doubles(name, value, 1), 2)
        for name, value in (("outer", outer), ("inner", inner))
    ]
    points = [doubles(n, value, 3) for n, value in (("p0", p0), ("p1", p1))]
    sides = doubles("sector", np.zeros((2, 3)) if sector is None else sector, 3)
    for name, value, expected in (
        ("p0", points[0], (3,)),
        ("p1", points[1], (3,)),
        ("sector", sides, (2, 3)),
    ):
        if value.shape != expected:
            raise ValueError(
                f"{name}: expected the shape {expected}, found {value.shape}"
            )
    numbers = np.concatenate([*points, *radii, sides.reshape(-1)])
    records = np.empty(_TUBE_MEMBERS, _record)
    clauses = np.empty(_TUBE_MEMBERS, np.intc)
    status, n = _core.make_tube(numbers, sector is not None, records, clauses)
    if status:
        raise ValueError(f"tube: {_core.strerror(status)}")
    return Shapes(records[:n]), clauses[:n]


def capsule(
    p0: ArrayLike, p1: ArrayLike, r: ArrayLike, *, ends: Any = "capped"
) -> Shapes:
    """Capsules: the points at most r (...) from the segment p0 p1 (..., 3).

    The round ends are the parts CAP0, about p0, and CAP1.  ends: as of
    `cylinder`, but neither "infinite" nor "nappe".

    >>> cylint.capsule([0, 0, 0], [0, 0, 2], 0.5).bounds()
    array([[-0.5, -0.5, -0.5],
           [ 0.5,  0.5,  2.5]])
    """
    return _make("capsule", ends, p0=p0, p1=p1, r=r)


def round_cone(
    p0: ArrayLike,
    r0: ArrayLike,
    p1: ArrayLike,
    r1: ArrayLike,
    *,
    ends: Any = "capped",
) -> Shapes:
    """Round cones: the convex hulls of two balls.

    p0, p1: (..., 3), their centres; r0, r1: (...), their radii, not both 0.
    Where one ball holds the other, it is that ball.  ends: as of `capsule`.

    >>> drop = cylint.round_cone([0, 0, 0], 1, [0, 0, 3], 0)
    >>> cylint.intersect(drop, [0, 0, -5], [0, 0, 1]).t
    array([4., 8.])
    """
    return _make("round_cone", ends, p0=p0, r0=r0, p1=p1, r1=r1)


def angle_cone(
    v: ArrayLike,
    u: ArrayLike,
    degrees: ArrayLike,
    *,
    ends: Any = "infinite",
) -> Shapes:
    """Cones from apex v, axis u (..., 3) and half angle in degrees (...).

    The angle is between axis and rulings, 0 < degrees < 90.  Bounded ones end
    at v + u.  The shape keeps the float64 nearest to the tangent.

    >>> light = cylint.angle_cone([0, 0, 5], [0, 0, -1], 45, ends="nappe")
    >>> light.contains([[1, 0, 3], [3, 0, 4]])
    array([ 1, -1], dtype=int8)
    """
    return _make("angle_cone", ends, v=v, u=u, degrees=degrees)


def tangent_cone(
    v: ArrayLike,
    u: ArrayLike,
    tangent: ArrayLike,
    *,
    ends: Any = "infinite",
) -> Shapes:
    """Cones as of `angle_cone`, from the tangent of the half angle (...).

    >>> cylint.tangent_cone([0, 0, 0], [0, 0, 1], 0.5, ends="capped").bounds()
    array([[-0.5, -0.5,  0. ],
           [ 0.5,  0.5,  1. ]])
    """
    return _make("tangent_cone", ends, v=v, u=u, tangent=tangent)


def concatenate(shapes: Iterable[Shapes]) -> Shapes:
    """Joins arrays of shapes along their first axis; single shapes count as one.

    >>> a = cylint.cylinder([0, 0, 0], [0, 0, 1], [1, 2])
    >>> b = cylint.cone([0, 0, 0], 1, [0, 0, 1], 0)
    >>> cylint.concatenate([a, b])
    <libcylint.Shapes (3,): 2 cylinders, 1 cone>
    """
    parts = [*shapes]
    for part in parts:
        if not isinstance(part, Shapes):
            raise TypeError(f"expected Shapes, found {type(part).__name__}")
    if not parts:
        return Shapes(np.empty(0, _record))
    records = np.concatenate([np.atleast_1d(s._records) for s in parts])
    if all(s._labels is None for s in parts):
        return Shapes(records)
    labels = np.concatenate(
        [np.atleast_1d(s.labels.astype(np.object_)) for s in parts]
    )
    return Shapes(records, labels)
