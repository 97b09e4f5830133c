# SPDX-License-Identifier: BSD-3-Clause
"""The server of a page that is watched: for this machine, and who knows the address."""

from __future__ import annotations

import contextlib
import errno
import json
import os
import socket
import socketserver
import threading
import time
from collections.abc import Callable
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any
from urllib.parse import parse_qs, urlsplit

from ...util.errors import BatchError, reason_of
from .guard import ADDRESS, Secrets, refusal
from .live_page import live_page
from .scene import Scene, Stage

#: A line that goes now and then, to find out who has gone [s].
_BEAT = 10.0
#: Bytes of a request that is taken.
_LARGEST = 2**20
#: Connections at a time; more are tabs that nobody looks at, or somebody who means ill.
_MOST = 64
#: How long a connection may say nothing before it has shown that it may ask, and afterwards [s].
_FIRST, _LATER = 5.0, 60.0
#: Where the system gives no more connections it is not asked at once again [s].
_PAUSE = 0.1

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
        self.secrets = Secrets(path)
        #: By the last part of the address.
        self.posts: dict[str, Post] = {}
        #: The open connections, the oldest first, each with whether it may ask.
        self._lines: dict[socket.socket, bool] = {}
        self._lock = threading.Lock()
        for tried in (self.secrets.port, 0) if port is None else (port,):
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
        return f"http://{ADDRESS}:{self.server_port}/{self.secrets.token}/"

    def get_request(self) -> tuple[socket.socket, Any]:
        """As below; whoever waits cannot be let in where there are no more files to be had."""
        try:
            return super().get_request()
        except OSError:
            time.sleep(_PAUSE)
            raise

    def process_request(self, request: Any, client_address: Any) -> None:
        """Answer in a thread; of too many, the oldest of those that may not ask is closed."""
        with self._lock:
            if len(self._lines) >= _MOST:
                oldest = next((line for line, may_ask in self._lines.items() if not may_ask), None)
                if oldest is None:
                    oldest = request
                self._lines.pop(oldest, None)
                # Its thread hears that nobody is there any more, and closes it.
                with contextlib.suppress(OSError):
                    oldest.shutdown(socket.SHUT_RDWR)
            self._lines[request] = False
        super().process_request(request, client_address)

    def shutdown_request(self, request: Any) -> None:
        """Close a connection."""
        with self._lock:
            self._lines.pop(request, None)
        super().shutdown_request(request)

    def let(self, request: socket.socket) -> None:
        """Keep a connection, which has shown that it may ask."""
        with self._lock:
            if request in self._lines:
                self._lines[request] = True
        request.settimeout(_LATER)

    def server_close(self) -> None:
        """Give the port back, and take the way in away."""
        super().server_close()
        self.secrets.close()

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
    timeout = _FIRST

    def do_GET(self) -> None:
        """The page; or its events, for which no secret is sent."""
        path, _, query = self.path.partition("?")
        if path in ("/alive", "/events"):
            if why := refusal(self.headers, self.server.server_port, writes=False):
                self._refuse(HTTPStatus.FORBIDDEN, why)
                return
            asked = {name: values[0] for name, values in parse_qs(query).items()}
            (self._alive if path == "/alive" else self._events)(asked)
            return
        rest = self._admitted(writes=False)
        if rest == "":
            known = self.server.secrets
            page = live_page(self.server.stage.scene, known.start, known.page_key(known.start))
            self._answer(page.encode("utf-8", "backslashreplace"), "text/html")
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
        if not self.server.secrets.is_token(token) or not rest[:-1]:
            self._refuse(HTTPStatus.FORBIDDEN, "this is not the address that flexact watch says")
            return None
        self.server.let(self.connection)
        return "/".join(rest[:-1])

    def _alive(self, asked: dict[str, str]) -> None:
        """Show a page of any start of this file that this is its server, at this port."""
        known, port = self.server.secrets, str(self.server.server_port)
        proof = known.proof(
            asked.get("start", ""), "server", asked.get("number", ""), known.start, port
        )
        self._answer(
            json.dumps({"start": known.start, "proof": proof}).encode(), "application/json"
        )

    def _events(self, asked: dict[str, str]) -> None:
        """Scenes, each as it comes, until the page has gone."""
        known, port = self.server.secrets, str(self.server.server_port)
        start, number = asked.get("start", ""), asked.get("number", "")
        if not known.is_proof(asked.get("proof", ""), start, "page", number, known.start, port):
            self._refuse(HTTPStatus.FORBIDDEN, "this is no page of this server")
            return
        self.server.let(self.connection)
        self._start(HTTPStatus.OK, "text/event-stream", None)
        self._event("proof", {"proof": known.proof(start, "events", number, known.start, port)})
        if start != known.start:
            # A page of an earlier start goes on as one of this.
            own = {"start": known.start, "key": known.page_key(known.start), "token": known.token}
            self._event("secrets", own)
        shown = asked.get("seen", "")
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
