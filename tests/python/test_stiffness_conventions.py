# SPDX-License-Identifier: BSD-3-Clause
"""How an elastic model is asked: nodes, orders, units, classes, and the two policies."""

import math
import pickle

import numpy as np
import pytest
from stiffness_decks import EA, EI, LENGTH, SHEET, cantilever, cross_hinge, deck, elastic, guide

import flexact


def rotation(axis: tuple[float, float, float], angle: float) -> np.ndarray:
    """Rodrigues' formula."""
    x, y, z = np.asarray(axis) / np.linalg.norm(axis)
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.asarray(np.eye(3) + math.sin(angle) * skew + (1 - math.cos(angle)) * skew @ skew)


def test_a_point_is_named_by_either_of_its_nodes() -> None:
    state = elastic(guide(), beams=1).undeformed()
    np.testing.assert_array_equal(state.compliance(9), state.compliance(10))
    assert state.compliance(9).shape == (6, 6)
    assert elastic(cantilever(), beams=1).undeformed().compliance(1).any() == False  # noqa: E712


def test_arrays_have_the_coordinates_that_a_point_has() -> None:
    truss = deck("TRUSS 1 1 2\nX 2 1 0 0\nFIX 1", "ESTIFF 1 2E5")
    assert elastic(truss).undeformed().compliance(2).shape == (3, 3)
    beam = deck("PLBEAM 1 1 2 3 4\nX 3 1 0\nFIX 1\nFIX 2\nRLSE 1 2 3", "ESTIFF 1 1E5 3")
    state = elastic(beam).undeformed()
    np.testing.assert_allclose(
        state.compliance(4), [[1e-5, 0, 0], [0, 1 / 9, 1 / 6], [0, 1 / 6, 1 / 3]], atol=1e-12
    )
    assert state.position(3) == pytest.approx([1, 0])
    assert state.position(4) == 0.0
    flat = deck("PLTRUSS 1 1 2\nX 2 1 0\nFIX 1", "ESTIFF 1 2E5")
    assert elastic(flat).undeformed().compliance(2).shape == (2, 2)


def test_a_turned_guide_has_turned_compliances_and_the_same_eigenvalues() -> None:
    turn = rotation((1.0, -2.0, 0.5), 0.7)
    one = elastic(guide(drive="")).misaligned(1, "z", 2e-5)
    model = elastic(guide(drive="", turn=turn))
    shift = turn @ (0, 0, 2e-5)
    other = model.imperfect(
        misaligned=[(1, axis, value) for axis, value in zip("xyz", shift.tolist(), strict=True)]
    ).assembled()
    block = np.kron(np.eye(2), turn)
    wanted = block @ one.compliance(9) @ block.T
    size = np.sqrt(np.outer(np.diag(wanted), np.diag(wanted)))
    np.testing.assert_allclose(other.compliance(9) / size, wanted / size, atol=1e-6)
    np.testing.assert_allclose(other.frequencies, one.frequencies, rtol=1e-6)
    assert other.energy == pytest.approx(one.energy, rel=1e-6)


def test_held_elastic_and_rigid() -> None:
    """What is fixed has the stiffness of its ESTIFF, or is rigid."""
    soft = elastic(cantilever()).undeformed().compliance(3)
    hard = elastic(cantilever(), held="rigid").undeformed().compliance(3)
    assert hard[0, 0] == pytest.approx(LENGTH**3 / (3 * EI), rel=1e-9)
    assert soft[2, 2] == pytest.approx(LENGTH / EA, rel=1e-9)
    assert hard[2, 2] == pytest.approx(0, abs=1e-20)
    assert hard[1, 1] == pytest.approx(0, abs=1e-20)
    stiffness = elastic(cantilever(), held="rigid").undeformed().stiffness(3)
    assert stiffness[2, 2] == math.inf
    assert np.isfinite(stiffness[0, 0])


def test_drive_is_of_declared_coordinates_not_of_deformations() -> None:
    text = cantilever().replace("RLSE 1 2 3 4", "RLSE 1 2\nDYNE 1 3 4\nINPUTX 3 1")
    free, locked = (elastic(text, drive=d).undeformed() for d in ("free", "locked"))
    assert free.compliance(3)[0, 0] == pytest.approx(LENGTH**3 / (3 * EI), rel=1e-9)
    assert locked.compliance(3)[0, 0] == 0.0
    assert locked.compliance(3)[4, 4] == pytest.approx(LENGTH / (4 * EI), rel=1e-9)
    # an input is held in the matrices, whatever the drive
    assert free.stiffness_matrix.shape == (2, 2)


def test_reduced_matrices_are_those_of_the_deck_in_its_order() -> None:
    """K0 of deformations is S, EI/l0^3 [[4, -2], [-2, 4]] (theory, section 2)."""
    text = cantilever().replace("RLSE 1 2 3 4", "RLSE 1 2\nDYNE 1 3 4")
    wanted = EI / LENGTH**3 * np.array([[4.0, -2.0], [-2.0, 4.0]])
    for beams in (1, "auto"):
        state = elastic(text, beams=beams).undeformed()
        np.testing.assert_allclose(state.stiffness_matrix, wanted, rtol=1e-9)
        assert not state.geometric_matrix.any()
        np.testing.assert_allclose(state.mass_matrix, state.mass_matrix.T, rtol=1e-12)
    order = deck(
        "TRUSS 1 1 2\nX 2 1 0 0\nFIX 1\nDYNX 2 3\nDYNX 2 2\nDYNE 1",
        "ESTIFF 1 8\nXM 2 2",
    )
    state = elastic(order).undeformed()
    np.testing.assert_allclose(state.stiffness_matrix, np.diag([0, 0, 8.0]), atol=1e-12)
    np.testing.assert_allclose(state.mass_matrix, 2 * np.eye(3), atol=1e-12)
    mass = np.diag([2.0, 3.0])
    for first in ("DYNX 4 2", "DYNX +4 2", "dynx 004 2", "\t DynX\t+04\t2  % x"):
        # Node 4 before node 2, however the number is written.
        numbers = deck(
            f"TRUSS 1 1 2\nTRUSS 2 3 4\nX 2 1 0 0\nX 3 0 1 0\nX 4 1 1 0\nFIX 1\nFIX 3\n"
            f"FIX 2 1 2\nFIX 4 1 3\n{first}\nDYNX 2 3\n% DYNX 2 3",
            "XM 4 2\nXM 2 3",
        )
        np.testing.assert_allclose(elastic(numbers).undeformed().mass_matrix, mass, atol=1e-12)
    assert elastic(cantilever()).undeformed().mass_matrix.shape == (0, 0)


def test_an_independent_euler_parameter_counts_half_the_angle() -> None:
    text = deck("HINGE 1 1 2 0 0 1\nFIX 1\nDYNX 2 4\nRLSE 1 1", "ESTIFF 1 12.5\nXM 2 0 0 0 0 0 3")
    state = elastic(text).undeformed()
    assert state.stiffness_matrix == pytest.approx(np.array([[50.0]]))
    assert state.mass_matrix == pytest.approx(np.array([[12.0]]))
    assert state.compliance(2)[2, 2] == pytest.approx(1 / 12.5)
    turned = elastic(text).along(2, "rz", [0.6])[0]
    assert turned.force == pytest.approx(12.5 * 0.6, rel=1e-9)
    assert turned.deformation(1, 1) == pytest.approx(0.6, rel=1e-9)


def test_counts_are_those_of_the_deck_whatever_is_held() -> None:
    for options in ({"held": "rigid"}, {"beams": 4}, {"drive": "locked"}):
        state = elastic(guide(), **options).undeformed()
        assert (state.under_constrained, state.over_constrained) == (0, 1)
    state = elastic(guide(), release=[(1, 5)]).undeformed()
    assert (state.under_constrained, state.over_constrained) == (0, 0)
    analysis = flexact.analyse(flexact.read_text(guide()))
    smallest = np.linalg.svd(analysis.dense_jacobian(), compute_uv=False)[-1]
    assert elastic(guide()).undeformed().smallest_singular_value == pytest.approx(smallest)


def test_a_notch_is_in_series_with_its_sheet() -> None:
    """A hinge of k N m/rad at the clamp: L/EI + 1/k, however the sheet is divided."""
    for beams in (1, 4):
        for k in (0.5, 20.0):
            state = elastic(cantilever(), release={(1, 3): k}, beams=beams).undeformed()
            assert state.compliance(3)[4, 4] == pytest.approx(LENGTH / EI + 1 / k, rel=1e-9)
            assert state.compliance(3)[0, 0] == pytest.approx(
                LENGTH**3 / (3 * EI) + LENGTH**2 / k, rel=1e-9
            )
        state = elastic(cantilever(), release={(1, 4): 2.0}, beams=beams).undeformed()
        assert state.compliance(3)[0, 0] == pytest.approx(LENGTH**3 / (3 * EI), rel=1e-9)
        slide = elastic(cantilever(), release={(1, 1): 3e4}, beams=beams).undeformed()
        assert slide.compliance(3)[2, 2] == pytest.approx(LENGTH / EA + 1 / 3e4, rel=1e-9)
    rigid = deck("BEAM 1 1 2 3 4 0 1 0\nX 3 0 0 0.1\nFIX 1\nFIX 2", "XM 3 1")
    turned = elastic(rigid, release={(1, 3): 7.0}).undeformed()
    assert turned.compliance(3)[4, 4] == pytest.approx(1 / 7.0, rel=1e-9)


def test_a_divided_sheet_of_the_deck_counts_as_what_it_is() -> None:
    places = "".join(f"X {2 * k + 1} 0 0 {k * LENGTH / 4}\n" for k in range(1, 5))
    beams = "".join(
        f"BEAM {k} {2 * k - 1} {2 * k} {2 * k + 1} {2 * k + 2} 0 1 0\nRLSE {k} 2 3 4\n"
        for k in range(1, 5)
    )
    made = deck(
        beams + places + "FIX 1\nFIX 2",
        "".join(f"ESTIFF {k} {SHEET}\nEM {k} 0.195\n" for k in range(1, 5)),
    )
    whole, four = elastic(cantilever()).undeformed(), elastic(made).undeformed()
    np.testing.assert_allclose(four.frequencies, whole.frequencies, rtol=1e-9)
    assert four.data.arrays.element_number.size == 16


def test_a_stage_with_a_stiffness_is_elastic_too() -> None:
    text = guide().replace("EM 1", f"ESTIFF 3 {SHEET}\nESTIFF 4 {SHEET}\nEM 1", 1)
    soft, hard = (elastic(t).undeformed().compliance(9)[0, 0] for t in (text, guide()))
    assert soft > 1.2 * hard


def test_names_of_a_model_made_in_python() -> None:
    model = flexact.Model(name="guide")
    for k, y in enumerate((0.0, 0.05), start=1):
        model.sheet(
            (0, y, 0),
            (0.1, y, 0),
            width=(0, 0, 1),
            name=f"sheet {k}",
            thickness=0.0005,
            breadth=0.05,
            material="steel",
        )
        model.fix((0, y, 0))
    point = model.node((0.1, 0.025, 0), name="tool")
    model.body([(0.1, 0, 0), point, (0.1, 0.05, 0)], name="stage")
    model.independent("stage", "y")
    made = flexact.elastic(model)
    state = made.undeformed()
    np.testing.assert_array_equal(state.compliance("tool"), state.compliance(point))
    assert state.frequencies.size >= 10
    assert state.peak_stress(1) == 0.0


def test_models_and_states_are_frozen_and_can_be_pickled() -> None:
    model = elastic(guide(), release={(1, 5): 2.0})
    again = pickle.loads(pickle.dumps(model))
    np.testing.assert_array_equal(again.undeformed().frequencies, model.undeformed().frequencies)
    with pytest.raises(AttributeError):
        model.held = "rigid"
    error = pickle.loads(pickle.dumps(flexact.StrokeError("no", 0.5, "node 3")))
    assert (error.reached, error.place, str(error)) == (0.5, "node 3", "no")


def test_everything_of_a_state_of_a_cross_hinge_is_said() -> None:
    text = elastic(cross_hinge()).along(2, "ry", [0.1])[0].describe()
    assert "held elastic, drive free" in text
    assert "Force of the drive" in text
    assert "Over-constrained by" in text


def test_what_is_rigid_and_locked_is_infinitely_stiff() -> None:
    text = deck("PLTRUSS 1 1 2\nX 2 1 0\nFIX 1\nDYNX 2 2\nPLTRUSS 2 2 3\nX 3 2 0", "ESTIFF 2 5")
    state = elastic(text, held="rigid", drive="locked").equilibrium()
    assert not state.compliance(2).any()
    np.testing.assert_array_equal(state.stiffness(2), np.diag([math.inf, math.inf]))
    assert "without loads" in state.label


def test_an_exactly_constrained_mechanism_held_rigid_follows_a_clamp_that_is_off() -> None:
    """Two rigid bars at right angles: the top moves along with the clamp of the bar below it."""
    text = deck("PLTRUSS 1 1 2\nPLTRUSS 2 3 2\nX 1 0 0\nX 2 0 1\nX 3 -1 1\nFIX 1\nFIX 3")
    state = elastic(text, held="rigid").misaligned(1, "y", 0.01)
    assert state.position(2) == pytest.approx([-1 + math.sqrt(1 - 0.01**2), 1.01], abs=1e-4)
    assert state.stress(1, 1) == pytest.approx(0.0, abs=1e-12)


def test_a_rigid_deformation_that_is_released_leaves_the_sheet_divided() -> None:
    """Torsion that has no stiffness is rigid; released it is free, and the rest is as before."""
    text = cantilever().replace("RLSE 1 2 3 4", "RLSE 1 3 4")
    text = text.replace(SHEET, SHEET.replace(SHEET.split()[1], "0"))
    kept = elastic(text).kept(3, {(1, 2): 5.0})
    assert kept == pytest.approx([0, 1, 1, 1, 1, 1], abs=1e-9)
    state = elastic(text, release={(1, 2): 5.0}).undeformed()
    assert state.data.arrays.element_number.size == 16
    assert state.compliance(3)[5, 5] == pytest.approx(1 / 5.0, rel=1e-9)
    assert state.compliance(3)[0, 0] == pytest.approx(LENGTH**3 / (3 * EI), rel=1e-9)


def scaled(text: str, size: float, off: tuple[float, float, float]) -> str:
    """A deck of the same material in another size: EA by its square, EI by its fourth power."""
    powers = {"ESTIFF": (2, 4, 4, 4), "EM": (2,)}
    lines = []
    for line in text.splitlines():
        keyword, *numbers = line.split() or [""]
        if keyword == "X":
            places = [repr(float(v) * size + o) for v, o in zip(numbers[1:], off, strict=True)]
            line = " ".join([keyword, numbers[0], *places])
        elif keyword in ("ESTIFF", "EM", "XM"):
            power = powers.get(keyword) or ((3,) if numbers[0] == "9" else (5,) * 6)
            made = [repr(float(v) * size**p) for v, p in zip(numbers[1:], power, strict=True)]
            line = " ".join([keyword, numbers[0], *made])
        lines.append(line)
    return "\n".join(lines)


@pytest.mark.parametrize(
    ("size", "off"), [(1e-3, (0, 0, 0)), (25.4, (0, 0, 0)), (1.0, (300.0, -20.0, 5.0))]
)
def test_size_and_place_do_not_matter(size: float, off: tuple[float, float, float]) -> None:
    """Frequencies fall with the size, forces grow with its square, angles stay."""
    text = guide().replace("X 3", "X 1 0 0 0\nX 3", 1)
    one, other = elastic(text), elastic(scaled(text, size, off))
    np.testing.assert_allclose(
        other.undeformed().frequencies * size, one.undeformed().frequencies, rtol=1e-9
    )
    middle = [o + v * size for o, v in zip(off, (0, 0, LENGTH / 2), strict=True)]
    critical = other.critical_misalignment(2, "rx", about=middle)
    assert critical == pytest.approx(
        one.critical_misalignment(2, "rx", about=(0, 0, LENGTH / 2)), rel=1e-9
    )
    near, far = one.along(9, "x", [0.03])[0], other.along(9, "x", [0.03 * size + off[0]])[0]
    assert far.force == pytest.approx(near.force * size**2, rel=1e-6)
    assert far.energy == pytest.approx(near.energy * size**3, rel=1e-6)
    assert far.over_constrained == near.over_constrained


def test_beams_of_other_stiffness_are_sheets_of_their_own() -> None:
    """Beams a sheet are counted where a sheet is one: alike all along."""
    deck = (
        "X 1 0 0\nX 3 0.1 0\nX 5 0.2 0\nFIX 1\nFIX 2\n"
        "PLBEAM 1 1 2 3 4\nPLBEAM 2 3 4 5 6\nRLSE 1 2 3\nRLSE 2 2 3\nEND\nHALT\n"
        "ESTIFF 1 1e6 0.1\nESTIFF 2 1e6 {}\nEND\nEND\n"
    )
    for second, pieces in ((0.1, 4), (0.2, 8)):
        elastic = flexact.elastic(flexact.read_text(deck.format(second)), beams=4)
        assert elastic.undeformed().data.arrays.element_number.size == pieces
