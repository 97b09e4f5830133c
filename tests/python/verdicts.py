"""Verdicts of every method, compared with a truth that is known."""

from flexact import Analysis, Certainty, Model, analyse

METHODS = ("svd", "jacobi", "qr", "sparse", "auto")

#: Under-constraint and over-constraint.
Counts = tuple[int, int]


def counts(analysis: Analysis) -> Counts:
    return analysis.under_constrained, analysis.over_constrained


def assert_right(analysis: Analysis, truth: Counts) -> None:
    """The counts are the truth; only a method that estimates may be unsure of them."""
    assert counts(analysis) == truth, (analysis.method, analysis.gap)
    if analysis.asked.method != "qr":
        assert analysis.certainty is Certainty.CERTAIN, (analysis.method, analysis.doubts)


def assert_right_or_nearly(analysis: Analysis, truth: Counts) -> None:
    """The truth is what is said, or what is said to hold if the values in doubt are zero."""
    if analysis.certainty is Certainty.CERTAIN:
        assert counts(analysis) == truth, (analysis.method, analysis.gap)
    else:
        assert truth in (counts(analysis), analysis.nearly), (analysis.method, analysis.gap)


def assert_all_right(model: Model, truth: Counts) -> None:
    """By every method."""
    for method in METHODS:
        assert_right(analyse(model, method=method), truth)


def assert_all_right_or_nearly(model: Model, truth: Counts) -> None:
    """By every method."""
    for method in METHODS:
        assert_right_or_nearly(analyse(model, method=method), truth)
