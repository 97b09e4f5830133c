# SPDX-License-Identifier: BSD-3-Clause
"""A session of clicking: what was switched in a watched mechanism, and what the page shows then."""

from __future__ import annotations

import json
import pickle
import threading
from collections.abc import Callable, Iterator, Mapping
from http import HTTPStatus
from pathlib import Path
from typing import Any, NamedTuple

from ...advice.todo import first_steps
from ...analysis.result import Result
from ...analysis.verdict_words import margin_in_short, verdict_in_short
from ...deck.rendering import ProblemsError
from ...model.data import ModelData
from ...model.writing import statements_of
from ...show.page.assets import text
from ...show.page.content import STEPS, kind_of
from ...util.errors import BatchError, FlexactError
from ...util.partial import why
from ...util.text import harmless
from ..convert.cad.kept_choices import choices_beside
from .cad import choose, groups_of, panel_of_body, target_in_cad
from .editable_model import (
    AllEdits,
    Board,
    Boards,
    Edit,
    EditedDeck,
    Edits,
    Place,
    RefusedError,
    Renewal,
    StepEdit,
    free_name,
    state_word,
    states_of,
    write_deck,
)
from .offers import (
    Json,
    edit_in_words,
    names,
    panel_of_element,
    panel_of_node,
    place_in_words,
    place_json,
    proposals,
    target_named,
)
from .scene import Answer, Broken, ResultSummary, Shown, Stage, shown_of, steps_in, summary_of

#: How many steps can be undone.
_MOST_EDITS = 200


class History(NamedTuple):
    """The states of the edits, and which of them holds."""

    states: tuple[AllEdits, ...] = ((),)
    at: int = 0

    @property
    def now(self) -> AllEdits:
        """The edits that hold."""
        return self.states[self.at]

    def taken(self, edits: AllEdits) -> History:
        """With a new state; what was undone is gone."""
        if edits == self.now:
            return self
        states = (*self.states[: self.at + 1], edits)[-_MOST_EDITS - 1 :]
        return History(states, len(states) - 1)

    def moved(self, step: int) -> History:
        """At the state before (-1) or behind (1), if there is one; else where it is."""
        return self._replace(at=min(max(self.at + step, 0), len(self.states) - 1))

    def renewed(self, change: Callable[[AllEdits], AllEdits]) -> History:
        """With every state changed; neighbours that are the same then are one."""
        states: list[AllEdits] = []
        at = 0
        for k, state in enumerate(map(change, self.states)):
            if not states or state != states[-1]:
                states.append(state)
            if k == self.at:
                at = len(states) - 1
        return History(tuple(states), at)


#: How many switches a request may have.
_MOST_SWITCHES = 20_000


class Session:
    """What was switched in a mechanism that is watched; edits stay when the file is saved."""

    def __init__(self, watched: Path, stage: Stage | None = None, model: str = "model") -> None:
        """Without a mechanism so far.

        Args:
            watched: The deck or script; new decks are written to its folder.
            stage: What the page shows; None where nothing is shown.
            model: What the model is called in calls of Python.
        """
        self.watched, self.stage, self.model_name = watched, stage or Stage(watched.name), model
        self.history = History()
        self._boards: Boards | None = None
        self._now: Result | None = None
        self._steps: tuple[StepEdit, ...] | None = None
        self._proposed: list[Json] | None = None
        self._deck: tuple[AllEdits, EditedDeck] | None = None
        self._is_broken = False
        self._said: tuple[str, ...] = ()
        self._lock = threading.Lock()
        #: The file as it is, until somebody clicks.
        self._file: Shown | None = None
        self._is_taken = True
        self._number = 0

    @property
    def board(self) -> Board:
        """The mechanism as given, or as the last step of the advice has made it.

        Raises:
            RefusedError: There is none yet, or the file has errors now.
        """
        return self.boards.of(self.history.now)

    @property
    def boards(self) -> Boards:
        """The mechanism as given, and what steps have made of it; raises as `board` does."""
        if self._boards is not None and not self._is_broken:
            return self._boards
        words = "the file is still being analysed"
        if self._is_broken:
            words = "nothing can be changed while the file has errors: mend them first"
        raise RefusedError(words, HTTPStatus.CONFLICT)

    # The file as it is saved

    def renewed(self, answer: Shown | Broken) -> str:
        """Show what came of the file, with all edits; what has changed, in words."""
        with self._lock:
            if self.history.now and isinstance(answer, Shown) and not answer.is_whole:
                # With edits it is another scene, which follows.
                return ""
            self._number += 1
            if isinstance(answer, Broken):
                self.broken()
                return self.stage.put(answer)
            self._file, self._is_taken = answer, False
            if not self.history.now:
                return self.stage.put(answer)
            try:
                self._take()
                now = self._analysed()
                # The file may say all of it itself now.
                if not self.history.now:
                    return self.stage.put(answer)
                shown = self._with_edits(now, summary_of(now), self._before())
            except (FlexactError, MemoryError) as error:
                # The edits cannot be analysed with the file as it is now.
                self.history = History()
                words = f"with the file as it is now {_in_short(error)}"
                self._said = (f"The changes were put aside: {words}.",)
                self._now = None
                shown = answer
            return self.stage.put(shown)

    def broken(self) -> None:
        """Wait for the file, which has errors, to be mended; edits stay."""
        self._is_broken = True

    def judged(self, summary: ResultSummary) -> None:
        """Say the verdict of the file, unless edits give another one."""
        if not self.history.now:
            self.stage.judge(summary)

    def renew(self, base: Result) -> tuple[str, ...]:
        """Take the analysis of the file as it is now; edits stay.

        Returns:
            Sentences on edits that are dropped, as their element or node is gone or the file
            says the same now.
        """
        old, self._boards = self._boards, Boards(base)
        self._proposed = self._deck = self._steps = None
        self._now, self._is_broken, self._said = None, False, ()
        if old is not None:
            before = self.history
            said: dict[AllEdits, tuple[str, ...]] = {}
            renewed = {edits: _renewed(old, self._boards, edits, said) for edits in before.states}
            self.history = before.renewed(renewed.__getitem__)
            self._said = said[before.now]
        return self._said

    def _take(self) -> None:
        """Take the analysis of the file, as soon as somebody clicks.

        Raises:
            FlexactError: The model holds what the script alone can make, such as its classes.
        """
        if self._file is not None and not self._is_taken:
            try:
                base: Result = pickle.loads(self._file.result)
            except Exception as error:
                words = f"this model cannot be switched: {harmless(' '.join(str(error).split()))}"
                raise BatchError(words) from error
            self._is_taken = True
            self.model_name = self._file.model or "model"
            self.renew(base)

    # The mechanism with all edits

    @property
    def now(self) -> Result:
        """The analysis of the mechanism with all edits; as given where that was not made."""
        return self.boards.base if self._now is None else self._now

    def model(self) -> ModelData:
        """The mechanism with all edits."""
        return self.boards.model(self.history.now)

    def analysed(self, now: Result) -> None:
        """Take the analysis of the mechanism with all edits."""
        self._now, self._proposed, self._steps = now, None, None

    def _analysed(self) -> Result:
        """The analysis with all edits.

        Raises:
            FlexactError: The mechanism cannot be analysed.
            MemoryError: It is too large.
        """
        now = self._result_of(self.history.now)
        self.analysed(now)
        return now

    def _result_of(self, edits: AllEdits) -> Result:
        """The analysis with some edits; behind a step it is there already."""
        below, top = self.boards.split(edits)
        return self.boards.analysed(self.boards.model(edits)) if top else self.boards.of(below).base

    def deck(self) -> EditedDeck:
        """The deck with all edits, and the lines that differ."""
        edits = self.history.now
        if self._deck is None or self._deck[0] != edits:
            self._deck = (edits, self.boards.deck(self.boards.model(edits)))
        return self._deck[1]

    def steps(self) -> tuple[StepEdit, ...]:
        """The first steps of the advice for the mechanism as it is now."""
        if self._steps is None:
            self._steps = steps_in(first_steps(self.now, STEPS) or ())
        return self._steps

    def proposals(self) -> list[Json]:
        """What the advice proposes for the mechanism as it is now."""
        if self._proposed is None:
            self._proposed = proposals(self.board, self.now)
        return self._proposed

    # Requests of the page

    def post(self, body: bytes) -> tuple[HTTPStatus, Json]:
        """Answer a request; its errors are in words.

        The verdict is in the answer, and the scene follows.
        """
        with self._lock:
            try:
                self._take()
            except FlexactError as error:
                return HTTPStatus.UNPROCESSABLE_ENTITY, {"error": str(error)}
            before = self.history
            status, content = self.answered(body)
            if self.history.now != before.now:
                try:
                    self._show(self._analysed())
                except (FlexactError, MemoryError) as error:
                    self.history = before
                    words = f"this cannot be analysed: {_in_short(error)}"
                    return HTTPStatus.UNPROCESSABLE_ENTITY, {"error": words}
                content["told"] = self.told()
            return status, content

    def _show(self, now: Result) -> None:
        """Show a result, unless another one comes meanwhile."""
        self._number += 1
        number, before = self._number, self._before()
        if not self.history.now and self._file is not None:
            self.stage.put(self._file)
            return

        def show() -> None:
            try:
                summary = summary_of(now)
                with self._lock:
                    if number != self._number:
                        return
                    self.stage.judge(summary)
                shown: Answer = self._with_edits(now, summary, before)
            except Exception as error:
                words = _in_short(error)
                shown = Broken(text(words), text(words), words, ())
            with self._lock:
                if number == self._number:
                    self.stage.put(shown)

        threading.Thread(target=show, daemon=True).start()

    def _before(self) -> tuple[Result, str] | None:
        """The analysis before the last step of the advice, if that was the last edit; its words."""
        last = self.history.now[-1] if self.history.now else None
        if not isinstance(last, StepEdit):
            return None
        return self._result_of(self.history.now[:-1]), last.words

    def _with_edits(
        self, now: Result, summary: ResultSummary, before: tuple[Result, str] | None
    ) -> Shown:
        """What the page shows of a result with edits."""
        assert self._file is not None
        count = len(self.history.now)
        changes = f"with {count} change{'s' * (count > 1)} that the file does not have"
        which = f"{self._file.which}, {changes}" if self._file.which else changes
        file = self._file
        return shown_of(
            *(now, summary, which, file.files),
            is_edited=True,
            before=before,
            scenery=file.scenery,
            cad=file.cad,
        )

    def answered(self, body: bytes) -> tuple[HTTPStatus, Json]:
        """Do what the body of a request says; what it cannot is told in words, as "error"."""
        try:
            try:
                request = json.loads(body)
            except (ValueError, RecursionError):
                raise RefusedError("the request is no JSON", HTTPStatus.BAD_REQUEST) from None
            return HTTPStatus.OK, self.ask(request)
        except RefusedError as error:
            return error.status, {"error": str(error)}

    def ask(self, request: object) -> Json:
        """Do what a request says; what is answered.

        Args:
            request: A JSON object; "do" is one of "set", "try", "undo", "redo", "reset",
                "look", "save" and "tell".

        Raises:
            RefusedError: It is not understood, or cannot be done; then nothing has changed.
        """
        if not isinstance(request, Mapping):
            raise RefusedError('a JSON object with "do" is wanted')
        actions: dict[str, Callable[[Mapping[str, Any]], Json]] = {
            "set": self._set,
            "try": self._try,
            **dict.fromkeys(("undo", "redo", "reset"), self._step),
            "look": self._look,
            "save": self._save,
            "tell": lambda _: {"told": self.told()},
        }
        what = request.get("do")
        if not isinstance(what, str) or what not in actions:
            known = ", ".join(actions)
            raise RefusedError(f'"do" must be one of {known}, not {_short(what)}')
        before = self.history.now
        content = actions[what](request)
        if self.history.now != before:
            self._said = ()
        return content

    def _step(self, request: Mapping[str, Any]) -> Json:
        """Go through the history, where the file has no errors."""
        _ = self.board
        steps = {"undo": self.history.moved(-1), "redo": self.history.moved(1)}
        self.history = steps.get(request["do"]) or self.history.taken(())
        return {}

    def _set(self, request: Mapping[str, Any]) -> Json:
        given = request.get("set")
        if not isinstance(given, list) or len(given) > _MOST_SWITCHES:
            raise RefusedError('"set" must be a list of what is switched')
        cad = None if self._file is None else self._file.cad
        if cad is not None and any(isinstance(each, Mapping) and "part" in each for each in given):
            try:
                for each in given:
                    choose(cad, self.watched, each)
            except BatchError as error:
                raise RefusedError(harmless(str(error))) from None
            kept = harmless(choices_beside(self.watched).name)
            self._said = (f"Kept in {kept}; the page follows.",)
            return {"told": self.told()}
        new = [self._edit(each) for each in given]
        below, top = self.boards.split(self.history.now)
        self.history = self.history.taken((*below, *self.board.edited(top, new)))
        return {}

    def _try(self, request: Mapping[str, Any]) -> Json:
        """Do a step of the advice, which is known by its words."""
        step = next((one for one in self.steps() if one.words == request.get("step")), None)
        if step is None:
            raise RefusedError("this step is of another state of the mechanism: take one of now")
        self.history = self.history.taken((*self.history.now, step))
        return {}

    def _look(self, request: Mapping[str, Any]) -> Json:
        """What is offered of a part or a point."""
        cad = None if self._file is None else self._file.cad
        if "name" in request:
            name = request["name"]
            if not isinstance(name, str):
                raise RefusedError('"name" must be text')
            request = (
                target_named(self.board, name)
                if cad is None
                else target_in_cad(cad, self.board, name)
            )
        items = (item for each in self.proposals() for item in each["items"])
        wanted = [edit for item in items for choice in item["choices"] for edit in choice["set"]]
        if cad is not None and "body" in request:
            return {"panel": panel_of_body(cad, self.board, str(request["body"]), self.watched)}
        for key, panel in (("element", panel_of_element), ("node", panel_of_node)):
            if key in request:
                number = _number(request, key)
                _, top = self.boards.split(self.history.now)
                made = panel(self.board, top, number, wanted)
                if cad is not None:
                    groups = list(groups_of(cad, made["name"], self.watched))
                    made = {**made, "groups": [*groups, *made["groups"]], "kept": bool(groups)}
                return {"panel": made}
        raise RefusedError('"element", "node" or "name" is wanted')

    def _save(self, request: Mapping[str, Any]) -> Json:
        name, over = request.get("name"), request.get("over", False)
        if not isinstance(name, str) or not isinstance(over, bool):
            raise RefusedError('"name" must be text, and "over" true or false')
        written = write_deck(self.watched, name, self.deck().text, over=over)
        return {"saved": harmless(written.name)}

    def _edit(self, given: object) -> Edit:
        if not isinstance(given, Mapping):
            raise RefusedError("what is switched is a JSON object")
        place = self._place(given)
        to = given.get("to")
        states = states_of(place)
        if to == "given":
            return Edit(place, self.board.before(place))
        if not isinstance(to, str) or to not in states:
            raise RefusedError(f'"to" must be one of {", ".join(states)}, not {_short(to)}')
        return Edit(place, states[to])

    def _place(self, given: Mapping[str, Any]) -> Place:
        if "element" in given:
            return self.board.deformation(_number(given, "element"), _number(given, "deformation"))
        name = given.get("coordinate")
        if not isinstance(name, str):
            raise RefusedError('"element" and "deformation", or "node" and "coordinate" are wanted')
        return self.board.coordinate(_number(given, "node"), name)

    def told(self) -> Json:
        """All that the page shows of the session."""
        if self._boards is None or self._is_broken:
            is_ = "broken" if self._is_broken else "none"
            return {"is": is_, "edits": [], "undo": False, "redo": False}
        board, now = self.board, self.now
        return {
            "is": "deck" if board.given.source is not None else "model",
            "verdict": _capital(verdict_in_short(now)),
            "margin": f"{_capital(margin_in_short(now))}.",
            "edits": list(self._edits()),
            "undo": self.history.moved(-1) != self.history,
            "redo": self.history.moved(1) != self.history,
            "proposals": self.proposals(),
            "names": names(board),
            "said": list(self._said),
            "save": harmless(free_name(self.watched)),
            "folder": harmless(str(self.watched.absolute().parent)),
            **self._how(),
            "kind": kind_of(now)[0],
        }

    def _edits(self) -> Iterator[Json]:
        """Each edit in words; what is behind the last step, with its place, can be taken away."""
        edits = self.history.now
        below, _ = self.boards.split(edits)
        for k, each in enumerate(edits):
            if isinstance(each, StepEdit):
                yield {"words": each.words}
                continue
            place = {"place": place_json(each.place)} if k >= len(below) else {}
            yield {"words": edit_in_words(self.boards.of(edits[:k]), each), **place}

    def _how(self) -> Json:
        """The lines of the deck or the calls of Python that do it, and the text to be copied."""
        edits, made = self.history.now, {"lines": [], "calls": [], "copy": "", "note": ""}
        if not edits:
            return made
        if self._file is not None and self._file.cad is not None:
            note = "A STEP file does not hold these changes: save them as a new deck."
            return {**made, "note": note}
        if self.board.given.source is None:
            calls = self.boards.calls(edits, self.model_name)
            return {**made, "calls": calls, "copy": "\n".join(calls)}
        deck = self.deck()
        note = ""
        if deck.is_anew:
            note = (
                "These changes cannot be made line by line in this deck; a new deck is written "
                "anew, without what an analysis does not use."
            )
        return {
            **made,
            "lines": [each._asdict() for each in deck.statements],
            "copy": "\n".join(each.to_copy() for each in deck.statements),
            "note": note,
        }


def _renewed(
    old: Boards, new: Boards, edits: AllEdits, said: dict[AllEdits, tuple[str, ...]]
) -> AllEdits:
    """Edits of a mechanism as those of the one in its place; `said` gets what is dropped."""
    if not edits:
        said[edits] = ()
        return ()
    below, top = old.split(edits)
    if top:
        made = _renewed(old, new, below, said)
        renewal = Renewal(old.of(below), new.of(made))
        kept = renewal.edits(top)
        said[edits] = (*said[below], *_dropped(renewal, top, kept))
        return (*made, *kept)
    step = below[-1]
    made = _renewed(old, new, below[:-1], said)
    try:
        after, before = new.of((*made, step)).given, new.model(made)
        is_new = dict(statements_of(after)) != dict(statements_of(before))
        words = "The file says so itself now"
    except (KeyError, FlexactError):
        is_new, words = False, "Dropped, as what it changes is not in the file any more"
    assert isinstance(step, StepEdit)
    said[edits] = said[below[:-1]] + (() if is_new else (f"{words}: {step.words}",))
    return (*made, step) if is_new else made


def _dropped(renewal: Renewal, before: Edits, after: Edits) -> Iterator[str]:
    left = {each.place for each in after}
    for each in before:
        place = renewal.place(each.place)
        words = place_in_words(renewal.old, each.place)
        if place is None:
            yield f"Dropped, as it is not in the file any more: {words}."
        elif place not in left:
            state = state_word(place, renewal.new.before(place))
            yield f"The file says so itself now: {words} is {state}."


def _number(given: Mapping[str, Any], key: str) -> int:
    number = given.get(key)
    if isinstance(number, bool) or not isinstance(number, int):
        raise RefusedError(f'"{key}" must be a whole number, not {_short(number)}')
    return number


def _capital(words: str) -> str:
    return words[:1].upper() + words[1:]


def _short(given: object) -> str:
    words = harmless(repr(given))
    return words if len(words) <= 40 else f"{words[:37]}..."


def _in_short(error: Exception) -> str:
    if isinstance(error, ProblemsError) and error.diagnostics:
        return harmless(error.diagnostics[0].message)
    return harmless(why(error))
