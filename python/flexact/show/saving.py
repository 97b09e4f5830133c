# SPDX-License-Identifier: BSD-3-Clause
"""A result to a file whose suffix says what it is to be: picture, page or mesh."""

from __future__ import annotations

from operator import index
from pathlib import Path
from typing import Any

from ..analysis.result import Result
from ..util.errors import BatchError
from ..util.partial import attempted
from .drawing.selection import require_there, select_motion
from .mesh.collection import MESHES
from .page import page, with_way_back
from .picture import check_packages, picture_bytes, still_of
from .picture.files import fewer_colours
from .writers import FLEXURES, PAGES, PICTURES, STILL_SOLIDS, Contents, Writers, as_bytes

#: Width and height of a small picture [px].
_SMALL = (480, 360)
#: How many colours it has: a fifth of the bytes of all.
_COLOURS = 48

#: What is no picture and no page is to be a mesh.
RESULTS = Writers(lambda path, _: MESHES.unknown(path, MESHES.suffixes))


@RESULTS.register(
    PICTURES, shows=("motion", "freedom", "stress", "quantity", "view"), require=check_packages
)
def _picture(analysis: Result, path: Path, **chosen: Any) -> bytes:
    return picture_bytes(analysis, path.suffix, **chosen)


@RESULTS.register(PAGES)
def _page(analysis: Result, path: Path) -> bytes:
    return page_bytes(analysis)


@RESULTS.register(FLEXURES)
@RESULTS.register((".glb",), shows=("motion", "freedom", "stress"))
@RESULTS.register(MESHES.suffixes, shows=("motion", "freedom"))
def _mesh(analysis: Result, path: Path, stress: int | None = None, **chosen: int) -> Contents:
    if len(chosen) > 1:
        raise BatchError(f"{path.name} shows a motion or a degree of freedom, not both")
    if stress is not None:
        require_there(stress, len(analysis.self_stresses), "self-stress", "self-stresses")
    is_still = path.suffix.lower() in (*STILL_SOLIDS, *FLEXURES) and not chosen
    shown = None if is_still else select_motion(analysis, **chosen)
    drawn = analysis, None if shown is None else shown.motion
    return MESHES.contents(drawn, path, **({} if stress is None else {"stress": stress}))


def save(analysis: Result, path: Path, choice: dict[str, Any]) -> None:
    """Write a result; see `Result.save`.

    Raises:
        FlexactError: As of `Writers.save`, or a choice is of a wrong kind.
    """
    chosen: dict[str, int | str] = {}
    for name, value in choice.items():
        if value is None:
            continue
        if name in ("quantity", "view"):
            if not isinstance(value, str):
                raise BatchError(f"{name} is given by its name, not by {type(value).__name__}")
            chosen[name] = value
            continue
        try:
            chosen[name] = index(value)
        except TypeError:
            raise BatchError(f"{name} is a number from 1, not {type(value).__name__}") from None
    RESULTS.save(analysis, analysis.given, path, **chosen)


def page_bytes(
    analysis: Result, place: str | None = None, misaligned: dict[str, Any] | None = None
) -> bytes:
    """The page of a result, with a still picture where the packages for it are installed.

    Args:
        analysis: The result.
        place: Path of the page beside an index, to which it has a link then.
        misaligned: As of `content_of`.
    """
    missing: list[str] = []
    still = still_of(analysis, "The still picture", missing)
    made = page(analysis, still, missing=missing, misaligned=misaligned)
    return as_bytes(made if place is None else with_way_back(made, place))


def small_picture(analysis: Result) -> bytes | None:
    """A small picture without words for an index, as PNG, where it can be made."""
    made = still_of(analysis, "The picture", size=_SMALL, plain=True)
    # An index holds very many.
    return (
        None
        if made is None
        else attempted("The picture", lambda: fewer_colours(made, _COLOURS), None, None)
    )
