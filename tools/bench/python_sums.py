"""Path lengths of lines in cylinders: time and error of the Python package and rivals.

usage: python_sums.py [CYLINDERS [SIDE]]

CYLINDERS (1000) stand apart from each other, and SIDE x SIDE (1000) lines run from one
source to the pixels of a detector behind them, as in a projection for tomography.
Rivals that are not installed are left out.  The time is elapsed time with two threads,
the least of three; one thread where a rival has no more.  Errors are those of a line's
length in all cylinders, beside the mean length of the lines that hit any; "unpaired"
counts lines with an odd number of hits.
"""

import sys
import time

import numpy as np

import libcylint as cylint

SIDES = 64  # of a cylinder's mesh
SOURCE = 3.0  # how far it is from the centre, and the detector behind that


def cylinders(n):
    """In cells of a grid in the unit cube: p0, p1 (n, 3), r (n)."""
    rng = np.random.default_rng(1)
    cells = int(np.ceil(np.cbrt(n)))
    cell = np.array(np.unravel_index(np.arange(n), (cells,) * 3)).T
    centre = (cell + 0.5) / cells - 0.5
    axis = rng.normal(size=(n, 3))
    axis *= 0.35 / cells / np.linalg.norm(axis, axis=1, keepdims=True)
    return centre - axis, centre + axis, rng.uniform(0.05, 0.3, n) / cells


def lines(side):
    """From the source to the pixels of a detector: o, d (side^2, 3)."""
    x = (np.arange(side) + 0.5) / side * 2 - 1
    v, u = np.meshgrid(x, x, indexing="ij")
    o = np.broadcast_to([0, 0, SOURCE], (side * side, 3))
    d = np.stack([u.ravel(), v.ravel(), np.full(side * side, -2 * SOURCE)], 1)
    return np.ascontiguousarray(o), d


def sums_of_hits(t, line, n):
    """The lengths between the hits 1 and 2, 3 and 4, ... of each line, and how many
    lines have an odd number of hits."""
    order = np.lexsort((t, line))
    counts = np.bincount(line, minlength=n)
    place = np.arange(len(t)) - np.repeat(np.cumsum(counts) - counts, counts)
    sign = np.where(place % 2 == 1, 1.0, -1.0)
    odd = counts % 2 == 1
    sums = np.bincount(line[order], weights=sign * t[order], minlength=n)
    sums[odd] = 0
    return sums, int(np.count_nonzero(odd))


# ------------------------------------------------------------------ rivals --
# Each is made of cylinders; sums(o, d) returns the length of each line and how many are
# unpaired.  `most`: the most lines, because it is slow.


class Libcylint:
    name, most = "libcylint", 10**9

    def __init__(self, p0, p1, r):
        self.scene = cylint.Scene(cylint.cylinder(p0, p1, r), threads=2)

    def sums(self, o, d):
        return self.scene.sums(o, d), 0


class Rtk:
    """itk-rtk adds one quadric with clip planes after the other to a projection."""

    name, most = "itk-rtk, RayQuadricIntersection", 10_000

    def __init__(self, p0, p1, r):
        from itk import RTK as rtk

        self.rtk = rtk
        self.shapes = list(zip(p0, p1, r, strict=True))

    def sums(self, o, d):
        import itk

        rtk, side = self.rtk, round(len(o) ** 0.5)
        image = itk.Image[itk.F, 3]
        geometry = rtk.ThreeDCircularProjectionGeometry.New()
        geometry.AddProjection(SOURCE, 2 * SOURCE, 0)
        blank = rtk.ConstantImageSource[image].New(
            Size=[side, side, 1],
            Spacing=[2 / side, 2 / side, 1],
            Origin=[1 / side - 1, 1 / side - 1, 0],
        )
        blank.Update()
        projection = blank.GetOutput()
        kept = []  # an image lives as long as its source
        filters = rtk.RayQuadricIntersectionImageFilter[image, image]
        for a, b, radius in self.shapes:
            add = filters.New(Input=projection, Geometry=geometry, Density=1.0)
            w = (b - a) / np.linalg.norm(b - a)
            m = np.eye(3) - np.outer(w, w)
            numbers = [*np.diag(m), 2 * m[0, 1], 2 * m[0, 2], 2 * m[1, 2]]
            numbers += [*(-2 * m @ a), a @ m @ a - radius**2]
            for letter, x in zip("ABCDEFGHIJ", numbers, strict=True):
                getattr(add, "Set" + letter)(float(x))
            add.AddClipPlane([*map(float, w)], float(w @ b))
            add.AddClipPlane([*map(float, -w)], float(-w @ a))
            add.Update()
            projection = add.GetOutput()
            kept.append(add)
        return itk.array_from_image(projection)[0].astype(float).ravel(), 0


def meshes(p0, p1, r):
    import trimesh

    return trimesh.util.concatenate(
        [
            trimesh.creation.cylinder(radius=c, segment=[a, b], sections=SIDES)
            for a, b, c in zip(p0, p1, r, strict=True)
        ]
    )


class Trimesh:
    name, most = "trimesh with embreex, multiple_hits", 40_000

    def __init__(self, p0, p1, r):
        import embreex  # noqa: F401  trimesh is slow without it

        self.mesh = meshes(p0, p1, r)

    def sums(self, o, d):
        place, line, _ = self.mesh.ray.intersects_location(
            o, d, multiple_hits=True
        )
        t = np.linalg.norm(place - o[line], axis=1)
        return sums_of_hits(t, line, len(o))


class Open3d:
    name, most = "Open3D list_intersections", 10**9

    def __init__(self, p0, p1, r):
        import open3d

        mesh = meshes(p0, p1, r)
        self.tensor = open3d.core.Tensor
        self.scene = open3d.t.geometry.RaycastingScene(nthreads=2)
        self.scene.add_triangles(
            self.tensor(mesh.vertices.astype(np.float32)),
            self.tensor(mesh.faces.astype(np.uint32)),
        )

    def sums(self, o, d):
        rays = np.hstack([o, d]).astype(np.float32)
        hits = self.scene.list_intersections(self.tensor(rays), nthreads=2)
        t = hits["t_hit"].numpy().astype(float)
        sums, odd = sums_of_hits(t, hits["ray_ids"].numpy().astype(int), len(o))
        return sums * np.linalg.norm(d, axis=1), odd


# ---------------------------------------------------------------- one row --


def true_sums(p0, p1, r, o, d):
    """By quadratics in long doubles, for lines of which no cylinder holds an end."""
    p0, p1, r, o, d = (x.astype(np.longdouble) for x in (p0, p1, r, o, d))
    sums = np.zeros(len(o), np.longdouble)
    for a, b, radius in zip(p0, p1, r, strict=True):
        w = b - a
        ww, x = w @ w, o - a
        A = (d * d).sum(1) - (d @ w) ** 2 / ww
        B = (x * d).sum(1) - (x @ w) * (d @ w) / ww
        C = (x * x).sum(1) - (x @ w) ** 2 / ww - radius**2
        root = np.sqrt(np.maximum(B * B - A * C, 0))
        ends = np.sort(np.stack([-(x @ w), ww - x @ w]) / (d @ w), axis=0)
        chord = np.minimum(ends[1], (-B + root) / A)
        chord = chord - np.maximum(ends[0], (-B - root) / A)
        sums += np.where((B * B > A * C) & (chord > 0), chord, 0)
    return (sums * np.sqrt((d * d).sum(1))).astype(float)


def row(rival, shapes, side):
    made = rival(*shapes)
    side = min(side, int(rival.most**0.5))
    o, d = lines(side)
    best = np.inf
    for _ in range(3):
        begin = time.perf_counter()
        sums, odd = made.sums(o, d)
        best = min(best, time.perf_counter() - begin)
    some = np.random.default_rng(2).choice(len(o), min(len(o), 4000), False)
    expected = true_sums(*shapes, o[some], d[some])
    mean = expected[expected > 0].mean()
    error = np.abs(sums[some] - expected) / mean
    print(
        f"{rival.name:36} {len(o):9,} lines  {1e6 * best / len(o):8.3f} us a line  "
        f"error: mean {error.mean():7.1e}, largest {error.max():7.1e}; {odd:,} unpaired"
    )


def main():
    n = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    side = int(sys.argv[2]) if len(sys.argv) > 2 else 1000
    shapes = cylinders(n)
    print(f"{n:,} cylinders")
    for rival in (Libcylint, Rtk, Trimesh, Open3d):
        try:
            row(rival, shapes, side)
        except ImportError as missing:
            print(f"{rival.name:36} left out: {missing}")


if __name__ == "__main__":
    main()
