# SPDX-License-Identifier: BSD-3-Clause
"""The picture of a cost: panels for what there is, words that do not overlap, scales, colours."""

from __future__ import annotations

import io
from dataclasses import replace
from itertools import combinations
from math import inf, nan
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from cost_values import CRITICAL, made_up_cost, numbers, without_masses, without_stroke

import flexact
from flexact.core.elements import NodeKind
from flexact.costs.charts import (
    MOST_CLAMPS,
    bars_of,
    charts_of,
    choices_of,
    key_of,
    plot_bytes,
    plot_of,
)
from flexact.costs.designs import CostValues, Number, Released
from flexact.show.charts import STYLES, apart, exact_scale, linear_scale, log_scale, told, unit_for

pytestmark = pytest.mark.dear(8)

matplotlib = pytest.importorskip("matplotlib")
SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture(scope="module")
def cost() -> CostValues:
    return made_up_cost()


def with_notches(cost: CostValues) -> CostValues:
    """The same with notches of some stiffness: labels too long, and tolerances that are finite."""
    designs = [cost.as_built]
    for each in cost.designs[1:]:
        far = [
            t._replace(**{name: Number(10 * getattr(b, name).value, 1e-5) for name in names})
            for t, b in zip(each.tolerances, cost.as_built.tolerances, strict=True)
            for names in [[n for n in t._fields[1:] if np.isfinite(getattr(b, n).value)]]
        ]
        two = (*each.released, Released(7, 4, 123.5, "sheet 4: in-plane bending at the cylinder"))
        designs.append(replace(each, released=two, tolerances=tuple(far)))
    return replace(cost, designs=(*designs, *designs[1:], designs[1]))


def texts_of(figure: Any) -> list[Any]:
    """All words of a figure that are seen."""
    renderer = figure.canvas.get_renderer()
    figure.canvas.draw()
    found = figure.findobj(matplotlib.text.Text)
    boxes = [
        (each.get_text(), matplotlib.text.Text.get_window_extent(each, renderer))
        for each in found
        if each.get_text() and each.get_visible()
    ]
    return [(words, box) for words, box in boxes if box.width > 1.0]


def overlapping(boxes: list[Any]) -> list[tuple[str, str]]:
    def common(a: Any, b: Any) -> bool:
        across = min(a.x1, b.x1) - max(a.x0, b.x0)
        up = min(a.y1, b.y1) - max(a.y0, b.y0)
        return bool(across > 1.0 and up > 2.5)

    return [(one, two) for (one, a), (two, b) in combinations(boxes, 2) if common(a, b)]


VARIANTS = {
    "all": lambda cost: cost,
    "no stroke": without_stroke,
    "no masses": without_masses,
    "neither": lambda cost: without_stroke(without_masses(cost)),
    "six designs with notches": with_notches,
    "as built alone": lambda cost: replace(cost, designs=cost.designs[:1]),
    "with notes": lambda cost: replace(cost, left_out=("no masses are given " * 12, "a note")),
}


@pytest.mark.parametrize("variant", VARIANTS)
def test_words_overlap_nowhere_and_stay_within(variant: str, cost: CostValues) -> None:
    figure = plot_of(VARIANTS[variant](cost))
    boxes = texts_of(figure)
    assert len(boxes) > 30
    assert not overlapping(boxes)
    width, height = figure.get_size_inches() * figure.dpi
    assert all(box.x0 >= 0 and box.x1 <= width for _, box in boxes)
    assert all(box.y0 >= 0 and box.y1 <= height for _, box in boxes)


def test_the_picture_is_1200_pixels_wide_and_about_900_high(cost: CostValues) -> None:
    image = pytest.importorskip("PIL.Image").open(io.BytesIO(plot_bytes(cost)))
    assert image.size[0] == 1200 and 800 <= image.size[1] <= 1000


def test_panels_without_values_are_left_out(cost: CostValues) -> None:
    def names(of: CostValues) -> list[str]:
        return [each.name for each in (*charts_of(of), *bars_of(of))]

    every = ["stiffness", "parasitic", "misaligned", "shifts", "turns"]
    assert names(cost) == every
    assert names(without_stroke(cost)) == every[2:]
    assert names(without_masses(cost)) == [name for name in every if name != "parasitic"]
    bare = [replace(each, tolerances=(), curve=None, stroke=None) for each in cost.designs]
    nothing = replace(cost, designs=tuple(bare), stroke=None)
    assert names(nothing) == []
    assert plot_bytes(nothing).startswith(b"\x89PNG")


def test_the_headline_and_each_design_are_told(cost: CostValues) -> None:
    root = ElementTree.fromstring(plot_bytes(cost, ".svg"))
    said = [" ".join("".join(each.itertext()).split()) for each in root.iter(f"{SVG}text")]
    assert any(words.startswith("It costs: clamp 11 off by 57") for words in said)
    for label in ("as built", "21:2", "1:3"):
        assert said.count(label) == 4  # in the table and at three curves
    assert {"N/µm", "Hz", "mm"} <= {words.partition("[")[2].rstrip("]") for words in said}


def test_files_are_always_the_same_and_hold_no_nan(cost: CostValues) -> None:
    small = without_stroke(cost)
    for suffix, start in ((".svg", b"<?xml"), (".pdf", b"%PDF")):
        first = plot_bytes(small, suffix)
        assert first.startswith(start) and first == plot_bytes(small, suffix)
        assert suffix == ".pdf" or (b"nan" not in first.lower() and b"inf " not in first)


def test_values_that_are_missing_interrupt_a_curve(cost: CostValues) -> None:
    one = cost.as_built
    assert one.stroke is not None
    stiffness = one.stroke.stiffness.value.copy()
    stiffness[5, :] = nan
    stroke = replace(one.stroke, stiffness=numbers(stiffness))
    changed = replace(cost, designs=(replace(one, stroke=stroke), *cost.designs[1:]))
    chart = charts_of(changed)[0]
    assert [(run.start, run.stop) for run in chart.curves[0].runs] == [(0, 5), (6, 21)]
    assert b"nan" not in plot_bytes(changed, ".svg").lower()


def test_the_stiffness_that_loses_most_is_drawn(cost: CostValues) -> None:
    """Of the three designs 1:3 keeps least along x, a fifth (case P01)."""
    chart = charts_of(cost)[0]
    assert chart.title == "Support stiffness along x"
    ends = [float(curve.y[10]) for curve in chart.curves]
    assert ends == pytest.approx([3503052.3, 3503052.3, 703162.97])


def test_the_marks_are_the_tolerance_and_where_it_buckles(cost: CostValues) -> None:
    """Case P02: the drive free, 0.1327 mm."""
    marks = {each.words: each.points for each in charts_of(cost)[2].marks}
    assert set(marks) == {"buckles at ±133 µm", "\N{MINUS SIGN}5 % at ±57.1 µm"}
    (low, at_low), (high, at_high) = marks["buckles at ±133 µm"]
    assert (low, high) == pytest.approx((-CRITICAL, CRITICAL))
    assert at_low == at_high == pytest.approx(0.0, abs=1e-9)
    for _, frequency in marks["\N{MINUS SIGN}5 % at ±57.1 µm"]:
        assert frequency == pytest.approx(0.95 * 9.9154, rel=2e-3)


def test_bars_are_those_of_the_clamps_that_bear_least(cost: CostValues) -> None:
    many = cost.as_built.tolerances
    worse = [
        each._replace(
            misalignment=each.misalignment._replace(
                clamp=each.misalignment.clamp._replace(node=100, label="clamp 100")
            ),
            negative=Number(-1.0),
            positive=Number(1.0),
        )
        for each in many[:6]
    ]
    changed = replace(cost, designs=(replace(cost.as_built, tolerances=(*worse, *many)),))
    for chart in bars_of(changed):
        assert [group.label for group in chart.groups] == [f"clamp {k}1" for k in range(1, 7)]
        assert chart.note.endswith("; 1 more clamp bears more")
        assert len(chart.groups) == MOST_CLAMPS


def test_bars_without_an_end_stay_infinite(cost: CostValues) -> None:
    shifts, turns = bars_of(cost)
    along_x = shifts.groups[0].rows[0].bars
    assert [bar.value for bar in along_x] == [pytest.approx(57.1e-6, rel=1e-2), inf, inf]
    about_y = turns.groups[0].rows[1]
    assert about_y.label == "y" and {bar.value for bar in about_y.bars} == {inf}
    assert shifts.x.is_log and set(shifts.x.labels) == {"100 µm", "1 mm", "10 mm", "100 mm"}


def test_errors_that_mean_nothing_have_no_end(cost: CostValues) -> None:
    """Along z a clamp bears 14 mm and more, of a mechanism of 200 mm: a tenth is where bars end."""
    shifts, _ = bars_of(cost)
    along_z = [group.rows[2].bars[0].value for group in shifts.groups]
    assert along_z[0] == pytest.approx(13.7e-3, rel=1e-2)
    assert along_z[2:] == [inf] * 4
    assert "more than 20 mm" in shifts.note


def test_the_table_says_what_each_design_bears_and_keeps(cost: CostValues) -> None:
    key = key_of(cost)
    assert key.heads == (
        *("tolerance (\N{MINUS SIGN}5 %)", "buckles at"),
        *("worst stiffness kept", "lowest parasitic"),
    )
    assert key.rows[0].cells == ("57.1 µm", "133 µm", "100 %", "403 → 298 Hz")
    assert "lowest frequency 9.92 Hz" in choices_of(cost)
    assert key.rows[2].cells[:3] == ("any error", "never", "20.1 % along x")
    assert key.rows[2].words == "sheet 1: in-plane bending at its clamp (and 2 alike)"
    assert "lowest parasitic" not in key_of(without_masses(cost)).heads


def test_shapes_of_a_state_are_pictures(tmp_path: Path) -> None:
    """A clamped-guided sheet: it vibrates across, and pushed at its end it buckles."""
    guide = flexact.Model()
    guide.sheet(
        (0, 0, 0), (0.1, 0, 0), width=(0, 0, 1), breadth=0.05, thickness=5e-4, material="steel"
    )
    guide.fix((0, 0, 0))
    guide.fix((0.1, 0, 0))
    state = flexact.elastic(guide, beams=4).misaligned(3, "x", -1e-6)
    buckled = flexact.shape(state, buckled=True)
    across = np.abs(buckled.displacement[buckled.data.arrays.node_kind <= NodeKind.POSITION])
    assert across[:, 1].max() == pytest.approx(1.0) and across[:, [0, 2]].max() < 1e-3
    # 4 pi^2 EI / (EA L), with t^2 / 12 of I / A; four beams are within 5 percent.
    critical = 4 * np.pi**2 * (5e-4) ** 2 / 12 / 0.1
    assert buckled.value * 1e-6 == pytest.approx(critical, rel=0.05)
    buckled.save(tmp_path / "buckled.png", size=(300, 200))
    assert (tmp_path / "buckled.png").read_bytes().startswith(b"\x89PNG")
    with pytest.raises(flexact.FlexactError, match="there is no multiplier 99"):
        flexact.shape(state, 99, buckled=True)


def test_units_have_the_prefix_that_is_read_best() -> None:
    assert told(1.3e-4, "m") == "130 µm" and told(2e-3, "rad") == "2 mrad"
    assert told(3503052.3, "N/m") == "3.5 N/µm" and told(3937.4, "N/m") == "3.94 N/mm"
    assert told(184.43, "Hz") == "184 Hz" and told(2.5e4, "Hz") == "25 kHz"
    assert told(89602.9, "N m/rad") == "89.6 kN m/rad" and told(-1e-3, "m") == "\N{MINUS SIGN}1 mm"
    assert told(999.9999999e-6, "m") == "1 mm"
    assert unit_for([0.0, nan, inf], "m").name == "m"


@pytest.mark.parametrize(("low", "high"), [(0.0, 1.0), (-2.06e-3, 2.06e-3), (9.1, 9.4), (0, 3e7)])
def test_ticks_are_round_and_within(low: float, high: float) -> None:
    scale = exact_scale(low, high, "m")
    assert 3 <= scale.ticks.size <= 7
    steps = np.diff(scale.ticks)
    assert steps == pytest.approx(np.full(steps.size, steps[0]))
    assert np.all((scale.share(scale.ticks) > -1e-9) & (scale.share(scale.ticks) < 1 + 1e-9))


def test_scales_have_room_whatever_the_values() -> None:
    for values in ([], [nan], [0.0], [3.0], [-3.0, -3.0], [1e-12, 1e12]):
        scale = linear_scale(values, "m")
        assert scale.high > scale.low and scale.ticks.size
    for values in ([], [5e-6], [1e-9, 1.0], [inf, 2.0]):
        scale = log_scale(values, "m")
        assert scale.high >= 9.999 * scale.low > 0.0
        assert scale.ticks.size and len(set(scale.labels)) == scale.ticks.size


def test_names_keep_apart_and_move_no_more_than_needed() -> None:
    """Three of one height: the middle one stays; one far away stays as well."""
    found = apart(np.array([5.0, 5.0, 5.0, 50.0]), 2.0, 0.0, 100.0)
    assert np.sort(found).tolist() == pytest.approx([3.0, 5.0, 7.0, 50.0])
    at_the_edge = apart(np.array([0.0, 0.0]), 4.0, 0.0, 100.0)
    assert np.sort(at_the_edge).tolist() == pytest.approx([2.0, 6.0])
    crowded = np.sort(apart(np.zeros(6), 4.0, 0.0, 12.0))
    assert np.diff(crowded).tolist() == pytest.approx([2.0] * 5)


#: From linear red, green and blue to what is seen with a missing kind of cone (Machado, Oliveira
#: and Fernandes, 2009, severity 1).
SIGHTS = {
    "normal": np.eye(3),
    "protanopia": np.array(
        [
            [0.152286, 1.052583, -0.204868],
            [0.114503, 0.786281, 0.099216],
            [-0.003882, -0.048116, 1.051998],
        ]
    ),
    "deuteranopia": np.array(
        [
            [0.367322, 0.860646, -0.227968],
            [0.280085, 0.672501, 0.047413],
            [-0.011820, 0.042940, 0.968881],
        ]
    ),
    "tritanopia": np.array(
        [
            [1.255528, -0.076749, -0.178779],
            [-0.078411, 0.930809, 0.147602],
            [0.004733, 0.691367, 0.303900],
        ]
    ),
}


def linear(colour: str) -> np.ndarray:
    """Of sRGB (IEC 61966-2-1)."""
    parts = np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)]) / 255
    return np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)


def lab(rgb: np.ndarray) -> np.ndarray:
    """CIE L*a*b* of linear sRGB, white D65."""
    to_xyz = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
    xyz = np.array(to_xyz) @ rgb / (0.9505, 1.0, 1.089)
    f = np.where(xyz > 0.008856, np.cbrt(np.maximum(xyz, 0.0)), 7.787 * xyz + 16 / 116)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


@pytest.mark.parametrize("sight", SIGHTS)
@pytest.mark.parametrize("name", ["colour", "on_dark"])
def test_colours_are_told_apart_by_colour_blind_readers(name: str, sight: str) -> None:
    seen = [lab(np.clip(SIGHTS[sight] @ linear(getattr(each, name)), 0.0, 1.0)) for each in STYLES]
    assert min(np.linalg.norm(a - b) for a, b in combinations(seen, 2)) > 28.0


@pytest.mark.parametrize(("name", "ground"), [("colour", "#ffffff"), ("on_dark", "#18202a")])
def test_words_in_the_colours_can_be_read(name: str, ground: str) -> None:
    """WCAG 2.1, contrast of at least 4.5."""

    def light(colour: str) -> float:
        return float(np.dot([0.2126, 0.7152, 0.0722], linear(colour)))

    for each in STYLES:
        one, two = sorted((light(getattr(each, name)), light(ground)))
        assert (two + 0.05) / (one + 0.05) > 4.5
