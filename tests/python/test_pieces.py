"""Pieces of lines in solids, sums, depths and first boundaries: those of the command."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from conftest import records, refused, same

import libcylint as cylint

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


def ends_of(found):
    return [*zip(found.t0.tolist(), found.t1.tolist(), strict=True)]


def whole_numbers(rng, n):
    """Lines of whole numbers."""
    o, d = (rng.integers(-3, 4, (n, 3)).astype(float) for _ in "od")
    d[~d.any(1)] = 1
    return o, d


@pytest.mark.parametrize("mode", ["union", "owner", "cells", "chords"])
@pytest.mark.parametrize("ranked", [False, True])
def test_the_command_has_the_pieces_of_the_package(command, tmp_path, mode, ranked):
    path = tmp_path / "scene"
    path.write_text(SOLIDS)
    scene, (o, d) = cylint.Scene.read(path), whole_numbers(np.random.default_rng(4), 200)
    names = [label.split()[0] if label else "" for label in scene.shapes.labels]
    columns = [*dict.fromkeys(names)]
    text, options = records("line", o, d), ["-s", path, "-q", "pieces", "--pieces", mode]
    rule = {"mode": mode, "tmin": -np.inf}
    if ranked:
        ranks = {"a": 2, "c": -1}
        (tmp_path / "ranks").write_text("".join(f"{k} {v}\n" for k, v in ranks.items()))
        options += ["--rank", tmp_path / "ranks"]
        rule["rank"] = [ranks.get(name, 0) for name in names]
    for first in (None, 2):
        found = scene.pieces(o, d, first=first, **rule)
        assert len(found.t0) > 200 and np.isinf(found.t0).any()
        command(
            text, *options, *(["--first", first] if first else []), record=found.line + 1,
            t0=found.t0, t1=found.t1, shape=found.shape + 1, depth=found.depth,
        )  # fmt: skip
    labels = [columns.index(name) for name in names]
    for units, what in (("length", "label"), ("t", "label:t")):
        sums = scene.sums(o, d, labels=labels, units=units, **rule)
        assert same(command(text, *options, "--sum", what), sums)


def test_sums_have_the_columns_that_are_wanted():
    scene = cylint.Scene(cylint.sphere([[0, 0, 0], [4, 0, 0], [8, 0, 0]], [1, 2, 1]))
    lines = [[-9, 0, 0], [-9, 0, 9]], [1, 0, 0]
    for given, right in (
        ({}, [8, 0]), ({"columns": 1}, [[8], [0]]), ({"labels": [0, -1, 1]}, [[2, 2], [0, 0]]),
        ({"labels": [2, 0, 0], "columns": 4}, [[6, 0, 2, 0], [0, 0, 0, 0]]),
        ({"labels": [2, 0, 1], "columns": 1}, [[4], [0]]),
    ):  # fmt: skip
        assert same(scene.sums(*lines, **given), np.array(right, float))


def test_the_command_has_the_boundaries_and_depths_of_the_package(command, tmp_path):
    path, rng = tmp_path / "scene", np.random.default_rng(5)
    path.write_text(SOLIDS)
    scene, options = cylint.Scene.read(path), ["-s", path, "-q"]
    o, d = whole_numbers(rng, 500)
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
    for one in (scene, pickle.loads(pickle.dumps(scene))):
        assert one.solids.tolist() == [[i, 0, c] for i, c in enumerate(clauses)]
        assert ends_of(one.pieces([-5, 0, 3], [1, 0, 0])) == ends


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
        ("sector", [0, 90], r"sector: expected the shape \(2, 3\), found \(2,\)"),
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


def test_bad_arguments():
    scene, o, d = cylint.Scene(cylint.sphere([0, 0, 0], np.arange(1, 31))), *np.eye(3)[:2]
    spoiled = (o, [[1, 0, 0], [0, 0, 0]])
    for message, call in (
        ("mode: expected", lambda: scene.pieces(o, d, mode="all")),
        ("rank: expected an integer for each of the 30 shapes", lambda: scene.pieces(o, d, rank=[1, 2])),
        ("^rank 7: found 2147483648, beyond 32 bits$",
         lambda: scene.pieces(o, d, rank=[0] * 7 + [2**31] * 23)),
        ("^labels 0: found -2147483649, ", lambda: scene.sums(o, d, labels=[-(2**31) - 1] * 30)),
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
    for most in (10**13, 2**70):  # more than memory holds
        assert len(scene.pieces(o, d, first=most).t0) == len(scene.pieces(o, d).t0) > 0
    assert (scene.pieces(*spoiled, errors="mask").line == 0).all()
    assert len(scene.solids) == 0
