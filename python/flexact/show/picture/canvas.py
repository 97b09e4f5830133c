# SPDX-License-Identifier: BSD-3-Clause
"""Polygons and lines seen in a view, for matplotlib to show.

On a raster a depth buffer decides what hides what. A vector file has them cut into small pieces
in the order of their depths, which errs where members pass through each other.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import reduce
from typing import Any, NamedTuple

import numpy as np

from ...core.arrays import FloatArray
from ..drawing.view import FLAT, View

#: Samples along each side of a pixel.
SAMPLES = 3
#: Steps of depth as wide as a sample. Faces in one plane are equally far but for rounding, and
#: of these the later one is seen.
_STEPS = 32
#: Of a number that holds a depth and a facet, the bits of the facet.
_BITS = 28
#: Pairs of places beside a pixel, on a spiral of this angle [rad], where it is looked for what
#: casts a shadow; how dark that is; and how far it reaches, a part of what is drawn.
_PAIRS, _GOLDEN, _DARKEST, _REACH = 24, 2.39996, 0.45, 0.03
#: From a depth to another one [sample].
Range = tuple[float, float]
ALL = (-np.inf, np.inf)
#: Samples that are looked at together.
_MOST = 2_000_000


#: Convex polygons with equally many corners: (n, c, 3) corners to the right, upwards, and towards
#: the eye [sample], and (n, 4) red, green, blue and opacity, 0 to 1.
Facets = tuple[FloatArray, FloatArray]


def painted(
    facets: list[Facets], width: int, height: int, reach: float = 0.0, between: Range = ALL
) -> np.ndarray:
    """(height, width, 3) the facets on white, 8 bits a colour, from below to above.

    Each sample shows the nearest opaque facet, and over it the translucent ones that are nearer.

    Args:
        facets: What is drawn.
        width: [px].
        height: [px].
        reach: How far from what is nearer its soft shadow reaches [px]; 0: there is none.
        between: The depths on which shadows fall [sample].
    """
    shape = (height * SAMPLES, width * SAMPLES)
    lowest, nearest = _nearest(facets, shape)
    index = nearest & ((1 << _BITS) - 1)
    palette = [np.ones((1, 3)), *(colour[:, :3] for _, colour in facets)]
    seen = []
    for flat, number in _numbered(facets, 0.0, 1.0):
        for place, key in _samples(flat, number, shape, lowest):
            front = key > nearest[place]
            seen.append((place[front], key[front]))
    if seen:
        every = np.concatenate([colour for _, colour in facets])
        _blend(index, palette, every, *map(np.concatenate, zip(*seen, strict=True)))
    table = np.rint(255 * np.clip(np.concatenate(palette), 0.0, 1.0)).astype(np.uint16)
    index = index.reshape(shape)
    parts = [index[i::SAMPLES, j::SAMPLES] for i in range(SAMPLES) for j in range(SAMPLES)]
    there = reduce(np.bitwise_or, parts) > 0
    mixed = sum(table[part[there]] for part in parts)
    made = np.full((height, width, 3), 255, np.uint8)
    made[there] = (mixed + SAMPLES**2 // 2) // SAMPLES**2
    if reach > 1.0:
        middle = nearest.reshape(shape)[SAMPLES // 2 :: SAMPLES, SAMPLES // 2 :: SAMPLES]
        depth = np.where(middle > 0, (middle >> _BITS) / _STEPS + lowest, -np.inf)
        solid = (middle > 0) & (depth >= between[0]) & (depth < between[1])
        dark = _shadow(depth / SAMPLES, solid, reach)
        made[solid] = np.rint(made[solid] * (1.0 - dark).reshape(-1, 1))
    return made


def _shadow(depth: FloatArray, solid: np.ndarray, reach: float) -> FloatArray:
    """How dark pixels are for what is nearer beside them, 0 to 1; as `page/shadow.js` does it.

    Args:
        depth: (h, w) of what is seen, towards the eye [px]; -inf where nothing is.
        solid: (h, w) which pixels are asked for.
        reach: How far nearer things are looked for [px].
    """
    edge = int(reach) + 1
    around = np.pad(depth, edge, constant_values=-np.inf).astype(np.float32).ravel()
    place = np.flatnonzero(np.pad(solid, edge))
    own, wide = around[place], solid.shape[-1] + 2 * edge
    dark = np.zeros(len(place), np.float32)
    for k in range(_PAIRS):
        angle, far = _GOLDEN * k, reach * np.sqrt((k + 0.5) / _PAIRS)
        step = round(far * np.sin(angle)) * wide + round(far * np.cos(angle))
        # On both sides, so that a slope is in its own shadow nowhere.
        sides = [np.maximum(around[place + way] - own, -4.0 * reach) for way in (step, -step)]
        share = (sides[0] + sides[1]) / reach
        dark += np.clip(2.0 * share - 0.2, 0.0, 1.0) * np.clip(1.6 - 0.4 * share, 0.0, 1.0)
    return np.asarray(_DARKEST * dark / _PAIRS)


def visible(facets: list[Facets], width: int, height: int) -> np.ndarray:
    """(facets,) whether something is seen of each, numbered through; translucent ones are."""
    _, nearest = _nearest(facets, (height * SAMPLES, width * SAMPLES))
    made = np.concatenate([np.zeros(1, bool), *(colour[:, 3] < 1.0 for _, colour in facets)])
    made[nearest & ((1 << _BITS) - 1)] = True
    return made[1:]


def _nearest(facets: list[Facets], shape: tuple[int, int]) -> tuple[float, np.ndarray]:
    """The least depth, and (samples,) depth and number, from 1, of the nearest opaque facet."""
    nearest = np.zeros(shape[0] * shape[1], np.int64)
    lowest = min((float(flat[..., 2].min()) for flat, _ in facets if flat.size), default=0.0)
    for flat, number in _numbered(facets, 1.0, np.inf):
        for place, key in _samples(flat, number, shape, lowest):
            np.maximum.at(nearest, place, key)
    return lowest, nearest


def _numbered(
    facets: list[Facets], least: float, below: float
) -> Iterator[tuple[FloatArray, np.ndarray]]:
    """Polygons of some opacity, all with equally many corners at once, and their numbers from 1.

    Opacities are from the least on, but not 0, and below the other.
    """
    alike: dict[int, list[tuple[FloatArray, np.ndarray]]] = {}
    first = 1
    for flat, colour in facets:
        opacity = colour[:, 3]
        rows = np.flatnonzero((opacity > 0.0) & (opacity >= least) & (opacity < below))
        if rows.size:
            alike.setdefault(flat.shape[1], []).append((flat[rows], first + rows))
        first += len(colour)
    for those in alike.values():
        flats, numbers = zip(*those, strict=True)
        yield np.concatenate(flats), np.concatenate(numbers)


def _repeated(counts: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rows and their own numbers from 0, a row so often as `counts` (n,) says."""
    row = np.repeat(np.arange(len(counts)), counts)
    return row, np.arange(len(row)) - np.repeat(np.cumsum(counts) - counts, counts)


def _samples(
    flat: FloatArray, number: np.ndarray, shape: tuple[int, int], lowest: float
) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Samples within polygons (n, c, 3): their places, and depth and number of the polygon."""
    if not len(flat):
        return
    bounds = np.clip(np.ceil(flat[..., 1] - 0.5), 0, shape[0]).astype(np.int64)
    first = bounds.min(axis=1, initial=shape[0])
    item, row = _repeated(bounds.max(axis=1, initial=0) - first)
    row += first[item]
    left, right = _ends(flat, item, row + 0.5)
    begin, end = (np.clip(np.ceil(x - 0.5), 0, shape[1]).astype(np.int64) for x in (left, right))
    slope, middle = _slopes(flat)[item], flat.mean(axis=1)[item]
    depth = middle[:, 2] - lowest + slope[:, 0] * (begin + 0.5 - middle[:, 0])
    depth += slope[:, 1] * (row + 0.5 - middle[:, 1])
    counts = np.maximum(end - begin, 0)
    behind = np.cumsum(counts)
    cuts = np.searchsorted(behind, np.arange(_MOST, behind[-1:].sum(), _MOST)) + 1
    for part in np.split(np.arange(len(counts)), cuts):
        span, step = _repeated(counts[part])
        span = part[span]
        far = (_STEPS * (depth[span] + slope[span, 0] * step)).astype(np.int64)
        place = (row * shape[1] + begin)[span] + step
        yield place, (np.maximum(far, 0) << _BITS) | number[item[span]]


def _ends(flat: FloatArray, item: np.ndarray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """(rows,) least and largest x of polygons `item` (rows,) at heights y (rows,)."""
    left, right = np.full(len(y), np.inf), np.full(len(y), -np.inf)
    following = np.roll(flat, -1, axis=1)
    for k in range(flat.shape[1]):
        x, low = flat[item, k, 0], flat[item, k, 1]
        across, rise = following[item, k, 0] - x, following[item, k, 1] - low
        crossed = (low <= y) != (low + rise <= y)
        x = x + (y - low) * across / np.where(crossed, rise, 1.0)
        left = np.where(crossed, np.minimum(left, x), left)
        right = np.where(crossed, np.maximum(right, x), right)
    return left, right


def _slopes(flat: FloatArray) -> FloatArray:
    """(n, 2) how depth grows to the right and upwards in polygons; none in those seen edge-on."""
    centred = flat - flat.mean(axis=1, keepdims=True)
    normal = np.cross(centred, np.roll(centred, -1, axis=1)).sum(axis=1)
    upright = np.abs(normal[:, 2]) > 1.0e-3 * np.linalg.norm(normal, axis=1)
    safe = np.where(upright, normal[:, 2], 1.0)
    return np.where(upright[:, None], -normal[:, :2] / safe[:, None], 0.0)


def _blend(
    index: np.ndarray,
    palette: list[FloatArray],
    colour: FloatArray,
    place: np.ndarray,
    key: np.ndarray,
) -> None:
    """Give places new colours of the palette, where translucent facets lie over what is there.

    Args:
        index: (samples,) of each its colour of the palette; changed where they lie.
        palette: (n, 3) colours each; the new ones are appended.
        colour: (facets, 4) of all facets, numbered from 1.
        place: (k,) samples of the translucent facets.
        key: (k,) depth and number of the facet there.
    """
    order = np.lexsort((key, place))
    place, facet = place[order], (key[order] & ((1 << _BITS) - 1)) - 1
    there, start, counts = np.unique(place, return_index=True, return_counts=True)
    mixed = np.concatenate(palette)[index[there]]
    for rank in range(int(counts.max(initial=0))):
        rows = np.flatnonzero(counts > rank)
        over = colour[facet[start[rows] + rank]]
        mixed[rows] += over[:, 3:] * (over[:, :3] - mixed[rows])
    index[there] = sum(map(len, palette)) + np.arange(len(there))
    palette.append(mixed)


#: (2,) each: the lower left and the upper right corner of what is seen [m].
Box = tuple[FloatArray, FloatArray]
#: Layers from the back to the front; within one the depth decides.
GHOST, SOLID, OVER = 0, 1, 2
#: Lines are nearer than the facets on which they lie, which slope [px].
_LINE_NEARER = 2.5
#: In a vector file: sizes of pieces, of facets and of lines, and how much nearer lines are, as
#: parts of the picture; width of the line that closes the seam between two pieces [pt]; pixels
#: along the picture when it is found out what is seen; of more pieces none is cut.
_PIECE, _STROKE, _LATE, _SEAM, _FINE = 0.05, 0.02, 0.03, 0.6, 600
_MOST_CUT = 12_000


class _Batch(NamedTuple):
    flat: FloatArray
    """(n, c, 3) corners to the right, upwards, and towards the eye [m]."""
    colour: FloatArray
    """(n, 4)"""
    width: float
    """Of lines [pt]; 0: polygons."""
    layer: int


class Canvas:
    """A growing heap of polygons and lines, seen in a view."""

    def __init__(self, view: View, fineness: float = 1.0) -> None:
        """An empty canvas.

        Args:
            view: From where it is seen.
            fineness: What widths of lines are multiplied by.
        """
        self.view = view
        self.fineness = fineness
        self._batches: list[_Batch] = []
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
        """Add convex polygons.

        Args:
            points: (n, c, 3) corners [m].
            colour: (n, 3) or (3,).
            layer: Behind or before everything else.
            opacity: (n,) or one for all.
            edge: (3,) colour of their outlines; by default they have none.
            width: Of the outlines [pt].
            nearer: (n,) or one for all: how much nearer to the eye than they are they count [m].
        """
        opaque = np.broadcast_to(opacity, len(points))
        face = np.column_stack((np.broadcast_to(colour, (len(points), 3)), opaque))
        self._add(points, face, 0.0, layer, nearer)
        if edge is not None:
            around = np.concatenate((points, points[:, :1]), axis=1)
            self.lines(around, edge, width, layer=layer, nearer=nearer)

    def lines(
        self,
        points: FloatArray,
        colour: FloatArray,
        width: float,
        *,
        layer: int = SOLID,
        nearer: FloatArray | float = 0.0,
    ) -> None:
        """Add open lines of (n, c, 3) points each; `colour` is (n, 3) or (3,), widths in pt."""
        line = np.column_stack((np.broadcast_to(colour, (len(points), 3)), np.ones(len(points))))
        self._add(points, line, width * self.fineness, layer, nearer)

    def _add(
        self,
        points: FloatArray,
        colour: FloatArray,
        width: float,
        layer: int,
        nearer: FloatArray | float,
    ) -> None:
        if len(points):
            self.room(points)
            flat = self.view.project(points)
            flat[..., 2] += np.broadcast_to(nearer, len(points))[:, None]
            self._batches.append(_Batch(flat, colour, width, layer))

    def room(self, points: FloatArray) -> None:
        """Leave room for points (..., 3), whether or not something is drawn there."""
        flat = self.view.project(points)[..., :2].reshape(-1, 2)
        if flat.size:
            self._low = np.minimum(self._low, flat.min(axis=0))
            self._high = np.maximum(self._high, flat.max(axis=0))

    def boxes(self) -> tuple[FloatArray, FloatArray]:
        """(n, 2) each: lower left and upper right corners of boxes round all that is drawn [m]."""
        each = [batch.flat[..., :2] for batch in self._batches]
        none = np.zeros((0, 2))
        first = np.concatenate([none, *(flat.min(axis=1) for flat in each)])
        return first, np.concatenate([none, *(flat.max(axis=1) for flat in each)])

    @property
    def box(self) -> Box:
        """(2,) each: the lower left and the upper right corner of all that needs room [m]."""
        if not np.all(np.isfinite(self._low)):
            return np.zeros(2), np.ones(2)
        return self._low, self._high

    def collection(self) -> Any:
        """All of it as one collection of matplotlib's, from the back to the front.

        Cut into small pieces; those of which nothing is seen are left out.
        """
        from matplotlib.collections import PolyCollection

        extent = self.box[1] - self.box[0]
        size = float(extent.max())
        batches = self._batches
        if self.view is not FLAT and (pieces := _cut(batches, size)):
            pixel = size / _FINE
            facets = _facets(pieces, self.box[0], pixel, 1.0)
            seen = visible(facets, *(int(side / pixel) + 1 for side in extent))
            starts = np.cumsum([len(each.flat) for each in pieces])[:-1]
            batches = [
                each._replace(flat=each.flat[rows], colour=each.colour[rows])
                for each, rows in zip(pieces, np.split(seen, starts), strict=True)
            ]
        corners: list[FloatArray] = []
        face, edge = [np.zeros((0, 4))], [np.zeros((0, 4))]
        width, depth = [np.zeros(0)], [np.zeros(0)]
        for flat, colour, wide, layer in batches:
            # Lines go back the same way, so that what closes a polygon adds nothing.
            corners += list(
                (np.concatenate((flat, flat[:, -2:0:-1]), 1) if wide else flat)[..., :2]
            )
            # A line over a seam would paint what shines through twice.
            whole = colour[:, 3] >= 1.0
            clear = np.zeros_like(colour)
            face.append(clear if wide else colour)
            edge.append(np.where(whole[:, None], colour, clear))
            width.append(np.where(whole, wide or _SEAM * self.fineness, 0.0))
            late = _LATE * size * (wide > 0)
            depth.append(1e9 * size * layer + flat[..., 2].mean(axis=1) + late)
        order = np.argsort(np.concatenate(depth), kind="stable")
        return PolyCollection(
            [corners[i] for i in order.tolist()],
            facecolors=np.concatenate(face)[order],
            edgecolors=np.concatenate(edge)[order],
            linewidths=np.concatenate(width)[order],
            joinstyle="round",
            capstyle="round",
        )

    def artist(self) -> Any:
        """What puts it into axes of matplotlib's: pixels on a raster, else a collection."""
        from matplotlib.artist import Artist
        from matplotlib.backends.backend_agg import RendererAgg

        class CanvasArtist(Artist):
            """The canvas in its axes."""

            canvas = self
            axes: Any

            def draw(self, renderer: Any) -> None:
                if isinstance(renderer, RendererAgg):
                    _draw_pixels(self.canvas, self.axes, renderer)
                    return
                made = self.axes.add_collection(self.canvas.collection(), autolim=False)
                made.draw(renderer)
                made.remove()

            def get_window_extent(self, renderer: Any = None) -> Any:
                return self.axes.get_window_extent(renderer)

        return CanvasArtist()


def _draw_pixels(canvas: Canvas, axes: Any, renderer: Any) -> None:
    box = axes.bbox
    left, below = int(np.floor(box.x0)), int(np.floor(box.y0))
    width, height = int(np.ceil(box.x1)) - left, int(np.ceil(box.y1)) - below
    low, high = np.transpose((axes.get_xlim(), axes.get_ylim()))
    pixel = (high[0] - low[0]) / box.width
    corner = low - pixel * (box.min - (left, below))
    facets = _facets(canvas._batches, corner, pixel, renderer.points_to_pixels(1.0))
    every = zip(facets, canvas._batches, strict=True)
    deep = [flat[..., 2] for (flat, _), each in every if each.layer == SOLID]
    reach, between = 0.0, ALL
    if deep and canvas.view is not FLAT:
        reach = _REACH * float(np.hypot(*(canvas.box[1] - canvas.box[0]))) / pixel
        between = (min(map(np.min, deep)), max(map(np.max, deep)) + 1.0)
    rgb = painted(facets, width, height, reach, between)
    image = np.dstack((rgb, np.full(rgb.shape[:2], 255, np.uint8)))
    gc = renderer.new_gc()
    renderer.draw_image(gc, left, below, image)
    gc.restore()


def _facets(batches: list[_Batch], low: FloatArray, pixel: float, point: float) -> list[Facets]:
    """What a depth buffer looks at; lines as narrow strips.

    `low` is the lower left corner [m], `pixel` the size of a pixel [m], and `point` that of a
    point, by which lines are measured [px].
    """
    every = [np.zeros((0, 3)), *(each.flat.reshape(-1, 3) for each in batches)]
    depth = np.concatenate(every)[:, 2]
    layer = float(np.ptp(depth) if depth.size else 0.0) + 2 * _LINE_NEARER * pixel
    made = []
    for each in batches:
        place = (each.flat - (*low, -layer * each.layer)) * (SAMPLES / pixel)
        if each.width:
            place = _strips(place, SAMPLES * each.width * point)
        colour = np.repeat(each.colour, len(place) // len(each.colour), axis=0)
        made.append((place, colour))
    return made


def _strips(points: FloatArray, width: float) -> FloatArray:
    """(n (c - 1), 4, 3) lines (n, c, 3) as strips so wide, a little nearer [sample]."""
    ends = np.stack((points[:, :-1], points[:, 1:]), axis=2).reshape(-1, 2, 3)
    way = ends[:, 1, :2] - ends[:, 0, :2]
    length = np.hypot(*way.T)[:, None]
    along = np.where(length > 0.0, way / np.where(length > 0.0, length, 1.0), (1.0, 0.0))
    # Whole samples wide across the nearer axis, so that no beat is seen in lines almost along it.
    steep = np.abs(along).max(axis=1, keepdims=True)
    along *= np.maximum(np.rint(width / steep), 1.0) * steep / 2
    across = np.stack((-along[:, 1], along[:, 0]), axis=1)
    made = ends[:, [0, 0, 1, 1]]
    # Ends reach a little on, so that there are no gaps where lines turn.
    for corner, (on, aside) in enumerate(((-1, -1), (-1, 1), (1, 1), (1, -1))):
        made[:, corner, :2] += on * along + aside * across
    made[..., 2] += _LINE_NEARER * SAMPLES
    return made


def _cut(batches: list[_Batch], size: float) -> list[_Batch]:
    """Batches in pieces, in a picture of such a size [m]; none where these were too many.

    Quadrilaterals and lines are cut; other polygons, and what shines through, in which a net of
    seams would be seen, stay whole.
    """
    made: list[_Batch] = []
    for batch in batches:
        flat, item = batch.flat, np.arange(len(batch.flat))
        if batch.width:
            item = np.repeat(item, flat.shape[1] - 1)
            flat = np.stack((flat[:, :-1], flat[:, 1:]), axis=2).reshape(-1, 2, 3)
            flat, item = _divided(flat[:, [0, 1, 1, 0]], item, _STROKE * size)
            flat = flat[:, :2]
        elif flat.shape[1] == 4 and np.all(batch.colour[:, 3] >= 1.0):
            for _ in range(2):
                flat, item = _divided(np.roll(flat, 1, axis=1), item, _PIECE * size)
        made.append(batch._replace(flat=flat, colour=batch.colour[item]))
        if sum(len(each.flat) for each in made) > _MOST_CUT:
            return []
    return made


def _divided(quads: FloatArray, item: np.ndarray, finest: float) -> tuple[FloatArray, np.ndarray]:
    """Quadrilaterals in pieces about so large from corner 0 to 1, and whose pieces they are."""
    sides = np.linalg.norm(quads[:, [1, 2]] - quads[:, [0, 3]], axis=-1).max(axis=1, initial=0.0)
    counts = np.clip(np.ceil(sides / finest), 1, 48).astype(np.int64)
    row, step = _repeated(counts)
    start = step / counts[row]
    share = np.stack((start, start + 1 / counts[row]), axis=1)[..., None]
    first, last = (
        quads[row][:, [i]] + share * (quads[row][:, [j]] - quads[row][:, [i]])
        for i, j in ((0, 1), (3, 2))
    )
    return np.concatenate((first, last[:, ::-1]), axis=1), item[row]
