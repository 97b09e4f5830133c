# SPDX-License-Identifier: BSD-3-Clause
"""The result of an analysis as the JSON has it: `docs/result.schema.json`."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from typing import Any

from ..util.version import VERSION
from . import json as json_parts
from . import json_mechanics, json_modes
from .json_modes import ModesTable
from .result import Result
from .verdict_words import certainty_word
from .warnings import warnings_of

#: Of the JSON; see `docs/command.md` for when it is raised.
FORMAT = 2

#: Modes are many: they are written one by one.
_MODES: dict[str, Callable[[Result], ModesTable]] = {
    "motions": json_modes.motions,
    "self_stresses": json_modes.self_stresses,
}


def dictionary_of(analysis: Result) -> dict[str, Any]:
    """The names and values of the JSON, in their order."""
    made = _without_modes(analysis)
    for name, modes in _MODES.items():
        made[name] = modes(analysis).dictionaries()
    return made


def text_of(analysis: Result) -> str:
    """The same as one line of text, made without a dictionary for each component."""
    return "".join(_pieces(analysis))


def header(name: str) -> dict[str, Any]:
    """What every object begins with."""
    # Bytes of a path that are no text are escaped, so that any reader of JSON takes it.
    deck = name.encode("utf-8", "backslashreplace").decode("utf-8")
    return {"format": FORMAT, "deck": deck, "flexact": VERSION}


def _pieces(analysis: Result) -> Iterator[str]:
    before = "{"
    for name, value in _without_modes(analysis).items():
        yield f"{before}{json.dumps(name)}: "
        if name in _MODES:
            yield from _MODES[name](analysis).text()
        else:
            yield json.dumps(value, allow_nan=False)
        before = ", "
    yield "}"


def _without_modes(analysis: Result) -> dict[str, Any]:
    """The names and values in their order, with nothing for the modes."""
    return {
        **header(analysis.name),
        **_verdict(analysis),
        **_decision(analysis),
        **_certainty(analysis),
        "parts": json_mechanics.parts(analysis),
        "taken_as_one": json_mechanics.taken_as_one(analysis),
        "internal_motions": json_mechanics.internal_motions(analysis),
        "freedoms": list(json_parts.freedoms(analysis)),
        **_given("motions", analysis.under_constrained, len(analysis.motions)),
        **_given("self_stresses", analysis.over_constrained, len(analysis.self_stresses)),
        "advice": list(json_parts.advice(analysis)),
        "warnings": [item.to_dict() for item in warnings_of(analysis)],
    }


def _verdict(analysis: Result) -> dict[str, Any]:
    """The verdict on the machine, and how far it is from another."""
    return {
        "verdict": analysis.verdict.value,
        "under_constrained": analysis.under_constrained,
        "over_constrained": analysis.over_constrained,
        "margin": json_parts.margin(analysis, analysis.margin),
        "margins": [json_parts.margin(analysis, item) for item in analysis.margins],
        "accuracy": json_parts.accuracy(analysis),
        "degrees_of_freedom": analysis.degrees_of_freedom,
        "counts": {name: part._asdict() for name, part in analysis.counts._asdict().items()},
        "characteristic_length": json_parts.quantity(analysis.characteristic_length, "m"),
    }


def _decision(analysis: Result) -> dict[str, Any]:
    """The rank of D(c), and how it was decided."""
    rows, columns = analysis.raw.largest_component
    return {
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
    }


def _certainty(analysis: Result) -> dict[str, Any]:
    """What is known of the rank: of the arithmetic, not of the machine."""
    proof = analysis.proof
    return {
        "certainty": certainty_word(analysis),
        "proof": proof._asdict() if proof else None,
        "nearly": analysis.nearly._asdict() if analysis.nearly else None,
        "alternatives": [item._asdict() for item in analysis.alternatives],
    }


def _given(name: str, count: int, given: int) -> dict[str, Any]:
    """A place for modes, behind their number if not all of them are given."""
    return {**({f"{name}_given": given} if given < count else {}), name: []}
