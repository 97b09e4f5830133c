# SPDX-License-Identifier: BSD-3-Clause
"""Self-stresses in words: which parts press on each other, and what each of them carries."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ..core.arrays import FloatArray
from ..model.parts.parts import Joint, Part, PartKind
from ..util.units import Units
from .body_motions import BodyMotion
from .decomposition import Decomposition
from .limits import SAME_PLACE, TOLD
from .naming import (
    Named,
    Pieces,
    coordinate_in_words,
    deformation_in_words,
    named_element,
    named_node,
    row_of,
    together_in_words,
    unit_of,
    unit_of_coordinate,
)
from .part_stresses import QUANTITIES, Conflict, PartStress, Side, shared_resultants
from .places import (
    axis_words,
    direction_words,
    joint_node,
    listed,
    part_words,
    place_words,
    with_article,
)
from .result import Motion, Result, SelfStress
from .screws import Screw, ScrewKind, WrenchKind

#: How many names stand in a row.
_MOST_NAMES = 4


def motion_in_parts(motion: Motion, most: int) -> tuple[Pieces, ...]:
    """What moves in a motion, the largest first, one more than `most` where there are more.

    Bodies stand before joints; of a large model these are coordinates.
    """
    outcome = motion.analysis
    if not outcome.is_told_by_parts:
        return tuple(
            (
                *coordinate_in_words(outcome, node, name),
                f" {value:.4g} {unit_of_coordinate(name)}",
            )
            for node, name, value in motion.largest(most + 1)
        )
    if motion.is_internal and not motion.ends:
        return (("inside ", *parts_in_words(outcome, motion.internal_to)),)
    groups = largest_first(motion)
    alone = len(groups) == 1
    return tuple(group_in_words(outcome, group, alone) for group in groups[: most + 1])


def largest_first(motion: Motion) -> list[BodyMotion]:
    """Bodies that move as one, the largest motion first, then joints, or ends inside of parts."""
    length = motion.analysis.characteristic_length

    def key(one: BodyMotion) -> tuple[bool, float]:
        moved, turned = (float(np.linalg.norm(v)) for v in (one.screw.velocity, one.screw.rotation))
        return one.is_joint, -round(max(moved, length * turned), 9)

    return sorted(motion.bodies or motion.ends, key=key)


def internal_in_words(result: Result) -> str:
    """How many motions are internal to which parts; empty where there are none."""
    count = result.internal_motions
    if not count:
        return ""
    inside = {part: None for motion in result.motions for part in motion.internal_to}
    names = [part_words(part) for part in inside]
    if len(names) > _MOST_NAMES:
        names = [*names[: _MOST_NAMES - 1], f"{len(names) - _MOST_NAMES + 1} other parts"]
    which = "All" if count == result.under_constrained else f"{count} of these motions"
    if count == result.under_constrained == 1:
        which = "This motion"
    be = "is" if count == 1 else "are"
    return f"{which} {be} internal to {listed(names)}."


def group_in_words(outcome: Decomposition, group: BodyMotion, alone: bool) -> Pieces:
    """Bodies or joints and how they move; without sizes where nothing else does."""
    if group.bodies:
        names = parts_in_words(outcome, group.bodies)
    else:
        numbers = outcome.given.arrays.node_number
        nodes = [joint_node(outcome.parts, joint) for joint in group.joints]
        names = joined([(named_node(outcome, int(numbers[node])),) for node in nodes])
    many = len(group.bodies or group.joints) > 1
    together = " together" if many else ""
    return (*names, f" {_verb(outcome, group.screw, many, alone)}{together}")


def _verb(outcome: Decomposition, screw: Screw, many: bool, alone: bool) -> str:
    s = "" if many else "s"
    axis = direction_words(screw.direction)
    if screw.kind is ScrewKind.TRANSLATION:
        far = "" if alone else f" by {screw.units.said(screw.magnitude, 'm')}"
        return f"move{s} along {axis}{far}"
    about = f"about {line_words(outcome, screw.point, screw.direction)}"
    size = "" if alone else f" by {screw.magnitude:.4g} rad"
    if screw.kind is ScrewKind.ROTATION:
        return f"turn{s} {about}{size}"
    return f"turn{s} {about}{size} and move{s} along it by {screw.units.said(screw.pitch, 'm/rad')}"


def line_words(outcome: Decomposition, point: FloatArray, direction: FloatArray) -> str:
    """A line by a point of it [m] and its direction; along an axis any point of it serves.

    Across the plane of a planar model it is a point.
    """
    given, least = outcome.given, SAME_PLACE * outcome.characteristic_length
    return bare_line_words(point, direction, given.units, least, planar=given.planar)


def bare_line_words(
    point: FloatArray, direction: FloatArray, units: Units, least: float, *, planar: bool = False
) -> str:
    """The same without a mechanism; numbers below the least [m] are zero."""
    axis = direction_words(direction)
    unit = units.symbol("m")
    numbers = [
        "0" if abs(value) < least else f"{units.shown(value, 'm'):.4g}" for value in point.tolist()
    ]
    if planar and axis == "z":
        return f"the point ({', '.join(numbers[:2])}) {unit}"
    if axis in ("x", "y", "z"):
        numbers["xyz".index(axis)] = "*"
    shown = numbers[:2] if planar else numbers
    return f"the line through ({', '.join(shown)}) {unit} along {axis}"


def parts_in_words(outcome: Decomposition, parts: tuple[Part, ...]) -> Pieces:
    """Names of parts in a row."""
    numbers = outcome.given.arrays.element_number
    return joined([(named_element(outcome, int(numbers[part.elements[0]])),) for part in parts])


def joined(names: Sequence[Pieces]) -> Pieces:
    """Such as "a, b and c"; of many the first, and how many more."""
    rest = len(names) - _MOST_NAMES
    shown = names if rest <= 0 else [*names[: _MOST_NAMES - 1], (f"{rest + 1} more",)]
    made: list[Pieces] = []
    for place, name in enumerate(shown):
        before = "" if not place else " and " if place == len(shown) - 1 else ", "
        made.append((before, *name) if before else name)
    return tuple(piece for pieces in made for piece in pieces)


#: How many sides that fight are named, and how many that press.
_MODE_WORDS_MOST_NAMES, _MOST_SIDES = 3, 8
_MOMENTS = ("in-plane moment", "out-of-plane moment")


def stress_in_parts(stress: SelfStress, most: int) -> tuple[Pieces, ...]:
    """What parts carry, the largest first, one more than `most` where there are more.

    Of a large model these are deformations.
    """
    outcome = stress.analysis
    if not outcome.is_told_by_parts:
        return tuple(
            (
                *deformation_in_words(outcome, element, number),
                f" {value:.4g} {unit_of(outcome, element, number)}",
            )
            for element, number, value in stress.largest(most + 1)
        )
    numbers = outcome.given.arrays.element_number
    return tuple(
        (
            named_element(outcome, int(numbers[one.part.elements[0]])),
            f": {listed(list(_carried(outcome, stress, one))) or 'nothing'}",
        )
        for one in stress.parts[: most + 1]
    )


def conflict_in_words(stress: SelfStress) -> Pieces:
    """Which sides fight over what; nothing where that cannot be said in short."""
    outcome = stress.analysis
    if not outcome.is_told_by_parts:
        return ()
    rivalry, names = stress.rivalry, list[Pieces]()
    if rivalry is not None:
        on, over = rivalry.on, rivalry.over
        names = [side_in_words(outcome, side) for side in rivalry.sides]
    else:
        chosen = _clearest(stress)
        if chosen is None:
            return ()
        on, over = chosen.on, chosen.over
        parts = [load.part for load in chosen.loads if load.part is not None]
        names = [(named_element(outcome, part.number),) for part in parts]
    arrays = outcome.given.arrays
    if isinstance(on, Joint):
        where = named_node(outcome, int(arrays.node_number[joint_node(outcome.parts, on)]))
    else:
        where = named_element(outcome, int(arrays.element_number[on.elements[0]]))
    if over is None or len(names) > _MODE_WORDS_MOST_NAMES:
        if isinstance(on, Joint) and len(stress.parts) > _MODE_WORDS_MOST_NAMES:
            return ()
        single = [each[0] for each in names if isinstance(each[0], Named) and len(each) == 1]
        all_of = (
            together_in_words(single) if len(single) == len(names) else row_of(names, _MOST_SIDES)
        )
        return (*all_of, " press on ", where, ", in balance")
    both = "both" if len(names) == 2 else "all"
    # What of a body several sides hold: a rotation, or a displacement along a line.
    if over.kind is WrenchKind.COUPLE:
        held, against = f" against rotation about {axis_words(over.direction)}", "moments"
    else:
        held = f" along {line_words(outcome, over.point, over.direction)}"
        against = "forces" if over.kind is WrenchKind.FORCE else "forces and moments"
    return (*row_of(names), f" {both} hold ", where, f"{held}, with opposite {against}")


def side_in_words(outcome: Decomposition, side: Side) -> Pieces:
    """A side of a loop: its part, what its parts are called together, or its bodies and parts."""
    named = [named_element(outcome, part.number) for part in side.parts]
    if len(named) == 1:
        return (named[0],)
    heads = {part.name.partition(",")[0].strip() for part in (*side.parts, *side.through)}
    if len(heads) == 1:
        return (named[0]._replace(words=with_article(heads.pop())),)
    if not side.through:
        return together_in_words(named)
    bodies = together_in_words([named_element(outcome, body.number) for body in side.through])
    return ("the side of ", *bodies, " (", *together_in_words(named), ")")


def _clearest(stress: SelfStress) -> Conflict | None:
    """A body on which few parts fight over one thing, else one on which many press.

    A joint is told where nothing else can be and no more than three parts are stressed.
    """
    bodies = [conflict for conflict in stress.on_bodies if _is_between_parts(conflict)]
    few = [
        one for one in bodies if one.over is not None and len(one.loads) <= _MODE_WORDS_MOST_NAMES
    ]
    if few:
        return few[0]
    if bodies:
        return max(bodies, key=lambda one: len(one.loads))
    if len(stress.parts) > _MODE_WORDS_MOST_NAMES:
        return None
    joints = (one for one in stress.conflicts if _is_between_parts(one))
    return next((one for one in joints if one.over is not None), None)


def _is_between_parts(conflict: Conflict) -> bool:
    return all(load.part is not None for load in conflict.loads) and len(conflict.loads) > 1


def _carried(outcome: Decomposition, stress: SelfStress, one: PartStress) -> Iterator[str]:
    """Tension, shear, twist and bending of a part."""
    ends = [end.wrench for end in one.ends]
    rest = TOLD * max(wrench.size for wrench in ends)
    length, units = ends[-1].length, ends[-1].units
    if abs(one.normal_force) * length > rest:
        kind = "tension" if one.normal_force > 0.0 else "compression"
        yield f"{kind} {abs(one.normal_force):.4g} N"
    if abs(one.twist_moment) > rest:
        yield f"twist moment {units.said(one.twist_moment, 'N m')}"
    bending = list(_bending(outcome, stress, one, rest))
    yield from bending
    if not bending and float(np.linalg.norm(one.shear_force)) * length > rest:
        yield f"shear force {_vector(one.shear_force, 'N along')}"


def _bending(
    outcome: Decomposition, stress: SelfStress, one: PartStress, rest: float
) -> Iterator[str]:
    """Bending moments at the ends: of a sheet in its plane and out of it, else as vectors."""
    units = outcome.given.units
    if one.part.kind is PartKind.SHEET and len(one.ends) == 2:
        moments = moments_at_ends(stress, one).values()
        for quantity, at_ends in zip(_MOMENTS, moments, strict=True):
            if max(map(abs, at_ends)) > rest:
                first, last = at_ends
                told = [
                    f"{units.said(value, 'N m')} at "
                    f"{place_words(outcome.parts, end.position or 0, one.part)}"
                    for value, end in zip(at_ends, one.ends, strict=True)
                    if abs(value) > rest
                ]
                if abs(first - last) <= rest:
                    yield f"constant {quantity} {units.said(first, 'N m')}"
                else:
                    yield f"{quantity} {' and '.join(told)}"
        return
    # What a hinge passes on is the same on both sides.
    first_told = 0 if one.direction.any() else -1
    for end, moment in list(zip(one.ends, one.moments, strict=True))[first_told:]:
        if float(np.linalg.norm(moment)) > rest:
            where = ""
            if end.position is not None:
                where = f" at {place_words(outcome.parts, end.position, one.part)}"
            shown = _vector(units.shown(moment, "N m"), f"{units.symbol('N m')} about")
            yield f"moment {shown}{where}"


def moments_at_ends(stress: SelfStress, one: PartStress) -> dict[str, tuple[float, float]]:
    """Moments at both ends of a sheet, with the signs that pictures give them.

    In its plane and out of it, by `QUANTITIES` with underscores.
    """
    outcome = stress.analysis
    known = outcome.condensed.elements
    # Of a row of beams that is one beam that one.
    both_ends = [e for e in (one.part.elements[0], one.part.elements[-1]) if e in known]
    elements = np.searchsorted(known, np.array(both_ends))
    moments, forces = stress.analysed
    values = shared_resultants(outcome.data, elements, (moments + forces)[elements])
    nodes = outcome.data.arrays.element_node[[0, 2]][:, elements].T - 1
    positions = outcome.condensed.nodes[nodes]
    made = {}
    for quantity in _MOMENTS:
        at_nodes = values[:, QUANTITIES.index(quantity)]
        found = dict(zip(positions.ravel().tolist(), at_nodes.ravel().tolist(), strict=True))
        first, last = (found[end.position] for end in one.ends if end.position is not None)
        made[f"{quantity.replace('-', '_').replace(' ', '_')}s"] = (first, last)
    return made


def _vector(vector: FloatArray, unit: str) -> str:
    """Size and axis where it is along one, else the components; `unit` ends with a preposition."""
    size = float(np.abs(vector).max())
    parts = np.where(np.abs(vector) > TOLD * size, vector, 0.0) + 0.0
    if np.count_nonzero(parts) == 1:
        axis = int(np.argmax(np.abs(parts)))
        return f"{parts[axis]:.4g} {unit} {'xyz'[axis]}"
    return f"({', '.join(f'{part:.4g}' for part in parts)}) {unit.rpartition(' ')[0]}"
