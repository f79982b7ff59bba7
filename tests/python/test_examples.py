"""The examples of the docstrings and of tools/python/README.md."""

import doctest
import importlib
import pkgutil
from pathlib import Path

import numpy as np
import pytest

import cylint

MODULES = ["cylint"] + [
    f"cylint.{m.name}" for m in pkgutil.iter_modules(cylint.__path__)
]
README = Path(__file__).parents[2] / "tools" / "python" / "README.md"


@pytest.mark.parametrize("name", MODULES)
def test_docstrings(name):
    module = importlib.import_module(name)
    names = {"cylint": cylint, "np": np}
    assert doctest.testmod(module, extraglobs=names).failed == 0


def test_every_public_name_has_an_example_or_a_docstring():
    for name in cylint.__all__:
        if name != "__version__":
            assert getattr(cylint, name).__doc__, name


def test_the_tutorial(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    done = doctest.testfile(str(README), module_relative=False)
    assert done.failed == 0 and done.attempted > 10
