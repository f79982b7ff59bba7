"""intersect(): equal to the command; segments, refused lines, messages."""

import numpy as np
import pytest
from conftest import ROD, SHAPES, TEXTS, drawn, forest, records, refused, same

import libcylint as cylint


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
    for domain in ({"tmin": 0.5}, {"tmax": 1}):
        with refused("tmin and tmax need directions", TypeError):
            cylint.intersect(ROD, o, to=[0, 0, 1], **domain)
    with refused("line 1: the direction has no length"):
        cylint.intersect(ROD, [o, [0, 0, 1]], to=[0, 0, 1])
    with refused("expected Shapes, found int", TypeError):
        cylint.intersect(5, o, [0, 0, 1])
    with refused(r"^within\(\) missing 1 required positional argument: 'points'$", TypeError):
        cylint.Scene(ROD).within()
    with refused("to: expected the shape"):
        cylint.intersect(ROD, o, to=[0, 0])


def test_points_outside_and_inside_are_next_to_hits():
    o, d = drawn(2000, 14)
    hit = cylint.intersect(ROD, o, d, tmin=-np.inf)
    there = hit.part >= 0
    near = cylint.Scene(ROD).nearest(o, d, tmin=-np.inf)
    assert same(near.outside, hit.outside[:, 0]) and same(near.inside, hit.inside[:, 0])
    at, outside, inside = (x[there] for x in (hit.point, hit.outside, hit.inside))
    assert (ROD.contains(outside) == -1).all() and (ROD.contains(inside) == 1).all()
    for moved in (outside, inside):
        assert np.abs(moved - at).max() <= 4 * np.spacing(np.abs(at).max())
    thin = cylint.cylinder([0, 0, 1], [0, 0, np.nextafter(1, 2)], 1)
    hit = cylint.intersect(thin, [0.5, 0.25, -1], [0, 0, 1])
    assert hit.n == 2 and np.isnan(hit.inside).all() and np.isfinite(hit.outside).all()


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
