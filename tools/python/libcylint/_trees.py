"""Trees as tables of cylinders (QSM)."""

from __future__ import annotations

import csv
import os
import re
import warnings

import numpy as np

from ._arguments import Doubles
from ._files import contents
from ._shapes import Shapes, capsule, cylinder

_TREEQSM = "radius length startx starty startz axisx axisy axisz"


def read_qsm(
    path: str | os.PathLike[str], *, round: bool = False, treeqsm: bool = False,
    ends: str = "capped",
) -> Shapes:
    """Reads a tree as a table of cylinders, also of a file *.gz; `-`: standard input.

    The table has a header line, as aRchi, rTwig and SimpleForest write it.  Columns
    are found by their names, whatever the case and punctuation: startX or start_x and
    so on; endX, or else axis_x and length; radius or radius_cyl; ID or cyl_ID.
    Commas, semicolons or tabs separate them, or blanks, if the header has none of
    these.  Blank lines and lines that begin with # are skipped.
    treeqsm: text of TreeQSM, which has no header: radius, length, start and axis.

    round: capsules, whose round ends fill the joints, in place of cylinders.
    ends: those of all shapes; with "open", distances are from the bark alone.
    The label of a shape is its ID, or if there is none, the number of its row, from 1.
    Cylinders without length or radius are left out; a warning has their number.
    With `round` those without length are balls.

    Raises ValueError for the first bad row, OSError if the file cannot be read.

    >>> import os, tempfile
    >>> name = os.path.join(tempfile.mkdtemp(), "tree.csv")
    >>> with open(name, "w") as file:
    ...     print("ID,radius,startX,startY,startZ,endX,endY,endZ", file=file)
    ...     print("7,.5,0,0,0,0,0,2", file=file)
    >>> tree = cylint.read_qsm(name)
    >>> tree, tree.labels
    (<libcylint.Shapes (1,): 1 cylinder>, array(['7'], dtype='<U1'))
    """
    table = _Table(os.fspath(path), treeqsm)
    ended = "endx" in table.names
    last = ["endx", "endy", "endz"] if ended else ["axisx", "axisy", "axisz", "length"]
    numbers = table.numbers(["radius", "startx", "starty", "startz", *last])
    r, p0, p1 = numbers[:, 0], numbers[:, 1:4], numbers[:, 4:7]
    if not ended:
        with np.errstate(over="ignore"):
            p1 = p0 + numbers[:, 7:] * p1
    for wrong, text in (
        (~np.isfinite(np.c_[numbers, p1]).all(axis=1), "a number is not finite"),
        (r < 0, "the radius is negative"),
    ):
        if wrong.any():
            raise table.refuse(table.rows[np.argmax(wrong)][0], text)
    labels = np.arange(1, len(r) + 1).astype(str)
    if "id" in table.names:
        at = table.names.index("id")
        labels = np.array([fields[at].strip() for _, fields in table.rows], str)
    kept = (r != 0) & (bool(round) | (p0 != p1).any(axis=1))
    if not kept.all():
        count = np.count_nonzero(~kept)
        warnings.warn(
            f"{table.name}: cylinders left out, of no length or radius: {count}", stacklevel=2
        )
    make = capsule if round else cylinder
    return make(p0[kept], p1[kept], r[kept], ends=ends).with_labels(labels[kept])


class _Table:
    """Rows of fields with the numbers of their lines, and the names of the columns."""

    def __init__(self, name: str, treeqsm: bool) -> None:
        lines = contents(name).decode("utf-8", "surrogateescape").split("\n")
        self.name = name
        rows = [
            (number, line) for number, line in enumerate(lines, 1)
            if line.strip()[:1] not in ("", "#")
        ]
        self.head, header = rows[0] if rows else (1, "")
        self.separator: str | None = None
        if treeqsm:
            self.names = _TREEQSM.split()
            has_header = re.match(r'\s*"?radius', header, re.IGNORECASE) is not None
        elif rows:
            self.separator = next((s for s in ";\t," if s in header), None)
            self.names = [_plain(field) for field in header.split(self.separator)]
            has_header = True
        else:
            raise ValueError(f"{name}: expected a header line, found the end of the file")
        self.rows = [(number, self._fields(number, line)) for number, line in rows[has_header:]]
        for number, fields in self.rows:
            if not treeqsm and any(map(str.strip, fields[len(self.names):])):
                raise self._refuse_width(number, fields)

    def refuse(self, number: int, text: str) -> ValueError:
        """The error that names a line."""
        return ValueError(f"{self.name}:{number}: {text}")

    def _refuse_width(self, number: int, fields: list[str]) -> ValueError:
        return self.refuse(number, f"expected {len(self.names)} columns, found {len(fields)}")

    def _fields(self, number: int, line: str) -> list[str]:
        if self.separator is None:
            line = " ".join(line.split())
        fields, *others = csv.reader([line, ""], delimiter=self.separator or " ")
        if not others:  # the empty line belongs to a text in quotes
            raise self.refuse(number, "a quote has no end")
        return fields

    def numbers(self, columns: list[str]) -> Doubles:
        """These columns of all rows.  Raises ValueError for the first bad row."""
        for column in columns:
            if column not in self.names:
                raise self.refuse(self.head, f"the header names no column {column!r}")
        places = [self.names.index(column) for column in columns]
        table = np.empty((len(self.rows), len(places)))
        for i, (number, fields) in enumerate(self.rows):
            if len(fields) <= max(places):
                raise self._refuse_width(number, fields)
            for k, at in enumerate(places):
                try:
                    table[i, k] = float(fields[at].replace("_", "?"))
                except ValueError:
                    text = f"column {at + 1}: expected a number, found {fields[at]!r}"
                    raise self.refuse(number, text) from None
        return table


def _plain(field: str) -> str:
    """The name of a column, without its case and punctuation."""
    plain = re.sub("[^a-z0-9]", "", field.lower())
    plain = re.sub("^cylid$", "id", plain)
    return re.sub("^(radiuscyl|cylradius)$", "radius", plain)
