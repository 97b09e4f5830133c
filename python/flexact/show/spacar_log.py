# SPDX-License-Identifier: BSD-3-Clause
"""The log of an analysis in the form of SPACAR's, so that old ones can be compared line by line.

The lay-out is that of logs of SPACAR of 14 May 2018; docs/spacar_log.md says which of it is
certain.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator
from itertools import islice

import numpy as np

from ..advice.describe import verdict_in_words
from ..analysis.result import Result
from ..core.arrays import FloatArray
from ..deck.source import decode
from ..model.writing import deck_of
from ..util.plain_text import harmless
from ..util.version import VERSION
from .spacar_matrix import condition_number, shape_of
from .spacar_numbering import SpacarNumbering
from .spacar_tables import tables

_LINE = "=" * 80
_END = re.compile(r"\s*END(?:[\s%#]|$)", re.IGNORECASE)
#: Values in a line.
_IN_A_LINE = 6


def spacar_log(analysis: Result) -> str:
    """The log: echo, elements, nodes, degrees of freedom, counts and the condition of Dcc."""
    lines = _Log(analysis).lines()
    return "\n".join(lines) + "\n"


class _Log:
    """The parts of a log."""

    def __init__(self, analysis: Result) -> None:
        self.analysis = analysis
        self.data = analysis.given
        self.numbering = SpacarNumbering(self.data)

    def lines(self) -> Iterator[str]:
        """All of its lines."""
        kinematics, dynamics = self._echoes()
        yield f"Flexact {VERSION}: log in the form of SPACAR"
        yield f"Deck: {harmless(self.analysis.name)}"
        yield from ("", _LINE, " Kinematic data", "", *kinematics, "")
        yield from self._not_square()
        yield from tables(self.numbering)
        yield self._condition()
        yield from self._values()
        yield from (_LINE, " Dynamic data", "", *dynamics, "")
        yield from self._counts()
        yield _LINE
        yield from self._verdict()

    def _echoes(self) -> tuple[list[str], list[str]]:
        """The deck up to its first END, and from there up to the second."""
        source = self.data.source
        text = deck_of(self.data) if source is None else decode(source.text)
        lines = iter(text.replace("\r\n", "\n").removesuffix("\n").split("\n"))
        return list(_block(lines)), list(_block(lines))

    def _not_square(self) -> Iterator[str]:
        """What SPACAR says of a system of another number of equations than of unknowns."""
        rows, columns = shape_of(self.numbering)
        if rows == columns:
            return
        x, e = self.numbering.coordinates.ends, self.numbering.deformations.ends
        word = "Under" if rows < columns else "Over"
        for line in (
            f"Nr of user defined DOFs ({self.numbering.freedoms:3d}) ",
            f"Nr of nodal coordinates NX ({x[3]:3d}) ",
            f"Nr of prescribed nodal coordinates NXO ({x[0]:3d}) ",
            f"Nr of prescribed deformation coordinates NEO ({e[0]:3d})",
            f"{word}-constraint system configuration: ",
            f"Nr of unknown nodal coordinates NXC-NXO ({columns:3d})",
            f"Nr of equations NEM ({rows:3d})",
        ):
            yield from (line, "")

    def _condition(self) -> str:
        words = " Condition number of Dcc:"
        condition = condition_number(self.numbering)
        if condition is None:
            return f"{words}  not computed of so large a matrix"
        if math.isinf(condition):
            return f"{words}    Infinity"
        return f"{words}        none" if math.isnan(condition) else words + _fortran(condition)

    def _values(self) -> Iterator[str]:
        """All coordinates and deformations in the order of their numbers."""
        x = self.numbering.coordinates
        value = np.empty(x.number.size)
        value[x.number - 1] = self.data.arrays.node_value[x.part, x.owner]
        yield from ("", " Zero order transfer function position parameters", *_sixes(value))
        zeros = np.zeros(self.numbering.deformations.number.size)
        yield from ("", " Zero order transfer function deformation parameters", *_sixes(zeros))

    def _counts(self) -> Iterator[str]:
        x, e = self.numbering.coordinates.ends, self.numbering.deformations.ends
        names = ("NEO", "NEMM", "NEM", "NEC"), ("NXO", "NXC", "NXMM", "NXM")
        for words, ends in zip(names, (e, x), strict=True):
            pairs = zip(words, ends, strict=True)
            yield f" {', '.join(f'{word} ={end:5d}' for word, end in pairs)}."
            yield from ("",) if ends is e else ()
        euler = self.numbering.euler_nodes.size
        yield " WITHOUT EULER ELEMENTS, ACCORDING TO THE GRAPHICAL USER INTERFACE"
        yield (
            f" NX  ={x[3] - euler:5d}, NEO  ={e[0] - euler:5d}, NXO ={x[0]:5d}, "
            f"NDOF={self.numbering.freedoms:5d}."
        )

    def _verdict(self) -> Iterator[str]:
        analysis = self.analysis
        x, e = np.diff((0, *self.numbering.coordinates.ends)), self.numbering.deformations.ends
        yield f" Flexact: {verdict_in_words(analysis).start}"
        yield " Coordinates: {} fixed, {} calculable, {} input, {} dynamic".format(*x)
        yield " Deformations: {} fixed, {} input, {} dynamic, {} calculable".format(
            *np.diff((0, *e))
        )
        yield (
            f" Under-constrained by {analysis.under_constrained}, "
            f"over-constrained by {analysis.over_constrained}"
        )


def _block(lines: Iterable[str]) -> Iterator[str]:
    """Lines of a block up to its END as SPACAR shows them: a blank before, blanks for tabs."""
    for line in lines:
        yield f" {harmless(line.rstrip()) or ' '}"
        if _END.match(line):
            return


def _sixes(values: FloatArray) -> Iterator[str]:
    """Numbers, six in a line."""
    numbers = iter(values.tolist())
    while line := list(islice(numbers, _IN_A_LINE)):
        yield "".join(f"{number:13.5E}" for number in line)


def _fortran(value: float) -> str:
    """A number as E12.4 of Fortran writes it."""
    digits, exponent = f"{value:.3E}".split("E")
    return f"{'0.' + digits.replace('.', '') + f'E{int(exponent) + 1:+03d}':>12}"
