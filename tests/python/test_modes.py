# SPDX-License-Identifier: BSD-3-Clause
"""Motions and self-stresses as a row of modes, and results that do not give all of them."""

import json
import pickle
import re
from itertools import pairwise

import numpy as np
import pytest
from known_models import folded_sheet, twelve_trusses
from large_results import changed, first_of

import flexact
from flexact import Motion, analyse
from flexact.advice.describe import MOST_MODES, describe
from flexact.show import mesh
from flexact.show.spacar_log import log_text


def test_modes_are_like_a_tuple() -> None:
    motions = analyse(folded_sheet(False)).motions
    assert len(motions) == 6 and [mode.index for mode in motions] == list(range(6))
    assert motions[-1].index == 5
    assert motions[1:3] == (motions[1], motions[2]) and isinstance(motions[1:3], tuple)
    assert motions[2] in motions
    assert motions == tuple(motions) and motions != motions[:5]
    for index in (6, -7):
        with pytest.raises(IndexError):
            motions[index]
    assert all(repr(mode) in repr(motions) for mode in motions)
    assert {motions, motions[:]} and isinstance(motions[0], Motion)


def test_modes_of_different_results_differ() -> None:
    one, other = (analyse(twelve_trusses()).motions for _ in range(2))
    assert one != other and one[0] != other[0]
    assert one == one[0].analysis.motions


def test_modes_travel_between_processes() -> None:
    motions = analyse(folded_sheet(False)).motions
    again = pickle.loads(pickle.dumps(motions))
    assert len(again) == 6
    assert np.array_equal(again[2].displacement, motions[2].displacement)


def test_largest_parts_are_those_of_the_whole_vector() -> None:
    analysis = analyse(folded_sheet(False))
    for motion in analysis.motions:
        labels, vector = analysis.column_labels, motion.vector
        values = {label: value for label, value in zip(labels, vector, strict=True)}
        weight = {c: analysis.characteristic_length if c[0] == "r" else 1.0 for _, c in labels}
        reported = motion.largest(100)
        assert all(values[node, c] == value for node, c, value in reported)
        sizes = [abs(value) * weight[c] for _, c, value in reported]
        assert sizes == pytest.approx(sorted(sizes, reverse=True), rel=1e-8)
        assert sizes[0] == pytest.approx(max(abs(v) * weight[c] for (_, c), v in values.items()))


def test_vectors_that_are_left_out_are_reported() -> None:
    whole = analyse(folded_sheet(False, beams=4))
    assert whole.under_constrained == 24
    part = changed(whole, motions=first_of(whole.raw.motions, 3))
    assert part.under_constrained == 24 and len(part.motions) == 3
    read = json.loads(part.to_json())
    assert read["motions_given"] == 3 and len(read["motions"]) == 3
    assert list(read).index("motions_given") == list(read).index("motions") - 1
    assert "self_stresses_given" not in read and "motions_given" not in whole.to_dict()
    for text in (describe(part), log_text(part)):
        assert numbers_reported(text) == [1, 2, 3]
    assert numbers_reported(describe(whole, most=2)) == [1, 2]


def numbers_reported(text: str) -> list[int]:
    """The numbers before the modes that are reported one by one."""
    return [int(number) for number in re.findall(r"^ +(\d+)\. ", text, re.MULTILINE)]


def test_many_modes_are_counted_on_the_screen_and_told_in_the_log() -> None:
    # Two bars in a row between supports stress each other, and a chain of fifteen hangs beside.
    model = flexact.Model(planar=True)
    points = [model.node(float(x), 0.0) for x in (-1, 0, 1)]
    for p, q in pairwise(points):
        model.truss(p, q)
    model.fix(points[0])
    model.fix(points[2])
    chain = [model.node(5.0, -float(y)) for y in range(16)]
    for p, q in pairwise(chain):
        model.truss(p, q)
    model.fix(chain[0])
    analysis = analyse(model)
    assert (analysis.under_constrained, analysis.over_constrained) == (16, 1)
    assert numbers_reported(describe(analysis, most=MOST_MODES, verbose=True)) == [*range(1, 13), 1]
    # On a screen there are fewer.
    assert numbers_reported(analysis.describe()) == [1, 2, 3, 1]
    assert "... and 13 more motions" in analysis.describe()
    assert numbers_reported(log_text(analysis)) == [*range(1, 17), 1]


def test_motions_inside_of_sheets_are_counted_and_not_told_one_by_one() -> None:
    analysis = analyse(folded_sheet(clamped=True, beams=6))
    assert (analysis.under_constrained, analysis.over_constrained) == (31, 1)
    text = analysis.describe()
    assert "30 of these motions are internal to the first and the second." in text
    assert numbers_reported(text) == [1, 1]


def test_notes_about_a_deck_are_told_once_or_left_out() -> None:
    deck = "TRUSS 1 1 2\nX 2 1 0 0\nX 2 2 0 0\nFIX 1\nEND\nTIMESTEP 2 1\nEND\n"
    analysis = analyse(flexact.read_text(deck))
    assert [item.code for item in analysis.warnings] == ["repeated-value", "not-used"]
    text = describe(analysis)
    assert all(text.count(item.message) == 1 for item in analysis.warnings)
    short = describe(analysis, about_model=False)
    assert text.startswith(short) and not any(item.message in short for item in analysis.warnings)


def test_text_of_json_is_that_of_the_dictionary() -> None:
    for model in (twelve_trusses(), folded_sheet(True, 3), folded_sheet(False)):
        analysis = analyse(model, name='a "b" \u00e9')
        assert analysis.to_json() == json.dumps(analysis.to_dict())


def test_a_mesh_holds_so_many_modes_that_it_stays_small(monkeypatch: pytest.MonkeyPatch) -> None:
    analysis = analyse(folded_sheet(False, beams=4))
    assert mesh.Meshes(analysis).most_modes >= 24
    plain = log_text(analysis)
    assert log_text(analysis, most_in_mesh=24) == plain
    monkeypatch.setattr(mesh.content, "_NUMBERS", 1)
    names = analysis.to_meshio().point_data
    assert "motion_6" in names and "motion_7" not in names
    log = log_text(analysis, most_in_mesh=mesh.Meshes(analysis).most_modes)
    (line,) = set(log.splitlines()) - set(plain.splitlines())
    assert re.findall(r"\d+", line) == ["6", "24"]
