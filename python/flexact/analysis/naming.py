# SPDX-License-Identifier: BSD-3-Clause
"""Nodes, coordinates and deformations as they are named in text."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from ..core.elements import Dual, dual_table
from ..util.groups import grouped
from ..util.text import TIE, USUAL, number_in_words, wrapped
from .decomposition import Decomposition
from .freedoms import Freedom
from .places import deformation_words, node_words, part_words
from .ways import Coordinate, Part

_INDENT = "     "
#: How many names and runs of names stand together.
_MOST_TOGETHER = 11
#: Numbers of more digits are names.
_DIGITS = 10
#: Nouns that stand in the plural where names of parts are put together.
_NOUNS = frozenset(
    (
        *("sheet", "wire", "bar", "beam", "hinge", "joint", "strut", "arm", "leg", "link", "guide"),
        *("blade", "vee", "contact", "limb", "notch", "rod", "flexure", "spring", "spoke"),
        *("crank", "ring", "clamp", "stage"),
    )
)
in_words = number_in_words


class Named(NamedTuple):
    """An element or a node that a text names."""

    kind: str
    """"element" or "node"."""
    number: int
    words: str
    """What it is called, such as "sheet 1" or "the stage"."""

    def __str__(self) -> str:
        """The words."""
        return self.words


Piece = str | Named
#: Words that follow each other without further blanks.
Pieces = tuple[Piece, ...]


class Line(NamedTuple):
    """A sentence, or the start of one and what it lists."""

    head: Pieces
    items: tuple[Pieces, ...] = ()
    notes: tuple[str, ...] = ()
    """What stands behind the first items, as many as there are."""
    more: bool = False
    """Whether there are more items than these."""

    def shortened(self, most: int) -> Line:
        """The line with its first items."""
        return self._replace(items=self.items[:most], more=self.more or len(self.items) > most)

    def listed(self) -> tuple[tuple[Pieces, str], ...]:
        """The items, each with what stands behind it."""
        behind = [f" {note}" if note else "" for note in self.notes]
        behind += [""] * (len(self.items) - len(behind))
        return tuple(zip(self.items, behind, strict=False))


def line_of(*pieces: Piece) -> Line:
    """A line without items."""
    return Line(pieces)


def plain(pieces: Iterable[Piece]) -> str:
    """The pieces as text."""
    return "".join(map(str, pieces))


def begun(pieces: Pieces) -> Pieces:
    """The pieces with a capital first letter, as a sentence begins."""
    for place, piece in enumerate(pieces):
        if words := str(piece):
            capital: Piece = words[:1].upper() + words[1:]
            if isinstance(piece, Named):
                capital = piece._replace(words=str(capital))
            return (*pieces[:place], capital, *pieces[place + 1 :])
    return pieces


def ended(pieces: Pieces) -> Pieces:
    """The pieces with a full stop at their end, in place of the mark that is there."""
    if not pieces:
        return pieces
    last = pieces[-1]
    if isinstance(last, Named):
        return (*pieces, ".")
    return (*pieces[:-1], last.rstrip(" .:;") + ".")


def sentence_of(pieces: Pieces) -> Pieces:
    """The pieces from a capital letter to a full stop; nothing where there are no words."""
    return ended(begun(pieces)) if plain(pieces).strip() else ()


def in_a_row(sentences: Iterable[Pieces]) -> str:
    """Sentences behind each other, as text."""
    return " ".join(filter(None, map(plain, sentences)))


def row_of(items: Sequence[Pieces], most: int | None = None, last: str = "and") -> Pieces:
    """Items such as "a, b and c"; of more than `most` the first, and how many more there are."""
    shown = list(items[:most])
    if len(items) > len(shown):
        shown.append((f"{len(items) - len(shown)} more",))
    made: list[Piece] = []
    for k, item in enumerate(shown):
        made += [""] if not k else [f" {last} "] if k == len(shown) - 1 else [", "]
        made += item
    return tuple(piece for piece in made if piece)


def together_in_words(
    parts: Sequence[Named], most: int = _MOST_TOGETHER, last: str = "and"
) -> Pieces:
    """Names, such as "sheets 2, 4 and 6" or "left arms 2 to 6"; of many without a number the first.

    Numbers of names that begin alike are put together.
    """
    heads = grouped((part.words.rpartition(" ")[::2], part) for part in parts)
    by_head = grouped((head, (number, mine[0])) for (head, number), mine in heads.items())
    items: list[Pieces] = []
    for head, numbered in by_head.items():
        numbers = [
            int(n) if n.isascii() and n.isdigit() and len(n) < _DIGITS else -1 for n, _ in numbered
        ]
        if len(numbers) == 1 or min(numbers) < 0 or not _plural(head):
            items += [(part,) for _, part in numbered]
            continue
        runs = grouped((n - k, k) for k, n in enumerate(numbers))
        ends: list[Pieces] = []
        for run in runs.values():
            short = [numbered[k][1]._replace(words=numbered[k][0]) for k in run]
            ends += [(short[0], " to ", short[-1])] if len(run) > 2 else [(each,) for each in short]
        items.append((f"{_plural(head)} ", *row_of(ends, last=last)))
    return row_of(items, most, last)


def _plural(head: str) -> str:
    """Of a name that ends with what parts are called; empty of others, such as "lower"."""
    noun = head.rpartition(" ")[2]
    return head + ("es" if noun.endswith("ch") else "s") if noun in _NOUNS else ""


def _tied(words: str, width: int) -> str:
    """Words that are not to be torn apart, unless they are longer than a row."""
    return words.replace(" ", TIE) if len(words) < width - 2 * len(_INDENT) else words


def filled(line: Line, *, hanging: bool = False, width: int = USUAL) -> str:
    """A line as text in rows of a width; items are not torn apart.

    Further rows are indented where there are items, or where they are to hang.
    """
    items = [
        _tied(plain(item), width) + note[:1] + _tied(note[1:], width)
        for item, note in line.listed()
    ]
    text = plain(line.head) + "; ".join(items + ["..."] * line.more)
    return wrapped(text, width, _INDENT if line.items or hanging else "")


_LENGTHS = ((1.0, "m"), (1.0e-3, "mm"), (1.0e-6, "um"), (1.0e-9, "nm"))
_ANGLES = ((1.0, "rad"), (1.0e-3, "mrad"), (1.0e-6, "urad"), (1.0e-9, "nrad"))


def length_in_words(length: float) -> str:
    """A length [m] in two digits, such as "12 um"."""
    return _in_words(length, _LENGTHS)


def angle_in_words(angle: float) -> str:
    """An angle [rad] in two digits, such as "0.2 mrad"."""
    return _in_words(angle, _ANGLES)


def _in_words(size: float, units: tuple[tuple[float, str], ...]) -> str:
    # Rounded before the unit is chosen: 999.7 um are 1 mm.
    rounded = float(f"{size:.2g}")
    factor, unit = next((each for each in units if rounded >= each[0]), units[-1])
    return f"{rounded / factor:.4g} {unit}"


def part_in_words(result: Decomposition, part: Part) -> Pieces:
    """A coordinate or a deformation."""
    if isinstance(part, Coordinate):
        return coordinate_in_words(result, part.node, part.name)
    return deformation_in_words(result, part.element, part.number)


def coordinate_in_words(result: Decomposition, node: int, name: str) -> Pieces:
    """A coordinate of a node: such as "the stage along y" or "clamp 1 about x".

    Args:
        result: The result.
        node: Number of the node.
        name: Such as "y" or "rx".
    """
    way = f" about {name[1:]}" if name.startswith("r") else f" along {name}"
    return (named_node(result, node), way)


def named_node(result: Decomposition, node: int) -> Named:
    """A node by its number, and by its body, the name of its point, or what is there."""
    return Named("node", node, node_words(result.parts, result.parts.data.node_index[node]))


def node_name(result: Decomposition, index: int) -> str:
    """The name of the point of a node, by its index in `result.data`; empty without one."""
    place = result.parts.place_of(int(result.condensed.nodes[index]))
    return "" if place is None else result.parts.name_of_point(place)


def named_element(result: Decomposition, element: int) -> Named:
    """An element by its number, and by the name of its part."""
    part = result.parts.of_element(result.given.element_index[element])
    return Named("element", element, part_words(part))


def deformation_in_words(result: Decomposition, element: int, number: int) -> Pieces:
    """Deformation `number` of an element, both as a deck numbers them.

    Such as "sheet 1: in-plane bending at its clamp".
    """
    word = deformation_words(result, result.data.element_index[element], number)
    return (named_element(result, element), f": {word}")


def freedom_in_words(freedom: Freedom) -> Pieces:
    """A declared degree of freedom, such as "the stage along z"."""
    result, (kind, number) = freedom.analysis, freedom.owner
    if kind == "node":
        return coordinate_in_words(result, number, freedom.part)
    return deformation_in_words(result, number, freedom.place[0] + 1)


def motion_in_words(result: Decomposition, number: int, freedom: Freedom | None) -> str:
    """Which motion it is: one that nothing determines, or that of a declared freedom."""
    if freedom is None:
        return f"motion {number} of {result.under_constrained}"
    return f"degree of freedom {number}, {plain(freedom_in_words(freedom))}"


def unit_of(result: Decomposition, element: int, number: int) -> str:
    """The unit of the stress resultant of a deformation: N or N m."""
    kind = result.data.arrays.element_kind[result.data.element_index[element]]
    return "N" if dual_table()[kind, number - 1] == Dual.FORCE else "N m"


def unit_of_coordinate(name: str) -> str:
    """The unit of a coordinate of this name: m or rad."""
    return "rad" if name.startswith("r") else "m"


def counted(count: int, word: str, one: str, many: str) -> str:
    """A number and the word for what is counted, with its ending."""
    return f"{count} {word}{one if count == 1 else many}"


def counts_in_words(under: int, over: int) -> str:
    """By how much a mechanism is under- and over-constrained."""
    parts = [f"under-constrained by {under}"] * (under > 0)
    parts += [f"over-constrained by {over}"] * (over > 0)
    return " and ".join(parts) or "exactly constrained"
