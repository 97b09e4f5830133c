# SPDX-License-Identifier: BSD-3-Clause
"""Sheets and wires that are divided and declared: a row of beams counts as one beam.

The rule: beams nearly in line are joined end to end at nodes that nothing else uses and of which
nothing is fixed or declared. Each deformation is released in one beam at most, and of one class in
the others. What is released in bending are hinges: one alone stands at the end of the row where
one beam has it, two about one axis stand at two places. Then the others only say that the row
follows its ends, and it counts as one beam between them, with the y vector of its first beam.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import numpy as np
from oracle_deck import Deck, Element
from oracle_elements import Real, frame

#: Cosine of the largest angle between neighbours, and between the planes of their sections.
IN_LINE = 0.7
#: Bendings at p and at q, by keyword.
BENDINGS = {"BEAM": (("3", "4"), ("5", "6")), "PLBEAM": (("2", "3"),)}


def with_rows_as_beams(deck: Deck) -> Deck:
    """The deck in which each row of beams that is declared as one beam is one beam."""
    uses = Counter(node for element in deck.elements.values() for node in element.nodes)
    taken = {node for (node, _), name in deck.coordinates.items() if name != "dependent"}
    inner = {node for node, times in uses.items() if times == 2} - taken
    left = [number for number, element in deck.elements.items() if _bends(deck, number, element)]
    while left:
        row = _row(deck, left, inner)
        if len(row) > 1 and (classes := _classes(deck, row)):
            deck = _as_one(deck, row, classes)
    return deck


def _bends(deck: Deck, number: int, element: Element) -> bool:
    pairs = BENDINGS.get(element.keyword, ())
    return any(deck.deformations[number, name] != "fixed" for pair in pairs for name in pair)


def _ends(element: Element, against: bool) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Position and orientation where a beam begins and where it ends, in the sense of the row."""
    ends = element.nodes[:2], element.nodes[2:]
    return ends[::-1] if against else ends


def _row(deck: Deck, left: list[int], inner: set[int]) -> list[tuple[int, bool]]:
    """Beams from end to end, each with whether it runs against the row; taken out of `left`."""
    row = [(left.pop(0), False)]
    for _ in range(2):
        # Ahead of the last one, then the whole row turned, and ahead of the first.
        while (found := _next(deck, row[-1], left, inner)) is not None:
            row.append(found)
            left.remove(found[0])
        row = [(number, not against) for number, against in reversed(row)]
    return row


def _next(
    deck: Deck, last: tuple[int, bool], left: list[int], inner: set[int]
) -> tuple[int, bool] | None:
    one = deck.elements[last[0]]
    joint = _ends(one, last[1])[1]
    for number in left:
        other = deck.elements[number]
        for against in (False, True):
            if _ends(other, against)[0] != joint or not set(joint) <= inner:
                continue
            along = _along(deck, one, last[1]) @ _along(deck, other, against)
            level = 1.0 if deck.planar else abs(_normal(deck, one) @ _normal(deck, other))
            if one.keyword == other.keyword and min(along, level) > IN_LINE:
                return number, against
    return None


def _along(deck: Deck, element: Element, against: bool) -> Real:
    (p, _), (q, _) = _ends(element, against)
    way = np.subtract(deck.position[q], deck.position[p])
    return np.array(way / np.linalg.norm(way))


def _normal(deck: Deck, element: Element) -> Real:
    return np.array(frame(_along(deck, element, False), element.vector)[:, 1])


def _classes(deck: Deck, row: list[tuple[int, bool]]) -> dict[str, str]:
    """The class of each deformation of the one beam; empty where the row is none."""
    pairs = BENDINGS[deck.elements[row[0][0]].keyword]
    other_end = {p: q for pair in pairs for p, q in (pair, pair[::-1])}
    classes, places = {}, {}
    for name in (label for number, label in deck.deformations if number == row[0][0]):
        own = [
            deck.deformations[number, other_end.get(name, name) if against else name]
            for number, against in row
        ]
        places[name] = [place for place, each in enumerate(own) if each == "dependent"]
        if len(places[name]) > 1 or len({each for each in own if each != "dependent"}) > 1:
            return {}
        classes[name] = "dependent" if places[name] else own[0]
    for p, q in pairs:
        # A hinge at the beginning of its beam, and one at the end.
        hinges = places[p] + [place + 1 for place in places[q]]
        alone = len(hinges) == 1 and hinges != ([0] if places[p] else [len(row)])
        if alone or len(set(hinges)) < len(hinges):
            return {}
    return classes


def _as_one(deck: Deck, row: list[tuple[int, bool]], classes: dict[str, str]) -> Deck:
    first, numbers = row[0][0], [number for number, _ in row]
    begin, end = (
        _ends(deck.elements[first], row[0][1])[0],
        _ends(deck.elements[numbers[-1]], row[-1][1])[1],
    )
    within = {node for number in numbers for node in deck.elements[number].nodes} - {*begin, *end}
    made = replace(deck.elements[first], nodes=(*begin, *end))
    return replace(
        deck,
        elements={
            number: made if number == first else element
            for number, element in deck.elements.items()
            if number == first or number not in numbers
        },
        kinds={node: kind for node, kind in deck.kinds.items() if node not in within},
        coordinates={k: name for k, name in deck.coordinates.items() if k[0] not in within},
        deformations={
            (number, name): classes[name] if number == first else each
            for (number, name), each in deck.deformations.items()
            if number == first or number not in numbers
        },
    )
