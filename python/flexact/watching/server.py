# SPDX-License-Identifier: BSD-3-Clause
"""The server of a page that is watched: for this machine, and who knows the address."""

from __future__ import annotations

import errno
import json
import os
import socketserver
from collections.abc import Callable
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any
from urllib.parse import parse_qs, urlsplit

from ..base.errors import BatchError, reason_of
from .guard import ADDRESS, is_token, port_of, refusal, token_of
from .live_page import live_page
from .scene import Scene, Stage

#: A line that goes now and then, to find out who has gone [s].
_BEAT = 10.0
#: A page comes back so soon when its line has broken [ms].
_RETRY = 500
#: Bytes of a request that is taken.
_LARGEST = 2**20

#: Answers the body of what a page sends: status and JSON.
Post = Callable[[bytes], tuple[HTTPStatus, dict[str, Any]]]


class Server(ThreadingHTTPServer):
    """Serves the page of a stage, its events, and what a page may send."""

    daemon_threads = True
    # Elsewhere than here it would let two servers have one port.
    allow_reuse_address = os.name == "posix"

    def __init__(self, path: str, stage: Stage, port: int | None = None) -> None:
        """Take a port.

        Args:
            path: The file that is watched.
            stage: What is shown.
            port: The port; by default one that is free, if it can be the one of the last time.

        Raises:
            BatchError: The port cannot be had.
        """
        self.stage = stage
        self.token = token_of(path)
        #: By the last part of the address.
        self.posts: dict[str, Post] = {}
        for tried in (port_of(path), 0) if port is None else (port,):
            try:
                super().__init__((ADDRESS, tried), Handler)
                return
            except (OSError, OverflowError) as error:
                why = error
        raise BatchError(_why(why, port))

    def server_bind(self) -> None:
        """As below, without asking the network what this machine is called."""
        socketserver.TCPServer.server_bind(self)
        self.server_name, self.server_port = ADDRESS, self.server_address[1]

    @property
    def address(self) -> str:
        """Of the page."""
        return f"http://{ADDRESS}:{self.server_port}/{self.token}/"

    def handle_error(self, request: Any, client_address: Any) -> None:
        """A page that has gone is no error."""


def _why(error: OSError | OverflowError, port: int | None) -> str:
    if isinstance(error, OSError) and error.errno == errno.EADDRINUSE:
        return f"port {port} is taken by another program; leave out --port to have a free one"
    if isinstance(error, OSError) and error.errno == errno.EACCES:
        return f"port {port} is not for everyone; leave out --port to have a free one"
    reason = reason_of(error) if isinstance(error, OSError) else str(error)
    return f"no port of this machine can be had: {reason}"


class Handler(BaseHTTPRequestHandler):
    """One request."""

    server: Server
    protocol_version = "HTTP/1.1"
    server_version = "flexact"
    sys_version = ""
    timeout = 60.0

    def do_GET(self) -> None:
        """The page, or its events."""
        rest = self._admitted(writes=False)
        if rest == "":
            scene = self.server.stage.scene
            self._answer(live_page(scene).encode("utf-8", "backslashreplace"), "text/html")
        elif rest == "events":
            self._events()
        elif rest is not None:
            self._refuse(HTTPStatus.NOT_FOUND, "there is nothing here")

    def do_POST(self) -> None:
        """What a page sends."""
        rest = self._admitted(writes=True)
        if rest is None:
            return
        post = self.server.posts.get(rest)
        if post is None:
            self._refuse(HTTPStatus.NOT_FOUND, "there is nothing here")
            return
        try:
            length = int(self.headers.get("Content-Length", ""))
        except ValueError:
            length = -1
        if not 0 <= length <= _LARGEST:
            self._refuse(HTTPStatus.REQUEST_ENTITY_TOO_LARGE, "that is too much")
            return
        try:
            status, answer = post(self.rfile.read(length))
        except Exception as error:
            status = HTTPStatus.INTERNAL_SERVER_ERROR
            answer = {"error": f"this went wrong, and nothing was changed: {error!r}"}
        self._answer(json.dumps(answer).encode(), "application/json", status)

    def _admitted(self, *, writes: bool) -> str | None:
        """The address behind the token; None where the request was refused."""
        why = refusal(self.headers, self.server.server_port, writes=writes)
        if why:
            self._refuse(HTTPStatus.FORBIDDEN, why)
            return None
        _, token, *rest = [*urlsplit(self.path).path.split("/"), ""]
        if not is_token(token, self.server.token) or not rest[:-1]:
            self._refuse(HTTPStatus.FORBIDDEN, "this is not the address that flexact watch says")
            return None
        return "/".join(rest[:-1])

    def _events(self) -> None:
        """Scenes, each as it comes, until the page has gone."""
        asked = parse_qs(urlsplit(self.path).query)
        self._start(HTTPStatus.OK, "text/event-stream", None)
        self._send(f"retry: {_RETRY}\n\n")
        shown = asked.get("seen", [""])[0]
        seen: Scene | None = None
        work = ""
        while (scene := self.server.stage.wait(seen, _BEAT)) is not None:
            if scene is seen:
                self._send(": still here\n\n")
                continue
            # Nothing has been read yet: what is going on says so.
            if str(scene.revision) != shown and scene.saved:
                self._event("scene", scene.event())
                shown = str(scene.revision)
            if scene.work != work or scene.work:
                self._event("work", scene.work_event())
                work = scene.work
            seen = scene

    def _event(self, kind: str, data: dict[str, Any]) -> None:
        self._send(f"event: {kind}\ndata: {json.dumps(data)}\n\n")

    def _send(self, text: str) -> None:
        self.wfile.write(text.encode())
        self.wfile.flush()

    def _refuse(self, status: HTTPStatus, why: str) -> None:
        self.close_connection = True
        self._answer(f"{why}\n".encode(), "text/plain", status)

    def _answer(self, content: bytes, kind: str, status: HTTPStatus = HTTPStatus.OK) -> None:
        self._start(status, kind, len(content))
        if self.command != "HEAD":
            self.wfile.write(content)

    def _start(self, status: HTTPStatus, kind: str, length: int | None) -> None:
        self.send_response(status)
        self.send_header("Content-Type", f"{kind}; charset=utf-8")
        if length is None:
            self.close_connection = True
        else:
            self.send_header("Content-Length", str(length))
        if self.close_connection:
            self.send_header("Connection", "close")
        for name, value in _HEADERS.items():
            self.send_header(name, value)
        self.end_headers()

    def log_message(self, *_: Any) -> None:
        """Nobody wants to read it."""


_HEADERS = {
    "Cache-Control": "no-store",
    "Content-Security-Policy": "frame-ancestors 'none'",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
}
