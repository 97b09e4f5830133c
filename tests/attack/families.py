# SPDX-License-Identifier: BSD-3-Clause
"""Decks of every family, each with its exact counts; a name, a seed and a number make one."""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction
from typing import NamedTuple

from . import families_bodies as bodies
from . import families_chains as chains
from . import families_frameworks as frameworks
from . import families_lattices as lattices
from .deck_text import (
    Style,
    exact,
    has_long_numbers,
    in_whole_numbers,
    mapped,
    quaternion,
    renumbered,
    rotation,
    style_of,
    text_of,
)
from .exact_deck import Deck, Vector, read
from .sketch import Chance, Sketch, outer, plus, vector
from .truth import Counts, counts_of

#: What may stand beside each other in one deck, by whether it is planar.
_BESIDE: dict[bool, tuple[Callable[[Chance], Sketch], ...]] = {
    True: (frameworks.desargues, chains.levers, chains.ring),
    False: (frameworks.octahedron, bodies.platform, bodies.guide, bodies.loop),
}


def pair(chance: Chance) -> Sketch:
    """Two mechanisms in one deck that share nothing, of different sizes; hairs would show in one
    and not in the other.
    """
    both = _BESIDE[chance.random() < 0.5]
    bare = Chance(chance.random())
    bare.hairless = True
    sketch, other = (chance.choice(both)(bare) for _ in range(2))
    sketch.hairy = other.hairy = False
    scale = Fraction(10) ** chance.randint(-6, 6)
    shift = frameworks.whole(chance, sketch.planar, 30)
    sketch.take_in(other, scale, shift)
    return sketch


FAMILIES: dict[str, Callable[[Chance], Sketch]] = {
    "desargues": frameworks.desargues,
    "bipartite": frameworks.bipartite,
    "octahedron": frameworks.octahedron,
    "prism": frameworks.prism,
    "lattice": frameworks.lattice,
    "grown": frameworks.grown,
    "spokes": frameworks.spokes,
    "two-wires": chains.two_wires,
    "long-digits": chains.long_digits,
    "collinear": chains.collinear,
    "graded": chains.graded,
    "staircase": chains.staircase,
    "mirrored": chains.mirrored,
    "levers": chains.levers,
    "ring": chains.ring,
    "polygon": chains.polygon,
    "platform": bodies.platform,
    "guide": bodies.guide,
    "cranks": bodies.cranks,
    "loop": bodies.loop,
    "mixed": bodies.mixed,
    "far-whole": bodies.far_whole,
    "ties": lattices.ties,
    "joints": lattices.joints,
    "hinged": lattices.hinged,
    "units": lattices.units,
    "pair": pair,
}
#: Points that are this close, as a part of their distance from the origin, are one point.
_ONE_POINT = 1e-15
#: A vector whose sine with its chord is below this gives no direction.
_PARALLEL = 1e-12
_ATTEMPTS = 100
#: A hair that is not this many units of the last digit is not seen.
_SEEN = 100.0


class Case(NamedTuple):
    """A deck with its exact counts."""

    name: str
    text: str
    typed: Counts
    """Of its digits as they are."""
    meant: Counts | None
    """Of what they stand for, where that is known."""
    digits: float
    """Digits of its largest number; endless where nothing was rounded."""
    alike: tuple[str, ...] = ()
    """The same in other units, moved by decimals."""

    @property
    def truths(self) -> tuple[Counts, ...]:
        """Counts that may be called certain."""
        return (self.typed,) if self.meant is None else (self.typed, self.meant)


def case_of(family: str, seed: int, number: int) -> Case:
    """One deck of a family, always the same."""
    name = f"{family}-{seed}-{number}"
    chance = Chance(name)
    for _ in range(_ATTEMPTS):
        start = chance.getstate()
        drawn = _drawn(family, chance, may_be_whole=True)
        text = text_of(drawn.shown, drawn.style)
        typed = read(text)
        if not _is_sound(typed) or (has_long_numbers(text) and not drawn.sketch.long):
            continue
        if drawn.sketch.hairy and drawn.style.digits < math.inf:
            end = chance.getstate()
            drawn = _without_hair(family, drawn, start)
            chance.setstate(end)
        alike = tuple(
            _moved(drawn.shown, unit, chance) for unit in drawn.sketch.alike * lattices.UNITS
        )
        return Case(name, text, counts_of(typed), _meant(drawn), drawn.style.digits, alike)
    raise RuntimeError(f"{name}: no deck that is sound")


class _Drawn(NamedTuple):
    sketch: Sketch
    deck: Deck
    """Exact, before anything is rounded."""
    shown: Deck
    """The same with the numbers that it is typed with."""
    style: Style


def _drawn(family: str, chance: Chance, may_be_whole: bool) -> _Drawn:
    """A sketch turned, scaled, moved and renumbered."""
    sketch = FAMILIES[family](chance)
    deck, style = sketch.deck, Style(exact, exact, math.inf)
    wanted = chance.random() < 0.25
    whole = in_whole_numbers(deck) if wanted and may_be_whole else None
    if whole is not None and not sketch.plain:
        deck = whole
    elif not sketch.plain:
        deck = _placed(deck, chance)
        style = style_of(deck, chance)
    shown = renumbered(deck, chance) if chance.random() < 0.5 else deck
    return _Drawn(sketch, deck, shown, style)


def _without_hair(family: str, drawn: _Drawn, start: object) -> _Drawn:
    """What is meant: the deck without its hair, where that is too thin to be seen."""
    chance = Chance()
    chance.setstate(start)  # type: ignore[arg-type]
    chance.hairless = True
    other = _drawn(family, chance, may_be_whole=False)
    if other.deck.places.keys() != drawn.deck.places.keys():
        return drawn
    seen = _SEEN * 10.0**-drawn.style.digits
    return drawn if _difference(drawn.deck, other.deck) > seen else other


def _difference(deck: Deck, other: Deck) -> float:
    """How far two decks are apart, as a part of their coordinates or of a direction's."""
    places = [each for node in deck.places for each in deck.place(node)]
    others = [each for node in deck.places for each in other.place(node)]
    pairs = [(places, others)]
    for number, element in deck.elements.items():
        of_other = other.elements.get(number, element).vector
        if element.vector is not None and of_other is not None:
            pairs.append((list(element.vector), list(of_other)))
    return max(
        float(max(abs(a - b) for a, b in zip(these, those, strict=True)) / max(map(abs, these)))
        for these, those in pairs
        if any(these)
    )


def _meant(drawn: _Drawn) -> Counts | None:
    if drawn.sketch.meant is not None:
        return drawn.sketch.meant
    return counts_of(drawn.deck) if _is_sound(drawn.deck) else None


def _placed(deck: Deck, chance: Chance) -> Deck:
    """Turned, in other units and far from the origin, each by some chance."""
    kind = chance.random()
    turn: Callable[[Vector], Vector] = vector
    if kind > 0.45:
        turn = rotation(quaternion(chance, deck.planar, plain=kind < 0.65))
    scale = Fraction(10) ** (chance.randint(-9, 9) if chance.random() < 0.4 else 0)
    shift: Vector = vector((0, 0, 0))
    if chance.random() < 0.2:
        far = Fraction(10) ** chance.randint(3, 9)
        side = frameworks.direction(chance, deck.planar)
        shift = plus(shift, side, far)
    return mapped(deck, lambda place: plus((0, 0, 0), plus(turn(place), shift), scale), turn)


def _moved(deck: Deck, unit: Fraction, chance: Chance) -> str:
    """In another unit, and shifted by decimals."""
    shift = vector(Fraction(chance.randint(-999, 999), 100) for _ in range(3))
    if deck.planar:
        shift = vector(shift[:2])
    moved = mapped(deck, lambda place: plus((0, 0, 0), plus(place, shift), unit), lambda v: v)
    return text_of(moved, Style(exact, exact, math.inf))


def _is_sound(deck: Deck) -> bool:
    """Whether no element has lost its length or its frame to the digits."""
    for element in deck.elements.values():
        if element.keyword in ("HINGE", "BEARING") and not any(map(float, element.vector or ())):
            return False
        if element.keyword == "PINBODY" or "p" not in element.kind.slots:
            continue
        reach = max(_size(deck.place(node)) for node in element.positions)
        chord = deck.chord(element)
        if element.keyword != "BEARING" and _size(chord) <= _ONE_POINT * reach:
            return False
        v = element.vector
        if element.keyword in ("BEAM", "RBEAM") and v is not None:
            across = _size(outer(chord, v))
            if across <= _PARALLEL * _size(chord) * _size(v):
                return False
    return True


def _size(v: Vector) -> float:
    return max(abs(float(part)) for part in v)
