# SPDX-License-Identifier: BSD-3-Clause
"""Progress: stages while the core works, and a bar for those who watch a terminal."""

import os
import subprocess
import sys
import threading
from pathlib import Path

import pytest
from known_models import ring
from test_cli_process import process_environment

import flexact
from flexact.apps.cli import terminal as bar
from flexact.apps.cli.main import main
from flexact.core.arrays import IntArray
from flexact.core.calls import STAGES
from flexact.core.progress import reported


def test_stages_are_told_while_the_work_goes_on() -> None:
    seen: list[tuple[str, float]] = []
    noticed = threading.Event()

    def work(stage: IntArray) -> int:
        for number in range(len(STAGES)):
            noticed.clear()
            stage[:2] = number, 50
            assert noticed.wait(20.0)
        return 7

    def progress(stage: str, done: float) -> None:
        seen.append((stage, done))
        noticed.set()

    assert reported(work, progress) == 7
    assert [stage for stage in STAGES if (stage, 0.5) in seen] == list(STAGES)


@pytest.mark.parametrize(
    ("given", "wanted"), [((-3, -5), (STAGES[0], 0.0)), ((99, 300), (STAGES[-1], 1.0))]
)
def test_numbers_beyond_the_stages_do_no_harm(
    given: tuple[int, int], wanted: tuple[str, float]
) -> None:
    noticed = threading.Event()

    def work(stage: IntArray) -> bool:
        stage[:2] = given
        return noticed.wait(20.0)

    def progress(*what: object) -> None:
        if what == wanted:
            noticed.set()

    assert reported(work, progress)


def test_an_error_of_the_work_comes_through() -> None:
    def work(_: IntArray) -> None:
        raise MemoryError("no")

    with pytest.raises(MemoryError) as error:
        reported(work, lambda *_: None)
    assert error.value.args == ("no",)


def test_ending_the_watch_leaves_the_work_to_itself() -> None:
    go_on = threading.Event()

    def stop(*_: object) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        reported(lambda _: go_on.wait(20.0), stop)
    go_on.set()


def test_an_analysis_tells_its_stages_and_gives_the_same() -> None:
    seen: list[str] = []
    analysis = flexact.analyse(ring(6), progress=lambda stage, _: seen.append(stage))
    assert seen and set(seen) <= set(STAGES)
    assert analysis.to_json() == flexact.analyse(ring(6)).to_json()


WATCHED = """\
import sys
from flexact.apps.cli import terminal as bar
bar.LARGE_FILE = bar.LARGE_MODEL = {large}
from flexact.apps.cli.main import main
sys.exit(main())
"""


def seen_on_a_terminal(large: int, *arguments: str) -> str:
    try:
        reader, terminal = os.openpty()
    except OSError:
        pytest.skip("this system hands out no pseudo-terminals")
    try:
        subprocess.run(
            [sys.executable, "-c", WATCHED.format(large=large), *arguments],
            stdout=subprocess.DEVNULL,
            stderr=terminal,
            env=process_environment(),
            check=True,
        )
        os.write(terminal, b"end")
        seen = b""
        while not seen.endswith(b"end"):
            seen += os.read(reader, 65536)
        return seen.decode()
    finally:
        os.close(terminal)
        os.close(reader)


@pytest.mark.posix
def test_a_bar_tells_the_stage_of_a_large_deck(decks: Path, tmp_path: Path) -> None:
    pytest.importorskip("tqdm")
    deck = str(decks / "over.dat")
    seen = seen_on_a_terminal(0, "analyse", deck, "-o", str(tmp_path / "out"))
    for stage in ("reading", "writing"):
        assert f"over.dat: {stage}" in seen
    assert any(f"over.dat: {stage}" in seen for stage in STAGES)
    assert seen.replace("\x1b[K", "").split("\r")[-1] == "end", "the bar is wiped"
    assert seen_on_a_terminal(10**9, "analyse", deck).strip("\r\x1b[K") == "end"


def test_nothing_is_drawn_where_nobody_watches(
    decks: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(bar, "LARGE_FILE", 0)
    monkeypatch.setattr(bar, "LARGE_MODEL", 0)
    assert main(["analyse", str(decks / "over.dat")]) == 0
    assert capsys.readouterr().err == ""
