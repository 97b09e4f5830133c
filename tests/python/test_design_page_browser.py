# SPDX-License-Identifier: BSD-3-Clause
"""The page of layouts in a browser: what moves, is chosen, is sorted, and opens."""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from browser import Browser
from test_design_page import FILE, STAGE
from watched import Watched, until

from flexact.designs.design import Designs, layouts_of
from flexact.designs.page import page_of
from flexact.designs.reading import problem_of
from flexact.designs.scores import pareto

pytestmark = pytest.mark.dear(3)

Keys = pytest.importorskip("selenium.webdriver").Keys

SHOWN = """
    return Array.from(document.querySelectorAll('.card.layout:not([hidden])'),
      (each) => Number(each.dataset.number))
"""
POINTS = """
    return Array.from(document.querySelectorAll('.plot .point-of'),
      (each) => [each.querySelector('text').textContent, each.getAttribute('class')])
"""
IN_SIGHT = "document.querySelector('.cards').scrollIntoView({ behavior: 'instant' })"


@pytest.fixture(scope="module")
def designs() -> Designs:
    return layouts_of(problem_of({**STAGE, "count": 4}))


@pytest.fixture(scope="module")
def path(designs: Designs, tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("layouts") / "stage.html"
    made.write_bytes(page_of(designs, "stage"))
    return made


@pytest.fixture
def shown(path: Path, browser: Browser) -> Browser:
    browser.open(path)
    return browser


def alive(browser: Browser, cards: str = "mounted") -> None:
    browser.run(IN_SIGHT)
    until(lambda: browser.run(f"return {cards}.viewers.length") > 0)


def test_cards_come_alive_in_sight_and_move_as_chosen(shown: Browser, path: Path) -> None:
    asked = [each for each in shown.requests() if not each.startswith("data:")]
    assert asked == [path.as_uri()]
    alive(shown)
    state = shown.run(
        "const [viewer] = mounted.viewers;"
        "return [viewer.movement.label, viewer.spaces.groups.map(({ visible }) => visible)]"
    )
    assert state == ["translation x", [True, True]]
    before = shown.run("return mounted.viewers[0].player.cycle")
    until(lambda: shown.run("return mounted.viewers[0].player.cycle") != before)
    shown.press(".card .choices input[value='2']")
    assert shown.run("return mounted.viewers[0].movement.label").startswith("rotation about")
    shown.press("input[data-space='0']")
    groups = "return mounted.viewers[0].spaces.groups.map(({ visible }) => visible)"
    assert shown.run(groups) == [False, True]
    # Turning one turns all.
    shown.run("mounted.toolbar.viewers[0].stage.turn(0.4, 0.1)")
    ways = shown.run("return mounted.viewers.map(({ stage }) => stage.towards)")
    assert all(way == pytest.approx(ways[0], abs=1e-6) for way in ways)
    assert shown.console() == []


def test_cards_are_sorted_and_filtered_and_the_table_and_plot_with_them(
    shown: Browser, designs: Designs
) -> None:
    numbers = [layout.number for layout in designs]
    assert shown.run(SHOWN) == numbers
    are_best = zip(numbers, pareto(designs.layouts), strict=True)
    best = [number for number, is_best in are_best if is_best]
    marked = [int(number) for number, kind in shown.run(POINTS) if "best" in kind]
    assert sorted(marked) == best
    choose = (
        "const sort = document.querySelector('#sort'); sort.value = arguments[0];"
        "sort.dispatchEvent(new Event('change', { bubbles: true }))"
    )
    shown.run(choose, "drive_stiffness")
    drives = {layout.number: layout.scores["drive_stiffness"] for layout in designs}
    assert shown.run(SHOWN) == sorted(numbers, key=lambda number: (drives[number], number))
    shown.run(choose, "-worst_stiffness")
    stiff = {layout.number: layout.scores["worst_stiffness"] for layout in designs}
    order = sorted(numbers, key=lambda number: -stiff[number])
    assert shown.run(SHOWN) == order
    rows = SHOWN.replace(".card.layout", "tr[data-number]")
    assert shown.run(rows) == order
    # Only those that are at least as stiff as the second, in the unit that is shown.
    second = 1e-6 * stiff[order[1]]
    shown.run(
        "const input = document.querySelector('input[data-range=worst_stiffness][data-end=least]');"
        "input.value = arguments[0]; input.dispatchEvent(new Event('change', { bubbles: true }))",
        f"{second:.3g}",
    )
    assert shown.run(SHOWN) == shown.run(rows) == order[:2]
    away = [number for number, kind in shown.run(POINTS) if "away" in kind]
    assert sorted(map(int, away)) == sorted(order[2:])
    assert "2 of 4 shown" in shown.run("return document.querySelector('#found').textContent")
    shown.press("#all")
    assert shown.run(SHOWN) == numbers


def test_a_point_leads_to_its_card_and_a_card_to_its_page(shown: Browser) -> None:
    shown.run(
        "Array.from(document.querySelectorAll('.plot .point-of'))"
        ".find((each) => each.textContent.endsWith('3'))"
        ".dispatchEvent(new MouseEvent('click', { bubbles: true, cancelable: true }))"
    )
    assert shown.run("return document.activeElement.closest('.card').dataset.number") == "3"
    shown.keys(Keys.ENTER)
    until(lambda: shown.run("return mounted.whole && mounted.whole.viewers.length"))
    assert shown.run("return location.hash") == "#layout=3"
    head = shown.run("return document.querySelector('.one header').innerText")
    assert "Exactly constrained" in head
    assert shown.run("return mounted.viewers.length") == 0
    assert not shown.run("return document.querySelector('main.layouts').checkVisibility()")
    shown.run("history.back()")
    until(lambda: shown.run("return document.querySelector('main.layouts').checkVisibility()"))
    assert shown.run("return document.querySelector('.one').childElementCount") == 0
    assert shown.run("return document.activeElement.closest('.card').dataset.number") == "3"
    alive(shown)
    assert shown.console() == []


@pytest.mark.parametrize("width", [360, 1400])
def test_nothing_lies_beyond_the_page(shown: Browser, width: int) -> None:
    shown.resize(width, 900)
    for each in ("", "document.querySelectorAll('details').forEach((e) => { e.open = true })"):
        shown.run(each)
        shown.drawn()
        assert shown.run("return document.documentElement.scrollWidth <= innerWidth")


@pytest.fixture
def watched(tmp_path: Path) -> Iterator[Watched]:
    file = tmp_path / "stage.toml"
    file.write_text(FILE)
    made = Watched(file, tmp_path / "state", "--no-browser")
    try:
        yield made
    finally:
        made.end()


def test_a_watched_page_is_renewed_and_keeps_its_cards(watched: Watched, browser: Browser) -> None:
    browser.driver.get(watched.address)
    browser.opened()

    def state(script: str) -> Any:
        return browser.run(f"return {script}")

    until(lambda: state("document.querySelectorAll('.whole').length") == 2)
    alive(browser, "live.mounted")
    browser.run("window.first = live.mounted.viewers[0]")
    good = watched.file.read_text()
    watched.file.write_text(good.replace("count = 2", "count = 2 2"))
    until(lambda: not state("document.querySelector('.live-errors').hidden"))
    assert "stage.toml:3" in state("document.querySelector('.live-errors').textContent")
    assert state("document.querySelectorAll('.card.layout').length") == 2
    watched.file.write_text(good.replace("count = 2", "count = 3"))
    until(lambda: state("document.querySelectorAll('.whole').length") == 3)
    assert state("document.querySelector('.live-errors').hidden")
    # The drawing of a layout that stays is the same one.
    assert state("live.mounted.viewers.includes(first) && !first.stage.disposed")
    until(lambda: state("document.querySelector('.live-work').hidden"))
    time.sleep(0.1)
    assert browser.console() == []
