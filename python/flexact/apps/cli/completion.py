# SPDX-License-Identifier: BSD-3-Clause
"""Scripts by which bash, zsh and fish complete the words of the command."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from ...util.decks import SUFFIX
from .shell_words import OptionWords, VerbWords

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
