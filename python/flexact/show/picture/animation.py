# SPDX-License-Identifier: BSD-3-Clause
"""Frames as a video, MP4 (H.264) or WebM (VP9), by ffmpeg: as browsers and slides play it."""

from __future__ import annotations

import contextlib
import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterable
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ...analysis.result import Result
from ...util.errors import BatchError, reason_of
from ...util.text import harmless
from ..drawing import Drawing
from ..drawing.view import View
from ..writers import VIDEOS
from .canvas import Box
from .figure import compose
from .files import gif_bytes, pixels
from .panel import paint
from .subject import Subject

if TYPE_CHECKING:
    from matplotlib.figure import Figure


#: Of each suffix the encoders that browsers can play, the best first, and what they are told.
_H264 = ("-preset", "slow", "-crf", "16", "-tune", "animation", "-movflags", "+faststart")
_ENCODERS: dict[str, dict[str, tuple[str, ...]]] = {
    ".mp4": {"libx264": _H264, "libopenh264": ("-b:v", "4M", "-movflags", "+faststart")},
    ".webm": {"libvpx-vp9": ("-crf", "22", "-b:v", "0", "-deadline", "good", "-cpu-used", "2")},
}
#: Colours as screens have them, told to players; nothing that differs from run to run.
_COLOURS = ("-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709")
_SAME = ("-map_metadata", "-1", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-threads", "1")
_FILTER = "scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int"


class VideoError(BatchError):
    """A video that cannot be made."""


def check_encoder(suffix: str) -> tuple[str, str]:
    """The program that makes such a video, and its encoder.

    Args:
        suffix: `.mp4` or `.webm`.

    Raises:
        VideoError: There is none.
    """
    programs = _programs()
    for program in programs:
        there = _encoders_of(program)
        for encoder in _ENCODERS[suffix]:
            if encoder in there:
                return program, encoder
    kind = suffix.removeprefix(".").upper()
    lacks = f"; the ffmpeg that is here has no encoder for {kind}" if programs else ""
    raise VideoError(
        f"a video needs ffmpeg{lacks}: install it so that it is on the PATH, or the package "
        "imageio-ffmpeg, which brings it: pip install imageio-ffmpeg"
    )


def video_bytes(
    drawings: list[np.ndarray], order: Iterable[int], duration: int, suffix: str, title: str
) -> bytes:
    """Drawings (height, width, 3) as the frames of a video.

    Args:
        drawings: Of 8 bits a colour. Odd sizes get a further row or column, as players want.
        order: Which drawing each frame shows.
        duration: How long each frame is shown [ms].
        suffix: `.mp4` or `.webm`.
        title: In the file's metadata.

    Raises:
        VideoError: There is no encoder, or it fails.
    """
    program, encoder = check_encoder(suffix)
    even = [_even(each) for each in drawings]
    height, width = even[0].shape[:2]
    frames = [each.tobytes() for each in even]
    with tempfile.TemporaryDirectory(prefix="flexact-") as folder:
        made = Path(folder) / f"video{suffix}"
        command = [
            *(program, "-hide_banner", "-loglevel", "error", "-y"),
            *("-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}"),
            *("-framerate", f"1000/{duration}", "-i", "pipe:0"),
            *("-vf", f"{_FILTER},format=yuv420p", "-c:v", encoder, *_ENCODERS[suffix][encoder]),
            *(*_COLOURS, *_SAME, "-metadata", f"title={harmless(title)}", str(made)),
        ]
        try:
            _encode(command, (frames[k] for k in order), Path(folder) / "said")
            return made.read_bytes()
        except OSError as error:
            raise VideoError(f"ffmpeg made no video: {reason_of(error)}") from error


def _encode(command: list[str], frames: Iterable[bytes], said: Path) -> None:
    """Give the frames to ffmpeg one by one; what it says goes to a file.

    Raises:
        VideoError: It fails.
    """
    with open(said, "wb") as words:
        running = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=words
        )
        assert running.stdin is not None
        try:
            # Where it ends early it has said why.
            with contextlib.suppress(BrokenPipeError), running.stdin as pipe:
                for frame in frames:
                    pipe.write(frame)
            code = running.wait()
        finally:
            if running.poll() is None:
                running.kill()
                running.wait()
    if code:
        lines = said.read_text("utf-8", "replace").split("\n")
        why = next((line.strip() for line in reversed(lines) if line.strip()), f"code {code}")
        raise VideoError(f"ffmpeg made no video: {harmless(why)}")


def _even(drawing: np.ndarray) -> np.ndarray:
    height, width = drawing.shape[:2]
    return np.pad(drawing, ((0, height % 2), (0, width % 2), (0, 0)), mode="edge")


def _programs() -> list[str]:
    """The programs ffmpeg that there are, the user's first."""
    found = [each for each in (shutil.which("ffmpeg"),) if each]
    if find_spec("imageio_ffmpeg") is not None:
        import imageio_ffmpeg

        # Where the package brings no program for this machine it has none.
        with contextlib.suppress(RuntimeError):
            found.append(os.fspath(imageio_ffmpeg.get_ffmpeg_exe()))
    return found


@cache
def _encoders_of(program: str) -> frozenset[str]:
    """Names of the encoders that a program has."""
    try:
        told = subprocess.run(
            [program, "-hide_banner", "-encoders"],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            check=True,
            timeout=60,
        ).stdout
    except (OSError, subprocess.SubprocessError):
        return frozenset()
    rows = (line.split() for line in told.decode("utf-8", "replace").splitlines())
    return frozenset(row[1] for row in rows if len(row) > 1)


#: Frames of a cycle, and of a full turn; how long each stands [ms].
CYCLE, TURN = 36, 48
_DURATION = 50
#: Width and height [px].
SIZE = (720, 608)
#: Phases at which a motion is looked at for the room that it takes.
_LOOKED_AT = (-1.0, -0.5, 0.0, 0.5, 1.0)

Told = Callable[[float], None]


def moving_bytes(
    analysis: Result | None,
    drawing: Drawing,
    subject: Subject,
    view: View,
    suffix: str,
    title: str,
    *,
    size: tuple[int, int] | None = None,
    plain: bool = False,
    progress: Told | None = None,
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
            size=size or SIZE,
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
        there = CYCLE // 2
        rest = there // 2
        phases = np.cos(np.pi * np.arange(there + 1) / there).tolist()
        phases[rest] = 0.0
        order = [*range(rest, 0, -1), *range(there), *range(there, rest, -1)]
        return order, phases, [view] * len(phases)
    if drawing.planar:
        return [0], [0.0], [view]
    views = [view.turned(360.0 * k / TURN) for k in range(TURN)]
    return list(range(TURN)), [0.0] * TURN, views


def _reach(drawing: Drawing, subject: Subject, views: list[View]) -> Box:
    """The box round all frames, so that the scale stays."""
    if subject.movement is not None:
        boxes = [paint(drawing, subject, views[0], phase).canvas.box for phase in _LOOKED_AT]
    else:
        boxes = [
            paint(drawing, subject, view).canvas.box for view in views[:: len(views) // 4 or 1]
        ]
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
