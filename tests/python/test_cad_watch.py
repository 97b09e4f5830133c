# SPDX-License-Identifier: BSD-3-Clause
"""A STEP file that is watched: its solids, what may be said of its parts, where that is kept."""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("OCP")
sys.path.append(str(Path(__file__).resolve().parents[1]))

from browser import Browser
from cad import shapes
from cad.designs import CASES, without_names
from cad.hostile import BORDERLINE
from test_watched_edits import Page as EditedPage
from watched import until, watching

from flexact.apps.convert.cad.kept_choices import names_of_flexure
from flexact.apps.watch import watch as watch_module
from flexact.apps.watch.edit_session import Session
from flexact.apps.watch.scene import Broken, Shown
from flexact.apps.watch.watch import Saved
from flexact.apps.watch.worker import answer_of

pytestmark = pytest.mark.dear(4)


class Page:
    """What a page of a STEP file does: asks, and sees what comes of it."""

    def __init__(self, path: Path, design: str = "guide") -> None:
        self.path = path
        CASES[design]().write(path)
        self.session = Session(path)
        self.read()

    def read(self) -> Shown:
        """Read the file as it is now."""
        answer = answer_of(str(self.path), lambda _: None)
        assert isinstance(answer, Shown), answer.words
        self.session.renewed(answer)
        self.shown = answer
        return answer

    def ask(self, **request: Any) -> Any:
        status, content = self.session.post(json.dumps(request).encode())
        return content if status == 200 else content["error"]

    def rows(self, name: str) -> dict[str, Any]:
        """What may be said of a part, by its words."""
        panel = self.ask(do="look", name=name)["panel"]
        return {row["words"]: row for row in panel["groups"][0]["rows"]}

    def say(self, name: str, words: str, to: str) -> Any:
        (row,) = (each for key, each in self.rows(name).items() if words in key)
        return self.ask(do="set", set=[{**row["place"], "to": to}])

    @property
    def kept(self) -> str:
        return self.path.with_suffix(".flexact.toml").read_text()

    def drawing(self) -> dict[str, Any]:
        data = re.search(r'class="drawing-data">(.*?)</script>', self.shown.body, re.S)
        assert data is not None
        made: dict[str, Any] = json.loads(data[1])
        return made


@pytest.fixture
def page(tmp_path: Path) -> Page:
    return Page(tmp_path / "guide.step")


def test_bodies_are_drawn_as_in_the_cad(page: Page) -> None:
    """Volumes by the divergence theorem are those of OpenCASCADE; the stage alone moves."""
    assert page.shown.scenery is not None
    found = {mesh.name: mesh for mesh in page.shown.scenery.meshes}
    for names, shape in CASES["guide"]().parts[:2]:
        a, b, c = np.moveaxis(found[names[0]].triangles * 1e3, 1, 0)
        volume = np.einsum("ij,ij->", a, np.cross(b, c)) / 6
        assert volume == pytest.approx(shapes.volume(shape), rel=1e-3)
    bodies = page.drawing()["bodies"]
    told = dict(zip(bodies["names"], bodies["carrier"], strict=True))
    assert told["base"][0] == -1
    assert told["stage"][0] >= 0
    assert "4 solids: 2 flexures and 1 moving body" in page.shown.body


def test_a_body_is_made_ground_and_a_motion_declared(page: Page) -> None:
    assert page.shown.summary.verdict == "under-constrained by 1 and over-constrained by 1"
    told = page.say("stage", "along x", "declared")
    assert "Kept in guide.flexact.toml" in told["told"]["said"][0]
    assert '"stage" = { declared = ["x"]' in page.kept
    assert page.read().summary.verdict == "over-constrained by 1"
    row = page.rows("stage")["motion along x"]
    assert (row["now"], row["before"]) == ("declared", "free")
    page.say("stage", "along x", "free")
    page.say("stage", "as a whole", "ground")
    assert page.read().summary.verdict == "under-constrained by 1 and over-constrained by 1"
    assert page.rows("stage")["stage as a whole"]["now"] == "ground"
    assert page.rows("base")["base as a whole"]["now"] == "moves"
    page.say("stage", "as a whole", "moves")
    page.read()
    assert page.rows("base")["base as a whole"]["now"] == "ground"


def test_a_body_whose_motion_is_declared_is_made_ground(page: Page) -> None:
    page.say("stage", "along x", "declared")
    page.read()
    page.say("stage", "as a whole", "ground")
    body = page.read().body
    assert "motions of stage are declared, which stands still" in body
    assert '"stage" = { is = "ground", declared = ["x"]' in page.kept


def test_a_sheet_is_taken_as_a_body_and_back(page: Page) -> None:
    """With one sheet rigid the stage is ground, and the other sheet holds 3 that nothing asks."""
    page.say("sheet 1", "taken as a", "body")
    assert page.read().summary.verdict == "over-constrained by 3"
    page.say("sheet 1", "sheet 1: thin part", "flexure")
    assert "sheet 1" not in page.kept
    assert page.read().summary.verdict == "under-constrained by 1 and over-constrained by 1"


@pytest.mark.parametrize("design", ["guide, monolithic", "five bent sheets, monolithic"])
def test_of_one_piece_a_sheet_is_taken_as_a_body(tmp_path: Path, design: str) -> None:
    """One of several sheets, which have no names in the CAD, and only that one."""
    page = Page(tmp_path / "part.step", design)
    assert page.shown.cad is not None
    flexures = page.shown.cad.now.flexures
    page.say(flexures[0].name, "taken as a", "body")
    page.read()
    assert page.shown.cad is not None
    left = page.shown.cad.now
    assert len(left.flexures) == len(flexures) - 1
    thin = left.candidates[0]
    page.say(left.bodies[0].name, f"{names_of_flexure(left, thin)[0]}: thin part", "flexure")
    assert flexures[0].name not in page.kept
    page.read()
    assert page.shown.cad is not None
    assert len(page.shown.cad.now.flexures) == len(flexures)


def test_what_is_kept_survives_a_new_export(page: Page) -> None:
    """By names where the shape is another, and by the shape where names are others."""
    page.say("stage", "as a whole", "ground")
    design = CASES["guide"]()
    taller = [
        shapes.box((0, 100), (60, 90), (0, 30)) if n == ("stage",) else s for n, s in design.parts
    ]
    parts = tuple((names, shape) for (names, _), shape in zip(design.parts, taller, strict=True))
    replace(design, parts=parts).write(page.path)
    page.read()
    assert page.rows("stage")["stage as a whole"]["now"] == "ground"
    without_names(design).write(page.path)
    shown = page.read()
    assert shown.cad is not None
    (ground,) = (body for body in shown.cad.now.bodies if body.is_ground)
    assert np.allclose(ground.centre * 1e3, (50, 66, 15), atol=0.1)
    assert "which has its shape" in shown.body


def test_what_is_gone_is_told_before_the_verdict(page: Page) -> None:
    page.path.with_suffix(".flexact.toml").write_text('[parts]\nlever = { is = "body" }\n')
    body = page.read().body
    words = "of which the file of choices says something, is not there any more"
    assert words in body
    assert body.index(words) < body.index('class="verdict')


def test_what_cannot_be_said_is_refused_in_words(page: Page) -> None:
    assert "make another body ground" in page.say("base", "as a whole", "moves")
    for given in (
        {"part": "stage", "what": "x", "to": "ground"},
        {"part": "stage", "what": "q", "to": "declared"},
        {"part": ["stage"], "what": ["x"], "to": {}},
    ):
        assert page.ask(do="set", set=[given]) == "this cannot be said of a part"
    gone = {"part": "lever", "what": "ground", "to": "ground"}
    assert "another state of the file" in page.ask(do="set", set=[gone])
    assert not page.path.with_suffix(".flexact.toml").exists()


def test_the_last_flexure_stays_one(page: Page) -> None:
    page.say("sheet 1", "taken as a", "body")
    page.read()
    assert "this is the last flexure" in page.say("sheet 2", "sheet, ", "body")
    page.read()


def test_a_wrong_file_of_choices_is_told(page: Page) -> None:
    page.path.with_suffix(".flexact.toml").write_text("[parts\n")
    answer = answer_of(str(page.path), lambda _: None)
    assert isinstance(answer, Broken)
    assert "guide.flexact.toml: it is no TOML" in answer.words
    # Once it is mended the page follows.
    assert answer.files == (str(page.path.with_suffix(".flexact.toml")),)


def test_a_file_of_choices_that_went_wrong_meanwhile_is_told(page: Page) -> None:
    (row,) = (each for key, each in page.rows("stage").items() if "along x" in key)
    page.path.with_suffix(".flexact.toml").write_text("[parts\n")
    told = page.ask(do="set", set=[{**row["place"], "to": "declared"}])
    assert "it is no TOML" in told


def test_names_with_commands_do_no_harm(tmp_path: Path) -> None:
    page = Page(tmp_path / "guide.step")
    BORDERLINE["names with commands"](page.path, 1)
    shown = page.read()
    assert "<script>alert" not in shown.body.lower()
    assert "<img src=x" not in shown.body
    assert "\x1b" not in shown.body
    assert shown.cad is not None
    moving = next(body for body in shown.cad.now.bodies if not body.is_ground)
    page.say(moving.name, "along x", "declared")
    assert "\x1b" not in page.kept
    assert page.read().summary.verdict == "over-constrained by 1"


def test_names_that_are_those_of_pieces_of_a_part_in_a_model(tmp_path: Path) -> None:
    page = Page(tmp_path / "guide.step")
    BORDERLINE["names that count"](page.path, 1)
    shown = page.read()
    assert shown.cad is not None
    assert {body.name for body in shown.cad.now.bodies} == {"plate (1 of 2)", "plate (2)"}
    moving = next(body for body in shown.cad.now.bodies if not body.is_ground)
    page.say(moving.name, "along x", "declared")
    assert page.read().summary.verdict == "over-constrained by 1"


def test_switches_are_there_as_of_a_deck(page: Page) -> None:
    panel = page.ask(do="look", name="sheet 1")["panel"]
    assert [group["title"] for group in panel["groups"]] == [
        "Kept in guide.flexact.toml",
        "Deformations",
    ]
    place = panel["groups"][1]["rows"][2]["place"]
    told = page.ask(do="set", set=[{**place, "to": "released"}])["told"]
    assert told["verdict"] == "Under-constrained by 1"
    assert told["calls"] == []


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Iterator[list[float]]:
    now = [0.0]
    monkeypatch.setattr(watch_module.time, "monotonic", lambda: now[0])
    yield now


def test_what_is_half_written_is_waited_for(tmp_path: Path, clock: list[float]) -> None:
    """A large file that CAD writes bit by bit, with pauses, is read once it ends as it should."""
    path = tmp_path / "large.step"
    CASES["guide"]().write(path)
    text = path.read_text()
    saved = Saved(str(path))
    for share in range(1, 8):
        path.write_text(text[: share * len(text) // 9])
        for _ in range(5):
            clock[0] += 1.0
            assert not saved.is_renewed()
    path.write_text(text + "\n\n")
    assert not saved.is_renewed()
    clock[0] += 0.1
    assert saved.is_renewed()
    # One that stays so is told of in the end.
    path.write_text(text[: len(text) // 2])
    saved.is_renewed()
    clock[0] += watch_module.WRITING + 1.0
    assert saved.is_renewed()


#: A place of the window where the base is pointed at; null where there is none.
ON_THE_BASE = """
    const {bodies, stage, pointing} = flexact;
    const {left, top} = stage.canvas.getBoundingClientRect();
    for (let at = 0; at < bodies.corner.array.length; at += 9) {
      const middle = [0, 1, 2].map((k) => [0, 3, 6].reduce((sum, i) =>
        sum + bodies.corner.array[at + i + k] / 3, 0));
      const [x, y] = stage.project(...middle), found = pointing.look(x, y);
      if (found && found.kind === "body" && bodies.data.bodies.names[found.row] === "base") {
        return [left + x, top + y];
      }
    }
    return null;
"""


def test_a_solid_is_clicked_and_the_page_follows(browser: Browser, tmp_path: Path) -> None:
    """In the drawing, on a face of the base, which is no part of the model; then a new export."""
    path = tmp_path / "guide.step"
    CASES["guide"]().write(path)
    with watching(path, tmp_path / "state", "--no-browser") as watched:
        until(lambda: len(watched.out) > 1)
        page = EditedPage(browser, watched)
        x, y = browser.run(ON_THE_BASE)
        page.press(x, y)
        page.sees("card", "stands still")
        page.find("stage")
        page.sees("card", "stage as a whole")
        page.click("stage x declared")
        page.sees("said", "Kept in guide.flexact.toml")
        until(lambda: "over-constrained by 1" in page.text("verdict"))
        page.sees("card", "was free")
        # What is not opaque lets what is behind it be seen.
        assert browser.run("return PageData.array(flexact.data.bodies.opacity).every((o) => o < 1)")
        # Solids that are hidden are not pointed at.
        hide = "document.querySelector('[data-layer=solids]').click()"
        browser.run(hide)
        assert browser.run(ON_THE_BASE) is None
        browser.run(hide)
        assert browser.run(ON_THE_BASE) is not None
        lines = len(watched.out)
        CASES["cross hinge of two"]().write(path)
        until(lambda: len(watched.out) > lines)
        # The stage of the new export has the name, and its motion is declared there.
        until(lambda: "4 solids" in str(browser.run("return document.body.innerText")))
        assert not [each for each in browser.console() if "SEVERE" in each and "422" not in each]
