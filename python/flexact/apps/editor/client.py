# SPDX-License-Identifier: BSD-3-Clause
"""What an editor can show, as it says when it starts the server."""

from __future__ import annotations

from typing import Any, NamedTuple

from lsprotocol import types as lsp


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
