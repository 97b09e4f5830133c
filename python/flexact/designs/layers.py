# SPDX-License-Identifier: BSD-3-Clause
"""Layouts in layers: bodies in a row from the ground to the stage, flexures between neighbours.

The freedom of the stage is the sum of those of its layers. Where that sum is direct, no body
between moves while the stage is held, so that nothing has to be declared of it (theorem 3 of
docs/theory.md). Each layer is a parallel layout of its own, sought between the boxes of its two
bodies; what fills one layer, and all other bodies, is kept out of by the others.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from ..advice.spaces.screws import ScrewSpace, canonical
from ..core.arrays import FloatArray
from ..util.text import number_in_words
from .candidates import Place, Sizes, boxes_of
from .choice import clear_of
from .frame import Scaled, rounded, turned_screws
from .images import Group, keeps
from .layouts import kinds_in_words
from .possible import layers_of
from .problem import Box, Problem
from .rooms import Boxes, corners_between, stacks
from .search import HOLDS, Arrangement, Found, Part, Stock, recipes, sets_of, symmetric_sets

#: How many ways to cut a freedom are tried, and after how many layouts of one no more are sought;
#: nor after so many searches in a region or for a set where there are layouts, and where not.
_CUTS, _ENOUGH, _SPENT, _ALL = 8, 6, 24, 60
#: From how many first flexures the choice in a layer begins, and how many sets are combined.
_STARTS, _SETS = 4, 3
#: A layer with a smaller least singular value of unit rows is none.
_FLATTEST = 0.02


@dataclass(eq=False)
class Stocks:
    """Flexures between two regions, sought once for each freedom and each pair of regions.

    Attributes:
        frame: The problem in its own frame.
        sizes: What flexures may measure.
        group: Under which each set is to be its own image; None where it need not be.
        spent: How many regions were looked into, and sets sought.
    """

    frame: Scaled
    sizes: Sizes
    group: Group | None = None
    spent: int = 0
    _known: dict[bytes, Stock] = field(default_factory=dict)
    _sets: dict[tuple[int, tuple[str, ...]], list[Found]] = field(default_factory=dict)

    def between(
        self, freedom: FloatArray, here: Boxes, there: Boxes, solid: Sequence[Box]
    ) -> Stock:
        """Flexures from some boxes to others that hold nothing of a freedom.

        Args:
            freedom: (d, 6) orthonormal rows.
            here: Of the body that moves.
            there: Of what holds it.
            solid: What else is kept out of: boxes of other bodies.
        """
        numbers = [np.round(freedom.T @ freedom, 9).ravel() + 0.0]
        for boxes in (here, there, solid):
            numbers += [np.array([len(boxes)], float)]
            numbers += [np.concatenate((box.low, box.high)) for box in boxes]
        key = np.concatenate(numbers).tobytes()
        if key not in self._known:
            # Rows that do not depend on the sense in which a motion was written.
            rows = rounded(canonical(freedom))
            place = Place(rows, here, there, (*self.frame.keep_out, *solid), self.sizes)
            self._known[key] = Stock(place)
            self.spent += 1
        return self._known[key]

    def sets(self, stock: Stock, recipe: tuple[str, ...], starts: int = _STARTS) -> list[Found]:
        """Sets of a recipe, the stiffest first, of a stock with nothing beside it."""
        key = (id(stock), recipe)
        if key not in self._sets:
            self._sets[key] = self.sets_beside(stock, recipe, [], starts)
        return self._sets[key]

    def sets_beside(
        self,
        stock: Stock,
        recipe: tuple[str, ...],
        avoided: Sequence[tuple[FloatArray, float]],
        starts: int = _STARTS,
    ) -> list[Found]:
        """The same beside flexures that are there."""
        self.spent += 1
        there = stock.beside(avoided) if avoided else stock
        if self.group is not None:
            return symmetric_sets(there, self.group, recipe)
        return sets_of(there, recipe, starts)


def strips_of(found: Found) -> list[tuple[FloatArray, float]]:
    """What the flexures of a set fill: strips and radius of each."""
    return [(candidates.strips[k], candidates.radius) for candidates, k in found.chosen.members]


def layered(
    problem: Problem,
    frame: Scaled,
    sizes: Sizes,
    kinds: Sequence[str],
    asked: Group | None = None,
) -> Iterator[Arrangement]:
    """Layouts in layers, one of each kind before others.

    Args:
        problem: Of which wanted motions, bodies and over-constraint are taken.
        frame: The same in its own frame.
        sizes: What flexures may measure.
        kinds: Of the flexures.
        asked: Under which each layer is to be its own image; None where it need not be.
    """
    if set(kinds) <= {"bellows"}:
        # Each layer holds forces.
        return
    factors = np.repeat((problem.size, 1.0), 3)
    wanted = [motion.twist * factors / problem.size for motion in problem.wanted]
    typed = [rounded(turned_screws(frame.turn, twist)) for twist in wanted]
    stocks = Stocks(frame, sizes, asked)
    over = problem.limits.over_constraint
    seen: set[frozenset[bytes]] = set()
    is_first = True
    for spaces in layers_of(frame.space, typed):
        if not 1 < len(spaces) <= problem.limits.bodies + 1:
            continue
        if asked and not all(keeps(space.scaled, asked.turns) for space in spaces):
            continue
        cut = frozenset(_projector(space) for space in spaces)
        if cut in seen:
            continue
        seen.add(cut)
        made: list[Arrangement] = []
        begun = stocks.spent
        for bodies, order in _ways(frame, sizes, spaces):
            found = _arranged(stocks, bodies, order, kinds, over)
            if found and is_first:
                # The first of all is shown while others are sought.
                yield found.pop(0)
                is_first = False
            made += found
            if len(made) >= _ENOUGH or stocks.spent - begun > _SPENT:
                break
        yield from best_of_kinds(made)
        if stocks.spent > (_ALL if is_first else _SPENT) or len(seen) >= _CUTS:
            return


def _projector(space: ScrewSpace) -> bytes:
    rows = space.scaled
    return np.asarray(np.round(rows.T @ rows, 9) + 0.0).tobytes()


def best_of_kinds(made: Sequence[Arrangement]) -> list[Arrangement]:
    """Arrangements, the stiffest of each kind first, then second ones of each."""
    ordered = sorted(made, key=lambda each: -stiffness_of(each))
    places: dict[str, int] = {}
    keyed = []
    for each in ordered:
        places[each.kind] = places.get(each.kind, -1) + 1
        keyed.append((places[each.kind], each))
    return [each for _, each in sorted(keyed, key=lambda pair: pair[0])]


def stiffness_of(arrangement: Arrangement) -> float:
    """The least stiffness of its parts, which hold one after the other."""
    return min(part.found.chosen.stiffness for part in arrangement.parts)


def _ways(
    frame: Scaled, sizes: Sizes, spaces: Sequence[ScrewSpace]
) -> Iterator[tuple[tuple[Boxes, ...], tuple[ScrewSpace, ...]]]:
    """Boxes of bodies and freedoms of layers, from the ground to the stage, none twice.

    What is an image of another way under an isometry of the problem is left out.
    """
    orders = list(itertools.permutations(spaces))
    known: set[bytes] = set()
    for bodies in stacks(frame, sizes, len(spaces) - 1):
        for order in orders:
            images = [_key(turn, bodies, order) for turn in frame.isometries]
            if images[0] not in known:
                known |= set(images)
                yield bodies, order


def _key(turn: FloatArray, bodies: Sequence[Boxes], order: Sequence[ScrewSpace]) -> bytes:
    numbers = []
    for space in order:
        rows = turned_screws(turn, space.scaled)
        numbers.append((rows.T @ rows).ravel())
    shapes = np.asarray(np.round(np.concatenate(numbers), 6) + 0.0).tobytes()
    return shapes + key_of_boxes(turn, bodies)


def key_of_boxes(turn: FloatArray, bodies: Sequence[Boxes]) -> bytes:
    """What tells boxes of bodies apart, after a turn."""
    numbers = [np.zeros(0)]
    for boxes in bodies:
        ends = np.array([(box.low, box.high) for box in boxes]) @ turn.T
        rows = np.round(np.concatenate((ends.min(axis=1), ends.max(axis=1)), axis=1), 6) + 0.0
        numbers.append(rows[np.lexsort(rows.T)].ravel())
    return np.concatenate(numbers).tobytes()


def _arranged(
    stocks: Stocks,
    bodies: Sequence[Boxes],
    spaces: Sequence[ScrewSpace],
    kinds: Sequence[str],
    over: int,
) -> list[Arrangement]:
    """Layouts of layers between given boxes: of each style of flexures the stiffest that is clear.

    Args:
        stocks: The flexures.
        bodies: Boxes from the ground to the stage.
        spaces: Freedoms of the layers, one more, in the same order.
        kinds: Of the flexures.
        over: How many self-stresses the layout may have.
    """
    frame = stocks.frame
    row = (boxes_of(frame.ground), *bodies, boxes_of(frame.stage))
    layers = []
    for k, space in enumerate(spaces):
        solid = [box for j, boxes in enumerate(row) if j not in (k, k + 1) for box in boxes]
        stock = stocks.between(space.scaled, row[k + 1], row[k], solid)
        choices = _choices(stock, kinds, over)
        if not choices:
            return []
        layers.append((stock, choices))
    made: list[Arrangement] = []
    for chosen in _styles([choices for _, choices in layers], over):
        found = together(
            stocks, [(stock, recipe) for (stock, _), recipe in zip(layers, chosen, strict=True)]
        )
        if found is not None:
            made.append(_arrangement(bodies, found))
    return made


#: A style: the kinds of flexures, and the self-stresses.
Style = tuple[frozenset[str], int]


def _choices(stock: Stock, kinds: Sequence[str], over: int) -> dict[Style, tuple[str, ...]]:
    """Of each style the first recipe of which there are flexures that together hold W."""
    found: dict[Style, tuple[str, ...]] = {}
    count = len(stock.constraint)
    for recipe in recipes(count, kinds, over):
        style = (frozenset(recipe), sum(HOLDS[kind] for kind in recipe) - count)
        if style in found:
            continue
        if all(len(stock.candidates(kind)) for kind in style[0]) and stock.spans(recipe):
            found[style] = recipe
    return found


def _styles(
    layers: Sequence[dict[Style, tuple[str, ...]]], over: int
) -> Iterator[tuple[tuple[str, ...], ...]]:
    """Recipes, one for each layer: of one style as far as layers have it, none twice."""
    known = set()
    for kinds, surplus in dict.fromkeys(style for each in layers for style in each):
        left, made = over, []
        for each in layers:
            style = (kinds, surplus) if surplus <= left else (kinds, 0)
            style = style if style in each else next(iter(each))
            left -= style[1]
            made.append(each[style])
        if left >= 0 and tuple(made) not in known:
            known.add(tuple(made))
            yield tuple(made)


def together(stocks: Stocks, layers: Sequence[tuple[Stock, tuple[str, ...]]]) -> list[Found] | None:
    """A set for each layer, those of one clear of those of all others; None where none was found.

    Args:
        stocks: Of all flexures.
        layers: Where to seek, and what.
    """

    def count(layer: int) -> int:
        stock, recipe = layers[layer]
        return sum(len(stock.candidates(kind)) for kind in set(recipe))

    order = sorted(range(len(layers)), key=count)
    found = _placed(stocks, [layers[k] for k in order], [])
    return None if found is None else [found[order.index(k)] for k in range(len(layers))]


def _placed(
    stocks: Stocks,
    layers: Sequence[tuple[Stock, tuple[str, ...]]],
    avoided: list[tuple[FloatArray, float]],
) -> list[Found] | None:
    """The same in their order, beside what is there."""
    if not layers:
        return []
    (stock, recipe), *others = layers
    sets = stocks.sets(stock, recipe)[:_SETS]
    clear = [each for each in sets if is_clear(each, avoided, stocks.sizes.clearance)]
    if sets and not clear:
        clear = stocks.sets_beside(stock, recipe, avoided)[:_SETS]
    clear = [each for each in clear if each.chosen.sigma >= _FLATTEST]
    for each in clear:
        rest = _placed(stocks, others, [*avoided, *strips_of(each)])
        if rest is not None:
            return [each, *rest]
    return None


def is_clear(found: Found, avoided: Sequence[tuple[FloatArray, float]], clearance: float) -> bool:
    """Whether the flexures of a set are clear of what is there."""
    return all(
        bool(clear_of(strips, radius, candidates.of(np.array([k])), clearance)[0])
        for candidates, k in found.chosen.members
        for strips, radius in avoided
    )


def _arrangement(bodies: Sequence[Boxes], found: Sequence[Found]) -> Arrangement:
    names = ["ground", *names_of_bodies(len(bodies)), "stage"]
    parts = tuple(Part((names[k + 1], names[k]), each) for k, each in enumerate(found))
    points = [corners_between(boxes) for boxes in bodies]
    return Arrangement(
        layers_in_words([each.recipe for each in found]),
        parts,
        tuple(zip(names[1:-1], points, strict=True)),
    )


def names_of_bodies(count: int) -> list[str]:
    """What bodies between are called."""
    return ["body"] if count == 1 else [f"body {k}" for k in range(1, count + 1)]


def layers_in_words(recipes_: Sequence[tuple[str, ...]]) -> str:
    """What layers are made of, from the ground, such as "two layers, each of five wires"."""
    each = [kinds_in_words(recipe) for recipe in recipes_]
    many = number_in_words(len(each))
    if len(set(each)) == 1:
        return f"{many} layers, each of {each[0]}"
    return f"{many} layers: {'; '.join(each)}"
