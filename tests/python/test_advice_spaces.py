# SPDX-License-Identifier: BSD-3-Clause
"""Freedom and constraint spaces of the textbook set, and of what lines they hold.

Expected spaces: J. B. Hopkins and M. L. Culpepper, "Synthesis of multi-degree of freedom, parallel
flexure system concepts via Freedom and Constraint Topology (FACT), Part I: Principles", Precision
Engineering 34 (2010), cases of one to five constraints; D. L. Blanding, *Exact Constraint: Machine
Design Using Kinematic Principles*, 1999 (every rotation axis meets every wire; sheets, folded
sheets); L. C. Hale, *Principles and Techniques for Designing Precision Machines*, thesis MIT,
1999; H.-J. Su, D. V. Dorozhkin and J. M. Vance, "A screw theory approach for the conceptual design
of flexible joints for compliant mechanisms", J. Mechanisms and Robotics 1 (2009). Beside them
stand lines computed here, which share nothing with the program.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from part_models import PLACES, Place, cross_hinge, guide, wires_on_a_helix
from spaces_models import SHEETS, WIRES, on_folded_sheets, on_sheets, on_wires

import flexact
from flexact import Model
from flexact.advice.spaces.screws import Family, FamilyKind, ScrewSpace
from flexact.advice.spaces.spaces import Spaces, spaces_of

K = FamilyKind
X, Y, Z = np.eye(3)


def spaces(model: Model, body: str | None = "stage") -> Spaces:
    found = spaces_of(flexact.analyse(model), body, wires=False)
    assert found is not None
    return found


def kinds(space: ScrewSpace) -> set[FamilyKind]:
    return {family.kind for family in space.families}


def only(space: ScrewSpace, kind: FamilyKind) -> Family:
    (found,) = (family for family in space.families if family.kind is kind)
    return found


def parallel(a: np.ndarray, b: np.ndarray) -> bool:
    return bool(np.linalg.norm(np.cross(a, b)) < 1e-9 and np.linalg.norm(a) > 0.5)


#: Dimension and families of the freedom space, and families of the constraint space.
OF_WIRES = {
    "one wire": (5, {K.MEETING, K.DIRECTIONS_IN_PLANE}, {K.LINE}),
    "two parallel wires": (
        4,
        {K.PLANE, K.PARALLELS, K.DIRECTIONS_IN_PLANE},
        {K.PARALLELS_IN_PLANE, K.DIRECTION},
    ),
    "two wires that meet": (4, {K.BUNDLE, K.PLANE, K.DIRECTION}, {K.PENCIL}),
    "two skew wires": (4, {K.MEETING_TWO, K.DIRECTION}, {K.LINE}),
    "three wires in a plane": (3, {K.PLANE, K.DIRECTION}, {K.PLANE, K.DIRECTION}),
    "three parallel wires": (
        3,
        {K.PARALLELS, K.DIRECTIONS_IN_PLANE},
        {K.PARALLELS, K.DIRECTIONS_IN_PLANE},
    ),
    "three parallel wires in a plane": (
        4,
        {K.PLANE, K.PARALLELS, K.DIRECTIONS_IN_PLANE},
        {K.PARALLELS_IN_PLANE, K.DIRECTION},
    ),
    "three wires through a point": (3, {K.BUNDLE}, {K.BUNDLE}),
    "three skew wires": (3, {K.REGULUS}, {K.REGULUS}),
    "three wires to a point and one": (2, {K.PENCIL}, {K.BUNDLE, K.PLANE, K.DIRECTION}),
    "three wires in a plane and one": (
        2,
        {K.PARALLELS_IN_PLANE, K.DIRECTION},
        {K.PLANE, K.PARALLELS, K.DIRECTIONS_IN_PLANE},
    ),
    "wires to two points": (1, {K.LINE}, {K.MEETING, K.DIRECTIONS_IN_PLANE}),
    "guide": (1, {K.DIRECTION}, {K.ACROSS, K.EVERY_DIRECTION}),
    "guide with lower two parallel": (
        2,
        {K.PARALLELS_IN_PLANE, K.DIRECTION},
        {K.PLANE, K.PARALLELS, K.DIRECTIONS_IN_PLANE},
    ),
    "six wires": (0, set(), {K.EVERY, K.EVERY_DIRECTION}),
}


@pytest.mark.parametrize("name", WIRES)
def test_wires_leave_the_freedom_of_the_literature(name: str) -> None:
    dimension, free, held = OF_WIRES[name]
    found = spaces(on_wires(WIRES[name]))
    assert found.freedom.dimension == dimension
    assert found.constraint.dimension == 6 - dimension
    assert kinds(found.freedom) == free
    assert kinds(found.constraint) == held


def test_geometry_of_the_families() -> None:
    def of(name: str) -> Spaces:
        return spaces(on_wires(WIRES[name]))

    one = only(of("one wire").freedom, K.MEETING)
    assert parallel(one.direction, X)
    assert np.allclose(np.cross(one.point, X), 0.0, atol=1e-12)
    meet = of("two wires that meet")
    assert np.allclose(only(meet.constraint, K.PENCIL).point, (0, 0.05, 0), atol=1e-12)
    assert np.allclose(only(meet.freedom, K.BUNDLE).point, (0, 0.05, 0), atol=1e-12)
    assert parallel(only(meet.freedom, K.PLANE).normal, Z)
    assert parallel(only(meet.freedom, K.DIRECTION).direction, Z)
    skew = only(of("two skew wires").freedom, K.MEETING_TWO)
    found = sorted(zip(np.abs(skew.directions).tolist(), skew.points[:, 2], strict=True))
    assert np.allclose([each[0] for each in found], (Y, X), atol=1e-12)
    assert np.allclose([each[1] for each in found], (-0.02, 0.02), atol=1e-12)
    flat = of("three wires in a plane")
    for space in (flat.freedom, flat.constraint):
        assert np.allclose(only(space, K.PLANE).point[2], 0.02, atol=1e-12)
        assert parallel(only(space, K.PLANE).normal, Z)
        assert parallel(only(space, K.DIRECTION).direction, Z)
    top = only(of("three wires through a point").freedom, K.BUNDLE)
    assert np.allclose(top.point, (0, 0, 0.1), atol=1e-12)
    pencil = only(of("three wires to a point and one").freedom, K.PENCIL)
    assert np.allclose(pencil.point, (0, 0, 0.1), atol=1e-12)
    # The plane of that point and of the fourth wire, along x through (0.05, 0.01, 0).
    assert parallel(pencil.normal, np.cross(X, (0.05, 0.01, -0.1)) / np.linalg.norm((0.1, 0.01)))
    fold = only(of("three wires in a plane and one").freedom, K.PARALLELS_IN_PLANE)
    assert parallel(fold.direction, X)
    assert np.allclose(fold.point[2], 0.02, atol=1e-12)
    hinge = only(of("wires to two points").freedom, K.LINE)
    below = np.array((0.0, 0.0, -0.08))
    assert parallel(hinge.direction, Z)
    assert np.allclose(np.cross(hinge.point - below, Z), 0.0, atol=1e-12)


def test_five_wires_on_a_helix_leave_a_screw() -> None:
    """Pitch h = -R^2/c: see `part_models.wires_on_a_helix`."""
    found = spaces(wires_on_a_helix(), "body")
    (screw,) = found.freedom.families
    assert screw.kind is K.SCREW
    assert parallel(screw.direction, Z)
    assert screw.pitch == pytest.approx(-(0.06**2) / 0.02)
    assert kinds(found.constraint) == {K.COMPLEX, K.DIRECTIONS_IN_PLANE}


OF_SHEETS = {
    "one sheet": (3, {K.PLANE, K.DIRECTION}),
    "two parallel sheets": (1, {K.DIRECTION}),
    "two crossed sheets": (1, {K.LINE}),
    "membrane": (3, {K.PLANE, K.DIRECTION}),
}


@pytest.mark.parametrize("beams", [1, 3])
@pytest.mark.parametrize("name", SHEETS)
def test_sheets_leave_the_freedom_of_the_literature(name: str, beams: int) -> None:
    dimension, free = OF_SHEETS[name]
    found = spaces(on_sheets(SHEETS[name], beams))
    assert found.freedom.dimension == dimension
    assert found.constraint.dimension == 6 - dimension
    assert kinds(found.freedom) == free
    if name in ("one sheet", "membrane"):
        for space in (found.freedom, found.constraint):
            assert kinds(space) == free
            assert only(space, K.PLANE).point[2] == pytest.approx(0.01)
            assert parallel(only(space, K.PLANE).normal, Z)
            assert parallel(only(space, K.DIRECTION).direction, Z)
    if name == "two parallel sheets":
        assert parallel(only(found.freedom, K.DIRECTION).direction, Y)
    if name == "two crossed sheets":
        line = only(found.freedom, K.LINE)
        assert parallel(line.direction, Z)
        assert np.allclose(line.point[:2], 0.0, atol=1e-12)


def test_folded_sheets_hold_forces_along_their_fold_lines() -> None:
    one = spaces(on_folded_sheets([90])).constraint
    (fold,) = one.families
    assert fold.kind is K.LINE
    assert parallel(fold.direction, X)
    assert np.allclose(np.cross(fold.point - (0, 0.06, 0.03), X), 0.0, atol=1e-12)
    three = spaces(on_folded_sheets([90, 210, 330]))
    for space in (three.freedom, three.constraint):
        assert kinds(space) == {K.PLANE, K.DIRECTION}
        assert only(space, K.PLANE).point[2] == pytest.approx(0.03)
        assert parallel(only(space, K.PLANE).normal, Z)


def test_an_overconstrained_deck_has_the_reciprocal_space_too() -> None:
    result = flexact.analyse(on_sheets(SHEETS["two parallel sheets"]))
    found = spaces_of(result)
    assert found is not None
    assert result.over_constrained == 1
    assert found.constraint.dimension == 5


# Independent of the program ------------------------------------------------


def line_at(space: ScrewSpace, point: np.ndarray, way: np.ndarray) -> np.ndarray:
    """The unit line through a point, its moment about the middle of the body."""
    unit = way / np.linalg.norm(way)
    return np.concatenate((unit, np.cross(point - space.about, unit)))


def off(space: ScrewSpace, screw: np.ndarray) -> float:
    """Which part of it is not in the space, by least squares."""
    scale = np.repeat((space.length, 1.0), 3)
    rows, one = space.basis * scale, screw * scale
    shares = np.linalg.lstsq(rows.T, one, rcond=None)[0]
    return float(np.linalg.norm(rows.T @ shares - one) / np.linalg.norm(one))


def members(family: Family, random: np.random.Generator) -> list[tuple[np.ndarray, np.ndarray]]:
    """Some lines of a family, by what its kind says."""
    made = []
    for _ in range(5):
        p, v = random.normal(size=(2, 3)) * 0.1
        in_plane = np.cross(family.normal, v)
        at = family.point + np.cross(family.normal, p)
        if family.kind is K.LINE:
            made.append((family.point, family.direction))
        elif family.kind is K.PENCIL:
            made.append((family.point, in_plane))
        elif family.kind is K.BUNDLE:
            made.append((family.point, v))
        elif family.kind is K.PARALLELS:
            made.append((p, family.direction))
        elif family.kind is K.PARALLELS_IN_PLANE:
            made.append((at, family.direction))
        elif family.kind is K.PLANE:
            made.append((at, in_plane))
        elif family.kind is K.MEETING:
            made.append((p, family.point + v[0] * family.direction - p))
        elif family.kind is K.ACROSS:
            made.append((p, np.cross(family.direction, v)))
        elif family.kind is K.EVERY:
            made.append((p, v))
        elif family.kind is K.MEETING_TWO:
            a, b = family.points + v[:2, None] * family.directions
            made.append((a, b - a))
        elif family.kind is K.REGULUS:
            made += list(zip(family.points, family.directions, strict=True))
    return made


@pytest.mark.parametrize("name", WIRES)
def test_members_of_families_are_in_their_space_and_other_lines_are_not(name: str) -> None:
    random = np.random.default_rng(7)
    found = spaces(on_wires(WIRES[name]))
    for space in (found.freedom, found.constraint):
        for family in space.lines:
            lines = members(family, random)
            assert lines
            assert max(off(space, line_at(space, *each)) for each in lines) < 1e-9
        if space.dimension < 6:
            others = random.normal(size=(20, 2, 3))
            assert min(off(space, line_at(space, p, v)) for p, v in others) > 1e-4


@pytest.mark.parametrize("name", WIRES)
def test_no_wrench_does_work_on_a_twist(name: str) -> None:
    found = spaces(on_wires(WIRES[name]))
    for twist in found.freedom.basis:
        for wrench in found.constraint.basis:
            assert abs(twist[:3] @ wrench[3:] + twist[3:] @ wrench[:3]) < 1e-9
    for point, way in WIRES[name]:
        line = line_at(found.constraint, np.array(point, float), np.array(way, float))
        assert off(found.constraint, line) < 1e-9


def is_of(family: Family, point: np.ndarray, way: np.ndarray) -> bool:
    """Whether a line belongs to a family, by what its kind says."""
    near = 1e-6

    def goes_through(place: np.ndarray) -> bool:
        return bool(np.linalg.norm(np.cross(place - point, way)) < near)

    def meets(place: np.ndarray, other: np.ndarray) -> bool:
        return abs(np.cross(other, way) @ (place - point)) < near

    is_along = np.linalg.norm(np.cross(way, family.direction)) < near
    is_flat = abs(way @ family.normal) < near
    is_in_plane = is_flat and abs((point - family.point) @ family.normal) < near
    return bool(
        {
            K.LINE: is_along and goes_through(family.point),
            K.PENCIL: is_in_plane and goes_through(family.point),
            K.BUNDLE: goes_through(family.point),
            K.PARALLELS: is_along,
            K.PARALLELS_IN_PLANE: is_along and is_in_plane,
            K.PLANE: is_in_plane,
            K.MEETING: meets(family.point, family.direction),
            K.MEETING_TWO: all(map(meets, family.points, family.directions)),
            K.ACROSS: abs(way @ family.direction) < near,
            K.EVERY: True,
            # One set of lines on a quadric: each meets all of the other set, here the wires.
            K.REGULUS: True,
        }.get(family.kind, False)
    )


@pytest.mark.parametrize("name", WIRES)
def test_all_lines_that_are_found_by_trial_belong_to_a_family(name: str) -> None:
    """Lines in the space: a + t b with (a + t b).(a' + t b') = 0, of random a and b."""
    random = np.random.default_rng(3)
    found = spaces(on_wires(WIRES[name]))
    for space in (found.freedom, found.constraint):
        rows = space.basis * np.repeat((space.length, 1.0), 3)
        for a, b in random.normal(size=(40, 2, len(rows))) @ rows if len(rows) > 1 else []:
            terms = (b[:3] @ b[3:], a[:3] @ b[3:] + b[:3] @ a[3:], a[:3] @ a[3:])
            if np.abs(terms).max() < 1e-9:
                roots = [0.0, 1.0]
            else:
                roots = [t.real for t in np.roots(terms) if abs(t.imag) < 1e-9]
            for t in roots:
                axis, moment = np.split((a + t * b) / np.repeat((space.length, 1.0), 3), 2)
                size = np.linalg.norm(axis)
                if size * space.length < 1e-3 * np.linalg.norm(moment):
                    continue
                point = space.about + np.cross(axis, moment) / size**2
                if np.linalg.norm(point) > 100.0 * space.length:
                    continue
                assert any(is_of(family, point, axis / size) for family in space.lines)


def test_lines_of_three_skew_wires_meet_them_all() -> None:
    """Every line of the freedom regulus meets every wire (Blanding's rule)."""
    wires = WIRES["three skew wires"]
    regulus = only(spaces(on_wires(wires)).freedom, K.REGULUS)
    for point, way in zip(regulus.points, regulus.directions, strict=True):
        for place, other in wires:
            assert abs(np.cross(other, way) @ (np.array(place) - point)) < 1e-9


# Names, places and divided sheets ------------------------------------------


@pytest.mark.parametrize("place", PLACES.values(), ids=PLACES)
@pytest.mark.parametrize("make", [guide, cross_hinge, wires_on_a_helix])
def test_spaces_do_not_depend_on_place_scale_and_numbers(make: object, place: Place) -> None:
    assert callable(make)
    first, other = (spaces(make(each), None) for each in (Place(), place))
    assert other.subject.name == first.subject.name
    for a, b in ((first.freedom, other.freedom), (first.constraint, other.constraint)):
        assert [one.kind for one in a.families] == [one.kind for one in b.families]
        for one, two in zip(a.families, b.families, strict=True):
            if one.direction.any():
                assert parallel(place.turn @ one.direction, two.direction)
            if one.kind is K.LINE:
                assert np.linalg.norm(
                    np.cross(place.point(one.point) - two.point, two.direction)
                ) < 1e-7 * np.linalg.norm(place.point((0.1, 0.1, 0.1)))
            assert two.pitch == pytest.approx(place.scale * one.pitch, rel=1e-6, abs=1e-9)


def test_undeclared_divided_sheets_change_nothing() -> None:
    deck = "input_decks/flexures/parallel_guide_four_beams{}.dat"
    one, other = (spaces_of(flexact.analyse(deck.format(each))) for each in ("", "_undeclared"))
    assert one is not None
    assert other is not None
    assert kinds(one.freedom) == kinds(other.freedom) == {K.DIRECTION}
    assert other.freedom.has(ScrewSpace.free(only(one.freedom, K.DIRECTION).direction))


def test_a_wavy_sheet_that_is_not_declared_changes_nothing() -> None:
    """As analysed its inner nodes take up the over-constraint; the body is to move as before."""
    text = Path("input_decks/flexures/parallel_guide_wavy_8_beams.dat").read_text()
    released = re.sub(r"^DYNE", "RLSE", text, flags=re.MULTILINE)
    assert released != text
    one, other = (flexact.analyse(flexact.read_text(each)) for each in (text, released))
    assert other.under_constrained > one.under_constrained
    for result in (one, other):
        found = spaces_of(result)
        assert found is not None
        assert found.freedom.dimension == 1
        assert kinds(found.freedom) == {K.DIRECTION}


def test_a_planar_body_has_three_dimensions() -> None:
    for deck, free, held in (
        ("planar_parallel_guide", {K.DIRECTION}, {K.PARALLELS_IN_PLANE, K.DIRECTION}),
        ("planar_cross_hinge", {K.LINE}, {K.PENCIL}),
    ):
        found = spaces_of(flexact.analyse(f"input_decks/flexures/{deck}.dat"))
        assert found is not None
        assert found.freedom.dimension + found.constraint.dimension == 3
        assert kinds(found.freedom) == free
        assert kinds(found.constraint) == held
        again = found.constraint.reciprocal
        assert all(again.has(each) for each in found.freedom.basis)


# Which body -----------------------------------------------------------------


def test_the_body_is_found_by_its_name_or_by_a_point_on_it() -> None:
    model = on_wires(WIRES["guide"])
    model.node(0.3, 0.0, 0.0, name="tip")
    model.body(["stage", "tip"])
    result = flexact.analyse(model)
    for name in ("stage", "the stage", "tip"):
        found = spaces_of(result, name)
        assert found is not None
        assert found.subject.name == "stage"


@pytest.mark.parametrize(
    ("name", "words"), [("stge", "stage"), ("wire 1", "no body but a wire"), ("", "stage")]
)
def test_a_body_that_is_not_there_is_told_with_those_that_are(name: str, words: str) -> None:
    result = flexact.analyse(on_wires(WIRES["guide"]))
    with pytest.raises(flexact.ModelError, match=words):
        spaces_of(result, name)


def test_without_a_name_it_is_the_body_that_a_designer_means() -> None:
    deck = "input_decks/{}.dat".format
    for path, name in (
        ("paper/five_folded_sheets", "the body"),
        ("flexures/five_folded_sheets_undeclared", "the body"),
        ("paper/folded_sheet_free", "far end"),
        ("paper/folded_sheet_clamped", "fold"),
        ("paper/six_folded_sheets", "cylinder"),
        ("linkages/sarrus", "platform"),
    ):
        found = spaces_of(flexact.analyse(deck(path)))
        assert found is not None
        assert found.subject.name == name
    assert spaces_of(flexact.analyse(deck("paper/twelve_trusses"))) is None


def test_of_two_stages_it_is_the_one_that_moves_more() -> None:
    model = Model()
    model.sheet((0, 0, 0), (0.1, 0, 0), "z", name="lower 1")
    model.sheet((0, 0.05, 0), (0.1, 0.05, 0), "z", name="lower 2")
    model.fix((0, 0, 0), (0, 0.05, 0))
    model.body([(0.1, 0, 0), (0.1, 0.05, 0), (0.2, 0, 0), (0.2, 0.05, 0)], "carriage")
    model.sheet((0.2, 0, 0), (0.2, 0, 0.1), "y", name="upper 1")
    model.sheet((0.2, 0.05, 0), (0.2, 0.05, 0.1), "y", name="upper 2")
    model.body([(0.2, 0, 0.1), (0.2, 0.05, 0.1)], "table")
    found = spaces_of(flexact.analyse(model))
    assert found is not None
    assert found.subject.name == "table"
    model.independent("carriage", "y")
    found = spaces_of(flexact.analyse(model))
    assert found is not None
    assert found.subject.name == "carriage"
