# SPDX-License-Identifier: BSD-3-Clause
"""With `elastic` the only importer of the extension: what goes in is checked, what comes out named.

Every call is a function of its arguments.
"""

from __future__ import annotations

import math
import sys
from functools import cache
from typing import NamedTuple

import numpy as np

from ..util.machine import address_space
from ..util.records import read_only
from . import _core
from .arrays import (
    AnyArray,
    Basis,
    ByteArray,
    FloatArray,
    IntArray,
    PackedModel,
    room_for,
    unpacked,
)
from .raw import (
    ElementKind,
    Meaning,
    RawAnalysis,
    RawAssembly,
    RawCount,
    RawDeck,
    RawDiagnostics,
    RawEchelon,
    RawFrames,
    RawVariants,
)

#: Entries of the bases of motions and self-stresses beyond which vectors are left out.
_MOST_ENTRIES = 40_000_000
#: The part of the memory that the bases may take.
_PART_OF_VECTORS = 0.25
#: Stored entries of the whole Jacobian that one element has at most.
_ENTRIES_OF_ELEMENT = 6 * 12


#: Bytes that the core takes, at most, for a model's copy and for each call: for each node and
#: element, and more for each element where the Jacobian is made.
_OF_MODEL, _OF_JACOBIAN = 1_000, 4_000
#: While a deck is read: for each byte and line; for each element and end of an element, which may
#: be a node, without and with stiffness, mass, loads and pictures.
_OF_BYTE, _OF_LINE = 3, 110
_OF_ELEMENT, _OF_END = (110, 210), (120, 200)
#: How statements of these begin: EM, ESTIFF, XM, MASS, XF, FORCE, DELXF, GRAVITY, VISUALIZATION;
#: FILLET, EXPANSION and STRENGTH alone are rare.
_VALUES = [256 * a + b for a, b in (b"EM", b"ES", b"XM", b"MA", b"XF", b"FO", b"DE", b"GR", b"VI")]
#: What a deck says of elements and nodes, in the order of its arrays.
_SAID = (
    *("cross_section", "drawn", "dimensions", "colour", "edge_colour", "opacity"),
    *("stiffness", "mass", "strength", "expansion", "fillet"),
    *("node_mass", "force", "increment"),
)
#: Lines that begin with more blanks count as elements.
_INDENT = 4

_NO_VECTORS = read_only(np.zeros(1, np.int32))


def names_of(enumeration: str) -> dict[str, int]:
    """The values of an enumeration of the core by name, in ascending order.

    Args:
        enumeration: Such as "roles" or "methods"; see flexact_names.f90.

    Raises:
        LookupError: the core has no such enumeration.
    """
    first, words = _words_of(enumeration)
    return {word: first + i for i, word in enumerate(words)}


def linked() -> dict[str, str]:
    """The libraries that the core is linked with, and their licences."""
    return dict(zip(_words_of("linked")[1], _words_of("licences")[1], strict=True))


def _words_of(enumeration: str) -> tuple[int, list[str]]:
    """The value of the first word, and the words."""
    names, first, count = _core.describe_names(np.frombuffer(enumeration.encode(), np.int8))
    if not count:
        raise LookupError(f"the core has no enumeration {enumeration!r}")
    return first, [names[:, i].tobytes().decode("ascii").strip() for i in range(count)]


#: Ways to decompose D(c).
METHODS = tuple(names_of("methods"))
#: What the core is at while it analyses, by number.
STAGES = tuple(names_of("stages"))
#: How the core can fail, by number.
ERRORS = tuple(names_of("errors"))
_FACTS = tuple(names_of("facts"))
_VARIANT_FACTS = tuple(names_of("variant facts"))
#: Values with what changes them, at most, of each variant.
MOST_PAIRS = 6
_PROOFS = dict(zip((None, True, False), names_of("proofs").values(), strict=True))


@cache
def element_kinds() -> tuple[ElementKind, ...]:
    """All kinds of elements, in the order of their numbers 1, 2, ..."""
    rows: list[ElementKind] = []
    count = 1
    while len(rows) < count:
        words, numbers, count = _core.describe_element(len(rows) + 1)
        keyword, synonym, says, *numbered = (
            words[:, i].tobytes().decode("ascii").strip() for i in range(words.shape[1])
        )
        n = tuple(numbers.tolist())
        rows.append(
            ElementKind(
                *(len(rows) + 1, keyword, synonym, n[:4], n[4], n[5]),
                *(n[6] == 1, n[7], n[8:14], n[14:], says, *map(_meanings, numbered)),
            )
        )
    return tuple(rows)


def _meanings(listed: str) -> tuple[Meaning, ...]:
    """Such as "EA (N), G It (N m^2)", one by one."""
    return tuple(
        Meaning(name, unit.removesuffix(")"))
        for name, _, unit in (each.rpartition(" (") for each in listed.split(", ") if each)
    )


def _require_room(needed: float, left: float | None = None) -> None:
    """Raise where a limit of the address space does not leave so many bytes to the core.

    It would end the process. Where there is no limit, the system lends more than it has.
    """
    left = address_space() if left is None else left
    if needed > left:
        raise MemoryError(
            f"about {needed / 1e6:.3g} MB of memory are needed, but the limits of the process "
            f"leave {left / 1e6:.3g} MB"
        )


def require_room_for(model: PackedModel, of_element: int = _OF_MODEL) -> None:
    """Raise where a limit leaves no room for a model's copy and so many bytes an element.

    Raises:
        MemoryError: there is none.
    """
    _require_room(_OF_MODEL * model.nodes.shape[1] + of_element * model.elements.shape[1])


def read_deck(text: bytes) -> RawDeck:
    """Read a deck; its problems come back as values.

    Args:
        text: bytes of the deck, fewer than 2**31.
    """
    data = np.frombuffer(text, np.int8)
    room, reading = _most_in(data)
    left = address_space()
    _require_room(reading, left)
    most, of_node = room, _OF_END[room.is_valued]
    if reading + room.bytes > left:
        # Then it is read to know the room that it takes, and once more into that.
        room = _Room(1, 1, False)
    made = room.made()
    found = _core.read_deck(data, *made)
    nodes, elements, planar, long, drawn, given, loaded, power = found[:8]
    needed = _Room(nodes, elements, (drawn or given or loaded) == 1)
    if any(np.greater(needed, room)):
        # What the first reading took serves the second, whether the system has it back or not.
        _require_room(reading - of_node * (most.nodes - nodes) + needed.bytes, left)
        made = needed.made()
        found = _core.read_deck(data, *made)
    element_name, node_name, *said = made[4:]
    # What was read lies in larger arrays.
    many = (elements,) * 11 + (nodes,) * 3
    views = [each[..., :count].T for each, count in zip(said, many, strict=True)]
    views[1] = views[1] == 1

    def of(first: int, last: int) -> dict[str, AnyArray]:
        return {name: views[k].copy() for k, name in enumerate(_SAID[first:last], first)}

    return RawDeck(
        unpacked(PackedModel(*made[:4]), nodes, elements),
        element_name[:, :elements],
        node_name[:, :nodes],
        planar == 1,
        found[9:],
        of(0, 6) if drawn else {},
        of(6, 12) if given else {},
        of(12, 14) | {"gravity": found[8].copy()} if loaded else {},
        long == 1,
        power,
    )


def find_tokens(text: bytes) -> tuple[IntArray, IntArray]:
    """The lines of a deck and their words, as they are read; a deck need not be sound for this.

    Args:
        text: bytes of the deck, fewer than 2**31.

    Returns:
        (7, lines) first byte, the byte behind the last, where the comment starts (behind the line
        without one), words up to its end, block, kind of the element that it makes or 0, row of
        the keyword table from 1, 0 without one and -1 where it ends a block; and (5, words) first
        byte, the byte behind the last, letter, kind that the node of an element must be (-1:
        warping), whole number from 1 that it is, or 0. Places are bytes from 0.
    """
    data = np.frombuffer(text, np.int8)
    blank = (data >= 0) & (data <= ord(" "))
    # Each word stands at the start or behind a blank; those of comments are not given.
    most = 1 + int(np.count_nonzero(blank[:-1] & ~blank[1:]))
    lines = np.empty((7, text.count(b"\n") + 1), np.int32, order="F")
    words = np.empty((5, most), np.int32, order="F")
    _core.find_tokens(data, lines, words)
    used = int(lines[3, -1])
    return lines, words[:, :used] if 2 * used > most else words[:, :used].copy("F")


class _Room(NamedTuple):
    """Columns of what the core puts a deck into."""

    nodes: int
    elements: int
    is_valued: bool
    """Whether there is room for stiffness, mass, loads and pictures."""

    @property
    def bytes(self) -> int:
        """What it takes."""
        return (60 + 96 * self.is_valued) * self.nodes + (80 + 200 * self.is_valued) * self.elements

    def made(self) -> tuple[AnyArray, ...]:
        """The arrays, as the core takes them; it wants none without a column."""
        nodes, elements = max(1, self.nodes), max(1, self.elements)
        of_node, of_element = (n if self.is_valued else 1 for n in (nodes, elements))
        names = (np.empty((2, n), np.int32, order="F") for n in (elements, nodes))
        drawn = (np.empty(of_element, np.int32) for _ in range(2))
        look = (np.empty((n, of_element), order="F") for n in (2, 3, 3))
        made = (np.empty((n, of_element), order="F") for n in (6, 5, 2, 1, 1))
        loaded = (np.empty((n, of_node), order="F") for n in (6, 3, 3))
        opacity = np.empty(of_element)
        return *room_for(nodes, elements), *names, *drawn, *look, opacity, *made, *loaded


def _most_in(text: ByteArray) -> tuple[_Room, int]:
    """The room that a deck may take, and bytes that reading it takes besides.

    Elements are told by the first letters of their lines: those with two nodes, TRUSS, HINGE,
    and PLTRUSS, PLHINGE, PLTOR; and others, which have up to four.
    """
    first = np.concatenate(([0], np.flatnonzero(text == ord("\n")) + 1))
    for _ in range(_INDENT):
        first += text.take(first, mode="clip") <= ord(" ")
    one, two, three = (text.take(first + k, mode="clip") & 0x5F for k in range(3))
    is_planar = (one == ord("P")) & (two == ord("L"))
    of_two = np.isin(np.where(is_planar, three, one), (ord("T"), ord("H")))
    of_four = np.isin(one, (ord("B"), ord("P"))) | (one == ord("R")) & (two == ord("B"))
    of_four |= text.take(first, mode="clip") <= ord(" ")
    of_four &= ~of_two
    valued = bool(np.isin(256 * one.astype(np.int32) + two, _VALUES).any())
    elements = int(np.count_nonzero(of_two | of_four))
    ends = int(2 * np.count_nonzero(of_two) + 4 * np.count_nonzero(of_four))
    reading = _OF_BYTE * text.size + _OF_LINE * first.size
    reading += _OF_ELEMENT[valued] * elements + _OF_END[valued] * ends
    return _Room(ends, elements, valued), reading


def check_model(model: PackedModel, text: bytes, name: IntArray) -> RawDiagnostics:
    """Everything that is wrong with a model, as for a deck but without places.

    Args:
        model: the model.
        text: where the names stand.
        name: (2, ne + nn) first and last place, from 1, of the name of each element, then of
            each node; 0 where there is none.

    Raises:
        ValueError: a name stands outside the text.
    """
    if name.size and not 0 <= name.min() <= name.max() <= len(text):
        raise ValueError("a name stands outside the text")
    require_room_for(model)
    return _core.check_model(
        np.frombuffer(text, np.int8), *model, np.asfortranarray(name, np.int32)
    )


def count_model(model: PackedModel) -> RawCount:
    """Counts by class (eqs. 13 to 15) and the size of D(c)."""
    if not model.elements.size:
        # f2py refuses arrays of shape (5, 0); without elements there are no nodes either.
        return RawCount(np.zeros((2, 4), np.int32), 0, 0)
    counts, sizes = _core.count_model(model.nodes, model.elements)
    return RawCount(counts.T, *sizes.tolist())


def find_frames(model: PackedModel) -> RawFrames:
    """Reference frames and lengths of a sound model's elements."""
    require_room_for(model)
    frame, length = _core.find_frames(*model)
    return RawFrames(np.moveaxis(frame, 2, 0), length)


def assemble(model: PackedModel, configuration: FloatArray, c_t: FloatArray) -> RawAssembly:
    """Deformation functions and their derivatives in a configuration.

    Args:
        model: the model.
        configuration: (4, nn) like `node_value`.
        c_t: (ne,) torsion-elongation constants of eq. (3) [m^2].

    Raises:
        ValueError: a shape does not fit.
    """
    nodes, elements = model.nodes.shape[1], model.elements.shape[1]
    if configuration.shape != (4, nodes):
        raise ValueError(f"configuration has shape {configuration.shape}, not {(4, nodes)}")
    if c_t.shape != (elements,):
        raise ValueError(f"c_t has shape {c_t.shape}, not {(elements,)}")
    place = np.empty((2, _ENTRIES_OF_ELEMENT * elements), np.int32, order="F")
    value = np.empty(place.shape[1])
    require_room_for(model, _OF_JACOBIAN)
    deformation, used = _core.assemble(
        *model,
        np.asfortranarray(configuration, np.float64),
        np.ascontiguousarray(c_t, np.float64),
        place,
        value,
    )
    return RawAssembly(
        deformation, place[0, :used].copy(), place[1, :used].copy(), value[:used].copy()
    )


def analyse_model(
    model: PackedModel,
    method: str = "auto",
    tolerance: float | None = None,
    stage: IntArray | None = None,
    memory: float = math.inf,
    only_plain_values: bool = False,
    prove: bool | None = None,
    as_stored: bool = False,
) -> RawAnalysis:
    """Decompose D(c).

    Args:
        model: the model.
        method: one of `METHODS`.
        tolerance: scaled singular values up to here count as zero; None: from the data.
        stage: (3,) kept up to date while the call runs: stage (an index of `STAGES`), per cent;
            and what the caller sets to 1 to have the call end soon, by an error.
        memory: bytes that may be used.
        only_plain_values: whether, in place of all else, the singular values of D(c) itself
            are wanted (by the method sparse the smallest), as `scaled_values`.
        prove: whether the rank is to be proven in exact arithmetic; None: where it costs little.
        as_stored: whether numbers are no decimals as typed, whatever they look like.
    """
    _, m, n = count_model(model)
    # Memory is taken only where it is written to.
    size = max(1, m + n)
    label = np.empty((2, size), np.int32, order="F")
    first = np.empty(size + 1, np.int32)
    scale, scaled_value = np.empty(size), np.empty(size)
    pair_vector = np.empty((size, MOST_PAIRS), order="F")
    # Where the address space is limited, what is set aside counts as used.
    most = min((m + n) ** 2, _MOST_ENTRIES, _PART_OF_VECTORS * memory / 12.0)
    room = max(1, int(most))
    place, value = np.empty(room, np.int32), np.empty(room)
    require_room_for(model)
    facts, pair_value = _core.analyse_model(
        *model,
        METHODS.index(method),
        -1.0 if tolerance is None else tolerance,
        min(memory, sys.float_info.max),
        only_plain_values,
        _PROOFS[prove],
        as_stored,
        np.zeros(3, np.int32) if stage is None else stage,
        label,
        first,
        place,
        value,
        scale,
        scaled_value,
        pair_vector,
    )
    named = dict(zip(_FACTS, facts.tolist(), strict=True))
    pairs, motions, stresses = (int(named[what]) for what in ("pairs", "motions", "self-stresses"))
    start = first[: motions + stresses + 1]
    # Of the vectors far more is set aside than they take; given back where they stand.
    used = int(start[-1]) if start.size > 1 else 0
    place.resize(used, refcheck=False)
    value.resize(used, refcheck=False)
    # Views of what cannot be written to cannot be written to either.
    for array in (label, place, value, scale, scaled_value, pair_vector, pair_value):
        array.setflags(write=False)
    return RawAnalysis(
        counts=np.array(facts[4:12], np.int32).reshape(2, 4),
        row_label=label[:, :m],
        column_label=label[:, m : m + n],
        scaled_values=scaled_value[: int(named["scaled values"])],
        row_scale=scale[:m],
        column_scale=scale[m : m + n],
        pair_value=pair_value[:pairs],
        pair_motion=pair_vector[m : m + n, :pairs],
        pair_stress=pair_vector[:m, :pairs],
        tolerance=named["tolerance"],
        characteristic_length=named["characteristic length"],
        noise=named["noise"],
        bytes_needed=named["bytes needed"],
        reach_of_digits=named["reach of digits"],
        rank=int(named["rank"]),
        method=METHODS[int(named["method"])],
        confirmed=named["confirmed"] == 1,
        bound=named["bound"],
        components=int(named["components"]),
        largest_component=(int(named["rows of largest"]), int(named["columns of largest"])),
        error=ERRORS[int(named["error"])],
        proven_rank=int(named["proven rank"]),
        as_typed=named["as typed"] == 1,
        primes=int(named["primes"]),
        failure=named["failure"],
        undecided=int(named["undecided"]),
        unjudged=named["unjudged"] == 1,
        fading=int(named["fading"]),
        unseen=int(named["unseen"]),
        left=named["left"],
        explained=named["explained"],
        motions=_basis_of(n, start[: motions + 1], place, value, m),
        stresses=_basis_of(m, start[motions:], place, value, 0),
    )


def find_echelon(
    model: PackedModel, size: int, number: int, as_stored: bool, is_transposed: bool
) -> RawEchelon:
    """The reduced echelon form of D(c) modulo a prime; each row of D(c) up to a positive factor.

    Args:
        model: the model.
        size: columns of D(c), or rows if the transpose is wanted; at least one.
        number: of the prime; each gives another one.
        as_stored: whether numbers are no decimals as typed, whatever they look like.
        is_transposed: whether that of the transpose is wanted.
    """
    # Entries beside the pivots: rank times (size - rank).
    entry = np.empty((4, size * size // 4 + 1), np.int32, order="F")
    pivot = np.empty(size, np.int32)
    require_room_for(model, _OF_JACOBIAN)
    prime, as_typed, used = _core.find_echelon(
        *model, number, as_stored, is_transposed, pivot, entry
    )
    high, low = prime.tolist()
    columns, pivots, upper, lower = entry[:, :used].tolist()
    residues = ((a << 31) + b for a, b in zip(upper, lower, strict=True))
    return RawEchelon(
        (high << 31) + low,
        as_typed == 1,
        tuple(np.flatnonzero(pivot).tolist()),
        dict(zip(zip(columns, pivots, strict=True), residues, strict=True)),
    )


def _basis_of(size: int, start: IntArray, place: IntArray, value: FloatArray, before: int) -> Basis:
    """Some of the vectors that stand in a row, whose places lie behind `before` others."""
    first, last = int(start[0]), int(start[-1])
    if first == last:
        return Basis(size, _NO_VECTORS, place[:0], value[:0])
    return Basis(
        size,
        read_only(start - first),
        read_only(place[first:last] - before),
        read_only(value[first:last]),
    )


def find_sensitivities(
    model: PackedModel, stresses: FloatArray, motions: FloatArray, pairs: IntArray
) -> tuple[FloatArray, IntArray]:
    """What small changes of the geometry make of singular values of D(c), to first order.

    Args:
        model: the model.
        stresses: (m, a) left vectors, in the sense of D(c) without its scales.
        motions: (n, b) right vectors, likewise.
        pairs: (2, p) the columns of both that belong together, from 0.

    Returns:
        (5, p) what rounding in the last bits can make of the value of each pair, half a unit of
        the last digits typed, and storing it or printing it with ten digits or a few more; its
        largest change by the move of one node [1/m] and by the turn of one element [1/rad]. And
        (2, p) indices of that node and that element, -1 without one.

    Raises:
        ValueError: a shape is not that of the model, or a pair names no column.
    """
    rows, columns = stresses.shape[0], motions.shape[0]
    many = (stresses.shape[1], motions.shape[1])
    modes = np.zeros((rows + columns, max(*many, 1)), order="F")
    modes[:rows, : many[0]], modes[rows:, : many[1]] = stresses, motions
    _require_room(_OF_MODEL * (rows + columns) + 4 * modes.nbytes)
    effect, place, used = _core.find_sensitivities(
        *model, modes, np.asfortranarray(pairs + 1, np.int32)
    )
    beyond = (pairs < 0).any() or (pairs >= np.array(many)[:, None]).any()
    if used != rows + columns or beyond:
        raise ValueError("the vectors are not of the model's size, or a pair names none of them")
    return effect, place - 1


def analyse_variants(
    model: PackedModel,
    positions: FloatArray,
    classes: IntArray,
    limits: tuple[float, float, float],
    with_values: bool,
    memory: float,
    as_stored: bool,
    zeros: tuple[int, int, float, float],
) -> RawVariants:
    """Analyse some variants of a model, the interpreter lock dropped.

    Args:
        model: the model.
        positions: (variants, nodes, 3), or (1, nodes, 3) for all.
        classes: (variants, elements, 6), or (1, elements, 6) for all.
        limits: values up to this multiple of the noise are looked at closely; those up to this
            multiple of what half a unit of the last digits makes are in doubt; and no more than
            that can missing digits make.
        with_values: whether values and what changes them are wanted beside the rank.
        memory: bytes that may be used.
        as_stored: whether numbers are no decimals as typed, whatever they look like.
        zeros: how many are looked at, each against how many vectors of the other side, how many
            pairs times nodes and elements there may be, and what change of a zero is none.

    Raises:
        ValueError: a shape does not fit.
    """
    many = max(len(positions), len(classes))
    nodes, elements = model.nodes.shape[1], model.elements.shape[1]
    if positions.shape[1:] != (nodes, 3) or len(positions) not in (1, many):
        raise ValueError(f"positions have the shape {positions.shape}")
    if classes.shape[1:] != (elements, 6) or len(classes) not in (1, many):
        raise ValueError(f"classes have the shape {classes.shape}")
    require_room_for(model)
    facts, *pairs = _core.analyse_variants(
        many,
        *model,
        *limits,
        with_values,
        min(memory, sys.float_info.max),
        _PROOFS[None],
        as_stored,
        np.array(zeros[:2], np.int32),
        np.array(zeros[2:]),
        np.ascontiguousarray(positions, float).T,
        np.ascontiguousarray(classes, np.int32).T,
    )
    named = dict(zip(_VARIANT_FACTS, facts, strict=True))
    # What is not known is negative.
    known = {name: np.where(fact >= 0.0, fact, math.nan) for name, fact in named.items()}
    is_there = np.arange(MOST_PAIRS) < named["pairs"][:, None]
    return RawVariants(
        named["decided"] == 1,
        named["rows"].astype(np.int32),
        named["columns"].astype(np.int32),
        named["rank"].astype(np.int32),
        known["largest zero"],
        named["zero moves"] == 1,
        named["zero turns"] == 1,
        known["smallest"],
        known["largest"],
        named["characteristic length"],
        *(np.where(is_there, of_pair.T, math.nan) for of_pair in pairs),
    )
