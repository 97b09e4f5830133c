# SPDX-License-Identifier: BSD-3-Clause
"""From the save of a watched deck to its picture in Chromium: prints the table of docs/watching.md.

Usage: .venv/bin/python tests/benchmarks/watching.py, on a machine that does nothing else.
"""

import statistics
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "python"))

from browser import Browser, browsing  # noqa: E402
from watched import until, watching  # noqa: E402

import flexact  # noqa: E402

SAVES = 10
#: Keeps when the next scene was mounted and had been drawn [ms since 1970].
_LISTEN = """
window.seen = null;
document.body.addEventListener("flexact-renewed", () => {
  const frame = (then) => requestAnimationFrame(then);
  frame(() => frame(() => { window.seen = performance.timeOrigin + performance.now(); }));
}, { once: true });
"""


def grid(rows: int, columns: int) -> str:
    """A grid of wires, clamped at a corner, as a deck."""
    model = flexact.Model(name="grid")
    for i in range(rows):
        for j in range(columns):
            for k, m in ((i + 1, j), (i, j + 1)):
                if k < rows and m < columns:
                    model.wire((0.1 * i, 0.1 * j, 0), (0.1 * k, 0.1 * m, 0))
    model.fix((0, 0, 0))
    return model.to_deck()


def times(browser: Browser, text: str, saves: int = SAVES) -> list[float]:
    """Seconds from the save to the picture, of some saves that change the verdict."""
    with tempfile.TemporaryDirectory() as folder:
        deck = Path(folder) / "deck.dat"
        deck.write_text(text)
        changed = text.replace("\nFIX", "\nRLSE 1 1\nFIX", 1)
        with watching(deck, Path(folder) / "state", "--no-browser") as watched:
            until(lambda: len(watched.out) > 1)
            browser.driver.get(watched.address)
            time.sleep(3.0)
            found = []
            for number in range(saves):
                browser.run(_LISTEN)
                saved = time.time()
                deck.write_text(text if number % 2 else changed)
                # Whoever asks often has the browser answer instead of drawing.
                time.sleep(1.5)
                until(lambda: browser.run("return window.seen"))
                found.append(browser.run("return window.seen") / 1000 - saved)
            return found


def main() -> None:
    """Print the rows."""
    five = ROOT / "input_decks" / "paper" / "five_folded_sheets.dat"
    decks = {
        "five folded sheets, D(c) of 35 x 35": five.read_text(),
        "a grid of 35 x 35 nodes, 2,380 beams": grid(35, 35),
        "a grid of 50 x 51 nodes, 4,999 beams": grid(50, 51),
    }
    print("| deck | median | slowest of ten |\n|---|---|---|")
    with browsing() as browser:
        for name, text in decks.items():
            found = times(browser, text)
            print(f"| {name} | {statistics.median(found):.2f} s | {max(found):.2f} s |")


if __name__ == "__main__":
    main()
