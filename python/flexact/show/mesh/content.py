# SPDX-License-Identifier: BSD-3-Clause
"""Points and cells of a drawing: axes as lines, hinges as vertices, and surfaces of quads."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...analysis.result import Result, SelfStress
from ...analysis.verdict_words import certainty_word, verdict_word
from ...core.arrays import AnyArray, BoolArray, FloatArray, IndexArray
from ...model.parts.forms import forms_of
from ...util.partial import attempted
from ...util.records import Frozen, cached_property
from ...util.rotations import frames_along, vector_of
from ...util.units import Units
from ..drawing import (
    QUANTITIES,
    Drawing,
    Form,
    Pose,
    Strip,
    Support,
    axes_of,
    cylinders,
    drawing_of,
    field_along,
    resultants,
    solid,
    stations,
)
from ..drawing.movement import scale_of
from ..drawing.pose import by_shape
from ..drawing.selection import select_motion
from ..drawing.supports import rings_about

if TYPE_CHECKING:
    import meshio

    from ..drawing import Moving


#: SI units of the data, k for the number of a motion or self-stress.
_UNITS = {
    "points": "m",
    "displacement": "m",
    "rotation": "rad",
    "motion_k": "m",
    "motion_k_rotation": "rad",
    "selfstress_k_normal_force": "N",
    "selfstress_k_twist_moment": "N m",
    "selfstress_k_in_plane_moment": "N m",
    "selfstress_k_out_of_plane_moment": "N m",
    "margin": "m",
    "margin_angle": "rad",
}
_TEXTS = ("verdict", "certainty", "units", "element_names")
#: ParaView looks through the names of components one by one.
MOST_COMPONENTS = 2_000


def field_data_of(analysis: Result) -> dict[str, AnyArray]:
    """The field data of a result's mesh."""
    data, margin = analysis.given, analysis.margin
    lengths, units = (margin.length, margin.angle), data.units
    return {
        "verdict": as_bytes(verdict_word(analysis)),
        "certainty": as_bytes(certainty_word(analysis)),
        "under_constrained": np.array([analysis.under_constrained]),
        "over_constrained": np.array([analysis.over_constrained]),
        "degrees_of_freedom": np.array([analysis.degrees_of_freedom]),
        **{
            name: np.array([math.inf if size is None else units.shown(size, _UNITS[name])])
            for name, size in zip(("margin", "margin_angle"), lengths, strict=True)
        },
        "units": as_bytes(
            "\n".join(f"{name}: {units.symbol(unit)}" for name, unit in _UNITS.items())
        ),
        "element_number": data.arrays.element_number.astype(np.int64)[None],
        "element_names": as_bytes("".join(f"{spelt(name)}\n" for name in data.element_names)),
    }


def as_bytes(text: str) -> AnyArray:
    """A text as an array."""
    return np.frombuffer(text.encode("utf-8", "backslashreplace"), np.uint8)


def spelt(name: str) -> str:
    """A name as VTK can keep it, on a line: without zeros, and such that UTF-8 can spell it."""
    lines = name.replace("\0", "\ufffd").replace("\n", " ")
    return lines.encode("utf-8", "backslashreplace").decode("utf-8")


def _in_units(name: str, values: AnyArray, units: Units) -> AnyArray:
    """Data of points in the units of the model."""
    unit = _UNITS.get(re.sub(r"_\d+", "_k", name), "")
    return units.shown(values, unit) if unit else values


def component_names(data: Mapping[str, AnyArray]) -> dict[str, list[str]]:
    """What ParaView is to call the components of field data: texts as they read, units, names."""
    texts = {name: bytes(data[name].tobytes()).decode() for name in _TEXTS}
    names = texts["element_names"].split("\n")[:-1]
    units = dict(line.split(": ") for line in texts["units"].split("\n"))
    return {
        "verdict": [texts["verdict"]],
        "certainty": [texts["certainty"]],
        **{name: [units[name]] for name in ("margin", "margin_angle")},
        "element_number": names if data["element_number"].size <= MOST_COMPONENTS else [],
    }


#: `form` of a support is this and its `Support`; behind them a declared translation, and rotation.
SUPPORT = max(Form)
TRANSLATION = SUPPORT + max(Support) + 1
ROTATION = TRANSLATION + 1

_ROUND = 12
#: What stands for a point, so that all faces are quads: a part of the size.
_TIP = 0.02
#: Of arrows, parts of the drawing's size: length, and where the head begins; radii.
_LENGTH, _HEAD, _SHAFT, _WIDE = 0.13, 0.095, 0.004, 0.012
_ARROW = ((0.0, _SHAFT), (_HEAD, _SHAFT), (_HEAD, _WIDE), (_LENGTH, _SHAFT * _TIP))
#: A turning arrow: radius of its circle, and angles [rad] where it begins, has its head, and ends.
_CIRCLE, _ANGLES = 0.055, (0.0, 3.9, 4.7)
_BENDS = 20


class Surface(NamedTuple):
    """Quads.

    Attributes:
        points: (n, 3) [m].
        of: (n,) the point of an axis, or the position node, that each goes with.
        quads: (k, 4) points.
        owner: (k,) the element, or the number of the symbol, of each quad.
    """

    points: FloatArray
    of: IndexArray
    quads: IndexArray
    owner: IndexArray


def _joined(surfaces: Iterable[Surface]) -> Surface:
    """Surfaces as one."""
    none = np.zeros(0, np.int64)
    made, behind = [Surface(np.zeros((0, 3)), none, np.zeros((0, 4), np.int64), none)], 0
    for each in surfaces:
        made.append(each._replace(quads=behind + each.quads))
        behind += len(each.points)
    return Surface(*(np.concatenate(part) for part in zip(*made, strict=True)))


_WORDS = {
    SUPPORT + Support.CLAMP: "clamp at",
    SUPPORT + Support.PIN: "pin at",
    SUPPORT + Support.SLIDE: "fixed translation of",
    SUPPORT + Support.TURN: "fixed rotation of",
    TRANSLATION: "declared translation of",
    ROTATION: "declared rotation of",
}


def _tube_quads(rings: FloatArray) -> IndexArray:
    """(k, 4) corners of the faces of rings (r, c, 3) that are closed at both ends.

    Seen from outside they go against the clock.
    """
    r, c, _ = rings.shape
    corner = np.arange(c)
    side = np.stack((corner, (corner + 1) % c, (corner + 1) % c + c, corner + c), axis=-1)
    sides = (side + c * np.arange(r - 1)[:, None, None]).reshape(-1, 4)
    fan = np.arange(1, c // 2)
    end = np.stack((fan - 1, fan, c - 1 - fan, c - fan), axis=-1)
    return np.concatenate((sides, end[:, ::-1], end + c * (r - 1)))


def symbols_of(drawing: Drawing) -> Iterator[tuple[int, int, FloatArray]]:
    """The symbols of a drawing: position node, form, and rings (r, c, 3) [m]."""
    reference = drawing.reference
    for each in drawing.supports:
        for rings, _ in each.solids(each.at(reference, reference), _ROUND, _TIP):
            yield each.held[0], SUPPORT + each.kind, rings
    nodes, direction, turning = drawing.arrows
    for node, frame, turns in zip(nodes.tolist(), frames_along(direction), turning, strict=True):
        place = reference.position[node]
        if turns:
            yield node, ROTATION, _bent(place, frame, drawing.size)
        else:
            yield node, TRANSLATION, rings_about(place, frame, _ARROW, drawing.size, _ROUND)


def _bent(place: FloatArray, frame: FloatArray, size: float) -> FloatArray:
    """An arrow round ex of a frame."""
    start, head, end = _ANGLES
    along = np.linspace(start, head, _BENDS)
    angle = np.concatenate((along, [head, end]))
    radius = np.concatenate((np.full(_BENDS, _SHAFT), [_WIDE, _SHAFT * _TIP])) * size
    outwards = np.cos(angle)[:, None] * frame[:, 1] + np.sin(angle)[:, None] * frame[:, 2]
    corner = 2 * np.pi * np.arange(_ROUND) / _ROUND
    # Against the clock about the way that it goes.
    across = np.cos(corner)[:, None] * outwards[:, None] - np.sin(corner)[:, None] * frame[:, 0]
    middle = place + _CIRCLE * size * outwards
    return np.asarray(middle[:, None] + radius[:, None, None] * across)


#: Lines along a member that bends.
SEGMENTS = 8
#: Corners round a hinge, and quads of the polygon that they make.
_CORNERS = 8
_DISC = _CORNERS // 2 - 1


@dataclass(frozen=True, eq=False)
class Layout(Frozen):
    """Points and cells of a drawing in a pose.

    The first b points are those of the axes: one a hinge, then those of the members, all the
    stations of one behind each other. Those of the surfaces follow. No two parts share a point.

    Attributes:
        drawing: The drawing.
        points: (n, 3) [m].
        frame: (b, 3, 3) cross-sections: columns ex along the axis, ey, ez.
        node: (b,) index of the position node at the point, -1 where there is none.
        axis_point: (n,) the point of an axis that each point belongs to, those themselves.
        has_stress: (n,) whether a point is of one element, and not on the solid of a body.
        strips: Members in the order of the points, with their stations (s,).
        corners: Points of the cells: (vertices, 1), (lines, 2), (quads, 4).
        element: (cells,) index of each cell's element, in the order of `corners`.
    """

    drawing: Drawing
    points: FloatArray
    frame: FloatArray
    node: IndexArray
    axis_point: IndexArray
    has_stress: BoolArray
    strips: tuple[tuple[np.ndarray, FloatArray], ...]
    corners: tuple[IndexArray, IndexArray, IndexArray]
    element: IndexArray

    def motion(
        self, displacement: FloatArray, rotation: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """(n, 3) displacements [m] and rotations [rad] of the points, to first order.

        Args:
            displacement: (nodes, 3) of positions.
            rotation: (nodes, 3) of orientations.
        """
        place, turn, _ = self.drawing.hinges.nodes.T
        moved = [np.where((place >= 0)[:, None], displacement[place], 0.0)]
        turned = [rotation[turn]]
        for _, way, turns in field_along(self.drawing.members, displacement, rotation, SEGMENTS):
            moved.append(way.reshape(-1, 3))
            turned.append(turns.reshape(-1, 3))
        about = np.concatenate(turned)[self.axis_point]
        made = np.concatenate(moved)[self.axis_point]
        skin = slice(len(self.frame), None)
        arm = self.points[skin] - self.points[self.axis_point[skin]]
        made[skin] += np.cross(about[skin], arm)
        return made, about

    def stress(self, stress: SelfStress) -> dict[str, FloatArray]:
        """(n,) each: the `QUANTITIES` [N, N m] at the points; as `flexact.show.drawing` has."""
        found = resultants(self.drawing, stress)
        made = {}
        for column, quantity in enumerate(QUANTITIES):
            along = [found.along(quantity, member, at).ravel() for member, at in self.strips]
            of_axes = np.concatenate((found.hinges[:, column], *along))
            made[quantity] = np.where(self.has_stress, of_axes[self.axis_point], 0.0)
        return made


def layout_of(drawing: Drawing, pose: Pose, skinned: BoolArray) -> Layout:
    """The points and cells of a drawing in a pose.

    Args:
        drawing: The drawing.
        pose: Where its nodes are.
        skinned: (elements,) which elements have a surface, besides their axis.
    """
    hinges = axes_of(drawing.hinges, pose)
    moved = pose is not drawing.reference
    members = tuple(stations(drawing.members, pose, SEGMENTS) if moved else _straight(drawing))
    strips = (hinges, *members)
    axes = np.concatenate([each.centre.reshape(-1, 3) for each in strips])
    frame = np.concatenate([each.frame.reshape(-1, 3, 3) for each in strips])
    # The first point of each strip.
    starts = np.cumsum([0, *(each.member.size * each.at.size for each in strips)]).tolist()
    lines, of_lines, nodes = _lines(drawing, starts[1:], members)
    itself = skinned.copy()
    itself[drawing.members.index[drawing.in_solid]] = False
    own = _joined(_skins(drawing, starts, strips, itself))
    skin = _joined((own, *_bodies(drawing, pose, starts[1:], members, skinned)))
    points = np.concatenate((axes, skin.points))
    return Layout(
        drawing,
        points,
        frame,
        nodes,
        np.concatenate((np.arange(len(axes)), skin.of)),
        np.arange(len(points)) < len(axes) + len(own.points),
        tuple((each.member, each.at) for each in members),
        (np.arange(hinges.member.size)[:, None], lines, len(axes) + skin.quads),
        np.concatenate((drawing.hinges.index, of_lines, skin.owner)),
    )


def _straight(drawing: Drawing) -> Iterator[Strip]:
    """The members in the reference configuration, where none is bent."""
    start, end = (drawing.reference.position[drawing.members.nodes[:, slot]] for slot in (0, 2))
    for member, at in by_shape(drawing.members, SEGMENTS):
        way = (end - start)[member]
        centre = start[member, None] + at[:, None] * way[:, None]
        centre[:, -1] = end[member]
        frame = drawing.members.frame[member, None]
        yield Strip(member, at, centre, np.repeat(frame, at.size, axis=1))


def _lines(
    drawing: Drawing, starts: list[int], strips: tuple[Strip, ...]
) -> tuple[IndexArray, IndexArray, IndexArray]:
    """Points of the lines, their elements, and the nodes of the points of all axes."""
    lines, owners = [np.zeros((0, 2), np.int64)], [np.zeros(0, np.int64)]
    nodes = [drawing.hinges.nodes[:, 0]]
    for behind, strip in zip(starts, strips, strict=False):
        count = strip.at.size
        first = behind + np.arange(strip.member.size)[:, None] * count + np.arange(count - 1)
        lines.append(np.stack((first, first + 1), axis=-1).reshape(-1, 2))
        owners.append(np.repeat(drawing.members.index[strip.member], count - 1))
        at_ends = np.full((strip.member.size, count), -1)
        at_ends[:, [0, -1]] = drawing.members.nodes[strip.member][:, [0, 2]]
        nodes.append(at_ends.ravel())
    return np.concatenate(lines), np.concatenate(owners), np.concatenate(nodes)


def _skins(
    drawing: Drawing, starts: list[int], strips: tuple[Strip, ...], skinned: BoolArray
) -> Iterator[Surface]:
    """The surfaces of the hinges, which are the first strip, and of the members."""
    for number, (behind, strip) in enumerate(zip(starts, strips, strict=False)):
        index = (drawing.members if number else drawing.hinges).index[strip.member]
        rows = np.flatnonzero(skinned[index])
        part = Strip(strip.member[rows], strip.at, strip.centre[rows], strip.frame[rows])
        for each in (
            solid(part, drawing.members, drawing.planar)
            if number
            else cylinders(part, drawing.size, drawing.planar, _CORNERS)
        ):
            k, s, c, _ = each.points.shape
            # A disc is seen from the side to which z points.
            quads = each.quads[:, -_DISC:] if s == 1 else each.quads
            station = np.minimum(np.arange(s), strip.at.size - 1)[None, :, None]
            owner = behind + rows[each.strip][:, None, None] * strip.at.size + station
            yield Surface(
                each.points.reshape(-1, 3),
                np.broadcast_to(owner, (k, s, c)).ravel(),
                quads.reshape(-1, 4),
                np.repeat(index[rows][each.strip], quads.shape[1]),
            )


def _bodies(
    drawing: Drawing,
    pose: Pose,
    starts: list[int],
    strips: tuple[Strip, ...],
    skinned: BoolArray,
) -> Iterator[Surface]:
    """The surfaces of bodies that are solids, as those of their first elements."""
    first: dict[int, int] = {}
    for behind, strip in zip(starts, strips, strict=False):
        points = behind + np.arange(strip.member.size) * strip.at.size
        first.update(zip(strip.member.tolist(), points.tolist(), strict=True))
    for body in drawing.solids:
        row = int(body.rows[0])
        index = drawing.members.index[row]
        if not skinned[index]:
            continue
        corners, _ = body.placed(drawing.members, drawing.reference, pose)
        place = body.quads(corners).reshape(-1, 3)
        quads = np.arange(len(place)).reshape(-1, 4)
        yield Surface(place, np.full(len(place), first[row]), quads, np.full(len(quads), index))


#: With more elements than these there are no surfaces, and no motion is looked for that the
#: analysis does not give.
MOST_SURFACES = 5_000

#: How many motions, and how many self-stresses, are in a mesh at most, and at least, but
#: 1 in each mesh of a cycle; between the two it is as many as give so many numbers in all.
_MOST = 200
_LEAST = 6
_NUMBERS = 20_000_000
#: Numbers at a point of a motion and a self-stress.
_NUMBERS_A_POINT = 10

SHAPES = ("vertex", "line", "quad")


@dataclass(frozen=True, eq=False)
class Mesh(Frozen):
    """A mesh with its data; see the module.

    Attributes:
        points: (n, 3), like all data in the units of the model.
        corners: Points of the cells: (vertices, 1), (lines, 2), (quads, 4).
        point_data: (n,) or (n, 3) each, by name.
        cell_data: (cells,) each, by name, in the order of `corners`.
        field_data: (n,) or (1, n) each, by name, of the whole.
        names: Name of each element, and behind them of each symbol.
        element: (cells,) index of each cell's name.
    """

    points: FloatArray
    corners: tuple[IndexArray, IndexArray, IndexArray]
    point_data: dict[str, AnyArray]
    cell_data: dict[str, AnyArray]
    field_data: dict[str, AnyArray]
    names: Sequence[str]
    element: IndexArray

    def to_meshio(self) -> meshio.Mesh:
        """The same for meshio; names are in the field data, as bytes.

        Vertices come before lines, and these before quads (the order that gmsh's files keep).

        Raises:
            ImportError: meshio is not installed.
        """
        import meshio

        behind = np.cumsum([len(corners) for corners in self.corners])[:-1]
        kept = [i for i, corners in enumerate(self.corners) if len(corners)]
        parts = {name: np.split(values, behind) for name, values in self.cell_data.items()}
        return meshio.Mesh(
            self.points,
            [(SHAPES[i], self.corners[i]) for i in kept],
            point_data=dict(self.point_data),
            cell_data={name: [part[i] for i in kept] for name, part in parts.items()},
            field_data=dict(self.field_data),
        )


def to_meshio(analysis: Result) -> meshio.Mesh:
    """The mechanism with its motions and self-stresses; see the module.

    Raises:
        ImportError: meshio is not installed.
    """
    return mesh_of(analysis).to_meshio()


def mesh_of(analysis: Result, shown: Moving | None = None) -> Mesh:
    """The mesh of an analysis; `shown` is a motion instead of the one that is chosen."""
    return Meshes(analysis).still(shown)


class Meshes:
    """The meshes of an analysis, still or in poses."""

    def __init__(self, analysis: Result, count: int = 1) -> None:
        """The points and cells of an analysis, for so many meshes."""
        self.analysis = analysis
        self.count = count
        self.small = analysis.given.arrays.element_number.size <= MOST_SURFACES
        drawn = analysis.given.appearance.drawn
        self.skinned = drawn if self.small else np.zeros_like(drawn)
        self.reference = layout_of(self.drawing, self.drawing.reference, self.skinned)
        made = list(symbols_of(self.drawn)) if self.small else []
        surfaces = []
        for number, (node, _, rings) in enumerate(made):
            points, quads = rings.reshape(-1, 3), _tube_quads(rings)
            owner = np.full(len(quads), number)
            surfaces.append(Surface(points, np.full(len(points), node), quads, owner))
        self.symbols = _joined(surfaces)
        self.forms = np.array([form for _, form, _ in made], np.int64)
        given = analysis.given
        nodes = zip(given.node_names, given.arrays.node_number.tolist(), strict=True)
        places = [name or f"node {number}" for name, number in nodes]
        told = [f"{_WORDS[form]} {places[node]}" for node, form, _ in made]
        self.names = [*given.element_names, *told]

    @cached_property
    def drawn(self) -> Drawing:
        """The drawing as it is drawn."""
        return drawing_of(self.analysis.given)

    @cached_property
    def drawing(self) -> Drawing:
        """The drawing with what is not drawn, too."""
        data = self.analysis.given
        if data.appearance.drawn.all():
            return self.drawn
        drawn = np.ones_like(data.appearance.drawn)
        appearance = replace(data.appearance, drawn=drawn)
        return drawing_of(replace(data, given_appearance=appearance))

    @property
    def most_modes(self) -> int:
        """How many motions, and how many self-stresses, a mesh holds at most."""
        numbers = _NUMBERS_A_POINT * len(self.reference.points) * self.count
        least = max(_LEAST // self.count, 1)
        return min(max(_NUMBERS // max(numbers, 1), least), _MOST)

    def still(self, shown: Moving | None = None) -> Mesh:
        """The mesh in the reference configuration."""
        if shown is None and (self.small or self.analysis.under_constrained):
            # With zeros for what cannot be found the rest is as good.
            chosen = attempted("", lambda: select_motion(self.analysis), None, None)
            shown = None if chosen is None else chosen.motion
        moved, turned = np.zeros((2, len(self.reference.points) + len(self.symbols.points), 3))
        if shown is not None:
            scale = scale_of(self.drawn, shown.displacement, shown.rotation)
            moved, turned = self._motion(shown.displacement, shown.rotation)
            moved, turned = scale * moved, scale * turned
        points = np.concatenate((self.reference.points, self.symbols.points))
        return self._made(points, moved, turned)

    def moved(self, pose: Pose) -> Mesh:
        """The mesh in a pose: `displacement` and `rotation` are finite, since the reference."""
        here, start = layout_of(self.drawing, pose, self.skinned), self.reference
        turned = vector_of(here.frame @ np.swapaxes(start.frame, -1, -2))[start.axis_point]
        # Symbols go with their nodes.
        node, start_of = self.symbols.of, self.drawing.reference.position
        symbols = self.symbols.points + (pose.position[node] - start_of[node])
        points = np.concatenate((here.points, symbols))
        away = points - np.concatenate((start.points, self.symbols.points))
        return self._made(points, away, np.concatenate((turned, np.zeros_like(symbols))))

    def _motion(
        self, displacement: FloatArray, rotation: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """(n, 3) displacements and rotations of all points, to first order: symbols go along."""
        moved, turned = self.reference.motion(displacement, rotation)
        along = displacement[self.symbols.of]
        return np.concatenate((moved, along)), np.concatenate((turned, np.zeros_like(along)))

    def _made(self, points: FloatArray, moved: FloatArray, turned: FloatArray) -> Mesh:
        """The mesh with these points, displacements and rotations, (n, 3) each."""
        values = {"displacement": moved, "rotation": turned, **self._of_analysis}
        vertices, lines, quads = self.reference.corners
        behind, symbols = len(self.reference.points), self.symbols
        corners = (vertices, lines, np.concatenate((quads, behind + symbols.quads)))
        number = len(self.analysis.given.element_names) + symbols.owner
        element = np.concatenate((self.reference.element, number))
        units = self.analysis.given.units
        values = {name: _in_units(name, each, units) for name, each in values.items()}
        data = values, self._of_cells, field_data_of(self.analysis)
        return Mesh(units.shown(points, "m"), corners, *data, self.names, element)

    @cached_property
    def _of_cells(self) -> dict[str, AnyArray]:
        """Cell data: a symbol has a form alone."""
        arrays, element = self.analysis.given.arrays, self.reference.element
        nothing = np.zeros(len(self.symbols.quads), np.int64)
        return {
            "element": np.append(arrays.element_number.astype(np.int64)[element], nothing),
            "kind": np.append(arrays.element_kind.astype(np.int64)[element], nothing),
            "form": np.append(forms_of(arrays)[0][element], self.forms[self.symbols.owner]),
        }

    @cached_property
    def _of_analysis(self) -> dict[str, AnyArray]:
        """Point data that are the same in every pose."""
        layout, numbers = self.reference, self.analysis.given.arrays.node_number
        symbols = np.zeros(len(self.symbols.points))
        node = np.zeros(len(layout.points) + len(symbols), np.int64)
        node[: layout.node.size] = np.where(layout.node >= 0, numbers[layout.node], 0)
        values: dict[str, AnyArray] = {"node": node}
        most = self.most_modes
        for k, motion in enumerate(self.analysis.motions[:most], start=1):
            moved, turned = self._motion(motion.displacement, motion.rotation)
            values |= {f"motion_{k}": moved, f"motion_{k}_rotation": turned}
        for k, stress in enumerate(self.analysis.self_stresses[:most], start=1):
            for quantity, of_points in layout.stress(stress).items():
                name = quantity.replace("-", "_").replace(" ", "_")
                values[f"selfstress_{k}_{name}"] = np.append(of_points, symbols)
        return values
