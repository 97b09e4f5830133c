# SPDX-License-Identifier: BSD-3-Clause
"""`flexact watch` in a process of its own, and a listener to its events."""

import contextlib
import hashlib
import hmac
import http.client
import json
import os
import re
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

#: For a machine on which much else is going on [s].
PATIENCE = 60.0
ADDRESS = "127.0.0.1"
#: Of the environment: what has a browser open.
LEFT_OUT = ("DISPLAY", "WAYLAND_DISPLAY", "BROWSER")


class Watched:
    """A running `flexact watch`, with what it says."""

    def __init__(self, file: Path, state: Path, *more: str, before: Sequence[str] = ()) -> None:
        self.file = file
        env = {**os.environ, "XDG_STATE_HOME": str(state), "PYTHONUNBUFFERED": "1"}
        for name in LEFT_OUT:
            env.pop(name, None)
        self.process = subprocess.Popen(
            [*before, sys.executable, "-m", "flexact", "watch", str(file), *more],
            env=env,
            cwd=file.parent,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            encoding="utf-8",
        )
        self.out: list[str] = []
        self.err: list[str] = []
        self._readers = [
            threading.Thread(target=self._read, args=pair, daemon=True)
            for pair in ((self.process.stdout, self.out), (self.process.stderr, self.err))
        ]
        for reader in self._readers:
            reader.start()
        self.address = until(lambda: self._address())

    def _read(self, stream: Any, lines: list[str]) -> None:
        for line in stream:
            lines.append(line)

    def _address(self) -> str:
        found = re.search(r"http://\S+", "".join(self.out))
        assert found or self.process.poll() is None, "".join(self.err)
        return found[0] if found else ""

    @property
    def port(self) -> int:
        return urlsplit(self.address).port or 0

    def children(self) -> list[int]:
        """Its processes, and theirs."""
        return descendants(self.process.pid)

    def end(self, number: int = signal.SIGINT) -> int:
        """Send a signal; the code with which it ends."""
        if os.name == "posix":
            self.process.send_signal(number)
        else:
            self.process.terminate()
        code = self.process.wait(PATIENCE)
        for reader in self._readers:
            reader.join(PATIENCE)
        return code


def descendants(pid: int) -> list[int]:
    try:
        listed = Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
    except OSError:
        return []
    found = [int(each) for each in listed]
    return [*found, *(deep for each in found for deep in descendants(each))]


def is_running(pid: int) -> bool:
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return False
    return state != "Z"


def until(found: Callable[[], Any], patience: float = PATIENCE) -> Any:
    """The first true value."""
    end = time.monotonic() + patience
    while not (value := found()):
        assert time.monotonic() < end, "it did not come"
        time.sleep(0.02)
    return value


@dataclass
class Page:
    """What a page has of its server: the start that it came from, and the key of that."""

    start: str
    key: str

    @classmethod
    def of(cls, address: str) -> "Page":
        """As it is loaded."""
        text = ask(address)[1]
        start, key = re.findall(r'data-(?:start|key)="([0-9a-f]+)"', text)
        return cls(start, key)

    def proof(self, *words: object) -> str:
        said = " ".join(map(str, words)).encode()
        return hmac.new(self.key.encode(), said, hashlib.sha256).hexdigest()

    def greet(self, port: int | None) -> str:
        """The start of the server at a port, if it is one of this page."""
        number = os.urandom(16).hex()
        path = f"/alive?start={self.start}&number={number}"
        told = json.loads(ask(f"http://{ADDRESS}:{port}/", path)[1])
        if told["proof"] != self.proof("server", number, told["start"], port):
            raise RefusedError("without proof")
        return str(told["start"])


class RefusedError(Exception):
    """Whoever answers at the port is not the server of this page."""


class Events:
    """What a page hears, which goes about it as page/live.js does."""

    def __init__(self, address: str, page: "Page | None" = None, seen: str = "") -> None:
        self._where, self._revision = urlsplit(address), 0
        self.page = Page.of(address) if page is None else page
        number = os.urandom(16).hex()
        start = self.page.greet(self._where.port)
        ours = self.page.proof("page", number, start, self._where.port)
        theirs = self.page.proof("events", number, start, self._where.port)
        asked = f"start={self.page.start}&number={number}&proof={ours}&seen={seen}"
        self._line = http.client.HTTPConnection(ADDRESS, self._where.port, timeout=PATIENCE)
        self._line.request("GET", f"/events?{asked}")
        self._answer = self._line.getresponse()
        assert self._answer.status == 200
        if self.next("proof")["proof"] != theirs:
            raise RefusedError("without proof")

    def next(self, kind: str = "scene") -> dict[str, Any]:
        """The next event of a kind; scenes that only complete the one before are passed over."""
        event = ""
        while True:
            line = self._answer.readline().decode()
            assert line, "the line has ended"
            name, _, value = line.rstrip("\n").partition(": ")
            if name == "event":
                event = value
            elif name == "data" and event == kind:
                data: dict[str, Any] = json.loads(value)
                completed, self._revision = self._revision, data.get("revision", self._revision)
                if not completed or data.get("completes") != completed:
                    return data

    def close(self) -> None:
        self._line.close()


@contextlib.contextmanager
def watching(file: Path, state: Path, *more: str, before: Sequence[str] = ()) -> Iterator[Watched]:
    watched = Watched(file, state, *more, before=before)
    try:
        yield watched
    finally:
        if watched.process.poll() is None:
            watched.process.kill()
        watched.process.wait()
        for stream in (watched.process.stdout, watched.process.stderr):
            if stream is not None:
                stream.close()


def ask(
    address: str, path: str = "", method: str = "GET", **headers: str
) -> tuple[int, str, dict[str, str]]:
    """Status, text and headers of a request; names of headers with _ for -."""
    where = urlsplit(address)
    line = http.client.HTTPConnection("127.0.0.1", where.port, timeout=PATIENCE)
    given = {name.replace("_", "-"): value for name, value in headers.items()}
    line.putrequest(method, path or where.path, skip_host="Host" in given)
    for name, value in given.items():
        line.putheader(name, value)
    line.endheaders()
    answer = line.getresponse()
    text = answer.read().decode()
    line.close()
    return answer.status, text, dict(answer.getheaders())
