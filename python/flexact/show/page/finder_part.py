# SPDX-License-Identifier: BSD-3-Clause
"""What chooses and orders the cards of an index: `finder.js` does it."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape

from .markup import text


def finder(kinds: Iterable[tuple[str, str]], orders: Iterable[tuple[str, str]]) -> str:
    """The choices, hidden until there is a script.

    Args:
        kinds: Classes of cards, each with what it is called, and how many there are.
        orders: What cards are sorted by, the name of the datum with what it is called.
    """
    chips = "".join(
        f'<label class="chip {escape(kind)}"><input type="checkbox" name="kind" '
        f'value="{escape(kind)}"><span>{text(words)}</span></label>'
        for kind, words in kinds
    )
    options = "".join(
        f'<option value="{escape(name)}">{text(words)}</option>' for name, words in orders
    )
    return (
        '<section class="finder" role="search" aria-label="Find decks" hidden>'
        f'<fieldset><legend class="unseen">Show only</legend>{chips}</fieldset>'
        '<div class="group"><label class="find">Find <input type="search" id="find" '
        'autocomplete="off" spellcheck="false" placeholder="name or words"></label>'
        f'<label>Sort by <select id="sort">{options}</select></label>'
        '<button type="button" id="down" aria-pressed="false">Reverse</button>'
        '<button type="button" id="all">Show all</button></div>'
        '<p id="found" class="note" role="status"></p></section>'
    )
