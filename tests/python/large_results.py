# SPDX-License-Identifier: BSD-3-Clause
"""Results that stand for those of large models: fewer values or vectors than there are."""

import dataclasses
from typing import Any

from flexact import Analysis
from flexact.core.arrays import Basis


def changed(analysis: Analysis, **raw: Any) -> Analysis:
    """The same analysis with other results of the core."""
    return dataclasses.replace(analysis, raw=analysis.raw._replace(**raw))


def first_of(basis: Basis, vectors: int) -> Basis:
    """The first vectors alone."""
    entries = int(basis.start[vectors])
    return Basis(
        basis.size, basis.start[: vectors + 1], basis.place[:entries], basis.value[:entries]
    )
