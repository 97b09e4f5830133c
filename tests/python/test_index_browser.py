# SPDX-License-Identifier: BSD-3-Clause
"""The index of a folder in a browser: found, sorted, linked, by keyboard and on a telephone."""

from pathlib import Path

import numpy as np
import pytest
from browser import Browser
from reference_decks import ROOT
from small_decks import BROKEN, DECKS, write

from flexact.apps.cli.main import main
from flexact.show.page import Entry, index_page

pytestmark = pytest.mark.dear(3)

Keys = pytest.importorskip("selenium.webdriver").Keys
SHOWN = """return Array.from(document.querySelectorAll(".card")).filter(card => !card.hidden)
  .map(card => card.querySelector(".name").textContent)"""
FOUND = "return document.querySelector('#found').innerText"
HASH = "return decodeURIComponent(location.hash)"


@pytest.fixture(scope="module")
def index(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Decks of each verdict, one with a margin, and one with an error."""
    pytest.importorskip("matplotlib")
    folder = tmp_path_factory.mktemp("index")
    for name, text in DECKS.items():
        write(folder / "in" / f"{name}.dat", text)
    # Its joint is 1 mm above the line through both supports: its margin is small.
    write(folder / "in" / "flat" / "exact_10.dat", DECKS["exact"].replace("0.5 1\n", "0.5 .001\n"))
    write(folder / "in" / "flat" / "exact_9.dat", DECKS["exact"].replace("0.5 1\n", "0.5 .002\n"))
    write(folder / "in" / "wrong_name.dat", "% 1\n" + BROKEN)
    main(["report", str(folder / "in"), "-o", str(folder / "out")])
    return folder / "out" / "index.html"


@pytest.fixture
def shown(index: Path, browser: Browser) -> Browser:
    browser.open(index)
    # Pictures are within, and wait until they are seen.
    assert [each for each in browser.requests() if not each.startswith("data:")] == [index.as_uri()]
    return browser


def names(browser: Browser) -> list[str]:
    return [name.strip() for name in browser.run(SHOWN)]


def choose(browser: Browser, order: str) -> None:
    browser.run(
        "const s = document.querySelector('#sort'); s.value = arguments[0];"
        "s.dispatchEvent(new Event('change', {bubbles: true}))",
        order,
    )
    browser.drawn()


ALL = ["both", "exact", "flat/exact_10", "flat/exact_9", "over", "under", "wrong_name"]


def test_each_card_says_what_is_known(shown: Browser) -> None:
    assert names(shown) == ALL
    cards = shown.run("return Array.from(document.querySelectorAll('.card'), c => c.innerText)")
    assert "Under-constrained by 1 and over-constrained by 1" in cards[0]
    assert "only in exact alignment" in cards[0] and "rank proven" in cards[0]
    assert "0 motions \u00b7 1 self-stress \u00b7 0 declared freedoms \u00b7 3 elements" in cards[4]
    assert "wrong_name.dat:2:1" in cards[6] and "PLTRUS is not a keyword" in cards[6]
    assert shown.run("return document.querySelector('.excerpt').innerText") == "PLTRUS 1 1 2"
    assert shown.run("return document.querySelector('mark').innerText") == "PLTRUS"
    assert shown.console() == []
    waits = shown.run("return Array.from(document.images, i => i.loading)")
    assert waits == ["lazy"] * 6


def test_clicks_choose_verdicts_and_the_address_keeps_them(shown: Browser, index: Path) -> None:
    shown.press('.chip input[value="exact"]')
    assert names(shown) == ["exact", "flat/exact_10", "flat/exact_9"]
    shown.press('.chip input[value="over"]')
    assert names(shown) == ["exact", "flat/exact_10", "flat/exact_9", "over"]
    assert shown.run(HASH) == "#show=exact,over"
    assert shown.run(FOUND) == "4 of 7 shown"
    assert shown.run("return document.querySelector('#find').value") == ""
    choose(shown, "margin")
    assert names(shown) == ["flat/exact_10", "flat/exact_9", "exact", "over"]
    address = shown.driver.current_url
    shown.driver.get("about:blank")
    shown.driver.get(address)
    shown.drawn()
    assert names(shown) == ["flat/exact_10", "flat/exact_9", "exact", "over"]
    assert shown.run("return document.querySelector('#sort').value") == "margin"
    shown.press("#all")
    assert names(shown) == ALL and shown.run(HASH) == ""
    assert shown.console() == []


@pytest.mark.parametrize(
    ("order", "first", "last"),
    [
        ("name", "both", "wrong_name"),
        ("under", "both", "wrong_name"),
        ("margin", "wrong_name", "under"),
        ("over", "both", "wrong_name"),
        ("size", "over", "wrong_name"),
    ],
)
def test_decks_are_sorted(order: str, first: str, last: str, shown: Browser) -> None:
    choose(shown, order)
    found = names(shown)
    assert sorted(found) == sorted(ALL)
    assert (found[0], found[-1]) == (first, last)
    if order == "name":
        # Numbers in names count.
        assert found.index("flat/exact_9") < found.index("flat/exact_10")
    shown.press("#down")
    assert names(shown)[0] == last and "reverse=1" in shown.run(HASH)
    assert (
        shown.run("return document.querySelector('#down').getAttribute('aria-pressed')") == "true"
    )


def test_of_one_verdict_decks_stay_in_their_order(shown: Browser) -> None:
    choose(shown, "verdict")
    gravity = ["wrong_name", "both", "over", "under", "exact", "flat/exact_10", "flat/exact_9"]
    assert names(shown) == gravity
    shown.press("#down")
    assert names(shown) == [*gravity[4:], *gravity[3::-1]]


def test_words_find_decks_by_keyboard_alone(shown: Browser) -> None:
    shown.keys("/")
    shown.keys("keyword pltrus")
    assert names(shown) == ["wrong_name"] and shown.run(HASH) == "#find=keyword+pltrus"
    shown.keys(Keys.ESCAPE)
    assert names(shown) == ALL
    shown.keys("zzz")
    assert names(shown) == [] and shown.run(FOUND) == "No deck is like this."
    shown.keys(Keys.ESCAPE, "flat")
    assert names(shown) == ["flat/exact_10", "flat/exact_9"]
    # From the field over the order, its two buttons, to the first deck.
    shown.keys(*[Keys.TAB] * 4)
    assert shown.run("return document.activeElement.innerText") == "flat/exact_10"
    shown.keys(Keys.ARROW_RIGHT)
    assert shown.run("return document.activeElement.innerText") == "flat/exact_9"
    shown.keys(Keys.ENTER)
    assert shown.driver.current_url.endswith("out/flat/exact_9.html")
    assert shown.console() == []
    # And back, by the link and by the browser, which knows what was chosen.
    back = shown.run("return document.querySelector('.back a').href")
    assert back.endswith("out/index.html")
    shown.driver.back()
    shown.drawn()
    assert names(shown) == ["flat/exact_10", "flat/exact_9"]


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [360, 800, 1280])
def test_everything_fits(width: int, scheme: str, shown: Browser) -> None:
    shown.prefer(prefers_color_scheme=scheme)
    shown.resize(width, 900)
    assert shown.run("return document.documentElement.scrollWidth <= innerWidth")
    boxes = shown.run(
        """return Array.from(document.querySelectorAll('.finder, .card'), each => {
          const {left, right, top, bottom} = each.getBoundingClientRect();
          return [left, right, top, bottom]; })"""
    )
    for k, (left, right, top, bottom) in enumerate(boxes):
        assert 0 <= left < right <= width
        for a, b, c, d in boxes[:k]:
            assert right <= a or b <= left or bottom <= c or d <= top
    ground = shown.pixels("body")[2, width // 2]
    # The page's first line has the colour of ink: dark on light, light on dark.
    assert (ground.mean() < 100) == (scheme == "light")
    assert shown.console() == []


def test_without_scripts_all_is_there(browser: Browser, index: Path) -> None:
    browser.driver.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": True})
    try:
        browser.driver.get(index.as_uri())
        from selenium.webdriver.common.by import By

        cards = browser.driver.find_elements(By.CLASS_NAME, "card")
        assert len(cards) == 7 and all(card.is_displayed() for card in cards)
        assert not browser.driver.find_element(By.CLASS_NAME, "finder").is_displayed()
        about = browser.driver.find_element(By.CLASS_NAME, "about").text
        assert "3 exactly constrained" in about
    finally:
        browser.driver.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": False})


def test_a_thousand_decks_are_chosen_and_sorted(browser: Browser, tmp_path: Path) -> None:
    kinds = (("exact", "+", "exactly constrained"), ("over", "-", "over-constrained"))
    sizes = np.random.default_rng(1).permutation(1000)
    entries = [
        Entry(
            *(f"{k % 7}/deck_{k}", f"{k}.html", kinds[k % 2][:2], kinds[k % 2][2], "Words"),
            counts=(0, k % 2, 0, int(size)),
        )
        for k, size in enumerate(sizes.tolist())
    ]
    path = tmp_path / "index.html"
    path.write_text(index_page(entries), encoding="utf-8")
    browser.open(path)
    choose(browser, "size")
    browser.press('.chip input[value="over"]')
    order = [k for k in np.argsort(-sizes).tolist() if k % 2]
    assert names(browser) == [f"{k % 7}/deck_{k}" for k in order]
    assert browser.run(FOUND) == "500 of 1000 shown"


def test_hostile_names_are_text(browser: Browser, tmp_path: Path) -> None:
    """Names and lines of decks are no HTML, and an address chooses nothing that is not there."""
    name = "<img src=x onerror=alert(1)>"
    entry = Entry(
        *(name, "", ("broken", "x"), "cannot be analysed", name),
        **{"error": name, "line": f"{name}</code>", "marked": (1, 3), "place": name},
    )
    path = tmp_path / "index.html"
    path.write_text(index_page([entry]), encoding="utf-8")
    browser.open(path)
    browser.driver.get(f"{path.as_uri()}#show=nothing&sort=__proto__&find=%3Cimg")
    browser.drawn()
    assert browser.console() == [] and len(browser.requests()) <= 2
    assert names(browser) == [name]


def test_the_gallery_of_broken_decks_has_places(tmp_path: Path) -> None:
    """Each has its first error with line and column, as it is expected on the command line."""
    broken = ROOT / "input_decks" / "broken"
    main(["report", str(broken / "ten_mistakes.dat"), "-o", str(tmp_path)])
    text = (tmp_path / "index.html").read_text(encoding="utf-8")
    assert "ten_mistakes.dat:2:1" in text and "<mark>TRUS</mark>" in text
