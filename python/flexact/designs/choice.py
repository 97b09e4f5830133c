# SPDX-License-Identifier: BSD-3-Clause
"""The choice of flexures that together hold W once, and as stiffly as may be.

With the rows of a flexure on an orthonormal basis of W, k numbers each, a set is exact when its
rows are k and independent. Begun from many first ones, a set is filled with what adds most volume
to what it spans; then each member is exchanged for the one with which the determinant is largest
(Fedorov, *Theory of Optimal Experiments*, 1972), and at last for the one with which the least
singular value is. Rows are weighted with the root of their stiffness, so that the square of that
value is the least stiffness across the freedom, as far as flexures hold what they are to hold.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from ..core.arrays import BoolArray, FloatArray, IndexArray
from ..util.records import Frozen, cached_property
from .candidates import Candidates
from .geometry import between_segments, between_strips

#: From how many first members a choice begins.
STARTS = 32
#: Of how many the least singular values are compared.
_BEST = 40
#: How often all members are exchanged at most.
_ROUNDS = 6
#: A set with a smaller least singular value of unit rows is none.
_FLATTEST = 1.0e-3


@dataclass(frozen=True, eq=False)
class Blocks(Frozen):
    """What is chosen as one: a flexure, or flexures that are images of each other.

    Attributes:
        candidates: Of which the members are.
        members: (n, q) places among these.
        rows: (n, r, k) what each holds, unit rows on a basis of W.
        weighted: (n, r, k) the same by the root of its stiffness.
    """

    candidates: Candidates
    members: IndexArray
    rows: FloatArray
    weighted: FloatArray

    def __len__(self) -> int:
        """How many there are."""
        return len(self.members)

    @cached_property
    def largest(self) -> float:
        """The largest weighted row."""
        return float(np.linalg.norm(self.weighted, axis=2).max(initial=0.0)) or 1.0


def blocks_of(candidates: Candidates, constraint: FloatArray) -> Blocks:
    """Each candidate by itself.

    Args:
        candidates: Of one kind.
        constraint: (k, 6) orthonormal rows of W.
    """
    return blocks_of_sets(candidates, np.arange(len(candidates))[:, None], constraint)


def blocks_of_sets(candidates: Candidates, members: IndexArray, constraint: FloatArray) -> Blocks:
    """Sets of candidates, (n, q) places among them."""
    sizes = np.linalg.norm(candidates.rows, axis=2, keepdims=True)
    # Of what is held already the part at right angles to it counts.
    rows = candidates.rows @ constraint.T
    roots = np.linalg.cholesky(candidates.stiffness).transpose(0, 2, 1)
    shape = (len(members), members.shape[1] * rows.shape[1], len(constraint))
    return Blocks(
        *(candidates, members, (rows / sizes)[members].reshape(shape)),
        (roots @ rows)[members].reshape(shape),
    )


@dataclass(frozen=True, eq=False)
class Chosen(Frozen):
    """A set of flexures that holds W once.

    Attributes:
        members: Candidates and the place in these, one each.
        stiffness: The least stiffness across the freedom, in parts of modulus and size.
        sigma: The least singular value of its unit rows.
    """

    members: tuple[tuple[Candidates, int], ...]
    stiffness: float
    sigma: float


@dataclass(eq=False)
class Clearances:
    """Which flexures are far enough from each other; found once for each that was chosen.

    Attributes:
        clearance: The least distance of surfaces.
    """

    clearance: float
    _known: dict[tuple[int, int, int], BoolArray] = field(default_factory=dict)
    _kept: dict[int, Candidates] = field(default_factory=dict)

    def of(self, block: Blocks, place: int, others: Blocks) -> BoolArray:
        """(n,) whether each of the others is clear of a block."""
        clear = np.ones(len(others), dtype=bool)
        for member in block.members[place]:
            clear &= self._of(block.candidates, int(member), others.candidates)[others.members].all(
                axis=1
            )
        return clear

    def _of(self, candidates: Candidates, place: int, others: Candidates) -> BoolArray:
        key = (id(candidates), place, id(others))
        if key not in self._known:
            # What is kept has an identity that nothing else gets.
            self._kept |= {id(candidates): candidates, id(others): others}
            self._known[key] = clear_of(
                candidates.strips[place], candidates.radius, others, self.clearance
            )
        return self._known[key]


def clear_of(strips: FloatArray, radius: float, others: Candidates, clearance: float) -> BoolArray:
    """(n,) whether candidates are clear of a flexure of some strips, (m, 3, 3)."""
    clear = np.ones(len(others), dtype=bool)
    away = clearance + radius + others.radius - 1.0e-12
    centres, reaches = others.balls
    for strip in strips:
        # Those whose balls are apart need no closer look.
        middle = (strip[0] + strip[1]) / 2.0
        reach = np.linalg.norm(strip[1] - strip[0]) / 2.0 + np.linalg.norm(strip[2])
        off = centres - middle
        is_near = np.einsum("nmk,nmk->nm", off, off) < (reaches + (reach + away)) ** 2
        for k in range(is_near.shape[1]):
            near = np.flatnonzero(clear & is_near[:, k])
            if not near.size:
                continue
            each = others.strips[near, k]
            middles = between_segments(strip[0], strip[1], each[:, 0], each[:, 1])
            clear[near] = middles >= away
            # Where widths could decide, rectangles are compared.
            wide = np.linalg.norm(each[:, 2], axis=1) + np.linalg.norm(strip[2])
            decided = (middles < away) | (middles - wide >= away)
            rest = near[~decided]
            if rest.size:
                clear[rest] = between_strips(strip, each[~decided]) >= away
    return clear


def spread(rows: FloatArray, count: int, first: int) -> IndexArray:
    """Places of blocks, (n, r, k) rows, that span what is as different as may be."""
    bases = np.linalg.qr(rows.transpose(0, 2, 1))[0]
    taken = [first]
    nearest = np.full(len(rows), -1.0)
    for _ in range(min(count, len(rows)) - 1):
        # The cosine of the angle between two spaces, of one dimension that between two lines.
        shares = np.einsum("nkr,ks->nrs", bases, bases[taken[-1]])
        nearest = np.maximum(nearest, np.linalg.norm(shares, axis=(1, 2)))
        nearest[taken] = np.inf
        further = int(np.argmin(np.round(nearest, 6)))
        if not np.isfinite(nearest[further]):
            break
        taken.append(further)
    return np.array(taken)


def chosen_sets(
    slots: Sequence[Blocks],
    count: int,
    clearances: Clearances,
    allowed: Sequence[BoolArray],
    starts: int = STARTS,
) -> Iterator[Chosen]:
    """Sets of one block of each slot that hold W once, one for each first member that gives one.

    Args:
        slots: Of each member the blocks to choose from, those that hold most first.
        count: k.
        clearances: Between flexures.
        allowed: Of each slot which blocks may be chosen.
        starts: How many first members are tried.
    """
    first = slots[0]
    usable = np.flatnonzero(allowed[0])
    if not usable.size:
        return
    stiffest = int(np.argmax(np.round(np.linalg.norm(first.weighted[usable], axis=(1, 2)), 9)))
    known: set[tuple[tuple[int, int], ...]] = set()
    for place in usable[spread(first.rows[usable], starts, stiffest)]:
        filled = _filled(slots, int(place), count, clearances, allowed)
        if filled is None:
            continue
        for kept in (0, 1):
            # Where all exchanges lead to a set that is known, the first member stays.
            places = _exchanged(slots, list(filled), count, clearances, allowed, kept)
            key = tuple(sorted((id(slot), p) for slot, p in zip(slots, places, strict=True)))
            if key not in known:
                break
        else:
            continue
        known.add(key)
        rows = np.concatenate([slot.rows[p] for slot, p in zip(slots, places, strict=True)])
        weighted = np.concatenate([slot.weighted[p] for slot, p in zip(slots, places, strict=True)])
        if len(rows) < count:
            continue
        sigma = np.linalg.svd(rows, compute_uv=False)[count - 1]
        if sigma < _FLATTEST:
            continue
        least = np.linalg.svd(weighted, compute_uv=False)[count - 1]
        members = tuple(
            (slot.candidates, int(member))
            for slot, p in zip(slots, places, strict=True)
            for member in slot.members[p]
        )
        yield Chosen(members, float(least) ** 2, float(sigma))


def _filled(
    slots: Sequence[Blocks],
    start: int,
    count: int,
    clearances: Clearances,
    allowed: Sequence[BoolArray],
) -> list[int] | None:
    """A first set: each further member adds most volume to those before it."""
    places = [start]
    for k in range(1, len(slots)):
        clear = _clear(slots, places, k, clearances, allowed[k])
        if not clear.any():
            return None
        rows = np.concatenate([slots[j].weighted[p] for j, p in enumerate(places)])
        gains = np.where(clear, _gains(rows, slots[k], count), 0.0)
        places.append(int(np.argmax(_rounded(gains))))
    return places


def _rounded(values: np.ndarray) -> FloatArray:
    """Values with the digits that do not depend on the order of sums."""
    size = float(np.abs(values).max(initial=0.0)) or 1.0
    return np.asarray(np.round(values / size, 6))


def _clear(
    slots: Sequence[Blocks],
    places: Sequence[int],
    k: int,
    clearances: Clearances,
    allowed: BoolArray,
) -> BoolArray:
    clear = allowed.copy()
    for j, place in enumerate(places):
        if j != k:
            clear &= clearances.of(slots[j], place, slots[k])
            if slots[j].candidates is slots[k].candidates:
                # No flexure is chosen twice.
                for member in slots[j].members[place]:
                    clear &= (slots[k].members != member).all(axis=1)
    return clear


#: Of what weighted rows span, how much everything is held before there is any row.
_SOFT = 1.0e-6


def _gains(rows: FloatArray, slot: Blocks, count: int) -> FloatArray:
    """(n,) by how much blocks enlarge what rows span: the determinant of the least squares.

    Of G = rows' rows, held a little all over, det(G + B'B) / det(G) = det(1 + B inv(G) B').
    """
    size = slot.largest
    gram = rows.T @ rows + (_SOFT * size) ** 2 * np.eye(count)
    back = np.linalg.inv(np.linalg.cholesky(gram)).T
    beyond = slot.weighted @ back
    if beyond.shape[1] == 1:
        return np.asarray((beyond[:, 0] ** 2).sum(axis=1))
    square = beyond @ beyond.transpose(0, 2, 1) + np.eye(beyond.shape[1])
    # Of logarithms, since determinants of several rows differ by many powers of ten.
    return np.asarray(np.linalg.slogdet(square)[1])


def _exchanged(
    slots: Sequence[Blocks],
    places: list[int],
    count: int,
    clearances: Clearances,
    allowed: Sequence[BoolArray],
    kept: int,
) -> list[int]:
    """A set that no exchange of a member betters: the determinant first, then the least value.

    The first ones that are to be kept stay.
    """
    for by_least in (False, True):
        for _ in range(_ROUNDS):
            before = list(places)
            for k, slot in enumerate(slots):
                if k < kept:
                    continue
                others = [slots[j].weighted[p] for j, p in enumerate(places) if j != k]
                rows = np.concatenate([np.zeros((0, count)), *others])
                gains = _rounded(_gains(rows, slot, count))
                clear = _clear(slots, places, k, clearances, allowed[k])
                if by_least:
                    better = _by_least(rows, slot, gains, clear, places[k], count)
                else:
                    better = int(np.argmax(np.where(clear, gains, -1.0)))
                    better = better if gains[better] > gains[places[k]] else places[k]
                places[k] = better
            if places == before:
                break
    return places


def _by_least(
    rows: FloatArray,
    slot: Blocks,
    gains: FloatArray,
    clear: BoolArray,
    place: int,
    count: int,
) -> int:
    """The block of those that gain most with which the least singular value is largest."""
    order = np.flatnonzero(clear)
    if not order.size:
        return place
    order = np.append(place, order[np.argsort(-gains[order], kind="stable")[:_BEST]])
    added = slot.weighted[order]
    least = np.linalg.eigvalsh(rows.T @ rows + added.transpose(0, 2, 1) @ added)[:, 0]
    best = int(np.argmax(_rounded(least)))
    return int(order[best])
