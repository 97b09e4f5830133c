# SPDX-License-Identifier: BSD-3-Clause
"""Variants of one topology, by their positions or by what they hold."""

from __future__ import annotations

import numpy as np

from ..core.arrays import BoolArray, FloatArray
from ..core.progress import Progress
from ..diagnostics.errors import DeckError, ModelError
from ..model.data import ModelData
from ..model.variation import with_held, with_positions
from ..result.decompose import AnalysisError
from ..result.outcome import Asked
from ..result.result import result_of
from .columns import columns_of
from .row import Value, error_row, row_of

Array = np.ndarray


def swept(
    data: ModelData,
    *,
    positions: FloatArray | None = None,
    held: BoolArray | None = None,
    want: str = "values",
    workers: int | None = None,
    progress: Progress | None = None,
) -> dict[str, Array]:
    """The columns of a table for variants of a model, by name, each of (variants,).

    Args:
        data: A sound model.
        positions: (variants, nodes, 3) [m], as `positions_given` gives them.
        held: (variants, elements, 6), as `held_given` gives them; one of the two at least.
        want: One of `WANTS`.
        workers: So many threads at most; by default one a processor.
        progress: Called with what is being done and how much of that is done, from 0 to 1.
    """
    count = len(positions) if positions is not None else len(held if held is not None else ())
    rows = []
    for i in range(count):
        one = data if positions is None else with_positions(data, positions[i])
        one = one if held is None else with_held(one, held[i])
        rows.append(_row(one, want))
    return {
        column.name: np.array([row[column.name] for row in rows], column.kind)
        for column in (*columns_of(want),)
    } | {"error": np.array([row["error"] for row in rows], str)}


def _row(data: ModelData, want: str) -> dict[str, Value]:
    try:
        return row_of(result_of(data, Asked()), want)
    except (AnalysisError, DeckError, ModelError) as error:
        return error_row(str(error), want)
