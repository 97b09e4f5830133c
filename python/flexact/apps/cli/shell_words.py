# SPDX-License-Identifier: BSD-3-Clause
"""The words that a shell can complete, as values."""

from __future__ import annotations

from typing import NamedTuple


class OptionWords(NamedTuple):
    """An option."""

    names: tuple[str, ...]
    """Such as -o and --output."""
    about: str
    """What help says of it."""
    has_value: bool
    choices: tuple[str, ...]
    """Values that it may have; empty where there are no few."""
    kind: str
    """Of its value: file, folder, deck, or nothing."""
    value: str
    """What help calls its value."""


class VerbWords(NamedTuple):
    """A verb."""

    name: str
    about: str
    options: tuple[OptionWords, ...]
    choices: tuple[str, ...]
    """What its argument may be; empty where there are no few."""
    kind: str
    """Of its arguments, as of an option's value."""

    @property
    def names(self) -> tuple[str, ...]:
        """The names of all options."""
        return tuple(name for option in self.options for name in option.names)
