# SPDX-License-Identifier: BSD-3-Clause
"""Options that mean one thing: one that is given twice, in two ways, is refused."""

from __future__ import annotations

import argparse
from typing import Any


def require_once(
    parser: argparse.ArgumentParser,
    namespace: argparse.Namespace,
    dest: str,
    value: object,
    option: str | None,
) -> None:
    """Note what an option says, and end where it was said otherwise before.

    Args:
        parser: Whose option it is.
        namespace: Of this call; what was given is kept there.
        dest: What the option sets, under whatever name it is called.
        value: What it says.
        option: The name by which it was called; None of an argument without a name.
    """
    if option is None:
        return
    given: dict[str, tuple[object, str]] = namespace.__dict__.setdefault("given", {})
    before, name = given.setdefault(dest, (value, option))
    if before != value:
        if name == option:
            parser.error(f"{option} is given twice, and not alike: give it once")
        parser.error(f"{name} and {option} contradict each other: choose one")


class Store(argparse._StoreAction):
    """Stores a value, once."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        """Store it."""
        require_once(parser, namespace, self.dest, values, option_string)
        super().__call__(parser, namespace, values, option_string)


class OnOff(argparse.BooleanOptionalAction):
    """Stores whether something is wanted, once."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        """Store it."""
        is_on = not (option_string or "").startswith("--no-")
        require_once(parser, namespace, self.dest, is_on, option_string)
        super().__call__(parser, namespace, values, option_string)
