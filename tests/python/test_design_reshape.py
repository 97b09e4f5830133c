# SPDX-License-Identifier: BSD-3-Clause
"""Layouts with better sizes and places: better, within all limits, and exact as before.

The judge is `tests/reference/design_oracle.py`, which uses nothing of what it judges.
"""

import contextlib
import io
import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from design_answers_by_hand import Json, design_oracle, problems

import flexact
from flexact.apps.cli.main import main
from flexact.costs.request import RequestError
from flexact.designs.candidates import able
from flexact.designs.design import Designs
from flexact.designs.layouts import Layout
from flexact.designs.reshape import Shape, became, reshaped

PROBLEMS = problems()
LENS = Path(__file__).parents[2] / "input_decks" / "designs" / "lens_mount.toml"


def asked(name: str, **limits: Any) -> Json:
    """A problem, with some limits instead of its own."""
    made: Json = json.loads(json.dumps(PROBLEMS[name]))
    made["limits"] |= limits
    return {key: value for key, value in made.items() if key not in ("expect", "source")}


def wires(name: str, **limits: Any) -> Designs:
    return flexact.design({**asked(name, kinds=["wire"], **limits), "count": 2})


def is_better(layout: Layout) -> bool:
    assert layout.refined is not None
    told = layout.refined
    return told.value >= told.before if told.maximised else told.value <= told.before


# Of each a sheet, folded sheets, wires; a rank of which less is better; bodies between.
@pytest.mark.parametrize(
    ("name", "rank", "kinds"),
    [
        ("hinge", "worst_stiffness", ["wire", "sheet"]),
        ("hinge", "worst_stiffness", ["waisted sheet", "notch", "wire"]),
        ("guide_folded", "worst_stiffness", ["folded sheet"]),
        ("ball", "lower:room", ["wire"]),
        ("xyz", "first_parasitic_frequency", ["wire", "sheet"]),
    ],
)
@pytest.mark.dear(2)
def test_refined_layouts_are_better_and_hold(name: str, rank: str, kinds: list[str]) -> None:
    ranges = {"thickness": [0.2e-3, 0.4e-3], "diameter": [0.8e-3, 1.2e-3], "kinds": kinds}
    problem = {**asked(name, **ranges), "rank": rank, "count": 3, "mass": 0.2}
    designs = flexact.design(problem)
    made = designs.refined(1, 2, evaluations=40)
    assert len(made) == len(designs)
    some = [layout for layout in made if layout.refined]
    assert len(some) == 2
    assert all(is_better(layout) for layout in some)
    assert any(layout.refined and layout.refined.value != layout.refined.before for layout in some)
    assert all(layout.freedom_error < 1.0e-9 and layout.is_proven for layout in some)
    assert design_oracle.judge(problem, made.to_dict()) == []


def test_one_wire_becomes_as_short_and_thick_as_it_may() -> None:
    """E A/l is the closed form of the stiffness of a single wire, which cannot be moved."""
    problem = asked("one_wire", kinds=["wire"], diameter=[0.5e-3, 2.0e-3])
    (layout, *_) = flexact.design(problem)
    made = reshaped(layout, evaluations=30)
    (wire,) = made.flexures
    length = float(np.linalg.norm(wire.ends[1] - wire.ends[0]))
    stiffness = layout.problem.material.E * math.pi * 1.0e-3**2 / length
    assert wire.diameter == 2.0e-3
    assert made.worst_stiffness == pytest.approx(stiffness, rel=1.0e-6)


@pytest.mark.parametrize("name", ["hinge", "screw", "three_skew_rotations", "hexapod"])
def test_a_moved_wire_stays_across_what_is_wanted(name: str) -> None:
    """No wanted twist moves the end of a wire along it: V(p) is across it, however far it goes."""
    layout = wires(name)[0]
    shape = Shape(layout)
    draws = np.random.default_rng(1)
    looked = 0
    for _ in range(20):
        far = {p.name: draws.uniform(p.low, p.high) for p in shape.parameters}
        with contextlib.suppress(flexact.FlexactError):
            for flexure in shape.drawn(far).flexures:
                start, end = flexure.ends[0]
                vectors, counts = able(shape.frame.freedom, start[None])
                across = vectors[0, 3 - counts[0] :]
                way = (end - start) / np.linalg.norm(end - start)
                assert np.linalg.norm(across @ way) == pytest.approx(1.0, abs=1.0e-9)
                looked += 1
    assert looked > 10


def test_a_layout_begins_as_it_is_and_keeps_its_symmetry() -> None:
    designs = flexact.design(str(LENS))
    for layout in designs:
        shape = Shape(layout)
        again = shape.flexures(shape.drawn({}))
        for one, other in zip(layout.flexures, again, strict=True):
            assert one.ends == pytest.approx(other.ends, abs=1.0e-12)
    made = reshaped(designs[2], evaluations=60)
    assert made.symmetry == designs[2].symmetry == 3
    assert made.what == designs[2].what
    assert made.worst_stiffness > 1.2 * designs[2].worst_stiffness
    flexures = [
        {"ends": f.ends.tolist(), "kind": f.kind, "diameter": f.diameter, "between": f.between}
        for f in made.flexures
    ]
    problem = {"centre": [0, 0, 0], "size": designs.problem.size}
    assert design_oracle.symmetric(problem, flexures, "3-fold about z")


def test_the_same_seed_gives_the_same() -> None:
    layout = wires("screw")[0]
    one, other = (reshaped(layout, evaluations=40, starts=2, seed=7) for _ in range(2))
    assert one.model.to_deck() == other.model.to_deck()
    assert one.refined is not None
    assert one.refined.evaluations[0].objective == layout.worst_stiffness


@pytest.mark.parametrize(
    ("turn", "scale"), [(np.eye(3)[[2, 0, 1]], 1.0), (np.diag([-1.0, 1.0, 1.0]), 1.0e3)]
)
def test_a_moved_problem_gives_the_same(turn: Any, scale: float) -> None:
    """Stiffness in N/m goes with the scale, since E does not change."""
    problem = asked("universal_joint", kinds=["wire"])
    there = design_oracle.moved(problem, turn, np.array([0.5, 0.25, -1.0]), scale)
    values = []
    for each in (problem, there):
        layout = flexact.design({**each, "count": 1})[0]
        values.append(reshaped(layout, evaluations=60).worst_stiffness)
    assert values[1] == pytest.approx(scale * values[0], rel=1.0e-3)


def test_what_is_interrupted_keeps_the_best_so_far() -> None:
    layout = wires("hinge")[0]
    count = 0

    def stop(_: str, done: float) -> None:
        nonlocal count
        count += 1
        if count == 30:
            raise KeyboardInterrupt

    made = reshaped(layout, progress=stop)
    assert made.refined is not None
    assert made.refined.is_interrupted
    assert len(made.refined.evaluations) == 30
    assert is_better(made)
    assert "interrupted" in became(made)


def test_refine_takes_a_layout_and_another_score() -> None:
    layout = wires("hinge")[0]
    told = flexact.refine(layout, maximise="first parasitic frequency", evaluations=30)
    assert told.layout is not None
    assert told.layout.scores["first_parasitic_frequency"] == told.value >= told.before
    assert "First parasitic frequency at rest" in told.describe()
    for given, said in (
        ({"stress": "300 MPa"}, "stress is for what has vary"),
        ({"maximise": "parts"}, "places do not change parts"),
        ({"evaluations": 3}, "evaluations at least"),
        ({"starts": 0}, "a whole number from 1"),
    ):
        with pytest.raises(RequestError, match=said):
            flexact.refine(layout, **given)
    with pytest.raises(RequestError, match="say what is varied"):
        flexact.refine(layout.model, maximise="first frequency")


@pytest.fixture(scope="module")
def problem(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    path = tmp_path_factory.mktemp("refined") / "problem.json"
    path.write_text(json.dumps({**asked("planar", kinds=["wire"]), "count": 2}), encoding="utf-8")
    yield path


def printed(*words: str) -> tuple[int, str]:
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        code = main(["design", *words])
    return code, out.getvalue()


def test_the_command_tells_what_layouts_were(problem: Path, tmp_path: Path) -> None:
    code, out = printed(str(problem), "--refine", "-o", str(tmp_path / "page.html"))
    assert code == 0
    assert "layout 1" in out
    assert "refined" in out
    assert "Refined: " in (tmp_path / "page.html").read_text(encoding="utf-8")
    code, out = printed(str(problem), "--refine", "--apply", "2", "-o", str(tmp_path / "a.dat"))
    assert code == 0
    assert flexact.analyse(tmp_path / "a.dat").over_constrained == 0
    code, out = printed(str(problem), "--refine", "--json")
    answer = json.loads(out.splitlines()[0])
    assert code == 0
    told = [each["refined"] for each in answer["layouts"] if "refined" in each]
    assert told
    assert all(each["after"] >= each["before"] and each["values"] for each in told)


def test_the_command_refuses_what_does_not_go_together(
    problem: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["design", str(problem), "--refine", "--explain"]) == 2
    assert "--explain finds no layouts" in capsys.readouterr().err
