# SPDX-License-Identifier: BSD-3-Clause
"""A process in which Flexact believes to be on Windows or macOS, as far as that goes on Linux.

All modules are loaded once, and with them all of Python and of other packages that they use.
Then the system gets another name, loses what the other one lacks, and Flexact is loaded anew.

Usage: python pretended_system.py SYSTEM COMMAND ... + COMMAND ..., SYSTEM COMMAND ..., where a
system is darwin or win32, which has less. Each command's exit code is told on stderr.
"""

from __future__ import annotations

import os
import pkgutil
import signal
import sys
import sysconfig
import types
from collections.abc import Iterator
from importlib import import_module

#: What no module may need there: of Python, of `os`, of `signal`.
LACKING = {
    "win32": (
        ("resource", "fcntl", "termios", "pwd", "grp", "tty", "pty"),
        (
            *("fork", "forkpty", "killpg", "setsid", "getpgid", "getuid", "geteuid", "getgid"),
            *("getegid", "mkfifo", "sched_getaffinity", "sysconf", "register_at_fork", "uname"),
        ),
        ("SIGHUP", "SIGPIPE", "SIGKILL", "SIGUSR1", "pthread_sigmask", "alarm", "setitimer"),
    ),
    "darwin": ((), ("sched_getaffinity",), ()),
}
KEPT = "flexact.core._core"


def modules() -> Iterator[str]:
    """All modules of the package."""
    import flexact

    yield "flexact"
    for found in pkgutil.walk_packages(flexact.__path__, "flexact."):
        if not found.name.endswith("__main__"):
            yield found.name


def prepare() -> list[str]:
    """Load all; the names of the modules of the package."""
    names = list(modules())
    for name in names:
        import_module(name)
    # Chosen or loaded late by others, which ask for the system then.
    sysconfig.get_config_vars()
    controller = import_module("threadpoolctl").ThreadpoolController
    controller._find_libraries_on_windows = lambda _: None
    for name in ("matplotlib.backends.backend_agg", "multiprocessing.popen_fork", "PIL.Image"):
        import_module(name)
    return names


def pretend(system: str, names: list[str]) -> None:
    """Become another system."""
    for name in [name for name in sys.modules if name.split(".")[0] == "flexact"]:
        if name != KEPT:
            del sys.modules[name]
    blocked, of_os, of_signal = LACKING[system]
    for name in blocked:
        sys.modules[name] = None  # type: ignore[assignment]
    for module, lacking in ((os, of_os), (signal, of_signal)):
        for name in lacking:
            if hasattr(module, name):
                delattr(module, name)
    if system == "win32":
        msvcrt = types.ModuleType("msvcrt")
        msvcrt.LK_NBLCK = 2  # type: ignore[attr-defined]
        msvcrt.locking = lambda handle, mode, size: None  # type: ignore[attr-defined]
        sys.modules["msvcrt"] = msvcrt
    sys.platform = system
    for name in names:
        import_module(name)


def main() -> int:
    """Run commands on another system."""
    names = prepare()
    worst = 0
    for part in " ".join(sys.argv[1:]).split(", "):
        system, _, commands = part.partition(" ")
        pretend(system, names)
        command = import_module("flexact.apps.cli.main").main
        for words in commands.split(" + "):
            code = command(words.split())
            print(f"exit {code}: {system} {words}", file=sys.stderr)
            worst = max(worst, code)
    return worst


if __name__ == "__main__":
    sys.exit(main())
