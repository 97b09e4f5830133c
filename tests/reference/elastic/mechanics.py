# SPDX-License-Identifier: BSD-3-Clause
"""Assembly at a state: deformations, their two derivatives, stiffness, mass and gravity, dense."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass

import numpy as np
from functions import FUNCTIONS, Batch, straight_weight, weight
from jets import Real
from structure import Part, Structure


def quaternion(vector: Real) -> Real:
    angle = float(np.linalg.norm(vector))
    factor = 0.5 * np.sinc(angle / 2 / np.pi)
    return np.array([np.cos(angle / 2), *(factor * vector)])


def product(a: Real, b: Real) -> Real:
    return np.array(
        [a[0] * b[0] - a[1:] @ b[1:], *(a[0] * b[1:] + b[0] * a[1:] + np.cross(a[1:], b[1:]))]
    )


def matrix_of(q: Real) -> Real:
    w, v = q[0], q[1:]
    skew = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    return np.array((w * w - v @ v) * np.eye(3) + 2 * np.outer(v, v) + 2 * w * skew)


def vector_of(q: Real) -> Real:
    """Rotation vector of a quaternion, of an angle up to 2 pi."""
    sine = float(np.linalg.norm(q[1:]))
    if sine == 0:
        return np.zeros(3)
    return np.array(2 * np.arctan2(sine, q[0]) / sine * q[1:])


@dataclass
class Place:
    """A configuration: positions, quaternions and planar angles by node."""

    position: dict[int, Real]
    turn: dict[int, Real]
    angle: dict[int, float]

    def copy(self) -> Place:
        return Place(
            {n: x.copy() for n, x in self.position.items()},
            {n: q.copy() for n, q in self.turn.items()},
            dict(self.angle),
        )


class Mechanics:
    """A structure with numbered coordinates.

    A column is a (node, axis): displacements, and spins about global axes, of which the planar
    one is axis 2.
    """

    def __init__(self, structure: Structure) -> None:
        self.structure = structure
        self.columns = sorted(structure.coordinates)
        self.column = {label: i for i, label in enumerate(self.columns)}
        self.size = len(self.columns)
        self.rows = [
            (label, k) for label, part in structure.parts.items() for k in range(len(part.classes))
        ]
        self.row = {label: i for i, label in enumerate(self.rows)}
        lengths = [part.length for part in structure.parts.values() if part.length > 0]
        self.length = float(np.exp(np.mean(np.log(lengths)))) if lengths else 1.0
        self.is_spin = np.array([structure.kinds[node] == "o" for node, _ in self.columns])
        self.scale = np.where(self.is_spin, 1 / self.length, 1.0)
        groups: dict[str, list[int]] = defaultdict(list)
        for label, part in structure.parts.items():
            groups[part.keyword].append(label)
        self.groups = dict(groups)

    def at_rest(self) -> Place:
        kinds = self.structure.kinds
        return Place(
            {n: x.copy() for n, x in self.structure.position.items()},
            {n: np.array([1.0, 0, 0, 0]) for n, kind in kinds.items() if kind == "o"},
            {n: 0.0 for n, kind in kinds.items() if kind == "o"},
        )

    def moved(self, place: Place, change: Real) -> Place:
        result = place.copy()
        for node, kind in self.structure.kinds.items():
            step = np.zeros(3)
            for axis in range(3):
                if (node, axis) in self.column:
                    step[axis] = change[self.column[node, axis]]
            if kind == "p":
                result.position[node] = result.position[node] + step
            else:
                turned = product(quaternion(step), result.turn[node])
                result.turn[node] = turned / np.linalg.norm(turned)
                result.angle[node] += step[2]
        return result

    def batch(self, place: Place, labels: list[int]) -> Batch:
        parts = [self.structure.parts[label] for label in labels]

        def place_of(end: int) -> Real:
            return np.array([self._position(place, part.nodes[end]) for part in parts])

        def turn_of(end: int) -> Real:
            return np.array([self._turn(place, part.nodes[end]) for part in parts])

        def angle_of(end: int) -> Real:
            return np.array([self._angle(place, part.nodes[end]) for part in parts])

        return Batch(
            np.array([part.frame for part in parts]),
            np.array([part.offset for part in parts]),
            np.array([part.length for part in parts]),
            np.array([part.coupling for part in parts]),
            place_of(0),
            turn_of(1),
            angle_of(1),
            place_of(2),
            turn_of(3),
            angle_of(3),
        )

    def _position(self, place: Place, node: int | None) -> Real:
        return np.zeros(3) if node is None else place.position[node]

    def _turn(self, place: Place, node: int | None) -> Real:
        if node is None:
            return np.eye(3)
        if self.structure.planar:
            c, s = np.cos(place.angle[node]), np.sin(place.angle[node])
            return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])
        return matrix_of(place.turn[node])

    def _angle(self, place: Place, node: int | None) -> float:
        return 0.0 if node is None else place.angle[node]

    def columns_of(self, part: Part) -> list[int]:
        """Twelve columns of an element; -1 where it has none."""
        result = []
        for node in part.nodes:
            result += [-1 if node is None else self.column.get((node, a), -1) for a in range(3)]
        return result

    def deformations(self, place: Place) -> tuple[Real, Real, Real]:
        """e (rows,), D (rows, columns) and second derivatives (rows, 12, 12) by element."""
        e, d = np.zeros(len(self.rows)), np.zeros((len(self.rows), self.size))
        second = np.zeros((len(self.rows), 12, 12))
        for keyword, labels in self.groups.items():
            jets = FUNCTIONS[keyword](self.batch(place, labels))
            for i, label in enumerate(labels):
                part = self.structure.parts[label]
                where = np.array(self.columns_of(part))
                there = np.flatnonzero(where >= 0)
                for k, jet in enumerate(jets):
                    row = self.row[label, k]
                    e[row] = jet.value[i]
                    second[row] = jet.hessian[i]
                    np.add.at(d[row], where[there], jet.gradient[i, there])
        return e, d, second

    def geometric(self, second: Real, stress: Real) -> Real:
        """H(stress), the sum of stresses times second derivatives."""
        result = np.zeros((self.size, self.size))
        for label, part in self.structure.parts.items():
            rows = [self.row[label, k] for k in range(len(part.classes))]
            self._add(result, part, np.einsum("k,kij->ij", stress[rows], second[rows]))
        return result

    def _add(self, matrix: Real, part: Part, block: Real) -> None:
        where = np.array(self.columns_of(part))
        there = np.flatnonzero(where >= 0)
        np.add.at(matrix, np.ix_(where[there], where[there]), block[np.ix_(there, there)])

    def mass(self, place: Place) -> Real:
        m = np.zeros((self.size, self.size))
        shape = np.array(
            [[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]]
        )
        for part in self.structure.parts.values():
            if not part.mass:
                continue
            total = part.mass[0] * part.length
            if part.keyword in ("BEAM", "PLBEAM"):
                velocity = np.zeros((12, 12))  # of (vp, l0 w_p x ax_p, vq, l0 w_q x ax_q)
                for at, node in ((0, 1), (6, 3)):
                    axis = self._turn(place, part.nodes[node]) @ part.frame[:, 0]
                    skew = np.cross(np.eye(3), axis)  # rows e_i x a; w x a = skew' w
                    velocity[at : at + 3, at : at + 3] = np.eye(3)
                    velocity[at + 3 : at + 6, at + 3 : at + 6] = part.length * skew.T
                weights = np.kron(shape, np.eye(3)) * total / 420
                self._add(m, part, velocity.T @ weights @ velocity)
                self._add(m, part, self._rotary(place, part))
            elif part.keyword in ("TRUSS", "PLTRUSS", "RBEAM", "PLRBEAM"):
                block = np.zeros((12, 12))
                for i in (0, 6):
                    for j in (0, 6):
                        block[i : i + 3, j : j + 3] = np.eye(3) * total / (3 if i == j else 6)
                self._add(m, part, block)
        for node, numbers in self.structure.node_mass.items():
            self._add_node_mass(m, place, node, numbers)
        return m

    def _rotary(self, place: Place, part: Part) -> Real:
        numbers = [*part.mass[1:], 0.0, 0.0, 0.0, 0.0][:4]
        if self.structure.planar:
            inertia = np.diag([0, 0, numbers[0]])
        else:
            xx, yy, zz, yz = numbers
            inertia = np.array([[xx, 0, 0], [0, yy, yz], [0, yz, zz]])
        block = np.zeros((12, 12))
        for at, node in ((3, 1), (9, 3)):
            axes = self._turn(place, part.nodes[node]) @ part.frame
            if self.structure.planar:
                axes = np.eye(3)
            block[at : at + 3, at : at + 3] = axes @ inertia @ axes.T * part.length / 2
        return block

    def _add_node_mass(self, m: Real, place: Place, node: int, numbers: list[float]) -> None:
        if self.structure.kinds[node] == "p":
            block = numbers[0] * np.eye(3)
        elif self.structure.planar:
            block = np.diag([0, 0, numbers[0]])
        else:
            xx, xy, xz, yy, yz, zz = [*numbers, *[0.0] * 6][:6]
            inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
            turn = matrix_of(place.turn[node])
            block = turn @ inertia @ turn.T
        where = [self.column.get((node, axis), -1) for axis in range(3)]
        for i, a in enumerate(where):
            for j, b in enumerate(where):
                if a >= 0 and b >= 0:
                    m[a, b] += block[i, j]

    def gravity(self, place: Place, field: Real) -> tuple[Real, Real]:
        """Force (columns,) and second derivative of the potential (columns, columns)."""
        force, second = np.zeros(self.size), np.zeros((self.size, self.size))
        if not field.any():
            return force, second
        for keyword, labels in self.groups.items():
            heavy = [label for label in labels if self.structure.parts[label].mass]
            if not heavy or keyword in ("HINGE", "PLTOR", "PLHINGE", "PINBODY", "BEARING"):
                continue
            total = np.array(
                [self.structure.parts[n].mass[0] * self.structure.parts[n].length for n in heavy]
            )
            potential = weight if keyword in ("BEAM", "PLBEAM") else straight_weight
            jet = potential(self.batch(place, heavy), total, field)
            for i, label in enumerate(heavy):
                part = self.structure.parts[label]
                self._add(second, part, jet.hessian[i])
                for j, column in enumerate(self.columns_of(part)):
                    if column >= 0:
                        force[column] -= jet.gradient[i, j]
        for node, numbers in self.structure.node_mass.items():
            if self.structure.kinds[node] == "p":
                for axis in range(3):
                    if (node, axis) in self.column:
                        force[self.column[node, axis]] += numbers[0] * field[axis]
        return force, second
