# SPDX-License-Identifier: BSD-3-Clause
"""What outputs print can be pasted: statements and calls give the counts that are said."""

import copy
import html
import itertools
import json
import math
import re
import runpy
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pasting import Pasted, analysis_pasted, notes_in, pasted, steps_pasted
from random_models import mechanism
from reference_decks import NAMES, ROOT, text_of

import flexact
from flexact import FlexactError, Model
from flexact.advice.advice import describe as advised
from flexact.advice.describe import describe
from flexact.analysis.mode_words import group_in_words
from flexact.analysis.naming import part_in_words, plain
from flexact.analysis.places import part_words
from flexact.analysis.screws import ScrewKind
from flexact.analysis.ways import Coordinate, on_motions
from flexact.apps.cli.main import main

pytestmark = pytest.mark.dear(50)

DECK = "BEAM 1 1 2 3 4 0 1 0\nX 3 0.1 0 0\nFIX 1\nFIX 2\nRLSE 1 2 5 6\nEND\nHALT\n"


def sheet() -> Model:
    model = Model()
    model.sheet((0, 0, 0), (0.1, 0, 0), "y", name="leaf (1)")
    model.fix((0, 0, 0))
    return model


def test_notes_are_found_where_names_hold_parentheses() -> None:
    call = 'model.release("leaf (1)", "in-plane bending", at=(0, 0, 0))'
    assert notes_in(f"Cut it (free there) ({call}, {call}); likewise (b).") == [f"{call}, {call}"]
    words = "Declare it (DYNX 1 2, DYNX\n 4 1), or hold it (FIX 1 2). It is (0, 1) m off."
    assert notes_in(words) == ["DYNX 1 2, DYNX 4 1", "FIX 1 2"]


def test_a_deck_is_edited_as_a_note_says() -> None:
    assert pasted(DECK) == (3, 0)
    assert pasted(DECK, "DYNX 3 2 or FIX 3 2") == (2, 0)
    assert pasted(DECK, "without RLSE 1 2 5") == (1, 0)
    assert pasted(DECK, "DYNE 1 2 instead of RLSE 1 2", "RLSE 1 2 instead") == (3, 0)
    assert pasted(DECK, "DYNX 3 2", "without DYNX 3 2") == (3, 0)
    with pytest.raises(AssertionError):
        pasted(DECK, "without RLSE 1 3")
    with pytest.raises(AssertionError):
        pasted(DECK, "DYNX 3 2, ...")


def test_calls_are_made_on_a_copy_of_the_model_as_its_script_left_it() -> None:
    model = sheet()
    assert pasted(model, 'model.independent((0.1, 0, 0), "z")') == (2, 0)
    assert pasted(model) == (3, 0)
    with pytest.raises(FlexactError):
        pasted(model, 'model.independent("nowhere", "z")')


# What is printed -----------------------------------------------------------------


def crank_with_a_notch() -> Model:
    """A clamped crank; beyond the notch at its tip a wire, whose end alone turns."""
    model = Model()
    crank = model.body([(0, 0, 0), (0.1, 0, 0)], name="crank")
    model.fix((0, 0, 0))
    notch = model.notch(crank.nodes[1], "z", name="notch")
    model.wire(notch.q, (0.1, 0.1, 0), name="wire")
    model.fix((0.1, 0.1, 0))
    return model


def ball_joint(planar: bool = False) -> Model:
    """A leaf or wire whose end turns on a clamped body, as nothing but its place is shared."""
    model = Model(planar=planar)
    size = 2 if planar else 3
    tip = model.body([(0, 0, 0)[:size], (0.1, 0.02, 0)[:size]], name="arm").nodes[1]
    model.fix((0, 0, 0)[:size])
    make = model.sheet if planar else model.wire
    make(model.pivot(tip), (0.3, 0.1, 0.05)[:size], name="leaf")
    model.fix((0.3, 0.1, 0.05)[:size])
    return model


def lens() -> Model:
    """Three blades at 120 degrees: of two ends no decimals are short."""
    model = Model(name="lens mount")
    ends = []
    for k in range(3):
        c, s = math.cos(2 * math.pi * k / 3), math.sin(2 * math.pi * k / 3)
        ends.append((0.05 * c, 0.05 * s, 0))
        model.sheet((0.07 * c, 0.07 * s, 0), ends[-1], "z", name=f"blade {k + 1}")
        model.fix((0.07 * c, 0.07 * s, 0))
    model.body(ends, name="lens")
    return model


def two_sheets_each(beams: int = 1) -> Model:
    """Three legs of two sheets each at right angles: three folds that turn, and a stage."""
    model = Model(name="folds")
    ends = []
    for k in range(3):
        c, s = math.cos(2 * math.pi * k / 3), math.sin(2 * math.pi * k / 3)
        inner, fold, outer = (
            (x * c - y * s, x * s + y * c, 0) for x, y in ((0.02, 0), (0.05, 0), (0.05, 0.03))
        )
        model.sheet(inner, fold, "z", beams, name=f"in {k}")
        model.sheet(fold, outer, "z", beams, name=f"out {k}")
        model.fix(outer)
        ends.append(inner)
    model.body([(0, 0, 0), *ends], name="stage")
    for name in ("x", "y", "rz"):
        model.independent("stage", name)
    return model


def copied_folds() -> Model:
    """Legs that were copied, whose nodes have other numbers than those of the first."""
    part = Model()
    part.sheet((0.02, 0, 0), (0.05, 0, 0), "z", name="in")
    part.sheet((0.05, 0, 0), (0.05, 0.03, 0), "z", name="out")
    part.fix((0.05, 0.03, 0))
    model = Model(name="copied folds")
    for k in range(3):
        model.insert(part, degrees=120 * k + 7, names=f"{{}} {k}")
    c = [math.radians(120 * k + 7) for k in range(3)]
    model.body([(0.02 * math.cos(a), 0.02 * math.sin(a), 0) for a in c], name="stage")
    return model


def table_of_two_guides() -> Model:
    """A table through the stages of two guides, its centre given first."""
    model = Model(name="table")
    ground = []
    for name, (x, y) in {"A y": (1, 0), "B x": (0, 1)}.items():
        p, q = (-0.06 * x, -0.06 * y, 0.01 * x), (-0.02 * x, -0.02 * y, 0.01 * x)
        ground += model.parallel_guide(p, q, (0.04 * y, 0.04 * x, 0), name=name).ground
    model.fix(*ground)
    model.body([(0, 0, 0), "A y stage", "B x stage"], name="table", mass=0.5)
    model.independent("table", "x")
    return model


def compound_guide() -> Model:
    """Two guides, one on the stage of the other, which nobody declares."""
    model = Model(name="compound")
    ends = [(0.03, 0, 0), (0.09, 0, 0)]
    outer = model.parallel_guide((0, 0, 0.05), (0, 0, 0), (0.12, 0, 0), name="outer", carries=ends)
    model.parallel_guide(ends[0], (0.03, 0, 0.05), (0.06, 0, 0), name="inner")
    model.fix(*outer.ground)
    model.independent("inner stage", "x")
    return model


def divided_and_driven() -> Model:
    """A sheet of three beams, of which an end is driven against its own constraint."""
    model = Model(name="driven")
    model.sheet((0, 0, 0), (0.1, 0, 0), "z", 3, name="leaf")
    model.fix((0, 0, 0), (0.1, 0, 0))
    model.independent("leaf", "out-of-plane bending", at=(0.1, 0, 0))
    model.independent("leaf", "twist")
    return model


MADE: dict[str, Callable[[], Model]] = {
    each.__name__: each
    for each in (
        *(crank_with_a_notch, ball_joint, lens, two_sheets_each, copied_folds),
        *(table_of_two_guides, compound_guide, divided_and_driven),
    )
} | {"planar_joint": lambda: ball_joint(True), "divided_folds": lambda: two_sheets_each(2)}
GALLERY = {path.stem: path for path in sorted((ROOT / "docs" / "gallery").glob("*.py"))}


def made(name: str) -> Model:
    if name in MADE:
        return MADE[name]()
    model = runpy.run_path(str(GALLERY[name]))["model"]
    assert isinstance(model, Model)
    return model


def as_python(deck: str) -> Model:
    """The model of a deck as if it were made in Python."""
    return Model.from_data(replace(flexact.read_text(deck).data, source=None, began_as=None))


def all_pasted(given: Model | str) -> list[Pasted]:
    model = flexact.read_text(given) if isinstance(given, str) else given
    result = flexact.analyse(copy.deepcopy(model))
    return [*analysis_pasted(given, result), *steps_pasted(given, result.advice())]


@pytest.mark.grid
@pytest.mark.parametrize("name", NAMES)
def test_statements_and_calls_of_decks_do_what_is_said(name: str) -> None:
    text = text_of(name)
    for given in (text, as_python(text)):
        assert [each for each in all_pasted(given) if not each.is_right] == []


@pytest.mark.parametrize("name", [*MADE, *GALLERY])
def test_calls_of_scripts_do_what_is_said(name: str) -> None:
    model = made(name)
    told = all_pasted(model)
    assert [each for each in told if not each.is_right] == []
    assert told or flexact.analyse(model).verdict is flexact.Verdict.EXACT


@pytest.mark.parametrize("planar", [False, True])
@pytest.mark.parametrize("seed", [1, 2, 23, 36, 52, 77, 145, 216])
def test_of_random_mechanisms_all_can_be_pasted(seed: int, planar: bool) -> None:
    """The seeds are some of those that found a statement that could not be, or did else."""
    model = mechanism(np.random.default_rng(seed), planar)
    for given in (model, model.to_deck()):
        assert [each for each in all_pasted(given) if not each.is_right] == []


@pytest.mark.parametrize("name", [*MADE, "notch_four_bar", "parallel_guide"])
def test_json_and_page_print_the_same_statements(name: str, tmp_path: Path) -> None:
    model = made(name)
    result = flexact.analyse(model)
    known = {*notes_in(describe(result, verbose=True)), *notes_in(advised(result.advice(), None))}
    for each in json.loads(result.to_json())["advice"]:
        assert not each["calls"] or ", ".join(each["calls"]) in known
    page = tmp_path / "page.html"
    result.save(page)
    words = html.unescape(re.sub(r"<[^>]*>", "", page.read_text(encoding="utf-8")))
    assert set(notes_in(words)) <= known


@pytest.mark.parametrize("name", [*NAMES[::3], "frameworks/ring_6"])
def test_what_advise_prints_stands_under_its_heading(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    deck = tmp_path / "deck.dat"
    deck.write_text(text_of(name), encoding="utf-8")
    main(["advise", str(deck)])
    assert_nothing_is_empty(capsys.readouterr().out)


@pytest.mark.parametrize("name", MADE)
def test_no_heading_stands_alone(name: str) -> None:
    assert_nothing_is_empty(flexact.analyse(made(name)).advice().describe())


def assert_nothing_is_empty(text: str) -> None:
    lines = [*text.splitlines(), ""]
    for line, below in itertools.pairwise(lines):
        if line.startswith(("What ", "To ", "Motion", "Self-stress")):
            assert below.startswith(" "), f"nothing below {line!r}"


# Names --------------------------------------------------------------------------


def test_a_place_is_met_within_rounding_of_the_size() -> None:
    model = lens()
    end = tuple(model.part("blade 2").nodes[1].place)
    typed = tuple(float(f"{value:.12g}") for value in end)
    assert typed != end
    assert model.point(typed).position == model.part("blade 2").nodes[1].position
    near = tuple(value + 0.9e-9 * 0.07 for value in end)
    assert model.point(near).position == model.point(end).position
    with pytest.raises(FlexactError):
        model.point(tuple(value + 2e-9 * 0.07 for value in end))
    count = len(model.node_numbers)
    model.truss(near, (1, 1, 1))
    assert len(model.node_numbers) == count + 1


def test_points_of_a_script_are_met_while_it_grows() -> None:
    """Against one after the other compared with all."""
    random = np.random.default_rng(3)
    model, places = Model(), []
    for k in range(200):
        scale = 10.0 ** random.integers(-3, 4)
        places.append(tuple(scale * random.uniform(-1, 1, 3)))
        model.node(*places[-1])
        old = places[random.integers(len(places))]
        size = max(abs(x) for place in places for x in place)
        moved = tuple(x + size * random.uniform(-1.5e-9, 1.5e-9) for x in old)
        near = [
            number
            for number, place in enumerate(places)
            if max(abs(a - b) for a, b in zip(place, moved, strict=True)) <= 1e-9 * size
        ]
        if near:
            assert model.point(moved).place == places[near[0]], k
        else:
            with pytest.raises(FlexactError):
                model.point(moved)


def test_a_body_stands_for_the_point_that_was_given_first() -> None:
    model = table_of_two_guides()
    assert model.point("table").place == (0, 0, 0)
    again = flexact.read_text(model.to_deck())
    assert again.point("table").place == (0, 0, 0)
    result = flexact.analyse(model)
    assert [each.label for each in result.freedoms] == ["table x"]
    words = result.describe(verbose=True)
    assert "the table along x" in words and "stage 1 along x" not in words


@pytest.mark.parametrize("first", range(5))
def test_the_first_point_of_a_body_is_the_one_given_first(first: int) -> None:
    places = [(0.1 * k, 0.01 * k * k, 0.02 * k) for k in range(5)]
    model = Model()
    model.body(places[:2], name="one")
    model.body(places[2:4], name="other")
    order = [places[first], *(each for each in places if each != places[first])]
    body = model.body([order[0], "one", "other", *order[1:]], name="whole")
    assert body.nodes[0].place == model.point("whole").place == order[0]
    assert flexact.read_text(model.to_deck()).point("whole").place == order[0]


def test_an_intermediate_stage_is_named_as_a_designer_does() -> None:
    words = flexact.analyse(compound_guide()).describe(verbose=True)
    assert "the outer stage along x" in words and "ground 1 along" not in words


def test_two_points_at_one_place_are_told_and_a_place_means_the_one_there() -> None:
    model = Model()
    model.sheet((0, 0, 0), model.node(1, 0, 0, name="a"), "z")
    model.sheet(model.node(1, 0, 0, name="b"), (2, 0, 0), "z")
    model.fix((0, 0, 0))
    assert [each.code for each in model.diagnostics] == ["coincident-nodes"]
    joined = Model()
    joined.sheet((0, 0, 0), joined.node(1, 0, 0, name="a"), "z")
    joined.sheet((1, 0, 0), (2, 0, 0), "z")
    joined.fix((0, 0, 0))
    assert joined.diagnostics == ()


def test_folds_of_two_sheets_are_declared_first() -> None:
    for model in (two_sheets_each(), two_sheets_each(2), copied_folds()):
        result = flexact.analyse(model)
        assert len(result.folds) == 3
        words = result.describe()
        assert "folds of folded sheets: declare them" in " ".join(words.split())
        assert "model.fix(" not in words.partition("With them declared")[0]
        whole = result.with_folds_declared
        assert whole is not None and whole.under_constrained == result.under_constrained - 3


# What moves ---------------------------------------------------------------------


@pytest.mark.parametrize("name", [*MADE, *NAMES[::2]])
def test_what_moves_is_never_told_of_a_body_that_does_not(name: str) -> None:
    """Nor is a joint called as the body beside it."""
    assert_told_of_what_moves(made(name) if name in MADE else flexact.read_text(text_of(name)))


@pytest.mark.parametrize("planar", [False, True])
@pytest.mark.parametrize("seed", range(40, 60))
def test_of_random_mechanisms_what_moves_is_told(seed: int, planar: bool) -> None:
    assert_told_of_what_moves(mechanism(np.random.default_rng(seed), planar))


def assert_told_of_what_moves(model: Model) -> None:
    try:
        result = flexact.analyse(model)
    except FlexactError:
        return
    parts, bodies = result.parts, result.carriers.bodies
    names = [part_words(body) for body in bodies]
    for motion in result.motions:
        still = {names[k] for k in range(len(bodies)) if motion.of(k).kind is ScrewKind.NONE}
        moving = {names[k] for k in range(len(bodies)) if motion.of(k).kind is not ScrewKind.NONE}
        for group in motion.bodies or motion.ends:
            told = {str(piece) for piece in group_in_words(result, group, False)}
            assert not told & (still - moving)
    for way in on_motions(result):
        for part in way.parts:
            if not isinstance(part, Coordinate) or not part.name.startswith("r"):
                continue
            node = result.given.node_index[part.node]
            words = plain(part_in_words(result, part))
            if node not in parts.body_at:
                assert not any(words.startswith(f"{name} about") for name in names), words
