# SPDX-License-Identifier: BSD-3-Clause
"""kernel32.dll as far as Flexact asks it, filled in by byte places of the headers of Windows."""

from __future__ import annotations

import ctypes
import struct
from typing import Any

MEMORY_STATUS, EXTENDED_LIMITS, PROCESS_MEMORY, CPU_RATE = 64, 144, 72, 8
THIS = 2**64 - 1


class Function:
    """A function that also takes the types that are set for it."""

    def __init__(self, call: Any) -> None:
        self.call = call
        self.restype: Any = None
        self.argtypes: Any = None

    def __call__(self, *given: Any) -> Any:
        return self.call(*given)


class Kernel:
    """A machine, the job round the process, and the process; what is None cannot be asked."""

    def __init__(
        self,
        machine: tuple[int, int, int] | None = None,
        job: dict[str, int] | None = None,
        process: tuple[int, int] | None = None,
        rate: tuple[int, int] | None = None,
        affinity: tuple[int, int] | None = None,
    ) -> None:
        self.machine, self.job, self.process = machine, job, process
        self.rate, self.affinity = rate, affinity
        self.GetCurrentProcess = Function(lambda: THIS)

    def GlobalMemoryStatusEx(self, status: Any) -> int:  # noqa: N802
        raw = view(status, MEMORY_STATUS)
        assert struct.unpack_from("<I", raw, 0) == (MEMORY_STATUS,)
        if self.machine is None:
            return 0
        for place, value in zip((16, 32, 48), self.machine, strict=True):
            struct.pack_into("<Q", raw, place, value)
        return 1

    def QueryInformationJobObject(  # noqa: N802
        self, job: None, kind: int, answer: Any, size: int, told: None
    ) -> int:
        assert job is None and told is None
        if kind == 9 and self.job is not None:
            assert size == EXTENDED_LIMITS
            raw = view(answer, size)
            struct.pack_into("<I", raw, 16, self.job["flags"])
            struct.pack_into("<Q", raw, 32, self.job.get("working_set", 0))
            struct.pack_into("<QQ", raw, 112, self.job.get("process", 0), self.job.get("job", 0))
            return 1
        if kind == 15 and self.rate is not None:
            assert size == CPU_RATE
            struct.pack_into("<II", view(answer, size), 0, *self.rate)
            return 1
        return 0

    def K32GetProcessMemoryInfo(self, process: Any, answer: Any, size: int) -> int:  # noqa: N802
        assert size == PROCESS_MEMORY and process.value == THIS
        if self.process is None:
            return 0
        raw = view(answer, size)
        struct.pack_into("<Q", raw, 16, self.process[0])
        struct.pack_into("<Q", raw, 56, self.process[1])
        return 1

    def GetProcessAffinityMask(self, process: Any, mine: Any, every: Any) -> int:  # noqa: N802
        assert process.value == THIS
        if self.affinity is None:
            return 0
        for pointer, value in zip((mine, every), self.affinity, strict=True):
            struct.pack_into("<Q", view(pointer, 8), 0, value)
        return 1


def view(pointer: Any, size: int) -> Any:
    """The bytes behind what `ctypes.byref` gives."""
    assert ctypes.sizeof(pointer._obj) == size
    return (ctypes.c_char * size).from_buffer(pointer._obj)
