# SPDX-License-Identifier: BSD-3-Clause
"""Options that had another name once: the old one still works, and says which is the new one."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from typing import Any

from .once import require_once
from .terminal import complain


def add_renamed(
    parser: argparse.ArgumentParser,
    old: str,
    new: str,
    *,
    dest: str,
    kind: Callable[[str], Any] = str,
    choices: Sequence[str] | None = None,
) -> None:
    """Let an option be called by its old name, which help and completion leave out."""
    # Without a default of its own that of the new name stays.
    parser.add_argument(
        old,
        action=_Renamed,
        const=new,
        dest=dest,
        type=str if kind is None else kind,
        choices=choices,
        default=argparse.SUPPRESS,
        help=argparse.SUPPRESS,
    )


class _Renamed(argparse.Action):
    """Stores as the new name does, and says so."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        complain(f"warning: {option_string} is now called {self.const}")
        require_once(parser, namespace, self.dest, values, option_string)
        setattr(namespace, self.dest, values)
