# SPDX-License-Identifier: BSD-3-Clause
"""Which motions of a component that feel self-stresses go on: theorems, then measurements."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ..analysis.modes import Motion
from ..analysis.result_spaces import Spaces
from ..core.arrays import FloatArray
from ..model.parts.parts import Part
from .by_path import by_path
from .components import Component
from .extent import Branch, EvidenceKind, Extent, Kind, Reason
from .extents_branches import branches_of
from .extents_reduced import Reduced
from .finiteness import cone_of, forms_of
from .paths import MOST_MOTIONS, is_without_strain, positions_near
from .reduced import Felt

#: More motions are not followed; forms that cost more than this work are not made.
_MOST_FOLLOWED, _MOST_WORK = 40, 400_000.0
#: Singular values of the derivatives of the forms above this are not zero.
_CLEAR_OF_ZERO = 1.0e-6
#: A motion is rigid where this part of it is not.
_RIGID = 1.0e-7
#: Beside the largest entry of the forms: values from the first on are not zero, and up to the
#: second they are, as told motions are found by elimination.
_STRAINED, _UNSTRAINED = 1.0e-6, 1.0e-7


class Decided(NamedTuple):
    """What was found of one component."""

    motions: dict[int, Extent]
    """By index of the told motion."""
    dimension: int | None
    branches: tuple[Branch, ...] = ()


class Judge:
    """A component whose motions feel a self-stress."""

    def __init__(self, spaces: Spaces, component: Component) -> None:
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
            if np.linalg.norm(within) <= _RIGID * self.felt.norm(vector):
                motions[k] = self._extent(Kind.FINITE, EvidenceKind.CERTIFIED, Reason.RIGID)
            else:
                vectors[k] = within
        rigid = self.felt.rigid
        if not self.motions:
            return Decided(motions, rigid)
        found, dimension, branches = self._of_others(vectors)
        whole = None if dimension is None else dimension + rigid
        return Decided(motions | found, whole, branches)

    def _of_others(self, vectors: dict[int, FloatArray]) -> Decided:
        """Motions that are not those of one rigid body."""
        work = self.motions * self.felt.held.rows.size * (2.0 + 0.15 * self.stresses)
        stresses = self.felt.stresses if work <= _MOST_WORK else None
        if stresses is None:
            extent = self._extent(Kind.UNDECIDED, EvidenceKind.NONE, Reason.TOO_LARGE)
            return Decided(dict.fromkeys(vectors, extent), None)
        zero, noise = self.spaces.gap.largest_zero or 0.0, self.spaces.raw.noise
        # What the rounding of the geometry lifts the zeros by, where that is more than arithmetic.
        self.floor = zero if zero > noise else 0.0
        self.forms = forms_of(self.felt, stresses, 100.0 * self.floor)
        self.cone = cone_of(self.forms)
        self.reduced = Reduced(self.felt, stresses) if self.felt.is_small else None
        if not self.cone.basis.shape[1]:
            extent = self._extent(
                *(Kind.INFINITESIMAL, EvidenceKind.CERTIFIED, Reason.DEFINITE),
                curvature=self.cone.least,
            )
            return Decided(dict.fromkeys(vectors, extent), 0)
        motions = {k: self._of_motion(vector) for k, vector in vectors.items()}
        motions |= self._inside(motions, vectors)
        if self.motions == 1:
            kinds = {each.kind for each in motions.values()}
            known = {Kind.FINITE: 1, Kind.INFINITESIMAL: 0}
            return Decided(motions, known.get(kinds.pop()) if len(kinds) == 1 else None)
        return Decided(motions, *self._dimension(motions, vectors))

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
        size = float(np.abs(self.forms.matrix).max(initial=0.0))
        if strain > max(self.forms.error, _STRAINED * size):
            return self._extent(
                *(Kind.INFINITESIMAL, EvidenceKind.CERTIFIED, Reason.STRAINED), curvature=strain
            )
        is_zero = strain <= max(self.forms.error, _UNSTRAINED * size)
        if is_zero and (self._is_indefinite or self._is_regular(unit)):
            return self._extent(Kind.FINITE, EvidenceKind.CERTIFIED, Reason.REGULAR)
        self._asked += 1
        if self.reduced is None or self._asked > _MOST_FOLLOWED:
            return self._extent(Kind.UNDECIDED, EvidenceKind.NONE, Reason.TOO_LARGE)
        return by_path(self.reduced, unit, self.floor)

    def _inside(
        self, motions: dict[int, Extent], vectors: dict[int, FloatArray]
    ) -> dict[int, Extent]:
        """Strained motions inside of sheets and wires that go on with others inside of these.

        How they are told apart is arbitrary: where the form has both signs on those inside of
        the same parts, as many can be chosen that all go on.
        """
        strained = [k for k, each in motions.items() if each.reason is Reason.STRAINED]
        if not (strained and self._is_indefinite and self.spaces.is_told_by_parts):
            return {}
        groups: dict[tuple[Part, ...], list[int]] = {}
        for k in vectors:
            motion = Motion(k, self.spaces)
            if motion.is_internal:
                groups.setdefault(motion.internal_to, []).append(k)
        made: dict[int, Extent] = {}
        extent = self._extent(Kind.FINITE, EvidenceKind.CERTIFIED, Reason.AMONG_OTHERS)
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
            lines = _lines_of(self.forms.matrix[0]) if self.motions == 2 else ()
            return self.motions - 1, branches_of(lines, vectors)
        if self.reduced is None:
            return None, ()
        basis = self.cone.basis
        if not self.cone.forms.matrix.size and is_without_strain(self.reduced, basis):
            return basis.shape[1], ()
        if self.motions > MOST_MOTIONS:
            return None, ()
        units = [each / np.linalg.norm(each) for each in vectors.values()]
        near = positions_near(self.reduced, basis, units)
        dimension = near.dimension
        if dimension == 0 and any(each.kind is Kind.FINITE for each in motions.values()):
            dimension = None
        if dimension != 1 or any(each.kind is Kind.FINITE for each in motions.values()):
            return dimension, ()
        return dimension, branches_of(near.lines, vectors)


def _lines_of(form: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Both directions, (2,) each, in which an indefinite form of two motions is zero."""
    values, vectors = np.linalg.eigh(form)
    one, other = np.sqrt(np.abs(values[::-1])).tolist()
    lines = [vectors @ np.array([one, sign * other]) for sign in (1.0, -1.0)]
    return lines[0] / np.linalg.norm(lines[0]), lines[1] / np.linalg.norm(lines[1])
