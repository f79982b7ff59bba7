"""Every function gives the answers of single questions, whatever the layout of its
arrays: shapes and lines or points one by one, in tables, more than a block, and with
strides of any kind.  Refused lines are among them."""

import copy
import pickle
from types import SimpleNamespace

import numpy as np
import pytest
from conftest import SHAPES, drawn

import libcylint as cylint

KINDS = cylint.concatenate(SHAPES.values())
SCENE = cylint.Scene(KINDS)
SCENE.set_solids([0, 1, 2], 0, [1, 1, -2])
LABELS = np.arange(len(KINDS)) % 3
HITS = ("t", "part", "point", "normal", "z", "phi", "side", "outside", "inside")
CLOSEST = ("distance", "part", "feature", "point", "normal")
NO_PROGRESS = {"progress": lambda done, total: None}  # is in no pickle
MASKED = {"errors": "mask"} | NO_PROGRESS


def values(answer, *names):
    return [getattr(answer, name) for name in names] if names else list(answer)


# s: shapes.  g.o, g.d: origins, and directions or ends; g.x, g.y: numbers, a domain for
# most lines; g.e: numbers of shapes.  All broadcast.  An answer has its members' names,
# or is a list of arrays.
OF_SHAPES = {
    "intersect": lambda s, g: (
        cylint.intersect(s, g.o, g.d, g.x, g.y, **MASKED), "relation", "n", *HITS
    ),
    "segments": lambda s, g: (
        cylint.intersect(s, g.o, to=g.d, **MASKED), "relation", "n", *HITS
    ),
    "closest": lambda s, g: (s.closest(g.o, **NO_PROGRESS), *CLOSEST),
    "distance": lambda s, g: ([s.distance(g.o)],),
    "safety": lambda s, g: ([s.safety(g.o)],),
    "contains": lambda s, g: ([s.contains(g.o)],),
    "on_surface": lambda s, g: ([s.on_surface(g.o, 8)],),
}
OF_SCENES = {
    "nearest": lambda s, g: (
        SCENE.nearest(g.o, g.d, g.x, g.y, **MASKED), "index", *HITS
    ),
    "nearest of others": lambda s, g: (
        SCENE.nearest(g.o, to=g.d, exclude=g.e, **MASKED), "index", *HITS
    ),
    "any": lambda s, g: ([SCENE.any(g.o, g.d, g.x, g.y, **MASKED)],),
    "count": lambda s, g: ([SCENE.count(g.o, g.d, exclude=g.e, **MASKED)],),
    "sums": lambda s, g: ([SCENE.sums(g.o, g.d, g.x, labels=LABELS, **MASKED)],),
    "first_boundary": lambda s, g: (SCENE.first_boundary(g.o, g.d, g.x, **MASKED),),
    "closest of a scene": lambda s, g: (SCENE.closest(g.o, g.x), "index", *CLOSEST),
    "closest, signed": lambda s, g: (
        SCENE.closest(g.o, g.x, signed=True, **NO_PROGRESS), "index", *CLOSEST
    ),
    "within_count": lambda s, g: ([SCENE.within_count(g.o, g.x, signed=True)],),
    "contains of a scene": lambda s, g: ([SCENE.contains(g.o)],),
    "depth": lambda s, g: (SCENE.depth(g.o, rank=-LABELS),),
}
ALL = OF_SHAPES | OF_SCENES


def given():
    """Some points are on surfaces; some lines are refused."""
    o, d = drawn(70, 12)
    o[::5] = KINDS[np.arange(14) % 11].closest(o[::5]).point
    d[3::10], d[4] = np.nan, 0
    random = np.random.default_rng(13)
    x = random.integers(0, 7, 70) / 2.0
    return {"o": o, "d": d, "x": x, "y": 2 * x[::-1], "e": random.integers(-1, 11, 70)}


def listed(array):
    return array.tolist() if array.size > 0 else array


def swapped(array):
    return array.astype(array.dtype.newbyteorder())


def backwards(array):
    return array[::-1].copy()[::-1]


def spread(array):
    """The same values, in steps along every axis."""
    wide = np.zeros([3 * n + 1 for n in array.shape], array.dtype)
    view = wide[tuple(slice(1, None, 3) for _ in array.shape)]
    view[...] = array
    return view


def unaligned(array):
    packed = np.zeros(len(array), [("tag", "i1"), ("x", array.dtype, array.shape[1:])])
    packed["x"] = array
    return packed["x"]


VIEWS = (np.asarray, np.asfortranarray, listed, swapped, backwards, spread, unaligned)
PLAIN = (np.asarray,) * 5


def turned(views):
    """Views of several arrays: each has a view of its own."""
    return [views[n:] + views[:n] for n in range(len(views))]


def layouts():
    """The numbers of shapes, and those of lines or points; they broadcast."""
    s, p, n = np.arange(11), np.arange(70), np.arange(1300)
    yield from ((4, 5), (4, p), (4, n % 70), (4, p.reshape(7, 1, 10)), (4, p[:0]))
    yield (4, p.reshape(10, 7))
    yield from ((s, 5), (n % 11, 5), (s[:0], 5), (n % 11, n % 70), (s[:, None], p))
    yield from ((s[::-1, None], n % 70), (s, p[:, None]), (s[:, None], p[:0]))
    yield (s[:, None, None], p[:20, None])


@pytest.mark.parametrize("name", ALL)
def test_every_layout_has_the_answers_of_single_questions(name):
    arrays = given()

    def answers(shapes, j, views):
        some = {k: view(arrays[k][j]) for k, view in zip(arrays, views, strict=False)}
        return values(*ALL[name](shapes, SimpleNamespace(**some)))

    singly = [[answers(shape, j, PLAIN) for j in range(70)] for shape in KINDS]
    want = [
        np.array([[answer[k] for answer in row] for row in singly])
        for k in range(len(singly[0][0]))
    ]
    assert all(len(np.unique(column)) > 1 for column in want)
    for i, j in layouts():
        if name in OF_SCENES and np.ndim(i) > 0:
            continue
        for views in (PLAIN, *turned(VIEWS)) if np.ndim(j) > 0 else [PLAIN]:
            shapes = KINDS[i]
            if views[0] is spread and np.ndim(i) > 0:
                shapes = KINDS[np.repeat(i, 2, axis=0)][::2]
            for found, column in zip(answers(shapes, j, views), want, strict=True):
                right = column[i, j]
                assert found.dtype == right.dtype and found.shape == right.shape
                assert found.tobytes() == right.tobytes(), (views[0], i, j)


LATER = [name for name, call in ALL.items() if len(call(KINDS[0], SimpleNamespace(**given()))) > 1]


def read_only(array):
    view = array[:]
    view.flags.writeable = False
    return view


def forth_and_back(array):
    return array[::-1][::-1]


@pytest.mark.parametrize("name", LATER)
def test_answers_and_their_copies_own_what_they_need(name):
    """Members are computed after the caller has changed its arrays; what a view shows
    may change though it is read-only."""
    arrays = given()

    def answers(view):
        views = SimpleNamespace(**{key: view(array) for key, array in arrays.items()})
        return ALL[name](KINDS[:, None], views)

    (want, *names), *others = map(answers, (np.asarray, read_only, memoryview, forth_and_back))
    right = values(want, *names)
    assert want.point is want.point
    fixed, buffer, answer = (other[0] for other in others)
    copies = fixed, buffer, copy.deepcopy(fixed), pickle.loads(pickle.dumps(buffer)), answer
    for array in (*arrays.values(), *([answer.index] if "index" in names else [])):
        array += 100
    for again in copies:
        for member, column in zip(names, right, strict=True):
            if member != "index" or again is not answer:
                assert getattr(again, member).tobytes() == column.tobytes(), member
