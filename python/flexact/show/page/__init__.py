# SPDX-License-Identifier: BSD-3-Clause
"""A result as one HTML file that opens offline; uses `drawing`, `text`, `advice` and below."""

from .before_and_after import before_and_after
from .compare import Pair, changes_part, compare_page
from .content import Content, broken_content, content_of, reason_in_words
from .designs import Compared, Side, Told, designs_page
from .entry import Entry, broken_entry, entry_of, unread_entry
from .index import index_page, index_pieces, with_way_back
from .page import broken_page, page

__all__ = [
    "Compared",
    "Content",
    "Entry",
    "Pair",
    "Side",
    "Told",
    "before_and_after",
    "broken_content",
    "broken_entry",
    "broken_page",
    "changes_part",
    "compare_page",
    "content_of",
    "designs_page",
    "entry_of",
    "index_page",
    "index_pieces",
    "page",
    "reason_in_words",
    "unread_entry",
    "with_way_back",
]
