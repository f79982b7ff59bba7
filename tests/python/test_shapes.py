"""Shapes: constructors, indexing, boxes, points inside, pickles."""

import pickle

import numpy as np
import pytest
from conftest import forest, hexadecimal, same, text_of
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

import libcylint as cylint

UNIT = ([0, 0, 0], [0, 0, 1])


def test_arguments_broadcast():
    p1 = np.arange(1.0, 4.0)[:, None] * [0, 0, 1]
    rods = cylint.cylinder([0, 0, 0], p1, [[0.5], [1.0]])
    assert rods.shape == (2, 3)
    assert rods.ndim == 2 and rods.size == 6 and len(rods) == 2
    assert np.array_equal(rods.bounds()[1, 2], [[-1, -1, 0], [1, 1, 3]])


def test_constructors_make_their_kinds():
    made = [
        cylint.cylinder(*UNIT, 1),
        cylint.cone([0, 0, 0], 1, [0, 0, 1], 0),
        cylint.angle_cone(*UNIT, 30),
        cylint.tangent_cone(*UNIT, 0.5),
        cylint.elliptic_cylinder([0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]),
        cylint.elliptic_cone([0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], 2),
        cylint.sphere([0, 0, 0], 1),
        cylint.capsule(*UNIT, 1),
        cylint.round_cone([0, 0, 0], 0.5, [0, 0, 1], 0.25),
        cylint.round_cone([0, 0, 0], 0.5, [0, 0, 1], 2),
    ]
    kinds = [cylint.Kind(int(s.kind)).name for s in made]
    assert kinds == [
        "CYLINDER",
        "CONE",
        "ACONE",
        "ACONE",
        "ECYLINDER",
        "ECONE",
        "SPHERE",
        "CAPSULE",
        "RCONE",
        "SPHERE",
    ]
    assert cylint.Ends(int(made[2].ends)) == cylint.Ends.INFINITE


def test_ends_are_words_numbers_or_arrays():
    words = ["capped", "open", "cap0", "cap1", "infinite", "nappe"]
    rods = cylint.cylinder(*UNIT, 1, ends=words)
    assert rods.ends.tolist() == list(range(6))
    again = cylint.cylinder(*UNIT, 1, ends=list(cylint.Ends))
    assert again.ends.tolist() == list(range(6))
    with pytest.raises(ValueError, match="found 'lid'"):
        cylint.cylinder(*UNIT, 1, ends="lid")
    with pytest.raises(ValueError, match="no such ends"):
        cylint.cylinder(*UNIT, 1, ends=9)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (
            lambda: cylint.cylinder(*UNIT, [1, 1, -1]),
            "cylinder 2: a radius is neg",
        ),
        (
            lambda: cylint.cylinder(*UNIT, np.nan),
            "cylinder: a number is not finite",
        ),
        (
            lambda: cylint.cylinder([0, 0, 0], [[[0, 0, 1]], [[0, 0, 0]]], 1),
            r"cylinder \(1, 0\): the axis has no length",
        ),
        (
            lambda: cylint.cone([0, 0, 0], [1, 0], [0, 0, 1], 0),
            "cone 1: a radius",
        ),
        (
            lambda: cylint.angle_cone(*UNIT, [45, 90]),
            "angle_cone 1: the half angle",
        ),
        (
            lambda: cylint.elliptic_cylinder(*[[1, 0, 0]] * 4),
            "elliptic_cylinder: the vectors a, b, h are linearly dependent",
        ),
        (
            lambda: cylint.cylinder([0, 0], [0, 1], 1),
            r"p0: expected the shape \(\.\.\., 3\)",
        ),
        (
            lambda: cylint.cylinder(np.zeros((2, 3)), np.ones((3, 3)), 1),
            r"do not broadcast: p0 \(2,\), p1 \(3,\), r \(\), ends \(\)",
        ),
    ],
)
def test_a_bad_argument_is_named(make, message):
    with pytest.raises(ValueError, match=message):
        make()


def test_arguments_must_be_real_numbers():
    with pytest.raises(TypeError, match="r: expected real numbers"):
        cylint.cylinder(*UNIT, "thick")
    with pytest.raises(TypeError, match="p0: expected real numbers"):
        cylint.cylinder([0, 0, 1j], [0, 0, 1], 1)


def test_indexing_follows_numpy():
    shapes = forest(40, 1)
    order = np.random.default_rng(2).permutation(len(shapes))
    assert same(shapes[order].bounds(), shapes.bounds()[order])
    assert same(shapes[::-3].bounds(), shapes.bounds()[::-3])
    assert same(
        shapes[shapes.kind == 2].bounds(), shapes.bounds()[shapes.kind == 2]
    )
    assert shapes[3].shape == () and shapes[None, :, None].shape == (1, 40, 1)
    assert len(list(shapes)) == 40
    assert (
        shapes.reshape(5, 8)[1, 2].bounds().tolist()
        == shapes[10].bounds().tolist()
    )
    with pytest.raises(IndexError):
        shapes[40]


def test_shapes_do_not_change():
    with pytest.raises(AttributeError):
        cylint.cylinder(*UNIT, 1).kind = 3
    with pytest.raises(ValueError, match="read-only"):
        cylint.cylinder(*UNIT, [1, 2]).kind[0] = 3


def test_concatenate_joins_in_order():
    assert len(cylint.concatenate([])) == 0
    parts = [forest(8, 3), cylint.cylinder(*UNIT, 1), forest(4, 4)]
    joined = cylint.concatenate(parts)
    assert same(joined.bounds()[9:], parts[2].bounds())


def test_empty_arrays():
    none = cylint.cylinder(np.empty((0, 3)), [0, 0, 1], 1)
    assert none.shape == (0,) and none.bounds().shape == (0, 2, 3)
    assert none.contains([0, 0, 0]).shape == (0,)
    assert pickle.loads(pickle.dumps(none)).shape == (0,)
    assert repr(none) == "<libcylint.Shapes (0,): none>"


def test_contains_says_inside_boundary_outside():
    rod = cylint.cylinder(*UNIT, [[1], [2]])
    points = [[0, 0, 0.5], [1, 0, 0.5], [1.5, 0, 0], [0, 0, 2], [np.nan, 0, 0]]
    assert rod.contains(points).tolist() == [
        [1, 0, -1, -1, -1],
        [1, 1, 0, -1, -1],
    ]


def test_contains_equals_one_by_one():
    shapes = forest(60, 5)
    points = np.random.default_rng(6).random((60, 3))
    table = shapes[:, None].contains(points[None, :])
    assert table.max() == 1 or (table == -1).all()
    for i in range(0, 60, 7):
        assert np.array_equal(table[i], shapes[i].contains(points))
        assert table[i, 3] == shapes[i].contains(points[3])


finite = st.floats(allow_nan=False, allow_infinity=False)
triples = arrays(np.float64, (4, 3), elements=finite)


@given(
    triples, triples, triples, triples, arrays(np.float64, 4, elements=finite)
)
def test_pickles_keep_every_number(a, b, c, d, k):
    """Extreme numbers, too; what a constructor refuses is left out."""
    made = []
    for make in (
        lambda i: cylint.cylinder(a[i], b[i], abs(k[i]), ends="open"),
        lambda i: cylint.cone(
            a[i], abs(k[i]), b[i], abs(c[i, 0]), ends="nappe"
        ),
        lambda i: cylint.elliptic_cylinder(a[i], b[i], c[i], d[i]),
        lambda i: cylint.elliptic_cone(a[i], b[i], c[i], d[i], abs(k[i])),
        lambda i: cylint.sphere(a[i], abs(k[i])),
        lambda i: cylint.capsule(a[i], b[i], abs(k[i]), ends="open"),
        lambda i: cylint.round_cone(a[i], abs(k[i]), b[i], abs(c[i, 0])),
        lambda i: cylint.tangent_cone(a[i], b[i], abs(k[i])),
        lambda i: cylint.angle_cone(a[i], b[i], abs(k[i]) % 90, ends="capped"),
    ):
        for i in range(4):
            try:
                made.append(make(i))
            except ValueError:
                pass
    shapes = cylint.concatenate(made)
    again = pickle.loads(pickle.dumps(shapes))
    assert again._records.tobytes() == shapes._records.tobytes()


def test_a_ray_from_inside_leaves_a_closed_solid_once():
    shapes = forest(200, 7)
    points = shapes.bounds().mean(axis=1)
    inside = (shapes.contains(points) == 1) & (
        shapes.ends == cylint.Ends.CAPPED
    )
    assert inside.sum() > 50
    assert (cylint.intersect(shapes, points, [0, 0, 1]).n[inside] == 1).all()


def test_text_and_arrays_make_the_same_shapes(command, tmp_path):
    random = np.random.default_rng(8)
    p0, p1, r = (
        random.random((50, 3)),
        random.random((50, 3)),
        random.random(50),
    )
    scene = tmp_path / "scene"
    scene.write_text(
        text_of(
            ["cylinder"] * 50, hexadecimal(p0), hexadecimal(p1), hexadecimal(r)
        )
    )
    read = cylint.read_scene(scene)
    made = cylint.cylinder(p0, p1, r)
    assert read._records.tobytes() == made._records.tobytes()
