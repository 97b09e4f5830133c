# SPDX-License-Identifier: BSD-3-Clause
"""What the other format cannot say, each once, with how much of it."""

from __future__ import annotations

from collections import Counter

from ...deck.diagnostics import Diagnostic, Severity

LEFT_OUT, LOST, OWN_FIELD = "left-out", "lost", "own-field"


class Remarks:
    """Counts of what is left out, and of fields that only Flexact knows.

    Attributes:
        left_out: What the verdict does not depend on.
        lost: What it depends on.
        own: Fields of tables.
    """

    def __init__(self) -> None:
        """Nothing yet."""
        self.left_out: Counter[str] = Counter()
        self.lost: Counter[str] = Counter()
        self.own: Counter[str] = Counter()

    def leave_out(self, what: str, times: int = 1) -> None:
        """Note something that the other format does not hold."""
        if times:
            self.left_out[what] += times

    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """A warning of each thing that is lost, a note of each that is left out."""
        made = [
            _remark(Severity.WARNING, LOST, f"lost, though the verdict depends on it: {what} ({n})")
            for what, n in self.lost.items()
        ]
        made += [
            _remark(Severity.NOTE, LEFT_OUT, f"{what} ({n})") for what, n in self.left_out.items()
        ]
        if self.own:
            fields = ", ".join(f"{name} ({times})" for name, times in self.own.items())
            words = f"fields that SPACAR Light does not know: {fields}"
            made.append(_remark(Severity.NOTE, OWN_FIELD, words))
        return tuple(made)


def _remark(severity: Severity, code: str, message: str) -> Diagnostic:
    return Diagnostic(severity, code, message)
