# SPDX-License-Identifier: BSD-3-Clause
"""Ctrl-C and termination: at once and quietly; no file half-written, nothing left behind."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from small_decks import DECKS, write
from test_cli_process import process_environment

from flexact.apps.cli.main import main
from flexact.util.interruption import SIGNALS, Stopped, undisturbed, unwinding

pytestmark = pytest.mark.posix

LATE = 20.0
#: A command in which a function, once it runs, says so and goes on for longer than anybody waits.
SLOW = """\
import os, sys, time
from pathlib import Path
import {module} as module

def slow(*given, **named):
    {before}
    os.write(1, b"ready\\n")
    time.sleep(60)

module.{function} = slow
from flexact.apps.cli.main import main
sys.exit(main())
"""


def stop_when_ready(
    program: list[str], number: int, environment: Mapping[str, str] | None = None
) -> tuple[int, bytes]:
    """Exit code and stderr of a process that gets a signal when it says that it is ready."""
    process = subprocess.Popen(
        [sys.executable, *program],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=process_environment() | (environment or {}),
    )
    try:
        assert process.stdout is not None
        assert process.stdout.readline() == b"ready\n"
        process.send_signal(number)
        _, reported = process.communicate(timeout=LATE)
    finally:
        process.kill()
    return process.returncode, reported


def bars_in_a_row(bays: int) -> str:
    """A planar frame: two bars fix every joint of its upper and lower chord."""
    lines = ["X 1 0 0", "X 2 0 1", "FIX 1", "FIX 2"]
    for k in range(1, bays + 1):
        low, high = 2 * k + 1, 2 * k + 2
        lines += [f"X {low} {k} 0", f"X {high} {k} 1"]
        ends = ((low - 2, low), (low - 1, low), (high - 2, high), (low, high))
        lines += [f"PLTRUSS {4 * k + i} {p} {q}" for i, (p, q) in enumerate(ends)]
    return "\n".join(lines) + "\n"


def test_control_c_ends_the_decomposition_at_once(tmp_path: Path) -> None:
    """The core cannot be interrupted from Python: 3600 x 3600 takes it longer than LATE."""
    deck = write(tmp_path / "long.dat", bars_in_a_row(900))
    process = subprocess.Popen(
        [sys.executable, "-m", "flexact", "analyse", "--method", "svd", str(deck)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=process_environment(),
    )
    try:
        assert process.stderr is not None
        assert process.stderr.readline().count(b"3600") == 2
        time.sleep(0.3)  # until the core has begun
        process.send_signal(signal.SIGINT)
        said, reported = process.communicate(timeout=LATE)
    finally:
        process.kill()
    assert (process.returncode, said, reported) == (-signal.SIGINT, b"", b"")


def test_control_c_during_an_import_is_quiet(tmp_path: Path) -> None:
    """Of meshio here, which writes the mesh and is imported when it is wanted."""
    write(tmp_path / "meshio.py", "import time\nprint('ready', flush=True)\ntime.sleep(60)\n")
    deck = write(tmp_path / "exact.dat", DECKS["exact"])
    path = os.pathsep.join((str(tmp_path), process_environment()["PYTHONPATH"]))
    program = ["-m", "flexact", "analyse", str(deck), "-o", str(tmp_path / "out")]
    ending = stop_when_ready(program, signal.SIGINT, {"PYTHONPATH": path})
    assert ending == (-signal.SIGINT, b"")


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize(
    ("module", "function", "before"),
    [
        ("meshio", "write", "Path(given[0]).write_text('half of it')"),
        ("flexact.util.outputs", "new_file", "given[0].write_text('half of it')"),
    ],
)
def test_nothing_is_left_behind_while_writing(
    number: int, module: str, function: str, before: str, decks: Path, tmp_path: Path
) -> None:
    temporary, out = tmp_path / "temporary", tmp_path / "out"
    temporary.mkdir()
    code = SLOW.format(module=module, function=function, before=before)
    program = ["-c", code, "analyse", str(decks), "-o", str(out)]
    assert stop_when_ready(program, number, {"TMPDIR": str(temporary)}) == (-number, b"")
    assert [path for path in (*temporary.rglob("*"), *out.rglob("*"))] == []


def test_a_host_of_the_command_gets_its_exit_code(
    decks: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def interrupt(*_: object, **__: object) -> None:
        signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr("flexact.apps.cli.decks.result_of", interrupt)
    before = signal.getsignal(signal.SIGINT)
    assert main(["analyse", str(decks / "exact.dat")]) == 130
    assert "Traceback" not in capsys.readouterr().err
    assert signal.getsignal(signal.SIGINT) is before


def test_signals_unwind_and_are_as_before_afterwards() -> None:
    before = [signal.getsignal(number) for number in SIGNALS]
    assert signal.getsignal(signal.SIGTERM) is signal.SIG_DFL
    with pytest.raises(Stopped) as stop, unwinding():
        signal.raise_signal(signal.SIGTERM)
    assert stop.value.number == signal.SIGTERM
    assert [signal.getsignal(number) for number in SIGNALS] == before


class Swallowing(type):
    """A class that is sent a signal while NumPy asks it for attributes, and forgets exceptions."""

    def __getattr__(cls, name: str) -> object:
        signal.raise_signal(signal.SIGTERM)
        raise AttributeError(name)


def test_a_signal_that_is_swallowed_ends_the_work_at_the_next_look() -> None:
    class Asked(metaclass=Swallowing):
        pass

    steps = []
    with pytest.raises(Stopped), unwinding() as look:
        assert np.ones(1) != Asked
        steps.append("swallowed")
        look()
        steps.append("never")
    assert steps == ["swallowed"]


def test_signals_are_held_back() -> None:
    steps = []
    with pytest.raises(Stopped), unwinding():
        try:
            with undisturbed():
                signal.raise_signal(signal.SIGTERM)
                steps.append("first")
            steps.append("never")
        finally:
            steps.append("last")
    assert steps == ["first", "last"]
