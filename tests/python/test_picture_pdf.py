# SPDX-License-Identifier: BSD-3-Clause
"""Pictures as PDF: vectors, letters within the file, no date, and the same each time."""

import os
import re
import subprocess
import sys
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pictures import deck, of_text
from reference_decks import ROOT
from small_decks import COLLINEAR

import flexact
from flexact.apps.cli.main import main
from flexact.util.text import harmless

pytest.importorskip("matplotlib")
pytest.importorskip("PIL")

from flexact.show.picture import picture_bytes

pytestmark = pytest.mark.dear(3)

INPUT = ROOT / "input_decks"


def streams_of(content: bytes) -> bytes:
    """All that is compressed in a PDF."""
    found = re.findall(rb"stream\r?\n(.*?)\r?\nendstream", content, re.DOTALL)
    made = []
    for each in found:
        try:
            made.append(zlib.decompress(each))
        except zlib.error:
            made.append(each)
    return b"\n".join(made)


def test_a_pdf_is_vectors_with_its_letters_and_a_title_and_no_date() -> None:
    content = picture_bytes(deck("paper/twelve_trusses"), ".pdf")
    assert content.startswith(b"%PDF-1.") and content.rstrip().endswith(b"%%EOF")
    assert b"/Title (twelve_trusses.dat)" in content
    # Letters are in the file as a TrueType font, and nothing is a bitmap.
    assert b"/FontFile2" in content and b"/Subtype /Image" not in content
    for word in (b"/CreationDate", b"/ModDate", b"/Producer", b"/Creator"):
        assert word not in content
    # Curves and fills of PDF: lines of a path, closed and filled.
    assert len(re.findall(rb"\bl\n", streams_of(content))) > 1000


def test_a_pdf_shows_what_the_png_shows() -> None:
    pdfium: Any = pytest.importorskip("pypdfium2")
    image_of = pytest.importorskip("PIL.Image")
    import io

    analysis = deck("paper/twelve_trusses")
    document = pdfium.PdfDocument(picture_bytes(analysis, ".pdf"))
    assert len(document) == 1
    page = document[0]
    text = page.get_textpage().get_text_range()
    assert "twelve_trusses.dat" in text and "Motion 1 of 1" in text
    png = image_of.open(io.BytesIO(picture_bytes(analysis, ".png"))).convert("RGB")
    drawn = page.render(scale=100 / 72).to_pil().convert("RGB").resize(png.size)
    one, other = (np.asarray(each, dtype=float) for each in (drawn, png))
    assert np.abs(one - other).mean() < 6.0 < np.abs(255.0 - other).mean()


def test_the_same_result_gives_the_same_bytes_in_every_process(tmp_path: Path) -> None:
    made = []
    for seed in ("1", "2"):
        target = tmp_path / f"{seed}.pdf"
        code = (
            "import flexact, sys; "
            f"flexact.analyse({str(INPUT / 'paper' / 'twelve_trusses.dat')!r}, name='x')"
            f".save({str(target)!r})"
        )
        environment = {**os.environ, "PYTHONHASHSEED": seed}
        subprocess.run([sys.executable, "-c", code], env=environment, check=True)
        made.append(target.read_bytes())
    assert made[0] == made[1]


@pytest.mark.parametrize(
    "name", ["a (b) \\ c", "\u00e9 \u2192 \U0001f600", "\ud800\x00\x1b[31m", "$x_1$"]
)
def test_any_name_makes_a_title(name: str, tmp_path: Path) -> None:
    analysis = flexact.analyse(of_text(tmp_path, COLLINEAR).model, name=name)
    content = picture_bytes(analysis, ".pdf", size=(200, 150))
    assert b"/Title" in content
    pdfium: Any = pytest.importorskip("pypdfium2")
    assert pdfium.PdfDocument(content).get_metadata_dict()["Title"] == harmless(name)


def test_every_picture_of_the_command_can_be_a_pdf(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    hinge = str(INPUT / "flexures" / "cross_hinge_undeclared.dat")
    for verb, more in (
        ("picture", ()),
        ("advise", ("--body", "body")),
        ("trace", ("--motion", "1")),
    ):
        target = tmp_path / f"{verb}.pdf"
        assert main([verb, hinge, *more, "-o", str(target)]) == 0
        assert target.read_bytes().startswith(b"%PDF")
    # A changed deck is no picture.
    for suffix in (".pdf", ".gif", ".mp4"):
        target = tmp_path / f"deck{suffix}"
        assert main(["advise", hinge, "--apply", "1", "-o", str(target)]) != 0
        assert "picture" in capsys.readouterr().err and not target.exists()
