# SPDX-License-Identifier: BSD-3-Clause
"""A freedom and its constraint as FACT draws them, without a mechanism: as picture and as page."""

from __future__ import annotations

from itertools import product
from pathlib import Path

import numpy as np

from ..advice.spaces.words import Geometry, space_in_words
from ..analysis.naming import plain
from ..model.data import ModelData
from ..model.model import Model
from ..show.page.compare import Side, spaces_page
from ..show.page.viewer import Shaped
from ..show.picture import has_packages, spaces_bytes
from ..show.spaces import SpaceShown, space_shown
from ..show.writers import as_bytes
from ..util.text import harmless
from .explain import Explanation

#: How large the drawing is, in sizes of the freedom; half an edge of a body without boxes; how
#: little of it is seen.
_SIZE, _HALF, _OPACITY = 2.2, 0.3, 0.12


def picture_bytes(made: Explanation, path: Path, **options: object) -> bytes:
    """The picture as the content of a file, as of `flexact.show.picture.spaces_bytes`."""
    shown = shown_of(made)
    return spaces_bytes(body_of(made), shown, made.title, path.suffix.lower(), **options)  # type: ignore[arg-type]


def page_bytes(made: Explanation) -> bytes:
    """The page as the content of a file: both spaces, to be turned, and what it takes."""
    data, sides = body_of(made), []
    for number, each in enumerate(shown_of(made)):
        still = spaces_bytes(data, [each], made.title) if has_packages() else None
        words = f"{each.words}."
        sides.append(Side(number, each.title, words, Shaped(data, ()), still, (each,)))
    headline, *told = made.lines
    headed = " ".join((plain(headline.head).strip(), *map(plain, headline.items)))
    return as_bytes(spaces_page(harmless(made.title), headed, told, sides))


def shown_of(made: Explanation) -> list[SpaceShown]:
    """Freedom and constraint as they are drawn."""
    found = made.found
    geometry, size = Geometry(made.units, found.freedom.length), _SIZE * found.freedom.length
    spaces = (("Freedom", found.freedom, "none"), ("Constraint", found.constraint, "none"))
    return [
        space_shown(
            space,
            f"{what} of {made.body}",
            "; ".join(map(plain, space_in_words(geometry, space))) or nothing,
            size,
        )
        for what, space, nothing in spaces
    ]


def body_of(made: Explanation) -> ModelData:
    """The body alone: the corners of its boxes, hardly seen."""
    freedom, model = made.found.freedom, Model()
    half = np.full(3, _HALF * freedom.length)
    boxes = [np.stack((box.low, box.high)) for box in made.boxes]
    boxes = boxes or [np.stack((freedom.about - half, freedom.about + half))]
    for number, box in enumerate(boxes, start=1):
        corners = [tuple(box[list(pick), range(3)].tolist()) for pick in product((0, 1), repeat=3)]
        name = made.body if len(boxes) == 1 else f"{made.body} {number}"
        model.body(corners, name=harmless(name))
        model.look(harmless(name), opacity=_OPACITY)
    return model.data
