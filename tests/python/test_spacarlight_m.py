# SPDX-License-Identifier: BSD-3-Clause
"""`spacarlight.m` in Octave: scripts of all public forms, their results, and what is refused."""

from __future__ import annotations

import math
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import flexact
from flexact.apps.cli.main import main

pytestmark = pytest.mark.dear(4)

PACKAGE = Path(flexact.__file__).parent
DOCS = Path(__file__).parents[2] / "docs"
OCTAVE = shutil.which("octave-cli")
_NEXT = "-- next --"
#: A cantilever of two beams along x, clamped at node 1, with a point mass at its end.
E, G, L, B, T, MASS = 210e9, 80e9, 0.1, 0.02, 0.001, 0.5
EI = E * B * T**3 / 12
BEAM = f"""
nodes = [0 0 0; {L} 0 0];
elements = [1 2];
nprops(1).fix = true;
nprops(2).mass = {MASS};
eprops(1).elems = 1;
eprops(1).emod = {E};
eprops(1).smod = {G};
eprops(1).dens = 1e-3;
eprops(1).cshape = 'rect';
eprops(1).dim = [{B} {T}];
eprops(1).orien = [0 1 0];
eprops(1).nbeams = 2;
eprops(1).flex = 1:6;
opt.silent = true;
"""
CALL = "out = spacarlight(nodes, elements, nprops, eprops, opt);\n"


def octave(folder: Path, *scripts: str) -> list[str]:
    """What scripts say in one Octave, one after another; an error as "error: ..."."""
    if OCTAVE is None:
        pytest.skip("needs octave (Debian: octave)")
    asked = [f"addpath('{PACKAGE / 'matlab'}');"]
    for k, script in enumerate(scripts, start=1):
        (folder / f"script{k}.m").write_text(script, encoding="utf-8")
        asked.append(
            f"disp('{_NEXT}'); clear variables; try; source('script{k}.m'); "
            "catch e; disp(['error: ' e.message]); end"
        )
    environment = {
        **{key: value for key, value in os.environ.items() if key not in ("DISPLAY", "BROWSER")},
        "FLEXACT": f"{sys.executable} -m flexact",
        "PYTHONPATH": os.pathsep.join(filter(None, (str(PACKAGE.parent), *sys.path))),
    }
    done = subprocess.run(
        [OCTAVE, "--no-gui", "--norc", "-q", "--eval", "\n".join(asked)],
        cwd=folder,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
        timeout=600,
    )
    # What Octave 7 says of its own exit.
    said = re.sub(r"error: ignoring const .*\n", "", done.stdout).split(_NEXT)
    assert len(said) == len(scripts) + 1, done.stdout
    return said[1:]


def numbers(said: str) -> list[float]:
    return [float(each) for each in said.split("numbers:")[1].split()[:40] if _is_number(each)]


def _is_number(text: str) -> bool:
    return re.fullmatch(r"[-+]?[\d.]+(e[-+]?\d+)?", text) is not None


def shown(*what: str) -> str:
    return "disp('numbers:');\n" + "".join(f"printf('%.15g ', {each});\n" for each in what)


def test_a_cantilever_is_that_of_the_textbook(tmp_path: Path) -> None:
    """Gere and Timoshenko, Mechanics of Materials, app. G: an end moment turns it by M L/(E I), and
    bends it into an arc; sigma is M t/(2 I); f^2 is 3 E I/(m L^3) without the mass of the beam, in
    shear by Cowper. The compliances are L^3/(3 E I), L^2/(2 E I) and L/(E I)."""
    moment = 0.05
    script = f"{BEAM}nprops(2).moment = [0 {-moment} 0]; opt.loadsteps = 3;\n{CALL}" + shown(
        *("numel(out.step)", "out.step(3).node(2).r_axang(1)", "out.step(3).node(2).p"),
        *("out.step(3).stressmax", "out.step(1).freq(1)", "out.step(1).node(2).CMglob(3, 3)"),
        *("out.step(1).node(2).CMglob(3, 5)", "out.step(1).node(2).CMglob(5, 5)"),
        *("out.step(3).node(1).Mreac", "out.step(2).node(2).r_axang(1)", "out.ndof"),
        *("size(out.node(2).CMglob)", "out.element(1).L0", "out.step(3).node(2).r_eulzyx(2)"),
    )
    (said,) = octave(tmp_path, script)
    assert "error: " not in said, said
    steps, angle, *rest = numbers(said)
    place, (stress, first, c33, c35, c55), rest = rest[:3], rest[3:8], rest[8:]
    turned = moment * L / EI
    assert (steps, angle) == (3, pytest.approx(turned, rel=1e-4))
    arc = (L * math.sin(turned) / turned, 0, L * (1 - math.cos(turned)) / turned)
    assert place == pytest.approx(arc, rel=2e-3, abs=1e-9)
    assert stress == pytest.approx(moment * T / 2 / (B * T**3 / 12), rel=1e-3)
    shear = 12 * EI * (12 + 11 * (E / 2 / G - 1)) / (10 * E / 2 / G) / (G * B * T * L**2)
    assert first == pytest.approx(
        math.sqrt(3 * EI / (MASS * L**3) / (1 + shear / 4)) / 2 / math.pi, rel=1e-4
    )
    assert (c33, abs(c35), c55) == pytest.approx(
        (L**3 / 3 / EI * (1 + shear / 4), L**2 / 2 / EI, L / EI), rel=1e-6
    )
    assert rest[:3] == pytest.approx([0, moment, 0], rel=1e-6, abs=1e-9)
    assert rest[3:] == pytest.approx([turned / 2, 12, 6, 6, 3, L / 2, L / 2, -turned], rel=1e-4)


def test_a_stroke_has_its_steps_and_its_reaction(tmp_path: Path) -> None:
    """3 E I/L^3 for a small stroke, from -1 um in ten steps to 2 um; the Euler load
    pi^2 E I/(4 L^2) of a pressed one; and a locked coordinate has no compliance."""
    script = (
        f"{BEAM}nprops(2).displ_initial_z = -1e-6; nprops(2).displ_z = 3e-6;\n{CALL}"
        + shown("numel(out.step)", "out.node(2).p(3, :)", "out.step(10).node(2).Freac(3)")
        + shown("out.step(10).node(2).CMglob(3, 3)", "out.step(1).node(1).Freac(3)")
        + "nprops(2).displ_initial_z = []; nprops(2).displ_z = [];\n"
        + "nprops(2).force_initial = [-1 0 0]; opt.calcbuck = true; eprops(1).nbeams = 8;\n"
        + CALL
        + shown("numel(out.step)", "out.step.buck(1)", "size(out.stressmax)")
    )
    (said,) = octave(tmp_path, script)
    assert "error: " not in said, said
    made = [numbers(f"numbers:{part}") for part in said.split("numbers:")[1:]]
    steps, *path, force = made[0]
    assert steps == 10 and path == pytest.approx(np.linspace(-1e-6, 2e-6, 10), abs=1e-12)
    stiffness = 3 * EI / L**3
    assert force == pytest.approx(2e-6 * stiffness, rel=2e-3)
    assert made[1] == pytest.approx([0, 1e-6 * stiffness], rel=2e-3, abs=1e-15)
    assert made[2] == pytest.approx([1, math.pi**2 * EI / 4 / L**2, 1, 1], rel=2e-3)


def test_a_state_space_has_poles_of_the_first_frequency(tmp_path: Path) -> None:
    """s^2 + 2 zeta omega s + omega^2 of each mode; a force on the point mass gives 1/k at rest."""
    script = (
        f"{BEAM}nprops(2).transfer_in = 'force_z';\n"
        "nprops(2).transfer_out = {'displ_z', 'veloc_z'};\n"
        f"opt.transfer = {{true 0.02}};\n{CALL}"
        "s = out.statespace;\n"
        + shown("size(s.A, 1)", "size(s.B)", "size(s.C)", "size(s.D)", "out.step.freq(1)")
        + "p = sort(eig(s.A)); [~, k] = min(abs(p));\n"
        + shown("abs(p(k))", "-real(p(k)) / abs(p(k))", "(s.D - s.C * (s.A \\ s.B))(1)")
        + "disp(strjoin([s.InputName s.OutputName], ', '))\n"
    )
    (said,) = octave(tmp_path, script)
    assert "error: " not in said, said
    (order, *sizes, first), (pole, damping, static) = (
        numbers(f"numbers:{part}") for part in said.split("numbers:")[1:]
    )
    assert sizes == [order, 1, 2, order, 2, 1]
    assert (pole, damping) == pytest.approx((2 * math.pi * first, 0.02), rel=1e-6)
    assert static == pytest.approx(L**3 / 3 / EI, rel=2e-3)
    assert "force-z n2, displ-z n2, veloc-z n2" in said


CALLS = (
    "spacarlight(nodes, elements, nprops, eprops)",
    "spacarlight(nodes, elements, nprops, eprops, opt)",
    "spacarlight(nodes, elements, nprops, eprops, rls)",
    "spacarlight(nodes, elements, nprops, eprops, [])",
    "spacarlight(nodes, elements, nprops, eprops, rls, opt)",
    "spacarlight(struct('coordinates', nodes, 'connect', elements, 'nprops', nprops, "
    "'eprops', eprops, 'opt', opt))",
)


def test_all_forms_of_the_call_give_the_verdict(tmp_path: Path) -> None:
    scripts = [
        f"{BEAM}rls(1).def = []; opt.silent = false; opt.filename = 'own{k}';\n{call};\n"
        for k, call in enumerate(CALLS)
    ]
    for k, said in enumerate(octave(tmp_path, *scripts)):
        assert "error: " not in said, said
        assert "eprops(1), element 1: 20 by 1 mm is a sheet: out-of-plane bending" in said
        assert "Under-constrained by 3: three motions" in said
        stem = f"own{k}" if "opt" in CALLS[k] else "spacar_file"
        assert (tmp_path / f"{stem}.flexact.html").stat().st_size > 10_000
        deck = flexact.read(tmp_path / f"{stem}.flexact.dat")
        assert deck.element_names[0] == "sheet 1, part 1 of 2"


def test_a_loop_and_a_guide_of_old_names_run_silently(tmp_path: Path) -> None:
    """Twice as thick is eight times as stiff; `x` and `rx_axang` are of versions before 0.7."""
    script = (
        BEAM.replace("cshape = 'rect'", "type = 'leafspring'")
        + "opt.filename = 'results'; nprops(2).force_initial = [0 0 0.01]; rls = [];\n"
        + f"for t = [{T} {2 * T}]\n eprops(1).dim = [{B} t];\n"
        + " out = spacarlight(nodes, elements, nprops, eprops, rls, opt);\n"
        + " printf('%.15g ', out.step(1).node(2).x(3), out.step.node(2).rx_axang(1));\nend\n"
    )
    (said,) = octave(tmp_path, script)
    assert "error: " not in said, said
    thin, turned, thick, less = numbers(f"numbers:{said}")
    assert thin == pytest.approx(0.01 * L**3 / 3 / EI, rel=2e-3)
    assert (thin / thick, turned / less) == pytest.approx((8, 8), rel=3e-3)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["script1.m"]


REFUSED = (
    (f"{BEAM}nprops(2).fixx = true;\n{CALL}", "nprops(2).fixx: there is no such field"),
    (f"{BEAM}nodes(2, 1) = NaN;\n{CALL}", "nodes(2)[1]: the number is not finite"),
    (f"{BEAM}eprops(1).elems = 7;\n{CALL}", "eprops(1).elems: there is no element 7"),
    (f"{BEAM}opt.customdyn = {{'XM 1 1'}};\n{CALL}", "opt.customdyn: statements for the dyn"),
    (f"{BEAM}opt.mode = 3;\n{CALL}", "opt.mode: only results of mode 10"),
    (f"{BEAM}opt.loadsteps = 'ten';\n{CALL}", "opt.loadsteps: a number from 1 to 100000 is wanted"),
    (f"{BEAM}{CALL}h = out.fighandle;\n", "line 17, reads .fighandle: Flexact shows"),
    (f"{BEAM}{CALL}bode(out.statespace)\n", "reads .statespace: set opt.transfer"),
    (
        f"{BEAM}nprops(2).mass = []; eprops(1).dens = [];\n{CALL}f = out.freq(1);\n",
        "reads .freq: nothing has a mass",
    ),
    (
        f"{BEAM}nprops(2).force = [-300 0.01 0.01]; opt.gravity = [0 0 -9.81];\n{CALL}",
        "no equilibrium was found beyond",
    ),
    (f"{BEAM}eprops(1).emod = @sin;\n{CALL}", "eprops.emod: a function_handle is no value"),
    ("spacarlight();", "No input was provided"),
    ("spacarlight(1, 2, 3, 4, 5, 6, 7);", "maximum of 6 input arguments"),
    (
        f"setenv('FLEXACT', '/none/flexact'); clear functions\n{BEAM}{CALL}",
        "The command flexact is not found (/none/flexact): install it",
    ),
)


def test_what_cannot_be_is_an_error_in_words(tmp_path: Path) -> None:
    every = octave(tmp_path, *(script for script, _ in REFUSED))
    for said, (_, words) in zip(every, REFUSED, strict=True):
        assert words in " ".join(said.split()), said
        assert "error: " in said.strip().splitlines()[-1] or "\nerror: " in said
        assert "Traceback" not in said


def test_incomplete_input_is_no_mechanism_yet(tmp_path: Path) -> None:
    (said,) = octave(tmp_path, f"{BEAM}out = spacarlight(nodes, elements);\n")
    assert "Incomplete input" in said and "error: " not in said


def test_the_script_of_the_page_says_what_the_page_shows(tmp_path: Path) -> None:
    text = (DOCS / "for_spacar_light_users.md").read_text("utf-8")
    (script,) = re.findall(r"```matlab\n(.*?)```", text, re.DOTALL)
    (expected,) = re.findall(r"```text\n(.*?)```", text, re.DOTALL)
    (said,) = octave(tmp_path, script)
    assert "error: " not in said, said
    assert said.split() == expected.split()


def test_the_command_says_where_the_function_is(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["spacarlight", "--path"]) == 0
    assert (Path(capsys.readouterr().out.strip()) / "spacarlight.m").is_file()
    assert main(["spacarlight"]) == 2
    assert "--path" in capsys.readouterr().err


def test_tables_that_are_no_mechanism_are_refused_by_the_command(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    bar = '"nodes": [[0, 0, 0], [0, 0, 0]], "elements": [1, 2], "nprops": {"fix": true}'
    for text, code, words in (
        (f'{{{bar}, "eprops": {{"elems": 1, "type": "truss"}}}}', 1, "TRUSS 1 has zero length"),
        ("{}", 1, "nodes: the table is missing"),
        ("[1]", 1, "an object with nodes"),
        ("{", 1, "this is no JSON"),
    ):
        Path("wrong.json").write_text(text)
        assert main(["spacarlight", "wrong.json", "--page", "wrong.html"]) == code
        assert words in capsys.readouterr().err
    assert main(["spacarlight", "none.json"]) == 2
    assert main(["spacarlight", "deck.dat"]) == 2
    assert not Path("wrong.html").exists()
