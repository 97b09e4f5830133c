"""A function applied to many items: every item has its result, whatever happens to workers."""

import math
import multiprocessing
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from typing import Any

import pytest
from dask_cluster import is_alive

import flexact
from flexact.sweeps import pool as local_pool
from flexact.sweeps.chunks import MOST_ITEMS, EngineError, Source
from flexact.sweeps.running import Done, results_of

MANY = 2000
FORKS = pytest.mark.skipif(not local_pool.FORKS, reason="processes are not forked here")


def square(number: int) -> int:
    return number * number


def in_order(found: Iterator[Done]) -> list[Done]:
    return sorted(found, key=lambda done: done[0])


def squares(count: int) -> list[Done]:
    return [Done(k, k * k, "") for k in range(count)]


def children() -> int:
    return len(multiprocessing.active_children())


@FORKS
def test_every_item_has_its_result_once() -> None:
    """And a function may be one that only this process knows."""
    power = 2
    assert in_order(results_of(lambda k: k**power, range(MANY), workers=3)) == squares(MANY)


def test_one_worker_is_this_process() -> None:
    pids = {done.result for done in results_of(lambda _: os.getpid(), range(5), workers=1)}
    assert pids == {os.getpid()}


def test_no_items_need_no_worker() -> None:
    assert list(results_of(square, (), workers=2)) == []


@FORKS
def test_as_many_processes_as_there_is_work_for() -> None:
    def pid(_: int) -> int:
        time.sleep(0.05)
        return os.getpid()

    for count in (1, 2):
        pids = {done.result for done in results_of(pid, range(count), workers=8)}
        assert len(pids) == count and os.getpid() not in pids
    assert children() == 0


@FORKS
def test_items_are_taken_as_they_are_needed() -> None:
    """Two chunks a worker wait at most, and one of each was just answered."""
    taken = 0

    def numbers() -> Iterator[int]:
        nonlocal taken
        for number in range(10**9):
            taken += 1
            yield number

    found = results_of(square, numbers(), workers=2)
    for given in range(20 * MOST_ITEMS):
        assert next(found).result is not None
        assert taken - given <= 6 * MOST_ITEMS
    found.close()
    assert children() == 0


def test_chunks_take_about_as_long_as_they_should() -> None:
    source = Source(range(10**6), chunk_seconds=0.04)
    for _ in range(20):
        chunk = source.next()
        assert chunk is not None
        source.learn(len(chunk.items), 0.001 * len(chunk.items))
    assert len(chunk.items) == 40 and source.are_short
    for _ in range(20):
        source.learn(1, 1.0)
    chunk = source.next()
    assert chunk is not None and len(chunk.items) == 1 and not source.are_short


@pytest.mark.posix
@FORKS
def test_over_a_dead_worker_no_item_is_lost() -> None:
    """What kills its worker twice is a failure; what was beside it, or kills once, is done."""
    first = multiprocessing.get_context("fork").Value("i", 0)

    def deadly(k: int) -> int:
        if k == 300:
            os.kill(os.getpid(), signal.SIGKILL)
        if k == 301:
            os._exit(7)
        if k == 302 and not first.value:
            first.value = 1
            os.kill(os.getpid(), signal.SIGTERM)
        return k * k

    found = in_order(results_of(deadly, range(600), workers=2))
    assert [done[0] for done in found] == list(range(600))
    failures = {done[0]: done.failure for done in found if done.failure}
    assert list(failures) == [300, 301]
    assert "signal 9" in failures[300] and "exit code 7" in failures[301]
    assert all(done.result == k * k for k, done in enumerate(found) if not done.failure)


@FORKS
def test_a_worker_that_is_killed_from_outside_costs_nothing() -> None:
    found = []
    for done in results_of(lambda k: time.sleep(0.001) or k * k, range(500), workers=2):
        found.append(done)
        if len(found) in (100, 200):
            for worker in multiprocessing.active_children()[:1]:
                worker.kill()
    assert sorted(found) == squares(500)


class LockedError(Exception):
    """What it holds cannot be sent."""

    def __init__(self, words: str) -> None:
        super().__init__(words)
        self.lock = threading.Lock()


@FORKS
@pytest.mark.parametrize("workers", [1, 2])
def test_what_a_function_raises_is_raised(workers: int) -> None:
    def fails(k: int) -> float:
        return 1 / (k - 5)

    with pytest.raises(ZeroDivisionError):
        list(results_of(fails, range(10), workers=workers))
    assert children() == 0


@FORKS
def test_what_cannot_be_sent_is_said_in_words() -> None:
    def raises(_: int) -> None:
        raise LockedError("no luck")

    with pytest.raises(EngineError, match="no luck"):
        list(results_of(raises, range(3), workers=2))
    with pytest.raises(EngineError, match="result cannot be sent"):
        list(results_of(lambda k: lambda: k, range(3), workers=2))
    with pytest.raises(EngineError, match="item cannot be sent"):
        list(results_of(square, [lambda: 0] * 3, workers=2))
    assert issubclass(EngineError, flexact.FlexactError)
    assert children() == 0


@FORKS
@pytest.mark.parametrize("workers", [1, 2])
def test_before_what_the_items_raise_all_is_done(workers: int) -> None:
    def numbers() -> Iterator[int]:
        yield from range(50)
        raise OSError("no more")

    found = []
    with pytest.raises(OSError, match="no more"):
        found.extend(results_of(square, numbers(), workers=workers))
    found = []
    with pytest.raises(OSError, match="no more"):
        for done in results_of(square, numbers(), workers=workers):
            found.append(done)
    assert sorted(found) == squares(50)


@FORKS
def test_a_worker_uses_no_further_processes_and_one_thread() -> None:
    def inner(k: int) -> tuple[int, int]:
        from threadpoolctl import threadpool_info

        total = sum(done.result for done in results_of(square, range(k)))
        return total, max((pool["num_threads"] for pool in threadpool_info()), default=1)

    found = in_order(results_of(inner, range(4), workers=2))
    assert [done.result for done in found] == [(0, 1), (0, 1), (1, 1), (5, 1)]


def test_where_nothing_is_forked_functions_of_modules_work(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(local_pool, "FORKS", False)
    found = in_order(results_of(math.factorial, range(20), workers=2))
    assert [done.result for done in found] == [math.factorial(k) for k in range(20)]
    with pytest.raises(EngineError, match="module"):
        list(results_of(lambda k: k, range(3), workers=2))
    assert children() == 0


@pytest.mark.parametrize(
    ("wrong", "kind"),
    [
        ({"workers": 0}, ValueError),
        ({"workers": 2.0}, TypeError),
        ({"workers": True}, TypeError),
        ({"executor": "duck"}, ValueError),
        ({"executor": 3}, TypeError),
    ],
)
def test_wrong_arguments_are_refused(wrong: dict[str, Any], kind: type[Exception]) -> None:
    with pytest.raises(kind):
        results_of(square, range(3), **wrong)


# Executors


@pytest.mark.parametrize("kind", [ThreadPoolExecutor, ProcessPoolExecutor])
def test_any_executor_will_do(kind: Any) -> None:
    with kind(2) as executor:
        assert in_order(results_of(math.factorial, range(50), executor=executor)) == [
            Done(k, math.factorial(k), "") for k in range(50)
        ]
        with pytest.raises(ValueError, match="factorial"):
            list(results_of(math.factorial, [1, 2, -1], executor=executor))
    with pytest.raises(EngineError, match="shutdown"):
        list(results_of(math.factorial, range(3), executor=executor))


def test_a_broken_executor_is_said_to_be_so() -> None:
    with ProcessPoolExecutor(1) as executor, pytest.raises(EngineError, match="broken"):
        list(results_of(os._exit, [3], executor=executor))
    with ProcessPoolExecutor(1) as executor, pytest.raises(EngineError, match="module"):
        list(results_of(lambda k: k, [3], executor=executor))


def test_what_an_executor_has_not_begun_is_taken_back() -> None:
    with ThreadPoolExecutor(1) as executor:
        found = results_of(lambda k: time.sleep(0.001) or k, range(10**9), executor=executor)
        next(found)
        found.close()


# Processes that end

SCRIPT = """
import os, sys, time
from flexact.sweeps.running import results_of

def work(k):
    time.sleep(0.01 if k < 4 else 60)
    return os.getpid()

pids = set()
for done in results_of(work, range(100), workers=2):
    pids.add(done.result)
    if len(pids) == 2:
        print(*pids, flush=True)
"""


@pytest.mark.posix("linux")
@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGKILL"])
def test_no_worker_outlives_its_master(name: str) -> None:
    """Even one that is in the middle of something long."""
    master = subprocess.Popen(
        [sys.executable, "-c", SCRIPT], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert master.stdout is not None
    pids = [int(word) for word in master.stdout.readline().split()]
    assert len(pids) == 2 and all(map(is_alive, pids))
    master.send_signal(getattr(signal, name))
    assert master.wait(10) != 0
    end = time.monotonic() + 10
    while any(map(is_alive, pids)) and time.monotonic() < end:
        time.sleep(0.01)
    assert not any(map(is_alive, pids))
