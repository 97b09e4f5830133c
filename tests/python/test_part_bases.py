# SPDX-License-Identifier: BSD-3-Clause
"""The bases in which motions and self-stresses are told.

They span the null spaces, are as sparse over parts as a search through all sets of parts shows
that any can be, and do not depend on how a mechanism is numbered, on ends p and q, or on the sense
of a width.
"""

from collections.abc import Sequence
from itertools import combinations

import numpy as np
import pytest
from known_models import folded_sheet, frame
from part_models import (
    EX,
    EZ,
    HERE,
    PLACES,
    Place,
    Placed,
    cross_hinge,
    guide,
    turn_about,
    wires_on_a_helix,
)
from reference_decks import NAMES, ROOT

import flexact
from flexact import Analysis, Model, analyse
from flexact.analysis import result as results
from flexact.analysis import sparse_basis as group_sparse
from flexact.analysis.decomposition import column_weights, row_duals, row_factors, row_weights
from flexact.analysis.sparse_basis import columns_of, pieces_of
from flexact.core.arrays import Basis
from flexact.core.elements import Dual

_KNOWN: dict[str, Analysis] = {}


def deck(name: str) -> Analysis:
    if name not in _KNOWN:
        _KNOWN[name] = analyse(ROOT / "input_decks" / f"{name}.dat")
    return _KNOWN[name]


def largest_angle(one: np.ndarray, other: np.ndarray) -> float:
    """Sine of the largest principal angle between two spaces, given by columns."""
    q, r = (np.linalg.qr(columns)[0] for columns in (one, other))
    return float(np.linalg.norm(q - r @ (r.T @ q), 2))


def words(analysis: Analysis) -> list[str]:
    """All that is said of bodies and parts."""
    said = [str(moving) for motion in analysis.motions for moving in motion.bodies]
    for stress in analysis.self_stresses:
        said += [str(part) for part in stress.parts]
        said += [str(conflict) for conflict in stress.conflicts]
    return said


# The same space, the largest one ---------------------------------------------


@pytest.mark.parametrize("name", NAMES)
def test_bases_span_the_null_spaces(name: str) -> None:
    analysis = deck(name)
    for basis, space, weights in (
        (analysis.motion_basis, analysis.motion_space, column_weights(analysis)),
        (analysis.stress_basis, analysis.stress_space, row_weights(analysis)),
    ):
        assert basis.vectors == space.vectors
        if basis.vectors:
            weighted = basis.toarray() * weights[:, None]
            assert largest_angle(weighted, space.toarray()) < 1e-12
            unit = weighted / np.linalg.norm(weighted, axis=0)
            assert np.linalg.cond(unit) < 1e3


@pytest.mark.parametrize("name", NAMES)
def test_the_largest_is_one(name: str) -> None:
    analysis = deck(name)
    for motion in analysis.motions:
        inner = {node for part in motion.internal_to for node in _inner(analysis, part.elements)}
        outside = [n for n in range(len(motion.displacement)) if n not in inner]
        chosen = slice(None) if motion.is_internal else outside
        moved = np.linalg.norm(motion.displacement[chosen], axis=1).max()
        turned = np.linalg.norm(motion.rotation[chosen], axis=1).max()
        rotation = turned * analysis.characteristic_length
        assert (moved if moved >= rotation * (1 - 1e-9) else turned) == pytest.approx(1.0)
    is_force = row_duals(analysis) == Dual.FORCE
    for stress in analysis.self_stresses:
        values = np.abs(stress.vector) * row_factors(analysis)
        force, moment = values[is_force].max(initial=0.0), values[~is_force].max(initial=0.0)
        as_force = moment / analysis.characteristic_length
        assert (force if force >= as_force * (1 - 1e-9) else moment) == pytest.approx(1.0)


def _inner(analysis: Analysis, elements: Sequence[int]) -> set[int]:
    chains = [c for c in analysis.given.chains if set(c.elements) <= set(elements)]
    return {n for c in chains for n in (*c.positions[1:-1], *c.orientations[1:-1])}


def test_what_the_numerics_use_stays_orthonormal() -> None:
    analysis = deck("paper/folded_sheet_free")
    space = analysis.motion_space.toarray()
    assert np.abs(space.T @ space - np.eye(6)).max() < 1e-14
    raw = analysis.raw.motions.toarray()
    assert np.abs(raw.T @ raw - np.eye(6)).max() < 1e-14


def test_analyse_makes_no_basis(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> Basis:
        raise AssertionError("the basis is made")

    monkeypatch.setattr(results, "motion_basis", fail)
    monkeypatch.setattr(results, "stress_basis", fail)
    analysis = analyse(guide())
    assert analysis.margin and analysis.certainty and analysis.verdict
    with pytest.raises(AssertionError, match="the basis is made"):
        _ = analysis.motions[0].vector


def test_large_spaces_are_those_of_the_core_scaled(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(flexact.analysis.mode_basis, "_MOST_VECTORS", 1)
    analysis = analyse(frame(1.0))
    raw, basis = analysis.raw.stresses.toarray(), analysis.stress_basis.toarray()
    scale = basis[np.abs(raw).argmax(axis=0), range(6)] / np.abs(raw).max(axis=0)
    assert basis == pytest.approx(raw * scale * np.sign(raw[np.abs(raw).argmax(axis=0), range(6)]))
    physical = np.abs(basis * row_factors(analysis)[:, None])
    assert physical.max(axis=0).min() >= 1.0 - 1e-12


# As sparse as can be ---------------------------------------------------------


def least_costs(space: np.ndarray, groups: list[np.ndarray]) -> list[int]:
    """Numbers of groups of a sparsest basis, by all sets of groups: a matroid's greedy choice."""
    count, dimension = len(groups), space.shape[1]
    costs: list[int] = []
    spanned = np.zeros((dimension, 0))
    for size in range(count + 1):
        for chosen in combinations(range(count), size):
            zero = [space[groups[i]] for i in range(count) if i not in chosen]
            matrix = np.concatenate([np.zeros((1, dimension)), *zero])
            _, values, right = np.linalg.svd(matrix)
            null = right[np.count_nonzero(values > 1e-9) :].T
            both = np.concatenate([spanned, null], axis=1)
            rank = np.linalg.matrix_rank(both, tol=1e-7)
            if rank > spanned.shape[1]:
                costs += [size] * (rank - spanned.shape[1])
                spanned = np.linalg.svd(both)[0][:, :rank]
            if rank == dimension:
                return costs
    raise AssertionError("the space is spanned by all groups")


def supports(space: np.ndarray, groups: list[np.ndarray]) -> list[int]:
    sizes = np.abs(space).max(axis=0)
    return sorted(
        sum(np.abs(space[group, k]).max(initial=0.0) > 1e-9 * sizes[k] for group in groups)
        for k in range(space.shape[1])
    )


def planted(
    seed: int, count: int, dimension: int, rows: int
) -> tuple[np.ndarray, list[np.ndarray]]:
    """A random space that sparse vectors of random groups span."""
    random = np.random.default_rng(seed)
    groups = [np.arange(rows * i, rows * (i + 1)) for i in range(count)]
    space = np.zeros((rows * count, dimension))
    for k in range(dimension):
        for i in random.choice(count, random.integers(1, 4), replace=False):
            space[groups[i], k] = random.normal(size=rows)
    mixed = space @ random.normal(size=(dimension, dimension))
    rank = np.linalg.matrix_rank(mixed)
    return np.linalg.svd(mixed)[0][:, :rank], groups


@pytest.mark.parametrize("rows", [1, 2, 6])
@pytest.mark.parametrize("seed", range(12))
def test_no_basis_is_sparser(seed: int, rows: int) -> None:
    space, groups = planted(seed, 7, 2 + seed % 4, rows)
    pieces = pieces_of(space, groups, [(1,)] * len(groups), lambda left: left)
    found = columns_of(pieces, len(space))
    assert largest_angle(found, space) < 1e-12
    assert sorted(supports(found, groups)) == least_costs(space, groups)
    for piece in pieces:
        for vector in piece.vectors.T:
            reached = [i for i, rows in enumerate(groups) if np.abs(vector[rows]).max() > 1e-9]
            assert set(reached) <= set(piece.support)


@pytest.mark.parametrize("seed", range(12))
def test_the_descent_finds_planted_vectors_too(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(group_sparse, "_MOST_CUTS", 0)
    space, groups = planted(seed, 7, 2 + seed % 4, 2)
    found = columns_of(pieces_of(space, groups, [(1,)] * 7, lambda left: left), len(space))
    assert largest_angle(found, space) < 1e-12
    assert sum(supports(found, groups)) <= sum(least_costs(space, groups)) + 1


def test_a_space_that_is_too_large_to_search_is_spanned() -> None:
    random = np.random.default_rng(1)
    space = np.linalg.qr(random.normal(size=(80, 30)))[0]
    groups = [np.arange(2 * i, 2 * i + 2) for i in range(40)]
    found = columns_of(pieces_of(space, groups, [(1,)] * 40, lambda left: left), 80)
    assert found.shape == (80, 30) and largest_angle(found, space) < 1e-12


def hexapod(wires: int, place: Place = HERE) -> Model:
    """A platform on many wires in general places, a little less over-constrained each."""
    random = np.random.default_rng(11)
    points: dict[str, Sequence[float]] = {"middle": (0.0, 0.0, 0.05)}
    for k in range(wires):
        at = random.normal(size=3)
        points[f"body {k}"] = at * [0.03, 0.03, 0.005] + [0, 0, 0.05]
        points[f"ground {k}"] = random.normal(size=3) * [0.05, 0.05, 0.01]
    made = Placed(place, points)
    made.body(["middle", *(f"body {k}" for k in range(wires))], "platform")
    for k in range(wires):
        made.wire(f"ground {k}", f"body {k}", f"wire {k + 1}")
        made.fix(f"ground {k}")
    return made.model


@pytest.mark.parametrize("wires", [7, 8, 9, 10])
def test_self_stresses_of_a_platform_on_wires(wires: int) -> None:
    # Any seven wires in general places have one self-stress; the first ones by name are told.
    analysis = analyse(hexapod(wires))
    assert analysis.over_constrained == wires - 6
    names = [sorted(int(str(p.part).split()[1]) for p in s.parts) for s in analysis.self_stresses]
    assert all(len(wires_of_one) == 7 for wires_of_one in names)
    assert names == [[1, 2, 3, 4, 5, 6, k] for k in range(7, wires + 1)]


@pytest.mark.parametrize("sheets", [3, 4, 6])
def test_sheets_in_parallel_fight_in_pairs(sheets: int) -> None:
    analysis = analyse(guide(sheets=sheets))
    # Each holds three ways, and five of six motions of the stage are to be held.
    assert analysis.over_constrained == 3 * sheets - 5
    pairs = [tuple(sorted(str(p.part) for p in s.parts)) for s in analysis.self_stresses]
    constant = [
        pair
        for pair, stress in zip(pairs, analysis.self_stresses, strict=True)
        if len(pair) == 2 and all(part.is_constant_bending for part in stress.parts)
    ]
    assert constant == [("sheet 1", f"sheet {k}") for k in range(2, sheets + 1)]


def test_other_names_give_other_pairs_that_are_the_same_but_for_names() -> None:
    first = words(analyse(guide(sheets=3, names=["left 1", "left 2", "left 3"])))
    again = words(analyse(guide(sheets=3, names=["hold 1", "hold 2", "hold 3"])))
    assert [line.replace("left", "hold") for line in first] == again


def test_motions_of_a_free_sheet_move_as_little_as_can_be() -> None:
    analysis = analyse(folded_sheet(clamped=False))
    moved = [[moving.names for moving in motion.bodies] for motion in analysis.motions]
    # The end alone four times, the fold alone once, both together, or the end by the fold.
    assert sorted(len(each) for each in moved)[:5] == [1, 1, 1, 1, 1]


def free_body(place: Place = HERE) -> Model:
    """A body that nothing holds but a wire along z."""
    points = {"foot": (0, 0, -0.1), "a": (0, 0, 0), "b": (0.1, 0, 0), "c": (0, 0.1, 0)}
    made = Placed(place, points)
    made.body(["a", "b", "c"], "body")
    made.wire("foot", "a", "wire")
    made.fix("foot")
    return made.model


def test_a_body_that_can_do_much_moves_along_axes_and_turns_about_its_middle() -> None:
    analysis = analyse(free_body())
    assert analysis.under_constrained == 5
    screws = [motion.of("body") for motion in analysis.motions]
    assert [str(screw.kind) for screw in screws] == ["translation"] * 2 + ["rotation"] * 3
    axes = [int(np.abs(screw.direction).argmax()) for screw in screws]
    assert axes == [0, 1, 0, 1, 2]
    assert all(np.abs(screw.direction).max() == pytest.approx(1.0) for screw in screws)
    # The wire stops z at (0, 0, 0): axes along x and y go through the z axis there.
    third = 0.1 / 3
    wanted = [(third, 0, 0), (0, third, 0), (third, third, 0)]
    assert np.array([screw.point for screw in screws[2:]]) == pytest.approx(
        np.array(wanted), abs=1e-12
    )


# The same whatever it is called by -------------------------------------------


@pytest.mark.parametrize(
    "make",
    [
        guide,
        cross_hinge,
        wires_on_a_helix,
        free_body,
        lambda p: guide(p, 3),
        lambda p: hexapod(8, p),
    ],
    ids=["guide", "cross hinge", "wires", "free body", "three sheets", "eight wires"],
)
@pytest.mark.parametrize(
    "place",
    [Place(reverse=True), Place(other_sense=True), Place(swapped=True)],
    ids=["numbers", "widths", "ends"],
)
def test_what_is_said_depends_on_the_mechanism_alone(make: object, place: Place) -> None:
    assert words(analyse(make(place))) == words(analyse(make(HERE)))  # type: ignore[operator]


def test_what_has_no_name_is_ordered_by_its_place() -> None:
    """Bars without names to one joint, and three loose ones, made in different orders."""

    def forces_and_motions(order: Sequence[int]) -> tuple[list[object], list[object]]:
        feet = [(1.0, 0.0), (0.6, 0.8), (-0.3, 1.0), (-1.0, -0.2), (0.1, -0.9)]
        model = Model(planar=True)
        middle = model.node(0.0, 0.0)
        for k in order:
            foot = model.node(*feet[k])
            model.truss(*((middle, foot) if k % 2 else (foot, middle)))
            model.fix(foot)
            model.truss(foot, model.node(feet[k][0], feet[k][1] + 3.0))
        analysis = analyse(model)
        places = analysis.data.arrays.node_value[:2]
        ends = analysis.data.arrays.element_node[[0, 2]] - 1
        stresses = [
            sorted(
                (tuple((places[:, p] + places[:, q]).round(9)), round(float(force), 9))
                for p, q, force in zip(*ends, stress.forces[:, 0], strict=True)
                if abs(force) > 1e-9
            )
            for stress in analysis.self_stresses
        ]
        motions = [
            sorted(
                (tuple(place.round(9)), tuple(moved.round(9) + 0.0))
                for place, moved in zip(places.T, motion.displacement, strict=True)
                if moved.any()
            )
            for motion in analysis.motions
        ]
        return stresses, motions

    first, again = forces_and_motions(range(5)), forces_and_motions([3, 1, 4, 0, 2])
    assert len(first[0]) == 3 and len(first[1]) == 5
    assert first == again


@pytest.mark.parametrize("name", ["in millimetres", "turned", "all of it"])
@pytest.mark.parametrize("make", [guide, cross_hinge, lambda p: hexapod(8, p)])
def test_who_moves_and_who_presses_does_not_depend_on_the_place(make: object, name: str) -> None:
    def who(analysis: Analysis) -> list[object]:
        return [
            *([m.names for m in motion.bodies] for motion in analysis.motions),
            *([str(p.part) for p in stress.parts] for stress in analysis.self_stresses),
            *([round(p.share, 6) for p in stress.parts] for stress in analysis.self_stresses),
        ]

    here, there = (analyse(make(place)) for place in (HERE, PLACES[name]))  # type: ignore[operator]
    assert who(here) == who(there)


def test_a_turn_by_a_right_angle_turns_what_is_said() -> None:
    quarter = Place(turn=np.round(turn_about(EZ, np.pi / 2)))
    (here,), (there,) = (analyse(guide(place)).motions for place in (HERE, quarter))
    assert here.of("stage").direction == pytest.approx([0, 1, 0])
    assert there.of("stage").direction == pytest.approx(EX)
