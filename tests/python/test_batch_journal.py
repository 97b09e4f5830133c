# SPDX-License-Identifier: BSD-3-Clause
"""The journal of a long run: whatever happens to it, whole lines count and others do not."""

import json
import os
import subprocess
import sys
import time
import zlib
from pathlib import Path

import pytest
from test_cli_process import process_environment

from flexact.sweeps.journal import Journal, JournalError
from flexact.util.outputs import OutputError

pytestmark = pytest.mark.dear(15)

HEAD = {"journal": 1, "decks": ["\u03b1", "\udcff.dat"]}
RECORDS = [{"row": [k, 0.1 * k, None, float("inf")], "text": "x\ny"} for k in range(5)]


def journal_of(path: Path) -> Journal:
    journal = Journal.resume(path)
    assert journal is not None
    return journal


def records(path: Path) -> list[object]:
    """What a reader finds who comes later."""
    journal = journal_of(path)
    try:
        head, *found = (record for _, record in journal.entries())
        assert head == journal.head
        return found
    finally:
        journal.close()


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """Of a journal with five records, which nobody has open."""
    journal = Journal.begin(tmp_path / "table.csv.journal", HEAD)
    places = [journal.add(record) for record in RECORDS]
    assert [journal.read(place) for place in places] == RECORDS
    journal.close()
    return tmp_path / "table.csv.journal"


def test_what_was_added_is_found_again(path: Path) -> None:
    assert journal_of(path).head == HEAD
    assert records(path) == RECORDS


def test_lines_are_as_documented(path: Path) -> None:
    """Anybody can check them: zlib's CRC-32 in eight digits, a blank, JSON."""
    for line in path.read_bytes().splitlines():
        total, text = line.split(b" ", 1)
        assert total == b"%08x" % zlib.crc32(text)
        json.loads(text)


def test_without_a_journal_there_is_none(tmp_path: Path) -> None:
    assert Journal.resume(tmp_path / "none") is None


def test_a_journal_that_is_cut_anywhere_keeps_its_whole_lines(path: Path) -> None:
    """As by a process that is killed while it writes; what is added later is kept as well."""
    whole = path.read_bytes()
    head = whole.index(b"\n") + 1
    for size in range(head, len(whole)):
        path.write_bytes(whole[:size])
        kept = whole[:size].count(b"\n") - 1
        # A line whose end alone is missing is whole.
        kept += whole[size : size + 1] == b"\n"
        journal = journal_of(path)
        added = journal.add({"more": size})
        assert journal.read(added) == {"more": size}
        journal.close()
        assert records(path) == [*RECORDS[:kept], {"more": size}]


@pytest.mark.parametrize("bad", [b"\0" * 300, b"\n\n", b"0badc0de {}\n", b"\xff\xfe\n", b"\0" * 10])
def test_noise_between_lines_is_passed_over(bad: bytes, path: Path) -> None:
    """Such as zeros where the disk had not kept a part before the power went."""
    lines = path.read_bytes().splitlines(keepends=True)
    path.write_bytes(b"".join([*lines[:3], bad.ljust(len(bad)), b"\n", *lines[3:]]))
    assert records(path) == RECORDS


def test_a_changed_line_counts_as_missing(path: Path) -> None:
    lines = path.read_bytes().splitlines(keepends=True)
    path.write_bytes(b"".join([*lines[:2], lines[2].replace(b"0.1", b"0.2"), *lines[3:]]))
    assert records(path) == [RECORDS[0], *RECORDS[2:]]


@pytest.mark.parametrize("content", [b"", b"deck,verdict\n", b"0badc0de {}\n"])
def test_what_is_no_journal_is_refused(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "table.csv.journal"
    path.write_bytes(content)
    with pytest.raises(JournalError, match="does not begin as a journal does"):
        Journal.resume(path)


def test_a_folder_is_refused(tmp_path: Path) -> None:
    with pytest.raises(JournalError, match="cannot read"):
        Journal.resume(tmp_path)


def test_a_journal_is_there_with_its_head_or_not_at_all(tmp_path: Path) -> None:
    with pytest.raises(TypeError):
        Journal.begin(tmp_path / "table.csv.journal", object())
    assert os.listdir(tmp_path) == []


@pytest.mark.posix
def test_two_processes_do_not_share_a_journal(path: Path) -> None:
    code = (
        "import sys; from pathlib import Path\n"
        "from flexact.sweeps.journal import Journal, JournalError\n"
        "try: Journal.resume(Path(sys.argv[1]))\n"
        "except JournalError as error: print(error)\n"
    )
    held = journal_of(path)
    program = [sys.executable, "-c", code, str(path)]
    said = [subprocess.check_output(program, env=process_environment(), text=True)]
    held.close()
    said += [subprocess.check_output(program, env=process_environment(), text=True)]
    assert "still going on" in said[0] and said[1] == ""


@pytest.mark.posix("linux")
def test_a_full_disk_is_said(path: Path) -> None:
    journal = journal_of(path)
    full = os.open("/dev/full", os.O_WRONLY)
    os.dup2(full, journal._handle)
    with pytest.raises(OutputError, match="no space left"):
        journal.add({})
    os.close(full)


def test_what_is_removed_is_gone(path: Path) -> None:
    journal_of(path).remove()
    assert not path.exists()


def test_long_heads_and_records_are_read(tmp_path: Path) -> None:
    """Longer than what is read at a time."""
    head = {"decks": ["x" * 100] * 30_000}
    journal = Journal.begin(tmp_path / "journal", head)
    long = {"picture": "y" * 3_000_000}
    assert [journal.read(journal.add(r)) for r in (RECORDS[0], long)] == [RECORDS[0], long]
    journal.close()
    assert records(tmp_path / "journal") == [RECORDS[0], long]


#: Begins or resumes a journal at a moment that all agree on, works a while, and says what came.
RACE = """
import sys, time
from pathlib import Path
from flexact.sweeps.journal import Journal, JournalError
path, moment, mark = Path(sys.argv[1]), float(sys.argv[2]), sys.argv[3]
while time.time() < moment: pass
try:
    journal = Journal.resume(path) or Journal.begin(path, {"decks": []})
except JournalError:
    print("refused")
else:
    journal.add({"by": mark})
    time.sleep(0.3)
    lost = not path.exists() or mark not in path.read_text()
    print("lost" if lost else "won")
    journal.close()
"""


@pytest.mark.posix
def test_of_runs_that_begin_together_one_goes_on(tmp_path: Path) -> None:
    for number in range(5):
        path = tmp_path / f"{number}.journal"
        moment = time.time() + 1.0
        runs = [
            subprocess.Popen(
                [sys.executable, "-c", RACE, str(path), str(moment), f"mark {k}"],
                env=process_environment(),
                stdout=subprocess.PIPE,
                text=True,
            )
            for k in range(4)
        ]
        said = sorted(run.communicate()[0].strip() for run in runs)
        assert said == ["refused"] * 3 + ["won"]


def test_a_journal_that_came_meanwhile_is_not_written_over(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = path.read_bytes()
    for links in (True, False):
        if not links:
            monkeypatch.setattr(os, "link", refuse)
        with pytest.raises(JournalError, match="has just begun"):
            Journal.begin(path, {"decks": ["other"]})
        assert path.read_bytes() == before and os.listdir(path.parent) == [path.name]
    Journal.begin(path.with_name("new"), HEAD).close()
    assert journal_of(path.with_name("new")).head == HEAD


def refuse(*_: object) -> None:
    """As file systems do that have no further names."""
    raise PermissionError(1, "Operation not permitted")


@pytest.mark.posix
def test_a_journal_that_was_taken_away_before_it_was_locked_is_none(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As by a run that ends between."""
    lock = Journal._lock
    taken = []

    def late(journal: Journal) -> None:
        if not taken:
            taken.append(path.unlink())
        lock(journal)

    monkeypatch.setattr(Journal, "_lock", late)
    assert Journal.resume(path) is None


def line(text: bytes) -> bytes:
    return b"%08x %s\n" % (zlib.crc32(text), text)


@pytest.mark.parametrize(
    "text",
    [b"{", b"[]", b"7", b"null", b'"x"', b"[" * 100_000 + b"]" * 100_000, b"9" * 5000, b"\xff"],
)
def test_a_line_with_a_right_sum_and_no_record_is_passed_over(text: bytes, path: Path) -> None:
    lines = path.read_bytes().splitlines(keepends=True)
    path.write_bytes(b"".join([*lines[:2], line(text), *lines[2:]]))
    assert records(path) == RECORDS
    path.write_bytes(b"".join([line(text), *lines]))
    with pytest.raises(JournalError, match="does not begin as a journal does"):
        Journal.resume(path)
