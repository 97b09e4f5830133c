# SPDX-License-Identifier: BSD-3-Clause
"""How often each motion of each body is held: by hand, and by the wrenches of its flexures."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from json_schema import assert_valid

import flexact
from flexact.analysis.holding import MOTIONS, BodyHolding, times_in_words
from flexact.analysis.naming import Named, plain, together_in_words

ROOT = Path(__file__).parents[2]
Limb = tuple[np.ndarray, np.ndarray, np.ndarray | None]


def built(limbs: list[Limb], declared: str = "", name: str = "stage") -> flexact.Analysis:
    """A body on sheets (with a width) and wires (without), each clamped at its first end."""
    model = flexact.Model(name="limbs")
    for k, (foot, head, width) in enumerate(limbs, start=1):
        p, q = foot.tolist(), head.tolist()
        if width is None:
            model.wire(p, q, name=f"limb {k}")
        else:
            model.sheet(p, q, width=width.tolist(), name=f"limb {k}")
        model.fix(p)
    model.body([head.tolist() for _, head, _ in limbs], name=name)
    if declared:
        model.independent(name, declared)
    return flexact.analyse(model)


def wrenches(limb: Limb, at: np.ndarray) -> np.ndarray:
    """(held, 6) forces and moments about a point that a flexure can exert on the body.

    A wire pushes along its line; a sheet along its line and its width, and turns in its plane.
    """
    foot, head, width = limb
    along = (head - foot) / np.linalg.norm(head - foot)
    arm = head - at
    force = [np.concatenate((along, np.cross(arm, along)))]
    if width is not None:
        unit = width / np.linalg.norm(width)
        force.append(np.concatenate((unit, np.cross(arm, unit))))
        force.append(np.concatenate((np.zeros(3), np.cross(along, unit))))
    return np.array(force)


def counted(limbs: list[Limb], body: BodyHolding) -> tuple[dict[str, int], int]:
    """Of each motion 1 + n of the definition, and the number of self-stresses."""
    turn = np.kron(np.eye(2), body.axes.T)
    each = [wrenches(limb, body.at) @ turn.T for limb in limbs]
    # Rotations are compared with displacements by the size of the body.
    size = max(float(np.linalg.norm(head - body.at)) for _, head, _ in limbs)
    each = [rows / np.repeat((1.0, size), 3) for rows in each]
    _, values, right = np.linalg.svd(np.concatenate(each).T)
    null = right[np.count_nonzero(values > 1e-9) :].T
    ends = np.cumsum([len(rows) for rows in each])[:-1]
    loads = np.array(
        [rows.T @ part for rows, part in zip(each, np.split(null, ends), strict=True)]
    ).reshape(len(limbs), 6, null.shape[1])
    ranks = [
        int(np.linalg.matrix_rank(loads[:, k], tol=1e-7)) if null.shape[1] else 0 for k in range(6)
    ]
    return {way: 1 + rank for way, rank in zip(MOTIONS, ranks, strict=True)}, null.shape[1]


def limb(foot: tuple[float, ...], head: tuple[float, ...], width: str) -> Limb:
    return np.array(foot, float), np.array(head, float), np.eye(3)["xyz".index(width)]


def guide() -> list[Limb]:
    return [limb((0, y, 0), (0.1, y, 0), "z") for y in (0.0, 0.05)]


def spider(arms: int = 6) -> list[Limb]:
    made: list[Limb] = []
    for angle in np.arange(arms) * 2.0 * np.pi / arms:
        way = np.array((np.cos(angle), np.sin(angle), 0.0))
        made.append((0.05 * way, 0.01 * way, np.cross((0.0, 0.0, 1.0), way)))
    return made


def table(sheets: int = 5) -> list[Limb]:
    """Sheets side by side, which all hold the same."""
    return [limb((0, 0.01 * k, 0), (0.1, 0.01 * k, 0), "z") for k in range(sheets)]


def cross_hinge() -> list[Limb]:
    return [
        limb((-0.03, -0.01, 0), (0.03, -0.01, 0.08), "y"),
        limb((0.03, 0.01, 0), (-0.03, 0.01, 0.08), "y"),
    ]


def wires(count: int) -> list[Limb]:
    random = np.random.default_rng(7)
    feet, heads = random.uniform(-0.1, 0.1, (2, count, 3))
    return [(foot - (0, 0, 0.2), head, None) for foot, head in zip(feet, heads, strict=True)]


def moved(limbs: list[Limb], seed: int = 3) -> list[Limb]:
    """The same, turned by some rotation and shifted."""
    random = np.random.default_rng(seed)
    turn = np.linalg.qr(random.normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    shift = random.uniform(-0.3, 0.3, 3)
    return [
        (turn @ foot + shift, turn @ head + shift, None if width is None else turn @ width)
        for foot, head, width in limbs
    ]


CASES: list[tuple[str, list[Limb], str, str]] = [
    ("guide", guide(), "y", "ry held twice; x, z, rx, rz once; y declared"),
    (
        "spider",
        spider(),
        "z",
        "x, y, rz held six times each; z declared; rx, ry free",
    ),
    ("six wires", wires(6), "", "x, y, z, rx, ry, rz held once each"),
    (
        "seven wires",
        wires(7),
        "",
        "x, y, z, rx, ry, rz together held seven times (once too often)",
    ),
    (
        "nine wires",
        wires(9),
        "",
        "x, y, z, rx, ry, rz together held nine times (three times too often)",
    ),
    (
        "table",
        table(),
        "y",
        "ry held five times; x, rz together held five times (three times too often); "
        "z, rx together held five times (three times too often); y declared",
    ),
    (
        "cross hinge",
        cross_hinge(),
        "ry",
        "y held twice; x, z, rx, rz once; ry about the line through (0, *, 0.04) m declared",
    ),
]


@pytest.mark.parametrize(
    ("limbs", "declared", "words"), [c[1:] for c in CASES], ids=[c[0] for c in CASES]
)
def test_counts_are_those_of_the_hand(limbs: list[Limb], declared: str, words: str) -> None:
    analysis = built(limbs, declared)
    (body,) = analysis.bodies
    assert str(body) == f"stage: {words}."
    surplus = sum(count - 1 for way, count in body.held.items() if not in_group(body, way))
    surplus += sum(group.held - len(group.directions) for group in body.together)
    assert surplus == analysis.over_constrained


def in_group(body: BodyHolding, way: str) -> bool:
    return any(way in group.directions for group in body.together)


@pytest.mark.parametrize("change", [lambda limbs: limbs, moved], ids=["as it is", "turned"])
@pytest.mark.parametrize(("limbs", "declared"), [c[1:3] for c in CASES], ids=[c[0] for c in CASES])
def test_counts_are_those_of_the_wrenches(
    limbs: list[Limb], declared: str, change: Callable[[list[Limb]], list[Limb]]
) -> None:
    """1 + rank of the loads along each motion, by screws alone: without elements and D(c)."""
    limbs = change(limbs)
    # A coordinate that is declared is one of the model's axes: of turned ones nothing is.
    analysis = built(limbs, declared if change is not moved else "")
    (body,) = analysis.bodies
    expected, count = counted(limbs, body)
    assert count == analysis.over_constrained
    assert body.held == {way: expected[way] for way in MOTIONS if way in body.held}
    assert set(body.held) | set(body.free) | set(body.declared) == set(MOTIONS)


@pytest.mark.parametrize(("limbs"), [c[1] for c in CASES], ids=[c[0] for c in CASES])
def test_a_turned_and_shifted_mechanism_is_held_as_often(limbs: list[Limb]) -> None:
    for seed in range(3):
        (one,), (other,) = built(limbs).bodies, built(moved(limbs, seed)).bodies
        assert sorted(one.held.values()) == sorted(other.held.values())
        assert len(one.free) == len(other.free)
        assert sorted((len(g.directions), g.held) for g in one.together) == sorted(
            (len(g.directions), g.held) for g in other.together
        )


def test_turned_axes_are_told() -> None:
    """The guide turned by 30 degrees about z: its own x and y."""
    angle = np.radians(30.0)
    turn = np.array(
        [[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]]
    )
    limbs: list[Limb] = [(turn @ p, turn @ q, w) for p, q, w in guide()]
    (body,) = built(limbs).bodies
    assert str(body) == (
        "stage: ry held twice; x, z, rx, rz once; y free (y along (-0.5, 0.866, 0))."
    )
    np.testing.assert_allclose(body.axes, turn, atol=1e-9)


def test_two_stages_are_counted_apart() -> None:
    """Each pair of sheets is a self-stress; the outer stage feels both."""
    names: dict[str, object] = {}
    exec((ROOT / "docs" / "gallery" / "double_parallelogram.py").read_text(), names)
    inner, outer = flexact.analyse(names["model"]).bodies  # type: ignore[arg-type]
    assert str(inner) == "inner stage: rx held twice; y, z, ry, rz once; x declared."
    assert sorted(inner.held.values()) == [1, 1, 1, 1, 2]
    assert sorted(outer.held.values()) == [1, 1, 1, 1, 3]
    assert inner.declared == outer.declared == ("x",)


def test_a_motion_that_two_bodies_share_is_held_against_the_other() -> None:
    """Two stages that slide along y, joined by two wires on one line along y."""
    model = flexact.Model(name="two stages")
    for name, start in (("left", -0.1), ("right", 0.1)):
        for side in (-0.05, 0.05):
            foot, head = (0, start + side, 0), (0.1, start + side, 0)
            model.sheet(foot, head, width="z", name=f"{name} {side}")
            model.fix(foot)
    ends = [(0.1, y, 0) for y in (-0.04, -0.02, 0.02, 0.04)]
    model.body([(0.1, -0.15, 0), (0.1, -0.05, 0), ends[0], ends[1]], name="left")
    model.body([(0.1, 0.05, 0), (0.1, 0.15, 0), ends[2], ends[3]], name="right")
    model.wire(ends[0], ends[3], name="long wire")
    model.wire(ends[1], ends[2], name="short wire")
    analysis = flexact.analyse(model)
    assert (analysis.under_constrained, analysis.over_constrained) == (1, 3)
    left, right = analysis.bodies
    assert left.words == "ry held twice; x, z, rx, rz once; y held twice against right; y free"
    assert right.held["y"] == 2 and right.against == {"y": ("left",)}


def test_a_body_driven_twice_is_held_against_its_drive() -> None:
    limbs = guide()
    model = flexact.Model()
    for k, (foot, head, _) in enumerate(limbs):
        model.sheet(foot.tolist(), head.tolist(), width="z", name=f"sheet {k}")
        model.fix(foot.tolist())
    model.body([head.tolist() for _, head, _ in limbs], name="stage")
    for _, head, _ in limbs:
        model.independent(head.tolist(), "y")
    (body,) = flexact.analyse(model).bodies
    assert body.held["y"] == 2 and body.against == {"y": ("its drive",)}
    assert body.declared == ("y",) and body.held["ry"] == 2


def test_what_no_body_feels_is_said_of_the_part() -> None:
    model = flexact.Model()
    model.sheet((0, 0, 0), (0.1, 0, 0), width="z", name="blade")
    model.fix((0, 0, 0), (0.1, 0, 0))
    holding = flexact.analyse(model).holding
    assert not holding.bodies
    assert list(map(str, holding.inside)) == [
        "the blade: held three times too often between its ends."
    ]


def test_a_body_that_divides_a_flexure_is_none() -> None:
    """Sheets that are stiff in the middle guide a stage as plain ones do, with folds besides."""
    model = flexact.Model()
    for k, y in enumerate((0.0, 0.05), start=1):
        model.sheet((0, y, 0), (0.02, y, 0), width="z", name=f"root {k}")
        model.sheet((0.08, y, 0), (0.1, y, 0), width="z", name=f"tip {k}")
        model.body([(0.02, y, 0), (0.08, y, 0)], name=f"middle {k}")
        model.fix((0, y, 0))
    model.body([(0.1, 0, 0), (0.1, 0.05, 0)], name="stage")
    assert [body.name for body in flexact.analyse(model).bodies] == ["stage"]


def test_a_large_model_is_not_counted() -> None:
    model = flexact.Model(planar=True)
    for k in range(450):
        angle = 2.0 * np.pi * k / 450
        foot = (np.cos(angle), np.sin(angle))
        model.truss(foot, (0, 0))
        model.fix(foot)
    analysis = flexact.analyse(model)
    assert analysis.over_constrained == 448
    assert not analysis.bodies and "not counted" in analysis.describe()
    assert analysis.to_dict()["bodies"] is None


def test_json_has_bodies() -> None:
    analysis = built(spider(), "z", "hub")
    record = analysis.to_dict()
    assert_valid(record)
    (hub,) = record["bodies"]
    assert hub == {
        "name": "hub",
        "held": {"x": 6, "y": 6, "rz": 6},
        "declared": ["z"],
        "free": ["rx", "ry"],
    }
    (stage,) = built(wires(7)).to_dict()["bodies"]
    assert stage["together"] == [{"directions": list(MOTIONS), "held": 7}]
    (hinge,) = built(cross_hinge(), "ry").to_dict()["bodies"]
    np.testing.assert_allclose(hinge["at"]["value"], (0.0, 0.0, 0.04), atol=1e-12)
    assert record["held_inside"] == []


def test_equal_bodies_are_said_once() -> None:
    def named(names: list[str]) -> str:
        return plain(together_in_words([Named("element", 1, each) for each in names]))

    assert named([f"guide {k}" for k in range(1, 11)]) == "guides 1 to 10"
    assert named(["guide 1", "guide 3", "guide 4"]) == "guides 1, 3 and 4"
    # Not every word before a number has a plural.
    assert named(["lower 30", "lower 150", "upper 90"]) == "lower 30, lower 150 and upper 90"
    assert [times_in_words(k) for k in (1, 2, 3, 12, 13)] == [
        *("once", "twice", "three times", "twelve times", "13 times"),
    ]


MECHANISMS = [
    *sorted(path for path in ROOT.glob("input_decks/*/*.dat") if path.parent.name != "broken"),
    *sorted(ROOT.glob("docs/gallery/*.py")),
]


@pytest.mark.parametrize("path", MECHANISMS, ids=lambda path: path.name)
def test_a_mechanism_is_told_on_one_screen(path: Path) -> None:
    if path.suffix == ".py":
        names: dict[str, object] = {}
        exec(path.read_text(encoding="utf-8"), names)
        analysis = flexact.analyse(names["model"])  # type: ignore[arg-type]
    else:
        analysis = flexact.analyse(flexact.read(path))
    rows = analysis.describe().splitlines()
    assert len(rows) <= 30 and max(map(len, rows)) <= 100
    assert len(analysis.describe(verbose=True).splitlines()) >= len(rows) - 2


def test_sixty_flexures_are_told_on_one_screen() -> None:
    for limbs in (table(60), spider(60), wires(60)):
        rows = built(limbs).describe().splitlines()
        assert len(rows) <= 30 and max(map(len, rows)) <= 100
