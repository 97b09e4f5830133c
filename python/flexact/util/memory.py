# SPDX-License-Identifier: BSD-3-Clause
"""How much memory a dense decomposition needs, and how much there is."""

from __future__ import annotations

import math
import os
import sys
from pathlib import Path

from .loading import load

if sys.platform != "win32":
    import resource

#: Needs below this are not compared with what the machine has [bytes].
_SMALL = 2**26
#: Of an address space that is limited, what is left for others: stacks, and gaps [bytes].
_ASIDE = 2**23
_ROOT = Path("/")


def dense_needed(rows: int, columns: int) -> float:
    """Bytes for D(c), its copies, U, V and the work of the decomposition, at most.

    Never less than what the core asks for, whatever the parts of D(c) are.
    """
    less = float(min(rows, columns))
    both = float(rows) + columns
    return 8.0 * (both * both + 5.0 * less * less + 75.0 * both)


def allowance(most: float = math.inf) -> float:
    """Bytes that an analysis may use: what is not worth a look, or what there is.

    Args:
        most: What it needs at most.
    """
    left = _SMALL if most <= _SMALL else max(_SMALL, available())
    return min(left, address_space())


def available() -> float:
    """Bytes of memory that can be had, the least of all limits; infinity where none is told.

    Those of the machine, of this process (`ulimit`), and of the container, cluster or job that it
    is in. On Linux and Windows the system is asked, on other systems psutil.
    """
    return min(_of_machine(), address_space(), _of_groups())


def address_space(limits: dict[int, float] | None = None, root: Path = _ROOT) -> float:
    """Bytes that the limits of this process (`ulimit -v`, `ulimit -d`) leave it.

    Args:
        limits: Bytes by the place in `statm` of the pages that count; by default the process's.
        root: Where `proc` is.
    """
    limits = _limits() if limits is None else limits
    if not limits:
        return math.inf
    try:
        pages = (root / "proc/self/statm").read_text(encoding="ascii").split()
        size = os.sysconf("SC_PAGE_SIZE")
        left = min(limit - size * int(pages[place]) for place, limit in limits.items())
    except (AttributeError, IndexError, ValueError, OSError):
        left = min(limits.values())
    return max(0.0, left - _ASIDE)


def _limits() -> dict[int, float]:
    if sys.platform == "win32":
        return {}
    places = {0: resource.RLIMIT_AS, 5: resource.RLIMIT_DATA}
    soft = {place: resource.getrlimit(limit)[0] for place, limit in places.items()}
    return {place: float(most) for place, most in soft.items() if most != resource.RLIM_INFINITY}


def _of_machine(root: Path = _ROOT) -> float:
    """Bytes that the machine has left, without what is bounded further within it."""
    if sys.platform == "win32":
        left: float = load("flexact.util.windows").memory_left()
        return left
    try:
        with open(root / "proc/meminfo", encoding="ascii") as file:
            for line in file:
                if line.startswith("MemAvailable:"):
                    return 1024.0 * int(line.split()[1])
    except (OSError, ValueError):
        pass
    return _of_other_systems()


def _of_other_systems() -> float:
    """On macOS, the BSDs, and a Linux that hides what it has."""
    try:
        return float(load("psutil").virtual_memory().available)
    except (ImportError, AttributeError, OSError, RuntimeError, ValueError):
        pass
    # All that there is, where nobody says how much of it is free, is better than no bound.
    for pages in ("SC_AVPHYS_PAGES", "SC_PHYS_PAGES"):
        try:
            count = os.sysconf(pages)
            if count > 0:
                return float(count) * os.sysconf("SC_PAGE_SIZE")
        except (AttributeError, ValueError, OSError):
            continue
    return math.inf


def _of_groups(root: Path = _ROOT) -> float:
    """What the control groups of this process and those round them leave it."""
    if sys.platform != "linux":
        return math.inf
    left: float = load("flexact.util.machine").memory_left(root)
    return left
