# SPDX-License-Identifier: BSD-3-Clause
"""Fixtures that several tests share."""

import os
import random
import signal
import sys
from collections import defaultdict
from pathlib import Path

import pytest
from browser import browser, chromium  # noqa: F401
from left_out import pytest_make_collect_report, pytest_runtest_makereport  # noqa: F401
from small_decks import DECKS, write
from wording import AsStored

from flexact.util.partial import STRICT

# Workers of xdist state a width that is no terminal's.
os.environ.pop("COLUMNS", None)

# Mistakes that an output would go on without are raised, also in processes that tests start.
os.environ[STRICT] = "1"

# Shells start what runs in the background deaf to Control-C, and its children with it.
signal.signal(signal.SIGINT, signal.default_int_handler)
if hasattr(signal, "SIGHUP"):
    signal.signal(signal.SIGHUP, signal.SIG_DFL)


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--renew-wording", action="store_true", help="write the texts that tests compare with"
    )
    parser.addoption(
        "--sample",
        action="store_true",
        help="of grids and of dear files always the same few cases, and nothing that is nightly",
    )


#: Of a grid `make test` takes so many cases.
FEW = 20


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """With --sample leave out what `make test-all` asks, which a nightly job runs."""
    if not config.getoption("--sample"):
        return
    groups: dict[tuple[str, int], list[pytest.Item]] = defaultdict(list)
    kept = set()
    for item in items:
        if item.get_closest_marker("nightly"):
            continue
        if (dear := item.get_closest_marker("dear")) is not None:
            groups[item.nodeid.partition("::")[0], dear.args[0]].append(item)
        elif item.get_closest_marker("grid"):
            groups[item.nodeid.partition("[")[0], FEW].append(item)
        else:
            kept.add(item)
    for (name, count), cases in groups.items():
        # The seed is the name, so that workers agree and a run is like the last.
        kept.update(random.Random(name).sample(cases, min(count, len(cases))))
    config.hook.pytest_deselected(items=[item for item in items if item not in kept])
    items[:] = [item for item in items if item in kept]


def pytest_runtest_setup(item: pytest.Item) -> None:
    """Skip what needs a POSIX system, or one of them, elsewhere."""
    for mark in item.iter_markers("posix"):
        if os.name != "posix" or sys.platform not in (mark.args or (sys.platform,)):
            pytest.skip(f"needs {' or '.join(mark.args) or 'a POSIX system'}")


@pytest.fixture
def as_stored(request: pytest.FixtureRequest) -> AsStored:
    """Compares a text with a file; see wording.py."""
    return AsStored(request.config.getoption("--renew-wording"))


@pytest.fixture
def decks(tmp_path: Path) -> Path:
    """A folder with one deck of each verdict."""
    for name, text in DECKS.items():
        write(tmp_path / "decks" / f"{name}.dat", text)
    return tmp_path / "decks"
