# SPDX-License-Identifier: BSD-3-Clause
"""What is rigid and what is elastic, what is released, and what a drive holds."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from ..core.arrays import BoolArray, FloatArray, packed
from ..core.elastic import ElasticArrays, element_stiffness
from ..core.elements import Class, Dual, dual_table
from ..model.data import ModelData
from ..util.plain_text import in_short
from ..util.quantities import NOTCH, Quantity, without_units
from ..util.records import Frozen
from .points import Points
from .stiffness_errors import ElasticError

HELD = ("elastic", "rigid")
DRIVES = ("free", "locked")

#: Deformations that are released, as users give them.
Release = Iterable[tuple[object, ...]] | Mapping[tuple[object, ...], Quantity]
#: Stiffness [N m/rad; N/m of an elongation] by indices of element and deformation, from 0.
Releases = dict[tuple[int, int], float]


def choice(given: object, known: tuple[str, ...], what: str) -> str:
    """One of some words.

    Raises:
        ElasticError: it is none of them.
    """
    if given not in known or not isinstance(given, str):
        raise ElasticError(f"{what} must be {' or '.join(map(repr, known))}, not {in_short(given)}")
    return given


def releases_given(points: Points, given: object) -> Releases:
    """Releases with the stiffness of each notch, 0 where none is given.

    Raises:
        UnknownError: there is no such element or deformation.
        ElasticError: a stiffness is negative or not finite.
        TypeError: it is neither pairs nor a mapping of them.
    """
    if isinstance(given, Mapping):
        pairs = list(given.items())
    elif isinstance(given, Iterable) and not isinstance(given, (str, bytes)):
        pairs = [_with_stiffness(pair) for pair in given]
    else:
        raise TypeError(_WANTED + in_short(given))
    made: Releases = {}
    for pair, stiffness in pairs:
        if not isinstance(pair, (tuple, list)) or len(pair) not in (2, 3):
            raise TypeError(_WANTED + in_short(pair))
        stiffness = without_units(stiffness, NOTCH)
        number = stiffness if isinstance(stiffness, (int, float, np.number)) else math.nan
        if isinstance(stiffness, bool) or not (math.isfinite(number) and number >= 0.0):
            raise ElasticError(
                f"the stiffness of a release must be a number from 0 in N m/rad (of an elongation "
                f"in N/m), not {in_short(stiffness)}"
            )
        made.update(dict.fromkeys(points.deformations(*pair), float(number)))
    return made


def _with_stiffness(given: object) -> tuple[object, object]:
    """A pair without a stiffness, or a pair with its own."""
    if isinstance(given, (tuple, list)) and given and isinstance(given[0], (tuple, list)):
        return (given[0], given[1]) if len(given) == 2 else (given, 0.0)
    return given, 0.0


NO_STIFFNESS = (
    "no element has a stiffness: give ESTIFF in the deck's dynamics block, or a material with a "
    "section"
)
_WANTED = "releases are pairs of an element and a deformation, or a mapping of them, not "


@dataclass(frozen=True, eq=False)
class Policy(Frozen):
    """What is rigid in a model, and what its elements are made of.

    Attributes:
        arrays: Stiffness and mass of the deck's elements; notches in N m/rad, N/m, by element.
        rigid: (6, elements) which deformations are rigid, those with a notch too: that is in
            series.
        stiff: (6, elements) which have a stiffness of their own.
    """

    arrays: ElasticArrays
    rigid: BoolArray
    stiff: BoolArray

    @property
    def has_stiffness(self) -> bool:
        """Whether any stiffness is given at all."""
        return bool(self.stiff.any() or np.nan_to_num(self.arrays.notch).any())


def policy_of(data: ModelData, held: str, releases: Releases) -> Policy:
    """What is rigid: fixed deformations; with held "elastic" only those without a stiffness."""
    arrays = data.arrays
    notch = np.full(arrays.deformation_class.shape, np.nan, order="F")
    plain = elastic_arrays(data, notch)
    # What is rigid has none in the core: here all of it is asked for.
    free = np.where(arrays.deformation_class == Class.NONE, Class.NONE, Class.DEPENDENT)
    asked = arrays._replace(deformation_class=np.asfortranarray(free, np.int32))
    own, _ = element_stiffness(packed(asked), plain)
    stiff = np.diagonal(own, axis1=1, axis2=2).T > 0.0
    rigid = arrays.deformation_class == Class.FIXED
    if held == "elastic":
        rigid &= ~stiff
    for (element, k), stiffness in releases.items():
        notch[k, element] = stiffness
    return Policy(elastic_arrays(data, notch), rigid, stiff)


def elastic_arrays(data: ModelData, notch: FloatArray) -> ElasticArrays:
    """Stiffness and mass of a model, as the core takes them; NaN where nothing is given."""
    given, ne = data.properties, data.arrays.element_number.size
    if given is None:
        return ElasticArrays(
            np.full((6, ne), np.nan, order="F"),
            np.full((5, ne), np.nan, order="F"),
            np.full((6, data.arrays.node_number.size), np.nan, order="F"),
            notch,
        )
    return ElasticArrays(
        np.asfortranarray(given.stiffness.T),
        np.asfortranarray(given.mass.T),
        np.asfortranarray(given.node_mass.T),
        notch,
    )


def notch_in_units(data: ModelData, notch: FloatArray) -> FloatArray:
    """Notches in the units of the deformations: of lengths that are angles, over length squared."""
    by_length = (dual_table()[data.arrays.element_kind] == Dual.MOMENT_OVER_LENGTH).T
    length = np.where(data.frames.length > 0.0, data.frames.length, 1.0)
    return np.asfortranarray(np.where(by_length, notch / length**2, notch))


def numbered(data: ModelData, releases: Releases) -> dict[tuple[int, int], float]:
    """Releases by numbers of elements and deformations, from 1, instead of indices."""
    numbers = data.arrays.element_number
    return {(int(numbers[e]), k + 1): value for (e, k), value in releases.items()}


def indexed(data: ModelData, release: Mapping[tuple[int, int], float]) -> Releases:
    """The other way round."""
    return {(data.element_index[e], k - 1): value for (e, k), value in release.items()}
