# SPDX-License-Identifier: BSD-3-Clause
"""One version everywhere."""

from __future__ import annotations

import re
from pathlib import Path

import flexact

ROOT = Path(__file__).parents[2]


def test_build_and_package_agree() -> None:
    stated = re.search(r"version: '([^']+)'", (ROOT / "meson.build").read_text())
    assert stated is not None
    assert stated[1] == flexact.__version__
