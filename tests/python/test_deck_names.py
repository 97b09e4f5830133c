"""Names of points and elements: from decks, from Python, and back."""

import pickle

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import flexact
from flexact.model.names import one_line

GUIDE = """\
BEAM 1  1 2 3 4  0 1 0     % first sheet
BEAM 2  5 6 7 8  0 1 0     % second sheet
BEAM 3  3 4 7 8
X 1  0 0 0                 % clamp of the first
X 3  0.1 0 0               # fold 1
X 5  0.0 0.05 0
X 7  0.1 0.05 0            %% Führung, Ende „2“ / 导向
X 8  1 0 0 0               % an orientation
FIX 1
FIX 2
FIX 5
FIX 6
RLSE 1  2 5 6
RLSE 2  2 5 6
"""


def named(model: flexact.Model) -> dict[int, str]:
    numbers = model.node_numbers.tolist()
    return {n: name for n, name in zip(numbers, model.node_names, strict=True) if name}


def test_comments_of_x_lines_are_names() -> None:
    model = flexact.read_text(GUIDE)
    assert named(model) == {
        1: "clamp of the first",
        3: "fold 1",
        7: "Führung, Ende „2“ / 导向",
        8: "an orientation",
    }
    assert model.data.node_names[0] == "clamp of the first"
    assert model.data.node_names[:2] == ("clamp of the first", "")
    assert len(model.data.node_names) == model.node_numbers.size


def test_the_last_named_x_line_counts() -> None:
    deck = "TRUSS 1 1 2\nX 2 1 0 0 % one\nX 2 2 0 0 % other\nX 2 3 0 0\n"
    assert named(flexact.read_text(deck)) == {2: "other"}


def test_names_in_the_old_code_page() -> None:
    model = flexact.read_text("TRUSS 1 1 2\nX 2 1 0 0 % F\xfchrung\n".encode("cp1252"))
    assert named(model) == {2: "Führung"}
    assert named(flexact.read_text(model.to_deck())) == {2: "Führung"}


def test_names_survive_decks_and_changes() -> None:
    model = flexact.read_text(GUIDE)
    again = flexact.read_text(model.to_deck())
    assert again.node_names == model.node_names
    assert again.element_names == model.element_names
    # An orientation that is named has its line, though it is unturned.
    assert "X 8 1.0 0.0 0.0 0.0 % an orientation" in model.to_deck()
    model.release(3, 2)
    assert named(model) == named(again)
    assert named(flexact.read_text(model.to_deck())) == named(again)


def test_names_from_python() -> None:
    model = flexact.Model()
    clamp = model.node(0, 0, 0, name="clamp")
    fold = model.node(1, 0, 0, name="  %fold\n1 ")
    end = model.node(2, 0, 0)
    model.sheet(clamp, fold, (0, 1, 0))
    model.sheet(fold, end, (0, 1, 0), beams=2)
    assert named(model) == {clamp.position: "clamp", fold.position: "fold 1"}
    again = flexact.read_text(model.to_deck())
    assert named(again) == named(model)
    assert f"X {clamp.position} 0.0 0.0 0.0 % clamp" in model.to_deck()
    copy = flexact.Model.from_data(pickle.loads(pickle.dumps(again.data)))
    assert named(copy) == named(model)


def test_a_name_is_text() -> None:
    with pytest.raises(flexact.ModelError) as caught:
        flexact.Model().node(0, 0, 0, name=3)  # type: ignore[arg-type]
    assert caught.value.diagnostics[0].code == "bad-name"


def test_a_model_without_names_has_empty_ones() -> None:
    model = flexact.Model()
    model.truss(model.node(0, 0, 0), model.node(1, 0, 0))
    assert model.node_names == ("", "")
    assert list(model.data.node_names) == ["", ""]


@given(st.text(max_size=40), st.text(max_size=40))
def test_any_text_is_a_name(one: str, other: str) -> None:
    # What means a coordinate names no point.
    assume(not {one_line(one), one_line(other)} & {"x", "y", "z", "rx", "ry", "rz"})
    model = flexact.Model()
    p, q = model.node(0, 0, 0, name=one), model.node(1, 0, 0, name=other)
    model.truss(p, q, other)
    model.fix(p)
    again = flexact.read_text(model.to_deck())
    assert again.node_names == model.node_names
    assert again.element_names == model.element_names
    assert again.to_deck() == model.to_deck()
