# SPDX-License-Identifier: BSD-3-Clause
"""Small parts of the JSON: places by number and name, quantities with units, margins, advice."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from functools import cache, partial
from itertools import islice
from typing import Any, NamedTuple

import numpy as np

from ..core.arrays import Basis, FloatArray, IntArray
from ..core.elements import Dual, coordinate_name, keywords_of
from ..model.parts.parts import PartKind
from ..util.loading import VERSION, feature
from ..util.units import Units
from .calls import calls_of
from .decomposition import row_duals, row_factors
from .freedoms import Freedom
from .limits import LEFT_OUT
from .mode_words import moments_at_ends, side_in_words
from .naming import freedom_in_words, node_name, part_in_words, plain, unit_of_coordinate
from .part_stresses import PartStress, Rivalry
from .places import deformation_word, place_words
from .result import Result
from .screws import Screw, ScrewKind, Wrench
from .verdict import AnalysisError, Margin
from .verdict_words import certainty_word, warnings_of
from .ways import Coordinate, Part, Step, Way, on_motions, on_self_stresses

#: Of so many declared degrees of freedom, in models of so many elements, the motions are given, as
#: they take one further decomposition; of more elements the parts are not listed either.
_MOST_FREEDOMS, _MOST_ELEMENTS = 64, 10_000
#: Components of the motion of a degree of freedom.
_PARTS = 6
_ALL = (Step.DECLARE_FOLDS, Step.DECLARE_OR_HOLD_ALL, Step.RELEASE_ALL)

Entries = dict[str, Any]


def quantity(value: float | list[float], unit: str) -> Entries:
    """A number beside its unit."""
    return {"value": value, "unit": unit}


def in_units(made: Any, units: Units) -> Any:
    """What is for JSON with each quantity in it in other units than SI."""
    if not units.power:
        return made
    if isinstance(made, list):
        return [in_units(each, units) for each in made]
    if not isinstance(made, dict):
        return made
    made = {name: in_units(each, units) for name, each in made.items()}
    unit = made.get("unit")
    if isinstance(unit, str) and "value" in made:
        value = made["value"]
        shown = np.asarray(value, np.float64) if value is not None else None
        made["value"] = None if shown is None else units.shown(shown, unit).tolist()
        made["unit"] = units.symbol(unit)
    return made


def node_place(result: Result, number: int) -> Entries:
    """A node by its number, and what it is called."""
    return {"node": number, "name": node_name(result, result.data.node_index[number])}


def element_place(result: Result, number: int) -> Entries:
    """An element by its number, what it is called, and its keyword."""
    return _element_at(result, result.given.element_index[number])


def _element_at(result: Result, index: int) -> Entries:
    """The same by its index in the model as given."""
    given = result.given
    (keyword,) = keywords_of(given.arrays.element_kind[index : index + 1])
    return {
        "element": int(given.arrays.element_number[index]),
        "name": given.element_names[index],
        "keyword": keyword,
    }


def deformation_place(result: Result, element: int, number: int) -> Entries:
    """A deformation of an element, by its number and in words."""
    arrays = result.given.arrays
    index, own = result.condensed.in_given(result.data.element_index[element], number)
    word = deformation_word(int(arrays.element_kind[index]), own)
    place = _element_at(result, index)
    return {**place, "deformation": own, "word": word}


def coordinate_place(result: Result, node: int, name: str) -> Entries:
    """A coordinate of a node."""
    return {**node_place(result, node), "coordinate": name}


def margin(result: Result, item: Margin) -> Entries:
    """A misalignment: how far a node moves, how far an element turns."""
    length = angle = None
    if item.length is not None and item.node is not None:
        length = {**quantity(item.length, "m"), **node_place(result, item.node)}
    if item.angle is not None and item.element is not None:
        angle = {**quantity(item.angle, "rad"), **element_place(result, item.element)}
    return {
        "length": length,
        "angle": angle,
        "singular_value": item.singular_value,
        "exact_alignment": item.exact_alignment,
    }


def accuracy(result: Result, *, usual: bool = False) -> Entries | None:
    """The accuracy as it was given, else None or the usual one; whether the margin is smaller."""
    given = result.usual_accuracy if usual else result.accuracy
    if given is None:
        return None
    return {
        "length": quantity(given.length, "m"),
        "angle": None if given.angle is None else quantity(given.angle, "rad"),
        "exceeds_margin": result.has_small_margin if usual else result.is_marginal,
    }


def advice(result: Result) -> Iterator[Entries]:
    """What removes motions, then what removes self-stresses, the best first.

    What is inside of divided sheets is declared first; the rest is of what is left then.
    """
    whole = result.with_internal_declared
    if whole is not None:
        yield from (_one_advice(result, "motions", item) for item in islice(on_motions(result), 1))
        result = whole
    for about, every in (
        ("motions", on_motions(result)),
        ("self_stresses", on_self_stresses(result)),
    ):
        yield from (_one_advice(result, about, item) for item in every)


def _one_advice(result: Result, about: str, item: Way) -> Entries:
    return {
        "about": about,
        "removes": "all" if item.step in _ALL else "one",
        "step": item.step.value,
        "parts": [
            {
                **_part(result, part),
                "words": plain(part_in_words(result, part)),
                "operands": part.operands,
            }
            for part in item.parts
        ],
        "more": item.more,
        "statements": [
            {"keyword": keyword, "operands": item.parts[0].operands}
            for keyword in item.keywords
            if not (item.step is Step.UNDECLARE and isinstance(item.parts[0], Coordinate))
        ],
        # What does it with the first part of a model that was made in Python.
        "calls": []
        if result.given.source is not None
        else [*calls_of(result, item, item.parts[0])],
        "instead": item.instead,
    }


def _part(result: Result, part: Part) -> Entries:
    if isinstance(part, Coordinate):
        return coordinate_place(result, part.node, part.name)
    return deformation_place(result, part.element, part.number)


def freedoms(result: Result) -> Iterator[Entries]:
    """The declared degrees of freedom, and how the mechanism moves in them."""
    is_large = result.data.arrays.element_number.size > _MOST_ELEMENTS
    most = 0 if is_large else _MOST_FREEDOMS
    for count, freedom in enumerate(result.freedoms):
        yield _freedom(result, freedom, count < most)


def _freedom(result: Result, freedom: Freedom, is_sought: bool) -> Entries:
    _, number = freedom.owner
    if freedom.is_coordinate:
        place = coordinate_place(result, number, freedom.part)
    else:
        place = deformation_place(result, number, freedom.place[0] + 1)
    made: Entries = {
        "label": plain(freedom_in_words(freedom)),
        **place,
        "moves": None,
        "largest": [],
    }
    try:
        if is_sought:
            made["moves"] = freedom.motion is not None
            made["largest"] = [
                {
                    **coordinate_place(result, node, name),
                    **quantity(value, unit_of_coordinate(name)),
                }
                for node, name, value in freedom.largest(_PARTS)
            ]
    except AnalysisError:
        # The degree of freedom is there, only its motion could not be found.
        pass
    return made


def parts(result: Result) -> list[Entries] | None:
    """Sheets, wires, bars, bodies and hinges by their names; None of a large model."""
    arrays = result.given.arrays
    if arrays.element_number.size > _MOST_ELEMENTS:
        return None
    return [
        {
            "name": part.name,
            "kind": part.kind.value,
            "elements": arrays.element_number[list(part.elements)].tolist(),
            "nodes": arrays.node_number[list(part.ends)].tolist(),
        }
        for part in result.parts.all
    ]


def taken_as_one(result: Result) -> list[Entries] | None:
    """Parts of several beams that are one beam each in D(c); None of a large model."""
    if not result.is_told_by_parts:
        return None
    number = result.given.arrays.element_number
    return [
        {
            "part": result.parts.of_element(chain.elements[0]).name,
            "elements": number[list(chain.elements)].tolist(),
        }
        for chain in result.condensed.chains
    ]


def held_bodies(result: Result) -> list[Entries] | None:
    """How often each motion of each body is held; None of a model too large for that.

    Point and axes are given where they are not the middle of the body and those of the model.
    """
    if result.holding.left_out:
        return None
    made = []
    for body in result.bodies:
        entry: Entries = {
            "name": body.name,
            "held": body.held,
            "declared": list(body.declared),
            "free": list(body.free),
        }
        if body.where or not np.array_equal(body.axes, np.eye(3)):
            entry |= {"at": quantity(body.at.tolist(), "m"), "axes": body.axes.T.tolist()}
        if body.together:
            entry["together"] = [
                {"directions": list(group.directions), "held": group.held}
                for group in body.together
            ]
        if body.against:
            entry["against"] = {way: list(others) for way, others in body.against.items()}
        made.append(entry)
    return made


def held_inside(result: Result) -> list[Entries]:
    """Parts that are held too often between their ends, which no body feels."""
    return [
        {"parts": [part.name for part in each.parts], "too_often": each.too_often}
        for each in result.holding.inside
    ]


def internal_motions(result: Result) -> Entries | None:
    """Motions inside of divided sheets and wires; None where nothing of them is undeclared."""
    whole = result.with_internal_declared
    if whole is None:
        return None
    inside = {part.name: None for motion in result.motions for part in motion.internal_to}
    return {
        "count": result.internal_motions,
        "parts": list(inside),
        "declared": {
            "under_constrained": whole.under_constrained,
            "over_constrained": whole.over_constrained,
        },
    }


def of_motion(result: Result, index: int) -> Entries:
    """What bodies and joints do in a motion."""
    if not result.is_told_by_parts:
        return {}
    motion = result.motions[index]
    made = {
        "bodies": [
            {
                "bodies": [part.name for part in group.bodies],
                "joints": [str(joint) for joint in group.joints],
                **_screw(group.screw),
            }
            for group in motion.bodies
        ],
        "internal_to": [part.name for part in motion.internal_to],
    }
    return dict(in_units(made, result.given.units))


def of_self_stress(result: Result, index: int) -> Entries:
    """What parts carry in a self-stress, and what they press on."""
    if not result.is_told_by_parts:
        return {}
    stress = result.self_stresses[index]
    made = {
        "parts": [_stressed(result, index, each) for each in stress.parts],
        "conflicts": [
            {
                "on": str(conflict.on),
                "over": _over(conflict.over),
                "loads": [
                    {"part": None if load.part is None else load.part.name, **_wrench(load.wrench)}
                    for load in conflict.loads
                ],
            }
            for conflict in stress.conflicts
        ],
        "sides": None if stress.rivalry is None else _sides(result, stress.rivalry),
    }
    return dict(in_units(made, result.given.units))


def _sides(result: Result, rivalry: Rivalry) -> Entries:
    """On what the sides of a loop press, and over what."""
    return {
        "on": str(rivalry.on),
        "over": _over(rivalry.over),
        "sides": [
            {
                "words": plain(side_in_words(result, side)),
                "parts": [part.name for part in side.parts],
                "through": [body.name for body in side.through],
                **_wrench(side.wrench),
            }
            for side in rivalry.sides
        ],
    }


def _over(over: Wrench | None) -> Entries | None:
    if over is None:
        return None
    return {
        "kind": over.kind.value,
        "direction": over.direction.tolist(),
        "point": quantity(over.point.tolist(), "m"),
    }


def _screw(screw: Screw) -> Entries:
    turns = screw.kind is not ScrewKind.TRANSLATION
    return {
        "kind": screw.kind.value,
        "direction": screw.direction.tolist(),
        "point": quantity(screw.point.tolist(), "m") if turns else None,
        "pitch": quantity(screw.pitch, "m/rad") if turns else None,
        "magnitude": quantity(screw.magnitude, "rad" if turns else "m"),
    }


def _stressed(result: Result, index: int, one: PartStress) -> Entries:
    moments: Entries = {}
    ends = [
        # In the order of the moments.
        {"node": None, "words": ""}
        if end.position is None
        else {
            "node": int(result.given.arrays.node_number[end.position]),
            "words": place_words(result.parts, end.position, one.part),
        }
        for end in one.ends
    ]
    if one.part.kind is PartKind.SHEET and len(one.ends) == 2:
        moments = {
            word: [quantity(value, "N m") for value in values]
            for word, values in moments_at_ends(result.self_stresses[index], one).items()
        }
    return {
        "part": one.part.name,
        "ends": ends,
        "normal_force": quantity(one.normal_force, "N"),
        "twist_moment": quantity(one.twist_moment, "N m"),
        "shear_force": quantity(one.shear_force.tolist(), "N"),
        "moments": [quantity(moment.tolist(), "N m") for moment in one.moments],
        **moments,
    }


def _wrench(wrench: Wrench) -> Entries:
    return {
        "kind": wrench.kind.value,
        "force": quantity(wrench.force.tolist(), "N"),
        "moment": quantity(wrench.moment.tolist(), "N m"),
        "about": quantity(wrench.about.tolist(), "m"),
    }


#: How many components are handled at once.
_AT_ONCE = 100_000

#: One component, its values in the order of the keys.
Row = tuple[Any, ...]
#: The columns of components at some places of D(c), with these entries of V or U.
Columns = Callable[[IntArray, FloatArray], tuple[list[Any], ...]]


#: Keys of numbers of nodes and elements, and of those that are written to the last bit.
_WHOLE, _EXACT = ("node", "element", "deformation"), ("value", "raw")


class ModesTable(NamedTuple):
    """Modes, each as the rows of a table with a component each."""

    keys: tuple[str, ...]
    basis: Basis
    columns: Columns
    more: Callable[[int], dict[str, Any]]
    """What else is said of a mode, by its index."""

    def dictionaries(self) -> list[dict[str, Any]]:
        """The modes as the JSON has them."""
        return [
            {"components": [dict(zip(self.keys, row, strict=True)) for row in mode]}
            | self.more(index)
            for index, mode in enumerate(self._rows(lambda text: text))
        ]

    def text(self) -> Iterator[str]:
        """The same as JSON, without a dictionary for each component."""
        form = ", ".join(f'"{key}": {"%r" if key in _EXACT else "%s"}' for key in self.keys)
        of_row = f"{{{form}}}".__mod__
        before = ""
        yield "["
        for index, mode in enumerate(self._rows(cache(json.dumps))):
            more = json.dumps(self.more(index), allow_nan=False)[1:-1]
            yield f'{before}{{"components": [{", ".join(map(of_row, mode))}]'
            yield f"{', ' if more else ''}{more}}}"
            before = ", "
        yield "]"

    def _rows(self, of_text: Callable[[str], str]) -> Iterator[list[Row]]:
        """Components of each vector but those that are practically zero, in their order."""
        basis, begin = self.basis, 0
        while begin < basis.vectors:
            room = int(basis.start[begin]) + _AT_ONCE
            end = max(begin + 1, int(np.searchsorted(basis.start, room, "right")) - 1)
            part = slice(int(basis.start[begin]), int(basis.start[end]))
            vector = np.repeat(np.arange(end - begin), np.diff(basis.start[begin : end + 1]))
            size = np.abs(basis.value[part])
            largest = np.zeros(end - begin)
            np.maximum.at(largest, vector, size)
            kept = size > LEFT_OUT * largest[vector]
            columns = self.columns(basis.place[part][kept], basis.value[part][kept])
            rows = zip(
                *(
                    column if key in _WHOLE or key in _EXACT else map(of_text, column)
                    for key, column in zip(self.keys, columns, strict=True)
                ),
                strict=True,
            )
            for count in np.bincount(vector[kept], minlength=end - begin).tolist():
                yield list(islice(rows, count))
            begin = end


def motions(result: Result) -> ModesTable:
    """The motions: displacements [m] and rotations [rad] of nodes."""
    raw, arrays, units = result.raw, result.data.arrays, result.given.units
    factors = {unit: units.factor(unit) for unit in ("m", "rad")}
    # Where no point has a name, nobody has to look for each.
    named = result.motion_basis.vectors > 0 and any(result.given.node_names)
    name_of = cache(partial(node_name, result)) if named else lambda _: ""

    def columns(places: IntArray, value: FloatArray) -> tuple[list[Any], ...]:
        node, axis = raw.column_label[:, places] - 1
        kinds = arrays.node_kind[node].tolist()
        coordinates = list(map(coordinate_name, kinds, axis.tolist()))
        return (
            arrays.node_number[node].tolist(),
            list(map(name_of, node.tolist())),
            coordinates,
            (value * [factors[unit_of_coordinate(each)] for each in coordinates]).tolist(),
            [units.symbol(unit_of_coordinate(each)) for each in coordinates],
        )

    keys = ("node", "name", "coordinate", "value", "unit")
    return ModesTable(keys, result.motion_basis, columns, partial(of_motion, result))


def self_stresses(result: Result) -> ModesTable:
    """The self-stresses: forces [N] and moments [N m], beside the raw entries of U."""
    arrays, units = result.given.arrays, result.given.units
    factor = units.factor("N m")
    # Names of a deck are cut out of its text.
    name_of = cache(result.given.element_names.__getitem__)

    def columns(places: IntArray, value: FloatArray) -> tuple[list[Any], ...]:
        index, deformations = _in_given(result, places)
        kinds = arrays.element_kind[index]
        force = row_duals(result, places) == Dual.FORCE
        return (
            arrays.element_number[index].tolist(),
            list(map(name_of, index.tolist())),
            list(keywords_of(kinds)),
            deformations,
            list(map(deformation_word, kinds.tolist(), deformations)),
            (value * row_factors(result, places) * np.where(force, 1.0, factor)).tolist(),
            np.where(force, "N", units.symbol("N m")).tolist(),
            value.tolist(),
        )

    keys = ("element", "name", "keyword", "deformation", "word", "value", "unit", "raw")
    return ModesTable(keys, result.stress_basis, columns, partial(of_self_stress, result))


def _in_given(result: Result, places: IntArray) -> tuple[IntArray, list[int]]:
    """Indices of elements in the model as given, and their deformations, of rows of D(c)."""
    element, deformation = result.raw.row_label[:, places]
    condensed = result.condensed
    if not condensed.chains:
        return condensed.elements[element - 1], deformation.tolist()
    found = list(map(cache(condensed.in_given), (element - 1).tolist(), deformation.tolist()))
    return np.array([index for index, _ in found], np.int32), [own for _, own in found]


#: Of the JSON; see `docs/command.md` for when it is raised.
FORMAT = 2

#: Modes are many: they are written one by one.
_MODES: dict[str, Callable[[Result], ModesTable]] = {
    "motions": motions,
    "self_stresses": self_stresses,
}


def dictionary_of(analysis: Result) -> dict[str, Any]:
    """The names and values of the JSON, in their order."""
    made = {name: modes(analysis).dictionaries() for name, modes in _MODES.items()}
    return dict(in_units(_without_modes(analysis), analysis.given.units)) | made


def text_of(analysis: Result) -> str:
    """The same as one line of text, made without a dictionary for each component."""
    pieces = []
    for name, value in in_units(_without_modes(analysis), analysis.given.units).items():
        if name in _MODES:
            text = "".join(_MODES[name](analysis).text())
        else:
            text = json.dumps(value, allow_nan=False)
        pieces.append(f"{json.dumps(name)}: {text}")
    return f"{{{', '.join(pieces)}}}"


def header(name: str) -> dict[str, Any]:
    """What every object begins with."""
    # Bytes of a path that are no text are escaped, so that any reader of JSON takes it.
    deck = name.encode("utf-8", "backslashreplace").decode("utf-8")
    return {"format": FORMAT, "deck": deck, "flexact": VERSION}


def _without_modes(analysis: Result) -> dict[str, Any]:
    """The names and values in their order, with nothing for the modes.

    The verdict on the machine, and how far it is from another; the rank of D(c), and how it was
    decided; what is known of the rank, which is of the arithmetic; then what is in the machine.
    """
    rows, columns = analysis.raw.largest_component
    proof, nearly = analysis.proof, analysis.nearly
    counts = ("under_constrained", "over_constrained")
    modes = [
        {**({f"{name}_given": given} if given < count else {}), name: []}
        for name, count, given in (
            ("motions", analysis.under_constrained, len(analysis.motions)),
            ("self_stresses", analysis.over_constrained, len(analysis.self_stresses)),
        )
    ]
    return {
        **header(analysis.name),
        "units": analysis.given.units.name,
        "verdict": analysis.verdict.value,
        "under_constrained": analysis.under_constrained,
        "over_constrained": analysis.over_constrained,
        "margin": margin(analysis, analysis.margin),
        "margins": [margin(analysis, item) for item in analysis.margins],
        "accuracy": accuracy(analysis),
        "usual_accuracy": accuracy(analysis, usual=True),
        "degrees_of_freedom": analysis.degrees_of_freedom,
        "counts": {name: part._asdict() for name, part in analysis.counts._asdict().items()},
        "characteristic_length": quantity(analysis.characteristic_length, "m"),
        "rank": analysis.rank,
        "rows": analysis.rows,
        "columns": analysis.columns,
        "method": analysis.method,
        "connected_components": {
            "count": analysis.components,
            "largest": {"rows": rows, "columns": columns},
        },
        "tolerance": analysis.tolerance,
        "bound": analysis.bound,
        "gap": {**analysis.gap._asdict(), "ratio": analysis.gap.ratio},
        "singular_values": analysis.singular_values.tolist(),
        "singular_values_given": analysis.singular_values_given,
        "condition_number": analysis.condition_number,
        "certainty": certainty_word(analysis),
        "proof": proof._asdict() if proof else None,
        "nearly": None if nearly is None else dict(zip(counts, nearly, strict=False)),
        "alternatives": [item._asdict() for item in analysis.alternatives],
        "parts": parts(analysis),
        "taken_as_one": taken_as_one(analysis),
        "internal_motions": internal_motions(analysis),
        "bodies": held_bodies(analysis),
        "held_inside": held_inside(analysis),
        "freedoms": list(freedoms(analysis)),
        **modes[0],
        **modes[1],
        "advice": list(advice(analysis)),
        **({"at_rest": feature("at_rest")(analysis)} if analysis.given.loads else {}),
        "warnings": [item.to_dict() for item in warnings_of(analysis)],
    }
