# SPDX-License-Identifier: BSD-3-Clause
"""Sheets and wires that are divided: beams in a row, joined at nodes that join nothing else."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from ...core.arrays import BoolArray, FloatArray, IntArray, ModelArrays
from ...core.elements import Class, Member, member_table, role_table
from ..names import part_name
from .forms import PLANAR, XY, XZ, Form, forms_of

#: Cosine of the largest angle between neighbours in a row; between those of one name.
_IN_ROW = 0.7071
_OF_ONE_NAME = 0.2588
#: Rounding of a cosine, with room; and what is clearly more.
_SLACK, _CLEAR = 1e-9, 1e-6
#: A row whose ends are nearer to each other than this part of its length is no sheet.
_STRAIGHTNESS = 0.5
#: Deformation at the other end of a beam, by deformation, both from 0.
_OTHER_END = {2: 3, 3: 2, 4: 5, 5: 4}
_OTHER_END_IN_PLANE = {1: 2, 2: 1}


class Chain(NamedTuple):
    """Beams in a row.

    Attributes:
        elements: Indices of the beams, from end to end.
        reversed: Of each whether it runs against the row.
        positions: Indices of the position nodes, one more than beams.
        orientations: Indices of the orientation nodes, likewise.
        classes: (beams, 6) class of each deformation in the sense of the row.
    """

    elements: tuple[int, ...]
    reversed: tuple[bool, ...]
    positions: tuple[int, ...]
    orientations: tuple[int, ...]
    classes: tuple[tuple[int, ...], ...]

    @property
    def ends(self) -> tuple[int, int, int, int]:
        """Indices of the nodes p, op, q, oq of the one beam that the row may be."""
        p, q = self.positions[0], self.positions[-1]
        return p, self.orientations[0], q, self.orientations[-1]

    @property
    def condensed_classes(self) -> tuple[int, ...] | None:
        """(6,) classes of the one beam that the row is; None where it is not declared as one.

        Each deformation must be released in one beam at most, and the hinges that are released
        be those of one beam: then the others follow from what they hold or declare, and D(c) has
        the rank of that of one beam.
        """
        made: list[int] = []
        for classes in zip(*self.classes, strict=True):
            released = classes.count(Class.DEPENDENT)
            rest = {each for each in classes if each != Class.DEPENDENT}
            if released > 1 or len(rest) > 1:
                return None
            made.append(int(Class.DEPENDENT) if released else classes[0])
        pairs = ((1, 2),) if self.is_planar else ((2, 3), (4, 5))
        return tuple(made) if all(self._hinges_fit(*pair) for pair in pairs) else None

    def _hinges_fit(self, p: int, q: int) -> bool:
        """Whether the bendings about one axis, from 0, release what one beam can release.

        At p it is a hinge where its beam begins, at q one where it ends. Two make a beam
        wherever they are, but at one place they are one hinge and an idle node; a single one
        is at the end of the row or inside it.
        """
        at_p, at_q = (
            [k + end for k, classes in enumerate(self.classes) if classes[d] == Class.DEPENDENT]
            for d, end in ((p, 0), (q, 1))
        )
        if at_p and at_q:
            return at_p != at_q
        return at_p in ([], [0]) and at_q in ([], [len(self.classes)])

    @property
    def surplus(self) -> tuple[tuple[int, tuple[int, ...]], ...]:
        """Element and the deformations (from 1) to be declared so that the row is one beam.

        Of each deformation that several beams release, that of the first stays released.
        """
        made = []
        for place, element in enumerate(self.elements):
            before = self.classes[:place]
            mine = [
                d
                for d in range(6)
                if self.classes[place][d] == Class.DEPENDENT
                and any(classes[d] == Class.DEPENDENT for classes in before)
            ]
            if mine:
                made.append((element, tuple(sorted(self.own(place, d + 1) for d in mine))))
        return tuple(made)

    @property
    def is_planar(self) -> bool:
        """Whether its beams are planar."""
        return self.classes[0][3] == Class.NONE

    def own(self, beam: int, deformation: int) -> int:
        """What a deformation in the sense of the row is to one of its beams, both from 1."""
        if not self.reversed[beam]:
            return deformation
        swap = _OTHER_END_IN_PLANE if self.is_planar else _OTHER_END
        return swap.get(deformation - 1, deformation - 1) + 1


def chains_of(
    arrays: ModelArrays, names: Sequence[str], frames: Callable[[], FloatArray]
) -> tuple[Chain, ...]:
    """Rows of at least two beams that a designer takes for one sheet or wire.

    Neighbours are alone with each other at a node of which nothing is fixed or declared, bend
    in the same way about the same axes, and lie nearly in line; those with different names do
    not belong together. `frames` gives those of the elements, (elements, 3, 3).
    """
    next_of: dict[tuple[int, int], tuple[int, int]] = {}
    beams, ends = _joined(arrays, _is_beam(arrays))
    if not len(beams):
        return ()
    likely = _nearly_in_line(arrays, beams, ends)
    if not likely.any():
        return ()
    likely &= _is_bendable(arrays)[beams].all(axis=1)
    for one, other in _as_pairs(beams[likely], ends[likely]):
        if _go_on(arrays, names, frames, one, other):
            next_of[one], next_of[other] = other, one
    made: list[Chain] = []
    seen: set[int] = set()
    for start in sorted({beam for beam, _ in next_of}):
        if start in seen:
            continue
        # From that end whose beam comes first.
        row = _followed(next_of, start)
        seen.update(beam for beam, _ in row)
        if row[0][0] > row[-1][0]:
            row = [(beam, not turned) for beam, turned in reversed(row)]
        chain = _row(arrays, row)
        # Its ends turn apart: no beam has one node at both ends.
        if chain.orientations[0] != chain.orientations[-1] and _is_stretched(arrays, chain):
            made.append(chain)
    return tuple(made)


def _is_stretched(arrays: ModelArrays, row: Chain) -> bool:
    return bool(stretch_of(arrays.node_value[:3, list(row.positions)].T) > 0.0)


def stretch_of(place: FloatArray) -> FloatArray:
    """(...,) by how much the ends of rows are farther apart than those of no sheet, in lengths.

    Args:
        place: (..., nodes of a row, 3).
    """
    arc = np.linalg.norm(np.diff(place, axis=-2), axis=-1).sum(axis=-1)
    ends = np.linalg.norm(place[..., -1, :] - place[..., 0, :], axis=-1)
    return np.asarray(ends - _STRAIGHTNESS * arc)


def perhaps_condensed(arrays: ModelArrays, names: Sequence[str], classes: IntArray) -> BoolArray:
    """Whether with these classes there may be a row that counts as one beam in some geometry.

    Two neighbours in such a row release no deformation both.

    Args:
        arrays: The model.
        names: Of its elements.
        classes: (variants, elements, 6) of deformations in place of the model's.

    Returns:
        (variants,)
    """
    found = np.zeros(len(classes), np.bool_)
    for (i, at_i), (j, at_j) in _as_pairs(*_joined(arrays, _is_beam(arrays))):
        if arrays.element_kind[i] != arrays.element_kind[j] or not _may_be_one_part(names, i, j):
            continue
        swap = _OTHER_END if arrays.deformation_class[3, i] else _OTHER_END_IN_PLANE
        turned = [swap.get(d, d) for d in range(6)]
        first = classes[:, i, turned] if at_i == 0 else classes[:, i]
        second = classes[:, j, turned] if at_j == 1 else classes[:, j]
        both = (first == Class.DEPENDENT) & (second == Class.DEPENDENT)
        found |= ~both.any(axis=1)
    return found


def _may_be_one_part(names: Sequence[str], i: int, j: int) -> bool:
    """Whether the names of two elements allow that they are one part."""
    mine, other = part_name(names[i]), part_name(names[j])
    return not mine or not other or mine == other


def _joined(arrays: ModelArrays, beams: BoolArray) -> tuple[IntArray, IntArray]:
    """Beams and ends (0 at p, 1 at q), (pairs, 2), of two that are alone at a free node."""
    a = arrays
    if np.count_nonzero(beams) < 2:
        return np.zeros((0, 2), np.int32), np.zeros((0, 2), np.int32)
    nodes = a.node_number.size
    uses = np.bincount(a.element_node[a.element_node > 0] - 1, minlength=nodes)
    free = np.all(
        (a.coordinate_class == Class.NONE) | (a.coordinate_class == Class.DEPENDENT), axis=0
    )
    inner = free & (uses == 2)
    beam = np.flatnonzero(beams)
    ends = a.element_node[:, beam] - 1
    alone = np.stack([inner[ends[k]] & inner[ends[k + 1]] for k in (0, 2)])
    end, at = np.nonzero(alone)
    position, orientation = ends[2 * end, at], ends[2 * end + 1, at]
    order = np.lexsort((beam[at], position))
    position, orientation = position[order], orientation[order]
    end, beam = end[order], beam[at[order]]
    same = (position[1:] == position[:-1]) & (orientation[1:] == orientation[:-1])
    first = np.flatnonzero(same & (beam[1:] != beam[:-1]))
    both = np.column_stack([first, first + 1])
    return beam[both].astype(np.int32), end[both].astype(np.int32)


def _as_pairs(beams: IntArray, ends: IntArray) -> Iterator[tuple[tuple[int, int], tuple[int, int]]]:
    """Beam and end of the one and of the other, pair by pair."""
    for (i, j), (at_i, at_j) in zip(beams.tolist(), ends.tolist(), strict=True):
        yield (i, at_i), (j, at_j)


def _nearly_in_line(arrays: ModelArrays, beams: IntArray, ends: IntArray) -> BoolArray:
    """Which pairs may go on in line: all others are seen at once that they do not, (pairs,)."""
    way = np.diff(arrays.node_value[:3, arrays.element_node[[0, 2]][:, beams] - 1], axis=1)[:, 0]
    # From the first beam into the second: the one ends, the other begins at the node.
    along = way * np.where(ends == [1, 0], 1.0, -1.0)
    products = np.einsum("ij,ij->j", along[:, :, 0], along[:, :, 1])
    lengths = np.sqrt(np.einsum("ijk,ijk->jk", way, way)).prod(axis=1)
    return np.asarray(products >= (min(_IN_ROW, _OF_ONE_NAME) - _SLACK) * lengths)


def _go_on(
    arrays: ModelArrays,
    names: Sequence[str],
    frames: Callable[[], FloatArray],
    one: tuple[int, int],
    other: tuple[int, int],
) -> bool:
    """Whether two beams, each by its index and the end that is joined, continue each other."""
    (i, at_i), (j, at_j) = one, other
    limit = _limit_of(arrays, names, one, other)
    if limit is None:
        return False
    along = _direction(arrays, i) * (1.0 if at_i == 1 else -1.0)
    if not along @ _direction(arrays, j) * (1.0 if at_j == 0 else -1.0) > limit:
        return False
    if not _turns_with_frame(arrays, one, j):
        return True
    # Their local y axes are nearly one line.
    across = frames()[[i, j], :, 1]
    return bool(abs(across[0] @ across[1]) > _IN_ROW)


def _limit_of(
    arrays: ModelArrays, names: Sequence[str], one: tuple[int, int], other: tuple[int, int]
) -> float | None:
    """Above which cosine between them two beams continue each other; None: at no angle."""
    (i, at_i), (j, at_j) = one, other
    if arrays.element_kind[i] != arrays.element_kind[j]:
        return None
    # In the sense of the row: i ends where j begins.
    first, second = _classes_of(arrays, i, at_i == 0), _classes_of(arrays, j, at_j == 1)
    inner = ((3, 2), (5, 4)) if arrays.deformation_class[3, i] else ((2, 1),)
    if any((first[d] == Class.FIXED) != (second[e] == Class.FIXED) for d, e in inner):
        return None
    if not _may_be_one_part(names, i, j):
        return None
    mine = part_name(names[i])
    return _OF_ONE_NAME if mine and mine == part_name(names[j]) else _IN_ROW


def _turns_with_frame(arrays: ModelArrays, one: tuple[int, int], other: int) -> bool:
    """Whether it counts how a beam is turned against its neighbour."""
    i, at_i = one
    vectors = arrays.element_vector[:, [i, other]].T
    return Class.FIXED in _classes_of(arrays, i, at_i == 0)[2:] and not np.array_equal(*vectors)


class Links(NamedTuple):
    """Pairs of beams that continue each other at some angle.

    Attributes:
        way: (2, 2, pairs) position nodes between which the one and the other beam go on.
        limit: (pairs,) cosine above which they do.
        by_frame: (pairs,) whether it counts, too, how they are turned against each other.
    """

    way: IntArray
    limit: FloatArray
    by_frame: BoolArray

    def go_on(self, place: FloatArray) -> IntArray:
        """(variants, pairs) whether they do with the nodes at (variants, nodes, 3): 1, 0.

        What is not clear is -1.
        """
        with np.errstate(all="ignore"):
            way = place[:, self.way[:, 1]] - place[:, self.way[:, 0]]
            lengths = np.sqrt(np.einsum("vbpi,vbpi->vbp", way, way)).prod(axis=1)
            above = np.einsum("vpi,vpi->vp", way[:, 0], way[:, 1]) - self.limit * lengths
            found = np.where(above > _CLEAR * lengths, np.where(self.by_frame, -1, 1), -1)
            return np.where(above < -_CLEAR * lengths, 0, found).astype(np.int8)


def links_of(arrays: ModelArrays, names: Sequence[str]) -> Links:
    """The pairs of beams of a model that may go on in line."""
    ways, limits, by_frame = [], [], []
    for one, other in _as_pairs(*_joined(arrays, _is_bendable(arrays))):
        limit = _limit_of(arrays, names, one, other)
        if limit is None:
            continue
        # From the far end of the one to the joint, and on to that of the other.
        (i, at_i), (j, at_j) = one, other
        ends = [(2 - 2 * at_i, i), (2 * at_i, i)], [(2 * at_j, j), (2 - 2 * at_j, j)]
        ways.append([[arrays.element_node[end] - 1 for end in way] for way in ends])
        limits.append(limit)
        by_frame.append(_turns_with_frame(arrays, one, j))
    way = np.array(ways, np.int32).reshape(-1, 2, 2).T
    return Links(way, np.array(limits), np.array(by_frame, np.bool_))


def _classes_of(arrays: ModelArrays, element: int, turned: bool) -> tuple[int, ...]:
    """(6,) classes of a beam's deformations, or of the beam with its ends exchanged."""
    own: list[int] = arrays.deformation_class[:, element].tolist()
    if not turned:
        return tuple(own)
    swap = _OTHER_END if own[3] else _OTHER_END_IN_PLANE
    return tuple(own[swap.get(d, d)] for d in range(6))


def _direction(arrays: ModelArrays, element: int) -> FloatArray:
    p, q = arrays.element_node[[0, 2], element] - 1
    way: FloatArray = arrays.node_value[:3, q] - arrays.node_value[:3, p]
    length = float(np.linalg.norm(way))
    return way / length if length > 0.0 else way


def _followed(
    next_of: dict[tuple[int, int], tuple[int, int]], start: int
) -> list[tuple[int, bool]]:
    """Beams of the row of one of them, each with whether it is turned; a ring once."""
    sides: tuple[list[tuple[int, bool]], ...] = ([], [])
    for end, side in enumerate(sides):
        here = (start, end)
        while here in next_of:
            beam, at = next_of[here]
            if beam == start:
                # A ring has no ends: it is cut at its first beam.
                return [(start, False), *side[::-1]]
            side.append((beam, at == end))
            here = (beam, 1 - at)
    return [*sides[0][::-1], (start, False), *sides[1]]


def _row(arrays: ModelArrays, beams: list[tuple[int, bool]]) -> Chain:
    """Beams in a row, each with whether it is turned."""
    first, turned = beams[0]
    nodes, slots = arrays.element_node, [(2 if turned else 0, first)]
    slots += [(0 if against else 2, beam) for beam, against in beams]
    return Chain(
        tuple(beam for beam, _ in beams),
        tuple(against for _, against in beams),
        tuple(int(nodes[slot, beam]) - 1 for slot, beam in slots),
        tuple(int(nodes[slot + 1, beam]) - 1 for slot, beam in slots),
        tuple(_classes_of(arrays, beam, against) for beam, against in beams),
    )


def _is_beam(arrays: ModelArrays) -> BoolArray:
    """Which elements are beams, (elements,)."""
    return np.asarray(member_table()[arrays.element_kind] == Member.BEAM)


def _is_bendable(arrays: ModelArrays) -> BoolArray:
    """Which elements are beams that do not hold every bending, (elements,)."""
    bends = np.isin(role_table(), (*XZ, *XY, *PLANAR))[arrays.element_kind]
    free = bends & (arrays.deformation_class.T != Class.FIXED)
    return np.asarray(_is_beam(arrays) & free.any(axis=1))


#: Beside the largest component of a direction one below this part is small; and an axis is steep
#: from this part of one on. No angle that designers choose has such a tangent or cosine, so that
#: rounding decides nothing.
_SMALL, _STEEP = 0.2137, 0.8817
#: The order in which components are looked at: z, y, x.
_ORDER = [2, 1, 0]
_UP, _ELSE = np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])


def directions_across(
    arrays: ModelArrays, frame: FloatArray, chains: Sequence[Chain]
) -> FloatArray:
    """(elements, 2, 3) unit vectors across each element: width and normal, or upward and sideways.

    Args:
        arrays: The model.
        frame: (elements, 3, 3) reference frames, columns ex, ey, ez.
        chains: Its divided sheets and wires.
    """
    form, wide = forms_of(arrays)
    axis = frame[..., 0].copy()
    for chain in chains:
        ends = arrays.node_value[:3, [chain.positions[0], chain.positions[-1]]].T
        axis[list(chain.elements)] = _unit(ends[1] - ends[0])
    steep = np.abs(axis[:, 2]) > _STEEP
    axis, first = frame[..., 0], np.where(steep[:, None], _ELSE, _UP)
    first = _unit(first - np.sum(first * axis, axis=1, keepdims=True) * axis)
    made = np.stack((first, np.cross(axis, first)), axis=1)
    sheet = np.flatnonzero(form == Form.SHEET)
    width = wide[sheet]
    made[sheet, 0] = frame[sheet, :, width]
    made[sheet, 1] = frame[sheet, :, 3 - width]
    sign = signs_of(made)
    for chain in chains:
        row = list(chain.elements)
        onward = np.where(np.sum(made[row[1:]] * made[row[:-1]], axis=-1) < 0.0, -1.0, 1.0)
        sign[row] = np.concatenate((np.ones((1, 2)), np.cumprod(onward, axis=0)))
        sign[row] *= signs_of(np.sum(made[row] * sign[row][..., None], axis=0))
    return made * sign[..., None]


def _unit(vector: FloatArray) -> FloatArray:
    return np.asarray(vector / np.linalg.norm(vector, axis=-1, keepdims=True))


def signs_of(direction: FloatArray) -> FloatArray:
    """(...,) 1 or -1 that turns directions (..., 3) as the module says."""
    ordered = direction[..., _ORDER]
    size = np.abs(ordered)
    large = size > _SMALL * size.max(axis=-1, keepdims=True)
    first = np.argmax(large, axis=-1)[..., None]
    deciding = np.take_along_axis(ordered, first, axis=-1)[..., 0]
    return np.where(deciding < 0.0, -1.0, 1.0)
