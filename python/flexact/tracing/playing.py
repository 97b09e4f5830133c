# SPDX-License-Identifier: BSD-3-Clause
"""A traced path as a cycle that plays in ParaView: from rest to both ends and back."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..show.mesh.collection import Collection, folder_of, moved_mesh
from ..show.mesh.file import find_format, mesh_bytes
from ..show.mesh.mesh_content import Meshes
from .values import Traced

#: Names of the meshes: this, and a number each. Of more steps than so many some are left out,
#: never the dead points.
MOST = 400
STEM = "step_"
ENDINGS = tuple(f"{k:03d}.vtu" for k in range(MOST))


class Played(Collection):
    """The files: a mesh a step, shown to the end along the motion, back, and to the other end.

    Time is the way that has been gone along the path [m]; it begins and ends at rest.
    """

    def __init__(self, trace: Traced, target: Path) -> None:
        """The meshes lie in a folder beside the .pvd file `target`."""
        find_format("vtu")
        self._trace = trace
        steps = _chosen(trace)
        self._meshes = Meshes(trace.result, len(steps))
        files = [folder_of(target) / f"{STEM}{ending}" for ending in ENDINGS[: len(steps)]]
        self._step_of = dict(zip(files, steps, strict=True))
        start = steps.index(trace.reference)
        order = [*range(start, len(steps)), *range(len(steps) - 2, -1, -1), *range(1, start + 1)]
        arc = trace.arc[steps][order]
        times = np.concatenate(([0.0], np.cumsum(np.abs(np.diff(arc)))))
        shown = {time: files[k] for time, k in zip(times.tolist(), order, strict=True)}
        super().__init__(target, files, shown)

    def mesh(self, path: Path) -> bytes:
        """What a mesh holds."""
        pose = self._trace.steps[self._step_of[path]].pose
        return mesh_bytes(moved_mesh(self._meshes, pose), "vtu")


def _chosen(trace: Traced) -> list[int]:
    """Which steps are shown."""
    many = len(trace.steps)
    if many <= MOST:
        return list(range(many))
    every = np.linspace(0, many - 1, MOST // 2).round().astype(int).tolist()
    dead = [k for k, step in enumerate(trace.steps) if step.dead is not None][: MOST // 2]
    return sorted({*every, *dead, trace.reference})
