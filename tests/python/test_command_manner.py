"""How the command speaks: as wide as the terminal, in colour where it is wanted, quiet, verbose."""

import itertools
import os
import re
import struct
import subprocess
import sys
import unicodedata
from pathlib import Path

import pytest
from small_decks import BROKEN, write

import flexact
from flexact.apps.cli.main import main
from flexact.util.text import columns, refitted, table, wrapped

pytestmark = pytest.mark.dear(6)

ROOT = Path(__file__).resolve().parents[2]
DECKS = ROOT / "input_decks"
SIX = str(DECKS / "paper" / "six_folded_sheets.dat")
COMMANDS = (
    ["--help"],
    ["analyse", "--help"],
    ["cost", "--help"],
    ["analyze", "x.dat"],
    ["analyse", "x.dat", "--method", "cholesky"],
    ["analyse", "-v", str(DECKS / "paper"), str(DECKS / "flexures")],
    ["advise", SIX],
    ["check", str(DECKS / "broken"), str(DECKS / "linkages")],
    ["cost", SIX, "--beams", "1", "--release", "21:2"],
    ["trace", str(DECKS / "linkages" / "sarrus.dat"), "--steps", "3", "--length", "0.1"],
    ["analyse", "none.dat"],
    ["picture", SIX, "-o", "x.xyz"],
    ["export", SIX, "-o", "six.vtu"],
    ["convert", SIX, "-o", "six.json"],
    ["declare", str(DECKS / "flexures" / "parallel_guide_four_beams.dat"), "-o", "d.dat"],
    ["regress", SIX, "--against", "answers", "--store"],
)
_PAINT = re.compile(r"\x1b\[[\d;]*m")


def wide(text: str) -> int:
    """Columns of a terminal, counted apart from the package."""
    return sum(
        0 if unicodedata.combining(c) else 2 if unicodedata.east_asian_width(c) in "WF" else 1
        for c in text
    )


@pytest.mark.parametrize("width", [40, 80, 200])
def test_every_row_fits(
    width: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", str(width))
    long = "DYNX 2 1 2 % " + "\u6f22\u5b57 " * 60
    write(tmp_path / "wide.dat", f"TRUSS 1 1 2\nX 2 1 0\nFIX 2 2 3\n{long}\n\tFOO\t{long}\n")
    for words in (*COMMANDS, ["check", "wide.dat"]):
        main(list(words))
        out, err = capsys.readouterr()
        assert out or err
        too_wide = [row for row in (out + err).split("\n") if wide(row) > width]
        assert not too_wide, (words, too_wide[0])


def test_carets_stay_below_what_they_mark(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("COLUMNS", "40")
    deck = write(tmp_path / "x.dat", f"{'BEAM 1 1 2 3 4'} {'0 ' * 40}1..5\n")
    main(["check", str(deck)])
    rows = capsys.readouterr().err.split("\n")
    for above, below in itertools.pairwise(rows):
        if set(below.partition("| ")[2].strip()) == {"^"}:
            marked = above[below.index("^") : below.rindex("^") + 1]
            assert marked.strip() == marked != ""


def test_data_is_never_broken() -> None:
    told = subprocess.run(
        [sys.executable, "-m", "flexact", "analyse", "--json", "-q", SIX],
        env={**os.environ, "COLUMNS": "40"},
        capture_output=True,
        text=True,
        check=True,
    )
    assert told.stdout.count("\n") == 1 and told.stdout.startswith("{") and not told.stderr


def on_a_terminal(words: list[str], width: int, **environment: str) -> str:
    """What the command says on a terminal of this width."""
    import fcntl
    import pty
    import termios

    ours, its = pty.openpty()
    fcntl.ioctl(its, termios.TIOCSWINSZ, struct.pack("HHHH", 24, width, 0, 0))
    kept = {k: v for k, v in os.environ.items() if k not in ("NO_COLOR", "COLUMNS", "FORCE_COLOR")}
    process = subprocess.Popen(
        [sys.executable, "-m", "flexact", *words],
        stdin=its,
        stdout=its,
        stderr=its,
        env={**kept, "TERM": "xterm", **environment},
    )
    os.close(its)
    told = b""
    while True:
        try:
            part = os.read(ours, 65536)
        except OSError:
            break
        if not part:
            break
        told += part
    process.wait()
    os.close(ours)
    return told.decode().replace("\r\n", "\n")


@pytest.mark.posix
def test_a_terminal_has_its_width_and_colour() -> None:
    told = on_a_terminal(["analyse", SIX], 50)
    assert "\x1b[1;31mOver-constrained by 1" in told
    assert max(map(wide, _PAINT.sub("", told).split("\n"))) <= 50
    assert "\x1b[" not in on_a_terminal(["analyse", SIX], 50, NO_COLOR="1")
    assert "\x1b[" not in on_a_terminal(["analyse", SIX], 50, TERM="dumb")
    assert "\x1b[" not in on_a_terminal(["analyse", SIX, "--color", "never"], 50)


@pytest.mark.parametrize(
    ("words", "environment", "coloured"),
    [
        ([], {}, False),
        (["--color", "always"], {"NO_COLOR": "1"}, True),
        ([], {"CLICOLOR_FORCE": "1"}, True),
        ([], {"FORCE_COLOR": "1"}, True),
        ([], {"FORCE_COLOR": "1", "NO_COLOR": "1"}, False),
        (["--color", "never"], {"FORCE_COLOR": "1"}, False),
        ([], {"FORCE_COLOR": "0"}, False),
        ([], {"NO_COLOR": "", "FORCE_COLOR": "1"}, True),
    ],
)
def test_colour_where_it_is_wanted(
    words: list[str],
    environment: dict[str, str],
    coloured: bool,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    for name in ("NO_COLOR", "CLICOLOR_FORCE", "FORCE_COLOR"):
        monkeypatch.delenv(name, raising=False)
    for name, value in environment.items():
        monkeypatch.setenv(name, value)
    broken = write(tmp_path / "broken.dat", BROKEN)
    main(["analyse", SIX, str(broken), *words])
    out, err = capsys.readouterr()
    assert ("\x1b[1;31mOver-constrained by 1\x1b[0m" in out) == coloured
    assert ("\x1b[1;31merror[" in err) == coloured
    assert ("\x1b" in out + err) == coloured


def test_quiet_says_errors_alone(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["analyse", "-q", SIX]) == 0
    assert capsys.readouterr() == ("", "")
    assert main(["analyse", "-q", SIX, "--expect", "exact"]) == 3
    assert capsys.readouterr().out == ""
    broken = write(tmp_path / "broken.dat", BROKEN)
    assert main(["check", "-q", str(broken)]) == 1
    out, err = capsys.readouterr()
    assert out == "" and "error[" in err
    assert main(["report", "-q", SIX, "-o", str(tmp_path / "x.html")]) == 0
    assert capsys.readouterr().out == "" and (tmp_path / "x.html").exists()


def test_verbose_says_what_is_done(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["analyse", "-v", SIX]) == 0
    out, err = capsys.readouterr()
    assert re.search(r"read in \S+ s: \d+ nodes, \d+ elements; D\(c\) \d+ x \d+ decomposed by", err)
    assert main(["analyse", SIX]) == 0
    short, err = capsys.readouterr()
    # Of the result itself, too, all is said.
    assert "The condition number" not in short and "Rank decision" in out and err == ""


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["analyse"], "decomposed by svd in "),
        (["analyse", "--fast"], "by svd (--fast: --method sparse from 100 columns of D(c) on, a"),
        (
            ["analyse", "--certain"],
            "by jacobi (--certain: --method jacobi up to 400 columns of D(c), --prove) in ",
        ),
        (["table", "--fast"], "with 4 beams a sheet (--fast: --beams 4) in "),
        (["table", "--certain"], "with auto beams a sheet (--certain: --beams auto) in "),
    ],
)
def test_verbose_says_on_one_line_what_the_trade_cost_and_gives(
    words: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([words[0], SIX, "-v", *words[1:]]) == 0
    err = capsys.readouterr().err
    gives = "proven" if words[0] == "analyse" else "with uncertainties"
    gives = "uncertainty not known" if "4 beams" in said else gives
    (line,) = [line for line in err.splitlines() if said in line]
    assert re.search(rf" in \S+ s and \d+ MB at most: {gives}$", line)


@pytest.mark.parametrize(
    ("word", "options"),
    [("--fast", []), ("--certain", ["--method", "jacobi", "--prove"])],
)
def test_a_word_for_the_trade_is_the_options_that_it_sets(
    word: str, options: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["analyse", SIX, "--json", word]) == 0
    by_word = capsys.readouterr().out
    assert main(["analyse", SIX, "--json", *options]) == 0
    assert capsys.readouterr().out == by_word


@pytest.mark.parametrize(
    ("side", "word", "method"),
    [(5, "--fast", "sparse"), (5, "--certain", "jacobi"), (16, "--certain", "sparse")],
)
def test_a_word_for_the_trade_takes_the_method_for_the_size(
    side: int, word: str, method: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model = flexact.Model(name="grid")
    for i in range(side):
        for j in range(side):
            for k, m in ((i + 1, j), (i, j + 1)):
                if k < side and m < side:
                    model.wire((0.1 * i, 0.1 * j, 0), (0.1 * k, 0.1 * m, 0))
    model.fix((0, 0, 0))
    columns = flexact.analyse(model).columns
    assert 100 < columns < 200 if side == 5 else columns > 400
    deck = write(tmp_path / "grid.dat", model.to_deck())
    assert main(["analyse", "-v", word, str(deck)]) == 0
    assert f"decomposed by {method} ({word}: " in capsys.readouterr().err


def test_rows() -> None:
    assert columns("\u6f22e\u0301") == 3
    assert wrapped("aa bb cc", 5, " ") == "aa bb\n cc"
    assert wrapped("aa bb\u00a0cc", 5) == "aa\nbb cc"
    assert wrapped("a" * 12, 5, torn=True) == "aaaaa\naaaaa\naa"
    assert refitted("  aa bb cc", 7) == "  aa bb\ncc"
    rows = [("", "one", "two"), ("x", "1", "22")]
    assert table(rows, 12) == "   one  two\nx    1   22"
    assert table(rows, 9) == "x\n  one: 1\n  two: 22"
