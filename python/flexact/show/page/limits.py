# SPDX-License-Identifier: BSD-3-Clause
"""How much of a very large result a page holds, and how that is told."""

from __future__ import annotations

#: Motions, declared degrees of freedom, and self-stresses, of each.
MOST_MODES = 12
#: Motions that move in the drawing where there are more elements than these: each takes a while
#: to be drawn, and people wait for the page.
FEW_MODES, MANY_ELEMENTS = 3, 2000
#: Members that are drawn.
MOST_MEMBERS = 20_000
#: Bytes of all movements together, and of one at all its phases, before they are written as text;
#: of one among other things, as in a notebook.
MOST_POSES = 10_000_000
MOST_SHAPES = 2_000_000
FEW_SHAPES = 30_000
#: Elements up to which the declared degrees of freedom are looked at one by one, each of which
#: takes an analysis of its own.
MOST_ELEMENTS = 10_000
#: Lines of the deck.
MOST_LINES = 4000
#: Parts of a motion or a self-stress in its table.
MOST_PARTS = 8
