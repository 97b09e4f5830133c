# SPDX-License-Identifier: BSD-3-Clause
"""Clicks in a watched page, in a real browser: what they change, say and write."""

import json
import threading
import time
from collections.abc import Callable, Iterator
from http.client import HTTPConnection
from pathlib import Path
from typing import Any

import pytest
from browser import Browser, browser, chromium  # noqa: F401
from reference_decks import ROOT

import flexact
from flexact.watching.watch import Heard, Watch

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


def until(what: Callable[[], Any], longest: float = 60.0) -> Any:
    """What is true sooner or later."""
    end = time.monotonic() + longest
    while not (found := what()):
        assert time.monotonic() < end, "it did not come"
        time.sleep(0.03)
    return found


class Watched:
    """A watch that runs in a thread, and requests to it."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.said: list[str] = []
        self.watch = Watch(str(path), Heard(lambda words, _: self.said.append(words), print))
        self.address = self.watch.server.address
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()
        until(lambda: self.said)

    def _run(self) -> None:
        try:
            self.watch.run()
        except OSError:
            pass  # its sockets were closed

    def save(self, text: str) -> None:
        """Save the file, and wait until it is read."""
        before = len(self.said)
        self.path.write_text(text)
        until(lambda: len(self.said) > before)

    def send(
        self, body: bytes, token: str | None = None, **headers: str
    ) -> tuple[int, dict[str, Any] | str]:
        """Status and answer of a request."""
        server = self.watch.server
        line = HTTPConnection("127.0.0.1", server.server_port, timeout=60)
        own = {"Origin": f"http://127.0.0.1:{server.server_port}", **headers}
        line.request("POST", f"/{token or server.token}/edit", body, own)
        answer = line.getresponse()
        words = answer.read().decode()
        is_json = "json" in answer.headers["Content-Type"]
        return answer.status, json.loads(words) if is_json else words

    def ask(self, **request: Any) -> Any:
        return self.send(json.dumps(request).encode())[1]


@pytest.fixture
def watched(tmp_path: Path) -> Iterator[Callable[[str, str], Watched]]:
    made: list[Watched] = []

    def watch(name: str, text: str) -> Watched:
        path = tmp_path / name
        path.write_text(text)
        made.append(Watched(path))
        return made[-1]

    yield watch
    for each in made:
        each.watch.server.shutdown()
        each.watch.close()


class Page:
    """The panel of a watched page, as a person uses it."""

    def __init__(self, browser: Browser, watched: Watched) -> None:
        self.browser, self.watched = browser, watched
        browser.driver.get("about:blank")
        browser.console()
        browser.driver.get(watched.address)
        until(lambda: browser.run("return Boolean(window.flexact && switches.told)"))
        browser.run("flexact.play(false)")

    def key(self, key: str) -> Any:
        return self.browser.run(
            "return Array.from(document.querySelectorAll('[data-key]'))"
            ".find((each) => each.dataset.key === arguments[0])",
            key,
        )

    def click(self, key: str) -> None:
        until(lambda: self.key(key)).click() if "element" not in key else self.toggle(key)

    def toggle(self, key: str) -> None:
        found = until(lambda: self.key(key))
        self.browser.run("arguments[0].scrollIntoView({block: 'center'})", found)
        found.click()

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

    def settled(self, changes: int) -> None:
        """Wait for the scene with so many changes."""
        words = f"with {changes} change" if changes else ""
        until(
            lambda: (
                (
                    told := self.browser.run(
                        "return document.querySelector('.live-which').textContent"
                    )
                )
                == words
                or (
                    words
                    and told.endswith(f"{words}{'s' * (changes > 1)} that the file does not have")
                )
            )
        )
        self.browser.drawn()


def test_a_release_is_clicked_on_and_off(
    browser: Browser,
    watched: Callable[[str, str], Watched],  # noqa: F811
) -> None:
    page = Page(browser, watched("guide.dat", DECK))
    page.sees("verdict", "Over-constrained by 1")
    # A click on the sheet itself, in the middle of the drawing of sheet 1.
    page.find("sheet 1")
    page.sees("card", "in-plane bending at its clamp")
    camera = browser.run("return JSON.stringify(live.mounted.view())")
    page.toggle(RELEASED)
    page.sees("verdict", "Over-constrained by 1 \N{RIGHTWARDS ARROW} exactly constrained")
    page.settled(1)
    assert "Exactly constrained" in browser.run("return document.querySelector('h1').innerText")
    assert browser.run("return document.activeElement.dataset.key") == RELEASED
    page.sees("lines", "RLSE 1 2 3 5 6 % as designed")
    page.sees("card", "was held")
    assert browser.run("return JSON.stringify(live.mounted.view().camera)") == json.dumps(
        json.loads(camera)["camera"], separators=(",", ":")
    )
    page.toggle(HELD)
    page.sees("verdict", "exactly constrained".capitalize())
    page.settled(0)
    assert browser.run("return document.querySelector('[data-part=made]').hidden")
    assert browser.console() == []
