# SPDX-License-Identifier: BSD-3-Clause
"""Linear systems of modes: A, B, C, D, poles, zeros and frequency response, in any units."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..core.arrays import BoolArray, FloatArray
from ..model.data import ModelData
from ..util.records import Frozen, cached_property
from ..util.text import in_short
from ..util.units import Units
from .errors import ElasticError

ComplexArray = NDArray[np.complex128]

FORCE, MOTION, PLACE, VELOCITY = "force", "motion", "place", "velocity"


class Signal(NamedTuple):
    """An input or an output.

    Attributes:
        label: Such as "stage:y", "stage:y-base:y" or "base:y motion".
        kind: force, motion, place or velocity.
        unit: SI.
        vector: (3, nodes of the deck) of a unit input, or what of displacements and spins is seen.
    """

    label: str
    kind: str
    unit: str
    vector: FloatArray


class LeftOut(NamedTuple):
    """What is left out of the dynamics.

    Attributes:
        frequency: (k,) angular frequencies of the modes [rad/s]; infinite of what has no mass.
        share: (k, outputs, inputs) what each does statically, as a size; for a velocity, what it
            does over its own angular frequency.
        damping: Of all of them.
    """

    frequency: FloatArray
    share: FloatArray
    damping: float


#: A system, or one with words and files.
System = TypeVar("System", bound="LinearSystem")


@dataclass(frozen=True, eq=False, repr=False)
class LinearSystem(Frozen):
    """x' = A x + B u, y = C x + D u of the modes of a state.

    The states are two a mode: omega xi, and xi' less what the input puts into it. Numbers in and
    out are in the model's units; forces are in N.

    Attributes:
        name: Of the model.
        label: The state and how it is computed, in words.
        inputs: What acts.
        outputs: What is seen.
        square: (n,) squares of the angular frequencies of the modes [rad^2/s^2], ascending.
        damping: (n,) modal ratios.
        seen: (outputs, n) what the outputs see of each mode of unit modal mass, SI.
        driven: (n, inputs) modal forces of unit forces, SI; 0 for motions.
        carried: (n, inputs) phi'M T of motions, SI; 0 for forces.
        through: (outputs, inputs) D, SI.
        left_out: What is left out, but for its statics.
        modes: How many modes the mesh has.
        units: Of numbers in and out.
        data: The model.
    """

    name: str
    label: str
    inputs: tuple[Signal, ...]
    outputs: tuple[Signal, ...]
    square: FloatArray
    damping: FloatArray
    seen: FloatArray
    driven: FloatArray
    carried: FloatArray
    through: FloatArray
    left_out: LeftOut
    modes: int
    units: Units
    data: ModelData

    # -- the system ----------------------------------------------------------------------------

    @cached_property
    def A(self) -> FloatArray:  # noqa: N802
        """(2 n, 2 n) of blocks [[0, omega], [-omega, -2 zeta omega]]."""
        made = np.zeros((2 * self.square.size,) * 2)
        first = 2 * np.arange(self.square.size)
        made[first, first + 1] = self._speed
        made[first + 1, first] = -self.square / self._speed
        made[first + 1, first + 1] = -self._drag
        return made

    @cached_property
    def B(self) -> FloatArray:  # noqa: N802
        """(2 n, inputs)."""
        first, second = self._entries
        made = np.zeros((2 * self.square.size, len(self.inputs)))
        made[::2] = self._speed[:, None] * second
        made[1::2] = first - self._drag[:, None] * second
        return made / self._factors(self.inputs)

    @cached_property
    def C(self) -> FloatArray:  # noqa: N802
        """(outputs, 2 n)."""
        is_rate = np.array([each.kind == VELOCITY for each in self.outputs])[:, None]
        made = np.zeros((len(self.outputs), 2 * self.square.size))
        made[:, ::2] = np.where(is_rate, 0.0, self.seen / self._speed)
        made[:, 1::2] = np.where(is_rate, self.seen, 0.0)
        return made * self._factors(self.outputs)[:, None]

    @property
    def D(self) -> FloatArray:  # noqa: N802
        """(outputs, inputs) what follows at once: static correction, and what motions carry."""
        return self.through * self._gain_factors

    @property
    def _speed(self) -> FloatArray:
        """(n,) angular frequencies, of unstable ones their sizes; 1 where there is none."""
        return np.where(self.square != 0.0, np.sqrt(np.abs(self.square)), 1.0)

    @property
    def _drag(self) -> FloatArray:
        """(n,) 2 zeta omega."""
        return np.asarray(2.0 * self.damping * np.sqrt(np.abs(self.square)))

    @property
    def _entries(self) -> tuple[FloatArray, FloatArray]:
        """(n, inputs) what acts on each mode with the input, and with its rate."""
        return (
            self.driven + self.square[:, None] * self.carried,
            self._drag[:, None] * self.carried,
        )

    def _factors(self, signals: Sequence[Signal]) -> FloatArray:
        return np.array([self.units.factor(_LENGTHS[each.unit]) for each in signals])

    @property
    def _gain_factors(self) -> FloatArray:
        return self._factors(self.outputs)[:, None] / self._factors(self.inputs)

    @cached_property
    def gain_units(self) -> tuple[tuple[str, ...], ...]:
        """Units of the gains by output and input, such as "mm/N"; "1" without one."""
        made = []
        for out in self.outputs:
            top, *rate = _symbol(self.units, out.unit).split("/")
            row = []
            for each in self.inputs:
                below = " ".join((*rate, _symbol(self.units, each.unit)))
                unit = f"{top}/({below})" if " " in below else f"{top}/{below}"
                row.append("1" if top == below else unit)
            made.append(tuple(row))
        return tuple(made)

    # -- what it does --------------------------------------------------------------------------

    @property
    def frequencies(self) -> FloatArray:
        """(n,) natural frequencies of its modes [Hz], without damping; negative of unstable."""
        return np.asarray(np.sign(self.square) * np.sqrt(np.abs(self.square)) / (2.0 * math.pi))

    @property
    def acting(self) -> BoolArray:
        """(outputs, inputs, n) which modes an input drives and an output sees."""
        first, second = self._entries
        share = np.abs(first) + np.abs(second) * self._speed[:, None]
        size = np.abs(self.seen[:, None, :]) * share.T
        return np.asarray(size > _CANCELS * size.max(axis=2, keepdims=True, initial=0.0))

    @property
    def poles(self) -> ComplexArray:
        """(2 n,) eigenvalues of A [rad/s], pair by pair as the modes are."""
        half = self._drag / 2.0
        root = np.sqrt((half**2 - self.square).astype(np.complex128))
        return np.asarray(np.stack((-half + root, -half - root), axis=1).ravel())

    @cached_property
    def zeros(self) -> ComplexArray:
        """Zeros of one input and one output [rad/s], ascending by size.

        Modes that the input does not drive or the output does not see are no poles and no zeros.
        Found are those up to the fastest pole, of a mesh with many modes up to the 60th of them.

        Raises:
            ElasticError: there are several inputs or outputs: see `pair`.
        """
        if len(self.inputs) > 1 or len(self.outputs) > 1:
            raise ElasticError(
                "zeros are those from one input to one output: pair(output, input).zeros"
            )
        return _zeros_of(self)

    def pair(self: System, output: int = 0, input: int = 0) -> System:
        """The same system from one input to one output, by their places from 0."""
        o, i = slice(output, output + 1 or None), slice(input, input + 1 or None)
        share = self.left_out.share[:, o, i]
        return replace(
            self,
            inputs=self.inputs[i],
            outputs=self.outputs[o],
            seen=self.seen[o],
            driven=self.driven[:, i],
            carried=self.carried[:, i],
            through=self.through[o, i],
            left_out=self.left_out._replace(share=share),
        )

    def response(self, f: ArrayLike) -> ComplexArray:
        """Frequency response at frequencies [Hz].

        Returns:
            (outputs, inputs) complex; of frequencies (k,) (k, outputs, inputs). Infinite at a
            pole on the imaginary axis, as that of a motion without stiffness at 0.

        Raises:
            ElasticError: a frequency is no finite number.
        """
        hertz = _frequencies_given(f)
        made = np.empty((hertz.size, *self.through.shape), np.complex128)
        for k, s in enumerate(2j * math.pi * hertz.ravel()):
            made[k] = self._at(complex(s))
        # By parts: complex infinity times a number is none.
        made.real, made.imag = made.real * self._gain_factors, made.imag * self._gain_factors
        return made.reshape(*hertz.shape, *self.through.shape)

    def _at(self, s: complex) -> ComplexArray:
        """(outputs, inputs) the transfer at s, SI."""
        first, second = self._entries
        below = self.square + self._drag * s + s * s
        above = first + second * s
        with np.errstate(divide="ignore", invalid="ignore"):
            each = above / below[:, None]
        each[above == 0.0] = 0.0
        endless = (below == 0.0)[:, None] & (above != 0.0)
        each[endless] = 0.0
        made = self.seen @ each + self.through
        for o, out in enumerate(self.outputs):
            made[o] *= s if out.kind == VELOCITY else 1.0
            hit = ((self.seen[o][:, None] != 0.0) & endless).any(axis=0)
            if not (out.kind == VELOCITY and s == 0.0):
                made[o, hit] = np.inf
        return np.asarray(made)

    @property
    def static_gain(self) -> FloatArray:
        """(outputs, inputs) response at rest, exact however few modes; infinite where loose."""
        first, _ = self._entries
        loose = self.square == 0.0
        with np.errstate(divide="ignore", invalid="ignore"):
            each = np.where(loose[:, None], 0.0, first / self.square[:, None])
        size = np.abs(self.seen) @ np.abs(each) + np.abs(self.through)
        made = np.asarray(self.seen @ each + self.through)
        made[np.abs(made) < _ROUNDED * size] = 0.0
        made[(np.abs(self.seen[:, loose]) @ np.abs(first[loose])) > 0.0] = np.inf
        made[[out.kind == VELOCITY for out in self.outputs]] = 0.0
        return made * self._gain_factors

    def error_bound(self, f: ArrayLike) -> FloatArray:
        """How far the response may be from that of all modes, at frequencies [Hz].

        Of each mode left out, r/(1 - v^2 + 2 i zeta v) with v = f/f_k is taken as r: at most
        |r| v (v + 2 zeta)/|1 - v^2 + 2 i zeta v| is missing. Of a velocity r itself is left out.

        Returns:
            (outputs, inputs), or (k, outputs, inputs), as `response`.
        """
        hertz = _frequencies_given(f)
        made = np.zeros((hertz.size, *self.through.shape))
        rates = np.array([each.kind == VELOCITY for each in self.outputs])[:, None]
        zeta = self.left_out.damping
        for k, omega in enumerate(2.0 * math.pi * np.abs(hertz.ravel())):
            part = omega / self.left_out.frequency
            below = np.abs(1.0 - part**2 + 2j * zeta * part)
            with np.errstate(divide="ignore"):
                size = np.stack((part * (part + 2.0 * zeta) / below, omega / below))
            both = np.einsum("vk,koi->voi", size, self.left_out.share)
            made[k] = np.where(rates, both[1], both[0])
        return np.asarray((made * self._gain_factors).reshape(*hertz.shape, *self.through.shape))


#: Of each unit of a signal the one by whose length it changes.
_LENGTHS = {"m": "m", "m/s": "m", "rad": "rad", "rad/s": "rad", "N": "N", "N m": "N m"}


def _symbol(units: Units, unit: str) -> str:
    """Such as "mm/s" of "m/s"."""
    length = _LENGTHS[unit]
    return units.symbol(length) + unit.removeprefix(length)


def _frequencies_given(f: ArrayLike) -> FloatArray:
    try:
        hertz = np.asarray(f, np.float64)
    except (TypeError, ValueError):
        raise ElasticError(f"frequencies are numbers in Hz, not {in_short(f)}") from None
    if not np.isfinite(hertz).all():
        raise ElasticError("a frequency is no finite number [Hz]")
    return hertz


#: Modes with which zeros are looked for, and steps by which each is then found in all of them.
_MOST_ZEROS, _STEPS = 60, 20
#: What moves by less than this part is found; by more than the other it is another zero.
_FOUND, _NEAR = 1.0e-13, 1.0e-2
#: What an output sees of a mode that an input drives is rounding below this part of the largest.
_CANCELS = 1.0e-8
#: Sums below this part of their terms are zero; where the pencil is looked at from.
_ROUNDED, _SHIFT = 1.0e-12, 0.7320508


def _zeros_of(system: LinearSystem) -> ComplexArray:
    """Of one input and output: finite eigenvalues of the pencil of Rosenbrock's matrix."""
    chosen = np.flatnonzero(system.acting[0, 0])[:_MOST_ZEROS]
    few = _with_modes(system, chosen)
    n = 2 * chosen.size
    if not n:
        return np.zeros(0, np.complex128)
    # One unit of time and one gain for all, so that fast and slow modes stand beside each other.
    pace = float(np.exp(np.mean(np.log(few._speed))))
    b, c = np.linalg.norm(few.B), np.linalg.norm(few.C)
    whole = np.block([[few.A / pace, few.B / b], [few.C / c, few.D * pace / (b * c)]])
    unit = np.diag([*np.ones(n), 0.0])
    # Infinite ones are those that are zero here; the shift, to the right, is hardly a zero.
    inverse = np.linalg.eigvals(np.linalg.solve(whole - _SHIFT * unit, unit))
    far = float(np.abs(few.poles).max()) * (1.0 + _NEAR)
    least = 1.0 / (far / pace + _SHIFT)
    found = pace * (_SHIFT + 1.0 / inverse[np.abs(inverse) >= least])
    made = [_polished(system, complex(zero)) for zero in found if abs(zero) <= far]
    # Of a double zero at rest no more than half the digits are left.
    least = math.sqrt(_ROUNDED) * float(few._speed.min())
    zeros = np.array([0.0 if abs(zero) < least else zero for zero in made], complex)
    return zeros[np.lexsort((zeros.imag, np.abs(zeros).round(9)))]


def _polished(system: LinearSystem, start: complex) -> complex:
    """A zero of all modes next to that of some, by Newton's method; where it fails, the start."""
    at = start
    is_rate = system.outputs[0].kind == VELOCITY
    first, second = (each[:, 0] for each in system._entries)
    for _ in range(_STEPS):
        below = system.square + system._drag * at + at * at
        if np.any(below == 0.0):
            return start
        above = first + second * at
        value = complex(system.seen[0] @ (above / below) + system.through[0, 0])
        slope = (second * below - above * (system._drag + 2.0 * at)) / below**2
        rate = complex(system.seen[0] @ slope)
        if is_rate:
            value, rate = value * at, value + rate * at
        if rate == 0.0:
            return start
        at -= value / rate
        if abs(at - start) > _NEAR * abs(start):
            return start
        if abs(value / rate) <= _FOUND * abs(at):
            break
    return complex(at.real, 0.0) if start.imag == 0.0 else at


def _with_modes(system: LinearSystem, chosen: np.ndarray) -> LinearSystem:
    """With some modes alone, and the statics of the others."""
    others = np.setdiff1d(np.arange(system.square.size), chosen)
    others = others[system.square[others] != 0.0]
    static = system.seen[:, others] @ (
        system.driven[others] / system.square[others, None] + system.carried[others]
    )
    rates = np.array([each.kind == VELOCITY for each in system.outputs])[:, None]
    return replace(
        system,
        square=system.square[chosen],
        damping=system.damping[chosen],
        seen=system.seen[:, chosen],
        driven=system.driven[chosen],
        carried=system.carried[chosen],
        through=system.through + np.where(rates, 0.0, static),
    )
