# SPDX-License-Identifier: BSD-3-Clause
"""Layouts with limbs: what no wire holds is held by a body on a hinge and two wires from it.

Of the two forces of the wires just one combination does no work on the hinge, and that is all that
the limb holds: with parallel wires a couple across their plane, with skew ones a wrench with
pitch. So each limb holds one wrench of W, and has the five other freedoms; its body stays where it
is while the stage does. Limbs and plain wires are exact together where what they hold is
independent: three couples, of a Delta, leave x, y and z; two leave rotation about z besides
(Schoenflies).
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from ..core.arrays import BoolArray, FloatArray
from ..util.rotations import unit
from ..util.text import number_in_words
from .candidates import (
    Candidates,
    Place,
    Sizes,
    boxes_of,
    clear_of_boxes,
    forces,
    points_of,
    reached,
    wires_between,
)
from .choice import Chosen
from .frame import Scaled, turned_screws
from .geometry import TINY, between_segments, edges_of, within
from .images import Group, group_of, keeps, moved
from .layers import (
    Stocks,
    best_of_kinds,
    is_clear,
    key_of_boxes,
    names_of_bodies,
    strips_of,
)
from .layouts import kinds_in_words
from .possible import orthonormal, possible
from .problem import Box, Problem
from .rooms import Boxes, are_apart, asides, hull_of
from .search import Arrangement, Found, Part, Stock, recipes, symmetric_sets

#: How far the forces of a limb's wires must pass by its hinge, and how much of the wrench that a
#: limb holds must be in no other part of W that is held.
_LEVER, _NEW = 0.12, 0.25
#: Of each limb so many pairs of wires are tried, and of each pair so many hinges.
_PAIRS, _HINGES, _WRENCHES = 2, 2, 5
#: From how many first flexures the choice for a hinge begins.
_STARTS = 2
#: Points along an edge of a box from which lines of a limb start, and angles in a plane.
_FINE, _ANGLES = 3, 24
#: After so many layouts no more are sought; nor after so many searches in a region, of limbs that
#: are images of each other, and of others.
_ENOUGH, _TURNED, _SPENT = 3, 14, 24


class Limb(NamedTuple):
    """A body on a hinge, and two wires from it.

    Attributes:
        wrench: (6,) what it holds.
        hinge: The flexures of the hinge.
        pair: The wires.
        is_hanging: Whether the hinge is on the stage, and the wires go to the ground.
    """

    wrench: FloatArray
    hinge: Found
    pair: Found
    is_hanging: bool

    def parts(self, body: str) -> tuple[Part, Part]:
        """Its two sets of flexures, the hinge first."""
        above, below = ("stage", body), (body, "ground")
        hinge, pair = (above, below) if self.is_hanging else (below, above)
        return Part(hinge, self.hinge), Part(pair, self.pair)

    @property
    def strips(self) -> list[tuple[FloatArray, float]]:
        """What it fills."""
        return [*strips_of(self.hinge), *strips_of(self.pair)]

    def moved(self, turn: FloatArray) -> Limb:
        """Its image after a turn."""
        return self._replace(
            wrench=wrench_after(turn, self.wrench),
            hinge=_moved(self.hinge, turn),
            pair=_moved(self.pair, turn),
        )


def wrench_after(turn: FloatArray, wrench: FloatArray) -> FloatArray:
    """A wrench (f, m) after a turn or mirror about the origin."""
    return np.roll(turned_screws(turn, np.roll(wrench, 3)), 3)


def _moved(found: Found, turn: FloatArray) -> Found:
    members = tuple(
        (moved(candidates.of(np.array([k])), turn), 0) for candidates, k in found.chosen.members
    )
    chosen = Chosen(members, found.chosen.stiffness, found.chosen.sigma)
    return Found(found.recipe, chosen)


def limbs(
    problem: Problem,
    frame: Scaled,
    sizes: Sizes,
    kinds: Sequence[str],
    asked: Group | None = None,
) -> Iterator[Arrangement]:
    """Layouts of limbs, and of plain wires for the forces of W, one of each kind before others.

    Args:
        problem: Of which bodies are taken.
        frame: The same in its own frame.
        sizes: What flexures may measure.
        kinds: Of the flexures; none without wires.
        asked: Under which the layout is to be its own image; None where it need not be.
    """
    found = possible(frame.space)
    _, couples, pitched = found.limbs
    count = couples + pitched
    if "wire" not in kinds or not 0 < count <= problem.limits.bodies:
        return
    search = _Search(frame, sizes, kinds, found.forces.scaled, count, asked)
    wrenches = wrenches_of(found.constraint.scaled, found.forces.scaled, bool(pitched))
    is_first = True
    for is_hanging, limit in ((False, _SPENT), (True, 2 * _SPENT)):
        made: list[Arrangement] = []
        for layout in search.of_places(wrenches, count, is_hanging, limit):
            if is_first:
                # The first of all is shown while others are sought.
                yield layout
            else:
                made.append(layout)
            is_first = False
            if len(made) >= _ENOUGH:
                break
        yield from best_of_kinds(made)


def wrenches_of(constraint: FloatArray, held: FloatArray, is_pitched: bool) -> FloatArray:
    """(n, 6) unit wrenches of W that limbs may hold: couples, and others where these do not do.

    Args:
        constraint: (k, 6) orthonormal rows of W.
        held: (f, 6) orthonormal rows of what wires hold of it.
        is_pitched: Whether couples and forces are not all of W.
    """
    axes = np.array([each for each in itertools.product((0, 1, -1), repeat=3) if each > (0, 0, 0)])
    order = np.argsort(np.abs(axes).sum(axis=1), kind="stable")
    ways = axes[order] / np.linalg.norm(axes[order], axis=1, keepdims=True)
    # Couples of W are what is across all rotations.
    free = complement_of_forces(constraint)
    couples = np.concatenate((np.zeros_like(ways), ways @ free.T @ free), axis=1)
    sets = [couples]
    if is_pitched:
        values, vectors = np.linalg.eigh(constraint[:, :3] @ constraint[:, 3:].T * 1.0)
        principal = vectors.T @ constraint
        sets.append(principal[np.abs(values) > TINY])
        mixed = [
            one + sign * other
            for one, other in itertools.combinations(principal, 2)
            for sign in (1.0, -1.0)
        ]
        sets.append(np.array(mixed).reshape(-1, 6))
    every = np.concatenate(sets)
    lengths = np.linalg.norm(every, axis=1)
    every = every[lengths > 0.3] / lengths[lengths > 0.3, None]
    new = np.linalg.norm(every - every @ held.T @ held, axis=1)
    every = every[new > _NEW]
    kept: list[FloatArray] = []
    for row in every:
        if not any(abs(float(row @ other)) > 1.0 - 1.0e-6 for other in kept):
            kept.append(row)
    return np.array(kept).reshape(-1, 6)


def complement_of_forces(constraint: FloatArray) -> FloatArray:
    """(c, 3) orthonormal directions of the couples in a space of wrenches."""
    if not len(constraint):
        return np.zeros((0, 3))
    left, values, _ = np.linalg.svd(constraint[:, :3])
    rank = int((values > TINY).sum())
    return orthonormal((left.T @ constraint)[rank:, 3:])


class Sector(NamedTuple):
    """Where a limb may be that is to have images by turns: clear of these, and within the regions.

    Attributes:
        turns: (m, 3, 3) the identity, and those of the images.
        sides: (2, 3) unit vectors outward across the two planes through the axis that bound it.
        gap: How far from these it stays.
        stage: Where flexures end on the stage.
        ground: Likewise on the ground.
    """

    turns: FloatArray
    sides: FloatArray
    gap: float
    stage: Boxes
    ground: Boxes

    @staticmethod
    def around(
        box: Box, group: Group, count: int, regions: tuple[Boxes, Boxes], sizes: Sizes
    ) -> Sector | None:
        """The sector of a body; None of one that is on the axis of the turns."""
        middle = (box.low + box.high) / 2.0
        outward = middle - (middle @ group.axis) * group.axis
        if np.linalg.norm(outward) < _LEVER:
            return None
        outward = unit(outward)
        beside = np.cross(group.axis, outward)
        half = math.pi / group.order
        sides = np.array([sign * math.cos(half) * beside for sign in (1.0, -1.0)])
        sides -= math.sin(half) * outward
        gap = sizes.clearance / 2.0 + max(sizes.diameter, sizes.thickness) / 2.0
        return Sector(group.turns[:count], sides, gap, *regions)

    def has(self, ends: FloatArray, half: FloatArray, side: int) -> BoolArray:
        """Which clamped edges, of images too, are in the stage (0) or in the ground (1).

        Args:
            ends: (n, 3) middles of edges.
            half: (n, 3) half of the edges.
            side: Which region.
        """
        ok = np.ones(len(ends), dtype=bool)
        for turn in self.turns:
            inside = np.zeros(len(ends), dtype=bool)
            for box in (self.stage, self.ground)[side]:
                both = [
                    within((ends + sign * half) @ turn.T, box.low, box.high) for sign in (1, -1)
                ]
                inside |= both[0] & both[1]
            ok &= inside
        return ok

    def is_around(self, strips: FloatArray) -> BoolArray:
        """(n,) which strips, (n, m, 3, 3), are in the sector."""
        corners = edges_of(strips)[..., 0, :].reshape(len(strips), 4 * strips.shape[1], 3)
        return np.asarray(((corners @ self.sides.T) <= -self.gap).all(axis=(1, 2)))

    def stock(self, stock: Stock) -> Stock:
        """Those flexures of a stock that are in the sector and whose images fit."""
        side = 1 if stock.place.there is self.ground else 0
        return _Fitting(stock, self, side)


class _Fitting(Stock):
    """Flexures of another stock that fit in a sector."""

    def __init__(self, stock: Stock, sector: Sector, side: int) -> None:
        """Nothing is sought yet."""
        super().__init__(stock.place)
        self._stock, self._sector, self._side = stock, sector, side

    def beside(self, avoided: Sequence[tuple[FloatArray, float]]) -> Stock:
        """The same flexures, where there are others already."""
        made = _Fitting(self._stock, self._sector, self._side)
        made._avoided, made._known, made._blocks = avoided, self._known, self._blocks
        return made

    def candidates(self, kind: str) -> Candidates:
        """Flexures of a kind."""
        if kind not in self._known:
            made = self._stock.candidates(kind)
            place = -1 if self._side else 0
            half = made.strips[:, place, 2]
            fits = self._sector.has(made.ends[:, place], half, self._side)
            self._known[kind] = made.of(fits & self._sector.is_around(made.strips))
        return self._known[kind]


class _Search:
    """Limbs of one problem.

    Args:
        frame: The problem in its own frame.
        sizes: What flexures may measure.
        kinds: Of flexures.
        held: (f, 6) orthonormal rows of what wires hold of W.
        count: How many limbs.
        asked: Under which a layout is to be its own image; None where it need not be.
    """

    def __init__(
        self,
        frame: Scaled,
        sizes: Sizes,
        kinds: Sequence[str],
        held: FloatArray,
        count: int,
        asked: Group | None,
    ) -> None:
        """Nothing is sought yet."""
        self.frame, self.sizes, self.kinds = frame, sizes, kinds
        self.held, self.asked = held, asked
        # A single limb is to be its own image, several may be images of each other.
        self.own = asked if count == 1 else None
        self.stage, self.ground = boxes_of(frame.stage), boxes_of(frame.ground)
        self.stocks = Stocks(frame, sizes)

    def of_places(
        self, wrenches: FloatArray, count: int, is_hanging: bool, limit: int
    ) -> Iterator[Arrangement]:
        """Layouts whose bodies are in boxes that are given, or beside the stage."""
        if count > 1 and not self.frame.intermediate:
            for group in _turns(self.frame.freedom, count, self.asked):
                for (boxes,) in self.places(1):
                    if self.stocks.spent > _TURNED:
                        break
                    yield from self.turned(boxes, group, count, wrenches, is_hanging)
        for places in self.places(count):
            if self.stocks.spent > limit:
                return
            layout = self.at(places, wrenches, is_hanging)
            if layout is not None:
                yield layout

    def places(self, count: int) -> Iterator[tuple[Boxes, ...]]:
        """Boxes of bodies, images of each other once."""
        known: set[bytes] = set()
        for places in asides(self.frame, self.sizes, count):
            images = [key_of_boxes(turn, places) for turn in self.frame.isometries]
            if images[0] not in known:
                known |= set(images)
                yield places

    def at(
        self, places: Sequence[Boxes], wrenches: FloatArray, is_hanging: bool
    ) -> Arrangement | None:
        """A layout with a limb in each of some places; None where none was found."""
        chosen: list[Limb] = []
        for k, boxes in enumerate(places):
            solid = [box for j, other in enumerate(places) if j != k for box in other]
            limb = self.next_limb(boxes, solid, wrenches, chosen, is_hanging)
            if limb is None:
                return None
            chosen.append(limb)
        solid = [box for boxes in places for box in boxes]
        return self.completed(chosen, solid, self.own)

    def next_limb(
        self,
        boxes: Boxes,
        solid: Sequence[Box],
        wrenches: FloatArray,
        others: Sequence[Limb],
        is_hanging: bool,
    ) -> Limb | None:
        """The first limb that holds something which is not held yet."""
        held = np.array([*self.held, *(limb.wrench for limb in others)]).reshape(-1, 6)
        spanned = orthonormal(held)
        new = np.linalg.norm(wrenches - wrenches @ spanned.T @ spanned, axis=1)
        avoided = [strip for limb in others for strip in limb.strips]
        # What is most unlike what is held comes first.
        order = [n for n in np.argsort(-np.round(new, 3), kind="stable") if new[n] > _NEW]
        for place in order[:_WRENCHES]:
            for limb in self.made(wrenches[place], boxes, solid, avoided, is_hanging):
                return limb
        return None

    def made(
        self,
        wrench: FloatArray,
        boxes: Boxes,
        solid: Sequence[Box],
        avoided: list[tuple[FloatArray, float]],
        is_hanging: bool,
        sector: Sector | None = None,
    ) -> Iterator[Limb]:
        """Limbs that hold a wrench, with their body in some boxes, clear of what is there."""
        above, below = (self.stage, boxes), (boxes, self.ground)
        of_hinge, of_pair = (above, below) if is_hanging else (below, above)
        beyond = self.stage if not is_hanging else self.ground
        beside = self.ground if not is_hanging else self.stage
        place = Place(
            *(np.zeros((0, 6)), *of_pair, (*self.frame.keep_out, *solid, *beside), self.sizes)
        )
        through = points_of(boxes, _FINE)
        for pair in itertools.islice(pairs(place, wrench, sector, self.own), _PAIRS):
            if not is_clear(pair, avoided, self.sizes.clearance):
                continue
            candidates, first = pair.chosen.members[0]
            near = [*avoided, *strips_of(pair)]
            for axis in itertools.islice(
                hinges(through, wrench, candidates.rows[first, 0]), _HINGES
            ):
                if self.own is not None and not keeps(axis[None], self.own.turns):
                    continue
                stock = self.stocks.between(axis[None], *of_hinge, [*solid, *beyond])
                if sector is not None:
                    stock = sector.stock(stock)
                hinge = self.hinge(stock, near)
                if hinge is not None:
                    yield Limb(wrench, hinge, pair, is_hanging)

    def hinge(self, stock: Stock, avoided: Sequence[tuple[FloatArray, float]]) -> Found | None:
        """The flexures of a hinge: those with a sheet first."""
        made = recipes(len(stock.constraint), self.kinds)
        for recipe in sorted(made, key=lambda each: ("sheet" not in each, len(each))):
            if all(len(stock.candidates(kind)) for kind in set(recipe)):
                if self.own is not None:
                    found = symmetric_sets(stock.beside(avoided), self.own, recipe)
                else:
                    found = self.stocks.sets_beside(stock, recipe, avoided, _STARTS)
                if found:
                    return found[0]
        return None

    def turned(
        self, boxes: Boxes, group: Group, count: int, wrenches: FloatArray, is_hanging: bool
    ) -> Iterator[Arrangement]:
        """Layouts of limbs that are images of each other."""
        sector = Sector.around(hull_of(boxes), group, count, (self.stage, self.ground), self.sizes)
        if sector is None or not self.is_clear_turned(hull_of(boxes), sector.turns):
            return
        tried = 0
        for wrench in wrenches:
            images = [wrench_after(turn, wrench) for turn in sector.turns]
            rows = np.array([*self.held, *images])
            if np.linalg.svd(rows, compute_uv=False)[-1] < _NEW:
                continue
            tried += 1
            if tried > _WRENCHES:
                return
            for limb in self.made(wrench, boxes, [], [], is_hanging, sector):
                together = [limb.moved(turn) for turn in sector.turns]
                whole = group if count == group.order else None
                layout = self.completed(together, boxes, whole)
                if layout is not None:
                    yield layout
                    return

    def is_clear_turned(self, box: Box, turns: FloatArray) -> bool:
        """Whether images of a body stay out of what is to be kept out of."""
        corners = points_of((box,), 2)
        images = (corners @ turn.T for turn in turns)
        hulls = tuple(Box(image.min(axis=0), image.max(axis=0)) for image in images)
        return are_apart(hulls, self.frame.keep_out, self.sizes.clearance)

    def completed(
        self, together: Sequence[Limb], solid: Sequence[Box], group: Group | None
    ) -> Arrangement | None:
        """Limbs with the plain wires that hold the forces of W; None where these do not fit."""
        parts = []
        names = names_of_bodies(len(together))
        for name, limb in zip(names, together, strict=True):
            parts += [part for part in limb.parts(name)]
        held = [limb.wrench for limb in together]
        what = ""
        if len(self.held):
            free = np.roll(_complement(self.held), 3, axis=1)
            stock = self.stocks.between(free, self.stage, self.ground, solid)
            avoided = [strip for limb in together for strip in limb.strips]
            plain = None
            for recipe in recipes(len(self.held), self.kinds):
                if all(len(stock.candidates(kind)) for kind in set(recipe)):
                    made = []
                    if group is not None:
                        made = symmetric_sets(stock.beside(avoided), group, recipe)
                    made = made or self.stocks.sets_beside(stock, recipe, avoided)
                    plain = made[0] if made else None
                if plain is not None:
                    break
            if plain is None:
                return None
            parts.append(Part(("stage", "ground"), plain))
            what = f", and {kinds_in_words(plain.recipe)}"
        rows = np.array([*self.held, *held])
        if np.linalg.svd(rows, compute_uv=False)[-1] < _NEW / 2.0:
            return None
        kinds = dict.fromkeys(kinds_in_words(limb.hinge.recipe) for limb in together)
        root = "stage" if together[0].is_hanging else "ground"
        many = number_in_words(len(together))
        of = "a limb" if len(together) == 1 else f"{many} limbs, each"
        kind = f"{of} hinged to the {root} by {' or by '.join(kinds)}{what}"
        none = np.zeros((0, 3))
        return Arrangement(kind, tuple(parts), tuple((name, none) for name in names))


def _complement(rows: FloatArray) -> FloatArray:
    return np.asarray(np.linalg.svd(rows)[2][len(rows) :])


def _turns(freedom: FloatArray, count: int, asked: Group | None) -> Iterator[Group]:
    """Groups of turns that keep a freedom, of which so many images are taken."""
    if asked is not None:
        made = [asked] if asked.order == count else []
    else:
        orders = (3,) if count == 3 else (4, 3)
        made = [group_of(order, axis) for order in orders for axis in np.eye(3)[::-1]]
    for group in made:
        if keeps(freedom, group.turns):
            yield group


# One limb -------------------------------------------------------------------------------


def pairs(
    place: Place,
    wrench: FloatArray,
    sector: Sector | None = None,
    group: Group | None = None,
) -> Iterator[Found]:
    """Two wires of which one combination is a wrench, the stiffest first, in unlike directions.

    Args:
        place: Between which regions.
        wrench: (6,) of unit length.
        sector: In which they have to be, if they are to have images.
        group: Under which they have to be their own images, if any.
    """
    is_couple = np.linalg.norm(wrench[:3]) <= TINY
    ends = _parallel(place, wrench[3:]) if is_couple else _skew(place, wrench)
    if not len(ends):
        return
    lengths = np.linalg.norm(ends[:, :, 1] - ends[:, :, 0], axis=2)
    ways = (ends[:, :, 1] - ends[:, :, 0]) / lengths[..., None]
    rows = forces(ends[:, :, 0], ways)
    # Of each pair the shares of its forces in the wrench.
    shares = np.linalg.pinv(rows.transpose(0, 2, 1)) @ wrench
    area = math.pi * place.sizes.diameter**2 / 4.0
    stiffness = area / (shares**2 * lengths).sum(axis=1)
    away = place.sizes.clearance + place.sizes.diameter
    apart = between_segments(ends[:, 0, 0], ends[:, 0, 1], ends[:, 1, 0], ends[:, 1, 1])
    clear = apart >= away
    for k in range(2):
        strips = np.stack((ends[:, k, 0], ends[:, k, 1], np.zeros_like(ways[:, k])), axis=1)
        clear &= clear_of_boxes(place, strips[:, None], place.sizes.diameter / 2.0)
        if sector is not None:
            side = 0 if place.here is sector.stage else 1
            clear &= sector.has(ends[:, k, side], np.zeros_like(ends[:, k, side]), side)
            clear &= sector.is_around(strips[:, None])
    for turn in group.turns[1:] if group is not None else ():
        image = ends @ turn.T
        each = [
            np.abs(image - other).max(axis=(1, 2, 3)) <= TINY for other in (ends, ends[:, ::-1])
        ]
        clear &= each[0] | each[1]
    order = [n for n in np.argsort(-np.round(stiffness / area, 6), kind="stable") if clear[n]]
    told: list[FloatArray] = []
    for n in order:
        if any((np.abs((ways[n] * other).sum(axis=1)) > 0.95).all() for other in told):
            continue
        told.append(ways[n])
        made = wires_between(place, ends[n, :, 0], ends[n, :, 1])
        if len(made) == 2:
            sigma = float(1.0 / np.linalg.norm(shares[n]))
            chosen = Chosen(((made, 0), (made, 1)), float(stiffness[n]), sigma)
            yield Found(("wire", "wire"), chosen)


def _parallel(place: Place, normal: FloatArray) -> FloatArray:
    """(n, 2, 2, 3) ends of two parallel wires in a plane, as far apart as the regions allow."""
    points = np.concatenate((points_of(place.here, _FINE), points_of(place.there, _FINE)))
    first = unit(np.cross(normal, np.eye(3)[np.abs(normal).argmin()]))
    second = np.cross(normal, first)
    angles = np.arange(_ANGLES) * (math.pi / _ANGLES)
    ways = np.cos(angles)[:, None] * first + np.sin(angles)[:, None] * second
    starts = np.repeat(points, len(ways), axis=0)
    directions = np.tile(ways, (len(points), 1))
    extent = max(float((box.high - box.low).max()) for box in place.here)
    made = [np.zeros((0, 2, 2, 3))]
    for share in (1.0, 0.7, 0.45, 0.25, 0.15):
        half = share * extent / 2.0 * np.cross(normal, directions)
        which, begins, ends = reached(place, starts, directions, half)
        edges = half[which]
        made.append(
            np.stack(
                [np.stack((begins + h, ends + h), axis=1) for h in (edges, -edges)],
                axis=1,
            )
        )
    return np.concatenate(made)


def _skew(place: Place, wrench: FloatArray) -> FloatArray:
    """(n, 2, 2, 3) ends of two wires whose lines are conjugate with regard to a wrench.

    For a force F that is not reciprocal to the wrench w, w - a F is a force as well where
    a = q(w) / (2 q(w, F)), since q(w - a F) = q(w) - 2 a q(w, F).
    """
    here, there = points_of(place.here, 5), points_of(place.there, 5)
    starts = np.repeat(here, len(there), axis=0)
    ways = np.tile(there, (len(here), 1)) - starts
    lengths = np.linalg.norm(ways, axis=1)
    fits = (lengths >= place.sizes.length[0]) & (lengths <= place.sizes.length[1])
    starts, ways = starts[fits], ways[fits] / lengths[fits, None]
    one = forces(starts, ways)
    own = float(wrench[:3] @ wrench[3:])
    mixed = (one[:, :3] @ wrench[3:] + one[:, 3:] @ wrench[:3]) / 2.0
    some = np.abs(mixed) > 1.0e-3
    one, starts, ways, mixed = one[some], starts[some], ways[some], mixed[some]
    other = wrench - (own / (2.0 * mixed))[:, None] * one
    sizes = np.linalg.norm(other[:, :3], axis=1)
    some = sizes > 1.0e-3
    other = other[some] / sizes[some, None]
    which, begins, ends = reached(
        place, np.cross(other[:, :3], other[:, 3:]), other[:, :3], np.zeros((len(other), 3))
    )
    mine, first, last = reached(place, starts[some], ways[some], np.zeros((len(other), 3)))
    # Of both wires forth or back whichever reaches.
    by_line = {int(line): k for k, line in enumerate(mine)}
    both = [(by_line[int(line)], k) for k, line in enumerate(which) if int(line) in by_line]
    if not both:
        return np.zeros((0, 2, 2, 3))
    ones, others = np.array(both).T
    return np.stack(
        (
            np.stack((first[ones], last[ones]), axis=1),
            np.stack((begins[others], ends[others]), axis=1),
        ),
        axis=1,
    )


def hinges(points: FloatArray, wrench: FloatArray, force: FloatArray) -> Iterator[FloatArray]:
    """(6,) unit twists of rotations on which a wrench does no work and a force does most.

    About a point p of the axis the wrench (f, m) has the moment m + f x p, across which the axis
    is; along what is left of the moment of the force there the lever is longest.

    Args:
        points: (n, 3) through which axes may go.
        wrench: (6,) what the limb holds.
        force: (6,) of one of its wires.
    """
    about = wrench[3:] + np.cross(wrench[:3], points)
    sizes = np.linalg.norm(about, axis=1, keepdims=True)
    across = about / np.where(sizes > TINY, sizes, 1.0)
    moment = force[3:] + np.cross(force[:3], points)
    left = moment - (moment * across).sum(axis=1, keepdims=True) * across
    levers = np.linalg.norm(left, axis=1)
    told: list[FloatArray] = []
    for n in np.argsort(-np.round(levers, 6), kind="stable"):
        if levers[n] < _LEVER:
            return
        axis = left[n] / levers[n]
        # One of several axes on a line, or near each other, is enough.
        twist = np.concatenate((axis, np.cross(points[n], axis)))
        if any(np.linalg.norm(np.abs(twist - other)) < 0.3 for other in told):
            continue
        told.append(twist)
        yield twist / np.linalg.norm(twist)
