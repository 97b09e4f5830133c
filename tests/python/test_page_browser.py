# SPDX-License-Identifier: BSD-3-Clause
"""The page in a real browser: what is seen, what moves, what answers to keys and pointer."""

import re
from pathlib import Path

import numpy as np
import pytest
from browser import Browser, browsing, paged
from known_models import folded_sheet, twelve_trusses
from reference_decks import NAMES, ROOT

import flexact
from flexact.advice.describe import verdict_in_words
from flexact.costs.quick_cost import quick_cost, quick_curve
from flexact.show.page import broken_page, page

pytestmark = pytest.mark.dear(5)

PAPER = [name for name in NAMES if name.startswith("paper/")]
SHARED = "input_decks/paper/folded_sheet_clamped.dat"


Keys = pytest.importorskip("selenium.webdriver").Keys


def changed(before: np.ndarray, after: np.ndarray) -> int:
    """How many pixels are clearly other ones."""
    return int(np.count_nonzero(np.abs(before.astype(int) - after).max(axis=2) > 24))


def write(path: Path, text: str) -> Path:
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize("name", PAPER)
def test_pages_of_the_paper_load_from_disk_alone(
    name: str, browser: Browser, tmp_path: Path
) -> None:
    analysis, text = paged(ROOT / "input_decks" / f"{name}.dat")
    path = write(tmp_path / "page.html", text)
    assert path.stat().st_size < 1_200_000
    browser.open(path)
    assert browser.requests() == [path.as_uri()]
    browser.run("flexact.play(false); flexact.layer('symbols', false)")
    browser.drawn()
    assert browser.console() == []
    pixels = browser.pixels()
    assert changed(pixels, np.broadcast_to(pixels[3, pixels.shape[1] // 2], pixels.shape)) > 2000
    head = browser.run("return document.querySelector('header').innerText")
    assert str(verdict_in_words(analysis)) in " ".join(head.split())
    assert Path(name).name in head


def test_what_can_be_done_begins_with_the_steps_of_the_advice(
    browser: Browser, tmp_path: Path
) -> None:
    analysis = browser.show(ROOT / "input_decks/flexures/double_parallel_guide.dat", tmp_path)
    steps = browser.run(
        "return Array.from(document.querySelectorAll('#remedies > ol > li'), e => e.textContent)"
    )
    assert steps == [step.statement for step in analysis.advice()[:3]]
    assert not browser.run("return document.querySelector('#remedies details').open")
    todo = browser.run("return document.querySelector('.todo').textContent")
    assert todo.startswith("Do this, and the mechanism is exactly constrained: cut the inner left")


#: Calls to mark members in the drawing.
MARKED = """
    window.marked = [];
    const { members } = flexact, mark = members.mark.bind(members);
    members.mark = (rows) => {
      marked.push(rows.map((row) => members.data.members.names[row]));
      mark(rows);
    };
"""


def test_a_body_lights_up_what_holds_it_and_tells_how_often(
    browser: Browser, tmp_path: Path
) -> None:
    """The stage hangs on both inner sheets, which stop its rotation about x twice."""
    browser.show(ROOT / "input_decks/flexures/double_parallel_guide.dat", tmp_path)
    line = browser.run(
        "return Array.from(document.querySelectorAll('.held li'), e => e.textContent)"
        ".find((each) => each.startsWith('stage'))"
    )
    assert line == "stage: rx held twice; y, z, ry, rz once; x declared."
    browser.run(MARKED)
    holding = {"inner left, intermediate to stage", "inner right, intermediate to stage"}
    link = "Array.from(document.querySelectorAll('.held .link')).find(e => e.innerText === 'stage')"
    enter = f"{link}.dispatchEvent(new PointerEvent('pointerenter')); return marked.at(-1)"
    assert set(browser.run(enter)) == holding
    assert browser.run("return flexact.bodies.marks[0].visible")
    browser.run(f"{link}.dispatchEvent(new PointerEvent('pointerleave'))")
    assert browser.run("return marked.at(-1)") == []
    # The same where the body itself is pointed at, away from its nodes.
    browser.run("flexact.showStress(-1)")
    browser.run("document.querySelector('.stage').scrollIntoView({ behavior: 'instant' })")
    browser.drawn()
    spot = browser.run(
        "const { stage, data, bodies, pointing } = flexact;"
        "const body = data.bodies.names.indexOf('stage');"
        "const found = [];"
        "for (let x = 5; x < stage.width; x += 7) for (let y = 5; y < stage.height; y += 7) {"
        "  const { kind, row } = pointing.look(x, y) || {};"
        "  if (kind === 'body' && row === body) found.push([x, y]); }"
        "return found[found.length >> 1]"
    )
    browser.point(*spot)
    assert set(browser.run("return marked.at(-1)")) == holding
    tip = browser.run("return document.querySelector('.tip').innerText").splitlines()
    assert tip == ["stage", "rigid body", line.removeprefix("stage: ")]
    assert browser.run("return document.querySelectorAll('.held .link.lit').length") == 1
    assert browser.console() == []


def test_folds_are_folded_away_in_the_list_of_motions(browser: Browser, tmp_path: Path) -> None:
    """Of six motions five are folds, which turn while nothing else moves."""
    deck = ROOT / "input_decks/flexures/five_folded_sheets_undeclared.dat"
    assert browser.show(deck, tmp_path).under_constrained == 6
    seen = "return Array.from(document.querySelectorAll('#motions .mode')).filter("
    seen += "(each) => each.checkVisibility()).length"
    assert browser.run(seen) == 1
    folded = "document.querySelector('#motions .folded')"
    assert browser.run(f"return {folded}.querySelector('summary').innerText") == "+ 5 folds"
    browser.run(f"{folded}.open = true")
    assert browser.run(seen) == 6
    browser.press("#motions .folded .show")
    assert "fold" in browser.run(
        "return document.querySelector('#motions .folded .parts').innerText"
    )
    assert browser.run("return flexact.movement.title").startswith("Motion ")


def test_a_misalignment_colours_the_sheets_and_lowers_the_frequency(
    browser: Browser, tmp_path: Path
) -> None:
    """As `flexact cost` says: 48.7 um lower the first frequency by 5 %, at 130.8 um it buckles."""
    analysis = flexact.analyse(ROOT / "input_decks" / "paper" / "six_folded_sheets.dat")
    made = page(analysis, misaligned=quick_curve(analysis))
    browser.open(write(tmp_path / "page.html", made))
    tightest = flexact.cost(flexact.read(analysis.name)).tightest
    assert tightest is not None
    size, critical = tightest.tightest.value, tightest.critical.value
    told = "return document.querySelector('.misaligned output').textContent"
    assert browser.run(told).endswith("(100 %), up to 0 MPa")

    def slide(to: float) -> str:
        browser.run(
            "const slider = document.querySelector('.misaligned input');"
            "slider.value = arguments[0];"
            "slider.dispatchEvent(new Event('input', { bubbles: true }))",
            to,
        )
        browser.drawn()
        return str(browser.run(told))

    before = browser.pixels()
    words = slide(size)
    assert "first frequency" in words and "(95 %)" in words
    (stress,) = re.findall(r"up to ([\d.]+) MPa", words)
    assert f"with {float(stress):.1f} MPa" in quick_cost(analysis)
    assert changed(before, browser.pixels()) > 1000
    assert browser.run("return flexact.stress === null")
    legend = browser.run("return document.querySelector('.legend').innerText").splitlines()
    assert legend[:2] == ["largest normal stress [MPa]", "0"]
    assert float(legend[2]) == pytest.approx(float(stress) * abs(critical) / size, rel=0.01)
    assert "it buckles" in slide(1.0)
    browser.press('[name="stress"][value="0"]')
    assert browser.run(told).startswith("0 ")
    assert browser.console() == []


def test_the_colours_of_a_misalignment_end_at_the_strength(
    browser: Browser, tmp_path: Path
) -> None:
    """At the tolerance the part of the strength is one over the safety that a cost tells."""
    deck = ROOT / "input_decks" / "flexures" / "parallel_guide_width_as_y.dat"
    analysis = flexact.analyse(deck)
    browser.open(write(tmp_path / "page.html", page(analysis, misaligned=quick_curve(analysis))))
    made = flexact.cost(flexact.read(deck), strength=True, release=())
    assert made.tightest is not None
    safety = made.as_built.safety(made.tightest)
    assert safety is not None
    told = browser.run(
        "const slider = document.querySelector('.misaligned input');"
        "slider.value = arguments[0];"
        "slider.dispatchEvent(new Event('input', { bubbles: true }));"
        "return document.querySelector('.misaligned output').textContent",
        made.tightest.tightest.value,
    )
    (share,) = re.findall(r"MPa, ([\d.]+) % of the strength$", told)
    # The one is the normal stress, the other that of von Mises.
    assert float(share) == pytest.approx(100.0 / safety.value, rel=0.1)
    browser.drawn()
    legend = browser.run("return document.querySelector('.legend').innerText").splitlines()
    assert legend[:3] == ["largest normal stress [MPa]", "0", "450"]
    assert "the colours end at the strength" in " ".join(legend)
    assert browser.console() == []


def test_a_broken_deck_has_a_page(browser: Browser, tmp_path: Path) -> None:
    path = ROOT / "input_decks" / "broken" / "ten_mistakes.dat"
    with pytest.raises(flexact.DeckError) as caught:
        flexact.read(path)
    browser.open(write(tmp_path / "page.html", broken_page(caught.value, str(path))))
    assert browser.console() == []
    assert "Cannot be analysed: 10 errors" in browser.run("return document.body.innerText")
    marks = browser.run("return Array.from(document.querySelectorAll('mark'), m => m.innerText)")
    assert "TRUS" in marks and "1..0" in marks
    line = browser.run("return document.querySelector('#line-2').nextElementSibling.innerText")
    assert line.startswith("error[unknown-keyword]: TRUS is not a keyword")


def test_a_browser_that_cannot_open_what_draws_says_so(browser: Browser, tmp_path: Path) -> None:
    path = write(tmp_path / "page.html", paged(ROOT / SHARED)[1])
    older = {"source": "delete window.DecompressionStream"}
    added = browser.driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", older)
    try:
        browser.open(path)
    finally:
        browser.driver.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", added)
    told = browser.run("return document.querySelector('.too-old').textContent")
    assert all(each in told for each in ("Chrome", "Firefox 113", "Safari 16.4"))
    assert not browser.run("return document.querySelector('.still').hidden")
    browser.run("document.querySelector('#theme').click()")
    assert browser.run("return document.documentElement.dataset.theme") == "dark"
    assert not [line for line in browser.console() if line.startswith("SEVERE")]


def test_every_switch_changes_the_picture(browser: Browser, tmp_path: Path) -> None:
    browser.show(folded_sheet(clamped=True), tmp_path)
    at_rest = browser.pixels()
    switches = (
        '[name="movement"][value=""]',
        '[name="stress"][value="0"]',
        '[data-layer="diagram"]',
        '[data-layer="elements"]',
        '[data-layer="nodes"]',
        '[data-layer="symbols"]',
        '[data-view="front"]',
        '[data-view="right"]',
        '[data-view="top"]',
        '[data-view="iso"]',
        '[name="movement"][value="0"]',
        '[data-layer="ghost"]',
        '[data-layer="arrows"]',
        '[name="stress"][value=""]',
    )
    for switch in switches:
        browser.press(switch)
        seen = browser.pixels()
        assert changed(at_rest, seen) > 20, switch
        at_rest = seen
    assert browser.console() == []


def test_quantities_of_a_self_stress_change_the_colours(browser: Browser, tmp_path: Path) -> None:
    analysis = browser.show(ROOT / "input_decks/paper/six_folded_sheets.dat", tmp_path)
    assert analysis.over_constrained == 1
    seen = browser.pixels()
    assert browser.run("return flexact.quantity") == "in-plane moment"
    assert browser.run("return document.querySelector('.legend').checkVisibility()")
    assert browser.run("return document.querySelector('.legend-name').innerText").endswith(
        "[N\N{NO-BREAK SPACE}m]"
    )
    browser.press('[name="quantity"][value="twist moment"]')
    assert changed(seen, browser.pixels()) > 1000
    low, high = (
        browser.run("return document.querySelector(arguments[0]).innerText", f".legend-{end}")
        for end in ("low", "high")
    )
    torsion = np.abs(analysis.self_stresses[0].moments[:, 1]).max()
    assert float(high) == pytest.approx(torsion, rel=1e-3)
    assert low == f"\N{MINUS SIGN}{high}"
    # Normal forces and bending across are zero in this self-stress and cannot be chosen.
    enabled = browser.run(
        "return Array.from(document.querySelectorAll('[name=quantity]:enabled'), i => i.value)"
    )
    assert enabled == ["twist moment", "in-plane moment"]


def test_the_colours_agree_with_the_signs(browser: Browser, tmp_path: Path) -> None:
    """Fig. 2(a): half of the bars carry tension, half compression, all as much."""
    analysis = browser.show(twelve_trusses(), tmp_path)
    browser.press('[name="stress"][value="0"]')
    first = browser.run(
        "const {paint, plan} = flexact.members;"
        "return Array.from({length: 12}, (_, m) => "
        "Array.from(paint.array.slice(4 * plan.vertex[m], 4 * plan.vertex[m] + 3)))"
    )
    force = analysis.self_stresses[0].forces[:, 0]
    red, blue = [180, 4, 38], [59, 76, 192]
    assert first == [red if value > 0 else blue for value in force]


def test_the_movement_plays_a_cycle_and_pauses(browser: Browser, tmp_path: Path) -> None:
    browser.show(folded_sheet(clamped=True), tmp_path)
    browser.press(".play")
    phases = browser.later(
        "const done = arguments[0], phases = [], end = performance.now() + 4500;"
        "flexact.player.speed = 0.5;"
        "(function look() { phases.push(flexact.player.phase);"
        "performance.now() < end ? requestAnimationFrame(look) : done(phases); })();"
    )
    assert max(phases) > 0.95 and min(phases) < -0.95
    one, other = browser.pixels(), browser.pixels()
    for _ in range(20):
        other = browser.pixels()
        if changed(one, other) > 200:
            break
    assert changed(one, other) > 200
    browser.press(".play")
    frames = browser.run("return flexact.stage.frames")
    one = browser.pixels()
    browser.later("setTimeout(arguments[0], 600)")
    assert changed(one, browser.pixels()) == 0
    assert browser.run("return flexact.stage.frames") == frames, "nothing changed, nothing drawn"


def test_amplitude_and_reduced_motion(browser: Browser, tmp_path: Path) -> None:
    path = write(tmp_path / "page.html", page(flexact.analyse(folded_sheet(clamped=True))))
    browser.prefer(prefers_reduced_motion="reduce")
    browser.open(path)
    playing, phase = browser.run("return [flexact.player.playing, flexact.player.phase]")
    assert playing is False and abs(phase) < 1e-9, "at rest at first"
    browser.run(
        "const a = document.querySelector('.amplitude'); a.value = 100;"
        "a.dispatchEvent(new Event('input', {bubbles: true}))"
    )
    assert browser.run("return flexact.player.phase") == 1
    full = browser.run("return Array.from(flexact.members.shape.corner)")
    browser.run(
        "const a = document.querySelector('.amplitude'); a.value = 0;"
        "a.dispatchEvent(new Event('input', {bubbles: true}))"
    )
    none = browser.run("return Array.from(flexact.members.shape.corner)")
    ghost = browser.run(
        "return Array.from(flexact.members.ghost.children[0].geometry.attributes.position.array)"
    )
    assert np.allclose(none, ghost, atol=1e-6)
    assert np.abs(np.subtract(full, none)).max() > 0.05


def test_the_keyboard_reaches_every_control(browser: Browser, tmp_path: Path) -> None:
    browser.show(ROOT / SHARED, tmp_path)
    wanted = browser.run(
        """
        const controls = 'a[href], button, input, select, summary, [tabindex="0"]';
        window.keyOf = (e) => e.type === "radio" ? "radio " + e.name
            : Array.from(document.querySelectorAll(controls)).indexOf(e);
        return [...new Set(Array.from(document.querySelectorAll(controls))
            .filter((e) => e.checkVisibility() && !e.disabled).map(keyOf))];
        """
    )
    assert len(wanted) > 25
    browser.run("document.activeElement.blur()")
    reached = set()
    for _ in range(len(wanted) + 5):
        browser.keys(Keys.TAB)
        reached.add(browser.run("return keyOf(document.activeElement)"))
        visible = browser.run(
            "const e = document.activeElement; if (e === document.body) return true;"
            "const f = e.matches('.chip input') ? e.nextElementSibling : e;"
            "return getComputedStyle(f).outlineStyle !== 'none'"
        )
        assert visible, "the focus can be seen"
    assert set(wanted) <= reached


def test_keys_of_the_canvas(browser: Browser, tmp_path: Path) -> None:
    browser.show(folded_sheet(clamped=True), tmp_path)
    browser.run("document.querySelector('.canvas').focus({preventScroll: true})")
    state = "const c = flexact.stage.camera; return [...c.position.toArray(), c.zoom]"
    start = browser.run(state)
    for key in (Keys.ARROW_LEFT, Keys.ARROW_RIGHT, Keys.ARROW_UP, Keys.ARROW_DOWN, "+", "-"):
        before = browser.run(state)
        browser.keys(key)
        assert not np.allclose(browser.run(state), before, atol=1e-4), key
    browser.keys("+", "+", "0")
    assert np.allclose(browser.run(state), start, atol=1e-6)
    browser.keys(" ")
    assert browser.run("return flexact.player.playing")


VIEWED = ("paper/six_folded_sheets", "linkages/bennett", "flexures/planar_parallel_guide")


def free_room(browser: Browser) -> np.ndarray:
    """Pixels left free at the left, right, top and bottom, in the whole cycle."""
    browser.run("document.querySelector('.overlay').hidden = true; flexact.play(false)")
    # A picture of an element ends where the window does.
    browser.run(
        "document.querySelector('.stage').scrollIntoView({block: 'center', behavior: 'instant'})"
    )
    browser.drawn()
    inked = np.False_
    for phase in (-1, 0, 1):
        browser.run("flexact.movePhase(arguments[0])", phase)
        browser.drawn()
        pixels = browser.pixels()[4:-4, 4:-4].astype(int)
        inked = inked | (np.abs(pixels - pixels[0, 0]).max(axis=2) > 12)
    # Below the canvas are the axes and the scale.
    inked = inked[1 : round(browser.run("return flexact.stage.height")) - 1]
    rows, columns = np.flatnonzero(inked.any(axis=1)), np.flatnonzero(inked.any(axis=0))
    height, width = inked.shape
    room = (columns[0], width - 1 - columns[-1], rows[0], height - 1 - rows[-1])
    return np.array(room) + 4


@pytest.mark.parametrize("name", VIEWED)
@pytest.mark.parametrize("width", [360, 1280])
def test_views_are_filled_by_what_is_drawn(
    name: str, width: int, browser: Browser, tmp_path: Path
) -> None:
    browser.resize(width, 900)
    browser.show(ROOT / "input_decks" / f"{name}.dat", tmp_path)
    views = browser.run(
        "return Array.from(document.querySelectorAll('[data-view]'),b => b.dataset.view)"
    )
    for view in (None, *views):
        if view:
            browser.press(f'[data-view="{view}"]')
        left, right, top, bottom = free_room(browser)
        # Boxes round hinges and arrows are a little larger than these are.
        assert min(left, right, top, bottom) >= 10, view
        assert max(left, right) <= 26 or max(top, bottom) <= 26, view
        assert abs(left - right) <= 12 and abs(bottom - top) <= 12, view


def test_fit_comes_back_and_turning_does_not_jump(browser: Browser, tmp_path: Path) -> None:
    browser.show(ROOT / "input_decks/paper/six_folded_sheets.dat", tmp_path)
    state = (
        "const {camera, controls} = flexact.stage;"
        "return [...camera.position.toArray(), ...controls.target.toArray(), camera.zoom]"
    )
    start = browser.run(state)
    browser.run("flexact.stage.turn(0.01, 0.01)")
    turned = browser.run(state)
    assert np.allclose(turned[3:], start[3:], atol=1e-9), "target and zoom stay"
    assert 0 < np.linalg.norm(np.subtract(turned[:3], start[:3])) < 0.2
    browser.press('[name="movement"][value="0"]')
    browser.resize(1000, 700)
    assert np.allclose(browser.run(state)[3:], start[3:], atol=1e-9), "a chosen view stays"
    browser.press(".fit")
    browser.resize(1280, 900)
    fitted = browser.run(state)
    browser.run("flexact.stage.shift(0.3, 0.2); flexact.stage.zoom(2)")
    browser.press(".fit")
    assert np.allclose(browser.run(state), fitted, atol=1e-6), "a fitted one follows the window"


def test_the_caption_says_how_far_it_is_drawn(browser: Browser, tmp_path: Path) -> None:
    """A rotation of 1 rad limits bending at a fold and torsion, else it is a tenth of the size."""
    reach = (
        "const at = () => [...flexact.pose.position, ...flexact.members.shape.centre];"
        "flexact.movePhase(0); const start = at(); let far = 0;"
        "for (const phase of [-1, 1]) { flexact.movePhase(phase); const end = at();"
        "for (let i = 0; i < end.length; i += 3) far = Math.max(far, Math.hypot("
        "end[i] - start[i], end[i + 1] - start[i + 1], end[i + 2] - start[i + 2])); }"
        "return 100 * far"
    )
    for name, movement, known in (
        ("paper/six_folded_sheets", 0, (9.9, 10.1)),
        ("paper/six_folded_sheets", 1, (1, 9)),
        ("paper/folded_sheet_free", 2, (0, 0)),
    ):
        browser.show(ROOT / "input_decks" / f"{name}.dat", tmp_path)
        browser.press(f'[name="movement"][value="{movement}"]')
        caption = browser.run("return document.querySelector('.shown').innerText")
        told = re.search(
            r"with (?:no displacements|displacements up to (\S+)\s% of the model's size)", caption
        )
        assert told, caption
        share = float(told[1] or 0)
        assert known[0] <= share <= known[1]
        assert share == pytest.approx(browser.run(reach), rel=0.05, abs=1e-3)
        assert ("rotations up to 1\N{NO-BREAK SPACE}rad." in caption) == (movement > 0)


def test_the_plane_stays_the_plane(browser: Browser, tmp_path: Path) -> None:
    browser.show(ROOT / "input_decks/flexures/planar_parallel_guide.dat", tmp_path)
    assert browser.run("return document.querySelectorAll('[data-view]').length") == 0
    browser.run("document.querySelector('.canvas').focus({preventScroll: true})")
    browser.keys(Keys.ARROW_LEFT, Keys.ARROW_UP)
    towards = browser.run(
        "return flexact.stage.camera.position.clone().sub(flexact.stage.controls.target).toArray()"
    )
    assert np.allclose(towards[:2], 0, atol=1e-9)
    corners = browser.run("return Array.from(flexact.members.shape.corner)")
    assert not np.any(np.reshape(corners, (-1, 3))[:, 2])


def test_rows_and_drawing_light_each_other(browser: Browser, tmp_path: Path) -> None:
    browser.show(ROOT / SHARED, tmp_path)
    browser.press('[name="movement"][value=""]')
    before = browser.pixels()
    row = "#stresses tr[data-element='1'] .link"
    browser.run("document.querySelector(arguments[0]).focus({preventScroll: true})", row)
    browser.drawn()
    assert changed(before, browser.pixels()) > 500
    browser.run("document.activeElement.blur()")
    browser.drawn()
    assert changed(before, browser.pixels()) == 0
    x, y = browser.run(
        "const {plan, shape} = flexact.members; const s = 3 * (plan.station[0] + 6);"
        "return flexact.stage.project(...shape.centre.subarray(s, s + 3))"
    )[:2]
    browser.point(round(x), round(y))
    tip = browser.run("return document.querySelector('.tip').innerText")
    assert tip.startswith("Element 1 \N{LEFT DOUBLE QUOTATION MARK}first sheet, ground to fold")
    assert "BEAM, sheet" in tip
    lit = browser.run(
        "return Array.from(document.querySelectorAll('tr.lit'), r => r.dataset.element)"
    )
    assert lit and set(lit) == {"1"}
    assert changed(before, browser.pixels()) > 500


def test_the_tip_tells_values_of_the_self_stress(browser: Browser, tmp_path: Path) -> None:
    analysis = browser.show(twelve_trusses(), tmp_path)
    browser.press('[name="movement"][value=""]')
    browser.press('[name="stress"][value="0"]')
    lines = browser.run("return flexact.describe({kind: 'member', row: 3})")
    value = float(
        re.fullmatch(r"normal force: (\S+) N", lines[-1])[1].replace("\N{MINUS SIGN}", "-")
    )
    assert value == pytest.approx(analysis.self_stresses[0].forces[3, 0], rel=1e-3)
    lines = browser.run("return flexact.describe({kind: 'node', row: 0})")
    assert lines == ["Node 1", "held: x, y, z"]


@pytest.mark.parametrize("width", [360, 768])
def test_narrow_windows_do_not_scroll_sideways(
    width: int, browser: Browser, tmp_path: Path
) -> None:
    for name in ("six_folded_sheets", "folded_sheet_free", "twelve_trusses"):
        browser.show(ROOT / "input_decks/paper" / f"{name}.dat", tmp_path)
        browser.resize(width, 800)
        browser.run("document.querySelectorAll('details').forEach(d => { d.open = true; })")
        sizes = browser.run(
            "const r = document.documentElement; return [r.scrollWidth, r.clientWidth]"
        )
        assert sizes[0] <= sizes[1] <= width
        assert browser.run("return document.querySelector('.canvas').clientWidth") > 0.8 * sizes[1]


def test_light_and_dark(browser: Browser, tmp_path: Path) -> None:
    path = write(tmp_path / "page.html", page(flexact.analyse(twelve_trusses())))
    shades = []
    for scheme in ("light", "dark"):
        browser.prefer(prefers_color_scheme=scheme)
        browser.open(path)
        shades.append(browser.pixels("header").mean())
        pressed = browser.run("return document.querySelector('#theme').ariaPressed")
        assert pressed == str(scheme == "dark").lower()
    assert shades[0] > 180 and shades[1] < 80
    browser.press("#theme")
    assert browser.pixels("header").mean() > 180


def test_text_of_a_deck_is_text(browser: Browser, tmp_path: Path) -> None:
    bad = "<script>window.hit=1</script><img src=x onerror=window.hit=2>\"'&amp;</script><!--"
    deck = (ROOT / SHARED).read_text(encoding="utf-8")
    lines = deck.replace("first sheet, ground to fold", bad)
    assert lines != deck
    folder = tmp_path / "<b onclick=window.hit=3>&amp;\"'"
    folder.mkdir()
    source = write(folder / "<script>window.hit=4<\N{DIVISION SLASH}script>.dat", lines)
    browser.show(source, tmp_path)
    assert browser.console() == []
    assert browser.run("return window.hit === undefined")
    shown = browser.run("return document.body.innerText")
    assert source.name in browser.run("return document.querySelector('header').innerText")
    browser.run("document.querySelectorAll('details').forEach(d => { d.open = true; })")
    shown = browser.run("return document.body.textContent")
    assert shown.count(bad) >= 2, "in the deck and in a table"
    browser.run("document.querySelector('#stresses .link').focus({preventScroll: true})")
    names = browser.run("return flexact.describe({kind: 'member', row: 0})[0]")
    assert bad in names
    assert str(tmp_path) not in path_free(tmp_path / "page.html")


def path_free(path: Path) -> str:
    return path.read_text(encoding="utf-8")


def test_a_page_of_many_members_turns_without_new_shapes(browser: Browser, tmp_path: Path) -> None:
    model = flexact.Model(name="many")
    for i in range(50):
        for j in range(50):
            a, b, c = (model.node(i + x, j, z) for x, z in ((0, 0), (0.3, 1), (0.9, 1)))
            model.sheet(a, b, (1, 0, -0.3))
            model.sheet(b, c, (0, 0, 1))
            model.fix(a)
    analysis = browser.show(model, tmp_path)
    assert analysis.data.arrays.element_number.size == 5000
    work = "return [flexact.members.computed, flexact.stage.frames]"
    computed, frames = browser.run(work)
    before = browser.pixels()
    browser.run("document.querySelector('.canvas').focus({preventScroll: true})")
    browser.keys(Keys.ARROW_LEFT, Keys.ARROW_LEFT, Keys.ARROW_UP)
    after, more = browser.run(work)
    assert after == computed, "turning computes no shape anew"
    assert more > frames
    assert changed(before, browser.pixels()) > 5000
    # While something turns that is slow to draw, far fewer triangles do.
    count = "return flexact.members.solids.reduce((n, s) => n + s.geometry.index.count / 3, 0)"
    full = browser.run(f"flexact.stage.lighten(false); {count}")
    light = browser.run(f"flexact.stage.lighten(true); {count}")
    assert full <= 400_000 and light <= 40_000
    assert browser.run(work)[0] == computed
    # Few meshes, however many members.
    assert browser.run("return flexact.stage.renderer.info.render.calls") < 30


def test_paper_page_is_small_and_ready_at_once(browser: Browser, tmp_path: Path) -> None:
    analysis = flexact.analyse(ROOT / "input_decks/paper/five_folded_sheets.dat")
    assert (analysis.rows, analysis.columns) == (35, 35)
    path = write(tmp_path / "page.html", page(analysis))
    assert path.stat().st_size <= 5_000_000
    # Everything is there when the page has loaded: nothing waits for a timer.
    browser.driver.get(path.as_uri())
    assert browser.run("return flexact.data.movements.length === 6")
    assert not browser.run("return document.querySelector('.play').disabled")


def test_without_webgl_the_still_picture_stays(tmp_path: Path) -> None:
    from flexact.show.picture import has_packages, picture_bytes

    if not has_packages():
        pytest.skip("needs matplotlib")
    analysis = flexact.analyse(twelve_trusses())
    path = write(tmp_path / "page.html", page(analysis, picture_bytes(analysis, ".png")))
    with browsing("--disable-gpu", "--disable-3d-apis") as plain:
        plain.open(path)
        image = "const i = document.querySelector('.still img'); "
        assert plain.run(f"{image} return i.checkVisibility() && i.naturalWidth > 300")
        assert "self-stress" in plain.run(f"{image} return i.alt")
        assert not plain.run("return document.querySelector('.interactive').checkVisibility()")
        assert plain.run("return document.querySelectorAll('.show').length") > 0
        shown = "return document.querySelector('.show').checkVisibility()"
        assert not plain.run(shown), "what would move nothing is not offered"


def test_printed_page_holds_a_still_and_all_tables(browser: Browser, tmp_path: Path) -> None:
    browser.show(ROOT / SHARED, tmp_path)
    browser.prefer(prefers_color_scheme="dark")
    browser.run("window.dispatchEvent(new Event('beforeprint'))")
    assert browser.run("return document.querySelectorAll('details:not([open])').length") == 0
    inked = browser.run(
        "const c = document.querySelector('.on-paper');"
        "const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;"
        "let n = 0; for (let i = 3; i < d.length; i += 4) n += d[i] > 0; return n"
    )
    assert inked > 5000
    assert browser.run("return document.documentElement.dataset.theme") == "light"
    browser.run("window.dispatchEvent(new Event('afterprint'))")
    assert browser.run("return document.documentElement.dataset.theme === undefined")
    printed = browser.driver.print_page()
    assert len(printed) > 20_000
