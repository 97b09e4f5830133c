# SPDX-License-Identifier: BSD-3-Clause
"""Errors as HTML that stand beside the last good scene: each with its place and its caret."""

from __future__ import annotations

from ...deck.diagnostics import Diagnostic
from ...deck.errors import ProblemsError
from ...deck.rendering import MOST_SHOWN, render
from ...deck.source import Source
from ...show.page.markup import text
from ...util.partial import why
from ...util.plain_text import file_name


def errors_part(error: Exception, path: str) -> str:
    """What is wrong, in full."""
    if not isinstance(error, ProblemsError):
        return f"<p>{text(why(error))}</p>"
    shown = sorted(error.diagnostics, key=lambda item: not item.is_error)[:MOST_SHOWN]
    name = file_name(error.name or path)
    parts = [_problem(item, name, error.source) for item in shown]
    if (more := error.problems.total - len(shown)) > 0:
        parts.append(f'<p class="note">and {more} more problem{"s" * (more > 1)}</p>')
    return "".join(parts)


def _problem(item: Diagnostic, name: str, source: Source | None) -> str:
    head, *excerpt = render(item, name, source).split("\n")
    # Help is a sentence, which breaks into lines as they fit.
    helps = [line for line in excerpt if line.lstrip().startswith("= help:")]
    lines = [line for line in excerpt if line not in helps]
    severity, _, words = head.partition(": ")
    hint = f'<p class="help">help: {text(item.help)}</p>' if item.help else ""
    # The label is an arrow's word; without a place it stands alone.
    place = f"<pre>{chr(10).join(map(text, lines))}</pre>" if lines else ""
    return (
        f'<div class="told {item.severity}"><b>{text(severity)}</b>: {text(words)}'
        f"{place}{hint}</div>"
    )
