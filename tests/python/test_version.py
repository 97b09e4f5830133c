# SPDX-License-Identifier: BSD-3-Clause
"""One version everywhere."""

from __future__ import annotations

import re
from pathlib import Path
from types import ModuleType

import flexact

ROOT = Path(__file__).parents[2]


def test_build_and_package_agree() -> None:
    stated = re.search(r"version: '([^']+)'", (ROOT / "meson.build").read_text())
    assert stated is not None
    assert stated[1] == flexact.__version__


def test_only_names_of_the_package_are_public() -> None:
    """What it is made with is no part of it: `flexact.load` would import what lies in a folder."""
    names = [name for name in dir(flexact) if not name.startswith("__")]
    assert set(names) == set(flexact.__all__) - {"__version__"}
    given = set(vars(flexact)) - set(flexact.__all__)
    modules = {name for name in given if isinstance(getattr(flexact, name), ModuleType)}
    assert not [name for name in given - modules if not name.startswith("_")]
    assert {"load", "TYPE_CHECKING", "VERSION", "feature"}.isdisjoint(given)
