# SPDX-License-Identifier: BSD-3-Clause
"""Elastic analysis: with `calls` the only importer of the extension, and like it.

Of a `PackedModel` a coordinate of class FIXED is held at a given value and any other is free; a
deformation of class FIXED is rigid, and any other is elastic. Displacements have three numbers a
node, spins (rotation vectors of small rotations) for orientations, all about the global axes;
that of a planar angle is the third. All arrays are in SI units.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..util.errors import FlexactError
from . import _core
from .arrays import FloatArray, PackedModel
from .calls import names_of, require_room_for

#: How a step towards an equilibrium ends.
ENDINGS = tuple(names_of("step endings"))
_TASKS = names_of("tasks")
#: Bytes for each node and element that the core takes for an elastic analysis.
_OF_ELASTIC = 40_000
#: Motions without stiffness for which room is set aside at first.
_FEW = 12


class ElasticArrays(NamedTuple):
    """Stiffness and mass of a model; NaN where a number is not given."""

    stiffness: FloatArray
    """(6, ne) numbers of ESTIFF."""
    mass: FloatArray
    """(5, ne) numbers of EM."""
    node_mass: FloatArray
    """(6, nn) numbers of XM."""
    notch: FloatArray
    """(6, ne) NaN: as it is; else released, with a stiffness in series [N/m; N m/rad]."""


class ElasticState(NamedTuple):
    """Where all nodes are, and what is stressed."""

    configuration: FloatArray
    """(4, nn) position, Euler parameters or angle."""
    stress: FloatArray
    """(6, ne) [N; N m for deformations that are angles]; of rigid ones the multiplier."""
    reaction: FloatArray
    """(3, nn) of held coordinates, force or moment on the mechanism [N, N m]. Where single Euler
    parameters of an orientation are held it is the moment that does work on twice their change:
    times the cosine of half the angle, the moment that does work on the angle."""


class Waypoint(NamedTuple):
    """What is given to a mechanism."""

    target: FloatArray
    """(4, nn) configuration, of which the held coordinates count."""
    misfit: FloatArray
    """(6, ne) deformations without stress."""
    force: FloatArray
    """(3, nn) dead loads [N, N m]; moments are dual to the spin."""
    gravity: FloatArray
    """(3,) [m/s^2]."""


class RawEquilibrium(NamedTuple):
    """The last state in equilibrium on the way to a waypoint."""

    state: ElasticState
    reached: float
    """Part of the way; 1.0 if all of it."""
    status: str
    """One of `ENDINGS`, of the last step that was tried: done; diverges; inconsistent (rigid
    parts cannot be where they should); unheld (a load on a motion without stiffness)."""
    iterations: int
    steps: int
    residual: float
    """Largest force that is left, relative to the largest one of all, of the last step tried."""
    place: int
    """Where most of it is: 3*node + axis of a coordinate, -1 - (6*element + deformation)."""


class RawLinear(NamedTuple):
    """Increments of a state, k columns."""

    displacement: FloatArray
    """(3, nn, k)."""
    stress: FloatArray
    """(6, ne, k)."""
    reaction: FloatArray
    """(3, nn, k)."""
    loose: FloatArray
    """(3, nn, l) independent motions without stiffness; displacements have nothing of them
    that is determined."""
    negative: int
    """How many stiffnesses are negative: with one the state is unstable."""
    mismatch: FloatArray
    """(k,) what rigid rows could not follow, relative to what was asked."""


class RawModes(NamedTuple):
    """Values in ascending order, and modes of which the largest entry is one."""

    values: FloatArray
    """(k,)."""
    modes: FloatArray
    """(3, nn, k)."""
    loose: int
    """Motions without stiffness: of K + H for frequencies, of K alone for multipliers, which are
    then those of the rest."""
    negative: int
    """How many stiffnesses are negative, of the same."""
    is_complete: bool
    """Whether it is confirmed that no value is missing between those given."""


class RawErrors(NamedTuple):
    """Errors on both sides of zero, infinite where there is none; all of k columns."""

    below: FloatArray
    """(k,)."""
    above: FloatArray
    """(k,)."""
    loose: int
    """Motions of K - square M without stiffness."""
    negative: int
    """How many stiffnesses of it are negative: with one, or one without, nothing was looked for."""


class RawMatrices(NamedTuple):
    """Reduced matrices, (q, q) each."""

    mass: FloatArray
    stiffness: FloatArray
    geometric: FloatArray
    is_determined: bool
    """Whether what is rigid and independent determines all motions."""


def element_stiffness(model: PackedModel, arrays: ElasticArrays) -> tuple[FloatArray, FloatArray]:
    """Stiffness of every element and its constant of torsion and elongation.

    Returns:
        (ne, 6, 6) with notches applied, and (ne,) [m^2].
    """
    require_room_for(model, _OF_ELASTIC)
    stiffness, c_t = _core.find_stiffness(*model, _of_elements(model, arrays))
    return np.moveaxis(stiffness, 2, 0), c_t


def equilibrium(
    model: PackedModel, arrays: ElasticArrays, start: ElasticState, begin: Waypoint, end: Waypoint
) -> RawEquilibrium:
    """From a state in equilibrium under one waypoint to the equilibrium under another.

    What is given is changed in proportion, orientations along the shortest rotation; steps are
    halved where Newton's method does not converge.

    Args:
        model: the model.
        arrays: its stiffness; mass counts with gravity.
        start: a state in equilibrium under `begin`.
        begin: what is given at the start.
        end: what is given at the end.

    Raises:
        ValueError: a shape does not fit, or a number is not finite.
    """
    require_room_for(model, _OF_ELASTIC)
    of_nodes = _of_nodes(model, arrays, start, begin, end)
    of_elements = _of_elements(model, arrays, start.stress, begin.misfit, end.misfit)
    gravity = np.asfortranarray(np.stack([begin.gravity, end.gravity], axis=1), float)
    if gravity.shape != (3, 2) or not np.isfinite(gravity).all():
        raise ValueError("gravity must be three finite numbers")
    configuration, reaction, stress, facts = _core.follow_path(
        *model, of_nodes, of_elements, gravity
    )
    status, reached, iterations, steps, residual, place = facts.tolist()
    if status < 0:
        raise MemoryError("memory does not suffice for an elastic analysis")
    return RawEquilibrium(
        ElasticState(configuration, stress, reaction),
        reached,
        ENDINGS[int(status)],
        int(iterations),
        int(steps),
        residual,
        int(place),
    )


def linear(
    model: PackedModel,
    arrays: ElasticArrays,
    state: ElasticState,
    gravity: FloatArray,
    force: FloatArray,
    misfit: FloatArray,
    shift: FloatArray,
) -> RawLinear:
    """Increments with the tangent K + H(stress) of a state; under unit forces, the compliance.

    Args:
        model: the model.
        arrays: its stiffness.
        state: the state; its stress need not be that of its configuration.
        gravity: (3,) that acts in the state.
        force: (3, nn, k) further loads.
        misfit: (6, ne, k) further deformations without stress.
        shift: (3, nn, k) moves and small turns of what is held; twice the change of an Euler
            parameter that is held alone.

    Raises:
        ValueError: a shape does not fit, or a number is not finite.
        FlexactError: the tangent could not be factorised.
    """
    columns = force.shape[-1]
    nodes, elements = model.nodes.shape[1], model.elements.shape[1]
    given = np.vstack([_columns(array) for array in (force, misfit, shift)])
    if given.shape != (6 * (nodes + elements), columns) or not np.isfinite(given).all():
        raise ValueError("force, misfit and shift must be finite, and of the model's shapes")
    room = columns + _FEW
    answer, facts = _studied(model, arrays, state, gravity, "linear", 0, given, room)
    if facts[1] > _FEW:
        room = columns + int(facts[1])
        answer, facts = _studied(model, arrays, state, gravity, "linear", 0, given, room)
    first, second = 3 * nodes, 3 * nodes + 6 * elements
    found, loose = answer[:, :columns], answer[:first, columns : columns + int(facts[1])]
    return RawLinear(
        found[:first].reshape((3, nodes, columns), order="F"),
        found[first:second].reshape((6, elements, columns), order="F"),
        found[second:-1].reshape((3, nodes, columns), order="F"),
        loose.reshape((3, nodes, loose.shape[1]), order="F"),
        int(facts[2]),
        found[-1].copy(),
    )


def frequencies(
    model: PackedModel,
    arrays: ElasticArrays,
    state: ElasticState,
    gravity: FloatArray,
    count: int,
) -> RawModes:
    """The lowest natural frequencies squared [rad^2/s^2] of (K + H) v = omega^2 M v.

    Directions without mass are condensed; a negative value is an unstable motion, and zero one
    without stiffness. There are fewer than `count` where the mechanism has no more.
    """
    return _modes(model, arrays, state, gravity, "frequencies", count)


def multipliers(
    model: PackedModel,
    arrays: ElasticArrays,
    state: ElasticState,
    gravity: FloatArray,
    count: int,
) -> RawModes:
    """The buckling multipliers nearest to zero: det(K + multiplier H(stress)) = 0."""
    return _modes(model, arrays, state, gravity, "multipliers", count)


def errors(
    model: PackedModel,
    arrays: ElasticArrays,
    state: ElasticState,
    gravity: FloatArray,
    stresses: FloatArray,
    square: float = 0.0,
    lengths: FloatArray | None = None,
) -> RawErrors:
    """The values d nearest to zero with det(K - square M + d H(stress)) = 0, for each stress.

    For square 0 these are the errors at which it buckles; for another one those at which a
    frequency has this square [rad^2/s^2]. All use one factor of K - square M.

    Args:
        model: the model.
        arrays: its stiffness and mass.
        state: a state without stress.
        gravity: (3,) that acts in it.
        stresses: (6, ne, k) of a unit error each.
        square: below that of the lowest frequency.
        lengths: (k,) of a unit error each, positive: only errors that are about as short as the
            shortest are looked for, those of others are infinite. The shortest is found the
            faster, the earlier it stands.

    Raises:
        ValueError: a shape does not fit, or a number is not finite.
    """
    nodes, elements, k = model.nodes.shape[1], model.elements.shape[1], stresses.shape[-1]
    if stresses.shape != (6, elements, k) or not (
        np.isfinite(stresses).all() and math.isfinite(square)
    ):
        raise ValueError("stresses must be finite, and of the model's elements")
    if not k:
        return RawErrors(np.zeros(0), np.zeros(0), 0, 0)
    given = np.zeros((6 * (nodes + elements), k))
    given[3 * nodes : 3 * nodes + 6 * elements] = _columns(stresses)
    given[0, 0] = square
    given[1] = 0.0 if lengths is None else lengths
    answer, facts = _studied(model, arrays, state, gravity, "errors", 0, given, k)
    limit = np.finfo(float).max
    below, above = (
        np.where(np.abs(row) >= limit, np.copysign(np.inf, row), row) for row in answer[:2]
    )
    return RawErrors(below, above, int(facts[1]), int(facts[2]))


def matrices(
    model: PackedModel,
    arrays: ElasticArrays,
    state: ElasticState,
    gravity: FloatArray,
    independent: tuple[int, ...],
) -> RawMatrices:
    """Mass, stiffness and geometric stiffness in independent coordinates.

    Args:
        model: the model.
        arrays: its stiffness and mass.
        state: the state.
        gravity: (3,) that acts in it.
        independent: (q,) 3*node + axis of a coordinate, an Euler parameter for an orientation,
            or -1 - (6*element + deformation).

    Raises:
        ValueError: there is no such coordinate or deformation.
    """
    nodes, elements = model.nodes.shape[1], model.elements.shape[1]
    if any(not -6 * elements <= place < 3 * nodes for place in independent):
        raise ValueError("an independent coordinate is none of the model's")
    q = len(independent)
    if not q:
        none = np.zeros((0, 0))
        return RawMatrices(none, none, none, False)
    given = np.zeros((6 * (nodes + elements), q))
    given[0] = independent
    answer, facts = _studied(model, arrays, state, gravity, "matrices", 0, given, 3 * q)
    mass, stiffness, geometric = (answer[:q, i * q : (i + 1) * q].copy() for i in range(3))
    return RawMatrices(mass, stiffness, geometric, facts[3] == 1)


def _modes(
    model: PackedModel,
    arrays: ElasticArrays,
    state: ElasticState,
    gravity: FloatArray,
    task: str,
    count: int,
) -> RawModes:
    nodes = model.nodes.shape[1]
    given = np.zeros((6 * (nodes + model.elements.shape[1]), 1))
    room = max(1, count)
    answer, facts = _studied(model, arrays, state, gravity, task, count, given, room)
    k = int(facts[0])
    modes = answer[: 3 * nodes, :k].reshape((3, nodes, k), order="F")
    return RawModes(answer[-1, :k].copy(), modes, int(facts[1]), int(facts[2]), facts[3] == 1)


def _studied(
    model: PackedModel,
    arrays: ElasticArrays,
    state: ElasticState,
    gravity: FloatArray,
    task: str,
    count: int,
    given: FloatArray,
    room: int,
) -> tuple[FloatArray, FloatArray]:
    require_room_for(model, _OF_ELASTIC)
    rows = given.shape[0] + 1
    answer = np.zeros((rows, room), order="F")
    wishes = np.array((_TASKS[task], count, *gravity), float)
    if not np.isfinite(wishes).all():
        raise ValueError("gravity must be three finite numbers")
    columns = np.zeros((rows, given.shape[1]), order="F")
    columns[:-1] = given
    facts = _core.study_state(
        *model,
        _of_nodes(model, arrays, state),
        _of_elements(model, arrays, state.stress),
        wishes,
        columns,
        answer,
    )
    if facts[4] == 1:
        raise FlexactError(
            "the matrices of this state could not be decomposed: its numbers differ too much in "
            "size, or memory does not suffice"
        )
    return answer, facts


def _of_nodes(
    model: PackedModel, arrays: ElasticArrays, state: ElasticState, *waypoints: Waypoint
) -> FloatArray:
    parts = [state.configuration, state.reaction]
    for waypoint in waypoints:
        parts += [waypoint.target, waypoint.force]
    return _stacked(model.nodes.shape[1], [arrays.node_mass], parts)


def _of_elements(model: PackedModel, arrays: ElasticArrays, *parts: FloatArray) -> FloatArray:
    given = [arrays.stiffness, arrays.mass, arrays.notch]
    return _stacked(model.elements.shape[1], given, list(parts))


def _stacked(size: int, given: list[FloatArray], parts: list[FloatArray]) -> FloatArray:
    """Arrays one above the other; only what is given may be NaN."""
    if any(part.ndim != 2 or part.shape[1] != size for part in (*given, *parts)):
        raise ValueError("the arrays are not of the model's size")
    if not all(np.isfinite(part).all() for part in parts):
        raise ValueError("a number of a state or of what is given is not finite")
    return np.asfortranarray(np.vstack([*given, *parts]), np.float64)


def _columns(array: FloatArray) -> FloatArray:
    return array.reshape((array.shape[0] * array.shape[1], -1), order="F")
