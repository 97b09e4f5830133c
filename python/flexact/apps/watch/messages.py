# SPDX-License-Identifier: BSD-3-Clause
"""What is kept of a result to say how the next one differs: small, and the same in any process."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import islice
from typing import Any

from ...analysis.mode_words import conflict_in_words, motion_in_parts, stress_in_parts
from ...analysis.naming import plain
from ...analysis.result import Motion, Result, SelfStress
from ...analysis.verdict import Certainty
from ...analysis.verdict_words import margin_in_short, verdict_in_short
from ...util.partial import attempted

#: How many motions, and how many self-stresses, are compared.
MOST_COMPARED = 12
#: How many parts of each are compared.
_PARTS = 6


@dataclass(frozen=True)
class ResultSummary:
    """A result in short, as the next one is compared with it.

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


def summary_of(result: Result) -> ResultSummary:
    """The summary of a result."""
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
    return ResultSummary(
        verdict_in_short(result),
        counts,
        margin_in_short(result),
        result.certainty is not Certainty.CERTAIN,
        # The verdict is told all the same where words of modes fail.
        attempted("", lambda: tuple(map(_motion, islice(result.motions, MOST_COMPARED))), (), None),
        attempted(
            "", lambda: tuple(map(_stress, islice(result.self_stresses, MOST_COMPARED))), (), None
        ),
    )


def _motion(motion: Motion) -> str:
    return "; ".join(map(plain, motion_in_parts(motion, _PARTS)[:_PARTS]))


def _stress(stress: SelfStress) -> str:
    parts = conflict_in_words(stress), *stress_in_parts(stress, _PARTS)[:_PARTS]
    return "; ".join(map(plain, parts))


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


#: What comes before an answer: what a script has printed, and the summary of a result whose scene
#: is still being made.
Before = str | ResultSummary


@dataclass(frozen=True)
class Shown:
    """A result as the page shows it.

    Attributes:
        title: Of the page, as text.
        body: What stands within its body.
        summary: Of the result.
        which: Which model of a script it is, in words; empty for a deck.
        problems: Warnings and notes, as the terminal has them.
        files: What it was made of, besides the file that is watched.
        result: The result itself, pickled.
        model: The name of the model in a script; empty for a deck.
    """

    title: str
    body: str
    summary: ResultSummary
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
