# SPDX-License-Identifier: BSD-3-Clause
"""The error for what cannot be done, in words for the person who asked."""

from __future__ import annotations

from http import HTTPStatus

from ...util.errors import FlexactError


class RefusedError(FlexactError):
    """What was asked for is not understood, or cannot be done; nothing has changed.

    Attributes:
        status: Of the answer over HTTP.
    """

    def __init__(self, message: str, status: HTTPStatus = HTTPStatus.UNPROCESSABLE_ENTITY) -> None:
        """Keep the words and the status."""
        super().__init__(message)
        self.status = status
