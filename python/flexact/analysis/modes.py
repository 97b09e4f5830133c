# SPDX-License-Identifier: BSD-3-Clause
"""Motions and self-stresses: what the null spaces of D(c) mean at nodes and elements."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from operator import eq
from typing import Generic, TypeVar, overload

import numpy as np

from ..core.arrays import FloatArray
from ..core.elements import Dual, NodeKind, coordinate_name
from ..util.records import Frozen, cached_property
from .body_motions import Moves, Velocities
from .decomposition import column_weights, row_duals, row_factors, row_weights
from .mode_basis import column_key, ranked, row_key
from .part_stresses import Conflict, Load, PartStress, Pressing
from .spaces import Spaces

#: How many modes of a row stand in its `repr`.
_TOLD = 12


@dataclass(frozen=True, repr=False)
class Motion(Moves, Frozen):
    """A kinematically indeterminate motion: velocities that nothing determines.

    Attributes:
        index: Which one of the analysis, from 0.
        analysis: The analysis it belongs to.
    """

    index: int
    analysis: Spaces

    @property
    def vector(self) -> FloatArray:
        """(n,) the dependent coordinates [m, rad]; the largest is one."""
        column = self.analysis.motion_basis.vector(self.index)
        column.flags.writeable = False
        return column

    @cached_property
    def analysed(self) -> Velocities:
        """The velocities of the nodes of the model as it was analysed."""
        kinds = self.analysis.data.arrays.node_kind
        place, value = self.analysis.motion_basis.entries(self.index)
        node, axis = self.analysis.raw.column_label[:, place] - 1
        both = np.zeros((2, kinds.size, 3))
        both[(kinds[node] > NodeKind.POSITION).astype(int), node, axis] = value
        return Velocities(self.analysis.data, *both)

    def largest(self, k: int = 6) -> list[tuple[int, str, float]]:
        """Node number, coordinate and value [m, rad] of the k largest parts.

        Rotations are compared with displacements by the characteristic length.
        """
        analysis = self.analysis
        place, value = analysis.motion_basis.entries(self.index)
        weighted = value * column_weights(analysis, place)
        order = ranked(weighted, k, lambda i: column_key(analysis, int(place[i])))
        node, axis = analysis.raw.column_label[:, place[order]] - 1
        numbers = analysis.data.arrays.node_number[node].tolist()
        names = map(coordinate_name, analysis.data.arrays.node_kind[node].tolist(), axis.tolist())
        return list(zip(numbers, names, value[order].tolist(), strict=True))

    def __repr__(self) -> str:
        """What moves."""
        if not self.analysis.is_told_by_parts:
            parts = [f"node {n} {c} {v:.4g}" for n, c, v in self.largest(4)]
        elif self.is_internal:
            parts = [f"inside {', '.join(part.name for part in self.internal_to)}"]
        else:
            parts = [str(each) for each in self.bodies[:4]]
        return f"<Motion {self.index + 1}: {'; '.join(parts)}>"

    def _repr_html_(self) -> str | None:
        return self.analysis.in_notebook(self)


@dataclass(frozen=True, repr=False)
class SelfStress(Frozen):
    """A statically indeterminate stress: stress resultants that need no load.

    Attributes:
        index: Which one of the analysis, from 0.
        analysis: The analysis it belongs to.
    """

    index: int
    analysis: Spaces

    @property
    def vector(self) -> FloatArray:
        """(m,) stress resultants dual to the deformations; the largest force or moment is one."""
        column = self.analysis.stress_basis.vector(self.index)
        column.flags.writeable = False
        return column

    @property
    def forces(self) -> FloatArray:
        """(elements, 6) by deformation, where its stress resultant is a force [N]; else zero."""
        return self._at_elements[1]

    @property
    def moments(self) -> FloatArray:
        """(elements, 6) by deformation, where it is a moment [N m]; else zero.

        Of a beam's torsion and bending the moment is sigma l0.
        """
        return self._at_elements[0]

    @cached_property
    def _at_elements(self) -> tuple[FloatArray, FloatArray]:
        made = self.analysis.condensed.stress(*self.analysed)
        for array in made:
            array.flags.writeable = False
        return made

    @cached_property
    def analysed(self) -> tuple[FloatArray, FloatArray]:
        """Moments and forces, (elements, 6) each, of the elements of the model as analysed."""
        place, value = self.analysis.stress_basis.entries(self.index)
        element, deformation = self.analysis.raw.row_label[:, place] - 1
        is_force = (row_duals(self.analysis, place) == Dual.FORCE).astype(int)
        both = np.zeros((2, self.analysis.data.arrays.element_number.size, 6))
        both[is_force, element, deformation] = value * row_factors(self.analysis, place)
        return both[0], both[1]

    @cached_property
    def _pressing(self) -> Pressing:
        return Pressing(self.analysis, self.vector)

    @property
    def parts(self) -> tuple[PartStress, ...]:
        """The flexible parts that carry something: the largest first, of equal ones by name.

        Where bodies alone carry, they are given.
        """
        return self._pressing.parts

    @property
    def conflicts(self) -> tuple[Conflict, ...]:
        """Bodies on which parts press, then joints, with what each part exerts on them."""
        return self._pressing.conflicts

    @property
    def on_bodies(self) -> tuple[Conflict, ...]:
        """Of the conflicts those on bodies."""
        return self._pressing.on_bodies

    def of(self, part: object) -> PartStress:
        """The stress resultants of a part; see `flexact.analysis.part_stresses.Pressing.of`."""
        return self._pressing.of(part)

    def on(self, body: object) -> tuple[Load, ...]:
        """What each part exerts on a body or point, in balance.

        See `flexact.analysis.part_stresses.Pressing.on`.
        """
        return self._pressing.on(body)

    def largest(self, k: int = 6) -> list[tuple[int, int, float]]:
        """Element number, deformation and force [N] or moment [N m] of the k largest parts.

        Moments are compared with forces by the characteristic length.
        """
        analysis = self.analysis
        place, value = analysis.stress_basis.entries(self.index)
        weighted = value * row_weights(analysis, place)
        order = ranked(weighted, k, lambda i: row_key(analysis, int(place[i])))
        element, deformation = analysis.raw.row_label[:, place[order]]
        numbers = analysis.data.arrays.element_number[element - 1].tolist()
        values = value[order] * row_factors(analysis, place[order])
        return list(zip(numbers, deformation.tolist(), values.tolist(), strict=True))

    def __repr__(self) -> str:
        """What is stressed."""
        if not self.analysis.is_told_by_parts:
            parts = [f"element {e}, {d}: {v:.4g}" for e, d, v in self.largest(4)]
        else:
            parts = [str(each) for each in self.parts[:4]]
        return f"<SelfStress {self.index + 1}: {'; '.join(parts)}>"

    def _repr_html_(self) -> str | None:
        return self.analysis.in_notebook(self)


Mode = TypeVar("Mode", Motion, SelfStress)


@dataclass(frozen=True, eq=False, repr=False)
class Modes(Frozen, Sequence[Mode], Generic[Mode]):
    """Motions or self-stresses in a row, like a tuple; each is made when it is asked for.

    Attributes:
        kind: What they are.
        analysis: The analysis that they belong to.
    """

    kind: type[Mode]
    analysis: Spaces

    def __len__(self) -> int:
        """How many are given: all, or, where there are very many, the first."""
        raw = self.analysis.raw
        return (raw.motions if self.kind is Motion else raw.stresses).vectors

    @overload
    def __getitem__(self, index: int) -> Mode: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[Mode, ...]: ...
    def __getitem__(self, index: int | slice) -> Mode | tuple[Mode, ...]:
        """One of them, or a tuple of several."""
        try:
            chosen = range(len(self))[index]
        except IndexError:
            many, what = len(self), "motion" if self.kind is Motion else "self-stress"
            what += "" if many == 1 else "s" if self.kind is Motion else "es"
            raise IndexError(
                f"there {'is' if many == 1 else 'are'} {many or 'no'} {what}: none has the index "
                f"{index}{'; they count from 0' if many else ''}"
            ) from None
        if isinstance(chosen, range):
            return tuple(self.kind(k, self.analysis) for k in chosen)
        return self.kind(chosen, self.analysis)

    def __eq__(self, other: object) -> bool:
        """Whether the same ones stand in another row or tuple."""
        if not isinstance(other, (Modes, tuple)):
            return NotImplemented
        return len(self) == len(other) and all(map(eq, self, other))

    def __hash__(self) -> int:
        """As of any object that does not change."""
        return hash((self.kind, self.analysis))

    def __repr__(self) -> str:
        """The first ones."""
        told = [repr(mode) for mode in self[:_TOLD]]
        return f"({', '.join(told)}{', ...' if len(self) > _TOLD else ''})"

    def _repr_html_(self) -> str | None:
        return self.analysis.in_notebook(self)
