"""The examples of the docstrings and of tools/python/README.md."""

import doctest
import functools
import importlib
import importlib.metadata
import inspect
import pkgutil
import re
from pathlib import Path

import numpy as np
import pytest

import libcylint as cylint

MODULES = ["libcylint"] + [f"libcylint.{m.name}" for m in pkgutil.iter_modules(cylint.__path__)]
TOP = Path(__file__).parents[2]


def docstrings(module):
    """The examples of a module; doctest finds cached properties since Python 3.13."""
    finder, names = doctest.DocTestFinder(), {"cylint": cylint, "np": np}
    found = finder.find(module, extraglobs=names)
    yield from found
    names_found = {test.name for test in found}
    for kind in vars(module).values():
        if inspect.isclass(kind) and kind.__module__ == module.__name__:
            for member in vars(kind).values():
                if not isinstance(member, functools.cached_property):
                    continue
                name = f"{module.__name__}.{kind.__name__}.{member.attrname}"
                if name not in names_found:
                    yield from finder.find(
                        member.func, member.attrname, module=module, extraglobs=names
                    )


@pytest.mark.parametrize("name", MODULES)
def test_docstrings(name):
    module = importlib.import_module(name)
    runner = doctest.DocTestRunner()
    results = [runner.run(test) for test in docstrings(module)]
    assert sum(result.failed for result in results) == 0
    if module.__file__.endswith(".py"):
        text = Path(module.__file__).read_text()
        examples = re.findall(r"^ *>>> ", text, re.MULTILINE)
        assert sum(result.attempted for result in results) == len(examples)


def test_the_distribution_and_its_module_are_libcylint():
    """`cylint` on PyPI is another project's, with a module of that name."""
    files = importlib.metadata.files("libcylint")
    assert {file.parts[0] for file in files} == {
        "libcylint",
        f"libcylint-{cylint.__version__}.dist-info",
    }
    assert repr(cylint.Shapes) == "<class 'libcylint._shapes.Shapes'>"


def test_every_public_name_has_an_example_or_a_docstring():
    for name in cylint.__all__:
        if name != "__version__":
            assert getattr(cylint, name).__doc__, name


def test_the_words_stand_in_the_source():
    """mypy and pyright read enumerators from the body of a class alone."""
    words = cylint.Ends, cylint.Feature, cylint.Kind, cylint.Part, cylint.Relation, cylint.Side
    for kind in words:
        source = inspect.getsource(kind)
        assert all(f" {word.name} = {word.value}\n" in source for word in kind)


def examples_of(page):
    """The examples of a page; its fences end their output."""
    text = (TOP / page).read_text()
    text = "".join("\n" if line.startswith("```") else line for line in text.splitlines(True))
    names = {"cylint": cylint, "np": np}
    return doctest.DocTestParser().get_doctest(text, names, page, page, 0)


@pytest.mark.parametrize("page", ["README.md", "tools/python/README.md"])
def test_the_examples_of_pages(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    examples = examples_of(page)
    assert len(examples.examples) >= 3
    assert doctest.DocTestRunner().run(examples).failed == 0
