# SPDX-License-Identifier: BSD-3-Clause
"""Opening of the browser, where there is one."""

from __future__ import annotations

import os
import sys
import threading
import webbrowser

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
