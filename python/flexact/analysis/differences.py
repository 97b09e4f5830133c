# SPDX-License-Identifier: BSD-3-Clause
"""One side of a comparison: what is compared of a result, of its JSON, or of a broken deck."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher
from enum import IntEnum
from typing import Any, NamedTuple

import numpy as np

from ..core.arrays import FloatArray
from ..deck.diagnostics import Source
from ..deck.rendering import ProblemsError
from ..deck.tokens import tokens_of
from ..util.errors import FlexactError
from ..util.matrices import span
from ..util.text import harmless
from . import json as json_modes
from .decomposition import Accuracy
from .limits import DEPENDENT_MODES, SAME_DIRECTION
from .mode_words import motion_in_parts, stress_in_parts
from .naming import counts_in_words, plain
from .result import Result
from .verdict import Margin, Verdict
from .verdict_words import (
    but_only,
    certainty_word,
    margin_in_short,
    margin_of_sizes,
    verdict_in_short,
    verdict_word,
    word_of,
)

_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([de][+-]?\d+)?$", re.IGNORECASE)


#: A line of a deck that says something: what is compared, what is written, and its number.
Statement = tuple[str, str, int]


class Different(NamedTuple):
    """A statement that is on one side only."""

    added: bool
    written: str
    line: int


def statements_in(source: Source) -> tuple[Statement, ...]:
    """The statements of a deck."""
    return tuple(
        (
            " ".join(_meant(word.text) for word in line.words),
            harmless(" ".join(word.text for word in line.words)),
            line.number + 1,
        )
        for line in tokens_of(source)
        if line.words
    )


def _meant(word: str) -> str:
    """A number as it is read, of which long ones keep their digits; other words in capitals."""
    if _NUMBER.match(word) and len(word) < 17:
        return repr(float(re.sub("[dD]", "e", word)) + 0.0)
    return word.upper()


def differences(
    before: tuple[Statement, ...], after: tuple[Statement, ...]
) -> tuple[Different, ...]:
    """What went and what came, in the order of the decks."""
    one, other = ([meant for meant, _, _ in side] for side in (before, after))
    made: list[Different] = []
    matcher = SequenceMatcher(None, one, other, autojunk=False)
    for what, i, j, k, n in matcher.get_opcodes():
        if what != "equal":
            made += [Different(False, written, line) for _, written, line in before[i:j]]
            made += [Different(True, written, line) for _, written, line in after[k:n]]
    return tuple(made)


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
    motions, stresses = json_modes.motions(result), json_modes.self_stresses(result)
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
            Mode(
                "; ".join(map(plain, motion_in_parts(motion, _PARTS)[:_PARTS])),
                _vector(made, "node", "coordinate", length),
            )
            for motion, made in zip(
                result.motions[:MOST_MODES], motions.dictionaries(), strict=False
            )
        ),
        tuple(
            Mode(
                "; ".join(map(plain, stress_in_parts(stress, _PARTS)[:_PARTS])),
                _vector(made, "element", "deformation", 1.0 / length),
            )
            for stress, made in zip(
                result.self_stresses[:MOST_MODES], stresses.dictionaries(), strict=False
            )
        ),
        None if source is None else statements_in(source),
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
            statements = statements_in(error.source)
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
    given = found["accuracy"]
    sizes = Margin(move, turn, None, None, None, bool(margin["exact_alignment"]))
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
        margin_of_sizes(sizes, length, accuracy),
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


def came_and_went(
    before: Sequence[Mode], after: Sequence[Mode]
) -> tuple[tuple[Mode, ...], tuple[Mode, ...]]:
    """The modes that are new, and those that are no more.

    Of each side as many as are missing on the other, those of which the least lies in its space.
    """
    labels = sorted({label for mode in (*before, *after) for label in mode.vector})
    place = {label: k for k, label in enumerate(labels)}
    sides = (before, after)
    vectors = [_matrix(modes, place) for modes in sides]
    bases = [span(each, DEPENDENT_MODES) for each in vectors]
    cosines = np.linalg.svd(bases[0].T @ bases[1], compute_uv=False)
    common = int(np.count_nonzero(cosines > SAME_DIRECTION))
    went, came = (
        tuple(sides[k][i] for i in sorted(rows[: max(bases[k].shape[1] - common, 0)].tolist()))
        for k in (0, 1)
        for reach in [np.linalg.norm(bases[1 - k].T @ vectors[k], axis=0)]
        for rows in [np.argsort(np.round(reach, 9), kind="stable")]
    )
    return came, went


def _matrix(modes: Sequence[Mode], place: dict[tuple[int, str], int]) -> FloatArray:
    """(labels, modes) unit vectors."""
    made = np.zeros((len(place), len(modes)))
    for k, mode in enumerate(modes):
        for label, value in mode.vector.items():
            made[place[label], k] = value
    length = np.linalg.norm(made, axis=0)
    return np.asarray(made / np.where(length > 0.0, length, 1.0))


_ARROW = " \N{RIGHTWARDS ARROW} "


class Gravity(IntEnum):
    """How grave a change is."""

    NONE = 0
    STATEMENTS = 1
    """The deck alone, with the same result."""
    NUMBERS = 2
    """Margin or certainty."""
    COUNTS = 3
    """Counts, motions or self-stresses."""
    VERDICT = 4


@dataclass(frozen=True)
class Change:
    """What changed between two runs of a deck.

    Attributes:
        gravity: How grave it is.
        told: What changed, a sentence each.
        came: What is new, a sentence each.
        went: What is no more, a sentence each.
        statements: Statements that are on one side only, of two decks.
    """

    gravity: Gravity
    told: tuple[str, ...] = ()
    came: tuple[str, ...] = ()
    went: tuple[str, ...] = ()
    statements: tuple[Different, ...] = ()

    @property
    def is_none(self) -> bool:
        """Whether nothing changed that means anything."""
        return self.gravity is Gravity.NONE


def change_of(before: Side, after: Side) -> Change:
    """What changed."""
    verdict, counts, numbers = [], [], []
    came: tuple[str, ...] = ()
    went: tuple[str, ...] = ()
    if before.verdict != after.verdict:
        verdict.append(f"{before.words}{_ARROW}{after.words}")
    if before.is_broken and after.is_broken:
        if before.error != after.error:
            counts.append(f"first error: {before.error}{_ARROW}{after.error}")
    elif before.is_broken or after.is_broken:
        now = " now" * after.is_broken
        counts.append(f"first error{now}: {before.error or after.error}")
    else:
        counts += [
            f"{name}: {count}{_ARROW}{after.numbers[name]}"
            for name, count in before.numbers.items()
            if count != after.numbers[name]
        ]
        if before.margin != after.margin:
            numbers.append(f"{before.margin}{_ARROW}{after.margin}")
        if before.certainty != after.certainty:
            numbers.append(f"rank {before.certainty}{_ARROW}{after.certainty}")
        for what in ("motions", "self_stresses"):
            new, old = came_and_went(getattr(before, what), getattr(after, what))
            name = what.replace("_", "-").removesuffix("es" if what != "motions" else "s")
            came += _named(name, new, getattr(after, what))
            went += _named(name, old, getattr(before, what))
    statements: tuple[Different, ...] = ()
    if before.statements is not None and after.statements is not None:
        statements = differences(before.statements, after.statements)
    gravity = next(
        gravity
        for gravity, found in (
            (Gravity.VERDICT, verdict),
            (Gravity.COUNTS, counts or came or went),
            (Gravity.NUMBERS, numbers),
            (Gravity.STATEMENTS, statements),
            (Gravity.NONE, True),
        )
        if found
    )
    return Change(gravity, (*verdict, *counts, *numbers), came, went, statements)


def _named(name: str, modes: tuple[Mode, ...], every: tuple[Mode, ...]) -> tuple[str, ...]:
    """Modes in words, with their numbers where there are several."""
    several = len(every) > 1
    return tuple(f"{name}{f' {every.index(mode) + 1}' * several}: {mode.words}" for mode in modes)
