# SPDX-License-Identifier: BSD-3-Clause
"""A result, or advice on it, to a file: picture, page or mesh, as its suffix says."""

from __future__ import annotations

import contextlib
from operator import index
from pathlib import Path
from typing import Any

from ..advice.advice import Advice, sections_of
from ..advice.spaces.spaces import spaces_of
from ..analysis.change import Change
from ..analysis.decomposition import Asked
from ..analysis.naming import Pieces
from ..analysis.result import Result, result_of
from ..deck.rendering import ModelError, model_error
from ..util.errors import BatchError
from ..util.partial import attempted
from .drawing.selection import select_motion
from .mesh.collection import MESHES
from .page import before_and_after, page, with_way_back
from .picture import check_packages, picture_bytes, still_of
from .picture.files import fewer_colours
from .writers import PAGES, PICTURES, Contents, Writers, as_bytes

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


@RESULTS.register(MESHES.suffixes, shows=("motion", "freedom"))
def _mesh(analysis: Result, path: Path, **chosen: int) -> Contents:
    if len(chosen) > 1:
        raise BatchError(f"{path.name} shows a motion or a degree of freedom, not both")
    shown = select_motion(analysis, **chosen)
    return MESHES.contents((analysis, None if shown is None else shown.motion), path)


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


def page_bytes(analysis: Result, place: str | None = None) -> bytes:
    """The page of a result, with a still picture where the packages for it are installed.

    Args:
        analysis: The result.
        place: Path of the page beside an index, to which it has a link then.
    """
    missing: list[str] = []
    still = still_of(analysis, "The still picture", missing)
    made = page(analysis, still, missing=missing)
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


def page_of_change(advice: Advice, change: Change, words: Pieces) -> bytes:
    """A page that shows the mechanism as it is beside what a change makes of it, moving.

    Args:
        advice: The advice on the mechanism.
        change: What is done.
        words: The same, for people.
    """
    before, asked = advice.analysis, advice.analysis.asked
    model = change.apply(before.given)
    after: Result = result_of(
        model.data, Asked(asked.method, asked.tolerance, asked.prove, asked.accuracy), before.name
    )
    told = (line for section in sections_of(advice) for line, _ in section)
    stills = still_of(before), still_of(after)
    body = None
    if advice.spaces is not None:
        # It may have another name now, or none.
        with contextlib.suppress(ModelError):
            body = spaces_of(after, advice.spaces.subject.name, wires=False)
    spaces = advice.spaces, body
    return as_bytes(before_and_after(before, after, words, told, stills, spaces=spaces))


def page_of_advice(advice: Advice) -> bytes:
    """The page of a mechanism alone, with freedom and constraint to be switched on."""
    return as_bytes(page(advice.analysis, still_of(advice.analysis), advice.spaces))


def picture_of_advice(advice: Advice, suffix: str) -> bytes:
    """A picture of the freedom and the constraint of the body.

    Args:
        advice: The advice on the mechanism.
        suffix: `.png`, `.svg` or `.pdf`.

    Raises:
        ModelError: there is no body that could move.
        PictureError: a package is missing.
    """
    spaces = advice.spaces
    if spaces is None:
        raise model_error("no-body", "nothing in this mechanism has a freedom space to be drawn")
    return picture_bytes(advice.analysis, suffix, spaces=spaces)
