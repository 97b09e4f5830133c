# SPDX-License-Identifier: BSD-3-Clause
"""A model in the deck language, and what a deck states that its model does not keep."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from ..core.arrays import BoolArray, FloatArray, IntArray
from ..core.elements import AXES, Class, NodeKind, element_kinds, keywords_of
from ..core.raw import Meaning
from ..deck.keywords import GRAVITY as GRAVITY_MEANT
from ..deck.keywords import VALUE, Block, of_element, of_node
from ..deck.tokens import ELEMENT, GRAVITY, UNITS, DeckComments, comments_of, tokens_of
from ..util.groups import grouped
from .data import OF_ELEMENTS, Appearance, CrossSection, ModelData, rows_of
from .names import one_line

_IDENTITY = {
    NodeKind.ANGLE: [0.0, 0.0, 0.0, 0.0],
    NodeKind.ORIENTATION: [1.0, 0.0, 0.0, 0.0],
}
#: Component of axis 0 by kind of node, less that axis: lambda1 is component 2.
FIRST_COMPONENT = {
    NodeKind.PLANAR_POSITION: 1,
    NodeKind.POSITION: 1,
    NodeKind.ANGLE: -1,
    NodeKind.ORIENTATION: 2,
}


def deck_of(data: ModelData) -> str:
    """The deck of a model; numbers read back to the last bit.

    Comments of the deck that it was read from stay with their statements.
    """
    origin = data.source or data.began_as
    comments = comments_of(origin)
    beside = comments.beside
    # What a file is called does not stand in it.
    title = one_line(data.name) if origin is None else ""
    appearance, numbers = data.given_appearance, data.arrays.element_number
    picture = [] if appearance is None else [*_picture(data, appearance, numbers)]
    if appearance is not None and appearance.body_shape.any() and len(picture) == _HEAD:
        # Decks have no word for as what bodies are drawn.
        picture = []
    dynamics = dynamics_of(data, comments)
    blocks = (
        beside(UNITS, [(0, f"UNITS {data.units.name}")] if data.units.power else []),
        [f"% {title}"] if title else comments.top,
        *(beside(*each) for each in _kinematics(data, comments)),
        comments.end,
        ["END"],
        [] if dynamics or picture else comments.rest,
        ["HALT", *dynamics, *comments.rest, "END"] if dynamics or picture else [],
        picture,
    )
    return "\n".join(line for block in blocks for line in block) + "\n"


#: Their keywords, in the order of `OF_ELEMENTS`.
_OF_ELEMENTS = "ESTIFF", "EM", "STRENGTH", "EXPANSION", "FILLET"
#: A line of a statement, and the number of its element or node.
_Statements = Iterator[tuple[int, str]]


def statements_of(data: ModelData) -> Iterator[tuple[tuple[str, int], str]]:
    """What a deck says of the kinematics: keyword and number, and the statement."""
    for keyword, statements in _kinematics(data, DeckComments()):
        for number, statement in statements:
            yield (keyword, number), statement


def _kinematics(data: ModelData, comments: DeckComments) -> Iterator[tuple[str, _Statements]]:
    """The statements of the kinematics by keyword, in the order of a deck."""
    yield ELEMENT, _elements(data)
    yield "X", _values(data, comments)
    a = data.arrays
    first = np.array([0, *(FIRST_COMPONENT[kind] for kind in NodeKind)], np.int32)[a.node_kind]
    nodes = a.node_number, a.coordinate_class, first
    elements = a.element_number, a.deformation_class, np.ones(a.element_number.size, np.int32)
    for keyword, owners, wanted in (
        ("FIX", nodes, Class.FIXED),
        ("DYNX", nodes, Class.INDEPENDENT),
        ("RLSE", elements, Class.DEPENDENT),
        ("DYNE", elements, Class.INDEPENDENT),
    ):
        yield keyword, _classes(*owners, keyword, wanted)


def _typed(data: ModelData, values: Iterable[float], units: Iterable[str]) -> str:
    """Numbers of some SI units in those of the deck."""
    return " ".join(map(data.units.typed, values, units))


def _units_of(meanings: Iterable[Meaning]) -> list[str]:
    """As `Units` has them."""
    return [each.unit.replace("^", "") for each in meanings]


def _elements(data: ModelData) -> _Statements:
    a = data.arrays
    numbers = np.concatenate([np.zeros(1, np.int32), a.node_number])
    for keyword, number, nodes, vector, name in zip(
        keywords_of(a.element_kind),
        a.element_number.tolist(),
        numbers[a.element_node].T.tolist(),
        a.element_vector.T.tolist(),
        data.element_names,
        strict=True,
    ):
        words = [keyword, str(number), *(str(node) for node in nodes if node)]
        if any(vector):
            words += map(repr, vector)
        if name:
            words.append(f"% {name}")
        yield number, " ".join(words)


def _values(data: ModelData, comments: DeckComments) -> _Statements:
    a = data.arrays
    for number, kind, value, name in zip(
        a.node_number.tolist(),
        a.node_kind.tolist(),
        a.node_value.T.tolist(),
        data.node_names,
        strict=True,
    ):
        if name or value != _IDENTITY.get(kind) or ("X", number) in comments.before:
            line = f"X {number} {_typed(data, value, _units_of(VALUE[kind]))}"
            yield number, f"{line} % {name}" if name else line


def _classes(
    numbers: IntArray, classes: IntArray, first: IntArray, keyword: str, wanted: Class
) -> _Statements:
    """Statements of a class of nodes or elements, whose parts count from `first` of each."""
    chosen = classes == wanted
    for index in np.flatnonzero(chosen.any(axis=0)).tolist():
        parts = np.flatnonzero(chosen[:, index]) + first[index]
        number = int(numbers[index])
        words = [keyword, str(number)]
        if parts.size < np.count_nonzero(classes[:, index]):
            words += map(str, parts.tolist())
        yield number, " ".join(words)


def dynamics_of(data: ModelData, comments: DeckComments) -> list[str]:
    """The statements of stiffness, mass and loads, with their comments."""
    given, loads = data.properties, data.loads
    elements, nodes = data.arrays.element_number, data.arrays.node_number
    tables: list[tuple[str, IntArray, Iterable[tuple[int, tuple[float, ...]]]]] = []
    if given is not None:
        tables += [
            (keyword, elements, rows_of(getattr(given, name)))
            for keyword, name in zip(_OF_ELEMENTS, OF_ELEMENTS, strict=True)
        ]
        tables.append(("XM", nodes, rows_of(given.node_mass)))
    if loads is not None:
        tables += [
            ("XF", nodes, _loads(data, loads.force)),
            ("DELXF", nodes, _loads(data, loads.increment)),
        ]
    kinds = element_kinds()
    made: list[str] = []
    for keyword, numbers, rows in tables:
        statements = []
        for i, row in rows:
            if numbers is elements:
                meant = of_element(keyword, kinds[data.arrays.element_kind[i] - 1])
            else:
                meant = of_node(keyword, int(data.arrays.node_kind[i]))
            number, units = int(numbers[i]), _units_of(meant)
            # Of numbers that mean nothing, or are too many, nothing is known.
            units += [""] * (len(row) - len(units))
            statements.append((number, f"{keyword} {number} {_typed(data, row, units)}"))
        made += comments.beside(keyword, statements)
    if loads is not None and loads.gravity.any():
        gravity = loads.gravity[: 2 if data.planar else 3].tolist()
        said = f"GRAVITY {_typed(data, gravity, _units_of(GRAVITY_MEANT))}"
        made += comments.beside(GRAVITY, [(0, said)])
    return made


def _loads(data: ModelData, table: FloatArray) -> Iterator[tuple[int, tuple[float, ...]]]:
    """Index and components of each node with a load, as many as it has coordinates."""
    for i in np.flatnonzero(table.any(axis=1)).tolist():
        axes = AXES[int(data.arrays.node_kind[i])]
        yield i, tuple(table[i, list(axes)].tolist())


#: How many numbers of elements stand in a line of the picture block.
_NUMBERS_A_LINE = 16
#: Lines of a picture block in which nothing is said.
_HEAD = 2


def _picture(data: ModelData, appearance: Appearance, numbers: IntArray) -> Iterator[str]:
    """The picture block; elements that look alike share their options."""
    yield from ("", "VISUALIZATION")
    for name, options in (
        ("BEAMPROPS", _cross_sections(data, appearance)),
        ("GRAPHICS", _colours(appearance)),
    ):
        pairs = zip(options, numbers.tolist(), strict=True)
        alike = grouped((lines, number) for lines, number in pairs if lines)
        for lines, elements in alike.items():
            # Without numbers a group is all elements.
            all_of_them = len(elements) == numbers.size
            for line in [name] if all_of_them else _in_lines(name, elements):
                yield line
                yield from lines
    yield from _in_lines("DONOTDRAW", numbers[~appearance.drawn].tolist())


def _in_lines(name: str, elements: list[int]) -> Iterator[str]:
    for i in range(0, len(elements), _NUMBERS_A_LINE):
        yield " ".join([name, *map(str, elements[i : i + _NUMBERS_A_LINE])])


def _cross_sections(data: ModelData, appearance: Appearance) -> Iterable[tuple[str, ...]]:
    for kind, sizes in zip(
        appearance.cross_section.tolist(), appearance.dimensions.tolist(), strict=True
    ):
        lines = [f"CROSSTYPE {CrossSection(kind).name}"] if kind else []
        if any(sizes):
            round_one = kind in (CrossSection.CIRC, CrossSection.CIRCHOL)
            said = _typed(data, sizes[:1] if round_one else sizes, ("m", "m"))
            lines.append(f"CROSSDIM {said}")
        yield tuple(lines)


def _colours(appearance: Appearance) -> Iterable[tuple[str, ...]]:
    for face, edge, opacity in zip(
        appearance.colour.tolist(),
        appearance.edge_colour.tolist(),
        appearance.opacity.tolist(),
        strict=True,
    ):
        given = ("FACECOLOR", face), ("EDGECOLOR", edge), ("OPACITY", [opacity])
        yield tuple(
            f"{name} {' '.join(map(repr, values))}"
            for name, values in given
            if values[0] == values[0]
        )


class Prescribed(NamedTuple):
    """What is prescribed; the other independent coordinates and deformations are dynamic.

    Attributes:
        coordinates: (3, nodes) by axis.
        deformations: (6, elements).
    """

    coordinates: BoolArray
    deformations: BoolArray


def prescribed_in(data: ModelData) -> Prescribed:
    """What the deck of a model states with INPUTX and INPUTE; nothing in a model without one.

    An analysis needs no difference between inputs and degrees of freedom, so that the model
    itself does not keep it.
    """
    arrays = data.arrays
    coordinates = np.zeros(arrays.coordinate_class.shape, np.bool_)
    deformations = np.zeros(arrays.deformation_class.shape, np.bool_)
    for letter, number, components in class_statements(data, "INPUT"):
        if letter == "X":
            if (node := data.node_index.get(number)) is None:
                # Of warping, which a model does not have.
                continue
            first = FIRST_COMPONENT[NodeKind(int(arrays.node_kind[node]))]
            _mark(coordinates[:, node], components, first)
        else:
            _mark(deformations[:, data.element_index[number]], components, 1)
    return Prescribed(
        coordinates & (arrays.coordinate_class == Class.INDEPENDENT),
        deformations & (arrays.deformation_class == Class.INDEPENDENT),
    )


def class_statements(data: ModelData, word: str) -> Iterator[tuple[str, int, list[int]]]:
    """The statements of a class in a deck's kinematics, as it has them.

    Args:
        data: A model; one that was made in Python has none.
        word: DYN or INPUT.

    Yields:
        X or E, node or element, and components.
    """
    if data.source is None:
        return
    tokens = tokens_of(data.source)
    for number in tokens.lines_of(f"{word}X", f"{word}E").tolist():
        line = tokens[number]
        if line.block is Block.KINEMATICS:
            owner, *components = (each.number for each in line.words[1:])
            yield line.name[-1], owner, components


def _mark(marks: BoolArray, components: list[int], first: int) -> None:
    """Mark some components, all where none is named; lambda0 and warping are none of its own."""
    if not components:
        marks[:] = True
    for component in components:
        if first <= component < first + marks.size:
            marks[component - first] = True
