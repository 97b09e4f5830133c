# SPDX-License-Identifier: BSD-3-Clause
"""The log of an analysis in the form of SPACAR's, so that old ones can be compared line by line.

The lay-out is that of logs of SPACAR of 14 May 2018; docs/spacar_log.md says which of it is
certain.
"""

from __future__ import annotations

import platform
from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import NamedTuple

import numpy as np

from ..advice.describe import describe, verdict_in_words
from ..analysis.result import Result
from ..core.arrays import FloatArray, IntArray
from ..core.elements import AXES, Class, NodeKind, keywords_of
from ..deck.tokens import Tokens, tokens_of
from ..model.data import ModelData
from ..model.jacobian import jacobian
from ..model.model import Model
from ..model.writing import deck_of, prescribed_in
from ..util.loading import VERSION
from ..util.text import harmless

#: How many motions, and how many self-stresses, are reported one by one.
MOST_MODES = 1000


def log_text(analysis: Result, *, most_in_mesh: int | None = None) -> str:
    """The words, every singular value, what the rows and columns of D(c) are, and versions.

    Args:
        analysis: The result.
        most_in_mesh: How many motions, and how many self-stresses, a mesh beside the log
            holds at most.
    """
    return "\n".join(_parts(analysis, most_in_mesh)) + "\n"


def _parts(analysis: Result, most_in_mesh: int | None) -> Iterator[str]:
    yield describe(analysis, most=MOST_MODES, verbose=True)
    for count, modes, what in (
        (analysis.under_constrained, analysis.motions, "motions"),
        (analysis.over_constrained, analysis.self_stresses, "self-stresses"),
    ):
        held = count if most_in_mesh is None else min(len(modes), most_in_mesh)
        if held < count:
            yield f"The mesh holds the first {held} of {count} {what}."
    smallest = analysis.singular_values_given == "smallest"
    which = "The smallest singular values" if smallest else "Singular values"
    yield from ("", f"{which} of D(c), and of the scaled matrix on which its rank is decided")
    every = (analysis.singular_values, analysis.scaled_singular_values)
    count = max(values.size for values in every)
    # Behind dashes for those that are not given.
    columns = (
        ["-"] * (count - values.size) + [f"{value:.16e}" for value in values.tolist()]
        for values in every
    )
    first = min(analysis.rows, analysis.columns) - count + 1
    for number, (value, scaled) in enumerate(zip(*columns, strict=True), start=first):
        zero = "  counts as zero" if number > analysis.rank else ""
        yield f"  {number:5d}  {value:>23}  {scaled:>23}{zero}"
    yield f"  tolerance on the scaled values: {analysis.tolerance:.16e}"
    if analysis.method == "sparse":
        yield f"  the factorisation shows the count of those below {analysis.raw.bound:.16e}"
    yield from ("", "Rows of D(c)")
    for number, (element, deformation) in enumerate(analysis.row_labels, start=1):
        yield f"  {number:5d}  element {element}, deformation {deformation}"
    yield from ("", "Columns of D(c)")
    for number, (node, coordinate) in enumerate(analysis.column_labels, start=1):
        yield f"  {number:5d}  node {node}, coordinate {coordinate}"
    yield from ("", "Versions")
    yield f"  flexact {VERSION}, numpy {np.__version__}, Python {platform.python_version()}"


#: Classes in the order in which coordinates are numbered, and likewise deformations: fixed (o),
#: calculable (c), input (mm) and dynamic (m).
_COORDINATE_ORDER, _DEFORMATION_ORDER = "ocim", "oimc"
#: Components of a node of each kind.
_COMPONENTS = {NodeKind.PLANAR_POSITION: 2, NodeKind.POSITION: 3, NodeKind.ANGLE: 1}
_EULER = 4
#: Letters of the classes, by `Class`, with the inputs behind them.
_LETTERS = np.array([" ", "o", "c", "m", "i"])
_INPUT = 4


class Numbered(NamedTuple):
    """Coordinates or deformations, node by node or element by element, as the log lists them.

    Attributes:
        owner: (k,) index of the node in the model, or of the element in the log's list.
        part: (k,) component or deformation, from 0.
        letter: (k,) o, c, m, or i for an input.
        number: (k,) SPACAR's number of each, from 1: class by class.
        ends: The last number of each class, in the order of its numbers: the counts NXO,
            NXC, NXMM, NXM, or NEO, NEMM, NEM, NEC, each of which includes those before.
    """

    owner: IntArray
    part: IntArray
    letter: np.ndarray[tuple[int], np.dtype[np.str_]]
    number: IntArray
    ends: tuple[int, int, int, int]


def _numbered(owner: np.ndarray, part: np.ndarray, classes: IntArray, order: str) -> Numbered:
    letter = _LETTERS[classes]
    rank = np.array([order.index(each) for each in letter.tolist()], np.int32)
    place = np.argsort(rank, kind="stable")
    number = np.empty(rank.size, np.int32)
    number[place] = np.arange(1, rank.size + 1)
    ends = np.cumsum(np.bincount(rank, minlength=len(order))).tolist()
    return Numbered(owner.astype(np.int32), part.astype(np.int32), letter, number, tuple(ends))


class SpacarNumbering:
    """Nodes and elements in ascending order of their numbers, and what they are numbered as.

    An orientation in space has four Euler parameters. The first is always calculable: a further
    element, of one fixed deformation, keeps their norm.

    Attributes:
        data: The model.
        elements: (elements,) indices of the elements, in the order of the log.
        euler_nodes: (euler elements,) indices of the orientations, each with its element
            behind the others.
        coordinates: Those of the nodes, in ascending order of node numbers, as the model has
            them.
        deformations: Those of the elements in the order of the log, of Euler elements last.
        freedoms: How many of both are independent, inputs included: NDOF.
        shape: Rows and columns of Dcc: NEM, and NXC - NXO.
    """

    def __init__(self, data: ModelData) -> None:
        """Number what a model has."""
        self.data = data
        arrays, prescribed = data.arrays, prescribed_in(data)
        self.elements = np.argsort(arrays.element_number, kind="stable").astype(np.int32)
        self.euler_nodes = np.flatnonzero(arrays.node_kind == NodeKind.ORIENTATION)
        size = np.full(max(NodeKind) + 1, _EULER)
        size[list(_COMPONENTS)] = list(_COMPONENTS.values())
        counts = size[arrays.node_kind]
        owner = np.repeat(np.arange(counts.size), counts)
        part = np.arange(owner.size) - np.repeat(np.cumsum(counts) - counts, counts)
        kind = arrays.node_kind[owner]
        axis = part - (kind == NodeKind.ORIENTATION)
        axis[kind == NodeKind.ANGLE] = AXES[NodeKind.ANGLE][0]
        classes = arrays.coordinate_class[axis, owner].copy()
        classes[prescribed.coordinates[axis, owner]] = _INPUT
        # lambda0
        classes[axis < 0] = Class.DEPENDENT
        self.coordinates = _numbered(owner, part, classes, _COORDINATE_ORDER)
        classes = arrays.deformation_class[:, self.elements].copy()
        classes[prescribed.deformations[:, self.elements]] = _INPUT
        owner, part = np.nonzero(classes.T)
        euler = np.arange(self.euler_nodes.size)
        self.deformations = _numbered(
            np.concatenate([owner, self.elements.size + euler]),
            np.concatenate([part, np.zeros_like(euler)]),
            np.concatenate([classes.T[owner, part], np.full(euler.size, Class.FIXED)]),
            _DEFORMATION_ORDER,
        )
        fixed, calculable, _, coordinates = self.coordinates.ends
        held, _, rows, _ = self.deformations.ends
        self.freedoms = coordinates - calculable + rows - held
        self.shape = rows, calculable - fixed


_RULE_OF_ELEMENTS = f"   --- {'-' * 8} {'-' * 23} {'-' * 47} -----"
_RULE_OF_NODES = f"  ---- {'-' * 23} {'-' * 47}"
_RULE_OF_FREEDOMS = "   --- ------ ------ ---------"
#: Nodes and deformations that an element has at most in SPACAR, and beams in a line.
_SLOTS, _DEFORMATIONS, _BEAMS_IN_A_LINE = 6, 8, 18
_LETTER = {"o": "O", "c": "C", "i": "M", "m": "M"}


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
    number = 0
    for numbered, place in ((x, "{:7d}       "), (e, "       {:7d}")):
        for letter, word in (("i", "Input"), ("m", "-Dynamic")):
            for each in numbered.number[numbered.letter == letter].tolist():
                number += 1
                yield f" {number:5d}{place.format(each)} {word:<9}"
    yield _RULE_OF_FREEDOMS


def _rows(numbered: Numbered) -> Iterator[Sequence[str]]:
    """The numbers with their letters, of each node or element in its own row."""
    owners, numbers = numbered.owner.tolist(), numbered.number.tolist()
    letters = numbered.letter.tolist()
    cells = zip(owners, numbers, letters, strict=True)
    for _, row in groupby(cells, key=lambda cell: cell[0]):
        yield [f" {number:3d}-{_LETTER[letter]}" for _, number, letter in row]


#: Rows and columns beyond which the singular values of a full matrix take too long.
MOST_ROWS = 2000


def _condition(numbering: SpacarNumbering) -> str:
    """The 2-norm condition number of Dcc in words."""
    if not min(numbering.shape):
        return "        none"
    if max(numbering.shape) > MOST_ROWS:
        return "  not computed of so large a matrix"
    values = np.linalg.svd(dcc(numbering), compute_uv=False)
    rounding = max(numbering.shape) * np.finfo(float).eps * values[0]
    if not values[-1] > rounding:
        return "    Infinity"
    # As E12.4 of Fortran writes it.
    digits, exponent = f"{values[0] / values[-1]:.3E}".split("E")
    return f"{'0.' + digits.replace('.', '') + f'E{int(exponent) + 1:+03d}':>12}"


def dcc(numbering: SpacarNumbering) -> FloatArray:
    """Dcc in full: fixed and independent deformations by calculable coordinates.

    A rotation [rad] about global axes is 2 L(lambda) d lambda. The row of an Euler element
    holds the derivatives of lambda . lambda - 1.
    """
    data, arrays = numbering.data, numbering.data.arrays
    x, e, nodes = numbering.coordinates, numbering.deformations, numbering.euler_nodes
    # From 0; -1 of what is not in the matrix.
    column = np.full((arrays.node_number.size, 4), -1)
    part = np.where(arrays.node_kind[x.owner] == NodeKind.ANGLE, 2, x.part)
    column[x.owner, part] = np.where(x.letter == "c", x.number - 1 - x.ends[0], -1)
    elements = numbering.elements.size
    owner = np.append(numbering.elements, elements + np.arange(nodes.size))[e.owner]
    row = np.full((elements + nodes.size, 6), -1)
    row[owner, e.part] = np.where(e.letter != "c", e.number - 1, -1)
    full = jacobian(Model.from_data(data))
    node_of, axis_of = np.nonzero(arrays.coordinate_class.T)
    element_of, part_of = np.nonzero(arrays.deformation_class.T)
    place = row[element_of, part_of][full.rows]
    node, axis = node_of[full.columns], axis_of[full.columns]
    turned = arrays.node_kind[node] == NodeKind.ORIENTATION
    # Of norm 1, in whatever length they were typed.
    norm = np.linalg.norm(arrays.node_value.T, axis=1, keepdims=True)
    euler = arrays.node_value.T / np.where(norm > 0.0, norm, 1.0)
    s, i, j, k = euler.T
    rates = 2.0 * np.moveaxis(np.array([[-i, s, -k, j], [-j, k, s, -i], [-k, -j, i, s]]), 2, 0)
    by_euler = rates[node[turned], axis[turned]] * full.values[turned, None]
    made = np.zeros(numbering.shape)
    for rows, columns, values in (
        (place[~turned], column[node, axis][~turned], full.values[~turned]),
        (np.repeat(place[turned], 4), column[node[turned]].ravel(), by_euler.ravel()),
        (np.repeat(row[elements:, 0], 4), column[nodes].ravel(), 2.0 * euler[nodes].ravel()),
    ):
        inside = (rows >= 0) & (columns >= 0)
        np.add.at(made, (rows[inside], columns[inside]), values[inside])
    return made


_LINE = "=" * 80
#: Values in a line.
_IN_A_LINE = 6


def spacar_log(analysis: Result) -> str:
    """The log: echo, elements, nodes, degrees of freedom, counts and the condition of Dcc."""
    return "\n".join(_log(analysis)) + "\n"


def _log(analysis: Result) -> Iterator[str]:
    data = analysis.given
    numbering = SpacarNumbering(data)
    x, e = numbering.coordinates, numbering.deformations
    tokens = Tokens(deck_of(data)) if data.source is None else tokens_of(data.source)
    deck = list(tokens)[: -1 if tokens.text.endswith("\n") else None]
    ends = [line.number + 1 for line in deck if line.ends and line.name == "END"]
    echo = [f" {harmless(line.text.rstrip()) or ' '}" for line in deck]
    # Up to the first END, and from there up to the second.
    first, second = [*ends, len(deck), len(deck)][:2]
    yield f"Flexact {VERSION}: log in the form of SPACAR"
    yield f"Deck: {harmless(analysis.name)}"
    yield from ("", _LINE, " Kinematic data", "", *echo[:first], "")
    rows, columns = numbering.shape
    # What SPACAR says of a system of another number of equations than of unknowns.
    for line in (
        f"Nr of user defined DOFs ({numbering.freedoms:3d}) ",
        f"Nr of nodal coordinates NX ({x.ends[3]:3d}) ",
        f"Nr of prescribed nodal coordinates NXO ({x.ends[0]:3d}) ",
        f"Nr of prescribed deformation coordinates NEO ({e.ends[0]:3d})",
        f"{'Under' if rows < columns else 'Over'}-constraint system configuration: ",
        f"Nr of unknown nodal coordinates NXC-NXO ({columns:3d})",
        f"Nr of equations NEM ({rows:3d})",
    ):
        yield from (line, "") if rows != columns else ()
    yield from _elements(numbering)
    yield from _nodes(numbering)
    yield from _freedoms(numbering)
    yield f" Condition number of Dcc:{_condition(numbering)}"
    value = np.empty(x.number.size)
    value[x.number - 1] = data.arrays.node_value[x.part, x.owner]
    for what, values in (("position", value), ("deformation", np.zeros(e.number.size))):
        yield from ("", f" Zero order transfer function {what} parameters")
        for start in range(0, values.size, _IN_A_LINE):
            yield "".join(f"{each:13.5E}" for each in values[start : start + _IN_A_LINE].tolist())
    yield from (_LINE, " Dynamic data", "", *echo[first:second], "")
    yield " NEO ={:5d}, NEMM ={:5d}, NEM ={:5d}, NEC ={:5d}.".format(*e.ends)
    yield from ("", " NXO ={:5d}, NXC ={:5d}, NXMM ={:5d}, NXM ={:5d}.".format(*x.ends))
    euler = numbering.euler_nodes.size
    yield " WITHOUT EULER ELEMENTS, ACCORDING TO THE GRAPHICAL USER INTERFACE"
    yield (
        f" NX  ={x.ends[3] - euler:5d}, NEO  ={e.ends[0] - euler:5d}, NXO ={x.ends[0]:5d}, "
        f"NDOF={numbering.freedoms:5d}."
    )
    yield _LINE
    yield f" Flexact: {verdict_in_words(analysis).start}"
    words = " Coordinates: {} fixed, {} calculable, {} input, {} dynamic"
    yield words.format(*np.diff((0, *x.ends)))
    words = " Deformations: {} fixed, {} input, {} dynamic, {} calculable"
    yield words.format(*np.diff((0, *e.ends)))
    yield (
        f" Under-constrained by {analysis.under_constrained}, "
        f"over-constrained by {analysis.over_constrained}"
    )
