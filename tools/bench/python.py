"""The Python package beside Open3D.

usage: python.py [--quick]

One cylinder, 5,000 cylinders in a cube (nearest hits, beams of a scanner, nearest
points), and path lengths in 1,000 cylinders.  One thread, processor time, arrays in and
arrays out; the contestants take turns and the least time counts.  Open3D gets meshes of
the cylinders; its answers are compared with the package's, which are exact.  The lines
of output are those of bench.c.
"""

import sys
import time

import numpy as np
import open3d
import trimesh
from rows import print_header, print_row

import libcylint as cylint

ROUNDS = 3
QUICK = "--quick" in sys.argv
SOURCE = 3.0  # of the projection: how far from the centre, the detector behind that


def compete(subject, question, rival, n, theirs, ours):
    """Prints the nanoseconds of one of n answers; returns both answers."""
    least, answers = [np.inf, np.inf], [None, None]
    for _ in range(ROUNDS):
        for i, call in enumerate((theirs, ours)):
            start = time.process_time()
            answers[i] = call()
            least[i] = min(least[i], time.process_time() - start)
    print_row("python", subject, question, rival, "ns", *(1e9 * t / n for t in least))
    return answers


# ------------------------------------------------------------------- rival --


class Open3D:
    """Cylinders p0, p1 (n, 3), r (n) as triangles; `faces` for each of them."""

    def __init__(self, p0, p1, r, facets):
        parts = [trimesh.creation.cylinder(radius=c, segment=[a, b], sections=facets)
                 for a, b, c in zip(p0, p1, r, strict=True)]
        mesh = trimesh.util.concatenate(parts)
        self.faces = len(parts[0].faces)
        self.name = f"Open3D {facets} facets"
        self.tensor = open3d.core.Tensor
        self.scene = open3d.t.geometry.RaycastingScene(nthreads=1)
        self.scene.add_triangles(self.tensor(np.asarray(mesh.vertices, np.float32)),
                                 self.tensor(np.asarray(mesh.faces, np.uint32)))

    def rays(self, o, d):
        return self.tensor(np.concatenate([o, d], axis=1).astype(np.float32))

    def nearest(self, o, d):
        found = self.scene.cast_rays(self.rays(o, d), nthreads=1)
        triangle = found["primitive_ids"].numpy().astype(np.int64)
        return np.where(triangle == 0xFFFFFFFF, -1, triangle // self.faces)

    def closest(self, points):
        query = self.tensor(points.astype(np.float32))
        found = self.scene.compute_closest_points(query, nthreads=1)
        to = found["points"].numpy().astype(np.float64)
        triangle = found["primitive_ids"].numpy().astype(np.int64)
        return triangle // self.faces, np.linalg.norm(points - to, axis=1)

    def hits(self, o, d):
        found = self.scene.list_intersections(self.rays(o, d), nthreads=1)
        line = found["ray_ids"].numpy().astype(int)
        return found["t_hit"].numpy() * np.linalg.norm(d, axis=1)[line], line


def sums_of_hits(t, line, n):
    """The lengths between hits 1 and 2, 3 and 4, ... of each line; how many lines have
    an odd number of hits."""
    order = np.lexsort((t, line))
    counts = np.bincount(line, minlength=n)
    place = np.arange(len(t)) - np.repeat(np.cumsum(counts) - counts, counts)
    sums = np.bincount(line[order], np.where(place % 2, 1.0, -1.0) * t[order], n)
    return np.where(counts % 2, 0, sums), np.count_nonzero(counts % 2)


# ------------------------------------------------------------------- input --


def forest(n, random):
    p0 = random.random((n, 3))
    p1 = p0 + random.normal(size=(n, 3)) * 0.02
    return p0, p1, random.uniform(0.0005, 0.004, n)


def grid(n, random):
    """In cells of a cube about 0, apart from each other."""
    cells = int(np.ceil(np.cbrt(n)))
    cell = np.array(np.unravel_index(np.arange(n), (cells,) * 3)).T
    centre = (cell + 0.5) / cells - 0.5
    axis = random.normal(size=(n, 3))
    axis *= 0.35 / cells / np.linalg.norm(axis, axis=1, keepdims=True)
    return centre - axis, centre + axis, random.uniform(0.05, 0.3, n) / cells


def rays_at_one(family, n, random):
    """At the cylinder 0 0 0  0 0 1  0.5, from outside."""
    if family == "half hit":
        o = random.normal(size=(n, 3)) * 3 + [6, 0, 0]
        return o, random.uniform(-0.7, 0.7, (n, 3)) + [0, 0, 0.5] - o
    is_far, angle = family == "far", random.uniform(0, 2 * np.pi, n)
    across = np.c_[np.cos(angle), np.sin(angle), np.zeros(n)]
    along = np.c_[-np.sin(angle), np.cos(angle), random.normal(size=n) * 0.1]
    off = 10.0 ** random.uniform(-12, -3, n) * random.choice([-1, 1], n)
    off = random.uniform(-2, 1, n) if is_far else off
    start = 10.0 ** random.uniform(3, 6, n) if is_far else np.full(n, 2)
    at = np.c_[np.zeros((n, 2)), random.uniform(0.3, 0.7, n)]
    d = along * start[:, None]
    return at + across * (0.5 * (1 + off))[:, None] - d, d


def beams(side):
    """Of a scanner in the middle of the cube, line by line."""
    turn = np.linspace(0, 2 * np.pi, side, endpoint=False)
    rise = np.radians(np.linspace(75, -75, side))[:, None]
    d = np.stack(np.broadcast_arrays(
        np.cos(rise) * np.cos(turn), np.cos(rise) * np.sin(turn), np.sin(rise)), -1)
    return np.full((side * side, 3), 0.5), d.reshape(-1, 3)


def scan(shapes, n, random):
    """Points near the lateral surfaces."""
    p0, p1, r = shapes
    i = random.integers(len(r), size=n)
    across = np.cross(p1[i] - p0[i], random.normal(size=(n, 3)))
    across /= np.linalg.norm(across, axis=1)[:, None]
    off = r[i] * (1 + random.normal(size=n) * 0.1)
    return p0[i] + random.random((n, 1)) * (p1[i] - p0[i]) + across * off[:, None]


def projection(side):
    """Lines from a source to the pixels of a detector."""
    x = (np.arange(side) + 0.5) / side * 2 - 1
    v, u = np.meshgrid(x, x, indexing="ij")
    d = np.stack([u.ravel(), v.ravel(), np.full(side * side, -2 * SOURCE)], 1)
    return np.tile([0, 0, SOURCE], (side * side, 1)), d


# ------------------------------------------------------------------- cases --


def one_cylinder(n, random):
    shapes = np.zeros((1, 3)), np.array([[0.0, 0, 1]]), np.array([0.5])
    rod = cylint.cylinder(*(x[0] for x in shapes))
    rival = Open3D(*shapes, 32)
    for family in "half hit", "grazing", "far":
        o, d = rays_at_one(family, n, random)
        theirs, ours = compete(
            "1 cylinder", f"relation and t; {family}", rival.name, n,
            lambda: rival.nearest(o, d), lambda: cylint.intersect(rod, o, d, threads=1))
        print_row("python", "1 cylinder", f"wrong verdicts; {family}", rival.name, "%",
                  100 * ((theirs >= 0) != (ours.n > 0)).mean(), None)


def many_cylinders(n, random):
    shapes = forest(5000, random)
    scene = cylint.Scene(cylint.cylinder(*shapes))
    o = random.uniform(-0.5, 1.5, (n, 3))
    rays = {"random rays": (o, random.random((n, 3)) - o),
            "beams of a scanner": beams(int(n**0.5))}
    points = {"points of a scan": scan(shapes, n // 10, random),
              "points anywhere": random.random((n // 10, 3))}
    for facets in 16, 32, 64:
        rival = Open3D(*shapes, facets)
        for name, (o, d) in rays.items():
            theirs, ours = compete(
                "5000 cylinders", f"nearest; {name}", rival.name, len(o),
                lambda: rival.nearest(o, d), lambda: scene.nearest(o, d, threads=1))
            print_row("python", "5000 cylinders", f"wrong shapes; {name}", rival.name, "%",
                      100 * (theirs != ours.index).mean(), None)
        for name, p in points.items() if facets == 64 else ():
            theirs, ours = compete(
                "5000 cylinders", f"closest; {name}", rival.name, len(p),
                lambda: rival.closest(p), lambda: scene.closest(p, threads=1))
            error = abs(theirs[1] - abs(ours.distance)) / shapes[2][ours.index]
            print_row("python", "5000 cylinders", f"median error; {name}", rival.name, "r",
                      np.median(error), None)
            print_row("python", "5000 cylinders", f"wrong shapes; {name}", rival.name, "%",
                      100 * (theirs[0] != ours.index).mean(), None)


def path_lengths(n, random):
    shapes = grid(1000, random)
    scene = cylint.Scene(cylint.cylinder(*shapes), threads=1)
    rival = Open3D(*shapes, 64)
    o, d = projection(int(n**0.5))
    (sums, odd), ours = compete(
        "1000 cylinders", "sums of path lengths", rival.name, len(o),
        lambda: sums_of_hits(*rival.hits(o, d), len(o)),
        lambda: scene.sums(o, d, threads=1))
    error = abs(sums - ours) / ours[ours > 0].mean()
    for name, unit, x in (("mean error", "1", error.mean()),
                          ("largest error", "1", error.max()), ("unpaired", "1", odd)):
        print_row("python", "1000 cylinders", f"sums; {name}", rival.name, unit, x, None)


def main():
    n = 100_000 if QUICK else 1_000_000
    print_header()
    for case in one_cylinder, many_cylinders, path_lengths:
        case(n, np.random.default_rng(1))


if __name__ == "__main__":
    main()
