# SPDX-License-Identifier: BSD-3-Clause
"""Freedom and constraint spaces in words: names first, the same in every place and scale."""

from __future__ import annotations

import re
from collections.abc import Callable

import pytest
from part_models import PLACES, Place, Placed, cross_hinge, guide, wires_on_a_helix
from spaces_models import SHEETS, WIRES, on_sheets, on_wires

import flexact
from flexact import Model
from flexact.advice.spaces.spaces import spaces_lines, spaces_of
from flexact.advice.spaces.subjects import Freed
from flexact.analysis.naming import plain

pytestmark = pytest.mark.dear(15)

_NUMBER = r"-?\d+(?:\.\d+)?(?:e[+-]\d+)?"
#: What may change with place, scale and turn: points, directions, planes and pitches.
_CHANGES = (
    (rf"\((?:(?:{_NUMBER}|\*), )+(?:{_NUMBER}|\*)\) m", "PLACE"),
    (rf"-?\((?:{_NUMBER}, )+{_NUMBER}\)|(?<!\w)-?[xyz](?!\w)", "WAY"),
    (rf"plane WAY = {_NUMBER} m|plane through PLACE perpendicular to WAY", "PLANE"),
    (rf"pitch {_NUMBER}", "PITCH"),
)


def words(model: Model, *wanted: str) -> str:
    result = flexact.analyse(model)
    found = spaces_of(result, None, wanted)
    assert found is not None
    lines = spaces_lines(result, found)
    return "\n".join(plain(line.head) + "; ".join(map(plain, line.items)) for line in lines)


def without_numbers(text: str) -> str:
    for pattern, word in _CHANGES:
        text = re.sub(pattern, word, text)
    return text


def wires(place: Place) -> Model:
    """The guide whose lower two wires are parallel."""
    lines = WIRES["guide with lower two parallel"]
    points = {"centre": (0.0, 0.0, 0.05)}
    for k, (end, way) in enumerate(lines):
        points[f"body {k}"] = tuple(end)
        points[f"ground {k}"] = tuple(a + 0.1 * b for a, b in zip(end, way, strict=True))
    made = Placed(place, points)
    made.body(["centre", *(f"body {k}" for k in range(len(lines)))], "stage")
    for k in range(len(lines)):
        made.wire(f"ground {k}", f"body {k}", f"wire {k + 1}")
        made.fix(f"ground {k}")
    return made.model


@pytest.mark.grid
@pytest.mark.parametrize("place", PLACES.values(), ids=PLACES)
@pytest.mark.parametrize("make", [guide, cross_hinge, wires_on_a_helix, wires])
def test_words_are_the_same_in_every_place(make: Callable[[Place], Model], place: Place) -> None:
    assert without_numbers(words(make(place))) == without_numbers(words(make(Place())))


def test_words_do_not_depend_on_how_a_sheet_is_divided() -> None:
    assert words(guide()) == words(guide(beams=4))
    deck = "input_decks/flexures/cross_hinge{}undeclared.dat".format
    assert words(flexact.read(deck("_"))) == words(flexact.read(deck("_four_beams_")))


@pytest.mark.parametrize(
    ("name", "phrases"),
    [
        (
            "one wire",
            ["all lines that meet the line of wire 1", "a force along the line of wire 1"],
        ),
        ("two skew wires", ["all lines that meet the line of wire 1 and the line of wire 2"]),
        ("three wires in a plane", ["rotation about all lines in the plane z = 0.02 m"]),
        ("three wires through a point", ["forces along all lines through (0, 0, 0.1) m"]),
        ("guide", ["translation along z", "all lines perpendicular to z"]),
        ("six wires", ["cannot move", "redundant along any line"]),
    ],
)
def test_wires_are_named(name: str, phrases: list[str]) -> None:
    text = words(on_wires(WIRES[name]))
    for phrase in phrases:
        assert phrase in text


def test_a_plane_goes_by_the_sheet_in_it_and_a_point_by_its_name() -> None:
    text = words(on_sheets(SHEETS["one sheet"]))
    assert "rotation about all lines in the plane of sheet 1" in text
    model = on_wires(WIRES["three wires through a point"])
    model.body(["stage", model.node(0.0, 0.0, 0.1, name="apex")])
    assert "rotation about all lines through the apex" in words(model)


def test_what_is_wanted_stopped_and_impossible_is_said() -> None:
    table = on_wires(WIRES["three parallel wires"])
    text = words(table, "stage: translation x", "stage: translation y", "stage: translation z")
    assert "Wanted: translation along x; translation along y" in text
    assert "Wanted, but stopped: translation along z." in text
    assert "No wire can stop it" in text
    declared = on_wires(WIRES["guide"])
    declared.independent("stage", "z")
    text = words(declared)
    assert "Wanted, as declared: translation along z" in text
    assert "Nothing else of the stage moves." in text


def test_wires_say_where_they_end() -> None:
    text = words(on_wires(WIRES["guide with lower two parallel"]), "stage: translation z")
    assert re.search(r"a wire from the stage, where wire \d ends, along -?y", text)


def test_a_declaration_that_is_taken_back_is_said() -> None:
    model = on_wires(WIRES["guide with lower two parallel"])
    model.independent("stage", "z")
    text = words(model, "stage: rotation x")
    assert "the declaration is taken back of: the stage along z" in text


def test_wires_that_would_only_cause_self_stress_are_not_proposed() -> None:
    """In the trap what moves is declared elsewhere: a wire would stop a declared freedom."""
    trap = flexact.analyse("input_decks/flexures/five_folded_sheets_trap.dat")
    found = spaces_of(trap, "upper 90, fold")
    assert found is not None
    assert found.stoppable == 2
    assert found.steps == ()
    text = "\n".join(plain(line.head) for line in spaces_lines(trap, found))
    assert "none stops only that and causes no self-stress" in text


def test_what_is_left_out_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of very large mechanisms the core keeps only some of the motions."""
    result = flexact.analyse(on_wires(WIRES["guide"]))
    monkeypatch.setattr(Freed, "is_known", False)
    assert spaces_of(result) is None
    (line,) = spaces_lines(result, None)
    assert "left out" in plain(line.head)
    with pytest.raises(flexact.ModelError, match="motions, too many"):
        spaces_of(result, "stage")
    trusses = flexact.analyse("input_decks/paper/twelve_trusses.dat")
    assert spaces_lines(trusses, spaces_of(trusses)) == ()
