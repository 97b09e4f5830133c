# SPDX-License-Identifier: BSD-3-Clause
"""Of a model's points: the table of nodes and what is said of each."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...core.elements import AXES, Class, NodeKind
from ...core.raw import ElementKind
from ...model.data import ModelData
from .fields import AXES as LETTERS
from .fields import LOADS, NODE_FIELDS
from .points import Points
from .remarks import Remarks
from .table_input import Entry


class NodeTables:
    """Places and fields of the points of a model."""

    def __init__(
        self, data: ModelData, points: Points, kinds: list[ElementKind], remarks: Remarks
    ) -> None:
        """Of a sound model, its points and the kinds of its elements."""
        self.data, self.points, self.kinds, self.remarks = data, points, kinds, remarks

    def places(self) -> list[list[float]]:
        """Coordinates of each node."""
        width = 2 if self.data.planar else 3
        values = self.data.arrays.node_value.T[:, :width].tolist()
        return [values[p] if p >= 0 else [0.0] * width for p, _ in self.points.nodes]

    def fields(self) -> list[Entry]:
        """What is said of each node."""
        a = self.data.arrays
        classes = a.coordinate_class.T.tolist()
        same_pos, same_orien = self.points.same_position, self.points.same_orientation
        hinged = self._hinged(same_pos)
        made: list[Entry] = []
        for point, (position, orientation) in enumerate(self.points.nodes, start=1):
            entry: Entry = {}
            if point in same_pos:
                entry["same_pos"] = same_pos[point]
            elif point in hinged:
                # Else a hinge between points at one place joins them there.
                entry["same_pos"] = point
            if point in same_orien:
                entry["same_orien"] = same_orien[point]
            own = (
                position if point not in same_pos else -1,
                orientation if point not in same_orien else -1,
            )
            self._add_fixed(entry, own, classes)
            self._add_independent(entry, own, classes)
            self._add_mass(entry, own)
            self._add_loads(entry, own)
            if own[0] >= 0 and (name := self.data.node_names[own[0]]):
                entry["name"] = name
            made.append(entry)
        return made

    def _hinged(self, same: dict[int, int]) -> set[int]:
        places = self.places()
        return {
            max(p, q)
            for (p, q), kind in zip(self.points.ends, self.kinds, strict=True)
            if kind.keyword == "HINGE"
            and places[p - 1] == places[q - 1]
            and same.get(p, p) != same.get(q, q)
        }

    def _of_class(self, node: int, classes: list[list[int]], wanted: Class) -> list[int]:
        """Axes of a node that have a class."""
        if node < 0:
            return []
        axes = AXES[int(self.data.arrays.node_kind[node])]
        return [axis for axis in axes if classes[node][axis] == wanted]

    def _add_fixed(self, entry: Entry, own: tuple[int, int], classes: list[list[int]]) -> None:
        whole = []
        for node, all_of_it, stem in zip(own, ("fix_pos", "fix_orien"), ("", "r"), strict=True):
            axes = self._of_class(node, classes, Class.FIXED)
            if node >= 0 and len(axes) == len(AXES[int(self.data.arrays.node_kind[node])]):
                whole.append(all_of_it)
            else:
                entry.update({f"fix_{stem}{LETTERS[axis]}": True for axis in axes})
        shares = not entry.keys().isdisjoint(("same_pos", "same_orien"))
        if whole and not shares and len(whole) == sum(node >= 0 for node in own):
            entry["fix"] = True
        else:
            entry.update(dict.fromkeys(whole, True))

    def _add_independent(
        self, entry: Entry, own: tuple[int, int], classes: list[list[int]]
    ) -> None:
        for node, stem in zip(own, ("displ", "rot"), strict=True):
            for axis in self._of_class(node, classes, Class.INDEPENDENT):
                entry[f"{stem}_{LETTERS[axis]}"] = 0.0

    def _add_mass(self, entry: Entry, own: tuple[int, int]) -> None:
        if self.data.properties is None:
            return
        for node, name, size in zip(own, ("mass", "mominertia"), (1, 6), strict=True):
            given = self.data.properties.node_mass[node] if node >= 0 else np.full(6, np.nan)
            if np.isnan(given[0]):
                continue
            numbers = given[~np.isnan(given)].tolist()
            given_as: Any = numbers[0] if size == 1 else numbers + [0.0] * (6 - len(numbers))
            try:
                fits = len(numbers) <= size and NODE_FIELDS[name].check(given_as) is not None
            except ValueError:
                fits = False
            if not fits:
                self.remarks.leave_out("masses of nodes that are no mass or six moments")
            elif size == 6 and self.data.arrays.node_kind[node] == NodeKind.ANGLE:
                entry[name] = [0.0] * 5 + numbers[:1]
            else:
                entry[name] = given_as

    def _add_loads(self, entry: Entry, own: tuple[int, int]) -> None:
        for kind, end in LOADS.items():
            for node, stem in zip(own, ("force", "moment"), strict=True):
                if self.data.loads is None or node < 0:
                    continue
                load = getattr(self.data.loads, kind)[node].tolist()
                if any(load):
                    entry[f"{stem}{end}"] = load
