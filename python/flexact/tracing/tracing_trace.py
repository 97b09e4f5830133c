# SPDX-License-Identifier: BSD-3-Clause
"""A traced path as users know it: with its words and its files."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from .saving import save
from .values import Traced
from .words import lines


@dataclass(frozen=True, eq=False, repr=False)
class Trace(Traced):
    """The path of a motion, or of a declared degree of freedom, with words and files of it."""

    def describe(self) -> str:
        """How far it goes each way, what stops it, its dead points and verdicts, in words."""
        return "\n".join(lines(self))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write it to a file, whole or not at all.

        Args:
            path: Its suffix says what it is to be: .csv, a row a step; a picture (.png, .svg, .pdf)
                of singular values and coordinates along the path; .pvd, a cycle that plays in
                ParaView.

        Raises:
            FlexactError: There is no such kind of file, a package is missing, or the file cannot
                be written.
        """
        save(self, Path(path))
