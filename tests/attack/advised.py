# SPDX-License-Identifier: BSD-3-Clause
"""Whether advice is true: its steps applied, its statements pasted, its hardware built, its causes
kept while all else is random.

    offences(given) -> Iterator[Offence]

Causes are tried in 20 geometries each, other ones than the product tries. That these have what is
named is measured here, on lines and planes taken from places and vectors, and their rank is
decided by NumPy.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import combinations
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from pasting import analysis_pasted, steps_pasted

import flexact
from flexact import Model
from flexact.advice.advice import Advice, Step
from flexact.advice.causes.cause import CauseKind, Relation
from flexact.advice.causes.gradients import generic_rank
from flexact.advice.causes.trials import Trials
from flexact.advice.releases.words import outcome_as_given, released
from flexact.advice.repairs import Repair
from flexact.advice.step import Purpose
from flexact.analysis.result import Result
from flexact.core.elements import Class, Role, role_table
from flexact.model.parts.parts import Part, PartKind

Floats = NDArray[np.float64]

#: Geometries in which a cause is tried, and the first of them.
_GEOMETRIES, _FIRST = 20, 1000
#: Alternatives of a step that are applied.
_ALTERNATIVES = 2
#: How exactly a relation must be there, and what a zero singular value is.
_THERE, _ZERO = 1.0e-9, 1.0e-10


class Offence(NamedTuple):
    """Something that advice says and is not so."""

    kind: str
    """"false step", "false statement", "false hardware", "insufficient cause" or "failed"."""
    words: str


def offences(given: Model | str, done: Counter[str] | None = None) -> Iterator[Offence]:
    """All of them, of a model or of the text of a deck; how much was tried is added to `done`."""
    done = Counter() if done is None else done
    result = flexact.analyse(flexact.read_text(given) if isinstance(given, str) else given)
    advice = result.advice()
    try:
        advice.describe()
        advice.to_dict()
    except Exception as error:
        yield Offence("failed", repr(error))
        return
    yield from (Offence("failed", words) for words in advice.failed)
    for step in advice:
        yield from _of_step(step, done)
    for one in (*steps_pasted(given, advice), *analysis_pasted(given, result)):
        done["statements"] += 1
        if not one.is_right:
            words = f"{one.note}: {one.found}, not {one.said} ({one.words})"
            yield Offence("false statement", words)
    yield from of_causes(result, advice, done)


# Steps ---------------------------------------------------------------------------


def _of_step(step: Step, done: Counter[str]) -> Iterator[Offence]:
    said = step.after.under_constrained, step.after.over_constrained
    for choice in range(1, 2 + min(len(step.alternatives), _ALTERNATIVES)):
        done["steps"] += 1
        found = _counts(step.apply(choice))
        if found != said:
            yield Offence("false step", f"{step!r} choice {choice}: {found}")
    built = hardware(step)
    if built is not None and built.data.arrays.element_number.size:
        done["hardware"] += 1
        if _counts(built) != said:
            yield Offence("false hardware", f"{_counts(built)}, not {said}: {step.statement}")


def _counts(model: Model) -> tuple[int, int]:
    result = flexact.analyse(model)
    return result.under_constrained, result.over_constrained


# Hardware ------------------------------------------------------------------------

#: Words of what is released where a sheet is replaced by a folded one.
_FOLD = {"let  slide along its length", "cut  to a waist"}


def hardware(step: Step) -> Model | None:
    """The mechanism with the hardware that the words of a release name; None where they name none.

    Waists are notches about the normal of a sheet, at its end; what is taken out is not there; a
    folded sheet has its fold a little beside the end that is named.
    """
    change, is_repair = step.change, isinstance(step, Repair)
    if step.purpose not in (Purpose.RELEASE, Purpose.REPAIR) or change.places:
        return None
    releases = [each for each in change.deformations if each[2] is Class.DEPENDENT]
    if not releases or (change.coordinates and not is_repair):
        return None
    outcome = outcome_as_given(step.analysis)
    rest = [each for each in change.deformations if each[2] is not Class.DEPENDENT]
    made = replace(change, deformations=tuple(rest)).apply(outcome.given)
    by_element: dict[int, list[int]] = {}
    for element, number, _ in releases:
        by_element.setdefault(element, []).append(number)
    for element, numbers in by_element.items():
        part = outcome.parts.of_element(outcome.given.element_index[element])
        phrases = released(outcome, [(element, number) for number in numbers])
        words = {f"{phrase.before}{phrase.what}".strip() for phrase in phrases}
        if words == _FOLD and "folded sheet" in step.statement:
            words = {"fold"}
        if len(part.elements) > 1 or len(words) > 1 or not _build(made, step, part, numbers, words):
            return None
    return made


def _build(made: Model, step: Step, part: Part, numbers: Sequence[int], words: set[str]) -> bool:
    """Build one word of hardware; False where it is none that can be built."""
    word, element = words.pop(), part.number
    arrays, frames = step.analysis.given.arrays, step.analysis.given.frames
    index = part.elements[0]
    nodes = [int(k) for k in arrays.element_node[:, index]]
    number_of = [0, *arrays.node_number.tolist()]
    ends = [
        made.handle(number_of[nodes[k]], number_of[nodes[k + 1]])
        for k in ((0, 2) if nodes[2] and part.kind is not PartKind.HINGE else ())
    ]
    axes = frames.frame[index]
    planar = made.planar
    if word.startswith("take  out"):
        made.delete(element)
        return True
    if word == "replace  by a ball joint":
        made.delete(element)
        return True
    roles = [int(role_table()[arrays.element_kind[index], number - 1]) for number in numbers]
    if word == "replace  by a wire" and part.kind is PartKind.SHEET and not planar:
        made.delete(element)
        made.wire(*ends)
        return True
    if word == "fold" and part.kind is PartKind.SHEET and not planar:
        _, place = next(_BENDINGS[Role(role)] for role in roles if Role(role) in _BENDINGS)
        wide = int(step.analysis.parts.wide[index])
        first, last = (arrays.node_value[:3, nodes[k] - 1] for k in (2 * place, 2 - 2 * place))
        beside = 0.1 * (last - first) + 0.2 * np.linalg.norm(last - first) * axes[:, 3 - wide]
        made.delete(element)
        made.folded_sheet(
            ends[place], (first + beside).tolist(), ends[1 - place], axes[:, wide].tolist()
        )
        return True
    if word in ("cut  to a waist", "give  a notch") and len(roles) == 1:
        about, place = _BENDINGS[Role(roles[0])]
        kept = [k for k in range(1, 7) if arrays.deformation_class[k - 1, index] == 2]
        made.delete(element)
        notch = made.notch(ends[place], None if planar else axes[:, about].tolist())
        ends[place] = notch.q
        if planar:
            made.beam(*ends, release=kept)
        else:
            made.beam(*ends, y=axes[:, 1].tolist(), release=kept)
        return True
    return False


#: Of bendings the local axis about which they turn, and the end.
_BENDINGS = {
    Role.BENDING_XZ_P: (1, 0),
    Role.BENDING_XZ_Q: (1, 1),
    Role.BENDING_XY_P: (2, 0),
    Role.BENDING_XY_Q: (2, 1),
    Role.PLANAR_BENDING_P: (2, 0),
    Role.PLANAR_BENDING_Q: (2, 1),
}


# Causes --------------------------------------------------------------------------


def of_causes(result: Result, advice: Advice, done: Counter[str]) -> Iterator[Offence]:
    """Causes that are named and not sufficient."""
    whole = result.with_internal_declared or result
    told = (*advice.causes.motions, *advice.causes.self_stresses)
    seen: list[tuple[Relation, ...]] = []
    generic = advice.causes.generic_rank
    for cause in told:
        if cause.kind is CauseKind.SPECIAL and not cause.relations:
            done["without a named cause"] += 1
        if not cause.relations or any(_are_same(cause.relations, other) for other in seen):
            continue
        seen.append(cause.relations)
        done["causes"] += 1
        for one in cause.relations:
            done[f"{one.of} {one.kind}"] += 1
        assert generic is not None
        assert generic == generic_rank(whole)
        words = _insufficient(Trials(whole, generic), cause.relations, generic)
        if words:
            names = ", ".join(f"{one.of} {one.kind}" for one in cause.relations)
            yield Offence("insufficient cause", f"{names}: {words}")


def _are_same(one: Sequence[Relation], other: Sequence[Relation]) -> bool:
    return len(one) == len(other) and all(
        a.kind == b.kind and a.parts == b.parts for a, b in zip(one, other, strict=True)
    )


def _insufficient(trials: Trials, relations: Sequence[Relation], generic: int) -> str:
    """Of 20 random geometries that have relations how many have not what they cause."""
    tried, failed, seed = 0, 0, _FIRST
    while tried < _GEOMETRIES and seed < _FIRST + 10 * _GEOMETRIES:
        made = trials.having(relations, seed)
        seed += 1
        if made is None:
            continue
        tried += 1
        for one in relations:
            off = _off(trials, one, *made)
            if off > _THERE:
                return f"the geometry that was made has it not: off by {off:.1g}"
        failed += _rank(trials, *made) >= generic
    if tried < _GEOMETRIES:
        return f"only {tried} geometries could be made"
    return f"{failed} of {tried} geometries have it not" if failed else ""


def _rank(trials: Trials, places: Floats, vectors: Floats) -> int:
    """By the singular values of the Jacobian with scaled rows and columns."""
    data = trials.geometry.moved(places, vectors)
    result = flexact.analyse(Model.from_data(data), method="svd", prove=False)
    raw, whole = result.raw, result.assembly
    matrix = np.zeros((6 * data.arrays.element_number.size, 3 * data.arrays.node_number.size))
    np.add.at(matrix, (whole.row_of, whole.column_of), whole.value)
    (element, deformation), (node, axis) = raw.row_label - 1, raw.column_label - 1
    chosen = matrix[6 * element + deformation][:, 3 * node + axis]
    scaled = raw.row_scale[:, None] * chosen * raw.column_scale
    values = np.linalg.svd(scaled, compute_uv=False)
    return int(np.count_nonzero(values > _ZERO * values[0]))


def _off(trials: Trials, one: Relation, places: Floats, vectors: Floats) -> float:
    """By how much a geometry has a relation not, beside lengths of one and unit vectors."""
    length = trials.result.characteristic_length
    lines, planes = _figures(trials, one, places, vectors)
    middle = np.mean([point for point, _ in [*lines, *planes]], axis=0) if lines or planes else 0.0
    lines, planes = (
        [((point - middle) / length, way) for point, way in each] for each in (lines, planes)
    )
    if one.kind == "parallel":
        ways = [way for _, way in [*lines, *planes]]
        return max(float(np.linalg.norm(np.cross(ways[0], way))) for way in ways)
    if one.kind == "concurrent":
        rows = [np.eye(3) - np.outer(way, way) for _, way in lines]
        right = [row @ point for row, (point, _) in zip(rows, lines, strict=True)]
        point = np.linalg.lstsq(np.vstack(rows), np.concatenate(right), rcond=None)[0]
        return max(float(np.linalg.norm(np.cross(point - at, way))) for at, way in lines)
    if one.kind == "across" and not planes:
        return float(np.linalg.svd(np.array([way for _, way in lines]))[1][-1])
    if one.kind in ("complex", "regulus"):
        rows = np.array([np.concatenate((way, np.cross(at, way))) for at, way in lines])
        least = 3 if one.kind == "regulus" else 5
        return float(np.linalg.svd(rows)[1][least])
    if one.kind in ("along", "across axis"):
        ways = [way for _, way in [*lines, *planes]]
        if one.kind == "along":
            return max(float(np.linalg.norm(np.cross(way, one.direction))) for way in ways)
        return max(abs(float(way @ one.direction)) for way in ways)
    if one.kind == "one plane" and one.of in ("force", "axis"):
        points = np.array([at + s * way for at, way in lines for s in (0.0, 1.0)])
        return float(np.linalg.svd(points - points.mean(axis=0))[1][-1])
    return 0.0


def _figures(
    trials: Trials, one: Relation, places: Floats, vectors: Floats
) -> tuple[list[tuple[Floats, Floats]], list[tuple[Floats, Floats]]]:
    """Lines and planes of the parts of a relation."""
    whole = trials.result
    arrays = whole.data.arrays
    lines, planes, sheets = [], [], []
    for part in one.parts:
        index = int(np.searchsorted(whole.condensed.elements, part.elements[0]))
        slots = [int(k) - 1 for k in arrays.element_node[:, index]]
        if part.kind is PartKind.HINGE:
            place = _place_of_hinge(arrays, slots)
            lines.append((places[place], _unit(vectors[index])))
            continue
        p, q = places[slots[0]], places[slots[2]]
        if part.kind is PartKind.SHEET and not whole.given.planar:
            along, vector = _unit(q - p), vectors[index]
            wide = int(whole.parts.wide[part.elements[0]])
            normal = np.cross(along, vector) if wide == 1 else vector - (vector @ along) * along
            (planes if one.of == "sheet" else sheets).append((p, _unit(normal), slots))
        else:
            lines.append((p, _unit(q - p)))
    for (_, first, mine), (_, second, others) in combinations(sheets, 2):
        shared = set(mine[::2]) & set(others[::2])
        ends = [part for part in one.parts if part.kind is PartKind.SHEET]
        way = np.cross(first, second)
        is_fold = len(shared) == 1 and len(ends) == len(sheets) and _is_fold(arrays, *shared)
        if is_fold and np.linalg.norm(way) > _THERE:
            lines.append((places[shared.pop()], _unit(way)))
    return lines, [(point, normal) for point, normal, *_ in planes]


def _is_fold(arrays: object, node: int) -> bool:
    """Whether two elements and nothing else end at a node."""
    slots = arrays.element_node[[0, 2]] - 1  # type: ignore[attr-defined]
    return int(np.count_nonzero(slots == node)) == 2


def _place_of_hinge(arrays: object, slots: list[int]) -> int:
    """The position at which the orientation nodes of a hinge are, by what turns with them."""
    nodes = arrays.element_node.T - 1  # type: ignore[attr-defined]
    if arrays.node_kind[slots[0]] <= 2:  # type: ignore[attr-defined]
        return slots[0]
    own = {node for node in slots if node >= 0}
    ends = [
        {int(p) for p, o in ((row[0], row[1]), (row[2], row[3])) if o == node and p >= 0}
        for node in own
        for row in [row for row in nodes if node in row[[1, 3]]]
    ]
    found = Counter(p for each in ends for p in each)
    return max(found, key=lambda p: found[p])


def _unit(vector: Floats) -> Floats:
    made: Floats = vector / np.linalg.norm(vector)
    return made
