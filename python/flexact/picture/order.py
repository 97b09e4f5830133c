"""In which order polygons and lines are drawn, so that the nearer ones hide the farther ones.

Sorting by the depth of middles errs wherever facets differ in size or touch each other. Here the
picture is sampled on a raster; at each point the items above it say by their depths which of two
neighbours lies behind the other. An order that agrees with them all is found by sorting the graph
of these answers; where they contradict each other (facets through each other, or in a ring) the
majority counts, then the depth of the middles.
"""

from __future__ import annotations

import heapq
from typing import NamedTuple

import numpy as np

from ..exchange import FloatArray

#: Points of the raster along the longer side of the picture.
_RASTER = 420
#: Lines count as nearer by so many steps of the raster: the facets beside them slope.
_LINE_NEARER = 2.0
#: Steeper areas are taken to be so steep, in steps of depth a step aside.
_STEEPEST = 12.0
#: Depths within this part of the picture's size are equal.
_EQUAL = 1.0e-7
#: Steps of depth that are told apart where many items lie above a point.
_DEPTHS = 1 << 34
#: Lines that nothing hides are drawn after what is nearer by this part of the picture.
_LATE = 0.05
#: Points of the raster in the boxes round all polygons.
_MOST_POINTS = 2.0e6
#: Beyond so many items the middles alone decide.
_MOST = 60_000


class Items(NamedTuple):
    """Equally many corners each."""

    flat: FloatArray
    """(n, c, 3) corners to the right, upwards, and towards the eye."""
    nearer: FloatArray
    """(n,) by how much they count as nearer to the eye."""
    is_line: bool
    """Whether they are open lines, else convex polygons."""


class _Samples(NamedTuple):
    item: np.ndarray
    cell: np.ndarray
    depth: FloatArray
    error: FloatArray
    """How much the depth changes within a step of the raster."""


def painted(batches: list[Items]) -> np.ndarray:
    """(items,) the order of the items of all batches, numbered through, from the back."""
    middle = np.concatenate([_middle(b) for b in batches])
    if len(middle) > _MOST:
        return np.argsort(middle, kind="stable")
    every = np.concatenate([b.flat[..., :2].reshape(-1, 2) for b in batches])
    low, extent = every.min(axis=0), float(np.ptp(every, axis=0).max())
    if not extent > 0.0:
        return np.argsort(middle, kind="stable")
    step = extent / _RASTER * _coarseness(batches, extent / _RASTER)
    areas, lines, first = [], [], 0
    for batch in batches:
        area, line = _sampled(batch, first, low, step)
        areas += area
        lines += line
        first += len(batch.flat)
    return _sorted(middle, *_answers(_joined(areas), _joined(lines), extent))


def _coarseness(batches: list[Items], step: float) -> float:
    """How much coarser than that the raster must be, so that its points are not too many."""
    points = 0.0
    for batch in batches:
        if not batch.is_line and len(batch.flat):
            points += float(np.prod(np.ptp(batch.flat[..., :2], axis=1) / step, axis=1).sum())
    return max(1.0, float(np.sqrt(points / _MOST_POINTS)))


def _middle(batch: Items) -> FloatArray:
    """(n,) depths that decide where nothing else does: lines as late as can be."""
    depth: FloatArray = batch.flat[..., 2].mean(axis=1) + batch.nearer
    return depth + _LATE * float(np.ptp(batch.flat)) if batch.is_line else depth


def _sampled(
    batch: Items, first: int, low: FloatArray, step: float
) -> tuple[list[_Samples], list[_Samples]]:
    """Points of areas, which are exact, and points of lines, which lie beside the raster's."""
    flat = batch.flat.copy()
    flat[..., 2] += batch.nearer[:, None]
    flat[..., :2] = (flat[..., :2] - low) / step
    numbers = first + np.arange(len(flat))
    if batch.is_line:
        flat[..., 2] += _LINE_NEARER * step
        return [], [_along(flat[:, k : k + 2], numbers) for k in range(flat.shape[1] - 1)]
    made = _inside(flat, numbers, step)
    # Facets that lie between the points of the raster are sampled along their longest line.
    thin = np.ones(len(flat), bool)
    thin[made.item - first] = False
    rest = flat[thin]
    ends = np.stack((rest[:, 0], rest[:, rest.shape[1] // 2]), axis=1)
    return [made], [_along(ends, numbers[thin])]


def _joined(samples: list[_Samples]) -> _Samples:
    if not samples:
        return _Samples(*(np.empty(0, kind) for kind in (np.int64, np.int64, float, float)))
    return _Samples(*(np.concatenate(parts) for parts in zip(*samples, strict=True)))


def _key(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    return y.astype(np.int64) * (2 * _RASTER) + x.astype(np.int64)


def _repeated(counts: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rows and their own numbers from 0, a row so often as `counts` (n,) says."""
    row = np.repeat(np.arange(len(counts)), counts)
    start = np.cumsum(counts) - counts
    return row, np.arange(len(row)) - start[row]


def _along(ends: FloatArray, numbers: np.ndarray) -> _Samples:
    """Points of the raster nearest to lines (n, 2, 3)."""
    way = ends[:, 1] - ends[:, 0]
    counts = np.ceil(np.abs(way[:, :2]).max(axis=1, initial=0.0)).astype(np.int64) + 1
    row, place = _repeated(counts)
    share = (place + 0.5) / counts[row]
    points = ends[row, 0] + share[:, None] * way[row]
    x, y = np.rint(points[:, 0]), np.rint(points[:, 1])
    return _Samples(numbers[row], _key(x, y), points[:, 2], np.zeros(len(row)))


def _inside(flat: FloatArray, numbers: np.ndarray, step: float) -> _Samples:
    """Points of the raster within convex polygons (n, c, 3), and the depth of these there."""
    low = np.ceil(flat[..., :2].min(axis=1)).astype(np.int64)
    size = np.maximum(np.floor(flat[..., :2].max(axis=1)).astype(np.int64) - low + 1, 0)
    row, place = _repeated(size[:, 0] * size[:, 1])
    x = low[row, 0] + place % np.maximum(size[row, 0], 1)
    y = low[row, 1] + place // np.maximum(size[row, 0], 1)
    for edge in _edges(flat).transpose(1, 2, 0):
        within = np.flatnonzero(edge[0, row] * x + edge[1, row] * y + edge[2, row] >= 0.0)
        row, x, y = row[within], x[within], y[within]
    slope = _slopes(flat)
    middle = flat.mean(axis=1)
    depth = middle[row, 2] + slope[row, 0] * (x - middle[row, 0])
    depth += slope[row, 1] * (y - middle[row, 1])
    error = np.minimum(np.abs(slope).sum(axis=1), _STEEPEST * step)
    return _Samples(numbers[row], _key(x, y), depth, error[row])


def _edges(flat: FloatArray) -> FloatArray:
    """(n, c, 3) of each edge a, b and c; inside the polygon a x + b y + c is not negative."""
    following = np.roll(flat, -1, axis=1)
    a, b = flat[..., 1] - following[..., 1], following[..., 0] - flat[..., 0]
    cross = flat[..., 0] * following[..., 1] - flat[..., 1] * following[..., 0]
    sign = np.where(cross.sum(axis=1) < 0.0, -1.0, 1.0)[:, None, None]
    return np.asarray(sign * np.stack((a, b, cross), axis=-1))


def _slopes(flat: FloatArray) -> FloatArray:
    """(n, 2) how depth grows to the right and upwards in polygons (n, c, 3)."""
    centred = flat - flat.mean(axis=1, keepdims=True)
    normal = np.cross(centred, np.roll(centred, -1, axis=1)).sum(axis=1)
    upright = np.abs(normal[:, 2]) > 1.0e-12 * np.abs(normal).max(axis=1)
    safe = np.where(upright, normal[:, 2], 1.0)
    return np.where(upright[:, None], -normal[:, :2] / safe[:, None], 0.0)


def _answers(areas: _Samples, lines: _Samples, extent: float) -> tuple[np.ndarray, np.ndarray]:
    """Pairs of items, the first behind the second, by the majority of the points."""
    pairs = [_neighbours(areas, extent)]
    if len(lines.item):
        # Beside a line, a slanting area may be nearer than the line without hiding it.
        lowered = areas._replace(depth=areas.depth - areas.error)
        is_line = np.zeros(int(max(areas.item.max(initial=0), lines.item.max())) + 1, bool)
        is_line[lines.item] = True
        both = _joined([lowered, lines])
        mixed = _neighbours(both, extent, (1, 2))
        pairs.append(mixed[is_line[mixed].any(axis=1)])
    return _by_majority(np.concatenate(pairs))


def _neighbours(samples: _Samples, extent: float, gaps: tuple[int, ...] = (1,)) -> np.ndarray:
    """(pairs, 2) items that follow each other at a point of the raster, the farther one first."""
    low, high = (float(end(samples.depth, initial=0.0)) for end in (np.min, np.max))
    fine = (samples.depth - low) * ((_DEPTHS - 1) / max(high - low, 1.0e-300))
    order = np.argsort(samples.cell * _DEPTHS + fine.astype(np.int64))
    item, cell, depth = (each[order] for each in samples[:3])
    made = []
    for gap in gaps:
        told = (cell[gap:] == cell[:-gap]) & (item[gap:] != item[:-gap])
        told &= depth[gap:] - depth[:-gap] > _EQUAL * extent
        made.append(np.stack((item[:-gap][told], item[gap:][told]), axis=1))
    return np.concatenate(made)


def _by_majority(pair: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    if not len(pair):
        return np.empty(0, np.int64), np.empty(0, np.int64)
    forward = pair[:, 0] < pair[:, 1]
    total = int(pair.max()) + 1
    low, high = pair.min(axis=1), pair.max(axis=1)
    key, where = np.unique(low * total + high, return_inverse=True)
    votes = np.bincount(where, weights=np.where(forward, 1.0, -1.0))
    low, high = key // total, key % total
    return (
        np.concatenate((low[votes > 0], high[votes < 0])),
        np.concatenate((high[votes > 0], low[votes < 0])),
    )


def _sorted(middle: FloatArray, behind: np.ndarray, before: np.ndarray) -> np.ndarray:
    """An order that agrees with the answers; where several do, by the depth of the middles."""
    count = len(middle)
    by_behind = np.argsort(behind, kind="stable")
    start = np.searchsorted(behind[by_behind], np.arange(count + 1)).tolist()
    following = before[by_behind].tolist()
    waiting = np.bincount(before, minlength=count).tolist()
    rank = np.empty(count, np.int64)
    by_depth = np.argsort(middle, kind="stable")
    rank[by_depth] = np.arange(count)
    ranks, by_rank = rank.tolist(), by_depth.tolist()
    ready = [ranks[i] for i in range(count) if not waiting[i]]
    heapq.heapify(ready)
    done = [False] * count
    order: list[int] = []
    farthest = 0
    while len(order) < count:
        if ready:
            item = by_rank[heapq.heappop(ready)]
            if done[item]:
                continue
        else:
            # A ring: the farthest of what is left breaks it.
            while done[by_rank[farthest]]:
                farthest += 1
            item = by_rank[farthest]
        done[item] = True
        order.append(item)
        for other in following[start[item] : start[item + 1]]:
            waiting[other] -= 1
            if not waiting[other] and not done[other]:
                heapq.heappush(ready, ranks[other])
    return np.array(order, np.int64)
