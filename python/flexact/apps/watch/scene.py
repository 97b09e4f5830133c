# SPDX-License-Identifier: BSD-3-Clause
"""What the page shows at present, how that differs from before, and whoever waits for more."""

from __future__ import annotations

import threading
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from typing import Any

from ...advice.step import Step
from ...analysis.mode_words import conflict_in_words, motion_in_parts, stress_in_parts
from ...analysis.naming import plain
from ...analysis.result import Motion, Result, SelfStress
from ...analysis.verdict import Certainty
from ...analysis.verdict_words import margin_in_short, verdict_in_short, verdict_word
from ...costs.quick_cost import quick_curve
from ...deck.diagnostics import Diagnostic, Source
from ...deck.rendering import MOST_SHOWN, ProblemsError, render, render_problems
from ...designs.problem import SUFFIXES
from ...motion.constraints import is_followed
from ...show.drawing.movement import MOST_COORDINATES
from ...show.page.assets import MANY_ELEMENTS, text
from ...show.page.content import content_of
from ...show.page.scenery import Scenery
from ...util.partial import attempted, why
from ...util.text import file_name, harmless
from .cad import CadParts
from .editable_model import StepEdit

#: What a script ends with; anything else is a deck.
SCRIPT = ".py"


def is_problem(path: str) -> bool:
    """Whether a file is watched as a design problem."""
    return path.lower().endswith(SUFFIXES)


#: How many motions, and how many self-stresses, are compared.
MOST_COMPARED = 12
#: How many parts of each are compared.
_PARTS = 6


@dataclass(frozen=True)
class ResultSummary:
    """A result in short, as the next one is compared with it.

    Attributes:
        verdict: Such as "over-constrained by 1", with what it is restricted by.
        counts: Numbers by what they count, such as "released deformations".
        margin: Such as "margin 0.3 mm".
        is_doubtful: Whether the rank is.
        motions: Each of the first motions in words.
        stresses: Each of the first self-stresses in words.
    """

    verdict: str
    counts: dict[str, int]
    margin: str
    is_doubtful: bool
    motions: tuple[str, ...]
    stresses: tuple[str, ...]


def summary_of(result: Result) -> ResultSummary:
    """The summary of a result."""
    coordinates, deformations = result.counts
    given = result.given.arrays
    counts = {
        "elements": int(given.element_number.size),
        "nodes": int(given.node_number.size),
        "fixed coordinates": coordinates.fixed,
        "released deformations": deformations.dependent,
        "declared degrees of freedom": result.degrees_of_freedom,
        "motions": result.under_constrained,
        "self-stresses": result.over_constrained,
    }
    return ResultSummary(
        verdict_in_short(result),
        counts,
        margin_in_short(result),
        result.certainty is not Certainty.CERTAIN,
        # The verdict is told all the same where words of modes fail.
        attempted("", lambda: tuple(map(_motion, islice(result.motions, MOST_COMPARED))), (), None),
        attempted(
            "", lambda: tuple(map(_stress, islice(result.self_stresses, MOST_COMPARED))), (), None
        ),
    )


def _motion(motion: Motion) -> str:
    return "; ".join(map(plain, motion_in_parts(motion, _PARTS)[:_PARTS]))


def _stress(stress: SelfStress) -> str:
    parts = conflict_in_words(stress), *stress_in_parts(stress, _PARTS)[:_PARTS]
    return "; ".join(map(plain, parts))


@dataclass(frozen=True)
class Shown:
    """A result as the page shows it.

    Attributes:
        title: Of the page, as text.
        body: What stands within its body.
        summary: Of the result.
        which: Which model of a script it is, in words; empty for a deck.
        problems: Warnings and notes, as the terminal has them.
        files: What it was made of, besides the file that is watched.
        result: The result itself, pickled.
        model: The name of the model in a script; empty for a deck.
        scenery: The solids that it was read from, where it was.
        cad: What may be said of their parts.
        is_whole: Whether that is all; else its motions are drawn along their velocities, and at
            few phases, until they are there.
    """

    title: str
    body: str
    summary: ResultSummary
    which: str
    problems: str
    files: tuple[str, ...]
    result: bytes = b""
    model: str = ""
    scenery: Scenery | None = None
    cad: CadParts | None = None
    is_whole: bool = True


def steps_in(steps: Sequence[Step]) -> tuple[StepEdit, ...]:
    """Steps of the advice as edits, known by their words as the page has them."""
    return tuple(
        StepEdit(
            harmless(plain(each.pieces)),
            f"[{each.number - 1}]" if each.number else f".repairs[{k}]",
            each.change,
        )
        for k, each in enumerate(steps)
    )


def shown_of(
    result: Result,
    summary: ResultSummary,
    which: str,
    files: tuple[str, ...],
    *,
    is_edited: bool = False,
    before: tuple[Result, str] | None = None,
    scenery: Scenery | None = None,
    cad: CadParts | None = None,
    is_whole: bool = True,
) -> Shown:
    """A result as the page shows it.

    Args:
        result: The result.
        summary: Of it.
        which: Which model it is, in words.
        files: What it was made of.
        is_edited: Whether it is not that of the file.
        before: The result before the last step of the advice, and the step in words.
        scenery: The solids that it was read from.
        cad: What may be said of their parts.
        is_whole: Whether motions are followed, and are there at all phases.
    """
    misaligned = attempted("", lambda: quick_curve(result), None, None)
    content = content_of(
        result,
        has_origin=not is_edited,
        before=before,
        misaligned=misaligned,
        scenery=scenery,
        follows=MOST_COORDINATES if is_whole else 0,
        room=None if is_whole else 1,
    )
    title = verdict_word(result)
    given = result.given
    problems = given.problems
    words = render_problems(problems, given.name, given.source) if problems.kept else ""
    return Shown(
        *(title, content.body, summary, which, words, files),
        scenery=scenery,
        cad=cad,
        is_whole=is_whole,
    )


def takes_a_while(result: Result) -> bool:
    """Whether the motions of a result take so long that it is shown before they are all there."""
    if not (result.under_constrained or result.degrees_of_freedom):
        return False
    elements = result.given.arrays.element_number.size
    return elements > MANY_ELEMENTS or is_followed(result.data, MOST_COORDINATES)


@dataclass(frozen=True)
class Laid:
    """Layouts of a design problem as the page shows them.

    Attributes:
        title: Of the page, as text.
        body: What stands within its body.
        words: What was found, in short.
        problems: Remarks on the problem, as the terminal has them.
        files: What it was made of, besides the file that is watched.
        is_whole: Whether that is all; else more is being sought.
    """

    title: str
    body: str
    words: str
    problems: str
    files: tuple[str, ...]
    is_whole: bool


@dataclass(frozen=True)
class Broken:
    """Why there is no result.

    Attributes:
        errors: As HTML.
        body: What stands within the body of a page that has nothing else to show.
        words: As the terminal has them.
        files: As in `Shown`.
        in_short: What cannot be done.
    """

    errors: str
    body: str
    words: str
    files: tuple[str, ...]
    in_short: str = "cannot be analysed"


Answer = Shown | Laid | Broken
#: What comes before an answer: what a script has printed, the summary of a result whose scene is
#: still being made, a result whose motions are still to be followed, and layouts while more are
#: sought.
Before = str | ResultSummary | Shown | Laid


def is_before(heard: Before | Answer) -> bool:
    """Whether an answer is still to come."""
    return isinstance(heard, (str, ResultSummary)) or (
        isinstance(heard, (Shown, Laid)) and not heard.is_whole
    )


def errors_part(error: Exception, path: str) -> str:
    """What is wrong, in full."""
    if not isinstance(error, ProblemsError):
        return f"<p>{text(why(error))}</p>"
    shown = sorted(error.diagnostics, key=lambda item: not item.is_error)[:MOST_SHOWN]
    name = file_name(error.name or path)
    parts = [_problem(item, name, error.source) for item in shown]
    if (more := error.problems.total - len(shown)) > 0:
        parts.append(f'<p class="note">and {more} more problem{"s" * (more > 1)}</p>')
    return "".join(parts)


def _problem(item: Diagnostic, name: str, source: Source | None) -> str:
    head, *excerpt = render(item, name, source).split("\n")
    # Help is a sentence, which breaks into lines as they fit.
    lines = [line for line in excerpt if not line.lstrip().startswith("= help:")]
    severity, _, words = head.partition(": ")
    hint = f'<p class="help">help: {text(item.help)}</p>' if item.help else ""
    # The label is an arrow's word; without a place it stands alone.
    place = f"<pre>{chr(10).join(map(text, lines))}</pre>" if lines else ""
    return (
        f'<div class="told {item.severity}"><b>{text(severity)}</b>: {text(words)}'
        f"{place}{hint}</div>"
    )


_ARROW = "\N{RIGHTWARDS ARROW}"
#: Counts that need no word of their own where the verdict says them.
_IN_VERDICT = ("motions", "self-stresses")


def changed_words(before: ResultSummary, after: ResultSummary) -> str:
    """What has changed from one result to another: "over-constrained by 1 → exactly constrained".

    Where the verdict stays, what else has changed: counts, margin, motions and self-stresses.
    """
    rest = [
        f"{name} {before.counts[name]} {_ARROW} {now}"
        for name, now in after.counts.items()
        if before.counts[name] != now and name not in _IN_VERDICT
    ]
    if before.is_doubtful != after.is_doubtful:
        rest.append(f"the rank is {'now' if after.is_doubtful else 'no longer'} doubtful")
    if before.verdict != after.verdict:
        return "; ".join([f"{before.verdict} {_ARROW} {after.verdict}", *rest])
    if before.margin != after.margin:
        rest.append(f"{before.margin} {_ARROW} {after.margin.removeprefix('margin ')}")
    motions, stresses = after.counts["motions"], after.counts["self-stresses"]
    rest += _modes(("motion", "s"), before.motions, after.motions, motions)
    rest += _modes(("self-stress", "es"), before.stresses, after.stresses, stresses)
    rest = rest or ["nothing has changed that the analysis sees"]
    return "; ".join([f"still {after.verdict}", *rest])


def _modes(
    word: tuple[str, str], before: Sequence[str], after: Sequence[str], count: int
) -> Iterator[str]:
    """How many motions or self-stresses are others than they were."""
    what, ending = word
    new = sum((Counter(after) - Counter(before)).values())
    if not new or len(before) != len(after):
        return
    if count == 1:
        yield f"the {what} is another"
        return
    many = f"{what}{ending}"
    of = f"{count} {many}" if count == len(after) else f"the first {len(after)} {many}"
    yield f"{new} of {of} {'is another' if new == 1 else 'are others'}"


@dataclass(frozen=True)
class Scene:
    """What the page shows.

    Attributes:
        revision: Rises with everything new, also from one server to the next.
        title: Of the page, as text.
        body: The last good scene, or where there never was one the page of the errors, as HTML.
        broken: Errors of the file as it is, as HTML; empty where there are none.
        changed_words: What has changed since the last good scene.
        which: Which model of a script it is.
        saved: When the file was read, on the clock of the wall.
        completes: The revision of a scene that was the same but for its motions; else 0.
        work: What is going on, in words; empty where nothing is.
        began: When that began [s since 1970].
    """

    revision: int
    title: str
    body: str = ""
    broken: str = ""
    changed_words: str = ""
    which: str = ""
    saved: str = ""
    completes: int = 0
    work: str = ""
    began: float = 0.0

    def event(self) -> dict[str, Any]:
        """As a page gets it."""
        return {
            "revision": self.revision,
            "title": self.title,
            "body": self.body,
            "broken": self.broken,
            "changed_words": self.changed_words,
            "which": self.which,
            "saved": self.saved,
            "completes": self.completes,
        }

    def work_event(self) -> dict[str, Any]:
        """What is going on, as a page gets it."""
        past = time.time() - self.began if self.work else 0.0
        return {"work": self.work, "seconds": past}


class Stage:
    """The present scene, which threads may ask for and wait for."""

    def __init__(self, name: str, *, of_layouts: bool = False) -> None:
        """Nothing is shown yet.

        Args:
            name: The file, as a person knows it.
            of_layouts: Whether it is a design problem, whose layouts are shown.
        """
        self._name, self.of_layouts = name, of_layouts
        self._is_good = False
        self._laid = ""
        self._summary: ResultSummary | None = None
        #: Of a scene that is not whole the revision, and the result.
        self._begun: tuple[int, bytes] = (0, b"")
        self._changed = threading.Condition()
        #: What is shown.
        self.scene = Scene(int(time.time() * 1000), name)
        self._closed = False

    def put(self, answer: Answer) -> str:
        """Show an answer; what has changed, or what is wrong in short, in words."""
        before = self.scene
        saved = time.strftime("%H:%M:%S")
        if isinstance(answer, Broken):
            words = answer.in_short
            scene = replace(
                before,
                title=f"{self._name}: {words}",
                body=before.body if self._is_good else answer.body,
                broken=answer.errors,
                saved=saved,
                changed_words="",
            )
        elif isinstance(answer, Laid):
            words, last = answer.words, self._laid
            changed = f"{last} {_ARROW} {words}" if last and last != words else words
            scene = Scene(0, answer.title, answer.body, changed_words=changed, saved=saved)
            self._is_good = True
            if not answer.is_whole:
                # It goes on.
                scene = replace(scene, changed_words=words, work=before.work, began=before.began)
                self._show(replace(scene, revision=before.revision + 1))
                return words
            self._laid = words
        else:
            self._is_good = True
            words = answer.summary.verdict
            is_begun = answer.is_whole and self._begun == (before.revision, answer.result or None)
            completes = before.revision if is_begun else 0
            changed = before.changed_words
            if not completes:
                changed = changed_words(self._summary, answer.summary) if self._summary else ""
            self._summary = answer.summary
            self._begun = (0, b"") if answer.is_whole else (before.revision + 1, answer.result)
            scene = Scene(
                0,
                f"{self._name}: {answer.title}",
                answer.body,
                changed_words=changed,
                which=answer.which,
                saved=before.saved if completes else saved,
                completes=completes,
            )
        self._show(replace(scene, work="", revision=before.revision + 1))
        return words

    def judge(self, summary: ResultSummary) -> None:
        """Say what the verdict will be, before its scene is there."""
        changed = changed_words(self._summary, summary) if self._summary else summary.verdict
        self._show(replace(self.scene, work=f"{changed}; the scene follows"))

    def work(self, words: str) -> None:
        """Say what is going on."""
        self._show(replace(self.scene, work=words, began=time.time()))

    def close(self) -> None:
        """Let nobody wait any more."""
        with self._changed:
            self._closed = True
            self._changed.notify_all()

    def wait(self, seen: Scene | None, longest: float) -> Scene | None:
        """The scene as soon as it is another than `seen`; None at the end.

        After `longest` [s] it is the same.
        """
        with self._changed:
            self._changed.wait_for(lambda: self._closed or self.scene is not seen, longest)
            return None if self._closed else self.scene

    def _show(self, scene: Scene) -> None:
        with self._changed:
            self.scene = scene
            self._changed.notify_all()
