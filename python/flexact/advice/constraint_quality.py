# SPDX-License-Identifier: BSD-3-Clause
"""What each flexure of an exactly constrained mechanism holds, and how well.

Flexures hang together where they meet away from bodies and ground, as the leaves of a folded sheet
do. Of such a flexure between two bodies A and B, with the rates R_b t + R_i x of what its elements
hold, t the twist of B against A and x what moves within it, the wrenches that it can carry are
those of l'R_b with l'R_i = 0.

How well: with the wrenches of all flexures as rows on the twists of all bodies, orthonormal for
each flexure, the sine of the smallest angle between those of one and the span of all others. It is
1 where nothing that it holds leans on another flexure, and 0 where it would hold what others hold
already. The length of the mechanism makes rotations comparable with displacements
(`docs/theory.md`, what a flexure holds).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..analysis.naming import plain
from ..analysis.result import Result
from ..analysis.sparse_basis import index_of
from ..analysis.verdict import Verdict
from ..core.arrays import FloatArray
from ..core.elements import Class, NodeKind
from ..model.parts.parts import Part, PartKind
from ..util.groups import grouped, groups_of
from ..util.records import Frozen
from .spaces.screws import ScrewSpace
from .spaces.words import Geometry, space_in_words

#: Rates below this part of the largest are rounding.
_ROUNDING = 1.0e-9
#: Of more elements or bodies it is not found: it takes dense matrices.
_MOST_ELEMENTS, _MOST_BODIES = 600, 60
#: So many flexures meet at a place that is a body of its own.
_MEET = 3
_GROUND = -1
#: The size of a flexure without extent, a part of the mechanism's length.
_OF_A_HINGE = 0.2


@dataclass(frozen=True, eq=False)
class Hold(Frozen):
    """What a flexure holds.

    Attributes:
        parts: The sheets, wires, bars, beams and hinges that it is made of.
        space: The wrenches that it carries between its two ends, about its middle.
        sine: How well: of the smallest angle to what all others hold, above 0 to 1.
        extent: The size of the flexure [m].
    """

    parts: tuple[Part, ...]
    space: ScrewSpace
    sine: float
    extent: float

    @property
    def name(self) -> str:
        """Such as "wire 1", "sheet 1 and sheet 2", or "folded sheet 1" of both its leaves."""
        names = [part.name for part in self.parts]
        whole = {name.partition(", ")[0] for name in names}
        return whole.pop() if len(names) > 1 and len(whole) == 1 else " and ".join(names)


def holds_of(result: Result) -> tuple[Hold, ...]:
    """What each flexure holds, in the order of their elements.

    Nothing of a mechanism that is not exactly constrained, that is large, or whose flexures do not
    each stand between two bodies.
    """
    if result.verdict is not Verdict.EXACT:
        return ()
    if result.given.arrays.element_number.size > _MOST_ELEMENTS:
        return ()
    net = _Net(result)
    if not 0 < net.bodies <= _MOST_BODIES:
        return ()
    found = [each for each in map(net.wrenches, net.groups) if each is not None]
    if not found or len(found) < len(net.groups):
        return ()
    # Bodies that share a point have a hinge there, which has it in what it holds.
    pairs = {bodies for _, bodies, _, _ in found}
    if any(len(own) != 2 or tuple(sorted(own)) not in pairs for own in net.pins.values()):
        return ()
    # Of the smallest angle between the span of each block of rows and that of all others: the least
    # norm of motions that only one block sees, when it sees unit rates, is one over it.
    blocks = [_orthonormal(net.on_bodies(each)) for each in found]
    ends = np.cumsum([len(each) for each in blocks])[:-1]
    inverse = np.split(np.linalg.pinv(np.concatenate(blocks)), ends, axis=1)
    sines = [1.0 / float(np.linalg.norm(each, 2)) for each in inverse]
    return tuple(net.told(each, sine) for each, sine in zip(found, sines, strict=True))


def _orthonormal(rows: FloatArray) -> FloatArray:
    _, sizes, turned = np.linalg.svd(rows, full_matrices=False)
    return np.asarray(turned[sizes > _ROUNDING * sizes.max(initial=0.0)])


#: What elements carry: they, two bodies, a point, and wrenches (k, 6), force and moment about it,
#: on the second of the bodies.
_Carried = tuple[tuple[int, ...], tuple[int, int], FloatArray, FloatArray]


class _Net:
    """The bodies of a mechanism, and the flexures between them."""

    def __init__(self, result: Result) -> None:
        """Find them in the model as it was analysed."""
        self.result, self.data = result, result.data
        self.length = result.characteristic_length
        arrays = self.data.arrays
        self.slots = arrays.element_node.T.astype(int) - 1
        self.place = arrays.node_value[:3].T
        self.placed = arrays.node_kind <= NodeKind.POSITION
        #: Of each node its body; -1 is ground, and -2 none.
        self.owner = np.full(arrays.node_kind.size, -2)
        given = {node: k for k, node in enumerate(result.condensed.nodes.tolist())}
        known = {element: k for k, element in enumerate(result.condensed.elements.tolist())}
        bodies = result.parts.bodies
        rigid = {known[e] for body in bodies for e in body.elements if e in known}
        held_by = [(node, k) for k, body in enumerate(bodies) for node in body.positions]
        for k, body in enumerate(bodies):
            self.owner[[given[n] for n in (*body.positions, *body.orientations) if n in given]] = k
        fixed = np.all(np.isin(arrays.coordinate_class, (Class.FIXED, Class.NONE)), axis=0)
        self.owner[fixed] = _GROUND
        shared = grouped(
            [
                *((given[node], k) for node, k in held_by if node in given),
                *((node, _GROUND) for node in np.flatnonzero(fixed).tolist()),
            ]
        )
        #: Of positions that several bodies share, which those are.
        self.pins = {node: set(own) for node, own in shared.items() if len(set(own)) > 1}
        self.flexible = [e for e in range(len(self.slots)) if e not in rigid]
        self.bodies = self._with_joints(len(bodies))
        self.groups = self._grouped()
        centres = [self.place[(self.owner == k) & self.placed] for k in range(self.bodies)]
        self.centres = [each.mean(axis=0) if len(each) else np.zeros(3) for each in centres]

    def _with_joints(self, count: int) -> int:
        """Count places where several flexures meet as bodies, with what turns there."""
        ends = Counter(n for e in self.flexible for n in self.slots[e].tolist() if n >= 0)
        # Each of p and q with the orientation that is there.
        beside = self.slots[self.flexible].reshape(-1, 2).tolist()
        turning = grouped((position, turned) for position, turned in beside if position >= 0)
        for node, many in ends.items():
            if many >= _MEET and self.placed[node] and self.owner[node] == -2:
                turned = set(turning.get(node, ()))
                own = [n for n in turned if n >= 0 and self.owner[n] == -2]
                if len(own) == len(turned) == 1:
                    self.owner[[node, *own]] = count
                    count += 1
        return count

    def _grouped(self) -> list[tuple[int, ...]]:
        """Flexible elements that hang together away from bodies and ground."""
        count, free = len(self.flexible), np.flatnonzero(self.owner == -2)
        # Elements and nodes, side by side.
        ends = np.argwhere(np.isin(self.slots[self.flexible], free)).tolist()
        pairs = ((k, count + int(self.slots[self.flexible[k], slot])) for k, slot in ends)
        group = groups_of(count + self.owner.size, pairs)[:count].tolist()
        return list(map(tuple, grouped(zip(group, self.flexible, strict=True)).values()))

    def wrenches(self, elements: tuple[int, ...]) -> _Carried | None:
        """What a flexure carries; None unless it stands between two bodies."""
        nodes = sorted({n for e in elements for n in self.slots[e].tolist() if n >= 0})
        ends = sorted({int(self.owner[n]) for n in nodes if self.owner[n] >= _GROUND})
        partly = np.isin(self.data.arrays.coordinate_class[:, nodes], (Class.FIXED,))
        if ends and ends[0] != _GROUND and len(ends) == 1 and partly.any():
            ends = [_GROUND, *ends]
        places = [n for n in nodes if self.placed[n]]
        pins = [] if places else [n for n, own in self.pins.items() if own == set(ends)]
        if len(ends) != 2 or len(places) + len(pins) == 0 or self.pins.keys() & set(places):
            return None
        middle = self.place[places or pins[:1]].mean(axis=0)
        rates = self._rates(elements, nodes)
        body = np.zeros((rates.shape[0], 6))
        inner = []
        for k, node in enumerate(nodes):
            block = rates[:, 3 * k : 3 * k + 3]
            if self.owner[node] == ends[1]:
                # The velocity of a node of a body from its twist (v, w) about the middle.
                turned = np.cross(self.place[node] - middle, np.eye(3))
                moved_by = np.hstack((np.eye(3), turned)) if self.placed[node] else np.eye(3, 6, 3)
                body += block @ moved_by
            elif self.owner[node] == -2:
                classes = self.data.arrays.coordinate_class[:3, node]
                inner.append(block[:, np.isin(classes, (Class.DEPENDENT, Class.INDEPENDENT))])
        moved = np.concatenate([np.zeros((len(body), 0)), *inner], axis=1)
        left, rank = np.eye(len(body)), 0
        if moved.shape[1]:
            left, sizes, _ = np.linalg.svd(moved)
            rank = int(np.sum(sizes > _ROUNDING * sizes.max(initial=0.0)))
        # Where two bodies share a point, that holds them together as well.
        pinned = np.eye(3, 6)[: 2 if self.result.given.planar else 3] if pins else np.zeros((0, 6))
        rows = np.concatenate((left[:, rank:].T @ body, pinned)) * np.repeat(
            (1.0, 1.0 / self.length), 3
        )
        held = _orthonormal(rows) if rows.size else np.zeros((0, 6))
        if not len(held):
            return None
        # A twist is (v, w length) there, and a wrench (f, m/length).
        wrenches = held * np.repeat((1.0, self.length), 3)
        return elements, (ends[0], ends[1]), middle, wrenches

    def _rates(self, elements: tuple[int, ...], nodes: list[int]) -> FloatArray:
        """(held, 3 nodes) rates of what elements hold, rotations by the length of the mechanism."""
        raw, classes = self.result.assembly, self.data.arrays.deformation_class.T
        element, deformation = np.nonzero(classes[list(elements)] == Class.FIXED)
        held = 6 * np.array(elements)[element] + deformation
        moving = (3 * np.array(nodes)[:, None] + np.arange(3)).ravel()
        row = index_of(held, classes.size)[raw.row_of]
        column = index_of(moving, 3 * len(self.owner))[raw.column_of]
        made = np.zeros((held.size, moving.size))
        np.add.at(made, (row[row >= 0], column[row >= 0]), raw.value[row >= 0])
        return made

    def on_bodies(self, carried: _Carried) -> FloatArray:
        """(k, 6 bodies) wrenches on the twists of all bodies, each about its own middle."""
        _, bodies, middle, wrenches = carried
        made = np.zeros((len(wrenches), 6 * self.bodies))
        for body, sign in zip(bodies, (-1.0, 1.0), strict=True):
            if body != _GROUND:
                force, moment = wrenches[:, :3], wrenches[:, 3:]
                about = moment + np.cross(middle - self.centres[body], force)
                both = np.concatenate((force, about / self.length), axis=1)
                made[:, 6 * body : 6 * body + 6] = sign * both
        return made

    def told(self, carried: _Carried, sine: float) -> Hold:
        """A flexure in the words of the model as it was given."""
        elements, _, middle, wrenches = carried
        given = self.result.condensed.elements
        parts = dict.fromkeys(self.result.parts.of_element(int(given[e])) for e in elements)
        nodes = [n for e in elements for n in self.slots[e, [0, 2]].tolist() if n >= 0]
        places = self.place[nodes] if nodes else np.zeros((1, 3))
        extent = float(np.linalg.norm(np.ptp(places, axis=0))) or _OF_A_HINGE * self.length
        scaled = _orthonormal(wrenches * np.repeat((self.length, 1.0), 3))
        space = ScrewSpace(
            scaled / np.repeat((self.length, 1.0), 3),
            middle,
            self.length,
            of_wrenches=True,
            planar=self.result.given.planar,
        )
        kept = tuple(part for part in parts if part.kind is not PartKind.BODY)
        return Hold(kept, space, sine, extent)


#: What the number is.
MEANING = "the sine of the smallest angle to what all others hold: 1 on its own, 0 over-constrained"
#: So many are named in a caption.
_MOST = 6


def number_of(hold: Hold) -> str:
    """How well it holds, in two digits; never 0 or 1 where it is not."""
    return f"{hold.sine:.2f}" if hold.sine >= 0.005 else f"{hold.sine:.0e}"


def hold_in_words(result: Result, hold: Hold) -> str:
    """What a flexure holds, a sentence."""
    held = "; ".join(map(plain, space_in_words(Geometry.of_mechanism(result), hold.space)))
    few = hold.space.dimension
    count = f"{few} independent force{'s' * (few > 1)} or moments: " if few > 1 else ""
    verb = "hold" if len(hold.parts) > 1 else "holds"
    name = f"{hold.name[:1].upper()}{hold.name[1:]}"
    return f"{name} {verb} {count}{held}. How well: {number_of(hold)}, {MEANING}."


def holds_in_words(holds: Sequence[Hold]) -> str:
    """How well each flexure holds, the worst first, a sentence."""
    worst = sorted(holds, key=lambda hold: round(hold.sine, 6))
    told = "; ".join(f"{hold.name}: {number_of(hold)}" for hold in worst[:_MOST])
    more = f"; and {len(worst) - _MOST} more" if len(worst) > _MOST else ""
    return f"What each flexure holds, and how well ({MEANING}): {told}{more}."
