# SPDX-License-Identifier: BSD-3-Clause
"""The words of results and messages, as a person reads them: all of them stand in golden/.

Other tests ask for codes, numbers and names, so that prose can be improved here alone:
`make wording` writes the files anew, and the difference is read before it is committed.
"""

from __future__ import annotations

import dataclasses
import itertools
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from ill_conditioned_models import levers, two_wires
from known_models import (
    bar_driven_twice,
    folded_sheet,
    frame,
    hinges_in_a_point,
    ring,
    rounded,
    sheet_clamped_twice,
    twelve_trusses,
)
from large_results import changed, first_of
from reference_decks import ROOT, transform
from small_decks import BROKEN, COLLINEAR, DECKS, write
from wording import GOLDEN, AsStored, masked
from wrong_use import APPEARANCE, BUILDER, Call, each, two_nodes_and_a_bar

import flexact
from flexact import Analysis, Model, analyse
from flexact.advice.describe import describe
from flexact.analysis.decomposition import Asked
from flexact.apps.checks.comparison import (
    StoredAnswerError,
    answer_bytes,
    answer_in,
    answer_of,
    differences,
)
from flexact.apps.cli.main import main
from flexact.core import calls
from flexact.core.arrays import model_arrays
from flexact.show.spacar_log import log_text, spacar_log
from flexact.util import machine as memory
from flexact.util.decks import DeckFile
from flexact.util.outputs import OutputError, plan_files, write_together

INPUT = ROOT / "input_decks"
TURN = transform.about("x", 0.7) @ transform.about("y", -1.1) @ transform.about("z", 2.3)
NOTES = "TRUSS 1 1 2 % " + "long " * 60 + "\nX 2 1 0 0\nX 2 2 0 0\nEND\nTIMESTEP 2 1\nEND\n"


def deck(name: str) -> Analysis:
    return analyse(INPUT / f"{name}.dat", name=name)


def named(model: Model, name: str, **chosen: Any) -> Analysis:
    return analyse(model, name=name, **chosen)


def left_out() -> Analysis:
    whole = analyse(folded_sheet(False, beams=4))
    return changed(whole, motions=first_of(whole.raw.motions, 3))


def in_parts() -> Analysis:
    whole = analyse(folded_sheet(False))
    return changed(whole, method="sparse", components=300, largest_component=(36, 35))


def not_confirmed(method: str) -> Analysis:
    analysis = analyse(ring(5), prove=False)
    return changed(analysis, confirmed=False, method=method)


def unjudged() -> Analysis:
    """As of a model that is too large for exact arithmetic and for more digits."""
    given = analyse(levers(20, 10.0), tolerance=1e-15)
    asked = dataclasses.replace(given, asked=Asked())
    return changed(asked, proven_rank=-1, unjudged=True)


RESULTS: dict[str, Callable[[], Analysis]] = {
    # By verdict
    "exact": lambda: named(ring(5), "ring of five"),
    "under_by_six": lambda: analyse(folded_sheet(clamped=False)),
    "over_without_columns": lambda: analyse(sheet_clamped_twice()),
    "both": lambda: analyse(twelve_trusses()),
    "both_of_a_fold": lambda: analyse(folded_sheet(clamped=True)),
    "exact_deck": lambda: deck("paper/five_folded_sheets"),
    "over_deck": lambda: deck("paper/six_folded_sheets"),
    "zero_of_a_deck": lambda: deck("flexures/parallel_guide_undeclared"),
    "no_extent": lambda: analyse(hinges_in_a_point()),
    # Advice
    "declared_against_a_constraint": lambda: deck("flexures/folded_sheet_clamped_trap"),
    "driven_twice": lambda: analyse(bar_driven_twice()),
    "stress_that_loads_no_support": lambda: analyse(frame(1.0)),
    # Certainty and margin
    "digits_explain": lambda: analyse(rounded(twelve_trusses(), TURN, ".3e")),
    "digits_make_zeros": lambda: analyse(rounded(twelve_trusses(), TURN, ".10e")),
    "tolerance_given": lambda: analyse(two_wires(1e-4), tolerance=1e-3),
    "small_angle": lambda: analyse(two_wires(1e-4)),
    "close_decision": lambda: analyse(two_wires(1e-13)),
    "beyond_the_digits": lambda: analyse(levers(20, 10.0)),
    "beyond_the_digits_unjudged": unjudged,
    "undecided": lambda: changed(analyse(ring(6)), undecided=1, left=1e-16, explained=2e-17),
    "unseen": lambda: changed(analyse(ring(5)), unseen=1),
    "zero_meant": lambda: deck("linkages/bennett"),
    "not_proven": lambda: analyse(ring(5), prove=False),
    "too_large_by_default": lambda: changed(analyse(ring(5)), proven_rank=-1),
    "not_confirmed": lambda: not_confirmed("sparse"),
    # Methods
    "method_asked_for": lambda: analyse(twelve_trusses(), method="jacobi"),
    "method_left": lambda: analyse(twelve_trusses(), method="sparse", tolerance=1e-3),
    "method_in_parts": in_parts,
    # Many modes, notes
    "vectors_left_out": left_out,
    "many_modes": lambda: analyse(folded_sheet(clamped=True, beams=6)),
    "notes": lambda: analyse(flexact.read_text(NOTES)),
}


@pytest.mark.parametrize("name", RESULTS)
def test_words_of_a_result(name: str, as_stored: AsStored) -> None:
    as_stored(masked(RESULTS[name]().describe()), GOLDEN / "results" / f"{name}.txt")


@pytest.mark.parametrize("name", ["both", "many_modes", "vectors_left_out"])
def test_words_of_a_log(name: str, as_stored: AsStored) -> None:
    log = log_text(RESULTS[name](), most_in_mesh=6)
    as_stored(masked(log), GOLDEN / "logs" / f"{name}.txt")


def test_words_of_a_log_in_the_form_of_spacar(as_stored: AsStored) -> None:
    log = spacar_log(deck("linkages/four_bar_planar_driven")).split("\n", 1)[1]
    as_stored(re.sub(" +$", "", log, flags=re.MULTILINE), GOLDEN / "logs" / "spacar.txt")


@pytest.mark.parametrize("name", RESULTS)
def test_lines_stay_short(name: str) -> None:
    """About a hundred characters, but where a name alone is longer."""
    text = describe(RESULTS[name](), about_model=False)
    assert all(len(line) <= 100 or "long long" in line for line in text.splitlines())


def test_words_of_a_line(as_stored: AsStored) -> None:
    """What stands for a result, a mode or a model on one line."""
    said = []
    for name in ("exact", "both", "under_by_six"):
        analysis = RESULTS[name]()
        said += [repr(analysis), repr(analysis.model)]
    both = RESULTS["both"]()
    said += [repr(both.motions[0]), repr(both.self_stresses[0]), repr(Model())]
    text = re.sub(r"-(?=\d)", "+-", "\n".join(said))
    as_stored(re.sub(r"(?<![-\w.])(?=\d\S* (m|N)\b)", "+-", text), GOLDEN / "results" / "lines.txt")


# Messages


def said_by(call: Callable[[], object]) -> str:
    """`code: message` of the problems of an error, or `type: message` where it has no code."""
    with pytest.raises((flexact.FlexactError, TypeError, ValueError)) as caught:
        call()
    error = caught.value
    if isinstance(error, (flexact.ModelError, flexact.DeckError)):
        parts = [(f"{d.code}: {d.message}", d.help) for d in error.diagnostics]
        return "\n".join(text + f" [{hint}]" * bool(hint) for text, hint in parts)
    return f"{type(error).__name__}: {error}"


def of_table(table: dict[str, list[Call]]) -> Iterator[Callable[[], object]]:
    for _, call in each(table):
        yield lambda call=call: call(*two_nodes_and_a_bar())  # type: ignore[misc]


def of_models() -> Iterator[Callable[[], object]]:
    """Models that cannot be analysed, made call by call."""

    def flawed() -> Model:
        model = Model()
        a, b, c = model.node(1, 1, 1), model.node(1, 1, 2), model.node(2, 1, 1)
        model.truss(a, b)
        model.beam(a, c, y=(-3, 0, 0))
        model.move(b, (1, 1, 1))
        return model

    def to_itself() -> Model:
        model = Model()
        model.wire((1, 1, 1), (1, 1, 1), name="leg")
        return model

    def at_one_place() -> Model:
        model = Model()
        model.truss(model.node(1, 1, 1, name="tip"), model.node(1, 1, 1))
        return model

    def unused() -> Model:
        model, *_ = two_nodes_and_a_bar()
        model.fix(model.node(2, 0, 0))
        return model

    def turned() -> Model:
        model, a, _, _ = two_nodes_and_a_bar()
        model.fix(a, "rx")
        return model

    yield lambda: analyse(flawed())
    yield to_itself
    yield at_one_place
    yield lambda: analyse(unused())
    yield lambda: unused().to_deck()
    yield lambda: analyse(turned())
    yield lambda: analyse(Model())
    yield lambda: analyse(folded_sheet(True, size=1e-200))
    yield lambda: analyse(folded_sheet(True, size=2e90))
    yield lambda: analyse(folded_sheet(True, size=5e-324))


def of_arguments() -> Iterator[Callable[[], object]]:
    """Of `analyse`, of reading, and of the functions on a configuration."""
    model = twelve_trusses()
    arrays = model.data.arrays._asdict()
    yield lambda: analyse(model, method="SVD")
    yield lambda: analyse(model, method=3)  # type: ignore[arg-type]
    for tolerance in (-1.0, float("nan"), "1e-3", True, [1.0]):
        yield lambda tolerance=tolerance: analyse(model, tolerance=tolerance)  # type: ignore[misc]
    yield lambda: analyse(5)  # type: ignore[arg-type]
    yield lambda: analyse(model, name=5)  # type: ignore[arg-type]
    yield lambda: flexact.read_text(5)  # type: ignore[arg-type]
    yield lambda: flexact.read_text("TRUSS 1 1 2", 5)  # type: ignore[arg-type]
    yield lambda: flexact.jacobian(model, c_t=np.zeros(3))
    yield lambda: model.reference().moved(np.zeros((2, 2)))
    yield lambda: model_arrays(**{**arrays, "coordinate_class": np.zeros((1, 2), int)})
    yield lambda: model_arrays(**{**arrays, "node_kind": np.full(8, 2.0)})
    yield lambda: model_arrays(**{**arrays, "node_value": np.full((4, 8), "x")})
    yield lambda: model_arrays(**{**arrays, "node_number": np.full(8, 2**31)})


@pytest.mark.parametrize(
    ("name", "given"),
    [
        ("builder", lambda: of_table(BUILDER)),
        ("appearance", lambda: of_table(APPEARANCE)),
        ("models", of_models),
        ("arguments", of_arguments),
    ],
)
def test_messages(
    name: str, given: Callable[[], Iterator[Callable[[], object]]], as_stored: AsStored
) -> None:
    said = "\n".join(f"- {said_by(call)}" for call in given())
    as_stored(masked(said), GOLDEN / "messages" / f"{name}.txt")


def test_messages_of_failed_analyses(as_stored: AsStored, monkeypatch: pytest.MonkeyPatch) -> None:
    raw = analyse(ring(3)).raw
    said = []
    for error in ("convergence", "memory", "interrupted", "not found"):
        failed = raw._replace(error=error, bytes_needed=3.5e9)
        monkeypatch.setattr(calls, "analyse_model", lambda *_, failed=failed, **__: failed)
        said.append(said_by(lambda: analyse(ring(3))))

    def full(*_: object, **__: object) -> None:
        raise MemoryError

    monkeypatch.setattr(calls, "analyse_model", full)
    said.append(said_by(lambda: analyse(ring(3))))
    as_stored("\n".join(said), GOLDEN / "messages" / "failed_analyses.txt")


@pytest.mark.posix
def test_messages_of_files(as_stored: AsStored, tmp_path: Path) -> None:
    """What stands in the way of files of results, and what is no stored answer."""
    folder, file = tmp_path / "folder", write(tmp_path / "file", "")
    folder.mkdir()
    read_only = write(tmp_path / "read-only", "old")
    read_only.chmod(0o444)
    pair = [DeckFile("one/x.dat", Path("x")), DeckFile("two/x.dat", Path("x"))]
    own = write(tmp_path / "x.json", "")
    (tmp_path / "y.log").symlink_to(tmp_path / "y.json")
    (tmp_path / "loop").symlink_to(tmp_path / "loop")
    tries: tuple[Callable[[], object], ...] = (
        lambda: plan_files(pair, tmp_path / "new", (".json",)),
        lambda: plan_files([DeckFile(str(own), Path("x"))], tmp_path, (".json",)),
        lambda: plan_files([DeckFile("in/y.dat", Path("y"))], tmp_path, (".json", ".log")),
        lambda: plan_files([], file / "below", (".json",)),
        lambda: write_together({read_only: b"new"}),
        lambda: write_together({folder: b"new"}),
        lambda: write_together({tmp_path / "loop": b"new"}),
    )
    said = []
    for attempt in tries:
        with pytest.raises(OutputError) as error:
            attempt()
        said.append(f"OutputError: {error.value}")
    stored = ROOT / "tests/reference/paper/twelve_trusses.json"
    whole = answer_in(answer_bytes(stored), stored)
    assert whole.numbers["rank"] == 11
    for text in ("", "{}", '{"format": 2}', analyse(ring(3)).to_json()):
        with pytest.raises(StoredAnswerError) as wrong:
            answer_in(text.encode(), write(tmp_path / "answer.json", text))
        said.append(f"StoredAnswerError: {wrong.value}")
    as_stored("\n".join(said).replace(str(tmp_path), "FOLDER"), GOLDEN / "messages" / "files.txt")


def test_words_of_differences(as_stored: AsStored) -> None:
    """Of stored answers: counts, singular values, motions and self-stresses."""
    texts = (COLLINEAR, COLLINEAR.replace("X 3 1 0", "X 3 1 1"), DECKS["over"])
    answers = [answer_of(analyse(flexact.read_text(text))) for text in texts]
    said = [line for one, other in itertools.pairwise(answers) for line in differences(one, other)]
    text = "\n".join(f"- {line}" for line in said)
    as_stored(masked(text), GOLDEN / "messages" / "differences.txt")


# The command

COMMANDS = (
    "--help",
    "analyse exact.dat",
    "analyse both.dat --method jacobi --tolerance 0.001",
    "analyse under.dat --expect exact",
    "analyse broken.dat exact.dat missing.dat empty",
    "analyse empty",
    "check exact.dat",
    "check broken.dat",
    "regress exact.dat --against answers",
    "regress exact.dat --against answers --store",
    "regress exact.dat --against answers",
    "analize exact.dat",
    "chek exact.dat",
    "analyse",
    "analyse exact.dat --expect three",
    "analyse exact.dat --mesh vtk",
    "analyse exact.dat -o out --format nonsense",
    "analyse exact.dat -o out --mesh nonsense",
    "analyse exact.dat -o out --mesh stl",
    "analyse over.dat under.dat --format github --expect exact",
    "check broken.dat missing.dat --format github",
    "check broken.dat --json",
    "analyse exact.dat --method cholesky",
    "analyse exact.dat --tolerance -1",
    "analyse exact.dat -o exact.dat",
    "analyse exact.dat other/exact.dat -o out",
    "regress exact.dat",
    "batch exact.dat over.dat broken.dat missing.dat -o table.csv",
    "batch exact.dat over.dat -o table.jsonl --where over_constrained>0",
    "batch exact.dat empty -o table.csv",
    "batch exact.dat -o table.txt",
    "batch exact.dat -o table.csv --where verdikt=='exact'",
    "batch exact.dat -o table.csv --where verdict=='exact'",
    "batch exact.dat -o table.csv --dask here",
)


def test_words_of_the_command(
    as_stored: AsStored,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Command, stdout, stderr and exit code, one after the other."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "100")
    for name, text in {**DECKS, "broken": BROKEN, "other/exact": DECKS["exact"]}.items():
        write(tmp_path / f"{name}.dat", text)
    (tmp_path / "empty").mkdir()
    said = []
    for line in COMMANDS:
        code = main(line.split())
        out, err = capsys.readouterr()
        # How argparse quotes and wraps differs between versions of Python.
        err = re.sub(r"^Usage: .*\n(?: .*\n)*", "Usage: ...\n", err, flags=re.MULTILINE)
        err = re.sub(r"\(choose from .*\)", "(choose from ...)", err)
        err = re.sub(r"there are .*; ", "there are ...; ", err.replace(str(tmp_path), "FOLDER"))
        parts = [f"$ flexact {line}", out.strip(), err.strip(), f"exit code {code}"]
        said.append("\n".join(part for part in parts if part))
    as_stored(masked("\n\n".join(said)), GOLDEN / "command.txt")


def test_words_where_the_memory_does_not_suffice(
    as_stored: AsStored,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(memory, "_SMALL", 0)
    monkeypatch.setattr(memory, "available", lambda: 1e3)
    write(tmp_path / "exact.dat", DECKS["exact"])
    code = main(["analyse", "exact.dat", "--method", "svd"])
    out, err = capsys.readouterr()
    assert (code, out) == (2, "")
    as_stored(err, GOLDEN / "messages" / "memory.txt")
