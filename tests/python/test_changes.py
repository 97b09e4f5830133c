# SPDX-License-Identifier: BSD-3-Clause
"""What has changed from one result to the next, in words."""

import dataclasses
import pickle

import pytest
from test_watch import EXACT, GUIDE

import flexact
from flexact.apps.watch.scene import ResultSummary, changed_words, summary_of

FREE = GUIDE.replace("DYNX 3  2\n", "")


def result(deck: str) -> flexact.Analysis:
    return flexact.analyse(flexact.read_text(deck))


def changed_between(before: flexact.Analysis, after: flexact.Analysis) -> str:
    return changed_words(summary_of(before), summary_of(after))


@pytest.mark.parametrize(
    ("before", "after", "start"),
    [
        # The stage is free to move along the sheets, and is held twice about y as before.
        (
            GUIDE,
            GUIDE.replace("RLSE 1  2 5 6", "RLSE 1  1 2 5 6"),
            "over-constrained by 1 → under-constrained by 1 and over-constrained by 1",
        ),
        (GUIDE, EXACT, "over-constrained by 1 → exactly constrained"),
        (EXACT, GUIDE, "exactly constrained → over-constrained by 1"),
        (EXACT, EXACT.replace("DYNX 3  2\n", ""), "exactly constrained → under-constrained by 1"),
    ],
)
def test_a_new_verdict_comes_first(before: str, after: str, start: str) -> None:
    assert changed_between(result(before), result(after)).split("; ")[0] == start


def test_what_made_the_verdict_another_is_said() -> None:
    words = changed_between(result(GUIDE), result(EXACT))
    assert "released deformations 6 → 7" in words
    words = changed_between(result(GUIDE), result(FREE))
    assert "declared degrees of freedom 1 → 0" in words


def test_where_nothing_has_changed_it_says_so() -> None:
    words = changed_between(result(GUIDE), result(GUIDE))
    assert words.startswith("still over-constrained by 1; nothing has changed")


TOLD = ResultSummary(
    "over-constrained by 2",
    {"motions": 0, "self-stresses": 2, "nodes": 4},
    "margin 1 mm",
    False,
    (),
    ("a", "b"),
)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"margin": "margin 2 mm"}, "margin 1 mm → 2 mm"),
        ({"margin": "only in exact alignment"}, "margin 1 mm → only in exact alignment"),
        ({"stresses": ("a", "c")}, "1 of 2 self-stresses is another"),
        ({"stresses": ("d", "c")}, "2 of 2 self-stresses are others"),
        ({"stresses": ("b", "a")}, "nothing has changed that the analysis sees"),
        ({"is_doubtful": True}, "the rank is now doubtful"),
        ({"counts": {**TOLD.counts, "nodes": 5}}, "nodes 4 → 5"),
    ],
)
def test_each_thing_has_words(change: dict[str, object], words: str) -> None:
    after = dataclasses.replace(TOLD, **change)  # type: ignore[arg-type]
    assert changed_words(TOLD, after) == f"still over-constrained by 2; {words}"


def test_the_only_one_is_another() -> None:
    one = dataclasses.replace(TOLD, counts={**TOLD.counts, "self-stresses": 1}, stresses=("a",))
    other = dataclasses.replace(one, stresses=("b",))
    assert changed_words(one, other).endswith("; the self-stress is another")


def test_what_is_told_goes_from_process_to_process() -> None:
    told = summary_of(result(GUIDE))
    assert pickle.loads(pickle.dumps(told)) == told
    assert told.verdict == "over-constrained by 1"
    assert len(told.stresses) == told.counts["self-stresses"] == 1
