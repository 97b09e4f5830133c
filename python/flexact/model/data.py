# SPDX-License-Identifier: BSD-3-Clause
"""A model that does not change: arrays, names, looks, loads, and what was found in them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from enum import IntEnum
from typing import Any

import numpy as np

from ..core import calls
from ..core.arrays import (
    BoolArray,
    FloatArray,
    IndexArray,
    IntArray,
    ModelArrays,
    PackedModel,
    packed,
)
from ..core.elements import Member, NodeKind, coordinate_name, member_table
from ..core.raw import RawCount, RawFrames
from ..deck.diagnostics import Diagnostic, Problems, Severity, Source, decode, problems_of, warning
from ..deck.rendering import DeckError, ModelError
from ..util.records import Frozen, cached_property
from ..util.units import METRES, Units
from .names import part_name
from .parts.chains import Chain, chains_of, directions_across
from .parts.forms import Form, forms_of, is_member


class CrossSection(IntEnum):
    """Shape of a member's cross-section, as CROSSTYPE names it."""

    NONE = 0
    RECT = 1
    CIRC = 2
    RECTHOL = 3
    CIRCHOL = 4
    LINE = 5


class BodyShape(IntEnum):
    """As what a rigid body is drawn, where its maker says it; no deck has a word for it."""

    NONE = 0
    HULL = 1
    BOX = 2
    DISC = 3


@dataclass(frozen=True, eq=False)
class Appearance(Frozen):
    """What was said about drawing the elements; the analysis does not use it.

    Attributes:
        cross_section: (elements,) `CrossSection`; NONE where none was given.
        dimensions: (elements, 2) outer sizes along local y and local z [m], a diameter
            twice; 0 where not given.
        colour: (elements, 3) red, green, blue from 0 to 1; NaN where not given.
        edge_colour: (elements, 3) the same for edges.
        opacity: (elements,) from 0, invisible, to 1; NaN where not given.
        drawn: (elements,) whether an element is drawn.
        body_shape: (elements,) `BodyShape` as which the body of a link is drawn; NONE where
            not given.
        body_thickness: (elements,) of that shape [m]; NaN where not given.
        contour: (elements, 4) of the notch that a hinge is: which of `notches.CONTOURS`, height,
            length and radius [m]; NaN where not given. No deck has a word for it.
    """

    cross_section: IntArray
    dimensions: FloatArray
    colour: FloatArray
    edge_colour: FloatArray
    opacity: FloatArray
    drawn: BoolArray
    body_shape: IntArray = field(default_factory=lambda: np.zeros(0, np.int32))
    body_thickness: FloatArray = field(default_factory=lambda: np.zeros(0))
    contour: FloatArray = field(default_factory=lambda: np.zeros(0))

    def __post_init__(self) -> None:
        """Make the arrays read-only; where some are left out nothing is said of that."""
        for name, none in (
            ("body_shape", np.int32(BodyShape.NONE)),
            ("body_thickness", np.float64(np.nan)),
        ):
            if not getattr(self, name).size:
                object.__setattr__(self, name, np.broadcast_to(none, self.drawn.shape))
        if not self.contour.size:
            nothing = np.broadcast_to(np.float64(np.nan), (*self.drawn.shape, 4))
            object.__setattr__(self, "contour", nothing)
        super().__post_init__()

    @classmethod
    def plain(cls, elements: int) -> Appearance:
        """All elements are drawn, and nothing else is given; takes no memory."""
        nan = np.float64(np.nan)
        return cls(
            np.broadcast_to(np.int32(CrossSection.NONE), (elements,)),
            np.broadcast_to(np.float64(0.0), (elements, 2)),
            np.broadcast_to(nan, (elements, 3)),
            np.broadcast_to(nan, (elements, 3)),
            np.broadcast_to(nan, (elements,)),
            np.broadcast_to(np.True_, (elements,)),
        )


@dataclass(frozen=True, eq=False)
class Loads(Frozen):
    """Dead loads; whether a mechanism is exactly constrained does not depend on them.

    Zero where nothing is given. A position has forces along x, y, z [N], an orientation
    moments about x, y, z [N m], which work on small rotations about these fixed axes; in a
    planar model there are forces along x and y, and the moment about z.

    Attributes:
        force: (nodes, 3) of XF.
        increment: (nodes, 3) of DELXF, which is added to XF in the course of loading.
        gravity: (3,) of GRAVITY, the acceleration of free fall [m/s^2].

    Raises:
        ValueError: a shape is wrong, or a number is not finite.
    """

    force: FloatArray
    increment: FloatArray
    gravity: FloatArray

    def __post_init__(self) -> None:
        """Check the arrays and make them read-only."""
        super().__post_init__()
        for name, shape in (
            ("force", (len(self.force), 3)),
            ("increment", (len(self.force), 3)),
            ("gravity", (3,)),
        ):
            array = getattr(self, name)
            if array.shape != shape:
                raise ValueError(f"{name} has shape {array.shape}, but must have {shape}")
            if not np.isfinite(array).all():
                raise ValueError(f"{name} has a number that is not finite")


#: How many numbers an element or a node has at most of each.
NUMBERS = {
    **{"stiffness": 6, "mass": 5, "strength": 2, "expansion": 1, "fillet": 1},
    "node_mass": 6,
}
#: Those of elements.
OF_ELEMENTS = tuple(NUMBERS)[:5]


@dataclass(frozen=True, eq=False)
class Properties(Frozen):
    """What parts are made of; whether a mechanism is exactly constrained does not depend on it.

    A row holds the numbers of one statement of the deck language, in its order, and NaN
    behind them. A row of NaN: nothing is given.

    Attributes:
        stiffness: (elements, 6) of ESTIFF. Of a beam EA [N], G It, E Iy, E Iz [N m^2] and the
            shear E Iy / (G A k), E Iz / (G A k) [m^2]; of a planar beam EA, EI and shear; of a
            truss EA; of a hinge the stiffness about its axis [N m/rad] and about the others.
        mass: (elements, 5) of EM. Of a beam mass [kg/m], then Jxx, Jyy, Jzz, Jyz [kg m] per
            length; of a planar beam mass and J; of a truss or a rigid link mass.
        strength: (elements, 2) of STRENGTH: the stress at which the material yields or breaks
            [Pa], and the amplitude that it bears for good.
        expansion: (elements, 1) of EXPANSION, of the material's length with temperature [1/K].
        fillet: (elements, 1) of FILLET: the radius of the fillets at the ends [m].
        node_mass: (nodes, 6) of XM. Of a position its mass [kg]; of an orientation Jxx, Jxy,
            Jxz, Jyy, Jyz, Jzz, of a planar one J [kg m^2].

    Raises:
        ValueError: a shape is wrong, or a number stands behind one that is not given.
    """

    stiffness: FloatArray
    mass: FloatArray
    strength: FloatArray
    expansion: FloatArray
    fillet: FloatArray
    node_mass: FloatArray

    @classmethod
    def none(cls, elements: int, nodes: int) -> Properties:
        """Of so many elements and nodes nothing is given."""
        count = {name: elements for name in OF_ELEMENTS} | {"node_mass": nodes}
        return cls(**{name: np.full((count[name], n), np.nan) for name, n in NUMBERS.items()})

    def of_elements(self, which: IntArray, new_nodes: int = 0) -> Properties:
        """Those of some elements, one or several times, and of so many more nodes."""
        none = np.full((new_nodes, self.node_mass.shape[1]), np.nan)
        tables = {name: getattr(self, name)[which] for name in OF_ELEMENTS}
        return Properties(**tables, node_mass=np.vstack([self.node_mass, none]))

    def __post_init__(self) -> None:
        """Check the arrays and make them read-only."""
        super().__post_init__()
        for name, numbers in NUMBERS.items():
            array = getattr(self, name)
            if array.ndim != 2 or array.shape[1] != numbers:
                raise ValueError(f"{name} has shape {array.shape}, but must have (…, {numbers})")
            missing = np.isnan(array)
            if np.isinf(array).any() or (missing[:, :-1] & ~missing[:, 1:]).any():
                raise ValueError(f"{name} has a number behind one that is not given, or infinity")


def rows_of(table: FloatArray) -> Iterator[tuple[int, tuple[float, ...]]]:
    """Index and numbers of each row of which something is given."""
    for i in np.flatnonzero(~np.isnan(table[:, 0])).tolist():
        yield i, tuple(value for value in table[i].tolist() if value == value)


Labels = tuple[tuple[int, str], ...]


def row_labels(arrays: ModelArrays, label: IndexArray) -> tuple[tuple[int, int], ...]:
    """Element numbers and deformations from 1 of (2, m) their indices, both from 0."""
    numbers = arrays.element_number[label[0]].tolist()
    return tuple(zip(numbers, (label[1] + 1).tolist(), strict=True))


def column_labels(arrays: ModelArrays, label: IndexArray) -> Labels:
    """Node numbers and coordinate names of (2, n) node indices and axes, both from 0."""
    numbers = arrays.node_number[label[0]].tolist()
    kinds = arrays.node_kind[label[0]].tolist()
    axes = label[1].tolist()
    return tuple(
        (number, coordinate_name(kind, axis))
        for number, kind, axis in zip(numbers, kinds, axes, strict=True)
    )


#: No sheet or wire is longer [m]; moduli [Pa] and densities [kg/m3] of solids are within these.
_LONGEST, _MODULI, _DENSITIES = 5.0, (1.0e8, 1.0e12), (100.0, 3.0e4)
#: No material is stronger than this part of its modulus, and no solid weaker than that [Pa].
_STRONGEST, _WEAKEST = 1.0 / 20.0, 1.0e5
#: No solid expands by more for a kelvin [1/K].
LARGEST_EXPANSION = 1.0e-2
#: Free fall on Earth [m/s2].
_FREE_FALL = 9.7, 9.9
#: What a number in another unit is to be multiplied with, and that unit, by the units of a model.
_MODULUS_UNITS = {
    "m": ((1e9, "GPa"), (1e6, "MPa (N/mm2)"), (1e-6, "N/m2 times mm2")),
    "mm": ((1e3, "GPa"), (1e-6, "Pa, or of a section in metres")),
}
_DENSITY_UNITS = {
    "m": ((1e3, "g/cm3"), (1e9, "kg/mm3"), (1e12, "t/mm3"), (1e-3, "g/m3")),
    "mm": ((1e3, "g/cm3"), (1e-3, "g/m3, as of an EM in kg/m")),
}


_METRES = {"m": "metres", "mm": "mm"}


def slips_in(data: ModelData) -> Iterator[Diagnostic]:
    """Warnings about a sound model, one of each kind."""
    # Most models are small, and nothing of their size is made for them.
    if max(map(np.ptp, data.arrays.node_value[:3])) > _LONGEST:
        yield from _long(data)
    if data.loads is not None:
        yield from _falls(data, float(np.linalg.norm(data.loads.gravity)))
    if data.properties is None:
        return
    yield from _unlike_any(data)
    if data.given_appearance is None:
        return
    looks = data.appearance
    b, h = looks.dimensions.T
    round_ = looks.cross_section == CrossSection.CIRC
    solid = round_ | (looks.cross_section == CrossSection.RECT)
    area = np.where(solid, np.where(round_, math.pi / 4.0, 1.0) * b * h, 0.0)
    # That of a hinge is no EA.
    member = is_member(data.arrays.element_kind, Member.BAR, Member.BEAM)
    stiff = np.where(member, np.nan_to_num(data.properties.stiffness[:, 0]), 0.0)
    mass = np.nan_to_num(data.properties.mass[:, 0])
    # Of a rigid link the mass is that of all of it.
    per_length = member_table()[data.arrays.element_kind] == Member.BEAM
    known = np.where(area > 0.0, area, math.inf)
    units, pressure = data.units, data.units.symbol("Pa")
    yield from _outside(
        *(data, stiff / known, _MODULI, "unlikely-modulus", "an E of {}"),
        *("Pa", _MODULUS_UNITS[units.name]),
        f"E is in {pressure}, and EA of ESTIFF in N",
    )
    yield from _outside(
        *(data, np.where(per_length, mass, 0.0) / known, _DENSITIES),
        *("unlikely-density", "a density of {}"),
        *("kg/m3", _DENSITY_UNITS[units.name]),
        f"densities are in kg/m3, and EM of a beam in {units.symbol('kg/m')}",
    )
    strength = np.nan_to_num(data.properties.strength).max(axis=1)
    found = (area > 0.0) & (stiff > 0.0) & (strength > _STRONGEST * stiff / known)
    if found.any():
        most = float(strength[found][0])
        yield warning(
            "unlikely-strength",
            f"{_named(data, found)} {_has(found)} a strength of {units.said(most, 'Pa')}, above a "
            "twentieth of E",
            f"strengths are in {pressure}, as E is",
        )
    length, thickness = _lengths(data), np.where(solid & (stiff > 0.0), np.minimum(b, h), 0.0)
    found = (length > 0.0) & (thickness > length)
    if found.any():
        size = float(thickness[found][0])
        yield warning(
            *("thick-section", f"{_named(data, found)} {_is(found)} thicker than long"),
            f"its section is {units.said(size, 'm')} thick: sections are in {_METRES[units.name]}",
        )


def _falls(data: ModelData, gravity: float) -> Iterator[Diagnostic]:
    """A free fall that is a thousand times that on Earth, or a thousandth."""
    low, high = _FREE_FALL
    for factor, unit in ((1e3, "m/s2"), (1e-3, "mm/s2")):
        if low < gravity * factor < high:
            told = data.units.said(gravity, "m/s2")
            plain = f"accelerations are in {data.units.symbol('m/s2')}"
            number = f"{data.units.shown(gravity, 'm/s2'):.4g} is a usual number in {unit}"
            yield warning("unlikely-gravity", f"free fall is {told}", f"{number}: {plain}")


def _unlike_any(data: ModelData) -> Iterator[Diagnostic]:
    """Strengths and coefficients of expansion that no solid has."""
    assert data.properties is not None
    units = data.units
    strength, fatigue = data.properties.strength.T
    # What is less than zero has a warning already.
    amiss = np.abs(data.properties.strength - _WEAKEST / 2.0) <= _WEAKEST / 2.0
    weak = np.asarray(amiss.any(axis=1))
    if weak.any():
        least = units.said(float(np.fmin(strength, fatigue)[weak][0]), "Pa")
        plain = f"strengths are in {units.symbol('Pa')}, and above zero"
        words = f"{_named(data, weak)} {_has(weak)} a strength of {least}"
        yield warning("unlikely-strength", words, plain)
    above = fatigue > strength
    if above.any():
        words = f"{_named(data, above)} {_has(above)} a fatigue strength above the strength"
        yield warning("unlikely-strength", words, "the strength stands first, that of fatigue then")
    expansion = data.properties.expansion[:, 0]
    large = np.abs(expansion) > LARGEST_EXPANSION
    if large.any():
        most = float(expansion[large][0])
        words = f"{_named(data, large)} {_has(large)} a coefficient of expansion of {most:g} /K"
        yield warning("unlikely-expansion", words, "for 12 um/m/K write 12e-6")


def _lengths(data: ModelData) -> FloatArray:
    """(elements,) distances between the ends [m], 0 where an element has no two."""
    arrays = data.arrays
    p, q = arrays.element_node[0] - 1, arrays.element_node[2] - 1
    there = (p >= 0) & (q >= 0)
    places = np.where(arrays.node_kind <= NodeKind.POSITION, arrays.node_value[:3], 0.0)
    with np.errstate(over="ignore"):
        made = np.linalg.norm(places[:, q] - places[:, p], axis=0)
    return np.where(there, made, 0.0)


def _long(data: ModelData) -> Iterator[Diagnostic]:
    """A sheet or wire that is longer than any; of a divided one all of it counts."""
    # Bars are many, and neither.
    if not is_member(data.arrays.element_kind, Member.BEAM).any():
        return
    length = _lengths(data)
    whole = length.copy()
    for chain in data.chains:
        whole[list(chain.elements)] = length[list(chain.elements)].sum()
    found = whole > _LONGEST
    if found.any():
        found &= np.isin(forms_of(data.arrays)[0], (Form.SHEET, Form.WIRE))
    if found.any():
        most = float(whole[found].max())
        plain = f"give all positions in metres: {most:.4g} mm are {most / 1e3:.4g} m"
        if not data.units.power:
            plain += ", or say that the model is in mm (UNITS mm)"
        else:
            plain = "the model is in mm: give all positions in mm"
        yield warning(
            *(
                "long-sheet",
                f"{_named(data, found)} {_is(found)} {data.units.said(most, 'm')} long",
            ),
            plain,
        )


def _outside(
    data: ModelData,
    value: FloatArray,
    between: tuple[float, float],
    code: str,
    words: str,
    unit: str,
    others: tuple[tuple[float, str], ...],
    plain: str,
) -> Iterator[Diagnostic]:
    """Values, 0 where none is known, that are not between two."""
    low, high = between
    found = (value > 0.0) & ~((value >= low) & (value <= high))
    if found.any():
        one = float(value[found][0])
        meant = next((other for factor, other in others if low <= one * factor <= high), "")
        told, number = data.units.said(one, unit), data.units.shown(one, unit)
        yield warning(
            *(code, f"{_named(data, found)} {_has(found)} {words.format(told)}"),
            f"{number:.4g} is a usual number in {meant}: {plain}" if meant else plain,
        )


def _has(found: BoolArray) -> str:
    return "have" if found.sum() > 1 else "has"


def _is(found: BoolArray) -> str:
    return "are" if found.sum() > 1 else "is"


def _named(data: ModelData, found: BoolArray) -> str:
    """Such as "element 1 (sheet 1) and 5 more"."""
    first = int(np.flatnonzero(found)[0])
    name = part_name(data.element_names[first]).strip()
    number = int(data.arrays.element_number[first])
    more = int(found.sum()) - 1
    return f"element {number}{f' ({name})' if name else ''}{f' and {more} more' if more else ''}"


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

    def __getitem__(self, index: Any) -> Any:
        """The name of an element or a node by its index, empty where it has none; or several."""
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
        units: In which numbers are given and said; all arrays are in SI.
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
    units: Units = METRES

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

    @property
    def has_stiffness(self) -> bool:
        """Whether any element has a stiffness (ESTIFF)."""
        given = self.properties
        return given is not None and bool((np.nan_to_num(given.stiffness) > 0.0).any())

    @property
    def has_mass(self) -> bool:
        """Whether anything has a mass (EM, XM)."""
        given = self.properties
        masses = () if given is None else (given.mass, given.node_mass)
        return any(bool(np.nan_to_num(each).any()) for each in masses)

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
        """(elements, 2, 3) unit vectors across the elements (`flexact.model.parts.chains`)."""
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
