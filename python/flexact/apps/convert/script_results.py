# SPDX-License-Identifier: BSD-3-Clause
"""What scripts for SPACAR Light read from its results, along its load steps.

The verdict is a designer's, of the tables by section. The numbers are those of the model that the
script asks for: what is in `flex` is elastic, all else rigid, with the script's own beams.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np

from ...analysis.result import Result
from ...core.arrays import FloatArray
from ...core.elements import AXES, Class, NodeKind
from ...elasticity.elastic import Elastic, State
from ...elasticity.equilibria import at_rest, reached, with_drive
from ...elasticity.errors import ElasticError
from ...elasticity.points import Coordinate
from ...model.model import Model
from ...util.errors import FlexactError
from ...util.loading import VERSION, load
from ...util.rotations import matrix_of_euler, vector_of_euler
from ...util.text import in_short
from .table_input import BY_SECTION, INDEPENDENT, LETTERS, RELEASED, Found, Tables, Text
from .tables import (
    checked_tables,
    data_of,
    end_in_words,
    ends_of_transfer,
    numbers_of_points,
)

#: Load steps where opt.loadsteps does not say how many; of version 0.5, by its `type`, one more.
_STEPS = 10
_OLD_TYPE = "type for cshape"
_MOST_STEPS = 100_000
#: Options that change what is computed, and that Flexact does not follow.
_NOT_FOLLOWED = {
    "customkin": "statements for the kinematics of SPACAR",
    "customdyn": "statements for the dynamics of SPACAR",
}
_NAMES = (*LETTERS, *(f"r{axis}" for axis in LETTERS))


@dataclass(frozen=True)
class Script:
    """The tables of a script, as a designer's model and as its own.

    Attributes:
        tables: The tables in one form.
        given: As they were given.
        designed: The model by section, of which the verdict is.
        simulated: The model as SPACAR Light has it, of which the results are.
    """

    tables: Tables
    given: Mapping[str, Any]
    designed: Model
    simulated: Model

    @classmethod
    def of(cls, given: Mapping[str, Any], name: str = "", text: Text | None = None) -> Script:
        """Of tables as `model_of` takes them.

        Raises:
            TablesError: anything is wrong with them.
        """
        found = Found(text, name)
        tables = checked_tables(given, name, found)
        designed = data_of(tables, tables.flexible or BY_SECTION, found)
        simulated = data_of(tables, INDEPENDENT, found)
        return cls(tables, given, Model.from_data(designed), Model.from_data(simulated))


@dataclass
class _Results:
    """Results as they are found, and why some are not there."""

    values: dict[str, Any] = field(default_factory=dict)
    missing: dict[str, str] = field(default_factory=dict)

    def take(self, into: dict[str, Any], name: str, find: Callable[[], Any]) -> None:
        """Put a result under its name, or why there is none."""
        if name in self.missing:
            return
        try:
            value = find()
        except FlexactError as error:
            self.missing[name] = str(error)
            return
        if not np.isfinite(_numbers_in(value)).all():
            self.missing[name] = "it is infinite: something moves without any stiffness"
            return
        into[name] = value


def _numbers_in(value: Any) -> FloatArray:
    return np.asarray(value, np.float64) if isinstance(value, (list, float, int)) else np.zeros(0)


def results_of(script: Script, designed: Result) -> dict[str, Any]:
    """What a script reads, in the names of SPACAR Light; lists, numbers and text alone.

    Under "missing" stands, by name, why something is not there, under "notes" what is to be known
    of what is. Of load step i, `step[i]` has
    `freq`, `buck`, `stressmax`, `node[j]` with `p`, `r_quat`, `r_axang`, `r_eulzyx`, `Freac`,
    `Mreac`, `CMglob` and `CMloc`, and `element[k].e`, a row a beam.

    Args:
        script: The script.
        designed: The analysis of its designed model.

    Raises:
        ElasticError: nothing has a stiffness, or an option asks for what is not computed.
        StrokeError: a load step has no equilibrium.
    """
    options = script.given.get("opt", script.given.get("Optional")) or {}
    for name, words in _NOT_FOLLOWED.items():
        if options.get(name):
            raise ElasticError(f"opt.{name}: {words} change the results, and are not followed")
    if options.get("mode", 10) not in (9, 10, []):
        raise ElasticError(f"opt.mode: only results of mode 10 are computed, not {options['mode']}")
    found = _Results()
    simulated = load("flexact.api").analyse(script.simulated)
    count = simulated.counts
    independent = count.coordinates.independent + count.deformations.independent
    found.values |= {
        "version": f"Flexact {VERSION}",
        "verdict": designed.verdict.value,
        "under_constrained": designed.under_constrained,
        "over_constrained": designed.over_constrained,
        # Releases of deformations that are elastic make the others follow.
        "ndof": independent - simulated.over_constrained + simulated.under_constrained,
        "overconstraints": _pressing(script, designed),
    }
    rigid = Model.from_data(data_of(script.tables, RELEASED, Found(None, "")))
    if over := load("flexact.api").analyse(rigid).over_constrained:
        found.values["notes"] = [
            f"what is not in flex is rigid, and over-constrained by {over}: of reactions and "
            "stresses those of least norm are given"
        ]
    elastic = Elastic(script.simulated.data, "rigid", "locked", {}, 1)
    elastic.require_stiffness()
    transfer = script.tables.transfer is not None
    states = tuple(_load_steps(script, elastic, options, transfer))
    reader = _Reader(script, elastic, options, found)
    found.values["step"] = [reader.step(state) for state in states]
    if all(ends_of_transfer(script.tables)):
        for state, step in zip(states, found.values["step"], strict=True):
            found.take(step, "lin", partial(_system, script.tables, state))
        if transfer and "lin" in found.values["step"][-1]:
            found.values["statespace"] = found.values["step"][-1]["lin"]
    _make_alike(found)
    found.values["missing"] = found.missing
    return found.values


def text_of_results(results: Mapping[str, Any]) -> str:
    """JSON; numbers read back to the last bit."""
    return json.dumps(results, allow_nan=False, separators=(",", ":"))


def _pressing(script: Script, designed: Result) -> list[list[int]]:
    """Elements of the script and deformations that press in self-stresses, a row an element."""
    rows: dict[int, set[int]] = {}
    of_beam = _beams(script.tables)
    owner = {beam: element for element, beams in of_beam.items() for beam in beams}
    for stress in designed.self_stresses:
        for beam, mode, _ in stress.largest(len(owner) * 6):
            rows.setdefault(owner[beam], set()).add(mode)
    most = max(map(len, rows.values()), default=0)
    # Rows of a matrix, as SPACAR Light fills them up.
    return [
        [element, *sorted(modes), *[0] * (most - len(modes))]
        for element, modes in sorted(rows.items())
    ]


def _beams(tables: Tables) -> dict[int, range]:
    """Numbers of the beams of each element."""
    made, first = {}, 1
    for element in range(1, len(tables.ends) + 1):
        many = tables.entry_of(element).get("nbeams", 1)
        made[element] = range(first, first + many)
        first += many
    return made


def _load_steps(
    script: Script, elastic: Elastic, options: Mapping[str, Any], transfer: bool
) -> Iterator[State]:
    """States under what is there initially and what is added, in as many steps as are asked for.

    A state space is that of the undeformed state, as SPACAR Light has it.
    """
    (solver,) = elastic.solvers
    here, data = at_rest(solver, elastic.locked), script.simulated.data
    if transfer:
        yield State(elastic, "undeformed", None, (here,))
        return
    motions = tuple(_motions(script.tables, elastic))
    loads = data.loads
    initial, gravity = np.zeros((2, solver.nodes, 3)), np.zeros(3)
    if loads is not None:
        initial, gravity = np.array((loads.force, loads.increment)), np.array(loads.gravity)
    adds = bool(initial[1].any()) or any(more for _, _, more in motions)
    many = options.get("loadsteps") or _STEPS + (_OLD_TYPE in script.tables.renamed)
    if not isinstance(many, (int, float)) or not 1 <= many <= _MOST_STEPS:
        words = f"opt.loadsteps: a number from 1 to {_MOST_STEPS} is wanted"
        raise ElasticError(f"{words}, not {in_short(many)}")
    many = int(many) if adds else 1
    for step in range(many):
        share = step / (many - 1) if many > 1 else float(adds)
        target = here.way.target
        for drive, start, more in motions:
            value = start + share * more
            if elastic.points.unit(drive) == "rad":
                value = 2.0 * math.asin(min(1.0, max(-1.0, value)))
            target = with_drive(solver, target, drive, value)
        force = np.asfortranarray((initial[0] + share * initial[1]).T)
        way = here.way._replace(target=target, force=force, gravity=gravity)
        here = reached(here, way, float(step), float(step + 1), "the load steps", "")
        yield State(elastic, f"load step {step + 1}", None, (here,))


def _motions(tables: Tables, elastic: Elastic) -> Iterator[tuple[Coordinate, float, float]]:
    """Prescribed coordinates: where each begins, and what is added.

    Positions [m], and of rotations Euler parameters, which SPACAR Light adds up as such.
    """
    numbers, index = numbers_of_points(tables), elastic.data.node_index
    for point, entry in tables.nodes.items():
        for stem, own in zip(("displ", "rot"), numbers, strict=True):
            if own[point] not in index:
                continue
            node = index[own[point]]
            for axis in AXES[elastic.data.arrays.node_kind[node]]:
                given = [_prescribed(entry, f"{stem}{start}", axis) for start in ("_initial", "")]
                if given == [None, None]:
                    continue
                start, more = (each or 0.0 for each in given)
                rest = tables.places[point - 1][axis] if stem == "displ" else 0.0
                yield Coordinate(node, axis), rest + start, more


def _prescribed(entry: Mapping[str, Any], stem: str, axis: int) -> float | None:
    """A displacement, or the Euler parameter of a rotation; None where none is prescribed."""
    if stem in entry:
        # An angle about an axis.
        angle, *about = entry[stem]
        length = math.hypot(*about) or 1.0
        return math.sin(angle / 2.0) * float(about[axis]) / length
    value: float | None = entry.get(f"{stem}_{LETTERS[axis]}")
    return value if value is None or stem.startswith("displ") else math.sin(value / 2.0)


class _Reader:
    """Reads states as scripts do."""

    def __init__(
        self, script: Script, elastic: Elastic, options: Mapping[str, Any], found: _Results
    ) -> None:
        self.tables, self.options, self.found = script.tables, options, found
        self.data = elastic.data
        self.numbers = numbers_of_points(script.tables)
        self.beams = _beams(script.tables)
        self.stressed = [
            number
            for element, numbers in self.beams.items()
            for number in numbers
            if self._has_stress(element)
        ]

    def _has_stress(self, element: int) -> bool:
        """Whether the stress of an element counts: rigid ones on demand."""
        entry = self.tables.entry_of(element)
        return "cshape" in entry and bool(entry.get("flex") or self.options.get("rigidstress"))

    def step(self, state: State) -> dict[str, Any]:
        """What is read of a load step."""
        made: dict[str, Any] = {}
        take = self.found.take
        take(made, "freq", lambda: state.frequencies.tolist())
        if self.options.get("calcbuck"):
            take(made, "buck", lambda: sorted(np.abs(state.multipliers).tolist()))
        take(made, "stressmax", lambda: self._peak(state, self.stressed))
        made["node"] = [self._node(state, point) for point in self._points]
        made["element"] = [self._element(state, each) for each in self.beams]
        return made

    @property
    def _points(self) -> range:
        return range(1, len(self.tables.places) + 1)

    def _peak(self, state: State, elements: list[int]) -> float:
        if not elements:
            raise ElasticError("no flexible element has cshape and dim")
        return max(map(state.von_mises, elements))

    def _node(self, state: State, point: int) -> dict[str, Any]:
        position, orientation = (own[point] for own in self.numbers)
        known = self.data.node_index
        if position not in known:
            return {"p": list(self.tables.places[point - 1])}
        made: dict[str, Any] = {"p": np.asarray(state.position(position)).tolist()}
        made["Freac"] = self._reactions(state, position)
        turned = np.eye(3)
        if orientation in known and self.data.arrays.node_kind[known[orientation]] == (
            NodeKind.ORIENTATION
        ):
            node = known[orientation]
            euler = state.best(lambda at: at.raw.configuration[:, node])
            euler = euler / np.linalg.norm(euler)
            turned = matrix_of_euler(euler)
            vector = vector_of_euler(euler)
            angle = float(np.linalg.norm(vector))
            axis = vector / angle if angle else np.array([1.0, 0.0, 0.0])
            made |= {
                "r_quat": euler.tolist(),
                "r_axang": [angle, *axis.tolist()],
                "r_eulzyx": _zyx_of(turned),
                "Mreac": self._reactions(state, orientation),
            }
        if self.options.get("calccompl", True):
            compliance: dict[str, Any] = {}
            self.found.take(compliance, "CMglob", lambda: state.compliance(position).tolist())
            if "CMglob" in compliance:
                made |= compliance
                local = np.kron(np.eye(len(compliance["CMglob"]) // 3), turned)
                made["CMloc"] = (local.T @ np.array(compliance["CMglob"]) @ local).tolist()
        return made

    def _reactions(self, state: State, number: int) -> list[float]:
        """Of what is fixed or prescribed; 0 of what is free."""
        node = self.data.node_index[number]
        kind = self.data.arrays.node_kind[node]
        turns = kind > NodeKind.POSITION
        held = np.isin(self.data.arrays.coordinate_class[:, node], (Class.FIXED, Class.INDEPENDENT))
        return [
            state.reaction(number, _NAMES[axis + 3 * turns]) if held[axis] else 0.0
            for axis in AXES[kind]
        ]

    def _element(self, state: State, element: int) -> dict[str, Any]:
        every = self.beams[element]
        kind = self.data.arrays.deformation_class[:, every[0] - 1]
        modes = range(1, int(np.count_nonzero(kind)) + 1)
        e = [[state.deformation(beam, mode) for mode in modes] for beam in every]
        made: dict[str, Any] = {"e": e}
        if self.options.get("stressperelement") and self._has_stress(element):
            self.found.take(made, "stressmax", lambda: self._peak(state, list(every)))
        return made


def _zyx_of(turned: FloatArray) -> list[float]:
    """Angles about z, then the new y, then the new x, of a rotation (3, 3)."""
    sine = min(1.0, max(-1.0, -float(turned[2, 0])))
    return [
        math.atan2(turned[1, 0], turned[0, 0]),
        math.asin(sine) + 0.0,
        math.atan2(turned[2, 1], turned[2, 2]),
    ]


def _system(tables: Tables, state: State) -> dict[str, Any]:
    """The linear system that `transfer_in` and `transfer_out` ask for, as a structure has it."""
    position, _ = numbers_of_points(tables)
    ends = ends_of_transfer(tables)
    sources, sinks = ([end_in_words(position, each) for each in every] for every in ends)
    found = state.state_space(sources, sinks, tables.transfer or 0.0)
    names = ([f"{stem}-{axis} n{point}" for point, stem, axis in every] for every in ends)
    made: dict[str, Any] = {name: getattr(found, name).tolist() for name in "ABCD"}
    return {**made, **dict(zip(("InputName", "OutputName"), names, strict=True))}


def _make_alike(found: _Results) -> None:
    """Give all nodes the same fields: they are an array of structures."""
    for step in found.values["step"]:
        for name in found.missing.keys() & step.keys():
            del step[name]
        gone = {*found.missing, *(["CMloc"] if "CMglob" in found.missing else [])}
        for name in ("node", "element"):
            names = dict.fromkeys(key for each in step[name] for key in each if key not in gone)
            step[name] = [{key: each.get(key, []) for key in names} for each in step[name]]
