# SPDX-License-Identifier: BSD-3-Clause
"""Every deck against its reference, and the paper's twelve trusses against closed forms.

The references under tests/reference are computed by tests/reference/oracle.py, which shares
nothing with the package, and name the source of each answer.
"""

import math
from pathlib import Path

import numpy as np
import pytest

import flexact
from flexact.apps.checks.comparison import answer_bytes, answer_in, answer_of, differences

ROOT = Path(__file__).resolve().parents[2]
DECKS = ROOT / "input_decks"
REFERENCE = ROOT / "tests" / "reference"
FOLDERS = ("paper", "flexures", "frameworks", "linkages")
NAMES = [
    path.relative_to(DECKS).with_suffix("").as_posix()
    for path in sorted(DECKS.rglob("*.dat"))
    if path.relative_to(DECKS).parts[0] != "broken"
]
GOLDEN = (1.0 + math.sqrt(5.0)) / 2.0


def test_every_folder_has_decks() -> None:
    assert {name.split("/")[0] for name in NAMES} == set(FOLDERS)


@pytest.mark.parametrize("name", NAMES)
def test_a_deck_gives_its_reference(name: str) -> None:
    reference = REFERENCE / f"{name}.json"
    assert reference.is_file(), f"{name}.dat has no reference"
    answer = answer_of(flexact.analyse(DECKS / f"{name}.dat"))
    assert differences(answer_in(answer_bytes(reference), reference), answer) == ()


def test_every_reference_has_a_deck() -> None:
    answers = {
        path.relative_to(REFERENCE).with_suffix("").as_posix()
        for folder in FOLDERS
        for path in (REFERENCE / folder).rglob("*.json")
    }
    assert answers == set(NAMES)


# The twelve trusses of Fig. 2


@pytest.fixture(scope="module")
def trusses() -> flexact.Analysis:
    return flexact.analyse(DECKS / "paper" / "twelve_trusses.dat")


def test_singular_values_of_the_twelve_trusses(trusses: flexact.Analysis) -> None:
    """Closed forms from the symmetry of the frame, paper section 3.3."""
    expected = [
        math.sqrt(3.0), GOLDEN, GOLDEN, math.sqrt(2.0), 1.0, 1.0, 1.0, 1.0, 1.0, GOLDEN - 1.0,
        GOLDEN - 1.0, 0.0,
    ]  # fmt: skip
    np.testing.assert_allclose(trusses.singular_values, expected, rtol=0.0, atol=1e-14)
    assert (trusses.rows, trusses.columns, trusses.rank) == (12, 12, 11)
    assert trusses.verdict is flexact.Verdict.BOTH


def test_motion_of_the_twelve_trusses(trusses: flexact.Analysis) -> None:
    """Table 2 of the paper, whose column of V has unit norm, up to sign."""
    table = {
        (0.0, -1.0, 1.0): (0.0, -0.5, 0.0),
        (1.0, 0.0, 1.0): (-0.5, 0.0, 0.0),
        (0.0, 1.0, 1.0): (0.0, 0.5, 0.0),
        (-1.0, 0.0, 1.0): (0.5, 0.0, 0.0),
    }
    (motion,) = trusses.motions
    places = map(tuple, trusses.data.arrays.node_value[:3].T.tolist())
    expected = np.array([table.get(place, (0.0, 0.0, 0.0)) for place in places])
    assert np.count_nonzero(expected) == 4
    moved = motion.displacement / np.linalg.norm(motion.vector)
    sign = np.sign(np.sum(expected * moved))
    np.testing.assert_allclose(sign * moved, expected, rtol=0.0, atol=1e-14)
    # Of equal ones the first is one; the others are, but for rounding, which differs by machine.
    sizes = np.abs(motion.displacement)
    assert 1.0 in sizes and sizes.max() == pytest.approx(1.0, rel=4.0e-15)


def test_self_stress_of_the_twelve_trusses(trusses: flexact.Analysis) -> None:
    """All of magnitude sqrt(3)/6, half of them of each sign; paper section 3.3."""
    (stress,) = trusses.self_stresses
    unit = stress.vector / np.linalg.norm(stress.vector)
    np.testing.assert_allclose(np.abs(unit), math.sqrt(3.0) / 6.0, rtol=0.0, atol=1e-14)
    assert np.sum(np.sign(stress.vector)) == 0.0
