# SPDX-License-Identifier: BSD-3-Clause
"""Which thin parts are flexures, and which are bodies.

Loaded in the child process alone.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from .assembly import Choices, Kind
from .brep import Part
from .thin import Thin


def apart(found: Iterable[Thin]) -> list[Thin]:
    """Of thin parts that are the same material, the thinnest."""
    kept: list[Thin] = []
    for thin in sorted(found, key=lambda each: each.thickness):
        same = [k for k in kept if k.has(thin.middle) or thin.has(k.middle)]
        if any(k.kind is Kind.WIRE and k.contour == "round" for k in same):
            continue
        if not same or all(k.length < thin.length / 3 and not k.has(thin.middle) for k in same):
            kept.append(thin)
    return kept


def sorted_out(
    found: Sequence[Thin], parts: Sequence[Part], choices: Choices
) -> tuple[list[Thin], list[Thin]]:
    """Thin parts that are flexures, and candidates that are taken as bodies.

    What is long for its thickness, and not much thicker than the most slender one, is a
    flexure; what is short, or thick beside others, is none; between both there is a doubt.
    """
    webs = [thin for thin in found if thin.contour == "web"]
    necks_ = [thin for thin in found if thin.kind is Kind.NOTCH]
    slim = [thin for thin in found if thin.contour != "web" and thin.kind is not Kind.NOTCH]
    references = [thin.thickness for thin in necks_ if thin.contour == "circular"]
    if slim:
        most = max(thin.length / thin.thickness for thin in slim)
        alike = [t.thickness for t in slim if t.length >= 0.5 * most * t.thickness]
        if most >= 15 or not references:
            references.append(min(alike))
    elif not references:
        references = [thin.thickness for thin in necks_]
    least = min(references, default=0.0)
    thin_ones = [t for t in slim if t.length >= 20 * t.thickness and t.thickness <= 4 * least]
    usual = float(np.median([t.bending for t in thin_ones])) if thin_ones else 0.0
    taken: list[Thin] = []
    candidates: list[Thin] = []
    for thin in (*necks_, *slim):
        if _says(thin, parts[thin.part], choices.bodies):
            candidates.append(thin)
            continue
        if _says(thin, parts[thin.part], choices.flexures):
            taken.append(thin)
            continue
        if thin.kind is Kind.NOTCH:
            # Between two bores it is meant; a bar between fillets may be a link.
            if thin.contour == "circular" or thin.thickness < 3 * least:
                taken.append(thin)
            continue
        slender, thick = thin.length / thin.thickness, thin.thickness / least
        stiff = thin.bending / usual if usual else 1.0
        words = f"{thin.length:.3g} mm long and {thin.thickness:.3g} mm thick"
        if stiff > 1000 and slender >= 20:
            thin.why.append(
                f"{words}, it is {stiff:.0f} times as stiff in bending as the usual flexure here"
            )
            is_flexure = False
        elif slender >= 15 and thick < (6 if slender >= 40 else 3):
            is_flexure = True
        elif slender >= 40:
            is_flexure = False
            thin.why.append(f"{words}, it is {thick:.2g} times as thick as the thinnest")
        elif slender >= 15:
            is_flexure = stiff < 30 and thick < 6
            if thick < 8:
                thin.why.append(f"{words}, it is {thick:.2g} times as thick as the thinnest")
        else:
            is_flexure = thick < 1.5 and slender >= 5
            if thick < 3:
                thin.why.append(f"{words}, it is short for a flexure")
        (taken if is_flexure else candidates).append(thin)
    for thin in webs:
        near = thin.thickness < 3 * least or not references
        cut_up = any(each.part == thin.part for each in taken)
        if near and thin.length > 20 * thin.thickness and not cut_up:
            thin.why += thin.doubts
            candidates.append(thin)
    return taken, candidates


def _says(thin: Thin, part: Part, chosen: Sequence[object]) -> bool:
    """Whether a choice means a thin part."""
    return any(
        choice == part.name
        if isinstance(choice, str)
        else thin.has(1000.0 * np.asarray(choice, float), thin.thickness / 2)
        for choice in chosen
    )
