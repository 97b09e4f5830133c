# SPDX-License-Identifier: BSD-3-Clause
"""The cost of a design as built, and of the same design with something released."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from ..core.arrays import FloatArray
from ..model.data import ModelData
from ..util.records import Frozen
from .shape import Shape
from .values import (
    Clamp,
    Kept,
    Misalignment,
    Number,
    Numbers,
    Point,
    Released,
    Tolerance,
    unit_of_direction,
)


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
        if self.frequencies is None:
            return None
        for k, drives in enumerate(self.is_drive):
            if not drives:
                return Number(*(float(each[k]) for each in self.frequencies))
        return None

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
    """

    node: int
    coordinate: str
    words: str
    rest: float
    asked: tuple[float, float]
    reached: tuple[float, float]
    why: str = ""

    @property
    def unit(self) -> str:
        """Of its values: m or rad."""
        return unit_of_direction(self.coordinate)

    @property
    def beyond(self) -> str:
        """How far it went, where that is not all the way; empty otherwise."""
        if not self.why:
            return ""
        asked, reached = (f"{a:.6g} to {b:.6g} {self.unit}" for a, b in (self.asked, self.reached))
        return (
            f"the stroke of {self.words} was asked from {asked} and reached from {reached}: "
            f"{self.why}"
        )


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

    @property
    def as_built(self) -> Design:
        """The design without a release."""
        return self.designs[0]

    @property
    def tightest(self) -> Tolerance | None:
        """The smallest tolerance as built; None where misalignment costs nothing."""
        return self.as_built.tightest
