"""The values of members that are numbers for words."""

from __future__ import annotations

from enum import IntEnum


class _Word(IntEnum):
    """Also reads its number from an array of no dimension, a member of an answer."""

    @classmethod
    def _missing_(cls, value: object) -> _Word | None:
        return cls(value.item()) if getattr(value, "ndim", None) == 0 else None  # type: ignore[attr-defined]


class Kind(_Word):
    """What a shape is."""

    CYLINDER = 1
    CONE = 2
    ACONE = 3
    ECYLINDER = 4
    ECONE = 5
    SPHERE = 6
    CAPSULE = 7
    RCONE = 8
    HALFSPACE = 9


class Ends(_Word):
    """Which caps a shape has, or that it is unbounded."""

    CAPPED = 0
    OPEN = 1
    CAP0 = 2
    CAP1 = 3
    INFINITE = 4
    NAPPE = 5


class Relation(_Word):
    """Which points the whole line, for all t, and the closed solid have in common.

    NONE: the line was refused.
    """

    NONE = -1
    MISS = 0
    TOUCH = 1
    ALONG = 2
    CROSS = 3


class Part(_Word):
    """The part of the surface where a hit lies.

    LATERAL is the lateral surface with its rims and apex; CAP0 and CAP1 are the caps,
    or the round ends, at the base and at the top.
    """

    NONE = -1
    LATERAL = 0
    CAP0 = 1
    CAP1 = 2


class Feature(_Word):
    """Where the closest point of a surface lies.

    Rims and apex belong to the part LATERAL.  The rims of a capsule and a round cone are
    the circles where it touches its balls.
    """

    NONE = -1
    LATERAL = 0
    CAP0 = 1
    CAP1 = 2
    RIM0 = 3
    RIM1 = 4
    APEX = 5


class Side(_Word):
    """Whether the line enters or leaves the solid at a hit, as t grows.

    BOTH: a touch, or the apex of a double cone.
    """

    NONE = -1
    ENTERING = 0
    LEAVING = 1
    BOTH = 2
