# SPDX-License-Identifier: BSD-3-Clause
"""Edits: moved, renamed, deleted; a model that was edited is the one made so at once."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from random_models import mechanism
from wrong_use import code_of

import flexact
from flexact import Model, ModelError, analyse


def guide(beams: int = 1, length: float = 0.1) -> Model:
    model = Model(name="guide")
    made = model.parallel_guide((0, 0, 0), (length, 0, 0), (0, 0.05, 0), beams=beams)
    model.fix(*made.ground)
    model.independent("stage", "y")
    return model


def same(ours: Model, theirs: Model) -> bool:
    return all(
        np.array_equal(a, b) for a, b in zip(ours.data.arrays, theirs.data.arrays, strict=True)
    ) and list(ours.element_names) == list(theirs.element_names)


@pytest.mark.parametrize("beams", [1, 4])
def test_moved_ends_take_the_sheet_along(beams: int) -> None:
    model = guide(beams)
    for k in (1, 2):
        x, y, z = model.point(f"stage {k}").place
        model.move(f"stage {k}", (2 * x, y, z))
    assert same(model, guide(beams, 0.2))


def test_a_moved_point_is_found_at_its_new_place_alone() -> None:
    model = Model()
    a = model.node(0, 0, 0, name="a")
    model.truss(a, (1, 0, 0))
    model.move("a", np.array([0, 5, 0]))
    assert model.point((0, 5, 0)) == a
    with pytest.raises(ModelError) as error:
        model.point((0, 0, 0))
    assert code_of(error) == "no-such-point"


def test_renamed_parts_are_found_by_their_new_names() -> None:
    model = guide(beams=3)
    sheet = model.part("sheet 1")
    model.rename("sheet 1", "leaf")
    model.rename("stage 1", "tip")
    model.rename("stage", "table")
    assert list(model.element_names[:3]) == ["leaf, 1", "leaf, 2", "leaf, 3"]
    assert (model.part("leaf"), model.point("tip").name) == (sheet, "tip")
    assert model.part("table").name == "table"
    with pytest.raises(ModelError) as error:
        model.part("sheet 1")
    assert code_of(error) == "no-such-part"
    folded = model.folded_sheet((0, 0, 0), (0, 0, 1), (0, 1, 1), name="old")
    model.rename(folded, "new")
    assert [leaf.name for leaf in folded.leaves] == ["new, leaf 1", "new, leaf 2"]


def test_names_of_a_part_and_a_point_are_told_apart_by_the_handle() -> None:
    model = Model()
    model.node(0, 0, 0, name="stage")
    model.body(["stage", (1, 0, 0)], name="stage")
    for call in (
        lambda: model.rename("stage", "new"),
        lambda: model.delete("stage"),
        lambda: model.independent("stage"),
    ):
        with pytest.raises(ModelError) as error:
            call()
        assert code_of(error) == "ambiguous-name"
    model.rename(model.part("stage"), "table")
    assert model.point("stage").place == (0, 0, 0)


@pytest.mark.parametrize("beams", [1, 4])
def test_a_deleted_sheet_takes_its_inner_points_along(beams: int) -> None:
    model = guide(beams)
    model.delete("sheet 2")
    assert not [name for name in model.element_names if name.startswith("sheet 2")]
    with pytest.raises(ModelError) as error:
        analyse(model)
    assert code_of(error) == "no-such-node", "its clamp is fixed in vain"
    assert "'ground 2'" in str(error.value)
    model.delete("ground 2")
    analysis = analyse(model)
    # A sheet holds three motions of a body (Blanding 1999): three are left, one declared.
    assert (analysis.under_constrained, analysis.over_constrained) == (2, 0)
    assert model.node_numbers.size == 2 * (2 + 1) - 1 + 2 * (beams - 1)


def test_what_is_left_keeps_names_sections_material_and_classes() -> None:
    model = guide(2)
    model.made_of("sheet 2", "steel", thickness=2e-4, breadth=0.02)
    model.look("stage", colour=(1, 0, 0))
    model.release("sheet 2", "in-plane bending", at="stage 2")
    model.delete("sheet 1")
    assert list(model.element_names) == ["sheet 2, 1", "sheet 2, 2", "stage"]
    assert model.deformation_classes.tolist() == [[1, 2, 1, 1, 2, 2], [1, 3, 1, 2, 3, 3], [1] * 6]
    assert model.data.appearance.dimensions.tolist()[:2] == [[2e-4, 0.02]] * 2
    assert np.nan_to_num(model.data.appearance.colour).tolist() == [[0] * 3, [0] * 3, [1, 0, 0]]
    assert set(model._change().stiffness) == set(model._change().mass) == {0, 1}
    with pytest.raises(ModelError) as error:
        model.independent("sheet 2", "in-plane bending", at="stage 2")
    assert code_of(error) == "class-conflict", "what was stated is remembered"


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32 - 1), st.booleans())
def test_deleting_what_was_added_gives_the_model_back(seed: int, planar: bool) -> None:
    random = np.random.default_rng(seed)
    model = mechanism(random, planar)
    before = model.to_deck() if model.element_numbers.size else ""
    size = 2 if planar else 3
    first = model.element_numbers.size
    ends = [model.node(random.normal(size=size)) for _ in range(3)]
    width = None if planar else random.normal(size=3)
    model.sheet(ends[0], ends[1], width, beams=int(random.integers(1, 5)), name="new sheet")
    model.body(ends, name="new body")
    assert model.element_numbers.size > first
    for name in random.permutation(["new sheet", "new body"]):
        model.delete(str(name))
    for end in ends:
        model.delete(end)
    if before:
        assert model.to_deck() == before
        model.truss(model.node([7] * size), model.node([8] * size))
        assert model.element_numbers.size == first + 1


def test_a_deck_can_be_edited() -> None:
    model = flexact.read("input_decks/flexures/cross_hinge_undeclared.dat")
    model.delete("second sheet")
    model.delete(model.handle(21, 22))
    analysis = analyse(model)
    assert (analysis.under_constrained, analysis.over_constrained) == (3, 0)


def test_clamps_can_be_taken_back() -> None:
    model = guide()
    model.clear("ground 2")
    model.clear("stage", "y")
    model.hold("sheet 2", "twist")
    analysis = analyse(model)
    # Sheet 1 holds three; sheet 2 and its free end add a body that hangs on the stage.
    assert analysis.degrees_of_freedom == 0
    ground = model.point("ground 2")
    rows = [model.node_index(number) for number in (ground.position, ground.orientation)]
    assert model.coordinate_classes[rows].tolist() == [[2, 2, 2]] * 2
    model.fix("ground 2", "x")
    model.clear("ground 2", "x")
    model.independent("ground 2", "x")
    assert model.coordinate_classes[rows].tolist() == [[3, 2, 2], [2, 2, 2]]


Call = Callable[[Model], object]
WRONG: list[tuple[str, Call, str]] = [
    ("in-use", lambda m: m.delete("stage 1"), "'sheet 1', 'stage'"),
    ("no-such-part", lambda m: m.delete("sheet 3"), "sheet 3"),
    ("no-such-point", lambda m: m.move("stage 3", (0, 0, 0)), "stage 3"),
    ("bad-number", lambda m: m.move("stage 1", (0, 0)[:1]), "stage 1"),
    ("bad-name", lambda m: m.rename("stage 1", "rx"), "stage 1"),
    ("bad-name", lambda m: m.rename("sheet 1", 5), "sheet 1"),  # type: ignore[arg-type]
    ("component-out-of-range", lambda m: m.clear("stage 1", "w"), "stage 1"),
    ("no-such-part", lambda m: m.part("shet 1"), "shet 1"),
]


@pytest.mark.parametrize(("code", "call", "said"), WRONG)
def test_wrong_edits_change_nothing(code: str, call: Call, said: str) -> None:
    model = guide()
    with pytest.raises(ModelError) as error:
        call(model)
    assert code_of(error) == code
    assert said in error.value.diagnostics[0].message
    assert same(model, guide())


def test_a_deleted_part_cannot_be_used() -> None:
    model = guide()
    sheet = model.part("sheet 1")
    model.delete(sheet)
    for call in (lambda: model.release(sheet, "twist"), lambda: model.delete(sheet)):
        with pytest.raises(ModelError) as error:
            call()
        assert code_of(error) == "no-such-element"
    assert repr(sheet)
