# SPDX-License-Identifier: BSD-3-Clause
"""Whether motions go on or only begin; uses the rest of `result` and below."""

from .decide import extents_of
from .extent import Branch, EvidenceKind, Extent, Extents, Fit, Kind, Reason

__all__ = [
    "Branch",
    "EvidenceKind",
    "Extent",
    "Extents",
    "Fit",
    "Kind",
    "Reason",
    "extents_of",
]
