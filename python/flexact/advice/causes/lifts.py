# SPDX-License-Identifier: BSD-3-Clause
"""How fast a misalignment of one node or element lifts a motion or a self-stress."""

from __future__ import annotations

import numpy as np

from ...analysis.margin import NOTHING
from ...analysis.result import Result
from ...core.arrays import FloatArray
from ...model.parts.parts import PartKind, natural
from .cause import Lift
from .gradients import Gradients

#: Of equal ones, to within this part, the first by name counts.
_EQUAL = 1.0e-6


class Lifts:
    """The fastest lifts of combinations of motions, or of self-stresses."""

    def __init__(self, gradients: Gradients) -> None:
        """Keep the derivatives at nodes and of turns."""
        self._result = gradients.result
        self._at_nodes, self._by_turning = gradients.at_nodes(), gradients.by_turning()

    def of_motion(self, share: FloatArray) -> Lift:
        """Of a combination of the motions, (k,), of unit length."""
        return self._found(self._at_nodes @ share, self._by_turning @ share)

    def of_stress(self, share: FloatArray) -> Lift:
        """Of a combination of the self-stresses, (s,), of unit length."""
        nodes, turns = (np.swapaxes(a, 2, 3) @ share for a in (self._at_nodes, self._by_turning))
        return self._found(nodes, turns)

    def _found(self, at_nodes: FloatArray, by_turning: FloatArray) -> Lift:
        result = self._result
        moves, turns = _largest(at_nodes), _largest(by_turning)
        node = _first(moves, lambda i: node_key(result, i))
        element = _first(turns, lambda i: _element_key(result, i))
        by_move = float(moves[node]) if node is not None else 0.0
        by_turn = float(turns[element]) if element is not None else 0.0
        if by_move * result.characteristic_length <= _NOTHING:
            node, by_move = None, 0.0
        if by_turn <= _NOTHING:
            element, by_turn = None, 0.0
        given = result.given.arrays
        return Lift(
            by_move,
            None if node is None else int(given.node_number[result.condensed.nodes[node]]),
            by_turn,
            None
            if element is None
            else int(given.element_number[result.condensed.elements[element]]),
        )


#: Differences are good to some 1e-8.
_NOTHING = max(NOTHING, 1.0e-7)


def _largest(blocks: FloatArray) -> FloatArray:
    """(places,) largest singular value of blocks (places, 3, others): of all directions."""
    if not blocks.size:
        return np.zeros(blocks.shape[0])
    gram = blocks @ np.swapaxes(blocks, 1, 2)
    made: FloatArray = np.sqrt(np.maximum(np.linalg.eigvalsh(gram)[:, -1], 0.0))
    return made


def _first(sizes: FloatArray, key: object) -> int | None:
    largest = float(sizes.max(initial=0.0))
    if not largest > 0.0:
        return None
    able = np.flatnonzero(sizes >= (1.0 - _EQUAL) * largest).tolist()
    return int(min(able, key=key))  # type: ignore[call-overload]


def node_key(result: Result, node: int) -> tuple[object, ...]:
    """Joints and bodies that move before what is held; then by name and place."""
    given = int(result.condensed.nodes[node])
    parts = result.parts
    name = parts.name_of_point(given) or next((part.name for part in parts.at(given)), "")
    place = np.round(result.given.arrays.node_value[:3, given] / _step(result)) + 0.0
    return parts.is_held(given), natural(name), tuple(place.tolist())


def _element_key(result: Result, element: int) -> tuple[object, ...]:
    """Flexures and hinges before bodies; then by name and place."""
    given = int(result.condensed.elements[element])
    part = result.parts.of_element(given)
    nodes = result.given.arrays.element_node[[0, 2], given] - 1
    places = [result.given.arrays.node_value[:3, n] for n in nodes.tolist() if n >= 0]
    middle = np.mean(places, axis=0) if places else np.zeros(3)
    rounded = np.round(middle / _step(result)) + 0.0
    return part.kind is PartKind.BODY, natural(part.name), tuple(rounded.tolist())


def _step(result: Result) -> float:
    return 1.0e-9 * result.characteristic_length
