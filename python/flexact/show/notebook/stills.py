# SPDX-License-Identifier: BSD-3-Clause
"""Small pictures for notebooks, as HTML; none where the packages for them are missing."""

from __future__ import annotations

import io
from typing import Any

from ...analysis.result import Result
from ...util.partial import attempted
from ..page.markup import image
from ..picture import has_packages, picture_bytes

#: Width and height [px] of the still of a result, and of a picture in a table, at twice the
#: size at which it is shown.
WHOLE, SMALL = (960, 600), (400, 300)
#: Colours of the two.
_COLOURS = {WHOLE: 96, SMALL: 48}


def still(analysis: Result, size: tuple[int, int], words: str, **chosen: Any) -> str:
    """A picture of a result, of a motion or a self-stress of it; or nothing.

    Args:
        analysis: The result.
        size: `WHOLE` or `SMALL`.
        words: What the picture shows.
        chosen: As of `flexact.show.picture.draw`.
    """
    if not has_packages():
        return ""
    content = attempted(
        words, lambda: picture_bytes(analysis, ".png", size=size, plain=True, **chosen), None, None
    )
    return "" if content is None else shown(content, size, words)


def shown(content: bytes, size: tuple[int, int], words: str) -> str:
    """A picture as HTML, in few colours, at half its size."""
    made = image(lighter(content, _COLOURS[size]), words)
    width = f"{size[0] // 2}px" if size == SMALL else "100%"
    style = f"width:{width};max-width:{size[0]}px;height:auto;background:#fff;border-radius:6px"
    return made.replace("<img ", f'<img width="{size[0] // 2}" style="{style}" ', 1)


def lighter(content: bytes, colours: int) -> bytes:
    """A PNG in few colours, which takes a third of the room."""
    from PIL import Image

    with Image.open(io.BytesIO(content)) as picture:
        few = picture.convert("RGB").quantize(colours, dither=Image.Dither.NONE)
    buffer = io.BytesIO()
    few.save(buffer, "PNG", optimize=True)
    return buffer.getvalue()
