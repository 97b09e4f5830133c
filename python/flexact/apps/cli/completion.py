# SPDX-License-Identifier: BSD-3-Clause
"""Scripts by which bash, zsh and fish complete the words of the command."""

from __future__ import annotations

import argparse
import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from ...util.decks import SUFFIX
from .parser import VERBS, Verb, argument
from .terminal import ExitCode, give


class OptionWords(NamedTuple):
    """An option."""

    names: tuple[str, ...]
    """Such as -o and --output."""
    about: str
    """What help says of it."""
    has_value: bool
    choices: tuple[str, ...]
    """Values that it may have; empty where there are no few."""
    kind: str
    """Of its value: file, folder, deck, or nothing."""
    value: str
    """What help calls its value."""


class VerbWords(NamedTuple):
    """A verb."""

    name: str
    about: str
    options: tuple[OptionWords, ...]
    choices: tuple[str, ...]
    """What its argument may be; empty where there are no few."""
    kind: str
    """Of its arguments, as of an option's value."""

    @property
    def names(self) -> tuple[str, ...]:
        """The names of all options."""
        return tuple(name for option in self.options for name in option.names)


_BASH_HEAD = """\
# Completion of flexact for bash.
_flexact_files() {
    compopt -o filenames 2>/dev/null
    local IFS=$'\\n'
    case $1 in
        deck) COMPREPLY=($(compgen -d -- "$2"; compgen -f -X '!*%s' -- "$2")) ;;
        folder) COMPREPLY=($(compgen -d -- "$2")) ;;
        file) COMPREPLY=($(compgen -f -- "$2")) ;;
    esac
}
_flexact() {
    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]}
    local verb= options= values= kind= index
    COMPREPLY=()
    for ((index = 1; index < COMP_CWORD; index++)); do
        case ${COMP_WORDS[index]} in
            %s) verb=${COMP_WORDS[index]}; break ;;
        esac
    done
    if [[ $cur == = ]]; then
        cur=
    elif [[ $prev == = ]]; then
        prev=${COMP_WORDS[COMP_CWORD-2]}
    fi
    case $verb,$prev in
"""
_BASH_TAIL = """\
    esac
    if [[ -n $values ]]; then
        COMPREPLY=($(compgen -W "$values" -- "$cur"))
        return
    elif [[ -n $kind ]]; then
        [[ $kind == none ]] || _flexact_files "$kind" "$cur"
        return
    fi
    case $verb in
%s    esac
    if [[ $cur == -* ]]; then
        COMPREPLY=($(compgen -W "$options" -- "$cur"))
    elif [[ -n $values ]]; then
        COMPREPLY=($(compgen -W "$values" -- "$cur"))
    elif [[ -n $kind ]]; then
        _flexact_files "$kind" "$cur"
    fi
}
complete -F _flexact flexact
"""


def bash_script(command: VerbWords, verbs: Sequence[VerbWords]) -> str:
    """A script that bash evaluates."""
    head = _BASH_HEAD % (SUFFIX, "|".join(verb.name for verb in verbs))
    lines = []
    for verb in (command, *verbs):
        for option in verb.options:
            if option.has_value:
                patterns = "|".join(f"{verb.name},{name}" for name in option.names)
                if option.choices:
                    what = f"values='{' '.join(option.choices)}'"
                else:
                    what = f"kind={option.kind or 'none'}"
                lines.append(f"        {patterns}) {what} ;;\n")
    tail = []
    for verb in (command, *verbs):
        values = verb.choices if verb.name else tuple(each.name for each in verbs)
        tail.append(
            f"        '{verb.name}') options='{' '.join(verb.names)}'; "
            f"values='{' '.join(values)}'; kind={verb.kind} ;;\n"
        )
    return f"{head}{''.join(lines)}{_BASH_TAIL % ''.join(tail)}"


_ZSH_HEAD = """\
#compdef flexact
# Completion of flexact for zsh.
_flexact() {
    local curcontext=$curcontext state line
    typeset -A opt_args
    _arguments -C %s '1:command:->command' '*::argument:->argument'
    case $state in
        command)
            local -a commands=(%s)
            _describe command commands
            ;;
        argument)
            case $line[1] in
"""
_ZSH_TAIL = """\
            esac
            ;;
    esac
}
if [[ $funcstack[1] == _flexact ]]; then
    _flexact "$@"
else
    compdef _flexact flexact
fi
"""


def zsh_script(command: VerbWords, verbs: Sequence[VerbWords]) -> str:
    """A script that zsh evaluates, or loads as the function _flexact."""
    commands = " ".join(_quoted(f"{verb.name}:{verb.about}") for verb in verbs)
    made = [_ZSH_HEAD % (" ".join(_zsh_options(command)), commands)]
    for verb in verbs:
        rest = f"*:{verb.kind or 'argument'}:{_zsh_values(verb.choices, verb.kind)}"
        words = [*_zsh_options(verb), _quoted(rest)]
        made.append(f"                {verb.name})\n                    _arguments \\\n")
        made += [f"                        {word} \\\n" for word in words[:-1]]
        made.append(f"                        {words[-1]}\n                    ;;\n")
    return f"{''.join(made)}{_ZSH_TAIL}"


def _zsh_options(verb: VerbWords) -> Iterator[str]:
    for option in verb.options:
        about = re.sub(r"([\[\]\\:])", r"\\\1", option.about)
        for name in option.names:
            word = f"*{name}" + ("=" if option.has_value and name.startswith("--") else "")
            word += f"[{about}]"
            if option.has_value:
                value = option.value.replace("\\", "").replace(":", "\\:")
                word += f":{value}:{_zsh_values(option.choices, option.kind)}"
            yield _quoted(word)


def _zsh_values(choices: Sequence[str], kind: str) -> str:
    if choices:
        return f"({' '.join(choices)})"
    return {"deck": f'_files -g "*{SUFFIX}"', "file": "_files", "folder": "_files -/"}.get(
        kind, " "
    )


def fish_script(command: VerbWords, verbs: Sequence[VerbWords]) -> str:
    """A script that fish sources."""
    every = " ".join(verb.name for verb in verbs)
    first = f"not __fish_seen_subcommand_from {every}"
    lines = ["# Completion of flexact for fish.", "complete -c flexact -f"]
    lines += [_fish(first, option) for option in command.options]
    for verb in verbs:
        about = _quoted_for_fish(verb.about)
        lines.append(f"complete -c flexact -n {_quoted(first)} -a {verb.name} -d {about}")
        here = f"__fish_seen_subcommand_from {verb.name}"
        lines += [_fish(here, option) for option in verb.options]
        if values := _fish_values(verb.choices, verb.kind):
            lines.append(f"complete -c flexact -n {_quoted(here)} -k {values}")
    return "\n".join(lines) + "\n"


def _fish(condition: str, option: OptionWords) -> str:
    words = ["complete -c flexact -n", _quoted(condition)]
    for name in option.names:
        words.append(f"-l {name[2:]}" if name.startswith("--") else f"-s {name[1:]}")
    if option.has_value:
        words += ["-x", _fish_values(option.choices, option.kind)]
    words += ["-d", _quoted_for_fish(option.about)]
    return " ".join(word for word in words if word)


def _fish_values(choices: Sequence[str], kind: str) -> str:
    if choices:
        return f"-a {_quoted(' '.join(choices))}"
    made = {
        "deck": f"(__fish_complete_suffix {SUFFIX})",
        "file": "(__fish_complete_path)",
        "folder": "(__fish_complete_directories)",
    }.get(kind)
    return f"-a {_quoted(made)}" if made else ""


def _quoted(text: str) -> str:
    """A word of bash and zsh, and of fish where it holds no quote."""
    return "'" + text.replace("'", "'\\''") + "'"


def _quoted_for_fish(text: str) -> str:
    return "'" + text.replace("\\", "\\\\").replace("'", "\\'") + "'"


SCRIPTS = {"bash": bash_script, "zsh": zsh_script, "fish": fish_script}
SHELLS = tuple(SCRIPTS)
#: What the values of options and arguments are, by what help calls them.
_KINDS = {"DECK": "deck", "DIR": "folder", **dict.fromkeys(("FILE", "PAGE", "TABLE"), "file")}


def complete(chosen: argparse.Namespace) -> ExitCode:
    """Print the script of a shell."""
    verbs = [words_of(verb, chosen.parser_of(verb)) for verb in VERBS]
    # Those of the command itself.
    give(SCRIPTS[chosen.shell](words_of("", chosen.parser_of("")), verbs).removesuffix("\n"))
    return ExitCode.ANALYSED


def words_of(verb: str, parser: argparse.ArgumentParser) -> VerbWords:
    """The words of a verb; of the command itself where it is empty."""
    options: list[OptionWords] = []
    choices: tuple[str, ...] = ()
    takes = ""
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction) or action.help == argparse.SUPPRESS:
            continue
        if not action.option_strings:
            choices = tuple(map(str, action.choices or ()))
            takes = takes or _kind(action)
            continue
        options.append(
            OptionWords(
                tuple(action.option_strings),
                (action.help or "") % {"prog": "flexact", "default": action.default},
                action.nargs != 0,
                tuple(map(str, action.choices or ())),
                _kind(action),
                str(action.metavar or action.dest),
            )
        )
    return VerbWords(verb, VERBS.get(verb, ""), tuple(options), choices, takes)


def _kind(action: argparse.Action) -> str:
    """What a value names: a deck, a file, a folder, or nothing that stands in folders."""
    return _KINDS.get(str(action.metavar), "")


VERB = Verb(
    run=complete,
    description=(
        "Write a script by which a shell completes verbs, options, their values, and decks. It is "
        "made from this version's own options: make it anew after an update, or let each shell "
        "make it when it starts, as in the examples."
    ),
    examples=(
        ("For bash, in ~/.bashrc", 'eval "$(flexact completion bash)"'),
        ("For zsh, in ~/.zshrc behind compinit", 'eval "$(flexact completion zsh)"'),
        ("For fish, in ~/.config/fish/config.fish", "flexact completion fish | source"),
    ),
    arguments=(argument("shell", choices=SHELLS, metavar="SHELL", help=", ".join(SHELLS)),),
)
