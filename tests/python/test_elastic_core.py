# SPDX-License-Identifier: BSD-3-Clause
"""The core's elastic analysis, against closed forms."""

import math
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pytest

from flexact.core import elastic
from flexact.core.arrays import FloatArray, PackedModel, packed
from flexact.core.calls import assemble
from flexact.core.elements import Class
from flexact.model.reading import read_bytes

NO_GRAVITY = np.zeros(3)


@dataclass
class Mechanism:
    """A deck as the core takes it."""

    model: PackedModel
    arrays: elastic.ElasticArrays
    node: Mapping[int, int]

    @property
    def nodes(self) -> int:
        return self.model.nodes.shape[1]

    @property
    def elements(self) -> int:
        return self.model.elements.shape[1]

    @property
    def undeformed(self) -> elastic.ElasticState:
        stress, reaction = np.zeros((6, self.elements)), np.zeros((3, self.nodes))
        return elastic.ElasticState(self.model.places, stress, reaction)

    def waypoint(
        self,
        forces: Mapping[int, Sequence[float]] | None = None,
        target: FloatArray | None = None,
        gravity: Sequence[float] = (0, 0, 0),
    ) -> elastic.Waypoint:
        """Nothing but forces (three numbers) on nodes, supports elsewhere, and gravity."""
        force = np.zeros((3, self.nodes))
        for number, values in (forces or {}).items():
            force[:, self.node[number]] = values
        where = self.model.places if target is None else target
        return elastic.Waypoint(where, np.zeros((6, self.elements)), force, np.array(gravity))

    def solve(
        self, goal: elastic.Waypoint, start: elastic.ElasticState | None = None
    ) -> elastic.RawEquilibrium:
        """The equilibrium, from the undeformed state or from another without a load."""
        begin = self.undeformed if start is None else start
        first = self.waypoint(target=begin.configuration)
        return elastic.equilibrium(self.model, self.arrays, begin, first, goal)

    def linear(
        self, state: elastic.ElasticState, *columns: FloatArray, shift: bool = False
    ) -> elastic.RawLinear:
        """Increments under forces, (3, nn) each, or under moves of supports."""
        given = np.stack(columns, axis=2)
        force, move = (np.zeros_like(given), given) if shift else (given, np.zeros_like(given))
        misfit = np.zeros((6, self.elements, len(columns)))
        return elastic.linear(self.model, self.arrays, state, NO_GRAVITY, force, misfit, move)

    def unit(self, number: int, axis: int) -> FloatArray:
        """(3, nn) with a one."""
        made = np.zeros((3, self.nodes))
        made[axis, self.node[number]] = 1
        return made

    def energy(self, state: elastic.ElasticState) -> float:
        """Of elastic deformations that have no misfit."""
        _, c_t = elastic.element_stiffness(self.model, self.arrays)
        e = assemble(self.model, state.configuration, c_t).deformation
        rigid = self.model.elements[6:] == Class.FIXED
        return 0.5 * float(np.sum(np.where(rigid, 0, e * state.stress)))


def mechanism(
    deck: str, held: Sequence[tuple[int, int]] = (), notches: Mapping[tuple[int, int], float] = {}
) -> Mechanism:
    """A deck with coordinates (node, axis) held, and notches by element and deformation from 0."""
    data = read_bytes(deck.encode(), "deck")
    classes = data.arrays.coordinate_class.copy(order="F")
    for number, axis in held:
        classes[axis, data.node_index[number]] = Class.FIXED
    model = packed(data.arrays._replace(coordinate_class=classes))
    nodes, elements = model.nodes.shape[1], model.elements.shape[1]
    rows = np.full((17, elements), np.nan)
    mass = np.full((6, nodes), np.nan)
    if data.properties:
        rows[:6], rows[6:11] = data.properties.stiffness.T, data.properties.mass.T
        mass = data.properties.node_mass.T
    for (element, k), stiffness in notches.items():
        rows[11 + k, element] = stiffness
    arrays = elastic.ElasticArrays(rows[:6], rows[6:11], mass, rows[11:])
    return Mechanism(model, arrays, data.node_index)


def column(beams: int, length: float, stiffness: str, mass: str = "") -> str:
    """Planar beams along x from a clamp, all deformations released; orientation after position."""
    nodes = [2 * k + 1 for k in range(beams + 1)]
    lines = [f"X {n} {length * k / beams} 0" for k, n in enumerate(nodes)]
    for k, n in enumerate(nodes[:-1], start=1):
        lines += [f"PLBEAM {k} {n} {n + 1} {n + 2} {n + 3}", f"RLSE {k} 1 2 3"]
    lines += ["FIX 1", "FIX 2", "END", "HALT"]
    lines += [
        f"ESTIFF {k} {stiffness}\n" + (f"EM {k} {mass}" * bool(mass)) for k in range(1, beams + 1)
    ]
    return "\n".join([*lines, "END", "END", ""])


FRAME = """
BEAM 1 1 2 5 6 0 1 0
BEAM 2 5 6 7 8 0 1 0
BEAM 3 7 8 3 4 0 1 0
X 1 0 0 0
X 5 0.1 0 0
X 7 0.2 0.02 0
X 3 0.3 0.05 0.03
RLSE 1 1 2 3 4 5 6
RLSE 2 1 2 3 4 5 6
RLSE 3 1 2 3 4 5 6
FIX 1
FIX 2
END
HALT
ESTIFF 1 1e4 2 3 4
ESTIFF 2 1e4 2 3 4
ESTIFF 3 1e4 2 3 4
END
END
"""


@pytest.mark.parametrize("beams", [1, 16])
@pytest.mark.parametrize("angle", [0.0, 0.7])
def test_a_thin_cantilever_keeps_its_digits(beams: int, angle: float) -> None:
    """Compliance L/EA, L^3/3EI, L/EI (textbook), t/L = 1/300, in any direction."""
    length, ea, ei = 0.1, 2.1e6, 2.1e6 * (0.1 / 300) ** 2 / 12
    c, s = math.cos(angle), math.sin(angle)
    lines = column(beams, length, f"{ea} {ei!r}").splitlines()
    for i, line in enumerate(lines):
        if line.startswith("X "):
            _, number, x, _ = line.split()
            lines[i] = f"X {number} {float(x) * c!r} {float(x) * s!r}"
    m = mechanism("\n".join([*lines, ""]))
    tip, turn = 2 * beams + 1, 2 * beams + 2
    along = c * m.unit(tip, 0) + s * m.unit(tip, 1)
    across = c * m.unit(tip, 1) - s * m.unit(tip, 0)
    columns = (along, across, m.unit(turn, 2))
    found = m.linear(m.undeformed, *columns)
    compliance = np.einsum("ank,ani->ik", found.displacement, np.stack(columns, axis=2))
    exact = [length / ea, length**3 / 3 / ei, length / ei]
    assert np.diag(compliance) == pytest.approx(exact, rel=1e-9)
    assert compliance[1, 2] == pytest.approx(length**2 / 2 / ei, rel=1e-9)
    assert found.loose.shape[2] == 0
    assert found.negative == 0


PENDULUM = "TRUSS 1 1 2\nX 1 0 0 0\nX 2 0 0 -0.75\nFIX 1\nEND\nHALT\nXM 2 2.5\nEND\nEND\n"


def test_a_pendulum_is_held_by_gravity_alone() -> None:
    """omega^2 = g/l; without gravity it is loose, and upside down unstable."""
    m = mechanism(PENDULUM)
    for down in (-9.81, 9.81):
        gravity = np.array([0, 0, down])
        found = m.solve(m.waypoint(gravity=gravity.tolist()))
        assert found.reached == 1
        assert found.state.stress[0, 0] == pytest.approx(-2.5 * down)
        modes = elastic.frequencies(m.model, m.arrays, found.state, gravity, 10)
        assert modes.values == pytest.approx([-down / 0.75] * 2, rel=1e-12)
        assert modes.negative == (2 if down > 0 else 0)
    free = elastic.frequencies(m.model, m.arrays, m.undeformed, NO_GRAVITY, 10)
    assert free.values.tolist() == [0, 0]
    assert free.loose == 2
    assert m.linear(m.undeformed, m.unit(2, 2)).loose.shape == (3, 2, 2)


def test_a_load_on_a_loose_motion_finds_no_equilibrium() -> None:
    m = mechanism(PENDULUM)
    found = m.solve(m.waypoint({2: (1, 0, 0)}))
    assert (found.status, found.reached, found.place) == ("unheld", 0, 3 * m.node[2])


def test_supports_that_rigid_parts_cannot_follow_are_reported() -> None:
    m = mechanism("PLTRUSS 1 1 2\nX 1 0 0\nX 2 1 0\nFIX 1\nFIX 2\nEND\nHALT\nEND\nEND\n")
    target = m.model.places.copy()
    target[0, m.node[2]] = 1.1
    found = m.solve(m.waypoint(target=target))
    assert (found.status, found.place) == ("inconsistent", -1)
    assert found.reached == 0
    assert m.linear(m.undeformed, m.unit(2, 0), m.unit(2, 1), shift=True).mismatch[0] > 0.1


def test_an_elastica_under_a_dead_load() -> None:
    """P L^2/EI = 1: Bisshopp and Drucker, Quart. Appl. Math. 3 (1945), with more digits."""
    tips = []
    for beams in (8, 16):
        m = mechanism(column(beams, 1, "1e9 1"))
        found = m.solve(m.waypoint({2 * beams + 1: (0, 1, 0)}))
        assert found.reached == 1
        tips.append(found.state.configuration[:2, m.node[2 * beams + 1]])
    # The error of the element falls with the square of its length.
    assert tips[1] == pytest.approx([0.9435667637, 0.3017207738], abs=1e-4)
    assert (4 * tips[1] - tips[0]) / 3 == pytest.approx([0.9435667637, 0.3017207738], abs=1e-6)


def test_a_planar_angle_turns_more_than_once() -> None:
    """An end moment bends the beam to a circle and on: angle M L/EI, each chord alike."""
    m = mechanism(column(24, 1, "1e5 1"))
    found = m.solve(m.waypoint({50: (0, 0, 2.5 * math.pi)}))
    assert found.reached == 1
    angles = found.state.configuration[0, [m.node[2 * k] for k in range(1, 26)]]
    assert angles[-1] == pytest.approx(2.5 * math.pi, rel=0.02)
    assert np.diff(angles) == pytest.approx(angles[-1] / 24)


def test_without_loads_the_motions_without_stiffness_are_known() -> None:
    m = mechanism(PENDULUM)
    nodes, elements = m.model.nodes.shape[1], m.model.elements.shape[1]
    none = np.zeros((3, nodes, 0))
    found = elastic.linear(
        m.model, m.arrays, m.undeformed, NO_GRAVITY, none, np.zeros((6, elements, 0)), none
    )
    assert found.displacement.shape == found.reaction.shape == (3, nodes, 0)
    assert found.stress.shape == (6, elements, 0) and found.mismatch.size == 0
    assert found.loose.shape == (3, nodes, 2) and found.negative == 0


def test_an_euler_column_and_its_frequencies() -> None:
    """pi^2 EI/4L^2; and 3.516, 22.03 of the clamped beam (Timoshenko)."""
    m = mechanism(column(10, 2, "1e6 3", "0.5"))
    along = m.linear(m.undeformed, -m.unit(21, 0))
    state = elastic.ElasticState(m.model.places, along.stress[..., 0], along.reaction[..., 0])
    found = elastic.multipliers(m.model, m.arrays, state, NO_GRAVITY, 3)
    exact = [(2 * k - 1) ** 2 * math.pi**2 * 3 / 16 for k in (1, 2)]
    assert found.values[0] == pytest.approx(exact[0], rel=1e-5)
    assert found.values[1] == pytest.approx(exact[1], rel=1e-3)
    assert found.is_complete
    # In tension by the first load, it buckles at the negative ones.
    pulled = state._replace(stress=-state.stress, reaction=-state.reaction)
    back = elastic.multipliers(m.model, m.arrays, pulled, NO_GRAVITY, 3)
    assert back.values == pytest.approx(-found.values[::-1])
    modes = elastic.frequencies(m.model, m.arrays, m.undeformed, NO_GRAVITY, 2)
    ratio = np.sqrt(modes.values) / math.sqrt(3 / 0.5) * 2**2
    assert ratio == pytest.approx([3.516015, 22.03449], rel=2e-4)


def test_twelve_rigid_trusses_follow_their_drive() -> None:
    """The motion of the paper's trusses: node 6 stays as far from nodes 2, 3 and 5 as it was."""
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    bars = [(1, 5), (2, 5), (2, 6), (3, 6), (3, 7), (4, 7), (4, 8), (1, 8)]
    bars += [(5, 6), (6, 7), (7, 8), (8, 5)]
    lines = [f"TRUSS {k} {p} {q}" for k, (p, q) in enumerate(bars, start=1)]
    lines += [f"X {k} {x} {y} 0\nFIX {k}" for k, (x, y) in enumerate(corners, start=1)]
    lines += ["X 5 0 -1 1", "X 6 1 0 1", "X 7 0 1 1", "X 8 -1 0 1", "END", "HALT", "END", "END", ""]
    m = mechanism("\n".join(lines), held=[(5, 1)])
    target = m.model.places.copy()
    target[1, m.node[5]] = -1.2955202066613396
    found = m.solve(m.waypoint(target=target))
    assert found.reached == 1
    assert not found.state.stress.any()
    assert found.state.configuration[0, m.node[6]] == pytest.approx(0.5644310760346847, abs=1e-10)


ARCH = (
    "X 1 -1 0\nX 2 0 0.1\nX 3 1 0\nPLTRUSS 1 1 2\nPLTRUSS 2 2 3\nRLSE 1 1\nRLSE 2 1\nFIX 1\n"
    "FIX 3\nEND\nHALT\nESTIFF 1 1e6\nESTIFF 2 1e6\nEND\nEND\n"
)


def force_of_arch(y: float) -> float:
    """Of two bars of 1e6 N at the height y (von Mises' truss)."""
    first, length = math.sqrt(1.01), math.hypot(1, y)
    return 2e6 * (length - first) / first * y / length


def test_a_drive_leads_through_a_snap() -> None:
    m = mechanism(ARCH, held=[(2, 1)])
    for height in (0.05, 0.02, -0.05, -0.1):
        target = m.model.places.copy()
        target[1, m.node[2]] = height
        found = m.solve(m.waypoint(target=target))
        assert found.reached == 1
        assert found.state.reaction[1, m.node[2]] == pytest.approx(
            force_of_arch(height), rel=1e-10, abs=1e-8
        )


def test_a_load_stops_at_its_limit() -> None:
    m = mechanism(ARCH)
    found = m.solve(m.waypoint({2: (0, -1000, 0)}))
    limit = max(-force_of_arch(y) for y in np.linspace(0, 0.1, 10001))
    assert found.status == "diverges"
    assert found.reached == pytest.approx(limit / 1000, rel=1e-3)
    assert found.reached < limit / 1000
    height = found.state.configuration[1, m.node[2]]
    assert force_of_arch(height) == pytest.approx(-1000 * found.reached, rel=1e-9)


def test_rigid_motion_gives_no_stress() -> None:
    """A frame between two clamps that turn together, by one radian in eight steps."""
    m = mechanism(FRAME.replace("FIX 2", "FIX 2\nFIX 3\nFIX 4"))
    axis = np.array([1, 2, 3]) / math.sqrt(14)
    cross = np.cross(np.eye(3), axis)
    state, last, places = m.undeformed, m.waypoint(), m.model.places
    for angle in np.arange(1, 9) / 8:
        turn = np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
        target = places.copy()
        for number in (1, 3):
            target[:3, m.node[number]] = turn @ places[:3, m.node[number]] + [0.1 * angle, 0.2, 0.3]
        for number in (2, 4):
            target[:, m.node[number]] = [math.cos(angle / 2), *(math.sin(angle / 2) * axis)]
        goal = m.waypoint(target=target)
        found = elastic.equilibrium(m.model, m.arrays, state, last, goal)
        assert found.reached == 1
        state, last = found.state, goal
    assert np.abs(state.stress).max() < 1e-12 * 1e4 / 0.1
    moved = turn @ places[:3, m.node[7]] + [0.1, 0.2, 0.3]
    assert state.configuration[:3, m.node[7]] == pytest.approx(moved, abs=1e-14)


def test_work_along_a_closed_stroke_is_energy() -> None:
    """Gauss points on three straight parts of a stroke of the end in two directions."""
    m = mechanism(FRAME, held=[(3, 0), (3, 1)])
    end, state, last = m.node[3], m.undeformed, m.waypoint()
    corners = np.array([(0, 0), (-0.003, 0.03), (0.001, 0.02), (0, 0)])
    points, weights = np.polynomial.legendre.leggauss(16)
    work = most = 0.0
    for a, b in pairwise(corners):
        for part, weight in [*zip((points + 1) / 2, weights / 2, strict=True), (1.0, 0.0)]:
            target = m.model.places.copy()
            target[:2, end] += a + part * (b - a)
            goal = m.waypoint(target=target)
            found = elastic.equilibrium(m.model, m.arrays, state, last, goal)
            assert found.reached == 1
            state, last = found.state, goal
            work += weight * float(state.reaction[:2, end] @ (b - a))
            most = max(most, m.energy(state))
    assert most > 0.1
    assert abs(work) < 1e-8 * most
    assert m.energy(state) < 1e-16 * most


def test_the_tangent_is_what_the_path_does() -> None:
    """At a large deflection, with an Euler parameter held alone: differences of states."""
    m = mechanism(FRAME, held=[(4, 0)])
    load, step = {3: (3, 5, -7)}, 1e-4
    base = m.solve(m.waypoint(load))
    end, turn = m.node[3], m.node[4]

    def state_at(parameter: float, force: float) -> elastic.ElasticState:
        target = m.model.places.copy()
        target[1, turn] = parameter
        goal = m.waypoint({3: (3, 5 + force, -7)}, target)
        found = elastic.equilibrium(m.model, m.arrays, base.state, m.waypoint(load), goal)
        assert found.reached == 1
        assert found.state.configuration[1, turn] == pytest.approx(parameter, abs=1e-14)
        return found.state

    there = state_at(0.3, 0)
    by_force = m.linear(there, m.unit(3, 1))
    by_turn = m.linear(there, m.unit(4, 0), shift=True)
    for found, high, low in (
        (by_force, state_at(0.3, step), state_at(0.3, -step)),
        (by_turn, state_at(0.3 + step / 2, 0), state_at(0.3 - step / 2, 0)),
    ):
        slope = (high.configuration - low.configuration)[:3, end] / (2 * step)
        assert found.displacement[:, end, 0] == pytest.approx(slope, rel=1e-6)
        stress = (high.stress - low.stress) / (2 * step)
        assert found.stress[..., 0] == pytest.approx(stress, rel=1e-6, abs=1e-6)
        force = (high.reaction[0, turn] - low.reaction[0, turn]) / (2 * step)
        assert found.reaction[0, turn, 0] == pytest.approx(force, rel=1e-6)
    # The reaction does the work on twice the change of the parameter.
    potential = [
        m.energy(state) - float(np.dot((3, 5, -7), state.configuration[:3, end]))
        for state in (state_at(0.3 + step / 2, 0), state_at(0.3 - step / 2, 0))
    ]
    assert there.reaction[0, turn] == pytest.approx((potential[0] - potential[1]) / (2 * step))


def test_moments_do_not_slow_iterations_down() -> None:
    """Dead moments make the true derivative unsymmetric; the end turns by half a radian."""
    m = mechanism(FRAME)
    found = m.solve(m.waypoint({3: (3, 5, -7), 4: (2, 3, -2)}))
    assert found.reached == 1
    assert np.abs(found.state.configuration[1:, m.node[4]]).max() > 0.1
    assert found.iterations <= 8 * found.steps


def test_directions_without_mass_are_condensed() -> None:
    """Two springs in series with one mass: omega^2 = k/2m; across the line they are loose."""
    m = mechanism(
        "PLTRUSS 1 1 2\nPLTRUSS 2 2 3\nX 1 0 0\nX 2 1 0\nX 3 2 0\nRLSE 1 1\nRLSE 2 1\nFIX 1\n"
        "FIX 3 2\nEND\nHALT\nESTIFF 1 100\nESTIFF 2 100\nXM 3 2\nEND\nEND\n"
    )
    found = elastic.frequencies(m.model, m.arrays, m.undeformed, NO_GRAVITY, 10)
    assert found.values == pytest.approx([25])
    assert found.loose == 1


def test_a_free_bar_has_three_zero_frequencies() -> None:
    """And k (1/m + 1/M) along it."""
    m = mechanism(
        "PLTRUSS 1 1 2\nX 1 0 0\nX 2 3 4\nRLSE 1 1\nEND\nHALT\nESTIFF 1 100\nXM 1 2\nXM 2 3\n"
        "END\nEND\n"
    )
    found = elastic.frequencies(m.model, m.arrays, m.undeformed, NO_GRAVITY, 10)
    assert found.values == pytest.approx([0, 0, 0, 20 * (1 / 2 + 1 / 3)])
    assert (found.loose, found.negative) == (3, 0)


def test_over_constrained_rigid_parts_share_a_load() -> None:
    """Three equal rigid bars in line take a third each: multipliers of least norm."""
    bars = "".join(f"PLTRUSS {k} {k} 4\nX {k} 0 0\nFIX {k}\n" for k in (1, 2, 3))
    m = mechanism(f"{bars}X 4 1 0\nFIX 4 2\nEND\nHALT\nEND\nEND\n")
    found = m.linear(m.undeformed, m.unit(4, 0))
    assert found.stress[0, :, 0] == pytest.approx([1 / 3] * 3)
    assert m.solve(m.waypoint({4: (6, 0, 0)})).state.stress[0] == pytest.approx([2] * 3)


@pytest.mark.parametrize(("stiffness", "moved"), [(0.0, math.inf), (5.0, 0.2), (math.nan, 0.0)])
def test_a_notch_is_in_series_with_what_is_rigid(stiffness: float, moved: float) -> None:
    m = mechanism(
        "PLTRUSS 1 1 2\nX 1 0 0\nX 2 1 0\nFIX 1\nFIX 2 2\nEND\nHALT\nEND\nEND\n",
        notches={(0, 0): stiffness},
    )
    found = m.linear(m.undeformed, m.unit(2, 0))
    if math.isinf(moved):
        assert found.loose.shape[2] == 1
    else:
        assert found.displacement[0, m.node[2], 0] == pytest.approx(moved)


def test_reduced_matrices_of_a_cantilever() -> None:
    """In its two bendings a beam has EI/l^3 [4 -2; -2 4] (SPACAR); without an axial force no G."""
    m = mechanism(
        "PLBEAM 1 1 2 3 4\nX 1 0 0\nX 3 2 0\nFIX 1\nFIX 2\nDYNE 1 2 3\nEND\nHALT\n"
        "ESTIFF 1 0 16\nEM 1 3\nEND\nEND\n"
    )
    found = elastic.matrices(m.model, m.arrays, m.undeformed, NO_GRAVITY, (-2, -3))
    assert found.is_determined
    assert found.stiffness == pytest.approx(np.array([[8, -4], [-4, 8]]))
    assert not found.geometric.any()
    # The tip moves by e2 and turns by (e2 + e3)/l0, up to signs: H2 and H4 of the cubic.
    w = np.array([[1, 0], [1 / 2, -1 / 2]])
    mass = 3 * 2 / 420 * np.array([[156, -22 * 2], [-22 * 2, 4 * 4]])
    turned = [w.T @ np.diag([1, s]) @ mass @ np.diag([1, s]) @ w for s in (1, -1)]
    assert any(np.allclose(np.abs(found.mass), np.abs(each)) for each in turned)
    assert not elastic.matrices(m.model, m.arrays, m.undeformed, NO_GRAVITY, (-2,)).is_determined


def test_what_does_not_fit_is_refused() -> None:
    m = mechanism(ARCH)
    short = m.undeformed._replace(stress=np.zeros((6, 1)))
    with pytest.raises(ValueError, match="size"):
        elastic.frequencies(m.model, m.arrays, short, NO_GRAVITY, 1)
    wild = m.undeformed._replace(configuration=np.full((4, 3), np.nan))
    with pytest.raises(ValueError, match="finite"):
        m.linear(wild, m.unit(2, 0))
    with pytest.raises(ValueError, match="gravity"):
        elastic.frequencies(m.model, m.arrays, m.undeformed, np.full(3, np.inf), 1)
    with pytest.raises(ValueError, match="none of the model"):
        elastic.matrices(m.model, m.arrays, m.undeformed, NO_GRAVITY, (9,))


def test_threads_find_the_same() -> None:
    m = mechanism(FRAME)
    loads = [m.waypoint({3: (k, 5, -7)}) for k in range(8)]
    alone = [m.solve(load).state.configuration for load in loads]
    with ThreadPoolExecutor(4) as pool:
        together = [found.state.configuration for found in pool.map(m.solve, loads)]
    assert all(np.array_equal(a, b) for a, b in zip(alone, together, strict=True))
