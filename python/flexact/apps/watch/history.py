# SPDX-License-Identifier: BSD-3-Clause
"""Edits that can be undone and done again."""

from __future__ import annotations

from collections.abc import Callable

from .editable_model import Edits

#: How many steps can be undone.
_MOST = 200


class History:
    """The states of the edits, and which of them holds."""

    def __init__(self) -> None:
        """Without any edit."""
        self._states: list[Edits] = [()]
        self._at = 0

    def copy(self) -> History:
        """The same again, to go back to."""
        made = History()
        made._states, made._at = self._states, self._at
        return made

    @property
    def now(self) -> Edits:
        """The edits that hold."""
        return self._states[self._at]

    @property
    def can_undo(self) -> bool:
        """Whether there is a state before."""
        return self._at > 0

    @property
    def can_redo(self) -> bool:
        """Whether there is a state behind."""
        return self._at + 1 < len(self._states)

    def take(self, edits: Edits) -> None:
        """Take a new state; what was undone is gone."""
        if edits == self.now:
            return
        self._states = [*self._states[: self._at + 1], edits][-_MOST - 1 :]
        self._at = len(self._states) - 1

    def undo(self) -> None:
        """Go back to the state before, if there is one."""
        self._at = max(self._at - 1, 0)

    def redo(self) -> None:
        """Take the state that was undone, if there is one."""
        self._at = min(self._at + 1, len(self._states) - 1)

    def renewed(self, change: Callable[[Edits], Edits]) -> None:
        """Change every state; neighbours that are the same then are one."""
        states: list[Edits] = []
        at = 0
        for k, state in enumerate(map(change, self._states)):
            if not states or state != states[-1]:
                states.append(state)
            if k == self._at:
                at = len(states) - 1
        self._states, self._at = states, at
