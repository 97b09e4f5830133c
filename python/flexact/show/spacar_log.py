# SPDX-License-Identifier: BSD-3-Clause
"""The log of an analysis in the form of SPACAR's, so that old ones can be compared line by line.

The lay-out is that of logs of SPACAR of 14 May 2018; docs/spacar_log.md says which of it is
certain.
"""

from __future__ import annotations

import math
import platform
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby, islice
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..advice.describe import describe, verdict_in_words
from ..analysis.result import Result
from ..core.arrays import FloatArray, IntArray
from ..core.elements import AXES, Class, NodeKind, keywords_of
from ..deck.tokens import Line, Tokens, tokens_of
from ..model.data import ModelData
from ..model.jacobian import jacobian
from ..model.model import Model
from ..model.writing import deck_of, prescribed_in
from ..util.loading import VERSION
from ..util.records import cached_property
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
    words = describe(analysis, most=MOST_MODES)
    return "\n".join((words, *_left_out(analysis, most_in_mesh), "", *_sections(analysis))) + "\n"


def _left_out(analysis: Result, most_in_mesh: int | None) -> Iterator[str]:
    if most_in_mesh is None:
        return
    for count, modes, what in (
        (analysis.under_constrained, analysis.motions, "motions"),
        (analysis.over_constrained, analysis.self_stresses, "self-stresses"),
    ):
        held = min(len(modes), most_in_mesh)
        if held < count:
            yield f"The mesh holds the first {held} of {count} {what}."


def _last(values: FloatArray, count: int) -> list[str]:
    """The last of `count` singular values, behind dashes for those that are not given."""
    return ["-"] * (count - values.size) + [f"{value:.16e}" for value in values.tolist()]


def _sections(analysis: Result) -> Iterator[str]:
    smallest = analysis.singular_values_given == "smallest"
    which = "The smallest singular values" if smallest else "Singular values"
    yield f"{which} of D(c), and of the scaled matrix on which its rank is decided"
    values, scaled_values = analysis.singular_values, analysis.scaled_singular_values
    count = max(values.size, scaled_values.size)
    first = min(analysis.rows, analysis.columns) - count + 1
    pairs = zip(_last(values, count), _last(scaled_values, count), strict=True)
    for number, (value, scaled) in enumerate(pairs, start=first):
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
COORDINATE_ORDER = "ocim"
DEFORMATION_ORDER = "oimc"

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

    @property
    def inputs_first(self) -> IntArray:
        """Indices of the inputs, and behind them of the dynamic ones, by their numbers."""
        found = [np.flatnonzero(self.letter == letter) for letter in "im"]
        return np.concatenate(found).astype(np.int32)


def _numbered(owner: IntArray, part: IntArray, classes: IntArray, order: str) -> Numbered:
    letter = _LETTERS[classes]
    rank = np.array([order.index(each) for each in letter.tolist()], np.int32)
    place = np.argsort(rank, kind="stable")
    number = np.empty(rank.size, np.int32)
    number[place] = np.arange(1, rank.size + 1)
    ends = np.cumsum(np.bincount(rank, minlength=len(order))).tolist()
    return Numbered(owner, part, letter, number, tuple(ends))


class SpacarNumbering:
    """Nodes and elements in ascending order of their numbers, and what they are numbered as.

    An orientation in space has four Euler parameters. The first is always calculable: a further
    element, of one fixed deformation, keeps their norm.

    Attributes:
        data: The model.
        elements: (elements,) indices of the elements, in the order of the log.
        euler_nodes: (euler elements,) indices of the orientations, each with its element
            behind the others.
    """

    def __init__(self, data: ModelData) -> None:
        """Number what a model has."""
        self.data = data
        arrays = data.arrays
        self.elements = np.argsort(arrays.element_number, kind="stable").astype(np.int32)
        self.euler_nodes = np.flatnonzero(arrays.node_kind == NodeKind.ORIENTATION)
        self._prescribed = prescribed_in(data)

    @cached_property
    def coordinates(self) -> Numbered:
        """Coordinates of the nodes in ascending order of node numbers, as the model has them."""
        arrays = self.data.arrays
        size = np.full(max(NodeKind) + 1, _EULER)
        size[list(_COMPONENTS)] = list(_COMPONENTS.values())
        counts = size[arrays.node_kind]
        owner = np.repeat(np.arange(counts.size), counts)
        part = np.arange(owner.size) - np.repeat(np.cumsum(counts) - counts, counts)
        kind = arrays.node_kind[owner]
        axis = part - (kind == NodeKind.ORIENTATION)
        axis[kind == NodeKind.ANGLE] = AXES[NodeKind.ANGLE][0]
        classes = arrays.coordinate_class[axis, owner].copy()
        classes[self._prescribed.coordinates[axis, owner]] = _INPUT
        # lambda0
        classes[axis < 0] = Class.DEPENDENT
        return _numbered(owner.astype(np.int32), part.astype(np.int32), classes, COORDINATE_ORDER)

    @cached_property
    def deformations(self) -> Numbered:
        """Deformations of the elements in the order of the log, those of Euler elements last."""
        classes = self.data.arrays.deformation_class[:, self.elements].copy()
        classes[self._prescribed.deformations[:, self.elements]] = _INPUT
        owner, part = np.nonzero(classes.T)
        euler = np.arange(self.euler_nodes.size)
        return _numbered(
            np.concatenate([owner, self.elements.size + euler]).astype(np.int32),
            np.concatenate([part, np.zeros_like(euler)]).astype(np.int32),
            np.concatenate([classes.T[owner, part], np.full(euler.size, Class.FIXED)]),
            DEFORMATION_ORDER,
        )

    @property
    def freedoms(self) -> int:
        """How many coordinates and deformations are independent, inputs included: NDOF."""
        (_, calculable, _, coordinates) = self.coordinates.ends
        (fixed, _, rows, _) = self.deformations.ends
        return coordinates - calculable + rows - fixed


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


Indices = NDArray[np.int64]

#: Rows and columns beyond which the singular values of a full matrix take too long.
MOST_ROWS = 2000


def condition_number(numbering: SpacarNumbering) -> float | None:
    """The 2-norm condition number of Dcc; None where Dcc is too large.

    Infinite where the smallest singular value is within the rounding of a zero, nan where
    there is no row or no column.
    """
    rows, columns = shape_of(numbering)
    if not rows or not columns:
        return np.nan
    if max(rows, columns) > MOST_ROWS:
        return None
    values = np.linalg.svd(dcc(numbering), compute_uv=False)
    rounding = max(rows, columns) * np.finfo(float).eps * values[0]
    return float(values[0] / values[-1]) if values[-1] > rounding else np.inf


def shape_of(numbering: SpacarNumbering) -> tuple[int, int]:
    """Rows and columns of Dcc: NEM, and NXC - NXO."""
    fixed, calculable, _, _ = numbering.coordinates.ends
    return numbering.deformations.ends[2], calculable - fixed


def dcc(numbering: SpacarNumbering) -> FloatArray:
    """Dcc in full: fixed and independent deformations by calculable coordinates.

    A rotation [rad] about global axes is 2 L(lambda) d lambda. The row of an Euler element
    holds the derivatives of lambda . lambda - 1.
    """
    data = numbering.data
    full = jacobian(Model.from_data(data))
    node_of, axis_of = np.nonzero(data.arrays.coordinate_class.T)
    element_of, part_of = np.nonzero(data.arrays.deformation_class.T)
    place = _Places(numbering)
    row = place.row[element_of, part_of][full.rows]
    node, axis = node_of[full.columns], axis_of[full.columns]
    turned = data.arrays.node_kind[node] == NodeKind.ORIENTATION
    made = np.zeros(shape_of(numbering))
    _add(made, row[~turned], place.column[node, axis][~turned], full.values[~turned])
    euler = _unit(data.arrays.node_value.T)
    rates = _euler_rates(euler)[node[turned], axis[turned]] * full.values[turned, None]
    _add(made, np.repeat(row[turned], 4), place.column[node[turned]].ravel(), rates.ravel())
    nodes = numbering.euler_nodes
    columns, values = place.column[nodes].ravel(), 2.0 * euler[nodes].ravel()
    _add(made, np.repeat(place.euler_row, 4), columns, values)
    return made


class _Places:
    """Row and column of Dcc, from 0, of what is in it; -1 of what is not."""

    def __init__(self, numbering: SpacarNumbering) -> None:
        arrays = numbering.data.arrays
        x, e = numbering.coordinates, numbering.deformations
        self.column = np.full((arrays.node_number.size, 4), -1)
        inside = x.letter == "c"
        part = np.where(arrays.node_kind[x.owner] == NodeKind.ANGLE, 2, x.part)
        self.column[x.owner[inside], part[inside]] = x.number[inside] - 1 - x.ends[0]
        elements = numbering.elements.size
        row = np.full((elements + numbering.euler_nodes.size, 6), -1)
        inside = e.letter != "c"
        row[e.owner[inside], e.part[inside]] = e.number[inside] - 1
        self.euler_row = row[elements:, 0]
        self.row = np.empty((elements, 6), np.int64)
        self.row[numbering.elements] = row[:elements]


def _add(matrix: FloatArray, rows: Indices, columns: Indices, values: FloatArray) -> None:
    inside = (rows >= 0) & (columns >= 0)
    np.add.at(matrix, (rows[inside], columns[inside]), values[inside])


def _unit(value: FloatArray) -> FloatArray:
    """(nodes, 4) Euler parameters of norm 1, in whatever length they were typed."""
    norm = np.linalg.norm(value, axis=1, keepdims=True)
    made: FloatArray = value / np.where(norm > 0.0, norm, 1.0)
    return made


def _euler_rates(euler: FloatArray) -> FloatArray:
    """(nodes, 3, 4) derivatives of rotations about global axes by Euler parameters."""
    s, x, y, z = euler.T
    rates = np.array([[-x, s, -z, y], [-y, z, s, -x], [-z, -y, x, s]])
    made: FloatArray = 2.0 * np.moveaxis(rates, 2, 0)
    return made


_LINE = "=" * 80
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
        tokens = Tokens(deck_of(self.data)) if source is None else tokens_of(source)
        lines = list(tokens)[: -1 if tokens.text.endswith("\n") else None]
        ends = [line.number + 1 for line in lines if line.ends and line.name == "END"]
        first, second = [*ends, len(lines), len(lines)][:2]
        return _echo(lines[:first]), _echo(lines[first:second])

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


def _echo(lines: Iterable[Line]) -> list[str]:
    """Lines as SPACAR shows them: a blank before, blanks for tabs."""
    return [f" {harmless(line.text.rstrip()) or ' '}" for line in lines]


def _sixes(values: FloatArray) -> Iterator[str]:
    """Numbers, six in a line."""
    numbers = iter(values.tolist())
    while line := list(islice(numbers, _IN_A_LINE)):
        yield "".join(f"{number:13.5E}" for number in line)


def _fortran(value: float) -> str:
    """A number as E12.4 of Fortran writes it."""
    digits, exponent = f"{value:.3E}".split("E")
    return f"{'0.' + digits.replace('.', '') + f'E{int(exponent) + 1:+03d}':>12}"
