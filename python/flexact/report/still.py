"""Still pictures for pages: where there is no WebGL or no script, and in an index."""

from __future__ import annotations

from importlib.util import find_spec
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..analysis import Analysis

_SMALL = (480, 360)


def has_pictures() -> bool:
    """Whether the packages that make them are installed."""
    return all(find_spec(package) is not None for package in ("matplotlib", "PIL"))


def still(analysis: Analysis) -> bytes:
    """The picture of a result, as PNG."""
    from ..picture import picture_bytes

    return picture_bytes(analysis, ".png")


def small(analysis: Analysis) -> bytes:
    """A small picture without words, as PNG."""
    from ..picture import picture_bytes

    return picture_bytes(analysis, ".png", size=_SMALL, plain=True)
