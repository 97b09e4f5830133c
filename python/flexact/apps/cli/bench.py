# SPDX-License-Identifier: BSD-3-Clause
"""``flexact bench``: how fast this machine is, in a table that can be put into a report."""

from __future__ import annotations

import argparse
import contextlib
import os

from ...util.loading import VERSION, load
from ...util.machine import processors
from .parser import Verb, argument
from .terminal import Bar, ExitCode, complain, give, say

#: Of the JSON; see `docs/command.md` for when it is raised.
FORMAT = 1
_NOTES = """\
Times are those of one analysis with its certainty and margin, the shortest of some runs;
numpy's SVD is that of the same matrix with both bases, on one thread, in the same run, and the
ratio that of the first column to it."""


def bench(chosen: argparse.Namespace) -> ExitCode:
    """Measure, and say what was measured as it comes."""
    module = load("flexact.apps.checks.bench")
    machine = load("flexact.apps.cli.about").of_machine()
    with contextlib.suppress(AttributeError, OSError):
        # Times are longer where the machine is busy; not all systems say how busy it is.
        machine.append(("load before", f"{os.getloadavg()[0]:.1f}"))
    threads = (1,) if processors() < 2 else (1, 2)
    if not chosen.json:
        say("\n".join(f"{name:15} {value}" for name, value in machine))
        say(f"\n{module.head(threads)}")
    found = []
    with Bar("bench", "") as bar:
        cases = module.QUICK if chosen.quick else module.CASES
        for made in module.measure(cases, threads, bar.show_work):
            found.append(made)
            if not chosen.json:
                bar.clear()
                say(module.line(made, threads))
    if chosen.json:
        head = {"format": FORMAT, "flexact": VERSION, "quick": chosen.quick}
        pairs = [{"name": name, "value": value} for name, value in machine]
        made = [each.to_dict() for each in found]
        give(load("json").dumps({**head, "machine": pairs, "measurements": made}))
    else:
        say(f"\n{_NOTES}")
    if not all(made.counts_are_right for made in found):
        complain("flexact: error: counts differ from those of the construction: please report it")
        return ExitCode.DIFFERENT
    return ExitCode.ANALYSED


VERB = Verb(
    run=bench,
    description=(
        "Measure how fast this machine analyses mechanisms of growing size, dense and sparse, on "
        "one thread and on two, beside numpy's SVD. It takes half a minute or so."
    ),
    examples=(
        ("What this machine does, for a report", "flexact bench --quick"),
        ("The same for a program", "flexact bench --quick --json"),
    ),
    arguments=(
        argument("--quick", action="store_true", help="small mechanisms, some seconds"),
        argument("--json", action="store_true", help="one JSON object on stdout"),
    ),
)
