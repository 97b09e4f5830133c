# SPDX-License-Identifier: BSD-3-Clause
"""What mends a deck at a place: the help of a problem, and steps of the advice."""

from __future__ import annotations

import asyncio
import contextlib
import difflib
import re
import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

from lsprotocol import types as lsp

from ...analysis.change import Change
from ...analysis.naming import plain
from ...model.editing import edited_deck
from ...util.errors import FlexactError
from ...util.text import harmless
from . import conversion
from .deck import ELEMENT, NODE, Deck, Key
from .document import Document, Edit, Position, Range, split
from .problems import Advice, Advisor, Opinion, Problem, Step, advice_on, opinion_on, problems_of

if TYPE_CHECKING:
    from .server import DeckServer


Made = TypeVar("Made")


async def beside(work: Callable[[], Made]) -> Made:
    """What some work gives, which runs in a thread of its own while others are answered."""
    return await asyncio.shield(_started(work))


def _started(work: Callable[[], Made]) -> asyncio.Future[Made]:
    loop = asyncio.get_running_loop()
    future: asyncio.Future[Made] = loop.create_future()
    # Nobody may be left to hear of it.
    future.add_done_callback(lambda done: done.cancelled() or done.exception())

    def tell(made: Made | None, error: BaseException | None) -> None:
        if future.done():
            return
        if error is not None:
            future.set_exception(error)
        else:
            future.set_result(made)  # type: ignore[arg-type]

    def run() -> None:
        made, error = None, None
        try:
            made = work()
        except BaseException as caught:
            error = caught
        if not loop.is_closed():
            loop.call_soon_threadsafe(tell, made, error)

    threading.Thread(target=run, name="flexact", daemon=True).start()
    return future


class OneAtATime:
    """Long work, of which the next starts when the last has ended, wanted or not.

    The core cannot be stopped halfway; so no more than one processor is busy for nothing.
    """

    def __init__(self) -> None:
        """Nothing is going on."""
        self._last: asyncio.Future[object] | None = None

    async def run(self, work: Callable[[], Made]) -> Made:
        """Wait for what is going on, then do the work; a task that is cancelled starts nothing."""
        while self._last is not None and not self._last.done():
            await asyncio.wait([self._last])
        future = _started(work)
        self._last = future  # type: ignore[assignment]
        return await asyncio.shield(future)


_MEANT = re.compile(r"^did you mean ([!-~]+)\?$")
_LONGEST_TITLE = 160
#: Lines old times lines new up to which both are compared line by line.
_MOST_COMPARED = 4_000_000


class Mend(NamedTuple):
    """An edit that mends a problem."""

    title: str
    edits: tuple[Edit, ...]


class Remedy(NamedTuple):
    """A step of the advice, or one of the choices that symmetry gives it."""

    title: str
    step: int
    """From 1."""
    choice: int
    """From 1."""
    makes_exact: bool


def mends_of(deck: Deck, problem: Problem) -> list[Mend]:
    """Edits that do what the help of a problem says."""
    meant = _MEANT.match(problem.help)
    if meant is not None:
        return [Mend(f"write {meant[1]}", (Edit(problem.range, meant[1]),))]
    at = problem.range.start
    if problem.code == "missing-end":
        start = Position(at.line, 0)
        ending = deck.document.ending
        return [Mend("write END before it", (Edit(Range(start, start), f"END{ending}"),))]
    if problem.code == "bad-comment":
        text = deck.document.bare[at.line]
        if text[at.character : at.character + 1] == ";":
            here = Range.within(at.line, at.character, at.character + 1)
            return [Mend("write % instead", (Edit(here, "%"),))]
    if problem.code == "duplicate-element" and deck.document.bare[at.line].strip():
        free = str(deck.index.free(ELEMENT))
        says = deck.statements.at(at.line).says
        if says.element is not None and says.number(1) is not None:
            return [Mend(f"number it {free}", (Edit(deck.statements.at(at.line).span(1), free),))]
    if problem.code == "class-conflict":
        places = [problem.range, *(one.range for one in problem.remarks)]
        return list(_without_one(deck, dict.fromkeys(places)))
    return []


def _without_one(deck: Deck, places: dict[Range, None]) -> Iterator[Mend]:
    """Of two statements of a class, one keeps what both say; the other one's word goes."""
    for range_ in places:
        line = range_.start.line
        statement = deck.statements.at(line)
        says = statement.says
        place = says.word_at(range_.start.character)
        if place is None or not says.words:
            continue
        if place > 1 and len(says.words) > 3:
            start = says.words[place - 1].last
            edit = Edit(Range.within(line, start, says.words[place].last), "")
            title = f"take {says.words[place].text} out of {says.name} in line {line + 1}"
        elif len(says.words) <= 3:
            # Without a component all would be meant: the whole statement goes.
            edit = Edit(Range.within(line, says.words[0].first, says.words[-1].last), "")
            title = f"take {' '.join(word.text for word in says.words)} out, line {line + 1}"
        else:
            continue
        yield Mend(title, (edit,))


def remedies_at(deck: Deck, advice: Advice, first: int, last: int) -> list[Remedy]:
    """Steps that are about what stands in some lines; all of them in the first line."""
    keys = {
        (one.kind, one.number)
        for line in range(max(first, 0), min(last + 1, len(deck.document.bare)))
        for one in deck.statements.at(line).says.facts.references[:1]
    }
    made = []
    for step in advice.steps:
        for choice, change in enumerate((step.change, *step.alternatives), start=1):
            if (first == 0 and choice == 1) or keys & _touched(change):
                made.append(_remedy(step, choice, change))
    return made


def _touched(change: Change) -> set[Key]:
    """The elements and nodes that a change is about."""
    elements = [one[0] for one in change.deformations] + [one[0] for one in change.vectors]
    nodes = [one[0] for one in change.coordinates] + [one[0] for one in change.places]
    return {*((ELEMENT, number) for number in elements), *((NODE, number) for number in nodes)}


def _remedy(step: Step, choice: int, change: Change) -> Remedy:
    words = harmless(plain(step.pieces))
    alike = words.partition("; likewise")[0].rstrip(".")
    if choice > 1:
        named = ", ".join([f"{kind} {number}" for kind, number in sorted(_touched(change))][:4])
        alike = f"{alike}: likewise at {named}"
    outcome = step.outcome
    room = _LONGEST_TITLE - len(outcome) - 2
    if len(alike) > room:
        alike = f"{alike[: room - 3]}..."
    return Remedy(f"{alike}: {outcome}", step.number, choice, outcome == "exactly constrained")


def edits_of(deck: Deck, advice: Advice, step: int, choice: int) -> list[Edit]:
    """What a step changes in the deck; all else stays to the letter.

    Raises:
        ModelError: there is no such step or choice.
        IndexError: likewise.
    """
    given = advice.analysis.given
    changed = advice.steps[step - 1].apply(choice)
    return edits_between(deck.document, edited_deck(given, changed.data).decode("utf-8"))


def edits_between(document: Document, text: str) -> list[Edit]:
    """What makes a document the same as a text, line by line; its line ends stay."""
    old = document.bare
    new = [line.rstrip("\r\n") for line in split(text.removeprefix("\ufeff"))]
    if document.text.startswith("\ufeff"):
        new[0] = " " + new[0]
    head = 0
    while head < min(len(old), len(new)) and old[head] == new[head]:
        head += 1
    tail = 0
    while tail < min(len(old), len(new)) - head and old[-1 - tail] == new[-1 - tail]:
        tail += 1
    mine, its = old[head : len(old) - tail], new[head : len(new) - tail]
    if len(mine) * len(its) > _MOST_COMPARED:
        return [_edit(document, head, len(old) - tail, its)]
    matcher = difflib.SequenceMatcher(None, mine, its, autojunk=False)
    return [
        _edit(document, head + i, head + j, its[k:m])
        for tag, i, j, k, m in matcher.get_opcodes()
        if tag != "equal"
    ]


def _edit(document: Document, first: int, behind: int, new: list[str]) -> Edit:
    """Lines in the place of others, `behind` being the first that stays."""
    ending = document.ending
    end_of = [len(line) for line in document.bare]
    if behind < len(end_of) and first < behind == first + len(new):
        last = behind - 1
        return Edit(Range(Position(first, 0), Position(last, end_of[last])), ending.join(new))
    if behind < len(end_of):
        text = "".join(line + ending for line in new)
        return Edit(Range(Position(first, 0), Position(behind, 0)), text)
    end = Position(len(end_of) - 1, end_of[-1])
    if first == 0:
        return Edit(Range(Position(0, 0), end), ending.join(new))
    start = Position(first - 1, end_of[first - 1])
    return Edit(Range(start, end), "".join(ending + line for line in new))


#: Seconds without a change after which a deck is read, then analysed; and of large ones.
_READ, _ANALYSE = 0.08, 0.35
_LINES_OF_LARGE, _OF_LARGE = 20_000, 0.4


@dataclass
class Seen:
    """What is known of a deck at one moment.

    Attributes:
        deck: The deck.
        problems: What is wrong with it; None while it is not read.
        opinion: The verdict; None while there is none.
        advice: Steps that mend it; None while or where there are none.
        is_done: Whether nothing more will come.
    """

    deck: Deck
    problems: list[Problem] | None = None
    opinion: Opinion | None = None
    advice: Advice | None = None
    is_done: asyncio.Event = field(default_factory=asyncio.Event)


@dataclass(frozen=True)
class Work:
    """What all sessions share.

    Attributes:
        advisor: Who finds steps.
        queue: Where what takes long waits for its turn.
    """

    advisor: Advisor
    queue: OneAtATime = field(default_factory=OneAtATime)


class Session:
    """The states of one open deck; what comes too late is dropped."""

    def __init__(self, deck: Deck, tell: Callable[[Seen], None], work: Work) -> None:
        """Start to look at it; `tell` is called when something is known."""
        self._tell, self._work = tell, work
        self._task: asyncio.Task[None] | None = None
        self.seen = Seen(deck)
        self.change(deck, is_new=True)

    @property
    def deck(self) -> Deck:
        """The deck as it is now."""
        return self.seen.deck

    def change(self, deck: Deck, is_new: bool = False) -> None:
        """The deck as it is from now on."""
        self.close()
        self.seen = Seen(deck)
        self._task = asyncio.get_running_loop().create_task(self._look(self.seen, is_new))

    def close(self) -> None:
        """Look no more."""
        if self._task is not None:
            self._task.cancel()
        self.seen.is_done.set()

    async def _look(self, seen: Seen, is_new: bool) -> None:
        try:
            deck = seen.deck
            is_large = len(deck.document.lines) > _LINES_OF_LARGE
            rest = _OF_LARGE if is_large else 0.0
            await asyncio.sleep(0.0 if is_new else _READ + rest)
            seen.problems = await beside(lambda: problems_of(deck))
            self._tell(seen)
            if deck.data is None:
                return
            await asyncio.sleep(_ANALYSE + rest)
            seen.opinion = await self._work.queue.run(lambda: opinion_on(deck))
            self._tell(seen)
            opinion = seen.opinion
            if opinion is not None and opinion.result is not None:
                seen.advice = await self._work.queue.run(
                    lambda: advice_on(opinion, self._work.advisor)
                )
        finally:
            seen.is_done.set()


#: Seconds to wait for steps that are asked for.
_PATIENCE = 15.0


class Fixes:
    """Quick fixes for one editor."""

    def __init__(self, server: DeckServer) -> None:
        """Of the decks that a server has."""
        self.server = server

    async def actions(self, params: lsp.CodeActionParams) -> list[lsp.CodeAction]:
        """What can be done at a place."""
        session = self.server.sessions.get(params.text_document.uri)
        only = params.context.only
        if session is None or (only and lsp.CodeActionKind.QuickFix not in only):
            return []
        seen = session.seen
        if params.context.trigger_kind != lsp.CodeActionTriggerKind.Automatic:
            with contextlib.suppress(asyncio.TimeoutError, TimeoutError):
                await asyncio.wait_for(seen.is_done.wait(), _PATIENCE)
        return await beside(lambda: self._found(seen, params.range))

    def _found(self, seen: Seen, where: lsp.Range) -> list[lsp.CodeAction]:
        deck, related = seen.deck, self.server.client.related
        document = deck.document
        first, last = sorted((where.start.line, where.end.line))
        made = []
        for problem in seen.problems or ():
            if not first <= problem.range.start.line <= last:
                continue
            shown = conversion.diagnostic(document, problem, with_related=related)
            for mend in mends_of(deck, problem):
                made.append(
                    lsp.CodeAction(
                        title=mend.title,
                        kind=lsp.CodeActionKind.QuickFix,
                        diagnostics=[shown],
                        edit=conversion.edits(document, mend.edits),
                        is_preferred=len(mends_of(deck, problem)) == 1 or None,
                    )
                )
        if seen.advice is not None:
            remedies = remedies_at(deck, seen.advice, first, last)
            made += [self._step(seen, one) for one in remedies]
        return made

    def _step(self, seen: Seen, remedy: Remedy) -> lsp.CodeAction:
        assert seen.opinion is not None
        document = seen.deck.document
        shown = conversion.verdict(document, seen.opinion, with_related=self.server.client.related)
        action = lsp.CodeAction(
            title=remedy.title, kind=lsp.CodeActionKind.QuickFix, diagnostics=[shown]
        )
        if self.server.client.resolves:
            action.data = {
                "uri": document.uri,
                "version": document.version,
                "step": remedy.step,
                "choice": remedy.choice,
            }
        else:
            self._fill(seen, action, remedy.step, remedy.choice)
        return action

    async def resolve(self, action: lsp.CodeAction) -> lsp.CodeAction:
        """The edit of an action; none where the deck is another one by now."""
        data: Any = action.data
        if not isinstance(data, dict):
            return action
        session = self.server.sessions.get(str(data.get("uri")))
        if session is None or session.deck.document.version != data.get("version"):
            return action
        seen, step, choice = session.seen, data.get("step"), data.get("choice")
        if isinstance(step, int) and isinstance(choice, int):
            await beside(lambda: self._fill(seen, action, step, choice))
        return action

    @staticmethod
    def _fill(seen: Seen, action: lsp.CodeAction, step: int, choice: int) -> None:
        if seen.advice is None or not 1 <= step <= len(seen.advice.steps):
            return
        try:
            edits = edits_of(seen.deck, seen.advice, step, choice)
        except FlexactError:
            return
        action.edit = conversion.edits(seen.deck.document, edits)
