# SPDX-License-Identifier: BSD-3-Clause
"""Small pieces of HTML; all text of decks goes through `text`."""

from __future__ import annotations

import base64
from collections.abc import Iterable, Sequence
from html import escape

from ..base.plain_text import harmless
from ..text.sentences import Line, Named, Pieces

_BAR_WIDTH, _BAR_HEIGHT = 56, 10


def text(words: str) -> str:
    """Text as HTML that shows it as it is."""
    return escape(harmless(words))


def flowing(line: Line) -> str:
    """A line of text; what it names is linked with the drawing."""
    items = [linked(item) + text(note) for item, note in line.listed()]
    items += ["\N{HORIZONTAL ELLIPSIS}"] * line.more
    return linked(line.head) + "; ".join(items)


def linked(pieces: Pieces) -> str:
    """Words whose nodes and elements are linked with the drawing."""
    return "".join(
        link(piece.kind, piece.number, str(piece)) if isinstance(piece, Named) else text(piece)
        for piece in pieces
    )


def image(png: bytes, words: str) -> str:
    """A picture with the words that say what it shows."""
    source = base64.b64encode(png).decode()
    return f'<img src="data:image/png;base64,{source}" alt="{text(words)}">'


def link(kind: str, number: int, words: str) -> str:
    """A button that names an element or a node of the drawing."""
    return f'<button type="button" class="link" data-{kind}="{number}">{text(words)}</button>'


def table(heads: Sequence[str], rows: Iterable[str], caption: str = "", kind: str = "") -> str:
    """A table of rows that are HTML already."""
    told = f"<caption>{text(caption)}</caption>" if caption else ""
    cells = "".join(f'<th scope="col">{text(head)}</th>' for head in heads)
    head = f"<thead><tr>{cells}</tr></thead>" if any(heads) else ""
    return f'<table class="{kind}">{told}{head}<tbody>{"".join(rows)}</tbody></table>'


def row(head: str, *cells: str, about: str = "") -> str:
    """A row; head and cells are HTML, `about` are attributes."""
    rest = "".join(f"<td>{cell}</td>" for cell in cells)
    return f'<tr{about}><th scope="row">{head}</th>{rest}</tr>'


def bar(share: float) -> str:
    """A bar to the left or right of its middle, for a value from -1 to 1."""
    middle = _BAR_WIDTH / 2
    width = abs(share) * middle
    left = middle - width if share < 0 else middle
    side = "low" if share < 0 else "high"
    return (
        f'<svg class="bar" width="{_BAR_WIDTH}" height="{_BAR_HEIGHT}" aria-hidden="true">'
        f'<rect class="{side}" x="{left:.1f}" width="{width:.1f}" height="{_BAR_HEIGHT}"/>'
        f'<path d="M{middle:.0f} 0V{_BAR_HEIGHT}"/></svg>'
    )


def number(value: float) -> str:
    """A number of four digits with a real minus sign."""
    return f"{value:.4g}".replace("-", "\N{MINUS SIGN}")


def section(name: str, title: str, *parts: str) -> str:
    """A section with a heading; empty without any content."""
    body = "".join(parts)
    if not body:
        return ""
    return (
        f'<section id="{name}" aria-labelledby="{name}-head">'
        f'<h2 id="{name}-head">{text(title)}</h2>{body}</section>'
    )


def paragraphs(sentences: Iterable[Line]) -> str:
    """Lines of text, one a paragraph, linked with the drawing."""
    return "".join(f"<p>{flowing(each)}</p>" for each in sentences)
