# SPDX-License-Identifier: BSD-3-Clause
"""The deck with its diagnostics at their lines."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence

from ...deck.diagnostics import Diagnostic
from ...deck.source import decode
from ...model.data import ModelData
from ...model.writing import deck_of
from ...util.plain_text import harmless
from .limits import MOST_LINES
from .markup import section, text

#: A deck of so many lines is shown at once.
_SHORT = 40
#: Characters of a line that are shown.
_LONGEST = 400


def deck_part(raw: bytes, diagnostics: Sequence[Diagnostic], is_written: bool = False) -> str:
    """A deck's text.

    Args:
        raw: The deck.
        diagnostics: What is to be told about it.
        is_written: Whether the deck was written by Flexact, for a model made in Python.
    """
    at: dict[int, list[Diagnostic]] = defaultdict(list)
    for item in diagnostics:
        at[item.line].append(item)
    lines = [decode(line.removesuffix(b"\r")) for line in raw.split(b"\n")]
    if lines and not lines[-1]:
        lines.pop()
    chosen = sorted({*range(1, min(len(lines), MOST_LINES) + 1), *at} - {0})
    shown = "".join(
        _line(number, lines[number - 1], at[number]) for number in chosen if number <= len(lines)
    )
    note = ""
    if is_written:
        note = '<p class="note">The model was made in Python; this deck says the same.</p>'
    if len(lines) > MOST_LINES:
        note += (
            f'<p class="note">Of {len(lines)} lines the first {MOST_LINES} are shown, and those '
            "with diagnostics.</p>"
        )
    opened = " open" if len(lines) <= _SHORT or diagnostics else ""
    summary = f"{len(lines)} line{'s' * (len(lines) != 1)}"
    return section(
        "deck",
        "Deck",
        "".join(_told(item) for item in at[0]),
        note,
        f"<details{opened}><summary>{summary}</summary>"
        f'<div class="deck" role="group" aria-label="deck" tabindex="0">{shown}</div></details>',
    )


def deck_of_model(data: ModelData) -> tuple[bytes, bool]:
    """The deck of a model, and whether it was written just now."""
    if data.source is not None:
        return data.source.text, False
    return deck_of(data).encode("utf-8", "backslashreplace"), True


def _line(number: int, line: str, diagnostics: Sequence[Diagnostic]) -> str:
    cut = line[:_LONGEST]
    shown = _with_marks(cut, diagnostics)
    rest = "\N{HORIZONTAL ELLIPSIS}" if len(line) > _LONGEST else ""
    told = "".join(_told(item) for item in diagnostics)
    kind = f" {diagnostics[0].severity}" if diagnostics else ""
    return (
        f'<div class="line{kind}" id="line-{number}"><span class="no">{number}</span>'
        f"<code>{shown or ' '}{rest}</code></div>{told}"
    )


def _with_marks(line: str, diagnostics: Sequence[Diagnostic]) -> str:
    """The line, in which the first diagnostic's place is marked."""
    if not diagnostics or diagnostics[0].column < 1:
        return _shown(line)
    first = diagnostics[0].column - 1
    last = max(diagnostics[0].last_column, first + 1)
    return f"{_shown(line[:first])}<mark>{_shown(line[first:last])}</mark>{_shown(line[last:])}"


def _shown(words: str) -> str:
    return text(harmless(words, keep_tabs=True).expandtabs(8))


def _told(item: Diagnostic) -> str:
    """A diagnostic: its severity in words, what is wrong, and how to fix it."""
    label = f' <span class="label">{text(item.label)}</span>' if item.label else ""
    hint = f'<br><span class="help">help: {text(item.help)}</span>' if item.help else ""
    other = ""
    if item.other is not None:
        other = f' <a href="#line-{item.other.line}">see line {item.other.line}</a>'
    return (
        f'<div class="told {item.severity}"><b>{item.severity}[{text(item.code)}]</b>: '
        f"{text(item.message)}{label}{other}{hint}</div>"
    )
