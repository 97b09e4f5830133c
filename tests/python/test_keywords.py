# SPDX-License-Identifier: BSD-3-Clause
"""One table of keywords, in the core, and one home of what they say: docs and editors show it."""

import re
from collections.abc import Iterator

import pytest
from reference_decks import NAMES, ROOT, text_of
from wording import AsStored

import flexact
from flexact.core import calls
from flexact.core.elements import NodeKind, element_kinds
from flexact.deck import keywords as home
from flexact.deck import numbers
from flexact.deck.keywords import Block, Keyword, find_keyword, keywords, words_of
from flexact.diagnostics.errors import DeckError

PAGE = ROOT / "docs" / "decks.md"

TABLES = ("classes", "properties", "loads", "pictures", "unused")
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
