# SPDX-License-Identifier: BSD-3-Clause
"""``flexact lsp``: a language server, which an editor starts and talks with."""

from __future__ import annotations

import argparse
import os
import sys
import threading

from ...util.errors import BatchError
from ...util.loading import load
from .parser import Verb, argument
from .terminal import ExitCode


def talk(_: argparse.Namespace) -> ExitCode:
    """Talk with the editor that has started this."""
    try:
        server = load("flexact.apps.editor.server")
    except ImportError as error:
        if (error.name or "").partition(".")[0] not in ("pygls", "lsprotocol"):
            raise
        raise BatchError("flexact lsp needs pygls 2 or newer: pip install 'pygls>=2'") from None
    if sys.stdin.isatty():
        raise BatchError("flexact lsp talks with an editor, which starts it: see docs/editors.md")
    # Nothing but the protocol may go where the editor listens.
    with os.fdopen(os.dup(1), "wb") as stdout:
        os.dup2(2, 1)
        is_over = server.serve(sys.stdin.buffer, stdout)
    code = ExitCode.ANALYSED if is_over else ExitCode.OTHER
    if threading.active_count() > 1:
        # An analysis that nobody waits for would keep the process for a while.
        os._exit(code)
    return code


VERB = Verb(
    run=talk,
    description=(
        "Answer an editor by the language server protocol, over stdin and stdout: problems and "
        "verdict of a deck as it is typed, words on keywords and numbers, completion, outline. "
        "Editors start it: docs/editors.md."
    ),
    examples=(("What Emacs, Neovim or VS Code start", "flexact lsp"),),
    arguments=(
        argument(
            "--stdio", action="store_true", help="by stdin and stdout, as it is without this option"
        ),
    ),
)
