"""Distances: equal to the command, of one shape and of scenes; messages."""

import numpy as np
import pytest
from conftest import (
    ROD, SHAPES, TEXTS, forest, records, refused, same,
)

import libcylint as cylint

NOWHERE = cylint.round_cone([0, 0, 0], 5, [0, 0, 1], 1, ends="cap1")


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


def test_on_surface_counts_units_in_the_last_place():
    ball = cylint.sphere([0, 0, 0], 1)
    points = (1 + np.arange(-2, 4) * 2.0**-52)[:, None] * [1, 0, 0]
    assert ball.on_surface(points).tolist() == [0, 0, 1, 0, 0, 0]
    # below 1 the unit is half as large
    assert ball.on_surface(points, 1).tolist() == [0, 0, 1, 1, 0, 0]
    assert ball.on_surface(points, 2).tolist() == [0, 1, 1, 1, 1, 0]
    assert not ball.on_surface(points, -1).any() and not ball.on_surface(points, np.nan).any()
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
    assert scene.within_count(points, np.inf).tolist() == scene.contains(points).tolist() == [1, 0, 0]


def test_a_shape_without_a_surface_has_no_distance():
    near = NOWHERE.closest([9, 0, 0])
    assert near.distance == np.inf and near.part == near.feature == -1
    assert np.isnan(near.point).all() and NOWHERE.safety([9, 0, 0]) == np.inf
    scene = cylint.Scene(cylint.concatenate([NOWHERE, ROD]))
    assert scene.closest([0, 0, 9]).index == 1
    assert scene.within([0, 0, 9], np.inf).index.tolist() == [1]


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
        (ValueError, "ulps: expected one number", lambda: ROD.on_surface(two, three)),
        (TypeError, "ulps: .*None", lambda: ROD.on_surface(two, None)),
        (ValueError, r"points \(2,\), r \(3,\)", lambda: scene.closest(two, r=three)),
        (ValueError, r"points \(2,\), r \(3,\)", lambda: scene.within(two, three)),
        (TypeError, "r: expected real numbers", lambda: scene.closest([0, 0, 0], "far")),
        (TypeError, "r: .*None", lambda: scene.closest([0, 0, 0], None)),
        (TypeError, "points: .*None", lambda: ROD.distance([0, None, 0])),
        (ValueError, "threads: expected at least 1", lambda: scene.within_count(two, 1, threads=0)),
    ):
        with refused(message, error):
            call()


# ------------------------------------------------------------------ scenes --


@pytest.mark.parametrize("signed", [False, np.True_])
def test_20000_points_equal_the_command(command, tmp_path, signed):
    random, path, radius = np.random.default_rng(57), tmp_path / "scene", 0.03
    shapes, points = forest(200, 57), random.random((20_000, 3))
    cylint.write_scene(path, shapes)
    scene = cylint.Scene(shapes)
    near = scene.closest(points, signed=signed)
    every = scene.within(points, radius, signed=signed)
    text, options = records("point", points), ["-s", path] + ["--signed"] * int(signed)
    command(
        text, *options, shape=near.index + 1, part=near.part, feature=near.feature,
        distance=near.distance, x_y_z=near.point, nx_ny_nz=near.normal,
    )  # fmt: skip
    options += ["--within", radius]
    near = scene.closest(points, r=radius, signed=signed)
    command(text, *options, shape=near.index + 1, distance=near.distance, x_y_z=near.point)
    assert 1000 < np.count_nonzero(near.index < 0) < 19_000
    assert 1000 < len(every.point)
    command(
        text, *options, "-q", "all",
        record=every.point + 1, shape=every.index + 1, distance=every.distance,
    )  # fmt: skip
    counts = scene.within_count(points, radius, signed=signed)
    command(text, *options, "-q", "count", count=counts)
    command(text, *options, "-q", "any", any=counts > 0)
    held = (shapes[:, None].contains(points) >= 0).sum(axis=0)
    assert same(scene.contains(points), held) and held.max() > 1
