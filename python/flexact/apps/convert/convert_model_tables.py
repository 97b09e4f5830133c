# SPDX-License-Identifier: BSD-3-Clause
"""From a model to tables."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...core.elements import NodeKind, element_kinds
from ...deck.comments import comments_of
from ...model.data import ModelData
from .fields import ELEMENT_FIELDS, NODE_FIELDS, NODES_A_POINT
from .model_sets import ElementTables
from .model_tables import NodeTables
from .points import Points, points_of
from .remarks import Remarks


def tables_with_remarks(data: ModelData) -> tuple[dict[str, Any], Remarks]:
    """The tables of a sound model, and what they do not hold."""
    remarks, points = Remarks(), points_of(data.arrays)
    every = element_kinds()
    kinds = [every[kind - 1] for kind in data.arrays.element_kind.tolist()]
    nodes = NodeTables(data, points, kinds, remarks)
    sets, releases = ElementTables(data, kinds, remarks).sets()
    made: dict[str, Any] = {
        "nodes": nodes.places(),
        "elements": [list(ends) for ends in points.ends],
        "nprops": nodes.fields(),
        "eprops": sets,
    }
    if any(releases):
        made["opt"] = {"rls": [{"def": modes} for modes in releases]}
    if data.loads is not None and data.loads.gravity.any():
        made.setdefault("opt", {})["gravity"] = data.loads.gravity.tolist()
    _note_the_rest(data, points, remarks)
    for fields, entries in ((NODE_FIELDS, made["nprops"]), (ELEMENT_FIELDS, sets)):
        for entry in entries:
            remarks.own.update(name for name in entry if fields[name].is_own)
    if data.planar:
        remarks.own["nodes with x and y"] = len(made["nodes"])
    return made, remarks


def _note_the_rest(data: ModelData, points: Points, remarks: Remarks) -> None:
    a = data.arrays
    elements = a.element_number.size
    numbered = a.element_number.tolist() == list(range(1, elements + 1)) and all(
        node < 0 or a.node_number[node] == NODES_A_POINT * (point - 1) + slot
        for point, nodes in enumerate(points.nodes, start=1)
        for slot, node in enumerate(nodes, start=1)
    )
    if not numbered:
        what = "numbers of elements and nodes are now those of their rows"
        remarks.leave_out(what, elements + a.node_number.size)
    turned = a.node_kind == NodeKind.ORIENTATION
    upright = np.array([1.0, 0.0, 0.0, 0.0]) == a.node_value.T
    angles = (a.node_kind == NodeKind.ANGLE) & (a.node_value[0] != 0.0)
    turned = (turned & ~upright.all(axis=1)) | angles
    remarks.leave_out("reference values of orientations", int(turned.sum()))
    comments = comments_of(data.source or data.began_as)
    lines = sum(map(len, (comments.top, comments.end, comments.rest)))
    lines += sum(len(x) for part in (comments.before, comments.behind) for x in part.values())
    remarks.leave_out("lines of comment", lines)
