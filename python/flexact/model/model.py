# SPDX-License-Identifier: BSD-3-Clause
"""The model: the one meeting point of decks and Python."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import FloatArray, IntArray
from ..core.elements import NodeKind, keywords_of
from ..deck.diagnostics import Diagnostic
from ..deck.rendering import model_error
from ..util.errors import require_kind
from ..util.loading import feature
from ..util.text import in_short
from .configuration import Configuration
from .coordinates import LoadMethods
from .copies import CopyMethods
from .data import ModelData
from .edits import EditMethods
from .handles import Body, Element, Node, Part
from .parts.parts import surplus_of
from .selection import PartLike, Point, whole
from .variation import held_given, positions_given, with_held, with_positions
from .writing import deck_of


class Builder(CopyMethods, EditMethods, LoadMethods):
    """The half of `Model` that makes it; see there."""


class Model(Builder):
    """A mechanism as a finite element model.

    Make parts between points (sheets, wires, bodies, hinges, whole cross hinges and
    guides), say what is fixed and independent, and hand the model to `flexact.analyse`.
    Where a point is wanted, a handle, a name, a place (x, y, z) or a body will do;
    where a part is wanted, its handle or its name. A model that was read from a deck has
    the same methods; `handle` makes points from node numbers. Positions are in metres.

    The arrays are read-only and made once; a change of the model makes new ones and
    leaves the old ones as they are. Nodes are in ascending order of their numbers,
    elements in the order in which they were made or stand in the deck.

    Args:
        planar: A model in the xy plane: two coordinates and one angle a point.
        name: What the model is called in results.
    """

    @classmethod
    def from_data(cls, data: ModelData) -> Model:
        """A model that starts as these data, such as those of another.

        Raises:
            TypeError: they are no `ModelData`.
        """
        require_kind(data, ModelData, "a model starts as the data of one")
        model = cls.__new__(cls)
        model._start(data.planar, data.name)
        model._draft = None
        model._data = data
        return model

    def __repr__(self) -> str:
        """Name and size."""
        a = self.data.arrays
        kind = "planar model" if self.planar else "model"
        name = f" {self.name!r}" if self.name else ""
        size = f"{a.node_number.size} nodes, {a.element_number.size} elements"
        return f"<flexact {kind}{name}: {size}>"

    @property
    def name(self) -> str:
        """What the model is called; the path of a deck."""
        return self._name

    @property
    def planar(self) -> bool:
        """Whether all is in the xy plane, with two coordinates and one angle a point."""
        return self._planar

    @property
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """What reading or checking the model found, in the order of the places."""
        return self.data.problems.kept

    def check(self) -> None:
        """Raise where the model cannot be analysed.

        Raises:
            DeckError: for a model that was read from a deck.
            ModelError: for a model made in Python.
        """
        self.data.require_sound()

    @property
    def node_numbers(self) -> IntArray:
        """(nodes,) numbers, ascending."""
        return self.data.arrays.node_number

    @property
    def node_kinds(self) -> IntArray:
        """(nodes,) 1 planar position, 2 position, 3 angle, 4 orientation."""
        return self.data.arrays.node_kind

    @property
    def node_values(self) -> FloatArray:
        """(nodes, 4) reference values: position [m]; Euler parameters; or angle [rad]."""
        return self.data.arrays.node_value.T

    @property
    def positions(self) -> FloatArray:
        """(nodes, 3) reference positions [m]; zero for nodes that are orientations."""
        a = self.data.arrays
        made = np.where((a.node_kind <= NodeKind.POSITION)[:, None], a.node_value.T[:, :3], 0.0)
        made.flags.writeable = False
        return made

    @property
    def coordinate_classes(self) -> IntArray:
        """(nodes, 3) by axis: 0 no such coordinate, 1 fixed, 2 dependent, 3 independent."""
        return self.data.arrays.coordinate_class.T

    @property
    def element_numbers(self) -> IntArray:
        """(elements,) numbers."""
        return self.data.arrays.element_number

    @property
    def element_kinds(self) -> IntArray:
        """(elements,) row of the element table, from 1 (`flexact.core.elements.element_kinds`)."""
        return self.data.arrays.element_kind

    @property
    def element_keywords(self) -> tuple[str, ...]:
        """The keyword of each element: TRUSS, BEAM, ..."""
        return keywords_of(self.data.arrays.element_kind)

    @property
    def element_nodes(self) -> IntArray:
        """(elements, 4) node indices from 0 in the slots p, op, q, oq; -1 where unused."""
        made = self.data.arrays.element_node.T - 1
        made.flags.writeable = False
        return made

    @property
    def element_vectors(self) -> FloatArray:
        """(elements, 3) y vector of a beam or axis of a hinge; zeros: not given."""
        return self.data.arrays.element_vector.T

    @property
    def deformation_classes(self) -> IntArray:
        """(elements, 6): 0 no such deformation, 1 fixed, 2 released, 3 independent."""
        return self.data.arrays.deformation_class.T

    @property
    def element_names(self) -> tuple[str, ...]:
        """(elements,) names, empty where an element has none."""
        return tuple(self.data.element_names)

    @property
    def node_names(self) -> tuple[str, ...]:
        """(nodes,) names, empty where a node has none; that of a point is its position's."""
        return tuple(self.data.node_names)

    def node_index(self, number: Point | int) -> int:
        """Where a node stands in what is given by node, such as `Motion.displacement`.

        Args:
            number: Such as `Node.position` or `Node.orientation`; or a point, by its name, place or
                handle, whose position node is meant.

        Raises:
            ModelError: no element uses a node of this number, or there is no such point.
        """
        if isinstance(number, (Node, Body, str, Iterable)):
            number = self.point(number).position
        number = whole(number, "a node is given by its number")
        index = self.data.node_index.get(number)
        if index is None:
            raise model_error("no-such-node", f"no element uses a node {in_short(number)}")
        return index

    def element_index(self, number: PartLike) -> int:
        """Where an element stands in what is given by element, such as `SelfStress.moments`.

        Args:
            number: Such as `Element.number`; or a part of one element, by its name or handle.

        Raises:
            ModelError: there is no such element, or the part has several.
        """
        if isinstance(number, (Element, Part, str)):
            made = self.part(number)
            if len(made.elements) != 1:
                many = f"{in_short(made.name)} has {len(made.elements)} elements"
                raise model_error("several-elements", many, "give the number of one of them")
            number = made.elements[0].number
        number = whole(number, "an element is given by its number")
        index = self.data.element_index.get(number)
        if index is None:
            raise model_error("no-such-element", f"there is no element {in_short(number)}")
        return index

    def reference(self) -> Configuration:
        """The configuration in which all deformations are zero."""
        return Configuration(self.data.arrays.node_kind, self.data.arrays.node_value.T)

    def declare_internal_motions(self) -> None:
        """Make independent what is inside divided sheets and wires, so that each is one beam.

        Of each deformation that several beams of one sheet or wire release, that of the first
        stays released; see `Result.internal_motions`.
        """
        for element, deformations in surplus_of(self.data):
            self._change().declare(element, deformations)

    def with_positions(self, positions: ArrayLike) -> Model:
        """The same mechanism with its nodes elsewhere; vectors of elements stay as they are.

        Args:
            positions: (nodes, 3) [m], as `positions`; rows of orientations are ignored.

        Raises:
            DeckError, ModelError: this model is wrong.
            TypeError: they are no numbers.
            ValueError: the shape is another, or a position is not finite.
        """
        self.check()
        given = positions_given(self.data, positions, many=False)
        return Model.from_data(with_positions(self.data, given))

    def with_held(self, held: ArrayLike) -> Model:
        """The same mechanism with these deformations held, and the others released.

        Args:
            held: (elements, 6) of bool, such as `deformation_classes == 1` is for the model as
                it is. What is declared independent stays so unless it is held, and what stands
                for deformations that an element has not is ignored.

        Raises:
            DeckError, ModelError: this model is wrong.
            TypeError: they are no truth values.
            ValueError: the shape is another.
        """
        self.check()
        return Model.from_data(with_held(self.data, held_given(self.data, held, many=False)))

    def to_deck(self) -> str:
        """The model in the deck language; reading it gives the same model.

        Numbers are written so that they read back to the last bit; names of elements and
        nodes stand as comments at the end of their lines. Of a deck that was read, comments
        stay with the statements that they belong to.

        Raises:
            ModelError: the model is wrong, so that no deck can be read back.
        """
        self.check()
        return deck_of(self.data)

    def show(self, path: str | os.PathLike[str] | None = None) -> Path | None:
        """Analyse the model and show its page: in the browser, or in the notebook.

        The page of a model with errors says what they are. Where no browser can be opened, it is
        said where the page is.

        Args:
            path: Where the page is written, such as "guide.html"; by default a temporary file.

        Returns:
            Where the page is; None in a notebook, and in a script that `flexact watch` runs.

        Raises:
            FlexactError: the page cannot be written, or the path is not that of a page.
        """
        made: Path | None = feature("show")(self, path)
        return made

    def _repr_html_(self) -> str:
        made: str = feature("html")(self.data)
        return made
