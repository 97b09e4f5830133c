# SPDX-License-Identifier: BSD-3-Clause
"""Symmetric layouts: groups that keep a freedom, flexures that are images of each other.

A layout is called symmetric when its material is: a wire from the axis outward is not its own
image under a half turn, although its line is.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from ..core.arrays import BoolArray, FloatArray, IndexArray
from ..util.groups import distinct
from ..util.rotations import matrix_of
from .candidates import Candidates, Place, clear_of_boxes, joined
from .choice import Blocks, blocks_of_sets
from .frame import turned_screws
from .geometry import TINY, between_strips, within

#: Orders of turns that are tried.
ORDERS = (2, 3, 4, 6)


class Group(NamedTuple):
    """Turns or a mirror about the centre.

    Attributes:
        order: Of turns about the axis; 0 of a mirror.
        axis: (3,) unit vector along the axis, or across the mirror.
        turns: (m, 3, 3) all of them, the identity first.
    """

    order: int
    axis: FloatArray
    turns: FloatArray


def group_of(order: int, axis: FloatArray) -> Group:
    """Turns by parts of a full turn about an axis, or with order zero the mirror across it."""
    if order == 0:
        return Group(0, axis, np.stack((np.eye(3), np.eye(3) - 2.0 * np.outer(axis, axis))))
    angles = 2.0 * np.pi * np.arange(order) / order
    turns = np.stack([matrix_of(angle * axis) for angle in angles])
    # Quarter turns have whole numbers.
    near = np.round(turns, 12)
    return Group(order, axis, np.where(np.abs(turns - near) < 1.0e-12, near, turns) + 0.0)


def keeps(freedom: FloatArray, turns: FloatArray) -> bool:
    """Whether turns keep a freedom, (d, 6) orthonormal rows."""
    for turn in turns:
        moved = turned_screws(turn, freedom)
        rest = moved - (moved @ freedom.T) @ freedom
        if rest.size and np.abs(rest).max() > TINY:
            return False
    return True


def groups(freedom: FloatArray, isometries: FloatArray | None = None) -> Iterator[Group]:
    """Groups that keep a freedom: mirrors, then turns of higher order, about axes of the frame.

    Args:
        freedom: (d, 6) orthonormal rows.
        isometries: (g, 3, 3); of groups that these take to each other one is enough.
    """
    axes = list(np.eye(3))
    if len(freedom) and len(freedom) <= 3:
        # The one axis that a freedom may have of its own.
        _, values, right = np.linalg.svd(freedom[:, :3])
        if values[0] > TINY and np.sum(values > TINY) == 1:
            axes.append(right[0])
    kept = distinct(axes, lambda one, other: bool(abs(one @ other) > 1.0 - TINY))
    for order in (0, *ORDERS):
        found: list[FloatArray] = []
        for axis in kept:
            images = [] if isometries is None else list(isometries @ axis)
            if any(abs(image @ other) > 1.0 - TINY for image in images for other in found):
                continue
            group = group_of(order, axis)
            if keeps(freedom, group.turns):
                found.append(axis)
                yield group


def moved(candidates: Candidates, turn: FloatArray) -> Candidates:
    """Images of flexures under a turn or a mirror."""
    rows = np.roll(turned_screws(turn, np.roll(candidates.rows, 3, axis=-1)), 3, axis=-1)
    return replace(
        candidates,
        ends=candidates.ends @ turn.T,
        strips=candidates.strips @ turn.T,
        rows=rows,
        normal=candidates.normal @ turn.T,
        via=candidates.via @ turn.T,
        axes=candidates.axes @ turn.T,
    )


def materials(candidates: Candidates, digits: int = 6) -> FloatArray:
    """(n, m) numbers that are alike where flexures are, whichever way their vectors point."""
    count = len(candidates)
    strips = candidates.strips
    half = strips[:, :, 2]
    flat = np.abs(half).reshape(count, -1)
    parts = [strips[:, :, :2].reshape(count, -1), flat]
    # Which edge of a sheet is which does not matter, but the sense of products does.
    products = (half[..., :, None] * half[..., None, :]).reshape(count, -1)
    parts += [products, candidates.via.reshape(count, -1)]
    lines = candidates.axes
    parts.append((lines[..., :, None] * lines[..., None, :]).reshape(count, -1))
    return np.round(np.concatenate([part for part in parts if part.size], axis=1), digits) + 0.0


def orbits(group: Group, candidates: Candidates, place: Place) -> list[Blocks]:
    """Sets of flexures that are images of each other, by how many there are in each.

    Args:
        group: Of the images.
        candidates: Of which one of each set is taken.
        place: The regions, W, and the clearance.
    """
    if not len(candidates):
        return []
    images = [moved(candidates, turn) for turn in group.turns]
    fits = np.ones(len(candidates), dtype=bool)
    for image in images[1:]:
        fits &= is_within(image, place)
    made = []
    # The first image of each material, and a set is one whichever of its members is looked at.
    keys = np.stack([materials(image) for image in images], axis=1).tolist()
    different: list[dict[tuple[float, ...], int]] = []
    for each in keys:
        different.append({})
        for k, key in enumerate(map(tuple, each)):
            different[-1].setdefault(key, k)
    firsts: dict[object, int] = {}
    for n, each in enumerate(different):
        firsts.setdefault(tuple(sorted(each)), n)
    alone = np.isin(np.arange(len(different)), list(firsts.values()))
    sizes = np.array([len(each) for each in different])
    for size in sorted(set(sizes.tolist())):
        of_size = np.flatnonzero(fits & alone & (sizes == size))
        if not of_size.size:
            continue
        which = np.array([list(different[n].values()) for n in of_size])
        together = joined([_picked(images, of_size, which[:, k]) for k in range(size)])
        members = np.arange(len(of_size))[:, None] + len(of_size) * np.arange(size)
        clear = _apart(together, members, place.sizes.clearance)
        members = members[clear]
        if len(members):
            made.append(blocks_of_sets(together, members, place.constraint))
    return made


def _picked(images: Sequence[Candidates], places: IndexArray, which: IndexArray) -> Candidates:
    """Of each place the image that is asked for."""
    first = images[0].of(places)
    names = ("ends", "strips", "rows", "normal", "via", "axes")
    arrays: dict[str, Any] = {}
    for name in names:
        stacked = np.stack([getattr(image, name)[places] for image in images])
        arrays[name] = stacked[which, np.arange(len(places))]
    return replace(first, **arrays)


def is_within(candidates: Candidates, place: Place) -> BoolArray:
    """(n,) whether flexures end in the regions and stay out of what is to be kept out of."""
    ok = np.ones(len(candidates), dtype=bool)
    for end, boxes in ((0, place.here), (1, place.there)):
        middles = candidates.ends[:, end]
        half = candidates.strips[:, 0 if end == 0 else -1, 2]
        inside = np.zeros(len(candidates), dtype=bool)
        for box in boxes:
            is_point = (box.high - box.low).max() <= TINY
            reach = np.zeros_like(half) if is_point else half
            inside |= within(middles + reach, box.low, box.high) & within(
                middles - reach, box.low, box.high
            )
        ok &= inside
    return ok & clear_of_boxes(place, candidates.strips, candidates.radius)


def _apart(candidates: Candidates, members: IndexArray, clearance: float) -> BoolArray:
    """(n,) whether the flexures of each set, (n, q) members, are clear of each other."""
    clear = np.ones(len(members), dtype=bool)
    centres, reaches = candidates.balls
    away = clearance + 2.0 * candidates.radius - 1.0e-12
    for i, j in itertools.combinations(range(members.shape[1]), 2):
        one, other = members[:, i], members[:, j]
        for k, m in np.ndindex(reaches.shape[1], reaches.shape[1]):
            off = np.linalg.norm(centres[one, k] - centres[other, m], axis=1)
            near = np.flatnonzero(clear & (off < reaches[one, k] + reaches[other, m] + away))
            strips = candidates.strips
            clear[near] = between_strips(strips[one[near], k], strips[other[near], m]) >= away
    return clear
