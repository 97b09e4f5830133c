# SPDX-License-Identifier: BSD-3-Clause
"""The search for layouts of flexures between a body and what holds it, in parallel.

A recipe says how many flexures of which kinds hold W once: five wires; a sheet and two wires; for
each the sets that are found are told, the stiffest first. Symmetric sets are made of whole sets of
images.
"""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from ..core.arrays import BoolArray, FloatArray
from .candidates import Candidates, Place, folded, sheets, waisted, wires
from .choice import Blocks, Chosen, Clearances, blocks_of, chosen_sets, clear_of
from .frame import Scaled
from .images import Group, groups, materials, moved, orbits
from .rods import bellows, notches, rods, struts

#: How much flexures of each kind hold.
HOLDS = {
    **{"wire": 1, "folded sheet": 1, "strut": 1, "bellows": 1},
    **{"waisted sheet": 2, "sheet": 3, "rod": 4, "notch": 5},
}
_MAKERS: dict[str, Callable[[Place, int], Candidates]] = {
    "wire": wires,
    "folded sheet": folded,
    "waisted sheet": waisted,
    "sheet": sheets,
    "notch": notches,
    "rod": rods,
    "strut": struts,
    "bellows": bellows,
}
#: Points along an edge of a region, finer where few flexures were found.
_FINENESS = (3, 5, 9)
#: With so many flexures of a kind no more are sought, and more than so many are thinned out.
_ENOUGH, _MOST = 60, 2000
#: Of how many flexures images are looked at, and from how many first sets.
_MOST_IMAGES, _IMAGE_STARTS = 240, 6


class Found(NamedTuple):
    """A set of flexures, and its recipe."""

    recipe: tuple[str, ...]
    chosen: Chosen


class Part(NamedTuple):
    """A set of flexures between two bodies of a layout, in the frame of the problem.

    Attributes:
        between: The bodies at the two ends of each flexure: "stage", "ground", or a body between.
        found: The set.
    """

    between: tuple[str, str]
    found: Found


class Arrangement(NamedTuple):
    """All flexures of a layout, in the frame of the problem.

    Attributes:
        kind: What differs between kinds of layouts, such as "a sheet and two wires".
        parts: Of one layer one; of layers and limbs several.
        bodies: Names of bodies between, and further points of each, (n, 3).
    """

    kind: str
    parts: tuple[Part, ...]
    bodies: tuple[tuple[str, FloatArray], ...] = ()


class Stock:
    """Flexures of all kinds between two regions, each kind sought when it is asked for.

    Args:
        place: The regions, and the freedom.
        avoided: Strips and radius of flexures that are there already.
    """

    def __init__(self, place: Place, avoided: Sequence[tuple[FloatArray, float]] = ()) -> None:
        """Nothing is sought yet."""
        self.place = place
        self.constraint = place.constraint
        self.clearances = Clearances(place.sizes.clearance)
        self._avoided = avoided
        self._known: dict[str, Candidates] = {}
        self._blocks: dict[str, Blocks] = {}
        self._orbits: dict[tuple[str, bytes], dict[int, Blocks]] = {}

    def beside(self, avoided: Sequence[tuple[FloatArray, float]]) -> Stock:
        """The same flexures, where there are others already."""
        made = Stock(self.place, avoided)
        made.clearances, made._known, made._blocks = self.clearances, self._known, self._blocks
        return made

    def candidates(self, kind: str) -> Candidates:
        """Flexures of a kind, thinned out evenly where there are very many."""
        if kind not in self._known:
            made = None
            for fineness in _FINENESS:
                made = _MAKERS[kind](self.place, fineness)
                if len(made) >= _ENOUGH:
                    break
            assert made is not None
            self._known[kind] = thinned(in_order(made), _MOST)
        return self._known[kind]

    def blocks(self, kind: str) -> Blocks:
        """The same on the basis of W."""
        if kind not in self._blocks:
            self._blocks[kind] = blocks_of(self.candidates(kind), self.constraint)
        return self._blocks[kind]

    def orbits(self, kind: str, group: Group) -> dict[int, Blocks]:
        """Flexures of a kind with their images, by how many these are."""
        key = kind, group.turns.tobytes()
        if key not in self._orbits:
            few = thinned(self.candidates(kind), _MOST_IMAGES)
            sets = orbits(group, few, self.place)
            self._orbits[key] = {each.members.shape[1]: each for each in sets}
        return self._orbits[key]

    @property
    def counts(self) -> dict[str, int]:
        """How many flexures of each kind were found, of the kinds that were sought."""
        return {kind: len(each) for kind, each in self._known.items()}

    def allowed(self, blocks: Blocks) -> BoolArray:
        """(n,) which are clear of flexures that are there already."""
        clear = np.ones(len(blocks), dtype=bool)
        for strips, radius in self._avoided:
            one = clear_of(strips, radius, blocks.candidates, self.place.sizes.clearance)
            clear &= one[blocks.members].all(axis=1)
        return clear

    def spans(self, kinds: Sequence[str]) -> bool:
        """Whether all flexures of some kinds together hold W."""
        rows = [self.blocks(kind).rows.reshape(-1, len(self.constraint)) for kind in set(kinds)]
        every = np.concatenate(rows)
        if len(every) < len(self.constraint):
            return False
        gram = every.T @ every / len(every)
        return bool(np.linalg.eigvalsh(gram)[0] > 1.0e-10)


def in_order(candidates: Candidates) -> Candidates:
    """The same in an order that follows from their places alone."""
    if not len(candidates):
        return candidates
    keys = materials(candidates, 7)
    return candidates.of(np.lexsort(keys.T[::-1]))


def thinned(candidates: Candidates, most: int) -> Candidates:
    """As many candidates as are asked for, evenly from all."""
    if len(candidates) <= most:
        return candidates
    return candidates.of(np.unique(np.linspace(0, len(candidates) - 1, most).astype(int)))


def recipes(
    count: int, kinds: Sequence[str], over: int = 0, couples: int = 0
) -> list[tuple[str, ...]]:
    """Recipes for a space of wrenches: how many flexures of which kinds hold it.

    One kind that holds a single force fills up what sheets, rods and notches leave; exact ones come
    first. Two whole sheets are never exact together (theorem 2). Bellows take what wires cannot, or
    everything where nothing else is asked for.

    Args:
        count: Dimensions of W.
        kinds: Of the flexures, of `flexact.designs.problem.KINDS`.
        over: How many self-stresses there may be.
        couples: How many bellows lines of W leave to do (`Possible.bellows`).
    """
    fillers = [kind for kind in ("wire", "folded sheet") if kind in kinds]
    fillers += ["strut"] if "notch" in kinds else []
    # Beside what holds more wires are struts enough.
    beside = fillers[:-1] if {"wire", "strut"} <= set(fillers) else fillers
    most_sheets = 0 if "sheet" not in kinds else 1 if not over else 2
    last: tuple[str, ...] = ()
    if "bellows" in kinds:
        last = ("bellows",) * (couples if set(kinds) != {"bellows"} else count)
    made = []
    for surplus in range(over + 1):
        whole = count + surplus - len(last)
        if whole == 0:
            made.append((surplus, last))
        for sheets_, waists in itertools.product(range(most_sheets + 1), range(whole // 2 + 1)):
            if waists and "waisted sheet" not in kinds:
                continue
            if sheets_ == 2 and surplus == 0:
                continue
            rest = whole - 3 * sheets_ - 2 * waists
            if rest < 0:
                continue
            big = ("sheet",) * sheets_ + ("waisted sheet",) * waists
            if rest == 0:
                made.append((surplus, big + last))
            else:
                some = beside if big else fillers
                made += [(surplus, big + (filler,) * rest + last) for filler in some]
        if {"wire", "folded sheet"} <= set(fillers):
            for wires_ in range(whole - 1, 0, -1):
                few = ("wire",) * wires_ + ("folded sheet",) * (whole - wires_)
                made.append((surplus, few + last))
        if "notch" in kinds and not surplus and not last:
            for stiff in ("notch", "rod"):
                rest = whole - HOLDS[stiff]
                if rest == 0:
                    made.append((surplus, (stiff,)))
                elif rest > 0:
                    made += [(surplus, (stiff,) + (filler,) * rest) for filler in beside]
    large = {"sheet", "rod", "notch"}

    def order(each: tuple[int, tuple[str, ...]]) -> tuple[int, bool, int]:
        kinds_ = set(each[1])
        return each[0], len(kinds_) > 1 and not large & kinds_, len(kinds_)

    return [recipe for _, recipe in sorted(dict.fromkeys(made), key=order)]


def is_mixed(recipe: Sequence[str]) -> bool:
    """Whether several kinds that hold a single force each fill up what others leave."""
    return len({kind for kind in recipe if HOLDS[kind] == 1}) > 1


def sets_of(stock: Stock, recipe: tuple[str, ...], starts: int) -> list[Found]:
    """Sets of a recipe, the stiffest first."""
    slots = [stock.blocks(kind) for kind in recipe]
    if not all(len(slot) for slot in slots) or not stock.spans(recipe):
        return []
    found = _chosen(stock, slots, starts)
    return sorted((Found(recipe, each) for each in found), key=_stiffness)


def _chosen(stock: Stock, slots: list[Blocks], starts: int) -> Iterator[Chosen]:
    """Sets of one of each slot that are clear of what is there already."""
    allowed = {id(slot): stock.allowed(slot) for slot in slots}
    clear = [allowed[id(slot)] for slot in slots]
    return chosen_sets(slots, len(stock.constraint), stock.clearances, clear, starts)


def _stiffness(found: Found) -> float:
    return -found.chosen.stiffness


def symmetric_sets(stock: Stock, group: Group, recipe: tuple[str, ...]) -> list[Found]:
    """Sets of a recipe that are their own images under a group, the stiffest first."""
    counts = Counter(recipe)
    by_kind: list[list[tuple[Blocks, ...]]] = []
    for kind, many in counts.items():
        sizes = stock.orbits(kind, group)
        by_kind.append(
            [
                tuple(sizes[part] for part in parts)
                for parts in _partitions(many, sorted(sizes, reverse=True))
            ]
        )
    made: list[Found] = []
    for choice in itertools.islice(itertools.product(*by_kind), 4):
        slots = [slot for each in choice for slot in each]
        slots.sort(key=lambda slot: -slot.rows.shape[1])
        made += [Found(recipe, each) for each in _chosen(stock, slots, _IMAGE_STARTS)]
    return sorted(made, key=_stiffness)


def _partitions(total: int, sizes: Sequence[int]) -> Iterator[tuple[int, ...]]:
    """Ways to make up a number of parts of some sizes, large ones first."""
    if total == 0:
        yield ()
        return
    for k, size in enumerate(sizes):
        if size <= total:
            for rest in _partitions(total - size, sizes[k:]):
                yield (size, *rest)


# Images of layouts ------------------------------------------------------------


def turns_that_keep(freedom: FloatArray, arrangement: Arrangement) -> tuple[int, list[Group]]:
    """The order of the group of turns and mirrors that keep the material of a layout, and parts.

    Looked for among mirrors and turns about axes of the frame and the own axis of the freedom.
    """
    sets = _sets(arrangement)
    here = _material(sets, np.eye(3), 5)
    kept, found = [np.eye(3)], []
    for group in groups(freedom):
        if _material(sets, group.turns[1], 5) == here:
            found.append(group)
            for turn in group.turns[1:]:
                if not any(np.abs(turn - other).max() < 1.0e-9 for other in kept):
                    kept.append(turn)
    # Products keep it as well: with a mirror a third of a turn has three of them.
    basic = kept[1:] if sets else []
    for one, other in ((one, other) for one in kept for other in basic):
        product = one @ other
        if not any(np.abs(product - each).max() < 1.0e-9 for each in kept):
            kept.append(product)
    return len(kept), found


def is_symmetric(arrangement: Arrangement, group: Group) -> bool:
    """Whether the material of a layout is its own image under a group."""
    sets = _sets(arrangement)
    return _material(sets, group.turns[1], 5) == _material(sets, np.eye(3), 5)


def key_of(frame: Scaled, arrangement: Arrangement) -> tuple[object, int]:
    """What is the same of all images of a layout, and how many images it has."""
    sets = _sets(arrangement)
    images = {tuple(_material(sets, turn)) for turn in frame.isometries}
    return min(images), len(images)


#: Flexures of one kind between the same bodies.
_Set = tuple[tuple[str, str], Candidates]


def _sets(arrangement: Arrangement) -> list[_Set]:
    made = []
    for between, found in arrangement.parts:
        places: dict[int, tuple[Candidates, list[int]]] = {}
        for candidates, k in found.chosen.members:
            places.setdefault(id(candidates), (candidates, []))[1].append(k)
        made += [(between, each.of(np.array(which))) for each, which in places.values()]
    return made


def _material(sets: Sequence[_Set], turn: FloatArray, digits: int = 6) -> list[tuple[object, ...]]:
    """Numbers of the material of flexures after a turn, in their order."""
    rows: list[tuple[object, ...]] = []
    for between, candidates in sets:
        every = materials(moved(candidates, turn), digits)
        # Bodies between may change places, too; which is which is told by where flexures are.
        bodies = tuple(name.rstrip(" 0123456789") for name in between)
        rows += [(bodies, candidates.kind, *row) for row in every.tolist()]
    return sorted(rows)
