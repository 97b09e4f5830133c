# SPDX-License-Identifier: BSD-3-Clause
"""Outputs of notebooks in a real browser: as exported HTML, and as VS Code puts them there."""

import json
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from browser import Browser, browsing
from notebook_outputs import HOSTILE, VIEWER, exported, write
from pictures import deck
from reference_decks import ROOT

import flexact
from flexact.show.notebook import output as given
from flexact.show.notebook.output import script, tag
from flexact.show.page import page

pytestmark = pytest.mark.dear(3)

pytest.importorskip("matplotlib")
pytest.importorskip("PIL")

OUTPUTS = f"Array.from(document.querySelectorAll('{tag()}'))"
#: Waits until an output lives, and its drawing has been drawn.
_ALIVE = f"""
    const [k, done] = arguments;
    const step = () => {{
      const found = {OUTPUTS}[k];
      if (!found.mounted || !found.mounted.viewers.every((v) => v.stage.frames > 1)) {{
        return setTimeout(step, 30);
      }}
      requestAnimationFrame(() => requestAnimationFrame(() => done()));
    }};
    step();
"""


@cache
def small() -> tuple[str, ...]:
    """Three small results without the viewer: a motion, self-stresses, a degree of freedom."""
    names: dict[str, Any] = {}
    exec((ROOT / "docs" / "gallery" / "parallel_guide.py").read_text("utf-8"), names)
    model = next(each for each in names.values() if isinstance(each, flexact.Model))
    results = (
        deck("paper/twelve_trusses"),
        flexact.analyse(model),
        deck("flexures/cross_hinge_undeclared"),
    )
    return tuple(VIEWER.sub("", each._repr_html_()) for each in results)


@pytest.fixture(autouse=True)
def fresh() -> Iterator[None]:
    yield
    given.begin()


def come_to(browser: Browser, k: int) -> None:
    browser.run(f"{OUTPUTS}[arguments[0]].scrollIntoView({{ block: 'start' }})", k)
    browser.later(_ALIVE, k)


def shadow(browser: Browser, k: int, script: str) -> Any:
    """The value of a script of `root`, the shadow tree of an output, and its `viewer`."""
    return browser.run(
        f"const output = {OUTPUTS}[{k}], root = output.shadowRoot, "
        f"viewer = output.mounted && output.mounted.viewers[0]; {script}"
    )


def show(browser: Browser, folder: Path, html: str) -> None:
    # What plays takes its time where the processor draws.
    browser.prefer(prefers_reduced_motion="reduce")
    browser.open(write(folder / "notebook.html", html))


@pytest.mark.parametrize("first", ["before", "behind", "twice"])
def test_results_live_wherever_the_viewer_stands(
    first: str,
    browser: Browser,
    tmp_path: Path,
) -> None:
    cells = list(small())
    if first != "behind":
        cells[0] += script()
    if first != "before":
        cells.append(script())
    show(browser, tmp_path, exported(cells))
    for k in (2, 0, 1):
        come_to(browser, k)
        assert np.ptp(np.asarray(browser.pixels(tag())).reshape(-1, 3), axis=0).max() > 100
    assert browser.console() == []
    assert [each for each in browser.requests() if not each.startswith(("file:", "data:"))] == []
    assert browser.run("return document.querySelectorAll('iframe').length") == 0
    assert browser.run("return typeof THREE + typeof Main + typeof window.flexact") == (
        "undefined" * 3
    )


def test_more_results_than_contexts_all_live_when_they_are_come_to(
    browser: Browser,
    tmp_path: Path,
) -> None:
    show(browser, tmp_path, exported([small()[0] + script(), *small()[1:], *small() * 5]))
    assert browser.run(f"return {OUTPUTS}.length") == 18
    for k in range(18):
        come_to(browser, k)
        alive = browser.run(f"return {OUTPUTS}.filter((each) => each.mounted).length")
        assert 1 <= alive <= 8
        assert not shadow(browser, k, "return viewer.stage.renderer.getContext().isContextLost()")
    assert browser.console() == []
    # What has been seen leaves its picture.
    assert shadow(browser, 3, "return output.mounted === null") is True
    ink = shadow(
        browser,
        3,
        "const still = root.querySelector('.on-paper'), "
        "all = still.getContext('2d').getImageData(0, 0, still.width, still.height).data;"
        "return all.filter((_, i) => i % 4 === 3).reduce((n, a) => n + (a > 200), 0)",
    )
    assert ink > 5000
    assert shadow(
        browser, 3, "return getComputedStyle(root.querySelector('.on-paper')).display"
    ) == ("block")


def test_what_was_chosen_is_kept_while_it_is_out_of_sight(
    browser: Browser,
    tmp_path: Path,
) -> None:
    show(browser, tmp_path, exported([small()[0] + script(), *small()[1:] * 3]))
    come_to(browser, 0)
    shadow(
        browser,
        0,
        "viewer.play(false); viewer.stage.look('top'); viewer.stage.zoom(2);"
        "viewer.player.cycle = 0.3; viewer.movePhase(viewer.player.phase);"
        "root.querySelectorAll('details')[0].open = true;"
        "root.querySelector(\"input[data-choice='stress'][value='0']\").click();",
    )
    told = (
        "return JSON.stringify([viewer.stage.camera.position.toArray().map((x) => x.toFixed(6)),"
        "viewer.stage.camera.zoom.toFixed(6), viewer.player.playing,"
        "viewer.player.cycle.toFixed(6), viewer.stress.title, viewer.movement.title,"
        "Array.from(root.querySelectorAll('details'), (each) => each.open)])"
    )
    before = shadow(browser, 0, told)
    height = shadow(browser, 0, "return output.getBoundingClientRect().height")
    come_to(browser, 5)
    assert shadow(browser, 0, "return output.mounted === null")
    # Nothing on the page moves when an output falls asleep, or wakes.
    assert shadow(browser, 0, "return output.getBoundingClientRect().height") == height
    come_to(browser, 0)
    assert shadow(browser, 0, told) == before
    assert json.loads(before)[2] is False
    assert shadow(browser, 0, "return output.getBoundingClientRect().height") == height


def test_without_the_viewer_there_is_a_picture_and_how_to_bring_it_back(
    browser: Browser,
    tmp_path: Path,
) -> None:
    show(browser, tmp_path, exported(small()))
    assert browser.run(f"return {OUTPUTS}[0].shadowRoot === null")
    shown = browser.run(f"return {OUTPUTS}[0].innerText")
    assert "flexact.viewer()" in shown and "Under-constrained by 1" in shown
    assert browser.run(f"return {OUTPUTS}[0].querySelector('img').naturalWidth") == 960
    # It is brought, in an output below: as JupyterLab and VS Code let scripts of HTML run.
    browser.run(_PUT + "put(arguments[0], document.body)", flexact.viewer()._repr_html_())
    browser.later(_ALIVE, 0)
    assert browser.console() == []


#: As the renderer of HTML in VS Code: it sets the text, and then runs copies of its scripts, which
#: it takes out again. JupyterLab's puts copies in their places.
_PUT = """
    const put = (html, place) => {
      const box = document.createElement("div");
      box.innerHTML = html;
      place.append(box);
      for (const each of Array.from(box.getElementsByTagName("script"))) {
        const copy = document.createElement("script");
        copy.text = each.innerText;
        for (const key of ["type", "src", "nonce", "noModule", "async"]) {
          const value = each[key] || each.getAttribute(key);
          if (value) copy.setAttribute(key, value);
        }
        box.appendChild(copy).parentNode.removeChild(copy);
      }
      return box;
    };
"""


def test_outputs_come_and_go_as_in_vs_code(
    browser: Browser,
    tmp_path: Path,
) -> None:
    blank = (
        "<!DOCTYPE html><html><head><meta charset='utf-8'><link rel='icon' href='data:,'>"
        "<meta http-equiv='Content-Security-Policy' content=\"default-src 'none'; "
        "script-src 'unsafe-inline' 'unsafe-eval'; style-src 'unsafe-inline'; "
        'img-src data: file:"></head>'
        "<body class='vscode-dark' data-vscode-theme-kind='vscode-dark'></body></html>"
    )
    show(browser, tmp_path, blank)
    first, second, third = small()
    # The second cell is drawn before the first, which brings the viewer.
    browser.run(_PUT + "window.two = put(arguments[0], document.body)", second)
    browser.run(
        _PUT + "window.one = put(arguments[0], document.body); document.body.prepend(one)",
        first + script(),
    )
    browser.later(_ALIVE, 0)
    assert shadow(browser, 0, "return output.dataset.theme") == "dark"
    # It runs again, without the viewer; what it showed before goes.
    browser.run(_PUT + "one.remove(); window.three = put(arguments[0], document.body)", third)
    come_to(browser, 1)
    come_to(browser, 0)
    # Scrolled far away, a notebook takes outputs out, and puts them back.
    browser.run("window.kept = two; two.remove()")
    assert browser.run(f"return kept.querySelector('{tag()}').mounted === null")
    browser.run("document.body.prepend(kept)")
    come_to(browser, 0)
    # The theme changes.
    browser.run("document.body.dataset.vscodeThemeKind = 'vscode-light'")
    browser.drawn()
    assert shadow(browser, 0, "return output.dataset.theme") == "light"
    for kind, theme in (("vscode-high-contrast", "dark"), ("vscode-high-contrast-light", "light")):
        browser.run("document.body.dataset.vscodeThemeKind = arguments[0]", kind)
        browser.drawn()
        assert shadow(browser, 0, "return output.dataset.theme") == theme
    assert browser.console() == []


def test_styles_stay_inside_and_outside(
    browser: Browser,
    tmp_path: Path,
) -> None:
    seen = []
    for style in ("", HOSTILE):
        show(browser, tmp_path, exported([small()[0] + script()], style=style))
        # At one place of the window in both.
        browser.run(
            "document.querySelector('.cell').style.cssText = 'position:absolute;"
            "left:0;top:0;width:900px;padding:0;overflow:visible'"
        )
        browser.run("document.querySelector('.cell > p').remove()")
        browser.later(_ALIVE, 0)
        seen.append(
            shadow(
                browser,
                0,
                "return JSON.stringify(Array.from(root.querySelectorAll('.page *'), (each) => {"
                "const box = each.getBoundingClientRect(), style = getComputedStyle(each);"
                "return [each.localName, Math.round(box.width), Math.round(box.height),"
                "style.color, style.fontSize, style.letterSpacing, style.textTransform];}))",
            )
        )
    assert json.loads(seen[0]) == json.loads(seen[1]) and len(json.loads(seen[0])) > 100
    # And the notebook keeps its own.
    browser.run(
        "const made = document.createElement('button'); made.id = 'own';"
        "made.className = 'page verdict stage'; made.textContent = 'x';"
        "document.body.append(made)"
    )
    after = "const s = getComputedStyle(document.getElementById('own'));"
    told = browser.run(f"{after} return [s.color, s.borderTopWidth, s.fontSize, s.textTransform]")
    assert told == ["rgb(255, 0, 0)", "9px", told[2], "uppercase"]


@pytest.mark.parametrize("width", [360, 800, 1280])
@pytest.mark.parametrize("theme", ["light", "dark"])
def test_it_fits_its_place_in_light_and_dark(
    width: int,
    theme: str,
    browser: Browser,
    tmp_path: Path,
) -> None:
    browser.resize(width, 900)
    show(browser, tmp_path, exported([small()[1] + script()], theme))
    come_to(browser, 0)
    assert browser.run("return document.documentElement.scrollWidth <= innerWidth")
    beyond = shadow(
        browser,
        0,
        "const box = output.getBoundingClientRect();"
        "return Array.from(root.querySelectorAll('.page *')).filter((each) => {"
        "const own = each.getBoundingClientRect();"
        "return own.width && !each.closest('.deck, .unseen') && "
        "(own.left < box.left - 1 || own.right > box.right + 1);}).map((e) => e.className)",
    )
    assert beyond == []
    # As high as what is in it: nothing scrolls within.
    assert shadow(
        browser,
        0,
        "const p = root.querySelector('.page');"
        "return Math.abs(p.scrollHeight - p.clientHeight) <= 1",
    )
    assert shadow(browser, 0, "return output.dataset.theme") == theme
    ground = browser.pixels(tag())[60:70, -30:-20].mean()
    assert bool(ground > 200) is (theme == "light")


def test_keys_and_the_wheel_are_the_notebooks_until_somebody_clicks(
    browser: Browser,
    tmp_path: Path,
) -> None:
    show(browser, tmp_path, exported([small()[0] + script(), *small()[1:]]))
    come_to(browser, 0)
    browser.run(
        "window.taken = []; document.addEventListener('keydown', (e) => {"
        "taken.push([e.key, e.target.hasAttribute('data-lm-suppress-shortcuts')]); }, true)"
    )
    wheel = (
        "const canvas = root.querySelector('.canvas'); const event = new WheelEvent('wheel',"
        "{ deltaY: 100, bubbles: true, cancelable: true, composed: true });"
        "canvas.dispatchEvent(event); return event.defaultPrevented"
    )
    assert shadow(browser, 0, wheel) is False
    shadow(browser, 0, "root.querySelector('.canvas').focus()")
    assert shadow(browser, 0, wheel) is True
    before = shadow(browser, 0, "viewer.play(false); return viewer.stage.camera.zoom")
    browser.keys("+")
    assert shadow(browser, 0, "return viewer.stage.camera.zoom") > before
    assert browser.run("return taken") == [["+", True]]
    shadow(browser, 0, "root.querySelector('.canvas').blur()")
    assert shadow(browser, 0, wheel) is False


def test_links_of_a_result_stay_within_it(
    browser: Browser,
    tmp_path: Path,
) -> None:
    show(browser, tmp_path, exported([small()[0] + script()]))
    come_to(browser, 0)
    address = browser.run("return location.href")
    shadow(
        browser,
        0,
        "const link = document.createElement('a'); link.href = '#decision';"
        "link.id = 'try'; root.querySelector('.verdict').append(link); link.click()",
    )
    assert browser.run("return location.href") == address
    assert shadow(browser, 0, "return root.getElementById('decision').closest('details').open")


def test_without_webgl_the_still_picture_stays(tmp_path: Path) -> None:
    with browsing("--disable-gpu", "--disable-3d-apis") as plain:
        show(plain, tmp_path, exported([small()[0] + script()]))
        plain.later(_ALIVE.replace("!found.mounted ||", "!found.mounted || false &&"), 0)
        assert shadow(plain, 0, "return output.mounted.viewers.length") == 0
        assert shadow(plain, 0, "return root.querySelector('.still img').naturalWidth") == 960
        assert shadow(plain, 0, "return root.querySelector('.verdict').innerText.length") > 20


def test_the_page_on_disk_is_as_it_was(browser: Browser, tmp_path: Path) -> None:
    show(browser, tmp_path, page(deck("paper/twelve_trusses")))
    browser.press("#theme")
    chosen = browser.run("return document.documentElement.dataset.theme")
    assert chosen in ("light", "dark")
    browser.press("#theme")
    assert browser.run("return document.documentElement.dataset.theme") != chosen
    assert browser.console() == []
