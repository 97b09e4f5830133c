# SPDX-License-Identifier: BSD-3-Clause
"""The real decks from which the others are made."""

from __future__ import annotations

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
_FOLDERS = ("input_decks", "tests/python/decks")
#: Larger ones take long and show nothing that smaller ones do not.
_MOST_BYTES = 20_000


def seeds() -> tuple[bytes, ...]:
    """All of them, broken ones too, in the order of their paths."""
    paths = sorted(path for folder in _FOLDERS for path in (ROOT / folder).rglob("*.dat"))
    texts = (path.read_bytes() for path in paths)
    return tuple(text for text in texts if len(text) <= _MOST_BYTES)
