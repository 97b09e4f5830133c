# SPDX-License-Identifier: BSD-3-Clause
"""What tests of notebooks share: outputs as notebooks hold them, and pages that show them."""

import base64
import gzip
import json
import re
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import Any

from reference_decks import ROOT

import flexact
from flexact.show.notebook import output as given

#: Ten mechanisms of the gallery.
GALLERY = [
    ROOT / "docs" / "gallery" / f"{name}.py"
    for name in (
        *("butterfly_hinge", "cross_hinge_three_sheets", "cross_hinge_two_sheets"),
        *("double_parallelogram", "folded_xy_theta_stage", "notch_four_bar", "parallel_guide"),
        *("straight_guide_five_folded_sheets", "straight_guide_six_folded_sheets"),
        "wire_hexapod",
    )
]
#: The viewer, and a result, within an output.
VIEWER = re.compile(r"<script>\(async.*?</script>", re.DOTALL)
ELEMENT = re.compile(r"<(flexact-[0-9a-f]{10})>.*?</\1>", re.DOTALL)


@cache
def gallery() -> tuple[flexact.Analysis, ...]:
    """The mechanisms of the gallery, analysed."""
    made = []
    for path in GALLERY:
        names: dict[str, Any] = {}
        exec(path.read_text("utf-8"), names)
        model = next(each for each in names.values() if isinstance(each, flexact.Model))
        made.append(flexact.analyse(model))
    return tuple(made)


@cache
def shown() -> tuple[str, ...]:
    """The mechanisms of the gallery as outputs, the first of them with the viewer."""
    given.begin()
    return tuple(each._repr_html_() for each in gallery())


def notebook(outputs: Iterable[str]) -> str:
    """A notebook with a cell an output, as Jupyter writes it."""
    cells = [
        {
            "cell_type": "code",
            "execution_count": k,
            "id": f"cell-{k}",
            "metadata": {},
            "outputs": [
                {
                    "data": {
                        "text/html": html.splitlines(keepends=True),
                        "text/plain": ["<Analysis>"],
                    },
                    "execution_count": k,
                    "metadata": {},
                    "output_type": "execute_result",
                }
            ],
            "source": ["flexact.analyse(model)"],
        }
        for k, html in enumerate(outputs, start=1)
    ]
    return json.dumps(
        {"cells": cells, "metadata": {}, "nbformat": 4, "nbformat_minor": 5}, indent=1
    )


#: As the page of a notebook has it: styles that would spoil what they reach.
HOSTILE = """
html { font-size: 10px } body { margin: 8px; font: 13px serif; line-height: 3; color: rgb(1, 2, 3) }
h1, h2, section, canvas, label, table { display: none } div { letter-spacing: 1px }
.page, .verdict, .stage, .drawing, main { border: 9px solid red !important; height: 5px !important }
button { color: red !important; transform: rotate(40deg) } * { text-transform: uppercase }
.cell { overflow: auto }
"""


def exported(outputs: Iterable[str], theme: str = "light", style: str = "") -> str:
    """A page as nbconvert exports it: the outputs one below the other, in its template's body."""
    cells = "\n".join(
        f'<div class="cell" id="cell-{k}"><p>Cell {k}</p>'
        f'<div class="jp-RenderedHTMLCommon jp-RenderedHTML">{html}</div></div>'
        for k, html in enumerate(outputs)
    )
    light = "true" if theme == "light" else "false"
    ground = "#fff" if theme == "light" else "#111"
    return (
        f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>x</title>'
        f'<link rel="icon" href="data:,"><style>body {{ background: {ground} }} {style}</style>'
        f'</head><body class="jp-Notebook" data-jp-theme-light="{light}">{cells}</body></html>'
    )


def unpacked(html: str) -> str:
    """The page within an output."""
    found = re.search(r'class="flexact-data">([^<]*)<', html)
    assert found
    return gzip.decompress(base64.b64decode(found[1])).decode()


def write(path: Path, text: str) -> Path:
    path.write_text(text, encoding="utf-8")
    return path
