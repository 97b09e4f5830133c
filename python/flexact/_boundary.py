"""The only importer of the extension: what goes in is checked, what comes out is named.

Every call is a function of its arguments. Arrays of a model are in Fortran order,
`int32` and `float64`.
"""

from __future__ import annotations

import math
import sys

import numpy as np

from . import _core
from .exchange import (
    Basis,
    FloatArray,
    IntArray,
    ModelArrays,
    RawAnalysis,
    RawAssembly,
    RawCount,
    RawDeck,
    RawDiagnostics,
    RawLook,
    RawSensitivities,
    first_of,
    room_for,
)

#: Ways to decompose D(c); the core knows them by their place.
METHODS = ("auto", "svd", "jacobi", "qr", "sparse")
#: What the core is at while it analyses, by number.
STAGES = ("assembling", "ordering", "factorising", "motions", "self-stresses", "singular values")

#: So many of the smallest non-zero singular values come with their vectors.
_MOST_PAIRS = 6

#: Entries of a basis beyond which vectors are left out.
_MOST_ENTRIES = 20_000_000

#: Bytes of the shortest statement of an element, with its line's end.
_SHORTEST_ELEMENT = len("BEAM 1 1 2")


def describe_element_kinds() -> list[tuple[str, tuple[int, ...], int, int, bool, tuple[int, ...]]]:
    """Rows of the core's element table: keyword, slots, deformations, vector, length, dual."""
    table = []
    for kind in range(1, _core.count_element_kinds() + 1):
        keyword, slots, deformations, vector, needs_length, dual = _core.describe_element_kind(kind)
        table.append(
            (
                keyword.tobytes().decode("ascii").strip(),
                tuple(slots.tolist()),
                int(deformations),
                int(vector),
                bool(needs_length),
                tuple(dual.tolist()),
            )
        )
    return table


def read_deck(text: bytes) -> RawDeck:
    """Read a deck; its problems come back as values.

    Args:
        text: bytes of the deck, fewer than 2**31.
    """
    data = np.frombuffer(text, np.int8)
    ne, nn = _core.survey_deck(data)
    ne = min(ne, len(text) // _SHORTEST_ELEMENT + 1)
    nn = min(nn, 4 * ne)
    room = room_for(nn, ne)
    origin = np.empty(ne, np.int32)
    name = np.empty((2, ne), np.int32, order="F")
    choice = np.empty((2, ne), np.int32, order="F")
    value = np.empty((9, ne), np.float64, order="F")
    found = _core.read_deck(data, *room, origin, name, choice, value)
    nodes, elements, planar, _, drawn = found[0][:5].tolist()
    problems = RawDiagnostics(*found[1:])
    arrays = first_of(room, nodes, elements)
    look = RawLook(choice[:, :elements], value[:, :elements]) if drawn else None
    return RawDeck(arrays, name[:, :elements], planar == 1, problems, look)


def check_model(arrays: ModelArrays) -> RawDiagnostics:
    """Everything that is wrong with a model, as for a deck but without places."""
    return RawDiagnostics(*_core.check_model(*arrays))


def count_model(arrays: ModelArrays) -> RawCount:
    """Counts by class (eqs. 13 to 15) and the size of D(c)."""
    if not arrays.element_number.size:
        # f2py refuses arrays of shape (3, 0); without elements there are no nodes either.
        return RawCount(np.zeros((2, 4), np.int32), 0, 0, 0)
    return RawCount(
        *_core.count_model(
            arrays.node_kind,
            arrays.coordinate_class,
            arrays.element_kind,
            arrays.deformation_class,
        )
    )


def assemble(
    arrays: ModelArrays, entries: int, configuration: FloatArray, c_t: FloatArray
) -> RawAssembly:
    """Deformation functions and their derivatives in a configuration.

    Args:
        arrays: the model.
        entries: room for the entries, from `count_model`.
        configuration: (4, nn) like `node_value`.
        c_t: (ne,) torsion-elongation constants of eq. (3) [m^2].

    Raises:
        ValueError: a shape does not fit.
        ArithmeticError: the functions are not defined there (a beam of no length).
    """
    nodes, elements = arrays.node_number.size, arrays.element_number.size
    if configuration.shape != (4, nodes):
        raise ValueError(f"configuration has shape {configuration.shape}, not {(4, nodes)}")
    if c_t.shape != (elements,):
        raise ValueError(f"c_t has shape {c_t.shape}, not {(elements,)}")
    deformation, row_of, column_of, value, used, status = _core.assemble(
        entries,
        *arrays,
        np.asfortranarray(configuration, np.float64),
        np.ascontiguousarray(c_t, np.float64),
    )
    if status != 0:
        raise ArithmeticError("the deformations are not defined in this configuration")
    return RawAssembly(deformation, row_of[:used], column_of[:used], value[:used])


def analyse_model(
    arrays: ModelArrays,
    rows: int,
    columns: int,
    method: str = "auto",
    tolerance: float | None = None,
    stage: IntArray | None = None,
    memory: float = math.inf,
    only_plain_values: bool = False,
) -> RawAnalysis:
    """Decompose D(c) of `rows` x `columns`, as counted by `count_model`.

    Args:
        arrays: the model.
        rows: of D(c).
        columns: of D(c).
        method: one of `METHODS`.
        tolerance: scaled singular values up to here count as zero; None: from the data.
        stage: (2,) kept up to date while the call runs: stage (an index of `STAGES`), per cent.
        memory: bytes that may be used.
        only_plain_values: whether, in place of all else, the smallest singular values of
            D(c) itself are wanted, as `scaled_values`; for the method sparse.
    """
    motions, stresses = _room_for_basis(columns), _room_for_basis(rows)
    least = min(rows, columns)
    found = _core.analyse_model(
        least,
        min(least, _MOST_PAIRS),
        METHODS.index(method),
        np.array(
            [
                -1.0 if tolerance is None else tolerance,
                min(memory, sys.float_info.max),
                float(only_plain_values),
            ]
        ),
        *arrays,
        np.zeros(2, np.int32) if stage is None else stage,
        *motions,
        *stresses,
    )
    row_label, column_label, length, plain, scaled, row_scale, column_scale = found[:7]
    value, motion, stress, numbers, facts, status = found[7:]
    rank, used, confirmed, plains, scaleds, pairs, moving, stressed, parts = facts[:9].tolist()
    plain, scaled = np.abs(plain[:plains]), np.abs(scaled[:scaleds])  # LAPACK has zeros of -0
    return RawAnalysis(
        row_label,
        column_label,
        length,
        singular_values=plain,
        scaled_values=scaled,
        row_scale=row_scale,
        column_scale=column_scale,
        pair_value=value[:pairs],
        pair_motion=motion[:, :pairs],
        pair_stress=stress[:, :pairs],
        tolerance=float(numbers[0]),
        characteristic_length=float(numbers[1]),
        noise=float(numbers[2]),
        bytes_needed=float(numbers[3]),
        reach_of_digits=float(numbers[4]),
        rank=rank,
        method=METHODS[used],
        confirmed=confirmed == 1,
        parts=parts,
        largest_part=(int(facts[9]), int(facts[10])),
        status=status,
        motions=_basis_of(columns, motions, moving),
        stresses=_basis_of(rows, stresses, stressed),
    )


def _room_for_basis(size: int) -> tuple[IntArray, IntArray, FloatArray]:
    """Start, place and value of vectors; memory is taken only where it is written to."""
    entries = max(1, min(size * size, _MOST_ENTRIES))  # f2py refuses arrays of no length here
    return np.zeros(size + 1, np.int32), np.empty(entries, np.int32), np.empty(entries)


def _basis_of(size: int, room: tuple[IntArray, IntArray, FloatArray], vectors: int) -> Basis:
    start, place, value = room
    entries = int(start[vectors])
    return Basis(size, start[: vectors + 1].copy(), place[:entries].copy(), value[:entries].copy())


def find_sensitivities(
    arrays: ModelArrays, stresses: FloatArray, motions: FloatArray, pairs: IntArray
) -> RawSensitivities:
    """What small changes of the geometry make of singular values of D(c), to first order.

    Args:
        arrays: the model.
        stresses: (m, a) left vectors, in the sense of D(c) without its scales.
        motions: (n, b) right vectors, likewise.
        pairs: (2, p) the columns of both that belong together, from 0.

    Raises:
        ValueError: a shape is not that of the model, or a pair names no column.
    """
    numbers, place, status = _core.find_sensitivities(
        *arrays,
        np.asfortranarray(stresses, np.float64),
        np.asfortranarray(motions, np.float64),
        np.asfortranarray(pairs + 1, np.int32),
    )
    if status != 0:
        raise ValueError("the vectors are not of the model's size, or a pair names none of them")
    return RawSensitivities(*numbers, *(place - 1))
