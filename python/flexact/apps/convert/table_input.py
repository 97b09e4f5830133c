# SPDX-License-Identifier: BSD-3-Clause
"""Tables as they are given, checked and brought into one form."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ...core.elements import Member, NodeKind
from ...core.raw import ElementKind
from ...model.data import CrossSection
from ...model.draft import Shape
from ...model.names import nearest
from ...model.sections import Make, Material, constants_of, mass, stiffness
from ...util.text import in_short
from .values import (
    ELEMENT_FIELDS,
    LARGEST,
    NODE_FIELDS,
    OPTIONS,
    RELEASE_FIELDS,
    Field,
    Found,
    is_unset,
    number,
    vector,
    whole,
)

_TABLES = ("nodes", "elements", "nprops", "eprops", "rls", "opt", "name")
Entry = dict[str, Any]


@dataclass
class Tables:
    """Nodes and elements by number from 1, with what is said of each.

    Attributes:
        places: Two or three coordinates of each node [m].
        ends: The two nodes of each element.
        nodes: Fields of nodes that have any.
        sets: Fields of sets of elements.
        set_of: Number of the set of each element that is in one.
        released: Deformations of elements that are released.
        gravity: Acceleration of free fall [m/s^2].
        left_out: What is said that a model does not hold.
        name: What the model is called.
        faulty: Places of entries with a field that is wrong, of which no more is said.
    """

    places: list[tuple[float, ...]] = field(default_factory=list)
    ends: list[tuple[int, int]] = field(default_factory=list)
    nodes: dict[int, Entry] = field(default_factory=dict)
    sets: dict[int, Entry] = field(default_factory=dict)
    set_of: dict[int, int] = field(default_factory=dict)
    released: dict[int, tuple[int, ...]] = field(default_factory=dict)
    gravity: tuple[float, ...] = (0.0, 0.0, 0.0)
    left_out: Counter[str] = field(default_factory=Counter)
    name: str = ""
    faulty: set[str] = field(default_factory=set)

    def entry_of(self, element: int) -> Entry:
        """The fields of the set that an element is in; empty where it is in none."""
        return self.sets.get(self.set_of.get(element, 0), {})

    @property
    def planar(self) -> bool:
        """Whether nodes have two coordinates."""
        return bool(self.places) and len(self.places[0]) == 2


def tables_given(given: Mapping[str, Any], found: Found) -> Tables:
    """Tables with everything that is wrong with them noted in `found`."""
    made = Tables()
    for name in given:
        if name not in _TABLES:
            found.error(str(name), f"there is no such table{_meant(name, _TABLES)}")
    made.name = given["name"] if isinstance(given.get("name"), str) else ""
    _take_places(made, given.get("nodes"), found)
    _take_ends(made, given.get("elements"), found)
    made.nodes = _fields(given.get("nprops"), "nprops", NODE_FIELDS, made, found)
    for node in made.nodes:
        if made.places and node > len(made.places):
            found.error(f"nprops[{node}]", f"there are {len(made.places)} nodes")
    made.sets = _fields(given.get("eprops"), "eprops", ELEMENT_FIELDS, made, found)
    _take_sets(made, found)
    _take_options(made, given, found)
    return made


def _meant(name: object, known: Sequence[str] | Mapping[str, Any]) -> str:
    near = nearest(name, known)[:1] if isinstance(name, str) else []
    return f"; did you mean {near[0]}?" if near else f": it is one of {', '.join(known)}"


def _rows(given: Any, name: str, found: Found) -> list[Any]:
    """The rows of a matrix; MATLAB writes one of a single row as a list of numbers."""
    if not isinstance(given, Sequence) or isinstance(given, (str, bytes)) or not given:
        what = "is missing" if given is None else "must be a list of rows with numbers"
        found.error(name, f"the table {what}")
        return []
    if all(isinstance(each, (int, float)) for each in given):
        return [given]
    return list(given)


def _take_places(made: Tables, given: Any, found: Found) -> None:
    rows = _rows(given, "nodes", found)
    width = 2 if rows and all(isinstance(row, Sequence) and len(row) == 2 for row in rows) else 3
    for i, row in enumerate(rows, start=1):
        place = [0.0] * width
        if not isinstance(row, Sequence) or isinstance(row, str) or len(row) != width:
            words = f"a node has x, y and z, or all have x and y, not {in_short(row)}"
            found.error(f"nodes[{i}]", words)
            row = ()
        for k, value in enumerate(row):
            place[k] = found.checked(f"nodes[{i}][{k + 1}]", number, value) or 0.0
        made.places.append(tuple(place))


def _take_ends(made: Tables, given: Any, found: Found) -> None:
    for i, row in enumerate(_rows(given, "elements", found), start=1):
        ends = (0, 0)
        try:
            if not isinstance(row, Sequence) or isinstance(row, str) or len(row) != 2:
                raise ValueError(f"an element has two nodes, not {in_short(row)}")
            ends = whole(row[0]), whole(row[1])
            for node in ends:
                if made.places and not 1 <= node <= len(made.places):
                    raise ValueError(
                        f"there is no node {in_short(node)}: nodes are 1 to {len(made.places)}"
                    )
            if ends[0] == ends[1]:
                raise ValueError(f"both ends are node {ends[0]}")
        except ValueError as error:
            found.error(f"elements[{i}]", str(error))
        made.ends.append(ends)


def _entries(
    given: Any, name: str, fields: Mapping[str, Field], found: Found
) -> list[tuple[int, Any]]:
    """Number and fields of each entry: of a list, of an object by numbers, or of a single one."""
    if is_unset(given):
        return []
    if isinstance(given, Mapping):
        if not given or any(str(key) in fields for key in given):
            # MATLAB writes a single entry without brackets.
            return [(1, given)]
        made = []
        for key, entry in given.items():
            if str(key).isascii() and str(key).isdecimal() and 0 < len(str(key)) < 10 and int(key):
                made.append((int(key), entry))
            else:
                found.error(f"{name}[{key}]", f"a number from 1 on is wanted, not {in_short(key)}")
        return made
    if isinstance(given, Sequence) and not isinstance(given, (str, bytes)):
        return list(enumerate(given, start=1))
    found.error(name, f"a list of objects is wanted, not {in_short(given)}")
    return []


def _fields(
    given: Any, name: str, fields: Mapping[str, Field], made: Tables, found: Found
) -> dict[int, Entry]:
    """The checked fields of entries that have any, by number."""
    into: dict[int, Entry] = {}
    for i, entry in _entries(given, name, fields, found):
        if is_unset(entry):
            continue
        place = f"{name}[{i}]"
        if not isinstance(entry, Mapping):
            found.error(place, f"an object with fields is wanted, not {in_short(entry)}")
            continue
        for key, value in entry.items():
            if key not in fields:
                found.error(f"{place}.{key}", f"there is no such field{_meant(key, fields)}")
            elif not is_unset(value):
                value = found.checked(f"{place}.{key}", fields[key].check, value)
                if value is None:
                    made.faulty.add(place)
                    continue
                into.setdefault(i, {})[key] = value
                if fields[key].left_out and value is not False:
                    made.left_out[f"{fields[key].left_out}: {name}.{key}"] += 1
    return into


def _take_sets(made: Tables, found: Found) -> None:
    """Which set each element is in."""
    for i, entry in made.sets.items():
        place = f"eprops[{i}]"
        if place in made.faulty:
            continue
        if "elems" not in entry:
            found.error(place, "the field elems is missing: to which elements does this belong?")
        for element in entry.get("elems", ()):
            if not made.ends:
                continue
            if element > len(made.ends):
                there = f"there are {len(made.ends)} elements"
                found.error(f"{place}.elems", f"there is no element {element}: {there}")
            elif element in made.set_of:
                before = made.set_of[element]
                found.error(f"{place}.elems", f"element {element} is in eprops[{before}] already")
            else:
                made.set_of[element] = i
        if ("cshape" in entry) != ("dim" in entry):
            found.error(place, "cshape and dim belong together: give both")
        elif "cshape" in entry and len(entry["dim"]) != (2 if entry["cshape"] == "rect" else 1):
            wanted = "width and thickness" if entry["cshape"] == "rect" else "one diameter"
            found.error(f"{place}.dim", f"of cshape {entry['cshape']!r} {wanted} is wanted")
        if ("emod" in entry) != ("smod" in entry):
            missing = "smod" if "emod" in entry else "emod"
            found.error(place, f"emod and smod belong together: {missing} is missing")
        if "cshape" not in entry and {"emod", "dens"} & entry.keys():
            found.error(place, "emod and dens need a cross-section: give cshape and dim")


def _take_options(made: Tables, given: Mapping[str, Any], found: Found) -> None:
    options = given.get("opt")
    releases, place = given.get("rls"), "rls"
    if not is_unset(options) and not isinstance(options, Mapping):
        found.error("opt", f"an object is wanted, not {in_short(options)}")
        options = {}
    for name, value in (options or {}).items():
        if name not in OPTIONS:
            found.error(f"opt.{name}", f"there is no such option{_meant(name, OPTIONS)}")
        elif name not in ("gravity", "rls"):
            made.left_out[f"what is for a simulation: opt.{name}"] += 1
        elif is_unset(value):
            continue
        elif name == "gravity":
            made.gravity = found.checked("opt.gravity", vector(3), value) or made.gravity
        else:
            if not is_unset(releases):
                found.error("opt.rls", "releases are given twice, here and as rls: keep one")
            releases, place = value, "opt.rls"
    for element, entry in _fields(releases, place, RELEASE_FIELDS, made, found).items():
        if made.ends and element > len(made.ends):
            found.error(f"{place}[{element}]", f"there are {len(made.ends)} elements")
        made.released[element] = entry["def"]


#: Between what was given and what follows from moduli and density that were found from it.
_NEAR = 1.0e-9


def shape_of(entry: dict[str, Any]) -> Shape | None:
    """The cross-section: of a rectangle the width lies along local y, as orien does."""
    if not {"cshape", "dim"} <= entry.keys():
        return None
    kind = CrossSection.CIRC if entry["cshape"] == "circ" else CrossSection.RECT
    return Shape(kind, entry["dim"][0], entry["dim"][-1])


def is_ordinary(shape: Shape) -> bool:
    """Whether its sizes can be computed with."""
    return all(1.0 / LARGEST < size < LARGEST for size in (shape.y, shape.z))


def stiffness_of(
    kind: ElementKind, shape: Shape, entry: dict[str, Any]
) -> tuple[float, ...] | None:
    """ESTIFF of an element; None without moduli."""
    if not {"emod", "smod"} <= entry.keys():
        return None
    return stiffness(kind, shape, Material("given", entry["emod"], entry["smod"]))


def warped(given: tuple[float, ...], length: float, held: int) -> tuple[float, ...]:
    """ESTIFF of a beam with G It as it is where warping is held at two ends, at one or at none.

    With v = 0 at one end and v' = 0 at the other, of `warping_factor`'s equation, a beam is half
    of one of twice its length that is held at both.
    """
    if not held:
        return given
    return Make(None, given).with_warping(True, length * (3 - held)).stiffness or given


def mass_of(kind: ElementKind, shape: Shape, entry: dict[str, Any]) -> tuple[float, ...] | None:
    """EM of an element; None without a density."""
    return mass(kind, shape, Material("given", 1.0, 1.0, entry.get("dens", 0.0)))


def moduli_of(
    kind: ElementKind, shape: Shape, given: tuple[float, ...]
) -> tuple[dict[str, float], bool] | None:
    """Moduli that give this stiffness, and whether the shear does not follow; None without any.

    Of a planar beam and of a bar nothing is known of the shear modulus.
    """
    is_spatial = kind.member == Member.BEAM and NodeKind.PLANAR_POSITION not in kind.slots
    if not is_spatial or len(given) < 4 or not is_ordinary(shape):
        return None
    c = constants_of(shape)
    found = {"emod": given[0] / c.area, "smod": given[1] / c.torsion}
    if not all(1.0 / LARGEST < each < LARGEST for each in found.values()):
        return None
    again = stiffness_of(kind, shape, found) or ()
    if not np.allclose(again[:4], given[:4], rtol=_NEAR, atol=0.0):
        return None
    same = len(given) == len(again) and np.allclose(again, given, rtol=_NEAR, atol=0.0)
    return found, not same


def density_of(kind: ElementKind, shape: Shape, given: tuple[float, ...]) -> float | None:
    """The density that gives this mass; None without one."""
    if kind.member not in (Member.BAR, Member.BEAM) or not is_ordinary(shape):
        return None
    found = given[0] / constants_of(shape).area
    again = mass_of(kind, shape, {"dens": found}) if 0.0 < found < LARGEST else None
    if again is None:
        return None
    padded = np.zeros(len(again))
    padded[: len(given)] = given[: len(again)]
    return found if np.allclose(again, padded, rtol=_NEAR, atol=0.0) else None
