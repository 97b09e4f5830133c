# SPDX-License-Identifier: BSD-3-Clause
"""``flexact bench``: mechanisms with known counts, its table, its JSON, and how it ends."""

import json
import os
import re
import signal
import subprocess
import sys
import time
from typing import Any

import jsonschema
import numpy as np
import pytest
from json_schema import schema

import flexact
from flexact.apps.checks import bench as measurement
from flexact.apps.checks.bench import FAMILIES, full_matrix, least_times, measure
from flexact.apps.cli.main import main
from flexact.util import machine as memory

#: One dense and one sparse, and one beside which no SVD runs.
TINY = (("stages", 2, "svd"), ("bars", 3, "sparse"), ("stages", 8, "sparse"))


@pytest.mark.parametrize(
    ("family", "side"), [("stages", 1), ("stages", 3), ("bars", 2), ("bars", 4)]
)
def test_mechanisms_have_the_rank_that_they_are_made_for(family: str, side: int) -> None:
    """By numpy's singular values of D(c), and by the count of what holds a stage or a joint."""
    model, _, motions, self_stresses = FAMILIES[family](side)
    data = flexact.read_text(model.to_deck()).data
    full = full_matrix(model)
    assert full.shape == (data.count.rows, data.count.columns)
    assert full.shape[1] == (24 * side**2 if family == "stages" else 3 * side**3)
    rank = int(np.linalg.matrix_rank(full))
    assert (full.shape[1] - rank, full.shape[0] - rank) == (motions, self_stresses)
    assert data.problems.total == 0


def test_mechanisms_are_nearly_in_one_piece() -> None:
    """So that they are as hard as they are large; only rotations of folds stand alone."""
    for family, side in (("stages", 3), ("bars", 3)):
        analysis = flexact.analyse(FAMILIES[family](side)[0])
        assert analysis.raw.largest_component[1] >= 0.9 * analysis.columns


def test_a_measurement_has_times_by_threads_and_a_ratio() -> None:
    told: list[tuple[str, float]] = []
    found = list(measure(TINY, (1, 2), lambda name, done: told.append((name, done))))
    assert [one.method for one in found] == ["svd", "sparse", "sparse"]
    assert all(set(one.seconds) == {1, 2} and one.counts_are_right for one in found)
    assert [set(one.svd_seconds) for one in found] == [{1, 2}, {1, 2}, set()]
    for one in found[:2]:
        assert one.ratio == one.seconds[1] / one.svd_seconds[1]
    assert found[2].ratio is None
    parts = [done for _, done in told]
    assert parts == sorted(parts) and parts[0] == 0.0 and parts[-1] < 1.0


def test_what_is_measured_runs_on_so_many_threads(monkeypatch: pytest.MonkeyPatch) -> None:
    from threadpoolctl import threadpool_info

    seen = []

    def count(calls: Any) -> list[float]:
        seen.append({one["num_threads"] for one in threadpool_info()})
        return [1.0] * len(calls)

    monkeypatch.setattr(measurement, "least_times", count)
    list(measure(TINY[:1], (1, 2), lambda name, done: None))
    assert seen[0] == {1} and max(seen[1]) <= 2


def test_the_shortest_of_runs_in_turn_counts() -> None:
    order: list[str] = []
    calls = [lambda: order.append("a"), lambda: (order.append("b"), time.sleep(0.15))]
    first, second = least_times(calls)
    assert order[:4] == ["a", "b", "a", "b"]
    assert first < second >= 0.15


def test_a_mechanism_that_does_not_fit_says_why(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(memory, "_SMALL", 0)
    monkeypatch.setattr(memory, "available", lambda: 1e3)
    (found,) = measure(TINY[:1], (1,), lambda name, done: None)
    assert "memory" in found.error and not found.seconds


@pytest.fixture
def tiny(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(measurement, "QUICK", TINY)


@pytest.mark.usefixtures("tiny")
def test_the_table_has_machine_and_measurements(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bench", "--quick"]) == 0
    out, err = capsys.readouterr()
    assert err == "" and out.startswith(f"flexact         {flexact.__version__}\n")
    assert re.search(rf"^numpy +{re.escape(np.__version__)}$", out, re.MULTILINE)
    assert os.sep not in out.replace("numpy's", "")
    rows = [line for line in out.splitlines() if " x " in line]
    assert len(rows) == len(TINY) and all(len(row) <= 100 for row in rows)
    assert [row.split()[-1] == "-" for row in rows] == [False, False, True]


@pytest.mark.usefixtures("tiny")
def test_the_json_is_what_its_schema_says(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bench", "--quick", "--json"]) == 0
    made = json.loads(capsys.readouterr().out)
    jsonschema.validate(made, schema("bench"))
    assert made["quick"] and len(made["measurements"]) == len(TINY)
    assert {"flexact", "numpy", "processors"} <= {one["name"] for one in made["machine"]}
    assert set(made["measurements"][0]) <= set(
        schema("bench")["properties"]["measurements"]["items"]["properties"]
    )


@pytest.mark.usefixtures("tiny")
def test_wrong_counts_are_told(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    right = FAMILIES["stages"]
    monkeypatch.setitem(FAMILIES, "stages", lambda side: (*right(side)[:2], 1, 0))
    assert main(["bench", "--quick"]) == 3
    out, err = capsys.readouterr()
    assert out.count("WRONG COUNTS") == 2 and "report" in err


@pytest.mark.posix
def test_ctrl_c_ends_it_cleanly() -> None:
    words = [sys.executable, "-m", "flexact", "bench"]
    pipe = subprocess.PIPE
    with subprocess.Popen(words, stdout=pipe, stderr=pipe, text=True) as run:
        assert run.stdout is not None and run.stderr is not None
        assert run.stdout.readline().startswith("flexact")
        run.send_signal(signal.SIGINT)
        # 130 in a shell.
        assert run.wait(30) == -signal.SIGINT
        assert run.stderr.read() == ""
