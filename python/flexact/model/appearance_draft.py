# SPDX-License-Identifier: BSD-3-Clause
"""How the elements of a model in the making are to be drawn."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np

from .attributes import Appearance

Colour = tuple[float, float, float]

#: What is given of an element, and how many.
_NUMBERS: dict[str, tuple[int, ...]] = {"colour": (3,), "edge_colour": (3,), "opacity": ()}


class Shape(NamedTuple):
    """A cross-section: its kind and its sizes along local y and z [m]."""

    kind: int
    y: float
    z: float


#: What is said about drawing an element: shape, colour, edge_colour, opacity, drawn, each if given.
Said = dict[str, Any]


class AppearanceDraft:
    """What was said about drawing elements, by their indices."""

    def __init__(self) -> None:
        """Nothing is said yet."""
        self.said: dict[int, Said] = {}

    @classmethod
    def of(cls, appearance: Appearance) -> AppearanceDraft:
        """The draft that gives this appearance."""
        draft = cls()
        for i in np.flatnonzero(appearance.cross_section).tolist():
            sizes = appearance.dimensions[i].tolist()
            draft.give([i], {"shape": Shape(int(appearance.cross_section[i]), *sizes)})
        for name in _NUMBERS:
            values = getattr(appearance, name)
            rows = values.reshape(len(values), -1)[:, 0]
            for i in np.flatnonzero(~np.isnan(rows)).tolist():
                draft.give([i], {name: values[i].tolist()})
        draft.give(np.flatnonzero(~appearance.drawn).tolist(), {"drawn": False})
        return draft

    def give(self, indices: Iterable[int], said: Said) -> None:
        """Say something about elements; what is not said now stays as it was."""
        if said:
            for i in indices:
                self.said.setdefault(i, {}).update(said)

    def freeze(self, elements: int) -> Appearance | None:
        """The appearance of this number of elements; None where nothing is said."""
        if all(said == {"drawn": True} for said in self.said.values()):
            return None
        shapes, drawn = np.zeros((elements, 3)), np.ones(elements, bool)
        numbers = {name: np.full((elements, *size), np.nan) for name, size in _NUMBERS.items()}
        for i, said in self.said.items():
            shapes[i] = said.get("shape", 0.0)
            drawn[i] = said.get("drawn", True)
            for name in said.keys() & _NUMBERS.keys():
                numbers[name][i] = said[name]
        kinds = shapes[:, 0].astype(np.int32)
        return Appearance(kinds, shapes[:, 1:].copy(), **numbers, drawn=drawn)
