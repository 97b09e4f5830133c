# SPDX-License-Identifier: BSD-3-Clause
"""Scripts by which bash, zsh and fish complete the words of the command."""

from __future__ import annotations

import argparse
import re
from collections.abc import Iterator, Sequence

from ...util.decks import SUFFIX
from .parser import VERBS, Verb, argument
from .terminal import ExitCode, give

#: A verb, empty for the command itself; its options; and its argument, if it takes one.
VerbWords = tuple[str, list[argparse.Action], argparse.Action | None]
#: What the values of options and arguments are, by what help calls them.
_KINDS = {"DECK": "deck", "DIR": "folder", **dict.fromkeys(("FILE", "PAGE", "TABLE"), "file")}


def words_of(verb: str, parser: argparse.ArgumentParser) -> VerbWords:
    """The words of a verb; of the command itself where it is empty."""
    actions = [
        action
        for action in parser._actions
        if not isinstance(action, argparse._SubParsersAction) and action.help != argparse.SUPPRESS
    ]
    options = [action for action in actions if action.option_strings]
    return verb, options, next((each for each in actions if not each.option_strings), None)


def _about(option: argparse.Action) -> str:
    """What help says of it."""
    return (option.help or "") % {"prog": "flexact", "default": option.default}


def _choices(action: argparse.Action | None) -> tuple[str, ...]:
    """Values that it may have; empty where there are no few."""
    return () if action is None else tuple(map(str, action.choices or ()))


def _kind(action: argparse.Action | None) -> str:
    """What a value names: a deck, a file, a folder, or nothing that stands in folders."""
    return "" if action is None else _KINDS.get(str(action.metavar), "")


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
    known = tuple(verb for verb, *_ in verbs)
    head = _BASH_HEAD % (SUFFIX, "|".join(known))
    lines, tail = [], []
    for verb, options, takes in (command, *verbs):
        for option in options:
            if option.nargs != 0:
                patterns = "|".join(f"{verb},{name}" for name in option.option_strings)
                choices = _choices(option)
                what = f"values='{' '.join(choices)}'" if choices else ""
                what = what or f"kind={_kind(option) or 'none'}"
                lines.append(f"        {patterns}) {what} ;;\n")
        names = " ".join(name for option in options for name in option.option_strings)
        values = " ".join(_choices(takes) if verb else known)
        tail.append(
            f"        '{verb}') options='{names}'; values='{values}'; kind={_kind(takes)} ;;\n"
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
    commands = " ".join(_quoted(f"{verb}:{VERBS[verb]}") for verb, *_ in verbs)
    made = [_ZSH_HEAD % (" ".join(_zsh_options(command[1])), commands)]
    for verb, options, takes in verbs:
        rest = f"*:{_kind(takes) or 'argument'}:{_zsh_values(takes)}"
        words = [*_zsh_options(options), _quoted(rest)]
        made.append(f"                {verb})\n                    _arguments \\\n")
        made += [f"                        {word} \\\n" for word in words[:-1]]
        made.append(f"                        {words[-1]}\n                    ;;\n")
    return f"{''.join(made)}{_ZSH_TAIL}"


def _zsh_options(options: Sequence[argparse.Action]) -> Iterator[str]:
    for option in options:
        about = re.sub(r"([\[\]\\:])", r"\\\1", _about(option))
        has_value = option.nargs != 0
        value = str(option.metavar or option.dest).replace("\\", "").replace(":", "\\:")
        for name in option.option_strings:
            word = f"*{name}{'=' * (has_value and name.startswith('--'))}[{about}]"
            yield _quoted(f"{word}:{value}:{_zsh_values(option)}" if has_value else word)


def _zsh_values(action: argparse.Action | None) -> str:
    if choices := _choices(action):
        return f"({' '.join(choices)})"
    known = {"deck": f'_files -g "*{SUFFIX}"', "file": "_files", "folder": "_files -/"}
    return known.get(_kind(action), " ")


def fish_script(command: VerbWords, verbs: Sequence[VerbWords]) -> str:
    """A script that fish sources."""
    first = f"not __fish_seen_subcommand_from {' '.join(verb for verb, *_ in verbs)}"
    lines = ["# Completion of flexact for fish.", "complete -c flexact -f"]
    lines += [_fish(first, option) for option in command[1]]
    for verb, options, takes in verbs:
        about = _quoted_for_fish(VERBS[verb])
        lines.append(f"complete -c flexact -n {_quoted(first)} -a {verb} -d {about}")
        here = f"__fish_seen_subcommand_from {verb}"
        lines += [_fish(here, option) for option in options]
        if values := _fish_values(takes):
            lines.append(f"complete -c flexact -n {_quoted(here)} -k {values}")
    return "\n".join(lines) + "\n"


def _fish(condition: str, option: argparse.Action) -> str:
    names = option.option_strings
    words = ["complete -c flexact -n", _quoted(condition)]
    words += [f"-l {name[2:]}" if name.startswith("--") else f"-s {name[1:]}" for name in names]
    words += ["-x", _fish_values(option)] if option.nargs != 0 else []
    words += ["-d", _quoted_for_fish(_about(option))]
    return " ".join(word for word in words if word)


def _fish_values(action: argparse.Action | None) -> str:
    if choices := _choices(action):
        return f"-a {_quoted(' '.join(choices))}"
    made = {
        "deck": f"(__fish_complete_suffix {SUFFIX})",
        "file": "(__fish_complete_path)",
        "folder": "(__fish_complete_directories)",
    }.get(_kind(action))
    return f"-a {_quoted(made)}" if made else ""


def _quoted(text: str) -> str:
    """A word of bash and zsh, and of fish where it holds no quote."""
    return "'" + text.replace("'", "'\\''") + "'"


def _quoted_for_fish(text: str) -> str:
    return "'" + text.replace("\\", "\\\\").replace("'", "\\'") + "'"


SCRIPTS = {"bash": bash_script, "zsh": zsh_script, "fish": fish_script}
SHELLS = tuple(SCRIPTS)


def complete(chosen: argparse.Namespace) -> ExitCode:
    """Print the script of a shell."""
    verbs = [words_of(verb, chosen.parser_of(verb)) for verb in VERBS]
    # Those of the command itself.
    give(SCRIPTS[chosen.shell](words_of("", chosen.parser_of("")), verbs).removesuffix("\n"))
    return ExitCode.ANALYSED


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
