# SPDX-License-Identifier: BSD-3-Clause
"""Who may ask: pages that this server has made, and whoever was given the address.

A page from elsewhere can have a browser ask a server of this machine, also under a name that it
has made to mean 127.0.0.1. So names are checked, and the address holds what nobody can guess.

Another user of this machine can take the port as soon as a server has ended, and pass on what it
hears to one that has begun at another port. So each start has a secret of its own, and a page that
finds its server again gives away nothing before it has proof: both show with HMAC-SHA256 that they
have a key that was never sent but within a page, each of numbers that the other has just made, and
of the port at which they talk. The key follows from one of this user, the file and the start.
"""

from __future__ import annotations

import contextlib
import hashlib
import hmac
import os
import secrets
import stat
import tempfile
from email.message import Message
from html import escape
from pathlib import Path

from ...util.temporary import new_file, temporary_name

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

    def is_token(self, given: str) -> bool:
        """Whether it is that of the address; how long this takes tells nothing."""
        return hmac.compare_digest(given.encode(), self.token.encode())

    def proof(self, start: str, *words: str) -> str:
        """What nobody can say of these words but this server and pages of a start."""
        return _mac(self.page_key(start).encode(), " ".join(words).encode())

    def is_proof(self, given: str, start: str, *words: str) -> bool:
        """Whether a page of a start has said so of these words."""
        return hmac.compare_digest(given.encode(), self.proof(start, *words).encode())

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
    how = os.O_RDONLY
    for name in ("O_NOFOLLOW", "O_NONBLOCK", "O_CLOEXEC", "O_BINARY"):
        how |= getattr(os, name, 0)
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
