# SPDX-License-Identifier: BSD-3-Clause
"""The controls below and beside a drawing."""

from __future__ import annotations

from collections.abc import Container, Iterable, Sequence
from html import escape
from typing import Any

from ...analysis.freedoms import Freedom
from ...analysis.naming import Line, freedom_in_words
from ..drawing import QUANTITIES
from .assets import flowing, text

_VIEWS = (("iso", "Iso"), ("front", "Front"), ("top", "Top"), ("right", "Right"))
_LAYERS = (
    ("solids", "solids of the CAD", True),
    ("ghost", "reference as a ghost", True),
    ("arrows", "arrows of displacements", True),
    ("presses", "arrows of what parts press on bodies", True),
    ("symbols", "supports and freedoms", True),
    ("diagram", "bending diagram", False),
    ("axes", "local axes, p and q", False),
    ("elements", "names of elements", False),
    ("nodes", "names of nodes", False),
)
_MOVEMENTS = (
    ("wanted", "Moves"),
    *(("motion", "Motions"), ("freedom", "Declared degrees of freedom")),
    *(("vibrating", "Vibrates"), ("buckled", "Buckles")),
)
_MORE_KEYS = (
    "+ and \N{MINUS SIGN} zoom, 0 starts again, the space bar plays and pauses. "
    "A click keeps its mark, a double click or C brings it into the middle, Escape lets go."
)
KEYS = f"Drag or arrow keys turn the drawing, with Shift they move it; the wheel or {_MORE_KEYS}"
PLANAR_KEYS = f"Drag or arrow keys move the drawing; the wheel or {_MORE_KEYS}"
_TOUCH = "Drag to turn, two fingers move, pinch to zoom. Tap for what is there, twice to centre it."
_PLANAR_TOUCH = "Drag to move, pinch to zoom. Tap for what is there, twice to centre it."


def toolbar(*drawings: dict[str, Any]) -> str:
    """What plays some drawings together, and from where they are seen."""
    planar = all(each["planar"] for each in drawings)
    moves = any(each["movements"] for each in drawings)
    views = "".join(
        f'<button type="button" data-view="{view}">{name}</button>'
        for view, name in (() if planar else _VIEWS)
    )
    return (
        '<div class="toolbar"><div class="group" role="group" aria-label="Movement"'
        f"{'' if moves else ' hidden'}>"
        '<button type="button" class="play">Play</button>'
        '<label>size <input type="range" class="amplitude" min="0" max="100" value="100"></label>'
        '<label>speed <input type="range" class="speed" min="0.1" max="1.5" step="0.1" value="0.5">'
        '</label></div><div class="group" role="group" aria-label="View">'
        f'{views}<button type="button" class="fit">Fit</button>'
        '<button type="button" class="centre" disabled>Centre</button></div></div>'
    )


def keys(data: dict[str, Any]) -> str:
    """How a drawing is turned and moved by hand."""
    mouse, fingers = (PLANAR_KEYS, _PLANAR_TOUCH) if data["planar"] else (KEYS, _TOUCH)
    return f'<p class="keys">{text(mouse)}</p><p class="keys touch">{text(fingers)}</p>'


def choices_part(
    data: dict[str, Any], stuck: Sequence[Freedom], below: str = "", mark: str = ""
) -> str:
    """What is shown of one result: a movement, a self-stress and its quantity.

    Args:
        data: The drawing's data.
        stuck: The declared degrees of freedom in which the mechanism cannot move.
        below: HTML of further choices.
        mark: What tells its names from those of other drawings of the page.
    """
    stresses, spaces = (
        [_choice(k, each) for k, each in enumerate(data[what])] for what in ("stresses", "spaces")
    )
    found = {each for stress in data["stresses"] for each in stress["largest"]}
    quantities = [
        (each, data["names"][each], data["meaning"][each]) for each in QUANTITIES if each in found
    ]
    immovable = ""
    if stuck:
        line = Line(
            ("Declared, but a self-stress stops it: ",), tuple(map(freedom_in_words, stuck))
        )
        immovable = f'<p class="note stuck">{flowing(line)}.</p>'
    return (
        f'<section class="choices" aria-label="{text(f"What is shown {mark}".strip())}" hidden>'
        + _movements(data["movements"], mark)
        + immovable
        + _radios(mark, "stress", "Self-stress", stresses, "None")
        + _radios(mark, "quantity", "Coloured by", quantities)
        + _radios(mark, "space", "Freedom and constraint", spaces, "None")
        + _slider(data.get("misaligned"))
        + below
        + "</section>"
    )


def _slider(misaligned: dict[str, Any] | None) -> str:
    """The size of a misalignment, whose stress colours the drawing; nothing without one."""
    if misaligned is None:
        return ""
    first, *_, last = misaligned["values"]
    return (
        f'<fieldset class="misaligned"><legend>Misalignment of {text(misaligned["words"])}</legend>'
        f'<input type="range" min="{first}" max="{last}" step="any" value="0" '
        'aria-label="Size of the misalignment"><output></output></fieldset>'
    )


def _movements(movements: Sequence[dict[str, Any]], mark: str) -> str:
    """Motions, declared degrees of freedom and elastic shapes: one choice, under headings."""
    none, made = "None", ""
    for kind, legend in _MOVEMENTS:
        chosen = [
            _choice(index, movement)
            for index, movement in enumerate(movements)
            if movement["kind"] == kind
        ]
        if chosen:
            made += _radios(mark, "movement", legend, chosen, none)
            none = ""
    return made


def _choice(index: int, mode: dict[str, Any]) -> tuple[str, str, str]:
    """Value, words, and what tells more."""
    label = mode.get("label", mode["title"])
    return str(index), label, mode["title"] if mode["title"] != label else ""


def _radios(
    mark: str, name: str, legend: str, choices: list[tuple[str, str, str]], none: str = ""
) -> str:
    """One of some choices, each with a value, words, and what tells more; "" without any."""
    if not choices:
        return ""
    made = ""
    for value, words, more in ([("", none, "")] if none else []) + choices:
        told = f' title="{text(more)}"' if more else ""
        state = "" if value else " checked"
        made += (
            f'<label class="chip"><input type="radio" name="{mark}{name}" data-choice="{name}" '
            f'value="{value}"{told}{state}><span>{text(words)}</span></label>'
        )
    return f"<fieldset><legend>{legend}</legend>{made}</fieldset>"


def layers(*drawings: dict[str, Any], off: Container[str] = ()) -> str:
    """What else is drawn, of what some drawings have; some are not drawn at first."""
    moves, stressed = (any(each[name] for each in drawings) for name in ("movements", "stresses"))
    lacking = {"ghost": not moves, "arrows": not moves, "diagram": not stressed}
    lacking["presses"] = not stressed
    lacking["solids"] = not any("about" in each["bodies"] for each in drawings)
    made = "".join(
        f'<label class="check"><input type="checkbox" data-layer="{layer}"'
        f"{' checked' if on and layer not in off else ''}>{words}</label>"
        for layer, words, on in _LAYERS
        if not lacking.get(layer)
    )
    return f"<fieldset><legend>Also drawn</legend>{made}</fieldset>"


def finder(
    kinds: Iterable[tuple[str, str]],
    orders: Iterable[tuple[str, str]],
    what: str = "decks",
    further: str = "",
) -> str:
    """The choices, hidden until there is a script.

    Args:
        kinds: Classes of cards, each with what it is called, and how many there are.
        orders: What cards are sorted by, the name of the datum with what it is called; larger
            ones come later, or first where a minus is before the name.
        what: What the cards are.
        further: HTML of further choices.
    """
    options = "".join(
        f'<option value="{escape(name)}">{text(words)}</option>' for name, words in orders
    )
    one = what.removesuffix("s")
    return (
        f'<section class="finder" role="search" aria-label="Find {what}" data-what="{one}" hidden>'
        f"{facet('kind', 'Show only', kinds)}{further}"
        '<div class="group"><label class="find">Find <input type="search" id="find" '
        'autocomplete="off" spellcheck="false" placeholder="name or words"></label>'
        f'<label>Sort by <select id="sort">{options}</select></label>'
        '<button type="button" id="down" aria-pressed="false">Reverse</button>'
        '<button type="button" id="all">Show all</button></div>'
        '<p id="found" class="note" role="status"></p></section>'
    )


def facet(name: str, legend: str, kinds: Iterable[tuple[str, str]]) -> str:
    """Boxes of one datum of cards: none is as all; each value with what it is called."""
    chips = "".join(
        f'<label class="chip {escape(kind)}"><input type="checkbox" name="{name}" '
        f'value="{escape(kind)}"><span>{text(words)}</span></label>'
        for kind, words in kinds
    )
    return f'<fieldset><legend class="unseen">{legend}</legend>{chips}</fieldset>'
