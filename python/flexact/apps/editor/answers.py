# SPDX-License-Identifier: BSD-3-Clause
"""Answers to requests: each is a function of the deck and of what was asked."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException

from . import conversion
from .completion import complete_at
from .document import Document, Position
from .editor_deck import Deck
from .hover import hover_at
from .navigation import RenameError, definition_at, place_at, references_at, rename_at
from .outline import Symbol, folds_of, outline_of

if TYPE_CHECKING:
    from .server import DeckServer

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
