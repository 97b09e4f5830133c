# SPDX-License-Identifier: BSD-3-Clause
"""What changed between two runs of a deck."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import IntEnum

from .comparing_modes import came_and_went
from .differences import Mode, Side
from .statements import Different, differences

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
    verdict, counts = list(_of_verdicts(before, after)), list(_of_counts(before, after))
    numbers = list(_of_numbers(before, after))
    came: tuple[str, ...] = ()
    went: tuple[str, ...] = ()
    if not before.is_broken and not after.is_broken:
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


def _of_verdicts(before: Side, after: Side) -> Iterator[str]:
    if before.verdict != after.verdict:
        yield f"{before.words}{_ARROW}{after.words}"


def _of_counts(before: Side, after: Side) -> Iterator[str]:
    if before.is_broken and after.is_broken:
        if before.error != after.error:
            yield f"first error: {before.error}{_ARROW}{after.error}"
        return
    if before.is_broken or after.is_broken:
        yield f"first error{' now' * after.is_broken}: {before.error or after.error}"
        return
    for name, count in before.numbers.items():
        if count != after.numbers[name]:
            yield f"{name}: {count}{_ARROW}{after.numbers[name]}"


def _of_numbers(before: Side, after: Side) -> Iterator[str]:
    if before.is_broken or after.is_broken:
        return
    if before.margin != after.margin:
        yield f"{before.margin}{_ARROW}{after.margin}"
    if before.certainty != after.certainty:
        yield f"rank {before.certainty}{_ARROW}{after.certainty}"


def _named(name: str, modes: tuple[Mode, ...], every: tuple[Mode, ...]) -> tuple[str, ...]:
    """Modes in words, with their numbers where there are several."""
    several = len(every) > 1
    return tuple(f"{name}{f' {every.index(mode) + 1}' * several}: {mode.words}" for mode in modes)
