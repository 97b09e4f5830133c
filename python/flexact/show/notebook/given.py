# SPDX-License-Identifier: BSD-3-Clause
"""Which output of a kernel brings the viewer: the first, and again where that one is gone.

A kernel cannot see a notebook. It knows which cell runs and who asked for it: another notebook on
the same kernel has no viewer yet, and the cell that brought it brings nothing when it has run
again, so that the next output is asked to.
"""

from __future__ import annotations

import contextlib
import sys
from typing import Any

#: Of each that asks (a notebook, a console) the cell whose output brought the viewer.
_given: dict[str, str | None] = {}
#: Shells that tell which cells run.
_told: list[Any] = []


def is_wanted() -> bool:
    """Whether this output is to bring the viewer; whoever asks is thought to show it."""
    if "google.colab" in sys.modules:
        # Each output has a page of its own there.
        return True
    shell = _shell()
    who, cell = _asked_by(shell)
    if who in _given:
        return False
    if shell is not None and shell not in _told:
        shell.events.register("pre_run_cell", _forget)
        _told.append(shell)
    _given[who] = cell
    return True


def begin() -> None:
    """Have the next output bring the viewer."""
    _given.clear()


def _forget(info: Any) -> None:
    """A cell runs, so that its output goes; or the notebook says which cells are deleted."""
    gone = {getattr(info, "cell_id", None), *_deleted(_shell())} - {None}
    for who, cell in list(_given.items()):
        if cell in gone:
            del _given[who]


def _shell() -> Any:
    """The kernel of a notebook, if there is one."""
    module = sys.modules.get("IPython")
    shell = None if module is None else module.get_ipython()
    return shell if hasattr(shell, "get_parent") else None


def _asked_by(shell: Any) -> tuple[str, str | None]:
    """Who asked for what runs, and the cell, as far as they are known."""
    parent = _parent(shell)
    who = parent.get("header", {}).get("session", "")
    return str(who), parent.get("metadata", {}).get("cellId")


def _deleted(shell: Any) -> list[str]:
    return list(_parent(shell).get("metadata", {}).get("deletedCells", ()))


def _parent(shell: Any) -> dict[str, Any]:
    """The message that asked; of an unknown kernel nothing."""
    with contextlib.suppress(Exception):
        return dict(shell.get_parent())
    return {}
