# SPDX-License-Identifier: BSD-3-Clause
"""Flexact: exact-constraint analysis of compliant mechanisms.

Begin with a `Model` or with a deck that is read, analyse it, ask for advice, and look at it:

    import flexact

    model = flexact.Model()  # or flexact.read("guide.dat")
    guide = model.parallel_guide((0, 0, 0), (0.1, 0, 0), offset=(0, 0.05, 0))
    model.fix(*guide.ground)
    model.independent("stage", "y")
    analysis = flexact.analyse(model)
    print(analysis.advice().describe())  # what is wrong, why, and steps that mend it
    analysis.show()  # the mechanism with its motions and self-stresses, in the browser

help(flexact.Model), help(flexact.analyse) and so on tell of each name:

Mechanisms
    Model: build a mechanism of sheets, wires, bodies, bars, hinges
    read, read_text: a model from a deck, a file or its text
    Node, Element: a point and an element of a model
    Sheet, Wire, FoldedSheet, Notch, Body, Assembly: parts that a model has made
    ReinforcedSheet: a sheet with a rigid middle
    polar: a place at a radius and an angle
    Material: what sheets and wires are made of
    NotchContour: compliances and stress of a notch, with what is published beside
    Configuration: where all nodes of a model are

Whether it is exactly constrained
    analyse: the analysis of a model or deck
    Analysis: its result, with words, files and pictures
    Verdict, Counts, ClassCounts: exactly, under- or over-constrained, and by how much
    Motion: a motion that nothing holds
    SelfStress: parts that press on each other without any load
    Certainty, Gap, Proof: how sure the rank is
    Alternative, Margin: other counts that may be meant; how near another verdict is
    ExactBases: motions and self-stresses in fractions
    deformations, jacobian, Jacobian: the equations that the verdict rests on

What to do about it
    Advice, Step: what is wrong and why; one way to mend it

From a wanted freedom to a mechanism
    design, Designs, Layout: layouts of flexures that leave a body one freedom and no other
    box: where flexures may end

With stiffness and mass
    elastic, Elastic: a model with its stiffness and mass
    State, Estimate: compliance, frequencies, stresses at a load or stroke; a value, how exact
    PointTable, StrokeTable: stiffness in any frame at a point, and along a stroke
    Warmed: a state in which something is warm: drift, thermal centre
    Limits: how far a stroke may go
    Scatter: what the workshop's scatter does, of `elastic(...).scatter(...)`
    StateSpace: A, B, C, D, poles and frequency response of a state, for a controller
    shape, Shape: the shape in which it vibrates or buckles
    cost, Cost: what over-constraint costs, and what each release gains

Better designs
    refine, Refined: lengths, thicknesses and places that are best within limits

Many variants, and paths
    sweep, grid, Table: variants of a design in one table
    Crossing, Crossings: the singular variants between its rows
    tolerances, Tolerances: misaligned at random, many times
    trace, Trace: the path of a motion

In notebooks
    Results: analyses side by side, with pictures
    viewer: the live viewer, brought back

What went wrong
    FlexactError: any error that Flexact raises on purpose; all errors below are such
    DeckError, ModelError: a deck or a model that cannot be analysed
    AnalysisError: a sound model that could not be analysed
    ElasticError, StrokeError: a stiffness or a stroke that has no answer
    UnknownError: a node, element or coordinate that is not there
    Diagnostic, Severity, Place: a problem of a deck or model, how grave it is, and where
"""

# The names are loaded when they are first used, so that a command which needs few starts quickly.

import sys as _sys
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
    from .designs.design import Designs, design
    from .designs.layouts import Layout
    from .designs.reading import box
    from .designs.refine import refine
    from .designs.refined import Refined
    from .elasticity import (
        Elastic,
        ElasticError,
        Estimate,
        Limits,
        PointTable,
        State,
        StateSpace,
        StrokeError,
        StrokeTable,
        UnknownError,
        Warmed,
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
    from .model.notches import NotchContour
    from .model.reading import read, read_text
    from .model.sections import Material
    from .show.notebook.output import Results, viewer
    from .sweeps.crossings import Crossing, Crossings
    from .sweeps.parameters import grid
    from .sweeps.scatter_result import Scatter
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
        "Scatter",
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
    "designs.design": ("Designs", "design"),
    "designs.layouts": ("Layout",),
    "designs.reading": ("box",),
    "designs.refine": ("refine",),
    "designs.refined": ("Refined",),
    "elasticity": (
        "Elastic",
        "ElasticError",
        "Estimate",
        "PointTable",
        "Limits",
        "State",
        "StateSpace",
        "StrokeError",
        "StrokeTable",
        "UnknownError",
        "Warmed",
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
    "model.notches": ("NotchContour",),
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
    "sweeps.scatter_result": ("Scatter",),
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
    "Designs",
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
    "Layout",
    "Limits",
    "Margin",
    "Material",
    "Model",
    "ModelError",
    "Motion",
    "Node",
    "Notch",
    "NotchContour",
    "Place",
    "PointTable",
    "Proof",
    "Refined",
    "ReinforcedSheet",
    "Results",
    "Scatter",
    "SelfStress",
    "Severity",
    "Shape",
    "Sheet",
    "State",
    "StateSpace",
    "Step",
    "StrokeError",
    "StrokeTable",
    "Table",
    "Tolerances",
    "Trace",
    "UnknownError",
    "Verdict",
    "Warmed",
    "Wire",
    "__version__",
    "analyse",
    "box",
    "cost",
    "deformations",
    "design",
    "elastic",
    "grid",
    "jacobian",
    "polar",
    "read",
    "read_text",
    "refine",
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
    """The public names; none for `help`, which has the text above and would print each in full."""
    caller = _sys._getframe(1)
    while caller.f_back and caller.f_globals["__name__"] == "inspect":
        caller = caller.f_back
    if caller.f_code.co_name == "docmodule":  # of pydoc, which lists members by inspect
        return []
    return sorted({*__all__, *(name for name in globals() if name.startswith("__"))})
