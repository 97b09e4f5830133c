# SPDX-License-Identifier: BSD-3-Clause
"""What a mesh says of the whole: verdict, counts, names and units, as arrays of numbers.

Text is its bytes in UTF-8, since meshio knows no strings: `bytes(array).decode()`. A list of texts
is one text, each with a newline behind it. `element_number` is one row of them all; in .vtu files
its components have the names of the elements, which ParaView shows, and likewise the verdict has
its words.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from ...analysis.result import Result
from ...analysis.text_margin import verdict_word
from ...analysis.verdict_words import certainty_word

_UNITS = """\
points: m
displacement: m
rotation: rad
motion_k: m
motion_k_rotation: rad
selfstress_k_normal_force: N
selfstress_k_twist_moment: N m
selfstress_k_in_plane_moment: N m
selfstress_k_out_of_plane_moment: N m
margin: m
margin_angle: rad"""
_TEXTS = ("verdict", "certainty", "element_names")
#: ParaView looks through the names of components one by one.
MOST_COMPONENTS = 2_000


def field_data_of(analysis: Result) -> dict[str, NDArray[np.generic]]:
    """The field data of a result's mesh."""
    data, margin = analysis.given, analysis.margin
    lengths = (margin.length, margin.angle)
    return {
        "verdict": as_bytes(verdict_word(analysis)),
        "certainty": as_bytes(certainty_word(analysis)),
        "under_constrained": np.array([analysis.under_constrained]),
        "over_constrained": np.array([analysis.over_constrained]),
        "degrees_of_freedom": np.array([analysis.degrees_of_freedom]),
        **{
            name: np.array([math.inf if size is None else size])
            for name, size in zip(("margin", "margin_angle"), lengths, strict=True)
        },
        "units": as_bytes(_UNITS),
        "element_number": data.arrays.element_number.astype(np.int64)[None],
        "element_names": as_bytes("".join(f"{spelt(name)}\n" for name in data.element_names)),
    }


def as_bytes(text: str) -> NDArray[np.uint8]:
    """A text as an array."""
    return np.frombuffer(text.encode("utf-8", "backslashreplace"), np.uint8)


def spelt(name: str) -> str:
    """A name as VTK can keep it, on a line: without zeros, and such that UTF-8 can spell it."""
    lines = name.replace("\0", "\ufffd").replace("\n", " ")
    return lines.encode("utf-8", "backslashreplace").decode("utf-8")


def component_names(data: Mapping[str, NDArray[np.generic]]) -> dict[str, list[str]]:
    """What ParaView is to call the components of field data: texts as they read, units, names."""
    texts = {name: bytes(data[name].tobytes()).decode() for name in _TEXTS}
    names = texts["element_names"].split("\n")[:-1]
    return {
        "verdict": [texts["verdict"]],
        "certainty": [texts["certainty"]],
        "margin": ["m"],
        "margin_angle": ["rad"],
        "element_number": names if data["element_number"].size <= MOST_COMPONENTS else [],
    }
