# SPDX-License-Identifier: BSD-3-Clause
"""`flexact watch` against another user of the same machine, and against scripts that it runs."""

import contextlib
import errno
import http.client
import os
import shutil
import socket
import stat
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import pytest
from test_watch import EXACT, GUIDE
from watched import ADDRESS, Events, Page, RefusedError, Watched, ask, is_running, until, watching

from flexact.apps.watch import worker_pool as crew
from flexact.apps.watch import worker_pool as frames
from flexact.apps.watch.server import Secrets

pytestmark = [pytest.mark.posix, pytest.mark.dear(10)]

NOBODY = 65534
#: Reads what every user may read of the processes that there are.
LIST = "for f in /proc/[0-9]*/cmdline; do tr '\\0' ' ' < $f 2>/dev/null; echo; done"
#: Opens silent connections to a port, and says so; they stay until somebody kills it.
SILENT = """
import socket, sys, time
lines = []
for _ in range(int(sys.argv[2])):
    line = socket.socket()
    line.connect(("127.0.0.1", int(sys.argv[1])))
    lines.append(line)
print("there", flush=True)
time.sleep(600)
"""


def as_other(*words: str, user: int = NOBODY) -> list[str]:
    """A command as another user of this machine runs it; the test is skipped where none can be."""
    if os.geteuid() != 0 or shutil.which("setpriv") is None:
        pytest.skip("needs root and setpriv (Debian: util-linux), to be two users")
    return ["setpriv", f"--reuid={user}", f"--regid={user}", "--clear-groups", *words]


@pytest.fixture
def shared() -> Iterator[Path]:
    """A folder that others may look into, unlike those of pytest."""
    folder = Path(tempfile.mkdtemp(prefix="flexact-shared-"))
    folder.chmod(0o755)
    (folder / "guide.dat").write_text(GUIDE)
    yield folder
    shutil.rmtree(folder)


@pytest.fixture
def deck(shared: Path) -> Path:
    return shared / "guide.dat"


def token_of(address: str) -> str:
    return urlsplit(address).path.strip("/")


@contextlib.contextmanager
def browsing(shared: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[[], str]]:
    """A browser that stays and does nothing; what it is to show."""
    program = shared / "browser.sh"
    program.write_text(
        f'#!/bin/sh\nexec >/dev/null 2>&1\necho "$1" > {shared}/shown\n'
        f"sleep 600 & echo $! > {shared}/sleeps\nwait\n"
    )
    program.chmod(0o755)
    monkeypatch.setattr("watched.LEFT_OUT", ())
    monkeypatch.setenv("BROWSER", f"{program} %s")
    try:
        yield lambda: str(until(lambda: read(shared / "shown"))).strip()
    finally:
        with contextlib.suppress(OSError, ValueError):
            os.kill(int(read(shared / "sleeps")), 9)


def read(path: Path) -> str:
    try:
        return path.read_text()
    except OSError:
        return ""


def test_the_secret_stands_in_no_process_list(
    shared: Path, deck: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with browsing(shared, monkeypatch) as shown, watching(deck, shared / "state") as watched:
        door = Path(shown().removeprefix("file://"))
        token = token_of(watched.address)
        assert token not in shown()
        # It leads there whoever may read it, and that is its owner alone.
        assert f'url={watched.address}"' in door.read_text()
        assert stat.S_IMODE(door.stat().st_mode) == 0o600
        assert stat.S_IMODE(door.parent.stat().st_mode) == 0o700
        listed = subprocess.run(["sh", "-c", LIST], capture_output=True, text=True).stdout
        assert "watch" in listed and door.name in listed and token not in listed
        with contextlib.suppress(pytest.skip.Exception):
            other = as_other("sh", "-c", f"{LIST}; cat {door}; cat {door.parent}/watch.key")
            found = subprocess.run(other, capture_output=True, text=True)
            assert door.name in found.stdout and token not in found.stdout
            assert found.stderr.count("ermission denied") == 2
        watched.end()
        assert not door.exists()


def test_each_start_has_a_secret_and_the_port_stays(shared: Path, deck: Path) -> None:
    seen = []
    for _ in range(3):
        with watching(deck, shared / "state") as watched:
            seen.append((watched.port, token_of(watched.address), Page.of(watched.address)))
            watched.end()
    assert len({port for port, _, _ in seen}) == 1
    assert len({token for _, token, _ in seen}) == len({page.key for _, _, page in seen}) == 3


def test_the_port_tells_nothing_of_the_file(deck: Path, shared: Path, monkeypatch: Any) -> None:
    ports = set()
    for user in ("a", "b", "c"):
        monkeypatch.setenv("XDG_STATE_HOME", str(shared / user))
        ports.add(Secrets(str(deck)).port)
        assert Secrets(str(deck)).port in ports
    assert len(ports) == 3


def test_a_page_goes_on_with_the_next_start_and_no_stranger_does(shared: Path, deck: Path) -> None:
    with watching(deck, shared / "state") as watched:
        port, old = watched.port, watched.address
        page = Page.of(old)
        watched.end()
    with watching(deck, shared / "state") as watched:
        assert watched.port == port
        # The secret of before is worth nothing, and without the key nobody hears the new one.
        assert ask(old)[0] == 403
        assert ask(watched.address, f"/events?start={page.start}&number=0&proof=0")[0] == 403
        with pytest.raises((RefusedError, AssertionError)):
            Events(watched.address, Page(page.start, token_of(old)))
        events = Events(watched.address, page)
        secrets = events.next("secrets")
        assert token_of(watched.address) == secrets["token"]
        assert Page(secrets["start"], secrets["key"]) == Page.of(watched.address)
        events.close()


class Squatter(ThreadingHTTPServer):
    """Has a port that was another's, keeps what it hears, and passes it on or says anything."""

    daemon_threads = True

    def __init__(self, port: int, to: int = 0) -> None:
        self.to, self.heard = to, [""]
        super().__init__((ADDRESS, port), Handler)
        threading.Thread(target=self.serve_forever, args=(0.05,), daemon=True).start()

    def end(self) -> None:
        self.shutdown()
        self.server_close()


class Handler(BaseHTTPRequestHandler):
    server: Squatter

    def do_GET(self) -> None:
        self.server.heard.append(f"{self.path} {self.headers}")
        kind, text = "application/json", '{"start": "0", "proof": "0"}'
        if self.server.to:
            _, text, _ = ask(f"http://{ADDRESS}:{self.server.to}/", self.path)
        elif not self.path.startswith("/alive"):
            kind = "text/event-stream"
            text = 'event: scene\ndata: {"revision": 1, "title": "evil", "body": "evil"}\n\n'
        self.send_response(200)
        self.send_header("Content-Type", kind)
        self.end_headers()
        self.wfile.write(text.encode())

    def do_POST(self) -> None:
        self.do_GET()

    def log_message(self, *_: Any) -> None:
        pass


@pytest.fixture
def squat() -> Iterator[Callable[..., Squatter]]:
    taken: list[Squatter] = []

    def take(port: int, to: int = 0) -> Squatter:
        taken.append(Squatter(port, to))
        return taken[-1]

    yield take
    for each in taken:
        each.end()


@pytest.mark.parametrize("passes_on", [False, True])
def test_who_takes_the_port_hears_no_secret(
    shared: Path, deck: Path, squat: Callable[..., Squatter], passes_on: bool
) -> None:
    with watching(deck, shared / "state") as watched:
        old, page = watched.address, Page.of(watched.address)
        watched.end()
    squatter = squat(urlsplit(old).port)
    with watching(deck, shared / "state") as watched:
        assert watched.port != squatter.server_port
        squatter.to = watched.port if passes_on else 0
        with pytest.raises(RefusedError):
            Events(old, page)
        # Nor can it hear by itself what it was not told.
        with pytest.raises((RefusedError, AssertionError)):
            Events(watched.address, Page(page.start, "0" * 64))
        heard = "".join(squatter.heard)
        assert "/alive" in heard and "/events" not in heard
        secrets = (token_of(old), page.key, token_of(watched.address), Page.of(watched.address).key)
        assert not [each for each in secrets if each in heard]


def test_a_page_in_a_browser_is_not_taken_in(
    shared: Path, deck: Path, squat: Callable[..., Squatter], chromium: Any
) -> None:
    from test_watch_browser import words

    chromium.driver.switch_to.new_window("tab")
    with watching(deck, shared / "state") as watched:
        old = watched.address
        chromium.driver.get(old)
        until(lambda: chromium.run("return live.line && !live.isLost"))
        watched.end()
    until(lambda: "The server has ended" in words(chromium))
    squatter = squat(urlsplit(old).port)
    until(lambda: len(squatter.heard) > 3)
    # A click says so, and sends nothing either.
    told = chromium.later("switches.send({do: 'tell'}).then(arguments[0])")
    assert told["status"] == 0 and "does not answer" in told["error"]
    with watching(deck, shared / "state") as other:
        squatter.to = other.port
        count = len(squatter.heard)
        until(lambda: len(squatter.heard) > count + 2)
        assert "The server has ended" in words(chromium)
        assert chromium.run("return document.title") != "evil"
        heard = "".join(squatter.heard)
        assert "/events" not in heard and "/edit" not in heard
        assert token_of(old) not in heard and token_of(other.address) not in heard
        other.end()
    # It gives up, with a button, by which it looks again.
    chromium.run("live.attempts = 298")
    until(lambda: chromium.run("return Boolean(document.querySelector('.live-lost button'))"))
    count = len(squatter.heard)
    squatter.end()
    with watching(deck, shared / "state", "--port", str(urlsplit(old).port)) as again:
        until(lambda: len(again.out) > 1)
        assert chromium.run("return live.isLost")
        chromium.press(".live-lost button")
        until(lambda: not chromium.run("return live.isLost"))
        assert chromium.run("return location.pathname") == f"/{token_of(again.address)}/"
        assert "The server has ended" not in words(chromium)
    chromium.driver.close()
    chromium.driver.switch_to.window(chromium.driver.window_handles[0])


def test_a_file_leads_a_browser_to_the_page(shared: Path, deck: Path, chromium: Any) -> None:
    """Which such a browser asks for as for a page that another site links to."""
    secrets = None
    with watching(deck, shared / "state") as watched:
        secrets = Secrets(str(deck))
        chromium.driver.get(secrets.door(watched.address).as_uri())
        until(lambda: chromium.driver.current_url == watched.address)
        until(lambda: chromium.run("return Boolean(window.live && live.line && !live.isLost)"))
        secrets.close()


@pytest.mark.nightly
@pytest.mark.posix("linux")
@pytest.mark.parametrize("is_other", [False, True])
def test_silent_connections_stop_neither_the_page_nor_a_script(
    shared: Path, is_other: bool
) -> None:
    script = shared / "design.py"
    script.write_text(f"import flexact\nguide = flexact.read_text({GUIDE!r}, 'guide')\n")
    limit = ("bash", "-c", 'ulimit -n 256; exec "$@"', "bash")
    with watching(script, shared / "state", before=limit) as watched:
        until(lambda: len(watched.out) > 1)
        silent = [sys.executable, "-c", SILENT, str(watched.port), "300"]
        if is_other:
            # Our Python may lie where others cannot go.
            python = "/usr/bin/python3"
            if not os.path.exists(python):
                pytest.skip("needs a Python for all users")
            silent = as_other(python, *silent[1:])
        attacker = subprocess.Popen(silent, stdout=subprocess.PIPE, text=True)
        try:
            assert attacker.stdout is not None
            assert attacker.stdout.readline() == "there\n"
            descriptors = Path(f"/proc/{watched.process.pid}/fd")
            assert len(list(descriptors.iterdir())) < 120
            assert ask(watched.address)[0] == 200
            events = Events(watched.address)
            events.next()
            script.write_text(script.read_text().replace(GUIDE[:9], EXACT[:9]) + "x = 1\n")
            assert "still" in events.next()["changed_words"]
            events.close()
            assert watched.process.poll() is None
            # Whoever says nothing is let go after a few seconds.
            until(lambda: len(list(descriptors.iterdir())) < 40, 20)
        finally:
            attacker.kill()
            attacker.wait()
            assert attacker.stdout is not None
            attacker.stdout.close()


@pytest.mark.nightly
def test_a_page_is_not_closed_for_those_who_say_nothing(shared: Path, deck: Path) -> None:
    with watching(deck, shared / "state") as watched:
        events = Events(watched.address)
        events.next()
        lines = [socket.create_connection((ADDRESS, watched.port)) for _ in range(200)]
        deck.write_text(EXACT)
        assert "→ exactly constrained" in events.next()["changed_words"]
        for line in (*lines, events):
            line.close()


def lay(folder: Path, owner: int | None = None, mode: int = 0o600, key: bytes = b"k" * 32) -> Path:
    """A key that is there before."""
    file = folder / "flexact" / "watch.key"
    file.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    file.write_bytes(key)
    file.chmod(mode)
    if owner is not None:
        os.chown(file, owner, owner)
    return file


def is_known(deck: Path) -> bool:
    """Whether the secrets of a deck are those of the key that was laid."""
    made = [Secrets(str(deck)) for _ in range(2)]
    return made[0].page_key("x") == made[1].page_key("x")


@pytest.mark.parametrize("key", [b"", b"k" * 31, b"k" * 33])
def test_a_key_that_is_not_whole_is_made_anew(
    key: bytes, shared: Path, deck: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(shared / "state"))
    file = lay(shared / "state", key=key)
    assert is_known(deck)
    assert len(file.read_bytes()) == 32
    assert stat.S_IMODE(file.stat().st_mode) == 0o600


def test_a_key_that_others_can_read_is_made_anew(
    shared: Path, deck: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(shared / "state"))
    file = lay(shared / "state", mode=0o644)
    assert is_known(deck)
    assert file.read_bytes() != b"k" * 32


@pytest.mark.parametrize("what", ["key", "link", "folder", "pipe"])
def test_a_key_that_another_user_has_laid_is_not_taken(
    what: str, shared: Path, deck: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(shared / "state"))
    file = lay(shared / "state")
    known = Secrets(str(deck)).page_key("x")
    if what == "link":
        file.rename(shared / "laid")
        file.symlink_to(shared / "laid")
    elif what == "pipe":
        file.unlink()
        os.mkfifo(file)
    else:
        as_other()
        os.chown(file if what == "key" else file.parent, NOBODY, NOBODY)
    assert Secrets(str(deck)).page_key("x") != known
    if what == "folder":
        # Nor is anything written where another could change it.
        assert Secrets(str(deck)).door("http://x/").parent != file.parent
        assert file.read_bytes() == b"k" * 32


def test_links_that_are_laid_for_the_key_are_not_followed(
    shared: Path, deck: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(shared / "state"))
    (shared / "target").write_bytes(b"theirs")
    file = lay(shared / "state", key=b"")
    file.unlink()
    file.symlink_to(shared / "target")
    secrets = Secrets(str(deck))
    door = shared / "state" / "flexact" / secrets.door("http://x/").name
    door.unlink()
    door.symlink_to(shared / "target")
    secrets.door("http://y/")
    assert (shared / "target").read_bytes() == b"theirs"
    assert not door.is_symlink() and not file.is_symlink()


def test_without_a_home_a_watch_has_a_secret_for_this_time(shared: Path) -> None:
    shared.chmod(0o777)
    code = (
        "import sys; sys.path[:0] = sys.argv[1:]; from flexact.apps.watch.server import Secrets; "
        "made = [Secrets('guide.dat') for _ in range(2)]; door = made[0].door('http://x/'); "
        "print(made[0].token != made[1].token, oct(door.stat().st_mode)[-3:], "
        "oct(door.parent.stat().st_mode)[-3:]); made[0].close(); print(door.parent.exists())"
    )
    python = os.path.realpath(sys.executable)
    places = [place for place in sys.path if place]
    program = as_other(python, "-c", code, *places, user=54321)
    env = {name: os.environ[name] for name in ("PATH",)}
    for place in (python, *places):
        if subprocess.run(as_other("test", "-r", place, user=54321)).returncode and os.path.exists(
            place
        ):
            pytest.skip("Python lies where others cannot go")
    done = subprocess.run(program, env=env, cwd=shared, capture_output=True, text=True)
    assert done.stdout.split() == ["True", "600", "700", "False"], done.stderr


def test_a_home_that_cannot_be_told_is_no_error(
    deck: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def home() -> Path:
        raise RuntimeError("Could not determine home directory.")

    monkeypatch.delenv("XDG_STATE_HOME", raising=False)
    monkeypatch.setattr(Path, "home", home)
    assert Secrets(str(deck)).token != Secrets(str(deck)).token


#: A model of which every name is known to the script alone, and one that keeps an object of it.
ENUMS = """\
import flexact
from enum import Enum
class Names(str, Enum):
    MODEL, BAR, SHEET, POINT = "model", "bar", "sheet", "point"
m = flexact.Model(name=Names.MODEL)
m.node(0, 0, 0, name=Names.POINT)
m.truss((0, 0, 0), (0.1, 0, 0), name=Names.BAR)
m.sheet((0, 0, 0), (0, 0.1, 0), width=(0, 0, 1), name=Names.SHEET)
m.fix((0, 0, 0))
{more}
"""
OBJECT = """
class Own(str):
    def __reduce__(self):
        {how}
m._draft.node_names[1] = Own("own")
m._data = None
"""


def click(watched: Watched, **request: Any) -> tuple[int, str]:
    import json

    where = urlsplit(watched.address)
    line = http.client.HTTPConnection(ADDRESS, where.port, timeout=60)
    own = {"Origin": f"http://{ADDRESS}:{where.port}"}
    line.request("POST", f"{where.path}edit", json.dumps(request).encode(), own)
    answer = line.getresponse()
    text = answer.read().decode()
    line.close()
    return answer.status, text


def test_names_that_the_script_alone_knows_are_names(shared: Path) -> None:
    script = shared / "design.py"
    script.write_text(ENUMS.format(more=""))
    with watching(script, shared / "state") as watched:
        until(lambda: len(watched.out) > 1)
        status, text = click(watched, do="look", element=1)
        assert status == 200 and "bar" in text, text


@pytest.mark.parametrize("how", ["return (Own, ('own',))", "raise OSError('never')"])
def test_a_model_that_cannot_be_switched_is_shown_and_said(shared: Path, how: str) -> None:
    script = shared / "design.py"
    script.write_text(ENUMS.format(more=""))
    with watching(script, shared / "state") as watched:
        until(lambda: len(watched.out) > 1)
        events = Events(watched.address)
        events.next()
        for count in range(2):
            script.write_text(ENUMS.format(more=OBJECT.format(how=how)) + f"x = {count}\n")
            assert not events.next()["broken"]
            status, text = click(watched, do="look", element=1)
            assert status == 422 and "this model cannot be switched" in text
        assert watched.process.poll() is None
        script.write_text(ENUMS.format(more=""))
        events.next()
        assert click(watched, do="look", element=1)[0] == 200
        assert "Traceback" not in "".join(watched.err)
        events.close()


#: Writes to whatever is open in its process.
WRITES = """\
import os, time
for k in range(3, 60):
    try:
        os.write(k, {what} + 99 * b"x")
    except OSError:
        pass
time.sleep(600)
"""
ODD = """\
class A:
    def {method}(self, *_): raise ValueError
raise SystemExit(A())
"""
#: What a script does, and words of what comes of it.
ODD_SCRIPTS = (
    (WRITES.format(what="bytes([16])"), "no answer"),
    (WRITES.format(what="bytes([0] * 7 + [5])"), "no answer"),
    ("import os, time\nos.closerange(3, 60)\ntime.sleep(600)\n", "says nothing any more"),
    ("import sys\nsys.stdout.close()\nx = 1\n", "shows nothing"),
    ("import sys\nsys.stdout = None\nx = 1\n", "shows nothing"),
    (ODD.format(method="__repr__"), "ended itself with"),
    (ODD.format(method="__eq__"), "ended itself with"),
    ("class E(Exception):\n  def __str__(self): raise ValueError\nraise E\n", "stopped with E"),
)


def test_a_watch_outlives_whatever_a_script_does(shared: Path) -> None:
    script = shared / "design.py"
    script.write_text("import flexact\nguide = flexact.read_text('TRUSS 1 1 2\\nX 2 1 0 0\\n')\n")
    with watching(script, shared / "state") as watched:
        events = Events(watched.address)
        events.next()
        for text, words in ODD_SCRIPTS:
            script.write_text(text)
            assert words in events.next()["broken"]
            assert watched.process.poll() is None
        assert "Traceback" not in "".join(watched.err)
        events.close()


def test_a_frame_of_absurd_length_is_refused() -> None:
    from io import BytesIO

    with pytest.raises(ValueError, match="longer"):
        frames.receive(BytesIO((2**60).to_bytes(8, "big") + b"x"))


def test_where_no_process_can_be_started_the_next_save_tries_again(
    deck: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def failing(*_: object, **__: object) -> None:
        raise OSError(errno.EMFILE, "Too many open files")

    with monkeypatch.context() as patch:
        patch.setattr(subprocess, "Popen", failing)
        made = crew.Crew(fresh=True)
        for _ in range(2):
            with pytest.raises(crew.WorkerError, match="too many open files"):
                made.take()
            made.prepare()
    worker = made.take()
    assert worker.is_alive
    made.close()
    assert not is_running(worker._process.pid)


def test_a_pipe_in_place_of_the_deck_is_waited_out(shared: Path, deck: Path) -> None:
    with watching(deck, shared / "state") as watched:
        events = Events(watched.address)
        events.next()
        deck.unlink()
        os.mkfifo(deck)
        assert "not a regular file" in events.next()["broken"]
        deck.unlink()
        deck.write_text(EXACT)
        assert "→ exactly constrained" in events.next()["changed_words"]
        events.close()
