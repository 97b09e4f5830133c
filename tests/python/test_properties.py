"""Stiffness and mass: kept from decks and from Python, written again to the last bit."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import flexact
from flexact.model.data import Properties

MODEL = "BEAM 7 1 2 3 4\nTRUSS 9 3 5\nX 3 1 0 0\nX 5 1 1 0\nFIX 1\nFIX 2\nFIX 5\n"
NAN = float("nan")
numbers = st.floats(allow_nan=False, allow_infinity=False)


def given_of(model: flexact.Model) -> Properties:
    properties = model.data.properties
    assert properties is not None
    return properties


def rows(table: np.ndarray) -> list[list[float]]:
    return [[value for value in row if value == value] for row in table.tolist()]


def assert_same(one: Properties | None, other: Properties | None) -> None:
    assert one is not None
    assert other is not None
    for name in ("stiffness", "mass", "node_mass"):
        ours, theirs = getattr(one, name), getattr(other, name)
        assert np.array_equal(ours.view(np.int64), theirs.view(np.int64)) or np.array_equal(
            ours, theirs, equal_nan=True
        ), name


def test_a_deck_without_them_has_none() -> None:
    assert flexact.read_text(MODEL).data.properties is None
    assert flexact.read_text(MODEL + "END\nHALT\nXF 3 1\nEND\nEND\n").data.properties is None


@pytest.mark.parametrize(("em", "xm"), [("EM", "XM"), ("emass", "mass")])
def test_statements_are_kept(em: str, xm: str) -> None:
    deck = f"{MODEL}END\nHALT\nESTIFF 7 2.52E6 2.9D-2 3.36e2 .0189\n{em} 7 0.0936\n"
    deck += f"ESTIFF 9 1e5\n{xm} 3 0.5\n{xm} 4 1 2 3 4 5 6\nTIMESTEP 3 1\nEND\nEND\n"
    model = flexact.read_text(deck)
    properties = given_of(model)
    assert rows(properties.stiffness) == [[2.52e6, 0.029, 336.0, 0.0189], [1e5]]
    assert rows(properties.mass) == [[0.0936], []]
    assert model.node_numbers.tolist() == [1, 2, 3, 4, 5]
    assert rows(properties.node_mass) == [[], [], [0.5], [1, 2, 3, 4, 5, 6], []]
    assert properties.stiffness.shape == (2, 6)
    assert properties.mass.shape == (2, 5)
    assert not properties.stiffness.flags.writeable
    # What is not used any more is counted, and nothing else.
    (note,) = model.diagnostics
    assert note.code == "not-used"
    assert note.message.startswith("1 statement ")


def test_they_are_written_again() -> None:
    model = flexact.read_text(MODEL + "END\nHALT\nESTIFF 9 0.1 -0.0\nEM 7 1 2 3\nXM 5 1e-300\n")
    again = flexact.read_text(model.to_deck())
    assert_same(model.data.properties, again.data.properties)
    assert again.diagnostics == ()
    model.release(9)
    changed = flexact.read_text(model.to_deck())
    assert_same(changed.data.properties, again.data.properties)


def test_with_a_picture() -> None:
    deck = (
        MODEL + "END\nHALT\nEM 7 2\nEND\nVISUALIZATION\nBEAMPROPS 7\nCROSSTYPE CIRC\nCROSSDIM 0.1\n"
    )
    model = flexact.read_text(deck)
    again = flexact.read_text(model.to_deck())
    assert again.diagnostics == ()
    assert_same(model.data.properties, again.data.properties)
    assert again.data.appearance.dimensions.tolist() == [[0.1, 0.1], [0.0, 0.0]]


def test_the_last_statement_counts_and_both_are_shown() -> None:
    model = flexact.read_text(MODEL + "END\nESTIFF 7 1 2 3\nESTIFF 7 4\n")
    assert rows(given_of(model).stiffness) == [[4.0], []]
    (warning,) = model.diagnostics
    assert (warning.code, warning.line, warning.column) == ("repeated-value", 10, 8)
    assert warning.other is not None
    assert warning.other.line == 9


def test_too_many_numbers_are_left_out_with_a_warning() -> None:
    model = flexact.read_text(MODEL + "END\nEM 7 1 2 3 4 5 6 7\n")
    assert rows(given_of(model).mass) == [[1, 2, 3, 4, 5], []]
    (warning,) = model.diagnostics
    assert (warning.code, warning.line, warning.column) == ("surplus-operand", 9, 16)


@pytest.mark.parametrize(
    ("statement", "places"), [("EM 7 1 2 3 4 5 6", []), ("ESTIFF 9 1 2 3 4 5 6 7", [12])]
)
def test_the_number_of_warping_is_that_of_a_beam(statement: str, places: list[int]) -> None:
    """One behind the others, as programs write it for every beam."""
    model = flexact.read_text(f"{MODEL}END\n{statement}\n")
    assert [d.column for d in model.diagnostics] == places


@pytest.mark.parametrize(
    ("statement", "code"),
    [
        ("EM 8 1", "no-such-element"),
        ("XM 8 1", "no-such-node"),
        ("ESTIFF 7", "missing-operand"),
        ("XM 3 much", "bad-number"),
        ("EM 7 inf", "not-finite"),
    ],
)
def test_what_is_wrong_is_an_error(statement: str, code: str) -> None:
    with pytest.raises(flexact.DeckError) as caught:
        flexact.read_text(f"{MODEL}END\n{statement}\n")
    assert [item.code for item in caught.value.diagnostics] == [code]


def built() -> flexact.Model:
    model = flexact.Model()
    p, q = model.node(0, 0, 0), model.node(1, 0, 0)
    model.beam(p, q)
    model.fix(p)
    return model


@given(
    st.lists(numbers, min_size=1, max_size=6),
    st.lists(numbers, min_size=1, max_size=5),
    numbers,
)
def test_a_draft_is_written_to_the_last_bit(e: list[float], m: list[float], x: float) -> None:
    model = built()
    draft = model._change()
    draft.give_properties(0, stiffness=tuple(e))
    draft.give_properties(0, mass=tuple(m))
    draft.give_node_mass(3, (x,))
    properties = given_of(model)
    assert rows(properties.stiffness) == [e]
    assert rows(properties.mass) == [m]
    assert rows(properties.node_mass) == [[], [], [x], []]
    assert_same(properties, flexact.read_text(model.to_deck()).data.properties)


@pytest.mark.parametrize("values", [(), (1.0,) * 7, (NAN,), (float("inf"),)])
def test_a_draft_takes_numbers_alone(values: tuple[float, ...]) -> None:
    model = built()
    draft = model._change()
    for give in (
        lambda: draft.give_properties(0, stiffness=values, mass=(1.0,)),
        lambda: draft.give_properties(0, stiffness=(1.0,), mass=values),
        lambda: draft.give_node_mass(1, values),
    ):
        with pytest.raises(flexact.ModelError) as caught:
            give()
        assert caught.value.diagnostics[0].code == "bad-number"
    assert model.data.properties is None, "nothing has changed"


def test_a_mass_of_an_unused_node_is_warned_of() -> None:
    model = built()
    model._change().give_node_mass(model.node(5, 5, 5).orientation, (1.0,))
    codes = [item.code for item in model.diagnostics]
    assert codes == ["unused-node", "unused-node"]


def test_arrays_that_no_deck_can_say_are_refused() -> None:
    table = np.full((1, 6), NAN)
    table[0, 1] = 1.0
    none = Properties.none(1, 4)
    with pytest.raises(ValueError, match="behind one that is not given"):
        replace(none, stiffness=table)
    with pytest.raises(ValueError, match="shape"):
        replace(none, mass=table)


def test_the_analysis_is_the_same() -> None:
    plain = flexact.analyse(flexact.read_text(MODEL))
    heavy = flexact.analyse(flexact.read_text(MODEL + "END\nESTIFF 7 1 2 3 4\nEM 9 5\nXM 3 1\n"))
    assert plain.verdict is heavy.verdict
    assert np.array_equal(plain.singular_values, heavy.singular_values)


def test_deleted_elements_take_theirs_along() -> None:
    model = flexact.read_text(MODEL + "END\nESTIFF 7 1 2\nEM 9 3\nESTIFF 9 4\nXM 3 5\nXM 5 6\n")
    model.delete(7)
    properties = given_of(model)
    assert rows(properties.stiffness) == [[4]]
    assert rows(properties.mass) == [[3]]
    assert rows(properties.node_mass) == [[5], [6]]


ALL = """\
TRUSS 1 1 2
BEAM 2 2 3 4 5
RBEAM 3 4 5 6
PINBODY 4 4 5 7
HINGE 5 5 8 0 0 1
BEARING 6 6 9 7 10 0 0 1
RBEAM 7 6 9 11
RBEAM 8 7 10 12
X 2 1 0 0
X 4 2 0 0
X 6 3 0 0
X 7 2 1 0
X 11 4 0 0
X 12 3 1 0
FIX 1
END
HALT
"""
PLANAR = "PLTRUSS 1 1 2\nPLBEAM 2 2 3 4 5\nPLRBEAM 3 4 5 6\nPLTOR 4 5 7\nPLRBEAM 5 4 7 8\n"
PLANAR += "X 2 1 0\nX 4 2 0\nX 6 3 0\nX 8 2 1\nFIX 1\nEND\nHALT\n"


@pytest.mark.parametrize(
    ("deck", "keyword", "counts"),
    [
        # ESTIFF: deformations with a stiffness of their own, and the shear of beams.
        (ALL, "ESTIFF", {1: 1, 2: 6, 3: 0, 4: 0, 5: 3, 6: 6}),
        (PLANAR, "ESTIFF", {1: 1, 2: 3, 3: 0, 4: 1}),
        # EM: a mass of what has a line, with inertias of beams and links.
        (ALL, "EM", {1: 1, 2: 5, 3: 5, 4: 5, 5: 0, 6: 0}),
        (PLANAR, "EM", {1: 1, 2: 2, 3: 2, 4: 0}),
        (ALL, "XM", {4: 1, 5: 6}),
        (PLANAR, "XM", {4: 1, 5: 1}),
    ],
)
def test_each_element_takes_the_numbers_that_mean_something(
    deck: str, keyword: str, counts: dict[int, int]
) -> None:
    table = {"ESTIFF": "stiffness", "EM": "mass", "XM": "node_mass"}[keyword]
    for number, count in counts.items():
        for given_count in range(1, 9):
            words = [f"{k}." for k in range(1, given_count + 1)]
            model = flexact.read_text(f"{deck}{keyword} {number} {' '.join(words)}\nEND\n")
            warned = [d for d in model.diagnostics if d.code in ("surplus-operand", "no-meaning")]
            passed_over = (
                deck == ALL and number == 2 and keyword != "XM" and given_count == count + 1
            )
            assert len(warned) == (given_count > count and not passed_over)
            if count == 0:
                assert [d.code for d in warned] == ["no-meaning"]
                assert model.data.properties is None
                continue
            find = model.node_index if keyword == "XM" else model.element_index
            row = rows(getattr(given_of(model), table))[find(number)]
            assert row == [float(k) for k in range(1, min(given_count, count) + 1)]


def test_zeros_are_never_surplus() -> None:
    """Programs write as many numbers for every element, and zero is no stiffness."""
    deck = f"{ALL}ESTIFF 1 5 0 0 0\nESTIFF 4 0 0 0\nEM 5 0.\nEM 2 1 0 0 0 0 0 0\nXM 4 1 0 0\nEND\n"
    model = flexact.read_text(deck)
    assert model.diagnostics == ()
    assert rows(given_of(model).stiffness)[:4] == [[5], [], [], []]


@pytest.mark.parametrize(
    ("statement", "column"),
    [
        ("ESTIFF 2 1 -2 3", 12),
        ("ESTIFF 5 -1", 10),
        ("EM 2 -1e-3", 6),
        ("EM 2 1 1 1 1 -1", None),
        ("XM 5 1 -1 -1 1 -1 1", None),
        ("XM 5 1 0 0 -1", 12),
        ("XM 4 -1", 6),
        ("ESTIFF 2 0 0 0 0", None),
    ],
)
def test_less_than_zero_is_warned_of_where_it_stands(statement: str, column: int | None) -> None:
    model = flexact.read_text(f"{ALL}{statement}\nEND\n")
    found = [(d.code, d.line, d.column) for d in model.diagnostics]
    assert found == ([] if column is None else [("negative-number", 18, column)])


#: As public programs and people write them: SPACAR Light, oopspa (github.com/Wout-S/oopspa), and
#: decks of github.com/roepnaamstraat/FlexibleInstrumentSimulation and
#: github.com/shantnavagarwal/Flexible-Endoscopic-Robots; the statements are stated anew.
AS_WRITTEN = {
    "of a beam with shear and a number of warping": (
        " ESTIFF \t   2 \t 2100000.000000000000000 \t   0.009309804722106 \t   0.007000000000000 "
        "\t 437.500000000000114 \t   0.000000011666667 \t   0.000729166666667 \t   "
        "0.000001458333333 \t",
        "stiffness",
        [2.1e6, 0.009309804722106, 0.007, 437.500000000000114, 1.1666667e-8, 7.29166666667e-4],
    ),
    "of a beam with the inertia of warping": (
        "EM\t\t\t  2\t\t   0.078000000000000\t   0.000016250260000\t   0.000000000260000\t   "
        "0.000016250000000\t   0.000000000000000\t   0.000000000000054",
        "mass",
        [0.078, 1.625026e-5, 2.6e-10, 1.625e-5, 0.0],
    ),
    "of a beam that cannot be stretched": (
        "ESTIFF 2   0 0.0093 0.012 0.012 ",
        "stiffness",
        [0.0, 0.0093, 0.012, 0.012],
    ),
    "of a hinge, about its axis alone": ("ESTIFF 5   2.80", "stiffness", [2.8]),
    "of a rigid link": ("EM 3   0.5", "mass", [0.5]),
    "in small letters with exponents of Fortran": (
        "estiff 2 2.1D6 9.3d-3 +7E-3 .4375e3 % steel",
        "stiffness",
        [2.1e6, 9.3e-3, 7e-3, 437.5],
    ),
}


@pytest.mark.parametrize("name", list(AS_WRITTEN))
def test_decks_as_they_are_written(name: str) -> None:
    statement, table, wanted = AS_WRITTEN[name]
    number = int(statement.split()[1])
    # The last line of such decks often has no end.
    for ending in ("\nEND\nEND\n", "\r\nEND\r\nEND", "\n\nEND\nEND\n\n"):
        model = flexact.read_text(f"{ALL}{statement}{ending}")
        assert model.diagnostics == ()
        assert rows(getattr(given_of(model), table))[model.element_index(number)] == wanted


def test_small_inertias_against_singular_matrices() -> None:
    """Decks have them at each orientation, so that SPACAR can solve."""
    model = flexact.read_text(f"{ALL}XM 5     0.0000001 0.0 0.0 0.0000001 0.0 0.0000001\nEND\n")
    assert model.diagnostics == ()
    given_row = rows(given_of(model).node_mass)[model.node_index(5)]
    assert given_row == [1e-7, 0.0, 0.0, 1e-7, 0.0, 1e-7]
