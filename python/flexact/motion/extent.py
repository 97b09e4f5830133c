# SPDX-License-Identifier: BSD-3-Clause
"""Whether a motion goes on or only begins, and what says so: values."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import NamedTuple

from ..util.records import Frozen
from .ending import Ending


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


class Reason(str, Enum):
    """What a decision rests on, or what kept it open."""

    NO_SELF_STRESS = "no self-stress"
    """None feels the motion: what is held is independent (implicit function theorem)."""
    RIGID = "rigid"
    """All that hangs together moves as one rigid body, which strains nothing."""
    DEFINITE = "definite"
    """A combination of the self-stresses has a definite second-order form: no motion goes on."""
    STRAINED = "strained"
    """The second-order form of a self-stress is not zero for this motion."""
    REGULAR = "regular"
    """The forms are zero for this motion and change sign beside it: a path begins with it."""
    AMONG_OTHERS = "among others"
    """It is inside of sheets or wires, and can be so chosen among those inside of them."""
    PATH = "path"
    """It was followed."""
    ORDER = "order"
    """The order of the least strain was fitted."""
    ONE_WAY = "one way"
    """It goes on one way, but not the other."""
    STOPPED = "stopped"
    """It was followed, but not over a tenth of the size both ways."""
    NO_ORDER = "no order"
    """It was not followed, and no order fits the least strain."""
    ASIDE = "aside"
    """The least strain is met along another motion."""
    TOO_LARGE = "too large"
    """So many coordinates are not followed, or not any longer."""
    NOT_GIVEN = "not given"
    """Of so large a space not all vectors are known."""


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


@dataclass(frozen=True)
class Branch(Frozen):
    """A path that several motions begin together.

    Attributes:
        shares: Index of a told motion, and how much of it; the largest is 1.
    """

    shares: tuple[tuple[int, float], ...]


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
