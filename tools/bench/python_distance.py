"""Time and error of distances of points from cylinders: C, Python and rivals.

usage: python_distance.py PROGRAM FOLDER [POINTS]

PROGRAM is python_scene, which asks the C library the same questions; FOLDER is
for its input.  The rivals get the same cylinders as meshes of 64 facets around.
Rivals that are not installed are left out.  Writes the tables of
tools/bench/README.md.  Times are processor time of one thread, the least of
several.  Returns 1 if the package's answers are not those of C, bit for bit.
"""

import subprocess
import sys
import time
from pathlib import Path

import numpy as np

import libcylint as cylint

FACETS = 64


# ------------------------------------------------------------------ rivals --
# A rival is made of the mesh of all cylinders, and the number of faces of each.
# distances() returns the absolute distance of each point from the mesh, and the
# number of the nearest cylinder.


class Trimesh:
    name, most = "trimesh with rtree", 2_000

    def __init__(self, mesh, faces):
        import rtree  # noqa: F401  trimesh needs it
        import trimesh

        self.query = trimesh.proximity.ProximityQuery(mesh)
        self.faces = faces

    def distances(self, points):
        _, distance, triangle = self.query.on_surface(points)
        return distance, triangle // self.faces


class Open3D:
    name, most = "Open3D", 1_000_000

    def __init__(self, mesh, faces):
        import open3d

        self.tensor, self.faces = open3d.core.Tensor, faces
        self.scene = open3d.t.geometry.RaycastingScene(nthreads=1)
        self.scene.add_triangles(
            self.tensor(np.asarray(mesh.vertices, np.float32)),
            self.tensor(np.asarray(mesh.faces, np.uint32)),
        )

    def distances(self, points):
        query = self.tensor(points.astype(np.float32))
        found = self.scene.compute_closest_points(query, nthreads=1)
        to = found["points"].numpy().astype(np.float64)
        triangle = found["primitive_ids"].numpy().astype(np.int64)
        return np.linalg.norm(points - to, axis=1), triangle // self.faces


def mesh_of(p0, p1, r):
    import trimesh

    parts = [
        trimesh.creation.cylinder(radius=c, segment=[a, b], sections=FACETS)
        for a, b, c in zip(p0, p1, r, strict=True)
    ]
    return trimesh.util.concatenate(parts), len(parts[0].faces)


def rivals(shapes):
    try:
        mesh = mesh_of(*shapes)
    except ImportError as missing:
        print(f"no mesh: {missing}", file=sys.stderr)
        return
    for make in (Open3D, Trimesh):
        try:
            yield make(*mesh)
        except ImportError as missing:
            print(f"{make.name}: {missing}", file=sys.stderr)


# ------------------------------------------------------------------- input --


def forest(n, random):
    """Cylinders in a unit cube."""
    p0 = random.random((n, 3))
    p1 = p0 + random.normal(size=(n, 3)) * 0.02
    return p0, p1, random.uniform(0.0005, 0.004, n)


def scan(shapes, n, random):
    """Points as of a scanner: near the lateral surfaces, in random order."""
    p0, p1, r = shapes
    i = random.integers(len(r), size=n)
    axis = p1[i] - p0[i]
    across = np.cross(axis, random.normal(size=(n, 3)))
    across /= np.linalg.norm(across, axis=1)[:, None]
    off = r[i] * (1 + random.normal(size=n) * 0.1)
    return p0[i] + random.random((n, 1)) * axis + across * off[:, None]


# -------------------------------------------------------------------- time --


def nanoseconds(call, n):
    best = np.inf
    for _ in range(3):
        start = time.process_time()
        answer = call()
        best = min(best, time.process_time() - start)
    return 1e9 * best / n, answer


def ask_program(shapes, points, program, folder):
    """Nanoseconds a point, indices and distances of the C library."""
    p0, p1, r = shapes
    np.concatenate([p0, p1, r[:, None]], 1).tofile(folder / "shapes")
    points.tofile(folder / "points")
    command = [program, "-p"] + [
        folder / file for file in ("shapes", "points", "answers")
    ]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    answers = np.fromfile(folder / "answers").reshape(-1, 2)
    return float(done.stdout), answers[:, 0].astype(int), answers[:, 1]


def package(name, ask, shapes, points, program, folder):
    """A row: times of C and of the package in turn, since others may load the
    machine.  Returns whether the answers are the same."""
    c, python, n = np.inf, np.inf, len(points)
    for _ in range(3):
        spent, index, distance = ask_program(shapes, points, program, folder)
        c = min(c, spent)
        spent, answer = nanoseconds(ask, n)
        python = min(python, spent)
    same = np.array_equal(answer.distance, distance)
    if hasattr(answer, "index"):
        same = same and np.array_equal(answer.index, index)
    print(
        f"| {name} | {c:,.0f} | {python:,.0f} | {python / c:.2f} |"
        f"{'' if same else ' NOT THE ANSWERS OF C'}",
        flush=True,
    )
    return same


def packages(n, random, program, folder):
    print(f"| {n} points | C, ns a point | Python | Python / C |")
    print("|---|---|---|---|")
    one = np.zeros((1, 3)), np.array([[0.0, 0, 1]]), np.array([0.5])
    rod = cylint.cylinder(*one)[0]
    points = random.normal(size=(n, 3))
    same = package(
        "one cylinder: `closest()`",
        lambda: rod.closest(points, threads=1),
        one,
        points,
        program,
        folder,
    )
    for count in (5_000, 100_000):
        shapes = forest(count, random)
        scene = cylint.Scene(cylint.cylinder(*shapes))
        anywhere = random.random((n, 3))
        same &= package(
            f"{count:,} cylinders: `Scene.closest()`",
            lambda s=scene, p=anywhere: s.closest(p, threads=1),
            shapes,
            anywhere,
            program,
            folder,
        )
    print()
    return same


def compare(name, points, shapes, program, folder):
    spent, index, distance = ask_program(shapes, points, program, folder)
    exact = abs(distance)
    print(f"| {name}: C, cylint_scene_closest() | {spent:,.0f} | 0 | 0 | 0 |")
    for rival in rivals(shapes):
        some = points[: rival.most]
        n = len(some)
        spent, (found, number) = nanoseconds(
            lambda r=rival, p=some: r.distances(p), n
        )
        error = abs(found - exact[:n]) / shapes[2][index[:n]]
        print(f"| {name}: {rival.name} | {spent:,.0f} | {np.median(error):.1g}"
              f" | {error.max():.1g} | {100 * (number != index[:n]).mean():.2g} %"
              " |", flush=True)


def main(program, folder, n=100_000):
    folder, n = Path(folder), int(n)
    folder.mkdir(parents=True, exist_ok=True)
    random = np.random.default_rng(1)
    same = packages(10 * n, random, program, folder)
    shapes = forest(5000, random)
    print("| 5000 cylinders | ns a point | median error, radii | largest |"
          " wrong cylinder |")
    print("|---|---|---|---|---|")
    for name, points in (
        ("on the bark", scan(shapes, n, random)),
        ("anywhere", random.random((n, 3))),
    ):
        compare(name, points, shapes, program, folder)
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
