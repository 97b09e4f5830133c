# SPDX-License-Identifier: BSD-3-Clause
"""A model in which each divided sheet or wire that is declared as one is one beam.

What is inside such a row, straight or wavy, holds nothing and frees nothing: its deformations
are declared. So the verdict, the singular values and the margin are those of one beam between
the ends, whatever the number of beams and wherever their inner nodes are.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ...core.arrays import BoolArray, FloatArray, IntArray, ModelArrays
from ...core.elements import Class, NodeKind
from ...util.records import Frozen, cached_property
from ..data import Appearance, ModelData
from ..names import part_name
from .chains import Chain, links_of, stretch_of

#: Sine below which a vector is taken for one along the chord.
_ALONG = 1.0e-3
#: Of lengths, sines and cosines: what is clearly more than nothing.
_CLEAR = 1.0e-6
#: Lengths that are clearly within the range of what is analysed [m].
_SIZES = (1.0e-80, 1.0e80)


@dataclass(frozen=True, eq=False)
class Condensed(Frozen):
    """A model and the one that is analysed in its place.

    Attributes:
        given: The model as it was given.
        data: The model that is analysed, without stiffness and mass; the same object where
            nothing is condensed.
        chains: The rows of beams that are one beam each in `data`.
        nodes: (nodes of `data`,) index of each of its nodes in `given`.
        elements: (elements of `data`,) index of each of its elements in `given`.
    """

    given: ModelData
    data: ModelData
    chains: tuple[Chain, ...]
    nodes: IntArray
    elements: IntArray

    @cached_property
    def inner(self) -> tuple[InnerNodes, ...]:
        """The nodes inside the chains, in their order."""
        return tuple(_inner_nodes(self.given.arrays, chain) for chain in self.chains)

    def holds_at(self, place: FloatArray) -> BoolArray:
        """(variants,) whether clearly the same rows are one beam each also in another geometry.

        Then `data` with its nodes there is the model that is analysed, and no beam inside of a
        row is without a length or has its vector along it. What is not clear is False.

        Args:
            place: (variants, nodes of `given`, 3) [m], in which the same pairs of beams go on as
                `ways_on` says.
        """
        holds = np.ones(len(place), np.bool_)
        with np.errstate(all="ignore"):
            for chain in self.given.chains:
                row = place[:, list(chain.positions)]
                way = np.diff(row, axis=1)
                length = np.linalg.norm(way, axis=2)
                holds &= stretch_of(row) > _CLEAR * length.sum(axis=1)
                if chain in self.chains:
                    least = np.maximum(_CLEAR * np.abs(row).max(axis=(1, 2)), _SIZES[0])
                    holds &= ((length > least[:, None]) & (length < _SIZES[1])).all(axis=1)
                    holds &= self._keeps_vector(chain, row, way / length[:, :, None])
        return holds

    def _keeps_vector(self, chain: Chain, row: FloatArray, along: FloatArray) -> BoolArray:
        """(variants,) whether the y vector of the one beam is the one given to all, `_vector_of`.

        Args:
            chain: Its row.
            row: (variants, nodes of the row, 3) [m].
            along: (variants, beams, 3) unit vectors from node to node.
        """
        given = self.given.arrays.element_vector[:, list(chain.elements)].T
        vector = given[0]
        if not np.all(given == vector):
            return np.zeros(len(row), np.bool_)
        if not vector.any():
            return np.ones(len(row), np.bool_)
        vector = vector / np.linalg.norm(vector)
        chord = row[:, [-1]] - row[:, [0]]
        along = np.append(along, chord / np.linalg.norm(chord, axis=2, keepdims=True), axis=1)
        across = vector - (along @ vector)[:, :, None] * along
        # From beam to beam it stays on one side.
        products = np.sum(across[:, 1:-1] * across[:, :-2], axis=2)
        clearly = np.linalg.norm(across, axis=2) > 10.0 * _ALONG
        return np.asarray(clearly.all(axis=1) & (products > _CLEAR).all(axis=1))

    def motion(
        self, displacement: FloatArray, rotation: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """A velocity of `data`'s nodes at all nodes: cubic along each chain.

        Args:
            displacement: (nodes of `data`, 3) [m], zero for orientations.
            rotation: (nodes of `data`, 3) [rad], zero for positions.

        Returns:
            The same for the nodes of `given`.
        """
        if not self.chains:
            return displacement, rotation
        moved, turned = np.zeros((2, self.given.arrays.node_number.size, 3))
        moved[self.nodes], turned[self.nodes] = displacement, rotation
        for inner in self.inner:
            ends = inner.ends
            u, angle = moved[ends[[0, 2]]], turned[ends[[1, 3]]]
            moved[inner.positions], turned[inner.orientations] = inner.between(u, angle)
        return moved, turned

    def stress(self, moments: FloatArray, forces: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Forces and moments of `data`'s elements at all elements: linear along each chain.

        Args:
            moments: (elements of `data`, 6) by deformation [N m].
            forces: (elements of `data`, 6) by deformation [N].

        Returns:
            The same for the elements of `given`.
        """
        made = np.zeros((2, self.given.arrays.element_number.size, 6))
        made[0][self.elements], made[1][self.elements] = moments, forces
        for chain, inner in zip(self.chains, self.inner, strict=True):
            index = int(np.searchsorted(self.elements, chain.elements[0]))
            made[1][list(chain.elements)] = forces[index]
            frame = self.data.frames.frame[index]
            made[0][list(chain.elements)] = self._bent(chain, inner, frame, moments[index])
        return made[0], made[1]

    def _bent(
        self, chain: Chain, inner: InnerNodes, frame: FloatArray, moments: FloatArray
    ) -> FloatArray:
        """(beams, 6) moments of the beams of a chain, from those of the one beam, (6,).

        They are about the axes of the one beam: a beam that is not in line with it is given
        those about the axis of its own that is nearest.
        """
        beams = list(chain.elements)
        sense = np.where(chain.reversed, -1.0, 1.0)[:, None]
        ends = np.array([0.0, *inner.share, 1.0])
        shares = np.stack((ends[:-1], ends[1:]), axis=1)
        shares = np.where(sense < 0.0, shares[:, ::-1], shares)
        made = np.tile(moments, (len(beams), 1))
        # Bending about local y at p and q, and about local z; a planar beam bends about z alone.
        planes = ((2, 1, 2),) if inner.is_planar else ((1, 2, 3), (2, 4, 5))
        axes = [axis for axis, _, _ in planes]
        # (beams, own axes, axes of the one beam)
        cosines = np.swapaxes(self.given.frames.frame[beams][:, :, axes], 1, 2) @ frame[:, axes]
        nearest = np.argmax(np.abs(cosines), axis=2)
        sign = np.sign(np.take_along_axis(cosines, nearest[:, :, None], axis=2)[:, :, 0])
        of_p, of_q = (moments[[plane[end] for plane in planes]][nearest] for end in (1, 2))
        for k, (_, p, q) in enumerate(planes):
            linear = of_p[:, [k]] * (1.0 - shares) + of_q[:, [k]] * shares
            made[:, [p, q]] = sense * sign[:, [k]] * linear
        return made

    def in_given(self, element: int, deformation: int) -> tuple[int, int]:
        """Where a deformation is in the model as given.

        Args:
            element: Index in `data`.
            deformation: From 1.

        Returns:
            Index of the element in `given`, and the deformation from 1.
        """
        place = int(self.elements[element])
        chain = next((each for each in self.chains if each.elements[0] == place), None)
        if chain is None:
            return place, deformation
        at_end = deformation in ((3,) if chain.is_planar else (4, 6))
        first = -1 if at_end else 0
        places = [(each, chain.own(k, deformation)) for k, each in enumerate(chain.elements)]
        of_data, of_given = (each.arrays.deformation_class for each in (self.data, self.given))
        if of_data[deformation - 1, element] == Class.DEPENDENT:
            # What one of the beams releases, and the others have declared, may stand elsewhere.
            found = (at for at in places if of_given[at[1] - 1, at[0]] == Class.DEPENDENT)
            return next(found, places[first])
        return places[first]


@dataclass(frozen=True, eq=False)
class InnerNodes(Frozen):
    """The nodes between the ends of a chain.

    Attributes:
        ends: (4,) indices of the nodes p, op, q, oq of the chain.
        positions: (k,) indices of its inner position nodes.
        orientations: (k,) likewise.
        share: (k,) where they are along the chord, 0 at p and 1 at q.
        chord: (3,) from p to q [m].
        offset: (k, 3) how far they are beside the chord [m].
        is_planar: Whether its beams are planar.
    """

    ends: IntArray
    positions: IntArray
    orientations: IntArray
    share: FloatArray
    chord: FloatArray
    offset: FloatArray
    is_planar: bool

    def between(self, ends: FloatArray, turns: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Velocities at the inner nodes of a cubic beam between two ends.

        Args:
            ends: (2, 3) of p and q [m].
            turns: (2, 3) of their orientations [rad].
        """
        t = self.share[:, None]
        length = float(np.linalg.norm(self.chord))
        ex = self.chord / length
        slope = np.cross(turns, ex)
        way, (at_p, at_q) = ends[1] - ends[0], slope
        course = ends[0] + (3 * t**2 - 2 * t**3) * way
        course += length * ((t - 2 * t**2 + t**3) * at_p + (t**3 - t**2) * at_q)
        # Along the chord it is stretched evenly.
        along = (ends[0] + t * way - course) @ ex
        course += along[:, None] * ex
        rate = (6 * t - 6 * t**2) * way / length
        rate += (1 - 4 * t + 3 * t**2) * at_p + (3 * t**2 - 2 * t) * at_q
        twist = (1 - t) * (turns[0] @ ex) + t * (turns[1] @ ex)
        turned = np.cross(ex, rate) + twist * ex
        return course + np.cross(turned, self.offset), turned


def _inner_nodes(arrays: ModelArrays, chain: Chain) -> InnerNodes:
    place = arrays.node_value[:3, list(chain.positions)].T
    chord = place[-1] - place[0]
    inner = place[1:-1] - place[0]
    share = inner @ chord / (chord @ chord)
    return InnerNodes(
        np.array(chain.ends, np.int32),
        np.array(chain.positions[1:-1], np.int32),
        np.array(chain.orientations[1:-1], np.int32),
        share,
        chord,
        inner - share[:, None] * chord,
        chain.is_planar,
    )


def as_given(data: ModelData) -> Condensed:
    """A model in which no chain is taken for one beam."""
    nodes, elements = data.arrays.node_number.size, data.arrays.element_number.size
    every_node = np.arange(nodes, dtype=np.int32)
    return Condensed(data, data, (), every_node, np.arange(elements, dtype=np.int32))


def condensed(data: ModelData) -> Condensed:
    """The sound model in which each chain that is declared as one beam is one beam."""
    whole = as_given(data)
    chains = tuple(chain for chain in data.chains if chain.condensed_classes is not None)
    if not chains:
        return whole
    arrays, every_node, every_element = data.arrays, whole.nodes, whole.elements
    left_nodes, left_elements = every_node >= 0, every_element >= 0
    element_node, classes = arrays.element_node.copy(), arrays.deformation_class.copy()
    vector, names = arrays.element_vector.copy(), list(data.element_names)
    for chain in chains:
        first = chain.elements[0]
        left_nodes[[*chain.positions[1:-1], *chain.orientations[1:-1]]] = False
        left_elements[list(chain.elements[1:])] = False
        element_node[:, first] = np.array(chain.ends) + 1
        classes[:, first] = chain.condensed_classes or ()
        vector[:, first] = _vector_of(data, chain)
        names[first] = next((part_name(n) for e in chain.elements if (n := names[e])), "")
    nodes, elements = every_node[left_nodes], every_element[left_elements]
    made = arrays._replace(
        element_node=element_node, element_vector=vector, deformation_class=classes
    )
    looks = data.given_appearance
    if looks is not None:
        fields = looks.__dataclass_fields__
        looks = Appearance(**{name: getattr(looks, name)[elements] for name in fields})
    return Condensed(
        data,
        replace(
            data,
            arrays=made.of(nodes, elements),
            element_names=tuple(names[i] for i in elements.tolist()),
            found=data.problems,
            node_names=tuple(data.node_names[i] for i in nodes.tolist()),
            given_appearance=looks,
            properties=None,
            loads=None,
        ),
        chains,
        nodes,
        elements,
    )


def ways_on(data: ModelData, place: FloatArray) -> IntArray:
    """(variants, pairs) which pairs of beams go on in line, 1 or 0, or -1 where that is not clear.

    Where the same do, and rows of them are stretched in both, rows of beams are the same.

    Args:
        data: The model.
        place: (variants, nodes, 3) [m], as `places_in` gives them.
    """
    return links_of(data.arrays, data.element_names).go_on(place)


def places_in(data: ModelData, positions: FloatArray) -> FloatArray:
    """(variants, nodes, 3) of positions [m], of which what is no coordinate is zero."""
    is_planar = (data.arrays.node_kind == NodeKind.PLANAR_POSITION).any()
    return positions * [1.0, 1.0, 0.0] if is_planar else positions


def _vector_of(data: ModelData, chain: Chain) -> FloatArray:
    """The y vector of the one beam: the one given to all, or the mean of their local y axes.

    A vector and its opposite are one; along the chord it says nothing.
    """
    beams = list(chain.elements)
    axes: FloatArray = data.frames.frame[beams, :, 1]
    # From neighbour to neighbour: along an arc they turn round without changing sides.
    same = np.sum(axes[1:] * axes[:-1], axis=1) >= 0.0
    signs = np.cumprod([1.0, *np.where(same, 1.0, -1.0)])[:, None]
    given = signs * data.arrays.element_vector[:, beams].T
    if np.all(given == given[0]) and (not given.any() or not _is_along(given[0], data, chain)):
        return np.asarray(given[0])
    mean = np.sum(signs * axes, axis=0)
    if not _is_along(mean, data, chain):
        return np.asarray(mean)
    return np.zeros(3)


def _is_along(vector: FloatArray, data: ModelData, chain: Chain) -> bool:
    """Whether a vector is practically parallel to the chord of a row."""
    ends = data.arrays.node_value[:3, [chain.positions[0], chain.positions[-1]]].T
    chord = ends[1] - ends[0]
    unit = vector / np.abs(vector).max()
    across = np.cross(unit, chord / np.abs(chord).max())
    return bool(np.abs(across).max() < _ALONG)
