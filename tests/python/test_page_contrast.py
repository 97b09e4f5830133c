# SPDX-License-Identifier: BSD-3-Clause
"""Text of pages can be read: contrasts of WCAG 2.2 (1.4.3, at least 4.5), light and dark."""

import re
from importlib import resources

import pytest

STYLE = resources.files("flexact.show.page").joinpath("style.css").read_text(encoding="utf-8")
THEMES = {"light": ":root {", "dark": ':root[data-theme="dark"] {'}
TEXTS = ("ink", "soft", "accent", "node", "axis-x", "axis-y", "axis-z")
VERDICTS = ("exact", "marginal", "under", "over", "both", "broken")


def colours(theme: str) -> dict[str, str]:
    start = STYLE.index(THEMES[theme])
    return dict(re.findall(r"--([\w-]+): (#[0-9a-f]{6})", STYLE[start : STYLE.index("}", start)]))


def luminance(colour: str) -> float:
    """Relative luminance as WCAG defines it."""
    parts = [int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one: str, other: str) -> float:
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("theme", THEMES)
def test_words_stand_out_from_what_is_behind_them(theme: str) -> None:
    found = colours(theme)
    for ground in ("paper", "ground", "stage"):
        for text in (*TEXTS, *VERDICTS):
            assert contrast(found[text], found[ground]) >= 4.5, (text, ground)
    assert contrast(found["ink"], found["lit"]) >= 4.5


def test_the_system_and_the_switch_have_the_same_dark() -> None:
    start = STYLE.index(':root:not([data-theme="light"])')
    of_system = dict(
        re.findall(r"--([\w-]+): (#[0-9a-f]{6})", STYLE[start : STYLE.index("}", start)])
    )
    assert of_system == colours("dark")
