# SPDX-License-Identifier: BSD-3-Clause
"""Stored answers: what is kept of an analysis to compare later ones with.

A stored answer keeps what does not depend on the sign, order or basis that a decomposition
happens to choose: verdict, counts, rank, singular values, and the two null spaces of D(c) as
orthogonal projectors V V' and U U'. Of a projector that is too large its images of a few fixed
vectors are kept, and nothing of a null space of which not all vectors are given.
"""

from __future__ import annotations

import json
import re
import zlib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...analysis.result import Result
from ...analysis.sparse_basis import support_of
from ...core.arrays import Basis, FloatArray
from ...model.data import column_labels, row_labels
from ...util.errors import BatchError, reason_of
from ...util.loading import VERSION

#: Number of the fixed vectors.
VECTORS = 3
#: When the equations of a projection count as solved, and how long that may take.
_SOLVED = 1.0e-14
_MOST_STEPS = 500


@dataclass(frozen=True)
class Images:
    """The images of the fixed vectors under an orthogonal projector.

    Attributes:
        labels: What each row is; labels that are left out stand for zeros.
        values: (labels, VECTORS).
    """

    labels: tuple[str, ...]
    values: FloatArray


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

    def combine(factors: FloatArray) -> FloatArray:
        sums = np.bincount(basis.place, basis.value * factors[of_entry], basis.size)
        return np.asarray(sums, np.float64)

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
            change = combine(direction)
            step = square / (change @ change)
            made[:, k] += step * change
            rest = rest - step * products(change)
            before, square = square, rest @ rest
            direction = rest + square / before * direction
    return made


FORMAT = 1
#: Projectors that reach more labels than this are kept by their images.
LARGEST_PROJECTOR = 1000
SMALLEST_ENTRY = 1e-14
NUMBERS = ("rank", "rows", "columns", "under_constrained", "over_constrained", "degrees_of_freedom")


class StoredAnswerError(BatchError):
    """A stored answer is missing or cannot be understood."""


class MissingAnswerError(StoredAnswerError):
    """There is no stored answer."""


@dataclass(frozen=True)
class Projector:
    """An orthogonal projector onto a subspace.

    Attributes:
        labels: What each row and column is, ``"<node>:<coordinate>"`` or
            ``"<element>:<deformation>"``; labels that are left out stand for zeros.
        matrix: The projector, symmetric, (labels, labels).
    """

    labels: tuple[str, ...]
    matrix: FloatArray


#: A subspace as it is kept; None where it is not known as a whole.
Kept = Projector | Images | None


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
        motions: Projector onto the null space of D(c).
        self_stresses: Projector onto the null space of its transpose.
    """

    deck: str
    source: str
    verdict: str
    numbers: Mapping[str, int]
    counts: Mapping[str, Mapping[str, int]]
    singular_values: FloatArray
    motions: Kept
    self_stresses: Kept


def answer_of(analysis: Result) -> StoredAnswer:
    """What is kept of an analysis."""
    arrays, raw = analysis.data.arrays, analysis.raw
    motions, stresses = support_of(raw.motions), support_of(raw.stresses)
    nodes = column_labels(arrays, raw.column_label[:, motions] - 1)
    elements = row_labels(arrays, raw.row_label[:, stresses] - 1)
    return StoredAnswer(
        deck=analysis.name,
        source=f"flexact {VERSION}",
        verdict=analysis.verdict.value,
        numbers={name: int(getattr(analysis, name)) for name in NUMBERS},
        counts={name: part._asdict() for name, part in analysis.counts._asdict().items()},
        singular_values=analysis.singular_values,
        motions=_kept(_within(raw.motions, motions), nodes, analysis.under_constrained),
        self_stresses=_kept(_within(raw.stresses, stresses), elements, analysis.over_constrained),
    )


def _within(basis: Basis, support: NDArray[np.integer]) -> Basis:
    """The same vectors without places at which all are zero."""
    place = np.searchsorted(support, basis.place).astype(np.int32)
    return basis._replace(size=support.size, place=place)


def _kept(basis: Basis, labels: Sequence[tuple[int, int | str]], dimension: int) -> Kept:
    if basis.vectors < dimension:
        return None
    names = tuple(f"{number}:{part}" for number, part in labels)
    if len(names) > LARGEST_PROJECTOR:
        return Images(names, project(basis, fixed_vectors(names)))
    vectors = basis.toarray()
    return Projector(names, vectors @ vectors.T)


def text_of(answer: StoredAnswer) -> str:
    """The text of a stored answer: JSON, an entry of a projector a line, numbers exact."""
    content: dict[str, Any] = {"format": FORMAT, "deck": answer.deck, "source": answer.source}
    content |= {"verdict": answer.verdict, **answer.numbers, "counts": answer.counts}
    content["singular_values"] = answer.singular_values.tolist()
    lines = [f"{json.dumps(key)}: {json.dumps(value)}" for key, value in content.items()]
    for name, kept in (("motions", answer.motions), ("self_stresses", answer.self_stresses)):
        lines.append(f'"{name}": {_text_of_subspace(kept)}')
    return "{\n  " + ",\n  ".join(lines) + "\n}\n"


def _text_of_subspace(kept: Kept) -> str:
    if kept is None:
        return "null"
    what = "projector" if isinstance(kept, Projector) else "images"
    rows: Iterable[Sequence[Any]]
    if isinstance(kept, Projector):
        there = np.argwhere(np.triu(np.abs(kept.matrix) > SMALLEST_ENTRY)).tolist()
        names, matrix = kept.labels, kept.matrix
        rows = ((names[i], names[k], float(matrix[i, k])) for i, k in there)
    else:
        pairs = zip(kept.labels, kept.values.tolist(), strict=True)
        rows = ((label, *values) for label, values in pairs)
    entries = ",".join(f"\n      {json.dumps(row)}" for row in rows)
    end = "\n    " if entries else ""
    return f'{{\n    "{what}": [{entries}{end}]\n  }}'


def read_answer(path: Path) -> StoredAnswer:
    """Read a stored answer.

    Raises:
        StoredAnswerError: The file is missing, is not of this format, or lacks something.
    """
    return answer_in(answer_bytes(path), path)


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


def _understood_subspace(kept: dict[str, Any] | None) -> Kept:
    if kept is None:
        return None
    return _listed(kept["images"]) if "images" in kept else _assemble(kept["projector"])


def _listed(rows: Sequence[Sequence[Any]]) -> Images:
    labels = _checked_labels(row[0] for row in rows)
    values = np.array([row[1:] for row in rows], np.float64).reshape(len(rows), -1)
    if values.shape != (len(labels), VECTORS) or not np.isfinite(values).all():
        raise StoredAnswerError(f"'images' is no list of labels with {VECTORS} finite numbers")
    return Images(labels, values)


def _checked_labels(names: Iterable[str]) -> tuple[str, ...]:
    """Each label once."""
    labels = tuple(dict.fromkeys(names))
    if wrong := [name for name in labels if not re.fullmatch(r"\d+:\w+", name)]:
        raise StoredAnswerError(f"{wrong[0]!r} is no label")
    return labels


def _assemble(triangle: Sequence[tuple[str, str, float]]) -> Projector:
    labels = _checked_labels(name for row, column, _ in triangle for name in (row, column))
    place = {name: k for k, name in enumerate(labels)}
    matrix = np.zeros((len(labels), len(labels)))
    for row, column, value in triangle:
        matrix[place[row], place[column]] = matrix[place[column], place[row]] = value
    # No entry of an orthogonal projector is larger than one; NaN fails as well.
    if not (np.abs(matrix) < 1.0 + 1e-6).all():
        raise StoredAnswerError("an entry of a projector is larger than 1")
    return Projector(labels, matrix)
