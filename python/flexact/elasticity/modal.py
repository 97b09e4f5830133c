# SPDX-License-Identifier: BSD-3-Clause
"""All modes of a mesh about a state, with what has no mass, and how supports are followed.

The tangent K + H and the mass M of all free coordinates are those of the core; what is rigid is
taken out by a basis of the motions that it leaves. Soft bending beside stiff elongation would cost
all digits of the low frequencies in a stiffness matrix; so its factor is decomposed, strains times
the root of the elements' stiffness, which costs half of them.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..core import calls, elastic
from ..core.arrays import FloatArray
from ..core.elements import Class, NodeKind
from ..util.matrices import null_space
from .errors import ElasticError
from .points import Coordinate
from .solution import Solution, packed_with

#: What is rigid follows a support where no more than this part of what it asks is left.
_FOLLOWED = 1.0e-6
#: Free coordinates of a mesh beyond which its matrices are not decomposed.
MOST = 2500
#: Rigid rows of which no more is left than this, of 1, depend on others.
_DEPENDENT = 1.0e-9
#: Motions whose stiffness and mass are below the square of this, of 1, have neither.
_NOTHING = 1.0e-12
#: Eigenvalues of the mass below this, of 1, with 1 on its diagonal, are rounding.
_MASSLESS = 1.0e-13
#: Modes so many times as fast as the slowest are without mass.
_LIGHT = 1.0e-9
#: Squares below this part of the lowest other one are zero.
_ZERO = 1.0e-8
#: An orientation of which the cosine of half the angle is smaller is half a turn away.
_HALF_TURN = 1.0e-6


class Modes(NamedTuple):
    """Motions (3 nodes, k) of a mesh, in displacements and spins, by node and axis."""

    square: FloatArray
    """(n,) squares of the angular frequencies [rad^2/s^2], ascending; 0 without a stiffness."""
    shape: FloatArray
    """(3 nodes, n) of them, each with a modal mass of 1 kg."""
    massless: FloatArray
    """(3 nodes, s) motions without mass, each with a stiffness of 1 N/m in size."""
    sign: FloatArray
    """(s,) of these stiffnesses: -1 where one has buckled."""
    lost: FloatArray
    """(3 nodes, l) motions with neither stiffness nor mass."""
    follow: FloatArray
    """(3 nodes, k) what follows unit motions of supports, slowly: in equilibrium."""
    carried: FloatArray
    """(n, k) what each mode has of the momentum of these, phi' M follow."""


def modes_of(at: Solution, moved: FloatArray) -> Modes:
    """Of a state of one mesh.

    Args:
        at: The state.
        moved: (3, nodes, k) unit motions of what is held: displacements, spins, and twice the
            changes of Euler parameters that are held alone.

    Raises:
        ElasticError: the mesh is too large; or a body is half a turn away; or what is rigid does
            not follow; or a motion without mass has no stiffness but that of stress.
    """
    arrays = at.solver.mesh.data.arrays
    given = arrays.coordinate_class
    is_free = given > Class.FIXED
    for node, axis in at.held:
        is_free[axis, node] = False
    # Supports that are moved are coordinates, too, whose motion is known.
    is_moved = moved.any(axis=(0, 2)) & (given != Class.NONE)
    chosen = np.flatnonzero((is_free | is_moved).T.ravel())
    if chosen.size > MOST:
        raise ElasticError(
            f"the mesh has {chosen.size} free coordinates: at most {MOST} are decomposed, so ask "
            "with fewer beams a sheet (beams=4)"
        )
    mapping = _spins_of(at, chosen)
    mass, strain, rows, hessian = _matrices(at, is_free | is_moved, chosen, mapping)
    free = is_free.T.ravel()[chosen]
    scale = np.where((arrays.node_kind > NodeKind.POSITION)[chosen // 3], at.size, 1.0)
    known = _known(at, chosen, moved) * ~free[:, None]

    basis = _basis(rows[:, free] / scale[free]) / scale[free][:, None]
    weight = _root(mass[np.ix_(free, free)]) @ basis
    stiff, bent = strain[:, free] @ basis, basis.T @ hessian[np.ix_(free, free)] @ basis
    square, heavy, light, sign, lost = _decomposed(stiff, bent, weight, _shift(at))
    shape, light = basis @ heavy, basis @ light

    # Least motions that what is rigid asks for, then equilibrium, refined.
    follow = known.copy()
    asked = rows @ follow
    if np.abs(asked).max(initial=0.0) > 0.0:
        least = np.linalg.lstsq(rows[:, free] / scale[free], asked, rcond=_DEPENDENT)[0]
        follow[free] -= least / scale[free][:, None]
        if np.abs(rows @ follow).max() > _FOLLOWED * np.abs(asked).max():
            raise ElasticError("what is rigid does not let this support move by itself")
    soft = square != 0.0
    for _ in range(3):
        force = strain[:, free].T @ (strain @ follow) + hessian[free] @ follow
        follow[free] -= (light * sign) @ (light.T @ force)
        follow[free] -= shape[:, soft] @ ((shape[:, soft].T @ force) / square[soft, None])
    whole = mapping[:, free]
    return Modes(
        square,
        np.asarray(whole @ shape),
        np.asarray(whole @ light),
        sign,
        np.asarray(whole @ (basis @ lost)),
        np.asarray(mapping @ follow),
        np.asarray(shape.T @ mass[free] @ follow),
    )


def _decomposed(
    stiff: FloatArray, bent: FloatArray, weight: FloatArray, shift: float
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray]:
    """Modes of K = stiff'stiff + bent and M = weight'weight, as `Modes` has them.

    In a basis in which stiff'stiff + shift M is one, found from its factor and made exact by
    products with it, K + shift M is positive but where something without mass has buckled.
    """
    both = np.vstack([stiff, np.sqrt(shift) * weight])
    length = np.linalg.norm(both, axis=0)
    length[length == 0.0] = 1.0
    _, values, right = np.linalg.svd(both / length, full_matrices=False)
    there = values > _NOTHING * values.max(initial=0.0)
    lost = right[~there].T / length[:, None]
    inner = right[there].T / values[there] / length[:, None]
    if np.abs(bent @ lost).max(initial=0.0) > _ZERO * np.abs(bent).max(initial=0.0):
        raise ElasticError(_ILL_POSED)
    made = both @ inner
    whole = made.T @ made + inner.T @ bent @ inner
    try:
        factor, is_positive = np.linalg.cholesky(whole), True
        inner = np.linalg.solve(factor, inner.T).T
    except np.linalg.LinAlgError:
        is_positive = False
    _, roots, turned = np.linalg.svd(weight @ inner, full_matrices=False)
    inner, is_heavy = inner @ turned.T, roots > _LIGHT * roots.max(initial=0.0)
    heavy, light, roots = inner[:, is_heavy], inner[:, ~is_heavy], roots[is_heavy]
    square, sign = 1.0 / roots**2, np.ones(light.shape[1])
    heavy = heavy / roots
    if not is_positive:
        # What has no mass is condensed.
        whole = turned @ whole @ turned.T
        values, vectors = np.linalg.eigh(whole[np.ix_(~is_heavy, ~is_heavy)])
        if np.abs(values).min(initial=1.0) < _ZERO * np.abs(values).max(initial=0.0):
            raise ElasticError(_ILL_POSED)
        sign, vectors = np.sign(values), vectors / np.sqrt(np.abs(values))
        light = light @ vectors
        across = vectors.T @ whole[np.ix_(~is_heavy, is_heavy)] / roots
        inside = whole[np.ix_(is_heavy, is_heavy)] / np.outer(roots, roots)
        square, vectors = np.linalg.eigh(inside - across.T @ (sign[:, None] * across))
        heavy = (heavy - light @ (sign[:, None] * across)) @ vectors
    square = np.where(np.abs(square - shift) < _ZERO * shift, 0.0, square - shift)
    return square, heavy, light, sign, lost


_ILL_POSED = (
    "a motion without mass has no stiffness, or one that only stress gives it: give what moves a "
    "mass (EM, XM), or a material with a density"
)


def _spins_of(at: Solution, chosen: np.ndarray) -> FloatArray:
    """(3 nodes, q) displacements and spins of unit changes of coordinates; Euler parameters too."""
    arrays = at.solver.mesh.data.arrays
    made = np.zeros((3 * arrays.node_number.size, chosen.size))
    made[chosen, np.arange(chosen.size)] = 1.0
    for node in np.flatnonzero(arrays.node_kind == NodeKind.ORIENTATION).tolist():
        mine = np.flatnonzero(chosen // 3 == node)
        if mine.size:
            block = np.linalg.inv(_parameters(at, node))
            made[3 * node : 3 * node + 3, mine] = block[:, chosen[mine] % 3]
    return made


def _parameters(at: Solution, node: int) -> FloatArray:
    """(3, 3) changes of the Euler parameters 1 to 3 with the spin: (l0 + l x)/2, by columns."""
    euler = at.raw.configuration[:, node] / np.linalg.norm(at.raw.configuration[:, node])
    if abs(euler[0]) < _HALF_TURN:
        number = int(at.solver.mesh.data.arrays.node_number[node])
        raise ElasticError(f"node {number} is turned by half a turn: its coordinates end there")
    l0, a, b, c = euler.tolist()
    return np.array([[l0, c, -b], [-c, l0, a], [b, -a, l0]]) / 2.0


def _known(at: Solution, chosen: np.ndarray, moved: FloatArray) -> FloatArray:
    """(q, k) changes of the coordinates of supports under unit motions of them."""
    arrays, made = at.solver.mesh.data.arrays, np.zeros((chosen.size, moved.shape[2]))
    for i, place in enumerate(chosen.tolist()):
        node, axis = divmod(place, 3)
        made[i] = moved[axis, node]
        if arrays.node_kind[node] == NodeKind.ORIENTATION:
            made[i] = moved[axis, node] / 2.0
            if at.is_whole(node):
                made[i] = _parameters(at, node)[axis] @ moved[:, node]
    return made


def _matrices(
    at: Solution, is_open: np.ndarray, chosen: np.ndarray, mapping: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Mass (q, q); strains times the root of the stiffness; rigid rows; and H (q, q)."""
    solver, arrays = at.solver, at.solver.mesh.data.arrays
    own = arrays.deformation_class
    # With a notch in series a rigid deformation is as stiff as that; others are rows here.
    notched = solver.is_elastic & solver.mesh.rigid(solver.policy.rigid)
    kept = np.where(own == Class.NONE, own, np.where(notched, Class.FIXED, Class.DEPENDENT))
    given = arrays.coordinate_class
    opened = np.where(given == Class.NONE, given, np.where(is_open, Class.DEPENDENT, Class.FIXED))
    model = packed_with(arrays, opened, kept)
    raw = elastic.matrices(model, solver.arrays, at.raw, at.way.gravity, tuple(chosen.tolist()))
    hessian = raw.geometric + _of_angles(at, chosen, mapping)

    stiffness, c_t = solver.elastic
    stiffness = np.where(solver.is_elastic.T[:, :, None], stiffness, 0.0)
    stiffness = np.where(solver.is_elastic.T[:, None, :], stiffness, 0.0)
    stiffness[notched.T] = stiffness.transpose(0, 2, 1)[notched.T] = 0.0
    for k, e in np.argwhere(notched).tolist():
        stiffness[e, k, k] = solver.arrays.notch[k, e]
    values, vectors = np.linalg.eigh(stiffness)
    root = np.sqrt(np.maximum(values, 0.0))[:, :, None] * vectors.transpose(0, 2, 1)

    found = calls.assemble(solver.mesh.data.packed, at.raw.configuration, c_t)
    elements = stiffness.shape[0]
    derivative = np.zeros((6 * elements, mapping.shape[0]))
    derivative[found.row_of, found.column_of] = found.value
    derivative = derivative @ mapping
    strain = (root @ derivative.reshape(elements, 6, -1)).reshape(6 * elements, -1)
    rows = derivative[((own != Class.NONE) & ~solver.is_elastic).T.ravel()]
    return raw.mass, strain, rows, hessian


def _of_angles(at: Solution, chosen: np.ndarray, mapping: FloatArray) -> FloatArray:
    """What a moment that stays constant on an angle adds to one constant on its Euler parameter.

    Second derivatives of 2 asin(lambda), beside those of 2 lambda, times the reaction; as
    `reaction_hessian` of the core, which is asked on parameters.
    """
    made = np.zeros((chosen.size, chosen.size))
    arrays, reaction = at.solver.mesh.data.arrays, at.raw.reaction
    for node in np.flatnonzero((arrays.node_kind == NodeKind.ORIENTATION) & reaction.any(axis=0)):
        if any(at.is_held(Coordinate(int(node), axis)) for axis in range(3)):
            continue
        euler = at.raw.configuration[:, node] / np.linalg.norm(at.raw.configuration[:, node])
        for axis, row in enumerate(_parameters(at, int(node))):
            changed = row @ mapping[3 * node : 3 * node + 3]
            part = reaction[axis, node] * euler[1 + axis] / 2.0
            made -= part * np.outer(changed, changed) / (row @ row)
    return made


def _basis(rows: FloatArray) -> FloatArray:
    """(q, r) the motions that rigid rows leave; what they do not touch stays as it is."""
    length = np.linalg.norm(rows, axis=1)
    rows = rows[length > 0.0] / length[length > 0.0, None]
    touched = rows.any(axis=0)
    inner = null_space(rows[:, touched], _DEPENDENT)
    made = np.zeros((rows.shape[1], np.count_nonzero(~touched) + inner.shape[1]))
    made[np.flatnonzero(~touched), np.arange(np.count_nonzero(~touched))] = 1.0
    made[np.ix_(touched, np.arange(made.shape[1]) >= np.count_nonzero(~touched))] = inner
    return made


def _root(mass: FloatArray) -> FloatArray:
    """A factor R of the mass, R'R, exact for what is light beside what is heavy, too."""
    diagonal = np.sqrt(np.maximum(np.diagonal(mass), 0.0))
    there = np.where(diagonal > 0.0, diagonal, 1.0)
    values, vectors = np.linalg.eigh(mass / np.outer(there, there))
    values = np.where(values > _MASSLESS, values, 0.0)
    return np.asarray(np.sqrt(values)[:, None] * vectors.T * diagonal)


def _shift(at: Solution) -> float:
    """What makes K + shift M positive, and is as small as the lowest square."""
    found = at.squares.values
    size = np.abs(found[found != 0.0])
    least = float(size.min()) if size.size else 1.0
    return least + 2.0 * max(0.0, -float(found.min(initial=0.0)))
