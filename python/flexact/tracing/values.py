# SPDX-License-Identifier: BSD-3-Clause
"""A traced path as values."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..analysis.freedoms import Freedom
from ..analysis.locate import position_of
from ..analysis.result import Result
from ..analysis.verdict import Verdict
from ..core.arrays import FloatArray
from ..core.elements import Dual, NodeKind, dual_table
from ..model.configuration import Configuration
from ..motion import Stop
from ..show.drawing.pose import Pose
from ..show.drawing.selection import Selection
from ..util.records import Frozen

#: Before the name of a body that only turns back in its rotation.
ROTATION = "rotation of "


def points_of(result: Result, most: int) -> dict[int, str]:
    """Names of position nodes that can move, in the order of their numbers; at most so many."""
    arrays = result.given.arrays
    free = (arrays.coordinate_class > 1).any(axis=0) & (arrays.node_kind <= NodeKind.POSITION)
    number = arrays.node_number.tolist()
    nodes = sorted(np.flatnonzero(free).tolist(), key=number.__getitem__)[:most]
    own = {node: result.parts.name_of_point(node) for node in nodes}
    every = list(own.values())
    return {
        node: name
        if name and every.count(name) == 1
        else f"{name} (node {number[node]})"
        if name
        else f"node {number[node]}"
        for node, name in own.items()
    }


def bodies_of(result: Result, most: int) -> dict[int, str]:
    """An orientation node of each body that can turn, with the body's name; at most so many."""
    arrays = result.given.arrays
    turns = (arrays.coordinate_class > 1).any(axis=0) & (arrays.node_kind > NodeKind.POSITION)
    made: dict[int, str] = {}
    for k, body in enumerate(result.parts.bodies):
        node = next((each for each in body.orientations if turns[each]), None)
        if node is not None and len(made) < most:
            made[node] = result.parts.of_body(k).name
    return made


def drive_unit(freedom: Freedom) -> str:
    """Of a declared coordinate or deformation: m or rad."""
    part, owner = freedom.place
    arrays = freedom.analysis.data.arrays
    if freedom.is_coordinate:
        return "m" if arrays.node_kind[owner] <= NodeKind.POSITION else "rad"
    return "rad" if dual_table()[arrays.element_kind[owner], part] == Dual.MOMENT else "m"


@dataclass(frozen=True, eq=False)
class DeadPoint(Frozen):
    """What is special at a place of a path.

    Attributes:
        turning: Bodies and points, by name, that come to rest there and turn back; "rotation of"
            a body that turns back while it goes on moving.
        is_drive: Whether the declared coordinate or deformation does: it can be driven no farther.
        directions: In how many independent directions the mechanism can move there, if these are
            more than before and behind; 0 where they are not.
    """

    turning: tuple[str, ...] = ()
    is_drive: bool = False
    directions: int = 0

    @property
    def is_branch(self) -> bool:
        """Whether other paths branch off."""
        return self.directions > 0


@dataclass(frozen=True, eq=False)
class Step(Frozen):
    """A configuration of a path.

    Attributes:
        arc: Where it is along the path [m]: how far the node has gone that moves farthest, a
            rotation of 1 rad counting as the model's size; negative against the motion.
        configuration: Of the model as it was analysed, such as `flexact.deformations` takes.
        pose: Where all nodes of the model as given are.
        residual: The largest held deformation, lengths by the model's size, angles in radians.
        values: The smallest singular values of the scaled D(c), theory.md (2), ascending, at
            most six.
        under_constrained: Number of motions that nothing determines, in this configuration.
        over_constrained: Number of self-stresses likewise.
        drive: By how much the declared coordinate or deformation has changed [m, rad]; NaN of a
            motion that nothing determines.
        dead: What is special here; None where nothing is.
    """

    arc: float
    configuration: Configuration
    pose: Pose
    residual: float
    values: FloatArray
    under_constrained: int
    over_constrained: int
    drive: float = np.nan
    dead: DeadPoint | None = None

    @property
    def verdict(self) -> Verdict:
        """Of the mechanism in this configuration."""
        if self.under_constrained:
            return Verdict.BOTH if self.over_constrained else Verdict.UNDER
        return Verdict.OVER if self.over_constrained else Verdict.EXACT


@dataclass(frozen=True, eq=False)
class Way(Frozen):
    """How far a path was followed one way.

    Attributes:
        length: How far [m].
        stop: Why not farther.
    """

    length: float
    stop: Stop


@dataclass(frozen=True, eq=False, repr=False)
class Traced(Frozen):
    """The path of a motion, or of a declared degree of freedom, both ways from the reference.

    Attributes:
        result: The analysis of the reference.
        shown: The motion that was followed.
        size: Of the model [m]: the largest distance between positions; 1 without extent.
        steps: Along the path, from the end against the motion to the end along it; dead points
            are among them.
        against: How far it was followed against the motion.
        along: How far along it.
    """

    result: Result
    shown: Selection
    size: float
    steps: tuple[Step, ...]
    against: Way
    along: Way

    @property
    def reference(self) -> int:
        """Which of the steps is the reference."""
        return int(np.argmin(np.abs([step.arc for step in self.steps])))

    @property
    def arc(self) -> FloatArray:
        """(steps,) where each step is along the path [m]."""
        return np.array([step.arc for step in self.steps])

    @property
    def residual(self) -> float:
        """The largest held deformation on the path, as of a step."""
        return max(step.residual for step in self.steps)

    @property
    def dead_points(self) -> tuple[Step, ...]:
        """The steps at which something is special."""
        return tuple(step for step in self.steps if step.dead is not None)

    def positions(self, point: object) -> FloatArray:
        """(steps, 3) where a point of the model is [m].

        Args:
            point: Its name, the number of its position node, or what the model handed out.

        Raises:
            ModelError: there is none, or there are several.
        """
        node = position_of(self.result.parts, point)
        return np.array([step.pose.position[node] for step in self.steps])

    def __repr__(self) -> str:
        """How far it goes."""
        return (
            f"<Trace: {len(self.steps)} steps, {self.against.length:.4g} m back and "
            f"{self.along.length:.4g} m on, {len(self.dead_points)} dead points>"
        )
