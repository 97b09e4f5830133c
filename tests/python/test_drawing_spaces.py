# SPDX-License-Identifier: BSD-3-Clause
"""Freedom and constraint spaces as they are drawn: all that is drawn belongs to the space."""

import re
from collections.abc import Iterator

import numpy as np
import pytest
from browser import Browser
from known_models import twelve_trusses
from reference_decks import ROOT

import flexact
from flexact.advice.spaces.screws import Family, FamilyKind, ScrewSpace
from flexact.advice.spaces.spaces import Spaces, spaces_of
from flexact.show.page import page
from flexact.show.picture import PictureError, draw, has_packages, picture_bytes
from flexact.show.spaces import MADE_BY, SpaceShape, dashes, shape_of_space

pytestmark = pytest.mark.dear(13)

DECKS = ROOT / "input_decks"
#: With translations and parallel lines, lines that meet one, a screw, one direction.
NAMES = (
    "paper/five_folded_sheets_symmetric",
    "paper/folded_sheet_free",
    "linkages/bennett",
    "flexures/parallel_guide",
    "flexures/cross_hinge",
)
NEEDS_PICTURES = pytest.mark.skipif(not has_packages(), reason="needs matplotlib")


def spaces_in(name: str) -> tuple[flexact.Analysis, Spaces]:
    analysis = flexact.analyse(DECKS / f"{name}.dat")
    found = spaces_of(analysis)
    assert found is not None
    return analysis, found


def test_every_kind_of_family_is_drawn() -> None:
    assert set(MADE_BY) == {kind.name for kind in FamilyKind}


X, Y, Z = np.eye(3)
HERE = np.zeros(3)
#: Wires along lines, by a point and a direction, that have textbook families together with all
#: that they leave free (Hopkins and Culpepper, Precision Engineering, 2010, the cases of 1 to 6).
WIRES = {
    "one": [(Z, X)],
    "crossed": [(HERE, X), (HERE, Y)],
    "parallel": [(HERE, X), (Y, X)],
    "skew": [(HERE, X), (Z, Y)],
    "a plane": [(HERE, X), (HERE, Y), (X, Y)],
    "a bundle": [(X, X), (X, Y), (X, Z)],
    "all parallel": [(HERE, Z), (X, Z), (Y, Z)],
    "a regulus": [(HERE, X), (Z, Y), (2 * Z, X - Y)],
    "four": [(HERE, X), (HERE, Y), (Z, X), (X + Z, Y)],
    "four and skew": [(HERE, X), (Z, Y), (2 * Z, X - Y), (X, Y + Z)],
    "five and skew": [(HERE, X), (Z, Y), (2 * Z, X - Y), (X, Y + Z), (Y, X + 2 * Z)],
}


def _spanned(lines: list[tuple[np.ndarray, np.ndarray]]) -> ScrewSpace:
    """The forces along some lines."""
    about, one = np.array([0.3, 0.2, 0.1]), ScrewSpace(np.zeros((0, 6)), np.zeros(3), 1.0)
    rows = [one.line(point - about, way) for point, way in lines]
    return ScrewSpace(np.linalg.svd(np.array(rows))[2][: len(rows)], about, 1.0, of_wrenches=True)


@pytest.mark.parametrize("name", WIRES)
def test_what_is_drawn_of_wires_is_in_their_space(name: str) -> None:
    held = _spanned(WIRES[name])
    for space in (held, held.reciprocal):
        shape = shape_of_space(space.families, space.about, 1.0, is_freedom=not space.of_wrenches)
        screws = list(_screws(space, shape))
        assert screws or all(family.kind is FamilyKind.SCREW for family in space.families)
        for one, screw in screws:
            assert space.has(screw, 1e-6), one


def test_what_is_drawn_of_a_mechanism_is_in_its_spaces() -> None:
    """Straight lines are rotations or forces of the space, arrows translations or couples of it."""
    for name in NAMES:
        _, spaces = spaces_in(name)
        for space in (spaces.freedom, spaces.constraint):
            shape = shape_of_space(space.families, space.about, space.length, is_freedom=True)
            for one, screw in _screws(space, shape):
                assert space.has(screw, 1e-6), (name, one)


def _screws(space: ScrewSpace, shape: SpaceShape) -> Iterator[tuple[str, np.ndarray]]:
    # Helices have many points, and their axes belong to the screws that are told by their pitch.
    axes = {
        tuple(np.round(np.abs(family.direction), 6))
        for family in space.families
        if family.kind is FamilyKind.SCREW
    }
    for line in shape.lines:
        way = (line[-1] - line[0]) / np.linalg.norm(line[-1] - line[0])
        if len(line) == 2 and tuple(np.round(np.abs(way), 6)) not in axes:
            yield "line", space.line(line[0], way)
    for start, end in shape.arrows:
        yield "arrow", space.free(end - start)


FULL = Family(FamilyKind.PENCIL, np.array([1.0, 2.0, 3.0]), normal=np.array([0.0, 0.6, 0.8]))


def test_a_pencil_is_a_disc_with_lines_through_its_point() -> None:
    shape = shape_of_space([FULL], np.zeros(3), 2.0, is_freedom=False)
    (disc,) = shape.faces
    assert np.allclose((disc - FULL.point) @ FULL.normal, 0, atol=1e-12)
    assert np.ptp(np.linalg.norm(disc - FULL.point, axis=1)) < 1e-12
    assert len(shape.lines) == 8
    for line in shape.lines:
        assert np.allclose(line.mean(axis=0), FULL.point)
        assert np.allclose((line - FULL.point) @ FULL.normal, 0, atol=1e-12)


@pytest.mark.parametrize("pitch", [0.02, -0.02, 1.0])
def test_a_helix_has_the_pitch_and_the_sense_of_the_screw(pitch: float) -> None:
    """With a positive pitch [m/rad] it turns about the axis by the right hand while it goes on."""
    axis = np.array([0.0, 0.0, 1.0])
    screw = Family(FamilyKind.SCREW, np.zeros(3), axis, pitch=pitch)
    _, helix = shape_of_space([screw], np.zeros(3), 1.0, is_freedom=True).lines
    angle = np.unwrap(np.arctan2(helix[:, 1], helix[:, 0]))
    assert (helix[-1, 2] - helix[0, 2]) / (angle[-1] - angle[0]) == pytest.approx(pitch, rel=1e-6)


def test_sizes_follow_the_drawing() -> None:
    for kind in FamilyKind:
        family = Family(
            kind,
            direction=np.array([0.0, 0.6, 0.8]),
            normal=np.array([1.0, 0.0, 0.0]),
            points=np.array([[0.0, 0.0, 0.1], [0.1, 0.0, 0.0]]),
            directions=np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]),
        )
        one = shape_of_space([family], np.zeros(3), 1.0, is_freedom=True)
        every = [*one.lines, *one.faces, *one.arrows]
        assert every and all(np.isfinite(each).all() for each in every)
        assert 0.2 < max(np.linalg.norm(each, axis=1).max() for each in every) < 1.0, kind


def test_in_the_plane_rotations_are_rings_about_their_poles() -> None:
    analysis, spaces = spaces_in("flexures/planar_cross_hinge")
    assert analysis.given.planar
    shape = shape_of_space(
        spaces.freedom.families, spaces.freedom.about, 1.0, is_freedom=True, planar=True
    )
    (ring,) = shape.lines
    assert np.ptp(ring[:, 2]) == 0.0 and np.ptp(ring[:, :2], axis=0).min() > 0.03
    pole = spaces.freedom.line(ring[:-1].mean(axis=0), Z)
    assert spaces.freedom.has(pole, 1e-6)


def test_dashes_begin_and_end_with_the_wire() -> None:
    wire = np.array([[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]])
    made = dashes(wire, 1.0)[..., 0]
    assert len(made) > 10 and made[0, 0] == 0.0 and made[-1, 1] == pytest.approx(1.0)
    assert (np.diff(made.ravel()) > 0).all()


@NEEDS_PICTURES
@pytest.mark.parametrize("suffix", [".png", ".svg"])
def test_pictures_show_both_spaces(suffix: str) -> None:
    analysis, spaces = spaces_in("paper/folded_sheet_free")
    content = picture_bytes(analysis, suffix, spaces=spaces)
    assert content != picture_bytes(analysis, suffix)
    if suffix == ".svg":
        words = re.sub(r"\s+", " ", content.decode())
        assert "Freedom space of the far end" in words and "dashed" in words


@NEEDS_PICTURES
def test_both_panels_have_one_scale_and_the_colours_of_the_literature() -> None:
    analysis, spaces = spaces_in("paper/folded_sheet_free")
    figure = draw(analysis, spaces=spaces)
    axes = [each for each in figure.axes if each.get_xlim() != (-2, 2)]
    widths = [np.ptp(each.get_xlim()) for each in axes]
    assert widths[0] == pytest.approx(widths[1])
    pixels = np.asarray(_shown(figure))[..., :3].astype(int)
    middle = pixels.shape[1] // 2
    red, _, blue = np.moveaxis(pixels, -1, 0)
    assert (red > blue + 90)[:, :middle].sum() > 500 > (blue > red + 110)[:, :middle].sum()
    assert (blue > red + 110)[:, middle:].sum() > 100


def _shown(figure: object) -> object:
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    canvas = FigureCanvasAgg(figure)  # type: ignore[arg-type]
    canvas.draw()
    return canvas.buffer_rgba()


def test_spaces_do_not_move_and_stand_alone() -> None:
    analysis, spaces = spaces_in("paper/folded_sheet_free")
    with pytest.raises(PictureError, match="not both"):
        draw(analysis, spaces=spaces, motion=1)
    with pytest.raises(TypeError, match="spaces are those of a body"):
        draw(analysis, spaces=analysis)  # type: ignore[arg-type]
    if has_packages():
        with pytest.raises(PictureError, match="do not move"):
            picture_bytes(analysis, ".gif", spaces=spaces)


def test_the_page_switches_spaces_on_and_off(browser: Browser, tmp_path: object) -> None:
    analysis, spaces = spaces_in("paper/five_folded_sheets_symmetric")
    path = tmp_path / "page.html"  # type: ignore[operator]
    path.write_text(page(analysis, spaces=spaces), encoding="utf-8")
    browser.open(path)
    browser.run("flexact.play(false)")
    browser.press('[name="movement"][value=""]')
    none = browser.pixels()
    seen = []
    for number, word in enumerate(("Freedom", "Constraint")):
        browser.press(f'[name="space"][value="{number}"]')
        seen.append(browser.pixels())
        assert browser.run("return flexact.part('shown').innerText").startswith(f"{word} of the")
        assert np.count_nonzero(np.abs(seen[-1].astype(int) - none).max(axis=2) > 24) > 2000
    assert np.count_nonzero((seen[0] != seen[1]).any(axis=2)) > 2000
    browser.press('[name="space"][value=""]')
    assert np.count_nonzero(np.abs(browser.pixels().astype(int) - none).max(axis=2) > 24) == 0
    assert browser.console() == []


def test_without_spaces_the_page_offers_none() -> None:
    text = page(flexact.analyse(twelve_trusses()))
    assert 'data-choice="movement"' in text and 'data-choice="space"' not in text
