# SPDX-License-Identifier: BSD-3-Clause
"""Mechanisms of the gallery and sample decks, as they are and with one or two things changed."""

from __future__ import annotations

import random
import runpy
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

from flexact.core.elements import element_kinds, is_position

ROOT = Path(__file__).resolve().parents[2]
_FOLDERS = ("flexures", "frameworks", "linkages", "paper")
#: Numbers of ESTIFF and EM, of an element that bends as a steel sheet or wire does.
_STIFFNESS = {
    "BEAM": "4E5 0.5 0.02 8.0",
    "PLBEAM": "4E5 0.02",
    "TRUSS": "4E5",
    "PLTRUSS": "4E5",
    "HINGE": "2.5 4E3 4E3",
    "PLHINGE": "2.5",
    "BEARING": "1E6 1E6 1E6 2.5 4E3 4E3",
}
_MASS = {"BEAM": "0.05 1E-6", "PLBEAM": "0.05", "TRUSS": "0.05", "PLTRUSS": "0.05", "RBEAM": "0.1"}
#: Kinds of the nodes behind the number of an element.
_SLOTS = {kind.keyword: [slot for slot in kind.slots if slot] for kind in element_kinds()}


class Deck:
    """The statements of a deck, as words."""

    def __init__(self, text: str) -> None:
        """Those that an analysis uses."""
        blocks: list[list[list[str]]] = [[], []]
        block = 0
        for line in text.splitlines():
            words = line.partition("%")[0].split()
            if words and words[0].upper() == "END":
                block += 1
            elif words and words[0].upper() != "HALT" and block < len(blocks):
                blocks[block].append(words)
        self.kinematics, self.dynamics = blocks

    @property
    def elements(self) -> dict[str, list[str]]:
        """Statements of elements by their numbers."""
        found = [words for words in self.kinematics if words[0] in _SLOTS]
        return {words[1]: words for words in found}

    def said(self, *keywords: str) -> list[list[str]]:
        """Statements of a keyword."""
        return [words for words in self.kinematics if words[0] in keywords]

    @property
    def nodes(self) -> dict[str, int]:
        """The kind of each node."""
        every = self.elements.values()
        return {
            node: kind
            for words in every
            for node, kind in zip(words[2:], _SLOTS[words[0]], strict=False)
        }

    def prune(self) -> None:
        """Take away what is said of elements and nodes that are not there."""
        elements, nodes = self.elements, self.nodes
        about = {"RLSE": elements, "DYNE": elements, "ESTIFF": elements, "EM": elements}
        for block in (self.kinematics, self.dynamics):
            block[:] = [
                words
                for words in block
                if words[0] in _SLOTS or len(words) < 2 or words[1] in about.get(words[0], nodes)
            ]

    @property
    def text(self) -> str:
        """The deck."""
        parts = (self.kinematics, [["END"], ["HALT"]], self.dynamics, [["END"], ["END"]])
        return "".join(f"{' '.join(words)}\n" for part in parts for words in part)


def _without_member(deck: Deck, dice: random.Random) -> None:
    deck.kinematics.remove(deck.elements[dice.choice(list(deck.elements))])
    deck.prune()


def _with_member(deck: Deck, dice: random.Random) -> None:
    planar = any(key.startswith("PL") for key in {words[0] for words in deck.kinematics})
    places = [node for node, kind in deck.nodes.items() if is_position(kind)]
    if len(places) > 1:
        number = str(1 + max(map(int, deck.elements)))
        bar = ["PLTRUSS" if planar else "TRUSS", number, *dice.sample(places, 2)]
        deck.kinematics.insert(0, bar)


def _without(*keywords: str) -> Callable[[Deck, random.Random], None]:
    def change(deck: Deck, dice: random.Random) -> None:
        if found := deck.said(*keywords):
            deck.kinematics.remove(dice.choice(found))

    return change


def _with_declaration(deck: Deck, dice: random.Random) -> None:
    held = {words[1] for words in deck.said("FIX", "DYNX")}
    if free := sorted(n for n, kind in deck.nodes.items() if is_position(kind) and n not in held):
        deck.kinematics.append(["DYNX", dice.choice(free), dice.choice("12")])


def _with_support(deck: Deck, dice: random.Random) -> None:
    said = {words[1] for words in deck.said("FIX", "DYNX")}
    if free := sorted(set(deck.nodes) - said):
        deck.kinematics.append(["FIX", dice.choice(free)])


def _without_property(*keywords: str) -> Callable[[Deck, random.Random], None]:
    def change(deck: Deck, _: random.Random) -> None:
        deck.dynamics[:] = [words for words in deck.dynamics if words[0] not in keywords]

    return change


def _with_stiffness(deck: Deck, dice: random.Random) -> None:
    """Of all flexures: of rigid bodies nothing is said, as designers do."""
    soft = {words[1] for words in deck.said("RLSE", "DYNE")}
    _give(deck, "ESTIFF", _STIFFNESS, soft or set(deck.elements))


def _with_stiffness_of_all(deck: Deck, dice: random.Random) -> None:
    _give(deck, "ESTIFF", _STIFFNESS, set(deck.elements))


def _with_mass(deck: Deck, dice: random.Random) -> None:
    _give(deck, "EM", _MASS, set(deck.elements))
    _with_one_mass(deck, dice)


def _with_one_mass(deck: Deck, dice: random.Random) -> None:
    places = [words[1] for words in deck.said("X")]
    if places:
        deck.dynamics.append(["XM", dice.choice(places), "0.2"])


def _give(deck: Deck, keyword: str, numbers: dict[str, str], wanted: set[str]) -> None:
    said = {words[1] for words in deck.dynamics if words[0] == keyword}
    for number, words in deck.elements.items():
        if number in wanted - said and words[0] in numbers:
            deck.dynamics.append([keyword, number, *numbers[words[0]].split()])


#: What is changed, by its name.
CHANGES: dict[str, Callable[[Deck, random.Random], None]] = {
    "a member less": _without_member,
    "a member more": _with_member,
    "a declaration less": _without("DYNX", "DYNE"),
    "a declaration more": _with_declaration,
    "a support less": _without("FIX"),
    "a support more": _with_support,
    "a release less": _without("RLSE"),
    "no stiffness": _without_property("ESTIFF"),
    "stiffness of flexures": _with_stiffness,
    "stiffness of all": _with_stiffness_of_all,
    "no mass": _without_property("EM", "XM"),
    "mass of all": _with_mass,
    "one mass": _with_one_mass,
}
#: Changes two at a time: what is stiff or heavy, and is not held as it was meant to be.
_TOPOLOGY, _PROPERTIES = list(CHANGES)[:7], list(CHANGES)[7:]
PAIRS = 4


@cache
def sources() -> dict[str, str]:
    """Decks by their names, those of the gallery as their models write them."""
    made = {}
    for path in sorted((ROOT / "docs" / "gallery").glob("*.py")):
        made[path.stem] = runpy.run_path(str(path))["model"].to_deck()
    for folder in _FOLDERS:
        for path in sorted((ROOT / "input_decks" / folder).glob("*.dat")):
            made[f"{folder}/{path.stem}"] = path.read_text("utf-8")
    return made


def mechanisms(seed: int) -> Iterator[tuple[str, str]]:
    """Names and decks: each source as it is, with every change, and with some pairs of changes."""
    for source, text in sources().items():
        yield source, text
        dice = random.Random(f"{seed} {source}")
        pairs = [(dice.choice(_TOPOLOGY), dice.choice(_PROPERTIES)) for _ in range(PAIRS)]
        seen = {Deck(text).text}
        for changes in (*((each,) for each in CHANGES), *pairs):
            deck = Deck(text)
            for each in changes:
                CHANGES[each](deck, dice)
            if deck.elements and deck.text not in seen:
                seen.add(deck.text)
                yield f"{source}, {' and '.join(changes)}", deck.text
