# SPDX-License-Identifier: BSD-3-Clause
"""One mistake is reported once: what only follows from it is not reported as well."""

from __future__ import annotations

import pytest

import flexact

PLACED = "X 3 1 0 0\nFIX 1\nFIX 2\nRLSE 1 2 5 6\n"
MANY_STIFFNESSES = "ESTIFF 1 1. 2. 3. 4.\nEM 1 0.5\nXM 3 1.\n" * 5


def errors_of(deck: str) -> list[tuple[str, int]]:
    with pytest.raises(flexact.DeckError) as caught:
        flexact.read_text(deck)
    return [(d.code, d.line) for d in caught.value.diagnostics if d.severity.value == "error"]


@pytest.mark.parametrize(
    ("deck", "expected"),
    [
        (f"BEAM 1 1 2 3 4\n{PLACED}{MANY_STIFFNESSES}END\n", ("wrong-block", 6)),
        (f"BEAM 1 1 2 3 4\n{PLACED}HALT\n{MANY_STIFFNESSES}END\nEND\n", ("missing-end", 6)),
        (f"BEAM 1 1 2 3 4\n{PLACED}EDN\n{MANY_STIFFNESSES}END\nEND\n", ("unknown-keyword", 6)),
        (
            f"BEAM 1 1 2 3 4\n{PLACED}VISUALIZATION\nBEAMPROPS 1\nCROSSTYPE RECT\n",
            ("missing-end", 6),
        ),
        (f"SPRING 1 1 2 3 4\nTRUSS 2 1 3\n{PLACED}", ("unknown-keyword", 1)),
        (f"PLBEAR 1 1 2 3 4\nTRUSS 2 1 3\n{PLACED}", ("not-covered", 1)),
        (f"BEAM 1 1 2 3 4x\nFIX 4 2\n{PLACED}", ("bad-number", 1)),
        (f"BEAM 1 1. 2 3 4\n{PLACED}", ("not-whole", 1)),
        ("BEAM 1 1 2 3 4\nX 3a 1 0 0\nFIX 1\n", ("bad-number", 2)),
        (f"RBEAM 1 1 2 3 4\n{PLACED.replace('RLSE 1 2 5 6', '')}", ("missing-operand", 1)),
        (f"BEAM 1 1 2 3 4 ; note\n{PLACED}", ("bad-comment", 1)),
        ("X 1 0 0 0\nFIX 1\n", ("nothing-to-analyse", 0)),
    ],
)
def test_one_mistake_one_error(deck: str, expected: tuple[str, int]) -> None:
    """Lines counted by hand."""
    assert errors_of(deck) == [expected]


def test_first_errors_by_place_are_shown() -> None:
    """A late check in an early line is not lost behind many others."""
    deck = "TRUSS 1 1 2\nTRUSS 2 2 2\nX 2 1 0 0\n" + "".join(f"FIX {n}\n" for n in range(10, 160))
    with pytest.raises(flexact.DeckError) as caught:
        flexact.read_text(deck)
    assert caught.value.diagnostics[0].code == "same-node"
    assert "151 errors" in str(caught.value)


def test_components_in_the_dynamics_block_must_exist() -> None:
    """Lines counted by hand."""
    deck = (
        "TRUSS 1 1 2\nX 2 1 0 0\nFIX 1\nEND\nHALT\nINPUTX 2 9 1\nINPUTE 1 4 1\nINPUTX 2 3 1\nEND\n"
    )
    out_of_range = "component-out-of-range"
    assert errors_of(deck) == [(out_of_range, 6), (out_of_range, 7)]
