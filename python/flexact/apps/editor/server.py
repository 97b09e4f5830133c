# SPDX-License-Identifier: BSD-3-Clause
"""The language server of decks, by pygls: what an editor asks, and who answers."""

from __future__ import annotations

import gc
import logging
from collections.abc import Callable, Generator, Iterator
from typing import Any, BinaryIO, NamedTuple, TypeVar

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException
from pygls.lsp.server import LanguageServer
from pygls.protocol import LanguageServerProtocol, lsp_method

from ...util.loading import VERSION
from . import conversion
from .actions import Fixes, Seen, Session, Work, beside
from .completion import complete_at
from .deck import Deck
from .document import Document, Position
from .hover import hover_at
from .outline import (
    RenameError,
    Symbol,
    definition_at,
    folds_of,
    outline_of,
    place_at,
    references_at,
    rename_at,
)
from .problems import Advisor


class Client(NamedTuple):
    """What an editor can show."""

    related: bool = False
    """Places that belong to a diagnostic."""
    markdown: bool = False
    snippets: bool = False
    outline: bool = False
    """An outline with levels."""
    resolves: bool = False
    """Whether it asks for the edit of an action when the action is taken."""
    verdict: bool = False
    """Whether it wants the verdict in messages of its own, flexact/verdict."""

    @classmethod
    def of(cls, params: lsp.InitializeParams) -> Client:
        """The editor that sends this."""
        text = params.capabilities.text_document or lsp.TextDocumentClientCapabilities()
        given = params.initialization_options
        options: dict[str, Any] = given if isinstance(given, dict) else {}
        published, hover = text.publish_diagnostics, text.hover
        item = text.completion.completion_item if text.completion else None
        symbols, action = text.document_symbol, text.code_action
        resolved = action.resolve_support if action else None
        formats = (hover.content_format if hover else None) or []
        return cls(
            related=bool(published and published.related_information)
            and options.get("help") != "message",
            markdown=lsp.MarkupKind.Markdown in formats,
            snippets=bool(item and item.snippet_support),
            outline=bool(symbols and symbols.hierarchical_document_symbol_support),
            resolves=bool(resolved and "edit" in resolved.properties),
            verdict=options.get("verdict") is True,
        )


#: A request that was understood and cannot be fulfilled.
_FAILED = -32803
Answer = Callable[[Deck, Any], Any]


def position_in(document: Document, given: lsp.Position) -> Position:
    """A position as an editor counts, as ours."""
    return document.taken(given.line, given.character)


class Answers:
    """Those to the requests of one editor."""

    def __init__(self, server: DeckServer) -> None:
        """Of the decks that a server has."""
        self.server = server

    def table(self) -> Iterator[tuple[str, Answer, Any]]:
        """What is answered, by whom, and what the editor is told about it."""
        yield lsp.TEXT_DOCUMENT_HOVER, self.hover, None
        yield lsp.TEXT_DOCUMENT_DEFINITION, self.definition, None
        yield lsp.TEXT_DOCUMENT_REFERENCES, self.references, None
        yield lsp.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT, self.highlights, None
        yield lsp.TEXT_DOCUMENT_PREPARE_RENAME, self.prepare_rename, None
        yield lsp.TEXT_DOCUMENT_RENAME, self.rename, lsp.RenameOptions(prepare_provider=True)
        triggers = lsp.CompletionOptions(trigger_characters=[" "])
        yield lsp.TEXT_DOCUMENT_COMPLETION, self.completion, triggers
        yield lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL, self.symbols, None
        yield lsp.TEXT_DOCUMENT_FOLDING_RANGE, self.folds, None

    def hover(self, deck: Deck, params: lsp.HoverParams) -> lsp.Hover | None:
        """What is said of the word at a position."""
        document = deck.document
        found = hover_at(deck, position_in(document, params.position))
        if found is None:
            return None
        words = conversion.markup(found.text, is_markdown=self.server.client.markdown)
        return lsp.Hover(words, conversion.range_of(document, found.range))

    def definition(self, deck: Deck, params: lsp.DefinitionParams) -> list[lsp.Location]:
        """Where a node or an element is made."""
        document = deck.document
        found = definition_at(deck, position_in(document, params.position))
        return [lsp.Location(document.uri, conversion.range_of(document, one)) for one in found]

    def references(self, deck: Deck, params: lsp.ReferenceParams) -> list[lsp.Location]:
        """Where a node or an element is named."""
        document, own = deck.document, params.context.include_declaration
        found = references_at(deck, position_in(document, params.position), own)
        return [lsp.Location(document.uri, conversion.range_of(document, one)) for one in found]

    def highlights(
        self, deck: Deck, params: lsp.DocumentHighlightParams
    ) -> list[lsp.DocumentHighlight]:
        """The same node or element elsewhere."""
        document = deck.document
        found = references_at(deck, position_in(document, params.position))
        return [lsp.DocumentHighlight(conversion.range_of(document, one)) for one in found]

    def prepare_rename(self, deck: Deck, params: lsp.PrepareRenameParams) -> lsp.Range | None:
        """The number that would be changed."""
        place = place_at(deck, position_in(deck.document, params.position))
        return conversion.range_of(deck.document, place.range) if place is not None else None

    def rename(self, deck: Deck, params: lsp.RenameParams) -> lsp.WorkspaceEdit:
        """Another number for a node or an element."""
        try:
            edits = rename_at(deck, position_in(deck.document, params.position), params.new_name)
        except RenameError as error:
            raise JsonRpcException(str(error), _FAILED) from None
        return conversion.edits(deck.document, edits)

    def completion(self, deck: Deck, params: lsp.CompletionParams) -> lsp.CompletionList:
        """What may stand at a position."""
        document, context = deck.document, params.context
        offers = complete_at(deck, position_in(document, params.position))
        is_typed = context and context.trigger_kind == lsp.CompletionTriggerKind.TriggerCharacter
        if is_typed and any(one.kind == "keyword" for one in offers.offers):
            # A blank at the start of a line asks for nothing.
            return lsp.CompletionList(is_incomplete=False, items=[])
        return conversion.completions(document, offers, snippets=self.server.client.snippets)

    def symbols(
        self, deck: Deck, params: lsp.DocumentSymbolParams
    ) -> list[lsp.DocumentSymbol] | list[lsp.SymbolInformation]:
        """The outline."""
        document = deck.document
        if self.server.client.outline:
            return [conversion.symbol(document, one) for one in outline_of(deck)]
        return [
            lsp.SymbolInformation(
                location=lsp.Location(document.uri, conversion.range_of(document, one.range)),
                name=one.name,
                kind=conversion.symbol(document, one._replace(inner=())).kind,
            )
            for one in _flat(outline_of(deck))
        ]

    def folds(self, deck: Deck, _: lsp.FoldingRangeParams) -> list[lsp.FoldingRange]:
        """What folds."""
        return [conversion.fold(one) for one in folds_of(deck)]


def _flat(symbols: tuple[Symbol, ...] | list[Symbol]) -> Iterator[Symbol]:
    for one in symbols:
        yield one
        yield from _flat(one.inner)


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
