# SPDX-License-Identifier: BSD-3-Clause
"""The log of an analysis in the form of SPACAR's, so that old ones can be compared line by line.

The lay-out is that of logs of SPACAR of 14 May 2018; docs/spacar_log.md says which of it is
certain.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby, islice

import numpy as np

from ..base.plain_text import harmless
from ..base.version import VERSION
from ..core.arrays import FloatArray
from ..core.elements import keywords_of
from ..diagnostics.source import decode
from ..model.deck_text import deck_of
from ..result.result import Result
from .describe import verdict_in_words
from .spacar_matrix import condition_number, shape_of
from .spacar_numbering import Numbered, SpacarNumbering

_LINE = "=" * 80
_END = re.compile(r"\s*END(?:[\s%#]|$)", re.IGNORECASE)
_RULE_OF_ELEMENTS = f"   --- {'-' * 8} {'-' * 23} {'-' * 47} -----"
_RULE_OF_NODES = f"  ---- {'-' * 23} {'-' * 47}"
_RULE_OF_FREEDOMS = "   --- ------ ------ ---------"
#: Nodes and deformations that an element has at most in SPACAR, values in a line, and beams.
_SLOTS, _DEFORMATIONS, _IN_A_LINE, _BEAMS_IN_A_LINE = 6, 8, 6, 18
_LETTER = {"o": "O", "c": "C", "i": "M", "m": "M"}


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
        yield from self._elements()
        yield from self._nodes()
        yield from self._freedoms()
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

    def _elements(self) -> Iterator[str]:
        yield " Elements used in this model:"
        yield (
            "    No  Type         Element nodes          "
            "Deformation parameters (with type)    Max.def.par."
        )
        yield _RULE_OF_ELEMENTS
        rows = _rows(self.numbering.deformations)
        for (number, word, nodes), row in zip(self._members(), rows, strict=True):
            places = "".join(f" {node:3d}" for node in nodes).ljust(4 * _SLOTS)
            cells = "".join(row).ljust(6 * _DEFORMATIONS)
            yield f" {number:5d} {word:<8}{places}{cells}{len(row):6d}"
        yield from (_RULE_OF_ELEMENTS, "")
        beams = [number for number, word, _ in self._members() if word == "Beam"]
        if beams:
            # A long line is broken, which SPACAR was not seen to do.
            head = " Bending-linked elongation calculated for beam(s):"
            for first in range(0, len(beams), _BEAMS_IN_A_LINE):
                line = beams[first : first + _BEAMS_IN_A_LINE]
                yield head + "".join(f" {number:3d}" for number in line)
                head = " " * len(head)
            yield ""

    def _members(self) -> Iterator[tuple[int, str, list[int]]]:
        """Number, type and nodes of each element, those of Euler elements last."""
        arrays, order = self.data.arrays, self.numbering.elements
        numbers = arrays.element_number[order]
        node_number = np.concatenate([[0], arrays.node_number])
        nodes = node_number[arrays.element_node[:, order]].T.tolist()
        words = keywords_of(arrays.element_kind[order])
        for number, word, row in zip(numbers.tolist(), words, nodes, strict=True):
            yield number, word.capitalize(), [node for node in row if node]
        orientations = arrays.node_number[self.numbering.euler_nodes].tolist()
        for number, node in enumerate(orientations, start=int(numbers.max()) + 1):
            yield number, "Euler", [node]

    def _nodes(self) -> Iterator[str]:
        yield " Nodal point information"
        yield "  Node   Pos.pars (with type)    Values"
        yield _RULE_OF_NODES
        arrays = self.data.arrays
        values = arrays.node_value.T.tolist()
        rows = _rows(self.numbering.coordinates)
        for number, value, row in zip(arrays.node_number.tolist(), values, rows, strict=True):
            numbers = "".join(f"{each:12.5f}" for each in value[: len(row)])
            yield f" {number:5d}{''.join(row):<24}{numbers:<48}"
        yield from (_RULE_OF_NODES, "")

    def _freedoms(self) -> Iterator[str]:
        yield " Degree of freedom information:"
        yield "   DOF PosPar DefPar Type     "
        yield _RULE_OF_FREEDOMS
        x, e = self.numbering.coordinates, self.numbering.deformations
        of_nodes = [(f"{x.number[i]:7d}{'':7}", x.letter[i]) for i in x.inputs_first]
        of_elements = [(f"{'':7}{e.number[i]:7d}", e.letter[i]) for i in e.inputs_first]
        for number, (place, letter) in enumerate(of_nodes + of_elements, start=1):
            word = "Input" if letter == "i" else "-Dynamic"
            yield f" {number:5d}{place} {word:<9}"
        yield _RULE_OF_FREEDOMS

    def _condition(self) -> str:
        analysis = self.analysis
        words = " Condition number of Dcc:"
        if analysis.rank < min(analysis.rows, analysis.columns):
            return f"{words}    Infinity"
        condition = condition_number(self.numbering)
        if condition is None:
            return f"{words}  not computed of so large a matrix"
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
            f" D(c) without Euler parameters: {analysis.rows} x {analysis.columns}, "
            f"rank {analysis.rank}; under-constrained {analysis.under_constrained}, "
            f"over-constrained {analysis.over_constrained}"
        )


def _block(lines: Iterable[str]) -> Iterator[str]:
    """Lines of a block up to its END as SPACAR shows them: a blank before, blanks for tabs."""
    for line in lines:
        yield f" {harmless(line.rstrip()) or ' '}"
        if _END.match(line):
            return


def _rows(numbered: Numbered) -> Iterator[Sequence[str]]:
    """The numbers with their letters, of each node or element in its own row."""
    owners, numbers = numbered.owner.tolist(), numbered.number.tolist()
    letters = numbered.letter.tolist()
    cells = zip(owners, numbers, letters, strict=True)
    for _, row in groupby(cells, key=lambda cell: cell[0]):
        yield [f" {number:3d}-{_LETTER[letter]}" for _, number, letter in row]


def _sixes(values: FloatArray) -> Iterator[str]:
    """Numbers, six in a line."""
    numbers = iter(values.tolist())
    while line := list(islice(numbers, _IN_A_LINE)):
        yield "".join(f"{number:13.5E}" for number in line)


def _fortran(value: float) -> str:
    """A number as E12.4 of Fortran writes it."""
    digits, exponent = f"{value:.3E}".split("E")
    return f"{'0.' + digits.replace('.', '') + f'E{int(exponent) + 1:+03d}':>12}"
