# SPDX-License-Identifier: BSD-3-Clause
"""A state as a linear system: what a controller sees of a mechanism.

With the modes of a mesh, of unit modal mass, eta'' + 2 zeta omega eta' + omega^2 eta = phi'F u for
forces. What is fixed moves with u: x = T u + phi eta, where T follows in equilibrium, and
eta'' + 2 zeta omega eta' + omega^2 eta = -phi'M T u''; damping acts on the relative motion. With
xi = eta + phi'M T u there is no second derivative left, so that the system from displacement to
displacement is proper and exact at all frequencies. What modes that are left out and what has no
mass do statically stands in D (static correction; R. H. MacNeal, A hybrid method of component mode
synthesis, Computers & Structures 1, 1971).
"""

from __future__ import annotations

import math
import os
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..core.arrays import BoolArray, FloatArray
from ..core.elements import Class, NodeKind
from ..model.data import ModelData
from ..util.errors import FlexactError
from ..util.loading import load
from ..util.records import Frozen, cached_property
from ..util.text import in_short
from ..util.units import METRES, Units
from .equilibria import misalignment
from .errors import ElasticError
from .modal import modes_of
from .points import Points
from .solution import Solution

ComplexArray = NDArray[np.complex128]

FORCE, MOTION, PLACE, VELOCITY = "force", "motion", "place", "velocity"
#: All clamps together, as a point of base motion.
GROUND = "ground"
_NAME = r"(.+?)\s*:\s*(r?[xyz])"
_ONE = re.compile(rf"(?s)\s*{_NAME}\s*(?:[:\s]\s*(motion|velocity))?\s*")
_TWO = re.compile(rf"(?s)\s*{_NAME}\s*-\s*{_NAME}\s*(?:[:\s]\s*(velocity))?\s*")
_WRITTEN = {
    True: 'an input is a force or moment on (point, coordinate), such as ("stage", "y") or '
    '"stage:y", a pair of equal and opposite ones, "stage:y-base:y", or the motion of what is '
    'fixed, ("base", "y", "motion")',
    False: 'an output is (point, coordinate), such as ("stage", "y") or "stage:y", a difference '
    'of two, (("stage", "y"), ("base", "y")) or "stage:y-base:y", or a velocity, '
    '("stage", "y", "velocity")',
}


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


@dataclass(frozen=True, eq=False, repr=False)
class StateSpace(Frozen):
    """x' = A x + B u, y = C x + D u of a state; made by `state_space` of `Elastic` or of a state.

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

    def pair(self, output: int = 0, input: int = 0) -> StateSpace:
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

    # -- for others ----------------------------------------------------------------------------

    def to_scipy(self) -> Any:
        """A `scipy.signal.StateSpace`."""
        from scipy import signal

        return signal.StateSpace(self.A, self.B, self.C, self.D)

    def to_control(self) -> Any:
        """A `control.StateSpace` of the Python Control Systems Library, with names.

        Raises:
            FlexactError: the package is missing.
        """
        try:
            import control
        except ImportError:
            raise FlexactError("this needs the package control: pip install control") from None
        names = {
            "inputs": [each.label for each in self.inputs],
            "outputs": [each.label for each in self.outputs],
        }
        return control.ss(self.A, self.B, self.C, self.D, **names)

    def describe(self) -> str:
        """Static gains, poles and zeros, in words."""
        return str(load("flexact.elasticity.transfer").describe(self))

    def plot(self) -> Any:
        """A figure of matplotlib: size and phase over frequency, of each input and output.

        Raises:
            FlexactError: matplotlib is missing.
        """
        return load("flexact.elasticity.bode").plot_of(self)

    def to_dict(self) -> dict[str, Any]:
        """All of it as JSON has it (`docs/transfer.schema.json`)."""
        made: dict[str, Any] = load("flexact.elasticity.transfer").dictionary_of(self)
        return made

    def to_json(self) -> str:
        """One line of JSON, of `to_dict`; numbers read back to the last bit."""
        return str(load("flexact.elasticity.transfer").text_of(self))

    def to_csv(self) -> str:
        """The frequency response as a tidy table."""
        return str(load("flexact.elasticity.transfer").csv_text(self))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write it to a file, whole or not at all.

        Args:
            path: Its suffix says what it is to be: a Bode picture (.png, .svg, .pdf), a page
                (.html), the frequency response (.csv), all of it (.json), or A, B, C and D for
                MATLAB (.mat).

        Raises:
            FlexactError: there is no such kind of file, a package is missing, or the file cannot
                be written.
        """
        load("flexact.elasticity.transfer").TRANSFERS.save(self, self.data, Path(path))

    def __repr__(self) -> str:
        """From what to what, and how many modes."""
        ends = (", ".join(e.label for e in each) for each in (self.inputs, self.outputs))
        return f"<StateSpace from {' to '.join(ends)}: {self.square.size} modes, {self.label}>"


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
_CANCELS = 1.0e-10
#: Sums below this part of their terms are zero; where the pencil is looked at from.
_ROUNDED, _SHIFT = 1.0e-12, 0.7320508


def _zeros_of(system: StateSpace) -> ComplexArray:
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


def _polished(system: StateSpace, start: complex) -> complex:
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


def _with_modes(system: StateSpace, chosen: np.ndarray) -> StateSpace:
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


# -- how it is made ----------------------------------------------------------------------------

#: Parts of the largest that an output sees, or of the force on it, that are rounding.
_UNSEEN = 1.0e-13
#: What does so much on a motion with neither stiffness nor mass acts on it.
_ACTS = 1.0e-9


def state_space_of(
    at: Solution,
    points: Points,
    inputs: object,
    outputs: object,
    damping: ArrayLike,
    modes: object,
    label: str,
    units: Units,
) -> StateSpace:
    """The linear system of a state of one mesh.

    Args:
        at: The state.
        points: Of the model as given.
        inputs: One input, or several; see `Elastic.state_space`.
        outputs: Likewise.
        damping: Modal ratios.
        modes: How many; None for all.
        label: The state and how it is computed.
        units: Of numbers in and out.

    Raises:
        UnknownError: a point or coordinate is not there.
        ElasticError: something is not understood, fixed where it acts or free where it is moved,
            or not determined.
    """
    acting = tuple(_input_of(at, points, each) for each in _several(inputs, True))
    seen = tuple(_output_of(points, each) for each in _several(outputs, False))
    is_motion = np.array([each.kind == MOTION for each in acting])
    if is_motion.any() and any(each.kind == VELOCITY for each in seen):
        raise ElasticError(
            "a velocity that a prescribed motion causes is no proper system: ask for the place"
        )
    moved = np.zeros((3, at.solver.nodes, int(is_motion.sum())))
    motions = [each.vector for each in acting if each.kind == MOTION]
    moved[:, : points.kinds.size] = np.moveaxis(
        np.array(motions).reshape(-1, 3, points.kinds.size), 0, 2
    )
    found = modes_of(at, moved)

    def along(motions: FloatArray, signals: Sequence[Signal]) -> FloatArray:
        """(signals, k) what signals see of motions, or what their forces do on them."""
        own = motions[: 3 * points.kinds.size]
        vectors = np.array([each.vector.T.ravel() for each in signals])
        whole, size = vectors @ own, np.abs(vectors) @ np.abs(own)
        least = np.maximum(size, np.abs(whole).max(axis=1, initial=0.0)[:, None])
        return np.where(np.abs(whole) > _UNSEEN * least, whole, 0.0)

    for each in (*seen, *acting):
        if each.kind != MOTION and np.abs(along(found.lost, [each])).max(initial=0.0) > _ACTS:
            raise ElasticError(
                f"{each.label} is a motion that has neither stiffness nor mass: give it a mass "
                "(EM, XM), or a material with a density"
            )
    out, light = along(found.shape, seen), along(found.massless, seen)
    forces = np.where(is_motion, 0.0, 1.0)
    force, slight = (along(each, acting).T * forces for each in (found.shape, found.massless))
    carried = np.zeros_like(force)
    carried[:, is_motion] = found.carried
    slight = found.sign[:, None] * slight
    through = light @ slight
    through[:, is_motion] += along(found.follow, seen)

    count = found.square.size
    many = _modes_given(modes, count, int(np.count_nonzero(found.square <= 0.0)))
    ratios = _damping_given(damping, many, modes is None)
    rest = slice(many, None)
    static = force[rest] / found.square[rest, None]
    through += out[:, rest] @ static - out[:, :many] @ carried[:many]
    rates = np.array([each.kind == VELOCITY for each in seen])
    through[rates] = 0.0
    share = np.abs(out.T[rest, :, None] * (static + carried[rest])[:, None, :])
    frequency = np.sqrt(found.square[rest])
    if rates.any():
        share = np.concatenate((share, np.abs(light @ slight)[None]))
        frequency = np.append(frequency, np.inf)
    left = LeftOut(frequency, share, float(ratios.max(initial=0.0)))
    return StateSpace(
        points.data.name,
        label,
        acting,
        seen,
        found.square[:many],
        ratios,
        out[:, :many],
        force[:many],
        carried[:many],
        through,
        left,
        count,
        units,
        points.data,
    )


def _several(given: object, is_input: bool) -> list[object]:
    """Inputs or outputs one by one.

    Raises:
        ElasticError: there is none, or it is nothing of that.
    """
    if isinstance(given, str) or (
        isinstance(given, tuple)
        and len(given) in (2, 3)
        and isinstance(given[1], str)
        and not _is_signal(given[0])
        and not _is_signal(given[1])
    ):
        return [given]
    if not isinstance(given, Iterable) or not (made := list(given)):
        raise ElasticError(f"{_WRITTEN[is_input]}; not {in_short(given)}")
    return made


def _is_signal(given: object) -> bool:
    """Whether it is a point with a coordinate; a point may be coordinates, too."""
    if isinstance(given, str):
        return bool(_ONE.fullmatch(given) or _TWO.fullmatch(given))
    return isinstance(given, (tuple, list)) and len(given) in (2, 3) and isinstance(given[1], str)


def _parts_of(given: object, is_input: bool) -> tuple[list[tuple[object, str]], str]:
    """The points with their coordinates, of a difference two, and the word behind them.

    Raises:
        ElasticError: it is nothing of that.
    """
    word = ""
    if isinstance(given, str):
        for pattern in (_TWO, _ONE):
            if found := pattern.fullmatch(given):
                *names, last = found.groups()
                pairs = [
                    (int(point) if point.isdigit() else point, name)
                    for point, name in zip(names[::2], names[1::2], strict=True)
                ]
                return pairs, last or ""
    elif isinstance(given, (tuple, list)) and len(given) in (2, 3):
        *both, last = given
        if len(given) == 3:
            word = last if isinstance(last, str) else "?"
        else:
            both = list(given)
        if isinstance(both[1], str):
            pairs = [(both[0], both[1])]
        elif _is_signal(both[0]) and _is_signal(both[1]) and len(both[0]) == len(both[1]) == 2:
            pairs = [tuple(both[0]), tuple(both[1])]
        else:
            word, pairs = "?", []
        if word in ("", MOTION if is_input else VELOCITY):
            return pairs, word
    raise ElasticError(f"{_WRITTEN[is_input]}; not {in_short(given)}")


def _label(points: Points, pairs: Sequence[tuple[object, str]]) -> str:
    def name(point: object) -> str:
        return (
            str(point) if isinstance(point, (str, int)) else str(points.number(points.node(point)))
        )

    return "-".join(f"{name(point)}:{coordinate}" for point, coordinate in pairs)


def _vector(
    points: Points, pairs: Sequence[tuple[object, str]], what: str
) -> tuple[FloatArray, bool]:
    """(3, nodes) one at a coordinate, less one at another, and whether they are rotations.

    Raises:
        UnknownError: one is not there.
        ElasticError: they are of two kinds.
    """
    made, turns = np.zeros((3, points.kinds.size)), set()
    for (point, name), sign in zip(pairs, (1.0, -1.0), strict=False):
        node, axis = points.coordinate(point, name)
        made[axis, node] += sign
        turns.add(bool(points.kinds[node] > NodeKind.POSITION))
    if len(turns) > 1:
        raise ElasticError(f"{what} is a displacement less a rotation: take two of a kind")
    return made, turns.pop()


def _output_of(points: Points, given: object) -> Signal:
    pairs, word = _parts_of(given, False)
    if word == MOTION:
        raise ElasticError(f"{_WRITTEN[False]}; not {in_short(given)}")
    label = _label(points, pairs)
    vector, is_turn = _vector(points, pairs, label)
    unit = "rad" if is_turn else "m"
    if word:
        return Signal(f"{label} velocity", VELOCITY, f"{unit}/s", vector)
    return Signal(label, PLACE, unit, vector)


def _input_of(at: Solution, points: Points, given: object) -> Signal:
    pairs, word = _parts_of(given, True)
    if word == VELOCITY:
        raise ElasticError(f"{_WRITTEN[True]}; not {in_short(given)}")
    if word == MOTION:
        if len(pairs) > 1:
            raise ElasticError(f"one thing is moved at a time, not {in_short(given)}")
        vector, is_turn = _motion(at, points, *pairs[0])
        return Signal(f"{_label(points, pairs)} motion", MOTION, "rad" if is_turn else "m", vector)
    label = _label(points, pairs)
    vector, is_turn = _vector(points, pairs, label)
    acts = [points.coordinate(*each) for each in pairs]
    if all(at.is_held(each) for each in acts):
        words = " and ".join(map(points.words, acts))
        point, name = pairs[0]
        raise ElasticError(
            f"{words} {'are' if len(acts) > 1 else 'is'} held, and a force there moves nothing: "
            f'its motion as an input is ({point!r}, "{name}", "motion")'
        )
    return Signal(label, FORCE, "N m" if is_turn else "N", vector)


def _motion(at: Solution, points: Points, point: object, name: str) -> tuple[FloatArray, bool]:
    """(3, nodes) a unit motion of a clamp, of all of them, or of a locked drive; and if it turns.

    Raises:
        UnknownError: it is not there.
        ElasticError: it is not held.
    """
    data = points.data
    if point == GROUND and GROUND not in data.node_names:
        fixed = data.arrays.coordinate_class == Class.FIXED
        turns = points.kinds > NodeKind.POSITION
        axis, is_turn = "xyz".index(name[-1]), name.startswith("r")
        made, direction = np.zeros(fixed.shape), np.eye(3)["xyz".index(name[-1])]
        if is_turn:
            arm = data.arrays.node_value[:3, ~turns]
            made[:, ~turns] = np.cross(direction, arm.T).T
            made[2 if data.planar else axis, turns] = 1.0
        else:
            made[axis, ~turns] = 1.0
        made *= fixed
        if not made.any():
            raise ElasticError(f"nothing is fixed that moves with the ground along {name}")
        return made, is_turn
    coordinate = points.coordinate(point, name)
    is_turn = bool(points.kinds[coordinate.node] > NodeKind.POSITION)
    if coordinate in at.held:
        made = np.zeros((3, points.kinds.size))
        made[coordinate.axis, coordinate.node] = 1.0
        return made, is_turn
    if not at.is_held(coordinate):
        raise ElasticError(
            f"{points.words(coordinate)} is not held, so that its motion is none of the inputs: "
            f'a force on it is ({point!r}, "{name}")'
        )
    return np.array(misalignment(points, point, name, 1.0, None, True, METRES).shift(data)), is_turn


def _modes_given(given: object, count: int, first: int) -> int:
    """How many modes, of all and of those that have no positive stiffness.

    Raises:
        ElasticError: it is no such number.
    """
    if given is None:
        return count
    if isinstance(given, bool) or not isinstance(given, (int, np.integer)):
        raise ElasticError(f"modes is a whole number, or None for all, not {in_short(given)}")
    if not max(first, 1) <= given <= count:
        loose = f", of which the first {first} have no positive stiffness" if first else ""
        raise ElasticError(
            f"modes must be from {max(first, 1)} to {count}, not {int(given)}: the mesh has "
            f"{count} modes{loose}"
        )
    return int(given)


def _damping_given(given: ArrayLike, many: int, is_all: bool) -> FloatArray:
    """(n,) modal ratios.

    Raises:
        ElasticError: they are none, or not one or one a mode.
    """
    try:
        ratios = np.asarray(given, np.float64)
    except (TypeError, ValueError):
        ratios = np.array(np.nan)
    if not (np.isfinite(ratios) & (ratios >= 0.0)).all():
        raise ElasticError(
            f"a modal damping ratio is a number from 0, such as 0.01 for 1 %, not {in_short(given)}"
        )
    if ratios.ndim == 0:
        return np.full(many, float(ratios))
    if ratios.shape != (many,):
        hint = (
            f"; with modes={ratios.size} these are taken alone"
            if is_all and ratios.ndim == 1
            else ""
        )
        raise ElasticError(
            f"there are {ratios.size} damping ratios and {many} modes: give one for all, or one "
            f"for each{hint}"
        )
    return ratios.copy()
