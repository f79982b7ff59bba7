"""Time and wrong answers of the Python package and of its rivals.

usage: python_rays.py PROGRAM FOLDER [LINES]

PROGRAM is python_scene, which asks the C library the same questions; FOLDER is
for its input.  Rivals that are not installed are left out.  Writes the tables of
tools/bench/README.md, "From Python".  Times of one thread are processor time, of
two elapsed time, each the least of several repetitions.
"""

import subprocess
import sys
import time
from pathlib import Path

import numpy as np

import libcylint as cylint

RADIUS = 0.5
AXIS = np.array([[0.0, 0, 0], [0, 0, 1]])


# ------------------------------------------------------------------ rivals --
# A rival is made of cylinders p0, p1 (n, 3) and r (n).  verdicts() returns
# whether each ray hits; nearest() the number of the first cylinder, -1 for none.


class ScikitSpatial:
    name, most = "scikit-spatial", 2_000

    def __init__(self, p0, p1, r):
        from skspatial.objects import Cylinder, Line

        self.line = Line
        self.shapes = [
            Cylinder(a, b - a, float(c))
            for a, b, c in zip(p0, p1, r, strict=True)
        ]

    def verdicts(self, o, d):
        return np.array([self.hits(*ray) for ray in zip(o, d, strict=True)])

    def hits(self, o, d):
        try:
            self.shapes[0].intersect_line(self.line(o, d), infinite=False)
        except ValueError:
            return False
        return True


class Trimesh:
    name, most = "trimesh with embreex", 300_000

    def __init__(self, p0, p1, r):
        import embreex  # noqa: F401  trimesh is slow without it
        import trimesh

        parts = [
            trimesh.creation.cylinder(radius=c, segment=[a, b])
            for a, b, c in zip(p0, p1, r, strict=True)
        ]
        self.faces = len(parts[0].faces)
        self.mesh = trimesh.util.concatenate(parts)

    def verdicts(self, o, d):
        return self.mesh.ray.intersects_any(o, d)

    def both(self, o, d):
        return self.mesh.ray.intersects_location(o, d)

    def nearest(self, o, d):
        triangle = self.mesh.ray.intersects_first(o, d)
        return np.where(triangle < 0, -1, triangle // self.faces)


class Open3D:
    name, most, facets = "Open3D", 1_000_000, 32

    def __init__(self, p0, p1, r):
        import open3d
        import trimesh

        self.o3 = open3d.core
        parts = [
            trimesh.creation.cylinder(
                radius=c, segment=[a, b], sections=self.facets
            )
            for a, b, c in zip(p0, p1, r, strict=True)
        ]
        self.faces = len(parts[0].faces)
        mesh = trimesh.util.concatenate(parts)
        self.scene = open3d.t.geometry.RaycastingScene(nthreads=1)
        self.scene.add_triangles(
            self.o3.Tensor(np.asarray(mesh.vertices, np.float32)),
            self.o3.Tensor(np.asarray(mesh.faces, np.uint32)),
        )

    def cast(self, o, d):
        rays = np.concatenate([o, d], axis=1).astype(np.float32)
        return self.scene.cast_rays(self.o3.Tensor(rays), nthreads=1)

    def verdicts(self, o, d):
        return np.isfinite(self.cast(o, d)["t_hit"].numpy())

    def nearest(self, o, d):
        triangle = self.cast(o, d)["primitive_ids"].numpy().astype(np.int64)
        return np.where(triangle == 0xFFFFFFFF, -1, triangle // self.faces)


class Open3DCoarse(Open3D):
    name, facets = "Open3D, 16 facets", 16


class Vtk:
    name, most = "VTK", 20_000

    def __init__(self, p0, p1, r):
        import vtk

        join = vtk.vtkAppendPolyData()
        for a, b, c in zip(p0, p1, r, strict=True):
            line = vtk.vtkLineSource()
            line.SetPoint1(*a)
            line.SetPoint2(*b)
            tube = vtk.vtkTubeFilter()
            tube.SetInputConnection(line.GetOutputPort())
            tube.SetRadius(float(c))
            tube.SetNumberOfSides(32)
            tube.CappingOn()
            triangles = vtk.vtkTriangleFilter()
            triangles.SetInputConnection(tube.GetOutputPort())
            triangles.Update()
            join.AddInputData(triangles.GetOutput())
            self.faces = triangles.GetOutput().GetNumberOfCells()
        join.Update()
        self.locator = vtk.vtkStaticCellLocator()
        self.locator.SetDataSet(join.GetOutput())
        self.locator.BuildLocator()
        self.vtk = vtk

    def nearest(self, o, d):
        t, x, at = self.vtk.reference(0.0), [0.0] * 3, [0.0] * 3
        part, cell = self.vtk.reference(0), self.vtk.reference(0)
        found = np.empty(len(o), np.int64)
        for i, (a, b) in enumerate(zip(o, o + 4 * d, strict=True)):
            hit = self.locator.IntersectWithLine(
                a, b, 0.0, t, x, at, part, cell
            )
            found[i] = int(cell) // self.faces if hit else -1
        return found

    def verdicts(self, o, d):
        return self.nearest(o, d) >= 0


def rivals(shapes):
    for make in (Trimesh, Open3D, Open3DCoarse, Vtk, ScikitSpatial):
        try:
            yield make(*shapes)
        except ImportError as missing:
            print(f"{make.name}: {missing}", file=sys.stderr)


# ------------------------------------------------------------------- input --


def rays_of(family, n, random):
    """Rays at the cylinder 0 0 0  0 0 1  0.5 that start outside."""
    if family == "half of the rays hit":
        o = random.normal(size=(n, 3)) * 3 + [6, 0, 0]
        target = random.uniform(-0.7, 0.7, (n, 3)) + [0, 0, 0.5]
        return o, target - o
    angle = random.uniform(0, 2 * np.pi, n)
    across = np.c_[np.cos(angle), np.sin(angle), np.zeros(n)]
    along = np.c_[-np.sin(angle), np.cos(angle), random.normal(size=n) * 0.1]
    off = 10.0 ** random.uniform(-12, -3, n) * random.choice([-1, 1], n)
    start = 2 if family == "grazing" else 10.0 ** random.uniform(3, 6, n)
    at = np.c_[np.zeros((n, 2)), random.uniform(0.3, 0.7, n)]
    if family != "grazing":
        off = random.uniform(-2, 1, n)
    points = at + across * (RADIUS * (1 + off))[:, None]
    length = np.broadcast_to(start, n)[:, None]
    return points - along * length, along * length


def forest(n, random):
    p0 = random.random((n, 3))
    p1 = p0 + random.normal(size=(n, 3)) * 0.02
    return p0, p1, random.uniform(0.0005, 0.004, n)


def rays_in(n, random):
    o = random.uniform(-0.5, 1.5, (n, 3))
    return o, random.random((n, 3)) - o


def beams(n):
    """Of a scanner in the middle, line by line."""
    across = int(n**0.5)
    turn = np.linspace(0, 2 * np.pi, across, endpoint=False)
    rise = np.radians(np.linspace(75, -75, across))[:, None]
    d = np.stack(
        np.broadcast_arrays(
            np.cos(rise) * np.cos(turn),
            np.cos(rise) * np.sin(turn),
            np.sin(rise),
        ),
        axis=-1,
    ).reshape(-1, 3)
    return np.full_like(d, 0.5), d


# -------------------------------------------------------------------- time --


def least(call, clock, rounds=5):
    best = np.inf
    for _ in range(rounds):
        start = clock()
        answer = call()
        best = min(best, clock() - start)
    return best, answer


def nanoseconds(call, n, clock=time.process_time, rounds=5):
    spent, answer = least(call, clock, rounds)
    return 1e9 * spent / n, answer


def show(value):
    return f"{value:,.0f}" if value >= 100 else f"{value:.0f}"


def one_cylinder(n, random):
    rod = cylint.cylinder(*AXIS, RADIUS)
    o, d = rays_of("half of the rays hit", n, random)
    families = {
        name: rays_of(name, 20_000, random)
        for name in ("half of the rays hit", "grazing", "far")
    }
    print("| one cylinder | ns a ray | wrong: half hit | grazing | far |")
    print("|---|---|---|---|---|")
    one, hit = nanoseconds(lambda: cylint.intersect(rod, o, d, threads=1), n)
    two, _ = nanoseconds(
        lambda: cylint.intersect(rod, o, d, threads=2), n, time.perf_counter
    )
    print(f"| cylint: relation, both t, parts | {one:.0f} | 0 | 0 | 0 |")
    print(f"| cylint, two threads | {two:.0f} | 0 | 0 | 0 |")
    share = (hit.n > 0).mean()
    for rival in rivals((AXIS[:1], AXIS[1:], [RADIUS])):
        m = min(n, rival.most)
        ask = getattr(rival, "both", rival.verdicts)
        spent, _ = nanoseconds(lambda: ask(o[:m], d[:m]), m, rounds=3)
        wrong = []
        for fo, fd in families.values():
            k = min(len(fo), rival.most)
            truth = cylint.intersect(rod, fo[:k], fd[:k]).n > 0
            wrong.append((rival.verdicts(fo[:k], fd[:k]) != truth).mean())
        shares = " | ".join(f"{100 * w:.2g} %" for w in wrong)
        print(f"| {rival.name} | {show(spent)} | {shares} |", flush=True)
    print(f"\n{n} rays, {100 * share:.0f} % hit.\n")


def one_scene(made, o, d, program, folder):
    n, shapes = len(o), len(made[0])
    np.concatenate([made[0], made[1], made[2][:, None]], 1).tofile(
        folder / "shapes"
    )
    np.concatenate([o, d], axis=1).tofile(folder / "rays")
    scene = cylint.Scene(cylint.cylinder(*made))
    one, two, c = np.inf, np.inf, np.inf
    for _ in range(4):  # in turn, since others may load the machine
        spent, near = nanoseconds(
            lambda: scene.nearest(o, d, threads=1), n, rounds=2
        )
        one = min(one, spent)
        both, _ = nanoseconds(
            lambda: scene.nearest(o, d, threads=2), n, time.perf_counter, 2
        )
        two = min(two, both)
        command = [
            program,
            folder / "shapes",
            folder / "rays",
            folder / "answers",
        ]
        done = subprocess.run(
            command, check=True, capture_output=True, text=True
        )
        c = min(c, float(done.stdout))
    answers = np.fromfile(folder / "answers").reshape(-1, 2)
    same = np.array_equal(answers[:, 0], near.index) and np.array_equal(
        answers[:, 1], near.t, equal_nan=True
    )
    share = (near.index >= 0).mean()
    print(
        f"| {shapes} cylinders, {100 * share:.0f} % hit | ns a ray | wrong shape |"
    )
    print("|---|---|---|")
    print(f"| C, cylint_scene_nearest() | {c:.0f} | 0 |")
    print(f"| cylint: index, t, part | {one:.0f} ({one / c:.2f} of C) | 0 |")
    print(
        f"| cylint, two threads | {two:.0f} ({one / two:.2f} times one) | 0 |"
    )
    for rival in rivals(made):
        if hasattr(rival, "nearest"):
            m = min(n, rival.most)
            spent, index = nanoseconds(
                lambda: rival.nearest(o[:m], d[:m]), m, rounds=3
            )
            wrong = 100 * (index != near.index[:m]).mean()
            print(
                f"| {rival.name} | {show(spent)} | {wrong:.2g} % |", flush=True
            )
    print(
        f"\n{n} rays; {'the same bits as C' if same else 'NOT THE ANSWERS OF C'}."
    )
    return same


def main(program, folder, n=1_000_000):
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    random = np.random.default_rng(1)
    one_cylinder(int(n), random)
    made = forest(5000, random)
    same = True
    for rays in (rays_in(int(n), random), beams(int(n))):
        same &= one_scene(made, *rays, program, folder)
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
