# SPDX-License-Identifier: BSD-3-Clause
"""The exceptions that Flexact raises on purpose, and what the system says of a file."""

from __future__ import annotations


class FlexactError(Exception):
    """Anything that Flexact raises on purpose."""


class BatchError(FlexactError):
    """A deck could not be handled for a reason that is not in the deck itself."""


def require_kind(given: object, kind: type, what: str) -> None:
    """Raise unless what was given is of a kind; `what` says what it must be.

    Raises:
        TypeError: It is not.
    """
    if not isinstance(given, kind):
        raise TypeError(f"{what}, not {type(given).__name__}")


def reason_of(error: OSError) -> str:
    """What the system says, to stand within a sentence."""
    return error.strerror.lower() if error.strerror else str(error)
