# SPDX-License-Identifier: BSD-3-Clause
"""Which orientation nodes stand at which position nodes."""

from __future__ import annotations

from collections import Counter
from itertools import chain

import numpy as np

from ...core.arrays import ModelArrays


def slots_of(arrays: ModelArrays) -> np.ndarray:
    """(elements, 4) node indices from 0 in the slots p, op, q, oq; -1 where unused."""
    return np.asarray(arrays.element_node.T.astype(np.int64) - 1)


def turned_at(arrays: ModelArrays) -> np.ndarray:
    """(pairs, 2) position node and orientation node that stand at one end of an element.

    Without repetition, ascending. The far end of a rigid link turns with its near end and has
    no orientation of its own.
    """
    slots = slots_of(arrays)
    ends = np.concatenate((slots[:, :2], slots[:, 2:]))
    return np.unique(ends[(ends >= 0).all(axis=1)], axis=0)


def places_of_hinges(slots: np.ndarray, is_line: np.ndarray) -> np.ndarray:
    """Position node of each element without extent, -1 where none is known.

    It is its own; else one that both of its orientation nodes stand at, else one of either.
    Where an orientation node stands between hinges alone, as in a cardan joint, it is where
    those are.
    """
    hinges = slots[~is_line][:, [1, 3]].tolist()
    places: dict[int, list[int]] = {node: [] for pair in hinges for node in pair}
    for p, op, q, oq in slots[is_line].tolist() if hinges else ():
        for position, orientation in ((p, op), (q, oq if oq >= 0 else op)):
            if orientation in places:
                places[orientation].append(position)
    _place_between_hinges(places, hinges)
    found = np.array([_common(places[a], places[b]) for a, b in hinges], dtype=np.int64)
    own = slots[~is_line][:, 0]
    return np.where(own >= 0, own, found)


def _place_between_hinges(places: dict[int, list[int]], hinges: list[list[int]]) -> None:
    """Place orientation nodes that only hinges name where most of what they join stands."""
    beyond: dict[int, list[int]] = {node: [] for node in places}
    for a, b in hinges:
        beyond[a].append(b)
        beyond[b].append(a)
    nowhere: set[int] = set()
    for start in [node for node in places if not places[node]]:
        if start in nowhere:
            continue
        joined, around, found = [start], Counter[int](), {start}
        for node in joined:
            for other in beyond[node]:
                if places[other]:
                    around.update(dict.fromkeys(places[other], 1))
                elif other not in found:
                    found.add(other)
                    joined.append(other)
        if not around:
            nowhere |= found
        for node in joined:
            places[node] = [place for place, _ in around.most_common(1)]


def _common(first: list[int], second: list[int]) -> int:
    others = set(second)
    shared = (node for node in first if node in others)
    return next(chain(shared, first, second), -1)
