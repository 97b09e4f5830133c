# SPDX-License-Identifier: BSD-3-Clause
"""What the control groups of Linux, by which containers and clusters are bounded, leave a process.

Both versions are read, also side by side. A group is bounded by those round it as well. In a
container its path may be that of the host, of which only the lower part can be seen, or none.
"""

from __future__ import annotations

import contextlib
import math
import os
import re
import sys
from collections.abc import Iterator
from mmap import mmap
from pathlib import Path

from .loading import load

if sys.platform != "win32":
    import resource

#: Needs below this are not compared with what the machine has [bytes].
_SMALL = 2**27
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
    return min(_of_machine(), address_space(), memory_left_of_group())


def peak() -> int:
    """Most bytes of memory that this process has held so far; 0 where the system does not tell."""
    if sys.platform == "win32":
        return 0
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return most if sys.platform == "darwin" else 1024 * most


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
    of_space, of_data = (
        resource.getrlimit(resource.RLIMIT_AS),
        resource.getrlimit(resource.RLIMIT_DATA),
    )
    soft = ((0, of_space[0]), (5, of_data[0]))
    return {place: float(most) for place, most in soft if most != resource.RLIM_INFINITY}


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


def memory_left_of_group(root: Path = _ROOT) -> float:
    """Bytes that the groups of this process, and those round them, leave; infinity without a bound.

    Args:
        root: Where `proc` and `sys` are, which other systems have not.
    """
    return min((_left(old, folder) for old, folder in _groups(root, "memory")), default=math.inf)


def processors_of_group(root: Path) -> float:
    """How many processors' time the groups may use, such as 1.5; infinity without a bound."""
    return min((_share(old, folder) for old, folder in _groups(root, "cpu")), default=math.inf)


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
        share = processors_of_group(root)
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


_ESCAPED = r"\\([0-7]{3})"
#: Where they are mounted if `mountinfo` does not say: that of version 2, and those of version 1.
_USUAL = "/sys/fs/cgroup"


def _left(is_first_version: bool, folder: Path) -> float:
    """Swap is not counted, as little as in `MemAvailable`: an analysis in it has no end."""
    if is_first_version:
        told = _table(folder / "memory.stat")
        # The second counts groups round it as well, also those that cannot be seen.
        most = min(
            _number(folder / "memory.limit_in_bytes"), _read(told, "hierarchical_memory_limit")
        )
        used, cached = folder / "memory.usage_in_bytes", "total_inactive_file"
    else:
        # Above `high` the processes are held up until they hardly go on.
        most = min(_number(folder / "memory.max"), _number(folder / "memory.high"))
        if most == math.inf:
            return most
        told = _table(folder / "memory.stat")
        used, cached = folder / "memory.current", "inactive_file"
    # Files that are kept in memory while nobody else wants it.
    given_back = _read(told, cached, 0.0)
    return max(0.0, most - max(0.0, _number(used, 0.0) - given_back))


def _share(is_first_version: bool, folder: Path) -> float:
    if is_first_version:
        quota = _number(folder / "cpu.cfs_quota_us")
        period = _number(folder / "cpu.cfs_period_us", 0.0)
    else:
        quota, period = [*map(_as_number, _text(folder / "cpu.max").split()), math.inf, 0.0][:2]
    return quota / period if quota > 0 and period > 0 else math.inf


def _groups(root: Path, controller: str) -> Iterator[tuple[bool, Path]]:
    """The folders of the groups of this process and of those round them, and their version."""
    for line in _text(root / "proc/self/cgroup").splitlines() or ["0::/", f"1:{controller}:/"]:
        _, controllers, group = [*line.split(":", 2), "", ""][:3]
        is_first_version = bool(controllers)
        if is_first_version and controller not in controllers.split(","):
            continue
        for top, folder in _mounts(root, controller, is_first_version):
            # From the group at the top of what is mounted.
            below = group[len(top) :] if top != "/" and f"{group}/".startswith(f"{top}/") else group
            parts = [part for part in below.split("/") if part not in ("", "..")]
            place = root / folder.lstrip("/")
            for depth in range(len(parts), -1, -1):
                yield is_first_version, place.joinpath(*parts[:depth])


def _mounts(root: Path, controller: str, is_first_version: bool) -> list[tuple[str, str]]:
    """Where groups can be seen: the group at the top of what is mounted, and the folder."""
    found = []
    for line in _text(root / "proc/self/mountinfo").splitlines():
        before, _, behind = line.partition(" - ")
        words, kinds = before.split(), behind.split()
        if len(words) < 5 or len(kinds) < 3:
            continue
        is_old = kinds[0] == "cgroup" and controller in kinds[2].split(",")
        if is_old if is_first_version else kinds[0] == "cgroup2":
            found.append((_plain(words[3]), _plain(words[4])))
    usual = f"{_USUAL}/{controller}" if is_first_version else _USUAL
    return found or [("/", usual)]


def _plain(path: str) -> str:
    return re.sub(_ESCAPED, lambda found: chr(int(found[1], 8)), path)


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8", errors="replace")
    except (OSError, ValueError):
        return ""


def _table(path: Path) -> dict[str, float]:
    """Lines of a name and a number."""
    pairs = (line.split() for line in _text(path).splitlines())
    return {pair[0]: _as_number(pair[1]) for pair in pairs if len(pair) == 2}


def _read(table: dict[str, float], name: str, missing: float = math.inf) -> float:
    value = table.get(name, missing)
    return value if math.isfinite(value) else missing


def _number(path: Path, missing: float = math.inf) -> float:
    value = _as_number(_text(path))
    return value if math.isfinite(value) else missing


def _as_number(text: str) -> float:
    """A number; infinity for "max", and for what is none."""
    try:
        value = float(text)
    except ValueError:
        return math.inf
    return math.inf if math.isnan(value) else value


#: Below this the threads of BLAS, and their buffers, are a burden [bytes].
_NARROW = 2.0**31
#: What numpy's own BLAS takes for a buffer, and more [bytes].
_BUFFER = 2**26
#: What numpy and the core take when they are loaded, but for buffers [bytes].
_LIBRARIES = 2**27
_VARIABLE = "OPENBLAS_NUM_THREADS"


def prepare_libraries() -> None:
    """Where the address space is narrow let each OpenBLAS start with one thread, with its buffer.

    Else it ends the process, or asks for memory for ever, when it gets none; see
    flexact_blas.c. What cannot be loaded now is told of when it is wanted.

    Raises:
        MemoryError: What is to be loaded would find no room, and may end the process.
    """
    left = address_space()
    if left >= _NARROW:
        return
    if left < _LIBRARIES and "flexact.core._core" not in sys.modules:
        raise MemoryError(
            f"the limits of the process leave {left / 1e6:.3g} MB, and its libraries need more"
        )
    was_given = _VARIABLE in os.environ
    os.environ.setdefault(_VARIABLE, "1")
    try:
        with contextlib.suppress(ImportError, MemoryError, OSError):
            numpy = load("numpy")
            load("flexact.core._core")
            mmap(-1, _BUFFER).close()
            square = numpy.zeros((256, 256))
            square @ square
    finally:
        if not was_given:
            del os.environ[_VARIABLE]
