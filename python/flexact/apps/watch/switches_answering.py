# SPDX-License-Identifier: BSD-3-Clause
"""Requests as they come over HTTP, and their answers."""

from __future__ import annotations

import json
from http import HTTPStatus
from typing import Any, NamedTuple

from .live_edit import Session
from .refusal import RefusedError

#: Bytes of the largest request.
MOST_BYTES = 4_000_000


class Reply(NamedTuple):
    """The answer to a request."""

    status: HTTPStatus
    content: dict[str, Any]
    """What is answered, as JSON; "error" in words where it was refused."""
    changed: bool
    """Whether the mechanism is to be analysed anew."""


def answered(session: Session, body: bytes) -> Reply:
    """Do what the body of a request says; what it cannot is told in words."""
    try:
        answer = session.ask(_read(body))
    except RefusedError as error:
        return Reply(error.status, refused(error), False)
    return Reply(HTTPStatus.OK, answer.content, answer.changed)


def refused(error: Exception) -> dict[str, Any]:
    """An error as JSON."""
    return {"error": str(error)}


def _read(body: bytes) -> object:
    if len(body) > MOST_BYTES:
        raise RefusedError("the request is too long", HTTPStatus.REQUEST_ENTITY_TOO_LARGE)
    try:
        return json.loads(body)
    except (ValueError, RecursionError):
        raise RefusedError("the request is no JSON", HTTPStatus.BAD_REQUEST) from None
