"""Distances: equal to the command, to brute force, for every layout."""

import numpy as np
import pytest
from conftest import forest, hexadecimal, numbers, same, text_of, written_rods
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

import libcylint as cylint

ROD = cylint.cylinder([0, 0, 0], [0, 0, 1], 0.5)
PARTS = {"-": -1, "lateral": 0, "cap0": 1, "cap1": 2}
FEATURES = {**PARTS, "rim0": 3, "rim1": 4, "apex": 5}
CONE = ([0, 0, -1], 1, [0.25, 0, 1], 0.25)
ELLIPTIC = ([0, 0, -1], [1, 0, 0], [0, 0.5, 0], [0.5, 0, 2])
SHAPES = {
    "cylinder": (ROD, "cylinder 0 0 0 0 0 1 .5"),
    "open": (
        cylint.cylinder([0, 0, 0], [0, 0, 1], 0.5, ends="open"),
        "cylinder 0 0 0 0 0 1 .5 ends=open",
    ),
    "infinite": (
        cylint.cylinder([0, 0, 0], [1, 2, 3], 0.5, ends="infinite"),
        "cylinder 0 0 0 1 2 3 .5 ends=infinite",
    ),
    "cone": (cylint.cone(*CONE), "cone 0 0 -1 1 .25 0 1 .25"),
    "pointed": (cylint.cone(*CONE[:3], 0), "cone 0 0 -1 1 .25 0 1 0"),
    "nappe": (
        cylint.cone(*CONE, ends="nappe"),
        "cone 0 0 -1 1 .25 0 1 .25 ends=nappe",
    ),
    "double": (
        cylint.angle_cone([0, 0, 0], [0, 0, 1], 40),
        "acone 0 0 0 0 0 1 40",
    ),
    "econe": (
        cylint.elliptic_cone(*ELLIPTIC, 0.5, ends="cap0"),
        "econe 0 0 -1 1 0 0 0 .5 0 .5 0 2 .5 ends=cap0",
    ),
    "rcone": (cylint.round_cone(*CONE), "rcone 0 0 -1 1 .25 0 1 .25"),
    "capsule": (
        cylint.capsule([0, 0, -1], [0, 0, 1], 0.5, ends="open"),
        "capsule 0 0 -1 0 0 1 .5 ends=open",
    ),
    "sphere": (cylint.sphere([0, 0, 0], 0.5), "sphere 0 0 0 .5"),
}
NOWHERE = cylint.round_cone([0, 0, 0], 5, [0, 0, 1], 1, ends="cap1")
WITHOUT_INSIDE = ("open", "econe", "capsule")


def scattered(n, seed):
    """n points near the unit ball, some of them hard."""
    random = np.random.default_rng(seed)
    points = random.normal(size=(n, 3))
    kind = random.integers(0, 6, n)
    points[kind == 1] *= 10.0 ** random.uniform(3, 20, ((kind == 1).sum(), 1))
    points[kind == 2, :2] = 0
    points[kind == 3] = np.round(points[kind == 3] * 2) / 4
    near = kind == 4
    length = np.linalg.norm(points[near, :2], axis=1, keepdims=True)
    points[near, :2] *= 0.5 / length
    return points


@pytest.mark.parametrize("name", SHAPES)
def test_every_member_equals_the_command(command, name):
    shape, text = SHAPES[name]
    points = scattered(1000 if name != "econe" else 200, 51)
    near = shape.closest(points)
    fields = command(
        text_of(
            ["point"] * len(points), hexadecimal(points), [text] * len(points)
        ),
        "-f",
        "part,feature,distance,x,y,z,nx,ny,nz",
    )
    assert [PARTS[f[0]] for f in fields] == near.part.tolist()
    assert [FEATURES[f[1]] for f in fields] == near.feature.tolist()
    value = numbers([f[2:] for f in fields])
    assert same(value[:, 0], near.distance)
    assert same(value[:, 1:4], near.point)
    assert same(value[:, 4:7], near.normal)
    assert same(near.distance, shape.distance(points))
    assert near.distance.dtype == np.float64 and near.feature.dtype == np.int8


@pytest.mark.parametrize("name", SHAPES)
def test_the_sign_is_that_of_contains(name):
    shape, _ = SHAPES[name]
    points = scattered(300 if name == "econe" else 2000, 52)
    distance, side = shape.distance(points), shape.contains(points)
    if name in WITHOUT_INSIDE:
        assert not np.signbit(distance).any()
    else:
        assert np.array_equal(np.sign(distance), -side)
        assert (side == 1).any() and (side == -1).any()
    assert np.array_equal(shape.on_surface(points), distance == 0)


@pytest.mark.parametrize("name", SHAPES)
def test_safety_is_not_above_the_distance(name):
    shape, _ = SHAPES[name]
    points = scattered(300 if name == "econe" else 2000, 53)
    safety, distance = shape.safety(points), abs(shape.distance(points))
    assert (safety >= 0).all() and (safety <= distance).all()
    ordinary = (distance > 0.1) & (distance < 100)
    if name != "econe":
        assert (safety[ordinary] > 0.999 * distance[ordinary]).all()


def test_batches_of_every_layout_equal_single_questions():
    """contains, safety and on_surface; more elements than a block has."""
    kinds = cylint.concatenate([SHAPES[name][0] for name in SHAPES])
    n = 77 * kinds.size
    which = np.arange(n) % kinds.size
    shapes, points = kinds[which], scattered(n, 55)
    points[::9] = shapes[::9].closest(points[::9]).point
    points[5] = np.nan
    ulps = np.where(which % 2, 1.0, 8.0)

    def ask(shapes, points, ulps):
        return (
            shapes.contains(points),
            shapes.safety(points),
            shapes.on_surface(points, ulps),
            shapes.on_surface(points, 8),
        )

    want = [
        np.array(column)
        for column in zip(
            *(ask(s, p, u) for s, p, u in zip(shapes, points, ulps))
        )
    ]
    assert set(want[0]) == {-1, 0, 1} and 0 < want[2].sum() < want[3].sum()

    def check(found, rows):
        for f, w in zip(found, want):
            assert f.dtype == w.dtype and np.array_equal(f, w[rows])

    check(ask(shapes, points, ulps), slice(None))
    check(ask(shapes[::-3], points[::-3], ulps[::-3]), slice(None, None, -3))
    check(ask(shapes, np.asfortranarray(points), ulps), slice(None))
    for kind in range(kinds.size):
        rows = which == kind
        check(ask(kinds[kind], points[rows], ulps[kind]), rows)
        check(ask(kinds[kind], points[rows], ulps[rows]), rows)


def test_the_closest_point_is_on_the_surface_at_that_distance():
    points = scattered(2000, 54)
    near = SHAPES["cone"][0].closest(points)
    far = np.linalg.norm(near.point - points, axis=1)
    assert np.allclose(far, abs(near.distance), rtol=1e-12, atol=1e-15)
    assert SHAPES["cone"][0].on_surface(near.point, 4).mean() > 0.9
    lengths = np.linalg.norm(near.normal, axis=1)
    assert np.allclose(lengths, 1, rtol=1e-15)


def test_on_surface_counts_units_in_the_last_place():
    ball = cylint.sphere([0, 0, 0], 1)
    x = 1 + np.arange(-2, 4) * 2.0**-52
    points = x[:, None] * [1, 0, 0]
    assert ball.on_surface(points).tolist() == [0, 0, 1, 0, 0, 0]
    assert ball.on_surface(points, [[1], [2]]).tolist() == [
        [0, 0, 1, 1, 0, 0],  # below 1 the unit is half as large
        [0, 1, 1, 1, 1, 0],
    ]
    assert not ball.on_surface(points, [-1, np.nan] * 3).any()
    assert ball.on_surface([1, 0, 0]).shape == ()


def test_points_that_are_not_finite_have_no_distance():
    points = np.array([[0.25, 0, 0.5], [np.nan, 0, 0], [0, np.inf, 0]])
    near = ROD.closest(points)
    assert near.distance.tolist() == [-0.25, np.inf, np.inf]
    assert near.part.tolist() == near.feature.tolist() == [0, -1, -1]
    assert np.isnan(near.point[1:]).all() and np.isnan(near.normal[1:]).all()
    assert np.isfinite(near.point[0]).all()
    assert ROD.safety(points)[1:].tolist() == [np.inf, np.inf]
    assert ROD.on_surface(points, np.inf).tolist() == [True, False, False]
    scene = cylint.Scene(ROD)
    near = scene.closest(points)
    assert near.index.tolist() == [0, -1, -1]
    assert same(near.distance, [-0.25, np.nan, np.nan])
    assert near.part.tolist() == near.feature.tolist() == [0, -1, -1]
    assert np.isnan(near.point[1:]).all() and np.isnan(near.normal[1:]).all()
    assert scene.within(points, np.inf).point.tolist() == [0]
    assert scene.within_count(points, np.inf).tolist() == [1, 0, 0]


def test_a_shape_without_a_surface_has_no_distance():
    near = NOWHERE.closest([9, 0, 0])
    assert near.distance == np.inf and near.part == near.feature == -1
    assert np.isnan(near.point).all() and NOWHERE.safety([9, 0, 0]) == np.inf
    scene = cylint.Scene(cylint.concatenate([NOWHERE, ROD]))
    assert scene.closest([0, 0, 9]).index == 1
    assert scene.within([0, 0, 9], np.inf).index.tolist() == [1]


def test_ties_go_to_the_documented_point():
    middle = ROD.closest([0, 0, 0.5])
    assert cylint.Feature(middle.feature) == cylint.Feature.LATERAL
    assert middle.distance == -0.5
    center = cylint.sphere([1, 2, 3], 0.5).closest([1, 2, 3])
    assert center.point.tolist() == [1.5, 2, 3]
    assert center.normal.tolist() == [1, 0, 0]
    apex = cylint.cone([0, 0, 0], 1, [0, 0, 1], 0).closest([0, 0, 2])
    assert cylint.Feature(apex.feature) == cylint.Feature.APEX
    assert apex.point.tolist() == apex.normal.tolist() == [0, 0, 1]


def equal(a, b):
    return (
        same(a.distance, b.distance)
        and np.array_equal(a.part, b.part)
        and np.array_equal(a.feature, b.feature)
        and same(a.point, b.point)
        and same(a.normal, b.normal)
    )


def test_a_table_equals_its_rows_and_columns():
    """Batches of one shape, of pairs, and pairs one by one."""
    shapes, points = forest(300, 55), np.random.default_rng(56).random((260, 3))
    table = shapes[:, None].closest(points)
    assert table.distance.shape == (300, 260)
    assert table.point.shape == table.normal.shape == (300, 260, 3)
    for i in range(0, 300, 37):
        row = shapes[i].closest(points)
        assert same(table.distance[i], row.distance)
        assert same(table.point[i], row.point)
        assert np.array_equal(table.feature[i], row.feature)
    for j in range(0, 260, 51):
        column = shapes.closest(points[j])
        assert same(table.distance[:, j], column.distance)
        assert same(table.normal[:, j], column.normal)
        assert np.array_equal(table.part[:, j], column.part)
    pairs = shapes[:260].closest(points)
    assert same(pairs.distance, table.distance[np.arange(260), np.arange(260)])
    spread = shapes[259::-1].closest(points[::-1])
    assert same(spread.distance[::-1], pairs.distance)
    assert same(spread.point[::-1], pairs.point)
    across = shapes.distance(points[:, None])
    assert same(across.T, table.distance)
    assert same(shapes[:, None].safety(points)[7], shapes[7].safety(points))
    few = shapes[:3, None, None].distance(points[None, :, None])
    assert few.shape == (3, 260, 1)
    assert table.point is table.point


number = st.floats(allow_nan=False, allow_infinity=False, width=64)
small = st.integers(-3, 3).map(float)
vectors = arrays(np.float64, (5, 3), elements=st.one_of(small, small, number))
CIRCULAR = [SHAPES[name][0] for name in SHAPES if name != "econe"]


@given(vectors)
def test_batches_equal_single_questions(points):
    for shape in CIRCULAR:
        whole = shape.closest(points)
        pairs = cylint.concatenate([shape] * 5).closest(points)
        assert equal(whole, pairs)
        for i in range(5):
            one = shape.closest(points[i])
            assert same(one.distance, whole.distance[i])
            assert same(one.point, whole.point[i])
            assert one.feature == whole.feature[i]


@given(vectors, st.integers(1, 7), st.integers(0, 6))
def test_strides_and_types_make_no_difference(points, step, offset):
    want = ROD.closest(points)
    spread = np.full((5 * step + offset, 9), np.nan)
    spread[offset::step, 1:6:2] = points
    assert equal(want, ROD.closest(spread[offset::step, 1:6:2]))
    assert equal(want, ROD.closest(np.asfortranarray(points)))
    assert equal(want, ROD.closest(points.astype(">f8")))
    assert equal(want, ROD.closest(points.tolist()))
    packed = np.zeros(5, dtype=[("tag", "i1"), ("x", "f8", 3)])
    packed["x"] = points
    assert equal(want, ROD.closest(packed["x"]))


def test_empty_arrays():
    none = np.empty((0, 3))
    near = ROD.closest(none)
    assert near.distance.shape == (0,) and near.point.shape == (0, 3)
    assert forest(5, 1)[:0].distance([0, 0, 0]).shape == (0,)
    assert forest(5, 1)[:, None].safety(none).shape == (5, 0)
    scene = cylint.Scene(forest(5, 1)[:0])
    assert scene.closest([0, 0, 0]).index == -1
    assert scene.within_count([[0, 0, 0]], 1).tolist() == [0]
    assert len(scene.within(none, 1).point) == 0
    assert cylint.Scene(ROD).closest(none).point.shape == (0, 3)


def test_arguments_that_do_not_fit_are_named():
    scene = cylint.Scene(ROD)
    for call in (ROD.distance, ROD.closest, ROD.safety, ROD.on_surface):
        with pytest.raises(ValueError, match="points: expected the shape"):
            call([0, 0])
        with pytest.raises(TypeError, match="points: expected real numbers"):
            call(["a", "b", "c"])
        with pytest.raises(TypeError, match="argument: 'points'"):
            call()
    with pytest.raises(ValueError, match=r"shapes \(3,\), points \(2,\)"):
        forest(5, 1)[:3].distance(np.zeros((2, 3)))
    with pytest.raises(ValueError, match=r"points \(2,\), ulps \(3,\)"):
        ROD.on_surface(np.zeros((2, 3)), [1, 2, 3])
    with pytest.raises(ValueError, match=r"points \(2,\), within \(3,\)"):
        scene.closest(np.zeros((2, 3)), within=[1, 2, 3])
    with pytest.raises(ValueError, match=r"points \(2,\), r \(3,\)"):
        scene.within(np.zeros((2, 3)), [1, 2, 3])
    with pytest.raises(TypeError, match="argument: 'r'"):
        scene.within([0, 0, 0])
    with pytest.raises(TypeError, match="within: expected real numbers"):
        scene.closest([0, 0, 0], "far")
    with pytest.raises(ValueError, match="threads: expected at least 1"):
        scene.within_count([0, 0, 0], 1, threads=0)


# ------------------------------------------------------------------ scenes --


@given(
    st.integers(0, 2**32),
    st.integers(1, 60),
    st.integers(0, 20),
    st.floats(0, 0.5),
)
def test_a_scene_equals_brute_force(seed, n, count, radius):
    shapes = forest(n, seed)
    points = np.random.default_rng(seed).uniform(-0.5, 1.5, (count, 3))
    scene = cylint.Scene(shapes)
    signed = shapes[:, None].distance(points)
    size = abs(signed)
    first = size.argmin(axis=0) if count else np.empty(0, int)
    column = np.arange(count)
    near = scene.closest(points)
    assert np.array_equal(near.index, first)
    assert same(near.distance, signed[first, column])
    assert equal(near, shapes[first].closest(points))
    near = scene.closest(points, within=radius)
    found = size[first, column] <= radius
    assert np.array_equal(near.index, np.where(found, first, -1))
    assert np.isnan(near.distance[~found]).all()
    assert np.isnan(near.point[~found]).all()
    assert (near.feature[~found] == -1).all()
    point, index = np.nonzero((size <= radius).T)
    every = scene.within(points, radius)
    assert np.array_equal(every.point, point)
    assert np.array_equal(every.index, index)
    assert same(every.distance, signed[index, point])
    assert np.array_equal(
        scene.within_count(points, radius), (size <= radius).sum(axis=0)
    )


def test_signed_distances_are_those_of_closed_solids():
    random = np.random.default_rng(77)
    n, count = 120, 3000
    p0 = random.random((n, 3))
    p1 = p0 + random.normal(0, 0.2, (n, 3))
    ends = random.choice(["capped", "open", "cap0", "cap1"], n)
    radius = random.uniform(0.02, 0.1, n)
    tubes = cylint.cylinder(p0, p1, radius, ends=ends)
    solids = cylint.cylinder(p0, p1, radius)
    points = random.random((count, 3))
    size = solids[:, None].distance(points)
    first = size.argmin(axis=0)
    column = np.arange(count)
    scene = cylint.Scene(tubes)
    near = scene.closest(points, signed=True)
    assert np.array_equal(near.index, first)
    assert same(near.distance, size[first, column])
    assert same(near.point, solids[first].closest(points).point)
    assert np.array_equal(scene.contains(points), (size <= 0).sum(axis=0))
    assert 100 < (scene.contains(points) > 1).sum()
    for r in (-0.03, 0.0, 0.05):
        counts = scene.within_count(points, r, signed=True)
        assert np.array_equal(counts, (size <= r).sum(axis=0))
        every = scene.within(points, r, signed=True)
        assert same(every.distance, size[every.index, every.point])
        assert len(every.index) == counts.sum()
    assert scene.contains([[np.nan, 0, 0], [0, np.inf, 0]]).tolist() == [0, 0]


def test_20000_points_equal_the_command(command, tmp_path):
    n, count, radius = 500, 20_000, 0.03
    random = np.random.default_rng(57)
    path = tmp_path / "scene"
    rods = written_rods(n, random, path)
    points = random.random((count, 3))
    text = text_of(["point"] * count, hexadecimal(points))
    scene = cylint.Scene(rods)
    near = scene.closest(points)
    fields = command(
        text, "-s", str(path), "-f", "shape,part,feature,distance,x,y,z"
    )
    assert np.array_equal([int(f[0]) - 1 for f in fields], near.index)
    assert [PARTS[f[1]] for f in fields] == near.part.tolist()
    assert [FEATURES[f[2]] for f in fields] == near.feature.tolist()
    value = numbers([f[3:] for f in fields])
    assert same(value[:, 0], near.distance) and same(value[:, 1:], near.point)
    fields = command(
        text, "-s", str(path), "--within", str(radius), "-q", "all", "-f",
        "record,shape,distance",
    )  # fmt: skip
    every = scene.within(points, radius)
    assert 1000 < len(every.point)
    assert [int(f[0]) - 1 for f in fields] == every.point.tolist()
    assert [int(f[1]) - 1 for f in fields] == every.index.tolist()
    assert same(numbers([f[2:] for f in fields])[:, 0], every.distance)


def test_points_and_radii_of_several_axes():
    shapes = forest(200, 58)
    scene = cylint.Scene(shapes)
    points = np.random.default_rng(59).random((4, 15, 3))
    radii = np.array([0.05, 0.1, 0.2, 0.4])[:, None]
    table = scene.closest(points, within=radii)
    assert table.index.shape == (4, 15) and table.point.shape == (4, 15, 3)
    counts = scene.within_count(points, radii)
    every = scene.within(points, radii)
    assert np.array_equal(
        np.bincount(every.point, minlength=60).reshape(4, 15), counts
    )
    for i in range(4):
        row = scene.closest(points[i], float(radii[i, 0]))
        assert np.array_equal(row.index, table.index[i])
        assert same(row.point, table.point[i])
        assert np.array_equal(
            scene.within_count(points[i], radii[i]), counts[i]
        )
    one = scene.within(points[2, 7], 0.2)
    assert np.array_equal(one.index, every.index[every.point == 2 * 15 + 7])
    spread = scene.within_count(points[0, 0], radii)
    assert spread.shape == (4, 1)


def test_equal_distances_go_to_the_lower_number():
    scene = cylint.Scene(cylint.concatenate([ROD] * 20))
    assert scene.closest([5, 0, 0.5]).index == 0
    assert scene.within([5, 0, 0.5], 4.5).index.tolist() == list(range(20))
    assert scene.within_count([5, 0, 0.5], np.nextafter(4.5, 0)) == 0


def test_more_shapes_near_a_point_than_a_buffer_holds():
    x = np.arange(1000.0)
    p0 = np.c_[x, 0 * x, 0 * x]
    scene = cylint.Scene(cylint.cylinder(p0, p0 + [0, 0, 1], 0.25))
    every = scene.within([[-1, 0, 0.5], [-1, 0, 0.5]], [[600], [2000]])
    assert every.point.tolist()[:3] == [0, 0, 0]
    assert np.array_equal(every.index[every.point == 0], np.arange(600))
    assert np.array_equal(every.distance[every.point == 3], x + 0.75)


def test_no_shape_is_within_a_radius_that_is_no_length():
    scene = cylint.Scene(ROD)
    for radius in (-1.0, np.nan):
        assert scene.closest([0.5, 0, 0.5], within=radius).index == -1
        assert len(scene.within([0.5, 0, 0.5], radius).index) == 0
        assert scene.within_count([0.5, 0, 0.5], radius) == 0
    assert scene.closest([0.5, 0, 0.5], within=0).index == 0
