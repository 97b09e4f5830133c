# SPDX-License-Identifier: BSD-3-Clause
"""The model of an assembly from CAD, and what is said of it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ....model.model import Model
from .assembly import Assembly, Choices


@dataclass(frozen=True)
class CadMechanism:
    """A STEP file as a mechanism.

    Attributes:
        assembly: What was found in it: solids, pieces, flexures, bodies, doubts.
        model: The model of it, in mm, whose parts have the names of flexures and bodies.
        choices: What the designer has said, as it was applied.
    """

    assembly: Assembly
    model: Model
    choices: Choices

    def describe(self) -> str:
        """What was recognised, and what is in doubt, in words."""
        raise NotImplementedError


def mechanism_of(path: Path, choices: Choices | None = None) -> CadMechanism:
    """The mechanism in a STEP file.

    Args:
        path: A file .step or .stp.
        choices: What the designer says of its parts.

    Raises:
        BatchError: it cannot be read, holds no solids, or takes more than a minute or 4 GB; or
            OpenCASCADE is missing; or a choice names what is not there.
        ModelError: what was found makes no model.
    """
    raise NotImplementedError
