# SPDX-License-Identifier: BSD-3-Clause
"""The shape of a result: bases, labels, JSON, warnings, errors."""

import dataclasses
import json
import pickle
import re
from pathlib import Path

import numpy as np
import pytest
from known_models import folded_sheet, ring, twelve_trusses
from verdicts import DENSE

import flexact
from flexact import Model, analyse
from flexact.util import machine as memory


def test_gap_and_tolerance_stand_on_both_sides_of_the_decision() -> None:
    analysis = analyse(twelve_trusses())
    small, zero = analysis.gap
    assert small is not None and zero is not None
    assert zero <= analysis.tolerance < small
    assert small == analysis.scaled_singular_values[10]
    full = analyse(ring(3))
    assert full.gap.largest_zero is None
    assert full.gap.smallest_nonzero == full.scaled_singular_values[-1]


def test_condition_number() -> None:
    analysis = analyse(ring(3))
    wanted = np.linalg.cond(analysis.dense_jacobian())
    assert analysis.condition_number == pytest.approx(wanted, rel=1e-12)


@pytest.mark.parametrize("model", [twelve_trusses(), ring(5), folded_sheet(False, 3)])
def test_bases_span_the_null_spaces_of_the_dense_jacobian(model: Model) -> None:
    analysis = analyse(model)
    d = analysis.dense_jacobian()
    assert d.shape == (analysis.rows, analysis.columns)
    assert np.abs(np.linalg.svd(d)[1] - analysis.singular_values).max() < 1e-13
    for mode in analysis.motions:
        assert np.abs(d @ mode.vector).max() < 1e-13
    for stress in analysis.self_stresses:
        assert np.abs(stress.vector @ d).max() < 1e-13
    for modes in (analysis.motions, analysis.self_stresses):
        if modes:
            basis = np.array([mode.vector for mode in modes])
            assert np.linalg.matrix_rank(basis) == len(modes)


def test_labels_are_numbers_and_names() -> None:
    analysis = analyse(folded_sheet(clamped=False))
    assert analysis.row_labels == ((1, 1), (1, 3), (1, 4), (2, 1), (2, 3), (2, 4))
    assert analysis.column_labels[:7] == (
        *((3, c) for c in "xyz"),
        *((4, c) for c in ("rx", "ry", "rz")),
        (5, "x"),
    )


def test_json_has_the_agreed_names_and_reads_back_exactly() -> None:
    analysis = analyse(twelve_trusses(), name="decks/twelve.dat")
    text = analysis.to_json()
    assert "\n" not in text
    read = json.loads(text)
    assert list(read) == [
        *("format", "deck", "flexact", "units", "verdict", "under_constrained", "over_constrained"),
        *("margin", "margins", "accuracy", "usual_accuracy", "degrees_of_freedom", "counts"),
        *("characteristic_length", "rank", "rows", "columns", "method", "connected_components"),
        *("tolerance", "bound", "gap", "singular_values", "singular_values_given"),
        *("condition_number", "certainty", "proof", "nearly", "alternatives", "parts"),
        *("taken_as_one", "internal_motions", "bodies", "held_inside", "freedoms"),
        *("motions", "self_stresses", "advice", "warnings"),
    ]
    assert read["deck"] == "decks/twelve.dat"
    assert read["flexact"] == flexact.__version__
    assert read["verdict"] == "under-constrained and over-constrained"
    assert (read["method"], read["tolerance"]) == ("svd", analysis.tolerance)
    assert read["singular_values"] == analysis.singular_values.tolist()
    assert read["singular_values_given"] == "all"
    assert read["condition_number"] is None
    wanted = {"total": 24, "fixed": 12, "dependent": 12, "independent": 0}
    assert read["counts"]["coordinates"] == wanted
    (motion,) = read["motions"]
    assert {(c["node"], c["coordinate"]) for c in motion["components"]} >= {(9, "y"), (11, "x")}
    of_nine = [c["value"] for c in motion["components"] if (c["node"], c["coordinate"]) == (9, "y")]
    assert of_nine == [analysis.motions[0].displacement[4, 1]]
    (stress,) = read["self_stresses"]
    assert list(stress["components"][0]) == [
        *("element", "name", "keyword", "deformation", "word", "value", "unit", "raw"),
    ]
    assert [c["raw"] for c in stress["components"]] == analysis.self_stresses[0].vector.tolist()


def test_json_of_an_empty_matrix() -> None:
    model = Model()
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    model.truss(a, b)
    model.fix(a)
    model.fix(b)
    read = json.loads(analyse(model).to_json())
    assert read["singular_values"] == [] and read["condition_number"] is None
    (component,) = read["self_stresses"][0]["components"]
    assert (component["element"], component["deformation"]) == (1, 1)
    assert abs(component["value"]) == 1


def test_warnings_of_the_deck_are_in_the_json() -> None:
    deck = "TRUSS 1 1 2\nX 2 1 0 0\nX 2 2 0 0\nFIX 1\n"
    analysis = analyse(flexact.read_text(deck, "a.dat"))
    (warning,) = json.loads(analysis.to_json())["warnings"]
    assert (warning["severity"], warning["line"], warning["column"]) == ("warning", 3, 3)
    assert set(warning) == {"code", "severity", "line", "column", "message"}


def test_close_decision_is_warned_of() -> None:
    # Two wires at an angle of 1e-7: full rank in exact arithmetic
    # (tests/reference/known_answers.md, Numerics).
    model = Model(planar=True)
    a, b, c = model.node(0, 0), model.node(0, 1e-7), model.node(1, 0)
    for end in (a, b):
        model.truss(end, c)
        model.fix(end)
    analysis = analyse(model)
    assert analysis.verdict is flexact.Verdict.EXACT
    assert [item.code for item in analysis.warnings] == ["close-decision"]
    assert analyse(twelve_trusses()).warnings == ()


def turned_trusses(digits: int) -> Model:
    """The twelve trusses turned, their coordinates given with so many digits."""
    turn = np.linalg.qr([[3.0, 1.0, 2.0], [1.0, 4.0, -1.0], [-2.0, 1.0, 5.0]])[0]
    exact = twelve_trusses()
    model = Model()
    nodes = [
        model.node(*(float(f"{part:.{digits - 1}e}") for part in turn @ place))
        for place in exact.positions
    ]
    for p, _, q, _ in exact.element_nodes.tolist():
        model.truss(nodes[p], nodes[q])
    for node in nodes[:4]:
        model.fix(node)
    return model


def test_zeros_of_rounded_coordinates_are_warned_of() -> None:
    rounded, full = analyse(turned_trusses(11)), analyse(turned_trusses(17))
    assert rounded.rank == full.rank == 11
    assert [item.code for item in rounded.warnings] == ["rounded-coordinates"]
    assert full.warnings == ()
    zero = rounded.gap.largest_zero
    assert zero is not None and rounded.raw.noise < zero <= rounded.tolerance
    assert f"{zero:.1e}" in rounded.warnings[0].message
    assert 0.0 < full.raw.noise < 1e-13


def test_changing_the_model_of_a_result_leaves_the_result_whole() -> None:
    analysis = analyse(twelve_trusses())
    before = analysis.describe(), analysis.dense_jacobian()
    model = analysis.model
    model.truss(1, model.node(0, 0, 5))
    model.release(1)
    model.fix(model.handle(9), "z")
    assert analysis.describe() == before[0]
    assert np.array_equal(analysis.dense_jacobian(), before[1])
    assert analysis.model.element_numbers.size == 12
    assert analyse(model).rows == 12, "one bar more, one released"


def test_json_holds_no_half_characters() -> None:
    # A path of bytes that are no UTF-8, as os.fsdecode gives it on POSIX.
    analysis = analyse(twelve_trusses(), name="d\udcff\x1b[2J\n\u00e9.dat")
    text = analysis.to_json()
    assert "\n" not in text and "\x1b" not in text
    assert json.loads(text)["deck"] == "d\\udcff\x1b[2J\n\u00e9.dat"
    for words in (repr(analysis), analysis.describe(), analysis._repr_html_()):
        words.encode()
        assert "\x1b" not in words and "[2J\n" not in words


def test_analysis_is_frozen() -> None:
    analysis = analyse(twelve_trusses())
    with pytest.raises(dataclasses.FrozenInstanceError):
        analysis.name = "other"  # type: ignore[misc]
    for array in (analysis.singular_values, analysis.motions[0].vector):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1.0


@pytest.mark.parametrize("method", ["auto", *DENSE])
def test_too_large_for_the_memory(method: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(memory, "_SMALL", 0)
    monkeypatch.setattr(memory, "available", lambda: 1e3)
    with pytest.raises(flexact.AnalysisError) as error:
        analyse(twelve_trusses(), method=method)
    assert re.findall(r"\d+", str(error.value))[:2] == ["12", "12"]


def test_path_and_name(tmp_path: Path) -> None:
    path = tmp_path / "twelve.dat"
    path.write_text(twelve_trusses().to_deck())
    assert analyse(path).name == str(path)
    assert analyse(str(path), name="short").name == "short"


def test_results_travel_between_processes() -> None:
    analysis = analyse(twelve_trusses())
    again = pickle.loads(pickle.dumps(analysis))
    assert again.to_json() == analysis.to_json()
    for array in (
        again.raw.motions.value,
        again.data.arrays.node_value,
        again.motions[0].displacement,
    ):
        assert not array.flags.writeable
    matrix = pickle.loads(pickle.dumps(flexact.jacobian(again.model)))
    assert not matrix.values.flags.writeable
    assert np.array_equal(matrix.toarray(), flexact.jacobian(analysis.model).toarray())
    with pytest.raises(flexact.DeckError) as error:
        flexact.read_text("TRUS 1 1 2", "a.dat")
    assert str(pickle.loads(pickle.dumps(error.value))) == str(error.value)


# What newcomers type


def test_a_verdict_is_compared_with_its_word() -> None:
    """As the command has it, and in its own words; a verdict is a key like its words."""
    words = {"exact": "EXACT", "under": "UNDER", "over": "OVER", "both": "BOTH"}
    for word, name in words.items():
        verdict = flexact.Verdict[name]
        assert verdict.word == word
        for other in words:
            assert (verdict == other) is (other == word)
            assert (verdict != other) is (other != word)
        assert verdict == verdict.value and {verdict.value: 1}[verdict] == 1
        assert pickle.loads(pickle.dumps(verdict)) is flexact.Verdict(verdict.value) is verdict
        assert sum(each == verdict for each in flexact.Verdict) == 1


def test_a_mode_that_is_not_there_is_refused_with_how_many_there_are() -> None:
    model = flexact.Model(planar=True)
    model.truss((0, 0), (1, 0))
    model.fix((0, 0))
    analysis = flexact.analyse(model)
    assert len(analysis.motions) == 1
    with pytest.raises(IndexError, match="there is 1 motion: none has the index 1; they count"):
        analysis.motions[1]
    with pytest.raises(IndexError, match="there are no self-stresses: none has the index 0"):
        analysis.self_stresses[0]
    assert analysis.self_stresses[:3] == () and analysis.motions[-1] == analysis.motions[0]


def test_a_model_of_a_name_says_how_it_is_made() -> None:
    with pytest.raises(TypeError, match=r"Model\(name='x.dat'\).*flexact.read\('x.dat'\)"):
        flexact.Model("x.dat")


@pytest.mark.parametrize(
    "name", ["::set-output name=a::b", "##[error]x", " ::warning::x", "a ##[b]"]
)
def test_no_line_is_a_command_of_a_service(name: str) -> None:
    """GitHub takes lines that begin with two colons for commands, and ##[ wherever it stands."""
    model = flexact.Model(name=name)
    model.truss((0, 0, 0), (1, 0, 0), name=name)
    model.sheet((0, 0, 0), (0, 1, 0), width=(0, 0, 1), name=name * 5)
    words = flexact.analyse(model).describe()
    assert "##[" not in words
    assert not [line for line in words.splitlines() if line.lstrip().startswith("::")]
