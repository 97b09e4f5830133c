# SPDX-License-Identifier: BSD-3-Clause
"""What is said to be true of the STEP files of tests/cad is: solids, counts, sizes."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("OCP")
sys.path.append(str(Path(__file__).resolve().parents[1]))

from cad import shapes
from cad.designs import CASES
from cad.truth import Bent, Notch, Sheet, Wire, counts


@pytest.mark.parametrize("name", CASES)
def test_counts_are_those_of_lines_of_constraint(name: str) -> None:
    """By hand, beside each design, and by the rank of what its flexures hold."""
    truth = CASES[name]().truth
    if truth.over >= 0:
        assert counts(truth) == (truth.motions + truth.inner, truth.over)


@pytest.mark.parametrize("name", CASES)
def test_solids_are_valid_and_bodies_where_they_are_said_to_be(name: str) -> None:
    made = CASES[name]()
    assert all(shapes.is_valid(shape) and shapes.volume(shape) > 0 for _, shape in made.parts)
    for place in made.truth.bodies.values():
        assert any(shapes.is_inside(shape, place) for _, shape in made.parts)


@pytest.mark.parametrize("name", CASES)
def test_flexures_are_where_they_are_said_to_be(name: str) -> None:
    """In the middle of each there is a solid as thick as is said, and no thicker."""
    made = CASES[name]()
    places = [turn for _, _, turn in made.copies]
    solids = [shape for _, shape in made.parts]
    solids += [shapes.turned(shape, turn) for turn in places for _, shape in made.parts]
    # Of what is told to be in doubt nothing is asked.
    for each in made.truth.flexures if made.truth.over >= 0 else ():
        if isinstance(each, Notch):
            along = np.cross(each.axis, _side(each, made))
            at, half, normal = np.asarray(each.middle), each.thickness / 2, along
        elif isinstance(each, Bent):
            p, q = map(np.asarray, each.corners[:2])
            at, half = (p + q) / 2, each.thickness / 2
            normal = np.cross(q - p, each.across)
        elif isinstance(each, Wire):
            p, q = map(np.asarray, (each.p, each.q))
            at, half = p + 0.1 * (q - p), min(each.sides) / 2
            normal = np.cross(q - p, (0.36, 0.48, 0.8))
        else:
            assert isinstance(each, Sheet)
            p, q = map(np.asarray, (each.p, each.q))
            at, half = p + 0.1 * (q - p), each.thickness / 2
            normal = np.cross(q - p, each.across)
        normal = normal / np.linalg.norm(normal)
        for s in (-1, 1):
            assert any(shapes.is_inside(solid, at + 0.98 * s * half * normal) for solid in solids)
            assert not any(
                shapes.is_inside(solid, at + 1.02 * s * half * normal) for solid in solids
            )


def _side(notch: Notch, made: object) -> np.ndarray:
    """Along a notch: to the middle of the link that it is at."""
    link = next(name for name in notch.between if name.startswith("link"))
    return np.subtract(made.truth.bodies[link], notch.middle)  # type: ignore[attr-defined]
