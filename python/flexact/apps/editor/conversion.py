# SPDX-License-Identifier: BSD-3-Clause
"""Our values as those of the language server protocol (lsprotocol)."""

from __future__ import annotations

import re
from collections.abc import Iterable

from lsprotocol import types as lsp

from ...deck.diagnostics import Severity
from .completion import Offers
from .document import Document, Edit, Position, Range
from .outline import Symbol
from .problems import Opinion, Problem, Remark, first_word

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
    where = first_word(document)
    said = Problem(where, Severity.NOTE, "verdict", opinion.words, opinion.remarks)
    return diagnostic(document, said, with_related=with_related)


def markup(text: str, *, is_markdown: bool) -> lsp.MarkupContent:
    """Markdown, or the same as plain text."""
    if is_markdown:
        return lsp.MarkupContent(lsp.MarkupKind.Markdown, text)
    return lsp.MarkupContent(lsp.MarkupKind.PlainText, re.sub(r"[*`]|  (?=\n)", "", text))


def completions(document: Document, offers: Offers, *, snippets: bool) -> lsp.CompletionList:
    """What may stand there, in the order in which it is offered."""
    where = range_of(document, offers.range)
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
        for order, one in enumerate(offers.offers)
    ]
    return lsp.CompletionList(is_incomplete=not offers.is_complete, items=items)


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


def edits(document: Document, ours: Iterable[Edit]) -> lsp.WorkspaceEdit:
    """Edits of one document."""
    made = [lsp.TextEdit(range_of(document, one.range), one.text) for one in ours]
    return lsp.WorkspaceEdit(changes={document.uri: made})
