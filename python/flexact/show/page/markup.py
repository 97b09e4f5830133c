# SPDX-License-Identifier: BSD-3-Clause
"""Small pieces of HTML; all text of decks goes through `text`."""

from __future__ import annotations

import base64
from collections.abc import Iterable, Sequence
from html import escape

from ...analysis.sentences import Line, Named, Pieces
from ...util.plain_text import harmless


def text(words: str) -> str:
    """Text as HTML that shows it as it is."""
    return escape(harmless(words))


def breakable(name: str) -> str:
    """A path as HTML that may go on in another line behind each stroke and underscore."""
    return text(name).replace("/", "/<wbr>").replace("_", "_<wbr>")


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


def image(png: bytes, words: str, *, late: bool = False) -> str:
    """A picture with the words that say what it shows; late ones wait until they are seen."""
    source = base64.b64encode(png).decode()
    waits = ' loading="lazy" decoding="async"' if late else ""
    return f'<img src="data:image/png;base64,{source}" alt="{text(words)}"{waits}>'


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


def section(name: str, title: str, *parts: str) -> str:
    """A section with a heading; empty without any content."""
    body = "".join(parts)
    if not body:
        return ""
    return (
        f'<section id="{name}" aria-labelledby="{name}-head">'
        f'<h2 id="{name}-head">{text(title)}</h2>{body}</section>'
    )


def folded(title: str, *parts: str) -> str:
    """Parts that are seen when somebody opens them; empty without any content."""
    body = "".join(parts)
    if not body:
        return ""
    return f'<details class="folded"><summary>{text(title)}</summary>{body}</details>'


def paragraphs(sentences: Iterable[Line]) -> str:
    """Lines of text, one a paragraph, linked with the drawing."""
    return "".join(f"<p>{flowing(each)}</p>" for each in sentences)
