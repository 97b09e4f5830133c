# SPDX-License-Identifier: BSD-3-Clause
"""What a page of a deck holds, to stand in a page of its own or in another."""

from __future__ import annotations

import hashlib
import platform
import shlex
from collections import defaultdict
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from ...advice.describe import (
    VerdictInWords,
    held_lines,
    lines_on_motions,
    lines_on_self_stresses,
    verdict_in_words,
)
from ...advice.spaces.spaces import Spaces
from ...advice.step import Step
from ...advice.todo import do_this, first_steps
from ...analysis.mode_words import conflict_in_words, motion_in_parts, stress_in_parts
from ...analysis.naming import Line, Named, Pieces, counted, plain
from ...analysis.result import Result
from ...analysis.verdict import Certainty, Verdict
from ...analysis.verdict_words import (
    decision,
    declared_in_words,
    margin_line,
    verdict_in_short,
    verdict_word,
    warnings_of,
)
from ...deck.diagnostics import Diagnostic, decode
from ...deck.rendering import ProblemsError
from ...model.writing import deck_of
from ...util.errors import require_kind
from ...util.loading import VERSION, feature
from ...util.partial import attempted, why
from ...util.text import file_name, harmless
from ..drawing import drawing_of
from ..drawing.movement import MOST_COORDINATES
from ..writers import as_bytes
from .assets import (
    FEW_SHAPES,
    MOST_LINES,
    MOST_MODES,
    MOST_PARTS,
    MOST_SHAPES,
    PLAIN_SCRIPTS,
    SCRIPTS,
    filled,
    flowing,
    folded,
    linked,
    paragraphs,
    row,
    section,
    table,
    text,
    three_version,
)
from .controls import choices_part, keys, layers, toolbar
from .drawing import drawing_part, frames_of
from .scenery import Scenery, place_scenery, preface
from .viewer import body_named, left_out, stuck_in, viewer_data

#: A deck of so many lines is shown at once.
_SHORT = 40
#: Characters of a line that are shown.
_LONGEST = 400


def deck_part(
    raw: bytes, diagnostics: Sequence[Diagnostic], is_written: bool = False, what: str = "Deck"
) -> str:
    """A deck's text.

    Args:
        raw: The deck.
        diagnostics: What is to be told about it.
        is_written: Whether the deck was written by Flexact, for a model made in Python.
        what: What it is.
    """
    at: dict[int, list[Diagnostic]] = defaultdict(list)
    for item in diagnostics:
        at[item.line].append(item)
    lines = [decode(line.removesuffix(b"\r")) for line in raw.split(b"\n")]
    if lines and not lines[-1]:
        lines.pop()
    chosen = sorted({*range(1, min(len(lines), MOST_LINES) + 1), *at} - {0})
    shown = "".join(
        _line(number, lines[number - 1], at[number]) for number in chosen if number <= len(lines)
    )
    note = ""
    if is_written:
        note = '<p class="note">The model was made in Python; this deck says the same.</p>'
    if len(lines) > MOST_LINES:
        note += (
            f'<p class="note">Of {len(lines)} lines the first {MOST_LINES} are shown, and those '
            "with diagnostics.</p>"
        )
    opened = " open" if len(lines) <= _SHORT or diagnostics else ""
    summary = f"{len(lines)} line{'s' * (len(lines) != 1)}"
    return section(
        "deck",
        what,
        "".join(_told(item) for item in at[0]),
        note,
        f"<details{opened}><summary>{summary}</summary>"
        f'<div class="deck" role="group" aria-label="{what.lower()}" tabindex="0">{shown}</div>'
        "</details>",
    )


def _line(number: int, line: str, diagnostics: Sequence[Diagnostic]) -> str:
    cut = line[:_LONGEST]
    shown = _shown(cut)
    if diagnostics and diagnostics[0].column >= 1:
        # The place of the first one is marked.
        first = diagnostics[0].column - 1
        last = max(diagnostics[0].last_column, first + 1)
        shown = f"{_shown(cut[:first])}<mark>{_shown(cut[first:last])}</mark>{_shown(cut[last:])}"
    rest = "\N{HORIZONTAL ELLIPSIS}" if len(line) > _LONGEST else ""
    told = "".join(_told(item) for item in diagnostics)
    kind = f" {diagnostics[0].severity}" if diagnostics else ""
    return (
        f'<div class="line{kind}" id="line-{number}"><span class="no">{number}</span>'
        f"<code>{shown or ' '}{rest}</code></div>{told}"
    )


def _shown(words: str) -> str:
    return text(harmless(words, keep_tabs=True).expandtabs(8))


def _told(item: Diagnostic) -> str:
    """A diagnostic: its severity in words, what is wrong, and how to fix it."""
    label = f' <span class="label">{text(item.label)}</span>' if item.label else ""
    hint = f'<br><span class="help">help: {text(item.help)}</span>' if item.help else ""
    other = ""
    if item.other is not None:
        other = f' <a href="#line-{item.other.line}">see line {item.other.line}</a>'
    return (
        f'<div class="told {item.severity}"><b>{item.severity}[{text(item.code)}]</b>: '
        f"{text(item.message)}{label}{other}{hint}</div>"
    )


def origin_part(raw: bytes, name: str, analysis: Result | None, is_written: bool) -> str:
    """Versions, settings, the deck's checksum, and the command.

    Args:
        raw: The deck.
        name: The deck's file name, without its folders.
        analysis: The result, if there is one.
        is_written: Whether the deck was written by Flexact, for a model made in Python.
    """
    rows = [
        row("Flexact", VERSION),
        row("Python", platform.python_version()),
        row("NumPy", np.__version__),
        row("three.js, in this page", three_version()),
    ]
    if analysis is not None:
        asked = analysis.asked
        rows.append(row("method", f"{text(analysis.method)} (asked for: {text(asked.method)})"))
        given = "from the data" if asked.tolerance is None else "as asked for"
        rows.append(row("tolerance", f"{analysis.tolerance!r} ({given})"))
    digest = hashlib.sha256(raw).hexdigest()
    rows.append(row("SHA-256 of the deck", f"<code>{digest}</code>"))
    if name and not is_written:
        rows.append(row("made again by", f"<code>{text(_command(name, analysis))}</code>"))
    return section("origin", "Made with", table(("", ""), rows, kind="origin"))


def _command(name: str, analysis: Result | None) -> str:
    stem = name.rpartition(".")[0] or name
    words = ["flexact", "report", name, "-o", f"{stem}.html"]
    if analysis is not None:
        asked = analysis.asked
        if asked.method != "auto":
            words += ["--method", asked.method]
        if asked.tolerance is not None:
            words += ["--tolerance", repr(asked.tolerance)]
        if asked.accuracy is not None:
            # Without a unit it would be in that of the deck.
            sizes = zip(asked.accuracy, ("m", "rad"), strict=True)
            plain = str(asked.accuracy)
            typed = ",".join(f"{part!r}{unit}" for part, unit in sizes if part is not None)
            words += ["--accuracy", typed if analysis.given.units.power else plain]
    return shlex.join(words)


#: How many tables are open at first.
_OPEN = 2


def motions_part(analysis: Result, drawn: int) -> str:
    """The motions, a row for all that moves as one; the first `drawn` are in the drawing.

    Folds and what is inside of sheets and wires are folded away where anything else moves.
    """
    parts: dict[bool, list[str]] = {False: [], True: []}
    told = list(zip(analysis.motions[:MOST_MODES], analysis.are_between_ends, strict=False))
    is_apart = not all(is_between for _, is_between in told)
    inner = 0
    for k, (motion, is_between) in enumerate(told):
        rows = [_row(pieces) for pieces in motion_in_parts(motion, MOST_PARTS)[:MOST_PARTS]]
        content = table(("what moves", "how"), rows, kind="parts")
        shown_by = f"movement {k}" if k < drawn else ""
        mine = parts[is_between and is_apart]
        mine.append(_mode(f"Motion {k + 1}", shown_by, content, len(mine)))
        inner += is_between and is_apart and motion.is_internal
    folds = len(parts[True]) - inner
    words = [counted(folds, "fold", "", "s")] * (folds > 0)
    words += [counted(inner, "inner motion", "", "s")] * (inner > 0)
    away = folded(f"+ {' and '.join(words)}", *parts[True])
    return _modes("Motion", "s", analysis.under_constrained, [*parts[False], away])


def stresses_part(analysis: Result) -> str:
    """The self-stresses: which parts fight, and a row for each part that carries something."""
    parts = []
    for k, stress in enumerate(analysis.self_stresses[:MOST_MODES]):
        conflict = conflict_in_words(stress)
        start = f"<p>{flowing(Line(conflict))}.</p>" if conflict else ""
        rows = [_row(pieces) for pieces in stress_in_parts(stress, MOST_PARTS)[:MOST_PARTS]]
        content = start + table(("what is stressed", "with"), rows, kind="parts")
        parts.append(_mode(f"Self-stress {k + 1}", f"stress {k}", content, k))
    return _modes("Self-stress", "es", analysis.over_constrained, parts)


def _modes(what: str, ending: str, count: int, parts: list[str]) -> str:
    """Some of so many motions or self-stresses, and what is to be known of all."""
    if not count:
        return ""
    title = f"{what}{ending}"
    note = "Relative values: only their ratios matter."
    if count > 1:
        note += (
            f" These {title.lower()} are one basis of many: any combination of them is also one."
        )
    more, rest = "", count - MOST_MODES
    if rest > 0:
        words = f"and {rest} more {what.lower()}{ending * (rest > 1)}."
        more = f'<p class="note">\N{HORIZONTAL ELLIPSIS} {words}</p>'
    # Such as "stresses".
    name = title.lower().rpartition("-")[2]
    return section(name, title, f'<p class="note">{note}</p>', *parts, more)


def _mode(title: str, shown_by: str, content: str, place: int) -> str:
    show = (
        f'<button type="button" class="show" data-show="{shown_by}">Show '
        f'<span class="unseen">{title}</span></button>'
        if shown_by
        else ""
    )
    opened = " open" if place < _OPEN else ""
    return (
        f'<div class="mode">{show}<details{opened}><summary>{title}</summary>{content}'
        "</details></div>"
    )


def _row(pieces: Pieces) -> str:
    """Names, and in a cell the words behind them."""
    *named, words = pieces if isinstance(pieces[-1], str) else (*pieces, "")
    first = next((piece for piece in named if isinstance(piece, Named)), None)
    about = f' data-{first.kind}="{first.number}"' if first is not None else ""
    return row(linked(tuple(named)), text(str(words).lstrip(": ")), about=about)


#: Class of the page and sign, told apart without colours.
KINDS = {
    Verdict.EXACT: ("exact", "\N{CHECK MARK}"),
    Verdict.UNDER: ("under", "\N{LEFT RIGHT ARROW}"),
    Verdict.OVER: ("over", "\N{RIGHTWARDS ARROW}\N{LEFTWARDS ARROW}"),
    Verdict.BOTH: ("both", "\N{LEFT RIGHT ARROW}!"),
}
MARGINAL = ("marginal", "\N{ALMOST EQUAL TO}")
BROKEN = ("broken", "\N{MULTIPLICATION X}")


def kind_of(analysis: Result) -> tuple[str, str]:
    """Class of the page and sign of a result."""
    if analysis.verdict is Verdict.EXACT and analysis.has_small_margin:
        return MARGINAL
    return KINDS[analysis.verdict]


#: How many steps of the advice are told.
STEPS = 3


class Advised(NamedTuple):
    """What can be done about a result.

    Attributes:
        steps: The first steps of its advice; None where it takes long to find them.
        about_motions: Single changes that leave fewer motions.
        about_stresses: Single changes that leave fewer self-stresses.
    """

    steps: tuple[Step, ...] | None = ()
    about_motions: tuple[Line, ...] = ()
    about_stresses: tuple[Line, ...] = ()


def advised(analysis: Result) -> Advised:
    """What can be done; nothing where nothing need be."""
    singles = lines_on_motions(analysis), lines_on_self_stresses(analysis)
    return Advised(first_steps(analysis, STEPS), *singles)


#: Of more bodies what holds them is folded away.
_MOST_BODIES = 4


def held_part(analysis: Result) -> str:
    """A line on each body: how often its motions are held; equal ones are said once.

    Each name lights up the body and what holds it.
    """
    lines = held_lines(analysis, None, partial(body_named, analysis))
    rows = [f"<li>{flowing(line)}</li>" for line in lines]
    shown = _MOST_BODIES if len(rows) > _MOST_BODIES + 1 else len(rows)
    first, rest = ("".join(each) for each in (rows[:shown], rows[shown:]))
    away = folded(f"+ {len(rows) - shown} more", f"<ul>{rest}</ul>") if rest else ""
    return f'<div class="held"><ul>{first}</ul>{away}</div>' if rows else ""


def head(kind: str, sign: str, verdict: VerdictInWords, about: str, summary: str = "") -> str:
    """The first lines of the page; all but the sign and the verdict are HTML."""
    return (
        f'<header class="verdict {kind}">{_headline("h1", sign, verdict)}{summary}'
        f'<p class="about">{about}</p>{SWITCH}</header>'
    )


#: From light to dark and back.
SWITCH = '<button type="button" id="theme" aria-pressed="false" hidden>Dark</button>'


def _headline(level: str, sign: str, verdict: VerdictInWords) -> str:
    return (
        f'<{level} class="headline"><span class="sign" aria-hidden="true">{sign}</span>'
        f'<span><b class="says">{text(verdict.start)}:</b> {text(verdict.reason)}</span></{level}>'
    )


def verdict(analysis: Result, name: str, advice: Advised, held: str) -> str:
    """The head of the page of a result: what is wrong, what helps, by how much, how sure."""
    kind, sign, margin, about = _judged(analysis)
    if name:
        about = f'<span class="name">{text(name)}</span> {about}'
    line = do_this(analysis, advice.steps)
    todo = ""
    if line is not None:
        todo = f'<p class="todo">{flowing(line).replace("Do this", "<b>Do this</b>", 1)}</p>'
    rest = ""
    if analysis.given.loads is not None:
        told = attempted("", lambda: str(feature("at_rest_in_words")(analysis)), "", None)
        rest = f'<p class="rest">{text(told)}</p>' if told else ""
    return head(kind, sign, verdict_in_words(analysis), about, held + todo + rest + margin)


def verdict_of_side(analysis: Result, which: str) -> str:
    """The head of one of several results of a page; `which` is HTML."""
    kind, sign, margin, about = _judged(analysis)
    return (
        f'<header class="verdict {kind}"><p class="which">{which}</p>'
        f"{_headline('h2', sign, verdict_in_words(analysis))}{margin}"
        f'<p class="about">{about}</p></header>'
    )


def result_side(
    analysis: Result, data: dict[str, Any], mark: str, header: str, still: bytes | None = None
) -> str:
    """One of several drawings of a page, with its header and what is shown of it.

    Args:
        analysis: The result.
        data: Of its drawing.
        mark: What tells its names from those of the others.
        header: HTML.
        still: A picture as PNG, for browsers without scripts or WebGL.
    """
    words = str(verdict_in_words(analysis))
    return (
        f'<div class="viewer half {mark}side">{header}'
        f"{drawing_part(data, still, words, left_out=left_out(analysis, data), mark=mark)}"
        f"{choices_part(data, stuck_in(analysis), mark=mark)}</div>"
    )


def _judged(analysis: Result) -> tuple[str, str, str, str]:
    """Class and sign of a verdict, how far another one is, and what else is to be known."""
    kind, sign = kind_of(analysis)
    if analysis.certainty is not Certainty.CERTAIN:
        sign += "?"
    about = (
        f'<span class="fact">D(c) {analysis.rows} \N{MULTIPLICATION SIGN} {analysis.columns}, '
        f"rank {analysis.rank}</span> {_certainty(analysis)} "
        f'<span class="fact">{text(declared_in_words(analysis))}</span>'
    )
    return kind, sign, f'<p class="margin">{flowing(margin_line(analysis))}</p>', about


def _certainty(analysis: Result) -> str:
    """How sure the rank is: of the arithmetic, not of the machine."""
    if analysis.certainty is Certainty.CERTAIN:
        is_proven = analysis.proof is not None and analysis.proof.rank == analysis.rank
        how = "proven" if is_proven else "numerically certain"
        return f'<span class="sure">rank {how}</span>'
    counts = (analysis.under_constrained, analysis.over_constrained)
    under, over = counts if analysis.nearly is None else analysis.nearly[:2]
    other = (
        f": there may be {under} motion{'s' * (under != 1)} and "
        f"{over} self-stress{'es' * (over != 1)}"
    ) * ((under, over) != counts)
    return f'<a class="sure doubt" href="#decision">rank doubtful{other}</a>'


def advice_part(advice: Advised) -> str:
    """What can be done: the first steps of the advice; single changes are folded away."""
    steps = "".join(
        # What it then is stands behind what is done.
        f'<li data-step="{text(plain(step.pieces))}">{linked(step.pieces)}'
        f"{text(step.statement.removeprefix(plain(step.pieces)))}</li>"
        for step in advice.steps or ()
    )
    both = advice.about_motions, advice.about_stresses
    singles = "".join(
        (f"<h3>{kind}</h3>" if all(both) else "") + paragraphs(sentences)
        for kind, sentences in zip(("About motions", "About self-stresses"), both, strict=True)
        if sentences
    )
    if steps:
        singles = folded("Single changes", singles)
    return section("remedies", "What can be done", f"<ol>{steps}</ol>" * bool(steps), singles)


def decision_part(analysis: Result) -> str:
    """Counts by class, rank, gap, certainty and condition."""
    heads = ("", *analysis.counts.coordinates._fields)
    rows = (row(name, *map(str, part)) for name, part in analysis.counts._asdict().items())
    counts = table(heads, rows, kind="counts")
    return section("decision", "Counts and decision", counts, paragraphs(decision(analysis)))


_SCROLLS = "Until you click on the drawing, the wheel scrolls past it."


class Content(NamedTuple):
    """What stands in the body of a page.

    Attributes:
        title: Of the page, as text.
        body: HTML, with the data of its drawing.
    """

    title: str
    body: str


def content_of(
    analysis: Result,
    still: bytes | None = None,
    spaces: Spaces | None = None,
    *,
    has_origin: bool = True,
    is_short: bool = False,
    room: int | None = None,
    moving: int = MOST_MODES,
    follows: int = MOST_COORDINATES,
    missing: Sequence[str] = (),
    before: tuple[Result, str] | None = None,
    misaligned: dict[str, Any] | None = None,
    scenery: Scenery | None = None,
) -> Content:
    """What the page of a result holds; what of it cannot be made is left out, and told.

    Args:
        analysis: The result.
        still: A picture of it, as PNG, for browsers without scripts or WebGL.
        spaces: The freedom space and the constraint space of a body, to be switched on.
        has_origin: Whether it is told of what it was made, and how it is made again.
        is_short: Whether tables and deck are folded away, as among other things.
        room: Bytes that a movement takes, if it can.
        follows: Motions of models with more coordinates are drawn along their velocities.
        moving: Of declared degrees of freedom so many at most move in the drawing.
        missing: Sentences on what is left out already.
        before: The result of the mechanism before a step of the advice was done, which is drawn
            beside it, and the step in words.
        misaligned: What one misalignment does, to be switched on by a slider: its "words" and
            "unit"; the "name" of what falls, in "hertz" or in parts; its "measure" at "values"
            [m, rad]; "elements" and the "peaks" of their stress [Pa] at an error of 1, and
            their "strengths" [Pa] where all have one.
        scenery: The solids that the mechanism was read from.
    """
    require_kind(analysis, Result, "a page is that of a result")
    told = list(missing)

    def made(what: str, make: Callable[[], str]) -> str:
        return attempted(what, make, "", told)

    shown = (analysis,) if before is None else (analysis, before[0])

    def drawn() -> list[dict[str, Any]]:
        solids = () if scenery is None else scenery.meshes
        around = [mesh.triangles.reshape(-1, 3) for mesh in solids]
        frames = frames_of(*(drawing_of(each.given) for each in shown), around=around)
        every = zip(shown, frames, (spaces, None), strict=False)
        size = FEW_SHAPES if is_short else room or MOST_SHAPES
        datas = [
            viewer_data(each, frame, space, size, moving, follows) for each, frame, space in every
        ]
        for each, frame, data in zip(shown, frames, datas, strict=True):
            if scenery is not None:
                place_scenery(data, each.parts, frame, scenery)
        return datas

    datas = attempted("The drawing", drawn, [], told)
    data = datas[0] if datas else None
    if data is not None and misaligned is not None:
        data["misaligned"] = misaligned
    every, words = warnings_of(analysis), str(verdict_in_words(analysis))
    name = file_name(analysis.name)
    source = analysis.given.source
    raw, is_written = (
        (as_bytes(deck_of(analysis.given)), True) if source is None else (source.text, False)
    )
    # What stands before the verdict is not said again.
    before_it = () if scenery is None else scenery.doubts
    warnings = [item for item in every if item.line == 0 and item.message not in before_it]
    in_deck = [item for item in every if item.line > 0]
    advice = attempted("What can be done", lambda: advised(analysis), Advised(), told)
    held = made("How often each body is held", lambda: held_part(analysis))
    moving = sum(each["kind"] == "motion" for each in ([] if data is None else data["movements"]))
    ways = advice_part(advice)
    tables: tuple[str, ...] = (
        section("notes", "Notes", *map(_note, warnings)),
        made("The table of motions", lambda: motions_part(analysis, moving)),
        made("The table of self-stresses", lambda: stresses_part(analysis)),
        decision_part(analysis),
    )
    origin: tuple[str, ...] = (
        deck_part(raw, in_deck, is_written),
        origin_part(raw, name, analysis, is_written) if has_origin else "",
    )
    if is_short:
        tables, ways = (folded("What can be done, tables, decision", ways, *tables),), ""
        origin = (folded("Deck and versions", *origin),)
    drawing = "".join(f'<p class="note">{text(each)}</p>' for each in told)
    choices = ""
    if data is not None:
        below = toolbar(data) + keys(data) + f'<p class="keys">{_SCROLLS}</p>' * is_short
        others = left_out(analysis, data)
        drawing = drawing_part(data, still, words, below, " ".join([*told, others]).strip())
        choices = choices_part(data, stuck_in(analysis), layers(data))
    kind = "viewer"
    if before is not None and len(datas) > 1:
        kind, choices = "pair tried", ""
        drawing = _beside(analysis, datas, before, " ".join(told))
    body = (
        "" if scenery is None else preface(scenery),
        verdict(analysis, name, advice, held),
        f'<main class="{kind}">',
        drawing,
        '<div class="side">',
        ways,
        choices,
        *tables,
        "</div>",
        '<div class="below">',
        *origin,
        "</div></main>",
    )
    title = f"{name or 'model'}: {verdict_word(analysis)}"
    return Content(title, "\n".join(body))


def _beside(
    analysis: Result, datas: Sequence[dict[str, Any]], before: tuple[Result, str], told: str
) -> str:
    """The drawing of a mechanism on the right of that before a step, with one set of controls."""

    def headed(result: Result, words: str) -> str:
        kind = kind_of(result)[0]
        return f'<header class="verdict {kind}"><p class="which">{words}</p></header>'

    heads = (
        headed(analysis, f"<span><b>Tried:</b> {text(before[1])}</span>"),
        headed(
            before[0],
            f'<b>Before: <span class="says">{text(verdict_in_short(before[0]))}</span></b>',
        ),
    )
    note = f'<p class="note">{text(told)}</p>' if told else ""
    return (
        '<section class="shared" aria-label="Both drawings" hidden>'
        f"{toolbar(*datas)}</section>{note}"
        f"{result_side(analysis, datas[0], 'after-', heads[0])}"
        f"{result_side(before[0], datas[1], 'before-', heads[1])}"
        '<section class="shared" aria-label="In both drawings" hidden>'
        f"{layers(*datas)}{keys(datas[0])}</section>"
    )


def broken_content(
    error: Exception, name: str, *, what: str = "Deck", verb: str = "analysed"
) -> Content:
    """What the page of a deck holds that cannot be analysed: why.

    Args:
        error: Why: with diagnostics, or a sentence.
        name: The deck's file name.
        what: What it is, where it is no deck.
        verb: What cannot be done with it.
    """
    name = file_name(name)
    words = reason_in_words(error)
    raw, told = b"", ""
    if isinstance(error, ProblemsError):
        raw = error.source.text if error.source is not None else b""
        told = deck_part(raw, error.diagnostics, what=what)
    body = (
        head(
            *BROKEN,
            VerdictInWords(f"Cannot be {verb}", words),
            f'<span class="name">{text(name)}</span>',
        ),
        '<main class="plain">',
        told,
        origin_part(raw, name, None, False) if raw and what == "Deck" else "",
        "</main>",
    )
    return Content(f"{name}: cannot be {verb}", "\n".join(body))


def reason_in_words(error: Exception) -> str:
    """Why a deck cannot be analysed, in a few words."""
    if isinstance(error, ProblemsError):
        count = error.problems.errors
        return f"{count} error{'s' * (count != 1)}"
    return why(error)


def _note(item: Diagnostic) -> str:
    hint = f" {text(item.help)}" if item.help else ""
    return f"<p><b>{item.severity}</b>: {text(item.message)}{'.' if hint else ''}{hint}</p>"


def page(
    analysis: Result,
    still: bytes | None = None,
    spaces: Spaces | None = None,
    missing: Sequence[str] = (),
    misaligned: dict[str, Any] | None = None,
) -> str:
    """The page of a result; arguments as those of `content_of`."""
    content = content_of(analysis, still, spaces, missing=missing, misaligned=misaligned)
    return filled(content.title, content.body, SCRIPTS)


def broken_page(error: Exception, name: str) -> str:
    """The page of a deck that cannot be analysed; it says why."""
    content = broken_content(error, name)
    return filled(content.title, content.body, PLAIN_SCRIPTS)
