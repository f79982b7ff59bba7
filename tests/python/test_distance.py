"""Distances: equal to the command, to brute force, for every layout."""

import numpy as np
import pytest
from conftest import (
    ROD, SHAPES, TEXTS, equal, forest, records, refused, rods_in_a_file, same, vectors,
)
from hypothesis import given
from hypothesis import strategies as st

import libcylint as cylint

ANSWER = ("distance", "part", "feature", "point", "normal")
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
    points[near, :2] *= 0.5 / np.linalg.norm(points[near, :2], axis=1, keepdims=True)
    return points


@pytest.mark.parametrize("name", SHAPES)
def test_every_member_equals_the_command(command, name):
    points = scattered(200 if name == "econe" else 1000, 51)
    near = SHAPES[name].closest(points)
    command(
        records("point", points, TEXTS[name]), part=near.part, feature=near.feature,
        distance=near.distance, x_y_z=near.point, nx_ny_nz=near.normal,
    )  # fmt: skip
    assert same(near.distance, SHAPES[name].distance(points))
    assert near.distance.dtype == np.float64 and near.feature.dtype == np.int8


@pytest.mark.parametrize("name", SHAPES)
def test_the_sign_is_that_of_contains_and_safety_is_not_above(name):
    shape, points = SHAPES[name], scattered(300 if name == "econe" else 2000, 52)
    distance, side = shape.distance(points), shape.contains(points)
    if name in WITHOUT_INSIDE:
        assert not np.signbit(distance).any()
    else:
        assert np.array_equal(np.sign(distance), -side)
        assert (side == 1).any() and (side == -1).any()
    assert same(shape.on_surface(points), distance == 0)
    safety, size = shape.safety(points), abs(distance)
    assert (safety >= 0).all() and (safety <= size).all()
    ordinary = (size > 0.1) & (size < 100)
    if name != "econe":
        assert (safety[ordinary] > 0.999 * size[ordinary]).all()


def test_batches_of_every_layout_equal_single_questions():
    """contains, safety and on_surface; more elements than a block has."""
    kinds = cylint.concatenate(SHAPES.values())
    n = 77 * kinds.size
    which = np.arange(n) % kinds.size
    shapes, points = kinds[which], scattered(n, 55)
    points[::9] = shapes[::9].closest(points[::9]).point
    points[5] = np.nan
    ulps = np.where(which % 2, 0.25, 8.0)

    def ask(shapes, points, ulps):
        return (
            shapes.contains(points), shapes.safety(points), shapes.on_surface(points, ulps),
            shapes.on_surface(points, 8),
        )  # fmt: skip

    singly = (ask(*one) for one in zip(shapes, points, ulps, strict=True))
    want = [np.array(column) for column in zip(*singly, strict=True)]
    assert set(want[0]) == {-1, 0, 1} and 0 < want[2].sum() < want[3].sum()
    whole = slice(None)
    back = slice(None, None, -3)
    asked = [
        (whole, shapes, points, ulps), (back, shapes[back], points[back], ulps[back]),
        (whole, shapes, np.asfortranarray(points), ulps),
    ]  # fmt: skip
    for kind in range(kinds.size):
        rows = which == kind
        asked += [(rows, kinds[kind], points[rows], u) for u in (ulps[kind], ulps[rows])]
    for rows, *given_arrays in asked:
        for found, column in zip(ask(*given_arrays), want, strict=True):
            assert found.dtype == column.dtype and same(found, column[rows])


def test_on_surface_counts_units_in_the_last_place():
    ball = cylint.sphere([0, 0, 0], 1)
    points = (1 + np.arange(-2, 4) * 2.0**-52)[:, None] * [1, 0, 0]
    assert ball.on_surface(points).tolist() == [0, 0, 1, 0, 0, 0]
    assert ball.on_surface(points, [[1], [2]]).tolist() == [
        [0, 0, 1, 1, 0, 0],  # below 1 the unit is half as large
        [0, 1, 1, 1, 1, 0],
    ]
    assert not ball.on_surface(points, [-1, np.nan] * 3).any()
    assert ball.on_surface([1, 0, 0]).shape == ()


def test_points_that_are_not_finite_have_no_distance():
    points = np.array([[0.25, 0, 0.5], [np.nan, 0, 0], [0, np.inf, 0]])
    scene = cylint.Scene(ROD)
    for near, none in ((ROD.closest(points), np.inf), (scene.closest(points), np.nan)):
        assert same(near.distance, [-0.25, none, none])
        assert near.part.tolist() == near.feature.tolist() == [0, -1, -1]
        assert np.isnan(near.point[1:]).all() and np.isnan(near.normal[1:]).all()
        assert np.isfinite(near.point[0]).all()
    assert near.index.tolist() == [0, -1, -1]
    assert ROD.safety(points)[1:].tolist() == [np.inf, np.inf]
    assert ROD.on_surface(points, np.inf).tolist() == [True, False, False]
    assert scene.within(points, np.inf).point.tolist() == [0]
    assert scene.within_count(points, np.inf).tolist() == [1, 0, 0]


def test_a_shape_without_a_surface_has_no_distance():
    near = NOWHERE.closest([9, 0, 0])
    assert near.distance == np.inf and near.part == near.feature == -1
    assert np.isnan(near.point).all() and NOWHERE.safety([9, 0, 0]) == np.inf
    scene = cylint.Scene(cylint.concatenate([NOWHERE, ROD]))
    assert scene.closest([0, 0, 9]).index == 1
    assert scene.within([0, 0, 9], np.inf).index.tolist() == [1]


def test_a_table_equals_its_rows_and_columns():
    """Batches of one shape, of pairs, and pairs one by one."""
    shapes, points = forest(300, 55), np.random.default_rng(56).random((260, 3))
    table, all_ = shapes[:, None].closest(points), np.arange(260)
    assert table.distance.shape == (300, 260)
    assert table.point.shape == table.normal.shape == (300, 260, 3)
    for i in range(0, 300, 37):
        row = shapes[i].closest(points)
        for member in ("distance", "point", "feature"):
            assert same(getattr(table, member)[i], getattr(row, member))
    for j in range(0, 260, 51):
        column = shapes.closest(points[j])
        for member in ("distance", "normal", "part"):
            assert same(getattr(table, member)[:, j], getattr(column, member))
    pairs = shapes[:260].closest(points)
    assert same(pairs.distance, table.distance[all_, all_])
    for i in range(0, 260, 20):
        assert same(shapes[i].closest(points[i]).point, pairs.point[i])
    spread = shapes[259::-1].closest(points[::-1])
    assert same(spread.distance[::-1], pairs.distance) and same(spread.point[::-1], pairs.point)
    assert same(shapes[:260:2].distance(points[::2]), pairs.distance[::2])
    assert same(shapes.distance(points[:, None]).T, table.distance)
    assert same(shapes[:, None].safety(points)[7], shapes[7].safety(points))
    assert shapes[:3, None, None].distance(points[None, :, None]).shape == (3, 260, 1)
    assert table.point is table.point


@given(vectors, st.integers(1, 7), st.integers(0, 6))
def test_strides_and_types_make_no_difference(points, step, offset):
    want = ROD.closest(points)
    spread = np.full((5 * step + offset, 9), np.nan)
    spread[offset::step, 1:6:2] = points
    packed = np.zeros(5, dtype=[("tag", "i1"), ("x", "f8", 3)])
    packed["x"] = points
    for again in (
        spread[offset::step, 1:6:2], np.asfortranarray(points), points.astype(">f8"),
        points.tolist(), packed["x"],
    ):  # fmt: skip
        assert equal(want, ROD.closest(again), *ANSWER)


def test_empty_arrays():
    none, nothing = np.empty((0, 3)), forest(5, 1)[:0]
    near = ROD.closest(none)
    assert near.distance.shape == (0,) and near.point.shape == (0, 3)
    assert nothing.distance([0, 0, 0]).shape == (0,)
    assert forest(5, 1)[:, None].safety(none).shape == (5, 0)
    scene = cylint.Scene(nothing)
    assert scene.closest([0, 0, 0]).index == -1
    assert scene.within_count([[0, 0, 0]], 1).tolist() == [0]
    assert len(scene.within(none, 1).point) == 0
    assert cylint.Scene(ROD).closest(none).point.shape == (0, 3)


def test_arguments_that_do_not_fit_are_named():
    scene, two, three = cylint.Scene(ROD), np.zeros((2, 3)), [1, 2, 3]
    for call in (ROD.distance, ROD.closest, ROD.safety, ROD.on_surface):
        for error, message, *points in (
            (ValueError, "points: expected the shape", [0, 0]),
            (TypeError, "points: expected real numbers", ["a", "b", "c"]),
            (TypeError, "argument: 'points'"),
        ):
            with refused(message, error):
                call(*points)
    for error, message, call in (
        (ValueError, r"shapes \(3,\), points \(2,\)", lambda: forest(5, 1)[:3].distance(two)),
        (ValueError, r"points \(2,\), ulps \(3,\)", lambda: ROD.on_surface(two, three)),
        (ValueError, r"points \(2,\), within \(3,\)", lambda: scene.closest(two, within=three)),
        (ValueError, r"points \(2,\), r \(3,\)", lambda: scene.within(two, three)),
        (TypeError, "argument: 'r'", lambda: scene.within([0, 0, 0])),
        (TypeError, "within: expected real numbers", lambda: scene.closest([0, 0, 0], "far")),
        (TypeError, "within: .*None", lambda: scene.closest([0, 0, 0], None)),
        (TypeError, "points: .*None", lambda: ROD.distance([0, None, 0])),
        (ValueError, "threads: expected at least 1", lambda: scene.within_count(two, 1, threads=0)),
    ):
        with refused(message, error):
            call()


# ------------------------------------------------------------------ scenes --


@given(st.integers(0, 2**32), st.integers(1, 60), st.integers(0, 20), st.floats(0, 0.5))
def test_a_scene_equals_brute_force(seed, n, count, radius):
    shapes = forest(n, seed)
    points = np.random.default_rng(seed).uniform(-0.5, 1.5, (count, 3))
    scene = cylint.Scene(shapes)
    signed = shapes[:, None].distance(points)
    size, column = abs(signed), np.arange(count)
    first = size.argmin(axis=0) if count else np.empty(0, int)
    near = scene.closest(points)
    assert same(near.index, first) and same(near.distance, signed[first, column])
    assert equal(near, shapes[first].closest(points), *ANSWER)
    near, found = scene.closest(points, within=radius), size[first, column] <= radius
    assert same(near.index, np.where(found, first, -1))
    assert np.isnan(near.distance[~found]).all() and np.isnan(near.point[~found]).all()
    assert (near.feature[~found] == -1).all()
    point, index = np.nonzero((size <= radius).T)
    every = scene.within(points, radius)
    assert same(every.point, point) and same(every.index, index)
    assert same(every.distance, signed[index, point])
    assert same(scene.within_count(points, radius), (size <= radius).sum(axis=0))


def test_a_scene_counts_the_shapes_that_hold_a_point():
    """Those whose closed solids are not farther than 0."""
    shapes, points = forest(120, 77), np.random.default_rng(78).random((3000, 3))
    points[:60] = shapes[::2].closest(points[:60]).point
    scene = cylint.Scene(shapes)
    held = scene.contains(points)
    assert same(held, (shapes[:, None].contains(points) >= 0).sum(axis=0)) and held.max() > 1
    assert same(held, scene.within_count(points, 0.0, signed=True))
    assert scene.contains([[np.nan, 0, 0], [0, np.inf, 0]]).tolist() == [0, 0]
    pipe = cylint.Scene(cylint.cylinder([0, 0, 0], [0, 0, 2], 1, ends="open"))
    assert pipe.within([0, 0, 0.25], 0, signed=True).distance.tolist() == [-0.25]
    rod = cylint.Scene(cylint.cylinder([0, 0, 0], [0, 0, 2], 1, ends="infinite"))
    assert rod.closest([3, 0, 9], signed=True).point.tolist() == [1, 0, 9]


@pytest.mark.parametrize("signed", [False, np.True_])
def test_20000_points_equal_the_command(command, tmp_path, signed):
    random, path, radius = np.random.default_rng(57), tmp_path / "scene", 0.03
    scene = cylint.Scene(rods_in_a_file(500, random, path))
    points = random.random((20_000, 3))
    near = scene.closest(points, signed=signed)
    every = scene.within(points, radius, signed=signed)
    text, options = records("point", points), ["-s", path] + ["--signed"] * int(signed)
    command(
        text, *options, shape=near.index + 1, part=near.part, feature=near.feature,
        distance=near.distance, x_y_z=near.point,
    )  # fmt: skip
    options += ["--within", radius]
    assert 1000 < len(every.point)
    command(
        text, *options, "-q", "all",
        record=every.point + 1, shape=every.index + 1, distance=every.distance,
    )  # fmt: skip
    counts = scene.within_count(points, radius, signed=signed)
    command(text, *options, "-q", "count", count=counts)
    command(text, *options, "-q", "any", any=counts > 0)


def test_points_and_radii_of_several_axes():
    scene = cylint.Scene(forest(200, 58))
    points = np.random.default_rng(59).random((4, 15, 3))
    radii = np.array([0.05, 0.1, 0.2, 0.4])[:, None]
    table = scene.closest(points, within=radii)
    assert table.index.shape == (4, 15) and table.point.shape == (4, 15, 3)
    counts, every = scene.within_count(points, radii), scene.within(points, radii)
    assert same(np.bincount(every.point, minlength=60).reshape(4, 15), counts)
    for i in range(4):
        row = scene.closest(points[i], float(radii[i, 0]))
        assert same(row.index, table.index[i]) and same(row.point, table.point[i])
        assert same(scene.within_count(points[i], radii[i]), counts[i])
    one = scene.within(points[2, 7], 0.2)
    assert same(one.index, every.index[every.point == 2 * 15 + 7])
    assert scene.within_count(points[0, 0], radii).shape == (4, 1)


@pytest.mark.parametrize("n", [511, 512, 513])
def test_each_row_has_its_answers(n):  # a block has 512 elements
    scene = cylint.Scene(forest(50, 71))
    points, radii = np.random.default_rng(72).random((n, 3)), [0.05, 0.2]
    every = scene.within(points, np.array(radii)[:, None])
    rows = [scene.within(points, r) for r in radii]
    assert same(every.index, np.concatenate([row.index for row in rows]))
    assert same(every.point, np.concatenate([i * n + row.point for i, row in enumerate(rows)]))


def test_more_shapes_near_a_point_than_a_buffer_holds():
    x = np.arange(1000.0)
    p0 = np.c_[x, 0 * x, 0 * x]
    scene = cylint.Scene(cylint.cylinder(p0, p0 + [0, 0, 1], 0.25))
    every = scene.within([[-1, 0, 0.5], [-1, 0, 0.5]], [[600], [2000]])
    assert every.point.tolist()[:3] == [0, 0, 0]
    assert same(every.index[every.point == 0], np.arange(600))
    assert same(every.distance[every.point == 3], x + 0.75)
