# SPDX-License-Identifier: BSD-3-Clause
"""Single elements: methods of the builder that make bars, beams, links, hinges and notches."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from copy import copy
from dataclasses import replace

from ..core.elements import Class, kind_of
from ..core.raw import ElementKind
from ..deck.diagnostics import Problems
from ..deck.rendering import ModelError, model_error
from ..util.quantities import Quantity
from ..util.text import in_short
from . import sections
from . import selection as arguments
from . import selection as points
from .data import ModelData
from .deformations import deformations
from .draft import NO_VECTOR, Draft
from .handles import Element, Node, Notch, Owner
from .sections import Make, MaterialLike
from .selection import Direction, Point, Section, numbers_of_size, shape_of


class Making:
    """A model in the making."""

    def __init__(self, *unnamed: object, planar: bool = False, name: str = "") -> None:
        """Start an empty model.

        Raises:
            TypeError: something is given without its name.
        """
        if unnamed:
            given = in_short(unnamed[0])
            raise TypeError(
                f"what a Model begins with is named: Model(name={given}), planar=True; the model "
                f"of a deck is flexact.read({given})"
            )
        self._start(bool(planar), arguments.text(name, "the name of a model"))

    def _start(self, planar: bool, name: str) -> None:
        self._name = name
        self._planar = planar
        self._owner = Owner()
        self._draft: Draft | None = Draft(planar, self._owner)
        self._data: ModelData | None = None

    def _change(self) -> Draft:
        """The draft, to be changed; arrays that were made are dropped."""
        if self._draft is None:
            self._draft = Draft.of(self.data, self._owner)
        self._data = None
        return self._draft

    @property
    def data(self) -> ModelData:
        """The model as it is now; later changes do not touch it."""
        if self._data is None:
            assert self._draft is not None
            self._data = self._draft.freeze(self._name)
        return self._data

    def _kind(self, keyword: str) -> ElementKind:
        return kind_of("PL" + keyword if self._planar else keyword)


@contextmanager
def all_or_nothing(draft: Draft) -> Iterator[None]:
    """Leave the draft as it was where an error is raised; takes time for all that there is."""
    before = {name: copy(value) for name, value in vars(draft).items() if name not in _KEPT}
    said = dict(draft.appearance.said)
    try:
        yield
    except ModelError:
        vars(draft).update(before)
        draft.appearance.said = said
        draft.changed_names_or_places()
        raise


#: Of a draft: what is no table of its own.
_KEPT = ("owner", "appearance", "components")


@contextmanager
def call(method: str, name: object = "") -> Iterator[None]:
    """Begin the message of an error with the call and the part that it was about."""
    try:
        yield
    except ModelError as error:
        name = name if isinstance(name, str) else getattr(name, "name", "")
        if not isinstance(name, str) or not name or len(error.diagnostics) != 1:
            raise
        (problem,) = error.diagnostics
        start = f"{method} {in_short(name)}: "
        if problem.message.startswith(f"{method} "):
            raise
        told = replace(problem, message=start + problem.message)
        raise ModelError(Problems.of([told])) from None


class PointMethods(Making):
    """Methods about points."""

    def node(
        self,
        x: Quantity | Sequence[Quantity],
        y: Quantity | None = None,
        z: Quantity | None = None,
        *,
        name: str = "",
    ) -> Node:
        """Add a point [m]; its orientation is used only if an element needs it.

        It is a new one also where there is one already: `point` finds that. Where nothing joins
        two points at one place, a warning of the model says so.

        Args:
            x: Its first coordinate, or a vector or array of all of them.
            y: Its second coordinate.
            z: Its third coordinate, 0 by default.
            name: What the point is called, such as "clamp 1"; not "x", "rz" or the like.

        Raises:
            ModelError: a coordinate is no finite number, or the name is none.
        """
        draft = self._change()
        given = x if y is None and z is None else (x, y, 0.0 if z is None else z)
        with call("node", name):
            value = points.place(draft, given)  # type: ignore[arg-type]
            made = points.checked_name(name)
            node = points.add_point(draft, value)
            draft.name_node(node.position, made)
        return node

    def pivot(self, node: Point) -> Node:
        """Another point at the position of `node`, with an orientation of its own."""
        draft = self._change()
        return points.pivot(draft, points.position(draft, node))

    def handle(self, position: int, orientation: int = 0) -> Node:
        """The point made of two nodes by their numbers, for a model from a deck.

        Raises:
            ModelError: there is no such node, or it is of the other kind.
        """
        return points.handle(self._change(), position, orientation)

    def point(self, point: Point) -> Node:
        """The point of this name, or at this place.

        Args:
            point: Its name, (x, y, z) [m], within 1e-9 of the model's largest coordinate, a
                handle, or a body, whose first point it is.

        Raises:
            ModelError: there is none, or several have this name; the nearest names are told.
        """
        return points.existing(self._change(), point)


class ElementMethods(PointMethods):
    """Methods that make bars, beams, rigid links, hinges and notches."""

    def truss(
        self,
        p: Point | int,
        q: Point | int,
        name: str = "",
        *,
        section: Section | None = None,
        thickness: Quantity | None = None,
        material: MaterialLike | None = None,
    ) -> Element:
        """A bar: its elongation is held. A number stands for a position node.

        `section` is how it is drawn, see `look`; `thickness` is its diameter [m], and
        `material` gives it stiffness and mass, see `wire`.
        """
        draft = self._change()
        with call("truss", name):
            name = arguments.text(name, "the name of an element")
            shape = sections.round_section(section, thickness)
            make = sections.made_of(self._kind("TRUSS"), shape, material, "bar")
            slots = (points.position(draft, p), 0, points.position(draft, q), 0)
            number = draft.add_element(self._kind("TRUSS"), slots, name, shape=shape)
            draft.give_properties(len(draft.kinds) - 1, make.stiffness, make.mass)
        return Element(number, self._owner)

    def beam(
        self,
        p: Point,
        q: Point,
        y: Direction | None = None,
        release: Iterable[int | str] = (),
        name: str = "",
        *,
        section: Section | None = None,
        material: MaterialLike | None = None,
    ) -> Element:
        """A beam; all deformations are held but those in `release`.

        Args:
            p: One end.
            q: The other end.
            y: Initial direction of the local y axis; by default the global axis that
                is most nearly across the beam. Not for a planar beam.
            release: Deformations that are free: 1 elongation, 2 torsion, 3 and 4 bending
                in the local xz plane, 5 and 6 in the local xy plane at p and q; of a
                planar beam 1 elongation, 2 and 3 bending. Or in words: "elongation",
                "twist", "bending", "bending about y", "bending about z".
            name: What the element is called.
            section: How it is drawn, see `look`.
            material: Gives it stiffness and mass, see `wire`.
        """
        with call("beam", name):
            kind = self._kind("BEAM")
            released = deformations(kind, release)
            make = sections.made_of(kind, shape_of(section), material, "beam")
            element = self._beam(p, q, y, (), name, make)
            index = self._change().index_of(element.number)
            self._change().state_deformations([(index, k) for k in released], Class.DEPENDENT)
            for number in released:
                self._change().set_deformation(index, number, Class.DEPENDENT)
        return element

    def rigid(
        self, p: Point, q: Point, name: str = "", *, section: Section | None = None
    ) -> Element:
        """A rigid link that carries q with p; `body` makes one body of several points.

        It becomes an RBEAM, which holds the position of q alone, unless the orientation
        of q is needed by another element or is given a class, as where q is clamped, or
        the link itself is given a class; then it becomes a BEAM with everything held.
        The deformations of `release` and `independent` are those of a BEAM.
        `section` is how it is drawn, see `look`.
        """
        with call("rigid", name):
            element = self._beam(p, q, None, (), name, Make(shape_of(section)))
        draft = self._change()
        draft.rigid.add(len(draft.kinds) - 1)
        return element

    def hinge(
        self,
        p: Point,
        axis: Direction | None = None,
        q: Node | None = None,
        name: str = "",
        independent: bool = False,
        *,
        stiffness: Quantity | Sequence[Quantity] | None = None,
    ) -> Node:
        """A hinge at p: the rotation about the axis is released, the others are held.

        Args:
            p: The point on one side.
            axis: Direction of the axis; not for a planar model.
            q: The point on the other side, at the same position node; by default a new
                one, as `pivot` makes it.
            name: What the element is called.
            independent: Whether the rotation is a degree of freedom, eq. (6).
            stiffness: Of the rotation [N m/rad], or that and those of the two tilts: ESTIFF in
                a deck. What is not given is free where it is released, and else rigid.

        Returns:
            The point beyond the hinge.
        """
        with call("hinge", name):
            return self._hinge(p, axis, q, name, independent, stiffness).q

    def notch(
        self,
        p: Point,
        axis: Direction | None = None,
        q: Node | None = None,
        name: str = "",
        *,
        independent: bool = False,
        stiffness: Quantity | Sequence[Quantity] | None = None,
    ) -> Notch:
        """A notch at p: all is held but the bending about its axis.

        A notch is so short that it is a hinge at a point: what is fastened to p before it,
        and what is fastened to `notch.q` beyond it, turn about the axis against each other.
        Arguments as of `hinge`.

        Returns:
            The notch, with its points p and q.
        """
        with call("notch", name):
            return self._hinge(p, axis, q, name, independent, stiffness)

    def _hinge(
        self,
        p: Point,
        axis: Direction | None,
        q: Node | None,
        name: str,
        independent: bool,
        stiffness: Quantity | Sequence[Quantity] | None,
    ) -> Notch:
        draft = self._change()
        name = arguments.text(name, "the name of an element")
        given = _of_hinge(stiffness, draft.planar)
        direction = arguments.axis(draft, axis)
        near = points.point(draft, p)
        if q is None:
            q = self.pivot(near)
        elif (q := points.point(draft, q)).position != near.position:
            raise model_error(
                "two-positions",
                "a hinge joins two points at one position node",
                "make the second point with pivot(p), or leave it out",
            )
        slots = (0, near.orientation, 0, q.orientation)
        number = draft.add_element(self._kind("HINGE"), slots, name, direction, (1,))
        draft.give_properties(len(draft.kinds) - 1, given)
        if independent:
            index = draft.index_of(number)
            draft.state_deformations([(index, 1)], Class.INDEPENDENT)
            draft.set_deformation(index, 1, Class.INDEPENDENT)
        return Notch((Element(number, self._owner),), (near, q))

    def _beam(
        self,
        p: Point,
        q: Point,
        y: Direction | None,
        released: tuple[int, ...],
        name: str,
        make: Make,
    ) -> Element:
        draft = self._change()
        if y is not None and draft.planar:
            raise model_error("surplus-vector", "a planar beam takes no y vector")
        hint = NO_VECTOR if y is None else arguments.direction(y, "y vector")
        name = arguments.text(name, "the name of an element")
        a, b = points.point(draft, p), points.point(draft, q)
        slots = (
            points.position(draft, a),
            a.orientation,
            points.position(draft, b),
            b.orientation,
        )
        number = draft.add_element(self._kind("BEAM"), slots, name, hint, released, make.shape)
        draft.give_properties(len(draft.kinds) - 1, make.stiffness, make.mass)
        return Element(number, self._owner)


def _of_hinge(
    stiffness: Quantity | Sequence[Quantity] | None, planar: bool
) -> tuple[float, ...] | None:
    """ESTIFF of a hinge; None where nothing is given."""
    if stiffness is None:
        return None
    what = "the stiffness of a hinge is one number" + ("" if planar else ", or three")
    made = numbers_of_size(stiffness, (1,) if planar else (1, 3), what, "N m/rad")
    if min(made) < 0.0:
        raise model_error("bad-size", "a stiffness is not negative", "give it in N m/rad")
    return made
