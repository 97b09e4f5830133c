"""What is drawn of a model: members with their sizes, symbols, poses, shapes and resultants.

Numbers alone; what draws them (pictures, meshes, pages) stands elsewhere.
"""

from .colours import QUANTITIES
from .field import Field, field_along
from .forms import Form
from .hinges import Hinges
from .joints import joints_of
from .members import Members, frames_along
from .movement import Movement, move, reach_of
from .moving import Moving
from .pose import Pose, reference_pose
from .resultants import Resultants, resultants
from .scene import Scene, scene_of
from .shapes import Strip, stations
from .solids import Solid, solid
from .supports import Arrows, Support, Supports

__all__ = [
    "QUANTITIES",
    "Arrows",
    "Field",
    "Form",
    "Hinges",
    "Members",
    "Movement",
    "Moving",
    "Pose",
    "Resultants",
    "Scene",
    "Solid",
    "Strip",
    "Support",
    "Supports",
    "field_along",
    "frames_along",
    "joints_of",
    "move",
    "reach_of",
    "reference_pose",
    "resultants",
    "scene_of",
    "solid",
    "stations",
]
