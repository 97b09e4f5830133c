# SPDX-License-Identifier: BSD-3-Clause
"""Advice as values and as the command gives it: steps, JSON, changed decks, mistakes."""

import copy
import json
import pickle
from collections import Counter
from dataclasses import FrozenInstanceError
from pathlib import Path

import numpy as np
import pytest
from json_schema import assert_valid_as, validator
from part_models import cross_hinge, guide
from reference_decks import NAMES, ROOT
from small_decks import BROKEN, COLLINEAR, DECKS, VERDICTS, json_lines, write

import flexact
from flexact import Advice, Model, ModelError, analyse
from flexact.advice.json import line_of
from flexact.advice.step import Purpose
from flexact.analysis.change import Change
from flexact.apps.cli.main import main
from flexact.model.editing import edited_deck

pytestmark = pytest.mark.dear(40)

INPUT = ROOT / "input_decks"
ADVISED = validator("advised")
#: The deck of README with nothing declared.
GUIDE = """\
BEAM 1  1 2 3 4  0 1 0     % sheet 1
BEAM 2  5 6 7 8  0 1 0     % sheet 2
BEAM 3  3 4 7 8            % stage
X 3  0.1 0.00 0
X 5  0.0 0.05 0
X 7  0.1 0.05 0
FIX 1
FIX 2
FIX 5
FIX 6
RLSE 1  2 5 6
RLSE 2  2 5 6
"""
FEW = ("paper/folded_sheet_free", "flexures/cross_hinge_undeclared", "linkages/four_bar_planar")


def advice(name: str) -> Advice:
    return analyse(INPUT / f"{name}.dat").advice()


# Values


def test_steps_are_a_sequence_in_the_order_of_their_numbers() -> None:
    steps = advice("flexures/cross_hinge_undeclared")
    assert len(steps) == len(list(steps)) > 3
    assert [step.number for step in steps] == list(range(1, len(steps) + 1))
    assert steps[0] in steps and steps[-1] is steps[len(steps) - 1]
    assert [step.number for step in steps[1:3]] == [2, 3]
    order = [
        *(
            Purpose.REPAIR,
            Purpose.MEND,
            Purpose.UNDECLARE,
            Purpose.RELEASE,
            Purpose.DECLARE,
            Purpose.HOLD,
        ),
        *(Purpose.ADD_WIRE, Purpose.ADD_SHEET),
    ]
    places = [order.index(step.purpose) for step in steps]
    assert places == sorted(places)
    with pytest.raises(IndexError):
        steps[len(steps)]


def test_alternatives_are_choices_that_do_the_same() -> None:
    """The two sheets of a parallel guide are alike."""
    step = next(step for step in advice("flexures/parallel_guide") if step.alternatives)
    for choice in range(1, 2 + len(step.alternatives)):
        after = analyse(step.apply(choice))
        assert after.verdict is step.after.verdict is flexact.Verdict.EXACT
    first, second = (step.apply(choice).data.arrays.deformation_class for choice in (1, 2))
    assert not np.array_equal(first, second)
    for wrong in (0, 2 + len(step.alternatives), -1):
        with pytest.raises(ModelError, match=f"no choice {wrong} of step {step.number}"):
            step.apply(wrong)
    for wrong in (True, 1.0, "1"):
        with pytest.raises(TypeError, match="whole number"):
            step.apply(wrong)  # type: ignore[arg-type]


def test_advice_is_frozen_and_outlives_a_change_of_the_model() -> None:
    model = guide()
    made = analyse(model).advice()
    with pytest.raises(FrozenInstanceError):
        made.body = "stage"  # type: ignore[misc]
    with pytest.raises(FrozenInstanceError):
        made[0].number = 7  # type: ignore[misc]
    changed = made[0].apply()
    assert changed is not made[0].apply()
    changed.delete("stage")
    assert analyse(made[0].apply()).verdict is made[0].after.verdict


@pytest.mark.parametrize("name", FEW)
def test_advice_is_pickled_and_copied(name: str) -> None:
    made = advice(name)
    wanted = made.to_dict()
    for again in (pickle.loads(pickle.dumps(made)), copy.deepcopy(made)):
        assert again.to_dict() == wanted
        assert again.describe() == made.describe()
    step = pickle.loads(pickle.dumps(made[0]))
    assert step.statement == made[0].statement


def test_what_moves_is_told_by_bodies() -> None:
    """Sheets that cross at half of 0.08 m turn their body about the crossing, along y."""
    (motion,) = advice("flexures/cross_hinge_undeclared").motions
    (body,) = motion.bodies
    assert (body.name, str(body.screw.kind)) == ("body", "rotation")
    assert abs(body.screw.direction) == pytest.approx([0, 1, 0])
    assert body.screw.point[[0, 2]] == pytest.approx([0.0, 0.04])
    assert not motion.internal and motion.extent.kind.value == "finite"


def test_a_platform_on_three_pairs_of_bars_turns_as_a_screw() -> None:
    """Turned by 90 degrees it goes up and down with its turn; its joints are told."""
    (motion,) = advice("frameworks/octahedral_platform_yaw_90").motions
    assert len(motion.bodies) == 3
    for body in motion.bodies:
        assert str(body.screw.kind) == "screw"
        assert abs(body.screw.direction) == pytest.approx([0, 0, 1])


def test_internal_motions_have_no_bodies() -> None:
    motions = advice("paper/folded_sheet_free").motions
    assert Counter((motion.internal, len(motion.bodies)) for motion in motions) == {
        (True, 0): 1,
        (False, 1): 5,
    }


def test_what_is_driven_against_a_constraint_is_taken_back() -> None:
    """A four-bar linkage has one freedom, so that two driven cranks fight; either may go."""
    text = (INPUT / "linkages" / "four_bar_planar.dat").read_text(encoding="utf-8")
    made = analyse(flexact.read_text(text.replace("END", "DYNX 13 1\nDYNX 33 1\nEND", 1))).advice()
    assert made.analysis.verdict is flexact.Verdict.OVER
    driven = [step for step in made if step.purpose is Purpose.UNDECLARE]
    assert [step.number for step in driven] == [1, 2]
    assert {step.change.coordinates[0][0] for step in driven} == {13, 33}
    assert all(analyse(step.apply()).verdict is flexact.Verdict.EXACT for step in driven)


def test_a_trap_of_declarations_is_left_in_one_step() -> None:
    """Bendings that were declared at clamps are taken back, and the folds declared instead."""
    made = advice("flexures/five_folded_sheets_trap")
    assert made[0].after.verdict is flexact.Verdict.EXACT
    assert len(made[0].change.deformations) == made.analysis.over_constrained == 5
    assert len(made[0].change.coordinates) == made.analysis.under_constrained == 5
    first = next(step for step in made if step.purpose is Purpose.UNDECLARE)
    assert first.change.deformations == made[0].change.deformations
    assert (first.after.under_constrained, first.after.over_constrained) == (5, 0)


def test_an_exact_mechanism_has_nothing_to_mend() -> None:
    made = advice("paper/five_wires")
    assert len(made) == len(made.motions) == len(made.self_stresses) == 0
    # The empty set is the one that leaves nothing.
    assert made.releases.count == made.declarations.count == 1
    assert made.releases.sets[0].change == made.declarations.sets[0].change == Change()
    assert "nothing to mend" in made.describe()


def test_body_and_wishes_that_are_not_there_are_told_at_once() -> None:
    analysis = analyse(cross_hinge())
    with pytest.raises(ModelError, match="no body called"):
        analysis.advice(body="stgae")
    with pytest.raises(ModelError, match="wanted"):
        analysis.advice(wanted=["arm: spin"])
    assert analysis.advice(wanted="arm: rotation y").wanted == ("arm: rotation y",)


def test_found_says_how_far_it_is() -> None:
    said: list[tuple[str, float]] = []
    made = analyse(guide()).advice()
    assert made.found(lambda what, done: said.append((what, done))) is made
    parts = [done for _, done in said]
    assert parts == sorted(parts) and parts[0] == 0.0 and parts[-1] < 1.0
    assert all(what for what, _ in said)


def test_a_notebook_shows_the_verdict_and_the_words() -> None:
    made = analyse(guide()).advice()
    shown = made._repr_html_()
    assert "over-constrained by 1" in shown and "<pre>" in shown
    assert repr(made).startswith("<Advice: under-constrained and over-constrained, ")


# JSON


@pytest.mark.grid
@pytest.mark.parametrize("name", NAMES)
def test_advice_keeps_what_it_promises(name: str) -> None:
    """JSON is what the schema says, and of each kind of step the first does what is said.

    The changed deck is written and read again.
    """
    made = advice(name)
    analysis, said = (
        made.analysis,
        json.loads(json.dumps(line_of(made.analysis, made.to_dict()), allow_nan=False)),
    )
    assert_valid_as(ADVISED, said)
    given = said["advice"]
    assert len(given["motions"]) == said["under_constrained"] == analysis.under_constrained
    assert len(given["self_stresses"]) == said["over_constrained"] == analysis.over_constrained
    for one, what in ((given["releases"], "deformations"), (given["declarations"], "coordinates")):
        assert one["sets"] or not one["count"]
        assert {len(each[what]) for each in one["sets"]} <= {one["size"]}
    for each in (*given["motions"], *given["self_stresses"], *given["steps"]):
        assert each["statement"].endswith(".") and "  " not in each["statement"]
    for one in given["motions"]:
        for body in one["bodies"]:
            assert np.linalg.norm(body["axis"]) == pytest.approx(1.0)
            assert (body["point"] is None) == (body["kind"] == "translation")
    for step in {
        (step.purpose, bool(step.change.coordinates)): step for step in made[::-1]
    }.values():
        deck = edited_deck(analysis.given, step.apply().data)
        after = analyse(flexact.read_text(deck), prove=False)
        assert after.verdict is step.after.verdict, step
        assert after.under_constrained == step.after.under_constrained
        assert after.over_constrained == step.after.over_constrained


def test_counts_of_the_paper() -> None:
    """Of Fig. 2: 12 bars may go, 4 coordinates be declared; of the guide of README 5 and 2."""
    made = advice("paper/twelve_trusses")
    # Nobody has asked yet.
    told = made.to_dict()
    assert told["releases"]["count"] is told["declarations"]["count"] is None
    assert "There are" not in made.describe()
    assert made.count()[:2] == (12, 4)
    assert "There are 12 sets of 1 release.\nThere are 4 sets of 1 declaration." in made.describe()
    told = made.to_dict()
    assert (told["releases"]["count"], told["declarations"]["count"]) == (12, 4)
    assert analyse(flexact.read_text(GUIDE)).advice().count()[:2] == (5, 2)


# The command


def run(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    code = main(["advise", *words])
    out, err = capsys.readouterr()
    return code, out, err


def test_several_decks_have_a_line_each(decks: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(decks / "wrong.dat", BROKEN)
    code, out, err = run(capsys, "--json", str(decks))
    assert code == 1
    said = {Path(one["deck"]).stem: one for one in json_lines(out)}
    assert set(said) == {*DECKS, "wrong"}
    assert {name: said[name]["verdict"] for name in DECKS} == VERDICTS
    assert said["wrong"]["error"]["errors"] == 1
    assert "wrong.dat:1:1" in err and "5 decks" in err


def test_words_stand_under_the_path(decks: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = str(decks / "over.dat")
    code, out, err = run(capsys, path)
    assert (code, out.splitlines()[0], err) == (0, path, "")
    assert "  1. " in out
    assert all(len(line) <= 100 for line in out.splitlines())


def test_a_changed_deck_keeps_its_comments(tmp_path: Path) -> None:
    """Blocks of dynamics and pictures, and what no analysis uses, stay to the letter."""
    text = (INPUT / "flexures" / "parallel_guide.dat").read_text(encoding="utf-8")
    text = text.replace("\nHALT\n", "\nHALT\nGRAVITY 0 0 -9.81 % down\n", 1)
    assert "GRAVITY" in text and "CROSSDIM" in text
    path, target = write(tmp_path / "guide.dat", text), tmp_path / "new" / "guide.dat"
    assert main(["advise", str(path), "--apply", "1", "-o", str(target)]) == 0
    old, new = text.splitlines(), target.read_text(encoding="utf-8").splitlines()
    assert len(old) == len(new)
    changed = [(a, b) for a, b in zip(old, new, strict=True) if a != b]
    assert len(changed) == 1 and all(line.startswith("RLSE ") for line in changed[0])


def test_choices_are_written_by_their_number(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = str(INPUT / "flexures" / "parallel_guide.dat")
    made = advice("flexures/parallel_guide")
    number = next(step.number for step in made if step.alternatives)
    for choice in ("", ".1", ".2"):
        target = tmp_path / f"new{choice}.dat"
        code, out, _ = run(capsys, path, "--apply", f"{number}{choice}", "-o", str(target))
        told = f"{number}.2" if choice == ".2" else f"{number}"
        assert code == 0 and f"step {told} written to" in out
        assert analyse(target).verdict is flexact.Verdict.EXACT
    one, same, other = ((tmp_path / f"new{c}.dat").read_bytes() for c in ("", ".1", ".2"))
    assert one == same != other


@pytest.mark.parametrize("words", [("advise", "--apply", "1"), ("trace",), ("declare",)])
@pytest.mark.parametrize("target", ["", ".", ".."])
def test_a_file_without_a_name_is_refused(
    words: tuple[str, ...], target: str, capsys: pytest.CaptureFixture[str]
) -> None:
    verb, *more = words
    deck = str(INPUT / "flexures" / "parallel_guide_undeclared.dat")
    assert main([verb, deck, *more, "-o", target]) == 2
    assert "it is a folder; name a file" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("motion", "why"),
    [
        ("rotation x", "a body turns about z alone"),
        ("rotation about y", "a body turns about z alone"),
        ("screw z pitch 0.1", "there are no screws"),
        ("translation z", "a planar model has no z"),
    ],
)
def test_a_planar_body_is_wanted_in_its_plane(motion: str, why: str) -> None:
    made = analyse(INPUT / "flexures" / "planar_parallel_guide.dat")
    with pytest.raises(ModelError, match=why):
        made.advice(wanted=[f"body: {motion}"])


def test_what_is_wanted_and_stopped_is_said_where_nothing_else_is_wrong() -> None:
    model = Model()
    model.fix(*model.hexapod(0.1, 0.06, 0.1, name="hexapod", spread=20).ground)
    words = "There is nothing to mend"
    assert f"{words}." in analyse(model).advice().describe()
    made = analyse(model).advice(wanted=["hexapod platform: translation z"])
    assert f"{words}, but what is wanted is stopped." in made.describe()


def test_a_body_is_declared_before_its_points() -> None:
    """A stage on one wire has five motions: those of the stage, not of where the wire ends."""
    model = Model()
    model.wire((0.13, 0, 0), (0.03, 0, 0), name="wire 1")
    model.fix((0.13, 0, 0))
    model.body([(0, 0, 0.05), (0.03, 0, 0)], name="stage")
    words = [step.statement for step in analyse(model).advice() if "eclare" in step.statement]
    assert words[0].startswith("Declare the stage along x, y and z and about x and z independent")


def test_the_first_step_declares_and_releases(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Of a cross hinge one release and one declaration make it exactly constrained."""
    made, target = advice("flexures/cross_hinge_undeclared"), tmp_path / "new.dat"
    assert made[0].purpose is Purpose.REPAIR
    path = str(INPUT / "flexures" / "cross_hinge_undeclared.dat")
    code, out, _ = run(capsys, path, "--apply", "1", "-o", str(target))
    assert code == 0 and "written to" in out and "exactly constrained" in out
    assert analyse(target).verdict is flexact.Verdict.EXACT


def test_a_page_shows_before_and_after(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    target = tmp_path / "page.html"
    path = str(INPUT / "flexures" / "parallel_guide.dat")
    code, out, _ = run(capsys, path, "-o", str(target))
    assert code == 0 and "step 1 shown in" in out
    page = target.read_text(encoding="utf-8")
    assert "before and after" in page and "exactly constrained" in page.lower()
    assert "Constraint of" in page


def test_a_page_of_an_exact_mechanism_shows_it_as_it_is(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, target = write(tmp_path / "exact.dat", DECKS["exact"]), tmp_path / "page.html"
    code, out, _ = run(capsys, str(path), "-o", str(target))
    assert code == 0 and "nothing to mend" in out
    assert "before and after" not in target.read_text(encoding="utf-8")


@pytest.mark.parametrize("suffix", [".png", ".svg"])
def test_a_picture_shows_freedom_and_constraint(
    suffix: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("matplotlib")
    target = tmp_path / f"spaces{suffix}"
    path = str(INPUT / "flexures" / "cross_hinge_undeclared.dat")
    code, out, _ = run(capsys, path, "--body", "body", "-o", str(target))
    assert code == 0 and "drawn in" in out
    assert target.stat().st_size > 5000
    # A framework has no bodies.
    bars = write(tmp_path / "bars.dat", DECKS["exact"])
    code, _, err = run(capsys, str(bars), "-o", str(tmp_path / "bars.png"))
    assert code == 1 and "freedom space" in err and not (tmp_path / "bars.png").exists()


@pytest.mark.parametrize(
    ("expected", "words", "said"),
    [
        (2, ["--apply", "1"], "-o"),
        (2, ["--apply", "1,1", "-o", "new.dat"], "number of a step"),
        (2, ["--apply", "1,,2", "-o", "new.dat"], "number of a step"),
        (1, ["--apply", "1,99", "-o", "new.dat"], "there is no step 99"),
        (2, ["--apply", "1", "-o", "{deck}"], "would overwrite"),
        (2, ["-o", "new.dat"], "--apply"),
        (2, ["-o", "new.gif"], "picture"),
        (2, ["--apply", "1", "-o", "new.png"], "picture"),
        (2, ["--apply", "0", "-o", "new.dat"], "number of a step"),
        (2, ["--apply", "-1", "-o", "new.dat"], "number of a step"),
        (2, ["--apply", "one", "-o", "new.dat"], "number of a step"),
        (2, ["--apply", "1.0", "-o", "new.dat"], "number of a step"),
        (1, ["--apply", "99", "-o", "new.dat"], "there is no step 99: there are "),
        (1, ["--apply", "1.99", "-o", "new.dat"], "no choice 99 of step 1"),
        (1, ["--body", "stge"], "no body"),
        (1, ["--wanted", "stage: spin z"], "wanted"),
        (1, ["--wanted", "nobody: translation z"], "nobody"),
        (2, ["--apply", "1", "-o", "{folder}/missing.dat/new.dat"], "not a folder"),
    ],
)
def test_mistakes_are_told_in_words(
    expected: int, words: list[str], said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    deck = write(tmp_path / "over.dat", guide_deck())
    write(tmp_path / "missing.dat", "")
    places = {"deck": str(deck), "folder": str(tmp_path)}
    given = [word.format(**places) for word in words]
    given = [str(tmp_path / word) if word.startswith("new.") else word for word in given]
    code, out, err = run(capsys, str(deck), *given)
    assert (code, out) == (expected, "")
    assert said in err and "Traceback" not in err
    assert deck.read_text() == guide_deck()
    assert not list(tmp_path.glob("new.*"))


def guide_deck() -> str:
    return guide().to_deck()


def test_several_decks_are_not_applied(decks: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, out, err = run(capsys, str(decks), "--apply", "1", "-o", str(decks / "new.dat"))
    assert (code, out) == (2, "") and "one deck" in err


def test_a_step_that_is_not_there_is_a_failure_in_json(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = write(tmp_path / "exact.dat", DECKS["exact"])
    target = str(tmp_path / "new.dat")
    code, out, err = run(capsys, str(path), "--json", "--apply", "1", "-o", target)
    (said,) = json_lines(out)
    assert code == 1 and said["error"]["diagnostics"][0]["code"] == "no-such-step"
    assert "exactly constrained" in err


def test_json_and_a_changed_deck_go_together(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, target = write(tmp_path / "both.dat", COLLINEAR + "END\n"), tmp_path / "new.dat"
    code, out, err = run(capsys, str(path), "--json", "--apply", "1", "-o", str(target))
    (said,) = json_lines(out)
    assert code == 0 and target.exists() and "written to" in err
    assert json.dumps(said["advice"]["steps"][0]["number"]) == "1"


def test_models_made_in_python_get_calls() -> None:
    model = guide()
    assert isinstance(analyse(model).advice()[0].apply(), Model)
    assert "model.release" in analyse(model).advice().describe()
