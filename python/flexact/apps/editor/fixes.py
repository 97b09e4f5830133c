# SPDX-License-Identifier: BSD-3-Clause
"""Quick fixes: mends of problems, and steps of the advice when they are there."""

from __future__ import annotations

import asyncio
import contextlib
from typing import TYPE_CHECKING, Any

from lsprotocol import types as lsp

from ...util.errors import FlexactError
from . import conversion
from .actions import Remedy, edits_of, mends_of, remedies_at
from .background import beside
from .session import Seen

if TYPE_CHECKING:
    from .server import DeckServer

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
