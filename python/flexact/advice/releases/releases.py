# SPDX-License-Identifier: BSD-3-Clause
"""Which sets of deformations, released, or of coordinates, declared, leave nothing over.

Sets of releases leave no self-stress, sets of declarations no motion. Declarations that are driven
against a constraint, which makes a self-stress, are taken back.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import chain

import numpy as np

from ...analysis import ways
from ...analysis.calls import taken_back
from ...analysis.change import Change
from ...analysis.decomposition import row_duals
from ...analysis.mode_basis import row_key
from ...analysis.mode_words import joined
from ...analysis.naming import Pieces, coordinate_in_words, named_element
from ...analysis.places import deformation_words
from ...analysis.result import Result
from ...analysis.sparse_basis import groups_of
from ...analysis.ways import Coordinate, Deformation
from ...core.arrays import Basis, FloatArray
from ...core.elements import (
    STIFFNESS_NUMBER,
    Class,
    Dual,
    NodeKind,
    Role,
    coordinate_name,
    dual_table,
    role_table,
)
from ...model.parts.parts import PartKind
from ...util.errors import FlexactError
from ...util.groups import values_in
from ...util.records import Frozen, cached_property
from ..step import Purpose, Step, after, together, tried
from . import candidates as reaches
from .candidates import (
    BODY,
    LINK,
    Candidate,
    Places,
    Reach,
    as_it_stands,
    candidates,
    changed,
    complete,
    counted,
    decades,
    left_of,
    listed,
    tier_of_element,
    tier_of_node,
)
from .matroid import echelon_of
from .words import Release, coordinate_named, outcome_as_given

#: Stresses below this part of the largest of a self-stress are none.
_NOTHING = 1.0e-7
#: Numbers of ESTIFF, from 0, of the shear of a bending, by its role.
_SHEAR: dict[int, int] = {
    **dict.fromkeys((Role.BENDING_XZ_P, Role.BENDING_XZ_Q), 4),
    **dict.fromkeys((Role.BENDING_XY_P, Role.BENDING_XY_Q), 5),
    **dict.fromkeys((Role.PLANAR_BENDING_P, Role.PLANAR_BENDING_Q), 2),
}
_OTHER_END: dict[int, int] = {
    Role.BENDING_XZ_P: Role.BENDING_XZ_Q,
    Role.BENDING_XY_P: Role.BENDING_XY_Q,
    Role.PLANAR_BENDING_P: Role.PLANAR_BENDING_Q,
}
#: Costs below this are equal.
_LEAST = 1.0e-9

Cost = Callable[[Places], FloatArray]


def cost_of(result: Result, reach: Reach) -> Cost | None:
    """The cost of sets of rows, (sets, s) to (sets,), as a logarithm.

    None where the stiffness of what is stressed is not known; rigid bodies are so stiff that to
    release one of them costs more than all else.

    Args:
        result: The result whose rows they are.
        reach: The fixed rows over the self-stresses.
    """
    if result.given.properties is None:
        return None
    space = result.stress_space.toarray()
    moment = row_duals(result) != Dual.FORCE
    stresses = space * np.where(moment, result.characteristic_length, 1.0)[:, None]
    stressed = np.linalg.norm(space, axis=1) > _NOTHING
    flexibility = _flexibility(result, stressed)
    if flexibility is None:
        return None
    energy = stresses.T @ flexibility @ stresses
    if not np.linalg.eigvalsh(energy)[0] > 0.0:
        return None
    is_soft = np.diag(flexibility) > 0.0
    stiffness = np.zeros_like(flexibility)
    stiffness[np.ix_(is_soft, is_soft)] = np.linalg.inv(flexibility[np.ix_(is_soft, is_soft)])
    rows = reach.index

    def cost(sets: Places) -> FloatArray:
        chosen = rows[sets]
        inverse = np.linalg.inv(stresses[chosen])
        blocks = stiffness[chosen[:, :, None], chosen[:, None, :]]
        # Of G R^-1 K R^-T the trace.
        terms = np.sum((energy @ (inverse @ blocks)) * inverse, axis=(1, 2))
        made = np.log(np.maximum(terms - energy.shape[0], _LEAST))
        return np.where(np.all(is_soft[chosen], axis=1), made, np.inf)

    return cost


def _flexibility(result: Result, stressed: np.ndarray) -> FloatArray | None:
    """(m, m) flexibilities of rows of D(c), [m/N] and [rad/(N m)]; zero of rigid bodies.

    None where that of a stressed row of another part is not known.
    """
    properties = result.given.properties
    assert properties is not None
    # What is not given, such as the numbers of shear, is none.
    stiffness = np.nan_to_num(properties.stiffness)
    made = np.zeros((stressed.size, stressed.size))
    element, deformation = result.raw.row_label - 1
    kind = result.data.arrays.element_kind[element]
    roles, duals = role_table()[kind, deformation], dual_table()[kind, deformation]
    place = {
        (e, r): k for k, (e, r) in enumerate(zip(element.tolist(), roles.tolist(), strict=True))
    }
    for k in np.flatnonzero(stressed).tolist():
        e, role = int(element[k]), int(roles[k])
        given = int(result.condensed.elements[e])
        numbers = stiffness[given].tolist()
        value = numbers[STIFFNESS_NUMBER.get(role, int(deformation[k]))]
        if not value > 0.0:
            if result.parts.of_element(given).kind is PartKind.BODY:
                continue
            return None
        length = float(result.data.frames.length[e])
        if duals[k] != Dual.MOMENT_OVER_LENGTH and role != Role.ELONGATION:
            made[k, k] = 1.0 / value
        elif role not in _SHEAR:
            made[k, k] = length / value
        else:
            phi = 12.0 * max(numbers[_SHEAR[role]], 0.0) / length**2
            made[k, k] = length / (12.0 * value) * (4.0 + phi)
            other = place.get((e, _OTHER_END.get(role, -1)))
            if other is not None and stressed[other]:
                made[k, other] = made[other, k] = length / (12.0 * value) * (2.0 - phi)
    return made


#: Rows of D(c) of all analyses that are made.
_MOST_ROWS = 1_200_000
#: Of vectors that hang together so many are taken at once.
_AT_ONCE = 60
#: Blocks with smaller singular values are not used.
_LEAST_SINGULAR = 1.0e-4

#: The rows over some of the vectors of a result.
ReachOf = Callable[[Result, Basis | None], Reach]
#: (n,) how unwelcome each of its rows is; those of little are taken where they do.
Unwelcome = Callable[[Result, Reach], FloatArray]


def by_steps(
    stands: Result, purpose: Purpose, reach_of: ReachOf, unwelcome: Unwelcome
) -> Release | None:
    """One set that leaves nothing; None where it is not found in little time.

    Its condition is the largest of those of the steps.
    """
    now, changes, condition, rows = stands, list[Change](), 1.0, 0
    while before := left_of(purpose, now):
        space = now.stress_space if purpose is Purpose.RELEASE else now.motion_space
        # Of vectors that share places, of each such group the first.
        group = groups_of(space) if space.vectors else np.zeros(0, np.int64)
        order = np.argsort(group, kind="stable")
        ends = np.flatnonzero(np.diff(group[order])) + 1
        groups = [part[:_AT_ONCE] for part in np.split(order, ends) if part.size]
        done = sum(vectors.size for vectors in groups)
        # So many more are needed if each step goes as far as this one.
        if not done or rows + now.rows * before / done > _MOST_ROWS:
            return None
        rows += now.rows
        for vectors in groups:
            reach = reach_of(now, space.only(vectors.astype(np.int32)))
            block = _block(reach, unwelcome(now, reach))
            if block is None:
                return None
            condition = max(condition, 1.0 / block[1])
            changes += [reach.change(int(reach.index[row])) for row in block[0]]
        try:
            now = changed(stands, together(changes))
        except FlexactError:
            return None
        if left_of(purpose, now) >= before:
            return None
    return Release(stands, purpose, together(changes), condition, after(now))


def _block(reach: Reach, unwelcome: FloatArray) -> tuple[list[int], float] | None:
    """Rows with a well-conditioned block, and its smallest singular value."""
    for most in values_in(unwelcome).tolist():
        some = np.flatnonzero(unwelcome <= most)
        form = echelon_of(reach.rows[some], _LEAST_SINGULAR)
        if form is not None:
            return some[form.basis].tolist(), form.smallest
    return None


#: How many supports that may be freed are listed.
_MOST_SUPPORTS = 4


@dataclass(frozen=True)
class Sets(Frozen):
    """What may be released so that no self-stress is left, or declared so that no motion is.

    Attributes:
        size: How many self-stresses, or motions that nothing determines, the deck as it stands
            has, and so how many deformations must be released, or coordinates declared, at least.
        purpose: What the sets are to do.
        stands: The result of the deck as it stands, on which sets are counted; None where the
            model could not be analysed so.
        sets: The best of them, each tried; see `releases_of` and `declarations_of`.
        others: The same of fixed coordinates that may be freed, or of released deformations that
            may be held; not in `count`.
        is_too_large: Whether the model is so large that one set at most was looked for.
    """

    size: int
    purpose: Purpose
    stands: Result | None = None
    sets: tuple[Release, ...] = ()
    others: tuple[Release, ...] = ()
    is_too_large: bool = False

    @property
    def count(self) -> int | None:
        """How many sets of so many deformations of class fixed, or columns of D(c), leave none.

        That is, when they are released, or held; counted when it is asked for, in at most
        `COUNT_SECONDS`. None where they are too many to be counted. It is 0 where there is none;
        where nothing is to be done there is one, the empty set.
        """
        return self._counted[0]

    @property
    def doubtful(self) -> int | None:
        """How many sets more do so for the numbers as they are.

        Rounding may hide that they do not; None where they are too many.
        """
        return self._counted[1]

    @property
    def is_counted(self) -> bool:
        """Whether they have been counted."""
        return "_counted" in self.__dict__

    @cached_property
    def _counted(self) -> tuple[int | None, int | None]:
        if not self.size:
            return 1, 0
        if self.is_too_large or self.stands is None:
            return None, 0
        is_release = self.purpose is Purpose.RELEASE
        reach = (reaches.of_rows if is_release else reaches.of_columns)(self.stands)
        return counted(self.stands, reach, self.purpose)


def _as_it_stands(
    result: Result, purpose: Purpose, reach_of: ReachOf, unwelcome: Unwelcome
) -> Sets:
    """What is known before sets are listed.

    Of what is too large one set, and without anything to be done the empty one.
    """
    stands = as_it_stands(result)
    size = left_of(purpose, stands)
    space = stands.stress_space if purpose is Purpose.RELEASE else stands.motion_space
    if not size:
        nothing = Release(result, purpose, Change(), 1.0, after(result))
        return Sets(0, purpose, stands, (nothing,))
    if space.vectors < size or not reaches.fits(space):
        one = by_steps(stands, purpose, reach_of, unwelcome)
        sets = () if one is None else (replace(one, analysis=result),)
        return Sets(size, purpose, stands, sets, is_too_large=True)
    return Sets(size, purpose, stands)


def releases_of(result: Result, with_bodies: bool = False) -> Sets:
    """What may be released so that no self-stress is left, the best first.

    A set of s deformations works exactly when the s x s block of their rows in the left null
    space of D(c) is regular; where that is asked for, they are counted on the deck as it stands,
    where each beam of a divided sheet is one of its own. What is listed are deformations of whole
    sheets, at their ends, as a designer would release them. `condition` of a set is the inverse
    of the smallest singular value of its block in an orthonormal basis, with moments compared by
    the characteristic length: by so much the largest self-stress can exceed what the released
    deformations carry of it.

    Where the stiffness of what is stressed is known, sets come first that cost little of it
    (`flexact.advice.releases.releases`); else those of a condition within ten times the best,
    flexures before bodies, ties by names and places. Links inside of bodies are listed where
    nothing else does it, or `with_bodies`.

    Without a self-stress there is one set, the empty one.

    Of large models, of which not all null vectors fit, nothing is counted, and one set at most is
    given (`flexact.advice.releases.releases`).

    Raises:
        AnalysisError: the deck as it stands cannot be analysed.
    """
    known = _as_it_stands(result, Purpose.RELEASE, reaches.of_rows, _tiers)
    stands = known.stands
    if known.is_too_large or not known.size or stands is None:
        return known
    whole = stands
    if result.with_internal_declared is not None:
        whole = complete(result.with_internal_declared)
    elif result.condensed.chains:
        whole = complete(result)
    # Whole sheets are listed where they have as many self-stresses.
    sets: tuple[Release, ...] = ()
    for source in dict.fromkeys((whole, stands)):
        if not sets and source.over_constrained == known.size:
            sets = _listed(result, source, with_bodies)
    supports: tuple[Release, ...] = ()
    if whole.over_constrained == whole.stress_space.vectors and reaches.fits(whole.stress_space):
        reach = reaches.of_supports(whole)
        none = np.zeros(len(reach.index))
        found = candidates(reach, lambda sets, _: np.zeros((len(sets), 1)), none)
        supports = listed(result, reach, Purpose.RELEASE, found, _MOST_SUPPORTS)
    return replace(known, sets=sets, others=supports)


def _listed(result: Result, source: Result, with_bodies: bool) -> tuple[Release, ...]:
    reach = reaches.of_rows(source)
    tiers = _tiers(source, reach)
    cost = cost_of(source, reach)

    def ranking(sets: Places, condition: FloatArray) -> FloatArray:
        first = decades(condition) if cost is None else cost(sets)[:, None]
        return np.concatenate([first, np.sort(tiers[sets], axis=1)[:, ::-1]], axis=1)

    found = candidates(reach, ranking, tiers)
    chosen = found
    for tier in () if with_bodies else (BODY, LINK):
        without = [one for one in found if tiers[list(one.members)].max() < tier]
        if without:
            chosen = without
            break
    return listed(result, reach, Purpose.RELEASE, chosen)


def _tiers(source: Result, reach: Reach) -> FloatArray:
    """(n,) how late rows are released."""
    elements = source.condensed.elements[source.raw.row_label[0, reach.index] - 1]
    return np.array([tier_of_element(source, int(i)) for i in elements], float)


#: How many sets of released deformations that may be held are listed.
_MOST_HELD = 4
#: Motions of points of a body that agree to so many digits are one.
_DIGITS = 9


def declarations_of(result: Result) -> Sets:
    """What may be declared independent, or held, so that no motion is left, the best first.

    A set of m coordinates works exactly when the m x m block of their rows in the null space of
    D(c) is regular. They are counted on the deck as it stands, where each beam of a divided
    sheet is one of its own. `condition` of a set is the inverse of the smallest singular
    value of its block in an orthonormal basis, with rotations compared by the characteristic
    length. Sets of a condition within ten times the best come first, of these such of bodies,
    then of joints, then of what is inside of sheets; displacements before rotations. Without a
    motion there is one set, the empty one.

    Raises:
        AnalysisError: the deck as it stands cannot be analysed.
    """
    known = _as_it_stands(result, Purpose.DECLARE, reaches.of_columns, _tiers_of_nodes)
    stands = known.stands
    if known.is_too_large or not known.size or stands is None:
        return known
    whole = complete(result) if result.condensed.chains else stands
    sets: tuple[Release, ...] = ()
    for source in dict.fromkeys((whole, stands)):
        if not sets and source.under_constrained == known.size:
            sets = _listed_coordinates(result, source)
    holds: tuple[Release, ...] = ()
    if whole.under_constrained == known.size and result.with_internal_declared is None:
        reach = reaches.of_released(whole)
        found = candidates(reach, lambda _, worst: decades(worst), np.zeros(len(reach.index)))
        holds = listed(result, reach, Purpose.HOLD, found, _MOST_HELD)
    return replace(known, sets=sets, others=holds)


def _listed_coordinates(result: Result, source: Result) -> tuple[Release, ...]:
    reach, found = coordinate_sets(source)
    return listed(result, reach, Purpose.DECLARE, found)


def coordinate_sets(source: Result) -> tuple[Reach, list[Candidate]]:
    """Coordinates over the motions, and sets of them that leave no motion, the best first."""
    reach = _without_repeats(source, reaches.of_columns(source))
    nodes = source.raw.column_label[0, reach.index] - 1
    tiers = _tiers_of_nodes(source, reach)
    turns = (source.data.arrays.node_kind[nodes] > NodeKind.POSITION).astype(float)
    owner = [source.parts.body_at.get(int(n), -1) for n in source.condensed.nodes[nodes]]

    def points(members: Sequence[int]) -> int:
        """How many points of bodies are named besides one of each."""
        own = {(owner[i], int(nodes[i])) for i in members if owner[i] >= 0 and not turns[i]}
        return len(own) - len({body for body, _ in own})

    def ranking(sets: Places, condition: FloatArray) -> FloatArray:
        of_sets = np.sort(tiers[sets], axis=1)[:, ::-1]
        several = np.array([[points(each)] for each in sets.tolist()], float)
        turning = turns[sets].sum(axis=1)[:, None]
        return np.concatenate([decades(condition), of_sets, several, turning], axis=1)

    # Of sets that are called the same, and of those that differ in what is inside of sheets and
    # wires alone, the best.
    first: dict[tuple[object, ...], Candidate] = {}
    for one in candidates(reach, ranking, tiers):
        shown = one._replace(members=tuple(i for i in one.members if tiers[i] < LINK))
        first.setdefault(tuple(sorted(called_of(source, reach, shown))), one)
    return reach, list(first.values())


#: What a coordinate is called by: its body or point, whether it turns, and its axis.
Called = tuple[int, bool, int]


def called_of(source: Result, reach: Reach, one: Candidate) -> list[Called]:
    """What the coordinates of a set are called by."""
    labels = source.raw.column_label[:, reach.index[list(one.members)]].T - 1
    return [called_of_place(source, *label) for label in labels.tolist()]


def called_of_place(source: Result, node: int, axis: int) -> Called:
    """The same of a coordinate, by the index of its node as analysed and its axis."""
    given = int(source.condensed.nodes[node])
    turns = bool(source.data.arrays.node_kind[node] > NodeKind.POSITION)
    return source.parts.body_at.get(given, -1 - given), turns, axis


def _tiers_of_nodes(source: Result, reach: Reach) -> FloatArray:
    """(n,) how late coordinates are declared."""
    nodes = source.condensed.nodes[source.raw.column_label[0, reach.index] - 1]
    return np.array([tier_of_node(source, int(i)) for i in nodes], float)


def _without_repeats(source: Result, reach: Reach) -> Reach:
    """Of points of one body that move in the same way along an axis the first by name."""
    first: dict[tuple[int, int, bool, bytes], int] = {}
    for i in sorted(range(len(reach.index)), key=lambda i: reach.key(int(reach.index[i]))):
        node, axis = (source.raw.column_label[:, reach.index[i]] - 1).tolist()
        given = int(source.condensed.nodes[node])
        turns = bool(source.data.arrays.node_kind[node] > NodeKind.POSITION)
        body = source.parts.body_at.get(given, -1 - given)
        way = (np.round(reach.rows[i], _DIGITS) + 0.0).tobytes()
        first.setdefault((body, axis, turns, way), i)
    return reach.only(np.array(sorted(first.values()), np.int64))


# Declarations taken back --------------------------------------------------------------

#: Of more self-stresses no sets are looked for; so many steps there are at most.
_MOST_STRESSES, _MOST_TAKEN_BACK = 60, 4


@dataclass(frozen=True, eq=False, repr=False)
class TakenBack(Step):
    """Declarations that are taken back."""

    def words(self) -> Pieces:
        """Such as "take back the declaration of sheet 1: ... (RLSE 1 5 instead of DYNE 1 5)"."""
        told, note = self.in_short()
        return (*told, f" ({note})" if note else "")

    def in_short(self) -> tuple[Pieces, str]:
        """What is done, and the statements or calls that do it."""
        outcome, change = outcome_as_given(self.analysis), self.change
        what: list[Pieces] = [
            (
                named_element(outcome, element),
                f": {deformation_words(outcome, outcome.data.element_index[element], number)}",
            )
            for element, number, _ in change.deformations
        ]
        what += [coordinate_in_words(outcome, node, name) for node, name, _ in change.coordinates]
        if self.analysis.given.source is not None:
            notes = [f"RLSE {e} {k} instead of DYNE {e} {k}" for e, k, _ in change.deformations]
            for node, name, _ in change.coordinates:
                place = coordinate_named(self.analysis, node, name)
                notes.append(f"without DYNX {place.operands}")
        else:
            made = [taken_back(outcome, Deformation(e, k, "")) for e, k, _ in change.deformations]
            made += [
                taken_back(outcome, Coordinate(n, name, "")) for n, name, _ in change.coordinates
            ]
            notes = list(chain.from_iterable(made)) if all(made) else []
        is_one = len(what) == 1
        told = (
            f"take back the declaration{'' if is_one else 's'} of ",
            *joined(what),
            ", which is driven against a constraint" if is_one else "",
        )
        return told, ", ".join(notes)


def undeclarations_of(result: Result) -> tuple[TakenBack, ...]:
    """What declarations can be taken back so that no self-stress is left, each tried.

    A single one where there is one self-stress, deformations or coordinates; else a set of
    deformations. None where what is declared takes no part in the self-stresses.
    """
    count = result.over_constrained
    if not 0 < count <= _MOST_STRESSES or result.stress_space.vectors < count:
        return ()
    made = []
    for change, condition in _changes(result, count):
        try:
            then = tried(result, change)
        except FlexactError:
            continue
        if not then.over_constrained and then.under_constrained <= result.under_constrained:
            made.append(TakenBack(result, Purpose.UNDECLARE, change, condition, then))
    return tuple(made[:_MOST_TAKEN_BACK])


def _changes(result: Result, count: int) -> Iterator[tuple[Change, float]]:
    """What may be taken back, and its condition."""
    if count == 1:
        for label in ways.driven_deformations(result)[:_MOST_TAKEN_BACK]:
            yield _of_deformations(result, [label]), 1.0
        arrays = result.data.arrays
        for node, axis in ways.driven_coordinates(result)[:_MOST_TAKEN_BACK]:
            name = coordinate_name(int(arrays.node_kind[node]), axis)
            place = int(arrays.node_number[node]), name, Class.DEPENDENT
            yield Change(coordinates=(place,)), 1.0
        return
    rows = sorted(ways.driven_set(result), key=partial(row_key, result))
    if len(rows) == count:
        block = result.stress_space.toarray()[rows]
        labels = [(e - 1, number) for e, number in result.raw.row_label[:, rows].T.tolist()]
        condition = 1.0 / float(np.linalg.svd(block, compute_uv=False)[-1])
        yield _of_deformations(result, labels), condition


def _of_deformations(result: Result, labels: ways.Deformations) -> Change:
    numbers = result.given.arrays.element_number
    given = (result.condensed.in_given(*label) for label in labels)
    return Change(tuple((int(numbers[e]), number, Class.DEPENDENT) for e, number in given))
