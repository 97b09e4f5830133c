# SPDX-License-Identifier: BSD-3-Clause
"""How elements are to be drawn: from the picture block, from the builder, and back to a deck."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from reference_decks import ROOT
from wording import AsStored
from wrong_use import APPEARANCE, Call, code_of, each, two_nodes_and_a_bar

import flexact
from flexact import Model, ModelError
from flexact.deck.rendering import render_problems
from flexact.model.data import Appearance, CrossSection

FOLDER = Path(__file__).parent / "decks"
NAN = np.nan
FIELDS = ("cross_section", "dimensions", "colour", "edge_colour", "opacity", "drawn")
BARS = "TRUSS 3 1 2\nTRUSS 5 2 4\nTRUSS 8 1 4\nX 2 1 0 0\nX 4 0 1 0\nFIX 1\nEND\nHALT\nEND\n"


def assert_same(ours: Appearance, theirs: Appearance) -> None:
    for name in FIELDS:
        one, other = getattr(ours, name), getattr(theirs, name)
        assert np.array_equal(one, other, equal_nan=one.dtype.kind == "f"), name
        assert (one.dtype, one.shape) == (other.dtype, other.shape), name


def appearance_of(picture: str) -> Appearance:
    return flexact.read_text(BARS + picture).data.appearance


def three_bars() -> tuple[Model, list[flexact.Element]]:
    model = Model()
    a, b, c = model.node(0, 0, 0), model.node(1, 0, 0), model.node(0, 1, 0)
    return model, [model.truss(a, b), model.truss(b, c), model.truss(a, c)]


def test_a_deck_without_pictures_is_plain() -> None:
    data = flexact.read_text(BARS).data
    assert data.given_appearance is None
    assert_same(data.appearance, Appearance.plain(3))
    assert data.appearance.drawn.all() and not data.appearance.cross_section.any()
    assert np.isnan(data.appearance.colour).all() and data.appearance.dimensions.shape == (3, 2)


def test_a_picture_block_is_read() -> None:
    appearance = appearance_of(
        "VISUALIZATION\nBEAMPROPS 3 8\nCROSSTYPE RECT\nCROSSDIM 0.04 0.0003\n"
        "GRAPHICS 5\nFACECOLOR 51 102 255\nEDGECOLOR 0 .5 1\nOPACITY 0.25\nDONOTDRAW 8\n"
    )
    wanted = Appearance(
        np.array([CrossSection.RECT, CrossSection.NONE, CrossSection.RECT], np.int32),
        np.array([[0.04, 0.0003], [0, 0], [0.04, 0.0003]]),
        np.array([[NAN] * 3, [0.2, 0.4, 1], [NAN] * 3]),
        np.array([[NAN] * 3, [0, 0.5, 1], [NAN] * 3]),
        np.array([NAN, 0.25, NAN]),
        np.array([True, True, False]),
    )
    assert_same(appearance, wanted)


@pytest.mark.parametrize("kind", [kind for kind in CrossSection if kind])
def test_kinds_have_the_numbers_of_the_core(kind: CrossSection) -> None:
    assert (
        appearance_of(f"VISUALIZATION\nCROSSTYPE {kind.name}\n").cross_section.tolist()
        == [kind] * 3
    )


def test_cylinder_of_the_paper() -> None:
    """As the deck states it: sheets 0.3 mm x 40 mm, a cylinder of 40 mm, its spokes not drawn."""
    data = flexact.read(ROOT / "input_decks" / "paper" / "six_folded_sheets.dat").data
    appearance, index = data.appearance, data.element_index
    for number in range(1, 13):
        assert appearance.cross_section[index[number]] == CrossSection.RECT
        assert appearance.dimensions[index[number]].tolist() == [0.0003, 0.04]
        assert appearance.colour[index[number]].tolist() == [0.6, 0.7, 0.9]
    assert appearance.cross_section[index[21]] == CrossSection.CIRC
    assert appearance.dimensions[index[21]].tolist() == [0.04, 0.04]
    hidden = data.arrays.element_number[~appearance.drawn].tolist()
    assert hidden == [22, 23, 24, 25, 26, 27]


def test_pictures_do_not_touch_the_analysis() -> None:
    text = (ROOT / "input_decks" / "paper" / "six_folded_sheets.dat").read_text()
    with_picture = flexact.analyse(flexact.read_text(text))
    without = flexact.analyse(flexact.read_text(text[: text.index("VISUALIZATION")]))
    assert np.array_equal(with_picture.singular_values, without.singular_values)


def test_what_is_used_is_not_counted_as_not_used() -> None:
    model = flexact.read_text(
        BARS + "VISUALIZATION\nBEAMPROPS\nCROSSTYPE CIRC\nCROSSDIM 1\nGRAPHICS 3\nFACECOLOR 1 0 0\n"
        "EDGECOLOR 1 0 0\nOPACITY 1\nDONOTDRAW 3\nBEAMVIS 1 1\nTRUSSVIS 1 1\nINITIAL\nCOLOR 1 0 0\n"
    )
    (note,) = model.diagnostics
    assert (note.code, note.line) == ("not-used", 21)
    assert "2" in note.message.split()


def test_mistakes_are_told_as_stored(as_stored: AsStored, monkeypatch: pytest.MonkeyPatch) -> None:
    """The expected text was read by a person, line by line."""
    monkeypatch.chdir(FOLDER)
    model = flexact.read("picture_mistakes.dat")
    shown = render_problems(model.data.problems, model.name, model.data.source)
    as_stored(shown, FOLDER / "picture_mistakes.expected")


def test_mistakes_are_left_out() -> None:
    """Only what is right in the deck counts: lines 13, 14, 26 and 33."""
    appearance = flexact.read(FOLDER / "picture_mistakes.dat").data.appearance
    wanted = Appearance(
        np.array([CrossSection.RECT, CrossSection.RECT], np.int32),
        np.array([[0.002, 0.03], [0, 0]]),
        np.array([[NAN] * 3, [0, 1, 0]]),
        np.full((2, 3), NAN),
        np.full(2, NAN),
        np.ones(2, bool),
    )
    assert_same(appearance, wanted)


def test_an_appearance_survives_pickling_and_is_read_only() -> None:
    data = flexact.read_text(BARS + "VISUALIZATION\nGRAPHICS 5\nFACECOLOR 1 0 0\n").data
    for again in (pickle.loads(pickle.dumps(data)), copy.deepcopy(data)):
        assert_same(again.appearance, data.appearance)
        for appearance in (again.appearance, data.appearance, Appearance.plain(2)):
            assert not any(getattr(appearance, name).flags.writeable for name in FIELDS)


def test_a_plain_appearance_of_many_elements_takes_no_memory() -> None:
    appearance = Appearance.plain(10**12)
    assert appearance.colour.shape == (10**12, 3)
    assert pickle.loads(pickle.dumps(flexact.read_text(BARS).data)).given_appearance is None


# Builder ------------------------------------------------------------------------


def test_sections_of_elements() -> None:
    model = Model()
    a, b, c = model.node(0, 0, 0), model.node(1, 0, 0), model.node(1, 1, 0)
    model.truss(a, b, section=0.01)
    model.beam(a, b, section=(0.02, 0.03))
    model.wire(a, b, section=np.float64(0.001))
    model.rigid(b, c, section=np.array([0.04, 0.05]))
    model.wire(b, c)
    appearance = model.data.appearance
    assert appearance.cross_section.tolist() == [2, 1, 2, 1, 0]
    assert appearance.dimensions.tolist() == [
        [0.01, 0.01],
        [0.02, 0.03],
        [0.001, 0.001],
        [0.04, 0.05],
        [0, 0],
    ]


@pytest.mark.parametrize("width", [(0, 1, 0), (0, 0, 1), (0.3, 1, 1)])
def test_the_width_of_a_sheet_lies_along_its_width(width: tuple[float, float, float]) -> None:
    """The long side of the section points where the width was said to be."""
    model = Model()
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    sheet = model.sheet(a, b, width, beams=2, section=(0.04, 0.0003))
    y = model.element_vectors[0]
    local = np.stack([y, np.cross([1, 0, 0], y)])
    across = np.array(width) * [0, 1, 1]
    dimensions = model.data.appearance.dimensions
    assert dimensions.tolist() == [[0.0003, 0.04]] * len(sheet.elements)
    assert np.abs(local @ across / np.linalg.norm(across)) @ dimensions[0] == pytest.approx(0.04)


def test_a_planar_sheet_is_as_thick_as_it_is() -> None:
    """The local y axis of a planar beam lies in the plane, where the thickness is seen."""
    model = Model(planar=True)
    model.sheet(model.node(0, 0), model.node(1, 0), section=(0.04, 0.0003))
    assert model.data.appearance.dimensions.tolist() == [[0.0003, 0.04]]


def test_appearance_of_handles_and_numbers() -> None:
    model = Model()
    a, b, c = model.node(0, 0, 0), model.node(1, 0, 0), model.node(1, 1, 0)
    sheet = model.sheet(a, b, (0, 0, 1), beams=2)
    turned = model.hinge(b, (0, 0, 1))
    bar = model.truss(turned, c)
    model.look(sheet, section=(0.04, 0.001), opacity=0.5)
    model.look(turned, colour=(1, 0, 0), section=0.02)
    model.look(bar, edge_colour=(0, 0, 1), drawn=False)
    model.look(1, opacity=0)
    appearance = model.data.appearance
    assert appearance.cross_section.tolist() == [1, 1, 2, 0]
    assert appearance.dimensions.tolist() == [[0.001, 0.04], [0.001, 0.04], [0.02, 0.02], [0, 0]]
    assert np.array_equal(appearance.opacity, [0, 0.5, NAN, NAN], equal_nan=True)
    assert (
        appearance.colour[2].tolist() == [1, 0, 0] and np.isnan(appearance.colour[[0, 1, 3]]).all()
    )
    assert appearance.edge_colour[3].tolist() == [0, 0, 1]
    assert appearance.drawn.tolist() == [True, True, True, False]


def test_what_is_not_given_stays() -> None:
    model, (bar, *_) = three_bars()
    model.look(bar, colour=(1, 0, 0), drawn=False)
    before = model.data
    model.look(bar, opacity=0.5)
    assert not model.data.appearance.drawn[0] and model.data.appearance.colour[0, 0] == 1
    model.look(bar, drawn=True, colour=(0, 1, 0))
    assert model.data.appearance.drawn[0] and model.data.appearance.colour[0, 1] == 1
    assert before.appearance.colour[0].tolist() == [1, 0, 0] and np.isnan(
        before.appearance.opacity[0]
    )


def test_a_deck_keeps_its_appearance_when_changed() -> None:
    picture = "VISUALIZATION\nBEAMPROPS 5\nCROSSTYPE CIRCHOL\nCROSSDIM 0.02 0.001\nDONOTDRAW 3\n"
    model = flexact.read_text(BARS + picture)
    before = model.data.appearance
    model.truss(model.handle(1), model.node(0, 0, 1), section=0.5)
    model.look(8, colour=(0, 0, 1))
    appearance = model.data.appearance
    assert appearance.cross_section.tolist() == [*before.cross_section.tolist(), CrossSection.CIRC]
    assert appearance.dimensions.tolist() == [*before.dimensions.tolist(), [0.5, 0.5]]
    assert appearance.drawn.tolist() == [False, True, True, True]
    assert appearance.colour[2].tolist() == [0, 0, 1]


@pytest.mark.parametrize(("code", "use"), each(APPEARANCE))
def test_wrong_use_is_a_model_error(code: str, use: Call) -> None:
    model, a, b, bar = two_nodes_and_a_bar()
    with pytest.raises(ModelError) as error:
        use(model, a, b, bar)
    assert code_of(error) == code
    assert model.data.given_appearance is None and model.element_numbers.tolist() == [1]


def test_wrong_use_changes_nothing() -> None:
    model, (bar, *_) = three_bars()
    model.look(bar, section=0.5)
    with pytest.raises(ModelError):
        model.look(bar, section=0.1, colour=(2, 0, 0))
    assert model.data.appearance.dimensions[0].tolist() == [0.5, 0.5]


# Decks --------------------------------------------------------------------------

PARTS = st.floats(0, 1)
COLOURS = st.tuples(PARTS, PARTS, PARTS)
SIZES = st.floats(1e-300, 1e300)
SAID = st.fixed_dictionaries(
    {},
    optional={
        "section": SIZES | st.tuples(SIZES, SIZES),
        "colour": COLOURS,
        "edge_colour": COLOURS,
        "opacity": PARTS,
        "drawn": st.booleans(),
    },
)


@settings(deadline=None)
@given(st.lists(SAID, min_size=3, max_size=3))
def test_decks_read_back_to_the_same_appearance(said: list[dict[str, object]]) -> None:
    model, bars = three_bars()
    for bar, words in zip(bars, said, strict=True):
        model.look(bar, **words)  # type: ignore[arg-type]
    again = flexact.read_text(model.to_deck(), model.name)
    assert {item.code for item in again.diagnostics} == {"no-support"}
    assert_same(again.data.appearance, model.data.appearance)
    assert again.to_deck() == model.to_deck()


@pytest.mark.parametrize("kind", ["RECTHOL", "CIRCHOL", "LINE", "RECT"])
@pytest.mark.parametrize("sizes", ["", "CROSSDIM 0.2 0.1\n"])
def test_kinds_of_a_deck_read_back(kind: str, sizes: str) -> None:
    model = flexact.read_text(BARS + f"VISUALIZATION\nBEAMPROPS 5\nCROSSTYPE {kind}\n{sizes}")
    again = flexact.read_text(model.to_deck())
    assert_same(again.data.appearance, model.data.appearance)


def test_many_elements_read_back() -> None:
    """More than stand in one line of a group, of two colours."""
    model = Model()
    points = [model.node(i, 0, 0) for i in range(101)]
    for i in range(100):
        model.look(model.truss(points[i], points[i + 1], section=0.1), colour=(i % 2, 0, 0))
    again = flexact.read_text(model.to_deck())
    assert_same(again.data.appearance, model.data.appearance)
    assert max(map(len, model.to_deck().split("\n"))) < 100


def test_a_model_without_a_appearance_writes_no_picture() -> None:
    assert "VISUALIZATION" not in three_bars()[0].to_deck()
