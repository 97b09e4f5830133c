# SPDX-License-Identifier: BSD-3-Clause
"""What the core gives back, under names."""

from __future__ import annotations

from typing import NamedTuple

from .arrays import AnyArray, Basis, BoolArray, ByteArray, FloatArray, IntArray, ModelArrays


class Meaning(NamedTuple):
    """What a number of a statement stands for."""

    name: str
    unit: str = ""

    def __str__(self) -> str:
        """Such as "EA (N)"."""
        return f"{self.name} ({self.unit})" if self.unit else self.name


class ElementKind(NamedTuple):
    """One row of the element table."""

    number: int
    """From 1."""
    keyword: str
    synonym: str
    """Another spelling in decks, empty without one."""
    slots: tuple[int, ...]
    """Node kind of the slots p, op, q, oq; 0 where a slot is not used."""
    frame: int
    vector: int
    needs_length: bool
    """Whether p and q must be apart."""
    member: int
    role: tuple[int, ...]
    """Role of each of six deformations, 0 beyond the last."""
    dual: tuple[int, ...]
    """Dual of each."""
    says: str
    """What it is, in Markdown."""
    stiffness: tuple[Meaning, ...]
    """The numbers of ESTIFF; none where they mean nothing."""
    mass: tuple[Meaning, ...]
    """The numbers of EM, likewise."""

    @property
    def deformations(self) -> int:
        """How many deformations such an element has."""
        return sum(role != 0 for role in self.role)


#: Problems as the core reports them, of which at most 100 are kept: (4,) how many errors, warnings,
#: notes and kept ones; (8, 100) severity, line, columns, other line and columns, in bytes; and
#: (240, 4, 100) code, message, label and help, blank padded.
RawDiagnostics = tuple[IntArray, IntArray, ByteArray]


class RawDeck(NamedTuple):
    """What reading a deck gives."""

    arrays: ModelArrays
    name: IntArray
    """(2, ne) first and last place of each element's name, 0 without one."""
    node_name: IntArray
    """(2, nn) likewise of each node's, the comment of its X statement."""
    planar: bool
    problems: RawDiagnostics
    appearance: dict[str, AnyArray]
    """The fields of an `Appearance`; none where the deck has nothing of it."""
    properties: dict[str, FloatArray]
    """Those of `Properties`, likewise."""
    loads: dict[str, FloatArray]
    """Those of `Loads`, likewise."""
    has_long_numbers: bool
    """Whether its geometry was typed with more digits than its numbers hold."""
    length_power: int
    """Power of ten of the unit of its lengths in metres; its numbers are in SI."""


class RawCount(NamedTuple):
    """Sizes that follow from the classes alone."""

    counts: IntArray
    """(2, 4) coordinates and deformations: total, fixed, dependent, independent."""
    rows: int
    columns: int


class RawAssembly(NamedTuple):
    """Deformations and the whole Jacobian in one configuration."""

    deformation: FloatArray
    """(6, ne) values of the deformation functions, eqs. (2) to (4)."""
    row_of: IntArray
    column_of: IntArray
    value: FloatArray
    """Entries at row = element * 6 + deformation, column = node * 3 + axis."""


class RawFrames(NamedTuple):
    """The elements in the reference configuration."""

    frame: FloatArray
    """(ne, 3, 3) local axes ex, ey, ez as columns."""
    length: FloatArray
    """(ne,) lengths l0 [m]."""


class RawAnalysis(NamedTuple):
    """Results of the decomposition of D(c), m rows, n columns."""

    counts: IntArray
    """(2, 4) coordinates and deformations: total, fixed, dependent, independent."""
    row_label: IntArray
    """(2, m) one-based element index and deformation."""
    column_label: IntArray
    """(2, n) one-based node index and axis."""
    scaled_values: FloatArray
    """(kept,) of the scaled matrix on which the rank is decided, descending; kept = min(m, n),
    or less: the smallest ones."""
    row_scale: FloatArray
    """(m,) factor of each row of D(c) in the scaled matrix."""
    column_scale: FloatArray
    """(n,) factor of each column."""
    pair_value: FloatArray
    """(p,) smallest non-zero values of the scaled matrix, ascending, p at most 6."""
    pair_motion: FloatArray
    """(n, p) their right singular vectors, of unit norm in the scaled matrix."""
    pair_stress: FloatArray
    """(m, p) their left singular vectors, likewise."""
    tolerance: float
    """Scaled singular values up to here count as zero."""
    characteristic_length: float
    noise: float
    """What computing, and rounding in the last bits, may make of a zero in `scaled_values`."""
    rank: int
    method: str
    """What was used: svd, jacobi or sparse."""
    confirmed: bool
    """Whether the rank follows from a decomposition with error bounds, or from two routes."""
    bound: float
    """Below this no more scaled values lie than were pinned: by sparse what the factorisation
    shows of each component, the least of them; else the noise."""
    components: int
    """Connected components of D(c), which are decomposed one by one."""
    largest_component: tuple[int, int]
    """Rows and columns of the largest of them."""
    error: str
    """One of `flexact.core.calls.ERRORS`; unless it is "none", only sizes are to be used."""
    bytes_needed: float
    """What the decomposition needs of memory, where the core knows."""
    reach_of_digits: float
    """No more than that, in the scaled matrix, can digits explain that were not typed."""
    proven_rank: int
    """In exact arithmetic; -1 where it is not known."""
    as_typed: bool
    """Whether that is of the decimals as typed, or of the doubles as stored."""
    primes: int
    """Modulo so many primes; -1 where that was too much."""
    failure: float
    """The probability that it is too low is at most this."""
    undecided: int
    """So many values that count as zero may not be, by exact arithmetic or more digits."""
    fading: int
    """So many of those undecided are only because their vectors fade; theory.md (23)."""
    unseen: int
    """So many values do not count as zero by exact arithmetic alone: they are below 1e-31."""
    left: float
    """The largest of those undecided; 0 where that is not known."""
    explained: float
    """What storing the geometry can make of it."""
    unjudged: bool
    """Whether there are zeros that nothing but the decomposition has seen."""
    motions: Basis
    """n - rank vectors, an orthonormal basis of the null space of D(c); see `analysis`.

    Where there are very many, vectors of different parts are orthogonal, but those of one
    part need not be; and where even so their entries would not fit, only the first are there.
    """
    stresses: Basis
    """m - rank vectors: the same for its transpose."""

    @property
    def is_read_only(self) -> bool:
        """The arrays come from `calls.analyse_model`, which has made them so."""
        return True


class RawVariants(NamedTuple):
    """What is known of each of some variants; k pairs at most."""

    decided: BoolArray
    """(variants,) whether the rank is known and in no doubt; else the rest is not to be used."""
    rows: IntArray
    """(variants,) of D(c)."""
    columns: IntArray
    """(variants,) likewise."""
    rank: IntArray
    """(variants,)"""
    largest_zero: FloatArray
    """(variants,) of the scaled D(c); NaN without one."""
    zero_moves: BoolArray
    """(variants,) whether the move of one node lifts some zero."""
    zero_turns: BoolArray
    """(variants,) whether the turn of one element does."""
    smallest: FloatArray
    """(variants,) smallest singular value of D(c) itself; NaN where there is none."""
    largest: FloatArray
    """(variants,) largest of them; NaN where it is not known."""
    characteristic_length: FloatArray
    """(variants,) [m]."""
    pair_value: FloatArray
    """(variants, k) smallest singular values of the scaled D(c), ascending; NaN beyond the last."""
    by_move: FloatArray
    """(variants, k) the largest change of each by the move of one node [1/m]."""
    by_turn: FloatArray
    """(variants, k) the largest change of each by the turn of one element [1/rad]."""


class RawEchelon(NamedTuple):
    """The reduced echelon form of D(c), or of its transpose, modulo a prime."""

    prime: int
    as_typed: bool
    """Whether it is of the decimals as typed, or of the doubles as stored."""
    pivots: tuple[int, ...]
    """The column of the first entry, a one, of each row that is not zero."""
    entries: dict[tuple[int, int], int]
    """Residues of the other entries that are not zero, by column and pivot of their row."""
