# SPDX-License-Identifier: BSD-3-Clause
"""The page of layouts: what it holds of each, what it says where there is none, what is drawn."""

from __future__ import annotations

import base64
import gzip
import hashlib
import json
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_page import Elements, words_of

import flexact
from flexact.apps.cli.main import main
from flexact.apps.watch import design as watched
from flexact.apps.watch.scene import Broken, Laid, Stage, is_before
from flexact.apps.watch.worker import answer_of
from flexact.designs import page as pages
from flexact.designs.design import Designs, layouts_of
from flexact.designs.layouts import Flexure
from flexact.designs.page import hold_shown, html_of, page_of, spaces_of, wanted_motions
from flexact.designs.problem import Problem
from flexact.designs.reading import problem_of
from flexact.designs.scores import cell, pareto
from flexact.show.page.assets import LAYOUT_SCRIPTS, asset, script
from flexact.util.errors import FlexactError

#: Three motions that three wires along z leave; its title would be markup.
STAGE: dict[str, Any] = {
    "title": "XY <b>stage</b>",
    "wanted": ["translation x", "translation y", "rotation about (0, 0, 0) along z"],
    "stage": {"boxes": [[[-0.03, -0.03, 0.0], [0.03, 0.03, 0.01]]]},
    "mass": 0.3,
    "inertia": 1e-4,
    "ground": {"boxes": [[[-0.06, -0.06, -0.08], [0.06, 0.06, -0.06]]]},
    "limits": {"length": [0.04, 0.1], "diameter": 1e-3, "kinds": ["wire"]},
    "count": 3,
}
#: The same in a file.
FILE = """\
title = "XY stage"
wanted = ["planar z"]
count = 2
[stage]
boxes = [[[-0.03, -0.03, 0.0], [0.03, 0.03, 0.01]]]
[ground]
boxes = [[[-0.06, -0.06, -0.08], [0.06, 0.06, -0.06]]]
[limits]
length = [0.04, 0.1]
diameter = 1e-3
kinds = ["wire"]
"""


def problem(**more: Any) -> Problem:
    return problem_of({**STAGE, **more})


@pytest.fixture(scope="module")
def designs() -> Designs:
    return layouts_of(problem())


@pytest.fixture(scope="module")
def text(designs: Designs) -> str:
    return page_of(designs, "stage").decode()


@pytest.fixture(scope="module")
def cards(text: str) -> list[str]:
    return re.findall(r'<li class="card layout".*?</li>\n', text, re.DOTALL)


def datum(card: str, name: str) -> str:
    found = re.search(rf' data-{name}="([^"]*)"', card)
    assert found is not None, name
    return found[1]


def test_the_page_is_one_file_allowed_by_its_policy(text: str) -> None:
    elements = Elements(text)
    for tag, attributes in elements.tags:
        assert "style" not in attributes and not any(name[:2] == "on" for name in attributes), tag
        for name in ("src", "href"):
            assert (attributes.get(name) or "#").startswith(("data:", "#"))
    (policy,) = (
        attributes["content"] or ""
        for _, attributes in elements.tags
        if attributes.get("http-equiv") == "Content-Security-Policy"
    )
    assert policy.startswith("default-src 'none'; ") and "unsafe" not in policy
    run = re.findall(r"<script>(.*?)</script>", text, re.DOTALL)
    (packed,) = re.findall(r'<script [^>]*class="packed">(.*?)</script>', text)
    run.append(gzip.decompress(base64.b64decode(packed)).decode())
    for name in (*LAYOUT_SCRIPTS, "start_layouts.js"):
        assert sum(script(name) in each or asset(name) in each for each in run) == 1
    for each in (*run, *(data for tag, data in elements.raw if tag == "style")):
        digest = base64.b64encode(hashlib.sha256(each.encode()).digest()).decode()
        assert f"'sha256-{digest}'" in policy
    names = [attributes["id"] for _, attributes in elements.tags if "id" in attributes]
    assert len(names) == len(set(names))
    assert len(text) < 1_150_000


def test_a_card_a_layout_with_its_numbers_deck_and_script(
    designs: Designs, cards: list[str], text: str
) -> None:
    assert len(cards) == len(designs) == 3
    for layout, is_best, card in zip(designs, pareto(designs.layouts), cards, strict=True):
        assert datum(card, "number") == str(layout.number)
        assert (datum(card, "best") == "best") == is_best == ("Pareto set" in card)
        for name, value in layout.scores.items():
            assert float(datum(card, name)) == value
            assert f"<dd>{cell(name, layout)}</dd>" in card
        words = words_of(card)
        assert "exactly constrained, proven" in words
        for content in (layout.model.to_deck(), layout.python()):
            assert " ".join(content.split()) in words
        assert f"flexact export {datum(card, 'file')}.dat" in words
    assert "<b>stage</b>" not in text and "XY &lt;b&gt;stage&lt;/b&gt;: three layouts" in text


def test_a_card_brings_the_whole_page_of_its_deck(cards: list[str]) -> None:
    for card in cards:
        found = re.search(r'class="whole">(.*?)</script>', card, re.DOTALL)
        assert found is not None
        body = gzip.decompress(base64.b64decode(found[1])).decode()
        assert "Exactly constrained:" in body and body.count('class="drawing-data"') == 1
        assert "<script>" not in body


def test_what_is_wanted_and_compared_stands_above_the_cards(designs: Designs, text: str) -> None:
    words = words_of(text)
    for line in ("Wanted of the stage", "It takes three constraints", "Wires alone: three"):
        assert line in words
    axes = re.search(r'class="axes">(.*?)</script>', text, re.DOTALL)
    assert axes is not None
    known = {each["key"]: each for each in json.loads(axes[1])["axes"]}
    assert {"worst_stiffness", "drive_stiffness"} <= set(known)
    assert known["worst_stiffness"]["factor"] == 1e-6 and not known["worst_stiffness"]["lower"]
    assert "parts" not in known, "all have three"
    assert re.findall(r'<tr data-number="(\d)">', text) == ["1", "2", "3"]


#: A screw and a rotation that is askew to it, which no coordinates are along.
SKEW = (
    "screw about (0.01, 0, 0) along (1, 2, 2) pitch 0.004",
    "rotation about (0, 0.02, 0) along z",
)


@pytest.mark.parametrize("wanted", [STAGE["wanted"], SKEW], ids=["planar", "skew"])
def test_the_drawing_moves_as_is_wanted(wanted: tuple[str, ...]) -> None:
    """The stage's points have the velocities v + w x (p - c) of the wanted twists."""
    around = {"boxes": [[[-0.1, -0.1, -0.1], [0.1, 0.1, -0.06]], [[0.06, -0.1, -0.1], [0.1] * 3]]}
    made = layouts_of(problem(wanted=list(wanted), ground=around, count=1))
    (layout,) = made.layouts
    analysis = flexact.analyse(layout.model)
    moving = list(wanted_motions(layout, analysis))
    assert [words for words, _ in moving] == [each.text for each in made.problem.wanted]
    arrays = analysis.given.arrays
    (stage,) = (part for part in analysis.parts.all if part.name == "stage")
    ends = arrays.element_node[[0, 2]][:, list(stage.elements)] - 1
    for motion, (_, found) in zip(made.problem.wanted, moving, strict=True):
        w, v = motion.twist[:3], motion.twist[3:]
        for node in np.unique(ends).tolist():
            arm = arrays.node_value[:3, node] - made.problem.centre
            size = np.linalg.norm(motion.twist)
            assert np.allclose(found.displacement[node], v + np.cross(w, arm), atol=1e-9 * size)


def line(flexure: Flexure) -> np.ndarray:
    return np.asarray(flexure.ends[1] - flexure.ends[0])


def test_what_a_wire_holds_is_drawn_along_it(designs: Designs) -> None:
    layout = designs[0]
    for flexure in layout.flexures:
        (drawn,) = hold_shown(flexure, layout.problem, 0.2).lines
        for point in drawn:
            assert np.allclose(np.cross(point - flexure.ends[0], line(flexure)), 0.0, atol=1e-12)
    freedom, held = spaces_of(layout, 0.2)
    assert freedom.shape.is_freedom and not held.shape.is_freedom
    assert len(held.shape.lines) == 3


def test_a_part_that_cannot_be_drawn_is_told_and_the_rest_stays(
    designs: Designs, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fails(*_: object, **__: object) -> None:
        raise FlexactError("there is none")

    monkeypatch.setattr(pages, "motions_data", fails)
    monkeypatch.setattr(pages, "content_of", fails)
    monkeypatch.setattr(pages, "picture_of", lambda *_: None)
    words = words_of(page_of(designs, "stage").decode())
    assert words.count("The drawing is left out") == 3 and "Three wires" in words


def test_over_constraint_is_told_by_words_and_a_sign(designs: Designs) -> None:
    layout = replace(designs[0], over_constrained=1, is_proven=False)
    told = pages.badges(layout, is_best=False)
    assert "over-constrained by 1" in words_of(told) and "Pareto" not in told
    both = (layout, *designs.layouts[1:])
    assert 'name="held"' in pages.finder_of(both, (True, False, True))
    assert 'name="held"' not in pages.finder_of(designs.layouts, (True, False, True))


@pytest.fixture(scope="module")
def nothing() -> Designs:
    limits = {**STAGE["limits"], "length": [0.4, 0.5], "bodies": 0}
    return layouts_of(problem(limits=limits))


def test_without_a_layout_the_page_says_why(nothing: Designs) -> None:
    assert nothing.why_none is not None
    text = page_of(nothing, "stage").decode()
    words = words_of(text)
    assert f"No layout: {nothing.why_none.statement}" in words
    assert "It takes three constraints" in words and text.count('class="drawing-data"') == 2


def test_notebooks_have_a_table_with_pictures(designs: Designs, nothing: Designs) -> None:
    made = designs._repr_html_()
    assert made == html_of(designs)
    assert made.count("<tr>") == 1 + len(designs) and "<b>stage</b>" not in made
    for layout in designs:
        assert cell("worst_stiffness", layout) in made
    assert "No layout" in nothing._repr_html_()


def test_one_layout_is_written_as_whatever_an_analysis_can_be(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "stage.toml"
    file.write_text(FILE)
    for name, start in (("one.html", b"<!DOCTYPE html>"), ("one.step", b"ISO-10303-21;")):
        assert main(["design", str(file), "--apply", "2", "-o", str(tmp_path / name)]) == 0
        assert (tmp_path / name).read_bytes().startswith(start)
    assert main(["design", str(file), "-o", str(tmp_path / "decks")]) == 0
    decks = sorted((tmp_path / "decks").iterdir())
    assert [each.name[:3] for each in decks] == ["01_", "02_"]
    assert flexact.analyse(decks[1]).degrees_of_freedom == 3
    file.write_text(FILE.replace("[0.04, 0.1]", "[0.4, 0.5]\nbodies = 0"))
    assert main(["design", str(file), "-o", str(tmp_path / "none.html")]) == 1
    assert "No layout" in words_of((tmp_path / "none.html").read_text())
    capsys.readouterr()


# Watched


def test_the_first_layout_is_shown_before_the_others(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(watched, "_PAUSE", 0.0)
    file = tmp_path / "stage.toml"
    file.write_text(FILE)
    heard: list[Any] = []
    answer = answer_of(str(file), heard.append)
    assert isinstance(answer, Laid) and answer.is_whole and not is_before(answer)
    assert len(heard) >= 2 and all(map(is_before, heard))
    assert heard[0].words == "one layout so far" and heard[0].body.count('class="card ') == 1
    assert answer.body.count('class="whole"') == answer.body.count('class="card ') == 2
    assert answer.words.startswith("two layouts, the first three wires")
    # What was drawn once is drawn in the same way, so that a page keeps it.
    key = datum(answer.body, "key")
    assert f'data-key="{key}"' in heard[-1].body


def test_errors_of_a_watched_problem_leave_the_cards(tmp_path: Path) -> None:
    file = tmp_path / "stage.toml"
    file.write_text(FILE)
    stage = Stage(file.name, of_layouts=True)
    good = answer_of(str(file), lambda _: None)
    assert stage.put(good) == good.words
    file.write_text(FILE.replace("count = 2", 'count = "two"'))
    broken = answer_of(str(file), lambda _: None)
    assert isinstance(broken, Broken) and broken.in_short == "cannot be read"
    assert "count = &quot;two&quot;" in broken.errors and "^" in broken.errors
    assert "Deck" not in broken.body and "flexact report" not in broken.body
    stage.put(broken)
    assert isinstance(good, Laid)
    assert stage.scene.body == good.body and stage.scene.broken == broken.errors
    assert stage.put(good) == good.words
    assert not stage.scene.broken


def test_what_goes_on_is_told_until_all_is_there() -> None:
    stage = Stage("stage.toml", of_layouts=True)
    stage.work("layouts are sought")
    first = Laid("one", "<p>1</p>", "one layout so far", "", (), is_whole=False)
    stage.put(first)
    assert stage.scene.work and stage.scene.body == first.body
    stage.put(replace(first, words="two layouts", is_whole=True))
    assert not stage.scene.work
    stage.put(replace(first, words="three layouts", is_whole=True))
    assert stage.scene.changed_words == "two layouts \N{RIGHTWARDS ARROW} three layouts"
