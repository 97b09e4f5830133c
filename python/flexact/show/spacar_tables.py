# SPDX-License-Identifier: BSD-3-Clause
"""The tables of a log of SPACAR: elements, nodes and degrees of freedom."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

import numpy as np

from ..core.elements import keywords_of
from .spacar_numbering import Numbered, SpacarNumbering

_RULE_OF_ELEMENTS = f"   --- {'-' * 8} {'-' * 23} {'-' * 47} -----"
_RULE_OF_NODES = f"  ---- {'-' * 23} {'-' * 47}"
_RULE_OF_FREEDOMS = "   --- ------ ------ ---------"
#: Nodes and deformations that an element has at most in SPACAR, and beams in a line.
_SLOTS, _DEFORMATIONS, _BEAMS_IN_A_LINE = 6, 8, 18
_LETTER = {"o": "O", "c": "C", "i": "M", "m": "M"}


def tables(numbering: SpacarNumbering) -> Iterator[str]:
    """The lines of all three, as wide as SPACAR's for numbers of three digits."""
    yield from _elements(numbering)
    yield from _nodes(numbering)
    yield from _freedoms(numbering)


def _elements(numbering: SpacarNumbering) -> Iterator[str]:
    yield " Elements used in this model:"
    yield (
        "    No  Type         Element nodes          "
        "Deformation parameters (with type)    Max.def.par."
    )
    yield _RULE_OF_ELEMENTS
    rows = _rows(numbering.deformations)
    for (number, word, nodes), row in zip(_members(numbering), rows, strict=True):
        places = "".join(f" {node:3d}" for node in nodes).ljust(4 * _SLOTS)
        cells = "".join(row).ljust(6 * _DEFORMATIONS)
        yield f" {number:5d} {word:<8}{places}{cells}{len(row):6d}"
    yield from (_RULE_OF_ELEMENTS, "")
    beams = [number for number, word, _ in _members(numbering) if word == "Beam"]
    if beams:
        # A long line is broken, which SPACAR was not seen to do.
        head = " Bending-linked elongation calculated for beam(s):"
        for first in range(0, len(beams), _BEAMS_IN_A_LINE):
            line = beams[first : first + _BEAMS_IN_A_LINE]
            yield head + "".join(f" {number:3d}" for number in line)
            head = " " * len(head)
        yield ""


def _members(numbering: SpacarNumbering) -> Iterator[tuple[int, str, list[int]]]:
    """Number, type and nodes of each element, those of Euler elements last."""
    arrays, order = numbering.data.arrays, numbering.elements
    numbers = arrays.element_number[order]
    node_number = np.concatenate([[0], arrays.node_number])
    nodes = node_number[arrays.element_node[:, order]].T.tolist()
    words = keywords_of(arrays.element_kind[order])
    for number, word, row in zip(numbers.tolist(), words, nodes, strict=True):
        yield number, word.capitalize(), [node for node in row if node]
    orientations = arrays.node_number[numbering.euler_nodes].tolist()
    for number, node in enumerate(orientations, start=int(numbers.max()) + 1):
        yield number, "Euler", [node]


def _nodes(numbering: SpacarNumbering) -> Iterator[str]:
    yield " Nodal point information"
    yield "  Node   Pos.pars (with type)    Values"
    yield _RULE_OF_NODES
    arrays = numbering.data.arrays
    values = arrays.node_value.T.tolist()
    rows = _rows(numbering.coordinates)
    for number, value, row in zip(arrays.node_number.tolist(), values, rows, strict=True):
        numbers = "".join(f"{each:12.5f}" for each in value[: len(row)])
        yield f" {number:5d}{''.join(row):<24}{numbers:<48}"
    yield from (_RULE_OF_NODES, "")


def _freedoms(numbering: SpacarNumbering) -> Iterator[str]:
    yield " Degree of freedom information:"
    yield "   DOF PosPar DefPar Type     "
    yield _RULE_OF_FREEDOMS
    x, e = numbering.coordinates, numbering.deformations
    of_nodes = [(f"{x.number[i]:7d}{'':7}", x.letter[i]) for i in x.inputs_first]
    of_elements = [(f"{'':7}{e.number[i]:7d}", e.letter[i]) for i in e.inputs_first]
    for number, (place, letter) in enumerate(of_nodes + of_elements, start=1):
        word = "Input" if letter == "i" else "-Dynamic"
        yield f" {number:5d}{place} {word:<9}"
    yield _RULE_OF_FREEDOMS


def _rows(numbered: Numbered) -> Iterator[Sequence[str]]:
    """The numbers with their letters, of each node or element in its own row."""
    owners, numbers = numbered.owner.tolist(), numbered.number.tolist()
    letters = numbered.letter.tolist()
    cells = zip(owners, numbers, letters, strict=True)
    for _, row in groupby(cells, key=lambda cell: cell[0]):
        yield [f" {number:3d}-{_LETTER[letter]}" for _, number, letter in row]
