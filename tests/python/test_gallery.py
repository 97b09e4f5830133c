# SPDX-License-Identifier: BSD-3-Clause
"""The gallery: ten mechanisms as designers type them, and texts that designers can read aloud."""

import importlib.util
import re
from pathlib import Path
from types import ModuleType

import pytest
from wording import AsStored, masked

ROOT = Path(__file__).parents[2]
SCRIPTS = sorted((ROOT / "docs" / "gallery").glob("*.py"))
MOST_LINES = 12

#: Motions and self-stresses; a sheet stops three motions, a wire one, a notch five, a folded sheet
#: one (Aarts, Meijaard and Jonker 2011, sections 4.1 and 4.2; tests/reference/known_answers.md).
KNOWN = {
    # Two cross hinges in series, each over-constrained by one.
    "butterfly_hinge": (0, 2),
    # Nine constraints on a body that keeps one of six motions.
    "cross_hinge_three_sheets": (0, 4),
    "cross_hinge_two_sheets": (0, 1),
    "double_parallelogram": (0, 2),
    "folded_xy_theta_stage": (0, 0),
    # As every planar four-bar of ideal hinges in space.
    "notch_four_bar": (0, 3),
    "parallel_guide": (0, 1),
    "straight_guide_five_folded_sheets": (0, 0),
    "straight_guide_six_folded_sheets": (0, 1),
    "wire_hexapod": (0, 0),
}
#: What designers have to translate.
JARGON = re.compile(r"\bnode \d|\belement \d|\be[1-6]\b|local x[yz]|\bat [pq]\b")


def gallery() -> ModuleType:
    spec = importlib.util.spec_from_file_location("gallery", ROOT / "tools" / "gallery.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_every_mechanism_is_known() -> None:
    assert [script.stem for script in SCRIPTS] == sorted(KNOWN)


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_a_mechanism_is_short_and_its_verdict_known(script: Path) -> None:
    lines = [line for line in script.read_text(encoding="utf-8").splitlines() if line.strip()]
    code = [line for line in lines if not line.startswith("#")]
    assert len(code) <= MOST_LINES
    assert "numpy" not in "".join(code)
    analysis = gallery().analysis_of(script)
    assert (analysis.under_constrained, analysis.over_constrained) == KNOWN[script.stem]


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_its_text_can_be_read_aloud(script: Path) -> None:
    text = gallery().analysis_of(script).describe()
    assert not JARGON.search(text), JARGON.search(text)


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_its_page_is_what_the_program_says(script: Path, as_stored: AsStored) -> None:
    tool = gallery()
    page = masked(tool.page_of(script, tool.analysis_of(script)))
    if as_stored.renew:
        as_stored(tool.page_of(script, tool.analysis_of(script)), script.with_suffix(".md"))
    assert masked(script.with_suffix(".md").read_text(encoding="utf-8")).strip() == page.strip()


def test_the_list_names_every_mechanism() -> None:
    tool = gallery()
    stored = (ROOT / "docs" / "gallery" / "README.md").read_text(encoding="utf-8")
    assert stored == tool.contents()


def test_a_hinge_with_its_properties_takes_fifteen_statements() -> None:
    text = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
    code = text[text.index("```python\nimport flexact\n\nhinge = ") :].split("```")[1]
    statements = [line for line in code.splitlines() if line and not line.startswith((" ", ")"))]
    assert len(statements) <= 15 and "material" in code and "mass" in code
