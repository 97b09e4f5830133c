# SPDX-License-Identifier: BSD-3-Clause
"""Singular variants between the rows of a table, against places that are known in closed form.

Sources: Fichter's platform is [7] of tests/reference/known_answers.md; three bars hold a body in
the plane unless their lines meet in one point (Blanding, Exact Constraint, 1999); a slider-crank is
at its dead centres where crank and rod are in line; a parallelogram has change points where it is
folded flat (input_decks/linkages/parallelogram_flat.dat).
"""

import math
import pickle
from pathlib import Path

import numpy as np
import pytest

import flexact
from flexact import Model, Table, Verdict, analyse, sweep
from flexact.sweeps.evaluate import scaled_jacobian
from flexact.util.roots import Zero, minimum, sign_change

pytestmark = pytest.mark.dear(50)

DECKS = Path(__file__).parents[2] / "input_decks"
BASE = [(math.cos(a), math.sin(a), 0.0) for a in np.radians((0, 120, 240))]


def platform(yaw: float, height: float = 1.0) -> Model:
    """Hunt and Fichter's octahedral platform, singular at a yaw of 90 and -90 degrees."""
    top = [
        (0.6 * math.cos(a), 0.6 * math.sin(a), height)
        for a in np.radians((60, 180, 300)) + math.radians(yaw)
    ]
    model = Model()
    for i, j in ((0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)):
        model.truss(BASE[i], top[j])
    for i, j in ((0, 1), (1, 2), (2, 0)):
        model.truss(top[i], top[j])
    model.fix(*BASE)
    return model


def held_by(*bars: tuple[float, float, float, float]) -> Model:
    """A body in the plane on bars, each from a point of it in some direction."""
    model = Model(planar=True)
    ends = [model.node(x, y) for x, y, _, _ in bars]
    for end, (x, y, dx, dy) in zip(ends, bars, strict=True):
        foot = model.node(x + dx, y + dy)
        model.truss(end, foot)
        model.fix(foot)
    model.body(ends)
    return model


def three_bars(angle: float) -> Model:
    """Two bars along x and y whose lines meet in (1, 2); the third, from (0, 0), turns."""
    return held_by((-1, 2, -1, 0), (1, -1, 0, -1), (0, 0, -math.cos(angle), -math.sin(angle)))


def passing(offset: float) -> Model:
    """The third line passes the point in which the two others meet, (0, 0), by an offset."""
    return held_by((-1, 0, -1, 0), (0, -1, 0, -1), (1, 1 + offset, 1, 1))


def slider_crank(angle: float) -> Model:
    """The slide is driven: crank 1, rod 3."""
    model = Model(planar=True)
    pin = (math.cos(angle), math.sin(angle))
    slide = (pin[0] + math.sqrt(9.0 - pin[1] ** 2), 0.0)
    model.truss((0, 0), pin)
    model.truss(pin, slide)
    model.fix((0, 0))
    model.fix(slide, "y")
    model.independent(slide, "x")
    return model


def parallelogram(angle: float) -> Model:
    """Cranks 1, ground and coupler 3; nothing is declared."""
    c, s = math.cos(angle), math.sin(angle)
    model = Model(planar=True)
    for p, q in (((0, 0), (c, s)), ((c, s), (3 + c, s)), ((3 + c, s), (3, 0))):
        model.truss(p, q)
    model.fix((0, 0), (3, 0))
    return model


def test_fichters_platform_is_singular_at_a_right_angle() -> None:
    found = sweep(platform, {"yaw": np.linspace(-150, 150, 20)}, workers=1).crossings(workers=1)
    assert found.of("yaw") == pytest.approx([-90, 90], rel=1e-12)
    for each in found:
        assert each.kind == "sign change" and each.along == "yaw"
        assert each.verdict is Verdict.BOTH
        assert each.before is each.after is Verdict.EXACT
        assert each.singular_value < 1e-14 and each.width < 1e-14
        # Halving alone would take fifty.
        assert each.evaluations < 20
    assert sum(each.evaluations for each in found) <= found.evaluations < 60


def test_a_row_that_is_singular_itself_is_found_once() -> None:
    table = sweep(platform, flexact.grid(yaw=[60.0, 90.0, 120.0], height=[0.5, 1.0]), workers=1)
    found = table.crossings(workers=1)
    assert [(each.kind, each.rows, each.verdict) for each in found] == [
        ("row", (2, 2), Verdict.BOTH),
        ("row", (3, 3), Verdict.BOTH),
    ]
    assert [each.parameters for each in found] == [
        {"yaw": 90.0, "height": 0.5},
        {"yaw": 90.0, "height": 1.0},
    ]
    assert all(each.singular_value < 1e-15 for each in found)


def test_a_grid_is_searched_along_each_axis() -> None:
    """The lines of the bars meet where tan(angle) = 2, whatever the length is."""

    def make(length: float, angle: float) -> Model:
        c, s = length * math.cos(angle), length * math.sin(angle)
        return held_by((-1, 2, -1, 0), (1, -1, 0, -1), (0, 0, -c, -s))

    grid = flexact.grid(length=[1.0, 2.0, 3.0], angle=np.linspace(0, 3, 7))
    table = sweep(make, grid, workers=1)
    found = table.crossings(workers=1)
    assert [each.along for each in found] == ["angle"] * 3
    assert found.of("angle") == pytest.approx([math.atan(2)] * 3, rel=1e-12)
    assert found.of("length").tolist() == [1.0, 2.0, 3.0]
    assert len(table.crossings("length", workers=1)) == 0
    assert found[0].rows == (2, 3)


def test_dead_centres_of_a_slider_crank() -> None:
    table = sweep(slider_crank, {"angle": np.linspace(-0.45, 5.0, 12)}, workers=1)
    found = table.crossings(workers=1)
    assert found.of("angle") == pytest.approx([0, math.pi], rel=1e-12, abs=1e-15)


@pytest.mark.parametrize("beams", [1, 3])
def test_a_guide_of_two_sheets_that_point_at_its_declared_point(beams: int) -> None:
    """Then nothing stops the rotation about it: where the second sheet, turned by an angle about
    (0, 0.05), is in line with (0.1, 0), the end of the first. Over-constrained everywhere."""

    def make(angle: float) -> Model:
        end = (0.1 * math.cos(angle), 0.05 + 0.1 * math.sin(angle), 0)
        model = Model()
        for p, q in (((0, 0, 0), (0.1, 0, 0)), ((0, 0.05, 0), end)):
            model.sheet(p, q, width=(0, 0, 1), beams=beams)
            model.fix(p)
        model.body([(0.1, 0, 0), end], name="stage")
        model.independent("stage", "y")
        return model

    table = sweep(make, {"angle": np.linspace(-3, 3.1, 16)}, workers=1)
    assert set(table.verdict) == {Verdict.OVER.value}
    found = table.crossings(workers=1)
    known = [-math.atan(0.5), math.pi - math.atan(0.5)]
    assert found.of("angle") == pytest.approx(known, rel=1e-12)
    assert [(each.kind, each.verdict) for each in found] == [("touch", Verdict.BOTH)] * 2


@pytest.mark.parametrize("seed", range(8))
def test_every_change_of_sign_of_the_determinant_is_found(seed: int) -> None:
    """Random bars that turn and wander: the determinant of their three lines, at rows alone."""
    rng = np.random.default_rng(seed)
    places, speeds = rng.uniform(-1, 1, (3, 2)), rng.uniform(-0.5, 0.5, (3, 2))
    angles, turns = rng.uniform(0, 2 * math.pi, 3), rng.uniform(-2, 2, 3)

    def bars(t: float) -> list[tuple[float, float, float, float]]:
        return [
            (*(p + t * v), math.cos(a + t * w), math.sin(a + t * w))
            for p, v, a, w in zip(places, speeds, angles, turns, strict=True)
        ]

    def determinant(t: float) -> float:
        return float(np.linalg.det([(u, v, x * v - y * u) for x, y, u, v in bars(t)]))

    rows = np.linspace(0, 3, 20)
    table = sweep(lambda t: held_by(*bars(t)), {"t": rows}, want="verdict", workers=1)
    found = table.crossings(workers=1)
    signs = np.sign([determinant(t) for t in rows])
    changes = np.flatnonzero(signs[:-1] != signs[1:]).tolist()
    assert set(changes) <= {each.rows[0] for each in found}
    for t in found.of("t"):
        assert abs(determinant(t)) < 1e-13


def test_change_points_of_a_parallelogram() -> None:
    """Folded flat it has two motions and a self-stress, as in linkages/parallelogram_flat.dat."""
    table = sweep(parallelogram, {"angle": np.linspace(-0.45, 5.0, 12)}, workers=1)
    found = table.crossings(workers=1)
    assert found.of("angle") == pytest.approx([0, math.pi], rel=1e-12, abs=1e-14)
    assert [each.kind for each in found] == ["touch", "touch"]
    assert {each.verdict for each in found} == {Verdict.BOTH}
    assert {each.before for each in found} == {Verdict.UNDER}


def test_a_zero_that_is_touched_without_a_change_of_sign() -> None:
    def make(t: float) -> Model:
        return passing((t - 0.3) ** 2)

    (each,) = sweep(make, {"t": np.linspace(-1, 1, 12)}, workers=1).crossings(workers=1)
    assert each.kind == "touch"
    # A double root is known to the root of the rounding.
    assert each.parameters["t"] == pytest.approx(0.3, abs=1e-7)
    assert 1e-10 < each.width < 1e-6
    assert each.singular_value < 1e-14
    assert each.verdict is Verdict.BOTH


def test_two_roots_between_two_rows_that_only_dip() -> None:
    def make(t: float) -> Model:
        return passing((t - 0.3) ** 2 - 1e-4)

    found = sweep(make, {"t": np.linspace(-1, 1, 12)}, workers=1).crossings(workers=1)
    assert [each.kind for each in found] == ["sign change"] * 2
    assert found.of("t") == pytest.approx([0.29, 0.31], rel=1e-12)


@pytest.mark.parametrize("above", [1e-2, 1e-6, 1e-9])
def test_a_dip_that_ends_above_zero_is_none(above: float) -> None:
    def make(t: float) -> Model:
        return passing((t - 0.3) ** 2 + above)

    found = sweep(make, {"t": np.linspace(-1, 1, 12)}, workers=1).crossings(workers=1)
    assert len(found) == 0
    # Most of the search is spared where it leads nowhere.
    assert above < 1e-3 or found.evaluations < 20


def test_rank_drops_of_a_matrix_that_is_not_square() -> None:
    """Four bars, three of them through one point: singular where the fourth goes there, too."""

    def make(offset: float) -> Model:
        return held_by((-1, 0, -1, 0), (0, -1, 0, -1), (1, 1, 1, 1), (1, -1 + offset, 1, -1))

    table = sweep(make, {"offset": np.linspace(-1, 0.7, 8)}, workers=1)
    assert set(table.verdict) == {Verdict.OVER.value}
    (each,) = table.crossings(workers=1)
    assert each.kind == "touch"
    assert each.parameters["offset"] == pytest.approx(0, abs=1e-14)
    assert (each.before, each.verdict, each.after) == (Verdict.OVER, Verdict.BOTH, Verdict.OVER)


def test_rank_drops_further_where_all_variants_are_singular() -> None:
    """Bars through one point leave a rotation; all along one line leave a translation, too."""

    def make(angle: float) -> Model:
        c, s = math.cos(angle), math.sin(angle)
        return held_by((1, 0, 1, 0), (-1, 0, -1, 0), (2 * c, 2 * s, c, s))

    table = sweep(make, {"angle": np.linspace(-1.0, 1.3, 8)}, workers=1)
    assert set(table["under_constrained"]) == {1}
    (each,) = table.crossings(workers=1)
    assert each.parameters["angle"] == pytest.approx(0, abs=1e-12)
    assert each.verdict is Verdict.BOTH


def test_a_jump_of_the_sign_is_no_crossing() -> None:
    """The third line passes the point at one side, then at the other."""

    def make(t: float) -> Model:
        return passing(0.4 if t < 0.123 else -0.4)

    assert len(sweep(make, {"t": [0.0, 0.1, 0.2, 0.3]}, workers=1).crossings(workers=1)) == 0


def test_what_changes_the_topology_or_fails_ends_a_search() -> None:
    def make(t: float) -> Model:
        if 0.4 < t < 0.6:
            raise ZeroDivisionError("here")
        return passing(t - 0.5) if t < 0.5 else three_bars(t)

    table = sweep(make, {"t": np.linspace(0, 1, 10)}, workers=1)
    assert table.error[4].startswith("ZeroDivisionError")
    found = table.crossings(workers=1)
    assert len(found) == 0
    # Rows 3 and 6 are beside rows that could not be made: the dips there lead nowhere.
    assert all("ZeroDivisionError" in each.error for each in found.missed)


def test_another_mechanism_between_two_rows_is_not_followed() -> None:
    """From 0.45 to 0.55 it has a bar more; its singular values are no values of the rows'."""

    def make(t: float) -> Model:
        bars = [(-1, 0, -1, 0), (0, -1, 0, -1), (1, 1 + t - 0.5, 1, 1)]
        return held_by(*bars, *([(2, 1, 1, 3)] if 0.45 < t < 0.55 else []))

    table = sweep(make, {"t": [0.0, 0.2, 0.4, 0.6, 0.8]}, workers=1)
    assert set(table.verdict) == {Verdict.EXACT.value}
    found = table.crossings(workers=1)
    assert len(found) == 0
    (missed,) = found.missed
    assert missed.rows == (2, 3) and 0.45 < missed.parameters["t"] < 0.55
    assert "another mechanism" in missed.error and "1 search given up" in repr(found)


# Functions that are called in a search as they are called for rows


def test_functions_get_the_numbers_of_python_in_rows_and_in_searches() -> None:
    """The third line passes the point where the two others meet at 0, by a factor of 7."""
    kinds: set[type] = set()

    def make(s: float, n: int, word: str) -> Model:
        kinds.update((type(s), type(n), type(word)))
        # A function may read what it has written.
        return passing(7.0 * float(f"{s!r}"))

    rows = {"s": np.array([-0.3, 0.2]), "n": np.array([3, 3]), "word": np.array(["a", "a"])}
    found = sweep(make, rows, workers=1).crossings(workers=1)
    assert found.of("s") == pytest.approx([0.0], abs=1e-15)
    assert kinds == {float, int, str} and not found.missed
    assert all(type(value) in kinds for value in found[0].parameters.values())


@pytest.mark.parametrize("workers", [1, 2])
@pytest.mark.parametrize("steps", [2, 24])
def test_what_a_function_refuses_in_a_search_is_told(workers: int, steps: int) -> None:
    """It makes rows, but nothing between them: each search that is given up is counted."""
    rows = np.linspace(-1.0, 1.0, steps) + 0.01

    def make(t: float) -> Model:
        if t not in rows:
            raise LookupError("no such part in the catalogue")
        return passing(math.sin(20.0 * t))

    changes = int(np.count_nonzero(np.diff(np.sign(np.sin(20.0 * rows)))))
    found = sweep(make, {"t": rows}, workers=1).crossings(workers=workers)
    assert len(found) == 0
    told = [each for each in found.missed if "LookupError" in each.error]
    assert len(told) == len(found.missed) >= changes > 0
    for each in told:
        a, b = sorted(rows[list(each.rows)])
        assert a < each.parameters["t"] < b
    assert "given up" in repr(found) and "catalogue" in repr(found)


# Each crossing once, and none left out that the rows show


@pytest.mark.parametrize("seed", range(30))
def test_roots_by_pairs_are_found_each_once(seed: int) -> None:
    """The third line passes the point at the value of a polynomial whose roots are chosen.

    Rows may be symmetrical to a pair, so that two of them dip alike; or one of them a root.
    """
    rng = np.random.default_rng(seed)
    count = int(rng.integers(6, 14))
    rows = np.linspace(0.0, 1.0, count)
    step = rows[1]
    middle = 0.5 if seed % 3 == 0 else float(rng.choice(rows[2:-2]) + step * rng.uniform(0.2, 0.8))
    half = step * rng.uniform(0.02, 0.45)
    half = min(
        half, 0.9 * min(middle - rows[rows < middle].max(), rows[rows > middle].min() - middle)
    )
    roots = [middle - half, middle + half]
    if seed % 5 == 0:
        roots = [float(rng.choice(rows[1:-1]))]

    def make(t: float) -> Model:
        return passing(math.prod((t - root) * 2.0 for root in roots))

    found = sweep(make, {"t": rows}, workers=1).crossings(workers=1)
    assert found.of("t") == pytest.approx(sorted(roots), abs=1e-12)
    assert len(found) == len(roots) and not found.missed


def test_a_pair_amid_rows_that_dip_alike_is_two_crossings() -> None:
    def make(t: float) -> Model:
        return passing((t - 0.5) ** 2 - 0.03**2)

    found = sweep(make, {"t": np.linspace(0, 1, 10)}, workers=1).crossings(workers=1)
    assert found.of("t") == pytest.approx([0.47, 0.53], rel=1e-12)


def two_bars(angle: float) -> Model:
    """A pin on two bars of length 1, from the ground; they are in line at 0 and 180 degrees."""
    c, s = math.cos(math.radians(angle / 2.0)), math.sin(math.radians(angle / 2.0))
    model = Model(planar=True)
    for side in (-1.0, 1.0):
        model.truss((side * c, 0.0), (0.0, s))
        model.fix((side * c, 0.0))
    return model


@pytest.mark.parametrize("beside", [1e-3, 1e-6, 1e-8, 1e-9, 1e-10])
def test_rows_close_beside_a_singular_place_are_searched(beside: float) -> None:
    found = sweep(two_bars, {"angle": [-beside, 1.3 * beside]}, workers=1).crossings(workers=1)
    assert len(found) == 1
    assert found.of("angle") == pytest.approx([0.0], abs=1e-3 * beside)
    yaws = [90.0 - beside, 90.0 + 0.7 * beside]
    found = sweep(platform, {"yaw": yaws}, workers=1).crossings(workers=1)
    assert found.of("yaw") == pytest.approx([90.0], abs=1e-13 + 1e-2 * beside)


@pytest.mark.parametrize("first", [0.3, 0.5])
def test_a_root_between_a_singular_row_and_the_next_is_found(first: float) -> None:
    """The row has no sign of its own: that just beside it counts."""
    rows = [0.1, 0.3, 0.5, 0.7]

    def make(t: float) -> Model:
        return passing((t - first) * (t - 0.42) * 3.0)

    found = sweep(make, {"t": rows}, workers=1).crossings(workers=1)
    assert sorted(found.of("t")) == pytest.approx(sorted([first, 0.42]), rel=1e-12)


def four_bar(angle: float) -> Model:
    """Ground 4, crank 1 at an angle in degrees, coupler 3.5, rocker 2.5, whose end is driven."""
    pin = (math.cos(math.radians(angle)), math.sin(math.radians(angle)))
    dx, dy = 4.0 - pin[0], -pin[1]
    far = math.hypot(dx, dy)
    along = (3.5**2 - 2.5**2 + far**2) / (2.0 * far)
    up = math.sqrt(3.5**2 - along**2)
    end = (pin[0] + (along * dx - up * dy) / far, pin[1] + (along * dy + up * dx) / far)
    model = Model(planar=True)
    for p, q in (((0, 0), pin), (pin, end), (end, (4.0, 0.0))):
        model.truss(p, q)
    model.fix((0, 0), (4.0, 0.0))
    model.independent(end, "y")
    return model


@pytest.mark.parametrize("rows", [9, 14, 25])
def test_dead_centres_of_a_four_bar(rows: int) -> None:
    """Crank and coupler are in line, outstretched or folded: the law of cosines."""
    outer = math.degrees(math.acos((4.5**2 + 4.0**2 - 2.5**2) / (2 * 4.5 * 4.0)))
    inner = 180.0 + math.degrees(math.acos((2.5**2 + 4.0**2 - 2.5**2) / (2 * 2.5 * 4.0)))
    table = sweep(four_bar, {"angle": np.linspace(1.0, 359.0, rows)}, workers=1)
    found = table.crossings(workers=1)
    assert found.of("angle") == pytest.approx([outer, inner], rel=1e-12)


def test_positions_are_followed_along_straight_lines() -> None:
    """The platform's corners go along chords: it is smaller between two rows, and turned."""
    yaws = np.linspace(-140, 155, 24)
    model = platform(0.0)
    positions = np.array([platform(yaw).positions for yaw in yaws])
    # The order of the nodes is that in which they were made.
    table = sweep(model, {"yaw": yaws}, positions=positions, want="verdict", workers=1)
    found = table.crossings(workers=1)
    assert len(found) == 2
    for each, angle in zip(found, (-90, 90), strict=True):
        a, b = each.rows
        assert yaws[a] < angle < yaws[b] and each.along == "yaw"
        between = (1 - each.share) * positions[a] + each.share * positions[b]
        x, y, _ = between[between[:, 2] > 0][0]
        # On a chord the platform is smaller, but turned by as much at the singular place.
        assert abs(math.degrees(math.atan2(y, x)) - 60 - angle) % 360 == pytest.approx(0, abs=1e-9)
    assert found.evaluations < 100


def test_positions_without_parameters_are_neighbours_in_their_order() -> None:
    places = np.array([platform(yaw).positions for yaw in (60.0, 120.0, 60.0)])
    table = sweep(platform(0.0), positions=places, workers=1)
    found = table.crossings(workers=1)
    assert [(each.along, each.rows) for each in found] == [("rows", (0, 1)), ("rows", (1, 2))]
    # Halfway between 60 and 120 degrees.
    assert [each.share for each in found] == pytest.approx([0.5, 0.5], abs=1e-12)
    assert found[0].parameters == {}


def test_a_grid_of_positions_is_searched_along_both_labels() -> None:
    grid = flexact.grid(height=[1.0, 2.0], yaw=[50.0, 80.0, 110.0])
    places = np.array([platform(**row).positions for row in grid])
    found = sweep(platform(0.0), grid, positions=places, workers=1).crossings(workers=1)
    assert [(each.along, each.rows) for each in found] == [("yaw", (1, 2)), ("yaw", (4, 5))]


def test_models_too_large_to_sign_in_passing_are_signed_when_asked(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("flexact.sweeps.evaluate._MOST_SIGNED", 1)
    table = sweep(platform, {"yaw": [70.0, 100.0]}, workers=1)
    assert table.crossings(workers=1).of("yaw") == pytest.approx([90], rel=1e-12)


def test_masks_have_nothing_between_them() -> None:
    model = platform(10.0)
    held = np.repeat((model.deformation_classes == 1)[None], 3, axis=0)
    held[1, 0, 0] = False
    assert len(sweep(model, held=held, workers=1).crossings(workers=1)) == 0


def test_parameters_that_change_together_are_followed_in_the_order_of_rows() -> None:
    yaws = np.linspace(30, 140, 9)
    table = sweep(platform, {"yaw": yaws, "height": yaws / 50}, workers=1)
    with pytest.raises(ValueError, match="rows"):
        table.crossings()
    (each,) = table.crossings("rows", workers=1)
    assert each.parameters["yaw"] == pytest.approx(90, rel=1e-12)
    assert each.parameters["height"] == pytest.approx(1.8, rel=1e-12)


def test_crossings_do_not_depend_on_who_works() -> None:
    table = sweep(
        platform,
        flexact.grid(yaw=np.linspace(-150, 150, 10), height=[0.5, 1.0, 1.5, 2.0, 3.0]),
        workers=2,
    )
    assert table.crossings(workers=2).found == table.crossings(workers=1).found
    assert len(table.crossings(workers=2)) == 10


def test_what_cannot_be_searched_is_told_in_words() -> None:
    table = sweep(lambda yaw: platform(yaw), {"yaw": [0.0, 10.0]}, workers=1)
    with pytest.raises(ValueError, match="yaw"):
        table.crossings("length")
    back: Table = pickle.loads(pickle.dumps(table))
    assert back["yaw"].tolist() == [0.0, 10.0] and back.rank.tolist() == table.rank.tolist()
    with pytest.raises(flexact.FlexactError, match="Sweep again"):
        back.crossings()


@pytest.mark.parametrize(
    "deck",
    [
        "paper/six_folded_sheets",
        "paper/twelve_trusses",
        "flexures/five_wires",
        "flexures/parallel_guide_four_beams",
        "linkages/bennett",
        "linkages/parallelogram_flat",
    ],
)
def test_what_is_followed_is_the_scaled_matrix_of_the_analysis(deck: str) -> None:
    model = flexact.read(DECKS / f"{deck}.dat")
    values = np.linalg.svd(scaled_jacobian(model.data)[0], compute_uv=False)
    assert values == pytest.approx(analyse(model).scaled_singular_values, abs=1e-14)


@pytest.mark.parametrize("root", [0.5, 1e-9, 1 - 1e-9, 1 / 3])
def test_roots_are_found_to_the_last_bits(root: float) -> None:
    calls = []

    def function(x: float) -> float:
        calls.append(x)
        return math.expm1(x - root) * (2 + x)

    zero = sign_change(function, 0.0, 1.0, function(0.0), function(1.0))
    assert zero is not None
    assert zero.place == pytest.approx(root, abs=5e-16)
    assert len(calls) < 25


def test_a_steep_root_takes_no_more_than_halving_with_a_little_more() -> None:
    calls = []

    def function(x: float) -> float:
        calls.append(x)
        return math.copysign(abs(x - 0.7) ** 0.1, x - 0.7)

    zero = sign_change(function, 0.0, 1.0, function(0.0), function(1.0))
    assert zero is None or zero.place == pytest.approx(0.7, abs=1e-14)
    assert len(calls) < 120


def test_minima_at_zero_are_told_from_others() -> None:
    # As |x - c| and (x - c)**2 touch zero.
    sharp = minimum(lambda x: abs(x - 0.3), -1.0, 1.0)
    smooth = minimum(lambda x: (x - 0.3) ** 2, -1.0, 1.0)
    assert isinstance(sharp, Zero) and sharp.place == pytest.approx(0.3, abs=1e-15)
    assert isinstance(smooth, Zero) and smooth.place == pytest.approx(0.3, abs=1e-7)
    assert minimum(lambda x: (x - 0.3) ** 2 + 0.01, -1.0, 1.0) is None
    below = minimum(lambda x: (x - 0.3) ** 2 - 0.01, -1.0, 1.0)
    assert isinstance(below, float) and abs(below - 0.3) < 0.1
    assert minimum(lambda x: None, 0.0, 1.0) is None
