"""A deck in which a statement is changed keeps everything else to the letter."""

import difflib

import numpy as np
import pytest
from reference_decks import NAMES, text_of

import flexact
from flexact.analysis.change import Change
from flexact.core.elements import Class, coordinate_name
from flexact.model.data import ModelData
from flexact.model.editing import edited_deck

DECK = """\
% A guide\r
BEAM 1 1 2 3 4   0 1 0 % sheet 1\r
Beam 2 5 6 7 8 0 1 0   # sheet 2 \xb5m\r
BEAM 3 3 4 7 8\r
X 3 0.1 0 0\r
X 5 0 0.05 0\r
X 7 0.1 0.05 0 % end\r
FIX 1\r
FIX 2 2          % first\r
FIX 2 3 4        % second\r
FIX 5\r
FIX 6\r
  rlse 1 2 5 6     # what it leaves free\r
RLSE 2 2 5 6\r
* as in 1995\r
INPUTX 3 2       % by the motor\r
END              % of the kinematics\r
HALT\r
XF 3 1           % the load\r
GRAVITY 0 0 -9.81\r
TIMESTEP 1 100\r
END\r
END\r
VISUALIZATION\r
BEAMPROPS 1 2\r
CROSSDIM 0.0003 0.04 ; thickness, width\r
"""


def read(text: str) -> ModelData:
    return flexact.read_text(text.encode("latin-1")).data


def changes(old: str, new: bytes) -> list[str]:
    lines = difflib.ndiff(old.split("\n"), new.decode("latin-1").split("\n"))
    return [line[0] + line[2:].rstrip("\r") for line in lines if line[0] in "+-"]


@pytest.mark.parametrize(
    ("change", "lines"),
    [
        (Change(), []),
        (
            Change(deformations=((1, 3, Class.DEPENDENT),)),
            [
                "-  rlse 1 2 5 6     # what it leaves free",
                "+  rlse 1 2 3 5 6     # what it leaves free",
            ],
        ),
        (Change(deformations=((3, 2, Class.DEPENDENT),)), ["+RLSE 3 2"]),
        (
            Change(deformations=tuple((1, k, Class.FIXED) for k in (2, 5, 6))),
            ["-  rlse 1 2 5 6     # what it leaves free", "+# what it leaves free"],
        ),
        (
            Change(deformations=((2, 5, Class.INDEPENDENT),)),
            ["-RLSE 2 2 5 6", "+RLSE 2 2 6", "+DYNE 2 5"],
        ),
        (
            Change(coordinates=((2, "ry", Class.DEPENDENT),)),
            [
                "-FIX 2 2          % first",
                "-FIX 2 3 4        % second",
                "+FIX 2 2 4          % first",
                "+% second",
            ],
        ),
        (
            Change(coordinates=((3, "y", Class.FIXED),)),
            ["+FIX 3 2", "-INPUTX 3 2       % by the motor", "+% by the motor"],
        ),
        (
            Change(places=((7, (0.1, 0.06, 0.0)),)),
            ["-X 7 0.1 0.05 0 % end", "+X 7 0.1 0.06 0.0 % end"],
        ),
    ],
)
def test_only_what_changes_is_written_anew(change: Change, lines: list[str]) -> None:
    given = read(DECK)
    made = edited_deck(given, change.apply(given).data)
    assert sorted(changes(DECK, made)) == sorted(lines)
    assert all(line.endswith(b"\r") for line in made.split(b"\n")[:-1])


def test_where_there_is_no_end_statements_stand_at_the_end() -> None:
    text = "TRUSS 1 1 2\nTRUSS 2 2 3\nX 2 1 0 0\nX 3 2 0 0\nFIX 1\nFIX 3"
    for ending in ("", "\n"):
        given = read(text + ending)
        change = Change(coordinates=((2, "y", Class.INDEPENDENT),))
        made = edited_deck(given, change.apply(given).data).decode()
        assert made == f"{text}\nDYNX 2 2{ending}"


def test_a_model_without_a_deck_is_written_as_any() -> None:
    model = flexact.Model(name="one bar")
    model.truss(model.node(0, 0, 0), model.node(1, 0, 0))
    assert edited_deck(model.data, model.data).decode() == model.to_deck()


def test_lines_that_cannot_be_edited_are_written_anew() -> None:
    """A statement that stands twice with other numbers says something else when it is changed."""
    text = "BEAMW 1 1 2 9 3 4 10\nX 3 1 0 0\nFIX 1\nFIX 2\nRLSE 1 5 6\nEND\n"
    given = read(text)
    changed = Change(places=((3, (2.0, 0.0, 0.0)),), deformations=((1, 2, Class.DEPENDENT),))
    model = changed.apply(given)
    again = flexact.read_text(edited_deck(given, model.data)).data
    assert again.arrays.deformation_class.tolist() == model.data.arrays.deformation_class.tolist()
    assert again.arrays.node_value.tolist() == model.data.arrays.node_value.tolist()


def one_of_each(data: ModelData) -> Change:
    """One deformation and one coordinate of each class, in another one."""
    arrays = data.arrays
    deformations, coordinates = [], []
    for old, new in (
        (Class.FIXED, Class.DEPENDENT),
        (Class.DEPENDENT, Class.FIXED),
        (Class.INDEPENDENT, Class.FIXED),
    ):
        for number, element in np.argwhere(arrays.deformation_class == old)[-1:].tolist():
            deformations.append((int(arrays.element_number[element]), number + 1, new))
        for axis, node in np.argwhere(arrays.coordinate_class == old)[:1].tolist():
            name = coordinate_name(int(arrays.node_kind[node]), axis)
            coordinates.append((int(arrays.node_number[node]), name, new))
    return Change(tuple(deformations), tuple(coordinates))


@pytest.mark.parametrize("name", NAMES)
def test_decks_of_the_repository_keep_their_comments(name: str) -> None:
    text = text_of(name)
    given = flexact.read_text(text).data
    assert edited_deck(given, given).decode() == text
    model = one_of_each(given).apply(given)
    made = edited_deck(given, model.data).decode()
    assert 0 < len(changes(text, made.encode("latin-1"))) <= 16
    again = flexact.read_text(made).data
    for one in ("deformation_class", "coordinate_class", "node_value", "element_vector"):
        assert np.array_equal(getattr(again.arrays, one), getattr(model.data.arrays, one))


def test_what_is_said_of_an_element_that_is_left_out_goes_with_it() -> None:
    """Stiffness and mass of a wire, its clamp and its ends, and nothing else of the deck."""
    text = (
        "BEAM 1  1 2 3 4\nBEAM 2  5 6 3 4   % the other\nX 3  0.1 0 0\nX 5  0.2 0.1 0\n"
        "FIX 1\nFIX 2\nFIX 5\nFIX 6\nRLSE 1  2 3\nEND\nHALT\n% stiffness\nESTIFF 1  1 2 3 4\n"
        "ESTIFF 2  5 6 7 8\nEM 2  0.1\nXM 3  0.5\nEND\n"
    )
    given = flexact.read_text(text).data
    edited = edited_deck(given, Change(left_out=(2,)).apply(given).data).decode()
    assert edited == (
        "BEAM 1  1 2 3 4\n% the other\nX 3  0.1 0 0\nFIX 1\nFIX 2\nRLSE 1  2 3\nEND\nHALT\n"
        "% stiffness\nESTIFF 1  1 2 3 4\nXM 3  0.5\nEND\n"
    )
