# SPDX-License-Identifier: BSD-3-Clause
"""The files of solids: of an analysis, in a motion's position where one is asked for."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from ...analysis.result import Result
from ...core.arrays import FloatArray
from ...util.outputs import OutputError
from ...util.partial import attempted
from ..drawing import Moving, move, resultants
from ..drawing.members import diverging
from .gltf import Colour, glb_bytes
from .printing import stl_bytes, threemf_bytes
from .solids import Solids, solids_of
from .step import Item, step_bytes

Write = Callable[[str, Sequence[Item], Sequence[str]], bytes]
#: What writes solids that stand still, by suffix.
STILL: dict[str, Write] = {
    ".step": step_bytes,
    ".stp": step_bytes,
    ".3mf": threemf_bytes,
    ".stl": stl_bytes,
}


def solid_bytes(
    analysis: Result,
    shown: Moving | None,
    suffix: str,
    stress: int | None = None,
    notes: list[str] | None = None,
) -> bytes:
    """The file of a model's solids.

    Args:
        analysis: The result.
        shown: A motion: its position, or in a GLB file all of it.
        suffix: One of `SOLIDS`.
        stress: Number, from 1, of the self-stress whose colours a GLB file has; by default the
            first, if any.
        notes: Takes what is to be said, sentences.

    Raises:
        OutputError: The model has no solid.
    """
    solids = solids_of(analysis)
    told = [] if notes is None else notes
    told += solids.notes
    if not solids.products:
        raise OutputError("the model has no part that is a solid")
    if suffix == ".glb":
        return _playing(solids, analysis, shown, stress, told)
    pose = solids.drawing.reference
    about = list(solids.notes)
    if shown is not None:
        movement = move(solids.drawing, shown)
        pose = movement.poses[-1]
        about.append(f"In a position of a motion, enlarged. {movement.remark}")
    items = [
        (each.name, each.names(), each.at(solids.drawing, pose), each.colour, each.opacity)
        for each in solids.products
    ]
    return STILL[suffix](solids.name, items, about)


def _playing(
    solids: Solids, analysis: Result, shown: Moving | None, stress: int | None, notes: list[str]
) -> bytes:
    movement = None if shown is None else move(solids.drawing, shown)
    about = [] if movement is None else [f"The motion is enlarged. {movement.remark}"]
    colour: Colour | None = None
    if stress is not None or len(analysis.self_stresses):
        number = stress or 1

        def coloured() -> tuple[str, Colour]:
            values = resultants(solids.drawing, analysis.self_stresses[number - 1])
            quantity = values.dominant
            largest = values.largest(quantity) or 1.0

            def colour_at(row: int, at: float) -> FloatArray:
                there = values.along(quantity, np.array([row]), np.array([at]))
                return diverging(there[0, 0] / largest)

            return quantity, colour_at

        found = attempted("The colours of the self-stress", coloured, None, notes)
        if found is not None:
            quantity, colour = found
            about.append(
                f"Colours: {quantity} of self-stress {number}, blue negative, red positive."
            )
    return glb_bytes(solids, movement, colour, about)
