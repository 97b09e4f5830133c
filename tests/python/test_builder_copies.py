# SPDX-License-Identifier: BSD-3-Clause
"""Copies: inserted, patterned, mirrored, turned; against the same mechanism made by hand."""

import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from random_models import mechanism
from wrong_use import code_of

import flexact
from flexact import Model, ModelError, analyse


def counts(model: Model) -> tuple[int, int, int, int]:
    analysis = analyse(model)
    return analysis.under_constrained, analysis.over_constrained, analysis.rows, analysis.columns


def leg() -> Model:
    model = Model(name="leg")
    model.node(0.1, -0.05, 0, name="clamp")
    model.folded_sheet(
        "clamp",
        (0.1, 0, 0),
        (0.05, 0, 0),
        name="flexure",
        breadth=0.02,
        thickness=2e-4,
        material="steel",
    )
    model.fix("clamp")
    return model


@pytest.mark.parametrize("n", [1, 2, 3, 4, 6, 7])
def test_a_pattern_is_n_copies_at_equal_angles(n: int) -> None:
    model = leg()
    copies = model.pattern(n, "z")
    assert len(copies) == n and model.element_numbers.size == 2 * n
    for k, copy in enumerate(copies):
        place = copy.points["clamp"].place
        angle = math.atan2(-0.05, 0.1) + 2 * math.pi * k / n
        wanted = math.hypot(0.1, 0.05) * np.array([math.cos(angle), math.sin(angle), 0])
        assert place == pytest.approx(wanted, abs=1e-15)
        assert copy.ground == (copy.points["clamp"],)
    names = ["clamp", *(f"clamp ({k})" for k in range(2, n + 1))]
    assert [copy.points["clamp"].name for copy in copies] == names
    model.body([leaf.nodes[-1] for leaf in (copy.parts["flexure, leaf 2"] for copy in copies)])
    # n forces along z at n points in a circle: at most three of them are independent.
    assert counts(model)[:2] == (6 - min(n, 3), max(n - 3, 0))


def test_names_of_a_pattern_are_numbered() -> None:
    model = leg()
    first, second = model.pattern(2, "z", names="{} {}")
    assert model.element_names == (
        "flexure 1, leaf 1",
        "flexure 1, leaf 2",
        "flexure 2, leaf 1",
        "flexure 2, leaf 2",
    )
    assert (first["clamp"].name, second["clamp"].name) == ("clamp 1", "clamp 2")
    assert model.part("flexure 2, leaf 1") == second["flexure, leaf 1"]
    again = leg()
    again.pattern(2, "z", parts=["flexure, leaf 1", "flexure, leaf 2"], names="{} {}")
    assert again.element_names == model.element_names
    assert again.point("clamp 1").place == (0.1, -0.05, 0)


def test_parts_of_a_copy_keep_sections_material_and_classes() -> None:
    model = leg()
    model.pattern(3, "z")
    draft = model._change()
    assert len(draft.stiffness) == len(draft.mass) == 6
    assert len(set(draft.stiffness.values())) == 1
    assert model.deformation_classes.tolist() == [[1, 2, 1, 1, 2, 3], [1, 2, 1, 1, 2, 2]] * 3
    assert (model.data.appearance.dimensions == [2e-4, 0.02]).all()


def test_what_lies_on_the_axis_is_shared() -> None:
    """A star of wires from one point; the body in the middle stays one body."""
    model = Model()
    model.wire((0, 0, 0), (1, 0, 0), name="wire")
    model.fix((1, 0, 0))
    model.body([(0, 0, 0), (0, 0, 1), (0.1, 0, 0)], name="hub")
    model.pattern(4, "z")
    assert [n for n in model.element_names if n.startswith("wire")] == [
        "wire",
        "wire (2)",
        "wire (3)",
        "wire (4)",
    ]
    hub = [n for n in model.element_names if n.startswith("hub")]
    assert hub == [f"hub, {k}" for k in range(1, 6)], "the link on the axis stands once"
    assert model.node_kinds.tolist().count(2) == 1 + 1 + 4 + 4
    assert len(model.part("hub").nodes) == 6  # type: ignore[union-attr]


def test_a_ring_closes() -> None:
    """Bars from one corner to the next: n corners, not 2n."""
    for n in (3, 4, 5, 12):
        model = Model()
        angle = 2 * math.pi / n
        model.truss((1, 0, 0), (math.cos(angle), math.sin(angle), 0), name="side")
        model.pattern(n, "z")
        assert model.node_numbers.size == n and model.element_numbers.size == n


def test_a_row() -> None:
    model = Model()
    model.truss((0, 0, 0), (1, 0, 0), name="bar")
    model.pattern(4, step=(1, 0, 0))
    assert model.node_numbers.size == 5
    assert sorted(model.positions[:, 0]) == [0, 1, 2, 3, 4]
    other = Model()
    other.truss((0, 0, 0), (1, 0, 0), name="bar")
    other.pattern(4, step=(1, 0, 0), join=False)
    assert other.node_numbers.size == 8


def test_chosen_parts_alone_are_copied() -> None:
    model = Model()
    model.wire((0, 0, 0), (1, 0, 0), name="wire 1")
    model.wire((0, 0, 0), (0, 0, 1), name="wire 2")
    model.pattern(2, "z", parts=["wire 1"])
    assert model.element_names == ("wire 1", "wire 2", "wire 1 (2)")
    mirrored = model.mirror("xy", parts=["wire 2"], names={"wire 2": "wire below"})
    assert mirrored["wire 2"].name == "wire below"
    assert mirrored["wire 2"].nodes[1].place == (0, 0, -1)  # type: ignore[union-attr]


def test_six_folded_sheets_from_one() -> None:
    """The paper's Fig. 6 by a pattern and a mirror: one motion, which is declared, one stress."""
    model = Model()
    model.folded_sheet((0, 0.06, 0.09), (0, 0.06, 0.03), (0, 0, 0), name="upper")
    model.fix((0, 0.06, 0.09))
    model.pattern(3, "z", names="{} {}")
    image = model.mirror("xy", names={"upper": "lower"})
    model.independent((0, 0, 0), "z")
    assert counts(model) == (0, 1, 42, 41), "7 rows and 6 columns a flexure, 5 of the body"
    assert image["upper 3, leaf 1"].name == "lower 3, leaf 1"


def test_copies_of_copies_have_names_of_their_own() -> None:
    model = leg()
    model.mirror("yz")
    model.pattern(3, "z")
    assert len(set(model.element_names)) == model.element_numbers.size == 12


def test_insert_puts_a_model_anywhere_and_joins_it() -> None:
    guide = Model()
    made = guide.parallel_guide((0, 0, 0), (0, 0, 0.05), (0.12, 0, 0))
    model = Model()
    lower = model.insert(guide, names="lower {}")
    upper = model.insert(guide, at=(0, 0, 0.05), names="upper {}")
    assert model.part("upper sheet 1") == upper["sheet 1"]
    assert upper["ground 1"] == lower["stage 1"] == model.point("lower stage 1"), "joined"
    assert upper["sheet 2"].nodes[1].place == (0.12, 0, 0.1)  # type: ignore[union-attr]
    model.fix(*(lower[f"ground {k}"] for k in (1, 2)))
    # Guides in series: each adds a motion and a self-stress (double_parallel_guide.dat).
    assert counts(model)[:2] == (2, 2)
    assert guide.element_numbers.size == 3 and made["stage"] == guide.part("stage")
    apart = Model()
    apart.insert(guide)
    apart.insert(guide, at=(0, 0, 0.05), join=False)
    assert apart.node_numbers.size == 2 * guide.node_numbers.size


def test_insert_turns_first() -> None:
    bar = Model()
    bar.truss(bar.node(0, 0, 0, name="p"), bar.node(1, 0, 0, name="q"), "bar")
    model = Model()
    made = model.insert(bar, (0, 0, 5), axis="z", degrees=90)
    assert made["q"].place == (0, 1, 5)
    for axis, place in (("x", (1, 0, 0)), ("y", (0, 0, -1)), ((0, 0, -1), (0, -1, 0))):
        assert Model().insert(bar, axis=axis, degrees=90)["q"].place == place
    oblique = Model().insert(bar, axis=(1, 1, 1), degrees=120)["q"].place
    assert oblique == pytest.approx((0, 1, 0), abs=1e-15)


def test_a_deck_can_be_inserted() -> None:
    deck = flexact.read("input_decks/flexures/cross_hinge_undeclared.dat")
    model = Model()
    model.insert(deck, degrees=40, axis=(1, 2, 3))
    model.insert(deck, at=(1, 0, 0), names="second {}")
    assert counts(model)[:2] == (2, 2)
    assert model.part("second body").name == "second body"


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32 - 1), st.booleans(), st.floats(-400, 400), st.booleans())
@example(1, False, 6e-5, False)  # a hinge with one tilt released, turned by a millionth
@example(2103, False, 0.0, False)  # a vector with 1e-31 in it, which rounding takes away
def test_a_turned_or_mirrored_mechanism_has_its_verdict(
    seed: int, planar: bool, degrees: float, mirror: bool
) -> None:
    """Frames go with the parts: counts and singular values stay."""
    random = np.random.default_rng(seed)
    source = mechanism(random, planar, held=False)
    if not source.element_numbers.size:
        return
    axis = (0, 0, 1) if planar else tuple(random.normal(size=3))
    normal = (1, 0.3, 0) if planar else tuple(random.normal(size=3))
    try:
        model = turned(source, axis, degrees)
        if mirror:
            model = mirrored(model, normal)
    except ModelError as error:
        # A tilt of a hinge without the other one: no statement says in which direction.
        assert error.diagnostics[0].code == "turned-class" and not planar
        assert any(name == "HINGE" for name in source.element_keywords)
        return
    analysis, moved = analyse(source), counts(model)
    # What is doubtful may be either of what is said.
    said = {(each.under_constrained, each.over_constrained) for each in analysis.alternatives}
    is_doubtful = analysis.certainty is flexact.Certainty.DOUBTFUL
    assert counts(source) == moved or (is_doubtful and moved[:2] in said)
    # Of what is held, for all coordinates: elements know no place and no direction.
    ours, theirs = (singular_values_of_rows(each) for each in (source, model))
    assert theirs == pytest.approx(ours, abs=1e-9)


def turned(source: Model, axis: tuple[float, ...], degrees: float) -> Model:
    model = Model(planar=source.planar)
    place = (1, 2) if source.planar else (1, 2, 3)
    model.insert(source, place, axis=axis, degrees=degrees, join=False)
    return model


def mirrored(model: Model, normal: tuple[float, ...]) -> Model:
    """The mirror image alone."""
    image = Model(planar=model.planar)
    image.insert(model, join=False)
    originals = image.element_numbers.tolist()
    at = (50, 50) if model.planar else (50, 50, 50)
    image.mirror(normal, at=at, join=False)
    assert image.element_numbers.size == 2 * len(originals)
    for number in originals:
        image.delete(number)
    return image


def singular_values_of_rows(model: Model) -> np.ndarray:
    jacobian = flexact.jacobian(model)
    held = model.deformation_classes[model.deformation_classes > 0] != 2
    return np.linalg.svd(jacobian.toarray()[held], compute_uv=False)


def test_classes_of_single_coordinates_turn_along_the_axes_or_not_at_all() -> None:
    model = Model()
    model.wire((1, 0, 0), (2, 0, 0), name="wire")
    model.fix((2, 0, 0), "x", "z")
    with pytest.raises(ModelError) as error:
        model.pattern(3, "z")
    assert code_of(error) == "turned-class"
    assert model.element_numbers.size == 1, "nothing was copied"
    model.pattern(4, "z")
    wires = [model.part(name) for name in ("wire (2)", "wire (3)")]
    classes = [
        model.coordinate_classes[model.node_index(wire.nodes[1].position)].tolist()  # type: ignore[union-attr]
        for wire in wires
    ]
    assert classes == [[2, 1, 1], [1, 2, 1]]


def test_single_classes_on_the_axis_stay_where_the_point_is_shared_alone() -> None:
    model = Model()
    model.wire((0, 0, 0), (1, 0, 0), name="wire")
    model.fix((0, 0, 0), "x")
    model.pattern(3, "z")
    assert model.coordinate_classes[0].tolist() == [1, 2, 2]
    other = Model()
    for call in (
        lambda: model.pattern(3, "z", join=False),
        lambda: model.rotate("z", 45),
        lambda: other.insert(model, degrees=45),
    ):
        with pytest.raises(ModelError) as error:
            call()
        assert code_of(error) == "turned-class"
    assert model.element_numbers.size == 3 and other.element_numbers.size == 0


def test_a_copy_that_fails_leaves_nothing_behind() -> None:
    """The clamp comes to lie on a point that is driven: two classes."""
    model = Model()
    model.wire((0, 0, 0), (1, 0, 0), name="wire", section=0.001)
    model.fix((0, 0, 0))
    model.independent((1, 0, 0), "y")
    before = model.to_deck()
    for call in (
        lambda: model.mirror("yz", at=(0.5, 0, 0)),
        lambda: model.pattern(3, step=(1, 0, 0)),
    ):
        with pytest.raises(ModelError) as error:
            call()
        assert code_of(error) == "class-conflict"
        assert model.to_deck() == before
    assert model.node(5, 5, 5).position == 5, "no node was added"
    assert model.part("wire").name == "wire"


def test_inertia_turns_with_its_body() -> None:
    model = Model()
    model.body([(1, 0, 0), (2, 0, 0)], name="body", mass=3, inertia=(1, 0.5, 0, 2, 0, 4))
    copy = model.pattern(4, "z")[1]["body"].nodes[0]  # type: ignore[union-attr]
    masses = model._change().node_mass
    assert masses[copy.position] == (3,)
    # By a quarter turn x becomes y, y becomes -x: Jxx 2, Jyy 1, Jxy changes its sign.
    assert masses[copy.orientation] == pytest.approx((2, -0.5, 0, 1, 0, 4))


def test_rotate_turns_the_whole_model() -> None:
    model = leg()
    model.rotate("z", 90)
    assert model.point("clamp").place == pytest.approx((0.05, 0.1, 0), abs=1e-16)
    model.rotate("z", -90)
    assert model.point("clamp").place == pytest.approx((0.1, -0.05, 0), abs=1e-16)
    model.rotate((1, 2, 3), 77, at=(4, 5, 6))
    assert counts(model) == counts(leg())
    model.fix(model.part("flexure, leaf 2").nodes[1], "x")  # type: ignore[union-attr]
    with pytest.raises(ModelError) as error:
        model.rotate("z", 45)
    assert code_of(error) == "turned-class"


@pytest.mark.parametrize(
    ("call", "code"),
    [
        (lambda m: m.pattern(0, "z"), "out-of-range"),
        (lambda m: m.pattern(2.5, "z"), "bad-number"),
        (lambda m: m.pattern(2, "w"), "bad-number"),
        (lambda m: m.pattern(2, (0, 0, 0)), "zero-vector"),
        (lambda m: m.pattern(2, names="all alike"), "bad-name"),
        (lambda m: m.pattern(2, names="{} {} {}"), "bad-name"),
        (lambda m: m.pattern(2, parts=["nobody"]), "no-such-part"),
        (lambda m: m.mirror("xx"), "bad-number"),
        (lambda m: m.insert(m), "same-model"),
        (lambda m: m.insert(Model(planar=True)), "two-kinds-of-model"),
        (lambda m: m.insert(5), "not-a-model"),
        (lambda m: m.insert(leg(), join="yes"), "bad-number"),
        (lambda m: m.insert(leg(), at=(1, 2, 3, 4)), "bad-number"),
    ],
)
def test_wrong_copies(call: object, code: str) -> None:
    model = leg()
    with pytest.raises(ModelError) as error:
        call(model)  # type: ignore[operator]
    assert code_of(error) == code
    assert model.element_numbers.size == 2


def test_a_copy_that_fails_leaves_no_stiffness_behind() -> None:
    """Elements made later have the indices that its elements had."""
    model = Model()
    model.truss((0, 0, 0), (1, 0, 0), "bar", thickness=0.01, material="steel")
    model.truss((2, 0, 0), (2, 1, 0))
    model.fix((0, 0, 0), "x")
    model.independent((2, 0, 0), "x")
    with pytest.raises(ModelError) as error:
        model.pattern(2, step=(2, 0, 0), parts=["bar"])
    assert code_of(error) == "class-conflict"
    model.truss((5, 5, 5), (6, 5, 5))
    given = model.data.properties
    assert given is not None
    assert (~np.isnan(given.stiffness[:, 0])).tolist() == [True, False, False]
