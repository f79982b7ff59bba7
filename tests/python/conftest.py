"""Helpers of the tests: the command, comparison, seeded families."""

import os
import subprocess
import tempfile
from pathlib import Path

import numpy as np
import pytest

import libcylint as cylint

# Shapes by the command's text for them.
TEXTS = {
    "cylinder": "cylinder 0 0 0 0 0 1 .5",
    "cone": "cone 0 0 -1 1 .25 0 1 .25",
    "econe": "econe 0 0 -1 1 0 0 0 .5 0 .5 0 2 .5 ends=cap0",
    "rcone": "rcone 0 0 -1 .75 .25 0 1 .25",
    "capsule": "capsule 0 0 -1 0 0 1 .5 ends=open",
    "sphere": "sphere 0 0 0 .5",
    "double": "acone 0 0 0 0 0 1 40",
    "open": "cylinder 0 0 0 0 0 1 .5 ends=open",
    "infinite": "cylinder 0 0 0 1 2 3 .5 ends=infinite",
    "pointed": "cone 0 0 -1 1 .25 0 1 0",
    "nappe": "cone 0 0 -1 1 .25 0 1 .25 ends=nappe",
}


def shapes_of(text):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "scene")
        path.write_text(text)
        return cylint.read_scene(path)


SHAPES = dict(zip(TEXTS, shapes_of("\n".join(TEXTS.values()))))
ROD = SHAPES["cylinder"]


def refused(message, error=ValueError):
    return pytest.raises(error, match=message or None)


def records(*columns):
    """Text of rows for the command.  Columns: arrays (n) or (n, k), or a text for all."""
    rows = max(len(c) for c in columns if not isinstance(c, str))
    texts = [
        [c] * rows
        if isinstance(c, str)
        else [" ".join(float(x).hex() for x in np.ravel(row)) for row in c]
        for c in columns
    ]
    return "\n".join(map(" ".join, zip(*texts, strict=True))) + "\n"


WORDS = {"-": -1} | {
    word.name.lower(): int(word)
    for words in (cylint.Relation, cylint.Side, cylint.Feature)
    for word in words
}


def value(field):
    if field in WORDS:
        return WORDS[field]
    return int(field) if field.isdigit() else float.fromhex(field)


@pytest.fixture(scope="session")
def command():
    """Runs the command of the build; its answers are the bits of arrays, which are
    named by their columns."""
    program = os.environ.get("CYLINT_COMMAND")
    if not program:
        pytest.skip("CYLINT_COMMAND does not name the command")

    def run(text, *options, **members):
        columns = ["-f", ",".join(members).replace("_", ",")] if members else []
        digits = [] if "--save" in options else ["-x"]
        done = subprocess.run(
            [program, *digits, *map(str, options), *columns],
            input=text,
            capture_output=True,
            text=True,
            check=True,
        )
        fields = [[value(x) for x in line.split("\t")] for line in done.stdout.splitlines()]
        answers, at = np.array(fields, float), 0
        for name, member in members.items():
            width = name.count("_") + 1
            want = np.asarray(member, float).reshape(len(answers), width)
            assert same(answers[:, at : at + width], want), name
            at += width
        return answers

    return run


def same(a, b):
    """Equal numbers, also in the sign of 0, and nan where nan is."""
    a, b = np.asarray(a), np.asarray(b)
    return np.array_equal(a, b, equal_nan=True) and np.array_equal(
        np.signbit(a[a == 0]), np.signbit(b[b == 0])
    )


def equal(a, b, *members):
    """Whether two answers have the same members."""
    return all(same(getattr(a, m), getattr(b, m)) for m in members)


def drawn(n, seed):
    """n lines near the unit ball, some of them hard."""
    random = np.random.default_rng(seed)
    o = random.normal(size=(n, 3)) * 3
    target = random.normal(size=(n, 3)) * 0.7
    d = target - o
    kind = random.integers(0, 5, n)
    far = kind == 1
    o[far] += d[far] * -(10.0 ** random.uniform(3, 8, (far.sum(), 1)))
    along = kind == 2
    d[along] = [0, 0, 1]
    tiny = kind == 3
    d[tiny] *= 10.0 ** random.uniform(-150, 150, (tiny.sum(), 1))
    return o, d


def forest(n, seed):
    """n shapes of every kind in the unit cube."""
    random = np.random.default_rng(seed)
    base = random.random((n, 3))
    axis = random.normal(size=(n, 3)) * 0.1
    r = random.uniform(0.002, 0.03, n)
    q = n // 5
    a = np.cross(axis, [1, 0, 0]) * 0.3
    b = np.cross(axis, a)
    b *= 0.02 / np.linalg.norm(b, axis=1, keepdims=True)
    top = base + axis
    i, j, k, l, m = (slice(x * q, (x + 1) * q if x < 4 else None) for x in range(5))
    return cylint.concatenate(
        [
            cylint.cylinder(base[i], top[i], r[i]),
            cylint.cone(base[j], r[j], top[j], 0.5 * r[j], ends="open"),
            cylint.elliptic_cylinder(base[k], a[k], b[k], axis[k]),
            cylint.angle_cone(base[l], axis[l], 10, ends="capped"),
            cylint.round_cone(base[m], r[m], top[m], r[: n - 4 * q]),
        ]
    )


def rays(n, seed):
    """n rays into the unit cube."""
    random = np.random.default_rng(seed)
    o = random.uniform(-1, 2, (n, 3))
    return o, random.random((n, 3)) - o
