"""Stored answers of many decks: the same by any workers, and a summary that can be acted on."""

import os
import re
import shlex
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from dask_cluster import running_cluster
from junit_schema import read_junit
from small_decks import COLLINEAR

from flexact.apps.checks import comparison
from flexact.apps.cli.main import main
from flexact.sweeps import pool as local_pool

RAISED = COLLINEAR.replace("X 3 1 0", "X 3 1 1")
#: Of the decks that are stored, what they become before they are compared.
CHANGED = {
    "a/numbers": RAISED.replace("X 3 1 1", "X 3 1 1.1"),
    "b/broken": "PLTRUSS 1 1\n",
    "c/verdict": COLLINEAR,
    "d/same": RAISED,
    "e/same": RAISED,
    "f/new": RAISED,
}


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Six decks, of which two are as stored; and their answers."""
    monkeypatch.chdir(tmp_path)
    for name in CHANGED:
        path = Path("decks", f"{name}.dat")
        path.parent.mkdir(parents=True)
        path.write_text(RAISED)
    assert main(["regress", "decks", "--against", "answers", "--store", "-j", "2"]) == 0
    for name, text in CHANGED.items():
        Path("decks", f"{name}.dat").write_text(text)
    Path("answers/f/new.json").unlink()
    return tmp_path


def compared(*words: str, code: int, out: Any) -> tuple[str, str]:
    assert main(["regress", "decks", "--against", "answers", *words]) == code
    said = out.readouterr()
    return said.out, said.err


def heads(text: str, pattern: str = r"decks/(\w+/\w+)\.dat: ") -> list[str]:
    """The decks that stand at the beginning of lines."""
    return re.findall(f"^{pattern}", text, re.MULTILINE)


def answers() -> dict[str, bytes]:
    return {str(path): path.read_bytes() for path in sorted(Path("answers").rglob("*.json"))}


def test_the_same_is_said_by_any_workers(folder: Path, capsys: Any) -> None:
    """In the order of the decks."""
    alone = compared("-j", "1", code=1, out=capsys)
    assert heads(alone[0]) == ["a/numbers", "c/verdict", "d/same", "e/same"]
    assert compared("-j", "3", code=1, out=capsys) == alone
    assert compared(code=1, out=capsys) == alone
    pytest.importorskip("distributed")
    with running_cluster(folder / "dask", workers=1) as cluster:
        assert compared("--dask", cluster.address, code=1, out=capsys) == alone


def test_the_summary_names_what_wants_attention_the_worst_first(folder: Path, capsys: Any) -> None:
    out, _ = compared(code=1, out=capsys)
    _, closing = out.split("6 decks: ")
    assert re.findall(r"\d+ \w+", closing.splitlines()[0]) == [
        "2 as", "2 different", "1 failed", "1 without",
    ]  # fmt: skip
    named = heads(closing, r"  decks/(\w+/\w+)\.dat\b")
    assert named == ["c/verdict", "a/numbers", "b/broken", "f/new"]
    assert "verdict" in closing and "bad" not in closing


def test_the_command_in_the_summary_stores_what_differs_alone(folder: Path, capsys: Any) -> None:
    before = answers()
    out, _ = compared(code=1, out=capsys)
    words = shlex.split(out.splitlines()[-1])
    assert words[:2] == ["flexact", "regress"]
    # The broken deck is still one.
    assert main(words[1:]) == 1
    after = answers()
    changed = {name for name in after if after[name] != before.get(name)}
    assert changed == {f"answers/{name}.json" for name in ("a/numbers", "c/verdict", "f/new")}
    capsys.readouterr()
    out, _ = compared(code=1, out=capsys)
    assert out.count("as stored") == 6 and "--store" not in out


def test_junit_has_a_test_case_a_deck(folder: Path, capsys: Any) -> None:
    compared("--junit", "made/junit.xml", code=1, out=capsys)
    suite = read_junit(Path("made/junit.xml").read_bytes())
    cases = suite.findall("testcase")
    assert [case.attrib["name"] for case in cases] == [f"decks/{name}.dat" for name in CHANGED]
    kinds = [[child.tag for child in case] for case in cases]
    assert kinds == [["failure"], ["error"], ["failure"], [], [], ["error"]]
    verdict = cases[2].find("failure")
    assert verdict is not None and verdict.attrib["message"].startswith("verdict: ")
    assert all(float(case.attrib["time"]) > 0.0 for case in cases if not len(case))
    assert cases[3].attrib["classname"].endswith(".d")


def test_junit_of_odd_names_and_of_one_deck(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    """What XML cannot hold is made harmless; a name need not be text at all."""
    monkeypatch.chdir(tmp_path)
    name = os.fsdecode(b"<a>&\"\x1b\xff'.dat")
    Path(name).write_text(RAISED)
    assert main(["regress", name, "--against", "answers", "--junit", "j.xml"]) == 1
    (case,) = read_junit(Path("j.xml").read_bytes()).findall("testcase")
    assert case.attrib["name"].startswith('<a>&"') and len(case) == 1


def test_where_junit_cannot_be_written_nothing_is_begun(folder: Path, capsys: Any) -> None:
    Path("file").write_text("")
    out, err = compared("--junit", "file/junit.xml", code=2, out=capsys)
    assert out == "" and "file" in err
    before = answers()
    for taken in ("decks/d/same.dat", "answers/d/same.json"):
        assert compared("--junit", taken, code=2, out=capsys)[0] == ""
    assert Path("decks/d/same.dat").read_text() == RAISED and answers() == before


@pytest.mark.posix
@pytest.mark.skipif(not local_pool.FORKS, reason="processes are not forked here")
def test_a_deck_that_kills_its_worker_fails_alone(
    folder: Path, capsys: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = comparison._found

    def deadly(case: comparison.Case, *asked: Any) -> comparison.Comparison:
        if "same" in case[0]:
            os.kill(os.getpid(), signal.SIGKILL)
        return whole(case, *asked)

    monkeypatch.setattr(comparison, "_found", deadly)
    out, err = compared("-j", "2", code=2, out=capsys)
    assert heads(out) == ["a/numbers", "c/verdict"]
    assert err.count("signal 9") == 2


def test_a_scheduler_that_is_not_there_is_said_in_words(
    folder: Path, capsys: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    client = pytest.importorskip("flexact.sweeps.dask")
    monkeypatch.setattr(client, "_ANSWER", 0.5)
    out, err = compared("--dask", "tcp://127.0.0.1:9", code=2, out=capsys)
    assert out == "" and "dask scheduler" in err and "Traceback" not in err


def test_of_one_deck_no_pool_is_loaded(folder: Path) -> None:
    """It starts as quickly as ever."""
    script = (
        "import sys; from flexact.apps.cli.main import main;"
        "main(['regress', 'decks/d/same.dat', '--against', 'answers/d']);"
        "sys.exit('multiprocessing.connection' in sys.modules or 'xml.etree' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", script], check=False).returncode == 0
