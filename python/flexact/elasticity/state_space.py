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

import os
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import FloatArray
from ..core.elements import Class, NodeKind
from ..util.errors import FlexactError
from ..util.loading import load
from ..util.text import in_short
from ..util.units import METRES, Units
from .equilibria import misalignment
from .errors import ElasticError
from .linear_system import FORCE, MOTION, PLACE, VELOCITY, LeftOut, LinearSystem, Signal
from .modal import modes_of
from .points import Points
from .solution import Solution

#: All that is held, as a point of base motion.
GROUND = "ground"
_COORDINATES = ("x", "y", "z", "rx", "ry", "rz")
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


@dataclass(frozen=True, eq=False, repr=False)
class StateSpace(LinearSystem):
    """The linear system of a state; made by `state_space` of `Elastic` or of a state."""

    def to_scipy(self) -> Any:
        """A `scipy.signal.StateSpace`.

        Raises:
            FlexactError: scipy is missing.
        """
        return _package("scipy.signal").StateSpace(self.A, self.B, self.C, self.D)

    def to_control(self) -> Any:
        """A `control.StateSpace` of the Python Control Systems Library, with names.

        Raises:
            FlexactError: the package is missing.
        """
        ends = ("inputs", self.inputs), ("outputs", self.outputs)
        names = {which: [each.label for each in signals] for which, signals in ends}
        return _package("control").ss(self.A, self.B, self.C, self.D, **names)

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
        load("flexact.elasticity.system_files").TRANSFERS.save(self, self.data, Path(path))

    def __repr__(self) -> str:
        """From what to what, and how many modes."""
        ends = (", ".join(e.label for e in each) for each in (self.inputs, self.outputs))
        return f"<StateSpace from {' to '.join(ends)}: {self.square.size} modes, {self.label}>"


_MISSING = {
    "scipy.signal": "this needs the package scipy: pip install scipy",
    "control": "this needs the package control: pip install control",
}


def _package(name: str) -> Any:
    try:
        return load(name)
    except ImportError:
        raise FlexactError(_MISSING[name]) from None


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
    """(3, nodes) a unit motion of a clamp, of all that is held, or of a locked drive; if it turns.

    Raises:
        UnknownError: it is not there.
        ElasticError: it is not held.
    """
    data = points.data
    made = np.zeros((3, points.kinds.size))
    if point == GROUND and GROUND not in data.node_names:
        axes = (
            {"x": 0, "y": 1, "rz": 2} if data.planar else {c: k for k, c in enumerate(_COORDINATES)}
        )
        held = data.arrays.coordinate_class == Class.FIXED
        for node, axis in at.held:
            held[axis, node] = True
        turns, is_turn = points.kinds > NodeKind.POSITION, name.startswith("r")
        if name in axes:
            direction = np.eye(3)[axes[name] % 3]
            arm = data.arrays.node_value[:3, ~turns].T
            made[:, ~turns] = (np.cross(direction, arm) if is_turn else direction + 0.0 * arm).T
            made[:, turns] = is_turn * direction[:, None]
        made *= held
        if not made.any():
            raise ElasticError(f"nothing is held that moves with the ground along {name}")
        return made, is_turn
    coordinate = points.coordinate(point, name)
    is_turn = bool(points.kinds[coordinate.node] > NodeKind.POSITION)
    if coordinate in at.held:
        made[coordinate.axis, coordinate.node] = 1.0
        return made, is_turn
    if not at.is_held(coordinate):
        raise ElasticError(
            f"{points.words(coordinate)} is not held, so that its motion is none of the inputs: "
            f"a force on it is ({point!r}, {name!r})"
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
