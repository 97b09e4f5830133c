# SPDX-License-Identifier: BSD-3-Clause
"""Beams with warping (BEAMW): the verdict of beams where the warping decouples, else an error.

What the deformations 7 and 8 are is not public. All that is used is that each changes with the
warping at its end of the beam and not at the other; so the truth here is the rank of a D(c) in
which everything else about them is drawn at random.
"""

from __future__ import annotations

import importlib
from typing import Any

import numpy as np
import pytest
from reference_decks import transform  # noqa: F401

import flexact

oracle_deck: Any = importlib.import_module("oracle_deck")
oracle_elements: Any = importlib.import_module("oracle_elements")
oracle_analysis: Any = importlib.import_module("oracle_analysis")

#: Positions, orientations and warping nodes of a chain of two sheets and a third across it.
ELEMENTS = {1: (1, 2, 11, 3, 4, 12), 2: (3, 4, 12, 5, 6, 13), 3: (3, 4, 14, 7, 8, 15)}
PLACES = "X 3 .1 .02 0\nX 5 .2 0 .03\nX 7 .1 .12 .05\nFIX 1\nFIX 2\nFIX 7\nFIX 8\n"
WARPING_NODES = range(11, 16)


def beams(keyword: str) -> str:
    """The elements as beams with or without warping."""
    lines = []
    for number, nodes in ELEMENTS.items():
        chosen = nodes if keyword == "BEAMW" else (*nodes[:2], *nodes[3:5])
        lines.append(f"{keyword} {number} {' '.join(map(str, chosen))} 0 .3 1\n")
    return "".join(lines)


class Drawn:
    """Random classes: statements of the six deformations, and of the warping."""

    def __init__(self, seed: int) -> None:
        random = np.random.default_rng(seed)
        self.random = random
        self.plain = ""
        for element in ELEMENTS:
            for part in range(1, 7):
                word = random.choice(["", "RLSE", "DYNE"], p=[0.4, 0.35, 0.25])
                if word:
                    self.plain += f"{word} {element} {part}\n"
        self.rows = [
            (element, part) for element in ELEMENTS for part in (7, 8) if random.random() < 0.5
        ]
        users: dict[int, int] = dict.fromkeys(WARPING_NODES, 0)
        for element, part in self.rows:
            users[ELEMENTS[element][2 if part == 7 else 5]] += 1
        # Most decks state what SPACAR could solve.
        self.free = [node for node, rows in users.items() if (rows > 0) == (random.random() < 0.95)]
        self.decouples = all(rows == (node in self.free) for node, rows in users.items())
        self.warping = "".join(f"DYNE {e} {part}\n" for e, part in self.rows)
        for node in WARPING_NODES:
            if node not in self.free:
                self.warping += f"{random.choice(['FIX', 'DYNX', 'INPUTX'])} {node}\n"

    def truth(self) -> tuple[int, int]:
        """Under- and over-constraint of D(c) with the rows and columns of warping."""
        deck = oracle_deck.read_deck(beams("BEAM") + PLACES + self.plain)
        rows, columns, matrix = oracle_analysis.jacobian(deck)
        width = len(columns) + len(self.free)
        full = np.zeros((len(rows) + len(self.rows), width))
        full[: len(rows), : len(columns)] = matrix
        for index, (element, part) in enumerate(self.rows, start=len(rows)):
            nodes = ELEMENTS[element]
            near = [k for k, label in enumerate(columns) if label[0] in nodes]
            full[index, near] = self.random.normal(size=len(near))
            warping = nodes[2 if part == 7 else 5]
            if warping in self.free:
                full[index, len(columns) + self.free.index(warping)] = self.random.normal() + 3.0
        rank = int(np.linalg.matrix_rank(full, 1e-9)) if full.size else 0
        return width - rank, full.shape[0] - rank


@pytest.mark.parametrize("seed", range(60))
def test_counts_do_not_hang_on_what_warping_is(seed: int) -> None:
    drawn = Drawn(seed)
    text = beams("BEAMW") + PLACES + drawn.plain + drawn.warping + "END\n"
    if not drawn.decouples:
        assert errors_of(text) == [("not-covered", errors_of(text)[0][1])]
        return
    found = flexact.analyse(flexact.read_text(text))
    assert (found.under_constrained, found.over_constrained) == drawn.truth()
    assert [d.code for d in flexact.read_text(text).diagnostics if d.code == "warping"] == [
        "warping"
    ]


def test_some_of_the_drawn_decks_are_analysed_and_some_are_not() -> None:
    kinds = [Drawn(seed).decouples for seed in range(60)]
    assert 15 < sum(kinds) < 50


def errors_of(text: str) -> list[tuple[str, int]]:
    with pytest.raises(flexact.DeckError) as caught:
        flexact.read_text(text)
    return [(d.code, d.line) for d in caught.value.diagnostics if str(d.severity) == "error"]


ONE = "BEAMW 1 1 2 11 3 4 12 0 1 0\nX 3 .1 0 0\nFIX 1\nFIX 2\n"
CLAMPED = ONE + "FIX 11\nDYNX 12\n"


@pytest.mark.parametrize(
    ("statements", "code"),
    [
        ("", "not-covered"),
        ("FIX 11\n", "not-covered"),
        ("FIX 11\nDYNE 1 8\nDYNE 1 7\n", "not-covered"),
        ("FIX 11\nFIX 12\nINPUTE 1 8\n", "not-covered"),
        ("FIX 11\nFIX 12 2\n", "component-out-of-range"),
        ("FIX 11\nFIX 12\nRLSE 1 9\n", "component-out-of-range"),
        ("FIX 11\nFIX 12\nRLSE 1 8\nDYNE 1 8\n", "class-conflict"),
        ("FIX 11\nDYNX 11\nFIX 12\n", "class-conflict"),
        ("FIX 11\nFIX 12\nTRUSS 2 3 12\n", "two-kinds-of-node"),
        ("FIX 11\nFIX 12\nFIX 13\n", "no-such-node"),
        ("FIX 11\nFIX 12\nBEAMW 2 1 2 11 3 4\n", "missing-operand"),
    ],
)
def test_one_mistake_one_error(statements: str, code: str) -> None:
    assert [found for found, _ in errors_of(f"{ONE}{statements}END\n")] == [code]


@pytest.mark.parametrize("keyword", ["BEAMW", "beamw", "BeamW"])
def test_what_is_said_of_warping_is_read(keyword: str) -> None:
    """Of a clamped beam all six deformations are counted, and the end moves with none held."""
    text = CLAMPED.replace("BEAMW", keyword) + "RLSE 1\nX 12 0.\nEND\nHALT\n"
    text += "ESTIFF 1 1 2 3 4 5 6 7\nEM 1 1 2 3 4 5 6\nXM 12 1.\nXF 12 1.\nSTARTDE 1 8 0. 0.\nEND\n"
    model = flexact.read_text(text)
    assert [d.code for d in model.diagnostics] == ["warping", "not-used"]
    result = flexact.analyse(model)
    assert (result.under_constrained, result.over_constrained) == (6, 0)
    again = flexact.read_text(model.to_deck())
    assert "BEAM 1 1 2 3 4" in model.to_deck()
    assert flexact.analyse(again).counts == result.counts


def test_independent_as_a_whole_means_warping_too() -> None:
    """DYNE without a component makes 7 and 8 rows; the clamped end then has one too many."""
    assert errors_of(f"{ONE}FIX 11\nDYNE 1\nEND\n") == [("not-covered", 1)]
    model = flexact.read_text(f"{ONE}DYNE 1\nEND\n")
    assert flexact.analyse(model).verdict is flexact.Verdict.EXACT


def test_places_of_words_behind_the_warping_nodes() -> None:
    """Columns counted by hand."""
    parallel = CLAMPED.replace("0 1 0\n", "2 0 0\n", 1)
    with pytest.raises(flexact.DeckError) as caught:
        flexact.read_text(parallel)
    (found,) = (d for d in caught.value.diagnostics if str(d.severity) == "error")
    assert (found.code, found.line, found.column) == ("parallel-vector", 1, 23)


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
