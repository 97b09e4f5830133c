# SPDX-License-Identifier: BSD-3-Clause
"""What is clicked on and off in a watched page: edits of classes, tried and said; uses `text`.

Releases, declarations and supports, as a change of the model, as the lines of its deck, and as
calls of Python.
"""

from .answering import Reply, answered, refused
from .refusal import RefusedError
from .session import Session

__all__ = ["RefusedError", "Reply", "Session", "answered", "refused"]
