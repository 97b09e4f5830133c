# SPDX-License-Identifier: BSD-3-Clause
"""Videos, MP4 and WebM: browsers play them, and their frames are those of the GIF."""

import base64
import io
import os
import stat
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from browser import Browser
from pictures import deck, of_text
from reference_decks import ROOT
from small_decks import COLLINEAR, files_in

import flexact
from flexact.apps.cli.main import main
from flexact.show.picture import PictureError, picture_bytes
from flexact.show.picture import files as module

pytest.importorskip("matplotlib")
pytest.importorskip("PIL")

from PIL import Image

pytestmark = pytest.mark.dear(2)

INPUT = ROOT / "input_decks"
SIZE = (301, 253)


def require_encoder(suffix: str) -> None:
    try:
        module.check_encoder(suffix)
    except PictureError as error:
        pytest.skip(str(error))


def gif_frames(content: bytes) -> list[np.ndarray]:
    with Image.open(io.BytesIO(content)) as image:
        made = []
        for k in range(image.n_frames):  # type: ignore[attr-defined]
            image.seek(k)
            made.append(np.asarray(image.convert("RGB")).astype(int))
        return made


def played(browser: Browser, content: bytes, kind: str, folder: Path) -> dict[str, float]:
    source = f"data:{kind};base64,{base64.b64encode(content).decode()}"
    page = folder / "video.html"
    page.write_text(
        "<!DOCTYPE html><body style='margin:0;background:#fff'><video muted playsinline loop "
        f"style='display:block' src='{source}'></video></body>"
    )
    browser.open(page)
    found = browser.later(
        """
        const done = arguments[0], video = document.querySelector("video");
        const told = () => ({ width: video.videoWidth, height: video.videoHeight,
          duration: video.duration, error: video.error ? video.error.code : 0, time: 0 });
        video.addEventListener("error", () => done(told()));
        video.play().then(() => {
          video.addEventListener("timeupdate", function step() {
            if (video.currentTime < 0.2) return;
            video.removeEventListener("timeupdate", step);
            video.pause();
            done({ ...told(), time: video.currentTime });
          });
        }, () => done(told()));
        """
    )
    assert isinstance(found, dict)
    return found


def frame_at(browser: Browser, frame: int) -> np.ndarray:
    browser.later(
        """
        const [frame, done] = arguments, video = document.querySelector("video");
        video.addEventListener("seeked", () => requestAnimationFrame(() => done()), { once: true });
        video.currentTime = (frame + 0.5) * 0.05;
        """,
        frame,
    )
    browser.drawn()
    return browser.pixels("video").astype(int)


@pytest.mark.parametrize(("suffix", "kind"), [(".mp4", "video/mp4"), (".webm", "video/webm")])
def test_a_browser_plays_what_the_gif_shows(
    suffix: str,
    kind: str,
    browser: Browser,
    tmp_path: Path,
) -> None:
    require_encoder(suffix)
    analysis = deck("paper/twelve_trusses")
    shown = picture_bytes(analysis, suffix, size=SIZE)
    frames = gif_frames(picture_bytes(analysis, ".gif", size=SIZE))
    found = played(browser, shown, kind, tmp_path)
    assert found["error"] == 0 and found["time"] >= 0.2
    # Sizes are even, and the time is that of the GIF.
    assert (found["width"], found["height"]) == (302, 254)
    assert found["duration"] == pytest.approx(0.05 * len(frames), abs=0.051)
    for frame in (0, 9, 20, 27, len(frames) - 1):
        there = frame_at(browser, frame)[: SIZE[1], : SIZE[0]]
        apart = [np.abs(there - each).mean() for each in frames]
        same = frames[frame]
        # Colours are halved in their resolution, and a GIF has few.
        assert np.abs(there - same).mean() < 3.0
        assert np.abs(there - same).mean() <= min(apart) + 1e-9
        # Large areas keep their colours: the ground is white.
        assert np.abs(there[-4:, -4:] - 255).max() <= 2


def test_a_video_is_in_the_format_that_players_want_and_the_same_each_time() -> None:
    require_encoder(".mp4")
    analysis = deck("paper/twelve_trusses")
    content = picture_bytes(analysis, ".mp4", size=(160, 120))
    assert content == picture_bytes(analysis, ".mp4", size=(160, 120))
    assert content[4:8] == b"ftyp"
    # The index stands before the pictures, so that playing begins at once.
    assert content.index(b"moov") < content.index(b"mdat")
    program, _ = module.check_encoder(".mp4")
    told = subprocess.run(
        [program, "-hide_banner", "-i", "pipe:0"], input=content, capture_output=True
    ).stderr.decode()
    assert "h264" in told and "yuv420p" in told and "160x120" in told and "20 fps" in told
    assert "bt709" in told and "twelve_trusses.dat" in told


def test_a_drawing_without_a_motion_turns(tmp_path: Path) -> None:
    require_encoder(".webm")
    told: list[float] = []
    analysis = deck("frameworks/octahedral_platform_yaw_0")
    content = picture_bytes(analysis, ".webm", size=(120, 90), progress=told.append)
    assert content[:4] == b"\x1aE\xdf\xa3"
    assert len(told) == 49 and told == sorted(told) and told[-1] == 1.0


def test_a_shape_moves_in_a_video() -> None:
    require_encoder(".mp4")
    state = flexact.elastic(INPUT / "paper" / "six_folded_sheets.dat").undeformed()
    assert flexact.shape(state).picture(".mp4", size=(160, 120))[4:8] == b"ftyp"


@pytest.mark.posix
def test_the_command_writes_a_video_whole_or_not_at_all(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    require_encoder(".mp4")
    path = tmp_path / "deck.dat"
    path.write_text(COLLINEAR)
    target = tmp_path / "out" / "x.mp4"
    assert main(["picture", str(path), "-o", str(target)]) == 0
    assert files_in(target.parent) == ["x.mp4"]
    before = target.read_bytes()
    # An encoder that fails in the middle.
    broken = tmp_path / "ffmpeg"
    broken.write_text("#!/bin/sh\nhead -c 1000 >/dev/null\necho 'No room for frames' >&2\nexit 3\n")
    broken.chmod(broken.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setattr(module, "check_encoder", lambda suffix: (str(broken), "libx264"))
    capsys.readouterr()
    assert main(["picture", str(path), "-o", str(target)]) != 0
    err = capsys.readouterr().err
    assert "ffmpeg made no video: No room for frames" in err and "Traceback" not in err
    assert target.read_bytes() == before and files_in(target.parent) == ["x.mp4"]


def test_without_an_encoder_both_ways_are_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "_programs", list)
    # Before the deck is looked at.
    missing = tmp_path / "missing.dat"
    for suffix in (".mp4", ".webm"):
        assert main(["picture", str(missing), "-o", str(tmp_path / f"x{suffix}")]) != 0
        err = capsys.readouterr().err
        assert "ffmpeg" in err and "PATH" in err and "pip install imageio-ffmpeg" in err
    with pytest.raises(PictureError, match="imageio-ffmpeg"):
        picture_bytes(of_text(tmp_path, COLLINEAR), ".mp4")


def test_the_package_serves_where_no_ffmpeg_is_on_the_path(tmp_path: Path) -> None:
    pytest.importorskip("imageio_ffmpeg")
    target = tmp_path / "x.mp4"
    code = f"import flexact; flexact.analyse({str(INPUT / 'paper' / 'twelve_trusses.dat')!r})"
    subprocess.run(
        [sys.executable, "-c", f"{code}.save({str(target)!r}, view='top')"],
        env={**os.environ, "PATH": str(tmp_path)},
        check=True,
    )
    assert target.read_bytes()[4:8] == b"ftyp"
