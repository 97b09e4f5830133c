# SPDX-License-Identifier: BSD-3-Clause
"""A design on the bench: its elastic model, its state at rest, and what pushes it off."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from ..advice.change import Change
from ..core import elastic as core
from ..core.arrays import FloatArray
from ..core.elements import Class, NodeKind
from ..diagnostics.errors import model_error
from ..model.data import ModelData
from ..model.model import Model
from ..model.properties import Properties
from ..stiffness import Elastic, State, elastic
from .asking import ReleaseAsked
from .values import Misalignment


class Choice(NamedTuple):
    """What is made of a model."""

    held: str
    drive: str
    beams: int | str


def require_stiffness(data: ModelData) -> None:
    """Raise where no element has a stiffness.

    Raises:
        ModelError: none has.
    """
    given = data.properties
    if given is None or not bool((np.nan_to_num(given.stiffness) > 0.0).any()):
        raise model_error(
            "no-stiffness",
            "what it costs needs stiffness, and the model gives none",
            "state ESTIFF for each flexible element behind the END of the kinematics (of a beam "
            "EA, G It, E Iy, E Iz), or give sheets a material in Python",
        )


def has_masses(data: ModelData) -> bool:
    """Whether any mass is given, so that there are frequencies."""
    given = data.properties
    return given is not None and any(
        bool((np.nan_to_num(part) > 0.0).any()) for part in (given.mass, given.node_mass)
    )


def with_unit_mass(data: ModelData, node: int) -> ModelData:
    """The model with the mass 1 kg, or inertia 1 kg m^2, at one node by its index, and no other.

    Its lowest squared frequency is the lowest stiffness of that node.
    """
    assert data.properties is not None
    mass = np.full_like(data.properties.node_mass, math.nan)
    if data.arrays.node_kind[node] == NodeKind.ORIENTATION:
        mass[node] = (1.0, 0.0, 0.0, 1.0, 0.0, 1.0)
    else:
        mass[node, 0] = 1.0
    given = data.properties
    none = np.full_like(given.mass, math.nan)
    return replace(data, properties=Properties(given.stiffness, none, mass))


class Level:
    """A design with one number of beams: what the core says of errors in proportion."""

    def __init__(self, bench: Bench, number: int) -> None:
        """Keep the bench, and which of its meshes it is."""
        self.bench = bench
        self.solution = bench.measured.undeformed().finest if False else bench.solution(number)


class Bench:
    """A design and what is asked of it."""
