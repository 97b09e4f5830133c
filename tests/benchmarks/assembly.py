# SPDX-License-Identifier: BSD-3-Clause
"""Models made of whole arrays of nodes and elements, without a loop over them."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from flexact import Model
from flexact.core.arrays import model_arrays
from flexact.core.elements import Class, NodeKind, kind_of
from flexact.model.data import DeckNames, ModelData

Indices = NDArray[np.int64]
Floats = NDArray[np.float64]


class Assembly:
    """Nodes and elements that are added many at a time."""

    def __init__(self) -> None:
        """Start without nodes or elements."""
        self._kind: list[Indices] = []
        self._value: list[Floats] = []
        self._class: list[Indices] = []
        self._nodes = 0
        self._element_kind: list[Indices] = []
        self._slots: list[Indices] = []
        self._vector: list[Floats] = []
        self._deformation: list[Indices] = []

    def positions(self, place: ArrayLike, fixed: ArrayLike = False) -> Indices:
        """Add positions (k, 3) [m] and return their indices, from 1; `fixed` is one or (k,)."""
        points = np.asarray(place, np.float64).reshape(-1, 3)
        values = np.hstack([points, np.zeros((len(points), 1))])
        return self._add(NodeKind.POSITION, values, fixed)

    def orientations(self, count: int, fixed: ArrayLike = False) -> Indices:
        """Add unturned orientations and return their indices, from 1."""
        values = np.tile([1.0, 0.0, 0.0, 0.0], (count, 1))
        return self._add(NodeKind.ORIENTATION, values, fixed)

    def _add(self, kind: NodeKind, values: Floats, fixed: ArrayLike) -> Indices:
        count = len(values)
        held = np.broadcast_to(np.asarray(fixed, bool), (count,))
        self._kind.append(np.full(count, int(kind)))
        self._value.append(values)
        classes = np.where(held, int(Class.FIXED), int(Class.DEPENDENT))
        self._class.append(np.repeat(classes[:, None], 3, axis=1))
        self._nodes += count
        return np.arange(self._nodes - count, self._nodes) + 1

    def bars(self, p: Indices, q: Indices) -> None:
        """Add bars between positions."""
        self._elements("TRUSS", (p, 0, q, 0), np.zeros((len(p), 3)), ())

    def beams(
        self,
        p: tuple[Indices, Indices],
        q: tuple[Indices, Indices],
        y: Floats,
        released: tuple[int, ...] = (),
        independent: ArrayLike = 0,
    ) -> None:
        """Add beams between points (position, orientation).

        Args:
            p: ends, each (k,).
            q: other ends.
            y: (k, 3) local y directions.
            released: deformations, from 1, that all of them release.
            independent: one deformation each, (k,), from 1, that is independent; 0 none.
        """
        self._elements("BEAM", (*p, *q), y, released, independent)

    def hinges(self, p: Indices, q: Indices, axis: Floats, independent: ArrayLike = 0) -> None:
        """Add hinges between orientations about axes (k, 3), the rotation released."""
        self._elements("HINGE", (0, p, 0, q), axis, (1,), independent)

    def _elements(
        self,
        keyword: str,
        slots: tuple[Indices | int, ...],
        vector: Floats,
        released: tuple[int, ...],
        independent: ArrayLike = 0,
    ) -> None:
        kind, count = kind_of(keyword), len(vector)
        number = np.arange(1, 7)
        usual = np.where(number <= kind.deformations, int(Class.FIXED), int(Class.NONE))
        usual[[k - 1 for k in released]] = Class.DEPENDENT
        chosen = np.broadcast_to(np.asarray(independent), (count,))
        classes = np.where(number == chosen[:, None], int(Class.INDEPENDENT), usual)
        self._element_kind.append(np.full(count, kind.number))
        columns = [np.broadcast_to(np.asarray(slot), (count,)) for slot in slots]
        self._slots.append(np.stack(columns, axis=1))
        self._vector.append(vector)
        self._deformation.append(classes)

    def model(self, name: str) -> Model:
        """The model of all that was added."""
        kind = np.concatenate(self._element_kind)
        arrays = model_arrays(
            node_number=np.arange(1, self._nodes + 1),
            node_kind=np.concatenate(self._kind),
            node_value=np.concatenate(self._value).T,
            coordinate_class=np.concatenate(self._class).T,
            element_number=np.arange(1, kind.size + 1),
            element_kind=kind,
            element_node=np.concatenate(self._slots).T,
            element_vector=np.concatenate(self._vector).T,
            deformation_class=np.concatenate(self._deformation).T,
        )
        no_names = DeckNames(b"", np.zeros((2, kind.size), np.int32))
        return Model.from_data(ModelData(arrays, False, name, no_names))
