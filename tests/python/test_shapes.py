"""Shapes: constructors, members, indexing, boxes, points inside, files."""

import locale
import os
import pickle
import struct
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
from conftest import forest, refused, same

import libcylint as cylint
from libcylint._arguments import doubles

UNIT = ([0, 0, 0], [0, 0, 1])


def test_arguments_broadcast():
    p1 = np.arange(1.0, 4.0)[:, None] * [0, 0, 1]
    rods = cylint.cylinder([0, 0, 0], p1, [[0.5], [1.0]])
    assert rods.shape == (2, 3) and rods.ndim == 2 and rods.size == 6 and len(rods) == 2
    assert same(rods.bounds()[1, 2], [[-1, -1, 0], [1, 1, 3]])


def test_ends_are_words_numbers_or_arrays():
    words = ["capped", "open", "cap0", "cap1", "infinite", "nappe"]
    for ends in (words, list(cylint.Ends)):
        assert cylint.cylinder(*UNIT, 1, ends=ends).ends.tolist() == list(range(6))
    for ends, message in (
        ("lid", "found 'lid'"), *((code, "no such ends") for code in (9, -1, 258)),
    ):
        with refused(message):
            cylint.cylinder(*UNIT, 1, ends=ends)
    objects = np.array(["Open", "cap1"], object)  # a column of pandas
    for ends in (objects, *([objects.astype("T")] if hasattr(np.dtypes, "StringDType") else [])):
        assert cylint.cylinder(*UNIT, 1, ends=ends).ends.tolist() == [1, 3]
    for ends in (2.9, None, b"open", True, [2, None]):
        with refused("ends: expected words or integers, found", TypeError):
            cylint.cylinder(*UNIT, 1, ends=ends)
    with refused("ends: .*inhomogeneous"):
        cylint.cylinder(*UNIT, 1, ends=[["open"], ["open", "cap0"]])


@pytest.mark.parametrize(
    ("make", "given", "error", "message"),
    [
        ("cylinder", (*UNIT, [1, 1, -1]), ValueError, "cylinder 2: a radius is neg"),
        ("cylinder", (*UNIT, np.nan), ValueError, "cylinder: a number is not finite"),
        ("cylinder", ([0, 0, 0], [[[0, 0, 1]], [[0, 0, 0]]], 1), ValueError,
         r"cylinder \(1, 0\): the axis or normal has no length"),
        ("cone", ([0, 0, 0], [1, 0], [0, 0, 1], 0), ValueError, "cone 1: a radius"),
        ("angle_cone", (*UNIT, [45, 90]), ValueError, "angle_cone 1: the half angle"),
        ("elliptic_cylinder", [[1, 0, 0]] * 4, ValueError,
         "elliptic_cylinder: the vectors a, b, h are linearly dependent"),
        ("cylinder", ([0, 0], [0, 1], 1), ValueError, r"p0: expected the shape \(\.\.\., 3\)"),
        ("cylinder", (np.zeros((2, 3)), np.ones((3, 3)), 1), ValueError,
         r"do not broadcast: p0 \(2,\), p1 \(3,\), r \(\), ends \(\)"),
        ("cylinder", ([0, 0, 0], [0, 0, 1], [[1], [2, 3]]), ValueError, "r: .*inhomogeneous"),
        ("cylinder", (*UNIT, "thick"), TypeError, "r: expected real numbers"),
        ("cylinder", (*UNIT, 10**400), ValueError, "r: .*too large"),
        ("cylinder", (*UNIT, [1, {}]), TypeError, "r: .*dict"),
        ("cylinder", (*UNIT, np.array(["thick"], object)), TypeError, "r: .*found str"),
        ("cylinder", ([0, 0, 1j], [0, 0, 1], 1), TypeError, "p0: expected real numbers"),
    ],
)  # fmt: skip
def test_a_bad_argument_is_named(make, given, error, message):
    with refused(message, error):
        getattr(cylint, make)(*given)


def test_masked_elements_are_refused():
    points = np.ma.masked_array(np.ones((2, 3)), mask=np.zeros((2, 3)))
    ball = cylint.sphere([0, 0, 0], 1)
    assert np.array_equal(ball.distance(points), ball.distance(points.data))
    points[1, 2] = np.ma.masked
    masked, itself = np.ma.masked, [np.zeros(3)]
    itself.append(itself)
    for given in (
        points, [*points], [[0, points[0]], [(points[1], points[0])]], [[masked, 0, 3]],
        [1.5, masked, itself], [[0, 0, np.ma.array(1, mask=True)]],
    ):
        with refused("points: an element is masked"):
            ball.distance(given)
    with refused("points: .*inhomogeneous"):
        ball.distance(itself)
    with refused("exclude: an element is masked"):
        cylint.Scene(ball).any(
            [0, 0, 0], [1, 0, 0], exclude=np.ma.masked_array([0], mask=[1])
        )
    words = np.ma.masked_array(["open", "cap0"], mask=[0, 1])
    with refused("ends: an element is masked"):
        cylint.cylinder(*UNIT, 1, ends=words)
    with refused("labels: an element is masked"):
        ball[None].with_labels(words[1:])


def test_only_numbers_of_an_array_of_objects_are_converted():
    numbers = [True, 2, np.int8(-3), np.float32(0.5), Fraction(1, 3), Decimal("0.1")]
    given = np.array(numbers, object)
    assert same(cylint.sphere([0, 0, 0], abs(given)).r, [1, 2, 3, 0.5, 1 / 3, 0.1])
    for x in (None, "1", b"1", np.longdouble("0.1"), np.complex128(1), np.ma.masked):
        given[3] = x
        with refused(f"r: expected real numbers .*found {type(x).__name__}", TypeError):
            cylint.sphere([0, 0, 0], given)


@pytest.mark.skipif(np.longdouble(0).itemsize == 8, reason="longdouble is float64")
def test_a_longdouble_is_named():
    with refused(r"r: float\d+ \(longdouble\) has digits", TypeError):
        cylint.cylinder(*UNIT, np.longdouble("0.1"))
    with refused("origins: .*longdouble.*astype", TypeError):
        cylint.intersect(cylint.sphere([0, 0, 0], 1), np.zeros(3, np.longdouble), [0, 0, 1])


MEMBERS = "p0 p1 r0 r1 r c a b h k v u tangent p n".split()


def arguments(random):
    """For each constructor its arguments, for three shapes."""
    x, y, z, w = (random.normal(size=(3, 3)) for _ in range(4))
    r, q = random.uniform(0.1, 1, 3), random.uniform(0.1, 1, 3)
    return {
        "cylinder": {"p0": x, "p1": y, "r": r},
        "cone": {"p0": x, "r0": r, "p1": y, "r1": q},
        "elliptic_cylinder": {"c": x, "a": y, "b": z, "h": w},
        "elliptic_cone": {"c": x, "a": y, "b": z, "h": w, "k": r},
        "sphere": {"c": x, "r": r},
        "capsule": {"p0": x, "p1": y, "r": r},
        "round_cone": {"p0": x, "r0": 9 * r, "p1": y, "r1": [1, 50, 9 * r[2] + 0.1]},
        "tangent_cone": {"v": x, "u": y, "tangent": r},
        "halfspace": {"p": x, "n": y},
    }


def made_of(name, numbers, ends):
    """A half-space has no ends."""
    return getattr(cylint, name)(**numbers, **({} if name == "halfspace" else {"ends": ends}))


def test_arrays_of_another_process_are_used_in_place():
    # their dtype is another object than that of NumPy's float64
    given = pickle.loads(pickle.dumps(np.ones((2, 3))))
    assert doubles("origins", given, 3) is given


def test_the_arguments_are_members():
    given_arguments = arguments(np.random.default_rng(71))
    made = [getattr(cylint, name)(**each) for name, each in given_arguments.items()]
    table = cylint.concatenate(made).reshape(len(made), 3)
    kinds = "CYLINDER CONE ECYLINDER ECONE SPHERE CAPSULE RCONE ACONE HALFSPACE"
    assert [cylint.Kind(int(k)).name for k in table.kind.max(axis=1)] == kinds.split()
    assert cylint.Kind.SPHERE in made[6].kind  # round cones that are balls
    for (name, each), row in zip(given_arguments.items(), table, strict=True):
        if "p0" in each and "r" in each:
            each = each | {"r0": each["r"], "r1": each["r"]}
        for member in MEMBERS:
            value = getattr(row, member)
            wide = member in ("p0", "p1", "c", "a", "b", "h", "v", "u", "p", "n")
            assert value.shape == ((3, 3) if wide else (3,)), (name, member)
            assert same(value, each.get(member, np.full(value.shape, np.nan))), (name, member)
    assert table.p0.shape == (9, 3, 3) and table.r.shape == (9, 3)
    assert table[0, 1].r == given_arguments["cylinder"]["r"][1]
    assert table[:0].p0.shape == (0, 3, 3)
    with refused("cannot be changed", AttributeError):
        table.p0 = 1
    for member in (*MEMBERS, "kind", "ends", "labels"):
        with refused("read-only", ValueError):
            getattr(table, member)[...] = 0
    cone = cylint.angle_cone(*UNIT, 45)
    assert abs(float(cone.tangent) - 1) < 1e-15 and cone.ends == cylint.Ends.INFINITE


def test_a_dictionary_makes_the_shapes_again():
    given_arguments = arguments(np.random.default_rng(72))
    made = [made_of(name, each, "capped") for name, each in given_arguments.items()]
    shapes = cylint.concatenate(made)
    table = shapes.to_dict()
    assert set(table) == {"kind", "ends", *MEMBERS}
    for i, name in enumerate(table["kind"]):
        numbers = {key: table[key][i] for key in given_arguments[str(name)]}
        again = made_of(name, numbers, table["ends"][i])
        assert again == shapes[i]
        assert again._records.tobytes() == shapes[i]._records.tobytes()
    assert set(made[0].to_dict()) == {"kind", "ends", "p0", "p1", "r", "r0", "r1"}
    assert made[0][1].to_dict()["r"].shape == ()
    assert list(shapes[:0].to_dict()) == ["kind", "ends"]


def test_equality_is_that_of_values():
    rods = cylint.cylinder(*UNIT, [1, 2, 3])
    assert (rods == cylint.cylinder(*UNIT, [1, 5, 3])).tolist() == [1, 0, 1]
    assert (rods != cylint.cylinder(*UNIT, [1, 5, 3])).tolist() == [0, 1, 0]
    assert (rods[:, None] == rods).tolist() == np.eye(3).tolist()
    assert bool(rods[1] == rods[1:2][0]) and not bool(rods[0] != rods[0])
    assert (rods == cylint.cylinder([-0.0, 0, 0], UNIT[1], [1, 2, 3])).all()
    assert not (rods == cylint.cylinder(*UNIT, [1, 2, 3], ends="open")).any()
    assert not (rods == cylint.capsule(*UNIT, [1, 2, 3])).any()
    assert (rods == rods.with_labels("x")).all()
    ball = cylint.round_cone([0, 0, 0], 3, [0, 0, 1], 1)
    assert ball.kind == cylint.Kind.SPHERE
    assert not (ball == cylint.sphere([0, 0, 0], 3)).any()
    assert ball == cylint.round_cone([0, 0, 0], 3, [0, 0, 1], 1)
    assert rods[0] in rods and rods[0] not in rods[1:]
    assert (rods == 1) is False and (rods != None) is True  # noqa: E711
    assert (np.ones(3) == rods) is False
    with refused(r"broadcast: shapes \(3,\), other \(2"):
        rods == rods[:2]
    with refused("unhashable", TypeError):
        {rods}


def test_numpy_does_not_join_shapes():
    rods = cylint.cylinder(*UNIT, [1, 2])
    for message, wrong in (
        (r"libcylint\.concatenate\(\) joins", lambda: np.concatenate([rods, rods])),
        ("", lambda: np.array([rods, rods])),
        ("", lambda: np.asarray(rods)),
        ("", lambda: rods + np.ones(2)),
        ("expected Shapes, found list", lambda: cylint.concatenate([rods, [1]])),
        ("expected Shapes, found int", lambda: cylint.concatenate(5)),
        ("expected Shapes, found int", lambda: cylint.Scene(5)),
    ):
        with refused(message, TypeError):
            wrong()
    assert np.shape(rods) == (2,)


def test_labels_follow_their_shapes():
    rods = cylint.cylinder(*UNIT, [1, 2, 3, 4])
    assert rods.labels.tolist() == [""] * 4 and rods.labels.dtype.kind == "U"
    named = rods.with_labels(["a", "b", "Zweig \u00e4", "d e"])
    square = named.reshape(2, 2)
    for shapes, labels in (
        (named[1:3], ["b", "Zweig \u00e4"]), (named[named.r > 3], ["d e"]),
        (square[1], ["Zweig \u00e4", "d e"]), (rods.with_labels("x"), ["x"] * 4),
        (cylint.concatenate([rods[:1], named[3], named[:1]]), ["", "d e", "a"]),
        (cylint.Scene(named).shapes, named.labels.tolist()),
    ):  # fmt: skip
        assert shapes.labels.tolist() == labels
    assert named[2].labels == "Zweig \u00e4" and named[2].labels.shape == ()
    assert square[:, None].labels.shape == (2, 1, 2)
    assert np.array_equal(pickle.loads(pickle.dumps(square)).labels, square.labels)
    assert "labels" in named.to_dict() and "labels" not in rods.to_dict()
    given = np.array(["a", "b", "c", "d"], object)
    copied = rods.with_labels(given)
    given[:] = 0
    assert copied.labels.tolist() == ["a", "b", "c", "d"]
    surrogate = rods.with_labels(["a", "b", "\ud800", "d"])
    for use in (cylint.Scene, lambda shapes: cylint.write_scene(os.devnull, shapes)):
        with refused(r"^shape 2: the label '\\ud800' has no encoding in UTF-8$"):
            use(surrogate)
    with refused("expected Shapes, found int", TypeError):
        cylint.write_scene(os.devnull, 3)
    with refused("labels 3: expected str, found 3", TypeError):
        rods.with_labels(["a", "b", "c", 3])
    with refused(r"broadcast: shapes \(4,\), labels \(2,\)"):
        rods.with_labels(["a", "b"])
    with refused(r"labels: expected the shape \(4,\), found \(2, 1\)"):
        rods.with_labels([["a"], ["b"]])


def test_indexing_follows_numpy():
    shapes = forest(40, 1)
    boxes = shapes.bounds()
    order = np.random.default_rng(2).permutation(len(shapes))
    for index in (order, slice(None, None, -3), shapes.kind == 2):
        assert same(shapes[index].bounds(), boxes[index])
    assert shapes[3].shape == () and shapes[None, :, None].shape == (1, 40, 1)
    assert len(list(shapes)) == 40
    assert same(shapes.reshape(5, 8)[1, 2].bounds(), boxes[10])
    with pytest.raises(IndexError):
        shapes[40]
    with pytest.raises(AttributeError):
        shapes.kind = 3
    with refused("read-only"):
        shapes.kind[0] = 3


def test_empty_arrays():
    none = cylint.cylinder(np.empty((0, 3)), [0, 0, 1], 1)
    assert len(cylint.concatenate([])) == 0
    assert none.shape == (0,) and none.bounds().shape == (0, 2, 3)
    assert none.contains([0, 0, 0]).shape == (0,)
    assert pickle.loads(pickle.dumps(none)).shape == (0,)
    assert repr(none) == "<libcylint.Shapes (0,): none>"


def finite_doubles(random, *shape):
    """Of any bits, whole or decimal, or at a limit."""
    limits = [0.0, -0.0, 5e-324, 2.0**-1022, 2.0**-537, 0.1, 2.0**512, np.finfo(float).max]
    bits = random.integers(0, 2**64, shape, np.uint64).view(float)
    bits[~np.isfinite(bits)] = 1
    whole = random.integers(-9, 10, shape) / random.choice([1, 10], shape)
    kinds = [bits, random.choice(limits, shape), whole, whole, whole]
    return np.choose(random.integers(0, 5, shape), kinds)


def extreme_shapes(random):
    """Shapes of all kinds; what a constructor refuses is left out."""
    a, b, c, d = finite_doubles(random, 4, 4, 3)
    k, r = abs(finite_doubles(random, 2, 4))
    made = []
    for name, *given_arguments, ends in (
        ("cylinder", a, b, k, "open"), ("cone", a, k, b, r, "nappe"),
        ("elliptic_cylinder", a, b, c, d, "capped"), ("elliptic_cone", a, b, c, d, k, "capped"),
        ("sphere", a, k, "capped"), ("capsule", a, b, k, "open"),
        ("round_cone", a, k, b, r, "capped"), ("tangent_cone", a, b, k, "infinite"),
        ("angle_cone", a, b, k % 90, "capped"),
    ):  # fmt: skip
        for i in range(4):
            try:
                made.append(getattr(cylint, name)(*(x[i] for x in given_arguments), ends=ends))
            except ValueError:
                pass
    return made


def any_label(random):
    """Of up to 8 characters: ASCII's, those of two bytes, and any others but surrogates."""
    ranges = [(1, 128), (128, 2048), (2048, 0xD800), (0xE000, 0x110000)]
    codes = [random.integers(*ranges[i]) for i in random.integers(0, 4, random.integers(9))]
    return "".join(map(chr, codes)).replace("\n", "").strip(" \t\r")


def can_be_written(shape):
    if shape.kind == cylint.Kind.ACONE:
        try:
            cylint.write_scene(os.devnull, shape)
        except ValueError as error:
            return "no angle" not in str(error)
    return True


def test_pickles_and_files_keep_every_number_and_label(tmp_path):
    """Files without the cones whose tangent no angle has."""
    random, path, kinds = np.random.default_rng(73), tmp_path / "scene", []
    for _ in range(100):
        made = extreme_shapes(random)
        shapes = cylint.concatenate(made)
        again = pickle.loads(pickle.dumps(shapes))
        assert again._records.tobytes() == shapes._records.tobytes()
        shapes = cylint.concatenate([shape for shape in made if can_be_written(shape)])
        labels = [any_label(random) for _ in shapes]
        cylint.write_scene(path, shapes.with_labels(labels))
        read = cylint.read_scene(path)
        again = pickle.loads(pickle.dumps(read))
        assert again._records.tobytes() == shapes._records.tobytes()
        assert again.labels.tolist() == read.labels.tolist() == labels
        kinds += shapes.kind.tolist()
    assert min(np.bincount(kinds)[1:9]) > 100
    cylint.write_scene(path, shapes[:0])
    assert path.read_bytes() == b""


def test_labels_that_look_like_text_of_the_grammar(tmp_path):
    labels = ["ends=open", ",", ",ends=open", "1 2", "# 3", "not=a", "\udcff\udc80"]
    rods = cylint.cylinder(*UNIT, np.ones(len(labels))).with_labels(labels)
    path = tmp_path / "scene"
    cylint.write_scene(path, rods)
    again = cylint.read_scene(path)
    assert (again == rods).all() and again.labels.tolist() == labels
    assert b"\xff\x80" in path.read_bytes()


def test_angles_in_text_keep_the_tangent(tmp_path):
    most = 89.9999999999999, np.nextafter(90, 0)
    degrees = np.r_[1e-320, 1e-9, np.linspace(0.1, 89.9, 5000), most]
    cones = cylint.angle_cone(*UNIT, degrees)
    cylint.write_scene(tmp_path / "scene", cones)
    assert (cylint.read_scene(tmp_path / "scene") == cones).all()
    with refused("shape 1: text cannot hold a cone whose tangent"):
        cylint.write_scene(tmp_path / "scene", cylint.tangent_cone(*UNIT, [0.5, 1e300]))


def test_text_does_not_depend_on_the_locale(tmp_path, monkeypatch):
    # a locale of glibc with a decimal comma: the table of its file LC_NUMERIC
    comma = struct.pack("=8I", 0x20031114, 6, 32, 34, 36, 40, 44, 48)
    comma += b",\0.\0\3\3\0\0" + struct.pack("=2I", ord(","), ord(".")) + b"UTF-8\0"
    (tmp_path / "comma").mkdir()
    (tmp_path / "comma/LC_NUMERIC").write_bytes(comma)
    monkeypatch.setenv("LOCPATH", str(tmp_path))
    try:
        locale.setlocale(locale.LC_NUMERIC, "comma")
    except locale.Error:
        pytest.skip("no locales of glibc")
    try:
        assert locale.localeconv()["decimal_point"] == ","
        (tmp_path / "scene").write_text("sphere 4.9e-330 0x1.8p+3 0.1 2.5\n")
        ball = cylint.read_scene(tmp_path / "scene")
        cylint.write_scene(tmp_path / "again", ball)
        (tmp_path / "large").write_text("sphere 1.5e400 0 0 1\n")
        with refused("large:1:8: number too large"):
            cylint.read_scene(tmp_path / "large")
    finally:
        locale.setlocale(locale.LC_NUMERIC, "C")
    assert (ball == cylint.sphere([0, 12, 0.1], 2.5)).all()
    assert (tmp_path / "again").read_text() == "sphere 0 12 0.1 2.5\n"


def test_a_file_is_replaced_whole(tmp_path, monkeypatch):
    path, link = tmp_path / "scene", tmp_path / "link"
    link.symlink_to(path)
    shapes = forest(200, 8)
    cylint.Scene(shapes).save(path)
    path.chmod(0o640)
    before, scene = path.read_bytes(), cylint.Scene.open(path)
    with monkeypatch.context() as patch, refused("no rename", OSError):
        patch.setattr(os, "replace", lambda *_: (_ for _ in ()).throw(OSError("no rename")))
        cylint.write_scene(link, shapes[:1])
    assert path.read_bytes() == before and len(os.listdir(tmp_path)) == 2
    cylint.write_scene(link, shapes[:1])
    assert (cylint.read_scene(path) == shapes[:1]).all() and link.is_symlink()
    assert len(os.listdir(tmp_path)) == 2 and path.stat().st_mode & 0o777 == 0o640
    assert (scene.shapes == shapes).all()


def test_refused_shapes_have_no_kind(tmp_path):
    # Only a scene that a program in C saved has some.
    rod = cylint.cylinder(*UNIT, 1)
    none = cylint.Shapes(np.zeros(1, rod._records.dtype))
    both = cylint.concatenate([none, rod])
    assert both.to_dict()["kind"].tolist() == ["none", "cylinder"]
    assert np.isnan(both.r[0]) and both.r[1] == 1
    assert (both == both).all() and not (none == rod).any()
    assert (pickle.loads(pickle.dumps(both)) == both).all()
    with refused("shape 0: text cannot hold a refused shape"):
        cylint.write_scene(tmp_path / "scene", both)


def test_what_text_cannot_hold_is_refused(tmp_path):
    path = tmp_path / "scene"
    path.write_text("as it was")
    rods = cylint.cylinder(*UNIT, [1, 2])
    for why, *labels in (
        ("text cannot hold a label with a line feed or NUL", "two\nlines", "nul\0"),
        ("text cannot hold a label with blanks around", " blank", "blank\t", "return\r"),
        ("text cannot hold a label that begins with in= or out=", "in=a", "out="),
        ("the line would be longer than 1 MiB", "x" * 2**20),
    ):
        for label in labels:
            with refused(f"shape 1: {why}"):
                cylint.write_scene(path, rods.with_labels(["fine", label]))
    many = cylint.cylinder(*UNIT, np.ones(65_538))
    with refused("shape 65537: text"):  # in the second part that is written
        cylint.write_scene(path, many.with_labels([""] * 65_537 + ["x\n"]))
    with refused("expected one axis"):
        cylint.write_scene(path, rods[:, None])
    with refused(r"\*\.swc is read as a neuron"):
        cylint.write_scene(tmp_path / "a.swc", rods)
    assert path.read_text() == "as it was"
    with pytest.raises(OSError):
        cylint.write_scene(tmp_path, rods)
    cylint.write_scene(path, rods[0])
    assert path.read_text() == "cylinder 0 0 0 0 0 1 1\n"
