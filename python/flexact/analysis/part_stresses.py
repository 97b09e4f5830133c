# SPDX-License-Identifier: BSD-3-Clause
"""A self-stress as its designer sees it: what parts press on each other.

What an element exerts at its nodes is -D'sigma: the force at a position and the moment at an
orientation that do the work of its stress resultants. Of one element they are in balance, and of
all elements together at each coordinate that is neither fixed nor independent.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..core.arrays import FloatArray
from ..core.elements import Class, Member, NodeKind, Role, role_table
from ..deck.rendering import ModelError
from ..model.data import ModelData
from ..model.parts.forms import is_member
from ..model.parts.parts import Joint, Part, PartKind, natural
from ..util.groups import grouped, groups_of, values_in
from ..util.records import Frozen, cached_property
from .decomposition import Decomposition, row_weights
from .limits import EXACT_COSINE, NO_RESULTANT, ROUNDING, SAME_WRENCH, TOLD
from .locate import part_of, position_of
from .screws import Wrench, in_words, sense_of

#: The quantities along an element, in their order: N, N m, N m, N m.
QUANTITIES = ("normal force", "twist moment", "in-plane moment", "out-of-plane moment")

#: What a deformation's force or moment is in the local frame: force along ex, moment about ex,
#: ey, ez; end (0 at p, 1 at q), and factor. Planar bending is defined with the other sign.
_AT_ENDS: dict[int, tuple[tuple[int, int, float], ...]] = {
    Role.ELONGATION: ((0, 0, 1.0), (0, 1, 1.0)),
    Role.TORSION: ((1, 0, 1.0), (1, 1, 1.0)),
    Role.BENDING_XZ_P: ((2, 0, 1.0),),
    Role.BENDING_XZ_Q: ((2, 1, 1.0),),
    Role.BENDING_XY_P: ((3, 0, 1.0),),
    Role.BENDING_XY_Q: ((3, 1, 1.0),),
    Role.PLANAR_BENDING_P: ((3, 0, -1.0),),
    Role.PLANAR_BENDING_Q: ((3, 1, -1.0),),
    Role.OFFSET_X: ((0, 0, 1.0), (0, 1, 1.0)),
    Role.OFFSET_Y: ((3, 0, 1.0),),
    Role.OFFSET_Z: ((2, 0, -1.0),),
}
#: Forces at q across a link, which bend it by their arm to p.
_WITH_ARM = (Role.OFFSET_Y, Role.OFFSET_Z)
#: Likewise of a joint, the same at both ends.
_OF_JOINTS: dict[int, int] = {
    Role.OFFSET_X: 0,
    Role.ROTATION: 1,
    Role.TILT_Y: 2,
    Role.TILT_Z: 3,
    Role.ANGLE: 3,
}


def local_resultants(data: ModelData, element: np.ndarray, value: FloatArray) -> FloatArray:
    """(k, 4, 2) force along ex [N], moments about ex, ey and ez [N m], at both ends.

    Args:
        data: The model.
        element: (k,) indices of elements.
        value: (k, 6) forces and moments dual to their deformations [N, N m].

    What q's side of a cut exerts on p's side.
    """
    kind = data.arrays.element_kind[element]
    joint = is_member(kind, Member.HINGE)
    length = data.frames.length[element]
    made = np.zeros((len(element), 4, 2))
    for deformation, role in enumerate(role_table()[kind].T):
        for each in values_in(role[role > 0]).tolist():
            chosen = (role == each) & ~joint
            for row, end, factor in _AT_ENDS.get(each, ()):
                arm = length[chosen] if each in _WITH_ARM else 1.0
                made[chosen, row, end] += arm * factor * value[chosen, deformation]
            if each in _OF_JOINTS:
                chosen = (role == each) & joint
                made[chosen, _OF_JOINTS[each]] += value[chosen, deformation, None]
    return made


def shared_resultants(data: ModelData, element: np.ndarray, value: FloatArray) -> FloatArray:
    """(k, 4, 2) the `QUANTITIES` at both ends of elements; arguments as of `local_resultants`."""
    made = local_resultants(data, element, value)
    frame, across = data.frames.frame[element], data.across[element]
    # A moment that stretches the side of a direction is about that direction x ex.
    about = np.cross(across, frame[:, None, :, 0])
    turn = about @ frame[..., 1:]
    for exact in (-1.0, 0.0, 1.0):
        turn[np.abs(turn - exact) < EXACT_COSINE] = exact
    made[:, 2:] = turn @ made[:, 2:]
    joint = is_member(data.arrays.element_kind[element], Member.HINGE)
    made[joint] = np.abs(made[joint])
    return made


#: Position and orientation node, -1 where there is none.
_End = tuple[int, int]


class EndLoad(NamedTuple):
    """What a part exerts where it ends."""

    position: int | None
    """Index of the position node in the model as given."""
    on: Part | Joint | None
    """The body or joint that it ends at; None of a support alone."""
    wrench: Wrench
    """On what is there, about the end."""


@dataclass(frozen=True, eq=False, repr=False)
class PartStress(Frozen):
    """The stress resultants of a part.

    Attributes:
        part: The part.
        ends: What it exerts at its ends; of two ends in the order of their coordinates.
        share: Its largest force or moment beside the largest of all parts, at most 1.
        direction: (3,) unit vector from the first end to the second; zero where there are not
            two at different places.
        normal: (3,) unit vector across a sheet, about which its in-plane moments turn, the first
            component positive; zero of other parts.
    """

    part: Part
    ends: tuple[EndLoad, ...]
    share: float
    direction: FloatArray
    normal: FloatArray

    @property
    def normal_force(self) -> float:
        """Tension is positive [N]."""
        return -float(self._last.force @ self.direction)

    @property
    def twist_moment(self) -> float:
        """Positive where it resists a right-handed twist [N m]."""
        return -float(self._last.moment @ self.direction)

    @property
    def shear_force(self) -> FloatArray:
        """(3,) that it exerts at the second end, across the line between the ends [N]."""
        return self._across(self._last.force)

    @property
    def moments(self) -> tuple[FloatArray, ...]:
        """(3,) bending moments that it exerts at its ends [N m]."""
        return tuple(self._across(end.wrench.moment) for end in self.ends)

    @property
    def in_plane_moments(self) -> tuple[float, ...]:
        """Of a sheet those about `normal` [N m]; opposite and equal where it is constant."""
        return tuple(float(end.wrench.moment @ self.normal) for end in self.ends)

    @property
    def is_constant_bending(self) -> bool:
        """Whether it carries one bending moment from end to end and nothing else."""
        if len(self.ends) != 2 or not self.direction.any():
            return False
        first, last = self.moments
        scale = self.ends[0].wrench.length
        others = abs(self.normal_force), float(np.linalg.norm(self.shear_force))
        limit = TOLD * float(np.linalg.norm(first))
        return bool(
            limit > 0.0
            and max(others) * scale <= limit
            and abs(self.twist_moment) <= limit
            and np.linalg.norm(first + last) <= limit
        )

    @property
    def _last(self) -> Wrench:
        return self.ends[-1].wrench

    def _across(self, vector: FloatArray) -> FloatArray:
        return vector - (vector @ self.direction) * self.direction

    def __str__(self) -> str:
        """In words."""
        told = []
        length, rest, units = self._last.length, 1.0e2 * self._last.rest, self._last.units
        if abs(self.normal_force) * length > rest:
            kind = "tension" if self.normal_force > 0.0 else "compression"
            told.append(f"{kind} {abs(self.normal_force):.4g} N")
        if np.linalg.norm(self.shear_force) * length > rest:
            told.append(f"shear force {in_words(self.shear_force)} N")
        if abs(self.twist_moment) > rest:
            told.append(f"twist moment {units.said(self.twist_moment, 'N m')}")
        for end, moment in zip(self.ends, self.moments, strict=True):
            if np.linalg.norm(moment) > rest:
                at = f" on {end.on}" if end.on is not None else " on its support"
                shown = f"{in_words(units.shown(moment, 'N m'))} {units.symbol('N m')}"
                told.append(f"moment {shown}{at}")
        return f"{self.part}: {', '.join(told) or 'nothing'}"

    def __repr__(self) -> str:
        """Likewise."""
        return f"<PartStress {self}>"


class Load(NamedTuple):
    """What a part, or a support, exerts on a body or joint."""

    part: Part | None
    """None of a support or a drive."""
    wrench: Wrench

    def __str__(self) -> str:
        """In words."""
        return f"{self.part or 'the support'} exerts {self.wrench}"


class Conflict(NamedTuple):
    """What parts do to one body or joint between them: in balance."""

    on: Part | Joint
    loads: tuple[Load, ...]
    """By name of the part; the support last. Their sum is zero."""

    @property
    def over(self) -> Wrench | None:
        """What they fight over: of the first part, if that of each is a multiple of it."""
        return _common([load.wrench for load in self.loads])

    @property
    def shares(self) -> tuple[float, ...] | None:
        """How many times `over` each part exerts; None where they are no multiples."""
        over = self.over
        if over is None:
            return None
        unit = over.vector
        return tuple(
            float(load.wrench.at(over.about).vector @ unit / (unit @ unit)) for load in self.loads
        )

    def __str__(self) -> str:
        """In words."""
        return f"{self.on}: {'; '.join(map(str, self.loads))}"


class Side(NamedTuple):
    """Parts in a row, and the bodies between them, that press on a body from one side."""

    parts: tuple[Part, ...]
    """The flexible parts, by name."""
    through: tuple[Part, ...]
    """The bodies between them, by name."""
    wrench: Wrench
    """What they exert."""


class Rivalry(NamedTuple):
    """A body, or a point, on which several sides of a loop press: in balance."""

    on: Part | Joint
    sides: tuple[Side, ...]

    @property
    def over(self) -> Wrench | None:
        """What the sides fight over: of the first, if that of each is a multiple of it."""
        return _common([side.wrench for side in self.sides])


def _common(wrenches: list[Wrench]) -> Wrench | None:
    """The first of several wrenches, if each is a multiple of it."""
    first = wrenches[0]
    vectors = [each.at(first.about).vector for each in wrenches]
    unit = vectors[0] / np.linalg.norm(vectors[0])
    off = max(float(np.linalg.norm(v - (v @ unit) * unit)) for v in vectors)
    largest = max(float(np.linalg.norm(v)) for v in vectors)
    return first if off <= SAME_WRENCH * largest else None


#: A body or joint by its first node; -1 is the ground.
_Place = int


class Presses:
    """What parts press on each other in a self-stress; each answer is found when asked for.

    Attributes:
        analysis: The analysis that it belongs to.
    """

    analysis: Decomposition

    if TYPE_CHECKING:

        @property
        def vector(self) -> FloatArray:
            """(m,) stress resultants dual to the deformations."""

    @cached_property
    def parts(self) -> tuple[PartStress, ...]:
        """The flexible parts that carry something: the largest first, of equal ones by name.

        Where bodies alone carry, they are given.
        """
        made = [self._part_stress(part) for part in self._ends]
        flexible = [one for one in made if one.part.kind is not PartKind.BODY]
        carrying = [one for one in flexible if one.share > ROUNDING] or made
        return tuple(sorted(carrying, key=lambda one: (-round(one.share, 9), *self._key(one.part))))

    def of(self, part: object) -> PartStress:
        """The stress resultants of a part; of a body what its members exert where they end.

        Args:
            part: Its name, the part, or what the model handed out.

        Raises:
            ModelError: there is no such part.
        """
        return self._part_stress(part_of(self.analysis.parts, part))

    def on(self, body: object) -> tuple[Load, ...]:
        """What each part exerts on a body, or on a point, and the support last; in balance.

        Args:
            body: Its name, the part, or what the model handed out; or so a point.

        Raises:
            ModelError: there is no such body or point.
        """
        part = None
        if not hasattr(body, "position"):
            try:
                part = part_of(self.analysis.parts, body)
            except (ModelError, TypeError):
                if not isinstance(body, (str, tuple, list)):
                    raise
        if part is None:
            position = position_of(self.analysis.parts, body)
            own = (n for n, p in self.analysis.parts.position_of.items() if p == position)
            return self._loads({position, *own}, None)
        if part.kind is PartKind.BODY:
            mine = self.analysis.parts.bodies[self.analysis.carriers.bodies.index(part)]
            return self._loads({*mine.positions, *mine.orientations}, part)
        slots = self.analysis.given.arrays.element_node[:, list(part.elements)] - 1
        return self._loads(set(slots.ravel().tolist()) - {-1}, part)

    @cached_property
    def conflicts(self) -> tuple[Conflict, ...]:
        """Bodies on which parts press, by name, then joints; clamps are left out."""
        on_joints = (
            Conflict(joint, self._loads(joint.nodes, None))
            for joint in self.analysis.carriers.joints
            if not self._is_held(joint) and not self._of_node.keys().isdisjoint(joint.nodes)
        )
        pressed = (one for one in on_joints if any(load.part for load in one.loads))
        return (*self.on_bodies, *pressed)

    @cached_property
    def on_bodies(self) -> tuple[Conflict, ...]:
        """Those on bodies."""
        bodies = sorted(self.analysis.carriers.bodies, key=self._key)
        made = (Conflict(body, self.on(body)) for body in bodies)
        return tuple(one for one in made if any(load.part for load in one.loads))

    @cached_property
    def rivalry(self) -> Rivalry | None:
        """The sides of a loop that press on the body farthest from the ground, or from each other.

        What lies in a row is of one side. None where there are no two sides, or where a support
        or a drive presses on that body, too.
        """
        loops = [one for one in self.parts if len(one.ends) == 2]
        between = [tuple(self._place_at(end) for end in one.ends) for one in loops]
        at = grouped((place, k) for k, both in enumerate(between) for place in both)
        away = self.analysis.carriers.away

        def rank(place: _Place) -> tuple[int, int, int]:
            return (-1 if place < 0 else int(away[place]), len(at[place]), -place)

        inner = [place for place in at if place >= 0 and len(at[place]) > 1]
        if len(loops) < len(self.parts) or not inner:
            return None
        main = max(inner, key=rank)
        start = min((place for place in at if place != main), key=rank, default=main)
        pairs = (
            (mine[0], k) for place, mine in at.items() if place not in (main, start) for k in mine
        )
        side_of = groups_of(len(loops), pairs).tolist()
        where = next(
            end.on for k in at[main] for end in loops[k].ends if self._place_at(end) == main
        )
        assert where is not None
        pressed = self._loads(where.nodes, None) if isinstance(where, Joint) else self.on(where)
        loads = {load.part: load.wrench for load in pressed}
        if None in loads:
            return None
        sides = []
        for mine in grouped(zip(side_of, range(len(loops)), strict=True)).values():
            parts = [loops[k].part for k in mine]
            pressing = [loads[part] for part in parts if part in loads]
            bodies = {end.on for k in mine for end in loops[k].ends} - {where}
            if not pressing:
                continue
            first = pressing[0]
            force = np.sum([each.force for each in pressing], axis=0)
            moment = np.sum([each.moment for each in pressing], axis=0)
            wrench = self._wrench(np.stack((force, moment)), first.about)
            through = [
                body
                for body in bodies
                if isinstance(body, Part)
                and body.kind is PartKind.BODY
                and self._place_of_carrier(body) not in (main, start)
            ]
            if wrench:
                one, other = (tuple(sorted(each, key=self._key)) for each in (parts, through))
                sides.append(Side(one, other, wrench))
        sides.sort(key=lambda side: self._key(side.parts[0]))
        return Rivalry(where, tuple(sides)) if len(sides) > 1 else None

    def _place_at(self, end: EndLoad) -> _Place:
        return -1 if end.on is None else self._place_of_carrier(end.on)

    def _place_of_carrier(self, carrier: Part | Joint) -> _Place:
        """The first node of a body or joint; -1 of a body that is held."""
        if isinstance(carrier, Joint):
            return carrier.nodes[0]
        body = self.analysis.parts.bodies[self.analysis.carriers.bodies.index(carrier)]
        nodes = (*body.positions, *body.orientations)
        return -1 if all(map(self.analysis.parts.is_held, nodes)) else nodes[0]

    # What it is made of -----------------------------------------------------

    @cached_property
    def _at_nodes(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Element and node, both as given, (k,), and force or moment (k, 3) that it exerts."""
        outcome, vector, whole = self.analysis, self.vector, self.analysis.assembly
        element, deformation = outcome.raw.row_label - 1
        sigma = np.zeros(6 * outcome.data.arrays.element_number.size)
        weighted = np.abs(vector * row_weights(outcome))
        is_there = weighted > NO_RESULTANT * weighted.max(initial=0.0)
        sigma[6 * element + deformation] = np.where(is_there, vector, 0.0)
        used = sigma[whole.row_of] != 0.0
        owner, node = whole.row_of[used] // 6, whole.column_of[used] // 3
        keys, place = np.unique(np.stack((owner, node)), axis=1, return_inverse=True)
        made = np.zeros((keys.shape[1], 3))
        value = -whole.value[used] * sigma[whole.row_of[used]]
        np.add.at(made, (place.ravel(), whole.column_of[used] % 3), value)
        return outcome.condensed.elements[keys[0]], outcome.condensed.nodes[keys[1]], made

    @cached_property
    def _of_node(self) -> dict[int, list[int]]:
        """Which entries of `_at_nodes` are of a node."""
        return grouped((node, k) for k, node in enumerate(self._at_nodes[1].tolist()))

    @cached_property
    def _ends(self) -> dict[Part, dict[_End, FloatArray]]:
        """(2, 3) force and moment of each part where its elements end."""
        given, parts = self.analysis.given.arrays, self.analysis.parts
        condensed, made = self.analysis.condensed, dict[Part, dict[_End, FloatArray]]()
        elements, nodes, values = self._at_nodes
        for element, node, value in zip(elements.tolist(), nodes.tolist(), values, strict=True):
            # The ends of the element of the model as analysed, in nodes as given.
            index = int(np.searchsorted(condensed.elements, element))
            slots = self.analysis.data.arrays.element_node[:, index] - 1
            p, op, q, oq = (int(condensed.nodes[n]) if n >= 0 else -1 for n in slots.tolist())
            end = (p, op) if node in (p, op) else (q, oq)
            both = made.setdefault(parts.of_element(element), {}).setdefault(end, np.zeros((2, 3)))
            both[int(given.node_kind[node] > NodeKind.POSITION)] += value
        return made

    @cached_property
    def _largest(self) -> float:
        """What any element exerts at most: members of one body may cancel out."""
        _, node, value = self._at_nodes
        is_force = self.analysis.given.arrays.node_kind[node] <= NodeKind.POSITION
        length = np.where(is_force, self.analysis.characteristic_length, 1.0)
        return float((np.linalg.norm(value, axis=1) * length).max(initial=0.0))

    def _size(self, both: FloatArray) -> float:
        force, moment = np.linalg.norm(both, axis=1)
        return float(max(force * self.analysis.characteristic_length, moment))

    def _place_of(self, end: _End) -> FloatArray:
        position = end[0] if end[0] >= 0 else self.analysis.parts.place_of(end[1])
        if position is None:
            return np.zeros(3)
        return self.analysis.given.arrays.node_value[:3, position]

    def _wrench(self, both: FloatArray, about: FloatArray) -> Wrench:
        length = self.analysis.characteristic_length
        units = self.analysis.given.units
        return Wrench(both[0], both[1], np.array(about), length, ROUNDING * self._largest, units)

    def _part_stress(self, part: Part) -> PartStress:
        found = self._ends.get(part, {})
        outer = {
            end: both
            for end, both in found.items()
            if len(found) <= 2 or self._size(both) > ROUNDING * self._largest
        }
        step = self.analysis.characteristic_length
        order = sorted(
            outer, key=lambda end: (*np.round(self._place_of(end) / step, 9).tolist(), *end)
        )
        ends = tuple(
            EndLoad(
                end[0] if end[0] >= 0 else None,
                self._receiver(end),
                self._wrench(outer[end], self._place_of(end)),
            )
            for end in order
        )
        if not ends:
            nothing = self._wrench(np.zeros((2, 3)), np.zeros(3))
            ends = (EndLoad(None, None, nothing),)
        way = ends[-1].wrench.about - ends[0].wrench.about
        length = float(np.linalg.norm(way))
        size = max((self._size(both) for both in found.values()), default=0.0)
        normal = np.zeros(3)
        if part.kind is PartKind.SHEET:
            # Of a divided sheet that is one beam, that of the one beam.
            index = int(np.searchsorted(self.analysis.condensed.elements, part.elements[0]))
            wide = int(self.analysis.parts.wide[part.elements[0]])
            axis: FloatArray = self.analysis.data.frames.frame[index][:, 3 - wide]
            normal = sense_of(axis) * axis
        return PartStress(
            part,
            ends,
            size / self._largest if self._largest > 0.0 else 0.0,
            way / length if length > 0.0 and part.kind is not PartKind.HINGE else np.zeros(3),
            normal,
        )

    def _receiver(self, end: _End) -> Part | Joint | None:
        """The body or joint at an end; None of a support alone."""
        parts = self.analysis.parts
        body = parts.body_at.get(end[0], parts.body_at.get(end[1]))
        if body is not None:
            return parts.of_body(body)
        joint = self._joint_at.get(end[1], self._joint_at.get(end[0]))
        return None if joint is None or self._is_held(joint) else joint

    @cached_property
    def _joint_at(self) -> dict[int, Joint]:
        joints = reversed(self.analysis.carriers.joints)
        return {node: joint for joint in joints for node in joint.nodes}

    def _is_held(self, joint: Joint) -> bool:
        return all(map(self.analysis.parts.is_held, joint.nodes))

    def _loads(self, nodes: Iterable[int], body: Part | None) -> tuple[Load, ...]:
        """What parts but one exert on some nodes about their middle, and the support."""
        outcome = self.analysis
        mine = set(nodes)
        given = outcome.given.arrays
        positions = [n for n in mine if given.node_kind[n] <= NodeKind.POSITION]
        if not positions:
            places = [outcome.parts.place_of(n) for n in mine]
            positions = [p for p in places if p is not None]
        about = given.node_value[:3, sorted(positions)].mean(axis=1) if positions else np.zeros(3)
        element, node, value = self._at_nodes
        here = np.array(sorted(k for n in mine for k in self._of_node.get(n, ())), np.int64)
        by_part: dict[Part | None, FloatArray] = {}
        reaction: dict[int, FloatArray] = {}
        for e, n, force in zip(
            element[here].tolist(), node[here].tolist(), value[here], strict=True
        ):
            part = outcome.parts.of_element(e)
            reaction.setdefault(n, np.zeros(3))
            reaction[n] -= force
            if part != body:
                both = by_part.setdefault(part, np.zeros((2, 3)))
                both += self._moved(n, force, about)
        support = np.zeros((2, 3))
        for n, force in reaction.items():
            held = np.isin(given.coordinate_class[:, n], (Class.FIXED, Class.INDEPENDENT))
            support += self._moved(n, np.where(held, force, 0.0), about)
        found = [Load(part, self._wrench(both, about)) for part, both in by_part.items()]
        found.sort(key=lambda load: self._key(load.part) if load.part is not None else ())
        found.append(Load(None, self._wrench(support, about)))
        return tuple(load for load in found if load.wrench)

    def _moved(self, node: int, force: FloatArray, about: FloatArray) -> FloatArray:
        """(2, 3) force and moment about a point of what works at a node."""
        given = self.analysis.given.arrays
        if given.node_kind[node] > NodeKind.POSITION:
            return np.stack((np.zeros(3), force))
        arm = given.node_value[:3, node] - about
        return np.stack((force, np.cross(arm, force) if arm.any() else np.zeros(3)))

    def _key(self, part: Part) -> tuple[object, ...]:
        name = natural(part.name)
        nodes = self.analysis.given.arrays.element_node[[0, 2], part.elements[0]] - 1
        places = [self.analysis.given.arrays.node_value[:3, n] for n in nodes.tolist() if n >= 0]
        step = self.analysis.characteristic_length
        middle = np.round(np.mean(places, axis=0) / step, 9) if places else np.zeros(0)
        return name, tuple(middle.tolist())
