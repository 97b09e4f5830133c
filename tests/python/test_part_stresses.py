# SPDX-License-Identifier: BSD-3-Clause
"""What parts press on each other in a self-stress.

Checked by balance of each body and joint, by the principle of virtual work (what held parts exert
does no work in a motion), by the balance of a beam, and by closed forms: constant in-plane
moments of a parallel guide, a shear force through the crossing of a cross hinge.
"""

import numpy as np
import pytest
from known_models import folded_sheet, sheet_clamped_twice, twelve_trusses
from part_models import CROSSING, EX, EY, EZ, HERE, PLACES, Placed, cross_hinge, guide
from reference_decks import MOVING, NAMES, ROOT, STRESSED

from flexact import Analysis, Model, ModelError, SelfStress, analyse
from flexact.analysis.part_stresses import Load
from flexact.analysis.screws import Wrench, WrenchKind
from flexact.model.parts.parts import PartKind, natural

DECKS = [name for name in NAMES if not name.startswith("broken")]
_KNOWN: dict[str, Analysis] = {}


def deck(name: str) -> Analysis:
    if name not in _KNOWN:
        _KNOWN[name] = analyse(ROOT / "input_decks" / f"{name}.dat")
    return _KNOWN[name]


def total(loads: tuple[Load, ...], about: np.ndarray) -> np.ndarray:
    """(6,) all forces, and all moments about a point: summed here, not by `Wrench`."""
    made = np.zeros(6)
    for _, wrench in loads:
        made[:3] += wrench.force
        made[3:] += wrench.moment + np.cross(wrench.about - about, wrench.force)
    return made


def size(analysis: Analysis, stress: SelfStress) -> float:
    return max(end.wrench.size for part in stress.parts for end in part.ends)


@pytest.mark.parametrize("name", STRESSED)
def test_bodies_and_joints_are_in_balance(name: str) -> None:
    analysis = deck(name)
    about = np.array([0.3, -0.2, 0.7]) * analysis.characteristic_length
    for stress in analysis.self_stresses:
        assert stress.parts
        for conflict in stress.conflicts:
            assert conflict.loads and str(conflict)
            off = total(conflict.loads, about)
            assert np.abs(off).max() < 1e-9 * max(1.0, size(analysis, stress))


@pytest.mark.parametrize("name", STRESSED)
def test_each_part_is_in_balance(name: str) -> None:
    analysis = deck(name)
    for stress in analysis.self_stresses:
        for part in stress.parts:
            loads = tuple(Load(part.part, end.wrench) for end in part.ends)
            assert np.abs(total(loads, np.zeros(3))).max() < 1e-9 * max(1.0, size(analysis, stress))


@pytest.mark.parametrize("name", [name for name in STRESSED if name in MOVING])
def test_what_parts_exert_does_no_work_in_a_motion(name: str) -> None:
    """Virtual work: a motion leaves held deformations as they are, part by part."""
    analysis = deck(name)
    for stress in analysis.self_stresses:
        for motion in analysis.motions:
            for part in stress.parts:
                work = 0.0
                elements = part.part.elements
                ends = [_nodes_of(analysis, end.position, elements) for end in part.ends]
                for end, nodes in zip(part.ends, ends, strict=True):
                    if nodes is None:
                        break
                    position, orientation = nodes
                    work += float(end.wrench.force @ motion.displacement[position])
                    work += float(end.wrench.moment @ motion.rotation[orientation])
                # Where a joint ends, its node does not say how the part moves.
                assert None in ends or abs(work) < 1e-9 * max(1.0, size(analysis, stress))


def _nodes_of(
    analysis: Analysis, position: int | None, elements: tuple[int, ...]
) -> tuple[int, int] | None:
    """The position and orientation of an end of one of some elements; None of joints."""
    slots = analysis.given.arrays.element_node[:, list(elements)].T - 1
    for p, op, q, oq in slots.tolist():
        if p == position:
            return p, op if op >= 0 else p
        if q == position:
            return q, oq if oq >= 0 else q
    return None


def test_sheets_of_a_guide_hold_the_stage_against_each_other() -> None:
    (stress,) = analyse(guide()).self_stresses
    one, other = stress.parts
    assert (one.part.name, other.part.name) == ("sheet 1", "sheet 2")
    for part in (one, other):
        assert part.is_constant_bending and part.share == pytest.approx(1.0)
        first, last = part.in_plane_moments
        assert first == pytest.approx(-last, rel=1e-12) and abs(last) == pytest.approx(1.0)
        assert abs(part.normal_force) < 1e-9 and np.linalg.norm(part.shear_force) < 1e-9
        assert part.normal.tolist() == pytest.approx(EY) and part.direction == pytest.approx(EX)
    # The stage is turned about y by one, and back by the other.
    first, second = stress.on("stage")
    assert (str(first.part), str(second.part)) == ("sheet 1", "sheet 2")
    for load in (first, second):
        assert load.wrench.kind is WrenchKind.COUPLE
        assert load.wrench.direction == pytest.approx(EY)
    assert first.wrench.magnitude == pytest.approx(-second.wrench.magnitude)
    (conflict,) = stress.conflicts
    assert conflict.over is not None and conflict.over.kind is WrenchKind.COUPLE
    assert conflict.shares == pytest.approx((1.0, -1.0))


@pytest.mark.parametrize("name", PLACES)
def test_sheets_of_a_cross_hinge_pull_along_the_axis_where_they_cross(name: str) -> None:
    place = PLACES[name]
    (stress,) = analyse(cross_hinge(place)).self_stresses
    (conflict,) = stress.conflicts
    over = conflict.over
    assert over is not None and over.kind is WrenchKind.FORCE and over.pitch == 0.0
    axis = place.direction(EZ)
    assert np.linalg.norm(np.cross(over.direction, axis)) < 1e-9
    off = np.cross(over.point - place.point(CROSSING), axis)
    assert np.linalg.norm(off) < 1e-9 * 0.1 * place.scale
    assert conflict.shares == pytest.approx((1.0, -1.0), rel=1e-9)


def test_shear_follows_from_the_moments_at_the_ends() -> None:
    # Fig. 4(c) of the paper: the shear force in each sheet is its one end moment over its length.
    analysis = analyse(folded_sheet(clamped=True, size=0.3))
    (stress,) = analysis.self_stresses
    for part in stress.parts:
        moments = np.array(part.in_plane_moments)
        shear = abs(moments.sum()) / 0.3
        assert np.linalg.norm(part.shear_force) == pytest.approx(shear, rel=1e-9)
        assert np.abs(np.array(part.shear_force) @ part.normal) < 1e-9
        assert min(abs(moments)) < 1e-9 and not part.is_constant_bending
    (conflict,) = stress.conflicts
    assert conflict.over is not None and conflict.over.kind is WrenchKind.FORCE
    assert conflict.over.direction == pytest.approx([0, 0, 1], abs=1e-12)


def test_tension_and_compression_of_bars() -> None:
    (stress,) = analyse(twelve_trusses()).self_stresses
    forces = stress.forces[:, 0]
    for part in stress.parts:
        assert part.normal_force == pytest.approx(forces[part.part.elements[0]], rel=1e-9)
        assert "tension" in str(part) or "compression" in str(part)
    assert len(stress.parts) == 12


def test_a_sheet_clamped_at_both_ends_presses_on_its_supports() -> None:
    stresses = analyse(sheet_clamped_twice()).self_stresses
    assert len(stresses) == 3 and all(stress.conflicts == () for stress in stresses)
    kinds = [str(stress.parts[0]) for stress in stresses]
    assert sum("tension" in kind for kind in kinds) == 1
    assert sum("moment" in kind for kind in kinds) == 2
    for stress in stresses:
        assert [end.on for end in stress.of("leaf <1>").ends] == [None, None]


def test_what_each_part_says_of_itself() -> None:
    analysis = analyse(guide())
    (stress,) = analysis.self_stresses
    assert str(stress.of("sheet 1")) == str(stress.parts[0])
    assert repr(stress.of("sheet 1")).startswith("<PartStress sheet 1: moment (")
    assert stress.of("stage").part.kind is PartKind.BODY
    at = stress.on(Model.from_data(analysis.given).handle(3, 4))
    assert [str(load.part) for load in at] == ["sheet 1", "stage"]
    for ask in (stress.of, stress.on):
        with pytest.raises(ModelError):
            ask("sheet 9")
        with pytest.raises(TypeError):
            ask(1.5)


def test_six_folded_sheets_carry_equal_loads() -> None:
    # Paper, section 4.3: threefold symmetry, and mirrored above and below.
    (stress,) = deck("paper/six_folded_sheets").self_stresses
    outer = [part for part in stress.parts if "ground to fold" in part.part.name]
    inner = [part for part in stress.parts if "fold to rim" in part.part.name]
    assert len(outer) == len(inner) == 6
    for parts in (outer, inner):
        assert [part.share for part in parts] == pytest.approx([parts[0].share] * 6)
        names = [part.part.name for part in parts]
        assert names == sorted(names, key=natural)
    forces = [load.wrench.force for load in stress.on("cylinder")]
    assert np.sum(forces, axis=0) == pytest.approx([0, 0, 0], abs=1e-9)
    assert all(abs(force[2]) < 1e-9 for force in forces)


@pytest.mark.parametrize("beams", [2, 5])
def test_a_divided_sheet_that_is_bent_is_told_as_one(beams: int) -> None:
    def made(beams: int, height: float) -> Model:
        model, ends = Model(), []
        for k in (0, 1):
            share = np.linspace(0, 1, beams + 1)
            wave = height * np.sin(np.pi * share) * (1 - 2 * k)
            places = [(0.1 * s, 0.05 * k + w, 0.0) for s, w in zip(share, wave, strict=True)]
            points = [model.node(*place) for place in places]
            model.fix(points[0])
            for i in range(beams):
                name = f"sheet {k + 1}, {i + 1}"
                free = (2, 5, 6) if i == 0 else ()
                beam = model.beam(points[i], points[i + 1], (0, 1, 0), free, name=name)
                if i:
                    model.independent(beam, 2, 5, 6)
            ends.append(points[-1])
        model.rigid(*ends, name="stage")
        return model

    (straight,), (bent,) = (
        analyse(model).self_stresses for model in (made(1, 0.0), made(beams, 0.004))
    )
    for one, other in zip(straight.parts, bent.parts, strict=True):
        assert other.is_constant_bending
        assert other.in_plane_moments == pytest.approx(one.in_plane_moments, rel=1e-9)
        assert other.normal == pytest.approx(one.normal, abs=1e-9)


def test_parts_that_carry_nothing_are_left_out() -> None:
    points = {f"{w} {k}": (x, 0.05 * k, 0.0) for k in (0, 1) for w, x in (("g", 0), ("s", 0.1))}
    made = Placed(HERE, {**points, "foot": (0.1, 0.0, -0.1)})
    for k in (0, 1):
        made.sheet(f"g {k}", f"s {k}", EZ, f"sheet {k + 1}")
        made.fix(f"g {k}")
    made.body(["s 0", "s 1"], "stage")
    made.model.truss(made.node["foot"], made.node["s 0"], name="strut")
    made.model.fix(made.node["foot"], "x", "y", "z")
    stresses = analyse(made.model).self_stresses
    names = [{str(part.part) for part in stress.parts} for stress in stresses]
    assert {"sheet 1", "sheet 2"} in names
    assert stresses[names.index({"sheet 1", "sheet 2"})].of("strut").share < 1e-12


def test_wrenches_add_up_and_move() -> None:
    random = np.random.default_rng(5)
    one, other = (Wrench(*random.normal(size=(3, 3)), 0.5) for _ in range(2))
    there = random.normal(size=3)
    moved = one.at(there)
    assert moved.moment == pytest.approx(one.moment + np.cross(one.about - there, one.force))
    assert moved.pitch == pytest.approx(one.pitch) and moved.magnitude == pytest.approx(
        one.magnitude
    )
    both = one + other
    assert both.force == pytest.approx(one.force + other.force)
    nothing = both + -both
    assert not Wrench(nothing.force, nothing.moment, nothing.about, 0.5, 1e-9)
    assert (one * 2.0).force == pytest.approx(2.0 * one.force)
    on_axis = one.at(one.point)
    assert on_axis.moment == pytest.approx(one.pitch * one.force)
