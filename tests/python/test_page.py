# SPDX-License-Identifier: BSD-3-Clause
"""The page as text: what it holds, whatever the deck holds, and what it leaves out."""

import base64
import gzip
import hashlib
import html
import json
import platform
import re
from html.parser import HTMLParser
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from ill_conditioned_models import two_wires
from known_models import folded_sheet, twelve_trusses
from reference_decks import ROOT

import flexact
from flexact.advice.describe import verdict_in_words
from flexact.show.page import Entry, broken_page, content, index_page, page
from flexact.show.page import viewer as viewer_data
from flexact.show.page.assets import SCRIPTS, asset, json_for_script, script

pytestmark = pytest.mark.dear(16)

PAGE = ROOT / "python" / "flexact" / "show" / "page"
CLAMPED = ROOT / "input_decks" / "paper" / "folded_sheet_clamped.dat"


class Elements(HTMLParser):
    """Every start tag of a page, and the text of scripts and styles."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.raw: list[tuple[str, str]] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))

    def handle_data(self, data: str) -> None:
        if self.tags and self.tags[-1][0] in ("script", "style") and data.strip():
            self.raw.append((self.tags[-1][0], data))


def data_of(text: str) -> dict[str, Any]:
    """The drawing's data in a page."""
    found = re.search(r'class="drawing-data">(.*?)</script>', text, re.DOTALL)
    assert found
    made: dict[str, Any] = json.loads(found[1])
    return made


def unpacked(packed: dict[str, str]) -> np.ndarray:
    return np.frombuffer(base64.b64decode(packed["data"]), f"<{packed['type']}")


def words_of(text: str) -> str:
    """The words of a page, without its tags."""
    body = re.sub(r"<(script|style).*?</\1>", "", text, flags=re.DOTALL)
    return " ".join(html.unescape(re.sub(r"<[^>]+>", " ", body)).split())


def test_everything_is_in_the_page_and_allowed_by_its_policy() -> None:
    text = page(flexact.analyse(CLAMPED))
    elements = Elements(text)
    for tag, attributes in elements.tags:
        assert "style" not in attributes and not any(name[:2] == "on" for name in attributes), tag
        for name in ("src", "href"):
            assert (attributes.get(name) or "#").startswith(("data:", "#"))
    policy = next(
        attributes["content"] or ""
        for _, attributes in elements.tags
        if attributes.get("http-equiv") == "Content-Security-Policy"
    )
    assert policy.startswith("default-src 'none'; ") and "unsafe" not in policy
    data, *scripts, packed, opens = (data for tag, data in elements.raw if tag == "script")
    assert data.startswith("{") and opens.startswith("/*! three.js")
    opened = gzip.decompress(base64.b64decode(packed)).decode()
    first = SCRIPTS.index("three.min.js")
    assert scripts == list(map(script, SCRIPTS[:first]))
    assert opened == "\n".join(map(asset, SCRIPTS[first:]))
    styles = (data for tag, data in elements.raw if tag == "style")
    for whole in (*scripts, opened, opens, *styles):
        digest = base64.b64encode(hashlib.sha256(whole.encode()).digest()).decode()
        assert f"'sha256-{digest}'" in policy


def test_scripts_cannot_end_their_element() -> None:
    for name in SCRIPTS:
        assert not re.search(r"</script|<!--", script(name), re.IGNORECASE), name


def test_the_licence_of_what_is_embedded_is_in_the_page() -> None:
    text = page(flexact.analyse(CLAMPED))
    assert "three.js 0.187.0" in text and "The MIT License" in text
    assert "Permission is hereby granted, free of charge" in text
    assert len(asset("three.min.js")) < 700_000, "only the parts that are used"


def test_json_is_safe_within_a_script() -> None:
    data = {"name": "</script><!--<script>&\u2028\u2029\"'"}
    text = json_for_script(data)
    assert not set("<>&\u2028\u2029") & set(text)
    assert json.loads(text) == data


def test_the_same_deck_gives_the_same_page() -> None:
    first, second = (page(flexact.analyse(CLAMPED)) for _ in range(2))
    assert first == second


def test_no_path_of_the_machine_is_in_the_page() -> None:
    text = page(flexact.analyse(CLAMPED))
    assert str(CLAMPED.parent) not in text and str(Path.home()) not in text
    assert CLAMPED.name in text


def test_the_page_tells_how_to_make_it_again() -> None:
    analysis = flexact.analyse(CLAMPED, method="jacobi", tolerance=1e-9, accuracy=(20e-6, 1e-4))
    words = words_of(page(analysis))
    digest = hashlib.sha256(CLAMPED.read_bytes()).hexdigest()
    for told in (
        f"Flexact {flexact.__version__}",
        f"Python {platform.python_version()}",
        f"NumPy {np.__version__}",
        "three.js, in this page 0.187.0",
        "method jacobi (asked for: jacobi)",
        "tolerance 1e-09 (as asked for)",
        f"SHA-256 of the deck {digest}",
        "flexact report folded_sheet_clamped.dat -o folded_sheet_clamped.html --method jacobi "
        "--tolerance 1e-09 --accuracy 2e-05,0.0001",
    ):
        assert told in words


def test_a_model_made_in_python_shows_its_deck() -> None:
    analysis = flexact.analyse(twelve_trusses())
    words = words_of(page(analysis))
    assert "The model was made in Python; this deck says the same." in words
    deck = analysis.model.to_deck()
    for line in deck.splitlines():
        assert " ".join(line.split()) in words
    assert hashlib.sha256(deck.encode()).hexdigest() in words


def test_verdict_counts_decision_and_remedies_are_told() -> None:
    analysis = flexact.analyse(CLAMPED)
    words = words_of(page(analysis))
    verdict = str(verdict_in_words(analysis))
    assert verdict in words.replace("by 1 :", "by 1:")
    for told in (
        "coordinates 18 12 6 0",
        "deformations 12 6 6 0",
        "D(c) has 6 rows and 6 columns; its rank is 5.",
        "Proven for the decimals as typed: the rank is 5.",
        "the fold turns about the line through (0.06, *, 0) m along y",
        "the first sheet, ground to fold in-plane moment -1 N m at the ground",
        "To declare the fold: the first sheet, ground to fold",
        "With the fold declared the mechanism is over-constrained by 1.",
        "To remove it, release one of:",
    ):
        assert told in words, told


def head_of(text: str) -> str:
    found = re.search(r"<header.*?</header>", text, re.DOTALL)
    assert found
    return words_of(found[0])


def test_the_head_says_what_is_wrong_how_sure_and_what_helps() -> None:
    head = head_of(page(flexact.analyse(CLAMPED)))
    for told in (
        "self-stress can exist without any load.",
        "Margin: 44 mm.",
        "rank proven",
        "Do this , and the mechanism is exactly constrained: declare the folds and cut the first "
        "sheet, ground to fold to a waist at the ground (DYNE 1 6 instead of RLSE 1 6, RLSE 1 3).",
    ):
        assert told in head, told
    over = head_of(page(flexact.analyse(CLAMPED.with_name("six_folded_sheets.dat"))))
    assert "cylinder : x, y, rx, ry, rz together held six times (once too often)" in over
    exact = head_of(page(flexact.analyse(CLAMPED.with_name("five_wires.dat"))))
    assert "rank proven" in exact and "remove" not in exact


def test_a_doubtful_decision_is_doubted_in_the_first_line() -> None:
    # The sine of 60 degrees with two digits.
    bars = "PLTRUSS 1 1 2\nPLTRUSS 2 2 3\nX 2 0.87 0.5\nX 3 1.73 1\nFIX 1\nFIX 3\nEND\n"
    analysis = flexact.analyse(flexact.read_text(bars))
    assert analysis.verdict is flexact.Verdict.EXACT and analysis.nearly[:2] == (1, 1)
    text = page(analysis)
    head = head_of(text)
    assert "rank doubtful: there may be 1 motion and 1 self-stress" in head
    assert "proven" not in head
    assert re.search(r'<span class="sign"[^>]*>[^<]+\?</span>', text)
    assert 'href="#decision"' in text and 'id="decision"' in text
    unproven = flexact.analyse(two_wires(1e-3), prove=False)
    assert "rank numerically certain" in head_of(page(unproven))


def test_degrees_of_freedom_are_told_in_words() -> None:
    deck = ROOT / "input_decks" / "paper" / "six_folded_sheets.dat"
    movements = data_of(page(flexact.analyse(deck)))["movements"]
    assert [movement["label"] for movement in movements[:2]] == [
        "the upper centre along z",
        "upper 90, ground to fold: out-of-plane bending at the fold",
    ]
    assert [movement["title"] for movement in movements[:2]] == [
        "Degree of freedom: the upper centre along z",
        "Degree of freedom: upper 90, ground to fold: out-of-plane bending at the fold",
    ]
    deck = ROOT / "input_decks" / "flexures" / "cross_hinge_sheet_and_wires.dat"
    text = page(flexact.analyse(deck))
    titles = [attributes.get("title") for tag, attributes in Elements(text).tags if tag == "input"]
    assert "Degree of freedom: arm to wire at y = -20 mm about y" in titles


def test_degrees_of_freedom_that_cannot_move_are_told() -> None:
    deck = ROOT / "input_decks" / "flexures" / "folded_sheet_clamped_trap.dat"
    words = words_of(page(flexact.analyse(deck)))
    stuck = "the first sheet, ground to fold : out-of-plane bending at the ground"
    assert f"Declared, but a self-stress stops it: {stuck}" in words
    assert "Declared, but" not in words_of(page(flexact.analyse(CLAMPED)))


def test_only_quantities_that_there_are_can_be_chosen() -> None:
    for deck, expected in (
        ("six_folded_sheets", ["twist moment", "in-plane moment"]),
        ("twelve_trusses", ["normal force"]),
    ):
        text = page(flexact.analyse(CLAMPED.with_name(f"{deck}.dat")))
        inputs = [attributes for tag, attributes in Elements(text).tags if tag == "input"]
        chosen = [each["value"] for each in inputs if each.get("name") == "quantity"]
        assert chosen == expected


def test_verdicts_differ_by_sign_and_word_not_by_colour_alone() -> None:
    heads = {}
    for name, deck in (
        ("exact", "five_wires"),
        ("under", "folded_sheet_free"),
        ("over", "six_folded_sheets"),
        ("both", "twelve_trusses"),
    ):
        text = page(flexact.analyse(ROOT / "input_decks" / "paper" / f"{deck}.dat"))
        found = re.search(
            r'<header class="verdict (\w+)"><h1 class="headline"><span class="sign".*?>(.*?)<', text
        )
        assert found and found[1] == name
        heads[name] = found[2]
    assert len(set(heads.values())) == 4


def test_values_of_the_drawing_are_those_of_the_analysis() -> None:
    analysis = flexact.analyse(twelve_trusses())
    data = data_of(page(analysis))
    positions = unpacked(data["reference"]["position"]).reshape(-1, 3)
    low, high = analysis.model.positions.min(axis=0), analysis.model.positions.max(axis=0)
    expected = (analysis.model.positions - (low + high) / 2) / np.linalg.norm(high - low)
    assert np.allclose(positions, expected, atol=1e-7)
    assert data["size"] == pytest.approx(np.linalg.norm(high - low))
    force = analysis.self_stresses[0].forces[:, 0]
    assert np.allclose(
        unpacked(data["stresses"][0]["members"]["normal force"]).reshape(-1, 2),
        force[:, None],
        atol=1e-7,
    )
    assert list(data["stresses"][0]["members"]) == ["normal force"], "bars carry nothing else"


def test_only_what_moves_has_tracks() -> None:
    data = data_of(page(flexact.analyse(CLAMPED)))
    movement = data["movements"][0]
    number = unpacked(data["nodes"]["number"])
    moved = {name: unpacked(track["rows"]) for name, track in movement["tracks"].items()}
    # The fold turns, and is drawn along a little by its sheets, which keep their length.
    assert number[moved["position"]].tolist() == [3]
    assert unpacked(movement["tracks"]["position"]["change"]).size == 17 * 3
    assert movement["phases"] == 17
    # Two sheets of 17 stations, clamped at one end each.
    assert moved["centre"].tolist() == [*range(1, 17), *range(17, 33)]
    assert moved["axis"].size == 0


def test_long_movements_have_fewer_phases(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(content, "MOST_SHAPES", 3000)
    movement = data_of(page(flexact.analyse(CLAMPED)))["movements"][0]
    assert movement["phases"] == 5
    assert unpacked(movement["tracks"]["position"]["change"]).size == 5 * 3


def test_a_mechanism_far_away_keeps_its_digits() -> None:
    model = flexact.Model()
    a, b = model.node(1e8, 0, 0), model.node(1e8 + 1, 0, 0)
    model.sheet(a, b, (0, 0, 1))
    model.fix(a)
    places = unpacked(data_of(page(flexact.analyse(model)))["reference"]["position"]).reshape(-1, 3)
    placed = unpacked(data_of(page(flexact.analyse(model)))["nodes"]["placed"])
    assert np.allclose(places[placed], [[-0.5, 0, 0], [0.5, 0, 0]], atol=1e-7)


def test_diagnostics_stand_at_their_lines() -> None:
    analysis = flexact.analyse(ROOT / "input_decks" / "linkages" / "four_bar_planar_driven.dat")
    (note,) = [item for item in analysis.warnings if item.line]
    text = page(analysis)
    line = text.index(f'id="line-{note.line}"')
    told = text.index("note[not-used]")
    assert line < told < text.index(f'id="line-{note.line + 1}"')


@pytest.mark.parametrize("name", ["ten_mistakes", "not_text", "nothing_to_analyse"])
def test_broken_decks_have_pages(name: str) -> None:
    path = ROOT / "input_decks" / "broken" / f"{name}.dat"
    with pytest.raises(flexact.DeckError) as caught:
        flexact.read(path)
    count = caught.value.problems.errors
    words = words_of(broken_page(caught.value, str(path)))
    assert f"Cannot be analysed: {count} error" in words
    for item in caught.value.diagnostics:
        assert f"{item.severity}[{item.code}] : {item.message}" in words
    assert str(path.parent) not in words


def test_a_failed_analysis_has_a_page_that_says_why() -> None:
    words = words_of(broken_page(flexact.AnalysisError("it did not converge"), "a/b.dat"))
    assert "Cannot be analysed: it did not converge" in words and "b.dat" in words


def test_what_does_not_fit_is_left_out_and_told(monkeypatch: pytest.MonkeyPatch) -> None:
    for module in ("drawing", "viewer"):
        monkeypatch.setattr(import_module(f"flexact.show.page.{module}"), "MOST_MEMBERS", 7)
    analysis = flexact.analyse(twelve_trusses())
    text = page(analysis)
    assert "Of 12 members the first 7 are drawn." in words_of(text)
    data = data_of(text)
    assert unpacked(data["members"]["number"]).tolist() == [1, 2, 3, 4, 5, 6, 7]
    assert unpacked(data["reference"]["centre"]).size == 7 * 2 * 3
    assert unpacked(data["reference"]["section"]).size == 7 * 4
    assert unpacked(data["stresses"][0]["members"]["normal force"]).size == 14


def test_many_motions_are_cut_and_told() -> None:
    model = flexact.Model()
    for k in range(20):
        a, b = model.node(k, 0, 0), model.node(k, 1, 0)
        model.truss(a, b)
        model.fix(a)
    analysis = flexact.analyse(model)
    assert analysis.under_constrained == 40
    text = page(analysis)
    words = words_of(text)
    assert "Of 40 motions the first 12 can be shown." in words
    assert "and 28 more motions." in words
    assert len(data_of(text)["movements"]) == 12


def test_poses_that_take_much_room_are_cut_and_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(viewer_data, "MOST_POSES", 2500)
    analysis = flexact.analyse(folded_sheet(clamped=False))
    text = page(analysis)
    shown = len(data_of(text)["movements"])
    assert 1 <= shown < 6
    assert f"Of 6 motions the first {shown} can be shown." in words_of(text)
    assert text.count('data-show="movement') == shown


def test_an_index_of_entries() -> None:
    entries = (
        Entry(
            "a/<b>&",
            "a/<b>&.html",
            ("exact", "+"),
            "exactly constrained",
            "Exactly constrained",
            "margin 10 um",
            b"\x89PNG",
        ),
        Entry("x", "x.html", ("broken", "x"), "cannot be analysed", "Cannot be analysed: 2 errors"),
        Entry("nothing", "", ("broken", "x"), "cannot be analysed", "Cannot be read"),
    )
    text = index_page(entries)
    assert 'href="a/%3Cb%3E%26.html"' in text and "a/<wbr>&lt;b&gt;&amp;</a>" in text
    assert text.count("<img") == 1 and text.count("<a ") == 2
    words = words_of(text)
    assert "3 decks" in words and "1 exactly constrained" in words
    assert "2 cannot be analysed" in words
    assert words.count("margin 10 um") == 1


def test_every_script_is_embedded() -> None:
    further = {"open.js", "finder.js", "plain.js", "live.js", "switches.js"}
    assert {path.name for path in PAGE.glob("*.js")} == {*SCRIPTS, *further}


def test_verdicts_have_one_colour_in_pages_and_pictures() -> None:
    light = asset("style.css").split("}")[0]
    found = dict(re.findall(r"--(\w+): (#\w+);", light))
    kinds = {"exact": "EXACT", "under": "UNDER", "over": "OVER", "both": "BOTH"}
    assert {found[kind] for kind in kinds} == {verdict.colour for verdict in flexact.Verdict}
    for kind, name in kinds.items():
        assert found[kind] == flexact.Verdict[name].colour


def test_data_of_an_index_are_harmless() -> None:
    entry = Entry("a/\x9b\u202e\x1b<x>", "", ("broken", "x"), "none", "None")
    card = index_page([entry]).split('<ul class="cards">')[1]
    assert not [c for c in card if not c.isprintable() and c != "\n"]
