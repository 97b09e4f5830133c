"""Draw the picture of the README from an analysis.

    python docs/make_picture.py

Needs matplotlib. Left: the self-stress of the paper's twelve trusses, coloured by sign (its
Fig. 2a). Right: the motion that is left over (its Fig. 2b).
"""

from __future__ import annotations

from pathlib import Path

import matplotlib

matplotlib.use("svg")

import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.axes3d import Axes3D

import flexact

HERE = Path(__file__).parent
TENSION, COMPRESSION, GHOST, MOVED = "#c8553d", "#2a6f97", "#b8b8b8", "#222222"


def main() -> None:
    """Analyse the deck and write the picture beside this file."""
    analysis = flexact.analyse(HERE.parent / "input_decks" / "paper" / "twelve_trusses.dat")
    model = analysis.model
    ends = model.element_nodes[:, [0, 2]]
    place = model.positions
    force = analysis.self_stresses[0].forces[:, 0]
    moved = place + 0.5 * analysis.motions[0].displacement

    matplotlib.rcParams.update({"font.family": "sans-serif", "svg.hashsalt": "flexact"})
    figure = plt.figure(figsize=(9, 4.2))
    left, right = (figure.add_subplot(1, 2, k, projection="3d") for k in (1, 2))
    for (p, q), value in zip(ends, force, strict=True):
        line(left, place[[p, q]], TENSION if value > 0 else COMPRESSION, 3)
        line(right, place[[p, q]], GHOST, 2)
        line(right, moved[[p, q]], MOVED, 2)
    for node in np.flatnonzero(np.linalg.norm(moved - place, axis=1) > 0):
        right.quiver(*place[node], *(moved - place)[node], color=TENSION, linewidth=2)
    left.set_title("the self-stress: tension and compression", fontsize=11)
    right.set_title("the motion that nothing stops", fontsize=11)
    for axes in (left, right):
        axes.scatter(*place[:4].T, marker="^", s=60, color="#444444")
        axes.set_axis_off()
        axes.set(xlim=(-1, 1), ylim=(-1, 1), zlim=(0, 1))
        axes.set_box_aspect((2, 2, 1), zoom=1.05)
        axes.view_init(elev=30, azim=-72)
    figure.tight_layout()
    figure.savefig(HERE / "twelve_trusses.svg", metadata={"Date": None})


def line(axes: Axes3D, points: np.ndarray, color: str, width: float) -> None:
    """One bar."""
    axes.plot(*points.T, color=color, linewidth=width, solid_capstyle="round")


if __name__ == "__main__":
    main()
