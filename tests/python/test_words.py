"""The result in words: the verdict first, and remedies that do what they say."""

import math
import re
from pathlib import Path

import numpy as np
import pytest
from known_models import folded_sheet, ring, twelve_trusses

import flexact
from flexact import Model, analyse, remedies
from flexact.log import log_text
from flexact.words import MOST_MODES, describe

DECKS = Path(__file__).resolve().parents[2] / "input_decks"


def text_of(model: Model) -> str:
    return re.sub(r"\s+", " ", describe(analyse(model)))


def test_verdict_comes_first() -> None:
    assert text_of(twelve_trusses()).startswith(
        "twelve trusses Under-constrained by 1 and over-constrained by 1: one motion is held by "
        "nothing and is not declared as a degree of freedom; one self-stress can exist without "
        "any load. "
    )
    assert text_of(ring(5)).startswith(
        "Exactly constrained: every motion is held once or declared, and no self-stress can "
        "exist without load. "
    )
    assert text_of(folded_sheet(clamped=False)).startswith(
        "folded sheet Under-constrained by 6: six motions are held by nothing and are not "
        "declared as degrees of freedom. "
    )
    assert text_of(folded_sheet(clamped=False, beams=3)).startswith(
        "folded sheet Under-constrained by 18: 18 motions are held by nothing "
    )


def test_over_constrained_without_columns() -> None:
    model = Model()
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    model.sheet(a, b, (0, 0, 1), name="leaf <1>")
    model.fix(a)
    model.fix(b)
    text = text_of(model)
    assert text.startswith("Over-constrained by 3: three self-stresses can exist without any load.")
    assert "D(c) has 3 rows and 0 columns; its rank is 0." in text
    assert "element 1 (leaf <1>) e3 bending at p in the local xz plane" in text
    html = analyse(model)._repr_html_()
    assert "leaf &lt;1&gt;" in html and "<1>" not in html


def test_numbers_parts_and_remedies_of_the_fold() -> None:
    text = text_of(folded_sheet(clamped=True))
    assert "D(c) has 6 rows and 6 columns; its rank is 5." in text
    assert "1. node 4 rz " in text
    assert "Motion (kinematically indeterminate; relative values, only their ratios matter)" in text
    assert (
        "If this motion is wanted, declare one of these independent; if not, hold (fix) it: "
        "node 4 rz (DYNX 4 4 or FIX 4 4) Or"
    ) in text
    # references.md: independent bending belongs at the fold, e6 of the first or e5 of the second.
    assert (
        "Or declare or hold one of these released deformations: "
        "element 1 (first) e6 bending at q in the local xy plane (DYNE 1 6 instead of RLSE 1 6); "
        "element 2 (second) e5 bending at p in the local xy plane"
    ) in text
    assert "Self-stress (statically indeterminate; relative values, only their" in text
    assert (
        "To remove it, release one of: "
        "element 1 (first) e3 bending at p in the local xz plane (RLSE 1 3); "
        "element 2 (second) e4 bending at q in the local xz plane Or free a support: "
    ) in text


def test_rank_decision_in_a_line() -> None:
    assert re.search(
        r"Rank decision \(free of units\): smallest non-zero singular value 0\.437, "
        r"largest zero \S+ \(ratio \S+e-1\d\), limit \S+e-1\d\. ",
        text_of(twelve_trusses()),
    )
    assert re.search(r"singular value 0\.\d+, no zeros, limit \S+e-1\d\. ", text_of(ring(5)))


def test_a_zero_has_no_sign() -> None:
    # LAPACK gives -0.0 for this deck's zero.
    analysis = analyse(DECKS / "flexures" / "parallel_guide.dat")
    assert "largest zero 0 (ratio 0), limit" in re.sub(r"\s+", " ", describe(analysis))
    zero = analysis.gap.largest_zero
    assert zero is not None and math.copysign(1.0, zero) == 1.0
    assert not np.signbit(analysis.scaled_singular_values).any()


def test_many_modes_are_counted_on_the_screen_and_told_in_the_log() -> None:
    analysis = analyse(folded_sheet(clamped=True, beams=6))
    for words in (analysis.describe(), describe(analysis, most=MOST_MODES)):
        text = re.sub(r"\s+", " ", words)
        assert "12. node" in text and "13. node" not in text
        assert "... and 19 more motions" in text
    log = re.sub(r"\s+", " ", log_text(analysis))
    assert all(f" {k}. node" in log for k in range(1, 32))
    assert "more motions" not in log
    assert " 3. node" not in describe(analysis, most=2)


def test_lines_stay_short_and_notes_are_told_once() -> None:
    deck = "TRUSS 1 1 2 % " + "long " * 60 + "\nX 2 1 0 0\nX 2 2 0 0\nEND\nXM 2 1\nEND\n"
    analysis = analyse(flexact.read_text(deck))
    text = describe(analysis)
    assert text.count("warning: ") == 1 and text.count("note: ") == 1
    assert describe(analysis, about_model=False) == text[: text.index("\n\nwarning: ")]
    assert "warning: the node has a value already (line 3)" in text
    plain = describe(analyse(folded_sheet(False, 4)))
    assert max(map(len, plain.split("\n"))) <= 100


def test_mechanism_without_extent() -> None:
    model = Model()
    a = model.node(0, 0, 0)
    b = model.hinge(a, (0, 0, 1))
    model.hinge(b, (0, 1, 0))
    analysis = analyse(model)
    assert analysis.under_constrained == 5
    assert "Motions (kinematically indeterminate;" in describe(analysis)
    assert np.isfinite(remedies.coordinates(analysis)).all()


def counts(model: Model) -> tuple[int, int]:
    analysis = analyse(model)
    return analysis.under_constrained, analysis.over_constrained


@pytest.mark.parametrize("make", [twelve_trusses, lambda: folded_sheet(True, 2), lambda: ring(6)])
def test_each_remedy_removes_one(make) -> None:  # type: ignore[no-untyped-def]
    analysis = analyse(make())
    m, s = counts(make())
    for row in remedies.releases(analysis):
        model = make()
        element, deformation = analysis.row_labels[row]
        model.release(element, deformation)
        assert counts(model) == (m, s - 1)
    for column in remedies.coordinates(analysis):
        model = make()
        node, coordinate = analysis.column_labels[column]
        model.independent(node, coordinate)
        assert counts(model) == (m - 1, s)
    for index, deformation in remedies.deformations(analysis):
        model = make()
        model.independent(int(model.element_numbers[index]), deformation)
        assert counts(model) == (m - 1, s)


@pytest.mark.parametrize("beams", [1, 2, 3])
def test_sets_of_remedies_remove_all(beams: int) -> None:
    model = folded_sheet(False, beams)
    analysis = analyse(model)
    for column in remedies.coordinate_set(analysis):
        node, coordinate = analysis.column_labels[column]
        model.independent(node, coordinate)
    assert counts(model) == (0, 0)


def test_release_set_removes_all_self_stresses() -> None:
    def frame() -> Model:
        model = Model()
        corners = [model.node(x, y, 0) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
        for k in range(4):
            model.beam(corners[k], corners[(k + 1) % 4])
        model.fix(corners[0])
        return model

    model = frame()
    analysis = analyse(model)
    assert counts(model) == (0, 6)
    for row in remedies.release_set(analysis):
        model.release(*analysis.row_labels[row])
    assert counts(model) == (0, 0)
