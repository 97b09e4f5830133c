# SPDX-License-Identifier: BSD-3-Clause
"""The exceptions that Flexact raises on purpose, and what the system says of a file."""

from __future__ import annotations


class FlexactError(Exception):
    """Anything that Flexact raises on purpose."""


class BatchError(FlexactError):
    """A deck could not be handled for a reason that is not in the deck itself."""


def reason_of(error: OSError) -> str:
    """What the system says, to stand within a sentence."""
    return error.strerror.lower() if error.strerror else str(error)
