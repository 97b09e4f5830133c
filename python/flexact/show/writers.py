# SPDX-License-Identifier: BSD-3-Clause
"""The one registry of files: each suffix with what writes it, what it can show, what it needs.

Whatever can be saved has its `Writers`, with which a writer registers for its suffixes; all of
them are found, refused and written here.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from ..util.errors import BatchError
from ..util.outputs import OutputError, write_together

if TYPE_CHECKING:
    from ..model.data import ModelData

#: Suffixes of pictures: of those that stand still, of videos, of all that move, and of both.
STILLS = (".png", ".svg", ".pdf")
VIDEOS = (".mp4", ".webm")
MOVING = (".gif", *VIDEOS)
PICTURES = (*STILLS, *MOVING)
#: Of pages, of tables, of flexures in tables, of solids that stand still and of all, and of what
#: plays in ParaView.
PAGES = (".html", ".htm")
TABLES = (".csv", ".jsonl", ".parquet")
FLEXURES = (".csv", ".xlsx")
STILL_SOLIDS = (".step", ".stp", ".3mf", ".stl")
SOLIDS = (*STILL_SOLIDS, ".glb")
PLAYING = ".pvd"

#: What a file holds, or each of several files that belong together.
Contents = bytes | Mapping[Path, bytes]
Make = Callable[..., Contents]
Content = TypeVar("Content", bound=Make)


#: What makes the contents of files of a suffix (of what is saved, the path, and what is chosen to
#: be shown), what can be chosen, and what raises where a package for the suffix is missing.
Writer = tuple[Make, tuple[str, ...], Callable[[str], object] | None]


class Writers:
    """The writers of one kind of thing, by suffix."""

    def __init__(self, unknown: Callable[[Path, tuple[str, ...]], Exception]) -> None:
        """None yet; `unknown` is the error of a path with no such suffix, of those there are."""
        self.unknown = unknown
        self._writers: dict[str, Writer] = {}

    @property
    def suffixes(self) -> tuple[str, ...]:
        """All that are registered, in their order."""
        return tuple(self._writers)

    def register(
        self,
        suffixes: Iterable[str],
        *,
        shows: tuple[str, ...] = (),
        require: Callable[[str], object] | None = None,
    ) -> Callable[[Content], Content]:
        """Register what makes the contents of files with some suffixes; see `Writer`."""

        def registered(make: Content) -> Content:
            self._writers.update(dict.fromkeys(suffixes, (make, shows, require)))
            return make

        return registered

    def require(self, path: Path) -> Writer:
        """The writer of a path.

        Raises:
            FlexactError: There is none, or a package is missing.
        """
        suffix = path.suffix.lower()
        if suffix not in self._writers:
            raise self.unknown(path, self.suffixes)
        writer = self._writers[suffix]
        if writer[2] is not None:
            writer[2](suffix)
        return writer

    def contents(self, thing: Any, path: Path, **chosen: Any) -> Contents:
        """What is to be written to a path.

        Raises:
            FlexactError: As of `require`, or something is chosen that the file cannot show.
        """
        make, shows, _ = self.require(path)
        if surplus := [name for name in chosen if name not in shows]:
            raise BatchError(f"{path.name} shows no {' or '.join(surplus)} of its own choice")
        return make(thing, path, **chosen)

    def save(self, thing: Any, deck: ModelData, path: Path, **chosen: Any) -> None:
        """Write it to a path, whole or not at all, but never over its deck.

        Raises:
            FlexactError: As of `contents`, the file is the deck, or cannot be written.
        """
        require_name(path)
        name = deck.name
        is_there = deck.source is not None and name and "\0" not in name and os.path.exists(name)
        if is_there and os.path.realpath(name) == os.path.realpath(path):
            raise OutputError(f"{path} would overwrite the deck")
        write(path, self.contents(thing, path, **chosen))


def require_name(path: Path) -> None:
    """Raise where no file can have this name.

    Raises:
        OutputError: It has a NUL.
    """
    if "\0" in str(path):
        raise OutputError("a file's name cannot hold a NUL")


def write(path: Path, contents: Contents) -> None:
    """Write a file, or files that belong together, all or none.

    Raises:
        OutputError: They cannot be written.
    """
    if isinstance(contents, bytes):
        write_together({path: contents})
        return
    new = {file.parent for file in contents if not file.parent.exists()} - {path.parent}
    try:
        write_together(contents)
    except BaseException:
        for folder in new:
            with contextlib.suppress(OSError):
                folder.rmdir()
        raise


def as_bytes(text: str) -> bytes:
    """A text as a file holds it, whatever characters a deck has brought in."""
    return text.encode("utf-8", "backslashreplace")
