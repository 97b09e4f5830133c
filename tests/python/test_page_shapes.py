# SPDX-License-Identifier: BSD-3-Clause
"""The viewer's own shapes of members against those of `flexact.show.drawing`, in a browser."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from browser import Browser
from reference_decks import ROOT

import flexact
from flexact.core.elements import NodeKind
from flexact.show.drawing import QUANTITIES, Drawing, drawing_of, move, resultants, solid, stations
from flexact.show.drawing.selection import way_of

pytestmark = pytest.mark.dear(2)

#: Sheets, wires, bars, rigid links, hinges; in space and in the plane; on paths and on screws.
DECKS = (
    "paper/six_folded_sheets",
    "paper/five_folded_sheets_symmetric",
    "paper/five_wires",
    "paper/twelve_trusses",
    "paper/folded_sheet_free",
    "flexures/planar_parallel_guide",
    "linkages/bennett",
    "linkages/slider_crank_planar",
)


def moving(analysis: flexact.Analysis) -> list[Any]:
    """What the page can move, in its order."""
    freedoms = map(way_of, analysis.freedoms)
    return [*analysis.motions, *(motion for motion in freedoms if motion is not None)]


def corners(drawing: Drawing, pose: Any, plan: dict[str, Any]) -> np.ndarray:
    """All corners as the page orders them, in parts of the drawing's size."""
    made = np.full((plan["vertex"][-1], 3), np.nan)
    for strip in stations(drawing.members, pose, plan["segments"]):
        for count in set(plan["corners"]):
            for part in solid(strip, drawing.members, drawing.planar, max(count, 8)):
                for member, points in zip(part.member.tolist(), part.points, strict=True):
                    first, last = plan["vertex"][member : member + 2]
                    if plan["corners"][member] == count:
                        made[first:last] = points.reshape(-1, 3)
    return (made - drawing.centre) / drawing.size


def plan_of(browser: Browser) -> dict[str, Any]:
    """How many pieces bent members have, and where the corners of each member are."""
    plan: dict[str, Any] = browser.run(
        "const {segments, vertex, corners, smooth} = flexact.members.plan;"
        "return {segments, smooth, vertex: Array.from(vertex), corners: Array.from(corners)}"
    )
    return plan


@pytest.mark.parametrize("name", DECKS)
def test_the_page_draws_the_shapes_of_python(name: str, browser: Browser, tmp_path: Path) -> None:
    """At the phases that it has exactly, and between them nearly."""
    analysis = browser.show(ROOT / "input_decks" / f"{name}.dat", tmp_path)
    drawing = drawing_of(analysis.given)
    plan = plan_of(browser)
    motions = moving(analysis)
    assert browser.run("return flexact.data.movements.length") == len(motions) > 0
    for number, motion in enumerate(motions):
        movement = move(drawing, motion)
        browser.run("flexact.showMovement(arguments[0])", number)
        phases = browser.run("return flexact.movement.phases")
        assert phases == len(movement.poses)
        for phase, most in (
            *((p, 1e-5) for p in np.linspace(-1.0, 1.0, 17)[[0, 5, 8, 16]]),
            (0.93, 2e-3),
        ):
            found = browser.run(
                "flexact.movePhase(arguments[0]); return Array.from(flexact.members.shape.corner)",
                float(phase),
            )
            expected = corners(drawing, movement.pose(float(phase)), plan)
            assert np.allclose(np.reshape(found, (-1, 3)), expected, rtol=0, atol=most)


def test_hinges_turn_and_nodes_go_with_their_members(browser: Browser, tmp_path: Path) -> None:
    analysis = browser.show(ROOT / "input_decks" / "linkages" / "bennett.dat", tmp_path)
    drawing = drawing_of(analysis.given)
    pose = move(drawing, analysis.motions[0]).poses[-1]
    # In one call: it plays on.
    axis, node = (
        np.reshape(each, (-1, 3))
        for each in browser.run(
            "flexact.showMovement(0); flexact.movePhase(1);"
            "return [flexact.pose.axis, flexact.pose.position].map((each) => Array.from(each))"
        )
    )
    turned = pose.rotation[drawing.hinges.nodes[:, 1]] @ drawing.hinges.frame
    assert np.allclose(axis, turned[..., 0], rtol=0, atol=1e-5)
    placed = analysis.data.arrays.node_kind <= NodeKind.POSITION
    there = (pose.position - drawing.centre) / drawing.size
    assert np.allclose(node[placed], there[placed], rtol=0, atol=1e-5)


@pytest.mark.parametrize("name", ["paper/six_folded_sheets", "paper/five_wires"])
def test_round_members_look_round(name: str, browser: Browser, tmp_path: Path) -> None:
    """Normals point away from the axis, in a pose as well."""
    analysis = browser.show(ROOT / "input_decks" / f"{name}.dat", tmp_path)
    drawing, plan = drawing_of(analysis.given), plan_of(browser)
    movement = move(drawing, moving(analysis)[0])
    # In one call: it plays on.
    normals = browser.run(
        "flexact.showMovement(0); flexact.movePhase(0.5);"
        "return Array.from(flexact.members.shape.normal)"
    )
    found = np.reshape(normals, (-1, 3))
    strips = list(stations(drawing.members, movement.pose(0.5), plan["segments"]))
    axes = {m: c for strip in strips for m, c in zip(strip.member, strip.centre, strict=True)}
    made = corners(drawing, movement.pose(0.5), plan)
    rows = np.flatnonzero(drawing.members.round)
    assert rows.size
    for member in rows.tolist():
        first, last = plan["vertex"][member : member + 2]
        axis = (axes[member] - drawing.centre) / drawing.size
        away = made[first:last].reshape(len(axis), -1, 3) - axis[:, None]
        away /= np.linalg.norm(away, axis=2, keepdims=True)
        assert np.allclose(found[first:last], away.reshape(-1, 3), rtol=0, atol=1e-4)
    thick = drawing.members.section[rows, 0] > 0.015 * drawing.size
    assert [plan["corners"][member] for member in rows] == [24 if each else 8 for each in thick]


def test_many_round_members_are_plain(browser: Browser, tmp_path: Path) -> None:
    model = flexact.Model(name="row")
    for k in range(401):
        a, b = model.node(k, 0, 0), model.node(k, 1, 0)
        model.truss(a, b)
        model.fix(a)
    browser.show(model, tmp_path)
    plan = plan_of(browser)
    assert not plan["smooth"] and set(plan["corners"]) == {8}
    assert browser.run("return flexact.members.shape.normal.length") == 0


def test_the_page_has_the_resultants_of_python(browser: Browser, tmp_path: Path) -> None:
    analysis = browser.show(ROOT / "input_decks" / "linkages" / "bennett.dat", tmp_path)
    drawing = drawing_of(analysis.given)
    for number, stress in enumerate(analysis.self_stresses):
        expected = resultants(drawing, stress)
        for kind, values in (("members", expected.members), ("hinges", expected.hinges)):
            found = browser.run(
                "const s = flexact.data.stresses[arguments[0]][arguments[1]];"
                "return Object.fromEntries(Object.entries(s).map("
                "([q, v]) => [q, Array.from(PageData.array(v))]))",
                number,
                kind,
            )
            for column, quantity in enumerate(QUANTITIES):
                given = np.ravel(found.get(quantity, np.zeros(values[:, column].size)))
                scale = np.abs(values).max() or 1.0
                assert np.allclose(given, values[:, column].ravel(), rtol=0, atol=1e-6 * scale)
