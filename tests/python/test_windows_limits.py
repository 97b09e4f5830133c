# SPDX-License-Identifier: BSD-3-Clause
"""What Windows is asked, by a double of its library that knows sizes and places of its headers.

The sizes and places below are what a program printed that was compiled with the headers of
mingw-w64 10 (winnt.h, psapi.h) for x86_64 and run by Wine 8.
"""

import ctypes
import math
import sys

import pytest
from windows_doubles import Function, Kernel

import flexact
from flexact.model.model import Model
from flexact.util import machine as engine_processors
from flexact.util import machine as memory
from flexact.util import windows

GB = 2**30
SIZES = {
    windows.MemoryStatus: (64, {"free_physical": 16, "free_commit": 32, "free_virtual": 48}),
    windows.BasicLimits: (64, {"flags": 16, "most_working_set": 32, "affinity": 48}),
    windows.ExtendedLimits: (144, {"process_memory": 112, "job_memory": 120}),
    windows.ProcessMemory: (72, {"working_set": 16, "commit": 56}),
    windows.CpuRate: (8, {"rate": 4}),
}
JOB, PROCESS, WORKING_SET = 0x200, 0x100, 0x1


@pytest.mark.skipif(ctypes.sizeof(ctypes.c_void_p) != 8, reason="places for 64 bits")
@pytest.mark.parametrize("kind", SIZES, ids=lambda kind: kind.__name__)
def test_what_is_filled_in_has_the_form_of_the_headers(kind: type[ctypes.Structure]) -> None:
    size, places = SIZES[kind]
    assert ctypes.sizeof(kind) == size
    assert {name: getattr(kind, name).offset for name in places} == places


@pytest.mark.parametrize(
    ("kernel", "expected"),
    [
        (Kernel(), math.inf),
        (Kernel(machine=(5 * GB, 9 * GB, 2**47)), 5 * GB),
        # Nothing more can be had, however much is free.
        (Kernel(machine=(5 * GB, 3 * GB, 2**47)), 3 * GB),
        # A process of 32 bits.
        (Kernel(machine=(5 * GB, 9 * GB, GB)), GB),
        (Kernel((5 * GB, 9 * GB, 2**47), {"flags": JOB, "job": 2 * GB}), 2 * GB),
        (Kernel((5 * GB, 9 * GB, 2**47), {"flags": JOB, "job": 2 * GB}, (7, GB)), GB),
        (Kernel(None, {"flags": PROCESS, "process": 3 * GB, "job": GB}, (7, GB)), 2 * GB),
        (Kernel(None, {"flags": WORKING_SET, "working_set": 3 * GB}, (GB, 7)), 2 * GB),
        (Kernel(None, {"flags": JOB, "job": GB}, (7, 2 * GB)), 0),
        # Numbers without their flag are none.
        (Kernel(None, {"flags": 0x2000, "job": 5, "process": 5, "working_set": 5}), math.inf),
    ],
)
def test_memory_that_is_left(kernel: Kernel, expected: float) -> None:
    assert windows.memory_left(kernel) == expected


@pytest.mark.parametrize(
    ("kernel", "expected"),
    [
        (Kernel(), math.inf),
        (Kernel(affinity=(0b1011, 0xFF)), 3),
        (Kernel(affinity=(0xFF, 0xFF)), math.inf),
        # A process in several groups of processors.
        (Kernel(affinity=(0, 0)), math.inf),
        (Kernel(rate=(0x1 | 0x4, 2_500)), 2),
        (Kernel(rate=(0x1 | 0x2, 5)), math.inf),
        (Kernel(rate=(0x4, 2_500)), math.inf),
        (Kernel(rate=(0x1 | 0x4, 5_000), affinity=(0b11, 0xFF)), 2),
    ],
)
def test_processors(kernel: Kernel, expected: float, monkeypatch: pytest.MonkeyPatch) -> None:
    assert windows.processors(8, kernel) == expected
    monkeypatch.setattr(sys, "platform", "win32")
    monkeypatch.setattr(windows, "_kernel", lambda: kernel)
    monkeypatch.setattr(engine_processors, "_given", lambda: 8)
    assert engine_processors.processors() == min(expected, 8)


def test_where_there_is_no_such_library_nothing_is_told() -> None:
    nothing = object()
    assert windows.memory_left(nothing) == windows.processors(4, nothing) == math.inf
    assert not windows.obeys_escapes(1, nothing)
    assert windows.is_alive(1, nothing)


class Console:
    """A console, or whatever else stdout is."""

    def __init__(self, mode: int | None, obeys: bool = True) -> None:
        self.mode, self.obeys = mode, obeys
        self.GetStdHandle = Function(lambda number: {-11: 44, -12: 48}[number])

    def GetConsoleMode(self, handle: ctypes.c_void_p, mode: object) -> int:  # noqa: N802
        assert handle.value in (44, 48)
        if self.mode is None:
            return 0
        mode._obj.value = self.mode  # type: ignore[attr-defined]
        return 1

    def SetConsoleMode(self, handle: ctypes.c_void_p, mode: int) -> int:  # noqa: N802
        assert handle.value in (44, 48)
        if self.obeys:
            self.mode = mode
        return int(self.obeys)


def test_a_console_is_asked_to_obey_escape_sequences() -> None:
    new, old = Console(0x3), Console(0x3, obeys=False)
    assert windows.obeys_escapes(1, new) and new.mode == 0x7
    assert windows.obeys_escapes(2, Console(0x7, obeys=False))
    assert not windows.obeys_escapes(1, old)
    assert not windows.obeys_escapes(1, Console(None))
    none = Console(3)
    none.GetStdHandle = Function(lambda _: None)
    assert not windows.obeys_escapes(1, none)


class Processes:
    """Processes by number, with their exit codes (259 of one that is alive)."""

    def __init__(self, error: int = 87, **codes: int) -> None:
        self.codes = {int(name[1:]): code for name, code in codes.items()}
        self.open = 0
        self.GetLastError = lambda: error
        self.OpenProcess = Function(self._open)

    def _open(self, right: int, inherit: bool, number: int) -> int | None:
        assert right == 0x1000 and not inherit
        self.open += number in self.codes
        return number if number in self.codes else None

    def GetExitCodeProcess(self, handle: ctypes.c_void_p, code: object) -> int:  # noqa: N802
        code._obj.value = self.codes[handle.value]  # type: ignore[attr-defined,index]
        return 1

    def CloseHandle(self, handle: ctypes.c_void_p) -> int:  # noqa: N802
        self.open -= 1
        return 1


@pytest.mark.skipif(sys.platform == "win32", reason="the last error is asked for in another way")
def test_which_processes_are_alive() -> None:
    found = Processes(_8=259, _9=0)
    assert windows.is_alive(8, found)
    assert not windows.is_alive(9, found) and not windows.is_alive(7, found)
    assert windows.is_alive(7, Processes(error=5))
    assert found.open == 0


def test_the_guard_of_memory_on_windows(monkeypatch: pytest.MonkeyPatch) -> None:
    """Before, what Windows has was infinity, and a large deck was begun whatever it needs."""
    monkeypatch.setattr(sys, "platform", "win32")
    kernel = Kernel((300 * 2**20, 9 * GB, 2**47))
    monkeypatch.setattr(windows, "_kernel", lambda: kernel)
    assert memory.available() == 300 * 2**20
    model = large()
    with pytest.raises(flexact.AnalysisError, match="memory"):
        flexact.analyse(model, method="svd")
    kernel.machine = (5 * GB, 9 * GB, 2**47)
    kernel.job = {"flags": JOB, "job": 200 * 2**20}
    assert memory.available() == 200 * 2**20
    with pytest.raises(flexact.AnalysisError, match="memory"):
        flexact.analyse(model, method="svd")


def large() -> Model:
    """Bars round one ring: D(c) has 3999 columns, and no part of it stands alone."""
    lines = [f"TRUSS {k} {k} {k % 2000 + 1}" for k in range(1, 2001)]
    lines += [f"X {k} {k} {k * k % 97} {k % 13}" for k in range(1, 2001)]
    return flexact.read_text("\n".join([*lines, "FIX 1"]))
