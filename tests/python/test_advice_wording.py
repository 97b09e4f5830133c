# SPDX-License-Identifier: BSD-3-Clause
"""The words of advice, as a person reads them: all of them stand in golden/advice.

`make wording` writes the files anew; the difference is read before it is committed.
"""

import pytest
from reference_decks import ROOT
from wording import GOLDEN, AsStored, masked

import flexact

INPUT = ROOT / "input_decks"


@pytest.mark.parametrize(
    "name",
    [
        "paper/folded_sheet_free",
        "paper/five_folded_sheets_symmetric",
        "paper/six_folded_sheets",
        "paper/twelve_trusses",
        "flexures/cross_hinge_undeclared",
        "flexures/five_wires_lower_two_parallel",
        "flexures/parallel_guide_four_beams_undeclared",
        "frameworks/collinear_bars_space",
        "linkages/four_bar_planar",
        "linkages/sarrus",
    ],
)
def test_words_of_advice(name: str, as_stored: AsStored) -> None:
    said = flexact.analyse(INPUT / f"{name}.dat", name=name).advice().describe()
    assert all(len(line) <= 100 for line in said.splitlines())
    as_stored(masked(said), GOLDEN / "advice" / f"{name.rpartition('/')[2]}.txt")
