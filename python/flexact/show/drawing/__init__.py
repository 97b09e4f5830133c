# SPDX-License-Identifier: BSD-3-Clause
"""What is drawn of a result, as numbers.

Members with their sizes, symbols, poses, shapes, resultants and views; `picture`, `mesh` and
`page` put them down.
"""

from ...analysis.part_stresses import QUANTITIES
from ...model.parts.forms import Form
from .bodies import Solid
from .diagrams import (
    BENDING,
    UNITS,
    Resultants,
    meanings_in,
    names_in,
    quantity_named,
    resultants,
    sides_in,
)
from .drawing import Drawing, drawing_of, joints_of
from .members import Elements, Members
from .movement import Movement, Moving, move, reach_of, swing
from .pose import (
    Pose,
    Strip,
    axes_of,
    cylinders,
    field_along,
    reference_pose,
    solid,
    stations,
)
from .supports import Support, Symbol

__all__ = [
    "BENDING",
    "QUANTITIES",
    "UNITS",
    "Drawing",
    "Elements",
    "Form",
    "Members",
    "Movement",
    "Moving",
    "Pose",
    "Resultants",
    "Solid",
    "Strip",
    "Support",
    "Symbol",
    "axes_of",
    "cylinders",
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
    "sides_in",
    "solid",
    "stations",
    "swing",
]
