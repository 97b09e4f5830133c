# SPDX-License-Identifier: BSD-3-Clause
"""Beams with warping (BEAMW) have the verdict of beams, and what else is refused says why.

That the deformations 7 and 8 are always calculable, and that a warping coordinate is no unknown,
is what the program of the University of Twente that writes such decks goes by
(precision-utwente/spalight: it states nothing of either where warping is free, and FIX elsewhere).
"""

from __future__ import annotations

import importlib
from typing import Any

import numpy as np
import pytest
from reference_decks import REFERENCE

import flexact
from flexact.show.spacar_log import spacar_log

assert REFERENCE
oracle_deck: Any = importlib.import_module("oracle_deck")
oracle_analysis: Any = importlib.import_module("oracle_analysis")

#: Positions, orientations and warping nodes of a chain of two sheets and a third across it.
ELEMENTS = {1: (1, 2, 11, 3, 4, 12), 2: (3, 4, 12, 5, 6, 13), 3: (3, 4, 14, 7, 8, 15)}
PLACES = "X 3 .1 .02 0\nX 5 .2 0 .03\nX 7 .1 .12 .05\nFIX 1\nFIX 2\nFIX 7\nFIX 8\n"


def beams(keyword: str) -> str:
    """The elements as beams with or without warping."""
    lines = []
    for number, nodes in ELEMENTS.items():
        chosen = nodes if keyword == "BEAMW" else (*nodes[:2], *nodes[3:5])
        lines.append(f"{keyword} {number} {' '.join(map(str, chosen))} 0 .3 1\n")
    return "".join(lines)


@pytest.mark.parametrize("seed", range(12))
def test_the_verdict_is_that_of_beams(seed: int) -> None:
    """By the oracle, which knows of beams alone."""
    random = np.random.default_rng(seed)
    plain = warping = ""
    for element in ELEMENTS:
        for part in range(1, 7):
            word = random.choice(["", "RLSE", "DYNE"], p=[0.4, 0.35, 0.25])
            plain += f"{word} {element} {part}\n" if word else ""
        warping += f"RLSE {element} 7 8\n" if random.random() < 0.3 else ""
    for node in range(11, 16):
        word = random.choice(["", "FIX", "DYNX", "INPUTX"])
        warping += f"{word} {node}\n" if word else ""
    truth = oracle_analysis.analyse(oracle_deck.read_deck(beams("BEAM") + PLACES + plain))
    model = flexact.read_text(f"{beams('BEAMW')}{warping}{PLACES}{plain}END\n")
    found = flexact.analyse(model)
    counts = found.under_constrained, found.over_constrained
    assert counts == (truth.under_constrained, truth.over_constrained)
    assert "warping" in [d.code for d in model.diagnostics]


def errors_of(text: str) -> list[tuple[str, int]]:
    with pytest.raises(flexact.DeckError) as caught:
        flexact.read_text(text)
    return [(d.code, d.line) for d in caught.value.diagnostics if str(d.severity) == "error"]


ONE = "BEAMW 1 1 2 11 3 4 12 0 1 0\nX 3 .1 0 0\nFIX 1\nFIX 2\n"


@pytest.mark.parametrize(
    ("statements", "code"),
    [
        ("DYNE 1 2 8\n", "not-covered"),
        ("RLSE 1 8\nINPUTE 1 8 7 1\n", "not-covered"),
        ("FIX 12 2\n", "component-out-of-range"),
        ("RLSE 1 9\n", "component-out-of-range"),
        ("FIX 11\nDYNX 11\n", "class-conflict"),
        ("TRUSS 2 3 12\n", "two-kinds-of-node"),
        ("FIX 13\n", "no-such-node"),
        ("BEAMW 2 1 2 11 3 4\n", "missing-operand"),
        ("BEAMW 2 1 2 11 3 4 12 0 1 0 5\n", "surplus-operand"),
    ],
)
def test_one_mistake_one_error(statements: str, code: str) -> None:
    assert [found for found, _ in errors_of(f"{ONE}{statements}END\n")] == [code]


@pytest.mark.parametrize("keyword", ["BEAMW", "beamw", "BeamW"])
def test_what_is_said_of_warping_is_read(keyword: str) -> None:
    text = ONE.replace("BEAMW", keyword) + "FIX 11\nDYNX 12\nRLSE 1\nX 12 0.\nEND\nHALT\n"
    text += "ESTIFF 1 1 2 3 4 5 6 7\nEM 1 1 2 3 4 5 6\nXM 12 1.\nXF 12 1.\nSTARTDE 1 8 0. 0.\nEND\n"
    model = flexact.read_text(text)
    assert [d.code for d in model.diagnostics] == ["warping", "not-used"]
    result = flexact.analyse(model)
    assert (result.under_constrained, result.over_constrained) == (6, 0)
    again = flexact.read_text(model.to_deck())
    assert "BEAM 1 1 2 3 4" in model.to_deck()
    assert flexact.analyse(again).counts == result.counts


def test_dyne_of_all_means_the_six() -> None:
    result = flexact.analyse(flexact.read_text(f"{ONE}DYNE 1\nEND\n"))
    assert result.verdict is flexact.Verdict.EXACT
    assert result.degrees_of_freedom == 6


def test_inputs_of_warping_are_not_in_a_log() -> None:
    text = f"{ONE}INPUTX 11\nINPUTE 1 2\nEND\n"
    log = spacar_log(flexact.analyse(flexact.read_text(text)))
    assert "6 fixed, 8 calculable, 0 input, 0 dynamic" in log
    assert "7 fixed, 1 input, 0 dynamic, 0 calculable" in log


def test_places_of_words_behind_the_warping_nodes() -> None:
    """Columns counted by hand."""
    parallel = ONE.replace("0 1 0\n", "2 0 0\n", 1)
    with pytest.raises(flexact.DeckError) as caught:
        flexact.read_text(parallel)
    (found,) = caught.value.diagnostics
    assert (found.code, found.line, found.column) == ("parallel-vector", 1, 23)


def test_fixed_warping_where_no_beam_has_any() -> None:
    """As SPACAR Light writes it of every node that it clamps; without its comment it is a slip."""
    plain = "BEAM 1 1 2 4 5 0 1 0 # element 1\nX 4 .1 0 0\nFIX 1\nFIX 2\n"
    model = flexact.read_text(f"{plain}FIX\t\t  3  #warping\nFIX 6 # Warping\nEND\n")
    assert model.diagnostics == ()
    assert errors_of(f"{plain}FIX 3\nEND\n") == [("no-such-node", 5)]


@pytest.mark.parametrize(
    "keyword", ["PLBEAR 1 1 2 3 4", "PLBELT 1 1 2 3 4", "WHEEL 1 1 2 3 4 0 0 1"]
)
def test_what_is_not_covered_says_what_to_write(keyword: str) -> None:
    text = f"{keyword}\nPLTRUSS 2 1 3\nX 3 1 0\nRLSE 1 3\nFIX 1\nFIX 4\nEND\nHALT\nEM 1 1.\nEND\n"
    with pytest.raises(flexact.DeckError) as caught:
        flexact.read_text(text)
    (found,) = caught.value.diagnostics
    assert (found.code, found.line) == ("not-covered", 1)
    assert found.help
