# SPDX-License-Identifier: BSD-3-Clause
"""Polygons as pixels by a depth buffer: what is nearer hides what is farther, point by point."""

from __future__ import annotations

from collections.abc import Iterator
from functools import reduce
from typing import NamedTuple

import numpy as np

from ...core.arrays import FloatArray

#: Samples along each side of a pixel.
SAMPLES = 3
#: Steps of depth as wide as a sample. Faces in one plane are equally far but for rounding, and
#: of these the later one is seen.
_STEPS = 32
#: Of a number that holds a depth and a facet, the bits of the facet.
_BITS = 28
#: Samples that are looked at together.
_MOST = 2_000_000


class Facets(NamedTuple):
    """Convex polygons with equally many corners."""

    flat: FloatArray
    """(n, c, 3) corners to the right, upwards, and towards the eye [sample]."""
    colour: FloatArray
    """(n, 4) red, green, blue and opacity, 0 to 1."""


def painted(facets: list[Facets], width: int, height: int) -> np.ndarray:
    """(height, width, 3) the facets on white, 8 bits a colour, from below to above.

    Each sample shows the nearest opaque facet, and over it the translucent ones that are nearer.
    """
    shape = (height * SAMPLES, width * SAMPLES)
    lowest, nearest = _nearest(facets, shape)
    index = nearest & ((1 << _BITS) - 1)
    palette = [np.ones((1, 3)), *(each.colour[:, :3] for each in facets)]
    seen, first = [], 1
    for flat, colour in facets:
        rows = np.flatnonzero((colour[:, 3] > 0.0) & (colour[:, 3] < 1.0))
        for place, key in _samples(flat[rows], first + rows, shape, lowest):
            front = key > nearest[place]
            seen.append((place[front], key[front]))
        first += len(colour)
    if seen:
        every = np.concatenate([each.colour for each in facets])
        _blend(index, palette, every, *map(np.concatenate, zip(*seen, strict=True)))
    table = np.rint(255 * np.clip(np.concatenate(palette), 0.0, 1.0)).astype(np.uint16)
    index = index.reshape(shape)
    parts = [index[i::SAMPLES, j::SAMPLES] for i in range(SAMPLES) for j in range(SAMPLES)]
    there = reduce(np.bitwise_or, parts) > 0
    mixed = sum(table[part[there]] for part in parts)
    made = np.full((height, width, 3), 255, np.uint8)
    made[there] = (mixed + SAMPLES**2 // 2) // SAMPLES**2
    return made


def visible(facets: list[Facets], width: int, height: int) -> np.ndarray:
    """(facets,) whether something is seen of each, numbered through; translucent ones are."""
    _, nearest = _nearest(facets, (height * SAMPLES, width * SAMPLES))
    made = np.concatenate([np.zeros(1, bool), *(each.colour[:, 3] < 1.0 for each in facets)])
    made[nearest & ((1 << _BITS) - 1)] = True
    return made[1:]


def _nearest(facets: list[Facets], shape: tuple[int, int]) -> tuple[float, np.ndarray]:
    """The least depth, and (samples,) depth and number, from 1, of the nearest opaque facet."""
    nearest = np.zeros(shape[0] * shape[1], np.int64)
    depths = [each.flat[..., 2] for each in facets if each.flat.size]
    lowest = min((float(each.min()) for each in depths), default=0.0)
    first = 1
    for flat, colour in facets:
        rows = np.flatnonzero(colour[:, 3] >= 1.0)
        for place, key in _samples(flat[rows], first + rows, shape, lowest):
            np.maximum.at(nearest, place, key)
        first += len(colour)
    return lowest, nearest


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
