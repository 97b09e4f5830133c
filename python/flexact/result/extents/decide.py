# SPDX-License-Identifier: BSD-3-Clause
"""Which motions go on, and which only begin: theorems first, then measurements."""

from __future__ import annotations

from functools import partial
from typing import Any, NamedTuple

import numpy as np

from ...core.arrays import FloatArray
from ..following.follow import Wishes, follow
from ..spaces import Spaces
from .components import Component, components_of
from .dimension import MOST_MOTIONS, is_without_strain, positions_near
from .extent import Branch, EvidenceKind, Extent, Extents, Kind, Reason
from .forms import cone_of, forms_of
from .felt import Felt
from .orders import fit_of, measured
from .reduced import Reduced
from .walking import GOAL, Walk, walk

#: More coordinates in a component are not followed; of more motions, stresses or entries of all
#: forms these are not made.
_MOST_COORDINATES = 300
_MOST_FORM_MOTIONS, _MOST_FORM_NUMBERS = 400, 4_000_000
_WISHES = Wishes(length=GOAL, through=True)
#: Singular values of the derivatives of the forms above this are not zero.
_CLEAR_OF_ZERO = 1.0e-6
#: Directions are one where the cosine between them is larger.
_SAME = 0.999


class _Decided(NamedTuple):
    """What was found of one component."""

    motions: dict[int, Extent]
    """By index of the told motion."""
    dimension: int | None
    branches: tuple[Branch, ...] = ()


def extents_of(spaces: Spaces) -> Extents:
    """Whether each motion of an analysis goes on or only begins.

    A component without self-stress: D(x) = 0 is a manifold there, and each motion is finite
    (implicit function theorem). One in which a combination of the second-order forms is
    definite: none is. Where the form of a self-stress is not zero for a motion, that motion
    is not the velocity of a path. What is left is followed, or its least strain is fitted.
    """
    told = spaces.motion_basis
    many = told.vectors
    decided = [_of_component(spaces, each) for each in components_of(spaces)]
    motions = tuple(
        _of_all([each.motions[k] for each in decided if k in each.motions]) for k in range(many)
    )
    dimensions = [each.dimension for each in decided]
    known = [each for each in dimensions if each is not None]
    is_whole = spaces.raw.motions.vectors == spaces.under_constrained
    whole = sum(known) if len(known) == len(dimensions) and is_whole else None
    return Extents(motions, whole, tuple(b for each in decided for b in each.branches))


def _of_all(parts: list[Extent]) -> Extent:
    """Of a motion of several components: it goes on where all parts do."""
    order = {Kind.INFINITESIMAL: 0, Kind.UNDECIDED: 1, Kind.FINITE: 2}
    by_proof = {EvidenceKind.FOLLOWED: 0, EvidenceKind.FITTED: 1, EvidenceKind.CERTIFIED: 2}
    return min(parts, key=lambda part: (order[part.kind], by_proof.get(part.evidence, 3)))


def _told_in(spaces: Spaces, component: Component) -> dict[int, FloatArray]:
    """(columns of the component,) the part of each told motion that is in it."""
    told, there = spaces.motion_basis, np.full(spaces.columns, -1)
    there[component.columns] = np.arange(component.columns.size)
    inside = there[told.place] >= 0
    made: dict[int, FloatArray] = {}
    for k in np.unique(told.of_entries()[inside]).tolist():
        place, value = told.entries(k)
        vector = np.zeros(component.columns.size)
        mine = there[place] >= 0
        vector[there[place[mine]]] = value[mine]
        made[k] = vector
    return made


def _of_component(spaces: Spaces, component: Component) -> _Decided:
    told = _told_in(spaces, component)
    many = len(component.motions)
    if not component.stresses:
        plain = Extent(
            Kind.FINITE, EvidenceKind.CERTIFIED, Reason.NO_SELF_STRESS
        )
        return _Decided(dict.fromkeys(told, plain), many)
    numbers = many * component.columns.size + len(component.stresses) * many**2
    if spaces.raw.stresses.vectors < spaces.over_constrained:
        return _open(told, component, Reason.NOT_GIVEN)
    if many > _MOST_FORM_MOTIONS or numbers > _MOST_FORM_NUMBERS:
        return _open(told, component, Reason.TOO_LARGE)
    return _Judge(spaces, component).decided(told)


def _open(told: dict[int, FloatArray], component: Component, reason: Reason) -> _Decided:
    extent = Extent(Kind.UNDECIDED, EvidenceKind.NONE, reason)
    return _Decided(dict.fromkeys(told, extent), None)


class _Judge:
    """A component whose motions feel a self-stress."""

    def __init__(self, spaces: Spaces, component: Component) -> None:
        self.felt = Felt(spaces, component)
        self.size = self.felt.held.size
        zero, noise = spaces.gap.largest_zero or 0.0, spaces.raw.noise
        # What the rounding of the geometry lifts the zeros by, where that is more than arithmetic.
        self.floor = zero if zero > noise else 0.0
        self.forms = forms_of(self.felt, 100.0 * self.floor)
        self.cone = cone_of(self.forms)
        self.stresses, self.motions = self.forms.matrix.shape[:2]
        rows, columns = self.felt.stresses.shape[0], self.felt.motions.shape[0]
        is_small = max(rows, columns) <= _MOST_COORDINATES
        self.reduced = Reduced(self.felt) if is_small else None

    def decided(self, told: dict[int, FloatArray]) -> _Decided:
        """All told motions, and the dimension of what goes on."""
        if not self.cone.basis.shape[1]:
            extent = self._extent(
                *(Kind.INFINITESIMAL, EvidenceKind.CERTIFIED, Reason.DEFINITE),
                curvature=self.cone.least,
            )
            return _Decided(dict.fromkeys(told, extent), 0)
        vectors = {k: self.felt.within(self.felt.of(vector)) for k, vector in told.items()}
        motions = {k: self._of_motion(vector) for k, vector in vectors.items()}
        if self.motions == 1:
            (extent,) = motions.values()
            known = {Kind.FINITE: 1, Kind.INFINITESIMAL: 0}
            return _Decided(motions, known.get(extent.kind))
        return _Decided(motions, *self._dimension(motions, vectors))

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

    def _is_regular(self, unit: FloatArray) -> bool:
        """Whether the forms, zero for a motion, change independently beside it.

        Then a path begins with it (implicit function theorem, applied to D(x) / t**2).
        """
        if self.motions <= self.stresses:
            return False
        values = np.linalg.svd(self.forms.along(unit), compute_uv=False)
        return bool(values.min() > max(self.forms.error, _CLEAR_OF_ZERO))

    def _of_motion(self, vector: FloatArray) -> Extent:
        unit = vector / np.linalg.norm(vector)
        strain = float(np.linalg.norm(self.forms.of(unit)))
        if strain > self.forms.error:
            return self._extent(
                *(Kind.INFINITESIMAL, EvidenceKind.CERTIFIED, Reason.STRAINED), curvature=strain
            )
        found = None if self.reduced is None else self._followed(self.reduced, unit)
        if found is not None and found.kind is Kind.FINITE:
            return found
        if self._is_indefinite or self._is_regular(unit):
            return self._extent(Kind.FINITE, EvidenceKind.CERTIFIED, Reason.REGULAR)
        return found or self._extent(Kind.UNDECIDED, EvidenceKind.NONE, Reason.TOO_LARGE)

    def _followed(self, reduced: Reduced, unit: FloatArray) -> Extent:
        motion = self.felt.motions @ unit
        rank = motion.size - self.motions
        paths = [follow(self.felt.held, sign * motion, rank, _WISHES) for sign in (-1.0, 1.0)]
        walks = [Walk(path.length, path.residual) for path in paths]
        if self.motions > 1 or self.floor:
            walks = [
                one if one.arrived else walk(reduced, unit, sign, self.floor)
                for one, sign in zip(walks, (-1.0, 1.0), strict=True)
            ]
        back, ahead = walks
        made = partial(
            self._extent,
            reach=(back.gone * self.size, ahead.gone * self.size),
            stops=(paths[0].stop.ending, paths[1].stop.ending),
            residual=max(back.strain, ahead.strain),
        )
        if back.arrived and ahead.arrived:
            return made(Kind.FINITE, EvidenceKind.FOLLOWED, Reason.PATH)
        if back.arrived or ahead.arrived:
            return made(Kind.UNDECIDED, EvidenceKind.NONE, Reason.ONE_WAY)
        found = [measured(reduced, unit, sign, self.floor) for sign in (-1.0, 1.0)]
        fits = [fit for each in found if (fit := fit_of(each)) is not None]
        if len(fits) == 2 and round(fits[0].order) == round(fits[1].order):
            fit = max(fits, key=lambda each: each.spread)
            return made(Kind.INFINITESIMAL, EvidenceKind.FITTED, Reason.ORDER, fit=fit)
        if any(each.aside for each in found):
            return made(Kind.UNDECIDED, EvidenceKind.NONE, Reason.ASIDE)
        stopped = min(back.gone, ahead.gone) > 0.0
        reason = Reason.STOPPED if stopped else Reason.NO_ORDER
        return made(Kind.UNDECIDED, EvidenceKind.NONE, reason)

    def _extent(
        self, kind: Kind, evidence: EvidenceKind, reason: Reason, **numbers: Any
    ) -> Extent:
        return Extent(kind, evidence, reason, size=self.size, **numbers)

    def _dimension(
        self, motions: dict[int, Extent], vectors: dict[int, FloatArray]
    ) -> tuple[int | None, tuple[Branch, ...]]:
        if self._is_indefinite and self.motions > 2:
            return self.motions - 1, ()
        if self.reduced is None:
            return None, ()
        basis = self.cone.basis
        if not self.cone.forms.matrix.size and is_without_strain(self.reduced, basis):
            return basis.shape[1], ()
        if self.motions > MOST_MOTIONS:
            return None, ()
        units = [each / np.linalg.norm(each) for each in vectors.values()]
        near = positions_near(self.reduced, basis, units)
        dimension = self.motions - 1 if self._is_indefinite else near.dimension
        if dimension == 0 and any(each.kind is Kind.FINITE for each in motions.values()):
            dimension = None
        if dimension != 1 or any(each.kind is Kind.FINITE for each in motions.values()):
            return dimension, ()
        return dimension, self._branches(near.lines, vectors)

    def _branches(
        self, lines: tuple[FloatArray, ...], vectors: dict[int, FloatArray]
    ) -> tuple[Branch, ...]:
        """Paths, each along with what the told motions have in its direction; each once."""
        told = np.stack(list(vectors.values()), axis=1)
        made: list[FloatArray] = []
        for line in lines:
            if any(abs(line @ other) > _SAME for other in made):
                continue
            made.append(line)
        found = []
        for line in made:
            shares = np.linalg.lstsq(told, line, rcond=None)[0]
            shares = shares / shares[np.argmax(np.abs(shares) > (1.0 - 1e-6) * np.abs(shares).max())]
            found.append(Branch(tuple(zip(vectors, shares.tolist(), strict=True))))
        return tuple(sorted(found, key=lambda each: [-abs(share) for _, share in each.shares]))
