# SPDX-License-Identifier: BSD-3-Clause
"""The server of a page that is watched: for this machine, and who knows the address."""

from __future__ import annotations

import contextlib
import errno
import hashlib
import hmac
import json
import os
import secrets
import socket
import socketserver
import stat
import tempfile
import threading
import time
from collections.abc import Callable
from email.message import Message
from html import escape
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlsplit

from ...show.page.assets import LAYOUT_SCRIPTS, LAYOUT_STYLES, SCRIPTS, filled, text
from ...util.errors import BatchError, reason_of
from ...util.outputs import new_file, temporary_name
from .scene import Scene, Stage

#: The viewer without what starts a page at once, and what starts this one.
_SCRIPTS = (*(name for name in SCRIPTS if name != "start.js"), "switches.js", "live.js")
_OF_LAYOUTS = (*LAYOUT_SCRIPTS, "live.js")


def live_page(scene: Scene, start: str, key: str, *, of_layouts: bool = False) -> str:
    """The whole page.

    Args:
        scene: What it shows.
        start: The start of the server that it comes from.
        key: What it finds out by whether a server is one of this user and file; see `Secrets`.
        of_layouts: Whether it shows layouts of a design problem.
    """
    body = (
        f'<div class="live" data-revision="{scene.revision if scene.saved else 0}" '
        f'data-saved="{text(scene.saved)}" data-start="{start}" data-key="{key}">'
        '<p class="live-state" role="status"><span class="live-dot" aria-hidden="true"></span>'
        '<span class="live-words"></span> <span class="live-which"></span></p>'
        '<p class="live-work" role="status" hidden></p>'
        '<p class="live-lost" role="alert" hidden></p>'
        '<section class="live-errors" role="alert" aria-label="Errors" hidden></section></div>'
        f'<div class="live-now" hidden data-changed="{text(scene.changed_words)}" '
        f'data-which="{text(scene.which)}"></div>'
        f'<template class="live-broken">{scene.broken}</template>'
        f'<div class="live-scene">{scene.body}</div>'
    )
    scripts: tuple[str, ...] = _SCRIPTS
    styles: tuple[str, ...] = ("style.css", "live.css", "switches.css")
    if of_layouts:
        scripts, styles = _OF_LAYOUTS, (*LAYOUT_STYLES, "live.css")
    return filled(scene.title, body, scripts, styles, connects=True)


ADDRESS = "127.0.0.1"
_NAMES = (ADDRESS, "localhost")
_KEY_BYTES = 32
#: Ports that are for whoever wants one.
_FIRST_PORT, _PORTS = 49152, 16384
_FOR_OTHERS = stat.S_IRWXG | stat.S_IRWXO
_WRITE_BY_OTHERS = stat.S_IWGRP | stat.S_IWOTH
_DOOR = """<!DOCTYPE html>
<meta charset="utf-8"><meta name="referrer" content="no-referrer"><title>flexact watch</title>
<meta http-equiv="refresh" content="0; url={address}"><a href="{address}">The watched page</a>
"""


def refusal(headers: Message, port: int, *, writes: bool) -> str:
    """Why a request is refused; empty where it is not.

    Args:
        headers: Of the request.
        port: That of this server.
        writes: Whether the request changes anything.
    """
    hosts = {f"{name}:{port}" for name in _NAMES}
    if headers.get("Host", "").lower() not in hosts:
        return "this server is asked by its own address only"
    origin = headers.get("Origin")
    if origin is None and not writes:
        # Of another site is also the file that leads here: whoever knows the address may go to it.
        is_visit = (headers.get("Sec-Fetch-Mode"), headers.get("Sec-Fetch-Dest")) == (
            "navigate",
            "document",
        )
        if is_visit or headers.get("Sec-Fetch-Site", "none") in ("none", "same-origin"):
            return ""
        return "this server is for its own pages only"
    if (origin or "").lower() not in {f"http://{host}" for host in hosts}:
        return "this server is for its own pages only"
    return ""


class Secrets:
    """What one start of a server knows, and others of this machine do not."""

    def __init__(self, path: str) -> None:
        """Of a file that is watched."""
        self._file = os.fsencode(os.path.realpath(path))
        self._folder = _state_folder()
        self._key = _key(self._folder)
        self._door: Path | None = None
        #: What tells this start from others; no secret.
        self.start = secrets.token_hex(16)
        #: What the address holds.
        self.token = secrets.token_hex(16)
        #: The port that is tried first, the same each time.
        self.port = _FIRST_PORT + int(self._made("port")[:8], 16) % _PORTS

    def page_key(self, start: str) -> str:
        """What pages of a start of this file have, this one or one before."""
        return self._made(f"page {start}")

    def proof(self, start: str, *words: str) -> str:
        """What nobody can say of these words but this server and pages of a start."""
        return _mac(self.page_key(start).encode(), " ".join(words).encode())

    def door(self, address: str) -> Path:
        """A file that leads a browser of this user to an address, which nobody else may read.

        What a browser is started with stands in the list of processes, which everybody may read.

        Raises:
            OSError: It cannot be written.
        """
        folder = self._folder or Path(tempfile.mkdtemp(prefix="flexact-"))
        self._door = folder / f"watch-{self._made('door')[:16]}.html"
        _write(self._door, _DOOR.format(address=escape(address)).encode())
        return self._door

    def close(self) -> None:
        """Take the file away that leads here."""
        door, self._door = self._door, None
        if door is not None:
            with contextlib.suppress(OSError):
                door.unlink(missing_ok=True)
                if door.parent != self._folder:
                    door.parent.rmdir()

    def _made(self, what: str) -> str:
        return _mac(self._key, what.encode() + b"\0" + self._file)


def _mac(key: bytes, words: bytes) -> str:
    return hmac.new(key, words, hashlib.sha256).hexdigest()


def _state_folder() -> Path | None:
    """Where this user's secrets are kept; None where others could change them, or nothing can."""
    # Whoever has no home and no name in the system has no folder either.
    with contextlib.suppress(OSError, RuntimeError, ValueError):
        state = os.environ.get("XDG_STATE_HOME") or Path.home() / ".local" / "state"
        folder = Path(state).absolute() / "flexact"
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        if _is_mine(os.stat(folder), _WRITE_BY_OTHERS):
            return folder
    return None


def _is_mine(found: os.stat_result, forbidden: int) -> bool:
    """Whether it is this user's, and others may do nothing that is forbidden."""
    if not hasattr(os, "geteuid"):
        return True
    return found.st_uid == os.geteuid() and not found.st_mode & forbidden


def _key(folder: Path | None) -> bytes:
    """A secret of this user; one for this time where none can be kept."""
    kept = None
    if folder is not None:
        file = folder / "watch.key"
        kept = _kept(file)
        if kept is None:
            with contextlib.suppress(OSError):
                _write(file, secrets.token_bytes(_KEY_BYTES))
            kept = _kept(file)
    return kept or secrets.token_bytes(_KEY_BYTES)


def _kept(file: Path) -> bytes | None:
    """A key that was kept whole, and that nobody else has made or can have read."""
    names = ("O_NOFOLLOW", "O_NONBLOCK", "O_CLOEXEC", "O_BINARY")
    how = os.O_RDONLY | sum(getattr(os, name, 0) for name in names)
    with contextlib.suppress(OSError), open(os.open(file, how), "rb") as given:
        found = os.fstat(given.fileno())
        if stat.S_ISREG(found.st_mode) and _is_mine(found, _FOR_OTHERS):
            key = given.read(_KEY_BYTES + 1)
            return key if len(key) == _KEY_BYTES else None
    return None


def _write(path: Path, content: bytes) -> None:
    """Write a file that is for this user alone."""
    temporary = path.with_name(temporary_name())
    try:
        with new_file(temporary, mode=0o600) as new:
            new.write(content)
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


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

    def __init__(self, path: str, stage: Stage, edit: Post, port: int | None = None) -> None:
        """Take a port.

        Args:
            path: The file that is watched.
            stage: What is shown.
            edit: Answers what a page sends.
            port: The port; by default one that is free, if it can be the one of the last time.

        Raises:
            BatchError: The port cannot be had.
        """
        self.stage, self.edit = stage, edit
        self.secrets = Secrets(path)
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
            stage = self.server.stage
            key = known.page_key(known.start)
            page = live_page(stage.scene, known.start, key, of_layouts=stage.of_layouts)
            self._answer(page.encode("utf-8", "backslashreplace"), "text/html")
        elif rest is not None:
            self._refuse(HTTPStatus.NOT_FOUND, "there is nothing here")

    def do_POST(self) -> None:
        """What a page sends."""
        rest = self._admitted(writes=True)
        if rest is None:
            return
        if rest != "edit":
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
            status, answer = self.server.edit(self.rfile.read(length))
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
        # How long it takes to compare them tells nothing.
        is_right = hmac.compare_digest(token.encode(), self.server.secrets.token.encode())
        if not is_right or not rest[:-1]:
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
        proof = known.proof(start, "page", number, known.start, port)
        if not hmac.compare_digest(asked.get("proof", "").encode(), proof.encode()):
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
