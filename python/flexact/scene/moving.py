"""What can be shown in motion."""

from __future__ import annotations

from typing import Protocol

from ..exchange import FloatArray
from ..model_data import ModelData


class Moving(Protocol):
    """A motion at the nodes: of an analysis, or of a declared degree of freedom."""

    @property
    def data(self) -> ModelData:
        """The model in which it is a motion that nothing determines."""

    @property
    def displacement(self) -> FloatArray:
        """(nodes, 3) [m]."""

    @property
    def rotation(self) -> FloatArray:
        """(nodes, 3) [rad]."""
