# SPDX-License-Identifier: BSD-3-Clause
"""Variants of one topology, by their positions or by what they hold.

The core runs through them in threads, without a Python object for each. What it cannot decide
without a doubt (a value near rounding, digits that may explain one, a wrong geometry) is
analysed here as a single model would be, so that each row says what `flexact.analyse` says.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, as_completed
from typing import NamedTuple

import numpy as np

from ..analysis.certainty import CUT_OFF, NEAR, REACH_OF_DIGITS
from ..analysis.decomposition import Asked
from ..analysis.failing import AnalysisError
from ..analysis.margin import NOTHING, least_misalignments
from ..analysis.result import result_of
from ..analysis.sensitivity import MOST_OTHERS, MOST_WORK, MOST_ZEROS
from ..analysis.verdict import Certainty, Verdict
from ..core import calls
from ..core.arrays import BoolArray, FloatArray
from ..core.progress import Progress
from ..core.raw import RawVariants
from ..deck.errors import DeckError, ModelError
from ..model.data import ModelData
from ..model.parts.chains import perhaps_condensed
from ..model.variation import classes_held, varied
from ..util import memory
from ..util.processors import processors
from .columns import columns_of
from .row import MISSING, Value, error_row, in_a_line, row_of

Columns = dict[str, np.ndarray]
#: So many variants at once: some milliseconds of work, and few numbers.
_MOST_AT_ONCE = 256
_VERDICTS = np.array([v.value for v in (Verdict.EXACT, Verdict.UNDER, Verdict.OVER, Verdict.BOTH)])
#: How texts of each column are held; errors, which are few and long, as objects.
_TEXTS = {
    "verdict": _VERDICTS.dtype,
    "certainty": np.array([c.value for c in Certainty]).dtype,
}


class _Variants(NamedTuple):
    """Variants of a model; one of positions and held may be the model's own."""

    data: ModelData
    positions: FloatArray | None
    held: BoolArray | None

    @property
    def number(self) -> int:
        """How many there are."""
        given = self.positions if self.positions is not None else self.held
        return 1 if given is None else len(given)

    def some(self, first: int, last: int) -> _Variants:
        """Those from first up to, but not including, last."""
        return self._replace(
            positions=None if self.positions is None else self.positions[first:last],
            held=None if self.held is None else self.held[first:last],
        )

    def one(self, i: int) -> ModelData:
        """One of them as a model."""
        positions = None if self.positions is None else self.positions[i]
        return varied(self.data, positions, None if self.held is None else self.held[i])

    def classes(self) -> np.ndarray:
        """(variants or 1, elements, 6) of deformations."""
        if self.held is None:
            return np.ascontiguousarray(self.data.arrays.deformation_class.T[None])
        return np.ascontiguousarray(np.swapaxes(classes_held(self.data, self.held), 1, 2))


def swept(
    data: ModelData,
    *,
    positions: FloatArray | None = None,
    held: BoolArray | None = None,
    want: str = "values",
    workers: int | None = None,
    progress: Progress | None = None,
) -> Columns:
    """The columns of a table for variants of a model, by name, each of (variants,).

    Args:
        data: A sound model.
        positions: (variants, nodes, 3) [m], as `positions_given` gives them.
        held: (variants, elements, 6), as `held_given` gives them; one of the two at least.
        want: One of `WANTS`.
        workers: So many threads at most; by default one a processor.
        progress: Called with what is being done and how much of that is done, from 0 to 1.
    """
    every = _Variants(data, positions, held)
    made: Columns = {
        c.name: np.full(every.number, MISSING[c.kind], _TEXTS.get(c.name, c.kind))
        for c in columns_of(want)
    }
    made["error"] = np.full(every.number, "", object)
    # Where only positions differ, what is held does not.
    common = _perhaps_condensed(every.some(0, 1)) if held is None else None
    threads = workers or processors()
    step = max(1, min(_MOST_AT_ONCE, -(-every.number // (4 * threads))))
    starts = range(0, every.number, step)
    room = memory.allowance() / threads
    done = 0

    def run(first: int) -> int:
        last = min(first + step, every.number)
        _fill(
            every.some(first, last), want, room, common, {k: v[first:last] for k, v in made.items()}
        )
        return last - first

    for number in _in_threads(run, starts, threads):
        done += number
        if progress is not None:
            progress("analysing variants", done / every.number)
    return made


def _in_threads(run: Callable[[int], int], items: Sequence[int], threads: int) -> Iterator[int]:
    if threads == 1 or len(items) < 2:
        yield from map(run, items)
        return
    with ThreadPoolExecutor(threads) as pool:
        futures: list[Future[int]] = [pool.submit(run, item) for item in items]
        try:
            for future in as_completed(futures):
                yield future.result()
        finally:
            for future in futures:
                future.cancel()


def _perhaps_condensed(some: _Variants) -> BoolArray:
    """(variants or 1,) whether a row of beams may count as one beam in some geometry."""
    return perhaps_condensed(some.data.arrays, some.data.element_names, some.classes())


def _fill(some: _Variants, want: str, room: float, common: BoolArray | None, part: Columns) -> None:
    """Put what is known of some variants into their part of the columns; room: bytes."""
    condensed = _perhaps_condensed(some) if common is None else common
    if not condensed.all():
        known, decided = _decided_by_core(some, want, room)
        decided &= ~condensed
        for name, array in known.items():
            part[name][decided] = array[decided]
    else:
        decided = np.zeros(some.number, np.bool_)
    for i in np.flatnonzero(~decided).tolist():
        for name, value in _row(some.one(i), want).items():
            part[name][i] = value


def _decided_by_core(some: _Variants, want: str, room: float) -> tuple[Columns, BoolArray]:
    """The columns that the core gives, and (variants,) for which of them they hold."""
    with_values = want != "verdict"
    own = some.data.arrays.node_value[:3].T[None]
    wishes = calls.VariantWishes(
        *(NEAR, CUT_OFF, REACH_OF_DIGITS, with_values, room, None),
        some.data.has_long_numbers,
        (MOST_ZEROS, MOST_OTHERS, MOST_WORK, NOTHING),
    )
    positions = own if some.positions is None else some.positions
    raw = calls.analyse_variants(some.data.packed, wishes, positions, some.classes())
    return _known(raw, with_values), raw.decided


def _known(raw: RawVariants, with_values: bool) -> Columns:
    """The columns of variants that are decided."""
    under, over = raw.columns - raw.rank, raw.rows - raw.rank
    made: Columns = {
        "verdict": _VERDICTS[(under > 0) + 2 * (over > 0)],
        "under_constrained": under,
        "over_constrained": over,
        "rank": raw.rank,
        "certainty": np.full(raw.rank.size, Certainty.CERTAIN.value),
    }
    if with_values:
        full = raw.rank == np.minimum(raw.rows, raw.columns)
        with np.errstate(divide="ignore", invalid="ignore"):
            condition = np.where(full & (raw.smallest > 0.0), raw.largest / raw.smallest, np.nan)
        margin, angle = least_misalignments(
            raw.pair_value, raw.by_move, raw.by_turn, raw.characteristic_length
        )
        # What is there in exact alignment only has no margin.
        exact = raw.zero_moves | raw.zero_turns
        margin = np.where(exact, np.where(raw.zero_moves, 0.0, np.inf), margin)
        angle = np.where(exact, np.where(raw.zero_turns, 0.0, np.inf), angle)
        made |= {
            "gap": raw.pair_value[:, 0],
            "largest_zero": raw.largest_zero,
            "smallest_singular_value": raw.smallest,
            "condition_number": condition,
            "margin": margin,
            "margin_angle": angle,
        }
    return made


def _row(data: ModelData, want: str) -> dict[str, Value]:
    try:
        return row_of(result_of(data, Asked()), want)
    except (AnalysisError, DeckError, ModelError) as error:
        return error_row(in_a_line(error), want)
