# SPDX-License-Identifier: BSD-3-Clause
"""At a glance what over-constraint costs: one linear answer, exact with the deck's own elements."""

from __future__ import annotations

import numpy as np

from ..base.columns import USUAL
from ..base.errors import FlexactError
from ..base.plain_text import harmless
from ..result.result import Result
from ..stiffness.resultants import resultants_of
from ..text.places import part_words
from ..text.sentences import filled, sentence
from .bench import MISMATCH, Bench, Choice, Level, has_stiffness
from .places import Places
from .quantities import in_words
from .values import Number, words_of_direction

#: Of more elements, or errors, it would no longer be a glance.
_MOST, _MOST_ERRORS = 1000, 600
#: The error that is told, as a part of the model's size, rounded to a power of ten.
_PART = 1.0e-3


def with_glance(words: str, result: Result, width: int = USUAL) -> str:
    """The words about a result, and a paragraph of what over-constraint costs, if it is known."""
    told = glance(result)
    return f"{words}\n\n{filled(sentence(told), width=width)}" if told else words


def glance(result: Result) -> str:
    """A sentence on the error that stores most energy; empty where there is none to be told.

    Only of over-constrained models with stiffness (ESTIFF) that are not large. Forces and energy
    are linear, and exact without refinement; how far a clamp may be off is not.
    """
    data = result.given
    too_large = data.arrays.element_number.size > _MOST
    if not result.over_constrained or too_large or not has_stiffness(data):
        return ""
    try:
        return _sentence(result)
    except FlexactError:
        return ""


def _sentence(result: Result) -> str:
    data = result.given
    places = Places(data, result.parts)
    errors = places.misalignments()
    if not 0 < len(errors) <= _MOST_ERRORS:
        return ""
    bench = Bench(data, Choice("elastic", "free", 1), {}, 0)
    shift, answer = Level(bench, 0, bench.rest.finest).response(errors)
    if answer.loose.shape[2]:
        return ""
    size = places.size
    lengths = np.array([size if each.unit == "rad" else 1.0 for each in errors])
    energy = 0.5 * np.einsum("cnk,cnk->k", shift, answer.reaction)
    energy = np.where(answer.mismatch > MISMATCH, 0.0, energy)
    k = int(np.argmax(np.round(energy / lengths**2 / max(energy.max(), 1e-300), 6)))
    if not energy[k] > 0.0:
        return ""
    off = 10.0 ** round(np.log10(_PART * size / lengths[k]))
    stress = off * answer.stress[:, :, k]
    carried = [resultants_of(data, e, stress[:, e]) for e in range(stress.shape[1])]
    moments = [max(abs(c.torque), *np.abs(c.moment_y), *np.abs(c.moment_z)) for c in carried]
    forces = [abs(c.normal_force) for c in carried]
    sizes, unit = (moments, "N m") if max(moments) > 0.0 else (forces, "N")
    most = int(np.argmax(np.round(np.array(sizes) / max(sizes), 6)))
    each = errors[k]
    turned = "turned" if each.unit == "rad" else "off"
    return (
        f"It costs: {harmless(each.clamp.words)} {turned} by {in_words(Number(off), each.unit)} "
        f"{words_of_direction(each.direction)} loads "
        f"{part_words(result.parts.of_element(most))} with {sizes[most]:.3g} {unit} and stores "
        f"{in_words(Number(float(energy[k]) * off**2), 'J')}; flexact cost finds how far each "
        "clamp may be off."
    )
