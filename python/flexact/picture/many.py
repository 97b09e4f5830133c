"""Very many members, drawn simply: sheets as strips without thickness, the rest as lines."""

from __future__ import annotations

import numpy as np

from ..exchange import FloatArray
from ..scene import Form, Pose, Scene, Strip
from .drawing import GHOST, SOLID, Drawing
from .light import light_of
from .stress import Stress
from .surfaces import OUTLINE
from .visible import visible_stations

#: Up to so many members sheets have their width; beyond, all are lines.
_MOST_STRIPS = 12_000
_SEGMENTS = 4
#: Widths of lines [pt] up to that number, and beyond.
_WIDE, _NARROW = 1.3, 0.6
_DARKER = 0.85


def add_many(
    drawing: Drawing, scene: Scene, pose: Pose, stress: Stress | None, ghost: FloatArray | None
) -> None:
    """Draw very many members.

    Args:
        drawing: Where to.
        scene: The scene.
        pose: Where its nodes are.
        stress: What colours the members; a member has the colour of its larger end.
        ghost: (3,) colour of the reference shape behind them; by default there is none.
    """
    members = scene.members
    few = len(members) <= _MOST_STRIPS
    width = _WIDE if few else _NARROW
    if ghost is not None:
        for strip in visible_stations(members, scene.reference, _SEGMENTS):
            drawing.lines(strip.centre[:, [0, -1]], ghost, width / 2, layer=GHOST)
    colour = members.colour if stress is None else stress.member_colours()
    loud = np.zeros(len(members), bool) if stress is None else stress.is_loud()
    is_sheet = (members.form == Form.SHEET) & few & (not scene.planar)
    for strip in visible_stations(members, pose, _SEGMENTS):
        wide = is_sheet[strip.member]
        own = colour[strip.member]
        for chosen, part in ((~wide & ~loud[strip.member], 1.0), (~wide & loud[strip.member], 2.0)):
            drawing.lines(strip.centre[chosen], _DARKER * own[chosen], part * width, layer=SOLID)
        if wide.any():
            _add_strips(drawing, scene, strip, wide, own[wide])


def _add_strips(
    drawing: Drawing, scene: Scene, strip: Strip, chosen: np.ndarray, colour: FloatArray
) -> None:
    """Sheets as their middle surfaces."""
    section = scene.members.section[strip.member[chosen]]
    wide = np.argmax(section, axis=1)
    along = np.take_along_axis(strip.frame[chosen], (1 + wide)[:, None, None, None], axis=3)[..., 0]
    half = section.max(axis=1)[:, None, None] / 2 * along
    left, right = strip.centre[chosen] - half, strip.centre[chosen] + half
    quads = np.stack((left[:, :-1], right[:, :-1], right[:, 1:], left[:, 1:]), axis=2)
    normal = np.cross(quads[..., 2, :] - quads[..., 0, :], quads[..., 3, :] - quads[..., 1, :])
    towards = np.where((normal @ drawing.view.axes[2])[..., None] < 0.0, -normal, normal)
    shade = light_of(drawing.view).on(towards.reshape(-1, 3))
    pieces = quads.shape[1]
    drawing.polygons(quads.reshape(-1, 4, 3), np.repeat(colour, pieces, axis=0) * shade)
    for edge in (left, right):
        drawing.lines(edge, np.array(OUTLINE), _NARROW / 2)
