# SPDX-License-Identifier: BSD-3-Clause
"""From a sound model to the decomposition of its D(c)."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..core import calls
from ..core.arrays import Basis, IntArray
from ..core.progress import Progress, reported
from ..core.raw import RawAnalysis
from ..model.data import ModelData
from ..util import machine as memory
from ..util.records import cached_property
from ..util.text import in_short
from .decomposition import Accuracy, AccuracyGiven, Asked, Outcome, column_weights, row_weights
from .mode_basis import (
    internal_motions,
    is_large,
    motion_basis,
    moves_within,
    scaled_motions,
    scaled_stresses,
    stress_basis,
)
from .sparse_basis import orthonormal
from .verdict import completed


@dataclass(frozen=True, eq=False, repr=False)
class Spaces(Outcome):
    """An outcome with bases of its null spaces; each is made when it is asked for."""

    def in_notebook(self, what: object) -> str | None:
        """HTML of a motion, a self-stress or a row of them; None: a result makes no pictures."""
        return None

    @cached_property
    def motion_space(self) -> Basis:
        """Orthonormal basis of the motions, rotations in lengths."""
        return orthonormal(self.raw.motions, column_weights(self))

    @cached_property
    def stress_space(self) -> Basis:
        """Orthonormal basis of the self-stresses, moments in forces."""
        return orthonormal(self.raw.stresses, row_weights(self))

    @cached_property
    def motion_basis(self) -> Basis:
        """The motions as they are told, [m] and [rad]: sparse over bodies, not orthogonal.

        The largest entry of each is 1, rotations compared by the characteristic length. Of
        large spaces they are those of the core, scaled (`flexact.analysis.mode_basis`).
        """
        if self.raw.motions.vectors < self.under_constrained or is_large(self.raw.motions):
            return scaled_motions(self)
        return motion_basis(self, self.motion_space)

    @cached_property
    def stress_basis(self) -> Basis:
        """The self-stresses as they are told: sparse over parts, the largest force or moment 1."""
        if self.raw.stresses.vectors < self.over_constrained or is_large(self.raw.stresses):
            return scaled_stresses(self)
        return stress_basis(self, self.stress_space)

    @cached_property
    def internal_motions(self) -> int:
        """How many motions move nothing but what is inside of sheets and wires.

        It is the dimension of the space of these. Of a space so large that it is told as the
        core gives it, it is how many of the core's vectors are so.
        """
        return internal_motions(self, self.motion_basis)

    @cached_property
    def are_between_ends(self) -> tuple[bool, ...]:
        """Of each motion whether it moves nothing but what is between the ends of flexures.

        That is insides of sheets and wires, and folds. Those that do are a basis of all such
        motions, but of spaces so large that they are told as the core gives them.
        """
        if not self.motion_basis.vectors:
            return ()
        nodes = self.carriers.between_ends
        return tuple(moves_within(self, self.motion_basis, nodes).tolist())


#: Methods that were there once, and what serves instead.
_REMOVED = {"qr": "use svd, or auto"}


def asked_for(
    method: str,
    tolerance: float | None,
    prove: bool | None = None,
    accuracy: AccuracyGiven | None = None,
) -> Asked:
    """What an analysis is asked for, if there is such a thing.

    Raises:
        TypeError: the method is no text, the tolerance no number, `prove` no truth value, or
            the accuracy neither a number nor two.
        ValueError: there is no such method, the tolerance is negative or not finite, or the
            accuracy is not positive or not finite.
    """
    if not isinstance(prove, (bool, type(None))):
        raise TypeError(f"prove must be True, False or None, not {type(prove).__name__}")
    tolerance = _checked_tolerance(tolerance)
    known = None if accuracy is None else Accuracy.of(accuracy)
    return Asked(_checked_method(method), tolerance, prove, known)


def _checked_method(method: str) -> str:
    if not isinstance(method, str):
        raise TypeError(f"a method is given by its name, not by {type(method).__name__}")
    if method in _REMOVED and method not in calls.METHODS:
        raise ValueError(f"the method {method!r} was removed; {_REMOVED[method]}")
    if method not in calls.METHODS:
        choices = ", ".join(calls.METHODS)
        raise ValueError(f"there is no method {method!r}; choose from {choices}")
    return method


def _checked_tolerance(tolerance: float | None) -> float | None:
    if tolerance is None:
        return None
    kind = type(tolerance).__name__
    if isinstance(tolerance, (str, bytes, bytearray, memoryview, bool)):
        raise TypeError(f"the tolerance must be a number, not {kind}")
    try:
        value = float(tolerance)
    except TypeError:
        raise TypeError(f"the tolerance must be a number, not {kind}") from None
    except (ValueError, OverflowError):
        raise ValueError(f"the tolerance must be a number, not {in_short(tolerance)}") from None
    if not (math.isfinite(value) and value >= 0.0):
        raise ValueError(f"the tolerance must be finite and not negative, not {value}")
    return value


def decompose(data: ModelData, asked: Asked, progress: Progress | None = None) -> RawAnalysis:
    """Decompose D(c) of a model.

    Raises:
        DeckError: the model's deck is wrong.
        ModelError: the model is wrong.
        AnalysisError: it is too large for the memory, or there was no convergence.
    """
    data.require_sound()
    # Below a bound of what it may need, nobody has to look how much there is.
    most = data.packed.nodes.size + data.packed.elements.size
    room = memory.allowance(memory.dense_needed(most, most))

    def work(stage: IntArray | None) -> RawAnalysis:
        return calls.analyse_model(
            *(data.packed, asked.method, asked.tolerance, stage, room),
            prove=asked.prove,
            as_stored=data.has_long_numbers,
        )

    return completed(data, lambda: work(None) if progress is None else reported(work, progress))
