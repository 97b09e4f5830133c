# SPDX-License-Identifier: BSD-3-Clause
"""A motion as a cycle that plays in ParaView: a .pvd file and a mesh for each time step."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...analysis.result import Result
from ..drawing import Moving, move
from .collection import Collection, folder_of, moved_mesh
from .file import find_format, mesh_bytes
from .mesh_content import Meshes

#: Time steps of a cycle, from time 0 to time 1; the last is as the first.
STEPS = 24
#: Names of the meshes: this, and one of these each.
STEM = "step_"
ENDINGS = tuple(f"{i:02d}.vtu" for i in range(STEPS + 1))


class Cycle(Collection):
    """The files of a cycle.

    A step at time t shows the motion at the phase sin(2 pi t), from rest: points where they have
    moved to, `displacement` and `rotation` finite, since the reference; all other data as in any
    mesh. A mechanism that does not move has a single step.
    """

    def __init__(self, analysis: Result, shown: Moving | None, target: Path) -> None:
        """The cycle of a motion; its meshes lie in a folder beside the .pvd file `target`."""
        self._format = find_format("vtu")
        times = np.linspace(0.0, 1.0, STEPS + 1).tolist() if shown is not None else [0.0]
        self._meshes = Meshes(analysis, len(times))
        self._movement = None if shown is None else move(self._meshes.drawn, shown)
        files = [folder_of(target) / f"{STEM}{ending}" for ending in ENDINGS[: len(times)]]
        self._time_of = dict(zip(files, times, strict=True))
        super().__init__(target, files, dict(zip(times, files, strict=True)))

    def mesh(self, path: Path) -> bytes:
        """What a mesh holds."""
        time = self._time_of[path]
        if self._movement is None:
            return mesh_bytes(self._meshes.still(None), self._format)
        # Rounded, so that it is at rest where it ends, too.
        pose = self._movement.pose(round(float(np.sin(2 * np.pi * time)), 15))
        return mesh_bytes(moved_mesh(self._meshes, pose), self._format)
