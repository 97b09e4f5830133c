# SPDX-License-Identifier: BSD-3-Clause
"""Diagnostics as text: carets under their tokens, whatever stands in the line."""

import os
import re
from pathlib import Path

import pytest

import flexact
from flexact.deck.diagnostics import Diagnostic, Place, Problems, Severity, Source
from flexact.deck.rendering import render, render_problems
from flexact.util.text import harmless


def problem(first: int, last: int, line: int = 1, **more: object) -> Diagnostic:
    return Diagnostic(
        Severity.ERROR, "bad-number", "not a number", line, first, last, "here", **more
    )  # type: ignore[arg-type]


def rendered(text: str | bytes, item: Diagnostic) -> list[str]:
    raw = text.encode() if isinstance(text, str) else text
    return render(item, "a.dat", Source(raw, "a.dat")).split("\n")


def under(lines: list[str], mark: str = "^") -> str:
    """What stands above the marks of the first excerpt."""
    index = next(i for i, line in enumerate(lines) if mark in line and "|" in line)
    first = lines[index].index(mark)
    return lines[index - 1][first : first + lines[index].count(mark)]


def test_layout() -> None:
    item = problem(9, 11, help="write a number", line=2)
    assert rendered("TRUSS 1 1 2\nX 1 0 0 abc\nX 2 1 0 0\n", item) == [
        "error[bad-number]: not a number",
        " --> a.dat:2:9",
        "  |",
        "2 | X 1 0 0 abc",
        "  |         ^^^ here",
        "  = help: write a number",
    ]


def test_two_places_stand_one_after_the_other() -> None:
    item = problem(7, 7, line=12, other=Place(3, 7, 7))
    text = "\n" * 2 + "TRUSS 1 1 2" + "\n" * 9 + "TRUSS 1 3 4"
    assert rendered(text, item) == [
        "error[bad-number]: not a number",
        "  --> a.dat:12:7",
        "   |",
        "12 | TRUSS 1 3 4",
        "   |       ^ here",
        "  ::: a.dat:3:7",
        "   |",
        " 3 | TRUSS 1 1 2",
        "   |       - first here",
    ]


def test_tabs_are_kept_in_both_lines() -> None:
    lines = rendered("X\t1\t0\tabc", problem(7, 9))
    assert lines[3] == "1 | X\t1\t0\tabc"
    assert lines[4] == "  |  \t \t \t^^^ here"


def test_long_lines_are_cut_around_the_token() -> None:
    text = "RLSE 1" + " 2" * 500 + " abc" + " 3" * 500
    lines = rendered(text, problem(1008, 1010))
    assert under(lines) == "abc"
    assert lines[3].startswith("1 | ...") and lines[3].endswith("...")
    assert max(map(len, lines)) < 130


def test_token_longer_than_the_window() -> None:
    lines = rendered("X 1 " + "9" * 5000 + "x", problem(5, 5005))
    assert set(under(lines)) <= {"9", "."}
    assert max(map(len, lines)) < 250


def test_token_at_the_end_and_beyond_it() -> None:
    assert under(rendered("X 1 0 0 q", problem(9, 9))) == "q"
    lines = rendered("X 1 0", problem(6, 6))
    assert lines[4] == "  |      ^ here"
    assert rendered("", problem(1, 1))[4] == "  | ^ here"


def test_control_characters_are_shown_harmlessly() -> None:
    lines = rendered("X 1 \x1b[2J\x07\r0 q", problem(13, 13))
    assert not any(ord(c) < 32 for line in lines for c in line)
    assert under(lines) == "q"
    assert harmless("a\x1b\x7f\x85\u202eb\n") == "a\u241b\u2421\ufffd\ufffdb\u240a"


def test_wide_and_combining_characters_move_the_caret() -> None:
    # Two columns each for two CJK characters; none for a combining accent.
    lines = rendered("\u677f\u677fe\u0301 q", problem(6, 6))
    assert lines[4] == "  |" + " " * 7 + "^ here"


def test_byte_columns_become_character_columns() -> None:
    source = Source("X 1 \u00e9\u00e9 q\nplain q".encode(), "a")
    assert source.character_columns(1, 10, 10) == (8, 8)
    assert source.character_columns(1, 5, 8) == (5, 6)
    assert source.character_columns(2, 7, 7) == (7, 7)
    old = Source("X 1 \u00e9\u00e9 q".encode("cp1252"), "a")
    assert old.character_columns(1, 8, 8) == (8, 8)


@pytest.mark.parametrize("encoding", ["utf-8", "cp1252"])
def test_carets_in_decks_that_are_not_ascii(encoding: str) -> None:
    deck = "TRUSS 1 1 2 % \u00fcber\nX 1 0 0 \u00e4\u00e4\n".encode(encoding)
    with pytest.raises(flexact.DeckError) as error:
        flexact.read_text(deck)
    (item,) = error.value.diagnostics
    assert (item.line, item.column, item.last_column) == (2, 9, 10)
    assert under(str(error.value).split("\n")) == "\u00e4\u00e4"


def test_carriage_returns_are_no_part_of_the_line() -> None:
    with pytest.raises(flexact.DeckError) as error:
        flexact.read_text("TRUSS 1 1 2\r\nX 1 0 0 q\r\n")
    assert "2 | X 1 0 0 q\n" in str(error.value)


def test_first_twenty_then_a_count() -> None:
    deck = "TRUSS 1 1 2\nX 2 1 0 0\n" + "".join(f"FIX {k}\n" for k in range(10, 60))
    with pytest.raises(flexact.DeckError) as error:
        flexact.read_text(deck, "many.dat")
    text = str(error.value)
    assert text.count("error[") == 20
    assert numbers_at_the_end(text) == [30, 50]
    assert len(error.value.diagnostics) == 50


def test_count_goes_on_where_no_more_are_kept() -> None:
    deck = "TRUSS 1 1 2\nX 2 1 0 0\n" + "".join(f"FIX {k}\n" for k in range(10, 260))
    with pytest.raises(flexact.DeckError) as error:
        flexact.read_text(deck, "many.dat")
    assert numbers_at_the_end(str(error.value)) == [230, 250]


def numbers_at_the_end(text: str) -> list[int]:
    """How many problems are left out, and how many there are by severity."""
    return [int(number) for number in re.findall(r"\d+", "".join(text.splitlines()[-3:]))]


def test_errors_go_before_warnings_where_not_all_fit() -> None:
    warnings = [Diagnostic(Severity.WARNING, "w", f"warning {k}", k, 1, 1) for k in range(1, 31)]
    error = Diagnostic(Severity.ERROR, "e", "the error", 31, 1, 1)
    text = render_problems(Problems.of([*warnings, error]), "a")
    assert "the error" in text and "warning 19\n" in text and "warning 20\n" not in text
    assert numbers_at_the_end(text) == [11, 1, 30]


def test_ten_mistakes_show_ten_places() -> None:
    deck = (
        "TRUSS 1 1 2\nTRUS 2 2 3\nTRUSS 3 2\nTRUSS 4 2 3 9\nTRUSS 1 2 3\nX 1 0 0 zero\n"
        "X 77 0 0 0\nFIX 1 4\nFIX 2 1\nDYNX 2 1\nRLSE 99\nTRUSS 5 2 0.5\n"
        "X 2 1 0 0\nX 3 2 0 0\n"
    )
    with pytest.raises(flexact.DeckError) as error:
        flexact.read_text(deck)
    assert {item.line for item in error.value.diagnostics} == {2, 3, 4, 5, 6, 7, 8, 10, 11, 12}
    assert str(error.value).count(" --> deck:") == 10


def test_path_cannot_play_tricks() -> None:
    with pytest.raises(flexact.DeckError) as error:
        flexact.read("no\x1b[31m\nsuch")
    assert "\x1b" not in str(error.value)
    assert "no\u241b[31m\u240asuch" in str(error.value)


def failure(path: str | os.PathLike[str]) -> tuple[str, str]:
    with pytest.raises(flexact.DeckError) as error:
        flexact.read(path)
    (item,) = error.value.diagnostics
    assert error.value.path == str(path)
    assert str(error.value).startswith(f"error[{item.code}]: {item.message}\n")
    return item.code, item.message


@pytest.mark.posix
def test_what_is_not_a_deck(tmp_path: Path) -> None:
    assert failure(tmp_path / "none.dat")[0] == "no-such-file"
    assert failure(tmp_path)[0] == "is-a-folder"
    assert failure("")[0] == "no-such-file"
    assert failure("a\0b")[0] == "cannot-read"
    assert failure("x" * 5000)[0] == "cannot-read"
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    assert failure(pipe)[0] == "not-a-file"
    assert failure("/dev/zero")[0] == "not-a-file"
    loop = tmp_path / "loop"
    loop.symlink_to(loop)
    assert failure(loop)[0] == "cannot-read"


@pytest.mark.parametrize(
    ("content", "code"),
    [
        (b"", "empty-deck"),
        (b"\xef\xbb\xbf", "empty-deck"),
        (b"\n \t\r\n", "nothing-to-analyse"),
        (bytes(range(256)) * 40, "not-text"),
        (bytes(range(1, 32)) * 400, "not-text"),
        ("TRUSS 1 1 2\n".encode("utf-16"), "not-text"),
        (b"\x89PNG\r\n\x1a\n" + bytes(100), "not-text"),
    ],
)
def test_files_that_hold_no_deck(tmp_path: Path, content: bytes, code: str) -> None:
    path = tmp_path / "a.dat"
    path.write_bytes(content)
    assert failure(path)[0] == code


def test_nul_byte_is_shown_where_it_stands() -> None:
    with pytest.raises(flexact.DeckError) as error:
        flexact.read_text(b"TRUSS 1 1 2\nX 2 \xc3\xa9 1\0 0 0\n")
    (item,) = error.value.diagnostics
    assert (item.code, item.line, item.column) == ("not-text", 2, 8)
    assert under(str(error.value).split("\n")) == "\u2400"


@pytest.mark.parametrize("mark", [b"\xef\xbb\xbf", b""])
@pytest.mark.parametrize("end", [b"\n", b"\r\n", b"", b"\n\x1a"])
def test_marks_of_old_and_new_editors_are_no_mistakes(mark: bytes, end: bytes) -> None:
    model = flexact.read_text(mark + b"TRUSS 1 1 2" + b"\nX 2 1 0 0" + end)
    assert model.positions[1].tolist() == [1, 0, 0]


@pytest.mark.parametrize("seed", range(30))
def test_noise_gives_a_deck_error(seed: int) -> None:
    import random

    draw = random.Random(seed)
    letters = [*"\t\n 0123456789.-+eE%#*;", "TRUSS ", "BEAM ", "X ", "FIX ", "END\n", "\u00e9"]
    text = "".join(draw.choices(letters, k=3000))
    with pytest.raises(flexact.DeckError) as error:
        flexact.read_text(text)
    assert "error[" in str(error.value)


def test_warnings_stay_with_the_model() -> None:
    model = flexact.read_text(
        "TRUSS 1 1 2\nX 2 1 0 0\nX 2 2 0 0\nFIX 1\nEND\nTIMESTEP 2 1\n", "a.dat"
    )
    codes = [(item.severity, item.code) for item in model.diagnostics]
    assert (Severity.WARNING, "repeated-value") in codes
    assert Severity.NOTE in {severity for severity, _ in codes}
    text = render_problems(model.data.problems, model.name, model.data.source)
    first, second, *_ = text.splitlines()
    assert first.startswith("warning[repeated-value]: ") and second == " --> a.dat:3:3"
    assert numbers_at_the_end(text)[-2:] == [1, 1]
