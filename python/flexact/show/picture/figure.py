# SPDX-License-Identifier: BSD-3-Clause
"""The picture as a figure of matplotlib: panels, titles, legend, axes."""

from __future__ import annotations

import os
import textwrap
from bisect import bisect_right
from typing import TYPE_CHECKING, Any

import numpy as np

from ...advice.describe import verdict_in_words
from ...analysis.naming import plain as without_links
from ...analysis.verdict_words import margin_in_short, margin_line
from ...core.arrays import FloatArray
from ...util.text import harmless
from ...util.units import Units
from ..drawing import BENDING, UNITS, Drawing, meanings_in, reach_of
from ..drawing.members import diverging
from ..drawing.movement import AMPLITUDE
from ..drawing.presses import presses_in_words
from ..drawing.view import View
from .canvas import Box, Canvas
from .panel import detail_of, paint
from .stress import Peak, Stress
from .subject import Subject

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from ...analysis.result import Result


#: How far round a place is looked for room: distances [px], and so many directions.
_FAR = np.concatenate((np.arange(14.0, 190.0, 8.0), np.arange(190.0, 480.0, 24.0)))
_WAYS = 16


class Room:
    """What is free of a panel, in pixels from its lower left corner."""

    def __init__(self, axes: Any, canvas: Canvas) -> None:
        """Find out where something is drawn."""
        first, last = canvas.boxes()
        self._low, self._high = axes.bbox.min, axes.bbox.max
        if len(first):
            self.first, self.last = axes.transData.transform(first), axes.transData.transform(last)
        else:
            self.first = self.last = np.zeros((0, 2))

    def is_free(self, middle: FloatArray, half: FloatArray) -> bool:
        """Whether a box lies in the panel, and nothing in it."""
        low, high = middle - half, middle + half
        if np.any(low < self._low) or np.any(high > self._high):
            return False
        return not np.any(np.all((self.first < high) & (self.last > low), axis=1))

    def take(self, middle: FloatArray, half: FloatArray) -> None:
        """Say that a box is full now."""
        self.first = np.concatenate((self.first, (middle - half)[None]))
        self.last = np.concatenate((self.last, (middle + half)[None]))

    def near(self, place: FloatArray, away: FloatArray, half: FloatArray) -> FloatArray | None:
        """The free box of this half size nearest to a place; None where there is none near.

        Of equally near ones that which lies most in the direction `away`.
        """
        start = np.arctan2(away[1], away[0])
        turns = np.array(
            [0.0, *(s * k for k in range(1, _WAYS // 2) for s in (1.0, -1.0)), _WAYS / 2]
        )
        for far in _FAR:
            for angle in start + 2 * np.pi / _WAYS * turns:
                middle = place + far * np.array((np.cos(angle), np.sin(angle)))
                if self.is_free(middle, half):
                    return np.asarray(middle)
        return None


#: Pixels an inch, as wide as one panel is [px], and its height.
DPI = 100
PANEL = (900, 760)
_INK = (0.13, 0.15, 0.18)
_FAINT = (0.38, 0.40, 0.43)
_SIZES = {"name": 11.5, "title": 14.0, "panel": 12.0, "caption": 10.5, "legend": 10.0}
#: Parts of a panel's width at each side, and of its height, that stay free.
_MARGIN = 0.05
#: A rotation beyond this [rad] says why displacements are no larger.
_TURNED = 0.9
#: Displacements below this part of the size, and rotations [rad], would be told as 0.
_UNMOVED, _UNTURNED = 0.005, 0.05
#: Words farther from their place than this have a line to it [px].
_FIGURE_FAR = 30.0
#: Half the room of the axes [px].
_TRIAD = 56.0
#: Pieces of the bar of colours.
_PIECES = 128
#: Lines of the margin below the verdict; in few words where it takes more.
_MOST_OF_MARGIN = 2
#: After a name that is cut.
_CUT = "..."
#: Values nearer to each other than this are told once [px].
_APART = np.array((52.0, 16.0))


def compose(
    analysis: Result | None,
    drawing: Drawing,
    subjects: list[Subject],
    view: View,
    *,
    phase: float = 1.0,
    size: tuple[int, int] | None = None,
    plain: bool = False,
    box: Box | None = None,
) -> Figure:
    """The figure of some subjects side by side.

    Args:
        analysis: The result, of which the verdict is the title; None without one.
        drawing: Its drawing.
        subjects: What is shown, a panel each.
        view: From where.
        phase: Of movements, from -1 to 1.
        size: Width and height [px].
        plain: Whether titles, captions and legend are left out.
        box: What is to be seen; by default all that is drawn.
    """
    from matplotlib.figure import Figure

    width, height = size or (PANEL[0] * len(subjects), PANEL[1])
    figure = Figure(figsize=(width / DPI, height / DPI), dpi=DPI, facecolor="white")
    scale = float(np.clip(width / len(subjects) / PANEL[0], 0.3, 2.0))
    frame = _Frame(figure, width, height, scale)
    top = 0.0 if plain else 14.0 * scale
    if not plain and analysis is not None:
        top = _add_verdict(frame, analysis)
    fineness = 0.2 + 0.6 * scale if plain else scale
    panels = [paint(drawing, subject, view, phase, fineness) for subject in subjects]
    if box is None and all(subject.space is not None for subject in subjects):
        # Spaces of one body are seen in one scale.
        low, high = zip(*(canvas.box for canvas, _ in panels), strict=True)
        box = (np.min(low, axis=0), np.max(high, axis=0))
    for number, (subject, panel) in enumerate(zip(subjects, panels, strict=True)):
        left, right = (width * n / len(subjects) for n in (number, number + 1))
        seen = panel[0].box if box is None else box
        _add_panel(frame, drawing, subject, panel, seen, (left, right), top, plain)
    return figure


class _Frame:
    """A figure measured in pixels from its upper left corner."""

    def __init__(self, figure: Figure, width: float, height: float, scale: float) -> None:
        self.figure, self.width, self.height, self.scale = figure, width, height, scale

    def text(self, x: float, y: float, text: str, kind: str, **others: Any) -> None:
        others = {"va": "top", "ha": "left", "color": _INK, **others}
        self.figure.text(
            x / self.width,
            1 - y / self.height,
            text,
            fontsize=self._points(kind),
            parse_math=False,
            **others,
        )

    def lines(self, x: float, y: float, lines: list[str], kind: str, **others: Any) -> float:
        """Put lines of text below each other; where they end [px]."""
        for line in lines:
            self.text(x, y, line, kind, **others)
            y += self.line(kind)
        return y

    def wide(self, text: str, kind: str) -> float:
        """Width of a line of text [px], on a raster, where letters are wider."""
        from matplotlib.backends.backend_agg import RendererAgg
        from matplotlib.font_manager import FontProperties

        font = FontProperties(size=self._points(kind))
        raster: Any = RendererAgg(1, 1, DPI)  # type: ignore[no-untyped-call]
        return float(raster.get_text_width_height_descent(text, font, ismath=False)[0])

    def _points(self, kind: str) -> float:
        return _SIZES[kind] * self.scale * 72 / DPI * 1.25

    def axes(self, left: float, top: float, right: float, bottom: float) -> Axes:
        made = self.figure.add_axes(_part(self, left, top, right, bottom))
        made.set_axis_off()
        return made

    def line(self, kind: str) -> float:
        """Height of a line of text [px]."""
        return _SIZES[kind] * self.scale * 1.25 * 1.32


def _add_verdict(frame: _Frame, analysis: Result) -> float:
    """The name, the verdict and the margin; where they end [px]."""
    left, y = 18 * frame.scale, 14 * frame.scale
    if name := harmless(os.path.basename(analysis.name)):
        y = frame.lines(left, y, [_cut(name, frame, "name")], "name", color=_FAINT)
    words = str(verdict_in_words(analysis))
    # As few lines as can be, about equally long.
    narrow = _letters(frame, "title")
    lines = textwrap.wrap(words, narrow)
    while narrow > 12 and len(textwrap.wrap(words, narrow - 1)) == len(lines):
        narrow -= 1
    look = {"color": analysis.colour, "weight": "bold"}
    y = frame.lines(left, y, textwrap.wrap(words, narrow), "title", **look)
    lines = textwrap.wrap(without_links(margin_line(analysis).head), _letters(frame, "caption"))
    if len(lines) > _MOST_OF_MARGIN:
        lines = [f"{margin_in_short(analysis).capitalize()}."]
    return frame.lines(left, y, lines, "caption") + 4 * frame.scale


def _letters(frame: _Frame, kind: str, width: float | None = None) -> int:
    """How many letters fit."""
    room = (width or frame.width) - 36 * frame.scale
    return max(12, int(room / (0.585 * _SIZES[kind] * frame.scale * 1.25)))


def _cut(text: str, frame: _Frame, kind: str) -> str:
    """As much of a line as fits, by the widths of its letters."""
    if frame.wide(text, kind) <= (room := frame.width - 36 * frame.scale):
        return text
    # The longest beginning that fits: longer ones are wider.
    most = bisect_right(
        range(len(text)), room, key=lambda count: frame.wide(f"{text[:count]}{_CUT}", kind)
    )
    return f"{text[: max(most - 1, 0)]}{_CUT}"


def _add_panel(
    frame: _Frame,
    drawing: Drawing,
    subject: Subject,
    panel: tuple[Canvas, list[Peak]],
    box: Box,
    sides: tuple[float, float],
    top: float,
    plain: bool,
) -> None:
    (left, right), (canvas, peaks) = sides, panel
    pad = 18 * frame.scale
    bottom = frame.height
    if not plain:
        title = textwrap.wrap(subject.title, _letters(frame, "panel", right - left))
        top = frame.lines(left + pad, top, title, "panel")
        words = _caption(drawing, subject)
        lines = textwrap.wrap(words, _letters(frame, "caption", right - left))
        bottom -= frame.line("caption") * len(lines) + 0.6 * pad
        for number, line in enumerate(lines):
            y = bottom + number * frame.line("caption") + 0.2 * pad
            frame.text(left + pad, y, line, "caption", color=_FAINT)
        if subject.stress is not None:
            bottom -= frame.line("legend") * 3.6
    axes = frame.axes(left, top, right, bottom)
    axes.add_artist(canvas.artist())
    _fit(axes, box, (right - left, bottom - top))
    if not plain:
        room = Room(axes, canvas)
        if not drawing.planar:
            middle = _place_for_triad(frame, room, (left, top, right, bottom))
            if middle is None:
                # Nowhere beside the drawing: below it.
                strip = 2 * _TRIAD * frame.scale
                axes.set_position(_part(frame, left, top, right, bottom - strip))
                _fit(axes, box, (right - left, bottom - strip - top))
                middle = left + _TRIAD * frame.scale, bottom - 0.9 * _TRIAD * frame.scale
                room = Room(axes, canvas)
            _add_triad(frame, canvas.view, *middle)
        # Of values at peaks that coincide one is told.
        told: list[FloatArray] = []
        for top_of_peak, foot_of_peak, value in peaks:
            ends = canvas.view.project(np.stack((foot_of_peak, top_of_peak)))[:, :2]
            foot, peak = np.asarray(axes.transData.transform(ends))
            if any(np.all(np.abs(peak - each) < _APART * frame.scale) for each in told):
                continue
            told.append(peak)
            if subject.stress is not None:
                value = drawing.data.units.shown(value, UNITS[subject.stress.quantity])
            _add_label(frame, room, peak, peak - foot, signed(value))
        for place, words in subject.space.labels if subject.space is not None else ():
            there = axes.transData.transform(canvas.view.project(place)[:2])
            _add_label(frame, room, np.asarray(there), np.array((0.3, 1.0)), words)
        if subject.stress is not None:
            words = meanings_in(drawing)[subject.stress.quantity]
            sides = left + pad, right - pad
            _add_legend(frame, subject.stress, words, sides, bottom, drawing.data.units)


def _fit(axes: Axes, box: Box, room: tuple[float, float]) -> None:
    """Have axes show a box as large as it fits."""
    low, high = box
    extent = np.maximum(high - low, 1.0e-9 * np.max(high - low, initial=1.0e-300))
    pixels = np.array(room) * (1 - 2 * _MARGIN)
    unit = float(np.max(extent / np.maximum(pixels, 1.0))) or 1.0
    middle, half = (low + high) / 2, unit * np.array(room) / 2
    axes.set_xlim(middle[0] - half[0], middle[0] + half[0])
    axes.set_ylim(middle[1] - half[1], middle[1] + half[1])


def _caption(drawing: Drawing, subject: Subject) -> str:
    """What is to be known of a panel."""
    hinges = drawing.hinges
    if len(hinges) and not len(drawing.members) and not np.any(hinges.nodes[:, 0] >= 0):
        return "Nothing can be placed: the hinges stand at no node whose position is known."
    simply = f" {len(drawing.members)} members, drawn simply." * (detail_of(drawing) is None)
    movement, about = subject.movement, ""
    if subject.space is not None:
        about = subject.space.words
    elif subject.stress is not None:
        about = "Relative values, only their ratios matter."
        if subject.stress.presses:
            about = f"{about} {presses_in_words(subject.stress.values.length, drawing.data.units)}"
    elif movement is None:
        about = "Arrows: declared degrees of freedom." * (len(drawing.arrows[0]) > 0)
    else:
        largest, turned = reach_of(drawing, [movement.pose(1.0)])
        part = largest / drawing.size
        size = f"largest displacement {100 * part:.0f} % of the model's size"
        if part < _UNMOVED and turned > _UNTURNED:
            size = f"largest rotation {turned:.1f} rad"
        elif turned > _TURNED and part < AMPLITUDE * 0.95:
            size = f"{size}, largest rotation {turned:.1f} rad"
        about = f"Enlarged: {size}; grey: the reference shape. {movement.remark}"
    return f"{about}{simply}".strip()


def _add_legend(
    frame: _Frame,
    stress: Stress,
    told: str,
    sides: tuple[float, float],
    top: float,
    units: Units,
) -> None:
    """A bar of the colours, with what they mean and the values at its ends."""
    from matplotlib.collections import PolyCollection

    line = frame.line("legend")
    where = ", drawn on the stretched side" * (stress.quantity in BENDING)
    unit = UNITS[stress.quantity]
    frame.text(sides[0], top, f"{told} [{units.symbol(unit)}]{where}", "legend")
    width = min(320 * frame.scale, sides[1] - sides[0])
    axes = frame.axes(sides[0], top + 1.25 * line, sides[0] + width, top + 2.0 * line)
    # Each piece reaches to the end, so that there are no seams between them.
    start = np.linspace(0.0, 1.0, _PIECES, endpoint=False)
    pieces = [((x, 0.0), (1.0, 0.0), (1.0, 1.0), (x, 1.0)) for x in start.tolist()]
    colours = diverging(2 * start + 1 / _PIECES - 1)
    axes.add_collection(PolyCollection(pieces, facecolors=colours, linewidths=0), autolim=False)
    axes.set_xlim(0.0, 1.0)
    axes.set_ylim(0.0, 1.0)
    values = ((0.0, -1.0, "left"), (0.5, 0.0, "center"), (1.0, 1.0, "right"))
    for place, value, side in values if stress.largest > 0.0 else values[1:2]:
        words = signed(units.shown(value * stress.largest, unit)) if value else "0"
        frame.text(sides[0] + place * width, top + 2.15 * line, words, "legend", ha=side)


def signed(value: float) -> str:
    """Three digits and a sign, such as "+0.333" or "-1000"."""
    short = f"{value:+.3g}"
    return f"{value:+.0f}" if "e" in short and 1.0 <= abs(value) < 1e5 else short


def _add_label(frame: _Frame, room: Room, place: FloatArray, away: FloatArray, words: str) -> None:
    """Words near a place [px], where nothing else is; with a line to it where they are far."""
    from matplotlib.lines import Line2D
    from matplotlib.patheffects import withStroke

    half = np.array((frame.wide(words, "legend") / 2 + 3, frame.line("legend") / 2))
    found = room.near(place, away, half * np.array((1.0, 0.8)))
    if found is None:
        found = place + 14 * frame.scale * away / max(float(np.hypot(*away)), 1.0e-9)
    room.take(found, half)
    far = float(np.linalg.norm(found - place))
    if far > _FIGURE_FAR * frame.scale:
        towards = (place - found) / far
        edge = float(np.min(half / np.maximum(np.abs(towards), 1.0e-9)))
        ends = np.stack((place, found + edge * towards))
        x, y = (ends / (frame.width, frame.height)).T
        figure = frame.figure
        figure.add_artist(Line2D(x, y, color=_FAINT, lw=0.6 * frame.scale))
    halo = [withStroke(linewidth=2.4 * frame.scale, foreground="white")]
    x, y = float(found[0]), frame.height - float(found[1])
    frame.text(x, y, words, "legend", va="center", ha="center", path_effects=halo)


def _part(
    frame: _Frame, left: float, top: float, right: float, bottom: float
) -> tuple[float, float, float, float]:
    """Left, bottom, width and height as parts of the figure, of sides in pixels."""
    width, height = (right - left) / frame.width, (bottom - top) / frame.height
    return left / frame.width, 1 - bottom / frame.height, width, height


def _place_for_triad(
    frame: _Frame, room: Room, sides: tuple[float, float, float, float]
) -> tuple[float, float] | None:
    """A corner of a panel where nothing is drawn: the middle of the axes there [px]."""
    half = _TRIAD * frame.scale
    left, top, right, bottom = sides
    for x, y in (
        (left + half, bottom - 0.9 * half),
        (right - half, bottom - 0.9 * half),
        (right - half, top + half),
        (left + half, top + half),
    ):
        middle, size = np.array((x, frame.height - y)), np.full(2, 0.85 * half)
        if room.is_free(middle, size):
            room.take(middle, size)
            return x, y
    return None


def _add_triad(frame: _Frame, view: View, x: float, y: float) -> None:
    """Which way the axes point: z is up."""
    length = 30 * frame.scale
    axes = frame.axes(x - 2 * length, y - 2 * length, x + 2 * length, y + 2 * length)
    axes.set_xlim(-2, 2)
    axes.set_ylim(-2, 2)
    for name, end in zip("xyz", view.project(np.eye(3)).tolist(), strict=True):
        if np.hypot(*end[:2]) < 0.1:
            continue
        axes.annotate(
            "",
            end[:2],
            (0.0, 0.0),
            arrowprops={
                "arrowstyle": "-|>",
                "color": _FAINT,
                "lw": frame.scale,
                "shrinkA": 0,
                "shrinkB": 0,
                "mutation_scale": 8 * frame.scale,
            },
        )
        away = 1.28 / max(np.hypot(*end[:2]), 0.5) * 1.0
        frame.text(
            x + end[0] * length * (1 + 0.3 * away),
            y - end[1] * length * (1 + 0.3 * away),
            name,
            "legend",
            color=_FAINT,
            va="center",
            ha="center",
        )
