# SPDX-License-Identifier: BSD-3-Clause
"""Input of CalculiX for mechanisms of sheets between ground and one stiff stage.

A sheet is a box of C3D20R bricks, one through the thickness. The nodes of its far edge belong to
the stage, a rigid body with a reference node and a rotation node; those of its near edge to a
clamp, which is another rigid body, so that it can be moved, turned, or left free to turn.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Real = NDArray[np.float64]

#: Corners and midsides of C3D20R in units of half an element, in the order of CalculiX.
BRICK = [
    (0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2),
    (1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0), (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2),
    (0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1),
]  # fmt: skip


@dataclass(frozen=True)
class Sheet:
    """From the middle of the clamped edge along `along`, width across, thickness the third."""

    start: tuple[float, float, float]
    along: tuple[float, float, float]
    across: tuple[float, float, float]
    length: float
    width: float
    thickness: float
    divisions: tuple[int, int] = (20, 10)


@dataclass
class Mesh:
    """Nodes and elements of a mechanism.

    Attributes:
        nodes: places by number.
        bricks: node numbers by element number.
        clamps: for each sheet its reference node, rotation node; stage: the same of the stage.
    """

    sheets: list[Sheet]
    stage_at: tuple[float, float, float]
    masses: list[tuple[tuple[float, float, float], float]] = field(default_factory=list)
    nodes: dict[int, Real] = field(default_factory=dict)
    bricks: dict[int, list[int]] = field(default_factory=dict)
    sets: dict[str, list[int]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.sets["NSTAGE"] = []
        for number, sheet in enumerate(self.sheets):
            self._add(sheet, f"NCLAMP{number + 1}")
        self.clamps = []
        for sheet in self.sheets:
            self.clamps.append((self._node(sheet.start), self._node(sheet.start)))
        self.stage = (self._node(self.stage_at), self._node(self.stage_at))
        self.mass_nodes = []
        for place, _ in self.masses:
            self.mass_nodes.append(self._node(place))
            self.sets["NSTAGE"].append(self.mass_nodes[-1])

    def _node(self, place: object) -> int:
        number = len(self.nodes) + 1
        self.nodes[number] = np.array(place, dtype=float)
        return number

    def _add(self, sheet: Sheet, clamp: str) -> None:
        n, m = sheet.divisions
        along, across = np.array(sheet.along), np.array(sheet.across)
        normal = np.cross(along, across)
        made: dict[tuple[int, int, int], int] = {}
        self.sets[clamp] = []
        for i in range(n):
            for j in range(m):
                corners = []
                for a, b, c in BRICK:
                    at = (2 * i + a, 2 * j + b, c)
                    if at not in made:
                        place = (
                            np.array(sheet.start)
                            + along * sheet.length * at[0] / (2 * n)
                            + across * sheet.width * (at[1] / (2 * m) - 0.5)
                            + normal * sheet.thickness * (at[2] / 2 - 0.5)
                        )
                        made[at] = self._node(place)
                        if at[0] == 0:
                            self.sets[clamp].append(made[at])
                        if at[0] == 2 * n:
                            self.sets["NSTAGE"].append(made[at])
                    corners.append(made[at])
                self.bricks[len(self.bricks) + 1] = corners

    def text(self, modulus: float, poisson: float, density: float) -> str:
        """Everything before the first step."""
        lines = ["*NODE, NSET=NALL"]
        lines += [f"{n}, " + ", ".join(f"{x:.12e}" for x in p) for n, p in self.nodes.items()]
        lines.append("*ELEMENT, TYPE=C3D20R, ELSET=EALL")
        for number, corners in self.bricks.items():
            words = [str(number), *map(str, corners)]
            lines += [", ".join(words[:11]) + ",", ", ".join(words[11:])]
        for name, members in self.sets.items():
            lines.append(f"*NSET, NSET={name}")
            lines += [f"{member}," for member in members]
        for number, (ref, rot) in enumerate(self.clamps):
            lines.append(f"*RIGID BODY, NSET=NCLAMP{number + 1}, REF NODE={ref}, ROT NODE={rot}")
        lines.append(
            f"*RIGID BODY, NSET=NSTAGE, REF NODE={self.stage[0]}, ROT NODE={self.stage[1]}"
        )
        lines += ["*MATERIAL, NAME=M", "*ELASTIC", f"{modulus}, {poisson}"]
        lines += ["*DENSITY", f"{density}", "*SOLID SECTION, ELSET=EALL, MATERIAL=M"]
        for i, (_, mass) in enumerate(self.masses):
            element = len(self.bricks) + 1 + i
            lines += [f"*ELEMENT, TYPE=MASS, ELSET=EMASS{i}", f"{element}, {self.mass_nodes[i]}"]
            lines += [f"*MASS, ELSET=EMASS{i}", f"{mass}"]
        lines.append("*NSET, NSET=NSTAGEREF")
        lines.append(f"{self.stage[0]}, {self.stage[1]}")
        return "\n".join(lines) + "\n"
