# SPDX-License-Identifier: BSD-3-Clause
"""What differs between two answers, in words, whatever sign, order or basis they came in."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ...core.arrays import FloatArray
from .projections import Images, fixed_vectors
from .stored_answer import NUMBERS, Kept, Projector, StoredAnswer

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
