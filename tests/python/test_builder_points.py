# SPDX-License-Identifier: BSD-3-Clause
"""Points of the builder: vectors, arrays, names, places; and what is told of wrong ones."""

import dataclasses

import numpy as np
import pytest
from wrong_use import code_of

import flexact
from flexact import Model, ModelError


@pytest.mark.parametrize(
    "given",
    [
        (1.0, 2.0, 3.0),
        ((1, 2, 3),),
        ([1, 2, 3],),
        (np.array([1.0, 2.0, 3.0]),),
        (np.array([1, 2, 3], np.float32),),
    ],
)
def test_a_point_is_three_numbers_or_a_vector(given: tuple[object, ...]) -> None:
    node = Model().node(*given)  # type: ignore[arg-type]
    assert node.place == (1.0, 2.0, 3.0)


def test_a_vector_of_two_is_in_the_plane_z_0() -> None:
    assert Model().node((1, 2)).place == (1, 2, 0)
    assert Model(planar=True).node(np.array([1, 2])).place == (1, 2)


@pytest.mark.parametrize("bad", [(1,), (1, 2, 3, 4), "abc", {1, 2, 3}, np.zeros((3, 3)), 5, None])
def test_no_places(bad: object) -> None:
    with pytest.raises(ModelError) as error:
        Model().node(bad)  # type: ignore[arg-type]
    assert code_of(error) == "bad-number"


def test_places_stand_for_points() -> None:
    """The same place is the same point, without one there is a new one."""
    model = Model()
    a = model.node(0, 0, 0)
    wire = model.wire((0, 0, 0), np.array([1, 0, 0]))
    model.wire([1, 0, 0], (1.0, 1.0, 0.0))
    assert wire.nodes[0] == a
    assert model.positions[model.node_kinds == 2].tolist() == [[0, 0, 0], [1, 0, 0], [1, 1, 0]]
    other = model.node(1, 0, 0)
    assert other != wire.nodes[1], "node() always makes a point"
    assert model.point((1, 0, 0)) == wire.nodes[1], "the first that was made"


def test_names_of_points_stand_for_points() -> None:
    model = Model()
    a, b = model.node(0, 0, 0, name="clamp 1"), model.node((1, 0, 0), name="stage 1")
    sheet = model.sheet("clamp 1", "stage 1", "z", name="sheet 1")
    model.fix("clamp 1")
    model.independent("stage 1", "y")
    assert sheet.nodes == (a, b) == (model.point("clamp 1"), model.point("stage 1"))
    assert model.coordinate_classes.tolist() == [[1, 1, 1], [1, 1, 1], [2, 3, 2], [2, 2, 2]]


def test_an_unknown_name_is_told_with_the_nearest() -> None:
    model = Model()
    for name in ("clamp 1", "clamp 2", "stage"):
        model.node(0, 0, 0, name=name)
    for call in (
        lambda: model.fix("clmp 1"),
        lambda: model.sheet("stage", "clmp 1", "z", name="sheet 1"),
        lambda: model.point("clmp 1"),
        lambda: model.fix("stage", "clmp 1"),
    ):
        with pytest.raises(ModelError) as error:
            call()
        (problem,) = error.value.diagnostics
        assert "'clmp 1'" in problem.message
        assert "'clamp 1'" in problem.help and "'stage'" not in problem.help


def test_two_points_with_one_name_are_not_guessed_between() -> None:
    model = Model()
    model.node(0, 0, 0, name="clamp")
    model.node(1, 0, 0, name="clamp")
    with pytest.raises(ModelError) as error:
        model.fix("clamp")
    assert code_of(error) == "ambiguous-name"


@pytest.mark.parametrize("name", ["x", "rz", 5, None])
def test_no_names_of_points(name: object) -> None:
    with pytest.raises(ModelError) as error:
        Model().node(0, 0, 0, name=name)  # type: ignore[arg-type]
    assert code_of(error) == "bad-name"


def test_several_points_are_fixed_at_once() -> None:
    model = Model()
    model.wire((0, 0, 0), (1, 0, 0))
    model.fix((0, 0, 0), (1, 0, 0), "x", "rx")
    assert model.coordinate_classes.tolist() == [[1, 2, 2]] * 4
    model.fix((0, 0, 0), (1, 0, 0))
    assert model.coordinate_classes.tolist() == [[1, 1, 1]] * 4


def test_a_place_without_a_point_cannot_be_fixed() -> None:
    model = Model()
    model.wire((0, 0, 0), (1, 0, 0))
    for call in (
        lambda: model.fix((1, 0, 2e-9)),
        lambda: model.independent((2, 0, 0), "x"),
        lambda: model.point((2, 0, 0)),
    ):
        with pytest.raises(ModelError) as error:
            call()
        assert code_of(error) == "no-such-point"


def test_points_and_parts_are_not_mixed_up() -> None:
    model = Model()
    model.sheet((0, 0, 0), (1, 0, 0), "z", name="sheet 1")
    for call in (
        lambda: model.independent("sheet 1", "y"),
        lambda: model.fix("sheet 1"),
        lambda: model.fix(model.part("sheet 1")),  # type: ignore[arg-type]
    ):
        with pytest.raises(ModelError) as error:
            call()
        assert code_of(error) == "not-a-node"


def test_what_is_fixed_with_a_wrong_point_is_not_fixed() -> None:
    model = Model()
    a = model.wire((0, 0, 0), (1, 0, 0)).nodes[0]
    for wrong in ((9, 9, 9), "clamp", 99, Model().node(0, 0, 0)):
        with pytest.raises(ModelError):
            model.fix(a, wrong)  # type: ignore[arg-type]
    assert (model.coordinate_classes == 2).all()


def test_handles_are_readable_comparable_and_frozen() -> None:
    model = Model()
    clamp = model.node(0, 0, 0, name="clamp 1")
    sheet = model.sheet(clamp, (0.1, 0, 0), "z", beams=4, name="sheet 1")
    assert repr(clamp) == "<Point 'clamp 1' at (0, 0, 0)>"
    assert repr(sheet) == "<Sheet 'sheet 1' from 'clamp 1' to (0.1, 0, 0), 4 beams>"
    wire = model.wire(clamp, sheet.nodes[-1])
    assert repr(wire) == "<Wire from 'clamp 1' to (0.1, 0, 0)>"
    body = model.body([sheet.nodes[-1], (0.1, 0, 1)], name="stage")
    assert repr(body) == "<Body 'stage' through (0.1, 0, 0), (0.1, 0, 1)>"
    assert model.part("sheet 1") == sheet and model.part("stage") == body
    assert len({clamp, sheet, wire, body, model.part("sheet 1")}) == 4, "hashable"
    with pytest.raises(dataclasses.FrozenInstanceError):
        clamp.position = 5  # type: ignore[misc]
    for part in (sheet, wire, body):
        with pytest.raises(dataclasses.FrozenInstanceError):
            part.elements = ()  # type: ignore[misc]
    model.rename(clamp, "foot")
    assert repr(sheet) == "<Sheet 'sheet 1' from 'foot' to (0.1, 0, 0), 4 beams>"


def test_handles_of_another_model_are_refused() -> None:
    other = Model()
    sheet = other.sheet((0, 0, 0), (1, 0, 0), "z", name="sheet 1")
    body = other.body([(1, 0, 0), (1, 1, 0)], name="stage")
    model = Model()
    model.sheet((0, 0, 0), (1, 0, 0), "z")
    for call in (
        lambda: model.release(sheet, "twist"),
        lambda: model.fix(body),
        lambda: model.body([body]),
        lambda: model.delete(sheet),
        lambda: model.look(sheet, opacity=1),
    ):
        with pytest.raises(ModelError) as error:
            call()
        assert code_of(error) == "other-model"


def test_the_old_calls_of_a_deck_model_take_names_too() -> None:
    model = flexact.read_text(
        "BEAM 1 1 2 3 4 0 1 0 % sheet 1\nX 3 1 0 0\nFIX 1\nFIX 2\nRLSE 1 2 5 6"
    )
    model.release("sheet 1", "in-plane bending", at="p")
    assert model.deformation_classes.tolist() == [[1, 2, 2, 1, 2, 2]]
    assert model.part("sheet 1").name == "sheet 1"
