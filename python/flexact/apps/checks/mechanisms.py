# SPDX-License-Identifier: BSD-3-Clause
"""Decks of mechanisms of any size whose counts follow from how they are made."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple


class Mechanism(NamedTuple):
    """A deck, and what its construction says of it."""

    name: str
    deck: bytes
    motions: int
    self_stresses: int


#: Between neighbouring stages, the length of a leaf of a folded sheet, and a step in height [m].
_PITCH, _LEAF, _HEIGHT = 0.3, 0.1, 0.02
#: Steps of the lattice of bars [m]: no two are at right angles, so that all is coupled.
_STEPS = ((1.0, 0.2, 0.1), (0.1, 1.0, 0.2), (0.2, 0.1, 1.0))


def stages(side: int) -> Mechanism:
    """An array of `side` by `side` stages on folded sheets, exactly constrained.

    Three folded sheets from the ground hold a stage along z, so that it is left in its plane.
    There a link to the neighbour on the left holds it along x and against rotation, and one to the
    neighbour below along y; the first ones are held by the ground. Stage after stage, six
    constraints hold six coordinates. What a folded sheet can do inside is declared.
    """
    deck = _Deck()
    ground = {}
    centre = {(i, j): deck.point(_at(i, j)) for i in range(side) for j in range(side)}
    for k in range(side):
        ground[-1, k] = deck.point(_at(-1, k), held=True)
        ground[k, -1] = deck.point(_at(k, -1), held=True)
    for (i, j), here in centre.items():
        x, y, z = _at(i, j)
        for dx, dy in ((1.0, 0.0), (-0.5, 0.8660254), (-0.5, -0.8660254)):
            fold = deck.point((x + _LEAF * dx, y + _LEAF * dy, z))
            foot = (x + _LEAF * (dx - dy), y + _LEAF * (dy + dx), z)
            along, across = (-dy, dx, 0.0), (dx, dy, 0.0)
            deck.beam(deck.point(foot, held=True), fold, across, "2 5", "6")
            deck.beam(fold, here, along, "2 5 6")
        beside = centre.get((i - 1, j)) or ground[i - 1, j]
        below = centre.get((i, j - 1)) or ground[i, j - 1]
        deck.beam(beside, here, (0.0, 1.0, 0.0), "2 3 4 5")
        deck.beam(below, here, (1.0, 0.0, 0.0), "2 3 4 5 6")
    return Mechanism(f"{side * side} stages on folded sheets", deck.text(), 0, 0)


def bars(side: int) -> Mechanism:
    """A skew lattice of bars with `side`^3 joints, one motion and one self-stress.

    Three bars hold each joint to the one before it in each direction, and to the ground at the
    first ones. One bar is left out at the last joint, a motion; and one more joins two joints that
    are held already, a self-stress.
    """
    lines: list[str] = []
    number = {index: node for node, index in enumerate(_indices(side), start=1)}
    rest: list[str] = []
    for index, node in number.items():
        rest.append(f"X {node} {_place(index)}")
        if min(index) < 0:
            rest.append(f"FIX {node}")
            continue
        for axis in range(3):
            i, j, k = index
            before = (i - (axis == 0), j - (axis == 1), k - (axis == 2))
            if not (axis == 2 and index == (side - 1,) * 3):
                lines.append(f"TRUSS {len(lines) + 1} {number[before]} {node}")
    one, other = number[0, 0, 0], number[1, 1, 0]
    lines.append(f"TRUSS {len(lines) + 1} {one} {other}")
    text = "\n".join([*lines, *rest, "END", "END", ""])
    return Mechanism(f"{side**3} joints on bars", text.encode(), 1, 1)


def _at(i: int, j: int) -> tuple[float, float, float]:
    """Where a stage is; no two neighbours at one height, so that links couple all their motions."""
    return _PITCH * i, _PITCH * j, _HEIGHT * ((2 * i + 3 * j) % 5)


def _indices(side: int) -> Iterator[tuple[int, int, int]]:
    """Joints of the lattice, and those on the ground before its first ones."""
    for i in range(-1, side):
        for j in range(-1, side):
            for k in range(-1, side):
                if sum(c < 0 for c in (i, j, k)) <= 1:
                    yield i, j, k


def _place(index: tuple[int, int, int]) -> str:
    return " ".join(
        repr(sum(c * step[axis] for c, step in zip(index, _STEPS, strict=True)))
        for axis in range(3)
    )


class _Deck:
    """A deck of beams between points, in the making."""

    def __init__(self) -> None:
        self._elements: list[str] = []
        self._rest: list[str] = []
        self._nodes = 0

    def point(self, place: tuple[float, float, float], held: bool = False) -> tuple[int, int]:
        """A place with its orientation: the numbers of the two nodes."""
        position, orientation = self._nodes + 1, self._nodes + 2
        self._nodes = orientation
        self._rest.append(f"X {position} {place[0]!r} {place[1]!r} {place[2]!r}")
        if held:
            self._rest += [f"FIX {position}", f"FIX {orientation}"]
        return position, orientation

    def beam(
        self,
        p: tuple[int, int],
        q: tuple[int, int],
        y: tuple[float, float, float],
        released: str,
        declared: str = "",
    ) -> None:
        """A beam from point to point, with its local y, and what it releases and declares."""
        e = len(self._elements) + 1
        words = " ".join(map(repr, y))
        self._elements.append(f"BEAM {e} {p[0]} {p[1]} {q[0]} {q[1]} {words}")
        self._rest.append(f"RLSE {e} {released}")
        if declared:
            self._rest.append(f"DYNE {e} {declared}")

    def text(self) -> bytes:
        """The deck."""
        return "\n".join([*self._elements, *self._rest, "END", "END", ""]).encode()


#: By the word that a measurement has.
FAMILIES: dict[str, Callable[[int], Mechanism]] = {"stages": stages, "bars": bars}
