"""Exact intersections and distances of lines, points, cylinders and cones.

The functions take and return arrays.  Each float64 stands for one real number, and
the answers are exact for these numbers: no tolerance, the same bits on every processor.

>>> import numpy as np
>>> import libcylint as cylint
>>> rods = cylint.cylinder([[0, 0, 0], [4, 0, 0]], [[0, 0, 9], [4, 0, 9]], 1)
>>> hit = cylint.intersect(rods, [-5, 0, 3], [1, 0, 0])
>>> hit.t
array([[ 4.,  6.],
       [ 8., 10.]])

All lengths have the same unit, which may be any.  A line is o + t d; t counts
multiples of d, which need not have length 1.
"""

from . import _core
from ._closest import ClosestPoints, ShapesWithin
from ._enums import Ends, Feature, Kind, Part, Relation, Side
from ._files import read_scene, write_scene
from ._hits import Hits, intersect
from ._molecules import read_molecule
from ._scene import AllHits, Boundaries, ClosestShapes, Depths, NearestHits, Pieces, Scene
from ._shapes import (
    Shapes, angle_cone, capsule, concatenate, cone, cylinder, elliptic_cone,
    elliptic_cylinder, halfspace, round_cone, sphere, tangent_cone, tube,
)
from ._trees import read_qsm

__version__: str = _core.version

__all__ = [
    "AllHits", "Boundaries", "ClosestPoints", "ClosestShapes", "Depths", "Ends",
    "Feature", "Hits", "Kind", "NearestHits", "Part", "Pieces", "Relation", "Scene",
    "Shapes", "ShapesWithin", "Side", "__version__", "angle_cone", "capsule",
    "concatenate", "cone", "cylinder", "elliptic_cone", "elliptic_cylinder",
    "halfspace", "intersect", "read_molecule", "read_qsm", "read_scene", "round_cone",
    "sphere", "tangent_cone", "tube", "write_scene",
]
