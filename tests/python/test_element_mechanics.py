# SPDX-License-Identifier: BSD-3-Clause
"""Stiffness, second derivatives, mass and weight of single elements in large configurations.

Compared with differences of first derivatives, with the oracle's second-order arithmetic, in which
nobody derived anything by hand, and with energies.
"""

import importlib
import sys
from typing import Any, NamedTuple

import numpy as np
import pytest
from reference_decks import ROOT
from test_derivatives import KEYWORDS, matrix_of, moves, random_model

import flexact
from flexact.core import elastic
from flexact.core.arrays import FloatArray, packed
from flexact.core.elements import AXES, Class, Member, NodeKind, element_kinds, kind_of

sys.path.insert(0, str(ROOT / "tests" / "reference" / "elastic"))
functions: Any = importlib.import_module("functions")

NUMBERS = np.array([700.0, 500.0, 300.0, 200.0, 0.04, 0.09])
MASS = np.array([0.7, 0.5, 0.3, 0.4, -0.1])
NOTHING = np.full(6, np.nan)
ZERO = np.zeros(3)
WITH_STIFFNESS = [kind.keyword for kind in element_kinds() if kind.member != Member.LINK]
WITH_MASS = [kind.keyword for kind in element_kinds() if kind.member != Member.HINGE]


class Single(NamedTuple):
    """One element with all coordinates free and all deformations elastic, far from its rest."""

    model: flexact.Model
    arrays: elastic.ElasticArrays
    here: flexact.Configuration
    columns: list[tuple[int, int]]
    """Row of the node and axis of each coordinate."""

    @property
    def packed(self) -> Any:
        return packed(self.model.data.arrays)

    def state(self, stress: FloatArray) -> elastic.ElasticState:
        nodes = self.model.node_numbers.size
        column = np.asfortranarray(stress[:, None])
        return elastic.ElasticState(
            np.asfortranarray(self.here.value.T), column, np.zeros((3, nodes))
        )

    def spins(self) -> FloatArray:
        """Rates of the coordinates of `matrices`, Euler parameters among them, by spins."""
        rates = np.eye(len(self.columns))
        for i, (row, axis) in enumerate(self.columns):
            if self.model.node_kinds[row] == NodeKind.ORIENTATION:
                euler = self.here.value[row]
                for j, (other, about) in enumerate(self.columns):
                    if other == row:
                        turned = np.cross(np.eye(3)[about], euler[1:])
                        rates[i, j] = (euler[0] * (axis == about) + turned[axis]) / 2
        return rates

    def matrices(self, stress: FloatArray) -> list[FloatArray]:
        """Mass, stiffness and geometric stiffness by positions and spins, (n, n) each."""
        places = tuple(3 * row + axis for row, axis in self.columns)
        found = elastic.matrices(self.packed, self.arrays, self.state(stress), ZERO, places)
        assert found.is_determined
        rates = self.spins()
        return [rates.T @ part @ rates for part in found[:3]]

    def oracle(self) -> Any:
        """The same element at the same place, as a batch of the oracle."""
        arrays, kinds = self.model.data.arrays, self.model.node_kinds
        slots = [int(node) - 1 for node in arrays.element_node[:, 0]]
        reference = self.model.reference().value

        def place(slot: int, value: FloatArray) -> FloatArray:
            found = np.zeros(3)
            if slots[slot] >= 0:
                known = 2 if kinds[slots[slot]] == NodeKind.PLANAR_POSITION else 3
                found[:known] = value[slots[slot], :known]
            return found

        def turn(slot: int) -> tuple[FloatArray, float]:
            row = slots[slot]
            if row < 0:
                return np.eye(3), 0.0
            if kinds[row] == NodeKind.ANGLE:
                angle = float(self.here.value[row, 0] - reference[row, 0])
                return matrix_of(np.array([np.cos(angle / 2), 0, 0, np.sin(angle / 2)])), angle
            return matrix_of(self.here.value[row]) @ matrix_of(reference[row]).T, 0.0

        frames = self.model.data.frames
        _, c_t = elastic.element_stiffness(self.packed, self.arrays)
        (rp, ap), (rq, aq) = turn(1), turn(3)
        parts = (
            frames.frame[0],
            place(2, reference) - place(0, reference),
            frames.length[0],
            c_t[0],
            place(0, self.here.value),
            rp,
            ap,
            place(2, self.here.value),
            rq,
            aq,
        )
        return functions.Batch(*(np.array([part]) for part in parts))

    def of_ends(self) -> list[int]:
        """The place of each coordinate among the twelve of an element."""
        slots = self.model.data.arrays.element_node[:, 0].tolist()
        return [3 * slots.index(row + 1) + axis for row, axis in self.columns]


def single(keyword: str, seed: int, size: float = 0.6) -> Single:
    """Turned and moved by about `size`, radians and lengths of the element."""
    random = np.random.default_rng([seed, *map(ord, keyword)])
    model = random_model(keyword, random)
    model = model.with_held(np.zeros((1, 6), np.bool_))
    nodes = model.node_numbers.size
    arrays = elastic.ElasticArrays(
        np.asfortranarray(NUMBERS[:, None]),
        np.asfortranarray(MASS[:, None]),
        np.full((6, nodes), np.nan, order="F"),
        np.asfortranarray(NOTHING[:, None]),
    )
    columns = [(row, axis) for row, kind in enumerate(model.node_kinds) for axis in AXES[kind]]
    return Single(model, arrays, model.reference().moved(moves(model, random, size)), columns)


def rigid(item: Single, seed: int) -> tuple[Single, FloatArray, FloatArray]:
    """The element moved as a rigid body: a turn of up to half a circle, and a shift."""
    random = np.random.default_rng(seed)
    planar = item.model.planar
    turn = random.uniform(-1.8, 1.8, 3) * ([0, 0, 1] if planar else [1, 1, 1])
    shift = random.normal(size=3) * ([1, 1, 0] if planar else [1, 1, 1])
    angle = np.linalg.norm(turn)
    rotation = matrix_of(np.array([np.cos(angle / 2), *np.sin(angle / 2) * turn / angle]))
    moved = item.model.positions @ rotation.T + shift
    is_place = item.model.node_kinds[:, None] <= NodeKind.POSITION
    delta = np.where(is_place, moved - item.model.positions, turn)
    return item._replace(here=item.model.reference().moved(delta)), rotation, shift


def gradient(item: Single, here: flexact.Configuration, stress: FloatArray) -> FloatArray:
    """sigma' D, in the order of the columns."""
    _, c_t = elastic.element_stiffness(item.packed, item.arrays)
    matrix = flexact.jacobian(item.model, here, c_t=float(c_t[0]))
    rows = item.model.node_index
    labels = [(rows(node), "xyz".index(name[-1])) for node, name in matrix.column_labels]
    return np.array(
        (stress[: matrix.shape[0]] @ matrix.toarray())[list(map(labels.index, item.columns))]
    )


def by_steps(item: Single, function: Any, step: float) -> FloatArray:
    """Derivative by each column, by central differences of fourth order."""
    result = []
    for row, axis in item.columns:
        delta = np.zeros((item.model.node_numbers.size, 3))
        delta[row, axis] = step
        at = {k: function(item.here.moved(k * delta)) for k in (-2, -1, 1, 2)}
        result.append((8 * (at[1] - at[-1]) - (at[2] - at[-2])) / (12 * step))
    return np.array(result)


def uncommuted(item: Single, moment: FloatArray) -> FloatArray:
    """What turns made one after the other have beyond exp(w): m.(w x v)/2."""
    result = np.zeros((moment.size, moment.size))
    for i, (row, axis) in enumerate(item.columns):
        for j, (other, about) in enumerate(item.columns):
            if row == other and item.model.node_kinds[row] == NodeKind.ORIENTATION:
                turned = np.cross(np.eye(3)[axis], np.eye(3)[about])
                on_node = [moment[item.columns.index((row, k))] for k in range(3)]
                result[i, j] = turned @ on_node / 2
    return result


@pytest.mark.parametrize("keyword", KEYWORDS)
@pytest.mark.parametrize("seed", range(4))
def test_second_derivatives_are_those_of_first_ones(keyword: str, seed: int) -> None:
    item = single(keyword, seed)
    stress = np.random.default_rng(seed).normal(size=6)
    _, _, h = item.matrices(stress)
    numeric = by_steps(item, lambda there: gradient(item, there, stress), 1e-3).T
    wanted = numeric - uncommuted(item, gradient(item, item.here, stress))
    assert np.abs(h - h.T).max() < 1e-13
    assert np.abs(h - wanted).max() < 1e-8
    assert (np.abs(h).max() > 0.01) == (keyword != "PLHINGE")


@pytest.mark.parametrize("keyword", KEYWORDS)
@pytest.mark.parametrize("seed", range(4))
def test_second_derivatives_are_those_of_the_oracle(keyword: str, seed: int) -> None:
    item = single(keyword, seed)
    jets = functions.FUNCTIONS[keyword](item.oracle())
    stress = np.random.default_rng(seed).normal(size=6)
    _, k, h = item.matrices(stress)
    at = item.of_ends()
    second = sum(sigma * jet.hessian[0] for sigma, jet in zip(stress, jets, strict=False))
    first = np.array([jet.gradient[0] for jet in jets])[:, at]
    s = elastic.element_stiffness(item.packed, item.arrays)[0][0, : len(jets), : len(jets)]
    np.testing.assert_allclose(h, second[np.ix_(at, at)], atol=1e-12)
    np.testing.assert_allclose(k, first.T @ s @ first, atol=1e-11 * max(1.0, np.abs(k).max()))


@pytest.mark.parametrize("keyword", KEYWORDS)
def test_stiffness_and_mass_are_symmetric_and_not_negative(keyword: str) -> None:
    item = single(keyword, 3)
    m, k, _ = item.matrices(np.zeros(6))
    s = elastic.element_stiffness(item.packed, item.arrays)[0][0]
    count = kind_of(keyword).deformations
    has_stiffness = kind_of(keyword).member != Member.LINK
    assert ((np.diag(s) > 0) == (np.arange(6) < (count if has_stiffness else 0))).all()
    for matrix in (s, k, m):
        size = np.abs(matrix).max(initial=0.0)
        assert np.abs(matrix - matrix.T).max() <= 1e-14 * size
        assert np.linalg.eigvalsh(matrix).min() >= -1e-13 * size


@pytest.mark.parametrize("keyword", WITH_MASS)
@pytest.mark.parametrize("seed", range(3))
def test_rigid_motion_has_the_energy_of_a_rigid_body(keyword: str, seed: int) -> None:
    """A slender rod of mass m l and inertia J l about the axes that it carries."""
    item, rotation, _ = rigid(single(keyword, seed), seed)
    random = np.random.default_rng(seed)
    planar = item.model.planar
    spin, speed = random.normal(size=(2, 3))
    if planar:
        spin[:2] = 0.0
        speed[2] = 0.0
    ends = [int(node) - 1 for node in item.model.data.arrays.element_node[::2, 0]]
    xp, xq = (item.here.value[row, :3] * ([1, 1, 0] if planar else [1, 1, 1]) for row in ends)
    velocity = {ends[0]: speed, ends[1]: speed + np.cross(spin, xq - xp)}
    v = np.array([velocity.get(row, spin)[axis] for row, axis in item.columns])
    middle, across = speed + np.cross(spin, xq - xp) / 2, np.cross(spin, xq - xp)
    wanted = MASS[0] * (middle @ middle + across @ across / 12) / 2
    if any(kind > NodeKind.POSITION for kind in item.model.node_kinds):
        own = spin @ rotation @ item.model.data.frames.frame[0]
        xx, yy, zz, yz = MASS[1:]
        inertia = np.array([[xx, 0, 0], [0, yy, yz], [0, yz, zz]])
        wanted += (xx * spin[2] ** 2 if planar else own @ inertia @ own) / 2
    m, _, _ = item.matrices(np.zeros(6))
    wanted *= item.model.data.frames.length[0]
    assert v @ m @ v / 2 == pytest.approx(wanted, rel=1e-12)


def held_forces(item: Single, gravity: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Forces on what is held, by column, and stresses, with every coordinate held where it is."""
    coordinates = np.array(item.model.data.arrays.coordinate_class)
    held = item.packed
    nodes = held.nodes.copy(order="F")
    nodes[2:] = np.where(coordinates != Class.NONE, Class.FIXED, Class.NONE)
    held = held._replace(nodes=nodes)
    n = nodes.shape[1]
    start = item.state(np.zeros(6))
    zero = np.zeros((6, 1), order="F")
    waypoint = elastic.Waypoint(start.configuration, zero, np.zeros((3, n)), gravity)
    found = elastic.equilibrium(held, item.arrays, start, waypoint, waypoint)
    assert found.reached == 1.0
    forces = np.array([found.state.reaction[axis, row] for row, axis in item.columns])
    return forces, found.state.stress[:, 0]


def energy(item: Single, there: flexact.Configuration, gravity: FloatArray) -> float:
    """Of the deformations, and of the centre of the line of mass."""
    s, c_t = elastic.element_stiffness(item.packed, item.arrays)
    e = np.zeros(6)
    found = flexact.deformations(item.model, there, c_t=float(c_t[0]))
    e[: found.size] = found
    batch = item._replace(here=there).oracle()
    keyword = item.model.element_keywords[0]
    mass = MASS[:1] * batch.length
    weight = 0.0
    if keyword in WITH_MASS:
        weigh = functions.weight if "BEAM" in keyword else functions.straight_weight
        if kind_of(keyword).member != Member.BEAM:
            weigh = functions.straight_weight
        weight = float(weigh(batch, mass, gravity).value[0])
    return float(e @ s[0] @ e) / 2 + weight


@pytest.mark.parametrize("keyword", KEYWORDS)
@pytest.mark.parametrize("seed", range(3))
def test_forces_are_those_of_the_energy(keyword: str, seed: int) -> None:
    """Of stiffness and of weight: what holds an element is the gradient of its energy."""
    item = single(keyword, seed)
    gravity = np.array([3.0, -7.0, 0.0 if item.model.planar else 5.0])
    forces, _ = held_forces(item, gravity)
    wanted = by_steps(item, lambda there: energy(item, there, gravity), 1e-3)
    assert np.abs(forces).max() > 0.1 or kind_of(keyword).member == Member.LINK
    np.testing.assert_allclose(forces, wanted, atol=1e-7 * max(1.0, np.abs(wanted).max()))


@pytest.mark.parametrize("keyword", WITH_STIFFNESS)
@pytest.mark.parametrize("seed", range(3))
def test_rigid_motion_gives_no_stress(keyword: str, seed: int) -> None:
    item, _, _ = rigid(single(keyword, seed), seed)
    forces, stress = held_forces(item, ZERO)
    assert np.abs(stress).max() < 1e-12 * NUMBERS.max() * 4
    assert np.abs(forces).max() < 1e-12 * NUMBERS.max() * 4


def test_releases_in_any_order_are_those_at_once() -> None:
    """S - S_R (S_RR + K)^-1 S_R', and a rest without stress where the notch is ideal."""
    item = single("BEAM", 1)
    whole = elastic.element_stiffness(item.packed, item.arrays)[0][0]
    random = np.random.default_rng(2)
    for _ in range(20):
        chosen = np.flatnonzero(random.random(6) < 0.5)
        if not chosen.size:
            continue
        notch = np.full((6, 1), np.nan, order="F")
        notch[chosen, 0] = random.choice([0.0, 3.0, 500.0], chosen.size)
        left = elastic.element_stiffness(item.packed, item.arrays._replace(notch=notch))[0][0]
        middle = whole[np.ix_(chosen, chosen)] + np.diag(notch[chosen, 0])
        wanted = whole - whole[:, chosen] @ np.linalg.solve(middle, whole[chosen])
        np.testing.assert_allclose(left, wanted, atol=1e-12 * np.abs(whole).max())
        assert not left[notch[:, 0] == 0].any()


def test_every_element_is_known_to_the_oracle_of_stiffness() -> None:
    assert set(KEYWORDS) <= set(functions.FUNCTIONS)
