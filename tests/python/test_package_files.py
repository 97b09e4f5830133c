# SPDX-License-Identifier: BSD-3-Clause
"""What the build installs: every source of the package, and nothing that lies beside them."""

import re
from pathlib import Path

PYTHON = Path(__file__).resolve().parents[2] / "python"
KINDS = {".py", ".pyi", ".typed", ".js", ".css", ".html"}


def test_the_build_names_every_source() -> None:
    """A source that is missing in python/meson.build would not be installed."""
    build = (PYTHON / "meson.build").read_text()
    named = [
        f"{folder}/{name}"
        for folder, names in re.findall(r"'(flexact[\w/]*)': \[(.*?)\]", build, re.DOTALL)
        for name in re.findall(r"'([\w.]+)'", names)
    ]
    there = {
        str(path.relative_to(PYTHON).as_posix())
        for path in (PYTHON / "flexact").rglob("*")
        if path.suffix in KINDS
    }
    assert sorted(named) == sorted(there)
