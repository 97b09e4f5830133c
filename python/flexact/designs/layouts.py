# SPDX-License-Identifier: BSD-3-Clause
"""A layout: flexures between stage, bodies and ground; its model."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..core.arrays import FloatArray
from ..model.model import Model
from ..util.records import Frozen
from .problem import Problem


@dataclass(frozen=True, eq=False)
class Flexure(Frozen):
    """A flexure of a layout.

    Attributes:
        name: Such as "wire 1"; its part in the model is called so.
        kind: Of `flexact.designs.problem.KINDS`.
        between: The bodies at its two ends: "stage", "ground", or a body between.
        ends: (2, 3) middles of its clamped ends, in the order of `between` [m].
        diameter: Of a wire; 0 otherwise [m].
        width: Breadth of a sheet; 0 otherwise [m].
        thickness: Of a sheet or at the thinnest of a notch; 0 otherwise [m].
        normal: (3,) unit vector across a sheet; zeros otherwise.
        via: (n, 3) places between the ends: of a folded sheet its fold, of a waisted sheet its
            waist, of a rod its notches [m].
        axes: (n, 3) unit vectors: of a folded sheet along its fold, of a rod those of its notches.
    """

    name: str
    kind: str
    between: tuple[str, str]
    ends: FloatArray
    diameter: float = 0.0
    width: float = 0.0
    thickness: float = 0.0
    normal: FloatArray = field(default_factory=lambda: np.zeros(3))
    via: FloatArray = field(default_factory=lambda: np.zeros((0, 3)))
    axes: FloatArray = field(default_factory=lambda: np.zeros((0, 3)))


@dataclass(frozen=True, eq=False)
class Layout(Frozen):
    """Flexures that give a stage the wanted freedom.

    Attributes:
        number: Its place by the rank, from 1.
        what: In words, such as "a sheet and two wires".
        kind: Such as "1 sheet + 2 wire": what differs between kinds of layouts.
        problem: Of what.
        flexures: All of them.
        bodies: Names and attachment points, (n, 3) [m], of bodies between stage and ground.
        model: Its model, with stiffness and mass; the stage is the body "stage", whose first
            point is the centre. The wanted motions are declared at the stage.
        over_constrained: How many self-stresses it has.
        internal: How many declared motions are not of the stage: of folds, of rods between necks.
        freedom_error: Sine of the largest angle between its freedom and the wanted one.
        symmetry: Order of the group of isometries that keep its material, 1 for none.
        alike: How many images under the isometries of the problem it stands for.
        scores: See `flexact.designs.scores`; one beam a flexure.
    """

    number: int
    what: str
    kind: str
    problem: Problem
    flexures: tuple[Flexure, ...]
    bodies: tuple[tuple[str, FloatArray], ...]
    model: Model
    over_constrained: int
    internal: int
    freedom_error: float
    symmetry: int
    alike: int
    scores: dict[str, float]
