# SPDX-License-Identifier: BSD-3-Clause
"""Outputs of many parts, which go on where one part cannot be made, and say so."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import TypeVar

from .errors import FlexactError

#: Where this is set in the environment, mistakes of Flexact's own are raised: as in its tests.
STRICT = "FLEXACT_STRICT"
_Part = TypeVar("_Part")
_Instead = TypeVar("_Instead")


def attempted(
    what: str,
    make: Callable[[], _Part],
    instead: _Instead,
    left_out: list[str] | None,
    words: str = "{what} is left out: {why}.",
) -> _Part | _Instead:
    """One part of an output, or what stands in its place where it cannot be made.

    Args:
        what: The part, as the start of a sentence: "The drawing of motion 2".
        make: What makes it.
        instead: What is given where that fails.
        left_out: Takes what is left out and why, once; None where nothing is said.
        words: How that is said: a sentence, or what stands behind "Left out: ".

    Raises:
        Exception: A mistake of Flexact's own, where `STRICT` is set in the environment.
    """
    try:
        return make()
    except Exception as error:
        told = words.format(what=what, why=why(error))
        if left_out is not None and told not in left_out:
            left_out.append(told)
        return instead


def why(error: Exception) -> str:
    """Why something cannot be had, to stand within a sentence.

    Raises:
        Exception: The error itself if it is none that is raised on purpose, where `STRICT` is set.
    """
    if isinstance(error, FlexactError):
        return str(error)
    if isinstance(error, MemoryError):
        return "not enough memory"
    if os.environ.get(STRICT):
        raise error
    told = " ".join(f"{type(error).__name__}: {error}".split())
    return f"a mistake of Flexact's own, please report it ({told})"
