# SPDX-License-Identifier: BSD-3-Clause
"""A picture of a vibrating or buckled shape."""

from __future__ import annotations

from ...core.arrays import FloatArray
from ...model.configuration import Configuration
from ...model.data import ModelData
from ...util.plain_text import harmless
from ..drawing import drawing_of, swing
from ..drawing.view import view_of
from .figure import compose
from .files import still_bytes
from .loading import load_matplotlib
from .make import check_packages, check_suffix, checked_size, quiet
from .picture_animation import SUFFIXES as MOVING
from .picture_animation import moving_bytes
from .subject import Subject


def shape_bytes(
    data: ModelData,
    state: Configuration,
    displacement: FloatArray,
    title: str,
    suffix: str = ".png",
    *,
    view: str | None = None,
    size: tuple[int, int] | None = None,
    plain: bool = False,
) -> bytes:
    """A picture of an elastic shape as the content of a file.

    Args:
        data: The model whose nodes are displaced, such as one whose beams are divided.
        state: Where its nodes are without the shape.
        displacement: (nodes, 3) of positions, and rotations (spins) of orientations; only their
            ratios matter.
        title: Above it, such as "vibrates at 184 Hz".
        suffix: `.png`, `.svg` or `.pdf`; `.gif`, `.mp4` or `.webm`, which move.
        view: As of `draw`.
        size: Width and height [px].
        plain: Whether title and caption are left out.

    Raises:
        PictureError: There is no such kind of picture, or a package is missing.
        ViewError: There is no such view.
    """
    kind = check_suffix(suffix)
    check_packages(kind)
    with quiet():
        load_matplotlib()
        drawing = drawing_of(data)
        words = harmless(title[:1].upper() + title[1:])
        subject = Subject(words, movement=swing(drawing, state, displacement, "To first order."))
        seen = view_of(view, drawing)
        size = None if size is None else checked_size(size)
        name = harmless(data.name) or "Mechanism"
        if kind in MOVING:
            shown = drawing, subject, seen, kind, f"{name}: {words}"
            return moving_bytes(None, *shown, size=size, plain=plain)
        figure = compose(None, drawing, [subject], seen, size=size, plain=plain)
        return still_bytes(figure, kind, name, words)
