# SPDX-License-Identifier: BSD-3-Clause
"""Colours of pictures and pages, for people who see them all and for those who do not."""

from itertools import combinations

import numpy as np
import pytest
from colour_vision import MATRICES, ciede2000, lab_of

from flexact.model.parts.forms import Form
from flexact.show.drawing import members as colours

#: Distances by CIEDE2000: of what is told apart at once, and of a ghost, which has outlines, from
#: paper.
_APART, _PALE = 11.0, 4.5
#: What is behind a drawing, on paper and on light and dark pages (`page/style.css`).
PAPERS = {"paper": (1.0, 1.0, 1.0), "light": (0.984, 0.988, 0.996), "dark": (0.078, 0.106, 0.141)}
SHOWN = {
    "sheet": colours.OF_FORMS[Form.SHEET],
    "wire": colours.OF_FORMS[Form.WIRE],
    "bar": colours.OF_FORMS[Form.BAR],
    "body": colours.OF_FORMS[Form.RIGID],
    "hinge": colours.HINGE,
    "displacement": colours.ARROW,
    "freedom": colours.FREEDOM,
    "press": colours.PRESS,
    "pointed at": colours.MARK,
    "ghost": colours.GHOST_FACE,
    "negative": colours.STOPS[0],
    "positive": colours.STOPS[-1],
}
#: Of a space that is shown over a mechanism.
SPACES = {
    "freedom space": colours.FREEDOM_SPACE,
    "constraint space": colours.CONSTRAINT_SPACE,
    "new wire": colours.NEW_WIRE,
}


@pytest.mark.parametrize(
    ("one", "other", "distance"),
    [
        ((50.0, 2.6772, -79.7751), (50.0, 0.0, -82.7485), 2.0425),
        ((50.0, 2.5, 0.0), (58.0, 24.0, 15.0), 19.4535),
        ((60.2574, -34.0099, 36.2677), (60.4626, -34.1751, 39.4387), 1.2644),
        ((2.0776, 0.0795, -1.1350), (0.9033, -0.0636, -0.5514), 0.9082),
    ],
)
def test_distances_are_those_of_the_literature(
    one: tuple[float, ...], other: tuple[float, ...], distance: float
) -> None:
    """Sharma, Wu and Dalal 2005, table 1."""
    found = ciede2000(np.array(one), np.array(other))
    assert found == pytest.approx(distance, abs=5e-5)


@pytest.mark.parametrize("vision", MATRICES)
def test_what_is_drawn_differs_in_colour(vision: str) -> None:
    seen = {name: lab_of(np.array(colour), vision) for name, colour in SHOWN.items()}
    apart = {(a, b): float(ciede2000(seen[a], seen[b])) for a, b in combinations(seen, 2)}
    assert min(apart.values()) > _APART, min(apart.items(), key=lambda each: each[1])


@pytest.mark.parametrize("vision", MATRICES)
@pytest.mark.parametrize("paper", PAPERS)
def test_what_is_drawn_differs_from_what_is_behind(vision: str, paper: str) -> None:
    behind = lab_of(np.array(PAPERS[paper]), vision)
    for name, colour in (SHOWN | SPACES).items():
        far = float(ciede2000(lab_of(np.array(colour), vision), behind))
        assert far > (_PALE if name == "ghost" else _APART), name


@pytest.mark.parametrize("vision", MATRICES)
def test_spaces_differ_from_each_other_and_from_members(vision: str) -> None:
    seen = {name: lab_of(np.array(colour), vision) for name, colour in SPACES.items()}
    below = [SHOWN[name] for name in ("sheet", "wire", "bar", "body", "ghost")]
    for name, lab in seen.items():
        others = [other for key, other in seen.items() if key != name]
        for other in (*others, *(lab_of(np.array(each), vision) for each in below)):
            assert float(ciede2000(lab, other)) > _APART, name
