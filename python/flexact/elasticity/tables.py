# SPDX-License-Identifier: BSD-3-Clause
"""Tables at a point: stiffness and compliance in any frame, principal lines, centres, parasites.

Principal stiffnesses are those of Patterson and Lipkin (Structure of robot compliance, J. Mech.
Design 115, 1993), which depend neither on the point nor on the frame. A translation g without
turning takes a wrench whose force is along g, where K_tt g = k g: k and the line of that wrench. A
couple along g turns about a line along g, where C_rr g = g/k: k and that line. The centres are
those of Loncaric (Normal forms of stiffness and compliance matrices, IEEE J. Robotics and
Automation 3, 1987): where the block that couples displacements with turns is symmetric. Where it
vanishes a force through the centre does not turn, and a couple does not displace it.
"""

from __future__ import annotations

import csv
import io
import json
import math
import os
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..analysis.places import axis_words
from ..core.arrays import BoolArray, FloatArray, IntArray
from ..core.elements import NodeKind
from ..model.data import ModelData
from ..show.charts import Bar, BarChart, Chart, Curve, Group, Row, linear_scale, log_scale, told
from ..show.writers import STILLS, Writers, as_bytes, write
from ..util.loading import VERSION, load
from ..util.matrices import complement, span
from ..util.outputs import OutputError
from ..util.records import Frozen
from ..util.rotations import matrix_of, matrix_of_euler, vector_of
from ..util.text import file_name, harmless, in_short
from ..util.text import table as text_table
from ..util.units import Units
from .equilibria import force_of, value_at
from .errors import ElasticError, Estimate
from .points import Coordinate, Point, Points
from .solution import Compliance, Solution

if TYPE_CHECKING:
    from .elastic import State

NAMES = ("x", "y", "z", "rx", "ry", "rz")
#: The unit of a motion, of a displacement and of a turn.
_MOTION = ("m", "rad")
#: A frame has axes that are square to each other within this.
_SQUARE = 1.0e-6
#: A place that is carried is no farther than so many times the size of the model.
_FARTHEST = 10.0
#: Principal stiffnesses that differ by less than this part of the largest are one.
_EQUAL = 1.0e-7
#: What is left of a stiffness or a compliance, as a part of the largest, that is none.
_NOTHING = 1.0e-12
#: What is less than this part of the root of both diagonal terms is told as 0.
_ROUNDED = 1.0e-9
#: Displacements and turns are independent where no more of either comes from the other, as a part
#: of the root of the product of both compliances.
UNCOUPLED = 1.0e-4
#: Columns of a terminal.
_WIDTH = 100


def cross_matrix(vector: FloatArray) -> FloatArray:
    """(3, 3): times another vector, the cross product."""
    return np.cross(vector, np.eye(3)).T


def axes_given(points: Points, frame: object) -> tuple[FloatArray, str]:
    """(3, 3) axes as columns, and what they are called, of a frame as users give it.

    Raises:
        ElasticError: it is none, or one out of the plane of a planar model.
        ModelError: there is no such part.
    """
    wrong = (
        'a frame is "global", the name of a part, or a 3 x 3 rotation whose columns are its axes, '
        f"not {in_short(frame)}"
    )
    if isinstance(frame, str) and frame == "global":
        return np.eye(3), "the axes of the model"
    if isinstance(frame, (list, tuple, np.ndarray)):
        try:
            made = np.array(frame, np.float64)
        except (TypeError, ValueError):
            raise ElasticError(wrong) from None
        if made.shape != (3, 3) or not np.abs(made.T @ made - np.eye(3)).max() < _SQUARE:
            raise ElasticError(wrong)
        if np.linalg.det(made) < 0.0:
            raise ElasticError(f"a frame is right-handed: turn one axis of {in_short(frame)} about")
        words = "given axes"
    else:
        element = points.elements(frame)[0]
        made = np.array(points.data.frames.frame[element])
        words = f"the axes of {points.parts.of_element(element).name}, as it is at rest"
    if points.data.planar and abs(made[2, 2]) < 1.0 - _SQUARE:
        raise ElasticError("the frame of a planar model is one in its plane")
    left, _, right = np.linalg.svd(made)
    return left @ right, words


def offset_given(points: Points, point: Point, at: object) -> FloatArray:
    """(3,) from a point at rest to a place that is carried with it [m]; zero without one.

    Raises:
        ElasticError: nothing turns with the point, so that it carries no other place; or the place
            is far away, a slip of the unit.
    """
    if at is None:
        return np.zeros(3)
    if point.orientation < 0 or point.position < 0:
        raise ElasticError(
            f"{words_of(points, point)} carries no other place, since nothing turns with it: leave "
            "out `at`, or name a body"
        )
    data = points.data
    made = points.place(at) - data.arrays.node_value[:3, point.position]
    distance = float(np.linalg.norm(made))
    if distance > _FARTHEST * data.size:
        far = f"{data.units.shown(distance, 'm'):.4g} {data.units.symbol('m')}"
        raise ElasticError(
            f"the place {in_short(at)} is {far} from {words_of(points, point)}, more than "
            f"{_FARTHEST:g} times the whole model: say its unit, such as '3 mm'"
        )
    return made


def words_of(points: Points, point: Point) -> str:
    """What a point is called: by its name, by the body that it stands for, or by its number."""
    node = next(iter(point.nodes))
    parts = points.parts
    body = parts.body_at.get(node)
    if point.position >= 0 and (name := parts.name_of_point(point.position)):
        return name
    if body is not None and parts.first_points[body] == point.position:
        return str(parts.of_body(body).name)
    return f"node {points.number(node)}"


def carried(
    at: Solution, point: Point, offset: FloatArray, since: FloatArray | None = None
) -> tuple[FloatArray, FloatArray]:
    """How a place that is carried with a point has moved and turned, and where it is.

    Args:
        at: The state.
        point: The point.
        offset: (3,) from the point to the place at rest [m].
        since: (4, nodes) the configuration from which motions count; by default at rest.

    Returns:
        (6,) its displacement and rotation vector [m, rad], and (3,) from the point to it now.
    """
    now, rest = at.raw.configuration, at.solver.at_rest.configuration
    rest = rest if since is None else since
    turn = np.eye(3)
    if point.orientation >= 0:
        node = point.orientation
        if at.solver.mesh.own.arrays.node_kind[node] == NodeKind.ANGLE:
            turn = matrix_of(np.array([0.0, 0.0, now[0, node] - rest[0, node]]))
        else:
            turn = matrix_of_euler(now[:, node]) @ matrix_of_euler(rest[:, node]).T
    way = turn @ offset
    node = point.position
    moved = np.zeros(3) if node < 0 else now[:3, node] - rest[:3, node]
    return np.concatenate((moved + way - offset, vector_of(turn))), way


def seen_from(
    given: Compliance, which: IntArray, offset: FloatArray, axes: FloatArray
) -> Compliance:
    """The compliance of a place that is carried with a point, in a frame.

    Args:
        given: Of the point, in the axes of the model.
        which: (n,) of the six coordinates x y z rx ry rz, those that the point has.
        offset: (3,) from the point to the place [m].
        axes: (3, 3) of the frame, as columns.
    """
    full = np.zeros((6, 6))
    full[:3, :3] = full[3:, 3:] = axes.T
    full[:3, 3:] = -axes.T @ cross_matrix(offset)
    turned = full[np.ix_(which, which)]
    if np.array_equal(turned, np.eye(which.size)):
        return given
    turned = turned * given.scale[:, None] / given.scale
    finite = turned @ given.finite @ turned.T
    loose = span(turned @ given.loose, _NOTHING)
    return given._replace(finite=(finite + finite.T) / 2.0, loose=loose)


@dataclass(frozen=True, eq=False)
class PrincipalStiffness(Frozen):
    """A principal stiffness as a line.

    Attributes:
        kind: "translation": a force along the line moves the body along it, without a turn;
            "rotation": a couple along the line turns the body about it.
        stiffness: [N/m, N m/rad]; infinite where it is held, 0 of a motion without stiffness.
        direction: (3,) unit vector, in the axes of the model.
        through: (3,) the place of the line that is nearest to the point; None where what is held
            or loose leaves it open.
        pitch: Of a translation the couple along the line that goes with the force, for each unit
            of it; of a rotation the displacement along the line for each radian [m]; None likewise.
    """

    kind: str
    stiffness: float
    direction: FloatArray
    through: FloatArray | None
    pitch: float | None

    @property
    def unit(self) -> str:
        """The SI unit of the stiffness."""
        return _STIFFNESS[0 if self.kind == "translation" else 2]


def principal_axes(matrix: FloatArray, basis: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Eigenvalues (k,), ascending, and vectors (3, k) of a symmetric matrix in a basis (3, k).

    Of equal values the vectors are those nearest to the axes of the basis's space.
    """
    values, own = np.linalg.eigh((matrix + matrix.T) / 2.0)
    vectors = basis @ own
    least, start = _EQUAL * np.abs(values).max(initial=0.0), 0
    for stop in range(1, values.size + 1):
        if stop < values.size and values[stop] - values[stop - 1] <= least:
            continue
        for k in range(start, stop):
            left = vectors[:, k:stop]
            nearest = left @ left[np.argmax(np.linalg.norm(left, axis=1).round(9))]
            first = nearest / np.linalg.norm(nearest)
            rest = left - np.outer(first, first @ left)
            vectors[:, k:stop] = np.column_stack((first, span(rest, 0.5)))
        start = stop
    most = np.abs(vectors).round(9).argmax(axis=0)
    signs = np.sign(vectors[most, np.arange(values.size)])
    return values, vectors * np.where(signs < 0.0, -1.0, 1.0) + 0.0


def principal_of(
    given: Compliance, which: IntArray, place: FloatArray
) -> tuple[PrincipalStiffness, ...]:
    """Principal stiffnesses, of each kind the softest first; SI."""
    shift, turn = which < 3, which >= 3
    scale = float(given.scale[turn][0]) if turn.any() else 1.0
    values, some, held = given.springs
    stiff = (some / values) @ some.T
    axis = np.eye(3)[:, which % 3]

    def screw(along: FloatArray, across: FloatArray) -> tuple[FloatArray, float]:
        square = float(along @ along)
        return place + np.cross(along, across) / square, float(along @ across) / square

    made = []
    for kind, own, matrix, stuck, is_open in (
        ("translation", shift, stiff, held, bool(held.size)),
        ("rotation", turn, given.finite, given.loose, bool(given.loose.size)),
    ):
        # Of translations what is held is infinite, of turns what is loose, in their own spaces.
        beyond = span(stuck[own], _NOTHING**0.5)
        across = complement(beyond)
        inner = across.T @ matrix[np.ix_(own, own)] @ across
        found, vectors = principal_axes(inner, axis[:, own] @ across)
        found = np.where(found > _NOTHING * np.abs(matrix).max(initial=0.0), found, 0.0)
        extreme = math.inf
        if kind == "rotation":
            extreme = 0.0
            found = np.where(found > 0.0, scale**2 / np.where(found > 0.0, found, 1.0), math.inf)
        _, ends = principal_axes(np.zeros((beyond.shape[1],) * 2), axis[:, own] @ beyond)
        every = [
            *zip(found.tolist(), vectors.T, strict=True),
            *((extreme, each) for each in ends.T),
        ]
        for number, direction in sorted(every, key=lambda each: each[0]):
            line: tuple[FloatArray | None, float | None] = None, None
            if math.isfinite(number) and number > 0.0 and not is_open:
                answer = matrix[:, own] @ (axis[:, own].T @ direction)
                moved, turned = axis[:, shift] @ answer[shift], axis[:, turn] @ answer[turn]
                shape = (moved, turned * scale), (turned / scale, moved)
                line = screw(*shape[kind == "rotation"])
            elif kind == "rotation" and number == 0.0 and given.loose.shape[1] == 1:
                motion = given.loose[:, 0]
                line = screw(axis[:, turn] @ motion[turn] / scale, axis[:, shift] @ motion[shift])
            made.append(PrincipalStiffness(kind, number, direction, *line))
    return tuple(made)


def centres_of(
    given: Compliance, which: IntArray, place: FloatArray
) -> tuple[FloatArray | None, FloatArray | None, float]:
    """Centre of compliance, centre of stiffness, and the coupling that is left at the former; SI.

    A centre is None where there is none. Where only one turn gives way the centre of compliance is
    the place of its axis that is nearest to the point.
    """
    turn = which >= 3
    if given.loose.size or not turn.any():
        return None, None, math.nan
    full = np.zeros((6, 6))
    full[np.ix_(which, which)] = given.matrix
    found: list[FloatArray | None] = []
    _, _, held = given.springs
    stiff = np.zeros((6, 6))
    if not held.size:
        stiff[np.ix_(which, which)] = given.stiffness
    for matrix, block, sign in ((full, full[3:, 3:], 1.0), (stiff, stiff[:3, :3], -1.0)):
        couple = matrix[:3, 3:]
        twice = np.array([couple[k, j] - couple[j, k] for j, k in ((1, 2), (2, 0), (0, 1))])
        whole = np.trace(block) * np.eye(3) - block
        is_one = np.linalg.matrix_rank(whole, _EQUAL * np.abs(whole).max(initial=0.0)) < 2
        found.append(None if is_one else place + sign * np.linalg.pinv(whole, _EQUAL) @ twice)
    centre, other = found
    if centre is None:
        return None, other, math.nan
    there = seen_from(given, which, centre - place, np.eye(3)).finite
    sizes = np.sqrt(np.maximum(np.diagonal(there), 0.0))
    both = np.outer(sizes[~turn], sizes[turn])
    least = _NOTHING * both.max(initial=0.0)
    left = np.abs(there[np.ix_(~turn, turn)]) / np.where(both > least, both, math.inf)
    return centre, other, float(left.max(initial=0.0))


#: Units of the blocks of both matrices, by how many of two directions are turns.
_STIFFNESS, _COMPLIANCE = ("N/m", "N", "N m/rad"), ("m/N", "rad/N", "rad/(N m)")
_HEADER = ("quantity", "direction", "direction_2", "number", "value", "unit")
#: Of the JSON of a table; raised where an entry is taken away, renamed, or means something else.
FORMAT = 1


@dataclass(frozen=True, eq=False, repr=False)
class PlaceTable(Frozen):
    """What is known of a point, or of a place that is carried with it, in a frame.

    Attributes:
        data: The model, in whose units numbers are.
        point: What the point is called.
        frame: What the frame is called.
        axes: (3, 3) the frame's axes, as columns.
        directions: (n,) the coordinates of the point.
    """

    data: ModelData
    point: str
    frame: str
    axes: FloatArray
    directions: tuple[str, ...]

    @property
    def units(self) -> Units:
        """In which its numbers are."""
        return self.data.units

    def to_dict(self) -> dict[str, Any]:
        """The table as the JSON has it (`docs/table.schema.json`); what is infinite is null."""
        keys = ("m", "rad", "N", "N m", *_STIFFNESS, *_COMPLIANCE)
        return {
            "format": FORMAT,
            "kind": "",
            "deck": self.data.name.encode("utf-8", "backslashreplace").decode("utf-8"),
            "flexact": VERSION,
            "units": {key: self.units.symbol(key) for key in dict.fromkeys(keys)},
            "point": self.point,
            "frame": {"words": self.frame, "axes": self.axes.T.tolist()},
            "directions": list(self.directions),
        }

    def to_json(self) -> str:
        """One line of JSON, of `to_dict`; numbers read back to the last bit."""
        return json.dumps(self.to_dict(), allow_nan=False)

    def to_csv(self, path: str | os.PathLike[str] | None = None) -> str:
        """All numbers as a table, as a text; also written to a file, if one is named.

        Raises:
            OutputError: The file cannot be written.
        """
        text = io.StringIO()
        csv.writer(text, lineterminator="\n").writerows(self.rows)
        if path is not None:
            write(Path(path), as_bytes(text.getvalue()))
        return text.getvalue()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write it: a picture (.png, .svg, .pdf), a table (.csv) or JSON (.json), by its suffix.

        Raises:
            FlexactError: There is no such kind of file, a package is missing, or the file cannot
                be written.
        """
        TABLES.save(self, self.data, Path(path))

    @property
    def rows(self) -> Sequence[Sequence[object]]:
        """Of the CSV, its header first."""
        raise NotImplementedError

    def describe(self) -> str:
        """The same in words."""
        raise NotImplementedError


@dataclass(frozen=True, eq=False, repr=False)
class PointTable(PlaceTable):
    """What a point does under forces and moments; made by `State.table`.

    Places and directions are in the axes of the model, both matrices in those of the frame.

    Attributes:
        label: What state it is, such as "undeformed".
        place: (3,) where it is [m].
        stiffness: (n, n) infinite where held, 0 without stiffness [N/m, N, N m/rad].
        compliance: (n, n) likewise, 0 and infinite [m/N, rad/N, rad/(N m)].
        principal: Principal stiffnesses of translations, then of rotations, the softest first.
        centre_of_compliance: (3,) where the coupling of the compliance is symmetric; None where
            there is none.
        centre_of_stiffness: (3,) likewise of the stiffness.
        coupling: How far displacements and turns depend on each other at the centre of compliance,
            from 0, not at all, to 1; NaN without one.
    """

    label: str
    place: FloatArray
    stiffness: FloatArray
    compliance: FloatArray
    principal: tuple[PrincipalStiffness, ...]
    centre_of_compliance: FloatArray | None
    centre_of_stiffness: FloatArray | None
    coupling: float

    @property
    def centre(self) -> FloatArray | None:
        """(3,) the place where forces do not turn and couples do not displace; None without one."""
        return self.centre_of_compliance if self.coupling < UNCOUPLED else None

    def describe(self) -> str:
        """Both matrices, principal stiffnesses and the centre, in words."""
        length = self.units.symbol("m")
        least = _ROUNDED * self.units.shown(self.data.size, "m")
        lines = [
            f"{self.point} at {listed(self.place, least)} {length}, {self.label}; in {self.frame}."
        ]
        for what, matrix, keys, infinite in (
            ("Stiffness", self.stiffness, _STIFFNESS, "held"),
            ("Compliance", self.compliance, _COMPLIANCE, "loose"),
        ):
            lines.append(f"{what} [{', '.join(map(self.units.symbol, keys))}]:")
            rows = [["", *self.directions]]
            sizes = np.sqrt(np.abs(np.nan_to_num(np.diagonal(matrix), posinf=0.0)))
            shown = np.where(np.abs(matrix) > _ROUNDED * np.outer(sizes, sizes), matrix, 0.0)
            for name, row in zip(self.directions, shown.tolist(), strict=True):
                rows.append([f"  {name}", *(_number(value, infinite) for value in row)])
            lines.append(text_table(rows, _WIDTH))
        lines.append("Principal stiffnesses, the softest first:")
        for each in self.principal:
            size = f"{_number(each.stiffness)} {self.units.symbol(each.unit)}"
            if not 0.0 < each.stiffness < math.inf:
                size = "held" if each.stiffness else "no stiffness"
            way = "along" if each.kind == "translation" else "about"
            words = f"  {each.kind} {way} {axis_words(each.direction)}: {size}"
            if each.through is not None and each.pitch is not None:
                words += f", on the line through {listed(each.through, least)} {length}"
                if abs(each.pitch) > _EQUAL / _ROUNDED * least:
                    words += f", pitch {each.pitch:.3g} {length}"
            lines.append(words)
        return "\n".join((*lines, self.centre_words))

    @property
    def centre_words(self) -> str:
        """Whether there is a centre of compliance, and where, in a sentence or two."""
        if not any(name.startswith("r") for name in self.directions):
            return "No centre of compliance: nothing turns with the point."
        if np.isinf(self.compliance).any():
            return "No centre of compliance: there is a motion without stiffness."
        if self.centre_of_compliance is None:
            return "No centre of compliance: the body does not turn."
        length = self.units.symbol("m")
        least = _ROUNDED * self.units.shown(self.data.size, "m")
        where = f"{listed(self.centre_of_compliance, least)} {length}"
        if self.centre is not None:
            return (
                f"Centre of compliance at {where}: a force through it does not turn the body, and "
                "a couple does not displace it."
            )
        other = ""
        if self.centre_of_stiffness is not None:
            other = f", that of its stiffness at {listed(self.centre_of_stiffness, least)} {length}"
        return (
            "No centre of compliance: there is no place that couples leave where it is (coupling "
            f"{100.0 * self.coupling:.3g} % at best). The coupling is symmetric at {where}{other} "
            "(Loncaric's centres)."
        )

    @property
    def rows(self) -> Sequence[Sequence[object]]:
        """A row a number."""
        made: list[Sequence[object]] = [_HEADER]
        symbol = self.units.symbol

        def add(what: str, vector: FloatArray | None, unit: str, number: object = "") -> None:
            for name, value in zip("xyz", [] if vector is None else vector.tolist(), strict=False):
                made.append((what, name, "", number, value, unit))

        for what, matrix, keys in (
            ("stiffness", self.stiffness, _STIFFNESS),
            ("compliance", self.compliance, _COMPLIANCE),
        ):
            for one, row in zip(self.directions, matrix.tolist(), strict=True):
                for other, value in zip(self.directions, row, strict=True):
                    unit = symbol(keys[(one[0] == "r") + (other[0] == "r")])
                    made.append((what, one, other, "", value, unit))
        count = Counter[str]()
        for each in self.principal:
            count[each.kind] += 1
            what, number = f"principal {each.kind}", count[each.kind]
            made.append((what, "", "", number, each.stiffness, symbol(each.unit)))
            add(f"{what}, direction", each.direction, "1", number)
            add(f"{what}, through", each.through, symbol("m"), number)
            if each.pitch is not None:
                made.append((f"{what}, pitch", "", "", number, each.pitch, symbol("m")))
        add("place", self.place, symbol("m"))
        add("centre of compliance", self.centre_of_compliance, symbol("m"))
        add("centre of stiffness", self.centre_of_stiffness, symbol("m"))
        if math.isfinite(self.coupling):
            made.append(("coupling", "", "", "", self.coupling, "1"))
        return made

    def to_dict(self) -> dict[str, Any]:
        """As of `PlaceTable`."""
        names = ("stiffness", "compliance", "centre", "centre_of_compliance", "centre_of_stiffness")
        return {
            **super().to_dict(),
            "kind": "point",
            "state": self.label,
            "place": self.place.tolist(),
            **{name: plain(getattr(self, name)) for name in (*names, "coupling")},
            "principal": [
                {field.name: plain(getattr(each, field.name)) for field in fields(each)}
                for each in self.principal
            ],
            "words": self.centre_words,
        }

    @property
    def charts(self) -> tuple[BarChart, ...]:
        """Bars of the principal stiffnesses, of translations and of rotations."""
        made = []
        for kind in ("translation", "rotation"):
            own = [each for each in self.principal if each.kind == kind and each.stiffness]
            sizes = [self.units.si(each.stiffness, each.unit) for each in own]
            if not np.isfinite(sizes).any():
                continue
            bars = [(Bar(0, size, 0.0),) for size in sizes]
            rows = tuple(map(Row, (axis_words(each.direction) for each in own), bars))
            note = "Arrows: held" if math.inf in sizes else ""
            scale, title = log_scale(sizes, own[0].unit, 0.25), f"Principal stiffness of {kind}"
            made.append(BarChart(kind, title, scale, (Group("", rows),), note))
        return tuple(made)

    def __repr__(self) -> str:
        """Of which point and state it is."""
        return f"<PointTable: {self.point}, {self.label}>"


def plain(value: object) -> Any:
    """A number or an array as JSON has it: null in place of what is not finite."""
    if isinstance(value, np.ndarray):
        return [plain(each) for each in value.tolist()]
    if isinstance(value, list):
        return [plain(each) for each in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _number(value: float, infinite: str = "held") -> str:
    return f"{value:.5g}" if math.isfinite(value) else infinite


def listed(vector: FloatArray, least: float = 0.0) -> str:
    """Such as "(25, 0, 50)"; what is rounding, or less than something, is 0."""
    least = max(least, 1.0e-9 * float(np.abs(vector).max(initial=0.0)))
    return f"({', '.join(f'{v:.4g}' if abs(v) > least else '0' for v in vector.tolist())})"


def by_blocks(
    convert: Callable[[Any, str], Any], matrix: FloatArray, which: IntArray, keys: Sequence[str]
) -> FloatArray:
    """A matrix in other units, each number by the kinds of its row and column."""
    turns = (which >= 3).astype(int)
    made = matrix.copy()
    for count, key in enumerate(keys):
        there = np.add.outer(turns, turns) == count
        made[there] = convert(matrix[there], key)
    return made


class Seen(NamedTuple):
    """A place that is looked at in a frame."""

    point: Point
    coordinates: list[Coordinate]
    which: IntArray
    """(n,) of x y z rx ry rz."""
    offset: FloatArray
    """(3,) from the point to the place at rest [m]."""
    axes: FloatArray
    called: tuple[str, str, FloatArray, tuple[str, ...]]
    """The point and the frame, its axes and the names of the coordinates, as of `PlaceTable`."""

    @property
    def is_read_only(self) -> bool:
        """Nobody keeps it."""
        return True

    def compliance(self, at: Solution, axes: FloatArray) -> Compliance:
        """That of the place in a state, in a frame."""
        at.require_stiffness()
        own = at.compliance(self.point, self.coordinates)
        return seen_from(own, self.which, carried(at, self.point, self.offset)[1], axes)


def seen_of(points: Points, given: object, frame: object, at: object) -> Seen:
    """A place that is looked at, as users give it; see `State.table`.

    Raises:
        UnknownError, ModelError, ElasticError: As of `State.table`.
    """
    point = points.of(given)
    axes, words = axes_given(points, frame)
    offset = offset_given(points, point, at)
    coordinates = points.coordinates(point)
    names = tuple(map(points.name, coordinates))
    called = f"{'' if at is None else 'a place carried by '}{words_of(points, point)}"
    which = np.array([NAMES.index(name) for name in names])
    return Seen(point, coordinates, which, offset, axes, (called, words, axes, names))


def table_of(state: State, given: object, frame: object, at: object) -> PointTable:
    """The table of a point of a state; see `State.table`."""
    data, units = state.model.data, state.model.data.units
    seen = seen_of(state.model.points, given, frame, at)
    which, node = seen.which, seen.point.position

    def where(at: Solution) -> FloatArray:
        return at.raw.configuration[:3, node] + carried(at, seen.point, seen.offset)[1]

    place = state.best(where) if node >= 0 else np.zeros(3)
    # Lines and centres are those of the extrapolated compliance.
    own = [seen.compliance(each, np.eye(3)) for each in state.meshes]
    best = own[-1]._replace(finite=np.array(Estimate.of(*(each.finite for each in own)).value))
    centre, other, coupling = centres_of(best, which, place)

    def length(found: FloatArray | None) -> FloatArray | None:
        return None if found is None else units.shown(found, "m")

    principal = [
        replace(
            each,
            stiffness=units.shown(each.stiffness, each.unit),
            through=length(each.through),
            pitch=None if each.pitch is None else units.shown(each.pitch, "m"),
        )
        for each in principal_of(best, which, place)
    ]
    turned = [seen.compliance(each, seen.axes) for each in state.meshes]
    stiffness = np.array(Estimate.of(*(each.stiffness for each in turned)).value) + 0.0
    compliance = np.array(Estimate.of(*(each.matrix for each in turned)).value) + 0.0
    return PointTable(
        data,
        *seen.called,
        state.label,
        units.shown(place, "m"),
        by_blocks(units.shown, stiffness, which, _STIFFNESS),
        by_blocks(units.shown, compliance, which, _COMPLIANCE),
        tuple(principal),
        length(centre),
        length(other),
        coupling,
    )


@dataclass(frozen=True, eq=False, repr=False)
class StrokeTable(PlaceTable):
    """What a point does along a stroke of a drive; made by `Elastic.stroke_table`.

    Motions count from rest; turns are rotation vectors.

    Attributes:
        drive: What is driven, such as "x of node 9".
        drive_unit: The SI unit of that, "m" or "rad".
        drive_mode: "free" or "locked": whether the drive may move in what `stiffness` says.
        parasitic: (n,) which directions the drive is not to move.
        values: (v,) the places of the drive [m, rad].
        force: (v,) of the drive on the mechanism [N, N m].
        motion: (v, n) of the point since rest, in the frame [m, rad].
        stiffness: (v, n) of the point along and about each direction, all else free: 1/compliance
            [N/m, N m/rad]; infinite where it is held, 0 without stiffness.
    """

    drive: str
    drive_unit: str
    drive_mode: str
    parasitic: BoolArray
    values: FloatArray
    force: FloatArray
    motion: FloatArray
    stiffness: FloatArray

    @property
    def columns(self) -> tuple[tuple[str, str, FloatArray], ...]:
        """Name, SI unit and numbers (v,) of each column: stroke, force, motions, stiffnesses."""
        turns = [name[0] == "r" for name in self.directions]
        return (
            ("stroke", self.drive_unit, self.values),
            ("force", "N" if self.drive_unit == "m" else "N m", self.force),
            *zip(self.directions, map(_MOTION.__getitem__, turns), self.motion.T, strict=True),
            *(
                (f"stiffness {name}", _STIFFNESS[2 * turn], numbers)
                for name, turn, numbers in zip(
                    self.directions, turns, self.stiffness.T, strict=True
                )
            ),
        )

    def describe(self) -> str:
        """The largest parasitic motions, and the range of each stiffness, in words."""
        symbol, count = self.units.symbol, len(self.directions)
        unit = symbol(self.drive_unit)
        first = (
            f"{self.point} along the stroke of {self.drive} from {self.values.min():.5g} to "
            f"{self.values.max():.5g} {unit}, drive {self.drive_mode}; in {self.frame}."
        )
        rows = [["", "largest parasitic motion", f"at [{unit}]", "stiffness from", "to", "unit"]]
        both = zip(self.columns[2 : 2 + count], self.columns[2 + count :], strict=True)
        for ((name, key, moved), (_, stiff, numbers)), is_off in zip(
            both, self.parasitic, strict=True
        ):
            worst = int(np.abs(moved).argmax())
            size = self.units.si(float(moved[worst]), key)
            cells = ["driven", ""]
            if is_off:
                is_none = abs(size) <= _ROUNDED * (1.0 if key == "rad" else self.data.size)
                cells = (
                    ["none", ""] if is_none else [told(size, key, 4), f"{self.values[worst]:.4g}"]
                )
            ends = (_number(float(of(numbers))) for of in (np.min, np.max))
            rows.append([f"  {name}", *cells, *ends, symbol(stiff)])
        return f"{first}\n{text_table(rows, _WIDTH)}"

    @property
    def rows(self) -> Sequence[Sequence[object]]:
        """A row a place of the drive."""
        heads = [f"{name} [{self.units.symbol(key)}]" for name, key, _ in self.columns]
        return [heads, *np.column_stack([numbers for *_, numbers in self.columns]).tolist()]

    def to_dict(self) -> dict[str, Any]:
        """As of `PlaceTable`."""
        return {
            **super().to_dict(),
            "kind": "stroke",
            "drive": self.drive,
            "drive_mode": self.drive_mode,
            "parasitic": self.parasitic.tolist(),
            "columns": [
                {"name": name, "unit": self.units.symbol(key), "values": plain(numbers)}
                for name, key, numbers in self.columns
            ],
        }

    @property
    def charts(self) -> tuple[Chart, ...]:
        """Curves of parasitic motions and of stiffnesses, of displacements and of turns."""
        order = np.argsort(self.values, kind="stable")
        x, none = self.units.si(self.values, self.drive_unit)[order], np.zeros(order.size)
        shown = [*self.parasitic.tolist(), *[True] * len(self.directions)]
        own = [each for each, is_shown in zip(self.columns[2:], shown, strict=True) if is_shown]
        made = []
        for title, unit in (
            ("Parasitic displacement", "m"),
            ("Parasitic rotation", "rad"),
            ("Stiffness of displacement", "N/m"),
            ("Stiffness of rotation", "N m/rad"),
        ):
            curves = []
            for name, numbers in ((name, numbers) for name, key, numbers in own if key == unit):
                y = self.units.si(numbers, unit)[order]
                if np.isfinite(y).any():
                    y = np.where(np.isfinite(y), y, np.nan)
                    label = name.split()[-1]
                    curves.append(Curve(NAMES.index(label) % 3, label, x, y, none))
            if curves:
                every = np.concatenate([curve.y for curve in curves])
                is_log = unit in _STIFFNESS and np.nanmin(every) > 0.0
                scale = (log_scale if is_log else linear_scale)(every, unit)
                along = linear_scale(x, self.drive_unit)
                made.append(Chart(title, title, self.drive, along, scale, tuple(curves)))
        return tuple(made)

    def __repr__(self) -> str:
        """Of which point and drive it is."""
        return f"<StrokeTable: {self.point} along {self.drive}, {self.values.size} places>"


def stroke_table_of(
    states: Sequence[State], drive: Coordinate, name: str, seen: Seen
) -> StrokeTable:
    """The table of a place along states of a stroke; see `Elastic.stroke_table`."""
    model, units = states[0].model, states[0].model.data.units
    which, both = seen.which, np.kron(np.eye(2), seen.axes.T)

    def numbers(at: Solution) -> FloatArray:
        """Place and force of the drive, motions and compliances of the point, in a row."""
        given = np.diagonal(seen.compliance(at, seen.axes).matrix)
        moved = (both @ carried(at, seen.point, seen.offset)[0])[which]
        return np.concatenate(
            ([value_at(at, drive), force_of(at, drive)], moved, stiffnesses(given))
        )

    def stiffnesses(given: FloatArray) -> FloatArray:
        return np.where(given > 0.0, 1.0 / np.where(given > 0.0, given, 1.0), math.inf)

    found = np.array([state.best(numbers) for state in states])
    is_turn = bool(model.points.kinds[drive.node] > NodeKind.POSITION)
    turns = (which >= 3).tolist()
    keys = [_MOTION[is_turn], "N m" if is_turn else "N", *(_MOTION[turn] for turn in turns)]
    for k, key in enumerate((*keys, *(_STIFFNESS[2 * turn] for turn in turns))):
        found[:, k] = units.shown(found[:, k], key)
    value, force, *rest = found.T
    # What the drive is to move: along its axis, or about it, as far as the frame has that.
    axis = both @ np.eye(6)[NAMES.index(name)]
    return StrokeTable(
        model.data,
        *seen.called,
        model.points.words(drive),
        keys[0],
        model.drive,
        np.abs(axis[which]) < _SQUARE,
        value.copy(),
        force.copy(),
        np.array(rest[: which.size]).T,
        np.array(rest[which.size :]).T,
    )


#: Of tables at a point. Pictures take a while to load.
TABLES = Writers(
    lambda path, known: OutputError(f"the suffix of {path} is to be one of {', '.join(known)}")
)


@TABLES.register((".csv", ".json"))
def _text(made: PlaceTable, path: Path) -> bytes:
    is_csv = path.suffix.lower() == ".csv"
    return as_bytes(made.to_csv() if is_csv else f"{made.to_json()}\n")


def _with_packages(suffix: str) -> None:
    load("flexact.show.picture.make").check_packages(suffix)


#: Width of a picture, height of a chart and of a bar's row [inch], and its resolution.
_WIDE, _HIGH, _ROW, _DPI = 10.0, 3.0, 0.3, 120


@TABLES.register(STILLS, require=_with_packages)
def _picture(made: PointTable | StrokeTable, path: Path) -> bytes:
    charts: Any = load("flexact.show.picture.charts")
    shown = made.charts
    if not shown:
        raise OutputError("there is nothing to be drawn: all is held, or nothing has a stiffness")
    rows = -(-len(shown) // 2)
    is_bars = isinstance(made, PointTable)
    high = 0.9 + (1.0 + 3.0 * _ROW if is_bars else _HIGH + 0.9) * rows
    size = {"figsize": (_WIDE, high), "dpi": _DPI}
    figure = load("flexact.show.picture.make").shown_figure(**size)
    words = made.describe().splitlines()[0]
    figure.text(0.03, 1.0 - 0.3 / high, charts.written(words), fontsize=9.5, color=charts.INK)
    for k, chart in enumerate(shown):
        row, column = divmod(k, 2)
        height = 3.0 * _ROW if is_bars else _HIGH
        left = (0.14 if is_bars else 0.07) + 0.5 * column
        low = 1.0 - (0.9 + (row + 1) * height + row * 0.9) / high
        axes = figure.add_axes((left, low, 0.32 if is_bars else 0.36, height / high))
        (charts.draw_bars if is_bars else charts.draw_chart)(axes, chart)
    name = file_name(made.data.name) or "table"
    files: Any = load("flexact.show.picture.files")
    return bytes(files.still_bytes(figure, path.suffix.lower(), harmless(name), harmless(words)))
