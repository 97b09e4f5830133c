# SPDX-License-Identifier: BSD-3-Clause
"""What a mesh holds: points, cells and their data; see `flexact.mesh`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..base.frozen import Frozen
from ..core.arrays import FloatArray
from ..drawing import Drawing, Pose, drawing_of
from ..drawing.movement import scale_of
from ..drawing.selection import select_motion
from ..model.data import ModelData
from ..model.parts.forms import forms_of
from ..result.result import Result
from .layout import Integers, Layout, layout_of

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
        names: Name of each element.
        element: (cells,) index of each cell's element.
    """

    points: FloatArray
    corners: tuple[Integers, Integers, Integers]
    point_data: dict[str, NDArray[np.generic]]
    cell_data: dict[str, NDArray[np.generic]]
    names: Sequence[str]
    element: Integers

    def to_meshio(self) -> meshio.Mesh:
        """The same for meshio, which holds no names.

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
            chosen = select_motion(self.analysis)
            shown = None if chosen is None else chosen.motion
        moved, turned = np.zeros((2, *self.reference.points.shape))
        if shown is not None:
            scale = scale_of(self.drawn, shown)
            moved, turned = self.reference.motion(shown.displacement, shown.rotation)
            moved, turned = scale * moved, scale * turned
        return self.with_data(self.reference.points, moved, turned)

    def with_data(self, points: FloatArray, moved: FloatArray, turned: FloatArray) -> Mesh:
        """A mesh with these points, displacements and rotations, (n, 3) each."""
        values = {"displacement": moved, "rotation": turned, **self._of_analysis}
        arrays, element = self.analysis.given.arrays, self.reference.element
        of_cells = {
            "element": arrays.element_number.astype(np.int64),
            "kind": arrays.element_kind.astype(np.int64),
            "form": forms_of(arrays)[0],
        }
        return Mesh(
            points,
            self.reference.corners,
            values,
            {name: of_elements[element] for name, of_elements in of_cells.items()},
            self.analysis.given.element_names,
            element,
        )

    @cached_property
    def _of_analysis(self) -> dict[str, NDArray[np.generic]]:
        """Point data that are the same in every pose."""
        layout, numbers = self.reference, self.analysis.given.arrays.node_number
        node = np.zeros(len(layout.points), np.int64)
        node[: layout.node.size] = np.where(layout.node >= 0, numbers[layout.node], 0)
        values: dict[str, NDArray[np.generic]] = {"node": node}
        most = self.most_modes
        for k, motion in enumerate(self.analysis.motions[:most], start=1):
            moved, turned = layout.motion(motion.displacement, motion.rotation)
            values |= {f"motion_{k}": moved, f"motion_{k}_rotation": turned}
        for k, stress in enumerate(self.analysis.self_stresses[:most], start=1):
            for quantity, of_points in layout.stress(stress).items():
                name = quantity.replace("-", "_").replace(" ", "_")
                values[f"selfstress_{k}_{name}"] = of_points
        return values


def _all_drawn(data: ModelData) -> ModelData:
    drawn = np.ones_like(data.appearance.drawn)
    return replace(data, given_appearance=replace(data.appearance, drawn=drawn))
