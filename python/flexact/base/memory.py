# SPDX-License-Identifier: BSD-3-Clause
"""How much memory a dense decomposition needs, and how much there is."""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Iterator
from pathlib import Path

if sys.platform != "win32":
    import resource

#: Needs below this are not compared with what the machine has [bytes].
_SMALL = 2**26
#: Of an address space that is limited, what is left for others: stacks, and gaps [bytes].
_ASIDE = 2**23
_ROOT = Path("/")


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
    left = _SMALL if most <= _SMALL else max(_SMALL, available())
    return min(left, address_space())


def available() -> float:
    """Bytes of memory that can be had, the least of all limits; infinity where none is told."""
    return min(_of_machine(), address_space(), *_of_groups())


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
    try:
        with open(root / "proc/meminfo", encoding="ascii") as file:
            for line in file:
                if line.startswith("MemAvailable:"):
                    return 1024.0 * int(line.split()[1])
    except (OSError, ValueError):
        pass
    try:
        return float(os.sysconf("SC_AVPHYS_PAGES")) * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, ValueError, OSError):
        return math.inf


def _of_groups(root: Path = _ROOT) -> Iterator[float]:
    """What the control groups of this process and those round them leave it."""
    yield math.inf
    try:
        lines = (root / "proc/self/cgroup").read_text(encoding="utf-8").splitlines()
    except (OSError, ValueError):
        return
    mounted = root / "sys/fs/cgroup"
    for line in lines:
        _, controllers, group = [*line.split(":", 2), "", ""][:3]
        if not controllers:
            yield from _left(mounted, group, ("memory.max", "memory.current", "inactive_file"))
        elif "memory" in controllers.split(","):
            old = ("memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file")
            yield from _left(mounted / "memory", group, old)


def _left(mounted: Path, group: str, names: tuple[str, str, str]) -> Iterator[float]:
    """By each group on the way up; in a container some of them cannot be seen."""
    limit, usage, cached = names
    parts = [part for part in group.split("/") if part not in ("", "..")]
    for depth in range(len(parts), -1, -1):
        folder = mounted.joinpath(*parts[:depth])
        try:
            most = float((folder / limit).read_text(encoding="ascii"))
            used = float((folder / usage).read_text(encoding="ascii"))
            yield max(0.0, most - used + _given_back(folder, cached))
        except (OSError, ValueError):
            continue


def _given_back(folder: Path, cached: str) -> float:
    """Bytes of files that are kept in memory while nobody else wants it."""
    try:
        lines = (folder / "memory.stat").read_text(encoding="ascii").splitlines()
        return next(
            (float(line.split()[1]) for line in lines if line.startswith(f"{cached} ")), 0.0
        )
    except (OSError, ValueError, IndexError):
        return 0.0
