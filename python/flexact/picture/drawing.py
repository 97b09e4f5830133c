"""What is drawn, flattened: polygons and lines in the order in which they hide each other.

One collection holds them all, in the order that `order` finds, so that lines and surfaces hide
each other; in a vector file as well.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ..exchange import FloatArray
from .order import Items, painted
from .view import View

#: (2,) each: the lower left and the upper right corner of what is seen [m].
Box = tuple[FloatArray, FloatArray]
#: Layers from the back to the front; within one the depth decides.
GHOST, SOLID, OVER = 0, 1, 2
#: Width [px] of the line that closes the seam between two facets of one colour.
_SEAM = 0.6


class _Batch(NamedTuple):
    items: Items
    corners: FloatArray
    face: FloatArray
    edge: FloatArray
    width: FloatArray


class Drawing:
    """A growing heap of polygons and lines, seen in a view."""

    def __init__(self, view: View, fineness: float = 1.0) -> None:
        """An empty drawing.

        Args:
            view: From where it is seen.
            fineness: What widths of lines are multiplied by.
        """
        self.view = view
        self.fineness = fineness
        self._layers: dict[int, list[_Batch]] = {GHOST: [], SOLID: [], OVER: []}
        self._low = np.full(2, np.inf)
        self._high = np.full(2, -np.inf)

    def polygons(
        self,
        points: FloatArray,
        colour: FloatArray,
        *,
        layer: int = SOLID,
        opacity: FloatArray | float = 1.0,
        edge: FloatArray | None = None,
        width: float = 0.0,
        nearer: FloatArray | float = 0.0,
    ) -> None:
        """Add polygons.

        Args:
            points: (n, c, 3) corners [m].
            colour: (n, 3) or (3,).
            layer: Behind or before everything else.
            opacity: (n,) or one for all.
            edge: (3,) colour of their outlines; by default they have none.
            width: Of the outlines [px].
            nearer: (n,) or one for all: how much nearer to the eye than they are they count [m].
        """
        count = len(points)
        if not count:
            return
        flat = self.view.project(points)
        opaque = np.broadcast_to(opacity, count)
        face = np.column_stack((np.broadcast_to(colour, (count, 3)), opaque))
        whole = opaque >= 1.0
        line = face if edge is None else np.tile((*edge, 1.0), (count, 1))
        # A line over a seam would paint what shines through twice; a pale seam is less seen.
        widths = np.where(whole, _SEAM, 0.0) if edge is None else np.full(count, width)
        items = Items(flat, np.broadcast_to(nearer, count).astype(np.float64), False)
        around = np.concatenate((flat, flat[:, :1]), axis=1)[..., :2]
        self._add(layer, items, around, face, line, widths * self.fineness)

    def lines(
        self,
        points: FloatArray,
        colour: FloatArray,
        width: float,
        *,
        layer: int = SOLID,
        nearer: FloatArray | float = 0.0,
    ) -> None:
        """Add open lines of (n, c, 3) points each; `colour` is (n, 3) or (3,), widths in px."""
        count = len(points)
        if not count:
            return
        flat = self.view.project(points)
        there = flat[..., :2]
        # Back the same way, so that what closes a polygon adds nothing.
        there = np.concatenate((there, there[:, -2:0:-1]), axis=1)
        line = np.column_stack((np.broadcast_to(colour, (count, 3)), np.ones(count)))
        items = Items(flat, np.broadcast_to(nearer, count).astype(np.float64), True)
        widths = np.full(count, width * self.fineness)
        self._add(layer, items, there, np.zeros((count, 4)), line, widths)

    def room(self, points: FloatArray) -> None:
        """Leave room for points (..., 3), whether or not something is drawn there."""
        flat = self.view.project(points)[..., :2].reshape(-1, 2)
        if flat.size:
            self._low = np.minimum(self._low, flat.min(axis=0))
            self._high = np.maximum(self._high, flat.max(axis=0))

    @property
    def box(self) -> Box:
        """(2,) each: the lower left and the upper right corner of all that needs room [m]."""
        if not np.all(np.isfinite(self._low)):
            return np.zeros(2), np.ones(2)
        return self._low, self._high

    def collection(self) -> Any:
        """All of it as one collection of matplotlib's."""
        from matplotlib.collections import PolyCollection

        corners: list[FloatArray] = []
        others: list[list[np.ndarray]] = []
        for layer in sorted(self._layers):
            batches = self._layers[layer]
            if not batches:
                continue
            order = painted([b.items for b in batches])
            every = [polygon for b in batches for polygon in b.corners]
            corners += [every[i] for i in order.tolist()]
            parts = zip(*((b.face, b.edge, b.width) for b in batches), strict=True)
            others.append([np.concatenate(part)[order] for part in parts])
        if not corners:
            return PolyCollection([])
        face, edge, width = (np.concatenate(part) for part in zip(*others, strict=True))
        made = PolyCollection(
            corners,
            closed=False,
            facecolors=face,
            edgecolors=edge,
            linewidths=width,
            antialiaseds=True,
            joinstyle="round",
            capstyle="round",
        )
        return made

    def _add(
        self,
        layer: int,
        items: Items,
        corners: FloatArray,
        face: FloatArray,
        edge: FloatArray,
        width: FloatArray,
    ) -> None:
        self._layers[layer].append(_Batch(items, corners, face, edge, width))
        flat = corners.reshape(-1, 2)
        self._low = np.minimum(self._low, flat.min(axis=0))
        self._high = np.maximum(self._high, flat.max(axis=0))
