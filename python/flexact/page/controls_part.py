# SPDX-License-Identifier: BSD-3-Clause
"""The drawing's place in the page, and the controls beside it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from ..drawing import QUANTITIES
from ..result.freedoms import Freedom
from ..text.naming import freedom_in_words
from ..text.sentences import Line
from .markup import flowing, image, text

_VIEWS = (("iso", "Iso"), ("front", "Front"), ("top", "Top"), ("right", "Right"))
_LAYERS = (
    ("ghost", "reference as a ghost", True),
    ("arrows", "arrows of displacements", True),
    ("symbols", "supports and freedoms", True),
    ("diagram", "bending diagram", False),
    ("elements", "element numbers", False),
    ("nodes", "node numbers", False),
)
_MORE_KEYS = "+ and \N{MINUS SIGN} zoom, 0 starts again, the space bar plays and pauses."
_KEYS = f"Drag or arrow keys turn the drawing, with Shift they move it; the wheel or {_MORE_KEYS}"
_PLANAR_KEYS = f"Drag or arrow keys move the drawing; the wheel or {_MORE_KEYS}"
_TOUCH = "One finger turns the drawing, two move and zoom it; a tap tells what is there."
_PLANAR_TOUCH = "One finger moves the drawing, two zoom it; a tap tells what is there."


def drawing_part(data: dict[str, Any], still: bytes | None, words: str, left_out: str) -> str:
    """The drawing: live where the browser can, else a still picture and words.

    Args:
        data: The drawing's data.
        still: A picture as PNG, if there is one.
        words: What the picture shows.
        left_out: Sentences about what is not in the page; may be empty.
    """
    planar = bool(data["planar"])
    keys = _PLANAR_KEYS if planar else _KEYS
    touch = _PLANAR_TOUCH if planar else _TOUCH
    note = f'<p class="note">{text(left_out)}</p>' if left_out else ""
    return (
        '<section id="drawing" aria-label="Drawing">'
        f'<div id="still">{_still(still, words)}</div>'
        '<div id="live" hidden>'
        '<div class="stage"><canvas id="canvas" tabindex="0" role="application" '
        f'aria-label="Drawing. {text(keys)}" aria-describedby="shown"></canvas>'
        '<canvas id="overlay" aria-hidden="true"></canvas>'
        '<canvas id="print" aria-hidden="true"></canvas>'
        '<div id="tip" role="tooltip" hidden></div></div>'
        '<div class="told-below"><p id="shown" role="status" aria-live="polite"></p>'
        f"{_LEGEND}</div>"
        f"{_toolbar(planar, bool(data['movements']))}"
        f'<p class="keys">{text(keys)}</p><p class="keys touch">{text(touch)}</p>'
        f"</div>{note}</section>"
    )


_LEGEND = (
    '<div id="legend" hidden><span id="legend-name"></span><span id="legend-bar"></span>'
    '<span class="ticks"><span id="legend-low"></span><span>0</span>'
    '<span id="legend-high"></span></span><span id="legend-note"></span></div>'
)


def _still(still: bytes | None, words: str) -> str:
    if still is None:
        return f'<p class="note">{text(words)} {text(_WITHOUT)}</p>'
    return f'{image(still, words)}<p class="note">{text(_WITHOUT)}</p>'


_WITHOUT = (
    "A browser with scripts and WebGL shows the drawing here, to turn, to play and to colour."
)


def _toolbar(planar: bool, moves: bool) -> str:
    views = "".join(
        f'<button type="button" data-view="{view}">{name}</button>'
        for view, name in (() if planar else _VIEWS)
    )
    return (
        '<div class="toolbar"><div class="group" role="group" aria-label="Movement"'
        f"{'' if moves else ' hidden'}>"
        '<button type="button" id="play">Play</button>'
        '<label>size <input type="range" id="amplitude" min="0" max="100" value="100"></label>'
        '<label>speed <input type="range" id="speed" min="0.1" max="1.5" step="0.1" value="0.5">'
        '</label></div><div class="group" role="group" aria-label="View">'
        f'{views}<button type="button" id="fit">Fit</button></div></div>'
    )


def choices_part(data: dict[str, Any], stuck: Sequence[Freedom]) -> str:
    """What is shown: a movement, a self-stress and its quantity, and layers.

    Args:
        data: The drawing's data.
        stuck: The declared degrees of freedom in which the mechanism cannot move.
    """
    stresses = [_choice(k, stress) for k, stress in enumerate(data["stresses"])]
    found = {each for stress in data["stresses"] for each in stress["largest"]}
    quantities = [
        (each, data["names"][each], data["meaning"][each]) for each in QUANTITIES if each in found
    ]
    return (
        '<section id="choices" class="choices" aria-label="What is shown" hidden>'
        + _movements(data["movements"])
        + _immovable(stuck)
        + (_radios("stress", "Self-stress", stresses, "None") if stresses else "")
        + (_radios("quantity", "Coloured by", quantities) if quantities else "")
        + _layers(bool(data["movements"]), bool(stresses))
        + "</section>"
    )


def _movements(movements: Sequence[dict[str, Any]]) -> str:
    """Motions and declared degrees of freedom: one choice, under two headings."""
    none, made = "None", ""
    for kind, legend in (("motion", "Motions"), ("freedom", "Declared degrees of freedom")):
        chosen = [
            _choice(index, movement)
            for index, movement in enumerate(movements)
            if movement["kind"] == kind
        ]
        if chosen:
            made += _radios("movement", legend, chosen, none)
            none = ""
    return made


def _choice(index: int, mode: dict[str, Any]) -> tuple[str, str, str]:
    """Value, words, and what tells more."""
    label = mode.get("label", mode["title"])
    return str(index), label, mode["title"] if mode["title"] != label else ""


def _immovable(stuck: Sequence[Freedom]) -> str:
    if not stuck:
        return ""
    items = tuple(map(freedom_in_words, stuck))
    line = Line(("Declared, but a self-stress stops it: ",), items)
    return f'<p class="note stuck">{flowing(line)}.</p>'


def _radios(name: str, legend: str, choices: Iterable[tuple[str, str, str]], none: str = "") -> str:
    every = ([("", none, "")] if none else []) + list(choices)
    made = "".join(_chip(name, *choice, checked=not choice[0]) for choice in every)
    return f"<fieldset><legend>{legend}</legend>{made}</fieldset>"


def _chip(name: str, value: str, words: str, more: str, checked: bool) -> str:
    told = f' title="{text(more)}"' if more else ""
    state = " checked" if checked else ""
    return (
        f'<label class="chip"><input type="radio" name="{name}" value="{value}"{told}{state}>'
        f"<span>{text(words)}</span></label>"
    )


def _layers(moves: bool, stressed: bool) -> str:
    lacking = {"ghost": not moves, "arrows": not moves, "diagram": not stressed}
    made = "".join(
        f'<label class="check"><input type="checkbox" data-layer="{layer}"'
        f"{' checked' if on else ''}>{words}</label>"
        for layer, words, on in _LAYERS
        if not lacking.get(layer)
    )
    return f"<fieldset><legend>Also drawn</legend>{made}</fieldset>"
