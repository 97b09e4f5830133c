# SPDX-License-Identifier: BSD-3-Clause
"""From a mesh of lines to a model: each line a beam or a truss, each point a node."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np

from ...core.arrays import FloatArray
from ...model.model import Model
from .convert_mesh_files import MeshError
from .fields import AXES
from .mesh_data import INDEPENDENT, KINDS, POINT_DATA, RELEASED, TRUSS, VECTOR
from .remarks import Remarks
from .table_input import Entry
from .tables import model_of

_LINE_DATA = {**dict.fromkeys((*RELEASED, *INDEPENDENT, VECTOR), 3), TRUSS: 1}


def model_of_mesh(
    mesh: Any, *, kind: str = "beam", fixed: Iterable[int] = (), name: str = ""
) -> Model:
    """The model of a mesh of meshio; what it does not hold stands in `Model.diagnostics`.

    Args:
        mesh: With cells `line`, `line3` or `polyline`.
        kind: What a line is, "beam", "truss", "plbeam" or "pltruss", where the data `truss`
            do not say it.
        fixed: Numbers from 1 of points that are fixed, beside those that the data `fixed`, or a
            set of points of that name, say.
        name: What the model is called.

    Raises:
        MeshError: it has no lines, or its data are not as they should be.
        TablesError: points and lines are no mechanism.
        ValueError: there is no such kind.
    """
    if kind not in KINDS:
        raise ValueError(f"kind is one of {', '.join(KINDS)}, not {kind!r}")
    remarks = Remarks()
    ends, cells = _lines(mesh, remarks)
    places, data = np.asarray(mesh.points, float), dict(mesh.point_data)
    if places.ndim != 2 or places.shape[1] not in (2, 3):
        raise MeshError("points of a mesh have two or three coordinates")
    used = np.unique(ends)
    remarks.leave_out("points at which no line ends", len(places) - len(used))
    number_of = {point: i for i, point in enumerate(used.tolist(), start=1)}
    chosen = {point - 1 for point in fixed}
    if wrong := sorted(point + 1 for point in chosen if point not in number_of):
        raise MeshError(f"point {wrong[0]} is to be fixed, but no line ends at it")
    chosen.update(np.ravel(mesh.point_sets.get("fixed", ())).astype(int).tolist())
    sets, releases = _sets(len(ends), cells, kind)
    tables = {
        "nodes": _in_plane_or_space(places[used], kind),
        "elements": [[number_of[p], number_of[q]] for p, q in ends.tolist()],
        "nprops": [_node(data, point, point in chosen) for point in used.tolist()],
        "eprops": sets,
        "rls": releases,
    }
    _note_data(mesh, remarks)
    model = model_of(tables, name=name)
    found = model.data.besides + remarks.diagnostics()
    return Model.from_data(replace(model.data, besides=found)) if remarks.left_out else model


def _note_data(mesh: Any, remarks: Remarks) -> None:
    for word, known, names in (
        ("points", POINT_DATA, mesh.point_data),
        ("lines", _LINE_DATA, mesh.cell_data),
    ):
        for unknown in (each for each in names if each not in known):
            # With a colon it is what a format keeps for itself.
            remarks.leave_out(f"data of {word}: {unknown}", 0 if ":" in unknown else 1)


def _lines(mesh: Any, remarks: Remarks) -> tuple[np.ndarray, dict[str, FloatArray]]:
    """(lines, 2) indices of points, and the data of each line."""
    ends: list[tuple[int, int]] = []
    rows: dict[str, list[Any]] = {name: [] for name in mesh.cell_data if name in _LINE_DATA}
    for block, cells in enumerate(mesh.cells):
        if cells.type not in ("line", "line3", "polyline"):
            remarks.leave_out(f"cells that are no lines: {cells.type}", len(cells.data))
            continue
        for i, points in enumerate(cells.data):
            row = [int(point) for point in points]
            if cells.type == "line3":
                # The middle comes last.
                row = [row[0], row[2], row[1]]
            for pair in pairwise(row):
                ends.append(pair)
                for name, values in rows.items():
                    values.append(mesh.cell_data[name][block][i])
    if not ends:
        raise MeshError("the mesh has no lines, which are to be beams or trusses")
    made = np.array(ends)
    if made.min() < 0 or made.max() >= len(mesh.points):
        raise MeshError("a line ends at a point that is not there")
    return made, {name: _numbers(name, rows[name], _LINE_DATA[name]) for name in rows}


def _numbers(name: str, given: Any, size: int) -> FloatArray:
    try:
        made = np.asarray(given, float).reshape(len(given), -1)
    except (TypeError, ValueError):
        raise MeshError(f"data of lines: {name}: numbers are wanted") from None
    if made.shape[1] != size or not np.isfinite(made).all():
        wanted = "one finite number" if size == 1 else f"{size} finite numbers"
        raise MeshError(f"data of lines: {name}: {wanted} each are wanted")
    return made


def _node(data: Mapping[str, Any], point: int, is_fixed: bool) -> Entry:
    entry: Entry = {"fix": True} if is_fixed else {}
    for name, stem in POINT_DATA.items():
        if name not in data:
            continue
        try:
            row = np.asarray(data[name][point], float).ravel()
        except (TypeError, ValueError):
            row = np.zeros(0)
        if row.size not in (1, 3) or not np.isfinite(row).all():
            raise MeshError(f"data of points: {name}: one finite number each or three are wanted")
        if row.size == 1 and name == "fixed":
            entry.update({"fix": True} if row[0] else {})
        elif not entry.get("fix"):
            value: Any = True if stem.startswith("fix") else 0.0
            wanted = np.broadcast_to(row != 0.0, 3)
            entry.update({f"{stem}{AXES[k]}": value for k in range(3) if wanted[k]})
    return entry


def _in_plane_or_space(places: FloatArray, kind: str) -> list[list[float]]:
    if kind.startswith("pl"):
        if places.shape[1] == 3 and places[:, 2].any():
            raise MeshError(f"a {kind} lies in the xy plane, but not all points have z = 0")
        places = places[:, :2]
    elif places.shape[1] == 2:
        places = np.column_stack([places, np.zeros(len(places))])
    made: list[list[float]] = places.tolist()
    return made


def _sets(
    count: int, cells: Mapping[str, FloatArray], kind: str
) -> tuple[list[Entry], list[Entry]]:
    """Properties of lines that are alike, and the releases of each line."""
    alike: dict[str, Entry] = {}
    releases = []
    for i in range(count):
        is_truss = bool(cells[TRUSS][i, 0]) if TRUSS in cells else kind.endswith("truss")
        own = ("pl" if kind.startswith("pl") else "") + ("truss" if is_truss else "beam")
        released = _deformations(RELEASED, cells, i)
        flexible = sorted({*released, *_deformations(INDEPENDENT, cells, i)})
        entry: Entry = {"type": own}
        if flexible:
            entry["flex"] = flexible
        if VECTOR in cells and own == "beam" and cells[VECTOR][i].any():
            entry["orien"] = cells[VECTOR][i].tolist()
        alike.setdefault(repr(entry), {"elems": [], **entry})["elems"].append(i + 1)
        releases.append({"def": released} if released else {})
    return list(alike.values()), releases


def _deformations(
    names: Mapping[str, tuple[int, ...]], cells: Mapping[str, FloatArray], i: int
) -> list[int]:
    return [
        mode
        for name, modes in names.items()
        if name in cells
        for mode, value in zip(modes, cells[name][i], strict=True)
        if value
    ]
