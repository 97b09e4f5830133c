# SPDX-License-Identifier: BSD-3-Clause
"""Pictures: what stands where in them, and in which colour.

Points of the drawings are projected here, and the pixels there are looked at.
"""

import itertools
from collections.abc import Callable
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pictures import SWINGING, VIEW, Pixels, collection, deck, hue, of_text
from small_decks import COLLINEAR, DECKS, TRIANGLE

import flexact
from flexact.show.drawing import BENDING, QUANTITIES, Resultants, drawing_of
from flexact.show.drawing.diagrams import diagrams_of
from flexact.show.drawing.members import ARROW, FREEDOM
from flexact.show.drawing.view import view_of
from flexact.util.errors import BatchError

pytest.importorskip("matplotlib")
pytest.importorskip("PIL")

from flexact.show.page import page
from flexact.show.picture import PictureError, draw, picture_bytes

pytestmark = pytest.mark.dear(20)

#: What stands before the statements of the picture block.
BLOCKS = "END\nHALT\n\nEND\n\nVISUALIZATION\n"
#: The pale grey of the reference shape.
GHOST = np.array((0.8936, 0.9012, 0.9126))
#: Two sheets and a beam across their ends; the sheets bend evenly in their planes.
TWO_SHEETS = """\
BEAM 1 1 2 3 4 0 1 0
BEAM 2 5 6 7 8 0 1 0
BEAM 3 3 4 7 8
X 3 0.1 0 0
X 5 0 0.05 0
X 7 0.1 0.05 0
FIX 1
FIX 2
FIX 5
FIX 6
RLSE 1 2 5 6
RLSE 2 2 5 6
"""


def positions(analysis: flexact.Analysis) -> dict[int, np.ndarray]:
    arrays = analysis.data.arrays
    return dict(zip(arrays.node_number.tolist(), arrays.node_value[:3].T, strict=True))


# Self-stress


def test_twelve_trusses_are_half_red_and_half_blue() -> None:
    """Fig. 2(a): tension and compression, each bar as its own force has it."""
    analysis = deck("paper/twelve_trusses")
    pixels = Pixels(draw(analysis, stress=1, view=VIEW))
    forces = analysis.self_stresses[0].forces[:, 0]
    assert np.sum(forces > 0) == np.sum(forces < 0) == 6
    place = positions(analysis)
    numbers = analysis.data.arrays.node_number
    for element, force in zip(analysis.data.arrays.element_node.T, forces, strict=True):
        first, last = (place[int(numbers[k - 1])] for k in (element[0], element[2]))
        # At a crossing another bar may be in front.
        seen = [
            hue(pixels.at(first + share * (last - first))) for share in (0.2, 0.35, 0.5, 0.65, 0.8)
        ]
        assert sum(seen) * np.sign(force) >= 3


def test_clamped_ends_of_a_folded_sheet_are_opposite() -> None:
    """Fig. 4(c): bending in the plane of the sheets, of opposite signs at the clamped ends."""
    analysis = deck("paper/folded_sheet_clamped")
    pixels = Pixels(draw(analysis, stress=1, view=VIEW))
    drawing = drawing_of(analysis.given)
    hues = []
    clamped = {each.held[0] for each in drawing.supports}
    for row in range(2):
        p, _, q, _ = drawing.members.nodes[row]
        near, far = (p, q) if p in clamped else (q, p)
        start, end = drawing.reference.position[[near, far]]
        width = drawing.members.section[row, 1] * drawing.members.frame[row, :, 2]
        # Beside the diagram, which is on one side of the axis.
        sides = [hue(pixels.at(0.93 * start + 0.07 * end + s * width)) for s in (-0.4, 0.4)]
        assert sides[0] == sides[1] != 0
        hues.append(sides[0])
        middle = [hue(pixels.at(0.03 * start + 0.97 * end + s * width)) for s in (-0.4, 0.4)]
        assert middle == [0, 0]
    assert sorted(hues) == [-1, 1]


def test_six_folded_sheets_alternate() -> None:
    """Fig. 6: twelve equal moments, at the ground of one sign above and of the other below."""
    analysis = deck("paper/six_folded_sheets")
    moments = np.abs(analysis.self_stresses[0].moments[:, 2:4]).max(axis=1)[:12]
    np.testing.assert_allclose(moments, moments[0], rtol=1e-9)
    place = positions(analysis)
    seen = []
    # Ground nodes above, then below; each sheet is looked at from outside, where it is in front.
    for node in (11, 21, 31, 41, 51, 61):
        start, fold = place[node], place[node + 2]
        azimuth = float(np.degrees(np.arctan2(start[1], start[0])))
        figure = draw(analysis, view=f"{azimuth},10")
        pixels = Pixels(figure, eye=(azimuth, 10.0))
        along = 0.04 * np.array([-start[1], start[0], 0.0]) / np.hypot(*start[:2])
        for share, strong in ((0.15, 1), (0.97, 0)):
            points = [(1 - share) * start + share * fold + s * along for s in (-0.25, 0.25)]
            seen.append([strong, *(hue(pixels.at(point)) for point in points)])
    ends = [tuple(row[1:]) for row in seen if row[0]]
    # Red stretches the edge of the sheet at the side of y, or x: the sense round the cylinder
    # alternates, so that of the colours follows from the azimuths.
    senses = [1, 1, -1, 1, -1, 1]
    expected = [(sense, sense) for sense in senses]
    assert ends in (expected, [(-one, -one) for one, _ in expected])
    assert all(row == [0, 0, 0] for row in seen if not row[0])


def test_a_chosen_quantity_colours_the_members() -> None:
    """The cylinder of six folded sheets carries torsion, the sheets none."""
    analysis = deck("paper/six_folded_sheets")
    place = (0.0, 0.0, -0.02)  # of the cylinder, with no diagram before or behind it
    grey = Pixels(draw(analysis, stress=1, quantity="My", view=VIEW)).at(place)
    twisted = Pixels(draw(analysis, stress=1, quantity="T", view=VIEW))
    assert hue(grey) == 0
    assert hue(twisted.at(place)) != 0


def test_the_legend_of_nothing_is_zero() -> None:
    """Bars carry no torsion."""
    figure = draw(deck("paper/twelve_trusses"), stress=1, quantity="T")
    words = [text.get_text() for text in figure.texts]
    assert "0" in words
    assert not {"-0", "+0"} & set(words)


def test_a_bending_diagram_has_its_height_and_its_value(tmp_path: Path) -> None:
    """A cantilever's end moment, clamped at its far end too: 10 % of the size off its edge."""
    clamped = "PLBEAM 1 1 2 3 4\nX 3 2 0\nFIX 1\nFIX 2\nFIX 3\nFIX 4\n"
    analysis = of_text(tmp_path, clamped)
    stresses = analysis.self_stresses
    number, stress = next(
        (k, s) for k, s in enumerate(stresses, 1) if np.abs(s.moments).max() > 0.1
    )
    largest = np.abs(stress.moments).max()
    figure = draw(analysis, stress=number, quantity="Mz")
    paths = collection(figure).get_paths()
    heights = np.abs(np.concatenate([path.vertices for path in paths])[:, 1])
    half = float(drawing_of(analysis.given).members.section[0, 0]) / 2
    assert heights.max() == pytest.approx((0.1 + 0.012) * 2.0 + half, rel=1e-6)
    words = {text.get_text() for text in figure.texts}
    assert {f"{value:+.3g}" for value in (-largest, largest)} & words


def test_the_legend_says_unit_and_that_values_are_relative() -> None:
    figure = draw(deck("paper/twelve_trusses"), stress=1)
    words = [text.get_text() for text in figure.texts]
    assert "normal force, tension positive [N]" in words
    assert "Relative values, only their ratios matter." in words
    largest = np.abs(deck("paper/twelve_trusses").self_stresses[0].forces).max()
    assert {f"{-largest:+.3g}", "0", f"{largest:+.3g}"} <= set(words)


@pytest.mark.parametrize("view", ["iso", "front", "top", "0,15", "-62,60", "120,-30"])
@pytest.mark.parametrize("quantity", QUANTITIES[2:])
def test_a_diagram_is_seen_beside_its_member(view: str, quantity: str) -> None:
    """Its base lies outside of the outline of the member, and it goes outwards, and is wide."""
    for analysis in map(deck, ("flexures/sheet_clamped_both_ends", "flexures/parallel_guide")):
        drawing = drawing_of(analysis.given)
        eye = view_of(view, drawing)
        flexible = np.full((len(drawing.members), 4, 2), 0.0)
        flexible[:] = (1.0, -0.5)
        values = Resultants(
            flexible, np.zeros((0, 4)), drawing.seen, drawing.seen, analysis.characteristic_length
        )
        rows, value, bases, tops, _ = diagrams_of(drawing, values, quantity, eye.axes[2])
        # A moment that changes its sign is on both sides.
        assert sorted(rows) == sorted(2 * np.flatnonzero(drawing.seen).tolist())
        members, height = drawing.members, 0.1 * drawing.size
        for row, member in enumerate(rows.tolist()):
            p = drawing.reference.position[members.nodes[member, 0]]
            frame = members.frame[member]
            corner = np.array(list(product((-0.5, 0.5), repeat=2))) * members.section[member]
            flat = eye.project(frame @ np.array([1.0, 0.0, 0.0]))[:2]
            if np.hypot(*flat) < 0.05:
                continue  # a point
            across = np.array((-flat[1], flat[0])) / np.hypot(*flat)
            outline = eye.project(p + corner @ frame[:, 1:].T)[:, :2] @ across
            base, top = (eye.project(each[row])[:, :2] @ across for each in (bases, tops))
            side = np.sign((top - base).sum())
            assert np.all(side * base > (side * outline).max())
            seen = np.abs(top - base).max() / (height * np.abs(value[row]).max())
            assert seen > 0.4
            # On the stretched side, wherever that is seen.
            stretched = frame[:, 1:] @ members.across[member, BENDING[quantity]]
            way = np.sign(value[row][np.abs(value[row]).argmax()]) * stretched
            assert (tops - bases)[row].sum(axis=0) @ way > -1e-9


# Motions


def test_the_largest_displacement_is_a_tenth_of_the_size(tmp_path: Path) -> None:
    """Two bars in line, 2 m: the joint between them moves 0.2 m across, either way."""
    analysis = of_text(tmp_path, COLLINEAR)
    for phase in (1.0, -1.0, 0.5):
        figure = draw(analysis, motion=1, phase=phase)
        pixels = Pixels(figure, planar=True)
        side = phase * np.sign(analysis.motions[0].displacement[1, 1])
        bar = 255 * drawing_of(analysis.given).members.colour[0]
        for x in (-0.6, 0.6):
            moved = pixels.at((x, 0.2 * side * (1 - abs(x)), 0.0))
            np.testing.assert_allclose(moved, bar, atol=2)
            ghost = pixels.at((x, 0.0, 0.0))
            np.testing.assert_allclose(ghost, 255 * GHOST, atol=2)
        words = " ".join(text.get_text() for text in figure.texts)
        assert "largest displacement 10 % of the model's size" in words


def test_at_rest_the_shape_hides_its_ghost() -> None:
    analysis = deck("paper/twelve_trusses")
    moved = Pixels(draw(analysis, motion=1)).count(GHOST)
    assert moved > 1000
    assert Pixels(draw(analysis, motion=1, phase=0.0)).count(GHOST) < moved / 20


def test_arrows_stand_at_what_moves(tmp_path: Path) -> None:
    analysis = of_text(tmp_path, COLLINEAR)
    pixels = Pixels(draw(analysis, motion=1), planar=True)
    side = np.sign(analysis.motions[0].displacement[1, 1])
    np.testing.assert_allclose(pixels.at((0.0, 0.1 * side, 0.0)), 255 * np.array(ARROW), atol=3)
    assert Pixels(draw(analysis, stress=1), planar=True).count(ARROW) == 0


def test_declared_degrees_of_freedom_have_arrows(tmp_path: Path) -> None:
    bar = "PLTRUSS 1 1 2\nX 2 1 0\nFIX 1\nDYNX 2 2\n"
    pixels = Pixels(draw(of_text(tmp_path, bar), phase=0.0), planar=True)
    assert pixels.count(FREEDOM) > 50
    # Upwards from the node.
    np.testing.assert_allclose(pixels.at((1.0, 0.02, 0.0)), 255 * np.array(FREEDOM), atol=3)
    held = "PLTRUSS 1 1 2\nX 2 1 0\nFIX 1\nFIX 2 2\n"
    plain = draw(of_text(tmp_path, held), plain=True)
    assert Pixels(plain, planar=True).count(FREEDOM) == 0


def test_a_sliding_support_goes_with_its_node(tmp_path: Path) -> None:
    """A slider on a line of ground; the joint at the other end moves up and down."""
    rod = "PLTRUSS 1 1 2\nX 1 0 0\nX 2 0.6 0.8\nFIX 1 2\nFIX 2 1\n"
    analysis = of_text(tmp_path, rod)
    drawing = drawing_of(analysis.given)
    from flexact.show.drawing import move

    moved = move(drawing, analysis.motions[0]).pose(1.0).position
    assert abs(moved[0, 0]) > 0.05
    pixels = Pixels(draw(analysis, motion=1), planar=True)
    dark = [
        int(np.sum(pixels.near(point - (0.0, 0.06, 0.0), 4).min(axis=1) < 90))
        for point in (moved[0], drawing.reference.position[0])
    ]
    assert dark[0] > 0
    assert dark[1] == 0


def test_a_motion_that_only_turns_has_turning_arrows(tmp_path: Path) -> None:
    """A beam pinned between two supports turns about its axis; its nodes stay where they are."""
    analysis = of_text(tmp_path, "BEAM 1 1 2 3 4\nX 3 1 0 0\nFIX 1\nFIX 3\n")
    (motion,) = analysis.motions
    assert np.abs(motion.displacement).max() < 1e-12
    figure = draw(analysis, motion=1, view=VIEW)
    pixels = Pixels(figure)
    words = " ".join(text.get_text() for text in figure.texts)
    assert "Enlarged: largest rotation 1.0 rad; grey" in words
    assert "displacement" not in words
    for end in (0.0, 1.0):
        # A circle about x, of which three quarters are drawn.
        angles = np.radians(np.arange(0, 360, 10))
        ring = [(end, 0.055 * np.cos(a), 0.055 * np.sin(a)) for a in angles]
        hits = [np.abs(pixels.near(p, 2) - 255 * np.array(ARROW)).max(axis=1).min() for p in ring]
        assert 22 <= sum(hit < 20 for hit in hits) <= 32
    assert Pixels(draw(analysis, motion=1, phase=0.0, view=VIEW)).count(ARROW) == 0


# What is drawn of a drawing


def test_planar_drawings_are_flat(tmp_path: Path) -> None:
    """Whatever their direction, bars have one colour; x is to the right and y upwards."""
    analysis = of_text(tmp_path, TRIANGLE)
    figure = draw(analysis, view="left")
    pixels = Pixels(figure, planar=True)
    bar = np.rint(255 * drawing_of(analysis.given).members.colour[0])
    middles = ((0.25, 0.5, 0.0), (0.75, 0.5, 0.0))
    for middle in middles:
        np.testing.assert_allclose(pixels.at(middle), bar, atol=1)
    left, right = (pixels.place(middle) for middle in middles)
    assert left[1] < right[1]
    assert pixels.place((0.5, 1.0, 0.0))[0] < left[0]


def test_solids_are_shaded() -> None:
    """Three sides of a block of ground are seen, each with another brightness."""
    figure = draw(deck("flexures/sheet_clamped_both_ends"), stress=1, view=VIEW)
    colours = collection(figure).get_facecolor()[:, :3]
    ground = np.array((0.72, 0.73, 0.74))
    share = colours / ground
    sides = share[np.ptp(share, axis=1) < 1e-9][:, 0]
    levels = np.unique(np.round(sides[sides > 0.0], 6))
    assert len(levels) == 3
    assert levels.min() >= 0.66
    assert levels.max() <= 1.0
    assert np.diff(levels).min() > 0.02


def test_supports_stand_below_what_they_hold(tmp_path: Path) -> None:
    analysis = of_text(tmp_path, TRIANGLE)
    pixels = Pixels(draw(analysis), planar=True)
    size = drawing_of(analysis.given).size
    for node, is_held in (((0.0, 0.0), True), ((1.0, 0.0), True), ((0.5, 1.0), False)):
        below = pixels.near((node[0], node[1] - 0.045 * size, 0.0), 4)
        assert bool(np.any(below.max(axis=1) < 90)) == is_held


def test_hinges_are_cylinders_in_their_colour() -> None:
    analysis = deck("linkages/sarrus")
    purple = drawing_of(analysis.given).hinges.colour[0]
    figure = draw(analysis, motion=1, phase=0.0, view=VIEW)
    rgb = Pixels(figure).rgb / np.maximum(Pixels(figure).rgb.max(axis=-1, keepdims=True), 1)
    shaded = np.all(np.abs(rgb - purple / purple.max()) < 0.03, axis=-1)
    assert shaded.sum() > 300


@pytest.mark.parametrize(
    "wrong",
    [
        {"motion": "1"},
        {"freedom": 1.0},
        {"stress": np.zeros(2)},
        {"quantity": np.zeros(2)},
        {"view": 1},
        {"view": np.zeros(2)},
        {"phase": "0"},
        {"phase": 10**400},
        {"phase": float("nan")},
        {"phase": 2},
        {"size": 1},
        {"size": (1, 2, 3)},
        {"size": (0, 10)},
        {"size": (10**400, 10)},
        {"size": np.zeros((2, 2))},
    ],
)
def test_wrong_arguments_are_told_in_words(wrong: dict[str, Any], tmp_path: Path) -> None:
    with pytest.raises((TypeError, ValueError), match=r" is .*(not|wide)"):
        draw(of_text(tmp_path, TRIANGLE), **wrong)


@pytest.mark.parametrize("of_what", [draw, page])
def test_what_is_no_result_is_not_drawn(of_what: Callable[..., object]) -> None:
    with pytest.raises(TypeError, match="result"):
        of_what(1)


@pytest.mark.parametrize("given", ["RED 1", "0.2 0.9 0.1"])
def test_a_deck_may_choose_the_colour(given: str, tmp_path: Path) -> None:
    colour = (1.0, 0.0, 0.0) if given.startswith("RED") else (0.2, 0.9, 0.1)
    words = " ".join(map(str, colour))
    text = f"{TRIANGLE}{BLOCKS}BEAMPROPS 1\nGRAPHICS 1\nFACECOLOR {words}\n"
    pixels = Pixels(draw(of_text(tmp_path, text)), planar=True)
    np.testing.assert_allclose(pixels.at((0.25, 0.5, 0.0)), 255 * np.array(colour), atol=2)
    assert not np.allclose(pixels.at((0.75, 0.5, 0.0)), 255 * np.array(colour), atol=40)


def test_what_is_not_drawn_leaves_no_trace(tmp_path: Path) -> None:
    text = f"{TRIANGLE}{BLOCKS}BEAMPROPS 1\nDONOTDRAW 1\n"
    pixels = Pixels(draw(of_text(tmp_path, text)), planar=True)
    assert pixels.at((0.25, 0.5, 0.0)).tolist() == [255, 255, 255]
    assert pixels.at((0.75, 0.5, 0.0)).tolist() != [255, 255, 255]


def test_a_drawing_of_which_nothing_is_drawn_makes_a_picture(tmp_path: Path) -> None:
    text = f"{TRIANGLE}{BLOCKS}BEAMPROPS 1 2\nDONOTDRAW 1 2\n"
    assert picture_bytes(of_text(tmp_path, text), ".png").startswith(b"\x89PNG")


def test_what_is_invisible_leaves_its_room_and_its_arrows(tmp_path: Path) -> None:
    look = f"{BLOCKS}GRAPHICS\nOPACITY "
    figures = [
        draw(of_text(tmp_path, f"{SWINGING}{look}{opacity}\n"), motion=1, view=VIEW)
        for opacity in (0, 1)
    ]
    unseen, seen = (Pixels(figure) for figure in figures)
    assert unseen.count(ARROW) > 50
    for rest in (0.35, 0.65):
        place = (0.0, 0.0, rest)
        assert unseen.near(place, 5).min() == 255 > seen.near(place, 5).min()
    limits = [figure.axes[0].get_xlim() for figure in figures]
    np.testing.assert_allclose(limits[0], limits[1], rtol=0.05, atol=0.02)


def test_an_invisible_planar_bar_has_no_joints(tmp_path: Path) -> None:
    """A crossing of invisible bars in the plane, where nothing is fixed, is white."""
    text = f"{TRIANGLE}{BLOCKS}GRAPHICS\nOPACITY 0\n"
    figure = draw(of_text(tmp_path, text))
    assert Pixels(figure, planar=True).near((0.5, 1.0, 0.0), 12).min() == 255
    assert figure.axes[0].get_ylim()[1] > 1.0


def test_what_shines_through_is_even(tmp_path: Path) -> None:
    """No net of facets is seen in a sheet, and what is behind it is seen once."""
    sheet = "BEAM 1 1 2 3 4 0 1 0\nX 3 1 0 0\nFIX 1\nFIX 2\nRLSE 1 2 5 6\n"
    analysis = of_text(tmp_path, f"{sheet}{BLOCKS}GRAPHICS\nFACECOLOR 1 0 0\nOPACITY 0.4\n")
    pixels = Pixels(draw(analysis, phase=0.0, view=VIEW))
    places = itertools.product(np.linspace(0.2, 0.8, 200), (0.0,), np.linspace(-0.05, 0.05, 40))
    part = np.array([pixels.at(place) for place in places])
    assert np.ptp(part, axis=0).max() <= 12
    assert part[:, 1].mean() == pytest.approx(255 * 0.6 * GHOST[1], abs=3)


def test_a_block_of_ground_hides_the_ball_behind_it(tmp_path: Path) -> None:
    sheet = "BEAM 1 1 2 3 4 0 1 0\nX 3 1 0 0\nFIX 1\nFIX 2\nRLSE 1 2 5 6\n"
    analysis = of_text(tmp_path, f"{sheet}TRUSS 2 1 5\nX 5 0.1 0.6 0.6\nFIX 5\n")
    ball = 255 * np.array((0.55, 0.58, 0.62))
    seen = []
    for view, eye in (("left", (180.0, 0.0)), ("right", (0.0, 0.0))):
        pixels = Pixels(draw(analysis, view=view), eye=eye)
        near = pixels.near((0.0, 0.0, 0.0), 8)
        # The bar's soft shadow may lie on it.
        seen.append(bool(np.any(np.abs(near - ball).max(axis=1) < 6)))
    assert seen == [False, True]


def test_hinges_that_stand_nowhere_are_told(tmp_path: Path) -> None:
    text = "HINGE 1 1 2 1 0 0\nHINGE 2 2 3 0 1 0\nFIX 1\nRLSE 1 1\nRLSE 2 1\n"
    words = [text.get_text() for text in draw(of_text(tmp_path, text)).texts]
    assert any(
        line.startswith("Nothing can be placed: the hinges stand at no node") for line in words
    )


# What is shown, and from where


@pytest.mark.parametrize("name", DECKS)
def test_panels_without_a_choice(name: str, decks: Path) -> None:
    """The first motion and the first self-stress, side by side where both exist."""
    figure = draw(flexact.analyse(decks / f"{name}.dat"))
    words = " ".join(text.get_text() for text in figure.texts)
    assert ("Motion 1 of 1" in words) == (name in ("under", "both"))
    assert ("Self-stress 1 of 1" in words) == (name in ("over", "both"))
    assert ("Reference shape" in words) == (name == "exact")
    width, height = figure.get_size_inches() * figure.dpi
    assert round(width / height, 1) == (2.4 if name == "both" else 1.2)


def test_the_verdict_is_the_title() -> None:
    figure = draw(deck("paper/five_wires"))
    words = " ".join(text.get_text() for text in figure.texts)
    assert words.startswith("five_wires.dat Exactly constrained: every motion is held once")
    assert "Degree of freedom 1" in words


def test_what_is_not_there_is_told() -> None:
    analysis = deck("paper/twelve_trusses")
    with pytest.raises(BatchError, match=r"no motion 2: the analysis gives 1 motion$"):
        draw(analysis, motion=2)
    with pytest.raises(BatchError, match=r"self-stress 3: the analysis gives 1 self-stress$"):
        draw(analysis, stress=3)
    with pytest.raises(BatchError, match="no degree of freedom 1"):
        draw(analysis, freedom=1)
    with pytest.raises(
        PictureError,
        match="one of normal force, twist moment, in-plane moment, out-of-plane moment",
    ):
        draw(analysis, quantity="Q")
    with pytest.raises(PictureError, match="is of a self-stress"):
        draw(analysis, motion=1, quantity="N")
    with pytest.raises(PictureError, match="one of them"):
        picture_bytes(analysis, ".gif", motion=1, stress=1)
    with pytest.raises(PictureError, match="png, svg, pdf, gif, mp4, webm"):
        picture_bytes(analysis, ".jpg")


@pytest.mark.parametrize("view", ["side", "1", "1,2,3", "a,b", "10,95", "nan,0", "inf,0"])
def test_views_that_are_not_known(view: str) -> None:
    with pytest.raises(BatchError, match="iso, front, back, left, right, top, bottom"):
        draw(deck("paper/twelve_trusses"), view=view)


def test_named_views_look_along_the_axes() -> None:
    """Of a long bar along x, y and z, what lies along the eye is short."""
    analysis = deck("paper/twelve_trusses")
    # Extents of the nodes: 2, 2 and 1 m.
    expected = {
        "front": 2.0 / 1.0,
        "back": 2.0 / 1.0,
        "left": 2.0 / 1.0,
        "right": 2.0 / 1.0,
        "top": 2.0 / 2.0,
        "bottom": 2.0 / 2.0,
    }
    from flexact.show.drawing.view import view_of

    drawing = drawing_of(analysis.given)
    for name, quotient in expected.items():
        view = view_of(name, drawing)
        np.testing.assert_allclose(view.axes @ view.axes.T, np.eye(3), atol=1e-15)
        assert np.linalg.det(view.axes) == pytest.approx(1.0)
        flat = view.project(drawing.reference.position)
        across, up = np.ptp(flat[:, 0]), np.ptp(flat[:, 1])
        assert across / up == pytest.approx(quotient)
    for first, second in itertools.pairwise(("front", "back")):
        x = [
            view_of(name, drawing).project(np.array([1.0, 0.0, 0.0]))[0] for name in (first, second)
        ]
        assert x == pytest.approx([1.0, -1.0])


def test_the_view_that_is_chosen_shows_sheets_from_no_edge() -> None:
    """Two sheets at right angles, one of them edge-on from any side along the axes."""
    from flexact.show.drawing.view import view_of

    for name in ("paper/folded_sheet_clamped", "paper/six_folded_sheets", "flexures/cross_hinge"):
        drawing = drawing_of(deck(name).given)
        towards = view_of(None, drawing).axes[2]
        sheets = drawing.members.frame[drawing.members.form == 1]
        facing = np.abs(
            np.max(np.abs(np.stack([sheets[..., 1] @ towards, sheets[..., 2] @ towards])), axis=0)
        )
        assert facing.mean() > 0.3


def test_plain_pictures_have_no_words() -> None:
    analysis = deck("paper/twelve_trusses")
    figure = draw(analysis, size=(240, 180), plain=True)
    assert figure.texts == []
    assert (figure.get_size_inches() * figure.dpi).tolist() == [240, 180]
    assert Pixels(figure).rgb.min() < 120


def test_a_spatial_bar_swings(tmp_path: Path) -> None:
    """Its free end moves along y, the only direction that is neither fixed nor held."""
    analysis = of_text(tmp_path, SWINGING)
    pixels = Pixels(draw(analysis, motion=1, view=VIEW))
    end = 0.1 * np.sign(analysis.motions[0].displacement[1, 1])
    moved, rest = pixels.at((0.0, 0.5 * end, 0.5)), pixels.at((0.0, 0.02 * end, 0.5))
    assert abs(int(moved[0]) - int(moved[2])) > 10
    np.testing.assert_allclose(rest, 255 * GHOST, atol=4)
