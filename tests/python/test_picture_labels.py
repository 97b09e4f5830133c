# SPDX-License-Identifier: BSD-3-Clause
"""Words of pictures stand neither on the mechanism nor on each other."""

import itertools
import runpy
from pathlib import Path

import numpy as np
import pytest

import flexact

pytest.importorskip("matplotlib")
pytest.importorskip("PIL")

from matplotlib.backends.backend_agg import FigureCanvasAgg

from flexact.advice.constraint_quality import holds_of
from flexact.show.picture import draw

pytestmark = pytest.mark.dear(4)

GALLERY = sorted((Path(__file__).resolve().parents[2] / "docs" / "gallery").glob("*.py"))
#: Of a box of words so much may be a line that leads to them.
_LINE = 0.03


@pytest.mark.parametrize("script", GALLERY, ids=lambda path: path.stem)
def test_words_are_on_white(script: Path) -> None:
    analysis = flexact.analyse(runpy.run_path(str(script))["model"])
    shown = [{"view": "iso"}, {"view": "top"}]
    shown += [{"held": True}] if holds_of(analysis) else []
    for chosen in shown:
        figure = draw(analysis, **chosen)  # type: ignore[arg-type]
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
        renderer = canvas.get_renderer()
        boxes = [
            (text.get_text(), text.get_window_extent(renderer).extents)
            for text in figure.texts
            if text.get_text().strip()
        ]
        for text in figure.texts:
            text.set_visible(False)
        canvas.draw()
        pixels = np.asarray(canvas.buffer_rgba())[::-1, :, :3]
        for words, (left, low, right, high) in boxes:
            assert 0 <= left < right <= pixels.shape[1]
            part = pixels[round(low) + 1 : round(high) - 1, round(left) + 1 : round(right) - 1]
            assert (part.min(axis=2) < 250).mean() <= _LINE, (words, chosen)
        for (one, a), (other, b) in itertools.combinations(boxes, 2):
            # Boxes of lines of one text touch.
            width = min(a[2], b[2]) - max(a[0], b[0])
            height = min(a[3], b[3]) - max(a[1], b[1])
            assert width < 2 or height < 4, (one, other, chosen)


def test_a_panel_without_a_free_corner_is_drawn_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """The triad stands below the drawing then, which becomes smaller and is not doubled."""
    model = flexact.Model(name="wire")
    model.wire((0, 0, 0), (0.1, 0.02, 0.05))
    model.fix((0, 0, 0))
    analysis = flexact.analyse(model)
    usual = draw(analysis).axes[0]
    monkeypatch.setattr("flexact.show.picture.figure._place_for_triad", lambda *_: None)
    lifted = draw(analysis).axes[0]
    assert lifted.get_position().y0 > usual.get_position().y0
    kinds = [type(each).__name__ for each in lifted.get_children()]
    assert kinds.count("CanvasArtist") == 1
