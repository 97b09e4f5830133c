# SPDX-License-Identifier: BSD-3-Clause
"""Rigid bodies as solids: where they are, how they move, and when links are drawn instead.

And what a drawing shows of a first view, of what parts press on bodies, and of repaired sheets.
"""

import runpy
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
from flexact.show.drawing.bodies import Hull, solid_of
from flexact.show.drawing.members import Members
from flexact.show.drawing.presses import presses_of
from flexact.show.drawing.view import view_of
from flexact.show.mesh import to_meshio
from flexact.show.picture import draw

GALLERY = Path(__file__).resolve().parents[2] / "docs" / "gallery"


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
    # Six flat faces, and round edges between them.
    for face in np.concatenate((np.eye(3), -np.eye(3))):
        assert np.any(solid.hull.normal @ face > 1.0 - 1e-9)
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
            # The ends of its links are as far from its corners as ever.
            for strips in zip(
                *(
                    stations(drawing.members, each, chosen=drawing.in_solid)
                    for each in (drawing.reference, pose)
                ),
                strict=True,
            ):
                before, after = (strip.centre[:, [0, -1]].reshape(-1, 1, 3) for strip in strips)
                far = [
                    np.linalg.norm(ends - each, axis=-1)
                    for ends, each in ((before, solid.corners), (after, corners))
                ]
                np.testing.assert_allclose(*far, atol=1e-9)


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
    # The triangle and a disc of diameter t moved round it, of which polygons show a little less.
    t = 0.034 * np.hypot(0.1, 0.1)
    around = 0.2 + np.hypot(0.1, 0.1)
    assert area == pytest.approx(0.005 + around * t / 2 + np.pi * (t / 2) ** 2, rel=1e-3)
    assert area < 0.005 + around * t / 2 + np.pi * (t / 2) ** 2
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
    assert found[1][:2] == ["stage", "rigid body"]
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


SQUARE = np.array([(0.0, 0.0, 0.0), (0.1, 0.0, 0.0), (0.1, 0.1, 0.0), (0.0, 0.1, 0.0)])


def depth_in(corners: np.ndarray, hull: Hull, points: np.ndarray) -> np.ndarray:
    """(n,) how deep points lie within a convex solid; negative outside."""
    top = (corners @ hull.normal.T).max(axis=0)
    return (top - points @ hull.normal.T).min(axis=1)


@pytest.mark.parametrize("count", [2, 3, 4])
@pytest.mark.parametrize("off", [0.0, 2e-4])
def test_few_points_are_a_plate_with_round_edges(count: int, off: float) -> None:
    """Flat or nearly so: as thick as is asked for, all points inside, two large faces."""
    points = SQUARE[:count].copy()
    points[-1, 2] += off
    made = solid_of(points, least=0.01)
    assert made is not None
    corners, normals, hull = made
    assert np.all(depth_in(corners, hull, points) > 0.004)
    low, high = corners.min(axis=0), corners.max(axis=0)
    np.testing.assert_allclose(high - low, np.ptp(points, axis=0) + 0.01, atol=2 * off + 1e-4)
    # Flat faces are flat, and normals point outwards.
    assert np.all(np.sum((corners - corners.mean(axis=0)) * normals, axis=1) > 0.0)
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1.0, rtol=1e-12)
    a, b, c = np.moveaxis(corners[hull.triangles], 1, 0)
    way = np.cross(b - a, c - a)
    area = np.bincount(hull.face, np.linalg.norm(way, axis=1) / 2)
    # The convex surface is closed, and what it holds is nearly the block round it.
    np.testing.assert_allclose(way.sum(axis=0), 0.0, atol=1e-12)
    volume = np.sum(np.cross(a, b) * c) / 6
    assert count != 4 or 0.93 < volume / np.prod(high - low) < 1.0
    assert count == 2 or np.sort(area)[-2:].sum() > 0.55 * area.sum()


@pytest.mark.parametrize("shape", ["disc", "box", "hull"])
def test_a_shape_that_is_wished_is_drawn(shape: str) -> None:
    """Of a right triangle: the disc about the middle of its box, its box, itself."""
    points = SQUARE[:3]
    made = solid_of(points, shape, 0.004, least=0.01)
    assert made is not None
    corners, _, hull = made
    if shape == "hull":
        assert np.ptp(corners[:, 2]) == pytest.approx(0.004)
        return
    assert np.ptp(corners[:, 2]) == pytest.approx(0.004)
    assert np.all(depth_in(corners, hull, points) > 0.0)
    middle = points.max(axis=0) / 2 + points.min(axis=0) / 2
    far = np.linalg.norm(corners[:, :2] - middle[:2], axis=1)
    radius = np.hypot(0.05, 0.05) + 0.005
    if shape == "disc":
        assert far.max() == pytest.approx(radius) and far.min() > 0.97 * radius
    else:
        np.testing.assert_allclose(np.ptp(corners, axis=0), [0.11, 0.11, 0.004], rtol=1e-9)


def test_points_in_space_are_their_hull() -> None:
    """A tetrahedron fills a sixth of the cube round it: four faces, moved outwards by 5 mm."""
    points = np.array([(0.0, 0.0, 0.0), (0.1, 0.0, 0.0), (0.0, 0.1, 0.0), (0.0, 0.0, 0.1)])
    made = solid_of(points, least=0.01)
    assert made is not None
    corners, _, hull = made
    for normal in np.vstack((-np.eye(3), np.full((1, 3), 3**-0.5))):
        assert np.any(hull.normal @ normal > 1.0 - 1e-9)
        assert (corners @ normal).max() == pytest.approx((points @ normal).max() + 0.005)
    assert solid_of(points[:1], least=0.0) is None


def gallery(name: str) -> flexact.Analysis:
    return flexact.analyse(runpy.run_path(str(GALLERY / f"{name}.py"))["model"])


@pytest.mark.parametrize(
    "name", ["folded_xy_theta_stage", "parallel_guide", "double_parallelogram", "notch_four_bar"]
)
def test_flat_mechanisms_are_seen_from_35_degrees_above_their_plane(name: str) -> None:
    """At least: their planes are xy, xy, xz and xz, as their nodes say."""
    drawing = drawing_of(gallery(name).given)
    place = drawing.data.arrays.node_value[:3, drawing.data.arrays.node_kind <= NodeKind.POSITION]
    normal = np.eye(3)[int(np.ptp(place, axis=1).argmin())]
    towards = view_of(None, drawing).axes[2]
    angle = np.degrees(np.arcsin(abs(normal @ towards)))
    assert angle >= 35.0 - 1e-9
    assert normal[2] == 0.0 or angle == pytest.approx(35.0)


def test_what_is_not_flat_keeps_its_view() -> None:
    drawing = drawing_of(gallery("straight_guide_six_folded_sheets").given)
    assert view_of(None, drawing).elevation == 25.0


@pytest.mark.parametrize("name", sorted(path.stem for path in GALLERY.glob("*.py")))
def test_arrows_on_bodies_are_what_parts_press_on_them(name: str) -> None:
    """Moved to one point they are what the self-stress says of the body, and none is in it."""
    analysis = gallery(name)
    drawing = drawing_of(analysis.given)
    nodes = drawing.members.nodes
    solids = {int(drawing.members.index[s.rows[0]]): s for s in drawing.solids}
    for stress in analysis.self_stresses:
        presses = presses_of(drawing, stress)
        lengths = {
            np.linalg.norm(press.end - press.start)
            / np.linalg.norm(press.vector)
            / (1.0 if press.is_moment else analysis.characteristic_length)
            for press in presses
        }
        # One scale for all, forces and moments.
        assert not presses or max(lengths) == pytest.approx(min(lengths), rel=1e-9)
        for press in presses:
            solid = solids.get(press.body.elements[0])
            if solid is not None:
                ends = np.stack((press.start, press.end, press.start / 2 + press.end / 2))
                assert np.all(depth_in(solid.corners, solid.hull, ends) < 1e-9)
            assert press.node in nodes[np.isin(drawing.members.index, press.body.elements)]
        for body in {press.body for press in presses}:
            for load in stress.on(body):
                if load.part is None:
                    continue
                both = np.zeros((2, 3))
                for press in presses:
                    if press.body != body or press.part != load.part:
                        continue
                    arm = drawing.reference.position[press.node] - load.wrench.about
                    both[int(press.is_moment)] += press.vector
                    both[1] += 0.0 if press.is_moment else np.cross(arm, press.vector)
                # Arrows that would be too short to be seen, by 6 % of the longest, are left out.
                longest = max(np.linalg.norm(press.end - press.start) for press in presses)
                least = 0.07 * longest / max(lengths)
                length = analysis.characteristic_length
                np.testing.assert_allclose(both[0], load.wrench.force, atol=2 * least / length)
                np.testing.assert_allclose(both[1], load.wrench.moment, atol=4 * least)


def test_a_page_shows_what_presses_with_its_self_stress(browser: Browser, tmp_path: Path) -> None:
    """The same arrows, those of moments with two heads, while they are switched on."""
    analysis = browser.show(runpy.run_path(str(GALLERY / "parallel_guide.py"))["model"], tmp_path)
    drawing = drawing_of(analysis.given)
    presses = presses_of(drawing, analysis.self_stresses[0])
    assert presses and all(press.is_moment for press in presses)
    state = "return [flexact.presses.group.visible, flexact.presses.endOn()]"
    shown, arrows = browser.run(state)
    assert shown and len(arrows) == 2 * len(presses)
    start = [(press.start - drawing.centre) / drawing.size for press in presses]
    found = np.array([arrow["at"] for arrow in arrows])
    np.testing.assert_allclose(found, np.repeat(start, 2, axis=0), atol=1e-6)
    assert "two heads" in browser.run("return flexact.part('shown').textContent")
    violet, seen = (64, 5, 97), []
    for switch in ("", '[data-layer="presses"]'):
        if switch:
            browser.press(switch)
        seen.append((np.abs(browser.pixels().astype(int) - violet).max(axis=-1) < 40).sum())
    assert seen[0] > seen[1] + 60
    assert browser.run(state)[0] is False
    assert browser.console() == []


def sheet_that_releases(*which: tuple[str, str]) -> Members:
    """A clamped sheet along x, 10 mm wide along z and 0.5 mm thick, whose far end is free."""
    model = flexact.Model(name="strip")
    ends = {"p": model.node(0.0, 0.0, 0.0), "q": model.node(0.1, 0.0, 0.0)}
    model.fix(ends["p"])
    sheet = model.sheet(*ends.values(), width=(0, 0, 1), section=(0.01, 0.0005))
    for name, end in which:
        model.release(sheet, name, **({"at": ends[end]} if end else {}))
    return drawing_of(model.data).members


def test_a_sheet_that_is_repaired_is_drawn_repaired() -> None:
    """By what it releases: a waist at the end, a wire out of the sheet, a fold."""
    at = np.linspace(0.0, 1.0, 33)
    rows = np.zeros(1, int)
    plain = sheet_that_releases()
    assert plain.profile(rows, at)[0].min() == 1.0
    bends = "in-plane bending"
    for end, near in (("p", slice(0, 16)), ("q", slice(17, 33))):
        members = sheet_that_releases((bends, end))
        scale, beside = members.profile(rows, at)
        wide = int(members.section[0].argmax())
        assert members.section[0, wide] == 0.01 and members.section[0].min() == 0.0005
        narrow = scale[0, :, wide]
        assert narrow[near].min() < 0.35 and np.delete(narrow, np.r_[near]).min() == 1.0
        assert narrow[0] == narrow[-1] == 1.0 and not beside.any()
        assert np.all(scale[0, :, 1 - wide] == 1.0)
    (wire,) = sheet_that_releases((bends, "p"), (bends, "q")).section
    assert wire.tolist() == [0.0005, 0.0005]
    folded = sheet_that_releases((bends, "p"), ("elongation", ""))
    scale, beside = folded.profile(rows, at)
    thin = int(folded.section[0].argmin())
    assert beside[0, :16, thin].max() > 0.01 and not beside[0, 17:].any() and scale.min() == 1.0


def test_a_stiff_beam_that_bends_at_one_end_has_a_notch_there() -> None:
    """All is held but one bending at p: as thick as a beam, and thin near p."""
    text = "BEAM 1 1 2 3 4 0 1 0\nX 3 1 0 0\nFIX 1\nFIX 2\nRLSE 1 3\n"
    members = drawing_of(flexact.read_text(text).data).members
    scale, _ = members.profile(np.zeros(1, int), np.linspace(0.0, 1.0, 33))
    # Deformation 3 bends in the plane xz, so that it is thin along z.
    assert scale[0, :16, 1].min() < 0.35 and scale[0, 17:].min() == 1.0
    assert scale[0, :, 0].min() == 1.0 and members.section[0, 0] == members.section[0, 1] > 0.03
