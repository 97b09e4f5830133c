# SPDX-License-Identifier: BSD-3-Clause
"""The table of flexures: what is between what, where and how large; written, and read back.

A row is a flexure, or says of a point what is fixed or driven there. Its ends are called by what
holds them: a body, a clamp, or a joint that is nothing but the flexures that meet there. Ends of
one name at one place are one point, and of one name at several places a body; what begins with
"clamp" or "ground" is fixed.
"""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Iterable, Iterator, Sequence
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from ...core.elements import AXES, Class, Member, NodeKind, Role, coordinate_name, element_kinds
from ...core.raw import ElementKind
from ...deck.diagnostics import Diagnostic, Place, Source
from ...deck.rendering import ModelError
from ...model.data import CrossSection, ModelData
from ...model.deformations import WIDE_Y, WIDE_Z, Planes, word_of
from ...model.draft import Shape
from ...model.handles import Element, Node, Part
from ...model.model import Model
from ...model.names import nearest
from ...model.parts.forms import AT_P, AT_Q
from ...model.parts.parts import Part as FoundPart
from ...model.parts.parts import PartKind, Parts
from ...show.writers import FLEXURES
from ...util.errors import BatchError
from ...util.text import in_short
from ...util.units import METRES, MILLIMETRES
from .table_input import Found, Remarks, density_of, is_ordinary, moduli_of

CSV, XLSX = SUFFIXES = FLEXURES
KINDS = ("sheet", "wire", "bar", "beam", "hinge", "ball joint", "point")
_HINGED = ("hinge", "ball joint")
_TEXTS = ("kind", "name", "from", "to", "released", "declared", "fixed", "driven")
_PLACES = tuple(f"{axis}{end}" for end in "12" for axis in "xyz")
_POSITIVE = ("length", "width", "thickness", "beams", "E", "G")
_DIRECTION = tuple(f"direction {axis}" for axis in "xyz")
#: Columns in their order, with the SI units of those that have one.
_COLUMNS = {
    **dict.fromkeys(("kind", "name", "from", "to"), ""),
    **dict.fromkeys(("length", "width", "thickness", *_PLACES), "m"),
    **dict.fromkeys((*_DIRECTION, "beams", "released", "declared", "fixed", "driven"), ""),
    **{"E": "Pa", "G": "Pa", "density": "kg/m3"},
}
#: Bendings of a sheet by number, as `Model.sheet` makes it: its width is along local z.
_IN_SHEET = {
    f"{plane}-plane bending at {end}": number
    for plane, numbers in (("in", (3, 4)), ("out-of", (5, 6)))
    for end, number in zip(("from", "to"), numbers, strict=True)
}
_OFFSETS = (Role.OFFSET_X, Role.OFFSET_Y, Role.OFFSET_Z)
#: What is called so holds for good.
_HELD = ("clamp", "ground")
#: Ends nearer to each other than this part of the largest coordinate are one point.
_SAME = 1e-9
#: By so much of it a length that is typed may differ from the distance of its ends.
_TYPED = 1e-3
#: A file of so many bytes is no table that somebody has written.
_MOST_BYTES = 2**28

Row = dict[str, Any]


def _words_of(
    kind: ElementKind, classes: Sequence[int], value: Class, planes: Planes | None
) -> list[str]:
    """The deformations of a class in words; `planes` are those of a sheet."""
    made: dict[str, list[str]] = {}
    for role, found in zip(kind.role, classes, strict=True):
        if role and found == value:
            end = "from" if role in AT_P else "to" if role in AT_Q else ""
            made.setdefault(word_of(Role(role), planes), []).append(end)
    return [
        word if len(ends) != 1 or not ends[0] else f"{word} at {ends[0]}"
        for word, ends in made.items()
    ]


def _usual(kind: str, planar: bool) -> list[str]:
    """What a flexure of a kind releases, where its row says nothing else."""
    if kind == "sheet":
        return ["bending"] if planar else ["twist", "out-of-plane bending"]
    if kind == "wire":
        return ["twist", "bending about y", "bending about z"]
    return ["rotation"] if kind == "hinge" else []


class _Writing:
    """The rows of a model."""

    def __init__(self, data: ModelData) -> None:
        self.data, self.parts, self.remarks = data, Parts(data), Remarks()
        self.slots = data.arrays.element_node - 1
        self.labels: dict[tuple[str, int], str] = {}
        self.known: set[str] = set()
        #: Labels of what ends at each position node, and pairs of these that a hinge joins.
        self.ends_at: dict[int, dict[str, None]] = {}
        self.hinged: set[tuple[int, frozenset[str]]] = set()
        #: Where orientations stand that are only at a hinge.
        self.placed: dict[int, int] = {}

    def rows(self) -> list[Row]:
        """Flexures in the order of the model, then joints and points."""
        made = [self.flexure(each) for each in self.parts.all if each.kind is not PartKind.BODY]
        for k, body in enumerate(self.parts.bodies):
            for position in body.positions:
                self.ends_at.setdefault(position, {})[self._body(k, position)] = None
        for position, labels in sorted(self.ends_at.items()):
            joined: list[str] = []
            for label in labels:
                pairs = ((position, frozenset((label, other))) for other in joined)
                if joined and not self.hinged.intersection(pairs):
                    made.append(self._row("ball joint", "", (position,), joined[0], label))
                joined.append(label)
        return [*made, *self.points()]

    def _row(self, kind: str, name: str, ends: Sequence[int], *labels: str) -> Row:
        row: Row = {"kind": kind, "name": name, **dict(zip(("from", "to"), labels, strict=False))}
        for end, position in zip("12", ends, strict=False):
            for k, axis in enumerate("xy" if self.data.planar else "xyz"):
                value = float(self.data.arrays.node_value[k, position])
                row[f"{axis}{end}"] = self.data.units.shown(value, "m") + 0.0
        return row

    def flexure(self, part: FoundPart) -> Row:
        """The row of a sheet, wire, bar, beam or hinge."""
        data, first = self.data, part.elements[0]
        kind = element_kinds()[data.arrays.element_kind[first] - 1]
        p, op, q, oq = self.slots[:, first].tolist()
        classes: Sequence[int] = data.arrays.deformation_class[:, first].tolist()
        planes: Planes | None = None
        if part.kind is PartKind.HINGE:
            place = self._place_of_hinge(p, op, oq)
            row = self._row(
                "hinge", part.name, (place,), self._end(place, op), self._end(place, oq)
            )
            self.hinged.add((place, frozenset((row["from"], row["to"]))))
            direction = data.arrays.element_vector[:, first]
            offsets = [k for k, role in enumerate(kind.role) if role in _OFFSETS]
            self.remarks.lose(
                "displacements of bearings", int(any(classes[k] != 1 for k in offsets))
            )
            classes = [Class.NONE if k in offsets else value for k, value in enumerate(classes)]
        else:
            chain = next((each for each in data.chains if each.elements == part.elements), None)
            if chain is not None:
                p, op, q, oq = chain.ends
                inner = chain.condensed_classes
                self.remarks.lose("releases inside divided flexures", int(inner is None))
                classes = inner or chain.classes[0]
            ends = self._end(p, op), self._end(q, oq)
            row = self._row(part.kind.value, part.name, (p, q), *ends)
            row["length"] = data.units.shown(
                math.dist(*(data.arrays.node_value[:3, (p, q)].T)), "m"
            )
            wide = int(self.parts.wide[first])
            direction = data.frames.frame[first][:, wide or 1]
            if len(part.elements) > 1:
                row["beams"] = len(part.elements)
            if part.kind is PartKind.SHEET and not data.planar:
                planes = WIDE_Z if wide == 2 else WIDE_Y
            self._sizes(row, part, kind, wide)
        if not data.planar and kind.member in (Member.BEAM, Member.HINGE):
            row |= {name: float(v) + 0.0 for name, v in zip(_DIRECTION, direction, strict=True)}
        free, declared = (
            _words_of(kind, classes, value, planes)
            for value in (Class.DEPENDENT, Class.INDEPENDENT)
        )
        if declared:
            row["declared"] = ", ".join(declared)
        usual = set(_split(_usual(part.kind.value, data.planar)))
        if set(_split(free)) != usual - set(_split(declared)):
            row["released"] = ", ".join(free) or "none"
        return row

    def _place_of_hinge(self, position: int, *orientations: int) -> int:
        """The position node at which both sides of a hinge are.

        A side that is at no place is between two hinges at one point, or the ground, which is
        where the other side is held.
        """
        if position >= 0:
            return position
        reached, front, alone = set(orientations), list(orientations), []
        places: list[set[int]] = []
        while front:
            node = front.pop()
            if where := self._places_of(node):
                places.append(where)
                continue
            alone.append(node)
            ends = self.slots[[1, 3]][:, (self.slots[[0, 2]] < 0).all(axis=0)]
            beside = set(ends[:, (ends == node).any(axis=0)].ravel().tolist()) - reached
            reached |= beside
            front += beside
        if len(places) == 1:
            places.append({node for node in places[0] if self.parts.is_held(node)})
        both = set.intersection(*places) if places else set()
        self.remarks.lose("hinges whose sides have no point in common", int(not both))
        place = min(both or set().union(*places) or {0})
        self.placed |= dict.fromkeys(alone, place)
        return place

    def _places_of(self, orientation: int) -> set[int]:
        """Position nodes at which an orientation is, or the body that it turns with."""
        body = self.parts.body_at.get(orientation)
        found = set(self.parts.bodies[body].positions) if body is not None else set()
        used = np.argwhere(self.slots[[1, 3]] == orientation)
        return (found | {int(self.slots[2 * side, i]) for side, i in used}) - {-1}

    def _end(self, position: int, orientation: int) -> str:
        label = self._label(position, orientation)
        self.ends_at.setdefault(position, {})[label] = None
        return label

    def _label(self, position: int, orientation: int) -> str:
        """What holds an end: a body, a clamp, or a joint."""
        parts = self.parts
        if orientation < 0:
            if position in parts.body_at:
                return self._body(parts.body_at[position], position)
            orientation = next(iter(parts.orientations_at.get(position, ())), -1)
        body = parts.body_at.get(orientation)
        if body is not None:
            return self._body(body, position)
        name = parts.name_of_point(position)
        if parts.is_held(position) and (orientation < 0 or parts.is_held(orientation)):
            return self._named(("clamp", position), name, "clamp")
        return self._named(("joint", orientation if orientation >= 0 else -position - 1), name)

    def _body(self, body: int, position: int) -> str:
        nodes = (*self.parts.bodies[body].positions[:1], *self.parts.bodies[body].orientations[:1])
        held = all(self.parts.is_held(node) for node in nodes)
        return self._named(("body", body), self.parts.of_body(body).name, "clamp" * held)

    def _named(self, carrier: tuple[str, int], name: str, held: str = "") -> str:
        """A label of its own for what carries ends; what is held begins as `_HELD` says."""
        if carrier not in self.labels:
            if held and not name.startswith(_HELD):
                name = f"{held} {name}".strip()
            elif not held and (name.startswith(_HELD) or not name):
                name = f"{'body' if carrier[0] == 'body' else 'joint'} {name}".strip()
            made, count = name, 1
            while made in self.known or made in ("clamp", "joint"):
                made, count = f"{name} {count}", count + 1
            self.known.add(made)
            self.labels[carrier] = made
        return self.labels[carrier]

    def _sizes(self, row: Row, part: FoundPart, kind: ElementKind, wide: int) -> None:
        """Width, thickness and material."""
        data, i = self.data, part.elements[0]
        sizes = data.appearance.dimensions[list(part.elements)]
        self.remarks.leave_out("sections that change along a flexure", int(np.ptp(sizes, 0).any()))
        shape = Shape(CrossSection(int(data.appearance.cross_section[i])), *sizes[0].tolist())
        if shape.kind not in (CrossSection.RECT, CrossSection.CIRC) or not is_ordinary(shape):
            self.remarks.leave_out("other cross-sections", int(bool(shape.kind)))
            return
        width, thickness = (shape.z, shape.y) if wide == 2 else (shape.y, shape.z)
        if shape.kind is CrossSection.RECT:
            row["width"] = data.units.shown(width, "m")
        row["thickness"] = data.units.shown(thickness, "m")
        given = data.properties
        if given is None:
            return
        stiff, heavy = (
            tuple(each[~np.isnan(each)].tolist()) for each in (given.stiffness[i], given.mass[i])
        )
        moduli = moduli_of(kind, shape, stiff) if stiff else None
        density = density_of(kind, shape, heavy) if heavy else None
        if moduli is not None:
            row["E"], row["G"] = (data.units.shown(moduli[0][n], "Pa") for n in ("emod", "smod"))
        self.remarks.leave_out(
            "stiffness that no moduli and cross-section give", int(bool(stiff) and moduli is None)
        )
        if density is not None:
            row["density"] = density
        for name, words in (
            ("strength", "strengths"),
            ("expansion", "coefficients of expansion"),
            ("fillet", "radii of fillets"),
        ):
            self.remarks.leave_out(words, int(not np.isnan(getattr(given, name)[i, 0])))

    def points(self) -> Iterator[Row]:
        """What is driven at a point, and what is fixed of one that is no clamp."""
        a, found = self.data.arrays, dict[tuple[int, str], Row]()
        for node, kind in enumerate(a.node_kind.tolist()):
            said: dict[Class, list[str]] = {Class.FIXED: [], Class.INDEPENDENT: []}
            for axis in AXES[kind]:
                value = Class(int(a.coordinate_class[axis, node]))
                if value in said:
                    said[value].append(coordinate_name(kind, axis))
            position = self.placed.get(node, self.parts.place_of(node))
            if not any(said.values()) or position is None:
                self.remarks.lose("what is fixed or driven at no place", int(any(said.values())))
                continue
            label = self._label(position, -1 if kind <= NodeKind.POSITION else node)
            if label.startswith(_HELD):
                continue
            name = self.parts.name_of_point(position)
            mine = found.setdefault((position, label), self._row("point", name, (position,), label))
            for column, value in (("fixed", Class.FIXED), ("driven", Class.INDEPENDENT)):
                if said[value]:
                    mine[column] = ", ".join([*_split([mine.get(column, "")]), *said[value]])
        given = self.data.properties
        if given is not None:
            count = int((~np.isnan(given.node_mass[:, 0])).sum())
            self.remarks.leave_out("masses of points", count)
            hinges = element_kinds()
            self.remarks.leave_out(
                "stiffness of hinges, and contours of notches",
                sum(
                    hinges[kind - 1].member == Member.HINGE and value == value
                    for kind, value in zip(
                        a.element_kind.tolist(), given.stiffness[:, 0].tolist(), strict=True
                    )
                ),
            )
        loads = self.data.loads
        self.remarks.leave_out("loads", 0 if loads is None else int(loads.force.any(1).sum()))
        return iter(found.values())


def _split(words: Iterable[str]) -> list[str]:
    """Words that stand between commas; a bending at both ends is one at each."""
    made = []
    for word in (each.strip() for text in words for each in text.split(",")):
        both = "bending" in word and " at " not in word
        made += [f"{word} at from", f"{word} at to"] if both else [word] if word else []
    return made


def bytes_of_flexures(model: Model, suffix: str) -> tuple[bytes, tuple[Diagnostic, ...]]:
    """The table of a model's flexures as a file, and notes of what it does not hold.

    Raises:
        DeckError, ModelError: the model is wrong.
        BatchError: a package is missing.
    """
    model.check()
    return table_of_flexures(model.data, suffix)


def table_of_flexures(data: ModelData, suffix: str) -> tuple[bytes, tuple[Diagnostic, ...]]:
    """The same of the data of a sound model.

    Raises:
        BatchError: a package is missing.
    """
    writing = _Writing(data)
    rows, units = writing.rows(), data.units
    shown = [name for name in _COLUMNS if any(row.get(name, "") != "" for row in rows)]
    heads = [
        f"{name} [{units.symbol(_COLUMNS[name])}]" if _COLUMNS[name] else name for name in shown
    ]
    lines: list[list[Any]] = [heads, *([row.get(name, "") for name in shown] for row in rows)]
    if suffix == CSV:
        text = io.StringIO()
        csv.writer(text, lineterminator="\n").writerows(lines)
        return text.getvalue().encode("utf-8", "backslashreplace"), writing.remarks.diagnostics()
    book = _openpyxl().Workbook()
    sheet = book.active
    sheet.title = "flexures"
    for line in lines:
        sheet.append([None if value == "" else value for value in line])
    sheet.freeze_panes = "C2"
    for k, name in enumerate(shown, start=1):
        wide = max(len(str(line[k - 1])) for line in lines[:50])
        sheet.column_dimensions[sheet.cell(1, k).column_letter].width = min(wide, 24) + 2
        sheet.cell(1, k).font = import_module("openpyxl.styles").Font(bold=True)
        if _COLUMNS[name] == "m":
            for cells in sheet.iter_rows(min_row=2, min_col=k, max_col=k):
                cells[0].number_format = "0.######"
    made = io.BytesIO()
    book.save(made)
    return made.getvalue(), writing.remarks.diagnostics()


def _openpyxl() -> ModuleType:
    try:
        return import_module("openpyxl")
    except ImportError as error:
        raise BatchError(
            f"tables of Excel need the package openpyxl: pip install openpyxl ({error}); "
            "a .csv does not"
        ) from error


#: Cells of a line by column, from 0, and where each stands.
_Line = tuple[int, list[tuple[Any, Place]]]


def _lines_of_csv(text: str) -> list[_Line]:
    """Lines with their cells; what separates them is what the first line has most of."""
    first = text.partition("\n")[0]
    separator = max(";\t,", key=first.count)
    cell = re.compile(f'("(?:[^"]|"")*"|[^{separator}]*)(?:{separator}|$)')
    made = []
    for number, line in enumerate(text.splitlines(), start=1):
        cells, at = [], 0
        while at <= len(line):
            found = cell.match(line, at)
            assert found is not None
            value = found[1].strip()
            if value.startswith('"') and value.endswith('"') and len(value) > 1:
                value = value[1:-1].replace('""', '"').strip()
            if separator == ";" and re.fullmatch(r"[-+0-9.eE]*,[-+0-9eE]+", value):
                value = value.replace(",", ".")
            cells.append((value, Place(number, at + 1, max(found.end(1), at + 1))))
            at = max(found.end(), at + 1) if found.end() < len(line) else len(line) + 1
            if found.end() == len(line) and line.endswith(separator) and found[0]:
                break
        made.append((number, cells))
    return made


def _lines_of_xlsx(raw: bytes, path: Path) -> list[_Line]:
    openpyxl = _openpyxl()
    try:
        book = openpyxl.load_workbook(io.BytesIO(raw), read_only=True, data_only=True)
        rows = list(book.worksheets[0].iter_rows(values_only=True))
    except Exception as error:
        raise BatchError(f"{path}: this is no workbook of Excel: {error}") from None
    nowhere = Place(0, 0, 0)
    return [
        (number, [("" if value is None else value, nowhere) for value in row])
        for number, row in enumerate(rows, start=1)
    ]


def model_of_flexures(raw: bytes, path: Path) -> Model:
    """The model of a table of flexures.

    Raises:
        TablesError: anything is wrong with it; all of it, each with its place.
        BatchError: it cannot be read at all, or a package is missing.
    """
    if len(raw) > _MOST_BYTES:
        raise BatchError(f"{path}: this is too large to be a table of flexures")
    if path.suffix.lower() == XLSX:
        return _Reading(_lines_of_xlsx(raw, path), Found(None, str(path)), path.stem, {}).model()
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = raw.decode("cp1252", "replace")
    lines = _lines_of_csv(text)
    source = Source(text.encode(), str(path))
    places: dict[str, Place] = {}
    return _Reading(lines, Found((source, lambda: places), str(path)), path.stem, places).model()


class _Reading:
    """The model of rows, as it grows."""

    def __init__(
        self, lines: list[_Line], found: Found, name: str, places: dict[str, Place]
    ) -> None:
        """Begin; `places` gets where each line and cell stands."""
        self.found, self.name, self.places = found, name, places
        self.lines = [line for line in lines if any(value != "" for value, _ in line[1])]
        self.columns: dict[int, str] = {}
        self.units, self.planar = METRES, False
        for number, cells in self.lines:
            last = cells[-1][1].last_column if cells else 1
            whole = Place(cells[0][1].line, 1, last) if cells[0][1].line else cells[0][1]
            self.places[f"row {number}"] = whole
        self.points: dict[str, list[tuple[tuple[float, ...], Node]]] = {}
        self.joint_at: dict[tuple[float, ...], Node] = {}

    def model(self) -> Model:
        """The model.

        Raises:
            TablesError: anything is wrong.
        """
        if not self.lines:
            self.found.error("", "there is no table: the first line has the names of the columns")
        else:
            self._take_header(*self.lines[0])
        self.found.require_none()
        rows = [row for line in self.lines[1:] if (row := self._row(*line)) is not None]
        if len(self.lines) == 1:
            self.found.error("", "the table has no rows: each flexure is one")
        largest = max((abs(r.get(c, 0.0)) for r in rows for c in _PLACES), default=0.0)
        self.near = _SAME * largest
        self.made = Model(planar=self.planar, name=self.name, units=self.units)
        for wanted in (True, False):
            for row in rows:
                if (row["kind"] in _HINGED) == wanted:
                    self._tried(row, self._add)
        self.found.require_none()
        self._add_bodies()
        for row in rows:
            if row["kind"] == "point":
                self._tried(row, self._say_of_point)
        self.found.require_none()
        return self.made

    def _take_header(self, number: int, cells: list[tuple[Any, Place]]) -> None:
        units: dict[str, tuple[str, str]] = {}
        for k, (value, place) in enumerate(cells):
            name, _, unit = str(value).partition("[")
            name, unit = name.strip(), unit.strip(" ]")
            known = {each.lower(): each for each in (*_COLUMNS, "material")}
            column = known.get(name.lower(), "")
            where = f"row {number}, column {k + 1}"
            self.places[where] = place
            if not name:
                continue
            if not column:
                near = nearest(name, tuple(known.values()))[:1]
                more = f"; did you mean {near[0]}?" if near else ""
                self.found.error(where, f"there is no column {in_short(name)}{more}")
            elif column in self.columns.values():
                self.found.error(where, f"the column {column} stands there twice")
            self.columns[k] = column
            if _COLUMNS.get(column):
                units[where] = column, unit
        for column in ("kind", "from", "x1", "y1"):
            if column not in self.columns.values():
                self.found.error(f"row {number}", f"the column {column} is missing")
        self.planar = "z1" not in self.columns.values()
        lengths = [unit for column, unit in units.values() if _COLUMNS[column] == "m"]
        if MILLIMETRES.name in lengths:
            self.units = MILLIMETRES
        for where, (column, unit) in units.items():
            wanted = self.units.symbol(_COLUMNS[column])
            if unit != wanted:
                words = f"a unit of {column} is wanted: {column} [{wanted}]"
                said = f"; [{unit}] is none that is known here" if unit else ""
                self.found.error(where, f"{words}{said}, with all lengths in mm or all in m")

    def _row(self, number: int, cells: list[tuple[Any, Place]]) -> Row | None:
        """The checked cells of a line, empty ones left out; None where something is wrong."""
        made: Row = {"number": number, "kind": ""}
        wrong: list[tuple[str, str]] = []
        for k, column in self.columns.items():
            value, place = cells[k] if k < len(cells) else ("", self.places[f"row {number}"])
            self.places[f"row {number}, {column}"] = place
            if value == "":
                continue
            if column in (*_TEXTS, "material"):
                made[column] = str(value).strip()
                continue
            try:
                made[column] = float(value)
            except (TypeError, ValueError):
                made[column] = math.nan
            if not math.isfinite(made[column]):
                wrong.append((column, f"a number is wanted, not {in_short(value)}"))
            elif made[column] <= 0.0 and column in _POSITIVE:
                wrong.append((column, f"a number above zero is wanted, not {in_short(value)}"))
        for value, place in cells[max(self.columns, default=0) + 1 :]:
            if value != "":
                self.places[f"row {number}, behind the last column"] = place
                wrong.append(("behind the last column", f"{in_short(value)} is in none"))
                break
        kind = made["kind"].lower()
        made["kind"] = "hinge" if kind == "notch" else kind
        if kind not in (*KINDS, "notch"):
            near = nearest(kind, KINDS)[:1]
            meant = f"did you mean {near[0]}?" if near else f"one of {', '.join(KINDS)} is wanted"
            wrong.append(("kind", f"there is no kind {in_short(kind)}: {meant}"))
        else:
            wrong += self._missing(made)
        for column, words in wrong:
            self.found.error(f"row {number}" + f", {column}" * bool(column), words)
        return None if wrong else made

    def _missing(self, row: Row) -> Iterator[tuple[str, str]]:
        """What a row needs and has not."""
        kind, spatial = row["kind"], not self.planar
        needs = ["from", "x1", "y1", *["z1"] * spatial, *["to"] * (kind != "point")]
        if kind not in ("point", *_HINGED):
            needs += ["x2", "y2", *["z2"] * spatial]
        if missing := [name for name in needs if name not in row]:
            yield "", f"a {kind} needs {' and '.join(missing)}"
        if spatial and kind in ("sheet", "hinge") and not any(row.get(c, 0.0) for c in _DIRECTION):
            of = "the direction of its width" if kind == "sheet" else "its axis"
            yield "", f"a {kind} needs {of} as direction x, y and z"
        axes = "xyz" if spatial else "xy"
        ends = [[row.get(f"{axis}{end}", math.nan) for axis in axes] for end in "12"]
        length = math.dist(*ends)
        if kind not in ("point", *_HINGED) and abs(row.get("length", length) - length) > (
            _TYPED * length
        ):
            words = f"its ends are {length:.6g} {self.units.symbol('m')} apart: change these"
            yield "length", f"{words}, or leave the length empty"
        width, thickness = "width" in row, "thickness" in row
        if width > thickness or (kind == "sheet" and spatial and thickness > width):
            yield "", "width and thickness belong together"
        if {"E", "G"} & row.keys() and not {"E", "G"} <= row.keys():
            yield "", "E and G belong together"

    def _tried(self, row: Row, step: Any) -> None:
        """Do it, and say of an error in which row it is."""
        try:
            step(row)
        except ModelError as error:
            for item in error.diagnostics:
                more = f" ({item.help})" if item.help else ""
                self.found.error(f"row {row['number']}", f"{item.message}{more}")

    def _point(self, label: str, row: Row, end: str) -> Node:
        """The point of an end, made where it is not there yet."""
        place = tuple(row[f"{axis}{end}"] for axis in ("xy" if self.planar else "xyz"))
        for other, node in self.points.setdefault(label, []):
            if math.dist(other, place) <= self.near:
                return node
        joint = next(
            (n for p, n in self.joint_at.items() if math.dist(p, place) <= self.near), None
        )
        is_joint = row["kind"] in _HINGED
        node = self.made.pivot(joint) if joint and is_joint else self.made.node(place)
        if is_joint and joint is None:
            self.joint_at[place] = node
        self.points[label].append((place, node))
        return node

    def _add(self, row: Row) -> None:
        kind, name = row["kind"], row.get("name", "")
        p = self._point(row["from"], row, "1")
        if kind == "point":
            return
        q = self._point(row["to"], row, "1" if kind in _HINGED else "2")
        direction = None
        if not self.planar and _DIRECTION[0] in row:
            direction = tuple(row.get(each, 0.0) for each in _DIRECTION)
        if kind == "ball joint":
            return
        if kind == "hinge":
            self.made.hinge(p, direction, q, name)
            self._give_classes(row, None)
            return
        sizes = self._sizes_of(row)
        beams = int(row.get("beams", 1))
        part: Part | Element
        if kind == "sheet":
            part = self.made.sheet(p, q, direction, beams, name, **sizes)
        elif kind == "wire":
            part = self.made.wire(p, q, direction, name, beams=beams, **sizes)
        elif kind == "bar":
            part = self.made.truss(p, q, name, **sizes)
        else:
            part = self.made.beam(p, q, direction, (), name, **sizes)
        self._give_classes(row, part)

    def _sizes_of(self, row: Row) -> dict[str, Any]:
        """Section and material as the builder takes them."""
        made: dict[str, Any] = {}
        if "width" in row:
            made["section"] = (row["width"], row["thickness"])
        elif "thickness" in row:
            made["section" if row["kind"] == "beam" else "thickness"] = row["thickness"]
        if "material" in row:
            made["material"] = row["material"]
        elif "E" in row and made:
            made["material"] = {"E": row["E"], "G": row["G"], "density": row.get("density", 0.0)}
        return made

    def _give_classes(self, row: Row, part: Part | Element | None) -> None:
        """Release and declare what the row says, where that is not what its kind does."""
        if not {"released", "declared"} & row.keys():
            return
        if part is None:
            part = self.made.part(int(self.made.element_numbers[-1]))
        declared = _split([row.get("declared", "")])
        if "released" in row:
            released = [each for each in _split([row["released"]]) if each != "none"]
        else:
            usual = _split(_usual(row["kind"], self.planar))
            released = [each for each in usual if each not in declared]
        self.made.hold(part)
        for words, give in ((released, self.made.release), (declared, self.made.independent)):
            for word in words:
                plain, _, end = word.partition(" at ")
                if row["kind"] == "sheet" and not self.planar and word in _IN_SHEET:
                    # In words it depends on what is held, which is being said just now.
                    give(part, _IN_SHEET[word])
                else:
                    give(part, plain, at={"from": "p", "to": "q"}.get(end))

    def _add_bodies(self) -> None:
        for label, points in self.points.items():
            nodes = [node for _, node in points]
            row = {"number": self.lines[0][0]}
            if label.lower().startswith(_HELD):
                self._tried(row, lambda _, nodes=nodes: self.made.fix(*nodes))
            elif len(nodes) > 1:
                name = label.removeprefix("body ")
                self._tried(row, lambda _, n=nodes, name=name: self.made.body(n, name=name))
            if len(nodes) == 1 and not re.fullmatch(r"(joint|clamp|ground)( \d+)?", label):
                name = label.removeprefix("joint ")
                if not nodes[0].name:
                    self._tried(row, lambda _, n=nodes, name=name: self.made.rename(n[0], name))

    def _say_of_point(self, row: Row) -> None:
        node = self._point(row["from"], row, "1")
        if row.get("name") and not node.name:
            self.made.rename(node, row["name"])
        for column, give in (("fixed", self.made.fix), ("driven", self.made.independent)):
            if names := _split([row.get(column, "")]):
                give(node, *names)
