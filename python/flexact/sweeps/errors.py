# SPDX-License-Identifier: BSD-3-Clause
"""The exception of the engine."""

from __future__ import annotations

from ..util.errors import BatchError


class EngineError(BatchError):
    """Work cannot be done, or cannot go on, for a reason that is not in the work itself."""
