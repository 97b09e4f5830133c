# SPDX-License-Identifier: BSD-3-Clause
"""From a model to a mesh of lines, which holds beams and trusses between points."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from importlib import import_module
from typing import Any

import numpy as np

from ...core.elements import NodeKind
from ...model.model import Model
from ...util.errors import require_kind
from .convert_mesh_files import MeshError
from .convert_model_tables import tables_with_remarks
from .fields import AXES
from .mesh_data import INDEPENDENT, KINDS, POINT_DATA, RELEASED, TRUSS, VECTOR
from .remarks import Remarks
from .table_input import Entry

#: Fields of nodes that no data of points hold.
_WITHOUT_DATA = {
    *("mass", "mominertia", "name"),
    *("force", "force_initial", "moment", "moment_initial"),
}
_FIELDS = ("elems", "flex", "type", VECTOR)
_WHOLE = {
    "fix": ("fixed", "fixed_rotation"),
    "fix_pos": ("fixed",),
    "fix_orien": ("fixed_rotation",),
}


def mesh_of(model: Model) -> tuple[Any, Remarks]:
    """The mesh of meshio that holds a model, and what it does not hold.

    Raises:
        DeckError, ModelError: the model is wrong.
        MeshError: elements are neither beams nor trusses, or share points as lines cannot;
            or meshio is missing.
        TypeError: it is no model.
    """
    require_kind(model, Model, "a mesh is made of a model")
    model.check()
    tables, remarks = tables_with_remarks(model.data)
    remarks.own.clear()
    _require_lines(tables, model.planar)
    nodes: Sequence[Entry] = tables["nprops"]
    turning = bool((model.node_kinds > NodeKind.POSITION).any())
    data = [name for name in POINT_DATA if turning or not name.endswith("rotation")]
    places = np.array(tables["nodes"])
    if model.planar:
        places = np.column_stack([places, np.zeros(len(places))])
        remarks.leave_out("that it is planar: read it with --as plbeam or pltruss")
    try:
        meshio = import_module("meshio")
    except ImportError as error:
        raise MeshError(f"meshes need the package meshio: pip install meshio ({error})") from error
    for entry in nodes:
        remarks.left_out.update(f"of nodes: {name}" for name in entry if name in _WITHOUT_DATA)
    remarks.leave_out("gravity", int("gravity" in tables.get("opt", {})))
    return (
        meshio.Mesh(
            places,
            [("line", np.array(tables["elements"]) - 1)],
            point_data=_used({name: _of_nodes(nodes, name) for name in data}),
            cell_data={
                name: [values]
                for name, values in _used(_of_elements(model, tables, remarks)).items()
            },
        ),
        remarks,
    )


def _require_lines(tables: Mapping[str, Any], planar: bool) -> None:
    # All lines of a mesh are planar, or none.
    known = [kind for kind in KINDS if kind.startswith("pl") is planar]
    wrong: Counter[str] = Counter()
    for entry in tables["eprops"]:
        kind = entry.get("type", known[0])
        if kind not in known:
            wrong[f"elements of kind {kind}"] += len(entry["elems"])
    for entry in tables["nprops"]:
        for name, words in (("same_pos", "position"), ("same_orien", "orientation")):
            if name in entry:
                wrong[f"points that share the {words} of another one"] += 1
    if wrong:
        words = ", ".join(f"{what} ({count})" for what, count in wrong.items())
        raise MeshError(f"a mesh of lines cannot say: {words}; tables (.json, .yaml) can")


def _of_nodes(nodes: Sequence[Entry], name: str) -> np.ndarray:
    made = np.zeros((len(nodes), 3))
    for i, entry in enumerate(nodes):
        stem = POINT_DATA[name]
        made[i] = [f"{stem}{axis}" in entry for axis in AXES]
        if any(entry.get(whole) and name in names for whole, names in _WHOLE.items()):
            made[i] = 1.0
    return made


def _of_elements(
    model: Model, tables: Mapping[str, Any], remarks: Remarks
) -> dict[str, np.ndarray]:
    count = len(tables["elements"])
    made: dict[str, np.ndarray] = {VECTOR: np.zeros((count, 3)), TRUSS: np.zeros(count)}
    classes = model.deformation_classes
    for names, value in ((RELEASED, 2), (INDEPENDENT, 3)):
        for name, modes in names.items():
            made[name] = (classes[:, [mode - 1 for mode in modes]] == value).astype(float)
    for entry in tables["eprops"]:
        rows = np.array(entry["elems"]) - 1
        made[VECTOR][rows] = entry.get(VECTOR, 0.0)
        made[TRUSS][rows] = entry.get("type", "beam").endswith("truss")
        for name in (each for each in entry if each not in _FIELDS):
            remarks.leave_out(f"of elements: {name}", len(rows))
    return made


def _used(data: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Data that say something."""
    return {name: values for name, values in data.items() if values.any()}
