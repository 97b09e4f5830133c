# SPDX-License-Identifier: BSD-3-Clause
"""Families of mechanisms of any size, most of them with known counts.

Each function makes a model with about the number of dependent coordinates that is asked for,
and says how many motions and self-stresses it has. The counts follow from the construction:
a rigid framework, or mechanisms that are held exactly, with a few planted defects. Maxwell's
count, self-stresses = motions - columns + rows, gives one of the two from the other.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from assembly import Assembly, Floats, Indices

from flexact import Model
from flexact.core.elements import NodeKind


class Case(NamedTuple):
    """A model and what is known of it."""

    model: Model
    motions: int | None
    """Under-constraint, where the construction tells it."""
    stresses: int | None
    """Over-constraint, likewise."""

    @property
    def rows(self) -> int:
        """Rows of D(c)."""
        return self.model.data.count.rows

    @property
    def columns(self) -> int:
        """Columns of D(c)."""
        return self.model.data.count.columns


#: Fraction of a cell by which joints stand off the lattice: a power of two, so that places are
#: whole multiples of `_GRAIN` and the middle of a bar is exact.
_OFF_LATTICE = 0.125
_GRAIN = 2.0**-24
#: Joints that hang on two bars, one motion each.
_HUNG = 3
#: Distance between neighbouring stages [m].
_PITCH = 2.0
#: A folded sheet holds elongation and in-plane bending; the sheet's normal is local y.
_SHEET = (2, 5, 6)


def bar_grid(columns: int, seed: int = 1) -> Case:
    """T: a double-layer grid of bars, square on square offset, held along the lower edges.

    With five motions planted: three joints that hang on two bars, and one between two bars
    in a line. Its self-stresses grow with its size, as the bars of a cell are more than needed.
    """
    place, fixed, bars = _double_layer(columns, seed)
    assembly = Assembly()
    nodes = assembly.positions(place, fixed)
    assembly.bars(nodes[bars[:, 0]], nodes[bars[:, 1]])
    motions = _plant_joints(assembly, nodes, place, bars, fixed)
    return _counted(assembly.model(f"bar grid {columns}"), motions)


def random_removal(columns: int, seed: int = 1) -> Case:
    """Tb: the grid of `bar_grid` with bars taken out at random until D(c) is square.

    Mechanisms and self-stresses grow with its size; how many there are is not known.
    """
    place, fixed, bars = _double_layer(columns, seed)
    free = 3 * np.count_nonzero(~fixed)
    kept = np.random.default_rng(seed + 1).permutation(len(bars))[:free]
    bars = bars[np.sort(kept)]
    # A joint that lost all its bars would be no part of the model: it hangs on a new one.
    lonely = np.flatnonzero(np.bincount(bars.ravel(), minlength=len(place)) == 0)
    place = np.delete(place, lonely, axis=0)
    bars = bars - np.searchsorted(lonely, bars)
    fixed = np.delete(fixed, lonely)
    assembly = Assembly()
    nodes = assembly.positions(place, fixed)
    assembly.bars(nodes[bars[:, 0]], nodes[bars[:, 1]])
    return Case(assembly.model(f"random removal {columns}"), None, None)


def octet_lattice(columns: int, seed: int = 1) -> Case:
    """O: an octet truss that stands on its lowest layer, with five motions planted."""
    cells = max(2, round((columns / 12.0) ** (1 / 3)))
    place, bars = _octet(cells)
    fixed = place[:, 2] == 0.0
    place = place + _OFF_LATTICE * _jitter(seed, place.shape)
    bars = bars[~(fixed[bars[:, 0]] & fixed[bars[:, 1]])]
    assembly = Assembly()
    nodes = assembly.positions(place, fixed)
    assembly.bars(nodes[bars[:, 0]], nodes[bars[:, 1]])
    motions = _plant_joints(assembly, nodes, place, bars, fixed)
    return _counted(assembly.model(f"octet lattice {columns}"), motions)


def stage_array(columns: int, seed: int = 1) -> Case:
    """B: stages in a square array, each on folded sheets to the ground and to its neighbours.

    Four folded sheets hold a stage to the ground: along z at three places, which leaves it in
    its plane, and one across that ties its rotation to its translation along x. One to the
    neighbour on the left takes y and one to the neighbour below takes x. So each stage has six
    constraints for its six coordinates. The internal motion of every flexure is declared,
    but for two (a motion each), and at the wrong end for two (a motion and a self-stress each).
    """
    return _stages(columns, seed, planted=True, alternate=True, name="stage array")


def small_stages(columns: int, seed: int = 1, pitch: float = 1e-9) -> Case:
    """The array of stages without defects, `pitch` metres from one stage to the next.

    Translations and rotations then differ by the inverse of that, and so do the singular
    values: D(c) is graded, though what it stands for is as well conditioned as ever.
    """
    case = _stages(columns, seed, planted=False, alternate=True, name="small stages")
    data = case.model.data
    value = data.arrays.node_value.copy()
    value[:3, data.arrays.node_kind == NodeKind.POSITION] *= pitch / _PITCH
    arrays = data.arrays._replace(node_value=value)
    return case._replace(model=Model.from_data(replace(data, arrays=arrays)))


def ill_conditioned(columns: int, seed: int = 1, arm: float = 1.6) -> Case:
    """Bx: the stages of `stage_array`, but along y each amplifies the motion of the last.

    It is exactly constrained, but its smallest singular value falls exponentially with its
    size, the faster the nearer `arm` [m] is to half the distance between stages, 1.
    """
    return _stages(columns, seed, planted=False, alternate=False, name="amplifying array", arm=arm)


def chains(columns: int, seed: int = 1) -> Case:
    """C: separate closed chains of six links and seven hinges, one rotation declared.

    A loop of seven hinges in general position has one motion, so that it is held exactly;
    in two of the chains it is not declared (a motion each), and in one the hinges are
    parallel (three motions and three self-stresses).
    """
    count = max(4, round(columns / 51))
    assembly = Assembly()
    place, axis = _loops(count, seed)
    axis[0] = (0.0, 0.0, 1.0)
    inner = assembly.positions(place[:, 1:6]).reshape(count, 5)
    ends = assembly.positions(place[:, [0, 6]], True).reshape(count, 2)
    joint = np.column_stack([ends[:, 0], inner, ends[:, 1]])
    ground = assembly.orientations(2 * count, True).reshape(count, 2)
    before = assembly.orientations(6 * count).reshape(count, 6)
    after = assembly.orientations(6 * count).reshape(count, 6)
    before = np.column_stack([ground[:, 0], before])
    after = np.column_stack([after, ground[:, 1]])
    across = np.cross(np.diff(place, axis=1), [0.3, -0.5, 0.8])
    assembly.beams(
        (joint[:, :-1].ravel(), after[:, :-1].ravel()),
        (joint[:, 1:].ravel(), before[:, 1:].ravel()),
        across.reshape(-1, 3),
    )
    declared = np.zeros((count, 7), int)
    declared[:, 0] = 1
    declared[[1, 2], 0] = 0
    assembly.hinges(before.ravel(), after.ravel(), axis.reshape(-1, 3), declared.ravel())
    return _counted(assembly.model(f"chains {columns}"), motions=5)


def two_bars(first: float, second: float) -> Model:
    """A joint on two bars in a plane, with slopes `first` and `second`; it may leave the plane."""
    assembly = Assembly()
    ends = assembly.positions([[1.0, first, 0.0], [-1.0, -second, 0.0]], True)
    joint = assembly.positions([[0.0, 0.0, 0.0]])
    assembly.bars(np.repeat(joint, 2), ends)
    return assembly.model("two bars")


#: By the letter that the table uses.
FAMILIES: dict[str, Callable[[int], Case]] = {
    "T": bar_grid,
    "O": octet_lattice,
    "B": stage_array,
    "C": chains,
    "Tb": random_removal,
    "Bx": ill_conditioned,
}


def _counted(model: Model, motions: int) -> Case:
    """The case, its self-stresses by Maxwell's count."""
    count = model.data.count
    return Case(model, motions, motions - count.columns + count.rows)


def _jitter(seed: int, shape: tuple[int, ...]) -> Floats:
    """Numbers between -1/2 and 1/2, multiples of `_GRAIN`."""
    whole = np.random.default_rng(seed).integers(0, round(1 / _GRAIN), shape, endpoint=True)
    made: Floats = whole.astype(np.float64) * _GRAIN - 0.5
    return made


def _lattice(*sizes: int) -> Indices:
    """(k, dimensions) whole coordinates of a block of a lattice, the last one fastest."""
    return np.stack([grid.ravel() for grid in np.indices(sizes)], axis=1)


def _double_layer(columns: int, seed: int) -> tuple[Floats, np.ndarray, Indices]:
    """Joints (k, 3), which of them are held, and bars (b, 2) by index of their joints."""
    side = max(2, round((1 + ((2 * columns - 3) / 3) ** 0.5) / 2))
    lower, upper = _lattice(side + 1, side + 1), _lattice(side, side)
    place = np.concatenate(
        [np.column_stack([lower, 0 * lower[:, 0]]), np.column_stack([upper + 0.5, 0 * upper[:, 0]])]
    ).astype(np.float64)
    place[len(lower) :, 2] = 0.75
    edge = np.any((lower == 0) | (lower == side), axis=1)
    fixed = np.concatenate([edge, np.zeros(len(upper), bool)])
    place += _OFF_LATTICE * _jitter(seed, place.shape)
    low = np.arange(len(lower)).reshape(side + 1, side + 1)
    up = len(lower) + np.arange(len(upper)).reshape(side, side)
    pairs = [(low[1:], low[:-1]), (low[:, 1:], low[:, :-1]), (up[1:], up[:-1])]
    pairs += [(up[:, 1:], up[:, :-1]), (up, low[:-1, :-1]), (up, low[1:, :-1])]
    pairs += [(up, low[:-1, 1:]), (up, low[1:, 1:])]
    bars = np.concatenate([np.column_stack([p.ravel(), q.ravel()]) for p, q in pairs])
    return place, fixed, bars[~(fixed[bars[:, 0]] & fixed[bars[:, 1]])]


def _octet(cells: int) -> tuple[Floats, Indices]:
    """Joints of a face-centred lattice in a cube of cells, and the bars between neighbours."""
    whole = _lattice(*(2 * cells + 1,) * 3)
    whole = whole[whole.sum(axis=1) % 2 == 0]
    index = np.full((2 * cells + 3,) * 3, -1)
    index[tuple((whole + 1).T)] = np.arange(len(whole))
    steps = [(1, 1, 0), (1, -1, 0), (1, 0, 1), (1, 0, -1), (0, 1, 1), (0, 1, -1)]
    near = np.stack([index[tuple((whole + 1 + step).T)] for step in np.array(steps)])
    here = np.broadcast_to(np.arange(len(whole)), near.shape)
    there = near >= 0
    return whole / 2.0, np.column_stack([here[there], near[there]])


def _plant_joints(
    assembly: Assembly, nodes: Indices, place: Floats, bars: Indices, fixed: np.ndarray
) -> int:
    """Add three joints on two bars each, and one in the middle of a line; return the motions.

    A joint on two bars keeps one motion. One between two bars in a line keeps two, and a
    self-stress that the rest, being rigid, takes.
    """
    free = np.flatnonzero(~fixed[bars].any(axis=1))
    chosen = bars[free[np.linspace(0, free.size - 1, _HUNG + 1).astype(int)]]
    middle = place[chosen].mean(axis=1)
    middle[:_HUNG] += [0.13, 0.08, 0.9]
    joints = assembly.positions(middle)
    assembly.bars(nodes[chosen[:, 0]], joints)
    assembly.bars(nodes[chosen[:, 1]], joints)
    return _HUNG + 2


def _loops(count: int, seed: int) -> tuple[Floats, Floats]:
    """Seven hinge places and axes of each loop, (count, 7, 3)."""
    turn = np.arange(7) * (2 * np.pi / 7)
    round_about = np.stack([np.cos(turn), np.sin(turn), 0.4 * np.sin(3 * turn + 1)], axis=1)
    axes = np.stack([np.cos(2 * turn), np.sin(5 * turn + 1), np.cos(turn + 2)], axis=1)
    side = int(np.ceil(count**0.5))
    stand = np.column_stack([*np.divmod(np.arange(count), side), np.zeros(count)])
    place = 3.0 * stand[:, None] + round_about + 0.1 * _jitter(seed, (count, 7, 3))
    axis = axes + 0.1 * _jitter(seed + 1, (count, 7, 3))
    return place, axis / np.linalg.norm(axis, axis=2, keepdims=True)


class _Stages(NamedTuple):
    """Stages and the ground beside the first ones, which stands in for a neighbour."""

    place: Floats
    """(stages, 3)."""
    point: tuple[Indices, Indices]
    """Position and orientation."""


class _Sheets(NamedTuple):
    """Folded sheets: where they start, their folds, and the bodies that they hold."""

    start: tuple[Indices, Indices]
    start_place: Floats
    fold_place: Floats
    end: tuple[Indices, Indices]
    end_place: Floats
    line: Floats
    """(k, 3) direction of the fold line, along which a constraint acts."""


def _stages(
    columns: int, seed: int, planted: bool, alternate: bool, name: str, arm: float = 1.6
) -> Case:
    side = max(2, round((columns / 42) ** 0.5))
    cell = _lattice(side, side)
    place = np.column_stack([_PITCH * cell, np.zeros(len(cell))])
    assembly = Assembly()
    stages = _Stages(place, (assembly.positions(place), assembly.orientations(len(place))))
    # Which way the arm stands that ties rotation to translation.
    out = np.where(cell[:, 1] % 2 == 1, arm, -arm) if alternate else np.full(len(cell), -arm)
    sheets = _to_the_ground(assembly, stages, seed, out)
    sheets += [_to_neighbours(assembly, stages, side, axis, seed + 10 + axis) for axis in (0, 1)]
    for k, group in enumerate(sheets):
        _fold(assembly, group, planted and k in (0, 3))
    return _counted(assembly.model(f"{name} {columns}"), motions=4 if planted else 0)


def _to_the_ground(assembly: Assembly, stages: _Stages, seed: int, arm: Floats) -> list[_Sheets]:
    """Three folded sheets with vertical fold lines, and one with its fold line along x."""
    made = []
    for k, turn in enumerate(np.deg2rad([40.0, 160.0, 280.0])):
        out = np.array([np.cos(turn), np.sin(turn), 0.0])
        aside = np.array([-np.sin(turn), np.cos(turn), 0.0])
        made.append(_ground_group(assembly, stages, out, out + aside, [0.0, 0.0, 1.0], seed + k))
    out = arm[:, None] * [0.0, 1.0, 0.0]
    made.append(_ground_group(assembly, stages, out, out - np.eye(3)[2], [1.0, 0.0, 0.0], seed + 3))
    return made


def _ground_group(
    assembly: Assembly, stages: _Stages, fold: Floats, foot: Floats, line: list[float], seed: int
) -> _Sheets:
    count = len(stages.place)
    fold_place = stages.place + fold + 0.03 * _jitter(seed, (count, 3))
    foot_place = stages.place + foot
    feet = assembly.positions(foot_place, True), assembly.orientations(count, True)
    lines = np.array(line) + 0.03 * _jitter(seed + 100, (count, 3))
    return _Sheets(feet, foot_place, fold_place, stages.point, stages.place, lines)


def _to_neighbours(assembly: Assembly, stages: _Stages, side: int, axis: int, seed: int) -> _Sheets:
    """To the neighbour before along x (0) or y (1), or to the ground beside the first one."""
    index = np.arange(side * side).reshape(side, side)
    index = index if axis == 0 else index.T
    step = _PITCH * np.eye(3)[axis]
    beside = stages.place[index[0]] - step
    ground = assembly.positions(beside, True), assembly.orientations(side, True)
    start = tuple(
        np.concatenate([g, own[index[:-1].ravel()]])
        for g, own in zip(ground, stages.point, strict=True)
    )
    end_index = np.concatenate([index[0], index[1:].ravel()])
    end_place = stages.place[end_index]
    fold_place = end_place - step / 2 - [0.0, 0.0, _PITCH / 2]
    fold_place += 0.03 * _jitter(seed, end_place.shape)
    lines = np.eye(3)[1 - axis] + 0.03 * _jitter(seed + 100, end_place.shape)
    position, orientation = (own[end_index] for own in stages.point)
    return _Sheets(
        (start[0], start[1]),
        end_place - step,
        fold_place,
        (position, orientation),
        end_place,
        lines,
    )


def _fold(assembly: Assembly, sheets: _Sheets, planted: bool) -> None:
    """Two sheets each, the bending of the first at the fold declared.

    Where `planted`, a quarter of the way through it is not declared, and halfway that at the
    clamped end is declared in its place.
    """
    count = len(sheets.fold_place)
    fold = assembly.positions(sheets.fold_place), assembly.orientations(count)
    declared = np.full(count, 6)
    if planted:
        declared[count // 4] = 0
        declared[count // 2] = 5
    normal = np.cross(sheets.line, sheets.fold_place - sheets.start_place)
    assembly.beams(sheets.start, fold, normal, _SHEET, declared)
    normal = np.cross(sheets.line, sheets.end_place - sheets.fold_place)
    assembly.beams(fold, sheets.end, normal, _SHEET)
