# SPDX-License-Identifier: BSD-3-Clause
"""Completion as bash, zsh and fish themselves do it with the scripts of the command."""

from __future__ import annotations

import argparse
import os
import re
import select
import shutil
import subprocess
import time
from pathlib import Path

import pytest

from flexact.apps.cli.command import VERBS, parser_of
from flexact.apps.cli.main import main

#: Words that stand before the cursor, and some of what can stand there; none where nothing can.
ASKED = {
    "flexact ana": ["analyse"],
    "flexact analyse --met": ["--method"],
    "flexact analyse --method j": ["jacobi"],
    "flexact analyse --expect ": ["both", "exact", "over", "under"],
    "flexact check --format ": ["github", "sarif", "text"],
    "flexact analyse --format g": ["github"],
    "flexact analyse dec": ["decks/"],
    "flexact analyse decks/g": ["decks/guide.dat"],
    "flexact report decks/guide.dat -o de": ["decks/"],
    "flexact help pict": ["picture"],
    "flexact completion ": ["bash", "fish", "zsh"],
    "flexact --vers": ["--version"],
    "flexact regress --withi": ["--within"],
    "flexact regress --tolera": [],
}


@pytest.fixture
def place(tmp_path: Path) -> Path:
    (tmp_path / "decks").mkdir()
    for name in ("guide.dat", "gone.txt"):
        (tmp_path / "decks" / name).touch()
    return tmp_path


def script(shell: str, capsys: pytest.CaptureFixture[str], place: Path) -> Path:
    assert main(["completion", shell]) == 0
    path = place / f"flexact.{shell}"
    path.write_text(capsys.readouterr().out)
    return path


def needed(shell: str) -> str:
    found = shutil.which(shell)
    if found is None:
        pytest.skip(f"needs the program {shell}")
    return found


def test_bash_completes(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    lines = [f"source {script('bash', capsys, place)}"]
    for line in ASKED:
        words = " ".join(f"'{word}'" for word in line.split(" "))
        lines += [
            f"COMP_WORDS=({words}); COMP_CWORD=$((${{#COMP_WORDS[@]}}-1)); _flexact",
            'printf "%s\\n" "${COMPREPLY[@]}"; echo ---',
        ]
    done = subprocess.run(
        [needed("bash"), "--norc", "-c", "\n".join(lines)],
        capture_output=True,
        text=True,
        cwd=place,
        check=True,
    )
    made = [sorted(part.split()) for part in done.stdout.split("---\n")][:-1]
    # That it is a folder is said by bash itself, which knows that these are files.
    assert made == [[word.rstrip("/") for word in found] for found in ASKED.values()]


def test_fish_completes(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    lines = [f"source {script('fish', capsys, place)}"]
    for line in ASKED:
        lines += [f"complete -C '{line}'", "echo ---"]
    done = subprocess.run(
        [needed("fish"), "--no-config", "-c", "\n".join(lines)],
        capture_output=True,
        text=True,
        cwd=place,
        check=True,
        env={**os.environ, "HOME": str(place)},
    )
    parts = done.stdout.split("---\n")[:-1]
    for part, (line, found) in zip(parts, ASKED.items(), strict=True):
        made = [told.split("\t")[0] for told in part.splitlines()]
        # Where decks are wanted fish has other files behind them.
        assert made[: len(found)] == found if line.endswith("/g") else sorted(made) == found, line


@pytest.mark.posix
def test_zsh_completes(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    shell = Zsh(needed("zsh"), script("zsh", capsys, place), place)
    try:
        for line, found in ASKED.items():
            if len(found) == 1:
                made = shell.completed(line).removesuffix("=")
                assert made == f"{line.rpartition(' ')[0]} {found[0]}", line
            elif not found:
                assert shell.completed(line) == line
    finally:
        shell.end()


class Zsh:
    """A shell at a terminal, at which a person types and presses the tabulator."""

    def __init__(self, program: str, path: Path, folder: Path) -> None:
        import pty

        child, self.terminal = pty.fork()
        if child == 0:
            os.chdir(folder)
            os.environ.update(HOME=str(folder), TERM="dumb", COLUMNS="200")
            os.execv(program, [program, "-f", "-i"])
        self.child = child
        self.type("unsetopt zle_bracketed_paste beep prompt_sp; PS1='> '; LISTMAX=9999\r")
        # What stands on the line is told by a key of its own.
        self.type(
            "tell() { print -r -- \"<<$BUFFER>>\"; BUFFER= }; zle -N tell; bindkey '^T' tell\r"
        )
        self.type("autoload -Uz compinit && compinit -u -D\r")
        self.type(f"source {path} && echo rea''dy\r")
        self.until("ready")

    def type(self, text: str) -> None:
        os.write(self.terminal, text.encode())

    def completed(self, line: str) -> str:
        self.type(f"{line}\t\x14")
        return re.findall(r"<<(.*?)>>", self.until(">>\r"))[-1].rstrip()

    def until(self, end: str, limit: float = 60.0) -> str:
        said, last = "", time.monotonic() + limit
        while end not in said and time.monotonic() < last:
            if select.select([self.terminal], [], [], 1.0)[0]:
                said += os.read(self.terminal, 65536).decode(errors="replace")
        assert end in said, said
        return said

    def end(self) -> None:
        os.close(self.terminal)
        os.waitpid(self.child, 0)


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_scripts_hold_every_verb_and_option(
    shell: str, capsys: pytest.CaptureFixture[str], place: Path
) -> None:
    text = script(shell, capsys, place).read_text()
    for verb in VERBS:
        assert re.search(rf"\b{verb}\b", text)
        for action in parser_of(verb)._actions:
            for name in action.option_strings if action.help != argparse.SUPPRESS else ():
                long = name.startswith("--")
                of_fish = f"-l {name[2:]}" if long else f"-s {name[1:]}"
                assert (of_fish if shell == "fish" else name) in text
