# SPDX-License-Identifier: BSD-3-Clause
"""Files and texts: how they are named, how much memory they take, what is refused."""

import json
import os
import tracemalloc
from pathlib import Path

import pytest

import flexact

DECK = b"PLTRUSS 1 1 2\nX 2 1 0\nFIX 1\nFIX 2 2\n"


@pytest.fixture
def path(tmp_path: Path) -> Path:
    made = tmp_path / "bar.dat"
    made.write_bytes(DECK)
    return made


def test_a_small_file_takes_little_memory(path: Path) -> None:
    flexact.read(path)
    tracemalloc.start()
    try:
        flexact.read(path)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 2**22


@pytest.mark.parametrize("reported", [0, 10])
def test_a_file_that_grows_is_read_whole(
    reported: int, path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    true = os.stat(path)
    status = os.stat_result((*true[:6], reported, *true[7:10]))
    monkeypatch.setattr(os, "stat", lambda *_, **__: status)
    model = flexact.read(path)
    assert model.coordinate_classes.tolist() == [[1, 1, 0], [2, 1, 0]]


def test_paths_of_every_kind(path: Path) -> None:
    for given in (path, str(path), os.fsencode(path)):
        assert flexact.read(given).name == str(path)
        assert flexact.analyse(given).name == str(path)


@pytest.mark.posix
def test_a_path_that_is_no_text(path: Path) -> None:
    odd = os.path.join(os.fsencode(path.parent), b"d\xff.dat")
    try:
        os.rename(path, odd)
    except OSError:
        pytest.skip("the file system takes no such name")
    for given in (odd, os.fsdecode(odd)):
        deck = json.loads(flexact.analyse(given).to_json())["deck"]
        assert deck == str(path.parent / r"d\udcff.dat")


def test_texts_of_every_kind() -> None:
    for text in (DECK, DECK.decode(), bytearray(DECK), memoryview(DECK)):
        assert flexact.read_text(text).element_numbers.tolist() == [1]


@pytest.mark.parametrize("bad", [5, ["a"], None, 1.5])
def test_what_is_no_text_is_a_type_error(bad: object) -> None:
    kind = type(bad).__name__
    with pytest.raises(TypeError, match=kind):
        flexact.read_text(bad)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match=kind):
        flexact.read_text(DECK, bad)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match=kind):
        flexact.analyse(bad)  # type: ignore[arg-type]
    with pytest.raises(TypeError):
        flexact.read(bad)  # type: ignore[arg-type]


@pytest.mark.parametrize("bad", [5, b"x"])
def test_name_of_a_result_is_text(bad: object, path: Path) -> None:
    with pytest.raises(TypeError, match=type(bad).__name__):
        flexact.analyse(path, name=bad)  # type: ignore[arg-type]


def test_lines_may_end_as_on_an_old_mac() -> None:
    model = flexact.read_text("TRUSS 1 1 2\rX 2 1 0 0\rFIX 1\r")
    assert model.element_numbers.tolist() == [1]
    with pytest.raises(flexact.DeckError) as caught:
        flexact.read_text("TRUSS 1 1 2\rX 2 1 0\rFIX 1\r")
    assert [d.line for d in caught.value.diagnostics] == [2]
