# SPDX-License-Identifier: BSD-3-Clause
"""A cause that is named is enough: what has it, and is random besides, moves as well.

Of the spider, Bricard's loop and chains of Sarrus it is known by what (Hunt, *Kinematic Geometry
of Mechanisms*, 1978; Bricard, Journal de mathématiques 3, 1897).
"""

from __future__ import annotations

import sys
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from known_models import ring
from reference_decks import text_of

sys.path.append(str(Path(__file__).resolve().parents[1]))

from attack.advised import of_causes

import flexact
from flexact import Analysis, Model
from flexact.advice.causes.cause import Cause, CauseKind, LineKind, RelationKind


def special(result: Analysis) -> Cause:
    """The first self-stress or motion that is special and has a named cause."""
    causes = result.advice().causes
    every = (*causes.self_stresses, *causes.motions)
    return next(one for one in every if one.kind is CauseKind.SPECIAL and one.relations)


def kinds(result: Analysis) -> list[tuple[RelationKind, LineKind, int]]:
    return [(one.kind, one.of, len(one.parts)) for one in special(result).relations]


def spider(lifted: float = 0.0) -> Model:
    """Six flat arms in one plane between a rim and a hub, which is driven along z."""
    model, ends = Model(), []
    for k in range(6):
        x, y = np.cos(np.pi * k / 3), np.sin(np.pi * k / 3)
        rim = (0.1 * x, 0.1 * y, lifted * (k == 2))
        model.sheet(rim, (0.03 * x, 0.03 * y, 0), width=(-y, x, 0), name=f"arm {k + 1}")
        model.fix(rim)
        ends.append((0.03 * x, 0.03 * y, 0))
    model.body(ends, name="hub")
    model.independent(ends[0], "z")
    return model


def test_all_arms_of_a_spider_lie_in_one_plane() -> None:
    """With one of them lifted out of it the hub turns no more."""
    assert flexact.analyse(spider(0.01)).under_constrained == 0
    assert kinds(flexact.analyse(spider())) == [("one plane", "sheet", 6)]


def looped(places: np.ndarray, axes: np.ndarray) -> Model:
    """Hinges and links from one clamped end to the other."""
    model = Model()
    here = model.node(*places[0])
    model.fix(here)
    for k, axis in enumerate(axes):
        here = model.hinge(here, axis, name=f"joint {k + 1}")
        if k + 1 < len(axes):
            there = model.node(*places[k + 1])
            model.beam(here, there, name=f"link {k + 1}")
            here = there
    model.fix(here)
    return model


@pytest.mark.parametrize("seed", range(3))
def test_a_half_turn_lets_a_loop_of_bricard_move(seed: int) -> None:
    """Not that its axes are of one linear complex, by which a motion only begins."""
    rng = np.random.default_rng(seed)
    places, axes = rng.normal(size=(2, 3, 3))
    turn = np.diag([-1.0, -1.0, 1.0])
    both = np.vstack((places, places @ turn)), np.vstack((axes, axes @ turn))
    result = flexact.analyse(looped(*both))
    assert (result.under_constrained, result.over_constrained) == (1, 1)
    (relation,) = special(result).relations
    assert (relation.kind, relation.of, relation.fold) == (
        *("rotation", "axis"),
        2,
    )
    np.testing.assert_allclose(np.abs(relation.direction), (0, 0, 1), atol=1e-9)


def sarrus(turned: float = 0.0) -> Model:
    """Three chains of three parallel hinges, all across z; in one of them one axis is turned."""
    model = Model()
    ends = []
    for k, angle in enumerate((0.0, 1.6, 4.1)):
        out, axis = np.array([np.cos(angle), np.sin(angle), 0]), [-np.sin(angle), np.cos(angle), 0]
        bent = turned * (k == 0) + angle
        places = [share * out + np.array([0, 0, z]) for share, z in ((1, 0), (1.5, 0.5), (1, 1.4))]
        here = model.node(*places[0])
        model.fix(here)
        for j in range(3):
            way = [-np.sin(bent), np.cos(bent), 0] if j == 1 else axis
            here = model.hinge(here, way)
            if j < 2:
                there = model.node(*places[j + 1])
                model.beam(here, there)
                here = there
        ends.append(here)
    model.body(ends, name="platform")
    return model


def test_chains_of_sarrus_are_parallel_by_threes() -> None:
    """That all axes lie across z is not enough: with one of them turned about z nothing moves."""
    assert flexact.analyse(sarrus(0.3)).under_constrained == 0
    result = flexact.analyse(sarrus())
    assert result.under_constrained == 1
    found = Counter((kind, count) for kind, _, count in kinds(result))
    assert found == {("parallel", 3): 3, ("across", 9): 1}


def test_a_sheet_by_itself_is_special_beside_what_is_declared() -> None:
    """Its in-plane rotation is declared about z, and its normal is along z."""
    model = Model()
    model.sheet((0, 0, 0), (0.1, 0, 0), width=(0, 1, 0), name="sheet")
    model.fix((0, 0, 0))
    model.body([(0.1, 0, 0), (0.1, 0.05, 0)], name="body")
    model.independent((0.1, 0, 0), "rz")
    result = flexact.analyse(model)
    assert result.over_constrained == 1
    (relation,) = special(result).relations
    assert (relation.kind, relation.of) == ("along", "sheet")
    np.testing.assert_allclose(relation.direction, (0, 0, 1))
    words = result.advice().describe()
    assert "sheet lies across z" in " ".join(words.split())


#: Decks of which a cause is named, of each kind.
NAMED = (
    "flexures/six_folded_sheets_undeclared",
    "paper/five_folded_sheets_symmetric",
    "flexures/five_wires_lower_two_parallel",
    "paper/twelve_trusses",
    "frameworks/collinear_bars_plane",
    "frameworks/collinear_bars_space",
    "frameworks/prism_twist_30",
    "frameworks/k33_circle",
    "frameworks/k33_two_lines",
    "frameworks/octahedral_platform_yaw_90",
    "linkages/bennett",
    "linkages/four_bar_in_space",
    "linkages/parallelogram_three_cranks",
    "linkages/sarrus",
)


@pytest.mark.parametrize("name", NAMED)
def test_named_causes_keep_what_they_cause(name: str) -> None:
    """In 20 random geometries that have them, and nothing else."""
    result = flexact.analyse(flexact.read_text(text_of(name), name))
    assert special(result).relations
    assert list(of_causes(result, result.advice(), Counter())) == []


def test_a_ring_keeps_its_motion_by_its_symmetry() -> None:
    result = flexact.analyse(ring(4))
    assert list(of_causes(result, result.advice(), Counter())) == []
