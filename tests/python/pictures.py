# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of pictures share: decks, analyses of texts, pixels at points of a drawing."""

import io
import math
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from reference_decks import ROOT

import flexact

#: The eye of the pictures that are measured [degrees].
AZIMUTH, ELEVATION = -60.0, 25.0
VIEW = f"{AZIMUTH:g},{ELEVATION:g}"
#: A spatial bar alone, which swings; nothing else is to be seen but its two supports.
SWINGING = "TRUSS 1 1 2\nX 2 0 0 1\nFIX 1\nFIX 2 1\n"


def deck(name: str) -> flexact.Analysis:
    return flexact.analyse(ROOT / "input_decks" / f"{name}.dat")


def of_text(folder: Path, text: str) -> flexact.Analysis:
    path = folder / "deck.dat"
    path.write_text(text, encoding="utf-8")
    return flexact.analyse(path)


def collection(figure: Any) -> Any:
    """What a vector file shows of the first panel."""
    return figure.axes[0].get_children()[0].canvas.collection()


class Pixels:
    """The pixels of a figure of one panel, found by points of the drawing."""

    def __init__(
        self, figure: Any, planar: bool = False, eye: tuple[float, float] = (AZIMUTH, ELEVATION)
    ) -> None:
        from PIL import Image

        buffer = io.BytesIO()
        figure.savefig(buffer, format="png")
        with Image.open(buffer) as image:
            self.rgb = np.asarray(image.convert("RGB")).astype(int)
        self.axes, self.planar, self.eye = figure.axes[0], planar, eye

    def place(self, point: Iterable[float]) -> tuple[int, int]:
        """Row and column of a point: the projection, written out here once more."""
        x, y, z = point
        if not self.planar:
            a, e = map(math.radians, self.eye)
            ahead = math.cos(a) * x + math.sin(a) * y
            x, y = -math.sin(a) * x + math.cos(a) * y, math.cos(e) * z - math.sin(e) * ahead
        column, row = self.axes.transData.transform((x, y))
        return round(len(self.rgb) - row), round(column)

    def at(self, point: Iterable[float]) -> np.ndarray:
        """Red, green and blue, 0 to 255, of the pixel at a point."""
        row, column = self.place(point)
        return np.asarray(self.rgb[row, column])

    def near(self, point: Iterable[float], reach: int) -> np.ndarray:
        """(n, 3) the pixels in a square round a point."""
        row, column = self.place(point)
        part = self.rgb[row - reach : row + reach + 1, column - reach : column + reach + 1]
        return np.asarray(part.reshape(-1, 3))

    def count(self, colour: Iterable[float], tolerance: int = 3) -> int:
        """How many pixels have a colour, given 0 to 1."""
        wanted = 255 * np.array(list(colour))
        return int(np.sum(np.all(np.abs(self.rgb - wanted) <= tolerance, axis=-1)))


def hue(colour: np.ndarray) -> int:
    """1 where a colour is reddish, -1 where it is bluish, else 0."""
    difference = int(colour[0]) - int(colour[2])
    return 0 if abs(difference) < 40 else (1 if difference > 0 else -1)
