# SPDX-License-Identifier: BSD-3-Clause
"""The gallery: mechanisms in at most twelve lines, each with its verdict from the literature.

The counts are those of the reference cases of flexures and linkages and of the paper, section 4:
sheets hold three motions each, wires and folded sheets one.
"""

import ast
import importlib.util
import re
import runpy
import sys
from collections import Counter
from pathlib import Path
from types import ModuleType

import pytest
from wording import AsStored, masked

from flexact import Model, analyse, read_text

ROOT = Path(__file__).resolve().parents[2]
GALLERY = ROOT / "docs" / "gallery"
#: What designers would have to translate.
JARGON = re.compile(r"\bnode \d|\belement \d|\be[1-6]\b|local x[yz]|\bat [pq]\b")
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
    # Each arm holds x, y and rz: 18, of which three count; z is declared, rx and ry are left.
    "spider_six_arms": (2, 15),
    # Eight sheets hold 24, three bodies have 18 freedoms, two are declared.
    "xy_stage": (0, 8),
    # Each strut has two crossed notches and a neck, and holds its length alone.
    "stewart_platform": (0, 0),
    # Eight sheets hold 24, two bodies have 12 freedoms, both move along x.
    "haberland_guide": (0, 14),
    # Two sheets hold six, the coupler moves along x; legs are as sheets.
    "roberts_linkage": (0, 1),
    # Each sheet holds its tangent, z and the rotation about its radius: nine.
    "lens_mount": (0, 3),
    # Each pair of half sheets holds six, five count; body and centre turn.
    "cartwheel_hinge": (0, 2),
    # Eight sheets hold 24, three bodies have 18 freedoms, each moves along x.
    "compound_guide": (0, 9),
    # The lines of the wires meet in the centre, whose x, y and z they hold.
    "remote_centre": (0, 0),
    # Radii meet: rz is left, and of the three along x and y one is too many.
    "kinematic_mount_turned": (1, 1),
    # Each sheet holds y, z and rx where it is; of 18 and of 90 five count, x is declared.
    "table_six_sheets": (0, 13),
    "table_thirty_sheets": (0, 85),
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
    properties = model.data.properties
    assert properties is not None and hinge.body is not None
    assert properties.stiffness[:2, 0] == pytest.approx([210e9 * 4e-6] * 2)
    assert properties.node_mass[model.node_index(hinge.body.nodes[0].position), 0] == 0.25


def tool() -> ModuleType:
    """What writes the pages."""
    sys.path.insert(0, str(ROOT / "tools"))
    spec = importlib.util.spec_from_file_location("gallery", ROOT / "tools" / "gallery.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("name", VERDICTS)
def test_its_text_can_be_read_aloud(name: str) -> None:
    found = JARGON.search(analyse(model_of(name)).describe())
    assert found is None, found


@pytest.mark.parametrize("name", VERDICTS)
def test_its_page_is_what_the_program_says(name: str, as_stored: AsStored) -> None:
    script = GALLERY / f"{name}.py"
    page, stored = tool().page_of(script, analyse(model_of(name))), script.with_suffix(".md")
    if as_stored.renew:
        stored.write_text(page, encoding="utf-8")
    assert masked(stored.read_text(encoding="utf-8")) == masked(page)
    assert script.with_suffix(".png").is_file()


def test_the_list_names_every_mechanism() -> None:
    assert (GALLERY / "README.md").read_text(encoding="utf-8") == tool().contents()


# Machines from sentences

#: What FACT's chart and textbooks have for each freedom: a sheet and two wires of which the lines
#: meet the axis; three bipods; three parallel wires; five wires of a linear complex; of three
#: translations wires alone hold none, so that three limbs hold a couple each.
MACHINES = {
    "mirror_hinge": (1, {"sheet": 1, "wire": 2}, 0),
    "lens_mount": (0, {"wire": 6}, 0),
    "xy_theta_stage": (3, {"wire": 3}, 0),
    "screw_motion": (1, {"wire": 5}, 0),
    "remote_centre": (1, {"sheet": 1, "wire": 2}, 0),
    "xyz_delta": (3, {"notch": 3, "wire": 6}, 3),
}


@pytest.mark.dear(2)
@pytest.mark.parametrize("name", MACHINES)
def test_a_sentence_becomes_the_machine_that_its_page_shows(name: str, as_stored: AsStored) -> None:
    made = tool()
    designs = made.designs_of(name)
    freedom, kinds, bodies = MACHINES[name]
    first = designs[0]
    assert Counter(flexure.kind for flexure in first.flexures) == kinds
    assert len(first.bodies) == bodies
    analysis = analyse(read_text(first.model.to_deck()))
    assert (analysis.under_constrained, analysis.over_constrained) == (0, 0)
    assert analysis.degrees_of_freedom == freedom
    stored = made.MACHINES_PAGE
    parts = made.machines_parts(stored.read_text(encoding="utf-8"))
    part = made.machine(name, designs)
    if as_stored.renew:
        parts[name] = part
        stored.write_text(made.machines_page(parts.values()), encoding="utf-8")
    assert masked(parts[name]) == masked(part)
    folder = stored.parent / stored.stem
    assert {f"{name}.png", f"{name}_spaces.png"} <= {path.name for path in folder.iterdir()}


def test_the_page_of_machines_has_all_problems() -> None:
    made = tool()
    assert {path.stem for path in made.PROBLEMS.iterdir()} == set(made.MACHINES) == set(MACHINES)
    page = made.MACHINES_PAGE.read_text(encoding="utf-8")
    assert made.machines_page(made.machines_parts(page).values()) == page
