# SPDX-License-Identifier: BSD-3-Clause
"""Two runs of many decks: what changed in each, with pictures side by side."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from html import escape
from typing import Any
from urllib.parse import quote

from ...advice.describe import verdict_in_words
from ...advice.spaces.spaces import Spaces
from ...analysis.differences import Change, Gravity, Side
from ...analysis.naming import Line, Pieces
from ...analysis.result import Result
from ...analysis.verdict import Verdict
from ...util.errors import require_kind
from ...util.text import file_name
from ..drawing import drawing_of
from .assets import SCRIPTS, breakable, filled, image, linked, paragraphs, section, text
from .content import BROKEN, KINDS, MARGINAL, SWITCH, verdict_of_side
from .controls import choices_part, finder, keys, layers, toolbar
from .drawing import drawing_part, frames_of
from .index import SCRIPTS as INDEX_SCRIPTS
from .viewer import left_out, stuck_in, viewer_data


def before_and_after(
    before: Result,
    after: Result,
    changed: Pieces,
    told: Iterable[Line] = (),
    stills: tuple[bytes | None, bytes | None] = (None, None),
    first: tuple[tuple[str, int], ...] = (),
    spaces: tuple[Spaces | None, Spaces | None] = (None, None),
    runs: tuple[str, str] | None = None,
    changes: str = "",
) -> str:
    """The page of a result beside that of a changed mechanism.

    Both have one scale and one camera: turning one turns the other.

    Args:
        before: The result of the mechanism as it is.
        after: The result of the changed one.
        changed: What was changed, in words that may name elements and nodes of the changed one.
        told: Further advice, which stands below; it may name elements and nodes of the first.
        stills: Pictures of both as PNG, for browsers without scripts or WebGL.
        first: What of the mechanism as it is is shown at first, such as ("motion", 2) and
            ("self-stress", 1); else what its verdict says, both where it is both.
        spaces: Freedom and constraint spaces of a body of each, to be switched on.
        runs: What both are called, where they are two decks.
        changes: What changed, as HTML.
    """
    require_kind(before, Result, "a page is that of a result")
    require_kind(after, Result, "a page is that of a result")
    results = (before, after)
    frames = frames_of(*(drawing_of(each.given) for each in results))
    one, two = (viewer_data(*each) for each in zip(results, frames, spaces, strict=True))
    if first:
        kinds = {"motion": "movement", "self-stress": "stress"}
        one["first"] = [(kinds[kind], str(number - 1)) for kind, number in first]
    elif one["first"] == [("movement", "0")] and one["stresses"]:
        one["first"] = [*one["first"], ("stress", "0")]
    name = file_name(before.name)
    title = f"{name or 'model'}: before and after"
    heads = "<b>As it is</b>", f"<b>Changed:</b> {linked(changed)}"
    if runs is not None:
        title = " \N{RIGHTWARDS ARROW} ".join(runs)
        heads = f"<b>Before:</b> {breakable(runs[0])}", f"<b>After:</b> {breakable(runs[1])}"
    body = (
        f'<header class="verdict top"><h1 class="headline">{text(title)}</h1>{SWITCH}</header>',
        '<main class="pair">',
        f'<section class="shared" aria-label="Both drawings" hidden>{toolbar(one, two)}</section>',
        section("changes", "What changed", changes),
        _side(before, one, "before", heads[0], stills[0]),
        _side(after, two, "after", heads[1], stills[1]),
        f'<section class="shared" aria-label="In both drawings" hidden>{layers(one, two)}'
        f"{keys(one)}</section>",
        section("advice", "What can be done", paragraphs(told)),
        "</main>",
    )
    styles = ("style.css", "index.css", "compare.css") if changes else ("style.css",)
    return filled(title, "\n".join(body), SCRIPTS, styles)


def _side(
    analysis: Result, data: dict[str, Any], mark: str, which: str, still: bytes | None
) -> str:
    words = str(verdict_in_words(analysis))
    mark += "-"
    return (
        f'<div class="viewer half">{verdict_of_side(analysis, which)}'
        f"{drawing_part(data, still, words, left_out=left_out(analysis, data), mark=mark)}"
        f"{choices_part(data, stuck_in(analysis), mark=mark)}</div>"
    )


STYLES = ("style.css", "index.css", "compare.css")
_ORDERS = (
    ("place", "what changed, the gravest first"),
    ("folder", "folder"),
    ("name", "name"),
    ("verdict", "verdict behind, the worst first"),
)
_GRAVITY = ("broken", "both", "over", "under", "marginal", "exact")
#: Statements that are shown.
_MOST_STATEMENTS = 200
_WORDS = {Verdict(verdict).value: sign for verdict, sign in KINDS.items()}
_ARROW = '<span class="to" aria-label="then">\N{RIGHTWARDS ARROW}</span>'


@dataclass(frozen=True)
class Pair:
    """A deck in two runs.

    Attributes:
        name: What it is called.
        before: In the first run, if it is there.
        after: In the second one, if it is there.
        change: What changed, where it is in both.
        pictures: Of both as PNG, if there are any; the second alone where nothing changed.
        page: Path of a page beside this one with both drawings; empty where there is none.
    """

    name: str
    before: Side | None
    after: Side | None
    change: Change | None
    pictures: tuple[bytes | None, bytes | None] = (None, None)
    page: str = ""

    @property
    def kind(self) -> str:
        """Class of the card."""
        if self.change is None:
            return "gone" if self.after is None else "new"
        return "same" if self.change.is_none else "changed"


def compare_page(pairs: Sequence[Pair], runs: tuple[str, str]) -> str:
    """The page of two runs.

    Args:
        pairs: The decks in their order.
        runs: What both runs are called.
    """
    counts = Counter(pair.kind for pair in pairs)
    words = {
        "changed": "changed",
        "same": "as before",
        "gone": f"only in {runs[0]}",
        "new": f"only in {runs[1]}",
    }
    kinds = [(kind, f"{counts[kind]} {words[kind]}") for kind in words if counts[kind]]
    summary = "".join(f'<span class="fact">{text(each)}</span> ' for _, each in kinds)
    title = f"{runs[0]} \N{RIGHTWARDS ARROW} {runs[1]}"

    def gravity(place: int) -> int:
        """A deck that is in one run only changed more than any in both."""
        change = pairs[place].change
        return max(Gravity) + 1 if change is None else int(change.gravity)

    order = sorted(range(len(pairs)), key=lambda place: -gravity(place))
    cards = "".join(_card(number, k, pairs[k], runs) for number, k in enumerate(order))
    body = (
        f'<header class="verdict index"><h1><span><b>{breakable(title)}</b></span></h1>'
        f'<p class="about">{summary}</p>'
        '<button type="button" id="theme" aria-pressed="false" hidden>Dark</button></header>'
        f'<main class="plain">{finder(kinds, _ORDERS)}'
        f'<ul class="cards pairs">{cards}</ul></main>'
    )
    return filled(title, body, INDEX_SCRIPTS, STYLES)


def changes_part(change: Change, *, below_verdicts: bool = False) -> str:
    """What changed as HTML: sentences, what came and went, and statements of the deck.

    Args:
        change: What changed.
        below_verdicts: Whether both verdicts stand above, so that they need not be said again.
    """
    is_said = below_verdicts and change.gravity is Gravity.VERDICT
    told = "".join(
        f"<li>{text(each[:1].upper() + each[1:])}</li>" for each in change.told[is_said:]
    )
    modes = "".join(
        f'<li class="{kind}"><span class="mark">{word}</span> {text(each)}</li>'
        for kind, word, each in (
            *(("went", "gone", each) for each in change.went),
            *(("came", "new", each) for each in change.came),
        )
    )
    nothing = '<p class="note">Nothing changed.</p>' if change.is_none else ""
    if change.gravity is Gravity.STATEMENTS:
        nothing = '<p class="note">The result is as before.</p>'
    told = f'<ul class="told-changes">{told}{modes}</ul>' if told or modes else nothing
    return told + _statements(change)


def _statements(change: Change) -> str:
    many = len(change.statements)
    if not many:
        return ""
    lines = "".join(
        f'<span class="{"came" if each.added else "went"}">{"+" if each.added else "-"}'
        f'<span class="no">{each.line}</span> {text(each.written)}\n</span>'
        for each in change.statements[:_MOST_STATEMENTS]
    )
    more = many - _MOST_STATEMENTS
    rest = f'<p class="note">and {more} more</p>' if more > 0 else ""
    words = f"{many} statement{'s' * (many != 1)} of the deck differ{'s' * (many == 1)}"
    return (
        f'<details class="statements"><summary>{words}</summary>'
        f'<pre class="excerpt"><code>{lines}</code></pre>{rest}</details>'
    )


def _card(number: int, folder: int, pair: Pair, runs: tuple[str, str]) -> str:
    last = pair.after or pair.before
    assert last is not None
    behind = _kind(last)[0]
    data = {
        "kind": pair.kind,
        "place": number,
        "folder": folder,
        "name": pair.name.rpartition("/")[2].lower(),
        "verdict": _GRAVITY.index(behind),
    }
    told = "".join(f' data-{name}="{escape(str(value))}"' for name, value in data.items())
    name = breakable(pair.name)
    if pair.page:
        name = f'<a href="{escape(quote(pair.page))}">{name}</a>'
    captions = ("before", "after") if pair.kind == "changed" else ("", "")
    pictures = "".join(
        f"<figure>{image(picture, '', late=True)}<figcaption>{words}</figcaption></figure>"
        for picture, words in zip(pair.pictures, captions, strict=True)
        if picture is not None
    )
    pictures = f'<div class="two">{pictures}</div>' if pictures else ""
    if pair.change is None:
        changes = f'<p class="note">Only in {text(runs[pair.after is not None])}.</p>'
    else:
        changes = changes_part(pair.change, below_verdicts=True)
    return (
        f'<li class="card pair {pair.kind}"{told}>{pictures}<div class="said">'
        f'<p class="name">{name}</p>{_verdicts(pair)}{changes}</div></li>\n'
    )


def _verdicts(pair: Pair) -> str:
    if pair.kind in ("same", "gone", "new") or pair.before is None:
        side = pair.after or pair.before
        return f'<p class="verdicts">{_verdict(side)}</p>' if side is not None else ""
    if pair.after is not None and pair.before.words == pair.after.words:
        return f'<p class="verdicts">{_verdict(pair.after)}</p>'
    return f'<p class="verdicts">{_verdict(pair.before)} {_ARROW} {_verdict(pair.after)}</p>'


def _verdict(side: Side | None) -> str:
    if side is None:
        return ""
    kind, sign = _kind(side)
    doubt = "?" * (side.certainty == "doubtful")
    words = side.words[:1].upper() + side.words[1:]
    return (
        f'<span class="one {kind}"><span class="sign" aria-hidden="true">{sign}{doubt}</span>'
        f"{text(words)}</span>"
    )


def _kind(side: Side) -> tuple[str, str]:
    """Class and sign of a side."""
    if side.is_broken:
        return BROKEN
    return _WORDS.get(side.verdict, MARGINAL)
