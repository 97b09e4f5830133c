# SPDX-License-Identifier: BSD-3-Clause
"""Motions and self-stresses as the JSON has them: components in physical quantities, as rows."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from functools import cache, partial
from itertools import islice
from typing import Any, NamedTuple

import numpy as np

from ..core.arrays import FloatArray, IntArray
from ..core.basis import Basis
from ..core.elements import Dual, coordinate_name, keywords_of
from .deformation_words import deformation_word
from .json_mechanics import of_motion, of_self_stress
from .naming import node_name, unit_of_coordinate
from .result import Result
from .weights import row_duals, row_factors

#: Components of a mode below this part of its largest are left out.
_NEGLIGIBLE = 1.0e-14
#: How many components are handled at once.
_AT_ONCE = 100_000

#: One component, its values in the order of the keys.
Row = tuple[Any, ...]
#: The columns of components at some places of D(c), with these entries of V or U.
Columns = Callable[[IntArray, FloatArray], tuple[list[Any], ...]]


#: Keys of numbers of nodes and elements, and of those that are written to the last bit.
_WHOLE, _EXACT = ("node", "element", "deformation"), ("value", "raw")


class ModesTable(NamedTuple):
    """Modes, each as the rows of a table with a component each."""

    keys: tuple[str, ...]
    basis: Basis
    columns: Columns
    more: Callable[[int], dict[str, Any]]
    """What else is said of a mode, by its index."""

    def dictionaries(self) -> list[dict[str, Any]]:
        """The modes as the JSON has them."""
        return [
            {"components": [dict(zip(self.keys, row, strict=True)) for row in mode]}
            | self.more(index)
            for index, mode in enumerate(self._rows(lambda text: text))
        ]

    def text(self) -> Iterator[str]:
        """The same as JSON, without a dictionary for each component."""
        form = ", ".join(f'"{key}": {"%r" if key in _EXACT else "%s"}' for key in self.keys)
        of_row = f"{{{form}}}".__mod__
        before = ""
        yield "["
        for index, mode in enumerate(self._rows(cache(json.dumps))):
            more = json.dumps(self.more(index), allow_nan=False)[1:-1]
            yield f'{before}{{"components": [{", ".join(map(of_row, mode))}]'
            yield f"{', ' if more else ''}{more}}}"
            before = ", "
        yield "]"

    def _rows(self, of_text: Callable[[str], str]) -> Iterator[list[Row]]:
        """Components of each vector but those that are practically zero, in their order."""
        basis, begin = self.basis, 0
        while begin < basis.vectors:
            room = int(basis.start[begin]) + _AT_ONCE
            end = max(begin + 1, int(np.searchsorted(basis.start, room, "right")) - 1)
            part = slice(int(basis.start[begin]), int(basis.start[end]))
            vector = np.repeat(np.arange(end - begin), np.diff(basis.start[begin : end + 1]))
            size = np.abs(basis.value[part])
            largest = np.zeros(end - begin)
            np.maximum.at(largest, vector, size)
            kept = size > _NEGLIGIBLE * largest[vector]
            columns = self.columns(basis.place[part][kept], basis.value[part][kept])
            rows = zip(
                *(
                    column if key in _WHOLE or key in _EXACT else map(of_text, column)
                    for key, column in zip(self.keys, columns, strict=True)
                ),
                strict=True,
            )
            for count in np.bincount(vector[kept], minlength=end - begin).tolist():
                yield list(islice(rows, count))
            begin = end


def motions(result: Result) -> ModesTable:
    """The motions: displacements [m] and rotations [rad] of nodes."""
    raw, arrays = result.raw, result.data.arrays
    # Where no point has a name, nobody has to look for each.
    named = result.motion_basis.vectors > 0 and any(result.given.node_names)
    name_of = cache(partial(node_name, result)) if named else lambda _: ""

    def columns(places: IntArray, value: FloatArray) -> tuple[list[Any], ...]:
        node, axis = raw.column_label[:, places] - 1
        kinds = arrays.node_kind[node].tolist()
        coordinates = list(map(coordinate_name, kinds, axis.tolist()))
        return (
            arrays.node_number[node].tolist(),
            list(map(name_of, node.tolist())),
            coordinates,
            value.tolist(),
            list(map(unit_of_coordinate, coordinates)),
        )

    keys = ("node", "name", "coordinate", "value", "unit")
    return ModesTable(keys, result.motion_basis, columns, partial(of_motion, result))


def self_stresses(result: Result) -> ModesTable:
    """The self-stresses: forces [N] and moments [N m], beside the raw entries of U."""
    arrays = result.given.arrays
    # Names of a deck are cut out of its text.
    name_of = cache(result.given.element_names.__getitem__)

    def columns(places: IntArray, value: FloatArray) -> tuple[list[Any], ...]:
        index, deformations = _in_given(result, places)
        kinds = arrays.element_kind[index]
        force = row_duals(result, places) == Dual.FORCE
        return (
            arrays.element_number[index].tolist(),
            list(map(name_of, index.tolist())),
            list(keywords_of(kinds)),
            deformations,
            list(map(deformation_word, kinds.tolist(), deformations)),
            (value * row_factors(result, places)).tolist(),
            np.where(force, "N", "N m").tolist(),
            value.tolist(),
        )

    keys = ("element", "name", "keyword", "deformation", "word", "value", "unit", "raw")
    return ModesTable(keys, result.stress_basis, columns, partial(of_self_stress, result))


def _in_given(result: Result, places: IntArray) -> tuple[IntArray, list[int]]:
    """Indices of elements in the model as given, and their deformations, of rows of D(c)."""
    element, deformation = result.raw.row_label[:, places]
    condensed = result.condensed
    if not condensed.chains:
        return condensed.elements[element - 1], deformation.tolist()
    found = list(map(cache(condensed.in_given), (element - 1).tolist(), deformation.tolist()))
    return np.array([index for index, _ in found], np.int32), [own for _, own in found]
