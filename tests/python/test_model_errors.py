"""What the builder says to wrong use: a ModelError with a code, at once."""

import numpy as np
import pytest

import flexact
from flexact import Model, ModelError


def code_of(error: pytest.ExceptionInfo[ModelError]) -> str:
    return error.value.diagnostics[0].code


WRONG_USE = {
    "component-out-of-range": lambda m, a, b, e: m.fix(a, "w"),
    "class-conflict": lambda m, a, b, e: (m.fix(a, "x"), m.independent(a, "x")),
    "other-model": lambda m, a, b, e: m.truss(a, Model().node(0, 0, 0)),
    "no-such-element": lambda m, a, b, e: m.release(99, 1),
    "no-such-node": lambda m, a, b, e: m.fix(99, "x"),
    "two-kinds-of-node": lambda m, a, b, e: m.truss(a.orientation, b),
    "bad-number": lambda m, a, b, e: m.node(float("nan"), 0, 0),
    "zero-vector": lambda m, a, b, e: m.beam(a, b, y=(0, 0, 0)),
    "missing-vector": lambda m, a, b, e: m.hinge(a),
    "not-a-point": lambda m, a, b, e: m.wire(1, 3),
    "ambiguous-number": lambda m, a, b, e: m.independent(1),
    "two-positions": lambda m, a, b, e: m.hinge(a, (0, 0, 1), b),
    "out-of-range": lambda m, a, b, e: m.sheet(a, b, (0, 0, 1), beams=0),
    "not-an-element": lambda m, a, b, e: m.release(a, 1),
    "not-a-node": lambda m, a, b, e: m.fix(e),
}


@pytest.mark.parametrize("code", WRONG_USE)
def test_wrong_use_is_a_model_error_at_once(code: str) -> None:
    model = Model()
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    element = model.truss(a, b)
    with pytest.raises(ModelError) as error:
        WRONG_USE[code](model, a, b, element)
    assert code_of(error) == code
    assert str(error.value).startswith(f"error[{code}]: ")


@pytest.mark.parametrize(
    "bad",
    ["a", 5, (1, 2), (1, 2, "q"), [[1], [2], [3]], "123", b"123", {1, 2, 3}, {1: 0, 2: 0, 3: 0}],
)
def test_bad_vectors_are_model_errors(bad: object) -> None:
    model = Model()
    with pytest.raises(ModelError, match="three numbers"):
        model.beam(model.node(0, 0, 0), model.node(1, 0, 0), y=bad)  # type: ignore[arg-type]


def test_coordinates_in_quotes_are_refused() -> None:
    for bad in (("1", 0, 0), (0, b"1", 0), (0, 0, 1j)):
        with pytest.raises(ModelError, match="the position must be three numbers"):
            Model().node(*bad)  # type: ignore[arg-type]
    assert Model().node(np.float32(1), np.int64(2), True).position == 1


@pytest.mark.parametrize("bad", [5, b"bar", ["x"], None])
def test_names_are_text(bad: object) -> None:
    with pytest.raises(ModelError, match="the name of a model must be text, not "):
        Model(name=bad)  # type: ignore[arg-type]
    model = Model()
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    named = {
        "an element": (
            lambda: model.truss(a, b, bad),  # type: ignore[arg-type]
            lambda: model.beam(a, b, name=bad),  # type: ignore[arg-type]
            lambda: model.wire(a, b, name=bad),  # type: ignore[arg-type]
            lambda: model.rigid(a, b, name=bad),  # type: ignore[arg-type]
            lambda: model.hinge(a, (0, 0, 1), name=bad),  # type: ignore[arg-type]
        ),
        "a sheet": (
            lambda: model.sheet(a, b, (0, 0, 1), 2, bad),  # type: ignore[arg-type]
        ),
    }
    for what, calls in named.items():
        for call in calls:
            with pytest.raises(ModelError, match=f"the name of {what} must be text, not ") as error:
                call()
            assert code_of(error) == "bad-name"
    assert model.element_numbers.size == 0
    assert model.node(0, 0, 0).position == 5, "no node was added"


@pytest.mark.parametrize("parts", [2.0, "2", None])
def test_number_of_beams_is_whole(parts: object) -> None:
    model = Model()
    with pytest.raises(ModelError, match="the number of beams must be a whole number, not "):
        model.sheet(
            model.node(0, 0, 0),
            model.node(1, 0, 0),
            (0, 0, 1),
            parts,  # type: ignore[arg-type]
        )


def test_wrong_use_changes_nothing() -> None:
    model = Model()
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    wire = model.beam(a, b)
    model.independent(a, "y")
    model.independent(wire, 3)
    for wrong in (lambda: model.fix(a), lambda: model.release(wire)):
        with pytest.raises(ModelError, match="two classes"):
            wrong()
    assert model.coordinate_classes[0].tolist() == [2, 3, 2]
    assert model.deformation_classes[0].tolist() == [1, 1, 3, 1, 1, 1]


def test_deformation_out_of_range() -> None:
    model = Model()
    bar = model.truss(model.node(0, 0, 0), model.node(1, 0, 0))
    with pytest.raises(ModelError, match="element 1 has no deformation 2"):
        model.release(bar, 2)


def test_core_checks_are_model_errors() -> None:
    model = Model()
    a, b, c = model.node(1, 1, 1), model.node(1, 1, 1), model.node(2, 1, 1)
    model.truss(a, b)
    model.beam(a, c, y=(-3, 0, 0))
    model.truss(a, a)
    for call in (flexact.analyse, flexact.jacobian, Model.check):
        with pytest.raises(ModelError) as error:
            call(model)
        codes = [item.code for item in error.value.diagnostics]
        assert codes == ["zero-length", "parallel-vector", "same-node"]
        assert "TRUSS 1" in str(error.value)


def test_a_width_along_the_sheet_is_told_where_it_is_given() -> None:
    model = Model()
    a, b = model.node(1, 1, 1), model.node(2, 1, 1)
    with pytest.raises(ModelError) as error:
        model.sheet(a, b, width=(2, 0, 0))
    assert code_of(error) == "parallel-vector"
    assert "width" in str(error.value)
    assert model.element_numbers.size == 0


def test_a_beam_with_a_wrong_release_is_not_made() -> None:
    model = Model()
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    for wrong, code in (((2, 7), "component-out-of-range"), (3, "bad-number"), ("x", "bad-number")):
        with pytest.raises(ModelError) as error:
            model.beam(a, b, release=wrong)  # type: ignore[arg-type]
        assert code_of(error) == code
    assert model.element_numbers.size == 0


def test_a_name_is_not_taken_for_planar() -> None:
    with pytest.raises(TypeError):
        Model("guide")  # type: ignore[misc]


def test_a_model_can_be_looked_at_while_it_is_made() -> None:
    model = Model()
    a, b, c = (model.node(x, 0, 0) for x in range(3))
    for node in (a, b, c):
        model.fix(node)
    assert repr(model) == "<flexact model: 0 nodes, 0 elements>"
    model.truss(a, b)
    assert model.positions.tolist() == [[0, 0, 0], [1, 0, 0]]
    assert [item.code for item in model.diagnostics] == ["no-such-node"]
    with pytest.raises(ModelError, match="no element uses it"):
        model.to_deck()
    model.truss(b, c)
    assert model.diagnostics == ()


def test_class_of_a_node_that_nobody_uses() -> None:
    model = Model()
    a, b, c = model.node(0, 0, 0), model.node(1, 0, 0), model.node(2, 0, 0)
    model.truss(a, b)
    model.fix(a)
    assert model.coordinate_classes[0].tolist() == [1, 1, 1]
    model.fix(c)
    with pytest.raises(ModelError, match=f"node {c.position} .* no element uses it"):
        flexact.analyse(model)
    other = Model()
    a, b = other.node(0, 0, 0), other.node(1, 0, 0)
    other.truss(a, b)
    other.fix(a, "rx")
    with pytest.raises(ModelError, match=f"node {a.orientation} "):
        flexact.analyse(other)
