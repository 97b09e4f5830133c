# SPDX-License-Identifier: BSD-3-Clause
"""What is kept of a result to say how the next one differs: small, and the same in any process."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import islice
from typing import Any, TypeVar

from ...analysis.mode_words import conflict_in_words, motion_in_parts, stress_in_parts
from ...analysis.naming import Pieces
from ...analysis.result import Motion, Result, SelfStress
from ...analysis.verdict import Certainty
from ...analysis.verdict_words import margin_in_short, verdict_in_short
from ...util.partial import attempted

Mode = TypeVar("Mode", Motion, SelfStress)
#: How many motions, and how many self-stresses, are compared.
MOST_COMPARED = 12
#: How many parts of each are compared.
_PARTS = 6


@dataclass(frozen=True)
class Told:
    """What a person is told of a result.

    Attributes:
        verdict: Such as "over-constrained by 1", with what it is restricted by.
        counts: Numbers by what they count, such as "released deformations".
        margin: Such as "margin 0.3 mm".
        is_doubtful: Whether the rank is.
        motions: Each of the first motions in words.
        stresses: Each of the first self-stresses in words.
    """

    verdict: str
    counts: dict[str, int]
    margin: str
    is_doubtful: bool
    motions: tuple[str, ...]
    stresses: tuple[str, ...]


def told_of(result: Result) -> Told:
    """What is told of a result."""
    coordinates, deformations = result.counts
    given = result.given.arrays
    counts = {
        "elements": int(given.element_number.size),
        "nodes": int(given.node_number.size),
        "fixed coordinates": coordinates.fixed,
        "released deformations": deformations.dependent,
        "declared degrees of freedom": result.degrees_of_freedom,
        "motions": result.under_constrained,
        "self-stresses": result.over_constrained,
    }
    return Told(
        verdict_in_short(result),
        counts,
        margin_in_short(result),
        result.certainty is not Certainty.CERTAIN,
        _each(_motion, result.motions),
        _each(_stress, result.self_stresses),
    )


def _each(words: Callable[[Mode], str], modes: Iterable[Mode]) -> tuple[str, ...]:
    """The first ones in words; none where that fails, as the verdict is told all the same."""
    some = islice(modes, MOST_COMPARED)
    return attempted("", lambda: tuple(map(words, some)), (), None)


def _motion(motion: Motion) -> str:
    return _words(motion_in_parts(motion, _PARTS)[:_PARTS])


def _stress(stress: SelfStress) -> str:
    return _words((conflict_in_words(stress), *stress_in_parts(stress, _PARTS)[:_PARTS]))


def _words(parts: Iterable[Pieces]) -> str:
    return "; ".join("".join(map(str, pieces)) for pieces in parts)


@dataclass(frozen=True)
class Job:
    """What a worker is asked for.

    Attributes:
        path: The deck or the script.
        is_script: Which of them it is.
        decision: Arguments of `flexact.analysis.decomposition.asked_for`.
    """

    path: str
    is_script: bool
    decision: tuple[Any, ...] = ("auto", None)


@dataclass(frozen=True)
class Printed:
    """What a script has printed."""

    text: str


@dataclass(frozen=True)
class Judged:
    """What is told of a result whose scene is still being made."""

    told: Told


@dataclass(frozen=True)
class Shown:
    """A result as the page shows it.

    Attributes:
        title: Of the page, as text.
        body: What stands within its body.
        told: What is told of the result.
        which: Which model of a script it is, in words; empty for a deck.
        problems: Warnings and notes, as the terminal has them.
        files: What it was made of, besides the file that is watched.
        result: The result itself, pickled.
        model: The name of the model in a script; empty for a deck.
    """

    title: str
    body: str
    told: Told
    which: str
    problems: str
    files: tuple[str, ...]
    result: bytes = b""
    model: str = ""


@dataclass(frozen=True)
class Broken:
    """Why there is no result.

    Attributes:
        title: Of the page, as text.
        errors: As HTML.
        body: What stands within the body of a page that has nothing else to show.
        words: As the terminal has them.
        files: As in `Shown`.
    """

    title: str
    errors: str
    body: str
    words: str
    files: tuple[str, ...]


Answer = Shown | Broken
