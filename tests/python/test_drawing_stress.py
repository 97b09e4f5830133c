# SPDX-License-Identifier: BSD-3-Clause
"""Self-stresses along the members, against the equilibrium of every node."""

import numpy as np
import pytest
from reference_decks import STRESSED, UNDIVIDED, text_of

import flexact
from flexact.core.elements import Class, Role, role_table
from flexact.show.drawing import QUANTITIES, Drawing, Form, Resultants, drawing_of, resultants


def loads_of(drawing: Drawing, values: Resultants, stress: flexact.SelfStress) -> np.ndarray:
    """(nodes, 3) what the members and hinges pull at the nodes, by the statics of bars and beams.

    From the resultants alone: the shear forces are the slopes of the bending moments. Hinges,
    of which sizes are drawn, have the forces and moments of the self-stress itself.
    """
    loads = np.zeros((len(drawing.reference.position), 3))
    members = drawing.members
    for k in range(len(members)):
        p, op, q, oq = members.nodes[k]
        ex = members.frame[k, :, 0]
        (n, _), (t, _), first, second = values.members[k]
        # A moment that stretches the side to which a direction points is about that x ex.
        one, two = np.cross(drawing.data.across[members.index[k]], ex)
        at_p, at_q = (first[end] * one + second[end] * two for end in (0, 1))
        # M' + ex x F = 0 for a beam without loads along it.
        # Across a link without length nothing shows the force, for it has no arm.
        force = n * ex + np.cross(ex, at_q - at_p) / (members.length[k] or np.inf)
        loads[q] += force
        loads[p] -= force
        if op >= 0:
            loads[op] -= t * ex + at_p
        if oq >= 0:
            loads[oq] += t * ex + at_q
    arrays = drawing.data.arrays
    both = stress.forces + stress.moments
    for index, frame in zip(drawing.hinges.index, drawing.hinges.frame, strict=True):
        roles = role_table()[arrays.element_kind[index]]
        n, t, my, mz, *shear = (
            both[index][np.isin(roles, role)].sum()
            for role in (
                *(Role.OFFSET_X, Role.ROTATION, Role.TILT_Y, (Role.TILT_Z, Role.ANGLE)),
                *(Role.OFFSET_Y, Role.OFFSET_Z),
            )
        )
        p, op, q, oq = arrays.element_node[:, index] - 1
        # In the plane Mz is about the global z axis, whichever way the axis of the joint is.
        moment = np.array([0.0, 0.0, mz]) if drawing.data.planar else frame @ [t, my, mz]
        force = frame @ [n, *shear]
        loads[op] -= moment
        loads[oq] += moment
        if p >= 0:
            arm = arrays.node_value[:3, q] - arrays.node_value[:3, p]
            loads[q] += force
            loads[p] -= force
            loads[op] -= np.cross(arm, force)
    return loads


@pytest.mark.parametrize("name", [name for name in STRESSED if name in UNDIVIDED])
def test_every_self_stress_leaves_the_nodes_in_equilibrium(name: str) -> None:
    # Members that a deck does not draw would be missing here.
    analysis = flexact.analyse(flexact.read_text(text_of(name).replace("DONOTDRAW", "%"), name))
    drawing = drawing_of(analysis.given)
    free = analysis.given.arrays.coordinate_class.T == Class.DEPENDENT
    for stress in analysis.self_stresses:
        values = resultants(drawing, stress)
        loads = loads_of(drawing, values, stress)
        assert np.abs(loads).max() > 0.0 or not np.abs(values.members).max() > 0.0
        assert np.abs(loads[free]).max(initial=0.0) <= 1e-12 * max(np.abs(loads).max(), 1.0)


def test_the_twelve_trusses_are_half_in_tension_half_in_compression() -> None:
    # Paper, Fig. 2(a): all of one size.
    analysis = flexact.analyse(flexact.read_text(text_of("paper/twelve_trusses")))
    values = resultants(drawing_of(analysis.given), analysis.self_stresses[0])
    assert values.dominant == "normal force"
    force = np.sort(values["normal force"][:, 0])
    np.testing.assert_allclose(force, [-1.0] * 6 + [1.0] * 6, rtol=1e-12)


def test_the_clamped_folded_sheet_bends_at_its_clamped_ends_with_opposite_signs() -> None:
    # Paper, Fig. 4(c); at the fold nothing.
    analysis = flexact.analyse(flexact.read_text(text_of("paper/folded_sheet_clamped")))
    drawing = drawing_of(analysis.given)
    values = resultants(drawing, analysis.self_stresses[0])
    assert values.dominant == "in-plane moment"
    clamped = [values["in-plane moment"][0, 0], values["in-plane moment"][1, 1]]
    assert clamped[0] * clamped[1] < 0.0
    np.testing.assert_allclose(
        [values["in-plane moment"][0, 1], values["in-plane moment"][1, 0]], 0.0, atol=1e-15
    )
    middle = values.along("in-plane moment", np.array([0]), np.array([0.5]))
    assert middle[0, 0] == pytest.approx(clamped[0] / 2)


def test_six_folded_sheets_have_twelve_equal_moments() -> None:
    # Paper, Fig. 6: at the clamped ends of all sheets; the torsion of the body is larger.
    analysis = flexact.analyse(flexact.read_text(text_of("paper/six_folded_sheets")))
    drawing = drawing_of(analysis.given)
    values = resultants(drawing, analysis.self_stresses[0])
    sheets = drawing.members.form == Form.SHEET
    assert values.dominant == "in-plane moment"
    moments = np.abs(values["in-plane moment"][sheets]).max(axis=1)
    np.testing.assert_allclose(moments, moments[0], rtol=1e-9)
    assert values.largest("twist moment") > moments[0]


def test_rounding_errors_are_no_stress() -> None:
    analysis = flexact.analyse(flexact.read_text(text_of("paper/folded_sheet_clamped")))
    values = resultants(drawing_of(analysis.given), analysis.self_stresses[0])
    assert values.largest("in-plane moment") > 0.01
    assert [name for name in QUANTITIES if values.largest(name)] == ["in-plane moment"]
