# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a result: a figure, or the bytes of a file."""

from __future__ import annotations

import logging
import os
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from numbers import Real
from operator import index
from typing import TYPE_CHECKING, Any

from ...advice.describe import verdict_in_words
from ...advice.spaces.spaces import Spaces
from ...analysis.result import Result
from ...core.arrays import FloatArray
from ...model.configuration import Configuration
from ...model.data import ModelData
from ...util.errors import BatchError, require_kind
from ...util.partial import attempted
from ...util.text import harmless, in_short
from ..drawing import drawing_of, swing
from ..drawing.view import view_of
from ..writers import MOVING, PICTURES, VIDEOS
from .animation import check_encoder, moving_bytes
from .figure import compose
from .files import load_matplotlib, png_bytes, still_bytes
from .subject import Chosen, Subject, moving_subject, subjects_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure


#: Pixels along a picture, of which matplotlib draws no more.
_WIDEST = 2**15


class PictureError(BatchError):
    """A picture that cannot be made."""


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
        VideoError: A video is wanted, and nothing is there that makes one.
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
        SubjectError: Something chosen is not there.
        ViewError: There is no such view.
        TypeError: What is given is of another kind than it must be.
        ValueError: The phase or the size is out of range.
    """
    return _figure(
        analysis, Chosen(motion, freedom, stress, quantity, spaces, held), view, phase, size, plain
    )


def _figure(
    analysis: Result,
    chosen: Chosen,
    view: str | None,
    phase: float,
    size: tuple[int, int] | None,
    plain: bool,
) -> Figure:
    require_kind(analysis, Result, "what can be drawn is a result")
    if not isinstance(phase, Real) or not -1.0 <= phase <= 1.0:
        raise ValueError(f"a phase is a number from -1 to 1, not {in_short(phase)}")
    check_packages()
    load_matplotlib()
    drawing = drawing_of(analysis.given)
    subjects = subjects_of(analysis, drawing, chosen)
    seen = view_of(view, drawing)
    size = None if size is None else checked_size(size)
    return compose(analysis, drawing, subjects, seen, phase=phase, size=size, plain=plain)


def checked_size(size: object) -> tuple[int, int]:
    """Width and height of a picture, if they can be.

    Raises:
        TypeError: They are no whole numbers.
        ValueError: They are out of range.
    """
    try:
        width, height = (index(side) for side in size)  # type: ignore[attr-defined]
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
    with quiet():
        load_matplotlib()
        words = _words(analysis)
        if kind in MOVING:
            size = None if size is None else checked_size(size)
            drawing = drawing_of(analysis.given)
            subject, seen = moving_subject(analysis, drawing, asked), view_of(view, drawing)
            shown = analysis, drawing, subject, seen, kind, words[0]
            return moving_bytes(*shown, size=size, plain=plain, progress=progress)
        return still_bytes(_figure(analysis, asked, view, 1.0, size, plain), kind, *words)


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
def quiet() -> Iterator[None]:
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


def model_bytes(
    data: ModelData,
    suffix: str = ".png",
    *,
    view: str | None = None,
    size: tuple[int, int] | None = None,
) -> bytes:
    """A picture of a model without words, as the content of a file.

    Args:
        data: The model.
        suffix: `.png`, `.svg` or `.pdf`.
        view: As of `draw`.
        size: Width and height [px].

    Raises:
        PictureError: There is no such kind of picture, or a package is missing.
        ViewError: There is no such view.
    """
    kind = check_suffix(suffix)
    check_packages()
    with quiet():
        load_matplotlib()
        drawing = drawing_of(data)
        seen = view_of(view, drawing)
        size = None if size is None else checked_size(size)
        figure = compose(None, drawing, [Subject()], seen, size=size, plain=True)
        return still_bytes(figure, kind, harmless(data.name) or "Mechanism", "")


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
        ViewError: There is no such view.
    """
    kind = check_suffix(suffix)
    check_packages(kind)
    with quiet():
        load_matplotlib()
        drawing = drawing_of(data)
        words = harmless(title[:1].upper() + title[1:])
        subject = Subject(words, movement=swing(drawing, state, displacement, "To first order."))
        seen = view_of(view, drawing)
        size = None if size is None else checked_size(size)
        name = harmless(data.name) or "Mechanism"
        if kind in MOVING:
            shown = drawing, subject, seen, kind, f"{name}: {words}"
            return moving_bytes(None, *shown, size=size, plain=plain)
        figure = compose(None, drawing, [subject], seen, size=size, plain=plain)
        return still_bytes(figure, kind, name, words)
