# SPDX-License-Identifier: BSD-3-Clause
"""`.show()` and `flexact view`: the page in the browser, where there is one."""

import os
import re
import signal
import subprocess
import sys
import types
from pathlib import Path
from typing import Any

import pytest

import flexact
from flexact.apps.cli.main import main
from flexact.apps.cli.terminal import ExitCode

pytestmark = pytest.mark.dear(4)

ROOT = Path(__file__).resolve().parents[2]
DECK = ROOT / "input_decks" / "paper" / "six_folded_sheets.dat"
BROKEN = ROOT / "input_decks" / "broken" / "unknown_keyword.dat"


@pytest.fixture
def opened(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> list[str]:
    """Addresses that a browser would open, at a desk with a screen."""
    found: list[str] = []
    monkeypatch.setattr("webbrowser.open", lambda address: found.append(address) or True)
    monkeypatch.setenv("DISPLAY", ":0")
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr("tempfile.tempdir", None)
    return found


def of(address: str) -> str:
    return Path(address.removeprefix("file://")).read_text(encoding="utf-8")


def test_a_model_and_a_result_are_shown(opened: list[str], capsys: Any) -> None:
    model = flexact.read(DECK)
    for shown in (model, flexact.analyse(model)):
        path = shown.show()
        assert path is not None and path.is_file()
        assert opened[-1] == path.as_uri()
        assert "Over-constrained" in of(opened[-1])
    assert not capsys.readouterr().out


def test_every_way_to_a_model_leads_to_one_that_shows(opened: list[str]) -> None:
    made = flexact.analyse(flexact.read(DECK)).model
    assert made.with_positions(made.positions).show() is not None
    table = flexact.sweep(made, positions=made.positions[None])
    assert table.model(0).show() is not None
    assert len(opened) == 2


def test_a_wrong_model_shows_its_errors(opened: list[str]) -> None:
    model = flexact.Model(name="wrong")
    path = model.show()
    assert path is not None and "Cannot be analysed" in of(opened[0])
    assert "wrong" in path.name


def test_a_page_goes_where_it_is_wanted(opened: list[str], tmp_path: Path) -> None:
    target = tmp_path / "six.html"
    assert flexact.read(DECK).show(target) == target
    assert opened == [target.as_uri()]
    with pytest.raises(flexact.FlexactError, match=r"such as guide\.html"):
        flexact.read(DECK).show(tmp_path / "six.png")
    with pytest.raises(flexact.FlexactError):
        flexact.read(DECK).show(tmp_path / "\0.html")
    assert sorted(each.name for each in tmp_path.iterdir()) == ["six.html"]


def run(*words: str, **more: str) -> subprocess.CompletedProcess[str]:
    env = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
    return subprocess.run(
        [sys.executable, *words],
        *(),
        env={**env, "BROWSER": "", **more},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )


def test_without_a_screen_it_says_where_the_page_is(tmp_path: Path) -> None:
    code = f"import flexact; print(repr(flexact.read({str(DECK)!r}).show()))"
    done = run("-c", code, TMPDIR=str(tmp_path))
    assert done.returncode == 0 and not done.stderr
    (page,) = tmp_path.iterdir()
    assert done.stdout.splitlines() == [f"The page is {page}", f"PosixPath({str(page)!r})"]


def test_a_browser_that_fails_is_no_error(tmp_path: Path) -> None:
    code = f"import flexact; flexact.read({str(DECK)!r}).show()"
    for browser in ("/bin/false", "/no/such/browser"):
        done = run("-c", code, TMPDIR=str(tmp_path), BROWSER=f"{browser} %s")
        assert done.returncode == 0 and not done.stderr
        assert "The page is" in done.stdout


@pytest.mark.posix
def test_a_browser_that_stays_holds_nobody_up(tmp_path: Path) -> None:
    script = tmp_path / "browser.sh"
    script.write_text(f"#!/bin/sh\necho $$ > {tmp_path}/pid\nexec sleep 60 > /dev/null 2>&1\n")
    script.chmod(0o755)
    code = f"import flexact; flexact.read({str(DECK)!r}).show({str(tmp_path / 'a.html')!r})"
    done = run("-c", code, BROWSER=f"{script} %s")
    browser = int((tmp_path / "pid").read_text())
    # It is still there, and is not waited for.
    os.kill(browser, signal.SIGTERM)
    assert done.returncode == 0 and not done.stderr and not done.stdout


def test_a_notebook_displays_it(opened: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    shown: list[Any] = []
    notebook = types.ModuleType("IPython")
    notebook.get_ipython = lambda: types.SimpleNamespace(kernel=None)  # type: ignore[attr-defined]
    display = types.ModuleType("IPython.display")
    display.display = shown.append  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "IPython", notebook)
    monkeypatch.setitem(sys.modules, "IPython.display", display)
    assert flexact.read(DECK).show() is None
    assert "Over-constrained" in shown[0]._repr_html_()
    assert flexact.Model().show() is None
    assert "<pre>" in shown[1]._repr_html_()
    assert not opened


def test_the_command_views_a_deck(opened: list[str], capsys: Any, tmp_path: Path) -> None:
    assert main(["view", str(DECK)]) == ExitCode.ANALYSED
    assert "over-constrained" in capsys.readouterr().out
    assert "Over-constrained" in of(opened[0])
    target = tmp_path / "page.html"
    assert main(["view", str(DECK), "--no-browser", "-o", str(target)]) == ExitCode.ANALYSED
    assert len(opened) == 1 and target.is_file()
    assert str(target) in capsys.readouterr().out


def test_the_command_views_the_errors_of_a_deck(opened: list[str], capsys: Any) -> None:
    assert main(["view", str(BROKEN)]) == ExitCode.DECK_ERROR
    said = capsys.readouterr()
    assert "error[" in said.err
    assert re.search(r"cannot be analysed; page in \S+\.html", said.out)
    assert "Cannot be analysed" in of(opened[0])


def test_what_cannot_be_viewed_is_said(opened: list[str], capsys: Any, tmp_path: Path) -> None:
    assert main(["view", str(tmp_path / "gone.dat")]) == ExitCode.DECK_ERROR
    assert main(["view", str(DECK), "-o", str(tmp_path / "page.png")]) == ExitCode.OTHER
    assert "such as guide.html" in capsys.readouterr().err
    deck = tmp_path / "a.html"
    deck.write_bytes(DECK.read_bytes())
    assert main(["view", str(deck), "-o", str(deck)]) == ExitCode.OTHER
    assert deck.read_bytes() == DECK.read_bytes()
    assert not opened
