# SPDX-License-Identifier: BSD-3-Clause
"""``flexact lsp`` as an editor meets it: a real client over stdin and stdout."""

from __future__ import annotations

import random
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from editor_fuzz import mutated
from language_client import PATIENCE, URI, Client
from reference_decks import NAMES, ROOT, text_of
from test_editor_words import GUIDE

from flexact.apps.cli.terminal import ExitCode
from flexact.deck.rendering import DeckError
from flexact.model.reading import read_bytes

pytestmark = pytest.mark.dear(10)

pytest.importorskip("pygls")
START = {"line": 0, "character": 0}
BROKEN = sorted((ROOT / "input_decks" / "broken").glob("*.dat"))


@pytest.fixture(scope="module")
def shared() -> Iterator[Client]:
    made = Client(options={"verdict": True})
    yield made
    made.kill()


@pytest.fixture
def client(shared: Client) -> Iterator[Client]:
    """One for tests that leave it as it was: it takes a second to start."""
    yield shared
    shared.tell("textDocument/didClose", {"textDocument": {"uri": URI}})
    shared.of("foldingRange")
    shared.kept.clear()


@pytest.fixture
def start() -> Iterator[Callable[..., Client]]:
    """Makes clients, and ends them."""
    made: list[Client] = []

    def begin(**chosen: Any) -> Client:
        made.append(Client(**chosen))
        return made[-1]

    yield begin
    for one in made:
        one.kill()


def replaced(line: int, first: int, last: int, text: str) -> dict[str, Any]:
    """A change within a line."""
    ends = ({"line": line, "character": character} for character in (first, last))
    return {"range": dict(zip(("start", "end"), ends, strict=True)), "text": text}


def verdict_of(diagnostics: list[dict[str, Any]]) -> str:
    (words,) = (one["message"] for one in diagnostics if one["code"] == "verdict")
    return str(words)


def fixes(client: Client, line: int, least: int = 1) -> list[dict[str, Any]]:
    """So many at least: the server gives up waiting for steps where it is kept busy."""
    end = time.monotonic() + PATIENCE
    while len(found := _fixes(client, line)) < least and time.monotonic() < end:
        pass
    return found


def _fixes(client: Client, line: int) -> list[dict[str, Any]]:
    where = {"line": line, "character": 0}
    context = {"diagnostics": [], "triggerKind": 1}
    found: list[dict[str, Any]] = client.of(
        "codeAction", range={"start": where, "end": where}, context=context
    )
    return found


def test_a_deck_is_typed_and_mended(start: Callable[..., Client]) -> None:
    """From a new file to an exact mechanism: problems, verdict, step, verdict."""
    client = start(options={"verdict": True})
    client.open("")
    assert [one["code"] for one in client.diagnostics(1)] == ["empty-deck"]
    client.change(2, {"text": GUIDE.replace("FIX 6", "FIXX 6")})
    (problem,) = client.diagnostics(2)
    assert problem["code"] == "unknown-keyword" and problem["severity"] == 1
    assert problem["relatedInformation"][-1]["message"] == "help: did you mean FIX?"
    (fix,) = fixes(client, 9)
    assert fix["title"] == "write FIX" and fix["isPreferred"]
    client.change(3, *({"range": e["range"], "text": e["newText"]} for e in edits_of(fix)))
    assert client.diagnostics(3) == []
    found = client.diagnostics(3, verdict=True)
    assert verdict_of(found).startswith("over-constrained by 1; ")
    assert "sheet 1 and sheet 2 both hold the stage" in str(found[-1]["relatedInformation"])
    step = next(
        one for one in fixes(client, 0) if one["title"].startswith("Cut sheet 1 to a waist")
    )
    edits = edits_of(client.ask("codeAction/resolve", step))
    client.change(4, *({"range": e["range"], "text": e["newText"]} for e in edits))
    assert verdict_of(client.diagnostics(4, verdict=True)).startswith("exactly constrained; ")
    assert fixes(client, 0, 0) == []
    said = client.wait(
        lambda one: (
            one.get("method") == "flexact/verdict"
            and one["params"]["version"] == 4
            and bool(one["params"]["words"])
        )
    )
    assert said["params"]["errors"] == 0
    assert client.end() == (0, "")


def edits_of(action: dict[str, Any]) -> list[dict[str, Any]]:
    """The edits of an action, from the end of the deck to its start."""
    edits = action["edit"]["changes"][URI]
    return sorted(edits, key=lambda one: list(one["range"]["start"].values()), reverse=True)


def test_questions_at_a_place_are_answered(client: Client) -> None:
    client.open(GUIDE)
    hover = client.at("hover", 10, 10)
    assert hover["contents"]["kind"] == "markdown"
    assert "out-of-plane bending at its clamp" in hover["contents"]["value"]
    assert hover["range"]["start"] == {"line": 10, "character": 10}
    (where,) = client.at("definition", 12, 5)
    assert where["uri"] == URI and where["range"]["start"] == {"line": 3, "character": 2}
    context = {"includeDeclaration": False}
    lines = [
        one["range"]["start"]["line"] for one in client.at("references", 3, 2, context=context)
    ]
    assert lines == [0, 2, 12]
    assert len(client.at("documentHighlight", 3, 2)) == 4
    offered = client.at("completion", 6, 0, context={"triggerKind": 1})["items"]
    beam = next(one for one in offered if one["label"] == "BEAM")
    assert beam["insertTextFormat"] == 2 and "${2:p}" in beam["textEdit"]["newText"]
    groups = {one["name"]: one for one in client.of("documentSymbol")}
    assert [one["name"] for one in groups["parts"]["children"]] == ["sheet 1", "sheet 2", "stage"]
    assert {"startLine": 0, "endLine": 13, "kind": "region"} in client.of("foldingRange")
    assert client.at("prepareRename", 3, 2)["start"] == {"line": 3, "character": 2}
    edit = client.at("rename", 3, 2, newName="33")
    assert len(edit["changes"][URI]) == 4
    where = {"textDocument": {"uri": URI}, "position": {"line": 3, "character": 2}}
    answer = client.answer("textDocument/rename", {**where, "newName": "7"})
    assert "there is a node 7 already" in answer["error"]["message"]
    # Of a file that is not open nothing is known.
    assert client.at("hover", 0, 0, uri="file:///nowhere.dat") is None
    assert (
        client.of(
            "codeAction",
            uri="file:///nowhere.dat",
            range={"start": START, "end": START},
            context={"diagnostics": []},
        )
        == []
    )


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16", "utf-32"])
def test_editors_count_as_they_like(start: Callable[..., Client], encoding: str) -> None:
    """What is typed behind wide letters stands where the editor says."""
    client = start(general={"positionEncodings": [encoding]})
    assert client.able["positionEncoding"] == encoding
    client.open("TRUSS 1 1 2\nX 2 1 0 0\nFIX 1\n% é😀 \nFIX 2 % é😀\r\nFIX 2 1\t9 % \u2028😀\n")
    (problem,) = client.diagnostics(1)
    assert problem["range"]["start"] == {"line": 5, "character": 8}
    # A letter behind the wide ones of the comment goes, and a line with an error comes.
    wide = {"utf-8": 8, "utf-16": 5, "utf-32": 4}[encoding]
    client.change(
        2,
        replaced(3, wide, wide + 1, "\nTRUSS 1 3 4 % "),
        replaced(6, 8, 9, "3"),
    )
    codes = {one["code"]: one["range"]["start"]["line"] for one in client.diagnostics(2)}
    assert codes["duplicate-element"] == 4


def test_problems_are_those_of_check(start: Callable[..., Client]) -> None:
    """Code, words, severity, help and places, of every broken deck."""
    client = start()
    for version, path in enumerate(BROKEN, start=1):
        raw = path.read_bytes()
        text = raw.decode("utf-8", "replace")
        uri = path.as_uri()
        client.open(text, uri, version)
        found = client.diagnostics(version)
        with pytest.raises(DeckError) as caught:
            read_bytes(text.encode(), "deck")
        wanted = caught.value.diagnostics
        assert [one["code"] for one in found] == [item.code for item in wanted], path.name
        for one, item in zip(found, wanted, strict=True):
            assert one["message"] == item.message
            levels = {"error": 1, "warning": 2, "note": 3}
            assert one["severity"] == levels[item.severity.value]
            related = [each["message"] for each in one.get("relatedInformation") or []]
            assert (f"help: {item.help}" in related) == bool(item.help)
            if item.line and text.isascii():
                begin = one["range"]["start"]
                assert (begin["line"], begin["character"]) == (item.line - 1, item.column - 1)
            if item.other is not None:
                lines = [
                    each["location"]["range"]["start"]["line"] for each in one["relatedInformation"]
                ]
                assert item.other.line - 1 in lines
        client.tell("textDocument/didClose", {"textDocument": {"uri": uri}})


def test_an_editor_without_related_places_gets_all_in_the_message(
    start: Callable[..., Client],
) -> None:
    plain, wordy = start(textDocument={}), start(options={"help": "message"})
    for client in (plain, wordy):
        client.open("TRUS 1 1 2\n")
        found = client.diagnostics(1)
        message = next(one["message"] for one in found if one["code"] == "unknown-keyword")
        assert message.endswith("help: did you mean TRUSS?")
        assert all("relatedInformation" not in one for one in found)
    plain.open(GUIDE, version=2)
    assert plain.at("hover", 0, 0)["contents"]["kind"] == "plaintext"
    assert "location" in plain.of("documentSymbol")[0]
    assert verdict_of(plain.diagnostics(2, verdict=True)).count("\n") >= 1
    step = fixes(plain, 0)[0]
    assert edits_of(step)


def test_a_closed_deck_has_no_problems(client: Client) -> None:
    client.open("TRUS 1 1 2\n")
    assert client.diagnostics(1)
    client.tell("textDocument/didClose", {"textDocument": {"uri": URI}})
    sent = client.wait(lambda one: one.get("method") == "textDocument/publishDiagnostics")
    assert sent["params"]["diagnostics"] == []


def test_a_stale_verdict_is_dropped(client: Client) -> None:
    """Ten changes at once: the verdict is that of the last, and no other comes behind it."""
    client.open(GUIDE)
    for version in range(2, 12):
        text = GUIDE if version % 2 else GUIDE.replace("RLSE 2  2 5 6", "RLSE 2  2 3 5 6")
        client.change(version, {"text": text})
    assert verdict_of(client.diagnostics(11, verdict=True)).startswith("over-constrained by 1")
    client.of("foldingRange")
    versions = [
        one["params"]["version"]
        for one in client.kept
        if one.get("method") == "textDocument/publishDiagnostics"
    ]
    assert versions == sorted(versions)


def test_a_long_deck_stays_at_hand(start: Callable[..., Client]) -> None:
    """Of 100,000 lines: questions are answered while it is read, and while it is analysed."""
    client = start()
    bars = "".join(
        f"TRUSS {k} {k} {k + 1}\nX {k + 1} {k} {k % 7} {k % 5}\n" for k in range(1, 50_001)
    )
    client.open(f"{bars}FIX 1\n")
    for version in range(2, 12):
        client.change(version, replaced(version, 0, 0, "% " if version < 11 else "Q"))
        assert client.at("hover", 60_000, 1)["contents"]
    found = client.diagnostics(11)
    assert [one["code"] for one in found if one["severity"] == 1] == ["unknown-keyword"]
    (where,) = client.at("definition", 80_001, 3)
    assert where["range"]["start"]["line"] in (79_999, 80_001)
    symbols = client.of("documentSymbol")
    assert sum(len(one.get("children", [])) for one in symbols) < 1000
    client.tell("exit", None)
    assert client.ended()[0] == ExitCode.OTHER


def test_whatever_is_typed_the_server_goes_on(start: Callable[..., Client]) -> None:
    client = start()
    texts = [text for text in map(text_of, NAMES) if len(text) < 3000]
    dice = random.Random("server")
    client.open("")
    for version in range(2, 60):
        text = mutated(dice.choice(texts), dice).encode("utf-8", "replace").decode()
        if version % 3:
            client.change(version, {"text": text})
        else:
            ends = sorted((dice.randrange(60), dice.randrange(30)) for _ in range(2))
            places = ({"line": line, "character": at} for line, at in ends)
            where = dict(zip(("start", "end"), places, strict=True))
            client.change(version, {"range": where, "text": text[:40]})
        line, character = dice.randrange(70), dice.randrange(40)
        for method in ("hover", "definition", "completion"):
            client.at(method, line, character)
        client.of("documentSymbol")
        client.of("foldingRange")
    client.diagnostics(59)
    assert client.end() == (0, "")


@pytest.mark.posix
@pytest.mark.parametrize("how", ["end of file", "interrupt"])
def test_an_editor_may_leave_without_a_word(start: Callable[..., Client], how: str) -> None:
    """Nothing is left running, and nothing is complained about."""
    client = start()
    client.open(GUIDE)
    client.diagnostics(1)
    assert client.process.stdin is not None
    if how == "end of file":
        client.process.stdin.close()
    else:
        client.process.send_signal(signal.SIGINT)
    code, said = client.ended()
    assert said == "" and code in (ExitCode.OTHER, -signal.SIGINT)


def test_without_pygls_it_says_what_is_missing(tmp_path: Any) -> None:
    (tmp_path / "pygls.py").write_text("raise ImportError('no pygls', name='pygls')\n")
    command = (
        "import sys; sys.path.insert(0, sys.argv.pop(1)); from flexact.apps.cli.main import main"
    )
    ended = subprocess.run(
        [sys.executable, "-c", f"{command}; sys.exit(main())", str(tmp_path), "lsp"],
        capture_output=True,
        text=True,
        stdin=subprocess.DEVNULL,
        check=False,
    )
    assert ended.returncode == ExitCode.OTHER and ended.stdout == ""
    assert "pip install 'pygls>=2'" in ended.stderr and "Traceback" not in ended.stderr


WRONG = (
    {"textDocument": {"uri": URI}, "position": "x"},
    {"textDocument": {"uri": URI}, "position": {"line": "x", "character": []}},
    {"textDocument": 7},
    {"textDocument": {"uri": URI}, "position": {"line": 0, "character": 0}, "context": {}},
    {},
    [],
    "x",
    None,
)


@pytest.mark.parametrize(
    "method",
    ["hover", "completion", "definition", "codeAction", "documentSymbol", "rename", "formatting"],
)
def test_a_request_of_a_wrong_form_is_answered(client: Client, method: str) -> None:
    """With an error or with nothing; an editor may wait for it for ever."""
    client.open("TRUSS 1 1 2\nX 2 1 0 0\n")
    for params in WRONG:
        answer = client.answer(f"textDocument/{method}", params)
        assert "result" in answer or answer["error"]["message"]
    assert client.at("hover", 0, 1) is not None
