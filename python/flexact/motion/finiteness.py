# SPDX-License-Identifier: BSD-3-Clause
"""Second-order forms of self-stresses on motions, and whether one of them is definite.

The form of a self-stress u is q(v) = d/dt u' D(x + t v) v: along any path that begins with v,
u' e begins with t**2 q(v) / 2, since u' D = 0. On a path of positions without strain it is zero.
If a combination of the forms is definite on all motions, none of them goes on: prestress
stability (Pellegrino and Calladine, Int. J. Solids Structures 22, 1986; Salerno, Int. J.
Numer. Methods Eng. 35, 1992; Connelly and Whiteley, SIAM J. Discrete Math. 9, 1996).
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import nullcontext
from typing import Any, NamedTuple

import numpy as np

from ..analysis.decomposition import column_weights
from ..analysis.limits import CLEAR_SLOPE, RIGID, ROUNDING, STRAINED, UNSTRAINED
from ..analysis.result import Motion, Result
from ..core.arrays import FloatArray
from ..util.groups import distinct, grouped
from ..util.loading import load
from .extent import Branch, EvidenceKind, Extent, Extents, Kind, Reason
from .paths import MOST_MOTIONS, by_path, is_without_strain, positions_near
from .reduced import Component, Felt, Reduced, components_of

#: Steps of the central differences, in parts of the size; the best of their table is taken.
_STEPS = 0.02 * 0.25 ** np.arange(7)
#: A value is told from zero where it is this multiple of its error, and this part of the terms
#: that it is the sum of.
_CLEARLY, _PART = 1.0e3, 1.0e-9
#: Steps of the search for a definite combination.
_MOST_STEPS, _MOST_STARTS = 200, 4


class Forms(NamedTuple):
    """The second-order forms of some self-stresses on some motions."""

    matrix: FloatArray
    """(s, N, N) symmetric."""
    error: float
    """Below this an entry may be error."""

    def of(self, motion: FloatArray) -> FloatArray:
        """(s,) of a motion, (N,)."""
        return np.asarray(np.einsum("ijk,j,k->i", self.matrix, motion, motion))

    def along(self, motion: FloatArray) -> FloatArray:
        """(s, N) derivatives at a motion, halved."""
        return np.asarray(self.matrix @ motion)


def forms_of(felt: Felt, stresses: FloatArray, explained: float) -> Forms:
    """The forms of some self-stresses on all motions.

    Args:
        felt: The component.
        stresses: (m, s) the self-stresses.
        explained: What part of a form the rounding of the geometry may make.
    """
    rates, errors = zip(*(_rate(felt, stresses, motion) for motion in felt.motions.T), strict=True)
    matrix = np.stack(rates, axis=1)
    skew = np.abs(matrix - np.swapaxes(matrix, 1, 2)).max(initial=0.0)
    size = np.abs(matrix).max(initial=0.0)
    error = _CLEARLY * max(*errors, float(skew)) + (_PART + explained) * max(float(size), 1.0)
    return Forms((matrix + np.swapaxes(matrix, 1, 2)) / 2.0, error)


def _rate(felt: Felt, stresses: FloatArray, motion: FloatArray) -> tuple[FloatArray, float]:
    """(s, N) d/dt u' D(x + t v) v by differences, and their error (Ridders, Richardson)."""
    best, error = None, np.inf
    before: list[FloatArray] = []
    for step in _STEPS.tolist():
        # u' D v after a change, whose derivative along itself does not turn with it.
        ahead, behind = (
            felt.held.pressed(felt.held.moved(felt.held.reference, change), stresses).T
            @ felt.motions
            for change in (step * motion, -step * motion)
        )
        now = [(ahead - behind) / (2.0 * step)]
        if not np.all(np.isfinite(now[0])):
            # An element has left its range.
            before = []
            continue
        for k, other in enumerate(before):
            factor = 16.0 ** (k + 1)
            now.append((factor * now[-1] - other) / (factor - 1.0))
            off = max(float(np.abs(now[-1] - now[-2]).max()), float(np.abs(now[-1] - other).max()))
            if off < error:
                best, error = now[-1], off
        if best is None:
            best = now[0]
        before = now
    if best is None:
        return np.zeros((stresses.shape[1], felt.many)), np.inf
    return np.asarray(best), error


#: The eigenvalues of a combination of forms, (N,) ascending, and its eigenvectors, (N, N).
Combination = tuple[FloatArray, FloatArray]


def most_definite(forms: Forms) -> Combination:
    """The combination whose smallest eigenvalue is the largest that was found.

    The smallest eigenvalue is a concave function of the shares, which steps along its
    supergradients climb.
    """
    many = forms.matrix.shape[0]
    starts = [*np.eye(many)[:_MOST_STARTS], *-np.eye(many)[:_MOST_STARTS]]
    traces = np.trace(forms.matrix, axis1=1, axis2=2)
    size = float(np.linalg.norm(traces))
    if size > forms.error:
        starts.insert(0, traces / size)
    best: Combination | None = None
    for start in starts:
        found = _climbed(forms, start)
        if best is None or found[0][0] > best[0][0]:
            best = found
        if best[0][0] > forms.error:
            break
    assert best is not None
    return best


def cone_of(forms: Forms) -> tuple[FloatArray, Forms, float | None]:
    """Take away what semidefinite combinations of the forms exclude, until none does.

    Where a combination is not negative, its value is zero on a path, so that the velocity is in
    the null space of the combination; there the forms are looked at again.

    Returns:
        Of what is left of the motions an orthonormal basis, (N, k), and as many forms as are
        independent on it; and the smallest eigenvalue that took motions away, None where none
        did.
    """
    basis, now = np.eye(forms.matrix.shape[1]), _independent(forms)
    least: float | None = None
    while now.matrix.size:
        (values, vectors), error = most_definite(now), forms.error
        if values[0] < -error or not values[-1] > error:
            break
        zero = values <= error
        least = min(float(values[~zero].min()), np.inf if least is None else least)
        basis = basis @ vectors[:, zero]
        within = np.einsum("ja,ijk,kb->iab", basis, forms.matrix, basis)
        now = _independent(Forms(within, error))
    return basis, now, least


def _independent(forms: Forms) -> Forms:
    """As many forms as are independent, the largest first; none that is zero."""
    many, size = forms.matrix.shape[:2]
    left, values, _ = np.linalg.svd(forms.matrix.reshape(many, -1), full_matrices=False)
    chosen = left[:, values > forms.error]
    made = np.tensordot(chosen.T, forms.matrix, 1).reshape(chosen.shape[1], size, size)
    return Forms(made, forms.error)


def _climbed(forms: Forms, shares: FloatArray) -> Combination:
    def combined() -> Combination:
        values, vectors = np.linalg.eigh(np.tensordot(shares, forms.matrix, 1))
        return values, np.asarray(vectors)

    best = now = combined()
    for k in range(_MOST_STEPS if shares.size > 1 else 0):
        values, vectors = now
        # The mean over the lowest eigenvectors, weighted by how low they are.
        spread = np.abs(values).max() / (4.0 + k / 4.0)
        weight = np.exp(-(values - values[0]) / spread)
        slope = np.einsum(
            "ijk,jl,kl,l->i",
            *(forms.matrix, vectors, vectors, weight / weight.sum()),
            optimize=True,
        )
        size = float(np.linalg.norm(slope))
        if not size > 0.0:
            break
        shares = shares + slope / size / (1.0 + k / 4.0)
        length = float(np.linalg.norm(shares))
        if not length > 0.0:
            break
        shares = shares / length
        now = combined()
        if now[0][0] > best[0][0]:
            best = now
        if best[0][0] > forms.error:
            break
    return best


#: Directions are one where the cosine between them is larger.
_SAME = 0.999


def branches_of(lines: Sequence[FloatArray], vectors: dict[int, FloatArray]) -> tuple[Branch, ...]:
    """The paths in some directions, each once; those with little of the first motions first.

    Args:
        lines: (N,) directions of norm one.
        vectors: (N,) the told motions by index.
    """
    told = np.stack(list(vectors.values()), axis=1)
    found = []
    for line in distinct(lines, lambda line, other: bool(abs(line @ other) > _SAME)):
        shares = np.asarray(np.linalg.lstsq(told, line, rcond=None)[0], np.float64)
        # The largest share is 1, of equal ones the first.
        size = np.abs(shares)
        largest = shares[np.argmax(size > (1.0 - 1.0e-5) * size.max())]
        found.append(tuple(zip(vectors, (shares / largest).tolist(), strict=True)))
    return tuple(sorted(found, key=lambda each: [share for _, share in each]))


#: More motions are not followed; forms that cost more than this work are not made.
_MOST_FOLLOWED, _MOST_WORK = 40, 400_000.0


#: What was found of one component: extents by the index of the told motion, the dimension, and
#: branches.
Decided = tuple[dict[int, Extent], int | None, tuple[Branch, ...]]


class Judge:
    """A component whose motions feel a self-stress."""

    def __init__(self, spaces: Result, component: Component) -> None:
        """Make the model of the component."""
        self.spaces, self.felt = spaces, Felt(spaces, component)
        self.size, self._asked = self.felt.held.size, 0
        self.motions, self.stresses = self.felt.many, component.stresses

    def decided(self, told: dict[int, FloatArray]) -> Decided:
        """All told motions, and the dimension of what goes on."""
        motions: dict[int, Extent] = {}
        vectors: dict[int, FloatArray] = {}
        for k, vector in told.items():
            within = self.felt.within(self.felt.of(vector))
            if np.linalg.norm(within) <= RIGID * self.felt.norm(vector):
                motions[k] = self._extent(Kind.FINITE, EvidenceKind.CERTIFIED, "rigid")
            else:
                vectors[k] = within
        rigid = self.felt.rigid
        if not self.motions:
            return motions, rigid, ()
        found, dimension, branches = self._of_others(vectors)
        whole = None if dimension is None else dimension + rigid
        return motions | found, whole, branches

    def _of_others(self, vectors: dict[int, FloatArray]) -> Decided:
        """Motions that are not those of one rigid body."""
        work = self.motions * self.felt.held.rows.size * (2.0 + 0.15 * self.stresses)
        stresses = self.felt.stresses if work <= _MOST_WORK else None
        if stresses is None:
            extent = self._extent(Kind.UNDECIDED, EvidenceKind.NONE, "too large")
            return dict.fromkeys(vectors, extent), None, ()
        zero, noise = self.spaces.gap.largest_zero or 0.0, self.spaces.raw.noise
        # What the rounding of the geometry lifts the zeros by, where that is more than arithmetic.
        self.floor = zero if zero > noise else 0.0
        self.forms = forms_of(self.felt, stresses, 100.0 * self.floor)
        self.basis, self.on_basis, least = cone_of(self.forms)
        self.reduced = Reduced(self.felt, stresses) if self.felt.is_small else None
        if not self.basis.shape[1]:
            extent = self._extent(
                *(Kind.INFINITESIMAL, EvidenceKind.CERTIFIED, "definite"),
                curvature=least,
            )
            return dict.fromkeys(vectors, extent), 0, ()
        motions = {k: self._of_motion(vector) for k, vector in vectors.items()}
        motions |= self._inside(motions, vectors)
        if self.motions == 1:
            kinds = {each.kind for each in motions.values()}
            known = {Kind.FINITE: 1, Kind.INFINITESIMAL: 0}
            return motions, known.get(kinds.pop()) if len(kinds) == 1 else None, ()
        return motions, *self._dimension(motions, vectors)

    @property
    def _is_indefinite(self) -> bool:
        """Whether there is one form alone, with both signs.

        Then D(x) = 0 is of one dimension less than the motions, and each motion for which the
        form is zero begins a path: beside it the form takes both signs.
        """
        if self.stresses != 1:
            return False
        values = np.linalg.eigvalsh(self.forms.matrix[0])
        return bool(values[0] < -self.forms.error and values[-1] > self.forms.error)

    def _of_motion(self, vector: FloatArray) -> Extent:
        unit = vector / np.linalg.norm(vector)
        strain = float(np.linalg.norm(self.forms.of(unit)))
        size = float(np.abs(self.forms.matrix).max(initial=0.0))
        if strain > max(self.forms.error, STRAINED * size):
            return self._extent(
                *(Kind.INFINITESIMAL, EvidenceKind.CERTIFIED, "strained"), curvature=strain
            )
        begins = strain <= max(self.forms.error, UNSTRAINED * size)
        if begins and not self._is_indefinite:
            # Where the forms, zero for it, change independently beside it a path begins with it
            # (implicit function theorem, applied to D(x) / t**2).
            slopes = np.linalg.svd(self.forms.along(unit), compute_uv=False)
            is_regular = bool(slopes.min() > max(self.forms.error, CLEAR_SLOPE))
            begins = self.motions > self.stresses and is_regular
        if begins:
            return self._extent(Kind.FINITE, EvidenceKind.CERTIFIED, "regular")
        self._asked += 1
        if self.reduced is None or self._asked > _MOST_FOLLOWED:
            return self._extent(Kind.UNDECIDED, EvidenceKind.NONE, "too large")
        return by_path(self.reduced, unit, self.floor)

    def _inside(
        self, motions: dict[int, Extent], vectors: dict[int, FloatArray]
    ) -> dict[int, Extent]:
        """Strained motions inside of sheets and wires that go on with others inside of these.

        How they are told apart is arbitrary: where the form has both signs on those inside of
        the same parts, as many can be chosen that all go on.
        """
        strained = [k for k, each in motions.items() if each.reason == "strained"]
        if not (strained and self._is_indefinite and self.spaces.is_told_by_parts):
            return {}
        inside = [motion for k in vectors if (motion := Motion(k, self.spaces)).is_internal]
        groups = grouped((motion.internal_to, motion.index) for motion in inside)
        made: dict[int, Extent] = {}
        extent = self._extent(Kind.FINITE, EvidenceKind.CERTIFIED, "among others")
        for group in groups.values():
            basis = np.linalg.qr(np.stack([vectors[k] for k in group], axis=1))[0]
            values = np.linalg.eigvalsh(basis.T @ self.forms.matrix[0] @ basis)
            if values[0] < -self.forms.error and values[-1] > self.forms.error:
                made |= {k: extent for k in group if k in strained}
        return made

    def _extent(self, kind: Kind, evidence: EvidenceKind, reason: Reason, **numbers: Any) -> Extent:
        return Extent(kind, evidence, reason, size=self.size, **numbers)

    def _dimension(
        self, motions: dict[int, Extent], vectors: dict[int, FloatArray]
    ) -> tuple[int | None, tuple[Branch, ...]]:
        if self._is_indefinite:
            lines = []
            if self.motions == 2:
                # Both directions in which an indefinite form of two motions is zero.
                values, axes = np.linalg.eigh(self.forms.matrix[0])
                one, other = np.sqrt(np.abs(values[::-1])).tolist()
                lines = [axes @ np.array([one, sign * other]) for sign in (1.0, -1.0)]
            units = [line / np.linalg.norm(line) for line in lines]
            return self.motions - 1, branches_of(units, vectors)
        if self.reduced is None:
            return None, ()
        basis = self.basis
        if not self.on_basis.matrix.size and is_without_strain(self.reduced, basis):
            return basis.shape[1], ()
        if self.motions > MOST_MOTIONS:
            return None, ()
        units = [each / np.linalg.norm(each) for each in vectors.values()]
        dimension, found = positions_near(self.reduced, basis, units)
        if any(each.kind is Kind.FINITE for each in motions.values()):
            return dimension or None, ()
        return dimension, branches_of(found, vectors) if dimension == 1 else ()


#: More components than this are not looked at, nor more motions in one, nor entries of these.
_MOST_COMPONENTS, _MOST_MOTIONS, _MOST_ENTRIES = 60, 400, 4_000_000
_FREE = Extent(Kind.FINITE, EvidenceKind.CERTIFIED, "no self-stress")


def extents_of(spaces: Result) -> Extents:
    """Whether each motion of an analysis goes on or only begins.

    A component without self-stress: D(x) = 0 is a manifold there, and each motion is finite
    (implicit function theorem). One in which a combination of the second-order forms is
    definite: none is. Where the form of a self-stress is not zero for a motion, that motion
    is not the velocity of a path. What is left is followed, or its least strain is fitted.
    """
    many = spaces.motion_basis.vectors
    if spaces.raw.motions.vectors < spaces.under_constrained:
        unknown = Extent(Kind.UNDECIDED, EvidenceKind.NONE, "not given")
        if spaces.over_constrained:
            return Extents((unknown,) * many, None)
        return Extents((_FREE,) * many, spaces.under_constrained)
    felt, free = components_of(spaces)
    told = _told_in(spaces, felt)
    # Matrices are so small that more threads would slow them down.
    with load("threadpoolctl").threadpool_limits(1) if felt else nullcontext():
        decided: list[Decided] = []
        for k, (component, mine) in enumerate(zip(felt, told, strict=True)):
            size = len(component.motions)
            entries = size * component.columns.size
            if k >= _MOST_COMPONENTS or size > _MOST_MOTIONS or entries > _MOST_ENTRIES:
                extent = Extent(Kind.UNDECIDED, EvidenceKind.NONE, "too large")
                decided.append((dict.fromkeys(mine, extent), None, ()))
            else:
                decided.append(Judge(spaces, component).decided(mine))
    parts = grouped(each for motions, _, _ in decided for each in motions.items())
    known = [dimension for _, dimension, _ in decided if dimension is not None]
    whole = sum(known) + free if len(known) == len(decided) else None
    branches = tuple(branch for _, _, every in decided for branch in every)
    # Of a motion of several components: it goes on where all parts do.
    every = (min(parts.get(k, [_FREE]), key=_rank) for k in range(many))
    return Extents(tuple(every), whole, branches)


def _rank(extent: Extent) -> tuple[int, int]:
    """By what the part is found that decides."""
    order = {Kind.INFINITESIMAL: 0, Kind.UNDECIDED: 1, Kind.FINITE: 2}
    by_proof = {EvidenceKind.FOLLOWED: 0, EvidenceKind.FITTED: 1, EvidenceKind.CERTIFIED: 2}
    return order[extent.kind], by_proof.get(extent.evidence, 3)


def _told_in(spaces: Result, components: tuple[Component, ...]) -> list[dict[int, FloatArray]]:
    """For each component (columns of it,) of each told motion that has a part in it."""
    told, made = spaces.motion_basis, []
    owner, there = np.full(spaces.columns, -1), np.zeros(spaces.columns, np.int64)
    for index, component in enumerate(components):
        owner[component.columns] = index
        there[component.columns] = np.arange(component.columns.size)
        made.append(dict[int, FloatArray]())
    vector, weighted = told.of_entries(), np.abs(told.value * column_weights(spaces)[told.place])
    largest = np.zeros(told.vectors)
    np.maximum.at(largest, vector, weighted)
    seen = weighted > ROUNDING * largest[vector]
    pairs = np.unique(np.stack([owner[told.place], vector])[:, seen], axis=1)
    for index, k in pairs.T.tolist():
        if index < 0:
            continue
        place, value = told.entries(k)
        mine = owner[place] == index
        made[index][k] = np.zeros(components[index].columns.size)
        made[index][k][there[place[mine]]] = value[mine]
    return made
