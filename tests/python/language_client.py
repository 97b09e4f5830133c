# SPDX-License-Identifier: BSD-3-Clause
"""A language client that talks with ``flexact lsp`` over stdio, as editors do.

It shares no code with the server: JSON-RPC with its headers, and UTF-16 unless told otherwise.
"""

from __future__ import annotations

import contextlib
import json
import queue
import subprocess
import sys
import threading
from collections.abc import Callable
from typing import Any

PATIENCE = 60.0
URI = "untitled:Untitled-1"
RICH: dict[str, Any] = {
    "textDocument": {
        "publishDiagnostics": {"relatedInformation": True},
        "hover": {"contentFormat": ["markdown", "plaintext"]},
        "completion": {"completionItem": {"snippetSupport": True}},
        "documentSymbol": {"hierarchicalDocumentSymbolSupport": True},
        "codeAction": {
            "codeActionLiteralSupport": {"codeActionKind": {"valueSet": ["quickfix"]}},
            "resolveSupport": {"properties": ["edit"]},
            "dataSupport": True,
        },
    }
}


class Client:
    """One conversation."""

    def __init__(self, *, start: bool = True, options: Any = None, **capabilities: Any) -> None:
        self.process = subprocess.Popen(
            [sys.executable, "-m", "flexact", "lsp", "--stdio"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
        self.heard: queue.Queue[dict[str, Any] | None] = queue.Queue()
        self.kept: list[dict[str, Any]] = []
        self.number = 0
        threading.Thread(target=self._listen, daemon=True).start()
        if start:
            asked = {"processId": None, "rootUri": None, "capabilities": {**RICH, **capabilities}}
            if options is not None:
                asked["initializationOptions"] = options
            self.able = self.ask("initialize", asked)["capabilities"]
            self.tell("initialized", {})

    def _listen(self) -> None:
        assert self.process.stdout is not None
        stream = self.process.stdout
        while header := stream.readline():
            length = 0
            while header.strip():
                name, _, value = header.partition(b":")
                # Anything but a header here is no protocol.
                assert name in (b"Content-Length", b"Content-Type"), header
                length = int(value) if name == b"Content-Length" else length
                header = stream.readline()
            self.heard.put(json.loads(stream.read(length)))
        self.heard.put(None)

    def _send(self, message: dict[str, Any]) -> None:
        assert self.process.stdin is not None
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n%s" % (len(body), body))
        self.process.stdin.flush()

    def tell(self, method: str, params: Any) -> None:
        self._send({"method": method, "params": params})

    def ask(self, method: str, params: Any) -> Any:
        """The result; an error of the server is an assertion."""
        answer = self.answer(method, params)
        assert "error" not in answer, answer
        return answer["result"]

    def answer(self, method: str, params: Any) -> dict[str, Any]:
        self.number += 1
        mine = self.number
        self._send({"id": mine, "method": method, "params": params})
        return self.wait(lambda one: one.get("id") == mine and "method" not in one)

    def wait(self, wanted: Callable[[dict[str, Any]], bool]) -> dict[str, Any]:
        """The first message, kept or to come, that is wanted."""
        for k, one in enumerate(self.kept):
            if wanted(one):
                return self.kept.pop(k)
        while True:
            heard = self.heard.get(timeout=PATIENCE)
            assert heard is not None, "the server has ended"
            if wanted(heard):
                return heard
            self.kept.append(heard)

    # Documents ---------------------------------------------------------------

    def open(self, text: str, uri: str = URI, version: int = 1) -> None:
        item = {"uri": uri, "languageId": "flexact-deck", "version": version, "text": text}
        self.tell("textDocument/didOpen", {"textDocument": item})

    def change(self, version: int, *changes: dict[str, Any], uri: str = URI) -> None:
        asked = {"textDocument": {"uri": uri, "version": version}, "contentChanges": changes}
        self.tell("textDocument/didChange", asked)

    def diagnostics(self, version: int, *, verdict: bool = False) -> list[dict[str, Any]]:
        """Those of a version; with the verdict, when it is there."""

        def is_mine(one: dict[str, Any]) -> bool:
            if one.get("method") != "textDocument/publishDiagnostics":
                return False
            params = one["params"]
            has = any(each["code"] == "verdict" for each in params["diagnostics"])
            return params.get("version") == version and (has or not verdict)

        found: list[dict[str, Any]] = self.wait(is_mine)["params"]["diagnostics"]
        return found

    def at(self, method: str, line: int, character: int, uri: str = URI, **more: Any) -> Any:
        """The answer to a request at a place."""
        where = {"line": line, "character": character}
        asked = {"textDocument": {"uri": uri}, "position": where, **more}
        return self.ask(f"textDocument/{method}", asked)

    def of(self, method: str, uri: str = URI, **more: Any) -> Any:
        return self.ask(f"textDocument/{method}", {"textDocument": {"uri": uri}, **more})

    # Ending ------------------------------------------------------------------

    def end(self) -> tuple[int, str]:
        """Exit code and stderr of a server that was asked to end."""
        self.ask("shutdown", None)
        self.tell("exit", None)
        return self.ended()

    def ended(self) -> tuple[int, str]:
        code = self.process.wait(PATIENCE)
        assert self.process.stderr is not None
        return code, self.process.stderr.read().decode()

    def kill(self) -> None:
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        for stream in (self.process.stdin, self.process.stdout, self.process.stderr):
            if stream is not None:
                with contextlib.suppress(OSError):
                    stream.close()
