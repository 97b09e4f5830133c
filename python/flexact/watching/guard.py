# SPDX-License-Identifier: BSD-3-Clause
"""Who may ask: pages that this server has made, and whoever was given the address.

A page from elsewhere can have a browser ask a server of this machine, also under a name that it
has made to mean 127.0.0.1. So names are checked, and the address holds what nobody can guess.
"""

from __future__ import annotations

import contextlib
import hashlib
import hmac
import os
import secrets
from email.message import Message
from pathlib import Path

ADDRESS = "127.0.0.1"
_NAMES = (ADDRESS, "localhost")
_KEY_BYTES = 32
#: Ports that are for whoever wants one.
_FIRST_PORT, _PORTS = 49152, 16384


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
        site = headers.get("Sec-Fetch-Site", "none")
        return "" if site in ("none", "same-origin") else "this server is for its own pages only"
    if (origin or "").lower() not in {f"http://{host}" for host in hosts}:
        return "this server is for its own pages only"
    return ""


def token_of(path: str) -> str:
    """What the address of a deck holds: the same each time, so that open pages find it again."""
    name = os.fsencode(os.path.realpath(path))
    return hmac.new(_key(), name, hashlib.sha256).hexdigest()[:32]


def is_token(given: str, token: str) -> bool:
    """Whether it is; how long this takes tells nothing."""
    return hmac.compare_digest(given.encode(), token.encode())


def port_of(path: str) -> int:
    """The port that is tried first for a deck, the same each time."""
    name = os.fsencode(os.path.realpath(path))
    return _FIRST_PORT + int.from_bytes(hashlib.sha256(name).digest()[:4], "big") % _PORTS


def _key() -> bytes:
    """A secret of this user; one for this time where none can be kept."""
    folder = Path(os.environ.get("XDG_STATE_HOME") or Path.home() / ".local" / "state") / "flexact"
    file = folder / "watch.key"
    made = secrets.token_bytes(_KEY_BYTES)
    with contextlib.suppress(OSError, RuntimeError):
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        with contextlib.suppress(FileExistsError):
            how = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)
            number = os.open(file, how, 0o600)
            with open(number, "wb") as new:
                new.write(made)
        kept = file.read_bytes()
        if len(kept) == _KEY_BYTES:
            return kept
    return made
