# SPDX-License-Identifier: BSD-3-Clause
"""A result as one HTML file that opens offline."""

from .compare import Side, before_and_after, designs_page, spaces_page
from .content import Content, broken_content, broken_page, content_of, page, reason_in_words
from .index import (
    Entry,
    Pair,
    broken_entry,
    changes_part,
    compare_page,
    entry_of,
    index_page,
    index_pieces,
    unread_entry,
    with_way_back,
)

__all__ = [
    "Content",
    "Entry",
    "Pair",
    "Side",
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
    "spaces_page",
    "unread_entry",
    "with_way_back",
]
