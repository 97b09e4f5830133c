# SPDX-License-Identifier: BSD-3-Clause
"""What came of one deck: as stored, different, or why it cannot be said."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from enum import Enum
from pathlib import Path

import numpy as np

from ...analysis.decomposition import asked_for
from ...analysis.result import result_of
from ...analysis.verdict import AnalysisError
from ...core.arrays import FloatArray
from ...core.progress import Progress
from ...deck.rendering import DeckError
from ...model.data import ModelData
from ...model.reading import deck_bytes, read_bytes
from ...util.decks import DeckFile
from ...util.errors import FlexactError
from ...util.partial import why
from ...util.text import harmless
from .stored_answer import (
    NUMBERS,
    Images,
    Kept,
    MissingAnswerError,
    Projector,
    StoredAnswer,
    StoredAnswerError,
    answer_bytes,
    answer_in,
    answer_of,
    fixed_vectors,
    text_of,
)

MOST_NAMED = 6

# A node or element takes part in a subspace where its share of it is longer than this. Entries
# below 1e-14 are not stored, so that shares below 1e-7 cannot be told from zero.
TAKES_PART = 1e-6


#: How far answers may lie apart by default: singular values, as a fraction of the largest; and an
#: entry of a projector, or of an image under one.
WITHIN = (1e-9, 1e-8)


def differences(
    stored: StoredAnswer, found: StoredAnswer, within: tuple[float, float] = WITHIN
) -> tuple[str, ...]:
    """What differs from a stored answer, a sentence each; empty where nothing does."""
    of_values, of_projectors = within
    return (
        *_in_counts(stored, found),
        *_in_singular_values(stored, found, of_values),
        *_in_subspaces("motions", "node", stored.motions, found.motions, of_projectors),
        *_in_subspaces(
            *("self-stresses", "element", stored.self_stresses, found.self_stresses),
            of_projectors,
        ),
    )


def _in_counts(stored: StoredAnswer, found: StoredAnswer) -> Iterator[str]:
    if stored.verdict != found.verdict:
        yield f"verdict: {found.verdict}, stored as {stored.verdict}"
    for name in NUMBERS:
        if stored.numbers[name] != found.numbers[name]:
            words = name.replace("_", " ")
            yield f"{words}: {found.numbers[name]}, stored {stored.numbers[name]}"
    for kind in sorted({*stored.counts, *found.counts}):
        before, now = stored.counts.get(kind, {}), found.counts.get(kind, {})
        for name in sorted({*before, *now}):
            if before.get(name) != now.get(name):
                yield f"{name} {kind}: {now.get(name)}, stored {before.get(name)}"


def _in_singular_values(stored: StoredAnswer, found: StoredAnswer, within: float) -> Iterator[str]:
    before, now = stored.singular_values, found.singular_values
    sizes = [min(each.numbers["rows"], each.numbers["columns"]) for each in (stored, found)]
    are_all = len(before) >= sizes[0] and len(now) >= sizes[1]
    if are_all and len(before) != len(now):
        yield f"singular values: {len(now)}, stored {len(before)}"
        return
    common = min(len(before), len(now))
    before, now = before[len(before) - common :], now[len(now) - common :]
    # Where the largest is not known it is about one or more, since D(c) holds unit vectors.
    largest = float(np.max(np.abs(before), initial=0.0 if are_all else 1.0))
    apart = np.abs(before - now)
    wrong = ~(apart <= within * largest)
    if wrong.any():
        k = int(np.argmax(apart))
        yield (
            f"singular values: {int(wrong.sum())} of {common} differ; the largest difference is "
            f"in number {sizes[0] - common + k + 1}: {float(now[k])!r}, stored "
            f"{float(before[k])!r}"
        )


def _in_subspaces(name: str, owner: str, stored: Kept, found: Kept, within: float) -> Iterator[str]:
    if stored is None or found is None:
        return
    labels = tuple(dict.fromkeys((*stored.labels, *found.labels)))
    both = isinstance(stored, Projector) and isinstance(found, Projector)
    before, now = (_compared(kept, labels, both) for kept in (stored, found))
    apart = float(np.max(np.abs(before - now), initial=0.0))
    if apart <= within:
        return
    what = f"projections on the subspace differ by up to {apart:.2g}"
    if both:
        was, is_ = round(float(np.trace(before))), round(float(np.trace(now)))
        angle = math.degrees(math.asin(min(1.0, float(np.linalg.norm(before - now, 2)))))
        what = f"the subspace turned by {angle:.2g} degrees"
        if was != is_:
            what = f"{is_}, stored {was}"
    yield "; ".join((f"{name}: {what}", *_who(owner, _taking_part(stored), _taking_part(found))))


def _compared(kept: Projector | Images, labels: tuple[str, ...], as_projectors: bool) -> FloatArray:
    """(labels, ...) a projector, or its images of the fixed vectors; zeros at other labels."""
    index = {label: k for k, label in enumerate(labels)}
    place = [index[label] for label in kept.labels]
    if as_projectors and isinstance(kept, Projector):
        made = np.zeros((len(labels), len(labels)))
        made[np.ix_(place, place)] = kept.matrix
        return made
    values = kept.values if isinstance(kept, Images) else kept.matrix @ fixed_vectors(kept.labels)
    made = np.zeros((len(labels), values.shape[1]))
    made[place] = values
    return made


def _taking_part(kept: Projector | Images) -> set[int]:
    """Numbers of what reaches into the subspace, as far as what is kept tells."""
    shares = np.diag(kept.matrix) if isinstance(kept, Projector) else (kept.values**2).sum(axis=1)
    there = zip(kept.labels, shares > TAKES_PART**2, strict=True)
    return {int(label.split(":")[0]) for label, is_there in there if is_there}


def _who(owner: str, earlier: set[int], later: set[int]) -> Iterator[str]:
    for numbers, before_verb, after in (
        (later - earlier, "", " now"),
        (earlier - later, "no longer ", ""),
    ):
        if numbers:
            named = ", ".join(str(number) for number in sorted(numbers)[:MOST_NAMED])
            more = f" and {len(numbers) - MOST_NAMED} more" if len(numbers) > MOST_NAMED else ""
            who, takes = (owner, "takes") if len(numbers) == 1 else (f"{owner}s", "take")
            yield f"{who} {named}{more} {before_verb}{takes} part{after}"


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
        tolerance: How far answers may lie apart; None: as `WITHIN` says.
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
        within = WITHIN if t is None else (t, t)
        found = () if stored is None else differences(stored, now, within)
        if stored is not None and not found:
            return Finding(State.AS_STORED)
        if self.stores:
            return Finding(State.STORED, found, text=text_of(now))
        assert stored is not None
        gravity = int(stored.numbers != now.numbers or stored.counts != now.counts)
        return Finding(State.DIFFERENT, found, 2 if stored.verdict != now.verdict else gravity)


def _given(text: bytes | FlexactError) -> bytes:
    if isinstance(text, FlexactError):
        raise text
    return text
