# SPDX-License-Identifier: BSD-3-Clause
"""A traced path as values."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..analysis.freedoms import Freedom
from ..analysis.locate import position_of
from ..analysis.result import Result
from ..analysis.verdict import Verdict
from ..core.arrays import FloatArray
from ..core.elements import Dual, NodeKind, dual_table
from ..model.configuration import Configuration
from ..model.parts.parts import natural
from ..motion import Held, Stop
from ..show.drawing.pose import Pose
from ..show.drawing.selection import Selection
from ..util.records import Frozen, cached_property
from ..util.rotations import vector_of

#: Before the name of a body that only turns back in its rotation.
ROTATION = "rotation of "


class Point(NamedTuple):
    """A position node of the model as given."""

    node: int
    """Its index."""
    name: str
    """Such as "E", or "node 5" where it has none, or not for itself alone."""


class Names:
    """Names of what moves."""

    def __init__(self, result: Result) -> None:
        """Keep the result."""
        self.result, self.parts = result, result.parts

    def of_node(self, node: int) -> str:
        """The body of a node of the model as given, by its index; else the point."""
        body = self.parts.body_at.get(node)
        if body is not None:
            return self.parts.of_body(body).name
        position = self.parts.place_of(node)
        name = "" if position is None else self.parts.name_of_point(position)
        number = self.parts.data.arrays.node_number[node if position is None else position]
        return name or f"node {number}"

    def turning(
        self, nodes: Sequence[int], resting: np.ndarray, turns: np.ndarray
    ) -> tuple[str, ...]:
        """Bodies and points that turn back where nodes, by their index as analysed, rest.

        A body does so if all of its nodes that move do, and its rotation if those that turn do.
        """
        given, kinds = self.result.condensed.nodes, self.result.given.arrays.node_kind
        rests = {int(given[node]) for node in np.flatnonzero(resting | turns).tolist()}
        names: set[str] = set()
        for node in nodes:
            name = self.of_node(int(given[node]))
            mine = self._moving.get(name, set())
            turned = {each for each in mine if kinds[each] > NodeKind.POSITION}
            if mine <= rests:
                names.add(name)
            elif turned and turned <= rests:
                names.add(f"{ROTATION}{name}")
        return tuple(sorted(names, key=natural))

    @cached_property
    def _moving(self) -> dict[str, set[int]]:
        """Nodes of the model as given that can move and were analysed, by what they belong to."""
        made: dict[str, set[int]] = {}
        classes = self.result.data.arrays.coordinate_class
        free = np.flatnonzero((classes > 1).any(axis=0)).tolist()
        for node in free:
            given = int(self.result.condensed.nodes[node])
            made.setdefault(self.of_node(given), set()).add(given)
        return made

    def points(self, most: int) -> tuple[Point, ...]:
        """Position nodes that can move, by their numbers; at most so many."""
        arrays = self.result.given.arrays
        free = (arrays.coordinate_class > 1).any(axis=0) & (arrays.node_kind <= NodeKind.POSITION)
        nodes = sorted(
            np.flatnonzero(free).tolist(), key=lambda node: int(arrays.node_number[node])
        )[:most]
        own = [self.parts.name_of_point(node) for node in nodes]
        return tuple(
            Point(
                node,
                name
                if name and own.count(name) == 1
                else f"{name} (node {arrays.node_number[node]})".strip()
                if name
                else f"node {arrays.node_number[node]}",
            )
            for node, name in zip(nodes, own, strict=True)
        )

    def bodies(self, most: int) -> tuple[Point, ...]:
        """An orientation node of each body that can turn, with the body's name; at most so many."""
        kinds = self.result.given.arrays.node_kind
        classes = self.result.given.arrays.coordinate_class
        made: list[Point] = []
        for k, body in enumerate(self.parts.bodies):
            turns = [
                node
                for node in body.orientations
                if kinds[node] > NodeKind.POSITION and bool((classes[:, node] > 1).any())
            ]
            if turns and len(made) < most:
                made.append(Point(turns[0], self.parts.of_body(k).name))
        return tuple(made)


class Drive(NamedTuple):
    """What drives a path, and how to look at it."""

    freedom: Freedom
    held: Held

    def rate(self, where: Configuration, along: FloatArray) -> float:
        """How fast it changes along a direction (n,)."""
        part, owner = self.freedom.place
        if self.freedom.is_coordinate:
            return float(self.held.at_nodes(along)[owner, part])
        return self.held.rate(where, 6 * owner + part, along)

    def value(self, where: Configuration, pose: Pose) -> float:
        """By how much it has changed since the reference [m, rad]; of a pose as given.

        Of a declared rotation it is the component of the rotation vector.
        """
        part, owner = self.freedom.place
        if not self.freedom.is_coordinate:
            value = self.held.deformation(where, 6 * owner + part)
            return value * self.held.unit if drive_unit(self.freedom) == "m" else value
        analysis = self.freedom.analysis
        node = int(analysis.condensed.nodes[owner])
        if drive_unit(self.freedom) == "m":
            start = analysis.given.arrays.node_value[part, node]
            return float(pose.position[node, part] - start)
        return float(vector_of(pose.rotation[node][np.newaxis])[0, part])


def drive_unit(freedom: Freedom) -> str:
    """Of a declared coordinate or deformation: m or rad."""
    part, owner = freedom.place
    arrays = freedom.analysis.data.arrays
    if freedom.is_coordinate:
        return "m" if arrays.node_kind[owner] <= NodeKind.POSITION else "rad"
    turns = dual_table()[arrays.element_kind[owner], part] == Dual.MOMENT
    return "rad" if turns else "m"


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
