# SPDX-License-Identifier: BSD-3-Clause
"""A result as one HTML file that opens offline; uses `drawing`, `text`, `advice` and below."""

from .before_and_after import before_and_after
from .content import Content, broken_content, content_of, reason_in_words
from .designs_page import Compared, Side, Told, designs_page
from .index_page import Entry, index_page, index_pieces
from .page import broken_page, page
from .verdict_part import BROKEN, kind_of

__all__ = [
    "BROKEN",
    "Compared",
    "Content",
    "Entry",
    "Side",
    "Told",
    "before_and_after",
    "broken_content",
    "broken_page",
    "content_of",
    "designs_page",
    "index_page",
    "index_pieces",
    "kind_of",
    "page",
    "reason_in_words",
]
