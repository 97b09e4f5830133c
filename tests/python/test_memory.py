# SPDX-License-Identifier: BSD-3-Clause
"""Limits of memory: all that there are, and an end in words below them; threads of BLAS."""

import ctypes
import math
import mmap
import subprocess
import sys
import threading
from pathlib import Path

import pytest
from known_models import twelve_trusses
from small_decks import write
from test_cli_process import process_environment
from verdicts import counts

import flexact
from flexact.apps.cli.main import main
from flexact.core import _core
from flexact.util import machine as memory

pytestmark = pytest.mark.dear(10)

PAGE = mmap.PAGESIZE
MB = 2**20
#: Limits of the address space.
LIMITED = pytest.mark.posix("linux")


def given(root: Path, **files: str) -> Path:
    for name, text in files.items():
        write(root / name.replace("__", "/").replace("_DOT_", "."), text)
    return root


def groups(root: Path) -> float:
    return memory.memory_left_of_group(root)


def test_the_address_space_that_is_left(tmp_path: Path) -> None:
    given(tmp_path, proc__self__statm="1000 1 1 1 0 300 0\n")
    assert memory.address_space({}, tmp_path) == math.inf
    aside = memory._ASIDE
    for limits, left in (
        ({0: 9e9}, 9e9 - 1000 * PAGE - aside),
        ({5: 9e9}, 9e9 - 300 * PAGE - aside),
        ({0: 9e9, 5: 8e9}, 8e9 - 300 * PAGE - aside),
        ({0: 1000.0}, 0.0),
    ):
        assert memory.address_space(limits, tmp_path) == left
    assert memory.address_space({0: 9e9}, tmp_path / "none") == 9e9 - aside


def test_the_groups_of_version_2_and_those_round_them(tmp_path: Path) -> None:
    assert groups(tmp_path) == math.inf
    given(tmp_path, proc__self__cgroup="0::/outer/inner\n")
    assert groups(tmp_path) == math.inf
    group = {"memory.max": "max\n", "memory.current": "400\n"}
    for folder in ("outer/inner", "outer", ""):
        for name, text in group.items():
            write(tmp_path / "sys/fs/cgroup" / folder / name, text)
    assert groups(tmp_path) == math.inf
    write(tmp_path / "sys/fs/cgroup/outer/memory.max", "1000\n")
    assert groups(tmp_path) == 600
    write(tmp_path / "sys/fs/cgroup/outer/memory.stat", "anon 3\ninactive_file 50\n")
    assert groups(tmp_path) == 650
    write(tmp_path / "sys/fs/cgroup/outer/inner/memory.max", "500\n")
    assert groups(tmp_path) == 100
    write(tmp_path / "sys/fs/cgroup/memory.max", "300\n")
    assert groups(tmp_path) == 0


def test_the_groups_of_version_1(tmp_path: Path) -> None:
    """In a container, the path of the group is that of the host, which cannot be seen."""
    given(tmp_path, proc__self__cgroup="4:cpu:/x\n7:memory,hugetlb:/docker/8\n0::/x\n")
    folder = tmp_path / "sys/fs/cgroup/memory"
    write(folder / "memory.limit_in_bytes", "1000\n")
    write(folder / "memory.usage_in_bytes", "900\n")
    write(folder / "memory.stat", "cache 40\ntotal_inactive_file 30\n")
    assert groups(tmp_path) == 130
    write(folder / "memory.limit_in_bytes", "nonsense\n")
    assert groups(tmp_path) == math.inf


def test_the_least_limit_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    big, least = 10.0 * memory._SMALL, 2.0 * memory._SMALL
    readers = {"_of_machine": big, "address_space": big}
    for name in readers:
        for other, value in readers.items():
            monkeypatch.setattr(memory, other, lambda value=value: value)
        monkeypatch.setattr(memory, "memory_left_of_group", lambda: big)
        monkeypatch.setattr(memory, name, lambda: least)
        assert memory.available() == memory.allowance() == least
    monkeypatch.setattr(memory, "address_space", lambda: 1e6)
    assert memory.allowance(1.0) == memory.allowance() == 1e6
    monkeypatch.setattr(memory, "address_space", lambda: big)
    monkeypatch.setattr(memory, "memory_left_of_group", lambda: least)
    assert memory.available() == least


def limited(
    command: list[str], size: int, threads: str | None
) -> subprocess.CompletedProcess[bytes]:
    """A command with so many MB of address space."""
    environment = {k: v for k, v in process_environment().items() if k != "OPENBLAS_NUM_THREADS"}
    if threads:
        environment["OPENBLAS_NUM_THREADS"] = threads
    limit = f'ulimit -v {size * 1024}; ulimit -c 0; exec "$@"'
    return subprocess.run(
        ["sh", "-c", limit, "sh", sys.executable, *command],
        capture_output=True,
        env=environment,
        timeout=120,
    )


@LIMITED
@pytest.mark.parametrize("threads", ["1", None])
@pytest.mark.parametrize("size", [2000, 900, 500, 390, 330, 290, 250, 150, 90, 40])
def test_a_narrow_address_space_ends_in_words(
    size: int, threads: str | None, tmp_path: Path
) -> None:
    """Before, OpenBLAS waited for ever, or Fortran and CHOLMOD ended the process."""
    grid = write(tmp_path / "grid.dat", bar_grid(82))
    small = write(tmp_path / "small.dat", twelve_trusses().to_deck())
    for deck, method in ((small, "auto"), (grid, "sparse")):
        done = limited(["-m", "flexact", "analyse", str(deck), "--method", method], size, threads)
        said = done.stderr.decode()
        assert done.returncode in (0, 1, 2), said
        assert "Traceback" not in said and len(said.splitlines()) <= 4
        assert bool(done.stdout) == (done.returncode == 0)
        assert "memory" in said or done.returncode == 0
        assert done.returncode == 0 or size < 500, said


@LIMITED
def test_a_narrow_address_space_is_a_memory_error_in_python(tmp_path: Path) -> None:
    """Of the Jacobian of 20,000 bars, and of an analysis."""
    code = """
import sys
import flexact
model = flexact.read(sys.argv[1])
import resource
for call in (flexact.jacobian, flexact.analyse):
    used = 4096 * int(open("/proc/self/statm").read().split()[0])
    hard = resource.getrlimit(resource.RLIMIT_AS)[1]
    resource.setrlimit(resource.RLIMIT_AS, (used + int(sys.argv[2]), hard))
    try:
        print(call(model).shape)
    except (MemoryError, flexact.AnalysisError) as error:
        assert str(error)
        print("refused")
"""
    grid = write(tmp_path / "grid.dat", bar_grid(82))
    for left in (12 * MB, 40 * MB, 110 * MB):
        done = limited(["-c", code, str(grid), str(left)], 4000, "1")
        assert done.returncode == 0, done.stderr.decode()
        assert done.stdout.split()[-1] == b"refused"


@LIMITED
def test_analyses_at_once_wait_for_room(tmp_path: Path) -> None:
    """Where the buffers of eight would not do, one goes after the other."""
    code = """
import sys, threading
import flexact
model = flexact.read(sys.argv[1])
found = []
def work():
    for _ in range(3):
        found.append(flexact.analyse(model, method="svd").over_constrained)
threads = [threading.Thread(target=work) for _ in range(8)]
for thread in threads: thread.start()
for thread in threads: thread.join()
print(len(found), *set(found) - {flexact.analyse(model).over_constrained})
"""
    strip = write(tmp_path / "grid.dat", bar_grid(9))
    done = limited(["-c", code, str(strip)], 1500, None)
    assert done.stdout.split() == [b"24"], done.stderr.decode()


@LIMITED
def test_a_deck_of_twenty_megabytes_in_one_gigabyte(tmp_path: Path) -> None:
    """A million lines; before, three gigabytes were asked for."""
    deck = write(tmp_path / "large.dat", bar_grid(497))
    assert deck.stat().st_size > 20e6
    done = limited(["-m", "flexact", "check", str(deck)], 1_000_000 // 1024, "2")
    assert (done.returncode, done.stderr) == (0, b""), done.stderr.decode()


#: Lines of each element, and behind all of them, by what reading them takes the most of.
TAKING = {
    "bars of nodes of their own": ("TRUSS {a} {b} {c}", ""),
    "bars of a chain": ("TRUSS {k} {k} {n}", "X {n} {k} 0"),
    "bars with names": ("TRUSS {k} 1 {n} % bar {k}", "X {n} {k} 0 % point {n}"),
    "beams of nodes of their own": ("BEAM {k} {b} {c} {d} {e}", ""),
    "beams with warping": ("BEAMW {a} {b} {c} {d} {e} {f} {g}", ""),
    "arms": ("RBEAM {k} {k} 1000000 {n}", "X {n} {k} 0"),
    "places": ("X 1 0", ""),
    "supports": ("PLTRUSS {k} {k} {n}", "X {n} {k}\nFIX {n}"),
    "indented": ("        TRUSS {k} {k} {n}", "    X {n} {k} 0"),
    "stiffness": ("BEAM {k} {b} {c} {d} {e}", "ESTIFF {k} 1 2\nXM {b} 1\nXF {b} 1"),
}


@LIMITED
@pytest.mark.parametrize("lines", TAKING.values(), ids=TAKING)
def test_reading_takes_no_more_than_is_asked_for(lines: tuple[str, str], tmp_path: Path) -> None:
    """Otherwise the process would end where a limit is near."""
    code = """
import sys
import numpy as np
from flexact.core import _core, calls
def status(name):
    with open("/proc/self/status") as file:
        return next(1024 * int(line.split()[1]) for line in file if line.startswith(name))
text = np.fromfile(sys.argv[1], np.int8)
room, reading = calls._most_in(text)
made, before = room.made(), status("VmSize")
nodes, elements, *_ = _core.read_deck(text, *made)
assert nodes <= room.nodes and elements <= room.elements, (nodes, elements, room)
assert status("VmPeak") - before < reading, (status("VmPeak") - before, reading)
"""
    stated, behind = (
        "\n".join(
            form.format(k=k, n=k + 1, **{c: 49 * k + 8 * i for i, c in enumerate("abcdefg")})
            for k in range(1, 131_100)
        )
        for form in lines
    )
    end = "END\n" if "ESTIFF" in behind else ""
    deck = write(tmp_path / "deck.dat", f"TRUSS 9999999 1 2\n{stated}\n{end}{behind}\nEND\nEND\n")
    done = subprocess.run([sys.executable, "-c", code, str(deck)], capture_output=True)
    assert done.returncode == 0, done.stderr.decode()


def bar_grid(side: int) -> str:
    """A deck of triangles in the plane, of about three bars a node."""
    lines = []
    bars = ((1, 0), (0, 1), (1, 1))
    for i in range(side):
        for j in range(side):
            for right, up in bars:
                if i + right < side and j + up < side:
                    ends = i * side + j + 1, (i + right) * side + j + up + 1
                    lines.append(f"PLTRUSS {len(lines) + 1} {ends[0]} {ends[1]}")
    places = [f"X {i * side + j + 1} {i} {j}" for i in range(side) for j in range(side)]
    return "\n".join([*lines, *places, "FIX 1", f"FIX {side}", "END", ""])


# Threads of BLAS


@pytest.fixture
def blas() -> ctypes.CDLL:
    """The core, with the BLAS that it is linked with."""
    library = ctypes.CDLL(_core.__file__)
    try:
        many = library.openblas_get_num_threads() > 1 and library.openblas_get_parallel() == 1
    except AttributeError:
        many = False
    if not many:
        pytest.skip("OpenBLAS has but one thread, or is not there")
    library.flexact_blas_begin.argtypes = [ctypes.c_int, ctypes.c_double, ctypes.c_void_p]
    library.flexact_blas_end.argtypes = [ctypes.c_void_p]
    return library


def test_threads_of_blas_are_for_one_large_analysis_alone(blas: ctypes.CDLL) -> None:
    many = blas.openblas_get_num_threads()
    works = [(ctypes.c_int * 4)() for _ in range(3)]
    for small, work, threads in zip((0, 0, 1), works, (many, 1, 1), strict=True):
        assert blas.flexact_blas_begin(small, 0.0, work) == 0
        assert blas.openblas_get_num_threads() == threads
    for work, threads in zip(works, (1, 1, many), strict=True):
        blas.flexact_blas_end(work)
        assert blas.openblas_get_num_threads() == threads
    assert blas.flexact_blas_begin(1, 0.0, works[0]) == 0
    assert blas.openblas_get_num_threads() == 1
    blas.flexact_blas_end(works[0])
    assert blas.openblas_get_num_threads() == many


def test_threads_of_blas_are_given_back(blas: ctypes.CDLL) -> None:
    many = blas.openblas_get_num_threads()
    found = []

    def work() -> None:
        found.extend(counts(flexact.analyse(twelve_trusses())) for _ in range(20))

    threads = [threading.Thread(target=work) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [(1, 1)] * 160
    assert blas.openblas_get_num_threads() == many


@pytest.mark.parametrize("where", ["calls.read_deck", "_content"])
def test_a_deck_that_does_not_fit_is_not_the_deck_s_fault(
    where: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Exit code 2, of what is about the run: docs/command.md."""

    def full(*_: object) -> None:
        raise MemoryError

    monkeypatch.setattr(f"flexact.model.reading.{where}", full)
    deck = write(tmp_path / "x.dat", "TRUSS 1 1 2\nX 2 1 0 0\n")
    for verb in ("analyse", "check", "advise"):
        assert main([verb, str(deck)]) == 2
        assert "does not fit into memory" in capsys.readouterr().err
