# SPDX-License-Identifier: BSD-3-Clause
"""What the other format cannot say, each once, with how much of it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from ..diagnostics.diagnostic import Diagnostic, Severity

LEFT_OUT, OWN_FIELD = "left-out", "own-field"


class Remarks:
    """Counts of what is left out, and of fields that only Flexact knows."""

    def __init__(self) -> None:
        """Nothing yet."""
        self.left_out: Counter[str] = Counter()
        self.own: Counter[str] = Counter()

    def leave_out(self, what: str, times: int = 1) -> None:
        """Note something that the other format does not hold."""
        if times:
            self.left_out[what] += times

    def notes(self) -> tuple[Diagnostic, ...]:
        """One note each."""
        made = [_note(LEFT_OUT, f"left out: {what} ({n})") for what, n in self.left_out.items()]
        if self.own:
            fields = ", ".join(f"{name} ({times})" for name, times in self.own.items())
            made.append(_note(OWN_FIELD, f"fields that SPACAR Light does not know: {fields}"))
        return tuple(made)


def of_conversion(diagnostics: Sequence[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Those of diagnostics that are remarks of a conversion."""
    return tuple(item for item in diagnostics if item.code in (LEFT_OUT, OWN_FIELD))


def _note(code: str, message: str) -> Diagnostic:
    return Diagnostic(Severity.NOTE, code, message)
