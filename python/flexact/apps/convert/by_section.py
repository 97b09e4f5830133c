# SPDX-License-Identifier: BSD-3-Clause
"""What flexures sets of elements are, by their sections: sheets, wires and bodies.

Scripts for SPACAR Light say ``flex = 1:6`` of whatever bends: every deformation is elastic there,
and none is said to be compliant. What a designer would call compliant follows from the section.
"""

from __future__ import annotations

import statistics
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from ...analysis.places import listed
from ...core.elements import Member, NodeKind, kind_of
from ...core.raw import ElementKind
from ...deck.diagnostics import Diagnostic, Severity
from ...model.data import CrossSection
from ...model.draft import Draft
from ...model.names import part_name
from ...model.parts.chains import Chain
from ...model.sections import constants_of
from ...util.records import Frozen
from .table_input import BY_SECTION, Entry, Tables, shape_of

#: A rectangle is flat, so that it bends in one plane alone, from so many thicknesses of width.
FLAT = 5.0
#: What is so many times as stiff in bending as the median of the sets does not bend.
STIFF = 1000.0
#: From so many times on it may be a body, too, which is said.
_DOUBTFUL = 30.0
#: Rounding of a quotient of two decimals, with room.
_SLACK = 1e-9
_TORSION, _TURN = (2,), (1,)
_HINGES = ("HINGE", "PLHINGE")
#: Bending about local y, which bends the size along local z, and about local z.
_BENDS_Z, _BENDS_Y = (3, 4), (5, 6)
_PLANAR_BENDS = (2, 3)
_NAMES = {1: "elongation 1", 2: "torsion 2"}
_WORDS = {
    "sheet": "a sheet: out-of-plane bending and torsion are released",
    "wire": "a wire: bending in both planes and torsion are released",
    "body": "a body: nothing is released",
}


@dataclass(frozen=True)
class Taken(Frozen):
    """What the elements of tables are taken for.

    Attributes:
        released: Deformations of each element that are released.
        remarks: What of it a designer is to know: of each set, by its place.
    """

    released: dict[int, tuple[int, ...]]
    remarks: tuple[Diagnostic, ...]


def kind_given(tables: Tables, entry: Entry) -> ElementKind:
    """The kind of the elements of a set."""
    return kind_of(entry.get("type", "plbeam" if tables.planar else "beam").upper())


def says_all(kind: ElementKind, entry: Entry) -> bool:
    """Whether all deformations of a beam are said to be flexible, and so none in particular."""
    every = {mode for mode, role in enumerate(kind.role, start=1) if role}
    return kind.member == Member.BEAM and every <= set(entry.get("flex", ()))


def taken_by_section(tables: Tables) -> Taken:
    """What is released of each element, by what `flex` of its set says, and by its section.

    Where `flex` says all deformations, a rectangle of five thicknesses or more is a sheet, any
    other section a wire, and what is a thousand times as stiff in bending as the median of such
    sets a body. What `flex` says of fewer is released. `rls` makes equations solvable, which says
    nothing about the design: it is not taken over, and told.
    """
    bending = _bending_of(tables)
    # Of two sets the softer one: it is the flexure.
    median = statistics.median_low(bending.values()) if bending else 0.0
    released: dict[int, tuple[int, ...]] = {}
    remarks: list[Diagnostic] = []
    for number, entry in tables.sets.items():
        kind = kind_given(tables, entry)
        modes, words, is_sure = tuple(entry.get("flex", ())), "", True
        if says_all(kind, entry):
            ratio = bending[number] / median if number in bending else 1.0
            modes, words, is_sure = _all_of(kind, entry, ratio)
        elif modes:
            words = f"flex says {_listed(modes)}: {_of_some(kind, entry, modes)}"
        elif kind.keyword in _HINGES:
            modes, words = _TURN, "a hinge without flex turns about its axis"
        if words:
            remarks.append(_remark(f"eprops[{number}]", entry["elems"], words, is_sure))
        released |= dict.fromkeys(entry.get("elems", ()), modes)
    ignored = [element for element, modes in tables.released.items() if modes]
    for element in ignored:
        if not released.get(element):
            modes = tables.released[element]
            words = (
                f"it is rigid, and {_listed(modes)} stays held; if it is a joint, say so with flex"
            )
            remarks.append(_remark(f"rls[{element}]", (element,), words, False))
    if ignored:
        words = (
            "not taken over: releases that make the equations solvable say nothing about the "
            "design; --flexible independent takes them over"
        )
        remarks.append(_remark("rls", ignored, words, True))
    return Taken(released, tuple(remarks))


def _bending_of(tables: Tables) -> dict[int, float]:
    """The smaller bending stiffness [N m2] of each set of which `flex` says all."""
    moduli = [entry["emod"] for entry in tables.sets.values() if "emod" in entry]
    made = {}
    for number, entry in tables.sets.items():
        shape, kind = shape_of(entry), kind_given(tables, entry)
        if shape is not None and says_all(kind, entry):
            constants = constants_of(shape)
            # A planar beam bends in its plane alone.
            second = constants.iz if _is_planar(kind) else min(constants.iy, constants.iz)
            made[number] = entry.get("emod", moduli[0] if moduli else 1.0) * second
    return made


def _is_planar(kind: ElementKind) -> bool:
    return NodeKind.PLANAR_POSITION in kind.slots


def _all_of(kind: ElementKind, entry: Entry, ratio: float) -> tuple[tuple[int, ...], str, bool]:
    """What is released of elements of which `flex` says all; in words; and whether that is sure."""
    modes: tuple[int, ...]
    shape = shape_of(entry)
    if shape is None:
        modes = _PLANAR_BENDS if _is_planar(kind) else (*_TORSION, *_BENDS_Z)
        words = "taken for a sheet whose width is along orien, for cshape and dim are not given"
        return modes, words, False
    size = " by ".join(f"{1e3 * each:.4g}" for each in entry["dim"])
    is_round = shape.kind is CrossSection.CIRC
    what = f"{size} mm round" if is_round else f"{size} mm"
    if ratio >= STIFF:
        words = f"{_WORDS['body']}, though flex says all"
        return (), f"{what}, {ratio:.0f} times as stiff in bending as the others, is {words}", True
    if _is_planar(kind):
        return _PLANAR_BENDS, f"{what} is a sheet: bending is released", True
    low, high = sorted((shape.y, shape.z))
    if is_round or high < FLAT * low * (1.0 - _SLACK):
        modes, kind_of_flexure = (*_TORSION, *_BENDS_Z, *_BENDS_Y), "wire"
    else:
        # The thickness, not the width, is what bends.
        modes = (*_TORSION, *(_BENDS_Z if shape.z < shape.y else _BENDS_Y))
        kind_of_flexure = "sheet"
    words = f"{what} is {_WORDS[kind_of_flexure]}"
    if ratio >= _DOUBTFUL:
        words += f"; {ratio:.0f} times as stiff in bending as the others: without flex it is a body"
    return modes, words, True


def _of_some(kind: ElementKind, entry: Entry, modes: tuple[int, ...]) -> str:
    """That some deformations are released, and what its section would release besides."""
    words = "these are released"
    if kind.member != Member.BEAM or shape_of(entry) is None or not 1 < len(modes) < 5:
        return words
    more = set(_all_of(kind, entry, 1.0)[0]) - set(modes)
    if not more:
        return words
    names = listed([_NAMES.get(mode, f"bending {mode}") for mode in sorted(more)])
    return f"{words}; a flexure of this section releases {names}, too"


def _remark(place: str, elements: Sequence[int], words: str, is_sure: bool) -> Diagnostic:
    many = "element" if len(elements) == 1 else "elements"
    severity = Severity.NOTE if is_sure else Severity.WARNING
    message = f"{place}, {many} {_listed(sorted(elements))}: {words}"
    return Diagnostic(severity, BY_SECTION, message)


def _listed(numbers: Iterable[int]) -> str:
    """Numbers with those in a row as spans, such as "1, 3-6"."""
    made: list[list[int]] = []
    for number in numbers:
        if made and number == made[-1][-1] + 1:
            made[-1].append(number)
        else:
            made.append([number])
    return ", ".join(
        f"{each[0]}-{each[-1]}" if len(each) > 2 else ", ".join(map(str, each)) for each in made
    )


def name_by_rows(
    draft: Draft, chains: Sequence[Chain], first: Sequence[int], kinds: Sequence[str]
) -> None:
    """Name parts by the elements of the script, whose numbers are not those of its beams.

    Args:
        draft: Gets the names, of beams that have none.
        chains: Beams in a row.
        first: The element of the script that each beam is of.
        kinds: What each beam is, such as "sheet".
    """
    given = set(map(part_name, draft.names.values()))
    alone = set(range(len(first)))
    for chain in chains:
        alone -= set(chain.elements)
        element = min(first[beam] for beam in chain.elements)
        for place, beam in enumerate(chain.elements, start=1):
            part = f"{kinds[beam]} {element}"
            if beam not in draft.names and part not in given:
                draft.name_element(beam, f"{part}, part {place} of {len(chain.elements)}")
    for beam in alone - draft.names.keys():
        if (part := f"{kinds[beam]} {first[beam]}") not in given:
            draft.name_element(beam, part)


def kind_in_words(released: Iterable[int]) -> str:
    """What a beam is that releases this: "sheet", "wire", "beam" or "body"."""
    given = set(released)
    bends = [bool(given & {*pair}) for pair in (_BENDS_Z, _BENDS_Y)]
    if all(bends):
        return "wire"
    if any(bends):
        return "sheet"
    return "beam" if given else "body"
