# SPDX-License-Identifier: BSD-3-Clause
"""Which independent coordinates and deformations a deck calls inputs: prescribed motions."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ..core.arrays import BoolArray, IntArray
from ..core.elements import Class, NodeKind
from ..deck.keywords import Block
from ..deck.tokens import tokens_of
from .data import ModelData
from .writing import FIRST_COMPONENT


class Prescribed(NamedTuple):
    """What is prescribed; the other independent coordinates and deformations are dynamic.

    Attributes:
        coordinates: (3, nodes) by axis.
        deformations: (6, elements).
    """

    coordinates: BoolArray
    deformations: BoolArray


def prescribed_in(data: ModelData) -> Prescribed:
    """What the deck of a model states with INPUTX and INPUTE; nothing in a model without one.

    An analysis needs no difference between inputs and degrees of freedom, so that the model
    itself does not keep it.
    """
    arrays = data.arrays
    found = Prescribed(
        np.zeros(arrays.coordinate_class.shape, np.bool_),
        np.zeros(arrays.deformation_class.shape, np.bool_),
    )
    for letter, number, components in class_statements(data, "INPUT"):
        if letter == "X":
            if (node := data.node_index.get(number)) is None:
                # Of warping, which a model does not have.
                continue
            first = FIRST_COMPONENT[NodeKind(int(arrays.node_kind[node]))]
            _mark(found.coordinates[:, node], components, first)
        else:
            _mark(found.deformations[:, data.element_index[number]], components, 1)
    return Prescribed(
        found.coordinates & _independent(arrays.coordinate_class),
        found.deformations & _independent(arrays.deformation_class),
    )


def _independent(classes: IntArray) -> BoolArray:
    return np.asarray(classes == Class.INDEPENDENT)


def class_statements(data: ModelData, word: str) -> Iterator[tuple[str, int, list[int]]]:
    """The statements of a class in a deck's kinematics, as it has them.

    Args:
        data: A model; one that was made in Python has none.
        word: DYN or INPUT.

    Yields:
        X or E, node or element, and components.
    """
    if data.source is None:
        return
    tokens = tokens_of(data.source)
    for number in tokens.lines_of(f"{word}X", f"{word}E").tolist():
        line = tokens[number]
        if line.block is Block.KINEMATICS:
            owner, *components = (each.number for each in line.words[1:])
            yield line.name[-1], owner, components


def _mark(marks: BoolArray, components: list[int], first: int) -> None:
    """Mark some components, all where none is named; lambda0 and warping are none of its own."""
    if not components:
        marks[:] = True
    for component in components:
        if first <= component < first + marks.size:
            marks[component - first] = True
