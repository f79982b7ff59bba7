"""Arrays of shapes and their constructors."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arguments import (
    Doubles, Points, Progress, array_of, broadcast, counted, doubles, integers, place,
    takes, workers,
)
from ._closest import ClosestPoints
from ._enums import Ends, Kind

_record = np.dtype((np.void, _core.shape_size))
_readable = np.dtype(
    {
        "names": ["kind", "ends"], "formats": [np.intc, np.intc],
        "offsets": [0, _core.shape_ends], "itemsize": _core.shape_size,
    }
)

# The arguments of each constructor with their widths.  Row i makes the kind i + 1 of
# `Kind`; the last row makes the kind of tangent_cone.
_CONSTRUCTORS = {
    "cylinder": {"p0": 3, "p1": 3, "r": 1},
    "cone": {"p0": 3, "r0": 1, "p1": 3, "r1": 1},
    "tangent_cone": {"v": 3, "u": 3, "tangent": 1},
    "elliptic_cylinder": {"c": 3, "a": 3, "b": 3, "h": 3},
    "elliptic_cone": {"c": 3, "a": 3, "b": 3, "h": 3, "k": 1}, "sphere": {"c": 3, "r": 1},
    "capsule": {"p0": 3, "p1": 3, "r": 1},
    "round_cone": {"p0": 3, "r0": 1, "p1": 3, "r1": 1}, "halfspace": {"p": 3, "n": 3},
    "angle_cone": {"v": 3, "u": 3, "degrees": 1},
}
_NAMES = list(_CONSTRUCTORS)
_MOST_NUMBERS = 13
_TUBE_MEMBERS = 4
_ENDS = {e.name.lower(): np.array(e, np.int8) for e in Ends}


def _places(widths: dict[str, int]) -> dict[str, slice]:
    """Where the members of shapes are in a row of numbers."""
    ends = np.cumsum(list(widths.values())).tolist()
    places = {
        name: slice(end - width, end)
        for (name, width), end in zip(widths.items(), ends, strict=True)
    }
    if "p0" in places and "r" in places:
        places |= {"r0": places["r"], "r1": places["r"]}
    return places


_PLACES = {name: _places(widths) for name, widths in _CONSTRUCTORS.items()}


def kinds_of(records: NDArray[np.void]) -> NDArray[np.int32]:
    """The kinds of shapes, where _core finds the shapes."""
    return records.view(_readable)["kind"]


def all_shapes(scene: _core.Scene) -> Shapes:
    """The shapes of a scene, in their order, with their labels."""
    records = np.empty(scene.size(), _record)
    scene.take(None, kinds_of(records), False)
    labels = scene.labels()
    return Shapes(records, None if labels is None else np.array(labels, np.object_))


def shapes_at(
    scene: _core.Scene, index: NDArray[np.int64], closed: bool
) -> tuple[Shapes, NDArray[np.int64]]:
    """The shapes of a scene with these numbers, each once, and an index into them for
    each number; -1 stays.  closed: as closed solids."""
    numbers = np.unique(index[index >= 0])
    records = np.empty(len(numbers), _record)
    scene.take(numbers, kinds_of(records), closed)
    return Shapes(records), np.where(index < 0, -1, np.searchsorted(numbers, index))


class Shapes:
    """An array of shapes, made by a constructor such as `cylinder`.

    It has a shape, a number of axes and a length, and is indexed, like an array
    of NumPy.  Its elements cannot be changed.  It can be pickled.

    The arguments of the constructors are members: p0, p1, r, r0, r1, c, a, b, h,
    k, v, u, tangent, p, n.  They have the shapes of the arguments, (..., 3) or
    (...), are read-only, and are nan where a shape has no such argument.  A round
    cone that is a ball, and a capsule whose ends are equal, have the kind SPHERE,
    but p0, r0, p1 and r1 in place of c and r.  An elliptic cone with k = 1 has the
    kind ECYLINDER and no k.

    `==` compares shapes one by one, as arrays of NumPy: two are equal if one
    constructor makes both from equal numbers and ends.  Labels do not count.

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

    p0: Doubles; p1: Doubles; r0: Doubles; r1: Doubles; r: Doubles  # noqa: E702
    c: Doubles; a: Doubles; b: Doubles; h: Doubles; k: Doubles  # noqa: E702
    p: Doubles; n: Doubles; v: Doubles; u: Doubles; tangent: Doubles  # noqa: E702

    def __init__(
        self, records: NDArray[np.void], labels: NDArray[np.object_] | None = None
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
        labels = self._labels
        if labels is not None:
            labels = np.asarray(labels[index], np.object_)
        return Shapes(np.asarray(self._records[index], _record), labels)

    def __iter__(self) -> Iterator[Shapes]:
        return (self[i] for i in range(len(self)))

    def reshape(self, *shape: Any) -> Shapes:
        """The same shapes in another array shape."""
        records, labels = self._records.reshape(*shape), self._labels
        return Shapes(
            records, None if labels is None else labels.reshape(records.shape)
        )

    def _in_a_row(self) -> Shapes:
        """Shapes with one axis, contiguous; a single shape counts as one."""
        if self.ndim > 1:
            raise ValueError(f"shapes: expected one axis, found the shape {self.shape}")
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
        broadcast("shapes other", self._records, other._records)
        (kinds, numbers), (others, their_numbers) = self._read(), other._read()
        return (
            (kinds == others)
            & (self.ends == other.ends)
            & (numbers == their_numbers).all(axis=-1)
        )

    def __ne__(self, other: object) -> Any:
        equal = self.__eq__(other)
        return equal if equal is NotImplemented else ~equal

    def _read(self) -> tuple[NDArray[np.int8], Doubles]:
        """For each shape the row of its constructor, and its arguments.

        The row is -1 for a refused shape, of a scene that another program saved.
        """
        kinds = np.empty(self.size, np.int8)
        numbers = np.zeros((self.size, _MOST_NUMBERS))
        _core.read_shapes(kinds_of(self._records.reshape(-1)), kinds, numbers)
        return kinds.reshape(self.shape), numbers.reshape(*self.shape, _MOST_NUMBERS)

    def _member(self, name: str, kinds: NDArray[np.int8], numbers: Doubles) -> Doubles:
        """A member, from the answer of `_read`."""
        width = next(a[name] for a in _CONSTRUCTORS.values() if name in a)
        values = np.full((*self.shape, width), np.nan)
        for row, places in enumerate(_PLACES.values()):
            if name in places:
                found = kinds == row
                values[found] = numbers[found, places[name]]
        return values if width > 1 else values[..., 0]

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
        table: dict[str, NDArray[Any]] = {
            "kind": np.asarray(np.array([*_NAMES, "none"])[kinds]),
            "ends": np.asarray(np.array(list(_ENDS))[self.ends]),
        }
        for kind in np.unique(kinds[kinds >= 0]):
            for name in _PLACES[_NAMES[kind]]:
                if name not in table:
                    table[name] = self._member(name, kinds, numbers)
        if self._labels is not None:
            table["labels"] = self._labels.astype(np.str_)
        return table

    @property
    def labels(self) -> NDArray[np.str_]:
        """(...) str, the names that `read_scene` found; "" for none."""
        if self._labels is None:
            return _read_only(np.full(self.shape, ""))
        return _read_only(self._labels.astype(np.str_))

    def with_labels(self, labels: ArrayLike) -> Shapes:
        """The same shapes with other labels.

        labels: (...) str, broadcast to the shapes.

        >>> rods = cylint.cylinder([0, 0, 0], [0, 0, 1], [1, 2])
        >>> rods.with_labels(["thin", "thick"])[1:].labels
        array(['thick'], dtype='<U5')
        """
        names = array_of("labels", labels, np.object_).copy()
        for i, name in enumerate(names.flat):
            if not isinstance(name, str):
                at = place(i, names.shape)
                raise TypeError(f"labels{at}: expected str, found {name!r}")
        if broadcast("shapes labels", self._records, names) != self.shape:
            raise ValueError(f"labels: expected the shape {self.shape}, found {names.shape}")
        return Shapes(self._records, np.broadcast_to(names, self.shape))

    @property
    def kind(self) -> NDArray[np.int32]:
        """The kind of each shape, a value of `Kind`."""
        return kinds_of(self._records)

    @property
    def ends(self) -> NDArray[np.int32]:
        """The ends of each shape, a value of `Ends`."""
        return self._records.view(_readable)["ends"]

    def bounds(self) -> Doubles:
        """The least boxes that hold the solids, (..., 2, 3): low, high corner.

        Each side is rounded outward.  Unbounded sides are infinite.

        >>> cylint.cylinder([0, 0, 0], [0, 0, 2], 1).bounds()
        array([[-1., -1.,  0.],
               [ 1.,  1.,  2.]])
        """
        boxes = np.empty((self.size, 6))
        _core.bounds(kinds_of(self._records.reshape(-1)), boxes)
        return boxes.reshape(*self.shape, 2, 3)

    def _answer(
        self, query: Any, points: Points, answer: Any, column: int, ulps: float = 0.0
    ) -> NDArray[Any]:
        """Calls a function of _core for shapes and points, broadcast, which writes
        one of the columns."""
        axes = broadcast("shapes points", self._records, points.array[..., 0])
        answers = np.empty(axes, answer)
        query(
            self.kind, None, points.array, ulps, [None] * column + [answers],
            workers(points.threads), points.progress,
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
        return self._answer(_core.contains, points, np.int8, 1)

    @takes(Points)
    def distance(self, points: Points) -> Doubles:
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
        return self._answer(_core.closest, points, np.float64, 0)

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
        distance = self._answer(_core.closest, points, np.float64, 0)
        points.keep()
        answers = ClosestPoints(points, distance)
        answers._shapes = self, None
        return answers

    @takes(Points)
    def safety(self, points: Points) -> Doubles:
        """How far points may move without crossing the surfaces: (...).

        A number from 0 to abs(distance(points)), never above it, that takes
        less time to compute.  inf where `distance` is.

        >>> ball = cylint.sphere([0, 0, 0], 1)
        >>> step = ball.safety([0, 3, 4])
        >>> bool(3.999 < step <= 4)
        True
        """
        return self._answer(_core.safety, points, np.float64, 0)

    def on_surface(
        self, points: ArrayLike, ulps: float = 0.0, *, threads: int | None = None,
        progress: Progress | None = None,
    ) -> NDArray[np.bool_]:
        """Whether points are on the surfaces: (...) bool.

        points: (..., 3), broadcast against the shapes.  True if
        abs(distance(points)) is at most `ulps` units in the last place of the
        largest coordinate of the point.  ulps = 0: exactly on the surface.

        >>> ball = cylint.sphere([0, 0, 0], 1)
        >>> points = [[1, 0, 0], [0.6, 0.8, 0]]
        >>> ball.on_surface(points), ball.on_surface(points, 1)
        (array([ True, False]), array([ True,  True]))
        """
        given = Points(points, threads=threads, progress=progress)
        most = doubles("ulps", ulps)
        if most.ndim > 0:
            raise ValueError(f"ulps: expected one number, found the shape {most.shape}")
        return self._answer(_core.on_surface, given, np.bool_, 1, float(most))

    def __reduce__(self) -> tuple[Any, ...]:
        kinds, numbers = self.reshape(self.size)._read()
        used = {_NAMES[k]: kinds == k for k in np.unique(kinds[kinds >= 0])}
        parts = {
            name: numbers[rows, : sum(_CONSTRUCTORS[name].values())]
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


# The members of shapes that are arguments of their constructors.
_MEMBERS = {
    "p0": "(..., 3): where the axis begins, of cylinders, cones, capsules and round cones.",
    "p1": "(..., 3): where the axis ends, of the same.",
    "r0": "(...): the radius at p0; r of a cylinder or capsule.",
    "r1": "(...): the radius at p1; r of a cylinder or capsule.",
    "r": "(...): the radius, of cylinders, capsules and spheres.",
    "c": "(..., 3): the centre, of spheres; of the base, of elliptic kinds.",
    "a": "(..., 3): a semi-axis of the base, of elliptic kinds.",
    "b": "(..., 3): the other semi-axis, of elliptic kinds.",
    "h": "(..., 3): from base to top, of elliptic kinds.",
    "k": "(...): what the top is scaled by, of elliptic cones.",
    "p": "(..., 3): a point of the plane, of half-spaces.",
    "n": "(..., 3): the outward normal as given, of half-spaces.",
    "v": "(..., 3): the apex, of cones with an angle.",
    "u": "(..., 3): the axis, of cones with an angle.",
    "tangent": "(...): the tangent of the half angle, of cones with an angle.",
}


def _fixed(shapes: Shapes, value: object) -> None:
    raise AttributeError("shapes cannot be changed")


def _read_only(array: NDArray[Any]) -> NDArray[Any]:
    """The array, read-only: a change of it would not change the shapes."""
    array.flags.writeable = False
    return array


for _name, _text in _MEMBERS.items():

    def _get(shapes: Shapes, name: str = _name) -> Doubles:
        return _read_only(shapes._member(name, *shapes._read()))

    setattr(Shapes, _name, property(_get, _fixed, None, _text))


def _restore(
    shape: tuple[int, ...], used: dict[str, NDArray[np.bool_]],
    parts: dict[str, Doubles], ends: NDArray[np.int8],
    labels: NDArray[np.object_] | None,
) -> Shapes:
    """The shapes of a pickle."""
    records = np.zeros(ends.size, _record)
    for name, rows in used.items():
        records[rows] = _build(name, parts[name], ends.reshape(-1)[rows], None)
    return Shapes(records.reshape(shape), labels)


# --------------------------------------------------------- constructors --


def codes_of(ends: str | int | ArrayLike) -> NDArray[np.int8]:
    """The ends as numbers, from words or numbers."""
    if isinstance(ends, str) and ends in _ENDS:
        return _ENDS[ends]
    words = array_of("ends", ends)
    if words.dtype.kind in "iu":
        numbers = integers("ends", words)
        wrong = (numbers < 0) | (numbers >= len(_ENDS))
        return np.where(wrong, len(_ENDS), numbers).astype(np.int8)
    codes = np.empty(words.shape, np.int8)
    for word in set(words.reshape(-1).tolist()):
        if not isinstance(word, str):
            raise TypeError(f"ends: expected words or integers, found {word!r}")
        if word.lower() not in _ENDS:
            right = ", ".join(_ENDS)
            raise ValueError(f"ends: expected one of {right}; found {word!r}")
        codes[words == word] = _ENDS[word.lower()]
    return codes


def _build(
    name: str, numbers: Doubles, ends: NDArray[np.int8], shape: tuple[int, ...] | None,
) -> NDArray[np.void]:
    """Shapes of one constructor, from numbers (n, k) and ends (n).  shape: that of
    the arguments, for messages."""
    records = np.empty(len(numbers), _record)
    statuses = np.empty(len(numbers), np.int8)
    row = _NAMES.index(name)
    if _core.make_shapes(row, numbers, ends, kinds_of(records), statuses) > 0:
        bad = int(np.flatnonzero(statuses)[0])
        at = place(bad, (len(numbers),) if shape is None else shape)
        raise ValueError(f"{name}{at}: {_core.strerror(int(statuses[bad]))}")
    return records


def _make(name: str, given: dict[str, Any]) -> Shapes:
    """Broadcasts the arguments of a constructor, those of its row, and `ends`."""
    codes = codes_of(given.get("ends", "infinite"))
    arrays = [
        doubles(key, given[key], 3) if width > 1 else doubles(key, given[key])[..., None]
        for key, width in _CONSTRUCTORS[name].items()
    ]
    names = " ".join(_CONSTRUCTORS[name]) + " ends"
    shape = broadcast(names, *(a[..., 0] for a in arrays), codes)
    width = sum(_CONSTRUCTORS[name].values())
    numbers = np.empty((*shape, width))
    for array, at in zip(arrays, _PLACES[name].values(), strict=False):
        numbers[..., at] = array
    ends = np.full(shape, codes).reshape(-1)
    records = _build(name, numbers.reshape(-1, width), ends, shape)
    return Shapes(records.reshape(shape))


def cylinder(
    p0: ArrayLike, p1: ArrayLike, r: ArrayLike, *, ends: Any = "capped"
) -> Shapes:
    """Circular cylinders: the points at most r from the axis p0 p1.

    p0, p1: (..., 3), the axis; r: (...), the radius.  They broadcast.
    ends: a word or an array of words: "capped" (both caps), "open" (none),
    "cap0" (at p0 only), "cap1", "infinite", "nappe"; or values of `Ends`.

    >>> cylint.cylinder([0, 0, 0], [0, 0, 1], [0.5, 1, 2], ends="open")
    <libcylint.Shapes (3,): 3 cylinders>
    """
    return _make("cylinder", locals())


def cone(
    p0: ArrayLike, r0: ArrayLike, p1: ArrayLike, r1: ArrayLike, *, ends: Any = "capped"
) -> Shapes:
    """Frusta: radius r0 (...) at p0 (..., 3) and r1 at p1.

    If a radius is 0, the cone has its apex there.  With ends="infinite" it is a
    double cone, with "nappe" the nappe that holds the base, or the top if r0 is 0.

    >>> cylint.cone([0, 0, 0], 1, [0, 0, 3], 0).bounds()
    array([[-1., -1.,  0.],
           [ 1.,  1.,  3.]])
    """
    return _make("cone", locals())


def elliptic_cylinder(
    c: ArrayLike, a: ArrayLike, b: ArrayLike, h: ArrayLike, *, ends: Any = "capped"
) -> Shapes:
    """Elliptic cylinders: c + x a + y b + z h with x^2 + y^2 <= 1.

    c, a, b, h: (..., 3).  a, b, h must be linearly independent; they need not
    be perpendicular.

    >>> flat = cylint.elliptic_cylinder([0, 0, 0], [2, 0, 0], [0, 1, 0], [0, 0, 1])
    >>> cylint.intersect(flat, [-5, 0, 0.5], [1, 0, 0]).t
    array([3., 7.])
    """
    return _make("elliptic_cylinder", locals())


def elliptic_cone(
    c: ArrayLike, a: ArrayLike, b: ArrayLike, h: ArrayLike, k: ArrayLike, *, ends: Any = "capped"
) -> Shapes:
    """Elliptic cones: c + x a + y b + z h with x^2 + y^2 <= (1 + (k-1) z)^2.

    c, a, b, h: (..., 3); k: (...) scales the top, 0 gives an apex at c + h.

    >>> cylint.elliptic_cone([0, 0, 0], [2, 0, 0], [0, 1, 0], [0, 0, 1], 0.5)
    <libcylint.Shapes (): 1 econe>
    """
    return _make("elliptic_cone", locals())


def sphere(c: ArrayLike, r: ArrayLike, *, ends: Any = "capped") -> Shapes:
    """Balls: the points at most r (...) from c (..., 3).

    >>> cylint.intersect(cylint.sphere([0, 0, 0], 1), [-3, 0, 0], [1, 0, 0]).t
    array([2., 4.])
    """
    return _make("sphere", locals())


def halfspace(p: ArrayLike, n: ArrayLike) -> Shapes:
    """Half-spaces: the points x with (x - p).n <= 0.

    p, n: (..., 3); n points out and need not have length 1.  They are unbounded; a
    line hits the plane at most once.  With other shapes they make sectors and cuts,
    see `Scene.set_solids`.

    >>> cylint.intersect(cylint.halfspace([5, 0, 0], [-2, 0, 0]), [0, 0, 0], [1, 0, 0]).t
    array([ 5., nan])
    """
    return _make("halfspace", locals())


def tube(
    p0: ArrayLike, p1: ArrayLike, outer: ArrayLike, inner: ArrayLike = 0, *,
    sector: ArrayLike | None = None,
) -> tuple[Shapes, NDArray[np.intc]]:
    """The shapes and clauses of a hollow cylinder or cone, or of a sector of one.

    p0, p1: (3,), the axis.  outer, inner: the radii at p0 and p1, (2,), or one for
    both; inner radii of 0: no bore.  A bore that is nowhere narrower than the tube
    leaves no wall.
    sector: (2, 3), two directions from the axis: the solid is the part from the first
    to the second, right-handed about the axis from p0 to p1.  None: a full turn.

    The shapes are 1 to 4: the outer one, the bore and the half-spaces of the sector.
    The clauses are those of `Scene.set_solids`.  The planes are exact if the axis lies
    along a coordinate; others are rounded: cylint_pieces(3) states by how much.

    >>> shapes, clauses = cylint.tube([0, 0, 0], [0, 0, 9], 2, 1, sector=[[1, 0, 0], [0, 1, 0]])
    >>> shapes, clauses
    (<libcylint.Shapes (4,): 2 cylinders, 2 halfspaces>, array([ 1, -2,  3,  4], dtype=int32))
    >>> scene = cylint.Scene(shapes)
    >>> scene.set_solids(range(4), 0, clauses)
    >>> scene.pieces([-5, 0, 3], [1, 0, 0])[3:]
    (array([6.]), array([7.]))
    """
    numbers = []
    for name, value, shape in (
        ("p0", p0, (3,)), ("p1", p1, (3,)), ("outer", outer, (2,)), ("inner", inner, (2,)),
        ("sector", np.zeros((2, 3)) if sector is None else sector, (2, 3)),
    ):
        array = doubles(name, value)
        if array.size == 1 and shape == (2,):
            array = np.repeat(array, 2)
        if array.shape != shape:
            raise ValueError(f"{name}: expected the shape {shape}, found {array.shape}")
        numbers.append(array.reshape(-1))
    records = np.empty(_TUBE_MEMBERS, _record)
    clauses = np.empty(_TUBE_MEMBERS, np.intc)
    n, wrong = _core.make_tube(
        np.concatenate(numbers), sector is not None, kinds_of(records), clauses
    )
    if wrong:
        raise ValueError(f"tube: {wrong}")
    return Shapes(records[:n]), clauses[:n]


def capsule(
    p0: ArrayLike, p1: ArrayLike, r: ArrayLike, *, ends: Any = "capped"
) -> Shapes:
    """Capsules: the points at most r (...) from the segment p0 p1 (..., 3).

    The round ends are the parts CAP0, about p0, and CAP1.  ends: as for
    `cylinder`, but neither "infinite" nor "nappe".

    >>> cylint.capsule([0, 0, 0], [0, 0, 2], 0.5).bounds()
    array([[-0.5, -0.5, -0.5],
           [ 0.5,  0.5,  2.5]])
    """
    return _make("capsule", locals())


def round_cone(
    p0: ArrayLike, r0: ArrayLike, p1: ArrayLike, r1: ArrayLike, *, ends: Any = "capped"
) -> Shapes:
    """Round cones: the convex hulls of two balls.

    p0, p1: (..., 3), their centres; r0, r1: (...), their radii, not both 0.
    Where one ball holds the other, the shape is that ball.  ends: as for `capsule`.

    >>> drop = cylint.round_cone([0, 0, 0], 1, [0, 0, 3], 0)
    >>> cylint.intersect(drop, [0, 0, -5], [0, 0, 1]).t
    array([4., 8.])
    """
    return _make("round_cone", locals())


def angle_cone(
    v: ArrayLike, u: ArrayLike, degrees: ArrayLike, *, ends: Any = "infinite"
) -> Shapes:
    """Cones from apex v, axis u (..., 3) and half angle in degrees (...).

    The angle is between axis and rulings, 0 < degrees < 90.  Bounded ones end
    at v + u.  The shape keeps the float64 nearest to the tangent.

    >>> light = cylint.angle_cone([0, 0, 5], [0, 0, -1], 45, ends="nappe")
    >>> light.contains([[1, 0, 3], [3, 0, 4]])
    array([ 1, -1], dtype=int8)
    """
    return _make("angle_cone", locals())


def tangent_cone(
    v: ArrayLike, u: ArrayLike, tangent: ArrayLike, *, ends: Any = "infinite"
) -> Shapes:
    """Cones as by `angle_cone`, from the tangent of the half angle (...).

    >>> cylint.tangent_cone([0, 0, 0], [0, 0, 1], 0.5, ends="capped").bounds()
    array([[-0.5, -0.5,  0. ],
           [ 0.5,  0.5,  1. ]])
    """
    return _make("tangent_cone", locals())


def concatenate(shapes: Iterable[Shapes]) -> Shapes:
    """Joins arrays of shapes along their first axis; single shapes count as one.

    >>> a = cylint.cylinder([0, 0, 0], [0, 0, 1], [1, 2])
    >>> b = cylint.cone([0, 0, 0], 1, [0, 0, 1], 0)
    >>> cylint.concatenate([a, b])
    <libcylint.Shapes (3,): 2 cylinders, 1 cone>
    """
    parts = [*checked(shapes)]
    records = [np.atleast_1d(part._records) for part in parts]
    labels = [(r.shape, part._labels) for r, part in zip(records, parts, strict=True)]
    joined = np.concatenate(records) if parts else np.empty(0, _record)
    return Shapes(joined, joined_labels(labels))


def checked(parts: Iterable[Shapes]) -> Iterator[Shapes]:
    """Arrays of shapes; raises TypeError for what is none."""
    for part in parts if isinstance(parts, Iterable) else [parts]:
        if not isinstance(part, Shapes):
            raise TypeError(f"expected Shapes, found {type(part).__name__}")
        yield part


def joined_labels(parts: list[Any]) -> NDArray[np.object_] | None:
    """The labels of arrays of shapes, each given by its shape and labels or None."""
    if all(labels is None for _, labels in parts):
        return None
    none = np.array("", np.object_)
    return np.concatenate(
        [np.broadcast_to(none if x is None else x, shape) for shape, x in parts]
    )


def encoded(labels: NDArray[np.object_] | None) -> list[bytes] | None:
    """Labels of shapes with one axis, in UTF-8 or as the bytes that were read."""
    if labels is None:
        return None
    try:
        return [label.encode("utf-8", "surrogateescape") for label in labels]
    except UnicodeEncodeError as error:
        number = labels.tolist().index(error.object)
        raise ValueError(
            f"shape {number}: the label {error.object!r} has no encoding in UTF-8"
        ) from None
