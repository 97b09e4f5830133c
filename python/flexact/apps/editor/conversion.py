# SPDX-License-Identifier: BSD-3-Clause
"""Our values as those of the language server protocol (lsprotocol)."""

from __future__ import annotations

import re

from lsprotocol import types as lsp

from ...deck.diagnostics import Severity
from .completion import Kind, Offer, Offers
from .document import Document, Edit, Position, Range
from .outline import Fold, Sort, Symbol
from .problems import Opinion, Problem, Remark, first_word

SOURCE = "flexact"
_SEVERITIES = {
    Severity.ERROR: lsp.DiagnosticSeverity.Error,
    Severity.WARNING: lsp.DiagnosticSeverity.Warning,
    Severity.NOTE: lsp.DiagnosticSeverity.Information,
}
_SORTS = {
    Sort.GROUP: lsp.SymbolKind.Namespace,
    Sort.PART: lsp.SymbolKind.Class,
    Sort.ELEMENT: lsp.SymbolKind.Object,
    Sort.POINT: lsp.SymbolKind.Field,
    Sort.STATEMENT: lsp.SymbolKind.Property,
}
_KINDS = {
    Kind.KEYWORD: lsp.CompletionItemKind.Keyword,
    Kind.NUMBER: lsp.CompletionItemKind.Reference,
    Kind.COMPONENT: lsp.CompletionItemKind.EnumMember,
    Kind.WORD: lsp.CompletionItemKind.Value,
}


def position(document: Document, ours: Position) -> lsp.Position:
    """A position as the editor counts."""
    return lsp.Position(*document.given(ours))


def range_of(document: Document, ours: Range) -> lsp.Range:
    """A range as the editor counts."""
    return lsp.Range(position(document, ours.start), position(document, ours.end))


def diagnostic(document: Document, one: Problem, *, with_related: bool) -> lsp.Diagnostic:
    """A problem; where the editor shows no related places, its message says them."""
    return lsp.Diagnostic(
        range=range_of(document, one.range),
        severity=_SEVERITIES[one.severity],
        code=one.code,
        source=SOURCE,
        message=one.message if with_related else _whole(one.message, one.range, one.remarks),
        related_information=_related(document, one.remarks) if with_related else None,
    )


def verdict(document: Document, opinion: Opinion, *, with_related: bool) -> lsp.Diagnostic:
    """The verdict, as an information on the first line."""
    where = first_word(document)
    return lsp.Diagnostic(
        range=range_of(document, where),
        severity=lsp.DiagnosticSeverity.Information,
        code="verdict",
        source=SOURCE,
        message=opinion.words if with_related else _whole(opinion.words, where, opinion.remarks),
        related_information=_related(document, opinion.remarks) if with_related else None,
    )


def _whole(message: str, where: Range, remarks: tuple[Remark, ...]) -> str:
    lines = (
        one.text if one.range == where else f"line {one.range.start.line + 1}: {one.text}"
        for one in remarks
    )
    return "\n".join((message, *lines))


def _related(
    document: Document, remarks: tuple[Remark, ...]
) -> list[lsp.DiagnosticRelatedInformation] | None:
    made = [
        lsp.DiagnosticRelatedInformation(
            lsp.Location(document.uri, range_of(document, one.range)), one.text
        )
        for one in remarks
    ]
    return made or None


def markup(text: str, *, is_markdown: bool) -> lsp.MarkupContent:
    """Markdown, or the same as plain text."""
    if is_markdown:
        return lsp.MarkupContent(lsp.MarkupKind.Markdown, text)
    return lsp.MarkupContent(lsp.MarkupKind.PlainText, re.sub(r"[*`]|  (?=\n)", "", text))


def completions(document: Document, offers: Offers, *, snippets: bool) -> lsp.CompletionList:
    """What may stand there, in the order in which it is offered."""
    where = range_of(document, offers.range)
    items = [_item(one, k, where, snippets) for k, one in enumerate(offers.offers)]
    return lsp.CompletionList(is_incomplete=not offers.is_complete, items=items)


def _item(one: Offer, order: int, where: lsp.Range, snippets: bool) -> lsp.CompletionItem:
    is_snippet = bool(snippets and one.snippet)
    return lsp.CompletionItem(
        label=one.label,
        kind=_KINDS[one.kind],
        detail=one.detail or None,
        documentation=lsp.MarkupContent(lsp.MarkupKind.Markdown, one.about) if one.about else None,
        sort_text=f"{order:05}",
        filter_text=one.label,
        insert_text_format=lsp.InsertTextFormat.Snippet if is_snippet else None,
        text_edit=lsp.TextEdit(where, one.snippet if is_snippet else one.label),
    )


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


def fold(one: Fold) -> lsp.FoldingRange:
    """Lines that fold."""
    kind = lsp.FoldingRangeKind.Comment if one.is_comment else lsp.FoldingRangeKind.Region
    return lsp.FoldingRange(start_line=one.first, end_line=one.last, kind=kind)


def edits(document: Document, ours: list[Edit] | tuple[Edit, ...]) -> lsp.WorkspaceEdit:
    """Edits of one document."""
    made = [lsp.TextEdit(range_of(document, one.range), one.text) for one in ours]
    return lsp.WorkspaceEdit(changes={document.uri: made})
