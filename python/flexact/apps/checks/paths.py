# SPDX-License-Identifier: BSD-3-Clause
"""Paths of decks as services want them: from the root of the repository, with slashes."""

from __future__ import annotations

import os
from collections.abc import Mapping


def from_root(path: str, environment: Mapping[str, str] = os.environ) -> str:
    """A path from the root of the repository, or from the working folder.

    The root is what GitHub's runner says, in GITHUB_WORKSPACE; without, the working folder. What
    lies elsewhere keeps its whole path.
    """
    if path.startswith("<"):
        return path
    start = environment.get("GITHUB_WORKSPACE") or os.getcwd()
    try:
        found = os.path.relpath(os.path.abspath(path), start)
        if found.split(os.sep)[0] == os.pardir:
            found = os.path.relpath(os.path.realpath(path), os.path.realpath(start))
    except (OSError, ValueError):
        # Another drive, or a name that no file can have.
        return path.replace(os.sep, "/")
    if found.split(os.sep)[0] == os.pardir:
        found = os.path.abspath(path)
    return found.replace(os.sep, "/")
