"""What differs between two answers, in words, whatever sign, order or basis they came in."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from .exchange import FloatArray
from .stored_answer import NUMBERS, Projector, StoredAnswer

MOST_NAMED = 6

# A node or element takes part in a subspace where its share of it is longer than this. Entries
# below 1e-14 are not stored, so that shares below 1e-7 cannot be told from zero.
TAKES_PART = 1e-6


@dataclass(frozen=True)
class Tolerances:
    """How far answers may lie apart.

    Attributes:
        singular_values: Largest difference, as a fraction of the largest singular value.
        projectors: Largest difference of an entry of a projector.
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
        *_in_singular_values(stored.singular_values, found.singular_values, tolerances),
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
    stored: FloatArray, found: FloatArray, tolerances: Tolerances
) -> Iterator[str]:
    if len(stored) != len(found):
        yield f"singular values: {len(found)}, stored {len(stored)}"
        return
    if not len(stored):
        return
    apart = np.abs(stored - found)
    largest = float(np.max(np.abs(stored), initial=0.0))
    wrong = ~(apart <= tolerances.singular_values * largest)
    if wrong.any():
        k = int(np.argmax(apart))
        yield (
            f"singular values: {int(wrong.sum())} of {len(stored)} differ; the largest difference "
            f"is in number {k + 1}: {float(found[k])!r}, stored {float(stored[k])!r}"
        )


def _in_subspaces(
    name: str, owner: str, stored: Projector, found: Projector, tolerances: Tolerances
) -> Iterator[str]:
    labels = tuple(dict.fromkeys((*stored.labels, *found.labels)))
    before, now = _spread(stored, labels), _spread(found, labels)
    apart = float(np.max(np.abs(before - now), initial=0.0))
    if apart <= tolerances.projectors:
        return
    dimensions = round(float(np.trace(before))), round(float(np.trace(now)))
    if dimensions[0] == dimensions[1]:
        angle = math.degrees(math.asin(min(1.0, float(np.linalg.norm(before - now, 2)))))
        what = f"the subspace turned by {angle:.2g} degrees"
    else:
        what = f"{dimensions[1]}, stored {dimensions[0]}"
    yield "; ".join((f"{name}: {what}", *_who(owner, labels, before, now)))


def _spread(projector: Projector, labels: tuple[str, ...]) -> FloatArray:
    place = {label: k for k, label in enumerate(labels)}
    index = [place[label] for label in projector.labels]
    matrix = np.zeros((len(labels), len(labels)))
    matrix[np.ix_(index, index)] = projector.matrix
    return matrix


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


def _taking_part(labels: tuple[str, ...], projector: FloatArray) -> set[int]:
    share = np.diag(projector) > TAKES_PART**2
    return {int(label.split(":")[0]) for label, used in zip(labels, share, strict=True) if used}
