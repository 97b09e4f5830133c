"""The page: a result as one HTML file that opens from disk, without a network."""

from .index_page import Entry, index_page
from .page import broken_page, page, reason_in_words

__all__ = ["Entry", "broken_page", "index_page", "page", "reason_in_words"]
