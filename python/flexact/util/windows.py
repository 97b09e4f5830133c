# SPDX-License-Identifier: BSD-3-Clause
"""What Windows says of a process: memory and processors it may have, and of its console.

Sizes and places of what it fills in are those of its headers (winnt.h, psapi.h) for 64 and 32
bits. Each question has an answer, infinity or False, where the system gives none.
"""

from __future__ import annotations

import ctypes
import math
from collections.abc import Iterator
from typing import Any

#: Classes of what can be asked about a job, and flags of what holds of it.
_EXTENDED_LIMITS, _CPU_RATE = 9, 15
_WORKING_SET, _PROCESS_MEMORY, _JOB_MEMORY = 0x1, 0x100, 0x200
_RATE_IS_ON, _RATE_IS_HARD = 0x1, 0x4
_WHOLE_RATE = 10_000
#: Of a look at a process: the right to it, the error where there is none, the code of one alive.
_LIMITED_LOOK, _NO_SUCH_PROCESS, _STILL_ACTIVE = 0x1000, 87, 259
#: Escape sequences are obeyed by a console in this mode.
_OBEYS_ESCAPES = 0x4
_HANDLES = {1: -11, 2: -12}
_INVALID = ctypes.c_void_p(-1).value


class MemoryStatus(ctypes.Structure):
    """MEMORYSTATUSEX."""

    _fields_ = [
        ("length", ctypes.c_uint32),
        ("load", ctypes.c_uint32),
        ("total_physical", ctypes.c_uint64),
        ("free_physical", ctypes.c_uint64),
        ("total_commit", ctypes.c_uint64),
        ("free_commit", ctypes.c_uint64),
        ("total_virtual", ctypes.c_uint64),
        ("free_virtual", ctypes.c_uint64),
        ("free_extended", ctypes.c_uint64),
    ]


class BasicLimits(ctypes.Structure):
    """JOBOBJECT_BASIC_LIMIT_INFORMATION."""

    _fields_ = [
        ("process_time", ctypes.c_int64),
        ("job_time", ctypes.c_int64),
        ("flags", ctypes.c_uint32),
        ("least_working_set", ctypes.c_size_t),
        ("most_working_set", ctypes.c_size_t),
        ("processes", ctypes.c_uint32),
        ("affinity", ctypes.c_size_t),
        ("priority", ctypes.c_uint32),
        ("scheduling", ctypes.c_uint32),
    ]


class ExtendedLimits(ctypes.Structure):
    """JOBOBJECT_EXTENDED_LIMIT_INFORMATION."""

    _fields_ = [
        ("basic", BasicLimits),
        ("transfers", ctypes.c_uint64 * 6),
        ("process_memory", ctypes.c_size_t),
        ("job_memory", ctypes.c_size_t),
        ("peak_process_memory", ctypes.c_size_t),
        ("peak_job_memory", ctypes.c_size_t),
    ]


class ProcessMemory(ctypes.Structure):
    """PROCESS_MEMORY_COUNTERS."""

    _fields_ = [
        ("length", ctypes.c_uint32),
        ("faults", ctypes.c_uint32),
        ("peak_working_set", ctypes.c_size_t),
        ("working_set", ctypes.c_size_t),
        ("pools", ctypes.c_size_t * 4),
        ("commit", ctypes.c_size_t),
        ("peak_commit", ctypes.c_size_t),
    ]


class CpuRate(ctypes.Structure):
    """JOBOBJECT_CPU_RATE_CONTROL_INFORMATION."""

    _fields_ = [("flags", ctypes.c_uint32), ("rate", ctypes.c_uint32)]


def _kernel() -> Any:
    """The library that all of this is in."""
    return ctypes.WinDLL("kernel32", use_last_error=True)  # type: ignore[attr-defined]


def memory_left(kernel: Any = None) -> float:
    """Bytes that the machine and the job round this process, such as a container, leave it."""
    try:
        kernel = kernel or _kernel()
        return min((math.inf, *_of_machine(kernel), *_of_job(kernel)))
    except (AttributeError, OSError):
        return math.inf


def _of_machine(kernel: Any) -> Iterator[float]:
    status = MemoryStatus(length=ctypes.sizeof(MemoryStatus))
    if kernel.GlobalMemoryStatusEx(ctypes.byref(status)):
        # What is asked for counts as taken here, whether or not it is used.
        yield float(min(status.free_physical, status.free_commit, status.free_virtual))


def _of_job(kernel: Any) -> Iterator[float]:
    limits = ExtendedLimits()
    if not _asked(kernel, _EXTENDED_LIMITS, limits):
        return
    # What others in the job use is not told: nothing is counted but what this process has.
    own = ProcessMemory(length=ctypes.sizeof(ProcessMemory))
    if not kernel.K32GetProcessMemoryInfo(_this(kernel), ctypes.byref(own), own.length):
        own = ProcessMemory()
    for flag, most, used in (
        (_PROCESS_MEMORY, limits.process_memory, own.commit),
        (_JOB_MEMORY, limits.job_memory, own.commit),
        (_WORKING_SET, limits.basic.most_working_set, own.working_set),
    ):
        if limits.basic.flags & flag:
            yield max(0.0, float(most) - float(used))


def processors(count: int, kernel: Any = None) -> float:
    """How many processors' time this process may use.

    Args:
        count: How many the machine has.
        kernel: The library to ask.
    """
    try:
        kernel = kernel or _kernel()
        return min((math.inf, *_of_affinity(kernel), *_of_rate(kernel, count)))
    except (AttributeError, OSError):
        return math.inf


def _of_affinity(kernel: Any) -> Iterator[float]:
    mine, all_of_them = ctypes.c_size_t(), ctypes.c_size_t()
    if not kernel.GetProcessAffinityMask(
        _this(kernel), ctypes.byref(mine), ctypes.byref(all_of_them)
    ):
        return
    # A process that is in several groups of processors is bound to none; then both are zero. With
    # all that its group has, it is free to go to others (since Windows 11).
    if mine.value and mine.value != all_of_them.value:
        yield float(mine.value.bit_count())


def _of_rate(kernel: Any, count: int) -> Iterator[float]:
    rate = CpuRate()
    if _asked(kernel, _CPU_RATE, rate) and rate.flags & _RATE_IS_ON and rate.flags & _RATE_IS_HARD:
        yield count * rate.rate / _WHOLE_RATE


def _asked(kernel: Any, kind: int, answer: ctypes.Structure) -> bool:
    """Whether the job of this process, if it is in one, has filled in an answer."""
    size = ctypes.sizeof(answer)
    return bool(kernel.QueryInformationJobObject(None, kind, ctypes.byref(answer), size, None))


def _this(kernel: Any) -> ctypes.c_void_p:
    """This process, by the handle that means it everywhere."""
    kernel.GetCurrentProcess.restype = ctypes.c_void_p
    return ctypes.c_void_p(kernel.GetCurrentProcess())


def is_alive(process: int, kernel: Any = None) -> bool:
    """Whether a process is there, by its number; also where that cannot be told."""
    try:
        kernel = kernel or _kernel()
        kernel.OpenProcess.restype = ctypes.c_void_p
        kernel.OpenProcess.argtypes = (ctypes.c_uint32, ctypes.c_int, ctypes.c_uint32)
        handle = kernel.OpenProcess(_LIMITED_LOOK, False, process)
        if not handle:
            error = getattr(ctypes, "get_last_error", kernel.GetLastError)()
            return bool(error != _NO_SUCH_PROCESS)
        code = ctypes.c_uint32(_STILL_ACTIVE)
        kernel.GetExitCodeProcess(ctypes.c_void_p(handle), ctypes.byref(code))
        kernel.CloseHandle(ctypes.c_void_p(handle))
        return code.value == _STILL_ACTIVE
    except (AttributeError, OSError, ctypes.ArgumentError):
        return True


def obeys_escapes(number: int, kernel: Any = None) -> bool:
    """Whether the console behind stdout (1) or stderr (2) obeys escape sequences, as now asked."""
    try:
        kernel = kernel or _kernel()
        kernel.GetStdHandle.restype = ctypes.c_void_p
        handle = kernel.GetStdHandle(_HANDLES[number])
        mode = ctypes.c_uint32()
        if handle in (None, _INVALID):
            return False
        handle = ctypes.c_void_p(handle)
        if not kernel.GetConsoleMode(handle, ctypes.byref(mode)):
            return False
        if mode.value & _OBEYS_ESCAPES:
            return True
        return bool(kernel.SetConsoleMode(handle, mode.value | _OBEYS_ESCAPES))
    except (AttributeError, OSError):
        return False
