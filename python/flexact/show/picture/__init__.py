# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of results.

matplotlib and pillow are imported only when one is drawn.
"""

from ..drawing.view import check_view
from .files import PictureError
from .make import (
    check_packages,
    check_suffix,
    draw,
    has_packages,
    model_bytes,
    picture_bytes,
    shape_bytes,
    spaces_bytes,
    still_of,
)

__all__ = [
    "PictureError",
    "check_packages",
    "check_suffix",
    "check_view",
    "draw",
    "has_packages",
    "model_bytes",
    "picture_bytes",
    "shape_bytes",
    "spaces_bytes",
    "still_of",
]
