# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a result: a figure, or the bytes of a file."""

from __future__ import annotations

import logging
import os
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from importlib.util import find_spec
from numbers import Real
from operator import index
from typing import TYPE_CHECKING, Any

import numpy as np

from ...advice.describe import verdict_in_words
from ...advice.spaces.spaces import Spaces
from ...analysis.result import Result
from ...core.arrays import FloatArray
from ...model.configuration import Configuration
from ...model.data import ModelData
from ...util.errors import require_kind
from ...util.partial import attempted
from ...util.text import harmless, in_short
from ..drawing import Drawing, drawing_of, swing
from ..drawing.view import View, view_of
from ..spaces import SpaceShown
from ..writers import MOVING, PICTURES, VIDEOS
from .canvas import Box
from .figure import compose
from .files import (
    PictureError,
    check_encoder,
    gif_bytes,
    load_matplotlib,
    pixels,
    png_bytes,
    still_bytes,
    video_bytes,
)
from .panel import paint
from .subject import Chosen, Subject, moving_subject, subjects_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure


#: Pixels along a picture, of which matplotlib draws no more.
_WIDEST = 2**15


def check_suffix(suffix: str) -> str:
    """The suffix in small letters, if a picture can be such a file.

    Raises:
        PictureError: It cannot.
    """
    if suffix.lower() not in PICTURES:
        kinds = ", ".join(known.removeprefix(".") for known in PICTURES)
        what = f"{suffix!r} is no kind of picture" if suffix else "the picture has no suffix"
        raise PictureError(f"{what}: it is one of {kinds}, as the suffix of the file says")
    return suffix.lower()


def check_packages(suffix: str = "") -> None:
    """Find out whether what is needed for pictures, or for one of a suffix, is installed.

    Raises:
        PictureError: It is not.
        PictureError: A video is wanted, and nothing is there that makes one.
    """
    if missing := _missing():
        raise PictureError(f"pictures need the package {missing[0]}: pip install matplotlib pillow")
    if suffix.lower() in VIDEOS:
        check_encoder(suffix.lower())


def shown_figure(**options: Any) -> Any:
    """An empty figure of matplotlib that shows itself in a notebook.

    Args:
        **options: As of `matplotlib.figure.Figure`.

    Raises:
        FlexactError: matplotlib is missing.
    """
    check_packages()
    load_matplotlib()
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    class Shown(Figure):
        def _repr_png_(self) -> bytes:
            return png_bytes(self)

    made: Any = Shown(facecolor="white", **options)
    FigureCanvasAgg(made)
    return made


def has_packages() -> bool:
    """Whether what is needed for pictures is installed."""
    return not _missing()


def _missing() -> list[str]:
    needed = {"matplotlib": "matplotlib", "PIL": "pillow"}
    return [name for package, name in needed.items() if find_spec(package) is None]


def draw(
    analysis: Result,
    *,
    motion: int | None = None,
    freedom: int | str | None = None,
    stress: int | None = None,
    quantity: str | None = None,
    spaces: Spaces | None = None,
    held: bool = False,
    view: str | None = None,
    phase: float = 1.0,
    size: tuple[int, int] | None = None,
    plain: bool = False,
) -> Figure:
    """Draw a result.

    Where nothing is chosen, the first motion and the first self-stress, those that there are;
    else the first degree of freedom that moves, else the model.

    Args:
        analysis: The result.
        motion: Number of a motion, from 1.
        freedom: Number of a declared degree of freedom, from 1.
        stress: Number of a self-stress, from 1.
        quantity: Of the self-stress, one of `flexact.show.drawing.QUANTITIES`; by default the
            dominant one.
        spaces: The freedom space and the constraint space of a body, which are shown side by side
            with the wires of the first proposal, dashed (`flexact.advice.spaces.spaces`).
        held: Whether to show what each flexure of an exactly constrained mechanism holds, its
            line or its plane, and how well.
        view: `iso`, `front`, `back`, `left`, `right`, `top`, `bottom`, or the azimuth and the
            elevation of the eye in degrees, as in `-60,25`; z is up. Planar models are drawn
            in their plane.
        phase: Of the motion, from -1 to 1.
        size: Width and height [px].
        plain: Whether titles, captions and legends are left out.

    Returns:
        A figure of matplotlib's, at 100 pixels an inch, that belongs to no window.

    Raises:
        PictureError: A package is missing.
        PictureError: Something chosen is not there.
        BatchError: There is no such view.
        TypeError: What is given is of another kind than it must be.
        ValueError: The phase or the size is out of range.
    """
    require_kind(analysis, Result, "what can be drawn is a result")
    chosen = Chosen(motion, freedom, stress, quantity, spaces, held)
    if not isinstance(phase, Real) or not -1.0 <= phase <= 1.0:
        raise ValueError(f"a phase is a number from -1 to 1, not {in_short(phase)}")
    check_packages()
    load_matplotlib()
    drawing = drawing_of(analysis.given)
    subjects = subjects_of(analysis, drawing, chosen)
    seen, size = view_of(view, drawing), _checked(size)
    return compose(analysis, drawing, subjects, seen, phase=phase, size=size, plain=plain)


def _checked(size: tuple[int, int] | None) -> tuple[int, int] | None:
    """Width and height of a picture, if they can be; None where they are not given.

    Raises:
        TypeError: They are no whole numbers.
        ValueError: They are out of range.
    """
    if size is None:
        return None
    try:
        width, height = map(index, size)
    except (TypeError, ValueError):
        raise TypeError(f"a size is two whole numbers, not {in_short(size)}") from None
    if not (0 < width <= _WIDEST and 0 < height <= _WIDEST):
        raise ValueError(f"a picture is 1 to {_WIDEST} pixels wide and high")
    return width, height


def picture_bytes(
    analysis: Result,
    suffix: str,
    *,
    view: str | None = None,
    size: tuple[int, int] | None = None,
    plain: bool = False,
    progress: Callable[[float], None] | None = None,
    **chosen: Any,
) -> bytes:
    """A picture as the content of a file; the same result gives the same bytes.

    Args:
        analysis: The result.
        suffix: `.png`, `.svg` or `.pdf`; `.gif`, `.mp4` or `.webm`, which move.
        view: As of `draw`.
        size: See there.
        plain: See there.
        progress: Called with the part of the frames of what moves that is drawn, from 0 to 1.
        chosen: `motion`, `freedom`, `stress`, `quantity`, `spaces` and `held`, as of `draw`.

    Raises:
        PictureError: There is no such kind of picture, or a package is missing; else as `draw`.
    """
    kind = check_suffix(suffix)
    check_packages(kind)
    asked = Chosen(**chosen)
    require_kind(analysis, Result, "what can be drawn is a result")

    def subjects(drawing: Drawing) -> list[Subject]:
        if kind in MOVING:
            return [moving_subject(analysis, drawing, asked)]
        return subjects_of(analysis, drawing, asked)

    told = analysis, kind, _words(analysis), view, size, plain, progress
    return _bytes(analysis.given, subjects, *told)


def _bytes(
    data: ModelData,
    subjects: Callable[[Drawing], list[Subject]],
    analysis: Result | None,
    suffix: str,
    words: tuple[str, str],
    view: str | None,
    size: tuple[int, int] | None,
    plain: bool,
    progress: Callable[[float], None] | None = None,
) -> bytes:
    """What is shown of a model as the content of a file; `words` are its title and more."""
    with _quiet():
        load_matplotlib()
        drawing = drawing_of(data)
        shown, seen, size = subjects(drawing), view_of(view, drawing), _checked(size)
        if suffix in MOVING:
            moving = analysis, drawing, shown[0], seen, suffix, words[0]
            return _moving_bytes(*moving, size=size, plain=plain, progress=progress)
        figure = compose(analysis, drawing, shown, seen, size=size, plain=plain)
        return still_bytes(figure, suffix, *words)


def still_of(
    analysis: Result, what: str = "", missing: list[str] | None = None, **chosen: Any
) -> bytes | None:
    """A picture of a result as PNG, where the packages are there and it can be made.

    Args:
        analysis: The result.
        what: What cannot be made otherwise, as of `attempted`.
        missing: Gets a sentence on that.
        chosen: As of `picture_bytes`.
    """
    if not has_packages():
        return None
    return attempted(what, lambda: picture_bytes(analysis, ".png", **chosen), None, missing)


def _words(analysis: Result) -> tuple[str, str]:
    name = harmless(os.path.basename(analysis.name)) or "Mechanism"
    return name, str(verdict_in_words(analysis))


@contextmanager
def _quiet() -> Iterator[None]:
    """Letters that the font lacks are boxes, caches may be anywhere: nothing to warn of."""
    logger = logging.getLogger("matplotlib")
    level = logger.level
    logger.setLevel(logging.ERROR)
    try:
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", message="Glyph .* missing from", category=UserWarning)
            warnings.filterwarnings("ignore", message="Matplotlib currently does not support")
            yield
    finally:
        logger.setLevel(level)


def model_bytes(data: ModelData, size: tuple[int, int]) -> bytes:
    """A picture of a model without words as PNG, so many pixels wide and high.

    Raises:
        PictureError: A package is missing.
    """
    check_packages()
    words = harmless(data.name) or "Mechanism", ""
    return _bytes(data, lambda _: [Subject()], None, ".png", words, None, size, True)


def shape_bytes(
    data: ModelData,
    state: Configuration,
    displacement: FloatArray,
    title: str,
    suffix: str = ".png",
    *,
    view: str | None = None,
    size: tuple[int, int] | None = None,
    plain: bool = False,
) -> bytes:
    """A picture of an elastic shape as the content of a file.

    Args:
        data: The model whose nodes are displaced, such as one whose beams are divided.
        state: Where its nodes are without the shape.
        displacement: (nodes, 3) of positions, and rotations (spins) of orientations; only their
            ratios matter.
        title: Above it, such as "vibrates at 184 Hz".
        suffix: `.png`, `.svg` or `.pdf`; `.gif`, `.mp4` or `.webm`, which move.
        view: As of `draw`.
        size: Width and height [px].
        plain: Whether title and caption are left out.

    Raises:
        PictureError: There is no such kind of picture, or a package is missing.
        BatchError: There is no such view.
    """
    kind = check_suffix(suffix)
    check_packages(kind)
    name, words = harmless(data.name) or "Mechanism", harmless(title[:1].upper() + title[1:])

    def subjects(drawing: Drawing) -> list[Subject]:
        return [Subject(words, movement=swing(drawing, state, displacement, "To first order."))]

    told = (f"{name}: {words}", "") if kind in MOVING else (name, words)
    return _bytes(data, subjects, None, kind, told, view, size, plain)


def spaces_bytes(
    data: ModelData,
    shown: Sequence[SpaceShown],
    title: str,
    suffix: str = ".png",
    *,
    view: str | None = None,
    size: tuple[int, int] | None = None,
    plain: bool = False,
) -> bytes:
    """A picture of spaces, side by side, as the content of a file.

    Args:
        data: The model with which they are drawn, such as a body alone.
        shown: The spaces.
        title: Of the file.
        suffix: `.png`, `.svg` or `.pdf`.
        view: As of `draw`.
        size: Width and height [px].
        plain: Whether titles and captions are left out.

    Raises:
        PictureError: There is no such kind of picture, or a package is missing.
        BatchError: There is no such view.
    """
    kind = check_suffix(suffix)
    if kind in MOVING:
        raise PictureError("freedom and constraint spaces do not move: they are a PNG or an SVG")
    check_packages(kind)
    subjects = [Subject(harmless(each.title), space=each) for each in shown]
    told = (harmless(title), "")
    return _bytes(data, lambda _: subjects, None, kind, told, view, size, plain)


#: Frames of a cycle, and of a full turn; how long each stands [ms].
_CYCLE, _TURN = 36, 48
_DURATION = 50
#: Width and height [px].
_SIZE = (720, 608)
#: Phases at which a motion is looked at for the room that it takes.
_LOOKED_AT = (-1.0, -0.5, 0.0, 0.5, 1.0)


def _moving_bytes(
    analysis: Result | None,
    drawing: Drawing,
    subject: Subject,
    view: View,
    suffix: str,
    title: str,
    *,
    size: tuple[int, int] | None = None,
    plain: bool = False,
    progress: Callable[[float], None] | None = None,
) -> bytes:
    """The animation as a GIF that runs without end, or as a video of one cycle that loops.

    All frames share one scale, and those of a GIF one palette, so that nothing but what moves
    changes.
    """
    made: list[np.ndarray] = []
    order, phases, views = _schedule(drawing, subject, view)
    box = _reach(drawing, subject, views)
    for number, (phase, each) in enumerate(zip(phases, views, strict=True)):
        figure = compose(
            analysis,
            drawing,
            [subject],
            each,
            phase=phase,
            size=size or _SIZE,
            plain=plain,
            box=box,
        )
        made.append(_after(made[0], figure) if made and drawing.planar else pixels(figure))
        if progress is not None:
            progress((number + 1) / (len(phases) + (suffix in VIDEOS)))
    if suffix not in VIDEOS:
        return gif_bytes(made, order, _DURATION)
    content = video_bytes(made, order, _DURATION, suffix, title)
    if progress is not None:
        progress(1.0)
    return content


def _after(first: np.ndarray, figure: Figure) -> np.ndarray:
    """The pixels of a later figure, of which only the axes differ from those of the first.

    Words stand above and below planar drawings, and to draw them takes as long as the rest.
    """
    for words in figure.texts:
        words.set_visible(False)
    made, box = first.copy(), figure.axes[0].bbox
    rows = slice(len(made) - int(np.ceil(box.y1)), len(made) - int(np.floor(box.y0)))
    made[rows] = pixels(figure)[rows]
    return made


def _schedule(
    drawing: Drawing, subject: Subject, view: View
) -> tuple[list[int], list[float], list[View]]:
    """Which drawings the frames show, and the phase and view of each drawing."""
    if subject.movement is not None:
        # From rest to the end, to the other end, and back to rest; the ways back show the same
        # drawings as the ways there.
        there = _CYCLE // 2
        rest = there // 2
        phases = np.cos(np.pi * np.arange(there + 1) / there).tolist()
        phases[rest] = 0.0
        order = [*range(rest, 0, -1), *range(there), *range(there, rest, -1)]
        return order, phases, [view] * len(phases)
    if drawing.planar:
        return [0], [0.0], [view]
    views = [View(view.azimuth + 360.0 * k / _TURN, view.elevation) for k in range(_TURN)]
    return list(range(_TURN)), [0.0] * _TURN, views


def _reach(drawing: Drawing, subject: Subject, views: list[View]) -> Box:
    """The box round all frames, so that the scale stays."""
    if subject.movement is not None:
        boxes = [paint(drawing, subject, views[0], phase)[0].box for phase in _LOOKED_AT]
    else:
        boxes = [paint(drawing, subject, view)[0].box for view in views[:: len(views) // 4 or 1]]
        boxes += [_cylinder(drawing, view) for view in views]
    low, high = zip(*boxes, strict=True)
    return np.min(low, axis=0), np.max(high, axis=0)


def _cylinder(drawing: Drawing, view: View) -> Box:
    """The box round the upright cylinder in which a turning drawing stays."""
    nodes = np.unique(drawing.members.nodes[:, [0, 2]])
    offset = drawing.reference.position[nodes] - drawing.centre
    radius = np.linalg.norm(offset[:, :2], axis=1).max(initial=0.0)
    flat = view.project(drawing.centre)[:2]
    rise = np.abs(view.axes[1, 2]) * (drawing.high[2] - drawing.low[2]) / 2
    rise += np.hypot(*view.axes[1, :2]) * radius
    half = np.array((radius, rise))
    return flat - half, flat + half
