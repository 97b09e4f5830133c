# SPDX-License-Identifier: BSD-3-Clause
"""The index of several pages: a picture and the verdict of each."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from html import escape
from urllib.parse import quote

from .assets import PLAIN_SCRIPTS, filled
from .markup import image, text

#: Where the cards go; no text of a page holds a NUL.
_CARDS = "\0"


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
    """

    name: str
    page: str
    kind: tuple[str, str]
    verdict: str
    words: str
    margin: str = ""
    picture: bytes | None = None


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
    counts = Counter(entry.verdict for entry in entries)
    summary = "".join(
        f'<span class="fact">{count} {text(word)}</span> ' for word, count in counts.most_common()
    )
    body = (
        f'<header class="verdict index"><h1><span><b>{title}</b></span></h1>'
        f'<p class="about">{summary}</p>'
        '<button type="button" id="theme" aria-pressed="false" hidden>Dark</button></header>'
        f'<main class="plain"><ul class="cards">{_CARDS}</ul></main>'
    )
    before, behind = filled(title, body, PLAIN_SCRIPTS).split(_CARDS)
    yield before
    yield from map(_card, entries)
    yield behind


def _card(entry: Entry) -> str:
    kind, sign = entry.kind
    picture = '<span class="nothing" aria-hidden="true"></span>'
    if entry.picture is not None:
        picture = image(entry.picture, "")
    name = f'<span class="name">{text(entry.name)}</span>'
    if entry.page:
        name = f'<a href="{escape(quote(entry.page))}">{text(entry.name)}</a>'
    margin = f'<p class="margin">{text(entry.margin)}</p>' if entry.margin else ""
    return (
        f'<li class="card {kind}">{picture}<p>{name}</p>'
        f'<p><span class="sign" aria-hidden="true">{sign}</span>{text(entry.words)}</p>'
        f"{margin}</li>"
    )
