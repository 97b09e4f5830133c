# SPDX-License-Identifier: BSD-3-Clause
"""matplotlib, loaded whatever windows it is told to open: pictures need none."""

from __future__ import annotations

import os
import sys
from threading import Lock

_VARIABLE = "MPLBACKEND"
_ONE_AT_A_TIME = Lock()


def load_matplotlib() -> None:
    """Import matplotlib, which cannot be imported where MPLBACKEND names no backend.

    A backend that there is stays the user's choice.
    """
    with _ONE_AT_A_TIME:
        wanted = os.environ.get(_VARIABLE)
        if "matplotlib" in sys.modules or not wanted:
            return
        del os.environ[_VARIABLE]
        try:
            import matplotlib
        finally:
            os.environ[_VARIABLE] = wanted
    try:
        matplotlib.rcParams["backend"] = wanted
    except ValueError:
        return
