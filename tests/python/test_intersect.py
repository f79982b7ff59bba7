"""intersect(): equal to the command, to single questions, for every layout."""

import numpy as np
import pytest
from conftest import drawn, forest, hexadecimal, numbers, same, text_of
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

import libcylint as cylint

ROD = cylint.cylinder([0, 0, 0], [0, 0, 1], 0.5)
RELATIONS = {"miss": 0, "touch": 1, "along": 2, "cross": 3}
PARTS = {"-": -1, "lateral": 0, "cap0": 1, "cap1": 2}
MEMBERS = ("point", "normal", "z", "phi", "side", "outside", "inside")
SIDES = {"-": -1, "entering": 0, "leaving": 1, "both": 2}
SHAPES = {
    "cylinder": (ROD, "cylinder 0 0 0 0 0 1 .5"),
    "cone": (
        cylint.cone([0, 0, -1], 1, [0.25, 0, 1], 0.25),
        "cone 0 0 -1 1 .25 0 1 .25",
    ),
    "econe": (
        cylint.elliptic_cone(
            [0, 0, -1], [1, 0, 0], [0, 0.5, 0], [0.5, 0, 2], 0.5, ends="cap0"
        ),
        "econe 0 0 -1 1 0 0 0 .5 0 .5 0 2 .5 ends=cap0",
    ),
    "rcone": (
        cylint.round_cone([0, 0, -1], 0.75, [0.25, 0, 1], 0.25),
        "rcone 0 0 -1 .75 .25 0 1 .25",
    ),
    "capsule": (
        cylint.capsule([0, 0, -1], [0, 0, 1], 0.5, ends="open"),
        "capsule 0 0 -1 0 0 1 .5 ends=open",
    ),
    "sphere": (cylint.sphere([0, 0, 0], 0.5), "sphere 0 0 0 .5"),
    "acone": (
        cylint.angle_cone([0, 0, 0], [0, 0, 1], 40),
        "acone 0 0 0 0 0 1 40",
    ),
}


@pytest.mark.parametrize("name", SHAPES)
def test_every_member_equals_the_command(command, name):
    shape, text = SHAPES[name]
    o, d = drawn(2000, 11)
    hit = cylint.intersect(shape, o, d)
    fields = command(
        text_of(
            ["ray"] * len(o), hexadecimal(o), hexadecimal(d), [text] * len(o)
        ),
        "-f",
        "relation,n,part0,part1,side0,side1,t0,t1,h0,h1,phi0,phi1,"
        "x0,y0,z0,x1,y1,z1,nx0,ny0,nz0,nx1,ny1,nz1",
    )
    assert [RELATIONS[f[0]] for f in fields] == hit.relation.tolist()
    assert [int(f[1]) for f in fields] == hit.n.tolist()
    assert [[PARTS[x] for x in f[2:4]] for f in fields] == hit.part.tolist()
    assert [[SIDES[x] for x in f[4:6]] for f in fields] == hit.side.tolist()
    value = numbers([f[6:] for f in fields])
    assert same(value[:, 0:2], hit.t)
    assert same(value[:, 2:4], hit.z)
    assert same(value[:, 4:6], hit.phi)
    assert same(value[:, 6:12].reshape(-1, 2, 3), hit.point)
    assert same(value[:, 12:18].reshape(-1, 2, 3), hit.normal)
    assert 0 < np.count_nonzero(hit.n) < len(o)


@pytest.mark.parametrize("name", ["cone", "econe", "rcone"])
def test_segments_are_exact(command, name):
    shape, text = SHAPES[name]
    a, d = drawn(2000, 15)
    b = a + 1.5 * d
    long = (a != b).any(axis=1)
    a, b = a[long], b[long]
    hit = cylint.intersect(shape, a, to=b)
    fields = command(
        text_of(
            ["segment"] * len(a),
            hexadecimal(a),
            hexadecimal(b),
            [text] * len(a),
        ),
        "-f",
        "relation,n,part0,part1,t0,t1,x0,y0,z0,x1,y1,z1",
    )
    assert [RELATIONS[f[0]] for f in fields] == hit.relation.tolist()
    assert [int(f[1]) for f in fields] == hit.n.tolist()
    assert [[PARTS[x] for x in f[2:4]] for f in fields] == hit.part.tolist()
    value = numbers([f[4:] for f in fields])
    assert same(value[:, 0:2], hit.t)
    assert same(value[:, 2:8].reshape(-1, 2, 3), hit.point)
    rounded = cylint.intersect(shape, a, b - a, 0, 1)
    assert not same(rounded.t, hit.t) and hit.n.any()
    scene = cylint.Scene(shape)
    assert same(scene.nearest(a, to=b).t, hit.t[:, 0])
    assert np.array_equal(scene.any(a, to=b), hit.n > 0)
    assert np.array_equal(scene.count(a, to=b), hit.n > 0)
    every = scene.all(a, to=b)
    assert same(every.t, hit.t[hit.n > 0])
    table = cylint.intersect(shape, a[:1, None], to=b[None, :9])
    assert table.t.shape == (1, 9, 2)


def test_a_segment_has_no_directions_and_no_domain():
    for wrong in ({}, {"directions": [0, 0, 1], "to": [0, 0, 1]}):
        with pytest.raises(TypeError, match="either directions or to"):
            cylint.intersect(ROD, [0, 0, -5], **wrong)
    with pytest.raises(TypeError, match="tmin and tmax need directions"):
        cylint.intersect(ROD, [0, 0, -5], to=[0, 0, 1], tmax=1)
    with pytest.raises(ValueError, match="line 1: the direction has no length"):
        cylint.intersect(ROD, [[0, 0, -5], [0, 0, 1]], to=[0, 0, 1])
    with pytest.raises(ValueError, match="to: expected the shape"):
        cylint.intersect(ROD, [0, 0, -5], to=[0, 0])


@pytest.mark.parametrize("name", SHAPES)
def test_rays_leave_from_outside_and_from_inside(name):
    shape = SHAPES[name][0]
    o, d = drawn(2000, 14)
    hit = cylint.intersect(shape, o, d, tmin=-np.inf)
    there = hit.part >= 0
    assert np.array_equal(~there, np.isnan(hit.outside).any(-1))
    assert np.array_equal(~there, np.isnan(hit.inside).any(-1))
    assert (shape.contains(hit.point[there]) <= 0).any()
    assert (shape.contains(hit.outside[there]) == -1).all()
    assert (shape.contains(hit.inside[there]) == 1).all()
    at = hit.point[there]
    for moved in (hit.outside[there], hit.inside[there]):
        assert np.abs(moved - at).max() <= 4 * np.spacing(np.abs(at).max())
    if name in ("cylinder", "cone", "rcone", "sphere"):  # convex and closed
        n = hit.normal[there]
        out = cylint.intersect(shape, hit.outside[there], n)
        back = cylint.intersect(shape, hit.inside[there], -n)
        assert not out.n.any() and (back.n == 1).all()


def test_a_solid_thinner_than_the_steps_of_doubles_has_no_inside():
    disc = cylint.cylinder([0, 0, 1], [0, 0, np.nextafter(1, 2)], 1)
    hit = cylint.intersect(disc, [0.5, 0.25, -1], [0, 0, 1])
    assert hit.n == 2 and np.isnan(hit.inside).all()
    assert (disc.contains(hit.outside) == -1).all()


@pytest.mark.parametrize("layout", ["lines", "pairs", "shapes", "table"])
@pytest.mark.parametrize("segments", [False, True])
def test_refused_lines_have_no_relation_on_request(layout, segments):
    """In every layout of a batch; the lines beside them are as without."""
    shapes, (o, d) = forest(1200, 16), drawn(1200, 17)
    d[~np.isfinite(o + d).all(-1) | (o + d == o).all(-1)] = 1
    ends = o + d if segments else d
    bad = np.zeros(1200, bool)
    bad[[0, 5, 511, 512, 700, 1199]] = True
    spoiled = np.where(bad[:, None], [np.nan, 0, 1], ends)
    if layout == "lines":
        shapes = ROD
    elif layout == "shapes":
        o, ends, spoiled, bad = o[0], ends[0], spoiled[0], np.ones(1200, bool)
    elif layout == "table":
        shapes = shapes[:7, None]
    key = "to" if segments else "directions"
    with pytest.raises(ValueError, match=r"line( 0)?: a number is not finite"):
        cylint.intersect(shapes, o, **{key: spoiled})
    want = cylint.intersect(shapes, o, **{key: ends})
    hit = cylint.intersect(shapes, o, **{key: spoiled}, errors="mask")
    bad = np.broadcast_to(bad, hit.n.shape)
    assert np.array_equal(hit.relation, np.where(bad, -1, want.relation))
    assert np.array_equal(hit.n, np.where(bad, 0, want.n))
    pair = bad[..., None]
    assert same(hit.t, np.where(pair, np.nan, want.t))
    assert np.array_equal(hit.part, np.where(pair, -1, want.part))
    vector = pair[..., None]
    assert same(hit.point, np.where(vector, np.nan, want.point))
    assert cylint.Relation(int(hit.relation.flat[0])) == cylint.Relation.NONE


def equal(a, b):
    return (
        np.array_equal(a.relation, b.relation)
        and np.array_equal(a.n, b.n)
        and np.array_equal(a.part, b.part)
        and same(a.t, b.t)
    )


def test_a_table_equals_its_rows_and_columns():
    shapes, (o, d) = forest(700, 12), drawn(600, 13)
    o, d = o * 0.1 + 0.5, d
    table = cylint.intersect(shapes[:, None], o, d)
    assert table.t.shape == (700, 600, 2) and table.n.max() == 2
    for i in range(0, 700, 50):
        assert same(table.t[i], cylint.intersect(shapes[i], o, d).t)
    for j in range(0, 600, 50):
        column = cylint.intersect(shapes, o[j], d[j])
        assert same(table.t[:, j], column.t)
        assert np.array_equal(table.part[:, j], column.part)
    across = cylint.intersect(shapes, o[:, None], d[:, None])
    assert same(np.swapaxes(across.t, 0, 1), table.t)
    assert np.array_equal(across.relation.T, table.relation)
    pairs = cylint.intersect(shapes[:600], o, d)
    assert same(pairs.t, table.t[np.arange(600), np.arange(600)])
    few = cylint.intersect(shapes[:3, None, None], o[None, :, None], d[5])
    assert few.t.shape == (3, 600, 1, 2)


def test_lazy_members_follow_the_layout():
    shapes, (o, d) = forest(40, 14), drawn(50, 15)
    o = o * 0.1 + 0.5
    table = cylint.intersect(shapes[:, None], o, d)
    one = cylint.intersect(shapes[7], o, d)
    for member in MEMBERS:
        assert np.array_equal(
            getattr(table, member)[7], getattr(one, member), equal_nan=True
        )
    assert table.point.shape == (40, 50, 2, 3) and table.z.shape == (40, 50, 2)
    assert table.point is table.point


number = st.floats(allow_nan=False, allow_infinity=False, width=64)
small = st.integers(-3, 3).map(float)
vectors = arrays(np.float64, (5, 3), elements=st.one_of(small, small, number))
bounds_of_t = st.one_of(small, st.just(-np.inf), st.just(np.inf), number)


@given(vectors, vectors, bounds_of_t, bounds_of_t)
def test_batches_equal_single_questions(o, d, tmin, tmax):
    """All layouts of any five good lines, one by one and together."""
    tmin, tmax = min(tmin, tmax), max(tmin, tmax)
    good = d.any(axis=1)
    o, d = o[good], d[good]
    for shape, _ in SHAPES.values():
        whole = cylint.intersect(shape, o, d, tmin, tmax)
        many = cylint.intersect(
            shape[None].reshape(1, 1), o, d[None], tmin, tmax
        )
        assert same(whole.t, many.t[0])
        pairs = cylint.intersect(
            cylint.concatenate([shape] * len(o)), o, d, tmin, tmax
        )
        assert equal(whole, pairs)
        for i in range(len(o)):
            one = cylint.intersect(shape, o[i], d[i], tmin, tmax)
            assert one.n == whole.n[i] and same(one.t, whole.t[i])
            alone = cylint.intersect(shape[None], o[i], d[i], tmin, tmax)
            assert one.relation == whole.relation[i] == alone.relation[0]
            assert same(alone.t[0], one.t)


@given(vectors, vectors)
def test_hits_lie_in_order_and_in_the_domain(o, d):
    good = d.any(axis=1)
    for shape, _ in SHAPES.values():
        hit = cylint.intersect(shape, o[good], d[good])
        t = hit.t
        assert np.array_equal(hit.n, (~np.isnan(t)).sum(axis=1))
        assert np.array_equal(hit.part >= 0, ~np.isnan(t))
        assert (t[hit.n == 2, 0] <= t[hit.n == 2, 1]).all()
        assert (t[~np.isnan(t)] >= 0).all()
        assert (hit.n[hit.relation == 0] == 0).all()
        assert not np.signbit(t[t == 0]).any()


@given(vectors, vectors, st.integers(1, 7), st.integers(0, 6))
def test_strides_and_types_make_no_difference(o, d, step, offset):
    good = d.any(axis=1)
    good[0] = True
    d[0] = 1
    o, d = o[good], d[good]
    want = cylint.intersect(ROD, o, d)
    spread = np.full((len(o) * step + offset, 9), np.nan)
    spread[offset::step, 1:6:2] = o
    assert equal(want, cylint.intersect(ROD, spread[offset::step, 1:6:2], d))
    assert equal(want, cylint.intersect(ROD, np.asfortranarray(o), d.tolist()))
    packed = np.zeros(len(o), dtype=[("tag", "i1"), ("o", "f8", 3)])
    packed["o"] = o
    assert equal(want, cylint.intersect(ROD, packed["o"], d))
    swapped = o.astype(">f8")
    assert equal(want, cylint.intersect(ROD, swapped, d))


def test_integers_and_singles_are_converted():
    hit = cylint.intersect(ROD, np.array([0, 0, -5]), np.float32([0, 0, 1]))
    assert hit.t.tolist() == [5, 6]


def test_tmin_and_tmax_bound_the_hits():
    hit = cylint.intersect(
        ROD, [0, 0, -5], [0, 0, 1], [0, 5.5, -9], [[9], [5.5]]
    )
    assert hit.n.tolist() == [[2, 1, 2], [1, 0, 1]]
    whole = cylint.intersect(ROD, [0, 0, 5], [0, 0, 1], -np.inf)
    assert whole.t.tolist() == [-5, -4]


@pytest.mark.parametrize("wrong", [np.nan, np.inf])
@pytest.mark.parametrize("row", [0, 1, 513, 2999])
def test_the_first_bad_line_is_named(row, wrong):
    o, d = drawn(3000, 16)
    o[row, 1] = wrong
    o[-1, 2] = wrong
    with pytest.raises(
        ValueError, match=rf"^line {row}: a number is not finite$"
    ):
        cylint.intersect(ROD, o, d)
    with pytest.raises(ValueError, match=rf"^line {row}: a number"):
        cylint.Scene(ROD).nearest(o, d)
    with pytest.raises(ValueError, match=rf"^line {row}: a number"):
        cylint.Scene(ROD).all(o, d)


def test_bad_lines_are_named_in_their_own_shape():
    d = np.ones((4, 5, 3))
    d[2, 3] = 0
    shapes = forest(6, 17)[:, None, None]
    with pytest.raises(
        ValueError, match=r"^line \(2, 3\): the direction has no len"
    ):
        cylint.intersect(shapes, [0, 0, 0], d)
    with pytest.raises(ValueError, match=r"^line 1: the domain is empty"):
        cylint.intersect(ROD, [0, 0, 0], [0, 0, 1], 0, [1, -1])
    with pytest.raises(
        ValueError, match=r"^line: the domain is empty or not a numb"
    ):
        cylint.intersect(ROD, [0, 0, 0], [0, 0, 1], np.nan)


def test_arrays_that_do_not_fit_are_named():
    with pytest.raises(
        ValueError, match=r"origins: expected the shape \(\.\.\., 3\)"
    ):
        cylint.intersect(ROD, [0, 0], [0, 0, 1])
    with pytest.raises(ValueError, match=r"origins \(2,\), directions \(4,\)"):
        cylint.intersect(ROD, np.zeros((2, 3)), np.ones((4, 3)))
    with pytest.raises(ValueError, match=r"shapes \(3,\), lines \(2,\)"):
        cylint.intersect(forest(4, 1)[:3], np.zeros((2, 3)), [0, 0, 1])


def test_empty_arrays():
    none = np.empty((0, 3))
    hit = cylint.intersect(ROD, none, none)
    assert hit.t.shape == (0, 2) and hit.point.shape == (0, 2, 3)
    assert cylint.intersect(forest(8, 1)[:0], [0, 0, 0], [0, 0, 1]).n.shape == (
        0,
    )
    assert cylint.intersect(forest(8, 1)[:, None], none, [0, 0, 1]).n.shape == (
        8,
        0,
    )
