# SPDX-License-Identifier: BSD-3-Clause
"""What a notebook shows of a model; it is made on top, of which nothing here may know."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

_makes: list[Callable[[Any], str]] = []


def shown_in_notebooks_by(makes: Callable[[Any], str]) -> None:
    """Set what makes HTML of a model."""
    _makes[:] = [makes]


class NotebookMethods:
    """What a notebook asks a model for."""

    def _repr_html_(self) -> str | None:
        return _makes[0](self) if _makes else None
