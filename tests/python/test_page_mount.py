"""Drawings are mounted in any element, and a view is taken again in a renewed scene."""

from pathlib import Path

import pytest
from browser import Browser

pytestmark = pytest.mark.dear(2)

ROOT = Path(__file__).resolve().parents[2]
DECK = ROOT / "input_decks" / "paper" / "five_folded_sheets_symmetric.dat"

_RENEW = """
    const view = mounted.view();
    mounted.dispose();
    const body = arguments[0], before = document.body.innerHTML;
    document.body.innerHTML = body;
    window.mounted = Main.mount(document.body);
    window.drawings = mounted.viewers;
    window.flexact = drawings[0];
    mounted.restore(JSON.parse(JSON.stringify(view)));
"""


@pytest.fixture
def body(browser: Browser, tmp_path: Path) -> str:
    from flexact.show.page import content_of

    return content_of(browser.show(DECK, tmp_path)).body


def test_a_renewed_scene_is_seen_as_before(browser: Browser, body: str) -> None:
    browser.run("flexact.stage.turn(0.4, 0.2); flexact.stage.zoom(1.5)")
    browser.press("input[data-choice=movement][value='1']")
    browser.press("input[data-layer=nodes]")
    seen = browser.run("return [flexact.stage.looks(), flexact.movement.title]")
    browser.run(_RENEW, body)
    browser.drawn()
    looks, title = browser.run("return [flexact.stage.looks(), flexact.movement.title]")
    assert title == seen[1] and looks["fitted"] is False
    for name in ("eye", "target", "zoom"):
        assert looks[name] == pytest.approx(seen[0][name], abs=1e-9)
    assert browser.run("return flexact.layers.nodes && flexact.nodeLabels")
    assert browser.run("return flexact.player.playing") is False
    assert not browser.console()


def test_what_nobody_chose_follows_the_verdict(browser: Browser, body: str) -> None:
    assert browser.run("return mounted.view().picked") == [{}]


def test_a_disposed_stage_draws_no_more(browser: Browser, body: str) -> None:
    frames = browser.run(
        "const old = flexact.stage; mounted.dispose(); window.old = old; return old.frames"
    )
    browser.run("old.request()")
    browser.drawn()
    assert browser.run("return old.frames") == frames


def test_clicks_are_told(browser: Browser, body: str) -> None:
    browser.run("""
        window.told = [];
        document.body.addEventListener("flexact-click", ({ detail }) => told.push(detail));
        const [x, y] = flexact.stage.project(...flexact.members.middle(0));
        const { left, top } = flexact.stage.canvas.getBoundingClientRect();
        for (const type of ["pointerdown", "pointerup"]) {
          flexact.stage.canvas.dispatchEvent(new PointerEvent(type, {
            clientX: left + x, clientY: top + y, bubbles: true, pointerId: 1 }));
        }
    """)
    told = browser.run("return told")
    assert len(told) == 1 and told[0]["kind"] in {"member", "node", "body"}
