"""Loads: kept from decks and from Python, copied, moved and written again to the last bit."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import flexact
from flexact.model.data import Loads

MODEL = "BEAM 7 1 2 3 4\nTRUSS 9 3 5\nX 3 1 0 0\nX 5 1 1 0\nFIX 1\nFIX 2\nFIX 5\n"
PLANAR = "PLBEAM 1 1 2 3 4\nX 3 1 0\nFIX 1\nFIX 2\n"
numbers = st.floats(allow_nan=False, allow_infinity=False)


def loads_of(model: flexact.Model) -> Loads:
    loads = model.data.loads
    assert loads is not None
    return loads


def at(model: flexact.Model, number: int, table: np.ndarray) -> list[float]:
    row: list[float] = table[model.node_index(number)].tolist()
    return row


def read(dynamics: str, model: str = MODEL) -> flexact.Model:
    return flexact.read_text(f"{model}END\nHALT\n{dynamics}\nEND\nEND\n")


def test_a_deck_without_them_has_none() -> None:
    assert flexact.read_text(MODEL).data.loads is None
    assert read("XF 3 0 0 0\nGRAVITY 0 0").data.loads is None


@pytest.mark.parametrize("keyword", ["XF", "xf", "FORCE", "Force"])
def test_statements_are_kept_and_no_longer_unused(keyword: str) -> None:
    model = read(f"{keyword} 3 1 -2.5d0 .3\n{keyword} 4 0 0 7\nDELXF 5 4\nGRAVITY 0 0 -9.81")
    loads = loads_of(model)
    assert at(model, 3, loads.force) == [1.0, -2.5, 0.3]
    assert at(model, 4, loads.force) == [0.0, 0.0, 7.0]
    assert at(model, 5, loads.increment) == [4.0, 0.0, 0.0]
    assert np.count_nonzero(loads.force) == 4
    assert np.count_nonzero(loads.increment) == 1
    assert loads.gravity.tolist() == [0.0, 0.0, -9.81]
    assert not loads.force.flags.writeable
    assert model.diagnostics == ()


def test_a_planar_moment_is_about_z() -> None:
    model = read("XF 3 0.5 -14\nXF 4 2\nGRAVITY 0 -9.81", PLANAR)
    loads = loads_of(model)
    assert at(model, 3, loads.force) == [0.5, -14.0, 0.0]
    assert at(model, 4, loads.force) == [0.0, 0.0, 2.0]
    assert loads.gravity.tolist() == [0.0, -9.81, 0.0]
    assert model.diagnostics == ()


@pytest.mark.parametrize(
    ("dynamics", "column"),
    [
        ("XF 3 1 2 3 4", 12),
        ("XF 3 1 2 3 0", 0),
        ("DELXF 4 0 0 0 1", 15),
        ("GRAVITY 0 0 -9.81 1", 19),
    ],
)
def test_numbers_without_a_meaning_are_warned_of(dynamics: str, column: int) -> None:
    found = [(d.code, d.line, d.column) for d in read(dynamics).diagnostics]
    assert found == ([("surplus-operand", 10, column)] if column else [])


def test_euler_parameters_have_no_moments() -> None:
    """Four numbers at an orientation may be dual to them: none is taken for a moment."""
    model = read("XF 4 1 2 3 4\nXF 3 1")
    assert at(model, 4, loads_of(model).force) == [0.0, 0.0, 0.0]


def test_the_last_statement_counts_and_both_are_shown() -> None:
    model = read("XF 3 1 2 3\nFORCE 3 4\nDELXF 3 1\nGRAVITY 1 2 3\nGRAVITY 0 0 4")
    assert at(model, 3, loads_of(model).force) == [4.0, 0.0, 0.0]
    assert loads_of(model).gravity.tolist() == [0.0, 0.0, 4.0]
    assert [(d.code, d.line) for d in model.diagnostics] == [
        ("repeated-value", 11),
        ("repeated-value", 14),
    ]
    assert [d.other.line for d in model.diagnostics if d.other] == [10, 13]


@pytest.mark.parametrize(
    ("dynamics", "code"),
    [
        ("XF 8 1", "no-such-node"),
        ("DELXF 3", "missing-operand"),
        ("GRAVITY 9.81", "missing-operand"),
        ("FORCE 3 much", "bad-number"),
        ("GRAVITY 0 0 inf", "not-finite"),
    ],
)
def test_what_is_wrong_is_an_error(dynamics: str, code: str) -> None:
    with pytest.raises(flexact.DeckError) as caught:
        read(dynamics)
    assert [item.code for item in caught.value.diagnostics] == [code]


def test_they_are_written_again() -> None:
    model = read("XF 3 1 2 3\nXF 4 0 0 7\nDELXF 5 4\nGRAVITY 0 0 -9.81")
    again = flexact.read_text(model.to_deck())
    assert again.diagnostics == ()
    assert again.to_deck() == model.to_deck()
    for name in ("force", "increment", "gravity"):
        assert np.array_equal(getattr(loads_of(model), name), getattr(loads_of(again), name))
    model.release(7, 1)
    assert np.array_equal(loads_of(model).force, loads_of(again).force)


@given(st.tuples(numbers, numbers, numbers), st.tuples(numbers, numbers, numbers), numbers)
def test_a_model_is_written_to_the_last_bit(
    f: tuple[float, float, float], m: tuple[float, float, float], g: float
) -> None:
    model = flexact.Model()
    model.beam((0, 0, 0), (1, 0, 0))
    model.fix((0, 0, 0))
    model.force((1, 0, 0), *f)
    model.moment((1, 0, 0), m, increment=True)
    model.gravity(0, g)
    said, read_back = model.data.loads, flexact.read_text(model.to_deck()).data.loads
    assert (said is None) == (read_back is None) == (not any((*f, *m, g)))
    if said is not None and read_back is not None:
        assert said.force[2].tolist() == list(f) == read_back.force[2].tolist()
        assert said.increment[3].tolist() == list(m) == read_back.increment[3].tolist()
        assert said.gravity[1] == g == read_back.gravity[1]


def test_bodies_names_places_and_numbers_will_do() -> None:
    model = flexact.Model()
    model.sheet((0, 0, 0), (0.1, 0, 0), width="z")
    model.body([(0.1, 0, 0), (0.1, 0.05, 0)], name="stage")
    point = model.node(0.1, 0.05, 0.05, name="tip")
    model.body(["stage", point])
    model.fix((0, 0, 0))
    model.force("stage", 1, 2, 3)
    model.moment("stage", [0, 0, 4])
    model.force("tip", 5, 6)
    model.moment(point.orientation, 7, 0, 0)
    loads = loads_of(model)
    stage = model.point((0.1, 0, 0))
    assert at(model, stage.position, loads.force) == [1, 2, 3]
    assert at(model, stage.orientation, loads.force) == [0, 0, 4]
    assert at(model, point.position, loads.force) == [5, 6, 0]
    # The far end of a rigid link has an orientation where somebody needs it.
    assert at(model, point.orientation, loads.force) == [7, 0, 0]
    assert model.diagnostics == ()
    model.force("stage", 0, 0, 0)
    assert at(model, stage.position, loads_of(model).force) == [0, 0, 0]


@pytest.mark.parametrize(
    ("give", "code"),
    [
        (lambda m: m.force("tip", 1, 2, math.nan), "bad-number"),
        (lambda m: m.force("tip", 1), "bad-number"),
        (lambda m: m.force("tip", "123"), "bad-number"),
        (lambda m: m.force("tipp", 1, 2), "no-such-point"),
        (lambda m: m.moment(m.point("tip").position, 1, 2, 3), "two-kinds-of-node"),
        (lambda m: m.force(m.point("tip").orientation, 1, 2, 3), "two-kinds-of-node"),
        (lambda m: m.gravity(math.inf, 0), "bad-number"),
    ],
)
def test_what_python_cannot_mean(give: object, code: str) -> None:
    model = flexact.Model()
    model.wire((0, 0, 0), model.node(1, 0, 0, name="tip"))
    with pytest.raises(flexact.ModelError) as caught:
        give(model)  # type: ignore[operator]
    assert caught.value.diagnostics[0].code == code
    assert model.data.loads is None, "nothing has changed"


def test_a_planar_model_has_one_moment() -> None:
    model = flexact.Model(planar=True)
    model.wire((0, 0), model.node(1, 0, name="tip"))
    model.force("tip", 1, 2)
    model.moment("tip", 3)
    assert loads_of(model).force.tolist()[:2] == [[1, 2, 0], [0, 0, 3]]
    for give in (
        lambda: model.force("tip", 1, 2, 3),
        lambda: model.moment("tip", 1, 2, 3),
        lambda: model.gravity(0, 0, 1),
    ):
        with pytest.raises(flexact.ModelError):
            give()


def loaded() -> flexact.Model:
    model = flexact.Model()
    model.wire((0, 0, 0), model.node(1, 0, 0, name="tip"), name="wire")
    model.fix((0, 0, 0))
    model.force("tip", 1, 2, 3)
    model.moment("tip", 4, 5, 6)
    model.force("tip", 7, 8, 9, increment=True)
    model.gravity(0, 0, -9.81)
    return model


def all_of(model: flexact.Model, place: tuple[float, float, float]) -> list[list[float]]:
    point = model.point(place)
    loads = loads_of(model)
    return [
        at(model, point.position, loads.force),
        at(model, point.orientation, loads.force),
        at(model, point.position, loads.increment),
    ]


def test_copies_turn_with_their_loads() -> None:
    model = loaded()
    model.pattern(2, "z")
    assert all_of(model, (1, 0, 0)) == [[1, 2, 3], [4, 5, 6], [7, 8, 9]]
    assert all_of(model, (-1, 0, 0)) == [[-1, -2, 3], [-4, -5, 6], [-7, -8, 9]]
    assert loads_of(model).gravity.tolist() == [0, 0, -9.81]


def test_a_mirror_image_reverses_moments() -> None:
    """A moment is a rotation by nature: its image in a plane keeps its part across it."""
    model = loaded()
    model.mirror("yz")
    assert all_of(model, (-1, 0, 0)) == [[-1, 2, 3], [4, -5, -6], [-7, 8, 9]]


def test_what_is_turned_or_put_in_turns() -> None:
    model = loaded()
    model.rotate("z", 90)
    assert all_of(model, (0, 1, 0)) == [[-2, 1, 3], [-5, 4, 6], [-8, 7, 9]]
    other = flexact.Model()
    other.wire((0, 0, 5), (0, 0, 6))
    other.insert(loaded(), (0, 0, 0))
    assert all_of(other, (1, 0, 0)) == [[1, 2, 3], [4, 5, 6], [7, 8, 9]]
    assert not loads_of(other).gravity.any()


def test_loads_at_one_place_add_up() -> None:
    model = loaded()
    model.mirror("yz", at=(1, 0, 0))
    assert all_of(model, (1, 0, 0))[0] == [1, 2, 3], "what lies on itself is not doubled"
    model = loaded()
    model.pattern(2, step=(1, 0, 0))
    assert all_of(model, (1, 0, 0))[0] == [1, 2, 3]
    assert all_of(model, (2, 0, 0))[0] == [1, 2, 3]


def test_deleted_points_take_theirs_along() -> None:
    model = loaded()
    model.truss((0, 0, 0), (0, 1, 0))
    model.delete("wire")
    assert [d.code for d in model.diagnostics if "load" in d.message] == ["unused-node"]
    model.delete("tip")
    assert [d.code for d in model.diagnostics if "load" in d.message] == []
    assert not loads_of(model).force.any()


def test_moved_and_held_models_keep_them() -> None:
    model = loaded()
    moved = model.with_positions(model.positions + 0.1)
    assert at(moved, model.point("tip").position, loads_of(moved).force) == [1, 2, 3]
    held = model.with_held(model.deformation_classes > 0)
    assert all_of(held, (1, 0, 0))[1] == [4, 5, 6]


def test_the_verdict_is_the_same() -> None:
    heavy = loaded()
    plain = flexact.read_text(MODEL)
    pulled = read("XF 3 1 2 3\nGRAVITY 0 0 -9.81")
    assert flexact.analyse(plain).verdict is flexact.analyse(pulled).verdict
    assert flexact.analyse(heavy).degrees_of_freedom is not None


def test_arrays_of_another_shape_are_refused() -> None:
    with pytest.raises(ValueError, match="shape"):
        Loads(np.zeros((2, 2)), np.zeros((2, 2)), np.zeros(3))
    with pytest.raises(ValueError, match="shape"):
        Loads(np.zeros((2, 3)), np.zeros((1, 3)), np.zeros(3))
    with pytest.raises(ValueError, match="finite"):
        Loads(np.zeros((2, 3)), np.zeros((2, 3)), np.array([0.0, np.inf, 0.0]))
