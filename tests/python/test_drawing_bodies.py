# SPDX-License-Identifier: BSD-3-Clause
"""Rigid bodies as solids: where they are, how they move, and when links are drawn instead."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from browser import Browser
from pictures import VIEW, Pixels

import flexact
from flexact.core.elements import NodeKind
from flexact.model.parts.forms import Form
from flexact.show.drawing import QUANTITIES, drawing_of, move, resultants, stations
from flexact.show.mesh import to_meshio
from flexact.show.picture import draw


def guide(beams: int = 1, section: tuple[float, float] | None = None) -> flexact.Model:
    """Two sheets along x with widths along z carry a stage along y."""
    model = flexact.Model(name="guide")
    ground = [model.node(0.0, y, 0.0) for y in (0.0, 0.05)]
    stage = [model.node(0.1, y, 0.0) for y in (0.0, 0.05)]
    for k in (0, 1):
        model.fix(ground[k])
        sheet = {"width": (0, 0, 1), "name": f"sheet {k + 1}", "beams": beams}
        model.sheet(ground[k], stage[k], **sheet)
    model.body(stage, name="stage", section=section)
    return model


def platform() -> flexact.Model:
    """Four points of a body on three wires: a tetrahedron."""
    model = flexact.Model(name="platform")
    corners = [(0.0, 0.0, 0.0), (0.1, 0.0, 0.0), (0.0, 0.1, 0.0), (0.0, 0.0, 0.1)]
    points = [model.node(*corner) for corner in corners]
    model.body(points, name="platform")
    for point, place in zip(points, [(-0.1, 0, 0), (0.2, 0, 0), (0, 0.2, 0)], strict=False):
        away = model.node(*place)
        model.fix(away)
        model.wire(away, point)
    return model


def test_a_stage_is_a_block_as_wide_as_its_sheets() -> None:
    """Its edges: thickness 0.034 of the size; 0.05 and the sheets' width, with the thickness."""
    drawing = drawing_of(guide().data)
    (solid,) = drawing.solids
    thick = 0.034 * np.hypot(0.1, 0.05)
    width = drawing.members.section[drawing.members.form == Form.SHEET].max()
    expected = np.array([thick, 0.05 + thick, width + thick])
    np.testing.assert_allclose(np.ptp(solid.corners, axis=0), expected, rtol=1e-12)
    assert len(solid.hull.normal) == 6
    np.testing.assert_allclose(solid.corners.mean(axis=0), [0.1, 0.025, 0.0], atol=1e-12)
    assert drawing.in_solid.tolist() == [False, False, True]


@pytest.mark.parametrize("make", [guide, platform])
def test_a_solid_moves_with_its_points_and_keeps_its_shape(make: type) -> None:
    analysis = flexact.analyse(make())
    drawing = drawing_of(analysis.given)
    (solid,) = drawing.solids
    for motion in analysis.motions:
        for pose in move(drawing, motion).poses:
            corners, _ = solid.placed(drawing.members, drawing.reference, pose)
            sides = [np.linalg.norm(c[:, None] - c, axis=-1) for c in (corners, solid.corners)]
            np.testing.assert_allclose(*sides, atol=1e-9)
            for strip in stations(drawing.members, pose, chosen=drawing.in_solid):
                # The middle of the box round each point is the point.
                for ends in strip.centre[:, [0, -1]]:
                    middles = corners.reshape(-1, 8, 3).mean(axis=1)
                    near = np.linalg.norm(middles[:, None] - ends, axis=-1).min(axis=0)
                    assert near.max() < 1e-9


def test_links_with_sections_are_drawn_as_they_are() -> None:
    drawing = drawing_of(guide(section=(0.01, 0.02)).data)
    assert drawing.solids == [] and drawing.seen.all()


def test_a_bar_alone_and_what_is_not_drawn_are_no_solids() -> None:
    text = "BEAM 1 1 2 3 4\nBEAM 2 3 5 6 7\nX 3 1 0 0\nX 6 1 1 0\nFIX 1\nFIX 2\nRLSE 2\n"
    assert drawing_of(flexact.read_text(text).data).solids == []
    hidden = guide()
    hidden.look(*hidden.element_numbers[-1:].tolist(), drawn=False)
    assert drawing_of(hidden.data).solids == []


def test_a_frame_round_other_parts_is_drawn_as_its_links() -> None:
    """A sheet runs through the middle of the hull of a frame: nobody would see it."""
    model = flexact.Model(name="frame")
    corners = [(0.0, 0.0, 0.0), (0.2, 0.0, 0.0), (0.2, 0.2, 0.0), (0.0, 0.2, 0.0)]
    frame = [model.node(*corner) for corner in corners]
    model.body(frame, name="frame")
    assert len(drawing_of(model.data).solids) == 1
    one, other = model.node(0.05, 0.1, 0.0), model.node(0.15, 0.1, 0.0)
    model.sheet(one, other, width=(0, 0, 1))
    model.fix(one)
    assert drawing_of(model.data).solids == []


def test_a_planar_body_is_a_polygon() -> None:
    model = flexact.Model(planar=True, name="plate")
    points = [model.node(*place) for place in ((0.0, 0.0), (0.1, 0.0), (0.0, 0.1))]
    model.body(points, name="plate")
    (solid,) = drawing_of(model.data).solids
    ring = solid.corners[solid.outline]
    x, y = ring[:, 0], ring[:, 1]
    area = float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
    # The triangle and a square of side t moved round it.
    t = 0.034 * np.hypot(0.1, 0.1)
    assert area == pytest.approx(0.005 + 0.1 * t + 0.1 * t + t * t, rel=1e-9)
    assert not solid.corners[:, 2].any()


def test_the_picture_shows_the_solid_where_it_is() -> None:
    """Upper corner of the face towards the eye, where no link is: grey as rigid members are."""
    analysis = flexact.analyse(guide())
    drawing = drawing_of(analysis.given)
    (solid,) = drawing.solids
    pixels = Pixels(draw(analysis, stress=1, view=VIEW))
    high = solid.corners.max(axis=0)
    inside = np.array([high[0], 0.01, 0.8 * high[2]])
    red, green, blue = pixels.at(inside)
    assert max(red, green, blue) < 200 and np.ptp([red, green, blue]) < 25
    assert min(pixels.at(np.add(inside, (0.0, 0.0, 3.0 * high[2])))) == 255


def test_a_mesh_has_the_solid_as_the_surface_of_its_first_link() -> None:
    """It moves rigidly: displacement is that of one point plus the rotation times the arm."""
    analysis = flexact.analyse(platform())
    mesh = to_meshio(analysis)
    quads = mesh.cells[-1].data
    number = analysis.model.element_numbers[0]
    mine = np.unique(quads[mesh.cell_data["element"][-1] == number])
    low, high = mesh.points[mine].min(axis=0), mesh.points[mine].max(axis=0)
    assert np.all(low < 0.0) and np.all(high > 0.1)
    others = set(mesh.cell_data["element"][-1].tolist())
    assert not others & set(analysis.model.element_numbers[1:3].tolist())
    motion, turned = (mesh.point_data[f"motion_1{end}"][mine] for end in ("", "_rotation"))
    about = motion - np.cross(turned[0], mesh.points[mine])
    np.testing.assert_allclose(about, np.broadcast_to(about[0], about.shape), atol=1e-12)
    for name, values in mesh.point_data.items():
        assert not name.startswith("selfstress") or not values[mine].any()


def test_a_page_names_the_body_that_is_pointed_at(browser: Browser, tmp_path: Path) -> None:
    path = tmp_path / "guide.dat"
    path.write_text(guide().to_deck(), encoding="utf-8")
    analysis = browser.show(path, tmp_path)
    drawing = drawing_of(analysis.given)
    (solid,) = drawing.solids
    browser.press('[name="movement"][value=""]')
    high = solid.corners.max(axis=0)
    place = ((np.array([high[0], 0.01, 0.8 * high[2]]) - drawing.centre) / drawing.size).tolist()
    browser.press('button[data-view="right"]')
    found = browser.run(
        "const [x, y] = flexact.stage.project(...arguments[0]);"
        "const found = flexact.pointing.look(x, y);"
        "return [found, flexact.describe(found), flexact.targetOf(found)]",
        place,
    )
    assert found[0]["kind"] == "body"
    assert found[1] == ["stage", "rigid body"]
    assert found[2] == {"element": 3}
    corners = browser.run("return Array.from(flexact.bodies.corner.array)")
    expected = (solid.corners - drawing.centre) / drawing.size
    np.testing.assert_allclose(np.reshape(corners, (-1, 3)), expected, atol=1e-6)
    before = browser.pixels()
    browser.run("flexact.mark({element: 3})")
    browser.drawn()
    assert (before != browser.pixels()).any(axis=-1).sum() > 1000
    assert browser.console() == []


@pytest.mark.parametrize("wave", [0.0, 1e-12, 1e-3])
def test_a_divided_sheet_is_drawn_as_one(wave: float) -> None:
    """One width; edges at its ends alone; the moment goes on from beam to beam."""
    data = guide(beams=4).data
    value = data.arrays.node_value.copy(order="F")
    inner = (data.arrays.node_kind == NodeKind.POSITION) & (value[0] % 0.1 > 1e-6)
    value[1, inner] += wave * np.sin(40.0 * np.pi * value[0, inner])
    data = replace(data, arrays=data.arrays._replace(node_value=value), source=None, found=None)
    analysis = flexact.analyse(flexact.Model.from_data(data))
    drawing = drawing_of(analysis.given)
    sheets = drawing.members.form == Form.SHEET
    widths = drawing.members.section[sheets].max(axis=1)
    assert np.ptp(widths) < 1e-3 * widths[0]
    assert widths[0] == pytest.approx(drawing_of(guide().data).members.section[0].max(), rel=0.02)
    row = drawing.members.joined[:4]
    assert row.tolist() == [[False, True], [True, True], [True, True], [True, False]]
    moment = resultants(drawing, analysis.self_stresses[0])["in-plane moment"]
    for first in (0, 4):
        mine = moment[first : first + 4]
        np.testing.assert_allclose(mine, mine[0, 0], rtol=1e-2 if wave > 1e-6 else 1e-9)
    assert moment[0, 0] == pytest.approx(-moment[4, 0], rel=1e-9)


def test_a_body_that_is_a_solid_offers_no_stress_of_its_links() -> None:
    """Its twist is as large as the moments of the sheets, and nobody could see it."""
    analysis = flexact.analyse(guide())
    stress = analysis.self_stresses[0]
    as_solid = resultants(drawing_of(analysis.given), stress)
    assert [name for name in QUANTITIES if as_solid.largest(name)] == ["in-plane moment"]
    links = flexact.analyse(guide(section=(0.01, 0.02)))
    as_links = resultants(drawing_of(links.given), links.self_stresses[0])
    assert as_links.largest("twist moment") == pytest.approx(as_links.largest("in-plane moment"))
