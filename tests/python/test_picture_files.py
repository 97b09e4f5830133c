# SPDX-License-Identifier: BSD-3-Clause
"""Files of pictures: PNG, SVG and GIF, whatever a name contains, and the same each time."""

import importlib.util
import io
import re
import warnings
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from pictures import deck, of_text
from reference_decks import NAMES
from small_decks import COLLINEAR, TRIANGLE

import flexact

pytest.importorskip("matplotlib")
pytest.importorskip("PIL")

from matplotlib.backends.backend_agg import FigureCanvasAgg
from PIL import Image

from flexact.show.picture import PictureError, picture_bytes
from flexact.show.writers import PICTURES

pytestmark = pytest.mark.dear(10)

PAPER = [name for name in NAMES if name.startswith("paper/")]
SVG = "{http://www.w3.org/2000/svg}"
#: As small as it gets, where the content does not matter.
SMALL = (200, 150)


def frames_of(content: bytes) -> list[np.ndarray]:
    with Image.open(io.BytesIO(content)) as image:
        assert image.format == "GIF"
        made = []
        for k in range(image.n_frames):
            image.seek(k)
            made.append(np.asarray(image.convert("RGB")).astype(int))
        return made


@pytest.mark.parametrize("name", PAPER)
def test_each_deck_of_the_paper_makes_its_pictures(name: str) -> None:
    analysis = deck(name)
    with Image.open(io.BytesIO(picture_bytes(analysis, ".png"))) as image:
        assert image.format == "PNG"
        assert np.asarray(image.convert("L")).std() > 10
    root = ElementTree.fromstring(picture_bytes(analysis, ".svg"))
    assert len(root.findall(f".//{SVG}path")) > 100
    frames = frames_of(picture_bytes(analysis, ".gif", size=SMALL))
    assert len(frames) == 36
    assert np.any(frames[0] != frames[9])


@pytest.mark.grid
@pytest.mark.parametrize("name", [name for name in NAMES if name not in PAPER])
def test_every_other_deck_makes_a_small_picture(name: str) -> None:
    content = picture_bytes(deck(name), ".PNG", size=SMALL, plain=True)
    with Image.open(io.BytesIO(content)) as image:
        assert image.size == SMALL
        assert np.asarray(image.convert("L")).std() > 5


# Animations


def test_a_motion_runs_through_a_full_cycle_without_a_seam() -> None:
    """sin(2 pi k / n), from rest: the frames on a way back are those on the way there."""
    content = picture_bytes(deck("paper/twelve_trusses"), ".gif", size=(360, 304))
    frames = frames_of(content)
    count = len(frames)
    assert count == 36
    for k in range(1, count // 4):
        np.testing.assert_array_equal(frames[k], frames[count // 2 - k])
        np.testing.assert_array_equal(frames[count // 2 + k], frames[count - k])
    # At rest there are no arrows.
    red, green, blue = np.moveaxis(np.stack(frames).astype(int), -1, 0)
    orange = ((red - green > 60) & (green - blue > 15)).sum(axis=(1, 2))
    assert orange[0] == orange[count // 2] == 0 < orange[count // 4]
    steps = [int(np.abs(frames[k] - frames[k - 1]).sum()) for k in range(count)]
    # As many pixels change at the wrap as anywhere near an end of the swing; none stands still.
    assert min(steps) > 0
    assert steps[count // 4] == steps[count // 4 + 1] < max(steps)
    ends = frames[count // 4], frames[3 * count // 4]
    assert int(np.abs(ends[0] - ends[1]).sum()) > max(steps)
    with Image.open(io.BytesIO(content)) as image:
        assert image.info["loop"] == 0
        assert 20 <= image.info["duration"] <= 100


def test_only_what_moves_changes(tmp_path: Path) -> None:
    """Ground and words stay where they are, in the same colours, on white."""
    frames = np.stack(frames_of(picture_bytes(of_text(tmp_path, COLLINEAR), ".gif")))
    still = np.all(frames == frames[0], axis=(0, -1))
    height = len(still)
    assert still[: height // 4].all()
    assert still[-height // 6 :].all()
    assert not still.all()
    left = frames[0][:, : frames[0].shape[1] // 12]
    assert np.any(left < 100)
    assert still[:, : frames[0].shape[1] // 12].all()
    assert frames[0][0, -1].tolist() == [255, 255, 255]


def test_what_does_not_move_is_turned(tmp_path: Path) -> None:
    frames = frames_of(
        picture_bytes(deck("frameworks/octahedral_platform_yaw_0"), ".gif", size=SMALL)
    )
    assert len(frames) == 48
    assert np.any(frames[0] != frames[24])
    # No jump at the wrap.
    steps = [int(np.abs(frames[k] - frames[k - 1]).sum()) for k in range(48)]
    assert steps[0] < 2 * np.median(steps)


def test_a_planar_drawing_that_does_not_move_is_one_frame(tmp_path: Path) -> None:
    assert len(frames_of(picture_bytes(of_text(tmp_path, TRIANGLE), ".gif"))) == 1


def test_progress_is_told(tmp_path: Path) -> None:
    told: list[float] = []
    picture_bytes(of_text(tmp_path, COLLINEAR), ".gif", size=SMALL, progress=told.append)
    assert told == sorted(told)
    assert told[-1] == 1.0
    assert len(told) >= 12


# SVG


def svg_of(analysis: flexact.Analysis) -> ElementTree.Element:
    return ElementTree.fromstring(picture_bytes(analysis, ".svg"))


def test_svg_is_vectors_and_text() -> None:
    root = svg_of(deck("paper/twelve_trusses"))
    assert root.findall(f".//{SVG}image") == []
    data = " ".join(path.get("d", "") for path in root.iter(f"{SVG}path"))
    assert re.search(r"\.\d\d", data)
    assert not re.search(r"\.\d{3}", data)
    told = [element.text for element in root.iter(f"{SVG}text")]
    assert "twelve_trusses.dat" in told
    assert any("Under-constrained by 1 and over-constrained by 1" in (t or "") for t in told)
    assert "Self-stress 1 of 1" in told
    assert root.findtext(f"{SVG}title") == "twelve_trusses.dat"
    assert "one motion is held by nothing" in (root.findtext(f"{SVG}desc") or "")


@pytest.mark.parametrize(
    "name",
    [
        "<script>alert(1)<!--",
        "]]>&amp;<svg onload='x'>\"",
        "$x_1$ and \\frac$",
        "a\x1b[31m\x00\ufffe\udcff",
        "\u673a\u6784 \u0645\u0631\u062d\u0628\u0627",
    ],
)
def test_names_are_text_whatever_they_contain(name: str) -> None:
    analysis = flexact.analyse(deck_model(), name=name)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        content = picture_bytes(analysis, ".svg")
        picture_bytes(analysis, ".png", size=SMALL)
    root = ElementTree.fromstring(content)
    tags = {element.tag.rpartition("}")[2] for element in root.iter()}
    assert "script" not in tags
    assert not any("onload" in element.attrib for element in root.iter())
    from flexact.util.text import harmless

    told = [element.text for element in root.iter(f"{SVG}text")]
    assert harmless(name) in told
    assert root.findtext(f"{SVG}title") == harmless(name)


@pytest.mark.parametrize("letter", ["a", "W", "\u0416"])
def test_a_long_name_ends_within_the_picture(letter: str) -> None:
    from flexact.show.picture import draw

    figure = draw(flexact.analyse(deck_model(), name=250 * letter))
    FigureCanvasAgg(figure).draw()
    name = figure.texts[0]
    assert re.fullmatch(f"{letter}+\\.\\.\\.", name.get_text())
    box, width = name.get_window_extent(), figure.bbox.width
    # As much as fits: one letter more would not.
    assert 0.93 * width < box.x1 < width


def deck_model() -> flexact.Model:
    return deck("frameworks/collinear_bars_plane").model


# The same each time


@pytest.mark.parametrize("suffix", PICTURES)
def test_files_are_the_same_each_time(suffix: str, tmp_path: Path) -> None:
    analysis = of_text(tmp_path, COLLINEAR)
    first = picture_bytes(analysis, suffix, size=SMALL)
    again = picture_bytes(flexact.analyse(tmp_path / "deck.dat"), suffix, size=SMALL)
    assert first == again
    assert not re.search(rb"20\d\d-\d\d-\d\d|[Mm]atplotlib v|Software", first)
    assert str(tmp_path).encode() not in first


def test_drawing_leaves_settings_as_they_were(tmp_path: Path) -> None:
    import matplotlib

    before = dict(matplotlib.rcParams)
    picture_bytes(of_text(tmp_path, COLLINEAR), ".svg", size=SMALL)
    assert dict(matplotlib.rcParams) == before


@pytest.mark.parametrize(("package", "told"), [("matplotlib", "matplotlib"), ("PIL", "pillow")])
def test_a_missing_package_is_told(
    package: str, told: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    analysis = of_text(tmp_path, COLLINEAR)
    find = importlib.util.find_spec
    monkeypatch.setattr(
        "flexact.show.picture.make.find_spec", lambda name: None if name == package else find(name)
    )
    with pytest.raises(PictureError, match=rf"package {told}: pip install .*{told}"):
        picture_bytes(analysis, ".png")


# Large models


def test_a_large_model_is_drawn_simply(tmp_path: Path) -> None:
    """A grid of bars in space: lines and a remark in place of solids."""
    side = range(12)
    number = {(i, j, k): 1 + i + 12 * j + 144 * k for i in side for j in side for k in side}
    lines = []
    for (i, j, k), node in number.items():
        for step in ((1, 0, 0), (0, 1, 0), (0, 0, 1)):
            other = number.get((i + step[0], j + step[1], k + step[2]))
            if other is not None:
                lines.append(f"TRUSS {len(lines) + 1} {node} {other}")
    count = len(lines)
    lines += [f"X {node} {i} {j} {k}" for (i, j, k), node in number.items()]
    lines += [f"FIX {node}" for (_, _, k), node in number.items() if k == 0]
    analysis = of_text(tmp_path, "\n".join(lines) + "\n")
    root = svg_of(analysis)
    words = " ".join(element.text or "" for element in root.iter(f"{SVG}text"))
    assert f"{count} members, drawn simply." in " ".join(words.split())
    # A line each, not the facets of a rod, in either panel.
    assert count < len(root.findall(f".//{SVG}path")) < 4 * count
