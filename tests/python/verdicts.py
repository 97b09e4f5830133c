# SPDX-License-Identifier: BSD-3-Clause
"""Verdicts of every method, compared with a truth that is known."""

from flexact import Analysis, Certainty, Model, analyse
from flexact.core import calls

#: Every public method, and those that keep all of D(c).
METHODS = calls.METHODS
DENSE = tuple(method for method in METHODS if method not in ("auto", "sparse"))

#: Under-constraint and over-constraint.
Counts = tuple[int, int]


def counts(analysis: Analysis) -> Counts:
    return analysis.under_constrained, analysis.over_constrained


def assert_right(analysis: Analysis, truth: Counts) -> None:
    """The counts are the truth, and certain."""
    assert counts(analysis) == truth, (analysis.method, analysis.gap)
    assert analysis.certainty is Certainty.CERTAIN, (analysis.method, analysis.doubts)


def never_wrong(analysis: Analysis, truth: Counts) -> Analysis:
    """Certain of the truth, or not certain; whether the truth is among the answers is left open.

    Only for what `BEYOND` of test_extreme_conditioning.py asks for the truth as well.
    """
    assert analysis.certainty is not Certainty.CERTAIN or counts(analysis) == truth
    return analysis


def assert_right_or_nearly(analysis: Analysis, truth: Counts) -> None:
    """The truth is what is said, or what is said to hold if the values in doubt are zero."""
    if analysis.certainty is Certainty.CERTAIN:
        assert counts(analysis) == truth, (analysis.method, analysis.gap)
        assert (analysis.nearly, analysis.assessment.doubts) == (None, ())
    else:
        assert truth in (counts(analysis), analysis.nearly[:2]), (analysis.method, analysis.gap)
        assert analysis.assessment.doubts


def assert_all_right(model: Model, truth: Counts) -> None:
    """By every method."""
    for method in METHODS:
        assert_right(analyse(model, method=method), truth)


def assert_all_right_or_nearly(model: Model, truth: Counts) -> None:
    """By every method."""
    for method in METHODS:
        assert_right_or_nearly(analyse(model, method=method), truth)
