# SPDX-License-Identifier: BSD-3-Clause
"""Where on a body, and along which lines, wires may be put."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from ...analysis.decomposition import Asked, column_weights, decompose
from ...analysis.limits import ROUNDING
from ...analysis.result import Result
from ...core.arrays import FloatArray, IndexArray
from ...core.elements import Class, NodeKind
from ...core.raw import RawAnalysis
from ...deck.rendering import ModelError, model_error
from ...model.data import ModelData
from ...model.names import nearest
from ...model.parts.parts import Joint, Part, PartKind, natural
from ...util.records import cached_property
from ...util.text import in_short
from .screws import Family, FamilyKind, ScrewSpace, canonical

#: Where so many parts meet they may be the two leaves of a folded sheet.
_OF_A_FOLD = 2


class Subject(NamedTuple):
    """A body, or a joint with an orientation, and its nodes in the model as given."""

    body: Part | Joint
    positions: tuple[int, ...]
    """Indices of the position nodes that it carries."""
    orientations: tuple[int, ...]
    """Indices of the orientation nodes that turn with it."""

    @property
    def name(self) -> str:
        """What it is called."""
        return str(self.body)

    @property
    def is_body(self) -> bool:
        """Whether it is a body, not a joint."""
        return isinstance(self.body, Part)

    def middle(self, result: Result) -> FloatArray:
        """(3,) the mean of its points [m]."""
        values = result.given.arrays.node_value[:3, list(self.positions)]
        return np.asarray(values.mean(axis=1))


def subjects_of(result: Result) -> tuple[Subject, ...]:
    """All bodies, then all joints that have an orientation, without those that are ground."""
    held = result.parts.is_held
    # Ground is what a support holds in all that it has.
    return tuple(
        each
        for each in _all(result)
        if not (any(map(held, each.positions)) and any(map(held, each.orientations)))
    )


def _all(result: Result) -> Iterator[Subject]:
    parts = result.parts
    for k, body in enumerate(parts.bodies):
        yield Subject(parts.of_body(k), body.positions, body.orientations)
    for joint in result.carriers.joints:
        if joint.position is not None and joint.orientation is not None:
            yield Subject(joint, (joint.position,), (joint.orientation,))


def subject_named(result: Result, name: str) -> Subject:
    """The body or joint of a name; of a point on a body the body.

    Raises:
        ModelError: there is none, it is no body, or there are several.
    """
    every = tuple(_all(result))
    placed = np.flatnonzero(result.given.arrays.node_kind <= NodeKind.POSITION).tolist()
    for spelling in (name, f"the {name}", name.removeprefix("the ")) if name.strip() else ():
        called = [each for each in every if each.name == spelling]
        found = [each for each in called if each.is_body]
        places = {node for node in placed if result.parts.name_of_point(node) == spelling}
        found = found or [each for each in every if places & set(each.positions)] or called
        if len(found) > 1:
            raise model_error(
                "ambiguous-part",
                f"{len(found)} bodies are called {in_short(name)}",
                "give each a name of its own",
            )
        if found:
            return found[0]
    raise _no_body(result, every, name)


def _no_body(result: Result, every: tuple[Subject, ...], name: str) -> ModelError:
    others = [part for part in result.parts.all if part.name == name]
    if others:
        what = f"{in_short(name)} is no body but a {others[0].kind}"
    elif name.strip() and any(
        result.parts.name_of_point(k) == name for k in range(len(result.given.node_names))
    ):
        what = f"the point {in_short(name)} has no orientation: nothing there can turn"
    else:
        what = f"there is no body called {in_short(name)}"
    names = list(dict.fromkeys(each.name for each in every if each.is_body))
    names += [each.name for each in every if isinstance(each.body, Joint) and bool(each.body.name)]
    near = nearest(name, names) or sorted(names, key=natural)[:3]
    are = "is" if len(near) == 1 else "are"
    hint = f"there {are} {', '.join(map(in_short, near))}" if near else "this mechanism has no body"
    return model_error("no-body", what, hint)


#: By what the body that a designer means is found; the first that differs decides: less how many
#: coordinates of it are declared independent; whether it is a joint; of joints less how many parts
#: meet there, if more than at a fold; less in how many independent ways it moves; less its extent,
#: in parts of the characteristic length; its name; its place.
Rank = tuple[int, bool, int, int, float, tuple[tuple[bool, int, str, str], ...], tuple[float, ...]]


def rank_of(result: Result, subject: Subject, freedom: int) -> Rank:
    """The body with the least rank is the one that is meant when none is named."""
    arrays, length, body = result.given.arrays, result.characteristic_length, subject.body
    nodes = [*subject.positions, *subject.orientations]
    declared = int(np.sum(arrays.coordinate_class[:, nodes] == Class.INDEPENDENT))
    places = arrays.node_value[:3, list(subject.positions)].T / length
    size = float(np.linalg.norm(np.ptp(places, axis=0)))
    parts, name = 0, body.name
    if not isinstance(body, Part):
        parts = len(body.parts) if len(body.parts) > _OF_A_FOLD else 0
    elif not body.is_named:
        name = ""
    middle = tuple((np.round(places.mean(axis=0), 9) + 0.0).tolist())
    is_joint = not subject.is_body
    return -declared, is_joint, -parts, -freedom, -round(size, 9), natural(name), middle


class Freed:
    """A mechanism in which nothing is declared; each answer is found when it is asked for.

    Unless it is not freed: then what moves is what nobody declared.
    """

    def __init__(self, result: Result, *, is_freed: bool = True) -> None:
        """Keep the result; that of divided sheets as one beam each, where there are any."""
        self.result = result.with_internal_declared or result
        self._is_freed = is_freed

    @cached_property
    def _raw(self) -> RawAnalysis:
        if not self._is_freed or not self.result.degrees_of_freedom:
            return self.result.raw
        data, asked = self.result.data, self.result.asked
        coordinates, deformations = (
            np.asfortranarray(
                np.where(classes == Class.INDEPENDENT, np.int32(Class.DEPENDENT), classes)
            )
            for classes in (data.arrays.coordinate_class, data.arrays.deformation_class)
        )
        arrays = data.arrays._replace(coordinate_class=coordinates, deformation_class=deformations)
        freed = ModelData(
            *(arrays, data.planar, data.name, data.element_names),
            given_appearance=data.given_appearance,
            has_long_numbers=data.has_long_numbers,
        )
        return decompose(freed, Asked(asked.method, asked.tolerance))

    @cached_property
    def outcome(self) -> Result:
        """What is known of it, at the nodes of the model in which divided sheets are one beam."""
        one = self.result
        return Result(one.name, one.condensed, self._raw, one.asked)

    def has(self, subject: Subject) -> bool:
        """Whether none of its nodes is inside of a divided sheet or wire."""
        return self._place_of.keys() >= {*subject.positions, *subject.orientations}

    @property
    def is_known(self) -> bool:
        """Whether all motions are kept; of very large mechanisms there may be too many."""
        return self.outcome.raw.motions.vectors == self.outcome.under_constrained

    @cached_property
    def _motions(self) -> tuple[IndexArray, IndexArray, FloatArray]:
        """The motions by rows, each of unit norm with rotations as lengths.

        Where the entries of each row begin; of each entry the motion, and its value.
        """
        if not self.is_known:
            raise model_error(
                "too-many-motions",
                f"with nothing declared there are {self.outcome.under_constrained} motions, too "
                "many to find what a body can do",
                "declare what is inside of divided sheets, or ask of a part of the mechanism",
            )
        motions, vector = self.outcome.raw.motions, self.outcome.raw.motions.of_entries()
        weighted = motions.value * column_weights(self.outcome)[motions.place]
        norms = np.sqrt(np.bincount(vector, weighted**2, motions.vectors))
        order = np.argsort(motions.place, kind="stable")
        start = np.searchsorted(motions.place[order], np.arange(motions.size + 1))
        return start, vector[order], (motions.value / norms[vector])[order]

    @cached_property
    def _place_of(self) -> dict[int, int]:
        """Index in the model that is analysed of each node, by its index in that given."""
        return {node: k for k, node in enumerate(self.result.condensed.nodes.tolist())}

    @cached_property
    def _row_of(self) -> dict[tuple[int, int], int]:
        """Column of D(c) by node and axis."""
        labels = (self._raw.column_label - 1).T.tolist()
        return {(node, axis): k for k, (node, axis) in enumerate(labels)}

    def _rates(self, nodes: tuple[int, ...]) -> FloatArray:
        """(3, motions) mean velocity of some nodes in each motion [m or rad]."""
        start, vector, value = self._motions
        made = np.zeros((3, self.outcome.raw.motions.vectors))
        for node, axis in itertools.product(nodes, range(3)):
            column = self._row_of.get((self._place_of[node], axis))
            if column is not None:
                mine = slice(int(start[column]), int(start[column + 1]))
                made[axis, vector[mine]] += value[mine]
        return made / len(nodes)

    def space(self, subject: Subject) -> ScrewSpace:
        """All twists that a body has.

        Raises:
            ModelError: there are too many motions to be kept.
        """
        one = self.result
        length = one.characteristic_length
        velocity, rotation = self._rates(subject.positions), self._rates(subject.orientations)
        twists = np.concatenate((rotation * length, velocity))
        left, sizes, _ = np.linalg.svd(twists, full_matrices=False)
        rank = int(np.sum(sizes > self.outcome.rounding * max(1.0, sizes.max(initial=0.0))))
        rows = canonical(left[:, :rank].T) / np.repeat((length, 1.0), 3)
        return ScrewSpace(rows, subject.middle(one), length, False, one.given.planar)


#: Places nearer than this part of the characteristic length are one.
_SAME_PLACE = 1.0e-6
#: A wire is so long, in characteristic lengths, where there is no flexure to take it from.
_LENGTH = 0.5
#: Directions of members that are looked at.
_MOST_DIRECTIONS, _MOST_CROSSED = 24, 6


class Attachment(NamedTuple):
    """A point of a body, or one that a link may carry."""

    place: FloatArray
    """(3,) [m]."""
    position: int
    """Index of a position node of the body: that at the place, or the nearest."""
    orientation: int
    """Index of an orientation node of the body, of those that stand there if there is one."""
    is_there: bool
    """Whether the body has a node at the place."""
    key: tuple[object, ...]
    """By name and place, to decide between equals."""


class Site:
    """A body and what is around it; each answer is found when it is asked for."""

    def __init__(self, result: Result, subject: Subject) -> None:
        """Keep the result and the body."""
        self.result = result
        self.subject = subject
        self.middle = subject.middle(result)
        self._values = result.given.arrays.node_value[:3].T
        #: Points nearer than this are one [m].
        self.near = _SAME_PLACE * result.characteristic_length

    @cached_property
    def own(self) -> tuple[Attachment, ...]:
        """The points of the body, each place once, those with names first."""
        made: list[Attachment] = []
        stands = self.result.parts.position_of
        for node in sorted(self.subject.positions, key=self._key):
            place = self._values[node]
            if all(np.linalg.norm(place - other.place) > self.near for other in made):
                turning = (each for each in self.subject.orientations if stands.get(each) == node)
                turned = next(turning, self.subject.orientations[0])
                made.append(Attachment(place, node, turned, True, self._key(node)))
        return tuple(made)

    def carried(self, space: ScrewSpace) -> tuple[Attachment, ...]:
        """Points that a link would carry: where lines of a space come near to the body."""
        places, own = [self.middle], [self.middle, *(each.place for each in self.own)]
        for family in space.lines:
            places += [self._nearest(family, near) for near in own]
            places += list(_feet(family, self.middle)) if len(family.points) > 2 else []
        return self._carried(places)

    @property
    def reached(self) -> tuple[Attachment, ...]:
        """Points that a longer link would carry, along and across flexures from the middle."""
        arm = _LENGTH * self.result.characteristic_length
        ways = (*self.directions, *np.eye(3)[: 2 if self.result.given.planar else 3])
        return self._carried(
            [self.middle + side * arm * each for each in ways for side in (1.0, -1.0)]
        )

    def _carried(self, places: Sequence[FloatArray]) -> tuple[Attachment, ...]:
        made: list[Attachment] = []

        def far(one: Attachment) -> tuple[object, ...]:
            return round(float(np.linalg.norm(one.place - place)) / self.near), one.key

        for place in places:
            there = [each.place for each in (*self.own, *made)]
            if all(np.linalg.norm(place - other) > self.near for other in there):
                base = min(self.own, key=far)
                key = ((True,), (), (len(made),))
                made.append(Attachment(place, base.position, base.orientation, False, key))
        return tuple(made)

    def _key(self, node: int) -> tuple[object, ...]:
        """Named points first, then those where named parts end, then by place."""
        parts = self.result.parts
        name = parts.name_of_point(node)
        here = [part.name for part in parts.at(node) if part.kind is not PartKind.BODY]
        place = tuple((np.round(self._values[node] / self.near) + 0.0).tolist())
        return (not name,), natural(name or next(iter(here), "")), place

    def _nearest(self, family: Family, place: FloatArray) -> FloatArray:
        """The point nearest to a place through which lines of a family go."""
        arm = place - family.point
        if family.kind in (FamilyKind.LINE, FamilyKind.MEETING):
            return family.point + (arm @ family.direction) * family.direction
        if family.kind in (FamilyKind.PENCIL, FamilyKind.BUNDLE):
            return family.point
        if family.kind in (FamilyKind.PLANE, FamilyKind.PARALLELS_IN_PLANE):
            return place - (arm @ family.normal) * family.normal
        if len(family.points):
            feet = _feet(family, place)
            return np.asarray(feet[int(np.argmin(np.linalg.norm(place - feet, axis=1)))])
        return place

    @cached_property
    def directions(self) -> FloatArray:
        """(n, 3) unit vectors that a designer uses already, by the names of their parts.

        Along flexures and hinges, across sheets, and across any two of the first of these.
        """
        parts, frames = self.result.parts, self.result.given.frames.frame
        made: list[FloatArray] = []
        for part in sorted(parts.all, key=lambda one: natural(one.name)):
            if part.kind is PartKind.BODY or len(made) >= _MOST_DIRECTIONS:
                continue
            axes = frames[part.elements[0]].T
            if len(part.ends) == 2:
                _add(np.diff(self._values[list(part.ends)], axis=0)[0], made)
            # Across a wire or about a hinge no direction is different from others.
            used = axes[1:] if part.kind is PartKind.SHEET else axes[:1]
            for axis in used if part.kind in (PartKind.SHEET, PartKind.HINGE) else ():
                _add(axis, made)
        for one, other in itertools.combinations(made[:_MOST_CROSSED], 2):
            _add(np.cross(one, other), made)
        return np.array(made).reshape(-1, 3)

    @cached_property
    def length(self) -> float:
        """How long a new wire is: as the flexures are, the median [m]."""
        sizes = [
            float(np.linalg.norm(np.diff(self._values[list(part.ends)], axis=0)))
            for part in self.result.parts.all
            if part.kind in (PartKind.WIRE, PartKind.SHEET, PartKind.BAR) and len(part.ends) == 2
        ]
        return float(np.median(sizes)) if sizes else _LENGTH * self.result.characteristic_length

    def ground(self, place: FloatArray, direction: FloatArray) -> FloatArray:
        """(3,) the other end of a wire from a place: on the side where there is most room [m]."""
        used = self.result.parts.data.arrays.node_kind <= 2
        nodes = self._values[used]
        mean = nodes.mean(axis=0)
        sides = []
        for sense in (1.0, -1.0):
            end = place + sense * self.length * direction
            room = float(np.min(np.linalg.norm(nodes - end, axis=1))) / self.length
            outward = sense * float((place - mean) @ direction) / self.length
            sides.append((round(outward, 6), round(room, 6), sense, end))
        # Outward, unless something is there already.
        sides.sort(key=lambda side: (side[1] > 1.0e-3, *side[:3]), reverse=True)
        return np.asarray(sides[0][3])


def _feet(family: Family, place: FloatArray) -> FloatArray:
    """(n, 3) the point of each line of a family that is nearest to a place."""
    arms = place - family.points
    along = np.sum(arms * family.directions, axis=1)[:, None]
    return np.asarray(family.points + along * family.directions)


def _add(axis: FloatArray, made: list[FloatArray]) -> None:
    """Keep a direction that is none of those."""
    size = float(np.linalg.norm(axis))
    if size > 0.0 and all(abs(axis @ other) < (1.0 - ROUNDING) * size for other in made):
        made.append(axis / size)
