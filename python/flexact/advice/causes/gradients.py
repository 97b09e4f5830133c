# SPDX-License-Identifier: BSD-3-Clause
"""What moving nodes and turning vectors makes of pairs of self-stresses and motions.

The rows of D(c) of an element depend on the offset between its ends and on its vector alone, so
that a few assemblies of a model whose elements share no node have the derivatives of all of them.
u' dD v of all pairs and all changes is theory.md (20) with every change kept apart.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from ...analysis.decomposition import Asked, decompose
from ...analysis.limits import NO_CHANGE
from ...analysis.result import Result, SelfStress
from ...core import calls
from ...core.arrays import Basis, FloatArray, ModelArrays, packed
from ...core.elements import Class, NodeKind, Role, Vector, element_kinds, length_table, role_table
from ...model.data import ModelData
from ...model.parts.parts import PartKind, natural
from ...util.errors import FlexactError
from ...util.groups import groups_of
from ...util.records import Frozen, cached_property
from .cause import Lift

#: How far nodes are moved beside the members that meet there, and vectors beside their length.
_MOVED, _TURNED = 0.4, 0.7
#: Of larger models one geometry is tried.
_MOST_FOR_MORE = 2_000
_SEED = 20_111_105


class Geometry(Frozen):
    """A model whose node places and element vectors can be changed, all of them explicit.

    Attributes:
        data: The model.
        vectors: (elements, 3) y vector or axis of each element, of unit length; that of the
            frame where none is given; zero where a kind has none.
        owner: (nodes,) the first of the nodes that are, and stay, at one place: those of an
            element that has no length.
        free: (nodes, 3) which coordinates there are: of position nodes, in the plane x and y.
    """

    def __init__(self, data: ModelData) -> None:
        """Read the places and vectors of a sound model."""
        self.data = data
        arrays, frames = data.arrays, data.frames
        kinds = np.array([0, *(kind.vector for kind in element_kinds())])[arrays.element_kind]
        given = arrays.element_vector.T
        size = np.linalg.norm(given, axis=1, keepdims=True)
        own = np.where(size > 0.0, given / np.where(size > 0.0, size, 1.0), frames.frame[:, :, 1])
        self.vectors: FloatArray = np.where(np.not_equal(kinds, Vector.NONE)[:, None], own, 0.0)
        self.free = np.zeros((arrays.node_kind.size, 3), bool)
        self.free[arrays.node_kind == NodeKind.POSITION] = True
        self.free[arrays.node_kind == NodeKind.PLANAR_POSITION, :2] = True
        p, q = arrays.element_node[[0, 2]] - 1
        short = (p >= 0) & (q >= 0) & (length_table()[arrays.element_kind] == 0)
        apart = np.linalg.norm(arrays.node_value[:3, q] - arrays.node_value[:3, p], axis=0)
        short &= apart <= 1.0e-9 * max(float(frames.length.max(initial=0.0)), 1.0e-300)
        self.owner = groups_of(arrays.node_kind.size, zip(p[short], q[short], strict=True))

    @cached_property
    def places(self) -> FloatArray:
        """(nodes, 3) [m]; zero of orientations."""
        return np.asarray(np.where(self.free, self.data.arrays.node_value[:3].T, 0.0))

    @cached_property
    def sizes(self) -> FloatArray:
        """(nodes,) the geometric mean of the lengths that meet at each node [m]."""
        arrays, length = self.data.arrays, self.data.frames.length
        nodes = arrays.element_node[[0, 2]] - 1
        used = (nodes >= 0) & (length > 0.0)
        logs = np.broadcast_to(np.log(np.where(length > 0.0, length, 1.0)), nodes.shape)[used]
        total = np.bincount(nodes[used], logs, arrays.node_kind.size)
        count = np.bincount(nodes[used], minlength=arrays.node_kind.size)
        mean = float(logs.mean()) if logs.size else 0.0
        return np.asarray(np.exp(np.where(count > 0, total / np.maximum(count, 1), mean)))

    def moved(self, places: FloatArray, vectors: FloatArray) -> ModelData:
        """The model with its nodes and vectors elsewhere, (nodes, 3) and (elements, 3)."""
        arrays = self.data.arrays
        value = arrays.node_value.copy(order="F")
        value[:3] = np.where(self.free, places[self.owner], value[:3].T).T
        made = arrays._replace(
            node_value=value, element_vector=np.asfortranarray(np.array(vectors).T)
        )
        return replace(self.data, arrays=made, source=None, found=None)

    def random(self, trial: int) -> tuple[FloatArray, FloatArray]:
        """Places and vectors of a trial: first near those that are, then anywhere."""
        rng = np.random.default_rng((_SEED, trial))
        count = self.places.shape[0]
        vectors = self.vectors + _TURNED * rng.uniform(-1.0, 1.0, self.vectors.shape)
        vectors[~np.any(self.vectors, axis=1)] = 0.0
        if trial % 2 == 0:
            step = _MOVED * self.sizes[:, None] * rng.uniform(-1.0, 1.0, (count, 3))
            return self.places + step, vectors
        extent = float(np.exp(np.log(self.sizes).mean())) if count else 1.0
        return extent * count ** (1.0 / 3.0) * rng.uniform(-1.0, 1.0, (count, 3)), vectors


def rank_at(geometry: Geometry, places: FloatArray, vectors: FloatArray) -> int | None:
    """The rank of D(c) at a geometry; None where it cannot be analysed."""
    try:
        raw = decompose(geometry.moved(places, vectors), Asked("auto", None, False))
    except (FlexactError, MemoryError):
        return None
    return raw.rank


def generic_rank(result: Result) -> int | None:
    """The largest rank of some random geometries; None where none could be analysed."""
    full = min(result.rows, result.columns)
    if result.rank == full:
        return full
    geometry = Geometry(result.data)
    arrays = result.data.arrays
    large = max(arrays.node_number.size, arrays.element_number.size) > _MOST_FOR_MORE
    best: int | None = None
    for trial in range(1 if large else 3):
        found = rank_at(geometry, *geometry.random(trial))
        if found is not None:
            best = max(found, result.rank, best or 0)
        if best == full:
            break
    return best


class DetachedElements:
    """The rows of D of each element of a model in its reference configuration."""

    def __init__(self, arrays: ModelArrays, vectors: FloatArray) -> None:
        """Give each element nodes of its own; its vector is (elements, 3)."""
        element, slot = np.nonzero(arrays.element_node.T)
        node = arrays.element_node.T[element, slot] - 1
        made = np.zeros(arrays.element_node.shape, np.int32)
        made[slot, element] = np.arange(1, node.size + 1)
        classes = arrays.coordinate_class[:, node]
        self._arrays = arrays._replace(
            node_number=np.arange(1, node.size + 1, dtype=np.int32),
            node_kind=arrays.node_kind[node],
            node_value=np.asfortranarray(arrays.node_value[:, node]),
            coordinate_class=np.asfortranarray(
                np.where(classes == Class.NONE, classes, np.int32(Class.DEPENDENT))
            ),
            element_node=np.asfortranarray(made),
            element_vector=np.asfortranarray(vectors.T),
        )
        self._element, self._slot = element, slot
        needed = np.array([0, *(kind.vector for kind in element_kinds())])[arrays.element_kind]
        self._is_about_axis = needed == Vector.REQUIRED
        self._frame = calls.find_frames(packed(self._arrays)).frame

    def matrices(self, change: FloatArray) -> FloatArray:
        """(elements, 6, 12) rows of each element, its offset and vector changed, (elements, 6)."""
        value = self._arrays.node_value.copy(order="F")
        at_q = self._slot == 2
        value[:3, at_q] += change[self._element[at_q], :3].T
        vectors = np.asfortranarray(self._arrays.element_vector + change[:, 3:].T)
        arrays = self._arrays._replace(node_value=value, element_vector=vectors)
        size = arrays.element_number.size
        found = calls.assemble(packed(arrays), value, np.zeros(size))
        node, axis = np.divmod(found.column_of, 3)
        column = 3 * self._slot[node] + axis
        flat = found.row_of.astype(np.int64) * 12 + column
        made = np.bincount(flat, found.value, 72 * size).reshape(size, 6, 12).astype(float)
        self._turn_back(made, calls.find_frames(packed(arrays)).frame)
        return made

    def _turn_back(self, rows: FloatArray, frame: FloatArray) -> None:
        """Rows about two axes across a third, in the reference axes: these may be others.

        An axis alone does not say which they are, so that a small turn may exchange them.
        """
        roles = role_table()[self._arrays.element_kind]
        own = np.einsum("eij,eik->ejk", frame[:, :, 1:], self._frame[:, :, 1:])
        for first, second in ((Role.OFFSET_Y, Role.OFFSET_Z), (Role.TILT_Y, Role.TILT_Z)):
            element, row = np.nonzero((roles == first) & self._is_about_axis[:, None])
            there = roles[element, row + 1] == second
            element, row = element[there], row[there]
            both = np.stack((rows[element, row], rows[element, row + 1]), axis=1)
            back = np.einsum("ejk,ejc->ekc", own[element], both)
            rows[element, row], rows[element, row + 1] = back[:, 0], back[:, 1]


#: Step of central differences beside the length of what is changed.
_STEP = 2.0e-5
#: Entries of all pairs and changes together, beyond which they are not made.
MOST_ENTRIES = 20_000_000
#: Rows or columns up to which D(c) is decomposed in full, and how far on the way to another
#: geometry: second-order effects are then of 1e-8.
_MOST_DENSE, _SMALL = 400, 1.0e-4


class Gradients(Frozen):
    """Derivatives of û' D v̂ for orthonormal bases of both null spaces of the scaled D(c).

    Attributes:
        result: The result.
        geometry: Its places and vectors.
        stresses: (m, s) orthonormal self-stresses of the scaled matrix.
        motions: (n, k) its orthonormal motions.
        by_offset: (elements, 3, s, k) by the offset between the ends [1/m].
        by_vector: (elements, 3, s, k) by the vector, which is of unit length [1].
    """

    def __init__(self, result: Result) -> None:
        """Differentiate; ask `are_affordable` first."""
        self.result, self.geometry = result, Geometry(result.data)
        raw = result.raw
        self.stresses = _orthonormal(raw.stresses, raw.row_scale)
        self.motions = _orthonormal(raw.motions, raw.column_scale)
        made = self._derivatives()
        self.by_offset, self.by_vector = made[:, :3], made[:, 3:]

    @cached_property
    def at_nodes(self) -> FloatArray:
        """(nodes, 3, s, k) by the place of each node [1/m]; zero of what is no coordinate."""
        arrays = self.result.data.arrays
        made = np.zeros((arrays.node_kind.size, *self.by_offset.shape[1:]))
        for slot, sign in ((0, -1.0), (2, 1.0)):
            node = arrays.element_node[slot] - 1
            used = node >= 0
            np.add.at(made, self.geometry.owner[node[used]], sign * self.by_offset[used])
        made[~self.geometry.free] = 0.0
        return made

    @cached_property
    def by_turning(self) -> FloatArray:
        """(elements, 3, s, k) by a turn of each element about its centre [1/rad]."""
        first = np.cross(self._offsets[:, :, None, None], self.by_offset, axis=1)
        vectors = self.geometry.vectors[:, :, None, None]
        made = first + np.cross(vectors, self.by_vector, axis=1)
        if self.result.given.planar:
            made[:, :2] = 0.0
        return np.asarray(made)

    def left_over(self, motions: int, stresses: int) -> tuple[FloatArray, FloatArray] | None:
        """What one small random misalignment leaves, so many: (k, motions), (s, stresses).

        As combinations of the motions and self-stresses; None where that would take long.
        """
        result = self.result
        if min(result.rows, result.columns) > _MOST_DENSE:
            return None
        # The scaled D(c), a little on the way to other places and vectors.
        (places, vectors), arrays, raw = self.geometry.random(0), result.data.arrays, result.raw
        p, q = arrays.element_node[[0, 2]] - 1
        moved = (places - self.geometry.places)[self.geometry.owner]
        change = np.zeros((arrays.element_number.size, 6))
        both = ((p >= 0) & (q >= 0))[:, None]
        change[:, :3] = _SMALL * np.where(both, moved[q] - moved[p], 0.0)
        change[:, 3:] = _SMALL * (vectors - self.geometry.vectors)
        rows = DetachedElements(arrays, self.geometry.vectors).matrices(change)
        made = np.zeros((arrays.element_number.size, 6, arrays.node_kind.size + 1, 3))
        node = arrays.element_node.T - 1
        for slot in range(4):
            at = np.arange(node.shape[0])[:, None], np.arange(6)[None], node[:, slot][:, None]
            np.add.at(made, at, rows[:, :, 3 * slot : 3 * slot + 3])
        element, deformation = raw.row_label - 1
        column, axis = raw.column_label - 1
        chosen = made[element[:, None], deformation[:, None], column[None], axis[None]]
        left, _, right = np.linalg.svd(raw.row_scale[:, None] * chosen * raw.column_scale)
        of_motions = right[result.columns - motions :].T
        of_stresses = left[:, result.rows - stresses :]
        return self.motions.T @ of_motions, self.stresses.T @ of_stresses

    def lift_of(self, share: FloatArray, *, of_stress: bool = False) -> Lift:
        """Of a combination of the motions, (k,), or of the self-stresses, (s,), of unit length."""
        result, given, condensed = self.result, self.result.given.arrays, self.result.condensed
        moves, turns = (
            _largest((np.swapaxes(each, 2, 3) if of_stress else each) @ share)
            for each in (self.at_nodes, self.by_turning)
        )
        node = _first(moves, partial(node_key, result))
        element = _first(turns, partial(_element_key, result))
        by_move, node_number, by_turn, element_number = 0.0, None, 0.0, None
        if node is not None and moves[node] * result.characteristic_length > _NOTHING:
            by_move = float(moves[node])
            node_number = int(given.node_number[condensed.nodes[node]])
        if element is not None and turns[element] > _NOTHING:
            by_turn = float(turns[element])
            element_number = int(given.element_number[condensed.elements[element]])
        return Lift(by_move, node_number, by_turn, element_number)

    @property
    def _offsets(self) -> FloatArray:
        """(elements, 3) from p to q [m]; zero of elements without places."""
        arrays = self.result.data.arrays
        p, q = arrays.element_node[[0, 2]] - 1
        places = self.geometry.places
        both = ((p >= 0) & (q >= 0))[:, None]
        return np.asarray(np.where(both, places[q] - places[p], 0.0))

    def _derivatives(self) -> FloatArray:
        """(elements, 6, s, k) by the three components of the offset, then of the vector."""
        arrays, size = self.result.data.arrays, self.result.data.arrays.element_number.size
        stress = np.zeros((size, 6, self.stresses.shape[1]))
        element, deformation = self.result.raw.row_label - 1
        stress[element, deformation] = self.stresses * self.result.raw.row_scale[:, None]
        motion = np.zeros((arrays.node_kind.size + 1, 3, self.motions.shape[1]))
        node, axis = self.result.raw.column_label - 1
        motion[node, axis] = self.motions * self.result.raw.column_scale[:, None]
        moving = motion[arrays.element_node.T - 1].reshape(size, 12, -1)
        exploded = DetachedElements(self.result.data.arrays, self.geometry.vectors)
        offset, vector = self._offsets, self.geometry.vectors
        length = np.linalg.norm(offset, axis=1)
        made = np.zeros((size, 6, stress.shape[2], moving.shape[2]))
        for k in range(6):
            step = _STEP * (length if k < 3 else np.linalg.norm(vector, axis=1))
            if not step.any():
                continue
            change = np.zeros((size, 6))
            change[:, k] = step
            rise = exploded.matrices(change) - exploded.matrices(-change)
            per = np.where(step > 0.0, 0.5 / np.where(step > 0.0, step, 1.0), 0.0)
            made[:, k] = np.swapaxes(stress, 1, 2) @ (rise * per[:, None, None]) @ moving
        return made


def are_affordable(result: Result) -> bool:
    """Whether the derivatives of all pairs can be held."""
    raw = result.raw
    changes = 3 * raw.column_label.shape[1] + 12 * result.data.arrays.element_number.size
    return bool(raw.stresses.vectors * raw.motions.vectors * changes <= MOST_ENTRIES)


def _orthonormal(basis: Basis, scale: FloatArray) -> FloatArray:
    """The same space in the scaled matrix, by orthonormal columns."""
    return np.asarray(np.linalg.qr(basis.toarray() / scale[:, None])[0])


#: Of equal ones, to within this part, the first by name counts.
_EQUAL = 1.0e-6


#: Differences are good to some 1e-8.
_NOTHING = max(NO_CHANGE, 1.0e-7)


def _largest(blocks: FloatArray) -> FloatArray:
    """(places,) largest singular value of blocks (places, 3, others): of all directions."""
    if not blocks.size:
        return np.zeros(blocks.shape[0])
    gram = blocks @ np.swapaxes(blocks, 1, 2)
    return np.asarray(np.sqrt(np.maximum(np.linalg.eigvalsh(gram)[:, -1], 0.0)))


def _first(sizes: FloatArray, key: Callable[[int], tuple[object, ...]]) -> int | None:
    largest = float(sizes.max(initial=0.0))
    if not largest > 0.0:
        return None
    return min(np.flatnonzero(sizes >= (1.0 - _EQUAL) * largest).tolist(), key=key)


def node_key(result: Result, node: int) -> tuple[object, ...]:
    """Joints and bodies that move before what is held; then by name and place."""
    given = int(result.condensed.nodes[node])
    parts = result.parts
    name = parts.name_of_point(given) or next((part.name for part in parts.at(given)), "")
    place = place_key(result, result.given.arrays.node_value[:3, given])
    return parts.is_held(given), natural(name), place


def _element_key(result: Result, element: int) -> tuple[object, ...]:
    """Flexures and hinges before bodies; then by name and place."""
    given = int(result.condensed.elements[element])
    part = result.parts.of_element(given)
    nodes = result.given.arrays.element_node[[0, 2], given] - 1
    places = [result.given.arrays.node_value[:3, n] for n in nodes.tolist() if n >= 0]
    middle = np.mean(places, axis=0) if places else np.zeros(3)
    return part.kind is PartKind.BODY, natural(part.name), place_key(result, middle)


def place_key(result: Result, place: FloatArray) -> tuple[float, ...]:
    """A place by which equals are sorted, without what rounding makes of it."""
    rounded = np.round(place / (1.0e-9 * result.characteristic_length)) + 0.0
    return tuple(rounded.tolist())


#: A told vector of which less than this lies in the space of the undivided mechanism is not there.
THERE = 0.5


def shares_of_motions(
    result: Result, whole: Result, gradients: Gradients
) -> tuple[FloatArray, FloatArray]:
    """(k, told) motions by the basis of the undivided mechanism: the told ones, and its own.

    Columns of unit length, zero of what the undivided mechanism has not.

    Args:
        result: The result of which modes are told.
        whole: The same with divided sheets and wires as one beam each.
        gradients: Has the orthonormal bases of `whole`.
    """
    scale = whole.raw.column_scale
    own = _unit(gradients.motions.T @ (whole.motion_basis.toarray() / scale[:, None]))
    if whole is result:
        return own, own
    made = np.zeros((gradients.motions.shape[1], len(result.motions)))
    node, axis = whole.raw.column_label - 1
    given = whole.condensed.nodes[node]
    placed = whole.data.arrays.node_kind[node] <= NodeKind.POSITION
    for k, motion in enumerate(result.motions):
        both = np.where(placed, motion.displacement[given, axis], motion.rotation[given, axis])
        vector = both / scale
        share, size = gradients.motions.T @ vector, float(np.linalg.norm(vector))
        everything = np.concatenate((motion.displacement, motion.rotation))
        moves = size > 1.0e-9 * float(np.abs(everything).max()) and not motion.is_internal
        if moves and np.linalg.norm(share) > THERE * size:
            made[:, k] = share / size
    return _unit(made), own


def shares_of_stresses(
    result: Result, whole: Result, gradients: Gradients
) -> tuple[FloatArray, FloatArray]:
    """(s, told) the told self-stresses and those of the undivided mechanism, likewise."""
    told, scale = result.self_stresses, whole.raw.row_scale
    own = _unit(gradients.stresses.T @ (whole.stress_basis.toarray() / scale[:, None]))
    if whole is result or not len(told):
        return own[:, : len(told)], own
    of_whole, of_told = _loads_of(list(whole.self_stresses)), _loads_of(list(told))
    keys = sorted({*of_whole, *of_told})
    left, right = (
        np.concatenate([loads.get(key, np.zeros((6, count))) for key in keys])
        for loads, count in ((of_whole, own.shape[1]), (of_told, len(told)))
    )
    return _unit(own @ np.linalg.lstsq(left, right)[0]), own


def _loads_of(stresses: list[SelfStress]) -> dict[tuple[int, int], FloatArray]:
    """(6, stresses) what parts exert where they end, by their first element and the node."""
    made: dict[tuple[int, int], FloatArray] = {}
    for k, stress in enumerate(stresses):
        for one in stress.parts:
            for end in one.ends:
                key = one.part.elements[0], -1 if end.position is None else end.position
                block = made.setdefault(key, np.zeros((6, len(stresses))))
                wrench = end.wrench
                block[:3, k] = wrench.force * wrench.length
                block[3:, k] = wrench.moment
    return made


def _unit(vectors: FloatArray) -> FloatArray:
    """Columns of unit length; those that are nothing stay zero."""
    sizes = np.linalg.norm(vectors, axis=0)
    return np.asarray(np.where(sizes > 1.0e-9, vectors / np.where(sizes > 0.0, sizes, 1.0), 0.0))
