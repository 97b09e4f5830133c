# SPDX-License-Identifier: BSD-3-Clause
"""macOS and Windows, as far as they can be pretended; and text that is the same everywhere."""

from __future__ import annotations

import errno
import io
import json
import os
import signal
import subprocess
import sys
import types
import unicodedata
from pathlib import Path

import numpy as np
import pytest
from pretended_system import LACKING
from small_decks import DECKS, write
from test_cli_process import process_environment

import flexact
from flexact.apps.cli import terminal
from flexact.apps.cli.command import run
from flexact.apps.cli.main import main
from flexact.apps.watch import worker_pool as crew
from flexact.sweeps import journal
from flexact.sweeps import pool as local_pool
from flexact.util import interruption, windows
from flexact.util import machine as memory
from flexact.util import text as plain_text

pytestmark = pytest.mark.dear(18)

HERE = Path(__file__).parent
#: Characters of every kind that our words, or a deck, may hold.
ODD = "5 \xb5m \N{RIGHTWARDS ARROW} 2 m\xb2 \xb1 1\xb0"


@pytest.mark.posix("linux")
def test_all_of_it_loads_and_works_on_another_system(decks: Path) -> None:
    """All modules, and verbs that read, analyse, draw and write."""
    deck, made = decks / "exact.dat", decks.parent / "made"
    commands = {
        "darwin": (f"check {deck}", f"analyse --json {deck}", "--version -v"),
        "win32": (
            f"check {deck}",
            f"analyse --json {deck}",
            f"picture {deck} -o {made}/a.png",
            f"report {deck} -o {made}/pages",
            f"batch {decks} -o {made}/table.csv -j 1",
            "--version -v",
        ),
    }
    assert commands.keys() == LACKING.keys()
    given = ", ".join(f"{system} {' + '.join(all_)}" for system, all_ in commands.items())
    done = subprocess.run(
        [sys.executable, str(HERE / "pretended_system.py"), given],
        env=process_environment(),
        capture_output=True,
        timeout=300,
    )
    said = done.stderr.decode()
    codes = [line.split(":")[0] for line in said.splitlines() if line.startswith("exit ")]
    assert "Traceback" not in said
    assert codes == ["exit 0"] * 9, said
    answers = [line for line in done.stdout.decode().split("\n") if line.startswith("{")]
    verdicts = [json.loads(answer)["verdict"] for answer in answers]
    assert verdicts == ["exactly constrained"] * 2
    assert b"\r" not in done.stdout
    assert (made / "a.png").read_bytes().startswith(b"\x89PNG")
    assert (made / "pages").is_dir() and (made / "table.csv").exists()
    assert b"\r" not in (made / "table.csv").read_bytes()


# Memory of macOS


def of_psutil(available: float) -> types.SimpleNamespace:
    return types.SimpleNamespace(
        virtual_memory=lambda: types.SimpleNamespace(available=available, total=2**40)
    )


def test_the_guard_of_memory_on_macos(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Before, it was infinity."""
    monkeypatch.setattr(sys, "platform", "darwin")
    monkeypatch.setitem(sys.modules, "psutil", of_psutil(200 * 2**20))
    assert memory._of_machine(tmp_path) == 200 * 2**20
    of_machine = memory._of_machine
    monkeypatch.setattr(memory, "_of_machine", lambda: of_machine(tmp_path))
    assert memory.available() == memory.allowance() == 200 * 2**20
    lines = [f"TRUSS {k} {k} {k % 2000 + 1}" for k in range(1, 2001)]
    lines += [f"X {k} {k} {k * k % 97} {k % 13}" for k in range(1, 2001)]
    with pytest.raises(flexact.AnalysisError, match="memory"):
        flexact.analyse(flexact.read_text("\n".join([*lines, "FIX 1"])), method="svd")


def test_without_psutil_all_that_there_is_counts(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(sys, "platform", "darwin")
    monkeypatch.setitem(sys.modules, "psutil", None)
    told = {"SC_PHYS_PAGES": 1000, "SC_PAGE_SIZE": 16384}

    def sysconf(name: str) -> int:
        if name not in told:
            raise ValueError("unrecognized configuration name")
        return told[name]

    monkeypatch.setattr(os, "sysconf", sysconf, raising=False)
    assert memory._of_machine(tmp_path) == 1000 * 16384
    told["SC_AVPHYS_PAGES"] = 10
    assert memory._of_machine(tmp_path) == 10 * 16384
    monkeypatch.delattr(os, "sysconf")
    assert memory._of_machine(tmp_path) == np.inf


def test_what_is_left_is_said(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(memory, "available", lambda: 12.34e9)
    assert main(["--version", "-v"]) == 0
    assert "memory          12.3 GB left" in capsys.readouterr().out
    monkeypatch.setattr(memory, "available", lambda: np.inf)
    assert main(["--version", "-v"]) == 0
    assert "nothing keeps an analysis from taking all" in capsys.readouterr().out


# Text


class Windows:
    """Streams as Windows gives them to what writes to a file or a pipe."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, encoding: str) -> None:
        self.raw = [io.BytesIO(), io.BytesIO()]
        for raw, name in zip(self.raw, ("stdout", "stderr"), strict=True):
            stream = io.TextIOWrapper(raw, encoding, newline="\r\n")
            monkeypatch.setattr(sys, name, stream)

    @property
    def said(self) -> bytes:
        sys.stdout.flush()
        return self.raw[0].getvalue()


@pytest.mark.parametrize("encoding", ["ascii", "cp1252", "cp437", "utf-8"])
def test_json_is_the_same_whatever_the_console_can_show(
    encoding: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    deck = write(tmp_path / "odd.dat", DECKS["under"].replace("\n", f" % {ODD}\n"))
    for words in (["analyse", "--json"], ["advise", "--json"]):
        streams = Windows(monkeypatch, encoding)
        assert main([*words, str(deck)]) == 0
        assert b"\r" not in streams.said and streams.said.isascii()
        assert json.loads(streams.said)["verdict"] == "under-constrained"


@pytest.mark.parametrize(
    ("encoding", "expected"),
    [
        ("ascii", "5 um -> 2 m^2 +- 1 deg"),
        ("cp1252", "5 \xb5m -> 2 m\xb2 \xb1 1\xb0"),
        ("utf-8", ODD),
    ],
)
def test_what_cannot_be_shown_is_written_as_people_do(
    encoding: str, expected: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    streams = Windows(monkeypatch, encoding)
    terminal.accept_every_character()
    terminal.say(f"{ODD}\nok")
    assert streams.said == f"{expected}\nok\n".encode(encoding)


def test_every_other_character_is_spelled_out(monkeypatch: pytest.MonkeyPatch) -> None:
    streams = Windows(monkeypatch, "ascii")
    terminal.accept_every_character()
    terminal.give("\xe9 \u4e2d \U0001f600 \udce9")
    assert streams.said == b"\\xe9 \\u4e2d \\U0001f600 \\udce9\n"
    with pytest.raises(UnicodeDecodeError):
        b"\xff".decode("utf-8", "flexact.spelled")


def test_stand_ins_are_plain() -> None:
    for character, text in plain_text._STAND_INS.items():
        assert len(character) == 1 and not character.isascii() and text.isascii()


def test_all_that_we_write_ends_its_lines_alike(tmp_path: Path, decks: Path) -> None:
    """Every suffix of text that a verb writes."""
    deck, made = str(decks / "both.dat"), tmp_path / "made"
    (tmp_path / "answers").mkdir()
    for words in (
        ["analyse", deck, "-o", f"{made}/results"],
        ["report", deck, "-o", f"{made}/report.html"],
        ["batch", str(decks), "-o", f"{made}/table.csv", "-j", "1"],
        ["batch", str(decks), "-o", f"{made}/table.jsonl", "-j", "1"],
        ["convert", deck, "-o", f"{made}/deck.json"],
        ["export", deck, "-o", f"{made}/mesh.vtk"],
        ["regress", deck, "--against", f"{made}/answers", "--store"],
        ["advise", deck, "--apply", "1", "-o", f"{made}/mended.dat"],
    ):
        assert main(words) == 0, words
    files = [path for path in made.rglob("*") if path.is_file()]
    assert {".json", ".log", ".html", ".csv", ".jsonl", ".dat"} <= {path.suffix for path in files}
    for path in files:
        if path.suffix not in (".vtu", ".vtk", ".png"):
            assert b"\r" not in path.read_bytes(), path
        assert unicodedata.is_normalized("NFC", path.name)


def test_what_is_opened_by_the_system_is_opened_as_bytes() -> None:
    """Else Windows writes another line end for every byte of 10, also in what is no text."""
    package = Path(flexact.__file__).parent
    for path in package.rglob("*.py"):
        text = path.read_text(encoding="utf-8")
        writes = text.count("O_WRONLY") + text.count("O_RDWR") - text.count("devnull, os.O_WRONLY")
        if "os.open(" in text and writes > 0:
            assert "O_BINARY" in text, path


# Decks


@pytest.mark.parametrize("end", [b"\r\n", b"\r", b"\r\r\n"])
@pytest.mark.parametrize("mark", [b"", b"\xef\xbb\xbf"])
def test_a_deck_is_the_same_however_its_lines_end(end: bytes, mark: bytes) -> None:
    for text in DECKS.values():
        given = flexact.analyse(flexact.read_text(mark + text.encode().replace(b"\n", end)))
        plain = flexact.analyse(flexact.read_text(text))
        assert given.counts == plain.counts
        assert np.array_equal(given.singular_values, plain.singular_values)


@pytest.mark.parametrize("end", [b"\n", b"\r\n", b"\r"])
@pytest.mark.parametrize("mark", [b"", b"\xef\xbb\xbf"])
def test_mistakes_have_their_place_however_lines_end(end: bytes, mark: bytes) -> None:
    lines = ["TRUSS 1 1 2  % \N{MICRO SIGN}m", "  X 2 1 nought 0", "FIX 1"]
    with pytest.raises(flexact.DeckError) as error:
        flexact.read_text(mark + end.join(line.encode() for line in lines))
    first = error.value.diagnostics[0]
    assert (first.line, first.column) == (2, 9)


def test_a_line_that_ends_with_cr_among_others_is_a_line() -> None:
    """Before, what stood behind a comment was taken for a part of it, without a word."""
    mixed = b"TRUSS 1 1 2 % a bar\rFIX 1\nX 2 1 0 0\r\nFIX 2\r"
    plain = b"TRUSS 1 1 2 % a bar\nFIX 1\nX 2 1 0 0\nFIX 2\n"
    given, wanted = (flexact.analyse(flexact.read_text(text)) for text in (mixed, plain))
    assert given.counts == wanted.counts


# Signals, processes, pipes


@pytest.fixture
def on_windows(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "platform", "win32")


def test_the_end_by_a_signal_is_none_of_our_codes(
    on_windows: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The C library of Windows would end with 3, as where the verdict is not the expected one."""

    def ended(code: int) -> None:
        raise SystemExit(code)

    monkeypatch.setattr(os, "_exit", ended)
    with pytest.raises(SystemExit) as end:
        interruption.end_by(signal.SIGINT)
    assert isinstance(end.value.code, int) and -(2**31) <= end.value.code < 2**31
    assert end.value.code % 2**32 == 0xC000013A


def test_a_pipe_that_nobody_reads_ends_quietly(
    on_windows: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Broken(io.StringIO):
        def write(self, _: str) -> int:
            raise OSError(errno.EINVAL, "Invalid argument")

    monkeypatch.setattr(sys, "stdout", Broken())
    assert run(["--version"]) == 128 + 13


def test_a_console_that_shows_escape_sequences_gets_none(
    on_windows: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Console(io.StringIO):
        def isatty(self) -> bool:
            return True

    for name in ("NO_COLOR", "TERM", "FORCE_COLOR", "CLICOLOR_FORCE"):
        monkeypatch.delenv(name, raising=False)
    asked: list[int] = []
    monkeypatch.setattr(windows, "obeys_escapes", lambda number: asked.append(number) or obeys)
    for name, number in (("stdout", 1), ("stderr", 2)):
        monkeypatch.setattr(sys, name, Console())
        for obeys in (False, True):
            terminal.speak()
            assert terminal.is_coloured(getattr(sys, name)) == obeys
            terminal.speak("always")
            assert terminal.is_coloured(getattr(sys, name))
            terminal.speak("never")
            assert not terminal.is_coloured(getattr(sys, name))
        assert set(asked) == {number}
        asked.clear()
    terminal.speak()


def test_workers_that_are_started_anew(monkeypatch: pytest.MonkeyPatch, decks: Path) -> None:
    """As on macOS and Windows, where no process is forked."""
    monkeypatch.setattr(local_pool, "FORKS", False)
    table = decks.parent / "table.csv"
    assert main(["batch", str(decks), "-o", str(table), "-j", "2"]) == 0
    rows = table.read_text(encoding="utf-8").splitlines()
    assert len(rows) == 1 + len(DECKS)


def test_windows_waits_for_sixty_workers_at_most(on_windows: None) -> None:
    assert local_pool.LocalPool(len, 500)._most == 60
    assert local_pool.LocalPool(len, 7)._most == 7


def test_a_journal_is_locked_on_windows(
    on_windows: None, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    locked: list[tuple[int, int]] = []

    def locking(handle: int, mode: int, size: int) -> None:
        place = os.lseek(handle, 0, os.SEEK_CUR)
        if (place, size) in locked:
            raise PermissionError(errno.EACCES, "Permission denied")
        assert mode == 2
        locked.append((place, size))

    library = types.SimpleNamespace(locking=locking, LK_NBLCK=2)
    monkeypatch.setitem(sys.modules, "msvcrt", library)
    made = journal.Journal.begin(tmp_path / "a.journal", {"run": 1})
    made.add({"row": 1})
    with pytest.raises(journal.JournalError, match="still going on"):
        journal.Journal.resume(tmp_path / "a.journal")
    assert [record for _, record in made.entries()] == [{"run": 1}, {"row": 1}]
    assert locked[0][0] > (tmp_path / "a.journal").stat().st_size
    unlink = Path.unlink

    def unlinked(path: Path, missing_ok: bool = False) -> None:
        assert made._handle == journal._CLOSED, "Windows removes no file that is open"
        unlink(path, missing_ok)

    monkeypatch.setattr(Path, "unlink", unlinked)
    made.remove()
    assert not list(tmp_path.iterdir())


def test_a_worker_of_watch_is_apart_from_the_terminal(
    on_windows: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert crew._apart() == {"creationflags": 0x200}
    assert "0xc0000005" in crew._how(0xC0000005)
    monkeypatch.setattr(sys, "platform", "linux")
    assert crew._apart() == {"start_new_session": True}


def test_a_worker_of_watch_takes_its_children_along_on_windows(
    on_windows: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    calls: list[list[str]] = []
    monkeypatch.delattr(os, "killpg", raising=False)
    monkeypatch.setattr(subprocess, "run", lambda words, **_: calls.append(words))
    worker = crew.Worker.__new__(crew.Worker)
    ends: list[str] = []
    worker._process = types.SimpleNamespace(  # type: ignore[assignment]
        pid=42, kill=lambda: ends.append("kill"), wait=lambda: ends.append("wait")
    )
    worker.stop()
    assert calls == [["taskkill", "/F", "/T", "/PID", "42"]] and ends == ["kill", "wait"]
