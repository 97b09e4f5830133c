# SPDX-License-Identifier: BSD-3-Clause
"""What a mesh holds: points, cells and their data; see `flexact.show.mesh`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ...analysis.result import Result
from ...core.arrays import FloatArray
from ...model.data import ModelData
from ...model.parts.forms import forms_of
from ...util.cached import cached_property
from ...util.partial import attempted
from ...util.records import Frozen
from ..drawing import Drawing, Pose, drawing_of
from ..drawing.movement import scale_of
from ..drawing.rotations import vector_of
from ..drawing.selection import select_motion
from .content import Integers, Layout, layout_of
from .field_data import field_data_of
from .symbols import NO_SYMBOLS, symbols_of

if TYPE_CHECKING:
    import meshio

    from ..drawing import Moving

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
        points: (n, 3) [m].
        corners: Points of the cells: (vertices, 1), (lines, 2), (quads, 4).
        point_data: (n,) or (n, 3) each, by name.
        cell_data: (cells,) each, by name, in the order of `corners`.
        field_data: (n,) or (1, n) each, by name, of the whole.
        names: Name of each element, and behind them of each symbol.
        element: (cells,) index of each cell's name.
    """

    points: FloatArray
    corners: tuple[Integers, Integers, Integers]
    point_data: dict[str, NDArray[np.generic]]
    cell_data: dict[str, NDArray[np.generic]]
    field_data: dict[str, NDArray[np.generic]]
    names: Sequence[str]
    element: Integers

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
        self.reference = self.layout(self.drawing.reference)
        self.symbols = symbols_of(self.drawn) if self.small else NO_SYMBOLS

    @cached_property
    def drawn(self) -> Drawing:
        """The drawing as it is drawn."""
        return drawing_of(self.analysis.given)

    @cached_property
    def drawing(self) -> Drawing:
        """The drawing with what is not drawn, too."""
        data = self.analysis.given
        return self.drawn if data.appearance.drawn.all() else drawing_of(_all_drawn(data))

    def layout(self, pose: Pose) -> Layout:
        """The points and cells in a pose."""
        return layout_of(self.drawing, pose, self.skinned)

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
            scale = scale_of(self.drawn, shown)
            moved, turned = self._motion(shown.displacement, shown.rotation)
            moved, turned = scale * moved, scale * turned
        return self.with_data(self.points(self.drawing.reference), moved, turned)

    def points(self, pose: Pose) -> FloatArray:
        """(n, 3) all points in a pose [m]."""
        here = self.reference if pose is self.drawing.reference else self.layout(pose)
        return np.concatenate((here.points, self.symbols.points_in(pose, self.drawing.reference)))

    def moved(self, pose: Pose) -> tuple[FloatArray, FloatArray, FloatArray]:
        """(n, 3) each: points in a pose, their displacements [m] and rotations [rad]."""
        here, start = self.layout(pose), self.reference
        turned = vector_of(here.frame @ np.swapaxes(start.frame, -1, -2))[start.axis_point]
        symbols = self.symbols.points_in(pose, self.drawing.reference)
        points = np.concatenate((here.points, symbols))
        away = points - np.concatenate((start.points, self.symbols.points))
        return points, away, np.concatenate((turned, np.zeros_like(symbols)))

    def _motion(
        self, displacement: FloatArray, rotation: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """(n, 3) displacements and rotations of all points, to first order: symbols go along."""
        moved, turned = self.reference.motion(displacement, rotation)
        along = displacement[self.symbols.node]
        return np.concatenate((moved, along)), np.concatenate((turned, np.zeros_like(along)))

    def with_data(self, points: FloatArray, moved: FloatArray, turned: FloatArray) -> Mesh:
        """A mesh with these points, displacements and rotations, (n, 3) each."""
        values = {"displacement": moved, "rotation": turned, **self._of_analysis}
        symbols, given = self.symbols, self.analysis.given
        vertices, lines, quads = self.reference.corners
        behind = len(self.reference.points)
        corners = (vertices, lines, np.concatenate((quads, behind + symbols.quads)))
        nodes = zip(given.node_names, given.arrays.node_number.tolist(), strict=True)
        places = [name or f"node {number}" for name, number in nodes]
        names = [*given.element_names, *symbols.in_words(places)]
        element = np.concatenate((self.reference.element, len(given.element_names) + symbols.owner))
        return Mesh(points, corners, values, self._of_cells, self._of_all, names, element)

    @cached_property
    def _of_cells(self) -> dict[str, NDArray[np.generic]]:
        """Cell data: a symbol has a form alone."""
        arrays, element = self.analysis.given.arrays, self.reference.element
        nothing = np.zeros(len(self.symbols.quads), np.int64)
        made: dict[str, NDArray[np.generic]] = {
            "element": np.append(arrays.element_number.astype(np.int64)[element], nothing),
            "kind": np.append(arrays.element_kind.astype(np.int64)[element], nothing),
            "form": np.append(forms_of(arrays)[0][element], self.symbols.form),
        }
        return made

    @cached_property
    def _of_all(self) -> dict[str, NDArray[np.generic]]:
        return field_data_of(self.analysis)

    @cached_property
    def _of_analysis(self) -> dict[str, NDArray[np.generic]]:
        """Point data that are the same in every pose."""
        layout, numbers = self.reference, self.analysis.given.arrays.node_number
        symbols = np.zeros(len(self.symbols.points))
        node = np.zeros(len(layout.points) + len(symbols), np.int64)
        node[: layout.node.size] = np.where(layout.node >= 0, numbers[layout.node], 0)
        values: dict[str, NDArray[np.generic]] = {"node": node}
        most = self.most_modes
        for k, motion in enumerate(self.analysis.motions[:most], start=1):
            moved, turned = self._motion(motion.displacement, motion.rotation)
            values |= {f"motion_{k}": moved, f"motion_{k}_rotation": turned}
        for k, stress in enumerate(self.analysis.self_stresses[:most], start=1):
            for quantity, of_points in layout.stress(stress).items():
                name = quantity.replace("-", "_").replace(" ", "_")
                values[f"selfstress_{k}_{name}"] = np.append(of_points, symbols)
        return values


def _all_drawn(data: ModelData) -> ModelData:
    drawn = np.ones_like(data.appearance.drawn)
    return replace(data, given_appearance=replace(data.appearance, drawn=drawn))
