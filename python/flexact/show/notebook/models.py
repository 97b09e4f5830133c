# SPDX-License-Identifier: BSD-3-Clause
"""A model in a notebook, before it is analysed: a picture, and what it is made of."""

from __future__ import annotations

from collections import Counter

import numpy as np

from ...analysis.naming import counted
from ...analysis.places import listed
from ...core.elements import Class, NodeKind
from ...deck.errors import ProblemsError
from ...model.data import ModelData
from ...model.parts.parts import PartKind, Parts
from ...util.partial import why
from ..page.markup import text
from ..picture import has_packages, model_bytes
from .stills import WHOLE, shown

_PLURALS = {PartKind.BODY: "bodies"}


def html_of(data: ModelData) -> str:
    """What a model is made of so far, a picture of it, and what is wrong with it."""
    name = f"<b>{text(data.name)}</b><br>" if data.name else ""
    told = "".join(f"<br>{text(each)}" for each in _problems(data) if each)
    return f"<div><p>{name}{text(_made_of(data))}{told}</p>{_picture(data)}</div>"


def _made_of(data: ModelData) -> str:
    """Such as "2 sheets and 1 body; 8 nodes, 4 of them fixed; 1 degree of freedom declared."."""
    arrays = data.arrays
    elements, nodes = arrays.element_number.size, arrays.node_number.size
    if not elements:
        return "A model without elements so far."
    kinds = Counter(part.kind for part in Parts(data).all)
    parts = listed([_counted(count, kind) for kind, count in kinds.items()])
    classes = arrays.coordinate_class
    held = np.any(classes == Class.FIXED, axis=0) & (arrays.node_kind <= NodeKind.POSITION)
    supports = int(np.count_nonzero(held))
    free = int(np.count_nonzero(classes == Class.INDEPENDENT))
    free += int(np.count_nonzero(arrays.deformation_class == Class.INDEPENDENT))
    return (
        f"{parts} ({elements} elements, {nodes} nodes); "
        f"{counted(supports, 'point', '', 's')} held; "
        f"{counted(free, 'degree', '', 's')} of freedom declared. Not analysed yet."
    )


def _counted(count: int, kind: PartKind) -> str:
    return f"{count} {kind.value if count == 1 else _PLURALS.get(kind, f'{kind.value}s')}"


def _problems(data: ModelData) -> list[str]:
    """Errors that an analysis would end with."""
    try:
        data.require_sound()
    except ProblemsError as error:
        first = error.diagnostics[0]
        return [f"It cannot be analysed yet: {first.message}.", first.help or ""]
    return []


def _picture(data: ModelData) -> str:
    if not has_packages() or not data.arrays.element_number.size:
        return ""
    try:
        content = model_bytes(data, ".png", size=WHOLE)
    except Exception as error:
        # A model that is not sound may have no drawing.
        if not data.problems.errors:
            why(error)
        return ""
    return shown(content, WHOLE, "the model in its reference shape")
