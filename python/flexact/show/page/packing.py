# SPDX-License-Identifier: BSD-3-Clause
"""Arrays and data as a page can hold them."""

from __future__ import annotations

import base64
import json
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

#: What would end the script element that holds the data, or begin a comment in it.
_UNSAFE = str.maketrans({c: f"\\u{ord(c):04x}" for c in "<>&\u2028\u2029"})


def floats(values: ArrayLike) -> dict[str, str]:
    """Numbers in single precision."""
    return _packed("f4", np.asarray(values, "<f4"))


def integers(values: ArrayLike) -> dict[str, str]:
    """Whole numbers of 32 bits."""
    return _packed("i4", np.asarray(values, "<i4"))


def shorts(values: ArrayLike) -> dict[str, str]:
    """Whole numbers of 16 bits."""
    return _packed("i2", np.asarray(values, "<i2"))


def flags(values: ArrayLike) -> dict[str, str]:
    """Yes or no, or numbers from 0 to 255."""
    return _packed("u1", np.asarray(values, "u1"))


def _packed(kind: str, values: np.ndarray) -> dict[str, str]:
    return {"type": kind, "data": base64.b64encode(values.tobytes()).decode()}


def json_for_script(data: dict[str, Any]) -> str:
    """JSON that is safe within a script element."""
    text = json.dumps(data, allow_nan=False, separators=(",", ":"))
    return text.translate(_UNSAFE)
