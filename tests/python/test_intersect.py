"""intersect(): equal to the command, to single questions, for every layout."""

import copy
import pickle

import numpy as np
import pytest
from conftest import (
    ROD, SHAPES, TEXTS, drawn, equal, forest, records, refused, same, vectors,
)
from hypothesis import given
from hypothesis import strategies as st

import libcylint as cylint

ANSWER = ("relation", "n", "t", "part")
MEMBERS = ("point", "normal", "z", "phi", "side", "outside", "inside")


@pytest.mark.parametrize("name", SHAPES)
def test_every_member_equals_the_command(command, name):
    o, d = drawn(2000, 11)
    hit = cylint.intersect(SHAPES[name], o, d)
    command(
        records("ray", o, d, TEXTS[name]), relation=hit.relation, n=hit.n,
        part0_part1=hit.part, side0_side1=hit.side, t0_t1=hit.t, h0_h1=hit.z,
        phi0_phi1=hit.phi, x0_y0_z0_x1_y1_z1=hit.point, nx0_ny0_nz0_nx1_ny1_nz1=hit.normal,
    )  # fmt: skip
    assert 0 < np.count_nonzero(hit.n) < len(o)


@pytest.mark.parametrize("name", ["cone", "econe", "rcone"])
def test_segments_are_exact(command, name):
    shape = SHAPES[name]
    a, d = drawn(2000, 15)
    b = a + 1.5 * d
    long = (a != b).any(axis=1)
    a, b = a[long], b[long]
    hit = cylint.intersect(shape, a, to=b)
    command(
        records("segment", a, b, TEXTS[name]), relation=hit.relation, n=hit.n,
        part0_part1=hit.part, t0_t1=hit.t, x0_y0_z0_x1_y1_z1=hit.point,
    )  # fmt: skip
    rounded = cylint.intersect(shape, a, b - a, 0, 1)
    assert not same(rounded.t, hit.t) and hit.n.any()
    scene = cylint.Scene(shape)
    assert same(scene.nearest(a, to=b).t, hit.t[:, 0])
    assert same(scene.any(a, to=b), hit.n > 0) and same(scene.count(a, to=b), hit.n > 0)
    assert same(scene.all(a, to=b).t, hit.t[hit.n > 0])
    assert cylint.intersect(shape, a[:1, None], to=b[None, :9]).t.shape == (1, 9, 2)


def test_a_segment_has_no_directions_and_no_domain():
    o = [0, 0, -5]
    for wrong in ({}, {"directions": [0, 0, 1], "to": [0, 0, 1]}):
        with refused("either directions or to", TypeError):
            cylint.intersect(ROD, o, **wrong)
    with refused("tmin and tmax need directions", TypeError):
        cylint.intersect(ROD, o, to=[0, 0, 1], tmax=1)
    with refused("line 1: the direction has no length"):
        cylint.intersect(ROD, [o, [0, 0, 1]], to=[0, 0, 1])
    with refused("expected Shapes, found int", TypeError):
        cylint.intersect(5, o, [0, 0, 1])
    with refused(r"^within\(\) missing 1 required positional argument: 'r'$", TypeError):
        cylint.Scene(ROD).within(o)
    with refused("to: expected the shape"):
        cylint.intersect(ROD, o, to=[0, 0])


@pytest.mark.parametrize("name", SHAPES)
def test_rays_leave_from_outside_and_from_inside(name):
    shape = SHAPES[name]
    o, d = drawn(2000, 14)
    hit = cylint.intersect(shape, o, d, tmin=-np.inf)
    there = hit.part >= 0
    at, outside, inside = (x[there] for x in (hit.point, hit.outside, hit.inside))
    for member in (hit.outside, hit.inside):
        assert same(~there, np.isnan(member).any(-1))
    assert (shape.contains(at) <= 0).any()
    assert (shape.contains(outside) == -1).all() and (shape.contains(inside) == 1).all()
    for moved in (outside, inside):
        assert np.abs(moved - at).max() <= 4 * np.spacing(np.abs(at).max())
    if name in ("cylinder", "cone", "rcone", "sphere"):  # convex and closed
        n = hit.normal[there]
        assert not cylint.intersect(shape, outside, n).n.any()
        assert (cylint.intersect(shape, inside, -n).n == 1).all()


def test_a_solid_thinner_than_the_steps_of_doubles_has_no_inside():
    disc = cylint.cylinder([0, 0, 1], [0, 0, np.nextafter(1, 2)], 1)
    hit = cylint.intersect(disc, [0.5, 0.25, -1], [0, 0, 1])
    assert hit.n == 2 and np.isnan(hit.inside).all()
    assert (disc.contains(hit.outside) == -1).all()


@pytest.mark.parametrize("layout", ["lines", "pairs", "shapes", "table"])
@pytest.mark.parametrize("key", ["directions", "to"])
def test_refused_lines_have_no_relation_on_request(layout, key):
    """In every layout of a batch; the lines beside them are as without."""
    shapes, (o, d) = forest(1200, 16), drawn(1200, 17)
    d[~np.isfinite(o + d).all(-1) | (o + d == o).all(-1)] = 1
    ends = o + d if key == "to" else d
    bad = np.zeros(1200, bool)
    bad[[0, 5, 511, 512, 700, 1199]] = True
    spoiled = np.where(bad[:, None], [np.nan, 0, 1], ends)
    if layout == "lines":
        shapes = ROD
    elif layout == "shapes":
        o, ends, spoiled, bad = o[0], ends[0], spoiled[0], np.ones(1200, bool)
    elif layout == "table":
        shapes = shapes[:7, None]
    with refused(r"line( 0)?: a number is not finite"):
        cylint.intersect(shapes, o, **{key: spoiled})
    want = cylint.intersect(shapes, o, **{key: ends})
    hit = cylint.intersect(shapes, o, **{key: spoiled}, errors="mask")
    bad = np.broadcast_to(bad, hit.n.shape)
    for member, none, axes in (
        ("relation", -1, 0), ("n", 0, 0), ("t", np.nan, 1), ("part", -1, 1), ("point", np.nan, 2),
    ):  # fmt: skip
        spread = bad.reshape(bad.shape + (1,) * axes)
        assert same(getattr(hit, member), np.where(spread, none, getattr(want, member)))
    assert cylint.Relation(int(hit.relation.flat[0])) == cylint.Relation.NONE


def test_a_table_equals_its_rows_and_columns():
    shapes, (o, d) = forest(700, 12), drawn(600, 13)
    o = o * 0.1 + 0.5
    table = cylint.intersect(shapes[:, None], o, d)
    assert table.t.shape == (700, 600, 2) and table.n.max() == 2
    for i in range(0, 700, 50):
        assert same(table.t[i], cylint.intersect(shapes[i], o, d).t)
    for j in range(0, 600, 50):
        column = cylint.intersect(shapes, o[j], d[j])
        assert same(table.t[:, j], column.t) and same(table.part[:, j], column.part)
    across = cylint.intersect(shapes, o[:, None], d[:, None])
    assert same(np.swapaxes(across.t, 0, 1), table.t)
    assert same(across.relation.T, table.relation)
    pairs = cylint.intersect(shapes[:600], o, d)
    assert same(pairs.t, table.t[np.arange(600), np.arange(600)])
    for i in range(0, 600, 40):
        for shape in (shapes[i], shapes[i : i + 1]):
            one = cylint.intersect(shape, o[i], d[i])
            assert same(np.ravel(one.t), pairs.t[i]) and one.relation == pairs.relation[i]
    few = cylint.intersect(shapes[:3, None, None], o[None, :, None], d[5])
    assert few.t.shape == (3, 600, 1, 2)


def test_lazy_members_follow_the_layout():
    shapes, (o, d) = forest(40, 14), drawn(50, 15)
    o = o * 0.1 + 0.5
    table, one = cylint.intersect(shapes[:, None], o, d), cylint.intersect(shapes[7], o, d)
    for member in MEMBERS:
        assert same(getattr(table, member)[7], getattr(one, member))
    assert table.point.shape == (40, 50, 2, 3) and table.z.shape == (40, 50, 2)
    assert table.point is table.point


@pytest.mark.parametrize("again", [copy.deepcopy, lambda x: pickle.loads(pickle.dumps(x))])
def test_pickled_answers_compute_the_same_members(again):
    shapes, (o, d) = forest(40, 16), drawn(40, 17)
    o, scene = o * 0.1 + 0.5, cylint.Scene(shapes)
    lines = {"progress": lambda done, total: None, "threads": 2}
    for ask in (
        lambda: cylint.intersect(shapes[::2, None], o, d, **lines),
        lambda: scene.nearest(o, d, exclude=3, **lines), lambda: scene.nearest(o, d, tmax=0),
    ):
        assert equal(again(ask()), ask(), "t", "part", *MEMBERS)
    for ask in (
        lambda: shapes[::2, None].closest(o, **lines), lambda: scene.closest(o, within=0.1),
        lambda: scene.closest(o, signed=True, **lines), lambda: scene.closest(o, within=-1),
    ):
        assert equal(again(ask()), ask(), "distance", "part", "feature", "point", "normal")


@given(vectors, vectors, st.integers(1, 7), st.integers(0, 6))
def test_strides_and_types_make_no_difference(o, d, step, offset):
    good = d.any(axis=1)
    good[0] = True
    d[0] = 1
    o, d = o[good], d[good]
    want = cylint.intersect(ROD, o, d)
    spread = np.full((len(o) * step + offset, 9), np.nan)
    spread[offset::step, 1:6:2] = o
    packed = np.zeros(len(o), dtype=[("tag", "i1"), ("o", "f8", 3)])
    packed["o"] = o
    for given_o, given_d in (
        (spread[offset::step, 1:6:2], d), (np.asfortranarray(o), d.tolist()),
        (packed["o"], d), (o.astype(">f8"), d),
    ):  # fmt: skip
        assert equal(want, cylint.intersect(ROD, given_o, given_d), *ANSWER)


def test_integers_and_singles_are_converted():
    hit = cylint.intersect(ROD, np.array([0, 0, -5]), np.float32([0, 0, 1]))
    assert hit.t.tolist() == [5, 6]


def test_tmin_and_tmax_bound_the_hits():
    hit = cylint.intersect(ROD, [0, 0, -5], [0, 0, 1], [0, 5.5, -9], [[9], [5.5]])
    assert hit.n.tolist() == [[2, 1, 2], [1, 0, 1]]
    three = cylint.concatenate([ROD] * 3)
    assert cylint.intersect(three, [0, 0, -5], [0, 0, 1], [0, 5.5, -9]).n.tolist() == [2, 1, 2]
    whole = cylint.intersect(ROD, [0, 0, 5], [0, 0, 1], -np.inf)
    assert whole.t.tolist() == [-5, -4]


@pytest.mark.parametrize("wrong", [np.nan, np.inf])
@pytest.mark.parametrize("row", [0, 1, 513, 2999])
def test_the_first_bad_line_is_named(row, wrong):
    o, d = drawn(3000, 16)
    o[[row, -1], [1, 2]] = wrong
    scene = cylint.Scene(ROD)
    for call in (lambda *lines: cylint.intersect(ROD, *lines), scene.nearest, scene.all):
        with refused(rf"^line {row}: a number is not finite$"):
            call(o, d)


def test_what_does_not_fit_is_named():
    none, up, d, o = [0, 0, 0], [0, 0, 1], np.ones((4, 5, 3)), np.ones((9, 1, 3))
    d[2, 3] = 0
    o[7] = np.nan
    for message, *arguments in (
        (r"^line \(2, 3\): the direction has no len", forest(6, 17)[:, None, None], none, d),
        (r"^line \(7, 0\): a number is not fini", ROD, o, [up, up[::-1]]),
        ("^line 1: the domain is empty", ROD, none, up, 0, [1, -1]),
        ("^line: the domain is empty or not a numb", ROD, none, up, np.nan),
        (r"origins: expected the shape \(\.\.\., 3\)", ROD, [0, 0], up),
        (r"origins \(2,\), directions \(4,\)", ROD, np.zeros((2, 3)), np.ones((4, 3))),
        (r"shapes \(3,\), lines \(2,\)", forest(4, 1)[:3], np.zeros((2, 3)), up),
    ):
        with refused(message):
            cylint.intersect(*arguments)


def test_empty_arrays():
    none, up = np.empty((0, 3)), [0, 0, 1]
    hit = cylint.intersect(ROD, none, none)
    assert hit.t.shape == (0, 2) and hit.point.shape == (0, 2, 3)
    assert cylint.intersect(forest(8, 1)[:0], [0, 0, 0], up).n.shape == (0,)
    assert cylint.intersect(forest(8, 1)[:, None], none, up).n.shape == (8, 0)
