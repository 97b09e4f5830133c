# SPDX-License-Identifier: BSD-3-Clause
"""The files that ``flexact analyse -o`` writes of each deck: JSON, log and mesh."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ...analysis.json_result import text_of
from ...analysis.result import Result
from ...show.log import log_text
from ...show.mesh import Meshes
from ...show.mesh.file import find_format, mesh_bytes
from ...show.spacar_log import spacar_log
from ...util.decks import DeckFile
from ...util.interruption import unwinding
from ...util.outputs import plan_files, write_together
from .failures import foreseen


class ResultFiles:
    """Where each deck's results go, found before anything is computed.

    Raises:
        OutputError: Two decks would write one file, or the folder cannot take files.
        MeshFormatError: There is no such mesh format.
    """

    def __init__(
        self, decks: Sequence[DeckFile], folder: Path, mesh_format: str, log: str | None = None
    ) -> None:
        """Plan the files of all decks; `log` is the form of the logs, None that of Flexact."""
        self._log = log
        with unwinding():
            self.format = find_format(mesh_format)
        self.plan = plan_files(decks, folder, (".json", ".log", f".{self.format}"))

    def write(self, deck: DeckFile, result: Result) -> Exception | None:
        """Write the results, or say why not: that is no reason to keep the verdict back."""
        try:
            contents = contents_of(result, self.format, self._log)
            with unwinding():
                write_together(dict(zip(self.plan[deck.path], contents, strict=True)))
        except Exception as error:
            return foreseen(error)
        return None


def contents_of(result: Result, mesh_format: str, log: str | None = None) -> tuple[bytes, ...]:
    """What stands in the files of a result, in the order of the plan.

    `log` is the form of the log, None that of Flexact.

    Raises:
        OutputError: The mesh cannot be written.
        MemoryError: There is not enough memory.
    """
    json = f"{text_of(result)}\n".encode()
    meshes = Meshes(result)
    words = spacar_log(result) if log else log_text(result, most_in_mesh=meshes.most_modes)
    mesh = meshes.still()
    with unwinding():
        return json, words.encode("utf-8", "backslashreplace"), mesh_bytes(mesh, mesh_format)
