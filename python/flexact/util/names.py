# SPDX-License-Identifier: BSD-3-Clause
"""Names that a system or a folder does not take, takes for others, or takes only if told how."""

from __future__ import annotations

import contextlib
import os
import re
import sys
from pathlib import Path

from .loading import load

#: What Windows keeps for devices, whatever stands behind a dot.
_DEVICE = r"(?i)(con|prn|aux|nul|conin\$|conout\$|(com|lpt)[0-9¹²³]) *(\..*)?"
_REFUSED = r'[<>:"|?*\x00-\x1f]'
#: Longer paths must begin as below on Windows, where 260 is the most and a temporary name beside
#: a file has some 50 characters.
_LONG = 200
_AS_IT_IS, _SHARED = "\\\\?\\", "\\\\?\\UNC\\"


def why_unfit(path: Path) -> str:
    """Why a path cannot be one of this system, to stand within a sentence; empty if it can.

    Windows takes some of these names without a word, and writes to a device, or beside the file.
    """
    if sys.platform != "win32":
        return ""
    for name in path.parts:
        if name in (path.anchor, ".", ".."):
            continue
        if found := re.fullmatch(_DEVICE, name):
            return f"Windows keeps the name {found[1]} for a device; take another name"
        if found := re.search(_REFUSED, name):
            return f"no name may hold {found[0]!r} on Windows; take another name"
        if name[-1] in ". ":
            return "no name may end with a dot or a blank on Windows; take another name"
    return ""


def reachable(path: str) -> str:
    """A path as the system wants it; on Windows long ones are told apart from short ones."""
    if sys.platform != "win32" or len(path) < _LONG or path.startswith(_AS_IT_IS):
        return path
    whole = os.path.abspath(path)
    return _SHARED + whole[2:] if whole.startswith("\\\\") else _AS_IT_IS + whole


def folded(path: str) -> str:
    """What is the same for paths that differ in capitals or in how accents are stored alone."""
    if path.isascii():
        return path.lower()
    normal = load("unicodedata").normalize
    flat: str = normal("NFD", normal("NFD", path).casefold())
    return flat


class Owners:
    """Whose a file is, in folders that may take different names for one."""

    def __init__(self) -> None:
        """Nobody has any."""
        self._owners: dict[str, dict[str, str]] = {}

    def add(self, place: str, owner: str) -> None:
        """Give a file to somebody."""
        self._owners.setdefault(folded(place), {})[place] = owner

    def of(self, place: str) -> str | None:
        """Who has a file, if anybody has."""
        owners = self._owners.get(folded(place), {})
        if place in owners:
            return owners[place]
        return next((owner for other, owner in owners.items() if _are_one(other, place)), None)


def _are_one(first: str, second: str) -> bool:
    """Whether paths that differ as `folded` says lead to one file, once it is written."""
    pairs = zip(Path(first).parts, Path(second).parts, strict=False)
    same: list[str] = []
    for one, other in pairs:
        if one != other:
            return _is_blind(Path(*same), one, other)
        same.append(one)
    return True


def _is_blind(folder: Path, first: str, second: str) -> bool:
    """Whether a folder takes two names for one."""
    one, other = folder / first, folder / second
    if os.path.lexists(one) or os.path.lexists(other):
        try:
            return os.path.samefile(one, other)
        except OSError:
            return False
    while not folder.is_dir() and folder != folder.parent:
        folder = folder.parent
    temporary = load("tempfile").TemporaryDirectory
    with contextlib.suppress(OSError), temporary(prefix=".flexact-", dir=folder) as made:
        Path(made, first).touch()
        return os.path.lexists(os.path.join(made, second))
    return sys.platform in ("darwin", "win32")
