# SPDX-License-Identifier: BSD-3-Clause
"""Whether a motion goes on or only begins, and what says so: values."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum
from typing import Literal, NamedTuple

from ..analysis.decomposition import Decomposition
from ..analysis.naming import Line, Pieces, length_in_words, line_of
from ..util.records import Frozen
from .follow import Ending


class Kind(str, Enum):
    """Whether a motion goes on."""

    FINITE = "finite"
    """It is the velocity of a path on which all that is held stays as it is."""
    INFINITESIMAL = "infinitesimal"
    """It only begins: what is held is strained, of second order or higher."""
    UNDECIDED = "undecided"


class EvidenceKind(str, Enum):
    """What says so."""

    CERTIFIED = "certified"
    """A theorem, whose conditions hold with a margin over rounding."""
    FOLLOWED = "followed"
    """The path was followed over a tenth of the size both ways."""
    FITTED = "fitted"
    """The least strain was measured, and its order fitted."""
    NONE = ""


#: What a decision rests on, or what kept it open.
Reason = Literal[
    # None feels the motion: what is held is independent (implicit function theorem).
    "no self-stress",
    # All that hangs together moves as one rigid body, which strains nothing.
    "rigid",
    # A combination of the self-stresses has a definite second-order form: no motion goes on.
    "definite",
    # The second-order form of a self-stress is not zero for this motion.
    "strained",
    # The forms are zero for this motion and change sign beside it: a path begins with it.
    "regular",
    # It is inside of sheets or wires, and can be so chosen among those inside of them.
    "among others",
    # It was followed.
    "path",
    # The order of the least strain was fitted.
    "order",
    # It goes on one way, but not the other.
    "one way",
    # It was followed, but not over a tenth of the size both ways.
    "stopped",
    # It was not followed, and no order fits the least strain.
    "no order",
    # The least strain is met along another motion.
    "aside",
    # So many coordinates are not followed, or not any longer.
    "too large",
    # Of so large a space not all vectors are known.
    "not given",
]


class Fit(NamedTuple):
    """The order of the least strain along a motion, as it was fitted."""

    order: float
    """k of t^k."""
    spread: float
    """What of its logarithm the fit leaves, root of the mean square [1]."""
    decades: float
    """Powers of ten of the strain over which it was fitted, all above rounding."""


@dataclass(frozen=True)
class Extent(Frozen):
    """Whether a motion goes on or only begins.

    Attributes:
        kind: "finite", "infinitesimal" or "undecided".
        evidence: "certified", "followed", "fitted", or "" where it is undecided.
        reason: What it rests on, or what kept it open.
        reach: How far it was followed backwards and forwards, lengths of the path of the node
            that moves farthest [m], rotations times `size`; None where it was not tried.
        stops: Why it was not followed farther, backwards and forwards; None likewise.
        residual: The largest deformation that is held on that path, or where it was least,
            as a part of `size`; None where it was not tried.
        size: Of what hangs together and moves [m].
        curvature: Of its second-order form [1]: a unit of the motion strains what is held by
            at least about half of this times its square; None where that is not known.
        fit: The order of the least strain; None where it was not fitted.
    """

    kind: Kind
    evidence: EvidenceKind
    reason: Reason
    reach: tuple[float, float] | None = None
    stops: tuple[Ending, Ending] | None = None
    residual: float | None = None
    size: float = 0.0
    curvature: float | None = None
    fit: Fit | None = None


#: A path that several motions begin together: indices of told motions, and how much of each; the
#: largest is 1.
Branch = tuple[tuple[int, float], ...]


@dataclass(frozen=True)
class Extents(Frozen):
    """Which motions of an analysis go on.

    Attributes:
        motions: One for each of `Result.motions`.
        finite_dimension: The dimension of the positions near the reference that can be reached
            without strain; None where it was not decided.
        branches: Paths of one dimension that begin with several motions, where they were met.
    """

    motions: tuple[Extent, ...]
    finite_dimension: int | None
    branches: tuple[Branch, ...] = ()


#: Shares of motions are told with so many digits, and strains from here on.
_DIGITS = 3
_LEAST = 1.0e-15
_PLAIN = {
    "rigid": "it goes on: certified, all that hangs together moves as one body",
    "definite": "it only begins: certified, any displacement t strains what is held as t^2",
    "strained": "it only begins: certified, a displacement t strains what is held as t^2",
    "regular": "it goes on: certified, the self-stresses leave it free to second order",
    "among others": "it goes on: certified, the self-stresses leave it free to second order",
    "too large": "undecided whether it goes on: to follow it takes too much work",
    "not given": "undecided whether it goes on: not all motions and self-stresses are known",
}
_STOPS = {
    Ending.BRANCHES: "others branch off",
    Ending.TURNS_BACK: "it can only turn back",
    Ending.NOT_ZERO: "no position without strain was found near",
    Ending.ELEMENT: "an element has left its range",
    Ending.STEPS: "it took too many steps",
}


def extent_in_words(outcome: Decomposition, extent: Extent) -> Pieces:
    """Whether a motion goes on, and what says so; such as "it goes on: followed over ..."."""
    if extent.reason == "no self-stress":
        none = "as there is no self-stress"
        feels = "as no self-stress feels it"
        return (f"it goes on: certified, {feels if outcome.over_constrained else none}",)
    if extent.reason in _PLAIN:
        return (_PLAIN[extent.reason],)
    if extent.reason == "path":
        both = length_in_words(min(extent.reach or (0.0, 0.0)))
        return (f"it goes on: followed over {both} both ways, residual {_residual(extent)}",)
    if extent.fit is not None:
        fit, order = extent.fit, round(extent.fit.order)
        return (
            f"it only begins: the least strain grows as t^{order} (fitted: {fit.order:.2f} over "
            f"{fit.decades:.1f} powers of ten)",
        )
    return (f"undecided whether it goes on: {_open(extent)}",)


def finite_in_words(extents: Extents) -> tuple[Line, ...]:
    """What several motions can do together; empty where each one says it all."""
    if len(extents.motions) < 2:
        return ()
    dimension, many = extents.finite_dimension, len(extents.motions)
    wide = f"{dimension} dimension{'' if dimension == 1 else 's'}"
    if dimension is None:
        words = "Undecided in how many dimensions these motions go on together."
    elif dimension == 0:
        words = "None of these motions goes on, nor do any together."
    elif dimension == many:
        words = f"Together they go on in all {many} dimensions."
    elif all(each.kind is Kind.INFINITESIMAL for each in extents.motions):
        words = f"None of these motions goes on as it is, but together they do, in {wide}."
    else:
        words = f"Together they go on in {wide} of {many}."
    paths = (f"A path begins with {_shares(branch)}." for branch in extents.branches)
    return tuple(map(line_of, (words, *paths)))


def _shares(branch: Branch) -> str:
    """Such as "motion 1 less 0.5 of motion 2"."""
    words = ""
    for index, share in sorted(branch, key=lambda each: -each[1]):
        size = abs(float(f"{share:.{_DIGITS}g}"))
        if size < 1.0e-3:
            continue
        times = "" if size == 1.0 else f"{size:.{_DIGITS}g} of "
        joint = (" less " if share < 0.0 else " and ") if words else ("-" if share < 0.0 else "")
        words += f"{joint}{times}motion {index + 1}"
    return words


def _open(extent: Extent) -> str:
    """What was tried."""
    if extent.reason == "one way":
        return f"followed over {_each(extent)}, it goes on one way alone"
    if extent.reason == "aside":
        return "near it the least strain is met along other motions"
    if extent.reason == "no order" or not extent.reach:
        return "it was not followed, and no order fits the least strain"
    where = sorted({_STOPS[stop] for stop in extent.stops or () if stop in _STOPS})
    why = f"; there {' and '.join(where)}" if where else ""
    return f"followed over {_each(extent)}, residual {_residual(extent)}{why}"


def _each(extent: Extent) -> str:
    back, ahead = (length_in_words(each) for each in extent.reach or (0.0, 0.0))
    return f"{back} one way and {ahead} the other"


def _residual(extent: Extent) -> str:
    """The largest strain by the size, the next power of ten."""
    power = math.ceil(math.log10(max(extent.residual or 0.0, _LEAST)))
    return f"below 1e{power} of the size"
