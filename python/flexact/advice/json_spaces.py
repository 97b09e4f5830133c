# SPDX-License-Identifier: BSD-3-Clause
"""Freedom and constraint of a body as the JSON has them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..analysis.result import Result
from ..analysis.sentences import filled
from ..core.arrays import FloatArray
from .spaces.families import Family
from .spaces.screw_space import ScrewSpace
from .spaces.spaces import Spaces
from .spaces.words import spaces_lines

Entries = dict[str, Any]


def dictionary_of_spaces(result: Result, spaces: Spaces, wanted: Sequence[str]) -> Entries:
    """The names and values of the JSON, in their order."""
    return {
        "body": spaces.subject.name,
        "wanted": list(wanted),
        "freedom": _space(spaces.freedom),
        "constraint": _space(spaces.constraint),
        "statements": [" ".join(filled(line).split()) for line in spaces_lines(result, spaces)],
    }


def _space(space: ScrewSpace) -> Entries:
    return {
        "dimension": space.dimension,
        "about": space.about.tolist(),
        "basis": space.basis.tolist(),
        "families": [_family(family) for family in space.families],
    }


def _family(family: Family) -> Entries:
    return {
        "kind": family.kind.value,
        "point": family.point.tolist(),
        "direction": _vector(family.direction),
        "normal": _vector(family.normal),
        "pitch": family.pitch,
        "lines": [
            [point.tolist(), along.tolist()]
            for point, along in zip(family.points, family.directions, strict=True)
        ],
    }


def _vector(vector: FloatArray) -> list[float] | None:
    made: list[float] = vector.tolist()
    return made if np.any(vector) else None
