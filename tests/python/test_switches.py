# SPDX-License-Identifier: BSD-3-Clause
"""Edits by clicking: the model, the lines of the deck and the calls of Python say the same."""

import random
from dataclasses import replace
from functools import cache
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from known_models import guide
from reference_decks import NAMES, ROOT

import flexact
from flexact.analysis.naming import plain
from flexact.apps.watch.edit_session import Session
from flexact.apps.watch.editable_model import (
    Board,
    Edit,
    EditedDeck,
    Place,
    RefusedError,
    edited,
    states_of,
)
from flexact.core.elements import Class
from flexact.model.data import ModelData

pytestmark = pytest.mark.dear(150)

#: How many places of a deck are switched.
MOST = 6
CLASSES = ("deformation_class", "coordinate_class")


def path_of(name: str) -> Path:
    return ROOT / "input_decks" / f"{name}.dat"


@cache
def board_of(name: str) -> Board:
    return Board(flexact.analyse(path_of(name)))


def places_of(board: Board) -> list[Place]:
    arrays = board.given.arrays
    counts = np.count_nonzero(arrays.deformation_class, axis=0).tolist()
    made: dict[Place, None] = {}
    for element, count in zip(arrays.element_number.tolist(), counts, strict=True):
        made.update((board.deformation(element, k), None) for k in range(1, count + 1))
    for index, node in enumerate(arrays.node_number.tolist()):
        made.update((board.coordinate(node, name), None) for name in board.coordinates_of(index))
    return list(made)


def edits_of(board: Board, seed: str) -> list[Edit]:
    """Every state of some places of a mechanism."""
    places = places_of(board)
    some = random.Random(seed).sample(places, min(MOST, len(places)))
    every = ((place, to) for place in some for to in states_of(place).values())
    return [Edit(place, to) for place, to in every if to != board.before(place)]


def same(a: ModelData, b: ModelData, fields: tuple[str, ...] | None = None) -> bool:
    names = a.arrays._fields if fields is None else fields
    return all(np.array_equal(getattr(a.arrays, n), getattr(b.arrays, n)) for n in names)


def by_hand(board: Board, edits: list[Edit]) -> ModelData:
    """The model with its classes set one by one, where nothing is switched as one."""
    arrays = board.given.arrays
    of_deformation, of_coordinate = arrays.deformation_class.copy(), arrays.coordinate_class.copy()
    for place, to in edits:
        if hasattr(place, "element"):
            of_deformation[place.number - 1, board.given.element_index[place.element]] = to
        else:
            axis = "xyz".index(place.name[-1])
            of_coordinate[axis, board.given.node_index[place.node]] = to
    made = arrays._replace(deformation_class=of_deformation, coordinate_class=of_coordinate)
    return replace(board.given, arrays=made, source=None, found=None)


def typed(board: Board, deck: EditedDeck) -> ModelData:
    """The deck as given, with the lines that are shown in the place of those that go."""
    source = board.given.source
    assert source is not None
    lines = source.text.decode("utf-8").replace("\r", "").split("\n")
    goes = {each.line: each for each in deck.statements if each.line}
    assert all(lines[number - 1] == each.old for number, each in goes.items())
    new = [each.new for each in deck.statements if not each.line]
    kept = [goes[k].new if k in goes else line for k, line in enumerate(lines, 1)]
    return flexact.read_text("\n".join([*new, *kept])).data


def without_deck(board: Board) -> Board:
    """The same mechanism as if it were made in Python."""
    data = replace(board.given, source=None, began_as=None)
    return Board(flexact.analyse(flexact.Model.from_data(data)))


def called(given: ModelData, calls: list[str]) -> ModelData:
    model = flexact.Model.from_data(given)
    for call in calls:
        exec(call, {"model": model})
    return model.data


@pytest.mark.grid
@pytest.mark.parametrize("name", NAMES)
def test_an_edit_is_the_deck_with_its_lines_and_the_model_after_its_calls(name: str) -> None:
    board = board_of(name)
    python = without_deck(board)
    for edit in edits_of(board, name):
        wanted = board.model((edit,))
        index = board.given.element_index.get(getattr(edit.place, "element", 0))
        if index not in board.wholes:
            assert same(wanted, by_hand(board, [edit]))
        assert not same(wanted, board.given)
        deck = edited(board.given, wanted)
        assert not deck.is_anew
        assert same(typed(board, deck), wanted)
        assert same(flexact.read_text(deck.text).data, wanted)
        words = [call.in_words() for call in python.calls((edit,))]
        assert same(called(python.given, words), wanted, CLASSES)


@pytest.mark.parametrize("name", NAMES[::4])
def test_several_edits_together(name: str) -> None:
    board = board_of(name)
    python = without_deck(board)
    one_each = {edit.place: edit for edit in edits_of(board, name)}
    edits = tuple(one_each.values())
    wanted = board.model(edits)
    if not board.wholes:
        assert same(wanted, by_hand(board, list(edits)))
    assert same(typed(board, edited(board.given, wanted)), wanted)
    words = [call.in_words("model") for call in python.calls(edits)]
    assert same(called(python.given, words), wanted, CLASSES)


def test_comments_and_what_is_not_analysed_stay() -> None:
    text = (
        "% a guide\nBEAM 1 1 2 3 4 0 1 0 % sheet 1\nX 3 0.1 0 0\nFIX 1 % ground\nFIX 2\n"
        "rlse 1  2 5 6   # free\nEND\nHALT\nTIMESTEP 1 100 % unused\nEND\n"
    )
    board = Board(flexact.analyse(flexact.read_text(text)))
    released = Edit(board.deformation(1, 3), Class.DEPENDENT)
    free = Edit(board.coordinate(1, "y"), Class.DEPENDENT)
    deck = edited(board.given, board.model((released, free)))
    new = text.replace("rlse 1  2 5 6 ", "rlse 1 2 3 5 6 ").replace("FIX 1 ", "FIX 1 1 3 ")
    assert deck.text.decode() == new
    assert [each.to_copy() for each in deck.statements] == [
        "FIX 1 1 3 % ground   % instead of line 4: FIX 1 % ground",
        "rlse 1 2 3 5 6   # free   % instead of line 6: rlse 1  2 5 6   # free",
    ]


@pytest.mark.parametrize("number", range(1, 7))
@pytest.mark.parametrize("to", list(Class)[1:])
def test_a_divided_sheet_is_switched_as_one_beam(number: int, to: Class) -> None:
    """The truth is the deck in which each sheet is one beam."""
    counts = []
    for name in ("flexures/parallel_guide", "flexures/parallel_guide_four_beams"):
        board = board_of(name)
        place = board.deformation(board.parts.named("left sheet").number, number)
        made = flexact.analyse(flexact.Model.from_data(board.model((Edit(place, to),))))
        counts.append((made.under_constrained, made.over_constrained))
    assert counts[0] == counts[1]


def test_every_beam_of_a_divided_sheet_is_the_sheet() -> None:
    board = board_of("flexures/parallel_guide_four_beams")
    sheet = board.parts.named("left sheet")
    numbers = board.given.arrays.element_number[list(sheet.elements)].tolist()
    assert len({board.deformation(number, 3) for number in numbers}) == 1
    undeclared = board_of("flexures/parallel_guide_four_beams_undeclared")
    assert len({undeclared.deformation(number, 3) for number in numbers}) == len(numbers)


@pytest.mark.parametrize("beams", [1, 3])
def test_calls_are_words_where_the_builder_has_them(beams: int) -> None:
    """On the very model that the builder made, which notes more than its arrays say."""
    board = Board(flexact.analyse(guide(beams)))
    for number, to in product(range(1, 7), list(Class)[1:]):
        place = board.deformation(board.parts.all[0].number, number)
        edits = board.edited((), [Edit(place, to)])
        calls = board.calls(edits)
        model = guide(beams)
        for call in calls:
            exec(call.in_words("own_name"), {"own_name": model})
        assert same(model.data, board.model(edits), CLASSES)


def test_calls_use_names() -> None:
    model = flexact.Model(name="guide")
    for k, y in enumerate((0.0, 0.05), start=1):
        model.sheet((0, y, 0), (0.1, y, 0), width=(0, 0, 1), name=f"sheet {k}")
        model.fix((0, y, 0))
    model.body([(0.1, 0, 0), (0.1, 0.05, 0)], name="stage")
    model.independent("stage", "y")
    session = Session(Path("guide.py"), model="guide")
    session.renew(flexact.analyse(model))
    node = int(model.node_numbers[0])
    switched(session, {"element": 1, "deformation": 3, "to": "released"})
    switched(session, {"node": node, "coordinate": "y", "to": "free"})
    assert session.told()["calls"] == [
        'guide.release("sheet 1", "in-plane bending", at=(0, 0, 0))',
        'guide.clear((0, 0, 0), "y")',
    ]
    assert session.told()["lines"] == []


# Sessions -----------------------------------------------------------------------


def session_of(model: Any, watched: Path = Path("guide.dat")) -> Session:
    session = Session(watched)
    session.renew(flexact.analyse(model))
    return session


def switched(session: Session, *edits: dict[str, Any]) -> bool:
    changed = changes(session, "set", set=list(edits))
    session.analysed(flexact.analyse(flexact.Model.from_data(session.model())))
    return changed


def changes(session: Session, do: str, **what: Any) -> bool:
    """Whether a request changes the mechanism."""
    before = session.history.now
    session.ask({"do": do, **what})
    return session.history.now != before


def in_plane(to: str = "released", number: int = 3) -> dict[str, Any]:
    return {"element": 1, "deformation": number, "to": to}


GUIDE = path_of("flexures/parallel_guide")


def test_undo_redo_reset_and_taking_one_away() -> None:
    session = session_of(GUIDE)
    assert switched(session, in_plane()) and switched(session, in_plane(number=4))
    assert [each["place"]["deformation"] for each in session.told()["edits"]] == [3, 4]
    assert changes(session, "undo")
    assert len(session.history.now) == 1 and session.told()["redo"]
    assert changes(session, "redo") and not changes(session, "redo")
    assert switched(session, in_plane("given"))
    assert [each["place"]["deformation"] for each in session.told()["edits"]] == [4]
    assert changes(session, "reset")
    assert same(session.model(), session.board.given) and changes(session, "undo")
    # What is as it was given is no edit, and changes nothing.
    assert switched(session, in_plane("held", 4)) and not switched(session, in_plane("held", 4))
    assert session.told()["edits"] == [] and session.told()["copy"] == ""


@pytest.mark.parametrize("seed", range(20))
def test_whatever_is_clicked_can_be_undone(seed: int) -> None:
    rng = random.Random(seed)
    name = rng.choice([each for each in NAMES if each.startswith("flexures")])
    board = board_of(name)
    session = Session(path_of(name))
    session.renew(board.base)
    places = places_of(board)
    states = [session.history.now]
    for _ in range(12):
        some = rng.sample(places, min(2, len(places)))
        new = board.edited(
            session.history.now,
            [Edit(place, rng.choice(list(states_of(place).values()))) for place in some],
        )
        session.history = session.history.taken(new)
        if session.history.now != states[-1]:
            states.append(session.history.now)
    for state in reversed(states):
        assert session.history.now == state
        session.ask({"do": "undo"})
    assert same(session.model(), board.given)


#: Folds and a waist; parts that move; a part that is left out; insides of divided sheets.
STEPPED = (
    "paper/folded_sheet_clamped",
    "paper/five_folded_sheets_symmetric",
    "paper/twelve_trusses",
    "flexures/planar_guide_three_sheets",
    "flexures/cross_hinge_four_beams_undeclared",
)


@pytest.mark.parametrize("name", STEPPED)
def test_steps_are_those_of_the_advice_and_the_deck_does_what_they_say(name: str) -> None:
    analysis = flexact.analyse(path_of(name))
    session = session_of(path_of(name))
    advised = analysis.advice()[:3]
    assert [one.words for one in session.steps()] == [plain(one.pieces) for one in advised]
    for step in advised:
        assert changes(session, "try", step=plain(step.pieces))
        made = flexact.analyse(flexact.read_text(session.deck().text.decode()))
        counts = (made.verdict, made.under_constrained, made.over_constrained)
        assert counts == step.after[:3]
        assert changes(session, "undo")
    assert same(session.model(), analysis.given)


def test_what_a_step_has_made_is_switched_further() -> None:
    session = session_of(path_of("paper/twelve_trusses"))
    declared = "Declare E along y and leave out the leg AE (DYNX 5 2, without TRUSS 1)."
    assert changes(session, "try", step=declared)
    session.analysed(flexact.analyse(flexact.Model.from_data(session.model())))
    with pytest.raises(RefusedError, match="there is no element 1"):
        session.ask({"do": "look", "element": 1})
    with pytest.raises(RefusedError, match="another state"):
        session.ask({"do": "try", "step": declared})
    assert switched(session, {"node": 5, "coordinate": "y", "to": "free"})
    first, second = session.told()["edits"]
    assert first == {"words": declared}
    assert second["words"] == "E along y: independent \N{RIGHTWARDS ARROW} free"
    made = flexact.analyse(flexact.read_text(session.deck().text.decode()))
    # Four joints of three coordinates, and one bar of twelve left out.
    assert (made.columns, made.rows) == (12, 11)
    assert changes(session, "undo") and changes(session, "undo")
    assert same(session.model(), session.board.given) and session.told()["edits"] == []


def test_steps_stay_when_the_file_is_saved_and_go_when_it_says_them() -> None:
    for name, why in zip(STEPPED[:3], ("The file says so itself now", "", "Dropped"), strict=True):
        session = session_of(path_of(name))
        step = session.steps()[name.endswith("trusses")]
        assert changes(session, "try", step=step.words)
        assert session.renew(flexact.analyse(path_of(name))) == ()
        assert session.history.now == (step,)
        if why:
            text = session.deck().text.decode()
            (said,) = session.renew(flexact.analyse(flexact.read_text(text)))
            assert said.startswith(why) and step.words in said
            assert session.history.now == ()


def test_a_step_in_python_is_a_call_that_does_it() -> None:
    model = guide()
    session = session_of(model, Path("guide.py"))
    session.model_name = "guide"
    assert changes(session, "try", step=session.steps()[0].words)
    (call,) = session.told()["calls"]
    assert call == "guide = flexact.analyse(guide).advice()[0].apply()"
    names = {"flexact": flexact, "guide": model}
    exec(call, names)
    made = names["guide"]
    assert isinstance(made, flexact.Model) and same(made.data, session.model(), CLASSES)
    assert flexact.analyse(made).verdict is flexact.Verdict.EXACT


@pytest.mark.parametrize("name", [n for n in NAMES if "grid" not in n])
def test_proposals_do_what_they_say(name: str) -> None:
    """One motion or one self-stress less; all at once where it says so."""
    session = Session(path_of(name))
    base = board_of(name).base
    session.renew(base)
    for each in session.proposals():
        head = each["head"]
        if head.startswith("To count"):
            continue
        for item in each["items"][:2]:
            for choice in item["choices"]:
                assert changes(session, "set", set=choice["set"])
                edits = session.history.now
                made = flexact.analyse(flexact.Model.from_data(session.board.model(edits)))
                session.ask({"do": "reset"})
                before = (base.under_constrained, base.over_constrained)
                after = (made.under_constrained, made.over_constrained)
                kind = 0 if "settle" in head or "folds" in head else 1
                less = before[kind] if "all" in head else 1
                less = len(base.folds) if "folds" in head else less
                assert after[kind] == before[kind] - less, (head, item["words"])
                assert after[1 - kind] == before[1 - kind]


def test_what_is_inside_of_divided_sheets_is_declared_at_once() -> None:
    session = session_of(path_of("flexures/parallel_guide_four_beams_undeclared"))
    first = session.told()["proposals"][0]
    assert first["head"].startswith("To count")
    assert switched(session, *first["items"][0]["choices"][0]["set"])
    one_beam = board_of("flexures/parallel_guide_undeclared").base
    now = flexact.analyse(flexact.Model.from_data(session.model()))
    counts = [(each.under_constrained, each.over_constrained) for each in (now, one_beam)]
    assert counts == [(1, 1), (1, 1)]


def test_a_part_offers_its_deformations_and_a_point_its_coordinates() -> None:
    session = session_of(GUIDE)
    panel = session.ask({"do": "look", "element": 1})["panel"]
    rows = {row["words"]: row for row in panel["groups"][0]["rows"]}
    assert list(rows) == [
        "elongation",
        "twist",
        "in-plane bending at the ground",
        "in-plane bending at the body",
        "out-of-plane bending at the ground",
        "out-of-plane bending at the body",
    ]
    assert rows["twist"]["now"] == "released" and rows["elongation"]["now"] == "held"
    assert rows["in-plane bending at the ground"]["proposed"] == ["released"]
    point = session.ask({"do": "look", **panel["near"][0]})["panel"]
    words = [row["words"] for row in point["groups"][0]["rows"]]
    assert words == ["along x", "along y", "along z", "about x", "about y", "about z"]
    assert {row["now"] for row in point["groups"][0]["rows"]} == {"fixed"}
    body = session.ask({"do": "look", "name": "the body"})["panel"]
    states = {row["words"]: row["now"] for row in body["groups"][0]["rows"]}
    assert states["along y"] == "free" and list(states.values()).count("independent") == 1


@pytest.mark.parametrize("name", NAMES)
def test_everything_can_be_looked_at(name: str) -> None:
    board = board_of(name)
    session = Session(path_of(name))
    session.renew(board.base)
    seen = set()
    arrays = board.given.arrays
    for key, numbers in (("element", arrays.element_number), ("node", arrays.node_number)):
        for number in numbers.tolist()[:80]:
            panel = session.ask({"do": "look", key: number})["panel"]
            rows = [row for group in panel["groups"] for row in group["rows"]]
            assert panel["title"] and rows
            words = [
                (group["title"], row["words"]) for group in panel["groups"] for row in group["rows"]
            ]
            assert len(words) == len(set(words))
            seen.update(tuple(row["place"].items()) for row in rows)
            for near in panel["near"]:
                session.ask({"do": "look", **{k: near[k] for k in near if k != "words"}})
    if len(arrays.element_number) <= 80 >= len(arrays.node_number):
        assert len(seen) == len(places_of(board))
    for each in session.told()["names"]:
        session.ask({"do": "look", "name": each["words"]})


# Decks that are saved meanwhile -----------------------------------------------------

TWO = (
    "BEAM 1 1 2 3 4 0 1 0 % sheet 1\nBEAM 2 5 6 7 8 0 1 0 % sheet 2\nBEAM 3 3 4 7 8 % stage\n"
    "X 3 0.1 0 0\nX 5 0 0.05 0\nX 7 0.1 0.05 0\nFIX 1\nFIX 2\nFIX 5\nFIX 6\n"
    "RLSE 1 2 5 6\nRLSE 2 2 5 6\nDYNX 3 2\n"
)


def renewed(text: str, *edits: dict[str, Any], first: str = TWO) -> tuple[Session, tuple[str, ...]]:
    session = session_of(flexact.read_text(first))
    switched(session, *edits)
    return session, session.renew(flexact.analyse(flexact.read_text(text)))


SECOND = {"element": 2, "deformation": 4, "to": "released"}
CLAMP = {"node": 6, "coordinate": "ry", "to": "free"}


def places(session: Session) -> list[tuple[int, ...]]:
    return [tuple(each.place) for each in session.history.now]


def test_edits_stay_where_the_deck_only_changed_elsewhere() -> None:
    session, said = renewed(TWO.replace("0.05", "0.06"), SECOND, CLAMP)
    assert places(session) == [(2, 4), (6, "ry")] and said == ()
    assert session.told()["undo"]


def test_edits_follow_names_to_other_numbers() -> None:
    other = TWO.replace("BEAM 2", "BEAM 7").replace("RLSE 2", "RLSE 7")
    session, said = renewed(other, SECOND)
    assert places(session) == [(7, 4)] and said == ()
    # The other sheet has the number now.
    exchanged = TWO.replace(
        "BEAM 1 1 2 3 4 0 1 0 % sheet 1", "BEAM 1 5 6 7 8 0 1 0 % sheet 2"
    ).replace("BEAM 2 5 6 7 8 0 1 0 % sheet 2", "BEAM 2 1 2 3 4 0 1 0 % sheet 1")
    exchanged = exchanged.replace("BEAM 2 5 6 7 8 0 1 0 % sheet 2\n", "")
    session, said = renewed(exchanged, SECOND)
    assert places(session) == [(1, 4)] and said == ()


def test_edits_follow_a_part_that_was_renamed() -> None:
    session, said = renewed(TWO.replace("sheet 2", "right sheet"), SECOND)
    assert places(session) == [(2, 4)] and said == ()


def test_edits_of_what_is_gone_are_dropped_and_said() -> None:
    alone = "BEAM 1 1 2 3 4 0 1 0 % sheet 1\nX 3 0.1 0 0\nFIX 1\nFIX 2\nRLSE 1 2 5 6\n"
    session, said = renewed(alone, SECOND, CLAMP, in_plane())
    assert places(session) == [(1, 3)]
    assert len(said) == 2 and "sheet 2: in-plane bending at the stage" in said[0]
    assert all("not in the file any more" in each for each in said)
    # Another element under its number is another one.
    other = TWO.replace("BEAM 2 5 6 7 8 0 1 0 % sheet 2", "BEAM 2 5 6 3 4 0 1 0 % brace")
    session, said = renewed(
        other.replace("BEAM 3 3 4 7 8 % stage\n", "").replace("X 7 0.1 0.05 0\n", ""), SECOND
    )
    assert places(session) == [] and len(said) == 1


def test_edits_that_the_file_says_itself_are_no_edits_any_more() -> None:
    session, said = renewed(TWO.replace("RLSE 2 2 5 6", "RLSE 2 2 4 5 6"), SECOND, in_plane())
    assert places(session) == [(1, 3)]
    assert len(said) == 1 and "says so itself" in said[0]


def test_edits_of_a_program_follow_places_where_numbers_shift() -> None:
    def model(*heights: float) -> flexact.Model:
        made = flexact.Model()
        for y in heights:
            made.sheet((0, y, 0), (0.1, y, 0), width=(0, 0, 1))
            made.fix((0, y, 0))
        made.body([(0.1, y, 0) for y in heights])
        return made

    session = session_of(model(0.0, 0.05))
    at = next(
        int(n)
        for n, place in zip(
            session.board.given.arrays.node_number,
            session.board.given.arrays.node_value[:3].T,
            strict=True,
        )
        if np.allclose(place, (0, 0.05, 0))
    )
    switched(session, SECOND, {"node": at, "coordinate": "y", "to": "free"})
    assert session.renew(flexact.analyse(model(-0.1, 0.0, 0.05))) == ()
    (element, number), (node, _) = places(session)
    given = session.board.given
    ends = given.arrays.element_node[0, given.element_index[element]] - 1
    assert np.allclose(given.arrays.node_value[:3, ends], (0, 0.05, 0)) and number == 4
    assert np.allclose(given.arrays.node_value[:3, given.node_index[node]], (0, 0.05, 0))
    assert len(session.renew(flexact.analyse(model(-0.1, 0.0)))) == 2


# Requests ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "request_",
    [
        None,
        [],
        "undo",
        {},
        {"do": "jump"},
        {"do": ["undo"]},
        {"do": "set"},
        {"do": "set", "set": {}},
        {"do": "set", "set": ["element"]},
        {"do": "set", "set": [{}]},
        {"do": "set", "set": [{"element": 99, "deformation": 1, "to": "held"}]},
        {"do": "set", "set": [{"element": 1, "deformation": 0, "to": "held"}]},
        {"do": "set", "set": [{"element": 1, "deformation": 7, "to": "held"}]},
        {"do": "set", "set": [{"element": "1", "deformation": 1, "to": "held"}]},
        {"do": "set", "set": [{"element": True, "deformation": 1, "to": "held"}]},
        {"do": "set", "set": [{"element": 1e99, "deformation": 1, "to": "held"}]},
        {"do": "set", "set": [{"element": 1, "deformation": 1, "to": "fixed"}]},
        {"do": "set", "set": [{"element": 1, "deformation": 1}]},
        {"do": "set", "set": [{"node": 11, "coordinate": "q", "to": "free"}]},
        {"do": "set", "set": [{"node": 11, "coordinate": "rx", "to": "free"}]},
        {"do": "set", "set": [{"node": 11, "coordinate": 1, "to": "free"}]},
        {"do": "set", "set": [{"node": -1, "coordinate": "x", "to": "free"}]},
        {"do": "set", "set": [{"node": 11, "coordinate": "x", "to": "held"}]},
        {"do": "set", "set": [in_plane(), {"element": 99, "deformation": 1, "to": "held"}]},
        {"do": "look"},
        {"do": "look", "element": None},
        {"do": "look", "element": 99},
        {"do": "look", "node": 99},
        {"do": "look", "name": 3},
        {"do": "look", "name": "the left sheat"},
        {"do": "save"},
        {"do": "save", "name": "new.dat", "over": "yes"},
    ],
)
def test_what_is_not_understood_is_refused_in_words_and_changes_nothing(request_: Any) -> None:
    session = Session(GUIDE)
    session.renew(board_of("flexures/parallel_guide").base)
    with pytest.raises(flexact.FlexactError) as refused:
        session.ask(request_)
    assert 400 <= refused.value.status < 500 and str(refused.value)  # type: ignore[attr-defined]
    assert session.history.now == () and not session.told()["undo"]


def test_the_nearest_name_is_told() -> None:
    session = session_of(GUIDE)
    with pytest.raises(flexact.FlexactError, match="the left sheet"):
        session.ask({"do": "look", "name": "the left sheat"})


def test_without_a_sound_file_nothing_can_be_switched() -> None:
    session = Session(GUIDE)
    assert session.told()["edits"] == []
    with pytest.raises(flexact.FlexactError, match="still being analysed"):
        session.ask({"do": "look", "element": 1})
    session.broken()
    for do in ("set", "look", "save"):
        with pytest.raises(flexact.FlexactError, match="has errors"):
            session.ask({"do": do, "set": [in_plane()], "element": 1, "name": "x"})


# New decks ---------------------------------------------------------------------------------


def test_a_new_deck_is_written_beside_the_watched_one(tmp_path: Path) -> None:
    watched = tmp_path / "guide.dat"
    watched.write_text(TWO)
    session = session_of(watched, watched)
    assert session.told()["save"] == "guide_edited.dat"
    switched(session, in_plane())
    for name in ("new.dat", "other"):
        saved = session.ask({"do": "save", "name": name})["saved"]
        assert same(flexact.read(tmp_path / saved).data, session.model())
    assert watched.read_text() == TWO and (tmp_path / "other.dat").is_file()
    expected = TWO.replace("RLSE 1 2 5 6", "RLSE 1 2 3 5 6")
    assert (tmp_path / "new.dat").read_text() == expected
    with pytest.raises(flexact.FlexactError) as refused:
        session.ask({"do": "save", "name": "new.dat"})
    assert refused.value.status == 409  # type: ignore[attr-defined]
    session.ask({"do": "reset"})
    session.ask({"do": "save", "name": "new.dat", "over": True})
    assert (tmp_path / "new.dat").read_text() == TWO


def test_a_model_of_a_program_is_written_as_a_deck(tmp_path: Path) -> None:
    session = session_of(guide(), tmp_path / "guide.py")
    switched(session, in_plane())
    assert session.told()["save"] == "guide_edited.dat"
    session.ask({"do": "save", "name": "guide_edited.dat"})
    assert same(flexact.read(tmp_path / "guide_edited.dat").data, session.model(), CLASSES)
    assert session.told()["save"] == "guide_edited_2.dat"


@pytest.mark.posix
@pytest.mark.parametrize(
    "name",
    [
        *("", " ", ".", "..", "../new.dat", "/tmp/new.dat", "sub/new.dat", "a\\b.dat", "C:new.dat"),
        *("guide.dat", " guide.dat ", ".hidden.dat", "new.py", "new.html", "a\nb.dat", "x" * 300),
        *("folder.dat", "link_out.dat", "link_to_watched.dat", "a\0b.dat"),
    ],
)
@pytest.mark.parametrize("over", [False, True])
def test_no_other_place_and_never_the_watched_file(tmp_path: Path, name: str, over: bool) -> None:
    inside, outside = tmp_path / "inside", tmp_path / "outside.dat"
    inside.mkdir()
    outside.write_text("mine")
    watched = inside / "guide.dat"
    watched.write_text(TWO)
    (inside / "folder.dat").mkdir()
    (inside / "link_out.dat").symlink_to(outside)
    (inside / "link_to_watched.dat").symlink_to(watched)
    session = session_of(watched, watched)
    switched(session, in_plane())
    before = sorted(tmp_path.rglob("*"))
    with pytest.raises(flexact.FlexactError):
        session.ask({"do": "save", "name": name, "over": over})
    assert sorted(tmp_path.rglob("*")) == before
    assert watched.read_text() == TWO and outside.read_text() == "mine"


def test_what_cannot_be_written_is_said(tmp_path: Path) -> None:
    watched = tmp_path / "folder" / "guide.dat"
    session = session_of(flexact.read_text(TWO), watched)
    watched.parent.write_text("a file in the place of the folder")
    with pytest.raises(flexact.FlexactError, match=r"cannot|not"):
        session.ask({"do": "save", "name": "new.dat"})


@pytest.mark.parametrize(
    "body", [b"", b"{", b"\xff\xfe", b"[" * 100_000, b"9" * 5000, b"null", b"[1]"]
)
def test_what_is_no_json_is_refused_in_words(body: bytes) -> None:
    session = Session(GUIDE)
    session.renew(board_of("flexures/parallel_guide").base)
    status, content = session.answered(body)
    assert 400 <= status < 500 and content["error"] and session.history.now == ()


@pytest.mark.posix
@pytest.mark.parametrize(
    "name",
    ["x" * 240, "\u00e4" * 120, "a:b", "tab\tx", ".hidden", "\u202ex", "x_edited_2", "a b", "%s"],
)
def test_the_name_that_is_proposed_is_taken(name: str, tmp_path: Path) -> None:
    watched = tmp_path / f"{name}.dat"
    watched.write_text(TWO)
    session = session_of(watched, watched)
    switched(session, in_plane())
    made = []
    for _ in range(3):
        proposed = session.told()["save"]
        made.append(session.ask({"do": "save", "name": proposed})["saved"])
        assert made[-1] == proposed
    assert len(set(made)) == 3
