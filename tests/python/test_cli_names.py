# SPDX-License-Identifier: BSD-3-Clause
"""Names of files that could move a cursor, or that are no text at all, are shown harmlessly."""

import json
from pathlib import Path

import pytest
from small_decks import BROKEN, DECKS, write

from flexact.apps.cli.main import main

pytestmark = pytest.mark.posix

NAMES = ["a\x1b[31m.dat", "b\nc.dat", "d\udcff.dat", "e\u202e.dat"]


def every_string(value: object) -> list[str]:
    if isinstance(value, dict):
        return [text for pair in value.items() for each in pair for text in every_string(each)]
    if isinstance(value, list):
        return [text for each in value for text in every_string(each)]
    return [value] if isinstance(value, str) else []


def assert_harmless(text: str) -> None:
    assert [c for c in text if not c.isprintable() and c != "\n"] == []


@pytest.mark.grid
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("content", [DECKS["exact"], BROKEN, "", None])
@pytest.mark.parametrize(
    "arguments",
    [
        ["analyse", "--expect", "over"],
        ["analyse", "-o", "{}", "--mesh", "tecplot"],
        ["analyse", "-o", "{}/in/{name}"],
        ["analyse", "--{name}"],
        ["{name}"],
        ["check"],
        ["regress", "--against", "{}/answers", "--store"],
        ["regress", "--against", "{}/answers"],
    ],
)
def test_words_are_harmless(
    name: str,
    content: str | None,
    arguments: list[str],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    path = tmp_path / "in" / name
    if content is None:
        path.mkdir(parents=True)
    else:
        write(path, content)
    other = write(tmp_path / "in" / "other.dat", DECKS["under"])
    given = [argument.format(tmp_path, name=name) for argument in arguments]
    main([*given, str(path), str(other)])
    out, err = capsys.readouterr()
    assert out + err
    assert_harmless(out)
    assert_harmless(err)
    shown = name.replace("\n", "\u240a")
    assert "b\nc" not in out + err, shown


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("content", [DECKS["exact"], BROKEN])
def test_json_is_text(
    name: str, content: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = write(tmp_path / name, content)
    main(["analyse", "--json", str(path)])
    (line,) = capsys.readouterr().out.splitlines()
    result = json.loads(line)
    assert Path(result["deck"]).name == name.replace("\udcff", "\\udcff")
    for text in every_string(result):
        text.encode("utf-8")


def test_stored_answers_are_text(tmp_path: Path) -> None:
    path = write(tmp_path / "d\udcff.dat", DECKS["exact"])
    assert main(["regress", str(path), "--against", str(tmp_path), "--store"]) == 0
    stored = (tmp_path / "d\udcff.json").read_text(encoding="utf-8")
    json.loads(stored)["deck"].encode("utf-8")
    assert main(["regress", str(path), "--against", str(tmp_path)]) == 0
