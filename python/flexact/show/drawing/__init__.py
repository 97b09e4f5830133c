# SPDX-License-Identifier: BSD-3-Clause
"""What is drawn of a result, as numbers; uses `base`, `core`, `model` and `result` alone.

Members with their sizes, symbols, poses, shapes, resultants and views; `picture`, `mesh` and
`page` put them down.
"""

from ...analysis.resultants import QUANTITIES
from ...model.parts.forms import Form
from .bodies import Solid
from .drawing import Drawing, drawing_of, joints_of
from .drawing_pose import Moving, Pose, reference_pose
from .drawing_spaces import SpaceShape, dashes, shape_of_space
from .drawing_supports import Arrows, Support, Supports
from .hinges import Hinges
from .members import Members
from .movement import Movement, move, reach_of
from .pose import Field, Strip, field_along, stations
from .quantities import BENDING, UNITS, meanings_in, names_in, quantity_named, sides_in
from .resultants import Resultants, resultants
from .solids import axes_of, cylinders, solid
from .swing import swing

__all__ = [
    "BENDING",
    "QUANTITIES",
    "UNITS",
    "Arrows",
    "Drawing",
    "Field",
    "Form",
    "Hinges",
    "Members",
    "Movement",
    "Moving",
    "Pose",
    "Resultants",
    "Solid",
    "SpaceShape",
    "Strip",
    "Support",
    "Supports",
    "axes_of",
    "cylinders",
    "dashes",
    "drawing_of",
    "field_along",
    "joints_of",
    "meanings_in",
    "move",
    "names_in",
    "quantity_named",
    "reach_of",
    "reference_pose",
    "resultants",
    "shape_of_space",
    "sides_in",
    "solid",
    "stations",
    "swing",
]
