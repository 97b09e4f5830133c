# SPDX-License-Identifier: BSD-3-Clause
"""The depth buffer: at every point the nearest is seen, whatever the sizes and the order."""

import numpy as np
import pytest

from flexact.show.picture.canvas import SAMPLES, Facets, painted, visible

SIZE = 60
RED, GREEN, BLUE = np.eye(3)


def facets(corners: list[list[list[float]]], colours: np.ndarray, opacity: float = 1.0) -> Facets:
    """Polygons whose corners are given in pixels."""
    colour = np.column_stack((colours, np.full(len(colours), opacity)))
    return SAMPLES * np.array(corners, float), colour


def square(left: float, right: float, near_left: float, near_right: float) -> list[list[float]]:
    """A square over the whole height that slants from left to right."""
    return [
        [left, 5, near_left],
        [right, 5, near_right],
        [right, 55, near_right],
        [left, 55, near_left],
    ]


@pytest.mark.parametrize("seed", range(3))
def test_the_nearest_facet_is_seen(seed: int) -> None:
    """Parallelograms of very different sizes in parallel slanting planes, in any order."""
    random = np.random.default_rng(seed)
    middle, size = random.uniform(0, SIZE, (24, 1, 2)), 10 ** random.uniform(0.5, 1.6, (24, 1, 1))
    angle = random.uniform(0, np.pi, 24)
    turn = np.moveaxis(
        np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]), 2, 0
    )
    corner = middle + size * (np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) @ turn)
    layer = random.permutation(24)
    depth = 3.0 * corner[..., 0] - 2.0 * corner[..., 1] + 0.1 * layer[:, None]
    colour = random.uniform(0, 1, (24, 3))
    made = painted([facets(np.dstack((corner, depth)).tolist(), colour)], SIZE, SIZE)
    points = np.stack(np.meshgrid(*2 * [np.arange(SIZE) + 0.5]), axis=-1)
    edge, offset = np.roll(corner, -1, axis=1) - corner, points[:, :, None, None] - corner
    side = (edge[..., 0] * offset[..., 1] - edge[..., 1] * offset[..., 0]) / np.linalg.norm(
        edge, axis=-1
    )
    inside = np.all(side > 1.5, axis=-1)
    beside = np.any(side < -1.5, axis=-1)
    clear = np.all(inside | beside, axis=-1)
    nearest = np.where(inside, layer, -1).argmax(axis=-1)
    expected = np.where(inside.any(axis=-1)[..., None], colour[nearest], 1.0)
    assert clear.sum() > 200
    np.testing.assert_allclose(made[clear], 255 * expected[clear], atol=1)


def test_facets_pass_through_each_other() -> None:
    both = facets([square(5, 55, 0, 50), square(5, 55, 50, 0)], np.array([RED, GREEN]))
    made = painted([both], SIZE, SIZE)
    assert np.all(made[6:54, 6:29] == (0, 255, 0)) and np.all(made[6:54, 31:54] == (255, 0, 0))


def test_of_facets_in_one_plane_the_last_is_seen() -> None:
    one, other = square(5, 55, 0, 17), square(20, 40, 17 * 15 / 50, 17 * 35 / 50)
    made = painted([facets([one, other], np.array([RED, GREEN]))], SIZE, SIZE)
    assert np.all(made[6:54, 21:39] == (0, 255, 0)) and np.all(made[6:54, 6:19] == (255, 0, 0))


def test_what_is_translucent_is_mixed_from_the_back_and_hidden_by_what_is_nearer() -> None:
    clear = facets([square(5, 55, 20, 20), square(5, 55, 10, 10)], np.array([RED, GREEN]), 0.5)
    solid = facets([square(5, 20, 0, 0), square(40, 55, 30, 30)], np.array([BLUE, BLUE]))
    made = painted([clear, solid], SIZE, SIZE)
    np.testing.assert_allclose(made[30, 12], 255 * np.array([0.5, 0.25, 0.25]), atol=1)
    np.testing.assert_allclose(made[30, 30], 255 * np.array([0.75, 0.5, 0.25]), atol=1)
    assert made[30, 48].tolist() == [0, 0, 255]


def test_edges_are_smooth_and_nothing_is_white() -> None:
    made = painted(
        [facets([[[10, 10, 0], [50.5, 10, 0], [50.5, 50, 0]]], np.zeros((1, 3)))], SIZE, SIZE
    )
    shades = np.unique(made)
    assert len(shades) > 4 and shades[0] == 0 and shades[-1] == 255
    assert np.all(painted([], 3, 2) == 255) and painted([], 3, 2).shape == (2, 3, 3)


def test_what_is_hidden_is_known() -> None:
    stack = [
        square(5, 55, 0, 0),
        square(10, 50, -5, -5),
        square(10, 50, 5, 5),
        square(70, 80, 9, 9),
    ]
    assert visible([facets(stack, np.zeros((4, 3)))], SIZE, SIZE).tolist() == [1, 0, 1, 0]
    point = facets([[[30.0, 30.0, 0.0]] * 4], np.zeros((1, 3)))
    assert not visible([point], SIZE, SIZE).any()


def test_a_soft_shadow_lies_beside_what_is_nearer() -> None:
    """Of two slanting squares the one behind is darker near the other one, and nowhere else."""
    both = facets([square(2, 58, 0, 28), square(30, 50, 20, 30)], np.array([RED, GREEN]))
    plain, shaded = (painted([both], SIZE, SIZE, reach=reach) for reach in (0.0, 8.0))
    row = slice(20, 40)
    red = shaded[row, 3:30, 0].astype(int)
    assert np.all(plain[row, 3:30, 0] == 255)
    # Neither the slope nor the nearer one is darker.
    assert np.all(red[:, :17] == 255) and np.all(shaded[row, 38:42] == plain[row, 38:42])
    assert np.all(red[:, -2] < 230) and np.all(np.diff(red[:, -8:-1], axis=1) <= 0)
    assert np.all(shaded[row, :2] == 255)
    kept = painted([both], SIZE, SIZE, reach=8.0, between=(1e6, 2e6))
    np.testing.assert_array_equal(kept, plain)
