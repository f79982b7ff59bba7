"""Reads scenes and neurons, and writes scenes."""

from __future__ import annotations

import codecs
import errno
import gzip
import os
import shutil
import sys
import tempfile
import warnings
import zlib
from collections.abc import Iterator
from typing import Any, BinaryIO, TextIO

from numpy.typing import ArrayLike

from . import _core
from ._shapes import Shapes, all_shapes, checked, codes_of, encoded

_NOT_GIVEN = -1
_FORMS = None, "cones", "round"
BAD, USAGE, IO, MEMORY = 1, 2, 3, 4  # exit statuses of the command
_AT_ONCE = 1 << 16  # shapes; Ctrl-C ends the writing between them


def read_scene(
    path: str | os.PathLike[str], *, ends: Any = None, swc: str | None = None
) -> Shapes:
    """Reads a file of shapes, one a line, or a neuron in SWC (*.swc, or with swc=).

    The file is read as `cylint -s` reads it; cylint(1) states the format.  Of a
    neuron each node that has a parent gives a frustum, capped; with swc="round"
    it gives a round cone, and each root a sphere.  swc="cones" is the default.
    What follows a shape on its line is its label, see `Shapes.labels`; that of a
    neuron's shape is the number of its node.  A scene of `Scene.save` is read, too.
    Solids (in=NAME, out=NAME) are not kept, with a warning: see `Scene.read`.
    ends: of shapes whose lines have no ends=.  Raises ValueError for the first
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
    begun = read_begun(path, ends=ends, swc=swc)
    if begun.has_solids():
        warnings.warn(
            f"{os.fsdecode(path)}: its solids are not kept: see Scene.read", stacklevel=2
        )
    return all_shapes(begun)


def read_begun(
    path: str | os.PathLike[str], *, ends: Any, swc: str | None
) -> _core.Scene:
    """A scene that is begun, by the arguments of `read_scene`."""
    code = _NOT_GIVEN if ends is None else int(codes_of(ends))
    name = os.fsdecode(path)
    if swc not in _FORMS:
        raise ValueError(f"swc: expected cones or round, found {swc!r}")
    if name == "-":
        name = "./-"  # the reader takes - for standard input
    if not os.access(name, os.R_OK):
        with open(name, "rb"):
            pass
    status, begun, messages = _core.read_scene(os.fsencode(name), code, _FORMS.index(swc) - 1)
    if status != 0:
        text = "; ".join(messages)
        errors = {BAD: ValueError, USAGE: ValueError, MEMORY: MemoryError}
        raise errors.get(status, OSError)(text)
    for text in messages:
        warnings.warn(text, stacklevel=3)
    return begun


def write_scene(
    path: str | os.PathLike[str], shapes: Shapes, labels: ArrayLike | None = None
) -> None:
    """Writes shapes with one axis to a file, one a line, with their labels.

    labels: (...) str, in place of those of the shapes, as in `Shapes.with_labels`.
    `read_scene`, `cylint -s` and `cylint-render` read the same shapes and labels
    from it.  A file is written beside `path` and renamed, as by `Scene.save`.
    Each number is the shortest text that is read as the same float64.  Raises
    ValueError, and writes nothing, for a label with a line feed, a NUL or blanks
    around it, or that begins with in= or out=, or longer than a line of 1 MiB, and
    for a cone whose tangent no angle in degrees has, as some of `tangent_cone`: the
    text has angles.

    >>> import os, tempfile
    >>> folder = tempfile.TemporaryDirectory()
    >>> name = os.path.join(folder.name, "scene")
    >>> rods = cylint.cylinder([0, 0, 0], [[0, 0, 1], [0, 0, 0.1]], 0.5, ends="open")
    >>> cylint.write_scene(name, rods, ["long", "short"])
    >>> print(open(name).read(), end="")
    cylinder 0 0 0 0 0 1 0.5 ends=open long
    cylinder 0 0 0 0 0 0.1 0.5 ends=open short
    >>> read = cylint.read_scene(name)
    >>> read == rods, read.labels
    (array([ True,  True]), array(['long', 'short'], dtype='<U5'))
    """
    name = os.fsdecode(path)
    if name.endswith((".swc", ".SWC")):
        raise ValueError(f"a file *.swc is read as a neuron: {name}")
    (shapes,) = checked([shapes])
    texts = [*scene_text(shapes if labels is None else shapes.with_labels(labels))]
    if os.path.lexists(name) and not os.path.isfile(name):  # a pipe, a device
        with open(name, "wb") as file:
            file.writelines(texts)
        return
    place = os.path.realpath(name)
    with tempfile.TemporaryDirectory(".new", dir=os.path.dirname(place)) as beside:
        part = os.path.join(beside, "part")
        with open(part, "wb") as file:
            file.writelines(texts)
        if os.path.exists(place):
            shutil.copymode(place, part)
        os.replace(part, place)


def scene_text(shapes: Shapes) -> Iterator[bytes]:
    """The text of a scene, in parts.  Raises ValueError for what text cannot hold."""
    row = shapes._in_a_row()
    labels = encoded(row._labels)
    for i in range(0, len(row), _AT_ONCE):
        some = labels and labels[i : i + _AT_ONCE]
        yield _core.write_scene(row.kind[i : i + _AT_ONCE], i, some)


def standard(stream: TextIO | None, name: str) -> BinaryIO:
    """The bytes of standard input or output; the caller may have closed it."""
    if stream is None:
        raise OSError(errno.EBADF, os.strerror(errno.EBADF), name)
    return stream.buffer


def contents(name: str) -> bytes:
    """The bytes of a file, which may be compressed by gzip; `-` is standard input.

    In UTF-8, without a byte order mark; lines end with LF.
    """
    if name == "-":
        data = standard(sys.stdin, "standard input").read()
    else:
        with open(name, "rb") as file:
            data = file.read()
    if data.startswith(b"\x1f\x8b"):
        try:
            data = gzip.decompress(data)
        except (gzip.BadGzipFile, EOFError, zlib.error) as error:
            raise ValueError(f"{name}: not a whole file of gzip: {error}") from None
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        data = data.decode("utf-16", "replace").encode()
    data = data.removeprefix(codecs.BOM_UTF8)
    return data.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
