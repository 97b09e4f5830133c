# SPDX-License-Identifier: BSD-3-Clause
"""Cartwheels, struts, vees, spiders and their like; frames, polar places, wishes of bodies.

What a part holds between its ends is taken from its wrenches: a sheet holds the forces along its
length and its width and the moment about its normal, a folded sheet the force along its fold, a
strut or a contact that along its line (M. P. Koster, Constructieprincipes; the paper, section 4).
Of n of them on one body, whose wrenches have rank r, n - r are too many and 6 - r motions are left.
"""

from __future__ import annotations

import math
import pickle
from collections.abc import Callable, Sequence

import numpy as np
import pytest
from wrong_use import code_of

import flexact
from flexact import Assembly, Model, ModelError, ReinforcedSheet, analyse, polar
from flexact.model.data import BodyShape

Array = Sequence[float] | np.ndarray
X, Y, Z = np.eye(3)
GROUND, MOVING = [(-0.02, 0, 0), (0.02, 0, 0)], [(0.02, 0, 0.06), (-0.02, 0, 0.06)]


def counts(model: Model) -> tuple[int, int]:
    analysis = analyse(model)
    return analysis.under_constrained, analysis.over_constrained


def force(along: Array, at: Array) -> np.ndarray:
    """The wrench of a force along a line through a point, and its moment about the origin."""
    unit = np.array(along) / np.linalg.norm(along)
    return np.concatenate([unit, np.cross(at, unit)])


def sheet(p: Array, q: Array, width: Array) -> list[np.ndarray]:
    """The three wrenches that a sheet holds."""
    along = np.array(q) - p
    normal = np.cross(along, width) / np.linalg.norm(along) / np.linalg.norm(width)
    return [force(along, p), force(width, p), np.concatenate([np.zeros(3), normal])]


def held(wrenches: Sequence[np.ndarray]) -> tuple[int, int]:
    """Motions that are left, and wrenches too many, of one body."""
    rank = int(np.linalg.matrix_rank(np.array(wrenches), tol=1e-9))
    return 6 - rank, len(wrenches) - rank


def turn(model: Model, centre: Array, place: Array) -> tuple[np.ndarray, float]:
    """The axis of the only motion of a body, and how far the centre moves: that of its last point.

    Args:
        model: A model with one motion.
        centre: A place that should stand still [m].
        place: A place on the body [m].
    """
    (motion,) = analyse(model).motions
    node = model.point(place)
    rotation = motion.rotation[model.node_index(node.orientation)]
    moved = motion.displacement[model.node_index(node.position)]
    moved = moved + np.cross(rotation, np.array(centre) - place)
    return rotation / np.linalg.norm(rotation), float(np.linalg.norm(moved))


@pytest.mark.parametrize(
    "given", [{}, {"beams": 2}, {"reinforced": 0.6}, {"reinforced": 0.6, "beams": 2}]
)
def test_a_cartwheel_turns_about_its_centre(given: dict[str, float]) -> None:
    """Each pair of half sheets, in two planes that meet in the axis, holds six, five count.

    Twelve motions of body and centre less ten: both turn, of which the centre is declared.
    """
    model = Model()
    hinge = model.cartwheel(GROUND, MOVING, name="hinge", **given)  # type: ignore[arg-type]
    model.fix(*hinge.ground)
    assert counts(model) == (1, 2)
    axis, moved = turn(model, (0, 0, 0.03), MOVING[0])
    assert abs(axis @ Y) == pytest.approx(1.0) and moved < 1e-9
    assert hinge.points["centre"].place == pytest.approx((0, 0, 0.03))
    assert list(hinge.parts) == [
        f"{side} sheet {k}" for side in ("near", "far") for k in (1, 2)
    ] + ["body"]
    assert model.point("hinge centre") == hinge["centre"]


def test_a_planar_cartwheel_turns_about_its_centre() -> None:
    """Each half sheet holds its elongation: four of the six motions of body and centre."""
    model = Model(planar=True)
    hinge = model.cartwheel([(-1, 0), (1, 0)], [(1, 2), (-1, 2)])
    model.fix(*hinge.ground)
    assert counts(model) == (1, 0)
    assert hinge["centre"].place == pytest.approx((0, 1))  # type: ignore[union-attr]


def test_an_infinity_hinge_is_held_once_in_all_but_its_axis() -> None:
    """Sheet: three. Fold and wire: forces along x at both sides of it, at half of its height."""
    model = Model()
    hinge = model.infinity_hinge((0, 0, 0), (0, 0, 0.04), "y", aside=0.03)
    model.fix(*hinge.ground)
    across = [force(X, (0, y, 0.02)) for y in (0.03, -0.03)]
    assert counts(model) == held([*sheet((0, 0, 0), (0, 0, 0.04), Y), *across]) == (1, 0)
    axis, moved = turn(model, (0, 0, 0.02), (0, 0, 0.04))
    assert abs(axis @ Y) == pytest.approx(1.0) and moved < 1e-9


@pytest.mark.parametrize("sheets", [3, 4, 5])
@pytest.mark.parametrize("tilt", [20.0, 60.0])
def test_a_folded_hinge_holds_the_centre_of_its_folds(sheets: int, tilt: float) -> None:
    model = Model()
    hinge = model.folded_hinge(0.05, sheets=sheets, tilt=tilt)
    model.body([hinge.body, (0, 0, 0)])
    model.fix(*hinge.ground)
    slope = math.radians(tilt)
    lines = [
        force(
            (math.cos(a) * math.cos(slope), math.sin(a) * math.cos(slope), math.sin(slope)), 0 * X
        )
        for a in 2.0 * math.pi * np.arange(sheets) / sheets
    ]
    assert counts(model) == held(lines) == (3, sheets - 3)
    centre = model.node_index((0, 0, 0))
    for motion in analyse(model).motions:
        assert np.linalg.norm(motion.displacement[centre]) < 1e-9


@pytest.mark.parametrize("q", [None, (0, 0, 0.02)])
def test_a_universal_joint_turns_about_two_axes(q: tuple[float, ...] | None) -> None:
    model = Model()
    joint = model.universal_joint((0, 0, 0), ("x", (0, 1, 0)), q, name="joint")
    model.body([joint["q"], (0.1, 0.1, 0.1)], name="stage")
    model.fix(*joint.ground)
    assert counts(model) == (2, 0)
    for motion in analyse(model).motions:
        node = joint.points["q"].orientation
        assert abs(motion.rotation[model.node_index(node)] @ Z) < 1e-9


@pytest.mark.parametrize(
    ("ends", "left"),
    [
        # Only the distance is held; a bar between two necks turns about itself, which is declared.
        ("spherical", 5),
        (("universal", "spherical"), 5),
        # Two crossed notches at each end hold the turning about the line, too.
        ("universal", 4),
    ],
)
def test_what_a_strut_holds(ends: str | Sequence[str], left: int) -> None:
    model = Model()
    strut = model.strut((0, 0, 0), (0.01, 0.02, 0.1), ends, name="strut")
    model.body([strut["q"], (0, 0, 0.2)])
    model.fix(strut["p"])
    assert counts(model) == (left, 0)
    along = np.array((0.01, 0.02, 0.1))
    for motion in analyse(model).motions:
        assert abs(motion.displacement[model.node_index((0.01, 0.02, 0.1))] @ along) < 1e-12
    assert len(analyse(model).freedoms) == (ends == "spherical")


def test_a_planar_strut_is_a_bar_between_two_notches() -> None:
    model = Model(planar=True)
    strut = model.strut((0, 0), (0.1, 0))
    model.body([strut["q"], (0.1, 0.1)])
    model.fix(strut["p"])
    assert counts(model) == (2, 0)


@pytest.mark.parametrize("reach", [1.0, 0.6])
def test_a_bipod_holds_its_apex_in_the_plane_of_its_struts(reach: float) -> None:
    model, apex = Model(), (0.01, 0, 0.1)
    bipod = model.bipod(
        [(-0.05, 0, 0), (0.05, 0, 0)], apex, "bipod", reach=reach, carries=[(0, 1, 0)]
    )
    model.fix(*bipod.ground)
    lines = [force(np.array(apex) - foot, apex) for foot in ((-0.05, 0, 0), (0.05, 0, 0))]
    assert counts(model) == held(lines) == (4, 0)
    for motion in analyse(model).motions:
        moved = motion.displacement[model.node_index(apex)]
        assert abs(moved[0]) < 1e-12 and abs(moved[2]) < 1e-12


def test_the_bars_of_a_vee_are_normal_to_its_flanks() -> None:
    """A groove along x that opens by 60 degrees upwards: normals 60 degrees from upright."""
    model = Model()
    vee = model.vee((0, 0, 0.1), "x", 0.02, opening=60)
    feet = sorted(node.place for node in vee.ground)
    side, down = 0.02 * math.sin(math.pi / 3), 0.1 - 0.02 * math.cos(math.pi / 3)
    assert np.allclose(feet, [(0, -side, down), (0, side, down)], atol=1e-15)
    model.body([vee["ball"], (0, 1, 0)])
    model.fix(*vee.ground)
    assert counts(model) == (4, 0)


@pytest.mark.parametrize("turned", [0.0, 30.0, 90.0])
def test_a_kinematic_mount_is_exact_unless_its_grooves_lie_across(turned: float) -> None:
    model = Model()
    mount = model.kinematic_mount(0.05, 0.02, turned=turned)
    model.fix(*mount.ground)
    lines = []
    for k in range(3):
        a, g = math.radians(120 * k), math.radians(120 * k + turned)
        side = np.array((-math.sin(g), math.cos(g), 0.0))
        lines += [
            force(Z + sign * side, 0.05 * np.array((math.cos(a), math.sin(a), 0)))
            for sign in (-1, 1)
        ]
    assert counts(model) == held(lines) == ((1, 1) if turned == 90 else (0, 0))


@pytest.mark.parametrize("layout", ["radial", "tangential", "folded"])
@pytest.mark.parametrize("arms", [2, 3, 6])
def test_a_spider_leaves_z_and_two_tilts(layout: str, arms: int) -> None:
    """Each arm lies in the plane: it holds x, y and rz, also where it is folded in the plane."""
    model = Model()
    spider = model.spider(0.06, 0.02, arms, layout, carries=[(0, 0, 0)])
    model.fix(*spider.ground)
    assert counts(model) == (3, 3 * arms - 3)
    radii = {round(math.hypot(*node.place), 12) for node in spider.ground}
    assert radii == {0.06}
    assert len(analyse(model).freedoms) == (3 * arms if layout == "folded" else 0)
    for name in spider.parts:
        if name.startswith("arm") and layout == "tangential":
            arm = spider.parts[name]
            p, q = (np.array(node.place) for node in arm.nodes)  # type: ignore[union-attr]
            assert abs((q - p) @ q) < 1e-15


@pytest.mark.parametrize(("wires", "left"), [(False, 3), (True, 4)])
def test_a_diaphragm_holds_as_a_membrane_does(wires: bool, left: int) -> None:
    """Its lines all meet the axis, so that wires leave the rotation about z."""
    model = Model()
    made = model.diaphragm(0.05, 0.01, 8, wires=wires)
    assert len(made.ground) == 1
    model.fix(*made.ground)
    lines = []
    for a in 2.0 * math.pi * np.arange(8) / 8:
        radial, aside = (
            np.array((math.cos(a), math.sin(a), 0)),
            np.array((-math.sin(a), math.cos(a), 0)),
        )
        whole = sheet(0.05 * radial, 0.01 * radial, aside)
        lines += whole[:1] if wires else whole
    assert counts(model) == held(lines) == (left, len(lines) - 6 + left)


@pytest.mark.parametrize("beams", [1, 3])
def test_a_reinforced_sheet_is_one_sheet(beams: int) -> None:
    """Its middle has three motions of its own, as many as the second leaf releases."""
    model = Model()
    made = model.sheet((0, 0, 0), (0, 0, 0.1), "y", beams, "sheet", reinforced=0.7)
    assert isinstance(made, ReinforcedSheet) and made.name == "sheet"
    model.fix((0, 0, 0))
    assert counts(model) == held(sheet((0, 0, 0), (0, 0, 0.1), Y)) == (3, 0)
    middle = [node.place[2] for node in made.pieces["middle"].nodes]
    assert middle == pytest.approx([0.015, 0.085])
    names = {part.name for part in analyse(model).parts.all}
    assert names == {"sheet, leaf 1", "sheet, middle", "sheet, leaf 2"}
    for word, left in (("twist", 2), ("out-of-plane bending", 0)):
        model.hold(made, word)
        assert counts(model) == (left, 0)
    model.rename(made, "blade")
    assert made.name == "blade" and made.pieces["middle"].name == "blade, middle"
    model.delete(made)
    assert not model.element_numbers.size


@pytest.mark.parametrize("beams", [1, 2])
def test_a_reinforced_sheet_bends_in_its_leaves_alone(beams: int) -> None:
    """By the integrals of beam theory over both leaves; shear is less than 1e-4 of it."""
    model = Model()
    size = {"thickness": 2e-4, "breadth": 0.02}
    made = model.sheet((0, 0, 0), (0, 0, 0.1), "y", beams, material="steel", reinforced=0.7, **size)
    model.fix((0, 0, 0))
    model.body([(0, 0, 0.1), (0, 0, 0.11)], name="stage")
    model.independent("stage", "x", "ry", "rz")
    bending = 210e9 * 0.02 * 2e-4**3 / 12
    compliance = flexact.elastic(model).undeformed().compliance("stage")
    assert compliance[4, 4] * bending == pytest.approx(0.03, rel=1e-6)
    away = (0.1**3 - 0.085**3 + 0.015**3) / 3
    assert compliance[0, 0] * bending == pytest.approx(away, rel=1e-4)
    # The middle has no stiffness of its own, and the leaves get what is said afterwards.
    model.made_of(made, "steel", thickness=4e-4, breadth=0.02)
    properties = model.data.properties
    assert properties is not None
    given = [properties.stiffness[model.element_index(e.number), 3] for e in made.elements]
    wanted = [8 * bending] * beams
    assert given == pytest.approx([*wanted, math.nan, *wanted], nan_ok=True)


# Frames and polar places -----------------------------------------------------


@pytest.mark.parametrize("degrees", [0, 17.0, 90, 120, 210.0, -45])
def test_polar_places(degrees: float) -> None:
    a = math.radians(degrees)
    assert polar(0.2, degrees, 0.1) == pytest.approx((0.2 * math.cos(a), 0.2 * math.sin(a), 0.1))
    assert polar("200 mm", f"{degrees} deg", "10 cm") == pytest.approx(polar(0.2, degrees, 0.1))


def test_polar_places_are_exact_at_right_angles() -> None:
    assert [polar(0.3, degrees) for degrees in (0, 90, 180, 270)] == [
        *((0.3, 0, 0), (0, 0.3, 0), (-0.3, 0, 0), (0, -0.3, 0)),
    ]


Build = Callable[[Model], object]
BUILDS: dict[str, Build] = {
    "sheet": lambda m: m.sheet((0, 0, 0), (0, 0, 0.1), "y", beams=3),
    "reinforced": lambda m: m.sheet((0, 0, 0), (0, 0, 0.1), "y", reinforced=0.5),
    "folded sheet": lambda m: m.folded_sheet((0, 0, 0), (0.1, 0, 0), (0.1, 0.1, 0)),
    "beam": lambda m: m.beam((0, 0, 0), (0.1, 0, 0), (0, 1, 1)),
    "notch": lambda m: m.body([m.notch((0.1, 0, 0), "x").q, (0, 0, 0)]),
    "cross hinge": lambda m: m.cross_hinge(GROUND, MOVING),
    "parallel guide": lambda m: m.parallel_guide((0, 0, 0), (0, 0, 0.1), (0.03, 0.01, 0)),
    "hexapod": lambda m: m.hexapod(0.1, 0.05, 0.1, at=(0.01, 0, 0)),
    "cartwheel": lambda m: m.cartwheel(GROUND, MOVING),
    "infinity hinge": lambda m: m.infinity_hinge((0, 0, 0), (0, 0, 0.1), "y"),
    "folded hinge": lambda m: m.folded_hinge(0.1),
    "universal joint": lambda m: m.universal_joint((0, 0, 0), q=(0, 0, 0.1)),
    "strut": lambda m: m.strut((0, 0, 0), (0.1, 0, 0.1)),
    "bipod": lambda m: m.bipod(GROUND, (0, 0, 0.1), reach=0.7),
    "mount": lambda m: m.kinematic_mount(0.1, 0.02),
    "spider": lambda m: m.spider(0.1, 0.02, layout="folded"),
    "diaphragm": lambda m: m.diaphragm(0.1, 0.02, 3),
    "pattern": lambda m: (
        m.sheet((0.1, 0, 0), (0.2, 0, 0), "y"),
        m.pattern(3, "z", at=(0.3, 0, 0)),
    ),
    "row": lambda m: (m.sheet((0.1, 0, 0), (0.2, 0, 0), "y"), m.pattern(3, step=(0, 0.1, 0))),
    "mirror": lambda m: (m.sheet((0.1, 0, 0), (0.2, 0, 0.1), "y"), m.mirror("yz")),
    "move": lambda m: (m.wire((0.1, 0, 0), (0.2, 0, 0), name="w"), m.move((0.2, 0, 0), (0, 1, 0))),
    "insert": lambda m: m.insert(guide(), (0.1, 0, 0), axis="y", degrees=25),
    "loads": lambda m: (m.truss((0, 0, 0), (1, 0, 0)), m.force((1, 0, 0), 1, 2, 3)),
    "frame": lambda m: in_another(m),
}


def guide() -> Model:
    model = Model()
    model.parallel_guide((0, 0, 0), (0, 0, 0.1), (0.03, 0.01, 0))
    return model


def in_another(model: Model) -> None:
    with model.frame((0.1, 0, 0), "y", 30):
        model.sheet((0, 0, 0), (0, 0, 0.1), "y")


@pytest.mark.parametrize("name", BUILDS)
def test_what_is_made_in_a_frame_is_what_is_made_and_then_moved(name: str) -> None:
    at, axis, degrees = (0.3, -0.2, 0.1), (1.0, 2.0, -1.0), 40.0
    plain, framed = Model(), Model()
    BUILDS[name](plain)
    with framed.frame(at, axis, degrees):
        BUILDS[name](framed)
    n = np.array(axis) / np.linalg.norm(axis)
    s, c = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))
    # Rodrigues: the columns are the images of x, y and z.
    turned = c * np.eye(3) + s * np.cross(n, np.eye(3)).T + (1 - c) * np.outer(n, n)
    assert framed.element_names == plain.element_names
    assert framed.node_names == plain.node_names
    places = plain.node_kinds <= 2
    wanted = plain.positions[places] @ turned.T + at
    assert np.allclose(framed.positions[places], wanted, atol=1e-14)
    assert np.allclose(framed.element_vectors, plain.element_vectors @ turned.T, atol=1e-12)
    assert np.array_equal(framed.deformation_classes, plain.deformation_classes)
    if plain.data.loads is not None:
        assert framed.data.loads is not None
        assert np.allclose(framed.data.loads.force, plain.data.loads.force @ turned.T, atol=1e-14)


@pytest.mark.parametrize("name", BUILDS)
def test_its_deck_has_the_same_verdict(name: str) -> None:
    model = Model()
    BUILDS[name](model)
    again = flexact.read_text(model.to_deck())
    assert counts(again) == counts(model)
    assert len(analyse(again).freedoms) == len(analyse(model).freedoms)


def test_frames_by_hand() -> None:
    model = Model()
    with model.frame((1, 2, 3), "z", 90):
        node = model.node(0.5, 0, 0, name="a")
        with model.frame((0.5, 0, 0), "z", 90):
            inner = model.node("10 cm", 0, 0)
        assert model.point((0.5, 0, 0)) == node
        model.sheet("a", (0.5, 0, 1), "x", name="sheet")
    assert node.place == (1, 2.5, 3) and inner.place == pytest.approx((0.9, 2.5, 3))
    # The width is along y of the model, so that its normal is along x.
    assert np.allclose(np.abs(model.element_vectors[0]), X)
    with model.frame("a"):
        assert model.node(0, 0, 1).place == (1, 2.5, 4)


def test_coordinates_are_those_of_the_frame() -> None:
    model = Model()
    model.truss((0, 0, 0), (1, 0, 0))
    with model.frame(degrees=90):
        model.fix((0, 0, 0), "x")
        model.force((0, 0, 0), 5, 0, 0)
    assert model.coordinate_classes[0].tolist() == [2, 1, 2]
    loads = model.data.loads
    assert loads is not None and loads.force[0] == pytest.approx((0, 5, 0))
    with model.frame(degrees=30):
        model.fix((0, 0, 0), "z")
        with pytest.raises(ModelError, match="askew") as error:
            model.fix((0, 0, 0), "x")
        assert code_of(error) == "turned-class"
    model.fix((1, 0, 0), "x")
    assert model.coordinate_classes.tolist() == [[2, 1, 1], [1, 2, 2]]


def test_a_frame_ends_with_an_error() -> None:
    model = Model()
    with pytest.raises(ModelError), model.frame((1, 0, 0)):
        model.point("nobody")
    assert model.node(0, 0, 0).place == (0, 0, 0)


def test_a_planar_frame_turns_about_z() -> None:
    model = Model(planar=True)
    with model.frame((1, 0), degrees=90):
        assert model.node(1, 0).place == pytest.approx((1, 1))
        with pytest.raises(ModelError, match="no coordinate z"):
            model.node(0, 0, 1)
    with pytest.raises(ModelError, match="turns about z"), model.frame(axis="x", degrees=90):
        pass


# As what bodies are drawn ----------------------------------------------------


def test_the_wish_of_a_body_stays_with_it() -> None:
    model = Model()
    model.body([(0, 0, 0), (0.1, 0, 0)], name="lens", shape="disc", thickness="8 mm")
    model.sheet((0.1, 0, 0), (0.2, 0, 0), "y", beams=4)
    model.pattern(3, "z")
    model.body([(1, 0, 0), (1, 1, 0)], name="plain")
    copied = Model.from_data(pickle.loads(pickle.dumps(model.data)))
    copied.node(5, 5, 5)
    for each in (model.data, copied.data, analyse(model).data):
        looks, names = each.appearance, np.array(each.element_names)
        is_lens = np.char.startswith(names, "lens")
        assert (
            is_lens.sum() == 3 and (looks.body_shape == np.where(is_lens, BodyShape.DISC, 0)).all()
        )
        assert looks.body_thickness[is_lens].tolist() == [0.008] * 3
        assert np.isnan(looks.body_thickness[~is_lens]).all()
    # A deck has no word for it, and no picture block because of it.
    assert "VISUALIZATION" not in model.to_deck()
    model.look("plain", colour=(1, 0, 0))
    assert "VISUALIZATION" in model.to_deck()


def test_a_thickness_alone_is_that_of_the_hull() -> None:
    model = Model()
    model.body([(0, 0, 0), (0.1, 0, 0)], thickness=0.01)
    assert model.data.appearance.body_shape.tolist() == [BodyShape.HULL]


# Errors ----------------------------------------------------------------------

Wrong = Callable[[Model], Assembly | object]
WRONG: dict[str, tuple[str, str, Wrong]] = {
    "one sheet": (
        "bad-number",
        "a cartwheel with 1 points",
        lambda m: m.cartwheel(GROUND[:1], MOVING[:1]),
    ),
    "parallel sheets": ("bad-number", "do not cross", lambda m: m.cartwheel(GROUND, MOVING[::-1])),
    "skew sheets": (
        "bad-number",
        "do not cross",
        lambda m: m.cartwheel(GROUND, [(0.02, 0, 0.06), (-0.02, 0.001, 0.06)]),
    ),
    "a third beside": (
        "bad-number",
        "do not cross",
        lambda m: m.cartwheel([*GROUND, (0.01, 0, 0)], [*MOVING, (0.01, 0, 0.06)]),
    ),
    "aside": (
        "bad-size",
        "not positive",
        lambda m: m.infinity_hinge((0, 0, 0), (0, 0, 1), "y", aside=-1),
    ),
    "flat folds": ("out-of-range", "tilted by 0 degrees", lambda m: m.folded_hinge(0.1, tilt=0)),
    "two folds": ("out-of-range", "there can be 3", lambda m: m.folded_hinge(0.1, sheets=2)),
    "one axis": ("bad-number", "two axes", lambda m: m.universal_joint((0, 0, 0), ("x",))),
    "axes": (
        "parallel-vector",
        "parallel",
        lambda m: m.universal_joint((0, 0, 0), ("x", (-2, 0, 0))),
    ),
    "ends": (
        "no-such-word",
        "universal or spherical",
        lambda m: m.strut((0, 0, 0), (0, 0, 1), "ball"),
    ),
    "no length": ("same-node", "both ends", lambda m: m.strut((0, 0, 0), (0, 0, 0))),
    "three feet": ("bad-number", "3 feet", lambda m: m.bipod([X, Y, Z], (0, 0, 0))),
    "reach": ("out-of-range", "1.2 of the way", lambda m: m.bipod([X, Y], (0, 0, 0), reach=1.2)),
    "groove": ("parallel-vector", "upward", lambda m: m.vee((0, 0, 0), "z", 0.1)),
    "opening": ("out-of-range", "180 degrees", lambda m: m.vee((0, 0, 0), "x", 0.1, opening=180)),
    "breadth": ("surplus-size", "breadth is", lambda m: m.vee((0, 0, 0), "x", 0.1, breadth=0.1)),
    "wires": (
        "surplus-size",
        "for sheets",
        lambda m: m.diaphragm(1, 0.1, wires=True, warping=True),
    ),
    "folds": ("surplus-size", "reinforced is", lambda m: m.folded_hinge(0.1, reinforced=0.5)),
    "radii": ("bad-size", "inner radius", lambda m: m.spider(0.02, 0.06)),
    "layout": ("no-such-word", "radial", lambda m: m.spider(0.06, 0.02, layout="spiral")),
    "ring": ("bad-size", "outer radius", lambda m: m.diaphragm(0.0, 0.02)),
    "share": ("out-of-range", "share", lambda m: m.sheet((0, 0, 0), (0, 0, 1), "y", reinforced=1)),
    "shape": ("no-such-word", "hull or box or disc", lambda m: m.body([X, Y], shape="ball")),
    "thickness": ("bad-size", "not positive", lambda m: m.body([X, Y], thickness=0)),
    "no links": ("not-an-element", "not drawn", lambda m: m.body([X], shape="disc")),
}


@pytest.mark.parametrize("name", WRONG)
def test_wrong_arguments_are_told(name: str) -> None:
    code, words, call = WRONG[name]
    with pytest.raises(ModelError, match=words) as error:
        call(Model())
    assert code_of(error) == code


def test_a_word_that_flexures_have_not_is_refused() -> None:
    with pytest.raises(TypeError, match="colour"):
        Model().spider(0.06, 0.02, colour=3)  # type: ignore[call-arg]
