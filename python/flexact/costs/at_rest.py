# SPDX-License-Identifier: BSD-3-Clause
"""Where a mechanism rests under its loads: sag, stress, margin to buckling, pull and push."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..analysis.naming import Named, plain, together_in_words
from ..analysis.places import direction_words, node_words, part_words
from ..analysis.result import Result
from ..core.elements import Class, NodeKind
from ..elasticity import Estimate, State, StrokeError, elastic
from ..elasticity.stresses import carried_by
from ..model.model import Model
from ..model.parts.parts import PartKind
from ..util.errors import FlexactError
from ..util.matrices import first_largest
from ..util.records import Frozen
from .designs import Number, in_words

#: Of more elements it would no longer be a glance; of more than these one beam a sheet is enough.
_MOST, _MOST_DIVIDED = 600, 60
#: That it buckles at so many times its loads is not told.
_FAR = 1.0e3
#: A direction is told without components below this part of it.
_ALONG = 0.02
#: Forces below this part of the largest pull or push of a wire are none, as motions are.
_NOTHING = 1.0e-3


@dataclass(frozen=True, eq=False)
class AtRest(Frozen):
    """A mechanism under its loads.

    Attributes:
        loads: What they are: "its weight", "its loads", or both.
        why: Why it does not rest, where it does not; then nothing else is known.
        what: What moves most, in words; empty where nothing moves.
        sag: (3,) by how far [m].
        stress: The largest stress of von Mises [Pa]; None where no section is known.
        part: The part that has it, in words.
        share: That stress as a part of the strength; None where that is not known.
        buckles: At how many times these loads it buckles; infinite where at none.
        is_stable: Whether it has not buckled already.
        pulled: Names of wires and bars in tension, with what the most pulled carries [N].
        pushed: Of those in compression, likewise.
        slack: Of those that carry nothing.
    """

    loads: str
    why: str = ""
    what: str = ""
    sag: tuple[float, ...] = (0.0, 0.0, 0.0)
    stress: float | None = None
    part: str = ""
    share: float | None = None
    buckles: float = np.inf
    is_stable: bool = True
    pulled: tuple[tuple[str, ...], float] = ((), 0.0)
    pushed: tuple[tuple[str, ...], float] = ((), 0.0)
    slack: tuple[str, ...] = ()


def at_rest(result: Result) -> AtRest | None:
    """A model with loads and stiffness under them; None of others, and of very large ones."""
    data = result.given
    is_small = data.arrays.element_number.size <= _MOST
    if data.loads is None or not data.has_stiffness or not is_small:
        return None
    forces = bool(data.loads.force.any() or data.loads.increment.any())
    beams: int | str = "auto" if data.arrays.element_number.size <= _MOST_DIVIDED else 1
    model = replace(elastic(Model.from_data(data), beams=beams), is_si=True)
    weight = bool(data.loads.gravity.any()) and model.has_mass
    if not (weight or forces):
        return None
    loads = " and ".join(["its weight"] * weight + ["its loads"] * forces)
    try:
        loose = model.undeformed().loose
        if loose and result.with_internal_declared is None:
            return AtRest(loads, f"nothing resists the motion {loose[0]}")
        return _found(result, model.equilibrium(), loads)
    except StrokeError as error:
        part = f"{100.0 * error.reached:.2g} %"
        return AtRest(loads, f"beyond {part} of that it buckles, snaps or is held by nothing")
    except FlexactError:
        return None


def _found(result: Result, state: State, loads: str) -> AtRest:
    data, parts = result.given, result.parts
    arrays = data.arrays
    # How far places are from where they are without loads.
    way = state.best(lambda at: at.solver.mesh.own_nodes(at.raw.configuration))
    moved = np.where(arrays.node_kind <= NodeKind.POSITION, way[:3] - arrays.node_value[:3], 0.0)
    free = (arrays.coordinate_class != Class.FIXED).any(axis=0)
    size = np.where(free, np.linalg.norm(moved, axis=0), 0.0)
    most = first_largest(size)
    body = parts.body_at.get(most) if size.any() else None
    what = ""
    if size.any():
        what = node_words(parts, most) if body is None else part_words(parts.of_body(body))
    sections = state.finest.solver.sections
    known = np.flatnonzero(sections.is_known & state.model.policy.stiff.any(axis=0))
    stress, part, share = None, "", None
    if known.size:
        peaks = state.best(lambda at: at.peaks.von_mises[2, known])
        first = first_largest(peaks)
        stress, part = float(peaks[first]), part_words(parts.of_element(int(known[first])))
        if data.properties is not None:
            strength = float(data.properties.strength[known[first], 0])
            share = stress / strength if strength > 0.0 else None
    every = [each.multipliers for each in state.alone]
    positive = [float(values[values > 0.0].min(initial=np.inf)) for values in every]
    pulled, pushed, slack = _wires(result, state)
    return AtRest(
        *(loads, "", what, tuple(moved[:, most].tolist())),
        *(stress, part, share, float(Estimate.of(*positive))),
        *(state.is_stable, pulled, pushed, slack),
    )


_Carrying = tuple[tuple[str, ...], float]


def _wires(result: Result, state: State) -> tuple[_Carrying, _Carrying, tuple[str, ...]]:
    """Wires and bars that are pulled and pushed, and those that carry nothing."""
    parts = [each for each in result.parts.all if each.kind in (PartKind.WIRE, PartKind.BAR)]
    normal = state.best(lambda at: carried_by(result.given, at.stress).normal)
    force = np.array([normal[list(each.elements)].mean() for each in parts])
    least = _NOTHING * float(np.abs(force).max(initial=0.0))

    def told(chosen: np.ndarray) -> tuple[str, ...]:
        return tuple(part_words(parts[k]) for k in np.flatnonzero(chosen).tolist())

    pulled, pushed = force > least, force < -least
    return (
        (told(pulled), float(force.max(initial=0.0))),
        (told(pushed), float(-force.min(initial=0.0)) + 0.0),
        told(~pulled & ~pushed) if least else (),
    )


def at_rest_in_words(result: Result) -> str:
    """A sentence on what `at_rest` finds; empty where it finds nothing."""
    rest = at_rest(result)
    if rest is None:
        return ""
    if rest.why:
        return f"Under {rest.loads} it does not come to rest: {rest.why}."
    told = []
    way = np.array(rest.sag)
    far = float(np.linalg.norm(way))
    way = np.where(np.abs(way) > _ALONG * far, way, 0.0)
    if rest.what:
        told.append(f"{rest.what} moves by {_said(far, 'm')} along {direction_words(way)}")
    if rest.stress is not None:
        of = "" if rest.share is None else f" ({100.0 * rest.share:.3g} % of the strength)"
        told.append(f"the largest stress is {_said(rest.stress, 'Pa')} in {rest.part}{of}")
    if not rest.is_stable:
        told.append("it has buckled")
    elif rest.buckles < _FAR:
        told.append(f"it buckles at {rest.buckles:.3g} times the stress of these loads")
    for (names, force), word in ((rest.pulled, "tension"), (rest.pushed, "compression")):
        if names:
            told.append(f"{_listed(names)} in {word} ({_most(names)}{_said(force, 'N')})")
    if rest.slack:
        told.append(f"{_listed(rest.slack)} not loaded")
    return f"Under {rest.loads}: {'; '.join(told)}." if told else ""


def _listed(names: tuple[str, ...]) -> str:
    named = [Named("element", 0, each) for each in names]
    return f"{plain(together_in_words(named))} {'are' if len(names) > 1 else 'is'}"


def _most(names: tuple[str, ...]) -> str:
    return "up to " if len(names) > 1 else ""


def _said(value: float, unit: str) -> str:
    return in_words(Number(float(f"{value:.3g}")), unit)


def json_of(result: Result) -> dict[str, Any] | None:
    """What the words say, as the JSON has it; None where nothing is known."""
    rest = at_rest(result)
    if rest is None:
        return None

    def quantity(value: float | None, unit: str) -> dict[str, Any] | None:
        return None if value is None else {"value": value, "unit": unit}

    return {
        "loads": rest.loads,
        "why": rest.why,
        "moves_most": rest.what,
        "moves": {"value": list(rest.sag), "unit": "m"},
        "largest_stress": quantity(rest.stress, "Pa"),
        "part": rest.part,
        "share_of_strength": rest.share,
        "buckles_at": rest.buckles if np.isfinite(rest.buckles) else None,
        "stable": rest.is_stable,
        "tension": {"parts": list(rest.pulled[0]), "most": quantity(rest.pulled[1], "N")},
        "compression": {"parts": list(rest.pushed[0]), "most": quantity(rest.pushed[1], "N")},
        "not_loaded": list(rest.slack),
    }
