# SPDX-License-Identifier: BSD-3-Clause
"""Judge an answer of ``flexact design`` by an independent computation.

``judge(problem, answer)`` names everything that is wrong with an answer, in words; nothing here
imports flexact. A problem is an object of `design_problems.json`, an answer what ``flexact design
problem.json --json`` prints. Constraints and freedom are those of the reader and the derivatives of
this folder (`oracle_deck.py`, `oracle_elements.py`); stiffness and mass are a beam model of this
file; distances are bounded least squares.

``python tests/reference/design_oracle.py PROBLEM.json ANSWER.json`` prints what is wrong.

What had to be decided, so that two programs mean the same:

- *Twists* are (w L, v), v the velocity of the point of the stage that is at `centre`; L = `size`.
  The error of the freedom is the sine of the largest angle between T and the stage's motions when
  nothing is declared at all; it may be 1e-9. Motions beyond those of the stage are `internal`.
- *Verdict*: no motion beside the declared ones; as many self-stresses as `over_constrained` says,
  at most `limits.over_constraint`.
- *Names*: an element belongs to the flexure whose name is its comment in the deck, or its comment
  up to a comma; likewise bodies. Elements without ESTIFF whose deformations are all held are links
  of bodies. A stage of a single point is the one that moves and is at `centre`.
- *Ends*: middles of the clamped edges, in the order of `between`. A whole edge lies in the union
  of the boxes of its region, within 1e-9 L; at a region's point only its middle is asked for. On
  a body between the middle alone lies within `intermediate`, where that is given.
- *Length* is that between the ends; of a folded sheet that of each leaf (a layout is accepted where
  its two leaves together are within the limits, with a remark). A limit that is one number is a
  value to be met within 1e-9 of it.
- *Solids*: a wire is a segment with a radius, a sheet a box (length, width, thickness), also where
  it has a waist, a folded sheet two boxes, anything else a segment with half its diameter or
  thickness. Clearance holds between any two flexures, also on one body, and to keep-outs; bodies
  have no points in keep-outs.
- *Mass and inertia* of the stage are those of the problem, about `centre`.
- *Isometries* are the signed permutations about `centre` that keep T, inertia, and the lists of
  boxes and points of stage, ground, keep-out and intermediate. Two layouts are images where
  flexures of one kind, with the same sizes and ends, correspond; bodies between have no names then.
- *Stiffness* K is the inverse of the compliance of the stage at `centre`; links are rigid, whatever
  has ESTIFF is elastic, also what is held, and declared motions are free. Worst stiffness is the
  least x.K x / x.x over the orthogonal complement of T, drive stiffness the largest over T.
- *Mass* is as in SPACAR: the consistent matrix with 156, 22, 54, -13, 4, -3 for velocities at the
  ends (also along the beam), and J l/2 of rotary inertia at each end, and XM.
- *First frequency* is the lowest of all modes with flexures' mass, inner ones too. *First parasitic
  frequency*: of the modes, of unit modal mass, the d with the largest part of the stage's scaled
  twist in T are left out; the lowest of the others.
- *Thermal drift* is the length of the displacement of the centre where each element with length and
  elasticity is longer by expansion x length a kelvin, and nothing else is.
- *Turns with errors* is asked of parallel layouts: rows are unit lines of wires and of folds, unit
  scaled couples of bellows. A sheet has no three lines of its own: four readings are accepted (an
  orthonormal basis; along the middle and across at both ends; along both edges and across the
  middle; along and across the middle with the couple across the sheet).
- *Order*: `rank_by` never gets worse down the list, as written in `scores`.
- *Symmetry* that a problem asks for holds for the solids ("mirror x": across the plane x = centre).
"""

from __future__ import annotations

import itertools
import json
import math
import re
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from design_classes import (
    Json,
    Real,
    boxes_of,
    centre_of,
    classify,
    complement,
    freedom,
    orthonormal,
    points_of,
    spin,
    unit,
)
from design_structure import CLOSE, EXPANSION, Structure
from oracle_elements import frame

#: Between two layouts, in parts of L.
SAME_PLACE = 1e-6
#: Scores.
PERCENT = 0.01
KINDS = ("wire", "sheet", "waisted sheet", "folded sheet", "notch", "bellows")
CONDITIONS = ("wires", "regions", "length", "width", "keep-out", "clearance", "symmetry")
#: What a beam holds, by kind of flexure.
HELD = {
    "wire": [{1}],
    "sheet": [{1, 3, 4}],
    "waisted sheet": [{1, 3}, {1, 4}],
    "bellows": [{2}],
}
NUMBERS = {"a": 1, "one": 1, "two": 2, "three": 3, "four": 4, "five": 5, "six": 6, "seven": 7} | {
    "eight": 8,
    "nine": 9,
    "ten": 10,
    "twelve": 12,
}


def covered(start: Real, end: Real, boxes: list[Real], tolerance: float) -> bool:
    """Whether a segment lies in a union of boxes."""
    spans = []
    step = end - start
    for low, high in boxes:
        first, last = 0.0, 1.0
        for axis in range(3):
            room = low[axis] - tolerance - start[axis], high[axis] + tolerance - start[axis]
            if abs(step[axis]) < 1e-15:
                if room[0] > 0 or room[1] < 0:
                    first, last = 1.0, 0.0
                continue
            cuts = sorted(value / step[axis] for value in room)
            first, last = max(first, cuts[0]), min(last, cuts[1])
        if first <= last:
            spans.append((first, last))
    reached = 0.0
    for first, last in sorted(spans):
        if first > reached + 1e-12:
            break
        reached = max(reached, last)
    return bool(spans) and reached >= 1.0 and min(spans)[0] <= 0.0


@dataclass(frozen=True)
class Solid:
    """Points centre + a . axes, |a| <= 1 each, and what is within a radius of them."""

    centre: Real
    axes: Real
    radius: float = 0.0

    def moved(self, turn: Real, about: Real) -> Solid:
        return Solid(about + turn @ (self.centre - about), self.axes @ turn.T, self.radius)


def distance(one: Solid, other: Solid) -> float:
    """Between the surfaces of two solids; negative by the radii alone where they overlap."""
    from scipy.optimize import lsq_linear

    between = other.centre - one.centre
    matrix = np.vstack([one.axes, -other.axes]).T
    size = max(float(np.max(np.linalg.norm(matrix, axis=0), initial=0.0)), 1e-300)
    # The thinnest axes are left to their own scale: bounds are of a, not of lengths.
    found = lsq_linear(matrix / size, between / size, bounds=(-1.0, 1.0), method="bvls", tol=1e-14)
    nearest = size * float(np.linalg.norm(matrix @ found.x / size - between / size))
    return nearest - one.radius - other.radius


def solids(flexure: Json) -> list[Solid]:
    ends = np.array(flexure["ends"], dtype=float)
    kind = flexure["kind"]
    width, thickness = flexure.get("width") or 0.0, flexure.get("thickness") or 0.0
    if kind == "folded sheet":
        fold = np.array(flexure["fold"]["point"], dtype=float)
        along = unit(flexure["fold"]["direction"])
        return [_plate(end, fold, along, width, thickness) for end in ends]
    if kind in ("sheet", "waisted sheet"):
        along = np.cross(unit(flexure["normal"]), unit(ends[1] - ends[0]))
        return [_plate(ends[0], ends[1], along, width, thickness)]
    radius = (flexure.get("diameter") or thickness) / 2
    return [Solid(ends.mean(axis=0), (ends[1:] - ends[:1]) / 2, radius)]


def _plate(start: Real, end: Real, along: Real, width: float, thickness: float) -> Solid:
    across = unit(np.cross(end - start, along))
    axes = np.array([(end - start) / 2, along * width / 2, across * thickness / 2])
    return Solid((start + end) / 2, axes)


def box_solid(box: Real) -> Solid:
    return Solid(box.mean(axis=0), np.diag((box[1] - box[0]) / 2))


def judge_layout(problem: Json, layout: Json) -> tuple[list[str], list[str]]:
    """What is wrong with a layout, and remarks."""
    wrong = _shape(problem, layout)
    if wrong:
        return wrong, []
    flexures, remarks = layout["flexures"], []
    names = [flexure["name"] for flexure in flexures]
    try:
        structure = Structure(layout["deck"], problem, names)
    except (ValueError, KeyError, IndexError) as error:
        return [f"the deck cannot be read: {error}"], []
    for label in structure.strays:
        wrong.append(f"element {label} ({structure.names.get(label)}) is of no flexure of the list")
    for flexure in flexures:
        wrong += [f"{flexure['name']}: {text}" for text in _against_deck(structure, flexure)]
        bad, said = _against_limits(problem, flexure)
        wrong += [f"{flexure['name']}: {text}" for text in bad]
        remarks += [f"{flexure['name']}: {text}" for text in said]
    wrong += _bodies_between(problem, structure, layout)
    wrong += _apart(problem, structure, flexures)
    wrong += _weight(problem, structure)
    if isinstance(layout["stage"], str) and layout["stage"] != "stage":
        wrong.append(f"calls the stage {layout['stage']}")
    wrong += _mobility(problem, structure, layout)
    wrong += _scores(problem, structure, layout)
    asked = problem.get("symmetry", problem["limits"].get("symmetry", "any"))
    if asked not in ("any", "none", None) and not symmetric(problem, flexures, asked):
        wrong.append(f"is not its own image under the symmetry asked for, {asked}")
    wrong += _words(layout)
    return wrong, remarks


def _shape(problem: Json, layout: Json) -> list[str]:
    """Keys that are missing, without which nothing can be judged."""
    keys = ("number", "what", "deck", "stage", "flexures", "over_constrained", "internal", "scores")
    wrong = [f"has no {key}" for key in (*keys, "symmetry", "alike") if key not in layout]
    names = [flexure.get("name") for flexure in layout.get("flexures", [])]
    wrong += [f"two flexures are called {name}" for name in set(names) if names.count(name) > 1]
    for flexure in layout.get("flexures", []):
        missing = [k for k in ("name", "kind", "ends", "between") if not flexure.get(k)]
        kind = flexure.get("kind")
        if kind not in KINDS:
            wrong.append(f"{flexure.get('name')}: unknown kind {kind}")
        missing += [
            k for k in ("width", "thickness") if "sheet" in str(kind) and not flexure.get(k)
        ]
        missing += ["diameter"] if kind == "wire" and not flexure.get("diameter") else []
        missing += ["fold"] if kind == "folded sheet" and not flexure.get("fold") else []
        flat = kind in ("sheet", "waisted sheet")
        missing += ["normal"] if flat and not np.any(flexure.get("normal") or 0) else []
        wrong += [f"{flexure.get('name')}: has no {key}" for key in missing]
        numbers = json.dumps({k: v for k, v in flexure.items() if k != "name"})
        if re.search(r"NaN|Infinity", numbers):
            wrong.append(f"{flexure.get('name')}: has numbers that are none")
    if problem["wanted"] is not None and len(problem["wanted"]) < 6 and not names:
        wrong.append("has no flexures")
    return wrong


def _against_deck(structure: Structure, flexure: Json) -> list[str]:
    """Ends, bodies, sections and held deformations as in the deck."""
    deck, size = structure.deck, structure.problem["size"]
    labels = [n for n, owner in structure.owner.items() if owner == flexure["name"]]
    if not labels:
        return ["is not in the deck"]
    inside = {node for label in labels for node in structure.elements[label].nodes}
    outside = {
        node
        for label, element in structure.elements.items()
        if label not in labels
        for node in element.nodes
    }
    ends = [
        node
        for node in sorted(inside)
        if deck.kinds[node] == "p" and (node in outside or structure.bodies[node] in NAMED)
    ]
    wrong = []
    for end, body in zip(flexure["ends"], flexure["between"], strict=True):
        near = [
            n for n in ends if np.linalg.norm(np.subtract(deck.position[n], end)) < CLOSE * size
        ]
        if not near:
            wrong.append(f"the deck has no end of it at {_place(end)}")
        elif body not in {structure.bodies[node] for node in near} and any(
            structure.bodies[node] for node in near
        ):
            held = structure.bodies[near[0]]
            wrong.append(f"its end at {_place(end)} is on {held} in the deck, not on {body}")
    if len(ends) > 2:
        wrong.append(f"has {len(ends)} ends in the deck")
    kind = flexure["kind"]
    pieces = {"wire": 1, "sheet": 1, "folded sheet": 2, "bellows": 1}
    if kind in pieces and len(labels) != pieces[kind]:
        wrong.append(f"is of {len(labels)} elements, not {pieces[kind]}")
    if kind == "folded sheet":
        fold = flexure["fold"]["point"]
        inner = [n for n in inside - set(ends) if deck.kinds[n] == "p"]
        if not any(
            np.linalg.norm(np.subtract(deck.position[n], fold)) < CLOSE * size for n in inner
        ):
            wrong.append(f"the deck has no fold of it at {_place(fold)}")
    for label in labels:
        wrong += _against_element(structure, label, flexure)
    return wrong


NAMED = ("stage", "ground")


def _against_element(structure: Structure, label: int, flexure: Json) -> list[str]:
    element, kind, wrong = structure.elements[label], flexure["kind"], []
    held = {k for k in range(1, 7) if structure.deck.deformations.get((label, str(k))) == "fixed"}
    if kind in HELD and held not in HELD[kind]:
        wrong.append(f"element {label} holds {sorted(held)}, which is no {kind}")
    if kind == "waisted sheet" and held in HELD[kind]:
        # In-plane bending at p and q: where it is not held, there is the waist.
        end = structure.deck.position[element.nodes[0 if 4 in held else 2]]
        waist = np.array(flexure.get("waist") or [math.inf] * 3, dtype=float).reshape(-1)[:3]
        if not np.linalg.norm(waist - end) < CLOSE * structure.problem["size"]:
            wrong.append(f"its waist is at {_place(end)} in the deck, not at {_place(waist)}")
    if kind not in ("wire", "sheet", "folded sheet"):
        return wrong
    material = structure.problem.get("material")
    width, thickness = flexure.get("width") or 0.0, flexure.get("thickness") or 0.0
    if kind == "wire":
        expected = circle(flexure["diameter"])
    else:
        expected = rectangle(width, thickness)
        p, q = (np.array(structure.deck.position[element.nodes[k]]) for k in (0, 2))
        across = frame(q - p, element.vector)[:, 1]
        normal = flexure.get("normal")
        if kind == "folded sheet":
            normal = np.cross(q - p, flexure["fold"]["direction"])
        if (
            abs(unit(normal) @ unit(q - p)) > 1e-9
            or np.linalg.norm(np.cross(across, unit(normal))) > 1e-9
        ):
            wrong.append(f"element {label} lies in another plane than its normal says")
    if isinstance(material, dict) and "E" in material:
        young, shear, density = material["E"], material["G"], material["density"]
        area, torsion, iy, iz, factor = expected(young / (2 * shear) - 1)
        stiff = [young * area, shear * torsion, young * iy, young * iz]
        given = structure.numbers["ESTIFF"].get(label, [])
        if len(given) < 4 or not np.allclose(given[:4], stiff, rtol=1e-4, atol=0):
            wrong.append(f"element {label} has ESTIFF {given[:4]}, its section gives {stiff}")
        shears = [young * i / (factor * shear * area) for i in (iy, iz)]
        if given[4:6] and not np.allclose(given[4:6], shears, rtol=1e-3, atol=0):
            wrong.append(f"element {label} has shear {given[4:6]}, its section gives {shears}")
        mass = structure.numbers["EM"].get(label, [0.0])
        if not math.isclose(mass[0], density * area, rel_tol=1e-6):
            wrong.append(f"element {label} has mass {mass[0]} a metre, not {density * area}")
    return wrong


def circle(diameter: float) -> Any:
    """Area, torsion, two bendings and shear factor of a circle, by Poisson's ratio."""
    second = math.pi * diameter**4 / 64
    area = math.pi * diameter**2 / 4
    return lambda nu: (area, 2 * second, second, second, 6 * (1 + nu) / (7 + 6 * nu))


def rectangle(width: float, thickness: float) -> Any:
    """The same of a rectangle, y across it (thickness), z along its width."""
    b, t = max(width, thickness), min(width, thickness)
    series = sum(math.tanh(n * math.pi * b / (2 * t)) / n**5 for n in range(1, 60, 2))
    torsion = b * t**3 / 3 * (1 - 192 / math.pi**5 * t / b * series)
    iy, iz = thickness * width**3 / 12, width * thickness**3 / 12
    return lambda nu: (width * thickness, torsion, iy, iz, 10 * (1 + nu) / (12 + 11 * nu))


def _within(value: float, limit: Any) -> bool:
    if limit is None:
        return True
    low, high = (limit, limit) if isinstance(limit, (int, float)) else limit
    return bool(low * (1 - 1e-9) <= value <= high * (1 + 1e-9))


def _against_limits(problem: Json, flexure: Json) -> tuple[list[str], list[str]]:
    """Kind, sizes, regions and keep-outs of a flexure."""
    limits, kind, size = problem["limits"], flexure["kind"], problem["size"]
    wrong, remarks = [], []
    if limits.get("kinds") and kind not in limits["kinds"]:
        wrong.append(f"is a {kind}, which is not among {', '.join(limits['kinds'])}")
    ends = np.array(flexure["ends"], dtype=float)
    lengths = [float(np.linalg.norm(ends[1] - ends[0]))]
    along = np.zeros(3)
    if kind == "folded sheet":
        fold, along = np.array(flexure["fold"]["point"]), unit(flexure["fold"]["direction"])
        lengths = [float(np.linalg.norm(end - fold)) for end in ends]
        if np.linalg.norm(np.cross(ends[0] - fold, ends[1] - fold)) < 1e-6 * np.prod(lengths):
            wrong.append("its leaves lie in one plane")
        if max(abs((end - fold) @ along) for end in ends) > CLOSE * size:
            wrong.append("its fold is not across its leaves")
    elif kind in ("sheet", "waisted sheet"):
        along = np.cross(unit(flexure["normal"]), unit(ends[1] - ends[0]))
    asked = limits.get("length")
    if not all(_within(length, asked) for length in lengths):
        text = f"is {', '.join(f'{length:.6g}' for length in lengths)} m long, not within {asked}"
        if len(lengths) == 2 and _within(sum(lengths), asked):
            remarks.append(f"each leaf {text}, both together are")
        else:
            wrong.append(text)
    sizes = ["diameter"] if kind == "wire" else ["width", "thickness"] if "sheet" in kind else []
    for key in sizes:
        if not _within(flexure[key], limits.get(key)):
            wrong.append(f"its {key} of {flexure[key]:.6g} m is not within {limits[key]}")
    for end, body in zip(ends, flexure["between"], strict=True):
        half = along * (flexure.get("width") or 0.0) / 2
        boxes, points = boxes_of(problem, body), points_of(problem, body)
        if body not in NAMED:
            boxes, points = boxes_of(problem, "intermediate"), points_of(problem, "intermediate")
            half = half * 0
            if not boxes and not points:
                continue
        at_point = any(np.linalg.norm(end - point) < CLOSE * size for point in points)
        if not at_point and not covered(end - half, end + half, boxes, CLOSE * size):
            edge = "edge" if np.any(half) else "end"
            wrong.append(f"its {edge} at {_place(end)} is not within the regions of {body}")
    return wrong, remarks


def _place(point: Any) -> str:
    return f"({', '.join(f'{value:.6g}' for value in point)})"


def _bodies_between(problem: Json, structure: Structure, layout: Json) -> list[str]:
    """Number of bodies between, and that no body is in a keep-out."""
    wrong = []
    named = {body for flexure in layout["flexures"] for body in flexure["between"]}
    between = named - {"stage", "ground"}
    most = problem["limits"].get("bodies")
    if most is not None and len(between) > most:
        wrong.append(f"has {len(between)} bodies between, not {most} at most")
    for flexure in layout["flexures"]:
        if flexure["between"][0] == flexure["between"][1]:
            wrong.append(f"{flexure['name']} has both ends on {flexure['between'][0]}")
        for end, body in zip(flexure["ends"], flexure["between"], strict=True):
            for low, high in boxes_of(problem, "keep_out"):
                inside = np.all(np.array(end) > low) and np.all(np.array(end) < high)
                if inside and body in between:
                    wrong.append(f"{body} has a point in a keep-out, {_place(end)}")
    return wrong


def _apart(problem: Json, structure: Structure, flexures: list[Json]) -> list[str]:
    """Clearance between flexures and to keep-outs."""
    wrong = []
    least = problem["limits"].get("clearance") or 0.0
    slack = CLOSE * problem["size"]
    shapes = [(flexure["name"], solids(flexure)) for flexure in flexures]
    for (name, ours), (other, theirs) in itertools.combinations(shapes, 2):
        gap = min(distance(a, b) for a in ours for b in theirs)
        if gap < least - slack:
            wrong.append(f"{name} and {other} are {gap:.6g} m apart, not {least:.6g}")
    for box in boxes_of(problem, "keep_out"):
        for name, ours in shapes:
            gap = min(distance(solid, box_solid(box)) for solid in ours)
            if gap < least - slack:
                wrong.append(
                    f"{name} is {gap:.6g} m from the keep-out at {_place(box[0])}, not {least:.6g}"
                )
    return wrong


def _weight(problem: Json, structure: Structure) -> list[str]:
    """Mass and inertia of the stage in the deck."""
    mass, inertia = structure.weight()
    asked = problem.get("mass") or 0.0
    given = problem.get("inertia") or 0.0
    tensor = given * np.eye(3) if isinstance(given, (int, float)) else _inertia(given)
    wrong = []
    if not math.isclose(mass, asked, rel_tol=1e-9):
        wrong.append(f"the stage has {mass:.6g} kg in the deck, not {asked:.6g}")
    if np.max(np.abs(inertia - tensor)) > 1e-9 * max(asked * problem["size"] ** 2, 1e-300):
        wrong.append("the stage has another inertia about the centre in the deck")
    return wrong


def _mobility(problem: Json, structure: Structure, layout: Json) -> list[str]:
    """Verdict, freedom of the stage, inner motions."""
    wrong, space = [], freedom(problem)
    try:
        under, over = structure.verdict()
        moves, internal = structure.motions()
    except ValueError as error:
        return [f"its constraints cannot be judged: {error}"]
    if under:
        wrong.append(f"is under-constrained by {under} beside what is declared")
    if over != layout["over_constrained"]:
        wrong.append(f"has {over} self-stresses, not the {layout['over_constrained']} that it says")
    if over > (problem["limits"].get("over_constraint") or 0):
        wrong.append(f"is over-constrained by {over}, more than asked")
    if internal != layout["internal"]:
        wrong.append(f"has {internal} inner motions, not the {layout['internal']} that it says")
    if len(moves) != len(space):
        wrong.append(f"leaves {len(moves)} motions of the stage, {len(space)} are wanted")
    elif len(space):
        error = float(np.linalg.norm(moves - moves @ space.T @ space, 2))
        if not error <= CLOSE:
            wrong.append(f"its freedom is {error:.3g} off the wanted one")
    return wrong


def _scores(problem: Json, structure: Structure, layout: Json) -> list[str]:
    """Scores that can be computed from the deck, within a percent."""
    given, wrong = layout["scores"], []
    space = freedom(problem)
    try:
        computed = structure.elastic().scores(space, bool(problem.get("mass")))
    except (np.linalg.LinAlgError, ValueError) as error:
        return [f"its stiffness cannot be computed: {error}"]
    for key, value in computed.items():
        optional = key == "separation"
        if given.get(key) is None:
            wrong += [] if optional else [f"has no score {key}"]
        elif not math.isclose(given[key], value, rel_tol=PERCENT, abs_tol=_nothing(key, problem)):
            wrong.append(f"its {key} is {value:.6g}, not {given[key]:.6g}")
    if given.get("turns_with_errors") is not None:
        values = turns_with_errors(problem, layout["flexures"])
        if values and not any(
            math.isclose(given["turns_with_errors"], value, rel_tol=PERCENT) for value in values
        ):
            said = " or ".join(sorted({f"{value:.6g}" for value in values}))
            wrong.append(f"its turns_with_errors is {said}, not {given['turns_with_errors']:.6g}")
    for key, value in given.items():
        if isinstance(value, float) and not math.isfinite(value):
            wrong.append(f"its {key} is {value}")
    return wrong


def _nothing(key: str, problem: Json) -> float:
    """A drift by symmetry is rounding, which no percent can compare."""
    alpha = (problem.get("material") or {}).get("expansion", EXPANSION)
    return 1e-6 * alpha * problem["size"] if key == "thermal_drift" else 0.0


def turns_with_errors(problem: Json, flexures: list[Json]) -> list[float]:
    """1 / least singular value of unit constraint lines on W, for each reading of a sheet.

    Nothing for layouts that are not in parallel, and where a flexure is no line, sheet or couple.
    """
    centre, size, space = centre_of(problem), problem["size"], freedom(problem)
    across = complement(space)
    readings: list[list[Real]] = [[], [], [], []]

    def row(direction: Real, point: Real) -> Real:
        return np.concatenate([np.cross(point - centre, direction) / size, direction])

    for flexure in flexures:
        ends, kind = np.array(flexure["ends"], dtype=float), flexure["kind"]
        if set(flexure["between"]) != set(NAMED) or kind in ("notch", "waisted sheet"):
            return []
        u, middle = unit(ends[1] - ends[0]), ends.mean(axis=0)
        if kind == "sheet":
            b = np.cross(unit(flexure["normal"]), u)
            half = b * flexure["width"] / 2
            couple = np.concatenate([unit(flexure["normal"]), np.zeros(3)])
            three = [row(u, middle), row(b, ends[0]), row(b, ends[1])]
            choices = [
                list(orthonormal(np.array(three))),
                three,
                [row(u, middle + half), row(u, middle - half), row(b, middle)],
                [row(u, middle), row(b, middle), couple],
            ]
        elif kind == "folded sheet":
            line = row(unit(flexure["fold"]["direction"]), np.array(flexure["fold"]["point"]))
            choices = [[line]] * 4
        elif kind == "bellows":
            choices = [[np.concatenate([u, np.zeros(3)])]] * 4
        else:
            choices = [[row(u, middle)]] * 4
        for reading, rows in zip(readings, choices, strict=True):
            reading += rows
    if len(across) == 0:
        return []
    found = [np.linalg.svd(np.array(rows) @ across.T, compute_uv=False) for rows in readings]
    return [float(1 / values[len(across) - 1]) for values in found if len(values) >= len(across)]


def _words(layout: Json) -> list[str]:
    """Numbers of flexures in words, where a kind is told once."""
    what, wrong = layout["what"].lower(), []
    for kind in ("wire", "sheet", "folded sheet", "waisted sheet"):
        told = [
            NUMBERS.get(count, int(count) if count.isdigit() else None)
            for count in re.findall(rf"\b(\w+) {kind}s?\b", what)
        ]
        counts = [count for count in told if count is not None]
        count = sum(flexure["kind"] == kind for flexure in layout["flexures"])
        if len(counts) == 1 and counts[0] != count:
            wrong.append(f"says {layout['what']!r}, but has {count} of kind {kind}")
    return wrong if what.strip() else ["has no words"]


def signed_permutations() -> list[Real]:
    """The 48 isometries that keep the axes."""
    return [
        np.eye(3)[list(order)] * np.array(signs)[:, None]
        for order in itertools.permutations(range(3))
        for signs in itertools.product((1.0, -1.0), repeat=3)
    ]


def isometries(problem: Json) -> list[Real]:
    """Those of the 48 about the centre that keep the problem."""
    centre, size, space = centre_of(problem), problem["size"], freedom(problem)
    found = []
    for turn in signed_permutations():
        sense = np.linalg.det(turn)
        turned = np.hstack([space[:, :3] @ turn.T * sense, space[:, 3:] @ turn.T])
        same = len(space) == 0 or np.max(np.abs(turned - turned @ space.T @ space)) < 1e-9
        inertia = problem.get("inertia")
        if isinstance(inertia, (list, tuple)):
            matrix = _inertia(inertia)
            same = same and np.allclose(turn @ matrix @ turn.T, matrix, rtol=1e-9)
        for region in ("stage", "ground", "keep_out", "intermediate"):
            if not same:
                break
            boxes = [(box - centre) for box in boxes_of(problem, region)]
            points = [(point - centre)[None] for point in points_of(problem, region)]
            for items in (boxes, points):
                moved = [np.sort(item @ turn.T, axis=0) for item in items]
                same = same and _same_set(items, moved, 1e-9 * size)
        if same:
            found.append(turn)
    return found


def _inertia(values: Any) -> Real:
    if len(values) == 3:
        return np.diag(np.array(values, dtype=float))
    xx, xy, xz, yy, yz, zz = values
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def _same_set(ours: list[Real], theirs: list[Real], tolerance: float) -> bool:
    left = list(theirs)
    for item in ours:
        hit = next((k for k, o in enumerate(left) if np.max(np.abs(o - item)) < tolerance), None)
        if hit is None:
            return False
        del left[hit]
    return not left


def _alike(one: Json, other: Json, turn: Real, centre: Real, size: float) -> bool:
    """Whether a flexure, turned, is another one."""
    near = SAME_PLACE * size
    if one["kind"] != other["kind"]:
        return False
    for key in ("width", "thickness", "diameter"):
        if abs((one.get(key) or 0.0) - (other.get(key) or 0.0)) > near:
            return False

    def move(point: Any) -> Real:
        return np.array(centre + turn @ (np.array(point, dtype=float) - centre))

    ends, theirs = [move(end) for end in one["ends"]], np.array(other["ends"], dtype=float)
    for order in ([0, 1], [1, 0]):
        roles = [(a if a in NAMED else "body") for a in one["between"]]
        others = [(other["between"][k] if other["between"][k] in NAMED else "body") for k in order]
        if roles == others and np.max(np.abs(np.array(ends) - theirs[order])) < near:
            break
    else:
        return False
    if "fold" in one and one["fold"] and other.get("fold"):
        if np.linalg.norm(move(one["fold"]["point"]) - other["fold"]["point"]) > near:
            return False
        lines = turn @ unit(one["fold"]["direction"]), unit(other["fold"]["direction"])
        if np.linalg.norm(np.cross(*lines)) > SAME_PLACE:
            return False
    elif "sheet" in one["kind"]:
        lines = turn @ unit(one["normal"]), unit(other["normal"])
        if np.linalg.norm(np.cross(*lines)) > SAME_PLACE:
            return False
    for key in ("waist", "notches", "via"):
        ours, them = one.get(key), other.get(key)
        if isinstance(ours, list) and ours and isinstance(them, list) and _numeric(ours):
            moved = [move(p) for p in np.array(ours, dtype=float).reshape(-1, 3)]
            if not _same_set(moved, list(np.array(them, dtype=float).reshape(-1, 3)), near):
                return False
    return True


def _numeric(values: Any) -> bool:
    try:
        return np.array(values, dtype=float).size % 3 == 0
    except (TypeError, ValueError):
        return False


def image(problem: Json, ours: list[Json], theirs: list[Json], turn: Real) -> bool:
    """Whether some flexures, turned about the centre, are others."""
    if len(ours) != len(theirs):
        return False
    centre, size = centre_of(problem), problem["size"]
    left = list(theirs)
    for flexure in ours:
        hit = next((k for k, o in enumerate(left) if _alike(flexure, o, turn, centre, size)), None)
        if hit is None:
            return False
        del left[hit]
    return True


def symmetry_matrix(asked: str) -> Real:
    """The isometry of "mirror x" or "3-fold about z".

    Raises:
        ValueError: other words.
    """
    if found := re.fullmatch(r"mirror (?:across )?([xyz])", asked):
        axis = "xyz".index(found[1])
        return np.diag([-1.0 if k == axis else 1.0 for k in range(3)])
    if found := re.fullmatch(r"(\d+)-fold about ([xyz])", asked):
        angle, k = 2 * math.pi / int(found[1]), spin(np.eye(3)["xyz".index(found[2])])
        return np.array(np.eye(3) + math.sin(angle) * k + (1 - math.cos(angle)) * k @ k)
    raise ValueError(f"no symmetry is called {asked!r}")


def symmetric(problem: Json, flexures: list[Json], asked: str) -> bool:
    """Whether flexures are their own image under the symmetry of some words."""
    return image(problem, flexures, flexures, symmetry_matrix(asked))


def examine(problem: Json, answer: Json) -> tuple[list[str], list[str]]:
    """What is wrong with an answer, and remarks on readings."""
    wrong, remarks = _classes(problem, answer), []
    layouts = answer.get("layouts")
    if not isinstance(layouts, list):
        return [*wrong, "the answer has no layouts"], []
    expected = problem.get("expect", {})
    if "layout_exists" in expected and bool(layouts) != expected["layout_exists"]:
        wrong.append(f"there are {len(layouts)} layouts; " + _expected(expected))
    none = answer.get("none")
    if not layouts:
        if not isinstance(none, dict) or none.get("condition") not in CONDITIONS:
            wrong.append(f"no layout, and no condition that leaves none: {none}")
        elif "why" in expected and none["condition"] not in _reasons(expected["why"]):
            wrong.append(f"no layout by {none['condition']}, not by {expected['why']}")
        if "nearby" not in answer:
            wrong.append("no layout, and nothing of what is possible nearby")
        if isinstance(none, dict) and not str(none.get("statement", "")).strip():
            wrong.append("no layout, and no sentence about it")
    elif none:
        wrong.append("says why there is none beside layouts")
    for place, layout in enumerate(layouts, start=1):
        bad, said = judge_layout(problem, layout)
        wrong += [f"layout {place}: {text}" for text in bad]
        remarks += [f"layout {place}: {text}" for text in said]
        if layout.get("number") != place:
            wrong.append(f"layout {place} has the number {layout.get('number')}")
    wrong += _images(problem, layouts)
    wrong += _order(answer, layouts)
    return wrong, remarks


def moved(problem: Json, turn: Real, shift: Real, scale: float) -> Json:
    """A problem turned about the origin by a signed permutation, scaled, and shifted then."""
    result = json.loads(json.dumps(problem))
    sense = float(np.sign(np.linalg.det(turn)))

    def point(at: Any) -> list[float]:
        return [float(value) for value in shift + scale * (turn @ np.array(at, dtype=float))]

    for motion in result["wanted"]:
        motion["direction"] = (turn @ np.array(motion["direction"], dtype=float)).tolist()
        motion |= {"point": point(motion["point"])} if "point" in motion else {}
        motion |= {"pitch": sense * scale * motion["pitch"]} if "pitch" in motion else {}
    for name in ("stage", "ground", "keep_out", "intermediate"):
        if name in result:
            boxes = [[point(corner) for corner in box] for box in boxes_of(problem, name)]
            result[name] = {"boxes": [np.sort(np.array(box), axis=0).tolist() for box in boxes]}
            result[name]["points"] = [point(at) for at in points_of(problem, name)]
    result["centre"], result["size"] = point(centre_of(problem)), scale * problem["size"]
    for key in ("length", "width", "thickness", "diameter", "clearance"):
        if key in result["limits"]:
            result["limits"][key] = (scale * np.array(result["limits"][key])).tolist()
    if isinstance(result.get("inertia"), float):
        result["inertia"] *= scale**5
    if "mass" in result:
        result["mass"] *= scale**3
    return dict(result)


def correspond(problem: Json, one: Json, other: Json, way: tuple[Real, Real, float]) -> list[str]:
    """What differs between the layouts of a problem and of the moved one, up to its isometries.

    Args:
        problem: The first problem.
        one: Its answer.
        other: The answer to `moved(problem, *way)`.
        way: Signed permutation, shift, scale.
    """
    turn, shift, scale = way
    there = moved(problem, turn, shift, scale)
    turns = isometries(there)
    left, wrong = [layout["flexures"] for layout in other["layouts"]], []

    def point(at: Any) -> list[float]:
        return [float(value) for value in shift + scale * (turn @ np.array(at, dtype=float))]

    for layout in one["layouts"]:
        flexures = json.loads(json.dumps(layout["flexures"]))
        for flexure in flexures:
            flexure["ends"] = [point(end) for end in flexure["ends"]]
            for key in ("width", "thickness", "diameter"):
                flexure[key] = scale * (flexure.get(key) or 0.0)
            if flexure.get("normal"):
                flexure["normal"] = (turn @ np.array(flexure["normal"])).tolist()
            if flexure.get("fold"):
                along = (turn @ np.array(flexure["fold"]["direction"])).tolist()
                flexure["fold"] = {"point": point(flexure["fold"]["point"]), "direction": along}
            if flexure.get("waist"):
                flexure["waist"] = point(flexure["waist"])
        hit = next(
            (k for k, o in enumerate(left) if any(image(there, flexures, o, t) for t in turns)),
            None,
        )
        if hit is None:
            wrong.append(f"layout {layout['number']} is not among those of the moved problem")
        else:
            del left[hit]
    return wrong + [f"{len(left)} layouts of the moved problem are others"] * bool(left)


def judge(problem: Json, answer: Json) -> list[str]:
    """Everything that is wrong with an answer, in words; nothing where it is right."""
    return examine(problem, answer)[0]


def _reasons(why: Any) -> list[str]:
    return [why] if isinstance(why, str) else list(why)


def _expected(expected: Json) -> str:
    return "some exist" if expected["layout_exists"] else f"none is possible, by {expected['why']}"


def _classes(problem: Json, answer: Json) -> list[str]:
    """Dimension and least numbers, against a classification of this file and what is expected."""
    wrong, own = [], classify(freedom(problem))
    for key, value in problem.get("expect", {}).items():
        if key in own and own[key] != (
            sorted(value[:2], reverse=True) + value[2:] if "signature" in key else value
        ):
            wrong.append(f"the problem expects {key} {value}, computed is {own[key]}")
    kinds = answer.get("kinds")
    given: Json = {
        "dimension": (answer.get("wanted") or {}).get("dimension"),
        "parallel_wires": answer.get("parallel"),
    }
    if answer.get("needed") != 6 - own["dimension"]:
        wrong.append(f"needed is {answer.get('needed')}, not {6 - own['dimension']}")
    if isinstance(kinds, dict):
        given["least_wires"], given["with_sheet"] = kinds.get("wires"), kinds.get("sheet")
        given["least_layers"] = kinds.get("layers")
        given["extra_freedom_of_wires_alone"] = kinds.get("extra")
    else:
        wrong.append("the answer has no kinds, the least numbers")
    return wrong + [
        f"{key} is {value}, not {own[key]}" for key, value in given.items() if value != own[key]
    ]


def _images(problem: Json, layouts: list[Json]) -> list[str]:
    """Layouts that are images of each other, and counts of images."""
    wrong, turns = [], isometries(problem)
    whole = [n for n, layout in enumerate(layouts) if not _shape(problem, layout)]
    for one, other in itertools.combinations(whole, 2):
        ours, theirs = layouts[one]["flexures"], layouts[other]["flexures"]
        if any(image(problem, ours, theirs, turn) for turn in turns):
            wrong.append(f"layouts {one + 1} and {other + 1} are images of each other")
    for n in whole:
        alike = layouts[n]["alike"]
        if not isinstance(alike, int) or not 1 <= alike <= len(turns):
            wrong.append(f"layout {n + 1} stands for {alike} images, of {len(turns)} isometries")
    return wrong


def _order(answer: Json, layouts: list[Json]) -> list[str]:
    """Order by `rank_by`, and no layout of the Pareto set that another one beats."""
    rank = answer.get("rank_by")
    if not isinstance(rank, str) or not rank:
        return ["the answer does not say rank_by"]
    key, wrong = rank.removeprefix("lower:"), []
    values = [layout.get("scores", {}).get(key) for layout in layouts]
    if any(value is None for value in values):
        wrong.append(f"not all layouts have {key}, by which they are ranked")
    else:
        sense = 1 if rank.startswith("lower:") else -1
        for n, (one, other) in enumerate(itertools.pairwise(values), start=1):
            if sense * one > sense * other + 1e-9 * abs(other):
                wrong.append(f"layout {n + 1} is before {n} by {rank}")

    def vector(layout: Json) -> Real:
        scores = layout["scores"]
        keys = ("worst_stiffness", "first_parasitic_frequency")
        goods = [scores.get(key) or 0.0 for key in keys]
        return np.array([*goods, -(scores.get("drive_stiffness") or 0.0), -len(layout["flexures"])])

    marked = [n for n, layout in enumerate(layouts) if layout.get("pareto")]
    for n, other in itertools.product(marked, range(len(layouts))):
        if n != other and "scores" in layouts[n] and "scores" in layouts[other]:
            ours, theirs = vector(layouts[n]), vector(layouts[other])
            room = 1e-6 * np.abs(ours)
            if np.all(theirs >= ours + room * (ours != theirs)) and np.any(theirs > ours + room):
                wrong.append(
                    f"layout {n + 1} is said to be of the Pareto set; {other + 1} beats it"
                )
    return wrong


def main() -> int:
    """Print what is wrong with an answer to a problem."""
    problem, answer = (json.loads(Path(name).read_text(encoding="utf-8")) for name in sys.argv[1:3])
    wrong, remarks = examine(problem, answer)
    print("\n".join([*wrong, *(f"remark: {text}" for text in remarks)]) or "nothing is wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
