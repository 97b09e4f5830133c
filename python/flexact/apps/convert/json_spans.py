# SPDX-License-Identifier: BSD-3-Clause
"""JSON, and where each value in it stands."""

from __future__ import annotations

import json
from bisect import bisect_left
from collections.abc import Iterator
from json import scanner
from typing import Any

from ...deck.diagnostics import Place

#: Where a value begins and ends, and its parts in their order.
_Tree = tuple[int, int, list[Any]]


class JsonError(ValueError):
    """A text that is no JSON."""

    def __init__(self, message: str, line: int = 0, column: int = 0) -> None:
        """What is wrong, and where, from 1; 0 where that is not known."""
        super().__init__(message)
        self.message, self.line, self.column = message, line, column


def value_of_json(text: str) -> Any:
    """What a text holds.

    Raises:
        JsonError: it is no JSON, or an object has two entries of one name.
    """
    try:
        return json.loads(text, object_pairs_hook=_once)
    except json.JSONDecodeError as error:
        words = f"this is no JSON: {error.msg[:1].lower()}{error.msg[1:]}"
        raise JsonError(words, error.lineno, error.colno) from None
    except ValueError as error:
        raise error if isinstance(error, JsonError) else JsonError(str(error)) from None


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    made: dict[str, Any] = {}
    for key, value in pairs:
        if key in made:
            raise JsonError(f"an object has two entries {key!r}: keep one")
        made[key] = value
    return made


def spans_of_json(text: str) -> dict[str, Place]:
    """Where each value of a sound text stands, by its place, such as nprops[3].fix."""
    roots: list[_Tree] = []
    around = [roots]
    plain = scanner.py_make_scanner(json.JSONDecoder())  # type: ignore[attr-defined]

    def scanned(text: str, start: int) -> tuple[Any, int]:
        parts: list[_Tree] = []
        around.append(parts)
        value, behind = kind(text, start)
        around.pop()
        around[-1].append((start, behind, parts))
        return value, behind

    kind = _with_inner(plain, scanned)
    value, _ = scanned(text, len(text) - len(text.lstrip()))
    breaks = [-1, *(i for i, c in enumerate(text) if c == "\n")]

    def span(first: int, behind: int) -> Place:
        line = bisect_left(breaks, first)
        before = breaks[line - 1]
        end = breaks[line] if line < len(breaks) else len(text)
        return Place(line, first - before, min(behind, end) - before - 1)

    return {place: span(*both) for place, *both in _places(value, roots[0], "")}


def _with_inner(plain: Any, scanned: Any) -> Any:
    """The scanner of the standard library, whose parts are scanned by another one."""
    decoder = json.decoder

    def scan(text: str, start: int) -> tuple[Any, int]:
        if text[start : start + 1] == "{":
            return decoder.JSONObject(  # type: ignore[attr-defined,no-any-return]
                (text, start + 1), True, scanned, None, _once, {}
            )
        if text[start : start + 1] == "[":
            return decoder.JSONArray((text, start + 1), scanned)  # type: ignore[attr-defined,no-any-return]
        return plain(text, start)  # type: ignore[no-any-return]

    return scan


def _places(value: Any, tree: _Tree, place: str) -> Iterator[tuple[str, int, int]]:
    start, behind, parts = tree
    yield place, start, behind
    if isinstance(value, dict):
        for (key, inner), part in zip(value.items(), parts, strict=True):
            yield from _places(inner, part, joined(place, key))
    elif isinstance(value, list):
        for i, (inner, part) in enumerate(zip(value, parts, strict=True), start=1):
            yield from _places(inner, part, f"{place}[{i}]")


def joined(place: str, key: object) -> str:
    """The place of an entry of an object: a number stands in brackets, as in a list."""
    if place and str(key).isdecimal():
        return f"{place}[{key}]"
    return f"{place}.{key}" if place else str(key)
