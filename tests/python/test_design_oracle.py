# SPDX-License-Identifier: BSD-3-Clause
"""The judge of design answers: good answers pass, and each kind of mistake is named."""

import copy
import itertools
import json
import math
from collections.abc import Callable
from pathlib import Path

import design_answers_by_hand as by_hand
import numpy as np
import pytest
from design_answers_by_hand import Json, answer, design_oracle, design_search, layout, wire

import flexact

Case = tuple[Json, Json]
HINGE, GUIDE, LAYERS = by_hand.hinge(), by_hand.guide(), by_hand.two_layers()


@pytest.mark.parametrize("case", [HINGE, GUIDE, LAYERS], ids=["hinge", "guide", "layers"])
def test_good_answers_pass(case: Case) -> None:
    assert design_oracle.examine(*case) == ([], [])


def rebuilt(case: Case, change: Callable[[Json], None], flexure: str, problem: Json = {}) -> Case:  # noqa: B006
    """The layout of a flexure, made anew with that flexure changed, as the only one."""
    about = case[0] | problem
    for made in case[1]["layouts"]:
        flexures = copy.deepcopy(made["flexures"])
        chosen = [item for item in flexures if item["name"] == flexure]
        if chosen:
            change(chosen[0])
            return about, answer(about, [layout(about, flexures, made["what"])])
    raise KeyError(flexure)


def edited(case: Case, change: Callable[[Json], None]) -> Case:
    """An answer with something in it changed, deck and all else as it was."""
    problem, other = case[0], copy.deepcopy(case[1])
    change(other)
    return problem, other


def asked(case: Case, **other: object) -> Case:
    """An answer to another problem: what is in limits goes there."""
    problem = copy.deepcopy(case[0])
    for key, value in other.items():
        if key in (
            "symmetry",
            "kinds",
            "bodies",
            "clearance",
            "length",
            "width",
            "over_constraint",
        ):
            problem["limits"][key] = value
        else:
            problem[key] = value
    return problem, case[1]


def put(*path: str | int, value: object) -> Callable[[Json], None]:
    def change(target: Json) -> None:
        *way, last = path
        for step in way:
            target = target[step]  # type: ignore[index]
        target[last] = value  # type: ignore[index]

    return change


def deck(*replacements: tuple[str, str], index: int = 0) -> Callable[[Json], None]:
    def change(target: Json) -> None:
        text = target["layouts"][index]["deck"]
        for old, new in replacements:
            assert old in text
            text = text.replace(old, new)
        target["layouts"][index]["deck"] = text

    return change


def mirrored(target: Json) -> None:
    """The second layout becomes the first one, with y turned round."""
    first = target["layouts"][0]
    flexures = copy.deepcopy(first["flexures"])
    for flexure in flexures:
        for end in flexure["ends"]:
            end[1] = -end[1]
    target["layouts"][1] = layout(HINGE[0], flexures, first["what"], 2)


def twice(target: Json) -> None:
    target["layouts"][0]["flexures"][1]["name"] = target["layouts"][0]["flexures"][0]["name"]


def none_of(condition: str) -> Callable[[Json], None]:
    def change(target: Json) -> None:
        target["layouts"] = []
        target["none"] = {"condition": condition, "by": 0.01, "statement": "Nothing fits."}

    return change


FIRST = ("layouts", 0)
MISTAKES: dict[str, tuple[Callable[[], Case], str]] = {
    # Mobility.
    "verdict": (
        lambda: edited(HINGE, deck(("RLSE 10 2 3 4 5 6", "RLSE 10"))),
        "under-constrained by 1",
    ),
    "over-constraint": (
        lambda: edited(HINGE, put(*FIRST, "over_constrained", value=1)),
        "has 0 self-stresses",
    ),
    "inner motions": (
        lambda: edited(GUIDE, put(*FIRST, "internal", value=4)),
        "has 5 inner motions",
    ),
    "freedom": (
        lambda: rebuilt(HINGE, put("ends", 1, 1, value=1e-9), "wire 1"),
        "off the wanted one",
    ),
    "too many motions": (
        lambda: edited(
            HINGE,
            lambda target: target["layouts"].__setitem__(0, _without_last(target["layouts"][0])),
        ),
        "leaves 2 motions of the stage, 1 are wanted",
    ),
    # Regions and limits.
    "end outside": (
        lambda: rebuilt(HINGE, put("ends", 0, 2, value=0.0100001), "wire 1"),
        "end at (0.015, 0, 0.0100001) is not within the regions of stage",
    ),
    "edge outside": (
        lambda: rebuilt(
            HINGE, put("ends", value=[[0.015, 0.02, 0.0], [0.015, 0.07, 0.0]]), "sheet 1"
        ),
        "edge at (0.015, 0.02, 0) is not within the regions of stage",
    ),
    "ground": (
        lambda: rebuilt(HINGE, put("ends", 1, 2, value=0.059), "wire 1"),
        "is not within the regions of ground",
    ),
    "body between": (
        lambda: asked(
            LAYERS, intermediate={"boxes": [[[-0.05, -0.05, -0.055], [0.05, 0.05, -0.046]]]}
        ),
        "is not within the regions of body 1",
    ),
    "length": (lambda: asked(HINGE, length=[0.03, 0.05]), "m long, not within [0.03, 0.05]"),
    "length of leaves": (lambda: asked(GUIDE, length=[0.03, 0.07]), "is 0.025, 0.055 m long"),
    "width": (lambda: rebuilt(HINGE, put("width", value=0.031), "sheet 1"), "width of 0.031 m"),
    "thickness": (
        lambda: rebuilt(HINGE, put("thickness", value=0.4e-3), "sheet 1"),
        "thickness of 0.0004 m",
    ),
    "diameter": (
        lambda: rebuilt(HINGE, put("diameter", value=2e-3), "wire 1"),
        "diameter of 0.002 m",
    ),
    "kinds": (lambda: asked(HINGE, kinds=["wire"]), "is a sheet, which is not among wire"),
    "unknown kind": (
        lambda: edited(HINGE, put(*FIRST, "flexures", 0, "kind", value="spring")),
        "unknown kind spring",
    ),
    "bodies": (lambda: asked(LAYERS, bodies=0), "has 1 bodies between, not 0 at most"),
    "over-constraint asked": (
        lambda: _two_sheets(over_constraint=0),
        "is over-constrained by 1, more than asked",
    ),
    # Room.
    "keep-out": (
        lambda: asked(HINGE, keep_out={"boxes": [[[0.01, -0.005, 0.03], [0.02, 0.005, 0.04]]]}),
        "from the keep-out",
    ),
    "beside a keep-out": (
        lambda: asked(HINGE, keep_out={"boxes": [[[0.01, -0.005, 0.03], [0.0126, 0.005, 0.04]]]}),
        "wire 1 is 0.0019 m from the keep-out at (0.01, -0.005, 0.03), not 0.002",
    ),
    "clearance": (
        lambda: asked(HINGE, clearance=0.03),
        "m apart, not 0.03",
    ),
    "edge beside a wire": (
        lambda: rebuilt(HINGE, _beside_the_wire, "sheet 1"),
        "sheet 1 and wire 1 are 0.0015 m apart, not 0.002",
    ),
    "fold beside a fold": (
        lambda: rebuilt(GUIDE, _beside_the_first, "folded 2"),
        "folded 1 and folded 2 are 0.001 m apart",
    ),
    # Flexures and deck.
    "ends of the deck": (
        lambda: edited(HINGE, put(*FIRST, "flexures", 0, "ends", 0, value=[0.0, 0.0, 0.01])),
        "the deck has no end of it at (0, 0, 0.01)",
    ),
    "between": (
        lambda: edited(HINGE, put(*FIRST, "flexures", 0, "between", value=["ground", "stage"])),
        "is on stage in the deck, not on ground",
    ),
    "between bodies": (
        lambda: edited(LAYERS, put(*FIRST, "flexures", 0, "between", value=["stage", "ground"])),
        "is on body 1 in the deck, not on ground",
    ),
    "names": (lambda: edited(HINGE, twice), "two flexures are called"),
    "left out": (
        lambda: edited(HINGE, lambda target: target["layouts"][0]["flexures"].pop()),
        "is of no flexure of the list",
    ),
    "no such element": (
        lambda: edited(HINGE, deck(("% wire 5", "% wire 6"))),
        "wire 5: is not in the deck",
    ),
    "fold": (
        lambda: edited(GUIDE, put(*FIRST, "flexures", 0, "fold", "point", 1, value=-0.019)),
        "the deck has no fold of it at (0.065, -0.019, 0.01)",
    ),
    "section": (
        lambda: edited(HINGE, put(*FIRST, "flexures", 0, "diameter", value=1.0001e-3)),
        "its section gives",
    ),
    "normal": (
        lambda: edited(HINGE, put("layouts", 1, "flexures", 0, "normal", value=[1.0, 0.0, 0.0])),
        "lies in another plane",
    ),
    "held": (
        lambda: edited(HINGE, deck(("RLSE 4 2 5 6", "RLSE 4 2 3 5 6"), index=1)),
        "which is no sheet",
    ),
    "no deck": (
        lambda: edited(HINGE, put(*FIRST, "deck", value="nonsense")),
        "the deck cannot be read",
    ),
    "missing key": (lambda: edited(HINGE, lambda t: t["layouts"][0].pop("alike")), "has no alike"),
    "mass": (lambda: edited(HINGE, deck(("XM 1 0.2", "XM 1 0.3"))), "has 0.3 kg in the deck"),
    "inertia": (
        lambda: edited(HINGE, deck(("XM 2 4e-05", "XM 2 5e-05"))),
        "another inertia about the centre",
    ),
    "stage": (lambda: edited(HINGE, put(*FIRST, "stage", value="table")), "calls the stage table"),
    # Images and symmetry.
    "images": (lambda: edited(HINGE, mirrored), "layouts 1 and 2 are images of each other"),
    "symmetry": (lambda: asked(HINGE, symmetry="mirror y"), "not its own image"),
    "alike": (lambda: edited(HINGE, put(*FIRST, "alike", value=9)), "stands for 9 images"),
    # Scores and order.
    **{
        f"score {key}": (
            lambda key=key: edited(  # type: ignore[misc]
                HINGE,
                put(*FIRST, "scores", key, value=1.02 * HINGE[1]["layouts"][0]["scores"][key]),
            ),
            f"its {key} is ",
        )
        for key in (
            "worst_stiffness",
            "drive_stiffness",
            "first_frequency",
            "first_parasitic_frequency",
            "thermal_drift",
        )
    },
    "turns with errors": (
        lambda: edited(HINGE, put(*FIRST, "scores", "turns_with_errors", value=2.3)),
        "turns_with_errors is 2.357",
    ),
    "no score": (
        lambda: edited(HINGE, put(*FIRST, "scores", "drive_stiffness", value=None)),
        "has no score drive_stiffness",
    ),
    "nan": (lambda: edited(HINGE, put(*FIRST, "scores", "room", value=math.nan)), "room is nan"),
    "order": (
        lambda: edited(HINGE, put("rank_by", value="lower:worst_stiffness")),
        "layout 2 is before 1 by lower:worst_stiffness",
    ),
    "rank": (lambda: edited(HINGE, put("rank_by", value="beauty")), "by which they are ranked"),
    "number": (lambda: edited(HINGE, put(*FIRST, "number", value=2)), "layout 1 has the number 2"),
    "pareto": (lambda: edited(HINGE, _beaten), "beats it"),
    "words": (lambda: edited(HINGE, put(*FIRST, "what", value="four wires")), "has 5 of kind wire"),
    # The class, and no layout.
    "dimension": (
        lambda: edited(HINGE, put("wanted", "dimension", value=2)),
        "dimension is 2, not 1",
    ),
    "parallel": (lambda: edited(LAYERS, put("parallel", value=True)), "parallel_wires is True"),
    "least wires": (
        lambda: edited(HINGE, put("kinds", "wires", value=4)),
        "least_wires is 4, not 5",
    ),
    "sheet": (lambda: edited(HINGE, put("kinds", "sheet", value=None)), "with_sheet is None"),
    "layers": (lambda: edited(LAYERS, put("kinds", "layers", value=1)), "least_layers is 1, not 2"),
    "extra": (lambda: edited(LAYERS, put("kinds", "extra", value=0)), "alone is 0, not 1"),
    "needed": (lambda: edited(HINGE, put("needed", value=4)), "needed is 4, not 5"),
    "expectation": (
        lambda: asked(HINGE, expect=HINGE[0]["expect"] | {"least_layers": 2}),
        "the problem expects least_layers 2, computed is 1",
    ),
    "none though some exist": (lambda: edited(HINGE, none_of("regions")), "there are 0 layouts"),
    "wrong reason": (
        lambda: (by_hand.problems()["guide_without_room"], edited(HINGE, none_of("length"))[1]),
        "no layout by length, not by regions",
    ),
    "nothing nearby": (lambda: edited(HINGE, none_of("regions")), "possible nearby"),
    "no reason": (lambda: edited(HINGE, put("layouts", value=[])), "no condition that leaves none"),
}


def _without_last(made: Json) -> Json:
    return layout(HINGE[0], made["flexures"][:-1], "four wires")


def _beside_the_wire(flexure: Json) -> None:
    """Its edge is 1.5 mm from a wire, its middle line 12 mm."""
    flexure |= {"normal": [0.0, 1.0, 0.0], "ends": [[0.003, 0.0, 0.01], [0.003, 0.0, 0.065]]}


def _beside_the_first(flexure: Json) -> None:
    """Its leaf lies in the plane of that of the first folded sheet, 1 mm from it."""
    y = -0.02 + 0.01 + 1e-3
    flexure["ends"] = [[0.04, y, 0.01], [0.065, y, -0.045]]
    flexure["fold"]["point"] = [0.065, y, 0.01]


def _two_sheets(**limits: object) -> Case:
    """The cross hinge, over-constrained by one."""
    problem = asked(HINGE, **limits)[0]
    sheet = copy.deepcopy(HINGE[1]["layouts"][1]["flexures"][0])
    other = sheet | {"name": "sheet 2", "normal": [0.0, 1.0, 0.0]}
    sheet["ends"] = [[0.008, 0.02, 0.0], [0.008, 0.07, 0.0]]
    other["ends"] = [[-0.008, 0.0, 0.01], [-0.008, 0.0, 0.07]]
    return problem, answer(problem, [layout(problem, [sheet, other], "two sheets")])


def _beaten(target: Json) -> None:
    """A layout of no more worth than the first, with a flexure more, in the Pareto set."""
    target["layouts"][1]["pareto"] = True
    target["layouts"][1]["scores"] = copy.deepcopy(target["layouts"][0]["scores"])
    target["layouts"][1]["scores"]["drive_stiffness"] *= 1.5
    target["layouts"][0]["flexures"] = target["layouts"][0]["flexures"][:3]


@pytest.mark.parametrize("name", MISTAKES)
def test_each_mistake_is_named(name: str) -> None:
    make, text = MISTAKES[name]
    assert [said for said in design_oracle.judge(*make()) if text in said]


def test_a_consistent_change_is_no_mistake() -> None:
    """What is rebuilt with nothing changed passes, so that mistakes are those that are made."""
    assert design_oracle.judge(*rebuilt(HINGE, lambda flexure: None, "wire 5")) == []
    assert design_oracle.judge(*_two_sheets(over_constraint=1)) == []


def test_length_of_both_leaves_is_a_remark() -> None:
    wrong, remarks = design_oracle.examine(*asked(GUIDE, length=[0.07, 0.09]))
    assert wrong == []
    assert len(remarks) == 5


def test_a_point_of_a_region_takes_an_end() -> None:
    points = [flexure["ends"][0] for flexure in HINGE[1]["layouts"][0]["flexures"]]
    case = asked(
        (HINGE[0], edited(HINGE, lambda t: t["layouts"].pop())[1]), stage={"points": points}
    )
    assert design_oracle.judge(*case) == []


def test_scores_of_a_parallel_guide_are_those_of_closed_forms() -> None:
    """24 E I / (L^3 (1 + P)), 2 E A / L, 13/35 of each sheet, alpha L; stiffness.md section 3."""
    problem = by_hand.problems()["guide"] | {"inertia": 1e-7}
    length, width, t, young, shear = 0.05, 0.02, 0.3e-3, 210e9, 80.77e9
    flexures = [
        {
            "name": f"sheet {k}",
            "kind": "sheet",
            "ends": [[0.0, y, 0.0], [length, y, 0.0]],
            "between": ["stage", "ground"],
            "width": width,
            "thickness": t,
            "normal": [0.0, 1.0, 0.0],
        }
        for k, y in ((1, 0.02), (2, -0.02))
    ]
    problem["wanted"] = [{"kind": "translation", "direction": [0, 1, 0]}]
    made = layout(problem, flexures, "two sheets")
    assert made["over_constrained"] == 1
    area, second = width * t, width * t**3 / 12
    nu = young / (2 * shear) - 1
    p = 12 * young * second * (12 + 11 * nu) / (10 * (1 + nu) * shear * area * length**2)
    drive = 24 * young * second / (length**3 * (1 + p))
    scores = made["scores"]
    assert scores["drive_stiffness"] == pytest.approx(drive, rel=1e-9)
    # The stage turns a little as the sheets stretch: 6 E I / (L K) = 5.6e-5 less stiffness.
    mass = problem["mass"] + 2 * 13 / 35 * 7800 * area * length
    assert scores["first_frequency"] == pytest.approx(math.sqrt(drive / mass) / math.tau, rel=1e-4)
    assert scores["thermal_drift"] == pytest.approx(1e-5 * length, rel=1e-9)


def test_stiffness_of_one_wire() -> None:
    """A clamped wire, d = 5: along it E A / l, and nothing else is across T."""
    problem = by_hand.problems()["one_wire"]
    made = layout(problem, [wire("wire 1", [0.0, 0.0, 0.01], [0.0, 0.0, 0.07])], "one wire")
    expected = 210e9 * math.pi * 1e-6 / 4 / 0.06
    assert made["scores"]["worst_stiffness"] == pytest.approx(expected, rel=1e-9)
    assert design_oracle.judge(problem, answer(problem, [made])) == []


def test_scores_are_those_of_the_other_oracle() -> None:
    """Frequencies by `tests/reference/elastic`, which has a code of its own for beams."""
    import sys

    sys.path.insert(0, str(by_hand.REFERENCE / "elastic"))
    from states import Oracle  # type: ignore[import-not-found]

    for _, given in (HINGE, GUIDE, LAYERS):
        for made in given["layouts"]:
            state = Oracle(made["deck"], held="elastic", drive="free").undeformed()
            first = made["scores"]["first_frequency"]
            assert first == pytest.approx(state.frequencies[0], rel=1e-8)
            parasitic = made["scores"]["first_parasitic_frequency"]
            assert min(abs(state.frequencies / parasitic - 1)) < 1e-8


def test_flexact_finds_the_same_verdict(tmp_path: Path) -> None:
    for _, given in (HINGE, GUIDE, LAYERS):
        for made in given["layouts"]:
            (path := tmp_path / "layout.dat").write_text(made["deck"], encoding="utf-8")
            result = flexact.analyse(path)
            assert (result.under_constrained, result.over_constrained) == (0, 0)


def box(low: list[float], high: list[float]) -> object:
    return design_oracle.box_solid(np.array([low, high]))


def segment(p: list[float], q: list[float], radius: float = 0.0) -> object:
    return design_oracle.solids(
        {"kind": "wire", "ends": [p, q], "diameter": 2 * radius} | {"between": ["stage", "ground"]}
    )[0]


@pytest.mark.parametrize(
    ("one", "other", "gap"),
    [
        (segment([0, 0, 0], [1, 0, 0]), segment([0.5, -1, 2], [0.5, 1, 2]), 2.0),
        (segment([0, 0, 0], [1, 0, 0], 0.1), segment([3, 1, 0], [3, 2, 0], 0.2), 5**0.5 - 0.3),
        (segment([0, 0, 0], [1, 0, 0]), segment([0, 1, 0], [1, 1, 0]), 1.0),
        (segment([-1, 0, 0], [1, 0, 0]), segment([0, -1, 0], [0, 1, 0]), 0.0),
        (box([0, 0, 0], [1, 1, 1]), box([2, 2, 2], [3, 3, 3]), 3**0.5),
        (box([0, 0, 0], [1, 1, 1]), box([0.2, 0.2, 0.5], [3, 3, 3]), 0.0),
        (box([0, 0, 0], [1, 1, 1]), segment([2, -1, 0.5], [2, 3, 0.5], 0.25), 0.75),
        # A thin plate beside a wire: 0.15 mm of the plate, 0.5 mm of the wire.
        (
            box([0, 0, -1.5e-4], [0.05, 0.02, 1.5e-4]),
            segment([0.02, 0.01, 2e-3], [0.02, 0.01, 1], 5e-4),
            1.35e-3,
        ),
    ],
)
def test_distances_of_closed_forms(one: object, other: object, gap: float) -> None:
    assert design_oracle.distance(one, other) == pytest.approx(gap, abs=1e-12)
    assert design_oracle.distance(other, one) == pytest.approx(gap, abs=1e-12)


def test_an_edge_lies_in_a_union_of_boxes() -> None:
    boxes = [np.array(b, dtype=float) for b in ([[0, 0, 0], [1, 1, 1]], [[1, 0, 0], [2, 1, 1]])]
    ends = np.array([0.5, 0.5, 0.5]), np.array([1.5, 0.5, 0.5])
    assert design_oracle.covered(*ends, boxes, 1e-12)
    boxes[1][0, 0] = 1.1
    assert not design_oracle.covered(*ends, boxes, 1e-12)


def test_the_48_isometries_are_all() -> None:
    turns = design_oracle.signed_permutations()
    assert len(turns) == 48
    assert sum(np.linalg.det(turn) > 0 for turn in turns) == 24
    for one, other in itertools.combinations(turns, 2):
        assert np.max(np.abs(one - other)) > 0.5


def test_moved_layouts_correspond() -> None:
    """A mirror image of a layout, in another place and ten times as large, is told as the same."""
    problem, given = HINGE
    turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    way = turn, np.array([1.0, 2.0, 3.0]), 10.0
    there = design_oracle.moved(problem, *way)
    other = json.loads(json.dumps(given))
    for made in other["layouts"]:
        for flexure in made["flexures"]:
            ends = np.array(flexure["ends"]) * [1.0, 1.0, -1.0]
            flexure["ends"] = (10 * ends @ turn.T + way[1]).tolist()
            for key in ("width", "thickness", "diameter"):
                flexure[key] = 10 * flexure.get(key, 0.0)
    assert design_oracle.correspond(problem, given, other, way) == []
    assert design_oracle.classify(design_oracle.freedom(there))["dimension"] == 1
    other["layouts"][0]["flexures"][0]["diameter"] *= 1.01
    assert design_oracle.correspond(problem, given, other, way) == [
        "layout 1 is not among those of the moved problem",
        "1 layouts of the moved problem are others",
    ]


PROBLEMS = by_hand.problems() | by_hand.problems("more_design_problems.json")


def test_problems_have_names_of_their_own() -> None:
    first, more = by_hand.problems(), by_hand.problems("more_design_problems.json")
    assert len(first) == 20
    assert len(more) >= 30
    assert not first.keys() & more.keys()
    for problem in PROBLEMS.values():
        assert problem["source"]
        if not problem["expect"].get("layout_exists", True):
            assert problem["expect"]["why"] in design_oracle.CONDITIONS


@pytest.mark.parametrize("name", PROBLEMS)
def test_classes_of_the_problems_are_computed(name: str) -> None:
    own = design_oracle.classify(design_oracle.freedom(PROBLEMS[name]))
    expected = PROBLEMS[name]["expect"]
    for key in own.keys() & expected.keys() - {"signature_freedom"}:
        assert own[key] == expected[key], key


#: Problems in which wires are allowed and a layout exists, and those without, by their reason.
WITH_WIRES = [
    name
    for name, problem in PROBLEMS.items()
    if problem["expect"].get("layout_exists") and "wire" in problem["limits"]["kinds"]
]
WITHOUT = {
    name: problem["expect"]["why"]
    for name, problem in PROBLEMS.items()
    if problem["expect"].get("why") in ("length", "keep-out", "clearance", "symmetry")
}


def wires_found(problem: Json) -> list[str] | None:
    """What is wrong with a layout of wires that the slow search finds; None where it finds none."""
    if (flexures := design_search.witness(problem)) is None:
        return None
    return design_oracle.judge(problem, answer(problem, [layout(problem, flexures, "wires")]))


@pytest.mark.dear(6)
@pytest.mark.parametrize("name", WITH_WIRES)
def test_a_layout_exists_where_it_is_said(name: str) -> None:
    assert wires_found(PROBLEMS[name]) == []


@pytest.mark.dear(6)
@pytest.mark.parametrize("name", WITHOUT)
def test_the_reason_is_what_leaves_none(name: str) -> None:
    """Without the condition there is a layout."""
    problem = copy.deepcopy(PROBLEMS[name])
    problem["limits"]["kinds"] = ["wire"]
    relaxed: dict[str, Callable[[], object]] = {
        "length": lambda: problem["limits"].update(length=[1e-3, 1.0]),
        "keep-out": lambda: problem.pop("keep_out"),
        "clearance": lambda: problem["limits"].update(clearance=-1.0),
        "symmetry": lambda: problem["limits"].pop("symmetry"),
    }
    relaxed[WITHOUT[name]]()
    del problem["expect"]
    assert wires_found(problem) == []


def sheet(name: str, p: list[float], q: list[float], normal: list[float], width: float) -> Json:
    sizes = {"width": width, "thickness": 0.3e-3, "normal": normal}
    between = ["stage", "ground"]
    return {"name": name, "kind": "sheet", "ends": [p, q], "between": between} | sizes


def folded(name: str, p: list[float], fold: list[float], q: list[float]) -> Json:
    """A folded sheet with its fold along z."""
    line = {"point": fold, "direction": [0.0, 0.0, 1.0]}
    sizes = {"width": 0.01, "thickness": 0.3e-3, "fold": line}
    between = ["stage", "ground"]
    return {"name": name, "kind": "folded sheet", "ends": [p, q], "between": between} | sizes


#: Lines of z = 0, and lines of y = 0 through the waist at the ground.
WAISTED = [
    sheet("sheet 1", [0.008, 0.02, 0.0], [0.008, 0.07, 0.0], [0.0, 0.0, 1.0], 0.02),
    sheet("sheet 2", [-0.008, 0.0, 0.01], [-0.008, 0.0, 0.07], [0.0, 1.0, 0.0], 0.02)
    | {"kind": "waisted sheet", "waist": [-0.008, 0.0, 0.07]},
]


@pytest.mark.parametrize("waist", [[-0.008, 0.0, 0.01], None])
def test_a_waist_is_where_the_deck_has_it(waist: list[float] | None) -> None:
    problem = PROBLEMS["hinge_of_waisted_sheet"]
    made = layout(problem, WAISTED, "a sheet and a waisted sheet")
    made["flexures"] = [WAISTED[0], WAISTED[1] | {"waist": waist}]
    said = design_oracle.judge(problem, answer(problem, [made]))
    assert len(said) == 1
    assert "its waist is at (-0.008, 0, 0.07) in the deck" in said[0]


BY_HAND: dict[str, list[Json]] = {
    "hinge_of_two_sheets": [
        sheet("sheet 1", [0.008, 0.02, 0.0], [0.008, 0.07, 0.0], [0.0, 0.0, 1.0], 0.02),
        sheet("sheet 2", [-0.008, 0.0, 0.01], [-0.008, 0.0, 0.07], [0.0, 1.0, 0.0], 0.02),
    ],
    "guide_of_two_sheets": [
        sheet("sheet 1", [0.02, 0.0, 0.008], [0.065, 0.0, 0.008], [0.0, 0.0, 1.0], 0.02),
        sheet("sheet 2", [0.02, 0.0, -0.008], [0.065, 0.0, -0.008], [0.0, 0.0, 1.0], 0.02),
    ],
    "hinge_of_waisted_sheet": WAISTED,
    "sheet_alone": [sheet("sheet 1", [0.02, 0.0, 0.0], [0.065, 0.0, 0.0], [0.0, 0.0, 1.0], 0.02)],
    "sheet_and_three_wires": [
        sheet("sheet 1", [0.02, 0.0, 0.0], [0.065, 0.0, 0.0], [0.0, 0.0, 1.0], 0.02),
        wire("wire 1", [0.015, 0.0, -0.01], [0.015, 0.0, -0.065]),
        wire("wire 2", [-0.01, 0.015, -0.01], [-0.01, 0.015, -0.065]),
        wire("wire 3", [-0.01, -0.015, -0.01], [-0.01, -0.015, -0.065]),
    ],
    "planar_folded": [
        folded("folded 1", [0.02, 0.0, 0.0], [0.045, 0.0, 0.0], [0.045, 0.065, 0.0]),
        folded("folded 2", [0.0, 0.02, 0.0], [0.0, 0.045, 0.0], [-0.065, 0.045, 0.0]),
        folded("folded 3", [-0.02, 0.0, 0.0], [-0.045, 0.0, 0.0], [-0.045, -0.065, 0.0]),
    ],
    "one_folded_sheet": [
        folded("folded 1", [0.01, 0.0, 0.0], [0.035, 0.0, 0.0], [0.035, 0.065, 0.0]),
    ],
}


@pytest.mark.parametrize("name", BY_HAND)
def test_a_layout_made_by_hand_exists(name: str) -> None:
    problem = PROBLEMS[name]
    made = layout(problem, BY_HAND[name], "flexures")
    assert design_oracle.judge(problem, answer(problem, [made])) == []
