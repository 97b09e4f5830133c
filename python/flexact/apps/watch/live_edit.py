# SPDX-License-Identifier: BSD-3-Clause
"""A session of clicking: what was switched in a watched mechanism, and what is asked of it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from http import HTTPStatus
from pathlib import Path
from typing import Any, NamedTuple

from ...analysis.result import Result
from ...analysis.text_margin import margin_in_short, verdict_in_short
from ...model.data import ModelData
from ...model.reading import read_bytes
from ...util.plain_text import harmless
from .calls import Calls
from .editable_model import Board, Edits
from .history import History
from .panel import names, panel_of_element, panel_of_node, place_json, target_named
from .places import Edit, Place, states_of
from .proposals import Proposals, proposals
from .refusal import RefusedError
from .renewing import Renewal
from .saving import free_name, write_deck
from .statements import EditedDeck, edited
from .words import edit_in_words, place_in_words

Json = dict[str, Any]
#: How many switches a request may have.
_MOST = 20_000


class Answer(NamedTuple):
    """The answer to a request."""

    changed: bool
    """Whether the mechanism is to be analysed anew."""
    content: Json
    """What is answered besides."""


class Session:
    """What was switched in a mechanism that is watched, and what comes of it.

    Args:
        watched: The deck or script; new decks are written to its folder.
        model: What the model is called in calls of Python.
    """

    def __init__(self, watched: Path, model: str = "model") -> None:
        """Without a mechanism so far."""
        self.watched, self.model_name = watched, model
        self.history = History()
        self._board: Board | None = None
        self._calls: Calls | None = None
        self._now: Result | None = None
        self._proposed: tuple[Proposals, ...] | None = None
        self._deck: tuple[Edits, EditedDeck] | None = None
        self._is_broken = False
        self._said: tuple[str, ...] = ()

    @property
    def board(self) -> Board:
        """The mechanism as given.

        Raises:
            RefusedError: There is none yet, or the file has errors now.
        """
        if self._board is None and not self._is_broken:
            raise RefusedError("the file is still being analysed", HTTPStatus.CONFLICT)
        if self._board is None or self._is_broken:
            raise RefusedError(
                "nothing can be changed while the file has errors: mend them first",
                HTTPStatus.CONFLICT,
            )
        return self._board

    def broken(self) -> None:
        """Wait for the file, which has errors, to be mended; edits stay."""
        self._is_broken = True

    def renew(self, base: Result) -> tuple[str, ...]:
        """Take the analysis of the file as it is now; edits stay.

        Returns:
            Sentences on edits that are dropped, as their element or node is gone or the file
            says the same now.
        """
        old, self._board = self._board, Board(base)
        self._calls, self._proposed, self._deck = Calls(self._board), None, None
        self._now, self._is_broken, self._said = None, False, ()
        if old is None:
            return ()
        before = self.history.now
        renewal = Renewal(old, self._board)
        self.history.renewed(renewal.edits)
        self._said = tuple(_dropped(old, self._board, renewal, before, self.history.now))
        return self._said

    @property
    def now(self) -> Result:
        """The analysis of the mechanism with all edits; as given where that was not made."""
        return self.board.base if self._now is None else self._now

    @property
    def known(self) -> Result | None:
        """As `now`; None where there is nothing, or the file has errors now."""
        return None if self._board is None or self._is_broken else self.now

    def put_aside(self, why: str) -> None:
        """Take all edits back, as they cannot be analysed with the file as it is now."""
        self.history = History()
        self._said = (f"The changes were put aside: with the file as it is now {why}.",)
        self._now = None

    def model(self) -> ModelData:
        """The mechanism with all edits, of a deck as reading its changed text gives it."""
        if not self.history.now:
            return self.board.given
        if self.board.given.source is None:
            return self.board.model(self.history.now)
        return read_bytes(self.deck().text, self.board.given.name)

    def analysed(self, now: Result) -> None:
        """Take the analysis of the mechanism with all edits."""
        self._now, self._proposed = now, None

    def ask(self, request: object) -> Answer:
        """Do what a request says.

        Args:
            request: A JSON object; "do" is one of "set", "undo", "redo", "reset", "look",
                "save" and "tell".

        Raises:
            RefusedError: It is not understood, or cannot be done; then nothing has changed.
        """
        if not isinstance(request, Mapping):
            raise RefusedError('a JSON object with "do" is wanted')
        what = request.get("do")
        actions = {
            "set": self._set,
            "undo": self._undo,
            "redo": self._redo,
            "reset": self._reset,
            "look": self._look,
            "save": self._save,
            "tell": self._tell,
        }
        if not isinstance(what, str) or what not in actions:
            known = ", ".join(actions)
            raise RefusedError(f'"do" must be one of {known}, not {_short(what)}')
        before = self.history.now
        content = actions[what](request)
        if self.history.now != before:
            self._said = ()
        return Answer(self.history.now != before, content)

    def _set(self, request: Mapping[str, Any]) -> Json:
        given = request.get("set")
        if not isinstance(given, list) or len(given) > _MOST:
            raise RefusedError('"set" must be a list of what is switched')
        new = [self._edit(each) for each in given]
        self.history.take(self.board.edited(self.history.now, new))
        return {}

    def _undo(self, _: Mapping[str, Any]) -> Json:
        self._require_sound()
        self.history.undo()
        return {}

    def _redo(self, _: Mapping[str, Any]) -> Json:
        self._require_sound()
        self.history.redo()
        return {}

    def _reset(self, _: Mapping[str, Any]) -> Json:
        self._require_sound()
        self.history.take(())
        return {}

    def _tell(self, _: Mapping[str, Any]) -> Json:
        return {"told": self.told()}

    def _require_sound(self) -> None:
        """Raise as `board` does."""
        _ = self.board

    def _look(self, request: Mapping[str, Any]) -> Json:
        """What is offered of a part or a point."""
        if "name" in request:
            name = request["name"]
            if not isinstance(name, str):
                raise RefusedError('"name" must be text')
            request = target_named(self.board, name)
        wanted = {
            edit
            for each in self.proposals()
            for item in each.items
            for choice in item.choices
            for edit in choice.edits
        }
        edits = self.history.now
        if "element" in request:
            return {
                "panel": panel_of_element(self.board, edits, _number(request, "element"), wanted)
            }
        if "node" in request:
            return {"panel": panel_of_node(self.board, edits, _number(request, "node"), wanted)}
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

    def deck(self) -> EditedDeck:
        """The deck with all edits, and the lines that differ."""
        edits = self.history.now
        if self._deck is None or self._deck[0] != edits:
            changed = self.board.model(edits)
            self._deck = (edits, edited(self.board.given, changed))
        return self._deck[1]

    def proposals(self) -> tuple[Proposals, ...]:
        """What the advice proposes for the mechanism as it is now."""
        if self._proposed is None:
            self._proposed = proposals(self.board, self.now)
        return self._proposed

    def told(self) -> Json:
        """All that the page shows of the session."""
        if self._board is None or self._is_broken:
            is_ = "broken" if self._is_broken else "none"
            return {"is": is_, "edits": [], "undo": False, "redo": False}
        board, edits, now = self._board, self.history.now, self.now
        return {
            "is": "deck" if board.given.source is not None else "model",
            "verdict": _capital(verdict_in_short(now)),
            "margin": f"{_capital(margin_in_short(now))}.",
            "edits": [
                {"words": edit_in_words(board, each), "place": place_json(each.place)}
                for each in edits
            ],
            "undo": self.history.can_undo,
            "redo": self.history.can_redo,
            "proposals": [
                {
                    "head": each.head,
                    "more": each.more,
                    "items": [
                        {
                            "words": item.words,
                            "place": place_json(item.choices[0].edits[0].place),
                            "choices": [
                                {"word": choice.word, "set": [_edit_json(e) for e in choice.edits]}
                                for choice in item.choices
                            ],
                        }
                        for item in each.items
                    ],
                }
                for each in self.proposals()
            ],
            "names": names(board),
            "said": list(self._said),
            "save": harmless(free_name(self.watched)),
            "folder": harmless(str(self.watched.absolute().parent)),
            **self._how(),
        }

    def _how(self) -> Json:
        """The lines of the deck or the calls of Python that do it, and the text to be copied."""
        edits = self.history.now
        if not edits:
            return {"lines": [], "calls": [], "copy": "", "note": ""}
        if self.board.given.source is None:
            assert self._calls is not None
            calls = [call.in_words(self.model_name) for call in self._calls.of(edits)]
            return {"lines": [], "calls": calls, "copy": "\n".join(calls), "note": ""}
        deck = self.deck()
        note = ""
        if deck.is_anew:
            note = (
                "These changes cannot be made line by line in this deck; a new deck is written "
                "anew, without what an analysis does not use."
            )
        return {
            "lines": [each._asdict() for each in deck.statements],
            "calls": [],
            "copy": "\n".join(each.to_copy() for each in deck.statements),
            "note": note,
        }


def _dropped(
    old: Board, new: Board, renewal: Renewal, before: Edits, after: Edits
) -> Iterator[str]:
    left = {each.place for each in after}
    for each in before:
        place = renewal.place(each.place)
        words = place_in_words(old, each.place)
        if place is None:
            yield f"Dropped, as it is not in the file any more: {words}."
        elif place not in left:
            state = next(w for w, to in states_of(place).items() if to == new.before(place))
            yield f"The file says so itself now: {words} is {state}."


def _edit_json(edit: Edit) -> Json:
    word = next(word for word, to in states_of(edit.place).items() if to == edit.to)
    return {**place_json(edit.place), "to": word}


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
