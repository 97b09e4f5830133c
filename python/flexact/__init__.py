# SPDX-License-Identifier: BSD-3-Clause
"""Flexact: exact-constraint analysis of compliant mechanisms.

Read a deck or make a `Model`, and `analyse` it: the `Analysis` says whether the
mechanism is exactly, under- or over-constrained, with which motions and self-stresses.

The names are loaded when they are first used, so that a command which needs few of them
starts quickly.
"""

import typing as _typing

from .util.loading import VERSION as _VERSION
from .util.loading import load as _load

if _typing.TYPE_CHECKING:
    from .advice.advice import Advice
    from .advice.step import Step
    from .analysis.exact import ExactBases
    from .analysis.result import Motion, SelfStress
    from .analysis.verdict import (
        Alternative,
        AnalysisError,
        Certainty,
        ClassCounts,
        Counts,
        Gap,
        Margin,
        Proof,
        Verdict,
    )
    from .api import Analysis, analyse
    from .costs.cost import Cost, cost
    from .costs.shape import Shape, shape
    from .deck.diagnostics import Diagnostic, Place, Severity
    from .deck.rendering import DeckError, ModelError
    from .elasticity import (
        Elastic,
        ElasticError,
        Estimate,
        State,
        StrokeError,
        UnknownError,
        elastic,
    )
    from .model.arguments import polar
    from .model.configuration import Configuration
    from .model.handles import (
        Assembly,
        Body,
        Element,
        FoldedSheet,
        Node,
        Notch,
        ReinforcedSheet,
        Sheet,
        Wire,
    )
    from .model.jacobian import Jacobian, deformations, jacobian
    from .model.model import Model
    from .model.reading import read, read_text
    from .model.sections import Material
    from .show.notebook.output import Results, viewer
    from .sweeps.crossings import Crossing, Crossings
    from .sweeps.parameters import grid
    from .sweeps.sweep import sweep
    from .sweeps.table import Table
    from .sweeps.tolerances import Tolerances, tolerances
    from .tracing.trace import Trace, trace
    from .util.errors import FlexactError

__version__ = _VERSION

#: The module of each public name.
_HOMES = {
    "advice.advice": ("Advice",),
    "advice.step": ("Step",),
    "analysis.exact": ("ExactBases",),
    "analysis.result": (
        "Motion",
        "SelfStress",
    ),
    "analysis.verdict": (
        "Alternative",
        "AnalysisError",
        "Certainty",
        "ClassCounts",
        "Counts",
        "Gap",
        "Margin",
        "Proof",
        "Verdict",
    ),
    "api": (
        "Analysis",
        "analyse",
    ),
    "costs.cost": (
        "Cost",
        "cost",
    ),
    "costs.shape": (
        "Shape",
        "shape",
    ),
    "deck.diagnostics": (
        "Diagnostic",
        "Place",
        "Severity",
    ),
    "deck.rendering": (
        "DeckError",
        "ModelError",
    ),
    "elasticity": (
        "Elastic",
        "ElasticError",
        "Estimate",
        "State",
        "StrokeError",
        "UnknownError",
        "elastic",
    ),
    "model.arguments": ("polar",),
    "model.configuration": ("Configuration",),
    "model.handles": (
        "Assembly",
        "Body",
        "Element",
        "FoldedSheet",
        "Node",
        "Notch",
        "ReinforcedSheet",
        "Sheet",
        "Wire",
    ),
    "model.jacobian": (
        "Jacobian",
        "deformations",
        "jacobian",
    ),
    "model.model": ("Model",),
    "model.reading": (
        "read",
        "read_text",
    ),
    "model.sections": ("Material",),
    "show.notebook.output": (
        "Results",
        "viewer",
    ),
    "sweeps.crossings": (
        "Crossing",
        "Crossings",
    ),
    "sweeps.parameters": ("grid",),
    "sweeps.sweep": ("sweep",),
    "sweeps.table": ("Table",),
    "sweeps.tolerances": (
        "Tolerances",
        "tolerances",
    ),
    "tracing.trace": (
        "Trace",
        "trace",
    ),
    "util.errors": ("FlexactError",),
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
    "Node",
    "Notch",
    "Place",
    "Proof",
    "ReinforcedSheet",
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
    "polar",
    "read",
    "read_text",
    "shape",
    "sweep",
    "tolerances",
    "trace",
    "viewer",
]


def __getattr__(name: str) -> object:
    """A public name, loaded from its module."""
    if name not in _HOME_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    _load("flexact.util.machine").prepare_libraries()
    value: object = getattr(_load(f"flexact.{_HOME_OF[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """The public names."""
    return sorted({*__all__, *(name for name in globals() if name.startswith("__"))})
