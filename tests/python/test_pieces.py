"""Pieces of lines in solids, sums, depths and first boundaries, against loops."""

from __future__ import annotations

import math

import libcylint as cylint
import numpy as np
import pytest

SHAPES, LINES = 30, 60


def whole_numbers(rng, most, *shape):
    return rng.integers(-most, most + 1, shape).astype(float)


@pytest.fixture(scope="module")
def world():
    rng = np.random.default_rng(1)
    p0 = whole_numbers(rng, 4, SHAPES, 3)
    axis = whole_numbers(rng, 3, SHAPES, 3)
    axis[~axis.any(1)] = 1
    shapes = cylint.concatenate(
        [
            cylint.cylinder(p0[:20], (p0 + axis)[:20], rng.integers(1, 3, 20)),
            cylint.sphere(p0[20:], rng.integers(1, 4, SHAPES - 20)),
        ]
    )
    o = whole_numbers(rng, 4, LINES, 3)
    d = whole_numbers(rng, 2, LINES, 3)
    d[~d.any(1)] = 1
    return shapes, cylint.Scene(shapes, threads=2), o, d, rng.integers(0, 3, SHAPES)


def chords(shapes, o, d):
    """Of all t >= 0: (t0, t1, shape)."""
    whole = cylint.intersect(shapes, o, d, tmin=-np.inf)
    found = []
    for i in range(len(shapes)):
        if whole.relation[i] < cylint.Relation.ALONG:
            continue
        t0, t1 = max(0.0, whole.t[i, 0]), whole.t[i, 1]
        if t0 < t1:
            found.append((t0, t1, i))
    return sorted(found, key=lambda part: (part[0], part[2]))


def cells(parts):
    """(t0, t1, numbers of the shapes) between neighbouring ends."""
    ends = sorted({t for part in parts for t in part[:2]})
    for t0, t1 in zip(ends, ends[1:], strict=False):
        inside = [i for a, b, i in parts if a <= t0 and t1 <= b]
        if inside:
            yield t0, t1, inside


def merged(parts, mode, rank):
    if mode == "chords":
        return [(t0, t1, i, 1) for t0, t1, i in parts]
    pieces = []
    for t0, t1, inside in cells(parts):
        owner = min(inside, key=lambda i: (rank[i], i))
        last = pieces[-1] if pieces else None
        if (
            last
            and last[1] == t0
            and (mode == "union" or (mode == "owner" and last[2] == owner))
        ):
            pieces[-1] = (last[0], t1, last[2], max(last[3], len(inside)))
        else:
            pieces.append((t0, t1, owner, len(inside)))
    return pieces


def rows(found, line):
    own = found.line == line
    return list(
        zip(
            found.t0[own].tolist(),
            found.t1[own].tolist(),
            found.shape[own].tolist(),
            found.depth[own].tolist(),
            strict=True,
        )
    )


@pytest.mark.parametrize("mode", ["union", "owner", "cells", "chords"])
@pytest.mark.parametrize("ranked", [False, True])
def test_pieces_are_those_of_a_loop(world, mode, ranked):
    shapes, scene, o, d, ranks = world
    rank = ranks if ranked else [0] * SHAPES
    found = scene.pieces(o, d, mode=mode, rank=rank if ranked else None)
    first = scene.pieces(o, d, mode=mode, rank=rank, first=2)
    assert len(found.t0) > LINES // 2
    for i in range(LINES):
        expected = merged(chords(shapes, o[i], d[i]), mode, rank)
        assert rows(found, i) == expected
        assert rows(first, i) == expected[:2]


def test_sums_are_exact_and_rounded_once(world):
    shapes, scene, o, d, _ = world
    labels = np.arange(SHAPES) % 4 - 1
    sums = scene.sums(o, d, labels=labels, units="t")
    assert sums.shape == (LINES, 3)
    for i in range(LINES):
        pieces = merged(chords(shapes, o[i], d[i]), "owner", [0] * SHAPES)
        for label in range(3):
            ends = [
                x
                for t0, t1, owner, _ in pieces
                if labels[owner] == label
                for x in (t1, -t0)
            ]
            assert sums[i, label] == math.fsum(ends)
    lengths = scene.sums(o, d, labels=labels, columns=5)
    assert lengths.shape == (LINES, 5)
    assert not lengths[:, 3:].any()
    size = np.sqrt((d**2).sum(1))  # exact squares
    assert np.allclose(lengths[:, :3], sums * size[:, None], rtol=2e-16, atol=0)
    assert (scene.sums(o, d, threads=1) == scene.sums(o, d, threads=3)).all()
    grid = scene.sums(o.reshape(6, 10, 3), d.reshape(6, 10, 3))
    assert (grid.reshape(-1) == scene.sums(o, d)).all()


def test_a_hollow_solid_with_a_sector():
    shapes = cylint.concatenate(
        [
            cylint.cylinder([0, 0, -1], [0, 0, 1], [3, 2]),
            cylint.halfspace([0, 0, 0], [[0, -1, 0], [1, 0, 0]]),
        ]
    )
    scene = cylint.Scene(shapes)
    # y >= 0 and x <= 0
    scene.set_solids([0, 1, 2, 3], 0, [1, -2, 3, 4])
    assert scene.solids.tolist() == [[0, 0, 1], [1, 0, -2], [2, 0, 3], [3, 0, 4]]
    found = scene.pieces([-9, 0, 0], [1, 0, 0])
    assert (found.t0.tolist(), found.t1.tolist()) == ([6.0], [7.0])
    assert scene.sums([0, -9, 0], [0, 2, 0]) == 1.0
    depth, owner = scene.depth([[-2.5, 0.1, 0], [2.5, 0.1, 0], [-1, 0.1, 0]])
    assert depth.tolist() == [1, 0, 0]
    assert owner.tolist() == [0, -1, -1]
    wall = scene.first_boundary([-1, 1, 0], [-1, 0, 0])
    assert int(wall.index) == 1
    assert wall.side == cylint.Side.ENTERING
    assert wall.part == cylint.Part.LATERAL
    assert wall.normal[0] > 0
    none = scene.first_boundary([9, 9, 9], [1, 0, 0])
    assert int(none.index) == -1
    assert math.isnan(none.t)
    again = cylint.Scene.__new__(cylint.Scene)
    again = scene.__reduce__()[0](*scene.__reduce__()[1])
    assert again.solids.tolist() == scene.solids.tolist()
    assert again.shapes[2].kind == cylint.Kind.HALFSPACE


@pytest.mark.parametrize(
    ("sector", "clauses", "ends"),
    [
        (None, [1, -2], [(3.0, 4.0), (6.0, 7.0)]),
        ([[1, 0, 0], [0, 1, 0]], [1, -2, 3, 4], [(6.0, 7.0)]),
        ([[0, 1, 0], [1, 0, 0]], [1, -2, 3, 3], [(3.0, 4.0), (6.0, 7.0)]),
    ],
)
def test_tubes(sector, clauses, ends):
    shapes, found = cylint.tube([0, 0, 0], [0, 0, 9], 2, 1, sector=sector)
    assert found.tolist() == clauses
    scene = cylint.Scene(shapes)
    scene.set_solids(range(len(shapes)), 0, found)
    pieces = scene.pieces([-5, 0, 3], [1, 0, 0])
    assert list(zip(pieces.t0.tolist(), pieces.t1.tolist(), strict=True)) == ends


def test_tubes_that_are_refused():
    cone, clauses = cylint.tube([0, 0, 0], [0, 0, 9], [2, 1])
    assert cone.kind.tolist() == [cylint.Kind.CONE]
    assert clauses.tolist() == [1]
    for arguments in (
        {"outer": -1},
        {"p1": [0, 0, 0]},
        {"p1": [[0, 0, 1]]},
        {"sector": [1, 0, 0]},
        {"sector": [[0, 0, 1], [1, 0, 0]]},
    ):
        with pytest.raises(ValueError, match=r"tube|p1|sector"):
            cylint.tube(
                **({"p0": [0, 0, 0], "p1": [0, 0, 9], "outer": 2} | arguments)
            )


def test_solids_of_a_file(tmp_path):
    file = tmp_path / "pipe"
    file.write_text(
        "cylinder 0 0 0  0 0 9  2  in=pipe  wall\n"
        "cylinder 0 0 0  0 0 9  1  out=pipe\n"
        "halfspace 0 0 0  1 0 0  in=pipe/2\n"
    )
    scene = cylint.Scene.read(file)
    found = scene.pieces([-5, 0, 3], [1, 0, 0])
    assert (found.t0.tolist(), found.t1.tolist()) == ([3.0], [4.0])
    assert scene.shapes.labels[0] == "wall"
    scene.save(tmp_path / "saved")
    again = cylint.Scene.open(tmp_path / "saved")
    assert again.solids.tolist() == scene.solids.tolist()
    cylint.write_scene(tmp_path / "shapes", scene.shapes)
    back = cylint.read_scene(tmp_path / "shapes")
    assert (back == scene.shapes).all()


def test_half_spaces_keep_their_arguments():
    planes = cylint.halfspace([[1, 2, 3], [4, 5, 6]], [0, 0, 2])
    assert planes.p.tolist() == [[1, 2, 3], [4, 5, 6]]
    assert planes.n.tolist() == [[0, 0, 2], [0, 0, 2]]
    assert planes.contains([0, 0, 3]).tolist() == [0, 1]
    mixed = cylint.concatenate([planes, cylint.sphere([0, 0, 0], 1)])
    assert np.isnan(mixed.n[2]).all()
    assert np.isnan(mixed.r[:2]).all()
    assert set(mixed.to_dict()) >= {"p", "n", "c", "r"}


def test_unbounded_pieces_have_infinite_sums():
    scene = cylint.Scene(cylint.halfspace([1, 0, 0], [-1, 0, 0]))
    assert scene.pieces([0, 0, 0], [1, 0, 0]).t1.tolist() == [math.inf]
    assert scene.sums([0, 0, 0], [1, 0, 0]) == math.inf
    assert scene.sums([0, 0, 0], to=[3, 0, 0]) == 2.0


def test_no_lines_and_no_shapes():
    scene = cylint.Scene([])
    found = scene.pieces(np.empty((0, 3)), np.empty((0, 3)))
    assert len(found.t0) == 0
    assert scene.sums([[0, 0, 0]], [1, 0, 0]).tolist() == [0.0]


def test_bad_arguments(world):
    _, scene, o, d, _ = world
    with pytest.raises(ValueError, match="mode: expected"):
        scene.pieces(o, d, mode="all")
    with pytest.raises(ValueError, match="rank: expected 30 integers"):
        scene.pieces(o, d, rank=[1, 2])
    with pytest.raises(ValueError, match="first: expected"):
        scene.pieces(o, d, first=0)
    with pytest.raises(ValueError, match="units: expected"):
        scene.sums(o, d, units="m")
    with pytest.raises(ValueError, match="line 1: the direction"):
        scene.pieces(o[:2], [[1, 0, 0], [0, 0, 0]])
    masked = scene.pieces(o[:2], [[1, 0, 0], [0, 0, 0]], errors="mask")
    assert (masked.line == 0).all()
    with pytest.raises(ValueError, match=r"shape\[1\]: 99"):
        scene.set_solids([0, 99], 0, 1)
    with pytest.raises(ValueError, match=r"clause\[0\]: 0"):
        scene.set_solids([0, 1], 0, [0, 1])
    with pytest.raises(ValueError, match="same number"):
        scene.set_solids([0, 0], [0, 1], 1)
    assert len(scene.solids) == 0
