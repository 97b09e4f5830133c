# SPDX-License-Identifier: BSD-3-Clause
"""How certain a rank is: no wrong one may be called certain, and healthy decks are.

Truths come from the stored references (each names its source), from the paper's twelve trusses,
and from geometry that is exact by construction.
"""

import importlib
import json
import sys
from typing import Any

import numpy as np
import pytest
from known_models import guide, ring, rounded, sheet_clamped_twice, twelve_trusses
from large_results import changed
from reference_decks import NAMES, ROOT, text_of, transform, truth_of
from verdicts import assert_right_or_nearly, counts

import flexact
from flexact import Analysis, Model, analyse
from flexact.core.arrays import FloatArray

pytestmark = pytest.mark.dear(120)

sys.path.append(str(ROOT / "tests" / "benchmarks"))
families: Any = importlib.import_module("families")

TURN = transform.about("x", 0.7) @ transform.about("y", -1.1) @ transform.about("z", 2.3)


def codes(analysis: Analysis) -> list[str]:
    """Of the doubts."""
    return [doubt.code for doubt in analysis.assessment.doubts]


@pytest.mark.parametrize("name", NAMES)
def test_every_deck_is_certain(name: str) -> None:
    analysis = analyse(flexact.read_text(text_of(name)))
    assert (analysis.certainty.value, analysis.nearly) == ("numerically certain", None)


@pytest.mark.parametrize("name", NAMES)
def test_lengths_places_and_turns_leave_the_counts(name: str) -> None:
    """The digits printed may be a reason for doubt, but no zero is taken for a tiny value."""
    text, truth = text_of(name), truth_of(name)
    planar = flexact.read_text(text).planar
    length = analyse(flexact.read_text(text)).characteristic_length
    direction = np.array([0.7310585786300049, -0.5963, 0.0 if planar else 0.4123105625617661])
    others = [transform.scaled(text, factor) for factor in (1e-9, 1e-3, 1e3, 1e9)]
    others += [transform.moved(text, far * length * direction) for far in (1.0, 1e4, 1e6, 1e8)]
    others += [transform.turned(text, turn) for turn in (TURN, *random_turns(6))]
    for other in filter(None, others):
        for method in ("svd", "sparse"):
            analysis = analyse(flexact.read_text(other), method=method)
            assert counts(analysis) == truth
            assert analysis.nearly is None or analysis.nearly[:2] == truth
            assert {doubt.code for doubt in analysis.assessment.doubts} <= {"rounded-geometry"}


@pytest.mark.parametrize("letter", ["T", "O", "B", "C"])
@pytest.mark.parametrize("seed", [1, 4, 7])
def test_families_are_certain(letter: str, seed: int) -> None:
    """Self-stresses of T, O and B fade as a sound structure lets them."""
    for columns in (300, 3000):
        case = families.FAMILIES[letter](columns, seed)
        analysis = analyse(case.model)
        assert (counts(analysis), analysis.doubts) == ((case.motions, case.stresses), ())


# Values so small that they count as zero


@pytest.mark.parametrize("power", [15, 16, 17, 18])
def test_an_angle_below_the_rounding_is_proven(power: int) -> None:
    """The bars' directions differ by it, and it is typed: nothing was rounded."""
    analysis = analyse(two_wires(10.0**-power))
    assert (counts(analysis), analysis.certainty.value) == ((0, 0), "numerically certain")
    assert analysis.proof is not None and analysis.proof[1:] == (2, 1, 0.0)
    assert [item.code for item in analysis.warnings] == ["close-decision"]


# In line but for a digit that no double holds.
LONG = "PLTRUSS 1 1 2\nPLTRUSS 2 2 3\nX 1 0 0\nX 2 1 {}\nX 3 3 4.5\nFIX 1\nFIX 3\n"


@pytest.mark.parametrize(
    ("typed", "of"),
    [
        ("1.5", "decimals"),
        ("1.50000000000000000000", "decimals"),
        ("1.5000000000000001", "doubles"),
        ("1.500000000000000000000001", "doubles"),
    ],
)
def test_a_proof_is_of_the_decimals_only_where_they_are_kept(typed: str, of: str) -> None:
    model = flexact.read_text(LONG.format(typed))
    analysis = analyse(model)
    assert analysis.proof is not None
    assert (analysis.proof.of, counts(analysis)) == (of, (1, 1))
    copy = Model.from_data(model.data)
    copy.fix(copy.handle(2))
    for other in (Model.from_data(model.data), analysis.model, copy):
        proof = analyse(other).proof
        assert proof is not None
        assert proof.of == of
    # What is written has the digits of the doubles, and these are typed then.
    proof = analyse(flexact.read_text(model.to_deck())).proof
    assert proof is not None
    assert proof.of == "decimals"


def test_digits_of_orientations_do_not_matter_for_a_proof() -> None:
    """D(c) does not depend on them; those of vectors do matter."""
    deck = "HINGE 1 1 2 {}\nX 2 0.70710678118654752 0.70710678118654752 0 0\nFIX 1\n"
    for vector, of in (("0 0 1", "decimals"), ("0 0.10000000000000001 1", "doubles")):
        proof = analyse(flexact.read_text(deck.format(vector))).proof
        assert proof is not None
        assert proof.of == of


def test_no_angle_at_all_is_certain() -> None:
    analysis = analyse(two_wires(0.0))
    assert (counts(analysis), analysis.doubts) == ((1, 1), ())


# Digits


def random_turns(number: int) -> list[FloatArray]:
    random = np.random.default_rng(20110)
    return [np.linalg.qr(random.normal(size=(3, 3)))[0] for _ in range(number)]


@pytest.mark.parametrize("digits", [3, 4, 5, 6, 7, 8])
@pytest.mark.parametrize("kind", ["e", "f"])
def test_rounded_trusses_of_the_paper_are_nearly_both(digits: int, kind: str) -> None:
    form = f".{digits - 1}e" if kind == "e" else f".{digits}f"
    for turn in random_turns(40):
        analysis = analyse(rounded(twelve_trusses(), turn, form))
        if counts(analysis) == (1, 1):
            # The digits happen to close.
            assert analysis.proof is not None and analysis.proof.rank == analysis.rank
        else:
            assert analysis.certainty is flexact.Certainty.DOUBTFUL
            assert analysis.nearly[:2] == (1, 1)
            assert analysis.nearly.under_constrained == 1


def test_digits_explain_a_value_that_is_not_zero() -> None:
    analysis = analyse(rounded(twelve_trusses(), TURN, ".3e"))
    assert counts(analysis) == (0, 0)
    (doubt,) = analysis.assessment.doubts
    assert (doubt.code, doubt.values) == ("rounded-geometry", 1)
    assert [item.code for item in analysis.warnings] == [doubt.code]
    data = json.loads(analysis.to_json())
    assert data["certainty"] == "doubtful"
    assert data["nearly"] == {"under_constrained": 1, "over_constrained": 1}


@pytest.mark.parametrize("digits", [3, 4, 6])
@pytest.mark.parametrize("n", [3, 5])
def test_rounded_rings_of_odd_number_stay_certain(n: int, digits: int) -> None:
    """Tarnai 1980: they are rigid, by far more than any rounding."""
    for turn in random_turns(10):
        analysis = analyse(rounded(ring(n), turn, f".{digits - 1}e"))
        assert (counts(analysis), analysis.certainty.value) == ((0, 0), "numerically certain")


@pytest.mark.parametrize("digits", [3, 4, 6, 11])
@pytest.mark.parametrize("n", [4, 6])
def test_rounded_rings_of_even_number_are_right_or_nearly(n: int, digits: int) -> None:
    for turn in random_turns(10):
        analysis = analyse(rounded(ring(n), turn, f".{digits - 1}e"))
        assert_right_or_nearly(analysis, (1, 1))


def test_zeros_that_count_because_of_digits_are_nearly() -> None:
    analysis = analyse(rounded(twelve_trusses(), TURN, ".10e"))
    assert counts(analysis) == (1, 1)
    assert analysis.nearly[:2] == (0, 0)
    assert [item.code for item in analysis.warnings] == ["rounded-coordinates"]


def test_joints_of_a_lattice_are_meant() -> None:
    """A row of braced squares, at 100, 101, ...: three digits, and every bar is one long."""
    for start in (0.0, 100.0, 12345.0):
        model = Model(planar=True)
        low = [model.node(start + i, 0) for i in range(6)]
        high = [model.node(start + i, 1) for i in range(6)]
        for i in range(6):
            if i:
                model.truss(low[i], high[i])
            if i < 5:
                model.truss(low[i], low[i + 1])
                model.truss(high[i], high[i + 1])
                model.truss(low[i], high[i + 1])
        model.fix(low[0])
        model.fix(high[0])
        analysis = analyse(model)
        assert (counts(analysis), analysis.certainty.value) == ((0, 0), "numerically certain")


# Small angles, many beams


def two_wires(angle: float, shift: float = 0.0) -> Model:
    model = Model(planar=True)
    a, b = model.node(shift, -shift), model.node(shift, angle - shift)
    c = model.node(1.0 + shift, -shift)
    for end in (a, b):
        model.truss(end, c)
        model.fix(end)
    return model


@pytest.mark.parametrize("power", range(1, 14))
def test_two_wires_at_an_angle_are_right_or_nearly(power: int) -> None:
    analysis = analyse(two_wires(10.0**-power))
    assert_right_or_nearly(analysis, (0, 0))
    assert counts(analysis) == (0, 0)
    if power <= 11:
        assert analysis.certainty is flexact.Certainty.CERTAIN


@pytest.mark.parametrize("shift", [1e2, 1e4, 1e6, 1e8])
@pytest.mark.parametrize("power", range(1, 8))
def test_two_wires_far_from_the_origin_are_right_or_nearly(power: int, shift: float) -> None:
    """Down to an angle that the stored coordinates still hold to a few bits."""
    if 10.0**-power > 2e-16 * 8 * shift:
        analysis = analyse(two_wires(10.0**-power, shift))
        assert_right_or_nearly(analysis, (0, 0))


@pytest.mark.parametrize("size", [0.06, 60.0, 6e4])
@pytest.mark.parametrize("beams", [1, 16, 64])
def test_guide_of_many_beams_in_any_unit(beams: int, size: float) -> None:
    """Each further beam of a sheet adds three internal motions (paper, section 4.2)."""
    analysis = analyse(guide(beams, size))
    assert counts(analysis) == (1 + 6 * (beams - 1), 1)
    assert analysis.certainty is flexact.Certainty.CERTAIN


# What else leaves a doubt


def test_a_tolerance_that_was_given_is_honest() -> None:
    model = two_wires(1e-4)
    analysis = analyse(model, tolerance=1e-3)
    assert counts(analysis) == (1, 1)
    assert analysis.nearly[:2] == (0, 0)
    assert codes(analysis) == ["given-tolerance"]
    assert [item.code for item in analysis.warnings] == ["given-tolerance"]
    assert analyse(model, tolerance=1e-6).certainty is flexact.Certainty.CERTAIN


def test_noise_that_counts_because_of_a_tolerance_is_nearly() -> None:
    exact = ring(6)
    analysis = analyse(exact, tolerance=0.0)
    assert_right_or_nearly(analysis, (1, 1))


def test_a_rank_that_is_not_confirmed_is_not_certain() -> None:
    analysis = analyse(ring(5))
    estimate = changed(analysis, confirmed=False, proven_rank=-1)
    assert (counts(estimate), estimate.nearly[:2]) == ((0, 0), (1, 1))
    assert codes(estimate) == ["unconfirmed-rank"]


def test_nothing_is_in_doubt_without_columns() -> None:
    analysis = analyse(sheet_clamped_twice())
    assert (analysis.certainty.value, analysis.nearly, analysis.doubts) == (
        "numerically certain",
        None,
        (),
    )
