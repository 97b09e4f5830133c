# SPDX-License-Identifier: BSD-3-Clause
"""Diagnostics as text, like a modern compiler's: place, source line, caret, help."""

from __future__ import annotations

from ..util.errors import FlexactError
from ..util.text import columns, harmless
from .diagnostics import Diagnostic, Place, Problems, Severity, Source, decode

MOST_SHOWN = 20
#: Columns of a source line, and in front of the place in a longer one.
_WIDTH = 110
_BEFORE = 40
#: Columns of a source line that are left however narrow a terminal is.
_LEAST = 12
_CUT = "..."


def render_problems(
    problems: Problems, name: str = "", source: Source | None = None, width: int | None = None
) -> str:
    """All problems: the first twenty, how many more there are, and a closing count.

    Errors go before warnings and notes when not all can be shown; what is shown
    stands in the order of the text. Source lines with their carets are not wider than `width`,
    where there is one; words are not broken here.
    """
    # Errors before others, in their order.
    ranked = sorted(range(len(problems.kept)), key=lambda i: not problems.kept[i].is_error)
    shown = [problems.kept[i] for i in sorted(ranked[:MOST_SHOWN])]
    blocks = [render(item, name, source, width) for item in shown]
    if problems.total > len(shown):
        more = problems.total - len(shown)
        blocks.append(f"... and {more} more problem{'s' if more > 1 else ''}")
    counts = (
        (problems.errors, "error"),
        (problems.warnings, "warning"),
        (problems.notes, "note"),
    )
    words = [f"{count} {word}{'s' if count != 1 else ''}" for count, word in counts if count]
    where = f"{harmless(name)}: " if name else ""
    blocks.append(where + (", ".join(words) or "no problems"))
    return "\n\n".join(blocks)


def render(
    item: Diagnostic, name: str = "", source: Source | None = None, width: int | None = None
) -> str:
    """One diagnostic; without a source it has no source lines."""
    lines = [f"{item.severity}[{harmless(item.code)}]: {harmless(item.message)}"]
    numbers = [item.line] + ([item.other.line] if item.other else [])
    gutter = " " * len(str(max(numbers)))
    name = harmless(name)
    if item.line > 0:
        place = Place(item.line, item.column, item.last_column)
        lines.append(f"{gutter}--> {name}:{item.line}:{item.column}")
        lines += _excerpt(source, place, gutter, "^", harmless(item.label), width)
        if item.other is not None:
            lines.append(f"{gutter}::: {name}:{item.other.line}:{item.other.column}")
            label = "first here" if item.other < place else "and here"
            lines += _excerpt(source, item.other, gutter, "-", label, width)
    else:
        if name:
            lines.append(f"{gutter}--> {name}")
        if item.label:
            lines.append(f"{gutter} = {harmless(item.label)}")
    if item.help:
        lines.append(f"{gutter} = help: {harmless(item.help)}")
    return "\n".join(lines)


def _excerpt(
    source: Source | None, place: Place, gutter: str, mark: str, label: str, width: int | None
) -> list[str]:
    if source is None:
        return [f"{gutter} = {label}"] if label else []
    room = _WIDTH if width is None else max(_LEAST, width - len(gutter) - 3)
    line = decode(source.line(place.line))
    if width is not None:
        line = line.replace("\t", " ")
    text, first, last = _window(line, place, room)
    padding = "".join("\t" if c == "\t" else " " * columns(c) for c in text[: first - 1])
    carets = mark * max(1, columns(text[first - 1 : last]))
    number = str(place.line).rjust(len(gutter))
    marked = f"{gutter} | {padding}{carets}"
    apart = width is not None and columns(f"{marked} {label}") > width
    return [
        f"{gutter} |",
        f"{number} | {text}".rstrip(),
        *([marked, f"{gutter} = {label}"] if apart else [f"{marked} {label}".rstrip()]),
    ]


def _window(text: str, place: Place, room: int) -> tuple[str, int, int]:
    """The line, or of one that is too long the part around the place; and the place in it."""
    first = min(place.column, len(text) + 1)
    last = min(max(place.last_column, first), max(len(text), first))
    text = harmless(text, keep_tabs=True)
    if columns(text) <= room or len(text) <= room == _WIDTH:
        return text, first, last
    if room != _WIDTH:
        # The cuts take room, and characters of two columns leave room for half as many.
        room = max(1, (room - 2 * len(_CUT)) * len(text) // columns(text))
    start = max(0, min(first - 1 - min(_BEFORE, room // 2), len(text) - room))
    head = _CUT if start else ""
    tail = _CUT if start + room < len(text) else ""
    shift = len(head) - start
    last = min(last, start + room)
    return head + text[start : start + room] + tail, first + shift, last + shift


class ProblemsError(FlexactError):
    """An error with diagnostics; its text is rendered like a compiler's.

    Attributes:
        problems: What was found, with counts.
        source: The text that the places lie in, if there is one.
        name: What the deck or model is called.
    """

    def __init__(self, problems: Problems, name: str = "", source: Source | None = None) -> None:
        """Keep the problems; the text is made when it is asked for."""
        super().__init__(problems, name, source)
        self.problems = problems
        self.name = name
        self.source = source

    def __repr__(self) -> str:
        """Name and number of problems; `str` has them all."""
        return f"<{type(self).__name__} {self.name!r}: {self.problems.total} problems>"

    @property
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """The diagnostics in the order of their places; at most a hundred are kept."""
        return self.problems.kept

    def __str__(self) -> str:
        """All problems, rendered with source lines and carets."""
        return render_problems(self.problems, self.name, self.source)


class DeckError(ProblemsError):
    """A deck that cannot be read or analysed."""

    @property
    def path(self) -> str:
        """Path or name of the deck."""
        return self.name


class ModelError(ProblemsError, ValueError):
    """A model made in Python that cannot be analysed, or a wrong call to its builder."""


def model_error(code: str, message: str, hint: str = "") -> ModelError:
    """A ModelError of one diagnostic without a place."""
    return ModelError(Problems.of([Diagnostic(Severity.ERROR, code, message, help=hint)]))
