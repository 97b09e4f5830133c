# SPDX-License-Identifier: BSD-3-Clause
"""Where mechanisms rest under their loads, in the verdict's words, against closed forms."""

import json
import math
import re
from pathlib import Path

import pytest

import flexact
from flexact.apps.cli.main import main
from flexact.costs.at_rest import at_rest, at_rest_in_words

E, G = 210e9, 81e9
LENGTH, WIDTH, THICK = 0.1, 0.02, 0.5e-3
SECOND = WIDTH * THICK**3 / 12.0


def cantilever(**load: float) -> flexact.Model:
    """A sheet from the ground along x that carries a body, with a force there."""
    model = flexact.Model()
    steel = flexact.Material("steel", E, G, strength=1.0e9)
    model.sheet((0, 0, 0), (LENGTH, 0, 0), "y", name="sheet 1", thickness=THICK, breadth=WIDTH,
                material=steel)  # fmt: skip
    model.body([(LENGTH, 0, 0), (1.5 * LENGTH, 0, 0)], name="tip")
    model.fix((0, 0, 0))
    model.force((LENGTH, 0, 0), load.get("x", 0.0), load.get("y", 0.0), load.get("z", 0.0))
    return model


def test_a_cantilever_sags_and_is_stressed_as_beam_theory_says() -> None:
    """F L^3/3EI at the tip and 6 F L/b t^2 at the clamp; half a length on it turns F L^2/2EI."""
    force = 1.0e-3
    rest = at_rest(flexact.analyse(cantilever(z=force)))
    assert rest is not None and rest.loads == "its loads" and rest.is_stable
    tip = force * LENGTH**3 / (3.0 * E * SECOND)
    far = tip + force * LENGTH**2 / (2.0 * E * SECOND) * 0.5 * LENGTH
    assert rest.what == "the tip"
    # Shear, and that it is deep in its width, is less than a thousandth.
    assert rest.sag[2] == pytest.approx(far, rel=1e-3)
    stress = 6.0 * force * LENGTH / (WIDTH * THICK**2)
    assert rest.stress == pytest.approx(stress, rel=1e-3)
    assert rest.share == pytest.approx(stress / 1.0e9, rel=1e-3)
    words = at_rest_in_words(flexact.analyse(cantilever(z=force)))
    assert words.startswith("Under its loads: the tip moves by ")
    assert "along z; the largest stress is 120 kPa in sheet 1 (0.012 % of the strength)" in words


def test_a_column_buckles_at_euler_s_load() -> None:
    """pi^2 EI/4L^2 of a clamped column with a free end that carries its load at its end."""
    force = math.pi**2 * E * SECOND / (4.0 * LENGTH**2) / 4.0
    rest = at_rest(flexact.analyse(cantilever(x=-force)))
    assert rest is not None and rest.is_stable
    assert rest.buckles == pytest.approx(4.0, rel=1e-3)
    assert "it buckles at 4 times the stress of these loads" in at_rest_in_words(
        flexact.analyse(cantilever(x=-force))
    )


def truss(down: float) -> flexact.Model:
    """Two bars at 45 degrees from the ground to a point, and a third that nothing loads."""
    model = flexact.Model(planar=True)
    steel = flexact.Material("steel", E, G)
    sizes = {"thickness": 2e-3, "material": steel}
    model.truss((0.0, 0.0), (0.1, 0.1), "left bar", **sizes)
    model.truss((0.2, 0.0), (0.1, 0.1), "right bar", **sizes)
    model.truss((0.3, 0.0), (0.3, 0.1), "third bar", **sizes)
    model.truss((0.4, 0.0), (0.3, 0.1), "fourth bar", **sizes)
    model.fix((0.0, 0.0), (0.2, 0.0), (0.3, 0.0), (0.4, 0.0))
    model.force((0.1, 0.1), 0.0, -down)
    return model


@pytest.mark.parametrize(("down", "word"), [(10.0, "compression"), (-10.0, "tension")])
def test_bars_that_are_pulled_and_pushed_are_named(down: float, word: str) -> None:
    """Each of two bars at 45 degrees carries F/sqrt 2."""
    rest = at_rest(flexact.analyse(truss(down)))
    assert rest is not None
    names, force = rest.pushed if down > 0.0 else rest.pulled
    assert names == ("the left bar", "the right bar")
    assert force == pytest.approx(10.0 / math.sqrt(2.0), rel=1e-4)
    assert rest.slack == ("the third bar", "the fourth bar")
    words = at_rest_in_words(flexact.analyse(truss(down)))
    assert f"the left bar and the right bar are in {word} (up to 7.07 N)" in words


def test_it_is_said_where_nothing_is_known_or_nothing_holds() -> None:
    assert at_rest(flexact.analyse(cantilever())) is None
    loose = cantilever(z=1.0)
    loose.clear((0, 0, 0))
    assert "does not come to rest" in at_rest_in_words(flexact.analyse(loose))
    # A load far beyond what it bears.
    assert at_rest_in_words(flexact.analyse(cantilever(x=-1.0e4))).endswith("it has buckled.")


def test_any_attitude_is_one_option(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A mass m at the end of a sheet sags by m g L^3/3EI, or stretches it by m g L/EA."""
    model = cantilever()
    tip = model.point((LENGTH, 0, 0))
    model.body([tip, (1.5 * LENGTH, 0, 0)], mass=0.01)
    deck = tmp_path / "tip.dat"
    deck.write_text(model.to_deck())
    found = {}
    for falls in ("-z", "x", "0,0,-9.80665"):
        assert main(["analyse", str(deck), f"--gravity={falls}", "--json"]) in (0, 1)
        found[falls] = json.loads(capsys.readouterr().out)["at_rest"]
    weight = 0.01 * 9.80665
    assert found["-z"] == found["0,0,-9.80665"]
    bent = weight * LENGTH**3 / (3.0 * E * SECOND)
    turned = weight * LENGTH**2 / (2.0 * E * SECOND)
    way = found["-z"]["moves"]["value"][2]
    # It turns by more than a fifth: the chord is shorter than the line.
    assert way == pytest.approx(-(bent + 0.5 * LENGTH * turned), rel=0.05)
    stretched = weight * LENGTH / (E * WIDTH * THICK)
    assert found["x"]["moves"]["value"][0] == pytest.approx(stretched, rel=1e-3)
    assert main(["analyse", str(deck), "--gravity=down"]) == 2
    assert re.search(r"such as -z, or accelerations along", capsys.readouterr().err)
