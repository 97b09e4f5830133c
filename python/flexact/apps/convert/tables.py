# SPDX-License-Identifier: BSD-3-Clause
"""Tables in the style of SPACAR Light: nodes, elements, and properties of both.

    tables = {
        "nodes": [[0, 0, 0], [0, 0.1, 0]],
        "elements": [[1, 2]],
        "nprops": [{"fix": True}, {}],
        "eprops": [{"elems": [1], "flex": [2, 3, 4], "orien": [0, 0, 1]}],
        "opt": {"rls": [{"def": [2, 3, 4]}]},
    }

Nodes and elements are numbered by their rows, from 1. SPACAR Light and its documentation:
spacar.nl and github.com/precision-utwente/spalight, by M. Nijenhuis and M. Naves.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ...core.elements import Class
from ...deck.diagnostics import Diagnostic
from ...model.model import Model
from ...util.errors import require_kind
from .model_tables import tables_with_remarks
from .table_input import tables_given
from .table_model import data_of
from .values import Found, TablesError, Text

__all__ = ["TablesError", "model_of", "tables_of"]

#: No table has values in each other more deeply.
_DEEPEST = 10
#: What flexible deformations that are not released can be.
FLEXIBLE = {"independent": Class.INDEPENDENT, "released": Class.DEPENDENT}


def model_of(
    tables: Mapping[str, Any],
    *,
    flexible: str = "independent",
    name: str = "",
    text: Text | None = None,
) -> Model:
    """The model of tables; what it does not hold stands in `Model.diagnostics`, as notes.

    A node is a position and an orientation. An element is a beam, or `nbeams` of them in a row.
    `fix` and its like fix coordinates, `displ_x` and `rot_x` and their like make them independent,
    whatever their values. Of a beam the deformations in `rls(i).def` are released, of one that is
    divided those of its last beam; the others in `flex` are what `flexible` says, and the rest are
    held.

    Args:
        tables: `nodes`, `elements`, and perhaps `nprops`, `eprops`, `rls` and `opt`; lists or
            arrays, as of a JSON that MATLAB's jsonencode has made. Of `nprops`, `eprops` and
            `rls` each entry is an object; of few, an object by number will do.
        flexible: "independent", degrees of freedom, as SPACAR Light has them; or "released", as a
            designer asks whether the mechanism is exactly constrained.
        name: What the model is called, where the tables do not say it.
        text: What the tables were read from, for the lines of problems.

    Raises:
        TablesError: anything is wrong with the tables; all of it, each with its place.
        TypeError: they are no mapping.
        ValueError: `flexible` is neither.
    """
    require_kind(tables, Mapping, "tables are a mapping")
    if flexible not in FLEXIBLE:
        raise ValueError(f"flexible is one of {', '.join(FLEXIBLE)}, not {flexible!r}")
    found = Found(text or Text(), name)
    checked = tables_given({key: _plain(value) for key, value in tables.items()}, found)
    found.require_none()
    checked.name = checked.name or name
    return Model.from_data(data_of(checked, FLEXIBLE[flexible], found))


def _plain(value: Any, depth: int = 0) -> Any:
    """Lists and numbers in place of numpy's, as deep as tables go."""
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    if depth < _DEEPEST and isinstance(value, Mapping):
        return {key: _plain(each, depth + 1) for key, each in value.items()}
    if depth < _DEEPEST and isinstance(value, (list, tuple)):
        return [_plain(each, depth + 1) for each in value]
    return value


def tables_of(model: Model, remarks: list[Diagnostic] | None = None) -> dict[str, Any]:
    """The tables of a model, of lists, numbers and text alone.

    D(c) of `model_of` them is that of the model but for the order of its rows and columns.

    Args:
        model: The model.
        remarks: Gets a note each of what the tables do not hold, and of fields that only
            Flexact knows.

    Raises:
        DeckError, ModelError: the model is wrong.
        TypeError: it is no model.
    """
    require_kind(model, Model, "tables are made of a model")
    model.check()
    made, noted = tables_with_remarks(model.data)
    if remarks is not None:
        remarks.extend(noted.diagnostics())
    return made
