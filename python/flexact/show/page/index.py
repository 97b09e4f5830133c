# SPDX-License-Identifier: BSD-3-Clause
"""The index of several pages: a picture and the verdict of each, to be found and sorted."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator
from html import escape
from urllib.parse import quote

from .assets import PLAIN_SCRIPTS, filled
from .entry import Entry
from .finder_part import finder
from .markup import breakable, image, text

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
