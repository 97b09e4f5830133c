# SPDX-License-Identifier: BSD-3-Clause
"""Trace the path of a motion, both ways, and find its dead points."""

from __future__ import annotations

import math
import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ..analysis.decomposition import asked_for
from ..analysis.limits import TRUE
from ..analysis.result import Result, result_of
from ..model.model import Model
from ..model.reading import read
from ..motion import Ending, Followed, Held, Wishes, follow, is_followed, least_error
from ..motion.constraints import MOST_COORDINATES
from ..show.drawing.selection import Selection, select_motion
from ..util.errors import FlexactError
from ..util.quantities import Quantity, larger_in_words, without_units
from .output import TRACES
from .stroke import Stroke
from .values import Traced, Way
from .words import lines


@dataclass(frozen=True, eq=False, repr=False)
class Trace(Traced):
    """The path of a motion, or of a declared degree of freedom, with words and files of it."""

    def describe(self) -> str:
        """How far it goes each way, what stops it, its dead points and verdicts, in words."""
        return "\n".join(lines(self))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write it to a file, whole or not at all.

        Args:
            path: Its suffix says what it is to be: .csv, a row a step; a picture (.png, .svg, .pdf)
                of singular values and coordinates along the path; .pvd, a cycle that plays in
                ParaView.

        Raises:
            FlexactError: There is no such kind of file, a package is missing, or the file cannot
                be written.
        """
        TRACES.save(self, self.result.given, Path(path))


#: How far each way by default, in sizes of the model, and by how many steps.
LENGTH, STEPS = 1.0, 50
#: What ends both ways within so small a part of the size is no path: held deformations have not
#: become larger than what counts as zero. Nor is it where they have grown out of rounding.
_NO_PATH, _NEAR, _GROWN = 1.0e-3, 0.1, 1.0e-14
#: Where held deformations are looked at if there is no path, a part of the size.
_TRIED = 0.01
#: Halved so often a step is too small.
_LEAST = 2.0**-11
#: Singular values up to here are zero away from the reference, where nothing smaller is not.
_ZERO = 1.0e-10


class TraceError(FlexactError):
    """A path that cannot be traced."""


def trace(
    model: Model | Result | str | bytes | os.PathLike[str] | os.PathLike[bytes],
    *,
    motion: int | None = None,
    freedom: int | str | None = None,
    length: Quantity | None = None,
    steps: int = STEPS,
    through: bool = True,
    beyond: bool = False,
    progress: Callable[[float], None] | None = None,
) -> Trace:
    """Follow a motion on D(x) = 0, eq. (5), both ways from the reference.

    All fixed and independent deformations stay zero; of a declared degree of freedom the
    declaration is let loose, so that the path goes on where it can be driven no farther.

    Args:
        model: A model, the path of a deck, or an analysis.
        motion: The number, from 1, of one of the motions that nothing determines; by default the
            first of them, else the first declared degree of freedom that can move.
        freedom: The number, from 1, of a declared degree of freedom instead, or its name, such as
            "stage y".
        length: How far each way [m], or a text such as "20mm": of the node that moves farthest,
            a rotation of 1 rad counting as the model's size. By default that size.
        steps: By how many steps each way, at least.
        through: Whether to go straight on where other paths branch off; else the path ends there.
        beyond: Whether the length may be larger than the model.
        progress: Called with the part that is done, from 0 to 1.

    Raises:
        DeckError: the model's deck is wrong.
        ModelError: the model is wrong.
        FlexactError: there is no such motion or freedom, the path cannot be begun, or the length
            is larger than the model, and not `beyond`.
        TypeError: something is of another kind than it must be.
        ValueError: the length or the number of steps is not positive.
    """
    result = _analysed(model)
    wished = _checked(length, steps)
    if motion is not None and freedom is not None:
        raise TraceError("a motion or a degree of freedom is traced, not both")
    shown = select_motion(result, motion, freedom)
    if shown is None:
        raise TraceError(
            "there is nothing to trace: the mechanism has no motion, and no declared degree of "
            "freedom that can move"
        )
    data = shown.motion.analysed.data
    if not is_followed(data):
        raise TraceError(
            f"the model has more than {MOST_COORDINATES} coordinates that may change, too many to "
            "be followed; declare divided sheets (flexact declare), or trace a smaller model"
        )
    held = Held(data)
    size = 1.0 if wished is None else wished / held.size
    if wished is not None and wished > data.size and size > 1.0 and not beyond:
        whole = f"the whole model, {data.size:.3g} m"
        raise TraceError(larger_in_words("the length", f"{wished:g} m", whole, "20mm"))
    most = size / steps
    wishes = Wishes(size, most, most, _LEAST * min(most, 0.1), 100 * steps + 2000, through)
    return _traced(result, shown, held, wishes, progress)


def _analysed(given: object) -> Result:
    if isinstance(given, Result):
        return given
    if isinstance(given, Model):
        return result_of(given.data, asked_for("auto", None))
    if isinstance(given, (str, bytes, os.PathLike)):
        return result_of(read(given).data, asked_for("auto", None))
    raise TypeError(
        f"a model, the path of a deck or an analysis can be traced, not {type(given).__name__}"
    )


def _checked(length: Quantity | None, steps: int) -> float | None:
    if isinstance(steps, bool) or not isinstance(steps, int):
        raise TypeError(f"the number of steps must be whole, not {type(steps).__name__}")
    if steps < 1:
        raise ValueError("there must be one step each way at least")
    if length is None:
        return None
    length = without_units(length, "m")
    if isinstance(length, bool) or not isinstance(length, (int, float, np.floating, np.integer)):
        raise TypeError(f"the length must be a number, not {type(length).__name__}")
    if not (math.isfinite(length) and length > 0.0):
        raise ValueError("the length must be positive and finite")
    return float(length)


def _traced(
    result: Result,
    shown: Selection,
    held: Held,
    wishes: Wishes,
    progress: Callable[[float], None] | None,
) -> Trace:
    direction = held.direction(shown.motion.analysed)
    zero = _zero_of(result)
    rank = result.rank
    if shown.freedom is not None:
        values = np.linalg.svd(held.scaled(held.reference), compute_uv=False)
        rank = int(np.count_nonzero(values > max(result.tolerance, result.raw.noise)))
    stroke = Stroke(result, shown, held, zero)
    ways: list[Followed] = []
    for number, sense in enumerate((-1.0, 1.0)):

        def report(arc: float, before: int = number) -> None:
            if progress is not None:
                progress(min(1.0, 0.5 * (before + arc / wishes.length)))

        ways.append(follow(held, sense * direction, rank, wishes, zero, report))
    _require_begun(result, ways, held)
    against, along = (stroke.steps(way) for way in ways)
    steps = (*(replace(step, arc=-step.arc) for step in against[:0:-1]), *along)
    whole = stroke.at_reference(steps, ways)
    ends = (Way(way.length * held.size, way.stop) for way in ways)
    return Trace(result, shown, held.size, whole, *ends)


def _zero_of(result: Result) -> float:
    """Up to where scaled singular values are zero on the path.

    Rounding of places is magnified there; what is small at the reference and not zero stays so.
    """
    gap = result.gap
    above = gap.smallest_nonzero or 1.0
    below = max(result.raw.noise, gap.largest_zero or 0.0)
    return max(min(_ZERO, math.sqrt(above * below)), result.raw.noise)


def _require_begun(result: Result, ways: list[Followed], held: Held) -> None:
    """Raise where the path goes neither way.

    Raises:
        TraceError: It does not.
    """
    far = max(way.length for way in ways)
    ends = all(way.stop.ending is Ending.NOT_ZERO for way in ways)
    grown = far < _NEAR and max(way.residual for way in ways) > _GROWN
    if far > 0.0 and not (ends and (far < _NO_PATH or grown)):
        return
    start, stop = ways[1].stations[0], ways[1].stop
    if stop.ending is Ending.ELEMENT:
        element = int(result.data.arrays.element_number[stop.element])
        raise TraceError(f"the path cannot be begun: element {element} is at the end of its range")
    _, largest = least_error(held, start.tangent, _TRIED)
    tried = (
        f"{_TRIED * held.size:.2g} m along it, held deformations of {largest:.2g} of the "
        "model's size are left at the least"
    )
    if start.directions > 1:
        here = f"the mechanism can move in {start.directions} independent directions here"
        if largest <= TRUE:
            raise TraceError(
                f"the path cannot be begun: {here}, and the paths that are near leave in others "
                "than this one. Trace from a configuration a little way along one of them"
            )
        raise TraceError(
            f"the path cannot be begun: {here}, and no path leads along this one: {tried}"
        )
    raise TraceError(
        f"the path cannot be begun: the motion is infinitesimal, or ends here; {tried}"
    )
