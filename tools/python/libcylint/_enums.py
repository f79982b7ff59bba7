"""The values of members that are numbers for words."""

from enum import IntEnum


class Kind(IntEnum):
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


class Ends(IntEnum):
    """Which caps a shape has, or that it is unbounded."""

    CAPPED = 0
    OPEN = 1
    CAP0 = 2
    CAP1 = 3
    INFINITE = 4
    NAPPE = 5


class Relation(IntEnum):
    """How the whole line, for all t, lies to the closed solid.

    NONE: the line was refused.
    """

    NONE = -1
    MISS = 0
    TOUCH = 1
    ALONG = 2
    CROSS = 3


class Part(IntEnum):
    """The part of the surface where a hit lies."""

    NONE = -1
    LATERAL = 0
    CAP0 = 1
    CAP1 = 2


class Feature(IntEnum):
    """Where the closest point of a surface lies.

    Rims and apex belong to the part LATERAL.  The rims of a capsule and a round
    cone are the circles where it touches its balls.
    """

    NONE = -1
    LATERAL = 0
    CAP0 = 1
    CAP1 = 2
    RIM0 = 3
    RIM1 = 4
    APEX = 5


class Side(IntEnum):
    """Whether the line enters or leaves the solid at a hit, as t grows."""

    NONE = -1
    ENTERING = 0
    LEAVING = 1
    BOTH = 2
