# SPDX-License-Identifier: BSD-3-Clause
"""Wrong use of the builder: a ModelError with a code, at once, and nothing is changed.

The words of each stand in golden/messages.
"""

import numpy as np
import pytest
from wrong_use import ARGUMENTS, BUILDER, Call, code_of, each, two_nodes_and_a_bar

import flexact
from flexact import Model, ModelError


@pytest.mark.parametrize(("code", "call"), each(BUILDER))
def test_wrong_use_is_a_model_error_at_once(code: str, call: Call) -> None:
    model, a, b, bar = two_nodes_and_a_bar()
    with pytest.raises(ModelError) as error:
        call(model, a, b, bar)
    assert code_of(error) == code
    assert str(error.value).startswith(f"error[{code}]: ")
    assert model.element_numbers.tolist() == [1]


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(
    ("kind", "call"), [(kind, call) for kind, calls in ARGUMENTS.items() for call in calls]
)
def test_wrong_arguments_are_told_in_words(kind: type[Exception], call: Call) -> None:
    """Words of Flexact's own, and not too many of them."""
    model, a, b, bar = two_nodes_and_a_bar()
    with pytest.raises(kind) as error:
        call(model, a, b, bar)
    assert error.type is kind
    assert 10 < len(str(error.value)) < 300
    assert model.element_numbers.tolist() == [1]


@pytest.mark.parametrize(
    "bad",
    ["a", 5, (1, 2), (1, 2, "q"), [[1], [2], [3]], "123", b"123", {1, 2, 3}, {1: 0, 2: 0, 3: 0}],
)
def test_bad_vectors_are_model_errors(bad: object) -> None:
    model = Model()
    with pytest.raises(ModelError) as error:
        model.beam(model.node(0, 0, 0), model.node(1, 0, 0), y=bad)  # type: ignore[arg-type]
    assert code_of(error) == "bad-number"


def test_coordinates_in_quotes_are_refused() -> None:
    for bad in (("1", 0, 0), (0, b"1", 0), (0, 0, 1j)):
        with pytest.raises(ModelError) as error:
            Model().node(*bad)  # type: ignore[arg-type]
        assert code_of(error) == "bad-number"
    assert Model().node(np.float32(1), np.int64(2), True).position == 1


@pytest.mark.parametrize("bad", [5, b"bar", ["x"], None])
def test_names_are_text(bad: object) -> None:
    model = Model()
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    for call in (
        lambda: Model(name=bad),  # type: ignore[arg-type]
        lambda: model.truss(a, b, bad),  # type: ignore[arg-type]
        lambda: model.beam(a, b, name=bad),  # type: ignore[arg-type]
        lambda: model.wire(a, b, name=bad),  # type: ignore[arg-type]
        lambda: model.rigid(a, b, name=bad),  # type: ignore[arg-type]
        lambda: model.hinge(a, (0, 0, 1), name=bad),  # type: ignore[arg-type]
        lambda: model.sheet(a, b, (0, 0, 1), 2, bad),  # type: ignore[arg-type]
    ):
        with pytest.raises(ModelError) as error:
            call()
        assert code_of(error) == "bad-name"
    assert model.element_numbers.size == 0
    assert model.node(0, 0, 0).position == 5, "no node was added"


@pytest.mark.parametrize("parts", [2.0, "2", None])
def test_number_of_beams_is_whole(parts: object) -> None:
    model = Model()
    with pytest.raises(ModelError) as error:
        model.sheet(
            model.node(0, 0, 0),
            model.node(1, 0, 0),
            (0, 0, 1),
            parts,  # type: ignore[arg-type]
        )
    assert code_of(error) == "bad-number"


def test_wrong_use_changes_nothing() -> None:
    model = Model()
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    wire = model.beam(a, b)
    model.independent(a, "y")
    model.independent(wire, 3)
    for wrong in (lambda: model.fix(a), lambda: model.release(wire)):
        with pytest.raises(ModelError) as error:
            wrong()
        assert code_of(error) == "class-conflict"
    assert model.coordinate_classes[0].tolist() == [2, 3, 2]
    assert model.deformation_classes[0].tolist() == [1, 1, 3, 1, 1, 1]


@pytest.mark.parametrize("planar", [False, True])
@pytest.mark.parametrize("where", ["same", "twin", "place", "name"])
def test_an_element_between_a_point_and_itself_is_refused_where_it_is_made(
    where: str, planar: bool
) -> None:
    """Each method that makes an element between two points, however the points are given."""
    place = (1.0, 2.0) if planar else (1.0, 2.0, 3.0)
    model = Model(planar=planar)
    a = model.node(place, name="a")
    b: object = {"same": a, "place": place, "name": "a"}.get(where) or model.node(place)
    made: dict[str, tuple[object, ...]] = {
        **{name: (a, b) for name in ("truss", "beam", "rigid", "wire")},
        "sheet": (a, b, None if planar else "y"),
        "hinge": (a, None if planar else "z", b),
    }
    for name, ends in made.items():
        if name == "hinge" and where == "twin":
            continue
        with pytest.raises(ModelError) as error:
            getattr(model, name)(*ends, name="it")
        assert code_of(error) in ("same-node", "zero-length"), name
        assert f"{name} 'it'" in str(error.value)
        assert not len(model.element_numbers)
    # A point beyond a hinge is another one, at the same place.
    beyond = model.hinge(a, None if planar else "z")
    with pytest.raises(ModelError, match="give two"):
        model.beam(a, beyond, name="it")


def _twice(make: str, joined: bool) -> Model:
    """Two parts of the same name, apart or with a node in common, made one way or another."""
    model = Model()
    a, b, d = model.node(0, 0, 0), model.node(0, 0, 1), model.node(1, 0, 1)
    c = b if joined else model.node(1, 0, 0)
    for p, q in ((a, b), (c, d)):
        if make == "sheets":
            model.sheet(p, q, "y", beams=3, name="s")
        elif make == "sheet":
            model.sheet(p, q, "y", name="s")
        elif make == "body":
            points = [model.pivot(p), model.pivot(q), model.node(3 + p.position, 1, 1)]
            model.body(points, "s")
        else:
            getattr(model, make)(p, q, name="s")
    return model


@pytest.mark.parametrize("joined", [False, True])
@pytest.mark.parametrize("make", ["body", "sheets", "sheet", "wire", "truss", "beam"])
def test_two_of_one_name_are_told_and_the_name_finds_neither(make: str, joined: bool) -> None:
    """As test_silent_mistakes has it of parts that do not hang together: here also of others."""
    model = _twice(make, joined)
    (told,) = [each for each in model.diagnostics if each.code == "repeated-name"]
    assert "'s'" in told.message and told.help and not told.is_error
    with pytest.raises(ModelError, match="another name") as error:
        model.part("s")
    assert code_of(error) == "ambiguous-name"


def test_parts_of_several_elements_have_one_name() -> None:
    model = Model()
    model.sheet((0, 0, 0), (0, 0, 1), "y", beams=4, name="s")
    stage = model.body([(0, 0, 1), (1, 0, 1), (0, 1, 1)], "stage")
    model.body([stage, (2, 0, 1)])
    model.body([(2, 0, 1), (3, 0, 1)], "stage")
    model.folded_sheet((1, 0, 1), (1, 0, 2), (2, 0, 2), "y", name="fold")
    guide = model.parallel_guide((9, 0, 0), (9, 0, 1), (1, 0, 0), name="g")
    model.fix(*guide.ground)
    model.pattern(3, "z", at=(-5, 0, 0), parts=["s"])
    assert "repeated-name" not in [each.code for each in model.diagnostics]
    assert len(model.part("stage").nodes) == 5


def test_core_checks_are_model_errors() -> None:
    model = Model()
    a, b, c = model.node(1, 1, 1), model.node(1, 1, 2), model.node(2, 1, 1)
    model.truss(a, b)
    model.beam(a, c, y=(-3, 0, 0))
    # What the builder would refuse comes about later.
    model.move(b, (1, 1, 1))
    for call in (flexact.analyse, flexact.jacobian, Model.check):
        with pytest.raises(ModelError) as error:
            call(model)
        codes = [item.code for item in error.value.diagnostics]
        assert codes == ["zero-length", "parallel-vector"]
        named = ("TRUSS 1", "BEAM 2")
        for item, element in zip(error.value.diagnostics, named, strict=True):
            assert element in item.message


def test_a_width_along_the_sheet_is_told_where_it_is_given() -> None:
    model = Model()
    a, b = model.node(1, 1, 1), model.node(2, 1, 1)
    with pytest.raises(ModelError) as error:
        model.sheet(a, b, width=(2, 0, 0))
    assert code_of(error) == "parallel-vector"
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
    assert repr(model)
    model.truss(a, b)
    assert model.positions.tolist() == [[0, 0, 0], [1, 0, 0]]
    assert [item.code for item in model.diagnostics] == ["no-such-node"]
    with pytest.raises(ModelError) as error:
        model.to_deck()
    assert code_of(error) == "no-such-node"
    model.truss(b, c)
    assert model.diagnostics == ()


def test_class_of_a_node_that_nobody_uses() -> None:
    model = Model()
    a, b, c = model.node(0, 0, 0), model.node(1, 0, 0), model.node(2, 0, 0)
    model.truss(a, b)
    model.fix(a)
    assert model.coordinate_classes[0].tolist() == [1, 1, 1]
    model.fix(c)
    with pytest.raises(ModelError) as error:
        flexact.analyse(model)
    assert code_of(error) == "no-such-node"
    assert f"node {c.position} " in error.value.diagnostics[0].message
    other = Model()
    a, b = other.node(0, 0, 0), other.node(1, 0, 0)
    other.truss(a, b)
    other.fix(a, "rx")
    with pytest.raises(ModelError) as error:
        flexact.analyse(other)
    assert code_of(error) == "no-such-node"
    assert f"node {a.orientation} " in error.value.diagnostics[0].message
