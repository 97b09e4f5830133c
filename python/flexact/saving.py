"""A result to a file whose suffix says what it is to be: picture, page or mesh."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from .batch import BatchError
from .outputs import write_together

if TYPE_CHECKING:
    from .analysis import Analysis

#: Suffixes of pages.
PAGES = (".html", ".htm")


class ChoiceError(BatchError):
    """A choice that such a file does not know."""


def save(analysis: Analysis, path: Path, choice: dict[str, Any]) -> None:
    """Write a result; see `Analysis.save`."""
    from .picture import SUFFIXES

    given = {name: value for name, value in choice.items() if value is not None}
    kind = path.suffix.lower()
    if kind in SUFFIXES:
        from .picture import picture_bytes

        write_together({path: picture_bytes(analysis, kind, **given)})
    elif kind in PAGES:
        _refuse(given, path, ())
        write_together({path: page_bytes(analysis)})
    else:
        from .mesh_writing import mesh_writer
        from .shown import chosen_motion

        _refuse(given, path, ("motion", "freedom"))
        write = mesh_writer(path)
        shown = chosen_motion(analysis, **given)
        write(analysis, None if shown is None else shown.motion, path)


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
