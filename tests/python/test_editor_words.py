# SPDX-License-Identifier: BSD-3-Clause
"""Answers about a deck, asked without an editor."""

import random

import numpy as np
import pytest
from editor_fuzz import ask_everything, mutated, some_positions
from reference_decks import NAMES, text_of

import flexact
from flexact.apps.editor.actions import edits_between, edits_of, mends_of, remedies_at
from flexact.apps.editor.completion import complete_at
from flexact.apps.editor.deck import WARPING, Deck, Document, Edit, Position, keys_in
from flexact.apps.editor.hover import hover_at
from flexact.apps.editor.outline import (
    RenameError,
    definition_at,
    folds_of,
    outline_of,
    references_at,
    rename_at,
)
from flexact.apps.editor.session import advice_on, opinion_on, problems_of
from flexact.core.elements import element_kinds
from flexact.deck.keywords import Block

GUIDE = """\
BEAM 1  1 2 3 4  0 1 0     % sheet 1
BEAM 2  5 6 7 8  0 1 0     % sheet 2
BEAM 3  3 4 7 8            % stage
X 3  0.1 0.00 0
X 5  0.0 0.05 0            % left
X 7  0.1 0.05 0
FIX 1
FIX 2
FIX 5
FIX 6
RLSE 1  2 5 6
RLSE 2  2 5 6
DYNX 3  2
END
HALT
ESTIFF 1  1e6 2 3 4 5 6
GRAVITY 0 0 -9.81
END
"""


def deck(text: str = GUIDE) -> Deck:
    return Deck(Document.of(text))


def said(text: str, line: int, character: int) -> str:
    found = hover_at(deck(text), Position(line, character))
    return found[0] if found is not None else ""


def applied(document: Document, edits: list[Edit] | tuple[Edit, ...]) -> str:
    # Of several at one place the first stands first, as the protocol has it.
    for edit in reversed(sorted(edits, key=lambda one: one.range.start)):
        document = document.changed(*edit.range, edit.text, 0)
    return document.text


@pytest.mark.parametrize("name", NAMES)
def test_statements_are_those_that_the_core_reads(name: str) -> None:
    """Elements, their kinds and nodes, and what X places, of every sample deck."""
    text = text_of(name)
    model = flexact.read_text(text)
    index, arrays = deck(text).index, model.data.arrays
    assert sorted(index.made["element"]) == sorted(arrays.element_number.tolist())
    for i, number in enumerate(arrays.element_number.tolist()):
        made = index.element(number)
        assert made is not None
        assert made.element is element_kinds()[arrays.element_kind[i] - 1]
        named = {number for (what, number), _ in keys_in(made) if what == "node"}
        nodes = arrays.element_node[:, i]
        numbers = set(arrays.node_number[nodes[nodes > 0] - 1].tolist())
        assert {n for n in named if index.kinds[n] != WARPING} == numbers
    kinds = {n: int(k) for n, k in zip(arrays.node_number, arrays.node_kind, strict=True)}
    assert {n: k for n, k in index.kinds.items() if k != WARPING} == kinds
    last = {index.tokens[line].number_of(1): line for line in index.tokens.lines_of("X").tolist()}
    for number, line in last.items():
        if number in model.data.node_index and kinds[number] <= 2:
            words = index.tokens[line].words[2:]
            values = [float(w.text.replace("d", "e").replace("D", "e")) for w in words]
            mine = arrays.node_value[: len(values), model.data.node_index[number]]
            np.testing.assert_array_equal(mine, values)


def test_a_keyword_says_what_it_means_and_takes() -> None:
    assert "released deformations" in said(GUIDE, 10, 2).lower()
    assert "`RLSE e [i…]`" in said(GUIDE, 10, 2)
    beam = said(GUIDE, 0, 0)
    assert "`BEAM e p op q oq [yx yy yz]`" in beam and "- 2: torsion" in beam
    assert "closes the block" in said(GUIDE, 13, 1)
    assert "not analysed" in said("WHEEL 1 2 3\n", 0, 0)
    assert said("NOTHING 1\n", 0, 0) == "" and said("% RLSE 1\n", 0, 3) == ""


def test_a_deformation_is_said_as_a_designer_says_it() -> None:
    assert "out-of-plane bending at its clamp" in said(GUIDE, 10, 10)
    assert "twist" in said(GUIDE, 10, 8)
    # Of a deck with an error, in the local frame.
    broken = GUIDE.replace("FIX 6", "FIX 66")
    assert "bending at p in the local xy plane" in said(broken, 10, 10)
    assert "position along y of node 3" in said(GUIDE, 12, 8)
    turned = GUIDE.replace("DYNX 3  2", "DYNX 4  2")
    assert "rotation about x of node 4" in said(turned, 12, 8)


def test_nodes_elements_and_numbers_say_what_they_are() -> None:
    node = said(GUIDE, 6, 4)
    assert "position" in node and "x, y, z fixed" in node and "element 1 (sheet 1)" in node
    assert "left" in said(GUIDE, 4, 2)
    element = said(GUIDE, 10, 5)
    assert "sheet *sheet 1*" in element and "length 100 mm" in element
    assert "held: 1 elongation, 3 in-plane bending at its clamp" in element
    assert said(GUIDE, 15, 11).endswith("EA (N)")
    assert said(GUIDE, 15, 15).endswith("G It (N m^2)")
    assert said(GUIDE, 16, 13).endswith("gz (m/s^2)")
    assert said(GUIDE, 3, 6).endswith("x (m)")
    assert "local y" in said(GUIDE, 0, 20)
    assert "no element names it" in said("TRUSS 1 1 2\nFIX 9\n", 1, 4)


def test_nodes_and_elements_are_found() -> None:
    mine = deck()
    (where,) = definition_at(mine, Position(12, 5))
    assert where.start == (3, 2)
    (where,) = definition_at(mine, Position(10, 5))
    assert where.start == (0, 5)
    # Without an X, where it first stands.
    (where,) = definition_at(mine, Position(6, 4))
    assert where.start == (0, 8)
    lines = [one.start.line for one in references_at(mine, Position(3, 2))]
    assert lines == [0, 2, 3, 12]
    lines = [one.start.line for one in references_at(mine, Position(3, 2), with_own=False)]
    assert lines == [0, 2, 12]
    assert definition_at(mine, Position(0, 20)) == []


def test_a_node_gets_another_number() -> None:
    mine = deck()
    text = applied(mine.document, rename_at(mine, Position(3, 2), "33"))
    assert "X 33  0.1" in text and "DYNX 33  2" in text and "BEAM 3  33 4 7 8" in text
    before, after = flexact.read_text(GUIDE), flexact.read_text(text)
    assert flexact.analyse(before).over_constrained == flexact.analyse(after).over_constrained
    for new in ("7", "x", "0", "-1", "99999999999"):
        with pytest.raises(RenameError):
            rename_at(mine, Position(3, 2), new)
    with pytest.raises(RenameError):
        rename_at(mine, Position(3, 6), "9")
    old = deck(GUIDE + "HALT\nVISUALIZATION\nBEAMVIS 1 0.1 0.2\n")
    with pytest.raises(RenameError, match="BEAMVIS"):
        rename_at(old, Position(0, 5), "11")


def labels(text: str, line: int, character: int) -> list[str]:
    return [one.label for one in complete_at(deck(text), Position(line, character))[1]]


def test_what_may_stand_there_is_offered() -> None:
    assert {"BEAM", "TRUSS", "RLSE", "END", "BEAMW"} <= set(labels(GUIDE + "", 6, 0))
    assert "ESTIFF" not in labels(GUIDE, 6, 0) and "WHEEL" not in labels(GUIDE, 6, 0)
    assert "ESTIFF" in labels(GUIDE, 15, 2) and "BEAM" not in labels(GUIDE, 15, 2)
    assert labels(GUIDE, 10, 5) == ["1", "2", "3"]
    assert labels(GUIDE + "", 6, 4)[:2] == ["1", "2"]
    # Slots of positions take positions, and a free number.
    assert labels(GUIDE, 0, 8) == ["1", "3", "5", "7", "9"]
    assert labels(GUIDE, 0, 5) == ["4"]
    offers = complete_at(deck(GUIDE.replace("2 5 6", "2 5 6 ")), Position(10, 14))[1]
    assert [one.label for one in offers] == ["1", "3", "4"]
    assert offers[1].detail == "in-plane bending at its clamp"
    assert labels(GUIDE, 4, 30) == [] and labels("* TR\n", 0, 4) == []
    shapes = "TRUSS 1 1 2\nEND\nEND\nVISUALIZATION\nCROSSTYPE R\n"
    assert labels(shapes, 4, 11) == ["RECT", "CIRC", "RECTHOL", "CIRCHOL", "LINE"]


def test_snippets_name_the_operands() -> None:
    offers = {one.label: one for one in complete_at(deck(), Position(6, 0))[1]}
    assert offers["BEAM"].snippet == "BEAM ${1:e} ${2:p} ${3:op} ${4:q} ${5:oq}"
    assert offers["HINGE"].snippet.endswith("${4:ax} ${5:ay} ${6:az}")
    assert offers["END"].snippet == "" and "RLSE e" in offers["RLSE"].about


def test_the_outline_has_parts_by_name() -> None:
    text = GUIDE.replace("% sheet 2", "% sheet 1, 2")
    groups = {one.name: one for one in outline_of(deck(text))}
    assert list(groups) == ["parts", "nodes", "classes", "material", "loads"]
    assert [one.name for one in groups["parts"].inner] == ["sheet 1", "stage"]
    assert [one.name for one in groups["parts"].inner[0].inner] == ["BEAM 1", "BEAM 2"]
    assert groups["nodes"].inner[1].name == "node 5: left"


def test_a_large_outline_comes_in_stretches() -> None:
    text = "".join(f"TRUSS {k} {k} {k + 1}\n" for k in range(1, 3002))
    (parts,) = outline_of(deck(text))
    assert len(parts.inner) == 7
    assert parts.inner[0].name == "TRUSS 1 to TRUSS 500"


def test_blocks_fold() -> None:
    folds = folds_of(deck())
    assert (0, 13, False) in folds and (14, 17, False) in folds and (6, 9, False) in folds


@pytest.mark.parametrize(
    ("text", "title", "mended"),
    [
        ("TRUS 1 1 2\n", "write TRUSS", "TRUSS 1 1 2\n"),
        ("TRUSS 1 1 2\r\nX 2 1 0 0\r\nHALT\r\n", "write END before it", None),
        ("TRUSS 1 1 2 ; a\nX 2 1 0 0\n", "write % instead", "TRUSS 1 1 2 % a\nX 2 1 0 0\n"),
        ("TRUSS 1 1 2\nTRUSS 1 2 3\n", "number it 2", "TRUSS 1 1 2\nTRUSS 2 2 3\n"),
    ],
)
def test_the_help_of_a_problem_is_a_mend(text: str, title: str, mended: str | None) -> None:
    mine = deck(text)
    problem = next(one for one in problems_of(mine) if list(mends_of(mine, one)))
    ((said, edit),) = mends_of(mine, problem)
    assert said == title
    made = applied(mine.document, [edit])
    assert made == (mended or text.replace("HALT", "END\r\nHALT"))
    assert problem.code not in {one.code for one in problems_of(deck(made))}


def test_of_two_classes_either_goes() -> None:
    text = GUIDE.replace("FIX 6", "FIX 6\nFIX 3 1 2")
    mine = deck(text)
    problem = next(one for one in problems_of(mine) if one.code == "class-conflict")
    mends = list(mends_of(mine, problem))
    assert {title for title, _ in mends} == {
        "take 2 out of FIX in line 11",
        "take DYNX 3 2 out, line 14",
    }
    for _, edit in mends:
        assert problems_of(deck(applied(mine.document, [edit]))) == []


@pytest.mark.parametrize("ending", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("start", ["", "\ufeff"])
def test_a_step_of_the_advice_edits_the_deck(ending: str, start: str) -> None:
    """All else stays to the letter; the edited deck is what the step says."""
    text = start + GUIDE.replace("\n", ending)
    mine = deck(text)
    opinion = opinion_on(mine)
    assert opinion is not None and opinion.words.startswith("over-constrained by 1; ")
    advice = advice_on(opinion)
    assert advice is not None
    first = remedies_at(mine, advice, 0, 0)
    assert first and first[0][0].endswith(": exactly constrained")
    for title, step, choice in first:
        edits = edits_of(mine, advice, step, choice)
        made = applied(mine.document, edits)
        assert made.startswith(f"{start}BEAM 1  1 2 3 4  0 1 0     % sheet 1{ending}")
        assert made.count("\r") == (made.count(ending) if "\r" in ending else 0)
        after = opinion_on(deck(made))
        assert after is not None and after.words.startswith("exactly constrained") == (
            title.endswith(": exactly constrained")
        )
    mine_too = remedies_at(mine, advice, 10, 10)
    assert mine_too and all("sheet 1" in title or "1" in title for title, _, _ in mine_too)
    assert remedies_at(mine, advice, 15, 15) != remedies_at(mine, advice, 5, 5)


def test_a_verdict_is_for_sound_decks() -> None:
    assert opinion_on(deck("TRUSS 1 1\n")) is None
    exact = opinion_on(deck(GUIDE.replace("RLSE 1  2 5 6", "RLSE 1  2 3 5 6")))
    assert exact is not None and exact.words.startswith("exactly constrained; ")
    assert advice_on(exact) is None
    loose = opinion_on(deck("TRUSS 1 1 2\nX 2 1 0 0\nFIX 1\n"))
    assert loose is not None and loose.words.startswith("under-constrained by 2")
    assert loose.remarks[0].text.startswith("motion 1: ")


def test_edits_make_one_text_of_another() -> None:
    dice = random.Random("edits")
    lines = ["a\n", "b\r\n", "c\n", "\n", "d"]
    for _ in range(400):
        old = "".join(dice.choices(lines, k=dice.randrange(8)))
        new = "".join(dice.choices(lines, k=dice.randrange(8)))
        document = Document.of(old)
        made = Document.of(applied(document, edits_between(document, new)))
        assert made.bare == Document.of(new).bare


def test_blocks_are_told_apart() -> None:
    tokens = deck("END % x\nHALT\nX 1 2\nend\nOUTX 1\nHALT\nOUTX 1\nVisualization\nend\n").tokens
    found = [tokens[line].block for line in range(9)]
    assert found == [
        *(Block.KINEMATICS, Block.DYNAMICS, Block.DYNAMICS, Block.DYNAMICS, Block.CLOSED),
        *(Block.CLOSED, Block.IN_OUT, Block.PICTURE, Block.PICTURE),
    ]


def test_whatever_is_typed_is_answered() -> None:
    """Mistakes of all kinds in the sample decks; longer runs are made by hand."""
    texts = [text for text in map(text_of, NAMES) if len(text) < 4000]
    for seed in range(250):
        dice = random.Random(f"typed {seed}")
        document = Document.of(mutated(dice.choice(texts), dice))
        ask_everything(document, some_positions(document, dice, 6))


def test_numbers_of_a_deck_in_millimetres_are_said_to_be_so() -> None:
    """Places and what numbers stand for, in the units that the deck says."""
    text = "UNITS mm\nTRUSS 1 1 2\nX 2 40 0 0\nFIX 1\nFIX 2 2 3\nEND\nHALT\n"
    text += "ESTIFF 1 100\nGRAVITY 0 0 1\n"
    assert "at (40, 0, 0) mm" in said(text, 1, 10)
    assert said(text, 2, 4) == "**40**: x (mm)"
    assert said(text, 8, 8) == "**0**: gx (mm/s^2)"
    assert said(text.replace("UNITS mm\n", ""), 1, 4) == "**40**: x (m)"
