"""A Dask scheduler and workers as processes of their own, on free ports of this machine."""

import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path

_PATIENCE = 30.0
#: Of worker processes, so that what tests define can be read there.
HERE = Path(__file__).parent


@dataclass
class Cluster:
    """A scheduler with its workers, one thread each.

    Attributes:
        address: Of the scheduler, "tcp://127.0.0.1:port".
        scheduler: Its process.
        workers: Theirs; the next of them is added by `add_worker`.
    """

    folder: Path
    address: str = ""
    scheduler: "subprocess.Popen[bytes] | None" = None
    workers: "list[subprocess.Popen[bytes]]" = field(default_factory=list)

    def start(self, workers: int) -> None:
        words = ("--host", "127.0.0.1", "--port", "0", "--no-dashboard")
        self.scheduler, log = self._run("scheduler", *words)
        self.address = _awaited(log, self.scheduler, r"Scheduler at:\s+(tcp://\S+)")
        logs = [self.add_worker() for _ in range(workers)]
        for process, log in zip(self.workers, logs, strict=True):
            _awaited(log, process, r"Registered to:\s+(tcp://\S+)")

    def add_worker(self) -> Path:
        """Start another worker; nobody waits for it."""
        words = ("--nthreads", "1", "--no-nanny", "--no-dashboard", "--host", "127.0.0.1")
        local = ("--local-directory", str(self.folder))
        process, log = self._run("worker", self.address, *words, *local)
        self.workers.append(process)
        return log

    def kill_worker(self) -> None:
        """Kill the worker that is the oldest."""
        process = self.workers.pop(0)
        process.kill()
        process.wait()

    def kill_scheduler(self) -> None:
        """And nobody can be asked any more."""
        assert self.scheduler is not None
        self.scheduler.kill()
        self.scheduler.wait()

    def stop(self) -> None:
        for process in (*self.workers, self.scheduler):
            if process is not None:
                with suppress(ProcessLookupError):
                    process.send_signal(signal.SIGKILL)
                process.wait()

    def _run(self, *words: str) -> "tuple[subprocess.Popen[bytes], Path]":
        count = len(list(self.folder.glob("*.log")))
        log = self.folder / f"{words[0]}{count}.log"
        path = os.pathsep.join((str(HERE), os.environ.get("PYTHONPATH", "")))
        with log.open("wb") as file:
            process = subprocess.Popen(
                [sys.executable, "-m", "dask", *words],
                stdout=file,
                stderr=file,
                env={**os.environ, "PYTHONPATH": path},
                cwd=self.folder,
            )
        return process, log


@contextmanager
def running_cluster(folder: Path, workers: int = 2) -> Iterator[Cluster]:
    """A cluster that is there until the end of the block; what it says goes to the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    cluster = Cluster(folder)
    try:
        cluster.start(workers)
        yield cluster
    finally:
        cluster.stop()


def _awaited(log: Path, process: "subprocess.Popen[bytes]", pattern: str) -> str:
    """What a process says of itself, within a while."""
    end = time.monotonic() + _PATIENCE
    while time.monotonic() < end and process.poll() is None:
        if found := re.search(pattern, log.read_text(encoding="utf-8", errors="replace")):
            return found[1]
        time.sleep(0.02)
    raise AssertionError(f"it has not started: {log.read_text(encoding='utf-8', errors='replace')}")


def is_alive(pid: int) -> bool:
    """Whether there is such a process, and it is not merely waited for."""
    try:
        status = Path(f"/proc/{pid}/stat").read_text(encoding="ascii").rpartition(")")[2]
    except OSError:
        return False
    return status.split()[0] != "Z"
