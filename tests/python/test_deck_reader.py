# SPDX-License-Identifier: BSD-3-Clause
"""One reader of the deck language: however a deck is typed, every feature takes it the same."""

import re
from typing import Any

import pytest
from reference_decks import NAMES, text_of

import flexact
from flexact.analysis.change import Change
from flexact.analysis.differences import statements_in
from flexact.apps.checks.findings import Lines
from flexact.apps.editor.deck import Deck, Document
from flexact.core.elements import Class
from flexact.deck.keywords import Block
from flexact.deck.tokens import Tokens, comments_of, tokens_of
from flexact.elasticity.reduced import independent_of
from flexact.model.data import ModelData
from flexact.model.editing import edited_deck
from flexact.model.writing import prescribed_in
from flexact.show.spacar_log import spacar_log

PLAIN = """\
% A guide, with END and FIX 9 in its title
BEAM 1 1 2 3 4 0 1 0 % sheet 1
BEAM 2 5 6 7 8 0 1 0 % sheet 2, INPUTX 3 1
BEAM 3 3 4 7 8
* RLSE 3 1
X 3 0.1 0 0
X 5 0 0.05 0
X 7 0.1 0.05 0 % the end
FIX 1
FIX 2
FIX 5
FIX 6
RLSE 1 2 5 6
RLSE 2 2 5 6
DYNX 7 2
INPUTX 3 2
END
HALT
ESTIFF 1 1000000.0 2 3 4 5 6
ESTIFF 2 1000000.0 2 3 4 5 6 % RLSE 2 1
END
END
VISUALIZATION
BEAMPROPS 1 2
CROSSDIM 0.0003 0.04
"""
LINES = PLAIN.splitlines()


def words_changed(pattern: str, new: str) -> str:
    """The deck with other words before its comments."""
    made = []
    for line in LINES:
        body, mark, comment = line.partition("%") if line[0] not in "*%" else ("", "", line)
        made.append(re.sub(pattern, new, body) + mark + comment)
    return "\n".join(made) + "\n"


#: The same deck, typed otherwise.
TYPED = {
    "signs": words_changed(r"(?<= )([1-9])(?=\s|$)", r"+\1"),
    "zeros": words_changed(r"(?<= )([1-9])(?=\s|$)", r"00\1"),
    "signs of inputs": PLAIN.replace("DYNX 7 2", "DYNX +7 2").replace("\nINPUTX 3", "\nINPUTX +3"),
    "tabs": words_changed(" ", "\t"),
    "wide": words_changed(r" (?=\S)", " \t  "),
    "indented": words_changed(r"^(?=\S)", " \t "),
    "windows": PLAIN.replace("\n", "\r\n"),
    "old mac": PLAIN.replace("\n", "\r"),
    "form feeds": PLAIN.replace("\nFIX", "\f\nFIX").replace("\nRLSE", "\n\fRLSE"),
    "lower case": words_changed(r"[A-Z]+", lambda found: found[0].lower()),  # type: ignore[arg-type]
    "mixed case": words_changed(r"[A-Z]+", lambda found: found[0].capitalize()),  # type: ignore[arg-type]
    "hash": PLAIN.replace("%", "#"),
    "close marks": PLAIN.replace(" % ", "%").replace("END\nHALT", "END%\nHALT"),
    "semicolons": PLAIN.replace("BEAMPROPS 1 2", "; BEAMPROPS 3\nBEAMPROPS 1 2;END"),
    "last line": PLAIN.rstrip("\n"),
    "byte mark": f"\ufeff{PLAIN}",
    "spelling": PLAIN.replace("BEAM 3", "BEAMNL 3"),
    "exponents": PLAIN.replace("0.1 ", "1.0D-1 ").replace("0.05", "5e-2"),
}
#: Statements that stand twice, or say in several lines what one could.
REPEATED = (
    PLAIN.replace("RLSE 1 2 5 6", "RLSE 1 2\n% RLSE 1 3\nrlse\t1 5 6")
    .replace("FIX 5", "FIX 5 1\nFIX 5 2 3")
    .replace("BEAMPROPS 1 2", "BEAMPROPS 1\nCROSSDIM 0.0003 0.04\nBEAMPROPS 2")
)


def numbers_of(data: ModelData) -> list[Any]:
    return [array.tolist() for array in data.arrays]


def seen_by_editor(text: str) -> dict[str, Any]:
    """Nodes, elements and blocks, as an editor has them."""
    deck = Deck(Document.of(text))
    index = deck.index
    lines = [line for line in deck.tokens if line.words]
    names = [line.element.keyword if line.element else line.name for line in lines]
    return {
        "kinds": index.kinds,
        "elements": {n: index.comment(("element", n)) for n in index.made["element"]},
        "on nodes": {n: index.elements_on(n) for n in index.kinds},
        "named": {n: len(index.where(("node", n))) for n in index.kinds},
        "statements": list(zip(names, (line.block for line in lines), strict=True)),
    }


def rows_of(data: ModelData) -> list[tuple[int, str | int]]:
    """Node and coordinate, or element and deformation, of each row of the reduced matrices."""
    made: list[tuple[int, str | int]] = []
    for place in independent_of(data).tolist():
        if place >= 0:
            made.append((int(data.arrays.node_number[place // 3]), "xyz"[place % 3]))
        else:
            element, k = divmod(-1 - place, 6)
            made.append((int(data.arrays.element_number[element]), k + 1))
    return made


def told_by_all(text: str) -> dict[str, Any]:
    """What each feature makes of a deck."""
    data = flexact.read_text(text).data
    assert data.source is not None
    comments = comments_of(data.source)
    inputs = prescribed_in(data)
    change = Change(deformations=((2, 3, Class.DEPENDENT),))
    edited = edited_deck(data, change.apply(data).data)
    log = spacar_log(flexact.analyse(flexact.read_text(text)))
    tables = log[log.index(" Elements used") : log.index(" Dynamic data")]
    return {
        "model": numbers_of(data),
        "inputs": [inputs.coordinates.tolist(), inputs.deformations.tolist()],
        "labels": rows_of(data),
        "comments": [comments.top[1:], comments.behind, list(comments.before)],
        "edited": numbers_of(flexact.read_text(edited).data),
        "compared": [re.sub("BEAMNL", "BEAM", meant) for meant, _, _ in statements_in(data.source)],
        "log": tables,
        "places": [Lines(data.source).definition(("element", n)) is not None for n in (1, 2, 3, 4)],
        "editor": seen_by_editor(text),
    }


@pytest.fixture(scope="module")
def plain() -> dict[str, Any]:
    return told_by_all(PLAIN)


def test_the_deck_says_what_it_should(plain: dict[str, Any]) -> None:
    assert plain["places"] == [True, True, True, False]
    assert plain["labels"] == [(7, "y")]
    assert plain["comments"][1] == {("ESTIFF", 2): ["RLSE 2 1"]}
    assert plain["editor"]["elements"] == {1: "sheet 1", 2: "sheet 2, INPUTX 3 1", 3: ""}
    assert plain["editor"]["statements"][-4:] == [
        ("END", Block.CLOSED),
        *((word, Block.PICTURE) for word in ("VISUALIZATION", "BEAMPROPS", "CROSSDIM")),
    ]


@pytest.mark.parametrize("how", TYPED)
def test_however_it_is_typed_every_feature_takes_it_the_same(
    how: str, plain: dict[str, Any]
) -> None:
    made = told_by_all(TYPED[how])
    for feature, told in plain.items():
        assert made[feature] == told, feature


def test_what_several_lines_say_is_what_one_says(plain: dict[str, Any]) -> None:
    made = told_by_all(REPEATED)
    for feature in ("model", "inputs", "labels", "edited", "log", "places"):
        assert made[feature] == plain[feature], feature
    assert made["editor"]["kinds"] == plain["editor"]["kinds"]
    assert made["editor"]["elements"] == plain["editor"]["elements"]


@pytest.mark.parametrize("name", NAMES)
def test_words_stand_where_the_tokens_say(name: str) -> None:
    """Every word before a comment is a token, in its line; what a line has besides is blank."""
    text = text_of(name)
    tokens = Tokens(text)
    assert [line.text for line in tokens] == text.split("\n")
    for line in tokens:
        end = 0
        for word in line.words:
            assert line.text[word.first : word.behind] == word.text
            assert not line.text[end : word.first].strip()
            end = word.behind
        assert not line.text[end : line.mark].strip()
        assert line.mark == len(line.text) or line.text[line.mark] in "%#;*"


def test_whatever_stands_in_a_text_it_has_its_lines() -> None:
    """Faulty decks have tokens, too: odd words, characters that no text holds, nothing."""
    for text in (
        "",
        "\n",
        "é\x00 ü",
        "TRUS 1 1 2\nEMD\nX",
        "\u2028\x85%",
        "FIX 99999999999 1.5 -3",
    ):
        tokens = Tokens(text)
        assert [line.text for line in tokens] == text.split("\n")
    tokens = Tokens("TRUS 1 1 2\nEMD\nXQ 1\nFIX 99999999999 1.5 -3")
    # What is nearly an element, or an END, is taken for it, as the reader does.
    assert tokens[0].element is not None and tokens[0].element.keyword == "TRUSS"
    assert tokens[1].ends and tokens[2].block is Block.DYNAMICS and tokens[2].keyword is None
    assert [tokens[3].number_of(k) for k in range(5)] == [0] * 5


def test_places_in_mixed_encodings_are_characters() -> None:
    raw = "TRUSS 1 1 2 % µm\nX 2 1 0 0 % ".encode() + b"\xb5m\nFIX 1\n"
    source = flexact.read_text(raw).data.source
    assert source is not None
    assert [line.comment for line in tokens_of(source)] == ["µm", "µm", "", ""]
