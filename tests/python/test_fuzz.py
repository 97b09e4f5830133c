# SPDX-License-Identifier: BSD-3-Clause
"""A little of the fuzzing, tests/fuzz: always the same decks, none of which may offend.

`make fuzz` goes on for ten minutes with others.
"""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).resolve().parents[1]))

from fuzz import sanitized, workers
from fuzz.keeping import Folder, kind_of
from fuzz.minimising import minimised
from fuzz.mutations import Case, case_of
from fuzz.seeds import seeds
from fuzz.workers import Judged

SEED = 2026
#: Through the package in four parts, and through the core; some twenty seconds in all.
DECKS, PARTS, DECKS_OF_CORE = 900, 4, 1000


def cases(seed: int | str, numbers: range) -> list[Case]:
    real = seeds()
    return [case_of(real, seed, number) for number in numbers]


def offences(found: list[Judged]) -> list[str]:
    return [f"{each.case.name}: {kind_of(each)}\n{each.words}" for each in found if each.offence]


@pytest.mark.parametrize("part", range(PARTS))
def test_the_package_takes_every_deck(part: int) -> None:
    decks = cases(SEED, range(part, DECKS, PARTS))
    found = list(workers.judged(decks, 1))
    assert offences(found) == []
    assert sorted(each.case.name for each in found) == sorted(each.name for each in decks)
    outcomes = {each.outcome for each in found}
    assert {"refused", "analysed"} <= outcomes


@pytest.mark.nightly
def test_the_core_takes_every_deck_with_sanitizers() -> None:
    if not sanitized.PROGRAM.exists():
        pytest.skip("needs the program that tools/test_core.sh builds")
    assert offences(list(sanitized.judged(cases(SEED, range(DECKS, DECKS + DECKS_OF_CORE))))) == []


# The fuzzer itself


def test_a_deck_is_made_again_from_its_number() -> None:
    assert cases(SEED, range(40)) == cases(SEED, range(40))
    assert len({case.text for case in cases(SEED, range(200))}) > 190
    assert cases(SEED, range(40)) != cases(SEED + 1, range(40))


def ends_badly(case: Case) -> Judged:
    if case.text == b"abort":
        os.abort()
    while case.text == b"hang":
        time.process_time()
    if case.text == b"exit":
        os._exit(3)
    return Judged(case, "refused")


def test_a_process_that_dies_or_hangs_over_a_deck_does_not_end_the_fuzzing() -> None:
    texts = [b"abort", b"fine", b"hang", b"exit", b"fine, too"]
    decks = [Case(str(number), text) for number, text in enumerate(texts)]
    found = {each.case.text: each for each in workers.judged(decks, 2, ends_badly, limit=1.0)}
    assert {text: each.offence for text, each in found.items()} == {
        b"abort": "crash (-6)",
        b"fine": "",
        b"hang": "hang",
        b"exit": "crash (3)",
        b"fine, too": "",
    }
    for text in (b"abort", b"hang"):
        assert "in ends_badly" in found[text].words


@pytest.mark.posix
def test_the_core_goes_on_behind_a_deck_that_ends_it(tmp_path: Path) -> None:
    program = tmp_path / "program"
    program.write_text(
        "#!/bin/sh\nwhile read -r deck; do echo $deck; "
        'if grep -q bad "$deck"; then echo "runtime error: here" >&2; exit 1; fi; done < "$1"\n'
    )
    program.chmod(0o755)
    decks = [Case(str(k), b"bad" if k in (3, 4, 9) else b"good") for k in range(10)]
    found = list(sanitized.judged(decks, program))
    assert [each.case.name for each in found] == ["3", "4", "9"]
    assert kind_of(found[0]) == "sanitizer (1): runtime error: here"


def test_a_deck_is_made_as_short_as_it_can_be() -> None:
    text = b"TRUSS 1 1 2 % name\nX 2 1 0 0\nFIX 1 2 3\nDYNX 2 1\n" * 20

    def fails(part: bytes) -> bool:
        return b"FIX" in part and b"1e9" in part

    assert minimised(text + b"X 3 11e99 0\n" + text, fails) in (b"FIX1e9", b"1e9FIX")


def test_what_offends_is_kept_short_with_its_words(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def tried(case: Case) -> Judged:
        bad = b"FIX 7" in case.text
        return Judged(case, "", "offence" if bad else "", "names differ: 12" if bad else "")

    monkeypatch.setattr(workers, "judge_without_command", tried)
    folder = Folder(tmp_path / "kept")
    for number in range(5):
        folder.keep(tried(Case(f"1-{number}", b"TRUSS 1 1 2\nFIX 7\nEND\n")), of_core=False)
    assert dict(folder.kinds) == {"offence: names differ: N": 5}
    names = sorted(path.name for path in (tmp_path / "kept").iterdir())
    assert names == [f"1-{k}{end}" for k in range(3) for end in (".dat", ".txt", ".whole.dat")]
    assert (tmp_path / "kept" / "1-0.dat").read_bytes() == b"FIX 7"
