# SPDX-License-Identifier: BSD-3-Clause
"""Whether an installed wheel does its work; needs the standard library alone.

Usage: bare.py DECKS ANSWERS, in a folder that may be written to. DECKS is input_decks/, ANSWERS
tests/reference/known_answers.json, whose counts come from the literature and by hand.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from pathlib import Path

BIN = Path(sys.executable).parent
#: The least of so many runs is taken.
RUNS = 9


def flexact(*words: str) -> str:
    """What the command says; it must succeed."""
    done = subprocess.run([BIN / "flexact", *words], capture_output=True, text=True)
    assert done.returncode == 0, (words, done.returncode, done.stdout, done.stderr)
    return done.stdout


def check_counts(decks: Path, answers: Path) -> None:
    """Both methods give the counts that are known, certainly or proven."""
    known = json.loads(answers.read_text(encoding="utf-8"))
    for deck in sorted((decks / "paper").glob("*.dat")):
        for method in ("auto", "sparse"):
            said = json.loads(flexact("analyse", str(deck), "--method", method, "--json"))
            for count in ("under_constrained", "over_constrained"):
                assert said[count] == known[f"paper/{deck.name}"][count], (deck, method, said)
            assert said["certainty"] != "doubtful", (deck, method)
            if method == "auto":
                assert said["proof"], deck
            print(f"  {deck.stem}, {method}: {said['verdict']}, {said['certainty']}")


def check_files(decks: Path) -> None:
    """What is drawn and written is there, and is what it is called."""
    deck = str(decks / "paper" / "six_folded_sheets.dat")
    for words, begins in (
        (("picture", deck, "-o", "sheets.png"), b"\x89PNG"),
        (("picture", deck, "-o", "sheets.gif"), b"GIF8"),
        (("report", deck, "-o", "sheets.html"), b"<!doctype html>"),
        (("export", deck, "-o", "sheets.vtu"), b"<"),
        (("export", deck, "-o", "sheets.pvd"), b"<"),
    ):
        flexact(*words)
        content = Path(words[-1]).read_bytes()
        assert content[: len(begins)].lower() == begins.lower(), words
        print(f"  {words[0]}: {words[-1]}, {len(content)} bytes")
    flexact("check", deck)
    assert (Path(flexact("spacarlight", "--path").strip()) / "spacarlight.m").is_file()


def least_time(*words: str | Path) -> float:
    """Processor time [s] of the quickest run, or time where the system does not tell it."""
    spent = []
    for _ in range(RUNS):
        before, start = os.times(), time.perf_counter()
        subprocess.run(words, check=True, capture_output=True)
        elapsed, after = time.perf_counter() - start, os.times()
        used = sum(after[2:4]) - sum(before[2:4])
        spent.append(used or elapsed)
    return min(spent)


def check_speed() -> None:
    """The first word comes within twice `import numpy`: printed, for times are noisy."""
    numpy = least_time(sys.executable, "-c", "import numpy")
    for words in (("--version",), ("--help",), ("analyse", "--help")):
        ratio = least_time(BIN / "flexact", *words) / numpy
        print(f"  flexact {' '.join(words)}: {ratio:.2f} x import numpy ({1e3 * numpy:.0f} ms)")


def main(decks: Path, answers: Path) -> None:
    """All of it."""
    os.environ["LC_ALL"] = "C.UTF-8"
    print(flexact("--version", "-v"), end="")
    check_counts(decks, answers)
    check_files(decks)
    check_speed()


main(*map(Path, sys.argv[1:]))
