# SPDX-License-Identifier: BSD-3-Clause
"""Writing an edited deck beside the watched file."""

from __future__ import annotations

import os
import re
from http import HTTPStatus
from pathlib import Path

from ...util.decks import SUFFIX
from ...util.outputs import OutputError, write_together
from ...util.plain_text import harmless
from .refusal import RefusedError

_MOST = 200
#: What no name of a file holds, here or elsewhere.
_NONE = "/\\:"
_EDITED = re.compile(r"_edited(?:_\d+)?$")


def write_deck(watched: Path, name: str, text: bytes, *, over: bool = False) -> Path:
    """Write a deck to a file in the folder of the watched file, whole or not at all.

    Args:
        watched: The file that is watched.
        name: Name of the new file; where it has no suffix, .dat is added.
        text: The deck.
        over: Whether a file of this name may be written over; never the watched one.

    Returns:
        The file.

    Raises:
        RefusedError: There can be no file of this name there, it cannot be written, or (status
            409) there is one already.
    """
    target = watched.parent / _checked(name)
    folder = os.path.realpath(watched.parent)
    if os.path.dirname(os.path.realpath(target)) != folder:
        raise RefusedError(
            f"{target.name} is a link that leads out of the folder: take another name"
        )
    if _is_same(target, watched):
        raise RefusedError(f"{target.name} is the file that is watched: take another name")
    if target.is_dir():
        raise RefusedError(f"{target.name} is a folder: take another name")
    if os.path.lexists(target) and not over:
        raise RefusedError(f"there is a file {target.name} already", HTTPStatus.CONFLICT)
    try:
        write_together({target: text})
    except OutputError as error:
        raise RefusedError(harmless(str(error)), HTTPStatus.INTERNAL_SERVER_ERROR) from None
    return target


def free_name(watched: Path) -> str:
    """A name for the new deck that no file in the folder has, and that `write_deck` takes."""
    stem = "".join("_" if c in _NONE or not c.isprintable() else c for c in watched.stem)
    stem = _EDITED.sub("", stem.strip(". ")) or "deck"
    while len(os.fsencode(stem)) > _MOST - len(f"_edited_999{SUFFIX}"):
        stem = stem[:-1]
    for k in range(1, 1000):
        name = f"{stem}_edited{f'_{k}' * (k > 1)}{SUFFIX}"
        if not os.path.lexists(watched.parent / name):
            return name
    return f"{stem}_edited{SUFFIX}"


def _checked(name: str) -> str:
    """The name of a file, and nothing else."""
    name = name.strip()
    if not name or name.strip(". ") == "":
        raise RefusedError("the new deck needs a name")
    if any(c in name for c in _NONE) or name.startswith(".") or not name.isprintable():
        raise RefusedError(
            "the new deck is written to the folder of the watched file: give the name of a file, "
            "without a folder"
        )
    if not Path(name).suffix:
        name += SUFFIX
    if Path(name).suffix.lower() != SUFFIX:
        raise RefusedError(f"the name of a deck ends with {SUFFIX}")
    if len(os.fsencode(name)) > _MOST:
        raise RefusedError("that name is too long")
    return name


def _is_same(target: Path, watched: Path) -> bool:
    try:
        return os.path.samefile(target, watched)
    except OSError:
        return os.path.realpath(target) == os.path.realpath(watched)
