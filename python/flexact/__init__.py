"""Flexact: exact-constraint analysis of compliant mechanisms.

Read a deck or make a `Model`, and `analyse` it: the `Analysis` says whether the
mechanism is exactly, under- or over-constrained, with which motions and self-stresses.
"""

from .analysis import Analysis, AnalysisError, analyse
from .configuration import Configuration, Jacobian, deformations, jacobian
from .diagnostics import DeckError, Diagnostic, FlexactError, ModelError, Place, Severity
from .handles import Element, Node, Sheet
from .model import Model
from .modes import Motion, SelfStress
from .reading import read, read_text
from .verdict import Certainty, ClassCounts, Counts, Gap, Margin, Nearly, Verdict

__version__ = "0.1.0"

__all__ = [
    "Analysis",
    "AnalysisError",
    "Certainty",
    "ClassCounts",
    "Configuration",
    "Counts",
    "DeckError",
    "Diagnostic",
    "Element",
    "FlexactError",
    "Gap",
    "Jacobian",
    "Margin",
    "Model",
    "ModelError",
    "Motion",
    "Nearly",
    "Node",
    "Place",
    "SelfStress",
    "Severity",
    "Sheet",
    "Verdict",
    "__version__",
    "analyse",
    "deformations",
    "jacobian",
    "read",
    "read_text",
]
