"""The result of an analysis as the JSON has it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from .exchange import FloatArray

if TYPE_CHECKING:
    from .analysis import Analysis

#: Components of a mode below this part of its largest are left out.
_NEGLIGIBLE = 1.0e-14


def dictionary_of(analysis: Analysis) -> dict[str, Any]:
    """The names and values of the JSON, in their order."""
    from . import __version__

    return {
        "deck": unicode_text(analysis.name),
        "flexact": __version__,
        "verdict": analysis.verdict.value,
        "under_constrained": analysis.under_constrained,
        "over_constrained": analysis.over_constrained,
        "rank": analysis.rank,
        "rows": analysis.rows,
        "columns": analysis.columns,
        "singular_values": analysis.singular_values.tolist(),
        "condition_number": analysis.condition_number,
        "degrees_of_freedom": analysis.degrees_of_freedom,
        "counts": {name: part._asdict() for name, part in analysis.counts._asdict().items()},
        "motions": [
            _components(mode.vector, analysis.column_labels, "node", "coordinate")
            for mode in analysis.motions
        ],
        "self_stresses": [
            _components(mode.vector, analysis.row_labels, "element", "deformation")
            for mode in analysis.self_stresses
        ],
        "warnings": [item.to_dict() for item in analysis.warnings],
    }


def unicode_text(name: str) -> str:
    """A name that any reader of JSON takes; bytes of a path that are no text are escaped."""
    return name.encode("utf-8", "backslashreplace").decode("utf-8")


def _components(
    vector: FloatArray, labels: Sequence[tuple[int, int | str]], owner: str, part: str
) -> dict[str, list[dict[str, int | str | float]]]:
    values = vector.tolist()
    least = _NEGLIGIBLE * max(map(abs, values), default=0.0)
    components: list[dict[str, int | str | float]] = [
        {owner: number, part: which, "value": value}
        for (number, which), value in zip(labels, values, strict=True)
        if abs(value) > least
    ]
    return {"components": components}
