"""Scene: equal to loops and to the command; files, copies, messages."""

import copy
import functools
import gc
import os
import pickle
from pathlib import Path
from subprocess import CalledProcessError

import numpy as np
import pytest
from conftest import equal, forest, rays, records, refused, same

import libcylint as cylint

UNIT = ([0, 0, 0], [0, 0, 1])


@pytest.mark.parametrize("n", [128, 384, 1000])
def test_more_shapes_at_one_line_or_point_than_a_buffer_holds(n):
    x = np.arange(float(n))
    p0 = np.c_[x, 0 * x, 0 * x]
    scene = cylint.Scene(cylint.cylinder(p0, p0 + [0, 0, 1], 0.25))
    every = scene.all([-1, 0, 0.5], [1, 0, 0])
    assert every.index.tolist() == list(range(n))
    assert same(every.t, np.c_[x + 0.75, x + 1.25])
    near = scene.within([-1, 0, 0.5], [n // 2, np.inf])
    assert near.point.tolist() == [0] * (n // 2) + [1] * n
    assert near.index.tolist() == [*range(n // 2), *range(n)]
    assert same(near.distance[n // 2 :], x + 0.75)


@pytest.mark.parametrize("n", [511, 512, 513])  # a block has 512 elements
@pytest.mark.parametrize("axis", [0, 1])
def test_answers_are_in_the_order_of_lines_and_points(n, axis):
    scene, (o, d) = cylint.Scene(forest(50, 71)), rays(n, 72)

    def answers(o, d, x):
        near = scene.nearest(o, d, tmax=4 * x)
        yield near.index.reshape(-1), near.t.reshape(-1)
        yield from (scene.within(o, x), scene.all(o, d, tmax=4 * x))
        yield scene.pieces(o, d, tmax=4 * x)

    o, d = (np.expand_dims(a, axis) for a in (o, d))
    x = np.expand_dims([0.25, 0.5], 1 - axis)
    wide = [np.repeat(a, 2, axis) for a in (o, d)]
    flat = [a.reshape(-1, 3) for a in wide] + [np.repeat(x, n, 1 - axis).reshape(-1)]
    for table, row in zip(answers(wide[0], d, x), answers(*flat), strict=True):
        assert len(table[0]) > n / 8
        assert all(same(a, b) for a, b in zip(table, row, strict=True))


def test_scenes_of_nothing_and_calls_of_nothing():
    for none in (cylint.Scene(forest(4, 1)[:0]), cylint.Scene([])):
        assert len(none) == 0 and not none.any(*UNIT)
        assert none.nearest(*UNIT).index == none.closest([0, 0, 0]).index == -1
        assert none.within_count([[0, 0, 0]], 1).tolist() == [0]
        assert none.sums([[0, 0, 0]], [1, 0, 0]).tolist() == [0]
    empty = np.empty((0, 3))
    for scene in (none, cylint.Scene(forest(4, 1))):
        for found in (
            scene.all(empty, [0, 0, 1]), scene.within(empty, 1), scene.pieces(empty, empty)
        ):  # fmt: skip
            assert all(len(column) == 0 for column in found)
        assert scene.nearest(empty, UNIT[1]).point.shape == scene.closest(empty).point.shape == (0, 3)


def test_a_scene_joins_shapes_and_keeps_none_of_them():
    parts = [forest(900, 81), cylint.sphere([0.5, 0.5, 0.5], 0.1), forest(999, 82)]
    joined, (o, d) = cylint.concatenate(parts), rays(200, 5)
    hit = cylint.intersect(joined[:, None], o, d)
    for given_parts in (parts, tuple(parts), (part[...] for part in parts)):
        scene = cylint.Scene(given_parts)
        assert len(scene) == 1900 and (scene.shapes == joined).all()
        assert 65 * 1900 < scene.nbytes < 200 * 1900
    del parts, given_parts
    gc.collect()
    junk = [np.full(29_000, np.nan) for _ in range(50)]
    assert same(scene.count(o, d), (hit.n > 0).sum(axis=0)) and len(junk) == 50
    assert len(cylint.Scene(cylint.cylinder(*UNIT, 1))) == 1
    with refused("expected Shapes, found str", TypeError):
        cylint.Scene([joined, "x"])
    for shapes in (joined[:, None], [joined[:, None], joined[:, None]]):
        with refused("expected one axis"):
            cylint.Scene(shapes)


@pytest.mark.parametrize("accel", ["auto", "none"])
@pytest.mark.parametrize("leave_out", [None, "number", "label"])
def test_the_command_finds_what_a_loop_finds(command, tmp_path, accel, leave_out):
    """By every query.  The lines leave out the shapes of none, one or two of their first
    hits.  Every shape is there twice, with one label."""
    z = np.arange(600) / 8  # discs in a row
    discs = np.c_[0 * z + 3, 0 * z, z]
    row = cylint.cylinder(discs, discs + [0, 0, 0.06], 0.5)
    shapes = cylint.concatenate([forest(500, 85)[:400], row])  # no method has round cones
    number = np.repeat(np.arange(1000), 2)
    labels = [f"L{i} stick" if i % 2 else f"L{i}" for i in number]
    shapes = shapes[number].with_labels(labels)
    cylint.write_scene(tmp_path / "scene", shapes)
    o, d = rays(600, 86)
    o[:2], d[:2] = [3, 0, -5], [[0, 0, 1], [0.05, 0, 1]]
    hit = cylint.intersect(shapes[:, None], o, d, tmin=-np.inf)
    t = np.where(hit.n > 0, hit.t[..., 0], np.inf)
    assert (hit.n[:, 0] > 0).sum() == 1200
    words, first = [""] * 600, t.argsort(axis=0, kind="stable")
    for i in range(600 if leave_out else 0):
        for j in first[: min(i % 3, (t[:, i] < np.inf).sum()), i]:
            words[i] += f" not=L{number[j]}" if leave_out == "label" else f" not={j + 1}"
            t[number == number[j] if leave_out == "label" else j, i] = np.inf
    text = "".join(map("{} {}\n".format, records("line", o, d).splitlines(), words))
    options = ["-s", tmp_path / "scene", "--accel", accel]
    options += ["--not", leave_out] if leave_out else []
    counts = (t < np.inf).sum(axis=0)
    near = np.where(counts > 0, t.argmin(axis=0), -1)
    command(text, *options, shape=near + 1, t=np.where(near < 0, np.nan, t.min(axis=0)))
    command(text, *options, "-q", "count", count=counts)
    command(text, *options, "-q", "any", any=counts > 0)
    line, shape = np.nonzero((t < np.inf).T)
    command(text, *options, "-q", "all", record=line + 1, shape=shape + 1, t0=t[shape, line])
    if accel == "auto":  # a method visits the shapes one by one
        by_formula = command(text, *options, "--method=quadratic")[:, 0]
        assert (by_formula == near + 1).mean() > 0.99


def test_numbers_that_are_left_out_broadcast_and_are_checked():
    scene = cylint.Scene(cylint.sphere([[0, 0, 2], [0, 0, 6]], 1))
    near = scene.nearest(*UNIT, exclude=[[-1], [0], [1]])
    assert near.index.tolist() == [[0], [1], [0]]
    assert near.point[..., 2].tolist() == [[1], [5], [1]]
    assert scene.all(*UNIT, exclude=[[-1], [0], [1]]).line.tolist() == [0, 0, 1, 2]
    assert scene.count(*UNIT, exclude=[-1, 0]).tolist() == [2, 1]
    assert scene.count(*UNIT, exclude=np.uint64([0])).tolist() == [1]
    assert scene.any([0, 0, 0], to=[0, 0, 4], exclude=[-1, 0, 1]).tolist() == [1, 0, 1]
    near = scene.nearest([0, 0, 0], to=[0, 0, 9], exclude=near.index)
    assert near.index.tolist() == [[1], [0], [1]]
    for error, message, origins, exclude in (
        (IndexError, "exclude: found 2, the scene has 2", [0, 0, 0], 2),
        (IndexError, "exclude: found -2, the scene has 2", [0, 0, 0], -2),
        (IndexError, "exclude 1: found 7, the scene has 2", [0, 0, 0], [0, 7]),
        (ValueError, "exclude 1: found 18446744073709551615, beyond 64 bits with a sign",
         [0, 0, 0], np.uint64([0, 2**64 - 1])),
        (TypeError, "exclude: expected integers", [0, 0, 0], 1.0),
        (TypeError, "exclude: expected integers of 64 bits", [0, 0, 0], 2**70),
        (TypeError, "exclude: expected .*<U4; of texts, np.unique", [0, 0, 0], "wood"),
        (TypeError, "exclude: expected integers", [0, 0, 0], [[1.0]]),
        (ValueError, "exclude: .*inhomogeneous", [0, 0, 0], [[1], [1, 0]]),
        (ValueError, r"broadcast: lines \(2,\), exclude \(3,\)", [[0, 0, 0]] * 2, [0, 1, 0]),
    ):
        with refused(message, error):
            scene.any(origins, [0, 0, 1], exclude=exclude)
    with refused("first_boundary.* unexpected keyword argument 'exclude'", TypeError):
        scene.first_boundary(*UNIT, exclude=0)


def test_numbers_that_are_left_out_may_change_during_a_query():
    scene, (o, d) = cylint.Scene(forest(2000, 7)), rays(100_000, 8)
    exclude, calls = np.zeros(len(o), int), []

    def change(*call):
        exclude[:] = 2**40
        calls.append(call)

    counts = scene.count(o, d, exclude=exclude, threads=1, progress=change)
    assert len(calls) > 1 and counts.shape == (100_000,)


def test_refused_lines_hit_nothing_on_request():
    ball = cylint.sphere([0, 0, 0], 1)
    scene = cylint.Scene(ball)
    d = [[1, 0, 0], [np.nan, 0, 0], [0, 0, 0], [1, 0, 0]]
    lines = {"origins": [-3, 0, 0], "directions": d, "tmin": [0, 0, 0, np.inf]}
    for call in (scene.nearest, functools.partial(cylint.intersect, ball)):
        with refused("line 1: a number is not finite"):
            call(**lines)
    lines["errors"] = "mask"
    hit = cylint.intersect(ball, **lines)
    assert [cylint.Relation(r).name for r in hit.relation] == ["CROSS", "NONE", "NONE", "CROSS"]
    assert hit.n.tolist() == [2, 0, 0, 0] and (hit.part[1:] == -1).all()
    assert np.isnan(hit.t[1:]).all() and np.isnan(hit.point[1:]).all()
    near = scene.nearest(**lines)
    assert near.index.tolist() == [0, -1, -1, -1] and near.t[0] == 2
    assert all(np.isnan(member[1:]).all() for member in (near.t, near.point, near.outside))
    assert scene.count(**lines).tolist() == scene.any(**lines).tolist() == [1, 0, 0, 0]
    assert scene.all(**lines).line.tolist() == [0]
    with refused("expected raise or mask, found 'all'"):
        scene.any(*UNIT, errors="all")


def test_one_is_not_plural():
    ball = cylint.sphere([0, 0, 0], 1)
    scene = cylint.Scene(ball)
    shown = [scene, cylint.intersect(ball, *UNIT), scene.nearest(*UNIT)]
    shown += [ball.closest([0, 0, 3]), cylint.Scene([ball, ball])]
    assert [repr(x)[len("<libcylint.") : -1] for x in shown] == [
        "Scene: 1 shape", "Hits (): 1 hit", "NearestHits (): 1 hit",
        "ClosestPoints (): 1 distance", "Scene: 2 shapes",
    ]  # fmt: skip


NEURON = "# soma\n1 1 0 0 0 2 -1\n2 3 0 0 10 1 1\n3 3 0 5 20 1 2\n9 1 7 0 0 3 -1\n"


@pytest.mark.parametrize(
    ("form", "kinds", "labels"),
    [(None, "CONE CYLINDER", "2 3"), ("round", "SPHERE RCONE CAPSULE SPHERE", "1 2 3 9")],
)
def test_a_neuron_is_read_as_the_command_reads_it(command, tmp_path, form, kinds, labels):
    neuron = tmp_path / "n.swc"
    neuron.write_text(NEURON)
    shapes = cylint.read_scene(neuron, swc=form)
    assert [cylint.Kind(int(k)).name for k in shapes.kind] == kinds.split()
    assert shapes.labels.tolist() == labels.split()
    o, d = np.array([[5.0, 0, 5], [2, 0, 5], [7, 0, 9]]), np.array([[-1.0, 0, 0]] * 3)
    near = cylint.Scene(shapes).nearest(o, d)
    options = [f"--swc={form}"] if form else []
    command(
        records("ray", o, d), "-s", neuron, *options, shape=near.index + 1, t=near.t,
        part=near.part, side=near.side, x_y_z=near.point, nx_ny_nz=near.normal, h=near.z,
        phi=near.phi,
    )  # fmt: skip
    assert (cylint.read_scene(neuron, swc=form or "cones") == shapes).all()


def test_faults_of_files_are_raised(tmp_path):
    def written(name, text):
        (tmp_path / name).write_text(text)
        return tmp_path / name

    neuron, tube = written("n.swc", NEURON), written("tube", "cylinder 0 0 0 0 0 1 1\n")
    saved = tmp_path / "saved.swc"
    cylint.Scene.read(neuron, swc="round").save(saved)
    bad = written("bad.txt", "cylinder 0 0 0 0 0 1 1\nbarrel 0 0 0\n")
    for error, message, path, named in (
        (ValueError, "expected cones or round, found 'x'", neuron, {"swc": "x"}),
        (ValueError, r"n\.swc:2:1: .*no such ends", neuron, {"swc": "round", "ends": "infinite"}),
        (ValueError, r"tube:1:1: expected .*, found 'cylinder'", tube, {"swc": "round"}),
        (ValueError, r"saved\.swc: is a saved scene, not a neuron", saved, {"swc": "cones"}),
        (ValueError, r"bad\.txt:2:1: expected .*found 'barrel'", bad, {}),
        (FileNotFoundError, "none", tmp_path / "none.swc", {}),
        (OSError, "", tmp_path, {}),
    ):
        for read in (cylint.read_scene, cylint.Scene.read):
            with refused(message, error):
                read(path, **named)
    orphan = written("orphan.swc", "1 1 0 0 0 2 7\n2 3 0 0 10 1 1\n")
    for read in (cylint.read_scene, cylint.Scene.read):
        with pytest.warns(UserWarning, match="roots whose parents are not in the file: 1$") as said:
            assert len(read(orphan)) == 1
        assert said[0].filename == __file__
    assert cylint.read_scene(tube, ends="open").ends.tolist() == [cylint.Ends.OPEN]


@pytest.mark.skipif(os.name != "posix", reason="names of files are bytes on POSIX only")
def test_names_of_files_are_any_bytes(tmp_path):
    rods = cylint.cylinder([0, 0, 0], [0, 0, 1], [1, 2])
    scene, neuron = (os.fsencode(tmp_path) + b"/\xe9" + x for x in (b"", b".swc"))
    cylint.write_scene(scene, rods)
    with open(neuron, "w") as file:
        file.write(NEURON)
    for name in (scene, neuron):
        for given in (name, os.fsdecode(name), Path(os.fsdecode(name))):
            assert len(cylint.read_scene(given)) == len(cylint.Scene.read(given)) > 1
    with open(scene, "a") as file:
        file.write("barrel\n")
    with refused(r"\\xe9:3:1: expected"):
        cylint.read_scene(scene)


def labelled(n, seed):
    names = [f"röd {i % 7}" if i % 3 else "" for i in range(n)]
    return forest(n, seed).with_labels(names)


def assert_same_answers(scene, again):
    o, d = rays(200, 28)
    for query, arguments, members in (
        ("nearest", (o, d), ("index", "t", "point", "normal")), ("all", (o, d), ("t",)),
        ("closest", (o,), ("index", "distance")), ("within", (o, 0.5), ("distance",)),
    ):  # fmt: skip
        one, other = (getattr(s, query)(*arguments) for s in (scene, again))
        assert equal(one, other, *members)
    assert same(scene.count(o, d), again.count(o, d))
    assert (scene.shapes == again.shapes).all()
    assert scene.shapes.labels.tolist() == again.shapes.labels.tolist()


class Forest(cylint.Scene):
    """A scene with a name."""


def pickled(scene, protocol=None):
    return pickle.loads(pickle.dumps(scene, protocol))


@pytest.mark.parametrize("trusted", [False, np.True_])
@pytest.mark.parametrize("read", [False, np.True_])
def test_a_saved_scene_and_its_copies_give_the_same_answers(tmp_path, trusted, read):
    """After the file has been replaced and removed, too."""
    name, second = tmp_path / "saved", tmp_path / "again"
    scene = Forest(labelled(1000, 27), threads=2)
    scene.save(name)
    whole = name.read_bytes()
    again = Forest.open(name, trusted=trusted, read=read, threads=2)
    assert_same_answers(scene, again)
    cylint.Scene(forest(5, 4)).save(name)
    assert len(cylint.Scene.open(name)) == 5 and not cylint.Scene.open(name).shapes.labels.any()
    name.unlink()
    again.save(os.fspath(second))
    assert second.read_bytes() == whole and os.listdir(tmp_path) == ["again"]
    scene.name = again.name = "Bialowieza"
    copies = [pickled(again, n) for n in range(2, pickle.HIGHEST_PROTOCOL + 1)]
    copies += [again, pickled(scene), copy.copy(again), copy.deepcopy(copies[0])]
    del again, copies[0]
    for one in copies:
        assert_same_answers(scene, one)
        assert type(one) is Forest and one.name == "Bialowieza" and one._threads == 2
        assert 0 < one.nbytes < 1.2 * scene.nbytes
    none = pickled(cylint.Scene([]))
    assert len(none) == 0 and not none.any(*UNIT)


def test_the_command_and_the_package_open_the_same_files(command, tmp_path):
    text, ours, theirs = (tmp_path / x for x in ("text", "ours", "theirs"))
    shapes = labelled(200, 5)
    cylint.write_scene(text, shapes)
    cylint.Scene(shapes).save(ours)
    command("", "--save", theirs, "-s", text)
    assert ours.read_bytes() == theirs.read_bytes()
    for read in (
        cylint.read_scene(ours), cylint.Scene.read(ours).shapes, cylint.Scene.open(theirs).shapes,
        cylint.Scene.read(text).shapes,
    ):  # fmt: skip
        assert (read == shapes).all() and read.labels.tolist() == shapes.labels.tolist()
    with refused("ours: is a saved scene"):
        cylint.read_scene(ours, ends="open")
    for label in "two\nlines", "nul\0byte":  # no row of text has these
        cylint.Scene(shapes.with_labels(["one line"] * 199 + [label])).save(ours)
        with refused("exit status 1", CalledProcessError) as error:
            command("point 0 0 0\n", "-s", ours)
        assert "ours: shape 200: its label has a line feed or NUL" in error.value.stderr
    for label, clause in (("ends=open", 1), ("", 10**9)):  # text cannot hold these
        scene = cylint.Scene(shapes[:1].with_labels([label]))
        scene.set_solids(0, 0, [clause])
        scene.save(ours)
        with refused("exit status 1", CalledProcessError):
            command("", "-s", ours, "--text")


def test_files_that_are_no_saved_scenes_are_refused(tmp_path):
    name, bad, five = tmp_path / "saved", tmp_path / "bad", cylint.Scene(forest(5, 1))
    cylint.Scene(forest(50, 6)).save(name)

    def spoiled(data, at):
        return data[:at] + bytes([data[at] ^ 1]) + data[at + 1 :]

    data = name.read_bytes()
    for content, reason in (
        (data[:-64], "damaged"), (spoiled(data, 3000), "damaged"),
        (data[:8] + b"\xff" + data[9:], "another version or machine"),
        (b"cylinder 0 0 0 0 0 1 1\n", "not a saved scene"), (b"", "not a saved scene"),
    ):  # fmt: skip
        bad.write_bytes(content)
        for read in (False, True):
            with refused(f"bad: .*{reason}"):
                cylint.Scene.open(bad, read=read)
    pickled = pickle.dumps(cylint.Scene(forest(50, 6)))
    for error, message, call, given_value in (
        (FileNotFoundError, "missing", cylint.Scene.open, tmp_path / "missing"),
        (OSError, "", cylint.Scene.open, tmp_path),
        (FileNotFoundError, "missing", five.save, tmp_path / "missing" / "scene"),
        (OSError, "", five.save, tmp_path),
        (ValueError, "null byte", cylint.Scene.open, "a\0b"),
        (ValueError, "null byte", five.save, "a\0b"),
        (ValueError, "at least 1", lambda file: cylint.Scene.open(file, threads=0), name),
        (ValueError, "pickled scene: the file is damaged", pickle.loads,
         spoiled(pickled, len(pickled) // 2)),
    ):  # fmt: skip
        with refused(message, error):
            call(given_value)
