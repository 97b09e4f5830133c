"""The order in which facets are drawn: the nearer hide the farther, whatever their sizes."""

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from flexact.picture.order import Items, painted


def stack(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """(n, 4, 3) parallelograms of very different sizes in slanting layers, and their layers.

    The layers are parallel planes, so that it is known which facet lies behind which.
    """
    random = np.random.default_rng(seed)
    layers = random.permutation(24)
    made = []
    for layer in layers:
        middle, size = random.uniform(-1, 1, 2), 10 ** random.uniform(-1.2, 0.2)
        angle = random.uniform(0, np.pi)
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        corners = middle + size * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) @ turn.T
        depth = 3.0 * corners[:, 0] - 2.0 * corners[:, 1] + 0.1 * layer
        made.append(np.column_stack((corners, depth)))
    return np.array(made), layers


def is_inside(corners: np.ndarray, points: np.ndarray) -> np.ndarray:
    """(points,) whether points (points, 2) are well inside a convex polygon (c, 2)."""
    edge = np.roll(corners, -1, axis=0) - corners
    offset = points[:, None] - corners
    turn = edge[:, 0] * offset[..., 1] - edge[:, 1] * offset[..., 0]
    return np.all(turn > 0.02 * np.linalg.norm(edge, axis=1), axis=1)


def wrong(flat: np.ndarray, layers: np.ndarray, order: np.ndarray) -> int:
    """How many points show another facet than the nearest."""
    points = np.random.default_rng(1).uniform(-2, 2, (2000, 2))
    inside = np.stack([is_inside(corners, points) for corners in flat[..., :2]])
    nearest = np.where(inside, layers[:, None], -1).max(axis=0)
    place = np.empty(len(order), int)
    place[order] = np.arange(len(order))
    last = np.where(inside, place[:, None], -1).argmax(axis=0)
    shown = np.where(inside.any(axis=0), layers[last], -1)
    return int(np.sum(shown != nearest))


@pytest.mark.parametrize("seed", range(8))
def test_the_nearest_facet_is_seen(seed: int) -> None:
    flat, layers = stack(seed)
    order = painted([Items(flat, np.zeros(len(flat)), False)])
    assert sorted(order.tolist()) == list(range(len(flat)))
    assert wrong(flat, layers, order) == 0


def test_the_depth_of_middles_would_not_do() -> None:
    flat, layers = stack(0)
    assert wrong(flat, layers, np.argsort(flat[..., 2].mean(axis=1))) > 100


def test_lines_lie_on_their_facet_and_behind_others() -> None:
    """A line on a slanting facet, one behind it, and a facet before them all."""
    slant = np.array([[-1, -1, -4], [1, -1, 4], [1, 1, 4], [-1, 1, -4.0]])
    front = np.array([[0.2, -0.5, 9], [0.8, -0.5, 9], [0.8, 0.5, 9], [0.2, 0.5, 9.0]])
    on = np.array([[-0.9, 0.1, -3.6], [0.9, 0.1, 3.6]])
    behind = on + np.array([0.0, 0.1, -1.0])
    order = painted(
        [
            Items(np.array([on, behind]), np.zeros(2), True),
            Items(np.array([front, slant]), np.zeros(2), False),
        ]
    ).tolist()
    place = {item: k for k, item in enumerate(order)}
    assert place[1] < place[3] < place[0] < place[2]


def test_rings_are_broken() -> None:
    """Three beams that each lie on the next have no order; each is drawn once all the same."""
    beam = np.array([[-1.0, -0.1, -0.3], [1.0, -0.1, 0.3], [1.0, 0.1, 0.3], [-1.0, 0.1, -0.3]])
    made = []
    for k in range(3):
        angle = 2 * np.pi * k / 3
        turn = np.array(
            [[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]]
        )
        made.append((beam + np.array([0.0, 0.4, 0.0])) @ turn.T)
    order = painted([Items(np.array(made), np.zeros(3), False)])
    assert sorted(order.tolist()) == [0, 1, 2]


def test_points_and_nothing_have_an_order() -> None:
    point = Items(np.zeros((2, 4, 3)), np.array([1.0, 0.0]), False)
    assert painted([point]).tolist() == [1, 0]
