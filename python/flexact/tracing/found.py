# SPDX-License-Identifier: BSD-3-Clause
"""Places between two stations of a path at which something is special."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from ..core.arrays import FloatArray
from ..model.configuration import Configuration
from ..motion import Held, Station
from ..motion.chart import Near
from ..motion.passing import passing
from ..motion.station import Between
from ..util.cached import cached_property
from ..util.records import Frozen


@dataclass(frozen=True, eq=False)
class Found(Frozen):
    """A place between two stations, and what is special there."""

    arc: float
    where: Configuration
    nodes: tuple[int, ...] = ()
    """Those that turn back there."""
    resting: tuple[int, ...] = ()
    """Those that are at rest, also such as never move."""
    is_drive: bool = False
    directions: int = 0


class WayBetween:
    """The path between two stations, decomposed when it is needed."""

    def __init__(self, held: Held, one: Station, other: Station) -> None:
        """Keep the stations."""
        self.held, self.one, self.other = held, one, other
        self.tangent: FloatArray | None = None

    @cached_property
    def _between(self) -> Between:
        return Between(self.held, self.one, self.other)

    def passing(self, function: Callable[[Configuration, FloatArray], float]) -> list[Found]:
        """Where a function of place and direction passes zero; none where it is not found."""

        def of_near(near: Near) -> float:
            return function(near.place.configuration, self._between.direction(near))

        found = passing(self._between, of_near)
        self.tangent = None if found is None else found.tangent
        return [] if found is None else [Found(found.arc, found.where)]


def merged(found: Sequence[Found], apart: float) -> list[Found]:
    """What was found, in order; what is at one place is one."""
    made: list[Found] = []
    for each in sorted(found, key=lambda one: one.arc):
        if made and each.arc - made[-1].arc <= apart:
            last = made[-1]
            made[-1] = replace(
                last,
                nodes=tuple(sorted({*last.nodes, *each.nodes})),
                resting=tuple(sorted({*last.resting, *each.resting})),
                is_drive=last.is_drive or each.is_drive,
                directions=max(last.directions, each.directions),
            )
        else:
            made.append(each)
    return made
