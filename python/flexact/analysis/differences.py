# SPDX-License-Identifier: BSD-3-Clause
"""One side of a comparison: what is compared of a result, of its JSON, or of a broken deck."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

from ..deck.errors import ProblemsError
from ..util.errors import FlexactError
from ..util.plain_text import harmless
from . import json_modes
from .accuracy import Accuracy
from .mode_words import stress_in_parts
from .motions import motion_in_parts
from .naming import counts_in_words
from .result import Result
from .sentences import plain
from .statements import Statement, statements_in
from .text_margin import (
    but_only,
    margin_in_short,
    margin_of_sizes,
    verdict_in_short,
    verdict_word,
    word_of,
)
from .verdict import Margin, Verdict
from .verdict_words import certainty_word

#: How many parts of a mode its words name.
_PARTS = 3
#: How many motions, and self-stresses, are looked at one by one.
MOST_MODES = 40
_FORMAT = 2


class SideError(FlexactError):
    """A file that is to be compared is no JSON of a result."""


class Mode(NamedTuple):
    """A motion or a self-stress."""

    words: str
    vector: Mapping[tuple[int, str], float]
    """By number of the node or element, and component; angles and moments are made lengths and
    forces by the characteristic length."""


@dataclass(frozen=True)
class Side:
    """What is compared.

    Attributes:
        verdict: As it is counted, or that it cannot be analysed.
        words: The same with numbers.
        numbers: Counts by their words.
        margin: In a few words.
        certainty: How sure the rank is.
        motions: The first motions.
        self_stresses: The first self-stresses.
        statements: Of the deck; None where there is no text of it.
        error: The first error, where it cannot be analysed.
    """

    verdict: str
    words: str
    numbers: Mapping[str, int]
    margin: str = ""
    certainty: str = ""
    motions: tuple[Mode, ...] = ()
    self_stresses: tuple[Mode, ...] = ()
    statements: tuple[Statement, ...] | None = None
    error: str = ""

    @property
    def is_broken(self) -> bool:
        """Whether there is no verdict."""
        return bool(self.error)


def side_of(result: Result) -> Side:
    """What is compared of a result."""
    length = result.characteristic_length
    motions = zip(
        result.motions[:MOST_MODES], json_modes.motions(result).dictionaries(), strict=False
    )
    stresses = zip(
        result.self_stresses[:MOST_MODES],
        json_modes.self_stresses(result).dictionaries(),
        strict=False,
    )
    source = result.given.source
    return Side(
        verdict_word(result),
        verdict_in_short(result),
        _numbers(
            {name: part._asdict() for name, part in result.counts._asdict().items()},
            *(result.under_constrained, result.over_constrained, result.degrees_of_freedom),
        ),
        margin_in_short(result),
        certainty_word(result),
        tuple(
            Mode("; ".join(map(plain, motion_in_parts(motion, _PARTS)[:_PARTS])), vector)
            for motion, made in motions
            for vector in [_vector(made, "node", "coordinate", length)]
        ),
        tuple(
            Mode("; ".join(map(plain, stress_in_parts(stress, _PARTS)[:_PARTS])), vector)
            for stress, made in stresses
            for vector in [_vector(made, "element", "deformation", 1.0 / length)]
        ),
        None if source is None else statements_in(source.text),
    )


def broken_side(error: Exception) -> Side:
    """What is compared of a deck that cannot be analysed."""
    words, statements = str(error) or "not enough memory", None
    if isinstance(error, ProblemsError):
        first = next((item for item in error.diagnostics if item.is_error), None)
        if first is not None:
            place = f"{first.line}:{first.column}: " if first.line else ""
            words = f"{place}{first.message}"
        if error.source is not None:
            statements = statements_in(error.source.text)
    broken = "cannot be analysed"
    return Side(broken, broken, {}, statements=statements, error=harmless(words))


def stored_side(raw: bytes, name: str) -> Side:
    """What is compared of the JSON of a result.

    Raises:
        SideError: It is none, or of another format.
    """
    try:
        found = json.loads(raw.decode("utf-8"))
        if not isinstance(found, dict) or "flexact" not in found:
            raise SideError(f"{name}: this is not the JSON of a result")
        if found.get("format") != _FORMAT:
            raise SideError(
                f"{name}: the format {found.get('format')} is not known; analyse the deck again"
            )
        return _stored(found)
    except SideError:
        raise
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
        raise SideError(f"{name}: this is not the JSON of a result") from error


def _stored(found: dict[str, Any]) -> Side:
    if "error" in found:
        first = found["error"]["diagnostics"][0]
        place = f"{first['line']}:{first['column']}: " if first["line"] else ""
        broken = "cannot be analysed"
        return Side(broken, broken, {}, error=harmless(f"{place}{first['message']}"))
    under, over = int(found["under_constrained"]), int(found["over_constrained"])
    margin, length = found["margin"], float(found["characteristic_length"]["value"])
    move, turn = (
        None if margin[key] is None else float(margin[key]["value"]) for key in ("length", "angle")
    )
    exact, given = bool(margin["exact_alignment"]), found["accuracy"]
    sizes = Margin(move, turn, None, None, None, exact)
    accuracy = None
    if given is not None:
        within = [None if given[k] is None else given[k]["value"] for k in ("length", "angle")]
        accuracy = Accuracy.of(within)
    return Side(
        word_of(
            Verdict(found["verdict"]),
            is_marginal=accuracy is not None and any(accuracy.exceeds(sizes)),
        ),
        counts_in_words(under, over) + but_only(sizes, accuracy),
        _numbers(found["counts"], under, over, int(found["degrees_of_freedom"])),
        margin_of_sizes(move, turn, length, exact=exact),
        str(found["certainty"]),
        tuple(
            Mode(_moving(made), _vector(made, "node", "coordinate", length))
            for made in found["motions"][:MOST_MODES]
        ),
        tuple(
            Mode(_stressed(made), _vector(made, "element", "deformation", 1.0 / length))
            for made in found["self_stresses"][:MOST_MODES]
        ),
    )


def _numbers(
    counts: Mapping[str, Mapping[str, int]], under: int, over: int, freedoms: int
) -> dict[str, int]:
    made = {"motions": under, "self-stresses": over, "declared degrees of freedom": freedoms}
    for what in ("coordinates", "deformations"):
        for kind in ("fixed", "dependent", "independent"):
            made[f"{kind} {what}"] = int(counts[what][kind])
    return made


def _vector(
    made: Mapping[str, Any], owner: str, component: str, factor: float
) -> dict[tuple[int, str], float]:
    """Components; those in rad or N m times the factor."""
    return {
        (int(each[owner]), str(each[component])): float(each["value"])
        * (factor if each["unit"] in ("rad", "N m") else 1.0)
        for each in made["components"]
    }


def _moving(made: Mapping[str, Any]) -> str:
    """What a motion of the JSON moves."""
    words = []
    for each in made["bodies"]:
        names = [*each["bodies"], *each["joints"]]
        if names:
            more = f" and {len(names) - 1} more" * (len(names) > 1)
            words.append(f"{names[0]}{more}: {each['kind']}")
    return harmless("; ".join(words[:_PARTS]) or "; ".join(_largest(made, "node", "coordinate")))


def _stressed(made: Mapping[str, Any]) -> str:
    """What a self-stress of the JSON stresses."""
    names = list(dict.fromkeys(str(each["part"]) for each in made["parts"] or ()))
    if not names:
        return harmless("; ".join(_largest(made, "element", "word")))
    more = f" and {len(names) - _PARTS} more" * (len(names) > _PARTS)
    return harmless(f"in {', '.join(names[:_PARTS])}{more}")


def _largest(made: Mapping[str, Any], owner: str, component: str) -> Iterator[str]:
    order = sorted(made["components"], key=lambda each: -abs(each["value"]))
    for each in order[:_PARTS]:
        yield f"{each['name'] or f'{owner} {each[owner]}'} {each[component]}"
