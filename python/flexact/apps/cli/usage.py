# SPDX-License-Identifier: BSD-3-Clause
"""Wrong usage in words as cargo and ruff have them: what is wrong, a tip, the usage, the help."""

from __future__ import annotations

import argparse
import difflib
import re
from collections.abc import Iterable

_UNKNOWN = re.compile(r"unrecognized arguments: (.*)", re.DOTALL)
_MISSING = re.compile(r"the following arguments are required: (.*)")
_CHOICE = re.compile(r"argument (\S+): invalid choice: '(.*)' \(choose from (.*)\)", re.DOTALL)
_NO_VALUE = re.compile(r"argument (\S+): expected (?:one|at least one) argument")
_INVALID = re.compile(r"argument (\S+): (.*)", re.DOTALL)


def told(message: str, parser: argparse.ArgumentParser) -> str:
    """What argparse says, as people know it from elsewhere.

    Args:
        message: Of argparse.
        parser: Of the command or of a verb.
    """
    what, tip = _meant(message, parser)
    usage = parser.format_usage().strip()
    parts = [f"error: {what}"]
    if tip:
        parts.append(f"  tip: {tip}")
    parts += [f"U{usage[1:]}", f"For more information, try '{parser.prog} --help'."]
    return "\n\n".join(parts)


def _meant(message: str, parser: argparse.ArgumentParser) -> tuple[str, str]:
    """What is wrong, and a tip, which may be empty."""
    if found := _UNKNOWN.fullmatch(message):
        first = next((w for w in found[1].split() if w.startswith("-")), found[1].split(" ")[0])
        word = first.split("=")[0]
        near = _near(word, parser._option_string_actions)
        tip = f"a similar argument exists: '{near}'" if near else ""
        return f"unexpected argument '{first}' found", tip
    if found := _MISSING.fullmatch(message):
        names = found[1]
        if names == "COMMAND":
            return "a command is required but none was given", ""
        return f"the following required arguments were not given: {names}", ""
    if found := _CHOICE.fullmatch(message):
        return _wrong_choice(found[1], found[2], re.findall(r"[\w-]+", found[3]))
    if found := _NO_VALUE.fullmatch(message):
        return f"a value is required for '{found[1]}' but none was given", ""
    if found := _INVALID.fullmatch(message):
        return f"invalid value for '{found[1]}': {found[2]}", ""
    return message, ""


def _wrong_choice(name: str, given: str, choices: list[str]) -> tuple[str, str]:
    near = _near(given, choices)
    if name == "COMMAND":
        tip = f"a similar command exists: '{near}'" if near else ""
        return f"unrecognized command '{given}'", tip
    tip = f"a similar value exists: '{near}'" if near else ""
    return f"invalid value '{given}' for '{name}': choose from {', '.join(choices)}", tip


def _near(word: str, known: Iterable[str]) -> str:
    found = difflib.get_close_matches(word, list(known), 1)
    return found[0] if found else ""
