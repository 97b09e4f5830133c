# SPDX-License-Identifier: BSD-3-Clause
"""Names that Windows refuses or takes for devices, and folders that take two names for one.

Names of devices and characters: Microsoft, "Naming Files, Paths, and Namespaces".
"""

import os
import sys
import unicodedata
from pathlib import Path, PureWindowsPath

import pytest
from small_decks import DECKS, write

from flexact.apps.cli.main import main
from flexact.util import outputs
from flexact.util import outputs as names
from flexact.util.decks import DeckFile
from flexact.util.outputs import OutputError, plan_files, write_together

RESERVED = [
    "CON",
    "nul",
    "aux.dat",
    "Com1.png",
    "lpt9",
    "prn .x",
    "CONOUT$",
    "com\N{SUPERSCRIPT TWO}.a",
]
OF_NO_FILE = ["a:b", "what?.png", "a<b", 'x"', "tab\t", "dot.", "blank ", "a|b", "*"]
FINE = [
    "con1.dat",
    "auxiliary.dat",
    "nu.l",
    "console",
    "com10",
    "com",
    ".hidden",
    "a..b",
    "\N{GREEK SMALL LETTER SIGMA}.png",
]


@pytest.mark.parametrize("name", RESERVED + OF_NO_FILE)
def test_names_that_windows_refuses_are_refused_there_alone(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    files = {tmp_path / name: b"x"}
    if sys.platform != "win32":
        write_together(files)
        assert (tmp_path / name).read_bytes() == b"x"
    monkeypatch.setattr(sys, "platform", "win32")
    for path in (tmp_path / name, tmp_path / name / "below.png"):
        with pytest.raises(OutputError, match="another name"):
            write_together({path: b"x"})
    with pytest.raises(OutputError, match="another name"):
        plan_files([DeckFile("deck.dat", Path(name) / "deck")], tmp_path, (".png",))


@pytest.mark.parametrize("name", FINE)
def test_other_names_are_taken(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "platform", "win32")
    assert names.why_unfit(Path("..", ".", name)) == ""
    write_together({tmp_path / name: b"x"})
    assert (tmp_path / name).read_bytes() == b"x"


def test_a_drive_is_no_name(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "platform", "win32")
    assert names.why_unfit(PureWindowsPath("C:\\decks\\guide.png")) == ""  # type: ignore[arg-type]
    assert "nul" in names.why_unfit(PureWindowsPath("C:\\decks\\nul.png"))  # type: ignore[arg-type]


def test_long_paths_are_told_apart_on_windows(monkeypatch: pytest.MonkeyPatch) -> None:
    long = "C:\\" + "\\".join(["folder"] * 40)
    assert names.reachable(long) == long or sys.platform == "win32"
    monkeypatch.setattr(sys, "platform", "win32")
    monkeypatch.setattr(os.path, "abspath", str)
    assert names.reachable(long) == "\\\\?\\" + long
    assert names.reachable(names.reachable(long)) == names.reachable(long)
    assert names.reachable("\\\\server" + long[2:]) == "\\\\?\\UNC\\server" + long[2:]
    assert names.reachable("C:\\short") == "C:\\short"


# Folders that take two names for one


@pytest.fixture
def blind(monkeypatch: pytest.MonkeyPatch) -> None:
    """What all folders of macOS and Windows do, as far as it can be asked."""

    def found(path: os.PathLike[str] | str) -> bool:
        place = Path(path)
        if place == place.parent or not place.parent.is_dir():
            return place == place.parent
        return names.folded(place.name) in map(names.folded, os.listdir(place.parent))

    def same(one: os.PathLike[str] | str, other: os.PathLike[str] | str) -> bool:
        return names.folded(str(one)) == names.folded(str(other))

    monkeypatch.setattr(os.path, "lexists", found)
    monkeypatch.setattr(os.path, "samefile", same)


ALIKE = [
    ("Guide", "guide"),
    ("stra\N{LATIN SMALL LETTER SHARP S}e", "STRASSE"),
    (unicodedata.normalize("NFC", "Fl\N{LATIN SMALL LETTER E WITH ACUTE}au"),
     unicodedata.normalize("NFD", "Fl\N{LATIN SMALL LETTER E WITH ACUTE}au")),
    (unicodedata.normalize("NFC", "\N{LATIN CAPITAL LETTER E WITH ACUTE}"),
     unicodedata.normalize("NFD", "\N{LATIN SMALL LETTER E WITH ACUTE}")),
]  # fmt: skip


def two(folder: Path, pair: tuple[str, str]) -> list[DeckFile]:
    """Two decks in folders of their own, whose results go to one."""
    paths = [write(folder / str(k) / f"{name}.dat", "x") for k, name in enumerate(pair)]
    return [DeckFile(str(path), Path(path.stem)) for path in paths]


@pytest.mark.parametrize("pair", ALIKE)
def test_two_decks_for_one_name_are_refused_where_it_is_one(
    pair: tuple[str, str], tmp_path: Path, blind: None
) -> None:
    with pytest.raises(OutputError, match="both write"):
        plan_files(two(tmp_path, pair), tmp_path / "new" / "results", (".json", ".png"))
    assert sorted(each.name for each in tmp_path.iterdir()) == ["0", "1"]
    # Also where one of the files, or their folder, is there already.
    write(tmp_path / "results" / f"{pair[0]}.json", "{}")
    with pytest.raises(OutputError, match="both write"):
        plan_files(two(tmp_path, pair), tmp_path / "results", (".json",))


@pytest.mark.posix("linux")
@pytest.mark.parametrize("pair", ALIKE)
def test_they_are_two_where_names_are_two(pair: tuple[str, str], tmp_path: Path) -> None:
    """On the file systems of Linux."""
    for _ in range(2):
        plan = plan_files(two(tmp_path, pair), tmp_path / "results", (".json", ".png"))
        assert len({path for paths in plan.values() for path in paths}) == 4
        write_together({path: b"{}" for paths in plan.values() for path in paths})
    assert len(list((tmp_path / "results").iterdir())) == 4
    assert sorted(each.name for each in tmp_path.iterdir()) == ["0", "1", "results"]


def test_folders_that_differ_in_capitals(tmp_path: Path, blind: None) -> None:
    decks = [DeckFile(str(tmp_path / f"{k}.dat"), Path(k, "deck")) for k in ("A", "a")]
    with pytest.raises(OutputError, match="both write"):
        plan_files(decks, tmp_path / "results", (".json",))


def test_a_deck_is_not_overwritten_under_other_capitals(tmp_path: Path, blind: None) -> None:
    deck = DeckFile(str(write(tmp_path / "Guide.DAT", "x")), Path("guide"))
    with pytest.raises(OutputError, match="overwrite the deck"):
        plan_files([deck], tmp_path, (".dat",))


def test_a_report_of_both_says_why_not(
    tmp_path: Path, blind: None, capsys: pytest.CaptureFixture[str]
) -> None:
    for k, name in enumerate(ALIKE[0]):
        write(tmp_path / str(k) / f"{name}.dat", DECKS["exact"])
    decks = [str(tmp_path / str(k) / f"{name}.dat") for k, name in enumerate(ALIKE[0])]
    assert main(["report", *decks, "-o", str(tmp_path / "pages")]) == 2
    said = capsys.readouterr()
    assert "both write" in said.err and "Traceback" not in said.err
    assert not (tmp_path / "pages").exists()


# Files that others have open


def test_a_file_that_is_open_elsewhere_is_left_on_windows(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    target = write(tmp_path / "a.svg", "old")

    def refused(*_: object) -> None:
        raise PermissionError(13, "The process cannot access the file", str(target), 32)

    monkeypatch.setattr(sys, "platform", "win32")
    monkeypatch.setattr(os, "rename", refused)
    with pytest.raises(OutputError, match="open in another program"):
        write_together({tmp_path / "new.svg": b"new", target: b"new"})
    assert [each.name for each in tmp_path.iterdir()] == ["a.svg"]
    assert target.read_text() == "old"


@pytest.mark.parametrize("times", [0, 1, 4, 5])
def test_others_that_hold_a_new_file_for_a_moment_are_waited_for(
    times: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As virus scanners do."""
    calls: list[object] = []
    waited: list[float] = []
    move = os.replace

    def replaced(source: str, target: str) -> None:
        calls.append(target)
        if len(calls) <= times:
            raise PermissionError(13, "Access is denied")
        move(source, target)

    monkeypatch.setattr(sys, "platform", "win32")
    monkeypatch.setattr(os, "replace", replaced)
    monkeypatch.setattr(outputs.time, "sleep", waited.append)
    if times <= 4:
        write_together({tmp_path / "a": b"x"})
        assert (tmp_path / "a").read_bytes() == b"x"
    else:
        with pytest.raises(OutputError, match="access is denied"):
            write_together({tmp_path / "a": b"x"})
        assert not list(tmp_path.iterdir())
    assert len(waited) == min(times, 4)
