# SPDX-License-Identifier: BSD-3-Clause
"""Text of decks, made fit to be shown."""

from __future__ import annotations


def harmless(text: str, keep_tabs: bool = False) -> str:
    """The text with nothing in it that could move a cursor: one character for one."""
    if text.isascii() and text.isprintable():
        return text
    return "".join(_harmless(c, keep_tabs) for c in text)


def _harmless(c: str, keep_tabs: bool) -> str:
    if c.isprintable() or (c == "\t" and keep_tabs):
        return c
    if c == "\t":
        return " "
    if ord(c) < 0x20:
        return chr(0x2400 + ord(c))
    return "\u2421" if c == "\x7f" else "\ufffd"
