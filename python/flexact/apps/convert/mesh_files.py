# SPDX-License-Identifier: BSD-3-Clause
"""From a mesh of lines to a model: each line a beam or a truss, each point a node."""

from __future__ import annotations

import contextlib
import io
import tempfile
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from importlib import import_module
from itertools import pairwise
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from ...core.arrays import FloatArray
from ...core.elements import NodeKind
from ...model.model import Model
from ...util.errors import BatchError, require_kind
from ...util.text import harmless
from .model_tables import tables_with_remarks
from .table_input import LETTERS, Entry, Remarks
from .tables import model_of

#: What a line can be.
KINDS = ("beam", "truss", "plbeam", "pltruss")
#: Of points, with the fields of tables that they stand for, but for the axis.
POINT_DATA = {
    "fixed": "fix_",
    "fixed_rotation": "fix_r",
    "independent": "displ_",
    "independent_rotation": "rot_",
}
#: Of lines: the deformations that are released, or independent.
RELEASED = {"released": (1, 2, 3), "released_bending": (4, 5, 6)}
INDEPENDENT = {"independent_deformation": (1, 2, 3), "independent_bending": (4, 5, 6)}
#: Of lines: the vector along local y; 1 where it is a truss.
VECTOR, TRUSS = "orien", "truss"


class MeshError(BatchError):
    """A mesh that cannot be read, written or taken for a mechanism."""

    def __init__(self, words: str) -> None:
        """Why not; names of the file in it move no cursor."""
        super().__init__(harmless(words))


def suffixes() -> tuple[str, ...]:
    """Those that meshio knows, without decks'."""
    return tuple(sorted(set(_meshio().extension_to_filetypes) - {".dat"}))


def read_mesh(path: Path) -> Any:
    """A mesh of meshio from a file.

    Raises:
        MeshError: it cannot be read, or meshio is missing.
    """
    meshio = _meshio()
    if not path.is_file():
        raise MeshError(f"{path}: there is no such file")
    said = io.StringIO()
    try:
        with _in_silence() as said:
            return meshio.read(path)
    except MemoryError:
        raise
    except (Exception, SystemExit) as error:
        # Where it ends the process, it has printed why.
        words = str(error) if isinstance(error, Exception) else ""
        words = words or next(iter(said.getvalue().strip().splitlines()), "")
        reason = " ".join(words.split())[:200] or type(error).__name__
        raise MeshError(f"{path}: meshio cannot read this mesh: {reason}") from error


def mesh_bytes(mesh: Any, suffix: str) -> tuple[bytes, tuple[str, ...]]:
    """The file that holds a mesh of lines, and names of the data that it lost.

    Of the formats that a suffix may mean, it is the first that holds lines.

    Raises:
        MeshError: meshio has no such format or cannot write this one, or is missing.
    """
    meshio = _meshio()
    if suffix not in suffixes():
        raise MeshError(f"meshio writes no {suffix or 'file without a suffix'}: try .vtu or .vtk")
    reason = ""
    for form in meshio.extension_to_filetypes[suffix]:
        with tempfile.TemporaryDirectory(prefix="flexact-") as folder:
            path = Path(folder) / f"mesh{suffix}"
            try:
                with _in_silence():
                    meshio.write(path, mesh, file_format=form)
                return path.read_bytes(), _lost(mesh, path, form)
            except MemoryError:
                raise
            except (Exception, SystemExit) as error:
                reason = " ".join(str(error).split())[:200] or type(error).__name__
    raise MeshError(f"meshio writes no {suffix} of lines: {reason}; try .vtu or .vtk")


def _lost(mesh: Any, path: Path, form: str) -> tuple[str, ...]:
    """Names of the data that a file has lost, with what of the points it has."""
    if len(list(path.parent.iterdir())) > 1:
        raise MeshError("the mesh is several files")
    with _in_silence():
        again = _meshio().read(path, file_format=form)
    lines = sum(len(cells.data) for cells in again.cells if cells.type == "line")
    if lines != sum(len(cells.data) for cells in mesh.cells):
        raise MeshError("it holds no lines")
    lost = [name for name in mesh.point_data if name not in again.point_data]
    lost += [name for name in mesh.cell_data if name not in again.cell_data]
    if not np.array_equal(np.asarray(again.points, float), mesh.points):
        lost.append("the last digits of coordinates")
    return tuple(lost)


@contextlib.contextmanager
def _in_silence() -> Iterator[io.StringIO]:
    """Keep what meshio prints from who reads results; it prints why it fails."""
    said = io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
        yield said


def _meshio() -> ModuleType:
    try:
        return import_module("meshio")
    except ImportError as error:
        raise MeshError(f"meshes need the package meshio: pip install meshio ({error})") from error


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
    for word, known, names in (
        ("points", POINT_DATA, mesh.point_data),
        ("lines", _LINE_DATA, mesh.cell_data),
    ):
        for unknown in (each for each in names if each not in known):
            # With a colon it is what a format keeps for itself.
            remarks.leave_out(f"data of {word}: {unknown}", int(":" not in unknown))
    model = model_of(tables, flexible="independent", name=name)
    found = model.data.besides + remarks.diagnostics()
    return Model.from_data(replace(model.data, besides=found)) if remarks.left_out else model


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
            entry.update({f"{stem}{LETTERS[k]}": value for k in range(3) if wanted[k]})
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
        own = f"{'pl' * kind.startswith('pl')}{'truss' if is_truss else 'beam'}"
        released = _deformations(RELEASED, cells, i)
        flexible = sorted({*released, *_deformations(INDEPENDENT, cells, i)})
        entry: Entry = {"type": own, **({"flex": flexible} if flexible else {})}
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
    meshio = _meshio()
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
    whole = [field for field, names in _WHOLE.items() if name in names]
    rows = [
        [any(map(entry.get, whole)) or f"{POINT_DATA[name]}{axis}" in entry for axis in LETTERS]
        for entry in nodes
    ]
    return np.array(rows, float).reshape(-1, 3)


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
