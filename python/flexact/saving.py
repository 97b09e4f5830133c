"""A result to a file whose suffix says what it is to be: picture, page or mesh."""

from __future__ import annotations

import os
from operator import index
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .batch import BatchError
from .outputs import OutputError, write_together

if TYPE_CHECKING:
    from .analysis import Analysis

#: Suffixes of pages.
PAGES = (".html", ".htm")


class ChoiceError(BatchError):
    """A choice that such a file does not know."""


def save(analysis: Analysis, path: Path, choice: dict[str, Any]) -> None:
    """Write a result; see `Analysis.save`."""
    from .picture import SUFFIXES

    given = {name: _checked(name, value) for name, value in choice.items() if value is not None}
    _refuse_deck(analysis, path)
    kind = path.suffix.lower()
    if kind in SUFFIXES:
        from .picture import picture_bytes

        write_together({path: picture_bytes(analysis, kind, **given)})
    elif kind in PAGES:
        _refuse(given, path, ())
        write_together({path: page_bytes(analysis)})
    else:
        from .mesh.writing import mesh_writer
        from .shown import chosen_motion

        _refuse(given, path, ("motion", "freedom"))
        if len(given) > 1:
            raise ChoiceError(f"{path.name} shows a motion or a degree of freedom, not both")
        write = mesh_writer(path)
        shown = chosen_motion(analysis, **given)
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


def _refuse_deck(analysis: Analysis, path: Path) -> None:
    """Raise where the file is the deck itself, or can be none.

    Raises:
        OutputError: It is.
    """
    if "\0" in str(path):
        raise OutputError("a file's name cannot hold a NUL")
    deck = analysis.data.name
    if analysis.data.source is None or not deck or "\0" in deck:
        return
    if os.path.exists(deck) and os.path.realpath(deck) == os.path.realpath(path):
        raise OutputError(f"{path} would overwrite the deck")


def page_bytes(analysis: Analysis) -> bytes:
    """The page of a result, with a still picture where the packages for it are installed."""
    from .report import page
    from .report.still import has_pictures, still

    return as_bytes(page(analysis, still(analysis) if has_pictures() else None))


def as_bytes(page: str) -> bytes:
    """A page as a file holds it, whatever characters a deck has brought in."""
    return page.encode("utf-8", "backslashreplace")


def _refuse(given: dict[str, Any], path: Path, known: tuple[str, ...]) -> None:
    if surplus := [name for name in given if name not in known]:
        raise ChoiceError(f"{path.name} shows no {' or '.join(surplus)} of its own choice")
