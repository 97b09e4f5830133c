# SPDX-License-Identifier: BSD-3-Clause
"""What notebooks show: a result, a row of results, their parts, and a model in the making.

The viewer is one script for all results of a notebook, and defines their element.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import re
import sys
from collections import Counter
from collections.abc import Iterable, Sequence
from functools import cache, partial
from html import escape
from importlib import resources
from typing import Any, overload

import numpy as np

from ...advice.describe import MOST_MODES, describe, verdict_in_words
from ...advice.todo import todo_of
from ...analysis.mode_words import conflict_in_words, motion_in_parts, stress_in_parts
from ...analysis.naming import Pieces, counted, plain
from ...analysis.places import listed
from ...analysis.result import Modes, Motion, Result, SelfStress
from ...analysis.verdict_words import margin_in_short, verdict_word
from ...core.elements import Class, NodeKind
from ...deck.rendering import ProblemsError
from ...model.data import ModelData
from ...model.parts.parts import PartKind, Parts
from ...util.errors import require_kind
from ...util.partial import attempted, why
from ...util.text import file_name, harmless
from ..page.assets import SCRIPTS, asset, image, packed, text
from ..page.content import content_of, kind_of
from ..picture import has_packages, model_bytes, still_of
from ..picture.files import fewer_colours
from ..writers import as_bytes

#: What starts a page from disk is left out.
_START = "start.js"
#: What of the page's styles becomes what, of a tree of its own.
_RULES = (
    (re.escape(':root[data-theme="dark"]'), ':host([data-theme="dark"])'),
    (re.escape(':root:not([data-theme="light"])'), ":host(:not([data-theme]))"),
    (r":root\b", ":host"),
    (r"(?m)^(\s*)body \{", r"\1.page {"),
    (r"@media \((m(?:in|ax)-width: [^)]*)\)", r"@container (\1)"),
    (r"(?<![\w.])(\d*\.?\d+)vw\b", r"\1cqw"),
)
_REM = re.compile(r"(?<![\w.])(\d*\.?\d+)rem\b")
#: Lines of remarks in scripts, which few read in a notebook.
_REMARK = re.compile(r"(?m)^ *//(?! SPDX).*\n")


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
        f'}})("{packed(as_bytes(whole))}");'
    )
    return f"<script>{start}</script>"


@cache
def style() -> str:
    """The styles of the page for a tree of its own, as wide as a notebook makes it.

    Widths are those of the output, not of the window; sizes do not follow the letters that
    a notebook has; light and dark stand on the host.
    """
    made = asset("style.css")
    made += resources.files(__package__).joinpath("notebook.css").read_text("utf-8")
    for pattern, instead in _RULES:
        made = re.sub(pattern, instead, made)
    return _REM.sub(lambda found: f"{16 * float(found[1]):g}px", made)


@cache
def _scripts() -> str:
    parts = [asset(name) for name in SCRIPTS if name != _START]
    own = resources.files(__package__).joinpath("element.js").read_text("utf-8")
    return _REMARK.sub("", "\n".join((*parts, own)))


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


def table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table.

    Args:
        heads: Of the columns, as text.
        rows: Cells, as HTML.
    """
    head = "".join(f"<th style='{_CELL}'>{text(each)}</th>" for each in heads)
    body = "".join(
        "<tr>" + "".join(f"<td style='{_CELL}'>{cell}</td>" for cell in row) + "</tr>"
        for row in rows
    )
    return (
        f"<div style='overflow-x:auto'><table><thead><tr>{head}</tr></thead>"
        f"<tbody>{body}</tbody></table></div>"
    )


_HOW = (
    "A still picture. It turns and plays where the notebook is trusted; if it does not, run "
    "<code>flexact.viewer()</code> in a cell."
)


def html_of(analysis: Result) -> str:
    """The result: still, and its data; the first of a kernel with the viewer."""
    body = content_of(analysis, is_short=True).body
    return (
        f"<{tag()}>{_light(analysis)}"
        '<script type="application/octet-stream" class="flexact-data">'
        f"{packed(as_bytes(body))}</script>"
        f"</{tag()}>{script() if is_wanted() else ''}"
    )


def _light(analysis: Result) -> str:
    """What is seen without scripts."""
    words = str(verdict_in_words(analysis))
    name = f"{text(analysis.name)}<br>" if analysis.name else ""
    head = f"<b>{text(words)}</b>"
    line = f"border-left:5px solid {analysis.colour};padding-left:10px"
    margin = text(margin_in_short(analysis).capitalize())
    told = escape(attempted("", lambda: describe(analysis, todo=todo_of(analysis)), words, None))
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


#: How many parts a row tells.
_PARTS = 6


def html_of_part(analysis: Result, what: object) -> str | None:
    """A motion, a self-stress, or a row of them as a table; None of anything else."""
    if isinstance(what, Modes):
        return _table(analysis, what.kind is Motion, tuple(what[:MOST_MODES]), len(what))
    if isinstance(what, (Motion, SelfStress)):
        return _table(analysis, isinstance(what, Motion), (what,), 1)
    return None


def _table(analysis: Result, moves: bool, modes: Sequence[Motion | SelfStress], count: int) -> str:
    what = "motion" if moves else "self-stress"
    if not count:
        return f"<p>No {what}{'s' if moves else 'es'}.</p>"
    missing: list[str] = []
    rows = [
        row
        for k, mode in enumerate(modes, start=1)
        if (row := attempted(f"Row {k}", partial(_row, analysis, mode), None, missing))
    ]
    heads = ("", "", "what moves, and how" if moves else "what is stressed, and with what")
    note = "Relative values: only their ratios matter."
    if count > len(rows):
        note += f" Of {count} the first {len(rows)} are shown."
    note += "".join(f" {each}" for each in missing)
    if len(modes) > 1:
        note += " They are one basis of many: any combination of them is also one."
    return f"{table(heads, rows)}<p><small>{text(note)}</small></p>"


def _row(analysis: Result, mode: Motion | SelfStress) -> tuple[str, str, str]:
    number = mode.index + 1
    if isinstance(mode, Motion):
        title, parts = f"Motion {number}", motion_in_parts(mode, _PARTS)
        lead: Pieces = ()
        picture = still(analysis, SMALL, title, motion=number)
    else:
        title, lead = f"Self-stress {number}", conflict_in_words(mode)
        parts = stress_in_parts(mode, _PARTS)
        picture = still(analysis, SMALL, title, stress=number)
    items = "".join(f"<li>{text(plain(each))}</li>" for each in parts[:_PARTS])
    more = "<li>\N{HORIZONTAL ELLIPSIS}</li>" if len(parts) > _PARTS else ""
    start = f"{text(plain(lead))}:" if lead else ""
    told = f"{start}<ul style='margin:0;padding-left:1.2em'>{items}{more}</ul>"
    return f"<b>{title}</b>", picture, told


_PLURALS = {PartKind.BODY: "bodies"}


def html_of_model(data: ModelData) -> str:
    """What a model is made of so far, a picture of it, and what is wrong with it."""
    name = f"<b>{text(data.name)}</b><br>" if data.name else ""
    told = ""
    try:
        data.require_sound()
    except ProblemsError as error:
        first = error.diagnostics[0]
        problems = f"It cannot be analysed yet: {first.message}.", first.help or ""
        told = "".join(f"<br>{text(each)}" for each in problems if each)
    return f"<div><p>{name}{text(_made_of(data))}{told}</p>{_picture(data)}</div>"


def _made_of(data: ModelData) -> str:
    """Such as "2 sheets and 1 body; 8 nodes, 4 of them fixed; 1 degree of freedom declared."."""
    arrays = data.arrays
    elements, nodes = arrays.element_number.size, arrays.node_number.size
    if not elements:
        return "A model without elements so far."
    kinds = Counter(part.kind for part in Parts(data).all)
    parts = listed(
        [
            f"{count} {kind.value if count == 1 else _PLURALS.get(kind, f'{kind.value}s')}"
            for kind, count in kinds.items()
        ]
    )
    classes = arrays.coordinate_class
    held = np.any(classes == Class.FIXED, axis=0) & (arrays.node_kind <= NodeKind.POSITION)
    supports = int(np.count_nonzero(held))
    free = int(np.count_nonzero(classes == Class.INDEPENDENT))
    free += int(np.count_nonzero(arrays.deformation_class == Class.INDEPENDENT))
    return (
        f"{parts} ({elements} elements, {nodes} nodes); "
        f"{counted(supports, 'point', '', 's')} held; "
        f"{counted(free, 'degree', '', 's')} of freedom declared. Not analysed yet."
    )


def _picture(data: ModelData) -> str:
    if not has_packages() or not data.arrays.element_number.size:
        return ""
    try:
        content = model_bytes(data, WHOLE)
    except Exception as error:
        # A model that is not sound may have no drawing.
        if not data.problems.errors:
            why(error)
        return ""
    return shown(content, WHOLE, "the model in its reference shape")


#: How many rows have a picture: each takes some tenths of a second.
MOST_PICTURES = 40
_HEADS = ("", "mechanism", "verdict", "motions", "self-stresses", "margin")


class Results(Sequence[Result]):
    """Results in a row, which a notebook shows as a table with pictures.

    Args:
        results: Results of `analyse`, such as those of some designs.

    Raises:
        TypeError: One of them is no result.
    """

    def __init__(self, results: Iterable[Result]) -> None:
        """Keep them in their order."""
        self._all = tuple(results)
        for each in self._all:
            require_kind(each, Result, "a table of results holds results of analyse()")

    def __len__(self) -> int:
        """How many there are."""
        return len(self._all)

    @overload
    def __getitem__(self, index: int) -> Result: ...
    @overload
    def __getitem__(self, index: slice) -> Results: ...
    def __getitem__(self, index: int | slice) -> Result | Results:
        """One of them, or several."""
        return Results(self._all[index]) if isinstance(index, slice) else self._all[index]

    def __repr__(self) -> str:
        """A line each."""
        rows = [_words(each) for each in self._all]
        widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
        lines = (
            "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
            for row in rows
        )
        return "\n".join(lines) or "no results"

    def _repr_html_(self) -> str:
        rows = []
        for k, each in enumerate(self._all):
            name, word, *others = _words(each)
            words = str(verdict_in_words(each))
            picture = still(each, SMALL, words) if k < MOST_PICTURES else ""
            sign = (
                "<span style='display:inline-block;min-width:1.4em;padding:0 .4em;"
                f"border-radius:1em;background:{each.colour};color:#fff;text-align:center'>"
                f"{kind_of(each)[1]}</span> {text(word)}"
            )
            rows.append((picture, f"<b>{text(name)}</b>", sign, *map(text, others)))
        return table(_HEADS, rows) if rows else "<p>No results.</p>"


def _words(result: Result) -> tuple[str, ...]:
    name = harmless(file_name(result.name)) or "model"
    counts = str(result.under_constrained), str(result.over_constrained)
    return name, verdict_word(result), *counts, margin_in_short(result)
