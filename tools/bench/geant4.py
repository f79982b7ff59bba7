"""Pieces of rays in hollow cylinders and cones, beside the steps of Geant4.

usage: geant4.py LIBRARY [RAYS]

A G4Tubs and a G4Cons with a bore, full and in sectors of 120, 180 and 240 degrees; RAYS
(4000) in each of six families.  LIBRARY is rivals/geant4.c, which calls both programs
from C: ns a ray for all steps with DistanceToIn() and DistanceToOut(), and for all
pieces, the least of five turns.  The lines of output are those of bench.c.

Pieces are equal if their ends differ by at most 1e-9 mm, Geant4's tolerance.  All rays
that are not equal, and every tenth of the others, are judged by rational numbers, each
program for the solid that it has.  Geant4 is wrong if the middle of what it misses, or
has in excess, is more than 1e-8 mm on the other side of the surface; libcylint is wrong
if an end is not the double nearest to the true one, and then the exit status is 1.
"""

import ctypes
import os
import sys
from fractions import Fraction
from math import cos, isqrt, radians, sin

import numpy as np
from rows import print_header, print_row

import libcylint as cylint

os.environ.setdefault("GEANT4_DATA_DIR", "none")  # or the wheel asks for data
import geant4_pybind as g4  # noqa: E402

MOST, TOLERANCE, FAIR = 8, 1e-9, Fraction(1, 10**8)
HALF = 16.0  # the length of the axis, which is that of z
RADII = {"G4Tubs": ((10, 10), (5, 5)), "G4Cons": ((10, 6), (5, 2))}
SECTORS = ((0, 360), (0, 120), (90, 180), (30, 240))  # start and span


# ------------------------------------------------------------------- truth --


def square_root(x):
    """To 200 bits; exact for squares."""
    root = isqrt(x.numerator * x.denominator << 400)
    return Fraction(root, x.denominator << 200)


def cosine_and_sine(angle):
    """By their series, to 200 bits."""
    term, sums = Fraction(1), [Fraction(0), Fraction(0)]
    for i in range(80):
        sums[i % 2] += term * (-1) ** (i // 2)
        term *= Fraction(angle) / (i + 1)
    return [Fraction(round(s * 2**200), 2**200) for s in sums]


class Truth:
    """A solid in rationals.  planes: x and y of normals out of the sector, which is
    beneath one of them (`is_either`) or both."""

    def __init__(self, radii, planes, is_either):
        self.planes, self.is_either = planes, is_either
        self.surfaces = [  # radius at z = 0, and its slope
            (Fraction(a + b, 2), Fraction(b - a) / Fraction(2 * HALF))
            for a, b in radii
        ]

    def contains(self, o, d, t, grown=0):
        """Whether the solid, larger by `grown`, contains a point of the line."""
        x, y, z = (a + t * b for a, b in zip(o, d, strict=True))
        outer, inner = (r + slope * z for r, slope in self.surfaces)
        rho = x * x + y * y
        if abs(z) > HALF + grown or rho > (outer + grown) ** 2:
            return False
        beneath = [x * u + y * v <= grown for u, v in self.planes]
        in_sector = any(beneath) if self.is_either else all(beneath)
        return rho > (inner - grown) ** 2 and in_sector

    def cuts(self, o, d):
        """Where the line meets the surfaces, and elsewhere."""
        for middle, slope in self.surfaces:
            r, dr = middle + slope * o[2], slope * d[2]
            a = d[0] ** 2 + d[1] ** 2 - dr**2
            b = o[0] * d[0] + o[1] * d[1] - r * dr
            c = o[0] ** 2 + o[1] ** 2 - r**2
            if a and b * b >= a * c:
                root = square_root(b * b - a * c)
                yield from ((-b - root) / a, (-b + root) / a)
            elif not a and b:
                yield -c / (2 * b)
        if d[2]:
            yield from ((Fraction(z) - o[2]) / d[2] for z in (-HALF, HALF))
        for x, y in self.planes:
            if d[0] * x + d[1] * y:
                yield -(o[0] * x + o[1] * y) / (d[0] * x + d[1] * y)

    def pieces(self, o, d):
        """With rounded ends, without those of length 0."""
        ends = sorted({Fraction(0), *(t for t in self.cuts(o, d) if t > 0)})
        pieces = []
        for a, b in zip(ends, ends[1:], strict=False):
            begin, end = float(a), float(b)
            if begin == end or not self.contains(o, d, (a + b) / 2):
                continue
            if pieces and pieces[-1][1] == begin:
                begin = pieces.pop()[0]
            pieces.append((begin, end))
        return pieces

    def has_fault(self, o, d, got):
        """Whether Geant4's pieces are wrong."""
        true = self.pieces(o, d)
        ends = sorted({t for piece in (*got, *true) for t in piece})
        for a, b in zip(ends, ends[1:], strict=False):
            has, should = (any(p[0] <= a and b <= p[1] for p in x) for x in (got, true))
            middle = (Fraction(a) + Fraction(b)) / 2
            grown = FAIR if has else -FAIR
            if has != should and has != self.contains(o, d, middle, grown):
                return True
        return False


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
        shapes, clauses = cylint.tube(*tube, sector=self.sides)
        is_either = list(clauses).count(3) == 2
        planes = [[Fraction(float(x)) for x in s.n[:2]] for s in shapes[2:]]
        self.truth = Truth(self.radii, planes, is_either)
        planes = [
            (sign * s, -sign * c)
            for sign, (c, s) in zip((1, -1), map(cosine_and_sine, angles))
        ]
        self.truth_of_geant4 = Truth(self.radii, planes, is_either)

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


def judge(solid, rays, theirs, ours):
    """For how many rays Geant4 and libcylint are wrong."""
    near = (np.abs(theirs[1] - ours[1]) <= TOLERANCE).all((1, 2))
    is_equal = near & (theirs[0] == ours[0])
    wrong = np.zeros(2, int)
    for i in np.flatnonzero(~is_equal | (np.arange(len(rays)) % 10 == 0)):
        o, d = np.split(np.array([Fraction(x) for x in rays[i].tolist()]), 2)
        step, piece = ([tuple(p) for p in t[i, : counts[i]].tolist()]
                       for counts, t, _ in (theirs, ours))
        wrong += (solid.truth_of_geant4.has_fault(o, d, step),
                  solid.truth.pieces(o, d) != piece)
    return wrong


def row(solid, family, n):
    """Prints two lines; returns for how many rays libcylint is wrong."""
    rays = np.hstack(family(np.random.default_rng(1), n, solid))
    turns = [(solid.of_geant4(rays), solid.of_libcylint(rays)) for _ in range(5)]
    steps, pieces = (min(turn[i][2] for turn in turns) for i in range(2))
    wrong = judge(solid, rays, *turns[0])
    name = family.__name__.replace("_", " ")
    for question, unit, theirs, ours in (
            (f"all pieces; {name}", "ns", steps, pieces),
            (f"wrong of {n}; {name}", "1", *wrong)):
        print_row("geant4", solid.name, question, "Geant4", unit, theirs, ours)
    return wrong[1]


def main():
    library = ctypes.CDLL(sys.argv[1])
    n = int(sys.argv[2]) if len(sys.argv) > 2 else 4000
    for name in ("geant4_steps", "cylint_pieces_of"):
        getattr(library, name).restype = ctypes.c_double
    print_header()
    wrong = sum(row(Solid(library, kind, *sector), family, n)
                for kind in RADII for sector in SECTORS for family in FAMILIES)
    sys.exit(wrong > 0)


if __name__ == "__main__":
    main()
