# SPDX-License-Identifier: BSD-3-Clause
"""What advice says of motions and self-stresses: cause, extent, what moves, and a sentence."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

from ..analysis.modes import Motion, SelfStress
from ..analysis.naming import named_node
from ..analysis.places import joint_node
from ..analysis.result import Result
from ..analysis.screws import Screw, ScrewKind
from ..analysis.sentences import Pieces
from ..motion.advising_extents import extent_in_words
from ..motion.extent import Extent
from ..util.cached import cached_property
from ..util.records import Frozen
from .advising_motions import motion_in_sentence, moving_groups, nothing_stops
from .causes.cause import Cause, Causes
from .causes.words import cause_of_motion_in_words, cause_of_stress_in_words
from .self_stresses import stress_in_sentence
from .sentences import in_a_row, sentence


class MovingBody(NamedTuple):
    """A body, or a point where there is none, and how it moves."""

    name: str
    screw: Screw
    """Kind, direction, point and pitch."""


@dataclass(frozen=True, repr=False)
class AdvisedMotion(Frozen):
    """A motion that nothing determines: what it is, why it is there, and how far it goes.

    Attributes:
        motion: The motion itself.
        causes: Why motions and self-stresses are there.
        extent: Whether it goes on, and how that is known.
    """

    motion: Motion
    causes: Causes
    extent: Extent

    @property
    def _result(self) -> Result:
        result = self.motion.analysis
        assert isinstance(result, Result)
        return result

    @property
    def cause(self) -> Cause:
        """Whether any geometry has it, or this one."""
        return self.causes.motions[self.motion.index]

    @property
    def internal(self) -> bool:
        """Whether nothing moves but insides of sheets and wires, and folds."""
        return self._result.are_between_ends[self.motion.index]

    @cached_property
    def bodies(self) -> tuple[MovingBody, ...]:
        """The bodies that move; where there are none, ends and joints; none of an internal one."""
        return () if self.internal else tuple(_bodies(self._result, self.motion))

    @cached_property
    def sentences(self) -> tuple[Pieces, Pieces, Pieces]:
        """What moves, how far it goes, and why it is there."""
        result, index = self._result, self.motion.index
        return (
            sentence(motion_in_sentence(result, self.motion)),
            sentence(extent_in_words(result, self.extent)),
            sentence(cause_of_motion_in_words(result, index, self.causes)),
        )

    @property
    def statement(self) -> str:
        """All of it, and that nothing stops it, as text."""
        moves = motion_in_sentence(self._result, self.motion)
        stopped = nothing_stops(self._result, self.motion)
        return in_a_row((sentence((*moves, stopped)), *self.sentences[1:]))

    def __repr__(self) -> str:
        """Number and words."""
        return f"<Motion {self.motion.index + 1}: {self.statement}>"


@dataclass(frozen=True, repr=False)
class AdvisedStress(Frozen):
    """A self-stress: what is stopped twice, and why.

    Attributes:
        stress: The self-stress itself.
        causes: Why motions and self-stresses are there.
    """

    stress: SelfStress
    causes: Causes

    @property
    def cause(self) -> Cause:
        """Whether any geometry has it, or this one."""
        return self.causes.self_stresses[self.stress.index]

    @property
    def _result(self) -> Result:
        result = self.stress.analysis
        assert isinstance(result, Result)
        return result

    @cached_property
    def sentences(self) -> tuple[Pieces, Pieces]:
        """Which parts fight over what, and why it is there."""
        result, index = self._result, self.stress.index
        return (
            sentence(stress_in_sentence(result, self.stress)),
            sentence(cause_of_stress_in_words(result, index, self.causes)),
        )

    @property
    def statement(self) -> str:
        """All of it, as text."""
        return in_a_row(self.sentences)

    def __repr__(self) -> str:
        """Number and words."""
        return f"<SelfStress {self.stress.index + 1}: {self.statement}>"


def _bodies(result: Result, motion: Motion) -> Iterator[MovingBody]:
    if not result.is_told_by_parts:
        return
    numbers = result.given.arrays.node_number
    for group in moving_groups(result, motion):
        for part in group.bodies:
            yield MovingBody(part.name, group.screw)
        for joint in () if group.bodies else group.joints:
            node = int(numbers[joint_node(result.parts, joint)])
            yield MovingBody(named_node(result, node).words, group.screw)


def dictionary_of_body(body: MovingBody) -> dict[str, object]:
    """A moving body as the JSON has it; of a translation there is neither point nor pitch."""
    screw = body.screw
    turns = screw.kind is not ScrewKind.TRANSLATION
    return {
        "name": body.name,
        "kind": screw.kind.value,
        "axis": screw.direction.tolist(),
        "point": screw.point.tolist() if turns else None,
        "pitch": screw.pitch if turns and math.isfinite(screw.pitch) else None,
    }
