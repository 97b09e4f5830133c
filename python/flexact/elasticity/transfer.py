# SPDX-License-Identifier: BSD-3-Clause
"""A linear system in words, as JSON and as a table."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from ..core.arrays import FloatArray
from ..util.loading import VERSION
from ..util.text import file_name, harmless, table, wrapped
from .linear_system import FORCE, VELOCITY, LinearSystem, Signal

#: Gains of one unit that are below this part of the largest one are rounding.
ROUNDING = 1e-13
#: Columns of text where nobody says how many there are.
WIDTH = 80
#: Poles and zeros that are told.
_MOST_TOLD = 8
#: Modes of which the frequencies are shown, points of a decade, and by which factor the range goes
#: beyond the slowest and the fastest of these; and the most decades.
_SHOWN, _POINTS, _BEYOND, _DECADES = 6, 100, 5.0, 3.5
#: Points about each resonance, in widths of it.
_NEAR_POLE = np.array([-8.0, -4.0, -2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 4.0, 8.0])
#: The narrowest width, as a part of the frequency.
_NARROW = 1.0e-4


def frequencies_shown(system: LinearSystem) -> FloatArray:
    """(k,) frequencies [Hz] at which the response is drawn: about the first modes, and between."""
    seen = system.acting.any(axis=(0, 1)) & (system.square != 0.0)
    hertz = np.abs(system.frequencies)[seen]
    ratio = system.damping[seen]
    first = float(hertz.min(initial=math.inf))
    if not math.isfinite(first):
        first = 1.0
    near = np.sort(hertz)[:_SHOWN]
    last = min(float(near.max(initial=first)), first * 10.0**_DECADES)
    low, high = first / _BEYOND, last * _BEYOND
    count = int(_POINTS * math.log10(high / low)) + 1
    inside = hertz <= high
    width = hertz[inside] * np.maximum(ratio[inside], _NARROW)
    about = hertz[inside, None] + width[:, None] * _NEAR_POLE
    zeros = [abs(zero) / (2.0 * math.pi) for each in _pairs(system) for zero in each[2].zeros]
    every = np.concatenate([np.geomspace(low, high, count), about.ravel(), np.array(zeros)])
    return np.unique(every[(every >= low) & (every <= high)])


def _pairs(system: LinearSystem) -> Iterator[tuple[int, int, LinearSystem]]:
    for o in range(len(system.outputs)):
        for i in range(len(system.inputs)):
            yield o, i, system.pair(o, i)


def first_line(system: LinearSystem) -> str:
    """The point first: such as "From a force on stage:y to stage:y: 1.2 mm/N at rest, ..."."""
    return sentence(system.pair())


def _acts(signal: Signal) -> str:
    kind = {"N": "a force on ", "N m": "a moment on "}.get(signal.unit, "")
    return f"{kind if signal.kind == FORCE else ''}{signal.label}"


def sentence(pair: LinearSystem, least: float = 0.0) -> str:
    """What one output does with one input: at rest, and at the first resonance.

    Args:
        pair: The two.
        least: A gain at rest that is smaller is rounding.
    """
    (acts,), (sees,) = pair.inputs, pair.outputs
    gain, unit = float(pair.static_gain[0, 0]), pair.gain_units[0][0]
    gain = 0.0 if abs(gain) < least else gain
    at_rest = f"{gain:.4g} {unit}".removesuffix(" 1") + " at rest"
    if not math.isfinite(gain):
        at_rest = "at rest it moves without limit"
    acting = pair.acting[0, 0]
    hertz = pair.frequencies[acting]
    told = "no mode acts"
    if hertz.size and hertz[0] < 0.0:
        told = f"unstable: it grows with {pair.poles[::2][acting][0].real:.4g} 1/s"
    elif (hertz > 0.0).any():
        first = int(np.flatnonzero(hertz > 0.0)[0])
        ratio = pair.damping[acting][first]
        told = f"first resonance {hertz[first]:.4g} Hz, damping {100 * ratio:.3g} %"
    return f"From {_acts(acts)} to {sees.label}: {at_rest}; {told}."


def describe(system: LinearSystem, width: int = WIDTH) -> str:
    """Static gains, poles and zeros for people, in rows of a width."""
    made = [harmless(file_name(system.name))] if system.name else []
    for o, i, pair in _pairs(system):
        made += [wrapped(harmless(sentence(pair, _least(system)[o, i])), width), ""]
        rows = rows_of(pair)
        made += [table(rows, width), ""] if len(rows) > 1 else []
        told = unsaid(pair)
        made += [wrapped(told, width), ""] if told else []
    made.append(wrapped(about(system), width))
    return "\n".join(made)


def _least(system: LinearSystem) -> FloatArray:
    """(outputs, inputs) below which a gain at rest is rounding beside others of its unit."""
    size = np.abs(np.where(np.isfinite(system.static_gain), system.static_gain, 0.0))
    units = np.array(system.gain_units)
    return np.asarray(ROUNDING * np.array([[size[units == u].max() for u in row] for row in units]))


def rows_of(pair: LinearSystem) -> list[tuple[str, ...]]:
    """The first poles that act, and zeros, beside each other, in ascending order."""
    acting = np.flatnonzero(pair.acting[0, 0])
    found = []
    for k in acting[:_MOST_TOLD].tolist():
        found.append((abs(float(pair.frequencies[k])), _pole(pair, k)))
    most = found[-1][0] if found else math.inf
    for zero in pair.zeros[pair.zeros.imag >= 0.0].tolist():
        hertz = abs(zero) / (2.0 * math.pi)
        if hertz <= most * (1.0 + 1e-9):
            found.append((hertz, _zero(zero)))
    found.sort(key=lambda each: each[0])
    return [("", "frequency", "damping", "rad/s"), *(row for _, row in found)]


def _pole(pair: LinearSystem, k: int) -> tuple[str, ...]:
    one, other = pair.poles[2 * k : 2 * k + 2].tolist()
    hertz = float(pair.frequencies[k])
    if hertz == 0.0:
        return "pole, twice", "0 Hz", "", "0"
    if hertz < 0.0:
        return "pole, unstable", "", "", f"{one.real:.5g}, {other.real:.5g}"
    ratio = f"{100 * float(pair.damping[k]):.3g} %"
    if one.imag == 0.0:
        return "pole", f"{hertz:.5g} Hz", ratio, f"{one.real:.5g}, {other.real:.5g}"
    return "pole", f"{hertz:.5g} Hz", ratio, f"{one.real:.4g} +- {one.imag:.6g}i"


def _zero(zero: complex) -> tuple[str, ...]:
    size = abs(zero)
    if size == 0.0:
        return "zero", "0 Hz", "", "0"
    hertz = f"{size / (2.0 * math.pi):.5g} Hz"
    if abs(zero.imag) <= 1e-9 * size:
        return "zero", "", "", f"{zero.real:.5g}"
    ratio = f"{-100 * zero.real / size:.3g} %"
    return "zero", hertz, ratio, f"{zero.real:.4g} +- {zero.imag:.6g}i"


def unsaid(pair: LinearSystem) -> str:
    """What the table leaves out, and zeros that make control hard."""
    acting = pair.acting[0, 0]
    chosen = np.flatnonzero(acting)
    more = chosen.size - min(chosen.size, _MOST_TOLD)
    last = int(chosen[_MOST_TOLD - 1]) + 1 if more else acting.size
    unseen = int(np.count_nonzero(~acting[:last]))
    made = []
    if more:
        made.append(f"{more} more mode{'s' * (more > 1)} above.")
    if unseen:
        among = " among these" if more else ""
        are = f"modes{among} are" if unseen > 1 else f"mode{among} is"
        made.append(f"{unseen} {are} not driven or not seen.")
    right = int(np.count_nonzero(pair.zeros.real > 1e-9 * np.abs(pair.zeros)))
    if right:
        made.append("A zero lies to the right: it limits how fast a loop may be.")
    return " ".join(made)


def about(system: LinearSystem) -> str:
    """How it was found, and how far it may be off."""
    many = system.square.size
    made = f"{harmless(system.label[:1].upper() + system.label[1:])}. "
    if many == system.modes:
        return f"{made}All {many} modes of the mesh."
    first = float(np.min(system.left_out.frequency[: system.modes - many])) / (2.0 * math.pi)
    made += f"{many} of the {system.modes} modes of the mesh, the others by what they do statically"
    hertz = first / 3.0
    worst: list[float] = []
    gain = np.abs(system.static_gain)
    with np.errstate(divide="ignore", invalid="ignore"):
        bound = np.where(gain < _least(system), 0.0, system.error_bound(hertz) / gain)
    for o, out in enumerate(system.outputs):
        worst += [] if out.kind == VELOCITY else bound[o][np.isfinite(bound[o])].tolist()
    if worst:
        made += (
            f": up to {hertz:.3g} Hz, a third of the first of them, at most "
            f"{100 * max(worst):.2g} % of the gain at rest is missing"
        )
    return f"{made}."


# -- JSON and tables ----------------------------------------------------------------------------

#: Of the JSON; raised where an entry is taken away, renamed, or means something else.
FORMAT = 1


def dictionary_of(system: LinearSystem) -> dict[str, Any]:
    """The names and values of the JSON, in their order; what is infinite is null."""
    hertz = frequencies_shown(system)
    response = system.response(hertz)
    pairs = []
    for o, i, pair in _pairs(system):
        pairs.append(
            {
                "input": i + 1,
                "output": o + 1,
                "unit": system.gain_units[o][i],
                "static_gain": _plain(pair.static_gain)[0][0],
                "modes": (np.flatnonzero(pair.acting[0, 0]) + 1).tolist(),
                "zeros": _complex(pair.zeros),
                "response": _complex(response[:, o, i]),
            }
        )
    return {
        "format": FORMAT,
        "deck": system.name.encode("utf-8", "backslashreplace").decode("utf-8"),
        "flexact": VERSION,
        "units": system.units.name,
        "state": system.label,
        "inputs": [signal_of(system, each) for each in system.inputs],
        "outputs": [signal_of(system, each) for each in system.outputs],
        "modes_of_mesh": system.modes,
        "frequencies": system.frequencies.tolist(),
        "damping": system.damping.tolist(),
        "poles": _complex(system.poles),
        "B": system.B.tolist(),
        "C": system.C.tolist(),
        "D": system.D.tolist(),
        "response_at": hertz.tolist(),
        "pairs": pairs,
    }


def signal_of(system: LinearSystem, each: Signal) -> dict[str, str]:
    """What it is called, its kind, and its unit in those of the system."""
    length = each.unit.removesuffix("/s")
    unit = system.units.symbol(length) + ("/s" if length != each.unit else "")
    return {"label": each.label, "kind": each.kind, "unit": unit}


def _complex(values: np.ndarray) -> list[list[float | None]]:
    """[real, imaginary] of each; null where it is infinite."""
    return [list(_plain(np.array([each.real, each.imag]))) for each in values]


def _plain(values: FloatArray) -> Any:
    return np.where(np.isfinite(values), values, None).tolist()  # type: ignore[call-overload]


def text_of(system: LinearSystem) -> str:
    """The same as one line of text."""
    return json.dumps(dictionary_of(system), allow_nan=False)


def csv_text(system: LinearSystem) -> str:
    """The frequency response, a row a frequency of each input and output."""
    rows = io.StringIO()
    writer = csv.writer(rows, lineterminator="\n")
    writer.writerow(
        ("input", "output", "frequency_hz", "gain", "unit", "phase_deg", "real", "imaginary")
    )
    hertz = frequencies_shown(system)
    response = system.response(hertz)
    for o, i, _ in _pairs(system):
        ends = system.inputs[i].label, system.outputs[o].label
        for f, value in zip(hertz.tolist(), response[:, o, i].tolist(), strict=True):
            angle = math.degrees(math.atan2(value.imag, value.real))
            unit = system.gain_units[o][i]
            writer.writerow((*ends, f, abs(value), unit, angle, value.real, value.imag))
    return rows.getvalue()
