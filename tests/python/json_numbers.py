# SPDX-License-Identifier: BSD-3-Clause
"""Whether every number of a text is in the JSON, with its unit, at what it is said of."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

#: The words of a workshop, as SI has them.
UNITS = {
    **{"m": (1.0, "m"), "mm": (1e-3, "m"), "um": (1e-6, "m"), "nm": (1e-9, "m")},
    **{"rad": (1.0, "rad"), "mrad": (1e-3, "rad"), "urad": (1e-6, "rad"), "nrad": (1e-9, "rad")},
    **{"N": (1.0, "N"), "N m": (1.0, "N m")},
}
_NUMBER = r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?"
_WITH_UNIT = re.compile(rf"(?<![\w.])({_NUMBER}) (N m|{'|'.join(sorted(UNITS, key=len)[::-1])})\b")
_COMPONENT = re.compile(
    rf"node (\d+) (r?[xyz]) ({_NUMBER}) (m|rad)"
    rf"|element (\d+) e(\d) ([a-z ]+?) ({_NUMBER}) (N m|N)\b"
)
_PLAIN = re.compile(rf"(?<![\w.])({_NUMBER})(?![\w.]*\d)")


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
    """Every number of `describe()` is in the JSON.

    A component is looked for with its node or element, coordinate or deformation, word and unit;
    a margin with its place; a statement with its operands; other numbers as they are.
    """
    text = re.sub(r"^  \d+\. ", "", text, flags=re.MULTILINE)
    text = " ".join(text.split())
    deck = " ".join(made["deck"].split())
    text = text.removeprefix(deck).strip() if deck else text
    for warning in made["warnings"]:
        said = f"{warning['severity']}: {' '.join(warning['message'].split())}"
        text = text.replace(said + f" (line {warning['line']})", "").replace(said, "")
    objects = list(walk({key: each for key, each in made.items() if key != "warnings"}))
    elements = [each for each in objects if "element" in each]
    for each in elements:
        if each["name"]:
            text = text.replace(
                f"element {each['element']} ({each['name']})", f"element {each['element']}"
            )
    text = _without_more(text, made)
    text = _without_components(text, made)
    text = _without_parts(text, objects)
    text = _without_quantities(text, objects)
    plain = set(plain_numbers({key: each for key, each in made.items() if key != "warnings"}))
    for number in _PLAIN.findall(text):
        ways = [is_rounded_to(number, each, digits) for each in plain for digits in (1, 2, 4)]
        assert any(ways), (number, text)


def _without_more(text: str, made: dict[str, Any]) -> str:
    """Such as "... and 18 more motions", of which twelve are shown."""

    def of(found: re.Match[str]) -> str:
        key = "under_constrained" if found[2] == "motion" else "over_constrained"
        shown = min(12, len(made["motions" if found[2] == "motion" else "self_stresses"]))
        assert int(found[1]) == made[key] - shown
        return ""

    return re.sub(r"\.\.\. and (\d+) more (motion|self-stress)(?:e?s)?", of, text)


def _without_components(text: str, made: dict[str, Any]) -> str:
    moved = [each for mode in made["motions"] for each in mode["components"]]
    loaded = [each for mode in made["self_stresses"] for each in mode["components"]]

    def of(found: re.Match[str]) -> str:
        node, coordinate, move, its, element, number, word, load, unit = found.groups()
        if node:
            there = [
                each["value"]
                for each in moved
                if (each["node"], each["coordinate"], each["unit"]) == (int(node), coordinate, its)
            ]
        else:
            place = (int(element), int(number), word, unit)
            there = [
                each["value"]
                for each in loaded
                if (each["element"], each["deformation"], each["word"], each["unit"]) == place
            ]
        assert any(is_rounded_to(move or load, each, 4) for each in there), (found[0], there)
        return "COMPONENT"

    return _COMPONENT.sub(of, text)


def _without_parts(text: str, objects: list[dict[str, Any]]) -> str:
    """Parts of advice, and the statements that do it."""
    statements = {f"{each['keyword']} {each['operands']}" for each in objects if "operands" in each}
    for each in sorted(statements, key=len, reverse=True):
        text = text.replace(each, "STATEMENT")
    parts = {
        f"element {each['element']} e{each['deformation']} {each['word']}"
        for each in objects
        if "deformation" in each
    }
    parts |= {
        f"node {each['node']} {each['coordinate']}" for each in objects if "coordinate" in each
    }
    for each in sorted(parts, key=len, reverse=True):
        text = re.sub(rf"{re.escape(each)}(?!\w)", "PART", text)
    assert not re.search(r"element \d+ e\d|node \d+ r?[xyz]\b|[A-Z]{3,} \d", text), text
    return text


def _without_quantities(text: str, objects: list[dict[str, Any]]) -> str:
    there = [(each["value"], each["unit"]) for each in objects if "unit" in each]
    there += [(each["change_m"], "m") for each in objects if each.get("change_m") is not None]
    there += [(each["change_rad"], "rad") for each in objects if each.get("change_rad") is not None]

    def of(found: re.Match[str]) -> str:
        factor, unit = UNITS[found[2]]
        those = [value for value, its in there if its == unit]
        printed = [f"{float(f'{each:.2g}') / factor:.4g}" for each in those]
        assert found[1] in printed, (found[0], text)
        return "QUANTITY"

    return _WITH_UNIT.sub(of, text)
