# SPDX-License-Identifier: BSD-3-Clause
"""The cost of a design to a file whose suffix says what it is to be."""

from __future__ import annotations

import os
from pathlib import Path

from ..show.picture.make import check_packages
from ..util.loading import load
from ..util.outputs import OutputError, write_together
from .designs import CostValues
from .json import csv_text, text_of

#: Suffixes of pictures, of pages, and of all files.
PICTURES, PAGES = (".png", ".svg", ".pdf"), (".html", ".htm")
SUFFIXES = (*PICTURES, *PAGES, ".csv", ".json")


def require_suffix(path: Path) -> None:
    """Raise where a cost cannot be written to a file of this name.

    Raises:
        FlexactError: Its suffix is none of such a file, or a package is missing.
    """
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES:
        raise OutputError(f"the suffix of {path} is to be one of {', '.join(SUFFIXES)}")
    if suffix in PICTURES:
        check_packages()


def save(cost: CostValues, path: Path) -> None:
    """Write a cost; see `Cost.save`."""
    if "\0" in str(path):
        raise OutputError("a file's name cannot hold a NUL")
    require_suffix(path)
    deck = cost.data.name
    is_deck = cost.data.source is not None and deck and "\0" not in deck and os.path.exists(deck)
    if is_deck and os.path.realpath(deck) == os.path.realpath(path):
        raise OutputError(f"{path} would overwrite the deck")
    write_together({path: content_of(cost, path.suffix.lower())})


def content_of(cost: CostValues, suffix: str) -> bytes:
    """What a file of a suffix holds."""
    if suffix == ".csv":
        return csv_text(cost).encode("utf-8", "backslashreplace")
    if suffix == ".json":
        return f"{text_of(cost)}\n".encode()
    # Pictures and pages take a while to load.
    made: bytes
    if suffix in PAGES:
        made = load("flexact.costs.page").page_bytes(cost)
    else:
        made = load("flexact.costs.plot").plot_bytes(cost, suffix)
    return made
