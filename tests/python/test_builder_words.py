# SPDX-License-Identifier: BSD-3-Clause
"""Words of deformations, at which end, and the beams of a divided flexure that they act on."""

import pickle
from collections.abc import Callable
from enum import Enum

import numpy as np
import pytest
from wrong_use import code_of

import flexact
from flexact import Model, ModelError, Sheet


def one_sheet(beams: int = 1) -> tuple[Model, Sheet]:
    model = Model()
    a, b = model.node(0, 0, 0, name="clamp 1"), model.node(1, 0, 0, name="stage 1")
    return model, model.sheet(a, b, "z", beams, "sheet 1")


@pytest.mark.parametrize(
    ("words", "at", "numbers"),
    [
        # Roles of the paper, eqs. (3) and (4): 1 elongation, 2 torsion, 3 and 4 bending in the
        # plane of the sheet at p and q, 5 and 6 out of it.
        (["elongation"], None, [1]),
        (["twist"], None, [2]),
        (["torsion"], None, [2]),
        (["in-plane bending"], "clamp 1", [3]),
        (["in-plane bending"], "stage 1", [4]),
        (["in-plane bending"], None, [3, 4]),
        (["In plane  bending"], "p", [3]),
        (["out-of-plane bending"], "q", [6]),
        (["bending"], (0, 0, 0), [3, 5]),
        (["bending"], None, [3, 4, 5, 6]),
        (["bending about y"], "q", [4]),
        (["bending about z"], None, [5, 6]),
        (["elongation", 4], None, [1, 4]),
        ([], None, [1, 2, 3, 4, 5, 6]),
        ([], "q", [4, 6]),
    ],
)
def test_words_mean_these_deformations(
    words: list[str | int], at: object, numbers: list[int]
) -> None:
    for name in ("independent", "hold", "release"):
        model, _ = one_sheet()
        getattr(model, name)("sheet 1", *words, at=at)
        value = {"independent": 3, "hold": 1, "release": 2}[name]
        fresh = enumerate([1, 2, 1, 1, 2, 2], 1)
        wanted = [value if k in numbers else before for k, before in fresh]
        assert model.deformation_classes.tolist() == [wanted]


def test_what_was_released_can_be_held_again() -> None:
    model, sheet = one_sheet()
    model.release("sheet 1", "in-plane bending")
    model.hold("sheet 1", "in-plane bending")
    assert model.deformation_classes.tolist() == [[1, 2, 1, 1, 2, 2]]
    model.independent(sheet, "in-plane bending", at="p")
    assert model.deformation_classes.tolist() == [[1, 2, 3, 1, 2, 2]]
    with pytest.raises(ModelError) as error:
        model.release("sheet 1", "in-plane bending")
    assert code_of(error) == "class-conflict"
    assert "'sheet 1'" in str(error.value)
    assert model.deformation_classes.tolist() == [[1, 2, 3, 1, 2, 2]]


@pytest.mark.parametrize(
    ("call", "code", "help_"),
    [
        (lambda m: m.release("sheet 1", "twisting"), "component-out-of-range", "'twist'"),
        (lambda m: m.release("sheet 1", "rotation"), "component-out-of-range", "in-plane"),
        (lambda m: m.release("sheet 1", "twist", at="p"), "no-end", "at"),
        (lambda m: m.release("sheet 1", 3, at="p"), "no-end", "words"),
        (lambda m: m.release("sheet 1", "bending", at=m.node(5, 5, 5)), "no-end", "ends"),
        (lambda m: m.release("shet 1", "twist"), "no-such-part", "'sheet 1'"),
        (lambda m: m.release("sheet 1", 7), "component-out-of-range", "1 to 6"),
        (lambda m: m.release("clamp 1", "twist"), "not-an-element", "part"),
    ],
)
def test_wrong_words_name_the_part(call: Callable[[Model], object], code: str, help_: str) -> None:
    model, _ = one_sheet()
    with pytest.raises(ModelError) as error:
        call(model)
    assert code_of(error) == code
    (problem,) = error.value.diagnostics
    assert problem.message.startswith("release '")
    assert help_ in problem.help
    assert model.deformation_classes.tolist() == [[1, 2, 1, 1, 2, 2]]


def test_an_end_is_also_the_body_there() -> None:
    model = Model()
    guide = model.parallel_guide((0, 0, 0), (0.1, 0, 0), (0, 0.05, 0))
    model.release("sheet 1", "in-plane bending", at="stage")
    model.release("sheet 2", "in-plane bending", at=guide.body)
    assert model.deformation_classes.tolist()[:2] == [[1, 2, 1, 2, 2, 2]] * 2


def test_a_beam_has_a_plane_only_by_its_section() -> None:
    model = Model()
    round_one = model.beam((0, 0, 0), (1, 0, 0), name="rod", section=0.01)
    with pytest.raises(ModelError) as error:
        model.release(round_one, "in-plane bending")
    assert code_of(error) == "no-plane"
    # Wide along local y, so that the plane is the local xy plane: 5 and 6.
    model.beam((0, 0, 0), (1, 0, 0), "y", name="bar", section=(0.1, 0.001))
    model.release("bar", "in-plane bending")
    assert model.deformation_classes.tolist()[1] == [1, 1, 1, 1, 2, 2]


def test_the_plane_of_a_sheet_of_a_deck_is_the_bending_that_it_holds() -> None:
    """Others give the width as y, so that 5 and 6 are held."""
    model = flexact.read_text("BEAM 1 1 2 3 4 0 1 0 % leaf\nX 3 1 0 0\nRLSE 1 2 3 4")
    model.release("leaf", "in-plane bending", at="q")
    assert model.deformation_classes.tolist() == [[1, 2, 2, 2, 1, 2]]


def test_hinges_and_bars_have_their_words() -> None:
    model = Model()
    model.notch((0, 0, 0), "z", name="notch")
    model.truss((0, 0, 0), (1, 0, 0), name="bar")
    model.hold("notch", "rotation")
    model.release("notch", "tilt")
    model.release("bar", "elongation")
    assert model.deformation_classes.tolist() == [[1, 2, 2, 0, 0, 0], [2, 0, 0, 0, 0, 0]]


def test_a_planar_sheet_bends_out_of_its_plane() -> None:
    model = Model(planar=True)
    model.sheet((0, 0), (1, 0), name="sheet")
    model.hold("sheet", "out-of-plane bending", at=(1, 0))
    assert model.deformation_classes.tolist() == [[1, 2, 1, 0, 0, 0]]
    with pytest.raises(ModelError) as error:
        model.release("sheet", "in-plane bending")
    assert code_of(error) == "component-out-of-range"


Given = Callable[[Model, str], None]
CHANGES: dict[str, Given] = {
    "as it is": lambda m, s: None,
    "in-plane at p": lambda m, s: m.release(s, "in-plane bending", at="p"),
    "in-plane at q": lambda m, s: m.release(s, "in-plane bending", at="q"),
    "in-plane": lambda m, s: m.release(s, "in-plane bending"),
    "elongation": lambda m, s: m.release(s, "elongation"),
    "twist": lambda m, s: m.release(s, "twist"),
    "twist held": lambda m, s: m.hold(s, "twist"),
    "out-of-plane": lambda m, s: m.release(s, "out-of-plane bending"),
    "out-of-plane held": lambda m, s: m.hold(s, "out-of-plane bending"),
    "out-of-plane held at p": lambda m, s: m.hold(s, "out-of-plane bending", at="p"),
    "out-of-plane held at q": lambda m, s: m.hold(s, "out-of-plane bending", at="q"),
    "twist driven": lambda m, s: m.independent(s, "twist"),
    "out-of-plane driven at p": lambda m, s: m.independent(s, "out-of-plane bending", at="p"),
    "out-of-plane driven at q": lambda m, s: m.independent(s, "out-of-plane bending", at="q"),
    "in-plane driven at q": lambda m, s: m.independent(s, "in-plane bending", at="q"),
    "everything": lambda m, s: m.release(s),
}


def space_of_the_end(beams: int, change: Given, wavy: float) -> np.ndarray:
    """Orthonormal (6, k): how the end of a clamped sheet can move, from D(c) alone."""
    model, sheet = one_sheet(beams)
    change(model, "sheet 1")
    for k, node in enumerate(sheet.nodes[1:-1]):
        x, y, z = node.place
        model.move(node, (x, y + wavy * (-1) ** k, z + wavy / 2))
    model.fix("clamp 1")
    jacobian = flexact.jacobian(model)
    classes = model.deformation_classes
    rows = [classes[model.element_index(e), k - 1] != 2 for e, k in jacobian.row_labels]
    labels = jacobian.column_labels
    free = [k for k, (number, _) in enumerate(labels) if number not in (1, 2)]
    matrix = jacobian.toarray()[rows][:, free]
    _, sizes, right = np.linalg.svd(matrix)
    null = right[np.sum(sizes > 1e-9) :].T
    tip = sheet.nodes[-1]
    names = [*((tip.position, n) for n in "xyz"), *((tip.orientation, "r" + n) for n in "xyz")]
    end = null[[free.index(labels.index(name)) for name in names]]
    assert null.shape[1] == np.linalg.matrix_rank(end, tol=1e-9), "nothing is internal"
    return np.linalg.svd(end)[0][:, : null.shape[1]]


@pytest.mark.parametrize("beams", [2, 3, 7])
@pytest.mark.parametrize("change", CHANGES)
def test_a_divided_sheet_lets_its_end_move_as_one_beam_does(change: str, beams: int) -> None:
    """Whatever is released, held or driven: the same space of motions, and none inside."""
    one = space_of_the_end(1, CHANGES[change], 0.0)
    many = space_of_the_end(beams, CHANGES[change], 0.0)
    assert many.shape == one.shape
    assert np.abs(one @ one.T - many @ many.T).max() < 1e-12


@pytest.mark.parametrize("wavy", [1e-12, 1e-6, 1e-3])
def test_a_wavy_sheet_has_the_motions_of_a_flat_one(wavy: float) -> None:
    flat = space_of_the_end(1, CHANGES["as it is"], 0.0)
    many = space_of_the_end(5, CHANGES["as it is"], wavy)
    assert many.shape == flat.shape == (6, 3)
    assert np.abs(flat @ flat.T - many @ many.T).max() < 20 * wavy + 1e-9


@pytest.mark.parametrize("beams", [1, 2, 4, 8, 16])
@pytest.mark.parametrize("wavy", [0.0, 1e-12, 1e-6, 1e-3])
def test_a_divided_guide_has_the_counts_of_two_sheets(beams: int, wavy: float) -> None:
    # One motion, one self-stress (Soemers 2010; reference cases of flexures).
    model = Model()
    guide = model.parallel_guide((0, 0, 0), (0.1, 0, 0), (0, 0.05, 0), beams=beams)
    model.fix(*guide.ground)
    for k, node in enumerate(guide.parts["sheet 1"].nodes[1:-1]):  # type: ignore[union-attr]
        x, y, z = node.place
        model.move(node, (x, y + wavy * (-1) ** k, z))
    analysis = flexact.analyse(model)
    assert (analysis.under_constrained, analysis.over_constrained) == (1, 1)


def test_a_divided_wire_takes_one_motion() -> None:
    model = Model()
    wire = model.wire((0, 0, 0), (1, 0, 0), name="wire", beams=3)
    model.fix((0, 0, 0))
    inner = [1, 3, 3, 3, 3, 3]
    assert model.deformation_classes.tolist() == [[1, 2, 2, 2, 2, 2], inner, inner]
    assert len(wire.elements) == 3 and list(model.element_names) == [
        "wire, 1",
        "wire, 2",
        "wire, 3",
    ]
    analysis = flexact.analyse(model)
    assert (analysis.under_constrained, analysis.over_constrained) == (5, 0)


class Name(str, Enum):
    """Names that the script alone knows."""

    MODEL, POINT, BAR, SHEET, WIRE, BODY = "m", "p", "bar", "sheet", "wire", "body"
    FOLDED, OTHER, GUIDE = "folded", "other", "guide"


def test_a_name_of_whatever_kind_of_text_is_plain_text() -> None:
    """So that a model, and its result, can be read where the script is not."""
    model = flexact.Model(name=Name.MODEL)
    model.node(0, 0, 0, name=Name.POINT)
    model.truss((0, 0, 0), (1, 0, 0), name=Name.BAR)
    model.sheet((0, 1, 0), (1, 1, 0), width=(0, 0, 1), name=Name.SHEET)
    model.wire((0, 2, 0), (1, 2, 0), name=Name.WIRE)
    model.body([(1, 0, 0), (1, 1, 0), (1, 2, 0)], name=Name.BODY)
    folded = model.folded_sheet(
        (0, 3, 0), (0.5, 3, 0.1), (1, 3, 0), width=(0, 1, 0), name=Name.FOLDED
    )
    model.rename("wire", Name.OTHER)
    model.rename("p", Name.GUIDE)
    model.rename(folded, Name.WIRE)
    for made in (model.data, flexact.analyse(model)):
        kept = pickle.dumps(made)
        assert __name__.encode() not in kept and b"Name" not in kept.replace(b"DeckNames", b"")
    assert {"bar", "sheet", "other", "body", "wire, leaf 1"} <= {
        name.partition(",")[0] if "leaf" not in name else name for name in model.element_names
    }
