# SPDX-License-Identifier: BSD-3-Clause
"""A picture of a model that has not been analysed."""

from __future__ import annotations

from ...model.data import ModelData
from ...util.plain_text import harmless
from ..drawing import drawing_of
from ..drawing.view import view_of
from .figure import compose
from .files import still_bytes
from .loading import load_matplotlib
from .make import check_packages, check_suffix, checked_size, quiet
from .subject import Subject


def model_bytes(
    data: ModelData,
    suffix: str = ".png",
    *,
    view: str | None = None,
    size: tuple[int, int] | None = None,
) -> bytes:
    """A picture of a model without words, as the content of a file.

    Args:
        data: The model.
        suffix: `.png`, `.svg` or `.pdf`.
        view: As of `draw`.
        size: Width and height [px].

    Raises:
        PictureError: There is no such kind of picture, or a package is missing.
        ViewError: There is no such view.
    """
    kind = check_suffix(suffix)
    check_packages()
    with quiet():
        load_matplotlib()
        drawing = drawing_of(data)
        seen = view_of(view, drawing)
        size = None if size is None else checked_size(size)
        figure = compose(None, drawing, [Subject()], seen, size=size, plain=True)
        return still_bytes(figure, kind, harmless(data.name) or "Mechanism", "")
