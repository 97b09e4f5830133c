# SPDX-License-Identifier: BSD-3-Clause
"""Help as wide as the terminal: descriptions, and examples that run as they stand in a clone."""

from __future__ import annotations

import argparse
import re
import textwrap
from collections.abc import Iterable

from .terminal import text_width

#: Begins a line of the shell among the examples.
PROMPT = "$ "
_HEAD = "examples, in a clone:"
_STEP = "    "
#: What hangs behind a number or a prompt at the start of a line.
_LEAD = re.compile(r" *(?:\d  |\$ )?")
#: A word of the shell.
_WORD = r"(?:'[^']*'|\"[^\"]*\"|\S)+"
_NARROW, _USUAL = 60, 80


class Formatter(argparse.RawDescriptionHelpFormatter):
    """As wide as the terminal, which argparse asks for by a package that is slow to load."""

    def __init__(self, prog: str) -> None:
        """Take the width where somebody looks."""
        super().__init__(prog, width=text_width(_USUAL), max_help_position=20)

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        return "\n".join(_fitted(line, width) for line in text.splitlines())

    def _format_usage(
        self,
        usage: str | None,
        actions: Iterable[argparse.Action],
        groups: Iterable[argparse._MutuallyExclusiveGroup],
        prefix: str | None,
    ) -> str:
        if usage is not None:
            words = f"{prefix or 'usage: '}{usage % {'prog': self._prog}}"
            made = _wrapped(words, self._width, "       ", break_long_words=False)
            return f"{made}\n\n"
        return super()._format_usage(usage, actions, groups, prefix)


def _fitted(line: str, width: int) -> str:
    found = _LEAD.match(line)
    lead = found[0] if found else ""
    if lead.endswith(PROMPT):
        # A path that is alone in its row is to have room in it.
        return _shell_lines(line, width, " " * (len(lead) if width > _NARROW else 1))
    return _wrapped(line, width, " " * len(lead)) if line.strip() else ""


def _wrapped(text: str, width: int, indent: str, *, break_long_words: bool = True) -> str:
    return textwrap.fill(
        text,
        width,
        subsequent_indent=indent,
        break_on_hyphens=False,
        break_long_words=break_long_words,
    )


def _shell_lines(line: str, width: int, indent: str) -> str:
    """A line of the shell, which goes on behind a backslash where it is too long."""
    words = re.findall(_WORD, line)
    for place in range(len(words) - 2, 1, -1):
        # An option and its value stay together where they fit.
        word, value = words[place : place + 2]
        fits = len(indent) + len(word) + len(value) + 3 <= width
        if fits and word.startswith("-") and value[0] not in "-|<":
            words[place : place + 2] = [f"{word} {value}"]
    rows, row = [], line[: len(line) - len(line.lstrip())] + " ".join(words[:2])
    for place, word in enumerate(words[2:], start=2):
        tail = 0 if place == len(words) - 1 else 2
        if len(row) + 1 + len(word) + tail <= width:
            row = f"{row} {word}"
        else:
            rows.append(row)
            row = indent + word
    return " \\\n".join((*rows, row))


def add_examples(parser: argparse.ArgumentParser, *examples: tuple[str, str]) -> None:
    """Put examples behind a verb's help: of each what it does, and the words of the shell."""
    lines = [_HEAD]
    for about, words in examples:
        lines += [f"  {about}:", f"{_STEP}{PROMPT}{words}"]
    parser.epilog = "\n".join(lines)


def examples_in(parser: argparse.ArgumentParser) -> list[str]:
    """The words of the shell in the examples of a verb's help."""
    start = _STEP + PROMPT
    lines = (parser.epilog or "").splitlines()
    return [line.removeprefix(start) for line in lines if line.startswith(start)]


def set_usage(parser: argparse.ArgumentParser) -> None:
    """Let the usage be one line: what must be stated, and [OPTIONS] for the rest."""
    words = ["%(prog)s", "[OPTIONS]"]
    for action in parser._actions:
        name = str(action.metavar or action.dest).replace("%", "%%")
        if action.option_strings and action.required:
            words.append(f"{action.option_strings[0]} {name}")
        elif not action.option_strings:
            many = "..." if action.nargs in ("+", "*") else ""
            shown = f"{name}{many}"
            words.append(f"[{shown}]" if action.nargs in ("?", "*") else shown)
    parser.usage = " ".join(words)
