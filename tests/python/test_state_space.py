# SPDX-License-Identifier: BSD-3-Clause
"""Linear systems of states against the direct solution, closed forms and their own matrices.

The matrices of the direct solution are those of textbooks (Przemieniecki, Theory of Matrix
Structural Analysis, 1968, sections 5.6 and 11.3), assembled here. Along a beam the mass is that of
the cubic that also its deflection follows, as the core has it (theory.md).
"""

from __future__ import annotations

import io
import json
import math
import re
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest
from json_schema import schema, strict
from random_elastic import Draw
from stiffness_decks import cantilever, cross_hinge, guide

import flexact
from flexact.apps.cli.main import main
from flexact.elasticity import ElasticError, UnknownError

#: A steel strip 100 x 10 x 1 mm, with a mass at its end [m, N, kg].
LENGTH, EA, EI, LINE, TIP = 0.1, 2.1e6, 0.175, 0.078, 0.05
PIECES = 4
END, MIDDLE = 2 * PIECES + 1, PIECES + 1
HERTZ = np.geomspace(1.0, 1e5, 200)
ZETA = 0.01
VALID = jsonschema.Draft202012Validator(strict(schema("transfer")))


def strip(units: str = "m", more: str = "") -> str:
    """The strip as planar beams along x, clamped at node 1."""
    mm, mass = (1e3, f"XM {END} {TIP}") if units == "mm" else (1.0, f"XM {END} {TIP}")
    beams = range(1, PIECES + 1)
    lines = [f"PLBEAM {e} {2 * e - 1} {2 * e} {2 * e + 1} {2 * e + 2}" for e in beams]
    lines += [f"X {2 * k + 1} {k * LENGTH / PIECES * mm} 0" for k in range(PIECES + 1)]
    lines += [f"DYNE {e} 1 2 3" for e in beams] + ["FIX 1", "FIX 2", "END", "HALT"]
    lines += [f"ESTIFF {e} {EA} {EI * mm**2}\nEM {e} {LINE / mm}" for e in beams]
    head = [] if units == "m" else [f"UNITS {units}"]
    return "\n".join([*head, *lines, mass, more, "END\nEND\n"])


def textbook() -> tuple[Any, Any]:
    """K and M of the strip, x y rz of each node in turn, the clamp too."""
    a = LENGTH / PIECES
    bending = np.array(
        [
            [12, 6 * a, -12, 6 * a],
            [6 * a, 4 * a**2, -6 * a, 2 * a**2],
            [-12, -6 * a, 12, -6 * a],
            [6 * a, 2 * a**2, -6 * a, 4 * a**2],
        ]
    )
    heavy = np.array(
        [
            [156, 22 * a, 54, -13 * a],
            [22 * a, 4 * a**2, 13 * a, -3 * a**2],
            [54, 13 * a, 156, -22 * a],
            [-13 * a, -3 * a**2, -22 * a, 4 * a**2],
        ]
    )
    size = 3 * (PIECES + 1)
    k, m = np.zeros((size, size)), np.zeros((size, size))
    for e in range(PIECES):
        across = np.array([1, 2, 4, 5]) + 3 * e
        along = np.array([0, 3]) + 3 * e
        k[np.ix_(across, across)] += EI / a**3 * bending
        k[np.ix_(along, along)] += EA / a * np.array([[1, -1], [-1, 1]])
        m[np.ix_(across, across)] += LINE * a / 420 * heavy
        m[np.ix_(along, along)] += LINE * a / 420 * np.array([[156, 54], [54, 156]])
    m[[-3, -2], [-3, -2]] += TIP
    return k, m


def damped(k: Any, m: Any, ratios: Any) -> Any:
    """C = M V 2 zeta omega V'M, of modes with V'M V = 1, by the symmetric root of M."""
    values, vectors = np.linalg.eigh(m)
    root = vectors / np.sqrt(values)
    squares, turned = np.linalg.eigh(root.T @ k @ root)
    modes = root @ turned
    return m @ modes @ np.diag(2.0 * np.asarray(ratios) * np.sqrt(squares)) @ modes.T @ m


def of_matrices(system: Any, hertz: Any) -> Any:
    """The response from A, B, C and D, as any other program computes it."""
    unit = np.eye(system.A.shape[0])
    return np.array(
        [
            system.C @ np.linalg.solve(2j * math.pi * f * unit - system.A, system.B) + system.D
            for f in hertz
        ]
    )


@pytest.fixture(scope="module")
def model() -> Any:
    return flexact.elastic(flexact.read_text(strip()), beams=1)


K, M = textbook()
ENDS = [(END, "y"), (MIDDLE, "y"), (END + 1, "rz"), ((END, "y"), (MIDDLE, "y"))]


@pytest.mark.parametrize("ratios", [ZETA, np.linspace(0.002, 0.2, 3 * PIECES)])
def test_response_of_all_modes_is_the_direct_solution(model: Any, ratios: Any) -> None:
    """(K - w2 M + i w C)^-1 at 200 frequencies, to 1e-9 of each value."""
    k, m = K[3:, 3:], M[3:, 3:]
    c = damped(k, m, np.broadcast_to(ratios, 3 * PIECES))
    seen = np.zeros((4, 3 * PIECES))
    seen[0, -2] = seen[1, 3 * (PIECES // 2) - 2] = seen[2, -1] = 1.0
    seen[3] = seen[0] - seen[1]
    acting = np.stack((seen[0], seen[2]), axis=1)
    direct = np.array(
        [seen @ np.linalg.solve(k - w * w * m + 1j * w * c, acting) for w in 2 * math.pi * HERTZ]
    )
    system = model.state_space([(END, "y"), (END + 1, "rz")], ENDS, damping=ratios)
    assert np.abs(system.response(HERTZ) / direct - 1).max() < 1e-9
    assert np.abs(of_matrices(system, HERTZ) / direct - 1).max() < 1e-9
    poles = np.sort_complex(np.linalg.eigvals(system.A))
    assert np.abs(np.sort_complex(system.poles) / poles - 1).max() < 1e-9


def test_base_motion_is_the_direct_solution(model: Any) -> None:
    """x = T u + relative, (K - w2 M + i w C) relative = w2 M T u, of y and rz of the clamp."""
    k, m = K[3:, 3:], M[3:, 3:]
    c = damped(k, m, np.full(3 * PIECES, ZETA))
    moved = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    follow = np.vstack((moved, -np.linalg.solve(k, K[3:, :3] @ moved)))
    direct = []
    for w in 2 * math.pi * HERTZ:
        x = follow.astype(complex)
        x[3:] += np.linalg.solve(k - w * w * m + 1j * w * c, w * w * (M[3:] @ follow))
        direct.append(np.stack((x[-2], x[-2] - x[1])))
    system = model.state_space(
        [(1, "y", "motion"), "2:rz motion"], [(END, "y"), ((END, "y"), (1, "y"))]
    )
    assert np.abs(system.response(HERTZ) / np.array(direct) - 1).max() < 1e-8
    assert np.abs(of_matrices(system, HERTZ) / np.array(direct) - 1).max() < 1e-8
    # Slowly all goes with the floor, and a turn moves the end by its arm.
    assert system.static_gain == pytest.approx(np.array([[1.0, LENGTH], [0.0, LENGTH]]), abs=1e-12)
    assert system.response(1e-3)[:, 0] == pytest.approx([1.0, 0.0], abs=1e-8)
    assert system.pair(1, 0).zeros[:2] == pytest.approx([0.0, 0.0])
    # The clamp is at the origin, about which the ground turns.
    ground = model.state_space(["ground:y motion", "ground:rz motion"], (END, "y"))
    assert ground.response(HERTZ)[:, 0] == pytest.approx(system.response(HERTZ)[:, 0], rel=1e-9)


def test_velocity_is_the_derivative(model: Any) -> None:
    both = model.state_space((END, "y"), [(MIDDLE, "y"), f"{MIDDLE}:y velocity"])
    place, rate = (both.response(HERTZ)[:, k, 0] for k in (0, 1))
    assert np.abs(rate / (2j * math.pi * HERTZ * place) - 1).max() < 1e-12
    assert np.abs(of_matrices(both, HERTZ)[:, 1, 0] / rate - 1).max() < 1e-9
    assert both.pair(1).zeros[0] == 0.0 and both.static_gain[1, 0] == 0.0
    with pytest.raises(ElasticError, match="no proper system"):
        model.state_space((1, "y", "motion"), (END, "y", "velocity"))


@pytest.mark.parametrize("modes", [1, 2, 5])
@pytest.mark.parametrize("source", [(END, "y"), (1, "y", "motion")])
def test_few_modes_are_within_the_bound(model: Any, source: Any, modes: int) -> None:
    """And the static gain is exact; of a tip force L^3/3EI."""
    whole = model.state_space(source, ENDS)
    few = model.state_space(source, ENDS, modes=modes)
    assert few.static_gain == pytest.approx(whole.static_gain, rel=1e-12)
    off = np.abs(few.response(HERTZ) - whole.response(HERTZ))
    bound = few.error_bound(HERTZ)
    scale = np.abs(whole.response(HERTZ)).max(axis=0)
    assert np.all(off <= bound * (1 + 1e-6) + 1e-14 * scale)
    # It is no idle bound, and it is small below the first mode that is left out.
    assert np.any(off > 0.5 * bound)
    low = few.error_bound(whole.frequencies[modes] / 10)[0, 0] / np.abs(few.static_gain[0, 0])
    assert low < 0.011
    if source == (END, "y"):
        assert few.static_gain[0, 0] == pytest.approx(LENGTH**3 / (3 * EI), rel=1e-12)


def test_frequencies_of_a_cantilever() -> None:
    """Roots of cos b cosh b = -1 (Blevins, Formulas for Natural Frequency, 1979, table 8-1)."""
    text = strip().replace(f"XM {END} {TIP}\n", "")
    system = flexact.elastic(flexact.read_text(text), beams=32).state_space((END, "y"), (END, "y"))
    acting = system.frequencies[system.acting[0, 0]]
    wanted = [
        root**2 / (2 * math.pi * LENGTH**2) * math.sqrt(EI / LINE)
        for root in (1.87510407, 4.69409113, 7.85475744)
    ]
    assert acting[:3] == pytest.approx(wanted, rel=1e-5)
    # The zeros at the tip are frequencies with the tip held: cos b sinh b = sin b cosh b.
    zeros = np.abs(system.zeros[system.zeros.imag > 0])
    held = [root**2 / LENGTH**2 * math.sqrt(EI / LINE) for root in (3.92660231, 7.06858275)]
    assert zeros[:2] == pytest.approx(held, rel=1e-4)


BARS = """PLTRUSS 1 1 2
PLTRUSS 2 2 3
X 1 0 0
X 2 1 0
X 3 2 0
FIX 1
FIX 2 2
FIX 3 2
{held}END
HALT
ESTIFF 1 400
ESTIFF 2 100
XM 2 2
XM 3 0.5
END
END
"""


def test_two_masses() -> None:
    """Two masses on two springs: G11 = (k2 - m2 w2)/det, G21 = k2/det; zero at sqrt(k2/m2)."""
    elastic = flexact.elastic(flexact.read_text(BARS.format(held="RLSE 1 1\nRLSE 2 1\n")))
    system = elastic.state_space((2, "x"), [(2, "x"), (3, "x")], damping=0.0)
    hertz = np.array([0.0, 0.7, 1.9, 4.0])
    w = 2 * math.pi * hertz
    det = (400 + 100 - 2 * w**2) * (100 - 0.5 * w**2) - 100**2
    found = system.response(hertz)[:, :, 0]
    assert found[:, 0] == pytest.approx((100 - 0.5 * w**2) / det, rel=1e-12)
    assert found[:, 1] == pytest.approx(100 / det, rel=1e-12)
    assert np.abs(system.pair(0).zeros.imag) == pytest.approx([math.sqrt(200)] * 2, rel=1e-12)
    assert system.pair(1).zeros.size == 0
    squares = np.sort(system.poles.imag**2)[::2]
    wanted = np.linalg.eigvals(np.array([[250.0, -50.0], [-200.0, 200.0]]))
    assert squares == pytest.approx(np.sort(wanted), rel=1e-12)
    with pytest.raises(ElasticError, match=re.escape("pair(output, input).zeros")):
        _ = system.zeros


def test_loose_motion_has_poles_at_zero() -> None:
    """A free mass: 1/(m s2), and infinite at rest; with a spring to it as well."""
    text = (
        BARS.format(held="").replace("ESTIFF 1 400\n", "").replace("FIX 1\n", "FIX 1 2\nXM 1 1\n")
    )
    text = text.replace("XM 1 1\n", "").replace("XM 2 2", "XM 1 1\nXM 2 2")
    elastic = flexact.elastic(
        flexact.read_text(text.replace("FIX 3 2\n", "FIX 3 2\nRLSE 1 1\nRLSE 2 1\n"))
    )
    system = elastic.state_space((3, "x"), [(3, "x"), (1, "x")])
    assert np.count_nonzero(system.poles == 0.0) == 4
    assert system.static_gain[0, 0] == np.inf and system.static_gain[1, 0] == 0.0
    w = 2 * math.pi * 0.2
    det = (100 - 2 * w**2) * (100 - 0.5 * w**2) - 100**2
    undamped = elastic.state_space((3, "x"), (3, "x"), damping=0.0)
    assert undamped.response(0.2)[0, 0] == pytest.approx((100 - 2 * w**2) / det, rel=1e-9)
    assert np.isinf(system.response(0.0)[0, 0])
    with pytest.raises(ElasticError, match="from 2 to 3"):
        elastic.state_space((3, "x"), (3, "x"), modes=1)


@pytest.mark.parametrize(
    ("text", "point", "name", "value"),
    [
        (cantilever(), 3, "z", 0.0999),
        (guide(), 9, "x", 0.03),
        (cross_hinge(), 2, "ry", 0.3),
    ],
)
@pytest.mark.parametrize("drive", ["free", "locked"])
@pytest.mark.parametrize("beams", [1, 4])
def test_states_along_a_stroke(
    text: str, point: int, name: str, value: float, drive: str, beams: int
) -> None:
    """Frequencies and compliance are those of the sparse solver; the first one has buckled."""
    elastic = flexact.elastic(flexact.read_text(text), drive=drive, beams=beams)
    (state,) = elastic.along(point, name, [value])
    place = {3: "x", 9: "z", 2: "rx"}[point]
    system = state.state_space((point, place), (point, place), damping=0.0)
    lowest = state.frequencies
    assert system.frequencies[: lowest.size] == pytest.approx(lowest, rel=1e-7)
    axis = ["x", "y", "z", "rx", "ry", "rz"].index(place)
    wanted = state.compliance(point)[axis, axis]
    assert system.static_gain[0, 0] == pytest.approx(wanted, rel=1e-6)
    assert (system.poles.real.max() > 0.0) == (not state.is_stable)


@pytest.mark.parametrize("seed", range(12))
def test_random_mechanisms(seed: int) -> None:
    """Rigid parts, hinges, gravity and loads: the same as the sparse solver says."""
    draw = Draw(seed, 0.1)
    if not draw.free:
        return
    for beams in (1, 3):
        elastic = flexact.elastic(flexact.read_text(draw.text), beams=beams)
        state = elastic.equilibrium()
        if state.loose:
            continue
        seen = (draw.point, "xyz"[draw.axis])
        system = state.state_space(seen, seen, modes=min(3, state.frequencies.size))
        assert system.frequencies == pytest.approx(state.frequencies[:3], rel=1e-7)
        wanted = state.compliance(draw.point)[draw.axis, draw.axis]
        assert system.static_gain[0, 0] == pytest.approx(wanted, rel=1e-6)


def test_a_locked_drive_moves_the_stage() -> None:
    """Slowly the stage follows its drive, and the reaction of the motion is none of the outputs."""
    elastic = flexact.elastic(flexact.read_text(guide()), drive="locked", beams=2)
    system = elastic.state_space((9, "x", "motion"), [(9, "x"), (9, "z")])
    assert system.static_gain[:, 0] == pytest.approx([1.0, 0.0], abs=1e-9)
    assert np.abs(system.response(50.0)[0, 0]) == pytest.approx(1.0)


@pytest.mark.parametrize("name", ["x", "y", "z", "rx", "ry", "rz"])
@pytest.mark.parametrize("drive", ["free", "locked"])
def test_with_the_ground_all_goes_as_a_rigid_body(name: str, drive: str) -> None:
    """Slowly; also a rigid stage, and a drive that is locked to the ground."""
    elastic = flexact.elastic(flexact.read_text(guide()), drive=drive, beams=2)
    seen = ["x", "y", "z", "rx", "ry", "rz"]
    system = elastic.state_space(f"ground:{name} motion", [(9, each) for each in seen])
    axis = seen.index(name)
    direction, place = np.eye(3)[axis % 3], np.array([0.025, 0.0, 0.05])
    still = np.zeros(3)
    wanted = (direction, still) if axis < 3 else (np.cross(direction, place), direction)
    assert system.static_gain[:, 0] == pytest.approx(np.concatenate(wanted), abs=1e-9)


def test_millimetres_are_the_same_system() -> None:
    """Gains in mm/N, 1/N and mm/mm; poles and zeros the same."""
    metres, millimetres = (
        flexact.elastic(flexact.read_text(strip(units)), beams=1).state_space(
            [(END, "y"), (END + 1, "rz"), (1, "y", "motion")], [(END, "y"), (END + 1, "rz")]
        )
        for units in ("m", "mm")
    )
    factors = np.array([[1e3, 1.0, 1.0], [1.0, 1e-3, 1e-3]])
    one, other = (each.response(HERTZ) for each in (metres, millimetres))
    assert np.abs(other / (one * factors) - 1).max() < 1e-9
    assert np.abs(of_matrices(millimetres, HERTZ) / other - 1).max() < 1e-9
    assert millimetres.poles == pytest.approx(metres.poles, rel=1e-9)
    assert millimetres.gain_units == (("mm/N", "mm/(N mm)", "1"), ("rad/N", "rad/(N mm)", "rad/mm"))


@pytest.mark.parametrize(
    ("inputs", "outputs", "options", "said"),
    [
        ((99, "y"), (END, "y"), {}, "there is no node 99"),
        ((END, "w"), (END, "y"), {}, "no coordinate 'w'"),
        ((1, "y"), (END, "y"), {}, 'held, and a force there moves nothing.*1, "y", "motion"'),
        ((END, "y", "motion"), (END, "y"), {}, "is not held"),
        (("ground", "z", "motion"), (END, "y"), {}, "nothing is held that moves"),
        (("ground", "up", "motion"), (END, "y"), {}, "nothing is held that moves"),
        (END, (END, "y"), {}, "an input is a force or moment"),
        ((END, "y"), "y", {}, "an output is"),
        ((END, "y"), (END, "y", "motion"), {}, "an output is"),
        ((END, "y", "velocity"), (END, "y"), {}, "an input is"),
        ([], (END, "y"), {}, "an input is"),
        ((END, "y"), [((END, "y"), (END + 1, "rz"))], {}, "a displacement less a rotation"),
        ((END, "y"), (END, "y"), {"damping": [0.1, 0.2]}, "2 damping ratios and 12 modes"),
        ((END, "y"), (END, "y"), {"modes": 1, "damping": [0.1] * 2}, "2 damping ratios and 1 mode"),
        ((END, "y"), (END, "y"), {"damping": -0.1}, "a number from 0"),
        ((END, "y"), (END, "y"), {"damping": math.nan}, "a number from 0"),
        ((END, "y"), (END, "y"), {"damping": "much"}, "a number from 0"),
        ((END, "y"), (END, "y"), {"modes": 13}, "from 1 to 12"),
        ((END, "y"), (END, "y"), {"modes": 2.5}, "whole number"),
        ("ground:rz motion", (END, "y"), {"modes": 0}, "from 1 to 12"),
    ],
)
def test_refusals(model: Any, inputs: Any, outputs: Any, options: Any, said: str) -> None:
    with pytest.raises(ElasticError, match=said):
        model.state_space(inputs, outputs, **options)


def test_refusals_of_models(model: Any) -> None:
    text = re.sub(r"(EM|XM) .*\n", "", strip())
    with pytest.raises(ElasticError, match="nothing has a mass"):
        flexact.elastic(flexact.read_text(text)).state_space((END, "y"), (END, "y"))
    with pytest.raises(ElasticError, match="fewer beams"):
        flexact.elastic(flexact.read_text(strip()), beams=1000).state_space((END, "y"), (END, "y"))
    with pytest.raises(UnknownError):
        model.state_space((END, "z"), (END, "y"))
    with pytest.raises(ElasticError, match="no finite number"):
        model.state_space((END, "y"), (END, "y")).response([1.0, math.inf])
    text = (
        BARS.format(held="RLSE 1 1\nRLSE 2 1\n").replace("FIX 3 2\n", "").replace("XM 3 0.5\n", "")
    )
    with pytest.raises(ElasticError, match="neither stiffness nor mass"):
        flexact.elastic(flexact.read_text(text)).state_space((3, "y"), (2, "x"))


def test_for_others(model: Any, tmp_path: Path) -> None:
    """scipy has the same response, and MATLAB's file the same matrices."""
    signal = pytest.importorskip("scipy.signal")
    loadmat = pytest.importorskip("scipy.io").loadmat
    system = model.state_space((END, "y"), [(END, "y"), (MIDDLE, "y")], modes=3)
    _, found = signal.freqresp(
        signal.StateSpace(system.A, system.B, system.C[:1], system.D[:1]), 2 * math.pi * HERTZ
    )
    assert found == pytest.approx(system.response(HERTZ)[:, 0, 0], rel=1e-9)
    assert np.array_equal(system.to_scipy().A, system.A)
    system.save(tmp_path / "strip.mat")
    first = (tmp_path / "strip.mat").read_bytes()
    system.save(tmp_path / "strip.mat")
    assert (tmp_path / "strip.mat").read_bytes() == first
    content = loadmat(io.BytesIO(first))
    for name in "ABCD":
        assert np.array_equal(content[name], getattr(system, name))
    assert [str(each[0]) for each in content["outputs"].ravel()] == [f"{END}:y", f"{MIDDLE}:y"]


def test_files(model: Any, tmp_path: Path) -> None:
    system = model.state_space([(END, "y"), (1, "y", "motion")], [(END, "y"), "10:rz"], modes=4)
    made = json.loads(system.to_json())
    VALID.validate(made)
    assert made["pairs"][0]["static_gain"] == system.static_gain[0, 0]
    loose = flexact.elastic(flexact.read_text(guide()), beams=1)
    VALID.validate(loose.state_space((9, "x"), (9, "z")).to_dict())
    for suffix in ("png", "svg", "pdf", "html", "csv", "json"):
        system.save(tmp_path / f"strip.{suffix}")
        assert (tmp_path / f"strip.{suffix}").stat().st_size > 1000
    page = (tmp_path / "strip.html").read_text("utf-8")
    assert "Poles and zeros" in page and 'class="gain1"' in page
    rows = system.to_csv().splitlines()
    assert rows[1].startswith(f"{END}:y,{END}:y,") and len(rows) > 400
    with pytest.raises(flexact.FlexactError, match="suffix"):
        system.save(tmp_path / "strip.xyz")


def test_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    deck = tmp_path / "strip.dat"
    deck.write_text(strip())
    words = ["transfer", str(deck), "--beams", "1", "--to", f"{END}:y"]
    assert main([*words, "--from", f"{END}:y", "--damping", "2%"]) == 0
    said = capsys.readouterr().out
    assert "0.001905 m/N at rest" in said.replace("\n", " ") and "16.016 Hz      2 %" in said
    assert main([*words, "--from", f"{END}:y", "--modes", "2", "--damping", "1%,2%", "--json"]) == 0
    made = json.loads(capsys.readouterr().out)
    VALID.validate(made)
    assert made["damping"] == [0.01, 0.02]
    for more, told in (
        ([], "from what to what"),
        (["--from", "1:y"], "moves nothing"),
        (["--from", "nobody:y"], "no point named"),
        (["--from", f"{END}:y", "--stroke", "here"], "POINT:COORDINATE=VALUE"),
    ):
        assert main([*words, *more]) in (1, 2)
        assert told in capsys.readouterr().err
