# SPDX-License-Identifier: BSD-3-Clause
"""Colours as colour-blind people see them, and how far apart two colours are.

Deficiencies: G. M. Machado, M. M. Oliveira and L. A. F. Fernandes, *A physiologically-based model
for simulation of color vision deficiency*, IEEE Transactions on Visualization and Computer Graphics
15(6), 2009, table 1 at severity 1.0, applied to linear RGB. Distances: CIEDE2000 as written by
G. Sharma, W. Wu and E. N. Dalal, *The CIEDE2000 color-difference formula*, Color Research and
Application 30(1), 2005.
"""

import numpy as np

#: Of linear red, green and blue.
MATRICES = {
    "normal": np.eye(3),
    "protanopia": np.array(
        (
            (0.152286, 1.052583, -0.204868),
            (0.114503, 0.786281, 0.099216),
            (-0.003882, -0.048116, 1.051998),
        )
    ),
    "deuteranopia": np.array(
        (
            (0.367322, 0.860646, -0.227968),
            (0.280085, 0.672501, 0.047413),
            (-0.011820, 0.042940, 0.968881),
        )
    ),
    "tritanopia": np.array(
        (
            (1.255528, -0.076749, -0.178779),
            (-0.078411, 0.930809, 0.147602),
            (0.004733, 0.691367, 0.303900),
        )
    ),
}
_TO_XYZ = np.array(
    (
        (0.4124564, 0.3575761, 0.1804375),
        (0.2126729, 0.7151522, 0.0721750),
        (0.0193339, 0.1191920, 0.9503041),
    )
)
_WHITE = _TO_XYZ.sum(axis=1)


def lab_of(colour: np.ndarray, vision: str = "normal") -> np.ndarray:
    """(..., 3) CIELAB of sRGB colours (..., 3) from 0 to 1, as they are seen."""
    srgb = np.asarray(colour, float)
    linear = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
    seen = np.clip(linear @ MATRICES[vision].T, 0.0, 1.0)
    part = seen @ _TO_XYZ.T / _WHITE
    f = np.where(part > (6 / 29) ** 3, np.cbrt(part), part * (29 / 6) ** 2 / 3 + 4 / 29)
    x, y, z = np.moveaxis(f, -1, 0)
    return np.stack((116 * y - 16, 500 * (x - y), 200 * (y - z)), axis=-1)


def ciede2000(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """(...) the distances of CIELAB colours (..., 3)."""
    (l1, a1, b1), (l2, a2, b2) = np.moveaxis(one, -1, 0), np.moveaxis(other, -1, 0)
    c = (np.hypot(a1, b1) + np.hypot(a2, b2)) / 2
    g = (1 - np.sqrt(c**7 / (c**7 + 25.0**7))) / 2
    a1, a2 = (1 + g) * a1, (1 + g) * a2
    c1, c2 = np.hypot(a1, b1), np.hypot(a2, b2)
    h1, h2 = np.degrees(np.arctan2(b1, a1)) % 360, np.degrees(np.arctan2(b2, a2)) % 360
    dh = (h2 - h1 + 180) % 360 - 180
    grey = c1 * c2 == 0
    dh = np.where(grey, 0.0, dh)
    mean = np.where(
        np.abs(h1 - h2) > 180, (h1 + h2 + np.where(h1 + h2 < 360, 360, -360)) / 2, (h1 + h2) / 2
    )
    h = np.where(grey, h1 + h2, mean)
    lm, cm = (l1 + l2) / 2, (c1 + c2) / 2
    t = (
        1
        - 0.17 * np.cos(np.radians(h - 30))
        + 0.24 * np.cos(np.radians(2 * h))
        + 0.32 * np.cos(np.radians(3 * h + 6))
        - 0.20 * np.cos(np.radians(4 * h - 63))
    )
    sl = 1 + 0.015 * (lm - 50) ** 2 / np.sqrt(20 + (lm - 50) ** 2)
    sc, sh = 1 + 0.045 * cm, 1 + 0.015 * cm * t
    turn = np.sin(np.radians(60 * np.exp(-(((h - 275) / 25) ** 2))))
    rt = -2 * np.sqrt(cm**7 / (cm**7 + 25.0**7)) * turn
    dl, dc = (l2 - l1) / sl, (c2 - c1) / sc
    dhh = 2 * np.sqrt(c1 * c2) * np.sin(np.radians(dh / 2)) / sh
    return np.sqrt(dl**2 + dc**2 + dhh**2 + rt * dc * dhh)
