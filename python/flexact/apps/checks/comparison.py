# SPDX-License-Identifier: BSD-3-Clause
"""What came of one deck: as stored, different, or why it cannot be said."""

from __future__ import annotations

import math
import socket
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from pathlib import Path
from xml.etree import ElementTree

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


@dataclass(frozen=True)
class Tolerances:
    """How far answers may lie apart.

    Attributes:
        singular_values: Largest difference, as a fraction of the largest singular value.
        projectors: Largest difference of an entry of a projector, or of an image under one.
    """

    singular_values: float = 1e-9
    projectors: float = 1e-8


STRICT = Tolerances()


def differences(
    stored: StoredAnswer, found: StoredAnswer, tolerances: Tolerances = STRICT
) -> tuple[str, ...]:
    """What differs from a stored answer, a sentence each; empty where nothing does."""
    return (
        *_in_counts(stored, found),
        *_in_singular_values(stored, found, tolerances),
        *_in_subspaces("motions", "node", stored.motions, found.motions, tolerances),
        *_in_subspaces(
            "self-stresses", "element", stored.self_stresses, found.self_stresses, tolerances
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


def _in_singular_values(
    stored: StoredAnswer, found: StoredAnswer, tolerances: Tolerances
) -> Iterator[str]:
    (before, all_before), (now, all_now) = _singular_values(stored), _singular_values(found)
    if all_before and all_now and len(before) != len(now):
        yield f"singular values: {len(now)}, stored {len(before)}"
        return
    common = min(len(before), len(now))
    before, now = before[len(before) - common :], now[len(now) - common :]
    largest = float(np.max(np.abs(before), initial=0.0))
    if not (all_before and all_now):
        # The largest is not known; it is about one or more, since D(c) holds unit vectors.
        largest = max(largest, 1.0)
    apart = np.abs(before - now)
    wrong = ~(apart <= tolerances.singular_values * largest)
    if wrong.any():
        k = int(np.argmax(apart))
        number = min(stored.numbers["rows"], stored.numbers["columns"]) - common + k + 1
        yield (
            f"singular values: {int(wrong.sum())} of {common} differ; the largest difference "
            f"is in number {number}: {float(now[k])!r}, stored {float(before[k])!r}"
        )


def _singular_values(answer: StoredAnswer) -> tuple[FloatArray, bool]:
    """Singular values, and whether they are all there."""
    least = min(answer.numbers["rows"], answer.numbers["columns"])
    return answer.singular_values, len(answer.singular_values) >= least


def _in_subspaces(
    name: str, owner: str, stored: Kept, found: Kept, tolerances: Tolerances
) -> Iterator[str]:
    if stored is None or found is None:
        return
    labels = tuple(dict.fromkeys((*stored.labels, *found.labels)))
    if isinstance(stored, Projector) and isinstance(found, Projector):
        before, now = _spread(stored, labels), _spread(found, labels)
        what = _how_projectors_differ
    else:
        before, now = _images(stored, labels), _images(found, labels)
        what = _how_images_differ
    if float(np.max(np.abs(before - now), initial=0.0)) <= tolerances.projectors:
        return
    shares = _shares(stored, labels), _shares(found, labels)
    yield "; ".join((f"{name}: {what(before, now)}", *_who(owner, labels, *shares)))


def _how_projectors_differ(before: FloatArray, now: FloatArray) -> str:
    dimensions = round(float(np.trace(before))), round(float(np.trace(now)))
    if dimensions[0] != dimensions[1]:
        return f"{dimensions[1]}, stored {dimensions[0]}"
    angle = math.degrees(math.asin(min(1.0, float(np.linalg.norm(before - now, 2)))))
    return f"the subspace turned by {angle:.2g} degrees"


def _how_images_differ(before: FloatArray, now: FloatArray) -> str:
    apart = float(np.max(np.abs(before - now)))
    return f"projections on the subspace differ by up to {apart:.2g}"


def _images(kept: Projector | Images, labels: tuple[str, ...]) -> FloatArray:
    """(labels, vectors) images of the fixed vectors."""
    of_kept = kept.values if isinstance(kept, Images) else kept.matrix @ fixed_vectors(kept.labels)
    return _placed(kept, labels, of_kept)


def _shares(kept: Projector | Images, labels: tuple[str, ...]) -> FloatArray:
    """(labels,) how far each reaches into the subspace, as far as what is kept tells."""
    of_kept = np.diag(kept.matrix) if isinstance(kept, Projector) else (kept.values**2).sum(axis=1)
    return _placed(kept, labels, of_kept)


def _spread(projector: Projector, labels: tuple[str, ...]) -> FloatArray:
    rows = _placed(projector, labels, projector.matrix)
    return _placed(projector, labels, rows.T)


def _placed(kept: Projector | Images, labels: tuple[str, ...], values: FloatArray) -> FloatArray:
    """Values of what is kept, each at its label; zeros elsewhere."""
    place = {label: k for k, label in enumerate(labels)}
    made = np.zeros((len(labels), *values.shape[1:]))
    made[[place[label] for label in kept.labels]] = values
    return made


def _who(owner: str, labels: tuple[str, ...], before: FloatArray, now: FloatArray) -> Iterator[str]:
    earlier, later = _taking_part(labels, before), _taking_part(labels, now)
    for numbers, before_verb, after in (
        (later - earlier, "", " now"),
        (earlier - later, "no longer ", ""),
    ):
        if numbers:
            named = ", ".join(str(number) for number in sorted(numbers)[:MOST_NAMED])
            more = f" and {len(numbers) - MOST_NAMED} more" if len(numbers) > MOST_NAMED else ""
            who, takes = (owner, "takes") if len(numbers) == 1 else (f"{owner}s", "take")
            yield f"{who} {named}{more} {before_verb}{takes} part{after}"


def _taking_part(labels: tuple[str, ...], shares: FloatArray) -> set[int]:
    parts = shares > TAKES_PART**2
    return {int(label.split(":")[0]) for label, used in zip(labels, parts, strict=True) if used}


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


#: States that are failures of a test, and errors in it.
_FAILURES, _ERRORS = (State.DIFFERENT,), (State.FAILED, State.MISSING)


def junit_xml(found: Sequence[tuple[DeckFile, Finding]], seconds: float, start: float) -> bytes:
    """The text of a JUnit XML file: a test case a deck.

    Args:
        found: The decks, and what came of each.
        seconds: What all took.
        start: When it began [s since 1970].
    """
    root = ElementTree.Element("testsuites")
    suite = ElementTree.SubElement(
        root,
        "testsuite",
        name="flexact regress",
        package="flexact",
        id="0",
        tests=str(len(found)),
        failures=str(_count(found, _FAILURES)),
        errors=str(_count(found, _ERRORS)),
        time=f"{seconds:.3f}",
        timestamp=time.strftime("%Y-%m-%dT%H:%M:%S", time.gmtime(start)),
        hostname=socket.gethostname() or "localhost",
    )
    ElementTree.SubElement(suite, "properties")
    for deck, finding in found:
        _add(suite, deck, finding)
    ElementTree.SubElement(suite, "system-out")
    ElementTree.SubElement(suite, "system-err")
    ElementTree.indent(root)
    text = ElementTree.tostring(root, encoding="UTF-8", xml_declaration=True)
    return bytes(text) + b"\n"


def _count(found: Iterable[tuple[DeckFile, Finding]], states: tuple[State, ...]) -> int:
    return sum(finding.state in states for _, finding in found)


def _add(suite: ElementTree.Element, deck: DeckFile, finding: Finding) -> None:
    case = ElementTree.SubElement(
        suite,
        "testcase",
        name=harmless(deck.name),
        classname=harmless(".".join(("decks", *_name(deck.relative.parent).split("/")))).strip("."),
        time=f"{finding.seconds:.6f}",
    )
    if finding.state in (*_FAILURES, *_ERRORS):
        kind = "failure" if finding.state in _FAILURES else "error"
        lines = reasons(finding)
        about = ElementTree.SubElement(case, kind, type=finding.state.value, message=lines[0])
        about.text = "\n".join(lines)


def _name(folder: object) -> str:
    text = str(folder).encode("utf-8", "backslashreplace").decode("utf-8")
    return "" if text == "." else text.replace("\\", "/")
