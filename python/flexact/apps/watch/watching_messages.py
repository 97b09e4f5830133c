# SPDX-License-Identifier: BSD-3-Clause
"""What the watching process and its workers tell each other."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from .messages import Told


@dataclass(frozen=True)
class Job:
    """What a worker is asked for.

    Attributes:
        path: The deck or the script.
        is_script: Which of them it is.
        decision: Arguments of `flexact.analysis.spaces.asked_for`.
    """

    path: str
    is_script: bool
    decision: tuple[Any, ...] = ("auto", None)


@dataclass(frozen=True)
class Printed:
    """What a script has printed."""

    text: str


@dataclass(frozen=True)
class Judged:
    """What is told of a result whose scene is still being made."""

    told: Told


@dataclass(frozen=True)
class Shown:
    """A result as the page shows it.

    Attributes:
        title: Of the page, as text.
        body: What stands within its body.
        told: What is told of the result.
        which: Which model of a script it is, in words; empty for a deck.
        problems: Warnings and notes, as the terminal has them.
        files: What it was made of, besides the file that is watched.
        result: The result itself, pickled.
        model: The name of the model in a script; empty for a deck.
    """

    title: str
    body: str
    told: Told
    which: str
    problems: str
    files: tuple[str, ...]
    result: bytes = b""
    model: str = ""


@dataclass(frozen=True)
class Broken:
    """Why there is no result.

    Attributes:
        title: Of the page, as text.
        errors: As HTML.
        body: What stands within the body of a page that has nothing else to show.
        words: As the terminal has them.
        files: As in `Shown`.
    """

    title: str
    errors: str
    body: str
    words: str
    files: tuple[str, ...]


Answer = Shown | Broken
