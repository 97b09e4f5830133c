# SPDX-License-Identifier: BSD-3-Clause
"""A watched page in the browser: the view is kept, errors stand beside it, the server may go."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from browser import Browser
from test_watch import EXACT, GUIDE, WRONG
from watched import Watched, until, watching

pytestmark = pytest.mark.dear(3)


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("watched")


@pytest.fixture(scope="module")
def served(place: Path) -> Iterator[Watched]:
    deck = place / "guide.dat"
    deck.write_text(GUIDE)
    with watching(deck, place / "state", "--no-browser") as watched:
        until(lambda: len(watched.out) > 1)
        yield watched


@pytest.fixture(autouse=True)
def window(browser: Browser) -> Iterator[None]:
    """A window of its own for each test, which remembers nothing."""
    first = browser.driver.current_window_handle
    browser.driver.switch_to.new_window("tab")
    yield
    for handle in browser.driver.window_handles:
        if handle != first:
            browser.driver.switch_to.window(handle)
            browser.driver.close()
    browser.driver.switch_to.window(first)


@pytest.fixture
def deck(place: Path, served: Watched, browser: Browser, window: None) -> Path:
    """The deck as it was at first, with its page open and at rest."""
    deck = place / "guide.dat"
    if deck.read_text() != GUIDE:
        lines = len(served.out)
        deck.write_text(GUIDE)
        until(lambda: len(served.out) > lines)
    browser.driver.get(served.address)
    browser.opened()
    browser.console()
    browser.requests()
    browser.resize(1280, 900)
    browser.run("flexact.play(false)")
    browser.drawn()
    return deck


def words(browser: Browser) -> str:
    return str(browser.run("return document.querySelector('.live').innerText"))


def save(browser: Browser, deck: Path, text: str) -> None:
    """Save a deck and wait until the page knows."""
    before = browser.run("return live.revision")
    deck.write_text(text)
    until(lambda: browser.run("return live.revision") != before)
    browser.drawn()


def looks(browser: Browser) -> list[float]:
    return list(
        browser.run(
            "const {eye, target, zoom} = flexact.stage.looks(); return [...eye, ...target, zoom]"
        )
    )


def test_a_save_renews_the_verdict_and_keeps_the_view(
    browser: Browser, deck: Path, served: Watched
) -> None:
    browser.run("flexact.stage.turn(0.4, 0.2); flexact.stage.zoom(1.5)")
    browser.press("input[data-choice=stress][value='0']")
    browser.press("input[data-layer=nodes]")
    seen = looks(browser)
    same = GUIDE.replace("0.05 0\n", "0.06 0\n")
    save(browser, deck, same)
    assert "still over-constrained by 1" in words(browser)
    assert looks(browser) == pytest.approx(seen, abs=1e-6)
    assert browser.run("return flexact.stress && flexact.layers.nodes")
    assert browser.run("return flexact.player.playing") is False
    save(browser, deck, EXACT)
    assert "over-constrained by 1 → exactly constrained" in words(browser)
    assert browser.run("return document.title") == "guide.dat: exactly constrained"
    assert "Exactly constrained" in browser.run("return document.querySelector('h1').innerText")
    assert looks(browser) == pytest.approx(seen, abs=1e-6)
    assert browser.run("return document.querySelectorAll('canvas.canvas').length") == 1
    assert not browser.console()
    origin = served.address.rpartition("/")[0].rpartition("/")[0]
    assert all(each.startswith((f"{origin}/", "data:")) for each in browser.requests())


def test_motions_are_seen_before_they_are_followed_and_stay_chosen(
    browser: Browser, deck: Path
) -> None:
    """Two scenes come of a save: the second takes no place, but for the shapes of motions."""
    browser.run("""
        window.told = [];
        document.body.addEventListener("flexact-renewed", () => {
          window.scene = flexact;
          told.push(flexact.data.movements.map(({ note, phases }) => `${phases}: ${note}`));
        });
        window.context = flexact.stage.renderer.getContext();
    """)
    save(browser, deck, EXACT)
    until(lambda: browser.run("return !flexact.data.movements[0].note.includes('Being followed')"))
    ((first, *_),) = browser.run("return told")
    assert first.startswith("3: Being followed")
    note, phases = browser.run(
        "return [flexact.data.movements[0].note, flexact.data.movements[0].phases]"
    )
    assert note.startswith(("On its path", "Held deformations")) and phases == 17
    assert browser.run("return flexact === scene && flexact.movement === flexact.data.movements[0]")
    assert note[:12] in browser.run("return document.querySelector('.shown').textContent")
    # What draws is compiled once.
    assert browser.run("return flexact.stage.renderer.getContext() === context")
    assert not browser.console()


def test_a_broken_deck_stands_beside_the_last_good_scene(browser: Browser, deck: Path) -> None:
    browser.run("window.first = flexact; flexact.stage.turn(0.4, 0.2)")
    save(browser, deck, WRONG)
    text = words(browser)
    assert "cannot be analysed; below is the last good scene" in text
    assert "guide.dat:3:1" in text and "^^^^" in text
    # The scene is the very same: nothing was taken away.
    assert browser.run("return flexact === first")
    browser.driver.refresh()
    browser.opened()
    assert "^^^^" in words(browser)
    assert "Over-constrained" in browser.run("return document.querySelector('h1').innerText")
    save(browser, deck, EXACT)
    assert "^^^^" not in words(browser)
    assert "over-constrained by 1 → exactly constrained" in words(browser)
    assert not browser.console()


@pytest.mark.parametrize("width", [360, 800, 1280])
def test_errors_fit_the_window(browser: Browser, deck: Path, width: int) -> None:
    browser.resize(width, 800)
    save(browser, deck, WRONG + "RLSE 99 1  % " + 60 * "long " + "\n")
    over = browser.run("return document.documentElement.scrollWidth - innerWidth")
    assert over <= 0


def test_a_reload_keeps_the_view(browser: Browser, deck: Path) -> None:
    browser.run("flexact.stage.turn(0.4, 0.2); flexact.stage.zoom(1.5)")
    browser.press("input[data-layer=nodes]")
    seen = looks(browser)
    browser.driver.refresh()
    browser.opened()
    assert looks(browser) == pytest.approx(seen, abs=1e-6)
    assert browser.run("return flexact.layers.nodes")
    assert browser.run("return flexact.player.playing") is False


def test_all_windows_are_renewed(browser: Browser, deck: Path, served: Watched) -> None:
    first = browser.driver.current_window_handle
    browser.driver.switch_to.new_window("window")
    browser.driver.get(served.address)
    save(browser, deck, EXACT)
    assert "→ exactly constrained" in words(browser)
    browser.driver.switch_to.window(first)
    until(lambda: "→ exactly constrained" in words(browser))


def test_the_page_goes_on_when_the_server_comes_back(browser: Browser, tmp_path: Path) -> None:
    deck = tmp_path / "guide.dat"
    deck.write_text(GUIDE)
    with watching(deck, tmp_path / "state") as watched:
        until(lambda: len(watched.out) > 1)
        browser.driver.get(watched.address)
        browser.run("flexact.stage.turn(0.4, 0.2)")
        browser.drawn()
        seen = looks(browser)
        watched.end()
    until(lambda: "The server has ended" in words(browser))
    deck.write_text(EXACT)
    with watching(deck, tmp_path / "state"):
        until(lambda: "The server has ended" not in words(browser))
        until(lambda: browser.run("return document.title") == "guide.dat: exactly constrained")
        assert looks(browser) == pytest.approx(seen, abs=1e-6)
        save(browser, deck, GUIDE)
        assert "→ over-constrained by 1" in words(browser)


def test_the_page_says_that_a_script_is_at_work(browser: Browser, tmp_path: Path) -> None:
    script = tmp_path / "design.py"
    script.write_text("import time\ntime.sleep(600)\n")
    with watching(script, tmp_path / "state") as watched:
        browser.driver.get(watched.address)
        until(lambda: "design.py is running (1 s)" in words(browser))
        script.write_text(f"import flexact\nguide = flexact.read_text({GUIDE!r})\n")
        until(lambda: "guide, the last model or analysis of design.py" in words(browser))
        assert "is running" not in words(browser)
        assert browser.run("return flexact.data.members.names.length") > 0
        script.write_text("nothing\n")
        until(lambda: "name 'nothing' is not defined" in words(browser))
        assert "design.py:1:1" in words(browser)
        assert browser.run("return flexact !== null")
