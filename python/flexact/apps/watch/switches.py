# SPDX-License-Identifier: BSD-3-Clause
"""What is clicked on and off in a watched page: edits of classes, tried and said; uses `text`.

Releases, declarations and supports, as a change of the model, as the lines of its deck, and as
calls of Python.
"""

from .live_edit import Session
from .refusal import RefusedError
from .switches_answering import Reply, answered, refused

__all__ = ["RefusedError", "Reply", "Session", "answered", "refused"]
