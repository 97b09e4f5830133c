"""Stored answers: what is kept of an analysis to compare later ones with.

A stored answer keeps what does not depend on the sign, order or basis that a decomposition
happens to choose: verdict, counts, rank, singular values, and the two null spaces of D(c) as
orthogonal projectors V V' and U U'.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from . import __version__
from .analysis import Analysis
from .batch import BatchError, reason_of
from .exchange import FloatArray
from .modes import Motion, SelfStress

FORMAT = 1
SMALLEST_ENTRY = 1e-14
NUMBERS = ("rank", "rows", "columns", "under_constrained", "over_constrained", "degrees_of_freedom")


class StoredAnswerError(BatchError):
    """A stored answer is missing or cannot be understood."""


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


@dataclass(frozen=True)
class StoredAnswer:
    """What is kept of an analysis.

    Attributes:
        deck: The deck's name.
        source: Where the numbers come from.
        verdict: The verdict in words.
        numbers: rank, rows, columns, under_constrained, over_constrained, degrees_of_freedom.
        counts: By ``coordinates`` and ``deformations``, then by class.
        singular_values: Of D(c), descending, (min(rows, columns),).
        motions: Projector onto the null space of D(c).
        self_stresses: Projector onto the null space of its transpose.
    """

    deck: str
    source: str
    verdict: str
    numbers: Mapping[str, int]
    counts: Mapping[str, Mapping[str, int]]
    singular_values: FloatArray
    motions: Projector
    self_stresses: Projector


def answer_of(analysis: Analysis) -> StoredAnswer:
    """What is kept of an analysis."""
    return StoredAnswer(
        deck=analysis.name,
        source=f"flexact {__version__}",
        verdict=analysis.verdict.value,
        numbers={name: int(getattr(analysis, name)) for name in NUMBERS},
        counts={name: part._asdict() for name, part in analysis.counts._asdict().items()},
        singular_values=analysis.singular_values,
        motions=_project(analysis.column_labels, analysis.motions),
        self_stresses=_project(analysis.row_labels, analysis.self_stresses),
    )


def _project(
    labels: Sequence[tuple[int, int | str]], modes: Sequence[Motion | SelfStress]
) -> Projector:
    basis = np.array([mode.vector for mode in modes]).reshape(len(modes), len(labels))
    used = np.flatnonzero(np.any(basis != 0.0, axis=0))
    part = basis[:, used]
    names = tuple(f"{labels[k][0]}:{labels[k][1]}" for k in used.tolist())
    return Projector(names, part.T @ part)


def text_of(answer: StoredAnswer) -> str:
    """The text of a stored answer: JSON, an entry of a projector a line, numbers exact."""
    content: dict[str, Any] = {"format": FORMAT, "deck": answer.deck, "source": answer.source}
    content |= {"verdict": answer.verdict, **answer.numbers, "counts": answer.counts}
    content["singular_values"] = answer.singular_values.tolist()
    lines = [f"{json.dumps(key)}: {json.dumps(value)}" for key, value in content.items()]
    for name, projector in (("motions", answer.motions), ("self_stresses", answer.self_stresses)):
        entries = ",".join(f"\n      {json.dumps(entry)}" for entry in _triangle(projector))
        end = "\n    " if entries else ""
        lines.append(f'"{name}": {{\n    "projector": [{entries}{end}]\n  }}')
    return "{\n  " + ",\n  ".join(lines) + "\n}\n"


def _triangle(projector: Projector) -> list[tuple[str, str, float]]:
    kept = np.triu(np.abs(projector.matrix) > SMALLEST_ENTRY)
    names, matrix = projector.labels, projector.matrix
    return [(names[i], names[k], float(matrix[i, k])) for i, k in np.argwhere(kept).tolist()]


def read_answer(path: Path) -> StoredAnswer:
    """Read a stored answer.

    Raises:
        StoredAnswerError: The file is missing, is not of this format, or lacks something.
    """
    try:
        return _understood(json.loads(path.read_text(encoding="utf-8")))
    except FileNotFoundError:
        raise StoredAnswerError(f"{path}: no stored answer; --store makes one") from None
    except OSError as error:
        raise StoredAnswerError(f"{path}: cannot be read: {reason_of(error)}") from error
    except StoredAnswerError as error:
        raise StoredAnswerError(f"{path}: not a stored answer of flexact: {error}") from error
    except (ValueError, TypeError, AttributeError, OverflowError, RecursionError) as error:
        raise StoredAnswerError(f"{path}: not a stored answer of flexact") from error
    except KeyError as error:
        message = f"{path}: not a stored answer of flexact: {error} is missing"
        raise StoredAnswerError(message) from error


def _understood(content: dict[str, Any]) -> StoredAnswer:
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
        motions=_assemble(content["motions"]["projector"]),
        self_stresses=_assemble(content["self_stresses"]["projector"]),
    )


def _assemble(triangle: Sequence[tuple[str, str, float]]) -> Projector:
    labels = tuple(dict.fromkeys(name for row, column, _ in triangle for name in (row, column)))
    if wrong := [name for name in labels if not re.fullmatch(r"\d+:\w+", name)]:
        raise StoredAnswerError(f"{wrong[0]!r} is no label")
    place = {name: k for k, name in enumerate(labels)}
    matrix = np.zeros((len(labels), len(labels)))
    for row, column, value in triangle:
        matrix[place[row], place[column]] = matrix[place[column], place[row]] = value
    # No entry of an orthogonal projector is larger than one; NaN fails as well.
    if not (np.abs(matrix) < 1.0 + 1e-6).all():
        raise StoredAnswerError("an entry of a projector is larger than 1")
    return Projector(labels, matrix)
