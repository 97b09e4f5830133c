# SPDX-License-Identifier: BSD-3-Clause
"""A model that does not change: arrays, names, and what was found in them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import overload

from ..base.frozen import Frozen
from ..core import calls
from ..core.arrays import FloatArray, IntArray, ModelArrays, PackedModel, packed
from ..core.raw import RawCount, RawFrames
from ..diagnostics.diagnostic import Diagnostic, Problems, Severity, problems_of
from ..diagnostics.errors import DeckError, ModelError
from ..diagnostics.source import Source, decode
from .appearance import Appearance
from .parts.chains import Chain, chains_of
from .parts.directions import directions_across

#: As the core says it of a deck.
_NOTHING = Diagnostic(
    Severity.ERROR,
    "nothing-to-analyse",
    "there is nothing to analyse: no elements",
    help="add at least one element, such as truss(p, q)",
)


class DeckNames(Sequence[str]):
    """Names of a deck's elements, cut out of its text when they are asked for."""

    def __init__(self, text: bytes, places: IntArray) -> None:
        """Keep the text and the first and last place of each name, (2, elements)."""
        self._text = text
        self._places = places

    def __len__(self) -> int:
        """Number of elements."""
        return int(self._places.shape[1])

    @overload
    def __getitem__(self, index: int) -> str: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[str, ...]: ...
    def __getitem__(self, index: int | slice) -> str | tuple[str, ...]:
        """The name of an element by its index; empty where it has none."""
        if isinstance(index, slice):
            return tuple(self[i] for i in range(*index.indices(len(self))))
        first, last = self._places[:, index].tolist()
        return decode(self._text[first - 1 : last]) if first > 0 else ""


@dataclass(frozen=True, eq=False)
class ModelData(Frozen):
    """A model at one moment.

    Attributes:
        arrays: The arrays as the core takes them.
        planar: Whether positions have two coordinates.
        name: What the model is called.
        element_names: One name an element, empty where it has none.
        source: The deck's text, for a model that was read.
        found: What reading the deck, or making the arrays, found; None where the arrays
            are still to be checked.
        given_appearance: What was said about drawing the elements; None where nothing was.
        has_long_numbers: Whether the geometry was typed with more digits than its numbers hold,
            so that these are not what was typed, though they may look like it.
    """

    arrays: ModelArrays
    planar: bool
    name: str
    element_names: Sequence[str]
    source: Source | None = None
    found: Problems | None = None
    given_appearance: Appearance | None = None
    has_long_numbers: bool = False

    @cached_property
    def packed(self) -> PackedModel:
        """The arrays as they cross the boundary, made once."""
        return packed(self.arrays)

    @cached_property
    def problems(self) -> Problems:
        """Errors, warnings and notes about the model."""
        if self.found is not None:
            return self.found
        if not self.arrays.element_number.size:
            return Problems.of([_NOTHING])
        return problems_of(calls.check_model(self.packed))

    @cached_property
    def appearance(self) -> Appearance:
        """How the elements are to be drawn."""
        if self.given_appearance is not None:
            return self.given_appearance
        return Appearance.plain(self.arrays.element_number.size)

    @cached_property
    def node_index(self) -> dict[int, int]:
        """Index of each node by its number."""
        return {number: i for i, number in enumerate(self.arrays.node_number.tolist())}

    @cached_property
    def element_index(self) -> dict[int, int]:
        """Index of each element by its number."""
        return {number: i for i, number in enumerate(self.arrays.element_number.tolist())}

    @cached_property
    def chains(self) -> tuple[Chain, ...]:
        """Rows of beams that are one sheet or wire each."""
        return chains_of(self.arrays, self.element_names)

    @cached_property
    def count(self) -> RawCount:
        """Counts by class and the size of D(c)."""
        return calls.count_model(self.packed)

    @cached_property
    def frames(self) -> RawFrames:
        """Reference frames and lengths of the elements, of a sound model."""
        return calls.find_frames(self.packed)

    @cached_property
    def across(self) -> FloatArray:
        """(elements, 2, 3) unit vectors across the elements (`flexact.model.parts.directions`)."""
        return directions_across(self.arrays, self.frames.frame, self.chains)

    def require_sound(self) -> None:
        """Raise where the model cannot be analysed.

        Raises:
            DeckError: for a model that was read from a deck.
            ModelError: for a model made in Python.
        """
        if self.problems.errors:
            error = DeckError if self.source is not None else ModelError
            raise error(self.problems, self.name, self.source)
