# SPDX-License-Identifier: BSD-3-Clause
"""``flexact batch --resume``: killed at any moment, nothing is lost and nothing is done twice."""

import json
import random
import signal
import socket
import subprocess
import sys
import time
import zlib
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from dask_cluster import running_cluster
from small_decks import BROKEN, DECKS, files_in, write
from test_batch import rows_of
from test_cli_process import process_environment
from test_cli_signals import bars_in_a_row

from flexact.apps.cli.main import main
from flexact.sweeps.journal import Journal
from flexact.util.outputs import OutputError

pytestmark = pytest.mark.dear(14)

KINDS = (*DECKS.values(), BROKEN)


@pytest.fixture
def many(tmp_path: Path) -> Path:
    """A folder of three hundred decks."""
    for k in range(300):
        write(tmp_path / "many" / f"{k:03d}.dat", f"% deck {k}\n" + KINDS[k % len(KINDS)])
    return tmp_path / "many"


#: The command, with so long a wait before each line of its journal, and no end beyond some lines.
HELD = """\
import sys, time
from flexact.sweeps.journal import Journal

pause, lines, add = float(sys.argv.pop(1)), int(sys.argv.pop(1)), Journal.add

def held(journal, record):
    global lines
    time.sleep(pause if lines > 0 else 60.0)
    lines -= 1
    return add(journal, record)

Journal.add = held
from flexact.apps.cli.main import main
sys.exit(main())
"""


def batch(
    *arguments: object, limit: int | None = None, pause: float = 0.0, lines: int = 10_000
) -> subprocess.Popen[bytes]:
    """The command in a process of its own, which may be held up, and its files kept small."""

    def before() -> None:
        import resource

        if limit is not None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

    program = ["-c", HELD, str(pause), str(lines)]
    return subprocess.Popen(
        [sys.executable, *program, "batch", *map(str, arguments)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=process_environment(),
        preexec_fn=before if limit is not None else None,
    )


def journaled(path: Path) -> dict[int, float]:
    """The seconds of each deck that a journal has, read by nobody's help."""
    found: dict[int, float] = {}
    for line in path.read_bytes().split(b"\n")[1:] if path.exists() else []:
        if line[9:] and line[:9] == b"%08x " % zlib.crc32(line[9:]):
            record = json.loads(line[9:])
            assert record["deck"] not in found
            found[record["deck"]] = record["row"][-1]
    return found


def lines_in(path: Path) -> int:
    return path.read_bytes().count(b"\n") if path.exists() else 0


def but_for_times(path: Path) -> list[str]:
    return [line.rpartition(",")[0] for line in path.read_text("utf-8").splitlines()]


def wait_until(process: subprocess.Popen[bytes], has_come: Callable[[], bool]) -> None:
    """Wait as long as a process lives."""
    until = time.monotonic() + 60.0
    while process.poll() is None and not has_come() and time.monotonic() < until:
        time.sleep(0.001)


def kill_after(process: subprocess.Popen[bytes], number: int, has_come: Callable[[], bool]) -> int:
    """Exit code of a process that gets a signal as soon as something has come."""
    wait_until(process, has_come)
    process.send_signal(number)
    process.communicate(timeout=60.0)
    return process.returncode


@pytest.mark.posix
@pytest.mark.parametrize("workers", ["-j1", "-j2"])
def test_killed_and_resumed_it_is_the_same_table(workers: str, many: Path, tmp_path: Path) -> None:
    """Byte for byte but for times; what was in the journal is never done again."""
    whole, table = tmp_path / "whole.csv", tmp_path / "table.csv"
    journal = tmp_path / "table.csv.journal"
    assert main(["batch", str(many), "-o", str(whole), workers]) == 0
    chance = random.Random(12)
    done: dict[int, float] = {}
    for number in (signal.SIGKILL, signal.SIGINT, signal.SIGKILL, signal.SIGTERM):
        # The head is a line, too. However late the signal comes, there is something left to do.
        goal = len(done) + chance.randrange(5, 50)
        process = batch(many, "-o", table, "--resume", workers, lines=goal - len(done) + 20)
        code = kill_after(process, number, lambda goal=goal: lines_in(journal) > goal)
        assert code == -number
        found = journaled(journal)
        assert done.items() <= found.items() and len(found) > len(done)
        assert not table.exists()
        done = found
    assert 0 < len(done) < 300
    resumed = batch(many, "-o", table, "--resume", workers)
    assert (*resumed.communicate(), resumed.returncode)[1:] == (b"", 0)
    assert but_for_times(table) == but_for_times(whole)
    times = [float(row["seconds"]) for row in rows_of(table)]
    assert all(times[deck] == seconds for deck, seconds in done.items())
    assert [name for name in files_in(tmp_path) if not name.startswith("many")] == [
        *("table.csv", "whole.csv"),
    ]


@pytest.mark.posix
def test_a_signal_that_falls_into_a_destructor_ends_it_all_the_same(
    many: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Python lets such an exception go; the next deck is not begun."""

    class Deaf:
        def __del__(self) -> None:
            signal.raise_signal(signal.SIGTERM)

    add = Journal.add

    def deafly(journal: Journal, record: Any) -> Any:
        Deaf()
        return add(journal, record)

    monkeypatch.setattr(Journal, "add", deafly)
    monkeypatch.setattr(sys, "unraisablehook", lambda _: None)
    table = tmp_path / "table.csv"
    assert main(["batch", str(many), "-o", str(table), "-j1"]) == 128 + signal.SIGTERM
    assert len(journaled(tmp_path / "table.csv.journal")) == 1 and not table.exists()


@pytest.mark.posix
def test_where_the_disk_is_full_it_goes_on_later(many: Path, tmp_path: Path) -> None:
    """Files may not grow beyond a size here, which the system reports as a full disk."""
    table, journal = tmp_path / "table.csv", tmp_path / "table.csv.journal"
    full = batch(many, "-o", table, "-j2", limit=30_000)
    _, said = full.communicate(timeout=60.0)
    assert full.returncode == 2 and b"go on with --resume" in said
    assert b"Traceback" not in said
    assert files_in(tmp_path)[-1] == "table.csv.journal" and not table.exists()
    done = journaled(journal)
    assert 0 < len(done) < 300
    assert main(["batch", str(many), "-o", str(table), "--resume"]) == 0
    times = [float(row["seconds"]) for row in rows_of(table)]
    assert len(times) == 300
    assert all(times[deck] == seconds for deck, seconds in done.items())


@pytest.fixture
def interrupted(decks: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The arguments of a batch of five decks that are done, and have no table yet."""
    write(decks / "broken.dat", BROKEN)

    def refuse(*_: object) -> None:
        raise OutputError("no space")

    arguments = ["batch", str(decks), "-o", str(tmp_path / "t.csv"), "-j1"]
    with monkeypatch.context() as patch:
        patch.setattr("flexact.apps.cli.batch.write_table", refuse)
        assert main(arguments) == 2
    assert len(journaled(tmp_path / "t.csv.journal")) == 5
    return arguments


def analysed(monkeypatch: pytest.MonkeyPatch, arguments: Sequence[str]) -> list[str]:
    """The decks that a run analyses."""
    from flexact.apps.cli import batch as batch_work

    names: list[str] = []
    row = batch_work.deck_row

    def noted(raw: bytes, name: str, *asked: object) -> object:
        names.append(Path(name).name)
        return row(raw, name, *asked)  # type: ignore[arg-type]

    with monkeypatch.context() as patch:
        patch.setattr(batch_work, "deck_row", noted)
        assert main(arguments) == 0
    return names


def test_what_is_done_is_not_done_again(
    interrupted: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    done = journaled(tmp_path / "t.csv.journal")
    assert analysed(monkeypatch, [*interrupted, "--resume"]) == []
    assert [float(row["seconds"]) for row in rows_of(tmp_path / "t.csv")] == list(done.values())
    assert not (tmp_path / "t.csv.journal").exists()


@pytest.mark.posix
def test_a_deck_that_has_changed_is_done_again(
    interrupted: list[str], decks: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write(decks / "broken.dat", DECKS["exact"])
    (decks / "over.dat").touch()
    (decks / "under.dat").unlink()
    (decks / "under.dat").symlink_to("nowhere")
    assert analysed(monkeypatch, [*interrupted, "--resume"]) == ["broken.dat"]
    rows = rows_of(tmp_path / "t.csv")
    assert rows[1]["verdict"] == "exactly constrained"
    assert rows[4]["error"].endswith("there is no such file")


def test_files_that_are_not_there_any_more_are_made_again(
    decks: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "files"
    arguments = ["batch", str(decks), "-o", str(tmp_path / "t.csv"), "-j1", "--files", str(folder)]

    def refuse(*_: object) -> None:
        raise OutputError("no space")

    with monkeypatch.context() as patch:
        patch.setattr("flexact.apps.cli.batch.write_table", refuse)
        assert main(arguments) == 2
    (folder / "over.log").unlink()
    (folder / "both.vtu").write_bytes(b"half")
    assert analysed(monkeypatch, [*arguments, "--resume"]) == ["both.dat", "over.dat"]
    assert len(files_in(folder)) == 12


def test_a_journal_is_not_passed_over(
    interrupted: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = (tmp_path / "t.csv.journal").read_bytes()
    assert main(interrupted) == 2
    said = capsys.readouterr().err
    assert "--resume" in said and "delete" in said
    assert (tmp_path / "t.csv.journal").read_bytes() == before


@pytest.mark.parametrize(
    ("more", "said"),
    [
        (["--columns", "verdict"], "--columns was values, now verdict"),
        (["--where", "rank > 0"], "--where was not given, now rank > 0"),
        (["--tolerance", "1e-9"], "--tolerance was not given, now 1e-09"),
        (["--method", "jacobi"], "--method was auto, now jacobi"),
        (["--no-prove"], "--prove was not given, now False"),
        (["--accuracy", "1e-5"], "--accuracy was not given"),
        (["--files", "results"], "--files was not given"),
        (["extra.dat"], "5 decks then, 6 now, extra.dat is new"),
    ],
)
def test_another_run_is_not_gone_on_with(
    more: list[str], said: str, interrupted: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    options = more if more[0].startswith("-") else []
    extra = [] if options else more
    assert main([*interrupted[:2], *extra, *interrupted[2:], *options, "--resume"]) == 2
    assert said in capsys.readouterr().err
    assert main([*interrupted[:-1], "-j2", "--resume"]) == 0


def test_with_nothing_there_it_starts(decks: Path, tmp_path: Path) -> None:
    for _ in range(2):
        assert main(["batch", str(decks), "-o", str(tmp_path / "t.csv"), "--resume"]) == 0
        assert len(rows_of(tmp_path / "t.csv")) == 4


@pytest.mark.posix
def test_where_nothing_is_done_nothing_is_left(
    decks: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupt(*_: object) -> None:
        signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr("flexact.apps.cli.batch.deck_row", interrupt)
    assert main(["batch", str(decks), "-o", str(tmp_path / "t.csv"), "-j1"]) == 130
    assert [name for name in files_in(tmp_path) if not name.startswith("decks")] == []


@pytest.mark.posix
def test_a_cluster_that_is_lost_leaves_what_is_done(tmp_path: Path) -> None:
    """A worker dies, then the scheduler; processes of this machine go on. The table is the same."""
    pytest.importorskip("distributed")
    folder = tmp_path / "decks"
    for k in range(80):
        write(folder / f"{k:03d}.dat", f"% deck {k}\n{bars_in_a_row(16 + k % 5)}")
    whole, table = tmp_path / "whole.csv", tmp_path / "table.csv"
    journal = tmp_path / "table.csv.journal"
    slow = ("--method", "jacobi")
    assert main(["batch", str(folder), "-o", str(whole), "-j2", *slow]) == 0
    with running_cluster(tmp_path / "cluster", workers=2) as cluster:
        run = batch(folder, "-o", table, "--dask", cluster.address, *slow, pause=0.02)
        wait_until(run, lambda: lines_in(journal) > 5)
        cluster.kill_worker()
        wait_until(run, lambda: lines_in(journal) > 20)
        cluster.kill_scheduler()
        _, said = run.communicate(timeout=60.0)
    assert run.returncode == 2 and b"Traceback" not in said
    assert b"scheduler" in said and b"go on with --resume" in said
    done = journaled(journal)
    assert 20 <= len(done) < 80, said
    assert main(["batch", str(folder), "-o", str(table), "-j2", "--resume", *slow]) == 0
    assert but_for_times(table) == but_for_times(whole)
    times = [float(row["seconds"]) for row in rows_of(table)]
    assert all(times[deck] == seconds for deck, seconds in done.items())


def test_a_scheduler_that_is_not_there_leaves_nothing(
    decks: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("distributed")
    with socket.socket() as taken:
        # A port that nobody listens at.
        taken.bind(("127.0.0.1", 0))
        address = f"tcp://127.0.0.1:{taken.getsockname()[1]}"
        arguments = ["batch", str(decks), "-o", str(tmp_path / "t.csv"), "--dask", address]
        with dask_patience("1s"):
            assert main(arguments) == 2
    said = capsys.readouterr().err
    assert address in said and "Traceback" not in said
    assert [name for name in files_in(tmp_path) if not name.startswith("decks")] == []


@contextmanager
def dask_patience(seconds: str) -> Iterator[None]:
    import dask

    with dask.config.set({"distributed.comm.timeouts.connect": seconds}):
        yield


@pytest.mark.posix
@pytest.mark.parametrize("workers", ["-j1", "-j2"])
def test_control_c_does_not_wait_for_a_large_deck(workers: str, tmp_path: Path) -> None:
    """One of 3600 x 3600 takes longer than anybody waits; the one before it is kept."""
    small = write(tmp_path / "small.dat", bars_in_a_row(10))
    large = write(tmp_path / "large.dat", bars_in_a_row(900))
    journal = tmp_path / "t.csv.journal"
    run = batch(small, large, "-o", tmp_path / "t.csv", "--method", "svd", workers)
    wait_until(run, lambda: lines_in(journal) > 1)
    run.send_signal(signal.SIGINT)
    _, said = run.communicate(timeout=20.0)
    assert run.returncode == -signal.SIGINT
    assert said.startswith(b"stopped; 1 of 2 decks are done") and said.count(b"\n") == 1


#: What somebody may have written into a journal, in place of the record of the first deck.
CRAFTED: dict[str, Any] = {
    "not an object": [1, 2],
    "nothing": {},
    "deck": [{"deck": k} for k in (10**9, -1, "0", 0.0, None, True, [0])],
    "of": [{"of": k} for k in (None, 7, ["x"])],
    "row": [
        {"row": k}
        for k in (None, "x", [], [1], {"a": 1}, ["x"] * 13, [{}] * 13, [[]] * 13, [True] * 13)
    ],
    "wanted": [{"wanted": k} for k in (None, 1, "yes", [])],
    "sizes": [{"files": k} for k in ("x", 7, {}, [-1], [1], ["x"], [None] * 9)],
    "page": [{"page": k} for k in ("x", 7, [1], ["x"])],
    "entry": [
        {"entry": k}
        for k in (7, [], "x", {}, {"kind": 1}, {"picture": "%"}, {"counts": [1]}, {"name": 7})
    ],
    "entry part": [
        {"entry": {"own": {part: wrong}}}
        for part in (
            "name",
            "kind",
            "picture",
            "counts",
            "margin_length",
            "marked",
            "line",
            "error",
        )
        for wrong in (7, [7], {"a": 1}, "%")
    ],
}


@pytest.mark.nightly
def test_crafted_records_count_as_if_they_were_not_there(
    decks: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """With right check sums: the run does the deck again, and says nothing of itself."""
    table, journal = tmp_path / "table.csv", tmp_path / "table.csv.journal"
    words = ["batch", str(decks), "-o", str(table), "-j1", "--report", str(tmp_path / "pages")]
    kept = keep_journal(words, journal, tmp_path)
    whole = but_for_times(table)
    head, *lines = kept.splitlines(keepends=True)
    first = json.loads(lines[0][9:])
    crafted = [
        one for each in CRAFTED.values() for one in (each if isinstance(each, list) else [each])
    ]
    for change in crafted:
        record = change if not isinstance(change, dict) or not change else {**first, **change}
        part = change.get("entry") if isinstance(change, dict) else None
        if isinstance(part, dict) and "own" in part:
            record = {**first, "entry": {**first["entry"], **part["own"]}}
        text = json.dumps(record).encode()
        journal.write_bytes(head + b"%08x %s\n" % (zlib.crc32(text), text) + b"".join(lines[1:]))
        table.unlink()
        assert main([*words, "--resume"]) == 0, change
        assert but_for_times(table) == whole, change
        assert "Traceback" not in capsys.readouterr().err


def keep_journal(words: list[str], journal: Path, folder: Path) -> bytes:
    """The journal of a whole run, as it is when all is done and nothing is written yet."""
    kept = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Journal, "remove", lambda own: kept.append(own.path.read_bytes()))
        assert main(words) == 0
    journal.unlink()
    return bytes(kept[0])


@pytest.mark.parametrize(
    "change",
    [{"options": 7}, {"options": None}, {"decks": 7}, {"decks": [[]]}, {"decks": {"a": 1}}],
)
def test_a_crafted_head_is_refused_in_words(
    change: dict[str, Any], decks: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    table, journal = tmp_path / "table.csv", tmp_path / "table.csv.journal"
    words = ["batch", str(decks), "-o", str(table), "-j1"]
    head = json.loads(keep_journal(words, journal, tmp_path).splitlines()[0][9:])
    text = json.dumps({**head, **change}).encode()
    journal.write_bytes(b"%08x %s\n" % (zlib.crc32(text), text))
    assert main([*words, "--resume"]) == 2
    assert "is of another run" in capsys.readouterr().err
