"""Pictures of results by matplotlib, which is imported only when one is drawn."""

from .make import SUFFIXES, PictureError, check_packages, check_suffix, draw, picture_bytes
from .subject import SubjectError
from .view import ViewError, check_view

__all__ = [
    "SUFFIXES",
    "PictureError",
    "SubjectError",
    "ViewError",
    "check_packages",
    "check_suffix",
    "check_view",
    "draw",
    "picture_bytes",
]
