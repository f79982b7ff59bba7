"""Pieces of rays in hollow cylinders and cones, beside the steps of Geant4.

usage: geant4.py LIBRARY [RAYS]

A G4Tubs and a G4Cons with a bore, full and in sectors of 120, 180 and 240 degrees; RAYS
(4000) in each of six families.  LIBRARY is rivals/geant4.c, which calls both programs
from C: ns a ray for all steps with DistanceToIn() and DistanceToOut(), and for all
pieces, the least of five turns.  The lines of output are those of bench.c.

Geant4's pieces are wrong if the middle of what they miss, or have in excess, is more
than 1e-8 mm inside or outside the solid.  libcylint's are the truth, which its tests
compare with other computations.
"""

import ctypes
import os
import sys
from math import cos, radians, sin

import numpy as np
from rows import print_header, print_row

import libcylint as cylint

os.environ.setdefault("GEANT4_DATA_DIR", "none")  # or the wheel asks for data
import geant4_pybind as g4  # noqa: E402

MOST, FAIR = 8, 1e-8
HALF = 16.0  # half the length of the axis, which is that of z
RADII = {"G4Tubs": ((10, 10), (5, 5)), "G4Cons": ((10, 6), (5, 2))}
SECTORS = ((0, 360), (0, 120), (90, 180), (30, 240))  # start and span


# ------------------------------------------------------------ contestants --


def address(x):
    return None if x is None else ctypes.c_void_p(x.ctypes.data)


def members_of(solid):
    """The addresses of an object of pybind11 and of its member functions."""
    word = ctypes.POINTER(ctypes.c_void_p)
    values = ctypes.cast(id(solid) + object.__basicsize__, word)[0]
    wheel, vector = ctypes.CDLL(g4.__file__), "ERKN5CLHEP10Hep3VectorE"
    functions = [
        getattr(wheel, f"_ZNK6{type(solid).__name__}{name}")
        for name in (
            f"6Inside{vector}",
            f"12DistanceToIn{vector}S3_",
            f"13DistanceToOut{vector}S3_bPbPS1_",
        )
    ]
    return (ctypes.c_void_p * 4)(
        ctypes.cast(values, word)[0],
        *(ctypes.cast(f, ctypes.c_void_p) for f in functions),
    )


class Solid:
    """For both programs."""

    def __init__(self, library, kind, start, span):
        self.library, self.name = library, f"{kind} {span}"
        self.radii = outer, inner = RADII[kind]
        phi, delta = radians(start), radians(span)
        angles = (phi, phi + delta) if span < 360 else ()
        self.sides = [[cos(a), sin(a), 0] for a in angles] or None
        if kind == "G4Tubs":
            sizes = inner[0], outer[0]
        else:
            sizes = inner[0], outer[0], inner[1], outer[1]
        self.object = getattr(g4, kind)("solid", *sizes, HALF, phi, delta)
        self.geant4 = members_of(self.object)
        tube = [0, 0, -HALF], [0, 0, HALF], outer, inner
        self.tube = [
            None if x is None else np.array(x, float)
            for x in (*tube, self.sides)
        ]
        self.by = {size: self.grown(size) for size in (-FAIR, FAIR)}

    def grown(self, size):
        """The solid whose surfaces are moved outward, a scene."""
        radii = np.array(self.radii) + [[size], [-size]]
        end = [0, 0, HALF + size]
        shapes, clauses = cylint.tube(np.negative(end), end, *radii, sector=self.sides)
        planes = shapes[2:]
        scene = cylint.Scene(
            [shapes[:2], cylint.halfspace(planes.p + size * planes.n, planes.n)])
        scene.set_solids(np.arange(len(shapes)), 0, clauses)
        return scene

    def pieces(self, function, arguments, rays):
        """The number of pieces of each ray, their ends, and the ns of a ray."""
        counts, t = np.zeros(len(rays), np.intc), np.zeros((len(rays), MOST, 2))
        n = ctypes.c_size_t(len(rays))
        ns = function(*arguments, address(rays), n, address(counts), address(t))
        return counts, t, ns / len(rays)

    def of_geant4(self, rays):
        return self.pieces(self.library.geant4_steps, [self.geant4], rays)

    def of_libcylint(self, rays):
        tube = [address(x) for x in self.tube]
        return self.pieces(self.library.cylint_pieces_of, tube, rays)


# --------------------------------------------------------------- families --


def unit(d):
    return d / np.linalg.norm(d, axis=-1, keepdims=True)


def any_direction(rng, n):
    return unit(rng.normal(size=(n, 3)))


def any_size(rng, low, high, n):
    """10^low to 10^high of either sign; a quarter is 0."""
    x = 10 ** rng.uniform(low, high, (n, 1)) * rng.choice([-1, 1], (n, 1))
    return np.where(rng.random((n, 1)) < 0.25, 0, x)


def any_surface(rng, n, solid, off=0):
    """Points on the outer or inner surface, radius * (1 + off); the direction away from
    the axis, and the ruling."""
    z, phi = rng.uniform(-HALF, HALF, (n, 1)), rng.uniform(0, 7, (n, 1))
    ends = np.array(solid.radii)[rng.integers(0, 2, n)]
    slope = (ends[:, 1:] - ends[:, :1]) / (2 * HALF)
    out = np.hstack([np.cos(phi), np.sin(phi), 0 * phi])
    up = np.array([0, 0, 1])
    p = out * (ends.mean(1, keepdims=True) + slope * z) * (1 + off) + z * up
    return p, out, unit(out * slope + up)


def far(rng, n, _):
    d = any_direction(rng, n)
    target = rng.uniform(-1, 1, (n, 3)) * [10, 10, HALF]
    return target - d * 10 ** rng.uniform(2, 6, (n, 1)), d


def near(rng, n, _):
    o = rng.uniform(-1.2, 1.2, (n, 3)) * [10, 10, HALF]
    return o, any_direction(rng, n)


def grazing(rng, n, solid):
    """In a tangent plane, or up to 1e-3 radii beside it."""
    p, out, ruling = any_surface(rng, n, solid, any_size(rng, -16, -3, n))
    turn = rng.uniform(0, 7, (n, 1))
    d = unit(np.cross(ruling, out) * np.cos(turn) + ruling * np.sin(turn))
    return p - d * rng.uniform(0, 30, (n, 1)), d


def in_planes(rng, n, solid):
    """In a plane of the sector, or up to 1e-3 beside it."""
    sides = np.array(solid.sides or [[1, 0, 0], [0, 1, 0]])
    side, up = sides[rng.integers(0, 2, n)], np.array([0, 0, 1])
    off, turn = np.cross(side, up), rng.uniform(0, 7, (n, 1))
    d = side * np.cos(turn) + up * np.sin(turn)
    d = unit(d + off * any_size(rng, -17, -3, n))
    p = side * rng.uniform(-12, 12, (n, 1)) + off * any_size(rng, -17, -3, n)
    p += up * rng.uniform(-HALF, HALF, (n, 1))
    return p - d * rng.uniform(0, 30, (n, 1)), d


def parallel(rng, n, solid):
    """Parallel to the axis or a ruling, or nearly; half of them at a surface."""
    p, _, ruling = any_surface(rng, n, solid, any_size(rng, -16, -3, n))
    is_on, is_ruling = rng.random((2, n, 1)) < 0.5
    p = np.where(is_on, p, rng.uniform(-12, 12, (n, 3)))
    d = np.where(is_ruling, ruling, [0, 0, 1])
    d = unit(d + any_direction(rng, n) * any_size(rng, -17, -1, n))
    d *= rng.choice([-1, 1], (n, 1))
    return p - d * rng.uniform(0, 40, (n, 1)), d


def on_surfaces(rng, n, solid):
    """From a surface; or from integers, in a direction of integers."""
    grid = rng.integers(-16, 17, (n, 3))
    step = rng.integers(-4, 5, (n, 3)) * rng.integers(0, 2, (n, 3))
    step[~step.any(1)] = [0, 0, 1]
    is_grid = rng.random((n, 1)) < 0.5
    o = np.where(is_grid, grid, any_surface(rng, n, solid)[0])
    return o, unit(np.where(is_grid, step, any_direction(rng, n)))


FAMILIES = (far, near, grazing, in_planes, parallel, on_surfaces)


# ---------------------------------------------------------------- one row --


def is_wrong(solid, ray, got, true):
    """Whether pieces are not those of the solid, or of one that is a little larger or
    smaller."""
    ends = sorted({t for piece in (*got, *true) for t in piece})
    for a, b in zip(ends, ends[1:], strict=False):
        has, should = (any(p[0] <= a and b <= p[1] for p in x) for x in (got, true))
        middle = ray[:3] + (a + b) / 2 * ray[3:]
        if has != should:
            depth, _ = solid.by[FAIR if has else -FAIR].depth(middle, threads=1)
            if (depth > 0) != has:
                return True
    return False


def print_rows(solid, family, n):
    """Prints two lines."""
    rays = np.hstack(family(np.random.default_rng(1), n, solid))
    turns = [(solid.of_geant4(rays), solid.of_libcylint(rays)) for _ in range(5)]
    steps, pieces = (min(turn[i][2] for turn in turns) for i in range(2))
    theirs, ours = (
        [t[: counts[i]].tolist() for i, t in enumerate(ends)]
        for counts, ends, _ in turns[0])
    wrong = sum(map(is_wrong, [solid] * n, rays, theirs, ours))
    name = family.__name__.replace("_", " ")
    for question, unit, theirs, ours in (
            (f"all pieces; {name}", "ns", steps, pieces),
            (f"wrong of {n}; {name}", "1", wrong, None)):
        print_row("geant4", solid.name, question, "Geant4", unit, theirs, ours)


def main():
    library = ctypes.CDLL(sys.argv[1])
    n = int(sys.argv[2]) if len(sys.argv) > 2 else 4000
    for name in ("geant4_steps", "cylint_pieces_of"):
        getattr(library, name).restype = ctypes.c_double
    print_header()
    for kind in RADII:
        for sector in SECTORS:
            solid = Solid(library, kind, *sector)
            for family in FAMILIES:
                print_rows(solid, family, n)


if __name__ == "__main__":
    main()
