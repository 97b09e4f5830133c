# SPDX-License-Identifier: BSD-3-Clause
"""The gallery: ten mechanisms in at most twelve lines, each with its verdict from the literature.

The counts are those of the reference cases of flexures and linkages and of the paper, section 4:
sheets hold three motions each, wires and folded sheets one.
"""

import ast
import runpy
from pathlib import Path

import pytest

from flexact import Model, analyse, read_text

GALLERY = Path(__file__).resolve().parents[2] / "docs" / "gallery"
#: Motions left and self-stresses, with the guided motions declared.
VERDICTS = {
    # Two parallel sheets stop the stage's rotation about its length twice.
    "parallel_guide": (0, 1),
    # Two flat sheets both hold the motion along the line in which their planes meet.
    "cross_hinge_two_sheets": (0, 1),
    # Nine held, of which one plane and one more sheet take five.
    "cross_hinge_three_sheets": (0, 4),
    "folded_xy_theta_stage": (0, 0),
    "straight_guide_five_folded_sheets": (0, 0),
    "straight_guide_six_folded_sheets": (0, 1),
    # Each pair adds one, as in double_parallel_guide.dat.
    "double_parallelogram": (0, 2),
    "wire_hexapod": (0, 0),
    # Two hinges of two sheets in series.
    "butterfly_hinge": (0, 2),
    # A planar four-bar of ideal hinges in space.
    "notch_four_bar": (0, 3),
}


def model_of(name: str) -> Model:
    made = runpy.run_path(str(GALLERY / f"{name}.py"))["model"]
    assert isinstance(made, Model)
    return made


def test_the_gallery_has_these_mechanisms() -> None:
    assert {path.stem for path in GALLERY.glob("*.py")} == set(VERDICTS)


@pytest.mark.parametrize("name", VERDICTS)
def test_a_mechanism_takes_at_most_twelve_lines(name: str) -> None:
    text = (GALLERY / f"{name}.py").read_text(encoding="utf-8")
    title, *rest = text.splitlines()
    assert title.startswith("# ") and len(title) > 10
    assert len([line for line in rest if line.strip()]) <= 12
    assert {
        alias.name
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.Import)
        for alias in node.names
    } == {"flexact"}


@pytest.mark.parametrize("name", VERDICTS)
def test_its_verdict_is_known(name: str) -> None:
    model = model_of(name)
    assert model.name
    analysis = analyse(model)
    assert (analysis.under_constrained, analysis.over_constrained) == VERDICTS[name]
    again = analyse(read_text(model.to_deck()))
    assert (again.under_constrained, again.over_constrained) == VERDICTS[name]


@pytest.mark.parametrize("name", VERDICTS)
def test_every_part_has_a_name_of_its_own(name: str) -> None:
    model = model_of(name)
    names = model.element_names
    assert all(names) and len(set(names)) == len(names)
    points = list(model._change().node_names.values())
    assert len(set(points)) == len(points)


def test_a_cross_hinge_of_two_steel_sheets_takes_few_statements() -> None:
    """With sections, material and the mass of the body: five statements, of at most fifteen."""
    model = Model(name="cross hinge of steel")
    hinge = model.cross_hinge(
        [(-0.03, -0.01, 0), (0.03, 0.01, 0)],
        [(0.03, -0.01, 0.08), (-0.03, 0.01, 0.08)],
        carries=[(0, 0, 0.1)],
        mass=0.25,
        inertia=(1e-4, 1e-4, 2e-4),
        thickness=200e-6,
        breadth=0.02,
        material="steel",
    )
    model.fix(*hinge.ground)
    model.independent("body", "ry")
    analysis = analyse(model)
    assert (analysis.under_constrained, analysis.over_constrained) == (0, 1)
    draft = model._change()
    assert [draft.stiffness[k][0] for k in (0, 1)] == pytest.approx([210e9 * 4e-6] * 2)
    assert draft.node_mass[hinge.body.nodes[0].position] == (0.25,)  # type: ignore[union-attr]
