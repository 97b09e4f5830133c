# SPDX-License-Identifier: BSD-3-Clause
"""The page of a cost: charts that scale and do not overlap, shapes that play side by side."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from browser import Browser
from cost_values import made_up_cost, without_stroke
from test_page import Elements

from flexact.costs.page import page_bytes
from flexact.show.drawing import drawing_of, swing

pytestmark = pytest.mark.dear(3)

Keys = pytest.importorskip("selenium.webdriver").Keys
#: Words of the charts that lie over each other, by their boxes as drawn.
OVERLAPS = """
    return Array.from(document.querySelectorAll('svg')).flatMap((svg) => {
      const found = Array.from(svg.querySelectorAll('text'),
        (e) => [e.textContent, e.getBoundingClientRect()]);
      const across = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left);
      const up = (a, b) => Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
      return found.flatMap(([one, a], k) => found.slice(k + 1)
        .filter(([, b]) => across(a, b) > 1 && up(a, b) > 4).map(([two]) => [one, two]));
    })
"""
#: Words of the charts beyond the section that holds them.
BEYOND = """
    const {right, left} = document.querySelector('#charts').getBoundingClientRect();
    return Array.from(document.querySelectorAll('svg text')).filter((e) => {
      const box = e.getBoundingClientRect();
      return box.right > right + 1 || box.left < left - 1;
    }).map((e) => e.textContent)
"""


@pytest.fixture(scope="module")
def text() -> str:
    return page_bytes(made_up_cost()).decode()


@pytest.fixture(scope="module")
def path(text: str, tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("cost") / "cost.html"
    made.write_text(text, encoding="utf-8")
    return made


@pytest.fixture
def shown(path: Path, browser: Browser) -> Browser:
    """The page, opened once for the tests that follow each other."""
    if browser.driver.current_url != path.as_uri():
        browser.open(path)
        asked = [each for each in browser.requests() if not each.startswith("data:")]
        assert asked == [path.as_uri()]
    return browser


def test_charts_are_whole_and_hold_no_nan(text: str) -> None:
    charts = re.findall(r"<svg.*?</svg>", text, re.DOTALL)
    assert len(charts) == 5
    for chart in charts:
        root = ElementTree.fromstring(chart)
        numbers = " ".join(v for e in root.iter() for k, v in e.items() if k != "aria-label")
        assert not re.search(r"nan|inf\b", numbers.lower())
        assert root.get("role") == "img" and len(root.get("aria-label", "")) > 40
        assert "style" not in {key for each in root.iter() for key in each.attrib}


def test_names_are_unique_and_nothing_is_asked_for(text: str) -> None:
    elements = Elements(text)
    names = [attributes["id"] for _, attributes in elements.tags if "id" in attributes]
    assert len(names) == len(set(names))
    for tag, attributes in elements.tags:
        for name in ("src", "href"):
            assert (attributes.get(name) or "#").startswith(("data:", "#")), tag


def test_the_headline_comes_first_and_the_designs_below(shown: Browser) -> None:
    assert shown.run("return document.querySelector('h1').innerText").startswith(
        "It costs: clamp 11 off by 57"
    )
    rows = shown.run(
        "return Array.from(document.querySelectorAll('table.designs tbody tr'), e => e.innerText)"
    )
    assert len(rows) == 3 and rows[1].startswith("21:2") and "any error" in rows[1]


@pytest.mark.parametrize("width", [360, 800, 1280])
def test_nothing_overlaps_or_runs_out_whatever_the_width(width: int, shown: Browser) -> None:
    shown.resize(width, 900)
    assert shown.run(OVERLAPS) == []
    assert shown.run(BEYOND) == []
    wide = "return document.documentElement.scrollWidth <= document.documentElement.clientWidth"
    assert shown.run(wide)


def test_light_and_dark_have_colours_of_their_own(shown: Browser) -> None:
    stroke = "return getComputedStyle(document.querySelector('.s1.curve')).stroke"
    shown.prefer(prefers_color_scheme="light")
    light = shown.run(stroke)
    shown.prefer(prefers_color_scheme="dark")
    assert shown.run(stroke) != light
    shown.press("#theme")
    assert shown.run(stroke) == light
    shown.press("#theme")


def test_the_design_as_built_buckles_beside_the_released_one_that_vibrates(
    shown: Browser,
) -> None:
    captions = shown.run("return drawings.map(d => d.part('shown').textContent)")
    assert captions[0].startswith("Buckles at clamp 11 off by 0.133 mm along x.")
    assert captions[1].startswith("First parasitic frequency, 403 Hz.")
    assert all("only the ratios matter" in each for each in captions)
    chips = (
        "return drawings.map(d => Array.from(d.root.querySelectorAll('.chip'), e => e.innerText))"
    )
    assert shown.run(chips) == [
        ["None", "9.92 Hz", "403 Hz", "133 µm"],
        ["None", "9.92 Hz", "403 Hz"],
    ]


def test_shapes_play_and_turn_together_by_keys_with_a_clean_console(shown: Browser) -> None:
    shown.resize(1280, 900)
    shown.run("document.querySelector('.canvas').focus()")
    before = shown.run("return drawings.map(d => d.player.playing)")
    shown.keys(" ")
    assert shown.run("return drawings.map(d => d.player.playing)") == [not p for p in before]
    shown.run("drawings.forEach(d => d.play(false))")
    look = "return drawings.map(d => d.stage.camera.position.toArray())"
    first = shown.run(look)
    shown.keys(Keys.ARROW_LEFT)
    turned = shown.run(look)
    assert np.abs(np.subtract(turned, first)).max() > 1e-3
    assert turned[0] == pytest.approx(turned[1])
    assert shown.console() == []


def test_without_shapes_there_are_charts_alone(browser: Browser, tmp_path: Path) -> None:
    cost = without_stroke(made_up_cost())
    bare = replace(cost, designs=tuple(replace(each, shapes=()) for each in cost.designs))
    target = tmp_path / "bare.html"
    target.write_bytes(page_bytes(bare))
    browser.open(target)
    assert browser.run("return document.querySelectorAll('svg').length") == 3
    assert browser.run("return document.querySelectorAll('.viewer').length") == 0
    assert browser.console() == []


def test_a_shape_is_a_tenth_of_the_size_and_keeps_bodies_rigid() -> None:
    """The cylinder turning about its axis: links of the body keep their length to second order."""
    shape = made_up_cost().as_built.shapes[0]
    drawing = drawing_of(shape.data)
    movement = swing(drawing, shape.configuration, shape.displacement)
    far = np.linalg.norm(movement.poses[-1].position - drawing.reference.position, axis=1).max()
    assert far == pytest.approx(0.1 * drawing.size, rel=0.02)
    assert np.array_equal(movement.poses[2].position, drawing.reference.position)
    for solid in drawing.solids:
        nodes = drawing.members.nodes[solid.rows][:, [0, 2]]
        start, end = (p.position[nodes] for p in (drawing.reference, movement.poses[-1]))
        lengths = [np.linalg.norm(each[:, 1] - each[:, 0], axis=1) for each in (start, end)]
        assert lengths[1] == pytest.approx(lengths[0], rel=1e-9)
