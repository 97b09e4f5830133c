# SPDX-License-Identifier: BSD-3-Clause
"""Modules that are loaded by name, when they are wanted."""

from __future__ import annotations

import gc
from importlib import import_module
from types import ModuleType
from typing import Any


def load(name: str, *, for_good: bool = False) -> ModuleType:
    """A module; what is loaded with it is no garbage, so that nobody has to look for any.

    Args:
        name: The module.
        for_good: Whether all that there is now is kept until the process ends.
    """
    collects = gc.isenabled()
    gc.disable()
    try:
        return import_module(name)
    finally:
        if for_good:
            gc.freeze()
        if collects:
            gc.enable()


#: What models and layouts offer and what is above them does: the one place where names point up.
FEATURES = {
    "show": ("flexact.api", "show_model"),
    "html": ("flexact.show.notebook.output", "html_of_model"),
    "scatter": ("flexact.sweeps.scatter", "scatter_of"),
    "flexures": ("flexact.apps.convert.flexure_table", "table_of_flexures"),
    "designs": ("flexact.designs.page", "html_of"),
    "refined": ("flexact.designs.reshape", "refined_designs"),
    "refined_in_words": ("flexact.designs.reshape", "refined_in_words"),
    "at_rest": ("flexact.costs.at_rest", "json_of"),
    "at_rest_in_words": ("flexact.costs.at_rest", "at_rest_in_words"),
}


def feature(name: str) -> Any:
    """The function of `FEATURES` that does it, loaded when it is wanted."""
    module, function = FEATURES[name]
    return getattr(load(module), function)


VERSION = "0.1.0"
