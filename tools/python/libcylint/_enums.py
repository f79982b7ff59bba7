"""The values of members that are numbers for words."""

from enum import IntEnum


class _Word(IntEnum):
    """Also reads its number from an array of no dimension, a member of an answer."""

    @classmethod
    def _missing_(cls, value):
        return cls(value.item()) if getattr(value, "ndim", None) == 0 else None


Kind = _Word(
    "Kind", "CYLINDER CONE ACONE ECYLINDER ECONE SPHERE CAPSULE RCONE HALFSPACE"
)
Kind.__doc__ = "What a shape is."

Ends = _Word("Ends", "CAPPED OPEN CAP0 CAP1 INFINITE NAPPE", start=0)
Ends.__doc__ = "Which caps a shape has, or that it is unbounded."

Relation = _Word("Relation", "NONE MISS TOUCH ALONG CROSS", start=-1)
Relation.__doc__ = """How the whole line, for all t, lies to the closed solid.

NONE: the line was refused.
"""

Part = _Word("Part", "NONE LATERAL CAP0 CAP1", start=-1)
Part.__doc__ = """The part of the surface where a hit lies.

LATERAL is the side of the shape, with its rims and apex; CAP0 and CAP1 are the caps,
or the round ends, at the base and at the top.
"""

Feature = _Word("Feature", "NONE LATERAL CAP0 CAP1 RIM0 RIM1 APEX", start=-1)
Feature.__doc__ = """Where the closest point of a surface lies.

Rims and apex belong to the part LATERAL.  The rims of a capsule and a round cone are
the circles where it touches its balls.
"""

Side = _Word("Side", "NONE ENTERING LEAVING BOTH", start=-1)
Side.__doc__ = """Whether the line enters or leaves the solid at a hit, as t grows.

BOTH: a touch, or the apex of a double cone.
"""
