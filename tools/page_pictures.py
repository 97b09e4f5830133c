#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draw the pictures of docs/ that commands of a page make, by these commands. By `make gallery`."""

from __future__ import annotations

import io
import os
import re
import shlex
import shutil
import sys
import tempfile
import textwrap
import time
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from flexact import analyse
from flexact.apps.cli.main import main as flexact
from flexact.show.drawing import drawing_of
from flexact.show.drawing.view import view_of
from flexact.show.picture.figure import compose
from flexact.show.picture.files import load_matplotlib, still_bytes
from flexact.show.picture.subject import Chosen, subjects_of

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "python"))
from browser import browsing  # noqa: E402
from page_sessions import given_files, steps  # noqa: E402  # what a page gives and runs
from watched import Watched  # noqa: E402

DOCS = ROOT / "docs"
README = (ROOT / "README.md").read_text(encoding="utf-8")
#: By page: what its commands write, and what it is called beside the page.
PICTURES = {
    "tutorial.md": {"guide.png": "tutorial_guide.png", "mended.png": "tutorial_mended.png"},
    "for_those_who_know_fact.md": {
        "spaces.png": "fact_spaces.png",
        "explain.png": "fact_explain.png",
    },
}


def draw(page: str) -> None:
    """Run what a page runs up to its pictures, and put these beside it."""
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for name, text in given_files(DOCS / page).items():
            Path(name).write_text(text, encoding="utf-8")
        for words, _ in steps(DOCS / page):
            if " -o " in words:
                flexact(shlex.split(words))
        for written, kept in PICTURES[page].items():
            shutil.copy(written, DOCS / kept)
        os.chdir(ROOT)


#: The window in which the watched page is shown, and the picture made of it.
_WINDOW, _WIDTH = (1180, 760), 900
#: Frames of the motion, how long each stands and how long the wrong guide does [ms].
_FRAMES, _EACH, _BEFORE, _PRESSED = 22, 150, 2000, 700


def film_the_watched_page() -> None:
    """Show README's guide in `flexact watch`, press "Try" of its first step, and let it move."""
    (text,) = re.findall(r"(?:^    .*\n)+", README.partition("name [parts]")[2], re.MULTILINE)[:1]
    with tempfile.TemporaryDirectory() as folder, browsing() as browser:
        deck = Path(folder, "guide.dat")
        deck.write_text(textwrap.dedent(text), encoding="utf-8")
        watched = Watched(deck, Path(folder))

        def taken() -> Image.Image:
            shot = Image.open(io.BytesIO(browser.driver.get_screenshot_as_png())).convert("RGB")
            return shot.resize((_WIDTH, _WIDTH * shot.height // shot.width), Image.LANCZOS)

        try:
            browser.resize(*_WINDOW)
            browser.driver.get(watched.address)
            time.sleep(5.0)
            frames, stand = [taken()], [_BEFORE]
            at = browser.run(
                "const b = document.querySelector('.try').getBoundingClientRect();"
                "return [(b.left + b.right) / 2, (b.top + b.bottom) / 2, innerWidth]"
            )
            x, y = (_WIDTH / at[2] * each for each in at[:2])
            pressed = frames[0].copy()
            ImageDraw.Draw(pressed).ellipse(
                (x - 20, y - 20, x + 20, y + 20), outline="#d97706", width=4
            )
            frames.append(pressed)
            stand.append(_PRESSED)
            browser.press(".try")
            time.sleep(4.0)
            for _ in range(_FRAMES):
                frames.append(taken())
                stand.append(_EACH)
        finally:
            watched.process.terminate()
    small = [frame.quantize(64, dither=Image.Dither.NONE) for frame in frames]
    film = DOCS / "watched_page.gif"
    small[0].save(
        film, save_all=True, append_images=small[1:], duration=stand, loop=0, optimize=True
    )


def draw_one_body() -> None:
    """Draw each body of a page on its wires, with its freedom space, and put all side by side."""
    page = (DOCS / "one_body_and_its_wires.md").read_text(encoding="utf-8")
    names: dict[str, Any] = {}
    exec(re.findall(r"```python\n(.*?)```", page, re.DOTALL)[0], names)
    rows = re.findall(r"^\| (\d+) \| (\dR \dT) \| `(.*?)`", page, re.MULTILINE)
    passing = re.findall(r'print\(free\(body_on\("(.*?)"', page)[-1]
    across, size, seen = 6, 230, (np.full(2, -0.125), np.full(2, 0.125))
    sheet = Image.new("RGB", (across * size, -(-(len(rows) + 1) // across) * size), "white")
    words = ImageFont.load_default(size=14)
    load_matplotlib()
    for place, (number, cell, wires) in enumerate([*rows, ("", "passing", passing)]):
        result = analyse(names["body_on"](wires))
        spaces = result.advice(body="body").spaces
        drawing = drawing_of(result.given)
        chosen = Chosen(None, None, None, None, spaces, False)
        freedom = subjects_of(result, drawing, chosen)[:1]
        view = view_of("-50,22", drawing)
        shown = {"size": (size, size), "plain": True, "box": seen}
        figure = compose(result, drawing, freedom, view, **shown)
        picture = Image.open(io.BytesIO(still_bytes(figure, ".png", cell, wires)))
        corner = place % across * size, place // across * size
        sheet.paste(picture.convert("RGB"), corner)
        told = f"{number}  {cell}".strip()
        ImageDraw.Draw(sheet).text((corner[0] + 8, corner[1] + 6), told, "#444444", words)
    sheet.quantize(96).save(DOCS / "one_body_and_its_wires.png", optimize=True)


if __name__ == "__main__":
    film_the_watched_page()
    draw_one_body()
    for each in PICTURES:
        draw(each)
