# SPDX-License-Identifier: BSD-3-Clause
"""Stored answers: what is kept of an analysis, and what differs from it in later ones.

A stored answer keeps what does not depend on the sign, order or basis that a decomposition
happens to choose: verdict, counts, rank, singular values, and the two null spaces of D(c) as
orthogonal projectors V V' and U U'. Of a projector that is too large its images of a few fixed
vectors are kept, and nothing of a null space of which not all vectors are given.
"""

from __future__ import annotations

import json
import math
import re
import time
import zlib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from pathlib import Path
from typing import Any

import numpy as np

from ...analysis.decomposition import asked_for
from ...analysis.result import Result, result_of
from ...analysis.sparse_basis import support_of
from ...analysis.verdict import AnalysisError
from ...core.arrays import Basis, FloatArray, IndexArray
from ...core.progress import Progress
from ...deck.rendering import DeckError
from ...model.data import ModelData, column_labels, row_labels
from ...model.reading import deck_bytes, read_bytes
from ...util.decks import DeckFile
from ...util.errors import BatchError, FlexactError, reason_of
from ...util.loading import VERSION
from ...util.partial import why
from ...util.text import harmless

#: Number of the fixed vectors.
VECTORS = 3
#: When the equations of a projection count as solved, and how long that may take.
_SOLVED = 1.0e-14
_MOST_STEPS = 500
FORMAT = 1
#: Projectors that reach more labels than this are kept by their images.
LARGEST_PROJECTOR = 1000
SMALLEST_ENTRY = 1e-14
NUMBERS = ("rank", "rows", "columns", "under_constrained", "over_constrained", "degrees_of_freedom")
MOST_NAMED = 6
#: How far answers may lie apart by default: singular values, as a fraction of the largest; and an
#: entry of a projector, or of an image under one.
WITHIN = (1e-9, 1e-8)
#: A node or element takes part in a subspace where its share of it is longer than this. Entries
#: below 1e-14 are not stored, so that shares below 1e-7 cannot be told from zero.
TAKES_PART = 1e-6


class StoredAnswerError(BatchError):
    """A stored answer is missing or cannot be understood."""


class MissingAnswerError(StoredAnswerError):
    """There is no stored answer."""


def fixed_vectors(labels: Sequence[str]) -> FloatArray:
    """(labels, VECTORS) numbers between -1 and 1 that follow from the labels alone."""
    made = np.empty((len(labels), VECTORS))
    for k in range(VECTORS):
        made[:, k] = [zlib.crc32(f"{k}/{label}".encode()) for label in labels]
    return made / 2.0**31 - 1.0


def project(basis: Basis, vectors: FloatArray) -> FloatArray:
    """(size, p) orthogonal projections of vectors onto the span of a basis.

    The basis need not be orthonormal: B (B'B)^-1 B' is applied by conjugate gradients
    (Hestenes and Stiefel 1952), which take one step where it is.
    """
    of_entry = basis.of_entries()

    def products(vector: FloatArray) -> FloatArray:
        sums = np.bincount(of_entry, basis.value * vector[basis.place], basis.vectors)
        return np.asarray(sums, np.float64)

    made = np.zeros((basis.size, vectors.shape[1]))
    for k in range(vectors.shape[1]):
        rest = products(vectors[:, k])
        direction, square = rest, rest @ rest
        least = _SOLVED**2 * square
        for _ in range(_MOST_STEPS):
            if not square > least:
                break
            sums = np.bincount(basis.place, basis.value * direction[of_entry], basis.size)
            change = np.asarray(sums, np.float64)
            step = square / (change @ change)
            made[:, k] += step * change
            rest = rest - step * products(change)
            before, square = square, rest @ rest
            direction = rest + square / before * direction
    return made


@dataclass(frozen=True)
class Kept:
    """What is kept of an orthogonal projector onto a subspace.

    Attributes:
        labels: What each row is, ``"<node>:<coordinate>"`` or ``"<element>:<deformation>"``;
            labels that are left out stand for zeros.
        values: The projector, symmetric, (labels, labels); or its images of the fixed vectors,
            (labels, VECTORS).
        is_whole: Whether it is the projector itself.
    """

    labels: tuple[str, ...]
    values: FloatArray
    is_whole: bool = True

    def images(self) -> FloatArray:
        """(labels, VECTORS) the images of the fixed vectors."""
        return self.values @ fixed_vectors(self.labels) if self.is_whole else self.values


@dataclass(frozen=True)
class StoredAnswer:
    """What is kept of an analysis.

    Attributes:
        deck: The deck's name.
        source: Where the numbers come from.
        verdict: The verdict in words.
        numbers: rank, rows, columns, under_constrained, over_constrained, degrees_of_freedom.
        counts: By ``coordinates`` and ``deformations``, then by class.
        singular_values: Of D(c), descending: all min(rows, columns), or the smallest.
        motions: Of the projector onto the null space of D(c); None where that is not known as a
            whole.
        self_stresses: Likewise of the null space of its transpose.
    """

    deck: str
    source: str
    verdict: str
    numbers: Mapping[str, int]
    counts: Mapping[str, Mapping[str, int]]
    singular_values: FloatArray
    motions: Kept | None
    self_stresses: Kept | None


def answer_of(analysis: Result) -> StoredAnswer:
    """What is kept of an analysis."""
    arrays, raw = analysis.data.arrays, analysis.raw
    motions, stresses = support_of(raw.motions), support_of(raw.stresses)
    nodes = column_labels(arrays, raw.column_label[:, motions] - 1)
    elements = row_labels(arrays, raw.row_label[:, stresses] - 1)

    def kept(
        basis: Basis,
        support: IndexArray,
        labels: Sequence[tuple[int, int | str]],
        dimension: int,
    ) -> Kept | None:
        if basis.vectors < dimension:
            return None
        # The same vectors without places at which all are zero.
        place = np.searchsorted(support, basis.place).astype(np.int32)
        short = basis._replace(size=support.size, place=place)
        names = tuple(f"{number}:{part}" for number, part in labels)
        if len(names) > LARGEST_PROJECTOR:
            return Kept(names, project(short, fixed_vectors(names)), is_whole=False)
        vectors = short.toarray()
        return Kept(names, vectors @ vectors.T)

    return StoredAnswer(
        deck=analysis.name,
        source=f"flexact {VERSION}",
        verdict=analysis.verdict.value,
        numbers={name: int(getattr(analysis, name)) for name in NUMBERS},
        counts={name: part._asdict() for name, part in analysis.counts._asdict().items()},
        singular_values=analysis.singular_values,
        motions=kept(raw.motions, motions, nodes, analysis.under_constrained),
        self_stresses=kept(raw.stresses, stresses, elements, analysis.over_constrained),
    )


def text_of(answer: StoredAnswer) -> str:
    """The text of a stored answer: JSON, an entry of a projector a line, numbers exact."""
    content: dict[str, Any] = {"format": FORMAT, "deck": answer.deck, "source": answer.source}
    content |= {"verdict": answer.verdict, **answer.numbers, "counts": answer.counts}
    content["singular_values"] = answer.singular_values.tolist()
    lines = [f"{json.dumps(key)}: {json.dumps(value)}" for key, value in content.items()]
    for name, kept in (("motions", answer.motions), ("self_stresses", answer.self_stresses)):
        lines.append(f'"{name}": {"null" if kept is None else _text_of_subspace(kept)}')
    return "{\n  " + ",\n  ".join(lines) + "\n}\n"


def _text_of_subspace(kept: Kept) -> str:
    names, values = kept.labels, kept.values.tolist()
    rows: Iterable[Sequence[Any]]
    if kept.is_whole:
        there = np.argwhere(np.triu(np.abs(kept.values) > SMALLEST_ENTRY)).tolist()
        rows = ((names[i], names[k], values[i][k]) for i, k in there)
    else:
        rows = ((label, *row) for label, row in zip(names, values, strict=True))
    entries = ",".join(f"\n      {json.dumps(row)}" for row in rows)
    what, end = "projector" if kept.is_whole else "images", "\n    " if entries else ""
    return f'{{\n    "{what}": [{entries}{end}]\n  }}'


def answer_bytes(path: Path) -> bytes:
    """The text of a stored answer as it stands in a file.

    Raises:
        MissingAnswerError: There is no such file.
        StoredAnswerError: It cannot be read.
    """
    try:
        return path.read_bytes()
    except FileNotFoundError:
        raise MissingAnswerError(f"{path}: no stored answer; --store makes one") from None
    except OSError as error:
        raise StoredAnswerError(f"{path}: cannot be read: {reason_of(error)}") from error


def answer_in(raw: bytes, path: Path) -> StoredAnswer:
    """Read a stored answer from its text, which stands at a path.

    Raises:
        StoredAnswerError: It is not of this format, or lacks something.
    """
    try:
        return _understood(json.loads(raw.decode("utf-8")))
    except StoredAnswerError as error:
        raise StoredAnswerError(f"{path}: not a stored answer of flexact: {error}") from error
    except (ValueError, TypeError, AttributeError, OverflowError, RecursionError) as error:
        raise StoredAnswerError(f"{path}: not a stored answer of flexact") from error
    except KeyError as error:
        message = f"{path}: not a stored answer of flexact: {error} is missing"
        raise StoredAnswerError(message) from error


def _understood(content: dict[str, Any]) -> StoredAnswer:
    if "flexact" in content:
        raise StoredAnswerError("it is the JSON of a result; regress --store makes a stored answer")
    if content["format"] != FORMAT:
        raise StoredAnswerError(f"format {content['format']!r} is not known")
    values = np.array(content["singular_values"], dtype=np.float64)
    if values.ndim != 1 or not np.isfinite(values).all():
        raise StoredAnswerError("'singular_values' is no list of finite numbers")
    return StoredAnswer(
        deck=content["deck"],
        source=content["source"],
        verdict=content["verdict"],
        numbers={name: int(content[name]) for name in NUMBERS},
        counts={kind: dict(part) for kind, part in content["counts"].items()},
        singular_values=values,
        motions=_understood_subspace(content["motions"]),
        self_stresses=_understood_subspace(content["self_stresses"]),
    )


def _understood_subspace(kept: dict[str, Any] | None) -> Kept | None:
    if kept is None:
        return None
    if "images" in kept:
        rows = kept["images"]
        labels = _checked_labels(row[0] for row in rows)
        values = np.array([row[1:] for row in rows], np.float64).reshape(len(rows), -1)
        if values.shape != (len(labels), VECTORS) or not np.isfinite(values).all():
            raise StoredAnswerError(f"'images' is no list of labels with {VECTORS} finite numbers")
        return Kept(labels, values, is_whole=False)
    triangle: Sequence[tuple[str, str, float]] = kept["projector"]
    labels = _checked_labels(name for row, column, _ in triangle for name in (row, column))
    place = {name: k for k, name in enumerate(labels)}
    matrix = np.zeros((len(labels), len(labels)))
    for row, column, value in triangle:
        matrix[place[row], place[column]] = matrix[place[column], place[row]] = value
    # No entry of an orthogonal projector is larger than one; NaN fails as well.
    if not (np.abs(matrix) < 1.0 + 1e-6).all():
        raise StoredAnswerError("an entry of a projector is larger than 1")
    return Kept(labels, matrix)


def _checked_labels(names: Iterable[str]) -> tuple[str, ...]:
    """Each label once."""
    labels = tuple(dict.fromkeys(names))
    if wrong := [name for name in labels if not re.fullmatch(r"\d+:\w+", name)]:
        raise StoredAnswerError(f"{wrong[0]!r} is no label")
    return labels


def differences(
    stored: StoredAnswer, found: StoredAnswer, within: tuple[float, float] = WITHIN
) -> tuple[str, ...]:
    """What differs from a stored answer, a sentence each; empty where nothing does."""
    return (
        *_in_counts(stored, found),
        *_in_singular_values(stored, found, within[0]),
        *_in_subspaces("motions", "node", stored.motions, found.motions, within[1]),
        *_in_subspaces(
            *("self-stresses", "element", stored.self_stresses, found.self_stresses, within[1])
        ),
    )


def _in_counts(stored: StoredAnswer, found: StoredAnswer) -> Iterator[str]:
    if stored.verdict != found.verdict:
        yield f"verdict: {found.verdict}, stored as {stored.verdict}"
    for name in NUMBERS:
        if stored.numbers[name] != found.numbers[name]:
            words = name.replace("_", " ")
            yield f"{words}: {found.numbers[name]}, stored {stored.numbers[name]}"
    before, now = (
        {(kind, name): n for kind, part in each.counts.items() for name, n in part.items()}
        for each in (stored, found)
    )
    for kind, name in sorted({*before, *now}):
        if before.get((kind, name)) != now.get((kind, name)):
            yield f"{name} {kind}: {now.get((kind, name))}, stored {before.get((kind, name))}"


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


def _in_subspaces(
    name: str, owner: str, stored: Kept | None, found: Kept | None, within: float
) -> Iterator[str]:
    if stored is None or found is None:
        return
    labels = tuple(dict.fromkeys((*stored.labels, *found.labels)))
    both = stored.is_whole and found.is_whole
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


def _compared(kept: Kept, labels: tuple[str, ...], as_projectors: bool) -> FloatArray:
    """(labels, ...) a projector, or its images of the fixed vectors; zeros at other labels."""
    index = {label: k for k, label in enumerate(labels)}
    place = [index[label] for label in kept.labels]
    made = np.zeros((len(labels), len(labels) if as_projectors else VECTORS))
    made[np.ix_(place, place) if as_projectors else place] = (
        kept.values if as_projectors else kept.images()
    )
    return made


def _taking_part(kept: Kept) -> set[int]:
    """Numbers of what reaches into the subspace, as far as what is kept tells."""
    shares = np.diag(kept.values) if kept.is_whole else (kept.values**2).sum(axis=1)
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


class State(Enum):
    """What came of a deck, as it is counted."""

    AS_STORED = "as stored"
    DIFFERENT = "different"
    FAILED = "failed"
    MISSING = "without a stored answer"
    STORED = "stored"


@dataclass(frozen=True)
class Comparison:
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

    @property
    def reasons(self) -> list[str]:
        """Why a deck wants attention, a line each; the first says most."""
        lines: Sequence[str] = self.differences
        if self.error is not None:
            words = "not enough memory" if isinstance(self.error, MemoryError) else ""
            lines = (str(self.error) or words or repr(self.error)).splitlines()
        return [harmless(line) for line in lines]


def answer_place(deck: DeckFile, answers: Path) -> Path:
    """Where the stored answer of a deck stands, in the folder of all."""
    stem = answers / deck.relative
    return stem.with_name(f"{stem.name}.json")


#: The name of a deck, its text and that of its stored answer, or why they cannot be read, and
#: where the answer stands.
Case = tuple[str, bytes | FlexactError, bytes | FlexactError, Path]


def case_of(deck: DeckFile, answers: Path) -> Case:
    """A deck and its stored answer in the folder of all, as they stand in files."""
    place = answer_place(deck, answers)
    text: bytes | FlexactError
    stored: bytes | FlexactError
    try:
        text = deck_bytes(deck)
    except DeckError as error:
        text = error
    try:
        stored = answer_bytes(place)
    except StoredAnswerError as error:
        stored = error
    return deck.name, text, stored, place


def finding_of(
    case: Case,
    method: str,
    tolerance: float | None = None,
    stores: bool = False,
    watch: Callable[[ModelData], Progress | None] = lambda model: None,
) -> Comparison:
    """What comes of a deck.

    Args:
        case: The deck and its stored answer.
        method: How D(c) is decomposed.
        tolerance: How far answers may lie apart; None: as `WITHIN` says.
        stores: Whether what is new or differs is to be stored.
        watch: Called with the model before it is analysed; gives what is to be told of the
            progress.
    """
    start = time.perf_counter()
    try:
        finding = _found(case, method, tolerance, stores, watch)
    except MissingAnswerError as error:
        finding = Comparison(State.MISSING, error=error)
    except (FlexactError, MemoryError) as error:
        finding = Comparison(State.FAILED, error=error)
    except Exception as error:
        # One deck over which this program stumbles shall not cost the others.
        finding = Comparison(State.FAILED, error=AnalysisError(why(error)))
    return replace(finding, seconds=time.perf_counter() - start)


def _found(
    case: Case,
    method: str,
    tolerance: float | None,
    stores: bool,
    watch: Callable[[ModelData], Progress | None],
) -> Comparison:
    name, text, kept, place = case
    model = read_bytes(_given(text), name)
    stored: StoredAnswer | None = None
    try:
        stored = answer_in(_given(kept), place)
    except StoredAnswerError:
        if not stores:
            raise
    now = answer_of(result_of(model, asked_for(method, None), name, watch(model)))
    within = WITHIN if tolerance is None else (tolerance, tolerance)
    found = () if stored is None else differences(stored, now, within)
    if stored is not None and not found:
        return Comparison(State.AS_STORED)
    if stores:
        return Comparison(State.STORED, found, text=text_of(now))
    assert stored is not None
    gravity = int(stored.numbers != now.numbers or stored.counts != now.counts)
    return Comparison(State.DIFFERENT, found, 2 if stored.verdict != now.verdict else gravity)


def _given(text: bytes | FlexactError) -> bytes:
    if isinstance(text, FlexactError):
        raise text
    return text
