# SPDX-License-Identifier: BSD-3-Clause
"""``flexact report``: which pages it writes, and what stands in its way."""

import os
import stat
from pathlib import Path
from typing import Any

import pytest
from small_decks import BROKEN, DECKS, VERDICTS, files_in, write

from flexact.apps.cli.main import main


def test_a_page_of_a_deck(decks: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    target = tmp_path / "new" / "my page.html"
    assert main(["report", str(decks / "both.dat"), "-o", str(target)]) == 0
    assert files_in(tmp_path / "new") == ["my page.html"]
    assert VERDICTS["both"] in capsys.readouterr().out
    text = target.read_text(encoding="utf-8")
    assert "both.dat" in text and "Under-constrained by 1 and over-constrained by 1" in text


def test_a_folder_of_pages_with_an_index(tmp_path: Path) -> None:
    write(tmp_path / "in" / "sub" / "exact.dat", DECKS["exact"])
    write(tmp_path / "in" / "under.dat", DECKS["under"])
    write(tmp_path / "in" / "wrong.dat", BROKEN)
    out = tmp_path / "out"
    assert main(["report", str(tmp_path / "in"), "-o", str(out)]) == 1
    assert files_in(out) == ["index.html", "sub/exact.html", "under.html", "wrong.html"]
    index = (out / "index.html").read_text(encoding="utf-8")
    for reported in ('href="sub/exact.html"', 'href="under.html"', 'href="wrong.html"'):
        assert reported in index
    assert "Cannot be analysed: 1 error" in index
    assert "1 exactly constrained" in index and "1 under-constrained" in index
    assert "PLTRUS" in (out / "wrong.html").read_text(encoding="utf-8")
    assert str(tmp_path) not in index


def test_small_pictures_in_the_index(decks: Path, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    out = tmp_path / "out"
    assert main(["report", str(decks / "over.dat"), "-o", str(out)]) == 0
    assert (out / "index.html").read_text(encoding="utf-8").count("data:image/png;base64,") == 1
    assert "data:image/png;base64," in (out / "over.html").read_text(encoding="utf-8")


def test_without_matplotlib_pages_are_made_and_it_is_said(
    decks: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr("flexact.show.picture.make._missing", lambda: ["matplotlib"])
    out = tmp_path / "out"
    assert main(["report", str(decks / "over.dat"), "-o", str(out)]) == 0
    assert "pip install matplotlib pillow" in capsys.readouterr().err
    assert files_in(out) == ["index.html", "over.html"]
    assert "data:image/png" not in (out / "over.html").read_text(encoding="utf-8")


def test_a_broken_deck_gives_a_page_and_code_2(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = write(tmp_path / "wrong.dat", BROKEN)
    target = tmp_path / "page.html"
    assert main(["report", str(path), "-o", str(target)]) == 1
    assert "error[unknown-keyword]" in capsys.readouterr().err
    assert ">Cannot be analysed:</b> 1 error" in target.read_text(encoding="utf-8")


def test_a_deck_that_is_not_there_gives_no_page(tmp_path: Path) -> None:
    target = tmp_path / "page.html"
    assert main(["report", str(tmp_path / "none.dat"), "-o", str(target)]) == 1
    assert not target.exists()


def test_one_page_for_several_decks_is_refused(
    decks: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    target = tmp_path / "page.html"
    assert main(["report", str(decks), "-o", str(target)]) == 2
    assert f"of {len(DECKS)} decks name a folder" in capsys.readouterr().err
    assert not target.exists()


def test_a_deck_is_never_overwritten(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = write(tmp_path / "deck.html", DECKS["exact"])
    assert main(["report", str(path), "-o", str(path)]) == 2
    assert "would overwrite the deck" in capsys.readouterr().err
    assert path.read_text(encoding="utf-8") == DECKS["exact"]


def test_a_deck_called_index_is_refused_beforehand(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(tmp_path / "in" / "index.dat", DECKS["exact"])
    assert main(["report", str(tmp_path / "in"), "-o", str(tmp_path / "out")]) == 2
    assert "would both write" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_a_place_that_cannot_be_written_is_a_clear_error(
    decks: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(tmp_path / "file", "")
    target = tmp_path / "file" / "page.html"
    assert main(["report", str(decks / "exact.dat"), "-o", str(target)]) == 2
    assert f"{tmp_path / 'file'} is not a folder" in capsys.readouterr().err
    page = write(tmp_path / "old.html", "old")
    page.chmod(stat.S_IREAD)
    assert main(["report", str(decks / "exact.dat"), "-o", str(page)]) == 2
    assert "it is read-only" in capsys.readouterr().err
    assert page.read_text(encoding="utf-8") == "old"


@pytest.mark.parametrize("verdict", ["exact", "wrong"])
def test_an_existing_page_is_replaced_only_by_a_whole_one(
    verdict: str, decks: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write(decks / "wrong.dat", BROKEN)
    page = write(tmp_path / "out" / "page.html", "old")

    def full(*_: Any) -> int:
        raise OSError(28, os.strerror(28))

    monkeypatch.setattr("flexact.util.outputs.new_file", full)
    assert main(["report", str(decks / f"{verdict}.dat"), "-o", str(page)]) == 2
    assert page.read_text(encoding="utf-8") == "old"
    assert files_in(tmp_path / "out") == ["page.html"]


def test_method_and_tolerance_go_into_the_page(decks: Path, tmp_path: Path) -> None:
    target = tmp_path / "page.html"
    options = ["--method", "svd", "--tolerance", "1e-8"]
    assert main(["report", str(decks / "exact.dat"), "-o", str(target), *options]) == 0
    assert "--method svd --tolerance 1e-08" in target.read_text(encoding="utf-8")
