# SPDX-License-Identifier: BSD-3-Clause
"""How many processors there are for this process."""

from __future__ import annotations

import os
import sys


def processors() -> int:
    """Processors that this process may use; the bounds of a job or a container count."""
    if sys.platform != "win32" and hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
