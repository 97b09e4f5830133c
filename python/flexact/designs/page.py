# SPDX-License-Identifier: BSD-3-Clause
"""Layouts as one HTML file that opens offline: a card each, and all of them compared.

A card has a drawing that moves as is wanted, the freedom in red and what each flexure holds in
blue; its scores; its deck and its script; and the whole page of its deck, compressed, which opens
in the place of the cards. The drawings share one viewer.
"""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from functools import reduce
from operator import add
from typing import TYPE_CHECKING

import numpy as np

from ..advice.constraint_quality import Hold
from ..advice.spaces.screws import EXACT, ScrewSpace
from ..analysis.freedoms import Freedom, together
from ..analysis.naming import Line, line_of
from ..analysis.places import listed
from ..api import Analysis, analyse
from ..core.arrays import FloatArray
from ..show.drawing import Moving, drawing_of
from ..show.notebook.output import SMALL, shown
from ..show.notebook.output import table as notebook_table
from ..show.page.assets import (
    FEW_SHAPES,
    LAYOUT_SCRIPTS,
    LAYOUT_STYLES,
    filled,
    folded,
    json_for_script,
    packed,
    paragraphs,
    row,
    section,
    table,
    text,
)
from ..show.page.compare import spaces_body, top
from ..show.page.content import Content, content_of
from ..show.page.controls import choices_part, facet, finder, toolbar
from ..show.page.drawing import drawing_part, frames_of
from ..show.page.index import data_of
from ..show.page.viewer import motions_data
from ..show.picture import has_packages, spaces_bytes
from ..show.picture.files import fewer_colours
from ..show.spaces import SpaceShape, SpaceShown, shape_of_hold, space_shown
from ..show.writers import as_bytes
from ..util.partial import attempted
from ..util.text import harmless, number_in_words, slug
from .explain import Explanation, nearby
from .explain_files import in_one_line, sides_of
from .layouts import Flexure, Layout, plural, stem_of
from .problem import KINDS, Problem
from .reshape import became
from .scores import OBJECTIVES, SCORES, cell, columns_of, pareto, shown_unit, stage_point, unit_rows

if TYPE_CHECKING:
    from .design import Designs

#: Of more coordinates motions are drawn along their velocities: there are many layouts, and each
#: would take seconds.
_FOLLOWED = 60
#: Less than this part of the largest twist, or of the size, is no motion.
_STAYS = 1.0e-9


def page_of(designs: Designs, title: str) -> bytes:
    """The page of an answer.

    Args:
        designs: The answer.
        title: Of the page where the problem has none.
    """
    made = Cards(with_pictures=True).content_of(designs, title)
    return as_bytes(
        filled(made.title, made.body, (*LAYOUT_SCRIPTS, "start_layouts.js"), LAYOUT_STYLES)
    )


class Cards:
    """Cards of layouts, each drawn once however often it is shown."""

    def __init__(self, *, with_pictures: bool = False) -> None:
        """None yet; pictures are for browsers without scripts or WebGL."""
        self.with_pictures = with_pictures
        self._drawings: dict[str, str] = {}
        self._wholes: dict[str, str] = {}

    def content_of(self, designs: Designs, title: str, *, is_whole: bool = True) -> Content:
        """What the page of an answer holds; whole, it has the page of each deck, too."""
        problem = designs.problem
        title = harmless(problem.title or title)
        if not designs.layouts:
            return without_layouts(designs, title)
        many = len(designs.layouts)
        told = designs.found_in_words, designs.confirmed
        words = f"{title}: {number_in_words(many)} layout{'s' * (many > 1)}"
        return self._content(words, designs.explanation, designs.layouts, told, is_whole)

    def content_so_far(
        self, problem: Problem, explanation: Explanation, layouts: Sequence[Layout], title: str
    ) -> Content:
        """What the page holds while further layouts are sought: cards without whole pages."""
        words = f"{harmless(problem.title or title)}: {number_in_words(len(layouts))} so far"
        told = ("Further layouts are being sought.",)
        return self._content(words, explanation, layouts, told, False)

    def _content(
        self,
        headline: str,
        explanation: Explanation,
        layouts: Sequence[Layout],
        told: Sequence[str],
        is_whole: bool,
    ) -> Content:
        best = pareto(layouts)
        cards = "".join(
            self._card(layout, place, is_best, is_whole)
            for place, (layout, is_best) in enumerate(zip(layouts, best, strict=True))
        )
        wanted, *takes = explanation.lines
        body = (
            top(headline, told, is_named=False),
            '<main class="plain layouts">',
            section(
                "wanted",
                "What is wanted",
                paragraphs((wanted,)),
                folded("What it takes", paragraphs(takes)),
            ),
            compared(layouts, best),
            finder_of(layouts, best),
            moving(),
            f'<ul class="cards">{cards}</ul></main>',
            '<div class="one" hidden></div>',
        )
        return Content(headline, "\n".join(body))

    def _card(self, layout: Layout, place: int, is_best: bool, is_whole: bool) -> str:
        deck = layout.model.to_deck()
        key = hashlib.sha256(deck.encode()).hexdigest()[:16]
        number, analysis = layout.number, analyse(layout.model)
        if key not in self._drawings:
            self._drawings[key] = self._drawing(layout, analysis, key)
        data = {
            "key": key,
            "number": number,
            "kind": slug(kinds_of(layout)),
            "held": "over" if layout.over_constrained else "exact",
            "best": "best" if is_best else "other",
            "place": place,
            "name": layout.what,
            "file": stem_of(layout),
            **{name: repr(value) for name, value in layout.scores.items()},
        }
        what = text(layout.what)
        name = what[:1].upper() + what[1:]
        if is_whole:
            name = f'<a href="#layout={number}">{name}</a>'
        whole = ""
        if is_whole:
            if key not in self._wholes:
                self._wholes[key] = packed(as_bytes(page_of_deck(layout, analysis)))
            kind = "application/octet-stream"
            whole = f'<script type="{kind}" class="whole">{self._wholes[key]}</script>'
        return (
            f'<li class="card layout" id="card-{number}"{data_of(data)}>'
            f'<div class="said"><h2><span class="number">{number}</span> {name}</h2>'
            f"{badges(layout, is_best)}{numbers(layout)}{refined_words(layout)}</div>"
            f"{self._drawings[key]}{taken(layout, deck, is_whole)}{whole}</li>\n"
        )

    def _drawing(self, layout: Layout, analysis: Analysis, key: str) -> str:
        """The drawing of a card with its choices; a sentence where it cannot be made."""
        still = picture_of(layout, analysis) if self.with_pictures else None
        words = f"Layout {layout.number}, {layout.what}"

        def drawn() -> str:
            drawing = drawing_of(analysis.given)
            (frame,) = frames_of(drawing)
            spaces = list(spaces_of(layout, frame.size))
            moving = list(wanted_motions(layout, analysis))
            data = motions_data(analysis.parts, frame, moving, spaces, _FOLLOWED)
            several = data if len(data["movements"]) > 1 else {**data, "movements": []}
            choices = choices_part({**several, "spaces": []}, (), mark=f"{key}-")
            return f"{drawing_part(data, still, words, mark=f'{key}-')}{choices}"

        missing: list[str] = []
        made = attempted("The drawing", drawn, "", missing)
        if not made:
            return f'<p class="note">{text(" ".join(missing))}</p>'
        return f'<div class="viewer">{made}</div>'


def refined_words(layout: Layout) -> str:
    """What refining made of a layout; nothing where it was not refined."""
    said = became(layout)
    return f'<p class="note">{text(f"Refined: {said}.")}</p>' if said else ""


def page_of_deck(layout: Layout, analysis: Analysis) -> str:
    """What the page of `flexact view` holds; why not, where it cannot be made.

    The stage's degrees of freedom move, which come first: those of necks and folds, of which there
    may be dozens, take long to be followed.
    """
    missing: list[str] = []
    moving = max(layout.problem.freedom.dimension, 1)

    def made() -> str:
        return content_of(
            analysis, has_origin=False, room=FEW_SHAPES, moving=moving, follows=_FOLLOWED
        ).body

    body = attempted("The page of the deck", made, "", missing)
    return body or f'<main class="plain"><p>{text(" ".join(missing))}</p></main>'


def without_layouts(designs: Designs, title: str) -> Content:
    """What the page holds where there is no layout: why, what is near it, what it would take."""
    why, explanation = designs.why_none, designs.explanation
    typed = [motion.twist for motion in designs.problem.wanted]
    near = [
        line_of(statement)
        for _, statement in nearby(designs.possible, typed, units=designs.problem.units)
    ]
    head, *takes = explanation.lines
    told: list[Line] = list(near)
    told += [each for each in takes if each not in near]
    statement = "" if why is None else f": {why.statement}"
    body = spaces_body(title, f"No layout{statement}", [head, *told], sides_of(explanation))
    return Content(f"{title}: no layout", body)


def html_of(designs: Designs) -> str:
    """What a notebook shows: what is wanted, and a table of the layouts with pictures."""
    wanted = text(in_one_line(designs.explanation.lines[0]))
    if not designs.layouts:
        why = "" if designs.why_none is None else f": {text(designs.why_none.statement)}"
        return f"<div><p>{wanted}</p><p><b>No layout</b>{why}</p></div>"
    keys = ordered_columns(designs.layouts)
    heads = ("", "layout", *(f"{SCORES[key].head} {SCORES[key].under}".strip() for key in keys))
    best = pareto(designs.layouts)
    rows = [
        (
            in_notebook(layout),
            f"<b>{layout.number}</b>&nbsp; {text(layout.what)}" + _MARK * is_best,
            *(text(cell(key, layout)) for key in keys),
        )
        for layout, is_best in zip(designs.layouts, best, strict=True)
    ]
    told = text(f"{designs.found_in_words} {designs.confirmed}")
    star = text(_STAR) if any(best) and not all(best) else ""
    table_ = notebook_table(heads, rows)
    return f"<div><p>{wanted}</p>{table_}<p><small>{told} {star}</small></p></div>"


def in_notebook(layout: Layout) -> str:
    """A small picture of what the flexures hold, where it can be made."""
    if not has_packages():
        return ""

    def drawn() -> str:
        given = layout.model.data
        *_, held = spaces_of(layout, drawing_of(given).size)
        made = spaces_bytes(given, [held], layout.what, size=SMALL, plain=True)
        return shown(made, SMALL, layout.what)

    return attempted("The picture", drawn, "", None)


# What is drawn


def wanted_motions(layout: Layout, analysis: Analysis) -> Iterator[tuple[str, Moving]]:
    """The wanted motions, each with its words, made of what is declared."""
    problem = layout.problem
    at = stage_point(analysis.given, problem.body)
    arm = problem.centre - analysis.given.arrays.node_value[:3, at.position]
    free: list[Freedom] = []
    twists: list[FloatArray] = []
    for freedom in analysis.freedoms:
        motion = freedom.motion
        if motion is None:
            continue
        turned = motion.rotation[at.orientation]
        moved = motion.displacement[at.position] + np.cross(turned, arm)
        twist = np.concatenate((problem.size * turned, moved))
        # Of folds, and of bodies between, the stage knows nothing.
        if np.linalg.norm(twist) > _STAYS * problem.size:
            free.append(freedom)
            twists.append(twist)
    for wanted in problem.wanted if free else ():
        scaled = wanted.twist * problem.freedom.factors
        shares = np.linalg.lstsq(np.transpose(twists), scaled, rcond=_STAYS)[0]
        chosen = np.abs(shares) > _STAYS * np.abs(shares).max()
        parts = [(free[k], float(shares[k])) for k in np.flatnonzero(chosen)]
        found = together(parts)
        if found is not None:
            yield harmless(wanted.text), found


def spaces_of(layout: Layout, size: float) -> Iterator[SpaceShown]:
    """The wanted freedom, and what the flexures hold, in a drawing of a size [m]."""
    yield space_shown(layout.problem.freedom, "Freedom", "what is wanted", size)
    holds = [hold_shown(flexure, layout.problem, size) for flexure in layout.flexures]
    shape = reduce(add, holds, SpaceShape(is_freedom=False))
    yield SpaceShown("Constraints", shape, "what the flexures hold", np.zeros((0, 2, 3)))


#: Width and height of a still picture [px], and how many colours it has.
_STILL, _COLOURS = (720, 330), 24


def picture_of(layout: Layout, analysis: Analysis) -> bytes | None:
    """Freedom and constraints side by side as PNG, where the packages for it are there."""
    if not has_packages():
        return None
    given = analysis.given

    def drawn() -> bytes:
        shown = list(spaces_of(layout, drawing_of(given).size))
        return fewer_colours(
            spaces_bytes(given, shown, layout.what, size=_STILL, plain=True), _COLOURS
        )

    return attempted("The picture", drawn, None, None)


def hold_shown(flexure: Flexure, problem: Problem, size: float) -> SpaceShape:
    """What is drawn of what a flexure holds: a line of a wire, a plane of a sheet."""
    middle = flexure.ends.mean(axis=0)
    rows = np.linalg.qr(unit_rows(flexure, middle, problem.size).T)[0].T
    space = ScrewSpace(
        rows / np.repeat((problem.size, 1.0), 3), middle, problem.size, True, tolerance=EXACT
    )
    extent = float(np.linalg.norm(flexure.ends[1] - flexure.ends[0]))
    return shape_of_hold(Hold((), space, 1.0, extent), size, planar=False)


# What is said


def badges(layout: Layout, is_best: bool) -> str:
    """Whether it is exactly constrained, and whether it is in the Pareto set."""
    over, proven = layout.over_constrained, layout.is_proven
    kind, sign = ("over", "!") if over else ("exact", "\N{CHECK MARK}")
    words = f"over-constrained by {over}" if over else "exactly constrained"
    words += ", proven" if proven and not over else ""
    best = '<span class="badge best">\N{BLACK STAR} Pareto set</span>' if is_best else ""
    alike = ""
    if layout.alike > 1:
        many = number_in_words(layout.alike)
        alike = f'<span class="badge">stands for {many} images</span>'
    return (
        f'<p class="badges"><span class="badge {kind}"><span aria-hidden="true">{sign}</span> '
        f"{text(words)}</span>{best}{alike}</p>"
    )


def numbers(layout: Layout) -> str:
    """Its scores: those that decide, and the others folded away."""
    main = columns_of([layout], layout.problem.rank)
    rest = [key for key in SCORES if key in layout.scores and key not in main]
    first, others = (
        "".join(
            f"<div><dt>{text(SCORES[key].words)}</dt><dd>{text(cell(key, layout))}</dd></div>"
            for key in keys
        )
        for keys in (main, rest)
    )
    away = folded("Further scores", f'<dl class="numbers">{others}</dl>') if others else ""
    return f'<dl class="numbers">{first}</dl>{away}'


def taken(layout: Layout, deck: str, is_whole: bool) -> str:
    """What one may take: the deck, the script, and how solids are made."""
    script = attempted("The script", layout.python, "", None)
    stem = stem_of(layout)
    parts = [("deck", "Deck", f"{stem}.dat", deck)]
    parts += [("script", "Python", f"{stem}.py", script)] * bool(script)
    export = f"flexact export {stem}.dat -o {stem}.step"
    shown = "".join(
        f'<div class="text" data-file="{text(name)}"><p><b>{title}</b> <code>{text(name)}</code>'
        '<button type="button" class="copy" hidden>Copy</button>'
        '<button type="button" class="save" hidden>Save</button></p>'
        f'<pre tabindex="0" aria-label="{title}"><code>{in_lines(content)}</code></pre></div>'
        for _, title, name, content in parts
    )
    solids = (
        '<div class="text"><p><b>STEP</b> of the saved deck '
        '<button type="button" class="copy" hidden>Copy</button></p>'
        f'<pre tabindex="0" aria-label="STEP"><code>{text(export)}</code></pre></div>'
    )
    opens = ""
    if is_whole:
        opens = f'<a class="open" href="#layout={layout.number}">Open its page</a>'
    return (
        f'<div class="take">{opens}<details><summary>Deck, Python, STEP</summary>{shown}{solids}'
        "</details></div>"
    )


def in_lines(content: str) -> str:
    """A text of several lines as HTML."""
    return "\n".join(map(text, content.splitlines()))


def kinds_of(layout: Layout) -> str:
    """Of which kinds its flexures are, such as "sheets and wires"."""
    there = {flexure.kind for flexure in layout.flexures}
    return listed([plural(kind) for kind in (*KINDS[1:], KINDS[0]) if kind in there] or ["none"])


#: The mark of the Pareto set, and what it means.
_MARK = " \N{BLACK STAR}"
_STAR = (
    f"{_MARK.strip()} No other layout is better in stiffness, drive, frequency or parts without "
    "a loss."
)


def ordered_columns(layouts: Sequence[Layout]) -> list[str]:
    """Keys of the columns of a table; that by which they are ordered first, as on phones alone."""
    rank = layouts[0].problem.rank
    return sorted(columns_of(layouts, rank), key=lambda key: key != rank[0])


def compared(layouts: Sequence[Layout], best: Sequence[bool]) -> str:
    """All layouts in a table, and in a chart whose axes are chosen where there are scripts."""
    keys = ordered_columns(layouts)
    heads = ("layout", *(f"{SCORES[key].head} {SCORES[key].under}" for key in keys))
    rows = (
        row(
            f'<a href="#card-{layout.number}"><span class="number">{layout.number}</span> '
            f"{text(layout.what)}</a>"
            + (f'<span class="star" title="Pareto set">{_MARK}</span>' if is_best else ""),
            *(
                f'<span class="head" aria-hidden="true">{text(head)}</span>'
                f"<span>{text(cell(key, layout, unit=not SCORES[key].under.startswith('N/um')))}"
                "</span>"
                for key, head in zip(keys, heads[1:], strict=True)
            ),
            about=f' data-number="{layout.number}"',
        )
        for layout, is_best in zip(layouts, best, strict=True)
    )
    axes = [
        _axis(key, layouts[0].problem)
        for key in SCORES
        if len({layout.scores[key] for layout in layouts if key in layout.scores}) > 1
    ]
    chart = ""
    if len(axes) > 1 and len(layouts) > 1:
        chart = (
            '<figure class="chart plot" hidden>'
            f'<script type="application/json" class="axes">{json_for_script({"axes": axes})}'
            f"</script>{_axis_chosen('x', 'Along', axes, OBJECTIVES[1])}"
            f"{_axis_chosen('y', 'Up', axes, OBJECTIVES[0])}"
            '<div class="plotted"></div></figure>'
        )
    size = 1.0e3 * layouts[0].problem.size
    notes = [f"Turns are compared with displacements at L = {size:.4g} mm."]
    if any(best) and not all(best):
        notes.insert(0, _STAR)
    note = f'<p class="note">{text(" ".join(notes))}</p>'
    whole = f'<div class="scores">{table(heads, rows, kind="designs")}{note}</div>'
    return section("compared", "Compared", f'<div class="both">{chart}{whole}</div>')


def _axis(key: str, problem: Problem) -> dict[str, object]:
    """What the plot needs to know of a score."""
    unit, factor = shown_unit(key, problem)
    words, lower = SCORES[key].words, SCORES[key].lower
    return {"key": key, "words": words, "lower": lower, "unit": unit, "factor": factor}


def _axis_chosen(name: str, words: str, axes: Sequence[Mapping[str, object]], first: str) -> str:
    options = "".join(
        f'<option value="{text(str(each["key"]))}"{" selected" * (each["key"] == first)}>'
        f"{text(str(each['words']))}</option>"
        for each in axes
    )
    return f'<label>{words} <select class="axis" data-axis="{name}">{options}</select></label>'


def moving() -> str:
    """What plays in all drawings, from where they are seen, and what is drawn in them."""
    boxes = "".join(
        f'<label class="check"><input type="checkbox" data-space="{k}" checked>'
        f'<span class="swatch of-{name}" aria-hidden="true"></span>{words}</label>'
        for k, (name, words) in enumerate(
            (("freedom", "freedom"), ("constraint", "what flexures hold"))
        )
    )
    tools = toolbar({"planar": False, "movements": [True]})
    return (
        f'<section class="shared moving" aria-label="All drawings" hidden>{tools}{boxes}</section>'
    )


def finder_of(layouts: Sequence[Layout], best: Sequence[bool]) -> str:
    """What chooses and sorts the cards: kinds, how they are held, ranges of scores."""
    counts = Counter(map(kinds_of, layouts))
    kinds = [(slug(words), f"{words} ({count})") for words, count in counts.items()]
    over = sum(layout.over_constrained > 0 for layout in layouts)
    held = [("exact", "exactly constrained"), ("over", "over-constrained")]
    further = facet("held", "How it is held", held) if 0 < over < len(layouts) else ""
    if any(best) and not all(best):
        further += facet("best", "Pareto set", [("best", "\N{BLACK STAR} Pareto set")])
    keys = [key for key in SCORES if any(key in layout.scores for layout in layouts)]
    orders = [("place", "rank"), ("name", "name")]
    orders += [
        (key if SCORES[key].lower else f"-{key}", f"{SCORES[key].words}, the best first")
        for key in keys
    ]
    ranges = "".join(_range(key, layouts) for key in keys)
    further += folded("Only between", f'<div class="ranges">{ranges}</div>')
    return finder(kinds if len(kinds) > 1 else (), orders, "layouts", further)


def _range(key: str, layouts: Sequence[Layout]) -> str:
    """The least and the largest of a score, to be narrowed; nothing where all have the same."""
    unit, factor = shown_unit(key, layouts[0].problem)
    values = sorted({layout.scores[key] for layout in layouts if key in layout.scores})
    if len(values) < 2:
        return ""
    words = SCORES[key].words
    boxes = "".join(
        f'<input type="number" step="any" data-range="{key}" data-end="{end}" '
        f'data-factor="{factor!r}" placeholder="{factor * value:.3g}" '
        f'aria-label="{text(words)}, {end}">'
        for end, value in (("least", values[0]), ("most", values[-1]))
    )
    behind = f" [{text(unit)}]" if unit else ""
    return f"<div><span>{text(words)}{behind}</span>{boxes}</div>"
