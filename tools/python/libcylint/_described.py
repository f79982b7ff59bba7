"""Answers whose members are computed when they are first used."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray


class Described:
    """Answers with their shapes and what was given: lines or points.  They are
    pickled with those shapes alone that they are about."""

    _columns: tuple[str, ...]  # the members, in the order of _write
    _shapes: tuple[Any, NDArray[np.int64] | None]
    """An array of shapes, and the numbers of the shapes in it, -1 for none; None: they
    broadcast with the lines or points.  The arrays must not change."""

    def __init__(self, given: Any, axes: tuple[int, ...]) -> None:
        self._given = given
        self._axes = axes  # of the members of width 1

    def __getstate__(self) -> dict[str, Any]:
        state = self.__dict__ | {"_shapes": self._shapes}
        state.pop("_scene", None)
        return state

    def _write(self, columns: list[NDArray[Any] | None]) -> None:
        """Computes the columns that are not None."""
        raise NotImplementedError


def member(text: str, width: int = 1, kind: Any = np.float64) -> Any:
    """A member that has the axes of the answers, and if width is not 1 one more."""

    def compute(answers: Described) -> NDArray[Any]:
        axes, name = answers._axes, made.attrname
        column = np.empty(axes if width == 1 else (*axes, width), kind)
        answers._write([column if name == c else None for c in answers._columns])
        return column

    compute.__doc__ = text
    made = cached_property(compute)
    return made
