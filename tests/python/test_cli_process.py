# SPDX-License-Identifier: BSD-3-Clause
"""The command in a process of its own: encodings, pipes, full disks, noise."""

import os
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest
from small_decks import json_lines, write

import flexact

pytestmark = pytest.mark.dear(14)

ROOT = Path(__file__).resolve().parents[2]


def command(
    *arguments: object, environment: Mapping[str, str] | None = None
) -> subprocess.CompletedProcess[bytes]:
    """Run the command in a process of its own."""
    return subprocess.run(
        [sys.executable, "-m", "flexact", *map(str, arguments)],
        capture_output=True,
        env=process_environment() | (environment or {}),
        check=False,
    )


def process_environment() -> dict[str, str]:
    """The environment in which this very package is found."""
    package = str(Path(flexact.__file__).parent.parent)
    path = os.pathsep.join(filter(None, (package, os.environ.get("PYTHONPATH", ""))))
    return {**os.environ, "PYTHONPATH": path}


def assert_one_line_of_the_command(reported: bytes) -> None:
    """No traceback, and the command says who speaks."""
    assert reported.startswith(b"flexact: ") and reported.count(b"\n") == 1


@pytest.mark.parametrize(
    "content", [b"", b"\x00\x01\x02" * 100, bytes(range(256)), b"\xff\xfe", None]
)
@pytest.mark.parametrize("verb", ["analyse", "check"])
def test_what_is_no_deck_exits_with_2(verb: str, content: bytes | None, tmp_path: Path) -> None:
    path = tmp_path / "noise.dat"
    if content is not None:
        path.write_bytes(content)
    done = command(verb, path)
    assert done.returncode == 1
    assert b"Traceback" not in done.stderr
    assert b"noise.dat" in done.stderr


def test_progress_is_for_terminals_only(decks: Path) -> None:
    assert command("analyse", decks, "--json").stderr.count(b"[1/4]") == 0


@pytest.mark.posix
def test_progress_counts_the_decks(decks: Path) -> None:
    try:
        reader, terminal = os.openpty()
    except OSError:
        pytest.skip("this system hands out no pseudo-terminals")
    names = [str(decks / f"{name}.dat") for name in ("exact", "under", "over")]
    try:
        subprocess.run(
            [sys.executable, "-m", "flexact", "analyse", "--json", *names],
            stdout=subprocess.DEVNULL,
            stderr=terminal,
            env=process_environment(),
            check=True,
        )
        seen = os.read(reader, 65536)
    finally:
        os.close(terminal)
        os.close(reader)
    assert [f"[{k}/3] {name}".encode() in seen for k, name in enumerate(names, 1)] == [True] * 3


@pytest.mark.parametrize("encoding", ["ascii", "latin-1", "utf-8"])
def test_any_encoding_of_stdout_will_do(encoding: str, tmp_path: Path) -> None:
    name = "m\u00e9canisme \u2192 1.dat"
    path = write(tmp_path / name, "PLTRUSS 1 1 2 % barre \u00e9l\u00e9gante\nX 2 1 0\nFIX 1\n")
    write(tmp_path / "broken.dat", "PLTRUS 1 1 2 % \u2192\n")
    surroundings = {"PYTHONIOENCODING": encoding, "PYTHONUTF8": "1"}
    for extra in ([], ["--json"]):
        done = command("analyse", tmp_path, *extra, environment=surroundings)
        assert done.returncode == 1
        assert b"Traceback" not in done.stderr
        done.stdout.decode(encoding)
    lines = json_lines(done.stdout.decode(encoding))
    assert str(path) in [line["deck"] for line in lines]


@pytest.mark.posix
@pytest.mark.parametrize("arguments", [("--help",), ("analyse", "{decks}", "--json")])
def test_a_broken_pipe_ends_quietly(arguments: tuple[str, ...], decks: Path) -> None:
    reader, writer = os.pipe()
    os.close(reader)
    try:
        done = subprocess.run(
            [sys.executable, "-m", "flexact", *(a.format(decks=decks) for a in arguments)],
            stdout=writer,
            stderr=subprocess.PIPE,
            env=process_environment(),
            check=False,
        )
    finally:
        os.close(writer)
    assert done.stderr == b""


@pytest.mark.posix("linux")
@pytest.mark.parametrize("unbuffered", ["", "1"])
@pytest.mark.parametrize("arguments", [("analyse", "{decks}"), ("analyse", "--help")])
def test_a_full_disk_behind_stdout_is_reported(
    arguments: tuple[str, ...], unbuffered: str, decks: Path
) -> None:
    with open("/dev/full", "wb") as full:
        done = subprocess.run(
            [sys.executable, "-m", "flexact", *(a.format(decks=decks) for a in arguments)],
            stdout=full,
            stderr=subprocess.PIPE,
            env=process_environment() | {"PYTHONUNBUFFERED": unbuffered},
            check=False,
        )
    assert done.returncode == 2
    assert_one_line_of_the_command(done.stderr)


@pytest.mark.posix("linux")
def test_a_full_disk_behind_stderr_does_not_cost_the_results(decks: Path) -> None:
    write(decks / "broken.dat", "PLTRUS 1 1 2\n")
    with open("/dev/full", "wb") as full:
        done = subprocess.run(
            [sys.executable, "-m", "flexact", "analyse", "--json", str(decks)],
            stdout=subprocess.PIPE,
            stderr=full,
            env=process_environment(),
            check=False,
        )
    assert done.returncode == 1
    assert len(json_lines(done.stdout.decode())) == 5


@pytest.mark.posix
@pytest.mark.parametrize("arguments", ["--version", "analyse {decks}", "check {decks}"])
def test_a_closed_stdout_is_reported(arguments: str, decks: Path) -> None:
    line = f"exec '{sys.executable}' -m flexact {arguments.format(decks=decks)} >&-"
    done = subprocess.run(
        ["sh", "-c", line], stderr=subprocess.PIPE, env=process_environment(), check=False
    )
    assert done.returncode == 2
    assert_one_line_of_the_command(done.stderr)


#: What a command that only says a verdict has no use for: pages, pictures, meshes, the builder,
#: steps that mend, and libraries that each take as long as the analysis of a deck, or longer.
UNUSED = (
    *("flexact.show.page", "flexact.show.picture", "flexact.show.mesh", "flexact.show.saving"),
    *("flexact.show.drawing", "flexact.show.notebook", "flexact.motion", "flexact.elasticity"),
    *("flexact.costs", "flexact.designs", "flexact.sweeps", "flexact.api", "flexact.model.model"),
    *("flexact.model.handles", "flexact.advice.advice", "flexact.advice.step"),
    *("numpy.ma", "numpy.polynomial", "email", "http", "urllib.request", "xml", "ssl", "json"),
    *("importlib.metadata", "importlib.resources", "logging", "tempfile", "webbrowser", "decimal"),
    *("difflib", "hashlib", "multiprocessing", "scipy", "matplotlib", "meshio", "tqdm"),
)


@pytest.mark.parametrize("verb", ["analyse", "check"])
def test_a_verdict_loads_nothing_that_it_does_not_need(verb: str) -> None:
    deck = ROOT / "input_decks" / "paper" / "five_folded_sheets.dat"
    code = (
        "import sys; from flexact.apps.cli.main import main; "
        f"code = main([{verb!r}, {str(deck)!r}]); print(*sys.modules); sys.exit(code)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, env=process_environment(), check=True
    )
    loaded = done.stdout.decode().split("\n")[-2].split()
    assert not [
        name
        for name in loaded
        if any(name == unused or name.startswith(f"{unused}.") for unused in UNUSED)
    ]
