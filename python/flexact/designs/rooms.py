# SPDX-License-Identifier: BSD-3-Clause
"""Where bodies between stage and ground may be: boxes, of which flexures on a body end in its own.

Where the designer says nothing they are proposed: plates beside the stage, on each of its six
sides, and frames around it, between which and the stage flexures of the least length fit. All
lengths are in parts of the size of the problem.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from ..core.arrays import FloatArray
from .candidates import Sizes, boxes_of
from .frame import Scaled
from .problem import Box

#: The boxes of one body.
Boxes = tuple[Box, ...]

#: How thick the bar of a frame is.
_THICK = 0.2
#: Where a plate begins, and how thick it is, in parts of the gap between stage and ground.
_DEPTHS = ((0.25, 0.5), (0.4, 0.2), (0.6, 0.2))
#: How far a plate reaches beyond the stage at most where nothing is beside it.
_FAR = 1.5


def stacks(frame: Scaled, sizes: Sizes, count: int) -> Iterator[tuple[Boxes, ...]]:
    """Boxes of bodies in a row, from the ground to the stage, none in another one.

    Args:
        frame: The problem in its own frame.
        sizes: What flexures may measure.
        count: How many bodies.
    """
    singles = _given(frame, sizes, count) or proposed(frame, sizes)
    return _apart(itertools.permutations(singles, count), sizes)


def asides(frame: Scaled, sizes: Sizes, count: int) -> Iterator[tuple[Boxes, ...]]:
    """Boxes of bodies beside each other, each between stage and ground, in no order.

    Args:
        frame: The problem in its own frame.
        sizes: What flexures may measure.
        count: How many bodies.
    """
    singles = _given(frame, sizes, count)
    if not singles:
        singles = _clear(_plates(frame, sizes, _NARROW, _DEPTHS), frame, sizes)
    return _apart(itertools.combinations(singles, count), sizes)


def _apart(choices: Iterable[tuple[Boxes, ...]], sizes: Sizes) -> Iterator[tuple[Boxes, ...]]:
    """Those of which no body is in another one."""
    for chosen in choices:
        if all(are_apart(*pair, sizes.clearance) for pair in itertools.combinations(chosen, 2)):
            yield chosen


def _clear(places: Iterable[Boxes], frame: Scaled, sizes: Sizes) -> list[Boxes]:
    """Those that are clear of stage, ground and what is to be kept out of."""
    solid = (*boxes_of(frame.stage), *boxes_of(frame.ground), *frame.keep_out)
    return [boxes for boxes in places if are_apart(boxes, solid, sizes.clearance)]


def _given(frame: Scaled, sizes: Sizes, count: int) -> list[Boxes]:
    """At least so many given boxes, the longest cut in two until they suffice; none if none are."""
    parts, gap = list(frame.intermediate), sizes.clearance
    while parts and len(parts) < count:
        lengths = [float((box.high - box.low).max()) for box in parts]
        box = parts.pop(int(np.argmax(lengths)))
        axis = int(np.argmax(box.high - box.low))
        middle = (box.low[axis] + box.high[axis]) / 2.0
        across = np.eye(3)[axis]
        parts += [
            Box(box.low, box.high - (box.high[axis] - middle + gap / 2.0) * across),
            Box(box.low + (middle + gap / 2.0 - box.low[axis]) * across, box.high),
        ]
    return [(box,) for box in parts]


def proposed(frame: Scaled, sizes: Sizes) -> list[Boxes]:
    """Places of one body where none are given: plates, then frames, clear of everything."""
    made = [
        *_plates(frame, sizes, _WIDE[:1], _DEPTHS[:1]),
        *_frames(frame, sizes),
        *_plates(frame, sizes, _WIDE[1:], _DEPTHS[:1]),
        *_plates(frame, sizes, _WIDE, _DEPTHS[1:]),
    ]
    return _clear(made, frame, sizes)


def hull_of(boxes: Sequence[Box]) -> Box:
    """The least box around some boxes."""
    return Box(
        np.min([box.low for box in boxes], axis=0), np.max([box.high for box in boxes], axis=0)
    )


def are_apart(one: Boxes, other: Boxes, gap: float) -> bool:
    """Whether no box of one is nearer to one of the other than a gap."""
    gap = gap - 1.0e-9
    return not any(
        bool(((a.low < b.high + gap) & (b.low < a.high + gap)).all()) for a in one for b in other
    )


def _room(frame: Scaled, sizes: Sizes) -> FloatArray:
    """(2, 3) how far along each axis, backward and forward from the stage, a body can reach.

    Up to where a flexure of the least length still ends in the ground, not into the ground, and
    not further than flexures are long.
    """
    stage = hull_of(boxes_of(frame.stage))
    least, most = sizes.length
    room = np.zeros((2, 3))
    for side, axis in itertools.product(range(2), range(3)):
        sense = 1.0 if side else -1.0
        edge = (stage.high if side else stage.low)[axis] * sense
        reach = edge + min(_FAR, most)
        beside = []
        for box in boxes_of(frame.ground):
            near = (box.low if side else -box.high)[axis]
            far = (box.high if side else -box.low)[axis]
            others = np.arange(3) != axis
            faces = ((box.low < stage.high) & (stage.low < box.high))[others].all()
            if faces and near > edge:
                beside.append((near, far))
        if beside:
            near, far = min(beside)
            reach = min(reach, max(far - least, edge), near - 2.0 * sizes.clearance)
        room[side, axis] = sense * max(reach, edge)
    return room


#: In which of its two directions a plate is wider than the stage.
_WIDE = ((True, True), (True, False), (False, True))
_NARROW = ((False, False),)


def _plates(
    frame: Scaled,
    sizes: Sizes,
    widths: Sequence[tuple[bool, bool]],
    depths: Sequence[tuple[float, float]],
) -> Iterator[Boxes]:
    """Plates beside the stage, those of a width after each other on all six sides."""
    stage = hull_of(boxes_of(frame.stage))
    room = _room(frame, sizes)
    gaps = _gaps(frame, sizes)
    for wide, (start, thick) in itertools.product(widths, depths):
        for axis, side in itertools.product(range(3), (0, 1)):
            gap = gaps[side, axis]
            if min(start, 1.0 - start - thick) * gap < sizes.clearance:
                continue
            low, high = stage.low.copy(), stage.high.copy()
            for each, is_wide in zip(np.flatnonzero(np.arange(3) != axis), wide, strict=True):
                if is_wide:
                    low[each], high[each] = room[:, each]
            if side:
                low[axis] = stage.high[axis] + start * gap
                high[axis] = low[axis] + thick * gap
            else:
                high[axis] = stage.low[axis] - start * gap
                low[axis] = high[axis] - thick * gap
            yield (Box(low, high),)


def _gaps(frame: Scaled, sizes: Sizes) -> FloatArray:
    """(2, 3) how much room is between the stage and the ground, backward and forward."""
    stage = hull_of(boxes_of(frame.stage))
    gaps = np.full((2, 3), 2.0 * sizes.length[0] + _THICK)
    for side, axis in itertools.product(range(2), range(3)):
        others = np.arange(3) != axis
        for box in boxes_of(frame.ground):
            faces = ((box.low < stage.high) & (stage.low < box.high))[others].all()
            away = box.low[axis] - stage.high[axis] if side else stage.low[axis] - box.high[axis]
            if faces and away > 0.0:
                gaps[side, axis] = min(gaps[side, axis], away)
    return gaps


def _frames(frame: Scaled, sizes: Sizes) -> Iterator[Boxes]:
    """Frames of four bars around the stage, a least length from it."""
    stage = hull_of(boxes_of(frame.stage))
    gaps = _gaps(frame, sizes)
    for axis in range(3):
        one, two = np.flatnonzero(np.arange(3) != axis)
        room = gaps[:, [one, two]].min()
        bar = min(_THICK, room / 4.0)
        away = min(sizes.length[0], room - bar - 2.0 * sizes.clearance)
        if away <= sizes.clearance:
            continue
        inner = Box(stage.low - away, stage.high + away)
        bars = []
        for along, across in ((one, two), (two, one)):
            for side in range(2):
                low, high = stage.low.copy(), stage.high.copy()
                # The bars along the first axis take the corners.
                beyond = bar if along == one else 0.0
                low[along], high[along] = inner.low[along] - beyond, inner.high[along] + beyond
                if side:
                    low[across], high[across] = inner.high[across], inner.high[across] + bar
                else:
                    low[across], high[across] = inner.low[across] - bar, inner.low[across]
                bars.append(Box(low, high))
        yield tuple(bars)


def corners_between(boxes: Boxes) -> FloatArray:
    """(n, 3) further points of a body of several boxes: where these meet, along it; none of one."""
    found = []
    for i, j in itertools.combinations(range(len(boxes)), 2):
        low = np.maximum(boxes[i].low, boxes[j].low)
        high = np.minimum(boxes[i].high, boxes[j].high)
        if (low <= high + 1.0e-9).all():
            found.append(({i, j}, (low + high) / 2.0))
    made = [np.zeros((0, 3))]
    last = found[0][0] if found else set()
    while found:
        # The next one is in a box in which the last one is.
        near = next((k for k, (both, _) in enumerate(found) if both & last), 0)
        last, point = found.pop(near)
        made.append(point[None])
    return np.concatenate(made)
