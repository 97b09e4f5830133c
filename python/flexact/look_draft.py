"""How the elements of a model in the making are to be drawn."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from .exchange import FloatArray
from .look import Look

Colour = tuple[float, float, float]


class Shape(NamedTuple):
    """A cross-section: its kind and its sizes along local y and z [m]."""

    kind: int
    y: float
    z: float


class Said(NamedTuple):
    """What is said about drawing an element at one time; None leaves what was said before."""

    shape: Shape | None = None
    colour: Colour | None = None
    edge_colour: Colour | None = None
    opacity: float | None = None
    drawn: bool | None = None


class LookDraft:
    """What was said about drawing elements, by their indices."""

    def __init__(self) -> None:
        """Nothing is said yet."""
        self.shape: dict[int, Shape] = {}
        self.colour: dict[int, Colour] = {}
        self.edge_colour: dict[int, Colour] = {}
        self.opacity: dict[int, float] = {}
        self.hidden: set[int] = set()

    @classmethod
    def of(cls, look: Look) -> LookDraft:
        """The draft that gives this look."""
        draft = cls()
        for i in np.flatnonzero(look.cross_section).tolist():
            draft.shape[i] = Shape(int(look.cross_section[i]), *look.dimensions[i].tolist())
        draft.colour = _rows(look.colour)
        draft.edge_colour = _rows(look.edge_colour)
        given = np.flatnonzero(~np.isnan(look.opacity))
        draft.opacity = dict(zip(given.tolist(), look.opacity[given].tolist(), strict=True))
        draft.hidden = set(np.flatnonzero(~look.drawn).tolist())
        return draft

    def give(self, indices: Iterable[int], said: Said) -> None:
        """Say something about elements."""
        for i in indices:
            if said.shape is not None:
                self.shape[i] = said.shape
            if said.colour is not None:
                self.colour[i] = said.colour
            if said.edge_colour is not None:
                self.edge_colour[i] = said.edge_colour
            if said.opacity is not None:
                self.opacity[i] = said.opacity
            if said.drawn is not None:
                (self.hidden.discard if said.drawn else self.hidden.add)(i)

    def freeze(self, elements: int) -> Look | None:
        """The look of so many elements; None where nothing is said."""
        if not (self.shape or self.colour or self.edge_colour or self.opacity or self.hidden):
            return None
        shapes = np.zeros((elements, 3))
        shapes[list(self.shape)] = np.array(list(self.shape.values())).reshape(-1, 3)
        drawn = np.ones(elements, bool)
        drawn[list(self.hidden)] = False
        return Look(
            shapes[:, 0].astype(np.int32),
            shapes[:, 1:].copy(),
            _filled(self.colour, (elements, 3)),
            _filled(self.edge_colour, (elements, 3)),
            _filled(self.opacity, (elements,)),
            drawn,
        )


def _rows(colours: FloatArray) -> dict[int, Colour]:
    given = np.flatnonzero(~np.isnan(colours[:, 0])).tolist()
    return {i: (r, g, b) for i, (r, g, b) in zip(given, colours[given].tolist(), strict=True)}


def _filled(values: dict[int, Colour] | dict[int, float], shape: tuple[int, ...]) -> FloatArray:
    made = np.full(shape, np.nan)
    if values:
        made[list(values)] = list(values.values())
    return made
