# SPDX-License-Identifier: BSD-3-Clause
"""Tables as they are given, checked and brought into one form.

A check gives the value as it is used, or raises ValueError in words.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ...core.elements import Member, NodeKind, element_kinds
from ...core.raw import ElementKind
from ...deck.diagnostics import Diagnostic, Place, Problems, Severity, Source
from ...deck.rendering import ProblemsError
from ...model.data import CrossSection
from ...model.draft import Shape
from ...model.names import nearest
from ...model.sections import Make, Material, constants_of, mass, stiffness
from ...util.records import cached_property
from ...util.text import in_short

#: Fourth powers of sizes, times moduli, are numbers.
LARGEST = 1e30


def _require(is_right: bool, wanted: str) -> None:
    if not is_right:
        raise ValueError(wanted)


def flag(value: Any) -> bool:
    """True or false; also 1 and 0."""
    is_number = isinstance(value, (bool, int, float))
    _require(is_number and value in (0, 1), "true or false is wanted")
    return bool(value)


def number(value: Any) -> float:
    """A finite number."""
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    _require(is_number, "a number is wanted")
    try:
        made = float(value)
    except OverflowError:
        made = math.inf
    _require(math.isfinite(made), "the number is not finite")
    return made


def whole(value: Any) -> int:
    """A whole number, also one like 2.0."""
    made = number(value)
    _require(made == int(made), "a whole number is wanted")
    return int(made)


def positive(value: Any) -> float:
    """A number above zero, neither tiny nor huge."""
    made = number(value)
    _require(1.0 / LARGEST < made < LARGEST, f"a number between 0 and {LARGEST:g} is wanted")
    return made


def not_negative(value: Any) -> float:
    """A number from zero on."""
    return 0.0 if number(value) == 0.0 else positive(value)


def count(value: Any) -> int:
    """A whole number from 1 on."""
    made = whole(value)
    _require(1 <= made < 10**6, "a whole number from 1 on is wanted")
    return made


def part(value: Any) -> float:
    """A number from 0 to 1."""
    made = number(value)
    _require(0.0 <= made <= 1.0, "a number from 0 to 1 is wanted")
    return made


def text(value: Any) -> str:
    """A text on one line."""
    _require(isinstance(value, str), "a text is wanted")
    return " ".join(value.split())


def texts(value: Any) -> tuple[str, ...]:
    """A text, or several."""
    return tuple(text(each) for each in (value if isinstance(value, list) else [value]))


def vector(*sizes: int) -> Callable[[Any], tuple[float, ...]]:
    """What checks for so many finite numbers."""

    def check(value: Any) -> tuple[float, ...]:
        given = value if isinstance(value, (list, tuple)) else [value]
        _require(len(given) in sizes, f"{' or '.join(map(str, sizes))} numbers are wanted")
        return tuple(number(each) for each in given)

    return check


def direction(value: Any) -> tuple[float, ...]:
    """A vector that is not zero."""
    made = vector(3)(value)
    _require(any(made), "the vector is zero")
    return made


def numbers_from_one(value: Any) -> tuple[int, ...]:
    """Numbers from 1 on, each once; a single one may stand without brackets."""
    made = tuple(count(each) for each in (value if isinstance(value, (list, tuple)) else [value]))
    _require(len(set(made)) == len(made), "a number stands there twice")
    return made


def deformations(value: Any) -> tuple[int, ...]:
    """Numbers of deformations from 1 to 6, each once."""
    made = numbers_from_one(value)
    _require(max(made, default=1) <= 6, "deformations have numbers from 1 to 6")
    return made


def shape(value: Any) -> str:
    """The kind of a cross-section."""
    _require(value in ("rect", "circ"), "'rect' or 'circ' is wanted")
    return str(value)


def sizes(value: Any) -> tuple[float, ...]:
    """Width and thickness, or a diameter."""
    return tuple(positive(each) for each in vector(1, 2)(value))


#: Colours by name; by number from 1 in this order.
COLOURS = {
    "blue": (0.62, 0.76, 0.86),
    "grey": (0.78, 0.78, 0.78),
    "darkblue": (0.0, 0.45, 0.7),
    "darkgrey": (0.44, 0.44, 0.44),
    "green": (0.5, 0.76, 0.56),
    "darkgreen": (0.35, 0.54, 0.4),
}


def colour(value: Any) -> tuple[float, ...]:
    """Red, green and blue from 0 to 1, or to 255 where one exceeds 1; a name, or its number."""
    if isinstance(value, str):
        _require(value in COLOURS, f"one of {', '.join(COLOURS)} is wanted, or three numbers")
        return COLOURS[value]
    if not isinstance(value, (list, tuple)):
        words = f"the colours have numbers from 1 to {len(COLOURS)}"
        _require(1 <= whole(value) <= len(COLOURS), words)
        return tuple(COLOURS.values())[whole(value) - 1]
    made = vector(3)(value)
    largest = 255.0 if max(made) > 1.0 else 1.0
    return tuple(part(each / largest) for each in made)


def kind(value: Any) -> str:
    """The keyword of an element, in small letters."""
    known = [each.keyword.lower() for each in element_kinds()]
    made = value.lower() if isinstance(value, str) else ""
    _require(made in known, f"one of {', '.join(known)} is wanted")
    return made


def moments(value: Any) -> tuple[float, ...]:
    """Six moments of inertia, none of them huge."""
    made = vector(6)(value)
    _require(max(map(abs, made)) < LARGEST, f"numbers below {LARGEST:g} are wanted")
    return made


LETTERS = ("x", "y", "z")


def words_of(*stems: str) -> Callable[[Any], tuple[str, ...]]:
    """What checks for words such as force_x, one or several."""
    known = [f"{stem}_{axis}" for stem in stems for axis in LETTERS]

    def check(value: Any) -> tuple[str, ...]:
        made = texts(value)
        _require(all(each in known for each in made), f"of {', '.join(known)} are wanted")
        return made

    return check


def transfer(value: Any) -> float | None:
    """The modal damping of a state space that is asked for: true, or true with a number."""
    asked, *rest = value if isinstance(value, (list, tuple)) and value else [value]
    _require(len(rest) <= 1, "true or false is wanted, perhaps with a modal damping")
    damping = not_negative(rest[0]) if rest else 0.0
    return damping if flag(asked) else None


#: Nodes of a deck by point: a position, an orientation, and a warping node, which is not used.
NODES_A_POINT = 3


#: Gives the value of a field as it is used, or raises ValueError in words.
Check = Callable[[Any], Any]
#: Of a motion: what is added in the course of loading, and what it begins with.
_STARTS = ("", "_initial")
PRESCRIBED, SIMULATED = "values of prescribed motions", "what is for a simulation"
#: Fields that only Flexact knows.
OWN_FIELDS = frozenset(("fix_rx", "fix_ry", "fix_rz", "name", "same_pos", "same_orien", "type"))

#: Of each node.
NODE_FIELDS: dict[str, Check] = {
    **{name: flag for name in ("fix", "fix_pos", "fix_orien")},
    **{f"fix_{axis}": flag for axis in LETTERS},
    **{f"fix_r{axis}": flag for axis in LETTERS},
    "fix_warp": flag,
    **{f"displ{start}_{axis}": number for start in ("", "_initial") for axis in LETTERS},
    **{f"rot{start}_{axis}": number for start in ("", "_initial") for axis in LETTERS},
    **{f"rot{start}": vector(4) for start in ("", "_initial")},
    "mass": not_negative,
    "mominertia": moments,
    **{f"{load}{start}": vector(3) for load in ("force", "moment") for start in ("", "_initial")},
    "transfer_in": words_of("force"),
    "transfer_out": words_of("displ", "veloc"),
    "name": text,
    "same_pos": count,
    "same_orien": count,
}
#: Of each set of elements.
ELEMENT_FIELDS: dict[str, Check] = {
    "elems": numbers_from_one,
    "emod": positive,
    "smod": positive,
    "dens": not_negative,
    "cshape": shape,
    "dim": sizes,
    "orien": direction,
    "nbeams": count,
    "flex": deformations,
    "color": colour,
    "opacity": part,
    "hide": flag,
    "warping": flag,
    "cw": flag,
    "type": kind,
    "name": text,
}
#: Of the releases, element by element.
RELEASE_FIELDS = {"def": deformations}
#: Names of versions before 1.0, and of the structure that was given alone, as they are today. In
#: those versions the rotation rx was about z.
OLD_TABLES = {
    **{"coordinates": "nodes", "connect": "elements", "elprops": "eprops"},
    **{"Nodes": "nodes", "Elements": "elements", "Node_props": "nprops", "Elem_props": "eprops"},
    **{"Rlse": "rls", "Optional": "opt"},
}
OLD_NODE_FIELDS = {
    **{"fix_all": "fix", "fix_xyz": "fix_pos", "fix_rxyz": "fix_orien", "fix_w": "fix_warp"},
    **{f"fix_rot_{axis}": f"fix_r{axis}" for axis in LETTERS},
    **{f"disp{start}_{axis}": f"displ{start}_{axis}" for start in _STARTS for axis in LETTERS},
    **{
        f"disp{start}_r{axis}": f"rot{start}_{now}"
        for start in _STARTS
        for axis, now in zip(LETTERS, reversed(LETTERS), strict=True)
    },
    **{
        f"{stem}_initial_r{axis}": f"rot_initial_{axis}"
        for stem in ("displ", "rot")
        for axis in LETTERS
    },
    **{"displ_rot": "rot", "displ_initial_rot": "rot_initial", "inertia": "mominertia"},
}
OLD_ELEMENT_FIELDS = {
    **{"El_Nrs": "elems", "E": "emod", "G": "smod", "rho": "dens", "n_beams": "nbeams"},
    "enable_warping": "warping",
}
#: What `type` of an element said before there was cshape.
OLD_TYPES = {
    **{"leafspring": "rect", "rigid": "rect", "rect": "rect"},
    **{"wire": "circ", "circ": "circ"},
}
#: What SPACAR Light calls the loads of a deck: XF, on which a simulation starts, and DELXF.
LOADS = {"force": "_initial", "increment": ""}
#: Options; of these releases, gravity and transfer are used, and none of the others is looked at.
OPTIONS = (
    *("rls", "filename", "gravity", "silent", "calcbuck", "showinputonly", "loadsteps", "mode"),
    *("transfer", "calccompl", "customvis", "customdyn", "customkin", "spavisual", "rigidstress"),
    *("stressperelement", "buckload", "buck_load", "simple_mode", "transfer_in", "transfer_out"),
)
#: What deformations in flex can be taken for, the first where nothing is said; see `model_of`.
BY_SECTION, INDEPENDENT, RELEASED = FLEXIBLE = "by-section", "independent", "released"


def is_unset(value: Any) -> bool:
    """Whether a field is there and empty, as MATLAB writes those of other entries."""
    return value is None or (isinstance(value, Sequence) and len(value) == 0)


LEFT_OUT, LOST, OWN_FIELD, TRANSFER = "left-out", "lost", "own-field", "state-space"
OLD_NAME = "old-name"


@dataclass
class Remarks:
    """Counts of what is left out, and of fields that only Flexact knows.

    Attributes:
        left_out: What the verdict does not depend on.
        lost: What it depends on.
        own: Fields of tables.
        renamed: What is called otherwise today.
    """

    left_out: Counter[str] = field(default_factory=Counter)
    lost: Counter[str] = field(default_factory=Counter)
    own: Counter[str] = field(default_factory=Counter)
    renamed: Counter[str] = field(default_factory=Counter)

    def lose(self, what: str, times: int = 1) -> None:
        """Note something that the other format does not hold, and the verdict depends on."""
        if times:
            self.lost[what] += times

    def leave_out(self, what: str, times: int = 1) -> None:
        """Note something that the other format does not hold."""
        if times:
            self.left_out[what] += times

    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """A warning of each thing that is lost, a note of each that is left out."""
        words = "lost, though the verdict depends on it: "
        said = [
            *((Severity.WARNING, LOST, f"{words}{what} ({n})") for what, n in self.lost.items()),
            *((Severity.NOTE, LEFT_OUT, f"{what} ({n})") for what, n in self.left_out.items()),
        ]
        for code, about, counted in (
            (OLD_NAME, "names of older versions", self.renamed),
            (OWN_FIELD, "fields that SPACAR Light does not know", self.own),
        ):
            if counted:
                names = ", ".join(f"{name} ({times})" for name, times in counted.items())
                said.append((Severity.NOTE, code, f"{about}: {names}"))
        return tuple(Diagnostic(*each) for each in said)


class TablesError(ProblemsError, ValueError):
    """Tables that are no model; each problem begins with its place, such as nprops[3].fix."""


#: The text that tables were read from, and what finds where each value stands in it.
Text = tuple[Source, Callable[[], Mapping[str, Place]]]


class Found:
    """Problems as they are found."""

    def __init__(self, text: Text | None, name: str) -> None:
        """Nothing yet."""
        self._source = None if text is None else text[0]
        self._find_spans: Callable[[], Mapping[str, Place]] = dict if text is None else text[1]
        self._name = name if self._source is None else self._source.name
        self._items: list[Diagnostic] = []
        self._said: set[str] = set()

    @cached_property
    def _spans(self) -> Mapping[str, Place]:
        try:
            return self._find_spans()
        except RecursionError:
            # What stands in each other so deeply has no places.
            return {}

    def error(self, place: str, message: str, hint: str = "") -> None:
        """Note, once, that something is wrong at a place, such as nprops[3].fix."""
        words = f"{place}: {message}" if place else message
        if words in self._said:
            return
        self._said.add(words)
        # Where the value stands, or what holds it; zeros where that is not known.
        while place and place not in self._spans:
            place = place[: max(place.rfind("."), place.rfind("["), 0)]
        span = self._spans.get(place, Place(0, 0, 0))
        self._items.append(Diagnostic(Severity.ERROR, "bad-table", words, *span, help=hint))

    def checked(self, place: str, check: Callable[[Any], Any], value: Any) -> Any:
        """The value as it is used; None where the check says what is wrong with it."""
        try:
            return check(value)
        except ValueError as error:
            self.error(place, f"{error}, not {in_short(value)}")
            return None

    def require_none(self) -> None:
        """Raise if anything was found.

        Raises:
            TablesError: everything.
        """
        if self._items:
            raise TablesError(Problems.of(self._items), self._name, self._source)


_TABLES = ("nodes", "elements", "nprops", "eprops", "rls", "opt", "name", "flexible")
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
        transfer: Modal damping of the state space that is asked for; None without one.
        left_out: What is said that a model does not hold.
        lost: What of it the verdict depends on.
        renamed: What is called otherwise today.
        name: What the model is called.
        flexible: What deformations in flex are, one of `FLEXIBLE`; empty where nothing is said.
        faulty: Places of entries with a field that is wrong, of which no more is said.
    """

    places: list[tuple[float, ...]] = field(default_factory=list)
    ends: list[tuple[int, int]] = field(default_factory=list)
    nodes: dict[int, Entry] = field(default_factory=dict)
    sets: dict[int, Entry] = field(default_factory=dict)
    set_of: dict[int, int] = field(default_factory=dict)
    released: dict[int, tuple[int, ...]] = field(default_factory=dict)
    gravity: tuple[float, ...] = (0.0, 0.0, 0.0)
    transfer: float | None = None
    left_out: Counter[str] = field(default_factory=Counter)
    lost: Counter[str] = field(default_factory=Counter)
    renamed: Counter[str] = field(default_factory=Counter)
    name: str = ""
    flexible: str = ""
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
    given = _as_today(given, OLD_TABLES, made, found, "")
    for name in given:
        if name not in _TABLES:
            found.error(str(name), f"there is no such table{_meant(name, _TABLES)}")
    if not is_unset(given.get("flexible")):
        made.flexible = found.checked("flexible", _flexible, given["flexible"]) or ""
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


def _flexible(value: Any) -> str:
    _require(value in FLEXIBLE, f"one of {', '.join(FLEXIBLE)} is wanted")
    return str(value)


def _as_today(
    given: Mapping[str, Any], names: Mapping[str, str], made: Tables, found: Found, place: str
) -> Mapping[str, Any]:
    """The entries under the names of today; what says nothing may be there twice."""
    renamed: dict[str, Any] = {}
    called: dict[str, str] = {}
    for key, value in given.items():
        now = names.get(key, key)
        old = value.lower() if key == "type" and isinstance(value, str) else ""
        if names is OLD_ELEMENT_FIELDS and old in OLD_TYPES:
            now, value = "cshape", OLD_TYPES[old]
        if now in renamed and (is_unset(value) or not is_unset(renamed[now])):
            if not is_unset(value):
                older = key if key != now else called[now]
                where = f"{place}.{older}" if place else older
                found.error(where, f"this is {now} by an older name, and both are there: keep one")
            continue
        renamed[now], called[now] = value, key
        if now != key and not is_unset(value):
            made.renamed[f"{key} for {now}"] += 1
    return renamed


def _meant(name: object, known: Sequence[str] | Mapping[str, Any]) -> str:
    near = nearest(name, known)[:1] if isinstance(name, str) else []
    return f"; did you mean {near[0]}?" if near else f": it is one of {', '.join(known)}"


#: Names of today by older ones, of entries of a table.
_OLD_FIELDS = {"nprops": OLD_NODE_FIELDS, "eprops": OLD_ELEMENT_FIELDS}


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
    given: Any, name: str, fields: Mapping[str, Check], found: Found
) -> list[tuple[int, Any]]:
    """Number and fields of each entry: of a list, of an object by numbers, or of a single one."""
    if is_unset(given):
        return []
    if isinstance(given, Mapping):
        if not given or any(
            str(key) in fields or key in _OLD_FIELDS.get(name, ()) for key in given
        ):
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
    given: Any, name: str, fields: Mapping[str, Check], made: Tables, found: Found
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
        for key, value in _as_today(entry, _OLD_FIELDS.get(name, {}), made, found, place).items():
            if key not in fields:
                found.error(f"{place}.{key}", f"there is no such field{_meant(key, fields)}")
            elif not is_unset(value):
                value = found.checked(f"{place}.{key}", fields[key], value)
                if value is None:
                    made.faulty.add(place)
                    continue
                into.setdefault(i, {})[key] = value
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
            missing, given = ("smod", "emod") if "emod" in entry else ("emod", "smod")
            if entry.get("flex") or "cshape" not in entry:
                found.error(place, f"emod and smod belong together: {missing} is missing")
            else:
                made.left_out[f"{place}.{given} without {missing}, of what is rigid"] += 1
                del entry[given]
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
        elif name == "customkin" and not is_unset(value):
            made.lost["opt.customkin: statements for the kinematics"] += 1
        elif name not in ("gravity", "rls", "transfer"):
            made.left_out[f"{SIMULATED}: opt.{name}"] += 1
        elif is_unset(value):
            continue
        elif name == "transfer":
            made.transfer = found.checked("opt.transfer", transfer, value)
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
