# SPDX-License-Identifier: BSD-3-Clause
"""Clicks in a watched page, in a real browser: what they change, say and write."""

import http.client
import json
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from itertools import product
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import pytest
from browser import Browser
from reference_decks import ROOT
from test_page_looks import overlapping
from watched import Watched, until, watching

import flexact
from flexact.analysis.naming import plain

pytestmark = pytest.mark.dear(4)

DECK = (
    "% a guide\nBEAM 1 1 2 3 4 0 1 0 % sheet 1\nBEAM 2 5 6 7 8 0 1 0 % sheet 2\n"
    "BEAM 3 3 4 7 8 % stage\nX 3 0.1 0 0\nX 5 0 0.05 0\nX 7 0.1 0.05 0\nFIX 1\nFIX 2\nFIX 5\n"
    "FIX 6\nRLSE 1 2 5 6 % as designed\nRLSE 2 2 5 6\nDYNX 3 2\n"
)
SCRIPT = """\
import flexact
guide = flexact.Model(name="guide")
for k, y in enumerate((0.0, 0.05), start=1):
    guide.sheet((0, y, 0), (0.1, y, 0), width=(0, 0, 1), name=f"sheet {k}")
    guide.fix((0, y, 0))
guide.body([(0.1, 0, 0), (0.1, 0.05, 0)], name="stage")
guide.independent("stage", "y")
"""
#: In-plane bending of sheet 1 at its clamp, released and held.
RELEASED, HELD = "element 1 3 released", "element 1 3 held"


#: What of the panel reaches out of it.
OUTSIDE = """
    const box = document.querySelector('.switches').getBoundingClientRect();
    return Array.from(document.querySelectorAll('.switches *'))
      .filter((each) => each.offsetParent && !each.closest('pre') && !each.matches('.unseen'))
      .filter((each) => { const own = each.getBoundingClientRect();
        return own.width && (own.left < box.left - 1 || own.right > box.right + 1); })
      .map((each) => each.outerHTML.slice(0, 80))
"""
#: How many switches overlap their words.
OVERLAPPING = """
    return Array.from(document.querySelectorAll('.switch')).filter((row) => {
      const [a, ...chips] = [row.querySelector('legend'), ...row.querySelectorAll('.chip')]
        .map((each) => each.getBoundingClientRect());
      return chips.some((b) => a.left < b.right - 1 && b.left < a.right - 1
        && a.top < b.bottom - 1 && b.top < a.bottom - 1); }).length
"""
#: Whether the panel is beside the drawing.
BESIDE = """
    const at = (name) => document.querySelector(name).getBoundingClientRect();
    return at('.switches').left >= at('.drawing').right
"""


def send(
    watched: Watched, body: bytes, path: str = "edit", token: str | None = None, **headers: str
) -> tuple[int, dict[str, Any] | str]:
    """Status and answer of a request that a page could send."""
    where = urlsplit(watched.address)
    folder = where.path if token is None else f"/{token}/"
    line = http.client.HTTPConnection("127.0.0.1", where.port, timeout=60)
    own = {"Origin": f"http://127.0.0.1:{where.port}", **headers}
    line.request("POST", f"{folder}{path}", body, own)
    answer = line.getresponse()
    words = answer.read().decode()
    is_json = "json" in (answer.headers["Content-Type"] or "")
    line.close()
    return answer.status, json.loads(words) if is_json else words


def ask(watched: Watched, **request: Any) -> Any:
    return send(watched, json.dumps(request).encode())[1]


Watching = Callable[[str, str], Watched]


@pytest.fixture(scope="module")
def watch(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Watching]:
    """Starts to watch a file, each once; it is as at first, without edits."""
    folder = tmp_path_factory.mktemp("watched")
    known: dict[str, Watched] = {}
    with ExitStack() as stack:

        def begin(name: str, text: str) -> Watched:
            file = folder / name
            if name not in known:
                file.write_text(text)
                known[name] = stack.enter_context(watching(file, folder / "state", "--no-browser"))
                until(lambda: len(known[name].out) > 1)
            elif file.read_text() != text:
                save(known[name], file, text)
            ask(known[name], do="reset")
            return known[name]

        yield begin


def save(watched: Watched, file: Path, text: str) -> None:
    """Save a file, and wait until it is read."""
    before = len(watched.out)
    file.write_text(text)
    until(lambda: len(watched.out) > before)


class Page:
    """The panel of a watched page, as a person uses it."""

    def __init__(self, browser: Browser, watched: Watched) -> None:
        self.browser, self.watched = browser, watched
        browser.driver.get("about:blank")
        browser.console()
        browser.driver.get(watched.address)
        browser.run("sessionStorage.clear()")
        until(lambda: browser.run("return Boolean(window.flexact && switches.told)"))
        browser.run("flexact.play(false)")

    def key(self, key: str) -> Any:
        return self.browser.run(
            "return Array.from(document.querySelectorAll('[data-key]'))"
            ".find((each) => each.dataset.key === arguments[0])",
            key,
        )

    def click(self, key: str) -> None:
        """Click where a person would; what is renewed meanwhile is found again."""
        from selenium.common.exceptions import StaleElementReferenceException

        for _ in range(5):
            try:
                found = until(lambda: self.key(key))
                self.browser.run("arguments[0].scrollIntoView({block: 'center'})", found)
                return self.browser.run("arguments[0].click()", found)
            except StaleElementReferenceException:
                continue
        raise AssertionError(f"{key} does not stay")

    def text(self, part: str) -> str:
        words: str = self.browser.run(
            'return document.querySelector(`.switches [data-part="${arguments[0]}"]`).innerText',
            part,
        )
        return words

    def sees(self, part: str, words: str) -> str:
        return str(until(lambda: words in (text := self.text(part)) and text))

    def find(self, name: str) -> None:
        from selenium.webdriver.common.keys import Keys

        box = self.key("find")
        box.clear()
        box.send_keys(name, Keys.ENTER)

    def hides(self, part: str) -> bool:
        hidden: bool = self.browser.run(
            'return document.querySelector(`[data-part="${arguments[0]}"]`).hidden', part
        )
        return hidden

    def focus(self) -> str:
        return str(self.browser.run("return document.activeElement.dataset.key || ''"))

    def type(self, part: str, words: str) -> None:
        self.browser.run(
            'document.querySelector(`[data-part="${arguments[0]}"]`).value = arguments[1]',
            part,
            words,
        )

    def press(self, x: float, y: float) -> None:
        """Press at a place of the window."""
        from selenium.webdriver import ActionChains
        from selenium.webdriver.common.actions.action_builder import ActionBuilder

        builder = ActionBuilder(self.browser.driver)
        builder.pointer_action.move_to_location(round(x), round(y)).click()
        builder.perform()
        ActionChains(self.browser.driver).reset_actions()
        self.browser.drawn()

    def with_control(self, key: str) -> None:
        from selenium.webdriver import ActionChains
        from selenium.webdriver.common.keys import Keys

        chain = ActionChains(self.browser.driver)
        chain.key_down(Keys.CONTROL).send_keys(key).key_up(Keys.CONTROL).perform()

    def rests(self) -> None:
        """Wait until it does not scroll any more."""
        places: list[float] = []

        def same() -> bool:
            places.append(self.browser.run("return scrollY"))
            return len(places) > 5 and len(set(places[-5:])) == 1

        until(same)

    def renewed(self, text: str) -> None:
        """Save the file, and wait for its scene."""
        self.browser.run("window.scene = document.querySelector('.live-scene')")
        save(self.watched, self.watched.file, text)
        until(lambda: self.browser.run("return !scene.isConnected"))
        self.browser.drawn()

    def settled(self, changes: int) -> None:
        """Wait for the scene with so many changes."""
        one = f"with {changes} change{'s' * (changes > 1)} that the file does not have"
        wanted = one if changes else ""
        which = "return document.querySelector('.live-which').textContent"
        until(
            lambda: (
                str(self.browser.run(which)).endswith(wanted)
                and (changes or "change" not in self.browser.run(which))
            )
        )
        self.browser.drawn()


def test_a_release_is_clicked_on_and_off(browser: Browser, watch: Watching) -> None:
    browser.requests()
    page = Page(browser, watch("guide.dat", DECK))
    page.sees("verdict", "Over-constrained by 1")
    browser.run("flexact.stage.turn(0.4, 0.2); flexact.stage.zoom(1.5)")
    looks = "const {eye, target, zoom} = flexact.stage.looks(); return [...eye, ...target, zoom]"
    seen = browser.run(looks)
    page.find("sheet 1")
    page.sees("card", "in-plane bending at its clamp")
    page.click(RELEASED)
    page.sees("verdict", "Over-constrained by 1 \N{RIGHTWARDS ARROW} exactly constrained")
    page.settled(1)
    assert "Exactly constrained" in browser.run("return document.querySelector('h1').innerText")
    assert "over-constrained by 1 \N{RIGHTWARDS ARROW} exactly constrained" in browser.run(
        "return document.querySelector('.live-words').textContent"
    )
    assert browser.run(looks) == pytest.approx(seen, abs=1e-6)
    page.sees("lines", "RLSE 1 2 3 5 6 % as designed")
    page.sees("card", "was held")
    page.click(HELD)
    page.sees("verdict", "Exactly constrained \N{RIGHTWARDS ARROW} over-constrained by 1")
    page.settled(0)
    assert page.hides("made")
    assert browser.console() == []
    # Pages of tests before may still ask for their servers.
    own = ("http://127.0.0.1:", "data:")
    assert all(each.startswith(own) for each in browser.requests())


def test_a_part_and_a_clamp_are_clicked_in_the_drawing(browser: Browser, watch: Watching) -> None:
    page = Page(browser, watch("guide.dat", DECK))
    browser.run("flexact.stage.look('front')")
    browser.drawn()
    x, y = browser.run(
        "const box = flexact.stage.canvas.getBoundingClientRect();"
        "return [box.left + box.width / 2, box.top + box.height / 2]"
    )
    page.press(x, y)
    title = page.sees("card", "BEAM")
    assert title.startswith(("sheet", "The stage"))
    browser.run("flexact.stage.look('iso')")
    page.rests()
    # On the block of the clamp, away from its node.
    clamp = browser.run(
        "const { supports, stage } = flexact;"
        "const { copies, rows } = supports.sets.find(({ rows }) => rows.length);"
        "const copy = rows.findIndex((row) => PageData.array(flexact.data.nodes.number)"
        "[supports.node[row]] === 1);"
        "const matrix = new THREE.Matrix4(); copies.mesh.getMatrixAt(copy, matrix);"
        "copies.mesh.geometry.computeBoundingBox();"
        "const { min, max } = copies.mesh.geometry.boundingBox;"
        "const place = min.clone().lerp(max, 0.85).applyMatrix4(matrix);"
        "const [x, y] = stage.project(...place.toArray());"
        "const box = stage.canvas.getBoundingClientRect();"
        "return [box.left + x, box.top + y]"
    )
    page.press(*clamp)
    page.sees("card", "The clamp of sheet 1")
    page.click("node 2 ry free")
    page.sees("verdict", "exactly constrained")
    page.sees("lines", "FIX 2 2 4")
    page.click("undo")
    page.sees("verdict", "over-constrained by 1")


def test_everything_goes_by_keyboard(browser: Browser, watch: Watching) -> None:
    from selenium.webdriver.common.keys import Keys

    page = Page(browser, watch("guide.dat", DECK))
    browser.run("document.querySelector('[data-key=find]').focus()")
    browser.keys("sheet 1", Keys.ENTER)
    page.sees("card", "in-plane bending at its clamp")
    browser.keys(Keys.TAB)  # the button
    for _ in range(3):  # elongation, twist, in-plane bending at its clamp
        browser.keys(Keys.TAB)
    assert page.focus() == HELD
    browser.keys(Keys.ARROW_RIGHT)
    page.sees("verdict", "exactly constrained")
    page.settled(1)
    # Where it was, though the scene and the switches are new.
    assert page.focus() == RELEASED
    browser.keys(Keys.ARROW_LEFT)
    page.settled(0)
    assert page.focus() == HELD
    page.with_control("z")
    page.settled(1)
    page.with_control("y")
    page.settled(0)


#: Boxes of what is read and pressed, of which none may lie over another.
BOXES = """
    return Array.from(document.querySelectorAll('.which > *, .stage, .shown, .legend, .chip, '
      + '.check, .toolbar button, .toolbar label, .try, .held li, .todo, .margin, #theme, '
      + '.switches > *')).filter((each) => each.checkVisibility())
      .map((each) => each.getBoundingClientRect()).map((b) => [b.left, b.top, b.right, b.bottom]);
"""


def assert_nothing_overlaps(browser: Browser) -> None:
    """In windows of both widths, in light and dark."""
    for width, theme in product((1280, 360), ("light", "dark")):
        browser.prefer(prefers_color_scheme=theme)
        browser.resize(width, 900)
        # What stays in sight lies over what is scrolled below it.
        browser.run("window.scrollTo({ top: 0, behavior: 'instant' })")
        assert browser.run("return document.documentElement.scrollWidth <= innerWidth")
        assert not overlapping(browser.run(BOXES)) and not browser.run(OUTSIDE)


def test_a_step_is_tried_beside_what_was_before_and_undone(
    browser: Browser, watch: Watching
) -> None:
    page = Page(browser, watch("guide.dat", DECK))
    advised = flexact.analyse(flexact.read_text(DECK)).advice()[:3]
    items = "return Array.from(document.querySelectorAll('li[data-step]'), e => e.textContent)"
    assert browser.run(items) == [f"{step.statement} Try" for step in advised]
    page.click("try 1")
    page.sees("verdict", "Over-constrained by 1 \N{RIGHTWARDS ARROW} exactly constrained")
    page.settled(1)
    which = (
        "return Array.from(document.querySelectorAll('.which > :first-child'), e => e.innerText)"
    )
    words = plain(advised[0].pieces)
    assert browser.run(which) == [f"Tried: {words}", "Before: over-constrained by 1"]
    assert browser.run("return drawings.map((each) => each.data.stresses.length)") == [0, 1]
    at = "const at = (side) => document.querySelector(side).getBoundingClientRect();"
    assert browser.run(f"{at} return at('.before-side').right <= at('.after-side').left")
    page.sees("edits", words)
    page.sees("lines", "RLSE")
    assert_nothing_overlaps(browser)
    browser.resize(1280, 900)
    browser.run("document.querySelector('.before-side .which button').click()")
    assert not browser.run("return document.querySelector('.before-side').checkVisibility()")
    browser.run("document.querySelector('.after-side .which button').click()")
    page.sees("verdict", "Exactly constrained \N{RIGHTWARDS ARROW} over-constrained by 1")
    page.settled(0)
    assert browser.run("return document.querySelector('.tried')") is None
    assert "Over-constrained" in browser.run("return document.querySelector('h1').innerText")
    assert_nothing_overlaps(browser)
    assert browser.console() == []


def test_a_step_leaves_a_part_out_and_is_written(browser: Browser, watch: Watching) -> None:
    three = ROOT / "input_decks" / "flexures" / "planar_guide_three_sheets.dat"
    page = Page(browser, watch("three.dat", three.read_text()))
    names = "return new Set(flexact.data.members.names).has('middle sheet')"
    assert browser.run(names)
    page.click("try 1")
    page.sees("verdict", "exactly constrained")
    page.settled(1)
    assert not browser.run(names)
    page.type("name", "three_tried.dat")
    page.click("save")
    page.sees("said", "Written to three_tried.dat")
    written = page.watched.file.with_name("three_tried.dat")
    made = flexact.analyse(written)
    assert made.verdict is flexact.Verdict.EXACT
    assert "middle sheet" not in {part.name for part in made.parts.all}
    written.unlink()


def test_proposals_are_switches(browser: Browser, watch: Watching) -> None:
    page = Page(browser, watch("guide.dat", DECK))
    # Where there are steps, single changes are folded away until they are asked for.
    page.sees("head", "Edit and see")
    opened = (
        "const all = [...document.querySelectorAll('summary')];"
        "const mine = all.find((each) => each.textContent === 'Single changes');"
        "mine.click(); if (!mine.parentNode.open) mine.click(); return mine.parentNode.open;"
    )
    assert browser.run(opened)
    page.sees("proposals", "To remove the self-stress, release one of")
    page.click("proposed element 1 3 release")
    page.sees("verdict", "exactly constrained")
    page.settled(1)
    assert page.text("proposals") == ""
    page.sees("edits", "in-plane bending at its clamp: held \N{RIGHTWARDS ARROW} released")
    page.click("remove element 1 3")
    page.sees("verdict", "over-constrained by 1")
    page.settled(0)
    page.sees("proposals", "free a support")


def test_edits_stay_when_the_deck_is_saved_or_broken(browser: Browser, watch: Watching) -> None:
    watched = watch("guide.dat", DECK)
    file = Path(str(ask(watched, do="tell")["told"]["folder"])) / "guide.dat"
    page = Page(browser, watched)
    page.find("sheet 1")
    page.click(RELEASED)
    page.settled(1)
    save(watched, file, DECK.replace("0.05", "0.06"))
    page.settled(1)
    page.sees("verdict", "xactly constrained")
    save(watched, file, DECK.replace("BEAM 3", "BEAN 3"))
    page.sees("off", "The file has errors")
    assert page.hides("card") and page.hides("singles")
    status, answer = send(watched, b'{"do": "undo"}')
    assert status == 409 and "errors" in answer["error"]  # type: ignore[index]
    save(watched, file, DECK.replace("RLSE 1 2 5 6", "RLSE 1 2 3 5 6"))
    page.sees("said", "The file says so itself now")
    page.settled(0)
    page.sees("verdict", "xactly constrained")


def test_a_new_deck_is_written_and_never_over_another_without_asking(
    browser: Browser, watch: Watching
) -> None:
    watched = watch("guide.dat", DECK)
    folder = Path(str(ask(watched, do="tell")["told"]["folder"]))
    page = Page(browser, watched)
    page.find("sheet 1")
    page.click(RELEASED)
    page.settled(1)
    name = browser.run("return document.querySelector('[data-part=name]').value")
    assert name == "guide_edited.dat"
    page.click("save")
    page.sees("said", "Written to guide_edited.dat")
    made = folder / name
    assert made.read_text() == DECK.replace("RLSE 1 2 5 6", "RLSE 1 2 3 5 6")
    assert flexact.analyse(made).verdict.value == "exactly constrained"
    made.write_text("mine")
    page.type("name", "guide_edited.dat")
    page.click("save")
    page.sees("over", "There is a file guide_edited.dat already. Write over it?")
    page.click("do not write over")
    assert made.read_text() == "mine"
    page.click("save")
    page.sees("over", "Write over it?")
    page.click("write over")
    # The words are still there from the first time.
    until(lambda: "RLSE 1 2 3 5 6" in made.read_text())
    page.type("name", "guide.dat")

    def is_refused() -> bool:
        page.click("save")
        return "is the file that is watched" in page.text("said")

    until(is_refused)
    page.type("name", "../guide.dat")
    page.click("save")
    page.sees("said", "without a folder")
    assert (folder / "guide.dat").read_text() == DECK
    made.unlink()


def test_the_answer_of_the_newest_save_is_told(browser: Browser, watch: Watching) -> None:
    page = Page(browser, watch("guide.dat", DECK))
    page.find("sheet 1")
    page.click(RELEASED)
    page.settled(1)
    browser.run("""
        const send = switches.send;
        window.answers = [];
        switches.send = (request) => request.do !== "save" ? send(request) : new Promise(
          (answer) => answers.push(() => answer({ error: `answer to ${request.name}` })));
    """)
    for name in ("first", "second"):
        page.type("name", name)
        page.click("save")
    # That of the first comes last.
    browser.run("answers.reverse().forEach((each) => each())")
    assert page.sees("said", "Answer to") == "Answer to second"


def test_a_script_is_edited_by_calls_in_its_own_words(browser: Browser, watch: Watching) -> None:
    watched = watch("guide.py", SCRIPT)
    page = Page(browser, watched)
    page.find("sheet 1")
    page.click(RELEASED)
    page.settled(1)
    call = page.sees("lines", "guide.release")
    assert 'guide.release("sheet 1", "in-plane bending", at=(0, 0, 0))' in call
    names: dict[str, Any] = {}
    exec(SCRIPT + call, names)
    assert flexact.analyse(names["guide"]).verdict.value == "exactly constrained"


def test_what_is_copied_are_the_lines(browser: Browser, watch: Watching) -> None:
    watched = watch("guide.dat", DECK)
    page = Page(browser, watched)
    page.find("sheet 1")
    page.click(RELEASED)
    page.sees("lines", "RLSE 1 2 3 5 6")
    browser.run(
        "window.copied = []; navigator.clipboard.writeText = async (text) => copied.push(text)"
    )
    page.click("copy")
    page.sees("said", "Copied.")
    assert browser.run("return copied") == [
        "RLSE 1 2 3 5 6 % as designed   % instead of line 12: RLSE 1 2 5 6 % as designed"
    ]
    browser.run("navigator.clipboard.writeText = async () => { throw new Error('not allowed'); }")
    page.settled(1)
    page.click("copy")
    page.sees("said", "press Ctrl+C")
    marked = (
        "const box = document.activeElement;"
        "return (box.value || '').slice(box.selectionStart, box.selectionEnd)"
    )
    assert browser.run(marked).startswith("RLSE 1 2 3 5 6")
    # It stays marked when the next result comes, and who writes a name can go on.
    page.renewed(DECK + "% again\n")
    assert browser.run(marked).startswith("RLSE 1 2 3 5 6")
    browser.run("document.querySelector('[data-part=name]').focus()")
    page.renewed(DECK)
    assert page.focus() == "save as"


def test_the_panel_fits_and_everything_in_it_has_a_name(browser: Browser, watch: Watching) -> None:
    page = Page(browser, watch("guide.dat", DECK))
    page.find("sheet 1")
    page.click(RELEASED)
    page.settled(1)
    for width, scheme in product((360, 800, 1280), ("light", "dark")):
        browser.prefer(prefers_color_scheme=scheme)
        browser.resize(width, 900)
        assert browser.run(
            "return document.documentElement.scrollWidth <= document.documentElement.clientWidth"
        )
        assert browser.run(OUTSIDE) == []
        assert browser.run(OVERLAPPING) == 0
        assert browser.run(BESIDE) == (width >= 960)
    nameless = browser.run(
        "return Array.from(document.querySelectorAll('.switches button, .switches input'))"
        ".filter((each) => !each.ariaLabel && !each.textContent.trim() && !each.labels?.length)"
        ".length"
    )
    assert nameless == 0
    groups = browser.run(
        "return Array.from(document.querySelectorAll('.switch'))"
        ".map((each) => each.querySelector('legend').textContent)"
    )
    assert len(groups) == 6 and groups[2] == "in-plane bending at its clamp was held"
    assert browser.console() == []


@pytest.mark.parametrize(
    ("body", "status", "words"),
    [
        (b"{", 400, "no JSON"),
        (b"\xff", 400, "no JSON"),
        (b"[1]", 422, "JSON object"),
        (b'{"do": "jump"}', 422, "must be one of"),
        (b'{"do": "look", "element": 99}', 422, "there is no element 99"),
        (b'{"do": "look", "node": 99}', 422, "there is no node 99"),
    ],
)
def test_bad_requests_are_answered_in_words(
    watch: Watching, body: bytes, status: int, words: str
) -> None:
    watched = watch("guide.dat", DECK)
    answered, answer = send(watched, body)
    assert answered == status and isinstance(answer, dict)
    assert words in answer["error"]


def test_only_the_page_itself_may_ask(watch: Watching) -> None:
    watched = watch("guide.dat", DECK)
    request = json.dumps(
        {"do": "set", "set": [{"element": 1, "deformation": 3, "to": "released"}]}
    ).encode()
    refused = (
        send(watched, request, token="0123456789abcdef0123456789abcdef"),
        send(watched, request, Origin="http://example.org"),
        send(watched, request, Host="example.org"),
    )
    assert all(status == 403 and words for status, words in refused)
    assert ask(watched, do="tell")["told"]["edits"] == []
    assert send(watched, request, "elsewhere")[0] == 404
    assert watched.err == [] or "Traceback" not in "".join(watched.err)
