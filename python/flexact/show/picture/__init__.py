# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of results.

matplotlib and pillow are imported only when one is drawn.
"""

from ..drawing.view import ViewError, check_view
from .files import VideoError
from .make import (
    PictureError,
    check_packages,
    check_suffix,
    draw,
    has_packages,
    model_bytes,
    picture_bytes,
    shape_bytes,
    still_of,
)
from .subject import SubjectError

__all__ = [
    "PictureError",
    "SubjectError",
    "VideoError",
    "ViewError",
    "check_packages",
    "check_suffix",
    "check_view",
    "draw",
    "has_packages",
    "model_bytes",
    "picture_bytes",
    "shape_bytes",
    "still_of",
]
