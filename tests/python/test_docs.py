"""What README.md and docs/ show is what the program does."""

from __future__ import annotations

import re
import textwrap
from pathlib import Path

import pytest

import flexact
from flexact.cli.main import main

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def blocks(text: str) -> list[str]:
    """The indented blocks of a text, without their indentation."""
    found = re.findall(r"(?:^    .*\n|^\n(?=    ))+", text, flags=re.MULTILINE)
    return [textwrap.dedent(block).strip("\n") for block in found]


def like(text: str) -> str:
    """The text without what a BLAS may round differently: the size of a zero."""
    return re.sub(r"\d(\.\d+)?e-1[0-9]", "~0", text).strip()


@pytest.mark.parametrize("verb", ["analyse", "check"])
def test_readme_shows_what_the_command_says(
    verb: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(ROOT)
    shown = [b for b in blocks(README) if b.startswith(f"$ .venv/bin/flexact {verb} ")]
    assert shown
    for block in shown:
        command, _, expected = block.partition("\n")
        main(command.split()[2:])
        out, err = capsys.readouterr()
        assert like(out + err) == like(expected)


def test_readme_shows_commands_that_write_files(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(ROOT)
    lines = re.findall(r"^    \.venv/bin/flexact ((?:report|picture|export) .*)$", README, re.M)
    assert [line.split()[0] for line in lines] == ["report", "picture", "export"]
    for line in lines:
        words = line.split()
        target = tmp_path / words[-1]
        assert main([*words[:-1], str(target)]) == 0
        assert target.stat().st_size > 1000


def test_readme_example_prints_what_is_shown(capsys: pytest.CaptureFixture[str]) -> None:
    code = README.split("```python\n")[1].split("```")[0]
    exec(compile(code, "README.md", "exec"), {})
    shown = blocks(README.split("```\n\nprints\n")[1])[0]
    assert like(capsys.readouterr().out) == like(shown)


def test_deck_of_the_manual_is_the_parallel_guide() -> None:
    """One self-stress: the two sheets hold the same rotation of the stage."""
    deck = next(b for b in blocks((ROOT / "docs" / "decks.md").read_text()) if "BEAM 1" in b)
    analysis = flexact.analyse(flexact.read_text(deck))
    assert (analysis.under_constrained, analysis.over_constrained) == (0, 1)


def test_readme_quotes_the_benchmark_table() -> None:
    """No figure that the benchmark did not print."""
    assert (ROOT / "tests" / "benchmarks" / "table.md").read_text() in README
