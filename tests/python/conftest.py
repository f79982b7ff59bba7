"""Helpers of the tests: the command, seeded families, hypothesis profiles."""

import os
import subprocess

import numpy as np
import pytest
from hypothesis import HealthCheck, settings

import libcylint as cylint

for name, examples in (("check", 400), ("full", 10000)):
    settings.register_profile(
        name,
        max_examples=examples,
        deadline=None,
        derandomize=name == "check",
        database=None,
        suppress_health_check=[
            HealthCheck.too_slow,
            HealthCheck.data_too_large,
        ],
    )
settings.load_profile(os.environ.get("PROFILE", "check"))


def text_of(*columns):
    """Rows of hexadecimal numbers, words and strings, as the command reads."""
    rows = zip(*columns, strict=True)
    return "\n".join(" ".join(item for item in row) for row in rows) + "\n"


def hexadecimal(array):
    """A string for each row of an array (n) or (n, k)."""
    array = np.asarray(array, float)
    rows = array.reshape(len(array), -1)
    return [" ".join(float(x).hex() for x in row) for row in rows]


@pytest.fixture(scope="session")
def command():
    """Runs the command of the build and returns its fields, a row a line."""
    program = os.environ.get("CYLINT_COMMAND")
    if not program:
        pytest.skip("CYLINT_COMMAND does not name the command")

    def run(text, *options):
        done = subprocess.run(
            [program, "-x", *options],
            input=text,
            capture_output=True,
            text=True,
            check=True,
        )
        return [line.split("\t") for line in done.stdout.splitlines()]

    return run


def same(a, b):
    """Equal bits, and nan where nan is."""
    return np.array_equal(
        np.ascontiguousarray(a).view(np.int64),
        np.ascontiguousarray(b).view(np.int64),
    ) or np.array_equal(a, b, equal_nan=True)


def numbers(fields):
    return np.array([[float.fromhex(x) for x in row] for row in fields])


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


def written_rods(n, random, path):
    """n thin cylinders in the unit cube, written to a scene as well."""
    p0 = random.random((n, 3))
    p1 = p0 + random.normal(size=(n, 3)) * 0.05
    r = random.uniform(0.002, 0.02, n)
    path.write_text(
        text_of(
            ["cylinder"] * n, hexadecimal(p0), hexadecimal(p1), hexadecimal(r)
        )
    )
    return cylint.cylinder(p0, p1, r)


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
    return cylint.concatenate(
        [
            cylint.cylinder(base[:q], base[:q] + axis[:q], r[:q]),
            cylint.cone(
                base[q : 2 * q],
                r[q : 2 * q],
                base[q : 2 * q] + axis[q : 2 * q],
                0.5 * r[q : 2 * q],
                ends="open",
            ),
            cylint.elliptic_cylinder(
                base[2 * q : 3 * q],
                a[2 * q : 3 * q],
                b[2 * q : 3 * q],
                axis[2 * q : 3 * q],
            ),
            cylint.angle_cone(
                base[3 * q : 4 * q], axis[3 * q : 4 * q], 10, ends="capped"
            ),
            cylint.round_cone(
                base[4 * q :],
                r[4 * q :],
                (base + axis)[4 * q :],
                r[: n - 4 * q],
            ),
        ]
    )
