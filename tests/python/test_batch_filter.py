# SPDX-License-Identifier: BSD-3-Clause
"""Conditions on rows: what they mean, and that nothing else is a condition."""

import math
import random
from typing import Any

import pytest

from flexact.sweeps.batch import deck_columns, filter_of
from flexact.sweeps.columns import Column
from flexact.util.errors import BatchError

ROW = {
    "deck": "guides/five wires.dat",
    "verdict": "over-constrained",
    "under_constrained": 0,
    "over_constrained": 2,
    "rank": 10,
    "rows": 12,
    "columns": 10,
    "certainty": "numerically certain",
    "gap": 0.25,
    "largest_zero": math.nan,
    "smallest_singular_value": 1e-3,
    "condition_number": math.nan,
    "margin": math.inf,
    "margin_angle": 1e-4,
    "error": "",
    "seconds": 0.5,
}
ERROR_ROW = {
    **{name: math.nan for name in ROW},
    **{"deck": "a.dat", "verdict": "", "certainty": "", "rows": None, "error": "a.dat: no"},
}


def is_wanted(expression: str, row: dict[str, Any] = ROW) -> bool:
    return filter_of(expression, deck_columns("values"))(row)


@pytest.mark.parametrize(
    "expression",
    [
        "over_constrained > 0",
        "over_constrained",
        "  over_constrained   == 2 ",
        "not under_constrained",
        "0 < margin_angle < 2e-4",
        "rows > columns >= rank",
        "margin == inf",
        "margin > 1e300",
        "gap > -1",
        "gap > +0.2",
        "verdict == 'over-constrained'",
        'verdict != "exactly constrained"',
        "'over' in verdict and 'under' not in verdict",
        "'five wires' in deck",
        "over_constrained in (1, 2)",
        "verdict in ['over-constrained', 'under-constrained']",
        "rank not in {3}",
        "under_constrained > 0 or (over_constrained > 0 and not error)",
        "under_constrained > 0 and rank > 0 or over_constrained",
        "2 == over_constrained",
        "'a' < 'b'",
    ],
)
def test_true_of_the_row(expression: str) -> None:
    assert is_wanted(expression)
    assert not is_wanted(f"not ({expression})")


@pytest.mark.parametrize(
    "expression",
    [
        "under_constrained",
        "error",
        "gap < 0.25",
        "verdict == 'exactly constrained'",
        "rank in (1,)",
    ],
)
def test_false_of_the_row(expression: str) -> None:
    assert not is_wanted(expression)


@pytest.mark.parametrize(
    "expression",
    [
        "gap > 0",
        "gap <= 0",
        "gap == 0",
        "gap != 0",
        "gap",
        "rows",
        "rows in (0,)",
        "rows not in (0,)",
    ],
)
def test_nothing_compares_with_what_is_missing(expression: str) -> None:
    assert not is_wanted(expression, ERROR_ROW)
    assert is_wanted(f"{expression} or error", ERROR_ROW)


@pytest.mark.parametrize(
    ("expression", "said"),
    [
        ("over_constraind > 0", "did you mean over_constrained"),
        ("xyzzy > 0", "there are deck, verdict"),
        ("verdict > 0", "a text and 0 is a number"),
        ("rank == 'three'", "a number and 'three' is a text"),
        ("verdict == 'exact'", "no verdict 'exact'; there are 'exactly constrained'"),
        ("verdict in ('exact',)", "no verdict 'exact'"),
        ("rank is 3", "in place of is"),
        ("rank in 3", "behind in stands"),
        ("rank in (rows, 3)", "not the column rows"),
        ("3", "is no condition"),
        ("'text'", "is no condition"),
        ("", "is no condition"),
        ("rank >", "is no condition"),
        ("rank = 3", "is no condition"),
        ("rank > 1; rank", "is no condition"),
        ("rank + 1 > 2", "neither a column nor a value"),
        ("__import__('os').system('true')", "neither a column nor a value"),
        ("rank.real > 1", "neither a column nor a value"),
        ("().__class__ == 1", "neither a column nor a value"),
        ("[r for r in rank] == 1", "neither a column nor a value"),
        ("(lambda: 1) == 1", "neither a column nor a value"),
        ("f'{rank}' == '3'", "neither a column nor a value"),
        ("rank == 1j", "neither a column nor a value"),
        ("rank == None", "neither a column nor a value"),
        ("rank == True", "neither a column nor a value"),
        ("rank == b'3'", "neither a column nor a value"),
        ("-deck == 3", "neither a column nor a value"),
        ("(rank := 3) == 3", "neither a column nor a value"),
        ("rank\0 > 3", "is no condition"),
        ("(" * 5000 + "rank" + ")" * 5000, "is no condition"),
        ("not " * 1200 + "rank", "is no condition"),
        ("-" * 1900 + "1 < rank", "is no condition"),
        ("rank > 0 or " * 5000 + "rank", "is no condition"),
    ],
)
def test_what_is_no_condition_is_refused_in_words(expression: str, said: str) -> None:
    with pytest.raises(BatchError, match="--where") as refused:
        is_wanted(expression)
    assert said in str(refused.value)
    assert len(str(refused.value)) < 400


def test_a_column_that_is_not_wanted_says_how_to_have_it() -> None:
    with pytest.raises(BatchError, match="--columns values"):
        filter_of("margin > 0", deck_columns("verdict"))


def test_against_python_on_random_conditions() -> None:
    """What Python itself says of comparisons and words, on numbers that are all there."""
    chance = random.Random(12)
    columns = [Column(name, int, "", "") for name in "abcd"]

    def made(depth: int) -> str:
        if depth == 0 or chance.random() < 0.2:
            one, other = chance.choice("abcd"), chance.choice("abcd0123")
            return f"{one} {chance.choice(['==', '!=', '<', '<=', '>', '>='])} {other}"
        form = chance.choice(["{} and {}", "{} or {}", "not ({})", "({} or {}) and {}", "({})"])
        return form.format(*(made(depth - 1) for _ in range(3)))

    for _ in range(500):
        expression = made(3)
        row = {name: chance.randrange(4) for name in "abcd"}
        assert filter_of(expression, columns)(row) == eval(expression, {}, row), expression
