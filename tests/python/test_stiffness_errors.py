# SPDX-License-Identifier: BSD-3-Clause
"""What an elastic model refuses, in words."""

from collections.abc import Callable
from typing import Any

import pytest
from stiffness_decks import arch, cantilever, deck, elastic, guide

import flexact

BARE = deck("TRUSS 1 1 2\nX 2 1 0 0\nFIX 1")

UNKNOWN: dict[str, Callable[[], Any]] = {
    "there are 1, 2, 3, 4": lambda: elastic(cantilever()).undeformed().compliance(9),
    "no element 7: there are 1": lambda: elastic(cantilever()).misfit(7, 1, 1e-6),
    "no deformation 7: it has 1, 2": lambda: elastic(cantilever()).undeformed().stress(1, 7),
    "no coordinate 'w': there are x": lambda: elastic(cantilever()).along(3, "w", [0]),
    "no coordinate 'rx'": lambda: elastic(arch()).along(2, "rx", [0]),
    "no element 3": lambda: elastic(cantilever(), release=[(3, 1)]),
}
REFUSED: dict[str, Callable[[], Any]] = {
    "has a stiffness: give ESTIFF": lambda: elastic(BARE).undeformed().compliance(2),
    "has a stiffness": lambda: elastic(BARE).undeformed().multipliers,
    "no element has": lambda: elastic(BARE).critical_misalignment(1, "x"),
    "has a mass": lambda: elastic(arch().replace("XM 2 0.5", "")).undeformed().frequencies,
    "give EM of elements": lambda: elastic(arch().replace("XM 2 0.5", "")).misalignment_for(
        -0.05, 1, "x"
    ),
    "over-constrained by 1": lambda: elastic(guide(), held="rigid").misaligned(1, "x", 1e-5),
    "ask with held elastic": lambda: elastic(guide(), held="rigid").misfit(1, 1, 1e-5),
    "not determined": lambda: elastic(guide(), held="rigid").critical_misalignment(1, "x"),
    "is not held": lambda: elastic(guide()).misaligned(9, "x", 1e-5),
    "is fixed": lambda: elastic(guide()).along(1, "x", [0]),
    "must be a finite number": lambda: elastic(guide()).misaligned(1, "x", float("nan")),
    "leave out `about`": lambda: elastic(guide()).misaligned(1, "x", 1e-5, about=9),
    "finite values": lambda: elastic(guide()).along(9, "x", [float("inf")]),
    "below pi": lambda: elastic(guide()).along(9, "rx", [4.0]),
    "held must be": lambda: elastic(guide(), held="soft"),
    "drive must be": lambda: elastic(guide(), drive="off"),
    "from 1 to 1000": lambda: elastic(guide(), beams=0),
    "a number from 0": lambda: elastic(guide(), release={(1, 5): -1.0}),
    "above -1": lambda: elastic(guide()).misalignment_for(-1.5, 1, "x"),
    "no drive acts": lambda: (
        elastic(deck("TRUSS 1 1 2\nX 2 1 0 0\nFIX 1", "ESTIFF 1 5\nXM 2 1"), drive="locked")
        .undeformed()
        .force
    ),
    "the frequency 0": lambda: elastic(
        deck("TRUSS 1 1 2\nX 2 1 0 0\nFIX 1", "ESTIFF 1 5\nXM 2 1")
    ).misalignment_for(-0.05, 1, "x"),
}


@pytest.mark.parametrize("words", UNKNOWN)
def test_what_is_not_there_is_told_with_what_is(words: str) -> None:
    with pytest.raises(flexact.UnknownError) as caught:
        UNKNOWN[words]()
    assert words in str(caught.value)
    assert isinstance(caught.value, (ValueError, flexact.FlexactError))
    assert isinstance(caught.value, LookupError)


@pytest.mark.parametrize("words", REFUSED)
def test_what_has_no_answer_is_refused_with_the_reason(words: str) -> None:
    with pytest.raises(flexact.ElasticError) as caught:
        REFUSED[words]()
    assert words in str(caught.value)


@pytest.mark.parametrize(
    "call",
    [
        lambda: flexact.elastic(3),  # type: ignore[arg-type]
        lambda: elastic(guide(), beams="many"),
        lambda: elastic(guide(), release=[5]),
        lambda: elastic(guide()).misfit(1.5, 1, 1e-6),
    ],
)
def test_what_is_of_another_kind(call: Callable[[], Any]) -> None:
    with pytest.raises(TypeError):
        call()


def test_a_load_on_a_motion_without_stiffness_has_no_equilibrium() -> None:
    text = deck("TRUSS 1 1 2\nX 2 1 0 0\nFIX 1", "ESTIFF 1 5\nXF 2 0 1 0")
    with pytest.raises(flexact.StrokeError, match="nothing resists") as caught:
        elastic(text).equilibrium()
    assert caught.value.reached < 1.0


def test_a_drive_that_is_free_has_no_force_at_rest() -> None:
    assert elastic(guide()).undeformed().force == 0.0
