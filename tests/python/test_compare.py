# SPDX-License-Identifier: BSD-3-Clause
"""Two runs of decks compared: what is said, what the command returns, and what a browser shows."""

import shutil
from pathlib import Path

import pytest
from browser import Browser
from reference_decks import ROOT
from small_decks import BROKEN, DECKS, files_in, write

import flexact
from flexact.analysis.differences import Gravity, Side, change_of, side_of, stored_side
from flexact.apps.cli.main import main
from flexact.apps.cli.terminal import ExitCode

pytestmark = pytest.mark.dear(5)

#: Four bars in a square with fixed lower corners, and what makes it stiff.
SQUARE = """\
PLTRUSS 1 1 3
PLTRUSS 2 3 4
PLTRUSS 3 4 2
X 1 0 0
X 2 1 0
X 3 0 1
X 4 1 1
FIX 1
FIX 2
"""
BRACE = "PLTRUSS 4 1 4\n"
OTHER = "PLTRUSS 5 2 3\n"
SHOWN = """return Array.from(document.querySelectorAll(".card")).filter(card => !card.hidden)
  .map(card => card.querySelector(".name").textContent)"""


@pytest.fixture
def runs(tmp_path: Path) -> tuple[Path, Path]:
    """Five decks, of which one changes, one breaks, one is said otherwise, one goes, one comes."""
    one, other = tmp_path / "one", tmp_path / "other"
    for name in ("exact", "over"):
        write(one / f"{name}.dat", DECKS[name])
        write(other / f"{name}.dat", f"% a remark\n{DECKS[name]}".replace("0.5 1\n", ".50 1.0\n"))
    write(one / "sub" / "square.dat", SQUARE)
    write(other / "sub" / "square.dat", SQUARE + BRACE)
    write(one / "breaks.dat", DECKS["exact"])
    write(other / "breaks.dat", BROKEN)
    write(one / "goes.dat", DECKS["under"])
    write(other / "comes.dat", DECKS["both"])
    return one, other


def side(text: str, folder: Path) -> Side:
    return side_of(flexact.analyse(write(folder / "deck.dat", text)))


def test_a_brace_takes_the_motion_of_a_square(tmp_path: Path) -> None:
    """Maxwell's count: three bars for four coordinates, then four, then five."""
    loose, braced = side(SQUARE, tmp_path), side(SQUARE + BRACE, tmp_path)
    change = change_of(loose, braced)
    assert change.gravity is Gravity.VERDICT
    assert change.told[:2] == (
        "under-constrained by 1 \u2192 exactly constrained",
        "motions: 1 \u2192 0",
    )
    assert len(change.went) == 1 and change.went[0].startswith("motion: ") and not change.came
    assert [(each.added, each.written) for each in change.statements] == [(True, BRACE.strip())]
    back = change_of(braced, side(SQUARE + BRACE + OTHER, tmp_path))
    assert len(back.came) == 1 and back.came[0].startswith("self-stress: ") and not back.went


def test_spaces_are_compared_and_not_bases(tmp_path: Path) -> None:
    """Two loose nodes with two motions; holding one leaves one of the two, and takes the other."""
    loose = "PLTRUSS 1 1 2\nPLTRUSS 2 1 3\nX 2 1 0\nX 3 0 1\nFIX 1\n"
    change = change_of(side(loose, tmp_path), side(loose + "FIX 2 2\n", tmp_path))
    assert len(change.went) == 1 and not change.came
    # A bar that turns by a tenth of a degree moves in the same way; one that turns by 40 does not.
    little = change_of(side(loose, tmp_path), side(loose.replace("1 0\n", "1 .002\n"), tmp_path))
    assert (little.came, little.went) == ((), ()) and little.gravity is Gravity.STATEMENTS
    much = change_of(side(loose, tmp_path), side(loose.replace("1 0\n", "1 .84\n"), tmp_path))
    assert len(much.came) == len(much.went) == 1 and much.gravity is Gravity.COUNTS


@pytest.mark.parametrize(
    "name", ["paper/six_folded_sheets", "linkages/sarrus", "frameworks/ring_6"]
)
def test_a_stored_result_is_the_result(name: str) -> None:
    """What analyse -o wrote compares with the deck as the deck with itself."""
    analysis = flexact.analyse(ROOT / "input_decks" / f"{name}.dat")
    kept = stored_side(analysis.to_json().encode(), "x.json")
    change = change_of(kept, side_of(analysis))
    assert change.is_none and not change.told and not change.came and not change.went
    assert len(kept.motions) == analysis.under_constrained
    assert all(mode.words for mode in (*kept.motions, *kept.self_stresses))


def test_a_stored_margin_that_an_accuracy_exceeds_is_told_however_large() -> None:
    analysis = flexact.analyse(flexact.read_text(DECKS["exact"]), accuracy=1.2)
    now = side_of(analysis)
    assert stored_side(analysis.to_json().encode(), "x.json").margin == now.margin == "margin 1.1 m"


def test_remarks_and_spellings_of_numbers_change_nothing(tmp_path: Path) -> None:
    text = DECKS["exact"]
    spelt = text.replace("0.5 1\n", "5.0D-1   1. # so\n").lower().replace("\n", "\r\n")
    change = change_of(side(text, tmp_path), side(spelt, tmp_path))
    assert change.is_none and change.statements == ()


def test_folders_are_compared_by_relative_names(
    runs: tuple[Path, Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    target = tmp_path / "page" / "x.html"
    code = main(["report", *map(str, runs), "--compare", "-o", str(target)])
    out = capsys.readouterr().out.splitlines()
    assert code == ExitCode.DECK_ERROR
    assert out[-1] == (
        f"6 decks: 2 changed, 2 as before, 1 only in one, 1 only in other; page in {target}"
    )
    assert "goes: only in one" in out and "comes: only in other" in out
    assert any(line.startswith("sub/square: under-constrained by 1 \u2192 exact") for line in out)
    assert any(line.startswith("breaks: exactly constrained \u2192 cannot be") for line in out)
    assert files_in(tmp_path / "page") == ["x.html"]


def test_expect_same_exits_with_3(
    runs: tuple[Path, Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Pictures take their time.
    monkeypatch.setattr("flexact.apps.cli.report.small_picture", lambda result: None)
    monkeypatch.setattr("flexact.apps.cli.report.has_packages", lambda: False)
    one, other = runs
    (other / "breaks.dat").unlink()
    compared = ["report", str(one), str(other), "--compare", "-o", str(tmp_path / "x.html")]
    assert main(compared) == 0
    assert main([*compared, "--expect", "same"]) == ExitCode.DIFFERENT
    for name in ("exact", "over"):
        alike = [str(run / f"{name}.dat") for run in runs]
        assert main(["report", *alike, *compared[3:], "--expect", "same"]) == 0
    changed = [str(run / "sub" / "square.dat") for run in runs]
    assert main(["report", *changed, *compared[3:], "--expect", "same"]) == ExitCode.DIFFERENT


def test_stored_results_are_compared_with_decks(
    runs: tuple[Path, Path],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr("flexact.apps.cli.report.small_picture", lambda result: None)
    one, other = runs
    (other / "breaks.dat").unlink()
    assert main(["analyse", str(one), "-o", str(tmp_path / "kept")]) == 0
    capsys.readouterr()
    compared = ["--compare", "-o", str(tmp_path / "x.html")]
    assert main(["report", str(tmp_path / "kept"), str(one), *compared, "--expect", "same"]) == 0
    assert capsys.readouterr().out.startswith("5 decks: 5 as before")
    assert main(["report", str(tmp_path / "kept"), str(other), *compared]) == 0
    assert "sub/square: under-constrained by 1 \u2192 exactly" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("paths", "reason"),
    [
        (["one"], "two decks, or two folders, not 1 path"),
        (["one", "other", "one/exact.dat"], "two decks, or two folders, not 3 paths"),
        (["one", "other/exact.dat"], "one is a folder, and other/exact.dat is not"),
        (["one", "one/"], "one and one/ are one folder"),
        (["one/exact.dat", "./one/exact.dat"], "are one deck"),
        (["one", "nothing"], "nothing: there is no such deck or folder"),
        (["one/exact.dat", "-"], "standard input is neither"),
        (["one", "empty"], "empty: no deck"),
        (["one/exact.dat", "wrong.json"], "wrong.json: this is not the JSON of a result"),
        (["one/exact.dat", "old.json"], "old.json: the format 1 is not known"),
    ],
)
def test_wrong_use_is_told(
    paths: list[str],
    reason: str,
    runs: tuple[Path, Path],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("empty").mkdir()
    write(Path("wrong.json"), '{"a": 1}')
    write(Path("old.json"), '{"flexact": "0", "format": 1}')
    code = main(["report", *paths, "--compare", "-o", "x.html"])
    assert code not in (0, ExitCode.DIFFERENT)
    assert reason in " ".join(capsys.readouterr().err.split())
    assert not Path("x.html").exists()


def test_a_page_is_wanted_and_no_deck_is_overwritten(
    runs: tuple[Path, Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    compared = ["report", *map(str, runs), "--compare", "-o"]
    assert main([*compared, str(tmp_path / "folder")]) not in (0, 3)
    assert "one page: -o NAME.html" in capsys.readouterr().err
    deck = tmp_path / "deck.html"
    shutil.copy(runs[0] / "exact.dat", deck)
    pair = [str(deck), str(runs[1] / "exact.dat")]
    assert main(["report", *pair, "--compare", "-o", str(deck)]) not in (0, 3)
    assert "would overwrite the deck" in capsys.readouterr().err
    assert main(["report", str(deck), "-o", str(tmp_path / "y"), "--expect", "same"]) not in (0, 3)
    assert "--expect same is for --compare" in capsys.readouterr().err


def test_the_page_of_two_folders(runs: tuple[Path, Path], browser: Browser, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    target = tmp_path / "x.html"
    main(["report", *map(str, runs), "--compare", "-o", str(target)])
    browser.open(target)
    # The gravest first.
    first = ["comes", "goes", "breaks", "sub/square", "exact", "over"]
    assert browser.run(SHOWN) == first
    browser.press('.chip input[value="changed"]')
    assert browser.run(SHOWN) == ["breaks", "sub/square"]
    assert browser.run("return location.hash") == "#show=changed"
    card = browser.run(
        "return [...document.querySelectorAll('.card')].find(c => !c.hidden"
        " && c.textContent.includes('square')).innerText"
    )
    assert "Under-constrained by 1" in card and "Exactly constrained" in card
    assert "Motions: 1 \u2192 0" in card and "gone" in card
    browser.press(".statements summary")
    opened = browser.run(
        "return [...document.querySelectorAll('details')].map(d => d.textContent).join()"
    )
    assert "PLTRUSS 4 1 4" in opened
    for scheme in ("light", "dark"):
        browser.prefer(prefers_color_scheme=scheme)
        for width in (360, 800, 1280):
            browser.resize(width, 900)
            assert browser.run("return document.documentElement.scrollWidth <= innerWidth")
    assert browser.console() == []
    assert [each for each in browser.requests() if not each.startswith("data:")] == [
        target.as_uri()
    ]


def test_the_page_of_two_decks_plays_both(
    runs: tuple[Path, Path], browser: Browser, tmp_path: Path
) -> None:
    target = tmp_path / "x.html"
    pair = [str(run / "sub" / "square.dat") for run in runs]
    assert main(["report", *pair, "--compare", "-o", str(target)]) == 0
    browser.open(target)
    assert browser.run("return drawings.length") == 2
    words = browser.run("return document.querySelector('#changes').innerText")
    assert "Motions: 1 \u2192 0" in words
    heads = browser.run("return Array.from(document.querySelectorAll('.which'), e => e.innerText)")
    assert heads == ["Before: one/sub/square.dat", "After: other/sub/square.dat"]
    for width in (360, 800, 1280):
        browser.resize(width, 900)
        assert browser.run("return document.documentElement.scrollWidth <= innerWidth")
    assert browser.console() == []
    broken = [str(run / "breaks.dat") for run in runs]
    assert main(["report", *broken, "--compare", "-o", str(target)]) == ExitCode.DECK_ERROR
    browser.open(target)
    assert "1:1: PLTRUS is not a keyword" in browser.run("return document.body.innerText")
    assert browser.console() == []
