# SPDX-License-Identifier: BSD-3-Clause
"""A motion of a mechanism as its designer sees it: what each body does."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..core.arrays import FloatArray
from ..deck.rendering import model_error
from ..model.data import ModelData
from ..model.parts.condensing import Condensed
from ..model.parts.parts import Joint, Part, PartKind, natural
from ..util.records import Frozen, cached_property, read_only
from .decomposition import Decomposition
from .locate import part_of, position_of
from .screws import Screw, screw_of


@dataclass(frozen=True, eq=False)
class Velocities(Frozen):
    """The velocities of all nodes of a model.

    Attributes:
        data: The model.
        displacement: (nodes, 3) of each position [m]; zero rows for orientations.
        rotation: (nodes, 3) of each orientation [rad]; zero rows for positions.
    """

    data: ModelData
    displacement: FloatArray
    rotation: FloatArray


class NodeMotion(NamedTuple):
    """What a point does."""

    displacement: FloatArray
    """(3,) [m]."""
    rotation: FloatArray | None
    """(3,) [rad]; None where the point has no orientation, or several."""


class BodyMotion(NamedTuple):
    """Bodies and joints that move as one."""

    bodies: tuple[Part, ...]
    """The bodies, by name; none where joints alone move so."""
    joints: tuple[Joint, ...]
    """Points that belong to no body and move with them."""
    screw: Screw
    """How they move."""

    @property
    def is_joint(self) -> bool:
        """Whether no real body is among them."""
        return not self.bodies

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the bodies; without bodies of the joints."""
        return tuple(str(each) for each in self.bodies or self.joints)

    def __str__(self) -> str:
        """In words."""
        together = "" if len(self.names) == 1 else " (together)"
        return f"{', '.join(self.names)}{together} {self.screw}"


#: A body or a joint, and how it moves.
_Item = tuple[Part | Joint, Screw]


def _is_of_points(group: Sequence[_Item]) -> bool:
    """Whether none of a group is a body or has an orientation."""
    return all(isinstance(one, Joint) and one.orientation is None for one, _ in group)


class Moves:
    """What motions have in common: the velocities of all nodes, and what bodies and joints do."""

    analysis: Decomposition

    if TYPE_CHECKING:
        # A property here would be the default of a field of this name.
        @property
        def analysed(self) -> Velocities:
            """The velocities of the nodes of the model as it was analysed."""

    @property
    def condensed(self) -> Condensed:
        """The model at whose nodes it is a motion, and the one that was analysed."""
        return self.analysis.condensed

    @property
    def displacement(self) -> FloatArray:
        """(nodes, 3) displacement of each position [m]; zero rows for orientations."""
        return self._at_nodes[0]

    @property
    def rotation(self) -> FloatArray:
        """(nodes, 3) rotation of each orientation [rad]; zero rows for positions."""
        return self._at_nodes[1]

    @cached_property
    def _at_nodes(self) -> tuple[FloatArray, FloatArray]:
        analysed = self.analysed
        moved, turned = self.condensed.motion(analysed.displacement, analysed.rotation)
        return read_only(moved), read_only(turned)

    @cached_property
    def bodies(self) -> tuple[BodyMotion, ...]:
        """Bodies and joints that move, those that move as one together; bodies first, by name."""
        groups = self._with_points_as_one(self._grouped([item for item in self._items if item[1]]))
        made = [
            BodyMotion(
                tuple(one for one, _ in group if isinstance(one, Part)),
                tuple(one for one, _ in group if isinstance(one, Joint)),
                self._screw_of_all(group),
            )
            for group in groups
        ]
        return tuple(sorted(made, key=lambda one: one.is_joint))

    def of(self, body: object) -> Screw:
        """The screw of a body or joint; one that does not move is of the kind `NONE`.

        Args:
            body: Its name, its part, what the model handed out for it, or its index among
                `analysis.parts.bodies`; of a joint its name or handle.

        Raises:
            ModelError: there is no such body or joint, or it is none.
        """
        joint = self._joint(body)
        if joint is not None:
            return self._of_joint(joint)
        bodies = self.analysis.carriers.bodies
        if isinstance(body, int) and not isinstance(body, bool):
            if not 0 <= body < len(bodies):
                raise model_error("no-such-part", f"there is no body {body} of {len(bodies)}")
            return self._of_body(body)
        part = part_of(self.analysis.parts, body)
        if part.kind is not PartKind.BODY:
            raise model_error(
                "no-body",
                f"{part.name} is no body but a {part.kind}",
                f"ask for one of {', '.join(each.name for each in bodies)}" if bodies else "",
            )
        return self._of_body(bodies.index(part))

    def at(self, point: object) -> NodeMotion:
        """Displacement and rotation of a point.

        Args:
            point: Its name, the number of its position node, or what the model handed out.

        Raises:
            ModelError: there is no such point.
        """
        parts = self.analysis.parts
        position = position_of(parts, point)
        orientation = getattr(point, "orientation", None)
        own = [node for node, place in parts.position_of.items() if place == position]
        node = own[0] if len(own) == 1 else None
        if orientation is not None:
            node = self.analysis.given.node_index.get(orientation)
        return NodeMotion(
            self.displacement[position], None if node is None else self.rotation[node]
        )

    @property
    def is_internal(self) -> bool:
        """Whether nothing moves but what is inside of sheets and wires."""
        return not self.bodies and bool(self.internal_to)

    @cached_property
    def nodes(self) -> tuple[int, ...]:
        """Indices of the nodes that move, of the model as given."""
        return tuple(np.flatnonzero(self._size > self._rest).tolist())

    @cached_property
    def ends(self) -> tuple[BodyMotion, ...]:
        """Of a motion in which nothing moves but ends of flexures, how each of them turns."""
        carriers = self.analysis.carriers
        own = {node for node, _ in carriers.own_ends}
        if not own.issuperset(self.nodes):
            return ()
        joints = [carriers.joint(self.analysis.parts.place_of(node), node) for node in self.nodes]
        return tuple(BodyMotion((), (joint,), self._of_joint(joint)) for joint in joints)

    @cached_property
    def internal_to(self) -> tuple[Part, ...]:
        """The sheets and wires inside of which something moves, by name."""
        return tuple(
            part
            for part, nodes in self.analysis.carriers.insides
            if self._size[list(nodes)].max(initial=0.0) > self._rest
        )

    def _joint(self, target: object) -> Joint | None:
        """The joint of a name, or at the point of a handle; None where there is not just one."""
        joints = self.analysis.carriers.joints
        if isinstance(target, str):
            found = [joint for joint in joints if joint.name == target]
        elif hasattr(target, "position"):
            position = position_of(self.analysis.parts, target)
            found = [joint for joint in joints if joint.position == position]
        else:
            return None
        return found[0] if len(found) == 1 else None

    # What it is made of -----------------------------------------------------

    @property
    def _length(self) -> float:
        return self.analysis.characteristic_length

    @cached_property
    def _size(self) -> FloatArray:
        """(nodes,) how much each node moves, rotations as lengths."""
        moved, turned = (np.linalg.norm(v, axis=1) for v in (self.displacement, self.rotation))
        return np.asarray(moved + self._length * turned)

    @cached_property
    def _rest(self) -> float:
        return self.analysis.rounding * float(self._size.max(initial=0.0))

    @cached_property
    def _items(self) -> tuple[_Item, ...]:
        carriers = self.analysis.carriers
        bodies = [(body, self._of_body(k)) for k, body in enumerate(carriers.bodies)]
        bodies.sort(
            key=lambda item: (
                natural(item[0].name),
                np.round(item[1].centre / self._length, 9).tolist(),
            )
        )
        joints = [(joint, self._of_joint(joint)) for joint in carriers.joints]
        joints.sort(key=lambda item: item[0].orientation is None)
        return (*bodies, *joints)

    def _with_points_as_one(self, groups: list[list[_Item]]) -> list[list[_Item]]:
        """Groups of points without orientations joined, if they move as one body would."""
        points = [group for group in groups if _is_of_points(group)]
        items = [item for group in points for item in group]
        screw = self._fitted([own for _, own in items]) if len(points) > 1 else None
        if screw is None:
            return groups
        # The screw as it is seen from each of them.
        joined = [
            (one, self._screw(screw.rotation, own.velocity, own.centre)) for one, own in items
        ]
        return [*(group for group in groups if not _is_of_points(group)), joined]

    def _fitted(self, screws: Sequence[Screw]) -> Screw | None:
        """The screw that points move by, None where there is none or it is not the only one."""
        places = np.array([screw.centre for screw in screws])
        moved = np.array([screw.velocity for screw in screws])
        centre, mean = places.mean(axis=0), moved.mean(axis=0)
        arms = (places - centre) / self._length
        axes = (2,) if self.analysis.given.planar else (0, 1, 2)
        matrix = np.stack([np.cross(np.eye(3)[axis], arms).ravel() for axis in axes], axis=1)
        turns, _, rank, _ = np.linalg.lstsq(
            matrix, (moved - mean).ravel(), rcond=self.analysis.rounding
        )
        off = np.abs(matrix @ turns - (moved - mean).ravel()).max()
        if rank < len(axes) or off > 10.0 * self._rest:
            return None
        rotation = np.zeros(3)
        rotation[list(axes)] = turns / self._length
        return self._screw(rotation, mean, centre)

    def _of_body(self, body: int) -> Screw:
        """Of the mean velocity, which is that of the mean of its points."""
        nodes = self.analysis.parts.bodies[body]
        places = self.analysis.given.arrays.node_value[:3, list(nodes.positions)]
        return self._screw(
            self.rotation[list(nodes.orientations)].mean(axis=0),
            self.displacement[list(nodes.positions)].mean(axis=0),
            places.mean(axis=1),
        )

    def _of_joint(self, joint: Joint) -> Screw:
        place = self.analysis.carriers.place_of(joint)
        none = np.zeros(3)
        return self._screw(
            none if joint.orientation is None else self.rotation[joint.orientation],
            none if joint.position is None else self.displacement[joint.position],
            none if place is None else place,
        )

    def _screw(self, rotation: FloatArray, velocity: FloatArray, centre: FloatArray) -> Screw:
        return screw_of(
            *(rotation, velocity, centre, self._length),
            rest=self._rest,
            rounding=self.analysis.rounding,
            units=self.analysis.given.units,
        )

    def _grouped(self, items: list[_Item]) -> list[list[_Item]]:
        """Those that move as one body would: each with the first that it agrees with."""
        velocity, rotation, centre = (
            np.array([getattr(screw, name) for _, screw in items]).reshape(-1, 3)
            for name in ("velocity", "rotation", "centre")
        )
        joints = [one if isinstance(one, Joint) else None for one, _ in items]
        placed = np.array([joint is None or joint.position is not None for joint in joints], bool)
        turning = np.array([j is None or j.orientation is not None for j in joints], bool)
        left, groups = np.ones(len(items), bool), []
        while left.any():
            i = int(np.argmax(left))
            arms = centre - centre[i]
            far = 1.0 + np.linalg.norm(arms, axis=1) / self._length
            limit = 10.0 * self._rest * far
            off = velocity[i] + np.cross(rotation[i], arms) - velocity
            turned = np.linalg.norm(rotation - rotation[i], axis=1) * self._length
            same = ~placed | (np.linalg.norm(off, axis=1) <= limit)
            same &= ~turning | (turning[i] & (turned <= limit))
            same[i] = True
            groups.append([items[k] for k in np.flatnonzero(same & left).tolist()])
            left &= ~same
        return groups

    def _screw_of_all(self, items: Sequence[_Item]) -> Screw:
        """Of several that move as one, about the middle of all."""
        bodies = [screw for one, screw in items if isinstance(one, Part)]
        screws = bodies or [screw for _, screw in items]
        if len(screws) == 1:
            return screws[0]
        centre = np.mean([screw.centre for screw in screws], axis=0)
        return self._screw(
            np.mean([screw.rotation for screw in screws], axis=0),
            np.mean([screw.at(centre) for screw in screws], axis=0),
            centre,
        )
