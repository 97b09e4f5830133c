# SPDX-License-Identifier: BSD-3-Clause
"""Figures as files, the same whenever they are made: PNG, SVG, PDF, and frames as a GIF."""

from __future__ import annotations

import io
import os
import re
import sys
from threading import Lock
from typing import TYPE_CHECKING, Any
from xml.sax.saxutils import escape

import numpy as np

if TYPE_CHECKING:
    from matplotlib.figure import Figure


_VARIABLE = "MPLBACKEND"
_ONE_AT_A_TIME = Lock()


def load_matplotlib() -> None:
    """Import matplotlib, which cannot be imported where MPLBACKEND names no backend.

    A backend that there is stays the user's choice.
    """
    with _ONE_AT_A_TIME:
        wanted = os.environ.get(_VARIABLE)
        if "matplotlib" in sys.modules or not wanted:
            return
        del os.environ[_VARIABLE]
        try:
            import matplotlib
        finally:
            os.environ[_VARIABLE] = wanted
    try:
        matplotlib.rcParams["backend"] = wanted
    except ValueError:
        return


#: What would differ from run to run is left out; identifiers follow from what is drawn.
_SVG: Any = {"svg.fonttype": "none", "svg.hashsalt": "flexact"}
_NOTHING = {"Date": None, "Creator": None, "Format": None, "Type": None}
#: Whole letters that can be searched and copied, in one compressed file.
_PDF: Any = {"pdf.fonttype": 42, "pdf.compression": 6}
_UNDATED = {"CreationDate": None, "Creator": None, "Producer": None}
#: A path's data, and what is left out of its numbers: less than a hundredth of a point.
_PATH, _DIGITS = re.compile(r'<path [^>]*?\bd="[^"]*"'), re.compile(r"(\.\d\d)\d+")
#: Colours of a GIF, and pixels of one colour from which on there might as well be more.
_COLOURS, _ALIKE = 160, 30


def pixels(figure: Figure) -> np.ndarray:
    """(height, width, 3) the figure, 8 bits a colour."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    canvas: Any = FigureCanvasAgg(figure)
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[..., :3].copy()


def png_bytes(figure: Figure) -> bytes:
    """The figure as a PNG; matplotlib's own name and version are left out."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", metadata={"Software": None})
    return buffer.getvalue()


def fewer_colours(content: bytes, colours: int) -> bytes:
    """A PNG in few colours, which takes a third of the room or less."""
    from PIL import Image

    with Image.open(io.BytesIO(content)) as picture:
        few = picture.convert("RGB").quantize(colours, dither=Image.Dither.NONE)
    buffer = io.BytesIO()
    few.save(buffer, "PNG", optimize=True)
    return buffer.getvalue()


def svg_bytes(figure: Figure, title: str, description: str) -> bytes:
    """The figure as SVG, with a title and a description for those who do not see it."""
    import matplotlib

    buffer = io.BytesIO()
    with matplotlib.rc_context(_SVG):
        figure.savefig(buffer, format="svg", metadata=_NOTHING)
    text = buffer.getvalue().decode("utf-8")
    text = _PATH.sub(lambda path: _DIGITS.sub(r"\1", path[0]), text)
    head, root, rest = text.partition("<svg ")
    attributes, end, content = rest.partition(">")
    told = f"\n <title>{escape(title)}</title>\n <desc>{escape(description)}</desc>"
    return f'{head}{root}role="img" {attributes}{end}{told}{content}'.encode()


def pdf_bytes(figure: Figure, title: str, description: str) -> bytes:
    """The figure as PDF: vectors, with its letters in it, and no date."""
    import matplotlib

    buffer = io.BytesIO()
    told = {"Title": title, "Subject": description, **_UNDATED}
    with matplotlib.rc_context(_PDF):
        figure.savefig(buffer, format="pdf", metadata=told)
    return buffer.getvalue()


def still_bytes(figure: Figure, suffix: str, title: str, description: str) -> bytes:
    """The figure as a file of a suffix: .png, .svg or .pdf."""
    if suffix == ".png":
        return png_bytes(figure)
    write = svg_bytes if suffix == ".svg" else pdf_bytes
    return write(figure, title, description)


def _palette(drawings: list[np.ndarray]) -> Any:
    """A palette of what is drawn: arrows have few pixels, and count like large faces."""
    from PIL import Image

    packed = np.concatenate(drawings).reshape(-1, 3).astype(np.uint32) @ (1 << 16, 1 << 8, 1)
    found, counts = np.unique(packed, return_counts=True)
    shown = np.repeat(found, np.minimum(counts, _ALIKE))
    colours = np.stack((shown >> 16, shown >> 8 & 255, shown & 255), axis=-1).astype(np.uint8)
    return Image.fromarray(colours[None]).quantize(_COLOURS, Image.Quantize.MAXCOVERAGE)


def gif_bytes(drawings: list[np.ndarray], order: list[int], duration: int) -> bytes:
    """Drawings (height, width, 3) as frames that run without end, each shown so long [ms].

    `order` says which drawing each frame shows. One palette and no dithering: colours stay what
    and where they are from frame to frame.
    """
    from PIL import Image

    every = Image.fromarray(np.concatenate(drawings))
    every = every.quantize(palette=_palette(drawings), dither=Image.Dither.NONE)
    index = np.asarray(every)
    palette = np.reshape(every.getpalette() or [], (-1, 3))
    # White, in the corner, stays white.
    palette[index[0, -1]] = 255
    made = []
    for each in np.split(index, len(drawings)):
        made.append(Image.fromarray(each))
        made[-1].putpalette(palette.ravel().tolist())
    buffer = io.BytesIO()
    made[order[0]].save(
        buffer,
        format="GIF",
        save_all=True,
        append_images=[made[k] for k in order[1:]],
        duration=duration,
        loop=0,
        optimize=False,
        disposal=1,
    )
    return buffer.getvalue()
