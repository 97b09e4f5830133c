"""The light in which solids stand: it goes with the eye, so that nothing turns dark."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..exchange import FloatArray
from ..scene.rotations import unit
from .view import View

#: A facet in the shade keeps this part of its colour.
SHADE = 0.66
#: Azimuth of the light, clockwise from upwards in the picture, and altitude above it [degrees].
_PLACE = (-35.0, 52.0)


class Light(NamedTuple):
    """A light and what it leaves in the shade."""

    towards: FloatArray
    """(3,) unit vector."""
    shade: float
    """The part of a colour that is left without it."""

    def on(self, normal: FloatArray) -> FloatArray:
        """(n, 1) what colours are multiplied by on surfaces with these normals (n, 3)."""
        bright = np.clip(unit(normal) @ self.towards, 0.0, 1.0)
        return np.asarray(self.shade + (1.0 - self.shade) * bright)[:, None]


def light_of(view: View, shade: float = SHADE) -> Light:
    """The light to the left of the eye and above it."""
    from matplotlib.colors import LightSource

    # Its x is to the right, its y upwards, its z towards the eye.
    direction = LightSource(azdeg=_PLACE[0], altdeg=_PLACE[1]).direction
    return Light(np.asarray(np.asarray(direction, np.float64) @ view.axes), shade)
