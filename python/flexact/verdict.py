"""Verdict, counts and gap: the small parts of a result."""

from __future__ import annotations

from enum import Enum
from typing import NamedTuple


class Verdict(str, Enum):
    """What Table 1 of the paper says about rows, columns and rank of D(c)."""

    EXACT = "exactly constrained"
    UNDER = "under-constrained"
    OVER = "over-constrained"
    BOTH = "under-constrained and over-constrained"

    def __str__(self) -> str:
        """The words themselves."""
        return self.value


class ClassCounts(NamedTuple):
    """How many coordinates or deformations there are of each class, eq. (7)."""

    total: int
    fixed: int
    dependent: int
    independent: int


class Counts(NamedTuple):
    """Counts by class; a dependent deformation is a released one."""

    coordinates: ClassCounts
    deformations: ClassCounts


class Gap(NamedTuple):
    """The scaled singular values on both sides of the decision on rank, None without one."""

    smallest_nonzero: float | None
    largest_zero: float | None
