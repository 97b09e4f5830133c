# SPDX-License-Identifier: BSD-3-Clause
"""A deck as arrays: kinematics by the other oracle's reader, stiffness and mass by this one."""

from __future__ import annotations

import re
import sys
from collections import defaultdict
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))
from jets import Real
from oracle_deck import kinematic_statements, number, read_deck
from oracle_elements import frame as local_frame

AXES = {"x": 0, "y": 1, "z": 2, "rx": 0, "ry": 1, "rz": 2}
LENGTHS = ("TRUSS", "PLTRUSS", "BEAM", "PLBEAM", "RBEAM", "PLRBEAM", "PINBODY", "BEARING")


@dataclass
class Part:
    """One element: keyword, nodes p, op, q, oq (None where it has none), and its constants.

    Notches are stiffnesses in N m/rad (N/m for lengths) by index of the released deformation.
    """

    keyword: str
    nodes: tuple[int | None, int | None, int | None, int | None]
    frame: Real
    offset: Real
    length: float
    stiffness: list[float]
    mass: list[float]
    classes: list[str]
    misfit: Real
    notches: dict[int, float] = field(default_factory=dict)

    @property
    def coupling(self) -> float:
        """c_t, the torsion-elongation constant."""
        if self.keyword != "BEAM":
            return 0.0
        given = [*self.stiffness, 0.0, 0.0, 0.0, 0.0][:4]
        if given[0] > 0:
            return (given[2] + given[3]) / given[0]
        if len(self.mass) > 1 and self.mass[0] > 0:
            return self.mass[1] / self.mass[0]
        return 0.0

    def matrix(self) -> Real:
        """S (6, 6), without notches."""
        s = np.zeros((6, 6))
        given = np.array([*self.stiffness, *[0.0] * 6][:6])
        l0 = self.length
        if self.keyword in ("TRUSS", "PLTRUSS"):
            s[0, 0] = given[0] / l0
        elif self.keyword == "PLBEAM":
            s[0, 0] = given[0] / l0
            s[1:3, 1:3] = given[1] / l0**3 * np.array([[4, -2], [-2, 4]])
        elif self.keyword == "BEAM":
            s[0, 0], s[1, 1] = given[0] / l0, given[1] / l0**3
            for at, rigidity, shear in ((2, given[2], given[4]), (4, given[3], given[5])):
                p = 12 * shear / l0**2
                block = np.array([[4 + p, -2 + p], [-2 + p, 4 + p]])
                s[at : at + 2, at : at + 2] = rigidity / ((1 + p) * l0**3) * block
        elif self.keyword in ("HINGE", "PLTOR", "PLHINGE"):
            s[:3, :3] = np.diag(given[:3])
        return s


@dataclass
class Structure:
    """The model of a deck.

    Attributes:
        kinds: node to "p" or "o"; position: node to its place at rest.
        coordinates: (node, axis 0..2) to "fixed", "input", "declared" or "dependent".
        parts: element number to part.
        force: (node, axis) to load; change: the same of DELXF; gravity; node_mass: numbers of XM.
        declared: independent coordinates (node, axis) and deformations (element, index 0..) in
            the order of the deck, coordinates first.
    """

    planar: bool
    kinds: dict[int, str]
    position: dict[int, Real]
    coordinates: dict[tuple[int, int], str]
    parts: dict[int, Part]
    force: dict[tuple[int, int], float]
    gravity: Real
    node_mass: dict[int, list[float]]
    declared: list[tuple[str, int, int]]
    ends: dict[int, list[int]] = field(default_factory=dict)


def _dynamic_statements(text: str) -> list[list[str]]:
    statements: list[list[str]] = []
    ended = 0
    for line in text.splitlines():
        words = re.split("[%#]", line)[0].split()
        if not words or line.startswith("*"):
            continue
        word = words[0].upper()
        if word == "END":
            ended += 1
        elif ended == 1 and word != "HALT":
            statements.append([word, *words[1:]])
    return statements


def read(text: str) -> Structure:
    deck = read_deck(text)
    planar = deck.planar
    inputs = set()
    declared: list[tuple[str, int, int]] = []
    for _, (keyword, *operands) in kinematic_statements(text):
        if keyword in ("INPUTX", "DYNX"):
            node, *components = [int(word) for word in operands]
            axes = deck.axes(node)
            first = 2 if len(axes) == 3 and deck.kinds[node] == "o" else 1
            chosen = [axes[c - first] for c in components] if components else list(axes)
            for axis in chosen:
                if keyword == "INPUTX":
                    inputs.add((node, axis))
                else:
                    declared.append(("x", node, AXES[axis]))
    for _, (keyword, *operands) in kinematic_statements(text):
        if keyword == "DYNE":
            label, *components = [int(word) for word in operands]
            count = deck.elements[label].type.deformations
            for c in components or range(1, count + 1):
                declared.append(("e", label, c - 1))
    coordinates = {}
    for (node, axis), name in deck.coordinates.items():
        word = {"independent": "declared"}.get(name, name)
        coordinates[node, AXES[axis]] = "input" if (node, axis) in inputs else word

    numbers: dict[str, dict[int, list[float]]] = defaultdict(dict)
    gravity = np.zeros(3)
    for keyword, *operands in _dynamic_statements(text):
        if keyword == "GRAVITY":
            values = [number(word) for word in operands]
            gravity[: len(values)] = values
        elif keyword in ("ESTIFF", "EM", "XM", "XF"):
            numbers[keyword][int(operands[0])] = [number(word) for word in operands[1:]]

    parts = {}
    for label, element in deck.elements.items():
        keyword = element.keyword
        classes = [deck.deformations[label, str(k + 1)] for k in range(element.type.deformations)]
        slots = element.type.slots
        order: list[int | None] = [None] * 4
        if slots == "pp":
            order[0], order[2] = element.nodes
        elif slots == "popo":
            order = list(element.nodes)
        elif slots == "pop":
            order[0], order[1], order[2] = element.nodes
        else:
            order[1], order[3] = element.nodes
        offset, frame = np.zeros(3), np.eye(3)
        if order[0] is not None and order[2] is not None:
            offset = np.array(deck.position[order[2]]) - np.array(deck.position[order[0]])
        length = float(np.linalg.norm(offset))
        if keyword in ("PLTOR", "PLHINGE"):
            pass
        elif planar:
            ex = offset / length
            frame = np.column_stack([ex, [-ex[1], ex[0], 0], [0, 0, 1]])
        elif keyword in ("HINGE", "BEARING"):
            frame = local_frame(np.array(element.vector))
        elif keyword != "TRUSS" and length > 0:
            frame = local_frame(offset, () if keyword == "PINBODY" else element.vector)
        parts[label] = Part(
            keyword,
            (order[0], order[1], order[2], order[3]),
            frame,
            offset,
            length,
            numbers["ESTIFF"].get(label, []),
            numbers["EM"].get(label, []),
            classes,
            np.zeros(6),
        )
    force = {}
    for node, values in numbers["XF"].items():
        for axis, value in enumerate(values):
            planar_angle = planar and deck.kinds[node] == "o"
            force[node, 2 if planar_angle else axis] = value
    return Structure(
        planar,
        dict(deck.kinds),
        {node: np.array(place, dtype=float) for node, place in deck.position.items()},
        coordinates,
        parts,
        force,
        gravity,
        numbers["XM"],
        declared,
        {label: [label] for label in parts},
    )


def refine(structure: Structure, beams: int) -> Structure:
    """Every flexible BEAM and PLBEAM cut into equal pieces; the first keeps the number."""
    if beams == 1:
        return structure
    parts: dict[int, Part] = {}
    kinds, position = dict(structure.kinds), dict(structure.position)
    coordinates, ends = dict(structure.coordinates), {}
    new_node = max(kinds) + 1
    new_label = max(structure.parts) + 1
    for label, part in structure.parts.items():
        soft = any(v > 0 for v in part.stiffness)
        if part.keyword not in ("BEAM", "PLBEAM") or not soft:
            parts[label], ends[label] = part, [label]
            continue
        p, op, q, oq = part.nodes
        assert p is not None and op is not None and q is not None and oq is not None
        pairs = [(p, op)]
        for piece in range(1, beams):
            kinds[new_node], kinds[new_node + 1] = "p", "o"
            position[new_node] = position[p] + part.offset * piece / beams
            spatial = not structure.planar
            for axis in range(3 if spatial else 2):
                coordinates[new_node, axis] = "dependent"
            for axis in range(3) if spatial else (2,):
                coordinates[new_node + 1, axis] = "dependent"
            pairs.append((new_node, new_node + 1))
            new_node += 2
        pairs.append((q, oq))
        labels = []
        for piece in range(beams):
            (a, oa), (b, ob) = pairs[piece], pairs[piece + 1]
            number_of = label if piece == 0 else new_label
            new_label += piece > 0
            labels.append(number_of)
            last = piece == beams - 1
            pair_starts = (1,) if part.keyword == "PLBEAM" else (2, 4)
            classes = list(part.classes)
            for at in pair_starts:
                cp, cq = part.classes[at], part.classes[at + 1]
                if cp == cq == "fixed":
                    continue
                classes[at] = cp if piece == 0 else "dependent"
                classes[at + 1] = cq if last else "dependent"
            for at in range(pair_starts[0]):
                if classes[at] == "independent" and piece > 0:
                    classes[at] = "dependent"
            notches = {}
            for k, stiffness in part.notches.items():
                at_end = k in [at + 1 for at in pair_starts]
                if (at_end and last) or (not at_end and piece == 0):
                    notches[k] = stiffness
            parts[number_of] = Part(
                part.keyword,
                (a, oa, b, ob),
                part.frame,
                part.offset / beams,
                part.length / beams,
                part.stiffness,
                part.mass,
                classes,
                _share_of_misfit(part, piece, beams),
                notches,
            )
        ends[label] = labels
    return Structure(
        structure.planar,
        kinds,
        position,
        coordinates,
        parts,
        structure.force,
        structure.gravity,
        structure.node_mass,
        structure.declared,
        ends,
    )


def _share_of_misfit(part: Part, piece: int, beams: int) -> Real:
    """Misfit of a piece of a beam whose stress-free line is the cubic with these end angles."""
    share = np.zeros(6)
    l0, small = part.length, part.length / beams
    share[0] = part.misfit[0] / beams
    spatial = part.keyword == "BEAM"
    if spatial:
        share[1] = part.misfit[1] / beams**2
    # angle of the end tangents against the chord: sign of each deformation
    # BEAM: e3 = -l0 el.ez_p, e4 = l0 el.ez_q; e5 = l0 el.ey_p, e6 = -l0 el.ey_q; PLBEAM as e3, e4
    for at, sign in ((2, -1.0), (4, 1.0)) if spatial else ((1, -1.0),):
        # el.n at p is minus the slope of the tangent there (n leans back as the tangent leans over)
        slope_p = -sign * part.misfit[at] / l0
        slope_q = sign * part.misfit[at + 1] / l0
        a, b = piece / beams, (piece + 1) / beams

        def line(t: float, sp: float = slope_p, sq: float = slope_q) -> float:
            return l0 * (sp * t * (1 - t) ** 2 - sq * t**2 * (1 - t))

        def slope(t: float, sp: float = slope_p, sq: float = slope_q) -> float:
            return sp * (1 - t) * (1 - 3 * t) - sq * (2 * t - 3 * t**2)

        chord = (line(b) - line(a)) / small
        share[at] = -sign * small * (slope(a) - chord)
        share[at + 1] = sign * small * (slope(b) - chord)
    return share
