# SPDX-License-Identifier: BSD-3-Clause
"""A freedom and its constraint as FACT draws them, without a mechanism: as picture and as page."""

from __future__ import annotations

from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from ..advice.spaces.words import Geometry, space_in_words
from ..analysis.naming import Line, plain
from ..model.data import ModelData
from ..model.model import Model
from ..show.picture import check_packages, has_packages, spaces_bytes
from ..show.spaces import SpaceShown, space_shown
from ..show.writers import PAGES, STILLS, Writers, as_bytes, require_name, write
from ..util.loading import load
from ..util.outputs import OutputError
from ..util.text import harmless
from .explain import Explanation

#: How large the drawing is, in sizes of the freedom; half an edge of a body without boxes; how
#: little of it is seen.
_SIZE, _HALF, _OPACITY = 2.2, 0.3, 0.12


#: Of explanations.
EXPLANATIONS = Writers(
    lambda path, known: OutputError(f"the suffix of {path} is to be one of {', '.join(known)}")
)


def save(made: Explanation, path: str | Path) -> None:
    """Draw freedom and constraint: .png, .svg, .pdf, or .html with the words.

    Raises:
        FlexactError: There is no such kind of file, it cannot be written, or a package is missing.
    """
    path = Path(path)
    require_name(path)
    write(path, EXPLANATIONS.contents(made, path))


@EXPLANATIONS.register(STILLS, require=check_packages)
def picture_bytes(made: Explanation, path: Path) -> bytes:
    """The picture as the content of a file."""
    return spaces_bytes(body_of(made), shown_of(made), made.title, path.suffix.lower())


@EXPLANATIONS.register(PAGES)
def page_bytes(made: Explanation, path: Path) -> bytes:
    """The page as the content of a file: both spaces, to be turned, and what it takes."""
    headline, *told = made.lines
    page: str = load("flexact.show.page").spaces_page(
        harmless(made.title), in_one_line(headline), told, sides_of(made)
    )
    return as_bytes(page)


def in_one_line(line: Line) -> str:
    """A line as a headline has it."""
    return f"{plain(line.head).strip()} {'; '.join(map(plain, line.items))}".strip()


def sides_of(made: Explanation) -> list[Any]:
    """Freedom and constraint as a page draws them, `flexact.show.page.Side`."""
    # Pages take a while to load.
    viewer, pages = load("flexact.show.page.viewer"), load("flexact.show.page")
    data, sides = body_of(made), []
    for number, each in enumerate(shown_of(made)):
        still = spaces_bytes(data, [each], made.title) if has_packages() else None
        shaped = viewer.Shaped(data, ())
        sides.append(pages.Side(number, each.title, f"{each.words}.", shaped, still, (each,)))
    return sides


def shown_of(made: Explanation) -> list[SpaceShown]:
    """Freedom and constraint as they are drawn."""
    found = made.found
    geometry, size = Geometry(made.units, found.freedom.length), _SIZE * found.freedom.length
    spaces = (
        ("Freedom", found.freedom, "nothing moves"),
        ("Constraint", found.constraint, "nothing is held"),
    )
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
