# SPDX-License-Identifier: BSD-3-Clause
"""Scatter of clamps and thicknesses: closed forms, indices, killed runs, the command, refusals."""

import csv
import io
import json
import math
import os
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest
from json_schema import schema, strict
from reference_decks import ROOT

import flexact
from flexact.apps.cli.main import main
from flexact.sweeps.indices import first_order, normal, points, totals
from flexact.sweeps.journal import JournalError
from flexact.util.units import MILLIMETRES

DECK = ROOT / "input_decks" / "flexures" / "parallel_guide_width_as_y.dat"
NOTCHES = ROOT / "input_decks" / "flexures" / "notch_guide.dat"
#: Of that guide: E I of each sheet, its length and thickness, and how far the sheets are apart.
EI, LENGTH, THICK, WIDE, STRENGTH = 0.0189, 0.05, 0.3e-3, 0.1, 450e6
VALID = jsonschema.Draft202012Validator(strict(schema("cost")))


def guide(**options: Any) -> flexact.Elastic:
    return flexact.elastic(DECK, beams=1, **options)


def within(made: float, wanted: float, error: float) -> bool:
    return abs(made - wanted) <= 3.0 * error


# Closed forms


def test_the_force_at_rest_is_that_of_clamps_that_are_off() -> None:
    """Slope deflection: each sheet bears 12 EI/L^3 of a shift and 6 EI/L^2 of a turn at an end.

    The body turns where one sheet stands higher; the force is linear, so that its variance is the
    sum of those of the inputs. Shares of it are their first-order and total indices.
    """
    shift, turn = 20e-6, 0.1e-3
    found = guide(drive="locked").scatter(shift, turn, samples=1000, limits={}, workers=1)
    along = 12.0 * EI / LENGTH**3 * shift
    about = 6.0 * EI / LENGTH**2 * turn
    higher = 2.0 * 6.0 * EI / LENGTH**2 * shift / WIDE
    variance = 2.0 * (along**2 + about**2 + higher**2)
    sd, count = math.sqrt(variance), len(found)
    assert within(found.mean("force"), 0.0, sd / math.sqrt(count))
    assert within(found.sd("force"), sd, sd / math.sqrt(2 * count))
    shares = found.shares("force")
    for name, part in (("11:x", along), ("21:x", along), ("11:ry", about), ("21:z", higher)):
        first, total = shares[name]
        assert first == pytest.approx(part**2 / variance, abs=0.01)
        error = found.total.error[[a.name for a in found.answers].index("force")].max()
        assert within(total, part**2 / variance, max(error, 0.01))
    assert shares["11:y"][0] < 0.01


def test_the_force_of_a_stroke_goes_with_the_cubes_of_thicknesses() -> None:
    """F = 12 E (I1 + I2) s/L^3 with I ~ t^3: the mean of t^3 of a normal t is t0^3 + 3 t0 sd^2,
    and of (1 + c z)^3 the variance is 9 c^2 + 36 c^4 + 15 c^6."""
    part, stroke = 0.1, 1e-5
    found = guide().scatter(
        thickness=part * THICK, samples=1000, limits={}, workers=1,
        stroke=(13, "x", 0.0, stroke),
    )  # fmt: skip
    plain = 24.0 * EI / LENGTH**3 * stroke
    mean = plain * (1.0 + 3.0 * part**2)
    sd = plain / 2.0 * math.sqrt(2.0 * (9.0 * part**2 + 36.0 * part**4 + 15.0 * part**6))
    assert found.designed[[a.name for a in found.answers].index("force")] == pytest.approx(
        plain, rel=1e-3
    )
    assert within(found.mean("force"), mean, sd / math.sqrt(len(found)))
    # Of a normal one the standard error of sd; the cube has a kurtosis of some 4.
    assert within(found.sd("force"), sd, sd / math.sqrt(len(found)))
    both = found.shares("force")
    assert set(list(both)[:2]) == {"left sheet: thickness", "right sheet: thickness"}
    assert all(share[0] == pytest.approx(0.5, abs=0.02) for share in list(both.values())[:2])
    # sigma = 3 E t d/L^2 of an S-shaped sheet, E = 12 EI/(b t^3): the thicker sheet has more.
    young = 12.0 * EI / (0.04 * THICK**3)
    thickest = THICK + np.maximum(found["left sheet: thickness"], found["right sheet: thickness"])
    assert found["stress"] == pytest.approx(3.0 * young * thickest * stroke / LENGTH**2, rel=2e-3)
    assert found["strength"] == pytest.approx(found["stress"] / STRENGTH)
    thicker = found["left sheet: thickness"] > found["right sheet: thickness"]
    assert np.array_equal(np.array(found.parts) == "left sheet", thicker)


def test_the_mean_place_of_both_clamps_is_where_the_stage_rests() -> None:
    """Equal springs: the stage rests at the mean of both clamps, so that sd is s/sqrt(2)."""
    found = guide().scatter("20um", samples=500, limits={}, workers=1)
    # Where one clamp is higher the body leans by it over their distance, and moves with it.
    lean = 20e-6 / WIDE * math.sqrt(2.0) * LENGTH / 2.0
    sd = math.hypot(20e-6 / math.sqrt(2.0), lean)
    assert within(found.sd("x"), sd, sd / math.sqrt(2 * len(found)))


def test_a_round_wire_is_stiff_with_the_fourth_power_of_its_diameter() -> None:
    """EA ~ d^2, E I and G It ~ d^4 of a cantilever: tip force 3 EI u/L^3; mass ~ d^2."""
    model = flexact.Model()
    steel = flexact.Material(E=210e9, G=80e9, density=7800.0, strength=1e9)
    model.wire((0, 0, 0), (0.1, 0, 0), thickness=1e-3, material=steel)
    model.fix((0, 0, 0))
    found = flexact.elastic(model, beams=1).scatter(
        thickness="20um", samples=50, limits={"strength": 0.5}, workers=1,
        stroke=((0.1, 0, 0), "y", 0.0, 1e-5), at=(0.1, 0, 0),
    )  # fmt: skip
    ratio = 1.0 + found[found.inputs[0].name] / 1e-3
    plain = 3.0 * 210e9 * math.pi / 64.0 * 1e-12 * 1e-5 / 0.1**3
    assert found["force"] == pytest.approx(plain * ratio**4, rel=2e-3)
    # A frequency of a wire alone goes with its diameter; the tip is free at a constant force.
    assert found["frequency"] / found["frequency"][0] == pytest.approx(ratio / ratio[0], rel=1e-4)
    assert found.kept[0].share.value == 1.0


# One sample, and the whole path


def test_a_sample_is_what_imperfect_models_say() -> None:
    """The public states of `imperfect`, at rest and driven, of the same errors."""
    found = guide().scatter(
        "20um", "0.1mrad", samples=3, limits={}, workers=1, stroke=(13, "x", 0.0, 1e-3)
    )
    for k in range(len(found)):
        off = [
            (int(clamp), direction, float(value))
            for each, value in zip(found.inputs, found.errors[k], strict=True)
            for clamp, direction in [each.name.split(":")]
        ]
        model = guide().imperfect(off)
        rest, driven = model.assembled(), model.along(13, "x", [1e-3])[0]
        stress = max(each.von_mises(part) for each in (rest, driven) for part in (1, 2))
        assert found["stress"][k] == pytest.approx(stress, rel=1e-4)
        assert found["force"][k] == pytest.approx(driven.force, rel=1e-4)
        first = min(rest.frequencies[0], driven.frequencies[0])
        assert found["frequency"][k] == pytest.approx(first, rel=1e-4)
        straight = guide().along(13, "x", [1e-3])[0]
        error = driven.position(13) - straight.position(13)
        assert found["z"][k] == pytest.approx(error[2], rel=1e-3, abs=1e-9)
    assert found.checked.number == 3
    # Of three samples nobody knows first-order indices.
    assert "nan" not in found.describe() and np.isnan(found.first).all()
    assert np.nanmax(found.checked.off) < 5e-3


def test_samples_are_shifted_by_what_finer_meshes_make_of_the_design() -> None:
    """As designed it is the state of 8 and 16 beams; the samples lie as those of `imperfect` do."""
    found = flexact.elastic(DECK).scatter(
        "10um", "0.05mrad", samples=4, limits={}, workers=1, stroke=(13, "x", 0.0, 2.5e-3)
    )
    q = [each.name for each in found.answers].index("parasitic")
    driven = flexact.elastic(DECK).along(13, "x", [2.5e-3])[0]
    assert found.designed[q] == pytest.approx(driven.frequencies[1], rel=1e-6)
    coarse = flexact.elastic(DECK, beams=8).along(13, "x", [2.5e-3])[0]
    shift = float(driven.frequencies[1] - coarse.frequencies[1])
    assert abs(shift) > 5.0
    assert abs(found.checked.shift[q]) < 0.02 * abs(shift)


def test_a_sheet_that_is_divided_in_the_deck_has_one_thickness() -> None:
    model = flexact.Model()
    model.sheet((0, 0, 0), (0.1, 0, 0), width=(0, 0, 1), thickness=0.5e-3, breadth=0.02,
                material="spring steel", beams=4)  # fmt: skip
    model.fix((0, 0, 0))
    found = flexact.elastic(model, beams=4).scatter(
        thickness="10um", samples=10, limits={}, workers=1,
        stroke=((0.1, 0, 0), "y", 0.0, 1e-5), at=(0.1, 0, 0),
    )  # fmt: skip
    assert len(found.inputs) == 1
    ratio = 1.0 + found[found.inputs[0].name] / 0.5e-3
    assert found["force"] / found["force"][0] == pytest.approx(ratio**3 / ratio[0] ** 3, rel=1e-3)


# Points and indices


def test_points_lie_in_every_cell_once() -> None:
    """Of the first b^k points of a Halton sequence each of b^k cells has one, permuted or not."""
    made = points(243, 3, seed=5)
    for dimension, base in enumerate((2, 3, 5)):
        count = base ** int(math.log(243) / math.log(base) + 1e-9)
        cells = np.floor(made[:count, dimension] * count).astype(int)
        assert sorted(cells.tolist()) == list(range(count))
    assert np.array_equal(points(100, 3, seed=5), made[:100])
    assert not np.array_equal(points(243, 3, seed=6), made)


def test_normal_numbers_are_those_of_tables() -> None:
    """Abramowitz and Stegun, table 26.5."""
    made = normal(np.array([[0.5, 0.975], [0.95, 0.1]]))
    assert made == pytest.approx(np.array([[0.0, 1.959964], [1.644854, -1.281552]]), abs=5e-7)


def test_indices_of_a_product_and_a_sum() -> None:
    """f = z1 z2 + z3: the variances of both terms are 1, and z1 and z2 have theirs together."""
    numbers = normal(points(4000, 6, seed=1))
    z, other = numbers[:, :3], numbers[:2000, 3:]

    def f(x: np.ndarray) -> np.ndarray:
        return np.asarray(np.stack([x[..., 0] * x[..., 1] + x[..., 2], x[..., 2] ** 3], axis=-1))

    behind = np.stack([f(np.where(np.arange(3) == k, other, z[:2000])) for k in range(3)])
    first = first_order(z, f(z))
    total = totals(f(z)[:2000], behind, f(z).var(axis=0, ddof=1))
    assert first == pytest.approx(np.array([[0, 0, 0.5], [0, 0, 1]]), abs=0.02)
    wanted = np.array([[0.5, 0.5, 0.5], [0.0, 0.0, 1.0]])
    assert (np.abs(total.value - wanted) <= 3.0 * total.error + 1e-12).all()


# The same table, whatever happens


def scattered(**more: Any) -> flexact.Scatter:
    made = guide().scatter("20um", "0.1mrad", "5um", samples=40, seed=3, **more)
    assert isinstance(made, flexact.Scatter)
    return made


def test_the_table_is_the_same_with_any_number_of_workers() -> None:
    one, two = scattered(workers=1), scattered(workers=2)
    assert one.to_csv() == two.to_csv()
    assert one.to_dict() == two.to_dict()
    other = guide().scatter("20um", "0.1mrad", "5um", samples=40, seed=4, workers=1)
    assert other.to_csv() != one.to_csv()


def test_a_run_that_was_stopped_goes_on(tmp_path: Path) -> None:
    journal = tmp_path / "run.journal"

    def stop(_: str, done: float) -> None:
        if done > 0.3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        scattered(workers=1, resume=journal, progress=stop)
    first = len(journal.read_text().splitlines())
    assert first > 10
    with pytest.raises(JournalError, match="another run"):
        guide().scatter("10um", samples=40, seed=3, workers=1, resume=journal)
    seen: list[float] = []
    made = scattered(workers=1, resume=journal, progress=lambda _, done: seen.append(done))
    assert seen[0] > 0.3
    assert made.to_csv() == scattered(workers=1).to_csv()
    assert not journal.exists()


@pytest.mark.posix
def test_a_run_that_was_killed_goes_on(tmp_path: Path) -> None:
    journal = tmp_path / "run.journal"
    code = (
        f"import flexact; flexact.elastic({str(DECK)!r}, beams=1).scatter('20um', '0.1mrad', "
        f"'5um', samples=40, seed=3, workers=2, resume={str(journal)!r})"
    )
    folders = os.pathsep.join(sys.path)
    run = subprocess.Popen([sys.executable, "-c", code], env={**os.environ, "PYTHONPATH": folders})
    while not journal.exists() or journal.stat().st_size < 3000:
        assert run.poll() is None
        time.sleep(0.005)
    run.send_signal(signal.SIGKILL)
    run.wait()
    assert journal.exists()
    assert scattered(workers=1, resume=journal).to_csv() == scattered(workers=1).to_csv()


def test_millimetres_say_the_same() -> None:
    metres = scattered(workers=1, limits={"stress": 5e6, "x": 20e-6, "frequency": 13.0})
    model = flexact.read(DECK)
    data = replace(model.data, units=MILLIMETRES)
    found = flexact.elastic(flexact.Model.from_data(data), beams=1).scatter(
        0.02, 1e-4, 0.005, samples=40, seed=3, workers=1,
        limits={"stress": 5.0, "x": 0.02, "frequency": 13.0},
    )  # fmt: skip
    assert found["stress"] == pytest.approx(metres["stress"] / 1e6)
    assert found["x"] == pytest.approx(metres["x"] * 1e3)
    assert found["11:x"] == pytest.approx(metres["11:x"] * 1e3)
    assert found["frequency"] == pytest.approx(metres["frequency"])
    assert [each.share for each in found.kept] == [each.share for each in metres.kept]
    assert found.to_dict()["scatter"]["quantities"][0]["unit"] == "MPa"


def test_limits_are_counted_sample_by_sample() -> None:
    made = scattered(workers=1, limits={"stress": 6e6, "frequency": "13.4Hz", "rx": "50urad"})
    good = made["stress"] <= 6e6, made["frequency"] >= 13.4, np.abs(made["rx"]) <= 50e-6
    assert [each.share.number for each in made.kept] == [int(each.sum()) for each in good]
    assert made.all_kept.number == int((good[0] & good[1] & good[2]).sum())
    share = made.kept[0].share
    assert share.low < share.value < share.high
    assert scattered(workers=1).kept[0].name == "strength"


# What is refused


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((), "nothing scatters"),
        (("-5um",), "negative"),
        ((math.nan,), "finite"),
        ((20.0,), "larger than the whole model"),
        (("20um", None, "0.1mm"), "standard deviations"),
        (("20 N",), "length"),
    ],
)
def test_standard_deviations_that_make_no_sense_are_refused(
    arguments: tuple[Any, ...], words: str
) -> None:
    with pytest.raises(flexact.FlexactError, match=words):
        guide().scatter(*arguments, samples=10)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"limits": {"strain": 1.0}}, "there are stress, strength"),
        ({"limits": {"force": 1.0}}, "stroke"),
        ({"limits": {"strength": 2.0}}, "at most 1"),
        ({"limits": {"frequency": -1.0}}, "positive"),
        ({"samples": 1}, "2 or more"),
        ({"at": 99}, "no node 99"),
        ({"stroke": "11:x=+-1mm"}, "fixed"),
        ({"stroke": "13:x=+-1"}, "larger than the whole model"),
    ],
)
def test_what_is_asked_beside_is_refused_in_words(options: dict[str, Any], words: str) -> None:
    with pytest.raises(flexact.FlexactError, match=words):
        guide().scatter("20um", **{"samples": 10, **options})


def without(*words: str) -> flexact.Model:
    lines = DECK.read_text(encoding="utf-8").splitlines()
    left = [line for line in lines if not line.startswith(words)]
    return flexact.read_text("\n".join(left) + "\n")


def test_decks_without_what_is_needed_are_refused_in_words() -> None:
    def ask(model: flexact.Model, *sd: str, **more: Any) -> Any:
        return flexact.elastic(model, beams=1).scatter(*sd, samples=10, workers=1, **more)

    with pytest.raises(flexact.ElasticError, match="ESTIFF"):
        ask(without("ESTIFF", "STRENGTH"), "20um")
    bare = without("STRENGTH", "BEAMPROPS", "CROSS", "VISUALIZATION")
    with pytest.raises(flexact.ElasticError, match="CROSSDIM"):
        ask(bare, "0m", "0rad", "5um")
    with pytest.raises(flexact.ElasticError, match="CROSSDIM"):
        ask(bare, "20um", limits={"stress": 1e6})
    made = ask(bare, "20um")
    assert [each.name for each in made.answers][:2] == ["frequency", "parasitic"]
    assert any("no section is known" in note for note in made.notes)
    with pytest.raises(flexact.ElasticError, match="STRENGTH 1"):
        ask(without("STRENGTH"), "20um", limits={"strength": 0.5})
    made = ask(without("STRENGTH"), "20um")
    assert made.answers[0].name == "stress" and not made.kept
    with pytest.raises(flexact.ElasticError, match="mass"):
        ask(without("EM", "XM"), "20um", limits={"frequency": 10.0})
    made = ask(without("EM", "XM"), "20um")
    assert "frequency" not in [each.name for each in made.answers]
    with pytest.raises(flexact.ElasticError, match="section"):
        flexact.elastic(NOTCHES).scatter(thickness="5um", samples=10)
    with pytest.raises(flexact.ElasticError, match="over-constrained"):
        flexact.elastic(DECK, held="rigid").scatter("20um", samples=10)


# The command


def run(*words: object) -> int:
    return main(["cost", str(DECK), "--beams", "1", "-j", "1", *map(str, words)])


SPREAD = ("--scatter", "20um,0.1mrad,thickness=5um", "--samples", "30")


def test_the_command_says_shows_and_writes_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    files = [tmp_path / f"scatter{suffix}" for suffix in (".csv", ".json", ".png", ".jsonl")]
    given = [word for file in files for word in ("-o", file)]
    assert run(*SPREAD, "--limit", "stress=6MPa", "--limit", "strength=1%", *given) == 0
    said = capsys.readouterr().out
    assert said.splitlines()[1].startswith("Of 30 samples")
    assert all(len(row) <= 80 for row in said.splitlines() if "written" not in row)
    table = list(csv.DictReader(io.StringIO(files[0].read_text())))
    assert len(table) == 30 and table[0]["part"] in ("left sheet", "right sheet")
    assert files[2].read_bytes().startswith(b"\x89PNG")
    assert len(files[3].read_text().splitlines()) == 30
    assert not list(tmp_path.glob("*.journal"))
    made = json.loads(files[1].read_text())
    assert not [each.message for each in VALID.iter_errors(made)]
    stress = np.array([float(row["stress"]) for row in table])
    assert made["scatter"]["limits"][0]["kept"]["number"] == int((stress <= 6e6).sum())
    assert run(*SPREAD, "--json", "--limit", "rz=0.2mrad", "--stroke", "13:x=+-1mm") == 0
    made = json.loads(capsys.readouterr().out)
    assert not [each.message for each in VALID.iter_errors(made)]
    assert made["scatter"]["quantities"][0]["designed"] > 0.0


def test_an_interrupted_table_is_not_begun_anew_unasked(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    table = tmp_path / "scatter.csv"
    journal = tmp_path / "scatter.csv.journal"
    journal.write_text("")
    assert run(*SPREAD, "-o", table) == 2
    assert "--resume" in capsys.readouterr().err
    journal.unlink()
    assert run(*SPREAD, "-o", table, "--resume") == 0
    assert table.exists() and not journal.exists()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--samples", "3"), "--scatter"),
        (("--scatter", "20um", "--release", "1:2"), "--release does not go with --scatter"),
        (("--scatter", "20um,30um"), "20um,0.1mrad,thickness=5um"),
        (("--scatter", "20 apples"), "20um,0.1mrad,thickness=5um"),
        (("--scatter", "20um", "--limit", "stress"), "NAME=VALUE"),
        (("--scatter", "20um", "--resume"), "-o"),
        (("--scatter", "20um", "-o", "x.html"), "--scatter"),
    ],
)
def test_options_that_do_not_fit_are_refused(
    words: tuple[str, ...], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(*words) == 2
    heard = capsys.readouterr()
    assert said in heard.err and not heard.out
