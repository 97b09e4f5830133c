# SPDX-License-Identifier: BSD-3-Clause
"""From a deck or a script to what the page shows."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from dataclasses import replace

from ...analysis.result import Result, result_of
from ...analysis.spaces import asked_for
from ...analysis.text_margin import verdict_word
from ...deck.errors import ProblemsError
from ...deck.rendering import render_problems
from ...model.data import ModelData
from ...model.reading import read_file
from ...show.page.content import broken_content, content_of
from ...util.partial import why
from .errors_part import errors_part
from .messages import Told, told_of
from .script import Script
from .watching_messages import Answer, Broken, Job, Judged, Shown


def answer_of(job: Job, judged: Callable[[Judged], None]) -> Answer:
    """What a job gives; what is wrong with the deck or the script is an answer too.

    Args:
        job: What is asked for.
        judged: Called with the verdict, which is there before the scene.
    """
    script = Script(job.path) if job.is_script else None
    which = model = ""
    try:
        if script is None:
            result: Result = result_of(read_file(job.path), asked_for(*job.decision))
        else:
            found = script.run()
            which, model = found.which, found.model
            result = _result(found.shown, found.name, job)
        told = told_of(result)
        judged(Judged(told))
        shown = shown_of(result, told, which, () if script is None else script.files())
        return replace(shown, result=_kept(result), model=model)
    except Exception as error:
        return _broken(error, job.path, () if script is None else script.files())


def _kept(result: Result) -> bytes:
    """The result for who switches; empty where a script has put into it what cannot be kept."""
    try:
        return pickle.dumps(result, pickle.HIGHEST_PROTOCOL)
    except Exception:
        return b""


def _result(shown: object, name: str, job: Job) -> Result:
    if isinstance(shown, Result):
        return shown
    data: ModelData = shown.data  # type: ignore[attr-defined]
    return result_of(data, asked_for(*job.decision), data.name or name)


def shown_of(
    result: Result, told: Told, which: str, files: tuple[str, ...], *, is_edited: bool = False
) -> Shown:
    """A result as the page shows it.

    Args:
        result: The result.
        told: What is told of it.
        which: Which model it is, in words.
        files: What it was made of.
        is_edited: Whether it is not that of the file.
    """
    body = content_of(result, has_origin=not is_edited).body
    title = verdict_word(result)
    given = result.given
    problems = given.problems
    words = render_problems(problems, given.name, given.source) if problems.kept else ""
    return Shown(title, body, told, which, words, files)


def _broken(error: Exception, path: str, files: tuple[str, ...]) -> Broken:
    words = str(error) if isinstance(error, ProblemsError) else why(error)
    body = broken_content(error, path).body
    return Broken("cannot be analysed", errors_part(error, path), body, words, files)
