# SPDX-License-Identifier: BSD-3-Clause
"""A deck's text as bytes: its lines, and from byte places to characters."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..util.cached import cached_property

_LINE_FEED = 10


def decode(raw: bytes) -> str:
    """Text of some bytes: UTF-8 where they are, else the old Windows code page."""
    return raw.decode(_codec(raw), "replace")


def _codec(raw: bytes) -> str:
    try:
        raw.decode("utf-8")
    except UnicodeDecodeError:
        return "cp1252"
    return "utf-8"


@dataclass(frozen=True, eq=False)
class Source:
    """The text of a deck and the name it goes by.

    Attributes:
        text: The bytes as the core saw them.
        name: Path, or another name, for `name:line:column`.
    """

    text: bytes
    name: str

    @cached_property
    def _breaks(self) -> NDArray[np.intp]:
        return np.flatnonzero(np.frombuffer(self.text, np.int8) == _LINE_FEED)

    def line(self, number: int) -> bytes:
        """Bytes of line 1, 2, ..., without its end; empty where there is no such line."""
        if not 1 <= number <= self._breaks.size + 1:
            return b""
        first = int(self._breaks[number - 2]) + 1 if number > 1 else 0
        last = int(self._breaks[number - 1]) if number <= self._breaks.size else len(self.text)
        return self.text[first:last].rstrip(b"\r")

    def character_columns(self, line: int, first: int, last: int) -> tuple[int, int]:
        """First and last character (from 1) of the bytes `first` to `last` of a line."""
        raw = self.line(line)
        if raw.isascii():
            return first, max(first, last)
        codec = _codec(raw)
        start = len(raw[: first - 1].decode(codec, "replace")) + 1
        return start, max(start, len(raw[:last].decode(codec, "replace")))
