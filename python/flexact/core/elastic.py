# SPDX-License-Identifier: BSD-3-Clause
"""Elastic analysis: with `calls` the only importer of the extension, and like it.

Of a `PackedModel` a coordinate of class FIXED is held at a given value and any other is free; a
deformation of class FIXED is rigid, and any other is elastic. Displacements have three numbers a
node, spins (rotation vectors of small rotations) for orientations, all about the global axes;
that of a planar angle is the third. All arrays are in SI units.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..util.errors import FlexactError
from . import _core
from .arrays import FloatArray, PackedModel
from .calls import names_of, require_room_for

#: How a step towards an equilibrium ends.
ENDINGS = tuple(names_of("step endings"))
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
    """(s, k), of s squares."""
    above: FloatArray
    """(s, k)."""
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
    given = (arrays.stiffness, arrays.notch)
    stiffness, c_t = _core.find_stiffness(*model, *(np.asfortranarray(each) for each in given))
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
    both = (begin, end)
    # The state changes in place.
    study = _Study(*(each.copy("F") for each in _study(model, arrays, start)))
    status, reached, iterations, steps, residual, place = _core.follow_path(
        *model,
        *study,
        _of(model, "a target", [each.target for each in both], (4, _NODES)),
        _of(model, "a misfit", [each.misfit for each in both], (6, _ELEMENTS)),
        _of(model, "a force", [each.force for each in both], (3, _NODES)),
        _gravity(model, [each.gravity for each in both]),
    )
    if status < 0:
        raise MemoryError("memory does not suffice for an elastic analysis")
    return RawEquilibrium(
        ElasticState(study.configuration, study.stress, study.reaction),
        reached,
        ENDINGS[status],
        iterations,
        steps,
        residual,
        place,
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
    if not columns:
        # f2py refuses arrays without columns.
        zeros = (np.zeros((*array.shape[:2], 1)) for array in (force, misfit, shift))
        one = linear(model, arrays, state, gravity, *zeros)
        return one._replace(
            displacement=one.displacement[..., :0],
            stress=one.stress[..., :0],
            reaction=one.reaction[..., :0],
            mismatch=one.mismatch[:0],
        )
    given = (
        *model,
        *_study(model, arrays, state),
        _gravity(model, gravity),
        _of(model, "a force", force, (3, _NODES, columns)),
        _of(model, "a misfit", misfit, (6, _ELEMENTS, columns)),
        _of(model, "a shift", shift, (3, _NODES, columns)),
    )
    found = _core.find_response(_FEW, *given)
    if found[5] > _FEW:
        found = _core.find_response(found[5], *given)
    displacement, stress, reaction, mismatch, loose, unheld, negative, failed = found
    _require_done(failed)
    return RawLinear(displacement, stress, reaction, loose[..., :unheld], negative, mismatch)


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
    return _modes(model, arrays, state, gravity, count, of_buckling=False)


def multipliers(
    model: PackedModel,
    arrays: ElasticArrays,
    state: ElasticState,
    gravity: FloatArray,
    count: int,
) -> RawModes:
    """The buckling multipliers nearest to zero: det(K + multiplier H(stress)) = 0."""
    return _modes(model, arrays, state, gravity, count, of_buckling=True)


def errors(
    model: PackedModel,
    arrays: ElasticArrays,
    state: ElasticState,
    gravity: FloatArray,
    stresses: FloatArray,
    squares: Sequence[float] = (0.0,),
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
        squares: (s,) below that of the lowest frequency.
        lengths: (k,) of a unit error each, positive: only errors that are about as short as the
            shortest are looked for, those of others are infinite. The shortest is found the
            faster, the earlier it stands.

    Raises:
        ValueError: a shape does not fit, or a number is not finite.
    """
    k = stresses.shape[-1]
    stresses = _of(model, "a stress", stresses, (6, _ELEMENTS, k))
    if not np.isfinite(squares).all():
        raise ValueError("a square is not finite")
    if not k:
        none = np.zeros((len(squares), 0))
        return RawErrors(none, none, 0, 0)
    below, above, loose, negative, failed = _core.find_errors(
        *model,
        *_study(model, arrays, state),
        _gravity(model, gravity),
        np.array(squares, np.float64),
        stresses,
        np.zeros(k) if lengths is None else np.ascontiguousarray(lengths, float),
    )
    _require_done(failed)
    limit = np.finfo(float).max
    below, above = (
        np.where(np.abs(row) >= limit, np.copysign(np.inf, row), row) for row in (below, above)
    )
    return RawErrors(below, above, loose, negative)


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
    if not independent:
        none = np.zeros((0, 0))
        return RawMatrices(none, none, none, False)
    mass, stiffness, geometric, determined, failed = _core.find_matrices(
        *model,
        *_study(model, arrays, state),
        _gravity(model, gravity),
        np.array(independent, np.int32),
    )
    _require_done(failed)
    return RawMatrices(mass, stiffness, geometric, determined == 1)


def _modes(
    model: PackedModel,
    arrays: ElasticArrays,
    state: ElasticState,
    gravity: FloatArray,
    count: int,
    of_buckling: bool,
) -> RawModes:
    value, mode, found, loose, negative, complete, failed = _core.find_modes(
        count, *model, *_study(model, arrays, state), _gravity(model, gravity), of_buckling
    )
    _require_done(failed)
    # Copies: what is set aside may be far more than there is.
    return RawModes(
        value[:found].copy(), mode[..., :found].copy("F"), loose, negative, complete == 1
    )


#: Sizes of arrays that are of the nodes and of the elements.
_NODES, _ELEMENTS = -1, -2


def _of(
    model: PackedModel,
    what: str,
    values: FloatArray | list[FloatArray],
    shape: tuple[int, ...],
    may_be_nan: bool = False,
) -> FloatArray:
    """An array for the core, of values or of several one behind the other.

    Raises:
        ValueError: they have another shape, or are not finite.
    """
    sizes = {_NODES: model.nodes.shape[1], _ELEMENTS: model.elements.shape[1]}
    each = values if isinstance(values, list) else [values]
    if any(array.shape != tuple(sizes.get(size, size) for size in shape) for array in each):
        raise ValueError(f"{what} is not of the model's size")
    if not may_be_nan and not all(np.isfinite(array).all() for array in each):
        raise ValueError(f"a number of {what} is not finite")
    made = np.stack(each, axis=-1) if isinstance(values, list) else values
    return np.asfortranarray(made, np.float64)


class _Study(NamedTuple):
    """What is given of a model and of its state, as every call of the core takes it."""

    stiffness: FloatArray
    mass: FloatArray
    notch: FloatArray
    node_mass: FloatArray
    configuration: FloatArray
    stress: FloatArray
    reaction: FloatArray


def _study(model: PackedModel, arrays: ElasticArrays, state: ElasticState) -> _Study:
    """Checked.

    Raises:
        ValueError: a shape is not that of the model, or a number of the state is not finite.
    """
    require_room_for(model, _OF_ELASTIC)
    return _Study(
        _of(model, "the stiffness", arrays.stiffness, (6, _ELEMENTS), may_be_nan=True),
        _of(model, "the mass", arrays.mass, (5, _ELEMENTS), may_be_nan=True),
        _of(model, "a notch", arrays.notch, (6, _ELEMENTS), may_be_nan=True),
        _of(model, "the mass of nodes", arrays.node_mass, (6, _NODES), may_be_nan=True),
        _of(model, "the configuration", state.configuration, (4, _NODES)),
        _of(model, "the stress", state.stress, (6, _ELEMENTS)),
        _of(model, "a reaction", state.reaction, (3, _NODES)),
    )


def _gravity(model: PackedModel, given: FloatArray | list[FloatArray]) -> FloatArray:
    return _of(model, "gravity", given, (3,))


def _require_done(failed: int) -> None:
    if failed:
        raise FlexactError(
            "the matrices of this state could not be decomposed: its numbers differ too much in "
            "size, or memory does not suffice"
        )
