# SPDX-License-Identifier: BSD-3-Clause
"""Tables for notebooks, as HTML whose styles stay in it: they look like the notebook's own."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ..page.markup import text

_CELL = "text-align:left;vertical-align:top;padding:6px 10px;white-space:normal"


def table(heads: Sequence[str], rows: Iterable[Sequence[str]], title: str = "") -> str:
    """A table.

    Args:
        heads: Of the columns, as text.
        rows: Cells, as HTML.
        title: Above it, as HTML.
    """
    head = "".join(f"<th style='{_CELL}'>{text(each)}</th>" for each in heads)
    body = "".join(
        f"<tr>{''.join(f'<td style={_quoted(_CELL)}>{cell}</td>' for cell in row)}</tr>"
        for row in rows
    )
    told = f"<p>{title}</p>" if title else ""
    return (
        f"<div style='overflow-x:auto'>{told}<table><thead><tr>{head}</tr></thead>"
        f"<tbody>{body}</tbody></table></div>"
    )


def verdict(colour: str, sign: str, words: str) -> str:
    """A verdict with its colour and its sign."""
    mark = (
        f"<span style='display:inline-block;min-width:1.4em;padding:0 .4em;border-radius:1em;"
        f"background:{colour};color:#fff;text-align:center'>{sign}</span>"
    )
    return f"{mark} {text(words)}"


def _quoted(words: str) -> str:
    return f"'{words}'"
