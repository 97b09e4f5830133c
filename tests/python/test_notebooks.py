# SPDX-License-Identifier: BSD-3-Clause
"""The notebooks of the gallery: their pages are what was run, and their numbers are known.

The five-wire guide is singular where the lines of its wires and the z-axis depend on each other as
screws: where the determinant of their Pluecker coordinates is zero (Merlet, Parallel Robots, 2006,
section 6.2). Nothing here but the crossings comes from Flexact.
"""

import base64
import json
import re
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import flexact

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import notebooks  # noqa: E402

STORED = ROOT / "docs" / "gallery" / "five_wires_over_two_angles.ipynb"


def determinant(alpha: float, beta: float) -> float:
    """Of the Pluecker coordinates of five wires and of the z-axis."""
    a, b = np.radians((alpha, beta))
    lines = [
        ((0.04, -0.03, 0.02), (1, 0, 0)),
        ((0.04, 0.03, 0.02), (np.cos(a), np.sin(a), 0)),
        ((0, 0.04, 0.02), (np.sin(b), np.cos(b), 0)),
        ((0.04, 0, -0.02), (1, 0, 0)),
        ((0, 0.04, -0.02), (0, 1, 0)),
        ((0, 0, 0), (0, 0, 1)),
    ]
    # Moments in units of 0.04 m, about the size of the guide.
    screws = [np.concatenate((u, np.cross(np.array(p) / 0.04, u))) for p, u in lines]
    return float(np.linalg.det(screws))


def guide() -> Any:
    """The function of the notebook that makes the model."""
    names: dict[str, Any] = {}
    first = next(cell for cell in notebooks.cells_of(STORED) if cell["cell_type"] == "code")
    exec(notebooks.source_of(first), names)
    return names["guide"]


def test_singular_lines_are_where_six_lines_depend_on_each_other() -> None:
    angles = np.linspace(-75, 78, 10)
    table = flexact.sweep(guide(), flexact.grid(alpha=angles, beta=angles), workers=1)
    assert set(table.verdict) == {"exactly constrained"}
    found = table.crossings(workers=1)
    signs = np.sign([[determinant(alpha, beta) for beta in angles] for alpha in angles])
    assert len(found) == sum((np.diff(signs, axis=axis) != 0).sum() for axis in (0, 1)) > 10
    for each in found:
        alpha, beta = each.parameters["alpha"], each.parameters["beta"]
        assert isinstance(alpha, float) and isinstance(beta, float)
        assert abs(determinant(alpha, beta)) < 1e-12
        # The determinant by hand, as the page has it.
        assert 4 * np.tan(np.radians(alpha)) * (1 + 1.75 * np.tan(np.radians(beta))) == (
            pytest.approx(6, rel=1e-11)
        )


def test_the_stored_map_has_every_singular_place() -> None:
    text = STORED.with_suffix(".md").read_text("utf-8")
    (count,) = re.findall(r"^    (\d+) singular variants, all of them", text, re.MULTILINE)
    angles = np.linspace(-80, 80, 37)
    signs = np.sign([[determinant(alpha, beta) for beta in angles] for alpha in angles])
    assert int(count) == sum((np.diff(signs, axis=axis) != 0).sum() for axis in (0, 1))
    assert f"Exactly constrained: {angles.size**2} (100 %)." in text


@pytest.mark.parametrize("path", notebooks.notebooks(), ids=lambda path: path.stem)
def test_the_page_is_that_of_the_notebook(path: Path) -> None:
    stored = json.loads(path.read_text("utf-8"))
    page, pictures = notebooks.page_of(stored, path.stem)
    assert path.with_suffix(".md").read_text("utf-8") == page
    assert pictures
    for name, data in pictures.items():
        assert (path.parent / name).read_bytes() == data
        assert data.startswith(b"\x89PNG")
    assert stored["nbformat"] == 4
    counts = [c["execution_count"] for c in stored["cells"] if c["cell_type"] == "code"]
    assert counts == list(range(1, len(counts) + 1))
    assert f"]({path.stem}.md)" in (path.parent / "README.md").read_text("utf-8")


def test_cells_show_what_they_print_and_their_last_value() -> None:
    names: dict[str, Any] = {}
    assert notebooks.run("x = 2\nprint(x)", names)[0]["text"] == ["2\n"]
    assert notebooks.run("x + 1", names)[0]["data"] == {"text/plain": ["3"]}
    assert notebooks.run("None", names) == []

    class Picture:
        def _repr_png_(self) -> bytes:
            return b"bytes"

    (shown,) = notebooks.run("picture", {"picture": Picture()})
    assert base64.b64decode(shown["data"]["image/png"]) == b"bytes"
