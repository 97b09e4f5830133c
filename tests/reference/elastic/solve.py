# SPDX-License-Identifier: BSD-3-Clause
"""Equilibrium, linear response, frequencies and multipliers by dense matrices.

Section 2 of the theory in its plainest form: rows of rigid deformations and of single Euler
parameters in a matrix J, everything else in its null space.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from jets import Jet, Real, dot
from mechanics import Mechanics, Place, product, quaternion, vector_of
from structure import Structure

ZERO = 1e-9


class NoAnswerError(Exception):
    """What was asked has no answer, or was not found."""


@dataclass
class Load:
    """What drives an equilibrium.

    Attributes:
        force: dead loads (columns,); gravity (3,); misfit: e0 of all rows.
        held: coordinates that are held, (node, axis).
        target: positions of held position nodes, quaternions of wholly held orientation nodes,
            Euler parameters and planar angles of held rotations.
    """

    force: Real
    gravity: Real
    misfit: Real
    place: dict[tuple[int, int], float] = field(default_factory=dict)
    turn: dict[int, Real] = field(default_factory=dict)

    def between(self, other: Load, t: float) -> Load:
        place = {k: (1 - t) * self.place[k] + t * v for k, v in other.place.items()}
        turn = {}
        for node, q in other.turn.items():
            start = self.turn[node]
            step = vector_of(product(q, start * [1, -1, -1, -1]))
            turn[node] = product(quaternion(t * step), start)
        return Load(
            (1 - t) * self.force + t * other.force,
            (1 - t) * self.gravity + t * other.gravity,
            (1 - t) * self.misfit + t * other.misfit,
            place,
            turn,
        )


@dataclass
class Solution:
    """A state: place, stresses of all rows (multipliers of rigid ones), forces of held parameters.

    Attributes:
        parameter_force: multiplier of each singly held Euler parameter (node, axis).
        reaction: force on the mechanism by column, of held coordinates (zero elsewhere).
    """

    place: Place
    stress: Real
    parameter_force: dict[tuple[int, int], float]
    reaction: Real
    load: Load


class Solver:
    """A structure with a policy about its held deformations."""

    def __init__(self, structure: Structure, held: str) -> None:
        self.mechanics = Mechanics(structure)
        self.structure = structure
        m = self.mechanics
        self.rigid = np.zeros(len(m.rows), dtype=bool)
        self.s = np.zeros((len(m.rows), len(m.rows)))
        for label, part in structure.parts.items():
            s = part.matrix()
            count = len(part.classes)
            stiff = np.diag(s)[:count] > 0
            fixed = np.array([name == "fixed" for name in part.classes])
            rigid = fixed if held == "rigid" else fixed & ~stiff
            s[:count][rigid], s[:, :count][:, rigid] = 0, 0
            for k, notch in part.notches.items():
                angular = part.keyword in ("BEAM", "PLBEAM") and k > 0
                value = notch / part.length**2 if angular else notch
                if rigid[k]:
                    rigid[k] = False
                    s[k, k] = value
                elif s[k, k] + value > 0:
                    s = s - np.outer(s[k], s[k]) / (s[k, k] + value)
            at = [m.row[label, k] for k in range(count)]
            self.s[np.ix_(at, at)] = s[:count, :count]
            self.rigid[at] = rigid

    # -- what is held ------------------------------------------------------------------------

    def split(
        self, held: set[tuple[int, int]]
    ) -> tuple[list[int], list[tuple[int, int]], list[int]]:
        """Free columns; singly held Euler parameters; wholly held spatial orientation nodes."""
        m, kinds = self.mechanics, self.structure.kinds
        free, parameters, whole = [], [], []
        for i, (node, axis) in enumerate(m.columns):
            if kinds[node] == "p" or self.structure.planar:
                if (node, axis) not in held:
                    free.append(i)
                continue
            if all((node, a) in held for a in range(3)):
                if axis == 0:
                    whole.append(node)
                continue
            free.append(i)
            if (node, axis) in held:
                parameters.append((node, axis))
        return free, parameters, whole

    def parameter_rows(self, place: Place, parameters: list[tuple[int, int]]) -> Real:
        rows = np.zeros((len(parameters), self.mechanics.size))
        for i, (node, axis) in enumerate(parameters):
            q = place.turn[node]
            # d lambda = (lambda0 w + w x lambda)/2
            row = 0.5 * (q[0] * np.eye(3) + np.cross(np.eye(3), q[1:]).T)[axis]
            for a in range(3):
                rows[i, self.mechanics.column[node, a]] = row[a]
        return rows

    def tangent_parts(
        self, place: Place, stress: Real, forces: dict[tuple[int, int], float], gravity: Real
    ) -> tuple[Real, Real, Real, Real, Real]:
        """e, D, K, H and the force of gravity; H with gravity and held Euler parameters."""
        m = self.mechanics
        e, d, second = m.deformations(place)
        k = d.T @ self.s @ d
        weight, potential = m.gravity(place, gravity)
        h = m.geometric(second, stress) + potential
        for (node, axis), value in forces.items():
            for a in range(3):
                i = m.column[node, a]
                h[i, i] += value * -0.25 * place.turn[node][1 + axis]
        return e, d, k, h, weight

    # -- null space --------------------------------------------------------------------------

    def null_space(self, rows: Real, free: list[int]) -> tuple[Real, Real, int]:
        """Basis of motions (columns, k) that the rows allow, a pseudoinverse, and the rank."""
        m = self.mechanics
        scale = m.scale[free]
        scaled = rows[:, free] * scale
        norms = np.linalg.norm(scaled, axis=1)
        norms[norms == 0] = 1
        basis = np.zeros((m.size, len(free)))
        inverse = np.zeros((m.size, len(rows)))
        rank = 0
        v = np.eye(len(free))
        if len(rows) and free:
            u, sigma, vt = np.linalg.svd(scaled / norms[:, None])
            rank = int(np.sum(sigma > ZERO * max(1.0, sigma[0])))
            v = vt.T
            inverse[free] = scale[:, None] * (v[:, :rank] / sigma[:rank]) @ (u[:, :rank].T / norms)
        basis[free] = scale[:, None] * v
        return basis[:, rank:], inverse, rank

    # -- equilibrium -------------------------------------------------------------------------

    def load_at_rest(self, held: set[tuple[int, int]]) -> Load:
        m = self.mechanics
        load = Load(np.zeros(m.size), np.zeros(3), np.zeros(len(m.rows)))
        return self.hold(load, m.at_rest(), held)

    def hold(self, load: Load, place: Place, held: set[tuple[int, int]]) -> Load:
        """The same load with these coordinates held where they are."""
        _, _, whole = self.split(held)
        targets = {}
        for node, axis in held:
            if self.structure.kinds[node] == "p":
                targets[node, axis] = float(place.position[node][axis])
            elif self.structure.planar:
                targets[node, axis] = place.angle[node]
            elif node not in whole:
                targets[node, axis] = float(place.turn[node][1 + axis])
        turns = {node: place.turn[node].copy() for node in whole}
        return Load(load.force, load.gravity, load.misfit, targets, turns)

    def equilibrium(self, start: Solution, end: Load, first: float = 1.0) -> Solution:
        """From one equilibrium to another; steps, at most `first`, are halved where it fails."""
        begin = start.load
        t, step, now = 0.0, first, start
        while t < 1:
            t_next = min(1.0, t + step)
            load = begin.between(end, t_next)
            found = self._newton(now, load)
            if found is None:
                step /= 2
                if step < 1e-4:
                    raise NoAnswerError(f"no equilibrium beyond {t:.6g} of the way")
                continue
            now, t = found, t_next
            step = min(1.5 * step, first)
        return Solution(now.place, now.stress, now.parameter_force, now.reaction, end)

    def _residual_of_place(self, place: Place, load: Load, free: list[int]) -> Real:
        """What held coordinates still lack, by column (zero for free ones)."""
        m = self.mechanics
        lack = np.zeros(m.size)
        for (node, axis), target in load.place.items():
            if self.structure.kinds[node] == "p":
                lack[m.column[node, axis]] = target - place.position[node][axis]
            elif self.structure.planar:
                lack[m.column[node, axis]] = target - place.angle[node]
        for node, q in load.turn.items():
            step = vector_of(product(q, place.turn[node] * [1, -1, -1, -1]))
            for axis in range(3):
                lack[m.column[node, axis]] = step[axis]
        lack[free] = 0
        return lack

    def _newton(self, start: Solution, load: Load) -> Solution | None:
        m = self.mechanics
        held = set(load.place) | {(node, a) for node in load.turn for a in range(3)}
        free, parameters, _ = self.split(held)
        place, stress, forces = start.place, start.stress.copy(), dict(start.parameter_force)
        forces = {label: forces.get(label, 0.0) for label in parameters}
        last = np.inf
        for iteration in range(60):
            e, d, k, h, weight = self.tangent_parts(place, stress, forces, load.gravity)
            strain = e - load.misfit
            lack = self._residual_of_place(place, load, free)
            parameter_rows = self.parameter_rows(place, parameters)
            rows = np.vstack([d[self.rigid], parameter_rows])
            wanted = np.concatenate(
                [
                    -strain[self.rigid],
                    [load.place[n, a] - place.turn[n][1 + a] for n, a in parameters],
                ]
            )
            wanted = wanted - rows @ lack
            z, inverse, _ = self.null_space(rows, free)
            elastic = self.s @ strain
            particular = lack + inverse @ wanted
            tangent = k + h
            pull = load.force + weight - d.T @ elastic
            y, *_ = (
                np.linalg.lstsq(
                    *_equilibrated(z.T @ tangent @ z, z.T @ (pull - tangent @ particular)),
                    rcond=1e-14,
                )
                if z.shape[1]
                else (np.zeros(0),)
            )
            if z.shape[1]:
                y = y * _diagonal(z.T @ tangent @ z)
            change = particular + z @ y
            turn = np.max(np.abs(change[m.is_spin]), initial=0.0)
            multipliers = inverse.T @ (pull - tangent @ change)
            count = int(np.sum(self.rigid))
            stress = self.s @ (strain + d @ change)
            stress[self.rigid] = multipliers[:count]
            forces = dict(zip(parameters, multipliers[count:].tolist(), strict=True))
            limit = min(1.0, 0.35 / turn) if turn > 0 else 1.0
            if not np.all(np.isfinite(change)):
                return None
            place = m.moved(place, limit * change)
            size = float(np.linalg.norm(change / m.scale)) / self.mechanics.length
            if size > 1e3:
                return None
            if size < 1e-13 or (size < 1e-9 and size >= 0.3 * last and iteration > 2):
                return self._finish(place, load, stress, forces)
            last = size
        return None

    def _finish(
        self, place: Place, load: Load, stress: Real, forces: dict[tuple[int, int], float]
    ) -> Solution | None:
        """The state, if rigid deformations and equilibrium hold there."""
        m = self.mechanics
        e, d, _, _, weight = self.tangent_parts(place, stress, forces, load.gravity)
        strain = e - load.misfit
        if np.any(np.abs(strain[self.rigid]) > 1e-9 * max(1.0, m.length)):
            return None
        exact = self.s @ strain
        exact[self.rigid] = stress[self.rigid]
        reaction = d.T @ exact - load.force - weight
        held = set(load.place) | {(node, a) for node in load.turn for a in range(3)}
        free, parameters, _ = self.split(held)
        rows = self.parameter_rows(place, parameters)
        left = (reaction + rows.T @ np.array([forces[label] for label in parameters]))[free]
        size = np.max(np.abs(d).T @ np.abs(exact), initial=0.0)
        rounding = 1e-13 * np.max(np.abs(d).T @ np.diag(self.s), initial=0.0) * m.length
        if np.max(np.abs(left), initial=0.0) > 1e-7 * size + rounding:
            return None
        reaction[free] = 0
        return Solution(place, exact, forces, reaction, load)

    # -- about a state -----------------------------------------------------------------------

    def basis(self, state: Solution, held: set[tuple[int, int]]) -> Real:
        """Motions that rigid deformations and these held coordinates allow."""
        free, parameters, _ = self.split(held)
        _, d, _ = self.mechanics.deformations(state.place)
        rows = np.vstack([d[self.rigid], self.parameter_rows(state.place, parameters)])
        return self.null_space(rows, free)[0]

    def matrices(self, state: Solution, held: set[tuple[int, int]]) -> tuple[Real, Real, Real]:
        """K, H and M of all columns; an Euler parameter that is let free keeps its moment."""
        forces = {label: f for label, f in state.parameter_force.items() if label in held}
        _, _, k, h, _ = self.tangent_parts(state.place, state.stress, forces, state.load.gravity)
        for (node, axis), force in state.parameter_force.items():
            if (node, axis) not in held:
                at = [self.mechanics.column[node, a] for a in range(3)]
                h[np.ix_(at, at)] += angle_hessian(state.place.turn[node], axis, force)
        return k, h, self.mechanics.mass(state.place)

    def compliance(self, state: Solution, held: set[tuple[int, int]]) -> Real:
        """Displacements of all columns under unit loads on all columns."""
        z = self.basis(state, held)
        k, h, _ = self.matrices(state, held)
        tangent = z.T @ (k + h) @ z
        scale = _diagonal(tangent)
        return np.asarray(
            z @ (scale[:, None] * np.linalg.inv(tangent * np.outer(scale, scale)) * scale) @ z.T
        )

    def linear(
        self,
        state: Solution,
        held: set[tuple[int, int]],
        force: Real,
        misfit: Real,
        shift: Real,
        follow: bool = False,
    ) -> tuple[Real, Real]:
        """Increments (displacement, stress) under loads, misfits e0 and shifts of held columns."""
        free, parameters, _ = self.split(held)
        _, d, k, h, _ = self.tangent_parts(
            state.place, state.stress, state.parameter_force, state.load.gravity
        )
        rows = np.vstack([d[self.rigid], self.parameter_rows(state.place, parameters)])
        z, inverse, _ = self.null_space(rows, free)
        wanted = np.concatenate([misfit[self.rigid], np.zeros(len(parameters))]) - rows @ shift
        particular = shift + inverse @ wanted
        left = rows @ particular - np.concatenate([misfit[self.rigid], np.zeros(len(parameters))])
        if np.any(np.abs(left) > 1e-9 * (np.abs(shift).max(initial=0) + np.abs(misfit).max())):
            raise NoAnswerError("rigid deformations cannot follow")
        tangent = k + h
        pull = force + d.T @ self.s @ misfit
        matrix = z.T @ tangent @ z
        scale = _diagonal(matrix)
        y = (
            scale
            * np.linalg.lstsq(
                matrix * np.outer(scale, scale),
                scale * (z.T @ (pull - tangent @ particular)),
                rcond=1e-12,
            )[0]
        )
        change = particular + z @ y
        stress = self.s @ (d @ change - misfit)
        multipliers = inverse.T @ (pull - tangent @ change)
        stress[self.rigid] = multipliers[: int(np.sum(self.rigid))]
        return change, stress


def angle_hessian(turn: Real, axis: int, force: float) -> Real:
    """(3, 3) second derivatives of the angle of an Euler parameter, times its moment."""
    w = [Jet.variable(np.zeros(1), a, 3) for a in range(3)]
    i, j = (axis + 1) % 3, (axis + 2) % 3
    first = w[axis] * turn[0] + w[i] * turn[1 + j] - w[j] * turn[1 + i]
    sine = first * 0.5 - dot(w, w) * (turn[1 + axis] / 8) + turn[1 + axis]
    cosine = (sine * sine * -1.0 + 1.0).sqrt()
    # The force on the parameter is twice the moment over the cosine.
    return np.asarray(sine.arctan2(cosine).hessian[0] * (force * cosine.value[0]))


def _diagonal(matrix: Real) -> Real:
    diagonal = np.abs(np.diag(matrix)).copy()
    diagonal[diagonal < 1e-300] = 1.0
    return np.asarray(1 / np.sqrt(diagonal))


def _equilibrated(matrix: Real, right: Real) -> tuple[Real, Real]:
    scale = _diagonal(matrix)
    return matrix * np.outer(scale, scale), scale * right


def squared_frequencies(tangent: Real, mass: Real) -> tuple[Real, Real]:
    """omega^2 ascending with modes as columns; massless directions are condensed.

    Raises:
        NoAnswerError: a massless direction has no stiffness.
    """
    diagonal = np.sqrt(np.maximum(np.diag(mass), 0))
    floor = 1e-12 * diagonal.max(initial=0)
    if diagonal.max(initial=0) == 0:
        raise NoAnswerError("no mass")
    scale = np.where(diagonal > floor, 1 / np.where(diagonal > floor, diagonal, 1.0), 1.0)
    weights, vectors = np.linalg.eigh(mass * np.outer(scale, scale))
    heavy = weights > 1e-11 * weights[-1]
    basis = scale[:, None] * vectors
    r, n = basis[:, heavy] / np.sqrt(weights[heavy]), basis[:, ~heavy]
    k_rr, k_rn, k_nn = r.T @ tangent @ r, r.T @ tangent @ n, n.T @ tangent @ n
    follow = np.zeros((n.shape[1], r.shape[1]))
    if n.shape[1]:
        size = _diagonal(k_nn)
        scaled = k_nn * np.outer(size, size)
        if np.linalg.cond(scaled) > 1e13:
            raise NoAnswerError("a massless direction without stiffness")
        follow = -size[:, None] * np.linalg.solve(scaled, size[:, None] * k_rn.T)
    reduced = k_rr + k_rn @ follow
    values, modes = np.linalg.eigh((reduced + reduced.T) / 2)
    return values, r @ modes + n @ (follow @ modes)


def critical_values(stiffness: Real, geometric: Real) -> Real:
    """All finite m with det(K + m G) = 0, ascending; K is positive definite.

    Raises:
        NoAnswerError: K is singular or indefinite.
    """
    scale = _diagonal(stiffness)
    try:
        lower = np.linalg.cholesky(stiffness * np.outer(scale, scale))
    except np.linalg.LinAlgError:
        raise NoAnswerError("a motion without stiffness") from None
    inner = np.linalg.solve(lower, geometric * np.outer(scale, scale))
    inner = np.linalg.solve(lower, inner.T)
    inverse = np.linalg.eigvalsh((inner + inner.T) / 2)
    size = np.max(np.abs(inverse), initial=0.0)
    return np.sort(-1 / inverse[np.abs(inverse) > 1e-13 * size])
