# SPDX-License-Identifier: BSD-3-Clause
"""Of which body a freedom space is asked: by its name, or the one that a designer means."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ...analysis.carriers import Joint
from ...analysis.result import Result
from ...core.arrays import FloatArray
from ...core.elements import Class, NodeKind
from ...deck.errors import ModelError, model_error
from ...model.names import nearest
from ...model.parts.parts import Part, natural
from ...util.plain_text import in_short

#: Where so many parts meet they may be the two leaves of a folded sheet.
_OF_A_FOLD = 2


class Subject(NamedTuple):
    """A body, or a joint with an orientation, and its nodes in the model as given."""

    body: Part | Joint
    positions: tuple[int, ...]
    """Indices of the position nodes that it carries."""
    orientations: tuple[int, ...]
    """Indices of the orientation nodes that turn with it."""

    @property
    def name(self) -> str:
        """What it is called."""
        return str(self.body)

    @property
    def is_body(self) -> bool:
        """Whether it is a body, not a joint."""
        return isinstance(self.body, Part)

    def middle(self, result: Result) -> FloatArray:
        """(3,) the mean of its points [m]."""
        values = result.given.arrays.node_value[:3, list(self.positions)]
        made: FloatArray = values.mean(axis=1)
        return made


def subjects_of(result: Result) -> tuple[Subject, ...]:
    """All bodies, then all joints that have an orientation, without those that are ground."""
    return tuple(each for each in _all(result) if not is_ground(result, each))


def _all(result: Result) -> Iterator[Subject]:
    parts = result.parts
    for k, body in enumerate(parts.bodies):
        yield Subject(parts.of_body(k), body.positions, body.orientations)
    for joint in result.carriers.joints:
        if joint.position is not None and joint.orientation is not None:
            yield Subject(joint, (joint.position,), (joint.orientation,))


def is_ground(result: Result, subject: Subject) -> bool:
    """Whether a support holds it in all that it has."""
    held = result.parts.is_held
    fixed = [position for position in subject.positions if held(position)]
    return bool(fixed) and any(map(held, subject.orientations))


def subject_named(result: Result, name: str) -> Subject:
    """The body or joint of a name; of a point on a body the body.

    Raises:
        ModelError: there is none, it is no body, or there are several.
    """
    every = tuple(_all(result))
    for spelling in (name, f"the {name}", name.removeprefix("the ")) if name.strip() else ():
        bodies = [each for each in every if each.is_body and each.name == spelling]
        found = bodies or _of_point(result, every, spelling)
        if not found:
            found = [each for each in every if each.name == spelling]
        if len(found) > 1:
            raise model_error(
                "ambiguous-part",
                f"{len(found)} bodies are called {in_short(name)}",
                "give each a name of its own",
            )
        if found:
            return found[0]
    raise _no_body(result, every, name)


def _of_point(result: Result, every: tuple[Subject, ...], name: str) -> list[Subject]:
    parts = result.parts
    kinds = result.given.arrays.node_kind
    places = [
        node
        for node in np.flatnonzero(kinds <= NodeKind.POSITION).tolist()
        if parts.name_of_point(node) == name
    ]
    return [each for each in every if any(node in each.positions for node in places)]


def _no_body(result: Result, every: tuple[Subject, ...], name: str) -> ModelError:
    others = [part for part in result.parts.all if part.name == name]
    if others:
        what = f"{in_short(name)} is no body but a {others[0].kind}"
    elif name.strip() and any(
        result.parts.name_of_point(k) == name for k in range(len(result.given.node_names))
    ):
        what = f"the point {in_short(name)} has no orientation: nothing there can turn"
    else:
        what = f"there is no body called {in_short(name)}"
    names = list(dict.fromkeys(each.name for each in every if each.is_body))
    names += [each.name for each in every if not each.is_body and _is_named(each)]
    near = nearest(name, names) or sorted(names, key=natural)[:3]
    are = "is" if len(near) == 1 else "are"
    hint = f"there {are} {', '.join(map(in_short, near))}" if near else "this mechanism has no body"
    return model_error("no-body", what, hint)


def _is_named(subject: Subject) -> bool:
    return isinstance(subject.body, Joint) and bool(subject.body.name)


class Rank(NamedTuple):
    """By what the body that a designer means is found; the first that differs decides."""

    declared: int
    """Less how many coordinates of it are declared independent."""
    is_joint: bool
    attached: int
    """Of joints less how many parts meet there, if more than at a fold."""
    freedom: int
    """Less in how many independent ways it moves."""
    size: float
    """Less its extent, in parts of the characteristic length."""
    name: tuple[tuple[bool, int, str, str], ...]
    place: tuple[float, ...]


def rank_of(result: Result, subject: Subject, freedom: int) -> Rank:
    """The body with the least rank is the one that is meant when none is named."""
    arrays, length = result.given.arrays, result.characteristic_length
    nodes = [*subject.positions, *subject.orientations]
    declared = int(np.sum(arrays.coordinate_class[:, nodes] == Class.INDEPENDENT))
    places = arrays.node_value[:3, list(subject.positions)].T / length
    size = float(np.linalg.norm(np.ptp(places, axis=0)))
    parts = 0 if isinstance(subject.body, Part) else len(subject.body.parts)
    parts = parts if parts > _OF_A_FOLD else 0
    name = subject.body.name
    if isinstance(subject.body, Part) and not subject.body.is_named:
        name = ""
    middle = tuple((np.round(places.mean(axis=0), 9) + 0.0).tolist())
    return Rank(
        -declared, not subject.is_body, -parts, -freedom, -round(size, 9), natural(name), middle
    )
