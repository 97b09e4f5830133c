# SPDX-License-Identifier: BSD-3-Clause
"""The builder: all methods that make a model."""

from __future__ import annotations

from .copies import CopyMethods
from .edits import EditMethods
from .in_notebook import NotebookMethods
from .loading import LoadMethods


class Builder(CopyMethods, EditMethods, LoadMethods, NotebookMethods):
    """The half of `Model` that makes it; see there."""
