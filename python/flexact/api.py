# SPDX-License-Identifier: BSD-3-Clause
"""What users meet: `analyse`, and its result with all that can be made from it."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .advice.describe import describe
from .advice.todo import todo_of
from .analysis.decomposition import AccuracyGiven, asked_for
from .analysis.json import dictionary_of, text_of
from .analysis.result import Result, result_of
from .analysis.verdict import AnalysisError
from .analysis.verdict_words import margin_in_short, warning_of, warnings_of
from .core.arrays import FloatArray
from .core.progress import Progress
from .deck.diagnostics import Diagnostic
from .deck.rendering import ProblemsError
from .model.model import Model
from .model.reading import read
from .util.loading import load
from .util.partial import attempted
from .util.records import cached_property

if TYPE_CHECKING:
    import meshio

    from .advice.advice import Advice
    from .model.jacobian import Jacobian


@dataclass(frozen=True, eq=False, repr=False)
class Analysis(Result):
    """The result of an analysis, with words, files and pictures of it."""

    @property
    def model(self) -> Model:
        """The model as it was when it was analysed: a new one each time, free to be changed."""
        return Model.from_data(self.given)

    @property
    def doubts(self) -> tuple[str, ...]:
        """Sentences that say why the rank is doubtful."""
        return tuple(warning_of(self, doubt).message for doubt in self.assessment.doubts)

    @cached_property
    def warnings(self) -> tuple[Diagnostic, ...]:
        """Warnings and notes about the model and about the decision on its rank."""
        return warnings_of(self)

    def dense_jacobian(self) -> FloatArray:
        """D(c) itself, (m, n), in the model's units, eq. (11).

        A divided sheet or wire that is declared counts as one beam.
        """
        whole: Jacobian = load("flexact.model.jacobian").jacobian(Model.from_data(self.data))
        row_of = {label: i for i, label in enumerate(whole.row_labels)}
        column_of = {label: i for i, label in enumerate(whole.column_labels)}
        rows = [row_of[label] for label in self.row_labels]
        columns = [column_of[label] for label in self.column_labels]
        part: FloatArray = whole.toarray()[rows][:, columns]
        return part

    def to_dict(self) -> dict[str, Any]:
        """The result as the JSON has it; components that are practically zero are left out."""
        return dictionary_of(self)

    def to_json(self) -> str:
        """One line of JSON, of `to_dict`; numbers read back to the last bit."""
        return text_of(self)

    def to_meshio(self) -> meshio.Mesh:
        """The mechanism with its motions and self-stresses as a mesh (`flexact.show.mesh`)."""
        made: meshio.Mesh = load("flexact.show.mesh").to_meshio(self)
        return made

    def save(
        self,
        path: str | os.PathLike[str],
        *,
        motion: int | None = None,
        freedom: int | str | None = None,
        stress: int | None = None,
        quantity: str | None = None,
        view: str | None = None,
    ) -> None:
        """Write the result to a file, whole or not at all.

        Args:
            path: Its suffix says what it is to be: a picture (.png, .svg, .pdf, or .gif, .mp4 and
                .webm, which move; `flexact.show.picture`), a page (.html; `flexact.show.page`), a
                cycle for ParaView (.pvd), or a mesh (.vtu, .vtp, .vtk, .xdmf, ...;
                `flexact.show.mesh`).
            motion: Number of the motion that is shown, from 1; of pictures and meshes.
            freedom: Number of the declared degree of freedom that is shown, likewise.
            stress: Number of the self-stress that is shown, of pictures.
            quantity: Of the self-stress in pictures: "normal force", "twist moment", "in-plane
                moment" or "out-of-plane moment".
            view: From where, of pictures; see `flexact.show.picture.draw`.

        Raises:
            FlexactError: Something chosen is not there, there is no such kind of file, a
                package is missing, or the file cannot be written.
        """
        choice = {
            "motion": motion,
            "freedom": freedom,
            "stress": stress,
            "quantity": quantity,
            "view": view,
        }
        load("flexact.show.saving").save(self, Path(path), choice)

    def show(self, path: str | os.PathLike[str] | None = None) -> Path | None:
        """Show the page of the result: in the browser, or in the notebook.

        Where no browser can be opened, it is said where the page is.

        Args:
            path: Where the page is written, such as "guide.html"; by default a temporary file.

        Returns:
            Where the page is; None in a notebook, and in a script that `flexact watch` runs.

        Raises:
            FlexactError: The page cannot be written, or the path is not that of a page.
        """
        window = load("flexact.show.window")
        if window.is_taken(self) or (path is None and window.is_displayed(self)):
            return None
        if path is None:
            # The still picture of `save` takes a while, and is for browsers elsewhere.
            page = load("flexact.show.page").page(self)
            target = window.write_page(load("flexact.show.writers").as_bytes(page), self.name)
        else:
            target = window.page_path(path)
            self.save(target)
        opened: Path = window.open_page(target)
        return opened

    def advice(
        self, body: str | None = None, wanted: Sequence[str] = (), bodies: bool = False
    ) -> Advice:
        """What is wrong and why, and steps that mend it, each analysed before it is shown.

        Args:
            body: The body whose freedom and constraint are looked at, by name.
            wanted: Motions that are meant to be free, such as "stage: translation z"; what else
                moves is unwanted.
            bodies: Whether insides of rigid bodies may be released where anything else does it,
                too.

        Raises:
            ModelError: no body has this name, or a text is not understood.
        """
        # Few ask for it, and it takes a while to load.
        made: Advice = load("flexact.advice.advice").advice_of(self, body, wanted, bodies)
        return made

    def describe(self, verbose: bool = False) -> str:
        """The result in plain English, on one screen: verdict, bodies, what to do, and why.

        Where stiffness is given (ESTIFF), also what over-constraint costs, and where it rests
        under loads, in a sentence each.

        Args:
            verbose: Whether all is said: all motions and self-stresses, how the rank was decided,
                and everything that may be declared, held, released or freed.
        """
        return describe(self, verbose=verbose, todo=todo_of(self, *glances(self, None)))

    def __repr__(self) -> str:
        """Verdict, margin and size in a line."""
        name = f" {self.name!r}" if self.name else ""
        motions = f"{self.under_constrained} motion{'s' * (self.under_constrained != 1)}"
        stresses = f"{self.over_constrained} self-stress{'es' * (self.over_constrained != 1)}"
        return (
            f"<Analysis{name}: {self.verdict.value}, {margin_in_short(self)}, "
            f"{motions}, {stresses}, "
            f"D(c) {self.rows} x {self.columns} of rank {self.rank}>"
        )

    def _repr_html_(self) -> str:
        # Notebooks alone ask for it.
        made: str = load("flexact.show.notebook.output").html_of(self)
        return made

    def in_notebook(self, what: object) -> str | None:
        """HTML of a motion, a self-stress or a row of them, with pictures."""
        made: str | None = load("flexact.show.notebook.output").html_of_part(self, what)
        return made


def glances(result: Result, missing: list[str] | None) -> tuple[str, str]:
    """What over-constraint costs, and where it rests under loads, in a sentence each, or empty.

    Args:
        result: The result.
        missing: Takes why one is not there.
    """
    costs = rest = ""
    # Both take a while to load.
    if result.over_constrained and result.given.has_stiffness:
        quick = load("flexact.costs.quick_cost")
        costs = attempted(
            "What over-constraint costs", lambda: str(quick.quick_cost(result)), "", missing
        )
    if result.given.loads is not None and result.given.has_stiffness:
        module = load("flexact.costs.at_rest")
        rest = attempted(
            "Where it rests", lambda: str(module.at_rest_in_words(result)), "", missing
        )
    return costs, rest


def analyse(
    model: Model | str | bytes | os.PathLike[str] | os.PathLike[bytes],
    *,
    method: str = "auto",
    tolerance: float | None = None,
    prove: bool | None = None,
    accuracy: AccuracyGiven | None = None,
    beyond: bool = False,
    name: str | None = None,
    progress: Progress | None = None,
) -> Analysis:
    """Decide whether a mechanism is exactly, under- or over-constrained.

    Partition of eq. (7), Jacobian D(c) of eq. (11), its singular value decomposition
    eq. (16), and Table 1 of the paper.

    Args:
        model: A model, or the path of a deck.
        method: How D(c) is decomposed: `auto` chooses by size and structure; `svd`;
            `jacobi`, small singular values to high relative accuracy; `sparse`, for large
            models.
        tolerance: Singular values of the scaled D(c) up to this one count as zero; by
            default it follows from the data and the arithmetic.
        prove: Whether the rank is to be proven in exact arithmetic, as far as memory and some
            minutes allow; by default where it costs little.
        accuracy: To what the parts are made and put together: a length [m], or a length and an
            angle [rad]. A margin that is smaller is said beside the verdict, and has another
            colour; see `Analysis.is_marginal`.
        beyond: Whether the accuracy may be larger than the model.
        name: What the result is called; by default the model's name or the path.
        progress: Called with what is being done and how much of that is done, from 0 to 1,
            some times a second.

    Raises:
        DeckError: the model's deck is wrong.
        ModelError: the model is wrong.
        AnalysisError: the model is too large for the memory, the decomposition did not
            converge, or this build lacks what the method needs; or the accuracy is larger than
            the model, and not `beyond`.
        TypeError: what is given is neither a model nor a path, or the tolerance no number,
            the method or the name no text, `prove` no truth value, the accuracy neither a
            number nor two, or `progress` nothing to call.
        ValueError: there is no such method, the tolerance is negative or not finite, or the
            accuracy is not positive or not finite.
    """
    if not isinstance(model, (Model, str, bytes, os.PathLike)):
        kind = type(model).__name__
        raise TypeError(f"a model or the path of a deck can be analysed, not {kind}")
    if not isinstance(name, (str, type(None))):
        raise TypeError(f"the name of a result must be text, not {type(name).__name__}")
    if progress is not None and not callable(progress):
        raise TypeError(f"progress must be something to call, not {type(progress).__name__}")
    # What is asked is refused before a deck is read.
    asked_for(method, tolerance, prove, accuracy)
    if not isinstance(model, Model):
        model = read(model)
    asked = asked_for(method, tolerance, prove, accuracy, model.data.units)
    if asked.accuracy is not None and not beyond:
        asked.accuracy.require_within(model.data.size, model.data.units)
    return result_of(model.data, asked, name, progress, Analysis)


def show_model(model: Model, path: str | os.PathLike[str] | None = None) -> Path | None:
    """Analyse a model and show its page, or that of its errors; see `Model.show`."""
    window = load("flexact.show.window")
    if window.is_taken(model):
        return None
    try:
        analysis = analyse(model)
    except (ProblemsError, AnalysisError) as error:
        if path is None and window.is_displayed(window.InWords(error)):
            return None
        name = model.name or "model"
        target = None if path is None else window.page_path(path)
        page = load("flexact.show.page").broken_page(error, name)
        written = window.write_page(load("flexact.show.writers").as_bytes(page), name, target)
        opened: Path = window.open_page(written)
        return opened
    return analysis.show(path)
