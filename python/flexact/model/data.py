# SPDX-License-Identifier: BSD-3-Clause
"""A model that does not change: arrays, names, and what was found in them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import overload

import numpy as np

from ..core import calls
from ..core.arrays import FloatArray, IntArray, ModelArrays, PackedModel, packed
from ..core.elements import NodeKind
from ..core.raw import RawCount, RawFrames
from ..deck.diagnostics import Diagnostic, Problems, Severity, problems_of
from ..deck.errors import DeckError, ModelError
from ..deck.source import Source, decode
from ..util.cached import cached_property
from ..util.records import Frozen
from .attributes import Appearance
from .loads import Loads
from .parts.chains import Chain, chains_of
from .parts.directions import directions_across
from .properties import Properties
from .slips import slips_in

#: As the core says it of a deck.
_NOTHING = Diagnostic(
    Severity.ERROR,
    "nothing-to-analyse",
    "there is nothing to analyse: no elements",
    help="add at least one element, such as truss(p, q)",
)


class DeckNames(Sequence[str]):
    """Names of a deck's elements or nodes, cut out of its text when they are asked for."""

    def __init__(self, text: bytes, places: IntArray) -> None:
        """Keep the text and the first and last place of each name, (2, names)."""
        self._text = text
        self._places = places

    def __len__(self) -> int:
        """Number of elements or nodes."""
        return int(self._places.shape[1])

    @overload
    def __getitem__(self, index: int) -> str: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[str, ...]: ...
    def __getitem__(self, index: int | slice) -> str | tuple[str, ...]:
        """The name of an element or a node by its index; empty where it has none."""
        if isinstance(index, slice):
            return tuple(self[i] for i in range(*index.indices(len(self))))
        return self._between(*self._places[:, index].tolist())

    def __iter__(self) -> Iterator[str]:
        """All names, faster than one by one."""
        return map(self._between, *self._places.tolist())

    def are_there(self) -> bool:
        """Whether there is any name."""
        return bool(self._places[0].any())

    def _between(self, first: int, last: int) -> str:
        return decode(self._text[first - 1 : last]) if first > 0 else ""


@dataclass(frozen=True, eq=False)
class ModelData(Frozen):
    """A model at one moment.

    Attributes:
        arrays: The arrays as the core takes them.
        planar: Whether positions have two coordinates.
        name: What the model is called.
        element_names: One name an element, empty where it has none.
        node_names: One name a node, likewise; that of a point is its position's.
        source: The deck's text, for a model that was read.
        found: What reading the deck, or making the arrays, found; None where the arrays
            are still to be checked.
        besides: What making the arrays found besides.
        given_appearance: What was said about drawing the elements; None where nothing was.
        properties: Stiffness and mass; None where nothing is said of them.
        loads: Forces, moments and gravity; None where there are none.
        has_long_numbers: Whether the geometry was typed with more digits than its numbers hold,
            so that these are not what was typed, though they may look like it.
        began_as: The deck that a model started as which was changed since; its comments stay.
        called: What calls of a script released: indices of elements, and deformations from 1.
    """

    arrays: ModelArrays
    planar: bool
    name: str
    element_names: Sequence[str]
    node_names: Sequence[str] = ()
    source: Source | None = None
    found: Problems | None = None
    besides: tuple[Diagnostic, ...] = ()
    given_appearance: Appearance | None = None
    properties: Properties | None = None
    loads: Loads | None = None
    has_long_numbers: bool = False
    began_as: Source | None = None
    called: frozenset[tuple[int, int]] = frozenset()

    def __post_init__(self) -> None:
        """Make the arrays read-only; without names of nodes all of them are empty."""
        super().__post_init__()
        if not self.node_names:
            object.__setattr__(self, "node_names", ("",) * self.arrays.node_number.size)

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
        found = problems_of(calls.check_model(self.packed, *self._names_as_text()))
        found = found.and_also(self.besides)
        return found if found.errors else found.and_also(tuple(slips_in(self)))

    def _names_as_text(self) -> tuple[bytes, IntArray]:
        """All names in one text, and first and last place of each, from 1; 0 without one."""
        every = (self.element_names, self.node_names)
        places = np.zeros((2, sum(map(len, every))), np.int32, order="F")
        if not any(e.are_there() if isinstance(e, DeckNames) else any(e) for e in every):
            return b"", places
        names = [name for names in every for name in names]
        words = [name.encode("utf-8", "replace") for name in names]
        lengths = np.fromiter(map(len, words), np.int64, len(words))
        last = np.cumsum(lengths)
        places[:] = np.where(lengths > 0, (last - lengths + 1, last), 0)
        return b"".join(words), places

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
    def size(self) -> float:
        """The diagonal of the box about its positions [m]; 1 without extent."""
        places = self.arrays.node_value[:3, self.arrays.node_kind <= NodeKind.POSITION]
        if not places.size:
            return 1.0
        return float(np.linalg.norm(np.ptp(places, axis=1))) or 1.0

    @cached_property
    def chains(self) -> tuple[Chain, ...]:
        """Rows of beams that are one sheet or wire each."""
        return chains_of(self.arrays, self.element_names, lambda: self.frames.frame)

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
