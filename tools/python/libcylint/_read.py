"""Reads scenes and neurons."""

from __future__ import annotations

import os
import warnings
from typing import Any

import numpy as np

from . import _core
from ._shapes import Shapes, _codes, _record

_NOT_GIVEN = -1
_BAD, _MEMORY = 1, 4


def read_scene(
    path: str | os.PathLike[str],
    *,
    ends: Any = None,
    swc: str | None = None,
) -> Shapes:
    """Reads a file of shapes, one a line, or a neuron in SWC (*.swc).

    The file is read as `cylint -s` reads it; cylint(1) states the format.  Of a
    neuron each node that has a parent gives a frustum, capped; with swc="round"
    it gives a rounded cone, and each root a sphere.  swc="cones" is the default.
    ends: for shapes whose line does not say.  Raises ValueError for the first
    bad line, OSError if the file cannot be read.

    >>> import os, tempfile
    >>> folder = tempfile.TemporaryDirectory()
    >>> name = os.path.join(folder.name, "neuron.swc")
    >>> with open(name, "w") as file:
    ...     print("1 1 0 0 0 2 -1", "2 3 0 0 10 1 1", sep="\\n", file=file)
    >>> cylint.read_scene(name)
    <libcylint.Shapes (1,): 1 cone>
    >>> cylint.read_scene(name, swc="round")
    <libcylint.Shapes (2,): 1 sphere, 1 rcone>
    """
    code = _NOT_GIVEN if ends is None else int(_codes(ends))
    name = os.fspath(path)
    if swc not in (None, "cones", "round"):
        raise ValueError(f"swc: expected cones or round, found {swc!r}")
    if swc is not None and not name.endswith((".swc", ".SWC")):
        raise ValueError(f"swc: not a neuron, *.swc: {name}")
    if name == "-":
        name = "./-"  # the reader takes - for standard input
    if not os.access(name, os.R_OK):
        with open(name, "rb"):
            pass
    status, data, messages = _core.read_scene(name, code, swc == "round")
    if status != 0:
        text = "; ".join(messages)
        error = {_BAD: ValueError, _MEMORY: MemoryError}.get(status, OSError)
        raise error(text)
    for text in messages:
        warnings.warn(text, stacklevel=2)
    return Shapes(np.frombuffer(data, _record))
