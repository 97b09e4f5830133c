# SPDX-License-Identifier: BSD-3-Clause
"""What is known of a deck in an editor: its words, and its model where it is sound."""

from __future__ import annotations

from dataclasses import dataclass

from ...deck.diagnostics import Problems
from ...deck.errors import DeckError
from ...model.data import ModelData
from ...model.parts.condensing import Condensed, as_given
from ...model.parts.parts import Parts
from ...model.reading import read_bytes
from ...util.cached import cached_property
from .deck import Index
from .document import Document
from .statements import Statements


@dataclass(frozen=True, eq=False)
class Told:
    """A model of which is spoken without an analysis: see `text.deformation.Told`."""

    data: ModelData

    @cached_property
    def condensed(self) -> Condensed:
        """The model as it is."""
        return as_given(self.data)

    @cached_property
    def parts(self) -> Parts:
        """Its parts."""
        return Parts(self.data)


@dataclass(frozen=True, eq=False)
class Deck:
    """A document with what is read off it, each when it is asked for."""

    document: Document
    name: str = "deck"

    @cached_property
    def statements(self) -> Statements:
        """Its lines, taken apart."""
        return Statements(self.document)

    @cached_property
    def index(self) -> Index:
        """Where its nodes and elements stand."""
        return Index(self.statements)

    @cached_property
    def _read(self) -> tuple[ModelData | None, Problems]:
        raw = self.document.text.encode("utf-8", "replace")
        try:
            data = read_bytes(raw, self.name)
        except DeckError as error:
            return None, error.problems
        return data, data.problems

    @property
    def data(self) -> ModelData | None:
        """Its model; None where it has errors."""
        return self._read[0]

    @property
    def problems(self) -> Problems:
        """What `flexact check` says."""
        return self._read[1]

    @cached_property
    def told(self) -> Told | None:
        """Its model, to be spoken of; None where it has errors."""
        return Told(self.data) if self.data is not None else None
