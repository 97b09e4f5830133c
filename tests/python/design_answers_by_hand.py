# SPDX-License-Identifier: BSD-3-Clause
"""Answers to design problems that somebody made by hand, with the builder alone."""

import copy
import json
import sys
from pathlib import Path
from typing import Any

import numpy as np

import flexact

REFERENCE = Path(__file__).parents[1] / "reference"
sys.path.insert(0, str(REFERENCE))
import design_classes  # noqa: E402, F401
import design_oracle  # noqa: E402
import design_search  # noqa: E402, F401
import random_freedoms  # noqa: E402, F401

Json = dict[str, Any]


def problems(name: str = "design_problems.json") -> dict[str, Json]:
    """The problems of a file, by name."""
    text = (REFERENCE / name).read_text(encoding="utf-8")
    return {problem["id"]: problem for problem in json.loads(text)["problems"]}


def layout(problem: Json, flexures: list[Json], what: str, number: int = 1) -> Json:
    """A layout of an answer from flexures: its deck, its counts, and scores of the oracle."""
    model = flexact.Model(name=what)
    inertia = problem["inertia"]
    inertia = (inertia,) * 3 if isinstance(inertia, float) else tuple(inertia)
    points: dict[str, list[tuple[float, ...]]] = {"stage": [tuple(problem["centre"])]}
    for flexure in flexures:
        for end, body in zip(flexure["ends"], flexure["between"], strict=True):
            points.setdefault(body, []).append(tuple(end))
    for name, places in points.items():
        if name != "ground":
            mass = {"mass": problem["mass"], "inertia": inertia} if name == "stage" else {}
            model.body(dict.fromkeys(places), name=name, **mass)  # type: ignore[arg-type]
    material = problem["material"]
    for flexure in flexures:
        p, q = (tuple(end) for end in flexure["ends"])
        flat = {"thickness": flexure.get("thickness"), "breadth": flexure.get("width")}
        if flexure["kind"] == "wire":
            model.wire(p, q, name=flexure["name"], thickness=flexure["diameter"], material=material)
        elif flexure["kind"] in ("sheet", "waisted sheet"):
            along = np.cross(flexure["normal"], np.subtract(q, p))
            made_of = {"name": flexure["name"], "material": material}
            made = model.sheet(p, q, tuple(along), **made_of, **flat)
            if flexure["kind"] == "waisted sheet":
                model.release(made, "in-plane bending", at=tuple(flexure["waist"]))
        else:
            fold = flexure["fold"]
            model.folded_sheet(
                p,
                tuple(fold["point"]),
                q,
                tuple(fold["direction"]),
                flexure["name"],
                material=material,
                **flat,
            )
    for place in points.get("ground", []):
        model.fix(place)
    result = flexact.analyse(model)
    record: Json = {
        "number": number,
        "what": what,
        "deck": model.to_deck(),
        "stage": "stage",
        "flexures": flexures,
        "over_constrained": result.over_constrained,
        "internal": sum(flexure["kind"] == "folded sheet" for flexure in flexures),
        "symmetry": 1,
        "alike": 1,
    }
    structure = design_oracle.Structure(record["deck"], problem, [f["name"] for f in flexures])
    declare(record, structure, len(problem["wanted"]), problem)
    space = design_oracle.freedom(problem)
    record["scores"] = structure.elastic().scores(space, bool(problem.get("mass")))
    return record


def declare(made: Json, structure: Any, count: int, problem: Json) -> None:
    """Declare as many coordinates of the stage as it has motions, those that T moves most."""
    nodes = [node for node, name in structure.bodies.items() if name == "stage"]
    p = min(node for node in nodes if structure.deck.kinds[node] == "p")
    o = min(node for node in nodes if structure.deck.kinds[node] == "o")
    left, chosen = design_oracle.freedom(problem).copy(), []
    for _ in range(count):
        best = int(np.argmax(np.linalg.norm(left, axis=0)))
        chosen.append(best)
        column = left[:, best] / np.linalg.norm(left[:, best])
        left -= np.outer(column, column @ left)
        left[:, best] = 0.0
    lines = [f"DYNX {p} {k - 2}" if k > 2 else f"DYNX {o} {k + 2}" for k in sorted(chosen)]
    made["deck"] = made["deck"].replace("\nEND\n", "\n" + "\n".join([*lines, "END", ""]), 1)


def answer(problem: Json, layouts: list[Json]) -> Json:
    """An answer with its class, as the oracle computes it."""
    own = design_oracle.classify(design_oracle.freedom(problem))
    layouts.sort(key=lambda made: -made["scores"]["worst_stiffness"])
    for number, made in enumerate(layouts, start=1):
        made["number"] = number
    return {
        "wanted": {"dimension": own["dimension"]},
        "parallel": own["parallel_wires"],
        "needed": 6 - own["dimension"],
        "kinds": {
            "wires": own["least_wires"],
            "sheet": own["with_sheet"],
            "layers": own["least_layers"],
            "extra": own["extra_freedom_of_wires_alone"],
        },
        "layouts": layouts,
        "rank_by": "worst_stiffness",
    }


def wire(name: str, p: Any, q: Any, between: tuple[str, str] = ("stage", "ground")) -> Json:
    return {"name": name, "kind": "wire", "ends": [p, q], "between": [*between], "diameter": 1e-3}


def hinge() -> tuple[Json, Json]:
    """Rotation about x: a sheet in z = 0 and two wires; five wires."""
    problem = problems()["hinge"]
    sheet = {
        "name": "sheet 1",
        "kind": "sheet",
        "ends": [[0.0, 0.02, 0.0], [0.0, 0.07, 0.0]],
        "between": ["stage", "ground"],
        "width": 0.02,
        "thickness": 0.3e-3,
        "normal": [0.0, 0.0, 1.0],
    }
    # Lines that meet the x axis: in planes through points of it.
    up = wire("wire 1", [0.015, 0.0, 0.01], [0.015, 0.0, 0.065])
    down = wire("wire 2", [-0.015, 0.0, -0.01], [-0.015, 0.0, -0.065])
    first = layout(problem, [sheet, up, down], "a sheet and two wires")
    wires = [
        up,
        down,
        wire("wire 3", [0.02, 0.02, 0.0], [0.02, 0.065, 0.0]),
        wire("wire 4", [-0.02, 0.02, 0.0], [-0.02, 0.065, 0.0]),
        wire("wire 5", [0.02, -0.02, 0.0], [0.065, -0.06, 0.0]),
    ]
    second = layout(problem, wires, "five wires")
    return problem, answer(problem, [first, second])


def guide() -> tuple[Json, Json]:
    """Translation along z by five folded sheets, folds across z, leaves out and down or up."""
    problem = copy.deepcopy(problems()["guide_folded"])
    problem["stage"] = {"boxes": [[[-0.04, -0.04, -0.02], [0.04, 0.04, 0.02]]]}
    del problem["expect"]["layout_exists"]

    def folded(
        name: str, end: list[float], out: list[float], up: float, along: list[float]
    ) -> Json:
        fold = (np.array(end) + out).tolist()
        foot = [fold[0], fold[1], fold[2] + up]
        return {
            "name": name,
            "kind": "folded sheet",
            "ends": [end, foot],
            "between": ["stage", "ground"],
            "width": 0.01,
            "thickness": 0.3e-3,
            "fold": {"point": fold, "direction": along},
        }

    flexures = [
        folded("folded 1", [0.04, -0.02, 0.01], [0.025, 0.0, 0.0], 0.055, [0.0, 1.0, 0.0]),
        folded("folded 2", [0.04, 0.02, -0.01], [0.025, 0.0, 0.0], -0.055, [0.0, 1.0, 0.0]),
        folded("folded 3", [-0.04, 0.0, 0.01], [-0.025, 0.0, 0.0], 0.055, [0.0, 1.0, 0.0]),
        folded("folded 4", [0.0, 0.04, 0.01], [0.0, 0.025, 0.0], 0.055, [1.0, 0.0, 0.0]),
        folded("folded 5", [0.0, -0.04, -0.01], [0.0, -0.025, 0.0], -0.055, [1.0, 0.0, 0.0]),
    ]
    return problem, answer(problem, [layout(problem, flexures, "five folded sheets")])


def two_layers() -> tuple[Json, Json]:
    """Translations along x and y: a guide on a guide, each a sheet and two wires."""
    problem = copy.deepcopy(problems()["xy"])
    problem["intermediate"] = {"boxes": [[[-0.05, -0.05, -0.055], [0.05, 0.05, -0.035]]]}
    upper, lower = ("stage", "body 1"), ("body 1", "ground")

    def sheet(name: str, p: Any, q: Any, between: tuple[str, str], normal: Any) -> Json:
        sizes = {"width": 0.02, "thickness": 0.3e-3, "normal": normal}
        return {"name": name, "kind": "sheet", "ends": [p, q], "between": [*between], **sizes}

    flexures = [
        sheet("sheet 1", [0.0, 0.0, -0.01], [0.0, 0.0, -0.045], upper, [0.0, 1.0, 0.0]),
        wire("wire 1", [0.0, 0.02, -0.01], [0.0, 0.02, -0.045], upper),
        wire("wire 2", [0.02, -0.02, -0.01], [-0.015, -0.02, -0.045], upper),
        sheet("sheet 2", [0.03, 0.03, -0.045], [0.03, 0.065, -0.045], lower, [1.0, 0.0, 0.0]),
        wire("wire 3", [-0.03, 0.03, -0.045], [-0.03, 0.065, -0.045], lower),
        wire("wire 4", [-0.04, -0.03, -0.045], [-0.04, -0.05, -0.07], lower),
    ]
    what = "two layers, a guide along y on a guide along x"
    return problem, answer(problem, [layout(problem, flexures, what)])


if __name__ == "__main__":
    for made in (hinge, guide, two_layers):
        print(made.__name__, design_oracle.examine(*made()))
