# SPDX-License-Identifier: BSD-3-Clause
"""Declaring what is inside divided sheets and wires, so that each counts as one beam."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ...core.elements import Class
from ..data import ModelData


class Surplus(NamedTuple):
    """Released deformations of one beam of a divided sheet that are inside it."""

    element: int
    """Index of the beam."""
    deformations: tuple[int, ...]
    """From 1."""


def surplus_of(data: ModelData) -> tuple[Surplus, ...]:
    """What is to be declared independent, by element."""
    found = (Surplus(*each) for chain in data.chains for each in chain.surplus)
    return tuple(sorted(found))


def declared(data: ModelData) -> ModelData:
    """The model with all of that independent; the same object where there is nothing."""
    surplus = surplus_of(data)
    if not surplus:
        return data
    classes = data.arrays.deformation_class.copy(order="F")
    for element, deformations in surplus:
        classes[np.array(deformations) - 1, element] = Class.INDEPENDENT
    return replace(data, arrays=data.arrays._replace(deformation_class=classes))
