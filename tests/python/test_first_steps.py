# SPDX-License-Identifier: BSD-3-Clause
"""The first step of the advice on mechanisms that designers know: what one of them would do.

What is right is counted by hand: a body has six motions; a flat sheet holds three things, the
forces in its plane, with a waist two, a wire one. The words are golden in the pages of the
gallery (test_gallery.py); here it is what they do.
"""

import math
from collections import Counter
from pathlib import Path

import pytest

import flexact
from flexact import Model, polar
from flexact.advice.step import Step
from flexact.core.elements import Class
from flexact.model.names import part_name

GALLERY = Path(__file__).parents[2] / "docs" / "gallery"


def of_gallery(name: str) -> Model:
    names: dict[str, Model] = {}
    exec((GALLERY / f"{name}.py").read_text(encoding="utf-8"), names)
    return names["model"]


def done(step: Step) -> tuple[set[tuple[str, str]], Counter[str], set[str]]:
    """What a step declares, how much it releases at each part, and which parts it leaves out."""
    given, parts = step.analysis.given, step.analysis.parts
    names = {
        int(number): part_name(name)
        for number, name in zip(given.arrays.element_number, given.element_names, strict=True)
    }
    declared = set()
    for node, axis, to in step.change.coordinates:
        assert to is Class.INDEPENDENT
        body = parts.body_at[given.node_index[node]]
        declared.add((parts.of_body(body).name, axis))
    released = Counter(names[element] for element, _, _ in step.change.deformations)
    return declared, released, {names[element] for element in step.change.left_out}


def first_of(model: Model, under: int, over: int) -> Step:
    """The first step, which makes the mechanism exactly constrained, as it says."""
    analysis = flexact.analyse(model)
    assert (analysis.under_constrained, analysis.over_constrained) == (under, over)
    step = next(analysis.advice().numbered())
    assert step.number == 1 and step.outcome == "exactly constrained"
    for after in (step.apply(), flexact.read_text(step.apply().to_deck())):
        assert flexact.analyse(after).verdict is flexact.Verdict.EXACT
    return step


def test_of_a_spider_one_arm_is_enough() -> None:
    """Six arms hold x, y and rz six times, and nothing about x and y; z is declared."""
    step = first_of(of_gallery("spider_six_arms"), 2, 15)
    declared, released, left_out = done(step)
    assert declared == {("hub", "rx"), ("hub", "ry")}
    assert not released and len(left_out) == 5
    # Radial wires let the hub turn about z: all their lines go through its middle.
    assert "they meet in one point, and the hub can turn" in step.statement
    model = of_gallery("spider_six_arms")
    for k in range(1, 7):
        model.release(f"arm {k}", "in-plane bending")
    model.independent("hub", "rx", "ry")
    assert flexact.analyse(model).under_constrained == 1


def test_of_a_lens_mount_each_sheet_gets_a_waist() -> None:
    """Three tangential sheets hold nine things; with a waist each six."""
    declared, released, left_out = done(first_of(of_gallery("lens_mount"), 0, 3))
    assert not declared and not left_out
    assert released == Counter({f"sheet {k}": 1 for k in (1, 2, 3)})


@pytest.mark.parametrize(("name", "sheets", "over"), [("six", 6, 13), ("thirty", 30, 85)])
def test_of_sheets_on_a_table_two_are_enough(name: str, sheets: int, over: int) -> None:
    """Parallel sheets hold five motions: one sheet three of them, one with a waist two."""
    declared, released, left_out = done(first_of(of_gallery(f"table_{name}_sheets"), 0, over))
    assert not declared and len(left_out) == sheets - 2
    assert sum(released.values()) == 1 and not left_out & set(released)


def test_of_vees_that_are_turned_all_are_turned_back() -> None:
    """Their contacts hold no rotation about z, and five things six times."""
    step = first_of(of_gallery("kinematic_mount_turned"), 1, 1)
    assert "Turn contacts 1 to 6 by 90 degrees, each pair about the line along z" in step.statement
    assert len(step.change.places) == 6 and not step.change.deformations


def stewart(turned: float = 0.0) -> Model:
    """Six struts between a base and a platform that hold their length and their twist."""
    model, tops = Model(), []
    for k, (foot, head) in enumerate(
        [(0, 60), (120, 60), (120, 180), (240, 180), (240, 300), (0, 300)]
    ):
        side = 1 if (foot - head) % 360 > 180 else -1
        low = polar(0.1, foot + 8 * side + turned)
        high = polar(0.07, head - 8 * side + turned, 0.1)
        model.wire(low, high, name=f"strut {k + 1}")
        model.hold(f"strut {k + 1}", "twist")
        model.fix(low)
        tops.append(high)
    model.body([(0, 0, 0.1), *tops], name="platform")
    return model


@pytest.mark.parametrize("turned", [0.0, 17.3])
def test_six_struts_become_soft_in_torsion(turned: float) -> None:
    """Twelve things hold six motions; six lengths do."""
    declared, released, left_out = done(first_of(stewart(turned), 0, 6))
    assert not declared and not left_out
    assert released == Counter({f"strut {k}": 1 for k in range(1, 7)})
    step = next(flexact.analyse(stewart(turned)).advice().numbered())
    assert "Make struts 1 to 6 soft in torsion" in step.statement


def compound(declared: bool) -> Model:
    """Two parallel guides in a row: a stage on an inner body."""
    model = Model()
    for k, x in enumerate((-0.03, 0.03), 1):
        model.sheet((x, 0, 0), (x, 0, 0.05), width="y", name=f"outer sheet {k}")
        model.fix((x, 0, 0))
    for k, x in enumerate((-0.02, 0.02), 1):
        model.sheet((x, 0, 0.05), (x, 0, 0), width="y", name=f"inner sheet {k}")
    model.body([(x, 0, 0.05) for x in (-0.03, -0.02, 0.02, 0.03)], name="inner body")
    model.body([(x, 0, 0) for x in (-0.02, 0.02)], name="stage")
    model.independent("stage", "x")
    if declared:
        model.independent("inner body", "x")
    return model


def test_of_a_compound_guide_the_inner_body_is_declared_and_two_sheets_get_a_waist() -> None:
    """Each guide of two sheets holds five motions with six things."""
    declared, released, left_out = done(first_of(compound(declared=False), 1, 2))
    assert declared == {("inner body", "x")} and not left_out
    assert {name.rpartition(" ")[0] for name in released} == {"outer sheet", "inner sheet"}
    assert sorted(released.values()) == [1, 1]
    declared, released, left_out = done(first_of(compound(declared=True), 0, 2))
    assert not declared and not left_out and sorted(released.values()) == [1, 1]


def test_of_a_cartwheel_two_sheets_get_a_waist() -> None:
    """Each pair of half sheets holds five motions with six things."""
    declared, released, left_out = done(first_of(of_gallery("cartwheel_hinge"), 0, 2))
    assert not declared and not left_out and sorted(released.values()) == [1, 1]


def test_of_a_roberts_linkage_one_sheet_gets_a_waist() -> None:
    declared, released, left_out = done(first_of(of_gallery("roberts_linkage"), 0, 1))
    assert not declared and not left_out and sorted(released.values()) == [1]


def test_of_an_xy_stage_sheets_of_a_guide_and_guides_of_a_side_are_changed_alike() -> None:
    """Four guides hold eight things too many; both guides of one side are changed in one way.

    Changed alike on all four, rz stays held by both sides (a guide of two sheets keeps two
    lengths), so that not all can be.
    """
    declared, released, left_out = done(first_of(of_gallery("xy_stage"), 0, 8))
    assert not declared and not left_out and sum(released.values()) == 8
    by_guide: dict[str, set[int]] = {}
    for name, count in released.items():
        by_guide.setdefault(name.rpartition(" ")[0], set()).add(count)
    alike = [guide for guide, counts in by_guide.items() if counts == {1}]
    assert len(alike) >= 3


def test_of_a_remote_centre_held_by_four_wires_one_is_left_out() -> None:
    """Three wires through a point hold three motions, a fourth one of them again."""
    model = Model()
    for k in range(4):
        low, high = polar(0.06, 90 * k, 0.12), polar(0.03, 90 * k, 0.06)
        model.wire(low, high, name=f"wire {k + 1}")
        model.fix(low)
    model.body([(0, 0, 0), *(polar(0.03, 90 * k, 0.06) for k in range(4))], name="tool")
    model.independent("tool", "rx", "ry", "rz")
    declared, released, left_out = done(first_of(model, 0, 1))
    assert not declared and not released and len(left_out) == 1


def test_of_many_wires_all_but_six_are_left_out() -> None:
    """Lines of a spiral staircase, no six of which depend on each other."""
    model, ends = Model(), []
    for k in range(40):
        low = polar(0.1, 47.0 * k, 0.01 * k)
        high = polar(0.04, 47.0 * k + 80.0 + 3.0 * math.sin(k), 0.01 * k + 0.02 * math.cos(2.0 * k))
        model.wire(low, high, name=f"wire {k + 1}")
        model.fix(low)
        ends.append(high)
    model.body(ends, name="stage")
    declared, released, left_out = done(first_of(model, 0, 34))
    assert not declared and not released and len(left_out) == 34


def test_what_lies_in_a_row_is_no_rival() -> None:
    """Both sides of the XY stage press on the stage, each through its own inner body."""
    analysis = flexact.analyse(of_gallery("xy_stage"))
    rows = [{"inner x sheet", "x sheet"}, {"inner y sheet", "y sheet"}]
    between_sides = 0
    for stress in analysis.self_stresses:
        rivalry = stress.rivalry
        assert rivalry is not None and len(rivalry.sides) == 2 and rivalry.over is not None
        kinds = [{part.name.rpartition(" ")[0] for part in side.parts} for side in rivalry.sides]
        assert all(any(kind <= row for row in rows) for kind in kinds)
        between_sides += any(side.through for side in rivalry.sides)
    # One self-stress within each of four guides, and four between the sides.
    assert between_sides == 4
