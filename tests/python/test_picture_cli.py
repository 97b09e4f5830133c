# SPDX-License-Identifier: BSD-3-Clause
"""The command ``flexact picture``: what it writes, and what it says where it cannot."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from small_decks import BROKEN, DECKS, files_in, write

from flexact.apps.cli.main import main
from flexact.util.errors import BatchError

pytestmark = pytest.mark.dear(8)

pytest.importorskip("matplotlib")
pytest.importorskip("PIL")

STARTS = {"png": b"\x89PNG", "gif": b"GIF89a", "svg": b"<?xml", "pdf": b"%PDF"}


@pytest.mark.parametrize("suffix", STARTS)
def test_a_picture_is_written(
    suffix: str, decks: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    target = tmp_path / "new" / f"x.{suffix}"
    assert main(["picture", str(decks / "both.dat"), "-o", str(target)]) == 0
    assert target.read_bytes().startswith(STARTS[suffix])
    out, err = capsys.readouterr()
    assert out == f"{decks / 'both.dat'}: drawn in {target}\n"
    assert err == ""
    assert files_in(tmp_path / "new") == [f"x.{suffix}"]


@pytest.mark.parametrize(
    "backend", ["module://matplotlib_inline.backend_inline", "module://no.such", "bogus", "qtagg"]
)
def test_no_backend_is_needed(backend: str, decks: Path, tmp_path: Path) -> None:
    """Matplotlib refuses to be imported where it does not know the backend."""
    code = f"""
import os, sys
from flexact.apps.cli.main import main
folder = {str(tmp_path)!r}
for verb, suffix in (("picture", "png"), ("picture", "svg"), ("report", "html")):
    assert main([verb, {str(decks / "both.dat")!r}, "-o", f"{{folder}}/x.{{suffix}}"]) == 0
assert os.environ["MPLBACKEND"] == {backend!r}
assert "matplotlib.pyplot" not in sys.modules
"""
    environment = {**os.environ, "MPLBACKEND": backend}
    made = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True)
    assert made.returncode == 0, made.stderr.decode()
    assert b"data:image/png" in (tmp_path / "x.html").read_bytes()


def test_a_backend_that_there_is_stays_chosen(decks: Path, tmp_path: Path) -> None:
    code = f"""
import flexact
flexact.analyse({str(decks / "both.dat")!r}).save({str(tmp_path / "x.png")!r})
import matplotlib
assert matplotlib.rcParams["backend"] == "pdf"
"""
    environment = {**os.environ, "MPLBACKEND": "pdf"}
    subprocess.run([sys.executable, "-c", code], env=environment, check=True)


def test_options_reach_the_picture(decks: Path, tmp_path: Path) -> None:
    made = set()
    for options in (
        ["--motion", "1"],
        ["--stress", "1"],
        ["--motion", "1", "--stress", "1"],
    ):
        target = tmp_path / "x.svg"
        assert main(["picture", str(decks / "both.dat"), "-o", str(target), *options]) == 0
        made.add(target.read_bytes())
    assert len(made) == 3


def test_the_view_reaches_the_picture(tmp_path: Path) -> None:
    deck = write(tmp_path / "x.dat", "TRUSS 1 1 2\nX 2 1 2 3\nFIX 1\nEND\n")
    made = set()
    for view in ("front", "top", "right", "-60,25", "30,10"):
        target = tmp_path / "x.png"
        assert main(["picture", str(deck), "-o", str(target), f"--view={view}"]) == 0
        made.add(target.read_bytes())
    assert len(made) == 5


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (["--motion", "2"], "there is no motion 2: the analysis gives 1 motion"),
        (["--stress", "4"], "there is no self-stress 4: the analysis gives 1 self-stress"),
        (["--freedom", "1"], "there is no degree of freedom 1"),
        (
            ["--motion", "0"],
            "'--motion': a whole number from 1 is wanted, not '0'",
        ),
        (
            ["--stress", "x"],
            "'--stress': a whole number from 1 is wanted, not 'x'",
        ),
        (["--motion", "1", "--freedom", "1"], "not allowed with"),
        (["--view", "side"], "there is no view 'side'"),
        (["--quantity", "M"], "invalid value 'M' for '--quantity'"),
    ],
)
def test_a_wrong_choice_leaves_no_file(
    options: list[str],
    told: str,
    decks: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    target = tmp_path / "out" / "x.png"
    assert main(["picture", str(decks / "both.dat"), "-o", str(target), *options]) == (
        1 if "there is no" in told and "view" not in told else 2
    )
    assert told in capsys.readouterr().err
    assert not target.parent.exists()


@pytest.mark.parametrize("name", ["x.jpg", "x", "x.avi", ".png"])
def test_a_wrong_suffix_is_told_before_anything_is_read(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["picture", str(tmp_path / "missing.dat"), "-o", str(tmp_path / name)]) == 2
    assert "one of png, svg, pdf, gif, mp4, webm" in capsys.readouterr().err


def test_a_broken_deck_exits_with_2(tmp_path: Path) -> None:
    deck = write(tmp_path / "x.dat", BROKEN)
    assert main(["picture", str(deck), "-o", str(tmp_path / "x.png")]) == 1
    assert files_in(tmp_path) == ["x.dat"]


def test_several_decks_are_too_many(
    decks: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["picture", str(decks), "-o", str(tmp_path / "x.png")]) == 2
    assert f"holds {len(DECKS)} decks" in capsys.readouterr().err


def test_the_deck_is_not_overwritten(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    deck = write(tmp_path / "x.png", DECKS["exact"])
    assert main(["picture", str(deck), "-o", str(deck)]) == 2
    assert "would overwrite the deck" in capsys.readouterr().err
    assert deck.read_text() == DECKS["exact"]


def test_a_place_that_cannot_be_written_is_told(
    decks: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = write(tmp_path / "file", "")
    assert main(["picture", str(decks / "exact.dat"), "-o", str(file / "x.png")]) == 2
    assert "is not a folder" in capsys.readouterr().err
    (tmp_path / "y.png").mkdir()
    assert main(["picture", str(decks / "exact.dat"), "-o", str(tmp_path / "y.png")]) == 2
    assert "y.png: it is a folder" in capsys.readouterr().err


def test_an_existing_picture_stays_until_the_new_one_is_complete(
    decks: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    target = write(tmp_path / "out" / "x.png", "old")

    def fail(*_: object, **__: object) -> bytes:
        raise BatchError("in the middle")

    with monkeypatch.context() as patch:
        patch.setattr("flexact.show.picture.make.still_bytes", fail)
        assert main(["picture", str(decks / "both.dat"), "-o", str(target)]) == 1
    assert target.read_text() == "old"
    assert files_in(target.parent) == ["x.png"]
    assert main(["picture", str(decks / "both.dat"), "-o", str(target)]) == 0
    assert target.read_bytes().startswith(STARTS["png"])
    assert files_in(target.parent) == ["x.png"]


def test_a_missing_package_is_told_before_anything_is_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("flexact.show.picture.make.find_spec", lambda name: None)
    assert main(["picture", str(tmp_path / "missing.dat"), "-o", str(tmp_path / "x.png")]) == 2
    assert "pip install matplotlib pillow" in capsys.readouterr().err


def test_other_verbs_do_not_load_what_draws(decks: Path) -> None:
    code = (
        "import sys; from flexact.apps.cli.main import main; "
        f"main(['analyse', {str(decks / 'both.dat')!r}]); "
        "sys.exit(bool({'matplotlib', 'PIL', 'flexact.show.picture'} & set(sys.modules)))"
    )
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, check=False)
    assert result.returncode == 0, result.stderr


@pytest.mark.parametrize("suffix", STARTS)
def test_no_display_is_needed(
    suffix: str, decks: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nothing that could open a window is loaded, whatever backend is asked for."""
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.setenv("MPLBACKEND", "TkAgg")
    arguments = ["picture", str(decks / "both.dat"), "-o", str(tmp_path / f"x.{suffix}")]
    code = (
        "import sys; from flexact.apps.cli.main import main; "
        f"code = main({arguments!r}); "
        "sys.exit(code or 10 * bool({'matplotlib.pyplot', 'tkinter'} & set(sys.modules)))"
    )
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, check=False)
    assert result.returncode == 0, result.stderr


def test_a_cache_that_cannot_be_written_is_not_told(decks: Path, tmp_path: Path) -> None:
    """Matplotlib warns of it where its folder cannot be made."""
    file = write(tmp_path / "file", "")
    arguments = ["picture", str(decks / "exact.dat"), "-o", str(tmp_path / "x.png")]
    code = f"import sys; from flexact.apps.cli.main import main; sys.exit(main({arguments!r}))"
    result = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        check=False,
        env={**os.environ, "MPLCONFIGDIR": str(file / "folder")},
    )
    assert result.returncode == 0
    assert result.stderr == b""
