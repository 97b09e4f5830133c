# SPDX-License-Identifier: BSD-3-Clause
"""How often each motion of each body is held, and which are declared or free.

What the parts that end at a body exert on it in the self-stresses is a subspace of R^(6P), six
numbers for each of P parts; parts that lead to one other body are first taken together, as a
guide, and then what they do within where they exert nothing together. A motion d of the body is
held once, and once more for each of the independent self-stresses that load the body along d:
1 + rank of the parts' loads along d. With the orthogonal projector on the subspace, two motions
hang together where their P x P block of it is not zero; its trace over motions that hang together
counts the self-stresses on them. What the body can do is a subspace of its twists: of the motions
that nothing determines, and of those besides when nothing is declared. All of this is of
subspaces: no basis of them is chosen.

The motions are told along the axes and about the point in which what the body can do is spanned by
single motions, and the loads fall apart into as many as can be; the axes of the model and the
middle of the body before others.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice, permutations, product
from typing import NamedTuple

import numpy as np

from ..core.arrays import Basis, BoolArray, FloatArray, IntArray
from ..core.elements import Class, NodeKind
from ..core.raw import RawAnalysis
from ..model.parts.parts import Joint, Part, PartKind, natural
from ..util.groups import grouped, values_in
from ..util.matrices import null_space, span
from ..util.records import Frozen
from ..util.text import number_in_words
from .body_motions import Moves
from .decomposition import Decomposition, row_weights
from .freedoms import Block, Freedom
from .limits import HELD, SAME_PLACE
from .places import direction_words, joint_words, listed, part_words
from .screws import Screw, ScrewKind, in_words, place_in_words
from .sparse_basis import orthonormal
from .verdict import AnalysisError

#: The motions of a body along and about its axes, in their order.
MOTIONS = ("x", "y", "z", "rx", "ry", "rz")
#: Beyond so many bodies, or multiplications for the loads of one, nothing is counted.
_MOST_BODIES, _MOST_WORK = 200, 4.0e8
#: Multiplications for trying points and axes, and how many of each are tried.
_MOST_TRIED = 1.0e8
_MOST_PLACES, _MOST_AXES = 8, 8
#: How many screws, or names of parts, are told.
_MOST_SCREWS = 2
_TIMES = ("not at all", "once", "twice")


def times_in_words(count: int) -> str:
    """How often: "once", "twice", "three times"."""
    if count < len(_TIMES):
        return _TIMES[count]
    return f"{number_in_words(count)} times"


class Together(NamedTuple):
    """Motions whose holding cannot be told apart."""

    directions: tuple[str, ...]
    """Of `MOTIONS`; "others" for all that are neither declared nor free."""
    held: int
    """How often all of them together: as many as they are, and once for each self-stress."""
    motions: int
    """How many they are."""

    def __str__(self) -> str:
        """In words."""
        surplus = self.held - self.motions
        names = ", ".join(self.directions)
        if self.directions == ("others",):
            names = (
                f"the other {number_in_words(self.motions)} motions"
                if self.motions > 1
                else "the other motion"
            )
        if not surplus:
            return f"{names} held once{' each' * (self.motions > 1)}"
        often = f"{times_in_words(self.held)} ({times_in_words(surplus)} too often)"
        return f"{names}{' together' * (self.motions > 1)} held {often}"


@dataclass(frozen=True, eq=False, repr=False)
class BodyHolding(Frozen):
    """How often each motion of a body is held, and which are declared or free.

    Attributes:
        name: What the body, or the point that flexures carry, is called.
        held: Of motions along and about its axes how often they are held.
        declared: Those that it makes when declared degrees of freedom move; or, where no axes
            separate them, its screws in words.
        free: Those that nothing holds and nobody declared, likewise.
        together: Held motions that cannot be told apart.
        against: Of motions that it can make, but that are held against others, the names of the
            bodies that make them too, or "its drive".
        at: (3,) the point about which it turns in rx, ry and rz [m].
        axes: (3, 3) its axes x, y and z as columns.
        where: What is said of the point and the axes behind a motion, or in brackets behind all,
            under an empty name; empty for the middle of the body and the axes of the model.
        of: The body, or the point.
        by: The parts that hold it.
    """

    name: str
    held: dict[str, int]
    declared: tuple[str, ...]
    free: tuple[str, ...]
    together: tuple[Together, ...]
    against: dict[str, tuple[str, ...]]
    at: FloatArray
    axes: FloatArray
    where: dict[str, str]
    of: Part | Joint
    by: tuple[Part, ...]

    @property
    def words(self) -> str:
        """All but the name, such as "ry held twice; x, z, rx, rz once; y declared"."""
        in_groups = {each for group in self.together for each in group.directions}
        by_count = grouped(
            (count, way)
            for way, count in self.held.items()
            if way not in in_groups and way not in self.against
        )
        told: list[str] = []
        for count in sorted(by_count, reverse=True):
            each = " each" if len(by_count[count]) > 1 and not told else ""
            held = " held" if not told else ""
            told.append(f"{self._row(by_count[count])}{held} {times_in_words(count)}{each}")
        told += map(str, self.together)
        for way, others in self.against.items():
            if way not in in_groups:
                often = times_in_words(self.held[way])
                told.append(f"{self._row([way])} held {often} against {listed(others)}")
        for ways, what in ((self.declared, "declared"), (self.free, "free")):
            if ways:
                told.append(f"{self._row(ways)} {what}")
        behind = self.where.get("")
        return f"{'; '.join(told)}{f' ({behind})' if behind else ''}"

    def _row(self, ways: Iterable[str]) -> str:
        return ", ".join(f"{way} {self.where[way]}" if way in self.where else way for way in ways)

    def __str__(self) -> str:
        """In a line, such as "stage: ry held twice; x, z, rx, rz once; y declared."."""
        return f"{self.name}: {self.words}."

    def __repr__(self) -> str:
        """Likewise."""
        return f"<BodyHolding {self}>"


class HeldInside(NamedTuple):
    """Parts that are held too often between their ends, which no body feels."""

    parts: tuple[Part, ...]
    too_often: int
    """How many self-stresses."""

    def __str__(self) -> str:
        """In a line."""
        names = [part_words(part) for part in self.parts]
        if len(names) > _MOST_SCREWS + 1:
            names = [*names[:_MOST_SCREWS], f"{len(names) - _MOST_SCREWS} more"]
        often = f"held {times_in_words(self.too_often)} too often"
        if all(part.kind is PartKind.BODY for part in self.parts):
            return f"{listed(names)}: {often} within its own members."
        its = "its ends" if len(names) == 1 else "their ends, which no body feels"
        return f"{listed(names)}: {often} between {its}."


class Holding(NamedTuple):
    """What holds a mechanism how often, by body."""

    bodies: tuple[BodyHolding, ...]
    inside: tuple[HeldInside, ...]
    left_out: str = ""
    """Why nothing was counted; empty where it was."""


_TOO_MUCH = "How often each body is held is not counted in so large a model."


def holding_of(
    result: Decomposition, freedoms: tuple[Freedom, ...], motions: Sequence[Moves]
) -> Holding:
    """How often each body of a mechanism is held.

    Args:
        result: Its decomposition, with divided sheets as one beam each.
        freedoms: The declared degrees of freedom.
        motions: What nothing determines, as it is told.
    """
    raw = result.raw
    given = raw.stresses.vectors, raw.motions.vectors
    if not result.is_told_by_parts or given != (result.over_constrained, result.under_constrained):
        return Holding((), (), _TOO_MUCH)
    carriers = _carriers(result)
    if len(carriers) > _MOST_BODIES:
        return Holding((), (), _TOO_MUCH)
    try:
        with np.errstate(over="raise", invalid="raise"):
            return _Found(result, carriers, freedoms, motions).holding()
    except (AnalysisError, FloatingPointError, np.linalg.LinAlgError):
        return Holding((), (), "How often each body is held could not be counted.")


class _Carrier(NamedTuple):
    """A body, or a point that flexures carry; nodes by their indices in the model as analysed."""

    name: str
    of: Part | Joint
    positions: IntArray
    orientations: IntArray
    own: frozenset[int]
    """Indices of its elements in the model as given."""


def _carriers(result: Decomposition) -> list[_Carrier]:
    """The bodies that are told; of a mechanism without any the points that flexures carry."""
    parts, arrays = result.parts, result.given.arrays
    at = {int(node): k for k, node in enumerate(result.condensed.nodes)}

    def made(name: str, of: Part | Joint, nodes: Iterable[int], own: Iterable[int]) -> _Carrier:
        # Nodes inside of what is one beam in D(c) belong to no body.
        known = [node for node in nodes if node in at]
        kinds = arrays.node_kind
        positions = [at[node] for node in known if kinds[node] <= NodeKind.POSITION]
        orientations = [at[node] for node in known if kinds[node] > NodeKind.POSITION]
        places = np.array(positions, np.int32), np.array(orientations, np.int32)
        return _Carrier(name, of, *places, frozenset(own))

    bodies = [
        made(part.name, part, (*body.positions, *body.orientations), body.elements)
        for part, body in zip(result.carriers.bodies, parts.bodies, strict=True)
        if not (
            any(map(parts.is_held, body.positions)) and any(map(parts.is_held, body.orientations))
        )
    ]
    bodies = [one for one in bodies if not _divides(result, one)] or bodies
    # What is farthest from the ground is what the mechanism is for.
    away, nodes_of = result.carriers.away, result.condensed.nodes
    far = {
        id(one): int(away[nodes_of[[*one.positions, *one.orientations]]].max(initial=0))
        for one in bodies
    }
    bodies.sort(key=lambda one: (-far[id(one)], natural(one.name)))
    if bodies:
        return bodies
    joints = [joint for joint in result.carriers.joints if joint.position is not None]
    return [
        made(joint_words(parts, joint), joint, joint.nodes, ())
        for joint in joints
        if not joint.is_fold
        and not parts.is_held(joint.nodes[-1])
        and len(joint.parts if joint.orientation is None else parts.turning(joint.orientation)) > 1
    ]


def _divides(result: Decomposition, body: _Carrier) -> bool:
    """Whether a body does no more than divide a flexure: two in line with it, and nothing else."""
    parts, arrays = result.parts, result.data.arrays
    nodes = np.concatenate((body.positions, body.orientations))
    if np.any(np.isin(arrays.coordinate_class[:, nodes], (Class.FIXED, Class.INDEPENDENT))):
        return False
    ended = {
        part for node in body.positions for part in parts.at(int(result.condensed.nodes[node]))
    }
    others = [part for part in ended if part != body.of]
    if len(others) != 2 or any(len(part.ends) != 2 for part in others):
        return False
    ends = [end for part in others for end in part.ends]
    places = result.given.arrays.node_value[:3, ends]
    values = np.linalg.svd(places - places.mean(axis=1, keepdims=True), compute_uv=False)
    return bool(values[1] <= HELD * values[0])


class _Frame(NamedTuple):
    """A point and axes, and what falls apart along and about them."""

    at: FloatArray
    axes: FloatArray
    groups: tuple[tuple[int, ...], ...]
    loads: FloatArray
    """(P, 6, r) orthonormal loads of the parts."""


class _Found:
    """The spaces of a mechanism, from which those of each body are cut."""

    def __init__(
        self,
        result: Decomposition,
        carriers: Sequence[_Carrier],
        freedoms: tuple[Freedom, ...],
        motions: Sequence[Moves],
    ) -> None:
        """Keep what each body needs: entries of the Jacobian by node, and spaces."""
        self.result, self.carriers = result, carriers
        self.freedoms, self.motions = freedoms, motions
        self.length = result.characteristic_length
        self.least = max(HELD, 10.0 * result.rounding)
        whole, nodes = result.assembly, result.data.arrays.node_number.size
        row_of = np.full(6 * result.data.arrays.element_number.size, -1)
        element, deformation = result.raw.row_label - 1
        row_of[6 * element + deformation] = np.arange(element.size)
        order = np.argsort(whole.column_of, kind="stable")
        order = order[row_of[whole.row_of[order]] >= 0]
        self.node, self.axis = np.divmod(whole.column_of[order], 3)
        self.element, self.row = whole.row_of[order] // 6, row_of[whole.row_of[order]]
        self.value = whole.value[order]
        self.start = np.searchsorted(self.node, np.arange(nodes + 1))
        # Moments as forces: singular values of what a body feels are of the size of one.
        self.stresses = result.stress_space.toarray()
        self.over_weight = 1.0 / row_weights(result)
        self.is_position = result.data.arrays.node_kind <= NodeKind.POSITION
        self.part = [result.parts.of_element(int(e)) for e in result.condensed.elements]
        self.free = [self._velocities(result.raw)]
        blocks: dict[int, Block] = {id(each.block): each.block for each in freedoms}
        self.movable = self.free + [self._velocities(block.freed) for block in blocks.values()]
        dimension = 2 if result.given.planar else 3
        nodes_of = result.condensed.nodes
        self.carried_at = grouped(
            (node, k)
            for k, one in enumerate(carriers)
            for node in nodes_of[np.concatenate((one.positions, one.orientations))].tolist()
        )
        self.ways = [0, 1, 5] if dimension == 2 else list(range(6))

    def _velocities(self, raw: RawAnalysis) -> FloatArray:
        """(nodes, 3, k) orthonormal velocities that are left, rotations as lengths."""
        if raw.motions.vectors < raw.column_scale.size - raw.rank:
            raise AnalysisError("there are too many motions")
        node, axis = raw.column_label - 1
        weights = np.where(self.is_position[node], 1.0, self.length)
        made = np.zeros((self.is_position.size, 3, raw.motions.vectors))
        basis: Basis = orthonormal(raw.motions, weights)
        made[node, axis] = basis.toarray()
        return made

    def holding(self) -> Holding:
        """Of all bodies, and what none of them feels."""
        if self.stresses.size * len(self.carriers) > _MOST_WORK:
            return Holding((), (), _TOO_MUCH)
        told = []
        felt = [np.zeros((0, self.stresses.shape[1]))]
        for carrier in self.carriers:
            sides, loads = self._loads(carrier)
            flat = loads.reshape(6 * len(loads), loads.shape[2])
            if float(flat.size) * min(flat.shape) > _MOST_WORK:
                return Holding((), (), _TOO_MUCH)
            # Sides that lead to one body press as one; then what they do within.
            bundles = self._bundles(carrier, sides)
            summed = np.stack([loads[mine].sum(axis=0) for mine in bundles]) if bundles else loads
            outer, first = self._felt(summed)
            within = null_space(first, self.least)
            inner, second = self._felt(loads @ within)
            felt += [first, second @ within.T]
            orthonormal_loads = np.zeros(
                (len(outer) + len(inner), 6, outer.shape[2] + inner.shape[2])
            )
            orthonormal_loads[: len(outer), :, : outer.shape[2]] = outer
            orthonormal_loads[len(outer) :, :, outer.shape[2] :] = inner
            bundled = [tuple(part for k in mine for part in sides[k]) for mine in bundles]
            told.append(self._of_body(carrier, [*bundled, *sides], orthonormal_loads))
        rest = null_space(np.concatenate(felt), self.least)
        return Holding(tuple(told), tuple(self._inside(rest)))

    def _felt(self, loads: FloatArray) -> tuple[FloatArray, FloatArray]:
        """(P, 6, r) orthonormal loads of (P, 6, k), and (r, k) in which self-stresses they are."""
        flat = loads.reshape(6 * len(loads), loads.shape[2])
        left, values, right = np.linalg.svd(flat, full_matrices=False)
        kept = values > self.least * max(1.0, float(values.max(initial=0.0)))
        return left[:, kept].reshape(*loads.shape[:2], int(kept.sum())), right[kept]

    def _bundles(self, carrier: _Carrier, sides: Sequence[tuple[Part, ...]]) -> list[list[int]]:
        """Which sides lead from a body to the same others."""
        slots = self.result.given.arrays.element_node - 1

        def beyond(side: tuple[Part, ...]) -> tuple[int, ...]:
            nodes = {n for part in side for n in slots[:, list(part.elements)].ravel().tolist()}
            at = {k for node in nodes for k in self.carried_at.get(node, ())}
            return tuple(sorted(k for k in at if self.carriers[k] is not carrier))

        return list(grouped((beyond(side), k) for k, side in enumerate(sides)).values())

    # One body ---------------------------------------------------------------

    def _centre(self, carrier: _Carrier) -> FloatArray:
        places = self.result.data.arrays.node_value[:3, carrier.positions]
        return np.asarray(places.mean(axis=1)) if carrier.positions.size else np.zeros(3)

    def _loads(self, carrier: _Carrier) -> tuple[list[tuple[Part, ...]], FloatArray]:
        """The sides of a body, and (P, 6, k) the loads of each on it in each self-stress.

        Forces, and moments about the middle of the body over the characteristic length. A side is
        a part, with the hinge by which it ends there, or a support or drive at one place, of no
        part but such a hinge.
        """
        nodes = np.concatenate((carrier.positions, carrier.orientations))
        pieces = [np.arange(self.start[n], self.start[n + 1]) for n in nodes]
        here = np.concatenate([np.zeros(0, np.int64), *pieces])
        arrays, centre = self.result.data.arrays, self._centre(carrier)
        node, axis, row = self.node[here], self.axis[here], self.row[here]
        unit, placed = np.eye(3)[axis], self.is_position[node][:, None]
        arms = np.cross(arrays.node_value[:3, node].T - centre, unit)
        acts = np.concatenate((unit * placed, np.where(placed, arms, unit) / self.length), axis=1)
        acts *= -(self.value[here] * self.over_weight[row])[:, None]
        classes = arrays.coordinate_class[axis, node]
        is_held = np.isin(classes, (Class.FIXED, Class.INDEPENDENT))
        ended = [self.part[e] for e in self.element[here].tolist()]
        side_of = self._sides(carrier, dict.fromkeys(ended))
        entries: dict[object, list[tuple[int, float]]] = {}
        for k, (part, held) in enumerate(zip(ended, is_held.tolist(), strict=True)):
            if part in side_of:
                entries.setdefault(side_of[part], []).append((k, 1.0))
            if held:
                place = self.result.parts.place_of(int(self.result.condensed.nodes[node[k]]))
                entries.setdefault(place, []).append((k, -1.0))
        made = np.zeros((len(entries), 6, self.stresses.shape[1]))
        for side, mine in enumerate(entries.values()):
            at, factor = (np.array(each) for each in zip(*mine, strict=True))
            made[side] = (acts[at] * factor[:, None]).T @ self.stresses[row[at]]
        parts_of = grouped((side, part) for part, side in side_of.items())
        return [tuple(parts_of.get(side, ())) for side in entries], made

    def _sides(self, carrier: _Carrier, ended: Iterable[Part]) -> dict[Part, object]:
        """Of each part at a body the part, or the place of the support, that it is one side with.

        A notch or hinge passes on moments alone; the force goes through what ends at its place.
        """
        result, nodes = self.result, self.result.condensed.nodes
        own = set(nodes[carrier.orientations].tolist())
        slots = result.given.arrays.element_node[[1, 3]] - 1
        side_of: dict[Part, object] = {
            part: part for part in ended if carrier.own.isdisjoint(part.elements)
        }
        for hinge in [part for part in side_of if part.kind is PartKind.HINGE]:
            seen = set(slots[:, hinge.elements[0]].tolist())
            place = next(map(result.parts.place_of, seen & own), None)
            left = seen - own
            while left:
                turned = left.pop()
                # Of several hinges to one support each is a side of its own.
                if result.parts.is_held(turned) and place not in (None, *side_of.values()):
                    side_of[hinge] = place
                for part in result.parts.turning(turned):
                    if part.kind is PartKind.HINGE:
                        further = set(slots[:, part.elements[0]].tolist()) - seen
                        seen |= further
                        left |= further
                    elif part in side_of:
                        side_of[hinge] = part
        return side_of

    def _twists(self, carrier: _Carrier, velocities: Sequence[FloatArray]) -> FloatArray:
        """(6, d) what a body does: velocity of its middle, rotation as a length; orthonormal."""
        made = []
        for each in velocities:
            both = np.zeros((6, each.shape[2]))
            for rows, nodes in (
                (slice(0, 3), carrier.positions),
                (slice(3, 6), carrier.orientations),
            ):
                if nodes.size:
                    both[rows] = each[nodes].mean(axis=0)
            made.append(both)
        return span(np.concatenate(made, axis=1), self.least)

    def _of_body(
        self, carrier: _Carrier, sides: list[tuple[Part, ...]], loads: FloatArray
    ) -> BodyHolding:
        free = self._twists(carrier, self.free)
        movable = self._twists(carrier, self.movable) if len(self.movable) > 1 else free
        ways = self.ways if carrier.orientations.size else [w for w in self.ways if w < 3]
        centre = self._centre(carrier)
        frame = self._frame(carrier, sides, loads, (free, movable), ways)
        whose = carrier.of, tuple(dict.fromkeys(part for side in sides for part in side))
        if frame is None:
            count, surplus = len(ways) - movable.shape[1], loads.shape[2]
            rest = (Together(("others",), count + surplus, count),) if count + surplus else ()
            declared = self._screws(carrier, movable.shape[1] - free.shape[1], is_declared=True)
            undeclared = self._screws(carrier, free.shape[1], is_declared=False)
            return BodyHolding(
                *(carrier.name, {}, declared, undeclared, rest, {}, centre, np.eye(3), {}),
                *whose,
            )
        there = [self._seen(each, frame.at - centre, frame.axes) for each in (movable, free)]
        moves = _diagonal(there[0]) > 0.5
        frees = moves & ~_complement(there[1], moves)
        held: dict[str, int] = {}
        together, against = [], {}
        for group in frame.groups:
            # What hangs together with a motion that is held counts for that one.
            stopped = [way for way in group if not moves[way]]
            for way in stopped or group:
                along = frame.loads[:, way]
                values = np.linalg.svd(along, compute_uv=False)
                n = int(np.count_nonzero(values > self.least))
                if stopped or n:
                    held[MOTIONS[way]] = 1 + n
                if not stopped and n:
                    loaded = np.linalg.norm(along, axis=1) > self.least
                    those = [sides[k] for k in np.flatnonzero(loaded).tolist()]
                    against[MOTIONS[way]] = self._others(carrier, those)
            n = round(float(np.sum(frame.loads[:, list(group)] ** 2)))
            if len(stopped) == 1:
                held[MOTIONS[stopped[0]]] = 1 + n
            if len(stopped or group) > 1:
                names = tuple(MOTIONS[way] for way in stopped or group)
                together.append(Together(names, len(names) + n, len(names)))
        moving = [way for k, way in enumerate(MOTIONS) if moves[k]]
        return BodyHolding(
            carrier.name,
            {way: held[way] for way in MOTIONS if way in held},
            tuple(MOTIONS[way] for way in ways if moves[way] and not frees[way]),
            tuple(MOTIONS[way] for way in ways if frees[way]),
            tuple(together),
            against,
            frame.at,
            frame.axes,
            self._where(frame, centre, carrier, moving, held),
            *whose,
        )

    def _others(self, carrier: _Carrier, sides: Sequence[tuple[Part, ...]]) -> tuple[str, ...]:
        """Names of the other bodies at the ends of sides; a side without parts is a drive."""
        slots = self.result.given.arrays.element_node - 1
        made: dict[str, None] = {}
        for part in (part for side in sides for part in side):
            nodes = {*part.ends, *slots[:, list(part.elements)].ravel().tolist()}
            at = [k for node in sorted(nodes) for k in self.carried_at.get(node, ())]
            made.update(
                {self.carriers[k].name: None for k in at if self.carriers[k] is not carrier}
            )
        if not all(sides):
            made["its drive"] = None
        return tuple(made) or ("what moves with it",)

    def _screws(self, carrier: _Carrier, count: int, *, is_declared: bool) -> tuple[str, ...]:
        """What a body does of its own where no axes separate it: screws in words, or how many."""
        if not count:
            return ()
        target = carrier.of
        if isinstance(target, Joint):
            return (f"{number_in_words(count)} motion{'s' * (count > 1)}",)
        if is_declared:
            moving = [each.motion for each in self.freedoms[: 4 * _MOST_SCREWS]]
            found = [motion.of(target) for motion in moving if motion is not None]
        else:
            found = [motion.of(target) for motion in self.motions[: 4 * _MOST_SCREWS]]
        told = tuple(_screw_words(screw, self.length) for screw in found if screw)
        if len(told) == count <= _MOST_SCREWS:
            return told
        return (f"{number_in_words(count)} motion{'s' * (count > 1)}",)

    def _where(
        self,
        frame: _Frame,
        centre: FloatArray,
        carrier: _Carrier,
        moving: list[str],
        held: dict[str, int],
    ) -> dict[str, str]:
        """Where it turns, and along what axes: as far as some motions are not as all others are."""
        apart = [MOTIONS[group[0]] for group in frame.groups if len(group) == 1]
        apart = [*moving, *(way for way in apart if way not in moving and held[way] > 1)]
        letters = {way[-1] for way in apart}
        every = {MOTIONS[way][-1] for group in frame.groups for way in group}
        for group in frame.groups:
            mine = {MOTIONS[way][-1] for way in group}
            letters |= mine if len(group) > 1 and mine | letters < every else set()
        told = [
            f"{name} along {direction_words(axis)}"
            for name, axis, unit in zip("xyz", frame.axes.T, np.eye(3), strict=True)
            if name in letters and np.abs(axis - unit).max() > HELD
        ]
        turning = [way for way in moving if way[0] == "r"]
        turning = turning or [way for way in apart if way[0] == "r"]
        is_aside = np.linalg.norm(frame.at - centre) > HELD * self.length
        if not (carrier.orientations.size and turning and is_aside):
            return {"": ", ".join(told)} if told else {}
        units = self.result.given.units
        shown, unit = units.shown(frame.at, "m"), units.symbol("m")
        at = in_words(shown, units.shown(self.length, "m"))[1:-1].split(", ")
        made = {}
        if self.result.given.planar:
            made["rz"] = f"about the point ({', '.join(at[:2])}) {unit}"
        elif len(turning) > 1:
            told.append(f"rotations about the point ({', '.join(at)}) {unit}")
        else:
            if not told:
                at["xyz".index(turning[0][1])] = "*"
            made[turning[0]] = f"about the line through ({', '.join(at)}) {unit}"
        return {**made, "": ", ".join(told)} if told else made

    # Points and axes --------------------------------------------------------

    def _seen(self, twists: FloatArray, step: FloatArray, axes: FloatArray) -> FloatArray:
        """(6, d) twists from a point that is a step from the middle, along axes; orthonormal."""
        if not twists.size:
            return twists
        velocity = twists[:3] + np.cross(twists[3:].T / self.length, step).T
        both = np.concatenate((axes.T @ velocity, axes.T @ twists[3:]))
        return np.asarray(np.linalg.qr(both)[0])

    def _frame(
        self,
        carrier: _Carrier,
        sides: list[tuple[Part, ...]],
        loads: FloatArray,
        spaces: tuple[FloatArray, FloatArray],
        ways: list[int],
    ) -> _Frame | None:
        """The point and the axes in which most falls apart; None where the motions do not."""
        centre = self._centre(carrier)
        steps = self._steps(carrier, loads, spaces[1])
        if steps is None:
            return None
        free, movable = spaces
        all_axes = [
            axes
            for axes in self._axes(sides, loads, spaces)
            if _is_of_axes(self._seen(movable, steps[0], axes))
        ]
        all_axes = [axes for axes in all_axes if self._is_along(free, axes)] or all_axes
        best: _Frame | None = None
        count = loads.shape[2]
        most = max(1, int(_MOST_TRIED / max(1, loads.size * count)))
        for step, axes in islice(product(steps, all_axes), most):
            moved = np.concatenate((loads[:, _MOVED], loads[:, _TURNED]), axis=1)
            moved[:, _TURNED] -= np.cross(step, np.eye(3)).T @ loads[:, _MOVED] / self.length
            flat = (np.kron(np.eye(2), axes.T) @ moved).reshape(6 * len(loads), count)
            # Orthonormal again, by the root of the table of products.
            root = np.linalg.cholesky(flat.T @ flat)
            along = np.linalg.solve(root, flat.T).T.reshape(loads.shape)
            groups = _groups(along, ways)
            if best is None or len(groups) > len(best.groups):
                at = centre + step
                at[np.abs(at) < SAME_PLACE * self.length] = 0.0
                best = _Frame(at, axes, groups, along)
            if len(groups) == len(ways):
                break
        return best

    def _parted(self, twists: FloatArray) -> tuple[FloatArray, FloatArray]:
        """(6, a) of twists those that turn, and (3, b) orthonormal, the translations among them."""
        _, values, right = np.linalg.svd(twists[3:])
        turning = int(np.count_nonzero(values > self.least))
        return twists @ right[:turning].T, twists[:3] @ right[turning:].T

    def _is_along(self, twists: FloatArray, axes: FloatArray) -> bool:
        """Whether translations, and axes of rotations, are spanned by some of the axes."""
        turning, shifts = self._parted(twists) if twists.size else (twists, twists[:3])
        return all(_is_of_axes(axes.T @ each) for each in (shifts, span(turning[3:], self.least)))

    def _steps(
        self, carrier: _Carrier, loads: FloatArray, twists: FloatArray
    ) -> list[FloatArray] | None:
        """From the middle to the points about which what a body can do is of rotations.

        That velocities v + w x step of its rotations are translations that it can make anyway is
        linear in the step; None where there is no such point.
        """
        matrix, wanted = [np.zeros((0, 3))], [np.zeros(0)]
        if twists.size:
            turning, shifts = self._parted(twists)
            across = np.eye(3) - shifts @ shifts.T
            for each in turning.T:
                matrix.append(across @ np.cross(each[3:] / self.length, np.eye(3)).T)
                wanted.append(-across @ each[:3])
        left, right_side = np.concatenate(matrix), np.concatenate(wanted)
        first = np.linalg.lstsq(left, right_side, rcond=self.least)[0] if left.size else np.zeros(3)
        if left.size and np.abs(left @ first - right_side).max() > 10.0 * self.least:
            return None
        along = null_space(left * self.length, self.least)
        made: list[FloatArray] = [np.asarray(first, float)]
        if carrier.orientations.size and loads.size:
            middle, values = self._centre(carrier), self.result.data.arrays.node_value[:3]
            tried = [values[:, n] - middle for n in carrier.positions[:_MOST_PLACES]]
            for each in tried:
                step = first + along @ (along.T @ (each - first))
                if all(np.linalg.norm(step - other) > HELD * self.length for other in made):
                    made.append(step)
        return made

    def _axes(
        self,
        sides: list[tuple[Part, ...]],
        loads: FloatArray,
        spaces: tuple[FloatArray, FloatArray],
    ) -> list[FloatArray]:
        """Axes that are tried: of the model, of the parts at the body, and of its spaces."""
        made = [np.eye(3)]
        frames = self.result.data.frames.frame
        elements = (
            np.searchsorted(self.result.condensed.elements, p.elements[0])
            for side in sides
            for p in side
        )
        count = self.result.data.arrays.element_number.size
        tried = [_named(frames[e]) for e in list(elements)[:_MOST_AXES] if e < count]
        # Axes of which each space is spanned by some are eigenvectors of any sum of projectors.
        blocks = [each[rows] for each in spaces for rows in (_MOVED, _TURNED)]
        felt = [loads[:, rows].transpose(1, 0, 2).reshape(3, -1) for rows in (_MOVED, _TURNED)]
        tried.append(_named(_eigenvectors(np.eye(3), (_sum(blocks), _sum(felt)), self.least)))
        for axes in tried:
            if self.result.given.planar and abs(axes[2, 2]) < 1.0 - HELD:
                continue
            if all(np.abs(axes - other).max() > HELD for other in made):
                made.append(axes)
        return made

    # What no body feels -----------------------------------------------------

    def _inside(self, rest: FloatArray) -> Iterator[HeldInside]:
        """Parts that are held too often between their ends; those that hang together are one."""
        if not rest.shape[1]:
            return
        stress = self.stresses @ rest
        rows = np.flatnonzero(np.linalg.norm(stress, axis=1) > self.least)
        owners = [self.part[e] for e in (self.result.raw.row_label[0, rows] - 1).tolist()]
        places = {part: k for k, part in enumerate(dict.fromkeys(owners))}
        at = np.array([places[part] for part in owners])
        blocks = np.zeros((len(places), len(places)))
        np.maximum.at(blocks, (at[:, None], at), np.abs(stress[rows] @ stress[rows].T))
        named = list(places)
        for group in _hanging_together(blocks > self.least):
            mine = [k for k in group]
            count = round(float(np.sum(stress[rows[np.isin(at, mine)]] ** 2)))
            parts = sorted((named[k] for k in mine), key=lambda part: natural(part.name))
            flexible = [part for part in parts if part.kind is not PartKind.BODY] or parts
            yield HeldInside(tuple(flexible), count)


_MOVED, _TURNED = slice(0, 3), slice(3, 6)


def _diagonal(twists: FloatArray) -> FloatArray:
    """(6,) of the projector on orthonormal twists."""
    return np.asarray((twists**2).sum(axis=1))


def _complement(twists: FloatArray, moves: BoolArray) -> BoolArray:
    """Which of some motions span all of them with orthonormal twists: the declared ones.

    What nobody declared is found with the declared points at rest, and so may turn about these;
    of motions that do, the one is declared that is the least like them.
    """
    chosen = np.zeros(6, bool)
    for _ in range(int(moves.sum()) - twists.shape[1]):
        rest = np.eye(6) - twists @ twists.T
        size = np.where(moves & ~chosen, np.linalg.norm(rest, axis=0), -1.0)
        way = int(np.argmax(np.round(size, 6)))
        chosen[way] = True
        added = rest[:, way : way + 1] / np.linalg.norm(rest[:, way])
        twists = np.concatenate((twists, added), axis=1)
    return chosen


def _is_of_axes(twists: FloatArray) -> bool:
    """Whether orthonormal twists are spanned by some of the six motions."""
    share = _diagonal(twists)
    return bool(np.all(np.minimum(share, np.abs(1.0 - share)) < HELD))


def _groups(loads: FloatArray, ways: Sequence[int]) -> tuple[tuple[int, ...], ...]:
    """Motions whose orthonormal loads (P, 6, r) hang together."""
    along = loads[:, list(ways)].transpose(1, 0, 2)
    gram = (along.transpose(0, 2, 1) @ along).reshape(len(ways), -1)
    hang = np.sqrt(np.abs(gram @ gram.T)) > HELD
    return tuple(tuple(ways[k] for k in group) for group in _hanging_together(hang))


def _hanging_together(linked: np.ndarray) -> list[list[int]]:
    """Indices in groups, of a symmetric table of which are linked; by their first ones."""
    reach = np.eye(len(linked), dtype=bool) | linked
    for _ in range(int(np.ceil(np.log2(max(len(linked), 2))))):
        reach = (reach.astype(float) @ reach.astype(float)) > 0.0
    firsts = np.argmax(reach, axis=1)
    return [np.flatnonzero(firsts == first).tolist() for first in values_in(firsts)]


def _named(axes: FloatArray) -> FloatArray:
    """Axes in the order and the sense in which they are nearest to those of the model."""
    order = max(permutations(range(3)), key=lambda p: float(np.abs(axes[range(3), list(p)]).sum()))
    made = axes[:, list(order)]
    made = made * np.where(np.diag(made) < 0.0, -1.0, 1.0)
    if np.linalg.det(made) < 0.0:
        made[:, int(np.argmin(np.diag(made)))] *= -1.0
    return np.asarray(made)


#: Factors by which no two sums of projectors have the same eigenvalues by chance.
_FACTORS = np.sqrt([2.0, 3.0, 5.0, 7.0])


def _sum(blocks: Sequence[FloatArray]) -> FloatArray:
    """(3, 3) sum of projectors, each by a factor of its own."""
    made = np.zeros((3, 3))
    for factor, block in zip(_FACTORS, blocks, strict=False):
        made += factor * block @ block.T
    return made


def _eigenvectors(basis: FloatArray, matrices: Sequence[FloatArray], least: float) -> FloatArray:
    """Orthonormal columns that span the same as others, along eigenvectors of symmetric matrices.

    Where a matrix has several alike, the next one decides, at last the axes of the model.
    """
    if basis.shape[1] < 2:
        return basis
    if not matrices:
        made: list[FloatArray] = []
        for axis in sorted(np.eye(3), key=lambda axis: -float(np.linalg.norm(axis @ basis))):
            within = basis @ (basis.T @ axis)
            for other in made:
                within = within - (other @ within) * other
            if len(made) < basis.shape[1] and np.linalg.norm(within) > least:
                made.append(within / np.linalg.norm(within))
        return np.stack(made, axis=1)
    values, vectors = np.linalg.eigh(basis.T @ matrices[0] @ basis)
    cuts = np.flatnonzero(np.diff(values) > least * max(1.0, float(np.abs(values).max()))) + 1
    alike = np.split(basis @ vectors, cuts, axis=1)
    return np.concatenate([_eigenvectors(each, matrices[1:], least) for each in alike], axis=1)


def _screw_words(screw: Screw, length: float) -> str:
    """A screw without its size, as a noun."""
    along = direction_words(screw.direction)
    if screw.kind is ScrewKind.TRANSLATION:
        return f"translation along {along}"
    through = place_in_words(screw.point, length, screw.units)
    line = f"rotation about the line through {through} along {along}"
    if screw.kind is ScrewKind.ROTATION:
        return line
    return f"{line} with {screw.units.said(screw.pitch, 'm/rad')} along it"
