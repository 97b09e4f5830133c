# SPDX-License-Identifier: BSD-3-Clause
"""The model: the one meeting point of decks and Python."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import FloatArray, IntArray
from ..core.elements import Class, NodeKind, keywords_of
from ..deck.diagnostics import Diagnostic
from ..deck.rendering import model_error
from ..util.errors import require_kind
from ..util.loading import feature
from ..util.quantities import Quantity
from ..util.records import read_only
from ..util.text import in_short
from ..util.units import METRES, Units, units_of
from . import assemblies, bellows, copies, edits, joints, members
from .arguments import (
    Direction,
    PartLike,
    Point,
    add_point,
    call,
    checked_name,
    drawn_elements,
    existing,
    handle,
    part,
    pivot,
    place,
    text,
    whole,
)
from .arguments import position as position_number
from .configuration import Configuration
from .copies import Names, Parts
from .data import ModelData
from .deformations import give_deformations, means_part
from .draft import Draft
from .draft_arrays import data_of, draft_of
from .handles import (
    Assembly,
    Body,
    Element,
    FoldedSheet,
    Node,
    Notch,
    Part,
    Sheet,
    Wire,
)
from .members import Flexure, Sizes
from .notches import NotchContour
from .parts.parts import surplus_of
from .sections import Make, MaterialLike, Section, shape_of
from .transform import NO_VECTOR
from .variation import held_given, positions_given, with_held, with_positions
from .writing import deck_of

if TYPE_CHECKING:
    from typing_extensions import Unpack


class Model:
    """A mechanism as a finite element model.

    Make parts between points (sheets, wires, bodies, hinges, whole cross hinges and
    guides), say what is fixed and independent, and hand the model to `flexact.analyse`.
    Where a point is wanted, a handle, a name, a place (x, y, z) or a body will do;
    where a part is wanted, its handle or its name. A model that was read from a deck has
    the same methods; `handle` makes points from node numbers. Where [m] stands, a number is in the
    units of the model.

    The arrays are read-only and made once; a change of the model makes new ones and
    leaves the old ones as they are. Nodes are in ascending order of their numbers,
    elements in the order in which they were made or stand in the deck.

    Args:
        planar: A model in the xy plane: two coordinates and one angle a point.
        name: What the model is called in results.
        units: "m" or "mm". With "mm" numbers without a unit are in mm, N, MPa, N mm and N/mm, in
            what is given and in what comes back; densities are in kg/m3, masses in kg. A text says
            its own unit, such as "0.3 mm" or "210 GPa".
    """

    def __init__(
        self, *unnamed: object, planar: bool = False, name: str = "", units: str | Units = METRES
    ) -> None:
        """Start an empty model.

        Raises:
            TypeError: something is given without its name.
            QuantityError: there are no such units.
        """
        if unnamed:
            given = in_short(unnamed[0])
            raise TypeError(
                f"what a Model begins with is named: Model(name={given}), planar=True; the model "
                f"of a deck is flexact.read({given})"
            )
        self._planar = bool(planar)
        self._name = text(name, "the name of a model")
        self._units = units_of(units)
        self._draft: Draft | None = Draft(self._planar, self._units)
        self._data: ModelData | None = None

    @classmethod
    def from_data(cls, data: ModelData) -> Model:
        """A model that starts as these data, such as those of another.

        Raises:
            TypeError: they are no `ModelData`.
        """
        require_kind(data, ModelData, "a model starts as the data of one")
        model = cls.__new__(cls)
        model._planar, model._name = data.planar, data.name
        model._units = data.units
        model._draft, model._data = None, data
        return model

    def __repr__(self) -> str:
        """Name and size."""
        a = self.data.arrays
        kind = "planar model" if self.planar else "model"
        name = f" {self.name!r}" if self.name else ""
        size = f"{a.node_number.size} nodes, {a.element_number.size} elements"
        return f"<flexact {kind}{name}: {size}>"

    def _repr_html_(self) -> str:
        made: str = feature("html")(self.data)
        return made

    def _change(self) -> Draft:
        """The draft, to be changed; arrays that were made are dropped."""
        if self._draft is None:
            self._draft = draft_of(self.data)
        self._data = None
        return self._draft

    @property
    def data(self) -> ModelData:
        """The model as it is now; later changes do not touch it."""
        if self._data is None:
            assert self._draft is not None
            self._data = data_of(self._draft, self._name)
        return self._data

    @property
    def name(self) -> str:
        """What the model is called; the path of a deck."""
        return self._name

    @property
    def units(self) -> str:
        """The units of its numbers, "m" or "mm"."""
        return self._units.name

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

    # Points and parts that are made -----------------------------------------

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
            value = place(draft, given)  # type: ignore[arg-type]
            made = checked_name(name)
            node = add_point(draft, value)
            draft.name_node(node.position, made)
        return node

    def pivot(self, node: Point) -> Node:
        """Another point at the position of `node`, with an orientation of its own."""
        draft = self._change()
        return pivot(draft, position_number(draft, node))

    @contextmanager
    def frame(
        self, at: Point = NO_VECTOR, axis: Direction = "z", degrees: Quantity = 0.0
    ) -> Iterator[None]:
        """A frame of its own for what is said within `with model.frame(at, axis, degrees):`.

        Places, widths, axes, planes, steps, loads and names of coordinates are those of the
        frame. Points by name and handle are where they are, and `Node.place` and all results are
        those of the model. Frames within frames add up.

        Args:
            at: Origin of the frame: a place [m], or a point.
            axis: The axis about which it is turned, "x", "y", "z" or a vector.
            degrees: The angle, right-handed [degrees].

        Raises:
            ModelError: a planar model is turned about another axis than z; or, within, a
                coordinate is named that is not along x, y or z of the model.
        """
        draft = self._change()
        before = draft.frame
        draft.frame = copies.frame(draft, at, axis, degrees)
        try:
            yield
        finally:
            draft.frame = before

    def handle(self, position: int, orientation: int = 0) -> Node:
        """The point made of two nodes by their numbers, for a model from a deck.

        Raises:
            ModelError: there is no such node, or it is of the other kind.
        """
        return handle(self._change(), position, orientation)

    def point(self, point: Point) -> Node:
        """The point of this name, or at this place.

        Args:
            point: Its name, (x, y, z) [m], within 1e-9 of the model's largest coordinate, a
                handle, or a body, whose first point it is.

        Raises:
            ModelError: there is none, or several have this name; the nearest names are told.
        """
        return existing(self._change(), point)

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
        with call("truss", name):
            return members.add_truss(self._change(), p, q, name, section, thickness, material)

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
            return members.add_releasing_beam(
                self._change(), p, q, y, release, name, section, material
            )

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
            return members.add_rigid(
                self._change(), p, q, name, Make(shape_of(self._units, section))
            )

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
        draft = self._change()
        return members.add_hinge(draft, "hinge", p, axis, q, name, independent, stiffness).q

    def notch(
        self,
        p: Point,
        axis: Direction | None = None,
        q: Point | None = None,
        name: str = "",
        *,
        independent: bool = False,
        stiffness: Quantity | Sequence[Quantity] | None = None,
        contour: str | NotchContour | None = None,
        thickness: Quantity | None = None,
        height: Quantity | None = None,
        breadth: Quantity | None = None,
        radius: Quantity | None = None,
        length: Quantity | None = None,
        material: MaterialLike | None = None,
        warping: bool = False,
    ) -> Notch:
        """A notch at p: all is held but the bending about its axis.

        A notch is so short that it is a hinge at a point: what is fastened to p before it,
        and what is fastened to `notch.q` beyond it, turn about the axis against each other.

        With a contour it reaches from p to q: a hinge in its middle, called as the notch, and
        two halves that do not turn, "name, half 1" and "name, half 2". It has the six
        compliances of the contour about its middle, see `flexact.NotchContour`, which tells
        them with what is published. What of it is beyond the contour is rigid.

        Args:
            p: The point on the near side; with a contour the near end.
            axis: Direction of the axis; not for a planar model.
            q: The point on the far side, at the same position node; by default a new one. With a
                contour the far end, at least the length of the contour away.
            name: What it is called.
            independent: Whether the rotation is a degree of freedom.
            stiffness: As of `hinge`; with a contour it follows.
            contour: "circular", "fillet", "elliptic", "parabolic", or a `NotchContour`.
            thickness: At the thinnest [m].
            height: Of the blank [m]; elliptic and parabolic contours need it.
            breadth: Along the axis [m].
            radius: Of a circular contour, or of the fillets [m].
            length: Of any other than a circular contour [m].
            material: Steel by default, see `wire`.
            warping: Whether its ends cannot warp, which makes a broad notch much stiffer in
                torsion, see `NotchContour.held_torsion`.

        Returns:
            The notch, with its points p and q; with a contour it has `pieces`.

        Raises:
            ModelError: something of it is wrong; its text begins with the name of the notch.
        """
        draft = self._change()
        sizes = {"thickness": thickness, "height": height, "breadth": breadth}
        sizes |= {"radius": radius, "length": length}
        with call("notch", name):
            if contour is None:
                members.require_no_contour(sizes, material)
                return members.add_hinge(draft, "notch", p, axis, q, name, independent, stiffness)
            made = members.contour_of(draft, contour, sizes, material, stiffness)
            return members.add_contour_notch(draft, p, axis, q, name, independent, made, warping)

    def wire(
        self,
        p: Point,
        q: Point,
        y: Direction | None = None,
        name: str = "",
        *,
        beams: int = 1,
        section: Section | None = None,
        thickness: Quantity | None = None,
        material: MaterialLike | None = None,
        fillet: Quantity | None = None,
    ) -> Wire:
        """A wire flexure: its elongation is held, torsion and bending are released.

        Args:
            p: One end: a point, its name, or its place (x, y, z) [m].
            q: The other end.
            y: Initial direction of the local y axis.
            name: What the wire is called.
            beams: Into how many equal beams it is divided. The inner deformations are
                declared independent, so that the verdict is that of one beam.
            section: How it is drawn, see `look`: as a rule the diameter [m].
            thickness: The diameter [m], instead of `section`.
            material: "steel", "titanium" or another name of `MATERIALS`, a
                `flexact.Material`, or {"E": ..., "G": ..., "density": ...}. With it the
                beams get ESTIFF (EA, G It, E Iy, E Iz, shear) and EM, which stand in the deck.
            fillet: See `sheet`.

        Raises:
            ModelError: something of it is wrong; its text begins with the name of the wire.
        """
        draft = self._change()
        sizes = Sizes(section, thickness, material, fillet=fillet)
        return members.add_wire(draft, p, q, y, name, beams, sizes)

    def sheet(
        self,
        p: Point,
        q: Point,
        width: Direction | None = None,
        beams: int = 1,
        name: str = "",
        *,
        section: Sequence[Quantity] | None = None,
        thickness: Quantity | None = None,
        breadth: Quantity | None = None,
        material: MaterialLike | None = None,
        warping: bool | float = False,
        reinforced: float | Sequence[Quantity] | None = None,
        tapered: Section | None = None,
        fillet: Quantity | None = None,
    ) -> Sheet:
        """A sheet flexure: elongation and in-plane bending are held, the rest released.

        The local z axis of its beams lies in the plane of the sheet, as in section 4.2
        of the paper, so that deformations 3 and 4 are the in-plane bending.

        Args:
            p: One end: a point, its name, or its place (x, y, z) [m].
            q: The other end.
            width: Direction of the width, from edge to edge: a vector, or "x", "y", "z". A
                planar model sees the sheet from its side and takes no width.
            beams: Into how many equal beams the sheet is divided. The inner deformations
                are declared independent, so that the verdict is that of one beam.
            name: What the sheet is called.
            section: Breadth (along the width) and thickness [m].
            thickness: The thickness [m], instead of `section`.
            breadth: The size along the width [m], instead of `section`.
            material: Gives stiffness and mass, see `wire`.
            warping: False: the ends are free to warp. True: they are clamped and cannot, which
                raises G It by `flexact.model.sections.warping_factor`; a number is the factor.
            reinforced: The share of its length that is thick in the middle, such as 0.7: a
                rigid body between two sheets, called "name, leaf 1", "name, middle" and "name,
                leaf 2". The handle is a `ReinforcedSheet`. How the middle moves while both
                ends stand still is declared, so that the verdict is that of one sheet;
                thickness and material are those of the leaves. With the thickness of the
                middle [m], (0.7, 4e-3), the middle is a beam of that thickness, and the whole is
                a divided sheet like any other, a `Sheet`.
            tapered: The thickness at q [m], or breadth and thickness there, to which those at p
                go evenly; a divided sheet of 16 beams where `beams` is 1.
            fillet: Radius of the fillets at its clamped ends [m]. It raises the peak stress
                (`flexact.model.notches.stress_factor`), and changes no stiffness.

        Raises:
            ModelError: something of it is wrong; its text begins with the name of the sheet.
        """
        sizes = Sizes(section, thickness, material, breadth, warping, reinforced, tapered, fillet)
        return members.add_sheet(self._change(), p, q, width, beams, name, sizes)

    def folded_sheet(
        self,
        a: Point,
        fold: Point,
        b: Point,
        width: Direction | None = None,
        name: str = "",
        *,
        beams: int = 1,
        section: Sequence[Quantity] | None = None,
        thickness: Quantity | None = None,
        breadth: Quantity | None = None,
        material: MaterialLike | None = None,
        warping: bool | float = False,
        fillet: Quantity | None = None,
    ) -> FoldedSheet:
        """A folded sheet: two sheets in series, which take one translation, along the fold.

        The fold can turn about itself while both ends stand still: this internal motion is
        declared, as the bending of the first leaf at the fold (section 4.2 of the paper).

        Args:
            a: One end: a point, its name, or its place (x, y, z) [m].
            fold: Where the leaves meet.
            b: The other end.
            width: Direction of the fold line; by default normal to the plane of the points.
            name: What it is called; its leaves are "name, leaf 1" and "name, leaf 2", the
                point where they meet is "name, fold".
            beams: Into how many beams each leaf is divided, see `sheet`.
            section: Breadth (along the fold line) and thickness [m].
            thickness: The thickness [m], instead of `section`.
            breadth: The size along the fold line [m], instead of `section`.
            material: See `wire`.
            warping: Of each leaf, see `sheet`.
            fillet: Of each leaf, see `sheet`.

        Raises:
            ModelError: something of it is wrong, such as three points on a line and no width.
        """
        sizes = Sizes(section, thickness, material, breadth, warping, fillet=fillet)
        return members.add_folded_sheet(self._change(), (a, fold, b), width, beams, name, sizes)

    def body(
        self,
        points: Iterable[Point],
        name: str = "",
        *,
        mass: Quantity | None = None,
        inertia: Quantity | Sequence[Quantity] | None = None,
        section: Section | None = None,
        shape: str | None = None,
        thickness: Quantity | None = None,
        material: MaterialLike | None = None,
    ) -> Body:
        """One rigid body through any points.

        Rigid links carry the points with the first of them, as `rigid` makes them. A point
        that is carried already gets no second link; a body among the points is made larger,
        and keeps its name where none is given.

        Args:
            points: Points, their names, their places (x, y, z) [m], or bodies.
            name: What the body is called; its links are "stage, 1", "stage, 2", ...
            mass: Mass [kg], at the first point: give the centre of mass first.
            inertia: Moments of inertia there [kg m2]: Jxx, Jyy, Jzz, or Jxx, Jxy, Jxz, Jyy,
                Jyz, Jzz; in a planar model one number.
            section: How the links are drawn, see `look`.
            shape: As what it is drawn, "disc", "box" or "hull", see `Appearance.body_shape`. It is
                kept with the model and its copies; a deck has no word for it.
            thickness: Of that shape [m].
            material: What it is made of, which says how it expands where it is warm (see `wire`);
                its mass is given by itself.

        Raises:
            ModelError: something of it is wrong; its text begins with the name of the body.
        """
        looks, draft = (shape, thickness), self._change()
        made = assemblies.add_body(draft, points, name, (mass, inertia), section, looks)
        if material is not None:
            with call("body", name):
                edits.make_of(draft, made, material, None, None, None, False)
        return made

    def cross_hinge(
        self,
        ground: Iterable[Point],
        moving: Iterable[Point],
        width: Direction | None = None,
        name: str = "",
        *,
        carries: Iterable[Point] = (),
        mass: Quantity | None = None,
        inertia: Quantity | Sequence[Quantity] | None = None,
        beams: int = 1,
        section: Sequence[Quantity] | None = None,
        thickness: Quantity | None = None,
        breadth: Quantity | None = None,
        material: MaterialLike | None = None,
        warping: bool | float = False,
        fillet: Quantity | None = None,
    ) -> Assembly:
        """A cross hinge: two, three or more sheets that cross, and the body that they carry.

        The k-th sheet goes from the k-th point of `ground` to the k-th of `moving`. The body
        turns about the line in which the sheets cross. Nothing is clamped: say
        `fix(*hinge.ground)`, or give the points to a body.

        Args:
            ground: Points on the near side, one a sheet.
            moving: Points on the body, one a sheet.
            width: Direction of the width of the sheets, which is that of the axis; by default
                normal to the first two sheets.
            name: What it is called: its parts are "name sheet 1", ..., "name body".
            carries: Further points of the body.
            mass: Of the body [kg], at its first point, see `body`.
            inertia: Of the body, see `body`.
            beams: Into how many beams each sheet is divided.
            section: Breadth and thickness of the sheets [m].
            thickness: The thickness [m], instead of `section`.
            breadth: The size along the axis [m], instead of `section`.
            material: See `wire`.
            warping: See `sheet`.
            fillet: See `sheet`.

        Returns:
            Parts "sheet 1", ..., "body" and points "ground 1", ..., "body 1", ...
        """
        sizes = Sizes(section, thickness, material, breadth, warping, fillet=fillet)
        return assemblies.add_cross_hinge(
            self._change(), (ground, moving), width, name, carries, (mass, inertia), beams, sizes
        )

    def parallel_guide(
        self,
        p: Point,
        q: Point,
        offset: Sequence[Quantity],
        width: Direction | None = None,
        name: str = "",
        *,
        sheets: int = 2,
        carries: Iterable[Point] = (),
        mass: Quantity | None = None,
        inertia: Quantity | Sequence[Quantity] | None = None,
        beams: int = 1,
        section: Sequence[Quantity] | None = None,
        thickness: Quantity | None = None,
        breadth: Quantity | None = None,
        material: MaterialLike | None = None,
        warping: bool | float = False,
        fillet: Quantity | None = None,
    ) -> Assembly:
        """A parallel guide: equal sheets side by side, and the stage that they carry.

        The stage moves along the normal of the sheets. Nothing is clamped: say
        `fix(*guide.ground)`, or give the points to a body.

        Args:
            p: The near end of the first sheet: a point, its name, or its place [m].
            q: Its end on the stage.
            offset: From each sheet to the next, (x, y, z) [m].
            width: Direction of the width; by default normal to the sheet and the offset.
            name: What it is called: its parts are "name sheet 1", ..., "name stage".
            sheets: How many sheets there are, two or more.
            carries: Further points of the stage.
            mass: Of the stage [kg], see `body`.
            inertia: Of the stage, see `body`.
            beams: Into how many beams each sheet is divided.
            section: Breadth and thickness of the sheets [m].
            thickness: The thickness [m], instead of `section`.
            breadth: The size along the width [m], instead of `section`.
            material: See `wire`.
            warping: See `sheet`.
            fillet: See `sheet`.

        Returns:
            Parts "sheet 1", ..., "stage" and points "ground 1", ..., "stage 1", ...
        """
        sizes = Sizes(section, thickness, material, breadth, warping, fillet=fillet)
        return assemblies.add_parallel_guide(
            self._change(),
            (p, q),
            offset,
            width,
            name,
            sheets,
            carries,
            (mass, inertia),
            beams,
            sizes,
        )

    def hexapod(
        self,
        base: Quantity | Iterable[Point],
        platform: Quantity | Iterable[Point],
        height: Quantity | None = None,
        name: str = "",
        *,
        spread: Quantity | Sequence[Quantity] = 0.0,
        at: Sequence[Quantity] = (0.0, 0.0, 0.0),
        carries: Iterable[Point] = (),
        mass: Quantity | None = None,
        inertia: Quantity | Sequence[Quantity] | None = None,
        beams: int = 1,
        section: Quantity | Sequence[Quantity] | None = None,
        thickness: Quantity | None = None,
        material: MaterialLike | None = None,
    ) -> Assembly:
        """A hexapod: six wires that hold a platform once in each of its six motions.

        With radii the wires zigzag about the z axis: their base ends lie in pairs at 0, 120
        and 240 degrees, their platform ends at 60, 180 and 300 degrees. Nothing is clamped:
        say `fix(*hexapod.ground)`.

        Args:
            base: Radius of the base ends [m], or six points (three: each for two wires).
            platform: Radius of the platform ends [m], or six points, or three.
            height: From the base to the platform [m], with radii.
            name: What it is called: its parts are "name wire 1", ..., "name platform".
            spread: Angle between the two wires of a pair [degrees], with radii; of the base
                and of the platform where two are given.
            at: Centre of the base [m], with radii.
            carries: Further points of the platform.
            mass: Of the platform [kg], see `body`.
            inertia: Of the platform, see `body`.
            beams: Into how many beams each wire is divided.
            section: How the wires are drawn, as a rule their diameter [m].
            thickness: The diameter [m], instead of `section`.
            material: See `wire`.

        Returns:
            Parts "wire 1", ..., "wire 6", "platform" and points "ground 1", ..., "platform 1", ...
        """
        ends = base, platform
        wires = Sizes(section, thickness, material)
        return assemblies.add_hexapod(
            self._change(), ends, height, name, spread, at, carries, (mass, inertia), beams, wires
        )

    # Hinges, struts and mounts ----------------------------------------------
    # `flexures` are those of `sheet`: beams, section, thickness, breadth, material, warping,
    # reinforced, tapered, fillet. Nothing is clamped, and masses are given with
    # `body([hinge.body], mass=...)`.

    def cartwheel(
        self,
        ground: Iterable[Point],
        moving: Iterable[Point],
        width: Direction | None = None,
        name: str = "",
        *,
        carries: Iterable[Point] = (),
        **flexures: Unpack[Flexure],
    ) -> Assembly:
        """A cartwheel hinge: sheets that cross as in `cross_hinge`, joined where they meet.

        Each sheet is two half sheets in series, with a small body between them at the centre.
        That this turns while both ends stand still is declared, as a bending at the centre.

        Args:
            ground: Points on the near side, one a sheet.
            moving: Points on the body, one a sheet; the lines between them meet in one point.
            width: Direction of the width, which is that of the axis; by default normal to the
                first two sheets.
            name: What it is called: its parts are "name near sheet 1", ..., "name body".
            carries: Further points of the body.
            **flexures: What the half sheets are made of, see `sheet`.

        Returns:
            Parts "near sheet 1", ..., "far sheet 1", ..., "body"; points "ground 1", ...,
            "body 1", ..., "centre".

        Raises:
            ModelError: the sheets do not cross in one line.
        """
        sides = ground, moving
        return joints.add_cartwheel(self._change(), sides, width, name, carries, flexures)

    def infinity_hinge(
        self,
        p: Point,
        q: Point,
        width: Direction,
        name: str = "",
        *,
        aside: Quantity | None = None,
        carries: Iterable[Point] = (),
        **flexures: Unpack[Flexure],
    ) -> Assembly:
        """A hinge of a sheet, a folded sheet that stiffens its twist, and a wire across.

        One stage of the infinity hinge (Wiersma, Boer, Aarts and Brouwer 2014), as
        dspe.nl/knowledge describes it: the sheet bends about its width, the folded sheet beside it
        holds its twist, the wire its going aside. Two stages in series bend half as much each.
        The body turns about the middle of the sheet, and is held once in all else.

        Args:
            p: The near end of the sheet: a point, its name, or its place [m].
            q: Its end on the body.
            width: Direction of its width, which is that of the axis.
            name: What it is called: its parts are "name sheet 1", "name folded sheet 1", "name
                wire 1", "name body".
            aside: How far along the axis the folded sheet is from the sheet, and on the other
                side the wire [m]; by default the length of the sheet.
            carries: Further points of the body.
            **flexures: What the flexures are made of, see `sheet`; the wire is as thick.
        """
        draft, ends = self._change(), (p, q)
        return joints.add_infinity_hinge(draft, ends, width, aside, name, carries, flexures)

    def folded_hinge(
        self,
        radius: Quantity,
        name: str = "",
        *,
        sheets: int = 3,
        tilt: Quantity = 45.0,
        arm: Quantity | None = None,
        carries: Iterable[Point] = (),
        **flexures: Unpack[Flexure],
    ) -> Assembly:
        """A ball joint of folded sheets about z, whose fold lines meet in the origin.

        Each folded sheet takes the translation along its fold line; three hold the point in which
        the lines meet, about which the body turns. M. P. Koster, Constructieprincipes, has it with
        four. With `frame` it stands elsewhere.

        Args:
            radius: Distance of the folds from the centre [m].
            name: What it is called: its parts are "name folded sheet 1", ..., "name body".
            sheets: How many folded sheets there are, three or more.
            tilt: Angle of the fold lines with the xy plane, between 0 and 90 [degrees].
            arm: Length of each leaf [m]; by default half of the radius.
            carries: Further points of the body.
            **flexures: What the folded sheets are made of, see `folded_sheet`.
        """
        draft = self._change()
        return joints.add_folded_hinge(draft, radius, tilt, arm, sheets, name, carries, flexures)

    def universal_joint(
        self,
        p: Point,
        axes: Sequence[Direction] = ("x", "y"),
        q: Point | None = None,
        name: str = "",
    ) -> Assembly:
        """A universal joint: two notches in series whose axes cross.

        What is fastened to p and to `joint["q"]` turns about both axes against each other.

        Args:
            p: The point on the near side, where the first notch is.
            axes: Directions of the axes of the first and the second notch.
            q: The point on the far side, where the second notch is, with a rigid body between
                the two; by default both are at p.
            name: What it is called: its parts are "name notch 1", "name notch 2" and "name
                intermediate body".

        Returns:
            The parts; points "p" and "q".
        """
        return joints.add_universal_joint(self._change(), p, axes, q, name)

    def strut(
        self, p: Point, q: Point, ends: str | Sequence[str] = "spherical", name: str = ""
    ) -> Assembly:
        """A strut: a rigid bar between two points, with notches at both ends.

        "spherical" is a neck, round and thin, that bends and twists; "universal" are two crossed
        notches. With one end of each, or two necks, the strut holds the distance of the points;
        with two universal ends also the rotation about itself. The rotation of a strut between
        two necks about itself is declared.

        Args:
            p: One end: a point, its name, or its place [m].
            q: The other end.
            ends: "spherical" or "universal", or that of each end.
            name: What it is called: its parts are "name notch 1", ..., "name bar".
        """
        return joints.add_strut(self._change(), p, q, ends, name)

    def bellows(
        self,
        p: Point,
        q: Point,
        y: Direction | None = None,
        name: str = "",
        *,
        diameter: Quantity,
        thickness: Quantity | None = None,
        depth: Quantity | None = None,
        pitch: Quantity | None = None,
        material: MaterialLike = "steel",
    ) -> Element:
        """A metal bellows: its twist is held, everything else is released.

        It is a beam with the stiffness along, in bending and in twist, and the mass, of its
        convolutions, by the formulas of `flexact.model.bellows`; it is drawn as its outer cylinder.

        Args:
            p: One end: a point, its name, or its place (x, y, z) [m].
            q: The other end.
            y: Initial direction of the local y axis.
            name: What it is called.
            diameter: The outer one [m].
            thickness: Of the wall [m]; by default a thirtieth of the depth.
            depth: Of the convolutions [m]; by default 0.15 of the diameter.
            pitch: From one convolution to the next [m]; by default as much as they are deep.
            material: Steel by default, see `wire`.

        Raises:
            ModelError: something of it is wrong; its text begins with the name of the bellows.
        """
        sizes = {"diameter": diameter, "thickness": thickness, "depth": depth, "pitch": pitch}
        return bellows.add_bellows(self._change(), p, q, y, name, sizes, material)

    def bipod(
        self,
        feet: Iterable[Point],
        apex: Point,
        name: str = "",
        *,
        reach: float = 1.0,
        ends: str | Sequence[str] = "spherical",
        carries: Iterable[Point] = (),
    ) -> Assembly:
        """A bipod: two struts towards one point of a body, which they hold along their lines.

        Args:
            feet: Two points on the ground.
            apex: The point of the body where their lines meet.
            name: What it is called: its parts are "name strut 1 bar", ..., "name body".
            reach: The share of the way to the apex that the struts go.
            ends: Notches at the ends of the struts, see `strut`.
            carries: Further points of the body.
        """
        return joints.add_bipod(self._change(), feet, apex, reach, ends, name, carries)

    def vee(
        self,
        at: Point,
        groove: Direction,
        length: Quantity,
        name: str = "",
        *,
        up: Direction = "z",
        opening: Quantity = 90.0,
        **flexures: Unpack[Flexure],
    ) -> Assembly:
        """A ball in a groove: two bars along the normals of its flanks, which meet in the ball.

        Args:
            at: Centre of the ball: a point, its name, or its place [m].
            groove: Direction of the groove, along which the ball is free.
            length: Of the bars, from the ground to the ball [m].
            name: What it is called: its parts are "name contact 1" and "name contact 2".
            up: Direction in which the groove opens, made normal to it.
            opening: Angle between the flanks [degrees].
            **flexures: `thickness`, the diameter of the bars [m], and `material`.

        Returns:
            The parts; points "ground 1", "ground 2" and "ball".
        """
        return joints.add_vee(self._change(), at, groove, up, length, opening, name, flexures)

    def kinematic_mount(
        self,
        radius: Quantity,
        length: Quantity,
        name: str = "",
        *,
        turned: Quantity = 0.0,
        opening: Quantity = 90.0,
        carries: Iterable[Point] = (),
        **flexures: Unpack[Flexure],
    ) -> Assembly:
        """A plate whose three balls lie in grooves that point to the z axis: held once in all.

        Args:
            radius: Of the circle of the balls in the xy plane [m].
            length: Of the bars of each vee [m].
            name: What it is called: its parts are "name contact 1", ..., "name plate".
            turned: Angle of each groove with the radius [degrees]; 90 is the wrong way.
            opening: Angle between the flanks [degrees].
            carries: Further points of the plate.
            **flexures: `thickness`, the diameter of the bars [m], and `material`.
        """
        return joints.add_kinematic_mount(
            self._change(), radius, length, turned, opening, name, carries, flexures
        )

    def spider(
        self,
        outer: Quantity,
        inner: Quantity,
        arms: int = 3,
        layout: str = "radial",
        name: str = "",
        *,
        carries: Iterable[Point] = (),
        **flexures: Unpack[Flexure],
    ) -> Assembly:
        """A hub on flat arms about z: each holds it in the xy plane, three motions.

        Args:
            outer: Radius of the clamps [m].
            inner: Radius of the hub [m].
            arms: How many there are, two or more.
            layout: How they lie in the plane: "radial", "tangential" to the hub, or "folded": from
                the hub outwards and then, at right angles, to the clamp. How the corner of a
                folded arm leaves the plane is declared.
            name: What it is called: its parts are "name arm 1", ..., "name hub".
            carries: Further points of the hub.
            **flexures: What the arms are made of, see `sheet`.
        """
        radii = outer, inner
        return joints.add_spider(self._change(), radii, arms, layout, name, carries, flexures)

    def diaphragm(
        self,
        outer: Quantity,
        inner: Quantity,
        sheets: int = 12,
        name: str = "",
        *,
        wires: bool = False,
        carries: Iterable[Point] = (),
        **flexures: Unpack[Flexure],
    ) -> Assembly:
        """A membrane about z, as flat radial sheets between its ring and its hub.

        As a membrane does, they hold x, y and the rotation about z.

        Args:
            outer: Radius of the ring [m].
            inner: Radius of the hub [m].
            sheets: How many there are, three or more.
            name: What it is called: its parts are "name sheet 1", ..., "name ring", "name hub".
            wires: Whether they are wires, which hold x and y alone.
            carries: Further points of the hub.
            **flexures: What they are made of, see `sheet` and `wire`.

        Returns:
            The parts and points; `ground` is one point of the ring, so that `fix` clamps it once.
        """
        radii = outer, inner
        return joints.add_diaphragm(self._change(), radii, sheets, wires, name, carries, flexures)

    # What is said of them ---------------------------------------------------

    def fix(self, *points: Point | int) -> None:
        """Fix points, or coordinates of them, eq. (7): a support.

        `fix(a, b)` clamps both points, `fix(a, "x", "y")` fixes two coordinates of one.

        Args:
            *points: Points, their names or places, bodies, or numbers of nodes; then names of
                coordinates out of x, y, z, rx, ry, rz, by default all that there are.

        Raises:
            ModelError: there is no such point or coordinate, or it has another class.
        """
        draft = self._change()
        targets, names = edits.fixed_targets(draft, points)
        with call("fix", targets[0] if len(targets) == 1 else ""):
            edits.give_coordinates(draft, targets, names, Class.FIXED)

    def independent(
        self,
        target: Point | PartLike | FoldedSheet,
        *which: str | int,
        at: Point | None = None,
    ) -> None:
        """Make coordinates or deformations independent: degrees of freedom, eq. (6).

        `independent("stage", "y")`, `independent("sheet 1", "out-of-plane bending", at=fold)`.

        Args:
            target: A point or a part, by handle or name, or a place; or a number, of a node
                where coordinates are named, of an element where deformations are numbered.
            *which: Coordinates by name, or deformations by word or number; by default all.
            at: The end of a part at which it bends, see `release`.
        """
        draft = self._change()
        with call("independent", target):
            if at is not None or means_part(draft, target, which):
                give_deformations(draft, target, which, Class.INDEPENDENT, at)
            else:
                edits.give_coordinates(draft, [target], which, Class.INDEPENDENT)

    def release(
        self, part: PartLike | FoldedSheet, *which: str | int, at: Point | None = None
    ) -> None:
        """Release deformations, by default all: they are free to change.

        A sheet of several beams is released as one beam would be: bending at p in its first
        beam, at q in its last one, elongation and twist in one beam alone.

        Args:
            part: A part, its name, or the number of an element.
            *which: "elongation", "twist", "in-plane bending" (which a sheet holds),
                "out-of-plane bending", "bending", "bending about y" or "about z" (local
                axes); of a hinge "rotation", "tilt"; or numbers, from 1.
            at: The end at which it bends: a point, its name, the body there, "p" or "q"; by
                default both.

        Raises:
            ModelError: the part has no such deformation, does not end there, or the deformation
                is independent.
        """
        with call("release", part):
            give_deformations(self._change(), part, which, Class.DEPENDENT, at)

    def hold(
        self, part: PartLike | FoldedSheet, *which: str | int, at: Point | None = None
    ) -> None:
        """Hold deformations, by default all: takes a release or an independent one back.

        Arguments and errors as of `release`.
        """
        with call("hold", part):
            give_deformations(self._change(), part, which, Class.FIXED, at)

    def clear(self, point: Point | int, *names: str) -> None:
        """Take back what `fix` and `independent` said of a point: it is free to move.

        Args:
            point: A point, its name or place, or the number of a node.
            *names: Coordinates out of x, y, z, rx, ry, rz; by default all.
        """
        with call("clear", point):
            edits.clear_coordinates(self._change(), point, names)

    def declare_internal_motions(self) -> None:
        """Make independent what is inside divided sheets and wires, so that each is one beam.

        Of each deformation that several beams of one sheet or wire release, that of the first
        stays released; see `Result.internal_motions`.
        """
        for element, deformations in surplus_of(self.data):
            self._change().declare(element, deformations)

    def force(
        self,
        point: Point | int,
        x: Quantity | Sequence[Quantity],
        y: Quantity | None = None,
        z: Quantity | None = None,
        *,
        increment: bool = False,
    ) -> None:
        """Give a point a force [N], in place of the one that it had: XF in a deck.

        Args:
            point: A point, its name or place, a body, or the number of a position node.
            x: Its component along x, or all of them.
            y: Its component along y.
            z: Its component along z, 0 by default; not in a planar model.
            increment: Whether it is added to another in the course of loading: DELXF.

        Raises:
            ModelError: there is no such point, or a component is no finite number.
        """
        draft = self._change()
        with call("force", point):
            node = edits.node_with(draft, point, wants_position=True)
            made = edits.load(draft, x, y, z, "force", "N")
        (draft.increment if increment else draft.force)[node] = made

    def moment(
        self,
        point: Point | int,
        x: Quantity | Sequence[Quantity],
        y: Quantity | None = None,
        z: Quantity | None = None,
        *,
        increment: bool = False,
    ) -> None:
        """Give a point a moment [N m], in place of the one that it had: XF of its orientation.

        It works on small rotations about fixed axes: it does not turn with the point.

        Args:
            point: A point, its name or place, a body, or the number of an orientation node.
            x: Its component about x, or all of them; in a planar model the moment about z.
            y: Its component about y.
            z: Its component about z, 0 by default.
            increment: Whether it is added to another in the course of loading: DELXF.

        Raises:
            ModelError: there is no such point, or a component is no finite number.
        """
        draft = self._change()
        with call("moment", point):
            node = edits.node_with(draft, point, wants_position=False)
            made = edits.moment(draft, node, x, y, z)
        (draft.increment if increment else draft.force)[node] = made

    def gravity(
        self, x: Quantity | Sequence[Quantity], y: Quantity | None = None, z: Quantity | None = None
    ) -> None:
        """Give the acceleration of free fall [m/s2]: GRAVITY in a deck.

        Copies and `rotate` leave it as it is.

        Args:
            x: Its component along x, or all of them.
            y: Its component along y.
            z: Its component along z, 0 by default; not in a planar model.

        Raises:
            ModelError: a component is no finite number.
        """
        draft = self._change()
        draft.gravity = edits.load(draft, x, y, z, "acceleration", "m/s2")

    def made_of(
        self,
        target: PartLike | FoldedSheet | Assembly,
        material: MaterialLike | None = None,
        *,
        section: Section | None = None,
        thickness: Quantity | None = None,
        breadth: Quantity | None = None,
        warping: bool | float = False,
    ) -> None:
        """Say what flexures are made of: section and material of parts that are there.

        Args:
            target: A part, its name, a folded sheet, or an assembly, all of whose flexures
                it is said of; of a body the material says how it expands.
            material: See `wire`.
            section: Breadth and thickness of sheets; diameter or two sizes of others [m].
            thickness: Of a sheet, or the diameter of a wire [m].
            breadth: The size of a sheet along its width [m].
            warping: Of sheets, see `sheet`.
        """
        with call("made_of", target):
            edits.make_of(self._change(), target, material, section, thickness, breadth, warping)

    def look(
        self,
        target: PartLike | Node | FoldedSheet | Assembly,
        *,
        section: Section | None = None,
        colour: Sequence[float] | None = None,
        edge_colour: Sequence[float] | None = None,
        opacity: float | None = None,
        drawn: bool | None = None,
    ) -> None:
        """Say how elements are drawn; the analysis does not use it.

        What is not given stays as it was.

        Args:
            target: A part (each of its elements), its name, the point beyond a hinge, or
                an element's number.
            section: A diameter, or the sizes along the local y and z axes [m]; of a sheet
                its width and its thickness, whatever its local axes are.
            colour: Red, green and blue, from 0 to 1.
            edge_colour: The same for edges.
            opacity: From 0, invisible, to 1.
            drawn: Whether it is drawn at all.

        Raises:
            ModelError: something of it is wrong; then nothing has changed.
        """
        draft = self._change()
        with call("look", target):
            edits.give_looks(draft, target, section, colour, edge_colour, opacity, drawn)

    # Changes and copies -----------------------------------------------------

    def part(self, name: PartLike) -> Part | Element:
        """The part with this name, or the element with this number.

        Raises:
            ModelError: there is none, or several have this name; the nearest names are told.
        """
        return part(self._change(), name)

    def move(self, point: Point, to: Sequence[Quantity]) -> None:
        """Move a point to another place [m]; what ends there ends at the new place.

        A width or axis that was given stays as it is, and inner points of divided flexures
        are put on the straight line between their ends again.

        Raises:
            ModelError: there is no such point, or it is no place.
        """
        draft = self._change()
        with call("move", point):
            number = existing(draft, point).position
            value = place(draft, to)
        edits.move_node(draft, number, value)

    def rename(self, target: Point | PartLike | FoldedSheet, name: str) -> None:
        """Give a point or a part another name; of a part every beam and link.

        Raises:
            ModelError: there is no such point or part, or the name is none.
        """
        draft = self._change()
        with call("rename", target):
            if edits.names_part(draft, target):
                edits.rename_part(draft, target, text(name, "the name of a part"))
            else:
                draft.name_node(existing(draft, target).position, checked_name(name))

    def delete(
        self, target: Point | PartLike | FoldedSheet | Assembly, *, ends: bool = False
    ) -> None:
        """Delete a part with its inner points, or a point that no part uses.

        Args:
            target: The part or the point.
            ends: Whether ends of a part go with it where no other part uses them; else they stay.

        Raises:
            ModelError: there is no such point or part, or parts use the point.
        """
        draft = self._change()
        with call("delete", target):
            if edits.names_part(draft, target):
                edits.delete_elements(draft, drawn_elements(draft, target), ends)
            else:
                edits.delete_point(draft, existing(draft, target))

    def insert(
        self,
        model: Model,
        at: Point = NO_VECTOR,
        *,
        axis: Direction = "z",
        degrees: Quantity = 0.0,
        names: Names | None = None,
        join: bool | Quantity = True,
    ) -> Assembly:
        """Put a copy of another model into this one, turned and then moved.

        Args:
            model: The model, which stays as it is.
            at: Where its origin comes to lie [m].
            axis: The axis through its origin about which it is turned first.
            degrees: The angle [degrees].
            names: How its names are changed: "upper {}", or {"old word": "new word"}. A name
                that is taken gets " (2)".
            join: Whether points that come to lie at a point of this model, within rounding,
                become that point; or the distance within which they do [m].

        Returns:
            Its parts and points by the names that they have in `model`.

        Raises:
            ModelError: one model is planar and the other is not, or a class of single
                coordinates is not along x, y or z any more.
        """
        if model is self:
            raise model_error("same-model", "a model cannot be inserted into itself", "pattern it")
        if not isinstance(model, Model):
            raise model_error("not-a-model", f"a model is wanted, not {in_short(model)}")
        source, target = model._change(), self._change()
        return copies.insert(target, source, at, axis, degrees, names, join)

    def pattern(
        self,
        n: int,
        axis: Direction = "z",
        *,
        at: Point = NO_VECTOR,
        degrees: Quantity | None = None,
        step: Sequence[Quantity] | None = None,
        parts: Parts | None = None,
        names: Names | None = None,
        join: bool | Quantity = True,
    ) -> tuple[Assembly, ...]:
        """Repeat parts n times in all, about an axis or, with `step`, in a row.

        Supports and other classes are copied, too. What comes to lie on itself, such as a
        point on the axis, is not copied but shared.

        Args:
            n: How many there are in the end, with the originals.
            axis: The axis, "x", "y", "z" or a vector.
            at: A point of the axis [m].
            degrees: The angle from each to the next; by default 360/n.
            step: The way from each to the next [m], instead of an angle.
            parts: Which parts, by handle or name; by default the whole model as it is.
            names: How names of copies are made: "{} {}" gives "sheet 1", "sheet 2", ..., the
                original included; by default copies are "sheet (2)", "sheet (3)", ...
            join: See `insert`.

        Returns:
            The originals and each copy, with parts and points by the names of the originals.
        """
        return copies.pattern(self._change(), n, axis, at, degrees, step, parts, names, join)

    def mirror(
        self,
        plane: Direction,
        *,
        at: Point = NO_VECTOR,
        parts: Parts | None = None,
        names: Names | None = None,
        join: bool | Quantity = True,
    ) -> Assembly:
        """Add the mirror image of parts in a plane.

        What comes to lie on itself, such as a point in the plane, is not copied but shared.

        Args:
            plane: "xy", "yz", "zx", or the normal of the plane as a vector.
            at: A point of the plane [m].
            parts: Which parts, by handle or name; by default the whole model as it is.
            names: How names of the image are made, such as {"left": "right"}; see `insert`.
            join: See `insert`.

        Returns:
            The image, with parts and points by the names of the originals.
        """
        return copies.mirror(self._change(), plane, at, parts, names, join)

    def rotate(self, axis: Direction, degrees: Quantity, *, at: Point = NO_VECTOR) -> None:
        """Turn the whole model about an axis through a point.

        Args:
            axis: "x", "y", "z" or a vector.
            degrees: The angle, right-handed [degrees].
            at: A point of the axis [m].

        Raises:
            ModelError: a class of single coordinates is not along x, y or z any more.
        """
        copies.rotate(self._change(), axis, degrees, at)

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

    # The arrays -------------------------------------------------------------

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
        if not self._units.power:
            return self.data.arrays.node_value.T
        a = self.data.arrays
        places = (a.node_kind <= NodeKind.POSITION)[:, None]
        value = a.node_value.T
        return read_only(np.where(places, self._units.shown(value, "m"), value))

    @property
    def positions(self) -> FloatArray:
        """(nodes, 3) reference positions [m]; zero for nodes that are orientations."""
        a = self.data.arrays
        places = (a.node_kind <= NodeKind.POSITION)[:, None]
        shown = self._units.shown(a.node_value.T[:, :3], "m")
        return read_only(np.where(places, shown, 0.0))

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
        return read_only(self.data.arrays.element_node.T - 1)

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
