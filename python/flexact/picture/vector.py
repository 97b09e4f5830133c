"""A figure as SVG: vectors, text as text, the same whenever it is made."""

from __future__ import annotations

import io
import re
from typing import TYPE_CHECKING, Any
from xml.sax.saxutils import escape

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: What would differ from run to run is left out; identifiers follow from what is drawn.
SETTINGS: Any = {"svg.fonttype": "none", "svg.hashsalt": "flexact"}
#: A path's data, and what is left out of its numbers: less than a hundredth of a point.
_PATH, _DIGITS = re.compile(r'<path [^>]*?\bd="[^"]*"'), re.compile(r"(\.\d\d)\d+")
_NOTHING = {"Date": None, "Creator": None, "Format": None, "Type": None}


def svg_bytes(figure: Figure, title: str, description: str) -> bytes:
    """The figure as SVG, with a title and a description for those who do not see it."""
    import matplotlib
    from matplotlib.backends.backend_svg import FigureCanvasSVG

    FigureCanvasSVG(figure)
    buffer = io.BytesIO()
    with matplotlib.rc_context(SETTINGS):
        figure.savefig(buffer, format="svg", metadata=_NOTHING)
    text = buffer.getvalue().decode("utf-8")
    text = _PATH.sub(lambda path: _DIGITS.sub(r"\1", path[0]), text)
    head, root, rest = text.partition("<svg ")
    attributes, end, content = rest.partition(">")
    told = f"\n <title>{escape(title)}</title>\n <desc>{escape(description)}</desc>"
    return f'{head}{root}role="img" {attributes}{end}{told}{content}'.encode()
