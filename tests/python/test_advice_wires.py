# SPDX-License-Identifier: BSD-3-Clause
"""Wires to add, what is wanted, and how it is written: each wire does what was said of it."""

from __future__ import annotations

import itertools
from pathlib import Path

import numpy as np
import pytest
from part_models import cross_hinge, guide, wires_on_a_helix
from spaces_models import SHEETS, WIRES, on_folded_sheets, on_sheets, on_wires

import flexact
from flexact import Model
from flexact.advice.spaces.flexures import wire_at
from flexact.advice.spaces.screws import FamilyKind, ScrewSpace
from flexact.advice.spaces.spaces import Spaces, spaces_of
from flexact.advice.spaces.subjects import Site
from flexact.advice.spaces.wanted_motion import Wanted
from flexact.advice.step import Purpose, Step
from flexact.analysis.change import AddedWire, Change
from flexact.analysis.screws import ScrewKind
from flexact.model.parts.parts import PartKind

pytestmark = pytest.mark.dear(40)

X, Y, Z = np.eye(3)
MODELS = {
    **{name: on_wires(wires) for name, wires in WIRES.items()},
    **{name: on_sheets(sheets) for name, sheets in SHEETS.items()},
    "three folded sheets": on_folded_sheets([90, 210, 330]),
    "helix": wires_on_a_helix(),
}


def spaces(model: Model, *wanted: str, body: str | None = None, wires: bool = True) -> Spaces:
    found = spaces_of(flexact.analyse(model), body, wanted, wires=wires)
    assert found is not None
    return found


def applied(model: Model, proposal: Step) -> flexact.Analysis:
    """What an analysis says of the changed model, as it is and read back from its deck."""
    changed = proposal.change.apply(model.data)
    made = flexact.analyse(changed)
    again = flexact.analyse(flexact.read_text(changed.to_deck()))
    assert (again.under_constrained, again.over_constrained) == (
        made.under_constrained,
        made.over_constrained,
    )
    return made


def stopped(proposal: Step) -> int:
    """How many motions it is to stop: a wire one, a sheet three (Blanding)."""
    return len(proposal.change.wires) + 3 * len(proposal.change.sheets)


def at_middle(space: ScrewSpace, wanted: Wanted) -> np.ndarray:
    """A wanted motion about the middle of the body of another space."""
    if wanted.kind is ScrewKind.TRANSLATION:
        return space.free(wanted.direction)
    return space.line(wanted.point, wanted.direction, wanted.pitch)


def force_of(model: Model, proposal: Step, space: ScrewSpace) -> list[np.ndarray]:
    """The lines of the new wires, read off the changed model."""
    changed = proposal.change.apply(model.data)
    parts = flexact.analyse(changed).parts
    made = []
    for part in parts.all:
        if part.name.startswith(("new wire", "new sheet")):
            p, q = changed.positions[list(part.ends)]
            made.append(space.line(p, q - p))
            if part.kind is PartKind.SHEET:
                (sheet,) = proposal.change.sheets
                made += [space.line(p, sheet.width), space.line(q, sheet.width)]
    return made


@pytest.mark.parametrize("name", MODELS)
def test_each_wire_stops_one_motion_and_causes_no_self_stress(name: str) -> None:
    model = MODELS[name]
    before, found = flexact.analyse(model), spaces(model)
    assert found.unwanted == found.stoppable == found.freedom.dimension
    assert bool(found.steps) == bool(found.unwanted)
    for proposal in found.steps:
        after = applied(model, proposal)
        assert proposal.purpose is (
            Purpose.ADD_SHEET if proposal.change.sheets else Purpose.ADD_WIRE
        )
        assert proposal.condition >= 1.0
        assert before.under_constrained - after.under_constrained == stopped(proposal)
        assert after.over_constrained == before.over_constrained
        assert proposal.after.under_constrained == after.under_constrained
    if found.unwanted > 1:
        assert max(len(each.change.wires) for each in found.steps) == found.unwanted


@pytest.mark.parametrize(
    ("name", "wanted"),
    [
        ("one wire", ["stage: translation z", "stage: rotation about (0, 0, 0) along x"]),
        ("two skew wires", ["stage: rotation about (0, 0, -0.02) along (1, 0, 0.0)"]),
        ("two wires that meet", ["stage: rotation about (0, 0.05, 0) along z"]),
        ("three wires in a plane", ["stage: translation z"]),
        ("three wires in a plane", ["stage: rotation about (0, 0, 0.02) along y"]),
        ("three wires in a plane", ["stage: translation z", "stage: rotation y"]),
        ("three parallel wires", ["stage: translation x"]),
        ("three parallel wires", ["stage: rotation about (0, 0, 0) along z"]),
        ("three wires through a point", ["stage: rotation x", "stage: rotation y"]),
        ("three wires to a point and one", ["stage: rotation about (0, 0, 0.1) along x"]),
        ("guide with lower two parallel", ["stage: translation z"]),
        ("one sheet", ["stage: translation z", "stage: rotation x"]),
        ("membrane", ["stage: translation z"]),
        ("three folded sheets", ["stage: translation z"]),
    ],
)
def test_wires_stop_nothing_that_is_wanted(name: str, wanted: list[str]) -> None:
    model = MODELS[name]
    before, found = flexact.analyse(model), spaces(model, *wanted)
    assert all(each.is_free for each in found.wanted)
    assert found.unwanted == found.freedom.dimension - len(wanted)
    assert found.stoppable == found.unwanted
    assert found.steps
    for proposal in found.steps:
        after, count = applied(model, proposal), stopped(proposal)
        assert before.under_constrained - after.under_constrained == count
        assert after.over_constrained == before.over_constrained
        then = spaces_of(after, "stage", wires=False)
        assert then is not None
        assert then.freedom.dimension == found.freedom.dimension - count
        for each in found.wanted:
            # A link may have moved the middle of the body.
            assert then.freedom.has(at_middle(then.freedom, each))
        # No work on what is wanted, some on what is not, by w.m + v.f of the wires as they are.
        for force in force_of(model, proposal, found.freedom):
            for each in found.wanted:
                twist = each.twist
                assert abs(twist[:3] @ force[3:] + twist[3:] @ force[:3]) < 1e-9
            assert not found.constraint.has(force)


def test_the_textbook_guide_gets_its_fifth_wire_back() -> None:
    """Blanding: the guide along z with the lower two wires parallel lacks one across them."""
    model = on_wires(WIRES["guide with lower two parallel"])
    model.independent("stage", "z")
    found = spaces(model)
    assert found.wanted[0].is_declared
    first = found.steps[0]
    assert applied(model, first).under_constrained == 0
    (force,) = force_of(model, first, found.freedom)
    assert np.allclose(np.abs(force[:3]), Y, atol=1e-9)


def wire_along(site: Site, point: np.ndarray, direction: np.ndarray) -> AddedWire:
    """A wire that ends on a body at a point [m] and runs along a direction to the ground."""
    near = min(site.own, key=lambda each: float(np.linalg.norm(each.place - point)))
    length = site.result.characteristic_length
    is_there = bool(np.linalg.norm(near.place - point) <= 1.0e-9 * length)
    place = near.place if is_there else point
    return wire_at(site, near._replace(place=place, is_there=is_there), direction)


@pytest.mark.parametrize("name", [name for name in MODELS if name != "six wires"])
def test_a_wire_along_a_redundant_line_only_adds_a_self_stress(name: str) -> None:
    model = MODELS[name]
    result, found = flexact.analyse(model), spaces(model, wires=False)
    assert bool(found.constraint.lines) == bool(found.constraint.dimension)
    for family in found.constraint.lines:
        if family.kind in (FamilyKind.PARALLELS, FamilyKind.EVERY, FamilyKind.ACROSS):
            point = found.constraint.about
        else:
            point = family.points[0] if len(family.points) else family.point
        way = family.direction
        if family.kind in (FamilyKind.PENCIL, FamilyKind.PLANE):
            way = np.cross(family.normal, (0.3, 0.5, 0.7))
        elif family.kind in (FamilyKind.BUNDLE, FamilyKind.MEETING, FamilyKind.EVERY):
            way = np.array((0.3, 0.5, 0.7))
        elif family.kind is FamilyKind.ACROSS:
            way = np.cross(family.direction, (0.3, 0.5, 0.7))
        elif family.kind in (FamilyKind.REGULUS, FamilyKind.MEETING_TWO):
            way = family.directions[0]
            if family.kind is FamilyKind.MEETING_TWO:
                way = family.points[1] - family.points[0]
        elif family.kind is FamilyKind.COMPLEX:
            # On the complex: lines that meet its axis at right angles.
            way = np.cross(family.direction, (0.3, 0.5, 0.7))
        wire = wire_along(Site(result, found.subject), point, way / np.linalg.norm(way))
        after = flexact.analyse(Change(wires=(wire,)).apply(model.data))
        assert after.under_constrained == result.under_constrained
        assert after.over_constrained == result.over_constrained + 1


def test_a_joint_gets_a_link_where_it_has_no_node() -> None:
    """A fold can turn about its fold line: nothing on it could be stopped at the line itself."""
    deck = flexact.read("input_decks/paper/folded_sheet_clamped.dat")
    found = spaces(deck)
    for proposal in found.steps:
        after = applied(deck, proposal)
        assert (after.under_constrained, after.over_constrained) == (0, 1)
        assert np.linalg.norm(np.array(proposal.change.wires[0].end) - (0.06, 0, 0)) > 1e-3


def test_comments_of_a_deck_stay() -> None:
    deck = flexact.read("input_decks/flexures/five_wires_lower_two_parallel.dat")
    (first, *_) = spaces(deck).steps
    text = first.change.apply(deck.data).to_deck()
    assert "% wire top y" in text
    assert "% new wire" in text


def test_a_second_wire_has_a_name_of_its_own() -> None:
    model = on_wires(WIRES["three wires in a plane"])
    for name in ("new wire", "new wire 2"):
        model = spaces(model, "stage: translation z").steps[0].change.apply(model.data)
        assert name in model.element_names


def test_planar_wires() -> None:
    deck = flexact.read("input_decks/linkages/parallelogram_flat.dat")
    found = spaces(deck)
    before = flexact.analyse(deck)
    for proposal in found.steps:
        after = applied(deck, proposal)
        assert before.under_constrained - after.under_constrained == stopped(proposal)
        assert after.over_constrained == before.over_constrained


# What no wire can do ---------------------------------------------------------


def test_a_rotation_beside_all_translations_cannot_be_stopped_by_wires() -> None:
    """A force that does no work on any translation is none: only a moment would do."""
    model = Model(planar=True)
    model.body([(0, 0), (0.1, 0)], "stage")
    found = spaces(model, "stage: translation x", "stage: translation y")
    assert (found.unwanted, found.stoppable, found.steps) == (1, 0, ())
    table = on_wires(WIRES["three parallel wires"])
    found = spaces(table, "stage: translation x", "stage: translation y")
    assert (found.unwanted, found.stoppable, found.steps) == (1, 0, ())
    free = Model()
    free.body([(0, 0, 0), (0.1, 0, 0)], "stage")
    found = spaces(free, *(f"stage: translation {axis}" for axis in "xyz"))
    assert (found.unwanted, found.stoppable, found.steps) == (3, 0, ())


def test_only_some_may_be_stoppable() -> None:
    """A free body that is to move along x and y: along z and about z remain, with tilts of z."""
    free = Model()
    free.body([(0, 0, 0), (0.1, 0, 0), (0, 0.1, 0)], "stage")
    found = spaces(free, "stage: translation x", "stage: translation y")
    # Forces along z alone: translation z and rotations about x and y, not that about z.
    assert (found.unwanted, found.stoppable) == (4, 3)
    assert max(len(each.change.wires) for each in found.steps) == 3
    for proposal in found.steps:
        assert not proposal.change.sheets
        for wire in proposal.change.wires:
            assert np.allclose(np.subtract(wire.ground, wire.end)[:2], 0.0, atol=1e-12)


# Sheets ------------------------------------------------------------------------


def sheets_of(found: Spaces) -> list[Step]:
    return [each for each in found.steps if each.change.sheets]


def test_a_sheet_in_its_plane_stops_three_motions_at_once() -> None:
    """Hale, Blanding: a sheet in the plane z = 0 leaves translation z and rotations x and y."""
    free = Model()
    free.body([(0, 0, 0), (0.1, 0, 0), (0, 0.1, 0)], "stage")
    texts = (
        "translation z",
        "rotation about (0, 0, 0) along x",
        "rotation about (0, 0, 0) along y",
    )
    found = spaces(free, *(f"stage: {text}" for text in texts))
    assert (found.unwanted, found.stoppable) == (3, 3)
    (sheet,) = sheets_of(found)
    (added,) = sheet.change.sheets
    assert added.end[2] == added.ground[2] == added.width[2] == 0.0
    after = applied(free, sheet)
    assert (after.under_constrained, after.over_constrained) == (3, 0)


def test_no_sheet_where_two_motions_are_unwanted_or_no_plane_is_free() -> None:
    model = on_wires(WIRES["guide with lower two parallel"])
    assert not sheets_of(spaces(model))
    # No plane holds only lines that meet two skew lines.
    free = Model()
    free.body([(0, 0, 0), (0.1, 0, 0), (0, 0.1, 0)], "stage")
    texts = ("rotation about (0, 0, 0) along x", "rotation about (0, 0, 0.05) along y")
    skew = spaces(free, *(f"stage: {text}" for text in texts))
    assert (skew.unwanted, skew.stoppable) == (4, 4)
    assert skew.steps
    assert not sheets_of(skew)


# Intent ------------------------------------------------------------------------


def test_declared_freedoms_are_wanted_where_nothing_is_said() -> None:
    model = guide()
    model.independent("stage", "y")
    found = spaces(model)
    (wanted,) = found.wanted
    assert wanted.is_declared
    assert np.allclose(wanted.twist, (0, 0, 0, 0, 1, 0), atol=1e-9)
    assert (found.unwanted, found.steps) == (0, ())
    hinge = cross_hinge()
    hinge.independent("arm", "x")
    found = spaces(hinge)
    # Its declared coordinate is a displacement, but what the arm does is to turn.
    assert found.wanted[0].kind.value == "rotation"
    assert found.unwanted == 0


def test_what_is_declared_inside_of_flexures_is_no_wish_for_the_body() -> None:
    found = spaces_of(flexact.analyse("input_decks/flexures/folded_sheet_free_internal.dat"))
    assert found is not None
    assert found.wanted == ()
    assert found.unwanted == 5


def test_a_declaration_that_is_not_wanted_is_taken_back() -> None:
    model = on_wires(WIRES["guide with lower two parallel"])
    model.independent("stage", "z")
    before = flexact.analyse(model)
    found = spaces(model, "stage: rotation x")
    assert found.unwanted == 1
    for proposal in found.steps:
        assert len(proposal.change.coordinates) == 1
        after = applied(model, proposal)
        assert after.over_constrained == before.over_constrained
        assert after.degrees_of_freedom == 0
        assert after.under_constrained == 1


def test_what_is_wanted_but_stopped_is_told() -> None:
    found = spaces(on_wires(WIRES["guide"]), "stage: translation x", "stage: translation z")
    assert [each.is_free for each in found.wanted] == [False, True]
    assert found.unwanted == 0


@pytest.mark.parametrize(
    ("text", "kind", "direction", "pitch"),
    [
        ("stage: translation z", "translation", Z, np.inf),
        ("stage: translation along -y", "translation", -Y, np.inf),
        ("stage: translation (0, 1, 1)", "translation", (Y + Z) / np.sqrt(2), np.inf),
        ("stage: rotation x", "rotation", X, 0.0),
        ("stage: rotation about x", "rotation", X, 0.0),
        ("stage:rotation about (0, 0, 0.04) along x", "rotation", X, 0.0),
        ("stage: Rotation about x through (0 0 0.04)", "rotation", X, 0.0),
        ("stage: screw z pitch 0.001", "screw", Z, 1e-3),
        ("stage: screw about (0, 0, 0.04) along z pitch -1e-3", "screw", Z, -1e-3),
        ("translation z", "translation", Z, np.inf),
    ],
)
def test_wanted_motions_are_read(text: str, kind: str, direction: np.ndarray, pitch: float) -> None:
    model = Model()
    model.body([(0, 0, 0.04), (0.1, 0, 0.04)], "stage")
    (wanted,) = spaces(model, text, wires=False).wanted
    assert wanted.text == text
    assert wanted.kind.value == kind
    assert np.allclose(wanted.direction, direction)
    assert wanted.pitch == pitch
    assert wanted.is_free


def test_a_point_may_be_given_by_its_name() -> None:
    model = Model()
    tip = model.node(0.1, 0.02, 0.04, name="tip")
    model.body([(0, 0, 0.04), tip], "stage")
    (wanted,) = spaces(model, "stage: rotation about tip along z", wires=False).wanted
    assert np.allclose(wanted.point, (0.1, 0.02, 0.04))
    # The tip stands still.
    middle = np.array((0.05, 0.01, 0.04))
    assert np.allclose(wanted.twist[3:], np.cross(Z, middle - wanted.point), atol=1e-9)


def test_a_rotation_without_a_point_is_about_the_line_that_the_body_has() -> None:
    hinge = spaces(cross_hinge(), "arm: rotation z")
    assert hinge.wanted[0].is_free
    assert np.allclose(hinge.wanted[0].point[:2], (0.02, 0.03))
    # Of all lines along x in the plane z = 0.02 m one is the nearest to the middle.
    flat = spaces(on_wires(WIRES["three wires in a plane"]), "stage: rotation x").wanted[0]
    assert flat.is_free
    assert flat.point[2] == pytest.approx(0.02)
    assert not spaces(cross_hinge(), "arm: rotation x").wanted[0].is_free


def test_a_screw_that_the_body_has_is_no_rotation() -> None:
    helix = wires_on_a_helix()
    pitch = -(0.06**2) / 0.02
    for text, is_free in (
        ("rotation z", False),
        (f"screw z pitch {pitch}", True),
        (f"screw z pitch {-pitch}", False),
    ):
        (wanted,) = spaces(helix, f"body: {text}", wires=False).wanted
        assert wanted.is_free == is_free


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("stage: translate z", "did you mean translation"),
        ("stage: translation w", "'w' is no direction"),
        ("stage: translation", "there is no direction"),
        ("stage: translation (0, 0, 0)", "not zero"),
        ("stage: translation (0, 1)", "2 numbers, not three"),
        ("stage: translation (0, 1, up)", "'up' is no number"),
        ("stage: translation (0, 1, nan)", "'nan' is no number"),
        ("stage: translation (0, 1, 0", "not closed"),
        ("stage: rotation x pitch 0.1", "has no pitch"),
        ("stage: screw x", "needs a pitch"),
        ("stage: screw x pitch 0", "is a rotation"),
        ("stage: rotation about tipp along x", "no point called 'tipp'"),
        (": translation x", "no body before the colon"),
        ("", "no motion in it"),
        ("sledge: translation x", "no body called 'sledge'"),
    ],
)
def test_what_cannot_be_read_is_told(text: str, words: str) -> None:
    model = Model()
    model.body([(0, 0, 0), model.node(0.1, 0, 0, name="tip")], "stage")
    with pytest.raises(flexact.ModelError) as caught:
        spaces(model, text)
    assert words in str(caught.value)


def test_wanted_motions_are_those_of_one_body() -> None:
    model = on_wires(WIRES["guide"])
    model.body([(1, 0, 0), (1.1, 0, 0)], "other")
    with pytest.raises(flexact.ModelError, match="one body"):
        spaces(model, "other: translation x", body="stage")
    with pytest.raises(flexact.ModelError, match="one body"):
        spaces(model, "other: translation x", "stage: translation x")
    assert spaces(model, "other: translation x").subject.name == "other"
    with pytest.raises(TypeError):
        spaces_of(flexact.analyse(model), None, "stage: translation x")


def test_in_the_plane_a_rotation_needs_no_direction() -> None:
    model = Model(planar=True)
    model.body([(0, 0), (0.1, 0)], "stage")
    for text, point in (
        ("stage: rotation", (0.05, 0)),
        ("stage: rotation z", (0.05, 0)),
        ("stage: rotation about (0.02, 0.01)", (0.02, 0.01)),
    ):
        (wanted,) = spaces(model, text, wires=False).wanted
        assert wanted.is_free
        assert np.allclose(wanted.point[:2], point)
    for text in ("stage: translation z", "stage: rotation about (0, 0) along x"):
        with pytest.raises(flexact.ModelError, match="plan"):
            spaces(model, text)


def test_two_choices_are_two_lines() -> None:
    for name in ("guide", "two skew wires", "one sheet", "helix"):
        found = spaces(MODELS[name])
        single = [each for each in found.steps if len(each.change.wires) == 1]
        for one, other in itertools.combinations(single, 2):
            (a,), (b,) = (force_of(MODELS[name], each, found.freedom) for each in (one, other))
            assert np.linalg.norm(a - b) > 1e-3
            assert np.linalg.norm(a + b) > 1e-3


def test_decks_of_the_repository_get_wires_that_work() -> None:
    for path in sorted(Path("input_decks").glob("*/*undeclared*.dat")):
        deck = flexact.read(path)
        before, found = flexact.analyse(deck), spaces_of(flexact.analyse(deck))
        for proposal in found.steps if found is not None else ():
            after = applied(deck, proposal)
            assert before.under_constrained - after.under_constrained == stopped(proposal)
            assert after.over_constrained == before.over_constrained
