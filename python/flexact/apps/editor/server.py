# SPDX-License-Identifier: BSD-3-Clause
"""The language server of decks, by pygls: what an editor asks, and what it is answered."""

from __future__ import annotations

import asyncio
import contextlib
import gc
import logging
import re
from collections.abc import Callable, Generator, Iterable
from functools import partial
from types import SimpleNamespace
from typing import Any, BinaryIO

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException
from pygls.lsp.server import LanguageServer
from pygls.protocol import LanguageServerProtocol, lsp_method

from ...deck.diagnostics import Severity
from ...util.errors import FlexactError
from ...util.loading import VERSION
from .actions import edits_of, mends_of, remedies_at
from .completion import Offers, complete_at
from .deck import Deck, Document, Edit, Position, Range
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
from .session import OneAtATime, Opinion, Problem, Remark, Seen, Session, beside

_SEVERITIES = {
    Severity.ERROR: lsp.DiagnosticSeverity.Error,
    Severity.WARNING: lsp.DiagnosticSeverity.Warning,
    Severity.NOTE: lsp.DiagnosticSeverity.Information,
}
_SORTS = {
    "group": lsp.SymbolKind.Namespace,
    "part": lsp.SymbolKind.Class,
    "element": lsp.SymbolKind.Object,
    "point": lsp.SymbolKind.Field,
    "statement": lsp.SymbolKind.Property,
}
_KINDS = {
    "keyword": lsp.CompletionItemKind.Keyword,
    "number": lsp.CompletionItemKind.Reference,
    "component": lsp.CompletionItemKind.EnumMember,
    "word": lsp.CompletionItemKind.Value,
}


def position_in(document: Document, given: lsp.Position) -> Position:
    """A position as the editor counts, as ours."""
    return document.taken(given.line, given.character)


def range_of(document: Document, ours: Range) -> lsp.Range:
    """A range as the editor counts."""
    return lsp.Range(*(lsp.Position(*document.given(each)) for each in ours))


def locations(document: Document, ours: Iterable[Range]) -> list[lsp.Location]:
    """Some ranges of a document."""
    return [lsp.Location(document.uri, range_of(document, one)) for one in ours]


def diagnostic(document: Document, one: Problem, *, with_related: bool) -> lsp.Diagnostic:
    """A problem; where the editor shows no related places, its message says them."""
    message, related = one.message, None
    if not with_related:
        message = "\n".join((message, *(_remark(each, one.range) for each in one.remarks)))
    elif one.remarks:
        places = locations(document, (each.range for each in one.remarks))
        related = [
            lsp.DiagnosticRelatedInformation(place, each.text)
            for place, each in zip(places, one.remarks, strict=True)
        ]
    return lsp.Diagnostic(
        range=range_of(document, one.range),
        severity=_SEVERITIES[one.severity],
        code=one.code,
        source="flexact",
        message=message,
        related_information=related,
    )


def _remark(one: Remark, where: Range) -> str:
    """A remark on a problem that stands in a place."""
    return one.text if one.range == where else f"line {one.range.start.line + 1}: {one.text}"


def verdict(document: Document, opinion: Opinion, *, with_related: bool) -> lsp.Diagnostic:
    """The verdict, as an information on the first line."""
    first, last = re.search(r"^\s*(\S*)", document.bare[0]).span(1)  # type: ignore[union-attr]
    where = Range.within(0, first, last)
    said = Problem(where, Severity.NOTE, "verdict", opinion.words, opinion.remarks)
    return diagnostic(document, said, with_related=with_related)


def markup(text: str, *, is_markdown: bool) -> lsp.MarkupContent:
    """Markdown, or the same as plain text."""
    if is_markdown:
        return lsp.MarkupContent(lsp.MarkupKind.Markdown, text)
    return lsp.MarkupContent(lsp.MarkupKind.PlainText, re.sub(r"[*`]|  (?=\n)", "", text))


def completions(document: Document, found: Offers, *, snippets: bool) -> lsp.CompletionList:
    """What may stand there, in the order in which it is offered."""
    place, offers, is_complete = found
    where = range_of(document, place)
    items = [
        lsp.CompletionItem(
            label=one.label,
            kind=_KINDS[one.kind],
            detail=one.detail or None,
            documentation=markup(one.about, is_markdown=True) if one.about else None,
            sort_text=f"{order:05}",
            filter_text=one.label,
            insert_text_format=lsp.InsertTextFormat.Snippet if snippets and one.snippet else None,
            text_edit=lsp.TextEdit(where, (snippets and one.snippet) or one.label),
        )
        for order, one in enumerate(offers)
    ]
    return lsp.CompletionList(is_incomplete=not is_complete, items=items)


def symbol(document: Document, one: Symbol) -> lsp.DocumentSymbol:
    """An entry of the outline with those below it."""
    return lsp.DocumentSymbol(
        name=one.name,
        detail=one.detail or None,
        kind=_SORTS[one.sort],
        range=range_of(document, one.range),
        selection_range=range_of(document, one.own),
        children=[symbol(document, each) for each in one.inner] or None,
    )


def flat_symbols(document: Document, some: Iterable[Symbol]) -> list[lsp.SymbolInformation]:
    """Entries of the outline and those below them, for an editor that shows no levels."""
    made = []
    for one in some:
        (place,) = locations(document, [one.range])
        made.append(lsp.SymbolInformation(location=place, name=one.name, kind=_SORTS[one.sort]))
        made += flat_symbols(document, one.inner)
    return made


def workspace_edit(document: Document, ours: Iterable[Edit]) -> lsp.WorkspaceEdit:
    """Edits of one document."""
    made = [lsp.TextEdit(range_of(document, one.range), one.text) for one in ours]
    return lsp.WorkspaceEdit(changes={document.uri: made})


#: A request that was understood and cannot be fulfilled.
_FAILED = -32803
#: Seconds to wait for steps that are asked for.
_PATIENCE = 15.0


def client_of(params: lsp.InitializeParams) -> SimpleNamespace:
    """What an editor can show, each true or false.

    Attributes:
        related: Places that belong to a diagnostic.
        markdown: Likewise.
        snippets: Likewise.
        outline: An outline with levels.
        resolves: Whether it asks for the edit of an action when the action is taken.
        verdict: Whether it wants the verdict in messages of its own, flexact/verdict.
    """
    text = params.capabilities.text_document or lsp.TextDocumentClientCapabilities()
    given = params.initialization_options
    options: dict[str, Any] = given if isinstance(given, dict) else {}
    published, hover = text.publish_diagnostics, text.hover
    item = text.completion.completion_item if text.completion else None
    symbols, action = text.document_symbol, text.code_action
    resolved = action.resolve_support if action else None
    return SimpleNamespace(
        related=bool(published and published.related_information)
        and options.get("help") != "message",
        markdown=lsp.MarkupKind.Markdown in ((hover.content_format if hover else None) or []),
        snippets=bool(item and item.snippet_support),
        outline=bool(symbols and symbols.hierarchical_document_symbol_support),
        resolves=bool(resolved and "edit" in resolved.properties),
        verdict=options.get("verdict") is True,
    )


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

    def __init__(self) -> None:
        """Nothing is open."""
        super().__init__("flexact", VERSION, protocol_cls=_Protocol)
        self.client = client_of(lsp.InitializeParams(lsp.ClientCapabilities()))
        self.sessions: dict[str, Session] = {}
        #: Whether the editor said that it is about to end.
        self.was_shut_down = False
        self._queue = OneAtATime()

    def open(self, params: lsp.DidOpenTextDocumentParams) -> None:
        """A deck was opened."""
        item = params.text_document
        encoding = str(getattr(self.workspace.position_encoding, "value", None) or "utf-16")
        document = Document.of(item.text, item.uri, item.version, encoding)
        self.close(item.uri)
        self.sessions[item.uri] = Session(Deck(document), self.tell, self._queue)

    def change(self, params: lsp.DidChangeTextDocumentParams) -> None:
        """A deck was changed."""
        item = params.text_document
        session = self.sessions.get(item.uri)
        if session is None:
            return
        document = session.deck.document
        for change in params.content_changes:
            if isinstance(change, lsp.TextDocumentContentChangePartial):
                start = position_in(document, change.range.start)
                end = position_in(document, change.range.end)
                document = document.changed(start, end, change.text, item.version)
            else:
                document = Document.of(change.text, document.uri, item.version, document.encoding)
        session.change(Deck(document))

    def close(self, uri: str) -> None:
        """A deck was closed, if it was open."""
        session = self.sessions.pop(uri, None)
        if session is not None:
            session.close()
            self.text_document_publish_diagnostics(lsp.PublishDiagnosticsParams(uri, []))

    def tell(self, seen: Seen) -> None:
        """Send what is known of a deck, unless it is another one by now."""
        document, opinion, problems = seen.deck.document, seen.opinion, seen.problems or ()
        session = self.sessions.get(document.uri)
        if session is None or session.seen is not seen:
            return
        related = self.client.related
        made = [diagnostic(document, one, with_related=related) for one in problems]
        if opinion is not None:
            made.append(verdict(document, opinion, with_related=related))
        self.text_document_publish_diagnostics(
            lsp.PublishDiagnosticsParams(document.uri, made, document.version)
        )
        if self.client.verdict:
            # The words are empty while there is no verdict.
            about = {
                "uri": document.uri,
                "version": document.version,
                "words": opinion.words if opinion else "",
                "verdict": opinion.verdict.value if opinion and opinion.verdict else None,
                "errors": sum(one.severity.value == "error" for one in problems),
            }
            self.protocol.notify("flexact/verdict", about)

    def hover(self, deck: Deck, params: lsp.HoverParams) -> lsp.Hover | None:
        """What is said of the word at a position."""
        found = hover_at(deck, position_in(deck.document, params.position))
        if found is None:
            return None
        words = markup(found[0], is_markdown=self.client.markdown)
        return lsp.Hover(words, range_of(deck.document, found[1]))

    def completion(self, deck: Deck, params: lsp.CompletionParams) -> lsp.CompletionList:
        """What may stand at a position."""
        document, context = deck.document, params.context
        offers = complete_at(deck, position_in(document, params.position))
        is_typed = context and context.trigger_kind == lsp.CompletionTriggerKind.TriggerCharacter
        if is_typed and any(one.kind == "keyword" for one in offers[1]):
            # A blank at the start of a line asks for nothing.
            return lsp.CompletionList(is_incomplete=False, items=[])
        return completions(document, offers, snippets=self.client.snippets)

    def symbols(
        self, deck: Deck, _: lsp.DocumentSymbolParams
    ) -> list[lsp.DocumentSymbol] | list[lsp.SymbolInformation]:
        """The outline."""
        found = outline_of(deck)
        if not self.client.outline:
            return flat_symbols(deck.document, found)
        return [symbol(deck.document, one) for one in found]

    async def actions(self, params: lsp.CodeActionParams) -> list[lsp.CodeAction]:
        """What can be done at a place."""
        session = self.sessions.get(params.text_document.uri)
        only = params.context.only
        if session is None or (only and lsp.CodeActionKind.QuickFix not in only):
            return []
        seen = session.seen
        if params.context.trigger_kind != lsp.CodeActionTriggerKind.Automatic:
            with contextlib.suppress(asyncio.TimeoutError, TimeoutError):
                await asyncio.wait_for(seen.is_done.wait(), _PATIENCE)
        return await beside(lambda: self._fixes(seen, params.range))

    def _fixes(self, seen: Seen, where: lsp.Range) -> list[lsp.CodeAction]:
        document, related = seen.deck.document, self.client.related
        first, last = sorted((where.start.line, where.end.line))
        made = []
        for problem in seen.problems or ():
            if not first <= problem.range.start.line <= last:
                continue
            shown = diagnostic(document, problem, with_related=related)
            mends = list(mends_of(seen.deck, problem))
            for title, edit in mends:
                action = _fix(title, shown)
                action.edit = workspace_edit(document, [edit])
                action.is_preferred = len(mends) == 1 or None
                made.append(action)
        if seen.advice is None or seen.opinion is None:
            return made
        shown = verdict(document, seen.opinion, with_related=related)
        for title, step, choice in remedies_at(seen.deck, seen.advice, first, last):
            action = _fix(title, shown)
            made.append(action)
            if self.client.resolves:
                action.data = {
                    "uri": document.uri,
                    "version": document.version,
                    "step": step,
                    "choice": choice,
                }
            else:
                _fill(seen, action, step, choice)
        return made

    async def resolve(self, action: lsp.CodeAction) -> lsp.CodeAction:
        """The edit of an action; none where the deck is another one by now."""
        data: Any = action.data
        session = self.sessions.get(str(data.get("uri"))) if isinstance(data, dict) else None
        if session is None or session.deck.document.version != data.get("version"):
            return action
        seen, step, choice = session.seen, data.get("step"), data.get("choice")
        if isinstance(step, int) and isinstance(choice, int):
            await beside(lambda: _fill(seen, action, step, choice))
        return action


def _fix(title: str, about: lsp.Diagnostic) -> lsp.CodeAction:
    return lsp.CodeAction(title=title, kind=lsp.CodeActionKind.QuickFix, diagnostics=[about])


def _fill(seen: Seen, action: lsp.CodeAction, step: int, choice: int) -> None:
    """Give an action the edit of a step of the advice."""
    if seen.advice is None or not 1 <= step <= len(seen.advice.steps):
        return
    with contextlib.suppress(FlexactError):
        edits = edits_of(seen.deck, seen.advice, step, choice)
        action.edit = workspace_edit(seen.deck.document, edits)


def _definition(deck: Deck, params: lsp.DefinitionParams) -> list[lsp.Location]:
    """Where a node or an element is made."""
    found = definition_at(deck, position_in(deck.document, params.position))
    return locations(deck.document, found)


def _references(deck: Deck, params: lsp.ReferenceParams) -> list[lsp.Location]:
    """Where a node or an element is named."""
    own = params.context.include_declaration
    found = references_at(deck, position_in(deck.document, params.position), own)
    return locations(deck.document, found)


def _highlights(deck: Deck, params: lsp.DocumentHighlightParams) -> list[lsp.DocumentHighlight]:
    """The same node or element elsewhere."""
    found = references_at(deck, position_in(deck.document, params.position))
    return [lsp.DocumentHighlight(range_of(deck.document, one)) for one in found]


def _prepare_rename(deck: Deck, params: lsp.PrepareRenameParams) -> lsp.Range | None:
    """The number that would be changed."""
    place = place_at(deck, position_in(deck.document, params.position))
    return range_of(deck.document, place[1]) if place is not None else None


def _rename(deck: Deck, params: lsp.RenameParams) -> lsp.WorkspaceEdit:
    """Another number for a node or an element."""
    try:
        edits = rename_at(deck, position_in(deck.document, params.position), params.new_name)
    except RenameError as error:
        raise JsonRpcException(str(error), _FAILED) from None
    return workspace_edit(deck.document, edits)


def _folds(deck: Deck, _: lsp.FoldingRangeParams) -> list[lsp.FoldingRange]:
    """What folds."""
    kinds = lsp.FoldingRangeKind.Region, lsp.FoldingRangeKind.Comment
    return [
        lsp.FoldingRange(start_line=first, end_line=last, kind=kinds[is_comment])
        for first, last, is_comment in folds_of(deck)
    ]


def make_server() -> DeckServer:
    """A server that answers, and is not started yet."""
    server = DeckServer()

    def initialize(params: lsp.InitializeParams) -> None:
        server.client = client_of(params)

    def shut_down(*_: object) -> None:
        server.was_shut_down = True

    def close(params: lsp.DidCloseTextDocumentParams) -> None:
        server.close(params.text_document.uri)

    def ignore(*_: object) -> None:
        """Nothing is to be done; pygls says of a request that nobody answers that it fails."""

    fixes = lsp.CodeActionOptions([lsp.CodeActionKind.QuickFix], resolve_provider=True)
    handlers: list[tuple[str, Callable[..., Any], Any]] = [
        (lsp.INITIALIZE, initialize, None),
        (lsp.SHUTDOWN, shut_down, None),
        (lsp.TEXT_DOCUMENT_DID_OPEN, lambda params: server.open(params), None),
        (lsp.TEXT_DOCUMENT_DID_CHANGE, lambda params: server.change(params), None),
        (lsp.TEXT_DOCUMENT_DID_CLOSE, close, None),
        (lsp.WORKSPACE_DID_CHANGE_CONFIGURATION, ignore, None),
        (lsp.TEXT_DOCUMENT_DID_SAVE, ignore, None),
        (lsp.TEXT_DOCUMENT_CODE_ACTION, partial(DeckServer.actions, server), fixes),
        (lsp.CODE_ACTION_RESOLVE, partial(DeckServer.resolve, server), None),
    ]
    blank = lsp.CompletionOptions(trigger_characters=[" "])
    answers: list[tuple[str, Callable[[Deck, Any], Any], Any]] = [
        (lsp.TEXT_DOCUMENT_HOVER, server.hover, None),
        (lsp.TEXT_DOCUMENT_DEFINITION, _definition, None),
        (lsp.TEXT_DOCUMENT_REFERENCES, _references, None),
        (lsp.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT, _highlights, None),
        (lsp.TEXT_DOCUMENT_PREPARE_RENAME, _prepare_rename, None),
        (lsp.TEXT_DOCUMENT_RENAME, _rename, lsp.RenameOptions(prepare_provider=True)),
        (lsp.TEXT_DOCUMENT_COMPLETION, server.completion, blank),
        (lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL, server.symbols, None),
        (lsp.TEXT_DOCUMENT_FOLDING_RANGE, _folds, None),
    ]
    handlers += [(method, _answering(server, give), options) for method, give, options in answers]
    for method, handler, options in handlers:
        server.feature(method, options)(handler)
    return server


def _answering(server: DeckServer, answer: Callable[[Deck, Any], Any]) -> Callable[[Any], Any]:
    """Answer in a thread, of the deck as it is when it is asked."""

    async def answered(params: Any) -> Any:
        session = server.sessions.get(params.text_document.uri)
        if session is None:
            return None
        deck = session.deck
        return await beside(lambda: answer(deck, params))

    return answered


def serve(stdin: BinaryIO, stdout: BinaryIO) -> bool:
    """Talk with an editor until it ends, or leaves; whether it said that it would."""
    # What pygls has to say of editors is for those who look for it.
    logging.getLogger("pygls").addHandler(logging.NullHandler())
    logging.getLogger("pygls").propagate = False
    # A long deck is a million values that live as long as the deck: no garbage.
    gc.freeze()
    gc.set_threshold(100_000, 50, 50)
    server = make_server()
    server.start_io(stdin, stdout)
    return server.was_shut_down
