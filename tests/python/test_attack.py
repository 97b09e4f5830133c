# SPDX-License-Identifier: BSD-3-Clause
"""A little of the standing attack, tests/attack: no wrong count is called certain.

Exact counts come from the decimals of the decks, in arithmetic that rounds nothing.
"""

import json
import math
import sys
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from reference_decks import NAMES, REFERENCE, ROOT, text_of

sys.path.append(str(Path(__file__).resolve().parents[1]))

from attack.exact_deck import Deck, read
from attack.exact_rows import rows_of
from attack.families import FAMILIES, Case, case_of
from attack.judge import OFFENCES, UNPROVED, Answer, Judgement, judge, methods
from attack.truth import Counts, counts_of_text, is_prime, primes

import flexact
from flexact.core.arrays import FloatArray

pytestmark = pytest.mark.dear(100)

SEED = 2024
#: Of each family; all methods together take about 15 s.
DECKS = 40

#: Families in which the claim does not hold today: a wrong count is called certain, or an answer
#: that is not certain lacks the truth.
TODAY: dict[Judgement, tuple[str, ...]] = {
    Judgement.WRONG: (),
    Judgement.MISSING: (),
    Judgement.UNLIKE: (),
}
#: Decks whose digits do not close, as irrational numbers stand in them: what is typed.
NOT_AS_MEANT = {
    "frameworks/k33_circle": (0, 0),
    "linkages/bennett": (0, 2),
    "paper/five_folded_sheets_symmetric": (0, 0),
}


@cache
def cases(family: str) -> tuple[Case, ...]:
    return tuple(case_of(family, SEED, number) for number in range(DECKS))


@cache
def answers(family: str, method: str) -> tuple[Answer, ...]:
    return tuple(judge(case, (method,)).answers[method] for case in cases(family))


def offending(family: str, method: str, offence: Judgement) -> list[str]:
    return [
        f"{case.name}: {answer.words}, but typed {case.typed}"
        for case, answer in zip(cases(family), answers(family, method), strict=True)
        if answer.judgement is offence
    ]


def claims() -> list[object]:
    """Of each family, side by side so that a worker keeps the answers, marked where they fail."""
    mark = pytest.mark.xfail(strict=True, reason="the claim does not hold yet")
    return [
        pytest.param(family, method, offence, marks=[mark] * (family in TODAY[offence]))
        for family in FAMILIES
        for method in methods()
        for offence in OFFENCES
    ]


@pytest.mark.grid
@pytest.mark.parametrize(("family", "method", "offence"), claims())
def test_no_answer_offends(family: str, method: str, offence: Judgement) -> None:
    """No wrong count is called certain, and what is not certain has the truth among it."""
    assert offending(family, method, offence) == []


@pytest.mark.grid
@pytest.mark.parametrize("method", methods())
@pytest.mark.parametrize(
    "path", sorted((ROOT / "tests/attack/decks").glob("*.dat")), ids=lambda path: path.stem
)
def test_decks_that_once_offended(path: Path, method: str) -> None:
    """The exact counts are given, or among the alternatives, also of what is certain."""
    text = path.read_text(encoding="utf-8")
    case = Case(path.stem, text, counts_of_text(text), None, math.inf)
    answer = judge(case, (method,)).answers[method]
    assert answer.judgement not in OFFENCES, answer.words
    assert str(tuple(case.typed)) in answer.words or (
        path.stem == "long_whole_numbers" and method in UNPROVED
    )


@pytest.mark.parametrize("family", ["long-digits", "mirrored", "levers", "far-whole"])
def test_exact_counts_stand_beside_certain_ones(family: str) -> None:
    """Where arithmetic of the numbers to the last digit says otherwise."""
    otherwise = 0
    for case in cases(family):
        analysis = flexact.analyse(flexact.read_text(case.text))
        proof = analysis.proof
        if proof is None or proof.rank == analysis.rank:
            continue
        otherwise += analysis.certainty is flexact.Certainty.CERTAIN
        exact = analysis.columns - proof.rank, analysis.rows - proof.rank
        offered = [each[:2] for each in analysis.alternatives]
        assert exact in offered, case.name
        assert (analysis.nearly is None) == (analysis.certainty is flexact.Certainty.CERTAIN)
        told = json.loads(analysis.to_json())["alternatives"]
        assert [(each["under_constrained"], each["over_constrained"]) for each in told] == offered
    assert otherwise or family not in ("long-digits", "mirrored")


# The truth itself


@pytest.mark.parametrize("name", NAMES)
def test_exact_counts_of_known_decks(name: str) -> None:
    stored = json.loads((REFERENCE / f"{name}.json").read_text(encoding="utf-8"))
    known = Counts(stored["under_constrained"], stored["over_constrained"])
    assert counts_of_text(text_of(name)) == NOT_AS_MEANT.get(name, known)


@pytest.mark.parametrize("name", NAMES)
def test_rows_of_decks_are_parallel_to_those_of_the_core(name: str) -> None:
    assert_rows_are_parallel(text_of(name))


def test_rows_of_mixed_elements_are_parallel_to_those_of_the_core() -> None:
    """Of every kind, at points of whole numbers before they are scaled and turned."""
    seen: set[str] = set()
    for number in range(300):
        text = case_of("mixed", SEED, number).text
        deck = read(text)
        if is_compact(deck):
            assert_rows_are_parallel(text)
            seen |= {element.keyword for element in deck.elements.values()}
    assert len(seen) == 10


def is_compact(deck: Deck) -> bool:
    """Whether no digits are lost in the differences of places."""
    reach = max((abs(float(x)) for place in deck.places.values() for x in place), default=0.0)
    chords = [max(abs(float(p)) for p in deck.chord(e)) for e in deck.elements.values()]
    return all(chord == 0 or chord > 1e-3 * reach for chord in chords)


def assert_rows_are_parallel(text: str) -> None:
    """Each exact row, of all coordinates, and the core's; rotations times the element's size."""
    deck = read(text)
    found = flexact.jacobian(flexact.read_text(text))
    whole = found.toarray()
    axis_of = {name: k % 3 for k, name in enumerate(("x", "y", "z", "rx", "ry", "rz"))}
    place = {(node, axis_of[name]): k for k, (node, name) in enumerate(found.column_labels)}
    turns = np.array([name.startswith("r") for _, name in found.column_labels])
    row_of = {label: k for k, label in enumerate(found.row_labels)}
    deck.released.clear()
    for label, nodes, blocks in rows_of(deck, lambda number: number):
        exact = np.zeros(whole.shape[1])
        for node, block in zip(nodes, blocks, strict=True):
            for axis, value in enumerate(block):
                if value:
                    exact[place[node, axis]] += float(value)
        size = max(abs(float(part)) for part in deck.chord(deck.elements[label[0]])) or 1.0
        scale = np.where(turns, 1.0 / size, 1.0)
        assert is_parallel(exact * scale, whole[row_of[label]] * scale), label


def is_parallel(a: FloatArray, b: FloatArray) -> bool:
    largest = int(np.argmax(np.abs(a)))
    if a[largest] == 0:
        return not b.any()
    return bool(np.all(np.abs(a - b * (a[largest] / b[largest])) <= 1e-10 * np.abs(a[largest])))


def test_primes_are_primes() -> None:
    assert [n for n in range(39, 200, 2) if is_prime(n)] == [
        n for n in range(39, 200) if all(n % k for k in range(2, 15))
    ]
    assert is_prime(2**61 - 1)
    assert not is_prime(3215031751)
    assert all(2**60 < prime < 2**61 for prime in primes())
