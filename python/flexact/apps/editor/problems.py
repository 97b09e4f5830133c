# SPDX-License-Identifier: BSD-3-Clause
"""The verdict on a deck, in a line, and steps that mend it; both take a while."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ...analysis.decomposition import Asked
from ...analysis.mode_words import conflict_in_words, stress_in_parts
from ...analysis.motions import internal_in_words, motion_in_parts
from ...analysis.result import Result, result_of
from ...analysis.sentences import Named, Pieces, plain
from ...analysis.text_margin import margin_in_short, verdict_in_short
from ...analysis.verdict import Verdict
from ...analysis.warnings import warnings_of
from ...model.data import ModelData
from ...util.errors import FlexactError
from ...util.plain_text import harmless
from .advisor import Advice, Advisor
from .deck import Key
from .document import Range
from .editor_deck import Deck
from .editor_problems import Remark, first_line

#: Motions, and self-stresses, that are said one by one, and what takes part in each.
_MOST, _PARTS = 4, 4
#: Elements up to which steps are looked for.
LARGEST_FOR_STEPS = 1500


@dataclass(frozen=True, eq=False)
class Opinion:
    """What an analysis says.

    Attributes:
        words: Such as "over-constrained by 1; margin 12 um"; why there is none where the
            analysis failed.
        verdict: The verdict; None where there is none.
        remarks: Motions, self-stresses and doubts, at the elements and nodes that take part.
        result: The result; None where there is none.
    """

    words: str
    verdict: Verdict | None
    remarks: tuple[Remark, ...] = ()
    result: Result | None = None


def opinion_on(deck: Deck) -> Opinion | None:
    """The verdict on a deck; None where it has errors."""
    data = deck.data
    if data is None:
        return None
    try:
        result = _analysed(data)
        return Opinion(
            f"{verdict_in_short(result)}; {margin_in_short(result)}",
            result.verdict,
            tuple(_remarks(deck, result)),
            result,
        )
    except (FlexactError, MemoryError) as error:
        return Opinion(f"no verdict: {harmless(str(error)).splitlines()[0]}", None)


def _analysed(data: ModelData) -> Result:
    made: Result = result_of(data, Asked(), "deck", None, Result)
    return made


def advice_on(opinion: Opinion, advisor: Advisor) -> Advice | None:
    """Steps that mend the mechanism; None where nothing is to be mended, or it is too large."""
    result = opinion.result
    if result is None or result.verdict is Verdict.EXACT:
        return None
    if result.given.arrays.element_number.size > LARGEST_FOR_STEPS:
        return None
    try:
        advice = advisor(result)
        _ = advice.steps
    except (FlexactError, MemoryError):
        return None
    return advice


def _remarks(deck: Deck, result: Result) -> list[Remark]:
    made = []
    internal = internal_in_words(result)
    motions = [one for one in result.motions if not (internal and one.is_internal)]
    for number, motion in enumerate(motions[:_MOST], start=1):
        moving = _listed(motion_in_parts(motion, _PARTS))
        made.append(_remark(deck, f"motion {number}: ", moving, moving))
    if internal:
        made.append(Remark(first_line(deck.document), internal))
    for number, stress in enumerate(result.self_stresses[:_MOST], start=1):
        carried = _listed(stress_in_parts(stress, _PARTS))
        words = conflict_in_words(stress) or carried
        made.append(_remark(deck, f"self-stress {number}: ", words, carried))
    known = len(result.data.problems.kept)
    for item in warnings_of(result)[known:]:
        made.append(Remark(first_line(deck.document), harmless(item.message)))
    return made


def _listed(parts: Sequence[Pieces]) -> Pieces:
    """Several pieces as one list."""
    apart = [piece for one in parts for piece in ("; ", *one)]
    return tuple(apart[1:])


def _remark(deck: Deck, head: str, words: Pieces, carried: Pieces) -> Remark:
    """A remark where the first of what takes part stands."""
    named = next((piece for piece in (*carried, *words) if isinstance(piece, Named)), None)
    where: list[Range] = []
    if named is not None:
        key: Key = (named.kind, named.number)
        where = deck.index.definition(key)
    return Remark(where[0] if where else first_line(deck.document), f"{head}{plain(words)}")
