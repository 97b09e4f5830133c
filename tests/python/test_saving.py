# SPDX-License-Identifier: BSD-3-Clause
"""A result saved from Python: the suffix says what the file is."""

from pathlib import Path

import meshio
import numpy as np
import pytest
from PIL import Image
from reference_decks import text_of

import flexact


@pytest.fixture(scope="module")
def trusses() -> flexact.Analysis:
    return flexact.analyse(flexact.read_text(text_of("paper/twelve_trusses"), "trusses.dat"))


def test_pictures_are_saved(trusses: flexact.Analysis, tmp_path: Path) -> None:
    trusses.save(tmp_path / "a.png", motion=1, view="top")
    trusses.save(str(tmp_path / "b.SVG"), stress=1)
    assert Image.open(tmp_path / "a.png").width > 300
    assert b"normal force, tension positive" in (tmp_path / "b.SVG").read_bytes()


def test_pages_are_saved(trusses: flexact.Analysis, tmp_path: Path) -> None:
    trusses.save(tmp_path / "a.html")
    text = (tmp_path / "a.html").read_text(encoding="utf-8")
    assert text.startswith("<!DOCTYPE html>")
    assert "data:image/png" in text


def test_meshes_are_saved(trusses: flexact.Analysis, tmp_path: Path) -> None:
    trusses.save(tmp_path / "a.vtk", motion=1)
    mesh = meshio.read(tmp_path / "a.vtk")
    node = mesh.point_data["node"]
    place = trusses.model.node_index(5)
    found = mesh.point_data["motion_1"][np.flatnonzero(node == 5)]
    expected = trusses.motions[0].displacement[place]
    np.testing.assert_allclose(found, np.tile(expected, (len(found), 1)), atol=1e-15)
    assert len(found) >= 4
    trusses.save(tmp_path / "b.pvd")
    assert (tmp_path / "b_files" / "step_00.vtu").exists()


@pytest.mark.parametrize(
    ("name", "choice", "words"),
    [
        ("a.html", {"motion": 1}, "a.html shows no motion of its own choice"),
        ("a.vtu", {"stress": 1, "view": "top"}, "a.vtu shows no stress or view of its own choice"),
        ("a.png", {"motion": 0}, "there is no motion 0: the analysis gives 1 motion"),
        ("a.svg", {"stress": 0}, "there is no self-stress 0: the analysis gives 1 self-stress"),
        ("a.png", {"motion": 2}, "there is no motion 2: the analysis gives 1 motion"),
        ("a.vtu", {"motion": 1, "freedom": 1}, "a motion or a degree of freedom, not both"),
        ("a.png", {"motion": "1"}, "motion is a number from 1, not str"),
        ("a.pvd", {"motion": 1.0}, "motion is a number from 1, not float"),
        ("a.svg", {"view": (1, 2)}, "view is given by its name, not by tuple"),
        ("a\0.png", {}, "a file's name cannot hold a NUL"),
        ("a.docx", {}, "mesh format 'docx' is not known"),
        ("nowhere/../x", {}, "the suffix of nowhere/../x is to say what to write"),
    ],
)
def test_what_cannot_be_saved_is_said(
    trusses: flexact.Analysis,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    name: str,
    choice: dict[str, object],
    words: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(flexact.FlexactError, match=words):
        trusses.save(name, **choice)
    assert not list(tmp_path.iterdir())


def test_nothing_is_left_where_a_file_cannot_be(trusses: flexact.Analysis, tmp_path: Path) -> None:
    (tmp_path / "a.png").mkdir()
    with pytest.raises(flexact.FlexactError, match="it is a folder"):
        trusses.save(tmp_path / "a.png")
    assert [path.name for path in tmp_path.iterdir()] == ["a.png"]


@pytest.mark.posix
def test_a_deck_is_never_written_over(tmp_path: Path) -> None:
    deck = tmp_path / "deck.png"
    deck.write_text(text_of("paper/twelve_trusses"))
    (tmp_path / "link.png").symlink_to(deck)
    analysis = flexact.analyse(deck)
    for name in ("deck.png", "link.png"):
        with pytest.raises(flexact.FlexactError, match="would overwrite the deck"):
            analysis.save(tmp_path / name)
    assert deck.read_text() == text_of("paper/twelve_trusses")
