# SPDX-License-Identifier: BSD-3-Clause
"""Which motions go on, and which only begin: theorems first, then measurements."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...core.arrays import FloatArray
from ..spaces import Spaces
from .components import Component, components_of
from .dimension import MOST_MOTIONS, positions_near
from .extent import Branch, EvidenceKind, Extent, Extents, Kind, Reason
from .forms import Forms, forms_of, most_definite
from .held import Held
from .orders import fit_of, measured
from .walking import walk

#: More coordinates in a component are not followed; of more motions, stresses or entries of all
#: forms these are not made.
_MOST_COORDINATES = 300
_MOST_FORM_MOTIONS, _MOST_FORM_NUMBERS = 400, 4_000_000
#: A told motion has this part of itself in a component, or none.
_NO_PART = 1.0e-9


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
            Kind.FINITE, EvidenceKind.CERTIFIED, Reason.NO_SELF_STRESS, size=component.size
        )
        return _Decided(dict.fromkeys(told, plain), many)
    numbers = many * component.columns.size + len(component.stresses) * many**2
    if spaces.raw.stresses.vectors < spaces.over_constrained:
        return _open(told, component, Reason.NOT_GIVEN)
    if many > _MOST_FORM_MOTIONS or numbers > _MOST_FORM_NUMBERS:
        return _open(told, component, Reason.TOO_LARGE)
    return _Judge(spaces, component).decided(told)


def _open(told: dict[int, FloatArray], component: Component, reason: Reason) -> _Decided:
    extent = Extent(Kind.UNDECIDED, EvidenceKind.NONE, reason, size=component.size)
    return _Decided(dict.fromkeys(told, extent), None)


class _Judge:
    """A component whose motions feel a self-stress."""

    def __init__(self, spaces: Spaces, component: Component) -> None:
        self.size = component.size
        self.held = Held(spaces, component)
        zero, noise = spaces.gap.largest_zero or 0.0, spaces.raw.noise
        # What the rounding of the geometry lifts the zeros by, where that is more than arithmetic.
        self.floor = zero if zero > noise else 0.0
        self.forms: Forms = forms_of(self.held, 100.0 * self.floor)
        self.is_small = max(self.held.shape) <= _MOST_COORDINATES
        self.stresses, self.motions = self.forms.matrix.shape[:2]

    def decided(self, told: dict[int, FloatArray]) -> _Decided:
        """All told motions, and the dimension of what goes on."""
        most = most_definite(self.forms)
        if most.eigenvalues[0] > self.forms.error:
            extent = Extent(
                Kind.INFINITESIMAL,
                EvidenceKind.CERTIFIED,
                Reason.DEFINITE,
                size=self.size,
                curvature=float(most.eigenvalues[0]),
            )
            return _Decided(dict.fromkeys(told, extent), 0)
        units = {k: self._unit(vector) for k, vector in told.items()}
        motions = {k: self._of_motion(unit) for k, unit in units.items()}
        if self.motions == 1:
            (extent,) = motions.values()
            known = {Kind.FINITE: 1, Kind.INFINITESIMAL: 0}
            return _Decided(motions, known.get(extent.kind))
        return self._dimension(motions, units)

    def _unit(self, vector: FloatArray) -> FloatArray:
        """(N,) a told motion in the orthonormal basis."""
        made = self.held.motions.T @ self.held.of_told(vector)
        return np.asarray(made / np.linalg.norm(made))

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
        """Whether the forms, zero for a motion, change independently beside it."""
        values = np.linalg.svd(self.forms.along(unit), compute_uv=False)
        room = self.motions - 1 >= self.stresses
        return bool(room and values.min() > max(self.forms.error, _CLEAR_OF_ZERO))

    def _of_motion(self, unit: FloatArray) -> Extent:
        strain = float(np.linalg.norm(self.forms.of(unit)))
        if strain > self.forms.error:
            return self._extent(
                Kind.INFINITESIMAL, EvidenceKind.CERTIFIED, Reason.STRAINED, curvature=strain
            )
        followed = self._followed(unit) if self.is_small else None
        if followed is not None and followed.kind is Kind.FINITE:
            return followed
        if self.motions > 1 and (self._is_indefinite or self._is_regular(unit)):
            return self._extent(Kind.FINITE, EvidenceKind.CERTIFIED, Reason.INDEFINITE)
        return followed or self._extent(Kind.UNDECIDED, EvidenceKind.NONE, Reason.TOO_LARGE)

    def _followed(self, unit: FloatArray) -> Extent:
        motion = self.held.motions @ unit
        back, ahead = (walk(self.held, motion, sign, self.floor) for sign in (-1.0, 1.0))
        reach = (back.gone * self.size, ahead.gone * self.size)
        strain = max(back.strain, ahead.strain)
        if back.arrived and ahead.arrived:
            return self._extent(
                Kind.FINITE, EvidenceKind.FOLLOWED, Reason.PATH, reach=reach, residual=strain
            )
        found = [measured(self.held, motion, sign, self.floor) for sign in (-1.0, 1.0)]
        fits = [fit_of(each) for each in found]
        if back.arrived or ahead.arrived:
            reason = Reason.ONE_WAY
        elif fits[0] and fits[1] and round(fits[0].order) == round(fits[1].order):
            fit = max((each for each in fits if each is not None), key=lambda each: each.spread)
            return self._extent(
                Kind.INFINITESIMAL, EvidenceKind.FITTED, Reason.ORDER, reach=reach, fit=fit
            )
        elif any(each.aside for each in found):
            reason = Reason.ASIDE
        elif back.gone or ahead.gone:
            reason = Reason.STOPPED
        else:
            reason = Reason.NO_ORDER
        return self._extent(
            Kind.UNDECIDED, EvidenceKind.NONE, reason, reach=reach, residual=strain
        )

    def _extent(
        self,
        kind: Kind,
        evidence: EvidenceKind,
        reason: Reason,
        **numbers: object,
    ) -> Extent:
        return Extent(kind, evidence, reason, size=self.size, **numbers)  # type: ignore[arg-type]

    def _dimension(
        self, motions: dict[int, Extent], units: dict[int, FloatArray]
    ) -> _Decided:
        if self._is_indefinite and self.motions > 2:
            return _Decided(motions, self.motions - 1)
        if not self.is_small or self.motions > MOST_MOTIONS:
            return _Decided(motions, None)
        near = positions_near(self.held, list(units.values()))
        dimension = near.dimension
        if self._is_indefinite:
            dimension = self.motions - 1
        if any(each.kind is Kind.FINITE for each in motions.values()) and dimension == 0:
            dimension = None
        return _Decided(motions, dimension, self._branches(near.directions, units))

    def _branches(
        self, directions: tuple[tuple[int, FloatArray], ...], units: dict[int, FloatArray]
    ) -> tuple[Branch, ...]:
        return ()


_CLEAR_OF_ZERO = 1.0e-6
