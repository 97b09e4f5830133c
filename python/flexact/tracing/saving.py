# SPDX-License-Identifier: BSD-3-Clause
"""A traced path to a file whose suffix says what it is to be."""

from __future__ import annotations

import os
from pathlib import Path

from ..show.mesh.collection import SUFFIX, write_collection
from ..show.mesh.file import find_format
from ..show.picture.files import STILLS
from ..show.picture.make import check_packages
from ..util.outputs import OutputError, write_together
from .output import plot_bytes
from .playing import Played
from .rows import csv_bytes
from .values import Traced

#: Suffixes of the files.
SUFFIXES = (SUFFIX, ".csv", *STILLS)


def require_suffix(path: Path) -> None:
    """Raise where a path cannot be written to a file of this name.

    Raises:
        FlexactError: Its suffix is none of such a file, or a package is missing.
    """
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES:
        raise OutputError(f"the suffix of {path} is to be .pvd, .csv, .png, .svg or .pdf")
    if suffix == SUFFIX:
        find_format("vtu")
    if suffix in STILLS:
        check_packages()


def save(trace: Traced, path: Path) -> None:
    """Write a path; see `Trace.save`."""
    if "\0" in str(path):
        raise OutputError("a file's name cannot hold a NUL")
    require_suffix(path)
    _refuse_deck(trace, path)
    suffix = path.suffix.lower()
    if suffix == ".csv":
        write_together({path: csv_bytes(trace)})
    elif suffix in STILLS:
        write_together({path: plot_bytes(trace, suffix)})
    else:
        write_collection(Played(trace, path))


def _refuse_deck(trace: Traced, path: Path) -> None:
    deck = trace.result.given.name
    if trace.result.given.source is None or not deck or "\0" in deck:
        return
    if os.path.exists(deck) and os.path.realpath(deck) == os.path.realpath(path):
        raise OutputError(f"{path} would overwrite the deck")
