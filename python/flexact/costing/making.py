# SPDX-License-Identifier: BSD-3-Clause
"""Make a cost: the designs side by side, each with its tolerances, its stroke and its shapes."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

import numpy as np

from ..diagnostics.errors import ModelError, model_error
from ..model.data import ModelData
from ..result.decompose import asked_for
from ..result.result import Result, result_of
from ..text.places import node_words
from . import proven
from .asked import Asked
from .bench import Bench, Choice, has_masses, require_stiffness
from .designing import Wanted, design_of
from .designs import CostValues, Design, Stroke
from .places import Places
from .proven import Candidate
from .ranking import best
from .values import DIRECTIONS, PLANAR, Clamp, Misalignment, Point, words_of_direction

Progress = Callable[[str, float], None]
Made = TypeVar("Made", bound=CostValues)


def cost_of(
    data: ModelData, asked: Asked, name: str | None, progress: Progress | None, kind: type[Made]
) -> Made:
    """What a design costs; see `flexact.cost`."""
    data.require_sound()
    require_stiffness(data)
    report = progress or (lambda _what, _done: None)
    report("analysing", 0.0)
    result = result_of(data, asked_for("auto", None), name)
    return _Making(result, asked, report).made(kind)
