# SPDX-License-Identifier: BSD-3-Clause
"""Sets of releases: their number, and that those listed work, by routes that share nothing."""

import math
import random
import re
import sys
from fractions import Fraction
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from counted_sets import releases_counted, self_stresses
from known_models import folded_sheet, ring, twelve_trusses
from pasting import without_notes
from random_models import framework, mechanism
from reference_decks import NAMES, text_of, transform
from turned_elements import plain as as_made
from turned_elements import turned

sys.path.append(str(Path(__file__).resolve().parents[1]))

from attack.exact_deck import read
from attack.truth import residues

import flexact
from flexact import Analysis, Model, analyse
from flexact.advice.releases import candidates as reach
from flexact.advice.releases.releases import by_steps, releases_of
from flexact.advice.step import Purpose
from flexact.analysis import ways as leverage
from flexact.analysis.naming import Named, plain
from flexact.core.elements import Class

pytestmark = pytest.mark.dear(50)

#: Beams without vectors on a lattice of 0.05, many of whose default axes tie.
TIES = """\
BEAM 1 1 2 7 8
BEAM 2 7 8 9 10 0.8 -0.6 0
BEAM 3 1 2 11 12
BEAM 4 11 12 15 16 -0.0009 -0.0012 0.00225
BEAM 5 15 16 13 14 0 0 -0.00225
BEAM 6 3 4 17 18
BEAM 7 1 2 19 20
BEAM 8 17 18 19 20 1 -1 0
BEAM 9 3 4 21 22
BEAM 10 1 2 23 24
BEAM 11 21 22 23 24 0 -1 0
BEAM 12 3 4 25 26
BEAM 13 25 26 27 28 0.6 0 0
BEAM 14 5 6 29 30
BEAM 15 29 30 31 32 1 0 0
BEAM 16 5 6 33 34
PINBODY 17 33 34 37
HINGE 18 34 38 0 0 1
BEAM 19 37 38 35 36
BEAM 20 5 6 39 40
BEAM 21 3 4 41 42
BEAM 22 39 40 41 42 1 -1 0
X 1 0.05 0 0.2
X 3 0.2 0.3 0.25
X 5 0.7 0.7 0.3
X 7 -0.05 -0.1 0
X 9 -0.05 -0.1 0.1
X 11 0 -0.2 0
X 13 0 -0.2 0.1
X 15 0.09 -0.08 0.1
X 17 -0.15 0.05 0
X 19 -0.15 0.05 0.2
X 21 -0.05 -0.15 0
X 23 -0.05 -0.15 0.3
X 25 0.2 0.05 0
X 27 0.2 0.05 0.2
X 29 0.15 -0.2 0
X 31 0.15 -0.2 0.25
X 33 0.05 -0.05 0
X 35 0.05 -0.05 0.1
X 37 0.05 -0.05 0
X 39 0.1 0.2 0
X 41 0.1 0.2 0.3
FIX 9
FIX 10
RLSE 2 2 3 4 5 6
FIX 13
FIX 14
RLSE 4 2 5 6
RLSE 5 2 5 6
RLSE 8 2 5 6
RLSE 11 2 3 4 5 6
FIX 27
FIX 28
RLSE 13 2 5 6
FIX 31
FIX 32
RLSE 15 2 3 4 5 6
FIX 35
FIX 36
RLSE 18 1
RLSE 22 2 5 6
DYNX 1 1
END
HALT
END
END
"""
#: Of its releases some leave a mechanism whose smallest singular value is 5e-7.
NEARLY_REGULAR = """\
BEAM 1 1 2 3 4
BEAM 2 3 4 5 6 -0.36 0.64 -0.48
BEAM 3 1 2 7 8
BEAM 4 7 8 9 10 0.6 0 0.8
BEAM 5 1 2 11 12
BEAM 6 11 12 13 14 0 0 1
X 1 -0.2 -0.15 0
X 3 -0.05 0.2 -0.05
X 5 0.11 0.2 -0.17
X 7 0.2 0.05 -0.1
X 9 0.2 0.25 -0.1
X 11 -0.05 0.05 -0.05
X 13 -0.05 0.25 -0.05
FIX 5
FIX 6
RLSE 2 2 5 6
FIX 9
FIX 10
RLSE 4 2 5 6
FIX 13
FIX 14
RLSE 6 5 6
DYNX 1 2
END
HALT
END
END
"""


def of_deck(name: str) -> Analysis:
    return analyse(flexact.read_text(text_of(name), name))


def test_the_twelve_trusses_have_twelve_releases() -> None:
    """Every bar carries the only self-stress (paper, Table 2); legs are alike, and sides."""
    releases = releases_of(analyse(twelve_trusses()))
    assert (releases.size, releases.count) == (1, 12)
    legs, sides = releases.sets
    assert len(legs.alternatives) == 7
    assert len(sides.alternatives) == 3
    assert all(each.after.over_constrained == 0 for each in releases.sets)
    # Of a unit vector with twelve equal entries.
    assert legs.condition == pytest.approx(math.sqrt(12.0))


@pytest.mark.parametrize(
    ("name", "size", "count"),
    [
        # Both in-plane bendings of both sheets carry the moment, and the twist of the body.
        ("flexures/parallel_guide_undeclared", 1, 5),
        ("flexures/parallel_guide", 1, 5),
        # The same of each of eight beams, as the deck stands.
        ("flexures/parallel_guide_four_beams", 1, 17),
        ("flexures/parallel_guide_four_beams_undeclared", 1, 17),
        # All that it holds: D(c) has no columns. Of the four elongations one, of the in-plane
        # bending moments, which are linear along it, at two of five places.
        ("flexures/sheet_clamped_both_ends", 3, 1),
        ("flexures/sheet_clamped_both_ends_four_beams", 3, 4 * (math.comb(8, 2) - 3)),
        # The clamped ends alone.
        ("paper/folded_sheet_clamped", 1, 2),
        # The empty set.
        ("paper/five_folded_sheets", 0, 1),
    ],
)
def test_counts_that_follow_by_hand(name: str, size: int, count: int) -> None:
    releases = releases_of(of_deck(name))
    assert (releases.size, releases.count) == (size, count)
    assert bool(releases.sets) == bool(count)


@pytest.mark.parametrize("name", [name for name in NAMES if "wavy" not in name])
def test_of_every_deck_the_count_is_right_and_the_sets_work(name: str) -> None:
    analysis = of_deck(name)
    releases = releases_of(analysis)
    truth = releases_counted(analysis.given)
    assert truth is None or releases.count == truth
    assert bool(releases.sets) == (releases.count != 0)
    for proposal in (*releases.sets, *releases.others):
        assert proposal.purpose is Purpose.RELEASE
        assert self_stresses(proposal.change.apply(analysis.given).data) == 0
        assert proposal.condition >= 1.0 - 1.0e-9 or proposal in releases.others
    for proposal in releases.sets:
        assert len(proposal.change.deformations) == releases.size


@pytest.mark.parametrize("seed", range(3))
def test_of_random_models_the_count_is_right(seed: int) -> None:
    random = np.random.default_rng(seed)
    with_several = 0
    for k in range(24):
        if k % 2:
            made = mechanism(random, planar=bool(k % 4 == 1))
        else:
            bars, supports = int(random.integers(6, 18)), int(random.integers(1, 4))
            made = framework(random, int(random.integers(4, 8)), bars, supports, bool(k % 4))
        try:
            analysis = analyse(made)
        except flexact.ModelError:
            continue
        truth = releases_counted(analysis.given)
        if truth is None:
            continue
        releases = releases_of(analysis)
        assert releases.count == truth
        assert bool(releases.sets) == (truth != 0)
        with_several += releases.size > 1
    assert with_several > 1


def grid(random: np.random.Generator) -> tuple[Model, np.ndarray]:
    """Bars in the plane between joints on a grid, and their equations of balance, exactly."""
    model = Model(planar=True)
    places = [(x, y) for x in range(3) for y in range(2)]
    nodes = [model.node(float(x), float(y)) for x, y in places]
    pairs = list(combinations(range(6), 2))
    chosen = [pairs[k] for k in sorted(random.permutation(15)[: random.integers(8, 12)].tolist())]
    free = [k for k in range(2, 6) if any(k in pair for pair in chosen)]
    rows = []
    for i, j in chosen:
        model.truss(nodes[i], nodes[j])
        way = [places[j][axis] - places[i][axis] for axis in (0, 1)]
        rows.append([((k == j) - (k == i)) * way[axis] for k in free for axis in (0, 1)])
    for k in (0, 1):
        if any(k in pair for pair in chosen):
            model.fix(nodes[k])
    return model, np.array(rows, dtype=object)


def exact_rank(rows: np.ndarray) -> int:
    rest = [[Fraction(value) for value in row] for row in rows]
    found = 0
    for column in range(len(rest[0]) if rest else 0):
        pivot = next((r for r in range(found, len(rest)) if rest[r][column]), None)
        if pivot is None:
            continue
        rest[found], rest[pivot] = rest[pivot], rest[found]
        for r in range(found + 1, len(rest)):
            factor = rest[r][column] / rest[found][column]
            rest[r] = [a - factor * b for a, b in zip(rest[r], rest[found], strict=True)]
        found += 1
    return found


@pytest.mark.parametrize("seed", range(6))
def test_bars_on_a_grid_are_counted_as_fractions_say(seed: int) -> None:
    """What is left when bars are taken out, in arithmetic that rounds nothing."""
    model, rows = grid(np.random.default_rng(seed))
    releases = releases_of(analyse(model))
    size = len(rows) - exact_rank(rows)
    assert releases.size == size
    every = range(len(rows))
    truth = sum(
        exact_rank(rows[[k for k in every if k not in gone]]) == len(rows) - size
        for gone in combinations(every, size)
    )
    assert releases.count == truth


def minors_counted(text: str) -> int:
    """Sets of fixed deformations whose release leaves no self-stress, exact: modulo a prime.

    By all square blocks of the left null space of the exact rows of the deck's decimals.
    """
    deck, prime = read(text), 2**31 - 1
    rows = residues(deck, deck.columns(), prime)
    whole = np.zeros((len(rows), len(deck.columns()) + len(rows)), np.int64)
    for k, row in enumerate(rows):
        whole[k, list(row)] = list(row.values())
        whole[k, len(deck.columns()) + k] = 1
    rank = 0
    for column in range(len(deck.columns())):
        here = np.flatnonzero(whole[rank:, column])
        if not here.size:
            continue
        whole[[rank, rank + here[0]]] = whole[[rank + here[0], rank]]
        whole[rank] = whole[rank] * pow(int(whole[rank, column]), -1, prime) % prime
        below = whole[rank + 1 :]
        below[:] = (below - below[:, [column]] * whole[rank] % prime) % prime
        rank += 1
    stresses = whole[rank:, len(deck.columns()) :].T
    size = stresses.shape[1]
    able = np.flatnonzero(stresses.any(axis=1))
    every = np.array(list(combinations(able.tolist(), size)), np.int64)
    return int(sum(regular(stresses[some], prime) for some in np.array_split(every, 20)))


def regular(block: np.ndarray, prime: int) -> int:
    """How many blocks (n, k, k) are regular modulo a prime below 2^31."""
    sets, n = np.arange(len(block)), block.shape[1]
    is_regular = np.ones(len(block), bool)
    for k in range(n):
        pivot = k + np.argmax(block[:, k:, k] != 0, axis=1)
        block[sets, pivot], block[:, k] = block[:, k].copy(), block[sets, pivot]
        is_regular &= block[:, k, k] != 0
        for i in range(k + 1, n):
            left, right = block[:, [k], k] * block[:, i], block[:, [i], k] * block[:, k]
            block[:, i] = (left % prime - right % prime) % prime
    return int(np.count_nonzero(is_regular))


@pytest.mark.parametrize("deck", [TIES, NEARLY_REGULAR], ids=["ties", "nearly regular blocks"])
def test_counts_are_those_of_the_decimals(deck: str) -> None:
    """Axes that tie are those of the decimals; what rounding leaves in doubt is counted apart."""
    analysis = analyse(flexact.read_text(deck))
    releases = releases_of(analysis)
    assert analysis.certainty is flexact.Certainty.CERTAIN
    assert releases.count is not None and releases.doubtful is not None
    assert releases.count + releases.doubtful == minors_counted(deck)
    assert (releases.doubtful > 0) == (deck is NEARLY_REGULAR)
    advice = analysis.advice()
    advice.count()
    told = advice.to_dict()
    assert told["releases"]["doubtful"] == releases.doubtful
    assert any(str(releases.doubtful) in each for each in told["left_out"]) == bool(
        releases.doubtful
    )


def test_a_set_of_a_large_model_is_found_step_by_step() -> None:
    """As of models of which not all null vectors fit."""
    for name in ("flexures/notch_guide", "flexures/double_parallel_guide"):
        analysis = of_deck(name)
        one = by_steps(analysis, Purpose.RELEASE, reach.of_rows, lambda _, rows: rows.rows[:, 0])
        assert one is not None
        assert len(one.change.deformations) == analysis.over_constrained
        assert self_stresses(one.change.apply(analysis.given).data) == 0


def test_guides_side_by_side_are_counted_by_products() -> None:
    """Each has five releases; beyond 2^53 a count is not given."""
    for guides, count in ((4, 5**4), (22, 5**22), (24, None)):
        model = Model()
        for k in range(guides):
            ground = [(0.0, y, float(k)) for y in (0.0, 0.05)]
            stage = [(0.1, y, float(k)) for y in (0.0, 0.05)]
            for start, end in zip(ground, stage, strict=True):
                model.sheet(start, end, width=(0, 0, 1))
                model.fix(start)
            model.body(stage, name=f"stage {k}")
        releases = releases_of(analyse(model))
        assert (releases.size, releases.count) == (guides, count)
        assert releases.sets


def test_what_is_alike_is_one_proposal() -> None:
    """Fig. 6: six flexures of two sheets each, and the torsion of the body."""
    releases = releases_of(of_deck("paper/six_folded_sheets"), with_bodies=True)
    at_rim, at_ground, body, *_ = releases.sets
    assert len(at_rim.alternatives) == len(at_ground.alternatives) == 5
    assert body.change.deformations == ((21, 2, Class.DEPENDENT),)
    assert not body.alternatives


def test_a_ring_of_an_even_number_has_as_many_alternatives_as_bars() -> None:
    releases = releases_of(analyse(ring(4)))
    assert releases.count == 12
    assert sum(1 + len(each.alternatives) for each in releases.sets) == 12


def test_insides_of_bodies_are_no_designs() -> None:
    """Nobody makes the inside of a rigid body soft: only where it is asked for, and then last."""
    analysis = of_deck("flexures/parallel_guide")
    plain, asked = (
        [each.change.deformations[0][0] for each in releases_of(analysis, with_bodies).sets]
        for with_bodies in (False, True)
    )
    assert 3 not in plain
    assert asked == [*plain, 3]
    rows = leverage.releases(analysis)
    assert 3 not in analysis.raw.row_label[0, rows]


def test_bodies_are_released_where_there_is_nothing_else() -> None:
    """A ring of four rigid beams in the plane that holds itself three times."""
    model = Model(planar=True)
    nodes = [model.node(x, y) for x, y in ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))]
    for k, node in enumerate(nodes):
        model.beam(node, nodes[(k + 1) % 4])
    model.fix(nodes[0])
    analysis = analyse(model)
    assert analysis.over_constrained == 3
    assert releases_of(analysis).sets
    assert leverage.releases(analysis)


def three_bars(areas: tuple[float, float, float]) -> Model:
    """A joint that three bars hold in the plane, of lengths 1 and sqrt(2)."""
    model = Model(planar=True)
    joint = model.node(0.0, 0.0, name="joint")
    for (x, y), name, area in zip(((0, 1), (1, 0), (1, 1)), "ABC", areas, strict=True):
        foot = model.node(float(x), float(y))
        diameter = 2 * math.sqrt(area / math.pi)
        model.truss(joint, foot, name=name, section=diameter, material="steel")
        model.fix(foot)
    return model


def test_where_stiffness_is_known_what_stores_most_is_released_first() -> None:
    """Balance: forces 1, 1, -sqrt(2). Energies: 1/A, 1/B and 2 sqrt(2)/C of areas A, B, C."""
    for areas in ((1e-4, 2e-4, 9e-4), (5e-4, 2e-4, 9e-4), (5e-4, 4e-4, 3e-4)):
        energy = dict(zip("ABC", np.array((1.0, 1.0, 2.0 * math.sqrt(2.0))) / areas, strict=True))
        analysis = analyse(three_bars(areas))
        names = [
            analysis.parts.of_element(analysis.given.element_index[number]).name
            for each in releases_of(analysis).sets
            for number, _, _ in each.change.deformations
        ]
        assert names == sorted(energy, key=lambda name: -energy[name])


def test_a_number_of_self_stresses_that_declarations_alone_cause_has_no_release() -> None:
    """A joint driven along both axes by the only two bars that hold it."""
    model = Model(planar=True)
    joint = model.node(0.0, 0.0)
    for x, y in ((1.0, 0.0), (0.0, 1.0)):
        foot = model.node(x, y)
        model.fix(foot)
        model.independent(model.truss(joint, foot), "elongation")
    model.fix(joint)
    releases = releases_of(analyse(model))
    assert (releases.size, releases.count, releases.sets) == (2, 0, ())
    assert releases.others


def words_of(analysis: Analysis) -> list[str]:
    """What is said of all sets, without statements."""
    releases = releases_of(analysis)
    told = (plain(each.words()) for each in releases.sets)
    return [str(releases.count), *(re.sub(r" \(RLSE[^)]*\)", "", each) for each in told)]


@pytest.mark.grid
@pytest.mark.parametrize("name", NAMES[1::3])
def test_words_depend_neither_on_units_nor_on_how_elements_are_told(name: str) -> None:
    analysis = of_deck(name)
    words = words_of(analysis)
    assert words_of(analyse(flexact.read_text(transform.scaled(text_of(name), 1e3)))) == words
    made = analyse(Model.from_data(as_made(analysis.given)))
    # Calls name what they can: numbers of beams that run against each other.
    told = (words_of(analyse(turned(analysis.given, 1))), words_of(made))
    assert [*map(without_notes, told[0])] == [*map(without_notes, told[1])]


def test_a_divided_sheet_is_told_as_one_of_one_beam() -> None:
    for name in ("parallel_guide", "cross_hinge", "sheet_clamped_both_ends"):
        words = words_of(of_deck(f"flexures/{name}"))[1:]
        for divided in (f"{name}_four_beams", f"{name}_four_beams_undeclared"):
            assert words_of(of_deck(f"flexures/{divided}"))[1:] == words


def test_parts_are_named_and_statements_given() -> None:
    analysis = of_deck("paper/six_folded_sheets")
    pieces = releases_of(analysis).sets[0].words()
    named = [piece.words for piece in pieces if isinstance(piece, Named)]
    assert len(named) == 6
    assert "RLSE 8 4" in plain(pieces)
    model = folded_sheet(clamped=True)
    made = analyse(model)
    assert "model.release(" in plain(releases_of(made).sets[0].words())


@pytest.mark.parametrize("seed", range(12))
def test_numbers_of_shear_that_are_not_given_are_zero(seed: int) -> None:
    """ESTIFF of four numbers ranks the releases as ESTIFF of six of which the last two are zero."""
    dice = random.Random(seed)
    name = dice.choice([name for name in NAMES if "BEAM" in text_of(name)])
    kinematics = text_of(name).partition("\nEND")[0]
    beams = [words[1] for words in map(str.split, kinematics.splitlines()) if words[:1] == ["BEAM"]]
    chosen = dice.sample(beams, dice.randint(min(1, len(beams)), len(beams)))
    releases = [
        line
        for line in kinematics.splitlines()
        if not (line.startswith("RLSE") and line.split()[1] in chosen and dice.random() < 0.5)
    ]
    short, long = (
        "\n".join(
            [*releases, "END", "HALT"]
            + [f"ESTIFF {beam} 4E5 0.5 0.02 8.0{more}" for beam in chosen]
            + ["END", "END", ""]
        )
        for more in ("", " 0.0 0.0")
    )
    ranked = [analyse(flexact.read_text(text)).advice().to_dict() for text in (short, long)]
    assert ranked[0]["releases"] == ranked[1]["releases"]
