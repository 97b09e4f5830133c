# SPDX-License-Identifier: BSD-3-Clause
"""The page of the gallery's mechanisms: nothing lies over anything else, at any width."""

import runpy
from pathlib import Path

import numpy as np
import pytest
from browser import Browser

from flexact.show.page.assets import TERMS

pytestmark = pytest.mark.dear(3)

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = sorted((ROOT / "docs" / "gallery").glob("*.py"))

_BOXES = """
    const {overlay, stage} = flexact;
    return {gauges: Object.values(overlay.gauges), labels: overlay.labels.boxes,
            size: [stage.width, stage.height, stage.foot],
            wide: [document.documentElement.scrollWidth, innerWidth]};
"""
_PARTS = """
    const seen = Array.from(document.querySelectorAll(
        '.stage, .shown, .legend, .toolbar button, .toolbar label, .choices .chip, .check'))
        .filter((e) => e.checkVisibility());
    return seen.map((e) => { const b = e.getBoundingClientRect();
        return [b.left, b.top, b.right, b.bottom]; });
"""
_SMALL = """
    return Array.from(document.querySelectorAll(
        'button:not(.link), .chip, .check, summary, .parts th .link'))
        .filter((e) => e.checkVisibility())
        .map((e) => [e.className || e.tagName, e.getBoundingClientRect()])
        .filter(([, b]) => b.height < 39.5 || b.width < 39.5)
        .map(([name, b]) => `${name} ${b.width} x ${b.height}`);
"""


def overlapping(boxes: list[list[float]], by: float = 0.5) -> list[tuple[int, int]]:
    """Pairs of boxes (left, top, right, bottom) that lie over each other by more than so much."""
    each = np.reshape(boxes, (-1, 4))
    across = np.minimum(each[:, None, 2], each[:, 2]) - np.maximum(each[:, None, 0], each[:, 0])
    down = np.minimum(each[:, None, 3], each[:, 3]) - np.maximum(each[:, None, 1], each[:, 1])
    return [(int(i), int(j)) for i, j in np.argwhere(np.triu((across > by) & (down > by), 1))]


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_nothing_lies_over_anything(script: Path, browser: Browser, tmp_path: Path) -> None:
    browser.show(runpy.run_path(str(script))["model"], tmp_path)
    browser.run("for (const l of ['nodes', 'elements', 'axes']) flexact.layer(l, true)")
    for width, view in ((1280, "iso"), (800, "front"), (360, "top")):
        browser.resize(width, 900)
        browser.run("flexact.stage.look(arguments[0]); flexact.stage.zoom(2)", view)
        browser.drawn()
        found = browser.run(_BOXES)
        wide, high, foot = found["size"]
        assert found["wide"][0] <= found["wide"][1] == width
        assert not overlapping(found["labels"] + found["gauges"])
        for left, top, right, bottom in found["gauges"]:
            assert left >= 0 and right <= wide
            assert top >= high and bottom <= high + foot, "in the strip below the canvas"
        for left, top, right, bottom in found["labels"]:
            assert left >= 0 and right <= wide and top >= 0 and bottom <= high
        assert not overlapping(browser.run(_PARTS))
        if width == 360:
            assert browser.run(_SMALL) == []
    # Without axes and scale the strip is bare: the mechanism, however near, stays above it.
    browser.run("document.querySelector('.stage').scrollIntoView({behavior: 'instant'})")
    browser.drawn()
    browser.run("flexact.overlay.context.clearRect(0, 0, 9999, 9999)")
    stage = browser.pixels()[-round(foot) + 3 : -3, 4:-4]
    assert np.ptp(stage.reshape(-1, 3), axis=0).max() <= 8
    assert browser.console() == []


def test_a_click_marks_and_does_not_move(browser: Browser, tmp_path: Path) -> None:
    browser.show(ROOT / "input_decks/paper/six_folded_sheets.dat", tmp_path)
    state = "return [...flexact.stage.camera.position.toArray(), flexact.stage.camera.zoom]"
    before = browser.run(state)
    assert browser.run("return document.querySelector('.centre').disabled")
    browser.press("#stresses tr[data-element] .link")
    held = browser.run("return flexact.held.element")
    assert held and browser.run("return flexact.members.marks[0].visible")
    assert browser.run("return document.querySelectorAll('.link.held').length") > 0
    assert browser.run(state) == before
    browser.press(".centre")
    assert browser.run(state) != before
    browser.run(
        "document.activeElement.dispatchEvent(new KeyboardEvent('keydown',"
        "{key: 'Escape', bubbles: true}))"
    )
    assert browser.run("return flexact.held === null && !flexact.members.marks[0].visible")


def test_terms_tell_their_sentence(browser: Browser, tmp_path: Path) -> None:
    browser.show(ROOT / "input_decks/paper/six_folded_sheets.dat", tmp_path)
    terms = browser.run("return [...document.querySelectorAll('.term')].map(t => t.dataset.term)")
    assert {"over-constrained", "self-stress", "margin", "d(c)", "rank", "dependent"} <= set(terms)
    assert set(terms) <= set(TERMS)
    browser.run("document.querySelector('.term[data-term=rank]').focus()")
    tip = "return [document.querySelector('.term-tip').hidden,"
    tip += "document.querySelector('.term-tip').textContent]"
    assert browser.run(tip) == [False, TERMS["rank"]]
    browser.run("document.activeElement.blur()")
    assert browser.run(tip)[0] is True


def test_sentences_stand_in_the_glossary() -> None:
    text = (ROOT / "docs" / "glossary.md").read_text(encoding="utf-8")
    table = text.partition("## In pages")[2].partition("\n## ")[0].strip().splitlines()[4:]
    rows = dict(line.strip("| ").split(" | ", 1) for line in table)
    assert {word.lower(): sentence for word, sentence in rows.items()} == TERMS
