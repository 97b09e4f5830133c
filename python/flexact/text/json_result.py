# SPDX-License-Identifier: BSD-3-Clause
"""The result of an analysis as the JSON has it."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from functools import cache
from itertools import islice
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..base.version import VERSION
from ..core.basis import Basis
from ..core.elements import coordinate_name
from ..result.result import Result
from .warnings import warnings_of

#: Components of a mode below this part of its largest are left out.
_NEGLIGIBLE = 1.0e-14

#: How many components are handled at once.
_AT_ONCE = 100_000

#: Owner, part and value of one component of a mode.
Component = tuple[int, int | str, float]
#: Owners and parts of rows or columns of D(c).
Labels = Callable[[NDArray[np.integer]], tuple[list[int], list[Any]]]


def dictionary_of(analysis: Result) -> dict[str, Any]:
    """The names and values of the JSON, in their order."""
    made = _without_modes(analysis)
    for name, (owner, part, modes) in _modes(analysis).items():
        made[name] = [
            {"components": [{owner: n, part: which, "value": value} for n, which, value in mode]}
            for mode in modes
        ]
    return made


def text_of(analysis: Result) -> str:
    """The same as one line of text, made without a dictionary for each component."""
    return "".join(_pieces(analysis))


def _pieces(analysis: Result) -> Iterator[str]:
    modes = _modes(analysis)
    before = "{"
    for name, value in _without_modes(analysis).items():
        yield f"{before}{json.dumps(name)}: "
        if name in modes:
            yield from _pieces_of_modes(*modes[name])
        else:
            yield json.dumps(value, allow_nan=False)
        before = ", "
    yield "}"


def _pieces_of_modes(owner: str, part: str, modes: Iterator[list[Component]]) -> Iterator[str]:
    quoted = cache(json.dumps)
    before = ""
    yield "["
    for mode in modes:
        components = ", ".join(
            f'{{"{owner}": {number}, "{part}": {quoted(which)}, "value": {value!r}}}'
            for number, which, value in mode
        )
        yield f'{before}{{"components": [{components}]}}'
        before = ", "
    yield "]"


def _modes(analysis: Result) -> dict[str, tuple[str, str, Iterator[list[Component]]]]:
    """What owner and part are called, and the components of each mode."""
    raw, arrays = analysis.raw, analysis.data.arrays

    def columns(places: NDArray[np.integer]) -> tuple[list[int], list[str]]:
        node, axis = raw.column_label[:, places] - 1
        kinds = arrays.node_kind[node].tolist()
        return arrays.node_number[node].tolist(), list(map(coordinate_name, kinds, axis.tolist()))

    def rows(places: NDArray[np.integer]) -> tuple[list[int], list[int]]:
        element, deformation = raw.row_label[:, places]
        return arrays.element_number[element - 1].tolist(), deformation.tolist()

    return {
        "motions": ("node", "coordinate", _components(analysis.motion_basis, columns)),
        "self_stresses": ("element", "deformation", _components(analysis.stress_basis, rows)),
    }


def _components(basis: Basis, labels: Labels) -> Iterator[list[Component]]:
    """Components of each vector but those that are practically zero, in the order of the places."""
    begin = 0
    while begin < basis.vectors:
        room = int(basis.start[begin]) + _AT_ONCE
        end = max(begin + 1, int(np.searchsorted(basis.start, room, "right")) - 1)
        part = slice(int(basis.start[begin]), int(basis.start[end]))
        vector = np.repeat(np.arange(end - begin), np.diff(basis.start[begin : end + 1]))
        size = np.abs(basis.value[part])
        largest = np.zeros(end - begin)
        np.maximum.at(largest, vector, size)
        kept = size > _NEGLIGIBLE * largest[vector]
        owners, parts = labels(basis.place[part][kept])
        components = zip(owners, parts, basis.value[part][kept].tolist(), strict=True)
        for count in np.bincount(vector[kept], minlength=end - begin).tolist():
            yield list(islice(components, count))
        begin = end


def _without_modes(analysis: Result) -> dict[str, Any]:
    """The names and values in their order, with nothing for the modes."""
    return {
        # Bytes of a path that are no text are escaped, so that any reader of JSON takes it.
        "deck": analysis.name.encode("utf-8", "backslashreplace").decode("utf-8"),
        "flexact": VERSION,
        "verdict": analysis.verdict.value,
        "under_constrained": analysis.under_constrained,
        "over_constrained": analysis.over_constrained,
        "rank": analysis.rank,
        "rows": analysis.rows,
        "columns": analysis.columns,
        "method": analysis.method,
        "tolerance": analysis.tolerance,
        "bound": analysis.bound,
        "certainty": analysis.certainty.value,
        "nearly": analysis.nearly._asdict() if analysis.nearly else None,
        "alternatives": [item._asdict() for item in analysis.alternatives],
        "proof": analysis.proof._asdict() if analysis.proof else None,
        "gap": analysis.gap._asdict(),
        "margin": {"length": analysis.margin.length, "angle": analysis.margin.angle},
        "singular_values": analysis.singular_values.tolist(),
        "singular_values_given": analysis.singular_values_given,
        "condition_number": analysis.condition_number,
        "degrees_of_freedom": analysis.degrees_of_freedom,
        "counts": {name: part._asdict() for name, part in analysis.counts._asdict().items()},
        **_given("motions", analysis.under_constrained, analysis.raw.motions),
        **_given("self_stresses", analysis.over_constrained, analysis.raw.stresses),
        "warnings": [item.to_dict() for item in warnings_of(analysis)],
    }


def _given(name: str, count: int, basis: Basis) -> dict[str, Any]:
    """A place for modes, behind their number if not all of them are given."""
    given = {f"{name}_given": basis.vectors} if basis.vectors < count else {}
    return {**given, name: []}
