# SPDX-License-Identifier: BSD-3-Clause
"""What a freedom takes: wires, sheets, layers and limbs that can leave it, and how many of each.

On the wrenches W that do no work on a freedom T, q(f, m) = f.m is zero on forces along lines and on
couples alone, and its signature says what those span: theorems 1 to 4 of docs/theory.md.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import ArrayLike

from ..advice.spaces.screws import (
    EXACT,
    Family,
    FamilyKind,
    ScrewSpace,
    canonical,
    parted,
    principal_rows,
)
from ..core.arrays import FloatArray
from ..util.records import Frozen, cached_property
from ..util.rotations import unit

#: A freedom that is nearer to a special one (parts of the characteristic length, or rad) is taken
#: for it, and one that is nearer than the second is told to be near it.
NEAR, DOUBTFUL = 1.0e-6, 1.0e-4
#: What is rounding of unit rows, how often one steps towards a special freedom at most, and the
#: part of a screw outside a space with which it is clearly no member.
_ROUNDING, _STEPS, _CLEAR = 1.0e-14, 12, 0.1

#: A sheet's three rows, the two of a waisted one, and so on: dimensions of what flexures hold.
_SHEET, _ROD, _NOTCH = 3, 4, 5

#: Freedoms whose rotations are all in one plane and whose translation is across it.
_FLAT = frozenset(
    (
        FamilyKind.LINE,
        FamilyKind.DIRECTION,
        FamilyKind.PENCIL,
        FamilyKind.PARALLELS_IN_PLANE,
        FamilyKind.PLANE,
    )
)
_OF_A_ROD = frozenset((FamilyKind.LINE, FamilyKind.DIRECTION, FamilyKind.PARALLELS_IN_PLANE))
_WITH_PENCILS = frozenset((FamilyKind.PENCIL, FamilyKind.BUNDLE, FamilyKind.PLANE))


def signature_of(space: ScrewSpace) -> tuple[int, int, int]:
    """How many eigenvalues of q on a space are positive, negative and zero."""
    values = np.linalg.eigvalsh(_form(space.scaled))
    positive, negative = (int(np.sum(sign * values > space.tolerance)) for sign in (1.0, -1.0))
    return positive, negative, len(values) - positive - negative


def _form(rows: FloatArray) -> FloatArray:
    """(k, k) q in some rows: half the work of each on each."""
    mixed = rows[:, :3] @ rows[:, 3:].T
    return np.asarray((mixed + mixed.T) / 2.0)


@dataclass(frozen=True, eq=False)
class Possible(Frozen):
    """What a freedom takes.

    Attributes:
        freedom: T, the wanted twists.
        off: By how much the freedom that was given is off this one, which is special; 0 where it
            is the one that was given (sine of the largest angle of their scaled rows).
        nearly: A special freedom from which this one is off by so little that one may have meant
            it; None where there is none.
    """

    freedom: ScrewSpace
    off: float = 0.0
    nearly: ScrewSpace | None = None

    @property
    def dimension(self) -> int:
        """How many independent motions."""
        return self.freedom.dimension

    @property
    def needed(self) -> int:
        """How many independent constraints leave just these."""
        return 6 - self.dimension

    @property
    def constraint(self) -> ScrewSpace:
        """W: the wrenches that do no work on the freedom."""
        return self.freedom.reciprocal

    @cached_property
    def signature_freedom(self) -> tuple[int, int, int]:
        """Of q on T: positive, negative and zero eigenvalues."""
        return signature_of(self.freedom)

    @cached_property
    def signature_constraint(self) -> tuple[int, int, int]:
        """Of q on W."""
        return signature_of(self.constraint)

    @cached_property
    def forces(self) -> ScrewSpace:
        """What the forces of W along lines span: all that wires can hold."""
        return self.constraint.of_scaled(orthonormal(self.constraint.span_of_lines))

    @cached_property
    def alone(self) -> ScrewSpace:
        """What wires alone leave: the freedom and what they cannot stop besides."""
        return self.forces.reciprocal if self.extra_dimension else self.freedom

    @property
    def extra_dimension(self) -> int:
        """In how many further ways a body on wires alone moves."""
        return self.needed - self.forces.dimension

    @cached_property
    def extra(self) -> ScrewSpace:
        """What wires alone leave besides: translations, where there are such, else screws."""
        every, spanned, made = self.alone.scaled, self.freedom.scaled, []
        free, lined = parted(every, EXACT)
        across = orthonormal(every - (every @ spanned.T) @ spanned)
        for row in (*canonical(free), *principal_rows(lined), *across):
            rest = row - spanned.T @ (spanned @ row)
            if np.linalg.norm(rest) > _CLEAR * np.linalg.norm(row):
                made.append(row)
                spanned = np.concatenate((spanned, rest[None] / np.linalg.norm(rest)))
        return self.freedom.of_scaled(orthonormal(np.array(made).reshape(-1, 6)))

    @property
    def parallel(self) -> bool:
        """Whether wires in parallel leave just this freedom (theorem 1)."""
        return not self.extra_dimension

    @property
    def wires(self) -> int | None:
        """The least number of wires; of folded sheets as many."""
        return self.needed if self.parallel else None

    @property
    def sheet(self) -> Family | None:
        """Where a whole sheet may be (theorem 2); None where no sheet fits.

        A plane: that one. A line: any plane through it. A direction: any plane across it. Every
        line, of a body that is held: any plane. A pencil or parallels in a plane: theirs.
        """
        if not self.dimension:
            return Family(FamilyKind.EVERY)
        families = self.freedom.families
        # A plane of rotations, or parallels in it, come with the translation across.
        is_flat = not any(self.signature_freedom[:2]) and families[0].kind in _FLAT
        return families[0] if is_flat else None

    @property
    def with_sheet(self) -> tuple[int, int] | None:
        """Sheets and wires, of an exactly constrained layout with a sheet: never two of them."""
        return (1, self.needed - _SHEET) if self.sheet is not None else None

    @property
    def waisted(self) -> tuple[int, int] | None:
        """Waisted sheets, as many as can be, and the wires beside them.

        A waisted sheet holds the lines through its waist in its plane. W has such a pencil at
        every point where T has rank one or less: everywhere for one motion or none; of two
        motions at the points of a rotation. Two pencils are independent but where both have a line
        in common, which is a rotation that is itself a force of W, or are in one plane.
        """
        if not self.parallel:
            return None
        if self.dimension <= 1:
            count = self.needed // 2
        elif self.dimension == 2:
            kinds, zero = {family.kind for family in self.freedom.lines}, self.signature_freedom[2]
            is_one = zero == 1 or FamilyKind.PARALLELS_IN_PLANE in kinds
            count = 0 if not kinds else 1 if is_one else 2
        else:
            count = int(any(family.kind in _WITH_PENCILS for family in self.constraint.families))
        return (count, self.needed - 2 * count) if count else None

    @property
    def notch(self) -> tuple[int, int] | None:
        """Notches, or cross hinges, and wires: where T is rotation about one line, or nothing."""
        if self.dimension and self.freedom.families[0].kind is not FamilyKind.LINE:
            return None
        return (1, self.needed - _NOTCH) if self.dimension <= 1 else None

    @property
    def rod(self) -> tuple[int, int] | None:
        """Rods with two parallel notches, and wires; the plane of their axes is `sheet`."""
        plane = self.sheet
        if plane is None or (self.dimension and plane.kind not in _OF_A_ROD):
            return None
        return 1, self.needed - _ROD

    @property
    def couples(self) -> int:
        """How many independent couples are in W; a bellows, or a limb, holds one."""
        return len(self.constraint.directions)

    @cached_property
    def limbs(self) -> tuple[int, int, int]:
        """Wires, couples and wrenches with pitch, the fewest of the latter, that span W.

        A couple takes a bellows, or a limb: a body on a hinge, held to the stage by two wires; a
        wrench with pitch a limb with two skew wires.
        """
        both = np.concatenate((self.forces.scaled, self.constraint.directions))
        spanned, lines = len(orthonormal(both)), self.forces.dimension
        return lines, spanned - lines, self.needed - spanned

    @property
    def bellows(self) -> tuple[int, int] | None:
        """Wires and bellows, where wires alone are not enough and these are."""
        wires, couples, pitched = self.limbs
        return (wires, couples) if couples and not pitched else None

    @cached_property
    def least_layers(self) -> int:
        """How many layers, each held by wires in parallel, have this freedom as their sum."""
        if self.parallel:
            return 1
        return 3 if len(self.freedom.directions) == self.dimension == 3 else 2


def possible(freedom: ScrewSpace) -> Possible:
    """What a freedom takes.

    Args:
        freedom: Twists, as they are given: independent rows, (w, v).

    A freedom that is off a special one by less than `NEAR` is taken for that; `Possible.off` says
    by how much. One that is off by less than `DOUBTFUL` is taken as it is given, and
    `Possible.nearly` is the special one.
    """
    rows = canonical(orthonormal(freedom.scaled))
    given = ScrewSpace(rows / freedom.factors, freedom.about, freedom.length, tolerance=EXACT)
    near = _special(given, NEAR)
    if near is not None:
        return Possible(near, given.sine_to(near))
    return Possible(given, 0.0, _special(given, DOUBTFUL))


def _special(given: ScrewSpace, limit: float) -> ScrewSpace | None:
    """The special space that a given one is nearer to than a limit, but for rounding; or None.

    Special is that q vanishes on more of it, or that it has more translations. Where q(r) is small
    for an eigenvector r, r - q(r) S r, with S to swap rotation and velocity, is a zero of q and
    reciprocal to the others up to q(r) squared.
    """
    rows = given.scaled
    for _ in range(_STEPS):
        if not _is_between(rows, limit):
            break
        free, lined = parted(rows, limit)
        rows = np.concatenate((lined, free))
        values, vectors = np.linalg.eigh(_form(rows))
        screws = vectors.T @ rows
        small = np.where(np.abs(values) < limit, values, 0.0)[:, None]
        rows = orthonormal(screws - small * np.roll(screws, 3, axis=1))
    made = given.of_scaled(canonical(rows))
    is_other = _kind(made) != _kind(given)
    return made if is_other and given.sine_to(made) < 10.0 * limit else None


def _kind(space: ScrewSpace) -> tuple[tuple[int, int, int], int]:
    return signature_of(space), len(space.directions)


def _is_between(rows: FloatArray, limit: float) -> bool:
    """Whether q or the rotation of some rows is neither zero nor clearly not."""
    if not len(rows):
        return False
    turns = np.linalg.svd(rows[:, :3], compute_uv=False)
    sizes = np.concatenate((turns, np.abs(np.linalg.eigvalsh(_form(rows)))))
    return bool(np.any((sizes > _ROUNDING) & (sizes < limit)))


def q_of(one: FloatArray, other: FloatArray) -> float:
    """The bilinear form of q: half the work of a screw on another, (6,) each."""
    return float(one[:3] @ other[3:] + one[3:] @ other[:3]) / 2.0


def orthonormal(rows: FloatArray) -> FloatArray:
    """Orthonormal rows that span what some rows span."""
    if not len(rows):
        return rows
    _, sizes, right = np.linalg.svd(rows, full_matrices=False)
    return np.asarray(right[sizes > EXACT * max(float(sizes[0]), 1.0)])


# Layers ------------------------------------------------------------------------------

#: How many bases of a freedom are cut at random, and after how many layers no more are; how many
#: a designer thinks of.
_RANDOM, _ENOUGH, _THOUGHT_OF = 24, 12, 3


def layers_of(freedom: ScrewSpace, typed: ArrayLike = ()) -> Iterator[tuple[ScrewSpace, ...]]:
    """Layers, each held by wires in parallel, whose freedoms add up to one, none twice.

    The fewest layers first, then one more. Of as many: layers of the motions as they are typed;
    then of the freedom's own directions, lines and screws; then of others. The first layer stands
    on the ground; stiff ones, of fewer motions, stand there first, the other way round later. No
    body between has a motion that nobody drives, as each sum is direct (theorem 3).

    Args:
        freedom: As of `possible`.
        typed: (6,) the wanted motions, in their order.
    """
    found = possible(freedom)
    count = found.dimension
    if not count:
        return
    least = found.least_layers
    seen: set[tuple[bytes, ...]] = set()
    for layers in range(least, min(least + 1, count, 3) + 1):
        for number, basis in enumerate(_bases(found.freedom, typed)):
            if number > _THOUGHT_OF and len(seen) >= _ENOUGH:
                break
            upright = sorted(_cuts(count, layers), key=lambda cut: tuple(map(len, cut)))
            for order in (1, -1):
                for cut in upright:
                    spaces = tuple(
                        found.freedom.of_scaled(orthonormal(basis[list(part)]))
                        for part in cut[::order]
                    )
                    key = tuple(_key(space) for space in spaces)
                    if key not in seen and all(Possible(space).parallel for space in spaces):
                        seen.add(key)
                        yield spaces


def _key(space: ScrewSpace) -> bytes:
    rows = space.scaled
    return np.asarray(np.round(rows.T @ rows, 6) + 0.0).tobytes()


def _bases(freedom: ScrewSpace, typed: ArrayLike) -> Iterator[FloatArray]:
    """(d, 6) bases of a freedom, scaled, first those of which a designer thinks."""
    rows, count = freedom.scaled, freedom.dimension
    wanted = np.array(typed).reshape(-1, 6) * freedom.factors
    # What is taken for special is a little off what was typed.
    wanted = unit((wanted @ rows.T) @ rows)
    if len(wanted) == count and len(orthonormal(wanted)) == count:
        yield wanted
    free, lined = parted(rows, freedom.tolerance)
    yield np.concatenate((lined, free))
    yield np.linalg.eigh(_form(rows))[1].T @ rows
    draws = np.random.default_rng(0)
    for _ in range(_RANDOM):
        yield np.linalg.qr(draws.normal(size=(count, count)))[0] @ rows


def _cuts(count: int, parts: int) -> Iterator[tuple[tuple[int, ...], ...]]:
    """Each way to cut so many things into so many parts, smaller parts first."""
    if parts == 1:
        yield (tuple(range(count)),)
        return
    for size in range(1, count // parts + 1):
        for first in combinations(range(count), size):
            rest = [k for k in range(count) if k not in first]
            for cut in _cuts(len(rest), parts - 1):
                others = tuple(tuple(rest[k] for k in part) for part in cut)
                if len(others[0]) > size or (len(others[0]) == size and first < others[0]):
                    yield (first, *others)
