"""Warnings about what can be analysed and is hardly meant, of decks and of models made in Python.

What is a mistake and what is not is put together by hand.
"""

import runpy

import numpy as np
import pytest
from reference_decks import NAMES, ROOT, text_of

import flexact
from flexact.deck.diagnostics import Diagnostic, Severity

#: Sample decks that mean what they are warned of, and codes.
MEANT = {"frameworks/third_order_finite": ["coincident-nodes"]}
OF_SLIPS = {
    "coincident-nodes",
    "same-part-twice",
    "beside-rigid-link",
    "repeated-name",
    "unused-node",
    "no-support",
    "lengths-differ",
    "long-sheet",
    "unlikely-modulus",
    "unlikely-density",
    "thick-section",
    "nearly-equal-components",
}


def slips(model: flexact.Model) -> list[Diagnostic]:
    return [item for item in model.diagnostics if item.code in OF_SLIPS]


def codes(model: flexact.Model) -> list[str]:
    return [item.code for item in slips(model)]


def of_deck(deck: str) -> list[Diagnostic]:
    """What is found in a deck, and likewise, but for the places, in its model changed."""
    model = flexact.read_text(deck)
    again = flexact.Model.from_data(model.data)
    again.handle(int(again.node_numbers[again.node_kinds <= 2][0]))
    assert sorted(codes(again)) == sorted(codes(model))
    assert not any(item.line for item in again.diagnostics)
    return slips(model)


@pytest.mark.parametrize("name", NAMES)
def test_sample_decks_are_not_warned_of(name: str) -> None:
    assert [item.code for item in of_deck(text_of(name))] == MEANT.get(name, [])


# Two nodes at one place --------------------------------------------------------------------

TWO_SHEETS = """\
BEAM 1  1 2 3 4  0 1 0 % sheet 1
BEAM 2  5 6 7 8  0 1 0 % sheet 2
X 3  0.1 0 0
X 5  0.1 0 0
X 7  0.2 0 0
FIX 1
FIX 2
RLSE 1 2 5 6
RLSE 2 2 5 6
"""


def test_ends_at_one_place_that_nothing_joins() -> None:
    (found,) = of_deck(TWO_SHEETS)
    assert (found.severity, found.code) == (Severity.WARNING, "coincident-nodes")
    assert (found.line, found.column, found.last_column) == (4, 1, 12)
    assert found.other is not None
    assert found.other.line == 3
    assert "node 3" in found.message
    assert "node 5" in found.message
    assert found.help


def test_points_are_named() -> None:
    model = flexact.Model()
    clamp, end = model.node(0, 0, 0, name="clamp"), model.node(0.1, 0, 0, name="end of sheet 1")
    edge, far = model.node(0.1, 1e-17, 0, name="edge of the stage"), model.node(0.2, 0, 0)
    model.fix(clamp)
    model.sheet(clamp, end, (0, 0, 1), name="sheet 1")
    model.rigid(edge, far, name="stage")
    (found,) = slips(model)
    assert "'end of sheet 1' and 'edge of the stage'" in found.message
    assert (found.line, found.severity) == (0, Severity.WARNING)
    assert found in flexact.analyse(model).warnings


@pytest.mark.parametrize(
    "joint",
    [
        "PINBODY 9 3 4 5",
        "PINBODY 9 5 6 3",
        "BEARING 9 3 4 5 6 0 0 1\nRLSE 9 4",
        # One rigid body, by way of a third point.
        "X 11 0 1 0\nRBEAM 9 11 12 3\nRBEAM 10 11 12 5",
        "X 11 0 1 0\nBEAM 9 11 12 3 13\nBEAM 10 11 12 14 15\nX 14 0 2 0\nRBEAM 20 14 15 5",
        # The ground.
        "FIX 3\nFIX 5",
        # A rigid link from the ground.
        "X 11 0 1 0\nRBEAM 9 11 12 3\nFIX 11\nFIX 12\nFIX 5",
    ],
)
def test_what_joins_them(joint: str) -> None:
    assert of_deck(TWO_SHEETS + joint + "\n") == []


@pytest.mark.parametrize(
    "no_joint",
    [
        # Two bodies that share a point turn about it.
        "X 11 0 1 0\nRBEAM 9 11 12 3\nRBEAM 10 11 13 5",
        "X 11 0 1 0\nBEAM 9 11 12 3 13 0 0 1\nBEAM 10 11 12 5 14 0 0 1\nRLSE 10 5",
        "FIX 3",
        "FIX 3 1 2\nFIX 5",
    ],
)
def test_what_does_not(no_joint: str) -> None:
    assert [item.code for item in of_deck(TWO_SHEETS + no_joint + "\n")] == ["coincident-nodes"]


def test_crossing_sheets_may_pass_each_other() -> None:
    model = flexact.Model(planar=True)
    corners = [model.node(x, y) for x, y in ((0, 0), (1, 1), (0, 1), (1, 0))]
    model.fix(corners[0])
    model.fix(corners[2])
    model.sheet(corners[0], corners[1], beams=4, name="rising")
    model.sheet(corners[2], corners[3], beams=4, name="falling")
    model.rigid(corners[1], corners[3], name="stage")
    assert codes(model) == []
    # But an end in the middle of another one does not.
    model.rigid(model.node(0.5, 0.5), corners[3])
    assert codes(model) == ["coincident-nodes"]


def test_hubs_of_two_bodies_may_be_at_one_place() -> None:
    model = flexact.Model()
    for k in (1, 2):
        hub = model.node(0, 0, 0)
        for end in ((k, 0, 0), (0, k, 0), (0, 0, k)):
            wire = model.node(*end)
            model.rigid(hub, wire)
            foot = model.node(*(2 * part + 0.1 for part in end))
            model.wire(wire, foot)
            model.fix(foot)
    assert codes(model) == []


def test_nearly_at_one_place() -> None:
    for shift, wanted in ((1e-12, 1), (0.9e-10, 1), (1e-7, 0)):
        deck = TWO_SHEETS.replace("X 5  0.1 0 0", f"X 5  {0.1 + shift!r} {-shift!r} 0")
        assert len(of_deck(deck)) == wanted, shift
        for scale in (1e-6, 1e3):
            model = flexact.Model()
            points = [
                model.node(*(scale * part for part in point))
                for point in ((0, 0, 0), (0.1, 0, 0), (0.1 + shift, -shift, 0), (0.2, 0, 0))
            ]
            model.fix(points[0])
            model.beam(points[0], points[1])
            model.beam(points[2], points[3])
            assert len(slips(model)) == wanted


def test_many_at_one_place_are_one_warning_each() -> None:
    model = flexact.Model()
    clamp = model.node(0, 0, 0)
    model.fix(clamp)
    for k in range(5):
        model.truss(model.node(1, 0, 0), model.node(2, k, 0))
    model.truss(clamp, model.node(1, 1, 1))
    assert codes(model) == ["coincident-nodes"] * 4


@pytest.mark.parametrize("seed", range(5))
def test_places_are_found_wherever_they_are(seed: int) -> None:
    """Against all pairs, one by one."""
    rng = np.random.default_rng(seed)
    place = rng.uniform(-1, 1, (60, 3)) + rng.choice([0.0, 10.0, -3.0], 3)
    place[30:] = place[rng.integers(0, 30, 30)] + rng.choice([0.0, 1e-11, 1e-4], (30, 1))
    extent = np.ptp(place, axis=0).max()
    near = np.abs(place[:, None] - place[None]).max(axis=2) <= 1e-9 * extent
    first = [int(np.flatnonzero(row)[0]) for row in near]
    model = flexact.Model()
    # Nothing is shared, so that every further one at a place is warned of.
    for point in place.tolist():
        model.truss(model.node(*point), model.node(*(part + 0.5 for part in point)))
    both = np.concatenate([place, place + 0.5])
    assert np.ptp(both, axis=0).max() >= extent
    wanted = 2 * sum(i != k for i, k in enumerate(first))
    assert codes(model).count("coincident-nodes") == wanted


# The same part twice -----------------------------------------------------------------------

GUIDE = "BEAM 1 1 2 3 4 0 1 0 % sheet 1\nX 3 0.1 0 0 % end\nFIX 1\nFIX 2\nRLSE 1 2 5 6\n"


@pytest.mark.parametrize("nodes", ["1 2 3 4", "3 4 1 2"])
def test_the_same_part_twice(nodes: str) -> None:
    (found,) = of_deck(GUIDE + f"BEAM 4 {nodes} 0 1 0 % sheet 2\nRLSE 4 2 5 6\n")
    assert (found.severity, found.code, found.line) == (Severity.WARNING, "same-part-twice", 6)
    assert found.other is not None
    assert found.other.line == 1
    assert "'sheet 1' and 'sheet 2'" in found.message


def test_twins_of_one_name_are_told_apart() -> None:
    model = flexact.Model(planar=True)
    p, q = model.node(0, 0), model.node(1, 0)
    model.fix(p)
    for _ in range(2):
        model.truss(p, q, "bar")
    (found,) = slips(model)
    assert "'bar' (PLTRUSS 1) and 'bar' (PLTRUSS 2)" in found.message


@pytest.mark.parametrize(
    "beside",
    [
        "TRUSS 2 1 3",
        "BEAM 2 1 5 3 6 0 1 0\nRLSE 2 2 5 6\nFIX 5",
        "HINGE 2 2 4 0 0 1\nRLSE 2",
        "TRUSS 2 1 3\nTRUSS 3 3 1\nRLSE 2\nDYNE 3",
    ],
)
def test_other_things_between_two_nodes(beside: str) -> None:
    assert of_deck(GUIDE + beside + "\n") == []


def test_hinges_twice() -> None:
    deck = GUIDE + "HINGE 2 4 5 0 0 1\nHINGE 3 5 4 0 0 1\nRLSE 2 1\nRLSE 3 1\n"
    assert [item.code for item in of_deck(deck)] == ["same-part-twice"]


# Beside a rigid link -----------------------------------------------------------------------


@pytest.mark.parametrize(
    "rigid", ["BEAM 2 1 2 3 4", "RBEAM 2 1 2 3", "RBEAM 2 3 4 1", "PINBODY 2 3 4 1"]
)
def test_a_beam_beside_a_rigid_link(rigid: str) -> None:
    (found,) = of_deck(GUIDE + f"{rigid} % stage\n")
    assert (found.severity, found.code, found.line) == (Severity.WARNING, "beside-rigid-link", 1)
    assert found.other is not None
    assert found.other.line == 6
    assert found.message.startswith("'sheet 1' lies beside 'stage'")


# Names -------------------------------------------------------------------------------------


def two_bars(one: str, other: str) -> flexact.Model:
    model = flexact.Model()
    points = [model.node(k, k * k, 0) for k in range(4)]
    model.fix(points[0])
    model.fix(points[2])
    model.truss(points[0], points[1], one)
    model.truss(points[2], points[3], other)
    return model


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("leg", "leg"),
        ("leg, 1", "leg, 2"),
        ("leg", "leg, 12"),
        ("leg, part 1 of 2", "leg, part 2 of 2"),
        ("Träger 梁", "Träger 梁"),
        ("a, b", "a, b"),
    ],
)
def test_one_name_twice(one: str, other: str) -> None:
    (found,) = slips(two_bars(one, other))
    assert (found.severity, found.code) == (Severity.WARNING, "repeated-name")
    name = one.removesuffix(", 1").removesuffix(", part 1 of 2")
    assert found.message == f"2 parts that do not hang together are called '{name}'"
    # In a deck it is a comment, so a note, and has its places.
    (note,) = slips(flexact.read_text(two_bars(one, other).to_deck()))
    assert (note.severity, note.code, note.line) == (Severity.NOTE, "repeated-name", 2)
    assert note.other is not None
    assert note.other.line == 1


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("leg 1", "leg 2"),
        ("leg", "Leg"),
        ("", ""),
        ("leg, a", "leg, b"),
        ("leg 1 of 2", "leg 2 of 2"),
    ],
)
def test_two_names(one: str, other: str) -> None:
    assert slips(two_bars(one, other)) == []


def test_a_part_has_one_name() -> None:
    model = flexact.Model()
    clamp, hub, end = model.node(0, 0, 0), model.node(1, 0, 0), model.node(2, 0, 0)
    model.fix(clamp)
    model.sheet(clamp, hub, (0, 0, 1), beams=5, name="sheet 1")
    model.rigid(hub, end, "stage, 1")
    model.rigid(hub, model.node(2, 1, 0), "stage, 2")
    assert slips(model) == []


def test_one_name_of_two_points() -> None:
    model = flexact.Model()
    tip, other = model.node(0, 0, 0, name="tip"), model.node(1, 0, 0, name="tip")
    model.truss(tip, other, "tip")
    model.fix(tip)
    (found,) = slips(model)
    assert (found.code, found.message) == ("repeated-name", "2 points are called 'tip'")
    # A name of an orientation is no name of a point.
    assert slips(flexact.read_text(GUIDE + "X 2 1 0 0 0 % end\n")) == []


def test_long_names_are_cut_between_characters() -> None:
    name = "ü" * 200
    (found,) = slips(two_bars(name, name))
    assert "ü" * 20 in found.message
    assert set(found.message.split("'")[1]) == {"ü", "."}


# Nodes that nothing uses -------------------------------------------------------------------


def test_points_that_nothing_uses() -> None:
    model = two_bars("a", "b")
    model.node(1, 2, 3, name="spare")
    (found,) = slips(model)
    assert (found.severity, found.code) == (Severity.WARNING, "unused-node")
    assert "'spare'" in found.message
    for k in range(9):
        model.node(k, k, k)
    (found,) = slips(model)
    assert "and 5 more" in found.message
    assert found in flexact.analyse(model).warnings


def test_a_point_is_used_by_its_orientation() -> None:
    model = flexact.Model()
    point = model.node(0, 0, 0)
    model.fix(point, "rx", "ry", "rz")
    model.hinge(point, (0, 0, 1))
    assert slips(model) == []


def test_a_deck_calls_it_an_error_as_before() -> None:
    with pytest.raises(flexact.DeckError) as caught:
        flexact.read_text(GUIDE + "X 9 1 1 1\n")
    assert [item.code for item in caught.value.diagnostics] == ["no-such-node"]


# No support --------------------------------------------------------------------------------


@pytest.mark.parametrize("declared", ["", "DYNX 1\n", "DYNX 1\nDYNX 2 2 3\n"])
def test_no_support(declared: str) -> None:
    (found,) = of_deck(GUIDE.replace("FIX 1\nFIX 2\n", declared))
    assert (found.severity, found.code, found.line) == (Severity.WARNING, "no-support", 0)


@pytest.mark.parametrize("said", ["FIX 3 1\n", "DYNX 1\nDYNX 2\n"])
def test_a_support_or_six_freedoms(said: str) -> None:
    assert of_deck(GUIDE.replace("FIX 1\nFIX 2\n", said)) == []


def test_no_support_in_the_plane() -> None:
    model = flexact.Model(planar=True)
    p, q = model.node(0, 0), model.node(1, 0)
    model.beam(p, q)
    assert codes(model) == ["no-support"]
    model.independent(p)
    assert codes(model) == []


# Lengths -----------------------------------------------------------------------------------


def test_lengths_of_two_units() -> None:
    deck = GUIDE + "BEAM 2 3 4 5 6 0 1 0 % sheet 2\nX 5 200.1 0 0\n"
    (found,) = of_deck(deck)
    assert (found.severity, found.code, found.line) == (Severity.WARNING, "lengths-differ", 6)
    assert found.other is not None
    assert found.other.line == 1
    assert found.message == "'sheet 2' is 2000 times as long as 'sheet 1'"


def test_a_thousand_is_no_mistake() -> None:
    assert of_deck(GUIDE + "BEAM 2 3 4 5 6 0 1 0\nX 5 100.1 0 0\n") == []


def test_bodies_without_length_do_not_count() -> None:
    assert of_deck(GUIDE + "PINBODY 2 3 4 5\nX 5 0.1 0 1e-9\n") == []


# Together ----------------------------------------------------------------------------------


def test_errors_come_alone() -> None:
    with pytest.raises(flexact.DeckError) as caught:
        flexact.read_text("TRUSS 1 1 2\nTRUSS 2 1 2\nTRUSS 3 1 3\nX 3 1 0 0\n")
    assert {item.code for item in caught.value.diagnostics} == {"zero-length"}


@pytest.mark.parametrize("spread", [1.0, 0.0])
def test_a_hundred_thousand_elements(spread: float) -> None:
    """All at one place, or all of one name, or between the same two nodes: each is counted."""
    n = 100_000
    lines = [f"TRUSS {k} {2 * k} {2 * k + 1} % bar" for k in range(1, n)]
    lines += [f"X {2 * k} {spread * k} 0 0\nX {2 * k + 1} {spread * k} 1 0" for k in range(1, n)]
    lines += [f"TRUSS {n + k} 2 3" for k in range(n)]
    problems = flexact.read_text("\n".join(lines)).data.problems
    at_one_place = 0 if spread else 2 * (n - 2)
    # Each bar between nodes 2 and 3 but the first, those at one place, and no support.
    assert problems.warnings == n + at_one_place + 1
    assert problems.notes == 1


# Numbers of another unit -------------------------------------------------------------------

STEEL = {"E": 2.1e11, "G": 8.1e10, "density": 7850.0}


def sheet(
    unit: float = 1.0, thick: float = 5e-4, divided: int = 1, **other: float
) -> flexact.Model:
    """A sheet of 60 mm, in a unit, of a material in others."""
    made = flexact.Model()
    made.fix(made.node(0, 0, 0, name="foot"))
    made.sheet(
        *("foot", made.node(0, 0.06 * unit, 0, name="end"), "z", divided, "leaf"),
        thickness=thick,
        breadth=0.02 * thick / 5e-4,
        material={**STEEL, **other},
    )
    made.independent("end", "x")
    return made


@pytest.mark.parametrize(
    ("made", "wanted", "said"),
    [
        (sheet(1e3, 0.5), ["long-sheet"], "60 mm are 0.06 m"),
        (sheet(150.0, divided=8), ["long-sheet"], "9 mm"),
        (sheet(E=210.0), ["unlikely-modulus"], "GPa"),
        (sheet(E=2.1e5), ["unlikely-modulus"], "MPa"),
        (sheet(E=3e14), ["unlikely-modulus"], "Pa"),
        (sheet(density=7.85), ["unlikely-density"], "g/cm3"),
        (sheet(density=7.85e-6), ["unlikely-density"], "kg/mm3"),
        (sheet(density=7.85e-9), ["unlikely-density"], "t/mm3"),
        (sheet(thick=0.5), ["thick-section"], "0.5 m"),
        (sheet(1e3, 0.5, E=2.1e5), ["long-sheet", "unlikely-modulus"], "mm"),
        (sheet(E=210.0, density=7.85), ["unlikely-modulus", "unlikely-density"], "GPa"),
        (sheet(), [], ""),
        (sheet(density=0.0), [], ""),
    ],
)
def test_numbers_of_another_unit(made: flexact.Model, wanted: list[str], said: str) -> None:
    """One sheet in the units of drawings; its deck has the same, word for word."""
    again = flexact.read_text(made.to_deck())
    for model in (made, again):
        assert codes(model) == wanted
        assert not wanted or said in " ".join(
            f"{item.message} {item.help}" for item in slips(model)
        )
        assert not wanted or "leaf" in slips(model)[0].message
    assert [item.message for item in slips(made)] == [item.message for item in slips(again)]


def test_gallery_models_are_not_warned_of() -> None:
    for file in sorted((ROOT / "docs" / "gallery").glob("*.py")):
        assert codes(runpy.run_path(str(file))["model"]) == [], file
