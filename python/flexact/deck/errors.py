# SPDX-License-Identifier: BSD-3-Clause
"""The exceptions that carry problems of decks and models."""

from __future__ import annotations

from ..util.errors import FlexactError
from .diagnostics import Diagnostic, Problems, Severity
from .rendering import render_problems
from .source import Source


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
