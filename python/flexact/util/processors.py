# SPDX-License-Identifier: BSD-3-Clause
"""How many processors there are for this process."""

from __future__ import annotations

import math
import os
import sys
from pathlib import Path

from .loading import load


def processors(root: Path = Path("/")) -> int:
    """Processors that this process may use; the bounds of a job or a container count.

    Of a share, such as the time of 1.5 processors, the next whole number.

    Args:
        root: Where `proc` and `sys` are.
    """
    count = _given()
    share = math.inf
    if sys.platform == "win32":
        share = load("flexact.util.windows").processors(count)
    elif sys.platform == "linux":
        share = load("flexact.util.machine").processors(root)
    # What rounding leaves is no processor.
    return max(1, count if share >= count else math.ceil(share - 1e-9))


def _given() -> int:
    """Those that are set, as by taskset or a cluster, else all."""
    # From Python 3.13 on it knows PYTHON_CPU_COUNT as well.
    if (counted := getattr(os, "process_cpu_count", None)) is not None:
        return counted() or 1
    if sys.platform != "win32" and hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
