"""Scene: equal to brute force and to the command."""

import copy
import os
import pickle

import numpy as np
import pytest
from conftest import forest, hexadecimal, numbers, same, text_of, written_rods
from hypothesis import given, settings
from hypothesis import strategies as st

import libcylint as cylint


def rays(n, seed):
    random = np.random.default_rng(seed)
    o = random.uniform(-1, 2, (n, 3))
    return o, random.random((n, 3)) - o


def brute_force(shapes, o, d, **domain):
    hit = cylint.intersect(shapes[:, None], o, d, **domain)
    t = np.where(hit.n > 0, hit.t[..., 0], np.inf)
    index = np.where(hit.n.any(axis=0), t.argmin(axis=0), -1)
    return hit, index


@given(st.integers(0, 2**32), st.integers(0, 300), st.integers(0, 60))
def test_a_scene_equals_brute_force(seed, n, lines):
    shapes = forest(n, seed)
    o, d = rays(lines, seed)
    scene = cylint.Scene(shapes)
    if n == 0:
        assert (scene.nearest(o, d).index == -1).all()
        return
    hit, index = brute_force(shapes, o, d, tmin=0.1, tmax=1.1)
    near = scene.nearest(o, d, 0.1, 1.1)
    assert np.array_equal(near.index, index)
    found = index >= 0
    column = np.flatnonzero(found)
    assert same(near.t[found], hit.t[index[found], column, 0])
    assert np.array_equal(near.part[found], hit.part[index[found], column, 0])
    assert np.isnan(near.t[~found]).all() and (near.part[~found] == -1).all()
    assert np.array_equal(scene.count(o, d, 0.1, 1.1), (hit.n > 0).sum(axis=0))
    assert np.array_equal(scene.any(o, d, 0.1, 1.1), found)
    line, shape = np.nonzero((hit.n > 0).T)
    every = scene.all(o, d, 0.1, 1.1)
    assert np.array_equal(every.line, line) and np.array_equal(
        every.index, shape
    )
    assert same(every.t, hit.t[shape, line])


def test_lazy_members_are_those_of_the_nearest_shape():
    shapes, (o, d) = forest(400, 21), rays(500, 22)
    near = cylint.Scene(shapes).nearest(o, d)
    found = near.index >= 0
    assert 50 < found.sum() < 500
    hit = cylint.intersect(shapes[near.index[found]], o[found], d[found])
    for member in (
        "point",
        "normal",
        "z",
        "phi",
        "side",
        "outside",
        "inside",
    ):
        value = getattr(near, member)
        assert np.array_equal(value[found], getattr(hit, member)[:, 0])
        none = value[~found]
        assert (none == -1).all() if member == "side" else np.isnan(none).all()


def test_1e5_rays_equal_the_command(command, tmp_path):
    n, lines = 2000, 100_000
    path = tmp_path / "scene"
    rods = written_rods(n, np.random.default_rng(23), path)
    o, d = rays(lines, 24)
    text = text_of(["ray"] * lines, hexadecimal(o), hexadecimal(d))
    fields = command(text, "-s", str(path), "-f", "shape,t")
    near = cylint.Scene(rods).nearest(o, d)
    value = numbers([[f[1]] for f in fields])[:, 0]
    assert np.array_equal([int(f[0]) - 1 for f in fields], near.index)
    assert same(value, near.t)
    assert 50_000 < np.count_nonzero(near.index >= 0) < 95_000


def test_lines_of_several_axes():
    scene = cylint.Scene(forest(300, 25))
    o, d = rays(60, 26)
    flat = scene.nearest(o, d)
    table = scene.nearest(o.reshape(3, 20, 3), d.reshape(3, 20, 3))
    assert np.array_equal(table.index, flat.index.reshape(3, 20))
    assert table.point.shape == (3, 20, 3)
    spread = scene.nearest(o[:, None], d[:5])
    assert spread.index.shape == (60, 5)
    assert spread.index[7, 2] == scene.nearest(o[7], d[2]).index
    every, one = scene.all(o[:, None], d[:5]), scene.all(o[7], d[2])
    chosen = every.line == 7 * 5 + 2
    assert np.array_equal(every.index[chosen], one.index)


def test_equal_t_goes_to_the_lower_number():
    rod = cylint.cylinder([0, 0, 0], [0, 0, 1], 1)
    scene = cylint.Scene(cylint.concatenate([rod] * 20))
    assert scene.nearest([-5, 0, 0.5], [1, 0, 0]).index == 0
    assert scene.all([-5, 0, 0.5], [1, 0, 0]).index.tolist() == list(range(20))


def test_more_hits_of_one_line_than_a_buffer_holds():
    x = np.arange(1000.0)
    p0 = np.c_[x, 0 * x, 0 * x]
    scene = cylint.Scene(cylint.cylinder(p0, p0 + [0, 0, 1], 0.25))
    every = scene.all([-1, 0, 0.5], [1, 0, 0])
    assert every.index.tolist() == list(range(1000))
    assert np.array_equal(every.t, np.c_[x + 0.75, x + 1.25])


def test_scenes_of_nothing_and_of_one():
    none = cylint.Scene(forest(4, 1)[:0])
    assert none.nearest([0, 0, 0], [0, 0, 1]).index == -1
    assert not none.any([0, 0, 0], [0, 0, 1])
    assert len(none.all(np.empty((0, 3)), [0, 0, 1]).line) == 0
    one = cylint.Scene(cylint.cylinder([0, 0, 0], [0, 0, 1], 1))
    assert one.nearest([0, 0, -2], [0, 0, 1]).t == 2
    with pytest.raises(ValueError, match="expected one axis"):
        cylint.Scene(forest(4, 1)[:, None])


def test_a_scene_joins_lists_of_shapes():
    parts = [forest(20, 81), cylint.sphere([0.5, 0.5, 0.5], 0.1), forest(9, 82)]
    joined = cylint.concatenate(parts)
    for given in (parts, tuple(parts), iter(parts)):
        scene = cylint.Scene(given)
        assert len(scene) == 30 and (scene.shapes == joined).all()
    assert len(cylint.Scene([])) == 0
    with pytest.raises(TypeError, match="expected Shapes, found str"):
        cylint.Scene([parts[0], "x"])
    with pytest.raises(ValueError, match="expected one axis"):
        cylint.Scene([parts[0][:, None], parts[0][:, None]])


@settings(max_examples=settings().max_examples // 4)
@given(st.integers(0, 2**32))
def test_lines_leave_out_their_shapes(seed):
    shapes, (o, d) = forest(200, seed), rays(60, seed)
    unbounded = cylint.tangent_cone(
        [0.5, 0.5, 0.5], [[0, 0, 1], [0, 1, 0]], 0.3
    )
    shapes = cylint.concatenate([shapes[:70], unbounded, shapes[70:]])
    scene = cylint.Scene(shapes)
    hit, index = brute_force(shapes, o, d)
    random = np.random.default_rng(seed)
    # the nearest shape, another that is hit, any, none
    for exclude in (
        index,
        np.where(hit.n.any(axis=0), 201 - (hit.n > 0)[::-1].argmax(axis=0), -1),
        random.integers(-1, 202, 60),
        np.int8(-1),
    ):
        left = (hit.n > 0) & (np.arange(202)[:, None] != exclude)
        t = np.where(left, hit.t[..., 0], np.inf)
        want = np.where(left.any(axis=0), t.argmin(axis=0), -1)
        near = scene.nearest(o, d, exclude=exclude)
        assert np.array_equal(near.index, want)
        assert same(near.t, np.where(want < 0, np.nan, t[want, np.arange(60)]))
        point = hit.point[want, np.arange(60), 0]
        assert same(near.point, np.where(want[:, None] < 0, np.nan, point))
        assert np.array_equal(scene.any(o, d, exclude=exclude), want >= 0)
        counts = scene.count(o, d, exclude=exclude)
        assert np.array_equal(counts, left.sum(axis=0))
        every = scene.all(o, d, exclude=exclude)
        line, shape = np.nonzero(left.T)
        assert np.array_equal(every.line, line)
        assert np.array_equal(every.index, shape)


def test_numbers_that_are_left_out_broadcast_and_are_checked():
    balls = cylint.sphere([[0, 0, 2], [0, 0, 6]], 1)
    scene = cylint.Scene(balls)
    near = scene.nearest([0, 0, 0], [0, 0, 1], exclude=[[-1], [0], [1]])
    assert near.index.tolist() == [[0], [1], [0]]
    assert near.point[..., 2].tolist() == [[1], [5], [1]]
    every = scene.all([0, 0, 0], [0, 0, 1], exclude=[[-1], [0], [1]])
    assert every.line.tolist() == [0, 0, 1, 2]
    near = scene.nearest([0, 0, 0], to=[0, 0, 9], exclude=near.index)
    assert near.index.tolist() == [[1], [0], [1]]
    with pytest.raises(IndexError, match="exclude: found 2, the scene has 2"):
        scene.any([0, 0, 0], [0, 0, 1], exclude=2)
    with pytest.raises(TypeError, match="exclude: expected integers"):
        scene.any([0, 0, 0], [0, 0, 1], exclude=1.0)
    with pytest.raises(
        ValueError, match=r"broadcast: lines \(2,\), exclude \(3,\)"
    ):
        scene.any([[0, 0, 0]] * 2, [0, 0, 1], exclude=[0, 1, 0])


def test_refused_lines_hit_nothing_on_request():
    scene = cylint.Scene(forest(300, 83))
    o, d = rays(400, 84)
    spoiled, start = d.copy(), np.zeros(400)
    spoiled[::7] = np.nan
    spoiled[3::50] = 0
    start[5::60] = np.inf
    bad = np.isnan(spoiled).any(-1) | (spoiled == 0).all(-1) | (start > 1)
    with pytest.raises(ValueError, match="line 0: a number is not finite"):
        scene.nearest(o, spoiled, start)
    want = scene.nearest(o, d)
    near = scene.nearest(o, spoiled, start, errors="mask")
    assert np.array_equal(near.index, np.where(bad, -1, want.index))
    assert same(near.t, np.where(bad, np.nan, want.t))
    assert same(near.point, np.where(bad[:, None], np.nan, want.point))
    assert same(near.outside, np.where(bad[:, None], np.nan, want.outside))
    counts = scene.count(o, spoiled, start, errors="mask")
    assert np.array_equal(counts, np.where(bad, 0, scene.count(o, d)))
    assert np.array_equal(
        scene.any(o, spoiled, start, errors="mask"), scene.any(o, d) & ~bad
    )
    every = scene.all(o, spoiled, start, errors="mask")
    assert not bad[every.line].any() and len(every.line) == counts.sum()
    ends = np.where(bad[:, None], np.nan, o + d)
    near = scene.nearest(o, to=ends, errors="mask")
    assert np.array_equal(
        near.index, np.where(bad, -1, scene.nearest(o, to=o + d).index)
    )
    with pytest.raises(ValueError, match="expected raise or mask, found 'all'"):
        scene.any(o, d, errors="all")


def test_one_is_not_plural():
    ball = cylint.sphere([0, 0, 0], 1)
    scene, line = cylint.Scene(ball), ([0, 0, 0], [0, 0, 1])
    shown = [scene, cylint.intersect(ball, *line), scene.nearest(*line)]
    shown += [ball.closest([0, 0, 3]), cylint.Scene([ball, ball])]
    assert [repr(x) for x in shown] == [
        "<libcylint.Scene: 1 shape>",
        "<libcylint.Hits (): 1 hit>",
        "<libcylint.NearestHits (): 1 hit>",
        "<libcylint.ClosestPoints (): 1 distance>",
        "<libcylint.Scene: 2 shapes>",
    ]


def test_a_scene_is_pickled_with_its_shapes():
    scene = cylint.Scene(forest(100, 27), threads=1)
    again = pickle.loads(pickle.dumps(scene))
    o, d = rays(100, 28)
    assert same(scene.nearest(o, d).t, again.nearest(o, d).t)
    assert len(again) == 100 and 0 < again.nbytes < 1.1 * scene.nbytes


def test_a_neuron_is_read_as_the_command_reads_it(command, tmp_path):
    neuron = tmp_path / "n.swc"
    neuron.write_text(
        "# soma\n1 1 0 0 0 2 -1\n2 3 0 0 10 1 1\n3 3 0 5 20 1 2\n"
    )
    shapes = cylint.read_scene(neuron)
    assert shapes.kind.tolist() == [cylint.Kind.CONE, cylint.Kind.CYLINDER]
    assert shapes.labels.tolist() == ["2", "3"] and shapes.r1.tolist() == [2, 1]
    near = cylint.Scene(shapes).nearest([5, 0, 5], [-1, 0, 0])
    (answer,) = command(
        "ray 5 0 5 -1 0 0\n", "-s", str(neuron), "-f", "shape,t"
    )
    assert (
        int(answer[0]) - 1 == near.index and float.fromhex(answer[1]) == near.t
    )


def test_a_neuron_is_round_on_request(command, tmp_path):
    neuron = tmp_path / "n.swc"
    neuron.write_text("1 1 0 0 0 2 -1\n2 3 0 0 10 1 1\n9 1 7 0 0 3 -1\n")
    shapes = cylint.read_scene(neuron, swc="round")
    assert shapes.kind.tolist() == [
        cylint.Kind.SPHERE,
        cylint.Kind.RCONE,
        cylint.Kind.SPHERE,
    ]
    near = cylint.Scene(shapes).nearest([2, 0, 5], [-1, 0, 0])
    (answer,) = command(
        "ray 2 0 5 -1 0 0\n", "-s", str(neuron), "--swc=round", "-f", "shape,t"
    )
    assert (
        int(answer[0]) - 1 == near.index and float.fromhex(answer[1]) == near.t
    )
    assert len(cylint.read_scene(neuron, swc="cones")) == 1
    with pytest.raises(ValueError, match="expected cones or round, found 'x'"):
        cylint.read_scene(neuron, swc="x")
    with pytest.raises(ValueError, match=r"n\.swc:1:1: .*no such ends"):
        cylint.read_scene(neuron, swc="round", ends="infinite")
    text = tmp_path / "text"
    text.write_text("sphere 0 0 0 1\n")
    with pytest.raises(ValueError, match=r"swc: not a neuron, \*\.swc: .*text"):
        cylint.read_scene(text, swc="round")


def test_faults_of_files_are_raised(tmp_path):
    bad = tmp_path / "bad.txt"
    bad.write_text("cylinder 0 0 0 0 0 1 1\nbarrel 0 0 0\n")
    with pytest.raises(
        ValueError, match=r"bad\.txt:2:1: expected .*found 'barrel'"
    ):
        cylint.read_scene(bad)
    with pytest.raises(FileNotFoundError):
        cylint.read_scene(tmp_path / "none.swc")
    with pytest.raises(OSError):
        cylint.read_scene(tmp_path)
    orphan = tmp_path / "orphan.swc"
    orphan.write_text("1 1 0 0 0 2 7\n2 3 0 0 10 1 1\n")
    with pytest.warns(UserWarning, match="1 node with a parent that is not in"):
        assert len(cylint.read_scene(orphan)) == 1
    tube = tmp_path / "tube"
    tube.write_text("cylinder 0 0 0 0 0 1 1\n")
    assert cylint.read_scene(tube, ends="open").ends.tolist() == [
        cylint.Ends.OPEN
    ]


def test_a_scene_takes_shapes_from_a_generator_and_keeps_none_of_them():
    def blocks():
        for seed in range(40):
            yield forest(50, seed)

    scene = cylint.Scene(blocks())
    joined = cylint.concatenate(blocks())
    assert len(scene) == 2000 and (scene.shapes == joined).all()
    assert 65 * 2000 < scene.nbytes < 200 * 2000
    o, d = rays(200, 5)
    near, whole = scene.nearest(o, d), cylint.Scene(joined).nearest(o, d)
    assert same(near.point, whole.point) and same(near.index, whole.index)


def test_a_scene_is_read_from_a_file_as_its_shapes_are(tmp_path):
    name = tmp_path / "scene"
    rods = forest(30, 9).with_labels([f"rod {i}" for i in range(30)])
    cylint.write_scene(name, rods)
    scene = cylint.Scene.read(name)
    assert (scene.shapes == rods).all()
    assert scene.shapes.labels.tolist() == rods.labels.tolist()
    with pytest.raises(ValueError, match="swc: not a neuron"):
        cylint.Scene.read(name, swc="round")


def labelled(n, seed):
    names = [f"röd {i % 7}" if i % 3 else "" for i in range(n)]
    return forest(n, seed).with_labels(names)


def assert_same_answers(scene, again):
    o, d = rays(200, 28)
    near, other = scene.nearest(o, d), again.nearest(o, d)
    assert same(near.index, other.index) and same(near.t, other.t)
    assert same(near.point, other.point) and same(near.normal, other.normal)
    assert np.array_equal(scene.count(o, d), again.count(o, d))
    assert same(scene.all(o, d).t, again.all(o, d).t)
    closest, other = scene.closest(o), again.closest(o)
    assert same(closest.index, other.index)
    assert same(closest.distance, other.distance)
    assert same(scene.within(o, 0.5).distance, again.within(o, 0.5).distance)
    assert (scene.shapes == again.shapes).all()


@pytest.mark.parametrize("trusted", [False, True])
@pytest.mark.parametrize("read", [False, True])
def test_a_saved_scene_gives_the_same_answers(tmp_path, trusted, read):
    name = tmp_path / "saved"
    scene = cylint.Scene(labelled(1000, 27))
    scene.save(name)
    again = cylint.Scene.open(name, trusted=trusted, read=read, threads=1)
    assert_same_answers(scene, again)
    assert again.shapes.labels.tolist() == scene.shapes.labels.tolist()
    again.save(os.fspath(tmp_path / "again"))
    assert (tmp_path / "again").read_bytes() == name.read_bytes()
    assert [path.name for path in sorted(tmp_path.iterdir())] == [
        "again",
        "saved",
    ]


def test_an_opened_scene_keeps_its_file_when_it_is_replaced(tmp_path):
    name = tmp_path / "saved"
    scene = cylint.Scene(forest(300, 3))
    scene.save(name)
    opened = cylint.Scene.open(name)
    cylint.Scene(forest(5, 4)).save(name)
    assert_same_answers(scene, opened)
    assert len(cylint.Scene.open(name)) == 5
    name.unlink()
    assert_same_answers(scene, opened)
    assert not scene.shapes.labels.any() and not opened.shapes.labels.any()


def test_the_command_and_the_package_open_the_same_files(command, tmp_path):
    text, ours, theirs = (tmp_path / x for x in ("text", "ours", "theirs"))
    shapes = labelled(200, 5)
    cylint.write_scene(text, shapes)
    cylint.Scene(shapes).save(ours)
    command("", "--save", os.fspath(theirs), "-s", os.fspath(text))
    assert ours.read_bytes() == theirs.read_bytes()
    opened = cylint.Scene.open(theirs)
    assert opened.shapes.labels.tolist() == shapes.labels.tolist()
    for read in (cylint.read_scene(ours), cylint.Scene.read(ours).shapes):
        assert (read == shapes).all()
        assert read.labels.tolist() == shapes.labels.tolist()
    with pytest.raises(ValueError, match="ours: is a saved scene"):
        cylint.read_scene(ours, ends="open")


def test_files_that_are_no_saved_scenes_are_refused(tmp_path):
    name, bad = tmp_path / "saved", tmp_path / "bad"
    cylint.Scene(forest(50, 6)).save(name)
    data = name.read_bytes()
    damaged = data[:3000] + bytes([data[3000] ^ 1]) + data[3001:]
    for content, reason in (
        (data[:-64], "damaged"),
        (damaged, "damaged"),
        (data[:8] + b"\xff" + data[9:], "another version or machine"),
        (b"cylinder 0 0 0 0 0 1 1\n", "not a file of a scene"),
        (b"", "not a file of a scene"),
    ):
        bad.write_bytes(content)
        for read in (False, True):
            with pytest.raises(ValueError, match=f"bad: .*{reason}"):
                cylint.Scene.open(bad, read=read)
    with pytest.raises(FileNotFoundError, match="missing"):
        cylint.Scene.open(tmp_path / "missing")
    with pytest.raises(OSError):
        cylint.Scene.open(tmp_path)
    with pytest.raises(FileNotFoundError, match="missing"):
        cylint.Scene(forest(5, 1)).save(tmp_path / "missing" / "scene")
    with pytest.raises(OSError):
        cylint.Scene(forest(5, 1)).save(tmp_path)
    for call in (cylint.Scene.open, cylint.Scene(forest(5, 1)).save):
        with pytest.raises(ValueError, match="null byte"):
            call("a\0b")
    with pytest.raises(ValueError, match="at least 1"):
        cylint.Scene.open(name, threads=0)
    scene = pickle.dumps(cylint.Scene(forest(50, 6)))
    middle = len(scene) // 2
    spoiled = scene[:middle] + bytes([scene[middle] ^ 1]) + scene[middle + 1 :]
    with pytest.raises(ValueError, match="pickled scene: the file is damaged"):
        pickle.loads(spoiled)


@pytest.mark.parametrize("opened", [False, True])
def test_a_pickled_scene_has_its_labels_and_threads(tmp_path, opened):
    scene = cylint.Scene(labelled(500, 27), threads=2)
    scene.save(tmp_path / "saved")
    if opened:
        scene = cylint.Scene.open(tmp_path / "saved", threads=2)
    for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
        again = pickle.loads(pickle.dumps(scene, protocol))
        assert_same_answers(scene, again)
        assert again.shapes.labels.tolist() == scene.shapes.labels.tolist()
        assert again._threads == 2
    copied = copy.deepcopy(again)
    del again
    assert_same_answers(scene, copied)
    none = pickle.loads(pickle.dumps(cylint.Scene([])))
    assert len(none) == 0 and not none.any([0, 0, 0], [0, 0, 1])
