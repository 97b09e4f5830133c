# SPDX-License-Identifier: BSD-3-Clause
"""How much memory a dense decomposition needs, and how much there is."""

from __future__ import annotations

import math
import os

#: Needs below this are not compared with what there is [bytes].
_SMALL = 2**26


def dense_needed(rows: int, columns: int) -> float:
    """Bytes for D(c), or one of its parts, its copies, U, V and the work of the decomposition.

    Peaks that were measured, up to 3136 x 2175, are about 0.7 of it.
    """
    return (3.0 * rows * columns + rows * rows + columns * columns) * 8 * 1.5


def allowance(most: float = math.inf) -> float:
    """Bytes that an analysis may use: what is not worth a look, or what there is.

    Args:
        most: What it needs at most.
    """
    return _SMALL if most <= _SMALL else max(_SMALL, available())


def available() -> float:
    """Bytes of memory that can be had; infinity where the system does not say."""
    try:
        with open("/proc/meminfo", encoding="ascii") as file:
            for line in file:
                if line.startswith("MemAvailable:"):
                    return 1024.0 * int(line.split()[1])
    except (OSError, ValueError):
        pass
    try:
        return float(os.sysconf("SC_AVPHYS_PAGES")) * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, ValueError, OSError):
        return math.inf
