# SPDX-License-Identifier: BSD-3-Clause
"""One table of keywords, in the core, and one home of what they say: docs and editors show it."""

import json
import re
from collections.abc import Iterator
from typing import Any

import pytest
from reference_decks import NAMES, ROOT, text_of
from wording import AsStored

import flexact
from flexact.core import calls
from flexact.core.elements import NodeKind, element_kinds
from flexact.deck import keywords as home
from flexact.deck import keywords as numbers
from flexact.deck.keywords import Block, Keyword, find_keyword, keywords, words_of
from flexact.deck.rendering import DeckError
from flexact.model.data import CrossSection

PAGE = ROOT / "docs" / "decks.md"

EXTENSION = ROOT / "editors" / "vscode"
GRAMMAR = EXTENSION / "syntaxes" / "flexact-deck.tmLanguage.json"
TABLES = ("units", "classes", "properties", "loads", "pictures", "unused")
_TABLE = re.compile(
    r"(<!-- keywords, (\w+): make wording -->\n).*?(<!-- end of keywords -->\n)", re.DOTALL
)


def test_every_keyword_of_the_core_has_words_and_no_other_has() -> None:
    rows = keywords().values()
    assert len(rows) == len(calls.names_of("keywords"))
    known = {(row.name, words_of(row).table) for row in rows}
    assert len(known) >= len({row.name for row in rows})
    said = {name for name, _ in home._WORDS} | set(home.UNCOVERED)
    assert said == {row.name for row in rows}
    for row in rows:
        words = words_of(row)
        assert words.table in (*TABLES, "values", "uncovered")
        assert words.says or numbers.properties_in_words(row.name)


def test_forms_are_those_that_the_reader_wants() -> None:
    """Too few operands are an error for every statement outside of pictures, enough are none."""
    deck = "BEAM 1 1 2 3 4\nX 3 1 0 0\nFIX 1\nFIX 2\nINPUTX 3 1\nINPUTE 1 1\n{}END\nHALT\n{}END\n"
    right = {"e": "1", "n": "3", "i": "1", "r": "1", "w": "NAME"}
    for row in keywords().values():
        table = words_of(row).table
        if table == "uncovered" or row.block not in (Block.KINEMATICS, Block.DYNAMICS):
            continue
        for count in {row.least, row.least - 1}:
            operands = [right[row.letter(k)] for k in range(1, count + 1)]
            if row.name == "X" and count == row.least:
                operands += ["0", "0"]
            line = f"{' '.join([row.name, *operands])}\n"
            both = (line, "") if row.block is Block.KINEMATICS else ("", line)
            try:
                flexact.read_text(deck.format(*both))
                codes = set()
            except DeckError as error:
                codes = {item.code for item in error.diagnostics}
            is_enough = count == row.least
            assert ("missing-operand" in codes) != is_enough, line


def test_a_keyword_is_found_in_its_block_first() -> None:
    dynamic = find_keyword("INPUTX", Block.DYNAMICS)
    assert dynamic is not None and dynamic.form == "nir"
    kinematic = find_keyword("INPUTX", Block.PICTURE)
    assert kinematic is not None and kinematic.block is Block.KINEMATICS
    assert find_keyword("NONE", Block.KINEMATICS) is None


@pytest.mark.parametrize("keyword", ["ESTIFF", "EM"])
def test_numbers_of_elements_are_as_many_as_the_reader_uses(keyword: str) -> None:
    """One more number has no meaning, and the reader says so; of a BEAM a further one may be."""
    for kind in element_kinds():
        model = next(
            (
                text
                for text in map(text_of, NAMES)
                if re.search(rf"^\s*{kind.keyword}\s", text, re.MULTILINE)
                and "ESTIFF" not in text
                and not re.search(r"^\s*EM\s", text, re.MULTILINE)
                and "VISUAL" not in text
            ),
            None,
        )
        if model is None:
            continue
        element = re.search(rf"^\s*{kind.keyword}\s+(\d+)", model, re.MULTILINE)
        assert element is not None
        body = re.split(r"^\s*END\b", model, maxsplit=1, flags=re.MULTILINE | re.IGNORECASE)[0]
        meant = len(numbers.of_element(keyword, kind))
        spare = 1 if kind.keyword == "BEAM" else 0
        for count in (meant, meant + spare + 1):
            if not count:
                continue
            line = f"{keyword} {element[1]} {' '.join(['1.5'] * count)}"
            made = flexact.read_text(f"{body}END\nHALT\n{line}\nEND\n")
            surplus = [
                item
                for item in made.diagnostics
                if item.line == body.count("\n") + 3 and item.severity.value == "warning"
            ]
            assert bool(surplus) == (count > meant), line


def test_numbers_of_nodes_are_as_many_as_the_core_keeps() -> None:
    assert {kind: len(row) for kind, row in numbers.NODE_MASS.items()} == {
        NodeKind.POSITION: 1,
        NodeKind.PLANAR_POSITION: 1,
        NodeKind.ORIENTATION: 6,
        NodeKind.ANGLE: 1,
    }
    assert set(numbers.LOAD) == set(numbers.VALUE) == set(NodeKind)


def rows_of(table: str) -> Iterator[str]:
    """The rows of a table of the page, in Markdown; keywords that say the same share a row."""
    if table == "uncovered":
        yield "| keyword | why | instead |"
        yield "|---|---|---|"
        shared: dict[tuple[str, str], list[str]] = {}
        for name, said in home.UNCOVERED.items():
            shared.setdefault(said, []).append(f"`{name}`")
        for (why, instead), names in shared.items():
            yield f"| {', '.join(names)} | {why} | {instead} |"
        return
    yield f"| statement | {'gives' if table == 'classes' else 'says'} |"
    yield "|---|---|"
    rows: dict[str, list[str]] = {}
    for row in keywords().values():
        words = words_of(row)
        if words.table == table:
            says = words.says or numbers.properties_in_words(row.name)
            rows.setdefault(says, []).append(f"`{statement_of(row)}`")
    for says, statements in rows.items():
        yield f"| {', '.join(dict.fromkeys(statements))} | {says} |"


def statement_of(row: Keyword) -> str:
    return f"{row.name} {words_of(row).operands}".strip()


def test_the_page_of_the_deck_language_shows_what_keywords_say(as_stored: AsStored) -> None:
    page = PAGE.read_text(encoding="utf-8")
    assert {name for _, name, _ in _TABLE.findall(page)} == {*TABLES, "uncovered"}

    def filled(found: re.Match[str]) -> str:
        table = "\n".join(rows_of(found[2]))
        return f"{found[1]}{table}\n{found[3]}"

    as_stored(_TABLE.sub(filled, page), PAGE)


# Colours in VS Code --------------------------------------------------------------------

#: What keywords of each table are to a colour theme.
_SCOPES = {
    "classes": "keyword.control.class",
    "values": "keyword.other.value",
    "units": "keyword.other.value",
    "properties": "support.function.property",
    "loads": "support.function.load",
    "pictures": "keyword.other.picture",
    "unused": "keyword.other.unused",
    "uncovered": "invalid.deprecated",
}
_NUMBER = r"(?<=\s)[-+]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][-+]?\d+)?(?=[\s%#;]|$)"


def starting(words: list[str]) -> str:
    """A pattern of lines that start with one of some words."""
    return rf"(?i)^\s*({'|'.join(sorted(words))})(?=[\s%#;]|$)"


def grammar() -> dict[str, Any]:
    """The TextMate grammar of decks, from the tables of elements and keywords."""
    elements = [word for kind in element_kinds() for word in (kind.keyword, kind.synonym) if word]
    scopes = {"storage.type.element": [*elements, home.WITH_WARPING]}
    scopes["keyword.control.block"] = list(home.ENDINGS)
    for row in keywords().values():
        if row.name != "VISUALIZATION":
            scopes.setdefault(_SCOPES[words_of(row).table], []).append(row.name)
    named = [
        {"match": starting(sorted(set(words))), "captures": {"1": {"name": f"{scope}.deck"}}}
        for scope, words in scopes.items()
    ]
    sections = "|".join(each.name for each in CrossSection if each)
    section = {"match": rf"(?i)\b({sections})\b", "name": "constant.language.deck"}
    number = {"match": _NUMBER, "name": "constant.numeric.deck"}
    comment = {"match": "[%#].*$", "name": "comment.line.percentage.deck"}
    starred = {"match": r"^\*.*$", "name": "comment.line.star.deck"}
    semicolon = {"match": "[%#;].*$", "name": "comment.line.semicolon.deck"}
    inside = [section, number]
    picture = {
        "begin": r"(?i)^\s*(VISUALIZATION)(?=[\s%#;]|$)",
        "beginCaptures": {"1": {"name": "keyword.control.block.deck"}},
        "end": r"(?!)",
        "patterns": [starred, semicolon, *named, *inside],
    }
    return {
        "name": "Flexact deck",
        "scopeName": "source.flexact-deck",
        "patterns": [starred, comment, picture, *named, number],
    }


def test_colours_are_made_of_the_tables(as_stored: AsStored) -> None:
    as_stored(json.dumps(grammar(), indent=2, ensure_ascii=False), GRAMMAR)
    elements = [kind.keyword for kind in element_kinds()]
    patterns = [one["match"] for one in grammar()["patterns"] if "captures" in one]
    for word in (
        *elements,
        *(row.name for row in keywords().values() if row.name != "VISUALIZATION"),
    ):
        for line in (f"{word} 1 2", f"  {word.lower()}%", word):
            found = {match[1].upper() for one in patterns if (match := re.search(one, line))}
            assert found == {word}
        assert not any(re.search(one, f"1 {word}") for one in patterns)
    assert re.findall(_NUMBER, "X 3  0.1 -.5e3 +1.0D-3 3 %")[:2] == ["3", "0.1"]
    assert len(re.findall(_NUMBER, "X 3  0.1 -.5e3 +1.0D-3 3 % 1a")) == 5


def test_the_extension_knows_its_files_and_no_address_of_a_registry() -> None:
    about = json.loads((EXTENSION / "package.json").read_text(encoding="utf-8"))
    (language,) = about["contributes"]["languages"]
    (colours,) = about["contributes"]["grammars"]
    assert language["id"] == colours["language"] == "flexact-deck"
    assert (EXTENSION / colours["path"]).resolve() == GRAMMAR.resolve()
    assert grammar()["scopeName"] == colours["scopeName"]
    assert (EXTENSION / language["configuration"]).is_file()
    lock = (EXTENSION / "package-lock.json").read_text(encoding="utf-8")
    assert '"resolved"' not in lock and "://registry" not in lock
    used = json.loads(lock)["packages"][""]
    assert used["dependencies"] == about["dependencies"]
    assert used["devDependencies"] == about["devDependencies"]
