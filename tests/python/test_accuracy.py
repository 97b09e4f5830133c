# SPDX-License-Identifier: BSD-3-Clause
"""The accuracy of the workshop against the margin: words, colours, exit codes.

Two wires of one metre at an angle t to each other are parallel after a move of t metres, or a
turn of t, so that the margin of every case is known: tests/python/test_margin.py.
"""

import html
import re
from pathlib import Path

import numpy as np
import pytest
from known_models import ring, twelve_trusses
from reference_decks import ROOT, text_of
from small_decks import DECKS, json_lines, write
from test_margin import two_wires

from flexact import Analysis, AnalysisError, Verdict, analyse
from flexact.advice.describe import verdict_in_words
from flexact.analysis.differences import side_of, stored_side
from flexact.analysis.naming import angle_in_words, length_in_words
from flexact.analysis.verdict_words import but_only, verdict_in_short
from flexact.apps.checks.findings import findings_about
from flexact.apps.cli.main import main
from flexact.apps.editor.deck import Deck, Document
from flexact.apps.editor.session import opinion_on
from flexact.apps.watch.edit_session import Session
from flexact.apps.watch.scene import summary_of
from flexact.show.notebook.output import html_of
from flexact.show.page import entry_of, page
from flexact.show.page.content import verdict_of_side
from flexact.show.picture.make import _words as picture_words
from flexact.show.spacar_log import spacar_log

pytestmark = pytest.mark.dear(30)

TEN_MICROMETRES = 1e-5
GREEN = Verdict.EXACT.colour
CASES = [
    (None, False),
    (20e-6, True),
    (5e-6, False),
    ((20e-6, 1e-9), True),
    ((5e-6, 20e-6), True),
    ((5e-6, 5e-6), False),
    ((5e-6, None), False),
    (np.float64(20e-6), True),
    (np.array([20e-6, 1e-9]), True),
]


@pytest.mark.parametrize(("accuracy", "marginal"), CASES)
def test_word_and_colour_are_those_of_the_accuracy(accuracy: object, marginal: bool) -> None:
    analysis = analyse(two_wires(TEN_MICROMETRES), accuracy=accuracy)  # type: ignore[arg-type]
    assert analysis.verdict is Verdict.EXACT
    assert analysis.is_marginal is marginal
    start = verdict_in_words(analysis).start
    assert ("but only by 10 u" in start) is marginal
    # Without an accuracy the colour is that of what parts are usually made to.
    amber = marginal or accuracy is None
    assert (analysis.colour != GREEN) is amber is analysis.has_small_margin
    assert ('class="verdict marginal"' in page(analysis)) is amber
    assert ('class="verdict exact"' in page(analysis)) is not amber
    assert analysis.colour in html_of(analysis)
    # The margin itself is said of all of them.
    for words in (analysis.describe(), repr(analysis), page(analysis)):
        assert "10 um" in words and "10 urad" in words


def test_what_is_smaller_is_what_is_named() -> None:
    wires = two_wires(TEN_MICROMETRES)
    for accuracy, named in (
        ((20e-6, 1e-9), "but only by 10 um"),
        ((1e-9, 20e-6), "but only by 10 urad"),
        ((20e-6, 20e-6), "but only by 10 um or 10 urad"),
    ):
        assert verdict_in_words(analyse(wires, accuracy=accuracy)).start.endswith(named)


def test_certainty_is_of_the_rank_alone() -> None:
    """The arithmetic is as sure with the accuracy as without; no head says that all is certain."""
    for accuracy in (None, 20e-6):
        analysis = analyse(two_wires(TEN_MICROMETRES), accuracy=accuracy, prove=False)
        assert str(analysis.certainty) == "numerically certain"
        for words in (analysis.describe(), re.sub(r"<[^>]*>", " ", page(analysis))):
            for found in re.finditer(r"\bcertain\b", words):
                assert words[: found.start()].lower().endswith("numerically ")
        assert "The rank is numerically certain" in analysis.describe(verbose=True)


def test_an_alignment_that_is_exact_is_within_any_accuracy() -> None:
    analysis = analyse(twelve_trusses(), accuracy=1e-12)
    assert analysis.is_marginal
    assert verdict_in_words(analysis).start.endswith("but only in exact alignment")
    assert analysis.colour == Verdict.BOTH.colour


def test_far_from_another_verdict_every_accuracy_will_do() -> None:
    """Tarnai's ring of five: see tests/python/test_margin.py."""
    analysis = analyse(ring(5), accuracy=(1e-3, 1e-3))
    assert not analysis.is_marginal and analysis.colour == GREEN


def luminance(colour: str) -> float:
    """Relative luminance of WCAG 2.1."""
    parts = [int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def test_amber_can_be_read_on_white_and_is_no_green() -> None:
    """WCAG 2.1: a contrast of 4.5 for text."""
    colour = analyse(two_wires(TEN_MICROMETRES), accuracy=20e-6).colour
    assert 1.05 / (luminance(colour) + 0.05) > 4.5
    red, green, blue = (int(colour[k : k + 2], 16) for k in (1, 3, 5))
    assert red > green > blue
    assert colour not in {verdict.colour for verdict in Verdict}


# Units


@pytest.mark.parametrize(
    ("length", "words"),
    [
        (12.3, "12 m"),
        (1.0, "1 m"),
        (0.9996, "1 m"),
        (0.15, "150 mm"),
        (9.996e-4, "1 mm"),
        (1.234e-5, "12 um"),
        (2e-8, "20 nm"),
        (3e-13, "0.0003 nm"),
        (0.0, "0 nm"),
    ],
)
def test_lengths_are_in_units_of_the_workshop(length: float, words: str) -> None:
    assert length_in_words(length) == words


@pytest.mark.parametrize(
    ("angle", "words"),
    [(2.0, "2 rad"), (0.05, "50 mrad"), (2e-4, "200 urad"), (9.99e-7, "1 urad"), (1e-9, "1 nrad")],
)
def test_angles_are_in_units_of_the_workshop(angle: float, words: str) -> None:
    assert angle_in_words(angle) == words


# What cannot be an accuracy


@pytest.mark.parametrize("wrong", ["20e-6", b"1", True, [], [1e-6, 1e-6, 1e-6], object(), ["1", 2]])
def test_an_accuracy_is_a_number_or_two(wrong: object) -> None:
    with pytest.raises(TypeError, match="accuracy"):
        analyse(ring(3), accuracy=wrong)  # type: ignore[arg-type]


@pytest.mark.parametrize("wrong", [0.0, -1e-6, float("nan"), float("inf"), 10**400, (1e-6, 0.0)])
def test_an_accuracy_is_positive_and_finite(wrong: float) -> None:
    with pytest.raises(ValueError, match="accuracy"):
        analyse(ring(3), accuracy=wrong)


# The command


@pytest.fixture
def close(tmp_path: Path) -> str:
    return str(write(tmp_path / "close.dat", two_wires(TEN_MICROMETRES).to_deck()))


@pytest.mark.parametrize(
    ("words", "code"),
    [
        ("", 0),
        ("--expect exact", 0),
        ("--expect exact --accuracy 20e-6", 3),
        ("--expect exact --accuracy 5e-6", 0),
        ("--expect exact --accuracy 5e-6,20e-6", 3),
        ("--expect exact --accuracy 5e-6,5e-6", 0),
        ("--accuracy 20e-6", 0),
        ("--expect over --accuracy 20e-6", 3),
        ("--accuracy 0", 2),
        ("--accuracy x", 2),
        ("--accuracy 1e-6,", 2),
        ("--accuracy 1e-6,1e-6,1e-6", 2),
        ("--accuracy nan", 2),
    ],
)
def test_exit_codes(words: str, code: int, close: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["analyse", close, *words.split()]) == code
    out, err = capsys.readouterr()
    if code == 3 and "exact" in words:
        assert "but only by 10 u" in err and "but only by 10 u" in out
    if code == 2:
        assert out == "" and "--accuracy" in err


def test_expecting_another_verdict_does_not_ask_for_the_margin(tmp_path: Path) -> None:
    deck = str(write(tmp_path / "both.dat", DECKS["both"]))
    assert main(["analyse", deck, "--expect", "both", "--accuracy", "1e-3"]) == 0


def test_a_batch_counts_what_the_accuracy_leaves(
    tmp_path: Path, close: str, capsys: pytest.CaptureFixture[str]
) -> None:
    write(tmp_path / "exact.dat", DECKS["exact"])
    assert main(["analyse", str(tmp_path), "--accuracy", "20e-6", "--json"]) == 0
    out, err = capsys.readouterr()
    assert {line["accuracy"]["exceeds_margin"] for line in json_lines(out)} == {True, False}
    assert "1 exactly constrained but by less than the accuracy" in err
    assert "1 exactly constrained" in err


def test_pages_and_their_index_say_it(tmp_path: Path, close: str) -> None:
    write(tmp_path / "exact.dat", DECKS["exact"])
    assert main(["report", str(tmp_path), "-o", str(tmp_path / "out"), "--accuracy", "20e-6"]) == 0
    index = (tmp_path / "out" / "index.html").read_text(encoding="utf-8")
    assert index.count('class="card marginal"') == index.count('class="card exact"') == 1
    assert "margin 10 um or 10 urad" in index and "but only by 10 um" in index
    assert re.search(r"margin [0-9.]+ m\b", index)


def test_the_picture_has_the_colour_and_the_margin(tmp_path: Path, close: str) -> None:
    pytest.importorskip("matplotlib")
    for accuracy, colour in (("20e-6", "#8a6a00"), ("5e-6", GREEN)):
        target = tmp_path / "close.svg"
        assert main(["picture", close, "-o", str(target), "--accuracy", accuracy]) == 0
        picture = target.read_text(encoding="utf-8")
        assert colour in picture
        assert ("#8a6a00" in picture) is (colour != GREEN)


def test_results_carry_their_accuracy() -> None:
    analysis: Analysis = analyse(two_wires(TEN_MICROMETRES), accuracy=(20e-6, 1e-4))
    assert analysis.accuracy == (20e-6, 1e-4)
    assert analyse(ring(3)).accuracy is None


def test_an_accuracy_beyond_the_model_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    """20 is 20 m."""
    deck = str(ROOT / "input_decks" / "flexures" / "parallel_guide.dat")
    with pytest.raises(AnalysisError, match=r"larger than .*--beyond.*beyond=True"):
        analyse(deck, accuracy=20)
    assert analyse(deck, accuracy=20, beyond=True).accuracy is not None
    assert main(["analyse", deck, "--accuracy", "20"]) != 0
    assert "--beyond" in capsys.readouterr().err
    assert main(["analyse", deck, "--accuracy", "20", "--beyond"]) == 0


# One sentence states the verdict

#: Decks of each verdict, some of which a small misalignment changes.
STATED = (
    "flexures/parallel_guide",
    "flexures/five_wires",
    "flexures/parallel_guide_wavy_8_beams",
    "flexures/sheet_clamped_both_ends_four_beams_undeclared",
    "frameworks/octahedral_platform_yaw_80",
    "linkages/bennett",
    "paper/twelve_trusses",
)


def stated(name: str, analysis: Analysis) -> dict[str, str]:
    """The verdict in each place that states it."""
    session = Session(Path("deck.dat"))
    session.renew(analysis)
    words = " ".join(analysis.describe().split())
    found: dict[str, str] = {
        "page": html.unescape(re.findall(r'<b class="says">(.*?):</b>', page(analysis))[0]),
        "compared": html.unescape(
            re.findall(r'<b class="says">(.*?):</b>', verdict_of_side(analysis, ""))[0]
        ),
        "side": side_of(analysis).words,
        "stored side": stored_side(analysis.to_json().encode(), "").words,
        "index": entry_of(analysis, "deck", "deck.html").words,
        "watch, headline": summary_of(analysis).verdict,
        "watch, panel": session.told()["verdict"],
        "picture": picture_words(analysis)[1].partition(":")[0],
        "log": re.findall("Flexact: (.*)", spacar_log(analysis))[0],
        "notebook": html.unescape(re.findall("<b>(.*?): ", analysis._repr_html_())[0]),
    }
    if analysis.accuracy is None:
        opinion = opinion_on(Deck(Document.of(text_of(name))))
        assert opinion is not None
        found["editor"] = opinion.words.partition(";")[0]
    assert side_of(analysis).verdict == stored_side(analysis.to_json().encode(), "").verdict
    verdict = next(each for each in Verdict if each is not analysis.verdict)
    for finding in findings_about("deck", analysis, verdict):
        if finding.code.endswith("-constrained"):
            found[f"findings, {finding.code}"] = finding.message
    assert verdict_in_short(analysis) in words.lower()
    return found


@pytest.mark.grid
@pytest.mark.parametrize("accuracy", [None, 1e-2, (10.0, 1.0)])
@pytest.mark.parametrize("name", STATED)
def test_every_place_states_the_verdict_in_one_sentence(name: str, accuracy: object) -> None:
    deck = ROOT / f"input_decks/{name}.dat"
    analysis = analyse(deck, accuracy=accuracy, beyond=True)  # type: ignore[arg-type]
    short = verdict_in_short(analysis)
    for place, words in stated(name, analysis).items():
        if place.startswith("findings"):
            # A finding is of one part of the verdict.
            assert but_only(analysis.margin, analysis.accuracy) in words, place
        else:
            assert words.lower() == short.lower(), place


def test_some_of_them_hold_only_within_the_accuracy() -> None:
    decks = (ROOT / f"input_decks/{name}.dat" for name in STATED)
    every = [analyse(each, accuracy=10.0, beyond=True) for each in decks]
    lifted = [but_only(each.margin, each.accuracy) for each in every]
    for words in ("only by", "alignment"):
        assert any(words in each for each in lifted)
