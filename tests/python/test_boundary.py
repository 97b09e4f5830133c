# SPDX-License-Identifier: BSD-3-Clause
"""The boundary: doubles stay doubles, zero sizes work, wrong shapes are refused by name.

One third cannot be held in single precision: what comes back from it differs in the
ninth digit. f2py makes single precision of kinds that it does not know without a word.
"""

import re
from pathlib import Path

import numpy as np
import pytest

import flexact
from flexact.core import calls
from flexact.core.arrays import model_arrays, packed

THIRD = 1.0 / 3.0
ULP = 2.3e-16


def truss(q: tuple[float, float, float]) -> flexact.Model:
    model = flexact.Model()
    a, b = model.node(0, 0, 0), model.node(*q)
    model.truss(a, b)
    model.fix(a)
    return model


def test_node_value_and_length_are_double() -> None:
    assert truss((THIRD, 0, 0)).data.frames.length[0] == THIRD


def test_singular_values_and_bases_are_double() -> None:
    model = truss((1, 2, 2))
    analysis = flexact.analyse(model)
    direction = np.array([1, 2, 2]) / 3
    assert abs(analysis.singular_values[0] - 1) <= ULP
    basis = analysis.raw.motions.toarray().T
    assert basis.shape == (2, 3)
    assert np.abs(basis @ direction).max() < 4 * ULP
    assert np.abs(basis @ basis.T - np.eye(2)).max() < 4 * ULP


def test_one_entry_is_a_third() -> None:
    model = flexact.Model()
    a, b = model.node(0, 0, 0), model.node(1, 2, 2)
    model.truss(a, b)
    model.fix(a)
    model.fix(b, "y", "z")
    analysis = flexact.analyse(model)
    assert abs(analysis.singular_values[0] - THIRD) <= ULP
    assert abs(flexact.jacobian(model).values - np.array([-1, -2, -2, 1, 2, 2]) / 3).max() <= ULP


def test_self_stress_is_double() -> None:
    # A bar of length 1 and one of length 2 on the same two points: (1, -1) / sqrt(2).
    model = flexact.Model()
    a, b, c = model.node(0, 0, 0), model.node(1, 0, 0), model.node(3, 0, 0)
    model.truss(a, b)
    model.truss(b, c)
    for node in (a, c):
        model.fix(node)
    stress = flexact.analyse(model).raw.stresses.vector(0)
    assert np.abs(np.abs(stress) - np.sqrt(0.5)).max() <= ULP


def test_element_vector_is_double() -> None:
    model = flexact.Model()
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    model.beam(a, b, y=(0, THIRD, 1))
    matrix = flexact.jacobian(model)
    row = matrix.row_labels.index((1, 5))
    of_q = [matrix.column_labels.index((b.position, axis)) for axis in "yz"]
    wanted = np.array([THIRD, 1]) / np.hypot(THIRD, 1)
    assert np.abs(matrix.toarray()[row, of_q] - wanted).max() <= ULP


def test_configuration_and_deformation_are_double() -> None:
    model = truss((1, 0, 0))
    start = model.reference()
    delta = np.zeros((2, 3))
    delta[1, 0] = THIRD
    assert abs(flexact.deformations(model, start.moved(delta))[0] - THIRD) <= 2 * ULP


def test_torsion_constant_is_double() -> None:
    # A quarter turn of q: eq. (4) gives e2 = l0 in size, eq. (3) e1 = c_t / (2 l0).
    model = flexact.Model()
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    model.beam(a, b)
    delta = np.zeros((4, 3))
    delta[model.node_index(b.orientation), 0] = np.pi / 2
    turned = model.reference().moved(delta)
    assert abs(flexact.deformations(model, turned, c_t=THIRD)[0] - THIRD / 2) <= ULP


def test_no_columns() -> None:
    # tests/reference/known_answers.md, Flexures: a sheet clamped at both ends has three
    # self-stresses, and D(c) has no columns.
    model = flexact.Model()
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    model.sheet(a, b, (0, 0, 1))
    model.fix(a)
    model.fix(b)
    analysis = flexact.analyse(model)
    assert (analysis.rows, analysis.columns, analysis.rank) == (3, 0, 0)
    assert (analysis.raw.motions.size, analysis.raw.motions.vectors) == (0, 0)
    assert len(analysis.self_stresses) == 3


def test_no_rows_and_nothing_at_all() -> None:
    model = flexact.Model()
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    bar = model.truss(a, b)
    model.release(bar)
    analysis = flexact.analyse(model)
    assert (analysis.rows, analysis.columns, analysis.under_constrained) == (0, 6, 6)
    model.fix(a)
    model.fix(b)
    analysis = flexact.analyse(model)
    assert (analysis.rows, analysis.columns) == (0, 0)
    assert analysis.verdict is flexact.Verdict.EXACT
    assert analysis.singular_values.size == 0


def empty() -> dict[str, np.ndarray]:
    return {
        "node_number": np.zeros(0, int),
        "node_kind": np.zeros(0, int),
        "node_value": np.zeros((4, 0)),
        "coordinate_class": np.zeros((3, 0), int),
        "element_number": np.zeros(0, int),
        "element_kind": np.zeros(0, int),
        "element_node": np.zeros((4, 0), int),
        "element_vector": np.zeros((3, 0)),
        "deformation_class": np.zeros((6, 0), int),
    }


def test_empty_model_is_counted_and_refused() -> None:
    arrays = model_arrays(**empty())
    count = calls.count_model(packed(arrays))
    assert (count.rows, count.columns, count.counts.sum()) == (0, 0, 0)
    with pytest.raises(flexact.ModelError) as error:
        flexact.analyse(flexact.Model())
    assert [item.code for item in error.value.diagnostics] == ["nothing-to-analyse"]


@pytest.mark.parametrize("name", ["node_value", "coordinate_class", "element_node"])
def test_one_dimension_too_few_is_refused(name: str) -> None:
    with pytest.raises(ValueError, match=name):
        model_arrays(**{**empty(), name: np.zeros(0)})


def test_transposed_array_is_refused() -> None:
    arrays = {key: np.array(value) for key, value in truss((1, 0, 0)).data.arrays._asdict().items()}
    arrays["coordinate_class"] = arrays["coordinate_class"].T
    with pytest.raises(ValueError, match=r"coordinate_class .*\(2, 3\)"):
        model_arrays(**arrays)


def test_wrong_types_are_refused() -> None:
    arrays = truss((1, 0, 0)).data.arrays._asdict()
    with pytest.raises(TypeError, match="node_kind"):
        model_arrays(**{**arrays, "node_kind": np.array([2.0, 2.0])})
    with pytest.raises(TypeError, match="node_value"):
        model_arrays(**{**arrays, "node_value": np.full((4, 2), "x")})
    with pytest.raises(ValueError, match="node_number"):
        model_arrays(**{**arrays, "node_number": np.array([1, 2**31])})


def test_arrays_are_read_only_and_in_fortran_order() -> None:
    for array in truss((1, 0, 0)).data.arrays:
        assert array.flags.f_contiguous
        assert not array.flags.writeable


def test_wrong_configurations_are_refused() -> None:
    model = truss((1, 0, 0))
    other = truss((1, 0, 0))
    other.truss(other.node(0, 0, 1), other.node(0, 1, 1))
    with pytest.raises(ValueError, match="configuration has shape"):
        flexact.deformations(model, other.reference())
    with pytest.raises(ValueError, match="c_t has shape"):
        flexact.deformations(model, model.reference(), c_t=[1.0, 2.0])
    with pytest.raises(ValueError, match="delta has shape"):
        model.reference().moved(np.zeros(6))


def test_sizes_of_diagnostics_are_those_of_the_core() -> None:
    """The boundary must spell its shapes as numbers; the core has names for them."""
    core = Path(__file__).parents[2] / "fortran" / "base" / "flexact_diagnostics.f90"
    stated = dict(re.findall(r"parameter :: (text_length|most_shown) = (\d+)", core.read_text()))
    _, numbers, texts = calls.read_deck(b"TRUSS 1 1 2\n").problems
    assert texts.shape == (int(stated["text_length"]), 4, int(stated["most_shown"]))
    assert numbers.shape == (8, int(stated["most_shown"]))
