# SPDX-License-Identifier: BSD-3-Clause
"""What `.show()` does with a page: the notebook, a script that is watched, or the browser."""

from __future__ import annotations

import os
import re
import sys
import tempfile
import threading
import traceback
import webbrowser
from collections.abc import Callable
from html import escape
from pathlib import Path
from typing import Any

from ..util.errors import BatchError, reason_of
from ..util.loading import load
from ..util.outputs import OutputError, write_together
from ..util.text import file_name, harmless
from .writers import PAGES

#: How long it may take to hear whether a browser opens [s]; some commands wait for its end.
_PATIENCE = 2.0


def opens(address: str) -> bool:
    """Open an address in the browser of this desk; False where there is none."""
    if not _has_desk():
        return False
    heard: list[bool] = []
    # A browser that does not go into the background must not hold anybody up.
    opening = threading.Thread(target=lambda: heard.append(_opened(address)), daemon=True)
    opening.start()
    opening.join(_PATIENCE)
    return not heard or heard[0]


def _has_desk() -> bool:
    """Whether there is a screen that a browser can open on: one in the terminal would fill it."""
    if os.environ.get("BROWSER"):
        return True
    if sys.platform in ("win32", "darwin"):
        return "SSH_CONNECTION" not in os.environ
    return any(os.environ.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY"))


def _opened(address: str) -> bool:
    try:
        return webbrowser.open(address)
    except (webbrowser.Error, OSError):
        return False


#: Takes what is shown, and the line of the script; set where a script is watched.
Taker = Callable[[Any, int], None]
_takers: list[Taker] = []


def take_with(taker: Taker) -> None:
    """Hand whatever is shown from now on to `taker`, and show nothing."""
    _takers[:] = [taker]


def is_taken(shown: Any) -> bool:
    """Whether what is shown was taken by who watches the script."""
    for taker in _takers:
        taker(shown, _line_of_script())
    return bool(_takers)


def _line_of_script() -> int:
    """The line of the outermost file that is being run, which is where a person looks."""
    main = getattr(sys.modules.get("__main__"), "__file__", None)
    lines = [line for frame, line in traceback.walk_stack(None) if frame.f_code.co_filename == main]
    return lines[-1] if lines else 0


def is_displayed(shown: Any) -> bool:
    """Whether it was displayed in a notebook, which is where this runs."""
    found = sys.modules.get("IPython")
    shell = found.get_ipython() if found is not None else None
    # The consoles of editors have a kernel too, but show text alone.
    if not hasattr(shell, "kernel") or any("SPYDER" in name for name in os.environ):
        return False
    load("IPython.display").display(shown)
    return True


class InWords:
    """An error as a notebook shows it."""

    def __init__(self, error: Exception) -> None:
        """Keep what it says."""
        self._words = str(error)

    def __repr__(self) -> str:
        """All that it says."""
        return self._words

    def _repr_html_(self) -> str:
        return f"<pre>{escape(self._words)}</pre>"


def page_path(path: str | os.PathLike[str]) -> Path:
    """The path of a page, if it can be that of one.

    Raises:
        FlexactError: It cannot.
    """
    target = Path(path)
    if target.suffix.lower() not in PAGES or "\0" in str(target):
        raise BatchError(f"{harmless(str(target))} is not the name of a page, such as guide.html")
    return target


def write_page(page: bytes, name: str, path: Path | None = None) -> Path:
    """Write a page, whole or not at all.

    Args:
        page: The page.
        name: What it is of.
        path: Where it goes; by default a temporary file.

    Raises:
        FlexactError: It cannot be written.
    """
    if path is not None:
        write_together({path: page})
        return path
    short = re.sub(r"[^\w.-]+", "_", Path(file_name(name)).stem)[:40] or "model"
    try:
        number, made = tempfile.mkstemp(".html", f"flexact-{short}-")
        with open(number, "wb") as file:
            file.write(page)
    except OSError as error:
        raise OutputError(f"no temporary page can be written: {reason_of(error)}") from error
    return Path(made)


def open_page(target: Path) -> Path:
    """Open a page in the browser, or say where it is where none opens; its whole path."""
    target = target.absolute()
    if not opens(target.as_uri()):
        print(f"The page is {target}", flush=True)
    return target
