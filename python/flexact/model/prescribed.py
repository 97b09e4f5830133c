# SPDX-License-Identifier: BSD-3-Clause
"""Which independent coordinates and deformations a deck calls inputs: prescribed motions."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ..core.arrays import BoolArray, IntArray
from ..core.elements import Class, NodeKind
from .data import ModelData
from .deck_text import FIRST_COMPONENT

#: The end of the kinematics, and its statements of inputs up to their comments.
_END = re.compile(rb"^[ \t\r\f\v]*END(?=[\s%#]|\Z)", re.MULTILINE | re.IGNORECASE)
_INPUTS = re.compile(rb"^[ \t\r\f\v]*INPUT([XE])[ \t\f\v]([^%#\n]*)", re.MULTILINE | re.IGNORECASE)


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
    for letter, number, components in _statements(data):
        if letter == b"X":
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


def _statements(data: ModelData) -> Iterator[tuple[bytes, int, list[int]]]:
    """X or E, node or element, and components of each statement of inputs."""
    if data.source is None:
        return
    text = data.source.text
    end = _END.search(text)
    for found in _INPUTS.finditer(text, 0, len(text) if end is None else end.start()):
        number, *components = map(int, found[2].split())
        yield found[1].upper(), number, components


def _mark(marks: BoolArray, components: list[int], first: int) -> None:
    """Mark some components, all where none is named; lambda0 and warping are none of its own."""
    if not components:
        marks[:] = True
    for component in components:
        if first <= component < first + marks.size:
            marks[component - first] = True
