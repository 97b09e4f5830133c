# SPDX-License-Identifier: BSD-3-Clause
"""Compute what is compared with Flexact by CalculiX, a finite-element package that is not ours.

    make reference        # rewrites values.json; a minute or two

CalculiX (http://www.calculix.de) is `apt install calculix-ccx` on Debian and Ubuntu. What the
values are and how far beams differ from solids is said in README.md beside this file.
"""

from __future__ import annotations

import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from sheets import Mesh, Sheet

HERE = Path(__file__).resolve().parent
MODULUS, DENSITY, LENGTH, THICKNESS, APART = 210e9, 7800.0, 0.1, 0.0005, 0.05
#: Poisson's ratio is zero, so that clamps hold no sideways contraction and plates bend as beams.
POISSON = 0.0
#: Eight masses of 0.1 kg on the stage, off its middle (0.025, 0, 0.05) by so much.
MASS, OFF = 0.1, (0.03, 0.04, 0.02)
WIDE, NARROW = (0.05, (20, 10)), (0.005, (60, 3))
STROKES = [0.0, 0.0005, 0.001, 0.002, 0.003]
TURNS = {"wide": [0.0004, 0.0008, 0.0012, 0.0014], "narrow": [0.04, 0.08, 0.12, 0.14]}
TIGHT = "*CONTROLS, PARAMETERS=FIELD\n1e-8, 1e-8\n"


def guide(width: float, divisions: tuple[int, int]) -> Mesh:
    """Two sheets along z, width along y, and a stage at mid height: that of flexact's test."""
    sheets = [
        Sheet((x, 0, 0), (0, 0, 1), (0, 1, 0), LENGTH, width, THICKNESS, divisions)
        for x in (0.0, APART)
    ]
    middle = (APART / 2, 0.0, LENGTH / 2)
    corners = [(a, b, c) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]
    masses = [
        ((middle[0] + a * OFF[0], b * OFF[1], middle[2] + c * OFF[2]), MASS) for a, b, c in corners
    ]
    return Mesh(sheets, middle, masses)


def clamps(mesh: Mesh, released: bool = False) -> str:
    """All clamps held; that of the first sheet may turn about x: no bending in its plane."""
    lines = ["*BOUNDARY"]
    for number, (place, turn) in enumerate(mesh.clamps):
        first = 2 if released and number == 0 else 1
        lines += [f"{place}, 1, 3", f"{turn}, {first}, 3"]
    return "\n".join(lines) + "\n"


def turned(mesh: Mesh, angle: float) -> str:
    """The first clamp turned about x through the middle of the sheets' height."""
    place, turn = mesh.clamps[0]
    arm = LENGTH / 2
    return (
        f"*BOUNDARY\n{place}, 1, 1, 0.\n{place}, 2, 2, {arm * math.sin(angle):.12e}\n"
        f"{place}, 3, 3, {arm * (1 - math.cos(angle)):.12e}\n"
        f"{turn}, 1, 1, {angle:.12e}\n{turn}, 2, 3, 0.\n"
    )


PRINT = "*NODE PRINT, NSET=NSTAGEREF\nU\n"


def unit_loads(mesh: Mesh) -> str:
    steps = ""
    for axis in range(6):
        node = mesh.stage[axis // 3]
        steps += f"*STEP\n*STATIC\n*CLOAD, OP=NEW\n{node}, {axis % 3 + 1}, 1.\n{PRINT}*END STEP\n"
    return steps


def modes(count: int, perturbation: bool = False) -> str:
    kind = ", PERTURBATION" if perturbation else ""
    return f"*STEP{kind}\n*FREQUENCY\n{count}\n*END STEP\n"


def misaligned(mesh: Mesh, angles: list[float]) -> str:
    steps = ""
    for angle in angles:
        steps += f"*STEP, NLGEOM, INC=100\n*STATIC\n1., 1.\n{TIGHT}{turned(mesh, angle)}*END STEP\n"
        steps += modes(2, perturbation=True)
    return steps


def buckling(mesh: Mesh, angle: float) -> str:
    return f"*STEP\n*BUCKLE\n4, 1e-5\n{turned(mesh, angle)}*END STEP\n"


def stroke(mesh: Mesh) -> str:
    """At each stroke, held, a force of 100 N up and then down along the sheets."""
    steps = ""
    for reach in STROKES:
        steps += f"*STEP, NLGEOM, INC=100\n*STATIC\n0.25, 1.\n{TIGHT}"
        steps += f"*BOUNDARY\n{mesh.stage[0]}, 1, 1, {reach}\n*CLOAD, OP=NEW\n*END STEP\n"
        for force in (100.0, -100.0):
            steps += f"*STEP, NLGEOM, INC=100\n*STATIC\n1., 1.\n{TIGHT}"
            steps += f"*CLOAD, OP=NEW\n{mesh.stage[0]}, 3, {force}\n{PRINT}*END STEP\n"
    return steps


def solve(program: str, folder: Path, name: str, text: str) -> str:
    """Run CalculiX; returns what it printed into its .dat file."""
    (folder / f"{name}.inp").write_text(text, encoding="ascii")
    environment = {**os.environ, "OMP_NUM_THREADS": os.environ.get("OMP_NUM_THREADS", "1")}
    done = subprocess.run(
        [program, name], cwd=folder, capture_output=True, text=True, env=environment, check=False
    )
    if done.returncode or "*ERROR" in done.stdout:
        raise SystemExit(f"CalculiX failed on {name}:\n{done.stdout[-2000:]}")
    return (folder / f"{name}.dat").read_text(encoding="ascii")


def displacements(printed: str, node: int) -> list[list[float]]:
    pattern = rf"^ +{node} +(\S+) +(\S+) +(\S+)$"
    return [[float(x) for x in found] for found in re.findall(pattern, printed, re.M)]


def heights_by_step(printed: str, node: int) -> dict[int, float]:
    """Displacement along z at the end of each step, which lasts a second."""
    pattern = rf"time +(\S+)\n\n +{node} +\S+ +\S+ +(\S+)$"
    found = re.findall(pattern, printed, re.M)
    return {round(float(t)): float(z) for t, z in found if float(t) == round(float(t))}


def compliance(printed: str, mesh: Mesh) -> list[float]:
    """Diagonal x y z rx ry rz."""
    moves = displacements(printed, mesh.stage[0])
    turns = displacements(printed, mesh.stage[1])
    return [moves[i][i] for i in range(3)] + [turns[i + 3][i] for i in range(3)]


def frequencies(printed: str) -> list[list[float]]:
    """Hz, a list for each step of frequencies."""
    tables = printed.split("E I G E N V A L U E   O U T P U T")[1:]
    found = []
    for table in tables:
        numbers = table.split("P A R T I C I P A T I O N")[0]
        lines = re.findall(r"^ +\d+ +(\S+) +(\S+) +(\S+) +(\S+)$", numbers, re.M)
        found.append([float(line[2]) for line in lines])
    return found


def factors(printed: str) -> list[float]:
    table = printed.split("B U C K L I N G   F A C T O R   O U T P U T")[1]
    return [float(x) for x in re.findall(r"^ +\d+ +(\S+)$", table, re.M)]


def compute(program: str, folder: Path) -> dict[str, object]:
    values: dict[str, object] = {}

    def run(name: str, mesh: Mesh, clamped: str, steps: str) -> str:
        print(name, flush=True)
        head = mesh.text(MODULUS, POISSON, DENSITY)
        return solve(program, folder, name, head + clamped + steps)

    wide, narrow = guide(*WIDE), guide(*NARROW)
    for kind, released in (("built", False), ("released", True)):
        held = clamps(wide, released)
        values[f"compliance_{kind}"] = compliance(run(kind, wide, held, unit_loads(wide)), wide)
        values[f"frequencies_{kind}"] = frequencies(run(f"{kind}_f", wide, held, modes(4)))[0]
    printed = run("stroke", wide, clamps(wide), stroke(wide))
    heights = heights_by_step(printed, wide.stage[0])
    values["strokes"] = STROKES
    values["support_stiffness"] = [
        200 / (heights[3 * i + 2] - heights[3 * i + 3]) for i in range(len(STROKES))
    ]
    for name, mesh in (("wide", wide), ("narrow", narrow)):
        turns = TURNS[name]
        path = frequencies(
            run(f"{name}_turned", mesh, clamps(mesh), modes(2) + misaligned(mesh, turns))
        )
        found = factors(run(f"{name}_buckling", mesh, clamps(mesh), buckling(mesh, turns[0])))
        values[f"{name}_turns"] = [0.0, *turns]
        values[f"{name}_frequencies"] = [modes_of_one[0] for modes_of_one in path]
        values[f"{name}_critical_turns"] = [turns[0] * factor for factor in found[:3]]
    return values


def main() -> int:
    program = shutil.which("ccx")
    if program is None:
        print(
            "make reference needs CalculiX, whose program ccx is not here. On Debian and Ubuntu "
            "`apt install calculix-ccx` brings it. The stored values stay as they are; tests "
            "compare with them and need no CalculiX.",
            file=sys.stderr,
        )
        return 1
    told = subprocess.run([program, "-v"], capture_output=True, text=True, check=False).stdout
    version = re.search(r"Version (\S+)", told)
    with tempfile.TemporaryDirectory() as folder:
        values = compute(program, Path(folder))
    content = {
        "program": "CalculiX CrunchiX (ccx)",
        "version": version[1] if version else "unknown",
        "elements": "C3D20R, one through the thickness; 20 x 10 a wide sheet, 60 x 3 a narrow one",
        "model": {
            "modulus": MODULUS,
            "poisson": POISSON,
            "density": DENSITY,
            "length": LENGTH,
            "thickness": THICKNESS,
            "apart": APART,
            "wide": WIDE[0],
            "narrow": NARROW[0],
            "stage_mass": 8 * MASS,
            "stage_mass_off": OFF,
        },
        "values": values,
    }
    (HERE / "values.json").write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
