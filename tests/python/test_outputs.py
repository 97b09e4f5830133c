# SPDX-License-Identifier: BSD-3-Clause
"""Files of results: planned before anything is computed, written together or not at all."""

import io
import os
import re
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from small_decks import files_in, write

from flexact.apps.cli.terminal import ExitCode, Outcome, exit_code
from flexact.util.decks import DeckFile, FolderError, find_decks
from flexact.util.errors import BatchError
from flexact.util.outputs import (
    OutputError,
    plan_files,
    remove_left,
    temporary_name,
    write_together,
    written_whole,
)


def test_a_folder_stands_for_its_decks_in_order(tmp_path: Path) -> None:
    for name in ("b.dat", "a/z.DAT", "a/notes.txt", "c/d/e.dat"):
        write(tmp_path / name, "")
    decks = find_decks([str(tmp_path)])
    assert [deck.relative for deck in decks] == [Path("a/z"), Path("b"), Path("c/d/e")]
    assert [Path(deck.path) for deck in decks] == [
        tmp_path / name for name in ("a/z.DAT", "b.dat", "c/d/e.dat")
    ]


def test_a_file_is_taken_whatever_its_suffix(tmp_path: Path) -> None:
    (deck,) = find_decks([str(tmp_path / "missing.v2.txt")])
    assert deck == DeckFile(str(tmp_path / "missing.v2.txt"), Path("missing.v2"))


def test_a_folder_without_decks_is_kept_to_be_reported(tmp_path: Path) -> None:
    (deck,) = find_decks([str(tmp_path)])
    assert isinstance(deck.error, FolderError)


@pytest.mark.posix
def test_a_deck_is_found_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    deck = write(tmp_path / "in" / "x.dat", "")
    (tmp_path / "in" / "y.dat").symlink_to(deck)
    monkeypatch.chdir(tmp_path)
    decks = find_decks(["in/x.dat", "in", str(deck), "./in/../in/x.dat"])
    assert [deck.path for deck in decks] == ["in/x.dat", "in/y.dat"]


def test_names_of_results_can_be_encoded() -> None:
    assert DeckFile("m\u00e9/\udcff.dat", Path("x")).name == "m\u00e9/\\udcff.dat"


@pytest.mark.parametrize(
    ("codes", "expected"),
    [((0, 0), 0), ((0, 3), 3), ((3, 1, 0), 1), ((2, 3, 1), 2), ((), 0)],
)
def test_the_gravest_deck_decides_the_exit_code(codes: tuple[int, ...], expected: int) -> None:
    assert exit_code(Outcome("deck", ExitCode(code), "") for code in codes) == expected


def test_files_are_planned_by_deck(tmp_path: Path) -> None:
    plan = plan_files([DeckFile("in/a/x.dat", Path("a/x.1"))], tmp_path, (".json", ".log"))
    assert plan == {"in/a/x.dat": (tmp_path / "a/x.1.json", tmp_path / "a/x.1.log")}


def test_two_decks_for_one_file_are_refused(tmp_path: Path) -> None:
    decks = [DeckFile("one/x.dat", Path("x")), DeckFile("two/x.dat", Path("x"))]
    with pytest.raises(OutputError, match=r"one/x\.dat .* two/x\.dat .*x\.json"):
        plan_files(decks, tmp_path / "new", (".json",))
    assert not (tmp_path / "new").exists()


def test_a_deck_is_not_overwritten(tmp_path: Path) -> None:
    deck = write(tmp_path / "x.json", "")
    with pytest.raises(OutputError, match=r"x\.json"):
        plan_files([DeckFile(str(deck), Path("x"))], tmp_path, (".json",))


@pytest.mark.posix
def test_links_to_one_file_are_refused(tmp_path: Path) -> None:
    (tmp_path / "x.log").symlink_to(tmp_path / "x.json")
    with pytest.raises(OutputError, match=r"x\.log"):
        plan_files([DeckFile("in/x.dat", Path("x"))], tmp_path, (".json", ".log"))


def test_folders_that_give_no_deck_have_no_files(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    (tmp_path / "in").mkdir()
    write(tmp_path / "in" / "a.dat", "")
    decks = find_decks([str(tmp_path / "a"), str(tmp_path / "in")])
    assert [deck.relative for deck in decks] == [Path("a"), Path("a")]
    assert list(plan_files(decks, tmp_path / "out", (".json",))) == [str(tmp_path / "in" / "a.dat")]


def test_a_file_in_place_of_the_folder_is_refused(tmp_path: Path) -> None:
    file = write(tmp_path / "file", "")
    with pytest.raises(OutputError, match=re.escape(str(file))):
        plan_files([], file / "below", (".json",))


@pytest.mark.posix
def test_a_folder_without_permission_is_refused(tmp_path: Path) -> None:
    if os.geteuid() == 0:
        pytest.skip("the superuser may write everywhere")
    tmp_path.chmod(0o500)
    try:
        with pytest.raises(OutputError, match=re.escape(str(tmp_path))):
            plan_files([], tmp_path / "new", (".json",))
    finally:
        tmp_path.chmod(0o700)


def test_files_are_written_with_their_folders(tmp_path: Path) -> None:
    write_together({tmp_path / "a/x.json": b"1", tmp_path / "a/x.log": b"2"})
    assert files_in(tmp_path) == ["a/x.json", "a/x.log"]
    assert (tmp_path / "a/x.log").read_bytes() == b"2"


def test_files_are_replaced(tmp_path: Path) -> None:
    for content in (b"old", b"new"):
        write_together({tmp_path / "x.json": content})
    assert (tmp_path / "x.json").read_bytes() == b"new"


@pytest.mark.posix
def test_a_link_stays_one(tmp_path: Path) -> None:
    there = write(tmp_path / "there" / "x.json", "old")
    for name, target in (("a.json", there), ("b.json", tmp_path / "new" / "y.json")):
        (tmp_path / name).symlink_to(target)
        write_together({tmp_path / name: b"new"})
        assert (tmp_path / name).readlink() == target
        assert target.read_bytes() == b"new"
    assert files_in(tmp_path) == ["a.json", "b.json", "new/y.json", "there/x.json"]


@pytest.mark.posix
def test_what_may_not_be_replaced_is_left(tmp_path: Path) -> None:
    write(tmp_path / "file", "old").chmod(0o444)
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "link").symlink_to(tmp_path / "pipe")
    (tmp_path / "loop").symlink_to(tmp_path / "loop")
    for name in ("file", "pipe", "link", "loop"):
        with pytest.raises(OutputError, match=re.escape(str(tmp_path / name))):
            write_together({tmp_path / "x": b"new", tmp_path / name: b"new"})
    assert (tmp_path / "file").read_bytes() == b"old"
    assert (tmp_path / "pipe").is_fifo() and (tmp_path / "link").is_symlink()
    assert files_in(tmp_path) == ["file"]


def test_an_interruption_leaves_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    class Interrupted(io.BytesIO):
        def write(self, content: Any) -> int:
            super().write(content[:3])
            raise KeyboardInterrupt

    def begun(path: Path, _: Path) -> io.BytesIO:
        path.write_bytes(b"fir")
        return Interrupted()

    monkeypatch.setattr("flexact.util.outputs.new_file", begun)
    with pytest.raises(KeyboardInterrupt):
        write_together({tmp_path / "x.json": b"first"})
    assert list(tmp_path.iterdir()) == []


@pytest.mark.posix
def test_what_a_killed_process_left_is_removed(tmp_path: Path) -> None:
    code = """
import os, signal, sys
from pathlib import Path
from flexact.util.outputs import write_together
os.replace = lambda *places: os.kill(os.getpid(), signal.SIGKILL)
write_together({Path(sys.argv[1]) / "x.json": b"1", Path(sys.argv[1]) / "x.log": b"2"})
"""
    killed = subprocess.run([sys.executable, "-c", code, str(tmp_path)])
    assert killed.returncode == -signal.SIGKILL
    assert len(list(tmp_path.iterdir())) == 2
    write_together({tmp_path / "y.json": b"1"})
    assert [path.name for path in tmp_path.iterdir()] == ["y.json"]


@pytest.mark.posix
def test_temporary_files_of_others_stay(tmp_path: Path) -> None:
    """Those of processes that live, of other systems, links, folders, and what only looks so."""
    ours = temporary_name()
    system, process = ours.split("-")[1:3]
    (dead := subprocess.Popen([sys.executable, "-c", ""])).wait()
    stay = {
        f".flexact-{system}-{process}-987654321.tmp",
        f".flexact-{system}-{os.getppid()}-0.tmp",
        f".flexact-{system}-1-0.tmp",
        f".flexact-{system}-{10**30}-0.tmp",
        f".flexact-{'0' * 12}-{dead.pid}-0.tmp",
        f".flexact-{dead.pid}-0.tmp",
        f".flexact-{system}-{dead.pid}-0.tmp.json",
        f"flexact-{system}-{dead.pid}-0.tmp",
        f".flexact-{system}--{dead.pid}-0.tmp",
        f".flexact-{system}-0-0.tmp",
    }
    for name in stay:
        write(tmp_path / name, "")
    (tmp_path / f".flexact-{system}-{dead.pid}-1.tmp").symlink_to(tmp_path / "x")
    (tmp_path / f".flexact-{system}-{dead.pid}-2.tmp").mkdir()
    before = set(tmp_path.iterdir())
    write(tmp_path / f".flexact-{system}-{dead.pid}-3.tmp", "")
    remove_left(tmp_path)
    assert set(tmp_path.iterdir()) == before


@pytest.mark.posix
def test_an_interruption_waits_until_all_files_are_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    replace = os.replace

    def interrupt(source: Path, target: Path) -> None:
        signal.raise_signal(signal.SIGINT)
        replace(source, target)

    monkeypatch.setattr(os, "replace", interrupt)
    with pytest.raises(KeyboardInterrupt):
        write_together({tmp_path / "x.json": b"1", tmp_path / "x.log": b"2"})
    assert files_in(tmp_path) == ["x.json", "x.log"]


def test_a_folder_in_the_way_leaves_all_as_it_was(tmp_path: Path) -> None:
    (tmp_path / "x.log").mkdir()
    (tmp_path / "x.json").write_bytes(b"old")
    with pytest.raises(OutputError, match=r"x\.log"):
        write_together({tmp_path / "x.json": b"new", tmp_path / "x.log": b"new"})
    assert files_in(tmp_path) == ["x.json"]
    assert (tmp_path / "x.json").read_bytes() == b"old"


def test_a_write_that_fails_half_way_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Full(io.FileIO):
        def write(self, content: Any) -> int:
            if content == b"second":
                super().write(content[:3])
                raise OSError(28, "No space left on device")
            return super().write(content)

    monkeypatch.setattr("flexact.util.outputs.new_file", lambda path, _: Full(path, "x"))
    with pytest.raises(OutputError, match=r"x\.log"):
        write_together({tmp_path / "x.json": b"first", tmp_path / "x.log": b"second"})
    assert files_in(tmp_path) == []


def test_a_name_too_long_for_the_file_system_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(OutputError):
        write_together({tmp_path / ("x" * 300): b"content"})
    assert files_in(tmp_path) == []


def test_output_errors_are_errors_of_the_batch() -> None:
    assert issubclass(OutputError, BatchError)


@pytest.mark.posix
@pytest.mark.parametrize("whole", [False, True])
@pytest.mark.parametrize("kind", ["link", "file", "dangling"])
def test_what_is_laid_where_a_temporary_file_goes_is_not_touched(
    whole: bool, kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    target = write(tmp_path / "target", "theirs")
    laid = tmp_path / "laid"
    if kind == "file":
        write(laid, "theirs")
    else:
        laid.symlink_to(target if kind == "link" else tmp_path / "none")
    monkeypatch.setattr("flexact.util.outputs.temporary_name", lambda: "laid")
    with pytest.raises(OutputError, match="cannot write"):
        if whole:
            with written_whole(tmp_path / "x.json") as file:
                file.write(b"ours")
        else:
            write_together({tmp_path / "x.json": b"ours"})
    assert target.read_text() == "theirs"
    assert not (tmp_path / "x.json").exists() and not (tmp_path / "none").exists()


def test_names_of_temporary_files_cannot_be_known() -> None:
    made = {re.split("[-.]", temporary_name())[-2] for _ in range(100)}
    assert len(made) == 100 and {len(each) for each in made} == {16}


@pytest.mark.posix
@pytest.mark.parametrize("mode", [0o600, 0o640, 0o666, 0o444 | 0o200])
def test_a_file_that_is_written_over_keeps_its_mode(mode: int, tmp_path: Path) -> None:
    old, link = write(tmp_path / "x.json", ""), tmp_path / "link.json"
    old.chmod(mode)
    link.symlink_to(old)
    for target in (old, link):
        write_together({target: b"new"})
        assert old.stat().st_mode & 0o777 == mode
        with written_whole(target) as file:
            file.write(b"newer")
        assert old.read_bytes() == b"newer" and old.stat().st_mode & 0o777 == mode
    umask = os.umask(0)
    os.umask(umask)
    write_together({tmp_path / "y.json": b""})
    assert (tmp_path / "y.json").stat().st_mode & 0o777 == 0o666 & ~umask
