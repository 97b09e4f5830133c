"""Work by a Dask cluster: a scheduler and workers as processes of their own."""

import os
import sys
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType

import pytest
from dask_cluster import Cluster, is_alive, running_cluster

from flexact.sweeps import dask as dask_client
from flexact.sweeps.chunks import EngineError
from flexact.sweeps.running import Done, results_of

pytestmark = pytest.mark.dear(4)

distributed = pytest.importorskip("distributed")

MANY = 1000


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Cluster]:
    with running_cluster(tmp_path_factory.mktemp("dask"), workers=2) as made:
        yield made


@pytest.fixture(autouse=True)
def impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(dask_client, "LOOK", 0.2)


def slow_square(number: int) -> int:
    time.sleep(0.001)
    return number * number


def only_here() -> Callable[[int], int]:
    """A function of a module that workers have not."""
    module = ModuleType("unknown_to_workers")
    exec("def same(k): return k", module.__dict__)
    sys.modules[module.__name__] = module
    function: Callable[[int], int] = module.same
    return function


def test_a_worker_that_is_killed_midway_costs_nothing(cluster: Cluster) -> None:
    """The same results as by processes of this machine."""
    found = []
    for done in results_of(slow_square, range(MANY), executor=cluster.address):
        found.append(done)
        if len(found) == MANY // 4:
            cluster.kill_worker()
    assert sorted(found) == sorted(results_of(slow_square, range(MANY), workers=2))


def test_a_client_does_the_same_and_stays_open(cluster: Cluster) -> None:
    factor = 3
    with distributed.Client(cluster.address, set_as_default=True) as client:
        for executor in (client, "dask"):
            found = sorted(results_of(lambda k: factor * k, range(200), executor=executor))
            assert found == [Done(k, factor * k, "") for k in range(200)]
        with pytest.raises(ZeroDivisionError):
            list(results_of(lambda k: 1 / k, range(20), executor=client))
        endless = results_of(lambda k: k, range(10**9), executor=client)
        assert next(endless).failure == ""
        endless.close()
        assert client.status == "running" and client.submit(sum, [1, 2]).result() == 3


def test_a_cluster_of_this_machine_is_started_and_ended() -> None:
    with pytest.raises(ValueError, match="client"):
        distributed.default_client()
    found = results_of(lambda _: os.getpid(), range(20), executor="dask", workers=1)
    (worker,) = {done.result for done in found}
    assert worker != os.getpid() and not is_alive(worker)
    with pytest.raises(ValueError, match="client"):
        distributed.default_client()


def test_what_cannot_be_done_there_is_said_in_words(cluster: Cluster) -> None:
    lock = threading.Lock()
    with pytest.raises(EngineError, match="function cannot be sent"):
        list(results_of(lambda k: lock, range(3), executor=cluster.address))
    with pytest.raises(EngineError, match="item cannot be sent"):
        list(results_of(slow_square, [lock], executor=cluster.address))
    with pytest.raises(EngineError, match="result cannot be sent"):
        list(results_of(lambda k: threading.Lock(), range(3), executor=cluster.address))
    with pytest.raises(EngineError, match="unknown_to_workers"):
        list(results_of(only_here(), range(3), executor=cluster.address))


def test_what_kills_its_workers_is_a_failure_and_a_lost_scheduler_an_error(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES", "0")
    with running_cluster(tmp_path, workers=3) as cluster:
        found = sorted(results_of(lambda k: k or os._exit(1), range(100), executor=cluster.address))
        assert [done.result for done in found] == [None, *range(1, 100)]
        assert [done[0] for done in found if done.failure] == [0] and "died" in found[0].failure
        found = []
        with pytest.raises(EngineError, match="was lost"):
            for done in results_of(slow_square, range(10**6), executor=cluster.address):
                found.append(done)
                if len(found) == 100:
                    cluster.kill_scheduler()
        assert len(found) >= 100 and all(done.result == done[0] ** 2 for done in found)
    monkeypatch.setattr(dask_client, "_ANSWER", 1.0)
    with pytest.raises(EngineError, match="dask scheduler"):
        list(results_of(slow_square, range(3), executor=cluster.address))


def test_without_dask_it_is_said_how_to_install_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(EngineError, match="pip install"):
        results_of(slow_square, range(3), executor="dask")


def test_workers_are_not_waited_for_in_vain(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(dask_client, "_NO_WORKER", 0.5)
    with (
        running_cluster(tmp_path, workers=0) as cluster,
        pytest.raises(EngineError, match="dask worker"),
    ):
        list(results_of(slow_square, range(3), executor=cluster.address))
