# SPDX-License-Identifier: BSD-3-Clause
"""The option --mesh: in which format meshes are written beside results; --format was its name."""

from __future__ import annotations

import argparse
from typing import Any

from .once import require_once
from .terminal import complain

#: Those of `mesh.file`, which takes a while to load.
FORMATS = ("vtu", "vtk", "xdmf")


def add_mesh(parser: argparse.ArgumentParser, target: str) -> None:
    """Add the format of the meshes to a verb's parser.

    Args:
        parser: The parser.
        target: The option that names their folder.
    """
    parser.add_argument(
        "--mesh",
        metavar="FORMAT",
        help=f"format of the meshes of {target}: {', '.join(FORMATS)} (default {FORMATS[0]})",
    )


def _is_mesh(value: object) -> bool:
    return str(value).lower().removeprefix(".") in FORMATS


class FormsOrMeshes(tuple[str, ...]):
    """Values of --format, among which formats of meshes are still taken, and not shown."""

    __slots__ = ()

    def __contains__(self, value: object) -> bool:
        """Whether it is taken."""
        return super().__contains__(value) or _is_mesh(value)


class FormatOrMesh(argparse.Action):
    """Stores --format, or what once was said by it as --mesh, with a word on stderr."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        """Store it where it belongs."""
        dest = "mesh" if _is_mesh(values) else self.dest
        if dest == "mesh":
            complain(f"warning: {option_string} {values} is now called --mesh {values}")
        require_once(parser, namespace, dest, values, option_string)
        setattr(namespace, dest, values)
