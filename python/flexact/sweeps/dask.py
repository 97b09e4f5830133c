# SPDX-License-Identifier: BSD-3-Clause
"""The client of a Dask cluster: found or opened, watched, and closed if it was opened here."""

from __future__ import annotations

import logging
import time
from collections.abc import Iterable
from contextlib import suppress
from typing import Any

from ..util.loading import load
from ..util.processors import processors
from .errors import EngineError

#: How long a scheduler may take to answer, and how long there may be no worker [s].
_ANSWER, _NO_WORKER = 10.0, 60.0
#: How often workers are counted [s].
LOOK = 2.0


class DaskClient:
    """A client that works, or an EngineError that says in words why it does not.

    Attributes:
        client: The client of Dask.
        threads: Of all workers, when they were last counted.
    """

    def __init__(self, executor: Any, workers: int | None) -> None:
        """Find or open a client.

        Args:
            executor: A client, the address of a scheduler, or "dask".
            workers: Of a cluster that is to be started on this machine.

        Raises:
            EngineError: There is none.
        """
        self._dask = dask_or_error()
        self._name = executor if isinstance(executor, str) else "its address"
        self._own: list[Any] = []
        self._levels: dict[str, int] = {}
        self._is_lost = False
        self.threads = 0
        self._looked = self._had_workers = 0.0
        self.client = self._found(executor) or self._opened(executor, workers)

    def look(self) -> None:
        """Count the workers, now and then.

        Raises:
            EngineError: The scheduler is lost, or has had no worker for long.
        """
        now = time.monotonic()
        if self.client.status != "running":
            raise self.lost("the connection is broken")
        if self._looked and now - self._looked < LOOK:
            return
        try:
            self.threads = sum(self.client.nthreads().values())
        except Exception as error:
            raise self.lost(error) from error
        if self.threads or not self._looked:
            self._had_workers = now
        elif now - self._had_workers > _NO_WORKER:
            raise EngineError(
                f"the Dask scheduler has had no worker for {_NO_WORKER:.0f} s; start some, such as "
                f"`dask worker {self._address()}`, and try again"
            )
        self._looked = now

    def lost(self, reason: object) -> EngineError:
        """What is said where a scheduler is lost."""
        self._is_lost = True
        words = (str(reason) or type(reason).__name__).splitlines()[0]
        return EngineError(
            f"the Dask scheduler at {self._address()} was lost ({words}): start it again, then "
            "what was not done"
        )

    def close(self, pending: Iterable[Any]) -> None:
        """Take back futures that are not done, and close what was opened here."""
        with suppress(Exception):
            if self.client.status == "running":
                self.client.cancel(list(pending))
        for each in self._own:
            with suppress(Exception):
                each.close(timeout=_ANSWER)
        # It has words of its own about a connection that was lost, some of them late.
        if not self._is_lost:
            _set_levels(self._levels)

    def _address(self) -> str:
        scheduler = getattr(self.client, "scheduler", None)
        return str(getattr(scheduler, "address", None) or self._name)

    def _found(self, executor: Any) -> Any:
        if executor == "dask":
            with suppress(ValueError):
                return self._dask.default_client()
        if isinstance(executor, str):
            return None
        if executor.asynchronous:
            raise EngineError("an asynchronous Dask client cannot be used: give its address")
        return executor

    def _opened(self, address: str, workers: int | None) -> Any:
        self._levels = _levels()
        _set_levels(dict.fromkeys(self._levels, logging.CRITICAL + 1))
        where = address
        try:
            if address == "dask":
                cluster = self._dask.LocalCluster(
                    n_workers=workers or processors(),
                    threads_per_worker=1,
                    dashboard_address="127.0.0.1:0",
                    silence_logs=logging.CRITICAL,
                )
                self._own.append(cluster)
                where = cluster.scheduler_address
            wait = min(_ANSWER, _configured_wait())
            client = self._dask.Client(where, timeout=wait, set_as_default=False)
        except Exception as error:
            for each in self._own:
                each.close()
            raise EngineError(_not_there(address, error)) from error
        self._own.insert(0, client)
        return client


def dask_or_error() -> Any:
    """The package distributed.

    Raises:
        EngineError: It is missing.
    """
    try:
        import distributed
    except ImportError as error:
        raise EngineError(
            f"Dask needs the package distributed: pip install distributed ({error})"
        ) from error
    return distributed


def _not_there(address: str, error: Exception) -> str:
    if address == "dask":
        return f"no Dask cluster can be started on this machine: {error}"
    return (
        f"no Dask scheduler answers at {address}; start one (`dask scheduler`, then "
        f"`dask worker {address}`), or mend the address"
    )


def _configured_wait() -> float:
    configured = load("dask").config.get("distributed.comm.timeouts.connect")
    return float(load("dask.utils").parse_timedelta(configured))


def _levels() -> dict[str, int]:
    """The level of each of Dask's loggers."""
    names = [name for name in logging.root.manager.loggerDict if name.startswith("distributed")]
    return {name: logging.getLogger(name).level for name in names}


def _set_levels(levels: dict[str, int]) -> None:
    for name, level in levels.items():
        logging.getLogger(name).setLevel(level)
