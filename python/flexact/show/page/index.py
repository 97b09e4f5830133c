# SPDX-License-Identifier: BSD-3-Clause
"""The index of several pages: a picture and the verdict of each, to be found and sorted."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from html import escape
from typing import Any
from urllib.parse import quote

from ...advice.describe import verdict_in_words
from ...analysis.result import Result
from ...analysis.verdict_words import certainty_word, margin_in_short, verdict_word
from ...deck.diagnostics import decode
from ...deck.rendering import ProblemsError
from ...util.text import file_name, harmless
from .assets import PLAIN_SCRIPTS, breakable, filled, image, text
from .content import BROKEN, kind_of, reason_in_words
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
    title = f"{total} deck{'s' * (total != 1)}"
    counts = Counter((entry.kind[0], entry.verdict) for entry in entries)
    many = sorted(counts.items(), key=lambda each: (-each[1], _GRAVITY.index(each[0][0])))
    kinds = [(kind, f"{count} {word}") for (kind, word), count in many]
    summary = "".join(f'<span class="fact">{text(words)}</span> ' for _, words in kinds)
    body = (
        f'<header class="verdict index"><h1><span><b>{title}</b></span></h1>'
        f'<p class="about">{summary}</p>'
        '<button type="button" id="theme" aria-pressed="false" hidden>Dark</button></header>'
        f'<main class="plain">{finder(kinds, _ORDERS)}<ul class="cards">{_CARDS}</ul></main>'
    )
    before, behind = filled(title, body, SCRIPTS, STYLES).split(_CARDS)
    yield before
    for number, entry in enumerate(entries):
        yield _card(number, entry)
    yield behind


def with_way_back(page: str, place: str) -> str:
    """A page with a link to the index, from a path beside it."""
    way = "../" * place.count("/")
    link = f'<nav class="back"><a href="{way}index.html">All decks</a></nav>'
    return page.replace("<body>\n", f"<body>\n{link}\n", 1)


def _card(number: int, entry: Entry) -> str:
    kind, sign = entry.kind
    picture = "" if entry.picture is None else image(entry.picture, "", late=True)
    name = breakable(entry.name)
    if entry.page:
        name = f'<a href="{escape(quote(entry.page))}">{name}</a>'
    doubt = "?" * (entry.certainty == "doubtful")
    parts = (
        f'<p class="name">{name}</p>',
        f'<p><span class="sign" aria-hidden="true">{sign}{doubt}</span>{text(entry.words)}</p>',
        # Words that say so already need not say it again.
        ""
        if not entry.margin or entry.words.endswith(entry.margin)
        else f'<p class="margin">{text(entry.margin)}</p>',
        _counted(entry),
        _error(entry),
    )
    return (
        f'<li class="card {kind}"{_data(number, entry)}>{picture}'
        f'<div class="said">{"".join(parts)}</div></li>\n'
    )


def _data(number: int, entry: Entry) -> str:
    """What a card is chosen and sorted by: larger numbers come later."""
    under, over, _, size = entry.counts or (-1, -1, -1, -1)
    margin = entry.margin_length
    if not entry.counts:
        margin = -1.0
    data = {
        "kind": entry.kind[0],
        "place": number,
        "name": entry.name.rpartition("/")[2].lower(),
        "verdict": _GRAVITY.index(entry.kind[0]),
        "margin": "Infinity" if margin is None else repr(margin),
        "over": -over,
        "under": -under,
        "size": -size,
    }
    return "".join(f' data-{name}="{text(str(value))}"' for name, value in data.items())


def _counted(entry: Entry) -> str:
    """Counts, size and certainty in a line."""
    if not entry.counts:
        return ""
    words = (("motion", "s"), ("self-stress", "es"), ("declared freedom", "s"), ("element", "s"))
    told = [
        f"{count} {word}{ending * (count != 1)}"
        for count, (word, ending) in zip(entry.counts, words, strict=True)
    ]
    if entry.certainty:
        told.append(f"rank {entry.certainty}")
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
