# SPDX-License-Identifier: BSD-3-Clause
"""The language server of decks, by pygls: what an editor asks, and who answers."""

from __future__ import annotations

import gc
import logging
from collections.abc import Callable, Generator
from typing import Any, BinaryIO, TypeVar

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException
from pygls.lsp.server import LanguageServer
from pygls.protocol import LanguageServerProtocol, lsp_method

from ...util.version import VERSION
from . import conversion
from .advisor import Advisor
from .answers import Answers
from .background import beside
from .client import Client
from .document import Document, Position
from .editor_deck import Deck
from .fixes import Fixes
from .session import Seen, Session, Work

Made = TypeVar("Made")


class _Protocol(LanguageServerProtocol):
    """Leaves texts to us: lines end where editors end them, and a change costs little."""

    def structure_message(self, data: dict[str, Any]) -> Any:
        """As below; a request of a wrong form is answered, too: an editor may wait for it."""
        try:
            return super().structure_message(data)
        except JsonRpcException as error:
            number = data.get("id")
            if "method" in data and isinstance(number, (int, str)):
                self._send_response(number, error=error.to_response_error())
            raise

    @lsp_method(lsp.TEXT_DOCUMENT_DID_OPEN)
    def lsp_text_document__did_open(
        self, params: lsp.DidOpenTextDocumentParams
    ) -> Generator[Any, Any, None]:
        yield self.fm.features[lsp.TEXT_DOCUMENT_DID_OPEN], (params,), None

    @lsp_method(lsp.TEXT_DOCUMENT_DID_CHANGE)
    def lsp_text_document__did_change(
        self, params: lsp.DidChangeTextDocumentParams
    ) -> Generator[Any, Any, None]:
        yield self.fm.features[lsp.TEXT_DOCUMENT_DID_CHANGE], (params,), None

    @lsp_method(lsp.TEXT_DOCUMENT_DID_CLOSE)
    def lsp_text_document__did_close(
        self, params: lsp.DidCloseTextDocumentParams
    ) -> Generator[Any, Any, None]:
        yield self.fm.features[lsp.TEXT_DOCUMENT_DID_CLOSE], (params,), None


class DeckServer(LanguageServer):
    """The open decks of one editor."""

    def __init__(self, advisor: Advisor) -> None:
        """Nothing is open; steps are found by the advisor."""
        super().__init__("flexact", VERSION, protocol_cls=_Protocol)
        self.client = Client()
        self.sessions: dict[str, Session] = {}
        #: Whether the editor said that it is about to end.
        self.was_shut_down = False
        self._work = Work(advisor)

    def open(self, params: lsp.DidOpenTextDocumentParams) -> None:
        """A deck was opened."""
        item = params.text_document
        encoding = str(getattr(self.workspace.position_encoding, "value", None) or "utf-16")
        document = Document.of(item.text, item.uri, item.version, encoding)
        self.close(item.uri)
        self.sessions[item.uri] = Session(Deck(document), self.tell, self._work)

    def change(self, params: lsp.DidChangeTextDocumentParams) -> None:
        """A deck was changed."""
        item = params.text_document
        session = self.sessions.get(item.uri)
        if session is None:
            return
        document = session.deck.document
        for change in params.content_changes:
            if isinstance(change, lsp.TextDocumentContentChangePartial):
                start, end = self._taken(document, change.range)
                document = document.changed(start, end, change.text, item.version)
            else:
                document = document.replaced(change.text, item.version)
        session.change(Deck(document))

    def close(self, uri: str) -> None:
        """A deck was closed, if it was open."""
        session = self.sessions.pop(uri, None)
        if session is not None:
            session.close()
            self.text_document_publish_diagnostics(lsp.PublishDiagnosticsParams(uri, []))

    def tell(self, seen: Seen) -> None:
        """Send what is known of a deck, unless it is another one by now."""
        document = seen.deck.document
        session = self.sessions.get(document.uri)
        if session is None or session.seen is not seen:
            return
        related = self.client.related
        made = [
            conversion.diagnostic(document, one, with_related=related)
            for one in seen.problems or ()
        ]
        if seen.opinion is not None:
            made.append(conversion.verdict(document, seen.opinion, with_related=related))
        self.text_document_publish_diagnostics(
            lsp.PublishDiagnosticsParams(document.uri, made, document.version)
        )
        if self.client.verdict:
            self.protocol.notify("flexact/verdict", _verdict(seen))

    def deck_of(self, uri: str) -> Deck | None:
        """An open deck as it is now."""
        session = self.sessions.get(uri)
        return session.deck if session is not None else None

    @staticmethod
    def _taken(document: Document, given: lsp.Range) -> tuple[Position, Position]:
        return (
            document.taken(given.start.line, given.start.character),
            document.taken(given.end.line, given.end.character),
        )


def _verdict(seen: Seen) -> dict[str, Any]:
    """What flexact/verdict holds: the words are empty while there is no verdict."""
    opinion, problems = seen.opinion, seen.problems or ()
    errors = sum(one.severity.value == "error" for one in problems)
    verdict = opinion.verdict.value if opinion and opinion.verdict else None
    return {
        "uri": seen.deck.document.uri,
        "version": seen.deck.document.version,
        "words": opinion.words if opinion else "",
        "verdict": verdict,
        "errors": errors,
    }


def make_server(advisor: Advisor) -> DeckServer:
    """A server that answers, and is not started yet."""
    server = DeckServer(advisor)
    answers = Answers(server)

    @server.feature(lsp.INITIALIZE)
    def initialize(params: lsp.InitializeParams) -> None:
        server.client = Client.of(params)

    @server.feature(lsp.SHUTDOWN)
    def shutdown(*_: object) -> None:
        server.was_shut_down = True

    @server.feature(lsp.TEXT_DOCUMENT_DID_OPEN)
    def did_open(params: lsp.DidOpenTextDocumentParams) -> None:
        server.open(params)

    @server.feature(lsp.TEXT_DOCUMENT_DID_CHANGE)
    def did_change(params: lsp.DidChangeTextDocumentParams) -> None:
        server.change(params)

    @server.feature(lsp.TEXT_DOCUMENT_DID_CLOSE)
    def did_close(params: lsp.DidCloseTextDocumentParams) -> None:
        server.close(params.text_document.uri)

    # pygls says of a request that nobody answers that it fails; of these there is nothing to do.
    for quiet in (lsp.WORKSPACE_DID_CHANGE_CONFIGURATION, lsp.TEXT_DOCUMENT_DID_SAVE):
        server.feature(quiet)(_ignore)
    fixes = Fixes(server)
    kinds = lsp.CodeActionOptions([lsp.CodeActionKind.QuickFix], resolve_provider=True)

    @server.feature(lsp.TEXT_DOCUMENT_CODE_ACTION, kinds)
    async def code_action(params: lsp.CodeActionParams) -> list[lsp.CodeAction]:
        return await fixes.actions(params)

    @server.feature(lsp.CODE_ACTION_RESOLVE)
    async def resolve(action: lsp.CodeAction) -> lsp.CodeAction:
        return await fixes.resolve(action)

    for method, answer, options in answers.table():
        server.feature(method, options)(_answering(server, answer))
    return server


def _ignore(*_: object) -> None:
    """Nothing is to be done."""


def _answering(server: DeckServer, answer: Callable[[Deck, Any], Any]) -> Callable[[Any], Any]:
    """Answer in a thread, of the deck as it is when it is asked."""

    async def answered(params: Any) -> Any:
        deck = server.deck_of(params.text_document.uri)
        return None if deck is None else await beside(lambda: answer(deck, params))

    return answered


def serve(stdin: BinaryIO, stdout: BinaryIO, advisor: Advisor) -> bool:
    """Talk with an editor until it ends, or leaves; whether it said that it would."""
    # What pygls has to say of editors is for those who look for it.
    logging.getLogger("pygls").addHandler(logging.NullHandler())
    logging.getLogger("pygls").propagate = False
    # A long deck is a million values that live as long as the deck: no garbage.
    gc.freeze()
    gc.set_threshold(100_000, 50, 50)
    server = make_server(advisor)
    server.start_io(stdin, stdout)
    return server.was_shut_down
