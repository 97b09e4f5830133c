# SPDX-License-Identifier: BSD-3-Clause
"""Convex hulls, judged by what a convex hull is: no program or table is compared with."""

import itertools

import numpy as np
import pytest

from flexact.show.drawing.bodies import Hull, hull_round, polygon_round


def box(*sizes: float) -> np.ndarray:
    return np.array(list(itertools.product((-0.5, 0.5), repeat=3))) * sizes


def turned(points: np.ndarray, seed: int) -> np.ndarray:
    matrix = np.linalg.qr(np.random.default_rng(seed).standard_normal((3, 3)))[0]
    return points @ matrix * np.sign(np.linalg.det(matrix)) + [3.0, -2.0, 0.5]


def volume(points: np.ndarray, hull: Hull) -> float:
    """By the divergence theorem."""
    a, b, c = np.moveaxis(points[hull.triangles] - points[0], 1, 0)
    return float(np.sum(a * np.cross(b, c)) / 6)


def check(points: np.ndarray, hull: Hull | None, inner: np.ndarray) -> None:
    """A closed surface like a sphere, with flat faces outside of which there is no point."""
    assert hull is not None
    extent = np.ptp(points, axis=0).max()
    ways = [(f[k], f[k - 1]) for f in hull.triangles.tolist() for k in range(3)]
    assert len(set(ways)) == len(ways) and {(b, a) for a, b in ways} == set(ways)
    assert len(np.unique(hull.triangles)) - len(ways) // 2 + len(hull.triangles) == 2
    for number, normal in enumerate(hull.normal):
        mine = points[hull.triangles[hull.face == number]]
        assert np.linalg.norm(normal) == pytest.approx(1.0)
        areas = np.cross(mine[:, 1] - mine[:, 0], mine[:, 2] - mine[:, 0])
        assert areas.sum(axis=0) @ normal > -1e-9 * extent**2
        height = mine.reshape(-1, 3) @ normal
        assert np.ptp(height) < 3e-4 * extent
        assert (np.concatenate((points, inner)) @ normal).max() < height.mean() + 3e-4 * extent


def test_a_box_has_six_faces_twelve_edges_and_its_volume() -> None:
    for seed, sizes in enumerate([(1, 1, 1), (1, 0.3, 0.05), (1, 1e-2, 1)]):
        points = turned(box(*sizes), seed)
        inner = turned(0.3 * np.array(sizes) * box(1, 1, 1), seed)
        every = np.concatenate((inner, points, points))
        hull = hull_round(every)
        check(every, hull, inner)
        assert len(hull.normal) == 6
        assert volume(every, hull) == pytest.approx(np.prod(sizes), rel=1e-12)
        length = np.linalg.norm(np.diff(every[hull.edges], axis=1), axis=-1).sum()
        assert length == pytest.approx(4 * sum(sizes), rel=1e-12)


def test_points_within_flat_faces_and_edges_change_nothing() -> None:
    grid = turned(np.array(list(itertools.product(np.linspace(0, 1, 5), repeat=3))), 4)
    hull = hull_round(grid)
    check(grid, hull, grid)
    assert len(hull.normal) == 6
    assert volume(grid, hull) == pytest.approx(1.0, rel=1e-12)
    along = np.abs(np.diff(grid[hull.edges], axis=1)[:, 0])
    assert np.linalg.norm(along, axis=1).sum() == pytest.approx(12.0, rel=1e-9)


@pytest.mark.parametrize("seed", range(8))
def test_points_on_a_sphere_are_all_corners(seed: int) -> None:
    """Euler: 60 corners have 116 triangles."""
    points = np.random.default_rng(seed).standard_normal((60, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    hull = hull_round(points)
    check(points, hull, 0.5 * points)
    assert len(np.unique(hull.triangles)) == 60
    assert len(hull.triangles) == 116


@pytest.mark.parametrize("seed", range(24))
def test_thickened_points_have_closed_convex_hulls(seed: int) -> None:
    """Few points with a box round each: many corners in one plane, and almost so."""
    chance = np.random.default_rng(seed)
    points = chance.standard_normal((chance.integers(1, 12), 3)).round(1)
    points[:, 2] *= chance.choice([0.0, 1e-12, 1e-6, 1e-4, 1e-3, 1.0])
    every = (points[:, None] + box(0.1, 0.1, 0.1)).reshape(-1, 3)
    for given in (every, turned(every, seed)):
        check(given, hull_round(given), chance.dirichlet(np.ones(len(given)), 20) @ given)


def test_flat_points_have_no_hull_in_space() -> None:
    for points in (np.zeros((0, 3)), np.ones((5, 3)), box(1, 0, 0), box(1, 1, 0)):
        assert hull_round(points) is None


def test_polygons_go_round_once() -> None:
    square = np.array([(0, 0), (1, 0), (1, 1), (0, 1), (0.5, 0), (0.5, 0.5), (1, 1)], float)
    assert square[polygon_round(square)].tolist() == square[:4].tolist()
    assert sorted(polygon_round(np.array([(0, 0), (2, 2), (1, 1)], float))) == [0, 1]
    assert polygon_round(np.ones((3, 2))).tolist() == [0]


def test_an_edge_that_nobody_sees_is_none() -> None:
    """A box whose upper face is bent by one degree has the edges of a box; by nine one more."""
    for degrees, edges in ((1.0, 12), (9.0, 13)):
        lift = 0.5 * np.tan(np.radians(degrees))
        roof = np.array([(0.0, y, 0.5 + lift) for y in (-0.5, 0.5)])
        hull = hull_round(np.concatenate((box(1, 1, 1), roof)))
        assert hull is not None and len(hull.normal) == 7
        # The lower edges of both gables are in three pieces less one.
        assert len(hull.edges) == edges + 2
