# SPDX-License-Identifier: BSD-3-Clause
"""Options of all verbs mean one thing: what is given twice, in two ways, is refused."""

from __future__ import annotations

import argparse
import itertools
from collections.abc import Iterator
from pathlib import Path

import pytest

from flexact.apps.cli.command import VERBS, parser_of
from flexact.apps.cli.main import main

DECK = "input_decks/flexures/notch_guide.dat"
#: Values of options that take no choices, by what help calls them.
_VALUES = {
    **{"K": ("1", "2"), "N": ("3", "4"), "L": ("1mm", "2mm"), "T": ("1e-9", "1e-8")},
    **{"D": ("1e-9", "1e-8"), "DIR": ("results/a", "results/b"), "VIEW": ("iso", "top")},
    **{"FILE": ("a.svg", "b.svg"), "PAGE": ("a.html", "b.html"), "TABLE": ("a.csv", "b.csv")},
    **{"LENGTH[,ANGLE]": ("20um", "30um"), "QUANTITY": ("N", "T"), "FORMAT": ("vtu", "vtk")},
    **{"CONDITION": ("rank > 1", "rank > 2"), "ADDRESS": ("tcp://a:1", "tcp://b:1")},
    **{"POINT": ("1", "2"), "POINT:C=FROM..TO": ("1:x=0..1mm", "1:x=0..2mm"), "auto|N": ("1", "2")},
    **{"RATIO": ("1%", "2%"), "POINT:C=VALUE": ("1:x=1mm", "1:x=2mm")},
    **{"PART": ("-1%", "-2%"), "NAME": ("a", "b"), "POINTS": ("1", "2")},
    **{"X,Y,Z": ("0,0,1mm", "0,0,2mm"), "KELVIN": ("10", "20"), "ALPHA": ("1e-5", "2e-5")},
    **{"SD,SD,thickness=SD": ("20um", "30um")},
    **{
        "DIRECTION": ("x", "y"),
        "GX,GY,GZ": ("0,0,1", "0,0,2"),
        "KELVIN,ALPHA": ("1,1e-5", "2,1e-5"),
    },
    **{"SCORE": ("parts", "room"), "KINDS": ("wire", "sheet"), "SYMMETRY": ("any", "none")},
    # Older names, which help leaves out.
    **{"--format": ("vtu", "vtk"), "--tolerance": ("1e-9", "1e-8")},
}
_MANY = (argparse._AppendAction, argparse._CountAction)


def _options() -> Iterator[tuple[str, argparse.Action]]:
    for verb in VERBS:
        for action in parser_of(verb)._actions:
            if action.option_strings and action.dest not in ("help", "version"):
                yield verb, action


def _words(verb: str, *without: str) -> list[str]:
    """What a verb cannot do without, but for some options."""
    words = []
    for action in parser_of(verb)._actions:
        if not action.option_strings:
            choices = list(action.choices or ())
            words.append(choices[0] if choices else DECK)
        elif action.required and not set(without) & set(action.option_strings):
            words += [action.option_strings[0], _values(action)[0]]
    return words


def _values(action: argparse.Action) -> list[str]:
    if action.choices:
        return [str(each) for each in action.choices][:2]
    return list(_VALUES[str(action.metavar or action.option_strings[0])])


SINGLE = [
    (verb, name)
    for verb, action in _options()
    if action.nargs != 0 and not isinstance(action, _MANY) and len(set(_values(action))) > 1
    for name in action.option_strings
]
FLAGS = [
    (verb, action.option_strings)
    for verb, action in _options()
    if isinstance(action, argparse.BooleanOptionalAction)
]


def _refused(verb: str, words: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    """What is said where words are refused; empty where they are taken."""
    try:
        parser_of(verb).parse_args(words)
    except SystemExit as ending:
        assert ending.code == 2
        return capsys.readouterr().err
    return ""


def test_all_options_are_met() -> None:
    assert len(SINGLE) > 60 and len(FLAGS) >= 9


@pytest.mark.parametrize(("verb", "name"), SINGLE)
def test_a_single_value_that_is_given_twice_is_refused(
    verb: str, name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    (action,) = [a for v, a in _options() if v == verb and name in a.option_strings]
    first, last = _values(action)
    words = _words(verb, name)
    assert "given twice" in _refused(verb, [*words, name, first, name, last], capsys)
    # As an alias of the shell may do: it means one thing.
    assert _refused(verb, [*words, name, last, name, last], capsys) == ""
    assert _refused(verb, [*words, f"{name}={last}"], capsys) == ""
    others = [other for other in action.option_strings if other != name]
    for other in others:
        told = _refused(verb, [*words, name, first, other, last], capsys)
        assert "contradict" in told and name in told and other in told


@pytest.mark.parametrize(("verb", "names"), FLAGS)
def test_on_and_off_are_refused_together(
    verb: str, names: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    for on, off in itertools.permutations(names, 2):
        told = _refused(verb, [*_words(verb), on, off], capsys)
        assert "contradict" in told and on in told and off in told
        assert _refused(verb, [*_words(verb), on, on], capsys) == ""


@pytest.mark.parametrize("verb", VERBS)
def test_options_of_which_one_is_chosen_are_refused_together(
    verb: str, capsys: pytest.CaptureFixture[str]
) -> None:
    parser = parser_of(verb)
    for group in parser._mutually_exclusive_groups:
        for one, other in itertools.permutations(group._group_actions, 2):
            words = _words(verb)
            for action in (one, other):
                words += [action.option_strings[0]]
                words += [] if action.nargs == 0 else _values(action)[:1]
            assert "not allowed with" in _refused(verb, words, capsys)


@pytest.mark.parametrize("verb", [v for v, a in _options() if "-o" in a.option_strings])
def test_of_two_files_none_is_dropped(
    verb: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Both are written, or the call is refused and none is."""
    suffix = {
        **dict.fromkeys(("picture", "advise", "trace"), ".svg"),
        **dict.fromkeys(("export",), ".vtu"),
        **dict.fromkeys(("batch", "cost", "table"), ".csv"),
        **dict.fromkeys(("view", "report"), ".html"),
        **dict.fromkeys(("declare", "convert"), ".dat"),
    }.get(verb, "")
    files = [tmp_path / f"{name}{suffix}" for name in "ab"]
    words = [verb, DECK, *itertools.chain(*(("-o", str(file)) for file in files))]
    words += ["--beams", "1"] if verb in ("cost", "table") else []
    code = main(words)
    written = [file.exists() for file in files]
    assert written == ([True, True] if code == 0 else [False, False])
    assert code in (0, 2)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("cost --release none --release 1:3", "choose"),
        ("cost --release 1:3 --release none", "choose"),
        ("cost --points 5", "--stroke"),
        ("table --points 5", "--stroke"),
        ("table --expansion 1e-5", "--warm"),
        ("cost --misalign 11:x=50um --misalign 11:x=1um", "twice"),
        ("batch -o a.csv --want verdict --columns values", "unexpected argument"),
        ("batch -o a.csv --mesh vtu --format vtk --files f", "unexpected argument"),
        ("regress --against a --within 1e-9 --tolerance 1e-8", "unexpected argument"),
        ("analyse --format vtu --mesh vtk -o d", "invalid value"),
        ("analyse --json --log spacar", "choose"),
        ("analyse --json --summary", "choose"),
        ("picture -o a.svg --motion 1 --freedom 1", "not allowed with"),
        ("analyse --fast --certain", "--fast and --certain contradict"),
        ("analyse --certain --no-prove", "--certain and --no-prove contradict"),
        # Also where both say the same.
        ("report -o a.html --method sparse --fast", "--method and --fast contradict"),
        ("advise --certain --prove", "--certain and --prove contradict"),
        ("cost --fast --beams 4", "--fast and --beams contradict"),
    ],
)
def test_what_contradicts_itself_is_refused(
    words: str,
    said: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    deck = str(Path(DECK).absolute())
    monkeypatch.chdir(tmp_path)
    verb, *rest = words.split()
    assert main([verb, deck, *rest]) in (1, 2)
    assert said in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def test_declare_writes_no_copy_where_nothing_is_declared(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    target = tmp_path / "declared.dat"
    assert main(["declare", DECK, "-o", str(target)]) == 0
    assert "nothing to declare" in capsys.readouterr().out and not target.exists()
    # On standard output a deck goes on through a pipe.
    assert main(["declare", DECK, "-o", "-"]) == 0
    out, err = capsys.readouterr()
    assert out.count("HINGE") == 4 and "nothing to declare" in err
    undeclared = "input_decks/flexures/parallel_guide_four_beams_undeclared.dat"
    assert main(["declare", undeclared, "-o", str(target)]) == 0
    assert target.exists()
