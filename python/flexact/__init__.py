# SPDX-License-Identifier: BSD-3-Clause
"""Flexact: exact-constraint analysis of compliant mechanisms.

Read a deck or make a `Model`, and `analyse` it: the `Analysis` says whether the
mechanism is exactly, under- or over-constrained, with which motions and self-stresses.

The names are loaded when they are first used, so that a command which needs few of them
starts quickly.
"""

import typing as _typing

from .base.loading import load as _load
from .base.version import VERSION as _VERSION
from .model.showing import shown_by as _shown_by

if _typing.TYPE_CHECKING:
    from .advising import Advice, Step
    from .analysis import Analysis, analyse
    from .base.errors import FlexactError
    from .costing.cost import Cost, cost
    from .costing.shape import Shape
    from .costing.state_shape import shape
    from .deck.models import read, read_text
    from .diagnostics.diagnostic import Diagnostic, Place, Severity
    from .diagnostics.errors import DeckError, ModelError
    from .model.configuration import Configuration
    from .model.handles import (
        Assembly,
        Body,
        Element,
        FoldedSheet,
        Node,
        Notch,
        Sheet,
        Wire,
    )
    from .model.jacobian import Jacobian, deformations, jacobian
    from .model.material import Material
    from .model.model import Model
    from .notebook.output import viewer
    from .notebook.results import Results
    from .result.exact import ExactBases
    from .result.failing import AnalysisError
    from .result.modes import Motion, SelfStress
    from .result.verdict import (
        Alternative,
        Certainty,
        ClassCounts,
        Counts,
        Gap,
        Margin,
        Nearly,
        Proof,
        Verdict,
    )
    from .stiffness import (
        Elastic,
        ElasticError,
        Estimate,
        State,
        StrokeError,
        UnknownError,
        elastic,
    )
    from .tracing.trace import Trace
    from .tracing.tracer import trace
    from .variants.search.crossing import Crossing, Crossings
    from .variants.sweep import sweep
    from .variants.sweeps.parameters import grid
    from .variants.table import Table
    from .variants.tolerances import Tolerances, tolerances

__version__ = _VERSION

#: The module of each public name.
_HOMES = {
    "advising": ("Advice", "Step"),
    "analysis": ("Analysis", "analyse"),
    "base.errors": ("FlexactError",),
    "costing.cost": ("Cost", "cost"),
    "costing.shape": ("Shape",),
    "costing.state_shape": ("shape",),
    "deck.models": ("read", "read_text"),
    "diagnostics.diagnostic": ("Diagnostic", "Place", "Severity"),
    "diagnostics.errors": ("DeckError", "ModelError"),
    "model.configuration": ("Configuration",),
    "model.jacobian": ("Jacobian", "deformations", "jacobian"),
    "model.handles": (
        *("Assembly", "Body", "Element", "FoldedSheet", "Node", "Notch", "Sheet", "Wire"),
    ),
    "model.material": ("Material",),
    "model.model": ("Model",),
    "notebook.output": ("viewer",),
    "notebook.results": ("Results",),
    "result.failing": ("AnalysisError",),
    "result.exact": ("ExactBases",),
    "result.modes": ("Motion", "SelfStress"),
    "result.verdict": (
        *("Alternative", "Certainty", "ClassCounts", "Counts", "Gap", "Margin", "Nearly", "Proof"),
        "Verdict",
    ),
    "stiffness": (
        *("Elastic", "ElasticError", "Estimate", "State", "StrokeError", "UnknownError"),
        "elastic",
    ),
    "tracing.tracer": ("trace",),
    "tracing.trace": ("Trace",),
    "variants.search.crossing": ("Crossing", "Crossings"),
    "variants.sweeps.parameters": ("grid",),
    "variants.sweep": ("sweep",),
    "variants.table": ("Table",),
    "variants.tolerances": ("Tolerances", "tolerances"),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}

__all__ = [
    "Advice",
    "Alternative",
    "Analysis",
    "AnalysisError",
    "Assembly",
    "Body",
    "Certainty",
    "ClassCounts",
    "Configuration",
    "Cost",
    "Counts",
    "Crossing",
    "Crossings",
    "DeckError",
    "Diagnostic",
    "Elastic",
    "ElasticError",
    "Element",
    "Estimate",
    "ExactBases",
    "FlexactError",
    "FoldedSheet",
    "Gap",
    "Jacobian",
    "Margin",
    "Material",
    "Model",
    "ModelError",
    "Motion",
    "Nearly",
    "Node",
    "Notch",
    "Place",
    "Proof",
    "Results",
    "SelfStress",
    "Severity",
    "Shape",
    "Sheet",
    "State",
    "Step",
    "StrokeError",
    "Table",
    "Tolerances",
    "Trace",
    "UnknownError",
    "Verdict",
    "Wire",
    "__version__",
    "analyse",
    "cost",
    "deformations",
    "elastic",
    "grid",
    "jacobian",
    "read",
    "read_text",
    "shape",
    "sweep",
    "tolerances",
    "trace",
    "viewer",
]


# A model may know nothing of what stands on top of it.
_shown_by(
    lambda model, path: _load("flexact.analysis").show_model(model, path),
    lambda model: _load("flexact.notebook.models").html_of(model.data),
)


def __getattr__(name: str) -> object:
    """A public name, loaded from its module."""
    if name not in _HOME_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    _load("flexact.core.narrow").prepare()
    value: object = getattr(_load(f"flexact.{_HOME_OF[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """The public names."""
    return sorted({*__all__, *(name for name in globals() if name.startswith("__"))})
