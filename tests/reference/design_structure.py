# SPDX-License-Identifier: BSD-3-Clause
"""The deck of a layout: bodies, flexures, verdict, freedom of the stage, stiffness and mass.

Kinematics by the reader and the derivatives of this folder, stiffness and mass by a linear beam
model. Conventions: `design_oracle.py`.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, replace

import numpy as np
from design_classes import Json, Real, centre_of, complement, orthonormal, spin, unit
from oracle_analysis import clear_rank, scaled
from oracle_deck import Deck, Label, kinematic_statements, number, read_deck
from oracle_elements import ROTATIONS, derivatives, frame

#: Places of ends, in parts of L.
CLOSE = 1e-9
EXPANSION = 1e-5


class Structure:
    """A deck with its names, bodies, flexures, stiffness and mass."""

    def __init__(self, text: str, problem: Json, flexures: list[str]) -> None:
        self.problem = problem
        self.deck: Deck = read_deck(text)
        self.names = _comments(text)
        self.numbers = _dynamics(text)
        self.elements = self.deck.elements
        for label in self.elements:
            self._choose_vector(label)
        links = [label for label in self.elements if self.is_link(label)]
        self.owner = {
            label: owner
            for label in self.elements
            if label not in links and (owner := _owner(self.names.get(label, ""), flexures))
        }
        self.strays = [n for n in self.elements if n not in self.owner and n not in links]
        self.bodies = self._bodies([label for label in links if label not in self.owner])
        self.columns: list[Label] = [
            label for label, name in self.deck.coordinates.items() if name != "fixed"
        ]
        self.place = {label: index for index, label in enumerate(self.columns)}
        self.rows = {
            label: derivatives(self.deck, element) for label, element in self.elements.items()
        }

    def _choose_vector(self, label: int) -> None:
        """A y vector where the default is a matter of rounding and makes no difference."""
        element = self.elements[label]
        if element.keyword not in ("BEAM", "RBEAM") or element.vector:
            return
        p, q = (np.array(self.deck.position[n]) for n in element.nodes[::2])
        held = [self.deck.deformations[label, str(k + 1)] for k in range(element.type.deformations)]
        given = [*self.numbers["ESTIFF"].get(label, []), *[0.0] * 6][:6]
        round_section = given[2] == given[3] and given[4] == given[5]
        if len(set(held)) == 1 or (round_section and len(held) == 6 and held[2:4] == held[4:6]):
            size = np.sort(np.abs(q - p))
            if size[1] - size[0] < 1e-6 * size[2]:
                least = np.eye(3)[int(np.argmin(np.abs(q - p)))]
                self.elements[label] = replace(element, vector=tuple(least))

    def is_link(self, label: int) -> bool:
        held = [
            self.deck.deformations[label, str(k + 1)]
            for k in range(self.elements[label].type.deformations)
        ]
        return set(held) == {"fixed"} and not self.numbers["ESTIFF"].get(label)

    def _bodies(self, links: list[int]) -> dict[int, str]:
        """Node to the name of the body that it is of; "ground", or "" where it has no name."""
        group = {node: node for node in self.deck.kinds}

        def root(node: int) -> int:
            while group[node] != node:
                node = group[node]
            return node

        for label in links:
            first, *others = self.elements[label].nodes
            for node in others:
                group[root(node)] = root(first)
        # An end of a flexure is one place and one orientation.
        for element in self.elements.values():
            if element.type.slots == "popo":
                p, op, q, oq = element.nodes
                group[root(op)] = root(p)
                group[root(oq)] = root(q)
        names: dict[int, str] = {}
        for label in links:
            name = self.names.get(label, "").rpartition(",")[0] or self.names.get(label, "")
            names[root(self.elements[label].nodes[0])] = name
        free = {node for (node, _), name in self.deck.coordinates.items() if name != "fixed"}
        for node in self.deck.kinds:
            if node not in free:
                names[root(node)] = "ground"
        if "stage" not in names.values():
            centre = centre_of(self.problem)
            for node, place in self.deck.position.items():
                near = np.linalg.norm(np.subtract(place, centre)) < CLOSE * self.problem["size"]
                if near and node in free:
                    names.setdefault(root(node), "stage")
        return {node: names.get(root(node), "") for node in self.deck.kinds}

    def matrix(self, rows: list[Label], columns: list[Label]) -> Real:
        """Derivatives of some deformations by some coordinates."""
        row_of = {label: index for index, label in enumerate(rows)}
        column_of = {label: index for index, label in enumerate(columns)}
        matrix = np.zeros((len(rows), len(columns)))
        for label, by_coordinate in self.rows.items():
            for coordinate, values in by_coordinate.items():
                if coordinate not in column_of:
                    continue
                for index, value in enumerate(values, start=1):
                    if (label, str(index)) in row_of:
                        matrix[row_of[label, str(index)], column_of[coordinate]] += value
        return matrix

    def verdict(self) -> tuple[int, int]:
        """Motions beside the declared ones, and self-stresses."""
        rows = [label for label, name in self.deck.deformations.items() if name != "dependent"]
        columns = [label for label in self.columns if self.deck.coordinates[label] == "dependent"]
        matrix = self.matrix(rows, columns)
        if 0 in matrix.shape:
            return len(columns), len(rows)
        values = np.linalg.svd(scaled(self.deck, columns, matrix), compute_uv=False)
        rank = clear_rank(values, matrix.shape)
        return len(columns) - rank, len(rows) - rank

    def stage_rows(self) -> Real:
        """Scaled twist of the stage about the centre from all coordinates, 6 x n."""
        nodes = [node for node, name in self.bodies.items() if name == "stage"]
        places = [node for node in nodes if self.deck.kinds[node] == "p"]
        turns = [node for node in nodes if self.deck.kinds[node] == "o"]
        if not places or not turns:
            raise ValueError("the deck has no body called stage")
        size = self.problem["size"]
        p, o = min(places), min(turns)
        arm = centre_of(self.problem) - np.array(self.deck.position[p])
        rows = np.zeros((6, len(self.columns)))
        for axis, name in enumerate(ROTATIONS):
            if (o, name) in self.place:
                rows[axis, self.place[o, name]] = size
                rows[3:, self.place[o, name]] = np.cross(np.eye(3)[axis], arm)
        for axis, name in enumerate("xyz"):
            if (p, name) in self.place:
                rows[3 + axis, self.place[p, name]] = 1.0
        return rows

    def weight(self) -> tuple[float, Real]:
        """Mass of the stage, and its inertia about the centre, by XM."""
        mass, inertia = 0.0, np.zeros((3, 3))
        for node, values in self.numbers["XM"].items():
            if self.bodies.get(node) != "stage":
                continue
            if self.deck.kinds[node] == "p":
                arm = np.array(self.deck.position[node]) - centre_of(self.problem)
                mass += values[0]
                inertia += values[0] * (arm @ arm * np.eye(3) - np.outer(arm, arm))
            else:
                xx, xy, xz, yy, yz, zz = [*values, *[0.0] * 6][:6]
                inertia += np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        return mass, inertia

    def motions(self) -> tuple[Real, int]:
        """Freedom of the stage (orthonormal scaled twists) and number of inner motions."""
        rows = [label for label, name in self.deck.deformations.items() if name == "fixed"]
        matrix = self.matrix(rows, self.columns)
        fair = scaled(self.deck, self.columns, matrix)
        _, values, right = np.linalg.svd(fair)
        null = right[clear_rank(values, matrix.shape) :]
        lengths = [np.linalg.norm(vector) for vector in self._chords().values()]
        turn = np.array([1 / np.mean(lengths) if n in ROTATIONS else 1.0 for _, n in self.columns])
        moves = (self.stage_rows() @ (null * turn).T).T
        space = orthonormal(moves, 1e-7) if np.max(np.abs(moves), initial=0.0) > 1e-9 else moves[:0]
        return space, len(null) - len(space)

    def _chords(self) -> dict[int, Real]:
        chords = {}
        for label, element in self.elements.items():
            places = [n for n in element.nodes if self.deck.kinds[n] == "p"]
            if len(places) == 2:
                p, q = (np.array(self.deck.position[n]) for n in places)
                if np.linalg.norm(q - p) > 0:
                    chords[label] = q - p
        return chords

    def elastic(self) -> Elastic:
        """Stiffness and mass in the motions that links allow.

        Raises:
            ValueError: some motion has no stiffness.
        """
        count = len(self.columns)
        stiff, mass, warm = np.zeros((count, count)), np.zeros((count, count)), np.zeros(count)
        rigid = []
        alpha = (self.problem.get("material") or {}).get("expansion", EXPANSION)
        chords = self._chords()
        for label, element in self.elements.items():
            given = [*self.numbers["ESTIFF"].get(label, []), *[0.0] * 6][:6]
            if element.keyword == "BEAM":
                chord = chords[label]
                rows, triad = _beam_rows(chord, element.vector)
                matrix = _beam_stiffness(given, float(np.linalg.norm(chord)))
                start = np.zeros(6)
                start[0] = alpha * np.linalg.norm(chord)
            elif element.keyword == "HINGE":
                triad = frame(np.array(element.vector))
                rows = np.hstack([-triad.T, triad.T])
                matrix, start = np.diag(given[:3]), np.zeros(3)
            else:
                names = [(n, a) for n in dict.fromkeys(element.nodes) for a in self.deck.axes(n)]
                rows = np.column_stack([self.rows[label][name] for name in names])
                matrix = np.zeros((len(rows), len(rows)))
                if element.keyword == "TRUSS":
                    matrix[0, 0] = given[0] / np.linalg.norm(chords[label])
                start = np.zeros(len(rows))
                start[0] = alpha * np.linalg.norm(chords[label]) if matrix[0, 0] > 0 else 0.0
            where, full = [], np.zeros((len(rows), count))
            flat = [(n, a) for n in element.nodes for a in self.deck.axes(n)]
            for column, coordinate in enumerate(flat[: rows.shape[1]]):
                where.append(self.place.get(coordinate, -1))
                if where[-1] >= 0:
                    full[:, where[-1]] += rows[:, column]
            for k in range(len(rows)):
                held = self.deck.deformations[label, str(k + 1)] == "fixed"
                if held and matrix[k, k] <= 0:
                    rigid.append(unit(full[k]) if np.any(full[k]) else full[k])
            stiff += full.T @ matrix @ full
            warm += full.T @ matrix @ start if given[0] > 0 else 0.0
            inertia = self.numbers["EM"].get(label)
            if inertia and element.keyword == "BEAM":
                part = _beam_mass(inertia, chords[label], triad)
                for i, a in enumerate(where):
                    for j, b in enumerate(where):
                        if a >= 0 and b >= 0:
                            mass[a, b] += part[i, j]
        for node, values in self.numbers["XM"].items():
            block = values[0] * np.eye(3)
            if self.deck.kinds[node] == "o":
                xx, xy, xz, yy, yz, zz = [*values, *[0.0] * 6][:6]
                block = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
            axes = [self.place.get((node, axis), -1) for axis in self.deck.axes(node)]
            for i, a in enumerate(axes):
                for j, b in enumerate(axes):
                    if a >= 0 and b >= 0:
                        mass[a, b] += block[i, j]
        # Rotations in lengths, so that the null space of the links is a fair one.
        fair = np.array(
            [1 / self.problem["size"] if n in ROTATIONS else 1.0 for _, n in self.columns]
        )
        allowed = _null(np.array(rigid).reshape(-1, count) * fair) * fair
        return Elastic(
            allowed @ stiff @ allowed.T,
            allowed @ mass @ allowed.T,
            allowed @ warm,
            self.stage_rows() @ allowed.T,
        )


def _null(rows: Real) -> Real:
    if len(rows) == 0:
        return np.eye(rows.shape[1])
    _, values, right = np.linalg.svd(rows)
    return np.array(right[int(np.sum(values > 1e-10 * values[0])) :])


def _comments(text: str) -> dict[int, str]:
    """Element number to the comment at the end of its line: its name."""
    lines, names = text.splitlines(), {}
    for index, (keyword, *operands) in kinematic_statements(text):
        if keyword not in ("X", "FIX", "RLSE", "DYNE", "DYNX", "INPUTX", "INPUTE"):
            comment = re.split("[%#]", lines[index], maxsplit=1)
            names[int(operands[0])] = comment[1].strip() if len(comment) > 1 else ""
    return names


def _dynamics(text: str) -> dict[str, dict[int, list[float]]]:
    """ESTIFF, EM and XM, which stand after the first END, by number."""
    found: dict[str, dict[int, list[float]]] = {"ESTIFF": {}, "EM": {}, "XM": {}}
    for line in text.splitlines():
        keyword, *operands = re.split("[%#]", line)[0].split() or [""]
        if keyword.upper() in found:
            found[keyword.upper()][int(operands[0])] = [number(word) for word in operands[1:]]
    return found


def _owner(comment: str, flexures: list[str]) -> str:
    """The flexure that an element is of; the longest name where several fit."""
    fits = [name for name in flexures if comment == name or comment.startswith(f"{name}, ")]
    return max(fits, key=len, default="")


def _beam_rows(chord: Real, vector: tuple[float, ...]) -> tuple[Real, Real]:
    """Small deformations e1..e6 of a beam by (up, phip, uq, phiq), 6 x 12, and its triad."""
    triad = frame(chord, vector)
    x, y, z = triad.T
    length, none = float(np.linalg.norm(chord)), np.zeros(3)
    return np.array(
        [
            np.concatenate([-x, none, x, none]),
            np.concatenate([none, -length * x, none, length * x]),
            np.concatenate([z, -length * y, -z, none]),
            np.concatenate([-z, none, z, length * y]),
            np.concatenate([-y, -length * z, y, none]),
            np.concatenate([y, none, -y, length * z]),
        ]
    ), triad


def _beam_stiffness(given: list[float], length: float) -> Real:
    """S of a Timoshenko beam: EA, G It, E Iy, E Iz, and E Iy/(k G A), E Iz/(k G A)."""
    matrix = np.zeros((6, 6))
    matrix[0, 0], matrix[1, 1] = given[0] / length, given[1] / length**3
    for at, bending, shear in ((2, given[2], given[4]), (4, given[3], given[5])):
        phi = 12 * shear / length**2
        block = np.array([[4 + phi, phi - 2], [phi - 2, 4 + phi]])
        matrix[at : at + 2, at : at + 2] = bending / ((1 + phi) * length**3) * block
    return matrix


def _beam_mass(given: list[float], chord: Real, triad: Real) -> Real:
    """Consistent mass of a beam in (up, phip, uq, phiq), 12 x 12, with its rotary inertia."""
    length = float(np.linalg.norm(chord))
    tangent = -length * spin(triad[:, 0])
    velocities = np.zeros((4, 3, 12))
    for at, block in ((0, np.eye(3)), (1, tangent), (2, np.eye(3)), (3, tangent)):
        velocities[at, :, 3 * at : 3 * at + 3] = block
    weights = [[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]]
    matrix = (
        given[0]
        * length
        / 420
        * np.einsum("ij,iak,jal->kl", np.array(weights, dtype=float), velocities, velocities)
    )
    xx, yy, zz, yz = [*given[1:], *[0.0] * 4][:4]
    rotary = triad @ np.array([[xx, 0, 0], [0, yy, yz], [0, yz, zz]]) @ triad.T * length / 2
    matrix[3:6, 3:6] += rotary
    matrix[9:, 9:] += rotary
    return np.array(matrix)


@dataclass(frozen=True)
class Elastic:
    """Stiffness, mass, forces of a kelvin, and rows of the stage's scaled twist."""

    stiffness: Real
    mass: Real
    warmth: Real
    stage: Real

    def scores(self, space: Real, with_mass: bool) -> dict[str, float]:
        """What section 6 asks, from the matrices alone."""
        scale = 1 / np.sqrt(np.diag(self.stiffness))
        factor = np.linalg.cholesky(self.stiffness * np.outer(scale, scale)) / scale[:, None]
        half = np.linalg.solve(factor, self.stage.T)
        stiffness = np.linalg.inv(half.T @ half)
        across = complement(space)
        found = {}
        if len(across):
            found["worst_stiffness"] = float(np.linalg.eigvalsh(across @ stiffness @ across.T)[0])
        if len(space):
            found["drive_stiffness"] = float(np.linalg.eigvalsh(space @ stiffness @ space.T)[-1])
            if len(across):
                found["separation"] = found["worst_stiffness"] / found["drive_stiffness"]
        drift = half.T @ np.linalg.solve(factor, self.warmth)
        found["thermal_drift"] = float(np.linalg.norm(drift[3:]))
        if with_mass:
            other = np.linalg.solve(factor, np.linalg.solve(factor, self.mass).T)
            slow, shapes = np.linalg.eigh((other + other.T) / 2)
            order = np.argsort(-slow)
            order = order[slow[order] > 1e-13 * slow[order[0]]]
            frequencies = 1 / (2 * math.pi * np.sqrt(slow[order]))
            # Of unit modal mass: omega times the mode of unit stiffness.
            moves = half.T @ shapes[:, order] / np.sqrt(slow[order])
            wanted = np.sum((space @ moves) ** 2, axis=0) if len(space) else np.zeros(len(order))
            kept = np.argsort(-wanted, kind="stable")[: len(space)]
            found["first_frequency"] = float(frequencies[0])
            rest = np.delete(frequencies, kept)
            if len(rest):
                found["first_parasitic_frequency"] = float(rest[0])
        return found
