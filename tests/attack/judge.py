# SPDX-License-Identifier: BSD-3-Clause
"""What Flexact says of a deck, held against its exact counts."""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from enum import Enum
from typing import NamedTuple

import numpy as np

import flexact
from flexact.analysis.verdict_words import certainty_word
from flexact.core.arrays import FloatArray
from flexact.core.elements import Class

from .deck_text import has_long_numbers
from .exact_deck import read
from .families import Case
from .storing import explains
from .truth import Counts

#: The methods under attack; the last leaves out the proof, where there is one to leave out.
METHODS = ("auto", "svd", "jacobi", "sparse")
#: The methods that are also tried without proofs.
UNPROVED = {"auto, unproved": "auto", "sparse, unproved": "sparse"}
CAN_PROVE = "prove" in inspect.signature(flexact.analyse).parameters
#: A doubt is without need where the smallest value is this many times what rounding makes.
_FAR_ABOVE = 1000.0
#: A decimal of so many digits is told from any other by its double.
_DECIMALS = 15


class Judgement(str, Enum):
    """How an answer stands to the truth, the best first."""

    RIGHT = "certain, right"
    MEANT = "certain of what is meant, not typed"
    TYPED = "certain as typed, meant otherwise"
    STORED = "certain within what storing the numbers explains"
    GIVEN = "doubtful, truth given"
    OFFERED = "doubtful, truth offered"
    NEEDLESS = "doubtful without need"
    MISSING = "doubtful, truth missing"
    WRONG = "certain, wrong"
    UNLIKE = "other in other units"
    REFUSED = "refused"


#: What the claim forbids.
OFFENCES = (Judgement.WRONG, Judgement.MISSING, Judgement.UNLIKE)


class Answer(NamedTuple):
    """What is said of a deck."""

    judgement: Judgement
    words: str
    """The counts, what else is offered, and why."""


class Judged(NamedTuple):
    """A deck with what every method says of it."""

    case: Case
    answers: dict[str, Answer]
    numpy_is_wrong: bool
    """Whether dgesdd and numpy's rule count otherwise than the truth, on D(c) as it stands."""


def methods() -> tuple[str, ...]:
    """All that this version of the package offers."""
    return (*METHODS, *UNPROVED) if CAN_PROVE else METHODS


def judge(case: Case, chosen: tuple[str, ...]) -> Judged:
    """What the methods chosen say, and what numpy says."""
    try:
        model = flexact.read_text(case.text)
        plain = numpy_counts(model)
    except flexact.FlexactError as error:
        refused = Answer(Judgement.REFUSED, str(error).splitlines()[0])
        return Judged(case, dict.fromkeys(chosen, refused), False)
    answers = {method: _answered(case, model, method) for method in chosen}
    return Judged(case, answers, plain not in case.truths)


def _answered(case: Case, model: flexact.Model, method: str) -> Answer:
    try:
        analysis = _analysed(model, method)
        answer = _answer(case, analysis)
        for text in case.alike:
            other = _analysed(flexact.read_text(text), method)
            if unlike := _differences(analysis, other, method not in UNPROVED):
                return Answer(Judgement.UNLIKE, f"{answer.words}; {unlike} in another unit")
        return answer
    except flexact.AnalysisError as error:
        return Answer(Judgement.REFUSED, str(error).splitlines()[0])


def numpy_counts(model: flexact.Model) -> Counts:
    """By numpy's rule, max(m, n) eps sigma_1, on D(c) in the deck's units."""
    matrix = dense_jacobian(model)
    rows, columns = matrix.shape
    rank = int(np.linalg.matrix_rank(matrix)) if matrix.size else 0
    return Counts(columns - rank, rows - rank)


def dense_jacobian(model: flexact.Model) -> FloatArray:
    """D(c): deformations that are not released, coordinates that are dependent."""
    whole = flexact.jacobian(model)
    arrays = model.data.arrays
    rows, columns = arrays.deformation_class.T.ravel(), arrays.coordinate_class.T.ravel()
    dependent = int(Class.DEPENDENT)
    kept_rows = rows[rows != int(Class.NONE)] != dependent
    kept_columns = columns[columns != int(Class.NONE)] == dependent
    kept: FloatArray = whole.toarray()[kept_rows][:, kept_columns]
    return kept


def _analysed(model: flexact.Model, method: str) -> flexact.Analysis:
    if method in UNPROVED:
        unproved = {"method": UNPROVED[method], "prove": False}
        return flexact.analyse(model, **unproved)  # type: ignore[arg-type]
    return flexact.analyse(model, method=method)


def _answer(case: Case, analysis: flexact.Analysis) -> Answer:
    given = Counts(analysis.under_constrained, analysis.over_constrained)
    offered = tuple(_offered(analysis))
    certain = analysis.certainty is flexact.Certainty.CERTAIN
    if certain:
        judgement = _certain(case, given, offered)
    else:
        judgement = _doubtful(case, given, offered, analysis)
    doubts = getattr(getattr(analysis, "assessment", None), "doubts", ())
    codes = sorted({str(doubt.code) for doubt in doubts})
    words = f"{'certain' if certain else 'nearly'} {tuple(given)}"
    if offered:
        words += f", offered {[tuple(each) for each in offered]}"
    return Answer(judgement, f"{words} {' '.join(codes)}".strip())


def _differences(one: flexact.Analysis, other: flexact.Analysis, proved: bool) -> str:
    """What is not the same of a deck in another unit, moved; rounding is not, without proofs."""
    same = {
        "counts": (one.under_constrained, one.over_constrained)
        == (other.under_constrained, other.over_constrained),
        "certainty": not proved or certainty_word(one) == certainty_word(other),
        "axes": np.allclose(one.data.frames.frame, other.data.frames.frame, atol=1e-9),
    }
    return ", ".join(name for name, holds in same.items() if not holds)


def _offered(analysis: flexact.Analysis) -> Iterator[Counts]:
    """Other counts that the analysis names."""
    others = (getattr(analysis, "nearly", None), *getattr(analysis, "alternatives", ()))
    for other in others:
        if other is not None:
            yield Counts(other.under_constrained, other.over_constrained)


def _certain(case: Case, given: Counts, offered: tuple[Counts, ...]) -> Judgement:
    if given not in case.truths:
        return Judgement.STORED if _is_stored(case, given, offered) else Judgement.WRONG
    if given != case.typed:
        return Judgement.MEANT
    silent = case.meant is not None and case.meant not in (given, *offered)
    return Judgement.TYPED if silent else Judgement.RIGHT


def _is_stored(case: Case, given: Counts, offered: tuple[Counts, ...]) -> bool:
    """Whether more values than are zero as typed are zero within the storing of the numbers.

    Numbers of more than 15 digits stand for the doubles that are read of them, theory.md (22);
    what is true to their last digit has to be offered.
    """
    deck = read(case.text)
    rank = len(deck.columns()) - given.under_constrained
    if given.under_constrained <= case.typed.under_constrained:
        return False
    if explains(deck, rank):
        return True
    is_told = has_long_numbers(case.text, _DECIMALS) and case.typed in offered
    return is_told and explains(deck.stored(), rank)


def _doubtful(
    case: Case, given: Counts, offered: tuple[Counts, ...], analysis: flexact.Analysis
) -> Judgement:
    if given in case.truths:
        agreed = case.meant in (None, case.typed)
        return Judgement.NEEDLESS if agreed and _is_clear(analysis) else Judgement.GIVEN
    return Judgement.OFFERED if set(offered) & set(case.truths) else Judgement.MISSING


def _is_clear(analysis: flexact.Analysis) -> bool:
    """Whether the smallest value that is not zero is far above what its digits may make."""
    pairs = getattr(analysis, "pairs", ())
    if not pairs:
        return False
    first = pairs[0]
    return bool(first.value > _FAR_ABOVE * max(first.lift_of_digits, first.lift_of_bits))
