# SPDX-License-Identifier: BSD-3-Clause
"""Outputs go on without a part that cannot be made, and say so; tests see mistakes all the same."""

import importlib
from pathlib import Path
from typing import Any

import pytest
from small_decks import write

from flexact import analyse
from flexact.apps.cli import command as verbs
from flexact.apps.cli.command import parser_of
from flexact.apps.cli.main import main
from flexact.apps.watch.scene import Shown
from flexact.apps.watch.worker import answer_of
from flexact.util.errors import FlexactError
from flexact.util.partial import STRICT, attempted

pytestmark = pytest.mark.dear(6)


def _fails(error: Exception) -> int:
    raise error


def test_a_part_that_cannot_be_made_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(STRICT)
    told: list[str] = []
    assert attempted("The second", lambda: 2, 0, told) == 2 and not told
    assert attempted("The third", lambda: _fails(KeyError(7)), 0, told) == 0
    assert attempted("The fourth", lambda: _fails(MemoryError()), 0, None) == 0
    (words,) = told
    assert words.startswith("The third is left out: ") and "KeyError: 7" in words


def test_tests_see_mistakes_and_refusals_stay_words() -> None:
    told: list[str] = []
    assert attempted("The third", lambda: _fails(FlexactError("no plane")), 0, told) == 0
    assert told == ["The third is left out: no plane."]
    with pytest.raises(KeyError):
        attempted("The third", lambda: _fails(KeyError(7)), 0, told)


# Outputs, where a part of them stumbles

#: Two sheets, twice, and a stage that nothing holds along x: motions, self-stresses and a freedom.
DECK = """\
BEAM 1 1 2 3 4 0 1 0
BEAM 2 5 6 7 8 0 1 0
BEAM 3 3 4 7 8
TRUSS 4 9 10
X 3 0.1 0 0
X 5 0 0.05 0
X 7 0.1 0.05 0
X 9 0 0 0.1
X 10 0.1 0 0.1
FIX 1
FIX 2
FIX 5
FIX 6
FIX 9
RLSE 1 2 5 6
RLSE 2 2 5 6
DYNX 3 2
"""
#: What stumbles, and which outputs say so.
PARTS = {
    "show.page.viewer.move": {"page", "watch"},
    "show.page.viewer.resultants": {"page", "watch"},
    "show.page.viewer.holds_data": {"page", "watch"},
    "show.page.content.viewer_data": {"page", "watch"},
    "show.page.content.advised": {"page", "watch"},
    "show.page.content.motions_part": {"page", "watch"},
    "show.page.content.stresses_part": {"page", "watch"},
    "show.picture.make.picture_bytes": {"page"},
    "show.picture.subject.move": set(),
    "show.picture.subject.resultants": set(),
    "show.drawing.selection.natural_shape": set(),
    "show.notebook.output.motion_in_parts": {"rows"},
    "show.notebook.output.describe": set(),
    "show.mesh.content.select_motion": set(),
    "apps.watch.scene.motion_in_parts": set(),
    "apps.watch.scene.stress_in_parts": set(),
}


def _stumble(*_: object, **__: object) -> None:
    raise KeyError("surprise")


@pytest.mark.parametrize("part", PARTS)
def test_an_output_goes_on_without_a_part(
    part: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    deck = write(tmp_path / "deck.dat", DECK)
    result = analyse(deck)
    assert result.under_constrained and result.over_constrained and result.freedoms
    module, _, name = part.rpartition(".")
    monkeypatch.setattr(importlib.import_module(f"flexact.{module}"), name, _stumble)
    monkeypatch.delenv(STRICT)
    for suffix in ("html", "png", "vtu"):
        if part != "show.saving.picture_bytes" or suffix != "png":
            result.save(tmp_path / f"made.{suffix}")
    assert main(["analyse", str(deck), "-o", str(tmp_path / "files")]) == 0
    shown = answer_of(str(deck), lambda _: None)
    assert isinstance(shown, Shown)
    said = {
        "page": (tmp_path / "made.html").read_text("utf-8"),
        "watch": shown.body,
        "notebook": result._repr_html_(),
        "rows": result.motions._repr_html_(),
    }
    assert {each for each, text in said.items() if "is left out" in text} >= PARTS[part]
    assert "Under-constrained by" in said["page"]


#: Of each verb that takes several decks what stumbles over one of them.
VERBS = {
    "analyse": (["-o", "out"], "apps.cli.decks.result_of"),
    "advise": ([], "apps.cli.decks.result_of"),
    "check": ([], "apps.cli.check.read_deck"),
    "batch": (["-o", "out/table.csv", "--workers", "1"], "sweeps.batch.read_bytes"),
    "regress": (["--against", "out", "--store"], "apps.checks.comparison.read_bytes"),
    "report": (["-o", "out"], "apps.cli.decks.result_of"),
}


def test_these_verbs_take_several_decks() -> None:
    several = {
        verb
        for verb in verbs.VERBS
        for action in parser_of(verb)._actions
        if action.dest == "decks" and action.nargs == "+"
    }
    assert several == set(VERBS)


@pytest.mark.parametrize("summary", [False, True])
@pytest.mark.parametrize("verb", VERBS)
def test_a_verb_goes_on_behind_a_deck_that_stumbles(
    verb: str,
    summary: bool,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    if summary and verb not in ("analyse", "check"):
        pytest.skip("has no summary")
    options, part = VERBS[verb]
    module, _, name = part.rpartition(".")
    place = importlib.import_module(f"flexact.{module}")
    work = getattr(place, name)

    def stumbles(*given: Any, **more: Any) -> Any:
        if any("bad.dat" in str(getattr(each, "name", each)) for each in (*given, *more.values())):
            raise KeyError("surprise")
        return work(*given, **more)

    monkeypatch.setattr(place, name, stumbles)
    monkeypatch.delenv(STRICT)
    monkeypatch.chdir(tmp_path)
    paths = [str(write(tmp_path / f"{each}.dat", DECK)) for each in ("a", "bad", "c")]
    code = main([verb, *paths, *options, *["--summary"] * summary])
    out, err = capsys.readouterr()
    if verb == "batch":
        # Its table has the errors.
        assert code == 0 and "surprise" in (tmp_path / "out/table.csv").read_text("utf-8")
        return
    assert code == 2
    assert "surprise" in (out if summary else err) and "report it" in out + err
    assert "c.dat" in out
    if verb == "report":
        assert (tmp_path / "out/c.html").exists() and (tmp_path / "out/bad.html").exists()
        assert "bad" in (tmp_path / "out/index.html").read_text("utf-8")
