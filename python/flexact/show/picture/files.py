# SPDX-License-Identifier: BSD-3-Clause
"""Figures as files, the same whenever they are made: PNG, SVG, PDF; frames as a GIF or a video.

A video is MP4 (H.264) or WebM (VP9), by ffmpeg: as browsers and slides play it.
"""

from __future__ import annotations

import contextlib
import io
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterable
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING, Any
from xml.sax.saxutils import escape

import numpy as np

from ...util.errors import BatchError, reason_of
from ...util.text import harmless

if TYPE_CHECKING:
    from matplotlib.figure import Figure


_VARIABLE = "MPLBACKEND"
_ONE_AT_A_TIME = Lock()


class PictureError(BatchError):
    """A picture that cannot be made."""


def load_matplotlib() -> None:
    """Import matplotlib, which cannot be imported where MPLBACKEND names no backend.

    A backend that there is stays the user's choice.
    """
    with _ONE_AT_A_TIME:
        wanted = os.environ.get(_VARIABLE)
        if "matplotlib" in sys.modules or not wanted:
            return
        del os.environ[_VARIABLE]
        try:
            import matplotlib
        finally:
            os.environ[_VARIABLE] = wanted
    try:
        matplotlib.rcParams["backend"] = wanted
    except ValueError:
        return


#: What would differ from run to run is left out; identifiers follow from what is drawn.
_SVG: Any = {"svg.fonttype": "none", "svg.hashsalt": "flexact"}
_NOTHING = {"Date": None, "Creator": None, "Format": None, "Type": None}
#: Whole letters that can be searched and copied, in one compressed file.
_PDF: Any = {"pdf.fonttype": 42, "pdf.compression": 6}
_UNDATED = {"CreationDate": None, "Creator": None, "Producer": None}
#: A path's data, and what is left out of its numbers: less than a hundredth of a point.
_PATH, _DIGITS = re.compile(r'<path [^>]*?\bd="[^"]*"'), re.compile(r"(\.\d\d)\d+")
#: Colours of a GIF, and pixels of one colour from which on there might as well be more.
_COLOURS, _ALIKE = 160, 30


def pixels(figure: Figure) -> np.ndarray:
    """(height, width, 3) the figure, 8 bits a colour."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    canvas: Any = FigureCanvasAgg(figure)
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[..., :3].copy()


def png_bytes(figure: Figure) -> bytes:
    """The figure as a PNG; matplotlib's own name and version are left out."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", metadata={"Software": None})
    return buffer.getvalue()


def fewer_colours(content: bytes, colours: int) -> bytes:
    """A PNG in few colours, which takes a third of the room or less."""
    from PIL import Image

    with Image.open(io.BytesIO(content)) as picture:
        few = picture.convert("RGB").quantize(colours, dither=Image.Dither.NONE)
    buffer = io.BytesIO()
    few.save(buffer, "PNG", optimize=True)
    return buffer.getvalue()


def still_bytes(figure: Figure, suffix: str, title: str, description: str) -> bytes:
    """The figure as a file of a suffix: .png, .svg or .pdf.

    An SVG has a title and a description for those who do not see it; a PDF has vectors, with
    its letters in it, and no date.
    """
    import matplotlib

    if suffix == ".png":
        return png_bytes(figure)
    buffer = io.BytesIO()
    if suffix != ".svg":
        about = {"Title": title, "Subject": description, **_UNDATED}
        with matplotlib.rc_context(_PDF):
            figure.savefig(buffer, format="pdf", metadata=about)
        return buffer.getvalue()
    with matplotlib.rc_context(_SVG):
        figure.savefig(buffer, format="svg", metadata=_NOTHING)
    text = buffer.getvalue().decode("utf-8")
    text = _PATH.sub(lambda path: _DIGITS.sub(r"\1", path[0]), text)
    head, root, rest = text.partition("<svg ")
    attributes, end, content = rest.partition(">")
    told = f"\n <title>{escape(title)}</title>\n <desc>{escape(description)}</desc>"
    return f'{head}{root}role="img" {attributes}{end}{told}{content}'.encode()


def gif_bytes(drawings: list[np.ndarray], order: list[int], duration: int) -> bytes:
    """Drawings (height, width, 3) as frames that run without end, each shown so long [ms].

    `order` says which drawing each frame shows. One palette and no dithering: colours stay what
    and where they are from frame to frame.
    """
    from PIL import Image

    pixels = np.concatenate(drawings)
    # Arrows have few pixels, and count like large faces.
    packed = pixels.reshape(-1, 3).astype(np.uint32) @ (1 << 16, 1 << 8, 1)
    found, counts = np.unique(packed, return_counts=True)
    shown = np.repeat(found, np.minimum(counts, _ALIKE))
    colours = np.stack((shown >> 16, shown >> 8 & 255, shown & 255), axis=-1).astype(np.uint8)
    few = Image.fromarray(colours[None]).quantize(_COLOURS, Image.Quantize.MAXCOVERAGE)
    every = Image.fromarray(pixels).quantize(palette=few, dither=Image.Dither.NONE)
    index = np.asarray(every)
    palette = np.reshape(every.getpalette() or [], (-1, 3))
    # White, in the corner, stays white.
    palette[index[0, -1]] = 255
    made = []
    for each in np.split(index, len(drawings)):
        made.append(Image.fromarray(each))
        made[-1].putpalette(palette.ravel().tolist())
    buffer = io.BytesIO()
    made[order[0]].save(
        buffer,
        format="GIF",
        save_all=True,
        append_images=[made[k] for k in order[1:]],
        duration=duration,
        loop=0,
        optimize=False,
        disposal=1,
    )
    return buffer.getvalue()


#: Of each suffix the encoders that browsers can play, the best first, and what they are told.
_H264 = ("-preset", "slow", "-crf", "16", "-tune", "animation", "-movflags", "+faststart")
_ENCODERS: dict[str, dict[str, tuple[str, ...]]] = {
    ".mp4": {"libx264": _H264, "libopenh264": ("-b:v", "4M", "-movflags", "+faststart")},
    ".webm": {"libvpx-vp9": ("-crf", "22", "-b:v", "0", "-deadline", "good", "-cpu-used", "2")},
}
#: Colours as screens have them, told to players; nothing that differs from run to run.
_SCREEN = ("-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709")
_SAME = ("-map_metadata", "-1", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-threads", "1")
_FILTER = "scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int"


def check_encoder(suffix: str) -> tuple[str, str]:
    """The program that makes such a video, and its encoder.

    Args:
        suffix: `.mp4` or `.webm`.

    Raises:
        PictureError: There is none.
    """
    programs = _programs()
    for program in programs:
        there = _encoders_of(program)
        for encoder in _ENCODERS[suffix]:
            if encoder in there:
                return program, encoder
    kind = suffix.removeprefix(".").upper()
    lacks = f"; the ffmpeg that is here has no encoder for {kind}" if programs else ""
    raise PictureError(
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
        PictureError: There is no encoder, or it fails.
    """
    program, encoder = check_encoder(suffix)
    height, width = drawings[0].shape[:2]
    beyond = ((0, height % 2), (0, width % 2), (0, 0))
    frames = [np.pad(each, beyond, mode="edge").tobytes() for each in drawings]
    with tempfile.TemporaryDirectory(prefix="flexact-") as folder:
        made = Path(folder) / f"video{suffix}"
        command = [
            *(program, "-hide_banner", "-loglevel", "error", "-y"),
            *(
                "-f",
                "rawvideo",
                "-pix_fmt",
                "rgb24",
                "-s",
                f"{width + width % 2}x{height + height % 2}",
            ),
            *("-framerate", f"1000/{duration}", "-i", "pipe:0"),
            *("-vf", f"{_FILTER},format=yuv420p", "-c:v", encoder, *_ENCODERS[suffix][encoder]),
            *(*_SCREEN, *_SAME, "-metadata", f"title={harmless(title)}", str(made)),
        ]
        try:
            _encode(command, (frames[k] for k in order), Path(folder) / "said")
            return made.read_bytes()
        except OSError as error:
            raise PictureError(f"ffmpeg made no video: {reason_of(error)}") from error


def _encode(command: list[str], frames: Iterable[bytes], said: Path) -> None:
    """Give the frames to ffmpeg one by one; what it says goes to a file.

    Raises:
        PictureError: It fails.
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
        raise PictureError(f"ffmpeg made no video: {harmless(why)}")


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
