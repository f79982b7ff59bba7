"""Pieces of lines in solids, sums, depths and first boundaries, against loops."""

from __future__ import annotations

import math
import pickle
from pathlib import Path

import numpy as np
import pytest
from conftest import records, refused, same

import libcylint as cylint

SHAPES, LINES = 30, 60


def whole_numbers(rng, most, *shape):
    return rng.integers(-most, most + 1, shape).astype(float)


@pytest.fixture(scope="module")
def world():
    rng = np.random.default_rng(1)
    p0 = whole_numbers(rng, 4, SHAPES, 3)
    axis = whole_numbers(rng, 3, SHAPES, 3)
    axis[~axis.any(1)] = 1
    rods = cylint.cylinder(p0[:20], (p0 + axis)[:20], rng.integers(1, 3, 20))
    balls = cylint.sphere(p0[20:], rng.integers(1, 4, SHAPES - 20))
    shapes = cylint.concatenate([rods, balls])
    o = whole_numbers(rng, 4, LINES, 3)
    d = whole_numbers(rng, 2, LINES, 3)
    d[~d.any(1)] = 1
    return shapes, cylint.Scene(shapes, threads=2), o, d, rng.integers(0, 3, SHAPES)


def chords(shapes, o, d):
    """Of all t >= 0: (t0, t1, shape)."""
    whole = cylint.intersect(shapes, o, d, tmin=-np.inf)
    t0, t1 = np.fmax(0.0, whole.t[:, 0]), whole.t[:, 1]
    i = np.flatnonzero((whole.relation >= cylint.Relation.ALONG) & (t0 < t1))
    found = zip(t0[i].tolist(), t1[i].tolist(), i.tolist(), strict=True)
    return sorted(found, key=lambda chord: (chord[0], chord[2]))


def merged(parts, mode, rank):
    """The pieces: cells between neighbouring ends, joined as the mode says."""
    if mode == "chords":
        return [(*part, 1) for part in parts]
    pieces = []
    ends = sorted({t for part in parts for t in part[:2]})
    for t0, t1 in zip(ends, ends[1:], strict=False):
        inside = [i for a, b, i in parts if a <= t0 and t1 <= b]
        if not inside:
            continue
        owner = min(inside, key=lambda i: (rank[i], i))
        last = pieces[-1] if pieces else (0, None, None, 0)
        if last[1] == t0 and (mode == "union" or (mode == "owner" and last[2] == owner)):
            pieces[-1] = (last[0], t1, last[2], max(last[3], len(inside)))
        else:
            pieces.append((t0, t1, owner, len(inside)))
    return pieces


def rows(found, line):
    columns = (found.t0, found.t1, found.shape, found.depth)
    return [*zip(*(c[found.line == line].tolist() for c in columns), strict=True)]


def ends_of(found):
    return [*zip(found.t0.tolist(), found.t1.tolist(), strict=True)]


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
        assert rows(found, i) == expected and rows(first, i) == expected[:2]


def test_more_pieces_may_be_wanted_than_memory_holds(world):
    _, scene, o, d, _ = world
    found, first = scene.pieces(o, d), scene.pieces(o, d, first=10**13)
    assert all(same(a, b) for a, b in zip(found, first, strict=True))


def test_sums_are_exact_and_rounded_once(world):
    shapes, scene, o, d, _ = world
    labels = np.arange(SHAPES) % 4 - 1
    sums = scene.sums(o, d, labels=labels, units="t")
    assert sums.shape == (LINES, 3)
    for i in range(LINES):
        ends = [[], [], [], []]
        for t0, t1, owner, _ in merged(chords(shapes, o[i], d[i]), "owner", [0] * SHAPES):
            ends[labels[owner]] += [t1, -t0]
        assert sums[i].tolist() == [math.fsum(e) for e in ends[:3]]
    lengths = scene.sums(o, d, labels=labels, columns=5)
    assert lengths.shape == (LINES, 5) and not lengths[:, 3:].any()
    size = np.sqrt((d**2).sum(1))  # exact squares
    assert np.allclose(lengths[:, :3], sums * size[:, None], rtol=2e-16, atol=0)
    assert (scene.sums(o, d, threads=1) == scene.sums(o, d, threads=3)).all()
    grid = scene.sums(o.reshape(6, 10, 3), d.reshape(6, 10, 3))
    assert (grid.reshape(-1) == scene.sums(o, d)).all()


REAL = Path(__file__).parents[3] / "shared" / "data" / "medulla_7114.swc"


@pytest.fixture(scope="module")
def neuron():
    """A neuron, five names for its shapes, and rays through it of whole lengths."""
    if REAL.exists():
        nodes = cylint.read_scene(REAL)
    else:
        rng, n = np.random.default_rng(9), np.arange(1, 5000)
        up = n - 1 - (rng.random(len(n)) * n / 4).astype(int)
        at = np.cumsum(rng.uniform(-3, 3, (5000, 3)), axis=0)
        r = rng.uniform(1, 4, 5000)
        nodes = cylint.cone(at[n], r[n], at[up], r[up])
    i = np.arange(len(nodes))
    names = np.where((7 * i + i // 64) % 5 > 0, [f"type{x}" for x in i // 100 % 4], "")
    some = nodes[::97]
    d = np.array([[1.0, 2, 2], [-2, 3, 6], [0, 3, -4], [1, 0, 0]])[i[: len(some)] % 4]
    return nodes, names, some.p0 - 40 * d, d


RANKS = {"type2": -1, "type0": 5}


@pytest.mark.parametrize("ranked", [False, True])
def test_a_neuron_has_the_path_lengths_of_a_loop(command, neuron, tmp_path, ranked):
    """By the command and by a loop over all shapes, with exact sums."""
    shapes, names, o, d = neuron
    cylint.write_scene(tmp_path / "scene", shapes, names)
    (tmp_path / "ranks").write_text("".join(f"{k} {v}\n" for k, v in RANKS.items()))
    options = ["-s", tmp_path / "scene", "-q", "pieces"]
    options += ["--rank", tmp_path / "ranks"] if ranked else []
    rank = [RANKS.get(name, 0) * ranked for name in names]
    columns = [*dict.fromkeys(names)]
    pieces, sums = [], []
    for line, (origin, direction) in enumerate(zip(o, d, strict=True)):
        found = merged(chords(shapes, origin, direction), "owner", rank)
        pieces += [(line + 1, t0, t1, owner + 1, depth) for t0, t1, owner, depth in found]
        ends = {name: [] for name in columns}
        for t0, t1, owner, _ in found:
            ends[names[owner]] += [t1, -t0]
        length = math.sqrt((direction**2).sum())
        sums.append([math.fsum(ends[name]) * length for name in columns])
    record, t0, t1, shape, depth = np.array(pieces).T
    assert len(pieces) > 2 * len(o)
    text = records("ray", o, d)
    command(text, *options, record=record, t0_t1=np.c_[t0, t1], shape=shape, depth=depth)
    assert same(command(text, *options, "--sum", "label"), sums)


SOLIDS = """
sphere 0 0 0  4  in=shell a
sphere 0 0 0  3  out=shell
halfspace 0 0 0  0 -1 0  in=shell/3
halfspace 0 0 0  -1 0.5 0  in=shell/3 out=rest/7 b
cylinder 0 0 -9  0 0 9  1  in=rest a
cylinder 1 0 -9  1 0 9  1  ends=open in=rest
capsule -5 0 0  5 0 0  0.5  c
cone 0 0 1 2  0 0 5 0  out=rest
cylinder 0 0 0  1 1 1  0.25 ends=infinite  in=far a
halfspace 0 0 5  0 0 -1  c
"""


@pytest.mark.parametrize("mode", ["union", "owner", "cells", "chords"])
def test_the_command_has_the_pieces_of_the_package(command, tmp_path, mode):
    path = tmp_path / "scene"
    path.write_text(SOLIDS)
    scene, rng = cylint.Scene.read(path), np.random.default_rng(4)
    names = [label.split()[0] if label else "" for label in scene.shapes.labels]
    columns = [*dict.fromkeys(names)]
    o, d = whole_numbers(rng, 3, 200, 3), whole_numbers(rng, 3, 200, 3)
    d[~d.any(1)] = 1
    text, options = records("line", o, d), ["-s", path, "-q", "pieces", "--pieces", mode]
    found = scene.pieces(o, d, -np.inf, mode=mode)
    assert len(found.t0) > 200 and np.isinf(found.t0).any()
    command(
        text, *options, record=found.line + 1, t0=found.t0, t1=found.t1, shape=found.shape + 1,
        depth=found.depth,
    )  # fmt: skip
    labels = [columns.index(name) for name in names]
    for units, what in (("length", "label"), ("t", "label:t")):
        sums = scene.sums(o, d, -np.inf, mode=mode, labels=labels, units=units)
        assert same(command(text, *options, "--sum", what), sums)


def test_the_command_has_the_boundaries_and_depths_of_the_package(command, tmp_path):
    path, rng = tmp_path / "scene", np.random.default_rng(5)
    path.write_text(SOLIDS)
    scene, options = cylint.Scene.read(path), ["-s", path, "-q"]
    o, d = whole_numbers(rng, 3, 500, 3), whole_numbers(rng, 3, 500, 3)
    d[~d.any(1)] = 1
    first, (depth, owner) = scene.first_boundary(o, d, -np.inf), scene.depth(o)
    assert 0 < np.sum(first.index < 0) < 200 and set(depth) >= {0, 1, 2}
    command(
        records("line", o, d), *options, "first", shape=first.index + 1, t=first.t, part=first.part,
        side=first.side, x_y_z=first.point, nx_ny_nz=first.normal,
    )  # fmt: skip
    command(records("point", o), *options, "inside", depth=depth, shape=owner + 1)


@pytest.mark.parametrize("mode", ["union", "owner", "cells", "chords"])
def test_a_line_may_have_more_pieces_than_are_found_at_once(command, tmp_path, mode):
    i = np.arange(3000)
    beads = cylint.sphere(np.c_[i * 0.75, 0 * i, 0 * i], np.where(i % 9, 0.25, 0.875))
    cylint.write_scene(tmp_path / "scene", beads)
    found = cylint.Scene(beads).pieces([-1, 0.125, 0], [1, 0, 0], mode=mode)
    assert len(found.t0) > 1500
    text, options = "ray -1 0.125 0  1 0 0", ["-s", tmp_path / "scene", "-q", "pieces"]
    for most in (1, 3, 5, 256, 257, 1000, 10**6):
        command(
            text, *options, "--pieces", mode, "--first", most, t0_t1=np.c_[found.t0, found.t1][:most],
            shape=found.shape[:most] + 1, depth=found.depth[:most],
        )  # fmt: skip


def test_a_hollow_solid_with_a_sector():
    tubes = cylint.cylinder([0, 0, -1], [0, 0, 1], [3, 2])
    planes = cylint.halfspace([0, 0, 0], [[0, -1, 0], [1, 0, 0]])  # y >= 0 and x <= 0
    scene = cylint.Scene([tubes, planes])
    scene.set_solids([0, 1, 2, 3], 0, [1, -2, 3, 4])
    assert scene.solids.tolist() == [[0, 0, 1], [1, 0, -2], [2, 0, 3], [3, 0, 4]]
    assert ends_of(scene.pieces([-9, 0, 0], [1, 0, 0])) == [(6.0, 7.0)]
    assert scene.sums([0, -9, 0], [0, 2, 0]) == 1.0
    depth, owner = scene.depth([[-2.5, 0.1, 0], [2.5, 0.1, 0], [-1, 0.1, 0]])
    assert (depth.tolist(), owner.tolist()) == ([1, 0, 0], [0, -1, -1])
    wall = scene.first_boundary([-1, 1, 0], [-1, 0, 0])
    assert int(wall.index) == 1 and wall.normal[0] > 0
    assert wall.side == cylint.Side.ENTERING and wall.part == cylint.Part.LATERAL
    none = scene.first_boundary([9, 9, 9], [1, 0, 0])
    assert int(none.index) == -1 and math.isnan(none.t)
    again = pickle.loads(pickle.dumps(scene))
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
    assert ends_of(scene.pieces([-5, 0, 3], [1, 0, 0])) == ends


def test_solids_are_not_set_during_a_query():
    scene = cylint.Scene(cylint.sphere([[0, 0, 0], [1, 0, 0]], 1))

    def change(*_):
        scene.set_solids([0, 1], 0, [1, -2])

    with refused("during a query"):
        scene.sums([-5, 0, 0], [1, 0, 0], progress=change)
    change()
    assert scene.sums([-5, 0, 0], [1, 0, 0]) == 1
    scene.set_solids([], [], [])  # each shape is a solid again
    assert scene.solids.shape == (0, 3) and scene.sums([-5, 0, 0], [1, 0, 0]) == 3


def test_tubes_that_are_refused():
    cone, clauses = cylint.tube([0, 0, 0], [0, 0, 9], [2, 1])
    assert (cone.kind.tolist(), clauses.tolist()) == ([cylint.Kind.CONE], [1])
    good = {"p0": [0, 0, 0], "p1": [0, 0, 9], "outer": 2}
    for name, wrong, message in (
        ("outer", -1, "tube: a radius is negative"), ("p1", [0, 0, 0], "tube: the axis"),
        ("p1", [[0, 0, 1]], r"p1: expected the shape \(3,\), found \(1, 3\)"),
        ("outer", [1, 2, 3], r"outer: expected the shape \(2,\), found \(3,\)"),
        ("sector", [1, 0, 0], r"sector: expected the shape \(2, 3\), found \(3,\)"),
        ("sector", [[0, 0, 1], [1, 0, 0]], "a direction of the sector is parallel"),
        ("sector", [[1, 0, 1], [2, 0, 0]], "or both are in one half plane"),
    ):  # fmt: skip
        with refused(message):
            cylint.tube(**(good | {name: wrong}))


def test_solids_of_a_file(tmp_path):
    file = tmp_path / "pipe"
    file.write_text(
        "cylinder 0 0 0  0 0 9  2  in=pipe  wall\ncylinder 0 0 0  0 0 9  1  out=pipe\n"
        "halfspace 0 0 0  1 0 0  in=pipe/2\n"
    )
    scene = cylint.Scene.read(file)
    assert ends_of(scene.pieces([-5, 0, 3], [1, 0, 0])) == [(3.0, 4.0)]
    assert scene.shapes.labels[0] == "wall"
    with pytest.warns(UserWarning, match="pipe: its solids are not kept: see Scene.read"):
        assert (cylint.read_scene(file) == scene.shapes).all()
    scene.save(tmp_path / "saved")
    assert cylint.Scene.open(tmp_path / "saved").solids.tolist() == scene.solids.tolist()
    cylint.write_scene(tmp_path / "shapes", scene.shapes)
    assert (cylint.read_scene(tmp_path / "shapes") == scene.shapes).all()


def test_half_spaces_keep_their_arguments():
    planes = cylint.halfspace([[1, 2, 3], [4, 5, 6]], [0, 0, 2])
    assert planes.p.tolist() == [[1, 2, 3], [4, 5, 6]]
    assert planes.n.tolist() == [[0, 0, 2], [0, 0, 2]]
    assert planes.contains([0, 0, 3]).tolist() == [0, 1]
    mixed = cylint.concatenate([planes, cylint.sphere([0, 0, 0], 1)])
    assert np.isnan(mixed.n[2]).all() and np.isnan(mixed.r[:2]).all()
    assert set(mixed.to_dict()) >= {"p", "n", "c", "r"}


def test_unbounded_pieces_and_no_pieces():
    scene = cylint.Scene(cylint.halfspace([1, 0, 0], [-1, 0, 0]))
    assert scene.pieces([0, 0, 0], [1, 0, 0]).t1.tolist() == [math.inf]
    assert scene.sums([0, 0, 0], [1, 0, 0]) == math.inf
    assert scene.sums([0, 0, 0], to=[3, 0, 0]) == 2.0
    scene = cylint.Scene([])
    assert len(scene.pieces(np.empty((0, 3)), np.empty((0, 3))).t0) == 0
    assert scene.sums([[0, 0, 0]], [1, 0, 0]).tolist() == [0.0]


def test_bad_arguments(world):
    _, scene, o, d, _ = world
    spoiled = (o[:2], [[1, 0, 0], [0, 0, 0]])
    for message, call in (
        ("mode: expected", lambda: scene.pieces(o, d, mode="all")),
        ("rank: expected an integer for each of the 30 shapes", lambda: scene.pieces(o, d, rank=[1, 2])),
        ("rank: a number does not fit", lambda: scene.pieces(o, d, rank=[2**31] * 30)),
        ("rank: a number does not fit", lambda: scene.pieces(o, d, rank=[-(2**31) - 1] * 30)),
        ("first: expected", lambda: scene.pieces(o, d, first=0)),
        ("columns: expected at least 0", lambda: scene.sums(o, d, columns=-1)),
        ("dimension", lambda: scene.sums(o, d, columns=2**70)),
        ("units: expected", lambda: scene.sums(o, d, units="m")),
        ("line 1: the direction", lambda: scene.pieces(*spoiled)),
        (r"shape\[1\]: expected 0 to 29, found 99", lambda: scene.set_solids([0, 99], 0, 1)),
        (r"solid\[0\]: expected 0 to 1, found 2", lambda: scene.set_solids([0, 1], 2, 1)),
        (r"clause\[0\]: expected -2147483647 to 2147483647, not 0, found 0",
         lambda: scene.set_solids([0, 1], 0, [0, 1])),
        (r"broadcast: shape \(2,\), solid \(3,\), clause \(\)",
         lambda: scene.set_solids([0, 1], [0, 1, 2], 1)),
        ("same number", lambda: scene.set_solids([0, 0], [0, 1], 1)),
        (r"clause: expected one axis, found the shape \(2, 2\)",
         lambda: scene.set_solids([[0], [1]], 0, [1, -2])),
    ):
        with refused(message):
            call()
    with refused("first: expected an integer", TypeError):
        scene.pieces(o, d, first=1.5)
    with refused("columns: expected an integer", TypeError):
        scene.sums(o, d, columns=2.5)
    with refused(r"allocate .* shape \(1048576, 2147483648\)", MemoryError):
        labels = np.arange(len(scene)) + 2**31 - len(scene)
        scene.sums(np.zeros((2**20, 3)), [1, 0, 0], labels=labels)
    assert len(scene.pieces(o, d, first=2**70).t0) == len(scene.pieces(o, d).t0)
    assert (scene.pieces(*spoiled, errors="mask").line == 0).all()
    assert len(scene.solids) == 0
