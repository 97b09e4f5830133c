# SPDX-License-Identifier: BSD-3-Clause
"""The method of a model that shows it; what it does is set from the top, for nothing here may."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

#: Shows a model, in a file that may be named.
Shows = Callable[[Any, "str | os.PathLike[str] | None"], "Path | None"]

#: Makes HTML of a model, for notebooks.
Tells = Callable[[Any], str]

_shows: list[Shows] = []
_tells: list[Tells] = []


def shown_by(shows: Shows, tells: Tells) -> None:
    """Set how models are shown, and what notebooks show of them."""
    _shows[:], _tells[:] = [shows], [tells]


class ShowMethods:
    """The method that shows a model."""

    def show(self, path: str | os.PathLike[str] | None = None) -> Path | None:
        """Analyse the model and show its page: in the browser, or in the notebook.

        The page of a model with errors says what they are. Where no browser can be opened, it is
        said where the page is.

        Args:
            path: Where the page is written, such as "guide.html"; by default a temporary file.

        Returns:
            Where the page is; None in a notebook, and in a script that `flexact watch` runs.

        Raises:
            FlexactError: the page cannot be written, or the path is not that of a page.
        """
        return _shows[0](self, path)

    def _repr_html_(self) -> str:
        return _tells[0](self)
