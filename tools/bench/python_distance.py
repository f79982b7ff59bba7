"""Time and error of distances of points from many cylinders: C and rivals.

usage: python_distance.py PROGRAM FOLDER [POINTS]

PROGRAM is python_scene; FOLDER is for its input.  The rivals get the same
cylinders as meshes of 64 facets around.  Rivals that are not installed are left
out.  Writes a table of tools/bench/README.md.  Times are processor time of one
thread, the least of three.
"""

import subprocess
import sys
import time
from pathlib import Path

import numpy as np

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


def compare(name, points, shapes, program, folder):
    points.tofile(folder / "points")
    command = [program, "-p"] + [
        folder / file for file in ("shapes", "points", "answers")
    ]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    answers = np.fromfile(folder / "answers").reshape(-1, 2)
    index, exact = answers[:, 0].astype(int), abs(answers[:, 1])
    print(f"| {name}: C, cylint_scene_closest() | {float(done.stdout):,.0f}"
          " | 0 | 0 | 0 |")
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
    shapes = forest(5000, random)
    p0, p1, r = shapes
    np.concatenate([p0, p1, r[:, None]], 1).tofile(folder / "shapes")
    print("| 5000 cylinders | ns a point | median error, radii | largest |"
          " wrong cylinder |")
    print("|---|---|---|---|---|")
    for name, points in (
        ("on the bark", scan(shapes, n, random)),
        ("anywhere", random.random((n, 3))),
    ):
        compare(name, points, shapes, program, folder)
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
