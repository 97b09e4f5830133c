# SPDX-License-Identifier: BSD-3-Clause
"""Repeated lines add up; of a value that is given twice the last counts; points of the ground."""

from __future__ import annotations

import numpy as np
import pytest

import flexact

START = "BEAM 1 1 2 3 4\nBEAM 2 3 4 5 6\nX 3 .1 0 0\nX 5 .2 .1 0\n"
PLANAR = "PLBEAM 1 1 2 3 4\nPLBEAM 2 3 4 5 6\nX 3 .1 0\nX 5 .2 .1\n"

#: Statements of one line, and the same in several, as decks of the field have them.
SAME = {
    "FIX": ("FIX 1 1 2 3\nFIX 2\n", "FIX 1 1\nFIX 1 3 2\nFIX 2 2\nFIX 2 3\nFIX 2 4 3\n"),
    "FIX all and some": ("FIX 1\nFIX 2\n", "FIX 1\nFIX 1 2\nFIX 2 4\nFIX 2\nFIX 1\n"),
    "FIX with lambda0": ("FIX 2 2 3 4\n", "FIX 2 1 2\nFIX 2 1\nFIX 2 3 4\n"),
    "DYNX": ("DYNX 5 1 2\nDYNX 6 4\n", "DYNX 5 2\nDYNX 6 4\nDYNX 5 1\nDYNX 5 1 2\n"),
    "INPUTX": ("INPUTX 5\n", "INPUTX 5 1\nINPUTX 5 2\nINPUTX 5 3\n"),
    "INPUTX and DYNX": ("DYNX 5 1 2\n", "INPUTX 5 1\nDYNX 5 1 2\nINPUTX 5 2\n"),
    "RLSE": ("RLSE 1 2 5 6\nRLSE 2\n", "RLSE 2\nRLSE 1 2\nRLSE 1 5 6\nRLSE 2 1\nRLSE 1 6\n"),
    "DYNE": ("DYNE 1 1 2 3 4 5 6\n", "DYNE 1 1 2\nDYNE 1 2 3\nDYNE 1 6 5 4\n"),
    "INPUTE": ("INPUTE 2 1 2\n", "INPUTE 2 1\nINPUTE 2 2\n"),
    "INPUTE and DYNE": ("DYNE 2 1 2\n", "INPUTE 2 1\nDYNE 2 2\nDYNE 2 1\n"),
    "mixed": (
        "FIX 1\nFIX 2\nRLSE 1 2 5\nDYNE 1 6\nDYNX 5 3\n",
        "DYNE 1 6\nRLSE 1 5\nFIX 2\nFIX 1\nDYNX 5 3\nRLSE 1 2\nDYNE 1 6\n",
    ),
}


def assert_same(one: flexact.Model, other: flexact.Model) -> None:
    for ours, theirs in zip(one.data.arrays, other.data.arrays, strict=True):
        np.testing.assert_array_equal(ours, theirs)


@pytest.mark.parametrize("statements", SAME.values(), ids=list(SAME))
def test_repeated_statements_add_up(statements: tuple[str, str]) -> None:
    one, several = (flexact.read_text(f"{START}{lines}END\n") for lines in statements)
    assert_same(one, several)
    assert [d.code for d in several.diagnostics] == [d.code for d in one.diagnostics]
    # In front of the elements, too.
    assert_same(one, flexact.read_text(f"{statements[1]}{START}END\n"))


def test_the_last_of_two_values_counts_and_both_places_are_shown() -> None:
    """Lines counted by hand."""
    model = flexact.read_text(f"{START}FIX 1\nFIX 2\nX 3 .3 .1 0\nX 3 .4 .1 0\nEND\n")
    assert model.data.arrays.node_value[:3, 2].tolist() == [0.4, 0.1, 0.0]
    found = [(d.code, d.line, d.other.line) for d in model.diagnostics if d.other]
    assert found == [("repeated-value", 7, 3), ("repeated-value", 8, 7)]


DYNAMICS = """\
EMASS 1 1.
EM 2 1.
MASS 3 2.
FORCE 3 0 0 1
FORCE 3 0 0 2
XF 3 0 0 1
EDAMPP 1 1.
EDAMP 1 1.
INPUTX 3 1 0.1
INPUTX 3 2 0 0 0
INPUTE 1 5 0 0 0
INPUTE 1 5 0 0 0
STARTDE 1 5 0 0
STARTDE 1 6 0 0
TIMESTEP 100 1.0
TIMESTEP 1.0 100
GRAVITY 0 0 -9.8
"""


def test_dynamics_of_either_dialect_are_read() -> None:
    """Values of inputs are given line by line and declare nothing."""
    text = f"* {START.splitlines()[0]}\nOUTLEVEL 1 0\n{START}FIX 1\nFIX 2\nEND\n"
    plain = flexact.read_text(text)
    model = flexact.read_text(f"{text}HALT\n{DYNAMICS}END\nEND\n")
    assert_same(plain, model)
    found = [(d.code, d.line) for d in model.diagnostics]
    assert found == [("repeated-value", 15), ("repeated-value", 16), ("not-used", 17)]
    assert model.data.loads is not None
    assert model.data.loads.force[2].tolist() == [0, 0, 1], "the last of them"
    assert model.diagnostics[-1].message == (
        "10 statements were not used: "
        "EDAMPP, EDAMP, INPUTX (2), INPUTE (2), STARTDE (2), TIMESTEP (2)"
    )


@pytest.mark.parametrize("fixed", ["FIX 9\n", "FIX 9 1\nFIX 9 3 2\n"])
def test_a_fixed_point_that_no_element_uses_is_left_out(fixed: str) -> None:
    """SPACAR has it as a node with nothing to solve for."""
    deck = f"{START}FIX 1\nFIX 2\nX 9 1 0 0\n{fixed}END\nHALT\nXM 9 1.\nEND\n"
    model = flexact.read_text(deck)
    found = [(str(d.severity), d.code, d.line) for d in model.diagnostics]
    assert found == [("warning", "unused-node", 7)]
    assert_same(model, flexact.read_text(f"{START}FIX 1\nFIX 2\nEND\n"))


@pytest.mark.parametrize(
    ("lines", "errors"),
    [
        ("X 9 1 0 0\n", 1),
        ("FIX 9\n", 1),
        ("X 9 1 0 0\nFIX 9 1 2\n", 2),
        ("X 9 1 0 0\nDYNX 9\n", 2),
        ("X 9 1 0 0\nFIX 9 2\nFIX 10 1 3\n", 3),
    ],
)
def test_one_that_could_move_is_an_error(lines: str, errors: int) -> None:
    with pytest.raises(flexact.DeckError) as caught:
        flexact.read_text(f"{START}FIX 1\n{lines}END\n")
    assert [d.code for d in caught.value.diagnostics] == ["no-such-node"] * errors


def test_an_element_of_the_number_of_such_a_point_is_still_missing() -> None:
    for node in ("X 9 1 0 0\nFIX 9\n", "FIX 9 #warping\n", "BEAMW 3 5 6 9 7 8 10\nX 7 1 1 1\n"):
        with pytest.raises(flexact.DeckError) as caught:
            flexact.read_text(f"{START}{node}FIX 1\nRLSE 9\nEND\n")
        found = [d.code for d in caught.value.diagnostics if str(d.severity) == "error"]
        assert found == ["no-such-element"]


def test_in_the_plane_two_components_are_all() -> None:
    model = flexact.read_text(f"{PLANAR}FIX 1\nFIX 2\nX 9 1 0\nFIX 9 1\nFIX 9 2\nEND\n")
    assert [d.code for d in model.diagnostics] == ["unused-node"]


def test_a_deck_of_a_hundred_thousand_lines() -> None:
    """With as many warnings as there are points; tests/benchmarks knows of times."""
    beams = 20000
    lines = [f"BEAM {k} {2 * k - 1} {2 * k} {2 * k + 1} {2 * k + 2}\n" for k in range(1, beams)]
    lines += [f"X {2 * k + 1} {k} 0 0\nX {9 * beams + k} 0 0 0\n" for k in range(1, beams)]
    lines += [f"FIX {9 * beams + k}\nRLSE {k} 2\nRLSE {k} 5\n" for k in range(1, beams)]
    model = flexact.read_text("".join(lines))
    assert int(np.sum(model.data.arrays.deformation_class == 2)) == 2 * (beams - 1)


@pytest.mark.parametrize(("name", "notes"), [("beam", 0), ("beam 2", 0), ("beams", 1), ("leg", 1)])
def test_names_that_older_ones_give_to_all_beams(name: str, notes: int) -> None:
    lines = f"BEAM 1 1 2 4 5 #{name}\nBEAM 2 7 8 10 11 #{name}\nX 4 1 0 0\nX 7 0 1 0\nX 10 1 1 0\n"
    model = flexact.read_text(f"{lines}FIX 1\nFIX 2\nFIX 7\nFIX 8\nEND\n")
    assert [d.code for d in model.diagnostics] == ["repeated-name"] * notes


def test_names_that_spacar_light_gives() -> None:
    """Every inner node has one name, and the beams of an element are one part."""
    lines = ["X 1 0 0 0 #node 1", "X 4 .1 0 0 #node 2"]
    lines += [f"X {7 + 3 * k} {0.025 * (k + 1)} 0 0 #intermediate node" for k in range(3)]
    ends = (1, 7, 10, 13, 4)
    for k in range(4):
        nodes = f"{ends[k]} {ends[k] + 1} {ends[k + 1]} {ends[k + 1] + 1}"
        lines += [f"BEAM {k + 1} {nodes} 0 0 1 #element 1 beam {k + 1}", f"DYNE {k + 1} 2 3 4"]
    model = flexact.read_text("\n".join([*lines, "FIX 1", "FIX 2", "FIX 3 #warping", "END\n"]))
    assert model.diagnostics == ()
    assert [part.name for part in flexact.analyse(model).parts.all] == ["element 1"]
