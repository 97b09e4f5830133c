# SPDX-License-Identifier: BSD-3-Clause
"""The cost of a design as built, and of the same design with something released."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..core.arrays import FloatArray
from ..elasticity.limits import Limits
from ..elasticity.points import words_of_direction
from ..model.data import ModelData
from ..util.records import Frozen
from ..util.units import METRES, Units
from .shape import Shape

#: What the first frequency is called where the deck has no masses.
FREQUENCY, STIFFNESS = "first frequency", "lowest stiffness"


def unit_of_direction(direction: str) -> str:
    """Of a displacement or rotation: m or rad."""
    return "rad" if direction.startswith("r") else "m"


def force_unit(direction: str) -> str:
    """Of what acts along or about a direction: N or N m."""
    return "N m" if unit_of_direction(direction) == "rad" else "N"


def stiffness_unit(direction: str) -> str:
    """Of the stiffness along or about a direction: N/m or N m/rad."""
    return "N m/rad" if unit_of_direction(direction) == "rad" else "N/m"


class Number(NamedTuple):
    """A number and what refinement leaves open of it.

    The value may be infinite, where no misalignment reaches what is asked for; its uncertainty is
    0 then. With a fixed number of beams the uncertainty is 0, and `Cost.beams` says so.
    """

    value: float
    uncertainty: float = 0.0

    @property
    def is_finite(self) -> bool:
        """Whether there is such a value."""
        return math.isfinite(self.value)


class Numbers(NamedTuple):
    """Numbers of one kind: values and uncertainties, two arrays of one shape."""

    value: FloatArray
    uncertainty: FloatArray

    def at(self, *place: int) -> Number:
        """The one at a place."""
        return Number(float(self.value[place]), float(self.uncertainty[place]))

    def column(self, k: int) -> Numbers:
        """(n,) those of a column of two dimensions."""
        return Numbers(self.value[:, k], self.uncertainty[:, k])

    def each(self) -> list[Number]:
        """All of one dimension."""
        return [self.at(k) for k in range(self.value.size)]

    def row(self, k: int) -> list[Number]:
        """Those of a row of two dimensions."""
        return Numbers(self.value[k], self.uncertainty[k]).each()


def stacked(rows: Sequence[Numbers]) -> Numbers:
    """(n, k) of rows, of which the shortest says how many there are."""
    count = min(row.value.size for row in rows)
    return Numbers(
        np.array([row.value[:count] for row in rows]),
        np.array([row.uncertainty[:count] for row in rows]),
    )


class Point(NamedTuple):
    """The point at which stiffness is measured."""

    node: int
    """Number of its position node."""
    orientation: int | None
    """Number of its orientation node; None where it has none: only displacements count then."""
    words: str
    """Such as "the stage" or "node 1"."""
    reason: str
    """Why it was taken: "as asked for", "the driven point", "where most parts meet"."""


class Clamp(NamedTuple):
    """A support that may be misaligned: position and orientation node, both of them held."""

    node: int
    """Number of its position node."""
    orientation: int | None
    """Number of its orientation node; None of a support that holds no rotation."""
    words: str
    """Such as "clamp 11" or "the clamp of sheet 1"."""
    label: str
    """Short, for tables and axes: a name, or "clamp 11"."""


class Misalignment(NamedTuple):
    """A clamp moved or turned."""

    clamp: Clamp
    direction: str
    """One of x y z rx ry rz."""
    about: int | None = None
    """Number of the position node through which the axis of a turn goes; None: the clamp's own."""

    @property
    def unit(self) -> str:
        """Of its size: m or rad."""
        return unit_of_direction(self.direction)

    @property
    def words(self) -> str:
        """Such as "clamp 11 along x"."""
        pivot = "" if self.about is None else f" through node {self.about}"
        return f"{self.clamp.words} {words_of_direction(self.direction)}{pivot}"


class Tolerance(NamedTuple):
    """What a clamp may be off in one direction.

    Stresses are taken in proportion to the error, about the undeformed state.
    """

    misalignment: Misalignment
    negative: Number
    """The error below zero that shifts the measure by `Cost.shift`; -infinity where none does."""
    positive: Number
    """Likewise above zero."""
    critical_negative: Number
    """The error below zero at which the design buckles; -infinity where none does."""
    critical_positive: Number
    """Likewise above zero."""

    @property
    def tightest(self) -> Number:
        """The smaller in size of both, as a size."""
        return _smaller(self.negative, self.positive)

    @property
    def critical(self) -> Number:
        """The smaller in size of both critical errors, as a size."""
        return _smaller(self.critical_negative, self.critical_positive)


def _smaller(one: Number, other: Number) -> Number:
    """The smaller in size of two, as a size."""
    first = min(one, other, key=lambda each: abs(each.value))
    return Number(abs(first.value), first.uncertainty)


class Released(NamedTuple):
    """A deformation that a design releases."""

    element: int
    """Number of the element."""
    deformation: int
    """From 1."""
    notch: float
    """Stiffness of the notch [N m/rad; of an elongation N/m]; 0: ideal."""
    words: str
    """Such as "sheet 1: in-plane bending at its clamp"."""
    shown: float | None = None
    """The same stiffness in the units of the model; None where these are SI."""

    @property
    def label(self) -> str:
        """Such as "1:5" or "1:5=3.5"."""
        notch = self.notch if self.shown is None else self.shown
        return f"{self.element}:{self.deformation}" + (f"={notch:g}" if notch else "")


class Kept(NamedTuple):
    """What a design keeps of the stiffness as built at the point: C_before v = mu C_after v."""

    mu: Numbers
    """(directions that can move,) ascending; 1: all of it is kept."""
    worst: FloatArray
    """(6,), of planar models and points without orientation (3,): load v of the smallest mu
    [N, N m], its largest entry 1 with lengths in units of the model's size."""
    words: str
    """The direction, such as "about z" or "along x with a turn about y"."""

    @property
    def smallest(self) -> Number:
        """The smallest mu."""
        return self.mu.at(0)


#: Prefixes by unit; other units have none.
_PREFIXES: dict[str, tuple[tuple[float, str], ...]] = {
    "m": ((1.0, "m"), (1e-3, "mm"), (1e-6, "um"), (1e-9, "nm")),
    "rad": ((1.0, "rad"), (1e-3, "mrad"), (1e-6, "urad"), (1e-9, "nrad")),
    "Hz": ((1e3, "kHz"), (1.0, "Hz")),
    "N/m": ((1e6, "N/um"), (1e3, "N/mm"), (1.0, "N/m")),
    "N": ((1e3, "kN"), (1.0, "N"), (1e-3, "mN")),
    "J": ((1.0, "J"), (1e-3, "mJ"), (1e-6, "uJ"), (1e-9, "nJ")),
    "Pa": ((1e9, "GPa"), (1e6, "MPa"), (1e3, "kPa"), (1.0, "Pa")),
}
#: Digits of a number whose uncertainty is below this part of it.
_DIGITS, _CERTAIN = 4, 0.5e-4
#: Decimals of a number that stand before it is written with an exponent.
_MOST_DECIMALS = 8


def in_words(number: Number, unit: str = "", *, none: str = "none") -> str:
    """Such as "132.7 +- 0.2 um"; digits that are uncertain are left out.

    Args:
        number: The number; infinite where there is none.
        unit: The SI unit: a prefix is found for m, rad, Hz, N/m, N, J and Pa.
        none: What stands for a number that is infinite.
    """
    if not number.is_finite:
        return none
    factor, name = scale_of(number.value, unit)
    value, off = number.value / factor, abs(number.uncertainty) / factor
    text = f"{value:.{_DIGITS}g}"
    if off > _CERTAIN * abs(value):
        # One digit of the uncertainty, rounded up.
        digits = -math.floor(math.log10(off))
        off = math.ceil(off * 10.0**digits - 1.0e-9) / 10.0**digits
        if 0 <= digits <= _MOST_DECIMALS:
            text = f"{value:.{digits}f} +- {off:.{digits}f}"
        else:
            text = f"{text} +- {off:.1g}"
    return f"{text} {name}" if name else text


def scale_of(value: float, unit: str) -> tuple[float, str]:
    """The prefix with which a value is between 1 and 1000, as its factor and its name."""
    prefixes = _PREFIXES.get(unit, ((1.0, unit),))
    size = abs(float(f"{value:.3g}"))
    if size == 0.0:
        return 1.0, unit
    return next((each for each in prefixes if size >= each[0]), prefixes[-1])


def percent(part: float) -> str:
    """A part such as 0.05 as "5 %"."""
    return f"{100.0 * part:.3g} %"


@dataclass(frozen=True, eq=False)
class StrokeCurve(Frozen):
    """A design along the stroke; n states, ascending in the driven value.

    Attributes:
        values: (n,) driven coordinate, absolute [m, rad].
        stiffness: (n, directions) support stiffness at the point, the inverse of each diagonal
            entry of its compliance [N/m, N m/rad], in the order of `Cost.directions`; infinite
            where the direction is held. The drive is free or locked as `Cost.drive` says.
        kept: (n,) smallest mu of C_rest v = mu C_here v at the point: what the stroke leaves of
            the stiffness at the undeformed state, in the worst direction. 1 at the reference.
        drive_stiffness: (n,) change of the drive's force with its value [N/m, N m/rad].
        force: (n,) force of the drive on the mechanism [N, N m].
        frequencies: (n, k) lowest frequencies [Hz], ascending; None without masses. One that is
            0 belongs to a mode in which the state is unstable.
        parasitic: (n, p) those that are not the drive's, ascending; None without masses.
        is_stable: (n,) whether no stiffness is negative; else the design has buckled there.
        under_constrained: (n,) motions that nothing determines, in each state.
        over_constrained: (n,) self-stresses likewise.
        stress: (n,) stress of von Mises [Pa] of the part that is nearest to its strength; None
            where no strength was asked for.
        safety: (n,) its strength over that; infinite without stress. None likewise.
    """

    values: FloatArray
    stiffness: Numbers
    kept: Numbers
    drive_stiffness: Numbers
    force: Numbers
    frequencies: Numbers | None
    parasitic: Numbers | None
    is_stable: tuple[bool, ...]
    under_constrained: tuple[int, ...]
    over_constrained: tuple[int, ...]
    stress: Numbers | None = None
    safety: Numbers | None = None


@dataclass(frozen=True, eq=False)
class MisalignmentCurve(Frozen):
    """The lowest frequencies of a design against one misalignment, up to where it buckles.

    Attributes:
        misalignment: Of which clamp, in which direction: the one that matters most as built.
        values: (n,) error [m, rad], ascending through 0; a design that never buckles is followed
            as far as the one as built.
        measure: (n,) first frequency [Hz], or without masses the lowest stiffness of the driven
            point [N/m, N m/rad];
            0 where it buckles.
    """

    misalignment: Misalignment
    values: FloatArray
    measure: Numbers


@dataclass(frozen=True, eq=False)
class Effect(Frozen):
    """What given misalignments do to a design, with all of the nonlinearity.

    Attributes:
        frequencies: (2, k) lowest frequencies [Hz] before and behind; None without masses.
        stiffness: (2, directions) support stiffness at the point likewise [N/m, N m/rad].
        energy: (2,) elastic energy [J].
        resultants: (2, 3) largest normal force [N], torque and bending moment [N m] in size.
        peak: (2,) largest stress [Pa] in size; None where no section is known.
        where: Where the largest stress, else the largest moment, is behind: words.
        kept: Smallest mu of C_before v = mu C_behind v.
        is_stable: Whether it has not buckled behind.
        reached: Which part of the misalignments was reached, 1 for all.
        von_mises: (2,) stress of von Mises [Pa] of the part that is nearest to its strength;
            None where no strength was asked for.
        safety: (2,) its strength over that; infinite without stress. None likewise.
    """

    frequencies: Numbers | None
    stiffness: Numbers
    energy: Numbers
    resultants: Numbers
    peak: Numbers | None
    where: str
    kept: Number
    is_stable: bool
    reached: float
    von_mises: Numbers | None = None
    safety: Numbers | None = None


@dataclass(frozen=True, eq=False)
class Design(Frozen):
    """A design: as built, or with something released.

    Attributes:
        released: What is released; empty as built.
        alike: Labels of other sets that symmetry makes equal to this one, such as "3:5".
        under_constrained: Motions that nothing determines, in the undeformed state.
        over_constrained: Self-stresses likewise.
        compliance: (d, d) at the point, order `Cost.directions` [m/N, rad/N, rad/(N m)].
        kept: Beside as built; None as built.
        frequencies: (k,) lowest [Hz], ascending; None without masses.
        is_drive: (k,) which of them are the drive's; the others are parasitic. Empty without
            masses.
        tolerances: Of every clamp and direction; empty where they have no answer.
        size: The model's [m], by which angles are compared with lengths: its largest distance.
        curve: Against the misalignment that matters most as built; None where it has none.
        stroke: Along the stroke; None where none was asked for, or nothing was reached.
        effect: Of the misalignments that were given; None without any.
        shapes: To be drawn.
        remarks: What is special about this design, in sentences.
        limits: How far the stroke may go; None where no strength was asked for, or it has none.
        safeties: (tolerances,) the strength over the largest stress at the smaller error of each,
            infinite without stress; empty where no strength was asked for.
    """

    released: tuple[Released, ...]
    alike: tuple[str, ...]
    under_constrained: int
    over_constrained: int
    compliance: Numbers
    kept: Kept | None
    frequencies: Numbers | None
    is_drive: tuple[bool, ...]
    tolerances: tuple[Tolerance, ...]
    size: float
    curve: MisalignmentCurve | None = None
    stroke: StrokeCurve | None = None
    effect: Effect | None = None
    shapes: tuple[Shape, ...] = ()
    remarks: tuple[str, ...] = ()
    limits: Limits | None = None
    safeties: tuple[Number, ...] = ()

    def safety(self, of: Tolerance) -> Number | None:
        """That of a tolerance; None where no strength was asked for, or it has no end."""
        if not self.safeties or not of.tightest.is_finite:
            return None
        return self.safeties[self.tolerances.index(of)]

    @property
    def label(self) -> str:
        """Short, for tables and legends: "as built", or such as "1:5+2:5=3.5"."""
        return "+".join(each.label for each in self.released) or "as built"

    @property
    def words(self) -> str:
        """Such as "as built", or "released: sheet 1: torsion"."""
        return "; ".join(each.words for each in self.released) or "as built"

    @property
    def first_parasitic(self) -> Number | None:
        """The lowest frequency that is not the drive's [Hz]; None without any."""
        if self.frequencies is None or all(self.is_drive):
            return None
        return self.frequencies.at(self.is_drive.index(False))

    @property
    def tightest(self) -> Tolerance | None:
        """The smallest tolerance, an angle times the size against lengths; None without any."""
        return smallest(self.tolerances, self.size, lambda each: each.tightest)

    @property
    def buckles_at(self) -> Tolerance | None:
        """The tolerance whose critical error is smallest, likewise."""
        return smallest(self.tolerances, self.size, lambda each: each.critical)


def smallest(
    tolerances: Iterable[Tolerance], size: float, of: Callable[[Tolerance], Number]
) -> Tolerance | None:
    """The tolerance of which a number is smallest, an angle times the size against lengths.

    Of those that symmetry makes equal it is the first; None where all are infinite.
    """

    def length(each: Tolerance) -> float:
        value = of(each).value * (size if each.misalignment.unit == "rad" else 1.0)
        return float(f"{value:.5g}")

    found = min(tolerances, key=length, default=None)
    return None if found is None or not of(found).is_finite else found


@dataclass(frozen=True, eq=False)
class Stroke(Frozen):
    """The stroke that was asked for.

    Attributes:
        node: Number of the driven node.
        coordinate: One of x y z rx ry rz.
        words: Such as "the stage along z".
        rest: Its value in the deck [m, rad].
        asked: First and last value, absolute [m, rad].
        reached: The same as far as every design could be followed.
        why: Why not farther; empty where all was reached.
        units: In which it is told.
    """

    node: int
    coordinate: str
    words: str
    rest: float
    asked: tuple[float, float]
    reached: tuple[float, float]
    why: str = ""
    units: Units = METRES

    @property
    def unit(self) -> str:
        """Of its values: m or rad."""
        return unit_of_direction(self.coordinate)

    @property
    def beyond(self) -> str:
        """How far it went, where that is not all the way; empty otherwise."""
        if not self.why:
            return ""
        symbol, shown = self.units.symbol(self.unit), self.units.shown
        asked, reached = (
            f"{shown(a, self.unit):.6g} to {shown(b, self.unit):.6g} {symbol}"
            for a, b in (self.asked, self.reached)
        )
        return (
            f"the stroke of {self.words} was asked from {asked} and reached from {reached}: "
            f"{self.why}"
        )


class Strength(NamedTuple):
    """What was asked of the strength: how far a drive may go."""

    node: int
    """Number of the driven node."""
    coordinate: str
    """One of x y z rx ry rz."""
    words: str
    """Such as "the stage along z"."""
    rest: float
    """Its value in the deck [m, rad]."""
    share: float
    """Of the strength, such as 0.5."""
    support: float | None
    """Part of the stiffness at rest; None where none was asked for."""
    against: str | None
    """"strength" or "fatigue"; None: of fatigue where it is given."""

    @property
    def unit(self) -> str:
        """Of its values: m or rad."""
        return unit_of_direction(self.coordinate)


@dataclass(frozen=True, eq=False, repr=False)
class CostValues(Frozen):
    """What a design costs as built, and beside it what each release gains.

    Attributes:
        data: The model as given.
        name: What the result is called.
        designs: As built first, then with releases, the best first.
        point: Where stiffness is measured.
        directions: Those of the point: six, three in the plane, or three displacements.
        clamps: The supports that may be misaligned.
        measure: What `shift` is of: "first frequency", or without masses "lowest stiffness".
        shift: Relative, such as -0.05: a fall of 5 %.
        held: "elastic" or "rigid": what was made of held deformations.
        drive: "free" or "locked".
        beams: Beams a sheet: "auto" (8 and 16, extrapolated), or how many.
        stroke: None where none was asked for.
        misaligned: Misalignments and their values [m, rad] that were given, together.
        left_out: What the deck's data do not allow, and what was not looked at, in sentences.
        strength: None where none was asked for.
    """

    data: ModelData
    name: str
    designs: tuple[Design, ...]
    point: Point
    directions: tuple[str, ...]
    clamps: tuple[Clamp, ...]
    measure: str
    shift: float
    held: str
    drive: str
    beams: int | str
    stroke: Stroke | None
    misaligned: tuple[tuple[Misalignment, float], ...]
    left_out: tuple[str, ...]
    strength: Strength | None = None

    @property
    def as_built(self) -> Design:
        """The design without a release."""
        return self.designs[0]

    @property
    def tightest(self) -> Tolerance | None:
        """The smallest tolerance as built; None where misalignment costs nothing."""
        return self.as_built.tightest


#: The longest label that stands at a curve.
_LONGEST = 11


def short_labels(cost: CostValues) -> tuple[str, ...]:
    """What stands at the curves and bars of designs: their labels, or letters if one is long."""
    labels = [each.label for each in cost.designs]
    if max(map(len, labels)) <= _LONGEST:
        return tuple(labels)
    return (labels[0], *(chr(ord("A") + k) for k in range(len(labels) - 1)))
