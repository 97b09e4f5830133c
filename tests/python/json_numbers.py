# SPDX-License-Identifier: BSD-3-Clause
"""Whether every number of a text is in the JSON, with its unit.

Labels of the JSON (names, and places in words), which may hold digits themselves, and its
statements are taken out of the text first; then vectors, quantities and plain numbers are
looked for.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from typing import Any

#: The words of a workshop, as SI has them.
UNITS = {
    **{"m": (1.0, "m"), "mm": (1e-3, "m"), "um": (1e-6, "m"), "nm": (1e-9, "m")},
    **{"rad": (1.0, "rad"), "mrad": (1e-3, "rad"), "urad": (1e-6, "rad"), "nrad": (1e-9, "rad")},
    **{"N": (1.0, "N"), "N m": (1.0, "N m"), "m/rad": (1.0, "m/rad")},
}
_NUMBER = r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?"
_UNIT = "|".join(map(re.escape, sorted(UNITS, key=len, reverse=True)))
_QUANTITY = re.compile(rf"(?<![\w.])({_NUMBER}) ({_UNIT})(?![\w/])")
_VECTOR = re.compile(rf"\(((?:\*|{_NUMBER})(?:, (?:\*|{_NUMBER}))+)\) (m|N m|N)(?!\w)")
_DIRECTION = re.compile(rf"(?:along|about) \(({_NUMBER}(?:, {_NUMBER})+)\)")
_PLAIN = re.compile(rf"(?<![\w.])({_NUMBER})(?![\w.]*\d)")
#: Keys of texts that label something, and of rows of them.
_LABELS = ("words", "label", "name", "part", "on")
_ROWS = ("bodies", "joints", "internal_to", "parts", "calls", "declared", "free")
#: Of a vector, what is below this part of its largest component may be told as 0.
_ZERO = 1e-9


def walk(made: Any) -> Iterator[dict[str, Any]]:
    """All objects within an object."""
    if isinstance(made, dict):
        yield made
        for each in made.values():
            yield from walk(each)
    elif isinstance(made, list):
        for each in made:
            yield from walk(each)


def plain_numbers(made: Any) -> Iterator[float]:
    """All numbers that have no unit."""
    if isinstance(made, dict):
        for key, each in made.items():
            if key != "value":
                yield from plain_numbers(each)
    elif isinstance(made, list):
        for each in made:
            yield from plain_numbers(each)
    elif isinstance(made, (int, float)) and not isinstance(made, bool):
        yield float(made)


def is_rounded_to(text: str, exact: float, digits: int) -> bool:
    """Whether a number as it is printed is another one, rounded to so many digits."""
    return float(text) in (exact, float(f"{exact:.{digits}g}"))


def assert_all_told(text: str, made: dict[str, Any]) -> None:
    """Every number of `describe()` is in the JSON."""
    text = re.sub(r"^  \d+\.(?: |$)", "", text, flags=re.MULTILINE)
    text = " ".join(text.split())
    deck = " ".join(made["deck"].split())
    text = text.removeprefix(deck).strip() if deck else text
    for warning in made["warnings"]:
        said = f"{warning['severity']}: {' '.join(warning['message'].split())}"
        text = text.replace(said + f" (line {warning['line']})", "").replace(said, "")
    made = {key: each for key, each in made.items() if key not in ("warnings", "deck")}
    objects = list(walk(made))
    text = _without_labels(text, objects)
    text = _without_statements(text, made["advice"])
    text = _without_left_out(text, made)
    text = _VECTOR.sub(_of_vector(objects, made["characteristic_length"]["value"]), text)
    text = _DIRECTION.sub(_of_direction(objects), text)
    text = _QUANTITY.sub(_of_quantity(objects, text), text)
    plain = set(plain_numbers(made))
    for number in _PLAIN.findall(text):
        ways = [is_rounded_to(number, each, digits) for each in plain for digits in (1, 2, 4)]
        assert any(ways), (number, text)


def _without_labels(text: str, objects: list[dict[str, Any]]) -> str:
    labels = {each[key] for each in objects for key in _LABELS if isinstance(each.get(key), str)}
    for each in objects:
        for row in (each.get(key) for key in _ROWS):
            labels |= {label for label in row or () if isinstance(label, str)}
    known = {" ".join(label.split()) for label in labels if re.search(r"\d", label)}
    # Several names of one kind stand together: "sheets 1 to 3 and 5".
    for head in {label.rpartition(" ")[0] for label in known if label[-1].isdigit()}:
        numbers = r"\d+(?:(?:, | and | to )\d+)*"
        text = re.sub(rf"(?<!\w){re.escape(head)}(?:s|es) {numbers}", "LABELS", text)
    for label in sorted(known, key=len, reverse=True):
        text = re.sub(rf"(?<!\w){re.escape(label)}(?!\w)", "LABEL", text)
    return text


def _without_statements(text: str, advice: list[dict[str, Any]]) -> str:
    known = {
        f"{statement['keyword']} {part['operands']}"
        for each in advice
        for statement in each["statements"]
        for part in each["parts"]
    }
    # A declaration of a coordinate is taken back without a statement.
    known |= {
        f"without DYNX {part['operands']}"
        for each in advice
        for part in each["parts"]
        if each["step"] == "take one declaration away" and "coordinate" in part
    }
    for statement in sorted(known, key=len, reverse=True):
        text = text.replace(statement, "STATEMENT")
    assert not re.search(r"\b[A-Z]{3,} \d", text), text
    return text


def _without_left_out(text: str, made: dict[str, Any]) -> str:
    """How many motions, names or parts a sentence counts instead of naming them."""

    def of_modes(found: re.Match[str]) -> str:
        key = "motions" if found[2] == "motion" else "self_stresses"
        count = made["under_constrained" if found[2] == "motion" else "over_constrained"]
        assert int(found[1]) == count - min(12, len(made[key]))
        return ""

    def of_loads(found: re.Match[str]) -> str:
        conflicts = [each for stress in made["self_stresses"] for each in stress["conflicts"]]
        assert int(found[1]) in {len(each["loads"]) for each in conflicts}
        return ""

    text = re.sub(r"\.\.\. and (\d+) more (motion|self-stress)(?:e?s)?", of_modes, text)
    text = re.sub(r"\b(\d+)(?= parts press on)", of_loads, text)
    return re.sub(r"\b\d+ (?:more|other parts)\b", "", text)


def _of_vector(objects: list[dict[str, Any]], length: float) -> Callable[[re.Match[str]], str]:
    vectors = [each for each in objects if isinstance(each.get("value"), list)]

    def of(found: re.Match[str]) -> str:
        parts = found[1].split(", ")
        those = [each["value"] for each in vectors if each["unit"] == found[2]]
        assert any(_is_vector(parts, each, length * (found[2] == "m")) for each in those), (
            found[0],
            those[:9],
        )
        return "VECTOR"

    return of


def _is_vector(parts: list[str], exact: list[float], length: float) -> bool:
    """Whether components are told in four digits; `length` is that of the mechanism."""
    least = _ZERO * max(length, *map(abs, exact))
    pairs = zip(parts, exact, strict=False)
    return all(
        part == "*" or is_rounded_to(part, 0.0 if abs(value) < least else value, 4)
        for part, value in pairs
    )


def _of_direction(objects: list[dict[str, Any]]) -> Callable[[re.Match[str]], str]:
    directions = [each["direction"] for each in objects if "direction" in each]
    directions += [axis for each in objects for axis in each.get("axes", ())]

    def of(found: re.Match[str]) -> str:
        parts = [float(part) for part in found[1].split(", ")]
        apart = [
            max(abs(sign * one - other) for one, other in zip(each, parts, strict=False))
            for each in directions
            for sign in (1, -1)
        ]
        assert min(apart, default=1.0) <= 1e-3, (found[0], directions)
        return "DIRECTION"

    return of


def _of_quantity(objects: list[dict[str, Any]], text: str) -> Callable[[re.Match[str]], str]:
    there: list[tuple[float, str]] = []
    for each in objects:
        value = each.get("value")
        if isinstance(value, list):
            there += [(part, each["unit"]) for part in value]
        elif value is not None:
            there.append((value, each["unit"]))
        there += [(each[key], unit) for key, unit in _CHANGES if each.get(key) is not None]

    def of(found: re.Match[str]) -> str:
        factor, unit = UNITS[found[2]]
        those = [value for value, its in there if its == unit]
        # Of compression the size is told.
        is_size = text[: found.start()].endswith("compression ")
        signs = (1, -1) if is_size else (1,)
        told = [f"{float(f'{each:.2g}') / factor:.4g}" for each in those]
        told += [f"{sign * each:.4g}" for each in those for sign in signs if factor == 1.0]
        assert found[1] in told, (found[0], text)
        return "QUANTITY"

    return of


_CHANGES = (("change_m", "m"), ("change_rad", "rad"))
