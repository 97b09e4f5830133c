# SPDX-License-Identifier: BSD-3-Clause
"""Before and after on one page: two drawings that are seen from one side and play in step."""

import re
from base64 import b64encode
from pathlib import Path

import numpy as np
import pytest
from browser import Browser
from known_models import folded_sheet, twelve_trusses
from reference_decks import ROOT
from test_page import Elements

import flexact
from flexact.advice.describe import verdict_in_words
from flexact.analysis.naming import Named, line_of
from flexact.show.page import before_and_after

pytestmark = pytest.mark.dear(4)

Keys = pytest.importorskip("selenium.webdriver").Keys
PAPER = ROOT / "input_decks" / "paper"
CAMERAS = (
    "return drawings.map(({stage: {camera, controls}}) => [...camera.position.toArray(), "
    "...camera.quaternion.toArray(), ...controls.target.toArray(), camera.zoom])"
)


@pytest.fixture(scope="module")
def pair() -> tuple[flexact.Analysis, flexact.Analysis, str]:
    """Fig. 6 as it is, and with its lower sheets in two planes, which is exactly constrained."""
    before, after = (
        flexact.analyse(PAPER / f"{name}.dat")
        for name in ("five_folded_sheets_symmetric", "five_folded_sheets")
    )
    changed = ("turn ", Named("element", 9, "lower 180"), " by 90 degrees")
    return before, after, before_and_after(before, after, changed, [line_of("An advice.")])


@pytest.fixture(scope="module")
def path(
    pair: tuple[flexact.Analysis, flexact.Analysis, str], tmp_path_factory: pytest.TempPathFactory
) -> Path:
    made = tmp_path_factory.mktemp("pair") / "pair.html"
    made.write_text(pair[2], encoding="utf-8")
    return made


@pytest.fixture
def shown(path: Path, browser: Browser) -> Browser:
    """The page, opened once for the tests that follow each other."""
    if browser.driver.current_url != path.as_uri():
        browser.open(path)
        assert browser.requests() == [path.as_uri()]
    return browser


def test_names_are_unique_and_scripts_are_there_once(pair: tuple[object, object, str]) -> None:
    elements = Elements(pair[2])
    names = [attributes["id"] for _, attributes in elements.tags if "id" in attributes]
    assert len(names) == len(set(names))
    assert pair[2].count("/*! three.js") == 1
    for tag, attributes in elements.tags:
        for name in ("src", "href"):
            assert (attributes.get(name) or "#").startswith(("data:", "#")), tag


def test_both_verdicts_and_what_was_changed_stand_above(
    pair: tuple[flexact.Analysis, flexact.Analysis, str], shown: Browser
) -> None:
    heads = shown.run(
        "return Array.from(document.querySelectorAll('.half header'), e => e.innerText)"
    )
    for head, analysis in zip(heads, pair[:2], strict=True):
        assert str(verdict_in_words(analysis)) in " ".join(head.split())
    assert "turn lower 180 by 90 degrees" in heads[1]
    assert "An advice." in shown.run("return document.querySelector('#advice').innerText")


def test_the_motion_moves_in_the_colours_of_the_stress_and_the_freedom_beside_it(
    shown: Browser,
) -> None:
    state = (
        "return drawings.map(({movement, stress, player}) => "
        "[movement && movement.kind, Boolean(stress), player.playing, player.phase])"
    )
    first, second = shown.run(state)
    assert first[:3] == ["motion", True, True] and second[:3] == ["freedom", False, True]
    assert first[3] == second[3], "in step"
    shown.press(".play")
    first, second = shown.run(state)
    assert first[2] is second[2] is False and first[3] == second[3]
    assert shown.console() == []


def test_turning_one_turns_the_other(shown: Browser) -> None:
    before, _ = shown.run(CAMERAS)
    for number, key in ((0, Keys.ARROW_LEFT), (1, Keys.ARROW_UP), (1, "+"), (0, "0")):
        shown.run("drawings[arguments[0]].stage.canvas.focus({preventScroll: true})", number)
        shown.keys(key)
        one, other = shown.run(CAMERAS)
        assert np.allclose(one, other, rtol=0, atol=1e-9)
        assert not np.allclose(one, before, atol=1e-4)
        before = one
    from selenium.webdriver import ActionChains

    canvas = shown.driver.find_elements("css selector", ".canvas")[1]
    chain = ActionChains(shown.driver).move_to_element(canvas).click_and_hold()
    chain.move_by_offset(60, 20).release().perform()
    shown.drawn()
    one, other = shown.run(CAMERAS)
    assert np.allclose(one, other, rtol=0, atol=1e-9) and not np.allclose(one, before, atol=1e-2)


def test_both_have_one_scale(shown: Browser) -> None:
    sizes = shown.run("return drawings.map(({data}) => data.size)")
    assert sizes[0] == sizes[1]
    # The ends on the ground that both have are at the same places.
    first, second = (
        np.reshape(shown.run(f"return Array.from(drawings[{k}].pose.position)"), (-1, 3))
        for k in (0, 1)
    )
    same = [np.abs(second - place).max(axis=1).min() < 1e-6 for place in first]
    assert np.count_nonzero(same) >= 8


@pytest.mark.parametrize(("width", "columns"), [(360, 1), (800, 2)])
def test_beside_each_other_or_stacked(width: int, columns: int, shown: Browser) -> None:
    shown.resize(width, 900)
    sizes = shown.run("const r = document.documentElement; return [r.scrollWidth, r.clientWidth]")
    assert sizes[0] <= sizes[1] <= width
    boxes = shown.run(
        "return Array.from(document.querySelectorAll('.stage'), e => "
        "[e.getBoundingClientRect().left, e.getBoundingClientRect().top, e.clientWidth])"
    )
    assert len({round(box[0]) for box in boxes}) == columns
    assert len({round(box[1]) for box in boxes}) == 3 - columns
    assert all(box[2] > 0.75 * sizes[1] / columns for box in boxes)


def test_without_scripts_there_are_still_pictures() -> None:
    before, after = flexact.analyse(twelve_trusses()), flexact.analyse(folded_sheet(clamped=True))
    text = before_and_after(before, after, ("all",), stills=(b"one", b"two"))
    tags = Elements(text).tags
    pictures = [attributes for tag, attributes in tags if tag == "img"]
    for picture, content, analysis in zip(pictures, (b"one", b"two"), (before, after), strict=True):
        assert picture["src"] == f"data:image/png;base64,{b64encode(content).decode()}"
        assert picture["alt"] == str(verdict_in_words(analysis))
    hidden = {each.get("class") for _, each in tags if "hidden" in each}
    assert {"interactive", "choices", "shared"} <= hidden, "what would do nothing is not offered"


def test_what_the_verdict_says_is_shown_first(
    pair: tuple[flexact.Analysis, flexact.Analysis, str],
) -> None:
    _, _, text = pair
    first = r'"first":(\[.*?\]\])'
    assert re.findall(first, text) == ['[["movement","0"],["stress","0"]]', '[["movement","0"]]']


def test_only_results_have_pages(pair: tuple[flexact.Analysis, flexact.Analysis, str]) -> None:
    with pytest.raises(TypeError, match="a page is that of a result, not int"):
        before_and_after(pair[0], 2, ("x",))  # type: ignore[arg-type]
