# SPDX-License-Identifier: BSD-3-Clause
"""Values from process to process over a pipe, each as its length and its bytes."""

from __future__ import annotations

import pickle
import struct
from typing import IO, Any

_LENGTH = struct.Struct("!Q")
#: Longer is no value of ours.
_MOST = 2**32


def send(line: IO[bytes], value: Any) -> None:
    """Write a value.

    Raises:
        OSError: Nobody reads on.
    """
    content = pickle.dumps(value, pickle.HIGHEST_PROTOCOL)
    line.write(_LENGTH.pack(len(content)) + content)
    line.flush()


def receive(line: IO[bytes]) -> Any:
    """The next value.

    Raises:
        EOFError: There is none, or it ends too early.
        Exception: What is there was not sent by `send`.
    """
    (length,) = _LENGTH.unpack(_read(line, _LENGTH.size))
    if length > _MOST:
        raise ValueError("longer than any value")
    return pickle.loads(_read(line, length))


def _read(line: IO[bytes], length: int) -> bytes:
    content = line.read(length)
    if len(content) < length:
        raise EOFError
    return content
