# SPDX-License-Identifier: BSD-3-Clause
"""`flexact watch` as a process: every way to save, scripts, what it refuses, how it ends."""

import json
import os
import re
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from watched import Events, Watched, ask, is_running, until, watching

import flexact
from flexact.apps.watch.scene import Shown, Stage, summary_of

pytestmark = pytest.mark.dear(9)

#: Two sheets that guide a stage; the README says that it is over-constrained by 1.
GUIDE = """\
BEAM 1  1 2 3 4  0 1 0     % sheet 1
BEAM 2  5 6 7 8  0 1 0     % sheet 2
BEAM 3  3 4 7 8            % stage
X 3  0.1 0.00 0
X 5  0.0 0.05 0
X 7  0.1 0.05 0
FIX 1
FIX 2
FIX 5
FIX 6
RLSE 1  2 5 6
RLSE 2  2 5 6
DYNX 3  2
"""
#: With one of the releases that the README names.
EXACT = GUIDE.replace("RLSE 2  2 5 6", "RLSE 2  2 3 5 6")
WRONG = GUIDE.replace("BEAM 3  3 4 7 8 ", "BEAN 3  3 4 7 8 ")
SCRIPT = """\
import flexact
print("at work")
guide = flexact.read_text({deck!r}, "guide")
"""


@pytest.fixture
def deck(tmp_path: Path) -> Path:
    made = tmp_path / "guide.dat"
    made.write_text(GUIDE)
    return made


@pytest.fixture
def state(tmp_path: Path) -> Path:
    return tmp_path / "state"


@pytest.fixture(scope="module")
def served(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Path, Watched]]:
    """A deck that is watched by one process for several tests."""
    folder = tmp_path_factory.mktemp("served")
    deck = folder / "guide.dat"
    deck.write_text(GUIDE)
    with watching(deck, folder / "state") as watched:
        until(lambda: len(watched.out) > 1)
        yield deck, watched


def rename_over(file: Path, text: str) -> None:
    other = file.with_suffix(".new")
    other.write_text(text)
    other.replace(file)


def truncate(file: Path, text: str) -> None:
    with file.open("w") as stream:
        stream.flush()
        time.sleep(0.2)
        stream.write(text)


def delete(file: Path, text: str) -> None:
    file.unlink()
    time.sleep(0.2)
    file.write_text(text)


def by_halves(file: Path, text: str) -> None:
    """What is there in between ends amid a word, and would be a deck with an error."""
    place = text.index("EAM 3")
    with file.open("w") as stream:
        stream.write(text[:place])
        stream.flush()
        time.sleep(0.2)
        stream.write(text[place:])


def keep_times(file: Path, text: str) -> None:
    """The file is as old as it was, as with a copy that keeps times."""
    was = file.stat()
    file.write_text(text)
    os.utime(file, ns=(was.st_atime_ns, was.st_mtime_ns))


@pytest.mark.parametrize("save", [Path.write_text, rename_over, truncate, delete, by_halves])
def test_each_way_to_save_gives_one_new_verdict(
    served: tuple[Path, Watched], save: Callable[[Path, str], object]
) -> None:
    deck, watched = served
    is_exact = deck.read_text() == EXACT
    events = Events(watched.address)
    first = events.next()
    save(deck, GUIDE if is_exact else EXACT)
    event = events.next()
    events.close()
    arrow = ("over-constrained by 1", "exactly constrained")
    assert event["changed_words"].startswith(" → ".join(arrow[::-1] if is_exact else arrow))
    assert not event["broken"]
    # Nothing half-written was shown in between, where the motions of the first may have come.
    assert event["revision"] <= first["revision"] + 2


def without_shapes(body: str) -> str:
    """What a page shows but for the shapes of motions, which may come later."""
    return re.sub("<script.*?</script>", "", body, flags=re.DOTALL)


def test_a_scene_is_completed_by_that_of_the_same_result_alone() -> None:
    result = flexact.read_text(GUIDE), flexact.read_text(EXACT)
    summaries = [summary_of(flexact.analyse(model)) for model in result]

    def shown(k: int, *, is_whole: bool) -> Shown:
        kept = bytes([k + 1])
        return Shown("", "", summaries[k], "", "", (), result=kept, is_whole=is_whole)

    stage = Stage("guide.dat")
    for k, is_whole, completes in (
        (0, False, False),
        (0, True, True),
        (0, True, False),
        (1, False, False),
        (0, False, False),
        (1, True, False),
        (1, False, False),
        (1, True, True),
    ):
        before = stage.scene
        stage.put(shown(k, is_whole=is_whole))
        assert stage.scene.completes == (before.revision if completes else 0)
        if completes:
            assert stage.scene.changed_words == before.changed_words


def test_a_file_that_keeps_its_times_is_seen_by_its_size(served: tuple[Path, Watched]) -> None:
    deck, watched = served
    events = Events(watched.address)
    events.next()
    text = deck.read_text()
    keep_times(deck, EXACT if text == GUIDE else GUIDE)
    assert "→" in events.next()["changed_words"]
    events.close()


def test_a_file_that_is_touched_is_analysed_again(served: tuple[Path, Watched]) -> None:
    deck, watched = served
    events = Events(watched.address)
    events.next()
    deck.touch()
    assert "nothing has changed" in events.next()["changed_words"]
    events.close()


def test_a_broken_deck_keeps_the_last_scene_and_all_windows_hear_of_it(
    served: tuple[Path, Watched],
) -> None:
    deck, watched = served
    text = deck.read_text()
    windows = [Events(watched.address) for _ in range(3)]
    bodies = [each.next()["body"] for each in windows]
    deck.write_text(WRONG)
    broken = [each.next() for each in windows]
    assert all(each == broken[0] for each in broken)
    assert [without_shapes(each) for each in bodies] == [without_shapes(broken[0]["body"])] * 3
    assert "BEAN" in broken[0]["broken"] and "^^^^" in broken[0]["broken"]
    assert "guide.dat:3:1" in broken[0]["broken"]
    # A page that is loaded now has both.
    page = ask(watched.address)[1]
    assert "^^^^" in page and 'class="verdict' in page
    deck.unlink()
    assert "there is no such file" in windows[0].next()["broken"]
    deck.write_text(text)
    mended = windows[0].next()
    assert not mended["broken"]
    assert mended["changed_words"].startswith("still ")
    for each in windows:
        each.close()
    assert "BEAN" in "".join(watched.err)


def test_who_is_not_meant_is_refused(served: tuple[Path, Watched]) -> None:
    _, watched = served
    address, port = watched.address, watched.port
    own = f"127.0.0.1:{port}"
    assert ask(address)[0] == 200
    assert ask(address, Host=f"localhost:{port}")[0] == 200
    assert ask(address, Host=f"evil.example:{port}")[0] == 403
    assert ask(address, Host="127.0.0.1")[0] == 403
    assert ask(address, Host=own, Origin="http://evil.example")[0] == 403
    assert ask(address, Host=own, Sec_Fetch_Site="cross-site")[0] == 403
    # From the file that leads here, or from any page that knows the address, one may go to it.
    visit = {"Sec_Fetch_Mode": "navigate", "Sec_Fetch_Dest": "document"}
    assert ask(address, Host=own, Sec_Fetch_Site="cross-site", **visit)[0] == 200
    frame = {**visit, "Sec_Fetch_Dest": "iframe"}
    assert ask(address, Host=own, Sec_Fetch_Site="cross-site", **frame)[0] == 403
    for path in (
        "/",
        "/events",
        "/events?start=0&number=0&proof=0",
        "/" + "0" * 32 + "/",
        address.rstrip("/")[-32:],
    ):
        assert ask(address, path)[0] in (400, 403)
    token = "/" + address.rstrip("/")[-32:]
    for path in ("/guide.dat", "/../guide.dat", "/%2e%2e/guide.dat", "//etc/passwd"):
        status, text, _ = ask(address, token + path)
        assert status == 404 and "BEAM" not in text
    assert ask(address, token + "/edit", "POST")[0] == 403
    assert ask(address, token + "/edit", "POST", Origin="null")[0] == 403
    status, _, headers = ask(address, token + "/nothing", "POST", Origin=f"http://{own}")
    assert status == 404
    assert headers["X-Frame-Options"] == "DENY"
    assert "Access-Control-Allow-Origin" not in headers
    assert "connect-src &#x27;self&#x27;" in ask(address)[1]


@pytest.mark.posix("linux")
def test_it_is_reached_from_this_machine_only(served: tuple[Path, Watched]) -> None:
    _, watched = served
    rows = Path("/proc/net/tcp").read_text().splitlines()[1:]
    mine = [row.split()[1] for row in rows if row.split()[1].endswith(f":{watched.port:04X}")]
    assert "0100007F" in {each.split(":")[0] for each in mine}
    assert "00000000" not in {each.split(":")[0] for each in mine}


@pytest.mark.posix
@pytest.mark.parametrize("name", ["SIGINT", "SIGHUP"])
def test_a_signal_ends_it_quietly_with_its_processes(deck: Path, state: Path, name: str) -> None:
    number = getattr(signal, name)
    with watching(deck, state) as watched:
        events = Events(watched.address)
        until(lambda: len(watched.out) > 1)
        children = watched.children()
        assert children
        assert watched.end(number) == -number
        assert not any(map(is_running, children))
        assert not watched.err or "no browser" in "".join(watched.err)
        events.close()


@pytest.mark.posix
def test_no_process_outlives_one_that_is_killed(deck: Path, state: Path) -> None:
    with watching(deck, state) as watched:
        until(lambda: len(watched.out) > 1)
        children = watched.children()
        watched.end(signal.SIGKILL)
        until(lambda: not any(map(is_running, children)))


def command(*words: object) -> subprocess.CompletedProcess[str]:
    env = {**os.environ, "BROWSER": "", "DISPLAY": "", "WAYLAND_DISPLAY": ""}
    return subprocess.run(
        [sys.executable, "-m", "flexact", *map(str, words)],
        *(),
        env=env,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )


def test_what_cannot_be_watched_is_said_in_words(tmp_path: Path, deck: Path) -> None:
    from flexact.apps.cli.terminal import ExitCode

    gone = command("watch", tmp_path / "gone.dat")
    assert gone.returncode == ExitCode.DECK_ERROR
    assert "there is no such file" in gone.stderr
    assert command("watch", tmp_path / "gone.py").returncode == ExitCode.DECK_ERROR
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        busy = command("watch", deck, "--port", port)
    assert busy.returncode == ExitCode.OTHER
    assert f"port {port} is taken" in busy.stderr
    for done in (gone, busy, command("watch", deck, "--port", "0")):
        assert "Traceback" not in done.stderr
        assert done.returncode != 0


def test_a_script_shows_its_last_model_and_prints_to_the_terminal(
    tmp_path: Path, state: Path
) -> None:
    script = tmp_path / "design.py"
    script.write_text(SCRIPT.format(deck=GUIDE))
    with watching(script, state) as watched:
        events = Events(watched.address)
        event = events.next()
        assert "over-constrained" in event["title"]
        assert event["which"] == "guide, the last model or analysis of design.py"
        until(lambda: "at work\n" in watched.out)
        script.write_text(SCRIPT.format(deck=EXACT) + "other = guide\nguide.show()\nx = 1\n")
        event = events.next()
        assert event["changed_words"].startswith("over-constrained by 1 → exactly constrained")
        assert event["which"] == "shown in line 5 of design.py"
        script.write_text("import flexact\nx = 1\n")
        assert "shows nothing" in events.next()["broken"]
        events.close()


def test_modules_and_decks_of_the_script_are_watched_too(tmp_path: Path, state: Path) -> None:
    (tmp_path / "helper.py").write_text("NAME = 'guide.dat'\n")
    (tmp_path / "guide.dat").write_text(GUIDE)
    (tmp_path / "better.dat").write_text(EXACT)
    script = tmp_path / "design.py"
    script.write_text("import flexact, helper\nflexact.read(helper.NAME).show()\n")
    with watching(script, state) as watched:
        events = Events(watched.address)
        assert "over-constrained" in events.next()["title"]
        (tmp_path / "guide.dat").write_text(EXACT)
        assert "→ exactly constrained" in events.next()["changed_words"]
        (tmp_path / "helper.py").write_text("NAME = 'gone.dat'\n")
        assert "there is no such file" in events.next()["broken"]
        (tmp_path / "gone.dat").write_text(GUIDE)
        assert "→ over-constrained by 1" in events.next()["changed_words"]
        (tmp_path / "helper.py").write_text("NAME = 'better.dat\n")
        broken = events.next()["broken"]
        assert "SyntaxError" in broken and "helper.py:1:" in broken
        (tmp_path / "helper.py").write_text("NAME = 'better.dat'\n")
        assert "→ exactly constrained" in events.next()["changed_words"]
        events.close()


#: Scripts with errors, and words that the page has about them.
WRONG_SCRIPTS = (
    (
        "import flexact\n\ndef make():\n    return nothing\n\nmake()\n",
        ("NameError", "design.py:4:12", "called from design.py:6", "    return nothing"),
    ),
    (
        "import flexact\nm = flexact.Model()\nm.sheet((0, 0, 0), (1, 0, 0))\n",
        ("design.py:3:1", "missing-vector", "help: give width"),
    ),
    ("import flexact\nm = flexact.Model()\nm.fix((0, 0, 0))\n", ("design.py:3:1", "no-such-point")),
    ("import flexact\nflexact.read_text('BEAN 1')\n", ("BEAN", "deck:1:1")),
    ("x = (\n", ("SyntaxError", "design.py:1:")),
    ("raise SystemExit(3)\n", ("ended itself with 3", "design.py:1:")),
    ("import os\nos._exit(4)\n", ("ended with code 4",)),
    ("import os\nos.kill(os.getpid(), 11)\n", ("segmentation fault",)),
    ("import flexact\nm = flexact.Model()\n", ("error[",)),
    ("input()\n", ("EOFError", "design.py:1:")),
)


def test_errors_of_a_script_stand_in_the_page(tmp_path: Path, state: Path) -> None:
    script = tmp_path / "design.py"
    script.write_text(SCRIPT.format(deck=GUIDE))
    with watching(script, state) as watched:
        events = Events(watched.address)
        body = events.next()["body"]
        for text, said in WRONG_SCRIPTS:
            script.write_text(text)
            event = events.next()
            assert without_shapes(event["body"]) == without_shapes(body)
            assert not [words for words in said if words not in event["broken"]], event["broken"]
            assert "Traceback" not in event["broken"]
        script.write_text(SCRIPT.format(deck=GUIDE))
        assert not events.next()["broken"]
        assert "Traceback" not in "".join(watched.err)
        events.close()


def test_a_script_without_end_is_stopped_when_it_is_saved(tmp_path: Path, state: Path) -> None:
    script = tmp_path / "design.py"
    script.write_text(
        "import subprocess\nchild = subprocess.Popen(['sleep', '600'])\n"
        "print(child.pid)\nwhile True: pass\n"
    )
    with watching(script, state) as watched:
        events = Events(watched.address)
        assert "design.py is running" in events.next("work")["work"]
        child = int(until(lambda: watched.out[1:])[0])
        script.write_text(SCRIPT.format(deck=GUIDE))
        assert "over-constrained" in events.next()["title"]
        until(lambda: not is_running(child))
        script.write_text("while True: pass\n")
        events.next("work")
        assert watched.end() == -signal.SIGINT
        events.close()


@pytest.mark.posix
def test_nothing_is_said_into_a_pipe_that_nobody_reads(deck: Path, state: Path) -> None:
    watch = f"{sys.executable} -m flexact watch {deck} --no-browser"
    done = subprocess.run(
        ["bash", "-c", f"set -o pipefail; {watch} | head -1"],
        *(),
        env={**os.environ, "XDG_STATE_HOME": str(state)},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.stdout.count("\n") == 1
    assert "Traceback" not in done.stderr


def test_events_are_json_in_one_line(served: tuple[Path, Watched]) -> None:
    _, watched = served
    events = Events(watched.address)
    event = events.next()
    events.close()
    assert {"title", "body", "changed_words", "revision", "broken"} <= set(event)
    assert json.dumps(event).count("\n") == 0
