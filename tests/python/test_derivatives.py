# SPDX-License-Identifier: BSD-3-Clause
"""Deformation functions: derivatives against central differences, and rigid-body motion."""

import numpy as np
import pytest

import flexact
from flexact.core.elements import element_kinds, kind_of, planar_table

KEYWORDS = [kind.keyword for kind in element_kinds()]
STEP = 1e-5


def random_model(keyword: str, random: np.random.Generator) -> flexact.Model:
    """One element of length about one, with a turned reference orientation."""
    kind = kind_of(keyword)
    spatial = not planar_table()[kind.number]
    used = [str(slot) for slot, wanted in enumerate(kind.slots, start=1) if wanted]
    vector = numbers(random.normal(size=3)) if kind.vector else ""
    lines = [f"{keyword} 1 {' '.join(used)} {vector}"]
    places = {"1": random.normal(size=3), "3": random.normal(size=3)}
    places["3"] = places["1"] + (places["3"] - places["1"]) / np.linalg.norm(
        (places["3"] - places["1"])[: 3 if spatial else 2]
    )
    turns = {number: random.normal(size=4) for number in ("2", "4")}
    for number, value in places.items():
        if number in used:
            lines.append(f"X {number} " + numbers(value[: 3 if spatial else 2]))
    for number, value in turns.items():
        if number in used:
            value = value / np.linalg.norm(value) if spatial else value[:1]
            lines.append(f"X {number} " + numbers(value))
    return flexact.read_text("\n".join(lines))


def numbers(values: np.ndarray) -> str:
    return " ".join(map(repr, values.tolist()))


def moves(model: flexact.Model, random: np.random.Generator, size: float) -> np.ndarray:
    delta = size * random.normal(size=(model.node_numbers.size, 3))
    delta[model.coordinate_classes == 0] = 0
    return delta


@pytest.mark.parametrize("keyword", KEYWORDS)
@pytest.mark.parametrize("seed", range(5))
def test_jacobian_is_the_derivative(keyword: str, seed: int) -> None:
    random = np.random.default_rng([seed, *map(ord, keyword)])
    model = random_model(keyword, random)
    here = model.reference().moved(moves(model, random, 0.3))
    matrix = flexact.jacobian(model, here, c_t=0.2)
    numeric = np.empty(matrix.shape)
    for column, (number, name) in enumerate(matrix.column_labels):
        delta = np.zeros((model.node_numbers.size, 3))
        delta[model.node_index(number), "xyz".index(name[-1])] = STEP
        ahead = flexact.deformations(model, here.moved(delta), c_t=0.2)
        behind = flexact.deformations(model, here.moved(-delta), c_t=0.2)
        numeric[:, column] = (ahead - behind) / (2 * STEP)
    assert np.abs(matrix.toarray()).max() > 0.1
    assert np.abs(matrix.toarray() - numeric).max() < 1e-7


@pytest.mark.parametrize("keyword", KEYWORDS)
def test_reference_configuration_is_free_of_deformation(keyword: str) -> None:
    model = random_model(keyword, np.random.default_rng(7))
    assert np.abs(flexact.deformations(model, model.reference())).max() <= 1e-15


@pytest.mark.parametrize("keyword", KEYWORDS)
@pytest.mark.parametrize("seed", range(5))
def test_rigid_body_motion_does_not_deform(keyword: str, seed: int) -> None:
    random = np.random.default_rng([seed, *map(ord, keyword)])
    model = random_model(keyword, random)
    planar = model.planar
    turn = random.uniform(-3, 3, size=3) * ([0, 0, 1] if planar else [1, 1, 1])
    shift = random.normal(size=3) * ([1, 1, 0] if planar else [1, 1, 1])
    moved = model.positions @ rotation(turn).T + shift
    delta = np.where(model.node_kinds[:, None] <= 2, moved - model.positions, turn)
    there = model.reference().moved(delta)
    assert np.abs(there.value - model.reference().value).max() > 0.01
    assert np.abs(flexact.deformations(model, there, c_t=0.2)).max() < 1e-12


def rotation(vector: np.ndarray) -> np.ndarray:
    """The rotation matrix of a rotation vector (Rodrigues)."""
    angle = np.linalg.norm(vector)
    x, y, z = vector / angle
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def test_moved_turns_about_global_axes_after_what_was_there() -> None:
    model = flexact.Model()
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    model.beam(a, b)
    row = model.node_index(b.orientation)
    random = np.random.default_rng(3)
    first, second = random.normal(size=(2, 3))
    config = model.reference()
    for turn in (first, second):
        delta = np.zeros((4, 3))
        delta[row] = turn
        config = config.moved(delta)
    made = matrix_of(config.value[row])
    assert np.abs(made - rotation(second) @ rotation(first)).max() < 1e-14


def matrix_of(euler: np.ndarray) -> np.ndarray:
    """The rotation matrix of unit Euler parameters, in the textbook's form."""
    s, v = euler[0], euler[1:]
    k = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    return (s * s - v @ v) * np.eye(3) + 2 * np.outer(v, v) + 2 * s * k


def test_length_of_euler_parameters_does_not_matter() -> None:
    random = np.random.default_rng(11)
    model = random_model("BEAM", random)
    here = model.reference().moved(moves(model, random, 0.3))
    value = here.value.copy()
    value[model.node_kinds == 4] *= 3.7
    other = flexact.Configuration(here.kinds, value)
    wanted = flexact.deformations(model, here)
    assert np.abs(flexact.deformations(model, other) - wanted).max() < 1e-14


def test_planar_beam_has_the_signs_of_the_deck_language() -> None:
    # docs/decks.md, Elements: e2 = -l0 el.eyp, e3 = l0 el.eyq; a small turn b of p alone gives
    # eyp = (-sin b, cos b), so e2 = l0 sin b; of q alone e3 = -l0 sin b.
    model = flexact.read_text("PLBEAM 1 1 2 3 4\nX 3 2 0\n")
    for row, deformation, sign in ((1, 1, 1), (3, 2, -1)):
        delta = np.zeros((4, 3))
        delta[row, 2] = 0.1
        e = flexact.deformations(model, model.reference().moved(delta))
        assert e[deformation] == pytest.approx(sign * 2 * np.sin(0.1), abs=1e-15)
        assert e[0] == pytest.approx(2 * (2 * np.sin(0.1)) ** 2 / (30 * 2), abs=1e-15)
