# SPDX-License-Identifier: BSD-3-Clause
"""The builder: all methods that make a model."""

from __future__ import annotations

from .coordinates import LoadMethods
from .copies import CopyMethods
from .edits import EditMethods
from .showing import ShowMethods


class Builder(CopyMethods, EditMethods, LoadMethods, ShowMethods):
    """The half of `Model` that makes it; see there."""
