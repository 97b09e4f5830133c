# SPDX-License-Identifier: BSD-3-Clause
"""The viewer as one script for all results of a notebook, and the name of their element."""

from __future__ import annotations

import base64
import contextlib
import gzip
import hashlib
import json
import re
import sys
from collections.abc import Iterable, Sequence
from functools import cache
from html import escape
from importlib import resources
from typing import Any

from ...advice.describe import MOST_MODES, describe, verdict_in_words
from ...analysis.result import Result
from ...analysis.verdict_words import margin_in_short
from ...util.partial import attempted
from ..page.assets import SCRIPTS, asset, image, text
from ..page.content import content_of
from ..picture import still_of
from ..picture.files import fewer_colours
from ..writers import as_bytes

#: What starts a page from disk is left out.
_START = "start.js"
_REM = re.compile(r"(?<![\w.])(\d*\.?\d+)rem\b")
_VW = re.compile(r"(?<![\w.])(\d*\.?\d+)vw\b")
_WIDTHS = re.compile(r"@media \((m(?:in|ax)-width: [^)]*)\)")


@cache
def tag() -> str:
    """The name of the element of this version: results of others keep theirs."""
    return f"flexact-{hashlib.sha256((_scripts() + style()).encode()).hexdigest()[:10]}"


@cache
def script() -> str:
    """What defines the element, as an element of HTML; it may stand anywhere, and repeatedly."""
    setting = json.dumps({"tag": tag(), "style": style()}).replace("</", "<\\/")
    # A script that comes a second time defines nothing.
    whole = (
        f'(() => {{ if (customElements.get("{tag()}")) return;\n'
        f"const SETTING = {setting};\n{_scripts()}\n}})();"
    )
    start = (
        "(async (text) => {"
        f'if (customElements.get("{tag()}")) return;'
        "const bytes = Uint8Array.from(atob(text), (each) => each.charCodeAt(0));"
        "const made = document.createElement('script');"
        "const stream = new Blob([bytes]).stream();"
        "const open = stream.pipeThrough(new DecompressionStream('gzip'));"
        "made.textContent = await new Response(open).text();"
        "document.head.append(made);"
        "made.remove();"
        f'}})("{packed(whole)}");'
    )
    return f"<script>{start}</script>"


def packed(text: str) -> str:
    """Text compressed, in letters; the same each time."""
    content = as_bytes(text)
    return base64.b64encode(gzip.compress(content, 9, mtime=0)).decode()


@cache
def style() -> str:
    """The styles of the page for a tree of its own, as wide as a notebook makes it.

    Widths are those of the output, not of the window; sizes do not follow the letters that
    a notebook has; light and dark stand on the host.
    """
    made = asset("style.css")
    made = made.replace(':root[data-theme="dark"]', ':host([data-theme="dark"])')
    made = made.replace(':root:not([data-theme="light"])', ":host(:not([data-theme]))")
    made = re.sub(r":root\b", ":host", made)
    made = re.sub(r"(?m)^(\s*)body \{", r"\1.page {", made)
    made += resources.files(__package__).joinpath("notebook.css").read_text("utf-8")
    made = _WIDTHS.sub(r"@container (\1)", made)
    made = _VW.sub(r"\1cqw", made)
    return _REM.sub(lambda found: f"{16 * float(found[1]):g}px", made)


@cache
def _scripts() -> str:
    parts = [asset(name) for name in SCRIPTS if name != _START]
    own = resources.files(__package__).joinpath("element.js").read_text("utf-8")
    return "\n".join((*parts, own))


#: Of each that asks (a notebook, a console) the cell whose output brought the viewer.
_given: dict[str, str | None] = {}
#: Shells that tell which cells run.
_told: list[Any] = []


def is_wanted() -> bool:
    """Whether this output is to bring the viewer; whoever asks is thought to show it."""
    if "google.colab" in sys.modules:
        # Each output has a page of its own there.
        return True
    shell = _shell()
    # Who asked for what runs, and the cell, as far as they are known.
    parent = _parent(shell)
    who = str(parent.get("header", {}).get("session", ""))
    cell = parent.get("metadata", {}).get("cellId")
    if who in _given:
        return False
    if shell is not None and shell not in _told:
        shell.events.register("pre_run_cell", _forget)
        _told.append(shell)
    _given[who] = cell
    return True


def begin() -> None:
    """Have the next output bring the viewer."""
    _given.clear()


def _forget(info: Any) -> None:
    """A cell runs, so that its output goes; or the notebook says which cells are deleted."""
    deleted = _parent(_shell()).get("metadata", {}).get("deletedCells", ())
    gone = {getattr(info, "cell_id", None), *deleted} - {None}
    for who, cell in list(_given.items()):
        if cell in gone:
            del _given[who]


def _shell() -> Any:
    """The kernel of a notebook, if there is one."""
    module = sys.modules.get("IPython")
    shell = None if module is None else module.get_ipython()
    return shell if hasattr(shell, "get_parent") else None


def _parent(shell: Any) -> dict[str, Any]:
    """The message that asked; of an unknown kernel nothing."""
    with contextlib.suppress(Exception):
        return dict(shell.get_parent())
    return {}


#: Width and height [px] of the still of a result, and of a picture in a table, at twice the
#: size at which it is shown.
WHOLE, SMALL = (960, 600), (400, 300)
#: Colours of the two.
_COLOURS = {WHOLE: 96, SMALL: 48}


def still(analysis: Result, size: tuple[int, int], words: str, **chosen: Any) -> str:
    """A picture of a result, of a motion or a self-stress of it; or nothing.

    Args:
        analysis: The result.
        size: `WHOLE` or `SMALL`.
        words: What the picture shows.
        chosen: As of `flexact.show.picture.draw`.
    """
    content = still_of(analysis, words, size=size, plain=True, **chosen)
    return "" if content is None else shown(content, size, words)


def shown(content: bytes, size: tuple[int, int], words: str) -> str:
    """A picture as HTML, in few colours, at half its size."""
    made = image(fewer_colours(content, _COLOURS[size]), words)
    width = f"{size[0] // 2}px" if size == SMALL else "100%"
    style = f"width:{width};max-width:{size[0]}px;height:auto;background:#fff;border-radius:6px"
    return made.replace("<img ", f'<img width="{size[0] // 2}" style="{style}" ', 1)


_CELL = "text-align:left;vertical-align:top;padding:6px 10px;white-space:normal"


def table(heads: Sequence[str], rows: Iterable[Sequence[str]], title: str = "") -> str:
    """A table.

    Args:
        heads: Of the columns, as text.
        rows: Cells, as HTML.
        title: Above it, as HTML.
    """
    head = "".join(f"<th style='{_CELL}'>{text(each)}</th>" for each in heads)
    body = "".join(
        "<tr>" + "".join(f"<td style='{_CELL}'>{cell}</td>" for cell in row) + "</tr>"
        for row in rows
    )
    told = f"<p>{title}</p>" if title else ""
    return (
        f"<div style='overflow-x:auto'>{told}<table><thead><tr>{head}</tr></thead>"
        f"<tbody>{body}</tbody></table></div>"
    )


def verdict(colour: str, sign: str, words: str) -> str:
    """A verdict with its colour and its sign."""
    mark = (
        f"<span style='display:inline-block;min-width:1.4em;padding:0 .4em;border-radius:1em;"
        f"background:{colour};color:#fff;text-align:center'>{sign}</span>"
    )
    return f"{mark} {text(words)}"


_HOW = (
    "A still picture. It turns and plays where the notebook is trusted; if it does not, run "
    "<code>flexact.viewer()</code> in a cell."
)


def html_of(analysis: Result) -> str:
    """The result: still, and its data; the first of a kernel with the viewer."""
    body = content_of(analysis, is_short=True).body
    return (
        f"<{tag()}>{_light(analysis)}"
        f'<script type="application/octet-stream" class="flexact-data">{packed(body)}</script>'
        f"</{tag()}>{script() if is_wanted() else ''}"
    )


def _light(analysis: Result) -> str:
    """What is seen without scripts."""
    words = str(verdict_in_words(analysis))
    name = f"{text(analysis.name)}<br>" if analysis.name else ""
    head = f"<b>{text(words)}</b>"
    line = f"border-left:5px solid {analysis.colour};padding-left:10px"
    margin = text(margin_in_short(analysis).capitalize())
    told = escape(attempted("", lambda: describe(analysis, most=MOST_MODES), words, None))
    return (
        f"<div><p style='{line}'>{name}{head} {margin}.</p>{still(analysis, WHOLE, words)}"
        f"<details><summary>In words</summary><pre>{told}</pre></details>"
        f"<p><small>{_HOW}</small></p></div>"
    )


class Viewer:
    """The viewer of results in notebooks, brought by the cell that shows this."""

    def __repr__(self) -> str:
        """What it is."""
        return "<the viewer of results in notebooks>"

    def _repr_html_(self) -> str:
        begin()
        is_wanted()
        return f"<p>The viewer is here: results in this notebook turn and play.</p>{script()}"


def viewer() -> Viewer:
    """The viewer, for a notebook that has lost it: show it in a cell, and all results live.

    The first result that a kernel shows brings it by itself. It is gone where that output was
    cleared, and in a copy of some cells.
    """
    return Viewer()
