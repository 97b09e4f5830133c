# SPDX-License-Identifier: BSD-3-Clause
"""Variants of one topology, by their positions or by what they hold.

The core runs through them in threads, without a Python object for each. What it cannot decide
without a doubt (a value near rounding, digits that may explain one, a wrong geometry) is
analysed here as a single model would be, so that each row says what `flexact.analyse` says.
"""

from __future__ import annotations

import math
import zlib
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeVar

import numpy as np

from ..analysis.certainty import least_misalignments
from ..analysis.decomposition import Asked
from ..analysis.limits import CUT_OFF, NEAR, NO_CHANGE, REACH_OF_DIGITS
from ..analysis.rank_evidence import MOST_OTHERS, MOST_WORK, MOST_ZEROS
from ..analysis.result import Result, result_of
from ..analysis.verdict import AnalysisError, Certainty, Verdict
from ..core import calls
from ..core.arrays import BoolArray, FloatArray
from ..core.elements import Class, NodeKind
from ..core.progress import Progress
from ..core.raw import RawVariants
from ..deck.rendering import DeckError, ModelError
from ..model.data import ModelData
from ..model.model import Model
from ..model.parts.chains import perhaps_condensed
from ..model.parts.condensing import Condensed, condensed, places_in, ways_on
from ..model.variation import classes_held, varied
from ..util import machine as memory
from ..util.machine import processors
from ..util.records import Frozen
from .columns import MISSING, columns_of, error_row, in_a_line, row_of
from .columns import Value as Cell
from .parameters import Row


class MotionArrays(NamedTuple):
    """The motions of a variant, as `Result.motions` has them; as many as are given there."""

    displacement: FloatArray
    """(motions, nodes, 3) [m]; zero for orientations."""
    rotation: FloatArray
    """(motions, nodes, 3) [rad]; zero for positions that have none."""


class StressArrays(NamedTuple):
    """The self-stresses of a variant, as `Result.self_stresses` has them."""

    forces: FloatArray
    """(self-stresses, elements, 6) by deformation [N]."""
    moments: FloatArray
    """(self-stresses, elements, 6) by deformation [N m]."""


NO_MOTIONS = MotionArrays(np.zeros((0, 0, 3)), np.zeros((0, 0, 3)))
NO_STRESSES = StressArrays(np.zeros((0, 0, 6)), np.zeros((0, 0, 6)))


def modes_of(result: Result) -> tuple[MotionArrays, StressArrays]:
    """The arrays of one result."""
    arrays, motions, stresses = result.given.arrays, result.motions, result.self_stresses
    of_nodes = (len(motions), arrays.node_number.size, 3)
    of_elements = (len(stresses), arrays.element_number.size, 6)
    return (
        MotionArrays(
            np.array([each.displacement for each in motions], float).reshape(of_nodes),
            np.array([each.rotation for each in motions], float).reshape(of_nodes),
        ),
        StressArrays(
            np.array([each.forces for each in stresses], float).reshape(of_elements),
            np.array([each.moments for each in stresses], float).reshape(of_elements),
        ),
    )


#: Entries of D(c), as it is held in full, over all coordinates.
MOST_ENTRIES = 16_000_000


class Signed(NamedTuple):
    """A singular value of the scaled D(c), with a sign."""

    value: float
    """Its sign is that of the determinant, where D(c) is square and all singular values count;
    NaN where there is no such singular value."""
    topology: int
    size: int
    """How many singular values there are."""


#: Of variants their `Signed`, as an array of records; the topology is -1 where there is none.
_SIGNED = np.dtype([("value", np.float64), ("topology", np.int64), ("size", np.int64)])


def signed_column(every: Iterable[Signed | None]) -> np.ndarray:
    """(variants,) records of variants."""
    none = Signed(math.nan, -1, 0)
    return np.array([each or none for each in every], _SIGNED)


def scaled_jacobian(data: ModelData) -> tuple[FloatArray, int]:
    """D(c) as rank is decided on, but for components of quite another size.

    Rotations are multiplied by the characteristic length, and each row, over all coordinates,
    is brought to the norm one. Scales are positive, so that they keep the determinant's sign.

    Returns:
        (m, n) free of units, theory.md (2); and a number that is the same for models whose rows
        and columns are the same deformations and coordinates.

    Raises:
        AnalysisError: it is too large.
    """
    one = condensed(data).data
    arrays = one.arrays
    raw = calls.assemble(one.packed, arrays.node_value, np.zeros(arrays.element_number.size))
    deformations, coordinates = arrays.deformation_class.T, arrays.coordinate_class.T
    rows = np.flatnonzero((deformations == Class.FIXED) | (deformations == Class.INDEPENDENT))
    columns = np.flatnonzero(coordinates == Class.DEPENDENT)
    if rows.size * coordinates.size > MOST_ENTRIES:
        raise AnalysisError(
            f"D(c) has {rows.size} rows and the model {coordinates.size} coordinates, too many to "
            "follow a singular value between variants"
        )
    place = np.full(deformations.size, -1)
    place[rows] = np.arange(rows.size)
    there = place[raw.row_of] >= 0
    full = np.zeros((rows.size, coordinates.size))
    np.add.at(full, (place[raw.row_of[there]], raw.column_of[there]), raw.value[there])
    turns = np.repeat(arrays.node_kind > NodeKind.POSITION, coordinates.shape[1])
    lengths = one.frames.length[one.frames.length > 0.0]
    full[:, turns] /= math.exp(float(np.log(lengths).mean())) if lengths.size else 1.0
    norm = np.linalg.norm(full, axis=1, keepdims=True)
    matrix = full[:, columns] / np.where(norm > 0.0, norm, 1.0)
    topology = 0
    for array in (arrays.element_kind, arrays.element_node, rows, columns):
        topology = zlib.crc32(np.ascontiguousarray(array).tobytes(), topology)
    return matrix, topology


def signed_value(data: ModelData, rank: int | None = None) -> Signed:
    """The smallest singular value of the scaled D(c), or that which ends a rank.

    Args:
        data: A sound model.
        rank: The singular value of this number, from 1, counts; by default the last.
    """
    matrix, topology = scaled_jacobian(data)
    size = min(matrix.shape)
    place = size if rank is None else rank
    if not 0 < place <= size:
        return Signed(math.nan, topology, size)
    value = float(np.linalg.svd(matrix, compute_uv=False)[place - 1])
    if matrix.shape[0] == matrix.shape[1] == place:
        value = math.copysign(value, np.linalg.slogdet(matrix).sign)
    return Signed(value, topology, size)


Make = Callable[..., Model]


@dataclass(frozen=True, eq=False)
class Positions(Frozen):
    """A model, with its nodes elsewhere or other deformations held; see `sweep`."""

    data: ModelData
    positions: FloatArray | None
    held: BoolArray | None

    @property
    def count(self) -> int:
        """How many variants there are."""
        given = self.positions if self.held is None else self.held
        return 1 if given is None else len(given)

    def variant(self, a: int, b: int, share: float) -> ModelData:
        """Each position on the straight line between its two places."""
        first, held = self.one(a)
        if first is not None and self.positions is not None:
            first = first + share * (self.positions[b] - first)
        return varied(self.data, first, held)

    def one(self, k: int) -> tuple[FloatArray | None, BoolArray | None]:
        """Where the nodes of a variant are, and what it holds; None as in the model."""
        positions = None if self.positions is None else self.positions[k]
        return positions, None if self.held is None else self.held[k]

    def classes(self) -> np.ndarray:
        """(variants or 1, elements, 6) of deformations."""
        if self.held is None:
            return np.ascontiguousarray(self.data.arrays.deformation_class.T[None])
        return np.ascontiguousarray(np.swapaxes(classes_held(self.data, self.held), 1, 2))

    def goes_between(self, a: int, b: int) -> bool:
        """Unless what is held differs, or nothing moves at all."""
        alike = self.held is None or bool((self.held[a] == self.held[b]).all())
        return alike and self.positions is not None

    def taken(self, index: np.ndarray | slice) -> Positions:
        """The source of some of the rows."""
        return Positions(
            self.data,
            None if self.positions is None else self.positions[index],
            None if self.held is None else self.held[index],
        )


#: How the variants of a table came about: a model in many positions, or a function.
Source = Positions | Make


def variant_of(source: Source, a: int, b: int, share: float, row: Row) -> ModelData:
    """The model between the variants of two rows, with its parameters.

    Raises:
        Exception: whatever a function of the user raises.
    """
    return source.variant(a, b, share) if isinstance(source, Positions) else made_by(source, row)


def made_by(make: Make, row: Row) -> ModelData:
    """The data of the model that a function makes of parameters, checked.

    Raises:
        TypeError: it makes no model.
        ModelError, DeckError: the model is wrong.
        Exception: whatever the function raises.
    """
    model = make(**row)
    if not isinstance(model, Model):
        raise TypeError(f"the function must return a flexact.Model, not {type(model).__name__}")
    data = model.data
    data.require_sound()
    return data


Columns = dict[str, np.ndarray]
#: So many variants are tried until one is sound.
_MOST_TRIED = 3
#: So many variants at once: some milliseconds of work, and few numbers.
_MOST_AT_ONCE = 256
#: Variants that the core takes side by side, and parts in which all are shared out.
_SIDE_BY_SIDE, _PARTS = 8, 64
_VERDICTS = np.array([v.value for v in (Verdict.EXACT, Verdict.UNDER, Verdict.OVER, Verdict.BOTH)])
#: How texts of each column are held; errors, which are few and long, as objects.
_TEXTS = {
    "verdict": _VERDICTS.dtype,
    "certainty": np.array([c.value for c in Certainty]).dtype,
}


def swept(
    every: Positions, want: str, workers: int | None = None, progress: Progress | None = None
) -> Columns:
    """The columns of a table for variants of a model, by name, each of (variants,).

    Args:
        every: A sound model and its variants.
        want: One of `WANTS`.
        workers: So many threads at most; by default one a processor.
        progress: Called with what is being done and how much of that is done, from 0 to 1.
    """
    count = every.count
    made: Columns = {
        c.name: np.full(count, MISSING[c.kind], _TEXTS.get(c.name, c.kind))
        for c in columns_of(want)
    }
    made["error"] = np.full(count, "", object)
    threads = workers or processors()
    # The core takes so many side by side, and what a row says to the last bit depends on its
    # neighbours: so they are shared out alike, however many workers there are.
    step = min(_MOST_AT_ONCE, _SIDE_BY_SIDE * -(-max(1, count) // (_PARTS * _SIDE_BY_SIDE)))
    room = memory.allowance() / threads
    parts = [
        _Alike(alike.which[first : first + step], alike.whole, alike.by_core)
        for alike in _alike(every)
        for first in range(0, alike.which.size, step)
    ]

    def run(alike: _Alike) -> int:
        _fill(every, alike, want, room, made)
        return alike.which.size

    done = 0
    for number in _in_threads(run, parts, threads):
        done += number
        if progress is not None:
            progress("analysing variants", done / count)
    return made


class _Alike(NamedTuple):
    """Variants of which the same rows of beams count as one beam each."""

    which: np.ndarray
    whole: Condensed | None
    """What is analysed in their place; None: what they are, unless rows may count as one."""
    by_core: bool
    """Whether the core is asked; else they are analysed one by one."""


def _alike(every: Positions) -> Iterator[_Alike]:
    """All variants in groups."""
    index = np.arange(every.count)
    positions = every.positions
    if positions is None or every.held is not None:
        yield _Alike(index, None, True)
        return
    # Where only positions differ, what is held does not.
    if not _perhaps_condensed(every.taken(slice(0, 1))).all():
        yield _Alike(index, None, True)
        return
    on = ways_on(every.data, places_in(every.data, positions))
    if not on.size:
        yield _Alike(index, None, True)
        return
    patterns, pattern_of = np.unique(on, axis=0, return_inverse=True)
    for k, pattern in enumerate(patterns):
        members = index[pattern_of.ravel() == k]
        whole = None
        for i in members[:_MOST_TRIED].tolist() if (pattern >= 0).all() else ():
            data = varied(every.data, positions[i], None)
            if not data.problems.errors:
                whole = condensed(data)
                break
        yield _Alike(members, whole, whole is not None)


Item = TypeVar("Item")


def _in_threads(run: Callable[[Item], int], items: Sequence[Item], threads: int) -> Iterator[int]:
    if threads == 1 or len(items) < 2:
        yield from map(run, items)
        return
    with ThreadPoolExecutor(threads) as pool:
        yield from pool.map(run, items)


def _perhaps_condensed(some: Positions) -> BoolArray:
    """(variants or 1,) whether a row of beams may count as one beam in some geometry."""
    return perhaps_condensed(some.data.arrays, some.data.element_names, some.classes())


def _fill(every: Positions, alike: _Alike, want: str, room: float, made: Columns) -> None:
    """Put what is known of some variants into the columns; room: bytes that may be used."""
    index, whole = alike.which, alike.whole
    some = every.taken(index)
    analysed, is_so = some, np.full(index.size, alike.by_core)
    if whole is not None and some.positions is not None:
        analysed = Positions(whole.data, some.positions[:, whole.nodes], None)
        is_so = whole.holds_at(places_in(some.data, some.positions))
    elif some.held is not None:
        is_so = ~_perhaps_condensed(some)
    decided = np.zeros(index.size, np.bool_)
    if is_so.any():
        known, by_core = _decided_by_core(analysed, want != "verdict", room)
        decided = by_core & is_so
        for name, array in known.items():
            made[name][index[decided]] = array[decided]
    for i in np.flatnonzero(~decided).tolist():
        try:
            row = row_of(result_of(varied(some.data, *some.one(i)), Asked()), want)
        except (AnalysisError, DeckError, ModelError) as error:
            row = error_row(in_a_line(error), want)
        for name, value in row.items():
            made[name][index[i]] = value


def _decided_by_core(some: Positions, with_values: bool, room: float) -> tuple[Columns, BoolArray]:
    """The columns that the core gives, and (variants,) for which of them they hold."""
    own = some.data.arrays.node_value[:3].T[None]
    positions = own if some.positions is None else some.positions
    raw = calls.analyse_variants(
        *(some.data.packed, positions, some.classes(), (NEAR, CUT_OFF, REACH_OF_DIGITS)),
        *(with_values, room, some.data.has_long_numbers),
        zeros=(MOST_ZEROS, MOST_OTHERS, MOST_WORK, NO_CHANGE),
    )
    under, over = raw.columns - raw.rank, raw.rows - raw.rank
    made: Columns = {
        "verdict": _VERDICTS[(under > 0) + 2 * (over > 0)],
        "under_constrained": under,
        "over_constrained": over,
        "rank": raw.rank,
        "certainty": np.full(raw.rank.size, Certainty.CERTAIN.value),
    }
    return (made | _values(raw) if with_values else made), raw.decided


def _values(raw: RawVariants) -> Columns:
    """The columns of singular values and margins, of variants that are decided."""
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
    return {
        "gap": raw.pair_value[:, 0],
        "largest_zero": raw.largest_zero,
        "smallest_singular_value": raw.smallest,
        "condition_number": condition,
        "margin": margin,
        "margin_angle": angle,
    }


#: Entries of D(c) up to which a sign costs little beside an analysis.
_MOST_SIGNED = 40_000


class Answer(NamedTuple):
    """What is known of a variant."""

    cells: tuple[Cell, ...]
    """In the order of the columns, the error behind them."""
    signed: Signed | None = None
    """None where values were not asked for, or there are none."""
    modes: tuple[MotionArrays, StressArrays] | None = None


def failed(message: str, want: str) -> Answer:
    """A variant of which there is only an error."""
    return Answer(tuple(error_row(message, want).values()))


def answer_of(source: ModelData | Make, want: str, asked: Asked, item: Any) -> Answer:
    """What is known of the variant that a function makes of parameters, or of one of a model.

    Args:
        source: The function, or the model.
        want: One of `WANTS`.
        asked: How it is to be analysed.
        item: The parameters, or where the nodes are and what is held.
    """
    try:
        data = varied(source, *item) if isinstance(source, ModelData) else made_by(source, item)
        result: Result = result_of(data, asked)
        modes = modes_of(result) if want == "all" else None
        signed = None
        is_small = result.rows * result.columns <= _MOST_SIGNED
        if is_small and want != "verdict" and not isinstance(source, ModelData):
            with suppress(AnalysisError, MemoryError, np.linalg.LinAlgError):
                signed = signed_value(data)
        return Answer(tuple(row_of(result, want).values()), signed, modes)
    except Exception as error:
        return failed(in_a_line(error), want)
