# SPDX-License-Identifier: BSD-3-Clause
"""Cards to be found and sorted: the index of several pages, and two runs of many decks.

A card of the index has a picture and the verdict; one of two runs what changed, side by side.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from html import escape
from typing import Any
from urllib.parse import quote

from ...advice.describe import verdict_in_words
from ...analysis.differences import Change, Gravity, Side
from ...analysis.result import Result
from ...analysis.verdict import Verdict
from ...analysis.verdict_words import certainty_word, margin_in_short, verdict_word
from ...deck.diagnostics import decode
from ...deck.rendering import ProblemsError
from ...util.text import file_name, harmless
from .assets import PLAIN_SCRIPTS, breakable, filled, image, text
from .content import BROKEN, KINDS, MARGINAL, SWITCH, kind_of, reason_in_words
from .controls import finder

#: What is counted of decks without a verdict.
_BROKEN = "cannot be analysed"
#: Characters of a line of a deck, and of it before what is wrong.
_LINE, _BEFORE = 90, 30


@dataclass(frozen=True)
class Entry:
    """One deck of an index.

    Attributes:
        name: What it is called.
        page: Path of its page beside the index; empty where there is none.
        kind: Class of its card, and sign.
        verdict: Its verdict as it is counted, or that it cannot be analysed.
        words: The verdict, or why there is none, in a few words.
        margin: How far another verdict is, in a few words.
        picture: A small picture as PNG, if there is one.
        counts: Motions, self-stresses, declared degrees of freedom, elements; none without a
            verdict.
        margin_length: The margin [m], for sorting; None where it is large.
        certainty: How sure the rank is; empty without a verdict.
        place: Where the first error is, as `file:line:column`.
        error: The first error.
        line: The line of the deck that it is in, or the part round it.
        marked: First and last character of that line that are wrong, from 1.
    """

    name: str
    page: str
    kind: tuple[str, str]
    verdict: str
    words: str
    margin: str = ""
    picture: bytes | None = None
    counts: tuple[int, ...] = ()
    margin_length: float | None = None
    certainty: str = ""
    place: str = ""
    error: str = ""
    line: str = ""
    marked: tuple[int, int] = (0, 0)


def entry_of(result: Result, name: str, page: str, picture: bytes | None = None) -> Entry:
    """The entry of a result, whose page is at a path beside the index."""
    return Entry(
        name,
        page,
        kind_of(result),
        verdict_word(result),
        verdict_in_words(result).start,
        margin_in_short(result),
        picture,
        (
            result.under_constrained,
            result.over_constrained,
            result.degrees_of_freedom,
            int(result.given.arrays.element_number.size),
        ),
        result.margin.length,
        certainty_word(result),
    )


def broken_entry(error: Exception, name: str, page: str, file: str = "") -> Entry:
    """The entry of a deck that cannot be analysed: its first error, and where it is."""
    words = f"Cannot be analysed: {reason_in_words(error)}"
    told: dict[str, Any] = {}
    if isinstance(error, ProblemsError):
        told = _first_error(error, file_name(file) or name)
    return Entry(name, page, BROKEN, _BROKEN, words, **told)


def unread_entry(name: str) -> Entry:
    """The entry of a deck that could not be read."""
    return Entry(name, "", BROKEN, _BROKEN, "Cannot be read")


def _first_error(error: ProblemsError, file: str) -> dict[str, Any]:
    first = next((item for item in error.diagnostics if item.is_error), None)
    if first is None:
        return {}
    if not first.line:
        return {"error": harmless(first.message)}
    told = {"place": f"{file}:{first.line}:{first.column}", "error": harmless(first.message)}
    if error.source is None:
        return told
    whole = harmless(decode(error.source.line(first.line)), keep_tabs=True)
    start = max(0, min(first.column - 1 - _BEFORE, len(whole) - _LINE))
    ends = (first.column - start, max(first.last_column, first.column) - start)
    return {**told, "line": whole[start : start + _LINE], "marked": ends}


#: Where the cards go; no text of a page holds a NUL.
_CARDS = "\0"
SCRIPTS = ("finder.js", *PLAIN_SCRIPTS)
STYLES = ("style.css", "index.css")

#: What the cards are sorted by: the name of the datum, and what it is called.
_ORDERS = (
    ("place", "folder"),
    ("name", "name"),
    ("verdict", "verdict, the worst first"),
    ("margin", "margin, the smallest first"),
    ("over", "self-stresses, the most first"),
    ("under", "motions, the most first"),
    ("size", "elements, the most first"),
)
_BETWEEN = " \N{MIDDLE DOT} "
#: The worst first.
_GRAVITY = ("broken", "both", "over", "under", "marginal", "exact")


def index_page(entries: Collection[Entry]) -> str:
    """The index as a page of its own, in the order of the entries."""
    return "".join(index_pieces(entries))


def index_pieces(entries: Collection[Entry]) -> Iterator[str]:
    """The index in pieces, so that its pictures need not be in memory together.

    Args:
        entries: They are gone through twice.
    """
    total = len(entries)
    counts = Counter((entry.kind[0], entry.verdict) for entry in entries)
    many = sorted(counts.items(), key=lambda each: (-each[1], _GRAVITY.index(each[0][0])))
    kinds = [(kind, f"{count} {word}") for (kind, word), count in many]
    page = _page(f"{total} deck{'s' * (total != 1)}", kinds, _ORDERS, _CARDS, "", STYLES)
    before, behind = page.split(_CARDS)
    yield before
    for number, entry in enumerate(entries):
        yield _card(number, entry)
    yield behind


def _page(
    title: str,
    kinds: Sequence[tuple[str, str]],
    orders: tuple[tuple[str, str], ...],
    cards: str,
    more: str,
    styles: tuple[str, ...],
) -> str:
    """A page of cards of some kinds, to be found and sorted; `more` is their class besides."""
    summary = "".join(f'<span class="fact">{text(words)}</span> ' for _, words in kinds)
    body = (
        f'<header class="verdict index"><h1><span><b>{breakable(title)}</b></span></h1>'
        f'<p class="about">{summary}</p>{SWITCH}</header>'
        f'<main class="plain">{finder(kinds, orders)}<ul class="cards{more}">{cards}</ul></main>'
    )
    return filled(title, body, SCRIPTS, styles)


def _name(name: str, page: str) -> str:
    """What a card is called, with the way to its page, if it has one."""
    told = breakable(name)
    if page:
        told = f'<a href="{escape(quote(page))}">{told}</a>'
    return f'<p class="name">{told}</p>'


def data_of(data: dict[str, Any]) -> str:
    """What a card is chosen and sorted by: larger numbers come later."""
    return "".join(f' data-{name}="{text(str(value))}"' for name, value in data.items())


def with_way_back(page: str, place: str) -> str:
    """A page with a link to the index, from a path beside it."""
    way = "../" * place.count("/")
    link = f'<nav class="back"><a href="{way}index.html">All decks</a></nav>'
    return page.replace("<body>\n", f"<body>\n{link}\n", 1)


def _card(number: int, entry: Entry) -> str:
    kind, sign = entry.kind
    picture = "" if entry.picture is None else image(entry.picture, "", late=True)
    doubt = "?" * (entry.certainty == "doubtful")
    under, over, _, size = entry.counts or (-1, -1, -1, -1)
    margin = entry.margin_length if entry.counts else -1.0
    data = {
        "kind": kind,
        "place": number,
        "name": entry.name.rpartition("/")[2].lower(),
        "verdict": _GRAVITY.index(kind),
        "margin": "Infinity" if margin is None else repr(margin),
        "over": -over,
        "under": -under,
        "size": -size,
    }
    # Words that say so already need not say it again.
    told = entry.margin and not entry.words.endswith(entry.margin)
    parts = (
        _name(entry.name, entry.page),
        f'<p><span class="sign" aria-hidden="true">{sign}{doubt}</span>{text(entry.words)}</p>',
        f'<p class="margin">{text(entry.margin)}</p>' if told else "",
        _counted(entry),
        _error(entry),
    )
    return (
        f'<li class="card {kind}"{data_of(data)}>{picture}'
        f'<div class="said">{"".join(parts)}</div></li>\n'
    )


def _counted(entry: Entry) -> str:
    """Counts, size and certainty in a line."""
    if not entry.counts:
        return ""
    words = (("motion", "s"), ("self-stress", "es"), ("declared freedom", "s"), ("element", "s"))
    told = [
        f"{count} {word}{ending * (count != 1)}"
        for count, (word, ending) in zip(entry.counts, words, strict=True)
    ]
    told += [f"rank {entry.certainty}"] * bool(entry.certainty)
    return f'<p class="counted">{text(_BETWEEN.join(told))}</p>'


def _error(entry: Entry) -> str:
    """The first error with its line, and the line of the deck."""
    if not entry.error:
        return ""
    place = f"<code>{text(entry.place)}</code> " if entry.place else ""
    told = f'<p class="wrong">{place}{text(entry.error)}</p>'
    if not entry.line:
        return told
    first, last = entry.marked
    before, wrong, behind = (
        entry.line[: first - 1],
        entry.line[first - 1 : last],
        entry.line[last:],
    )
    marked = f"{escape(before)}<mark>{escape(wrong)}</mark>{escape(behind)}"
    return f'{told}<pre class="excerpt"><code>{marked}</code></pre>'


#: Statements that are shown.
_MOST_STATEMENTS = 200
_WORDS = {Verdict(verdict).value: sign for verdict, sign in KINDS.items()}
_ARROW = '<span class="to" aria-label="then">\N{RIGHTWARDS ARROW}</span>'
_PAIR_ORDERS = (
    ("place", "what changed, the gravest first"),
    ("folder", "folder"),
    ("name", "name"),
    ("verdict", "verdict behind, the worst first"),
)


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

    def gravity(place: int) -> int:
        """A deck that is in one run only changed more than any in both."""
        change = pairs[place].change
        return max(Gravity) + 1 if change is None else int(change.gravity)

    order = sorted(range(len(pairs)), key=lambda place: -gravity(place))
    cards = "".join(_pair_card(number, k, pairs[k], runs) for number, k in enumerate(order))
    title = f"{runs[0]} \N{RIGHTWARDS ARROW} {runs[1]}"
    return _page(title, kinds, _PAIR_ORDERS, cards, " pairs", (*STYLES, "compare.css"))


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
    many = len(change.statements)
    if not many:
        return told
    lines = "".join(
        f'<span class="{"came" if each.added else "went"}">{"+" if each.added else "-"}'
        f'<span class="no">{each.line}</span> {text(each.written)}\n</span>'
        for each in change.statements[:_MOST_STATEMENTS]
    )
    more = many - _MOST_STATEMENTS
    rest = f'<p class="note">and {more} more</p>' if more > 0 else ""
    words = f"{many} statement{'s' * (many != 1)} of the deck differ{'s' * (many == 1)}"
    return (
        f'{told}<details class="statements"><summary>{words}</summary>'
        f'<pre class="excerpt"><code>{lines}</code></pre>{rest}</details>'
    )


def _pair_card(number: int, folder: int, pair: Pair, runs: tuple[str, str]) -> str:
    last = pair.after or pair.before
    assert last is not None
    data = {
        "kind": pair.kind,
        "place": number,
        "folder": folder,
        "name": pair.name.rpartition("/")[2].lower(),
        "verdict": _GRAVITY.index(_kind(last)[0]),
    }
    captions = ("before", "after") if pair.kind == "changed" else ("", "")
    pictures = "".join(
        f"<figure>{image(picture, '', late=True)}<figcaption>{words}</figcaption></figure>"
        for picture, words in zip(pair.pictures, captions, strict=True)
        if picture is not None
    )
    pictures = f'<div class="two">{pictures}</div>' if pictures else ""
    verdicts = _verdict(last)
    if pair.kind == "changed" and pair.before is not None and pair.before.words != last.words:
        verdicts = f"{_verdict(pair.before)} {_ARROW} {verdicts}"
    verdicts = f'<p class="verdicts">{verdicts}</p>'
    if pair.change is None:
        changes = f'<p class="note">Only in {text(runs[pair.after is not None])}.</p>'
    else:
        changes = changes_part(pair.change, below_verdicts=True)
    return (
        f'<li class="card pair {pair.kind}"{data_of(data)}>{pictures}<div class="said">'
        f"{_name(pair.name, pair.page)}{verdicts}{changes}</div></li>\n"
    )


def _verdict(side: Side) -> str:
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
