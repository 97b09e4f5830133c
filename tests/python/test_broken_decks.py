# SPDX-License-Identifier: BSD-3-Clause
"""Every deck of input_decks/broken has one mistake, which is reported as stored beside it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from wording import AsStored

import flexact

FOLDER = Path(__file__).parents[2] / "input_decks" / "broken"
DECKS = sorted(FOLDER.glob("*.dat"))


def reported(deck: Path, monkeypatch: pytest.MonkeyPatch) -> flexact.DeckError:
    monkeypatch.chdir(FOLDER)
    with pytest.raises(flexact.DeckError) as caught:
        flexact.read(deck.name)
    return caught.value


@pytest.mark.parametrize("deck", DECKS, ids=lambda deck: deck.stem)
def test_reported_as_stored(
    deck: Path, as_stored: AsStored, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The expected texts were read by a person, line by line."""
    as_stored(str(reported(deck, monkeypatch)), deck.with_suffix(".expected"))


@pytest.mark.parametrize("deck", DECKS, ids=lambda deck: deck.stem)
def test_one_mistake_a_deck(deck: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    errors = [d for d in reported(deck, monkeypatch).diagnostics if str(d.severity) == "error"]
    assert len(errors) == (10 if deck.stem == "ten_mistakes" else 1)


def test_ten_mistakes_are_ten_places(monkeypatch: pytest.MonkeyPatch) -> None:
    """Lines counted by hand in the deck."""
    lines = [d.line for d in reported(FOLDER / "ten_mistakes.dat", monkeypatch).diagnostics]
    assert lines == [2, 3, 5, 6, 10, 14, 16, 17, 18, 19]


def test_every_code_of_an_error_is_met(monkeypatch: pytest.MonkeyPatch) -> None:
    """The folder shows every kind of mistake that the reader of decks knows."""
    met = {d.code for deck in DECKS for d in reported(deck, monkeypatch).diagnostics}
    source = Path(__file__).parents[2] / "fortran"
    known = set()
    for file in source.rglob("*.f90"):
        for call in re.split(r"%(?:number_)?error\(", file.read_text())[1:]:
            quoted = call.split("'")
            if len(quoted) > 1 and "," not in quoted[0]:
                known.add(quoted[1])
    # This one is for arrays that were put together by hand.
    assert met == known - {"inconsistent-model"}
