# SPDX-License-Identifier: BSD-3-Clause
"""Logs in the form of SPACAR: against published ones, the oracle, and differences.

The published logs are those beside the decks of the same names in the public repository
Wout-S/oopspa (SPACAR of 14 May 2018). The mechanisms are stated anew here.
"""

from __future__ import annotations

import importlib
import re
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from reference_decks import NAMES, text_of
from small_decks import DECKS, write

import flexact
from flexact.apps.cli.main import main
from flexact.core.elements import NodeKind
from flexact.show import spacar_log as spacar_matrix
from flexact.show.spacar_log import SpacarNumbering, dcc, spacar_log

oracle_deck: Any = importlib.import_module("oracle_deck")
oracle_analysis: Any = importlib.import_module("oracle_analysis")

#: Corners of a square, clamped below, with a link at the top between two leaves.
CORNERS = "X 1 0 0 0\nX 4 0 .1 0\nX 7 .1 .1 0\nX 10 .1 0 0\nFIX 1\nFIX 2\nFIX 10\nFIX 11\n"
CROSSED = "BEAM 1 1 2 7 8 0 0 1\nBEAM 2 4 5 7 8 0 0 1\nBEAM 3 4 5 10 11 0 0 1\n" + CORNERS
PARALLEL = "BEAM 1 1 2 4 5 0 0 1\nBEAM 2 7 8 10 11 0 0 1\nBEAM 3 4 5 7 8 0 0 1\n" + CORNERS


class Published(NamedTuple):
    deck: str
    condition: str
    counts: str


#: What the published logs say; the counts without Euler elements come last.
PUBLISHED = {
    "crosshinge": Published(
        CROSSED + "RLSE 1 1 2 3 4 5 6\nDYNE 3 1 2 3 5 6\nRLSE 3 4\nINPUTX 8 4\n",
        "0.2061E+02",
        "10 10 15 22  12 27 28 28  24 6 12 6",
    ),
    "crosshinge_3": Published(
        CROSSED + "DYNE 1 2 3 4\nRLSE 1 1 5 6\nDYNE 3 2 3 6\nRLSE 3 1 4 5\n",
        "0.2179E+02",
        "10 10 16 22  12 28 28 28  24 6 12 6",
    ),
    "testfile": Published(
        PARALLEL + "DYNE 1 4 6\nRLSE 1 1 2 3 5\nDYNE 2 1 5 6\nRLSE 2 2 3 4\nINPUTX 7 1\n",
        "0.3603E+02",
        "10 10 15 22  12 27 28 28  24 6 12 6",
    ),
    "testfile_3": Published(
        PARALLEL + "DYNE 1 1 4 5\nRLSE 1 2 3 6\nDYNE 2 1 5 6\nRLSE 2 2 3 4\n",
        "0.3087E+02",
        "10 10 16 22  12 28 28 28  24 6 12 6",
    ),
}
#: Some lines of the tables of the first.
LINES = """\
     1 Beam       1   2   7   8          16-C  17-C  18-C  19-C  20-C  21-C                 6
     2 Beam       4   5   7   8           1-O   2-O   3-O   4-O   5-O   6-O                 6
     3 Beam       4   5  10  11          11-M  12-M  13-M  22-C  14-M  15-M                 6
     4 Euler      2                       7-O                                               1
     7 Euler     11                      10-O                                               1
     1   1-O   2-O   3-O           0.00000     0.00000     0.00000
     2  13-C   4-O   5-O   6-O     1.00000     0.00000     0.00000     0.00000
     7  21-C  22-C  23-C           0.10000     0.10000     0.00000
     8  24-C  25-C  26-C  28-M     1.00000     0.00000     0.00000     0.00000
    11  27-C  10-O  11-O  12-O     1.00000     0.00000     0.00000     0.00000
     1     28        Input
     2            11 -Dynamic
  1.00000E+00  0.00000E+00  1.00000E-01  0.00000E+00  1.00000E+00  0.00000E+00
"""
COUNTS = ("NEO", "NEMM", "NEM", "NEC", "NXO", "NXC", "NXMM", "NXM")


def log_of(text: str) -> str:
    return spacar_log(flexact.analyse(flexact.read_text(text)))


def counts_in(log: str) -> list[int]:
    """The eight counts, and NX, NEO, NXO and NDOF without Euler elements."""
    return [int(word) for word in re.findall(r"\bN\w+ *= *(\d+)", log)]


def condition_in(log: str) -> str:
    found = re.search(r"Condition number of Dcc: +(.*)", log)
    assert found is not None
    return found[1]


@pytest.mark.parametrize("name", PUBLISHED)
def test_condition_and_counts_are_those_of_published_logs(name: str) -> None:
    published = PUBLISHED[name]
    log = log_of(f"{published.deck}END\n")
    assert condition_in(log) == published.condition
    assert counts_in(log) == [int(word) for word in published.counts.split()]


def test_tables_are_those_of_a_published_log() -> None:
    said = [line.rstrip() for line in log_of(PUBLISHED["crosshinge"].deck + "END\n").splitlines()]
    assert [line for line in LINES.splitlines() if line not in said] == []


def test_an_under_constrained_system_as_in_a_published_log() -> None:
    """The slider-crank there has a fixed node besides, three more of NX and of NXO."""
    deck = (
        "HINGE 1 2 11 0 0 1\nBEAM 2 10 11 4 5 0 0 1\nHINGE 3 5 14 0 0 1\nBEAM 4 13 14 7 8 0 0 1\n"
        "X 4 1 1 0\nX 7 3 0 0\nDYNE 1 1\nDYNE 2 1 2 3 4 5 6\nDYNE 3 1\nFIX 2\nFIX 7 2 3\nEND\n"
    )
    said = [int(word) for word in re.findall(r"\( *(\d+)\)", log_of(deck))]
    assert said == [8, 35 - 3, 8 - 3, 15, 27, 23]


@cache
def oracle_of(name: str) -> Any:
    return oracle_deck.read_deck(text_of(name))


def inputs_of(name: str) -> tuple[set[Any], set[Any]]:
    """Coordinates and deformations that a deck calls inputs."""
    deck = oracle_of(name)
    coordinates, deformations = set(), set()
    for _, (keyword, *words) in oracle_deck.kinematic_statements(text_of(name)):
        if keyword not in ("INPUTX", "INPUTE"):
            continue
        owner, *parts = (int(word) for word in words)
        if keyword == "INPUTE":
            every = range(1, deck.elements[owner].type.deformations + 1)
            deformations |= {(owner, str(part)) for part in parts or every}
        else:
            axes = deck.axes(owner)
            first = 2 if len(axes) == 3 and deck.kinds[owner] == "o" else 1
            coordinates |= {(owner, axes[p - first]) for p in parts} or {(owner, a) for a in axes}
    return coordinates, deformations


@pytest.mark.parametrize("name", NAMES)
def test_counts_are_those_of_the_oracle(name: str) -> None:
    deck = oracle_of(name)
    input_x, input_e = inputs_of(name)
    euler = 0 if deck.planar else list(deck.kinds.values()).count("o")
    x, e = list(deck.coordinates.values()), list(deck.deformations.values())
    steps_of_e = (
        *(e.count("fixed") + euler, len(input_e)),
        *(e.count("independent") - len(input_e), e.count("dependent")),
    )
    steps_of_x = (
        *(x.count("fixed"), x.count("dependent") + euler),
        *(len(input_x), x.count("independent") - len(input_x)),
    )
    plain = [len(x), e.count("fixed"), x.count("fixed")]
    freedoms = x.count("independent") + e.count("independent")
    wanted = [*np.cumsum(steps_of_e).tolist(), *np.cumsum(steps_of_x).tolist(), *plain, freedoms]
    log = log_of(text_of(name))
    assert counts_in(log)[-12:] == wanted
    _every_number_stands_once(log, dict(zip(COUNTS, wanted, strict=False)))


def _every_number_stands_once(log: str, counts: dict[str, int]) -> None:
    """In the tables, with the letter of its class."""
    tables = log.split(" Elements used in this model:")[1].split(" Degree of freedom")[0]
    of_elements, of_nodes = tables.split(" Nodal point information")
    for table, total, fixed, (first, last) in (
        (of_elements, counts["NEC"], counts["NEO"], (counts["NEM"], counts["NEC"])),
        (of_nodes, counts["NXM"], counts["NXO"], (counts["NXO"], counts["NXC"])),
    ):
        cells = sorted((int(n), letter) for n, letter in re.findall(r"(\d+)-([OCM])\b", table))
        assert [number for number, _ in cells] == list(range(1, total + 1))
        for number, letter in cells:
            assert letter == ("O" if number <= fixed else "C" if first < number <= last else "M")


@pytest.mark.parametrize("name", NAMES)
def test_condition_is_that_of_the_oracle(name: str) -> None:
    """D(c) by complex steps, a rotation as twice the Euler parameter, the norm's row [2]."""
    deck = oracle_of(name)
    outcome = oracle_analysis.analyse(deck)
    said = condition_in(log_of(text_of(name)))
    size = min(outcome.matrix.shape)
    if outcome.rank < size:
        assert said == "Infinity"
        return
    turns = np.array([label[1].startswith("r") for label in outcome.column_labels], bool)
    matrix = outcome.matrix * np.where(turns & (not deck.planar), 2.0, 1.0)
    values = np.linalg.svd(matrix, compute_uv=False).tolist() if size else []
    if not deck.planar and "o" in deck.kinds.values():
        values.append(2.0)
    if values and min(outcome.matrix.shape) + len(values) > 0 and said != "none":
        assert float(said) == pytest.approx(max(values) / min(values), rel=1e-3)
    else:
        assert not values


ROTATED = """\
BEAM 1 1 2 3 4 0 1 0
HINGE 2 4 6 1 2 3
RBEAM 3 3 6 7
BEAM 4 7 6 9 10
X 3 .1 .02 .03
X 4 .5 .5 -.5 .5
X 6 2 1 0 1
X 7 .1 .2 .3
X 9 .4 .2 .1
X 10 .8 .6 0 0
FIX 1
FIX 2
FIX 9 1
FIX 10 3
DYNX 6 2
INPUTX 4 4
RLSE 1 2 5
INPUTE 2 1
DYNE 4 6
END
"""


def test_euler_parameters_of_any_orientation_against_differences() -> None:
    model = flexact.read_text(ROTATED)
    numbering = SpacarNumbering(model.data)
    x, e = numbering.coordinates, numbering.deformations
    matrix = dcc(numbering)
    reference = model.reference()
    value, turned = reference.value.copy(), reference.kinds == NodeKind.ORIENTATION
    value[turned] /= np.linalg.norm(value[turned], axis=1, keepdims=True)
    rows = np.flatnonzero((e.letter != "c") & (e.owner < numbering.elements.size))
    order = np.argsort(e.number[rows])
    exists = model.data.arrays.deformation_class.T != 0
    place = np.cumsum(exists).reshape(exists.shape) - 1
    picked = place[numbering.elements[e.owner[rows]], e.part[rows]][order]
    assert matrix.shape == (e.ends[2], x.ends[1] - x.ends[0])
    step = 1e-6
    for k in np.flatnonzero(x.letter == "c"):
        ends = []
        for sign in (1.0, -1.0):
            moved = value.copy()
            moved[x.owner[k], x.part[k]] += sign * step
            ends.append(flexact.deformations(model, flexact.Configuration(reference.kinds, moved)))
        wanted = (ends[0] - ends[1])[picked] / (2.0 * step)
        column = matrix[:, x.number[k] - 1 - x.ends[0]]
        found = column[np.sort(e.number[rows]) - 1]
        np.testing.assert_allclose(found, wanted, atol=1e-8)


def test_inputs_are_those_of_the_kinematics_alone() -> None:
    """Values of inputs in the dynamics declare nothing; comments and spellings do not matter."""
    text = CROSSED + "DYNX 8 4 % INPUTX 8 3\n\tinputx +8 2 1 % twice\nINPUTE 1\nDYNE 3 1\n"
    log = log_of(text + "* INPUTE 2\nEND\nHALT\nINPUTX 8 4 0.1\nINPUTE 3 1 0.1\nEND\n")
    neo, nemm, nem, _, nxo, nxc, nxmm, nxm, *_ = counts_in(log)[-12:]
    assert (nemm - neo, nem - nemm) == (6, 1)
    assert (nxmm - nxc, nxm - nxmm) == (1, 1) and nxo < nxc
    rows = re.findall(r"^ +\d+ +(\d+) +(Input|-Dynamic) *$", log, re.MULTILINE)
    assert [word for _, word in rows] == ["Input", "-Dynamic", *["Input"] * 6, "-Dynamic"]


@pytest.mark.parametrize(
    ("deck", "word"), [("under", "Under"), ("over", "Over"), ("exact", ""), ("both", "")]
)
def test_a_system_that_is_not_square_is_said_to_be_so(deck: str, word: str) -> None:
    found = re.findall(r"(\w+)-constraint system configuration", log_of(DECKS[deck]))
    assert found == ([word] if word else [])


def test_a_large_matrix_is_not_decomposed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(spacar_matrix, "MOST_ROWS", 14)
    assert condition_in(log_of(PUBLISHED["crosshinge"].deck)).startswith("not computed")


def test_a_model_without_a_deck_has_a_log() -> None:
    model = flexact.Model(name="guide")
    model.wire((0, 0, 0), (0.1, 0, 0))
    log = spacar_log(flexact.analyse(model))
    assert " BEAM 1 " in log and counts_in(log)


def test_the_command_writes_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    deck = write(tmp_path / "deck.dat", PUBLISHED["crosshinge"].deck + "END\n")
    assert main(["analyse", str(deck), "--log", "spacar"]) == 0
    said = capsys.readouterr().out
    assert condition_in(said) == "0.2061E+02"
    out = tmp_path / "out"
    assert main(["analyse", str(deck), "--log", "spacar", "-o", str(out)]) == 0
    assert (out / "deck.log").read_text(encoding="utf-8").strip() == said.strip()
    assert "Condition number of Dcc" not in capsys.readouterr().out
    assert main(["analyse", str(deck), "--log", "spacar", "--json"]) == 2
    assert "-o DIR" in capsys.readouterr().err
