"""Comments of a deck stay with what they belong to when it is written again."""

import pytest
from reference_decks import NAMES, text_of

import flexact

DECK = """\
% A guide
%
# with two marks
BEAM 1 1 2 3 4   % sheet 1

% --- the second one ---
   % indented
BEAMNL 2 5 6 7 8
* as in 1995
RBEAM 3 3 4 7
% moved by a micrometre
X 3 0.1 0 0
X 7 0.1 0.05 0 % end
% turned or not
X 6 1 0 0 0
X 5 0 0.05 0
FIX 1            % clamp, left
% held at last
FIX 2 2          % first
FIX 2 3 4        % second; third
FIX 5
FIX 6
rlse 1 2 5 6     # %  what a sheet leaves free
% all of it
RLSE 2 2 5 6
% driven
INPUTX 3 2       % by the motor
INPUTE 2 1       % by a piezo
% that was the kinematics
END              % of the kinematics
HALT
% forces
FORCE 3 1        % a pull
% down
GRAVITY 0 0 -9.81 % in Delft
% time
TIMESTEP 1 10
% steel
ESTIFF 1 1 2     % of 0.2 mm
EMASS 1 3        % 7800 kg/m^3
% half a kilo
MASS 7 0.5       % measured
% the last one
END
END
"""

WRITTEN = """\
% A guide
%
# with two marks
BEAM 1 1 2 3 4 % sheet 1
% --- the second one ---
   % indented
BEAM 2 5 6 7 8
* as in 1995
RBEAM 3 3 4 7
X 1 0.0 0.0 0.0
% moved by a micrometre
X 3 0.1 0.0 0.0
X 5 0.0 0.05 0.0
% turned or not
X 6 1.0 0.0 0.0 0.0
X 7 0.1 0.05 0.0 % end
FIX 1 % clamp, left
% held at last
FIX 2 % first; second; third
FIX 5
FIX 6
% driven
DYNX 3 2 % by the motor
RLSE 1 2 5 6 % what a sheet leaves free
% all of it
RLSE 2 2 5 6
DYNE 2 1 % by a piezo
% that was the kinematics
END
HALT
% time
% steel
ESTIFF 1 1.0 2.0 % of 0.2 mm
EM 1 3.0 % 7800 kg/m^3
% half a kilo
XM 7 0.5 % measured
% forces
XF 3 1.0 0.0 0.0 % a pull
% down
GRAVITY 0.0 0.0 -9.81 % in Delft
% the last one
END
"""


def lines_of(deck: str) -> list[str]:
    return [line.strip() for line in deck.splitlines()]


def test_every_comment_has_its_place() -> None:
    model = flexact.read_text(DECK)
    assert lines_of(model.to_deck()) == lines_of(WRITTEN)
    assert flexact.read_text(model.to_deck()).to_deck() == model.to_deck()


def test_windows_lines_and_the_old_code_page() -> None:
    raw = "% F\xfchrung\r\nTRUSS 1 1 2\r\n% st\xfctzen\r\nX 2 1 0 0\r\nFIX 1 % \xa7\r\n"
    deck = flexact.read_text(raw.encode("cp1252")).to_deck()
    assert deck.startswith("% Führung\nTRUSS")
    assert "% stützen\nX 2 " in deck
    assert deck.endswith("FIX 1 % §\nEND\n")


def test_a_changed_model_keeps_what_still_has_its_statement() -> None:
    model = flexact.read_text(DECK)
    model.truss(3, model.node(9, 9, 9))
    model.release(3, 1)
    deck = model.to_deck()
    assert [line for line in lines_of(WRITTEN) if line not in lines_of(deck)] == []
    assert "TRUSS 4 3 9" in lines_of(deck)
    assert flexact.read_text(deck).to_deck() == deck


def test_comments_go_with_statements_that_are_gone() -> None:
    model = flexact.read_text(DECK)
    draft = model._change()
    # As editing does: what was stated of element 2 is stated no more.
    draft.classes[1] = (1, 1, 1, 1, 1, 1)
    deck = model.to_deck()
    assert "% by a piezo" not in deck
    assert "% all of it" not in deck
    assert "% what a sheet leaves free" in deck


def test_comments_of_the_picture_block() -> None:
    model = flexact.read_text(
        "TRUSS 1 1 2\nX 2 1 0 0\nEND\nEND\nVISUALIZATION\n"
        "; look\nBEAMPROPS 1 ; all\n% size\nCROSSDIM 1\n"
    )
    deck = model.to_deck()
    assert "% look\n" in deck
    assert "% size\n" in deck
    again = flexact.read_text(deck)
    assert again.to_deck() == deck
    assert again.data.appearance.dimensions.tolist() == [[1.0, 1.0]]


def test_without_a_block_to_stand_in() -> None:
    deck = "TRUSS 1 1 2\nX 2 1 0 0\nEND\nHALT\n% time\nTIMESTEP 1 10\nEND\n% the end\nEND\n"
    written = flexact.read_text(deck).to_deck()
    assert written.endswith("END\n% time\n% the end\n")
    assert flexact.read_text(written).to_deck() == written


@pytest.mark.parametrize("comment", ["%", "#", "%%% --- %%%", "#!", "* star", "% \t tab", "%;x"])
def test_a_comment_stays_a_comment(comment: str) -> None:
    deck = f"TRUSS 1 1 2\n{comment}\nX 2 1 0 0\n"
    written = flexact.read_text(deck).to_deck()
    assert comment.replace("\t", " ") in written.split("\n")
    assert flexact.read_text(written).to_deck() == written


def test_a_file_does_not_say_how_it_is_called() -> None:
    model = flexact.read_text("TRUSS 1 1 2\nX 2 1 0 0\n", "somewhere/here.dat")
    assert "here" not in model.to_deck()
    built = flexact.Model(name="bar")
    built.truss(built.node(0, 0, 0), built.node(1, 0, 0))
    assert built.to_deck().startswith("% bar\n")
    assert flexact.read_text(built.to_deck()).to_deck() == built.to_deck()


def behind_statements(deck: str) -> set[str]:
    kinematics = deck.split("\nEND", 1)[0].splitlines()
    return {line.split("%", 1)[1].strip() for line in kinematics if "%" in line}


@pytest.mark.parametrize("name", NAMES)
def test_sample_decks_lose_no_comment(name: str) -> None:
    model = flexact.read_text(text_of(name))
    written = model.to_deck()
    assert flexact.read_text(written).to_deck() == written
    for line in text_of(name).splitlines():
        if line.lstrip().startswith(("%", "#")):
            assert line.rstrip() in written.split("\n")
    # Of the dynamics block statements may be left out, and what stands behind them.
    assert behind_statements(text_of(name)) <= behind_statements(written)


def test_a_deleted_element_takes_its_comments_along() -> None:
    model = flexact.read_text(DECK)
    model.delete(2)
    lines = lines_of(model.to_deck())
    gone = {"% indented", "% --- the second one ---", "% all of it"}
    assert not gone & set(lines)
    assert not any("% by a piezo" in line for line in lines)
    assert {"% A guide", "* as in 1995", "% held at last", "% driven"} <= set(lines)
