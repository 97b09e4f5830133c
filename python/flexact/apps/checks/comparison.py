# SPDX-License-Identifier: BSD-3-Clause
"""What came of one deck: as stored, different, or why it cannot be said."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import Enum
from pathlib import Path

from ...analysis.failing import AnalysisError
from ...analysis.result import result_of
from ...analysis.spaces import asked_for
from ...core.progress import Progress
from ...deck.errors import DeckError
from ...model.data import ModelData
from ...model.reading import deck_bytes, read_bytes
from ...util.decks import DeckFile
from ...util.errors import FlexactError
from ...util.partial import why
from ...util.plain_text import harmless
from .regress_comparison import STRICT, Tolerances, differences
from .stored_answer import (
    MissingAnswerError,
    StoredAnswer,
    StoredAnswerError,
    answer_bytes,
    answer_in,
    answer_of,
    text_of,
)

#: Called with a model before it is analysed; gives what is to be told of the progress.
Watch = Callable[[ModelData], Progress | None]


class State(Enum):
    """What came of a deck, as it is counted."""

    AS_STORED = "as stored"
    DIFFERENT = "different"
    FAILED = "failed"
    MISSING = "without a stored answer"
    STORED = "stored"


@dataclass(frozen=True)
class Finding:
    """What came of a deck.

    Attributes:
        state: In a word.
        differences: What differs, a sentence each.
        gravity: How grave that is: 2, another verdict; 1, other counts; 0, other numbers.
        error: Why nothing can be said.
        text: The answer that is to be stored.
        seconds: What it took to read and analyse the deck.
    """

    state: State
    differences: tuple[str, ...] = ()
    gravity: int = 0
    error: Exception | None = None
    text: str = ""
    seconds: float = 0.0


@dataclass(frozen=True)
class Case:
    """The texts of a deck and of its stored answer, or why they cannot be read."""

    name: str
    deck: bytes | FlexactError
    answer: bytes | StoredAnswerError
    place: Path


def reasons(finding: Finding) -> list[str]:
    """Why a deck wants attention, a line each; the first says most."""
    if finding.error is None:
        return [harmless(line) for line in finding.differences]
    words = "not enough memory" if isinstance(finding.error, MemoryError) else ""
    lines = (str(finding.error) or words or repr(finding.error)).splitlines()
    return [harmless(line) for line in lines]


def answer_place(deck: DeckFile, answers: Path) -> Path:
    """Where the stored answer of a deck stands, in the folder of all."""
    stem = answers / deck.relative
    return stem.with_name(f"{stem.name}.json")


def case_of(deck: DeckFile, answers: Path) -> Case:
    """A deck and its stored answer, as they stand in files.

    Args:
        deck: Where the deck is.
        answers: The folder of the stored answers.
    """
    place = answer_place(deck, answers)
    text: bytes | FlexactError
    stored: bytes | StoredAnswerError
    try:
        text = deck_bytes(deck)
    except DeckError as error:
        text = error
    try:
        stored = answer_bytes(place)
    except StoredAnswerError as error:
        stored = error
    return Case(deck.name, text, stored, place)


@dataclass(frozen=True)
class Question:
    """What is asked of every deck.

    Attributes:
        method: How D(c) is decomposed.
        tolerance: How far answers may lie apart; None: as `STRICT` says.
        stores: Whether what is new or differs is to be stored.
    """

    method: str
    tolerance: float | None = None
    stores: bool = False

    def __call__(self, case: Case, watch: Watch = lambda model: None) -> Finding:
        """What comes of a deck."""
        start = time.perf_counter()
        try:
            finding = self._found(case, watch)
        except MissingAnswerError as error:
            finding = Finding(State.MISSING, error=error)
        except (FlexactError, MemoryError) as error:
            finding = Finding(State.FAILED, error=error)
        except Exception as error:
            # One deck over which this program stumbles shall not cost the others.
            finding = Finding(State.FAILED, error=AnalysisError(why(error)))
        return replace(finding, seconds=time.perf_counter() - start)

    def _found(self, case: Case, watch: Watch) -> Finding:
        model = read_bytes(_given(case.deck), case.name)
        stored: StoredAnswer | None = None
        try:
            stored = answer_in(_given(case.answer), case.place)
        except StoredAnswerError:
            if not self.stores:
                raise
        asked = asked_for(self.method, None)
        now = answer_of(result_of(model, asked, case.name, watch(model)))
        t = self.tolerance
        apart = STRICT if t is None else Tolerances(t, t)
        found = () if stored is None else differences(stored, now, apart)
        if stored is not None and not found:
            return Finding(State.AS_STORED)
        if self.stores:
            return Finding(State.STORED, found, text=text_of(now))
        assert stored is not None
        return Finding(State.DIFFERENT, found, _gravity(stored, now))


def _given(text: bytes | FlexactError) -> bytes:
    if isinstance(text, FlexactError):
        raise text
    return text


def _gravity(stored: StoredAnswer, now: StoredAnswer) -> int:
    if stored.verdict != now.verdict:
        return 2
    return int(stored.numbers != now.numbers or stored.counts != now.counts)
