# SPDX-License-Identifier: BSD-3-Clause
"""Which motion is shown where several could be."""

from __future__ import annotations

import contextlib
from dataclasses import dataclass, replace

import numpy as np

from ...analysis.body_motions import Velocities
from ...analysis.freedoms import Freedom
from ...analysis.mode_basis import coordinate_key, ranked
from ...analysis.result import Result
from ...deck.rendering import ModelError
from ...util.errors import BatchError, FlexactError
from ...util.partial import attempted
from ...util.records import Frozen
from .movement import Moving, natural_shape


def way_of(freedom: Freedom) -> Moving | None:
    """The motion of a declared degree of freedom as it is drawn; None where it cannot move.

    It has its natural shape (`natural_shape`), where that can be found. A coordinate grows. The
    sign of a deformation depends on which end is p; its motion is drawn with the sense in which
    its largest part is positive, of equal ones the first by name and place.

    Raises:
        AnalysisError: The motion cannot be found.
    """
    if freedom.motion is None:
        return None
    plain = freedom.motion
    motion = attempted("Its shape", lambda: natural_shape(freedom.analysis, plain), plain, None)
    if freedom.is_coordinate:
        return motion
    outcome, length = freedom.analysis, freedom.analysis.characteristic_length
    given = motion.analysed
    both = given.displacement + length * given.rotation
    node, axis = (each.tolist() for each in np.nonzero(both))
    (first,) = ranked(both[node, axis], 1, lambda i: coordinate_key(outcome, node[i], axis[i]))
    sense = np.sign(both[node[first], axis[first]])
    analysed = Velocities(given.data, sense * given.displacement, sense * given.rotation)
    return replace(motion, analysed=analysed)


#: How many degrees of freedom are tried, whether they can move, where none was asked for.
_MOST_TRIED = 24


@dataclass(frozen=True, eq=False)
class Selection(Frozen):
    """A motion that is shown.

    Attributes:
        motion: The motion.
        number: Which one of the motions or degrees of freedom it is, from 1.
        freedom: The degree of freedom that it is the motion of; None of a motion that nothing
            determines.
    """

    motion: Moving
    number: int
    freedom: Freedom | None = None


def select_motion(
    analysis: Result, motion: int | None = None, freedom: int | str | None = None
) -> Selection | None:
    """The motion that is shown.

    Args:
        analysis: The result.
        motion: The number, from 1, of one of its kinematically indeterminate motions.
        freedom: The number, from 1, of one of its declared degrees of freedom, or its name, such
            as "stage y"; see `Result.freedom`.

    Returns:
        The one asked for; else the first motion; else that of the first degree of freedom that
        can move; None where the mechanism does not move.

    Raises:
        BatchError: There is none of that number, or the degree of freedom cannot move.
        AnalysisError: The motion of that degree of freedom cannot be found.
    """
    if freedom is not None and motion is None:
        return _of_freedom(analysis, freedom)
    if motion is not None or len(analysis.motions):
        number = 1 if motion is None else motion
        require_there(number, len(analysis.motions), "motion", "motions")
        return Selection(analysis.motions[number - 1], number)
    for number, each in enumerate(analysis.freedoms[:_MOST_TRIED], start=1):
        # Nobody asked for it, so that it is none where it cannot be found.
        with contextlib.suppress(FlexactError):
            if each.motion is not None:
                return _of_freedom(analysis, number)
    return None


def require_there(number: int, count: int, what: str, plural: str) -> None:
    """Raise unless one of this number, from 1, is among so many.

    Raises:
        BatchError: It is not; this says how many there are.
    """
    if not 1 <= number <= count:
        there = f"{count or 'no'} {what if count == 1 else plural}"
        raise BatchError(f"there is no {what} {number}: the analysis gives {there}")


def _of_freedom(analysis: Result, given: int | str) -> Selection:
    if isinstance(given, str):
        try:
            number = analysis.freedoms.index(analysis.freedom(given)) + 1
        except ModelError as error:
            first = error.diagnostics[0]
            raise BatchError(f"{first.message}: {first.help}") from None
    else:
        number, count = given, len(analysis.freedoms)
        require_there(number, count, "degree of freedom", "degrees of freedom")
    chosen = analysis.freedoms[number - 1]
    if (found := way_of(chosen)) is None:
        raise BatchError(f"degree of freedom {number}, {chosen.label}, cannot move")
    return Selection(found, number, chosen)
