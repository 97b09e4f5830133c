# SPDX-License-Identifier: BSD-3-Clause
"""Help, examples that run as they stand, and what is built in."""

from __future__ import annotations

import argparse
import io
import os
import platform
import re
import shlex
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from small_decks import DECKS, write

import flexact
from flexact.apps.cli.command import VERBS, parser_of
from flexact.apps.cli.main import main
from flexact.apps.cli.terminal import ExitCode

pytestmark = pytest.mark.dear(40)

ROOT = Path(__file__).parents[2]
#: They serve until they are stopped, are for shells, or take long: their examples are read alone.
NOT_RUN = {"view", "watch", "lsp", "completion", "bench"}
#: What their examples exit with, where it is not 0.
CODES = {"flexact analyse input_decks/paper/six_folded_sheets.dat --expect exact": 3}


def examples_in(parser: argparse.ArgumentParser) -> list[str]:
    """The words of the shell in the examples of a verb's help."""
    start = "    $ "
    lines = (parser.epilog or "").splitlines()
    return [line.removeprefix(start) for line in lines if line.startswith(start)]


@pytest.mark.parametrize("verb", VERBS)
def test_every_verb_has_examples(verb: str) -> None:
    parser = parser_of(verb)
    examples = examples_in(parser)
    assert examples and parser.description
    assert all(f"flexact {verb}" in words for words in examples)


@pytest.mark.posix
@pytest.mark.parametrize("verb", [verb for verb in VERBS if verb not in NOT_RUN])
def test_examples_run_as_they_stand(
    verb: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "input_decks").symlink_to(ROOT / "input_decks")
    monkeypatch.chdir(tmp_path)
    for line in examples_in(parser_of(verb)):
        words = shlex.split(line)
        if found := re.search(r"(?:cat|<) (\S+\.dat)", line):
            raw = Path(found[1]).read_bytes()
            monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(raw)))
        words = words[words.index("flexact") + 1 :]
        if "<" in words:
            words = words[: words.index("<")]
        assert main(words) == CODES.get(line, 0), (line, capsys.readouterr().err)
        targets = [words[k + 1] for k, word in enumerate(words) if word == "-o"]
        assert all(Path(target).exists() for target in targets)


@pytest.mark.parametrize("columns", [40, 60, 80, 200])
@pytest.mark.parametrize("verb", ["", *VERBS])
def test_help_fits_the_terminal(
    verb: str, columns: int, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("COLUMNS", str(columns))
    assert main([*([verb] if verb else []), "--help"]) == 0
    lines = capsys.readouterr().out.splitlines()
    # A path, or the form of a value, is a word that cannot be broken.
    wide = [line for line in lines if len(line) > columns and len(line.split()) > 2]
    assert not wide and len(lines) > 5


def test_examples_at_any_width_are_the_same_words(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for columns in (40, 80, 200):
        monkeypatch.setenv("COLUMNS", str(columns))
        main(["help", "batch"])
        text = capsys.readouterr().out.replace("\\\n", " ")
        shown = [shlex.split(line[6:]) for line in text.splitlines() if line.startswith("    $ ")]
        assert shown == [shlex.split(line) for line in examples_in(parser_of("batch"))]


@pytest.mark.parametrize("verb", VERBS)
def test_help_of_a_verb_is_its_help(verb: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["help", verb]) == 0
    said = capsys.readouterr().out
    assert main([verb, "--help"]) == 0
    assert said == capsys.readouterr().out


def test_help_alone_is_that_of_the_command(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["help"]) == 0
    said = capsys.readouterr().out
    assert main(["--help"]) == 0
    assert said == capsys.readouterr().out
    assert all(verb in said for verb in VERBS)
    assert main(["help", "nonsense"]) == 2


def test_the_bare_command_says_how_it_is_used(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([]) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.lower().startswith("usage: flexact")
    assert all(verb in err for verb in VERBS)


def test_an_unknown_option_of_a_verb_is_told_with_its_usage(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["analyse", "x.dat", "--jsn"]) == 2
    err = capsys.readouterr().err
    assert "'--jsn'" in err and "'--json'" in err
    assert "flexact analyse [OPTIONS]" in err and "flexact analyse --help" in err


# The version


@pytest.mark.parametrize("words", [["--version"], ["-V"]])
def test_the_version_alone(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(words) == 0
    assert capsys.readouterr().out == f"flexact {flexact.__version__}\n"


@pytest.mark.parametrize("words", [["--version", "-v"], ["-V", "-v"], ["--version", "--verbose"]])
def test_the_version_with_what_is_built_in(
    words: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(words) == 0
    out = capsys.readouterr().out
    said = dict(
        re.split(r"\s{2,}|(?<=[a-z]) (?=\S+$)", line, maxsplit=1) for line in out.splitlines()
    )
    assert said["flexact"] == flexact.__version__
    assert said["Python"].startswith(platform.python_version())
    assert said["numpy"] == np.__version__
    assert said["sparse method"].startswith("own factorisation")
    assert said["proofs"] == "own arithmetic"
    assert "(GPL-3.0 + GCC exception)" in said["linked with"]
    assert {"matplotlib", "vtk", "pyarrow", "distributed", "pandas", "PyYAML"} <= set(said)
    assert os.sep not in out, "no path of a machine unless it is asked for"


def test_twice_verbose_says_where_things_lie(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--version", "-vv"]) == 0
    out = capsys.readouterr().out
    assert sys.executable in out and str(Path(flexact.__file__).parent) in out


# A pipe that nobody reads to its end


@pytest.mark.posix
def test_a_closed_pipe_ends_quietly(tmp_path: Path) -> None:
    for k in range(30):
        write(tmp_path / f"{k}.dat", DECKS["over"])
    line = f"{sys.executable} -m flexact analyse {tmp_path}; echo $? >&2"
    done = subprocess.run(
        ["bash", "-c", f"({line}) | head -1"], capture_output=True, text=True, check=False
    )
    assert done.stdout == f"{tmp_path}/0.dat\n"
    assert done.stderr == "141\n"


# Zero everywhere


def test_a_quantity_that_is_zero_everywhere_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    # A self-stress of bars has normal forces alone.
    deck, target = write(tmp_path / "bars.dat", DECKS["over"]), tmp_path / "p.svg"
    for name in ("My", "twist-moment"):
        code = main(["picture", str(deck), "--quantity", name, "-o", str(target)])
        assert code == ExitCode.DECK_ERROR
        said = capsys.readouterr().err
        assert f"{name.replace('-', ' ')} is zero everywhere" in said
        assert "normal force is not" in said
        assert not target.exists()
    assert main(["picture", str(deck), "--quantity", "N", "-o", str(target)]) == 0
