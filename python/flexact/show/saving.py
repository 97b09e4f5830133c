# SPDX-License-Identifier: BSD-3-Clause
"""A result to a file whose suffix says what it is to be: picture, page or mesh."""

from __future__ import annotations

import io
import os
from operator import index
from pathlib import Path
from typing import Any

from ..analysis.result import Result
from ..util.errors import BatchError
from ..util.loading import load
from ..util.outputs import OutputError, write_together
from ..util.partial import attempted
from .drawing.selection import select_motion
from .mesh import mesh_writer
from .page import page, with_way_back
from .picture import SUFFIXES, has_packages, picture_bytes

#: Suffixes of pages.
PAGES = (".html", ".htm")
#: Width and height of a small picture [px].
_SMALL = (480, 360)
#: How many colours it has: a fifth of the bytes of all.
_COLOURS = 48


class ChoiceError(BatchError):
    """A choice that such a file does not know."""


def save(analysis: Result, path: Path, choice: dict[str, Any]) -> None:
    """Write a result; see `Result.save`."""
    given = {name: _checked(name, value) for name, value in choice.items() if value is not None}
    _refuse_deck(analysis, path)
    kind = path.suffix.lower()
    if kind in SUFFIXES:
        write_together({path: picture_bytes(analysis, kind, **given)})
    elif kind in PAGES:
        _refuse(given, path, ())
        write_together({path: page_bytes(analysis)})
    else:
        _refuse(given, path, ("motion", "freedom"))
        if len(given) > 1:
            raise ChoiceError(f"{path.name} shows a motion or a degree of freedom, not both")
        write = mesh_writer(path)
        shown = select_motion(analysis, **given)
        write(analysis, None if shown is None else shown.motion, path)


def _checked(name: str, value: Any) -> Any:
    """A choice, if it is of the right kind.

    Raises:
        ChoiceError: It is not.
    """
    if name in ("quantity", "view"):
        if not isinstance(value, str):
            raise ChoiceError(f"{name} is given by its name, not by {type(value).__name__}")
        return value
    try:
        return index(value)
    except TypeError:
        raise ChoiceError(f"{name} is a number from 1, not {type(value).__name__}") from None


def _refuse_deck(analysis: Result, path: Path) -> None:
    """Raise where the file is the deck itself, or can be none.

    Raises:
        OutputError: It is.
    """
    if "\0" in str(path):
        raise OutputError("a file's name cannot hold a NUL")
    deck = analysis.given.name
    if analysis.given.source is None or not deck or "\0" in deck:
        return
    if os.path.exists(deck) and os.path.realpath(deck) == os.path.realpath(path):
        raise OutputError(f"{path} would overwrite the deck")


def page_bytes(analysis: Result, place: str | None = None) -> bytes:
    """The page of a result, with a still picture where the packages for it are installed.

    Args:
        analysis: The result.
        place: Path of the page beside an index, to which it has a link then.
    """
    missing: list[str] = []
    still = None
    if has_packages():
        what = "The still picture"
        still = attempted(what, lambda: picture_bytes(analysis, ".png"), None, missing)
    made = page(analysis, still, missing=missing)
    return as_bytes(made if place is None else with_way_back(made, place))


def small_picture(analysis: Result) -> bytes | None:
    """A small picture without words for an index, as PNG, where it can be made."""
    if not has_packages():
        return None
    return attempted("The picture", lambda: _small(analysis), None, None)


def _small(analysis: Result) -> bytes:
    drawn = picture_bytes(analysis, ".png", size=_SMALL, plain=True)
    # An index holds very many.
    pillow = load("PIL.Image")
    with pillow.open(io.BytesIO(drawn)) as picture:
        few = picture.convert("RGB").quantize(_COLOURS, dither=pillow.Dither.NONE)
    made = io.BytesIO()
    few.save(made, "PNG", optimize=True)
    return made.getvalue()


def as_bytes(page: str) -> bytes:
    """A page as a file holds it, whatever characters a deck has brought in."""
    return page.encode("utf-8", "backslashreplace")


def _refuse(given: dict[str, Any], path: Path, known: tuple[str, ...]) -> None:
    if surplus := [name for name in given if name not in known]:
        raise ChoiceError(f"{path.name} shows no {' or '.join(surplus)} of its own choice")
